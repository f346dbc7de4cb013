//! Outer walls that are drawn as outlines, by hatches or with a grey fill, and black partitions between them.

use std::f64::consts::PI;

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

/// Six rooms of 4 x 4 m, two rows of three, with a door between each two that lie side by side, one between the rows and one
/// to the outside; windows to the north and the south, a bed and counters close before some of them.
fn six_rooms(fill: Fill) -> Canvas {
    let (white, black) = ([255; 3], [0; 3]);
    let mut canvas = Canvas::new([SIZE_M[0] + 4.0, SIZE_M[1] + 4.0], [-2.0, -2.0], PX_PER_M, 0.0, white);
    let [w, h] = SIZE_M;
    let sides = [[[0.0, 0.0], [w, 0.0]], [[0.0, h], [w, h]], [[0.0, 0.0], [0.0, h]], [[w, 0.0], [w, h]]];
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
    // The hinge, the way of the closed leaf and that of the open one, the thickness of the wall.
    let doors: [(Point, f64, f64, f64); 6] = [
        ([4.0, 2.4], PI * 0.5, PI, PARTITION_M),
        ([8.0, 2.4], PI * 0.5, 0.0, PARTITION_M),
        ([4.0, 5.6], PI * 0.5, PI, PARTITION_M),
        ([8.0, 5.6], PI * 0.5, 0.0, PARTITION_M),
        ([6.5, 4.0], 0.0, PI * 0.5, PARTITION_M),
        ([5.5, 0.0], 0.0, PI * 0.5, OUTER_M),
    ];
    for (hinge, closed, open, thick) in doors {
        let [end, tip] = [closed, open].map(|way| [hinge[0] + way.cos() * 0.9, hinge[1] + way.sin() * 0.9]);
        let beside = |p: Point, by: f64| if closed == 0.0 { [p[0], p[1] + by] } else { [p[0] + by, p[1]] };
        let half = thick * 0.5;
        canvas.fill(&[rectangle(beside(hinge, -half - 0.05), beside(end, half + 0.05))], white);
        canvas.fill(&[hinge, end].map(|jamb| line(beside(jamb, -half), beside(jamb, half), STROKE_M)), black);
        let swing = arc(hinge, 0.9, closed, open);
        canvas.fill(&lines(&swing, 0.03), black);
        canvas.fill(&[line(hinge, tip, 0.06)], black);
    }
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
