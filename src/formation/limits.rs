/// Least number of people in a formation.
pub const LEAST_PEOPLE: usize = 2;
/// Largest number of people in one formation: its matrices hold a number for each pair.
pub const MOST_PEOPLE: usize = 2000;
/// Largest number of people of all crowds together.
pub const MOST_IN_ALL: usize = 1_000_000;
/// Largest number of pairs of people in all key formations of a crowd: each key has matrices with a number per pair.
pub const MOST_KEY_PAIRS: usize = 64_000_000;
/// Largest number of places of a formation, people times frames: several of its steps hold all of them at once.
pub const MOST_FORMED_PLACES: usize = 20_000_000;
/// Largest coordinate or time that is accepted, metres or seconds.
pub(super) const MOST_NUMBER: f64 = 1e7;
