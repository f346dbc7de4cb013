//! What stands on a sheet besides a building: dimensions, axes, a north arrow, the title block, the frame, floor coverings.

use super::buildings::Building;
use super::canvas::{Point, Polygon, ellipse, line, outline, rectangle, text};
use super::styles::{Cover, Ends};

/// Dimension lines with what ends them, numbers and extension lines that touch the walls.
fn dimensions(building: &Building, ends: Ends, thin: f64) -> Vec<Polygon> {
    let [w, h] = building.size;
    let mut all = Vec::new();
    // What ends a line at a place; `way` points along the line, out of it.
    let mark = |[x, y]: Point, [dx, dy]: Point| match ends {
        Ends::Slanted => line([x - 0.12, y + 0.12], [x + 0.12, y - 0.12], thin * 1.5),
        Ends::Dots => ellipse([x, y], [0.07, 0.07]),
        _ => {
            let back = [x - dx * 0.25, y - dy * 0.25];
            vec![[x, y], [back[0] - dy * 0.05, back[1] + dx * 0.05], [back[0] + dy * 0.05, back[1] - dx * 0.05]]
        }
    };
    let mut measured = |from: Point, to: Point| {
        let length = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
        let way = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
        all.push(line(from, to, thin));
        all.push(mark(from, way.map(|v| -v)));
        all.push(mark(to, way));
    };
    // Outside: a chain and the whole.
    building.stations.windows(2).for_each(|pair| measured([pair[0], -1.2], [pair[1], -1.2]));
    measured([0.0, -2.0], [w, -2.0]);
    measured([-1.4, 0.0], [-1.4, h]);
    // A dimension inside the first room, from wall to wall.
    let [x0, y0, x1, y1] = building.rooms[0].parts[0];
    let is_free = |y: f64| building.furniture.iter().all(|piece| y < piece.min[1] - 0.1 || y > piece.max[1] + 0.1);
    let ways = [0.8, 0.76, 0.72, 0.68].map(|share| y0 + (y1 - y0) * share);
    let y = ways.into_iter().find(|&y| ends == Ends::Slanted || is_free(y)).unwrap_or(ways[0]);
    // Ticks keep clear of the walls.
    let [from, to] = if ends == Ends::Slanted { [x0 + 0.2, x1 - 0.1] } else { [x0, x1] };
    if ends == Ends::Slanted {
        all.push(line([x0, y], [x1, y], thin));
        all.extend([mark([from, y], [-1.0, 0.0]), mark([to, y], [1.0, 0.0])]);
    } else {
        measured([from, y], [to, y]);
    }
    all.extend(building.stations.iter().map(|&x| line([x, -1.4], [x, -0.1], thin)));
    all.extend([0.0, h].map(|y| line([-1.6, y], [-0.1, y], thin)));
    for pair in building.stations.windows(2) {
        all.extend(text(&format!("{:.2}", pair[1] - pair[0]), [(pair[0] + pair[1]) * 0.5, -1.42], 0.24, thin));
    }
    all.extend(text(&format!("{w:.2}"), [w * 0.5, -2.22], 0.24, thin));
    all.extend(text(&format!("{h:.2}"), [-2.1, h * 0.5], 0.24, thin));
    all.extend(text(&format!("{:.2}", to - from), [x0 + (x1 - x0) * 0.3, y - 0.22], 0.2, thin));
    all
}

/// Dimension lines, axes, north arrow, title block and frame.
pub fn sheet(building: &Building, ends: Ends, size: Point, origin: Point, thin: f64, has_edge: bool) -> Vec<Polygon> {
    let h = building.size[1];
    let mut all = if ends == Ends::None { Vec::new() } else { dimensions(building, ends, thin) };
    // Axes: dash and dot across the building, with a balloon.
    for (k, &x) in building.stations.iter().enumerate() {
        let mut y = -2.9;
        while y < h + 1.0 {
            all.push(line([x, y], [x, (y + 0.8).min(h + 1.0)], thin));
            all.push(line([x, y + 0.95], [x, y + 1.0], thin));
            y += 1.15;
        }
        all.extend(outline(&ellipse([x, -3.3], [0.4, 0.4]), thin));
        all.extend(text(&format!("{}", (b'A' + k as u8) as char), [x, -3.3], 0.32, thin));
    }
    // A north arrow.
    let [right, below] = [origin[0] + size[0], origin[1] + size[1]];
    let north = [right - 1.9, origin[1] + 2.3];
    all.extend(outline(&ellipse(north, [0.7, 0.7]), thin));
    all.push(vec![[north[0], north[1] - 0.7], [north[0] + 0.25, north[1] + 0.4], [north[0], north[1] + 0.15]]);
    all.extend(text("N", [north[0], north[1] - 1.05], 0.35, thin));
    // A scale bar of 5 m.
    for k in 0..5 {
        let x = origin[0] + 2.0 + f64::from(k);
        let bar = rectangle([x, below - 1.6], [x + 1.0, below - 1.45]);
        if k % 2 == 0 {
            all.push(bar);
        } else {
            all.extend(outline(&bar, thin));
        }
    }
    all.extend(text("0", [origin[0] + 2.0, below - 1.85], 0.24, thin));
    all.extend(text("5 m", [origin[0] + 7.0, below - 1.85], 0.24, thin));
    // The frame, the edge along which the sheet may be cut, and the title block.
    for (inset, thick) in [(0.5, thin * 3.0), (0.15, thin)].into_iter().take(if has_edge { 2 } else { 1 }) {
        let frame = rectangle([origin[0] + inset, origin[1] + inset], [right - inset, below - inset]);
        all.extend(outline(&frame, thick));
    }
    let (corner, end) = ([right - 7.5, below - 3.2], [right - 0.5, below - 0.5]);
    all.extend(outline(&rectangle(corner, end), thin * 2.0));
    all.push(line([corner[0], corner[1] + 0.9], [end[0], corner[1] + 0.9], thin));
    all.push(line([corner[0], corner[1] + 1.8], [end[0], corner[1] + 1.8], thin));
    all.push(line([corner[0] + 3.5, corner[1] + 0.9], [corner[0] + 3.5, end[1]], thin));
    all.extend(text("GROUND FLOOR", [corner[0] + 3.2, corner[1] + 0.45], 0.4, thin * 1.5));
    all.extend(text("1:100", [corner[0] + 1.6, corner[1] + 1.35], 0.28, thin));
    all.extend(text("12.03.2024", [corner[0] + 5.2, corner[1] + 1.35], 0.28, thin));
    all.extend(text("PLAN 7-B", [corner[0] + 1.6, corner[1] + 2.25], 0.28, thin));
    all
}

/// Lines of tiles or planks on a part of a floor. They are laid from a corner of the room; the first are half as wide.
pub fn joints(corner: [f64; 2], [x0, y0, x1, y1]: [f64; 4], cover: Cover, thin: f64) -> Vec<Polygon> {
    let [along, across] = if cover == Cover::Tiles { [0.33, 0.33] } else { [1.1, 0.14] };
    let steps =
        |from: f64, to: f64, by: f64| (0..).map(move |k| from + by * f64::from(k)).take_while(move |&at| at < to);
    let mut all = Vec::new();
    for (row, y) in steps(corner[1] - 0.5 * across, y1, across).enumerate() {
        let shift = if cover == Cover::Tiles { 0.5 * along } else { (0.41 * row as f64) % along };
        if y > y0 {
            all.push(line([x0, y], [x1, y], thin));
        }
        let ends = [y.max(y0), (y + across).min(y1)];
        let joints = steps(corner[0] + shift, x1, along).filter(|&x| x > x0 && ends[1] > ends[0]);
        all.extend(joints.map(|x| line([x, ends[0]], [x, ends[1]], thin)));
    }
    all
}
