//! Walls that are drawn as single lines: level and upright lines that are neither furniture nor notes nor leaves of doors.

use std::ops::Range;

use super::super::components::{Component, Components, Neighbours, Run};
use super::super::drawing::is_on;
use super::super::thick::{grow, long_runs};
use super::hollow;

/// Least length of a line, metres.
const SHORTEST_M: f64 = 0.4;
/// Thickness that a line becomes, metres.
const THICK_M: f64 = 0.1;
/// Sides of the box around the arc of a door, metres, and how far from a square it may be.
const ARC_M: [f64; 2] = [0.45, 1.5];
const SQUARE: f64 = 0.75;
/// Largest piece between a level and an upright line that rounds a corner, metres.
const CORNER_M: f64 = 0.25;
/// Largest field that furniture encloses, square metres.
const LARGEST_FIELD_M2: f64 = 7.0;
/// Greatest thickness of the field between the two lines of a glass wall and its least length, metres: it is no furniture.
const PANE_M: [f64; 2] = [0.15, 1.5];
/// The same thickness where the glass wall has corners: the backs of sofas are thicker.
const BENT_PANE_M: f64 = 0.09;
/// Share of a line with a field of furniture beside it from which it is furniture.
const FURNITURE_SHARE: f64 = 0.8;
/// How far from its wall's line the arc of a door may be, metres, and share of the gap that the dashes of an axis fill.
const BESIDE_M: f64 = 0.25;
const DASHED: Range<f64> = 0.4..0.97;
/// How far a leaf is from the side of its arc's box, metres.
const LEAF_M: f64 = 0.06;
/// Largest tick of a dimension line, and how near to the line's end it is, metres.
const TICK_M: f64 = 0.4;
/// Shortest line with a tick at both ends that is a dimension for sure, metres: letters lie at the ends of a chair's.
const NOTE_M: f64 = 1.5;
/// How far apart the two lines of a glass wall are at most, metres, and along which share of the longer both run at least.
const PAIR_M: f64 = 0.2;
const IN_PAIR: f64 = 0.8;
/// By how much the two ticks of a line differ at most, pixels.
const ALIKE_PX: u32 = 2;

/// Finds lines that may be walls among strokes without lettering, and makes them thick. Returns how far they grew too,
/// pixels.
///
/// `ink` is all that is drawn, `panes` what closes the walls in `strokes` to the outside.
pub(super) fn thickened(
    strokes: &[u8],
    ink: &[u8],
    panes: &[u8],
    width: usize,
    metres_per_pixel: f64,
) -> (Vec<u8>, usize) {
    let px = |metres: f64| (metres / metres_per_pixel).round() as usize;
    let least = px(SHORTEST_M).max(6);
    let mut level = long_runs(strokes, width, 1, least);
    let mut upright = long_runs(strokes, width, width, least);
    let is_rest = |at: usize| strokes[at] & (1 - level[at]) & (1 - upright[at]);
    let rest: Vec<u8> = (0..strokes.len()).map(is_rest).collect();
    let pieces = Components::of(&rest, width, 1, Neighbours::Eight);
    drop(rest);
    let in_doors = take_doors(strokes, &pieces, [&mut level, &mut upright], width, metres_per_pixel);
    drop_frame(&mut level, &mut upright, width);
    let ticks = Ticks::new(&pieces, metres_per_pixel);
    let has_axes = drop_axes([&mut level, &mut upright], ink, width, metres_per_pixel);
    let heads = Heads::new(&pieces, strokes.len(), width, metres_per_pixel);
    let mut has_notes = false;
    for (mask, along) in [(&mut level, 0), (&mut upright, 1)] {
        let lines = Components::of(mask, width, 1, Neighbours::Eight);
        for line in &lines.all {
            let crossed = ticks.end(line, along).or_else(|| heads.end(line, along).then_some(true));
            let crossed = crossed
                .filter(|_| panes.is_empty() || !lines.all.iter().any(|other| is_pair(line, other, along, px(PAIR_M))));
            if let Some(is_note) = crossed {
                lines.paint(line, mask, width, 0);
                has_notes = has_notes || is_note && line.size()[along] as usize >= px(NOTE_M);
            }
        }
    }
    drop((ticks, heads));
    let mut closed = panes.to_vec();
    closed.resize(strokes.len(), 0);
    for corner in pieces.all.iter().filter(|piece| piece.larger_side() as usize <= px(CORNER_M)) {
        pieces.paint(corner, &mut closed, width, 1);
    }
    drop(pieces);
    // Without dimensions and axes a line that ends freely may well be a wall: mazes have such.
    if has_notes || has_axes {
        let mut between = ink.to_vec();
        in_doors.into_iter().for_each(|at| between[at] = 0);
        prune(&mut level, &mut upright, [&between, panes], width, metres_per_pixel);
    }
    let lines: Vec<u8> = level.iter().zip(&upright).map(|(&a, &b)| a | b).collect();
    closed.iter_mut().zip(&lines).for_each(|(closed, line)| *closed |= line);
    let fields = small_fields(&closed, width, metres_per_pixel);
    let mut walls = vec![0u8; strokes.len()];
    for (mask, along) in [(&level, 0), (&upright, 1)] {
        let pieces = Components::of(mask, width, 1, Neighbours::Eight);
        for line in &pieces.all {
            // Mullions part the field of a glass wall. Where windows are not known, they are drawn so too.
            let is_long = !panes.is_empty() && line.size()[along] as usize >= px(PANE_M[1]);
            let is_glass = || is_long && pieces.all.iter().any(|other| is_pair(line, other, along, px(PANE_M[0])));
            if !is_furniture(line, along, &fields, &lines, width) || is_glass() {
                pieces.paint(line, &mut walls, width, 1);
            }
        }
    }
    let reach = px(THICK_M * 0.5).max(1);
    (grow(&walls, width, reach), reach)
}

/// Whether another line of about the same length lies close beside a line: glass walls are drawn by two, with mullions across.
/// The edge of a desk is shorter than the wall that it stands at.
fn is_pair(line: &Component, other: &Component, along: usize, farthest: usize) -> bool {
    let across = 1 - along;
    let apart = [other.min[across].checked_sub(line.end[across]), line.min[across].checked_sub(other.end[across])];
    let is_beside = apart.into_iter().flatten().any(|px| px > 0 && px as usize <= farthest);
    let from = line.min[along].max(other.min[along]);
    let both = line.end[along].min(other.end[along]).saturating_sub(from);
    is_beside && f64::from(both) >= IN_PAIR * f64::from(line.size()[along].max(other.size()[along]))
}

/// Takes the leaves of doors off level and upright lines, and the dashes of axes that fill the gaps beside their arcs.
/// Returns the pixels of leaves and of what lies in doors: not what is drawn between lines that end, as dashes of axes are.
fn take_doors(
    strokes: &[u8],
    pieces: &Components,
    [level, upright]: [&mut [u8]; 2],
    width: usize,
    metres_per_pixel: f64,
) -> Vec<usize> {
    let px = |metres: f64| (metres / metres_per_pixel).round() as usize;
    let height = strokes.len() / width;
    let mut in_doors = Vec::new();
    // Leaves lie along the sides of their arcs' boxes; furniture may reach into them.
    let beside_leaf = px(LEAF_M).max(2);
    let is_arc = |arc: &&Component| {
        let [w, h] = arc.size().map(|side| f64::from(side) * metres_per_pixel);
        w.min(h) >= ARC_M[0] && w.max(h) <= ARC_M[1] && w.min(h) >= SQUARE * w.max(h)
    };
    for arc in pieces.all.iter().filter(is_arc) {
        let around =
            |at: u32, side: usize| (at as usize).saturating_sub(beside_leaf)..(at as usize + beside_leaf).min(side);
        let ends = |axis: usize, side: usize| [around(arc.min[axis], side), around(arc.end[axis], side)];
        let [columns, rows] = [ends(0, width), ends(1, height)];
        let is_side = |ends: &[Range<usize>; 2], at: usize| ends.iter().any(|end| end.contains(&at));
        for y in rows[0].start..rows[1].end {
            for x in columns[0].start..columns[1].end {
                for (mask, is_side) in [(&mut *upright, is_side(&columns, x)), (&mut *level, is_side(&rows, y))] {
                    if is_side {
                        mask[y * width + x] = 0;
                        in_doors.push(y * width + x);
                    }
                }
            }
        }
        // The dashes of an axis along the wall fill the gap beside the arc.
        let beside = |axis: usize, side: usize| {
            let reach = px(BESIDE_M);
            (arc.min[axis] as usize).saturating_sub(reach)..(arc.end[axis] as usize + reach).min(side)
        };
        let [across, down] = [0, 1].map(|axis| arc.min[axis] as usize..arc.end[axis] as usize);
        let mut take_dashes = |mask: &mut [u8], line: Vec<usize>| {
            let dark = line.iter().filter(|&&at| strokes[at] != 0).count() as f64;
            if DASHED.contains(&(dark / line.len().max(1) as f64)) {
                line.iter().for_each(|&at| mask[at] = 0);
                in_doors.extend(line);
            }
        };
        for x in beside(0, width) {
            take_dashes(upright, down.clone().map(|y| y * width + x).collect());
        }
        for y in beside(1, height) {
            take_dashes(level, across.clone().map(|x| y * width + x).collect());
        }
    }
    in_doors
}

/// Small strokes aslant, at the ends of dimension lines: dots and dashes of axes are level or upright.
struct Ticks<'a> {
    all: Vec<&'a Component>,
    near_px: f64,
}

impl Ticks<'_> {
    fn new(pieces: &Components, metres_per_pixel: f64) -> Ticks<'_> {
        let is_tick = |tick: &&Component| {
            f64::from(tick.larger_side()) * metres_per_pixel <= TICK_M && tick.size().iter().all(|&side| side >= 3)
        };
        Ticks { all: pieces.all.iter().filter(is_tick).collect(), near_px: (TICK_M / metres_per_pixel).round() }
    }

    /// Whether those at both ends of a line cross it, if there are such of one size, as letters that lie on a line are not. The
    /// line parts what crosses it: half lies on either side, while the round corners of furniture lie on one.
    fn end(&self, line: &Component, along: usize) -> Option<bool> {
        let across = 1 - along;
        let centre = |piece: &Component, axis: usize| f64::from(piece.min[axis] + piece.end[axis]) * 0.5;
        let off = |tick: &Component| centre(tick, across) - centre(line, across);
        let at_end = |end: u32| -> Vec<&Component> {
            let is_near = |tick: &&&Component| {
                (centre(tick, along) - f64::from(end)).abs() <= self.near_px && off(tick).abs() <= self.near_px * 0.5
            };
            self.all.iter().filter(is_near).copied().collect()
        };
        let crosses = |ticks: &[&Component], tick: &Component| {
            let is_over = tick.min[across] < line.min[across] && tick.end[across] > line.end[across];
            is_over || ticks.iter().any(|other| off(other) * off(tick) < 0.0)
        };
        let is_alike =
            |a: &Component, b: &Component| (0..2).all(|axis| a.size()[axis].abs_diff(b.size()[axis]) <= ALIKE_PX);
        let [first, last] = [line.min[along], line.end[along]].map(at_end);
        let alike = first.iter().flat_map(|a| last.iter().map(move |b| (*a, *b))).filter(|(a, b)| is_alike(a, b));
        alike.map(|(a, b)| crosses(&first, a) && crosses(&last, b)).max()
    }
}

/// Small strokes that may be the arrow heads or dots at the ends of dimension lines.
struct Heads {
    /// 1 for their pixels, beside all long lines.
    mask: Vec<u8>,
    width: usize,
    reach: usize,
}

impl Heads {
    fn new(pieces: &Components, pixels: usize, width: usize, metres_per_pixel: f64) -> Heads {
        let reach = (TICK_M / metres_per_pixel).round() as usize;
        let mut mask = vec![0u8; pixels];
        for piece in pieces.all.iter().filter(|piece| piece.larger_side() as usize <= reach) {
            pieces.paint(piece, &mut mask, width, 1);
        }
        Heads { mask, width, reach }
    }

    /// Whether a line has about as much of them on both sides of both of its ends.
    fn end(&self, line: &Component, along: usize) -> bool {
        /// Least ink on a side, pixels, and how many times as much another may have.
        const LEAST_PX: usize = 3;
        const UNLIKE: usize = 2;
        let across = 1 - along;
        let sizes = [self.width, self.mask.len() / self.width];
        let ink = |end: usize, side: Range<usize>| {
            let columns = end.saturating_sub(self.reach)..(end + self.reach / 4).min(sizes[along]);
            let rows = side.start..side.end.min(sizes[across]);
            let at = |column: usize, row: usize| {
                if along == 0 { row * self.width + column } else { column * self.width + row }
            };
            rows.map(|row| columns.clone().filter(|&column| self.mask[at(column, row)] != 0).count()).sum::<usize>()
        };
        let (first, last) = (line.min[across] as usize, line.end[across] as usize);
        let beside = (self.reach / 4).max(2);
        let sides = |end: usize| [ink(end, first.saturating_sub(beside)..first), ink(end, last..last + beside)];
        // Before the first end as much counts as beyond the last one.
        let [a, b] = sides(line.min[along] as usize + self.reach * 3 / 4);
        let [c, d] = sides(line.end[along] as usize);
        let least = a.min(b).min(c).min(d);
        least >= LEAST_PX && a.max(b).max(c).max(d) <= UNLIKE * least
    }
}

/// Takes dashes of axes off level and upright lines. Returns whether there are axes: rows or columns in which dashes and
/// dots take turns, with even gaps.
fn drop_axes(masks: [&mut Vec<u8>; 2], ink: &[u8], width: usize, metres_per_pixel: f64) -> bool {
    /// Longest dot and longest gap, and least dash, metres; the fewest dots of an axis.
    const DOT_M: f64 = 0.2;
    const GAP_M: f64 = 0.4;
    const DASH_M: f64 = 0.3;
    const FEWEST: usize = 3;
    let px = |metres: f64| ((metres / metres_per_pixel).round() as usize).max(2);
    let (dot, longest, least) = (px(DOT_M), px(GAP_M), px(DASH_M));
    let height = ink.len() / width;
    let mut has_axes = false;
    for (along, mask) in masks.into_iter().enumerate() {
        let (lines, length) = if along == 0 { (height, width) } else { (width, height) };
        let mut runs: Vec<Range<usize>> = Vec::new();
        for line in 0..lines {
            let at = |k: usize| if along == 0 { line * width + k } else { k * width + line };
            runs.clear();
            for k in (0..length).filter(|&k| ink[at(k)] != 0) {
                match runs.last_mut() {
                    Some(run) if run.end == k => run.end += 1,
                    _ => runs.push(k..k + 1),
                }
            }
            let is_dot = |k: usize| {
                let (before, own, after) = (&runs[k - 1], &runs[k], &runs[k + 1]);
                let gaps = [own.start - before.end, after.start - own.end];
                own.len() <= dot
                    && gaps.iter().all(|gap| (2..=longest).contains(gap))
                    && gaps[0].abs_diff(gaps[1]) <= 2
                    && before.len().min(after.len()) >= least.max(2 * gaps[0].max(gaps[1]))
            };
            let dots: Vec<usize> = (1..runs.len().saturating_sub(1)).filter(|&k| is_dot(k)).collect();
            if dots.len() < FEWEST {
                continue;
            }
            has_axes = true;
            // Dashes have a dot at both ends; what is longer is a wall below the axis.
            let whole = dots
                .iter()
                .filter(|&&k| dots.binary_search(&(k + 2)).is_ok())
                .map(|&k| runs[k + 1].len())
                .min()
                .unwrap_or(0);
            for run in dots.iter().flat_map(|&k| [&runs[k - 1], &runs[k + 1]]).filter(|run| run.len() <= whole + 2) {
                run.clone().for_each(|k| mask[at(k)] = 0);
            }
        }
    }
    has_axes
}

/// A level or upright line: its two ends along itself, and the two sides across, pixels.
#[derive(Clone, Copy)]
struct Line {
    along: [i64; 2],
    across: [i64; 2],
}

/// Takes off dashes of axes, and what goes on beyond the last wall that a line meets: axes and the extension lines of
/// dimensions end freely. A wall that ends at a door goes on behind it; where an axis goes on, `between` shows its dashes.
/// One that ends at `panes` ends there.
fn prune(level: &mut [u8], upright: &mut [u8], [between, panes]: [&[u8]; 2], width: usize, metres_per_pixel: f64) {
    /// Longest dash, and narrowest and widest door or opening behind which a wall goes on, metres.
    const DASH_M: f64 = 1.2;
    const GAP_M: Range<f64> = 0.5..2.2;
    /// Share of a gap from which what is drawn in it are dashes.
    const DASHES: f64 = 0.25;
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
    let is_gap = |px_wide: i64| (px(GAP_M.start)..=px(GAP_M.end)).contains(&px_wide);
    // Whether a mask has a pixel on a line or straight on from it.
    let is_met = |mask: &[u8], axis: usize, line: &Line, along: i64| {
        (line.across[0]..=line.across[1]).any(|across| {
            let [x, y] = if axis == 0 { [along, across] } else { [across, along] };
            (0..width as i64).contains(&x) && y >= 0 && is_on(mask, y as usize * width + x as usize)
        })
    };
    // Whether a gap in the line of a wall, beyond one of its ends, is free of dashes.
    let is_open = |axis: usize, line: &Line, [from, to]: [i64; 2]| {
        let dark = |along: i64| is_met(between, axis, line, along);
        let within = from + NEAR..to - NEAR;
        is_gap(to - from) && (within.clone().filter(|&k| dark(k)).count() as f64) < DASHES * within.count() as f64
    };
    let at_pane =
        |axis: usize, line: &Line, end: i64| (end - NEAR..=end + NEAR).any(|along| is_met(panes, axis, line, along));
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
                let mut goes_on = [from, to].map(|end| at_pane(axis, line, end));
                for other in others {
                    if other.across[1] + NEAR >= from && other.across[0] - NEAR <= to {
                        first = first.min(other.across[0]);
                        last = last.max(other.across[1]);
                    } else if other.across[1] < from {
                        goes_on[0] = goes_on[0] || is_open(axis, line, [other.across[1] + 1, from]);
                    } else {
                        goes_on[1] = goes_on[1] || is_open(axis, line, [to + 1, other.across[0]]);
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
                        goes_on[0] = goes_on[0] || is_open(axis, line, [other.along[1] + 1, from]);
                        goes_on[1] = goes_on[1] || is_open(axis, line, [to + 1, other.along[0]]);
                    }
                }
                if !goes_on[0] {
                    line.along[0] = from.max(first);
                }
                if !goes_on[1] {
                    line.along[1] = to.min(last);
                }
                // What is left of a dash at furniture.
                if line.along != [from, to] && line.along[1] - line.along[0] < px(DASH_M * 0.5) {
                    line.along = [1, 0];
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

/// Marks the white fields of a drawing of lines that are as small as what furniture encloses.
fn small_fields(lines: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let white = Components::of(lines, width, 0, Neighbours::Four);
    let mut small = vec![0u8; lines.len()];
    for field in &white.all {
        let [w, h] = field.size().map(|side| f64::from(side) * metres_per_pixel);
        let thin = || hollow::thickness(lines, width, &white, field) * metres_per_pixel <= BENT_PANE_M;
        let is_pane = w.max(h) >= PANE_M[1] && (w.min(h) <= PANE_M[0] || thin());
        if !is_pane && field.area as f64 * metres_per_pixel * metres_per_pixel < LARGEST_FIELD_M2 {
            white.paint(field, &mut small, width, 1);
        }
    }
    small
}

/// Whether a line has small fields along one of its sides; what meets it there, in `drawn`, does not count.
fn is_furniture(line: &Component, along: usize, fields: &[u8], drawn: &[u8], width: usize) -> bool {
    let across = 1 - along;
    let sizes = [width, fields.len() / width];
    let length = line.size()[along] as usize;
    let share = |at: Option<usize>| {
        let Some(at) = at.filter(|&at| at < sizes[across]) else { return 0.0 };
        let first = line.min[along] as usize;
        let pixel = |k: usize| if along == 0 { at * width + first + k } else { (first + k) * width + at };
        let free = (0..length).filter(|&k| drawn[pixel(k)] == 0).count();
        (0..length).filter(|&k| fields[pixel(k)] != 0).count() as f64 / free.max(length / 2).max(1) as f64
    };
    let sides = [(line.min[across] as usize).checked_sub(1), Some(line.end[across] as usize)];
    sides.into_iter().any(|side| share(side) >= FURNITURE_SHARE)
}
