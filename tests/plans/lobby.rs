//! A lobby with a revolving door and a WC with cubicles, as drawn and as a copier left it: askew, with grain and a frame.

use std::f64::consts::{FRAC_PI_2, PI};

use trodden::math::SplitMix64;
use trodden::plan::FloorPlan;

use super::canvas::{Canvas, Point, arc, ellipse, line, lines, outline, rectangle};
use super::fronts::{has_door, has_window, rooms_m2};

const PX_PER_M: f64 = 50.0;
const INK: [u8; 3] = [30; 3];
const ENTRANCE: Point = [11.0, 12.125];
const LOBBY_DOORS: [Point; 4] = [[2.5, 4.125], [7.5, 4.125], [12.5, 4.125], [16.625, 6.0]];
const WINDOWS: [Point; 4] = [[2.5, -0.125], [7.5, -0.125], [12.5, -0.125], [4.0, 12.125]];

/// 20 by 12 m inside: three offices above, a WC at the right, a lobby, on a sheet with a double frame.
fn building(turn: f64, frame: bool) -> Canvas {
    let mut canvas = Canvas::new([26.0, 18.0], [-3.0, -3.0], PX_PER_M, turn, [244, 242, 236]);
    let paper = [244, 242, 236];
    let (w, h) = (20.0, 12.0);
    canvas.fill(&[rectangle([-0.25, -0.25], [w + 0.25, h + 0.25])], INK);
    let rooms = [
        [[0.0, 0.0], [5.0, 4.0]],
        [[5.25, 0.0], [10.0, 4.0]],
        [[10.25, 0.0], [w, 4.0]],
        [[0.0, 4.25], [16.5, h]],
        [[16.75, 4.25], [w, h]],
    ];
    canvas.fill(&rooms.map(|[min, max]| rectangle(min, max)), paper);
    for [x, y] in &LOBBY_DOORS[..3] {
        canvas.fill(&[rectangle([x - 0.45, y - 0.2], [x + 0.45, y + 0.2])], paper);
        canvas.fill(&[line([x + 0.45, *y], [x + 0.45, y - 0.9], 0.04)], INK);
        canvas.fill(&lines(&arc([x + 0.45, *y], 0.9, PI, PI + FRAC_PI_2), 0.025), INK);
    }
    let [x, y] = LOBBY_DOORS[3];
    canvas.fill(&[rectangle([x - 0.2, y - 0.45], [x + 0.2, y + 0.45])], paper);
    canvas.fill(&[line([x, y - 0.45], [x + 0.9, y - 0.45], 0.04)], INK);
    canvas.fill(&lines(&arc([x, y - 0.45], 0.9, 0.0, FRAC_PI_2), 0.025), INK);
    for [x, y] in WINDOWS {
        canvas.fill(&[rectangle([x - 1.0, y - 0.13], [x + 1.0, y + 0.13])], paper);
        for off in [-0.11, 0.0, 0.11] {
            canvas.fill(&[line([x - 1.0, y + off], [x + 1.0, y + off], 0.025)], INK);
        }
    }
    // Two shells of a drum, four wings.
    let [x, y] = ENTRANCE;
    canvas.fill(&[rectangle([x - 1.2, y - 0.2], [x + 1.2, y + 0.2])], paper);
    for from in [PI - 0.8, -0.8] {
        for radius in [1.1, 1.18] {
            canvas.fill(&lines(&arc([x, y], radius, from, from + 1.6), 0.025), INK);
        }
    }
    for angle in [0.35, 0.35 + FRAC_PI_2] {
        let end = |way: f64| [x + way * 1.05 * f64::cos(angle), y + way * 1.05 * f64::sin(angle)];
        canvas.fill(&[line(end(-1.0), end(1.0), 0.04)], INK);
    }
    // Cubicles without doors, and basins a hand before the wall.
    for k in 0..3 {
        let top = 8.0 + 1.2 * f64::from(k);
        canvas.fill(&[line([18.5, top], [w, top], 0.03), line([18.5, top], [18.5, top + 0.4], 0.03)], INK);
        canvas.fill(&lines(&ring([19.4, top + 0.6], [0.25, 0.18]), 0.02), INK);
    }
    for y in [9.4, 10.2] {
        canvas.fill(&lines(&ring([17.02, y], [0.18, 0.18]), 0.02), INK);
    }
    if frame {
        for (inset, thick) in [(0.8, 0.08), (1.0, 0.03)] {
            let sheet = rectangle([-3.0 + inset, -3.0 + inset], [23.0 - inset, 15.0 - inset]);
            canvas.fill(&outline(&sheet, thick), INK);
        }
    }
    canvas
}

fn ring(middle: Point, half: Point) -> Vec<Point> {
    let mut points = ellipse(middle, half);
    points.push(points[0]);
    points
}

fn check(plan: &FloorPlan) {
    // Places are those of the drawing before it was turned.
    let canvas = Canvas::new([26.0, 18.0], [-3.0, -3.0], PX_PER_M, 0.0, [255; 3]);
    for place in LOBBY_DOORS.into_iter().chain([ENTRANCE]) {
        assert!(has_door(plan, &canvas, place), "no door at {place:?}: {:?}", plan.doors);
    }
    for place in WINDOWS {
        assert!(has_window(plan, &canvas, place), "no window at {place:?}: {:?}", plan.windows);
    }
    assert_eq!([plan.doors.len(), plan.windows.len()], [5, 4], "{:?} {:?}", plan.doors, plan.windows);
    let areas = rooms_m2(plan);
    assert!(areas.len() == 5 && (areas[4] - 127.9).abs() < 8.0, "{areas:?}");
}

#[test]
fn a_revolving_door_is_an_entrance_and_a_basin_no_jamb() {
    check(&building(0.0, false).read(Some(1.0 / PX_PER_M)));
}

#[test]
fn a_scan_that_lies_askew_is_turned_straight() {
    for degrees in [-1.7, 0.8] {
        let mut canvas = building(f64::to_radians(degrees), true);
        let mut rng = SplitMix64::new(7);
        for pixel in &mut canvas.pixels {
            let grain = 6.0 * rng.normal();
            *pixel = pixel.map(|v| (v + grain).clamp(0.0, 255.0));
        }
        let plan = canvas.read(Some(1.0 / PX_PER_M));
        assert!(plan.warnings.iter().any(|told| told.contains("lies askew")), "{:?}", plan.warnings);
        check(&plan);
    }
}
