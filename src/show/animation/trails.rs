use crate::math::Vec2;
use crate::motion::Walker;

/// Number of places kept per person: the way since the last picture, and half as far back again.
const PLACES: usize = 6;
/// Speed above which a person has been moved, not walked, metres per second.
const FASTEST_M_S: f64 = 20.0;

/// The latest places of each person: between two pictures people may walk some metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Trails {
    /// By ascending id, the newest place first.
    tails: Vec<Trail>,
}

#[derive(Clone, Debug)]
struct Trail {
    id: u32,
    places: Vec<Vec2>,
}

impl Trails {
    /// Takes everybody's places, `step_s` after the last ones.
    pub(super) fn push(&mut self, walkers: &[Walker], step_s: f64) {
        let mut before = std::mem::take(&mut self.tails).into_iter().peekable();
        self.tails.reserve(walkers.len());
        for walker in walkers {
            while before.next_if(|tail| tail.id < walker.id).is_some() {}
            let known = before.next_if(|tail| tail.id == walker.id);
            let mut tail = known.unwrap_or_else(|| Trail { id: walker.id, places: Vec::with_capacity(PLACES + 1) });
            let jumped = |last: &Vec2| last.distance(walker.position_m) > FASTEST_M_S * step_s;
            if tail.places.first().is_some_and(jumped) {
                tail.places.clear();
            }
            tail.places.insert(0, walker.position_m);
            tail.places.truncate(PLACES);
            self.tails.push(tail);
        }
    }

    /// Everybody's last places, in the order of the walkers pushed last.
    pub(super) fn places(&self) -> impl Iterator<Item = &[Vec2]> {
        self.tails.iter().map(|tail| &tail.places[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;

    #[test]
    fn tails_follow_and_end_where_somebody_is_put_elsewhere() {
        let walker = |id, x| Walker { id, position_m: vec2(x, 0.0), velocity_m_s: Vec2::ZERO, heading: None };
        let mut tails = Trails::default();
        for step in 0..9 {
            tails.push(&[walker(2, f64::from(step)), walker(5, if step == 8 { 200.0 } else { 1.0 })], 1.0);
        }
        let places: Vec<Vec<f64>> = tails.places().map(|tail| tail.iter().map(|p| p.x).collect()).collect();
        assert_eq!(places, [vec![8.0, 7.0, 6.0, 5.0, 4.0, 3.0], vec![200.0]]);
        tails.push(&[walker(5, 200.0)], 1.0);
        assert_eq!(tails.places().count(), 1);
    }
}
