//! Furniture, lettering and lines: what is drawn within and around a building.

use std::ops::RangeInclusive;

use super::super::PlanClass;
use super::super::components::{Component, Components, Neighbours, apart};
use super::super::symbols::{FEWEST_STROKES, groups};
use super::super::thick::{grow, open};
use super::net::Net;

/// What is known of a piece of ink or of furniture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// Bounding box: least x and y, one beyond the greatest, pixels.
    pub(super) around: [u32; 4],
    /// Number of its pixels.
    pub(super) area: usize,
    /// Share of its outline at walls.
    pub(super) at_wall: f64,
    /// Number of fields that its strokes divide it into.
    pub(super) fields: usize,
    /// Greatest number of fields of about the same size and of that of treads.
    pub(super) alike: usize,
    /// Share of it that fields in pairs of the size of desks have.
    pub(super) desks: f64,
    /// Share of its box that it fills.
    pub(super) fill: f64,
    pub(super) class: PlanClass,
}

/// Largest field of a piece of furniture, square metres, and its greatest depth, metres.
const LARGEST_FIELD_M2: f64 = 7.0;
const DEEPEST_FIELD_M: f64 = 2.6;
/// Depth and length of desks, metres, least length in depths, and least share of a piece that they have: pairs of desks, not a
/// bed with its pillows.
const DESK_DEPTH_M: RangeInclusive<f64> = 0.5..=1.0;
const DESK_LENGTH_M: RangeInclusive<f64> = 1.0..=2.2;
const DESK_SLENDER: f64 = 1.3;
const DESKS: f64 = 0.6;
/// Greatest depth and area of a row of shelves, area of rows back to back and of flights of stairs, and least share of its outline
/// that is drawn and of its box that it fills, metres and square metres.
const DEEPEST_ROW_M: f64 = 1.4;
const LARGEST_ROW_M2: f64 = 30.0;
const LARGEST_ROWS_M2: f64 = 60.0;
const ROW_STROKES: f64 = 0.9;
const ROW_FILL: f64 = 0.9;
/// Least length of a rack, in its depths, and fewest of them that are alike: rows of shelves in a shop, of which the scale may be
/// unknown.
const RACK_SLENDER: f64 = 5.0;
const FEWEST_RACKS: usize = 3;
/// Least area of furniture that is filled with a dark colour, square metres: symbols are smaller.
const LEAST_FILLED_M2: f64 = 1.2;
/// Depth from which a field between walls is a part of the room, metres.
const DEEP_M: f64 = 0.75;
/// Least side and area of a piece of furniture, metres and square metres.
const LEAST_SIDE_M: f64 = 0.3;
const LEAST_AREA_M2: f64 = 0.085;
const LARGEST_AREA_M2: f64 = 16.0;
/// Least and greatest depth of a counter that goes round a corner, and least side of the box around it, metres.
const COUNTER_DEPTH_M: [f64; 2] = [0.35, 0.85];
const LEAST_TURN_M: f64 = 1.0;
/// Greatest share of its box that a counter along two walls fills, and least share of its outline at walls.
const BENT_FILL: f64 = 0.8;
const BENT_AT_WALL: f64 = 0.35;
/// Least share of its box that a piece of furniture fills, unless it goes round a corner.
const LEAST_FILL: f64 = 0.5;

/// How far a chair may be off its table, metres.
const CHAIR_OFF_M: f64 = 0.4;
/// Least length of a tread, and of half of one, metres.
const TREAD_M: f64 = 0.7;
const HALF_TREAD_M: f64 = 0.35;
/// Largest letter, metres.
pub(super) const LARGEST_LETTER_M: f64 = 0.9;

/// What lies at a pixel.
const STROKE: u8 = 1;
const SOLID: u8 = 2;
const DOOR: u8 = 3;
const PAPER: u8 = 4;

/// What is drawn beside walls: strokes, dark pixels, and those of dark colour, 1 each.
pub(super) struct Strokes<'a> {
    pub(super) ink: &'a [u8],
    pub(super) dark: &'a [u8],
    /// Empty if there are none.
    pub(super) dark_colour: &'a [u8],
}

/// Finds furniture among the strokes inside a net, and paints it into `classes`.
pub(super) fn furniture(
    Strokes { ink, dark, dark_colour }: &Strokes,
    net: &Net,
    width: usize,
    metres_per_pixel: f64,
    classes: &mut [PlanClass],
) -> Vec<Evidence> {
    let m2 = metres_per_pixel * metres_per_pixel;
    let mut what = vec![0u8; ink.len()];
    // The blurred edge of a wall is no stroke.
    let rim = grow(&net.wall, width, 1);
    for (at, what) in what.iter_mut().enumerate() {
        *what = match () {
            () if net.wall[at] != 0 || (rim[at] != 0 && ink[at] != 0 && dark[at] == 0) => SOLID,
            () if ink[at] != 0 => STROKE,
            () if net.inside[at] == 0 => PAPER,
            () => 0,
        };
    }
    for at in net.windows.iter().flat_map(|gap| gap.pixels()) {
        what[at] = SOLID;
    }
    for at in net.doors.iter().flat_map(|gap| gap.pixels()) {
        what[at] = DOOR;
    }
    leave_out_words(&mut what, width, metres_per_pixel);
    let fields = Components::of(&what, width, 0, Neighbours::Four);
    let mut solid = vec![0u8; ink.len()];
    let mut field_of = Vec::new();
    let in_metres = |field: &Component| field.size().map(|side| f64::from(side) * metres_per_pixel);
    let is_slender = |field: &&Component| {
        let [w, h] = in_metres(field);
        w.min(h) <= DEEPEST_FIELD_M && w.max(h) >= RACK_SLENDER * w.min(h) && w * h <= LARGEST_ROWS_M2
    };
    let slender: Vec<&Component> = fields.all.iter().filter(is_slender).collect();
    let is_rack = |field: &Component| {
        is_slender(&field) && slender.iter().filter(|other| is_alike(field, other)).count() >= FEWEST_RACKS
    };
    for field in &fields.all {
        let [w, h] = in_metres(field);
        let (depth, area) = (w.min(h), field.area as f64 * m2);
        let is_large = area > LARGEST_FIELD_M2;
        if is_large && !(depth <= DEEPEST_ROW_M && area <= LARGEST_ROW_M2 || is_rack(field)) {
            continue;
        }
        // A bar that is bent.
        if depth > DEEPEST_FIELD_M && !goes_round(&fields, field, metres_per_pixel) {
            continue;
        }
        let beside = beside(&what, width, &fields, field);
        let all: usize = beside.iter().sum();
        let share = beside[usize::from(STROKE)] as f64 / all.max(1) as f64;
        let least = match () {
            () if is_large => ROW_STROKES,
            () if depth > DEEP_M => 0.48,
            () => 0.35,
        };
        let at_door = beside[usize::from(DOOR)] as f64 * metres_per_pixel > 0.1;
        if share >= least && !at_door && beside[usize::from(PAPER)] == 0 {
            fields.paint(field, &mut solid, width, 1);
            field_of.push(field);
        }
    }
    let stroke = ((0.04 / metres_per_pixel).round() as usize).max(2);
    let near = grow(&solid, width, stroke);
    for at in 0..solid.len() {
        solid[at] |= u8::from(what[at] == STROKE && near[at] != 0 && net.inside[at] != 0);
    }
    if !dark_colour.is_empty() {
        paint_filled(dark_colour, LEAST_FILLED_M2, &what, width, metres_per_pixel, &mut solid);
    }
    let strokes: Vec<u8> = what.iter().map(|&what| u8::from(what == STROKE)).collect();
    let filled = open(&strokes, width, ((LEAST_SIDE_M / metres_per_pixel).round() as usize).max(3));
    paint_filled(&filled, LEAST_AREA_M2, &what, width, metres_per_pixel, &mut solid);
    let objects = Components::of(&solid, width, 1, Neighbours::Eight);
    let mut found = Vec::new();
    for object in &objects.all {
        let [w, h] = object.size();
        let sides = [w, h].map(|side| f64::from(side) * metres_per_pixel);
        let area = object.area as f64 * m2;
        let fill = object.area as f64 / (f64::from(w) * f64::from(h));
        if sides[0].min(sides[1]) < LEAST_SIDE_M || area < LEAST_AREA_M2 {
            continue;
        }
        let within = |f: &&Component| {
            f.min[0] >= object.min[0]
                && f.min[1] >= object.min[1]
                && f.end[0] <= object.end[0]
                && f.end[1] <= object.end[1]
        };
        let parts: Vec<&Component> = field_of.iter().copied().filter(within).collect();
        let set = table_with_chairs(&parts, fill, metres_per_pixel);
        let is_corner = fill < LEAST_FILL && set.is_none();
        let is_bent = fill < BENT_FILL && goes_round(&objects, object, metres_per_pixel);
        if is_corner && !is_bent || is_marking(&what, width, object, sides) {
            continue;
        }
        let is_tread = |f: &Component, least_m: f64| {
            let [w, h] = in_metres(f);
            (0.18..=0.42).contains(&w.min(h)) && w.max(h) >= least_m
        };
        let is_desk = |f: &Component| {
            let [w, h] = in_metres(f);
            DESK_DEPTH_M.contains(&w.min(h)) && DESK_LENGTH_M.contains(&w.max(h)) && w.max(h) >= DESK_SLENDER * w.min(h)
        };
        let alike = |a: &&&Component| parts.iter().filter(|b| is_alike(a, b)).count();
        // Treads follow each other; chairs stand along both sides of a table.
        let follows = |a: &Component, b: &Component| {
            let along = usize::from(a.size()[1] > a.size()[0]);
            let apart = |axis: usize| apart([a.min[axis], a.end[axis]], [b.min[axis], b.end[axis]]);
            a != b && apart(along) == 0 && apart(1 - along) <= 2 * stroke as u32 && is_alike(a, b)
        };
        let most_alike = |least_m: f64| {
            let treads = parts.iter().filter(|p| is_tread(p, least_m));
            let treads = treads.filter(|a| parts.iter().any(|b| follows(a, b)));
            treads.map(|p| alike(&p)).max().unwrap_or(0)
        };
        let at_wall = at_wall(&what, width, &objects, object, stroke + 1);
        let mut piece = Evidence {
            around: object.around(),
            area: object.area,
            at_wall,
            fields: parts.len(),
            // The line on which one walks halves treads.
            alike: most_alike(TREAD_M).max(most_alike(HALF_TREAD_M) / 2),
            desks: parts.iter().filter(|p| is_desk(p) && alike(p) >= 2).map(|p| p.area as f64).sum::<f64>()
                / object.area as f64,
            fill,
            class: PlanClass::Table,
        };
        piece.class =
            if is_corner || is_bent && at_wall >= BENT_AT_WALL { PlanClass::Counter } else { class(&piece, sides) };
        let is_row = piece.class == PlanClass::Stairs || sides[0].min(sides[1]) <= DEEPEST_FIELD_M;
        if area > LARGEST_AREA_M2 && !(is_row && fill >= ROW_FILL && area <= LARGEST_ROWS_M2) {
            continue;
        }
        if let Some((tables, chairs)) = set {
            objects.paint(object, classes, width, PlanClass::Seat);
            tables.iter().for_each(|table| paint_around(&fields, table, stroke, (&solid, classes), width));
            let of_class = |field: &Component, class: PlanClass| Evidence {
                around: field.around(),
                area: field.area,
                at_wall: 0.0,
                class,
                ..piece
            };
            found.extend(tables.into_iter().map(|table| of_class(table, PlanClass::Table)));
            found.extend(chairs.into_iter().map(|chair| of_class(chair, PlanClass::Seat)));
            continue;
        }
        objects.paint(object, classes, width, piece.class);
        found.push(piece);
    }
    seat_round_chairs(&mut found, width, metres_per_pixel, classes);
    lower_desks(&mut found, width, metres_per_pixel, classes);
    found
}

/// Makes seats of round pieces of two fields, seat and back, that stand free before tables: basins and toilets stand at walls.
fn seat_round_chairs(found: &mut [Evidence], width: usize, metres_per_pixel: f64, classes: &mut [PlanClass]) {
    /// The fewest of them.
    const FEWEST: usize = 3;
    let most = (CHAIR_OFF_M / metres_per_pixel).round() as u32;
    let tables: Vec<[u32; 4]> =
        found.iter().filter(|piece| piece.class == PlanClass::Table).map(|piece| piece.around).collect();
    let is_chair = |piece: &&mut Evidence| {
        piece.class == PlanClass::Fixture
            && piece.at_wall == 0.0
            && tables.iter().any(|&table| are_near(piece.around, table, most))
    };
    let chairs: Vec<&mut Evidence> = found.iter_mut().filter(is_chair).collect();
    if chairs.len() < FEWEST {
        return;
    }
    for chair in chairs {
        chair.class = PlanClass::Seat;
        repaint(classes, width, chair.around, [PlanClass::Fixture, PlanClass::Seat]);
    }
}

/// Whether two boxes are up to so many pixels apart along both axes.
fn are_near([x0, y0, x1, y1]: [u32; 4], [a0, b0, a1, b1]: [u32; 4], most: u32) -> bool {
    apart([x0, x1], [a0, a1]).max(apart([y0, y1], [b0, b1])) <= most
}

/// Gives a class to what has another one within a box.
fn repaint(classes: &mut [PlanClass], width: usize, [x0, y0, x1, y1]: [u32; 4], [from, to]: [PlanClass; 2]) {
    for y in y0..y1 {
        let row = &mut classes[y as usize * width..][x0 as usize..x1 as usize];
        row.iter_mut().filter(|class| **class == from).for_each(|class| *class = to);
    }
}

/// Makes tables of shelves with a chair before them: desks at a wall.
fn lower_desks(found: &mut [Evidence], width: usize, metres_per_pixel: f64, classes: &mut [PlanClass]) {
    /// Least depth of a desk, and largest chair, metres.
    const DEPTH_M: f64 = 0.38;
    const CHAIR_M: f64 = 0.75;
    let px = |metres: f64| (metres / metres_per_pixel).round() as u32;
    let sides = |[x0, y0, x1, y1]: [u32; 4]| [x1 - x0, y1 - y0];
    let is_chair = |piece: &&Evidence| {
        piece.class == PlanClass::Seat && sides(piece.around).into_iter().all(|side| side <= px(CHAIR_M))
    };
    let chairs: Vec<[u32; 4]> = found.iter().filter(is_chair).map(|piece| piece.around).collect();
    for piece in found.iter_mut().filter(|piece| piece.class == PlanClass::Shelf) {
        let [w, h] = sides(piece.around);
        if w.min(h) < px(DEPTH_M) || !chairs.iter().any(|&chair| are_near(piece.around, chair, px(CHAIR_OFF_M))) {
            continue;
        }
        piece.class = PlanClass::Table;
        repaint(classes, width, piece.around, [PlanClass::Shelf, PlanClass::Table]);
    }
}

/// The fields of a table, or of several that touch, and those of the chairs around them; `None` if a piece is none of these.
/// Chairs stand outside the tables' box, or their circle, and on opposite sides: the pillows of a bed lie within its rectangle.
fn table_with_chairs<'f>(
    parts: &[&'f Component],
    fill: f64,
    metres_per_pixel: f64,
) -> Option<(Vec<&'f Component>, Vec<&'f Component>)> {
    /// Greatest share of its box that a table with chairs fills, and of a round table's that its field does.
    const FILL: f64 = 0.92;
    const ROUND: f64 = 0.87;
    /// Least sides of the fields of chairs, and greatest, metres; most of the largest table's area that one has.
    const CHAIR_M: [f64; 3] = [0.15, 0.28, 0.75];
    const SMALLER: f64 = 0.5;
    let largest = parts.iter().map(|part| part.area).max().filter(|_| fill < FILL)?;
    let [shortest, least, most] = CHAIR_M;
    let is_chair = |part: &&Component| {
        let [w, h] = part.size().map(|side| f64::from(side) * metres_per_pixel);
        w.min(h) >= shortest && (least..=most).contains(&w.max(h)) && part.area as f64 <= SMALLER * largest as f64
    };
    let (chairs, tables): (Vec<&Component>, Vec<&Component>) = parts.iter().partition(|part| is_chair(part));
    let min = [0, 1].map(|axis| tables.iter().map(|table| table.min[axis]).min().unwrap_or(0));
    let end = [0, 1].map(|axis| tables.iter().map(|table| table.end[axis]).max().unwrap_or(0));
    let box_px = f64::from(end[0] - min[0]) * f64::from(end[1] - min[1]);
    let is_round = (largest as f64) < ROUND * box_px && tables.len() == 1;
    // In half lengths of the tables' box.
    let off = |chair: &Component| {
        [0, 1].map(|axis| {
            let half = 0.5 * f64::from(end[axis] - min[axis]);
            (0.5 * f64::from(chair.min[axis] + chair.end[axis]) - f64::from(min[axis]) - half) / half
        })
    };
    let offs: Vec<[f64; 2]> = chairs.iter().map(|chair| off(chair)).collect();
    let is_outside = |[x, y]: &[f64; 2]| x.abs() > 1.0 || y.abs() > 1.0 || is_round && x * x + y * y > 1.1;
    let is_opposite = |[ax, ay]: &[f64; 2]| offs.iter().any(|[bx, by]| ax * bx + ay * by < -1.0);
    (offs.iter().all(is_outside) && offs.iter().any(is_opposite)).then_some((tables, chairs))
}

/// Paints a field and what is solid within `reach` pixels around it as a table.
fn paint_around(
    fields: &Components,
    field: &Component,
    reach: usize,
    (solid, classes): (&[u8], &mut [PlanClass]),
    width: usize,
) {
    for range in fields.ranges(field, width) {
        let (row, from, to) = (range.start / width, range.start % width, range.end - range.start / width * width);
        for y in row.saturating_sub(reach)..=(row + reach).min(classes.len() / width - 1) {
            for x in from.saturating_sub(reach)..(to + reach).min(width) {
                if solid[y * width + x] != 0 {
                    classes[y * width + x] = PlanClass::Table;
                }
            }
        }
    }
}

/// Whether two pieces have about the same size.
fn is_alike(a: &Component, b: &Component) -> bool {
    (0..2).all(|axis| b.size()[axis].abs_diff(a.size()[axis]) <= 3)
}

/// Takes the strokes of words off: round letters enclose fields as seats do. In words others stand beside them that enclose
/// nothing; chairs in a row are all alike.
fn leave_out_words(what: &mut [u8], width: usize, metres_per_pixel: f64) {
    /// Least share of the letters of a word that enclose nothing; greatest height of letters that enclose something, in that of
    /// those which do not; and of the tallest letter, in the median's.
    const OPEN: f64 = 0.4;
    const ALIKE: f64 = 1.35;
    const TALLEST: f64 = 2.2;
    let strokes: Vec<u8> = what.iter().map(|&what| u8::from(what == STROKE)).collect();
    let pieces = Components::of(&strokes, width, 1, Neighbours::Eight);
    let is_letter = |p: &&Component| f64::from(p.larger_side()) * metres_per_pixel <= LARGEST_LETTER_M;
    let letters: Vec<&Component> = pieces.all.iter().filter(is_letter).collect();
    for word in groups(&letters).into_iter().filter(|word| word.len() >= FEWEST_STROKES) {
        let tallest_of = |letters: &[&Component]| letters.iter().map(|p| p.larger_side()).max().unwrap_or(0);
        let tallest = f64::from(tallest_of(&word));
        // The leaf of a door is longer than letters beside it are tall.
        let mut sides: Vec<u32> = word.iter().map(|p| p.larger_side()).collect();
        sides.sort_unstable();
        let are_even = tallest <= TALLEST * f64::from(sides[(sides.len() - 1) / 2]);
        let (closed, open): (Vec<&Component>, Vec<&Component>) = word.iter().partition(|p| encloses(&pieces, p));
        // A table is larger than the chairs around it. Letters that touch are as tall as others.
        let of_closed = closed.iter().map(|p| p.size()[0].min(p.size()[1])).max().unwrap_or(0);
        let are_alike = f64::from(of_closed) <= ALIKE * f64::from(tallest_of(&open));
        let is_word = are_even && are_alike && !closed.is_empty() && open.len() as f64 >= OPEN * word.len() as f64;
        if is_word && are_in_line(&word, tallest) {
            word.iter().for_each(|letter| pieces.paint(letter, what, width, 0));
        }
    }
}

/// Whether letters stand side by side on a line of any direction. The seat and the back of a chair, or chairs on both sides of
/// a table, do not.
pub(super) fn are_in_line(word: &[&Component], tallest: f64) -> bool {
    /// How far the middles of letters are off a line at most, and how far apart along it at least, in the tallest one.
    const OFF: f64 = 0.35;
    const APART: f64 = 0.18;
    // Dots and accents stand above others.
    let letters = word.iter().filter(|p| f64::from(p.larger_side()) * 2.0 > tallest);
    let mut middles: Vec<[f64; 2]> =
        letters.map(|p| [0, 1].map(|axis| 0.5 * f64::from(p.min[axis] + p.end[axis]))).collect();
    let size = [0, 1].map(|axis| {
        let along = || middles.iter().map(|middle| middle[axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    });
    let axis = usize::from(size[1] > size[0]);
    middles.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
    let ([Some(first), Some(last)], count) = ([middles.first(), middles.last()], middles.len()) else { return false };
    let length = ((last[0] - first[0]) * (last[0] - first[0]) + (last[1] - first[1]) * (last[1] - first[1])).sqrt();
    let [x, y] = [0, 1].map(|axis| (last[axis] - first[axis]) / length.max(1.0));
    let mean = [0, 1].map(|axis| middles.iter().map(|middle| middle[axis]).sum::<f64>() / count as f64);
    let off = |middle: &[f64; 2]| ((middle[0] - mean[0]) * y - (middle[1] - mean[1]) * x).abs();
    let along = |middle: &[f64; 2]| middle[0] * x + middle[1] * y;
    middles.iter().all(|middle| off(middle) <= OFF * tallest)
        && middles.array_windows().all(|[a, b]| along(b) - along(a) >= APART * tallest)
}

/// Whether a stroke encloses a field.
pub(super) fn encloses(pieces: &Components, piece: &Component) -> bool {
    let [w, h] = piece.size().map(|side| side as usize + 2);
    let mut free = vec![1u8; w * h];
    for run in pieces.runs(piece) {
        let row = (run.y - piece.min[1]) as usize + 1;
        let [from, to] = [run.from, run.to].map(|x| (x - piece.min[0]) as usize + 1);
        free[row * w + from..row * w + to].fill(0);
    }
    Components::of(&free, w, 1, Neighbours::Four).all.len() > 1
}

/// Paints filled rectangles in a room, of at least so many square metres: furniture. Arrows and symbols are no rectangles, or
/// small.
fn paint_filled(filled: &[u8], least_m2: f64, what: &[u8], width: usize, metres_per_pixel: f64, solid: &mut [u8]) {
    let pieces = Components::of(filled, width, 1, Neighbours::Eight);
    for piece in &pieces.all {
        let [w, h] = piece.size().map(|side| f64::from(side) * metres_per_pixel);
        let area = piece.area as f64 * metres_per_pixel * metres_per_pixel;
        let is_size = (least_m2..=LARGEST_ROWS_M2).contains(&area) && w.min(h) <= DEEPEST_FIELD_M;
        let is_inside = |range: std::ops::Range<usize>| what[range].iter().all(|&what| what == 0 || what == STROKE);
        if is_size && area >= ROW_FILL * w * h && pieces.ranges(piece, width).all(is_inside) {
            pieces.paint(piece, solid, width, 1);
        }
    }
}

/// Whether a large circle lies on a line that goes on as far on both sides: of a court, painted on the floor.
fn is_marking(what: &[u8], width: usize, piece: &Component, sides: [f64; 2]) -> bool {
    /// Least diameter, metres, and least share of the line that is drawn.
    const LEAST_M: f64 = 2.4;
    const DRAWN: f64 = 0.9;
    /// How far the line may be from the circle's middle, pixels.
    const OFF_PX: i32 = 2;
    let [w, h] = piece.size().map(|side| side as usize);
    let fill = piece.area as f64 / (w * h) as f64;
    if sides[0].min(sides[1]) < LEAST_M || w.abs_diff(h) * 20 > w || !(0.74..=0.84).contains(&fill) {
        return false;
    }
    let [x, y] = [0, 1].map(|axis| ((piece.min[axis] + piece.end[axis]) / 2) as i32);
    let is_stroke = |x: i32, y: i32| {
        x >= 0 && y >= 0 && (x as usize) < width && what.get(y as usize * width + x as usize) == Some(&STROKE)
    };
    let goes_on = |[dx, dy]: [i32; 2]| {
        let beyond = w as i32 / 2 + 1..w as i32 / 2 + 1 + w as i32;
        let is_drawn = |k: &i32| (-OFF_PX..=OFF_PX).any(|off| is_stroke(x + k * dx + off * dy, y + k * dy + off * dx));
        beyond.filter(is_drawn).count() as f64 >= DRAWN * w as f64
    };
    [[1, 0], [0, 1]].into_iter().any(|way| goes_on(way) && goes_on(way.map(|step: i32| -step)))
}

/// Whether a piece goes round a corner and is everywhere about as deep as counters, as in a kitchen.
fn goes_round(pieces: &Components, piece: &Component, metres_per_pixel: f64) -> bool {
    let [w, h] = piece.size().map(|side| side as usize);
    let mut mask = vec![0u8; w * h];
    for run in pieces.runs(piece) {
        let row = (run.y - piece.min[1]) as usize * w;
        mask[row + (run.from - piece.min[0]) as usize..row + (run.to - piece.min[0]) as usize].fill(1);
    }
    let share = |depth_m: f64| {
        let kept = open(&mask, w, ((depth_m / metres_per_pixel).round() as usize).max(2));
        kept.iter().filter(|&&kept| kept != 0).count() as f64 / piece.area as f64
    };
    let [least, most] = COUNTER_DEPTH_M;
    let is_long = w.min(h) as f64 * metres_per_pixel >= LEAST_TURN_M;
    is_long && share(least) >= 0.85 && share(most) <= 0.15
}

/// Counts what lies beside a component.
fn beside(what: &[u8], width: usize, pieces: &Components, piece: &Component) -> [usize; 5] {
    let height = what.len() / width;
    let mut counts = [0; 5];
    for run in pieces.runs(piece) {
        let (y, from, to) = (run.y as usize, run.from as usize, run.to as usize);
        for row in [y.checked_sub(1), Some(y + 1).filter(|&y| y < height)].into_iter().flatten() {
            for &w in &what[row * width + from..row * width + to] {
                counts[usize::from(w)] += 1;
            }
        }
        for x in [from.checked_sub(1), Some(to).filter(|&x| x < width)].into_iter().flatten() {
            counts[usize::from(what[y * width + x])] += 1;
        }
    }
    counts[0] = 0;
    counts
}

/// The greatest share of a side of a component's box that lies at a wall.
fn at_wall(what: &[u8], width: usize, _pieces: &Components, piece: &Component, reach: usize) -> f64 {
    let height = what.len() / width;
    let ([x0, y0], [x1, y1]) = (piece.min.map(|v| v as usize), piece.end.map(|v| v as usize));
    let solid = |x: Option<usize>, y: Option<usize>| match (x, y) {
        (Some(x), Some(y)) if x < width && y < height => what[y * width + x] == SOLID,
        _ => false,
    };
    let rows = |dx: &dyn Fn(usize) -> Option<usize>| {
        (y0..y1).filter(|&y| (0..=reach).any(|k| solid(dx(k), Some(y)))).count() as f64 / (y1 - y0) as f64
    };
    let columns = |dy: &dyn Fn(usize) -> Option<usize>| {
        (x0..x1).filter(|&x| (0..=reach).any(|k| solid(Some(x), dy(k)))).count() as f64 / (x1 - x0) as f64
    };
    let long = if x1 - x0 >= y1 - y0 {
        [columns(&|k| y0.checked_sub(k)), columns(&|k| Some(y1 - 1 + k))]
    } else {
        [rows(&|k| x0.checked_sub(k)), rows(&|k| Some(x1 - 1 + k))]
    };
    long[0].max(long[1])
}

/// Tells furniture by its size and shape. `sides` are those of its box, metres.
fn class(piece: &Evidence, sides: [f64; 2]) -> PlanClass {
    let (depth, length) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    let (is_at_wall, is_round) = (piece.at_wall >= 0.5, piece.fill < 0.87);
    match () {
        () if piece.alike >= 4 && depth >= 0.7 => PlanClass::Stairs,
        () if length <= 0.85 && is_round && piece.fields >= 2 => PlanClass::Fixture,
        () if is_at_wall && depth <= 0.52 && length >= 0.8 => PlanClass::Shelf,
        () if is_at_wall && depth <= 0.8 && length >= 1.0 && piece.fields < 3 => PlanClass::Counter,
        // Sinks and hobs divide it into many fields.
        () if is_at_wall && depth <= 0.7 && length >= 1.8 => PlanClass::Counter,
        () if length <= 0.85 => PlanClass::Seat,
        () if depth * length > LARGEST_AREA_M2 => PlanClass::Counter,
        // A rack between the aisles of a shop.
        () if depth >= 0.7 && length >= 4.0 && length >= 4.5 * depth => PlanClass::Counter,
        () if depth >= 0.6 && length >= 1.4 && piece.fields >= 2 && piece.desks < DESKS => PlanClass::Seat,
        () => PlanClass::Table,
    }
}
