//! Lines of floor coverings: tiles, planks, paving. They are neither walls nor furniture, and are taken off a drawing.
//!
//! They are known by repetition: many closed cells of one size lie side by side, each with four or more like it around.
//! Treads of stairs, hatches of walls, desks and lockers have two or three.

use std::collections::BTreeMap;

use super::components::{Components, Neighbours};
use super::drawing::Drawing;
use crate::math::{atan2, sin_cos};

/// Lightness below which a pixel may be a fine line.
const FAINT: u8 = 180;
/// Largest drawing that is searched, pixels.
const LARGEST_PX: usize = 40_000_000;
/// Least side of a cell, pixels, and greatest, as a share of the drawing's larger side.
const LEAST_SIDE_PX: u32 = 4;
const GREATEST_SIDE: f64 = 0.2;
/// Greatest thickness of a line, pixels, and as a share of a cell's lesser side.
const THICKEST_PX: usize = 6;
const THICKEST: f64 = 0.34;
/// By how much cells of one size differ, as a share of their area or of their lesser side.
const ALIKE: f64 = 0.12;
/// Fewest cells like it around a cell in the middle of a covering, and fewest such cells of a covering.
const FEWEST_AROUND: usize = 4;
const FEWEST_MIDDLES: usize = 6;
/// How far lines are followed from between two whole cells to what cuts the covering, in longer sides of a cell.
const FOLLOWED: f64 = 1.5;
/// Stretch of a line before its end that is left, pixels: it may be the outline of what stands there.
const END_PX: usize = 4;
/// Least length of the line between a cell and one that is cut off, in lesser sides of the whole one.
const CUT_CONTACT: f64 = 0.4;

/// A cell of light between lines.
struct Cell {
    area: f64,
    /// Lesser and greater side of its box, pixels.
    sides: [f64; 2],
    /// Whether it lies along the image's rows rather than its columns.
    lies: bool,
}

impl Cell {
    /// Whether two cells may be of one covering: tiles have one area, planks one width and one direction.
    fn is_like(&self, other: &Cell) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.max(b) + 1.0;
        let is_long = |cell: &Cell| cell.sides[1] >= 1.5 * cell.sides[0];
        let are_planks = is_long(self) && is_long(other) && self.lies == other.lies;
        let areas = (self.area - other.area).abs() <= ALIKE * self.area.max(other.area) + self.sides[1];
        near(self.sides[0], other.sides[0]) && (are_planks || near(self.sides[1], other.sides[1]) && areas)
    }

    /// Whether it may be what is left of another one that something cuts.
    fn fits_in(&self, whole: &Cell) -> bool {
        let most = 1.0 + ALIKE;
        self.sides[0] <= most * whole.sides[0] + 1.0 && self.area <= most * whole.area + whole.sides[1]
    }
}

/// Takes the lines of floor coverings off a drawing.
pub(super) fn drop_paving(drawing: &mut Drawing) {
    let (width, pixels) = (drawing.width, drawing.dark.len());
    if pixels > LARGEST_PX {
        return;
    }
    let ink: Vec<u8> = (0..pixels)
        .map(|at| {
            let coloured = drawing.coloured.get(at).is_some_and(|&c| c != 0);
            u8::from(drawing.dark[at] != 0 || drawing.lightness[at] < FAINT || coloured)
        })
        .collect();
    for at in lines(&ink, width) {
        drawing.dark[at] = 0;
        drawing.lightness[at] = 255;
        if let Some(coloured) = drawing.coloured.get_mut(at) {
            *coloured = 0;
        }
    }
}

/// Pixels of the lines of coverings.
fn lines(ink: &[u8], width: usize) -> Vec<usize> {
    let Some((cells, label)) = cells(ink, width) else { return Vec::new() };
    let between = between(&label, ink, width, &cells);
    let is_whole = coverings(&cells, &between);
    let mut found = Vec::new();
    for (&[a, b], line) in &between {
        let whole = match [a, b].map(|k| is_whole[k]) {
            [true, _] => &cells[a],
            [_, true] => &cells[b],
            _ => continue,
        };
        let straight = Straight::of(line, width);
        let both = is_whole[a] && is_whole[b];
        let is_cut_off =
            || [a, b].iter().all(|&k| cells[k].fits_in(whole)) && straight.length >= CUT_CONTACT * whole.sides[0];
        if straight.is_straight() && (both || is_cut_off()) {
            found.extend_from_slice(line);
            let fits = |at: usize| label[at].checked_sub(1).is_some_and(|k| cells[k as usize].fits_in(whole));
            follow(&straight, ink, width, FOLLOWED * whole.sides[1], fits, &mut found);
        }
    }
    found
}

/// The cells that may be of a covering, and for each pixel one more than the index of its cell, or 0. None if they are few.
fn cells(ink: &[u8], width: usize) -> Option<(Vec<Cell>, Vec<u32>)> {
    let all = Components::of(ink, width, 0, Neighbours::Four);
    let greatest = GREATEST_SIDE * width.max(ink.len() / width) as f64;
    let small = all.all.iter().filter(|piece| {
        let [w, h] = piece.size();
        w.min(h) >= LEAST_SIDE_PX && f64::from(w.max(h)) <= greatest
    });
    let small: Vec<_> = small.collect();
    if small.len() < FEWEST_MIDDLES + 2 * FEWEST_AROUND {
        return None;
    }
    let mut label = vec![0; ink.len()];
    let mut cells = Vec::with_capacity(small.len());
    for piece in small {
        let [w, h] = piece.size().map(f64::from);
        cells.push(Cell { area: piece.area as f64, sides: [w.min(h), w.max(h)], lies: w > h });
        for run in all.runs(piece) {
            let row = run.y as usize * width;
            label[row + run.from as usize..row + run.to as usize].fill(cells.len() as u32);
        }
    }
    Some((cells, label))
}

/// The pixels of the thin line between each two cells that lie beside each other, lower index first.
fn between(label: &[u32], ink: &[u8], width: usize, cells: &[Cell]) -> BTreeMap<[usize; 2], Vec<usize>> {
    let height = label.len() / width;
    let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    let mut scan = |start: usize, step: usize, count: usize| {
        let mut last: Option<(usize, u32)> = None;
        for k in 0..count {
            let at = start + k * step;
            if ink[at] != 0 {
                continue;
            }
            let here = label[at];
            if let Some((from, there)) = last
                && here != 0
                && there != 0
                && here != there
            {
                let [a, b] = [here.min(there), here.max(there)].map(|label| label as usize - 1);
                let thick = k - from - 1;
                if thick <= THICKEST_PX && thick as f64 <= THICKEST * cells[a].sides[0].min(cells[b].sides[0]) + 1.0 {
                    between.entry([a, b]).or_default().extend((from + 1..k).map(|k| start + k * step));
                }
            }
            last = Some((k, here));
        }
    };
    (0..height).for_each(|y| scan(y * width, 1, width));
    (0..width).for_each(|x| scan(x, width, height));
    between
}

/// For each cell, whether it is a whole one of a covering.
fn coverings(cells: &[Cell], between: &BTreeMap<[usize; 2], Vec<usize>>) -> Vec<bool> {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); cells.len()];
    for (&[a, b], line) in between {
        let least = 0.25 * cells[a].sides[0].min(cells[b].sides[0]);
        if cells[a].is_like(&cells[b]) && line.len() as f64 >= least {
            around[a].push(b);
            around[b].push(a);
        }
    }
    let is_middle = |k: usize| around[k].len() >= FEWEST_AROUND;
    let mut seen = vec![false; cells.len()];
    let mut whole = vec![false; cells.len()];
    for first in (0..cells.len()).filter(|&k| is_middle(k)) {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut group = vec![first];
        let mut next = 0;
        while let Some(&k) = group.get(next) {
            next += 1;
            for &near in around[k].iter().filter(|&&near| is_middle(near)) {
                if !std::mem::replace(&mut seen[near], true) {
                    group.push(near);
                }
            }
        }
        if group.len() >= FEWEST_MIDDLES {
            // From the middle on, all that is like its neighbour.
            while let Some(k) = group.pop() {
                if !std::mem::replace(&mut whole[k], true) {
                    group.extend_from_slice(&around[k]);
                }
            }
        }
    }
    whole
}

/// The straight line through some pixels.
struct Straight {
    middle: [f64; 2],
    way: [f64; 2],
    /// How far the pixels reach along the line and across it, pixels.
    length: f64,
    breadth: f64,
}

impl Straight {
    fn of(line: &[usize], width: usize) -> Straight {
        let places = || line.iter().map(|&at| [(at % width) as f64, (at / width) as f64]);
        let n = line.len().max(1) as f64;
        let middle = [0, 1].map(|k| places().map(|p| p[k]).sum::<f64>() / n);
        let moment = |j: usize, k: usize| places().map(|p| (p[j] - middle[j]) * (p[k] - middle[k])).sum::<f64>();
        let angle = 0.5 * atan2(2.0 * moment(0, 1), moment(0, 0) - moment(1, 1));
        let (sine, cosine) = sin_cos(angle);
        let way = [cosine, sine];
        let reach = |[x, y]: [f64; 2]| {
            let along = places().map(|p| (p[0] - middle[0]) * x + (p[1] - middle[1]) * y);
            let range = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
            range[1] - range[0] + 1.0
        };
        Straight { middle, way, length: reach(way), breadth: reach([-way[1], way[0]]) }
    }

    fn is_straight(&self) -> bool {
        self.breadth <= (0.2 * self.length).max(2.5).min(THICKEST_PX as f64 + 1.0)
    }
}

/// Follows a line beyond both its ends, up to `reach` pixels: through crossing lines, up to where it ends or meets what is
/// thicker.
fn follow(
    straight: &Straight,
    ink: &[u8],
    width: usize,
    reach: f64,
    fits: impl Fn(usize) -> bool,
    found: &mut Vec<usize>,
) {
    let height = ink.len() / width;
    let [across_x, across_y] = [-straight.way[1], straight.way[0]];
    let pixel = |x: f64, y: f64| {
        let (x, y) = (x.round(), y.round());
        let inside = x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64;
        inside.then(|| y as usize * width + x as usize)
    };
    for sign in [-1.0, 1.0] {
        let mut waiting: Vec<usize> = Vec::new();
        let mut crossing = 0;
        let mut ends_in_light = false;
        let mut passed: Vec<Vec<usize>> = Vec::new();
        let last = (straight.length * 0.5 + reach) as usize;
        for step in (straight.length * 0.5) as usize..=last {
            let [x, y] = [0, 1].map(|k| straight.middle[k] + sign * step as f64 * straight.way[k]);
            let place = |k: i32| pixel(x + f64::from(k) * across_x, y + f64::from(k) * across_y);
            let here = |k: i32| place(k).filter(|&at| ink[at] != 0);
            let Some(centre) = [0, 1, -1].into_iter().find(|&k| here(k).is_some()) else {
                ends_in_light = true;
                break;
            };
            let side = |way: i32| (1..=THICKEST_PX as i32 + 1).map_while(move |k| here(centre + way * k));
            let [before, after] = [-1, 1].map(|way| side(way).count() as i32);
            if (before + 1 + after) as usize <= THICKEST_PX.min(straight.breadth as usize + 2) {
                crossing = 0;
                let beside = [place(centre - before - 1), place(centre + after + 1)];
                if beside.into_iter().flatten().all(&fits) {
                    waiting.extend((centre - before..=centre + after).filter_map(here));
                }
                passed.push(std::mem::take(&mut waiting));
            } else {
                crossing += 1;
                if crossing > THICKEST_PX + 1 {
                    break;
                }
                let thick = straight.breadth as i32 / 2;
                waiting.extend((-thick..=thick).filter_map(here));
            }
        }
        // What the line ends at is not its own.
        let own = passed.len().saturating_sub(if ends_in_light { END_PX } else { 0 });
        found.extend(passed.into_iter().take(own).flatten());
    }
}
