//! Anti-aliased lines one to two pixels wide: where they lie between pixels, a threshold tears or thins them.

use std::ops::Range;

use rayon::prelude::*;

/// Darkness of the first pixel of a torn pair, of 255.
const PARTLY_DARK: Range<u32> = 64..204;

/// Closes the gaps that a threshold tears into anti-aliased lines one pixel wide.
///
/// Where such a line moves from one row of pixels to the next, both pixels are half covered and may both be lighter
/// than the threshold. The darker of the two becomes wall if the line continues on both sides.
pub(super) fn close(width: usize, lightness: &[u8], dark: &mut [u8]) {
    let height = lightness.len() / width;
    // Most rows and columns of most plans are black and white, and have no such pair.
    let (mut rows, mut columns) = (vec![false; height], vec![false; width]);
    let pixels = lightness.chunks_exact(width).zip(dark.chunks_exact(width));
    for (in_row, (lightness, dark)) in rows.iter_mut().zip(pixels) {
        for ((in_column, &l), &d) in columns.iter_mut().zip(lightness).zip(dark) {
            let may_be_torn = d == 0 && PARTLY_DARK.contains(&(255 - u32::from(l)));
            *in_column |= may_be_torn;
            *in_row |= may_be_torn;
        }
    }
    // Lines that are nearer to x, then those nearer to y: `at(along, across)` is a pixel.
    let mut closed = torn_pairs(width, &rows, |x, y| y * width + x, lightness, dark);
    closed.extend(torn_pairs(height, &columns, |y, x| y * width + x, lightness, dark));
    for pixel in closed {
        dark[pixel] = 1;
    }
}

/// Least darkness of the middle of a line of one and a half pixels and more, of both of its flanks, and greatest beyond them, of
/// 255.
const MIDDLE: u32 = 200;
const FLANKS: u32 = 128;
const BEYOND: u32 = 32;
/// Least length of such a line, pixels.
const EVEN_PX: usize = 8;

/// Makes level and upright lines of one and a half pixels two pixels wide where they lie about the middle of one, as they are
/// where they lie between two: all walls of a drawing are as thick. One flank takes the ink of both. Where there are thick walls
/// too, thin lines are none.
pub(super) fn even(width: usize, lightness: &mut [u8], dark: &mut [u8]) {
    if has_thick(width, dark) {
        return;
    }
    let height = lightness.len() / width;
    let mut widened = flanks(width, height, |x, y| y * width + x, lightness, dark);
    widened.extend(flanks(height, width, |y, x| y * width + x, lightness, dark));
    for [darker, other] in widened {
        let ink = (255 - u16::from(lightness[darker])) + (255 - u16::from(lightness[other]));
        (lightness[darker], lightness[other]) = (255 - ink.min(255) as u8, 255);
        (dark[darker], dark[other]) = (1, 0);
    }
}

/// Whether a part of what is dark is thicker than thin lines.
fn has_thick(width: usize, dark: &[u8]) -> bool {
    const THICK_PX: usize = 4;
    const SHARE: f64 = 0.1;
    let is_thick = |at: usize| {
        (0..THICK_PX)
            .all(|row| dark.get(at + row * width..at + row * width + THICK_PX).is_some_and(|run| !run.contains(&0)))
    };
    let all = (0..dark.len()).filter(|&at| dark[at] != 0);
    let (count, thick) =
        all.fold((0usize, 0usize), |(count, thick), at| (count + 1, thick + usize::from(is_thick(at))));
    thick as f64 > SHARE * count as f64
}

/// The flanks of such lines along the first coordinate of `at`, the darker one first.
fn flanks(
    length: usize,
    across: usize,
    at: impl Fn(usize, usize) -> usize + Sync,
    lightness: &[u8],
    dark: &[u8],
) -> Vec<[usize; 2]> {
    let darkness = |a: usize, c: usize| 255 - u32::from(lightness[at(a, c)]);
    let is_between = |a: usize, c: usize| {
        let both = darkness(a, c - 1) + darkness(a, c + 1);
        let beyond = darkness(a, c - 2).max(darkness(a, c + 2));
        dark[at(a, c)] != 0 && darkness(a, c) >= MIDDLE && (FLANKS..=255).contains(&both) && beyond < BEYOND
    };
    let of_line = |c: usize| {
        let mut found = Vec::new();
        let mut a = 0;
        while a < length {
            let run = (a..length).take_while(|&a| is_between(a, c)).count();
            if run >= EVEN_PX {
                let sum = |c: usize| (a..a + run).map(|a| darkness(a, c)).sum::<u32>();
                let [darker, other] = if sum(c + 1) > sum(c - 1) { [c + 1, c - 1] } else { [c - 1, c + 1] };
                found.extend((a..a + run).map(|a| [at(a, darker), at(a, other)]));
            }
            a += run + 1;
        }
        found
    };
    (2..across.saturating_sub(2)).into_par_iter().flat_map_iter(of_line).collect()
}

/// What closes the gaps of thin lines that run along the first coordinate of `at`. `may_be_torn` says of each second
/// coordinate whether a pair may begin there.
fn torn_pairs(
    length: usize,
    may_be_torn: &[bool],
    at: impl Fn(usize, usize) -> usize + Sync,
    lightness: &[u8],
    dark: &[u8],
) -> Vec<usize> {
    let darkness = |a: usize, c: usize| 255 - u32::from(lightness[at(a, c)]);
    let is_torn = |a: usize, c: usize| {
        let (first, second) = (darkness(a, c), darkness(a, c + 1));
        // Each partly dark, together nearly one pixel, and nothing else beside them.
        PARTLY_DARK.contains(&first)
            && second >= 64
            && first + second >= 204
            && dark[at(a, c)] == 0
            && dark[at(a, c + 1)] == 0
            && darkness(a, c - 1) < 64
            && darkness(a, c + 2) < 64
    };
    let closed_in = |c: usize| {
        let mut closed = Vec::new();
        let goes_on = |a: usize| (c - 1..=c + 2).any(|c| dark[at(a, c)] != 0);
        let mut a = 0;
        while a < length {
            let gap = (a..length).take_while(|&a| is_torn(a, c)).count();
            // Lines continue beyond the image.
            let (before, after) = (a == 0 || goes_on(a - 1), a + gap == length || goes_on(a + gap));
            if (1..length).contains(&gap) && before && after {
                closed.extend((a..a + gap).map(|a| {
                    let (first, second) = (at(a, c), at(a, c + 1));
                    if lightness[second] < lightness[first] { second } else { first }
                }));
            }
            a += gap + 1;
        }
        closed
    };
    let last = may_be_torn.len().saturating_sub(2);
    (1..last).into_par_iter().filter(|&c| may_be_torn[c]).flat_map_iter(closed_in).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 20;

    fn dark_of(lightness: &[u8]) -> Vec<u8> {
        lightness.iter().map(|&l| u8::from(l < 128)).collect()
    }

    #[test]
    fn a_thin_line_that_changes_rows_stays_whole() {
        // Darkness of a line one pixel wide that descends from row 1 to row 2; in the middle both are just too light.
        let mut lightness = vec![255u8; 7 * 5];
        for (x, share) in [0.0, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0].into_iter().enumerate() {
            lightness[7 + x] = (255.0 * share + 1.0f64).min(255.0) as u8;
            lightness[14 + x] = (255.0 * (1.0 - share) + 1.0f64).min(255.0) as u8;
        }
        assert!(lightness[10] >= 128 && lightness[17] >= 128);
        let mut dark = dark_of(&lightness);
        close(7, &lightness, &mut dark);
        assert!((0..7).all(|x| dark[7 + x] + dark[14 + x] > 0));
    }

    #[test]
    fn lines_of_one_width_are_as_thick_wherever_they_lie() {
        // Lines of 1.66 pixels about the middle of a pixel and between two; of 1.2 pixels about the middle of one.
        let mut lightness = vec![255u8; WIDTH * WIDTH];
        for y in 0..WIDTH {
            for (x, flank, core) in [(4, 174, 0), (12, 230, 0)] {
                lightness[y * WIDTH + x - 1..=y * WIDTH + x + 1].copy_from_slice(&[flank, core, flank]);
            }
            lightness[y * WIDTH + 8..y * WIDTH + 10].copy_from_slice(&[0, 86]);
        }
        let mut dark = dark_of(&lightness);
        even(WIDTH, &mut lightness, &mut dark);
        let thick = |x: usize| dark[WIDTH * 9 + x - 1..=WIDTH * 9 + x + 1].iter().filter(|&&dark| dark != 0).count();
        assert_eq!([thick(4), thick(8), thick(12)], [2, 2, 1]);
    }
}
