use super::super::places::centroid;
use super::super::request::Repeat;
use crate::math::{Vec2, smoothstep};
use crate::motion::Ensemble;

/// Time for turning back in a to-and-fro repetition, seconds before and after the end.
const TURN_S: f64 = 0.5;
/// Cross-fade between passages of a loop, seconds.
const FADE_S: f64 = 1.0;

/// Cuts or repeats an example to a number of frames, with continuous speeds.
pub(super) fn lengthened(example: &Ensemble, moments: usize, repeat: Repeat) -> Ensemble {
    let (fps, ids) = (example.fps, example.ids.clone());
    let length_s = (example.moments().saturating_sub(1)) as f64 / fps;
    let mut places_m = Vec::with_capacity(moments * ids.len());
    // Where it turns back it has slowed down before its end, where it starts again it has been faded in.
    let whole_s = match repeat {
        _ if moments <= example.moments() => f64::INFINITY,
        Repeat::ToAndFro => length_s - turn_s(length_s),
        Repeat::Loop => -1.0,
    };
    for moment in 0..moments {
        if moment < example.moments() && moment as f64 / fps <= whole_s {
            places_m.extend_from_slice(example.places_at(moment));
            continue;
        }
        let time_s = moment as f64 / fps;
        match repeat {
            Repeat::ToAndFro => places_m.extend(sampled(example, to_and_fro_s(time_s, length_s))),
            Repeat::Loop => places_m.extend(looped(example, time_s, length_s)),
        }
    }
    Ensemble::new(fps, 0.0, ids, places_m).with_statures(example.statures().clone())
}

fn turn_s(length_s: f64) -> f64 {
    TURN_S.min(length_s / 4.0)
}

/// Time within an example that is played forwards and backwards.
fn to_and_fro_s(time_s: f64, length_s: f64) -> f64 {
    if length_s <= 0.0 {
        return 0.0;
    }
    let turn_s = turn_s(length_s);
    if time_s <= length_s - turn_s {
        return time_s;
    }
    let phase_s = time_s % (2.0 * length_s);
    // Rounded where the triangle wave has its corners: from speed 1 to -1 evenly.
    let rounded = |from_corner_s: f64| turn_s / 2.0 + from_corner_s * from_corner_s / (2.0 * turn_s);
    let from_top_s = phase_s - length_s;
    if from_top_s.abs() < turn_s {
        length_s - rounded(from_top_s)
    } else if phase_s < turn_s {
        rounded(phase_s)
    } else if 2.0 * length_s - phase_s < turn_s {
        rounded(2.0 * length_s - phase_s)
    } else {
        length_s - from_top_s.abs()
    }
}

/// Positions in a looped example; each passage starts at the centroid of the last one and is cross-faded with it.
fn looped(example: &Ensemble, time_s: f64, length_s: f64) -> Vec<Vec2> {
    let fade_s = FADE_S.min(length_s / 4.0);
    let period_s = length_s - fade_s;
    if period_s <= 0.0 {
        return sampled(example, 0.0);
    }
    let passage = (time_s / period_s).floor();
    let within_s = time_s - passage * period_s;
    let advance = centroid(&sampled(example, period_s)) - centroid(&sampled(example, 0.0));
    let here = sampled(example, within_s).into_iter().map(|place| place + advance * passage);
    if passage < 1.0 || within_s >= fade_s {
        return here.collect();
    }
    let share = smoothstep(within_s / fade_s);
    let before = sampled(example, within_s + period_s).into_iter().map(|place| place + advance * (passage - 1.0));
    before.zip(here).map(|(before, here)| before.lerp(here, share)).collect()
}

/// Positions at a time between frames (Catmull-Rom interpolation).
fn sampled(example: &Ensemble, time_s: f64) -> Vec<Vec2> {
    let last = example.moments().saturating_sub(1);
    let at = (time_s * example.fps).clamp(0.0, last as f64);
    let k = (at.floor() as usize).min(last);
    let t = at - k as f64;
    let [a, b, c, d] = [k.saturating_sub(1), k, (k + 1).min(last), (k + 2).min(last)].map(|k| example.places_at(k));
    (0..example.people())
        .map(|p| {
            let (before, after) = ((c[p] - a[p]) / 2.0, (d[p] - b[p]) / 2.0);
            let (t2, t3) = (t * t, t * t * t);
            b[p] * (2.0 * t3 - 3.0 * t2 + 1.0)
                + before * (t3 - 2.0 * t2 + t)
                + c[p] * (3.0 * t2 - 2.0 * t3)
                + after * (t3 - t2)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;

    fn walk(moments: usize) -> Ensemble {
        let places = (0..moments).flat_map(|k| {
            let t = k as f64 / 10.0;
            [vec2(t, 0.0), vec2(1.0 + 1.5 * t, crate::math::sin_cos(t).0)]
        });
        Ensemble::new(10.0, 0.0, vec![0, 1], places.collect())
    }

    #[test]
    fn what_is_long_enough_is_only_cut() {
        for repeat in [Repeat::ToAndFro, Repeat::Loop] {
            let cut = lengthened(&walk(40), 25, repeat);
            assert_eq!(cut.moments(), 25);
            assert!((0..25).all(|k| cut.places_at(k) == walk(40).places_at(k)));
            assert_eq!(lengthened(&walk(40), 40, repeat), walk(40));
        }
    }

    #[test]
    fn what_is_too_short_goes_on_without_a_jump() {
        for repeat in [Repeat::ToAndFro, Repeat::Loop] {
            let long = lengthened(&walk(31), 200, repeat);
            assert_eq!(long.moments(), 200);
            for person in 0..2 {
                let step = |k: usize| long.places_at(k + 1)[person] - long.places_at(k)[person];
                for k in 0..198 {
                    // From one speed to its opposite in a second, at a tenth of a second a moment.
                    let change = (step(k + 1) - step(k)).length();
                    assert!(change < 0.08, "{repeat:?}, {person}, {k}: {change}");
                }
            }
        }
        let there_and_back = lengthened(&walk(31), 61, Repeat::ToAndFro);
        assert!((there_and_back.places_at(10)[0].x - there_and_back.places_at(50)[0].x).abs() < 1e-9);
        assert!(lengthened(&walk(31), 200, Repeat::Loop).places_at(199)[0].x > 15.0);
    }

    #[test]
    fn a_single_moment_stays() {
        for repeat in [Repeat::ToAndFro, Repeat::Loop] {
            let still = lengthened(&walk(1), 4, repeat);
            assert!((0..4).all(|k| still.places_at(k) == walk(1).places_at(0)), "{still:?}");
        }
    }
}
