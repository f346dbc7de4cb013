use nalgebra::DMatrix;

use super::error::check_people;
use super::{AdjacencyEdit, FormationError, kirchhoff};
use crate::math::eigenvectors;
use crate::math::{Vec2, vec2};

/// The eigenvectors of a formation's Kirchhoff matrix, from the crowd's coarse shape to the fine.
///
/// The first, `e_0`, is constant: every entry `1 / sqrt(n)`. Each is of length one, the first non-zero entry is positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// `e_0 ... e_(n-1)`, one per column.
    pub vectors: DMatrix<f64>,
    /// Their eigenvalues, ascending; the first is 0.
    pub values: Vec<f64>,
}

impl Basis {
    /// Decomposes a formation: eigenvectors of its `kirchhoff` matrix by ascending eigenvalue.
    ///
    /// Where people are so far apart that their weights vanish, more eigenvalues than the first are 0; the first vector is
    /// the constant one all the same. That is why not `K` is decomposed but `K + a e_0 e_0^T` with an `a` above all
    /// eigenvalues (Gershgorin's bound: twice the largest entry of the diagonal).
    ///
    /// # Errors
    /// Fewer than two people, more than [`MOST_PEOPLE`](super::MOST_PEOPLE); places or weights so large that no
    /// eigenvectors are found.
    pub fn of(places_m: &[Vec2], sigma_m: f64, edits: &[AdjacencyEdit]) -> Result<Basis, FormationError> {
        check_people(places_m.len())?;
        Basis::of_kirchhoff(kirchhoff(places_m, sigma_m, edits))
    }

    /// Decomposes a given Kirchhoff matrix.
    ///
    /// # Errors
    /// As [`Basis::of`].
    pub fn of_kirchhoff(mut matrix: DMatrix<f64>) -> Result<Basis, FormationError> {
        let n = matrix.nrows();
        check_people(n)?;
        let above = 2.0 * matrix.diagonal().amax() + 1.0;
        matrix.add_scalar_mut(above / n as f64);
        let (vectors, values) = eigenvectors(matrix)?;
        // The constant vector is the last now; it goes to the front, and is made exact.
        let mut ordered = DMatrix::from_element(n, n, 1.0 / (n as f64).sqrt());
        ordered.columns_mut(1, n - 1).copy_from(&vectors.columns(0, n - 1));
        for mut column in ordered.column_iter_mut() {
            let first = column.iter().copied().find(|entry| entry.abs() > 1e-9).unwrap_or(1.0);
            if first < 0.0 {
                column.neg_mut();
            }
        }
        let values = std::iter::once(0.0).chain(values[..n - 1].iter().map(|value| value.max(0.0))).collect();
        Ok(Basis { vectors: ordered, values })
    }

    /// How many people.
    pub fn people(&self) -> usize {
        self.values.len()
    }

    /// The coefficients of a formation relative to its centroid: `c_i = X . e_i` and `d_i = Y . e_i` as x and y.
    pub fn coefficients(&self, places_m: &[Vec2]) -> Vec<Vec2> {
        let relative = relative_to_centroid(places_m);
        let along = |i: usize| {
            self.vectors.column(i).iter().zip(&relative).fold(Vec2::ZERO, |sum, (&entry, &place)| sum + place * entry)
        };
        (0..self.people()).map(along).collect()
    }

    /// The formation, relative to its centroid, as the first `terms` vectors tell it: `X' = sum of c_i e_i`. With all of
    /// them it is the whole formation.
    pub fn rebuild(&self, coefficients: &[Vec2], terms: usize) -> Vec<Vec2> {
        let mut places = vec![Vec2::ZERO; self.people()];
        for (column, &coefficient) in self.vectors.column_iter().zip(coefficients).take(terms) {
            for (place, &entry) in places.iter_mut().zip(column.iter()) {
                *place += coefficient * entry;
            }
        }
        places
    }
}

/// Middle of a formation.
pub(super) fn centroid(places_m: &[Vec2]) -> Vec2 {
    places_m.iter().fold(Vec2::ZERO, |sum, &place| sum + place) / places_m.len().max(1) as f64
}

/// Places relative to their middle.
pub(super) fn relative_to_centroid(places_m: &[Vec2]) -> Vec<Vec2> {
    let middle = centroid(places_m);
    places_m.iter().map(|&place| place - middle).collect()
}

/// Coordinates as a matrix with a row per entry: x and y.
pub(super) fn as_columns(values: &[Vec2]) -> DMatrix<f64> {
    DMatrix::from_fn(values.len(), 2, |k, axis| if axis == 0 { values[k].x } else { values[k].y })
}

/// The rows of two columns of a matrix, from `column` on, as coordinates.
pub(super) fn as_vectors(matrix: &DMatrix<f64>, column: usize) -> impl Iterator<Item = Vec2> + '_ {
    (0..matrix.nrows()).map(move |k| vec2(matrix[(k, column)], matrix[(k, column + 1)]))
}
