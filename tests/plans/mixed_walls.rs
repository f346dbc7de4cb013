//! Outer walls that are drawn as outlines, by hatches or with a grey fill, and black partitions between them.

use std::f64::consts::PI;

use trodden::plan::PlanClass;
use trodden::rooms::Rooms;
use trodden::walls::{Walls, WallsOptions};

use super::canvas::{Canvas, Point, Polygon, arc, ellipse, line, lines, outline, rectangle};

pub const PX_PER_M: f64 = 48.0;
const STROKE_M: f64 = 0.04;
/// Thickness of outer walls and of partitions.
pub const OUTER_M: f64 = 0.3;
pub const PARTITION_M: f64 = 0.12;
pub const SIZE_M: Point = [12.0, 8.0];

#[derive(Clone, Copy, Debug)]
pub enum Fill {
    None,
    /// Lines so many metres apart along a wall.
    Hatch(f64),
    Grey,
}

/// A wall from place to place.
pub fn wall([a, b]: [Point; 2], thick: f64) -> Polygon {
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
pub fn six_rooms(fill: Fill) -> Canvas {
    let (white, black) = ([255; 3], [0; 3]);
    let mut canvas = Canvas::new([SIZE_M[0] + 4.0, SIZE_M[1] + 4.0], [-2.0, -2.0], PX_PER_M, 0.0, white);
    let [w, h] = SIZE_M;
    let sides = sides(SIZE_M);
    canvas.fill(&sides.map(|side| wall(side, OUTER_M)), black);
    let within = canvas.samples(&sides.map(|side| wall(side, OUTER_M - 2.0 * STROKE_M)));
    canvas.paint(&within, if matches!(fill, Fill::Grey) { [153; 3] } else { white });
    if let Fill::Hatch(apart) = fill {
        let hatch: Vec<Polygon> = (0..200)
            .map(|k| {
                let x = f64::from(k) * apart - 1.0;
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
    for fill in [Fill::None, Fill::Hatch(0.12), Fill::Grey] {
        check_six_rooms(fill, None);
    }
}

/// Lines of a hatch that are 26 cm apart and more were none: doors and windows were missed.
#[test]
fn walls_with_a_wide_hatch_are_walls() {
    for apart in [0.26, 0.32] {
        check_six_rooms(Fill::Hatch(apart), Some(1.0 / PX_PER_M));
    }
}

/// Checks that six rooms are read, with all doors and windows.
fn check_six_rooms(fill: Fill, metres_per_pixel: Option<f64>) {
    let canvas = six_rooms(fill);
    let plan = canvas.read(metres_per_pixel);
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

/// A hall with three offices in a corner: its walls are hatched, theirs hollow; all outlines are three pixels thick, desks and
/// leaves are fine.
fn offices_in_a_hall() -> Canvas {
    let (white, black) = ([255; 3], [0; 3]);
    let (px_per_m, thick, outline_m) = (42.0, 0.3, 0.075);
    let size = [24.0, 16.0];
    let mut canvas = Canvas::new([size[0] + 4.0, size[1] + 4.0], [-2.0, -2.0], px_per_m, 0.0, white);
    let partitions = [
        [[12.0, 6.0], [24.0, 6.0]],
        [[12.0, 0.0], [12.0, 6.0]],
        [[16.0, 0.0], [16.0, 6.0]],
        [[20.0, 0.0], [20.0, 6.0]],
    ];
    canvas.fill(&partitions.map(|ends| wall(ends, thick)), black);
    canvas.fill(&partitions.map(|ends| wall(ends, thick - 2.0 * outline_m)), white);
    let sides = sides(size);
    canvas.fill(&sides.map(|side| wall(side, OUTER_M)), black);
    let within = canvas.samples(&sides.map(|side| wall(side, OUTER_M - 2.0 * outline_m)));
    canvas.paint(&within, white);
    let hatch: Vec<Polygon> =
        (0..700).map(|k| f64::from(k) * 0.09 - 1.0).map(|x| line([x, -1.0], [x - 18.0, 17.0], 0.024)).collect();
    let hatch = canvas.samples(&hatch);
    canvas.paint(&within.iter().zip(&hatch).map(|(a, b)| a & b).collect(), black);
    for x in [12.0, 16.0, 20.0] {
        hang(&mut canvas, ([x + 1.5, 6.0], 0.0, PI * 0.5, thick));
        canvas.fill(&outline(&rectangle([x + 0.8, 1.2], [x + 2.4, 2.0]), 0.024), black);
    }
    hang(&mut canvas, ([4.0, 0.0], 0.0, PI * 0.5, OUTER_M));
    canvas
}

/// Outlines as thick as thin walls were the walls: a door between them was lost.
#[test]
fn outlines_as_thick_as_thin_walls_are_filled() {
    let canvas = offices_in_a_hall();
    let plan = canvas.read(Some(1.0 / 42.0));
    assert_eq!(plan.doors.len(), 4, "doors");
    for x in [12.0, 16.0, 20.0] {
        let free = canvas.floor_in(&plan, [[x + 0.4, 2.5], [x + 3.6, 5.6]]);
        assert!(free > 0.97, "{free} of the office at {x} is floor");
        let wall = canvas.floor_in(&plan, [[x - 0.04, 0.5], [x + 0.04, 5.5]]);
        assert!(wall < 0.02, "{wall} of the wall at {x} is floor");
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

/// Corners of desks of 3.2 x 1.6 m in the hall of the office below.
const DESKS: [(f64, f64); 8] =
    [(1.0, 6.0), (1.0, 9.0), (16.0, 6.0), (16.0, 9.0), (6.0, 11.0), (12.0, 11.0), (7.0, 1.6), (13.0, 1.6)];

/// An office whose outer walls are mostly window, with rooms behind glass in two corners and a core of lifts in the middle: the
/// ring of its outer walls was taken for the frame of the sheet, and nothing was left.
fn office_around_a_core() -> Canvas {
    let (white, black, glass) = ([255; 3], [70; 3], [60, 110, 120]);
    let [w, h] = [24.0, 14.0];
    let mut canvas = Canvas::new([w + 6.0, h + 6.0], [-3.0, -3.0], PX_PER_M, 0.0, white);
    canvas.fill(&sides([w, h]).map(|side| wall(side, OUTER_M)), black);
    let half = OUTER_M * 0.5;
    for x in [0.8, 5.0, 9.2, 13.4, 17.6, 21.0] {
        let to = if x > 20.0 { x + 2.0 } else { x + 3.2 };
        [0.0, h].into_iter().for_each(|y| canvas.window([x, y - half], [to, y + half], STROKE_M));
    }
    for y in [1.0, 5.4, 9.8] {
        [0.0, w].into_iter().for_each(|x| canvas.window([x - half, y], [x + half, y + 3.2], STROKE_M));
    }
    // The core has a door and no window.
    canvas.fill(&[rectangle([9.0, 5.2], [14.5, 9.2])], black);
    canvas.fill(&[rectangle([9.6, 5.8], [13.9, 8.6])], white);
    hang(&mut canvas, ([11.0, 5.5], 0.0, -PI * 0.5, 0.6));
    // Glass walls are two lines, with a mullion across every metre.
    let glazed = [
        ([half, 4.0], [2.4, 4.0]),
        ([3.3, 4.0], [4.0, 4.0]),
        ([4.0, half], [4.0, 4.05]),
        ([20.0, half], [20.0, 4.05]),
        ([20.0, 4.0], [20.7, 4.0]),
        ([21.6, 4.0], [w - half, 4.0]),
    ];
    for (from, to) in glazed {
        let is_level = to[0] - from[0] > to[1] - from[1];
        let beside = |p: Point, by: f64| if is_level { [p[0], p[1] + by] } else { [p[0] + by, p[1]] };
        canvas.fill(&[-0.06, 0.06].map(|by| line(beside(from, by), beside(to, by), 0.03)), glass);
        let length = (to[0] - from[0]).max(to[1] - from[1]);
        for k in 0..=length.round() as usize {
            let at = (k as f64).min(length);
            let p = if is_level { [from[0] + at, from[1]] } else { [from[0], from[1] + at] };
            canvas.fill(&[line(beside(p, -0.12), beside(p, 0.12), 0.03)], glass);
        }
    }
    for (hinge, closed) in [([2.4, 4.0], 0.0), ([21.6, 4.0], PI)] {
        let tip = [hinge[0], hinge[1] - 0.9];
        canvas.fill(&lines(&arc(hinge, 0.9, -PI * 0.5, if closed == 0.0 { 0.0 } else { -PI }), 0.03), glass);
        canvas.fill(&[line(hinge, tip, 0.05)], glass);
    }
    for (x, y) in DESKS {
        canvas.fill(&outline(&rectangle([x, y], [x + 3.2, y + 1.6]), STROKE_M), black);
        canvas.fill(
            &[line([x, y + 0.8], [x + 3.2, y + 0.8], STROKE_M), line([x + 1.6, y], [x + 1.6, y + 1.6], STROKE_M)],
            black,
        );
    }
    // Round chairs with a back, two before each desk.
    for (x, y) in DESKS {
        for (dy, back) in [(-0.4, -0.12), (2.0, 0.12)] {
            let seat = [x + 1.6, y + dy];
            canvas.fill(&outline(&ellipse(seat, [0.26, 0.26]), STROKE_M), black);
            canvas.fill(&[line([seat[0] - 0.22, seat[1] + back], [seat[0] + 0.22, seat[1] + back], STROKE_M)], black);
        }
    }
    canvas
}

#[test]
fn windows_all_around_are_no_frame_and_glass_divides_rooms() {
    let canvas = office_around_a_core();
    let plan = canvas.read(Some(1.0 / PX_PER_M));
    assert_eq!(plan.windows.len(), 18, "windows");
    let hall = canvas.floor_in(&plan, [[5.0, 3.4], [19.0, 5.2]]);
    assert!(hall > 0.95, "{hall} of the hall is floor");
    for (name, room) in [("west", [[0.5, 0.5], [3.5, 3.0]]), ("east", [[20.5, 0.5], [23.5, 3.0]])] {
        let floor = canvas.floor_in(&plan, room);
        assert!(floor > 0.95, "{floor} of the room in the {name} is floor");
    }
    let count = |class: PlanClass| plan.furniture.iter().filter(|piece| piece.class == class).count();
    let [seats, fixtures] = [PlanClass::Seat, PlanClass::Fixture].map(count);
    assert!(seats >= 15 && fixtures == 0, "16 round chairs: {seats} seats, {fixtures} basins");
    let outside = canvas.floor_in(&plan, [[-2.8, -2.8], [26.8, -0.4]]);
    assert!(outside < 0.01, "{outside} of the paper is floor");
    let rooms = Rooms::find(&plan, &Walls::trace(&plan, &WallsOptions::default()));
    assert_eq!(rooms.rooms.len(), 4, "two rooms behind glass, the core, the hall: {:?}", rooms.rooms);
}
