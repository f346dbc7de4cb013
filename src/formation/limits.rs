/// Least number of people in a formation.
pub const LEAST_PEOPLE: usize = 2;
/// Largest number of people in one formation: its matrices hold a number for each pair.
pub const MOST_PEOPLE: usize = 2000;
/// Largest coordinate or time that is accepted, metres or seconds.
pub(super) const MOST_NUMBER: f64 = 1e7;
