//! The drawings: what is in `patterns/`, as functions of a place on the sole.
//!
//! Lengths are centimetres. A sole is a left foot seen from above, in the way its print lies on the floor: x from
//! the back of the heel to the tip, y outward (to the left of someone who walks along +x), so that the big toe
//! and the arch are at negative y. White (1) leaves full soil, black (0) leaves none.

mod foot;
mod heel_marks;
mod noise;
mod shape;
mod soles;
mod walls;

use image::GrayImage;
use trodden::math::{Rect, Vec2, vec2};

/// Pixels per centimetre of every pattern.
const PX_PER_CM: f64 = 10.0;
/// Of the pixels that are covered at all, one in so many is covered fully where a drawing is scaled to its fullest.
const FULL_ONE_IN: usize = 200;

/// One image to draw.
pub struct Drawing {
    /// File name without ending.
    pub name: &'static str,
    /// What the image shows, centimetres.
    frame: Rect,
    /// Samples per pixel along each side.
    samples: u32,
    /// Whether it is scaled so that its fullest places are covered fully.
    fills: bool,
    /// Coverage, 0 to 1, at a place within the frame.
    coverage: Box<dyn Fn(Vec2) -> f64 + Send + Sync>,
}

/// All patterns: soles, heel marks, then what is left on walls.
pub fn all() -> Vec<Drawing> {
    let mut drawings = soles::all();
    drawings.extend(heel_marks::all());
    drawings.extend(walls::all());
    drawings
}

impl Drawing {
    /// The image: each pixel the mean of its samples.
    pub fn render(&self) -> GrayImage {
        let width = (self.frame.width() * PX_PER_CM).round() as u32;
        let height = (self.frame.height() * PX_PER_CM).round() as u32;
        let means: Vec<f64> =
            (0..height).flat_map(|row| (0..width).map(move |column| (column, row))).map(|at| self.mean(at)).collect();
        let full = if self.fills { fullest(&means) } else { 1.0 };
        let pixels = means.iter().map(|mean| ((mean / full).min(1.0) * 255.0).round() as u8);
        GrayImage::from_vec(width, height, pixels.collect()).unwrap_or_default()
    }

    fn mean(&self, (column, row): (u32, u32)) -> f64 {
        let samples = self.samples;
        let step = PX_PER_CM * f64::from(samples);
        let at = |n: u32| {
            let x = f64::from(column * samples + n % samples) + 0.5;
            let y = f64::from(row * samples + n / samples) + 0.5;
            vec2(self.frame.min.x + x / step, self.frame.max.y - y / step)
        };
        let sum: f64 = (0..samples * samples).map(|n| (self.coverage)(at(n)).clamp(0.0, 1.0)).sum();
        sum / f64::from(samples * samples)
    }
}

/// The coverage that only the fullest pixels exceed.
fn fullest(means: &[f64]) -> f64 {
    let mut covered: Vec<f64> = means.iter().copied().filter(|&mean| mean > 0.02).collect();
    covered.sort_unstable_by(f64::total_cmp);
    covered.iter().rev().nth(covered.len() / FULL_ONE_IN).copied().unwrap_or(1.0)
}
