//! Outer walls that are drawn as outlines, by hatches or with a grey fill, and black partitions between them.

use std::f64::consts::PI;

use trodden::rooms::Rooms;
use trodden::walls::{Walls, WallsOptions};

use super::canvas::{Canvas, Point, Polygon, arc, line, lines, outline, rectangle};

const PX_PER_M: f64 = 48.0;
const STROKE_M: f64 = 0.04;
/// Thickness of outer walls and of partitions.
const OUTER_M: f64 = 0.3;
const PARTITION_M: f64 = 0.12;
const SIZE_M: Point = [12.0, 8.0];

#[derive(Clone, Copy, Debug)]
enum Fill {
    None,
    Hatch,
    Grey,
}

/// A wall from place to place.
fn wall([a, b]: [Point; 2], thick: f64) -> Polygon {
    let half = thick * 0.5;
    rectangle(a.map(|v| v - half), b.map(|v| v + half))
}

/// The four sides of a building, from place to place.
fn sides([w, h]: Point) -> [[Point; 2]; 4] {
    [[[0.0, 0.0], [w, 0.0]], [[0.0, h], [w, h]], [[0.0, 0.0], [0.0, h]], [[w, 0.0], [w, h]]]
}

/// A door with its leaf: its hinge, the ways of the closed leaf and of the open one, the thickness of the wall.
fn hang(canvas: &mut Canvas, (hinge, closed, open, thick): (Point, f64, f64, f64)) {
    let (white, black) = ([255; 3], [0; 3]);
    let [end, tip] = [closed, open].map(|way| [hinge[0] + way.cos() * 0.9, hinge[1] + way.sin() * 0.9]);
    let beside = |p: Point, by: f64| if closed == 0.0 { [p[0], p[1] + by] } else { [p[0] + by, p[1]] };
    let half = thick * 0.5;
    canvas.fill(&[rectangle(beside(hinge, -half - 0.05), beside(end, half + 0.05))], white);
    canvas.fill(&[hinge, end].map(|jamb| line(beside(jamb, -half), beside(jamb, half), STROKE_M)), black);
    let swing = arc(hinge, 0.9, closed, open);
    canvas.fill(&lines(&swing, 0.03), black);
    canvas.fill(&[line(hinge, tip, 0.06)], black);
}

/// Six rooms of 4 x 4 m, two rows of three, with a door between each two that lie side by side, one between the rows and one
/// to the outside; windows to the north and the south, a bed and counters close before some of them.
fn six_rooms(fill: Fill) -> Canvas {
    let (white, black) = ([255; 3], [0; 3]);
    let mut canvas = Canvas::new([SIZE_M[0] + 4.0, SIZE_M[1] + 4.0], [-2.0, -2.0], PX_PER_M, 0.0, white);
    let [w, h] = SIZE_M;
    let sides = sides(SIZE_M);
    canvas.fill(&sides.map(|side| wall(side, OUTER_M)), black);
    let within = canvas.samples(&sides.map(|side| wall(side, OUTER_M - 2.0 * STROKE_M)));
    canvas.paint(&within, if matches!(fill, Fill::Grey) { [153; 3] } else { white });
    if matches!(fill, Fill::Hatch) {
        let hatch: Vec<Polygon> = (0..200)
            .map(|k| {
                let x = f64::from(k) * 0.12 - 1.0;
                line([x, -1.0], [x - h - 2.0, h + 1.0], 0.025)
            })
            .collect();
        let hatch = canvas.samples(&hatch);
        canvas.paint(&within.iter().zip(&hatch).map(|(a, b)| a & b).collect(), black);
    }
    let partitions = [[[4.0, 0.0], [4.0, h]], [[8.0, 0.0], [8.0, h]], [[0.0, 4.0], [w, 4.0]]];
    canvas.fill(&partitions.map(|partition| wall(partition, PARTITION_M)), black);
    let doors = [
        ([4.0, 2.4], PI * 0.5, PI, PARTITION_M),
        ([8.0, 2.4], PI * 0.5, 0.0, PARTITION_M),
        ([4.0, 5.6], PI * 0.5, PI, PARTITION_M),
        ([8.0, 5.6], PI * 0.5, 0.0, PARTITION_M),
        ([6.5, 4.0], 0.0, PI * 0.5, PARTITION_M),
        ([5.5, 0.0], 0.0, PI * 0.5, OUTER_M),
    ];
    doors.into_iter().for_each(|door| hang(&mut canvas, door));
    for (x, y) in [(1.0, 0.0), (9.2, 0.0), (1.0, h), (5.2, h), (9.2, h)] {
        canvas.window([x, y - OUTER_M * 0.5], [x + 1.8, y + OUTER_M * 0.5], STROKE_M);
    }
    for (min, max) in [([0.8, 5.9], [2.6, 7.84]), ([4.6, 7.2], [6.8, 7.83]), ([9.6, 0.17], [11.8, 0.8])] {
        canvas.fill(&outline(&rectangle(min, max), STROKE_M), black);
    }
    canvas
}

/// Hatched walls with black partitions left a quarter of the building, with 25 doors of 19; hollow ones gave a scale three
/// times the true one; grey ones had neither doors nor windows.
#[test]
fn outer_walls_may_be_drawn_otherwise_than_partitions() {
    for fill in [Fill::None, Fill::Hatch, Fill::Grey] {
        let canvas = six_rooms(fill);
        let plan = canvas.read(None);
        let scale = plan.metres_per_pixel * PX_PER_M;
        assert!((0.88..1.12).contains(&scale), "{fill:?}: the scale is {scale} times the true one");
        assert_eq!([plan.doors.len(), plan.windows.len()], [6, 5], "{fill:?}: doors and windows");
        for (x, y) in [(0.0, 0.0), (4.0, 0.0), (8.0, 0.0), (0.0, 4.0), (4.0, 4.0), (8.0, 4.0)] {
            let free = canvas.floor_in(&plan, [[x + 0.3, y + 1.0], [x + 3.7, y + 1.7]]);
            assert!(free > 0.97, "{fill:?}: {free} of the room at {x}, {y} is floor");
        }
        let wall = canvas.floor_in(&plan, [[-0.05, -0.05], [0.05, 8.05]]);
        assert!(wall < 0.02, "{fill:?}: {wall} of the western wall is floor");
    }
}

/// A hollow corner between a window and a door, with arms of 1.1 m, was none, and the room there was outside; a counter with a
/// sink along a hollow wall was wall.
#[test]
fn short_hollow_corners_are_walls_and_counters_are_none() {
    let canvas = behind_glass(true);
    let plan = canvas.read(Some(1.0 / PX_PER_M));
    assert!(canvas.floor_in(&plan, [[0.4, 2.8], [3.6, 4.6]]) > 0.97, "the room at the corner");
    let corners = [[[-0.05, 4.2], [0.05, 4.9]], [[0.1, 4.95], [0.8, 5.05]]];
    assert!(corners.into_iter().all(|arm| canvas.floor_in(&plan, arm) < 0.02), "the corner is floor");
    assert!(plan.furniture.iter().any(|piece| (1.7..2.3).contains(&piece.area_m2)), "{:?}", plan.furniture);
}

/// Two rooms behind glass lay open, because more doors are in thick walls.
#[test]
fn few_glass_doors_divide_rooms() {
    let plan = behind_glass(false).read(Some(1.0 / PX_PER_M));
    assert_eq!([plan.doors.len(), plan.windows.len()], [5, 5], "doors and windows");
    let rooms = Rooms::find(&plan, &Walls::trace(&plan, &WallsOptions::default()));
    assert_eq!(rooms.rooms.len(), 4, "{:?}", rooms.rooms);
}

/// A room with an entrance beside a corner, a second one with a counter, and two behind glass.
fn behind_glass(is_hollow: bool) -> Canvas {
    let (white, black, blue) = ([255; 3], [0; 3], [91, 141, 184]);
    let mut canvas = Canvas::new([16.0, 9.0], [-2.0, -2.0], PX_PER_M, 0.0, white);
    let [w, h] = [12.0, 5.0];
    let walls = sides([w, h]);
    let partition = [[4.0, 0.0], [4.0, h]];
    for (grown, colour) in [(0.0, black), (-2.0 * STROKE_M, if is_hollow { white } else { black })] {
        canvas.fill(&walls.map(|side| wall(side, OUTER_M + grown)), colour);
        canvas.fill(&[wall(partition, PARTITION_M + grown)], colour);
    }
    hang(&mut canvas, ([0.0, 4.0], -PI * 0.5, 0.0, OUTER_M));
    hang(&mut canvas, ([4.0, 2.8], PI * 0.5, PI, PARTITION_M));
    hang(&mut canvas, ([4.0, 0.6], PI * 0.5, PI, PARTITION_M));
    for (x, y) in [(1.0, h), (5.0, h), (1.0, 0.0), (4.6, 0.0), (6.4, 0.0)] {
        canvas.window([x, y - OUTER_M * 0.5], [x + 1.2, y + OUTER_M * 0.5], STROKE_M);
    }
    let counter = [[4.3, 4.2], [7.7, 4.8]];
    canvas.fill(&outline(&rectangle(counter[0], counter[1]), STROKE_M), black);
    canvas.fill(&outline(&rectangle([5.6, 4.3], [6.3, 4.7]), STROKE_M), black);
    // Glass from the partition to the eastern wall, and between the rooms behind it.
    let glass = |a: Point, b: Point, [x, y]: Point| {
        [-1.0, 1.0].map(|by| line([a[0] + x * by, a[1] + y * by], [b[0] + x * by, b[1] + y * by], 0.03))
    };
    for [from, to] in [[4.06, 4.7], [5.6, 9.0], [9.9, 11.85]] {
        canvas.fill(&glass([from, 2.6], [to, 2.6], [0.0, 0.055]), blue);
    }
    canvas.fill(&glass([8.0, 0.15], [8.0, 2.6], [0.055, 0.0]), blue);
    for x in [4.7, 9.0] {
        canvas.fill(&[line([x, 2.6], [x, 3.5], 0.04)], black);
        canvas.fill(&lines(&arc([x, 2.6], 0.9, 0.0, PI * 0.5), 0.03), black);
    }
    canvas
}
