//! Loops over eight texels at a time, in 16-bit integers, written so that compilers vectorise them.

/// Texels that are worked on at a time.
pub(crate) const LANES: usize = 8;

/// Eight texels side by side.
pub(crate) type Lanes<T> = [T; LANES];

/// What a stamp is added to.
pub(crate) trait Cell: Copy + Default {
    /// Adds, staying at the largest value instead of going beyond it.
    fn add(&mut self, amount: u16);
}

impl Cell for u16 {
    #[inline]
    fn add(&mut self, amount: u16) {
        *self = self.saturating_add(amount);
    }
}

impl Cell for u32 {
    #[inline]
    fn add(&mut self, amount: u16) {
        *self = self.saturating_add(u32::from(amount));
    }
}

/// Adds amounts to eight cells.
#[inline]
pub(super) fn add_lanes<C: Cell>(cells: &mut Lanes<C>, amounts: &Lanes<u16>) {
    for (cell, &amount) in cells.iter_mut().zip(amounts) {
        cell.add(amount);
    }
}

/// Upper half of a product.
#[inline]
pub(super) fn upper(a: u16, b: u16) -> u16 {
    ((u32::from(a) * u32::from(b)) >> 16) as u16
}

/// A factor in 16 bits: as many bits behind the point as fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scaling {
    /// Bits behind the point.
    pub(super) shift: u32,
}

/// Factors stay below this, so that rounding never carries them over 16 bits.
const MOST_FACTOR: f32 = 60_000.0;

impl Scaling {
    /// For factors up to `most`, which is at most 60 000.
    #[inline]
    pub(super) fn for_most(most: f32) -> Scaling {
        // 2^shift <= 60 000 / most < 2^(shift + 1): the exponent of the quotient.
        let exponent = (MOST_FACTOR / most.max(1e-9)).to_bits() >> 23;
        Scaling { shift: exponent.saturating_sub(127).min(14) }
    }

    /// A factor in this scaling.
    #[inline]
    pub(super) fn factor(self) -> f32 {
        (1u32 << self.shift) as f32
    }

    /// Half the unit, for rounding to the nearest.
    #[inline]
    pub(super) fn half(self) -> u16 {
        ((1u32 << self.shift) >> 1) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_use_their_bits_and_never_overflow() {
        for most in [1e-12f32, 0.3, 1.0, 3.7, 100.0, 1000.0, 59_999.0, 60_000.0] {
            let scaling = Scaling::for_most(most);
            let largest = most * scaling.factor();
            assert!(largest <= MOST_FACTOR, "{most}: {largest}");
            assert!(largest * 2.0 > MOST_FACTOR || scaling.shift == 14, "{most}: {largest}");
        }
    }
}
