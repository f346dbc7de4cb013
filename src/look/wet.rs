//! Rain outside: tracks of wet shoes from the entrances inwards, and puddles where they are many.

use super::cells::rise;
use super::lattice::TexelWindow;
use super::material::Properties;
use super::noise::{Channel, Noise, NoiseField};
use super::passes::{self, PassesField};
use super::settings::Look;
use crate::math::{exp_f32, ln_f32};
use crate::sums::{FloorSums, Quantity};
use crate::walls::Walls;

/// Factor on optical densities in coarse cells, which are coarse numbers too.
const FINER: f64 = 64.0;
/// How far the water of prints runs together, metres.
const RUNS_M: f64 = 0.3;
/// Mean optical density of wet prints that gives puddles a chance, and the level above which water stands, in e-folds.
const PUDDLE_DENSITY: f32 = 0.02;
const STANDS_FROM: f32 = 2.3;
/// Sizes of puddles and of the bays in their edges, metres, and how much these decide, in e-folds.
const PUDDLE_M: [f64; 2] = [0.55, 0.12];
const PUDDLE_SD: [f32; 2] = [0.55, 0.22];
/// Width of the line where a puddle dries, in e-folds of the level (6 mm where it falls by 5 a metre), and that fall.
const RIM: f32 = 0.03;
const FALL_PER_M: f32 = 5.0;
/// How much wider the line is inwards, as the square of a share.
const INWARDS: f32 = 0.06;
/// Optical density of the dirt that a puddle spreads, relative to its line.
const INSIDE: f32 = 0.12;
/// Shine of a print: share of water per optical density.
const WATER_PER_DENSITY: f32 = 9.0;
/// Optical density by which water darkens a floor that takes it up.
const SOAKED: f32 = 0.35;
/// Roughness of the dry floor from which it takes up water, and of one that takes up all.
const TAKES_UP: [f32; 2] = [0.4, 0.75];

/// A look's rain on a floor.
pub(super) struct WetFloor {
    tracks: f32,
    water: f32,
    puddles: f32,
    soaked: f32,
    /// Wet prints in coarse cells.
    level: FloorSums,
    noise: [Noise; 2],
}

/// Wet tracks and puddles over a window.
pub(super) struct WetWindow {
    level: PassesField,
    noise: [NoiseField; 2],
    sums: Vec<u32>,
    width: usize,
    row: usize,
    /// Half the width of a puddle's line, in e-folds, and its strength: a line narrower than a texel is fainter.
    rim: f32,
    rim_share: f32,
}

impl WetFloor {
    /// Returns nothing on a dry day.
    pub fn new(look: &Look, properties: &Properties, sums: &FloorSums) -> Option<WetFloor> {
        let wet = &look.wet;
        let is_dry = wet.tracks == 0.0 && wet.water == 0.0 && wet.puddles == 0.0;
        let noise = |channel, n: usize| Noise::new(look.seed, channel, [PUDDLE_M[n]; 2], PUDDLE_SD[n]);
        (!is_dry).then(|| WetFloor {
            tracks: wet.tracks * properties.prints,
            water: wet.water,
            puddles: wet.puddles * properties.prints,
            soaked: SOAKED * wet.water * rise(properties.roughness[0], TAKES_UP[0], TAKES_UP[1]),
            level: passes::coarse(sums, Quantity::Wet, FINER),
            noise: [noise(Channel::Puddle, 0), noise(Channel::PuddleBays, 1)],
        })
    }

    /// Lays tracks and puddles out over a window; `None` if nobody came in there.
    pub fn over(&self, window: &TexelWindow, sums: &FloorSums, walls: &Walls) -> Option<WetWindow> {
        let level = PassesField::over(window, (&self.level, passes::COARSE), walls, RUNS_M)?;
        let mut texels = Vec::new();
        passes::read(sums, Quantity::Wet, window, &mut texels);
        let rim = RIM.max(0.5 * FALL_PER_M / window.texels_per_metre as f32);
        let noise = self.noise.each_ref().map(|noise| noise.over(window));
        Some(WetWindow { level, noise, sums: texels, width: window.width, row: 0, rim, rim_share: RIM / rim })
    }

    /// Adds the dirt to `soil`, as optical density, and writes the share of water that covers each texel.
    pub fn add_to(
        &self,
        window: &WetWindow,
        start: usize,
        soil: &mut [f32],
        water: &mut [f32],
        scratch: &mut Vec<f32>,
    ) {
        let mut level = vec![0.0; soil.len()];
        window.level.values(start, &mut level, scratch);
        let from = window.row * window.width + start;
        let prints = window.sums.get(from..).unwrap_or_default();
        let mut noise = vec![0.0; soil.len()];
        window.noise.iter().for_each(|field| field.add_to(start, &mut noise));
        for (k, (soil, water)) in soil.iter_mut().zip(water).enumerate() {
            let print = prints.get(k).map_or(0.0, |&sum| sum as f32 / Quantity::Wet.one() as f32);
            let mut covered = 1.0 - exp_f32(-WATER_PER_DENSITY * print);
            *soil += self.tracks * print;
            if self.puddles > 0.0 && level[k] > 0.0 {
                let level = ln_f32(1.0 + level[k] / (FINER as f32 * PUDDLE_DENSITY)) + noise[k] - STANDS_FROM;
                // Dirt is carried to the edge: sharp outside, fading inwards.
                let off = level / window.rim;
                let line = exp_f32(-off * off * if off < 0.0 { 1.0 } else { INWARDS });
                let broken = rise(noise[k], -0.7, 0.6);
                let inside = rise(level, -0.5 * window.rim, window.rim);
                *soil += self.puddles * (window.rim_share * line * broken + INSIDE * inside);
                covered = covered.max(inside);
            }
            *water = self.water * covered;
            *soil += self.soaked * covered;
        }
    }
}

impl WetWindow {
    pub fn begin_row(&mut self, row: usize) {
        self.row = row;
        self.level.begin_row(row);
        self.noise.iter_mut().for_each(|noise| noise.begin_row(row));
    }
}
