//! Levels of games from above: coloured lines on black, floors of stones in the dark, light walls before a void.

use trodden::math::SplitMix64;
use trodden::plan::FloorPlan;

use super::canvas::{Canvas, Point, Polygon, line, outline, rectangle};

const SIZE_M: Point = [30.0, 20.0];
/// Three rooms, and the corridors that lead in and from one to the next.
const ROOMS: [[Point; 2]; 3] = [[[2.0, 2.0], [10.0, 8.0]], [[16.0, 2.0], [26.0, 9.0]], [[5.0, 13.0], [15.0, 18.0]]];
const CORRIDORS: [[Point; 2]; 3] = [[[-1.0, 4.0], [2.0, 5.5]], [[10.0, 4.0], [16.0, 5.5]], [[6.0, 8.0], [7.5, 13.0]]];
/// Solid ground between rooms.
const SOLID: [[Point; 2]; 3] = [[[11.0, 7.0], [15.0, 12.0]], [[18.0, 11.0], [28.0, 18.0]], [[1.0, 10.0], [4.0, 17.0]]];

fn floors() -> Vec<Polygon> {
    ROOMS.into_iter().chain(CORRIDORS).map(|[min, max]| rectangle(min, max)).collect()
}

fn grown([min, max]: [Point; 2], by: f64) -> Polygon {
    rectangle(min.map(|v| v - by), max.map(|v| v + by))
}

/// Rooms and corridors are floor, one piece that people enter from the west; what lies between them is none.
fn is_read(name: &str, canvas: &Canvas, plan: &FloorPlan) {
    let share = |[min, max]: [Point; 2]| {
        let ([x0, y0], [x1, y1]) = (canvas.px(min), canvas.px(max));
        let (mut all, mut floor) = (0usize, 0usize);
        for y in y0.max(0.0) as usize..y1 as usize {
            for x in x0.max(0.0) as usize..x1 as usize {
                all += 1;
                floor += usize::from(plan.floor[y * plan.width_px as usize + x]);
            }
        }
        floor as f64 / all as f64
    };
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
    let all = ROOMS.into_iter().chain(CORRIDORS);
    canvas.fill(&all.map(|place| grown(place, 0.05)).collect::<Vec<_>>(), [252, 0, 0]);
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
    let all = ROOMS.into_iter().chain(CORRIDORS);
    canvas.fill(&all.map(|place| grown(place, 0.15)).collect::<Vec<_>>(), [92, 84, 76]);
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
    let all = ROOMS.into_iter().chain(CORRIDORS);
    canvas.fill(&all.map(|place| grown(place, 0.2)).collect::<Vec<_>>(), [205, 206, 210]);
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
