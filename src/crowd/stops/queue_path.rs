use crate::crowd::environment::Environment;
use crate::math::{Vec2, vec2};

/// Distance of a queue from walls, metres; and the least where there is no room.
const MARGIN_M: f64 = 0.32;
const LEAST_MARGIN_M: f64 = 0.2;
/// Width of the passage that a queue leaves before a wall, metres.
const PASSAGE_M: f64 = 1.3;
/// Least distance between pieces of a queue, and between queues, metres.
const APART_M: f64 = 0.95;
/// Longest queue, metres.
const LONGEST_M: f64 = 60.0;
/// Distance over which the room beside a turn is compared, metres.
const LOOK_M: f64 = 8.0;
/// Turns of a queue that cannot go straight on, gentle ones first: cosine and sine.
const TURNS: [[f64; 2]; 7] =
    [[1.0, 0.0], [0.866, 0.5], [0.866, -0.5], [0.5, 0.866], [0.5, -0.866], [0.0, 1.0], [0.0, -1.0]];

/// The polyline along which people queue, from its head on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct QueuePath {
    points: Vec<Vec2>,
    /// Length of the polyline from the head to each point, metres.
    along_m: Vec<f64>,
    /// Unit vector that the first one faces.
    ahead: Vec2,
}

impl QueuePath {
    pub(super) fn new(points: Vec<Vec2>, ahead: Vec2) -> QueuePath {
        let mut along_m = Vec::with_capacity(points.len());
        let mut sum = 0.0;
        for (k, &point) in points.iter().enumerate() {
            sum += if k == 0 { 0.0 } else { points[k - 1].distance(point) };
            along_m.push(sum);
        }
        QueuePath { points, along_m, ahead }
    }

    /// A queue that begins at `head` behind somebody who faces `ahead`, goes straight back while it can and bends
    /// along walls. It keeps clear of `taken` places.
    pub(super) fn found(
        environment: &Environment<'_>,
        head: Vec2,
        ahead: Vec2,
        spacing_m: f64,
        taken: &[Vec2],
    ) -> QueuePath {
        let mut points = Vec::new();
        if stands(environment, head, LEAST_MARGIN_M) {
            points.push(head);
        }
        let mut back = -ahead;
        while let Some(&last) = points.last() {
            if points.len() as f64 * spacing_m > LONGEST_M {
                break;
            }
            let next = [(MARGIN_M, PASSAGE_M), (MARGIN_M, 0.0), (LEAST_MARGIN_M, 0.0)].into_iter().find_map(
                |(margin_m, passage_m)| {
                    onward(environment, &points, last, back, spacing_m, taken, [margin_m, passage_m])
                },
            );
            let Some(direction) = next else { break };
            points.push(last + direction * spacing_m);
            back = direction;
        }
        QueuePath::new(points, ahead)
    }

    pub(super) fn points(&self) -> &[Vec2] {
        &self.points
    }

    pub(super) fn length_m(&self) -> f64 {
        self.along_m.last().copied().unwrap_or(0.0)
    }

    /// The place this far behind the head, and the direction in which the queue moves there.
    pub(super) fn at(&self, along_m: f64) -> (Vec2, Vec2) {
        let after = self.along_m.partition_point(|&a| a < along_m).min(self.points.len().saturating_sub(1));
        let Some(&point) = self.points.get(after) else { return (Vec2::ZERO, self.ahead) };
        if after == 0 {
            return (point, self.ahead);
        }
        let before = self.points[after - 1];
        let length = (self.along_m[after] - self.along_m[after - 1]).max(1e-9);
        let share = ((along_m - self.along_m[after - 1]) / length).clamp(0.0, 1.0);
        (before.lerp(point, share), (before - point).normalized().unwrap_or(self.ahead))
    }
}

/// Whether a body has room at `p`, inside of the plan.
pub(super) fn stands(environment: &Environment<'_>, p: Vec2, margin_m: f64) -> bool {
    environment.plan.is_floor(p) && environment.ground().clearance_m(p) >= margin_m
}

/// The direction in which a queue goes on from its last place: straight, or else the turn with the most room ahead.
fn onward(
    environment: &Environment<'_>,
    points: &[Vec2],
    last: Vec2,
    back: Vec2,
    spacing_m: f64,
    taken: &[Vec2],
    [margin_m, passage_m]: [f64; 2],
) -> Option<Vec2> {
    let apart_m = APART_M.min(1.2 * spacing_m);
    let earlier = &points[..points.len().saturating_sub(1)];
    let fits = |direction: Vec2| {
        let next = last + direction * spacing_m;
        // The place before the last is as near as a bend of the queue allows.
        let near = |other: &Vec2, apart_m: f64| next.distance(*other) < apart_m;
        let crosses = earlier.iter().rev().skip(1).any(|other| near(other, apart_m))
            || earlier.last().is_some_and(|other| near(other, 0.9 * spacing_m))
            || taken.iter().any(|other| near(other, APART_M));
        let ahead = next + direction * passage_m;
        !crosses
            && stands(environment, next, margin_m)
            && environment.is_free(last, next, margin_m)
            && (passage_m == 0.0
                || environment.plan.is_floor(ahead) && environment.is_free(next, ahead, LEAST_MARGIN_M))
    };
    let mut best: Option<(f64, Vec2)> = None;
    for [cos, sin] in TURNS {
        let direction = back.rotated(vec2(cos, sin));
        if !fits(direction) {
            continue;
        }
        if sin == 0.0 {
            return Some(direction);
        }
        let room_m = room_ahead_m(environment, last, direction);
        // The first of equals: gentle turns are tried first, and to the left of those who come.
        if best.is_none_or(|(most_m, _)| room_m > most_m + 0.5) {
            best = Some((room_m, direction));
        }
    }
    best.map(|(_, direction)| direction)
}

fn room_ahead_m(environment: &Environment<'_>, from: Vec2, direction: Vec2) -> f64 {
    let mut done = 0.0;
    while done < LOOK_M && stands(environment, from + direction * (done + 0.5), LEAST_MARGIN_M) {
        done += 0.5;
    }
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_along_the_line() {
        let path = QueuePath::new(vec![vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 3.0)], vec2(-1.0, 0.0));
        assert_eq!(path.length_m(), 5.0);
        assert_eq!(path.at(0.0), (vec2(0.0, 0.0), vec2(-1.0, 0.0)));
        assert_eq!(path.at(1.5), (vec2(1.5, 0.0), vec2(-1.0, 0.0)));
        assert_eq!(path.at(3.0), (vec2(2.0, 1.0), vec2(0.0, -1.0)));
        assert_eq!(path.at(9.0).0, vec2(2.0, 3.0));
        assert_eq!(QueuePath::default().at(1.0).0, Vec2::ZERO);
    }
}
