use std::collections::BTreeMap;

use super::nearby::BodyPair;
use super::tracks::BodyTracks;
use crate::math::{Vec2, vec2};

/// Relative speed below which bodies do not pass each other, metres per second.
const SLOWEST_M_S: f64 = 0.1;
/// Share of the kept distance below which a passing is head-on, and bodies are led past each other on one side.
const HEAD_ON: f64 = 0.7;
/// Share below which the side is undecided, and both bodies keep to the right.
const UNDECIDED: f64 = 0.01;

/// Initial offsets: bodies that would walk through each other are led past on their own side, head-on to the right.
///
/// Without them the nearest clear positions of a frame would jump from in front of the other body to behind it.
pub(super) fn first_offsets(crowd: &BodyTracks<'_>, too_near: &[Vec<BodyPair>], fps: f64, seconds: f64) -> Vec<Vec2> {
    let mut offsets = vec![Vec2::ZERO; crowd.places.len()];
    for (pair, moments) in by_pair(too_near) {
        // Each run of frames without a gap is one encounter.
        for encounter in moments.chunk_by(|a, b| b - a == 1) {
            if let Some((at, aside)) = step_aside(crowd, pair, encounter, fps) {
                let half = (encounter.len() as f64 / 2.0).max(seconds * fps);
                let (from, to) = ((at - half).ceil().max(0.0) as usize, (at + half).floor() as usize);
                for moment in from..=to.min(crowd.moments() - 1) {
                    let s = (moment as f64 - at) / half;
                    let share = (1.0 - s * s).max(0.0);
                    let by = aside * (share * share * share);
                    offsets[moment * crowd.bodies + pair[0] as usize] += by;
                    offsets[moment * crowd.bodies + pair[1] as usize] -= by;
                }
            }
        }
    }
    offsets
}

/// The frames in which each pair overlaps.
fn by_pair(too_near: &[Vec<BodyPair>]) -> BTreeMap<BodyPair, Vec<usize>> {
    let mut moments: BTreeMap<BodyPair, Vec<usize>> = BTreeMap::new();
    for (moment, pairs) in too_near.iter().enumerate() {
        pairs.iter().for_each(|&pair| moments.entry(pair).or_default().push(moment));
    }
    moments
}

/// The frame (with fraction) in which two bodies pass each other head-on, and the offset of the first one.
///
/// The second one steps to the other side. `None` if they do not pass head-on.
fn step_aside(crowd: &BodyTracks<'_>, [a, b]: BodyPair, encounter: &[usize], fps: f64) -> Option<(f64, Vec2)> {
    let apart = |moment: usize| crowd.at(moment, a) - crowd.at(moment, b);
    let nearest = encounter.iter().copied().min_by(|&m, &n| apart(m).length().total_cmp(&apart(n).length()))?;
    let (before, after) = (nearest.saturating_sub(1), (nearest + 1).min(crowd.moments() - 1));
    let closing = (apart(after) - apart(before)) / (after - before).max(1) as f64;
    let direction = closing.normalized().filter(|_| closing.length() * fps > SLOWEST_M_S)?;
    // Between frames they are nearest where their difference is orthogonal to its change.
    let ahead = (-apart(nearest).dot(closing) / closing.length_squared()).clamp(-1.0, 1.0);
    let nearest_apart = apart(nearest) + closing * ahead;
    let keep_m = crowd.keep_m(nearest, [a, b]);
    let sideways_m = nearest_apart.dot(direction.left());
    if sideways_m.abs() > HEAD_ON * keep_m || nearest_apart.length() > HEAD_ON * keep_m {
        return None;
    }
    let side = if sideways_m > UNDECIDED * keep_m { 1.0 } else { -1.0 };
    let missing_m = (keep_m - sideways_m * side).max(0.0);
    let aside = direction.left() * (side * missing_m / 2.0);
    aside.is_finite().then_some((nearest as f64 + ahead, vec2(aside.x, aside.y)))
}
