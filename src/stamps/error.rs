/// Errors in the options or grids of the stamps.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StampsError {
    /// The floor's texel density is out of range.
    #[error("the floor's texel density is {texels_per_metre} texels/m, allowed is 1 to 1000")]
    FloorTexelDensity {
        /// Texel density, texels per metre.
        texels_per_metre: f64,
    },
    /// The floor has too many texels.
    #[error("{metres:.1} m at {texels_per_metre} texels/m are more than {most} texels")]
    TooManyTexels {
        /// Side of the floor, metres.
        metres: f64,
        /// Texel density, texels per metre.
        texels_per_metre: f64,
        /// Largest number of texels per side.
        most: u32,
    },
    /// The walls' texel density is out of range.
    #[error("the walls' texel density is {texels_per_metre} texels/m, allowed is 1 to 1000")]
    WallTexelDensity {
        /// Texel density, texels per metre.
        texels_per_metre: f64,
    },
    /// The wall height is out of range.
    #[error("walls are {height_m} m high, allowed is more than 0, and at most {most} m")]
    WallHeight {
        /// Wall height, metres.
        height_m: f64,
        /// Largest allowed height, metres.
        most: f64,
    },
    /// A wall face has too many texels.
    #[error("a wall of {length_m:.1} m at {texels_per_metre} texels/m is more than {most} texels")]
    FaceTooLong {
        /// Length of the face, metres.
        length_m: f64,
        /// Texel density, texels per metre.
        texels_per_metre: f64,
        /// Largest number of texels along a face.
        most: u32,
    },
    /// An option is not allowed.
    #[error(transparent)]
    Option(#[from] crate::options::OptionError),
}

impl StampsError {
    /// Returns the remedy, for the user.
    pub fn hint(&self) -> Option<String> {
        match self {
            StampsError::FloorTexelDensity { .. } => Some("100 is one texel a centimetre".into()),
            StampsError::WallTexelDensity { .. } => Some("200 is half a centimetre a texel".into()),
            StampsError::WallHeight { .. } => Some("rooms are 2.1 to 3.5 m high".into()),
            StampsError::TooManyTexels { .. } | StampsError::FaceTooLong { .. } => {
                Some("lower the texel density, or check the plan's metres per pixel".into())
            }
            StampsError::Option(error) => error.hint(),
        }
    }
}
