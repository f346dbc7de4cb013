//! Contacts: where people touch walls while they walk, turn, pass doors, and stand.
//!
//! Every look at the smoothed path, one per 25 cm walked or half a second stood, lists what could touch what: the walls on
//! either side by their distance from the body's side, jambs that were passed, corners that were turned round, fixtures
//! in reach. Each has an expected number of touches; they run down one clock per person, and when it is over one of them
//! happens. Most people who walk a corridor touch nothing at all.

mod beside;
mod nearby;
mod options;
mod places;
mod requests;
mod stains;
mod touch;

pub use options::{ContactOptions, ContactRule};
pub use places::{ContactPlaces, Door, Fixture};
pub use requests::{DoorRequest, FixtureAt, FixtureKind, FixtureRequest};

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Purpose, Vec2, person_stream};
use crate::motion::{CarrySide, Person};
use crate::patterns::PatternLibrary;
use crate::walls::Walls;

use super::Contact;
use super::rest::waiting;
use beside::Beside;
use nearby::{NEAR_M, Nearby, closest_on, crossing};
use stains::Stains;
use touch::{Part, Touch};

/// Way and time between two looks.
const LOOK_M: f64 = 0.25;
const LOOK_S: f64 = 0.45;
/// How far a look for the nearest wall goes, metres: who sees none walks on that much less `NEAR_M` without another.
const LOOK_OUT_M: f64 = 1.6;
/// Room for rounding, metres.
const SEEN_M: f64 = 1e-6;
/// A jamb or a corner is touched by everybody who passes so close to it by the side, and by nobody farther off than the
/// second, metres.
const AT_HAND_M: [f64; 2] = [0.5, 0.8];
/// A turn counts in full from the second angle on, below the first not at all, radians.
const TURN_RAD: [f64; 2] = [0.3, 0.9];
/// Somebody who stands leans on a wall that is so much farther away than what a shoulder brushes in walking.
const LEANS: f64 = 2.0;

/// What can be touched, how often, and what it leaves.
pub(super) struct Contacts {
    options: ContactOptions,
    /// For how many people each one touches.
    stand_ins: f64,
    stains: Stains,
    places: ContactPlaces,
    nearby: Nearby,
}

/// What one person's body has been through.
pub(super) struct Touches {
    rng: ChaCha8Rng,
    /// Expected contacts until the next one.
    until_next: f64,
    /// Where the last look was.
    from_m: Option<Vec2>,
    walked_m: f64,
    stood_s: f64,
    /// No wall is in reach for so much way, metres.
    clear_m: f64,
    /// The nearest wall is no farther than this; infinite if nobody knows. Metres.
    seen_m: f64,
    /// Corners in reach.
    passing: Vec<Passing>,
    /// Fixtures in reach.
    visiting: Vec<u32>,
    /// What could happen at a look, with its expected number.
    chances: Vec<(f64, Touch)>,
    numbers: Vec<u32>,
}

/// Somebody who passes a corner.
struct Passing {
    corner: u32,
    /// Where they went when it came into reach.
    way_in: Vec2,
    /// Where they are nearest to it: how far, and whether it is on their left.
    least_m: f64,
    on_left: bool,
}

/// A tick of somebody's path.
pub(super) struct Moment {
    pub at_m: Vec2,
    /// Where the body faces.
    pub facing: Vec2,
    pub velocity_m_s: Vec2,
    pub walked_m: f64,
    pub stood_s: f64,
}

/// A piece of way between two looks.
pub(super) struct Look<'a> {
    pub person: &'a Person,
    pub from_m: Vec2,
    pub at_m: Vec2,
    pub facing: Vec2,
    /// Unit vector of the way.
    pub way: Vec2,
    pub walked_m: f64,
    pub stood_s: f64,
}

impl Contacts {
    /// `None` where nobody can touch anything, or nothing would be seen of it.
    pub fn new(
        walls: &Walls,
        library: &PatternLibrary,
        options: &ContactOptions,
        crowd: usize,
        places: impl FnOnce() -> ContactPlaces,
    ) -> Option<Contacts> {
        let stains = Stains::new(library);
        if options.is_none() || stains.is_empty() {
            return None;
        }
        let places = places();
        let nearby = Nearby::new(walls, &places);
        Some(Contacts { options: options.clone(), stand_ins: options.stand_ins(crowd), stains, places, nearby })
    }

    /// Lives through a tick; gives the contacts that happen to `out`.
    pub fn walk(&self, touches: &mut Touches, walls: &Walls, person: &Person, moment: &Moment, out: &mut Vec<Contact>) {
        touches.walked_m += moment.walked_m;
        touches.stood_s += moment.stood_s;
        let Some(from_m) = touches.from_m else {
            touches.from_m = Some(moment.at_m);
            return;
        };
        if touches.walked_m < LOOK_M && touches.stood_s < LOOK_S {
            return;
        }
        let way = (moment.at_m - from_m).normalized().or(moment.velocity_m_s.normalized());
        let look = Look {
            person,
            from_m,
            at_m: moment.at_m,
            facing: moment.facing,
            way: way.unwrap_or(moment.facing),
            walked_m: std::mem::take(&mut touches.walked_m),
            stood_s: std::mem::take(&mut touches.stood_s),
        };
        touches.from_m = Some(moment.at_m);
        let moved_m = from_m.distance(moment.at_m);
        touches.clear_m -= moved_m;
        touches.seen_m += moved_m;
        if touches.clear_m > 0.0 {
            return;
        }
        touches.chances.clear();
        // A wall that was near is not far: there is no need to look beyond it.
        let near = walls.nearest(look.at_m, (touches.seen_m + SEEN_M).min(LOOK_OUT_M));
        touches.clear_m = near.map_or(LOOK_OUT_M, |near| near.distance_m) - NEAR_M;
        touches.seen_m = near.map_or(f64::INFINITY, |near| near.distance_m);
        if let Some(near) = near.filter(|near| near.distance_m <= NEAR_M) {
            let sides = beside::sides(walls, &look, near);
            match self.options.rule {
                options::ContactRule::Causes => {
                    let clear_width_m = beside::clear_width_m(&sides);
                    for side in sides.iter().flatten() {
                        self.beside(&look, side, clear_width_m, &mut touches.chances);
                    }
                    self.doors(&look, touches);
                    self.corners(&look, walls, touches);
                    self.fixtures(&look, walls, touches);
                }
                options::ContactRule::Distance => {
                    for side in sides.iter().flatten() {
                        self.by_distance(&look, side, &mut touches.chances);
                    }
                }
            }
        } else if !touches.passing.is_empty() || !touches.visiting.is_empty() {
            touches.visiting.clear();
            self.corners(&look, walls, touches);
        }
        self.happen(&look, walls, touches, out);
    }

    /// Runs down the clock; lets happen what does.
    fn happen(&self, look: &Look, walls: &Walls, touches: &mut Touches, out: &mut Vec<Contact>) {
        let expected: f64 = touches.chances.iter().map(|chance| chance.0).sum();
        touches.until_next -= self.stand_ins * expected;
        while touches.until_next <= 0.0 {
            touches.until_next += waiting(&mut touches.rng);
            let mut left = touches.rng.random::<f64>() * expected;
            let word: u64 = touches.rng.random();
            let chosen = touches.chances.iter().find(|chance| {
                left -= chance.0;
                left < 0.0
            });
            if let Some((_, touch)) = chosen.or(touches.chances.last()) {
                out.extend(touch::contact(&self.options, &self.stains, &self.places, walls, look, touch, word));
            }
        }
    }

    /// What a wall at the side of the body can take.
    fn beside(&self, look: &Look, side: &Beside, clear_width_m: f64, chances: &mut Vec<(f64, Touch)>) {
        let options = &self.options;
        let gap_m = side.gap_m.max(0.0);
        let share = gap_m / options.reach_m;
        let mut add = |expected: f64, part: Part| {
            if expected > 0.0 {
                chances.push((expected, Touch::Beside { side: *side, part }));
            }
        };
        let walked_m = if side.is_at_side() { look.walked_m } else { 0.0 };
        if share < 1.0 {
            add(options.hand_per_metre * walked_m * (1.5 - share), Part::Trailing);
            add(options.shoe_per_metre * walked_m * 3.0 * (1.0 - share) * (1.0 - share), Part::Shoe);
            if side.has_bag(look.person) {
                add(options.bag_per_metre * walked_m * (1.5 - share), Part::Bag);
            }
        }
        if gap_m < options.close_m {
            add(options.arm_per_metre * walked_m, Part::Arm);
            if clear_width_m < options.narrow_m {
                add(options.shoulder_per_metre * walked_m, Part::Shoulder);
            }
        }
        let leans = 1.0 - gap_m / (LEANS * options.close_m);
        if look.stood_s > 0.0 && leans > 0.0 {
            add(options.lean_per_second * look.stood_s * leans, Part::Lean);
        }
    }

    /// The paper's rule: the nearer the wall, the more often; very close any part, farther only hand and belongings.
    fn by_distance(&self, look: &Look, side: &Beside, chances: &mut Vec<(f64, Touch)>) {
        let options = &self.options;
        let gap_m = side.gap_m.max(0.0);
        let mut add = |rate: f64, limit_m: f64, part: Part| {
            let expected = rate * look.walked_m * (1.0 - gap_m / limit_m);
            if gap_m < limit_m && expected > 0.0 {
                chances.push((expected, Touch::Beside { side: *side, part }));
            }
        };
        let close = [Part::Arm, Part::Shoulder, Part::Shoe];
        let bag = look.person.bag.is_some();
        let parts = close.len() as f64 + f64::from(u8::from(bag));
        for part in close.into_iter().chain(bag.then_some(Part::Bag)) {
            add(options.distance_close_per_metre / parts, options.close_m, part);
        }
        add(options.distance_far_per_metre / if bag { 2.0 } else { 1.0 }, options.reach_m, Part::Trailing);
        if bag {
            add(options.distance_far_per_metre / 2.0, options.reach_m, Part::Bag);
        }
    }

    /// Jambs of the doors that were passed.
    fn doors(&self, look: &Look, touches: &mut Touches) {
        let options = &self.options;
        self.nearby.doors.around(look.at_m, LOOK_OUT_M, &mut touches.numbers);
        for &number in &touches.numbers {
            let door = &self.places.doors()[number as usize];
            let jambs_m = door.doorway.jambs_m;
            let Some(at_m) = crossing(look.from_m, look.at_m, jambs_m) else { continue };
            let onward = look.way.dot(door.doorway.through) > 0.0;
            let near = jambs_m.map(|jamb| at_hand(jamb.distance(at_m) - 0.5 * look.person.shoulder_width_m));
            let split = (near[0] + near[1]).max(1.0);
            for (jamb, near) in near.into_iter().enumerate() {
                let on_left = look.way.cross(jambs_m[jamb] - at_m) > 0.0;
                let mut add = |rate: f64, part: Part| {
                    if rate * near > 0.0 {
                        touches.chances.push((rate * near / split, Touch::Jamb { door: number, jamb, onward, part }));
                    }
                };
                add(options.jamb_hand_per_passage, Part::Hand);
                if door.doorway.width_m() < options.narrow_m {
                    add(options.jamb_shoulder_per_passage, Part::Shoulder);
                }
                if carries(look.person, on_left) {
                    add(options.jamb_bag_per_passage * split, Part::Bag);
                }
                add(options.jamb_shoe_per_passage, Part::Shoe);
            }
        }
    }

    /// Corners that were turned round: judged when they are left behind.
    fn corners(&self, look: &Look, walls: &Walls, touches: &mut Touches) {
        let options = &self.options;
        self.nearby.corners.around(look.at_m, NEAR_M, &mut touches.numbers);
        let apart_m = |corner: u32| self.places.corners()[corner as usize].point_m.distance(look.at_m);
        touches.numbers.retain(|&corner| apart_m(corner) <= NEAR_M);
        let Touches { passing, numbers, chances, .. } = touches;
        passing.retain(|passed| {
            if numbers.contains(&passed.corner) {
                return true;
            }
            let turned_rad = crate::math::atan2(passed.way_in.cross(look.way), passed.way_in.dot(look.way));
            let towards_rad = if passed.on_left { turned_rad } else { -turned_rad };
            let turned = ((towards_rad - TURN_RAD[0]) / (TURN_RAD[1] - TURN_RAD[0])).clamp(0.0, 1.0);
            let near = at_hand(passed.least_m - 0.5 * look.person.shoulder_width_m) * turned;
            let mut add = |rate: f64, part: Part| {
                if rate * near > 0.0 {
                    chances.push((rate * near, Touch::Corner { corner: passed.corner, part }));
                }
            };
            add(options.corner_per_turn, Part::Hand);
            if carries(look.person, passed.on_left) {
                add(options.corner_bag_per_turn, Part::Bag);
            }
            add(options.corner_shoe_per_turn, Part::Shoe);
            false
        });
        for &corner in numbers.iter() {
            let to = self.places.corners()[corner as usize].point_m - look.at_m;
            let least_m = to.length();
            match passing.iter_mut().find(|passed| passed.corner == corner) {
                Some(passed) if passed.least_m > least_m => {
                    (passed.least_m, passed.on_left) = (least_m, look.way.cross(to) > 0.0);
                }
                Some(_) => {}
                None if places::sees(walls, look.at_m, look.at_m + to) => {
                    passing.push(Passing { corner, way_in: look.way, least_m, on_left: look.way.cross(to) > 0.0 });
                }
                None => {}
            }
        }
    }

    /// Fixtures in reach: what a passage leaves, once, and what standing there does.
    fn fixtures(&self, look: &Look, walls: &Walls, touches: &mut Touches) {
        let options = &self.options;
        self.nearby.fixtures.around(look.at_m, LOOK_OUT_M, &mut touches.numbers);
        let Touches { visiting, numbers, chances, .. } = touches;
        let nearest = |fixture: u32| closest_on(self.nearby.ends_m[fixture as usize], look.at_m);
        let in_reach = |fixture: u32| {
            let reach_m = self.places.fixtures()[fixture as usize].reach_m;
            nearest(fixture).distance(look.at_m) <= reach_m
        };
        visiting.retain(|fixture| numbers.contains(fixture) && in_reach(*fixture));
        for &fixture in numbers.iter().filter(|&&fixture| in_reach(fixture)) {
            let (passage, second) = touch::fixture_rates(self.places.fixtures()[fixture as usize].kind);
            let mut expected = 0.0;
            if !visiting.contains(&fixture) {
                if !places::sees(walls, look.at_m, nearest(fixture)) {
                    continue;
                }
                visiting.push(fixture);
                expected += options.fixture_per_passage * passage;
            }
            expected += options.fixture_per_second * second * look.stood_s;
            if expected > 0.0 {
                chances.push((expected, Touch::Fixture { fixture }));
            }
        }
    }
}

impl Touches {
    /// Nothing touched yet.
    pub fn new(seed: u64, person: &Person) -> Touches {
        let mut rng = person_stream(seed, person.id, Purpose::Contacts);
        Touches {
            until_next: waiting(&mut rng),
            rng,
            from_m: None,
            walked_m: 0.0,
            stood_s: 0.0,
            clear_m: 0.0,
            seen_m: f64::INFINITY,
            passing: Vec::new(),
            visiting: Vec::new(),
            chances: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// Forgets where the person was.
    pub fn interrupt(&mut self) {
        self.from_m = None;
        (self.walked_m, self.stood_s, self.clear_m, self.seen_m) = (0.0, 0.0, 0.0, f64::INFINITY);
        self.passing.clear();
        self.visiting.clear();
    }
}

/// How likely something so far from the body's side is touched: 1 to 0.
fn at_hand(gap_m: f64) -> f64 {
    let [all_m, none_m] = AT_HAND_M;
    ((none_m - gap_m) / (none_m - all_m)).clamp(0.0, 1.0)
}

/// Whether somebody carries something on a side.
fn carries(person: &Person, on_left: bool) -> bool {
    let side = if on_left { CarrySide::Left } else { CarrySide::Right };
    person.bag.is_some_and(|bag| bag.side == side)
}
