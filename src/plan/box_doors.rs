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
    // The dark run beyond the middle of a side, pixels, and the piece behind: of three places along it, the median.
    let beyond = |piece: &Component, axis: usize, is_after: bool| {
        let run = |along: usize| {
            let step = |k: usize| {
                let across = match is_after {
                    true => piece.end[axis] as usize + k,
                    false => (piece.min[axis] as usize).checked_sub(k + 1)?,
                };
                let [x, y] = if axis == 0 { [across, along] } else { [along, across] };
                (x < width && y < height).then(|| piece_at(y * width + x))
            };
            let far = (0..).find(|&k| step(k) != Some(None)).unwrap_or(0);
            (far, step(far).flatten().map(|k| &light.all[k]))
        };
        let [from, to] = [piece.min, piece.end].map(|corner| corner[1 - axis] as usize);
        let mut runs = [1, 2, 3].map(|k| run(from + (to - from) * k / 4));
        runs.sort_by_key(|(far, _)| *far);
        runs[1]
    };
    let door = |piece: &Component| {
        let lesser_side = piece.size().into_iter().min().map_or(0.0, f64::from);
        let thickest = THICKEST_PX.max((THICKEST * lesser_side) as usize);
        let sides = [0, 1].map(|axis| [false, true].map(|is_after| beyond(piece, axis, is_after)));
        let is_place = |behind: &Component| behind.area >= PLACES * piece.area && !behind.is_at_side(width, height);
        let is_face =
            |(far, behind): &(usize, Option<&Component>)| (1..=thickest).contains(far) && behind.is_some_and(is_place);
        // Of a door with two leaves there are two boxes side by side.
        let is_end = |(far, behind): &(usize, Option<&Component>)| {
            *far >= ENDS * thickest || *far <= thickest && behind.is_some_and(is_box)
        };
        let is_door = (0..2).any(|axis| sides[axis].iter().all(is_face) && sides[1 - axis].iter().all(is_end));
        // With the outlines, and without the rock at its ends.
        let outline = |axis: usize, side: usize| Some(sides[axis][side].0).filter(|far| *far <= thickest).unwrap_or(0);
        is_door.then(|| {
            [0, 1].map(|axis| piece.min[axis] as usize - outline(axis, 0)..piece.end[axis] as usize + outline(axis, 1))
        })
    };
    let opened: Vec<_> = light.all.iter().filter(|piece| is_box(piece)).filter_map(door).collect();
    if opened.len() < FEWEST {
        return;
    }
    for [columns, rows] in opened {
        for row in rows.map(|y| y * width) {
            drawing.dark[row + columns.start..row + columns.end].fill(0);
            drawing.lightness[row + columns.start..row + columns.end].fill(255);
        }
    }
}
