use nalgebra::DMatrix;

use super::eigen::{eigenpairs, fix_signs};
use super::error::FeaturesError;
use super::neighbours::KirchhoffSums;
use super::progress_range::ProgressRange;

/// Eigenvalues closer to each other than this share of the largest are equal but for rounding.
const EQUAL: f64 = 1e-10;

/// Eigenvectors of a crowd's changing neighbourhoods.
#[derive(Clone, Debug)]
pub(super) struct Neighbourhoods {
    /// Eigenvalues of `S`, descending.
    pub(super) values: Vec<f64>,
    /// Their unit eigenvectors as columns, an entry per person.
    pub(super) vectors: DMatrix<f64>,
}

/// Eigenvectors of the covariance of the Kirchhoff matrices, by descending eigenvalue.
///
/// The covariance is `S = 1/m sum_j (K_j - Kbar)^T (K_j - Kbar)`: people who change neighbours most come first.
/// Eigenvectors of equal eigenvalues are determined up to a rotation among themselves, and there are many: people whose
/// neighbours never change have eigenvalue 0. Within such a span, the principal components of the displacements are
/// taken, by descending variance.
///
/// # Errors
/// More than [`MOST_ROWS`](super::MOST_ROWS) people; eigenvectors that are not found; [`FeaturesError::Interrupted`].
pub(super) fn components(
    sums: &KirchhoffSums,
    displacements: &DMatrix<f64>,
    progress: &ProgressRange<'_>,
) -> Result<Neighbourhoods, FeaturesError> {
    let found = eigenpairs(sums.covariance(), &progress.range(0.0, 0.5))?;
    let (mut values, mut vectors) = (found.values, found.vectors);
    let largest = values.first().copied().unwrap_or(0.0).max(0.0);
    let mut first = 0;
    while first < values.len() {
        let next = |&at: &usize| values[at - 1] - values[at] > EQUAL * largest;
        let end = (first + 1..values.len()).find(next).unwrap_or(values.len());
        if end - first > 1 {
            let span = vectors.columns(first, end - first).clone_owned();
            let moved = displacements * &span;
            let turn = eigenpairs(moved.transpose() * &moved, &progress.range(0.5, 1.0))?;
            vectors.columns_mut(first, end - first).copy_from(&(span * turn.vectors));
        }
        first = end;
    }
    fix_signs(&mut vectors);
    // Zeros but for rounding.
    values.iter_mut().filter(|value| **value <= EQUAL * largest).for_each(|value| *value = 0.0);
    Ok(Neighbourhoods { values, vectors })
}
