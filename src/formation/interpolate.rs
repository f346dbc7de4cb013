use nalgebra::DMatrix;
use rayon::prelude::*;

use super::basis::{as_columns, as_vectors, relative_to_centroid};
use super::example::{ExampleCoefficients, Excerpt, check_example, decompose, turn_evenly};
use super::keys::{KeyBasis, decompose_keys, key_moments, match_keys, match_keys_to};
use super::kirchhoff::check_edits;
use super::{Carry, FormationError, FormationOptions, KeyFormation, Rotation};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::{Progress, Stage};

/// Frames that are composed at once.
const MOMENTS_AT_ONCE: usize = 32;
/// Share of the progress for decomposing the example.
const DECOMPOSING: f64 = 0.9;

/// Interpolates key formations, while people keep moving as in the example.
///
/// The result has the example's people and its frames from the first key's to the last key's. At each key people are in its
/// positions; see the [module](super) for the motion in between. Between two keys with the same positions nobody gets farther
/// than 0.25 m from them. Degenerate formations are allowed: people at one point, in a line, on a grid or ring, in groups so
/// far apart that their weights vanish.
///
/// # Errors
/// Fewer than two people or more than [`MOST_PEOPLE`](super::MOST_PEOPLE); fewer than two keys; a key whose number of
/// positions is not the number of people, that is out of order, in the same frame as another, or outside the example; numbers
/// that are not finite; options out of range; [`FormationError::Interrupted`].
///
/// # Example
/// ```
/// use trodden::formation::{FormationOptions, KeyFormation, interpolate};
/// use trodden::math::vec2;
/// use trodden::motion::Ensemble;
///
/// // Three people who stand in a row for a second turn into a column.
/// let row = [-1.0, 0.0, 1.0].map(|x| vec2(x, 0.0));
/// let column = row.map(|place| vec2(0.0, place.x));
/// let example = Ensemble::new(10.0, 0.0, vec![0, 1, 2], row.repeat(11));
/// let keys = [(0.0, row), (1.0, column)].map(|(time_s, places)| KeyFormation { time_s, places_m: places.to_vec() });
/// let crowd = interpolate(&example, &keys, &FormationOptions::default(), &trodden::Silent)?;
/// assert_eq!((crowd.people(), crowd.moments()), (3, 11));
/// # Ok::<(), trodden::Error>(())
/// ```
pub fn interpolate(
    example: &Ensemble,
    keys: &[KeyFormation],
    options: &FormationOptions,
    progress: &dyn Progress,
) -> Result<Ensemble, FormationError> {
    check_example(example)?;
    options.check()?;
    check_edits(&options.adjacency, example.people())?;
    let moments = key_moments(example, keys)?;
    let span = [moments[0], moments[moments.len() - 1]];
    let mut keys = decompose_keys(keys, &moments, options, progress)?;
    let fluctuation = match (options.carry, options.decompositions) {
        (Carry::Shapes, None) => Some(turned_with(&mut keys, example, options, progress)?),
        (Carry::Shapes, Some(_)) => {
            match_alone(&mut keys, options, progress)?;
            let part = Excerpt { example, span, target: Some(&keys[0].vectors), wanted: &moments, options };
            let done = |share| progress.advance(Stage::Motion, DECOMPOSING * share);
            let seen = decompose(&part, &done, progress)?;
            let partners: Vec<DMatrix<f64>> =
                moments.iter().filter_map(|moment| seen.bases.get(moment).cloned()).collect();
            match_keys_to(&mut keys, &partners, options.nearness, progress)?;
            Some(seen)
        }
        (Carry::People, _) => {
            match_alone(&mut keys, options, progress)?;
            None
        }
    };
    let people = example.people();
    let mut places_m = vec![Vec2::ZERO; people * (span[1] - span[0] + 1)];
    for (number, pair) in keys.windows(2).enumerate() {
        progress.keep_on()?;
        let transition = KeyTransition::between(&pair[0], &pair[1])?;
        let (from, to) = (pair[0].moment - span[0], pair[1].moment - span[0]);
        let crowd = Interpolator { example, options, first: span[0], fluctuation: fluctuation.as_ref() };
        // The key between two stretches belongs to the later one, the last key to the last.
        let end = if number + 2 == keys.len() { to + 1 } else { to };
        places_m[from * people..end * people].par_chunks_mut(MOMENTS_AT_ONCE * people).enumerate().try_for_each(
            |(chunk, places_m)| {
                progress.keep_on()?;
                crowd.fill(&transition, from + chunk * MOMENTS_AT_ONCE, places_m);
                Ok::<_, FormationError>(())
            },
        )?;
        let share = (number + 1) as f64 / (keys.len() - 1) as f64;
        progress.advance(Stage::Motion, DECOMPOSING + (1.0 - DECOMPOSING) * share);
    }
    let made = Ensemble::new(example.fps, example.time_s(span[0]), example.ids.clone(), places_m);
    Ok(made.with_statures(example.statures().clone()))
}

/// Matches keys to each other, without the example.
fn match_alone(
    keys: &mut [KeyBasis],
    options: &FormationOptions,
    progress: &dyn Progress,
) -> Result<(), FormationError> {
    let mut partners: Vec<KeyBasis> = keys.to_vec();
    match_keys(keys, &mut partners, options.nearness, progress)
}

/// Matches keys to each other and to the example at their moments, and gives its coefficients in a basis that turns evenly
/// from one to the next as the keys' does.
fn turned_with(
    keys: &mut [KeyBasis],
    example: &Ensemble,
    options: &FormationOptions,
    progress: &dyn Progress,
) -> Result<ExampleCoefficients, FormationError> {
    let moments: Vec<usize> = keys.iter().map(|key| key.moment).collect();
    let own: Vec<KeyFormation> = moments
        .iter()
        .map(|&moment| KeyFormation { time_s: 0.0, places_m: example.places_at(moment).to_vec() })
        .collect();
    let mut partners = decompose_keys(&own, &moments, options, progress)?;
    match_keys(keys, &mut partners, options.nearness, progress)?;
    let bases = partners.into_iter().map(|key| (key.moment, key.vectors)).collect();
    let done = |share| progress.advance(Stage::Motion, DECOMPOSING * share);
    turn_evenly(example, bases, &done, progress)
}

/// The transition from one key formation to the next.
struct KeyTransition<'a> {
    keys: [&'a KeyBasis; 2],
    rotation: Rotation,
    /// The first key's basis in the planes of the rotation.
    basis: DMatrix<f64>,
    /// Coefficients of both keys.
    coefficients: [DMatrix<f64>; 2],
}

impl<'a> KeyTransition<'a> {
    fn between(from: &'a KeyBasis, to: &'a KeyBasis) -> Result<KeyTransition<'a>, FormationError> {
        let rotation = Rotation::of(&(&to.vectors * from.vectors.transpose()))?;
        let basis = rotation.into_planes(&from.vectors);
        Ok(KeyTransition { keys: [from, to], rotation, basis, coefficients: [from.coefficients(), to.coefficients()] })
    }

    /// Whether everybody is at the same place at both keys.
    fn is_hold(&self) -> bool {
        let [from, to] = self.keys;
        from.centroid_m == to.centroid_m && from.relative_m == to.relative_m
    }
}

/// Farthest that people get from their places while a formation is held, metres.
const MOST_OFF_HELD_M: f64 = 0.25;

/// A place, drawn to the one that is held: small distances stay, large ones come near [`MOST_OFF_HELD_M`].
fn kept_near(held_m: Vec2, place_m: Vec2) -> Vec2 {
    let off_m = place_m - held_m;
    held_m + off_m * (MOST_OFF_HELD_M / (MOST_OFF_HELD_M * MOST_OFF_HELD_M + off_m.length_squared()).sqrt())
}

/// Composes the frames between two keys.
struct Interpolator<'a> {
    example: &'a Ensemble,
    options: &'a FormationOptions,
    /// The first frame of the result in the example.
    first: usize,
    fluctuation: Option<&'a ExampleCoefficients>,
}

impl Interpolator<'_> {
    /// Fills the positions of the frames from `start` on, counted in the result.
    fn fill(&self, transition: &KeyTransition, start: usize, places_m: &mut [Vec2]) {
        let people = self.example.people();
        let moments = places_m.len() / people;
        let mut coefficients = DMatrix::zeros(people, 2 * moments);
        for k in 0..moments {
            let share = self.share(transition, start + k);
            let mut now = &transition.coefficients[0] * (1.0 - share) + &transition.coefficients[1] * share;
            if let Some(seen) = self.fluctuation {
                now += self.deviation(transition, start + k, |moment| as_columns(seen.at(moment)));
            }
            coefficients.columns_mut(2 * k, 2).copy_from(&now);
        }
        let mut within = &transition.basis * coefficients;
        for k in 0..moments {
            let share = self.share(transition, start + k);
            transition.rotation.turn(&mut within, 2 * k..2 * k + 2, share);
        }
        let mut relative = transition.rotation.out_of_planes(&within);
        for (k, places_m) in places_m.chunks_mut(people).enumerate() {
            if self.fluctuation.is_none() {
                let own =
                    |moment: usize| as_columns(&relative_to_centroid(self.example.places_at(moment + self.first)));
                let mut columns = relative.columns_mut(2 * k, 2);
                columns += self.deviation(transition, start + k, own);
            }
            let middle = self.middle(transition, start + k);
            for (place, relative) in places_m.iter_mut().zip(as_vectors(&relative, 2 * k)) {
                *place = middle + relative;
            }
            if transition.is_hold() {
                let [held, _] = transition.keys;
                places_m.iter_mut().zip(&held.relative_m).for_each(|(place, own)| {
                    *place = kept_near(held.centroid_m + *own, *place);
                });
            }
        }
    }

    /// Share of the transition between the keys at a moment of the result.
    fn share(&self, transition: &KeyTransition, moment: usize) -> f64 {
        let [from, to] = transition.keys.map(|key| key.moment - self.first);
        let time = (moment - from) as f64 / (to - from) as f64;
        self.options.ease.share(time)
    }

    /// Deviation of the example's values from the line between those at the two keys.
    fn deviation(&self, transition: &KeyTransition, moment: usize, of: impl Fn(usize) -> DMatrix<f64>) -> DMatrix<f64> {
        let [from, to] = transition.keys.map(|key| key.moment - self.first);
        // At the pace of the formation: where that rests, at the keys, everybody has the example's own velocity.
        let share = self.share(transition, moment);
        let line = of(from) * (1.0 - share) + of(to) * share;
        (of(moment) - line) * self.options.fluctuation
    }

    /// The crowd's centroid: on the line between the keys' centroids, plus the deviation of the example's.
    fn middle(&self, transition: &KeyTransition, moment: usize) -> Vec2 {
        let [from, to] = transition.keys;
        let share = self.share(transition, moment);
        let own = |moment: usize| self.example.centroid_m(moment);
        let deviation = own(moment + self.first) - own(from.moment).lerp(own(to.moment), share);
        from.centroid_m.lerp(to.centroid_m, share) + deviation * self.options.fluctuation
    }
}
