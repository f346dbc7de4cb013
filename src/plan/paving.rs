//! Lines of floor coverings: tiles, planks, paving. They are neither walls nor furniture, and are taken off a drawing.
//!
//! They are known by repetition: many closed cells of one size lie side by side, each with four or more like it around.
//! Treads of stairs, hatches of walls, desks and lockers have two or three.

use std::collections::BTreeMap;

use super::components::{Component, Components, Neighbours};
use crate::math::{atan2, sin_cos};

/// Largest drawing that is searched, pixels.
pub(super) const LARGEST_PX: usize = 40_000_000;
/// Least side of a cell, pixels, and greatest, as a share of the drawing's larger side.
const LEAST_SIDE_PX: u32 = 2;
const GREATEST_SIDE: f64 = 0.2;
/// Greatest thickness of a line, pixels, and as a share of a cell's lesser side.
const THICKEST_PX: usize = 6;
const THICKEST: f64 = 0.34;
/// How many times one line of a covering may be as dark, across it, as another, and as what crosses it.
pub(super) const DARKER: f64 = 1.6;
const CROSSING: f64 = 2.2;
/// Least agreement of the lines of a covering on two directions, 0 to 1, and how far a line may be off them, radians.
const AGREED: f64 = 0.8;
const OFF_RAD: f64 = 0.17;
/// Least length of a plank, in its widths.
const LONG: f64 = 1.5;
/// Least length of the line between two cells, in lesser sides of a cell.
const CONTACT: f64 = 0.25;
/// By how much cells of one size differ, as a share of their area or of their lesser side.
const ALIKE: f64 = 0.12;
/// Fewest cells like it around a cell in the middle of a covering, and fewest such cells of a covering.
const FEWEST_AROUND: usize = 4;
const FEWEST_MIDDLES: usize = 6;
/// Fewest cells of a covering that another room has as well.
const FEWEST_IN_SMALL_ROOM: usize = 3;
/// Least side of the squares of a grid, pixels; the fewest, and fewest lines between two of them; how well they agree on where
/// it lies, 0 to 1.
const LEAST_SQUARE_PX: f64 = 14.0;
const FEWEST_SQUARES: usize = 24;
const ON_GRID: f64 = 0.8;
/// How far lines are followed from between two whole cells to what cuts the covering, in longer sides of a cell.
const FOLLOWED: f64 = 3.0;
/// Stretch of a line before its end that is left, pixels: it may be the outline of what stands there.
const END_PX: usize = 4;
/// Least length of the line between a cell and one that is cut off, in lesser sides of the whole one.
const CUT_CONTACT: f64 = 0.4;

/// A cell of light between lines.
struct Cell {
    area: f64,
    /// Its width and length, pixels.
    sides: [f64; 2],
    /// Whether it lies along the image's rows rather than its columns.
    lies: bool,
    /// Its first column and row.
    min: [u32; 2],
}

impl Cell {
    /// Whether two cells may be of one covering: tiles have one area, planks one width and one direction.
    fn is_like(&self, other: &Cell) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.max(b) + 1.0;
        let are_planks = self.is_long() && other.is_long() && self.lies == other.lies;
        let areas = (self.area - other.area).abs() <= ALIKE * self.area.max(other.area) + self.sides[1];
        near(self.sides[0], other.sides[0]) && (are_planks || near(self.sides[1], other.sides[1]) && areas)
    }

    /// Whether it may be what is left of another one that something cuts.
    fn fits_in(&self, whole: &Cell) -> bool {
        let most = 1.0 + ALIKE;
        self.sides[0] <= most * whole.sides[0] + 1.0 && self.area <= most * whole.area + whole.sides[1]
    }

    /// Whether it is a plank rather than a tile.
    fn is_long(&self) -> bool {
        self.sides[1] >= LONG * self.sides[0]
    }
}

/// What is drawn.
pub(super) struct Ink {
    /// How dark each pixel is that may be of a line, row by row; 0 for light.
    pub dark: Vec<u8>,
    /// Pixels of a row.
    pub width: usize,
}

impl Ink {
    pub fn height(&self) -> usize {
        self.dark.len() / self.width.max(1)
    }

    /// Ink of some pixels, in black ones.
    pub fn sum(&self, pixels: impl IntoIterator<Item = usize>) -> f64 {
        pixels.into_iter().map(|at| f64::from(self.dark[at])).sum::<f64>() / 255.0
    }

    /// The pixel at a place, pixels.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> Option<usize> {
        let (x, y) = (x.round(), y.round());
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height() as f64;
        inside.then(|| y as usize * self.width + x as usize)
    }
}

/// Floor coverings of a drawing.
#[derive(Default)]
pub(super) struct Paving {
    /// Pixels of their lines.
    pub lines: Vec<usize>,
    /// Side of the squares of a grid over all floors, with the line between two, pixels.
    pub square_px: Option<f64>,
}

/// Finds the floor coverings.
pub(super) fn find(ink: &Ink) -> Paving {
    if ink.dark.len() > LARGEST_PX {
        return Paving::default();
    }
    let Some((cells, label)) = cells(ink) else { return Paving::default() };
    let between = between(&label, ink, &cells);
    let covering = coverings(&cells, &between);
    let straight: BTreeMap<[usize; 2], Straight> = between
        .iter()
        .filter(|(pair, _)| pair.iter().any(|&k| covering[k].is_some()))
        .map(|(&pair, line)| (pair, Straight::of(&line.pixels, ink.width)))
        .collect();
    let ways = Ways::of(&straight, &covering);
    let mut found = Vec::new();
    for (pair, straight) in &straight {
        let &[a, b] = pair;
        let (whole, number) = match [a, b].map(|k| covering[k]) {
            [Some(number), _] => (&cells[a], number),
            [_, Some(number)] => (&cells[b], number),
            _ => continue,
        };
        let both = pair.iter().all(|&k| covering[k].is_some());
        let is_cut_off =
            || pair.iter().all(|&k| cells[k].fits_in(whole)) && straight.length >= CUT_CONTACT * whole.sides[0];
        // A line across planks that goes on in the next row is no joint: a leaf of a door.
        let is_across = whole.is_long() && (straight.way[0].abs() > straight.way[1].abs()) != whole.lies;
        let is_leaf = || {
            let goes_on = |sign: f64| {
                let beyond = sign * (straight.length * 0.5 + 2.0 * straight.breadth + 1.0);
                let at = ink.pixel([0, 1].map(|k| straight.middle[k] + beyond * straight.way[k]));
                at.is_some_and(|at| ink.dark[at] != 0)
            };
            is_across && (goes_on(-1.0) || goes_on(1.0))
        };
        if straight.is_straight() && ways.have(number, straight) && (both || is_cut_off()) && !is_leaf() {
            let line = &between[pair];
            found.extend_from_slice(&line.pixels);
            let fits = |at: usize| match label[at] {
                0 => false,
                SLIM => true,
                k => cells[k as usize - 1].fits_in(whole),
            };
            if !is_across {
                follow(straight, ink, line.thickness(), FOLLOWED * whole.sides[1], fits, &mut found);
            }
        }
    }
    Paving { lines: found, square_px: square(&cells, &between) }
}

/// The side of the squares of a grid over all floors and of the line between two, if there is one.
fn square(cells: &[Cell], between: &BTreeMap<[usize; 2], Line>) -> Option<f64> {
    let is_square = |cell: &Cell| {
        let [a, b] = cell.sides;
        a >= LEAST_SQUARE_PX && b - a <= 0.5 * ALIKE * b + 1.0 && cell.area >= (1.0 - ALIKE) * a * b
    };
    let mut squares: Vec<usize> = (0..cells.len()).filter(|&k| is_square(&cells[k])).collect();
    squares.sort_by(|&a, &b| cells[a].sides[1].total_cmp(&cells[b].sides[1]).then(a.cmp(&b)));
    let alike = |k: usize| {
        let most = cells[squares[k]].sides[1] * (1.0 + 0.5 * ALIKE) + 1.0;
        squares[k..].partition_point(|&other| cells[other].sides[1] <= most)
    };
    let first = (0..squares.len()).max_by_key(|&k| (alike(k), k))?;
    let squares = &squares[first..first + alike(first)];
    let mut is_alike = vec![false; cells.len()];
    squares.iter().for_each(|&k| is_alike[k] = true);
    let are_squares = |pair: &[usize; 2]| pair.iter().all(|&k| is_alike[k]);
    let lines: Vec<&Line> = between.iter().filter(|(pair, _)| are_squares(pair)).map(|(_, line)| line).collect();
    if squares.len().min(lines.len()) < FEWEST_SQUARES {
        return None;
    }
    let (pixels, crossed) = lines.iter().fold((0, 0), |sum, line| (sum.0 + line.pixels.len(), sum.1 + line.crossed));
    let mean = squares.iter().map(|&k| cells[k].area.sqrt()).sum::<f64>() / squares.len() as f64;
    let side = mean + pixels as f64 / crossed.max(1) as f64;
    // All rooms have one grid.
    let is_on_grid = |axis: usize| {
        let turn = |k: &usize| sin_cos(std::f64::consts::TAU * f64::from(cells[*k].min[axis]) / side);
        let sum = squares.iter().map(turn).fold([0.0; 2], |[a, b], (sine, cosine)| [a + sine, b + cosine]);
        (sum[0] * sum[0] + sum[1] * sum[1]).sqrt() >= ON_GRID * squares.len() as f64
    };
    (is_on_grid(0) && is_on_grid(1)).then_some(side)
}

/// The two directions at right angles of the lines of each covering, where they have such.
struct Ways(Vec<Option<f64>>);

impl Ways {
    fn of(straight: &BTreeMap<[usize; 2], Straight>, covering: &[Option<usize>]) -> Ways {
        let count = covering.iter().flatten().max().map_or(0, |&last| last + 1);
        let mut sums = vec![[0.0; 3]; count];
        for (pair, line) in straight {
            if let [Some(number), Some(_)] = pair.map(|k| covering[k]) {
                let (sine, cosine) = sin_cos(4.0 * atan2(line.way[1], line.way[0]));
                let sum = &mut sums[number];
                *sum = [sum[0] + line.length * cosine, sum[1] + line.length * sine, sum[2] + line.length];
            }
        }
        let agreed = |[x, y, all]: [f64; 3]| (x * x + y * y).sqrt() >= AGREED * all;
        Ways(sums.into_iter().map(|sum| agreed(sum).then(|| 0.25 * atan2(sum[1], sum[0]))).collect())
    }

    /// Whether a line runs as those of a covering.
    fn have(&self, covering: usize, line: &Straight) -> bool {
        let Some(way) = self.0[covering] else { return true };
        let quarter = std::f64::consts::FRAC_PI_2;
        let off = (atan2(line.way[1], line.way[0]) - way) / quarter;
        // Short lines have no exact direction.
        (off - off.round()).abs() * quarter <= OFF_RAD.max(1.0 / line.length)
    }
}

/// Marks the pixels of cells that are too slim to be told.
const SLIM: u32 = u32::MAX;

/// The cells that may be of a covering, and for each pixel one more than the index of its cell, 0, or [`SLIM`]. None if they
/// are few.
fn cells(ink: &Ink) -> Option<(Vec<Cell>, Vec<u32>)> {
    let all = Components::of(&ink.dark, ink.width, 0, Neighbours::Four);
    let greatest = GREATEST_SIDE * ink.width.max(ink.height()) as f64;
    let is_slim = |piece: &Component| piece.size().into_iter().min() < Some(LEAST_SIDE_PX);
    let small: Vec<&Component> = all.all.iter().filter(|piece| f64::from(piece.larger_side()) <= greatest).collect();
    if small.iter().filter(|piece| !is_slim(piece)).count() < FEWEST_MIDDLES + 2 * FEWEST_AROUND {
        return None;
    }
    let mut label = vec![0; ink.dark.len()];
    let mut cells = Vec::with_capacity(small.len());
    for piece in small {
        let [w, h] = piece.size().map(f64::from);
        let slim = is_slim(piece);
        if !slim {
            let area = piece.area as f64;
            // Planks of two rooms that meet in a door make one cell with a step in it.
            let lesser = if w.max(h) >= LONG * w.min(h) { area / w.max(h) } else { w.min(h) };
            cells.push(Cell { area, sides: [lesser, w.max(h)], lies: w > h, min: piece.min });
        }
        for run in all.runs(piece) {
            let row = run.y as usize * ink.width;
            label[row + run.from as usize..row + run.to as usize].fill(if slim { SLIM } else { cells.len() as u32 });
        }
    }
    Some((cells, label))
}

/// What is between two cells.
#[derive(Default)]
struct Line {
    pixels: Vec<usize>,
    /// How many rows and columns cross it, and the ink in all of them, black pixels.
    crossed: usize,
    ink: f64,
}

impl Line {
    /// Mean ink across it, black pixels.
    fn thickness(&self) -> f64 {
        self.ink / self.crossed.max(1) as f64
    }
}

/// The thin lines between each two cells that lie beside each other, lower index first.
fn between(label: &[u32], ink: &Ink, cells: &[Cell]) -> BTreeMap<[usize; 2], Line> {
    let mut between: BTreeMap<[usize; 2], Line> = BTreeMap::new();
    let mut scan = |start: usize, step: usize, count: usize| {
        let mut last: Option<(usize, u32)> = None;
        for k in 0..count {
            let at = start + k * step;
            if ink.dark[at] != 0 {
                continue;
            }
            let here = label[at];
            if let Some((from, there)) = last
                && here != there
                && ![0, SLIM].contains(&here)
                && ![0, SLIM].contains(&there)
            {
                let [a, b] = [here.min(there), here.max(there)].map(|label| label as usize - 1);
                let thick = k - from - 1;
                if thick <= THICKEST_PX && thick as f64 <= THICKEST * cells[a].sides[0].max(cells[b].sides[0]) + 1.0 {
                    let line = between.entry([a, b]).or_default();
                    let pixels = (from + 1..k).map(|k| start + k * step);
                    line.ink += ink.sum(pixels.clone());
                    line.pixels.extend(pixels);
                    line.crossed += 1;
                }
            }
            last = Some((k, here));
        }
    };
    (0..ink.height()).for_each(|y| scan(y * ink.width, 1, ink.width));
    (0..ink.width).for_each(|x| scan(x, ink.width, ink.height()));
    // Lines of a covering are as thin as the thinnest around a cell; walls are thicker.
    let mut thinnest = vec![f64::INFINITY; cells.len()];
    for (pair, line) in between.iter().filter(|(pair, line)| is_contact(**pair, line, cells)) {
        for &k in pair {
            thinnest[k] = thinnest[k].min(line.thickness());
        }
    }
    between.retain(|pair, line| pair.iter().all(|&k| line.thickness() <= DARKER * thinnest[k] + 0.2));
    between
}

/// Whether two cells lie beside each other over much of a side.
fn is_contact([a, b]: [usize; 2], line: &Line, cells: &[Cell]) -> bool {
    line.crossed as f64 >= CONTACT * cells[a].sides[0].min(cells[b].sides[0])
}

/// For each cell, of which covering it is a whole one, if it is.
fn coverings(cells: &[Cell], between: &BTreeMap<[usize; 2], Line>) -> Vec<Option<usize>> {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); cells.len()];
    for (&[a, b], line) in between {
        if cells[a].is_like(&cells[b]) && is_contact([a, b], line, cells) {
            around[a].push(b);
            around[b].push(a);
        }
    }
    let is_middle = |k: usize| around[k].len() >= FEWEST_AROUND;
    let mut seen = vec![false; cells.len()];
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for first in 0..cells.len() {
        if !around[first].is_empty() && !std::mem::replace(&mut seen[first], true) {
            let mut group = vec![first];
            let mut next = 0;
            while let Some(&k) = group.get(next) {
                group.extend(around[k].iter().filter(|&&near| !std::mem::replace(&mut seen[near], true)));
                next += 1;
            }
            groups.push(group);
        }
    }
    let (large, small): (Vec<Vec<usize>>, Vec<Vec<usize>>) =
        groups.into_iter().partition(|group| group.iter().filter(|&&k| is_middle(k)).count() >= FEWEST_MIDDLES);
    let mut covering = vec![None; cells.len()];
    for (number, group) in large.iter().enumerate() {
        group.iter().for_each(|&k| covering[k] = Some(number));
    }
    // Small rooms have the covering of others.
    let usual: Vec<&Cell> = large.iter().map(|group| usual(cells, group)).collect();
    for group in small {
        let found = usual.iter().enumerate().find_map(|(number, usual)| {
            let like: Vec<usize> = group.iter().copied().filter(|&k| cells[k].is_like(usual)).collect();
            (like.len() >= FEWEST_IN_SMALL_ROOM).then_some((number, like))
        });
        if let Some((number, like)) = found {
            like.into_iter().for_each(|k| covering[k] = Some(number));
        }
    }
    covering
}

/// The cell of the middle area.
fn usual<'a>(cells: &'a [Cell], group: &[usize]) -> &'a Cell {
    let mut order = group.to_vec();
    order.sort_by(|&a, &b| cells[a].area.total_cmp(&cells[b].area).then(a.cmp(&b)));
    &cells[order[order.len() / 2]]
}

/// The straight line through some pixels.
pub(super) struct Straight {
    pub middle: [f64; 2],
    /// Its direction, of length 1.
    pub way: [f64; 2],
    /// How far the pixels reach along the line and across it, pixels.
    pub length: f64,
    breadth: f64,
}

impl Straight {
    pub fn of(line: &[usize], width: usize) -> Straight {
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

    pub fn is_straight(&self) -> bool {
        self.breadth <= (0.2 * self.length).max(2.5).min(THICKEST_PX as f64 + 1.0)
    }
}

/// Follows a line beyond both its ends, up to `reach` pixels, through what crosses it, up to where it ends. The cells on both
/// its sides have to fit.
fn follow(
    straight: &Straight,
    ink: &Ink,
    thickness: f64,
    reach: f64,
    fits: impl Fn(usize) -> bool,
    found: &mut Vec<usize>,
) {
    let [across_x, across_y] = [-straight.way[1], straight.way[0]];
    for sign in [-1.0, 1.0] {
        // Pixels of a stretch that is as thin as the line, step by step, and of what crosses it.
        let mut stretch: Vec<Vec<usize>> = Vec::new();
        let mut crossing: Vec<usize> = Vec::new();
        for step in (straight.length * 0.5) as usize..=(straight.length * 0.5 + reach) as usize {
            let [x, y] = [0, 1].map(|k| straight.middle[k] + sign * step as f64 * straight.way[k]);
            let place = |k: i32| ink.pixel([x + f64::from(k) * across_x, y + f64::from(k) * across_y]);
            let here = |k: i32| place(k).filter(|&at| ink.dark[at] != 0);
            let Some(centre) = [0, 1, -1].into_iter().find(|&k| here(k).is_some()) else {
                stretch.truncate(stretch.len().saturating_sub(END_PX));
                break;
            };
            let side = |way: i32| (1..=THICKEST_PX as i32 + 1).map_while(move |k| here(centre + way * k));
            let [before, after] = [-1, 1].map(|way| side(way).count() as i32);
            let cut = || (centre - before..=centre + after).filter_map(here);
            if ink.sum(cut()) <= DARKER * thickness + 0.2 {
                let beside = [place(centre - before - 1), place(centre + after + 1)];
                if beside.into_iter().flatten().all(&fits) {
                    crossing.extend(cut());
                } else {
                    crossing.clear();
                }
                stretch.push(std::mem::take(&mut crossing));
            } else {
                crossing.extend(here(centre));
                if ink.sum(crossing.iter().copied()) > CROSSING * thickness + 0.5 {
                    found.extend(stretch.drain(..).flatten());
                    crossing.clear();
                }
            }
        }
        found.extend(stretch.into_iter().flatten());
    }
}
