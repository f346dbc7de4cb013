//! Thickness of strokes: what remains of a drawing under openings by squares.

use std::ops::Range;

use super::components::{Component, Components, Neighbours};

/// Keeps the pixels that a square of `side` pixels of non-zero pixels covers.
pub(super) fn open(mask: &[u8], width: usize, side: usize) -> Vec<u8> {
    if side < 2 {
        return mask.to_vec();
    }
    let mut kept = ones(mask);
    // Upper left corners of squares, and all that the squares cover.
    join_square(&mut kept, width, side, false, |pixel, next| pixel & next);
    spread(&mut kept, width, side, true);
    kept
}

fn ones(mask: &[u8]) -> Vec<u8> {
    mask.iter().map(|&pixel| u8::from(pixel != 0)).collect()
}

/// Makes each pixel 1 that has a 1 in the square of `side` pixels to its right and below, or to its left and above: `before`.
pub(super) fn spread(mask: &mut [u8], width: usize, side: usize, before: bool) {
    join_square(mask, width, side, before, |pixel, next| pixel | next);
}

/// Joins each pixel with all others of the square of `side` pixels that begins or ends there; beyond the rim are zeros.
fn join_square(mask: &mut [u8], width: usize, side: usize, before: bool, join: impl Fn(u64, u64) -> u64) {
    along_rows(mask, width, side, before, &join);
    across_rows(mask, width, side, before, &join);
}

/// Distances at which a row of pixels has to be joined with itself, one after the other, so that each pixel has been joined
/// with `side - 1` neighbours: they double, as the neighbours have been joined as well.
fn distances(side: usize) -> impl Iterator<Item = usize> {
    let mut joined = 1;
    std::iter::from_fn(move || {
        let step = joined.min(side - joined);
        joined += step;
        (step > 0).then_some(step)
    })
}

/// Joins eight pixels at once.
fn join_all(pixels: &mut [u8], others: &[u8], join: impl Fn(u64, u64) -> u64) {
    let ((pixels, rest), (others, others_rest)) = (pixels.as_chunks_mut(), others.as_chunks());
    for (pixels, &others) in pixels.iter_mut().zip(others) {
        *pixels = join(u64::from_ne_bytes(*pixels), u64::from_ne_bytes(others)).to_ne_bytes();
    }
    for (pixel, &other) in rest.iter_mut().zip(others_rest) {
        *pixel = join(u64::from(*pixel), u64::from(other)) as u8;
    }
}

/// Joins each pixel with the `side - 1` pixels that follow in its row, or come before it; beyond the rim are zeros.
fn along_rows(mask: &mut [u8], width: usize, side: usize, before: bool, join: impl Fn(u64, u64) -> u64) {
    let mut earlier = vec![0; width];
    for row in mask.chunks_exact_mut(width) {
        for step in distances(side.min(width + 1)) {
            let inner = width - step;
            earlier.copy_from_slice(row);
            let (with, others, rim) = if before {
                let (rim, with) = row.split_at_mut(step);
                (with, &earlier[..inner], rim)
            } else {
                let (with, rim) = row.split_at_mut(inner);
                (with, &earlier[step..], rim)
            };
            join_all(with, others, &join);
            rim.iter_mut().for_each(|pixel| *pixel = join(u64::from(*pixel), 0) as u8);
        }
    }
}

/// The same within columns.
fn across_rows(mask: &mut [u8], width: usize, side: usize, before: bool, join: impl Fn(u64, u64) -> u64) {
    let height = mask.len() / width.max(1);
    for step in distances(side.min(height + 1)) {
        // In the order in which the neighbour is still as it was.
        for k in 0..height {
            let y = if before { height - 1 - k } else { k };
            let own = y * width..(y + 1) * width;
            if k + step >= height {
                mask[own].iter_mut().for_each(|pixel| *pixel = join(u64::from(*pixel), 0) as u8);
                continue;
            }
            let (row, other) = if before {
                let (above, below) = mask.split_at_mut(own.start);
                (&mut below[..width], &above[(y - step) * width..][..width])
            } else {
                let (above, below) = mask.split_at_mut((y + step) * width);
                (&mut above[own], &below[..width])
            };
            join_all(row, other, &join);
        }
    }
}

/// What of a mask is thinner than some pixels: strokes of saturated colour; broad areas are highlights.
pub(super) fn strokes(mask: &[u8], width: usize, thickest_px: f64) -> Vec<u8> {
    if mask.is_empty() {
        return Vec::new();
    }
    let broad = open(mask, width, (thickest_px.round() as usize).max(3));
    mask.iter().zip(&broad).map(|(&c, &b)| c & (1 - b)).collect()
}

/// The pieces of a mask that are thinner than some pixels everywhere: panes, where broad areas of their colour are floors, and
/// so is what the leaf of a door cuts off from them.
pub(super) fn slim(mask: &[u8], width: usize, thickest_px: f64) -> Vec<u8> {
    /// Share of the box around it that a slanting pane fills at most.
    const FILLED: f64 = 0.35;
    let mut slim = strokes(mask, width, thickest_px);
    let pieces = Components::of(mask, width, 1, Neighbours::Four);
    let is_broad = |piece: &&Component| {
        let [w, h] = piece.size().map(f64::from);
        let is_box = w.min(h) > thickest_px && piece.area as f64 > FILLED * w * h;
        is_box || pieces.ranges(piece, width).flatten().any(|at| slim[at] == 0)
    };
    let broad: Vec<&Component> = pieces.all.iter().filter(is_broad).collect();
    broad.into_iter().for_each(|piece| pieces.paint(piece, &mut slim, width, 0));
    slim
}

/// The places of a row that are not zero.
pub(super) fn places(row: &[u8]) -> impl Iterator<Item = usize> {
    // Drawings are mostly empty: many pixels at once are looked at.
    const TOGETHER: usize = 32;
    let chunks =
        row.chunks(TOGETHER).enumerate().filter(|(_, chunk)| chunk.iter().fold(0, |all, pixel| all | pixel) != 0);
    chunks.flat_map(|(k, chunk)| {
        chunk.iter().enumerate().filter(|(_, pixel)| **pixel != 0).map(move |(at, _)| k * TOGETHER + at)
    })
}

/// A mask with its rows and columns exchanged.
pub(super) fn transposed(mask: &[u8], width: usize) -> Vec<u8> {
    let height = mask.len() / width;
    let mut turned = vec![0; mask.len()];
    for (y, row) in mask.chunks_exact(width).enumerate() {
        places(row).for_each(|x| turned[x * height + y] = row[x]);
    }
    turned
}

/// The stretches of ascending places, with breaks of up to `longest` within.
pub(super) fn runs(places: impl Iterator<Item = usize>, longest: usize) -> impl Iterator<Item = Range<usize>> {
    let mut all: Vec<Range<usize>> = Vec::new();
    for k in places {
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
    let mut grown = ones(mask);
    [false, true].into_iter().for_each(|before| spread(&mut grown, width, reach + 1, before));
    grown
}

/// Least thickness of a wall, metres, and the greatest that is measured; both of massive walls.
pub(super) const THINNEST_M: f64 = 0.06;
const THICKEST_M: f64 = 0.8;
const MASSIVE_M: [f64; 2] = [0.2, 2.1];

/// How thick the walls of a mask are, pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thickness {
    /// Side of the square that tells walls from strokes.
    pub(super) square: usize,
    /// Thickness of the thinnest walls, and of those that have the most area.
    pub(super) thinnest: f64,
    pub(super) usual: f64,
}

impl Thickness {
    /// Measures how thick the walls of a mask are; `None` where nothing is as thick as a wall.
    ///
    /// Walls are at least 6 cm and two pixels thick, and thicker than strokes. The thinnest walls are those of the least thickness
    /// up to which an eighth of the length of all that is so thick lies; the square is six tenths of that. Length counts, because
    /// thin walls have little area beside thick ones; slanted and blurred ones have several thicknesses.
    pub(super) fn of(
        mask: &[u8],
        width: usize,
        metres_per_pixel: f64,
        is_massive: bool,
        stroke_px: usize,
    ) -> Option<Thickness> {
        const LEAST_WALL_M: f64 = 1.0;
        /// Least length of a door's leaf, and share of its box that it fills.
        const SHORTEST_LEAF_M: f64 = 0.55;
        const LEAF_FILL: f64 = 0.8;
        const SHARE: f64 = 0.12;
        const SQUARE: f64 = 0.6;
        let [thinnest_m, thickest_m] = if is_massive { MASSIVE_M } else { [THINNEST_M, THICKEST_M] };
        // Of zeros and ones, eight at once.
        let area = |mask: &[u8]| {
            let (eights, rest) = mask.as_chunks();
            let of_eights: u64 = eights.iter().map(|&eight| u64::from(u64::from_ne_bytes(eight).count_ones())).sum();
            (of_eights + rest.iter().map(|&one| u64::from(one)).sum::<u64>()) as f64
        };
        let first = ((thinnest_m / metres_per_pixel).ceil() as usize).max(stroke_px + 1).max(2);
        // Letters, ticks and the leaves of doors are no measure.
        let is_short = |piece: &Component| f64::from(piece.larger_side()) * metres_per_pixel < LEAST_WALL_M;
        let is_leaf = |piece: &Component| {
            let [w, h] = piece.size().map(f64::from);
            is_short(piece) && w.max(h) * metres_per_pixel >= SHORTEST_LEAF_M && piece.area as f64 >= LEAF_FILL * w * h
        };
        let erase = |mask: &mut [u8], is_none: &dyn Fn(&Component) -> bool| {
            let pieces = Components::of(mask, width, 1, Neighbours::Eight);
            pieces.all.iter().filter(|piece| is_none(piece)).for_each(|piece| pieces.paint(piece, mask, width, 0));
        };
        let mut kept = open(mask, width, first);
        erase(&mut kept, &is_short);
        let (mut side, mut left) = (first, area(&kept));
        let mut lengths = Vec::new();
        while left > 0.0 && (side as f64) * metres_per_pixel < thickest_m {
            let next = (side * 5 / 4).max(side + 1);
            let opened = open(&kept, width, next);
            kept.iter_mut().zip(&opened).for_each(|(kept, opened)| *kept &= opened ^ 1);
            erase(&mut kept, &is_leaf);
            let thickness = side.midpoint(next - 1) as f64;
            lengths.push((thickness, area(&kept) / thickness));
            kept = opened;
            (side, left) = (next, area(&kept));
        }
        // The least thickness up to which a share of all lies.
        let up_to = |share: f64, of: fn(&(f64, f64)) -> f64| {
            let all: f64 = lengths.iter().map(of).sum();
            let mut seen = 0.0;
            let found = lengths.iter().find(|each| {
                seen += of(each);
                seen >= share * all && seen > 0.0
            });
            found.map(|(thickness, _)| *thickness)
        };
        let thinnest = up_to(SHARE, |(_, length)| *length)?;
        let usual = up_to(0.5, |(thickness, length)| thickness * length)?;
        let square = ((thinnest * SQUARE).ceil() as usize).max(stroke_px + 1).max(2);
        Some(Thickness { square, thinnest, usual })
    }
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
