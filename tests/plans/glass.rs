//! Glass: a front of glass that is longer than windows are, a bay and a light beside a door.

use std::f64::consts::{FRAC_PI_2, PI};

use trodden::rooms::Rooms;
use trodden::walls::{Walls, WallsOptions};

use super::canvas::{Canvas, Point, arc, line, lines, outline, rectangle};

const INK: [u8; 3] = [0; 3];
const PAPER: [u8; 3] = [255; 3];
const FINE_M: f64 = 0.03;

/// A door of 0.9 m in a wall along the rows or columns: its hinge, the ways of the closed leaf and of the open one, and the wall's
/// thickness.
fn hang(canvas: &mut Canvas, (hinge, closed, open): (Point, f64, f64), thick: f64) {
    let [end, tip] = [closed, open].map(|way| [hinge[0] + way.cos() * 0.9, hinge[1] + way.sin() * 0.9]);
    let across = if closed.sin().abs() < 0.5 { [0.0, 1.0] } else { [1.0, 0.0] };
    let beside = |p: Point, by: f64| [p[0] + across[0] * by, p[1] + across[1] * by];
    let half = thick * 0.5;
    let corners = [beside(hinge, -half - 0.05), beside(end, half + 0.05)];
    let [min, max] = [f64::min, f64::max].map(|pick| [0, 1].map(|k| pick(corners[0][k], corners[1][k])));
    canvas.fill(&[rectangle(min, max)], PAPER);
    canvas.fill(&[hinge, end].map(|jamb| line(beside(jamb, -half), beside(jamb, half), FINE_M)), INK);
    canvas.fill(&lines(&arc(hinge, 0.9, closed, open), FINE_M), INK);
    canvas.fill(&[line(hinge, tip, 0.05)], INK);
}

/// Panes from place to place, `half` the thickness of the front: both faces and the glass between them, and a mullion each 1.5 m.
fn glaze(canvas: &mut Canvas, a: Point, b: Point, half: f64) {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length = (dx * dx + dy * dy).sqrt();
    let along = [dx / length, dy / length];
    let beside = |at: f64, by: f64| [a[0] + along[0] * at - along[1] * by, a[1] + along[1] * at + along[0] * by];
    for by in [-half, 0.0, half] {
        canvas.fill(&[line(beside(0.0, by), beside(length, by), FINE_M)], INK);
    }
    let count = (length / 1.5).round();
    for k in 0..=count as usize {
        let at = length * k as f64 / count;
        canvas.fill(&[line(beside(at, -half), beside(at, half), 0.08)], INK);
    }
}

fn count_rooms(plan: &trodden::plan::FloorPlan) -> usize {
    Rooms::find(plan, &Walls::trace(plan, &WallsOptions::default())).rooms.len()
}

/// An office with hollow walls, open to the north and the north-east but for a front of glass, 26 m and 10 m long; two rooms with
/// a door each, an entrance.
fn glazed_office(px_per_m: f64) -> Canvas {
    let mut canvas = Canvas::new([40.0, 24.0], [-3.0, -3.0], px_per_m, 0.0, PAPER);
    // The faces of the walls, and what lies between them.
    let walls: [[Point; 2]; 7] = [
        [[-0.15, -0.15], [0.15, 17.15]],
        [[-0.15, 16.85], [34.15, 17.15]],
        [[33.85, 6.0], [34.15, 17.15]],
        [[6.0, 11.0], [6.2, 17.0]],
        [[0.0, 11.0], [6.2, 11.2]],
        [[26.0, 11.0], [26.2, 17.0]],
        [[26.0, 11.0], [34.0, 11.2]],
    ];
    let rectangles = |by: f64| walls.map(|[min, max]| rectangle(min.map(|v| v - by), max.map(|v| v + by)));
    canvas.fill(&rectangles(FINE_M * 0.5), INK);
    canvas.fill(&rectangles(-FINE_M * 0.5), PAPER);
    hang(&mut canvas, ([3.0, 11.1], 0.0, -FRAC_PI_2), 0.2);
    hang(&mut canvas, ([29.0, 11.1], 0.0, -FRAC_PI_2), 0.2);
    hang(&mut canvas, ([15.0, 17.0], 0.0, -FRAC_PI_2), 0.3);
    glaze(&mut canvas, [0.15, 0.0], [26.0, 0.0], 0.15);
    glaze(&mut canvas, [26.0, 0.0], [34.0, 6.0], 0.15);
    for (x, y) in [10.0, 16.0, 22.0].into_iter().flat_map(|x| [(x, 3.0), (x, 8.0)]) {
        canvas.fill(&outline(&rectangle([x, y], [x + 3.2, y + 1.6]), FINE_M), INK);
        canvas.fill(&[line([x, y + 0.8], [x + 3.2, y + 0.8], FINE_M)], INK);
    }
    canvas
}

/// Buildings were open where their fronts are of glass, and one room with the paper around.
#[test]
fn long_fronts_of_glass_close_a_building() {
    for px_per_m in [45.0, 60.0] {
        let canvas = glazed_office(px_per_m);
        let plan = canvas.read(Some(1.0 / px_per_m));
        assert_eq!([plan.doors.len(), count_rooms(&plan)], [3, 3], "doors and rooms at {px_per_m} px/m");
        let glass: f64 = plan.windows.iter().map(|window| window.from_m.distance(window.to_m)).sum();
        assert!((33.0..38.0).contains(&glass), "36 m of glass: {glass} m at {px_per_m} px/m");
        let hall = canvas.floor_in(&plan, [[7.0, 0.5], [25.0, 2.6]]);
        let paper = canvas.floor_in(&plan, [[-2.0, -2.5], [36.0, -0.5]]);
        assert!(hall > 0.98 && paper < 0.01, "{hall} of the hall, {paper} of the paper at {px_per_m} px/m");
    }
}

/// Two floors of a house side by side: a bay and a light of 25 cm beside the front door below, stairs and no door to the outside above.
fn house() -> Canvas {
    let mut canvas = Canvas::new([24.0, 14.0], [-2.0, -3.0], 85.0, 0.0, PAPER);
    let mut wall = |min: Point, max: Point| canvas.fill(&[rectangle(min, max)], INK);
    for x in [0.0, 12.0] {
        wall([x, 0.0], [x + 7.0, 0.3]);
        wall([x, 8.7], [x + 7.0, 9.0]);
        wall([x, 0.0], [x + 0.3, 9.0]);
        wall([x + 6.7, 0.0], [x + 7.0, 9.0]);
        wall([x + 4.5, 0.0], [x + 4.6, 9.0]);
        wall([x, 4.5], [x + 4.6, 4.6]);
    }
    canvas.fill(&[rectangle([0.8, 8.6], [4.0, 9.1])], PAPER);
    // A bay with two posts: walls and posts end square to its windows.
    let mut stretch = |a: Point, b: Point, is_wall: bool| {
        if is_wall {
            return canvas.fill(&[line(a, b, 0.28)], INK);
        }
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length = (dx * dx + dy * dy).sqrt();
        for by in [-0.125, 0.0, 0.125] {
            let [a, b] = [a, b].map(|p| [p[0] - dy / length * by, p[1] + dx / length * by]);
            canvas.fill(&[line(a, b, FINE_M)], INK);
        }
    };
    let mirrored = |[x, y]: Point| [4.8 - x, y];
    let side = [[0.7, 8.8], [0.82, 8.96], [1.42, 9.76], [1.57, 9.96]];
    for side in [side, side.map(mirrored)] {
        stretch(side[0], side[1], true);
        stretch(side[1], side[2], false);
        stretch(side[2], side[3], true);
    }
    stretch([1.47, 9.9], [1.85, 9.9], true);
    stretch([1.85, 9.9], [2.95, 9.9], false);
    stretch([2.95, 9.9], [3.33, 9.9], true);
    for (hinge, closed, open) in [
        ([4.55, 3.6], -FRAC_PI_2, -PI),
        ([4.55, 7.6], -FRAC_PI_2, -PI),
        ([16.55, 3.6], -FRAC_PI_2, -PI),
        ([16.55, 7.6], -FRAC_PI_2, -PI),
    ] {
        hang(&mut canvas, (hinge, closed, open), 0.1);
    }
    hang(&mut canvas, ([5.0, 8.85], 0.0, -FRAC_PI_2), 0.3);
    canvas.window([6.15, 8.7], [6.4, 9.0], FINE_M);
    for (min, max) in [([1.5, 0.0], [3.0, 0.3]), ([13.5, 0.0], [15.0, 0.3]), ([13.5, 8.7], [15.0, 9.0])] {
        canvas.window(min, max, FINE_M);
    }
    for x in [5.8, 17.8] {
        for k in 0..=12 {
            let y = 1.0 + 0.26 * f64::from(k);
            canvas.fill(&[line([x, y], [x + 0.9, y], FINE_M)], INK);
        }
        canvas.fill(&[line([x, 1.0], [x, 4.12], FINE_M)], INK);
    }
    canvas
}

/// The hall behind the light was outside, the bay's opening a door; nobody came to upper floors.
#[test]
fn bays_lights_and_upper_floors_of_a_house() {
    let canvas = house();
    let plan = canvas.read(Some(1.0 / 85.0));
    let rooms = Rooms::find(&plan, &Walls::trace(&plan, &WallsOptions::default()));
    assert_eq!(rooms.rooms.len(), 6, "rooms: {:?}", rooms.rooms);
    let entrances: Vec<&str> = rooms.entrances.iter().map(|entrance| entrance.name.as_str()).collect();
    assert_eq!(entrances, ["door 1", "stairs 1"]);
    let above = canvas.px([18.2, 2.5]).map(|v| v / 85.0);
    let [x, y] =
        [rooms.entrances[1].at_m.x - above[0], canvas.height as f64 / 85.0 - rooms.entrances[1].at_m.y - above[1]];
    assert!(x.abs() < 0.6 && y.abs() < 1.0, "people come {x}, {y} m off the stairs");
    assert_eq!(plan.windows.len(), 7, "windows: {:?}", plan.windows);
    let bay = canvas.floor_in(&plan, [[1.7, 9.1], [3.1, 9.5]]);
    assert!(bay > 0.98, "{bay} of the bay is floor");
    for [min, max] in
        [[[0.5, 5.0], [3.4, 8.0]], [[4.8, 4.5], [6.5, 7.6]], [[12.5, 5.0], [15.4, 8.0]], [[16.8, 4.5], [18.5, 8.4]]]
    {
        let free = canvas.floor_in(&plan, [min, max]);
        assert!(free > 0.98, "{free} of the room at {min:?} is floor");
    }
}
