//! Loops over eight texels at a time in 16-bit integers, written for vectorisation.

/// Number of texels per iteration.
pub(crate) const LANES: usize = 8;

/// Eight adjacent texels.
pub(crate) type Lanes<T> = [T; LANES];

/// Cell of a sum: 16 or 32 bits.
pub(crate) trait SumCell: Copy + Default {
    /// Adds with saturation.
    fn add(&mut self, amount: u16);
}

impl SumCell for u16 {
    #[inline]
    fn add(&mut self, amount: u16) {
        *self = self.saturating_add(amount);
    }
}

impl SumCell for u32 {
    #[inline]
    fn add(&mut self, amount: u16) {
        *self = self.saturating_add(u32::from(amount));
    }
}

/// Adds amounts to eight cells.
#[inline]
pub(super) fn add_lanes<C: SumCell>(cells: &mut Lanes<C>, amounts: &Lanes<u16>) {
    for (cell, &amount) in cells.iter_mut().zip(amounts) {
        cell.add(amount);
    }
}

/// Upper 16 bits of a product.
#[inline]
pub(super) fn upper(a: u16, b: u16) -> u16 {
    ((u32::from(a) * u32::from(b)) >> 16) as u16
}

/// Fixed-point scaling of a factor to 16 bits with the most fraction bits that fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scaling {
    /// Fraction bits.
    pub(super) shift: u32,
}

/// Limit on scaled factors: rounding must not overflow 16 bits.
const MOST_FACTOR: f32 = 60_000.0;

impl Scaling {
    /// Returns the scaling for factors up to `most`, which is at most 60 000.
    #[inline]
    pub(super) fn for_most(most: f32) -> Scaling {
        // 2^shift <= 60 000 / most < 2^(shift + 1): the exponent of the quotient.
        let exponent = (MOST_FACTOR / most.max(1e-9)).to_bits() >> 23;
        Scaling { shift: exponent.saturating_sub(127).min(14) }
    }

    /// Fixed-point value of 1.
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
