use std::sync::atomic::{AtomicU16, Ordering};

use image::RgbImage;

use super::crowd_view::OUTLINE;
use crate::math::srgb::Srgb8;
use crate::show::pictures::style::{FASTEST_M_S, PAPER, PLAIN_FLOOR, ROUTES, SOLID, STUCK, TEXT, speed_colour};

/// The colour of a pixel that stays as it was.
pub(super) const UNCHANGED: u8 = 255;

/// Steps of the scale of speeds.
const SPEEDS: usize = 14;
/// Bits of a colour's channel by which its nearest palette colour is looked up.
const BITS: u32 = 6;
/// Not looked up yet.
const UNKNOWN: u16 = u16::MAX;

/// The colours of an animation: few, and the same in all pictures, so that its file stays small.
#[derive(Debug)]
pub(super) struct Palette {
    colours: Vec<Srgb8>,
    /// Index of the nearest colour by the upper bits of red, green and blue.
    nearest: Vec<AtomicU16>,
}

impl Palette {
    /// All colours that are drawn, and mixtures of those that meet at edges.
    pub(super) fn new() -> Palette {
        let mut colours = vec![PAPER, PLAIN_FLOOR, SOLID, TEXT, OUTLINE, STUCK];
        let mut mix = |a: Srgb8, b: Srgb8, steps: usize| {
            colours.extend((1..steps).map(|k| mixed(a, b, k as f64 / steps as f64)));
        };
        mix(PLAIN_FLOOR, SOLID, 14);
        mix(PAPER, SOLID, 8);
        mix(PAPER, TEXT, 4);
        mix(PLAIN_FLOOR, OUTLINE, 8);
        mix(PLAIN_FLOOR, STUCK, 4);
        mix(PLAIN_FLOOR, PAPER, 2);
        let speeds = (0..SPEEDS).map(|k| speed_colour(FASTEST_M_S * k as f64 / (SPEEDS - 1) as f64));
        let people: Vec<Srgb8> = speeds.chain(ROUTES).collect();
        for &colour in &people {
            mix(colour, OUTLINE, 4);
            mix(PLAIN_FLOOR, colour, 4);
        }
        colours.extend(people);
        let mut seen = std::collections::HashSet::new();
        colours.retain(|colour| seen.insert(*colour));
        debug_assert!(colours.len() <= usize::from(UNCHANGED), "{} colours", colours.len());
        let nearest = (0..1usize << (3 * BITS)).map(|_| AtomicU16::new(UNKNOWN)).collect();
        Palette { colours, nearest }
    }

    /// The colours, at most 255.
    pub(super) fn colours(&self) -> &[Srgb8] {
        &self.colours
    }

    /// The nearest colour of each pixel.
    pub(super) fn indices(&self, picture: &RgbImage) -> Vec<u8> {
        picture.pixels().map(|pixel| self.index(pixel.0)).collect()
    }

    fn index(&self, colour: Srgb8) -> u8 {
        let key = colour.iter().fold(0usize, |key, &value| key << BITS | usize::from(value >> (8 - BITS)));
        let known = self.nearest[key].load(Ordering::Relaxed);
        if known != UNKNOWN {
            return known as u8;
        }
        // The same for all colours of this key, whichever comes first.
        let middle = colour.map(|value| value >> (8 - BITS) << (8 - BITS) | 1 << (7 - BITS));
        let distance = |other: &Srgb8| -> u32 {
            other.iter().zip(middle).map(|(&a, b)| u32::from(a.abs_diff(b)) * u32::from(a.abs_diff(b))).sum()
        };
        let nearest =
            (0u16..).zip(&self.colours).min_by_key(|(_, other)| distance(other)).map_or(0, |(index, _)| index);
        self.nearest[key].store(nearest, Ordering::Relaxed);
        nearest as u8
    }
}

fn mixed(a: Srgb8, b: Srgb8, share: f64) -> Srgb8 {
    std::array::from_fn(|k| (f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * share).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_most_keeps_its_colour() {
        let palette = Palette::new();
        assert!(palette.colours().len() <= 255, "{}", palette.colours().len());
        for colour in [PAPER, PLAIN_FLOOR, SOLID, TEXT, OUTLINE, STUCK, speed_colour(0.0), speed_colour(2.0), ROUTES[3]]
        {
            let found = palette.colours()[usize::from(palette.index(colour))];
            let off = found.iter().zip(colour).map(|(&a, b)| a.abs_diff(b)).max().unwrap();
            assert!(off <= 3, "{colour:?} becomes {found:?}");
        }
    }

    #[test]
    fn no_colour_is_far_from_the_palette() {
        let palette = Palette::new();
        for share in [0.1, 0.35, 0.6, 0.85] {
            for (a, b) in [(PLAIN_FLOOR, SOLID), (PLAIN_FLOOR, speed_colour(1.3)), (PAPER, TEXT)] {
                let colour = mixed(a, b, share);
                let found = palette.colours()[usize::from(palette.index(colour))];
                let off = found.iter().zip(colour).map(|(&a, b)| a.abs_diff(b)).max().unwrap();
                assert!(off <= 30, "{colour:?} becomes {found:?}");
            }
        }
    }
}
