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
            StampsError::TooManyTexels { .. } => {
                Some("lower the texel density, or check the plan's metres per pixel".into())
            }
            StampsError::OutOfRange { name, .. } => Some(format!("leave `{name}` out to get its default")),
        }
    }
}
