//! From linear light to the picture's bytes.

use crate::math::{SplitMix64, srgb};
use crate::show::rooms::{LinearRgb, toned};

/// Brightest light that is told apart.
pub(super) const MOST: f64 = 8.0;
/// Steps of the table.
const STEPS: usize = 16_384;
/// Relative darkening of the picture's corners.
const VIGNETTE: f32 = 0.13;

/// A table from light to sRGB, 0 to 255.
pub(super) struct Tone {
    table: Vec<f32>,
    pub exposure: f32,
}

impl Tone {
    pub fn new(exposure: f32) -> Tone {
        let byte = |k: usize| {
            // Steps are finest in the dark: the table runs over the square root.
            let root = k as f64 / (STEPS - 1) as f64;
            (srgb::encode(toned(root * root * MOST)) * 255.0) as f32
        };
        Tone { table: (0..STEPS).map(byte).collect(), exposure }
    }

    /// The bytes of a row of a picture of `width` x `height` pixels.
    pub fn row(&self, row: &[LinearRgb], y: u32, [width, height]: [u32; 2], out: &mut [u8]) {
        let reach = width as f32 * width as f32 + height as f32 * height as f32;
        let mut random = SplitMix64::new(u64::from(y).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        for (x, (colour, out)) in row.iter().zip(out.chunks_exact_mut(3)).enumerate() {
            let (dx, dy) = (2.0 * x as f32 + 1.0 - width as f32, 2.0 * y as f32 + 1.0 - height as f32);
            let away = (dx * dx + dy * dy) / reach;
            let gain = self.exposure * (1.0 - VIGNETTE * away * away);
            // Smooth walls would show steps otherwise.
            let bits = random.next_u64();
            for (c, out) in out.iter_mut().enumerate() {
                let dither = (bits >> (16 * c) & 0xffff) as f32 / 65_536.0;
                *out = (self.byte(colour[c] * gain) + dither) as u8;
            }
        }
    }

    fn byte(&self, light: f32) -> f32 {
        let at = (light.clamp(0.0, MOST as f32) / MOST as f32).sqrt() * (STEPS - 1) as f32;
        let k = (at as usize).min(STEPS - 2);
        let value = self.table[k] + (self.table[k + 1] - self.table[k]) * (at - k as f32);
        value.min(254.999)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_grey_stays_and_lamps_are_white() {
        let tone = Tone::new(1.0);
        assert!((tone.byte(0.40) - 169.5).abs() < 1.0, "{}", tone.byte(0.40));
        // Film is darker in the shade.
        assert!((105.0..122.0).contains(&tone.byte(0.2140)), "{}", tone.byte(0.2140));
        assert!(tone.byte(3.3) > 254.0 && tone.byte(0.0) == 0.0);
        assert!((0..800).all(|k| tone.byte(k as f32 / 100.0) <= tone.byte((k + 1) as f32 / 100.0)));
    }
}
