//! Large single rooms: a church with massive walls and a scale bar, a shop with racks and no scale at all, a hall with the lines of a
//! court, a bent bar, a store with gates.

use std::f64::consts::{FRAC_PI_2, PI};

use super::canvas::{Canvas, Point, arc, ellipse, line, lines, outline, rectangle, text};

const INK: [u8; 3] = [0; 3];

fn grown([min, max]: [Point; 2], by: f64) -> [Point; 2] {
    [min.map(|v| v - by), max.map(|v| v + by)]
}

/// Walls of 1.2 m filled with grey, buttresses, windows and a portal in them, columns, pews, an apse; the only scale is a bar.
#[test]
fn a_church_has_one_portal_and_windows_only_in_its_walls() {
    const WALL: f64 = 1.2;
    const GREY: [u8; 3] = [90; 3];
    let mut canvas = Canvas::new([52.0, 31.0], [-4.0, -5.0], 25.0, 0.0, [255; 3]);
    let mut mass = |polygon: &Vec<Point>| {
        canvas.fill(std::slice::from_ref(polygon), GREY);
        canvas.fill(&outline(polygon, 0.08), INK);
    };
    let bays = (0..7).map(|k| 4.0 + 5.2 * f64::from(k));
    bays.clone().for_each(|x| mass(&rectangle([x, -1.0], [x + 1.2, 17.0])));
    mass(&ellipse([36.0, 8.0], [8.0, 8.0]));
    mass(&rectangle([0.0, 0.0], [36.0, 16.0]));
    canvas.fill(&[ellipse([36.0, 8.0], [6.8, 6.8]), rectangle([WALL, WALL], [36.2, 16.0 - WALL])], [255; 3]);
    let nave = [[1.5, 1.5], [35.0, 14.5]];
    let windows: Vec<[Point; 2]> =
        bays.take(6).flat_map(|x| [0.0, 16.0 - WALL].map(|y| [[x + 2.4, y], [x + 4.0, y + WALL]])).collect();
    for &[min, max] in &windows {
        canvas.fill(&[rectangle([min[0], min[1] - 0.05], [max[0], max[1] + 0.05])], [255; 3]);
        canvas.fill(&outline(&rectangle(min, max), 0.08), INK);
        for y in [0.4, 0.8].map(|y| min[1] + y) {
            canvas.fill(&[line([min[0], y], [max[0], y], 0.05)], INK);
        }
    }
    canvas.fill(&[rectangle([-0.1, 6.9], [WALL + 0.1, 9.1])], [255; 3]);
    let columns: Vec<Point> = (0..6).flat_map(|k| [4.8, 11.2].map(|y| [6.0 + 5.2 * f64::from(k), y])).collect();
    for &at in &columns {
        canvas.fill(&[ellipse(at, [0.55, 0.55])], GREY);
    }
    for k in 0..20 {
        let x = 7.2 + 1.1 * f64::from(k);
        for y in [5.6, 8.6] {
            canvas.fill(&outline(&rectangle([x, y], [x + 0.5, y + 1.8]), 0.05), INK);
        }
    }
    canvas.fill(&text("ST MARY", [20.0, 20.0], 0.8, 0.1), INK);
    canvas.fill(&lines(&[[1.2, 22.8], [11.2, 22.8]], 0.08), INK);
    for (x, number) in [(1.2, "0"), (6.2, "5"), (11.2, "10")] {
        canvas.fill(&[line([x, 22.5], [x, 23.1], 0.08)], INK);
        canvas.fill(&text(number, [x, 23.7], 0.5, 0.08), INK);
    }
    canvas.fill(&text("m", [12.2, 23.7], 0.5, 0.08), INK);
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel;
    assert!((scale * 25.0 - 1.0).abs() < 0.02, "{scale} m per pixel");
    assert_eq!((plan.doors.len(), plan.windows.len()), (1, 12), "{:?}", plan.doors);
    let share = |place| canvas.floor_in(&plan, place);
    assert!(share(nave) > 0.85, "{} of the nave", share(nave));
    let closed = windows.iter().map(|&place| share(grown(place, -0.2))).fold(0.0, f64::max);
    assert!(closed < 0.01, "{closed} of a window is floor");
    // Between the columns across the nave, where the aisle between the pews is.
    let aisle = share([[5.5, 7.6], [32.5, 8.4]]);
    assert!(aisle > 0.99, "{aisle} of the aisle");
    assert!(share([[2.0, 17.3], [40.0, 25.0]]) < 0.01, "paper is floor");
}

/// A hall with a door, windows and six columns as thick as its walls; steps and a rail run from column to column.
#[test]
fn steps_between_columns_are_no_windows() {
    let mut canvas = Canvas::new([26.0, 16.0], [-3.0, -3.0], 40.0, 0.0, [255; 3]);
    for [min, max] in [
        [[-0.5, -0.5], [20.5, 0.0]],
        [[-0.5, 10.0], [20.5, 10.5]],
        [[-0.5, 0.0], [0.0, 10.0]],
        [[20.0, 0.0], [20.5, 10.0]],
    ] {
        canvas.fill(&[rectangle(min, max)], INK);
    }
    for x in [3.0, 9.0, 15.0] {
        canvas.window([x, 10.0], [x + 2.0, 10.5], 0.05);
    }
    canvas.fill(&[rectangle([5.0, -0.55], [5.9, 0.05])], [255; 3]);
    canvas.fill(&lines(&[arc([5.0, 0.0], 0.9, 0.0, FRAC_PI_2).as_slice(), &[[5.0, 0.0]]].concat(), 0.05), INK);
    for x in [6.0, 11.0, 16.0] {
        [3.0, 7.0].into_iter().for_each(|y| canvas.fill(&[ellipse([x, y], [0.25, 0.25])], INK));
        let beside = [-0.15, 0.15].map(|by| line([x + by, 3.0], [x + by, 7.0], 0.04));
        canvas.fill(&beside, INK);
    }
    let plan = canvas.read(Some(0.025));
    assert_eq!((plan.doors.len(), plan.windows.len()), (1, 3), "{:?}, {:?}", plan.doors, plan.windows);
}

/// Pale racks of 14 m in a row, checkouts, no door with a leaf: whatever the scale is taken for, people go round the racks.
#[test]
fn racks_of_a_shop_are_no_floor() {
    let mut canvas = Canvas::new([44.0, 30.0], [-3.0, -4.0], 30.0, 0.0, [255; 3]);
    canvas.fill(&[rectangle([0.0, 0.0], [38.0, 24.0])], [245, 245, 240]);
    canvas.fill(&outline(&rectangle([0.0, 0.0], [38.0, 24.0]), 0.3), [60; 3]);
    for x in [4.0, 30.0] {
        canvas.fill(&[rectangle([x, 23.5], [x + 3.0, 24.5])], [255; 3]);
    }
    let colours = [[200, 225, 190], [250, 220, 180], [190, 215, 240], [240, 200, 200]];
    let racks: Vec<[Point; 2]> =
        (0..8).map(|k| 3.4 + 3.0 * f64::from(k)).map(|x| [[x, 3.0], [x + 1.3, 17.0]]).collect();
    for (k, &[min, max]) in racks.iter().enumerate() {
        canvas.fill(&[rectangle(min, max)], colours[k % 4]);
        canvas.fill(&outline(&rectangle(min, max), 0.04), [120; 3]);
        canvas.fill(&text(&(k + 1).to_string(), [min[0] + 0.65, 10.0], 0.6, 0.08), [60; 3]);
        let checkout = rectangle([min[0] + 2.0, 19.5], [min[0] + 2.9, 22.0]);
        canvas.fill(std::slice::from_ref(&checkout), [220; 3]);
        canvas.fill(&outline(&checkout, 0.04), [120; 3]);
    }
    let plan = canvas.read(None);
    let share = |place| canvas.floor_in(&plan, place);
    for (k, &[min, max]) in racks.iter().enumerate() {
        let (rack, aisle) = (share(grown([min, max], -0.1)), share([[max[0] + 0.2, 3.0], [max[0] + 1.5, 17.0]]));
        assert!(rack < 0.01 && aisle > 0.99, "rack {k}: {rack} is floor, {aisle} beside it");
    }
}

/// The circle in the middle of a court is painted on the floor, a bar of the same depth all along its bend stands on it.
#[test]
fn lines_of_a_court_are_floor_and_a_bent_bar_is_none() {
    let mut canvas = Canvas::new([46.0, 26.0], [-3.0, -3.0], 30.0, 0.0, [255; 3]);
    canvas.fill(&outline(&rectangle([0.0, 0.0], [40.0, 20.0]), 0.3), INK);
    canvas.fill(&[rectangle([18.0, 19.0], [20.0, 21.0])], [255; 3]);
    let thin = 0.04;
    canvas.fill(&outline(&rectangle([2.0, 2.0], [26.0, 16.0]), thin), INK);
    canvas.fill(&[line([14.0, 2.0], [14.0, 16.0], thin)], INK);
    canvas.fill(&outline(&ellipse([14.0, 9.0], [1.8, 1.8]), thin), INK);
    let (corner, turn) = ([36.0, 16.0], std::f64::consts::PI);
    let mut bar = arc(corner, 3.0, turn, 1.5 * turn);
    bar.extend(arc(corner, 2.45, turn, 1.5 * turn).into_iter().rev());
    canvas.fill(&outline(&bar, thin), INK);
    let plan = canvas.read(Some(1.0 / 30.0));
    let share = |place| canvas.floor_in(&plan, place);
    let circle = share([[12.5, 7.5], [15.5, 10.5]]);
    assert!(circle > 0.99, "{circle} of the circle");
    for at in arc(corner, 2.72, 1.05 * turn, 1.45 * turn) {
        let of_bar = share([at.map(|v| v - 0.1), at.map(|v| v + 0.1)]);
        assert!(of_bar < 0.01, "{of_bar} of the bar at {at:?}");
    }
    assert!(share([[34.8, 14.8], [37.0, 17.0]]) > 0.99, "behind the bar");
}

/// Six gates that are closed by a single line each, racks, and one door with a leaf, which is told to be a door by it.
#[test]
fn one_leaf_tells_the_gates_of_a_store_from_doors() {
    const PX_PER_M: f64 = 16.0;
    let mut canvas = Canvas::new([78.0, 52.0], [-4.0, -4.0], PX_PER_M, 0.0, [255; 3]);
    let wall = 0.38;
    canvas.fill(&outline(&rectangle([0.0, 0.0], [70.0, 44.0]), wall), INK);
    let gates: Vec<[Point; 2]> =
        (0..6).map(|k| 6.0 + 9.0 * f64::from(k)).map(|x| [[x, 44.0 - wall], [x + 3.0, 44.0 + wall]]).collect();
    for &[min, max] in &gates {
        canvas.fill(&[rectangle(min, max)], [255; 3]);
        canvas.fill(&[line([min[0], 44.0], [max[0], 44.0], 0.06)], INK);
    }
    let racks: Vec<[Point; 2]> =
        (0..9).map(|k| 6.0 + 6.0 * f64::from(k)).map(|x| [[x, 4.0], [x + 2.2, 30.0]]).collect();
    for &[min, max] in &racks {
        canvas.fill(&outline(&rectangle(min, max), 0.06), INK);
        canvas.fill(&[line([min[0] + 1.1, 4.0], [min[0] + 1.1, 30.0], 0.06)], INK);
        for y in (1..10).map(|k| 4.0 + 2.6 * f64::from(k)) {
            canvas.fill(&[line([min[0], y], [max[0], y], 0.06)], INK);
        }
    }
    canvas.fill(&[rectangle([58.0, 32.0], [58.25, 44.0]), rectangle([58.0, 32.0], [70.0, 32.25])], INK);
    canvas.fill(&[rectangle([57.9, 36.0], [58.3, 36.9])], [255; 3]);
    let swing = arc([58.0, 36.0], 0.9, FRAC_PI_2, PI);
    canvas.fill(&lines(&[&*swing, &[[58.0, 36.0]]].concat(), 0.06), INK);
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * PX_PER_M;
    assert!((0.85..1.15).contains(&scale), "{scale} of the true scale");
    let wide = plan.doors.iter().filter(|door| door.width_m() > 2.0).count();
    assert_eq!((wide, plan.doors.len(), plan.windows.len()), (6, 7, 0));
    for (k, &[min, max]) in racks.iter().enumerate() {
        let share = |place| canvas.floor_in(&plan, place);
        let (rack, aisle) = (share(grown([min, max], -0.2)), share([[max[0] + 0.4, 4.0], [max[0] + 3.4, 30.0]]));
        assert!(rack < 0.01 && aisle > 0.99, "rack {k}: {rack} is floor, {aisle} beside it");
    }
}
