//! Paint that bags and trolleys have knocked off outer corners and jambs.

use std::f32::consts::TAU;

use super::dots::poisson;
use super::strip::FaceStrip;
use crate::look::lattice::TexelWindow;
use crate::look::noise::{self, Channel};
use crate::math::{SplitMix64, exp_f32, sin_cos};
use crate::patterns::Cause;
use crate::stamps::DENSITY_ONE;
use crate::sums::WallSums;
use crate::walls::Walls;

/// Least turn of a corner that is knocked, radians.
const LEAST_OUTER_RAD: f64 = 0.6;
/// Reach of a corner along the wall in which touches are counted, and the height up to which, metres.
const BESIDE_M: f64 = 0.12;
const COUNTED_TO_M: f64 = 1.2;
/// Where chips sit: most at the height of trolleys and cases, metres.
const HEIGHTS_M: [f32; 2] = [0.09, 1.25];
/// Chips for a corner per square metre of optical density that bags and shoes have left, and most of them.
const PER_DIRT: f32 = 700.0;
const MOST: f32 = 42.0;
/// Radius of chips, metres: small ones are more frequent.
const RADIUS_M: [f32; 2] = [0.0016, 0.013];
/// Optical density of what shows: chips are opaque.
const DEPTH: f32 = 2.5;

/// A corner of a face and the number of its chips.
#[derive(Clone, Copy, Debug)]
struct Knocked {
    along_m: f64,
    chips: f32,
}

/// The chips of all faces.
pub(super) struct Chips {
    key: u32,
    faces: Vec<Vec<Knocked>>,
}

impl Chips {
    /// Counts what bags and shoes have left at outer corners; `factor` includes the history.
    pub fn new(walls: &Walls, sums: &WallSums, seed: u64, factor: f32) -> Chips {
        let mut faces = vec![Vec::new(); walls.faces.len()];
        let corners = walls.corners().into_iter().filter(|corner| corner.turn_rad < -LEAST_OUTER_RAD);
        for corner in corners.filter(|_| factor > 0.0) {
            let Some(strip) = FaceStrip::of(sums.grid(), corner.face) else { continue };
            let chips = (PER_DIRT * factor * dirt_m2(sums, &strip, corner.along_m)).min(MOST);
            if let Some(knocked) = faces.get_mut(corner.face).filter(|_| chips > 0.05) {
                knocked.push(Knocked { along_m: corner.along_m, chips });
            }
        }
        Chips { key: noise::key(seed, Channel::WallChip), faces }
    }

    /// Optical density of the chips over a window; empty without any.
    pub fn over(&self, window: &TexelWindow, strip: &FaceStrip) -> Vec<f32> {
        let t = window.texels_per_metre;
        let reach = f64::from(3.0 * RADIUS_M[1]) * t + 2.0;
        let low = window.j0 as f64 / t;
        let Some(knocked) = self.faces.get(strip.face).filter(|_| low < f64::from(HEIGHTS_M[1] + 0.1)) else {
            return Vec::new();
        };
        let mut out = Vec::new();
        let turn = if strip.closed { f64::from(strip.width) } else { f64::INFINITY };
        for (number, corner) in knocked.iter().enumerate() {
            let at = corner.along_m * t;
            // A corner near the seam of a closed face is seen on both of its sides.
            let places = [at, at - turn, at + turn];
            let seen = |place: &f64| {
                *place > window.i0 as f64 - reach && *place < (window.i0 + window.width as i64) as f64 + reach
            };
            for place in places.into_iter().filter(seen) {
                if out.is_empty() {
                    out.resize(window.texels(), 0.0);
                }
                let word = u64::from(noise::hash(self.key ^ strip.salt, number as i32, 0));
                let mut rng = SplitMix64::new(word);
                for _ in 0..poisson(f64::from(corner.chips), &mut rng) {
                    Chip::draw(place, t, &mut rng).paint(window, &mut out);
                }
            }
        }
        out
    }
}

/// Optical density times area that bags and shoes have left around a corner, square metres.
fn dirt_m2(sums: &WallSums, strip: &FaceStrip, along_m: f64) -> f32 {
    let t = strip.texels_per_metre;
    let from = (((along_m - BESIDE_M) * t).max(0.0) as u32).min(strip.width - 1);
    let to = (((along_m + BESIDE_M) * t).max(0.0) as u32).clamp(from + 1, strip.width.max(from + 1));
    let height = ((COUNTED_TO_M * t) as u32).clamp(1, strip.height);
    let [width, height] = [(to - from) as usize, height as usize];
    let mut values = vec![0; width * height];
    let mut sum = 0.0;
    for (cause, weight) in [(Cause::Bag, 1.0), (Cause::Shoe, 0.7)] {
        if sums.touched(cause, strip.face, from, 0, width, height) {
            values.fill(0);
            sums.read(cause, strip.face, from, 0, width, height, &mut values);
            sum += weight * values.iter().map(|&value| f64::from(value)).sum::<f64>();
        }
    }
    (sum / f64::from(DENSITY_ONE) / (t * t)) as f32
}

/// A chip: an irregular outline around a place.
struct Chip {
    place: [f64; 2],
    /// Half its width and height, texels.
    half: [f32; 2],
    /// Amplitudes and phases of its outline's waves.
    waves: [[f32; 2]; 3],
}

impl Chip {
    fn draw(corner: f64, t: f64, rng: &mut SplitMix64) -> Chip {
        let [low, high] = HEIGHTS_M;
        // The mean of two draws, low ones more often.
        let height_m = low + (high - low) * (rng.unit() * rng.unit()).sqrt() * (0.35 + 0.65 * rng.unit());
        let size = rng.unit();
        let radius = RADIUS_M[0] + (RADIUS_M[1] - RADIUS_M[0]) * size * size * size;
        // Edges break first: the middle lies close to the corner's line.
        let aside = 0.45 * radius * rng.normal();
        let long = rng.range(1.0, 2.6);
        let wave = |rng: &mut SplitMix64, most: f32| [most * rng.unit(), TAU * rng.unit()];
        Chip {
            place: [corner + f64::from(aside) * t, f64::from(height_m) * t],
            half: [radius * t as f32, radius * long * t as f32],
            waves: [wave(rng, 0.30), wave(rng, 0.22), wave(rng, 0.16)],
        }
    }

    fn paint(&self, window: &TexelWindow, out: &mut [f32]) {
        let [x, y] = self.place;
        let [across, up] = self.half.map(|half| f64::from(1.7 * half + 1.0));
        let range = |at: f64, reach: f64, first: i64, count: usize| {
            let within = |texel: f64| texel.clamp(first as f64, (first + count as i64) as f64) as i64;
            within((at - reach).floor())..within((at + reach).ceil())
        };
        let soft = 0.75 / self.half[0].max(0.3);
        // A chip smaller than a texel keeps its area.
        let share = (self.half[0] * self.half[1] * 0.5 * TAU).min(1.0);
        for j in range(y, up, window.j0, window.height) {
            for i in range(x, across, window.i0, window.width) {
                let dx = (i as f64 + 0.5 - x) as f32 / self.half[0].max(0.5);
                let dy = (j as f64 + 0.5 - y) as f32 / self.half[1].max(0.5);
                let away = (dx * dx + dy * dy).sqrt();
                if away > 2.0 {
                    continue;
                }
                // The outline, by the angle: sine and cosine of its multiples.
                let (c1, s1) = if away > 1e-6 { (dx / away, dy / away) } else { (1.0, 0.0) };
                let (c2, s2) = (c1 * c1 - s1 * s1, 2.0 * c1 * s1);
                let (c3, s3) = (c2 * c1 - s2 * s1, s2 * c1 + c2 * s1);
                let outline = [(c2, s2), (c3, s3), (c2 * c3 - s2 * s3, s2 * c3 + c2 * s3)];
                let mut rim = 1.0;
                for ([most, phase], (c, s)) in self.waves.iter().zip(outline) {
                    let (sine, cosine) = sin_cos(f64::from(*phase));
                    rim += most * (c * cosine as f32 - s * sine as f32);
                }
                let inside = ((rim - away) / soft + 0.5).clamp(0.0, 1.0);
                let out = &mut out[(j - window.j0) as usize * window.width + (i - window.i0) as usize];
                // A rim of dirt sits in the broken edge.
                let broken = exp_f32(-((rim - away) / 0.2).max(0.0));
                *out = out.max(DEPTH * inside * share * (1.0 + 0.25 * broken));
            }
        }
    }
}
