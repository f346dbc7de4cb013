use crate::stamps::{TexelGrid, WallGrid};

/// Errors in merging sums.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SumsError {
    /// The floors differ in size or texel density.
    #[error(
        "sums of {w1} x {h1} texels at {t1} texels/m cannot be added to {w0} x {h0} texels at {t0} texels/m",
        w0 = .ours.width, h0 = .ours.height, t0 = .ours.texels_per_metre,
        w1 = .theirs.width, h1 = .theirs.height, t1 = .theirs.texels_per_metre
    )]
    GridsDiffer {
        /// Grid of the sums added to.
        ours: TexelGrid,
        /// Grid of the sums to add.
        theirs: TexelGrid,
    },
    /// The walls differ in texel density, height or number of faces.
    #[error("sums of {theirs} cannot be added to {ours}")]
    WallGridsDiffer {
        /// Walls of the sums added to.
        ours: WallsOfSums,
        /// Walls of the sums to add.
        theirs: WallsOfSums,
    },
    /// The lengths of a wall face differ.
    #[error("wall face {face} is {theirs_m} m long in the sums to add, and {ours_m} m in those that they are added to")]
    WallFacesDiffer {
        /// Index of the first face that differs.
        face: usize,
        /// Its length in the sums added to, metres.
        ours_m: f64,
        /// Its length in the sums to add, metres.
        theirs_m: f64,
    },
}

/// Summary of the walls of sums.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallsOfSums {
    /// Number of faces.
    pub faces: usize,
    /// Height, metres.
    pub height_m: f64,
    /// Texel density, texels per metre.
    pub texels_per_metre: f64,
}

impl std::fmt::Display for WallsOfSums {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} wall faces, {} m high, at {} texels/m", self.faces, self.height_m, self.texels_per_metre)
    }
}

impl SumsError {
    /// Returns the error for two wall grids that differ.
    pub(super) fn walls_differ(ours: &WallGrid, theirs: &WallGrid) -> SumsError {
        let walls = |grid: &WallGrid| WallsOfSums {
            faces: grid.faces.len(),
            height_m: grid.height_m,
            texels_per_metre: grid.texels_per_metre,
        };
        let differs = ours.faces.iter().zip(&theirs.faces).position(|(a, b)| a != b);
        match differs {
            Some(face) if walls(ours) == walls(theirs) => SumsError::WallFacesDiffer {
                face,
                ours_m: ours.faces[face].length_m,
                theirs_m: theirs.faces[face].length_m,
            },
            _ => SumsError::WallGridsDiffer { ours: walls(ours), theirs: walls(theirs) },
        }
    }

    /// Returns the remedy, for the user.
    pub fn hint(&self) -> Option<String> {
        match self {
            SumsError::GridsDiffer { .. } => Some("bake both from the same plan at the same texels per metre".into()),
            SumsError::WallGridsDiffer { .. } | SumsError::WallFacesDiffer { .. } => {
                Some("bake both from the same plan at the same wall height and texels per metre".into())
            }
        }
    }
}
