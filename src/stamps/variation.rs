//! Variation of prints and heel marks, derived from the mark's random word.
//!
//! Sole positions are in soles: `along` from -0.5 at the heel's end to 0.5 at the toes, `across` from -0.5 to 0.5 in
//! image order, so that -0.5 is the outer edge of a left foot, which patterns show.

use super::StampOptions;
use crate::math::SplitMix64;

/// Largest pressure slope, for which pressure is positive everywhere on the sole.
pub(super) const STEEPEST: f32 = 0.6;

/// Distance from the print's centroid up to which pressure stays positive, soles.
pub(super) const FARTHEST: f32 = 0.75;

/// Largest factor of uneven pressure.
pub(super) const MOST_PRESSURE: f32 = 1.0 + 2.0 * FARTHEST * STEEPEST;

/// Additional pressure slope from heel to ball at full forefoot load.
const BALL_SLOPE: f32 = 0.5;

/// Forefoot load above which the heel hardly touches the floor.
const ON_BALL: f32 = 0.9;

/// Share of the heel's print at that load.
const HEEL_ON_BALL: f32 = 0.08;

/// Variation of one footfall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SoleVariation {
    /// Pressure slope from heel to toe, shares of the mean per sole.
    pub(super) along: f32,
    /// Pressure slope from edge to edge: the roll of the foot.
    pub(super) across: f32,
    /// Offset in the noise tile.
    pub(super) noise_at: [u32; 2],
    /// Blur, 0..1 from the least to the largest, uniformly distributed.
    pub(super) blur: f32,
    /// Contrast of coverage c: `c (1 + contrast (c - 1))`.
    pub(super) contrast: f32,
    /// The visible part of the sole.
    pub(super) fade: Fade,
}

/// Partial print: coverage falls from 1 to `floor` along a direction in a smooth step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fade {
    /// Progress of the step in the middle of the sole.
    pub(super) at_middle: f32,
    /// Slope of the progress from heel to toe.
    pub(super) along: f32,
    /// Slope of the progress from edge to edge.
    pub(super) across: f32,
    /// Remaining share of the faded part.
    pub(super) floor: f32,
}

impl Fade {
    /// The whole sole is visible.
    const NONE: Fade = Fade { at_middle: 1.0, along: 0.0, across: 0.0, floor: 1.0 };

    /// Only the ball is visible, from a position along the sole.
    fn ball(from: f32) -> Fade {
        const SOFT: f32 = 0.2;
        Fade { at_middle: 0.5 - from / SOFT, along: 1.0 / SOFT, across: 0.0, floor: HEEL_ON_BALL }
    }
}

impl SoleVariation {
    pub(super) fn new(word: u64, options: &StampOptions) -> SoleVariation {
        let rng = &mut SplitMix64::new(word);
        let slope = |z: f32| (z * options.pressure as f32).clamp(-STEEPEST, STEEPEST);
        let along = slope(rng.normal());
        let across = slope(rng.normal());
        let at = rng.next_u64();
        SoleVariation {
            along,
            across,
            noise_at: [at as u32, (at >> 32) as u32],
            blur: rng.unit(),
            contrast: rng.range(-0.3, 0.7),
            fade: fade(rng, options.partial as f32),
        }
    }

    /// Shifts a share of the heel's load, 0..=1, to the ball: in fast walking the ball presses more; a runner on the
    /// ball leaves hardly any heel print.
    pub(super) fn over_ball(self, forefoot: f32) -> SoleVariation {
        // NaN counts as 0.
        let forefoot = if forefoot > 0.0 { forefoot.min(1.0) } else { 0.0 };
        let along = (self.along + BALL_SLOPE * forefoot).clamp(-STEEPEST, STEEPEST);
        let whole = self.fade == Fade::NONE;
        let fade = if whole && forefoot > ON_BALL { Fade::ball(-0.1 + 0.15 * self.blur) } else { self.fade };
        SoleVariation { along, fade, ..self }
    }
}

/// Draws the fade of a print: with probability `partial` heel only, ball only or faded to one edge, equally likely.
fn fade(rng: &mut SplitMix64, partial: f32) -> Fade {
    let kind = rng.unit() / partial.max(1e-6) * 3.0;
    let (place, softness, floor, side) = (rng.unit(), rng.unit(), rng.unit(), rng.unit());
    let floor = 0.15 * floor * floor;
    // Progress is 0.5 at `edge`, and 0 and 1 at `soft` / 2 from it.
    let step = |direction: f32, edge: f32, soft: f32| (0.5 - direction * edge / soft, direction / soft);
    match kind as u32 {
        0 => {
            let (at_middle, along) = step(-1.0, -0.22 + 0.2 * place, 0.1 + 0.2 * softness);
            Fade { at_middle, along, across: (side - 0.5) * 2.0, floor }
        }
        1 => {
            let (at_middle, along) = step(1.0, -0.15 + 0.23 * place, 0.1 + 0.2 * softness);
            Fade { at_middle, along, across: (side - 0.5) * 2.0, floor }
        }
        2 => {
            let direction = if side < 0.5 { -1.0 } else { 1.0 };
            let (at_middle, across) = step(direction, direction * (-0.3 + 0.4 * place), 0.3 + 0.5 * softness);
            Fade { at_middle, along: (side * 2.0).fract() - 0.5, across, floor }
        }
        _ => Fade::NONE,
    }
}

/// Worn spots of a pair of shoes, which leave less soil: outer heel and below the ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct WornSpots(pub(super) [WornSpot; 2]);

/// A worn spot: the print keeps a share of `1 - depth` at its centre and all of it from its rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct WornSpot {
    pub(super) along: f32,
    pub(super) across: f32,
    /// Reciprocals of the half axes.
    pub(super) inverse_radius: [f32; 2],
    pub(super) depth: f32,
}

impl WornSpots {
    pub(super) fn new(word: u32) -> WornSpots {
        let rng = &mut SplitMix64::new(u64::from(word) ^ 0x7765_6172_0000_0000);
        let mut spot = |along: [f32; 2], across: [f32; 2], radius: [f32; 2], depth: f32| WornSpot {
            along: rng.range(along[0], along[1]),
            across: rng.range(across[0], across[1]),
            inverse_radius: [1.0 / rng.range(radius[0], radius[1]), 1.0 / rng.range(0.3, 0.6)],
            depth: depth * rng.unit(),
        };
        WornSpots([
            spot([-0.5, -0.4], [-0.45, -0.1], [0.1, 0.2], 0.9),
            spot([0.1, 0.32], [-0.25, 0.3], [0.08, 0.2], 0.7),
        ])
    }

    /// Share of the print that remains at a position on the sole.
    #[inline]
    pub(super) fn left(&self, along: f32, across: f32) -> f32 {
        let [heel, ball] = &self.0;
        heel.left(along, across) * ball.left(along, across)
    }
}

impl WornSpot {
    #[inline]
    fn left(&self, along: f32, across: f32) -> f32 {
        let u = (along - self.along) * self.inverse_radius[0];
        let v = (across - self.across) * self.inverse_radius[1];
        1.0 - self.depth * (1.0 - u * u - v * v).max(0.0)
    }
}

/// Variation of one heel mark.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeelVariation {
    /// Factor on the pattern's width.
    pub(super) width: f32,
    /// Offset of the ends from the tangent at the middle, shares of the length.
    pub(super) bend: f32,
    /// Share of the density lost from the start to the end of the drag.
    pub(super) fade: f32,
    /// Offset in the noise tile.
    pub(super) noise_at: [u32; 2],
}

/// Largest bend of a heel mark, shares of its length.
pub(super) const MOST_BEND: f32 = 0.3;

impl HeelVariation {
    pub(super) fn new(word: u64) -> HeelVariation {
        let rng = &mut SplitMix64::new(word);
        let bend = (0.1 * rng.normal()).clamp(-MOST_BEND, MOST_BEND);
        let at = rng.next_u64();
        HeelVariation {
            // Patterns are 2 to 4 mm wide; marks on real floors 2 to 8 mm.
            width: rng.range(1.2, 2.2),
            bend,
            fade: 0.5 * rng.unit(),
            noise_at: [at as u32, (at >> 32) as u32],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stated_share_of_prints_is_partial() {
        let options = StampOptions::default();
        let partial = (0..20_000).filter(|&k| SoleVariation::new(k * 7919, &options).fade != Fade::NONE).count() as f64;
        assert!((partial / 20_000.0 - options.partial).abs() < 0.01, "{partial} of 20000");
        let none = StampOptions { partial: 0.0, ..options };
        assert!((0..1000).all(|k| SoleVariation::new(k, &none).fade == Fade::NONE));
    }

    #[test]
    fn the_faster_the_more_the_ball_presses_and_runners_leave_little_of_the_heel() {
        let options = StampOptions { partial: 0.0, ..StampOptions::default() };
        for word in 0..200 {
            let flat = SoleVariation::new(word, &options);
            assert_eq!(flat.over_ball(0.0), flat);
            assert_eq!(flat.over_ball(f32::NAN), flat);
            let (fast, runs) = (flat.over_ball(0.35), flat.over_ball(1.0));
            assert!(fast.along >= flat.along && runs.along >= fast.along && runs.along <= STEEPEST);
            assert_eq!(fast.fade, Fade::NONE);
            let shown = |along: f32| (runs.fade.at_middle + along * runs.fade.along).clamp(0.0, 1.0);
            assert!(shown(-0.35) == 0.0 && shown(0.25) == 1.0 && runs.fade.floor < 0.1);
        }
    }

    #[test]
    fn pressure_stays_positive_and_is_one_in_the_mean() {
        let options = StampOptions { pressure: 0.4, ..StampOptions::default() };
        let mut mean = 0.0;
        for k in 0..5000 {
            let v = SoleVariation::new(k, &options);
            assert!(1.0 - 0.75 * (v.along.abs() + v.across.abs()) > 0.0);
            mean += (v.along + v.across) / 5000.0;
        }
        assert!(mean.abs() < 0.03, "{mean}");
    }
}
