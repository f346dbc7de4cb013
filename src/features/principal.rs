use nalgebra::DMatrix;

use super::displacement::column_squares;
use super::eigen::{eigenpairs, fix_signs};
use super::error::FeaturesError;
use super::progress_range::ProgressRange;

/// Variances below this share of the largest are refined without the larger components.
const SMALL: f64 = 1e-8;
/// Variances below this share of the largest are lost in its rounding: 1e-11 of its amplitude.
const NEGLIGIBLE: f64 = 1e-22;

/// Principal components of displacements `D` (a row per frame), as columns, by descending variance.
///
/// They are the unit eigenvectors of the covariance `V = D^T D / m`. Components along which people move by no more than
/// `rounding_m` in the mean are left out, since they are rounding.
///
/// `V` has a row per coordinate. With fewer frames than coordinates, the eigenvectors of `D D^T / m` are found instead:
/// if `u` is one of them, `D^T u` is an eigenvector of `V` with the same eigenvalue.
///
/// # Errors
/// More than [`MOST_ROWS`](super::MOST_ROWS) frames and coordinates; eigenvectors that are not found;
/// [`FeaturesError::Interrupted`].
pub(super) fn components(
    displacements: &DMatrix<f64>,
    rounding_m: f64,
    progress: &ProgressRange<'_>,
) -> Result<DMatrix<f64>, FeaturesError> {
    let (moments, coordinates) = displacements.shape();
    let per_frame = 1.0 / moments as f64;
    let least_m2 = rounding_m * rounding_m * coordinates as f64;
    // The products gain more by a copied transpose than it costs.
    let transposed = displacements.transpose();
    let [found, refined] = [progress.range(0.0, 0.5), progress.range(0.5, 1.0)];
    let mut components = if coordinates <= moments {
        let covariance = &transposed * displacements * per_frame;
        refine(displacements, eigenpairs(covariance, &found)?.vectors, [per_frame, least_m2], &refined)?
    } else {
        let by_moments = displacements * &transposed * per_frame;
        let vectors = eigenpairs(by_moments, &found)?.vectors;
        // QR restores orthogonality, which rounding disturbs in the shorter ones.
        (&transposed * refine(&transposed, vectors, [per_frame, least_m2], &refined)?).qr().q()
    };
    fix_signs(&mut components);
    Ok(components)
}

/// Recomputes the small components among themselves, by descending variance.
///
/// Next to a component whose variance is 1e16 times as large they are lost in its rounding. Components whose variance,
/// `per_frame` times the sum of squares, is at most the least variance are left out.
fn refine(
    matrix: &DMatrix<f64>,
    mut components: DMatrix<f64>,
    [per_frame, least_m2]: [f64; 2],
    progress: &ProgressRange<'_>,
) -> Result<DMatrix<f64>, FeaturesError> {
    let mut first = 0;
    let mut negligible_m2 = least_m2;
    loop {
        let rest = components.columns(first, components.ncols() - first);
        let variances: Vec<f64> = column_squares(&(matrix * rest)).iter().map(|sum| sum * per_frame).collect();
        let most = variances.iter().fold(0.0, |most: f64, &variance| most.max(variance));
        let small = first + variances.iter().take_while(|&&variance| variance > SMALL * most).count();
        if first == 0 {
            negligible_m2 = negligible_m2.max(NEGLIGIBLE * most);
        }
        if most <= negligible_m2 || small == components.ncols() {
            let kept = first + variances.iter().take_while(|&&variance| variance > negligible_m2).count();
            return Ok(components.resize_horizontally(kept, 0.0));
        }
        let rest = components.columns(small, components.ncols() - small).clone_owned();
        let along = matrix * &rest;
        let turn = eigenpairs(along.transpose() * &along * per_frame, progress)?;
        components.columns_mut(small, rest.ncols()).copy_from(&(rest * turn.vectors));
        first = small;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    /// Displacements of some rank with components of very different size.
    fn displacements(moments: usize, coordinates: usize, rank: usize) -> DMatrix<f64> {
        let wave = |a: usize, b: usize| ((a * 37 + b * b * 11 + a * b) as f64).sqrt() % 1.0 - 0.5;
        let left = DMatrix::from_fn(moments, rank, |r, c| wave(r, c) * [1.0, 1e-2, 1e-4, 1e-7][c % 4]);
        left * DMatrix::from_fn(rank, coordinates, |r, c| wave(c + 3, r))
    }

    fn check(d: &DMatrix<f64>, rank: usize) {
        let components = components(d, 1e-14, &ProgressRange::whole(&Silent)).unwrap();
        let kept = components.ncols();
        assert_eq!(kept, rank.min(d.nrows()).min(d.ncols()), "{:?}", d.shape());
        let unit = components.transpose() * &components;
        assert!((unit - DMatrix::identity(kept, kept)).amax() < 1e-12, "{:?}", d.shape());
        let again = d * &components * components.transpose();
        assert!((again - d).amax() < 1e-12 * d.amax(), "{:?}", d.shape());
        let variances = super::super::displacement::column_squares(&(d * &components));
        assert!(variances.windows(2).all(|pair| pair[0] >= pair[1] * (1.0 - 1e-6)), "{variances:?}");
    }

    #[test]
    fn components_span_the_motion_by_descending_variance_whichever_matrix_is_smaller() {
        for (moments, coordinates, rank) in [(50, 12, 5), (12, 50, 5), (30, 30, 30), (7, 40, 7), (40, 8, 8), (2, 4, 1)]
        {
            check(&displacements(moments, coordinates, rank), rank);
        }
    }

    #[test]
    fn both_matrices_give_the_same_components() {
        // As many moments as coordinates and a rank below: the long way round has to come to the same.
        let d = DMatrix::from_fn(20, 20, |r, c| {
            let (r, c) = (r as f64, c as f64);
            (r * 0.3).min(3.0) * c.sqrt() + 0.3 * ((r * 1.7) % 1.0) * (c * 0.7 % 1.0)
        });
        let tall = components(&d, 1e-14, &ProgressRange::whole(&Silent)).unwrap();
        let wide = {
            let whole = ProgressRange::whole(&Silent);
            let vectors = eigenpairs(&d * d.transpose() / 20.0, &whole).unwrap().vectors;
            let mut found = (d.transpose() * refine(&d.transpose(), vectors, [0.05, 1e-26], &whole).unwrap()).qr().q();
            fix_signs(&mut found);
            found
        };
        assert_eq!((tall.ncols(), wide.ncols()), (2, 2));
        assert!((&tall - &wide).amax() < 1e-8, "{tall} {wide}");
    }
}
