use crate::stamps::TexelGrid;

/// Why sums cannot be put together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SumsError {
    /// Two bakes of different size or texel density.
    #[error(
        "sums of {w1} x {h1} texels at {t1} texels/m cannot be added to {w0} x {h0} texels at {t0} texels/m",
        w0 = .ours.width, h0 = .ours.height, t0 = .ours.texels_per_metre,
        w1 = .theirs.width, h1 = .theirs.height, t1 = .theirs.texels_per_metre
    )]
    GridsDiffer {
        /// The grid added to.
        ours: TexelGrid,
        /// The grid of what was to be added.
        theirs: TexelGrid,
    },
}

impl SumsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            SumsError::GridsDiffer { .. } => Some("bake both from the same plan at the same texels per metre".into()),
        }
    }
}
