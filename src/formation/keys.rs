use nalgebra::DMatrix;
use rayon::prelude::*;

use super::basis::{centroid, relative_to_centroid};
use super::limits::MOST_NUMBER;
use super::{Basis, FormationError, FormationOptions, KeyFormation, default_sigma_m, match_basis};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::Progress;

/// Number of sweeps that match all keys' bases to their neighbours', backwards and forwards in turn.
const SWEEPS: usize = 2;

/// A checked key formation with its basis.
#[derive(Clone)]
pub(super) struct KeyBasis {
    /// Its frame in the example.
    pub moment: usize,
    /// Its centroid, metres.
    pub centroid_m: Vec2,
    /// Positions relative to the centroid, metres.
    pub relative_m: Vec<Vec2>,
    /// Its eigenvectors.
    pub basis: Basis,
    /// The eigenvectors matched to those of the other keys.
    pub vectors: DMatrix<f64>,
}

impl KeyBasis {
    /// Coefficients in the matched basis.
    pub fn coefficients(&self) -> DMatrix<f64> {
        self.vectors.tr_mul(&super::basis::as_columns(&self.relative_m))
    }
}

/// The frames of key formations in an example, each nearest to its time.
///
/// # Errors
/// Fewer than two keys; keys that do not fit the example, do not follow each other, or hold numbers that are not finite.
pub(super) fn key_moments(example: &Ensemble, keys: &[KeyFormation]) -> Result<Vec<usize>, FormationError> {
    if keys.len() < 2 {
        return Err(FormationError::TooFewKeys { keys: keys.len() });
    }
    let mut moments: Vec<usize> = Vec::with_capacity(keys.len());
    let (from_s, to_s) = (example.start_s, example.time_s(example.moments() - 1));
    for (at, key) in keys.iter().enumerate() {
        let (number, time_s) = (at + 1, key.time_s);
        check_key(number, key, example.people())?;
        if at > 0 && time_s <= keys[at - 1].time_s {
            return Err(FormationError::KeyOrder { key: number, time_s, before_s: keys[at - 1].time_s });
        }
        let moment = ((time_s - example.start_s) * example.fps).round();
        if moment < 0.0 || moment >= example.moments() as f64 {
            return Err(FormationError::BeyondExample { key: number, time_s, from_s, to_s });
        }
        let moment = moment as usize;
        if moments.last() == Some(&moment) {
            let before_s = keys[at - 1].time_s;
            return Err(FormationError::SameMoment { key: number, time_s, before_s, fps: example.fps });
        }
        moments.push(moment);
    }
    Ok(moments)
}

/// Checks a key formation by itself.
fn check_key(number: usize, key: &KeyFormation, people: usize) -> Result<(), FormationError> {
    let usable = |value: f64| value.abs() <= MOST_NUMBER;
    let wrong = |what: String, value| Err(FormationError::KeyNumber { key: number, what, value });
    if !usable(key.time_s) {
        return wrong("its time".to_string(), key.time_s);
    }
    if key.places_m.len() != people {
        let (time_s, places) = (key.time_s, key.places_m.len());
        return Err(FormationError::Places { key: number, time_s, places, people });
    }
    for (k, place) in key.places_m.iter().enumerate() {
        for (axis, value) in [("x", place.x), ("y", place.y)] {
            if !usable(value) {
                return wrong(format!("{axis} of place {k}"), value);
            }
        }
    }
    Ok(())
}

/// Decomposes key formations, without matching their bases.
pub(super) fn decompose_keys(
    keys: &[KeyFormation],
    moments: &[usize],
    options: &FormationOptions,
    progress: &dyn Progress,
) -> Result<Vec<KeyBasis>, FormationError> {
    let key = |(key, &moment): (&KeyFormation, &usize)| {
        progress.keep_on()?;
        let sigma_m = options.sigma_m.unwrap_or_else(|| default_sigma_m(&key.places_m));
        let basis = Basis::of(&key.places_m, sigma_m, &options.adjacency)?;
        let vectors = basis.vectors.clone();
        let centroid_m = centroid(&key.places_m);
        Ok(KeyBasis { moment, centroid_m, relative_m: relative_to_centroid(&key.places_m), basis, vectors })
    };
    keys.par_iter().zip(moments).map(key).collect()
}

/// Matches the keys' bases to each other and to the example's at the same moments, and those to each other too where they are
/// free (`partners` as keys of their own).
///
/// Each is matched to the sum of those before and after it and of its partner: that makes the sum of the squared
/// differences least, one key at a time. It is done forwards and backwards, and at last forwards with an eye to it that the way
/// from each key to the next is a rotation. A key and its partner are matched at the same time: if they are the same
/// formation, they get the same basis.
pub(super) fn match_keys(
    keys: &mut [KeyBasis],
    partners: &mut [KeyBasis],
    nearness: f64,
    progress: &dyn Progress,
) -> Result<(), FormationError> {
    // Nothing holds the first; the others line up with it to begin with.
    partners[0].vectors = match_basis(&partners[0].basis, &keys[0].vectors, nearness, None)?;
    let line_up = |chain: &mut [KeyBasis]| {
        (1..chain.len()).try_for_each(|k| {
            progress.keep_on()?;
            let vectors = match_basis(&chain[k].basis, &chain[k - 1].vectors, nearness, None);
            chain[k].vectors = vectors?;
            Ok(())
        })
    };
    let (one, other): (Result<(), FormationError>, Result<(), FormationError>) =
        rayon::join(|| line_up(keys), || line_up(partners));
    one.and(other)?;
    for (k, last) in sweeps(keys.len()) {
        progress.keep_on()?;
        let (one, other) = rayon::join(
            || matched(keys, k, &partners[k].vectors, nearness, last),
            || matched(partners, k, &keys[k].vectors, nearness, last),
        );
        (keys[k].vectors, partners[k].vectors) = (one?, other?);
    }
    Ok(())
}

/// The same for partners whose bases are what they are.
pub(super) fn match_keys_to(
    keys: &mut [KeyBasis],
    partners: &[DMatrix<f64>],
    nearness: f64,
    progress: &dyn Progress,
) -> Result<(), FormationError> {
    for (k, last) in sweeps(keys.len()) {
        progress.keep_on()?;
        keys[k].vectors = matched(keys, k, &partners[k], nearness, last)?;
    }
    Ok(())
}

/// Keys in the order in which they are matched, and whether for the last time.
fn sweeps(keys: usize) -> impl Iterator<Item = (usize, bool)> {
    let order = move |sweep: usize| (0..keys).map(move |at| if sweep.is_multiple_of(2) { keys - 1 - at } else { at });
    (0..SWEEPS).flat_map(move |sweep| order(sweep).map(move |k| (k, sweep + 1 == SWEEPS)))
}

/// A key's basis, matched to its neighbours' and its partner's; with `oriented`, such that the one before turns to it.
fn matched(
    chain: &[KeyBasis],
    k: usize,
    partner: &DMatrix<f64>,
    nearness: f64,
    oriented: bool,
) -> Result<DMatrix<f64>, FormationError> {
    let before = k.checked_sub(1).map(|before| &chain[before].vectors);
    let mut target = partner.clone();
    for neighbour in before.into_iter().chain(chain.get(k + 1).map(|after| &after.vectors)) {
        target += neighbour;
    }
    match_basis(&chain[k].basis, &target, nearness, before.filter(|_| oriented))
}
