//! Noise in plan space: hashed values on a lattice, interpolated by B-splines. It has the same value at a place for any
//! texel density, tile or rectangle, without storage.

use super::lattice::{SplineAxis, SplineLattice, TexelWindow, spline_weights};

/// Mixes the bits of a 32-bit word (Wellons' `lowbias32`).
#[inline]
pub(super) fn mix(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Hash of a lattice point.
#[inline]
pub(super) fn hash(key: u32, i: i32, j: i32) -> u32 {
    mix(column_word(i) ^ row_key(key, j))
}

/// Part of [`hash`] that is constant along a row.
#[inline]
pub(super) fn row_key(key: u32, j: i32) -> u32 {
    mix((j as u32).wrapping_add(key))
}

/// Part of [`hash`] that varies along a row.
#[inline]
pub(super) fn column_word(i: i32) -> u32 {
    (i as u32).wrapping_mul(0x9e37_79b1)
}

/// Hash of a lattice point as a number in `[-1, 1)`.
#[inline]
pub(super) fn signed(key: u32, i: i32, j: i32) -> f32 {
    hash(key, i, j) as i32 as f32 / 2_147_483_648.0
}

/// Spacing of lattices from which noise is turned, metres: smaller squares do not show.
const TURNED_FROM_M: f64 = 0.1;
/// Cosine and sine of the turn, and how far the lattice is bent, in its spacings.
const TURN: [f64; 2] = [0.8, 0.6];
const BEND: f64 = 0.8;
/// Values of turned noise per spacing, and their root mean square.
const FINER: f64 = 4.0;
const TURNED_RMS: f32 = 0.31;

/// Purpose of a noise; each has a separate pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(super) enum Channel {
    Fine = 1,
    Middle,
    MiddleDetail,
    Coarse,
    CoarseDetail,
    EdgeStretch,
    EdgeClump,
    EdgeStreak,
    Ground,
    GroundMiddle,
    GroundCoarse,
    GroundTint,
    Piece,
    Dither,
    WallFine,
    WallMiddle,
    WallCoarse,
    WallGround,
    WallGroundMiddle,
    WallGroundCoarse,
    WallGroundTint,
    WallPiece,
    WallPore,
    SplashStretch,
    SplashStroke,
    SplashWave,
    SplashRipple,
    SplashStreak,
    SplashDrop,
    Drip,
    WallDither,
    Mop,
    Spots,
    Masonry,
    WallChip,
    Puddle,
    PuddleBays,
    FineDetail,
}

/// Key of a channel for a seed.
pub(super) fn key(seed: u64, channel: Channel) -> u32 {
    mix((seed as u32) ^ mix((seed >> 32) as u32 ^ mix(channel as u32)))
}

/// A stationary noise with mean 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    key: u32,
    /// Lattice spacing along x and y, metres.
    spacing_m: [f64; 2],
    sd: f32,
    /// Whether its lattice is turned and bent.
    turned: bool,
}

impl Noise {
    /// Creates noise of deviation `sd`; `size_m`: the autocorrelation's width at half height, per axis.
    pub fn new(seed: u64, channel: Channel, size_m: [f64; 2], sd: f32) -> Noise {
        // The autocorrelation is a quintic B-spline: its full width at half maximum is 1.67 spacings.
        Noise { key: key(seed, channel), spacing_m: size_m.map(|size| size / 1.67), sd, turned: false }
    }

    /// Turns and bends the lattice, if its squares are large enough to show: along the rows and columns of walls, joints
    /// and mops they would.
    pub fn turned(self) -> Noise {
        Noise { turned: self.spacing_m.into_iter().all(|spacing_m| spacing_m >= TURNED_FROM_M), ..self }
    }

    pub fn is_flat(&self) -> bool {
        self.sd == 0.0
    }

    /// Standard deviation of the mean over a texel: spots smaller than a texel average out.
    pub fn sd_of_texels(&self, texels_per_metre: f64) -> f32 {
        // Variances of a B-spline (1/4 spacing^2) and a box (1/12 texel^2) add, per axis.
        let share = |spacing_m: f64| {
            let texels = spacing_m * texels_per_metre;
            1.0 / (1.0 + 1.0 / (3.0 * texels * texels))
        };
        let [x, y] = self.spacing_m.map(share);
        self.sd * (x * y).sqrt().sqrt() as f32
    }

    /// Lays the noise out over a window.
    pub fn over(&self, window: &TexelWindow) -> NoiseField {
        let [x, y] = self.spacing_m.map(|spacing_m| spacing_m * window.texels_per_metre);
        if self.turned && x.max(y) > 1.0 {
            let gain = self.sd_of_texels(window.texels_per_metre) / TURNED_RMS;
            return NoiseField::Lattice(Box::new(turned(window, self.key, [x, y], gain)));
        }
        self.laid_out(window, self.key, [x, y], None)
    }

    /// Lays the noise out over a window of a strip, with the pattern `salt`. On a `closed` strip of `width` texels it
    /// is periodic: spots are stretched slightly so that a whole number fits.
    pub fn over_strip(&self, window: &TexelWindow, salt: u32, width: u32, closed: bool) -> NoiseField {
        let [mut x, y] = self.spacing_m.map(|spacing_m| spacing_m * window.texels_per_metre);
        let mut period = None;
        if closed {
            let around = (f64::from(width) / x.max(1.0)).round().max(1.0);
            x = f64::from(width) / around;
            period = Some(around as i64);
        }
        self.laid_out(window, self.key ^ salt, [x, y], period)
    }

    /// Spacings are in texels; the noise repeats along x after `period` of them.
    fn laid_out(&self, window: &TexelWindow, key: u32, [x, y]: [f64; 2], period: Option<i64>) -> NoiseField {
        let sd = self.sd_of_texels(window.texels_per_metre);
        if x <= 1.0 && y <= 1.0 {
            // The difference of two uniform values has a variance of 1/6.
            return NoiseField::Texels { key, gain: sd * 6.0f32.sqrt(), corner: [window.i0, window.j0], row: 0 };
        }
        // Mean square of B-spline weights is 11/20 per axis, of a uniform value in [-1, 1) 1/3.
        let gain = sd / (11.0f32 / 20.0 * (1.0f32 / 3.0).sqrt());
        let x = SplineAxis::new(window.i0, window.width, x.max(1.0), 0.0);
        let y = SplineAxis::new(window.j0, window.height, y.max(1.0), 0.0);
        let mut values = vec![0.0; x.len * y.len];
        for (row, values) in values.chunks_exact_mut(x.len).enumerate() {
            let row_key = row_key(key, (y.first + row as i64) as i32);
            for (column, value) in (x.first..).zip(values) {
                let column = period.map_or(column, |period| column.rem_euclid(period));
                let word = mix(column_word(column as i32) ^ row_key);
                *value = gain * (word as i32 as f32 / 2_147_483_648.0);
            }
        }
        NoiseField::Lattice(Box::new(SplineLattice::new(x, y, values)))
    }
}

/// Lays out noise with spots of `x` by `y` texels on a lattice that is turned against the floor's axes and bent.
fn turned(window: &TexelWindow, key: u32, [x, y]: [f64; 2], gain: f32) -> SplineLattice {
    let axes = [(window.i0, window.width, x), (window.j0, window.height, y)];
    let [across, up] = axes.map(|(first, count, spacing)| SplineAxis::new(first, count, spacing / FINER, 0.0));
    let mut values = Vec::with_capacity(across.len * up.len);
    for j in (up.first..).take(up.len) {
        for i in (across.first..).take(across.len) {
            let (u, v) = (i as f64 / FINER, j as f64 / FINER);
            let (u, v) = (TURN[0] * u - TURN[1] * v, TURN[1] * u + TURN[0] * v);
            let bend = |word: u32| BEND * f64::from(spline(key ^ word, u, v));
            let (u, v) = (u + bend(0x5bd1), v + bend(0xe995));
            values.push(gain * spline(key, u, v));
        }
    }
    SplineLattice::new(across, up, values)
}

/// The B-spline of hashed values, a spot per unit.
fn spline(key: u32, x: f64, y: f64) -> f32 {
    let [(i, across), (j, up)] = [x, y].map(|at| {
        let middle = (at + 0.5).floor();
        (middle as i64 as i32, spline_weights((at - middle) as f32))
    });
    let row = |j: i32| (i - 1..).zip(across).map(|(i, weight)| weight * signed(key, i, j)).sum::<f32>();
    (j - 1..).zip(up).map(|(j, weight)| weight * row(j)).sum()
}

/// Noise over a window, read row by row.
#[derive(Clone, Debug)]
pub(super) enum NoiseField {
    /// Spots of several texels.
    Lattice(Box<SplineLattice>),
    /// Spots smaller than texels: their remaining variation is independent per texel.
    Texels {
        key: u32,
        gain: f32,
        /// Lower-left texel of the window.
        corner: [i64; 2],
        row: usize,
    },
}

impl NoiseField {
    pub fn begin_row(&mut self, to: usize) {
        match self {
            NoiseField::Lattice(lattice) => lattice.begin_row(to),
            NoiseField::Texels { row, .. } => *row = to,
        }
    }

    /// Adds the noise to the texels `start..start + out.len()` of the current row.
    pub fn add_to(&self, start: usize, out: &mut [f32]) {
        match self {
            NoiseField::Lattice(lattice) => lattice.add_to(start, out),
            NoiseField::Texels { key, gain, corner: [i0, j0], row } => {
                let row_key = row_key(*key, (j0 + *row as i64) as i32);
                let first = (i0 + start as i64) as i32;
                for (column, out) in out.iter_mut().enumerate() {
                    let word = mix(column_word(first.wrapping_add(column as i32)) ^ row_key);
                    *out += gain * ((word & 0xffff) as f32 - (word >> 16) as f32) / 65_536.0;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(noise: &Noise, texels_per_metre: f64, side: usize) -> Vec<f32> {
        let window = TexelWindow { texels_per_metre, i0: -40, j0: 17, width: side, height: side };
        let mut lattice = noise.over(&window);
        let mut out = vec![0.0; side * side];
        for (row, out) in out.chunks_exact_mut(side).enumerate() {
            lattice.begin_row(row);
            lattice.add_to(0, out);
        }
        out
    }

    fn mean_and_sd(values: &[f32]) -> (f32, f32) {
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>() / values.len() as f32;
        (mean, variance.sqrt())
    }

    #[test]
    fn has_the_deviation_asked_for() {
        let (mean, sd) = mean_and_sd(&field(&Noise::new(1, Channel::Middle, [0.15, 0.15], 0.12), 100.0, 600));
        assert!(mean.abs() < 0.012, "{mean}");
        assert!((sd - 0.12).abs() < 0.012, "{sd}");
    }

    #[test]
    fn spots_have_the_size_asked_for() {
        let side = 800;
        for (channel, size_m, density) in [(Channel::Middle, 0.15, 100.0), (Channel::Coarse, 1.2, 12.5)] {
            let values = field(&Noise::new(3, channel, [size_m; 2], 1.0).turned(), density, side);
            let (_, sd) = mean_and_sd(&values);
            assert!((sd - 1.0).abs() < 0.05, "deviation at {size_m} m is {sd}");
            let correlation = |lag: usize| {
                let pairs = values.chunks_exact(side).flat_map(|row| row.iter().zip(&row[lag..]));
                pairs.map(|(a, b)| a * b).sum::<f32>() / (side * (side - lag)) as f32
            };
            let half = correlation(7) / correlation(0);
            assert!((0.4..0.6).contains(&half), "correlation at half of {size_m} m is {half}");
            assert!((correlation(40) / correlation(0)).abs() < 0.1);
        }
    }

    #[test]
    fn coarse_texels_show_the_same_noise_evened_out() {
        let noise = Noise::new(5, Channel::Coarse, [0.5, 0.5], 1.0);
        let fine = field(&noise, 100.0, 400);
        // Texel (0, 0) at a tenth of the density covers texels (0..10, 0..10).
        let window = TexelWindow { texels_per_metre: 10.0, i0: 0, j0: 2, width: 30, height: 30 };
        let mut lattice = noise.over(&window);
        let mut row = vec![0.0; 30];
        lattice.begin_row(0);
        lattice.add_to(0, &mut row);
        for (k, coarse) in row.iter().enumerate() {
            let block = (0..100).map(|n| fine[(3 + n / 10) * 400 + 40 + 10 * k + n % 10]).sum::<f32>() / 100.0;
            assert!((block - coarse).abs() < 0.12, "texel {k}: {block} against {coarse}");
        }
    }

    #[test]
    fn channels_and_seeds_differ() {
        let keys =
            [key(1, Channel::Fine), key(1, Channel::EdgeClump), key(2, Channel::Fine), key(1 << 40, Channel::Fine)];
        for (n, a) in keys.iter().enumerate() {
            assert!(!keys[n + 1..].contains(a));
        }
    }
}
