use nalgebra::DMatrix;

use super::basis::{as_columns, relative_to_centroid};
use super::example::{check_example, example_sigma_m};
use super::{Basis, FormationError, Rotation, match_basis};
use crate::motion::Ensemble;

/// Number of people whose eigenvectors are points on a sphere.
const ON_A_SPHERE: usize = 3;
/// Share of their mean up to which eigenvalues count as equal.
const NEARNESS: f64 = 1e-9;

/// The eigenvectors of three people over time, as points on the unit sphere (figure 3 of the paper).
///
/// They are those of a recording, and those that a rotation gives between its first and last formation.
///
/// `e_0` is constant and `e_1` and `e_2` are orthogonal to it, so that their tracks lie on the great circle around it.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereTracks {
    /// `e_1` and `e_2` of each frame, as recorded, with signs matched from frame to frame.
    pub recorded: Vec<[[f64; 3]; 2]>,
    /// `e_1` and `e_2` of each frame, turned evenly from the first to the last.
    pub turned: Vec<[[f64; 3]; 2]>,
    /// Coefficients `c_1, d_1, c_2, d_2` of each frame in the recorded basis, metres.
    pub coefficients_m: Vec<[f64; 4]>,
}

impl SphereTracks {
    /// Mean angle between recorded and turned vectors over time, radians, for `e_1` and `e_2`.
    pub fn mean_angles_rad(&self) -> [f64; 2] {
        let angle = |a: &[f64; 3], b: &[f64; 3]| {
            let half = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() / 2.0;
            2.0 * libm::asin(half.min(1.0))
        };
        let mean = |vector: usize| {
            let angles = self.recorded.iter().zip(&self.turned).map(|(a, b)| angle(&a[vector], &b[vector]));
            angles.sum::<f64>() / self.recorded.len().max(1) as f64
        };
        [mean(0), mean(1)]
    }
}

/// Follows the eigenvectors of three people over the whole of an example, and turns the first ones into the last ones.
///
/// `sigma_m` as in [`FormationOptions::sigma_m`](super::FormationOptions::sigma_m), one for the whole example.
///
/// # Errors
/// Other than three people; numbers that are not finite; [`FormationError::Option`] for a sigma that is not positive.
pub fn sphere_tracks(example: &Ensemble, sigma_m: Option<f64>) -> Result<SphereTracks, FormationError> {
    let (people, least) = (example.people(), ON_A_SPHERE);
    if people < least {
        return Err(FormationError::TooFew { people, least });
    }
    if people > least {
        return Err(FormationError::TooMany { people, most: least });
    }
    check_example(example)?;
    let sigma_m = sigma_m.unwrap_or_else(|| example_sigma_m(example, [0, example.moments() - 1]));
    if !(1e-3..=1e6).contains(&sigma_m) {
        return Err(FormationError::Option { option: "sigma", value: sigma_m, low: 1e-3, high: 1e6 });
    }
    let mut bases: Vec<DMatrix<f64>> = Vec::with_capacity(example.moments());
    let mut coefficients_m = Vec::with_capacity(example.moments());
    for moment in 0..example.moments() {
        let places_m = example.places_at(moment);
        let basis = Basis::of(places_m, sigma_m, &[])?;
        let vectors = match bases.last() {
            Some(before) => match_basis(&basis, before, NEARNESS, Some(before))?,
            None => basis.vectors,
        };
        let seen = vectors.tr_mul(&as_columns(&relative_to_centroid(places_m)));
        coefficients_m.push([seen[(1, 0)], seen[(1, 1)], seen[(2, 0)], seen[(2, 1)]]);
        bases.push(vectors);
    }
    let (first, last) = (&bases[0], &bases[bases.len() - 1]);
    let rotation = Rotation::of(&(last * first.transpose()))?;
    let parts = (bases.len() - 1).max(1) as f64;
    let points = |basis: &DMatrix<f64>| [1, 2].map(|vector| [0, 1, 2].map(|k| basis[(k, vector)]));
    let turned = (0..bases.len()).map(|moment| points(&rotation.apply(first, moment as f64 / parts))).collect();
    Ok(SphereTracks { recorded: bases.iter().map(points).collect(), turned, coefficients_m })
}
