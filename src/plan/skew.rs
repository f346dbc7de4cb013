//! Finds by how much a scanned drawing lies askew.
//!
//! Along its own rows and columns, the edges of a drawing gather in few lines; turned by any other angle, they spread over
//! many (projection profiles: Postl 1986, "Detection of linear oblique structures and skew scan in digitized documents").

use image::DynamicImage;
use rayon::prelude::*;

use super::sheet::{Sheet, colour_at};
use crate::math::sin_cos;

/// Longer side of the small picture in which edges are looked for, pixels.
const SMALL_PX: usize = 1200;
/// Least and greatest angle by which a scan lies askew, degrees: less is not felt, more is meant.
const ASKEW_DEG: [f64; 2] = [0.3, 3.0];
/// Steps in which angles are tried, degrees: of all, and near the best.
const STEP_DEG: f64 = 0.1;
const FINE_STEP_DEG: f64 = 0.02;
/// Greatest difference between the angles of rows and of columns, degrees.
const APART_DEG: f64 = 0.25;
/// How many times as much edges gather at the angle as at none, and as at the median of all angles.
const OVER_NONE: f64 = 1.1;
const OVER_MEDIAN: f64 = 1.5;
/// Least change of tone at an edge, of 255, and as a share of the greatest.
const EDGE: f64 = 30.0;
const EDGE_SHARE: f64 = 0.25;
/// Fewest edges that tell an angle, and how many of them are enough.
const FEWEST: usize = 200;
const ENOUGH: usize = 100_000;

/// The drawing as a sheet that lies askew in its image, and the angle, degrees clockwise. `None` if it lies straight, or
/// if its lines run in many directions.
pub(super) fn find(image: &DynamicImage) -> Option<(Sheet, f64)> {
    let [rows, columns] = edges(image).map(|edges| gathered(&edges));
    let (rows, columns) = (rows?, columns?);
    let angle_deg = 0.5 * (rows + columns);
    let is_askew = (ASKEW_DEG[0]..=ASKEW_DEG[1]).contains(&angle_deg.abs()) && (rows - columns).abs() <= APART_DEG;
    let (sine, cosine) = sin_cos(angle_deg.to_radians());
    let [w, h] = [image.width(), image.height()].map(f64::from);
    let corner = |[x, y]: [f64; 2]| {
        let [x, y] = [x * w, y * h];
        [0.5 * w + x * cosine - y * sine, 0.5 * h + x * sine + y * cosine]
    };
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(corner);
    is_askew.then_some((Sheet { corners, aspect: w / h }, angle_deg))
}

/// What the user is told about a drawing that was turned, with its new size.
pub(super) fn told(angle_deg: f64, (width, height): (u32, u32)) -> String {
    format!(
        "the drawing lies askew by {:.1} degrees: it was turned straight, to {width} x {height} pixels, in which places in \
         pixels count from now on",
        angle_deg.abs()
    )
}

/// Places of the edges between rows, then of those between columns: across the edge, and along it.
fn edges(image: &DynamicImage) -> [Vec<[f64; 2]>; 2] {
    let cell = (image.width().max(image.height()) as usize).div_ceil(SMALL_PX).max(1);
    let [width, height] = [image.width(), image.height()].map(|side| side as usize / cell);
    let tone = |at: usize| {
        let (left, top) = (at % width * cell, at / width * cell);
        let pixels = (top..top + cell).flat_map(|y| (left..left + cell).map(move |x| colour_at(image, x, y)));
        pixels.map(|[r, g, b]| f64::from(r) + f64::from(g) + f64::from(b)).sum::<f64>() / (3 * cell * cell) as f64
    };
    let tones: Vec<f64> = (0..width * height).into_par_iter().map(tone).collect();
    let found = |step: usize, is_row: bool| {
        let steps: Vec<f64> = tones.iter().zip(tones.iter().skip(step)).map(|(a, b)| (a - b).abs()).collect();
        let least = EDGE.max(EDGE_SHARE * steps.iter().copied().fold(0.0, f64::max));
        let place = |at: usize| [(at % width) as f64, (at / width) as f64];
        let is_edge = |at: &usize| steps[*at] >= least && (is_row || at % width + 1 < width);
        let edges = (0..steps.len()).filter(is_edge).map(place);
        edges.map(|[x, y]| if is_row { [y, x] } else { [x, -y] }).collect()
    };
    [found(width, true), found(1, false)]
}

/// The angle at which edges gather, degrees; `None` if they do so hardly more than at others.
fn gathered(edges: &[[f64; 2]]) -> Option<f64> {
    if edges.len() < FEWEST {
        return None;
    }
    let stride = edges.len().div_ceil(ENOUGH);
    let some: Vec<[f64; 2]> = edges.iter().copied().step_by(stride).collect();
    let most = some.iter().flatten().fold(0.0, |most: f64, px| most.max(px.abs()));
    let mut counts = vec![0u32; 4 * most as usize + 8];
    let mut at_angle = |angle_deg: f64| {
        let (sine, cosine) = sin_cos(angle_deg.to_radians());
        let slope = sine / cosine;
        counts.fill(0);
        for [across, along] in &some {
            counts[(across - along * slope + 2.0 * most + 4.0) as usize] += 1;
        }
        counts.iter().map(|&count| f64::from(count) * f64::from(count)).sum::<f64>()
    };
    let steps = (ASKEW_DEG[1] / STEP_DEG) as i32 + 2;
    let mut tried: Vec<(f64, f64)> =
        (-steps..=steps).map(|k| f64::from(k) * STEP_DEG).map(|angle| (at_angle(angle), angle)).collect();
    let none = at_angle(0.0);
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ((median, _), (most, best)) = (tried[tried.len() / 2], tried[tried.len() - 1]);
    if most < OVER_NONE * none || most < OVER_MEDIAN * median {
        return None;
    }
    let steps = (STEP_DEG / FINE_STEP_DEG) as i32;
    let near = (-steps..=steps).map(|k| best + f64::from(k) * FINE_STEP_DEG);
    near.map(|angle| (at_angle(angle), angle)).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, angle)| angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, Luma};

    /// Four rooms whose walls are 6 pixels thick, turned clockwise, on paper with the grain of a copier.
    fn scan(angle_deg: f64) -> DynamicImage {
        let (sine, cosine) = sin_cos(angle_deg.to_radians());
        let image = GrayImage::from_fn(900, 640, |x, y| {
            let [x, y] = [f64::from(x) - 450.0, f64::from(y) - 320.0];
            let [u, v] = [x * cosine + y * sine, y * cosine - x * sine];
            let is_wall = [-380.0, 0.0, 380.0].iter().any(|wall| (u - wall).abs() < 3.0 && v.abs() < 250.0)
                || [-250.0, 40.0, 250.0].iter().any(|wall| (v - wall).abs() < 3.0 && u.abs() < 380.0);
            let grain = ((x * 12.9898 + y * 78.233) * 437.5).rem_euclid(24.0) as u8;
            Luma([if is_wall { 20 + grain } else { 215 + grain }])
        });
        DynamicImage::ImageLuma8(image)
    }

    #[test]
    fn a_scan_that_lies_askew_is_told_from_an_upright_plan() {
        for askew_deg in [-2.6, -0.7, 0.5, 1.2] {
            let (sheet, angle_deg) = find(&scan(askew_deg)).unwrap();
            assert!((angle_deg - askew_deg).abs() < 0.1, "{askew_deg} degrees were read as {angle_deg}");
            let straight = super::super::sheet::straightened(&scan(askew_deg), &sheet);
            assert_eq!(find(&DynamicImage::ImageRgb8(straight)).map(|(_, angle_deg)| angle_deg), None);
        }
        assert!([0.0, 0.1, 8.0].iter().all(|&askew_deg| find(&scan(askew_deg)).is_none()));
    }
}
