//! Floors as brochures render them, with textures, shadows and furniture from above, and walls of one tone between them.

use trodden::math::SplitMix64;

use super::canvas::{Canvas, Point, Polygon, line, outline, rectangle};
use super::mixed_walls::{OUTER_M, PARTITION_M, SIZE_M, wall};

const PX_PER_M: f64 = 90.0;

/// Corners and colours of beds, tables and a shelf.
const FURNITURE: [(Point, Point, [u8; 3]); 5] = [
    ([0.4, 1.0], [2.2, 2.8], [96, 128, 166]),
    ([5.0, 5.2], [6.4, 6.0], [122, 78, 44]),
    ([9.0, 1.2], [10.4, 2.4], [238, 232, 222]),
    ([0.5, 4.6], [2.3, 6.4], [176, 72, 70]),
    ([10.9, 5.0], [11.7, 7.4], [70, 66, 62]),
];

/// What the walls look like.
#[derive(Clone, Copy, Debug)]
enum Tops {
    /// White, with dark sides to the lower right, on pale grey.
    White,
    /// Grey on white, as dark as furniture is.
    Grey,
    /// Light, on a dark ground.
    Beige,
}

impl Tops {
    fn colours(self) -> ([u8; 3], [u8; 3]) {
        match self {
            Tops::White => ([232, 233, 235], [252, 252, 250]),
            Tops::Grey => ([255; 3], [84, 87, 92]),
            Tops::Beige => ([44, 46, 50], [233, 222, 200]),
        }
    }
}

/// Walls from place to place without the doors in them, and the hinges of these doors.
fn walls() -> (Vec<Polygon>, [Point; 6]) {
    let [w, h] = SIZE_M;
    let part = |a: Point, b: Point| wall([a, b], PARTITION_M);
    let outer = |a: Point, b: Point| wall([a, b], OUTER_M);
    let walls = vec![
        outer([0.0, 0.0], [5.35, 0.0]),
        outer([6.65, 0.0], [w, 0.0]),
        outer([0.0, h], [w, h]),
        outer([0.0, 0.0], [0.0, h]),
        outer([w, 0.0], [w, h]),
        part([4.0, 0.0], [4.0, 2.4]),
        part([4.0, 3.4], [4.0, 5.6]),
        part([4.0, 6.6], [4.0, h]),
        part([8.0, 0.0], [8.0, 2.4]),
        part([8.0, 3.4], [8.0, 5.6]),
        part([8.0, 6.6], [8.0, h]),
        part([0.0, 4.0], [6.45, 4.0]),
        part([7.45, 4.0], [w, 4.0]),
    ];
    let hinges = [[5.55, 0.0], [4.0, 2.5], [4.0, 5.7], [8.0, 2.5], [8.0, 5.7], [6.55, 4.0]];
    (walls, hinges)
}

/// Six rooms of 4 x 4 m on planks, carpet and tiles.
fn six_rooms(tops: Tops) -> Canvas {
    let (ground, tone) = tops.colours();
    let mut canvas = Canvas::new([14.0, 10.0], [-1.0, -1.0], PX_PER_M, 0.0, ground);
    let mut rng = SplitMix64::new(11);
    let tinted = |colour: [f64; 3], by: f64| colour.map(|v| (v + by).clamp(0.0, 255.0) as u8);
    for (k, [x, y]) in [[0.0, 0.0], [4.0, 0.0], [8.0, 0.0], [0.0, 4.0], [4.0, 4.0], [8.0, 4.0]].into_iter().enumerate()
    {
        let (size, colour, spread) = match k % 3 {
            0 => ([1.3, 0.16], [182.0, 138.0, 94.0], 9.0),
            1 => ([0.05, 0.05], [118.0, 124.0, 132.0], 8.0),
            _ => ([0.4, 0.4], [196.0, 190.0, 178.0], 3.0),
        };
        let counts = size.map(|m: f64| (4.0 / m).ceil() as usize);
        for (column, row) in (0..counts[1]).flat_map(|row| (0..counts[0]).map(move |column| (column, row))) {
            let from = [x + column as f64 * size[0], y + row as f64 * size[1]];
            let end = [from[0] + size[0], from[1] + size[1]];
            let tile = rectangle(from, [end[0].min(x + 4.0), end[1].min(y + 4.0)]);
            canvas.fill(&[tile], tinted(colour, spread * f64::from(rng.normal())));
        }
    }
    let grain: Vec<f32> = (0..canvas.pixels.len()).map(|_| 2.5 * rng.normal()).collect();
    for (pixel, grain) in canvas.pixels.iter_mut().zip(grain) {
        if *pixel != ground.map(f32::from) {
            *pixel = pixel.map(|v| (v + grain).clamp(0.0, 255.0));
        }
    }
    for (min, max, colour) in FURNITURE {
        canvas.fill(&[rectangle(min.map(|v| v + 0.05), max.map(|v| v + 0.05))], [78, 70, 64]);
        canvas.fill(&[rectangle(min, max)], colour);
        canvas.fill(&outline(&rectangle(min.map(|v| v + 0.1), max.map(|v| v - 0.1)), 0.02), colour.map(|v| v / 2 + 40));
    }
    let (walls, hinges) = walls();
    if matches!(tops, Tops::White) {
        let side =
            |by: f64| walls.iter().map(|wall| wall.iter().map(|p| p.map(|v| v + by)).collect()).collect::<Vec<_>>();
        canvas.fill(&side(0.12), [96, 97, 102]);
        canvas.fill(&side(0.06), [96, 97, 102]);
    }
    canvas.fill(&walls, tone);
    for wall in &walls {
        canvas.fill(&outline(wall, 0.015), [150, 150, 150]);
    }
    // Corners have no outlines.
    let inner: Vec<Polygon> =
        walls.iter().map(|wall| rectangle(wall[0].map(|v| v + 0.02), wall[2].map(|v| v - 0.02))).collect();
    canvas.fill(&inner, tone);
    let [_, h] = SIZE_M;
    for (x, y) in [(1.0, 0.0), (9.2, 0.0), (1.0, h), (5.2, h), (9.2, h)] {
        let [min, max] = [[x, y - 0.5 * OUTER_M], [x + 1.6, y + 0.5 * OUTER_M]];
        canvas.fill(&[rectangle(min, max)], [206, 228, 242]);
        for by in [-0.05, 0.05] {
            canvas.fill(&[line([min[0], y + by], [max[0], y + by], 0.02)], [120, 150, 176]);
        }
        canvas.fill(&[0, 1].map(|k| line([x, [min, max][k][1]], [x + 1.6, [min, max][k][1]], 0.015)), [150, 160, 170]);
    }
    for hinge in hinges {
        let tip = [hinge[0] + 0.3, hinge[1] + 0.75];
        canvas.fill(&[line(hinge, tip, 0.04)], [112, 74, 42]);
    }
    canvas
}

/// Walls as light as the ground or as dark as furniture were lost among planks and shadows: such plans were one room, or had
/// five times as many doors.
#[test]
fn walls_between_textured_floors_are_known_by_their_tone() {
    for tops in [Tops::White, Tops::Grey, Tops::Beige] {
        let canvas = six_rooms(tops);
        let plan = canvas.read(None);
        let scale = plan.metres_per_pixel * PX_PER_M;
        assert!((0.85..1.15).contains(&scale), "{tops:?}: the scale is {scale} times the true one");
        assert_eq!([plan.doors.len(), plan.windows.len()], [6, 5], "{tops:?}: doors and windows");
        for (x, y) in [(0.0, 0.0), (4.0, 0.0), (8.0, 0.0), (0.0, 4.0), (4.0, 4.0), (8.0, 4.0)] {
            for [min, max] in [[[2.5, 0.4], [3.6, 0.9]], [[0.4, 3.1], [2.0, 3.6]]] {
                let free = canvas.floor_in(&plan, [[x + min[0], y + min[1]], [x + max[0], y + max[1]]]);
                assert!(free > 0.97, "{tops:?}: {free} of the room at {x}, {y} is floor");
            }
        }
        assert_eq!(plan.furniture.len(), FURNITURE.len(), "{tops:?}: {:?}", plan.furniture);
        for (min, max, _) in FURNITURE {
            let free = canvas.floor_in(&plan, [min.map(|v| v + 0.15), max.map(|v| v - 0.15)]);
            assert!(free < 0.02, "{tops:?}: {free} of the furniture at {min:?} is floor");
        }
        let wall = canvas.floor_in(&plan, [[-0.05, -0.05], [0.05, 8.05]]);
        assert!(wall < 0.02, "{tops:?}: {wall} of the western wall is floor");
        let around = canvas.floor_in(&plan, [[-0.9, -0.9], [12.9, -0.4]]);
        assert!(around < 0.01, "{tops:?}: {around} of what is around the rooms is floor");
    }
}
