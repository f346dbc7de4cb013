//! Thickness of strokes: what remains of a drawing under openings by squares.

use std::ops::Range;

use super::components::{Components, Neighbours};

/// Keeps the pixels that a square of `side` pixels of non-zero pixels covers.
pub(super) fn open(mask: &[u8], width: usize, side: usize) -> Vec<u8> {
    let mut kept = mask.to_vec();
    if side < 2 {
        return kept;
    }
    let height = mask.len() / width;
    // Upper left corners of squares, ...
    for row in kept.chunks_exact_mut(width) {
        let mut count = 0;
        for pixel in row.iter_mut().rev() {
            count = if *pixel != 0 { count + 1 } else { 0 };
            *pixel = u8::from(count >= side);
        }
    }
    let mut counts = vec![0usize; width];
    for y in (0..height).rev() {
        for (pixel, count) in kept[y * width..(y + 1) * width].iter_mut().zip(&mut counts) {
            *count = if *pixel != 0 { *count + 1 } else { 0 };
            *pixel = u8::from(*count >= side);
        }
    }
    // ... and all that the squares cover.
    counts.fill(0);
    for row in kept.chunks_exact_mut(width) {
        for (pixel, count) in row.iter_mut().zip(&mut counts) {
            *count = if *pixel != 0 { side } else { count.saturating_sub(1) };
            *pixel = u8::from(*count > 0);
        }
    }
    for row in kept.chunks_exact_mut(width) {
        let mut count = 0usize;
        for pixel in row {
            count = if *pixel != 0 { side } else { count.saturating_sub(1) };
            *pixel = u8::from(count > 0);
        }
    }
    kept
}

/// What of a mask is thinner than some pixels: strokes of saturated colour; broad areas are highlights.
pub(super) fn strokes(mask: &[u8], width: usize, thickest_px: f64) -> Vec<u8> {
    if mask.is_empty() {
        return Vec::new();
    }
    let broad = open(mask, width, (thickest_px.round() as usize).max(3));
    mask.iter().zip(&broad).map(|(&c, &b)| c & (1 - b)).collect()
}

/// Stretches below `length` that are on, with breaks of up to `longest` places within.
pub(super) fn runs(length: usize, longest: usize, is_on: impl Fn(usize) -> bool) -> impl Iterator<Item = Range<usize>> {
    let mut all: Vec<Range<usize>> = Vec::new();
    for k in (0..length).filter(|&k| is_on(k)) {
        match all.last_mut() {
            Some(run) if k - run.end <= longest => run.end = k + 1,
            _ => all.push(k..k + 1),
        }
    }
    all.into_iter()
}

/// Keeps the pixels of runs of a least length; `stride` is 1 along rows and the width along columns.
pub(super) fn long_runs(mask: &[u8], width: usize, stride: usize, least: usize) -> Vec<u8> {
    let (lines, length) = if stride == 1 { (mask.len() / width, width) } else { (width, mask.len() / width) };
    let start = if stride == 1 { width } else { 1 };
    let mut kept = vec![0u8; mask.len()];
    for line in 0..lines {
        let mut from = 0;
        for k in 0..=length {
            let is_on = k < length && mask[line * start + k * stride] != 0;
            if !is_on {
                if k - from >= least {
                    (from..k).for_each(|k| kept[line * start + k * stride] = 1);
                }
                from = k + 1;
            }
        }
    }
    kept
}

/// Marks the pixels within `reach` pixels of a non-zero pixel along both axes.
pub(super) fn grow(mask: &[u8], width: usize, reach: usize) -> Vec<u8> {
    let mut grown = mask.to_vec();
    for row in grown.chunks_exact_mut(width) {
        for backwards in [false, true] {
            let mut count = 0usize;
            for k in 0..width {
                let pixel = &mut row[if backwards { width - 1 - k } else { k }];
                count = if *pixel == 1 { reach + 1 } else { count.saturating_sub(1) };
                if count > 0 && *pixel == 0 {
                    *pixel = 2;
                }
            }
        }
        row.iter_mut().for_each(|pixel| *pixel = u8::from(*pixel != 0));
    }
    let height = mask.len() / width;
    for backwards in [false, true] {
        let mut counts = vec![0usize; width];
        for k in 0..height {
            let y = if backwards { height - 1 - k } else { k };
            for (pixel, count) in grown[y * width..(y + 1) * width].iter_mut().zip(&mut counts) {
                *count = if *pixel == 1 { reach + 1 } else { count.saturating_sub(1) };
                if *count > 0 && *pixel == 0 {
                    *pixel = 2;
                }
            }
        }
    }
    grown.iter_mut().for_each(|pixel| *pixel = u8::from(*pixel != 0));
    grown
}

/// Least thickness of a wall, metres.
pub(super) const THINNEST_M: f64 = 0.06;

/// Side of the square that tells walls from strokes, pixels, and the thickness of the thinnest walls; `None` where nothing
/// is as thick as a wall.
///
/// Walls are at least 6 cm and two pixels thick. The thinnest walls are those of the least thickness up to which an eighth
/// of the length of all that is so thick lies; the square is six tenths of that. Length counts, because thin walls have
/// little area beside thick ones; slanted and blurred ones have several thicknesses.
pub(super) fn wall_square(mask: &[u8], width: usize, metres_per_pixel: f64) -> Option<(usize, f64)> {
    const THICKEST_M: f64 = 0.8;
    const LEAST_WALL_M: f64 = 1.0;
    const SHARE: f64 = 0.12;
    let area = |mask: &[u8]| mask.iter().filter(|&&m| m != 0).count() as f64;
    let first = ((THINNEST_M / metres_per_pixel).ceil() as usize).max(2);
    let mut kept = open(mask, width, first);
    // Letters and ticks are no measure.
    let pieces = Components::of(&kept, width, 1, Neighbours::Eight);
    for piece in pieces.all.iter().filter(|p| f64::from(p.larger_side()) * metres_per_pixel < LEAST_WALL_M) {
        pieces.paint(piece, &mut kept, width, 0);
    }
    drop(pieces);
    let (mut side, mut before) = (first, area(&kept));
    let mut lengths = Vec::new();
    while before > 0.0 && (side as f64) * metres_per_pixel < THICKEST_M {
        let next = (side * 5 / 4).max(side + 1);
        kept = open(&kept, width, next);
        let left = area(&kept);
        let thickness = side.midpoint(next - 1) as f64;
        lengths.push((thickness, (before - left) / thickness));
        (side, before) = (next, left);
    }
    let all: f64 = lengths.iter().map(|(_, length)| length).sum();
    let mut seen = 0.0;
    let (thinnest, _) = lengths.into_iter().find(|(_, length)| {
        seen += length;
        seen >= SHARE * all && seen > 0.0
    })?;
    Some((((thinnest * 0.6).ceil() as usize).max(2), thinnest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stays_exactly_and_a_line_goes() {
        let width = 30;
        let mut mask = vec![0u8; width * 20];
        for y in 4..9 {
            mask[y * width + 2..y * width + 28].fill(1);
        }
        let wall = mask.clone();
        for y in 9..18 {
            mask[y * width + 12] = 1;
        }
        assert_eq!(open(&mask, width, 4), wall);
        let grown = grow(&wall, width, 2);
        assert_eq!(grown.iter().filter(|&&g| g != 0).count(), 30 * 9);
    }
}
