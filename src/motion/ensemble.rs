use super::{Frame, Motion, MotionError, Resampler, Statures, Walker};
use crate::math::{Rect, Vec2, vec2};

/// Largest number of positions in an ensemble, people times frames.
pub const MOST_PLACES: usize = 100_000_000;

/// A motion held as a matrix of positions: the same people in evenly spaced frames.
///
/// A row holds the positions of a frame, a column the path of a person.
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    /// Frames per second.
    pub fps: f64,
    /// Time of the first frame, seconds.
    pub start_s: f64,
    /// Ids of the people, ascending.
    pub ids: Vec<u32>,
    /// Positions in metres, frame by frame, in the order of ids.
    places_m: Vec<Vec2>,
    /// Body heights of those for whom they are known.
    statures: Statures,
}

impl Ensemble {
    /// Makes an ensemble of positions, frame by frame, in the order of ids.
    ///
    /// # Panics
    /// If the positions do not fill whole frames.
    pub fn new(fps: f64, start_s: f64, ids: Vec<u32>, places_m: Vec<Vec2>) -> Ensemble {
        let whole = if ids.is_empty() { places_m.is_empty() } else { places_m.len().is_multiple_of(ids.len()) };
        assert!(whole, "{} positions do not fill whole frames of {} people", places_m.len(), ids.len());
        Ensemble { fps, start_s, ids, places_m, statures: Statures::default() }
    }

    /// Reads the people of a motion who are present throughout `[from_s, to_s]`, at `fps` frames per second.
    ///
    /// A motion that ends earlier ends the ensemble. Positions of other people are dropped once they leave.
    ///
    /// # Errors
    /// Errors of the motion; [`MotionError::NobodyThroughout`]; [`MotionError::TooLong`] beyond `MOST_PLACES`.
    pub fn of_motion(motion: &mut dyn Motion, fps: f64, [from_s, to_s]: [f64; 2]) -> Result<Ensemble, MotionError> {
        let mut resampler = Resampler::new(fps);
        let mut frame = Frame::default();
        let mut stayers = Stayers::default();
        let mut start_s = None;
        let nobody = |until_s: f64| MotionError::NobodyThroughout { from_s, to_s: to_s.min(until_s) };
        while motion.next_frame(&mut frame)? {
            resampler.push(&frame);
            resampler.pass_over_absence();
            while let Some((number, walkers)) = resampler.next() {
                let time_s = number as f64 / fps;
                // Before the first frame there are no people.
                if time_s < from_s || time_s > to_s || (start_s.is_none() && walkers.is_empty()) {
                    continue;
                }
                start_s.get_or_insert(time_s);
                stayers.push(&walkers);
                if stayers.ids.is_empty() {
                    return Err(nobody(time_s));
                }
                if stayers.places() > MOST_PLACES {
                    return Err(MotionError::TooLong { most: MOST_PLACES });
                }
            }
            if frame.time_s > to_s {
                break;
            }
        }
        let Some(start_s) = start_s else { return Err(nobody(frame.time_s)) };
        let moments = stayers.moments;
        let places_m =
            (0..moments).flat_map(|moment| stayers.columns_m.iter().map(move |column| column[moment])).collect();
        Ok(Ensemble::new(fps, start_s, stayers.ids, places_m))
    }

    /// The same with body heights that are known.
    pub fn with_statures(self, statures: Statures) -> Ensemble {
        Ensemble { statures, ..self }
    }

    /// Body heights of those for whom they are known.
    pub fn statures(&self) -> &Statures {
        &self.statures
    }

    /// Number of people.
    pub fn people(&self) -> usize {
        self.ids.len()
    }

    /// Number of frames.
    pub fn moments(&self) -> usize {
        self.places_m.len().checked_div(self.ids.len()).unwrap_or(0)
    }

    /// The positions in a frame, in the order of ids, metres.
    pub fn places_at(&self, moment: usize) -> &[Vec2] {
        let people = self.people();
        &self.places_m[moment * people..(moment + 1) * people]
    }

    /// The positions in a frame, mutable.
    pub fn places_at_mut(&mut self, moment: usize) -> &mut [Vec2] {
        let people = self.people();
        &mut self.places_m[moment * people..(moment + 1) * people]
    }

    /// Time of a frame, seconds.
    pub fn time_s(&self, moment: usize) -> f64 {
        self.start_s + moment as f64 / self.fps
    }

    /// Centroid of the people in a frame, metres.
    pub fn centroid_m(&self, moment: usize) -> Vec2 {
        let places = self.places_at(moment);
        places.iter().fold(Vec2::ZERO, |sum, &place| sum + place) / places.len() as f64
    }

    /// Bounding rectangle of all positions, metres.
    pub fn bounds_m(&self) -> Rect {
        let point = |&p: &Vec2| Rect { min: p, max: p };
        let both = |a: Rect, b: Rect| Rect {
            min: vec2(a.min.x.min(b.min.x), a.min.y.min(b.min.y)),
            max: vec2(a.max.x.max(b.max.x), a.max.y.max(b.max.y)),
        };
        self.places_m.iter().map(point).reduce(both).unwrap_or(Rect { min: Vec2::ZERO, max: Vec2::ZERO })
    }

    /// The ensemble as a motion; velocities are central differences.
    pub fn motion(&self) -> impl Motion + Send + '_ {
        EnsembleMotion { ensemble: self, next: 0 }
    }
}

/// The people present in every frame so far.
#[derive(Default)]
struct Stayers {
    ids: Vec<u32>,
    /// The path of each of them.
    columns_m: Vec<Vec<Vec2>>,
    moments: usize,
}

impl Stayers {
    /// Takes the walkers of the next frame, by ascending id.
    fn push(&mut self, walkers: &[Walker]) {
        if self.moments == 0 {
            self.ids = walkers.iter().map(|walker| walker.id).collect();
            self.columns_m = vec![Vec::new(); walkers.len()];
        }
        self.moments += 1;
        let mut columns = std::mem::take(&mut self.columns_m).into_iter();
        self.ids.retain(|id| {
            let Some(mut column) = columns.next() else { return false };
            let Ok(at) = walkers.binary_search_by_key(id, |walker| walker.id) else { return false };
            column.push(walkers[at].position_m);
            self.columns_m.push(column);
            true
        });
    }

    fn places(&self) -> usize {
        self.ids.len() * self.moments
    }
}

/// An [`Ensemble`] as a motion.
#[derive(Clone, Debug)]
pub struct EnsembleMotion<'a> {
    ensemble: &'a Ensemble,
    next: usize,
}

impl Motion for EnsembleMotion<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        let Ensemble { fps, ids, .. } = self.ensemble;
        let (now, moments) = (self.next, self.ensemble.moments());
        if now >= moments {
            return Ok(false);
        }
        self.next += 1;
        let (before, after) = (now.saturating_sub(1), (now + 1).min(moments - 1));
        let span_s = (after - before) as f64 / fps;
        let [before, here, after] = [before, now, after].map(|moment| self.ensemble.places_at(moment));
        frame.time_s = self.ensemble.time_s(now);
        frame.walkers.clear();
        frame.walkers.extend(ids.iter().enumerate().map(|(k, &id)| Walker {
            id,
            position_m: here[k],
            velocity_m_s: if span_s > 0.0 { (after[k] - before[k]) / span_s } else { vec2(0.0, 0.0) },
            heading: None,
        }));
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        self.next as f64 / self.ensemble.moments().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Ensemble {
        let places = (0..5).flat_map(|k| [vec2(0.5 * f64::from(k), 0.0), vec2(0.0, f64::from(k))]).collect();
        Ensemble::new(2.0, 1.0, vec![3, 8], places)
    }

    #[test]
    fn an_ensemble_played_and_taken_again_is_the_same() {
        let again = Ensemble::of_motion(&mut two().motion(), 2.0, [0.0, 100.0]).unwrap();
        assert_eq!(again, two());
        let part = Ensemble::of_motion(&mut two().motion(), 2.0, [1.5, 2.5]).unwrap();
        assert_eq!((part.start_s, part.moments()), (1.5, 3));
    }

    #[test]
    fn velocities_are_differences() {
        let two = two();
        let (mut motion, mut frame) = (two.motion(), Frame::default());
        while motion.next_frame(&mut frame).unwrap() {
            assert_eq!(frame.walkers[0].velocity_m_s, vec2(1.0, 0.0));
            assert_eq!(frame.walkers[1].velocity_m_s, vec2(0.0, 2.0));
        }
        assert_eq!(frame.time_s, 3.0);
        assert_eq!(motion.share_done(), 1.0);
    }

    #[test]
    fn only_those_count_who_are_there_throughout() {
        struct Comings(u32);
        impl Motion for Comings {
            fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
                let walker = |id| Walker { id, position_m: vec2(0.0, 0.0), velocity_m_s: Vec2::ZERO, heading: None };
                frame.time_s = f64::from(self.0);
                frame.walkers = if self.0 == 3 { vec![walker(2)] } else { vec![walker(1), walker(2)] };
                self.0 += 1;
                Ok(self.0 < 8)
            }
            fn share_done(&self) -> f64 {
                0.0
            }
        }
        let ids = |from_s, to_s| Ensemble::of_motion(&mut Comings(0), 1.0, [from_s, to_s]).map(|e| e.ids);
        assert_eq!(ids(0.0, 2.0).unwrap(), [1, 2]);
        assert_eq!(ids(0.0, 5.0).unwrap(), [2]);
        let error = ids(50.0, 60.0).unwrap_err();
        assert!(matches!(error, MotionError::NobodyThroughout { .. }), "{error}");
    }
}
