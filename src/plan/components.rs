//! Connected components of an image, as runs of pixels.
//!
//! imageproc's label image takes four bytes a pixel; runs take a few per row.

use std::ops::Range;

use crate::math::DisjointSets;

/// A horizontal run of pixels, `from..to` in row `y`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) y: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// A connected component.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Component {
    /// Number of pixels.
    pub(super) area: usize,
    /// Least x and least y.
    pub(super) min: [u32; 2],
    /// One beyond the greatest x and the greatest y.
    pub(super) end: [u32; 2],
    runs: Range<usize>,
}

/// How far apart two ranges of pixels are; 0 if they meet.
pub(super) fn apart([a, a_end]: [u32; 2], [b, b_end]: [u32; 2]) -> u32 {
    b.saturating_sub(a_end).max(a.saturating_sub(b_end))
}

/// A pixel and those beside it, row by row. Above the first row and below the last one the places are those of no pixel.
pub(super) fn around(at: usize, width: usize) -> impl Iterator<Item = usize> {
    let rows = [at.wrapping_sub(width), at, at + width];
    rows.into_iter().flat_map(|row| [row.wrapping_sub(1), row, row.wrapping_add(1)])
}

/// What lies between two pixels of a mask that follow each other in one row, or in one column if `along` is 1: its first pixel,
/// the step to the next, and how many there are.
pub(super) fn spaces(mask: &[u8], width: usize, along: usize) -> Vec<(usize, usize, usize)> {
    let height = mask.len() / width;
    let ([length, lines], [step, between]) =
        if along == 0 { ([width, height], [1, width]) } else { ([height, width], [width, 1]) };
    let mut found = Vec::new();
    for line in 0..lines {
        let mut last = None;
        for k in (0..length).filter(|k| mask[line * between + k * step] != 0) {
            found.extend(last.map(|last| (line * between + (last + 1) * step, step, k - last - 1)));
            last = Some(k);
        }
    }
    found
}

impl Component {
    /// Its box: least x and y, one beyond the greatest.
    pub(super) fn around(&self) -> [u32; 4] {
        [self.min[0], self.min[1], self.end[0], self.end[1]]
    }

    pub(super) fn size(&self) -> [u32; 2] {
        [self.end[0] - self.min[0], self.end[1] - self.min[1]]
    }

    pub(super) fn larger_side(&self) -> u32 {
        let [width, height] = self.size();
        width.max(height)
    }

    /// Whether it reaches to a side of the image.
    pub(super) fn is_at_side(&self, width: usize, height: usize) -> bool {
        self.min.contains(&0) || self.end[0] as usize == width || self.end[1] as usize == height
    }
}

/// The components of an image, ordered by their first pixel in reading order.
pub(super) struct Components {
    runs: Vec<Run>,
    pub(super) all: Vec<Component>,
}

/// Neighbourhood of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Neighbours {
    /// Pixels that share a side.
    Four,
    /// Pixels that share a side or a corner.
    Eight,
}

impl Components {
    /// Finds the components of the pixels with `value`.
    pub(super) fn of(pixels: &[u8], width: usize, value: u8, neighbours: Neighbours) -> Components {
        let (runs, row_starts) = find_runs(pixels, width, value);
        // A component's first run is its least: components keep the order of these.
        let mut joined = DisjointSets::new(runs.len());
        let reach = u32::from(neighbours == Neighbours::Eight);
        for rows in row_starts.windows(3) {
            let (mut above, mut below) = (rows[0], rows[1]);
            while above < rows[1] && below < rows[2] {
                let (a, b) = (runs[above], runs[below]);
                if a.from < b.to + reach && b.from < a.to + reach {
                    joined.join(above, below);
                }
                if a.to < b.to {
                    above += 1;
                } else {
                    below += 1;
                }
            }
        }
        group(runs, joined)
    }

    pub(super) fn runs(&self, component: &Component) -> &[Run] {
        &self.runs[component.runs.clone()]
    }

    /// The runs of a component as ranges of pixels.
    pub(super) fn ranges(&self, component: &Component, width: usize) -> impl Iterator<Item = Range<usize>> {
        let range = move |run: &Run| {
            let row = run.y as usize * width;
            row + run.from as usize..row + run.to as usize
        };
        self.runs(component).iter().map(range)
    }

    /// Tells at which component a pixel is.
    pub(super) fn index(&self, width: usize) -> impl Fn(usize) -> Option<usize> {
        let of = |(k, piece)| self.ranges(piece, width).map(move |range| (range.start, range.end, k));
        let mut runs: Vec<(usize, usize, usize)> = self.all.iter().enumerate().flat_map(of).collect();
        runs.sort_unstable();
        move |at| {
            let before = runs.partition_point(|&(from, ..)| from <= at).checked_sub(1)?;
            let (_, end, k) = runs[before];
            (at < end).then_some(k)
        }
    }

    /// The first pixel of a component.
    pub(super) fn first(&self, component: &Component, width: usize) -> usize {
        let first = self.runs(component)[0];
        first.y as usize * width + first.from as usize
    }

    /// Sets the pixels of a component to `value`.
    pub(super) fn paint<T: Copy>(&self, component: &Component, pixels: &mut [T], width: usize, value: T) {
        self.ranges(component, width).for_each(|range| pixels[range].fill(value));
    }

    /// Whether the mask has a 1 under a component.
    pub(super) fn touches(&self, component: &Component, mask: &[u8], width: usize) -> bool {
        self.ranges(component, width).any(|range| mask[range].contains(&1))
    }
}

/// Returns the runs row by row, and the index of each row's first run.
fn find_runs(pixels: &[u8], width: usize, value: u8) -> (Vec<Run>, Vec<usize>) {
    let mut runs = Vec::new();
    let mut row_starts = vec![0];
    for (y, row) in pixels.chunks_exact(width).enumerate() {
        let mut x = 0;
        while let Some(skip) = row[x..].iter().position(|&p| p == value) {
            let from = x + skip;
            let to = row[from..].iter().position(|&p| p != value).map_or(width, |n| from + n);
            runs.push(Run { y: y as u32, from: from as u32, to: to as u32 });
            x = to;
        }
        row_starts.push(runs.len());
    }
    (runs, row_starts)
}

fn group(runs: Vec<Run>, mut joined: DisjointSets) -> Components {
    const NONE: u32 = u32::MAX;
    let mut number_of = vec![NONE; runs.len()];
    let mut counts: Vec<usize> = Vec::new();
    for k in 0..runs.len() {
        let top = joined.least(k);
        if number_of[top] == NONE {
            number_of[top] = counts.len() as u32;
            counts.push(0);
        }
        number_of[k] = number_of[top];
        counts[number_of[k] as usize] += 1;
    }
    let mut next = Vec::with_capacity(counts.len());
    let mut all = Vec::with_capacity(counts.len());
    let mut start = 0;
    for count in counts {
        next.push(start);
        let runs = start..start + count;
        all.push(Component { area: 0, min: [u32::MAX; 2], end: [0; 2], runs });
        start += count;
    }
    let mut grouped = vec![Run { y: 0, from: 0, to: 0 }; runs.len()];
    for (k, &run) in runs.iter().enumerate() {
        let number = number_of[k] as usize;
        grouped[next[number]] = run;
        next[number] += 1;
        let piece = &mut all[number];
        piece.area += (run.to - run.from) as usize;
        piece.min = [piece.min[0].min(run.from), piece.min[1].min(run.y)];
        piece.end = [piece.end[0].max(run.to), piece.end[1].max(run.y + 1)];
    }
    Components { runs: grouped, all }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn areas(rows: &[&str], neighbours: Neighbours) -> Vec<usize> {
        let pixels: Vec<u8> = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'#')).collect();
        Components::of(&pixels, rows[0].len(), 1, neighbours).all.iter().map(|c| c.area).collect()
    }

    #[test]
    fn corners_join_eight_neighbours_only() {
        let rows = ["#..#", ".##.", "#..#"];
        assert_eq!(areas(&rows, Neighbours::Eight), [6]);
        assert_eq!(areas(&rows, Neighbours::Four), [1, 1, 2, 1, 1]);
    }

    #[test]
    fn arms_that_meet_late_are_one_piece() {
        let pixels: Vec<u8> = "#.#.#.#.####".bytes().map(|b| u8::from(b == b'#')).collect();
        let found = Components::of(&pixels, 4, 1, Neighbours::Four);
        assert_eq!(found.all.len(), 1);
        assert_eq!((found.all[0].min, found.all[0].end, found.all[0].area), ([0, 0], [4, 3], 8));
    }

    proptest! {
        #[test]
        fn pieces_agree_with_a_flood_fill(pixels in proptest::collection::vec(0u8..2, 63), eight: bool) {
            let (width, height) = (9i32, 7i32);
            let neighbours = if eight { Neighbours::Eight } else { Neighbours::Four };
            let found = Components::of(&pixels, width as usize, 1, neighbours);
            let mut left = pixels.clone();
            let mut areas = Vec::new();
            for first in 0..left.len() {
                let mut stack = vec![first as i32];
                let mut area = 0;
                while let Some(at) = stack.pop() {
                    if std::mem::take(&mut left[at as usize]) == 0 { continue; }
                    area += 1;
                    let (x, y) = (at % width, at / width);
                    for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
                        let within = (0..width).contains(&(x + dx)) && (0..height).contains(&(y + dy));
                        if within && (eight || dx * dy == 0) { stack.push((y + dy) * width + x + dx); }
                    }
                }
                if area > 0 { areas.push(area); }
            }
            prop_assert_eq!(found.all.iter().map(|c| c.area).collect::<Vec<_>>(), areas);
        }
    }
}
