//! Variation of wall stains, derived from the contact's random word.

use super::StampOptions;
use super::variation::STEEPEST;
use crate::math::SplitMix64;

/// Variation of one stain. Positions are shares of length and breadth from the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactVariation {
    /// Pressure slope along the stain, shares of the mean.
    pub(super) along: f32,
    /// Pressure slope across the stain.
    pub(super) across: f32,
    /// Bend of the stain: displacement `bow (u^2 - 1/12) + wave u (4 u^2 - 1)`, shares of the length.
    pub(super) bow: f32,
    /// See `bow`.
    pub(super) wave: f32,
    /// Blur, 0..1 from the least to the largest, uniformly distributed.
    pub(super) blur: f32,
    /// Offset in the tile of blotches.
    pub(super) blotches_at: [u32; 2],
    /// Offset in the dither tile.
    pub(super) dither_at: [u32; 2],
}

/// Ratio of length to breadth above which a stain is partly a drag.
const DRAG_FROM: f32 = 1.5;

/// Ratio of length to breadth above which a stain is entirely a drag.
const DRAG_TO: f32 = 3.5;

/// Range of the share of the mean density that a drag loses from its middle to its end.
const FADE: [f32; 2] = [0.2, 0.75];

/// Standard deviation and largest value of the bow of a drag, shares of its length.
const BOW: f32 = 0.05;
const MOST_BOW: f32 = 0.1;

/// Standard deviation and largest value of the wave of a drag, shares of its length.
const WAVE: f32 = 0.015;
const MOST_WAVE: f32 = 0.03;

/// Degree to which a stain is a drag, 0..=1, from its aspect ratio.
pub(super) fn drag(length_m: f32, breadth_m: f32) -> f32 {
    ((length_m / breadth_m - DRAG_FROM) / (DRAG_TO - DRAG_FROM)).clamp(0.0, 1.0)
}

impl ContactVariation {
    /// Draws a variation. `drag`: 0 for a touch, 1 for a drag, which fades along its path and bends more.
    pub(super) fn new(word: u64, drag: f32, options: &StampOptions) -> ContactVariation {
        let rng = &mut SplitMix64::new(word);
        let pressure = options.pressure as f32;
        let tilt = rng.normal() * pressure;
        let across = (rng.normal() * pressure).clamp(-STEEPEST, STEEPEST);
        let fade = drag * rng.range(FADE[0], FADE[1]);
        let bent = |z: f32, deviation: f32, most: f32| (z * deviation).clamp(-most, most) * (0.4 + 0.6 * drag);
        let (bow, wave) = (bent(rng.normal(), BOW, MOST_BOW), bent(rng.normal(), WAVE, MOST_WAVE));
        let [blotches, dither] = [rng.next_u64(), rng.next_u64()];
        ContactVariation {
            // Keeps pressure positive at the corners of the stain.
            along: (tilt - 2.0 * fade).clamp(-1.9 + across.abs(), 1.9 - across.abs()),
            across,
            bow,
            wave,
            blur: rng.unit(),
            blotches_at: [blotches as u32, (blotches >> 32) as u32],
            dither_at: [dither as u32, (dither >> 32) as u32],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drags_fade_along_their_way_and_touches_do_not() {
        let options = StampOptions { pressure: 0.0, ..StampOptions::default() };
        assert_eq!((drag(0.1, 0.1), drag(0.7, 0.1)), (0.0, 1.0));
        for word in 0..200 {
            assert_eq!(ContactVariation::new(word, 0.0, &options).along, 0.0);
            let along = ContactVariation::new(word, 1.0, &options).along;
            assert!((-1.5..=-0.4).contains(&along), "{along}");
        }
    }

    #[test]
    fn pressure_stays_positive_on_the_stain() {
        let options = StampOptions { pressure: 0.4, ..StampOptions::default() };
        for word in 0..2000 {
            for drag in [0.0, 0.5, 1.0] {
                let v = ContactVariation::new(word, drag, &options);
                assert!(1.0 - 0.5 * (v.along.abs() + v.across.abs()) > 0.0, "{v:?}");
            }
        }
    }
}
