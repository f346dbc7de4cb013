//! Windows and doors as they are drawn.

use super::buildings::{Hole, Leaves, Wall};
use super::canvas::{Point, Polygon, arc, line, lines, outline, rectangle};
use super::styles::Doors;

pub fn window(wall: &Wall, hole: &Hole, thick: f64, thin: f64) -> Vec<Polygon> {
    let (from, to) = (hole.at, hole.at + hole.width);
    let across = (thick - thin) * 0.5;
    [-across, 0.0, across].map(|left| line(wall.place(from, left), wall.place(to, left), thin)).to_vec()
}

/// A sliding door: its bars, and its lines.
pub fn sliding(wall: &Wall, hole: &Hole, leaves: Leaves, thin: f64) -> (Vec<Polygon>, Vec<Polygon>) {
    // From where to where as shares of the width; how far off the wall's middle and how thick as shares of the wall.
    let part = |from: f64, to: f64, left: f64, thick: f64| {
        let corner = |share: f64, left: f64| wall.place(hole.at + share * hole.width, left * wall.thick);
        let (p, q) = (corner(from, left + thick * 0.5), corner(to, left - thick * 0.5));
        rectangle([p[0].min(q[0]), p[1].min(q[1])], [p[0].max(q[0]), p[1].max(q[1])])
    };
    let outlines = |shapes: &[Polygon]| shapes.iter().flat_map(|shape| outline(shape, thin)).collect();
    match leaves {
        Leaves::Bars => {
            let bars = vec![part(0.17, 0.497, 0.0, 0.6), part(0.503, 0.83, 0.0, 0.6)];
            (bars, outlines(&[part(0.0, 0.31, 0.0, 1.15), part(0.69, 1.0, 0.0, 1.15)]))
        }
        Leaves::Panes => {
            let fixed = [part(0.0, 0.27, 0.2, 0.2), part(0.73, 1.0, 0.2, 0.2)];
            let sliding = [part(0.24, 0.5, -0.2, 0.2), part(0.5, 0.76, -0.2, 0.2)];
            (Vec::new(), outlines(&[fixed, sliding].concat()))
        }
    }
}

pub fn door(wall: &Wall, hole: &Hole, hinge_first: bool, left: bool, doors: Doors, thin: f64) -> Vec<Polygon> {
    let (hinge, strike) = if hinge_first { (hole.at, hole.at + hole.width) } else { (hole.at + hole.width, hole.at) };
    let side = if left { 1.0 } else { -1.0 };
    match doors {
        Doors::Open => Vec::new(),
        Doors::ClosedLine => vec![line(wall.place(hinge, 0.0), wall.place(strike, 0.0), thin)],
        Doors::LeafAndSill => {
            let across = (wall.thick - thin) * 0.5;
            let sill = |left: f64| line(wall.place(hinge, left), wall.place(strike, left), thin);
            let mut all = door(wall, hole, hinge_first, left, Doors::LeafAndArc, thin);
            all.extend([sill(across), sill(-across)]);
            all
        }
        Doors::LeafAndArc => {
            let face = side * wall.thick * 0.5;
            let (centre, tip) = (wall.place(hinge, face), wall.place(hinge, face + side * hole.width));
            let end = wall.place(strike, face);
            let angle = |p: Point| (p[1] - centre[1]).atan2(p[0] - centre[0]);
            let (from, mut to) = (angle(tip), angle(end));
            let turn = std::f64::consts::TAU;
            if to - from > turn * 0.5 {
                to -= turn;
            } else if to - from < -turn * 0.5 {
                to += turn;
            }
            let mut all = lines(&arc(centre, hole.width, from, to), thin);
            all.push(line(centre, tip, thin * 1.5));
            all
        }
    }
}
