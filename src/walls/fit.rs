//! From a boundary to a polyline: straight pieces, their lines, and the corners where neighbouring lines cross.

use super::curve::Curves;
use super::line::Line;
use super::piece::{Joint, Piece, squared_distance};
use super::polygon::breaks;
use super::runs::Runs;

/// An image side as a line: a fixed x or y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SideLine {
    /// 0 for a fixed x, 1 for a fixed y.
    pub(super) axis: usize,
    pub(super) at: f64,
}

/// A corner may lie this far from the place where the boundary was cut, per cosine of half the turn, pixels.
const CORNER_REACH: f64 = 0.85;
/// Ends of an open boundary may slide this far along the image's side, pixels.
const END_REACH: f64 = 1.5;
/// Cosine of the turn from which a corner counts as flat: 25 degrees.
const FLAT: f64 = 0.9;
/// A point this near to the way past it is no corner, pixels.
const STRAIGHT: f64 = 0.01;
/// Ends of neighbouring pieces closer than this become one point, pixels: less than the smallest drawn step.
const SAME_POINT: f64 = 0.9;
/// The same where an oblique boundary goes on, whose pieces may each be off by half a pixel.
const SAME_POINT_OBLIQUE: f64 = 1.4;

/// The corners of a boundary, in pixels. An open one ends on the two image sides given.
pub(super) fn polyline(runs: &Runs, ends: Option<[SideLine; 2]>) -> Vec<[f64; 2]> {
    let starts = breaks(runs);
    let count = starts.len();
    let end_of = |k: usize| match starts.get(k + 1) {
        Some(&next) => next,
        None if runs.closed => starts[0] + runs.len(),
        None => runs.len(),
    };
    let pieces: Vec<Piece> = (0..count).map(|k| Piece::new(runs, starts[k], end_of(k))).collect();
    let pieces = with_single_steps(runs, pieces);
    let count = pieces.len();
    let joints: Vec<Option<Joint>> = (0..count)
        .map(|k| (k > 0 || runs.closed).then(|| joint(runs, &pieces[(k + count - 1) % count], &pieces[k])))
        .collect();
    let curves = Curves::find(runs, &pieces, &joints);
    let mut points = Vec::with_capacity(count + 1);
    for (k, &own) in joints.iter().enumerate() {
        match (curves.joint(k).map(Joint::Crossing).or(own), ends) {
            (Some(Joint::Crossing(at)), _) => points.push(at),
            (Some(Joint::Step(a, b)), _) => points.extend([a, b]),
            (None, Some([start, _])) => points.push(end_on_side(&pieces[0].line, runs.corner(0), start)),
            (None, None) => {}
        }
        points.extend(curves.middle(k));
    }
    if let Some([_, end]) = ends {
        points.push(end_on_side(&pieces[count - 1].line, runs.corner(runs.len()), end));
    }
    without_straight_corners(points, runs.closed)
}

/// Splits pieces that have a single step between neighbours that run along pixel edges.
///
/// A line with one step may be drawn slightly oblique, or be two walls one pixel apart. In a plan whose walls run
/// along the pixels it is the latter.
fn with_single_steps(runs: &Runs, pieces: Vec<Piece>) -> Vec<Piece> {
    let count = pieces.len();
    let mut split = Vec::with_capacity(count);
    for (k, piece) in pieces.iter().enumerate() {
        let across = runs.main_across(piece.from, piece.to);
        // Square to this one, and along pixel edges; or an image side.
        let is_square = |neighbour: Option<usize>| {
            neighbour.is_none_or(|n| pieces[n].exact && runs.main_across(pieces[n].from, pieces[n].to) != across)
        };
        let before = (k > 0 || runs.closed).then(|| (k + count - 1) % count);
        let after = (k + 1 < count || runs.closed).then(|| (k + 1) % count);
        match single_step(runs, piece).filter(|_| is_square(before) && is_square(after)) {
            Some(step) => split.extend([Piece::new(runs, piece.from, step), Piece::new(runs, step, piece.to)]),
            None => split.push(*piece),
        }
    }
    split
}

/// The run that steps, in a piece that has just one step amid its main direction.
fn single_step(runs: &Runs, piece: &Piece) -> Option<usize> {
    let across = runs.main_across(piece.from, piece.to);
    let is_main = |k: &usize| runs.direction(*k).across() == across;
    let first = (piece.from..piece.to).find(is_main)?;
    let last = (piece.from..piece.to).rev().find(is_main)?;
    let mut steps = (first..last).filter(|k| !is_main(k));
    let step = steps.next()?;
    let hard = runs.samples_of(first, last + 1).all(|s| s.at.iter().any(|v| v.fract() == 0.0));
    (hard && steps.next().is_none()).then_some(step)
}

/// Drops points at which the polyline does not turn.
fn without_straight_corners(points: Vec<[f64; 2]>, closed: bool) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    let n = points.len();
    for (k, &p) in points.iter().enumerate() {
        let before = kept.last().copied().or(closed.then(|| points[n - 1]));
        let after = if k + 1 < n { Some(points[k + 1]) } else { closed.then(|| kept.first().copied().unwrap_or(p)) };
        match (before, after) {
            (Some(a), Some(b)) if is_between(a, p, b) => {}
            _ => kept.push(p),
        }
    }
    if kept.len() < 3 && closed { points } else { kept }
}

/// Whether the way from `a` to `b` over `p` is straight, or `p` is no more than a repetition.
fn is_between(a: [f64; 2], p: [f64; 2], b: [f64; 2]) -> bool {
    let ([ux, uy], [vx, vy]) = ([p[0] - a[0], p[1] - a[1]], [b[0] - p[0], b[1] - p[1]]);
    let (ahead, length) = (ux * vx + uy * vy, squared_distance(a, b).sqrt());
    squared_distance(a, p) < 1e-12 || (ahead > 0.0 && (ux * vy - uy * vx).abs() <= STRAIGHT * length)
}

/// How two neighbouring pieces meet: where their lines cross if that is nearby; if not, square to the lines, as at
/// the end of a wall one pixel thick or at a step of two pixels.
fn joint(runs: &Runs, before: &Piece, after: &Piece) -> Joint {
    let cut = runs.corner(after.from);
    let (a, b) = (before.line, after.line);
    if let Some(crossing) = a.crossing(&b) {
        let cosine = (a.along[0] * b.along[0] + a.along[1] * b.along[1]).clamp(-1.0, 1.0);
        // A corner is drawn within half a pixel's diagonal of its place, a sharp one cut off farther back.
        let sharp = CORNER_REACH / ((1.0 + cosine) * 0.5).sqrt().max(0.25);
        // Flat corners slide along both lines; they stay within the shorter piece's nearer half.
        let shorter = before.length(runs).min(after.length(runs));
        let reach = if cosine > FLAT { (shorter * 0.5).max(sharp) } else { sharp };
        if squared_distance(crossing, cut) <= reach * reach {
            return Joint::Crossing(crossing);
        }
    }
    let [p, q] = [a.project(cut), b.project(cut)];
    let goes_on = a.along[0] * b.along[0] + a.along[1] * b.along[1] > 0.0;
    let same = if goes_on && !(before.exact && after.exact) { SAME_POINT_OBLIQUE } else { SAME_POINT };
    if squared_distance(p, q) <= same * same {
        Joint::Crossing([(p[0] + q[0]) * 0.5, (p[1] + q[1]) * 0.5])
    } else {
        Joint::Step(p, q)
    }
}

/// Where a line meets an image side, near the pixel corner where the boundary does.
fn end_on_side(line: &Line, corner: [f64; 2], side: SideLine) -> [f64; 2] {
    let mut end = corner;
    end[side.axis] = side.at;
    let along = line.along[side.axis];
    if along.abs() > 0.1 {
        let t = (side.at - line.through[side.axis]) / along;
        let other = 1 - side.axis;
        let place = line.through[other] + t * line.along[other];
        if (place - corner[other]).abs() <= END_REACH {
            end[other] = place;
        }
    }
    end
}
