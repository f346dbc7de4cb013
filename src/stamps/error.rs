/// Why the `stamps` stage cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StampsError {
    /// A texel density beyond its range.
    #[error("the floor's texel density is {texels_per_metre} texels/m, allowed is 1 to 1000")]
    Density {
        /// What was asked for.
        texels_per_metre: f64,
    },
    /// A floor with more texels than can be counted.
    #[error("{metres:.1} m at {texels_per_metre} texels/m are more than {most} texels", most = super::MOST_TEXELS)]
    TooManyTexels {
        /// Side of the floor, metres.
        metres: f64,
        /// What was asked for.
        texels_per_metre: f64,
    },
    /// A texel density of walls beyond its range.
    #[error("the walls' texel density is {texels_per_metre} texels/m, allowed is 1 to 1000")]
    WallDensity {
        /// What was asked for.
        texels_per_metre: f64,
    },
    /// Walls of no sensible height.
    #[error("walls are {height_m} m high, allowed is more than 0, and at most {most} m", most = super::wall_grid::HIGHEST_M)]
    WallHeight {
        /// What was asked for, metres.
        height_m: f64,
    },
    /// A wall face with more texels than can be counted.
    #[error(
        "a wall of {length_m:.1} m at {texels_per_metre} texels/m is more than {most} texels",
        most = super::wall_grid::MOST_COLUMNS
    )]
    FaceTooLong {
        /// Length of the face, metres.
        length_m: f64,
        /// What was asked for.
        texels_per_metre: f64,
    },
    /// An option beyond its range.
    #[error("stamps.{name} is {value}, allowed is {low} to {high}")]
    OutOfRange {
        /// Name of the option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
}

impl StampsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            StampsError::Density { .. } => Some("100 is one texel a centimetre".into()),
            StampsError::WallDensity { .. } => Some("200 is half a centimetre a texel".into()),
            StampsError::WallHeight { .. } => Some("rooms are 2.1 to 3.5 m high".into()),
            StampsError::TooManyTexels { .. } | StampsError::FaceTooLong { .. } => {
                Some("lower the texel density, or check the plan's metres per pixel".into())
            }
            StampsError::OutOfRange { name, .. } => Some(format!("leave `{name}` out to get its default")),
        }
    }
}
