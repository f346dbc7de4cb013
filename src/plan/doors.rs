//! Removes doors from a drawing, so that the rooms behind them can be reached.
//!
//! A door symbol is a quarter circle of a thin stroke round the hinge, with the leaf as a straight stroke from the
//! hinge to one end of it. The arc, the leaf and the line of the threshold are removed.

use super::arcs::{Arc, Search};
use super::clearance::opened;
use super::components::{Components, Neighbours, Run};
use super::cracks::trace;
use super::drawing::Drawing;
use crate::math::{atan2, sin_cos};

/// Range of the width of a door leaf, metres.
const NARROWEST_LEAF_M: f64 = 0.45;
const WIDEST_LEAF_M: f64 = 1.7;
/// Greatest thickness of the strokes of a door symbol, metres or pixels, whichever is more.
const THICKEST_STROKE_M: f64 = 0.07;
const THICKEST_STROKE_PX: f64 = 2.5;
/// Least share of an arc that is a thin stroke.
const STROKE_SHARE: f64 = 0.65;
/// Greatest distance from an arc's centre to the wall at the hinge, metres or pixels.
const HINGE_REACH_M: f64 = 0.15;
const HINGE_REACH_PX: f64 = 4.5;

/// Least share of the dark pixels thicker than a stroke, for walls that are drawn thick.
const THICK_WALLS: f64 = 0.7;
/// Least breadth of a bent stroke, as a share of its length and in pixels.
const BENT: f64 = 0.12;
const LEAST_BENT_PX: f64 = 2.0;

pub(super) fn drop_doors(drawing: &mut Drawing, metres_per_pixel: f64) {
    let sizes = Sizes::new(metres_per_pixel);
    let mut doors: Vec<Arc> = Vec::new();
    {
        let white: Vec<u8> = drawing.dark.iter().map(|&d| 1 - d).collect();
        for boundary in trace(&white, drawing.width) {
            sizes.search.find(&boundary, &mut doors);
        }
    }
    doors.retain(|arc| is_door(drawing, arc, &sizes));
    // Walls are thicker than strokes; they stay.
    let radius = (sizes.stroke + 1.0) * 0.5;
    let thick = opened(&drawing.dark, drawing.width, radius);
    let found: Vec<usize> = doors.iter().flat_map(|arc| strokes(drawing, arc, &sizes, &thick)).collect();
    for at in found {
        drawing.dark[at] = 0;
        drawing.lightness[at] = 255;
    }
    drop_bent_strokes(drawing, &sizes, &thick);
}

/// Removes bent thin strokes of the size of a door, where walls are drawn thick.
///
/// In small drawings the arcs of doors are a few pixels of any shape.
fn drop_bent_strokes(drawing: &mut Drawing, sizes: &Sizes, thick: &[u8]) {
    let thin: Vec<u8> = drawing.dark.iter().zip(thick).map(|(&d, &t)| d & (1 - t)).collect();
    let (dark, thin_count) = [&drawing.dark, &thin].map(|m| m.iter().filter(|&&d| d != 0).count()).into();
    if thin_count as f64 > (1.0 - THICK_WALLS) * dark as f64 {
        return;
    }
    let pieces = Components::of(&thin, drawing.width, 1, Neighbours::Eight);
    for piece in &pieces.all {
        let side = f64::from(piece.larger_side());
        if side >= sizes.search.radii[0] * 0.5
            && side <= sizes.search.radii[1]
            && bend(pieces.runs(piece)) >= (BENT * side).max(LEAST_BENT_PX)
        {
            pieces.paint(piece, &mut drawing.dark, drawing.width, 0);
            pieces.paint(piece, &mut drawing.lightness, drawing.width, 255);
        }
    }
}

/// Computes the breadth of a component across its main axis, pixels.
pub(super) fn bend(runs: &[Run]) -> f64 {
    let mut moments = [0.0; 6];
    let pixels = || runs.iter().flat_map(|r| (r.from..r.to).map(|x| [f64::from(x), f64::from(r.y)]));
    for [x, y] in pixels() {
        for (sum, add) in moments.iter_mut().zip([1.0, x, y, x * x, x * y, y * y]) {
            *sum += add;
        }
    }
    let [n, x, y, xx, xy, yy] = moments;
    let angle = 0.5 * atan2(2.0 * (xy - x * y / n), (xx - x * x / n) - (yy - y * y / n));
    let (sine, cosine) = sin_cos(angle);
    let across = |[x, y]: [f64; 2]| y * cosine - x * sine;
    let low = pixels().map(across).fold(f64::INFINITY, f64::min);
    let high = pixels().map(across).fold(f64::NEG_INFINITY, f64::max);
    high - low
}

/// The limits above, in pixels.
struct Sizes {
    search: Search,
    stroke: f64,
    hinge: f64,
}

impl Sizes {
    fn new(metres_per_pixel: f64) -> Sizes {
        Sizes {
            search: Search {
                radii: [NARROWEST_LEAF_M / metres_per_pixel, WIDEST_LEAF_M / metres_per_pixel],
                step: ((0.04 / metres_per_pixel) as usize).max(2),
            },
            stroke: (THICKEST_STROKE_M / metres_per_pixel).max(THICKEST_STROKE_PX),
            hinge: (HINGE_REACH_M / metres_per_pixel).max(HINGE_REACH_PX),
        }
    }
}

/// Whether an arc is a thin stroke with its centre at a wall.
fn is_door(drawing: &Drawing, arc: &Arc, sizes: &Sizes) -> bool {
    const PLACES: usize = 12;
    let is_stroke = |angle: f64| {
        // Dark along the radius near the arc: the stroke may lie on either side of its boundary.
        let reach = sizes.stroke * 1.5;
        let steps = (reach * 4.0) as i32;
        let dark =
            (-steps..=steps).filter(|&k| is_dark(drawing, arc.place(arc.radius + f64::from(k) * 0.5, angle))).count();
        (1..=(sizes.stroke * 2.0) as usize + 1).contains(&dark)
    };
    let share = |from: f64, to: f64| {
        let angles = (0..PLACES).map(|k| from + (to - from) * (k as f64 + 0.5) / PLACES as f64);
        angles.filter(|&a| is_stroke(a)).count() as f64 / PLACES as f64
    };
    let hinge = sizes.hinge as i32;
    let near_wall = (-hinge..=hinge).any(|dy| {
        (-hinge..=hinge).any(|dx| is_dark(drawing, [arc.centre[0] + f64::from(dx), arc.centre[1] + f64::from(dy)]))
    });
    near_wall && share(arc.from, arc.to) >= STROKE_SHARE
}

fn is_dark(drawing: &Drawing, [x, y]: [f64; 2]) -> bool {
    let within = x >= 0.0 && y >= 0.0 && x < drawing.width as f64 && y < drawing.height as f64;
    within && drawing.dark[y as usize * drawing.width + x as usize] != 0
}

/// A stroke from the hinge to an end of the arc: the leaf, or the threshold.
#[derive(Clone, Copy, Debug)]
struct Radius {
    /// Unit vector away from the hinge.
    along: [f64; 2],
    /// Distance at which it passes the arc's centre, which is not exactly the hinge, pixels.
    beside: f64,
}

impl Radius {
    fn new(angle: f64, beside: f64) -> Radius {
        let (sine, cosine) = sin_cos(angle);
        Radius { along: [cosine, sine], beside }
    }

    /// Distance of a point relative to the arc's centre, pixels; infinite behind the hinge.
    fn distance(&self, [dx, dy]: [f64; 2]) -> f64 {
        let [c, s] = self.along;
        if dx * c + dy * s > 0.0 { (dy * c - dx * s - self.beside).abs() } else { f64::INFINITY }
    }

    fn place(&self, centre: [f64; 2], way: f64) -> [f64; 2] {
        let [c, s] = self.along;
        [centre[0] + way * c - self.beside * s, centre[1] + way * s + self.beside * c]
    }
}

/// Finds the darkest stroke from the hinge to about an end of the arc.
fn stroke_from_hinge(drawing: &Drawing, arc: &Arc, end: f64, sizes: &Sizes) -> Option<Radius> {
    const TURNS: i32 = 12;
    let reach = arc.missing();
    let (from, to) = (0.15 * arc.radius, 0.9 * arc.radius);
    let steps = (to - from).ceil() as usize;
    let darkness = |radius: &Radius| {
        let way = |k: usize| from + (to - from) * (k as f64 + 0.5) / steps as f64;
        (0..steps).filter(|&k| is_dark(drawing, radius.place(arc.centre, way(k)))).count()
    };
    let mut best = (0, Radius::new(end, 0.0));
    for turn in -TURNS..=TURNS {
        for beside in -4..=4 {
            let angle = end + reach * f64::from(turn) / f64::from(TURNS);
            let radius = Radius::new(angle, sizes.hinge * 0.25 * f64::from(beside));
            let dark = darkness(&radius);
            if dark > best.0 {
                best = (dark, radius);
            }
        }
    }
    (best.0 * 5 >= steps * 3).then_some(best.1)
}

/// Lists the pixels of the arc's stroke and of the strokes from the hinge to its ends.
fn strokes(drawing: &Drawing, arc: &Arc, sizes: &Sizes, thick: &[u8]) -> Vec<usize> {
    let radii: Vec<Radius> =
        [arc.from, arc.to].iter().filter_map(|&end| stroke_from_hinge(drawing, arc, end, sizes)).collect();
    let margin = arc.radius + 2.0 * sizes.stroke;
    let rows = (arc.centre[1] - margin).max(0.0) as usize..(arc.centre[1] + margin).max(0.0) as usize;
    let columns = (arc.centre[0] - margin).max(0.0) as usize..(arc.centre[0] + margin).max(0.0) as usize;
    let mut found = Vec::new();
    for y in rows.start..rows.end.min(drawing.height) {
        for x in columns.start..columns.end.min(drawing.width) {
            let at = y * drawing.width + x;
            let [dx, dy] = [x as f64 + 0.5 - arc.centre[0], y as f64 + 0.5 - arc.centre[1]];
            let distance = (dx * dx + dy * dy).sqrt();
            let on_arc = (distance - arc.radius).abs() <= sizes.stroke * 1.2 + 0.5 && arc.spans(atan2(dy, dx));
            let on_radius = distance <= arc.radius + sizes.stroke
                && radii.iter().any(|r| r.distance([dx, dy]) <= sizes.stroke * 0.6 + 0.5);
            if thick[at] == 0 && (on_arc || on_radius) {
                found.push(at);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Draws walls 4 pixels thick with a doorway of 18 pixels (0.05 m each) and a door symbol.
    fn drawing(width: f64, leaf: bool) -> Drawing {
        let (w, h) = (80usize, 60usize);
        let mut dark = vec![0u8; w * h];
        for y in 0..h {
            for x in 0..w {
                let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
                let wall = (28.0..32.0).contains(&py) && !(30.0..48.0).contains(&px);
                let (dx, dy) = (px - 30.0, py - 32.0);
                let arc = ((dx * dx + dy * dy).sqrt() - 18.0).abs() <= width / 2.0 && dx >= 0.0 && dy >= 0.0;
                let leaf = leaf && (0.0..width).contains(&dx) && (0.0..18.0).contains(&dy);
                dark[y * w + x] = u8::from(wall || arc || leaf);
            }
        }
        let lightness = dark.iter().map(|&d| (1 - d) * 255).collect();
        Drawing::of(w, lightness, dark)
    }

    #[test]
    fn a_door_is_dropped_with_its_leaf_and_the_wall_stays() {
        for leaf in [false, true] {
            let mut d = drawing(1.5, leaf);
            drop_doors(&mut d, 0.05);
            let left: Vec<usize> = (0..d.dark.len()).filter(|&at| d.dark[at] != 0).collect();
            assert!(left.iter().all(|at| (28..32).contains(&(at / 80))), "leaf {leaf}: {left:?}");
            assert_eq!(left.len(), 4 * (80 - 18), "leaf {leaf}");
        }
    }

    #[test]
    fn a_curved_wall_and_a_round_column_stay() {
        let mut thick = drawing(5.0, false);
        let before = thick.dark.clone();
        drop_doors(&mut thick, 0.05);
        assert_eq!(thick.dark, before);
        let mut column = drawing(1.5, false);
        for (at, dark) in column.dark.iter_mut().enumerate() {
            let (dx, dy) = ((at % 80) as f64 - 39.5, (at / 80) as f64 - 29.5);
            *dark = u8::from(((dx * dx + dy * dy).sqrt() - 16.0).abs() <= 0.8);
        }
        let before = column.dark.clone();
        drop_doors(&mut column, 0.05);
        assert_eq!(column.dark, before);
    }
}
