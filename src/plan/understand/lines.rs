//! Walls that are drawn as single lines: level and upright lines that are neither furniture nor notes nor leaves of doors.

use std::ops::Range;

use super::super::components::{Component, Components, Neighbours, Run};
use super::thick::grow;

/// Least length of a line, metres.
const SHORTEST_M: f64 = 0.4;
/// Thickness that a line becomes, metres.
const THICK_M: f64 = 0.1;
/// Sides of the box around the arc of a door, metres, and how far from a square it may be.
const ARC_M: [f64; 2] = [0.45, 1.5];
const SQUARE: f64 = 0.75;
/// Largest field that furniture encloses, square metres.
const LARGEST_FIELD_M2: f64 = 7.0;
/// Share of a line with such a field beside it from which it is furniture.
const FURNITURE_SHARE: f64 = 0.8;
/// How far from its wall's line the arc of a door may be, metres, and share of the gap that the dashes of an axis fill.
const BESIDE_M: f64 = 0.25;
const DASHED: std::ops::Range<f64> = 0.4..0.97;
/// Largest tick of a dimension line, and how near to the line's end it is, metres.
const TICK_M: f64 = 0.4;

/// Finds lines that may be walls among strokes without lettering, and makes them thick. Returns how far they grew too, pixels.
pub(super) fn thickened(strokes: &[u8], width: usize, metres_per_pixel: f64) -> (Vec<u8>, usize) {
    let px = |metres: f64| (metres / metres_per_pixel).round() as usize;
    let least = px(SHORTEST_M).max(6);
    let mut level = long_runs(strokes, width, 1, least);
    let mut upright = long_runs(strokes, width, width, least);
    let is_rest = |at: usize| strokes[at] & (1 - level[at]) & (1 - upright[at]);
    let rest: Vec<u8> = (0..strokes.len()).map(is_rest).collect();
    let pieces = Components::of(&rest, width, 1, Neighbours::Eight);
    let metres = |side: u32| f64::from(side) * metres_per_pixel;
    let height = strokes.len() / width;
    // Leaves lie in the boxes of their arcs; walls do not.
    for arc in &pieces.all {
        let [w, h] = arc.size().map(metres);
        if w.min(h) >= ARC_M[0] && w.max(h) <= ARC_M[1] && w.min(h) >= SQUARE * w.max(h) {
            let range = |axis: usize, side: usize| {
                (arc.min[axis] as usize).saturating_sub(2)..(arc.end[axis] as usize + 2).min(side)
            };
            for y in range(1, height) {
                let row = y * width;
                level[row..][range(0, width)].fill(0);
                upright[row..][range(0, width)].fill(0);
            }
            // The dashes of an axis along the wall fill the gap beside the arc.
            let beside = |axis: usize, side: usize| {
                let reach = px(BESIDE_M);
                (arc.min[axis] as usize).saturating_sub(reach)..(arc.end[axis] as usize + reach).min(side)
            };
            let spans = [0, 1].map(|axis| arc.min[axis] as usize..arc.end[axis] as usize);
            let is_dashed = |span: &Range<usize>, at: &dyn Fn(usize) -> usize| {
                let dark = span.clone().filter(|&k| strokes[at(k)] != 0).count() as f64;
                DASHED.contains(&(dark / span.len().max(1) as f64))
            };
            for x in beside(0, width) {
                if is_dashed(&spans[1], &|y| y * width + x) {
                    spans[1].clone().for_each(|y| upright[y * width + x] = 0);
                }
            }
            for y in beside(1, height) {
                if is_dashed(&spans[0], &|x| y * width + x) {
                    level[y * width..][spans[0].clone()].fill(0);
                }
            }
        }
    }
    drop_frame(&mut level, &mut upright, width);
    let ticks: Vec<[f64; 2]> = pieces
        .all
        .iter()
        // Aslant: dots and dashes of axes are level or upright.
        .filter(|tick| metres(tick.larger_side()) <= TICK_M && tick.size().iter().all(|&side| side >= 3))
        .map(|tick| [0, 1].map(|axis| f64::from(tick.min[axis] + tick.end[axis]) * 0.5))
        .collect();
    let near_px = px(TICK_M) as f64;
    let has_ticks = |line: &Component, along: usize| {
        let across = 1 - along;
        let at_end = |end: f64| {
            let middle = f64::from(line.min[across] + line.end[across]) * 0.5;
            ticks.iter().any(|t| (t[along] - end).abs() <= near_px && (t[across] - middle).abs() <= near_px * 0.5)
        };
        at_end(f64::from(line.min[along])) && at_end(f64::from(line.end[along]))
    };
    let mut has_dimensions = false;
    for (mask, along) in [(&mut level, 0), (&mut upright, 1)] {
        let lines = Components::of(mask, width, 1, Neighbours::Eight);
        for line in lines.all.iter().filter(|line| has_ticks(line, along)) {
            lines.paint(line, mask, width, 0);
            has_dimensions = true;
        }
    }
    // Without dimensions a line that ends freely may well be a wall: mazes have such.
    if has_dimensions {
        prune(&mut level, &mut upright, width, metres_per_pixel);
    }
    let lines: Vec<u8> = level.iter().zip(&upright).map(|(&a, &b)| a | b).collect();
    let fields = small_fields(&lines, width, LARGEST_FIELD_M2 / (metres_per_pixel * metres_per_pixel));
    let mut walls = vec![0u8; strokes.len()];
    for (mask, along) in [(&level, 0), (&upright, 1)] {
        let lines = Components::of(mask, width, 1, Neighbours::Eight);
        for line in &lines.all {
            if !is_furniture(line, along, &fields, width, height) {
                lines.paint(line, &mut walls, width, 1);
            }
        }
    }
    let reach = px(THICK_M * 0.5).max(1);
    (grow(&walls, width, reach), reach)
}

/// A level or upright line: its two ends along itself, and the two sides across, pixels.
#[derive(Clone, Copy)]
struct Line {
    along: [i64; 2],
    across: [i64; 2],
}

/// Takes off dashes of axes, and what goes on beyond the last wall that a line meets: axes and the extension lines of
/// dimensions end freely. A wall that ends at a door goes on behind it.
fn prune(level: &mut [u8], upright: &mut [u8], width: usize, metres_per_pixel: f64) {
    /// Longest dash, and widest door or opening behind which a wall goes on, metres.
    const DASH_M: f64 = 1.2;
    const GAP_M: f64 = 2.2;
    /// More lines are no drawing of walls.
    const MOST: usize = 3000;
    /// How far off lines still meet, pixels.
    const NEAR: i64 = 3;
    let px = |metres: f64| (metres / metres_per_pixel).round() as i64;
    let lines_of = |mask: &[u8], axis: usize| -> Vec<Line> {
        let range = |line: &Component, axis: usize| [i64::from(line.min[axis]), i64::from(line.end[axis]) - 1];
        let all = Components::of(mask, width, 1, Neighbours::Eight).all;
        all.iter().map(|line| Line { along: range(line, axis), across: range(line, 1 - axis) }).collect()
    };
    let mut lines = [lines_of(level, 0), lines_of(upright, 1)];
    if lines.iter().any(|lines| lines.len() > MOST) {
        return;
    }
    for _ in 0..20 {
        let before = lines.clone();
        for axis in 0..2 {
            let (own, cross) = (&before[axis], &before[1 - axis]);
            for (n, line) in lines[axis].iter_mut().enumerate().filter(|(_, line)| line.along[0] <= line.along[1]) {
                let [from, to] = line.along;
                // Where lines across meet it, and where they lie beyond its ends.
                let covers =
                    |other: &Line| other.along[0] - NEAR <= line.across[1] && other.along[1] + NEAR >= line.across[0];
                let others = cross.iter().filter(|other| other.along[0] <= other.along[1] && covers(other));
                let (mut first, mut last) = (i64::MAX, i64::MIN);
                let mut goes_on = [false; 2];
                for other in others {
                    if other.across[1] + NEAR >= from && other.across[0] - NEAR <= to {
                        first = first.min(other.across[0]);
                        last = last.max(other.across[1]);
                    } else if other.across[1] < from {
                        goes_on[0] |= from - other.across[1] <= px(GAP_M);
                    } else {
                        goes_on[1] |= other.across[0] - to <= px(GAP_M);
                    }
                }
                if first > last {
                    if to - from < px(DASH_M) {
                        line.along = [1, 0];
                    }
                    continue;
                }
                for other in own.iter().enumerate().filter(|&(k, other)| k != n && other.along[0] <= other.along[1]) {
                    let other = other.1;
                    if other.across[0] - NEAR <= line.across[1] && other.across[1] + NEAR >= line.across[0] {
                        goes_on[0] |= (1..=px(GAP_M)).contains(&(from - other.along[1]));
                        goes_on[1] |= (1..=px(GAP_M)).contains(&(other.along[0] - to));
                    }
                }
                if !goes_on[0] {
                    line.along[0] = from.max(first);
                }
                if !goes_on[1] {
                    line.along[1] = to.min(last);
                }
            }
        }
        if lines.iter().flatten().map(|line| line.along).eq(before.iter().flatten().map(|line| line.along)) {
            break;
        }
    }
    for (axis, (mask, lines)) in [level, upright].into_iter().zip(&lines).enumerate() {
        let mut kept = vec![0u8; mask.len()];
        for line in lines {
            for across in line.across[0]..=line.across[1] {
                for along in line.along[0]..=line.along[1] {
                    let [x, y] = if axis == 0 { [along, across] } else { [across, along] };
                    kept[y as usize * width + x as usize] = 1;
                }
            }
        }
        mask.iter_mut().zip(&kept).for_each(|(pixel, kept)| *pixel &= kept);
    }
}

/// Takes off the frame of a sheet: lines without a gap around others that are more. A building's walls have a door.
fn drop_frame(level: &mut [u8], upright: &mut [u8], width: usize) {
    /// Least share of a side that a frame covers, and least share of its sides that what is within takes.
    const COVERED: f64 = 0.98;
    const WITHIN: f64 = 0.3;
    let lines: Vec<u8> = level.iter().zip(upright.iter()).map(|(&a, &b)| a | b).collect();
    let pieces = Components::of(&lines, width, 1, Neighbours::Eight);
    // Lengths, not areas: a frame is often drawn thicker than walls.
    let begins = |mask: &[u8], at: usize, before: usize| {
        usize::from(mask[at] != 0 && at.checked_sub(before).is_none_or(|before| mask[before] == 0))
    };
    let length_px = |piece: &Component| -> usize {
        let of_run = |&Run { y, from, to }: &Run| (from..to).map(move |x| y as usize * width + x as usize);
        let pixels = pieces.runs(piece).iter().flat_map(of_run);
        pixels.map(|at| begins(level, at, width) + begins(upright, at, 1)).sum()
    };
    let mut frames = Vec::new();
    for frame in &pieces.all {
        let [w, h] = frame.size();
        let within = |p: &&Component| (0..2).all(|axis| p.min[axis] > frame.min[axis] && p.end[axis] < frame.end[axis]);
        let inner = || pieces.all.iter().filter(within);
        let is_large = |p: &Component| (0..2).all(|axis| f64::from(p.size()[axis]) >= WITHIN * f64::from([w, h][axis]));
        if !inner().any(is_large) || inner().map(length_px).sum::<usize>() < length_px(frame) {
            continue;
        }
        let is_on = |x: u32, y: u32| lines[y as usize * width + x as usize] != 0;
        let [x0, y0] = frame.min;
        let (x1, y1) = (frame.end[0] - 1, frame.end[1] - 1);
        let rows = [y0, y1].map(|y| (x0..=x1).filter(|&x| is_on(x, y)).count() as f64 / f64::from(w));
        let columns = [x0, x1].map(|x| (y0..=y1).filter(|&y| is_on(x, y)).count() as f64 / f64::from(h));
        if rows.iter().chain(&columns).all(|&covered| covered >= COVERED) {
            frames.push(frame);
        }
    }
    for frame in frames {
        pieces.paint(frame, level, width, 0);
        pieces.paint(frame, upright, width, 0);
    }
}

/// Keeps the pixels of runs of a least length; `stride` is 1 along rows and the width along columns.
fn long_runs(mask: &[u8], width: usize, stride: usize, least: usize) -> Vec<u8> {
    let (lines, length) = if stride == 1 { (mask.len() / width, width) } else { (width, mask.len() / width) };
    let start = if stride == 1 { width } else { 1 };
    let mut kept = vec![0u8; mask.len()];
    for line in 0..lines {
        let mut from = 0;
        for k in 0..=length {
            let is_on = k < length && mask[line * start + k * stride] != 0;
            if !is_on {
                if k - from >= least {
                    (from..k).for_each(|k| kept[line * start + k * stride] = 1);
                }
                from = k + 1;
            }
        }
    }
    kept
}

/// Marks the white fields of a drawing of lines that are smaller than this, pixels.
fn small_fields(lines: &[u8], width: usize, largest: f64) -> Vec<u8> {
    let white = Components::of(lines, width, 0, Neighbours::Four);
    let mut small = vec![0u8; lines.len()];
    for field in white.all.iter().filter(|field| (field.area as f64) < largest) {
        white.paint(field, &mut small, width, 1);
    }
    small
}

/// Whether a line has small fields along one of its sides.
fn is_furniture(line: &Component, along: usize, fields: &[u8], width: usize, height: usize) -> bool {
    let across = 1 - along;
    let length = line.size()[along] as usize;
    let side = |at: Option<usize>, end: usize| {
        let Some(at) = at.filter(|&at| at < end) else { return 0 };
        let first = line.min[along] as usize;
        let pixel = |k: usize| if along == 0 { at * width + first + k } else { (first + k) * width + at };
        (0..length).filter(|&k| fields[pixel(k)] != 0).count()
    };
    let end = if along == 0 { height } else { width };
    let before = side((line.min[across] as usize).checked_sub(1), end);
    let after = side(Some(line.end[across] as usize), end);
    before.max(after) as f64 >= FURNITURE_SHARE * length as f64
}
