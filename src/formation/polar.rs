//! Orthogonal polar factors: the orthogonal matrix nearest to a given one.

use nalgebra::{DMatrix, DVector, SVD};

use super::FormationError;
use crate::math::{NoConvergence, eigenvectors};

/// Share of the largest singular value below which the least one requires a singular value decomposition.
const NEARLY_SINGULAR: f64 = 1e-5;
/// Square of the orthogonality error before the last step of the iteration.
const POLAR_WITHIN: f64 = 1e-12;
/// Most steps of the iteration before eigenvectors are used, which cost as much as seven.
const POLAR_STEPS: usize = 8;

/// The orthogonal matrix nearest to another one, `U V^T` of its singular value decomposition `U S V^T`.
pub(super) struct Polar {
    orthogonal: DMatrix<f64>,
    /// The least singular value, and its column of `V`.
    least: f64,
    weakest: DVector<f64>,
}

impl Polar {
    /// `U V^T = M (M^T M)^(-1/2)` from the eigenvectors of `M^T M`, which are found several times as fast as a singular value
    /// decomposition; that is left for matrices which are nearly singular.
    ///
    /// # Errors
    /// [`FormationError::NoConvergence`].
    pub fn of(matrix: DMatrix<f64>) -> Result<Polar, FormationError> {
        let n = matrix.nrows();
        if n == 1 && matrix[(0, 0)].is_finite() {
            let value = matrix[(0, 0)];
            let orthogonal = DMatrix::from_element(1, 1, if value < 0.0 { -1.0 } else { 1.0 });
            return Ok(Polar { orthogonal, least: value.abs(), weakest: DVector::from_element(1, 1.0) });
        }
        let (vectors, squares) = eigenvectors(matrix.transpose() * &matrix)?;
        let least = squares[0].max(0.0).sqrt();
        if least <= NEARLY_SINGULAR * squares[n - 1].max(0.0).sqrt() {
            return Polar::by_svd(matrix);
        }
        let mut scaled = &matrix * &vectors;
        for (mut column, square) in scaled.column_iter_mut().zip(&squares) {
            column /= square.sqrt();
        }
        let weakest = vectors.column(0).into_owned();
        match newton_schulz(scaled * vectors.transpose(), POLAR_WITHIN) {
            Ok(orthogonal) => Ok(Polar { orthogonal, least, weakest }),
            Err(matrix) => Polar::by_svd(matrix),
        }
    }

    /// The polar factor of any matrix, by singular value decomposition.
    ///
    /// # Errors
    /// [`FormationError::NoConvergence`].
    pub fn by_svd(matrix: DMatrix<f64>) -> Result<Polar, FormationError> {
        let n = matrix.nrows();
        let iterations = 100 * n.max(10);
        let failed = || NoConvergence { size: n, iterations };
        if !matrix.iter().all(|entry| entry.is_finite()) {
            return Err(NoConvergence { size: n, iterations: 0 }.into());
        }
        let svd = SVD::try_new(matrix, true, true, f64::EPSILON, iterations).ok_or_else(failed)?;
        let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Err(failed().into()) };
        let values = svd.singular_values.iter().copied().enumerate();
        let (at, least) = values.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
        Ok(Polar { orthogonal: u * &v_t, least, weakest: v_t.row(at).transpose() })
    }

    /// The least singular value: that of the direction that fits worst.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// The orthogonal matrix.
    pub fn orthogonal(&self) -> &DMatrix<f64> {
        &self.orthogonal
    }

    /// The orthogonal matrix, owned.
    pub fn into_orthogonal(self) -> DMatrix<f64> {
        self.orthogonal
    }

    /// The nearest orthogonal matrix of the other orientation: the direction that fits worst is mirrored.
    pub fn mirrored(&self) -> DMatrix<f64> {
        let image = &self.orthogonal * &self.weakest;
        &self.orthogonal - image * self.weakest.transpose() * 2.0
    }

    /// The nearest orthogonal matrix with determinant -1.
    pub fn mirror(self) -> DMatrix<f64> {
        if self.orthogonal.determinant() < 0.0 { self.orthogonal } else { self.mirrored() }
    }
}

/// The orthogonal matrix nearest to one that is nearly orthogonal: by [`newton_schulz`], else from eigenvectors.
pub(super) fn nearest_orthogonal(matrix: DMatrix<f64>, within: f64) -> Result<DMatrix<f64>, FormationError> {
    newton_schulz(matrix, within).or_else(|matrix| Ok(Polar::of(matrix)?.into_orthogonal()))
}

/// Newton and Schulz's iteration `P <- P (3 - P^T P) / 2` (Higham 2008, Functions of Matrices, doi
/// 10.1137/1.9780898717778, section 8.3) for the nearest orthogonal matrix; the error is where it has got to.
fn newton_schulz(mut matrix: DMatrix<f64>, within: f64) -> Result<DMatrix<f64>, DMatrix<f64>> {
    let n = matrix.nrows();
    for _ in 0..POLAR_STEPS {
        let mut gram = matrix.transpose() * &matrix;
        let off = (0..n).fold(0.0, |sum: f64, k| {
            gram[(k, k)] -= 1.0;
            sum.max(gram.column(k).norm_squared())
        });
        if !off.is_finite() {
            break;
        }
        gram *= -0.5;
        for k in 0..n {
            gram[(k, k)] += 1.0;
        }
        matrix = &matrix * &gram;
        // The error of the step just made is 3/4 of the square of the one before.
        if off <= within {
            return Ok(matrix);
        }
    }
    Err(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_to_the_nearest_orthogonal_matrix_agree() {
        let mut dice = crate::math::SplitMix64::new(5);
        for n in [1, 2, 3, 8, 20] {
            let matrix = DMatrix::from_fn(n, n, |_, _| f64::from(dice.range(-1.0, 1.0)));
            let (quick, thorough) = (Polar::of(matrix.clone()).unwrap(), Polar::by_svd(matrix.clone()).unwrap());
            assert!((quick.orthogonal() - thorough.orthogonal()).amax() < 1e-9);
            assert!((quick.mirrored() - thorough.mirrored()).amax() < 1e-6);
            assert!((quick.least() - thorough.least()).abs() < 1e-9);
            let (direct, over) = (quick.orthogonal().determinant(), quick.mirrored().determinant());
            assert!((direct + over).abs() < 1e-9 && (direct.abs() - 1.0).abs() < 1e-9);
            assert!((quick.mirror().determinant() + 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_singular_matrix_has_a_nearest_orthogonal_matrix_too() {
        for n in [1, 2, 5] {
            let nearest = Polar::of(DMatrix::zeros(n, n)).unwrap();
            let gram = nearest.orthogonal().transpose() * nearest.orthogonal();
            assert!((gram - DMatrix::identity(n, n)).amax() < 1e-12);
        }
        assert!(Polar::of(DMatrix::from_element(2, 2, f64::NAN)).is_err());
        assert!(Polar::of(DMatrix::from_element(1, 1, f64::NAN)).is_err());
    }
}
