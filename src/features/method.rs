use serde::{Deserialize, Serialize};

use super::error::FeaturesError;

/// Least and largest neighbour distance, metres.
pub const NEIGHBOUR_DISTANCES_M: [f64; 2] = [0.05, 10_000.0];

/// The basis in which displacements are expressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Principal components of all coordinates.
    #[default]
    Pca,
    /// Eigenvectors of the Laplacian (Kirchhoff) matrices of neighbours.
    Laplacian,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 2] = [Method::Pca, Method::Laplacian];

    /// The method's name in options and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Pca => "pca",
            Method::Laplacian => "laplacian",
        }
    }
}

/// Options of [`Features::find`](super::Features::find).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FeaturesOptions {
    /// The basis.
    pub method: Method,
    /// Distance up to which two people are neighbours, metres, 0.05 to 10 000; used by the Laplacian only.
    pub neighbour_distance_m: f64,
}

impl Default for FeaturesOptions {
    /// Principal components; neighbours within 2 m.
    fn default() -> FeaturesOptions {
        FeaturesOptions { method: Method::Pca, neighbour_distance_m: 2.0 }
    }
}

impl FeaturesOptions {
    pub(super) fn check(&self) -> Result<(), FeaturesError> {
        let (distance_m, [low, high]) = (self.neighbour_distance_m, NEIGHBOUR_DISTANCES_M);
        // Written so that NaN is out of range.
        if distance_m >= low && distance_m <= high {
            return Ok(());
        }
        Err(FeaturesError::NeighbourDistance { distance_m, low, high })
    }
}
