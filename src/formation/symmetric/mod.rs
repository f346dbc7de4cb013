//! Eigenvectors of symmetric matrices as LAPACK's `dsyevd` finds them, with nearly all work in products of matrices: several
//! times as fast as nalgebra's where they are large. An example of 500 people that is decomposed at each of 1000 moments
//! takes half the time as a whole (`examples/measure_formation`: 64 s instead of 127 s of all processors).

mod divide;
mod secular;
mod tridiagonal;

use nalgebra::{DMatrix, SymmetricEigen};

use super::FormationError;
use tridiagonal::Reduced;

/// Steps in which eigenvectors of a symmetric matrix are found, per row; three do.
const STEPS_PER_ROW: usize = 100;
/// From so many rows on, taking the matrix apart by blocks is faster.
const LARGE: usize = 48;

/// Eigenvectors (columns) and eigenvalues of a symmetric matrix, ascending.
///
/// # Errors
/// [`FormationError::NoConvergence`], also for numbers that are not finite.
pub(super) fn eigenvectors(matrix: DMatrix<f64>) -> Result<(DMatrix<f64>, Vec<f64>), FormationError> {
    let n = matrix.nrows();
    if n == 0 {
        return Ok((matrix, Vec::new()));
    }
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Err(FormationError::NoConvergence { size: n, iterations: 0 });
    }
    let largest = matrix.amax();
    if n < LARGE || largest == 0.0 || !(1.0 / largest).is_finite() {
        return by_rotations(matrix);
    }
    // Numbers about 1: squares neither vanish nor overflow.
    let reduced = Reduced::of(matrix / largest);
    let (vectors, mut values) = divide::conquer(&reduced.diagonal, &reduced.beside)?;
    values.iter_mut().for_each(|value| *value *= largest);
    Ok((reduced.carry_back(vectors), values))
}

/// The same by rotations of neighbours, for small matrices.
fn by_rotations(matrix: DMatrix<f64>) -> Result<(DMatrix<f64>, Vec<f64>), FormationError> {
    let n = matrix.nrows();
    let iterations = STEPS_PER_ROW * n.max(10);
    let failed = FormationError::NoConvergence { size: n, iterations };
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, iterations).ok_or(failed)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let values = order.iter().map(|&at| eigen.eigenvalues[at]).collect();
    Ok((eigen.eigenvectors.select_columns(&order), values))
}

#[cfg(test)]
mod tests;
