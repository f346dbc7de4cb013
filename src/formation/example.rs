use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::basis::{as_columns, as_vectors, relative_to_centroid};
use super::kirchhoff::check_edits;
use super::limits::MOST_NUMBER;
use super::{Basis, Follower, FormationError, FormationOptions, Rotation, default_sigma_m};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::{Progress, Stage};

/// Largest size of a chunk of bases, bytes, and their largest number.
const CHUNK_BYTES: usize = 1 << 26;
const CHUNK_BASES: usize = 16;
/// Orthonormality of bases that others are interpolated between, and of bases used directly.
const ANCHORS_WITHIN: f64 = 1e-10;
const EACH_WITHIN: f64 = 1e-3;
/// Frames whose coefficients are computed at once.
const MOMENTS_AT_ONCE: usize = 32;
/// Sum of `2 (1 - cos)` over all turns from one basis to the next below which bases are blended.
const SMALL_TURNS: f64 = 0.5;
/// Number of frames from which the example's own sigma is computed.
const SIGMA_MOMENTS: usize = 64;

/// An example's coefficients in a basis that follows its eigenvectors (figure 4 of the paper).
#[derive(Clone, Debug, PartialEq)]
pub struct ExampleCoefficients {
    /// Number of people, which is the number of coefficients.
    pub people: usize,
    /// `c_i` and `d_i` as x and y, frame by frame, metres.
    pub coefficients_m: Vec<Vec2>,
    /// The basis in the wanted frames, by frame.
    pub bases: BTreeMap<usize, DMatrix<f64>>,
}

impl ExampleCoefficients {
    /// All coefficients in a frame, counted from the first decomposed one.
    pub fn at(&self, moment: usize) -> &[Vec2] {
        &self.coefficients_m[moment * self.people..(moment + 1) * self.people]
    }
}

/// The part of an example to decompose, with options.
pub(super) struct Excerpt<'a> {
    pub example: &'a Ensemble,
    /// First and last frame.
    pub span: [usize; 2],
    /// The vectors that the first basis is matched to.
    pub target: Option<&'a DMatrix<f64>>,
    /// Frames whose bases are kept.
    pub wanted: &'a [usize],
    pub options: &'a FormationOptions,
}

/// Decomposes an example into the coefficients of every frame in the basis of a [`Follower`].
///
/// The example is decomposed in [`FormationOptions::decompositions`] frames, always including the first, the last and those
/// of `wanted`. In between, the basis turns evenly from one to the next ([`Rotation`]). The bases of the frames in `wanted`
/// are kept; all of them would need much memory.
///
/// # Errors
/// Fewer than two people, more than [`MOST_PEOPLE`](super::MOST_PEOPLE), numbers that are not finite, options out of range;
/// interrupted.
pub fn example_coefficients(
    example: &Ensemble,
    wanted: &[usize],
    options: &FormationOptions,
    progress: &dyn Progress,
) -> Result<ExampleCoefficients, FormationError> {
    check_example(example)?;
    options.check()?;
    check_edits(&options.adjacency, example.people())?;
    let part = Excerpt { example, span: [0, example.moments() - 1], target: None, wanted, options };
    decompose(&part, &|share| progress.advance(Stage::Motion, share), progress)
}

/// Checks the number of people, the times and the positions of an example.
pub(super) fn check_example(example: &Ensemble) -> Result<(), FormationError> {
    super::error::check_people(example.people())?;
    if !(example.fps > 0.0 && example.fps.is_finite() && example.start_s.abs() <= MOST_NUMBER) || example.moments() == 0
    {
        return Err(FormationError::ExampleTime { fps: example.fps, start_s: example.start_s });
    }
    for moment in 0..example.moments() {
        for (&place, &id) in example.places_at(moment).iter().zip(&example.ids) {
            if !(place.x.abs() <= MOST_NUMBER && place.y.abs() <= MOST_NUMBER) {
                let (time_s, Vec2 { x, y }) = (example.time_s(moment), place);
                return Err(FormationError::ExampleNumber { id, time_s, x, y });
            }
        }
    }
    Ok(())
}

/// [`example_coefficients`] of a part of an example that has been checked.
pub(super) fn decompose(
    part: &Excerpt,
    done: &dyn Fn(f64),
    progress: &dyn Progress,
) -> Result<ExampleCoefficients, FormationError> {
    let &Excerpt { example, span: [first, last], options, .. } = part;
    let people = example.people();
    let sigma_m = options.sigma_m.unwrap_or_else(|| example_sigma_m(example, [first, last]));
    let moments = decomposed_moments([first, last], options.decompositions, part.wanted);
    let mut out = ExampleCoefficients {
        people,
        coefficients_m: vec![Vec2::ZERO; people * (last - first + 1)],
        bases: BTreeMap::new(),
    };
    let chunk = (CHUNK_BYTES / (8 * people * people)).clamp(2, CHUNK_BASES);
    let bases_of = |moments: &[usize]| -> Result<Vec<Basis>, FormationError> {
        let basis = |&moment: &usize| {
            progress.keep_on()?;
            Basis::of(example.places_at(moment), sigma_m, &options.adjacency)
        };
        moments.par_iter().map(basis).collect()
    };
    let mut chunks = moments.chunks(chunk);
    let mut now: &[usize] = chunks.next().unwrap_or(&[]);
    let mut bases = bases_of(now)?;
    let mut walk = BasisTracking { part, follower: None, before: first, out: &mut out };
    loop {
        let next = chunks.next().unwrap_or(&[]);
        // One thread follows while the others decompose what comes next.
        let (coming, followed) = rayon::join(|| bases_of(next), || walk.follow(now, &bases));
        followed?;
        bases = coming?;
        done((now[now.len() - 1] - first + 1) as f64 / (last - first + 1) as f64);
        if next.is_empty() {
            return Ok(out);
        }
        now = next;
    }
}

/// The moments that are decomposed: the first, the last, as many evenly between as asked for, and those that are wanted.
fn decomposed_moments([first, last]: [usize; 2], decompositions: Option<usize>, wanted: &[usize]) -> Vec<usize> {
    let count = decompositions.unwrap_or(2).min(last - first + 1);
    let mut moments: Vec<usize> = if count > last - first {
        (first..=last).collect()
    } else {
        let parts = (count - 1).max(1);
        (0..=parts).map(|k| first + (2 * k * (last - first) + parts) / (2 * parts)).collect()
    };
    moments.extend(wanted.iter().copied().filter(|moment| (first..=last).contains(moment)));
    moments.sort_unstable();
    moments.dedup();
    moments
}

/// One sigma for the whole example: the median of those of some of its moments.
pub(super) fn example_sigma_m(example: &Ensemble, [first, last]: [usize; 2]) -> f64 {
    let count = SIGMA_MOMENTS.min(last - first + 1);
    let at = |k: usize| first + k * (last - first) / (count - 1).max(1);
    let mut sigmas: Vec<f64> = (0..count).into_par_iter().map(|k| default_sigma_m(example.places_at(at(k)))).collect();
    sigmas.sort_by(f64::total_cmp);
    sigmas[sigmas.len() / 2]
}

/// The state of following an example's eigenvectors.
struct BasisTracking<'a, 'b> {
    part: &'b Excerpt<'a>,
    follower: Option<Follower>,
    /// The current frame.
    before: usize,
    out: &'b mut ExampleCoefficients,
}

/// The frames after one decomposition up to the next, with the bases of both.
struct BasisSegment {
    moments: [usize; 2],
    from: DMatrix<f64>,
    to: DMatrix<f64>,
}

impl BasisTracking<'_, '_> {
    /// Goes through the decompositions of some moments and writes the coefficients of all moments up to the last of them.
    fn follow(&mut self, moments: &[usize], bases: &[Basis]) -> Result<(), FormationError> {
        let Excerpt { example, span: [first, _], target, wanted, options } = *self.part;
        let people = example.people();
        let mut stretches: Vec<BasisSegment> = Vec::new();
        for (&moment, basis) in moments.iter().zip(bases) {
            let from = self.follower.take();
            let mut follower = match &from {
                Some(follower) => follower.clone(),
                None => Follower::start(basis, target, options.nearness, options.following_s)?,
            };
            if from.is_some() {
                let alone = moment == self.before + 1 && !wanted.contains(&moment);
                let step_s = (moment - self.before) as f64 / example.fps;
                follower.advance(basis, step_s, if alone { EACH_WITHIN } else { ANCHORS_WITHIN })?;
            }
            if wanted.contains(&moment) {
                self.out.bases.insert(moment, follower.vectors().clone());
            }
            match from {
                Some(from) if moment > self.before + 1 => {
                    let moments = [self.before, moment];
                    let (from, to) = (from.vectors().clone(), follower.vectors().clone());
                    stretches.push(BasisSegment { moments, from, to });
                }
                _ => {
                    let coefficients = follower.coefficients(example.places_at(moment));
                    let at = (moment - first) * people;
                    write(&mut self.out.coefficients_m[at..at + people], &coefficients, 0);
                }
            }
            self.before = moment;
            self.follower = Some(follower);
        }
        let written: Vec<Vec<Vec2>> =
            stretches.par_iter().map(|stretch| stretch.coefficients(example)).collect::<Result<_, _>>()?;
        for (stretch, coefficients) in stretches.iter().zip(&written) {
            let at = (stretch.moments[0] + 1 - first) * people;
            self.out.coefficients_m[at..at + coefficients.len()].copy_from_slice(coefficients);
        }
        Ok(())
    }
}

impl BasisSegment {
    /// Coefficients of all its frames but the first; blended if the bases are near each other.
    fn coefficients(&self, example: &Ensemble) -> Result<Vec<Vec2>, FormationError> {
        // The sum of 2 (1 - cos) over all turns, without finding them.
        if 2.0 * (example.people() as f64 - self.from.dot(&self.to)) < SMALL_TURNS {
            return Ok(self.blended(example));
        }
        self.turned(example)
    }

    /// Relative places of some moments after the first, two columns each.
    fn seen(&self, example: &Ensemble, moments: Range<usize>) -> DMatrix<f64> {
        let mut places = DMatrix::zeros(example.people(), 2 * moments.len());
        for (k, moment) in moments.enumerate() {
            let relative = relative_to_centroid(example.places_at(self.moments[0] + moment));
            places.columns_mut(2 * k, 2).copy_from(&as_columns(&relative));
        }
        places
    }

    /// The bases are so near to each other that what lies between is `E_s = (1 - s) E + s E'`, made orthonormal:
    /// `(E_s^T E_s)^(-1/2) E_s^T X`, with the series of `(1 - D)^(-1/2)` for what is missing.
    fn blended(&self, example: &Ensemble) -> Vec<Vec2> {
        let [before, last] = self.moments;
        let count = last - before;
        let blend = |from: DMatrix<f64>, to: DMatrix<f64>| {
            let share = |column: usize| (column / 2 + 1) as f64 / count as f64;
            DMatrix::from_fn(from.nrows(), from.ncols(), |row, column| {
                from[(row, column)] * (1.0 - share(column)) + to[(row, column)] * share(column)
            })
        };
        let (from_t, to_t) = (self.from.transpose(), self.to.transpose());
        let seen = self.seen(example, 1..count + 1);
        let mut term = blend(&from_t * &seen, &to_t * &seen);
        let mut coefficients = term.clone();
        for factor in [1.0 / 2.0, 3.0 / 4.0, 5.0 / 6.0] {
            let out = blend(&self.from * &term, &self.to * &term);
            term = (term - blend(&from_t * &out, &to_t * &out)) * factor;
            coefficients += &term;
        }
        (0..count).flat_map(|k| as_vectors(&coefficients, 2 * k).collect::<Vec<Vec2>>()).collect()
    }

    /// The basis turns evenly: `(E Q^s)^T X = Q^-s (E^T X)` with `Q = E^T E'`.
    fn turned(&self, example: &Ensemble) -> Result<Vec<Vec2>, FormationError> {
        let [before, last] = self.moments;
        let people = example.people();
        let transposed = self.from.transpose();
        let rotation = Rotation::of(&(&transposed * &self.to))?;
        let seen_along_planes = rotation.into_planes(&transposed);
        let mut coefficients = vec![Vec2::ZERO; people * (last - before)];
        coefficients.par_chunks_mut(people * MOMENTS_AT_ONCE).enumerate().for_each(|(chunk, out)| {
            let start = chunk * MOMENTS_AT_ONCE + 1;
            let mut within = &seen_along_planes * self.seen(example, start..start + out.len() / people);
            for k in 0..out.len() / people {
                rotation.turn(&mut within, 2 * k..2 * k + 2, -((start + k) as f64) / (last - before) as f64);
            }
            let coefficients = rotation.out_of_planes(&within);
            for (k, out) in out.chunks_mut(people).enumerate() {
                write(out, &coefficients, 2 * k);
            }
        });
        Ok(coefficients)
    }
}

/// The coefficients of an example whose basis turns evenly from each of some moments to the next.
pub(super) fn turn_evenly(
    example: &Ensemble,
    bases: BTreeMap<usize, DMatrix<f64>>,
    done: &dyn Fn(f64),
    progress: &dyn Progress,
) -> Result<ExampleCoefficients, FormationError> {
    let people = example.people();
    let mut coefficients_m = Vec::new();
    let mut before: Option<(usize, &DMatrix<f64>)> = None;
    for (number, (&moment, basis)) in bases.iter().enumerate() {
        progress.keep_on()?;
        match before {
            Some((start, from)) => {
                let stretch = BasisSegment { moments: [start, moment], from: from.clone(), to: basis.clone() };
                coefficients_m.extend(stretch.turned(example)?);
            }
            None => {
                let relative = as_columns(&relative_to_centroid(example.places_at(moment)));
                coefficients_m.extend(as_vectors(&basis.tr_mul(&relative), 0));
            }
        }
        before = Some((moment, basis));
        done((number + 1) as f64 / bases.len() as f64);
    }
    Ok(ExampleCoefficients { people, coefficients_m, bases })
}

/// Writes two columns as coordinates.
fn write(out: &mut [Vec2], columns: &DMatrix<f64>, first: usize) {
    for (out, value) in out.iter_mut().zip(as_vectors(columns, first)) {
        *out = value;
    }
}
