//! Which part of a photograph is the stain.

use super::ImportError;
use super::raster::{Raster, quantile};
use super::surface::Surface;

/// What belongs to the stain rises above so many standard deviations of the wall somewhere, and lies above so many.
const RISES: f64 = 6.0;
const LIES: f64 = 2.5;
/// Least density that can be a stain.
const LEAST_DENSITY: f64 = 0.02;
/// Parts with less of the stain than this, against the largest, are dirt of another kind; so are those at the side of
/// the photograph that are not much of it (corners, shadows).
const LEAST_PART: f64 = 0.02;
const LEAST_PART_AT_SIDE: f64 = 0.30;

/// The stain at the resolution of the fit.
pub(super) struct Stain {
    /// Where it is, without its soft edge.
    pub core: Vec<bool>,
    /// 1 on it, 0 away from it, smooth in between.
    pub window: Raster,
    /// The wall without any stain, for its noise.
    pub clean: Vec<bool>,
}

/// Everything that is not clean wall, with a margin.
pub(super) fn around(surface: &Surface) -> Vec<bool> {
    let (all, _) = parts(surface);
    dilated(&all, &surface.smooth, margin(&surface.smooth))
}

/// Finds the stain.
pub(super) fn find(surface: &Surface) -> Result<Stain, ImportError> {
    let (all, core) = parts(surface);
    let none = || ImportError::NoStain { noise: surface.noise };
    if !core.contains(&true) {
        return Err(none());
    }
    let on_it = || surface.smooth.values.iter().zip(&core).filter(|(_, core)| **core).map(|(r, _)| *r);
    if quantile(on_it(), 0.95) < (RISES * surface.noise).max(LEAST_DENSITY) {
        return Err(none());
    }
    let margin = margin(&surface.smooth);
    let near = dilated(&core, &surface.smooth, margin);
    let window = Raster {
        width: surface.smooth.width,
        height: surface.smooth.height,
        values: near.iter().map(|&near| f32::from(u8::from(near))).collect(),
    };
    let clean = dilated(&all, &surface.smooth, margin).into_iter().map(|stained| !stained).collect();
    Ok(Stain { core, window: window.blurred((margin / 2).max(1), 2), clean })
}

/// How far a stain's soft edge may go on.
fn margin(smooth: &Raster) -> usize {
    (smooth.width.max(smooth.height) / 40).max(3)
}

/// All that stands out, and of that what is the stain: connected parts that rise high enough.
fn parts(surface: &Surface) -> (Vec<bool>, Vec<bool>) {
    let smooth = &surface.smooth;
    let lies = LIES * surface.noise;
    let rises = (RISES * surface.noise).max(LEAST_DENSITY);
    let mut label = vec![0usize; smooth.values.len()];
    let mut found: Vec<Part> = Vec::new();
    for start in 0..label.len() {
        if label[start] == 0 && f64::from(smooth.values[start]) > rises {
            found.push(Part::grown(smooth, lies, start, found.len() + 1, &mut label));
        }
    }
    let largest = found.iter().map(|part| part.mass).fold(0.0, f64::max);
    let belongs = |part: &Part| {
        let least = if part.at_side { LEAST_PART_AT_SIDE } else { LEAST_PART };
        part.mass >= least * largest
    };
    let kept: Vec<bool> = std::iter::once(false).chain(found.iter().map(belongs)).collect();
    (label.iter().map(|&label| label > 0).collect(), label.iter().map(|&label| kept[label]).collect())
}

/// A connected part.
struct Part {
    mass: f64,
    at_side: bool,
}

impl Part {
    fn grown(smooth: &Raster, lies: f64, start: usize, number: usize, label: &mut [usize]) -> Part {
        let (width, height) = (smooth.width, smooth.height);
        let mut part = Part { mass: 0.0, at_side: false };
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

/// A mask and what is within `radius` of it along rows and columns.
fn dilated(mask: &[bool], like: &Raster, radius: usize) -> Vec<bool> {
    let values = mask.iter().map(|&on| f32::from(u8::from(on))).collect();
    let spread = Raster { width: like.width, height: like.height, values }.blurred(radius, 1);
    // A single pixel of the mask is one of (2 radius + 1)^2 in the mean.
    let least = 0.5 / ((2 * radius + 1) * (2 * radius + 1)) as f32;
    spread.values.iter().map(|&share| share > least).collect()
}
