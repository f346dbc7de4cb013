//! Distinguishes curves from corners, so that a drawn circle gets no corners.

use super::piece::{Joint, Piece};
use super::runs::{Runs, Sample};

/// Largest turn of a curve from one piece to the next: cosine of 100 degrees.
const SHARPEST_TURN: f64 = -0.17;
/// Largest turn of the boundary beside a curved piece: cosine of 60 degrees.
const MILD_TURN: f64 = 0.5;
/// Allowed excess mean squared error of a parabola over a line on pixel edges, square pixels. Rounding to pixels alone
/// costs a flat curve 1/12.
const POLE_SLACK: f64 = 0.06;
/// Fewest samples on each side of a joint for telling curve from corner.
const FEWEST_SAMPLES: usize = 3;
/// Least sagitta of a piece that is traced as a curve, pixels.
const LEAST_SAGITTA: f64 = 0.05;

/// Curved places of a boundary: points on the curve that replace corners of its pieces.
#[derive(Debug)]
pub(super) struct Curves {
    joints: Vec<Option<[f64; 2]>>,
    middles: Vec<Option<[f64; 2]>>,
}

impl Curves {
    /// Finds the curves. `joints[k]` is before piece `k`; on an open boundary the first is `None`.
    pub(super) fn find(runs: &Runs, pieces: &[Piece], joints: &[Option<Joint>]) -> Curves {
        let count = pieces.len();
        let before = |k: usize| (k + count - 1) % count;
        let is_pole = |k: usize| {
            let after = (k + 1) % count;
            joints[k].is_some()
                && joints[after].is_some()
                && turns_round(runs, &pieces[before(k)], &pieces[k], &pieces[after])
        };
        let joints: Vec<Option<[f64; 2]>> = (0..count)
            .map(|k| {
                joints[k]?;
                let slack = if is_pole(before(k)) || is_pole(k) { POLE_SLACK } else { 0.0 };
                smooth_joint(runs, &pieces[before(k)], &pieces[k], slack)
            })
            .collect();
        let middles = (0..count)
            .map(|k| {
                let after = (k + 1) % count;
                let is_bent_at =
                    |joint: usize| joints[joint].is_some() || is_mild(&pieces[before(joint)], &pieces[joint]);
                let is_curve = (joints[k].is_some() || joints[after].is_some()) && is_bent_at(k) && is_bent_at(after);
                // The first and last piece of an open boundary have one neighbour only.
                let has_both = runs.closed || (k > 0 && after > 0);
                (is_curve && has_both)
                    .then(|| smooth_middle(runs, &pieces[before(k)], &pieces[k], &pieces[after]))
                    .flatten()
            })
            .collect();
        Curves { joints, middles }
    }

    /// Returns the curve point that replaces the joint before piece `k`; `None` for a corner.
    pub(super) fn joint(&self, k: usize) -> Option<[f64; 2]> {
        self.joints[k]
    }

    /// Returns the point on the curve in the middle of piece `k`, if the piece is curved.
    pub(super) fn middle(&self, k: usize) -> Option<[f64; 2]> {
        self.middles[k]
    }
}

/// Whether the turn between two pieces is small enough for a curve.
fn is_mild(before: &Piece, after: &Piece) -> bool {
    let ([ax, ay], [bx, by]) = (before.line.along, after.line.along);
    ax * bx + ay * by > MILD_TURN
}

/// Whether a piece along pixel edges is the extremum of a curve: both neighbours turn the same way, a little, and are
/// not much shorter.
fn turns_round(runs: &Runs, before: &Piece, piece: &Piece, after: &Piece) -> bool {
    let turn = |a: &Piece, b: &Piece| a.line.along[0] * b.line.along[1] - a.line.along[1] * b.line.along[0];
    piece.exact
        && !before.exact
        && !after.exact
        && is_mild(before, piece)
        && is_mild(piece, after)
        && turn(before, piece) * turn(piece, after) > 0.0
        && piece.length(runs) < 2.0 * (before.length(runs) + after.length(runs))
}

/// Returns the point on the curve at a joint, if a parabola fits as well as the two lines. `slack` is the allowed
/// excess of the mean squared error, square pixels.
fn smooth_joint(runs: &Runs, before: &Piece, after: &Piece, slack: f64) -> Option<[f64; 2]> {
    let ([ax, ay], [bx, by]) = (before.line.along, after.line.along);
    if ax * bx + ay * by < SHARPEST_TURN || (before.exact && after.exact) {
        return None;
    }
    let near: Vec<&Sample> = runs.samples_of(before.from, before.to).collect();
    let far: Vec<&Sample> = runs.samples_of(after.from, after.to).collect();
    let half = share_of(near.len().min(far.len()));
    let near = &near[near.len().saturating_sub(half)..];
    let far = &far[..half.min(far.len())];
    let parabola = Parabola::through(near.iter().chain(far).copied(), [ax + bx, ay + by])?;
    let squares = |samples: &[&Sample], piece: &Piece| -> f64 {
        samples.iter().map(|s| s.weight * piece.line.distance(s.at) * piece.line.distance(s.at)).sum()
    };
    let slack = slack * (near.len() + far.len()) as f64 + 1e-9;
    let smooth = parabola.squares <= 2.0 * (squares(near, before) + squares(far, after)) + slack;
    smooth.then(|| parabola.nearest(runs.corner(after.from)))
}

/// Number of samples of a neighbouring piece used for a curve: half of a short piece, which turns a lot.
fn share_of(samples: usize) -> usize {
    let share = if samples < 12 { samples / 2 } else { samples * 3 / 4 };
    share.max(FEWEST_SAMPLES).min(samples)
}

/// Returns the point on the curve amid a piece: a parabola through it and near parts of its neighbours.
fn smooth_middle(runs: &Runs, before: &Piece, piece: &Piece, after: &Piece) -> Option<[f64; 2]> {
    let [first, last] = [runs.corner(piece.from), runs.corner(piece.to)];
    let near: Vec<&Sample> = runs.samples_of(before.from, before.to).collect();
    let far: Vec<&Sample> = runs.samples_of(after.from, after.to).collect();
    let length = runs.edges(piece.from, piece.to);
    let near = &near[near.len() - share_of(near.len()).min(length)..];
    let far = &far[..share_of(far.len()).min(length)];
    let own = runs.samples_of(piece.from, piece.to);
    let parabola = Parabola::through(near.iter().chain(far).copied().chain(own), piece.line.along)?;
    let length = piece.length(runs);
    let is_bent = (parabola.bend * length * length / 4.0).abs() > LEAST_SAGITTA;
    is_bent.then(|| parabola.nearest([(first[0] + last[0]) * 0.5, (first[1] + last[1]) * 0.5]))
}

/// Least-squares parabola v = height + slope u + bend u^2, with u along `along`.
struct Parabola {
    mean: [f64; 2],
    along: [f64; 2],
    height: f64,
    slope: f64,
    bend: f64,
    /// Sum of squared residuals.
    squares: f64,
}

impl Parabola {
    fn through<'a>(samples: impl Iterator<Item = &'a Sample> + Clone, along: [f64; 2]) -> Option<Parabola> {
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let weight: f64 = samples.clone().map(|s| s.weight).sum();
        if length < 1e-9 || weight < 4.0 {
            return None;
        }
        let mean = [0, 1].map(|axis| samples.clone().map(|s| s.weight * s.at[axis]).sum::<f64>() / weight);
        let [cx, cy] = along.map(|c| c / length);
        let local = |s: &Sample| {
            let (x, y) = (s.at[0] - mean[0], s.at[1] - mean[1]);
            // v is to the right of u in the image, whose y points down.
            (x * cx + y * cy, y * cx - x * cy)
        };
        // Normal equations; the sums of u and v vanish around the mean.
        let (mut u2, mut u3, mut u4, mut uv, mut u2v, mut v2) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for s in samples {
            let ((u, v), w) = (local(s), s.weight);
            u2 += w * u * u;
            u3 += w * u * u * u;
            u4 += w * u * u * u * u;
            uv += w * u * v;
            u2v += w * u * u * v;
            v2 += w * v * v;
        }
        let (curved, mixed) = (u4 - u2 * u2 / weight, u3);
        let determinant = curved * u2 - mixed * mixed;
        if determinant <= 1e-9 * curved * u2 {
            return None;
        }
        let bend = (u2v * u2 - uv * mixed) / determinant;
        let slope = (uv * curved - u2v * mixed) / determinant;
        let height = -bend * u2 / weight;
        Some(Parabola { mean, along: [cx, cy], height, slope, bend, squares: (v2 - bend * u2v - slope * uv).max(0.0) })
    }

    /// Returns the point of the parabola at the u of `p`.
    fn nearest(&self, p: [f64; 2]) -> [f64; 2] {
        let [cx, cy] = self.along;
        let u = (p[0] - self.mean[0]) * cx + (p[1] - self.mean[1]) * cy;
        let v = self.height + self.slope * u + self.bend * u * u;
        [self.mean[0] + u * cx - v * cy, self.mean[1] + u * cy + v * cx]
    }
}
