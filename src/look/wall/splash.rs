//! Splash band: smears and splashes of the mop at the foot of a wall, and drips.

use super::dots::{DotSettings, Dots, poisson, splat};
use super::settings::SplashLook;
use super::strip::FaceStrip;
use crate::look::lattice::TexelWindow;
use crate::look::noise::{self, Channel, Noise, NoiseField};
use crate::math::{SplitMix64, exp_f32, smoothstep};

/// Dried water at the foot: height over which it falls to 1/e, metres, and share of the density.
const FOOT_M: f32 = 0.014;
const FOOT_SHARE: f32 = 0.55;
/// Smear above it: share of the density.
const SMEAR_SHARE: f32 = 0.60;
/// Mean height over which the smear falls to 1/e, as a share of the band's height.
const MEAN_REACH: f32 = 0.36;
/// How much blotches of the smear vary, more of them the higher.
const BLOTCHES: f32 = 0.55;
/// Largest height of droplets, as a multiple of the band's largest height.
const DROPS_END: f32 = 1.5;
/// Largest starting height of drips, and length of wall per random draw of them, metres.
const DRIP_TOP_M: f64 = 0.34;
const STRETCH_M: f64 = 1.0;
/// Distance between the drips of one splash, metres.
const CLUSTER_M: f32 = 0.07;

/// Splash band of one look.
pub(super) struct Splash {
    look: SplashLook,
    /// Dirtiness of the water along the wall; variation of the height by strokes of the mop and smaller.
    stretch: Noise,
    strokes: Noise,
    waves: Noise,
    /// Blotches of the smear.
    blotches: Noise,
    /// Streaks of the mop's strings.
    streaks: Noise,
    drops: Dots,
    drip_key: u32,
}

/// Splash band over one window.
pub(super) struct SplashWindow {
    window: TexelWindow,
    look: SplashLook,
    /// Per column: factor on the density, and height over which the smear falls to 1/e, metres.
    amount: Vec<f32>,
    reach_m: Vec<f32>,
    streaks: NoiseField,
    streak: Vec<f32>,
    blotches: NoiseField,
    blotch: Vec<f32>,
    /// Droplets and drips, per texel.
    single: Vec<f32>,
    row: usize,
}

impl Splash {
    pub fn new(look: SplashLook, seed: u64) -> Splash {
        let along = |channel, size_m| Noise::new(seed, channel, [size_m, 1.0], 1.0);
        Splash {
            look,
            stretch: along(Channel::SplashStretch, 1.1),
            strokes: along(Channel::SplashStroke, 0.62),
            waves: along(Channel::SplashWave, 0.20),
            blotches: Noise::new(seed, Channel::SplashRipple, [0.06, 0.03], 1.0),
            streaks: Noise::new(seed, Channel::SplashStreak, [0.12, 0.014], 1.0),
            drops: Dots::new(
                noise::key(seed, Channel::SplashDrop),
                DotSettings { per_m2: 420.0, radius_m: [0.0006, 0.0032], depth: [0.25, 1.0] },
            ),
            drip_key: noise::key(seed, Channel::Drip),
        }
    }

    /// Lays the band out over a window; `None` above all splashes.
    pub fn over(&self, window: &TexelWindow, strip: &FaceStrip) -> Option<SplashWindow> {
        let drips = self.look.drips_per_metre > 0.0;
        let band = self.look.density > 0.0;
        let top_m = f64::from(if band { DROPS_END * self.look.height_m } else { 0.0 });
        let top_m = if drips { top_m.max(DRIP_TOP_M) } else { top_m };
        if window.j0 as f64 >= top_m * window.texels_per_metre {
            return None;
        }
        let line = TexelWindow { j0: 0, height: 1, ..*window };
        let along = |noise: &Noise| {
            let mut field = noise.over_strip(&line, strip.salt, strip.width, strip.closed);
            let mut values = vec![0.0; window.width];
            field.begin_row(0);
            field.add_to(0, &mut values);
            values
        };
        let (stretch, strokes) = (along(&self.stretch), along(&self.strokes));
        let waves = along(&self.waves);
        let sd = self.look.unevenness;
        let amount = stretch.iter().zip(&waves).map(|(s, w)| exp_f32(sd * (0.85 * s + 0.35 * w) - 0.42 * sd * sd));
        let reach_m = strokes.iter().zip(&waves).zip(&stretch).map(|((s, w), a)| {
            let ups = sd * (0.16 * s + 0.06 * w + 0.10 * a);
            self.look.height_m * soft_limits(MEAN_REACH + ups)
        });
        // At a coarse density the band is a few rows of a high window; nothing is worked out above it.
        let end_m = f64::from(DROPS_END * self.look.height_m);
        let rows = (end_m * window.texels_per_metre).ceil() as i64 - window.j0;
        let foot = TexelWindow { height: rows.clamp(1, window.height as i64) as usize, ..*window };
        let mut shown = SplashWindow {
            window: *window,
            look: self.look,
            amount: amount.collect(),
            reach_m: reach_m.collect(),
            blotches: self.blotches.over_strip(&foot, strip.salt, strip.width, strip.closed),
            blotch: vec![0.0; window.width],
            streaks: self.streaks.over_strip(&foot, strip.salt, strip.width, strip.closed),
            streak: vec![0.0; window.width],
            single: Vec::new(),
            row: 0,
        };
        if band {
            shown.single = self.drops.over(&foot, strip);
            shown.thin_out_drops();
        }
        shown.single.resize(window.texels(), 0.0);
        if drips {
            for drip in self.drips(window, strip) {
                drip.paint(window, strip.texels_per_metre, &mut shown.single);
            }
        }
        Some(shown)
    }

    /// Returns the drips that may reach a window. Splashes occur anywhere along the wall (a Poisson process); each
    /// leaves one drip, or a few close together.
    fn drips(&self, window: &TexelWindow, strip: &FaceStrip) -> Vec<Drip> {
        let density = strip.texels_per_metre;
        let around = (f64::from(strip.width) / (STRETCH_M * density)).round().max(1.0);
        let side = f64::from(strip.width) / around;
        let margin = (f64::from(CLUSTER_M) + 0.02) * density;
        let first = ((window.i0 as f64 - margin) / side).floor() as i64;
        let last = (((window.i0 + window.width as i64) as f64 + margin) / side).floor() as i64;
        // Two drips per splash, on average.
        let mean = 0.5 * f64::from(self.look.drips_per_metre) * side / density;
        let mut drips = Vec::new();
        for stretch in first..=last {
            let drawn = if strip.closed { stretch.rem_euclid(around as i64) } else { stretch };
            let mut rng = SplitMix64::new(u64::from(noise::hash(self.drip_key ^ strip.salt, drawn as i32, 0)));
            for _ in 0..poisson(mean, &mut rng) {
                let middle = (stretch as f64 + f64::from(rng.unit())) * side;
                for _ in 0..=poisson(1.0, &mut rng).min(4) {
                    let place = middle + f64::from(CLUSTER_M * (rng.unit() + rng.unit() - 1.0)) * density;
                    drips.push(Drip::draw(place, density, &mut rng));
                }
            }
        }
        drips
    }

    /// Positions of the drips that may reach a window, texels along the strip.
    #[cfg(test)]
    pub fn places_of_drips(&self, window: &TexelWindow, strip: &FaceStrip) -> Vec<f64> {
        self.drips(window, strip).into_iter().map(|drip| drip.place).collect()
    }
}

/// A drip.
struct Drip {
    /// Position, texels along the strip.
    place: f64,
    /// Heights above the floor, metres.
    top_m: f32,
    end_m: f32,
    /// Radius, texels.
    radius: f32,
    depth: f32,
    key: u32,
}

impl Drip {
    fn draw(place: f64, density: f64, rng: &mut SplitMix64) -> Drip {
        let high = rng.unit();
        let top_m = 0.07 + (DRIP_TOP_M as f32 - 0.09) * high * high;
        let end_m = (top_m - rng.range(0.03, 0.26)).max(0.0);
        let radius = rng.range(0.0020, 0.0042) * density as f32;
        Drip { place, top_m, end_m, radius, depth: rng.range(0.05, 0.20), key: rng.next_u64() as u32 }
    }

    /// Adds the drip to a window: thin, nearly straight, paler upward, with a bead at its end.
    fn paint(&self, window: &TexelWindow, density: f64, out: &mut [f32]) {
        // Variance of the run and of a texel.
        let variance = self.radius * self.radius / 4.0 + 1.0 / 12.0;
        let depth = self.depth * self.radius / 2.0 / variance.sqrt();
        let reach = f64::from(3.0 * variance.sqrt());
        for row in 0..window.height {
            let height_m = ((window.j0 + row as i64) as f64 + 0.5) / density;
            let way = (self.top_m - height_m as f32) / (self.top_m - self.end_m).max(1e-3);
            if !(0.0..=1.0).contains(&way) {
                continue;
            }
            let place = self.place + self.wander_m(height_m) * density;
            let within = |texel: f64| texel.clamp(window.i0 as f64, (window.i0 + window.width as i64) as f64) as i64;
            for i in within((place - reach).floor())..within((place + reach).ceil()) {
                let dx = (i as f64 + 0.5 - place) as f32;
                let value = depth * (0.35 + 0.65 * way) * (3.0 * way).min(1.0) * exp_f32(-0.5 * dx * dx / variance);
                let out = &mut out[row * window.width + (i - window.i0) as usize];
                *out = out.max(value);
            }
        }
        if self.end_m > 0.0 {
            let end = f64::from(self.end_m);
            let place = [self.place + self.wander_m(end) * density, end * density];
            splat(out, window, place, 1.5 * self.radius, 1.25 * self.depth);
        }
    }

    /// Sideways deviation of the run, metres, with knots every 3 cm.
    fn wander_m(&self, height_m: f64) -> f64 {
        let knot = (height_m / 0.03).floor();
        let f = height_m / 0.03 - knot;
        let at = |knot: f64| f64::from(noise::signed(self.key, knot as i32, 0));
        0.0022 * (at(knot) + (at(knot + 1.0) - at(knot)) * smoothstep(f))
    }
}

impl SplashWindow {
    /// Reduces droplets above the band, where they become rare.
    fn thin_out_drops(&mut self) {
        for row in 0..self.single.len() / self.window.width {
            let height_m = self.height_m(row);
            let line = &mut self.single[row * self.window.width..][..self.window.width];
            for ((value, reach), amount) in line.iter_mut().zip(&self.reach_m).zip(&self.amount) {
                let above = ((height_m - reach) / (0.25 * self.look.height_m)).max(0.0);
                let ends = (2.0 * (DROPS_END - height_m / self.look.height_m)).clamp(0.0, 1.0);
                *value *= self.look.density * amount.min(2.0) * exp_f32(-above) * ends;
            }
        }
    }

    /// Height of a row's centre above the floor, metres.
    fn height_m(&self, row: usize) -> f32 {
        ((self.window.j0 + row as i64) as f64 + 0.5) as f32 / self.window.texels_per_metre as f32
    }

    pub fn begin_row(&mut self, row: usize) {
        self.row = row;
        self.streak.fill(0.0);
        self.blotch.fill(0.0);
        if self.height_m(row) < DROPS_END * self.look.height_m {
            self.streaks.begin_row(row);
            self.streaks.add_to(0, &mut self.streak);
            self.blotches.begin_row(row);
            self.blotches.add_to(0, &mut self.blotch);
        }
    }

    /// Reads the optical density of the current row, times `factor`.
    pub fn read(&self, factor: f32, out: &mut [f32]) {
        let texel_m = (1.0 / self.window.texels_per_metre) as f32;
        let height_m = self.height_m(self.row);
        let single = &self.single[self.row * self.window.width..][..out.len()];
        let end_m = DROPS_END * self.look.height_m;
        if height_m - texel_m > end_m || self.look.density == 0.0 {
            for (out, single) in out.iter_mut().zip(single) {
                *out = factor * single;
            }
            return;
        }
        // Means over a texel: the foot may be thinner.
        let (low, high) = ((height_m - 0.5 * texel_m) / FOOT_M, (height_m + 0.5 * texel_m) / FOOT_M);
        let foot = FOOT_SHARE * (exp_f32(-low) - exp_f32(-high)) / (high - low);
        // Nothing ends in a line: the smear thins out, in blotches.
        let rest = (1.0 - height_m / end_m).max(0.0);
        let fade = rest * (2.0 - rest);
        let columns = self.amount.iter().zip(&self.reach_m).zip(self.streak.iter().zip(&self.blotch));
        for ((out, ((amount, reach), (streak, blotch))), single) in out.iter_mut().zip(columns).zip(single) {
            let up = height_m / reach;
            let blotchy = exp_f32(BLOTCHES * blotch * up.min(1.6) - 0.12 * up.min(1.6));
            let smear = SMEAR_SHARE * exp_f32(-up * up.sqrt()) * blotchy * (1.0 + 0.2 * streak).max(0.1);
            let band = self.look.density * amount * fade * (foot * (1.0 + 0.2 * streak) + smear);
            *out = factor * (band + single);
        }
    }
}

/// A share that nears 0.12 and 0.7 without a kink.
fn soft_limits(share: f32) -> f32 {
    let [low, high] = [0.12, 0.7];
    let middle = 0.5 * (low + high);
    let half = 0.5 * (high - low);
    let off = (share - middle) / half;
    middle + half * off / (1.0 + off * off).sqrt()
}
