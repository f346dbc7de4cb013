//! Linear functions of texel coordinates.

/// A linear function of texel coordinates relative to the print's origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear {
    pub(super) at_origin: f32,
    pub(super) per_i: f32,
    pub(super) per_j: f32,
}

impl Linear {
    /// Value at column 0 of row `dj`.
    #[inline]
    pub(super) fn in_row(self, dj: i32) -> f32 {
        self.at_origin + dj as f32 * self.per_j
    }

    /// `offset + factor * self`.
    #[inline]
    pub(super) fn times(self, factor: f32, offset: f32) -> Linear {
        Linear { at_origin: self.at_origin * factor + offset, per_i: self.per_i * factor, per_j: self.per_j * factor }
    }

    /// The sum of two functions.
    #[inline]
    pub(super) fn plus(self, other: Linear) -> Linear {
        Linear {
            at_origin: self.at_origin + other.at_origin,
            per_i: self.per_i + other.per_i,
            per_j: self.per_j + other.per_j,
        }
    }
}
