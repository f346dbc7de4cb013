//! Evens out the light of a scan or a photograph, and the tones of floors: each pixel is divided by the lightness of the paper,
//! or of the floor, around it.

use rayon::prelude::*;

use super::clearance::closed;

/// Cells of the coarse picture along the image's longer side.
const CELLS: usize = 256;
/// Share of a cell's pixels that are darker than the cell's paper.
const PAPER_QUANTILE: f64 = 0.75;
/// Radius of the closing in cells: what is darker than its surroundings and narrower than twice this is ink.
const INK_RADIUS: usize = 8;
/// Distance in cells at which tones are compared.
const STEP: usize = 8;
/// Least range of the paper's tones.
const LEAST_RANGE: u8 = 28;
/// Greatest step of a smooth change.
const SMOOTH_STEP: u8 = 20;
/// Least share of the places where the tone changes, and least share of these changes that are smooth.
const CHANGING_SHARE: f64 = 0.1;
const SMOOTH_SHARE: f64 = 0.7;
/// Paper is never taken for darker than this share of its lightest places: what is darker is black.
const DARKEST_SHARE: f32 = 0.3;

/// Evens out the light if the paper's tone varies widely and smoothly. Returns the range of the paper's tones if so.
pub(super) fn even_out(width: usize, lightness: &mut [u8]) -> Option<[u8; 2]> {
    let paper = Coarse::paper(width, lightness);
    let range = paper.uneven_range()?;
    let least = f32::from(range[1]) * DARKEST_SHARE;
    let smooth = paper.blurred(least);
    lightness.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, l) in row.iter_mut().enumerate() {
            *l = (f32::from(*l) * 255.0 / smooth.at(x, y) + 0.5).min(255.0) as u8;
        }
    });
    Some(range)
}

/// Tones of floors: darker ones may be walls or furniture, in lighter ones nothing is lost.
const FLOOR_TONES: std::ops::Range<u8> = 130..250;
/// One pixel of so many has to have such a tone.
const FEWEST_FLOOR: usize = 100;
/// Tones of a floor, as shares of the one that a quarter of it is lighter than, and how near it is, cells.
const SAME_TONE: std::ops::Range<f32> = 0.8..1.08;
const NEARBY: [isize; 2] = [INK_RADIUS as isize / 2, INK_RADIUS as isize];

/// Makes floors of wood, tile, or a tint as light as paper, so that what is drawn on them is as dark as on paper.
///
/// `dark` pixels stay as they are.
pub(super) fn even_floors(width: usize, lightness: &mut [u8], dark: &[u8]) {
    // Edges of lines have such tones too, but are few.
    if lightness.iter().filter(|l| FLOOR_TONES.contains(l)).count() * FEWEST_FLOOR < lightness.len() {
        return;
    }
    let ground = Coarse::paper(width, lightness);
    if !ground.tones.iter().any(|tone| FLOOR_TONES.contains(tone)) {
        return;
    }
    let rows = lightness.par_chunks_mut(width).zip(dark.par_chunks(width));
    rows.enumerate().for_each(|(y, (row, dark))| {
        for (x, (l, _)) in row.iter_mut().zip(dark).enumerate().filter(|(_, (l, dark))| **dark == 0 && **l < 255) {
            let (column, line) = (x / ground.side, y / ground.side);
            let tone = ground.tones[line * ground.width + column];
            if ground.has_floor_near([column, line], *l) {
                *l = 255;
            } else if FLOOR_TONES.contains(&tone) {
                *l = (u32::from(*l) * 255 / u32::from(tone)).min(255) as u8;
            }
        }
    });
}

/// A coarse picture of the paper's lightness.
struct Coarse<T> {
    side: usize,
    width: usize,
    height: usize,
    tones: Vec<T>,
}

impl Coarse<u8> {
    fn paper(width: usize, lightness: &[u8]) -> Coarse<u8> {
        let height = lightness.len() / width;
        let side = width.max(height).div_ceil(CELLS).max(2);
        let (across, down) = (width.div_ceil(side), height.div_ceil(side));
        let tones: Vec<u8> = (0..across * down)
            .into_par_iter()
            .map(|cell| {
                let (left, top) = (cell % across * side, cell / across * side);
                let rows = (top..(top + side).min(height)).map(|y| &lightness[y * width..(y + 1) * width]);
                let mut tones: Vec<u8> = rows.flat_map(|row| &row[left..(left + side).min(width)]).copied().collect();
                let at = (tones.len() as f64 * PAPER_QUANTILE) as usize;
                *tones.select_nth_unstable(at).1
            })
            .collect();
        Coarse { side, width: across, height: down, tones: closed(&tones, across, INK_RADIUS) }
    }

    /// Whether a floor near a cell has a tone: in a door lies the floor of one of two rooms.
    fn has_floor_near(&self, [column, line]: [usize; 2], tone: u8) -> bool {
        let at = |k: usize, step: isize, end: usize| k.checked_add_signed(step).filter(|&k| k < end);
        let is_floor = |[dx, dy]: [isize; 2]| {
            let (Some(x), Some(y)) = (at(column, dx, self.width), at(line, dy, self.height)) else { return false };
            let floor = self.tones[y * self.width + x];
            FLOOR_TONES.contains(&floor) && SAME_TONE.contains(&(f32::from(tone) / f32::from(floor)))
        };
        NEARBY.into_iter().any(|reach| [[reach, 0], [-reach, 0], [0, reach], [0, -reach]].into_iter().any(is_floor))
    }

    /// The range of the paper's tones, if they vary widely and smoothly.
    fn uneven_range(&self) -> Option<[u8; 2]> {
        let mut sorted = self.tones.clone();
        sorted.sort_unstable();
        // Masses of black are no paper in the shade.
        let at = |tones: &[u8], share: f64| tones[((tones.len() - 1) as f64 * share) as usize];
        let darkest = (f32::from(at(&sorted, 0.98)) * DARKEST_SHARE) as u8;
        let lit = &sorted[sorted.partition_point(|&tone| tone < darkest)..];
        let range = [at(lit, 0.02), at(lit, 0.98)];
        if range[1] - range[0] < LEAST_RANGE {
            return None;
        }
        let (mut all, mut changing, mut smooth) = (0usize, 0usize, 0usize);
        for y in 0..self.height {
            for x in 0..self.width {
                let tone = self.tones[y * self.width + x];
                for (dx, dy) in [(STEP, 0), (0, STEP)] {
                    if x + dx < self.width && y + dy < self.height {
                        let other = self.tones[(y + dy) * self.width + x + dx];
                        if tone.min(other) < darkest {
                            continue;
                        }
                        let step = tone.abs_diff(other);
                        all += 1;
                        changing += usize::from(step > 0);
                        smooth += usize::from((1..=SMOOTH_STEP).contains(&step));
                    }
                }
            }
        }
        let varies = changing as f64 >= CHANGING_SHARE * all as f64;
        (varies && smooth as f64 >= SMOOTH_SHARE * changing as f64).then_some(range)
    }

    /// The tones without steps, at least `least`.
    fn blurred(&self, least: f32) -> Coarse<f32> {
        let mut tones: Vec<f32> = self.tones.iter().map(|&t| f32::from(t).max(least)).collect();
        for _ in 0..2 {
            let near = |at: usize, stride: usize, k: usize, end: usize| {
                let before = if k > 0 { at - stride } else { at };
                let after = if k + 1 < end { at + stride } else { at };
                [before, at, after]
            };
            let mean = |tones: &[f32], [a, b, c]: [usize; 3]| (tones[a] + 2.0 * tones[b] + tones[c]) * 0.25;
            let (width, height) = (self.width, self.height);
            let across: Vec<f32> = (0..tones.len()).map(|at| mean(&tones, near(at, 1, at % width, width))).collect();
            tones = (0..across.len()).map(|at| mean(&across, near(at, width, at / width, height))).collect();
        }
        Coarse { side: self.side, width: self.width, height: self.height, tones }
    }
}

impl Coarse<f32> {
    /// The tone at a pixel, between the four nearest cells.
    fn at(&self, x: usize, y: usize) -> f32 {
        let place = |k: usize, end: usize| {
            let at = ((k as f32 + 0.5) / self.side as f32 - 0.5).clamp(0.0, (end - 1) as f32);
            let first = (at as usize).min(end.saturating_sub(2));
            (first, (first + 1).min(end - 1), at - first as f32)
        };
        let ((left, right, u), (top, bottom, v)) = (place(x, self.width), place(y, self.height));
        let row = |y: usize| {
            let row = &self.tones[y * self.width..(y + 1) * self.width];
            row[left] + (row[right] - row[left]) * u
        };
        row(top) + (row(bottom) - row(top)) * v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 600;
    const HEIGHT: usize = 400;

    /// A sheet with lines of 60 % of the paper's lightness or less, under a light.
    fn drawn(light: impl Fn(f64, f64) -> f64, ink: f64) -> (Vec<u8>, Vec<bool>) {
        let is_ink =
            |x: usize, y: usize| (x % 97 < 4 || y % 83 < 4) && (20..580).contains(&x) && (20..380).contains(&y);
        let each = || (0..WIDTH * HEIGHT).map(|at| (at % WIDTH, at / WIDTH));
        let tone = |(x, y): (usize, usize)| {
            let paper = 245.0 * light(x as f64 / WIDTH as f64, y as f64 / HEIGHT as f64);
            // A scanner's noise.
            let noise = ((x * 7919 + y * 104_729) % 7) as f64 - 3.0;
            (if is_ink(x, y) { paper * ink } else { paper } + noise).clamp(0.0, 255.0) as u8
        };
        (each().map(tone).collect(), each().map(|(x, y)| is_ink(x, y)).collect())
    }

    fn wrong(lightness: &[u8], ink: &[bool], threshold: u8) -> f64 {
        let wrong = lightness.iter().zip(ink).filter(|&(&l, &ink)| (l < threshold) != ink).count();
        wrong as f64 / lightness.len() as f64
    }

    #[test]
    fn a_shadow_over_half_of_the_sheet_is_evened_out() {
        for (name, light) in [
            ("slope", (|x: f64, _: f64| 1.0 - 0.65 * x) as fn(f64, f64) -> f64),
            ("corner", |x, y| 1.0 - 0.6 * (x * y).min(1.0)),
            ("edge", |x, _| if x < 0.6 { 1.0 } else { (1.0 - (x - 0.6) * 2.0).max(0.5) }),
        ] {
            let (mut lightness, ink) = drawn(light, 0.5);
            let before = wrong(&lightness, &ink, 128);
            assert!(even_out(WIDTH, &mut lightness).is_some(), "{name}");
            let after = wrong(&lightness, &ink, 190);
            assert!(before > 0.02 && after < 0.002, "{name}: {before} before, {after} after");
        }
    }

    #[test]
    fn even_paper_grey_rooms_and_black_masses_stay() {
        let (mut even, _) = drawn(|_, _| 1.0, 0.5);
        let before = even.clone();
        assert!(even_out(WIDTH, &mut even).is_none());
        assert_eq!(even, before);
        let mut mass = vec![255u8; WIDTH * HEIGHT];
        for (at, l) in mass.iter_mut().enumerate() {
            let (x, y) = (at % WIDTH, at / WIDTH);
            if x < 200 || (300..420).contains(&y) {
                *l = 0;
            } else if x > 400 {
                *l = 200;
            }
        }
        assert!(even_out(WIDTH, &mut mass).is_none());
    }
}
