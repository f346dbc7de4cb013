//! Fits a polyline to a boundary: straight pieces, their lines, and corners at the lines' intersections. Where two
//! polylines would cross, parts of them are reset to the pixel edges, which never cross.

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

/// Largest distance of a corner from its cut, times the cosine of half the turn, pixels.
const CORNER_REACH: f64 = 0.85;
/// Largest shift of an open boundary's end along the image's side, pixels.
const END_REACH: f64 = 1.5;
/// Cosine of the turn below which a corner counts as flat: 25 degrees.
const FLAT: f64 = 0.9;
/// Largest distance of a redundant corner from the straight line past it, pixels.
const STRAIGHT: f64 = 0.01;
/// Ends of neighbouring pieces closer than this are merged, pixels: less than the smallest drawn step.
const SAME_POINT: f64 = 0.9;
/// The same for an oblique boundary, whose pieces may each be off by half a pixel.
const SAME_POINT_OBLIQUE: f64 = 1.4;

/// A corner of a fitted boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    /// Pixels from the top left, y down.
    pub(super) at: [f64; 2],
    /// Run that starts at or contains the corner; at an open boundary's end, the number of runs.
    pub(super) run: usize,
}

/// A boundary fitted with straight pieces and curves; parts can be reset to the pixel edges.
#[derive(Debug)]
pub(super) struct Fitted {
    pub(super) runs: Runs,
    ends: Option<[SideLine; 2]>,
    pieces: Vec<Piece>,
    /// Joint of piece `k` with the previous one; `None` at the start of an open boundary.
    joints: Vec<Option<Joint>>,
    curves: Curves,
    /// Whether a run is drawn along its pixel edges, since the fitted line crossed another.
    on_edges: Vec<bool>,
    /// Whether any run is in `on_edges`.
    is_mended: bool,
}

impl Fitted {
    /// Fits a boundary; an open one ends on the two given image sides.
    pub(super) fn new(runs: Runs, ends: Option<[SideLine; 2]>) -> Fitted {
        let starts = breaks(&runs);
        let end_of = |k: usize| match starts.get(k + 1) {
            Some(&next) => next,
            None if runs.closed => starts[0] + runs.len(),
            None => runs.len(),
        };
        let pieces: Vec<Piece> = (0..starts.len()).map(|k| Piece::new(&runs, starts[k], end_of(k))).collect();
        let pieces = with_single_steps(&runs, pieces);
        let count = pieces.len();
        let joints: Vec<Option<Joint>> = (0..count)
            .map(|k| (k > 0 || runs.closed).then(|| joint(&runs, &pieces[(k + count - 1) % count], &pieces[k])))
            .collect();
        let curves = Curves::find(&runs, &pieces, &joints);
        let on_edges = vec![false; runs.len()];
        Fitted { runs, ends, pieces, joints, curves, on_edges, is_mended: false }
    }

    /// Returns the corners in order, in pixels; a closed boundary wraps around.
    pub(super) fn corners(&self) -> Vec<Corner> {
        let mut corners = Vec::with_capacity(self.pieces.len() + 1);
        for (k, piece) in self.pieces.iter().enumerate() {
            match (self.curves.joint(k).map(Joint::Crossing).or(self.joints[k]), self.ends) {
                (Some(joint), _) if self.stands(k, joint) => {
                    corners.extend(joint.points().map(|at| Corner { at, run: piece.from }));
                }
                (Some(_), _) => self.change_over(piece.from, &mut corners),
                (None, Some([start, _])) => corners.push(self.end(piece, 0, start)),
                (None, None) => {}
            }
            if !self.is_mended || !(piece.from..piece.to).any(|run| self.is_on_edges(run)) {
                let run = (piece.from + piece.to) / 2;
                corners.extend(self.curves.middle(k).map(|at| Corner { at, run }));
            } else {
                (piece.from + 1..piece.to).for_each(|run| self.change_over(run, &mut corners));
            }
        }
        if let (Some([_, end]), Some(last)) = (self.ends, self.pieces.last()) {
            corners.push(self.end(last, self.runs.len(), end));
        }
        without_straight_corners(corners, self.runs.closed)
    }

    /// Whether a run is drawn along the pixel edges; indices of a closed boundary wrap around.
    fn is_on_edges(&self, run: usize) -> bool {
        self.on_edges[run % self.on_edges.len()]
    }

    /// Returns the piece that contains a run; indices of a closed boundary wrap around.
    fn piece_of(&self, run: usize) -> &Piece {
        let first = self.pieces[0].from;
        let count = self.runs.len();
        let run = first + (run + count - first % count) % count;
        &self.pieces[self.pieces.partition_point(|piece| piece.from <= run).max(1) - 1]
    }

    /// Appends the corners before a run where a fitted line meets pixel edges or both are cut: from one line to the
    /// pixel corner, and on to the other line.
    fn change_over(&self, run: usize, corners: &mut Vec<Corner>) {
        let count = self.runs.len();
        let [before, after] = [(run + count - 1) % count, run % count];
        let cut = self.runs.corner(run);
        let [left, right] = [before, after].map(|run| (!self.on_edges[run]).then(|| self.piece_of(run)));
        let within = |a: &Piece, b: &Piece| a.from == b.from;
        if left.zip(right).is_some_and(|(a, b)| within(a, b)) {
            return;
        }
        let mut push = |at: [f64; 2]| corners.push(Corner { at, run });
        left.into_iter().for_each(|piece| push(piece.line.project(cut)));
        push(cut);
        right.into_iter().for_each(|piece| push(piece.line.project(cut)));
    }

    /// Returns an end of an open boundary, by the run that starts there (or the number of runs).
    fn end(&self, piece: &Piece, run: usize, side: SideLine) -> Corner {
        let corner = self.runs.corner(run);
        let is_cut = self.on_edges[run.min(self.runs.len() - 1)];
        Corner { at: if is_cut { corner } else { end_on_side(&piece.line, corner, side) }, run }
    }

    /// Whether all runs near the joint before piece `k` are fitted.
    fn stands(&self, k: usize, joint: Joint) -> bool {
        if !self.is_mended {
            return true;
        }
        let (count, cut_run) = (self.runs.len(), self.pieces[k].from);
        // Start and greatest length of the walks ahead and back.
        let (last, most) =
            if self.runs.closed { (cut_run + count, [count; 2]) } else { (cut_run, [count - cut_run, cut_run]) };
        let cut = self.runs.corner(cut_run);
        let squared = joint.points().map(|p| squared_distance(p, cut)).fold(0.0, f64::max);
        let reach = squared.sqrt() + 1.0;
        let near = |run: usize| squared_distance(self.runs.corner(run), cut) <= reach * reach;
        let ahead = (0..most[0]).map(|step| cut_run + step).take_while(|&run| near(run));
        let behind = (0..most[1]).map(|step| last - step).take_while(|&run| near(run));
        !ahead.chain(behind.map(|run| run - 1)).any(|run| self.is_on_edges(run))
    }

    /// Resets the fitted run of `from..to` nearest to `place`, with its neighbours, to pixel edges. `to` may wrap
    /// around. Returns whether there was one.
    pub(super) fn put_on_edges(&mut self, from: usize, to: usize, place: [f64; 2]) -> bool {
        let count = self.runs.len();
        let away = |run: usize| {
            let [a, b] = [self.runs.corner(run), self.runs.corner(run + 1)];
            let nearest = [0, 1].map(|axis| place[axis].clamp(a[axis].min(b[axis]), a[axis].max(b[axis])));
            squared_distance(nearest, place)
        };
        let fitted = (from..to).map(|run| run % count).filter(|&run| !self.on_edges[run]);
        let Some(nearest) = fitted.min_by(|&a, &b| away(a).total_cmp(&away(b)).then(a.cmp(&b))) else { return false };
        self.is_mended = true;
        self.on_edges[nearest] = true;
        if self.runs.closed || nearest > 0 {
            self.on_edges[(nearest + count - 1) % count] = true;
        }
        if self.runs.closed || nearest + 1 < count {
            self.on_edges[(nearest + 1) % count] = true;
        }
        true
    }

    /// Resets all runs to the pixel edges. Returns whether any was fitted.
    pub(super) fn put_all_on_edges(&mut self) -> bool {
        let any = self.on_edges.contains(&false);
        self.is_mended = true;
        self.on_edges.fill(true);
        any
    }
}

/// Splits a piece with a single step if its neighbours are perpendicular and along pixel edges.
///
/// A line with one step may be slightly oblique, or two walls one pixel apart. Among walls along pixel edges it is the
/// latter.
fn with_single_steps(runs: &Runs, pieces: Vec<Piece>) -> Vec<Piece> {
    let count = pieces.len();
    let mut split = Vec::with_capacity(count);
    for (k, piece) in pieces.iter().enumerate() {
        let across = runs.main_across(piece.from, piece.to);
        // Perpendicular and along pixel edges; or an image side.
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

/// Returns the only run of a piece that steps across its main direction.
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

/// Removes corners at which the polyline does not turn.
fn without_straight_corners(corners: Vec<Corner>, closed: bool) -> Vec<Corner> {
    let mut kept: Vec<Corner> = Vec::with_capacity(corners.len());
    let n = corners.len();
    for (k, &corner) in corners.iter().enumerate() {
        let before = kept.last().copied().or(closed.then(|| corners[n - 1]));
        let after =
            if k + 1 < n { Some(corners[k + 1]) } else { closed.then(|| kept.first().copied().unwrap_or(corner)) };
        match (before, after) {
            (Some(a), Some(b)) if is_between(a.at, corner.at, b.at) => {}
            _ => kept.push(corner),
        }
    }
    if kept.len() < 3 && closed { corners } else { kept }
}

/// Whether `p` lies on the straight path from `a` to `b`, or repeats `a`.
fn is_between(a: [f64; 2], p: [f64; 2], b: [f64; 2]) -> bool {
    let ([ux, uy], [vx, vy]) = ([p[0] - a[0], p[1] - a[1]], [b[0] - p[0], b[1] - p[1]]);
    let (ahead, length) = (ux * vx + uy * vy, squared_distance(a, b).sqrt());
    squared_distance(a, p) < 1e-12 || (ahead > 0.0 && (ux * vy - uy * vx).abs() <= STRAIGHT * length)
}

/// Joins two pieces where their lines cross nearby, otherwise perpendicularly. The latter occurs at the end of a wall
/// one pixel thick or at a step of two pixels.
fn joint(runs: &Runs, before: &Piece, after: &Piece) -> Joint {
    let cut = runs.corner(after.from);
    let (a, b) = (before.line, after.line);
    if let Some(crossing) = a.crossing(&b) {
        let cosine = (a.along[0] * b.along[0] + a.along[1] * b.along[1]).clamp(-1.0, 1.0);
        // A corner lies within half a pixel's diagonal of its cut, a sharp one farther back.
        let sharp = CORNER_REACH / ((1.0 + cosine) * 0.5).sqrt().max(0.25);
        // A flat corner slides along both lines, within the nearer half of the shorter piece.
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

/// Returns the intersection of a line and an image side, near the boundary's pixel corner.
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
