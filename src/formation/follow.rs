use nalgebra::DMatrix;

use super::basis::{as_columns, relative_to_centroid};
use super::matching::{gap, match_in_order, mirrors};
use super::polar::{Polar, nearest_orthogonal};
use super::{Basis, FormationError};
use crate::math::{Vec2, exp};

/// Steps in time, as a share of `following_s`, below which a step is too small to mirror anything.
const SMALL_STEP: f64 = 0.2;
/// The same, below which it is taken along the tangent.
const TANGENT_STEP: f64 = 0.05;
/// Accuracy above which vectors are orthonormalised after each such step.
const EXACT: f64 = 1e-4;
/// Sum of the errors of squared lengths from which vectors are orthonormalised after such steps.
const TANGENT_WITHIN: f64 = 1e-4;

/// An orthonormal basis that follows the example's eigenvectors through time without jumps.
///
/// The eigenvectors of a recording jump. Their signs are arbitrary, and those of equal eigenvalues are arbitrary up to a
/// rotation; but even with all that matched from one frame to the next, two eigenvalues that come near each
/// other do not cross: within a step or two their vectors swap roles, a quarter turn. The coefficients swap with them,
/// metres within a tenth of a second. In the example itself that changes nothing, since basis and coefficients belong together;
/// but another basis takes over the coefficients alone, and there the whole crowd would lurch, as in no moment of the
/// example. (25 people walking on a grid: 27 times the energy of their quick motion, where 1 was to be kept.)
///
/// So the basis `E` follows the eigenvectors `V` with a delay. From one decomposition to the next, `dt` later,
///
/// ```text
/// E' = V polar(W . (V^T E)),   W_ab = exp(-(dt / following) g^2 / (1 + g^2)),
/// ```
///
/// with `g` the distance of the eigenvalues a and b in units of `nearness` times their mean. `W = 1` everywhere would leave `E`
/// as it is; a small `W` turns each vector of `E` to its eigenvector. So shapes that the formation tells apart are followed within
/// about `following` seconds, and those that it hardly tells apart are left alone; a swap takes as long as people take to
/// change a formation. After a true crossing the order by eigenvalue returns in the same time.
///
/// A step far shorter than `following` needs no `polar`: with `M = V^T E` and `A` the antisymmetric part of
/// `M^T ((W - 1) . M)`, `E' = E exp(A)` is the same to first order in it, and `1 + A + A^2 / 2` will do for `exp(A)`.
///
/// With `following` 0 it is at the eigenvectors at once, `W_ab = exp(-g^2 / 2)`: those of the paper, with signs and clusters
/// matched.
#[derive(Clone, Debug)]
pub struct Follower {
    vectors: DMatrix<f64>,
    nearness: f64,
    following_s: f64,
}

impl Follower {
    /// Starts with the eigenvectors at the first moment, matched to a target where there is one.
    ///
    /// # Errors
    /// [`FormationError::NoConvergence`].
    pub fn start(
        first: &Basis,
        target: Option<&DMatrix<f64>>,
        nearness: f64,
        following_s: f64,
    ) -> Result<Follower, FormationError> {
        let vectors = match target {
            Some(target) => match_in_order(first, target, nearness)?,
            None => first.vectors.clone(),
        };
        Ok(Follower { vectors, nearness, following_s })
    }

    /// The basis vectors, one per column; the first is constant.
    pub fn vectors(&self) -> &DMatrix<f64> {
        &self.vectors
    }

    /// Follows to the eigenvectors `step_s` later. The result is orthonormal to about `within`.
    ///
    /// # Errors
    /// [`FormationError::NoConvergence`].
    pub fn advance(&mut self, basis: &Basis, step_s: f64, within: f64) -> Result<(), FormationError> {
        let n = basis.people();
        let step = if self.following_s > 0.0 { step_s / self.following_s } else { f64::INFINITY };
        if step <= TANGENT_STEP {
            return self.advance_along(basis, step, within);
        }
        let mut weakened = basis.vectors.transpose() * &self.vectors;
        for b in 1..n {
            for a in 1..b {
                let weight = freedom(gap(&basis.values, a, b, self.nearness), step);
                weakened[(a, b)] *= weight;
                weakened[(b, a)] *= weight;
            }
        }
        let mut turned = &basis.vectors * nearest_orthogonal(weakened, within)?;
        if step > SMALL_STEP && mirrors(&turned, &self.vectors) {
            // The direction that agrees least with the previous basis is mirrored.
            turned = &turned * Polar::of(turned.transpose() * &self.vectors + identity(n))?.mirror();
        }
        self.vectors = turned;
        Ok(())
    }

    /// Takes a small step along the tangent of the rotations.
    fn advance_along(&mut self, basis: &Basis, step: f64, within: f64) -> Result<(), FormationError> {
        let n = basis.people();
        let overlap = basis.vectors.transpose() * &self.vectors;
        let mut pull = overlap.clone();
        pull[(0, 0)] = 0.0;
        for b in 1..n {
            (pull[(0, b)], pull[(b, 0)], pull[(b, b)]) = (0.0, 0.0, 0.0);
            for a in 1..b {
                let weight = freedom(gap(&basis.values, a, b, self.nearness), step) - 1.0;
                pull[(a, b)] *= weight;
                pull[(b, a)] *= weight;
            }
        }
        let turn = overlap.transpose() * pull;
        let turn = (&turn - turn.transpose()) * 0.5;
        let once = &self.vectors * &turn;
        self.vectors += &once;
        self.vectors.gemm(0.5, &once, &turn, 1.0);
        // The truncated series only lengthens vectors, so the sum measures the error.
        let longer = self.vectors.norm_squared() - n as f64;
        if within < EXACT || longer.is_nan() || longer > TANGENT_WITHIN {
            let vectors = std::mem::replace(&mut self.vectors, DMatrix::zeros(0, 0));
            self.vectors = nearest_orthogonal(vectors, within)?;
        }
        Ok(())
    }

    /// Coefficients of a formation in this basis: `E^T X`, x and y as two columns.
    ///
    /// One step towards the inverse corrects the error that [`Follower::advance`] leaves.
    pub fn coefficients(&self, places_m: &[Vec2]) -> DMatrix<f64> {
        let relative = as_columns(&relative_to_centroid(places_m));
        let once = self.vectors.tr_mul(&relative);
        let again = self.vectors.tr_mul(&(&self.vectors * &once));
        once * 1.5 - again * 0.5
    }
}

/// Weight with which a pair of vectors keeps its direction if their eigenvalues are `gap` apart.
fn freedom(gap: f64, step: f64) -> f64 {
    let squared = gap * gap;
    if step.is_finite() { exp(-step * squared / (1.0 + squared)) } else { exp(-0.5 * squared) }
}

fn identity(n: usize) -> DMatrix<f64> {
    DMatrix::identity(n, n)
}
