//! Parallel lines that fill floors: hatches of rooms, and planks without joints. They are taken off a drawing as coverings of
//! tiles are.
//!
//! They are known by repetition: many thin lines at one distance, over an area that is broader than walls and stairs.

use std::ops::Range;

use super::components::{Components, Neighbours};
use super::paving::{DARKER, Ink, LARGEST_PX, Straight};
use super::thick::{grow, long_runs, open, runs};

/// Greatest thickness of a line, pixels, and as a share of the distance between two.
const THICKEST_PX: usize = 6;
const THICKEST: f64 = 0.6;
/// Least distance between two lines, pixels, and greatest, as a share of the drawing's larger side.
const LEAST_PITCH_PX: usize = 4;
const GREATEST_PITCH: f64 = 0.04;
/// By how much distances in a row differ: pixels, and as a share.
const UNEVEN_PX: f64 = 1.0;
const UNEVEN: f64 = 0.08;
/// How many lines follow each other at least, beside what stands on the floor.
const FEWEST: usize = 5;
/// How far from the area lines belong to it, in its breadths.
const NEAR: usize = 2;
/// How many times as thick as its neighbour a line may be, and pixels more.
const THICKER: usize = 2;
const THICKER_PX: usize = 1;
/// Least length of a line, in distances between two.
const LONG: f64 = 3.0;
/// How far a slanting line is off the image's rows and columns at least: the lesser share of its way.
const SLANT: f64 = 0.25;
/// Least length of level and upright strokes, pixels: slanting lines have shorter runs in rows and columns.
const STROKE_PX: usize = 12;

/// Which lines are looked for.
struct Kind {
    slanting: bool,
    /// How many lines follow each other at least somewhere in the area.
    most: usize,
    /// Least breadth of the area that they fill, as a share of the drawing's larger side.
    breadth: f64,
}

/// Stairs have level or upright lines too, but fewer; hatched walls are slim.
const KINDS: [Kind; 2] =
    [Kind { slanting: true, most: 7, breadth: 0.05 }, Kind { slanting: false, most: 20, breadth: 0.08 }];

/// The lines of a drawing that follow each other.
struct Marks {
    /// How far each pixel of a line is from the next line, pixels, 0 for others, and whether it is within its row of lines; for
    /// lines along rows and along columns.
    ways: [Vec<(u8, bool)>; 2],
    /// 1 for pixels of either, and as far around as half the greatest distance between two.
    filled: Vec<u8>,
    /// How many follow each other there.
    count: Vec<u8>,
    /// How far that is, pixels.
    reach: usize,
}

impl Marks {
    fn of(ink: &Ink) -> Option<Marks> {
        let (width, height, pixels) = (ink.width, ink.height(), ink.dark.len());
        let greatest = ((width.max(height) as f64 * GREATEST_PITCH) as usize).min(usize::from(u8::MAX));
        let (mut marked, mut count) = (vec![0u8; pixels], vec![0u8; pixels]);
        let mut largest = 0;
        let rows: Vec<_> = (0..height).map(|y| (y * width, 1, width)).collect();
        let columns: Vec<_> = (0..width).map(|x| (x, width, height)).collect();
        let ways = [rows, columns].map(|ways| {
            let mut marks = vec![(0u8, false); pixels];
            for way in ways {
                mark(ink, way, greatest, |mark| {
                    marks[mark.at] = (mark.apart, mark.within);
                    marked[mark.at] = 1;
                    count[mark.at] = count[mark.at].max(mark.count.min(255) as u8);
                    largest = largest.max(usize::from(mark.apart));
                });
            }
            marks
        });
        let reach = largest / 2 + 1;
        (largest > 0).then(|| Marks { ways, filled: grow(&marked, width, reach), count, reach })
    }
}

/// Pixels of the lines that fill floors.
pub(super) fn lines(ink: &Ink) -> Vec<usize> {
    if ink.dark.len() > LARGEST_PX {
        return Vec::new();
    }
    let Some(marks) = Marks::of(ink) else { return Vec::new() };
    KINDS.iter().flat_map(|kind| of_kind(ink, &marks, kind)).collect()
}

fn of_kind(ink: &Ink, marks: &Marks, kind: &Kind) -> Vec<usize> {
    let width = ink.width;
    let broad = (width.max(ink.height()) as f64 * kind.breadth) as usize;
    let mut filled = open(&marks.filled, width, broad + 2 * marks.reach);
    let areas = Components::of(&filled, width, 1, Neighbours::Four);
    let is_row = |at: usize| usize::from(marks.count[at]) >= kind.most;
    for area in areas.all.iter().filter(|area| !areas.ranges(area, width).flatten().any(is_row)) {
        areas.paint(area, &mut filled, width, 0);
    }
    if !filled.contains(&1) {
        return Vec::new();
    }
    // Corners of a room are narrower.
    let around = grow(&filled, width, NEAR * broad);
    // Level and upright strokes stay whole where slanting lines cross them.
    let strokes = kind.slanting.then(|| [1, width].map(|stride| long_runs(&ink.dark, width, stride, STROKE_PX)));
    let is_free = |at: usize| strokes.iter().flatten().all(|strokes| strokes[at] == 0);
    let mut found = Vec::new();
    // Along rows, the upper and lower edges of furniture join no lines, and along columns the others.
    for marks in &marks.ways {
        let marked: Vec<u8> = marks.iter().map(|&(apart, _)| u8::from(apart != 0)).collect();
        let pieces = Components::of(&marked, width, 1, Neighbours::Eight);
        for piece in &pieces.all {
            let places: Vec<usize> = pieces.ranges(piece, width).flatten().collect();
            let least = LONG * places.iter().map(|&at| f64::from(marks[at].0)).sum::<f64>() / places.len() as f64;
            let within = places.iter().filter(|&&at| marks[at].1).count();
            let is_around = |at: usize| around[at] != 0;
            if f64::from(piece.larger_side()) < least
                || within * 2 < places.len()
                || !places.iter().any(|&at| is_around(at))
            {
                continue;
            }
            let line = Straight::of(&places, width);
            let is_slanting = line.way[0].abs().min(line.way[1].abs()) >= SLANT;
            if line.is_straight() && is_slanting == kind.slanting && line.length >= least {
                // A cut through a slanting line meets pixels that it has but a part of.
                let slant = line.way[0].abs() + line.way[1].abs();
                let thickness = ink.sum(places.iter().copied()) / line.length * slant;
                follow(&line, ink, thickness, is_around, is_free, &mut found);
            }
        }
    }
    found
}

/// Follows a line from its middle, over thin strokes that cross it, up to a wall, its end, or that of the area around.
fn follow(
    line: &Straight,
    ink: &Ink,
    thickness: f64,
    is_around: impl Fn(usize) -> bool,
    is_free: impl Fn(usize) -> bool,
    found: &mut Vec<usize>,
) {
    /// A step, pixels; longest gap and longest crossing, steps.
    const STEP: f64 = 0.5;
    const GAP: usize = 6;
    const CROSSING: usize = 12;
    /// What is left of it before its end, in its thicknesses.
    const END: f64 = 1.5;
    let across = [-line.way[1], line.way[0]];
    for sign in [-1.0, 1.0] {
        let (mut gap, mut crossing) = (0, 0);
        let mut stretch: Vec<Vec<usize>> = Vec::new();
        for step in 0.. {
            let along = sign * STEP * f64::from(step);
            let place =
                |k: i32| ink.pixel([0, 1].map(|a| line.middle[a] + along * line.way[a] + f64::from(k) * across[a]));
            let here = |k: i32| place(k).filter(|&at| ink.dark[at] != 0);
            if gap > GAP || crossing > CROSSING || !place(0).is_some_and(&is_around) {
                break;
            }
            let Some(centre) = [0, 1, -1, 2, -2].into_iter().find(|&k| here(k).is_some()) else {
                gap += 1;
                continue;
            };
            gap = 0;
            let side = |way: i32| (1..=THICKEST_PX as i32).map_while(move |k| here(centre + way * k));
            // Steps of a slanting line may meet a pixel twice.
            let mut cut: Vec<usize> = side(-1).chain(here(centre)).chain(side(1)).collect();
            cut.sort_unstable();
            cut.dedup();
            if ink.sum(cut.iter().copied()) <= DARKER * thickness + 0.2 {
                stretch.push(cut.into_iter().filter(|&at| is_free(at)).collect());
                crossing = 0;
            } else {
                crossing += 1;
            }
        }
        // Where it ends in the outline of what stands there, its last pixels are of both.
        stretch.truncate(stretch.len().saturating_sub((END * thickness / STEP) as usize));
        found.extend(stretch.into_iter().flatten());
    }
}

/// A line of a row of lines.
struct Mark {
    at: usize,
    /// How far it is from the next one, pixels.
    apart: u8,
    /// How many follow each other.
    count: usize,
    /// Whether there is another one, or a wall, on both sides: at the end of a row may be the edge of furniture.
    within: bool,
}

/// Finds in a row or column, which begins at `start`, the pixels of thin lines at even distances.
fn mark(ink: &Ink, (start, step, count): (usize, usize, usize), greatest: usize, mut found: impl FnMut(Mark)) {
    let runs: Vec<Range<usize>> = runs((0..count).filter(|k| ink.dark[start + k * step] != 0), 0).collect();
    let thick = |k: usize| runs[k].len();
    let is_thicker = |k: usize, than: usize| thick(k) > THICKER * thick(than) + THICKER_PX;
    let is_next = |k: usize| {
        let (apart, thickest) = (runs[k].start - runs[k - 1].start, thick(k).max(thick(k - 1)));
        (LEAST_PITCH_PX..=greatest).contains(&apart)
            && thickest <= THICKEST_PX
            && thickest as f64 <= THICKEST * apart as f64
            && !is_thicker(k, k - 1)
            && !is_thicker(k - 1, k)
    };
    let mut first = 0;
    while first < runs.len() {
        let mut end = first + 1;
        while end < runs.len() && is_next(end) {
            let mean = (runs[end - 1].start - runs[first].start) as f64 / (end - 1 - first).max(1) as f64;
            let off = (runs[end].start - runs[end - 1].start) as f64 - mean;
            if end - 1 > first && off.abs() > UNEVEN_PX + UNEVEN * mean {
                break;
            }
            end += 1;
        }
        if end - first >= FEWEST {
            let apart = (runs[end - 1].start - runs[first].start) / (end - 1 - first);
            let is_wall = |k: usize, line: usize| {
                let gap = if k < line { runs[line].start - runs[k].end } else { runs[k].start - runs[line].end };
                is_thicker(k, line) && gap <= apart + 1
            };
            for (k, run) in runs.iter().enumerate().take(end).skip(first) {
                let is_free = k == first && !(k > 0 && is_wall(k - 1, k))
                    || k + 1 == end && !(end < runs.len() && is_wall(end, k));
                for place in run.clone() {
                    let at = start + place * step;
                    found(Mark { at, apart: apart as u8, count: end - first, within: !is_free });
                }
            }
        }
        // The last line of one row may be the first of another.
        first = if end - first > 1 { end - 1 } else { end };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A room of 200 x 120 pixels in walls of 8, whose floor and a strip of whose right wall are filled by a rule.
    fn room(is_line: impl Fn(usize, usize) -> bool) -> Ink {
        let (width, height) = (300, 200);
        let mut dark = vec![0; width * height];
        for (y, row) in dark.chunks_exact_mut(width).enumerate() {
            for (x, dark) in row.iter_mut().enumerate() {
                let within = |low: usize, x: usize, high: usize| (low..high).contains(&x);
                let is_floor = within(40, x, 240) && within(30, y, 150);
                let is_wall = !is_floor && within(32, x, 248) && within(22, y, 158);
                // Furniture, in outline.
                let in_box = within(100, x, 140) && within(60, y, 90);
                let is_outline = in_box && !(within(102, x, 138) && within(62, y, 88));
                *dark = if is_wall || is_outline || is_floor && !in_box && is_line(x, y) { 255 } else { 0 };
            }
        }
        Ink { dark, width }
    }

    /// How many pixels of lines there are, and are left.
    fn before_and_after(ink: &Ink) -> [usize; 2] {
        let mut dark = ink.dark.clone();
        for at in lines(ink) {
            dark[at] = 0;
        }
        let plain = room(|_, _| false).dark;
        let at_box = |at: usize| (100..140).contains(&(at % 300)) && (60..90).contains(&(at / 300));
        let lost = (0..dark.len()).filter(|&at| plain[at] != 0 && dark[at] == 0 && !at_box(at));
        assert_eq!(lost.collect::<Vec<_>>(), [0; 0], "walls stay");
        let white = Components::of(&dark, 300, 0, Neighbours::Four);
        assert!(white.all.iter().any(|field| field.area >= 36 * 26 && field.area <= 40 * 30), "furniture stays closed");
        [&ink.dark, &dark]
            .map(|dark| dark.iter().zip(&plain).filter(|&(&dark, &plain)| dark != 0 && plain == 0).count())
    }

    #[test]
    fn hatches_and_planks_go_and_what_stands_on_them_stays() {
        for is_line in [
            (|x, y| (x + y) % 10 == 0) as fn(usize, usize) -> bool,
            |x, y| (x + 1000 - y) % 12 < 2,
            |x, _| x % 6 == 0,
            |_, y| y % 5 == 3,
        ] {
            let [before, left] = before_and_after(&room(is_line));
            assert!(left * 5 < before, "{left} of {before} pixels are left");
        }
    }

    #[test]
    fn stairs_and_hatched_walls_stay() {
        for is_line in [
            // Fourteen treads.
            (|x, y| (60..144).contains(&x) && x % 6 == 0 && y < 100) as fn(usize, usize) -> bool,
            // A wall of 12 pixels.
            |x, y| (200..212).contains(&x) && (x + y) % 4 == 0,
        ] {
            assert_eq!(lines(&room(is_line)), Vec::<usize>::new());
        }
    }
}
