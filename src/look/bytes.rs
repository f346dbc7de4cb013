//! Conversion of shaded texels to 8 bits, with dither against banding.

use super::noise;
use crate::math::srgb;

/// The 8-bit output for a run of texels.
pub(super) struct Bytes<'a> {
    pub base_color: &'a mut [[u8; 3]],
    pub mask: &'a mut [[u8; 4]],
    pub orm: &'a mut [[u8; 3]],
}

/// Shaded texels of a run, one plane per quantity.
pub(super) struct ShadedPlanes<'a> {
    /// Linear colour.
    pub rgb: &'a [Vec<f32>; 3],
    /// Transmittance per channel of the mask; an empty plane for a channel without dirt.
    pub through: [&'a [f32]; 4],
    pub roughness: &'a [f32],
}

/// Buffers for rounding to 8 bits.
#[derive(Default)]
pub(super) struct Rounding {
    words: [Vec<u32>; 2],
    values: Vec<f32>,
    /// Colour, mask, roughness.
    bytes: [Vec<u8>; 8],
}

impl Rounding {
    /// Rounds a run that starts at texel (i, j), dithered by a hash of the position; not occlusion.
    pub fn write(&mut self, dither: u32, i: i64, j: i64, shown: &ShadedPlanes<'_>, out: &mut Bytes<'_>) {
        let len = out.base_color.len();
        let Rounding { words: [first, second], values, bytes } = self;
        first.clear();
        second.clear();
        let row = noise::row_key(dither, j as i32);
        first.extend((0..len as i32).map(|k| noise::mix(noise::column_word((i as i32).wrapping_add(k)) ^ row)));
        second.extend(first.iter().map(|word| noise::mix(word ^ 0x9e37_79b9)));
        for (n, bytes) in bytes.iter_mut().enumerate() {
            values.clear();
            match n {
                0..3 => values.extend(shown.rgb[n].iter().map(|&light| srgb::encode_f32(light))),
                3..7 => values.extend(shown.through[n - 3].iter().map(|light| 255.0 * (1.0 - light))),
                _ => values.extend(shown.roughness.iter().map(|roughness| 255.0 * roughness)),
            }
            bytes.resize(len, 0);
            if values.is_empty() {
                bytes.fill(0);
                continue;
            }
            let words = if n < 4 { &*first } else { &*second };
            round_dithered(values, words, n as u32 % 4, bytes);
        }
        let [red, green, blue, m0, m1, m2, m3, rough] = &*bytes;
        for (((out, r), g), b) in out.base_color.iter_mut().zip(red).zip(green).zip(blue) {
            *out = [*r, *g, *b];
        }
        for ((((out, a), b), c), d) in out.mask.iter_mut().zip(m0).zip(m1).zip(m2).zip(m3) {
            *out = [*a, *b, *c, *d];
        }
        for (out, rough) in out.orm.iter_mut().zip(rough) {
            *out = [255, *rough, 0];
        }
    }
}

/// Rounds values of 0 to 255 with random dither, which preserves means over neighbours.
///
/// Byte `byte` of each word is the threshold.
fn round_dithered(values: &[f32], words: &[u32], byte: u32, out: &mut [u8]) {
    // Adding 2^23 rounds to the nearest integer and leaves it in the lowest bits; a cast would not vectorise.
    const ROUND: f32 = 8_388_608.0;
    for ((out, value), word) in out.iter_mut().zip(values).zip(words) {
        let threshold = (((word >> (8 * byte)) & 0xff) as i32 as f32 + 0.5) / 256.0 - 0.5;
        *out = ((value + threshold).clamp(0.0, 255.0) + ROUND).to_bits() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dither_keeps_the_mean_and_whole_values() {
        let words: Vec<u32> = (0..256).map(|threshold| threshold << 16).collect();
        let dithered = |value: f32| {
            let mut out = vec![0; 256];
            round_dithered(&[value; 256], &words, 2, &mut out);
            out
        };
        for value in [0.0, 17.0, 100.25, 200.9, 255.0] {
            let mean = dithered(value).into_iter().map(f32::from).sum::<f32>() / 256.0;
            assert!((mean - value).abs() < 0.004, "{value} became {mean}");
        }
        assert!(dithered(42.0).into_iter().all(|value| value == 42));
        assert!(dithered(-3.0).into_iter().all(|value| value == 0));
        assert!(dithered(300.0).into_iter().all(|value| value == 255));
    }
}
