use serde::{Deserialize, Serialize};

use super::FeaturesError;

/// Least and largest distance of neighbours, metres.
pub const NEIGHBOUR_DISTANCES_M: [f64; 2] = [0.05, 10_000.0];

/// In what basis displacements are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Principal components of everybody's coordinates.
    #[default]
    Pca,
    /// Eigenvectors of who comes near whom.
    Laplacian,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 2] = [Method::Pca, Method::Laplacian];

    /// Its name, as users write it.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Pca => "pca",
            Method::Laplacian => "laplacian",
        }
    }
}

/// How features are found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FeaturesOptions {
    /// In what basis.
    pub method: Method,
    /// For the Laplacian, people are neighbours within this distance, metres: 0.05 to 10 000.
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
