//! Naive reference of the stamps, for tests and measurements.

use super::TexelGrid;
use crate::marks::Mark;
use crate::math::vec2;
use crate::patterns::Pattern;

/// Texels around a print from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceImage {
    /// First column on the grid.
    pub i0: i64,
    /// First row on the grid.
    pub j0: i64,
    /// Number of columns.
    pub width: usize,
    /// Mean coverage of each texel, 0..=1, row-major, row 0 lowest.
    pub coverage: Vec<f64>,
}

/// Sample points within a texel along each axis.
const PLACES: usize = 6;

/// Computes the mean coverage, 0..=1, of texels near a mark from 6 x 6 point samples each.
///
/// The pattern is only rotated, scaled to the mark's length and mirrored. Slow; for tests and measurements.
pub fn stamp_reference(pattern: &Pattern, mark: &Mark, grid: TexelGrid) -> ReferenceImage {
    let pixel_m = pattern.length_cm / 100.0 / f64::from(pattern.width_px.max(1));
    let scale = f64::from(mark.length_m) / (pattern.length_cm / 100.0);
    let t = grid.texels_per_metre;
    let diagonal_px = vec2(f64::from(pattern.width_px), f64::from(pattern.height_px)).length();
    let reach = (0.5 * diagonal_px * pixel_m * scale * t).ceil() as i64 + 1;
    let [i0, j0] = [mark.place_m.x, mark.place_m.y].map(|m| (m * t).floor() as i64 - reach);
    let width = (2 * reach + 1) as usize;
    let mut coverage = Vec::with_capacity(width * width);
    for texel in 0..width * width {
        let (i, j) = (i0 + (texel % width) as i64, j0 + (texel / width) as i64);
        let mut sum = 0.0;
        for place in 0..PLACES * PLACES {
            let within = |k: usize| (k as f64 + 0.5) / PLACES as f64;
            let point = vec2(i as f64 + within(place % PLACES), j as f64 + within(place / PLACES)) / t;
            let offset = (point - mark.place_m) / (scale * pixel_m);
            let left = mark.heading.cross(offset) * if mark.mirrored { -1.0 } else { 1.0 };
            let x = f64::from(pattern.width_px) * 0.5 + mark.heading.dot(offset);
            let y = f64::from(pattern.height_px) * 0.5 - left;
            sum += pixel(pattern, x, y);
        }
        coverage.push(sum / (PLACES * PLACES) as f64);
    }
    ReferenceImage { i0, j0, width, coverage }
}

fn pixel(pattern: &Pattern, x: f64, y: f64) -> f64 {
    let inside = x >= 0.0 && y >= 0.0 && x < f64::from(pattern.width_px) && y < f64::from(pattern.height_px);
    let index = y.max(0.0) as usize * pattern.width_px as usize + x.max(0.0) as usize;
    if inside { pattern.coverage.get(index).map_or(0.0, |&c| f64::from(c) / 255.0) } else { 0.0 }
}
