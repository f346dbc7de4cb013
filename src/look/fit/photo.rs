//! The photographed floor as if seen from straight above, and without the slope of the light that falls on it.

use std::path::Path;

use image::RgbImage;
use rayon::prelude::*;

use super::options::FitOptions;
use crate::files::{LARGEST_IMAGE_BYTES, read_input};
use crate::look::error::LookError;
use crate::math::{ln, srgb, vec2};
use crate::patterns::{ImportError, PixelRaster, decode_photo};
use crate::plan::{homography, mapped};

/// Texels per metre: the most, and the fewest that tell lanes from margins.
const DENSITIES: [f64; 2] = [8.0, 150.0];
/// Most texels of a floor, and its least side.
const MOST_TEXELS: f64 = 2.5e6;
const LEAST_SIDE: usize = 24;
/// Pixels of the photograph per texel where it is coarsest: their mean has less of the camera's noise.
const PIXELS_PER_TEXEL: f64 = 1.4;
/// Light below which nothing is a floor's colour.
const BLACK: f64 = 0.003;

/// A floor in linear light, the upper row first.
#[derive(Clone, Debug)]
pub(super) struct FloorPicture {
    pub texels_per_metre: f64,
    pub rgb: [PixelRaster; 3],
}

impl FloorPicture {
    pub fn size(&self) -> [usize; 2] {
        [self.rgb[0].width, self.rgb[0].height]
    }

    fn luminance(&self) -> PixelRaster {
        let [width, height] = self.size();
        PixelRaster::from_fn(width, height, |x, y| {
            let [r, g, b] = self.rgb.each_ref().map(|plane| plane.values[y * width + x]);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        })
    }

    /// Luminance as an sRGB value, 0 to 255, as eyes and cameras grade it.
    pub fn tone(&self) -> PixelRaster {
        self.luminance().map(srgb::encode_f32)
    }

    pub fn picture(&self) -> RgbImage {
        let [width, height] = self.size();
        RgbImage::from_fn(width as u32, height as u32, |x, y| {
            let at = y as usize * width + x as usize;
            image::Rgb(self.rgb.each_ref().map(|plane| srgb::encode_f32(plane.values[at]).round() as u8))
        })
    }

    /// Divides all light by a slope along x and y: ln of the light per texel, 0 in the middle.
    pub fn without_slope(&mut self, slope: [f64; 2]) {
        let [width, height] = self.size();
        let along = |slope: f64, count: usize| -> Vec<f32> {
            let middle = 0.5 * (count as f64 - 1.0);
            (0..count).map(|k| crate::math::exp(-slope * (k as f64 - middle)) as f32).collect()
        };
        let (across, down) = (along(slope[0], width), along(slope[1], height));
        for plane in &mut self.rgb {
            for (row, down) in plane.values.chunks_exact_mut(width).zip(&down) {
                row.iter_mut().zip(&across).for_each(|(light, across)| *light *= across * down);
            }
        }
    }
}

/// A photograph that was straightened.
pub(super) struct Straightened {
    pub floor: FloorPicture,
    /// Texels of the part without dirt.
    pub clean: Option<Vec<bool>>,
    /// Pixels of the photograph per texel in its middle.
    pub pixels_per_texel: f64,
}

/// Reads a photograph and straightens the floor in it.
pub(super) fn read(path: &Path, options: &FitOptions) -> Result<Straightened, LookError> {
    let unreadable = |source: ImportError| LookError::Photo { path: path.to_path_buf(), source };
    let refused = |message: String, hint: &'static str| LookError::Fit { path: path.to_path_buf(), message, hint };
    let bytes = read_input(path, LARGEST_IMAGE_BYTES)
        .map_err(|error| unreadable(ImportError::Unreadable { reason: error.to_string() }))?;
    let photo = decode_photo(&bytes).map_err(unreadable)?.into_rgb8();
    let corners = options.checked_corners(path, [photo.width(), photo.height()])?;
    let map = homography(corners);
    let [width_m, height_m] = options.metres;
    let px_per_m = least_scale(map, options.metres);
    let most = (MOST_TEXELS / (width_m * height_m)).sqrt();
    let texels_per_metre = (px_per_m / PIXELS_PER_TEXEL).min(DENSITIES[1]).min(most).floor();
    let size = options.metres.map(|side| (side * texels_per_metre).round() as usize);
    if texels_per_metre < DENSITIES[0] || size.iter().any(|&side| side < LEAST_SIDE) {
        let message = format!("the photograph has {px_per_m:.1} px per metre of floor where it is coarsest");
        return Err(refused(message, "photograph the floor closer, from higher above, or choose a smaller rectangle"));
    }
    let inner = (greatest_scale(map, options.metres) / texels_per_metre).ceil().clamp(1.0, 8.0) as usize;
    let texels: Vec<[f32; 3]> = (0..size[0] * size[1])
        .into_par_iter()
        .map(|at| {
            let (x, y) = (at % size[0], at / size[0]);
            let mut sum = [0.0f32; 3];
            for n in 0..inner * inner {
                let within = |k: usize, place: usize, side: usize| {
                    (place as f64 + (k as f64 + 0.5) / inner as f64) / side as f64
                };
                let place = mapped(map, [within(n % inner, x, size[0]), within(n / inner, y, size[1])]);
                let light = sampled(&photo, place);
                (0..3).for_each(|c| sum[c] += light[c]);
            }
            sum.map(|sum| sum / (inner * inner) as f32)
        })
        .collect();
    let rgb = [0, 1, 2].map(|c| PixelRaster {
        width: size[0],
        height: size[1],
        values: texels.iter().map(|texel| texel[c]).collect(),
    });
    let mean = texels.iter().map(|texel| f64::from(texel[1])).sum::<f64>() / texels.len() as f64;
    if mean < BLACK {
        let message = format!("the floor sends {:.2} % of the light: it is black", 100.0 * mean);
        return Err(refused(message, "photograph it in even light, exposed so that the floor is not black"));
    }
    let clean = options.clean.map(|[x0, y0, x1, y1]| {
        let (columns, rows) = ([x0.min(x1), x0.max(x1)], [y0.min(y1), y0.max(y1)]);
        (0..texels.len())
            .map(|at| {
                let centre = |k: usize, side: usize| (k as f64 + 0.5) / side as f64;
                let [x, y] = mapped(map, [centre(at % size[0], size[0]), centre(at / size[0], size[1])]);
                (columns[0]..=columns[1]).contains(&x) && (rows[0]..=rows[1]).contains(&y)
            })
            .collect::<Vec<bool>>()
    });
    let few = clean.as_ref().is_some_and(|clean| clean.iter().filter(|&&is| is).count() < 30);
    if let (true, Some([x0, y0, x1, y1])) = (few, options.clean) {
        let message = format!("the clean part {x0},{y0},{x1},{y1} shows too little of the floor");
        return Err(refused(
            message,
            "give two opposite corners, in pixels of the photograph, between the floor's corners",
        ));
    }
    let [across, down] = scales(map, options.metres, [0.5, 0.5]);
    let pixels_per_texel = (across * down).sqrt() / texels_per_metre;
    Ok(Straightened { floor: FloorPicture { texels_per_metre, rgb }, clean, pixels_per_texel })
}

/// Pixels per metre along each direction at a place of the floor, 0 to 1.
fn scales(map: [f64; 8], [width, height]: [f64; 2], [u, v]: [f64; 2]) -> [f64; 2] {
    const STEP: f64 = 1e-3;
    let from = mapped(map, [u, v]);
    let along = |du: f64, dv: f64, metres: f64| {
        let to = mapped(map, [u + du, v + dv]);
        vec2(to[0] - from[0], to[1] - from[1]).length() / (STEP * metres)
    };
    [along(STEP, 0.0, width), along(0.0, STEP, height)]
}

const PLACES: [[f64; 2]; 5] = [[0.02, 0.02], [0.98, 0.02], [0.98, 0.98], [0.02, 0.98], [0.5, 0.5]];

/// Pixels per metre at the corner that is farthest from the camera.
fn least_scale(map: [f64; 8], metres: [f64; 2]) -> f64 {
    let at = |place| scales(map, metres, place).into_iter().fold(f64::INFINITY, f64::min);
    PLACES.into_iter().map(at).fold(f64::INFINITY, f64::min)
}

fn greatest_scale(map: [f64; 8], metres: [f64; 2]) -> f64 {
    PLACES.into_iter().flat_map(|place| scales(map, metres, place)).fold(0.0, f64::max)
}

/// Linear light between pixels.
fn sampled(photo: &RgbImage, [x, y]: [f64; 2]) -> [f32; 3] {
    let along = |t: f64, count: u32| {
        let t = (t - 0.5).clamp(0.0, f64::from(count - 1));
        (t as u32, (t as u32 + 1).min(count - 1), t.fract() as f32)
    };
    let ((i, i_next, s), (j, j_next, t)) = (along(x, photo.width()), along(y, photo.height()));
    let [a, b, c, d] =
        [(i, j), (i_next, j), (i, j_next), (i_next, j_next)].map(|(i, j)| srgb::light_of(photo.get_pixel(i, j).0));
    std::array::from_fn(|n| {
        let (top, bottom) = (a[n] + (b[n] - a[n]) * s, c[n] + (d[n] - c[n]) * s);
        top + (bottom - top) * t
    })
}

/// How the light falls off over a floor: a slope of ln light per texel along x and y, that of the cleanest floor.
///
/// `ignored` texels do not count. Dirt only darkens a light floor, so that a plane is laid over the brightest places (under
/// the darkest, of a dark one) by least squares that weigh what is on the other side little.
pub(super) fn slope_of_light(floor: &FloorPicture, is_darker: bool, ignored: Option<&[bool]>) -> [f64; 2] {
    /// Weight of cells on the side of dirt.
    const DIRTY: f64 = 0.02;
    let cell = (0.1 * floor.texels_per_metre).ceil() as usize;
    let luminance = floor.luminance();
    let cells = luminance.reduced(cell);
    let middle = [cells.width, cells.height].map(|count| 0.5 * (count as f64 - 1.0));
    let is_ignored = |at: usize| {
        let (left, upper) = (at % cells.width * cell, at / cells.width * cell);
        let mut texels = (0..cell * cell).map(|k| (upper + k / cell) * luminance.width + left + k % cell);
        ignored.is_some_and(|ignored| texels.any(|texel| ignored[texel]))
    };
    let points: Vec<[f64; 3]> = (0..cells.values.len())
        .filter(|&at| !is_ignored(at))
        .map(|at| {
            let (x, y) = ((at % cells.width) as f64 - middle[0], (at / cells.width) as f64 - middle[1]);
            [x, y, ln(f64::from(cells.values[at]).max(1e-4))]
        })
        .collect();
    let mut plane = [0.0; 3];
    for _ in 0..60 {
        let mut sums = [[0.0f64; 4]; 3];
        for &[x, y, light] in &points {
            let over = light - plane[0] * x - plane[1] * y - plane[2];
            let weight = if (over > 0.0) == is_darker { 1.0 } else { DIRTY };
            let row = [x, y, 1.0];
            for (k, sums) in sums.iter_mut().enumerate() {
                (0..3).for_each(|n| sums[n] += weight * row[k] * row[n]);
                sums[3] += weight * row[k] * light;
            }
        }
        plane = solved(sums);
    }
    [plane[0] / cell as f64, plane[1] / cell as f64]
}

/// Solves three equations by elimination; what is not determined is 0.
fn solved(mut rows: [[f64; 4]; 3]) -> [f64; 3] {
    for k in 0..3 {
        let pivot = rows[k][k];
        if pivot.abs() < 1e-12 {
            continue;
        }
        for n in (0..3).filter(|&n| n != k) {
            let factor = rows[n][k] / pivot;
            (0..4).for_each(|c| rows[n][c] -= factor * rows[k][c]);
        }
    }
    [0, 1, 2].map(|k| if rows[k][k].abs() < 1e-12 { 0.0 } else { rows[k][3] / rows[k][k] })
}
