//! Finds the stain in a photograph: connected parts that differ from the clean wall.
//!
//! Not imageproc's connected components: parts grow from seeds above a second, higher threshold.

use super::ImportError;
use super::raster::{PixelRaster, quantile};

/// Standard deviations of the wall's noise that a part of the stain exceeds somewhere, and everywhere.
const RISES: f64 = 6.0;
const LIES: f64 = 2.5;
/// Least density that can be a stain.
const LEAST_DENSITY: f64 = 0.02;
/// Least mass of a part, as a share of the largest: of any part, and of parts at the border of the photograph
/// (corners, shadows).
const LEAST_PART: f64 = 0.02;
const LEAST_PART_AT_SIDE: f64 = 0.30;

/// Mask of the stain at the resolution of the fit.
pub(super) struct StainMask {
    /// Pixels of the stain without its soft edge.
    pub core: Vec<bool>,
    /// 1 on it, 0 away from it, smooth in between.
    pub window: PixelRaster,
    /// Pixels of the clean wall.
    pub clean: Vec<bool>,
}

/// Marks every pixel that is not clean wall, with a margin. `residual` is the smoothed residual, `noise` its standard
/// deviation on the clean wall.
pub(super) fn around(residual: &PixelRaster, noise: f64) -> Vec<bool> {
    let (all, _) = parts(residual, noise);
    dilated(&all, residual, margin(residual))
}

/// Finds the stain in a smoothed residual with this noise.
pub(super) fn find(residual: &PixelRaster, noise: f64) -> Result<StainMask, ImportError> {
    let (all, core) = parts(residual, noise);
    let none = || ImportError::NoStain { noise };
    if !core.contains(&true) {
        return Err(none());
    }
    let on_it = || residual.values.iter().zip(&core).filter(|(_, core)| **core).map(|(r, _)| *r);
    if quantile(on_it(), 0.95) < (RISES * noise).max(LEAST_DENSITY) {
        return Err(none());
    }
    let margin = margin(residual);
    let near = dilated(&core, residual, margin);
    let window = PixelRaster {
        width: residual.width,
        height: residual.height,
        values: near.iter().map(|&near| f32::from(u8::from(near))).collect(),
    };
    let clean = dilated(&all, residual, margin).into_iter().map(|stained| !stained).collect();
    Ok(StainMask { core, window: window.blurred((margin / 2).max(1), 2), clean })
}

/// Width of a stain's soft edge, pixels.
fn margin(smooth: &PixelRaster) -> usize {
    (smooth.width.max(smooth.height) / 40).max(3)
}

/// All connected parts that stand out, and those of them that form the stain.
fn parts(smooth: &PixelRaster, noise: f64) -> (Vec<bool>, Vec<bool>) {
    let lies = LIES * noise;
    let rises = (RISES * noise).max(LEAST_DENSITY);
    let mut label = vec![0usize; smooth.values.len()];
    let mut found: Vec<StainPart> = Vec::new();
    for start in 0..label.len() {
        if label[start] == 0 && f64::from(smooth.values[start]) > rises {
            found.push(StainPart::grown(smooth, lies, start, found.len() + 1, &mut label));
        }
    }
    let largest = found.iter().map(|part| part.mass).fold(0.0, f64::max);
    let belongs = |part: &StainPart| {
        let least = if part.at_side { LEAST_PART_AT_SIDE } else { LEAST_PART };
        part.mass >= least * largest
    };
    let kept: Vec<bool> = std::iter::once(false).chain(found.iter().map(belongs)).collect();
    (label.iter().map(|&label| label > 0).collect(), label.iter().map(|&label| kept[label]).collect())
}

/// A connected part of the residual.
struct StainPart {
    mass: f64,
    at_side: bool,
}

impl StainPart {
    fn grown(smooth: &PixelRaster, lies: f64, start: usize, number: usize, label: &mut [usize]) -> StainPart {
        let (width, height) = (smooth.width, smooth.height);
        let mut part = StainPart { mass: 0.0, at_side: false };
        let mut open = vec![start];
        label[start] = number;
        while let Some(n) = open.pop() {
            let (i, j) = (n % width, n / width);
            part.mass += f64::from(smooth.values[n]);
            part.at_side |= i == 0 || j == 0 || i + 1 == width || j + 1 == height;
            let sides = [(i > 0, n.wrapping_sub(1)), (i + 1 < width, n + 1)];
            let ends = [(j > 0, n.wrapping_sub(width)), (j + 1 < height, n + width)];
            for (_, next) in sides.into_iter().chain(ends).filter(|(is_inside, _)| *is_inside) {
                if label[next] == 0 && f64::from(smooth.values[next]) > lies {
                    label[next] = number;
                    open.push(next);
                }
            }
        }
        part
    }
}

/// Dilates a mask by `radius` along rows and columns.
fn dilated(mask: &[bool], like: &PixelRaster, radius: usize) -> Vec<bool> {
    let values = mask.iter().map(|&on| f32::from(u8::from(on))).collect();
    let spread = PixelRaster { width: like.width, height: like.height, values }.blurred(radius, 1);
    // A single pixel of the mask is one of (2 radius + 1)^2 in the mean.
    let least = 0.5 / ((2 * radius + 1) * (2 * radius + 1)) as f32;
    spread.values.iter().map(|&share| share > least).collect()
}
