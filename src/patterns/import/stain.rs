//! Finds the stain in a photograph: connected parts that differ from the clean wall.

use image::{GrayImage, Luma};
use imageproc::distance_transform::Norm;
use imageproc::morphology::dilate;
use imageproc::region_labelling::{Connectivity, connected_components};

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
    Ok(StainMask { core, window: window.blurred(usize::from(margin / 2).max(1), 2), clean })
}

/// Width of a stain's soft edge, pixels.
fn margin(smooth: &PixelRaster) -> u8 {
    (smooth.width.max(smooth.height) / 40).clamp(3, 255) as u8
}

/// All connected parts that stand out, and those of them that form the stain: a part lies above one threshold
/// everywhere and above a second, higher one somewhere.
fn parts(smooth: &PixelRaster, noise: f64) -> (Vec<bool>, Vec<bool>) {
    let lies = LIES * noise;
    let rises = (RISES * noise).max(LEAST_DENSITY);
    let lying = mask(smooth.values.iter().map(|&value| f64::from(value) > lies), smooth);
    let labels = connected_components(&lying, Connectivity::Four, Luma([0]));
    let mut found = vec![StainPart::default(); labels.iter().max().map_or(0, |&last| last as usize) + 1];
    for ((i, j, label), &value) in labels.enumerate_pixels().zip(&smooth.values) {
        let part = &mut found[label.0[0] as usize];
        part.mass += f64::from(value);
        part.rises |= f64::from(value) > rises;
        part.at_side |= i == 0 || j == 0 || i + 1 == labels.width() || j + 1 == labels.height();
    }
    // Label 0 is all that does not stand out.
    found[0] = StainPart::default();
    let largest = found.iter().filter(|part| part.rises).map(|part| part.mass).fold(0.0, f64::max);
    let belongs = |part: &StainPart| {
        let least = if part.at_side { LEAST_PART_AT_SIDE } else { LEAST_PART };
        part.rises && part.mass >= least * largest
    };
    let marked = |is_marked: &dyn Fn(&StainPart) -> bool| {
        labels.iter().map(|&label| is_marked(&found[label as usize])).collect::<Vec<bool>>()
    };
    (marked(&|part| part.rises), marked(&belongs))
}

/// A connected part of the residual.
#[derive(Clone, Copy, Default)]
struct StainPart {
    mass: f64,
    rises: bool,
    at_side: bool,
}

/// Dilates a mask by `radius` along rows and columns.
fn dilated(on: &[bool], like: &PixelRaster, radius: u8) -> Vec<bool> {
    dilate(&mask(on.iter().copied(), like), Norm::LInf, radius).iter().map(|&pixel| pixel > 0).collect()
}

/// An image of the size of a raster, 255 where `on`.
fn mask(on: impl Iterator<Item = bool>, like: &PixelRaster) -> GrayImage {
    let pixels = on.map(|on| if on { u8::MAX } else { 0 }).collect();
    GrayImage::from_raw(like.width as u32, like.height as u32, pixels).expect("a raster has a value per pixel")
}
