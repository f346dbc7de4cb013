//! Drawings whose floors have tones, whose furniture is filled or faint, and whose cells are pixels.

use image::{GrayImage, Luma};
use trodden::plan::{PlanClass, PlanOptions, read};

use std::f64::consts::FRAC_PI_2;

use super::canvas::{Canvas, Polygon, arc, line, lines, outline, rectangle, text};

const BLACK: [u8; 3] = [50, 50, 50];

pub fn walls(lines: &[[f64; 4]], thick: f64) -> Vec<Polygon> {
    let half = 0.5 * thick;
    lines.iter().map(|&[x0, y0, x1, y1]| rectangle([x0 - half, y0 - half], [x1 + half, y1 + half])).collect()
}

/// Rows of shelves in fine grey lines, racks filled with a dark colour: people walked through both.
#[test]
fn shelves_and_racks_stand_in_the_way() {
    let mut canvas = Canvas::new([42.0, 28.0], [-1.0, -1.0], 20.0, 0.0, [255; 3]);
    let lines = [
        [0.0, 0.0, 40.0, 0.0],
        [0.0, 26.0, 18.0, 26.0],
        [21.0, 26.0, 40.0, 26.0],
        [0.0, 0.0, 0.0, 26.0],
        [40.0, 0.0, 40.0, 26.0],
    ];
    canvas.fill(&walls(&lines, 0.3), BLACK);
    let shelf = |k: f64| [[3.0 + k * 4.03, 4.0], [4.2 + k * 4.03, 18.0]];
    let rack = |k: f64| [[24.0 + k * 5.5, 4.0], [26.2 + k * 5.5, 22.0]];
    for k in (0..5).map(f64::from) {
        let [min, max] = shelf(k);
        canvas.fill(&[rectangle(min, max)], [235; 3]);
        canvas.fill(&outline(&rectangle(min, max), 0.04), [90; 3]);
        canvas.fill(&outline(&rectangle(min, [min[0] + 0.6, max[1]]), 0.03), [90; 3]);
    }
    for k in (0..3).map(f64::from) {
        let [min, max] = rack(k);
        canvas.fill(&[rectangle(min, max)], [40, 70, 140]);
    }
    let plan = canvas.read(Some(0.05));
    for k in (0..5).map(f64::from) {
        let [min, max] = shelf(k);
        let (on, beside) = (canvas.floor_in(&plan, [min, max]), [[max[0] + 0.3, 4.0], [max[0] + 2.2, 18.0]]);
        assert!(on < 0.03, "{on} of shelf {k} is floor");
        assert!(canvas.floor_in(&plan, beside) > 0.97, "beside shelf {k}");
    }
    for k in (0..3).map(f64::from) {
        let on = canvas.floor_in(&plan, rack(k));
        assert!(on < 0.03, "{on} of rack {k} is floor");
    }
}

/// Wood is darker than paper: its planks and all that stands on it were strokes, and people came through pale blue windows.
#[test]
fn a_flat_with_floors_of_wood_and_tile_is_as_on_paper() {
    let (wood, pane) = ([205u8, 170, 125], [190, 215, 235]);
    let mut canvas = Canvas::new([12.2, 9.2], [-0.6, -0.6], 70.0, 0.0, [255; 3]);
    for (row, y) in (0..54).map(|k| (k, 0.15 * f64::from(k))) {
        for (k, x) in (0..11).map(|k| (k, f64::from(k))) {
            let shade = ((row * 7 + k * 5) % 9) as i16 * 3 - 12;
            let tone = wood.map(|v| (i16::from(v) + shade) as u8);
            let end = [(x + 1.0).min(11.0), (y + 0.15).min(8.0)];
            canvas.fill(&[rectangle([x, y], end)], tone);
            canvas.fill(&[rectangle([x, y], [end[0], y + 0.008])], tone.map(|v| v - 18));
        }
    }
    canvas.fill(&[rectangle([6.2, 4.0], [11.0, 8.0])], [234, 230, 220]);
    for (min, max, colour) in [
        ([0.4, 0.3], [2.6, 1.2], [120u8, 130, 150]),
        ([3.6, 0.4], [5.2, 2.4], [245, 245, 245]),
        ([8.0, 5.0], [9.6, 6.0], [170, 120, 80]),
    ] {
        canvas.fill(&[rectangle(min, max)], colour);
        canvas.fill(&outline(&rectangle(min, max), 0.015), [90; 3]);
    }
    let mut lines = walls(
        &[
            [0.0, 0.0, 11.0, 0.0],
            [0.0, 8.0, 11.0, 8.0],
            [0.0, 0.0, 0.0, 8.0],
            [11.0, 0.0, 11.0, 8.0],
            [6.2, 0.0, 6.2, 8.0],
        ],
        0.22,
    );
    lines.extend(walls(&[[0.0, 5.0, 6.2, 5.0], [3.2, 5.0, 3.2, 8.0], [6.2, 4.0, 11.0, 4.0]], 0.22));
    canvas.fill(&lines, BLACK);
    let doors = [
        ([6.08, 3.0], [6.32, 3.85]),
        ([1.0, 4.88], [1.85, 5.12]),
        ([4.0, 4.88], [4.85, 5.12]),
        ([7.0, 3.88], [7.9, 4.12]),
    ];
    for (min, max) in doors.into_iter().chain([([1.6, 7.88], [2.5, 8.12])]) {
        canvas.fill(&[rectangle(min, max)], wood);
    }
    let windows = [([1.0, -0.11], [3.0, 0.11]), ([8.0, -0.11], [9.6, 0.11]), ([8.5, 7.89], [10.0, 8.11])];
    for (min, max) in windows {
        canvas.fill(&[rectangle(min, max)], pane);
    }
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * 70.0;
    assert!((0.88..1.14).contains(&scale), "the scale is {scale} times the true one");
    assert_eq!([plan.doors.len(), plan.windows.len()], [5, 3]);
    let rooms = [
        [[0.4, 3.0], [5.8, 4.6]],
        [[6.6, 2.6], [10.6, 3.6]],
        [[6.6, 6.3], [10.6, 7.6]],
        [[0.4, 5.4], [2.8, 7.6]],
        [[3.6, 5.4], [5.8, 7.6]],
    ];
    for room in rooms {
        let floor = canvas.floor_in(&plan, room);
        assert!(floor > 0.97, "{floor} of the room at {room:?} is floor");
    }
    for furniture in [[[0.5, 0.4], [2.5, 1.1]], [[3.7, 0.5], [5.1, 2.3]], [[8.1, 5.1], [9.5, 5.9]]] {
        let floor = canvas.floor_in(&plan, furniture);
        assert!(floor < 0.03, "{floor} of the furniture at {furniture:?} is floor");
    }
}

/// A picture of 64 x 40 pixels was a photograph of a sheet of paper.
#[test]
fn a_game_map_has_a_pixel_a_cell() {
    let mut map = GrayImage::new(64, 40);
    for [x0, y0, x1, y1] in [[2, 2, 12, 9], [20, 3, 34, 10], [42, 2, 60, 12], [12, 5, 20, 6], [34, 6, 42, 7]] {
        (y0..y1).for_each(|y| (x0..x1).for_each(|x| map.put_pixel(x, y, Luma([255]))));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.png");
    map.save(&path).unwrap();
    let plan = read(&path, &PlanOptions::default()).unwrap();
    assert_eq!((plan.width_px, plan.metres_per_pixel), (64, 1.0));
    // All rooms and the corridors of one cell between them.
    assert_eq!(plan.floor.iter().filter(|&&floor| floor != 0).count(), 70 + 98 + 180 + 16);
}

/// Rooms along a corridor that is open at both ends were closed, the corridor was outside, and windows were doors.
#[test]
fn a_corridor_that_is_open_at_its_ends_joins_its_rooms() {
    let mut canvas = Canvas::new([50.0, 24.0], [-1.0, -1.0], 20.0, 0.0, [255; 3]);
    let outer = [[0.0, 0.0, 48.0, 0.0], [0.0, 22.0, 48.0, 22.0]];
    let ends = [[0.0, 0.0, 0.0, 9.4], [0.0, 12.6, 0.0, 22.0], [48.0, 0.0, 48.0, 9.4], [48.0, 12.6, 48.0, 22.0]];
    let mut lines = walls(&outer, 0.36);
    lines.extend(walls(&ends, 0.36));
    for x in (0..6).map(|k| 8.0 * f64::from(k)) {
        for (y, end) in [(9.4, 0.0), (12.6, 22.0)] {
            let cross = [x, f64::min(y, end), x, f64::max(y, end)];
            lines.extend(walls(&[cross, [x, y, x + 0.6, y], [x + 1.8, y, x + 8.0, y]], 0.2));
        }
    }
    canvas.fill(&lines, BLACK);
    for x in (0..6).map(|k| 8.0 * f64::from(k) + 2.0) {
        for y in [0.0, 22.0] {
            canvas.fill(&[rectangle([x, y - 0.18], [x + 4.0, y + 0.18])], [255; 3]);
            let pane = |off: f64| rectangle([x, y + off - 0.025], [x + 4.0, y + off + 0.025]);
            canvas.fill(&[-0.155, 0.0, 0.155].map(pane), BLACK);
        }
    }
    let plan = canvas.read(Some(0.05));
    assert_eq!([plan.doors.len(), plan.windows.len()], [14, 12]);
    let corridor = canvas.floor_in(&plan, [[0.5, 9.7], [47.5, 12.3]]);
    assert!(corridor > 0.97, "{corridor} of the corridor is floor");
}

/// Outer walls are thicker than inner ones with their leaves: the bare entrance in one was dropped, and with it all rooms.
#[test]
fn grey_walls_with_outlines_and_filled_swings_have_an_entrance() {
    let mut canvas = Canvas::new([32.0, 20.0], [-1.0, -1.0], 26.0, 0.0, [255; 3]);
    let outer = [
        [0.0, 0.0, 30.0, 0.0],
        [0.0, 18.0, 13.0, 18.0],
        [15.0, 18.0, 30.0, 18.0],
        [0.0, 0.0, 0.0, 18.0],
        [30.0, 0.0, 30.0, 18.0],
    ];
    let mut inner = vec![
        [10.0, 10.0, 10.0, 18.0],
        [0.0, 10.0, 4.0, 10.0],
        [5.0, 10.0, 10.0, 10.0],
        [20.0, 10.0, 20.0, 18.0],
        [20.0, 10.0, 24.0, 10.0],
        [25.0, 10.0, 30.0, 10.0],
    ];
    let offices = || (0..5).map(|k| 6.0 * f64::from(k));
    for x in offices() {
        inner.extend([[x, 7.0, x + 1.2, 7.0], [x + 2.2, 7.0, x + 6.0, 7.0], [x, 0.0, x, 7.0]]);
    }
    for (fill, rim) in [([0; 3], 0.06), ([178; 3], -0.06)] {
        canvas.fill(&walls(&outer, 0.4 + rim), fill);
        canvas.fill(&walls(&inner, 0.2 + rim), fill);
    }
    for hinge in offices().map(|x| [x + 1.2, 6.9]) {
        let swing = arc(hinge, 1.0, -FRAC_PI_2, 0.0);
        canvas.fill(&[[&[hinge], swing.as_slice()].concat()], [232; 3]);
        canvas.fill(&lines(&swing, 0.04), [120; 3]);
        canvas.fill(&[line(hinge, [hinge[0], 5.9], 0.05)], BLACK);
    }
    let desk = |x: f64| rectangle([x + 2.6, 2.0], [x + 4.4, 2.9]);
    for x in offices() {
        canvas.fill(&[desk(x)], [245; 3]);
        canvas.fill(&outline(&desk(x), 0.03), [90; 3]);
    }
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * 26.0;
    assert!((0.85..1.15).contains(&scale), "the scale is {scale} times the true one");
    assert_eq!(plan.doors.len(), 8);
    let entrance = plan.doors.iter().filter(|door| door.from_m.y.max(door.to_m.y) < 2.0).count();
    assert_eq!(entrance, 1);
    for x in offices() {
        let room = canvas.floor_in(&plan, [[x + 0.4, 3.5], [x + 5.6, 5.7]]);
        assert!(room > 0.97, "{room} of the office at {x} m is floor");
        let on = canvas.floor_in(&plan, [[x + 2.7, 2.1], [x + 4.3, 2.8]]);
        assert!(on < 0.03, "{on} of the desk at {x} m is floor");
    }
}

/// A scan lies askew, the scanner's lid leaves its shadow at the sides, and round letters are as large as stools.
#[test]
fn an_office_that_was_scanned_askew_has_windows_and_no_stools() {
    let mut canvas = Canvas::new([36.0, 24.0], [-3.0, -3.0], 34.0, f64::to_radians(-1.7), [228; 3]);
    let outer = [
        [0.0, 0.0, 30.0, 0.0],
        [0.0, 18.0, 13.0, 18.0],
        [15.0, 18.0, 30.0, 18.0],
        [0.0, 0.0, 0.0, 18.0],
        [30.0, 0.0, 30.0, 18.0],
    ];
    let mut inner = vec![
        [10.0, 10.0, 10.0, 18.0],
        [0.0, 10.0, 4.0, 10.0],
        [4.9, 10.0, 10.0, 10.0],
        [20.0, 10.0, 20.0, 18.0],
        [20.0, 10.0, 24.0, 10.0],
        [24.9, 10.0, 30.0, 10.0],
    ];
    let offices = || (0..5).map(|k| 6.0 * f64::from(k));
    for x in offices() {
        inner.extend([[x, 7.0, x + 1.2, 7.0], [x + 2.1, 7.0, x + 6.0, 7.0], [x, 0.0, x, 7.0]]);
    }
    canvas.fill(&walls(&outer, 0.35), BLACK);
    canvas.fill(&walls(&inner, 0.15), BLACK);
    for x in offices() {
        canvas.fill(&[rectangle([x + 2.0, -0.18], [x + 4.5, 0.18])], [228; 3]);
        let pane = |off: f64| line([x + 2.0, off], [x + 4.5, off], 0.045);
        canvas.fill(&[-0.15, 0.0, 0.15].map(pane), BLACK);
        let swing = arc([x + 1.2, 6.93], 0.9, -FRAC_PI_2, 0.0);
        canvas.fill(&lines(&[&[[x + 1.2, 6.93]], swing.as_slice()].concat(), 0.045), BLACK);
        canvas.fill(&text("OFFICE", [x + 3.2, 4.0], 0.45, 0.05), BLACK);
    }
    let (width, height) = (canvas.width, canvas.height);
    for at in (0..width * height).filter(|at| at % width < 14 || at / width >= height - 10) {
        canvas.pixels[at] = [60.0; 3];
    }
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * 34.0;
    assert!((0.85..1.15).contains(&scale), "the scale is {scale} times the true one");
    assert_eq!([plan.doors.len(), plan.windows.len(), plan.furniture.len()], [8, 5, 0]);
}

/// A visitors' map has areas of colour and no walls: the paper around was floor, the numbers were walls.
#[test]
fn light_lines_between_areas_of_colour_are_walls() {
    let mut canvas = Canvas::new([40.0, 26.0], [-3.0, -3.0], 20.0, 0.0, [255; 3]);
    let tones = [[248, 210, 160], [190, 215, 235], [205, 230, 190], [235, 200, 220]];
    let rooms = [
        [[0.0, 0.0], [10.0, 9.0]],
        [[10.4, 0.0], [22.0, 9.0]],
        [[22.4, 0.0], [34.0, 9.0]],
        [[0.0, 9.4], [16.0, 20.0]],
        [[16.4, 9.4], [34.0, 20.0]],
    ];
    for (k, [min, max]) in rooms.into_iter().enumerate() {
        canvas.fill(&[rectangle(min, max)], tones[k % tones.len()]);
        canvas.fill(&text(&format!("{}", k + 1), [min[0] + 4.0, min[1] + 4.5], 1.0, 0.15), [90; 3]);
    }
    let doors = [
        [[9.9, 3.0], [10.5, 5.0]],
        [[21.9, 3.0], [22.5, 5.0]],
        [[4.0, 8.9], [6.0, 9.5]],
        [[26.0, 8.9], [28.0, 9.5]],
        [[15.9, 13.0], [16.5, 15.0]],
    ];
    for [min, max] in doors {
        canvas.fill(&[rectangle(min, max)], tones[0]);
    }
    canvas.fill(&text("LEVEL 1", [17.0, -1.6], 0.8, 0.12), [90; 3]);
    let plan = canvas.read(Some(0.05));
    assert_eq!(plan.doors.len(), doors.len());
    for [min, max] in rooms {
        let floor = canvas.floor_in(&plan, [[min[0] + 0.1, min[1] + 0.1], [max[0] - 0.1, max[1] - 0.1]]);
        assert!(floor > 0.99, "{floor} of the room at {min:?} is floor");
    }
    let around = canvas.floor_in(&plan, [[-2.9, -2.9], [36.9, -0.5]]);
    assert!(around < 0.01, "{around} of the paper is floor");
}

/// Two floors on one sheet are no rooms that nothing joins; the line on which one walks halves the treads of stairs.
#[test]
fn two_floors_on_one_sheet_have_doors_windows_and_stairs() {
    let mut canvas = Canvas::new([47.0, 15.0], [-1.5, -1.5], 30.0, 0.0, [255; 3]);
    let flight = |x: f64| [[x + 17.9, 7.4], [x + 19.7, 10.2]];
    for (x, has_entrance) in [(0.0, true), (24.0, false)] {
        let outer = [[0.0, 0.0, 20.0, 0.0], [10.2, 12.0, 20.0, 12.0], [0.0, 0.0, 0.0, 12.0], [20.0, 0.0, 20.0, 12.0]];
        let inner = [
            [7.0, 0.0, 7.0, 2.0],
            [7.0, 2.9, 7.0, 5.0],
            [13.0, 0.0, 13.0, 5.0],
            [0.0, 5.0, 3.0, 5.0],
            [3.9, 5.0, 16.0, 5.0],
            [16.9, 5.0, 20.0, 5.0],
        ];
        let moved = |lines: &[[f64; 4]]| lines.iter().map(|l| [l[0] + x, l[1], l[2] + x, l[3]]).collect::<Vec<_>>();
        let front = if has_entrance { [x, 12.0, x + 9.0, 12.0] } else { [x, 12.0, x + 20.0, 12.0] };
        canvas.fill(&walls(&moved(&outer), 0.3), BLACK);
        canvas.fill(&walls(&[front], 0.3), BLACK);
        canvas.fill(&walls(&moved(&inner), 0.14), BLACK);
        for (hinge, along) in [([x + 7.0, 2.0], 0.0), ([x + 3.0, 5.0], -FRAC_PI_2), ([x + 16.0, 5.0], -FRAC_PI_2)] {
            let swing = arc(hinge, 0.9, along, along + FRAC_PI_2);
            canvas.fill(&lines(&[&[hinge], swing.as_slice()].concat(), 0.04), BLACK);
        }
        for window in [x + 2.0, x + 9.0, x + 15.0] {
            canvas.fill(&[rectangle([window, -0.15], [window + 2.0, 0.15])], [255; 3]);
            let pane = |off: f64| line([window, off], [window + 2.0, off], 0.04);
            canvas.fill(&[-0.13, 0.0, 0.13].map(pane), BLACK);
        }
        let [min, max] = flight(x);
        let middle = 0.5 * (min[0] + max[0]);
        for tread in (0..=10).map(|k| min[1] + 0.28 * f64::from(k)) {
            canvas.fill(&[line([min[0], tread], [max[0], tread], 0.04)], BLACK);
        }
        canvas.fill(&outline(&rectangle(min, max), 0.04), BLACK);
        canvas.fill(&[line([middle, min[1]], [middle, max[1]], 0.04)], BLACK);
    }
    let plan = canvas.read(Some(1.0 / 30.0));
    assert_eq!([plan.doors.len(), plan.windows.len()], [7, 6]);
    let stairs = plan.classes.iter().filter(|&&class| class == PlanClass::Stairs).count() as f64 / 900.0;
    // People come to the upper floor by its stairs.
    assert!((0.8 * 10.08..1.15 * 10.08).contains(&stairs), "{stairs} m2 of stairs");
    let above = canvas.floor_in(&plan, [[24.5, 5.5], [43.0, 6.8]]);
    assert!(above > 0.99, "{above} of the upper hall is floor");
}
