//! The contact model: which walls, doors, corners and fixtures a person can touch, and how often.

use rand::RngExt;

use crate::motion::Person;
use crate::patterns::PatternLibrary;
use crate::walls::{Walls, closest_on};

use super::place_index::{PlaceIndex, crossing};
use super::places::{self, NEAR_M};
use super::state::{ContactState, ContactTick, PassedCorner};
use super::step::{ContactStep, carries};
use super::touch::{self, BodyPart, Touch};
use super::wall_patterns::WallPatterns;
use super::wall_side::{self, WallSide};
use super::{ContactOptions, ContactPlaces, ContactRule};
use crate::marks::Contact;
use crate::marks::rest::waiting;

/// Path length and time between two checks.
const LOOK_M: f64 = 0.25;
const LOOK_S: f64 = 0.45;
/// Search radius for the nearest wall, metres: without a wall in it the next check is this less [`NEAR_M`] away.
const LOOK_OUT_M: f64 = 1.6;
/// Tolerance for rounding, metres.
const SEEN_M: f64 = 1e-6;
/// Distances from the body's side up to which a jamb or a corner gets its full rate, and from which it gets none,
/// metres.
const AT_HAND_M: [f64; 2] = [0.5, 0.8];
/// Turns below the first angle count nothing, from the second on fully, radians.
const TURN_RAD: [f64; 2] = [0.3, 0.9];
/// Clear width, as a multiple of [`ContactOptions::narrow_m`], below which hands trail along walls more often, and how
/// many times more.
const HELD_WIDTH: f64 = 1.25;
const HELD: f64 = 1.5;
/// Factor on the reach of a shoulder for people who stand and lean.
const LEANS: f64 = 2.0;

/// The contact model: places, rates and patterns for all people.
pub(crate) struct Contacts {
    options: ContactOptions,
    /// Factor on each person's rates, see [`ContactOptions::people`].
    rate_factor: f64,
    wall_patterns: WallPatterns,
    places: ContactPlaces,
    place_index: PlaceIndex,
}

impl Contacts {
    /// Prepares the model for a crowd of this size; `None` if all rates are zero or the library has no wall pattern.
    pub fn new(
        walls: &Walls,
        library: &PatternLibrary,
        options: &ContactOptions,
        crowd: usize,
        places: impl FnOnce() -> ContactPlaces,
    ) -> Option<Contacts> {
        let wall_patterns = WallPatterns::new(library);
        if options.is_none() || wall_patterns.is_empty() {
            return None;
        }
        let places = places();
        let place_index = PlaceIndex::new(walls, &places);
        Some(Contacts {
            options: options.clone(),
            rate_factor: options.rate_factor(crowd),
            wall_patterns,
            places,
            place_index,
        })
    }

    /// Advances a person by a tick; appends contacts to `out`.
    pub fn walk(
        &self,
        state: &mut ContactState,
        walls: &Walls,
        person: &Person,
        tick: &ContactTick,
        out: &mut Vec<Contact>,
    ) {
        state.walked_m += tick.walked_m;
        state.stood_s += tick.stood_s;
        let Some(from_m) = state.from_m else {
            state.from_m = Some(tick.at_m);
            return;
        };
        if state.walked_m < LOOK_M && state.stood_s < LOOK_S {
            return;
        }
        let way = (tick.at_m - from_m).normalized().or(tick.velocity_m_s.normalized());
        let step = ContactStep {
            person,
            from_m,
            at_m: tick.at_m,
            facing: tick.facing,
            way: way.unwrap_or(tick.facing),
            velocity_m_s: tick.velocity_m_s,
            walked_m: std::mem::take(&mut state.walked_m),
            stood_s: std::mem::take(&mut state.stood_s),
        };
        state.from_m = Some(tick.at_m);
        let moved_m = from_m.distance(tick.at_m);
        state.clear_m -= moved_m;
        state.seen_m += moved_m;
        if state.clear_m > 0.0 {
            return;
        }
        state.chances.clear();
        // The bound on the wall's distance limits the search.
        let near = walls.nearest(step.at_m, (state.seen_m + SEEN_M).min(LOOK_OUT_M));
        state.clear_m = near.map_or(LOOK_OUT_M, |near| near.distance_m) - NEAR_M;
        state.seen_m = near.map_or(f64::INFINITY, |near| near.distance_m);
        if let Some(near) = near.filter(|near| near.distance_m <= NEAR_M) {
            let sides = wall_side::sides(walls, &step, near);
            match self.options.rule {
                ContactRule::Causes => {
                    let clear_width_m = wall_side::clear_width_m(&sides);
                    for side in sides.iter().flatten() {
                        self.beside(&step, side, clear_width_m, &mut state.chances);
                    }
                    self.doors(&step, state);
                    self.corners(&step, walls, state);
                    self.fixtures(&step, walls, state);
                }
                ContactRule::Distance => {
                    for side in sides.iter().flatten() {
                        self.by_distance(&step, side, &mut state.chances);
                    }
                }
            }
        } else if !state.passing.is_empty() || !state.visiting.is_empty() {
            state.visiting.clear();
            self.corners(&step, walls, state);
        }
        self.happen(&step, walls, state, out);
    }

    /// Advances the contact clock and draws the contacts that are due.
    fn happen(&self, step: &ContactStep, walls: &Walls, state: &mut ContactState, out: &mut Vec<Contact>) {
        let expected: f64 = state.chances.iter().map(|chance| chance.0).sum();
        state.until_next -= self.rate_factor * expected;
        while state.until_next <= 0.0 {
            state.until_next += waiting(&mut state.rng);
            let mut left = state.rng.random::<f64>() * expected;
            let word: u64 = state.rng.random();
            let chosen = state.chances.iter().find(|chance| {
                left -= chance.0;
                left < 0.0
            });
            if let Some((_, touch)) = chosen.or(state.chances.last()) {
                out.extend(touch::contact(&self.options, &self.wall_patterns, &self.places, walls, step, touch, word));
            }
        }
    }

    /// Adds the possible touches of a wall beside the body.
    fn beside(&self, step: &ContactStep, side: &WallSide, clear_width_m: f64, chances: &mut Vec<(f64, Touch)>) {
        let options = &self.options;
        let gap_m = side.gap_m.max(0.0);
        let share = gap_m / options.reach_m;
        let mut add = |expected: f64, part: BodyPart| {
            if expected > 0.0 {
                chances.push((expected, Touch::Beside { side: *side, part }));
            }
        };
        let walked_m = if side.is_at_side() { step.walked_m } else { 0.0 };
        if share < 1.0 {
            // Whoever goes through a narrow way holds on to it: a line at the height of hands.
            let narrow = ((HELD_WIDTH * options.narrow_m - clear_width_m) / (0.3 * options.narrow_m)).clamp(0.0, 1.0);
            let hands = options.hand_per_metre * (1.0 + HELD * narrow);
            add(hands * walked_m * (1.5 - share), BodyPart::Trailing);
            add(options.shoe_per_metre * walked_m * 3.0 * (1.0 - share) * (1.0 - share), BodyPart::Shoe);
            if side.has_bag(step.person) {
                add(options.bag_per_metre * walked_m * (1.5 - share), BodyPart::Bag);
            }
        }
        if gap_m < options.close_m {
            add(options.arm_per_metre * walked_m, BodyPart::Arm);
            if clear_width_m < options.narrow_m {
                add(options.shoulder_per_metre * walked_m, BodyPart::Shoulder);
            }
        }
        let leans = 1.0 - gap_m / (LEANS * options.close_m);
        if step.stood_s > 0.0 && leans > 0.0 {
            add(options.lean_per_second * step.stood_s * leans, BodyPart::Lean);
        }
    }

    /// Adds touches by distance alone: any body part very close to the wall, hands and luggage farther away.
    fn by_distance(&self, step: &ContactStep, side: &WallSide, chances: &mut Vec<(f64, Touch)>) {
        let options = &self.options;
        let gap_m = side.gap_m.max(0.0);
        let mut add = |rate: f64, limit_m: f64, part: BodyPart| {
            let expected = rate * step.walked_m * (1.0 - gap_m / limit_m);
            if gap_m < limit_m && expected > 0.0 {
                chances.push((expected, Touch::Beside { side: *side, part }));
            }
        };
        let close = [BodyPart::Arm, BodyPart::Shoulder, BodyPart::Shoe];
        let bag = step.person.bag.is_some();
        let parts = close.len() as f64 + f64::from(u8::from(bag));
        for part in close.into_iter().chain(bag.then_some(BodyPart::Bag)) {
            add(options.distance_close_per_metre / parts, options.close_m, part);
        }
        add(options.distance_far_per_metre / if bag { 2.0 } else { 1.0 }, options.reach_m, BodyPart::Trailing);
        if bag {
            add(options.distance_far_per_metre / 2.0, options.reach_m, BodyPart::Bag);
        }
    }

    /// Adds the possible touches of the jambs of passed doors.
    fn doors(&self, step: &ContactStep, state: &mut ContactState) {
        let options = &self.options;
        self.place_index.doors.around(step.at_m, LOOK_OUT_M, &mut state.numbers);
        for &number in &state.numbers {
            let door = &self.places.doors()[number as usize];
            let jambs_m = door.doorway.jambs_m;
            let Some(at_m) = crossing(step.from_m, step.at_m, jambs_m) else { continue };
            let onward = step.way.dot(door.doorway.through) > 0.0;
            let near = jambs_m.map(|jamb| at_hand(jamb.distance(at_m) - 0.5 * step.person.shoulder_width_m));
            let split = (near[0] + near[1]).max(1.0);
            for (jamb, near) in near.into_iter().enumerate() {
                let on_left = step.way.cross(jambs_m[jamb] - at_m) > 0.0;
                let mut add = |rate: f64, part: BodyPart| {
                    if rate * near > 0.0 {
                        state
                            .chances
                            .push((rate * near / split, Touch::Jamb { door: number, jamb, onward, part, near }));
                    }
                };
                add(options.jamb_hand_per_passage, BodyPart::Hand);
                if door.doorway.width_m() < options.narrow_m {
                    add(options.jamb_shoulder_per_passage, BodyPart::Shoulder);
                }
                if carries(step.person, on_left) {
                    add(options.jamb_bag_per_passage * split, BodyPart::Bag);
                }
                add(options.jamb_shoe_per_passage, BodyPart::Shoe);
            }
        }
    }

    /// Adds the possible touches of corners, evaluated when a corner is left behind.
    fn corners(&self, step: &ContactStep, walls: &Walls, state: &mut ContactState) {
        let options = &self.options;
        self.place_index.corners.around(step.at_m, NEAR_M, &mut state.numbers);
        let apart_m = |corner: u32| self.places.corners()[corner as usize].point_m.distance(step.at_m);
        state.numbers.retain(|&corner| apart_m(corner) <= NEAR_M);
        let ContactState { passing, numbers, chances, .. } = state;
        passing.retain(|passed| {
            if numbers.contains(&passed.corner) {
                return true;
            }
            let turned_rad = crate::math::atan2(passed.way_in.cross(step.way), passed.way_in.dot(step.way));
            let towards_rad = if passed.on_left { turned_rad } else { -turned_rad };
            let turned = ((towards_rad - TURN_RAD[0]) / (TURN_RAD[1] - TURN_RAD[0])).clamp(0.0, 1.0);
            let near = at_hand(passed.least_m - 0.5 * step.person.shoulder_width_m) * turned;
            let mut add = |rate: f64, part: BodyPart| {
                if rate * near > 0.0 {
                    chances.push((rate * near, Touch::Corner { corner: passed.corner, part, near }));
                }
            };
            add(options.corner_per_turn, BodyPart::Hand);
            if carries(step.person, passed.on_left) {
                add(options.corner_bag_per_turn, BodyPart::Bag);
            }
            add(options.corner_shoe_per_turn, BodyPart::Shoe);
            false
        });
        for &corner in numbers.iter() {
            let to = self.places.corners()[corner as usize].point_m - step.at_m;
            let least_m = to.length();
            match passing.iter_mut().find(|passed| passed.corner == corner) {
                Some(passed) if passed.least_m > least_m => {
                    (passed.least_m, passed.on_left) = (least_m, step.way.cross(to) > 0.0);
                }
                Some(_) => {}
                None if places::sees(walls, step.at_m, step.at_m + to) => {
                    passing.push(PassedCorner { corner, way_in: step.way, least_m, on_left: step.way.cross(to) > 0.0 });
                }
                None => {}
            }
        }
    }

    /// Adds the possible touches of fixtures in reach: once per passage, and per second stood.
    fn fixtures(&self, step: &ContactStep, walls: &Walls, state: &mut ContactState) {
        let options = &self.options;
        self.place_index.fixtures.around(step.at_m, LOOK_OUT_M, &mut state.numbers);
        let ContactState { visiting, numbers, chances, .. } = state;
        let nearest = |fixture: u32| {
            let [a, b] = self.place_index.ends_m[fixture as usize];
            closest_on(a, b, step.at_m)
        };
        let in_reach = |fixture: u32| {
            let reach_m = self.places.fixtures()[fixture as usize].reach_m;
            nearest(fixture).distance(step.at_m) <= reach_m
        };
        visiting.retain(|fixture| numbers.contains(fixture) && in_reach(*fixture));
        for &fixture in numbers.iter().filter(|&&fixture| in_reach(fixture)) {
            let (passage, second) = touch::fixture_rates(self.places.fixtures()[fixture as usize].kind);
            let mut expected = 0.0;
            if !visiting.contains(&fixture) {
                if !places::sees(walls, step.at_m, nearest(fixture)) {
                    continue;
                }
                visiting.push(fixture);
                expected += options.fixture_per_passage * passage;
            }
            expected += options.fixture_per_second * second * step.stood_s;
            if expected > 0.0 {
                chances.push((expected, Touch::Fixture { fixture }));
            }
        }
    }
}

/// Factor on the rate at a distance from the body's side, 1 to 0.
fn at_hand(gap_m: f64) -> f64 {
    let [all_m, none_m] = AT_HAND_M;
    ((none_m - gap_m) / (none_m - all_m)).clamp(0.0, 1.0)
}
