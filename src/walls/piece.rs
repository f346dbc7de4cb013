//! Straight pieces of a boundary and the joints between them.

use super::line::{Line, Moments};
use super::runs::Runs;

/// Pieces with at least this many pixel edges ignore one at each end, blurred by the corner.
const TRIMMED_FROM: usize = 8;

/// A straight piece of a boundary: the runs `from..to` and their line, in the boundary's direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) line: Line,
    /// Whether the line runs exactly along pixel edges.
    pub(super) exact: bool,
}

impl Piece {
    /// Fits a piece to the runs `from..to`.
    pub(super) fn new(runs: &Runs, from: usize, to: usize) -> Piece {
        let (mut line, exact) = line_of(runs, from, to);
        let ([x0, y0], [x1, y1]) = (runs.corner(from), runs.corner(to));
        if (x1 - x0) * line.along[0] + (y1 - y0) * line.along[1] < 0.0 {
            line.along = line.along.map(|c| -c);
        }
        Piece { from, to, line, exact }
    }

    /// Distance between its ends, pixels.
    pub(super) fn length(&self, runs: &Runs) -> f64 {
        squared_distance(runs.corner(self.from), runs.corner(self.to)).sqrt()
    }
}

/// Joint of two neighbouring pieces.
#[derive(Clone, Copy, Debug)]
pub(super) enum Joint {
    /// Intersection of their lines.
    Crossing([f64; 2]),
    /// Ends of both lines, which do not intersect nearby.
    Step([f64; 2], [f64; 2]),
}

impl Joint {
    /// The intersection, or both ends.
    pub(super) fn points(self) -> impl Iterator<Item = [f64; 2]> {
        let (first, second) = match self {
            Joint::Crossing(at) => (at, None),
            Joint::Step(a, b) => (a, Some(b)),
        };
        [first].into_iter().chain(second)
    }
}

/// Fits the line of the runs `from..to`; returns whether it is exactly along pixel edges.
fn line_of(runs: &Runs, from: usize, to: usize) -> (Line, bool) {
    let (from, to) = without_caps(runs, from, to);
    let edges = runs.edges(from, to);
    let trim = usize::from(edges >= TRIMMED_FROM);
    let samples = || runs.samples_of(from, to).skip(trim).take(edges - 2 * trim);
    let first = samples().next().map_or([0.0; 2], |s| s.at);
    let direction = runs.direction(from);
    if (from..to).all(|k| runs.direction(k) == direction) {
        let across = direction.across();
        if samples().all(|s| s.at[across] == first[across]) {
            return (Line { through: first, along: direction.step().map(f64::from) }, true);
        }
    }
    let mut moments = Moments::default();
    for s in samples() {
        moments.add(s, first);
    }
    let mut line = moments.line().line;
    line.through = [line.through[0] + first[0], line.through[1] + first[1]];
    (line, false)
}

/// Trims the pixel edges across a piece's ends, if a straight stretch remains: they belong to the corner.
fn without_caps(runs: &Runs, from: usize, to: usize) -> (usize, usize) {
    let across = runs.main_across(from, to);
    let is_main = |k: &usize| runs.direction(*k).across() == across;
    let first = (from..to).find(is_main).unwrap_or(from);
    let last = (from..to).rev().find(is_main).unwrap_or(to - 1);
    let straight = (first..last).all(|k| runs.direction(k) == runs.direction(last));
    if straight { (first, last + 1) } else { (from, to) }
}

/// Squared distance of two points.
pub(super) fn squared_distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    (ax - bx) * (ax - bx) + (ay - by) * (ay - by)
}
