//! Sums of the neighbours' Kirchhoff matrices over time, in whole numbers: exact in any order.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::error::FeaturesError;
use super::progress_range::ProgressRange;
use crate::math::Vec2;
use crate::motion::Ensemble;

/// Number of frames in a batch.
const BATCH: usize = 64;
/// Bits per word.
const BITS: usize = u64::BITS as usize;

/// Sums of the Kirchhoff matrices `K_j = B_j - A_j` of all frames and of their squares.
///
/// `A_j` has a 1 for two people within the neighbour distance, `B_j` each person's number of neighbours on its diagonal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KirchhoffSums {
    people: usize,
    moments: usize,
    /// The sum of `K_j`, row by row.
    sum: Vec<i64>,
    /// The sum of `K_j K_j`, row by row.
    squares: Vec<i64>,
}

impl KirchhoffSums {
    /// Sums the matrices of a motion; people exactly at the distance are neighbours.
    ///
    /// # Errors
    /// [`FeaturesError::Interrupted`].
    pub(super) fn of(
        ensemble: &Ensemble,
        distance_m: f64,
        progress: &ProgressRange<'_>,
    ) -> Result<KirchhoffSums, FeaturesError> {
        let (people, moments) = (ensemble.people(), ensemble.moments());
        let mut sums =
            KirchhoffSums { people, moments, sum: vec![0; people * people], squares: vec![0; people * people] };
        for first in (0..moments).step_by(BATCH) {
            progress.keep_on()?;
            progress.advance(first as f64 / moments as f64);
            let last = (first + BATCH).min(moments);
            let batch: Vec<Adjacency> =
                (first..last).into_par_iter().map(|at| Adjacency::of(ensemble.places_at(at), distance_m)).collect();
            sums.add(&merged(batch));
        }
        progress.advance(1.0);
        Ok(sums)
    }

    fn add(&mut self, batch: &[(Adjacency, i64)]) {
        let rows = self.sum.par_chunks_mut(self.people).zip(self.squares.par_chunks_mut(self.people));
        rows.enumerate().for_each(|(person, (sum, squares))| {
            for (adjacency, times) in batch {
                adjacency.add_row(person, *times, sum, squares);
            }
        });
    }

    /// Mean number of neighbours.
    pub(super) fn mean_neighbours(&self) -> f64 {
        let trace: i64 = (0..self.people).map(|k| self.sum[k * self.people + k]).sum();
        trace as f64 / (self.people * self.moments) as f64
    }

    /// The covariance of the matrices, `S = 1/m sum_j (K_j - Kbar)^T (K_j - Kbar)` with `Kbar` their mean: computed as
    /// `(m sum K_j K_j - (sum K_j)(sum K_j)) / m^2`, which is exact as long as the whole numbers stay below 2^53.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let moments = self.moments as f64;
        let matrix =
            |sums: &[i64]| DMatrix::from_iterator(self.people, self.people, sums.iter().map(|&sum| sum as f64));
        let sum = matrix(&self.sum);
        (matrix(&self.squares) * moments - &sum * &sum) / (moments * moments)
    }
}

/// Merges runs of equal adjacency, with their lengths.
fn merged(batch: Vec<Adjacency>) -> Vec<(Adjacency, i64)> {
    let mut runs: Vec<(Adjacency, i64)> = Vec::new();
    for adjacency in batch {
        match runs.last_mut() {
            Some((last, times)) if *last == adjacency => *times += 1,
            _ => runs.push((adjacency, 1)),
        }
    }
    runs
}

/// The adjacency matrix of a frame, as bits.
#[derive(Clone, Debug, PartialEq)]
struct Adjacency {
    /// Words per row.
    words: usize,
    /// A row of bits per person, padded to whole words.
    bits: Vec<u64>,
    /// Number of neighbours of each person.
    degrees: Vec<i64>,
}

impl Adjacency {
    fn of(places_m: &[Vec2], distance_m: f64) -> Adjacency {
        let people = places_m.len();
        let words = people.div_ceil(BITS);
        let mut adjacency = Adjacency { words, bits: vec![0; people * words], degrees: vec![0; people] };
        for k in 0..people {
            for l in k + 1..people {
                if (places_m[k] - places_m[l]).length_squared() <= distance_m * distance_m {
                    adjacency.bits[k * words + l / BITS] |= 1 << (l % BITS);
                    adjacency.bits[l * words + k / BITS] |= 1 << (k % BITS);
                    adjacency.degrees[k] += 1;
                    adjacency.degrees[l] += 1;
                }
            }
        }
        adjacency
    }

    fn row(&self, person: usize) -> &[u64] {
        &self.bits[person * self.words..(person + 1) * self.words]
    }

    fn neighbours(&self, person: usize) -> impl Iterator<Item = usize> {
        self.row(person).iter().enumerate().flat_map(|(at, &word)| Ones(word).map(move |bit| at * BITS + bit))
    }

    /// Adds a person's row of `K` and of `K K`, `times` times.
    ///
    /// With `d` the numbers of neighbours: `(K K)_kl` is `d_k d_k` on the diagonal, minus `d_k + d_l` for neighbours, plus
    /// the number of neighbours that `k` and `l` have in common.
    fn add_row(&self, person: usize, times: i64, sum: &mut [i64], squares: &mut [i64]) {
        let degree = self.degrees[person];
        sum[person] += times * degree;
        squares[person] += times * degree * degree;
        let mut beyond = 0;
        for other in self.neighbours(person) {
            sum[other] -= times;
            squares[other] -= times * (degree + self.degrees[other]);
            beyond += self.degrees[other] as usize;
        }
        if beyond < squares.len() * self.words {
            for between in self.neighbours(person) {
                self.neighbours(between).for_each(|other| squares[other] += times);
            }
        } else {
            for (other, square) in squares.iter_mut().enumerate() {
                let both = self.row(person).iter().zip(self.row(other));
                *square += times * both.map(|(a, b)| i64::from((a & b).count_ones())).sum::<i64>();
            }
        }
    }
}

/// Iterator over the set bits of a word, ascending.
struct Ones(u64);

impl Iterator for Ones {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let bit = self.0.trailing_zeros() as usize;
        // Clears the lowest set bit.
        self.0 &= self.0.wrapping_sub(1);
        (bit < BITS).then_some(bit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::progress::Silent;

    /// People who wander on circles of different size and pace.
    fn crowd(people: usize, moments: usize, spread_m: f64) -> Ensemble {
        let place = |person: usize, moment: usize| {
            let (k, t) = (person as f64, moment as f64 * 0.11);
            let (sin, cos) = crate::math::sin_cos(t * (1.0 + (k * 0.37) % 1.0) + k);
            vec2((k * 0.618) % 1.0 * spread_m + cos, (k * 0.414) % 1.0 * spread_m + sin)
        };
        let places = (0..moments).flat_map(|m| (0..people).map(move |p| place(p, m))).collect();
        Ensemble::new(10.0, 0.0, (0..people as u32).collect(), places)
    }

    /// The covariance as the formula has it.
    fn reference(ensemble: &Ensemble, distance_m: f64) -> DMatrix<f64> {
        let people = ensemble.people();
        let kirchhoff: Vec<DMatrix<f64>> = (0..ensemble.moments())
            .map(|moment| {
                let places = ensemble.places_at(moment);
                let near = |k: usize, l: usize| k != l && places[k].distance(places[l]) <= distance_m;
                let mut matrix = DMatrix::from_fn(people, people, |k, l| if near(k, l) { -1.0 } else { 0.0 });
                (0..people).for_each(|k| matrix[(k, k)] = -matrix.row(k).sum());
                matrix
            })
            .collect();
        let count = kirchhoff.len() as f64;
        let mean = kirchhoff.iter().sum::<DMatrix<f64>>() / count;
        kirchhoff.iter().map(|k| (k - &mean).transpose() * (k - &mean)).sum::<DMatrix<f64>>() / count
    }

    #[test]
    fn whole_numbers_come_to_the_same_as_the_formula() {
        // Few neighbours, many, and everybody a neighbour of everybody; more than a word of people, more than a batch.
        for (people, moments, spread_m, distance_m) in
            [(5, 9, 2.0, 1.0), (70, 150, 12.0, 1.5), (70, 20, 4.0, 2.5), (66, 5, 1.0, 99.0), (9, 9, 900.0, 0.1)]
        {
            let ensemble = crowd(people, moments, spread_m);
            let sums = KirchhoffSums::of(&ensemble, distance_m, &ProgressRange::whole(&Silent)).unwrap();
            let expected = reference(&ensemble, distance_m);
            assert!((sums.covariance() - &expected).amax() < 1e-9, "{people} {moments} {spread_m} {distance_m}");
        }
    }

    #[test]
    fn neighbours_are_counted() {
        let places = [0.0, 1.0, 2.0, 9.0].map(|x| vec2(x, 0.0)).to_vec();
        let ensemble = Ensemble::new(1.0, 0.0, vec![1, 2, 3, 4], [places.clone(), places].concat());
        let sums = KirchhoffSums::of(&ensemble, 1.0, &ProgressRange::whole(&Silent)).unwrap();
        assert_eq!(sums.mean_neighbours(), 1.0);
        // Nothing changes, and that is exact.
        assert_eq!(sums.covariance(), DMatrix::zeros(4, 4));
    }

    #[test]
    fn threads_do_not_matter() {
        let ensemble = crowd(40, 100, 6.0);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| KirchhoffSums::of(&ensemble, 1.5, &ProgressRange::whole(&Silent)).unwrap())
        };
        assert_eq!(with(1), with(5));
    }
}
