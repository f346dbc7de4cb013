//! Buildings behind piers and glass: an office, a shop with a sliding entrance, a station that is open at its tunnels.

use std::f64::consts::{FRAC_PI_2, PI};

use trodden::plan::FloorPlan;
use trodden::rooms::Rooms;
use trodden::walls::{Walls, WallsOptions};

use super::canvas::{Canvas, Point, arc, ellipse, line, lines, outline, rectangle};

const INK: [u8; 3] = [58; 3];
const GLASS: [u8; 3] = [40, 60, 80];

/// Areas of the rooms, square metres, from the smallest.
pub fn rooms_m2(plan: &FloorPlan) -> Vec<f64> {
    let rooms = Rooms::find(plan, &Walls::trace(plan, &WallsOptions::default()));
    let mut areas: Vec<f64> = rooms.rooms.iter().map(|room| room.area_m2).collect();
    areas.sort_by(f64::total_cmp);
    areas
}

fn middle([min, max]: [Point; 2]) -> Point {
    [(min[0] + max[0]) * 0.5, (min[1] + max[1]) * 0.5]
}

/// Whether one of some gaps has its middle at a place, metres from the drawing's upper left corner.
fn is_at(plan: &FloorPlan, mut gaps: impl Iterator<Item = [Point; 2]>, canvas: &Canvas, place: Point) -> bool {
    let [x, y] = canvas.px(place);
    let scale = plan.metres_per_pixel;
    let at = [x * scale, (canvas.height as f64 - y) * scale];
    gaps.any(|[a, b]| (0..2).all(|k| (middle([a, b])[k] - at[k]).abs() < 0.4))
}

pub fn has_door(plan: &FloorPlan, canvas: &Canvas, place: Point) -> bool {
    let gaps = plan.doors.iter().map(|door| [door.from_m, door.to_m].map(|p| [p.x, p.y]));
    is_at(plan, gaps, canvas, place)
}

pub fn has_window(plan: &FloorPlan, canvas: &Canvas, place: Point) -> bool {
    let gaps = plan.windows.iter().map(|window| [window.from_m, window.to_m].map(|p| [p.x, p.y]));
    is_at(plan, gaps, canvas, place)
}

/// The leaf and the arc of a door in a wall along the rows, which opens upwards about its right jamb.
fn leaf(canvas: &mut Canvas, hinge: Point, width: f64, ink: [u8; 3]) {
    canvas.fill(&[line(hinge, [hinge[0], hinge[1] - width], 0.03)], ink);
    canvas.fill(&lines(&arc(hinge, width, PI, PI + FRAC_PI_2), 0.015), ink);
}

/// Four lines from pier to pier.
fn panes(canvas: &mut Canvas, [min, max]: [Point; 2], thick: f64) {
    let is_level = max[0] - min[0] > max[1] - min[1];
    for share in [0.0, 0.4, 0.6, 1.0] {
        let across = |axis: usize| min[axis] + share * (max[axis] - min[axis]);
        let ends = if is_level {
            [[min[0], across(1)], [max[0], across(1)]]
        } else {
            [[across(0), min[1]], [across(0), max[1]]]
        };
        canvas.fill(&[line(ends[0], ends[1], thick)], INK);
    }
}

/// 30 by 18 m inside: piers with windows of 5.5 m between them, a core, rooms of glass at the upper front, a room with a wall of
/// 14 cm at the lower one. Glass and wall end a little before the panes.
#[test]
fn rooms_of_glass_end_at_a_front_of_glass() {
    const WALL: f64 = 0.3;
    let mut canvas = Canvas::new([34.0, 22.0], [-2.0, -2.0], 56.0, 0.0, [255; 3]);
    let (w, h) = (30.0, 18.0);
    let mut windows = Vec::new();
    for k in 0..5 {
        let x = 6.0 * f64::from(k) + 0.25;
        for y in [-WALL, h] {
            windows.push([[x, y], [x + 5.5, y + WALL]]);
        }
    }
    for k in 0..3 {
        let y = 6.0 * f64::from(k) + 0.25;
        for x in [-WALL, w] {
            windows.push([[x, y], [x + WALL, y + 5.5]]);
        }
    }
    let ring = [[-WALL, -WALL], [w + WALL, h + WALL]];
    canvas.fill(&[rectangle(ring[0], ring[1])], INK);
    canvas.fill(&[rectangle([0.0; 2], [w, h])], [255; 3]);
    for &[min, max] in &windows {
        canvas.fill(&[rectangle(min, max)], [255; 3]);
        panes(&mut canvas, [min, max], 0.018);
    }
    // The core has two rooms of 4 by 4 m.
    canvas.fill(&[rectangle([10.0, 8.0], [18.75, 12.5])], INK);
    canvas.fill(&[rectangle([10.25, 8.25], [14.25, 12.25]), rectangle([14.5, 8.25], [18.5, 12.25])], [255; 3]);
    let core_doors = [[12.0, 8.125], [16.5, 8.125]];
    for [x, _] in core_doors {
        canvas.fill(&[rectangle([x - 0.5, 7.9], [x + 0.5, 8.3])], [255; 3]);
        leaf(&mut canvas, [x + 0.5, 8.1], 1.0, INK);
    }
    // Three rooms of glass: two lines, 6 cm apart, and doors 25 cm beside a cross wall.
    let mut glass_doors = Vec::new();
    let mut pane = |a: Point, b: Point| {
        let (dx, dy) = if a[0] == b[0] { (0.03, 0.0) } else { (0.0, 0.03) };
        for by in [-1.0, 1.0] {
            let at = |p: Point| [p[0] + by * dx, p[1] + by * dy];
            canvas.fill(&[line(at(a), at(b), 0.018)], GLASS);
        }
    };
    for k in 0..3 {
        let x = 4.0 * f64::from(k);
        pane([x + 4.0, 0.03], [x + 4.0, 4.5]);
        pane([x + 0.03, 4.5], [x + 2.8, 4.5]);
        pane([x + 3.75, 4.5], [x + 4.0, 4.5]);
        glass_doors.push([x + 3.275, 4.5]);
    }
    for [x, y] in glass_doors.clone() {
        leaf(&mut canvas, [x + 0.475, y], 0.95, GLASS);
    }
    // A room of 6 by 5 m in the lower right corner.
    canvas.fill(&[rectangle([24.0, 13.0], [26.0, 13.14]), rectangle([27.0, 13.0], [w - 0.03, 13.14])], INK);
    canvas.fill(&[rectangle([24.0, 13.0], [24.14, h - 0.03])], INK);
    leaf(&mut canvas, [27.0, 13.0], 1.0, INK);
    for k in 0..4 {
        let x = 3.0 + 4.0 * f64::from(k);
        canvas.fill(&outline(&rectangle([x, 14.2], [x + 1.6, 15.0]), 0.02), INK);
    }
    let plan = canvas.read(Some(1.0 / 56.0));
    let missing: Vec<Point> =
        windows.iter().copied().map(middle).filter(|&place| !has_window(&plan, &canvas, place)).collect();
    assert!(missing.is_empty() && plan.windows.len() == 16, "windows missing at {missing:?} of {}", plan.windows.len());
    for place in core_doors.into_iter().chain(glass_doors).chain([[26.5, 13.07]]) {
        assert!(has_door(&plan, &canvas, place), "no door at {place:?}");
    }
    let areas = rooms_m2(&plan);
    let (small, large) = areas.split_at(5);
    let is_room = |area: &f64| (15.0..18.0).contains(area);
    assert!(small.iter().all(is_room) && large.len() == 2 && (27.0..29.0).contains(&large[0]), "{areas:?}");
}

/// A hall of 30 by 20 m with hatched walls: piers of 60 cm between windows of 4 m, a sliding entrance of two leaves with a slit
/// of two pixels between them, racks.
#[test]
fn leaves_that_meet_are_an_entrance_between_hatched_piers() {
    const WALL: f64 = 0.3;
    const PX_PER_M: f64 = 38.0;
    let mut canvas = Canvas::new([34.0, 24.0], [-2.0, -2.0], PX_PER_M, 0.0, [255; 3]);
    let (w, h) = (30.0, 20.0);
    let windows: Vec<[Point; 2]> = [1.0, 5.6, 10.2]
        .map(|x| [[x, h], [x + 4.0, h + WALL]])
        .into_iter()
        .chain([[[22.0, h], [26.0, h + WALL]]])
        .collect();
    let entrance = [[16.0, h], [18.6, h + WALL]];
    let back = [[5.0, -WALL], [6.0, 0.0]];
    // Pieces of wall, each with its outline and hatch.
    let mut pieces = vec![
        [[-WALL, -WALL], [5.0, 0.0]],
        [[6.0, -WALL], [w + WALL, 0.0]],
        [[-WALL, 0.0], [0.0, h + WALL]],
        [[w, 0.0], [w + WALL, h + WALL]],
    ];
    let ends = [0.0, 1.0, 5.0, 5.6, 9.6, 10.2, 14.2, 16.0, 18.6, 22.0, 26.0, 30.0];
    pieces.extend(ends.chunks_exact(2).map(|pair| [[pair[0], h], [pair[1], h + WALL]]));
    let walls: Vec<_> = pieces.iter().map(|&[min, max]| rectangle(min, max)).collect();
    let within = canvas.samples(&walls);
    let hatch: Vec<_> =
        (0..420).map(|k| f64::from(k) * 0.13 - 24.0).map(|x| line([x, h + 2.0], [x + 24.0, h - 22.0], 0.03)).collect();
    let hatch = canvas.samples(&hatch);
    canvas.paint(&within.iter().zip(&hatch).map(|(a, b)| a & b).collect(), [0; 3]);
    for wall in &walls {
        canvas.fill(&outline(wall, 0.04), [0; 3]);
    }
    for &window in &windows {
        panes(&mut canvas, window, 0.03);
    }
    // Two pixels between the strokes of the leaves.
    let slit = 1.3 / PX_PER_M + 0.015;
    for [from, to] in [[16.04, 17.3 - slit], [17.3 + slit, 18.56]] {
        canvas.fill(&outline(&rectangle([from, h + 0.12], [to, h + 0.2]), 0.03), [0; 3]);
    }
    leaf(&mut canvas, [6.0, 0.0 - WALL], 1.0, [0; 3]);
    for k in 0..8 {
        let x = 4.0 + 2.6 * f64::from(k);
        canvas.fill(&outline(&rectangle([x, 5.0], [x + 1.0, 11.0]), 0.02), [0; 3]);
        canvas.fill(&[line([x + 0.5, 5.0], [x + 0.5, 11.0], 0.02)], [0; 3]);
    }
    let plan = canvas.read(Some(1.0 / PX_PER_M));
    for window in windows {
        assert!(has_window(&plan, &canvas, middle(window)), "no window at {:?}: {:?}", middle(window), plan.windows);
    }
    for door in [entrance, back] {
        assert!(has_door(&plan, &canvas, middle(door)), "no door at {:?}: {:?}", middle(door), plan.doors);
    }
    let areas = rooms_m2(&plan);
    assert!(areas.len() == 1 && (areas[0] - 600.0).abs() < 60.0, "{areas:?}");
}

/// A platform of 60 by 16 m between walls of 0.6 m, in dark blue alone: both tracks leave it by mouths of 4.2 m, its other end
/// leads to a passage with stairs; columns, rails and sleepers, two rooms with doors.
#[test]
fn a_station_in_blue_ink_is_open_at_its_tunnels() {
    const BLUE: [u8; 3] = [14, 38, 110];
    let mut canvas = Canvas::new([84.0, 26.0], [-16.0, -5.0], 21.0, 0.0, [255; 3]);
    let ([w, h], wall) = ([60.0, 16.0], 0.6);
    let masses = [
        [[0.0, -wall], [w, 0.0]],
        [[0.0, h], [w, h + wall]],
        [[w - wall, 4.2], [w, h - 4.2]],
        [[0.0, 4.2], [wall, 5.9]],
        [[0.0, 10.1], [wall, h - 4.2]],
        [[-12.0, 5.3], [wall, 5.9]],
        [[-12.0, 10.1], [wall, 10.7]],
        [[-12.6, 5.3], [-12.0, 6.4]],
        [[-12.6, 9.6], [-12.0, 10.7]],
        // The rooms at the right end.
        [[54.0, 4.6], [w, 4.9]],
        [[54.0, 11.1], [w, 11.4]],
        [[54.0, 4.6], [54.3, 6.0]],
        [[54.0, 7.0], [54.3, 9.0]],
        [[54.0, 10.0], [54.3, 11.4]],
        [[54.3, 7.9], [w, 8.1]],
    ];
    canvas.fill(&masses.map(|[min, max]| rectangle(min, max)), BLUE);
    for k in 0..10 {
        for y in [5.6, 10.0] {
            let x = 4.0 + 5.0 * f64::from(k);
            canvas.fill(&[rectangle([x, y], [x + 0.5, y + 0.5])], BLUE);
        }
    }
    for y in [1.2, 2.7, h - 2.7, h - 1.2] {
        canvas.fill(&[line([-2.0, y], [w + 2.0, y], 0.05)], [135, 147, 183]);
    }
    for k in 0..53 {
        let x = -1.0 + 1.2 * f64::from(k);
        for y in [0.7, h - 3.2] {
            canvas.fill(&[line([x, y], [x, y + 2.5], 0.05)], [135, 147, 183]);
        }
    }
    for k in 0..20 {
        let x = -9.0 + 0.3 * f64::from(k);
        canvas.fill(&[line([x, 5.9], [x, 10.1], 0.05)], BLUE);
    }
    for y in [6.5, 9.5] {
        canvas.fill(&[line([54.0, y + 0.5], [53.0, y + 0.5], 0.05)], BLUE);
        canvas.fill(&lines(&arc([54.0, y + 0.5], 1.0, PI, PI + FRAC_PI_2), 0.05), BLUE);
    }
    canvas.fill(&[ellipse([30.0, 8.0], [0.4, 0.4])], BLUE);
    let plan = canvas.read(Some(1.0 / 21.0));
    let share = |place| canvas.floor_in(&plan, place);
    for (what, place) in [
        ("the upper track", [[2.0, 0.3], [57.0, 4.0]]),
        ("the platform", [[1.0, 6.6], [53.0, 9.4]]),
        ("the passage", [[-11.5, 6.1], [0.0, 9.9]]),
        ("a room", [[54.6, 5.2], [59.0, 7.6]]),
    ] {
        assert!(share(place) > 0.9, "{} of {what} is floor", share(place));
    }
    for paper in [[[0.0, -4.0], [60.0, -1.5]], [[-12.0, 0.0], [-1.0, 4.5]], [[-12.0, 12.0], [-1.0, 20.0]]] {
        assert!(share(paper) < 0.02, "{} of paper is floor", share(paper));
    }
    assert!([6.5, 9.5].into_iter().all(|y| has_door(&plan, &canvas, [54.15, y])), "{:?}", plan.doors);
}
