//! Levels of games from above: coloured lines on black, floors of stones in the dark, light walls before a void.

use trodden::math::SplitMix64;
use trodden::plan::FloorPlan;

use super::canvas::{Canvas, Point, Polygon, line, outline, rectangle};
use super::floors::walls;

const SIZE_M: Point = [30.0, 20.0];
/// Three rooms, and the corridors that lead in and from one to the next.
const ROOMS: [[Point; 2]; 3] = [[[2.0, 2.0], [10.0, 8.0]], [[16.0, 2.0], [26.0, 9.0]], [[5.0, 13.0], [15.0, 18.0]]];
const CORRIDORS: [[Point; 2]; 3] = [[[-1.0, 4.0], [2.0, 5.5]], [[10.0, 4.0], [16.0, 5.5]], [[6.0, 8.0], [7.5, 13.0]]];
/// Solid ground between rooms.
const SOLID: [[Point; 2]; 3] = [[[11.0, 7.0], [15.0, 12.0]], [[18.0, 11.0], [28.0, 18.0]], [[1.0, 10.0], [4.0, 17.0]]];

fn floors() -> Vec<Polygon> {
    ROOMS.into_iter().chain(CORRIDORS).map(|[min, max]| rectangle(min, max)).collect()
}

/// Walls around all of them, as the ground that floors are laid on.
fn walls_around(thick: f64) -> Vec<Polygon> {
    let grown = |[min, max]: [Point; 2]| rectangle(min.map(|v| v - thick), max.map(|v| v + thick));
    ROOMS.into_iter().chain(CORRIDORS).map(grown).collect()
}

/// Rooms and corridors are floor, one piece that people enter from the west; what lies between them is none.
fn is_read(name: &str, canvas: &Canvas, plan: &FloorPlan) {
    let share = |place| canvas.floor_in(plan, place);
    let rooms = ROOMS.map(|[min, max]| share([min.map(|v| v + 0.2), max.map(|v| v - 0.2)]));
    let corridors = CORRIDORS.map(|[min, max]| share([min.map(|v| v + 0.25), max.map(|v| v - 0.25)]));
    let solid = SOLID.map(share);
    assert!(rooms.iter().chain(&corridors).all(|&share| share > 0.97), "{name}: {rooms:.3?}, {corridors:.3?}");
    assert!(solid.iter().all(|&share| share < 0.01), "{name}: {solid:.3?} of solid ground is floor");
    assert_eq!(plan.openings.len(), 1, "{name}: {:?}", plan.openings);
}

/// As the automap of a shooter: red walls and yellow doors, a pixel wide, on black.
#[test]
fn coloured_lines_on_black_are_walls() {
    let mut canvas = Canvas::new(SIZE_M, [0.0; 2], 20.0, 0.0, [0; 3]);
    canvas.fill(&walls_around(0.05), [252, 0, 0]);
    canvas.fill(&floors(), [0; 3]);
    for door in [[[11.0, 4.0], [11.0, 5.5]], [[15.0, 4.0], [15.0, 5.5]], [[6.0, 9.0], [7.5, 9.0]]] {
        canvas.fill(&[line(door[0], door[1], 0.05)], [252, 252, 0]);
    }
    is_read("automap", &canvas, &canvas.read(Some(0.05)));
}

/// As the map of a fantasy game: stones with dark joints and a grid over all, in the dark, a door across a corridor.
#[test]
fn stones_of_a_floor_in_the_dark_are_one_floor() {
    let mut canvas = Canvas::new(SIZE_M, [0.0; 2], 32.0, 0.0, [36, 33, 30]);
    canvas.fill(&walls_around(0.15), [92, 84, 76]);
    canvas.fill(&floors(), [70, 66, 60]);
    let mut rng = SplitMix64::new(3);
    for [min, max] in ROOMS.into_iter().chain(CORRIDORS) {
        let count = [0, 1].map(|axis| ((max[axis] - min[axis]) / 0.5).round() as usize);
        for k in 0..count[0] * count[1] {
            let at = [min[0] + 0.5 * (k % count[0]) as f64, min[1] + 0.5 * (k / count[0]) as f64];
            let tone = 150.0 + 9.0 * f64::from(rng.normal());
            let colour = [tone, 0.95 * tone, 0.86 * tone].map(|v| v as u8);
            canvas.fill(&[rectangle(at.map(|v| v + 0.03), at.map(|v| v + 0.47))], colour);
        }
    }
    for at in (1..30).map(f64::from) {
        canvas.fill(&[line([at, 0.0], [at, 20.0], 0.03)], [70, 66, 60]);
        canvas.fill(&[line([0.0, at], [30.0, at], 0.03)], [70, 66, 60]);
    }
    canvas.fill(&[rectangle([12.0, 4.0], [12.3, 5.5])], [110, 66, 30]);
    is_read("stones", &canvas, &canvas.read(Some(1.0 / 32.0)));
}

/// As an editor shows a level of plain boxes: light walls, a floor with a grid and soft shadows, nothing around it.
#[test]
fn the_void_around_light_walls_is_solid() {
    let mut canvas = Canvas::new(SIZE_M, [0.0; 2], 20.0, 0.0, [58, 60, 64]);
    canvas.fill(&walls_around(0.2), [205, 206, 210]);
    canvas.fill(&floors(), [122, 124, 128]);
    for [min, max] in ROOMS {
        for k in 1..(max[0] - min[0]) as usize {
            let x = min[0] + k as f64;
            canvas.fill(&[line([x, min[1]], [x, max[1]], 0.05)], [110, 112, 116]);
        }
        // Shadows under the northern and western walls.
        for (k, tone) in [80, 90, 105].into_iter().enumerate() {
            let [near, far] = [k, k + 1].map(|k| 0.08 * k as f64);
            canvas.fill(&[rectangle([min[0], min[1] + near], [max[0], min[1] + far])], [tone, tone, tone + 4]);
        }
    }
    // A pillar.
    canvas.fill(&outline(&rectangle([20.0, 5.0], [21.0, 6.0]), 0.2), [205, 206, 210]);
    is_read("boxes", &canvas, &canvas.read(Some(0.05)));
}

/// As brochures show a flat: floors of wood and tiles from above, white walls and white furniture with their shadows, on white.
#[test]
fn white_walls_between_floors_seen_from_above_are_walls() {
    const WALL: f64 = 0.18;
    let mut canvas = Canvas::new([12.0, 10.0], [-1.0, -1.0], 50.0, 0.0, [255; 3]);
    let mut rng = SplitMix64::new(7);
    for (row, y) in (0..80).map(|row| (row, 0.1 * f64::from(row))) {
        let tone = f64::from(rng.normal()) * 8.0 - if row % 2 == 0 { 6.0 } else { 0.0 };
        let colour = [186.0, 146.0, 104.0].map(|v| (v + tone) as u8);
        canvas.fill(&[rectangle([0.0, y], [10.0, y + 0.1])], colour);
    }
    canvas.fill(&[rectangle([4.0, 0.0], [7.0, 3.5])], [198, 194, 184]);
    canvas.fill(&[rectangle([7.0, 5.0], [10.0, 8.0])], [150, 176, 190]);
    let wall_lines = [
        [0.0, 0.0, 10.0, 0.0],
        [0.0, 8.0, 10.0, 8.0],
        [0.0, 0.0, 0.0, 4.0],
        [0.0, 5.0, 0.0, 8.0],
        [10.0, 0.0, 10.0, 8.0],
        [4.0, 0.0, 4.0, 3.5],
        [7.0, 0.0, 7.0, 3.5],
        [0.0, 3.5, 2.0, 3.5],
        [2.9, 3.5, 5.0, 3.5],
        [5.9, 3.5, 8.0, 3.5],
        [8.9, 3.5, 10.0, 3.5],
        [4.5, 5.0, 4.5, 8.0],
        [0.0, 5.0, 2.0, 5.0],
        [2.9, 5.0, 5.0, 5.0],
        [5.9, 5.0, 8.0, 5.0],
        [8.9, 5.0, 10.0, 5.0],
        [7.0, 5.0, 7.0, 8.0],
    ];
    let shade = canvas.mask(&walls(&wall_lines.map(|line| line.map(|v| v + 0.1)), WALL));
    let inside = canvas.mask(&[rectangle([0.0, 0.0], [10.0, 8.0])]);
    for ((pixel, shade), inside) in canvas.pixels.iter_mut().zip(shade).zip(inside) {
        if shade != 0 && inside != 0 {
            *pixel = pixel.map(|v| 0.6 * v);
        }
    }
    canvas.fill(&[rectangle([0.8, 6.0], [2.6, 7.6]), rectangle([8.0, 6.2], [9.2, 7.4])], [236, 232, 228]);
    canvas.fill(&[rectangle([1.0, 1.0], [2.4, 2.0])], [96, 62, 42]);
    canvas.fill(&walls(&wall_lines, WALL), [240, 240, 238]);
    for pixel in &mut canvas.pixels {
        let grain = 2.0 * rng.normal();
        *pixel = pixel.map(|v| if v == 255.0 { v } else { (v + grain).clamp(0.0, 255.0) });
    }
    let plan = canvas.read(Some(0.02));
    // The share of floor in a square of 8 cm to the right of and below a place.
    let share = |at: Point| canvas.floor_in(&plan, [at, at.map(|v| v + 0.08)]);
    for [x0, y0, x1, y1] in wall_lines {
        let middle = [0.5 * (x0 + x1) - 0.04, 0.5 * (y0 + y1) - 0.04];
        assert!(share(middle) == 0.0, "wall at {middle:?}");
    }
    // Rooms, doors, the entrance, shadows.
    let rooms = [[2.8, 2.5], [5.0, 2.0], [8.5, 1.0], [3.4, 4.1], [3.4, 6.5], [5.5, 6.5], [7.3, 5.3], [4.12, 2.0]];
    let doors = [[2.4, 3.5], [5.4, 3.5], [8.4, 3.5], [2.4, 5.0], [5.4, 5.0], [8.4, 5.0], [0.0, 4.5]];
    for at in rooms.into_iter().chain(doors) {
        assert!(share(at) > 0.99, "floor at {at:?}");
    }
    for at in [[1.5, 1.5], [1.5, 6.5], [8.5, 6.8]] {
        assert!(share(at) == 0.0, "furniture at {at:?}");
    }
    assert!(share([-0.6, 2.0]) == 0.0 && share([10.3, 7.0]) == 0.0, "paper around the flat");
}

/// As a map for games at the table: rooms cut out of black rock, a grid of squares of five feet, doors as white boxes.
#[test]
fn boxes_in_the_rock_of_a_dungeon_are_doors_and_its_squares_are_five_feet() {
    const SQUARE_M: f64 = 1.524;
    const PX_PER_M: f64 = 24.0;
    // Column and row of the corners, in squares.
    let rooms = [[2, 2, 8, 8], [11, 3, 17, 8], [3, 11, 9, 15], [13, 11, 18, 16], [2, 9, 3, 10]];
    let corridors = [[8, 4, 11, 5], [9, 12, 13, 13], [14, 8, 15, 11], [5, 8, 6, 11]];
    // Middle of a door, and whether people pass it along the rows.
    let doors = [[8.15, 4.5, 1.0], [10.85, 4.5, 1.0], [9.15, 12.5, 1.0], [14.5, 10.85, 0.0], [5.5, 10.85, 0.0]];
    let area = |[x0, y0, x1, y1]: [i32; 4]| {
        let at = |x: i32, y: i32| [f64::from(x) * SQUARE_M, f64::from(y) * SQUARE_M];
        [at(x0, y0), at(x1, y1)]
    };
    let mut canvas = Canvas::new([32.0, 28.0], [0.0; 2], PX_PER_M, 0.0, [236, 226, 205]);
    canvas.fill(&[rectangle([2.0, 2.0], [29.0, 26.0])], [12; 3]);
    let floors: Vec<[Point; 2]> = rooms[..4].iter().chain(&corridors).map(|&room| area(room)).collect();
    canvas.fill(&floors.iter().map(|&[min, max]| rectangle(min, max)).collect::<Vec<_>>(), [247, 241, 224]);
    for [min, max] in &floors {
        for axis in 0..2 {
            let count = ((max[axis] - min[axis]) / SQUARE_M).round() as usize;
            for k in 1..count {
                let (mut from, mut to) = (*min, *max);
                from[axis] = min[axis] + k as f64 * SQUARE_M;
                to[axis] = from[axis];
                canvas.fill(&[line(from, to, 0.05)], [176, 164, 140]);
            }
        }
    }
    for [x, y, along] in doors {
        let (at, half) = ([x * SQUARE_M, y * SQUARE_M], if along > 0.5 { [0.23, 0.76] } else { [0.76, 0.23] });
        let door = rectangle([at[0] - half[0], at[1] - half[1]], [at[0] + half[0], at[1] + half[1]]);
        canvas.fill(std::slice::from_ref(&door), [255; 3]);
        canvas.fill(&outline(&door, 0.07), [12; 3]);
    }
    // A tomb has rock on no side.
    let tomb = rectangle([6.0, 18.5], [7.0, 20.0]);
    canvas.fill(&outline(&tomb, 0.07), [12; 3]);
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * PX_PER_M;
    assert!((scale - 1.0).abs() < 0.03, "{scale:.3} times the scale: {}", plan.scale.evidence);
    let share = |[min, max]: [Point; 2]| canvas.floor_in(&plan, [min.map(|v| v + 0.25), max.map(|v| v - 0.25)]);
    let shares: Vec<f64> = floors.into_iter().map(share).collect();
    assert!(shares.iter().all(|&share| share > 0.9), "floor reached: {shares:.2?}");
    let solid = share(area(rooms[4]));
    assert!(solid < 0.01, "{solid:.3} of solid rock is floor");
}
