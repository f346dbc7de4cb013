//! Computes how far along a boundary one straight line fits.
//!
//! A line v = a u + b is within tolerance of a sample (u, v) if the point (a, b) lies between two parallel lines. Each
//! sample clips a convex polygon of lines; it is empty when no line is left (O'Rourke 1981, doi 10.1145/358746.358758).
//! For the boundary of a drawn straight edge and a tolerance of half a pixel, these are exactly the lines with the same
//! drawing.

use super::runs::{Direction, Runs};

/// Rounding slack of the tolerance, which drawn edges exhaust to the last bit.
const HAIR: f64 = 1e-6;
/// Largest slope; steeper lines are found with the axes swapped.
const STEEPEST: f64 = 1.0 + 1e-3;
const FAR: f64 = 1e6;

/// A convex set of lines v = a u + b, as a polygon in (a, b).
#[derive(Clone, Debug)]
struct Lines {
    corners: Vec<[f64; 2]>,
}

impl Lines {
    fn all() -> Lines {
        Lines { corners: vec![[-STEEPEST, -FAR], [STEEPEST, -FAR], [STEEPEST, FAR], [-STEEPEST, FAR]] }
    }

    /// Keeps the lines between `low` and `high` at `u`; returns whether any is left.
    fn keep(&mut self, u: f64, low: f64, high: f64, spare: &mut Vec<[f64; 2]>) -> bool {
        self.cut(|[a, b]| high - a * u - b, spare) && self.cut(|[a, b]| a * u + b - low, spare)
    }

    /// Clips the side where `inside` is negative (Sutherland and Hodgman 1974).
    fn cut(&mut self, inside: impl Fn([f64; 2]) -> f64, spare: &mut Vec<[f64; 2]>) -> bool {
        if self.corners.iter().all(|&c| inside(c) >= 0.0) {
            return !self.corners.is_empty();
        }
        spare.clear();
        let mut last = self.corners[self.corners.len() - 1];
        let mut last_side = inside(last);
        for &corner in &self.corners {
            let side = inside(corner);
            if (side >= 0.0) != (last_side >= 0.0) {
                let t = last_side / (last_side - side);
                spare.push([last[0] + (corner[0] - last[0]) * t, last[1] + (corner[1] - last[1]) * t]);
            }
            if side >= 0.0 {
                spare.push(corner);
            }
            (last, last_side) = (corner, side);
        }
        std::mem::swap(&mut self.corners, spare);
        !self.corners.is_empty()
    }

    /// Whether two sets share a line: neither lies entirely beyond a side of the other.
    fn meets(&self, other: &Lines) -> bool {
        !self.has_beyond(other) && !other.has_beyond(self)
    }

    fn has_beyond(&self, other: &Lines) -> bool {
        let n = self.corners.len();
        (0..n).any(|k| {
            let ([a0, b0], [a1, b1]) = (self.corners[k], self.corners[(k + 1) % n]);
            let (da, db) = (a1 - a0, b1 - b0);
            other.corners.iter().all(|&[a, b]| da * (b - b0) - db * (a - a0) < -HAIR * 1e-6)
        })
    }
}

/// Returns, per run, the end of the longest straight piece that starts there: at least `i + 1`, at most the number of
/// runs, or `i` plus that on a closed boundary.
pub(super) fn reaches(runs: &Runs) -> Vec<usize> {
    let mut flat = reaches_along(runs, 0);
    let steep = reaches_along(runs, 1);
    for (far, other) in flat.iter_mut().zip(steep) {
        *far = (*far).max(other);
    }
    flat
}

/// As [`reaches`], with lines closer to axis `u` (0: x, 1: y) that never turn back along it.
///
/// A sliding window of runs. A stack of the sets of its back part allows removing the first run, so every run is added
/// at most twice.
fn reaches_along(runs: &Runs, u: usize) -> Vec<usize> {
    let count = runs.len();
    let mut result = vec![0; count];
    let mut spare = Vec::new();
    let mut back: Vec<Lines> = Vec::new();
    let mut front = Lines::all();
    let (mut back_end, mut end) = (0, 0);
    // The last run that goes up and down along u, plus one.
    let mut last_way = [0usize; 2];
    for first in 0..count {
        end = end.max(first);
        if first >= back_end {
            back.clear();
            let mut lines = Lines::all();
            for k in (first..end).rev() {
                add(&mut lines, runs, k, u, &mut spare);
                back.push(lines.clone());
            }
            (front, back_end) = (Lines::all(), end);
        }
        let last = if runs.closed { first + count } else { count };
        while end < last {
            let way = way_along(runs.direction(end), u);
            if way.is_some_and(|w| last_way[1 - w] > first) {
                break;
            }
            let mut longer = front.clone();
            if !add(&mut longer, runs, end, u, &mut spare) {
                break;
            }
            if back_end > first && !longer.meets(&back[back_end - first - 1]) {
                break;
            }
            front = longer;
            end += 1;
            if let Some(w) = way {
                last_way[w] = end;
            }
        }
        result[first] = end.max(first + 1);
        if end == first {
            // Even one run is not straight: it forms a piece, and the window restarts after it.
            end = first + 1;
            back_end = end;
            front = Lines::all();
            if let Some(w) = way_along(runs.direction(first), u) {
                last_way[w] = end;
            }
        }
    }
    result
}

/// Adds the samples of a run; returns whether a line is left.
fn add(lines: &mut Lines, runs: &Runs, k: usize, u: usize, spare: &mut Vec<[f64; 2]>) -> bool {
    let v = 1 - u;
    runs.samples(k).iter().all(|s| {
        let slack = s.tolerance + HAIR;
        lines.keep(s.at[u], s.at[v] - slack, s.at[v] + slack, spare)
    })
}

/// Returns 0 for a run that goes up along axis `u`, 1 for one that goes down.
fn way_along(direction: Direction, u: usize) -> Option<usize> {
    let step = direction.step()[u];
    (step != 0).then_some(usize::from(step < 0))
}
