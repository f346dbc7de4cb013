use super::super::request::PathRequest;
use crate::math::{Vec2, smoothstep, vec2};

/// Points of the curve between two given points.
const STEPS: usize = 32;
/// Share of the path's time for speeding up, and again for slowing down.
const START_SHARE: f64 = 0.15;

/// The crowd's centroid in each frame, metres; the origin without a path.
pub(super) fn places(way: Option<&PathRequest>, fps: f64, moments: usize) -> Vec<Vec2> {
    let Some(way) = way else { return vec![Vec2::ZERO; moments] };
    let curve = Curve::through(&way.from.iter().chain(&way.path).chain(&way.to).copied().collect::<Vec<_>>());
    let to_s = way.to_s.unwrap_or(moments.saturating_sub(1) as f64 / fps).max(way.from_s + 1e-9);
    let place = |moment: usize| {
        let share = (moment as f64 / fps - way.from_s) / (to_s - way.from_s);
        curve.at(gentle(share))
    };
    (0..moments).map(place).collect()
}

/// Share of a path after a share of its time: at constant speed, with smooth start and end.
fn gentle(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    // The speed rises as `eased` does, whose mean is a half.
    let speed = 1.0 / (1.0 - START_SHARE);
    let set_out = |share: f64| {
        // The integral of 3 s^2 - 2 s^3.
        let s = (share / START_SHARE).min(1.0);
        speed * (START_SHARE * (s * s * s - s * s * s * s / 2.0) + (share - START_SHARE).max(0.0))
    };
    if share <= 0.5 { set_out(share) } else { 1.0 - set_out(1.0 - share) }
}

/// A smooth curve, parametrised by length.
struct Curve {
    points: Vec<Vec2>,
    /// Length along the curve to each point, metres.
    lengths_m: Vec<f64>,
}

impl Curve {
    /// Makes a curve through points (Catmull-Rom); through two, a line.
    fn through(given: &[Vec2]) -> Curve {
        let last = given.len().saturating_sub(1);
        let mut points = vec![given.first().copied().unwrap_or_default()];
        for k in 0..last {
            let [a, b, c, d] = [k.saturating_sub(1), k, k + 1, (k + 2).min(last)].map(|k| given[k]);
            // Handles as long as a third of the side, so that points close together make no loops.
            let side_m = b.distance(c);
            let handle = |direction: Vec2| direction.normalized().map_or(Vec2::ZERO, |along| along * (side_m / 3.0));
            let (out, back) = (b + handle(c - a), c - handle(d - b));
            points.extend((1..=STEPS).map(|step| {
                let t = step as f64 / STEPS as f64;
                let u = 1.0 - t;
                b * (u * u * u) + out * (3.0 * u * u * t) + back * (3.0 * u * t * t) + c * (t * t * t)
            }));
        }
        let mut length_m = 0.0;
        let mut lengths_m = vec![0.0];
        lengths_m.extend(points.windows(2).map(|side| {
            length_m += side[0].distance(side[1]);
            length_m
        }));
        Curve { points, lengths_m }
    }

    fn at(&self, share: f64) -> Vec2 {
        let at_m = share * self.lengths_m.last().copied().unwrap_or(0.0);
        let after = self.lengths_m.partition_point(|&length_m| length_m < at_m).clamp(1, self.points.len().max(2) - 1);
        if self.points.len() < 2 {
            return self.points.first().copied().unwrap_or(vec2(0.0, 0.0));
        }
        let (before_m, after_m) = (self.lengths_m[after - 1], self.lengths_m[after]);
        let within = if after_m > before_m { (at_m - before_m) / (after_m - before_m) } else { 0.0 };
        self.points[after - 1].lerp(self.points[after], within.clamp(0.0, 1.0))
    }
}

/// Angle in each frame, radians: smoothstep between given ones, constant before the first and after the last.
pub(in super::super) fn angles(given: &[(usize, f64)], moments: usize) -> Vec<f64> {
    let angle = |moment: usize| {
        let after = given.partition_point(|key| key.0 <= moment);
        match (after.checked_sub(1).map(|before| given[before]), given.get(after)) {
            (None, None) => 0.0,
            (Some((_, angle)), None) | (None, Some(&(_, angle))) => angle,
            (Some((from, start)), Some(&(to, end))) => {
                start + (end - start) * smoothstep((moment - from) as f64 / (to - from) as f64)
            }
        }
    };
    (0..moments).map(angle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_begins_and_ends_where_it_is_said_and_gently() {
        let way = PathRequest {
            from: Some(vec2(1.0, 1.0)),
            path: vec![vec2(5.0, 4.0), vec2(9.0, 1.0)],
            to: Some(vec2(12.0, 8.0)),
            from_s: 2.0,
            to_s: Some(12.0),
            follow_heading: false,
        };
        let places = places(Some(&way), 10.0, 151);
        assert_eq!((places[0], places[20]), (vec2(1.0, 1.0), vec2(1.0, 1.0)));
        assert!(places[120].distance(vec2(12.0, 8.0)) < 1e-9 && places[150].distance(vec2(12.0, 8.0)) < 1e-9);
        for point in way.path {
            assert!(places.iter().any(|place| place.distance(point) < 0.15), "{point:?}");
        }
        let step = |k: usize| places[k + 1] - places[k];
        // Over 2 m/s around bends: a tenth of a second changes a step by less than half of it.
        assert!((0..149).all(|k| (step(k + 1) - step(k)).length() < 0.12));
    }

    #[test]
    fn ways_without_length_stay() {
        assert_eq!(places(None, 10.0, 2), [Vec2::ZERO; 2]);
        let here = PathRequest { path: vec![vec2(3.0, 3.0); 3], ..PathRequest::default() };
        assert_eq!(places(Some(&here), 10.0, 2), [vec2(3.0, 3.0); 2]);
        assert_eq!(places(Some(&PathRequest { path: vec![vec2(1.0, 2.0)], ..here }), 10.0, 1), [vec2(1.0, 2.0)]);
    }

    #[test]
    fn angles_go_from_one_to_the_next() {
        let angles = angles(&[(2, 0.0), (6, 1.0)], 9);
        assert_eq!(angles[..3], [0.0; 3]);
        assert_eq!(angles[4], 0.5);
        assert_eq!(angles[6..], [1.0; 3]);
    }
}
