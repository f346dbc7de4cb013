use nalgebra::DMatrix;

use super::{FormationError, planes};
use crate::math::{atan2, sin_cos};

/// How far a matrix may be from a rotation: largest entry of `R^T R - 1`.
const ORTHOGONAL_WITHIN: f64 = 1e-6;

/// A rotation of n-dimensional space, decomposed into turns within orthogonal planes.
///
/// The decomposition gives any power `R^t` directly.
///
/// `R = U D U^T` is the real Schur form of an orthogonal matrix: the columns of the orthogonal `U` are two for each plane,
/// then those directions that stay as they are; `D` turns plane p by the angle `a_p` in `(0, pi]`. Then
/// `R^t = U D^t U^T`, where `D^t` turns by `t a_p`: equal parts of `t` are equal parts of the way, and `R^(1/2) R^(1/2) = R`,
/// as the repeated square roots of the paper have it, for any number of parts.
///
/// A turn by exactly half a circle leaves open which way round and, where there are several, which planes: a direction of
/// the same eigenvalue is paired with the next, and the way round is from the first towards the second. That is fixed by
/// the bytes of the matrix, and it is a shortest way like any other.
#[derive(Clone, Debug)]
pub struct Rotation {
    /// `U`: two columns for each plane, then the fixed directions.
    vectors: DMatrix<f64>,
    /// The turn of each plane, from its first column towards its second, radians in `(0, pi]`.
    angles_rad: Vec<f64>,
}

impl Rotation {
    /// Decomposes a rotation.
    ///
    /// The symmetric part `(R + R^T) / 2` has the cosines as eigenvalues, each twice, and always decomposes (Schur
    /// iterations do not always converge on a permutation). Within a space of near-equal cosines, the antisymmetric part
    /// `(R - R^T) / 2` takes each vector to its partner.
    ///
    /// # Errors
    /// A matrix that is not square, not orthogonal (within 1e-6) or has determinant -1.
    pub fn of(matrix: &DMatrix<f64>) -> Result<Rotation, FormationError> {
        let n = matrix.nrows();
        let wrong = |problem: String| Err(FormationError::NoRotation { problem });
        if n != matrix.ncols() {
            return wrong(format!("it has {n} rows and {} columns", matrix.ncols()));
        }
        let mut gram = matrix.transpose() * matrix;
        for k in 0..n {
            gram[(k, k)] -= 1.0;
        }
        let off = gram
            .iter()
            .fold(0.0, |most: f64, entry| if entry.is_finite() { most.max(entry.abs()) } else { f64::INFINITY });
        if off > ORTHOGONAL_WITHIN {
            return wrong(format!("its columns are off from being orthogonal and of length one by {off:.2e}"));
        }
        let (vectors, pairs) = planes::invariant_planes(matrix)?;
        if pairs.unpaired_mirrored {
            return wrong("it mirrors (its determinant is -1)".to_string());
        }
        let angles_rad = pairs.turns.iter().map(|&(cosine, sine)| atan2(sine, cosine)).collect();
        Ok(Rotation { vectors, angles_rad })
    }

    /// Dimensions of the space.
    pub fn size(&self) -> usize {
        self.vectors.nrows()
    }

    /// The turn of each plane, radians in `(0, pi]`.
    pub fn angles_rad(&self) -> &[f64] {
        &self.angles_rad
    }

    /// `U^T M`: the columns of `M` in the coordinates of the planes.
    pub fn into_planes(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        self.vectors.transpose() * matrix
    }

    /// `U M`: back from the coordinates of the planes.
    pub fn out_of_planes(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        &self.vectors * matrix
    }

    /// `D^share M` for those `columns` of `M`, which are in the coordinates of the planes: one turn per plane and column.
    pub fn turn(&self, matrix: &mut DMatrix<f64>, columns: std::ops::Range<usize>, share: f64) {
        for (plane, &angle_rad) in self.angles_rad.iter().enumerate() {
            let (sine, cosine) = sin_cos(share * angle_rad);
            for column in columns.clone() {
                let (a, b) = (matrix[(2 * plane, column)], matrix[(2 * plane + 1, column)]);
                matrix[(2 * plane, column)] = cosine * a - sine * b;
                matrix[(2 * plane + 1, column)] = sine * a + cosine * b;
            }
        }
    }

    /// `R^share M`: 0 leaves `M` as it is, 1 is the whole rotation.
    pub fn apply(&self, matrix: &DMatrix<f64>, share: f64) -> DMatrix<f64> {
        let mut within = self.into_planes(matrix);
        self.turn(&mut within, 0..matrix.ncols(), share);
        self.out_of_planes(&within)
    }

    /// `R^share` as a matrix; [`Rotation::apply`] is cheaper.
    pub fn power(&self, share: f64) -> DMatrix<f64> {
        self.apply(&DMatrix::identity(self.size(), self.size()), share)
    }
}
