use std::collections::HashMap;
use std::sync::Arc;

/// Body heights that count as such, metres: what is lower or higher was not seen well.
const PLAUSIBLE_M: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// Body heights of people by id, as a recording tells them. Copies share their memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statures(Arc<HashMap<u32, f64>>);

impl Statures {
    /// Body height of a person, metres, if it is known.
    pub fn of(&self, id: u32) -> Option<f64> {
        self.0.get(&id).copied()
    }

    /// Notes a body height in metres, unless the person has one already or the height is impossible.
    pub(crate) fn note(&mut self, id: u32, height_m: f64) {
        if PLAUSIBLE_M.contains(&height_m) {
            Arc::make_mut(&mut self.0).entry(id).or_insert(height_m);
        }
    }
}

impl FromIterator<(u32, f64)> for Statures {
    /// Of each id the first height in metres that a person may have.
    fn from_iter<I: IntoIterator<Item = (u32, f64)>>(pairs: I) -> Statures {
        let mut statures = Statures::default();
        pairs.into_iter().for_each(|(id, height_m)| statures.note(id, height_m));
        statures
    }
}
