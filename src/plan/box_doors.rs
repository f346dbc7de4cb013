//! Doors as maps of dungeons have them: small boxes across a passage, in a mass of rock or in a wall between two rooms.

use super::components::{Component, Components, Neighbours};
use super::drawing::Drawing;

/// Least and greatest side of a box, pixels and as a share of the image's longer side.
const LEAST_PX: u32 = 4;
const GREATEST_SIDE: f64 = 0.06;
/// Least share of its bounds that a box fills.
const FILLED: f64 = 0.9;
/// Greatest thickness of a box's outline, pixels, and as a share of its lesser side.
const THICKEST_PX: usize = 3;
const THICKEST: f64 = 0.25;
/// How many times as thick what lies beyond the ends of a door is at least, and how many times as large each place beyond
/// its faces.
const ENDS: usize = 2;
const PLACES: usize = 4;
/// Fewest doors of a map that has such.
const FEWEST: usize = 2;

/// Clears the boxes, so that the rooms behind them can be reached. Boxes that lead outside stay: in thick walls they are
/// windows.
pub(super) fn open(drawing: &mut Drawing) {
    let (width, height) = (drawing.width, drawing.height);
    let light = Components::of(&drawing.dark, width, 0, Neighbours::Four);
    let piece_at = light.index(width);
    let greatest = GREATEST_SIDE * width.max(height) as f64;
    let is_box = |piece: &Component| {
        let [w, h] = piece.size();
        w.min(h) >= LEAST_PX
            && f64::from(w.max(h)) <= greatest
            && piece.area as f64 >= FILLED * f64::from(w) * f64::from(h)
    };
    let is_outside =
        |piece: &Component| piece.min.contains(&0) || piece.end[0] as usize == width || piece.end[1] as usize == height;
    let mut opened: Vec<[[usize; 2]; 2]> = Vec::new();
    for piece in light.all.iter().filter(|piece| is_box(piece)) {
        let thickest = THICKEST_PX.max((THICKEST * f64::from(piece.size()[0].min(piece.size()[1]))) as usize);
        // The dark run beyond a side at a place along it, and the piece behind.
        let beyond = |axis: usize, is_after: bool, along: usize| {
            let step = |k: usize| {
                let across = match is_after {
                    true => piece.end[axis] as usize + k,
                    false => (piece.min[axis] as usize).checked_sub(k + 1)?,
                };
                let [x, y] = if axis == 0 { [across, along] } else { [along, across] };
                (x < width && y < height).then(|| piece_at(y * width + x))
            };
            let mut far = 0;
            while let Some(None) = step(far) {
                far += 1;
            }
            (far, step(far).flatten().map(|k| &light.all[k]))
        };
        let sampled = |axis: usize, is_after: bool| {
            let (from, to) = (piece.min[1 - axis] as usize, piece.end[1 - axis] as usize);
            let mut found: Vec<_> = [1, 2, 3].map(|k| beyond(axis, is_after, from + (to - from) * k / 4)).into();
            found.sort_by_key(|(far, _)| *far);
            found[1]
        };
        for axis in 0..2 {
            let faces = [sampled(axis, false), sampled(axis, true)];
            let is_face = |(far, behind): &(usize, Option<&Component>)| {
                (1..=thickest).contains(far)
                    && behind.is_some_and(|behind| behind.area >= PLACES * piece.area && !is_outside(behind))
            };
            let ends = [sampled(1 - axis, false), sampled(1 - axis, true)];
            // Of a door with two leaves there are two boxes side by side.
            let is_end = |(far, behind): &(usize, Option<&Component>)| {
                *far >= ENDS * thickest || behind.is_some_and(|behind| is_box(behind) && *far <= thickest)
            };
            if faces.iter().all(is_face) && ends.iter().all(is_end) {
                let mut area = [piece.min, piece.end].map(|corner| corner.map(|v| v as usize));
                area[0][axis] -= faces[0].0;
                area[1][axis] += faces[1].0;
                for (side, end) in ends.iter().enumerate().filter(|(_, end)| end.0 <= thickest) {
                    match side {
                        0 => area[0][1 - axis] -= end.0,
                        _ => area[1][1 - axis] += end.0,
                    }
                }
                opened.push(area);
                break;
            }
        }
    }
    if opened.len() < FEWEST {
        return;
    }
    for [[x0, y0], [x1, y1]] in opened {
        for y in y0..y1 {
            drawing.dark[y * width + x0..y * width + x1].fill(0);
            drawing.lightness[y * width + x0..y * width + x1].fill(255);
        }
    }
}
