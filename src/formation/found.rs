//! Finds the key formations of a recorded motion: the few moments from which the rest follows.

use super::example::check_example;
use super::interpolate::interpolate;
use super::{Ease, FormationError, FormationOptions, KeyFormation};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::{Progress, Silent, Stage};

/// A search looks at so many moments, and so many people, at most.
const MOST_MOMENTS: usize = 400;
const MOST_SEARCHED: usize = 60;
/// A key is worth it that takes these shares off the distance that was left, and off that of two keys; so many more are
/// tried in vain.
const WORTH: [f64; 2] = [0.1, 0.02];
const MOST_IN_VAIN: usize = 1;

impl KeyFormation {
    /// Finds the key formations of a motion, with two keys, with three and so on: the last of the results is the answer.
    ///
    /// The first and the last moment are two keys. The next is the moment at which people are farthest, in the mean, from where
    /// the keys lead them: [`interpolate`] without fluctuation. Then all keys between the ends move, as long as the
    /// distance over all moments falls. It ends when no moment is farther off than `error_m`, when the next key
    /// takes off less than a tenth of the distance or less than a fiftieth of that of two keys, or with `most` keys.
    ///
    /// Of long motions 400 moments are looked at, of large crowds 60 people.
    ///
    /// # Errors
    /// Fewer than two people or two frames; numbers that are not finite; [`FormationError::Interrupted`].
    pub fn find(
        example: &Ensemble,
        ease: Ease,
        most: usize,
        error_m: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Vec<KeyFormation>>, FormationError> {
        check_example(example)?;
        if example.moments() < 2 {
            return Err(FormationError::TooFewKeys { keys: example.moments() });
        }
        let search = Search { motion: &thinned(example), ease, progress };
        let last = search.motion.moments() - 1;
        let mut keys = vec![0, last];
        let mut off = vec![search.off_m(0, last)?];
        let mut all = vec![keys.clone()];
        let (first, mut least, mut enough) = (sum(&off), sum(&off), keys.len());
        while keys.len() < most && keys.len() <= enough + MOST_IN_VAIN {
            progress.advance(Stage::Motion, keys.len() as f64 / most as f64);
            let moments = off.iter().enumerate().flat_map(|(k, off)| off.iter().map(move |&off_m| (k, off_m)));
            let (segment, worst_m) = moments.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
            if worst_m <= error_m || worst_m == 0.0 {
                break;
            }
            let within = off[segment].iter().position(|&off_m| off_m == worst_m).unwrap_or_default();
            keys.insert(segment + 1, keys[segment] + within);
            off.splice(segment..=segment, search.around(&keys, segment + 1)?);
            search.settle(&mut keys, &mut off)?;
            all.push(keys.clone());
            if least - sum(&off) > (WORTH[0] * least).max(WORTH[1] * first) {
                (least, enough) = (sum(&off), keys.len());
            }
        }
        all.truncate(enough.saturating_sub(1).max(1));
        let full = |moment: usize| {
            let moment = (moment * (example.moments() - 1) + last / 2) / last;
            KeyFormation { time_s: example.time_s(moment), places_m: example.places_at(moment).to_vec() }
        };
        Ok(all.into_iter().map(|keys| keys.into_iter().map(full).collect()).collect())
    }

    /// How far people of a motion are, in the mean, from where key formations lead them without fluctuation: metres, for each
    /// of its frames from the first key to the last.
    ///
    /// # Errors
    /// As [`interpolate`].
    pub fn distances_m(
        example: &Ensemble,
        keys: &[KeyFormation],
        ease: Ease,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, FormationError> {
        let led =
            interpolate(example, keys, &FormationOptions { fluctuation: 0.0, ease, ..Default::default() }, progress)?;
        let first = ((led.start_s - example.start_s) * example.fps).round() as usize;
        let mean = |moment: usize| {
            let pairs = led.places_at(moment).iter().zip(example.places_at(first + moment));
            pairs.map(|(a, b)| a.distance(*b)).sum::<f64>() / led.people() as f64
        };
        Ok((0..led.moments()).map(mean).collect())
    }
}

struct Search<'a> {
    motion: &'a Ensemble,
    ease: Ease,
    progress: &'a dyn Progress,
}

impl Search<'_> {
    /// How far people are from where the formations of two moments lead them, in these moments and between.
    fn off_m(&self, from: usize, to: usize) -> Result<Vec<f64>, FormationError> {
        self.progress.keep_on()?;
        let Ensemble { fps, ids, .. } = self.motion;
        let places_m = (from..=to).flat_map(|moment| self.motion.places_at(moment)).copied().collect();
        let part = Ensemble::new(*fps, 0.0, ids.clone(), places_m);
        let ends = [0, to - from]
            .map(|moment| KeyFormation { time_s: part.time_s(moment), places_m: part.places_at(moment).to_vec() });
        KeyFormation::distances_m(&part, &ends, self.ease, &Silent)
    }

    /// The same before and after one of the keys.
    fn around(&self, keys: &[usize], k: usize) -> Result<[Vec<f64>; 2], FormationError> {
        Ok([self.off_m(keys[k - 1], keys[k])?, self.off_m(keys[k], keys[k + 1])?])
    }

    /// Moves keys between the ends, by ever shorter steps, while the sum of distances falls.
    fn settle(&self, keys: &mut [usize], off: &mut [Vec<f64>]) -> Result<(), FormationError> {
        let mut step = (self.motion.moments() / (4 * keys.len())).max(1);
        loop {
            for k in 1..keys.len() - 1 {
                for to in [keys[k].saturating_sub(step), keys[k] + step] {
                    if to <= keys[k - 1] || to >= keys[k + 1] {
                        continue;
                    }
                    let before = std::mem::replace(&mut keys[k], to);
                    let moved = self.around(keys, k)?;
                    if sum(&moved) < sum(&off[k - 1..=k]) {
                        off[k - 1..=k].clone_from_slice(&moved);
                    } else {
                        keys[k] = before;
                    }
                }
            }
            if step == 1 {
                return Ok(());
            }
            step /= 2;
        }
    }
}

fn sum(off: &[Vec<f64>]) -> f64 {
    off.iter().flatten().sum()
}

/// Moments of a motion at even distances and people of it, few enough to search.
fn thinned(example: &Ensemble) -> Ensemble {
    let (all, people) = (example.moments(), example.people());
    let count = all.min(MOST_MOMENTS);
    let every = people.div_ceil(MOST_SEARCHED);
    let at = |k: usize| {
        let place = (k * (all - 1)) as f64 / (count - 1) as f64;
        let before = (place as usize).min(all - 2);
        let [a, b] = [before, before + 1].map(|moment| example.places_at(moment));
        let share = place - before as f64;
        a.iter().zip(b).step_by(every).map(|(a, b)| a.lerp(*b, share)).collect::<Vec<Vec2>>()
    };
    let fps = example.fps * (count - 1) as f64 / (all - 1) as f64;
    let ids = example.ids.iter().copied().step_by(every).collect();
    Ensemble::new(fps, example.start_s, ids, (0..count).flat_map(at).collect())
}
