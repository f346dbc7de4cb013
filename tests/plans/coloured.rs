//! Small buildings whose strokes have the colours of layers, and whose floors are filled by lines.

use std::f64::consts::FRAC_PI_2;

use trodden::plan::PlanClass;

use super::canvas::{Canvas, Point, arc, line, lines, outline, rectangle};

/// Colours of the paper, walls, doors, windows and furniture.
struct Layers {
    paper: [u8; 3],
    wall: [u8; 3],
    door: [u8; 3],
    window: [u8; 3],
    furniture: [u8; 3],
}

const PLAIN: Layers = Layers { paper: [255; 3], wall: [0; 3], door: [60; 3], window: [60; 3], furniture: [60; 3] };
const PX_PER_M: f64 = 36.0;
/// Thickness of strokes.
const FINE_M: f64 = 0.03;
/// Rooms above a corridor of the whole length: least and greatest corner, inside.
const ROOMS: [[Point; 2]; 3] = [[[0.1, 0.1], [5.9, 5.9]], [[6.1, 0.1], [11.9, 5.9]], [[12.1, 0.1], [17.9, 5.9]]];
const CORRIDOR: [Point; 2] = [[0.1, 6.1], [17.9, 8.9]];

/// Draws three rooms with a door, a window, a desk and a seat each, and a corridor with an entrance. `is_outline` draws
/// walls as outlines; floors named by `hatched` are filled with lines `pitch` metres apart, `turn` radians off the level.
fn draw(layers: &Layers, is_outline: bool, hatched: &[[Point; 2]], pitch: f64, turn: f64) -> Canvas {
    let mut canvas = Canvas::new([24.0, 15.0], [-3.0, -3.0], PX_PER_M, 0.0, layers.paper);
    for &[min, max] in hatched {
        let (sine, cosine) = turn.sin_cos();
        let middle = [0, 1].map(|k| 0.5 * (min[k] + max[k]));
        let count = (20.0 / pitch) as i32;
        for off in (-count..=count).map(|k| f64::from(k) * pitch) {
            let at = [middle[0] - sine * off, middle[1] + cosine * off];
            let end = |sign: f64| [at[0] + sign * 20.0 * cosine, at[1] + sign * 20.0 * sine];
            if let Some([a, b]) = clipped([end(-1.0), end(1.0)], min, max) {
                canvas.fill(&[line(a, b, FINE_M)], [110; 3]);
            }
        }
    }
    let half = 0.15;
    let outer = [
        [-half, -half, 18.0 + half, half],
        [-half, 9.0 - half, 8.0, 9.0 + half],
        [9.6, 9.0 - half, 18.0 + half, 9.0 + half],
        [-half, half, half, 9.0 - half],
        [18.0 - half, half, 18.0 + half, 9.0 - half],
    ];
    let mut inner = vec![[6.0 - 0.07, half, 6.0 + 0.07, 5.93], [12.0 - 0.07, half, 12.0 + 0.07, 5.93]];
    for x in [0.0, 6.0, 12.0] {
        let [from, to] = [if x == 0.0 { half } else { x }, if x == 12.0 { 18.0 - half } else { x + 6.0 }];
        inner.extend([[from, 5.93, x + 3.0, 6.07], [x + 3.9, 5.93, to, 6.07]]);
    }
    for [x0, y0, x1, y1] in outer.into_iter().chain(inner) {
        let wall = rectangle([x0, y0], [x1, y1]);
        match is_outline {
            true => canvas.fill(&outline(&wall, FINE_M), layers.wall),
            false => canvas.fill(&[wall], layers.wall),
        }
    }
    for x in [0.0, 6.0, 12.0] {
        canvas.fill(&[rectangle([x + 2.0, -half - 0.02], [x + 3.8, half + 0.02])], layers.paper);
        for end in [x + 2.0, x + 3.8] {
            canvas.fill(&[line([end, -half], [end, half], FINE_M)], layers.wall);
        }
        canvas.fill(&[-half, 0.0, half].map(|y| line([x + 2.0, y], [x + 3.8, y], FINE_M)), layers.window);
        let swing = arc([x + 3.0, 5.93], 0.9, -FRAC_PI_2, 0.0);
        canvas.fill(&lines(&[&[[x + 3.0, 5.93]], swing.as_slice()].concat(), FINE_M), layers.door);
        for piece in [rectangle([x + 2.2, 1.2], [x + 3.8, 2.0]), rectangle([x + 2.8, 2.2], [x + 3.25, 2.65])] {
            canvas.fill(std::slice::from_ref(&piece), layers.paper);
            canvas.fill(&outline(&piece, FINE_M), layers.furniture);
        }
    }
    canvas
}

/// The part of a line within a rectangle.
fn clipped([a, b]: [Point; 2], min: Point, max: Point) -> Option<[Point; 2]> {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for k in 0..2 {
        let way = b[k] - a[k];
        if way.abs() < 1e-9 {
            if a[k] < min[k] || a[k] > max[k] {
                return None;
            }
            continue;
        }
        let [s, t] = [(min[k] - a[k]) / way, (max[k] - a[k]) / way];
        (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
    }
    let at = |share: f64| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
    (from < to).then(|| [at(from), at(to)])
}

fn check(canvas: &Canvas, what: &str) {
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * PX_PER_M;
    assert!((0.88..1.12).contains(&scale), "{what}: the scale is {scale} times the true one");
    assert_eq!([plan.doors.len(), plan.windows.len()], [4, 3], "{what}: doors and windows");
    let standing = plan.furniture.iter().map(|piece| piece.area_m2 / (scale * scale)).sum::<f64>();
    let drawn = 3.0 * (1.6 * 0.8 + 0.45 * 0.45);
    assert!((0.8 * drawn..1.35 * drawn).contains(&standing), "{what}: {standing} m2 of furniture");
    let is_free = |at: usize| plan.floor[at] != 0 || plan.classes[at].is_furniture();
    for [min, max] in ROOMS.into_iter().chain([CORRIDOR]) {
        let ([x0, y0], [x1, y1]) = (canvas.px(min), canvas.px(max));
        let rows = y0.ceil() as usize..y1 as usize;
        let within = rows.flat_map(|y| (x0.ceil() as usize..x1 as usize).map(move |x| y * canvas.width + x));
        let free = within.clone().filter(|&at| is_free(at)).count() as f64 / within.count() as f64;
        assert!(free > 0.95, "{what}: {free} of the room at {min:?} is floor or furniture");
    }
    assert!(plan.classes.iter().all(|&class| class != PlanClass::Stairs), "{what}: no stairs are drawn");
}

/// Doors in yellow and windows in cyan did not count for the scale: walls and gaps of windows were guessed by.
#[test]
fn drawings_with_a_colour_for_each_layer_have_a_scale() {
    let dark = Layers {
        paper: [33, 40, 48],
        wall: [255; 3],
        door: [255, 255, 0],
        window: [0, 255, 255],
        furniture: [0, 200, 0],
    };
    let light =
        Layers { paper: [255; 3], wall: [0; 3], door: [0, 0, 255], window: [0, 160, 160], furniture: [0, 140, 0] };
    let red = Layers { wall: [170, 60, 45], door: [60, 90, 150], window: [60, 90, 150], ..light };
    for (layers, is_outline, what) in [
        (&dark, true, "outlines on dark"),
        (&dark, false, "filled walls on dark"),
        (&light, false, "filled walls on white"),
        (&red, false, "red walls"),
    ] {
        check(&draw(layers, is_outline, &[], 1.0, 0.0), what);
    }
}

/// Rooms that a hatch marks, and planks without joints, were desks, stairs and closed rooms.
#[test]
fn floors_that_are_filled_by_lines_are_floors() {
    let turn = |degrees: f64| degrees.to_radians();
    for (hatched, pitch, degrees, what) in [
        (&ROOMS[..1], 0.25, 45.0, "a hatched room"),
        (&[CORRIDOR][..], 0.18, -45.0, "a hatched corridor"),
        (&ROOMS[1..], 0.3, 30.0, "two rooms hatched at 30 degrees"),
        (&ROOMS[..], 0.14, 0.0, "level planks"),
        (&ROOMS[..2], 0.16, 90.0, "upright planks"),
    ] {
        check(&draw(&PLAIN, false, hatched, pitch, turn(degrees)), what);
    }
}

/// Pairs of desks were beds. A bed has a field for its pillow.
#[test]
fn pairs_of_desks_are_tables_and_beds_are_none() {
    let mut canvas = draw(&PLAIN, false, &[], 1.0, 0.0);
    let mut lay = |min: Point, max: Point, across: [Point; 2]| {
        canvas.fill(&outline(&rectangle(min, max), FINE_M), PLAIN.furniture);
        canvas.fill(&[line(across[0], across[1], FINE_M)], PLAIN.furniture);
    };
    lay([7.0, 3.2], [8.6, 4.8], [[7.0, 4.0], [8.6, 4.0]]);
    lay([9.6, 3.2], [11.2, 4.8], [[10.4, 3.2], [10.4, 4.8]]);
    lay([15.4, 3.6], [17.4, 4.5], [[15.85, 3.6], [15.85, 4.5]]);
    let plan = canvas.read(None);
    for (place, class) in
        [([7.8, 3.6], PlanClass::Table), ([10.0, 4.2], PlanClass::Table), ([16.4, 4.2], PlanClass::Seat)]
    {
        let [x, y] = canvas.px(place).map(|px| px as usize);
        assert_eq!(plan.classes[y * canvas.width + x], class, "at {place:?}");
    }
}

/// The pale blue of a bath's floor is that of panes elsewhere. A leaf swings over it and cuts a part off.
#[test]
fn a_bath_with_a_pale_blue_floor_is_walked() {
    const BLUE: [u8; 3] = [230, 245, 255];
    let mut canvas = Canvas::new([12.0, 8.0], [-2.0, -2.0], 60.0, 0.0, [255; 3]);
    let grey = [111; 3];
    let rooms = [[[0.0, 0.0], [4.0, 4.0]], [[4.0, 0.0], [5.8, 4.0]], [[5.8, 0.0], [8.0, 4.0]]];
    for ([min, max], floor) in rooms.into_iter().zip([[255; 3], BLUE, [251, 247, 230]]) {
        canvas.fill(&[rectangle(min, max)], floor);
        canvas.fill(&outline(&rectangle(min, max), 0.2), grey);
    }
    for ([x, y], width) in [([4.0, 0.9], 0.9), ([5.8, 0.6], 0.8), ([0.0, 1.5], 1.0)] {
        canvas.fill(&[rectangle([x - 0.13, y], [x + 0.13, y + width])], [255; 3]);
        let swing = arc([x, y], width, 0.0, FRAC_PI_2);
        canvas.fill(&lines(&[&[[x, y]], &*swing].concat(), 0.025), grey);
    }
    for (min, max) in [([4.25, 2.9], [4.7, 3.6]), ([4.85, 2.9], [5.68, 3.75])] {
        canvas.fill(&[rectangle(min, max)], [255; 3]);
        canvas.fill(&outline(&rectangle(min, max), 0.025), grey);
    }
    let plan = canvas.read(None);
    assert!((plan.metres_per_pixel * 60.0 - 1.0).abs() < 0.1, "{}", plan.metres_per_pixel);
    assert_eq!((plan.doors.len(), plan.windows.len()), (3, 0));
    // Under the leaf too.
    for place in [[[4.15, 0.15], [5.65, 2.7]], [[5.95, 0.15], [7.85, 3.85]], [[0.15, 0.15], [3.85, 3.85]]] {
        let share = canvas.floor_in(&plan, place);
        assert!(share > 0.97, "{share} of {place:?}");
    }
}

/// Rooms as rectangles of thin lines, with bars of brown and blue over them for doors and windows, as programs that write SVG
/// draw them: bars were walls, and their soft edges too. The scale was assumed, and the round corners of furniture took
/// its sides for dimensions.
#[test]
fn bars_of_colour_over_thin_lines_are_doors_and_windows() {
    const WALL: [u8; 3] = [51; 3];
    let rooms: [([f64; 4], [u8; 3]); 6] = [
        ([0.0, 0.0, 5.0, 4.4], [253, 243, 225]),
        ([5.0, 0.0, 8.2, 2.8], [227, 242, 253]),
        ([8.2, 0.0, 11.0, 2.8], [224, 247, 250]),
        ([5.0, 2.8, 11.0, 4.4], [245; 3]),
        ([0.0, 4.4, 5.4, 8.0], [243, 229, 245]),
        ([5.4, 4.4, 11.0, 8.0], [232, 245, 233]),
    ];
    // Where bars begin, whether they run upward, and how long they are.
    let doors = [([5.0, 3.1], true, 0.9), ([6.2, 2.8], false, 0.9), ([9.0, 2.8], false, 0.8)];
    let doors = [&doors[..], &[([2.2, 4.4], false, 0.9), ([7.0, 4.4], false, 0.9), ([11.0, 3.1], true, 1.0)]].concat();
    let windows =
        [([1.4, 0.0], false, 2.0), ([5.8, 0.0], false, 1.4), ([11.0, 0.8], true, 1.2), ([0.0, 1.2], true, 2.0)];
    let windows = [&windows[..], &[([1.6, 8.0], false, 1.8), ([7.4, 8.0], false, 1.8)]].concat();
    let furniture = [[0.5, 0.6, 1.3, 2.4], [2.2, 1.2, 3.4, 2.0], [5.2, 0.15, 7.9, 0.75], [6.6, 6.1, 8.2, 7.8]];
    for px_per_m in [60.0, 80.0, 110.0] {
        let mut canvas = Canvas::new([15.0, 12.0], [-2.0, -2.0], px_per_m, 0.0, [255; 3]);
        for (room, floor) in rooms {
            let shape = rectangle([room[0], room[1]], [room[2], room[3]]);
            canvas.fill(std::slice::from_ref(&shape), floor);
        }
        for (room, _) in rooms {
            canvas.fill(&outline(&rectangle([room[0], room[1]], [room[2], room[3]]), 0.05), WALL);
        }
        for [x0, y0, x1, y1] in furniture {
            // Corners of 8 cm.
            let corners =
                [[x1 - 0.08, y1 - 0.08], [x0 + 0.08, y1 - 0.08], [x0 + 0.08, y0 + 0.08], [x1 - 0.08, y0 + 0.08]];
            let turns = [0.0, 1.0, 2.0, 3.0].map(|k| k * FRAC_PI_2);
            let round: Vec<Point> =
                corners.into_iter().zip(turns).flat_map(|(at, turn)| arc(at, 0.08, turn, turn + FRAC_PI_2)).collect();
            canvas.fill(std::slice::from_ref(&round), [215, 204, 200]);
            canvas.fill(&outline(&round, 0.02), [136; 3]);
        }
        for (bars, colour, thick) in [(&doors, [139, 69, 19], 0.08), (&windows, [79, 195, 247], 0.08)] {
            for &([x, y], is_upright, length) in bars {
                let end = if is_upright { [x, y + length] } else { [x + length, y] };
                canvas.fill(&[line([x, y], end, thick)], colour);
            }
        }
        let plan = canvas.read(None);
        let scale = plan.metres_per_pixel * px_per_m;
        assert!((0.88..1.12).contains(&scale), "{px_per_m} px/m: the scale is {scale} times the true one");
        assert_eq!([plan.doors.len(), plan.windows.len()], [doors.len(), windows.len()], "{px_per_m} px/m");
        let standing = plan.furniture.iter().map(|piece| piece.area_m2 / (scale * scale)).sum::<f64>();
        let drawn: f64 = furniture.iter().map(|[x0, y0, x1, y1]| (x1 - x0) * (y1 - y0)).sum();
        assert!((0.8 * drawn..1.2 * drawn).contains(&standing), "{px_per_m} px/m: {standing} of {drawn} m2 stand");
        for ([x0, y0, x1, y1], _) in rooms {
            let taken: f64 = (furniture.iter().filter(|f| f[0] > x0 && f[2] < x1 && f[1] > y0 && f[3] < y1))
                .map(|[a, b, c, d]| (c - a) * (d - b))
                .sum();
            let share = canvas.floor_in(&plan, [[x0 + 0.1, y0 + 0.1], [x1 - 0.1, y1 - 0.1]]);
            let free = 1.0 - taken / ((x1 - x0 - 0.2) * (y1 - y0 - 0.2));
            assert!(
                (share - free).abs() < 0.08,
                "{px_per_m} px/m: {share}, not {free}, of the room at {x0} {y0} is floor"
            );
        }
    }
}

/// As a museum's map: rooms in pale colours between walls of mid grey, openings without doors, a hall behind a wide entrance.
#[test]
fn grey_walls_between_coloured_rooms_are_walls_and_narrow_openings_tell_the_scale() {
    const PX_PER_M: f64 = 30.0;
    const WALL: [u8; 3] = [140, 141, 144];
    let mut canvas = Canvas::new([42.0, 30.0], [-3.0, -3.0], PX_PER_M, 0.0, [250, 250, 248]);
    // Three galleries above, two beside the hall, a shop and three small rooms.
    let rooms: [([Point; 2], [u8; 3]); 10] = [
        ([[0.0, 0.0], [12.0, 8.0]], [213, 232, 245]),
        ([[12.0, 0.0], [24.0, 8.0]], [224, 242, 216]),
        ([[24.0, 0.0], [36.0, 8.0]], [250, 218, 222]),
        ([[0.0, 8.0], [12.0, 16.0]], [252, 226, 202]),
        ([[12.0, 8.0], [24.0, 24.0]], [242, 240, 235]),
        ([[24.0, 8.0], [36.0, 16.0]], [254, 242, 196]),
        ([[0.0, 16.0], [12.0, 24.0]], [240, 228, 214]),
        ([[24.0, 16.0], [28.0, 24.0]], [232, 240, 224]),
        ([[28.0, 16.0], [32.0, 24.0]], [224, 232, 242]),
        ([[32.0, 16.0], [36.0, 24.0]], [230, 230, 230]),
    ];
    for ([min, max], colour) in rooms {
        canvas.fill(&[rectangle(min, max)], colour);
    }
    for ([min, max], _) in rooms {
        canvas.fill(&outline(&rectangle(min, max), 0.5), WALL);
    }
    // Middle, half the width, and whether the wall runs along the rows; the entrance last.
    let openings = [
        ([12.0, 4.0], 1.2, false),
        ([24.0, 4.0], 1.2, false),
        ([6.0, 8.0], 1.2, true),
        ([18.0, 8.0], 1.2, true),
        ([30.0, 8.0], 1.2, true),
        ([12.0, 12.0], 1.2, false),
        ([24.0, 12.0], 1.2, false),
        ([12.0, 20.0], 1.2, false),
        ([24.0, 20.0], 0.55, false),
        ([30.0, 16.0], 0.55, true),
        ([34.0, 16.0], 0.55, true),
        ([32.0, 22.0], 0.55, false),
        ([18.0, 24.0], 2.2, true),
    ];
    for ([x, y], half, is_level) in openings {
        let reach = if is_level { [half, 0.26] } else { [0.26, half] };
        canvas.fill(&[rectangle([x - reach[0], y - reach[1]], [x + reach[0], y + reach[1]])], [242, 240, 235]);
    }
    let plan = canvas.read(None);
    let scale = plan.metres_per_pixel * PX_PER_M;
    assert!((0.75..1.3).contains(&scale), "{scale:.3} times the scale: {}", plan.scale.evidence);
    let shares = rooms.map(|([min, max], _)| canvas.floor_in(&plan, [min.map(|v| v + 0.6), max.map(|v| v - 0.6)]));
    assert!(shares.iter().all(|&share| share > 0.95), "floor reached: {shares:.2?}");
    assert!(plan.doors.len() >= openings.len() - 1, "{} doors", plan.doors.len());
}
