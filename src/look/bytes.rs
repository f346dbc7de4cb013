//! From what texels show to 8 bits, without bands.

use super::noise;
use super::tone;

/// Where 8-bit texels go, for one run.
pub(super) struct Bytes<'a> {
    pub base_color: &'a mut [[u8; 3]],
    pub mask: &'a mut [[u8; 4]],
    pub orm: &'a mut [[u8; 3]],
}

/// What a run of texels shows, a plane per quantity.
pub(super) struct Shown<'a> {
    /// Linear colour.
    pub rgb: &'a [Vec<f32>; 3],
    /// By channel of the mask, the light that comes through; an empty plane for a channel without any dirt.
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
    /// Rounds a run that starts at texel (i, j), dithered by a hash of each texel's place. Occlusion is left as it is.
    pub fn write(&mut self, dither: u32, i: i64, j: i64, shown: &Shown<'_>, out: &mut Bytes<'_>) {
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
                0..3 => values.extend(shown.rgb[n].iter().map(|&light| tone::srgb(light))),
                3..7 => values.extend(shown.through[n - 3].iter().map(|light| 255.0 * (1.0 - light))),
                _ => values.extend(shown.roughness.iter().map(|roughness| 255.0 * roughness)),
            }
            bytes.resize(len, 0);
            if values.is_empty() {
                bytes.fill(0);
                continue;
            }
            let words = if n < 4 { &*first } else { &*second };
            tone::dither(values, words, n as u32 % 4, bytes);
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
