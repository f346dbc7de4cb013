use crate::math::{Vec2, vec2};

/// Speed below which a member stands between two samples, metres per second.
const STANDING_M_S: f64 = 0.02;

/// Position and heading of a person at a time of a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackSample {
    /// Seconds since the unit's start.
    pub time_s: f64,
    /// Position in the unit's frame, metres.
    pub place_m: Vec2,
    /// Unit vector in which the body faces.
    pub heading: Vec2,
}

/// Position, velocity and heading of a person on a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackState {
    /// Position, metres.
    pub place_m: Vec2,
    /// Velocity, metres per second.
    pub velocity_m_s: Vec2,
    /// Unit vector in which the body faces.
    pub heading: Vec2,
}

/// A path through samples at ascending times: cubic Hermite splines with continuous position and velocity.
///
/// Velocities at samples are those of the parabola through the sample and its two neighbours (Bessel tangents), and zero
/// next to an interval in which the person stands. Before the first sample and after the last one the path is a straight
/// line. Headings turn evenly in between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnitTrack {
    samples: Vec<TrackSample>,
    velocities: Vec<Vec2>,
}

impl UnitTrack {
    /// Makes a track through samples at ascending times.
    pub fn new(samples: Vec<TrackSample>) -> UnitTrack {
        let slope = |k: usize| {
            let (a, b) = (samples[k], samples[k + 1]);
            (b.place_m - a.place_m) / (b.time_s - a.time_s).max(1e-9)
        };
        let span = |k: usize| samples[k + 1].time_s - samples[k].time_s;
        let last = samples.len().saturating_sub(1);
        let velocity = |k: usize| match (k > 0, k < last) {
            (false, false) => Vec2::ZERO,
            (false, true) => slope(0),
            (true, false) => slope(last - 1),
            (true, true) => {
                let (before, after) = (slope(k - 1), slope(k));
                if before.length() < STANDING_M_S || after.length() < STANDING_M_S {
                    return Vec2::ZERO;
                }
                let (h0, h1) = (span(k - 1), span(k));
                (before * h1 + after * h0) / (h0 + h1)
            }
        };
        let velocities = (0..samples.len()).map(velocity).collect();
        UnitTrack { samples, velocities }
    }

    /// The samples.
    pub fn samples(&self) -> &[TrackSample] {
        &self.samples
    }

    /// Time of the last sample, seconds.
    pub fn end_s(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.time_s)
    }

    /// Position, velocity and heading at a time; the origin for an empty track.
    pub fn at(&self, time_s: f64) -> TrackState {
        let after = self.samples.partition_point(|sample| sample.time_s <= time_s);
        let edge = |k: usize| {
            let (sample, velocity_m_s) = (self.samples[k], self.velocities[k]);
            let place_m = sample.place_m + velocity_m_s * (time_s - sample.time_s);
            TrackState { place_m, velocity_m_s, heading: sample.heading }
        };
        match (after, self.samples.len()) {
            (_, 0) => TrackState { place_m: Vec2::ZERO, velocity_m_s: Vec2::ZERO, heading: vec2(0.0, 1.0) },
            (0, _) => edge(0),
            (after, count) if after == count => edge(count - 1),
            (after, _) => self.between(after - 1, time_s),
        }
    }

    fn between(&self, k: usize, time_s: f64) -> TrackState {
        let (a, b) = (self.samples[k], self.samples[k + 1]);
        let span_s = b.time_s - a.time_s;
        let s = (time_s - a.time_s) / span_s;
        let (m0, m1) = (self.velocities[k] * span_s, self.velocities[k + 1] * span_s);
        let way = b.place_m - a.place_m;
        // Hermite cubic relative to `a`: p = a + way h01 + m0 h10 + m1 h11.
        let (s2, s3) = (s * s, s * s * s);
        let place_m = a.place_m + way * (3.0 * s2 - 2.0 * s3) + m0 * (s3 - 2.0 * s2 + s) + m1 * (s3 - s2);
        let rate = way * (6.0 * s - 6.0 * s2) + m0 * (3.0 * s2 - 4.0 * s + 1.0) + m1 * (3.0 * s2 - 2.0 * s);
        let heading = turned(a.heading, b.heading, s);
        TrackState { place_m, velocity_m_s: rate / span_s, heading }
    }
}

/// The unit vector at the share `s` of the turn from `a` to `b`, on the shorter side; on the left for half a turn.
///
/// The turn is close to even for up to a quarter turn.
pub(super) fn turned(a: Vec2, b: Vec2, s: f64) -> Vec2 {
    if a.dot(b) > -0.5 {
        return a.lerp(b, s).normalized().unwrap_or(b);
    }
    // Via the direction halfway, since the straight line between the two passes near the origin.
    let side = if a.cross(b) < 0.0 { -1.0 } else { 1.0 };
    let half = (a.left() * side + (a + b)).normalized().unwrap_or(b);
    if s < 0.5 { turned(a, half, 2.0 * s) } else { turned(half, b, 2.0 * s - 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(rows: &[[f64; 3]]) -> UnitTrack {
        let sample = |&[time_s, x, y]: &[f64; 3]| TrackSample { time_s, place_m: vec2(x, y), heading: vec2(1.0, 0.0) };
        UnitTrack::new(rows.iter().map(sample).collect())
    }

    #[test]
    fn even_acceleration_is_kept_exactly() {
        let at = |t: f64| 0.5 * t + 0.4 * t * t;
        let track = track(&[0.0, 0.2, 0.5, 0.6, 1.0].map(|t| [t, at(t), 1.0]));
        for k in 10..30 {
            let t = f64::from(k) * 0.02;
            let moment = track.at(t);
            assert!((moment.place_m.x - at(t)).abs() < 1e-9, "{t}");
            assert!((moment.velocity_m_s.x - (0.5 + 0.8 * t)).abs() < 1e-9, "{t}");
        }
    }

    #[test]
    fn place_and_velocity_are_continuous_and_who_stands_stands() {
        let track = track(&[[0.0, 0.0, 0.0], [0.5, 0.6, 0.1], [1.0, 0.9, 0.3], [3.0, 0.9, 0.3], [3.6, 0.4, 0.5]]);
        for k in 1..5000 {
            let (a, b) = (track.at(f64::from(k - 1) * 1e-3), track.at(f64::from(k) * 1e-3));
            assert!((b.place_m - a.place_m - (a.velocity_m_s + b.velocity_m_s) * 5e-4).length() < 1e-5, "{k}");
            assert!(b.velocity_m_s.distance(a.velocity_m_s) < 0.02, "{k}");
        }
        assert_eq!(track.at(2.0).velocity_m_s, Vec2::ZERO);
        assert_eq!(track.at(2.0).place_m, vec2(0.9, 0.3));
    }

    #[test]
    fn headings_turn_the_short_way_even_by_half_a_turn() {
        for (a, b) in
            [(vec2(1.0, 0.0), vec2(-1.0, 0.0)), (vec2(0.0, 1.0), vec2(-0.6, -0.8)), (vec2(0.6, 0.8), vec2(0.8, 0.6))]
        {
            let mut before = a;
            for k in 1..=100 {
                let now = turned(a, b, f64::from(k) * 0.01);
                assert!((now.length() - 1.0).abs() < 1e-9 && now.dot(before) > 0.995, "{a:?} {b:?} {k}");
                before = now;
            }
            assert!(before.distance(b) < 1e-9);
        }
    }
}
