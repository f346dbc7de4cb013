//! Squares and rectangles of texels.

/// Side of a window, texels.
pub(crate) const WINDOW: usize = 128;

/// A square of texels that stamps are added to, [`WINDOW`] texels per side, rows upward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TexelWindow {
    /// First column.
    pub(crate) i0: i64,
    /// First row.
    pub(crate) j0: i64,
}

/// A half-open rectangle of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TexelBounds {
    pub(crate) i0: i64,
    pub(crate) j0: i64,
    pub(crate) i1: i64,
    pub(crate) j1: i64,
}

/// Floor of a value that fits an `i64`.
#[inline]
pub(super) fn floor(value: f64) -> i64 {
    let whole = value as i64;
    whole - i64::from(whole as f64 > value)
}
