//! The border of a sheet, which is no wall.

use super::super::components::{Component, Components, Neighbours};
use super::super::drawing::is_on;
use super::super::thick::{THINNEST_M, grow, open};

/// Greatest thickness of a sheet's frame that has little within, metres.
const FINE_FRAME_M: f64 = 0.12;
/// Greatest gap that noise leaves in a frame, pixels, and the least share of each of its sides that is drawn.
const BROKEN_PX: usize = 2;
const LEAST_DRAWN: f64 = 0.95;
/// Steepest slope of the sides of a scanned sheet's frame.
const TILT: f64 = 0.04;
/// How far a frame's thickness is off its median, as a share and pixels, and how much of its length is so at least.
const UNEVEN: f64 = 0.4;
const UNEVEN_PX: f64 = 2.0;
const LEAST_ALIKE: f64 = 0.8;
/// Greatest share of a frame that lies off its sides, as a title block does.
const MOST_AT_FRAME: f64 = 0.3;

/// Takes off the frames of a sheet: strokes around all others that have less area than those within, as thick as thin walls.
pub(super) fn drop(core: &mut [u8], ink: &[u8], width: usize, metres_per_pixel: f64) {
    let square = ((THINNEST_M / metres_per_pixel).ceil() as usize).max(2);
    drop_thicker(core, ink, width, metres_per_pixel, square);
}

/// Takes off frames however fine. The outline of a building is joined to others at its doors and windows.
pub(super) fn drop_fine(strokes: &mut [u8], ink: &[u8], width: usize, metres_per_pixel: f64) {
    drop_thicker(strokes, ink, width, metres_per_pixel, 1);
}

fn drop_thicker(core: &mut [u8], ink: &[u8], width: usize, metres_per_pixel: f64, square: usize) {
    let thick = open(core, width, square);
    let joined = grow(&thick, width, BROKEN_PX);
    let pieces = Components::of(&joined, width, 1, Neighbours::Eight);
    let area_of = |p: &Component| {
        let drawn = pieces.ranges(p, width).map(|run| thick[run].iter().filter(|&&on| on != 0).count());
        drawn.sum::<usize>()
    };
    let mut largest: Vec<&Component> = pieces.all.iter().collect();
    largest.sort_by_key(|p| std::cmp::Reverse(u64::from(p.size()[0]) * u64::from(p.size()[1])));
    for piece in largest.into_iter().take(3) {
        let within = |p: &&Component| (0..2).all(|axis| p.min[axis] > piece.min[axis] && p.end[axis] < piece.end[axis]);
        let inner: usize = pieces.all.iter().filter(within).map(area_of).sum();
        let [w, h] = piece.size().map(f64::from);
        let area = area_of(piece);
        let is_fine = area as f64 / (2.0 * (w + h)) <= (FINE_FRAME_M / metres_per_pixel).max(3.6);
        let strokes = || {
            let inset = BROKEN_PX as u32 + 4;
            let [rows, columns] = [1, 0].map(|axis| {
                let from = (piece.min[axis] + inset) as usize;
                from..(piece.end[axis].saturating_sub(inset) as usize).max(from)
            });
            rows.map(|y| ink[y * width..][columns.clone()].iter().filter(|&&i| i != 0).count()).sum::<usize>()
        };
        if inner <= area && !(is_fine && strokes() * 10 >= area * 3) {
            continue;
        }
        // Other walls begin at outer walls, a title block at most at a frame.
        let band = (TILT * w.max(h)) as usize + 2 * BROKEN_PX;
        let [[left, top], [right, bottom]] = [piece.min, piece.end].map(|corner| corner.map(|px| px as usize));
        let is_off = |at: &usize| {
            let [x, y] = [at % width, at / width];
            (left + band..right.saturating_sub(band)).contains(&x)
                && (top + band..bottom.saturating_sub(band)).contains(&y)
        };
        let off = pieces.ranges(piece, width).flatten().filter(|at| thick[*at] != 0 && is_off(at)).count();
        if off as f64 > MOST_AT_FRAME * area as f64 {
            continue;
        }
        let mut mask = vec![0u8; core.len()];
        pieces.paint(piece, &mut mask, width, 1);
        if has_four_sides(&pieces, piece, [&mask, &thick], width) {
            pieces.paint(piece, core, width, 0);
        }
    }
}

/// Whether a piece covers the four lines between its corners, those are almost upright and level, and all are drawn alike:
/// an outer wall is thinner in its windows. Of the masks, the second has the strokes as thick as they are.
fn has_four_sides(pieces: &Components, piece: &Component, [mask, strokes]: [&[u8]; 2], width: usize) -> bool {
    let ends = || {
        let runs = pieces.runs(piece).iter();
        runs.flat_map(|run| [[run.from, run.y], [run.to - 1, run.y]].map(|corner| corner.map(f64::from)))
    };
    // Within the strokes: their edges are ragged.
    let inset = BROKEN_PX as f64 + 1.0;
    let farthest = |x: f64, y: f64| {
        let along = |p: &[f64; 2]| p[0] * x + p[1] * y;
        let [u, v] = ends().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or_default();
        [(u - x * inset).max(0.0), (v - y * inset).max(0.0)]
    };
    let corners = [farthest(-1.0, -1.0), farthest(1.0, -1.0), farthest(1.0, 1.0), farthest(-1.0, 1.0)];
    let mut thicknesses = Vec::new();
    let has_all = (0..4).all(|k| {
        let [[x0, y0], [x1, y1]] = [corners[k], corners[(k + 1) % 4]];
        let [dx, dy] = [x1 - x0, y1 - y0];
        let length = dx.abs().max(dy.abs());
        let steps = (length as usize).max(1);
        let across = if dx.abs() > dy.abs() { width } else { 1 };
        let drawn = (0..=steps).filter(|&step| {
            let share = step as f64 / steps as f64;
            let [x, y] = [x0 + dx * share, y0 + dy * share].map(|px| px.round() as usize);
            let is_drawn = x < width && mask.get(y * width + x).is_some_and(|&on| on != 0);
            thicknesses.extend(is_drawn.then(|| thickness(strokes, y * width + x, across)));
            is_drawn
        });
        drawn.count() as f64 >= LEAST_DRAWN * (steps + 1) as f64 && dx.abs().min(dy.abs()) <= TILT * length
    });
    has_all && are_alike(&mut thicknesses)
}

/// Thickness of the stroke at a place, across it, pixels.
fn thickness(strokes: &[u8], at: usize, across: usize) -> usize {
    let is_on = |at: usize| is_on(strokes, at);
    let on = (1..).take_while(|k| is_on(at + k * across)).count();
    let back = (1..).take_while(|k| at.checked_sub(k * across).is_some_and(is_on)).count();
    on + back + 1
}

/// Whether nearly all thicknesses are about their median.
fn are_alike(thicknesses: &mut [usize]) -> bool {
    thicknesses.sort_unstable();
    let median = thicknesses[thicknesses.len() / 2] as f64;
    let off = (UNEVEN * median).max(UNEVEN_PX);
    let alike = thicknesses.iter().filter(|&&px| (px as f64 - median).abs() <= off).count();
    alike as f64 >= LEAST_ALIKE * thicknesses.len() as f64
}
