use nalgebra::{DMatrix, SymmetricEigen};

use super::error::NoConvergence;

/// Most QR iterations per row of a symmetric matrix; three are usual.
const STEPS_PER_ROW: usize = 100;

/// Eigenvectors (columns) and eigenvalues of a small symmetric matrix, ascending, by nalgebra's QR iterations.
///
/// # Errors
/// [`NoConvergence`].
pub(super) fn eigenvectors_by_qr(matrix: DMatrix<f64>) -> Result<(DMatrix<f64>, Vec<f64>), NoConvergence> {
    let n = matrix.nrows();
    let iterations = STEPS_PER_ROW * n.max(10);
    let failed = NoConvergence { size: n, iterations };
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, iterations).ok_or(failed)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let values = order.iter().map(|&at| eigen.eigenvalues[at]).collect();
    Ok((eigen.eigenvectors.select_columns(&order), values))
}
