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

use image::{GrayImage, Luma};
use trodden::math::{Rect, Vec2, vec2};

/// Pixels per centimetre of every pattern.
const PX_PER_CM: f64 = 10.0;
/// Samples per pixel along each side.
const SAMPLES: u32 = 4;

/// One image to draw.
pub struct Drawing {
    /// File name without ending.
    pub name: &'static str,
    /// What the image shows, centimetres.
    frame: Rect,
    /// Coverage, 0 to 1, at a place within the frame.
    coverage: Box<dyn Fn(Vec2) -> f64>,
}

/// All patterns, soles first.
pub fn all() -> Vec<Drawing> {
    let mut drawings = soles::all();
    drawings.extend(heel_marks::all());
    drawings
}

impl Drawing {
    /// The image: each pixel the mean of its samples.
    pub fn render(&self) -> GrayImage {
        let width = (self.frame.width() * PX_PER_CM).round() as u32;
        let height = (self.frame.height() * PX_PER_CM).round() as u32;
        GrayImage::from_fn(width, height, |column, row| {
            let mut sum = 0.0;
            for sample in 0..SAMPLES * SAMPLES {
                let (right, down) = (sample % SAMPLES, sample / SAMPLES);
                let x = f64::from(column * SAMPLES + right) + 0.5;
                let y = f64::from(row * SAMPLES + down) + 0.5;
                let step = PX_PER_CM * f64::from(SAMPLES);
                sum += (self.coverage)(vec2(self.frame.min.x + x / step, self.frame.max.y - y / step)).clamp(0.0, 1.0);
            }
            Luma([(sum / f64::from(SAMPLES * SAMPLES) * 255.0).round() as u8])
        })
    }
}
