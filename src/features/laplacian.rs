use nalgebra::DMatrix;

use super::eigen::{eigenpairs, fix_signs};
use super::neighbours::KirchhoffSums;
use super::progress_range::ProgressRange;
use crate::features::FeaturesError;

/// Eigenvalues closer together than this share of the largest are equal but for rounding.
const EQUAL: f64 = 1e-10;

/// Eigenvectors of a crowd's changing neighbourhoods.
#[derive(Clone, Debug)]
pub(super) struct Neighbourhoods {
    /// Eigenvalues of `S`, descending.
    pub(super) values: Vec<f64>,
    /// Their unit eigenvectors as columns, an entry per person.
    pub(super) vectors: DMatrix<f64>,
}

/// Eigenvectors, by descending eigenvalue, of `S = 1/m sum_j (K_j - Kbar)^T (K_j - Kbar)`, the covariance of the
/// Kirchhoff matrices: who changes neighbours most comes first.
///
/// Eigenvectors of equal eigenvalues are free to turn among themselves, and there are many: all that concerns people
/// whose neighbours never change has eigenvalue 0. Among these, those come first along which there is most motion, the
/// principal components of the displacements within their span.
///
/// # Errors
/// More than [`MOST_ROWS`](super::MOST_ROWS) people; eigenvectors that are not found; [`FeaturesError::Interrupted`].
pub(super) fn components(
    sums: &KirchhoffSums,
    displacements: &DMatrix<f64>,
    part: &ProgressRange<'_>,
) -> Result<Neighbourhoods, FeaturesError> {
    let found = eigenpairs(sums.covariance(), &part.part(0.0, 0.5))?;
    let (mut values, mut vectors) = (found.values, found.vectors);
    let largest = values.first().copied().unwrap_or(0.0).max(0.0);
    let mut first = 0;
    while first < values.len() {
        let next = |&at: &usize| values[at - 1] - values[at] > EQUAL * largest;
        let end = (first + 1..values.len()).find(next).unwrap_or(values.len());
        if end - first > 1 {
            let span = vectors.columns(first, end - first).clone_owned();
            let moved = displacements * &span;
            let turn = eigenpairs(moved.transpose() * &moved, &part.part(0.5, 1.0))?;
            vectors.columns_mut(first, end - first).copy_from(&(span * turn.vectors));
        }
        first = end;
    }
    fix_signs(&mut vectors);
    // What rounding makes of a zero.
    values.iter_mut().filter(|value| **value <= EQUAL * largest).for_each(|value| *value = 0.0);
    Ok(Neighbourhoods { values, vectors })
}
