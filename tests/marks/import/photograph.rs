//! Makes photographs of a wall with a known stain on it.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::{GrayImage, ImageFormat, Luma, RgbImage};
use trodden::math::{SplitMix64, exp, pow};
use trodden::patterns::{ImportedPattern, PatternLibrary};

/// A wall, the light on it, a camera, and a stain.
#[derive(Clone)]
pub struct Scene {
    /// Coverage of the stain at 10 px/cm, and its optical density where it is full.
    pub stain: GrayImage,
    pub density: f64,
    /// What the stain takes of each channel; mean 1.
    pub tint: [f64; 3],
    /// Whether it is lighter than the wall instead.
    pub lighter: bool,
    /// Pixels of the photograph, and how many a centimetre has.
    pub size: [u32; 2],
    pub px_per_cm: f64,
    /// Where the middle of the stain is, pixels.
    pub middle: [f64; 2],
    /// By how much the camera was turned counter-clockwise, degrees.
    pub turned_deg: f64,
    /// Linear light of the wall's colour.
    pub wall: [f64; 3],
    /// How light falls off: ln across, ln down, and how much darker corners are.
    pub slope: [f64; 2],
    pub vignette: f64,
    /// Standard deviation of the camera's noise, steps of 8 bits; and of the wall's texture, density.
    pub noise: f64,
    pub texture: f64,
    /// Quality of the JPEG; `None` is a PNG.
    pub jpeg: Option<u8>,
    pub seed: u64,
}

impl Scene {
    /// A stain in even light on a light wall, taken well: what tests change.
    pub fn of(stain: GrayImage) -> Scene {
        let size = [stain.width(), stain.height()].map(|px| 2 * px + 120);
        Scene {
            stain,
            density: 0.6,
            tint: [1.0; 3],
            lighter: false,
            size,
            px_per_cm: 10.0,
            middle: size.map(|px| f64::from(px) / 2.0),
            turned_deg: 0.0,
            wall: [0.62, 0.62, 0.60],
            slope: [0.0; 2],
            vignette: 0.0,
            noise: 0.0,
            texture: 0.0,
            jpeg: None,
            seed: 1,
        }
    }

    /// The same seen from nearer: more pixels.
    pub fn at(mut self, px_per_cm: f64) -> Scene {
        let grow = px_per_cm / self.px_per_cm;
        self.size = self.size.map(|px| (f64::from(px) * grow) as u32);
        self.middle = self.middle.map(|px| px * grow);
        self.px_per_cm = px_per_cm;
        self
    }

    /// Everything that makes it hard, together.
    pub fn hard(self) -> Scene {
        Scene {
            wall: [0.55, 0.47, 0.34],
            tint: [0.8, 1.0, 1.2],
            slope: [0.5, -0.25],
            vignette: 0.3,
            noise: 2.5,
            texture: 0.01,
            jpeg: Some(85),
            ..self
        }
    }

    /// The photograph's file.
    pub fn photograph(&self) -> Vec<u8> {
        let mut noise = SplitMix64::new(self.seed);
        let mut normal = || {
            let sum: f32 = (0..6).map(|_| noise.unit()).sum();
            f64::from(sum - 3.0) * 1.414
        };
        let [width, height] = self.size;
        let image = RgbImage::from_fn(width, height, |i, j| {
            let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
            let light = self.light(x, y) * exp(-self.texture * normal());
            let density = self.density_at(x, y) * if self.lighter { -1.0 } else { 1.0 };
            image::Rgb([0, 1, 2].map(|c| {
                let linear = self.wall[c] * light * exp(-density * self.tint[c]);
                (srgb(linear) + self.noise * normal()).round().clamp(0.0, 255.0) as u8
            }))
        });
        let mut bytes = Cursor::new(Vec::new());
        match self.jpeg {
            Some(quality) => JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(&image).unwrap(),
            None => image.write_to(&mut bytes, ImageFormat::Png).unwrap(),
        }
        bytes.into_inner()
    }

    fn light(&self, x: f64, y: f64) -> f64 {
        let [u, v] = [x / f64::from(self.size[0]) - 0.5, y / f64::from(self.size[1]) - 0.5];
        // cos^4 of the angle to the lens' axis, with the loss that is asked for in the corners.
        let tan_corner = 1.0 / (1.0 - self.vignette).sqrt() - 1.0;
        let falloff = 1.0 + tan_corner * (u * u + v * v) / 0.5;
        exp(self.slope[0] * u + self.slope[1] * v) / (falloff * falloff)
    }

    /// The stain's density at a place of the photograph.
    pub fn density_at(&self, x: f64, y: f64) -> f64 {
        let (s, c) = trodden::math::sin_cos(self.turned_deg.to_radians());
        let [dx, dy] = [(x - self.middle[0]) / self.px_per_cm * 10.0, (y - self.middle[1]) / self.px_per_cm * 10.0];
        // Turned counter-clockwise for the eye, with rows that run down.
        let (dx, dy) = (c * dx - s * dy, s * dx + c * dy);
        let [i, j] = [dx + f64::from(self.stain.width()) / 2.0, dy + f64::from(self.stain.height()) / 2.0];
        // A finer photograph shows the stain's pixels as they are: interpolated, single ones would lose their peak.
        let is_finer = self.px_per_cm >= 20.0 && self.turned_deg == 0.0;
        let [i, j] = if is_finer { [i.floor() + 0.5, j.floor() + 0.5] } else { [i, j] };
        self.density * sample(&self.stain, i, j)
    }

    /// Correlation of what was imported with the stain as it is, over all that either of them covers.
    pub fn correlation(&self, import: &ImportedPattern) -> f64 {
        let reach = |truth: u32, found: u32, off: f64| f64::from(truth.max(found)) / 2.0 + off.abs() + 2.0;
        let (s, c) = trodden::math::sin_cos(self.turned_deg.to_radians());
        let [dx, dy] = [0, 1].map(|axis| (import.middle_px[axis] - self.middle[axis]) / self.px_per_cm * 10.0);
        let off = [c * dx - s * dy, s * dx + c * dy];
        let half = [
            reach(self.stain.width(), import.coverage.width(), off[0]),
            reach(self.stain.height(), import.coverage.height(), off[1]),
        ];
        let place = |image: &GrayImage, x: f64, y: f64| {
            sample(image, x + f64::from(image.width()) / 2.0, y + f64::from(image.height()) / 2.0)
        };
        let (mut n, mut sums, mut squares, mut product) = (0.0, [0.0; 2], [0.0; 2], 0.0);
        for row in 0..(2.0 * half[1]) as i64 {
            for column in 0..(2.0 * half[0]) as i64 {
                let [x, y] = [column as f64 - half[0], row as f64 - half[1]];
                let pair = [place(&self.stain, x, y), place(&import.coverage, x - off[0], y - off[1])];
                n += 1.0;
                product += pair[0] * pair[1];
                for k in 0..2 {
                    sums[k] += pair[k];
                    squares[k] += pair[k] * pair[k];
                }
            }
        }
        let variance = |k: usize| squares[k] / n - sums[k] / n * sums[k] / n;
        (product / n - sums[0] / n * sums[1] / n) / (variance(0) * variance(1)).sqrt()
    }
}

/// Coverage between the middles of pixels, 0 beyond the image.
fn sample(image: &GrayImage, x: f64, y: f64) -> f64 {
    let (x, y) = (x - 0.5, y - 0.5);
    let (i, j) = (x.floor(), y.floor());
    let at = |i: f64, j: f64| {
        let inside = i >= 0.0 && j >= 0.0 && i < f64::from(image.width()) && j < f64::from(image.height());
        if inside { f64::from(image.get_pixel(i as u32, j as u32).0[0]) / 255.0 } else { 0.0 }
    };
    let (s, t) = (x - i, y - j);
    let top = at(i, j) * (1.0 - s) + at(i + 1.0, j) * s;
    let bottom = at(i, j + 1.0) * (1.0 - s) + at(i + 1.0, j + 1.0) * s;
    top * (1.0 - t) + bottom * t
}

/// sRGB, 0 to 255, of linear light.
fn srgb(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    255.0 * if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * pow(linear, 1.0 / 2.4) - 0.055 }
}

/// A pattern of the built-in library as a stain.
pub fn built_in(name: &str) -> GrayImage {
    let library = PatternLibrary::built_in();
    let pattern = library.patterns.into_iter().find(|pattern| pattern.name == name).unwrap();
    GrayImage::from_vec(pattern.width_px, pattern.height_px, pattern.coverage).unwrap()
}

/// A stain given as coverage of a place in the unit square around the middle, `[-1, 1]`.
pub fn drawn(width: u32, height: u32, coverage: impl Fn(f64, f64) -> f64) -> GrayImage {
    GrayImage::from_fn(width, height, |i, j| {
        let x = (f64::from(i) + 0.5) / f64::from(width) * 2.0 - 1.0;
        let y = (f64::from(j) + 0.5) / f64::from(height) * 2.0 - 1.0;
        Luma([(coverage(x, y).clamp(0.0, 1.0) * 255.0).round() as u8])
    })
}

/// A drop: round and soft.
pub fn blot() -> GrayImage {
    drawn(120, 100, |x, y| exp(-4.0 * (x * x + y * y)) - 0.02)
}

/// The edge of a cup: a ring.
pub fn ring() -> GrayImage {
    drawn(110, 110, |x, y| {
        let r = ((x * x + y * y).sqrt() - 0.7) / 0.16;
        exp(-r * r) - 0.01
    })
}

/// A smear of three streaks that fade to the right.
pub fn streaks() -> GrayImage {
    drawn(260, 90, |x, y| {
        let line = |middle: f64, breadth: f64, strength: f64| {
            let d = (y - middle - 0.1 * x) / breadth;
            strength * exp(-d * d)
        };
        let fade = exp(-1.2 * (x + 1.0)) * (1.0 - x) / 2.0 * (1.0 - exp(-12.0 * (x + 1.0)));
        2.0 * fade * (line(-0.4, 0.14, 0.7) + line(0.05, 0.10, 1.0) + line(0.45, 0.18, 0.5))
    })
}
