//! Drags of chairs: who sits down draws a chair back, who gets up pushes it, and its legs leave pairs of lines.

use crate::math::{SplitMix64, Vec2, exp};
use crate::patterns::Cause;
use crate::plan::PlanClass;
use crate::walls::Walls;

use super::Mark;
use super::feet::turned_by;

/// Time after which somebody who stays at a seat has sat down, seconds.
const SITS_AFTER_S: f64 = 3.0;
/// Distance from the seat within which people sit, and that ends a stay when it has been walked, metres.
const AT_SEAT_M: f64 = 0.6;
const AWAY_M: f64 = 0.25;
/// Longest way round a chair, metres: nobody draws a bed, a sofa or a bench.
const LARGEST_CHAIR_M: f64 = 3.4;
/// Distance between the legs of a chair, and breadth of their lines, metres.
const LEGS_M: [f32; 2] = [0.36, 0.42];
const BREADTH_M: [f32; 2] = [0.006, 0.014];
/// How far a chair is drawn, metres, and how far it turns from straight away from its seat, radians.
const DRAWN_M: [f32; 2] = [0.1, 0.4];
const ASIDE_RAD: f32 = 0.3;
/// Median optical density of a line, standard deviation of its logarithm, and largest density.
const DENSITY: f64 = 0.07;
const SIGMA: f64 = 0.7;
const MOST_DENSITY: f64 = 0.4;

/// A person's stay at a place, and the chair there.
#[derive(Debug, Default)]
pub(super) struct Sitting {
    place_m: Vec2,
    stood_s: f64,
    seat: Option<Seat>,
    sits: u32,
}

/// The edge of a seat: its point nearest to who sits there, and the unit vector from it to the person.
#[derive(Clone, Copy, Debug)]
struct Seat {
    edge_m: Vec2,
    out: Vec2,
}

impl Sitting {
    /// Adds a tick; appends the lines of a chair that is drawn back or pushed. `word` is the person's random word, `drags`
    /// the expected number of drags each time.
    pub fn pass(&mut self, place_m: Vec2, stood_s: f64, walls: &Walls, (word, drags): (u32, f64), out: &mut Vec<Mark>) {
        if self.place_m.distance(place_m) > AWAY_M {
            if let Some(seat) = self.seat.take() {
                self.drag(seat, word, drags, walls, out);
            }
            (self.place_m, self.stood_s) = (place_m, 0.0);
        }
        let before_s = self.stood_s;
        self.stood_s += stood_s;
        if before_s < SITS_AFTER_S && self.stood_s >= SITS_AFTER_S {
            self.seat = Seat::at(place_m, walls);
            if let Some(seat) = self.seat {
                self.drag(seat, word, drags, walls, out);
            }
        }
    }

    fn drag(&mut self, seat: Seat, word: u32, drags: f64, walls: &Walls, out: &mut Vec<Mark>) {
        self.sits += 1;
        let mut random = SplitMix64::new(u64::from(word) << 32 | u64::from(self.sits));
        let mut expected = drags;
        while f64::from(random.unit()) < expected {
            seat.drag(&mut random, walls, out);
            expected -= 1.0;
        }
    }
}

impl Seat {
    /// The seat at which somebody sits.
    fn at(place_m: Vec2, walls: &Walls) -> Option<Seat> {
        let near = walls.nearest(place_m, AT_SEAT_M)?;
        let face = &walls.faces[near.face?];
        let is_chair = face.furniture_m == PlanClass::Seat.height_m() && face.length_m() <= LARGEST_CHAIR_M;
        let out = (place_m - near.point_m).normalized().filter(|_| is_chair)?;
        Some(Seat { edge_m: near.point_m, out })
    }

    /// The lines of two legs, as far as they lie on floor beside the seat.
    fn drag(&self, random: &mut SplitMix64, walls: &Walls, out: &mut Vec<Mark>) {
        let apart_m = f64::from(random.range(LEGS_M[0], LEGS_M[1]));
        let length_m = f64::from(random.range(DRAWN_M[0], DRAWN_M[1]));
        let heading = turned_by(self.out, f64::from(random.range(-ASIDE_RAD, ASIDE_RAD)));
        let from_m = self.edge_m + self.out * f64::from(random.range(0.01, 0.08));
        for side in [-0.5, 0.5] {
            let start_m = from_m + self.out.left() * (side * apart_m);
            let end_m = start_m + heading * length_m;
            let density = (DENSITY * exp(SIGMA * f64::from(random.normal()))).min(MOST_DENSITY) as f32;
            let (breadth_m, variation) = (random.range(BREADTH_M[0], BREADTH_M[1]), random.next_u64());
            if walls.is_inside(start_m) && walls.is_inside(end_m) && walls.sight(start_m, end_m) {
                out.push(Mark {
                    cause: Cause::Heel,
                    place_m: start_m.lerp(end_m, 0.5),
                    heading,
                    mirrored: false,
                    pattern: 0,
                    length_m: length_m as f32,
                    smear_m: 0.0,
                    twist_rad: 0.0,
                    forefoot: 0.0,
                    // A leg sticks first and slides then.
                    effort: -density,
                    stood_s: 0.0,
                    wheel_m: breadth_m,
                    strength: density,
                    soil: 0.0,
                    wet: 0.0,
                    wear: 0,
                    variation,
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::plan::FloorPlan;

    /// A room of 6 x 6 m with a piece of furniture of 0.5 x 0.5 m in its middle.
    fn room(class: PlanClass) -> Walls {
        let is_piece = |k: usize| (28..33).contains(&(k % 60)) && (28..33).contains(&(k / 60));
        let classes = (0..3600).map(|k| if is_piece(k) { class } else { PlanClass::Floor }).collect();
        let plan = FloorPlan::from_mask(60, 60, 0.1, (0..3600).map(|k| u8::from(!is_piece(k))).collect());
        Walls::trace(&FloorPlan { classes, ..plan }, &Default::default())
    }

    /// What 400 people leave who walk up to a place, stay for some seconds, and go.
    fn drags(walls: &Walls, place_m: Vec2, stay_s: f64) -> Vec<Mark> {
        let mut marks = Vec::new();
        for person in 0..400 {
            let mut sitting = Sitting::default();
            let mut pass =
                |place_m: Vec2, stood_s: f64| sitting.pass(place_m, stood_s, walls, (person * 7919, 0.5), &mut marks);
            (0..10).for_each(|k| pass(place_m + vec2(0.0, -2.0 + 0.2 * f64::from(k)), 0.0));
            (0..(stay_s / 0.1) as u32).for_each(|_| pass(place_m, 0.1));
            (0..10).for_each(|k| pass(place_m + vec2(0.0, -0.3 - 0.2 * f64::from(k)), 0.0));
        }
        marks
    }

    #[test]
    fn chairs_are_drawn_away_from_their_desks_in_pairs_of_lines() {
        let walls = room(PlanClass::Seat);
        // South of the seat, whose edge lies at 2.7 m.
        let marks = drags(&walls, vec2(3.05, 2.4), 9.0);
        // 400 people, twice, half of the times: 400 drags of two lines.
        assert!((600..1000).contains(&marks.len()), "{} lines", marks.len());
        let mean_x = marks.iter().map(|mark| mark.place_m.x).sum::<f64>() / marks.len() as f64;
        assert!((mean_x - 3.05).abs() < 0.03, "{mean_x}");
        for mark in &marks {
            assert!(mark.heading.y < -0.9 && (2.1..2.7).contains(&mark.place_m.y), "{mark:?}");
            assert!((0.1..0.3).contains(&(mark.place_m.x - 3.05).abs()), "{mark:?}");
        }
        assert!(drags(&walls, vec2(3.05, 2.4), 2.0).is_empty(), "nobody sits down for two seconds");
        assert!(drags(&walls, vec2(3.05, 1.9), 9.0).is_empty(), "nobody sits half a metre from the seat's edge");
    }

    #[test]
    fn tables_and_walls_are_not_drawn() {
        assert!(drags(&room(PlanClass::Table), vec2(3.05, 2.4), 9.0).is_empty());
        assert!(drags(&room(PlanClass::Seat), vec2(3.05, 0.3), 9.0).is_empty());
    }
}
