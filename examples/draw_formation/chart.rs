//! A picture with lines and dots in the units of what is drawn.

use std::path::Path;

use image::{Rgb, RgbImage};

pub const BLUE: [u8; 3] = [31, 90, 180];
pub const GREEN: [u8; 3] = [30, 140, 70];
pub const ORANGE: [u8; 3] = [250, 185, 110];
pub const RED: [u8; 3] = [240, 150, 150];
pub const GREY: [u8; 3] = [130, 130, 130];
pub const LIGHT: [u8; 3] = [225, 225, 225];

pub struct Chart {
    image: RgbImage,
    x: [f64; 2],
    y: [f64; 2],
}

impl Chart {
    /// White, showing `x` from left to right and `y` from bottom to top.
    pub fn new(x: [f64; 2], y: [f64; 2], [width, height]: [u32; 2]) -> Chart {
        Chart { image: RgbImage::from_pixel(width, height, Rgb([255; 3])), x, y }
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        [share(x, self.x) * f64::from(self.image.width()), (1.0 - share(y, self.y)) * f64::from(self.image.height())]
    }

    /// A dot of a radius in pixels.
    pub fn dot(&mut self, at: [f64; 2], radius: f64, colour: [u8; 3]) {
        let end = self.pixel(at);
        self.stroke(end, end, 2.0 * radius, colour);
    }

    /// A line through points, of a width in pixels.
    pub fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>, width: f64, colour: [u8; 3]) {
        let points: Vec<[f64; 2]> = points.into_iter().map(|point| self.pixel(point)).collect();
        for pair in points.windows(2) {
            self.stroke(pair[0], pair[1], width, colour);
        }
    }

    /// Covers what is nearer to a segment than half the width, with soft edges.
    fn stroke(&mut self, a: [f64; 2], b: [f64; 2], width: f64, colour: [u8; 3]) {
        let reach = width / 2.0 + 1.0;
        let range = |axis: usize, size: u32| {
            let low = (a[axis].min(b[axis]) - reach).max(0.0) as u32;
            low..((a[axis].max(b[axis]) + reach).max(0.0) as u32 + 1).min(size)
        };
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0] * along[0] + along[1] * along[1];
        for j in range(1, self.image.height()) {
            for i in range(0, self.image.width()) {
                let from = [f64::from(i) + 0.5 - a[0], f64::from(j) + 0.5 - a[1]];
                let share = if length > 0.0 {
                    ((from[0] * along[0] + from[1] * along[1]) / length).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let off = [from[0] - share * along[0], from[1] - share * along[1]];
                let cover = (width / 2.0 + 0.5 - (off[0] * off[0] + off[1] * off[1]).sqrt()).clamp(0.0, 1.0);
                let Rgb(pixel) = self.image.get_pixel_mut(i, j);
                for (old, new) in pixel.iter_mut().zip(colour) {
                    *old = (f64::from(*old) * (1.0 - cover) + f64::from(new) * cover).round() as u8;
                }
            }
        }
    }

    pub fn save(&self, path: &Path) -> Result<(), image::ImageError> {
        self.image.save(path)?;
        println!("{}", path.display());
        Ok(())
    }
}
