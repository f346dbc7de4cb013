//! Gaps between wall ends that face each other: doors and windows.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use super::super::cracks::trace;
use super::super::thick::{places, runs, spread, transposed};
use super::directions;
use super::frame::Frame;

/// How much thicker than a gap the wall at one of its ends may be, and that at both ends of an entrance; of the gap's depth.
const ONE_END: f64 = 0.5;
const BOTH_ENDS: f64 = 0.2;

/// A gap in a wall, and what is drawn in it.
#[derive(Clone, Debug)]
pub(super) struct Gap {
    /// The way in which the wall runs.
    frame: Frame,
    /// First row of the wall.
    first: usize,
    /// The gap in each row.
    rows: Vec<[usize; 2]>,
    /// Strokes from jamb to jamb.
    pub(super) strokes: usize,
    /// Whether bars lie in it along the wall, none of which reaches from jamb to jamb: the leaves of a sliding door.
    pub(super) slides: bool,
    /// Whether the wings of a revolving door turn in it.
    pub(super) turns: bool,
    /// Whether it lies across the end of a corridor of its width, where a mouth without a door looks the same.
    pub(super) at_end: bool,
    /// A pixel of each wall end.
    pub(super) ends: [usize; 2],
}

impl Gap {
    /// A window with panes of glass, from place to place along and across its frame.
    pub(super) fn pane(frame: Frame, [from, to]: [f64; 2], [first, end]: [f64; 2]) -> Gap {
        let [from, to, first, end] = [from, to, first, end].map(|place| place.round().max(0.0) as usize);
        let rows = vec![[from, to]; end.saturating_sub(first).max(1)];
        Gap { frame, first, rows, strokes: 2, slides: false, turns: false, at_end: false, ends: [0; 2] }
    }

    /// From where to where the gap's middle row goes, and where the middle of the wall is, in the gap's frame.
    pub(super) fn middle(&self) -> ([f64; 2], f64) {
        let across = self.first as f64 + self.rows.len() as f64 * 0.5;
        (self.rows[self.rows.len() / 2].map(|v| v as f64), across)
    }

    /// The same gap with both jambs moved back by some pixels.
    pub(super) fn widened(&self, by: usize) -> Gap {
        let rows = self.rows.iter().map(|[from, to]| [from.saturating_sub(by), to + by]).collect();
        Gap { rows, ..self.clone() }
    }

    /// The same gap with its jambs moved together by some pixels each.
    pub(super) fn narrowed(&self, [first, last]: [usize; 2]) -> Gap {
        let rows = self.rows.iter().map(|[from, to]| [from + first, (to - last).max(from + first)]).collect();
        Gap { rows, ..self.clone() }
    }

    /// Thickness of the wall, pixels.
    pub(super) fn thickness(&self) -> f64 {
        self.rows.len() as f64
    }

    /// A place of the gap's frame in the image, if it is in there.
    pub(super) fn pixel(&self, along: f64, across: f64) -> Option<usize> {
        self.frame.pixel([along, across])
    }

    /// A place of the gap's frame, pixels of the image.
    pub(super) fn place(&self, at: [f64; 2]) -> [f64; 2] {
        self.frame.place(at)
    }

    /// The middle of both jambs, pixels.
    pub(super) fn jambs(&self) -> [[f64; 2]; 2] {
        let ([from, to], across) = self.middle();
        [from, to].map(|along| self.frame.place([along, across]))
    }

    /// The way in which the wall runs, in the image.
    pub(super) fn along(&self) -> [f64; 2] {
        self.frame.along
    }

    pub(super) fn length(&self) -> usize {
        let [from, to] = self.rows[self.rows.len() / 2];
        to - from
    }

    /// How far each of its two jambs stands out from other walls, up to `most`, pixels.
    pub(super) fn jamb_lengths(&self, wall: &[u8], most: usize) -> [usize; 2] {
        let ([from, to], across) = self.middle();
        let beside = 0.5 * self.thickness() + 1.5;
        let is_wall = |along: f64, off: f64| self.pixel(along, across + off).is_some_and(|at| wall[at] != 0);
        let is_out = |along: f64| is_wall(along, 0.0) && !(is_wall(along, -beside) && is_wall(along, beside));
        let ways = [(from - 0.5, -1.0), (to + 0.5, 1.0)];
        ways.map(|(end, way)| (0..most).take_while(|&k| is_out(end + way * k as f64)).count())
    }

    /// A pixel on each of its sides, if it is in the image.
    pub(super) fn sides(&self) -> [Option<usize>; 2] {
        const BEYOND_PX: f64 = 3.0;
        let ([from, to], across) = self.middle();
        let beyond = 0.5 * self.thickness() + BEYOND_PX;
        [-1.0, 1.0].map(|side| self.pixel(0.5 * (from + to), across + side * beyond))
    }

    /// Whether it has inside on one of its sides at most.
    pub(super) fn leads_out(&self, inside: &[u8]) -> bool {
        !self.sides().into_iter().all(|side| side.is_some_and(|at| inside[at] != 0))
    }

    /// All its pixels, as indices.
    pub(super) fn pixels(&self) -> Vec<usize> {
        let mut all = Vec::new();
        // Between slanted rows and upright pixels no leak may stay.
        let (step, beyond) = if self.frame.is_upright() { (1.0, 0.0) } else { (0.5, 1.0) };
        let last = self.first + self.rows.len() - 1;
        for (k, &[from, to]) in self.rows.iter().enumerate() {
            let mut across = (self.first + k) as f64 + step * 0.5;
            while across < (self.first + k + 1) as f64 && self.first + k <= last {
                let mut along = from as f64 - beyond + step * 0.5;
                while along < to as f64 + beyond {
                    all.extend(self.frame.pixel([along, across]));
                    along += step;
                }
                across += step;
            }
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// A mask of an image of so many pixels: 1 in the gaps.
pub(super) fn mask<'g>(gaps: impl IntoIterator<Item = &'g Gap>, pixels: usize) -> Vec<u8> {
    let mut mask = vec![0; pixels];
    gaps.into_iter().flat_map(Gap::pixels).for_each(|at| mask[at] = 1);
    mask
}

/// What gaps may be, pixels.
pub(super) struct Limits<'a> {
    pub(super) shortest: usize,
    /// The same of windows.
    pub(super) shortest_pane: usize,
    pub(super) longest: usize,
    pub(super) thinnest: usize,
    pub(super) thickest: usize,
    /// Directions in which gaps are sought besides those of walls.
    pub(super) slanted: &'a [f64],
}

/// Finds the gaps of a wall mask, in walls of all directions; strokes are counted in `ink`, both non-zero.
pub(super) fn find(wall: &[u8], ink: &[u8], width: usize, limits: &Limits) -> Vec<Gap> {
    let image = [width, wall.len() / width];
    let outline = trace(wall, width);
    let mut slanted = directions::slanted(&outline, limits.shortest, limits.thinnest);
    for &angle in limits.slanted {
        if !slanted.iter().any(|&other| directions::is_same(angle, other)) {
            slanted.push(angle);
        }
    }
    let turned = |angle| Frame::turned(image, angle);
    let frames: Vec<Frame> = match directions::skew(&outline, image) {
        Some(skew) => {
            let others = slanted.into_iter().filter(|angle| !directions::is_same(*angle, skew));
            std::iter::once(skew).chain(others).map(turned).collect()
        }
        None => std::iter::once(Frame::upright(image)).chain(slanted.into_iter().map(turned)).collect(),
    };
    in_frames(frames, wall, ink, width, limits)
}

/// The same in walls that run as the image's rows or columns do.
pub(super) fn find_upright(wall: &[u8], ink: &[u8], width: usize, limits: &Limits) -> Vec<Gap> {
    in_frames(vec![Frame::upright([width, wall.len() / width])], wall, ink, width, limits)
}

fn in_frames(frames: Vec<Frame>, wall: &[u8], ink: &[u8], width: usize, limits: &Limits) -> Vec<Gap> {
    // Of fine strokes, a turned grid shows all that lies around a place between four pixels.
    let mut ink_around = Vec::new();
    if !frames.iter().all(Frame::is_upright) {
        ink_around.extend_from_slice(ink);
        spread(&mut ink_around, width, 2, false);
    }
    let seen = frames.into_par_iter().flat_map_iter(|frame| {
        let (wall, ink) = match frame.is_upright() {
            true => (Cow::Borrowed(wall), Cow::Borrowed(ink)),
            false => (Cow::Owned(frame.view(wall, 0.5)), Cow::Owned(frame.view(&ink_around, 0.0))),
        };
        let columns = transposed(&wall, frame.size[0]);
        let in_columns = in_grid(frame.transposed(), columns, &transposed(&ink, frame.size[0]), limits);
        in_grid(frame, wall.into_owned(), &ink, limits).into_iter().chain(in_columns)
    });
    let mut all: Vec<Gap> = Vec::new();
    for mut gap in seen.collect::<Vec<Gap>>() {
        let Some(ends) = ends(&gap, wall) else { continue };
        // Seen aslant, a gap is longer than it is, or reaches from a wall that ends in it.
        if all.iter().any(|other| other.strokes >= 2 && is_within(&gap, other)) {
            continue;
        }
        let is_shorter = |other: &Gap| {
            other.length() <= gap.length() || other.length() * 7 <= gap.length() * 8 && has_straight_jambs(other)
        };
        if all.iter().any(|other| is_same(&gap, other) && is_shorter(other)) {
            continue;
        }
        gap.ends = ends;
        all.retain(|other| !is_same(&gap, other));
        all.push(gap);
    }
    without_overlaps(all)
}

/// The gaps along the rows of a grid that shows walls and strokes.
fn in_grid(frame: Frame, wall: Vec<u8>, ink: &[u8], limits: &Limits) -> Vec<Gap> {
    let mut found = along_rows(&wall, ink, limits, frame);
    let met = met_by_walls(wall, ink, limits, frame, &found);
    // A window takes in the pieces of it that were found on one side of the wall that ends in it.
    found.retain(|gap| !met.iter().any(|window| overlaps(gap, window)));
    found.extend(met);
    found
}

/// Leaves out gaps that lie across shorter ones of another direction.
fn without_overlaps(mut all: Vec<Gap>) -> Vec<Gap> {
    if all.iter().all(|gap| gap.frame.is_upright()) {
        return all;
    }
    all.sort_by_key(|gap| (gap.length(), gap.ends));
    let mut taken = BTreeMap::new();
    let mut kept: Vec<Gap> = Vec::new();
    for gap in all {
        let pixels = gap.pixels();
        let crossed = |at: &&usize| taken.get(*at).is_some_and(|&along: &[f64; 2]| along != gap.frame.along);
        if pixels.iter().filter(crossed).count() * 8 > pixels.len() {
            continue;
        }
        taken.extend(pixels.into_iter().map(|at| (at, gap.frame.along)));
        kept.push(gap);
    }
    kept
}

/// A pixel of the wall at each end of a gap, if there is wall.
fn ends(gap: &Gap, wall: &[u8]) -> Option<[usize; 2]> {
    let ([from, to], across) = gap.middle();
    let across = across.floor() + 0.5;
    let end = |at: f64, way: f64| {
        (0..4).find_map(|k| gap.pixel(at + way * (f64::from(k) + 0.5), across).filter(|&at| wall[at] != 0))
    };
    Some([end(from, -1.0)?, end(to, 1.0)?])
}

/// Whether two gaps are the same one, seen in two directions.
fn is_same(a: &Gap, b: &Gap) -> bool {
    let middle = |gap: &Gap| {
        let [p, q] = gap.jambs();
        [(p[0] + q[0]) * 0.5, (p[1] + q[1]) * 0.5]
    };
    if a.frame.along == b.frame.along {
        return false;
    }
    let ([ax, ay], [bx, by]) = (middle(a), middle(b));
    let near = 0.6 * a.length().min(b.length()) as f64;
    (ax - bx) * (ax - bx) + (ay - by) * (ay - by) <= near * near
}

/// Whether both jambs of a gap lie in another one of another direction, or beside it if more strokes run through the other.
fn is_within(gap: &Gap, other: &Gap) -> bool {
    let ([ax, ay], [from, _]) = (other.frame.along, other.jambs());
    let (length, thickness) = (other.length() as f64, other.thickness());
    let beside = if other.strokes > gap.strokes { 0.5 * thickness + gap.thickness() } else { thickness };
    gap.frame.along != other.frame.along
        && gap.jambs().into_iter().all(|[x, y]| {
            let (dx, dy) = (x - from[0], y - from[1]);
            let (along, across) = (dx * ax + dy * ay, dy * ax - dx * ay);
            (-thickness..=length + thickness).contains(&along) && across.abs() <= beside
        })
}

fn along_rows(wall: &[u8], ink: &[u8], limits: &Limits, frame: Frame) -> Vec<Gap> {
    let [width, height] = frame.size;
    let slack = (limits.thinnest / 3).max(2);
    let mut open: Vec<Gap> = Vec::new();
    let mut found = Vec::new();
    for y in 0..=height {
        let gaps = if y < height { gaps_of(&wall[y * width..(y + 1) * width], limits) } else { Vec::new() };
        let mut taken = vec![false; gaps.len()];
        let mut going_on = Vec::new();
        for mut gap in open {
            let last = gap.rows[gap.rows.len() - 1];
            let near = |g: &[usize; 2]| g[0].abs_diff(last[0]) <= slack && g[1].abs_diff(last[1]) <= slack;
            match gaps.iter().position(near) {
                Some(k) if !taken[k] => {
                    taken[k] = true;
                    gap.rows.push(gaps[k]);
                    going_on.push(gap);
                }
                _ => found.push(gap),
            }
        }
        let fresh = gaps.iter().zip(&taken).filter(|(_, taken)| !**taken);
        going_on.extend(fresh.map(|(&g, _)| Gap {
            frame,
            first: y,
            rows: vec![g],
            strokes: 0,
            slides: false,
            turns: false,
            at_end: false,
            ends: [0; 2],
        }));
        open = going_on;
    }
    let is_open = |gap: &Gap| {
        (limits.thinnest..=limits.thickest).contains(&gap.rows.len()) && is_square(gap) && is_free(wall, width, gap)
    };
    let has_end = |gap: &Gap| [false, true].into_iter().any(|forwards| is_end(wall, width, gap, forwards, ONE_END));
    let mut across_ends = Vec::new();
    found.retain(|gap| {
        let is_gap = is_open(gap) && has_end(gap);
        if !is_gap {
            across_ends.extend(at_ends(wall, width, gap, limits).filter(is_open));
        }
        is_gap
    });
    found.extend(across_ends);
    for gap in &mut found {
        gap.strokes = strokes(ink, width, gap);
        let has_ends = [false, true].into_iter().all(|forwards| is_end(wall, width, gap, forwards, BOTH_ENDS));
        gap.slides = has_ends && slides(ink, width, gap);
    }
    // Lights beside a door or a window, behind a narrow pier.
    let (short, mut found): (Vec<Gap>, Vec<Gap>) = found.into_iter().partition(|gap| gap.length() < limits.shortest);
    let is_light = |gap: &Gap| {
        gap.strokes >= 2
            && found.iter().any(|other| overlaps(&gap.widened(limits.shortest), other) && !overlaps(gap, other))
    };
    let lights: Vec<Gap> = short.into_iter().filter(is_light).collect();
    found.extend(lights);
    found
}

/// The gaps in the walls across the ends of a corridor: rows of it that go on as a wall to both sides, where the walls beside
/// the corridor are thin; or all rows, where the corridor is a little wider than the gap.
fn at_ends(wall: &[u8], width: usize, gap: &Gap, limits: &Limits) -> impl Iterator<Item = Gap> {
    let longest = 4 * limits.thickest;
    let depths = |k: usize| {
        let row = &wall[(gap.first + k) * width..][..width];
        let [from, to] = gap.rows[k];
        let depth = |pixels: &mut dyn Iterator<Item = &u8>| pixels.take(longest).take_while(|&&w| w != 0).count();
        [depth(&mut row[..from].iter().rev()), depth(&mut row[to..].iter())]
    };
    let all: Vec<[usize; 2]> = (0..gap.rows.len()).map(depths).collect();
    let count = all.len();
    let least = [0, 1].map(|end| {
        let mut depths: Vec<usize> = all.iter().map(|depths| depths[end]).collect();
        2 * *depths.select_nth_unstable(count / 2).1 + limits.thinnest
    });
    let is_deep = |k: usize| (0..2).all(|end| all[k][end] >= least[end]);
    let before = (0..count).take_while(|&k| is_deep(k)).count();
    let after = (0..count).rev().take_while(|&k| is_deep(k)).count();
    let whole = if all.iter().flatten().all(|&depth| depth >= count) { count } else { 0 };
    let at_end = |rows: Range<usize>| Gap {
        frame: gap.frame,
        first: gap.first + rows.start,
        rows: gap.rows[rows].to_vec(),
        strokes: 0,
        slides: false,
        turns: false,
        at_end: true,
        ends: [0; 2],
    };
    let found = [0..before, count - after..count, 0..whole];
    found.map(|rows| (!rows.is_empty()).then(|| at_end(rows))).into_iter().flatten()
}

/// Windows into which the end of a wall across them reaches, as partitions that end at a mullion do.
fn met_by_walls(mut wall: Vec<u8>, ink: &[u8], limits: &Limits, frame: Frame, plain: &[Gap]) -> Vec<Gap> {
    let width = frame.size[0];
    for row in wall.chunks_exact_mut(width.max(1)) {
        let thin: Vec<Range<usize>> = runs(places(row), 1).filter(|run| run.len() <= 2 * limits.thinnest).collect();
        thin.into_iter().for_each(|run| row[run].fill(0));
    }
    let mut found = along_rows(&wall, ink, limits, frame);
    found.retain(|gap| {
        let pieces: Vec<&Gap> = plain.iter().filter(|other| overlaps(gap, other)).collect();
        let known: usize = pieces.iter().map(|piece| piece.length() + 2 * limits.thinnest).sum();
        // A piece too short for a gap of its own would let the room out.
        gap.strokes >= 2 && pieces.iter().all(|piece| piece.strokes >= 2) && known < gap.length()
    });
    // Panes between piers are no leaves.
    found.iter_mut().for_each(|gap| gap.slides = false);
    found
}

/// Whether two gaps of one frame have places in common.
fn overlaps(a: &Gap, b: &Gap) -> bool {
    let ([p, q], [r, s]) = (a.middle().0, b.middle().0);
    a.first < b.first + b.rows.len() && b.first < a.first + a.rows.len() && p < s && r < q
}

fn gaps_of(row: &[u8], limits: &Limits) -> Vec<[usize; 2]> {
    let mut gaps = Vec::new();
    let mut last_wall = None;
    for x in places(row) {
        if let Some(last) = last_wall
            && (limits.shortest_pane..=limits.longest).contains(&(x - last - 1))
        {
            gaps.push([last + 1, x]);
        }
        last_wall = Some(x);
    }
    gaps
}

/// Whether a gap's jambs are about square to it; else they are slanted walls.
fn is_square(gap: &Gap) -> bool {
    let (first, last) = (gap.rows[0], gap.rows[gap.rows.len() - 1]);
    (0..2).all(|k| first[k].abs_diff(last[k]) * 4 <= gap.rows.len() + 4)
}

/// Whether both jambs of a gap are so straight across it that no other direction shows it better.
fn has_straight_jambs(gap: &Gap) -> bool {
    /// Fewest rows that tell, and for how many of them a jamb may be a pixel off.
    const FEWEST: usize = 8;
    const PER_PIXEL: usize = 12;
    let off = |k: usize| {
        let ends = || gap.rows.iter().map(|row| row[k]);
        ends().max().unwrap_or(0) - ends().min().unwrap_or(0)
    };
    gap.rows.len() >= FEWEST && (0..2).all(|k| off(k) * PER_PIXEL <= gap.rows.len())
}

/// Whether both sides of a gap lead on, and its ends are ends of a wall at least on one side.
fn is_free(wall: &[u8], width: usize, gap: &Gap) -> bool {
    let height = wall.len() / width;
    let beside = |y: Option<usize>| {
        let Some(y) = y.filter(|&y| y < height) else { return [0.0, 0.0] };
        let [from, to] = gap.rows[gap.rows.len() / 2];
        let count = wall[y * width + from..y * width + to].iter().filter(|&&w| w != 0).count();
        let ends = [from - 1, to].iter().filter(|&&x| wall[y * width + x] != 0).count();
        [count as f64 / (to - from) as f64, ends as f64]
    };
    let sides = [beside(gap.first.checked_sub(3)), beside(Some(gap.first + gap.rows.len() + 2))];
    sides.iter().all(|[share, _]| *share <= 0.3) && sides.iter().any(|[_, ends]| *ends < 2.0)
}

/// Whether the wall on one side of a gap is as thick as the gap and goes on, `slack` of its thickness apart. Else two faces
/// only lie opposite.
fn is_end(wall: &[u8], width: usize, gap: &Gap, forwards: bool, slack: f64) -> bool {
    let height = wall.len() / width;
    let thick = gap.rows.len();
    let [from, to] = gap.rows[thick / 2];
    let y = gap.first + thick / 2;
    let is_wall = |x: usize, y: usize| wall[y * width + x] != 0;
    let step = |k: usize| if forwards { Some(to + k).filter(|&x| x < width) } else { (from - 1).checked_sub(k) };
    let deep = (0..thick * 2).take_while(|&k| step(k).is_some_and(|x| is_wall(x, y))).count();
    let around = |x: usize| {
        let most = thick * 3;
        let up = (1..most).take_while(|&k| y >= k && is_wall(x, y - k)).count();
        let down = (1..most).take_while(|&k| y + k < height && is_wall(x, y + k)).count();
        [up, down]
    };
    let cut = |within: usize| around(if forwards { to + within } else { from - 1 - within });
    let (near, far) = ((deep / 2).min(3), deep.saturating_sub(2).min(thick * 3 / 2));
    if deep * 5 < thick * 4 {
        return false;
    }
    let ([up, down], [far_up, far_down]) = (cut(near), cut(far));
    // A short wall before the end of one across it, as between two doors beside a corner, is not the gap's wall.
    let is_stub = (far_up + far_down + 1) * 3 < thick;
    // The middle of a wall that runs on aslant moves.
    let middles = [up as f64 - down as f64, far_up as f64 - far_down as f64];
    let is_level = far <= near + 2
        || (far_up + far_down + 1) * 2 > thick * 3 + 4
        || (middles[0] - middles[1]).abs() * 0.5 <= 0.2 * (far - near) as f64 + 1.0;
    (up + down) as f64 <= (1.0 + slack) * thick as f64 + 1.0 && is_level && !is_stub
}

/// Number of strokes that run through the gap: the second least of seven cuts across. A dashed line is an axis, or a beam
/// above an opening.
fn strokes(ink: &[u8], width: usize, gap: &Gap) -> usize {
    /// Least break between two dashes, pixels, and how many of them are as long as the gap at most.
    const LEAST_BREAK_PX: usize = 4;
    const LEAST_BREAK: usize = 40;
    let height = ink.len() / width;
    let thick = gap.rows.len();
    let margin = (thick / 6).max(1);
    let [from, to] = gap.rows[thick / 2];
    let rows = gap.first.saturating_sub(margin)..(gap.first + thick + margin).min(height);
    let mut counts: Vec<usize> = (1..=7)
        .map(|k| {
            let x = from + (to - from) * k / 8;
            let (mut count, mut run) = (0, 0);
            for y in rows.clone() {
                if ink[y * width + x] != 0 {
                    run += 1;
                    count += usize::from(run == 1);
                    // Blurred lines of a window run together.
                    if thick >= 4 && run * 5 > thick * 3 {
                        return 3;
                    }
                } else {
                    run = 0;
                }
            }
            count
        })
        .collect();
    counts.sort_unstable();
    let is_dashed = || {
        let is_inked = |x: &usize| rows.clone().any(|y| ink[y * width + x] != 0);
        let dashes: Vec<usize> = (from..to).filter(is_inked).collect();
        let is_break = |pair: &[usize; 2]| pair[1] - pair[0] > LEAST_BREAK_PX.max((to - from) / LEAST_BREAK);
        dashes.array_windows().any(is_break)
    };
    if counts[1] == 1 && is_dashed() { 0 } else { counts[1] }
}

/// Whether bars along the wall cover much of a gap, and none of them all of it: sliding doors have leaves beside each other
/// or before fixed panes, windows have lines from jamb to jamb.
fn slides(ink: &[u8], width: usize, gap: &Gap) -> bool {
    /// Least length of a leaf, share of the gap that leaves cover, and share from which a line goes through; of the gap.
    const LEAF: f64 = 0.2;
    const COVERED: f64 = 0.5;
    const THROUGH: f64 = 0.9;
    /// Longest break of a line that goes through, pixels.
    const BREAK_PX: usize = 2;
    let height = ink.len() / width;
    let thick = gap.rows.len();
    let margin = (thick / 6).max(1);
    let [from, to] = gap.rows[thick / 2];
    let length = to - from;
    // Lines that run aslant to the grid go over from row to row.
    let rows = if gap.frame.is_upright() { 1 } else { 2 };
    let all_rows = gap.first.saturating_sub(margin)..(gap.first + thick + margin).min(height);
    // Two leaves that meet in the middle leave a slit there, however narrow.
    let is_slit = |k: usize| all_rows.clone().all(|y| ink[y * width + from + k] == 0);
    let longest_break = if (length * 2 / 5..length * 3 / 5).any(is_slit) { 0 } else { BREAK_PX };
    let mut covered = vec![false; length];
    for y in all_rows.clone() {
        let is_ink = |k: usize, rows: usize| (y..(y + rows).min(height)).any(|y| ink[y * width + from + k] != 0);
        let inked = |rows: usize| (0..length).filter(move |&k| is_ink(k, rows));
        if runs(inked(rows), longest_break).any(|run| run.len() as f64 >= THROUGH * length as f64) {
            return false;
        }
        let leaves = runs(inked(1), 0).filter(|run| run.len() as f64 >= LEAF * length as f64);
        leaves.for_each(|leaf| covered[leaf].fill(true));
    }
    covered.iter().filter(|&&covered| covered).count() as f64 >= COVERED * length as f64
}
