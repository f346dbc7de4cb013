//! The state of one person's contacts.

use rand::rngs::ChaCha8Rng;

use super::touch::Touch;
use crate::marks::rest::waiting;
use crate::math::{Purpose, Vec2, person_stream};
use crate::motion::Person;

/// The state of one person's contacts.
pub(crate) struct ContactState {
    pub rng: ChaCha8Rng,
    /// Expected number of contacts until the next one.
    pub until_next: f64,
    /// Position at the last check, metres.
    pub from_m: Option<Vec2>,
    /// Distance walked since then, metres.
    pub walked_m: f64,
    /// Time stood since then, seconds.
    pub stood_s: f64,
    /// Path length before a wall can be in reach, metres.
    pub clear_m: f64,
    /// Upper bound on the distance to the nearest wall, metres; infinite if unknown.
    pub seen_m: f64,
    /// Corners in reach.
    pub passing: Vec<PassedCorner>,
    /// Indices of fixtures in reach.
    pub visiting: Vec<u32>,
    /// Buffer: possible touches at a check, with their expected numbers.
    pub chances: Vec<(f64, Touch)>,
    /// Buffer: indices of places.
    pub numbers: Vec<u32>,
}

/// A corner that a person passes.
pub(crate) struct PassedCorner {
    pub corner: u32,
    /// Walking direction when the corner came into reach.
    pub way_in: Vec2,
    /// Distance at the nearest point, metres.
    pub least_m: f64,
    /// Whether the corner was on the left there.
    pub on_left: bool,
}

/// A tick of a person's smoothed path.
pub(crate) struct ContactTick {
    /// Position of the body, metres.
    pub at_m: Vec2,
    /// Unit vector: where the body faces.
    pub facing: Vec2,
    pub velocity_m_s: Vec2,
    pub walked_m: f64,
    pub stood_s: f64,
}

impl ContactState {
    /// The state of a person who has touched nothing yet.
    pub fn new(seed: u64, person: &Person) -> ContactState {
        let mut rng = person_stream(seed, person.id, Purpose::Contacts);
        ContactState {
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

    /// Forgets the person's position, after a gap in the path.
    pub fn interrupt(&mut self) {
        self.from_m = None;
        (self.walked_m, self.stood_s, self.clear_m, self.seen_m) = (0.0, 0.0, 0.0, f64::INFINITY);
        self.passing.clear();
        self.visiting.clear();
    }
}
