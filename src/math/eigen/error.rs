/// An eigenvector iteration that does not converge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the eigenvectors of {size} x {size} numbers were not found in {iterations} iterations")]
pub struct NoConvergence {
    /// Rows of the matrix.
    pub size: usize,
    /// Number of iterations.
    pub iterations: usize,
}
