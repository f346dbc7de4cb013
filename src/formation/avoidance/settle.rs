use rayon::prelude::*;

use super::nearby::{BodiesAtMoment, BodyPair, pairs_within};
use super::settings::AvoidanceSettings;
use super::smooth::Smoother;
use super::tracks::{BodyTracks, SWEEPS, any_direction};
use crate::formation::FormationError;
use crate::math::Vec2;
use crate::progress::Progress;

/// Most steps in which overlapping paths are led apart.
const STEPS: usize = 240;
/// Extra room at which these steps aim, as a share of the kept distance.
const MARGIN: f64 = 0.03;
/// Smoothing time of the steps, seconds: first early and gently, later only close to the overlap.
const EARLY_S: [f64; 4] = [0.5, 0.35, 0.2, 0.12];
/// Number of neighbour searches in a step.
const ROUNDS: usize = 12;
/// Over-relaxation of a step, since smoothing spreads it over neighbouring frames.
const BEYOND: f64 = 1.6;
/// Most sweeps of the final separation in each frame.
const LAST_SWEEPS: usize = 2000;
/// Time in which a correction of the final separation fades, seconds.
const FADE_S: f64 = 0.4;
/// Extra room of the final separation, as a share of the kept distance.
const LAST_MARGIN: f64 = 1e-6;
/// Largest acceleration of a body that is moved aside, metres per second squared: that of staggering.
const HARDEST_M_S2: f64 = 20.0;
/// Offset, as a multiple of the kept distance, above which a body has no room at its target.
const FAR: f64 = 4.0;
/// Most smoothings of corrections that are too sudden, and the first smoothing time, seconds; each is longer by half.
const SMOOTHINGS: usize = 12;
const SMOOTHED_S: f64 = 0.1;

/// Removes the remaining overlaps of the paths found.
///
/// Overlapping bodies are led farther apart over time, and at last separated frame by frame. If that is too sudden for a
/// body, the crowd is too dense, and people overlap rather than jump; a warning says where and when.
pub(super) fn settle(
    crowd: &BodyTracks<'_>,
    mut ways: Vec<Vec2>,
    avoidance: &AvoidanceSettings,
    progress: &dyn Progress,
) -> Result<Vec<Vec2>, FormationError> {
    for step in 0..STEPS {
        progress.keep_on()?;
        let mut remedy = remedies(crowd, &ways);
        if remedy.iter().all(|&remedy| remedy == Vec2::ZERO) {
            break;
        }
        let early_s = EARLY_S[step * EARLY_S.len() / STEPS];
        smoother(crowd.moments(), early_s * avoidance.fps).solve(&mut remedy, crowd.bodies);
        ways.iter_mut().zip(&remedy).for_each(|(way, &remedy)| *way += remedy * BEYOND);
    }
    let sure = separated(crowd, &ways, avoidance.fps);
    let settled = softened(crowd, &ways, sure, avoidance.fps);
    if let Some(warning) = crowding(crowd, &settled, avoidance) {
        progress.warn(&warning);
    }
    Ok(settled)
}

/// A smoother with a time constant in frames, for `count` frames.
fn smoother(count: usize, moments: f64) -> Smoother {
    Smoother::new(&vec![1.0; count], moments * moments * moments * moments)
}

/// The corrections that separate overlapping bodies in each frame by itself; 0 without overlap.
fn remedies(crowd: &BodyTracks<'_>, ways: &[Vec2]) -> Vec<Vec2> {
    let width = crowd.bodies;
    let mut remedies = vec![Vec2::ZERO; ways.len()];
    remedies.par_chunks_mut(width).enumerate().for_each(|(moment, remedies)| {
        let here = crowd.moment(moment);
        let own = crowd.moved(moment, ways);
        if pairs_within(BodiesAtMoment { places: &own, reaches_m: here.reaches_m }, 0.0).is_empty() {
            return;
        }
        let margin_m = 2.0 * MARGIN * here.reaches_m.iter().copied().fold(0.0, f64::max);
        let mut places = own.clone();
        for _ in 0..ROUNDS {
            let near = pairs_within(BodiesAtMoment { places: &places, reaches_m: here.reaches_m }, margin_m);
            if !separate(&mut places, here.reaches_m, &near, MARGIN, 2 * SWEEPS) {
                break;
            }
        }
        remedies.iter_mut().zip(places.iter().zip(&own)).for_each(|(remedy, (&to, &from))| *remedy = to - from);
    });
    remedies
}

/// The offsets with each frame's own correction of overlaps, which fades over the following frames.
fn separated(crowd: &BodyTracks<'_>, ways: &[Vec2], fps: f64) -> Vec<Vec2> {
    let width = crowd.bodies;
    let keep = (1.0 - 1.0 / (FADE_S * fps)).max(0.0);
    let mut sure = ways.to_vec();
    let mut remedy = vec![Vec2::ZERO; width];
    for (moment, ways) in sure.chunks_mut(width).enumerate() {
        let here = crowd.moment(moment);
        let own = here.places.iter().zip(&*ways).zip(&remedy);
        let mut places: Vec<Vec2> = own.map(|((&place, &way), &remedy)| place + way + remedy * keep).collect();
        for _ in 0..LAST_SWEEPS {
            let near = pairs_within(BodiesAtMoment { places: &places, reaches_m: here.reaches_m }, 0.0);
            if near.is_empty() {
                break;
            }
            separate(&mut places, here.reaches_m, &near, LAST_MARGIN, SWEEPS);
        }
        for k in 0..width {
            let offset = places[k] - here.places[k];
            remedy[k] = offset - ways[k];
            ways[k] = offset;
        }
    }
    sure
}

/// The corrections, smoothed for bodies that they would move too suddenly.
fn softened(crowd: &BodyTracks<'_>, ways: &[Vec2], mut sure: Vec<Vec2>, fps: f64) -> Vec<Vec2> {
    let (width, moments) = (crowd.bodies, crowd.moments());
    let mut span_s = SMOOTHED_S;
    for _ in 0..SMOOTHINGS {
        let hardest = |offsets: &[Vec2], k: usize| hardest_m_s2(offsets, k, width, fps);
        let allowed = |k: usize| hardest(ways, k).max(HARDEST_M_S2);
        let sudden: Vec<usize> = (0..width).filter(|&k| hardest(&sure, k) > 1.01 * allowed(k)).collect();
        if sudden.is_empty() {
            break;
        }
        let smoother = smoother(moments, span_s * fps);
        let mut column = vec![Vec2::ZERO; moments];
        for k in sudden {
            for (moment, remedy) in column.iter_mut().enumerate() {
                *remedy = sure[moment * width + k] - ways[moment * width + k];
            }
            smoother.solve(&mut column, 1);
            for (moment, &remedy) in column.iter().enumerate() {
                sure[moment * width + k] = ways[moment * width + k] + remedy;
            }
        }
        span_s *= 1.5;
    }
    sure
}

/// Largest acceleration of a body's offsets, metres per second squared.
fn hardest_m_s2(offsets: &[Vec2], body: usize, width: usize, fps: f64) -> f64 {
    let at = |moment: usize| offsets[moment * width + body];
    let inner = 1..(offsets.len() / width).saturating_sub(1);
    inner.map(|k| (at(k - 1) - at(k) * 2.0 + at(k + 1)).length() * fps * fps).fold(0.0, f64::max)
}

/// The warning that a crowd was too dense, with place and time; `None` if it was not.
fn crowding(crowd: &BodyTracks<'_>, offsets: &[Vec2], avoidance: &AvoidanceSettings) -> Option<String> {
    let AvoidanceSettings { fps, hint, .. } = avoidance;
    let at =
        |moment: usize, place: Vec2| format!("at {:.1} s near [{:.1}, {:.1}] m", moment as f64 / fps, place.x, place.y);
    if let Some((moment, [apart_m, kept_m], place)) = nearest(crowd, offsets) {
        let where_and_when = at(moment, place);
        return Some(format!(
            "the crowd is too dense: {where_and_when}, two people come within {apart_m:.2} m of each other instead of \
             {kept_m:.2} m; {hint}"
        ));
    }
    let width = crowd.bodies;
    let far = |k: usize| offsets[k].length() / (2.0 * crowd.reaches_m[k]).max(1e-9);
    let most = (0..offsets.len()).filter(|&k| far(k) > FAR).max_by(|&a, &b| far(a).total_cmp(&far(b)))?;
    let where_and_when = at(most / width, crowd.places[most]);
    Some(format!(
        "the crowd is too dense: {where_and_when}, a person has to stay {:.1} m away; {hint}",
        offsets[most].length()
    ))
}

/// The pair with the largest overlap: its frame, its distance and the distance to keep, and the place; `None` without one.
fn nearest(crowd: &BodyTracks<'_>, offsets: &[Vec2]) -> Option<(usize, [f64; 2], Vec2)> {
    /// Nearer by less than this share of the distance is rounding.
    const ROUNDING: f64 = 1e-5;
    let worst_at = |moment: usize| {
        let places = crowd.moved(moment, offsets);
        let near = pairs_within(BodiesAtMoment { places: &places, reaches_m: crowd.moment(moment).reaches_m }, 0.0);
        let pair = |pair: BodyPair| {
            let [a, b] = pair.map(|body| places[body as usize]);
            (moment, [a.distance(b), crowd.keep_m(moment, pair)], (a + b) / 2.0)
        };
        let close = near.into_iter().map(pair).filter(|&(_, [apart_m, kept_m], _)| apart_m < kept_m * (1.0 - ROUNDING));
        close.min_by(|a, b| missing_m(b.1).total_cmp(&missing_m(a.1)))
    };
    let all: Vec<_> = (0..crowd.moments()).into_par_iter().filter_map(worst_at).collect();
    all.into_iter().min_by(|a, b| missing_m(b.1).total_cmp(&missing_m(a.1)))
}

fn missing_m([apart_m, kept_m]: [f64; 2]) -> f64 {
    kept_m - apart_m
}

/// Separates pairs nearer than the kept distance and a margin, sweep by sweep; returns whether some may be left.
fn separate(places: &mut [Vec2], reaches_m: &[f64], near: &[BodyPair], margin: f64, sweeps: usize) -> bool {
    for _ in 0..sweeps {
        let mut moved = false;
        for &[a, b] in near {
            let [first, second] = [a as usize, b as usize];
            let keep_m = (reaches_m[first] + reaches_m[second]) * (1.0 + margin);
            let apart = places[first] - places[second];
            let length_m = apart.length();
            if length_m >= keep_m {
                continue;
            }
            moved = true;
            let direction = if length_m > 1e-9 { apart / length_m } else { any_direction(a, b) };
            let by = direction * ((keep_m - length_m) / 2.0);
            places[first] += by;
            places[second] -= by;
        }
        if !moved {
            return false;
        }
    }
    true
}
