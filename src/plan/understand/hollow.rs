//! Fills walls that are drawn as outlines or by hatches.

use std::ops::Range;

use super::super::components::{Component, Components, Neighbours, Run};
use super::super::thick::{grow, long_runs, open};
use crate::math::vec2;

/// Greatest distance between the lines of a hatch, metres.
const HATCH_M: f64 = 0.12;
/// Least length of a hatched wall, metres.
const HATCHED_M: f64 = 0.9;
/// Fewest spaces between the lines of a hatch.
const FEWEST_SPACES: usize = 6;
/// The same of piers and columns, where walls are hatched.
const PIER_M: f64 = 0.35;
const FEWEST_IN_PIER: usize = 3;
/// Least share of its box that a pier fills.
const PIER_FILL: f64 = 0.75;
/// Least length of the bars between the lines of a window, in their thicknesses.
const BAR_SLENDER: f64 = 6.0;
/// Share of its box that a field between an outline and the zigzag of an insulation fills: it is a triangle, or two with a
/// blunt tip at an end.
const TOOTH: [f64; 2] = [0.3, 0.72];
/// How far its middle is off that of its box at least, in larger sides; a sixth in a triangle as high as it is wide.
const LOPSIDED: f64 = 0.09;
/// Fewest of them in a row; most are found twice, with and without their outermost pixels.
const FEWEST_TEETH: usize = 6;
/// Larger side of such a field, metres; halves of crossed wardrobes are larger.
const LARGEST_TOOTH_M: f64 = 0.45;
/// Larger side of a field between two slanted lines of a hatch, metres, that of one which ends along the faces of an upright wall,
/// and share of its box that it fills at most.
const LARGEST_SLANTED_M: f64 = 0.75;
const LARGEST_SHEARED_M: f64 = 1.3;
const SLANTED_FILL: f64 = 0.72;
/// Most stripes beside each other where a wall runs along its hatch, from either end.
const STRIPES: usize = 3;
/// How far it leans at least: correlation of the x and y of its pixels. Rectangles have none.
const LEANS: f64 = 0.25;
/// Greatest thickness of a hatch's lines, metres; outlines are thicker.
const THIN_M: f64 = 0.02;
/// Greatest thickness of a hollow wall, metres.
const THICKEST_M: f64 = 0.62;
/// Least length of a hollow wall, in its thicknesses and in metres.
const SLENDER: f64 = 2.2;
const SHORTEST_M: f64 = 0.5;
/// Share of its box that a short hollow wall fills, and length from which it may have corners, metres.
const FULL: f64 = 0.85;
/// Greatest thickness of a straight hollow wall that stands alone, metres; tables are deeper.
const THICKEST_BAR_M: f64 = 0.45;
const NET_M: f64 = 3.0;
/// Least larger side of the box of a few hollow walls that meet, metres, and greatest share of it that they fill.
const SMALL_NET_M: f64 = 2.2;
const SMALL_NET_FILL: f64 = 0.4;
/// Greatest share of its box that a net of hollow walls fills; what fills more is one bar.
const NET_FILL: f64 = 0.6;
/// Greatest share of its box that a wall with a corner fills.
const BAR_FILL: f64 = 0.72;
/// Least side of the box of a hollow wall with a corner, metres.
const BENT_M: f64 = 1.0;

/// 1 where a mask is 0.
fn inverted(mask: &[u8]) -> Vec<u8> {
    mask.iter().map(|&value| u8::from(value == 0)).collect()
}

/// Greatest thickness of the strokes around what was filled, with a soft edge, pixels; 0 if nothing was filled, or all is
/// thicker than a stroke. Furniture is drawn by the like, and is no wall.
pub(super) fn stroke_px(strokes: &[u8], fills: &[u8], width: usize, metres_per_pixel: f64) -> usize {
    /// Share of the strokes beside what was filled that may be thicker: massive walls end there.
    const THICKER: f64 = 0.3;
    let beside = grow(fills, width, 1);
    let count =
        |strokes: &[u8]| strokes.iter().zip(&beside).filter(|&(&stroke, &near)| stroke & near != 0).count() as f64;
    let all = count(strokes);
    if all == 0.0 {
        return 0;
    }
    let most = ((HATCH_M / metres_per_pixel) as usize).max(2);
    (1..=most).find(|&px| count(&open(strokes, width, px + 1)) <= THICKER * all).map_or(0, |px| px + 1)
}

/// Whether what was taken for walls is the outlines of hollow ones: much of it lies beside what outlines enclose.
pub(super) fn are_outlines(wall: &[u8], strokes: &[u8], width: usize, metres_per_pixel: f64) -> bool {
    const BESIDE: f64 = 0.1;
    let filled = fill_outlines(strokes, width, metres_per_pixel);
    let fills: Vec<u8> = filled.iter().zip(strokes).map(|(&filled, &stroke)| filled & (1 - stroke)).collect();
    let near = grow(&fills, width, 1);
    let all = wall.iter().filter(|&&wall| wall != 0).count() as f64;
    let beside = wall.iter().zip(&near).filter(|&(&wall, &near)| wall & near != 0).count() as f64;
    beside >= BESIDE * all
}

/// Fills what lies between two strokes along half a metre, as far apart as the faces of a wall: the outlines of walls that
/// are drawn by hand are open where strokes miss each other.
pub(super) fn fill_pairs(strokes: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    const APART_M: Range<f64> = 0.05..0.45;
    const LEAST_M: f64 = 0.5;
    const SLIT_M: f64 = 0.08;
    let [nearest, farthest, least] =
        [APART_M.start, APART_M.end, LEAST_M].map(|m| (m / metres_per_pixel).round() as usize);
    let height = strokes.len() / width;
    let mut filled = strokes.to_vec();
    for (lines, length, step, stride) in [(height, width, 1, width), (width, height, width, 1)] {
        let mut between = vec![0u8; strokes.len()];
        for line in 0..lines {
            let mut last = None;
            for k in 0..length {
                let at = line * stride + k * step;
                if strokes[at] == 0 {
                    continue;
                }
                if let Some(from) = last.replace(k + 1).filter(|from| (nearest..=farthest).contains(&(k - from))) {
                    (from..k).for_each(|k| between[line * stride + k * step] = 1);
                }
            }
        }
        let long = long_runs(&between, width, stride, least);
        filled.iter_mut().zip(&long).for_each(|(filled, long)| *filled |= long);
    }
    // Where strokes wobble, slits are left, and a square where two walls meet.
    let slit = ((SLIT_M / metres_per_pixel).round() as usize).max(2);
    let mut filled = inverted(&open(&inverted(&filled), width, slit));
    let fields = Components::of(&filled, width, 0, Neighbours::Four);
    for field in fields.all.iter().filter(|field| field.larger_side() as usize <= farthest) {
        fields.paint(field, &mut filled, width, 1);
    }
    filled
}

/// Fills what is too narrow for anything but the space between the lines of a hatch, or lies between slanted lines, where many
/// such spaces lie together.
pub(super) fn fill_hatches(dark: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let side = ((HATCH_M / metres_per_pixel).round() as usize).max(2);
    let white = inverted(dark);
    let wide = open(&white, width, side);
    let mut narrow: Vec<u8> = white.iter().zip(&wide).map(|(&white, &wide)| white & (1 - wide)).collect();
    let spaces = Components::of(&narrow, width, 1, Neighbours::Four);
    // Between the lines of a window are bars.
    let is_bar = |space: &&Component| {
        let [w, h] = space.size().map(f64::from);
        w.max(h) >= BAR_SLENDER * w.min(h) && space.area as f64 >= FULL * w * h
    };
    let (bars, spaces_of_hatch): (Vec<&Component>, Vec<&Component>) = spaces.all.iter().partition(is_bar);
    bars.into_iter().for_each(|bar| spaces.paint(bar, &mut narrow, width, 0));
    let mut starts: Vec<usize> = spaces_of_hatch.into_iter().map(|space| spaces.first(space, width)).collect();
    let fields = Components::of(&white, width, 1, Neighbours::Four);
    let is_slanted = |field: &&Component| {
        let [w, h] = field.size().map(f64::from);
        let size = w.max(h) * metres_per_pixel;
        let may_be = w.min(h) >= 2.0 && size <= LARGEST_SHEARED_M && field.area as f64 <= SLANTED_FILL * w * h;
        may_be && leans(&fields, field) && (size <= LARGEST_SLANTED_M || is_sheared(&fields, field))
    };
    let mut slanted = vec![0u8; dark.len()];
    for field in fields.all.iter().filter(is_slanted) {
        // Triangles are the ends of a hatch, but halves of crossed cupboards too.
        let is_end = is_lopsided(&fields, field);
        if !is_end && !fields.touches(field, &narrow, width) {
            starts.push(fields.first(field, width));
        }
        fields.paint(field, &mut narrow, width, 1);
        fields.paint(field, &mut slanted, width, u8::from(!is_end));
    }
    starts.sort_unstable();
    let mut near = grow(&narrow, width, ((0.03 / metres_per_pixel) as usize).max(1));
    let places = Components::of(&near, width, 1, Neighbours::Eight);
    let is_hatched = |place: &Component, [fewest, shortest_m]: [f64; 2]| {
        let within = |range: Range<usize>| {
            let before = |at: usize| starts.partition_point(|&start| start < at);
            before(range.end) - before(range.start)
        };
        let count: usize = places.ranges(place, width).map(within).sum();
        count as f64 >= fewest && f64::from(place.larger_side()) * metres_per_pixel >= shortest_m
    };
    let wall = [FEWEST_SPACES as f64, HATCHED_M];
    let walls: Vec<bool> = places.all.iter().map(|place| is_hatched(place, wall)).collect();
    let least = if walls.contains(&true) { [FEWEST_IN_PIER as f64, PIER_M] } else { wall };
    // Letters over furniture have narrow spaces too, but fill no box.
    let is_solid = |place: &Component| {
        let rows = (place.min[1] as usize..place.end[1] as usize).map(|y| y * width);
        let within = rows.flat_map(|row| row + place.min[0] as usize..row + place.end[0] as usize);
        let solid = within.filter(|&at| dark[at] | narrow[at] != 0).count() as f64;
        let [w, h] = place.size().map(f64::from);
        solid >= PIER_FILL * w * h
    };
    let is_pier = |place: &Component| is_hatched(place, least) && is_solid(place);
    for (place, _) in places.all.iter().zip(walls).filter(|(place, is_wall)| !is_wall && !is_pier(place)) {
        places.paint(place, &mut near, width, 0);
    }
    let solid: Vec<u8> = (0..dark.len()).map(|at| dark[at] | (narrow[at] & near[at])).collect();
    slanted.iter_mut().zip(&near).for_each(|(slanted, near)| *slanted &= near);
    if !slanted.contains(&1) {
        return solid;
    }
    // What is left at the ends of walls, in their corners, and where they run along the hatch, behind its thin lines: one stripe
    // beside the other.
    // Where a pixel is wider than a line, soft edges make the line two pixels wide.
    let thin = if metres_per_pixel > THIN_M { 2 } else { (THIN_M / metres_per_pixel).round() as usize };
    let rests = Components::of(&inverted(&solid), width, 1, Neighbours::Four);
    let is_rest = |rest: &&Component| {
        let is_small = f64::from(rest.larger_side()) * metres_per_pixel <= LARGEST_TOOTH_M;
        let is_thin = || thickness(&solid, width, &rests, rest) * metres_per_pixel <= THICKEST_BAR_M;
        is_small || leans(&rests, rest) && is_thin()
    };
    let mut left: Vec<&Component> = rests.all.iter().filter(is_rest).collect();
    let (mut filled, mut last) = (solid.clone(), slanted);
    for _ in 0..STRIPES {
        let beside = grow(&last, width, thin);
        let next: Vec<&Component> = left.extract_if(.., |rest| rests.touches(rest, &beside, width)).collect();
        last.fill(0);
        for rest in next {
            rests.paint(rest, &mut filled, width, 1);
            rests.paint(rest, &mut last, width, 1);
        }
    }
    filled
}

/// Fills the fields between the outlines of a wall and the zigzag of its insulation: many triangles in a row, and what is
/// left at its ends and where thin walls meet it.
pub(super) fn fill_teeth(dark: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let (mut teeth, mut starts) = (vec![0u8; dark.len()], vec![0u8; dark.len()]);
    // Tips of a zigzag may end a pixel before the outline.
    for fields in
        [inverted(dark), inverted(&grow(dark, width, 1))].map(|w| Components::of(&w, width, 1, Neighbours::Four))
    {
        for field in &fields.all {
            let [w, h] = field.size().map(f64::from);
            let is_triangle = w.min(h) >= 2.0 && (TOOTH[0]..=TOOTH[1]).contains(&(field.area as f64 / (w * h)));
            if is_triangle && is_lopsided(&fields, field) && w.max(h) * metres_per_pixel <= LARGEST_TOOTH_M {
                fields.paint(field, &mut teeth, width, 1);
                starts[fields.first(field, width)] = 1;
            }
        }
    }
    // Teeth that a stroke parts are one row.
    let stroke = ((0.02 / metres_per_pixel).round() as usize).max(2) + 1;
    let mut near = grow(&teeth, width, stroke);
    let rows = Components::of(&near, width, 1, Neighbours::Eight);
    for row in &rows.all {
        let count: usize =
            rows.ranges(row, width).flat_map(|range| &starts[range]).map(|&start| usize::from(start)).sum();
        if count < FEWEST_TEETH || f64::from(row.larger_side()) * metres_per_pixel < HATCHED_M {
            rows.paint(row, &mut near, width, 0);
        }
    }
    if !near.contains(&1) {
        return dark.to_vec();
    }
    let mut filled: Vec<u8> = teeth.iter().zip(&near).map(|(&tooth, &near)| tooth & near).collect();
    let fill_beside = |white: &[u8], most_m: f64, filled: &mut Vec<u8>| {
        let rests = Components::of(white, width, 1, Neighbours::Four);
        for rest in rests.all.iter().filter(|rest| f64::from(rest.larger_side()) * metres_per_pixel <= most_m) {
            if rests.touches(rest, &near, width) {
                rests.paint(rest, filled, width, 1);
            }
        }
    };
    // The heads of thin walls' fields, which open into a tooth.
    let [least, most] = [0.5 * HATCH_M, HATCH_M].map(|m| ((m / metres_per_pixel).round() as usize).max(3));
    for px in least..=most {
        fill_beside(&open(&inverted(dark), width, px), LARGEST_TOOTH_M, &mut filled);
    }
    let mut filled: Vec<u8> = dark.iter().zip(grow(&filled, width, 1)).map(|(&dark, filled)| dark | filled).collect();
    // Crumbs at the tips.
    fill_beside(&inverted(&filled), HATCH_M, &mut filled);
    filled
}

/// Whether a field's middle lies off that of its box, as in triangles and not in the stripes of a hatch.
fn is_lopsided(fields: &Components, field: &Component) -> bool {
    let (mut x, mut y) = (0.0, 0.0);
    for run in fields.runs(field) {
        let count = f64::from(run.to - run.from);
        x += count * 0.5 * f64::from(run.from + run.to);
        y += count * (f64::from(run.y) + 0.5);
    }
    let off = |sum: f64, axis: usize| sum / field.area as f64 - 0.5 * f64::from(field.min[axis] + field.end[axis]);
    vec2(off(x, 0), off(y, 1)).length() >= LOPSIDED * f64::from(field.larger_side())
}

/// Whether a field leans, as those between slanted lines do.
fn leans(fields: &Components, field: &Component) -> bool {
    let (mut sum, mut squares, mut product) = ([0.0; 2], [0.0; 2], 0.0);
    for run in fields.runs(field) {
        let y = f64::from(run.y - field.min[1]);
        for x in run.from - field.min[0]..run.to - field.min[0] {
            let x = f64::from(x);
            product += x * y;
            for (k, at) in [x, y].into_iter().enumerate() {
                sum[k] += at;
                squares[k] += at * at;
            }
        }
    }
    let count = field.area as f64;
    let spread = |k: usize| squares[k] * count - sum[k] * sum[k];
    (product * count - sum[0] * sum[1]).abs() >= LEANS * (spread(0) * spread(1)).sqrt()
}

/// Whether a field is as wide in all its rows, or as high in all its columns, as between the faces of a wall; treads of slanted
/// stairs have corners.
fn is_sheared(fields: &Components, field: &Component) -> bool {
    const EVEN: f64 = 0.88;
    let [w, h] = field.size();
    let mut columns = vec![0; w as usize];
    let mut widest = 0;
    for run in fields.runs(field) {
        widest = widest.max(run.to - run.from);
        columns[(run.from - field.min[0]) as usize..(run.to - field.min[0]) as usize].iter_mut().for_each(|n| *n += 1);
    }
    let most = columns.into_iter().max().unwrap_or(0);
    [widest * h, most * w].into_iter().any(|all| field.area as f64 >= EVEN * f64::from(all))
}

/// Fills long narrow fields between two lines. Fields in pairs beside each other are windows and stay.
pub(super) fn fill_outlines(dark: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let side = ((THICKEST_M / metres_per_pixel).round() as usize).max(3);
    let white = inverted(dark);
    let wide = open(&white, width, side);
    let height = dark.len() / width;
    let fields = Components::of(&white, width, 1, Neighbours::Four);
    let is_wall = |field: &&Component| {
        let is_wide = fields.touches(field, &wide, width);
        if is_wide || field.is_at_side(width, height) {
            return false;
        }
        let [w, h] = field.size().map(f64::from);
        let thick = thickness(dark, width, &fields, field);
        let length = field.area as f64 / thick;
        let is_bent = length >= 4.0 * thick
            && w.max(h) * metres_per_pixel >= BENT_M
            && thick * metres_per_pixel >= 0.05
            && is_even(&fields, field, thick);
        let is_bar = field.area as f64 >= FULL * w * h || is_bent;
        let reach = w.max(h) * metres_per_pixel;
        let is_net = reach >= NET_M || (reach >= SMALL_NET_M && field.area as f64 <= SMALL_NET_FILL * w * h);
        // A sink in a counter makes its outline longer, and so the rectangle thinner.
        let share = field.area as f64 / (w * h);
        let is_full = share > NET_FILL;
        let is_one_bar = share > BAR_FILL || is_full && !is_bent;
        let is_thin = if is_one_bar { w.min(h) } else { thick } * metres_per_pixel <= THICKEST_BAR_M;
        thick * metres_per_pixel >= 0.02
            && length >= SLENDER * thick
            && length * metres_per_pixel >= SHORTEST_M
            && if is_thin { is_net || is_bar } else { is_net && !is_full }
    };
    let walls: Vec<&Component> = fields.all.iter().filter(is_wall).collect();
    let stroke = ((0.05 / metres_per_pixel).round() as u32).max(3);
    let beside = |a: &Component, b: &Component| {
        (0..2).any(|axis| {
            let across = 1 - axis;
            let same = a.min[axis].abs_diff(b.min[axis]) <= 2 && a.end[axis].abs_diff(b.end[axis]) <= 2;
            let apart = b.min[across].saturating_sub(a.end[across]).max(a.min[across].saturating_sub(b.end[across]));
            let slender = a.size()[axis] > 2 * a.size()[across] && b.size()[axis] > 2 * b.size()[across];
            same && slender && (1..=stroke).contains(&apart)
        })
    };
    let mut filled = dark.to_vec();
    for a in &walls {
        if !walls.iter().any(|b| a.min != b.min && beside(a, b)) {
            fields.paint(a, &mut filled, width, 1);
        }
    }
    filled
}

/// Whether a field has straight sides and is about as thick everywhere, as walls with corners are; triangles and tables
/// with lettering are not.
fn is_even(fields: &Components, field: &Component, thick: f64) -> bool {
    /// Within so many rows a line that is drawn by hand is off by so much.
    const WOBBLE_ROWS: usize = 6;
    const WOBBLE_PX: u32 = 1;
    let runs = fields.runs(field);
    // Rows may have several runs, as where walls meet at a corner: a side has a step where a run goes on differently. Lines
    // that are drawn by hand come back, the sides of triangles do not.
    let rows: Vec<&[Run]> = runs.chunk_by(|a, b| a.y == b.y).collect();
    if is_wedge(&rows) {
        return false;
    }
    let goes_on = |k: usize, later: usize, off: u32| {
        let next = rows[(k + later).min(rows.len() - 1)];
        let is_same = |a: &Run, b: &Run| a.from.abs_diff(b.from) <= off && a.to.abs_diff(b.to) <= off;
        rows[k].iter().all(|run| next.iter().any(|other| is_same(run, other)))
    };
    let steps = (0..rows.len()).filter(|&k| !goes_on(k, 1, 0) && !goes_on(k, WOBBLE_ROWS, WOBBLE_PX));
    let [w, h] = field.size().map(|side| side as usize);
    if steps.count() > 6 + h / 12 {
        return false;
    }
    let mut mask = vec![0u8; w * h];
    for run in runs {
        let row = (run.y - field.min[1]) as usize * w;
        mask[row + (run.from - field.min[0]) as usize..row + (run.to - field.min[0]) as usize].fill(1);
    }
    let share = |of: f64| {
        let kept = open(&mask, w, ((thick * of) as usize).max(1));
        kept.iter().filter(|&&k| k != 0).count() as f64 / field.area as f64
    };
    share(0.75) >= 0.6 && share(1.9) <= 0.3
}

/// Whether the rows of a field grow or shrink from one end to the other without a step, as in half a crossed cupboard.
fn is_wedge(rows: &[&[Run]]) -> bool {
    const TAPERS: f64 = 0.7;
    const STEP: f64 = 0.25;
    let widths: Vec<f64> = rows.iter().map(|row| row.iter().map(|run| f64::from(run.to - run.from)).sum()).collect();
    let most = widths.iter().copied().fold(0.0, f64::max);
    let has_step = widths.array_windows().any(|[a, b]| (a - b).abs() > (STEP * most).max(2.0));
    let tapers =
        |from: Option<&f64>, to: Option<&f64>| from.zip(to).is_some_and(|(a, b)| (a - b).abs() >= TAPERS * most);
    rows.iter().all(|row| row.len() == 1) && !has_step && tapers(widths.first(), widths.last())
}

/// Thickness of the rectangle with the area and outline of a white field of a drawing, pixels.
pub(super) fn thickness(dark: &[u8], width: usize, fields: &Components, field: &Component) -> f64 {
    let half = outline(dark, width, fields, field) as f64 * 0.5;
    (half - (half * half - 4.0 * field.area as f64).max(0.0).sqrt()) * 0.5
}

/// Length of a white field's outline, pixel edges.
fn outline(dark: &[u8], width: usize, fields: &Components, field: &Component) -> usize {
    let height = dark.len() / width;
    let mut edges = 0;
    for run in fields.runs(field) {
        let (y, from, to) = (run.y as usize, run.from as usize, run.to as usize);
        edges += 2;
        for row in [y.checked_sub(1), Some(y + 1).filter(|&y| y < height)] {
            edges += match row {
                Some(row) => dark[row * width + from..row * width + to].iter().filter(|&&d| d != 0).count(),
                None => to - from,
            };
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines of one pixel at 45 degrees, so many pixels apart along the rows, within what `is_wall` tells, with a border.
    fn hatched(apart: i32, is_wall: impl Fn(i32, i32) -> bool) -> (Vec<u8>, Vec<u8>) {
        const SIZE: i32 = 200;
        let places = || (0..SIZE * SIZE).map(|at| (at % SIZE, at / SIZE));
        let wall: Vec<u8> = places().map(|(x, y)| u8::from(is_wall(x, y))).collect();
        let is_line = |(x, y): (i32, i32)| {
            let is_border = [(-1, 0), (1, 0), (0, -1), (0, 1)].iter().any(|(dx, dy)| !is_wall(x + dx, y + dy));
            is_wall(x, y) && (is_border || (x + y) % apart == 0)
        };
        (places().map(|place| u8::from(is_line(place))).collect(), wall)
    }

    fn filled_share(dark: &[u8], wall: &[u8]) -> f64 {
        let filled = fill_hatches(dark, 200, 1.0 / 28.0);
        let count = |mask: &[u8]| mask.iter().filter(|&&on| on != 0).count() as f64;
        let both: Vec<u8> = filled.iter().zip(wall).map(|(&filled, &wall)| filled & wall).collect();
        count(&both) / count(wall)
    }

    /// Walls of 0.7 m whose lines are 20 cm apart were left as lines, and so were stripes where a wall runs along its hatch.
    #[test]
    fn wide_hatches_of_thick_walls_are_filled() {
        let (dark, wall) = hatched(8, |x, y| (20..180).contains(&x) && (50..70).contains(&y));
        assert!(filled_share(&dark, &wall) > 0.97, "{} of a wall", filled_share(&dark, &wall));
        // Upright, then about along the hatch.
        let bent = |x: i32, y: i32| {
            (20..40).contains(&x) && (100..180).contains(&y)
                || (20..100).contains(&x) && y < 101 && (0..26).contains(&(y - 87 + (x - 20) * 9 / 10))
        };
        let (dark, wall) = hatched(8, bent);
        assert!(filled_share(&dark, &wall) > 0.95, "{} of a bent wall", filled_share(&dark, &wall));
    }

    /// Treads of slanted stairs have corners.
    #[test]
    fn slanted_stairs_are_no_hatch() {
        // Eight treads of 28 cm by 1.2 m.
        let tread = |x: i32, y: i32| (0..88).contains(&(x + y - 143)) && (-24..24).contains(&(y - x));
        let (dark, wall) = hatched(11, tread);
        assert!(filled_share(&dark, &wall) < 0.4, "{} of the stairs", filled_share(&dark, &wall));
    }
}
