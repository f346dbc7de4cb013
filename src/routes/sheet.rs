use super::lattice::{BLOCK_CELLS, Lattice, SIDE};
use super::solve::Matrix;
use crate::math::{Vec2, vec2};

/// Cells are joined to tiles until there are no more than so many.
const MOST_TILES: usize = 8_000;
/// Cells along the side of the largest tiles.
const LARGEST_TILE: usize = 8;
/// Rounds of smoothing each time that tiles are divided: enough for what is new at that size.
const SWEEPS: usize = 8;
/// Nothing there.
pub(super) const NONE: u32 = u32::MAX;
/// The tile of all cells that are earthed.
const EARTH: u32 = u32::MAX - 1;

/// A sheet of cells that conduct: `div(s grad p) = source` in five points, earthed in some of the cells.
///
/// Large sheets are solved with tiles of up to 8 x 8 joined cells that share a potential; these are divided again and
/// again, with a few rounds of Gauss and Seidel's relaxation each time. What a tile is too coarse for is local, and
/// that is what relaxation is quick at.
#[derive(Debug)]
pub(super) struct Sheet {
    /// The lattice's cells, ascending.
    cells: Vec<usize>,
    /// For each cell the places of its neighbours to the west, east, south and north, or [`NONE`].
    beside: Vec<[u32; 4]>,
    /// Conductance to each of them.
    conductance: Vec<[f32; 4]>,
    is_earthed: Vec<bool>,
}

/// Cells joined within squares.
#[derive(Debug)]
struct Tiles {
    /// For each cell its tile, or [`EARTH`].
    of: Vec<u32>,
    count: usize,
}

impl Tiles {
    /// The mean of the cells' values, for each tile.
    fn means(&self, values: &[f64]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.count];
        for (value, &tile) in values.iter().zip(&self.of) {
            if let Some((sum, count)) = sums.get_mut(tile as usize) {
                (*sum, *count) = (*sum + value, *count + 1.0);
            }
        }
        sums.into_iter().map(|(sum, count)| sum / count).collect()
    }
}

impl Sheet {
    /// Joins cells (ascending) that conduct so well.
    pub(super) fn new(
        lattice: &Lattice,
        cells: Vec<usize>,
        conducts: impl Fn(usize) -> f64,
        is_earthed: impl Fn(usize) -> bool,
    ) -> Sheet {
        let mut place = vec![NONE; lattice.len()];
        cells.iter().enumerate().for_each(|(k, &cell)| place[cell] = k as u32);
        let beside_of = |&c: &usize| lattice.around(c).map(|b| if b == usize::MAX { NONE } else { place[b] });
        let beside: Vec<[u32; 4]> = cells.iter().map(beside_of).collect();
        let own: Vec<f32> = cells.iter().map(|&c| conducts(c) as f32).collect();
        let to = |a: f32, b: u32| own.get(b as usize).map_or(0.0, |&b| 2.0 * a * b / (a + b));
        let conductance = beside.iter().zip(&own).map(|(beside, &a)| beside.map(|b| to(a, b))).collect();
        let is_earthed = cells.iter().map(|&c| is_earthed(c)).collect();
        Sheet { cells, beside, conductance, is_earthed }
    }

    /// The lattice's cells, ascending.
    pub(super) fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// The current through each cell, in the order of the cells: a unit current enters, divided evenly among `starts`.
    ///
    /// `guess` is about proportional to the potential.
    pub(super) fn currents(&self, starts: &[usize], guess: impl Fn(usize) -> f64) -> Vec<Vec2> {
        let mut source = vec![0.0; self.cells.len()];
        for start in starts {
            if let Ok(k) = self.cells.binary_search(start) {
                source[k] = 1.0 / starts.len() as f64;
            }
        }
        let guess = self.cells.iter().map(|&cell| guess(cell)).collect();
        let potential = self.potential(&source, guess);
        (0..self.cells.len())
            .map(|cell| {
                let out = |side: usize| match self.beside[cell][side] {
                    NONE => 0.0,
                    b => f64::from(self.conductance[cell][side]) * (potential[cell] - potential[b as usize]),
                };
                vec2(out(1) - out(0), out(3) - out(2)) * 0.5
            })
            .collect()
    }

    /// Solves from large tiles to single cells.
    fn potential(&self, source: &[f64], mut potential: Vec<f64>) -> Vec<f64> {
        let mut side = 1;
        while self.cells.len() > MOST_TILES * side * side && side < LARGEST_TILE {
            side *= 2;
        }
        let mut solved = false;
        while side > 1 || !solved {
            let tiles = self.joined(side);
            let matrix = self.matrix(&tiles);
            let mut sums = vec![0.0; tiles.count];
            for (value, &tile) in source.iter().zip(&tiles.of) {
                if let Some(sum) = sums.get_mut(tile as usize) {
                    *sum += value;
                }
            }
            let mut values = tiles.means(&potential);
            if solved {
                matrix.relax(&sums, &mut values, SWEEPS);
            } else {
                values = matrix.solve(&sums, values);
                solved = true;
            }
            // Tiles of twice the side conduct twice as well between each other as they should.
            let scale = if side > 1 { 2.0 } else { 1.0 };
            for (value, &tile) in potential.iter_mut().zip(&tiles.of) {
                *value = values.get(tile as usize).map_or(0.0, |v| v * scale);
            }
            if side == 1 {
                return potential;
            }
            side /= 2;
        }
        self.relax(source, &mut potential);
        potential
    }

    /// Gauss and Seidel's relaxation of the cells themselves.
    fn relax(&self, source: &[f64], potential: &mut [f64]) {
        for _ in 0..SWEEPS {
            for cell in 0..potential.len() {
                if self.is_earthed[cell] {
                    continue;
                }
                let (mut sum, mut weight) = (source[cell], 0.0);
                for (&beside, &conductance) in self.beside[cell].iter().zip(&self.conductance[cell]) {
                    if let Some(other) = potential.get(beside as usize) {
                        sum += f64::from(conductance) * other;
                        weight += f64::from(conductance);
                    }
                }
                if weight > 0.0 {
                    potential[cell] = sum / weight;
                }
            }
        }
    }

    /// Tiles of so many cells a side: what is joined within a square, in the order of the first cells.
    fn joined(&self, side: usize) -> Tiles {
        let square = |cell: usize| {
            let within = cell % BLOCK_CELLS;
            [cell / BLOCK_CELLS, within / SIDE / side, within % SIDE / side]
        };
        let mut of: Vec<u32> = self.is_earthed.iter().map(|&e| if e { EARTH } else { NONE }).collect();
        let mut count = 0;
        let mut open = Vec::new();
        for first in 0..of.len() {
            if of[first] != NONE {
                continue;
            }
            let own = square(self.cells[first]);
            of[first] = count;
            open.push(first);
            while let Some(cell) = open.pop() {
                for beside in self.beside[cell] {
                    if of.get(beside as usize) == Some(&NONE) && square(self.cells[beside as usize]) == own {
                        of[beside as usize] = count;
                        open.push(beside as usize);
                    }
                }
            }
            count += 1;
        }
        Tiles { of, count: count as usize }
    }

    fn matrix(&self, tiles: &Tiles) -> Matrix {
        let mut edges: Vec<(u32, u32, f64)> = Vec::new();
        let mut earthed = vec![0.0; tiles.count];
        for (cell, &own) in tiles.of.iter().enumerate().filter(|t| *t.1 != EARTH) {
            for (&beside, &conductance) in self.beside[cell].iter().zip(&self.conductance[cell]) {
                match tiles.of.get(beside as usize) {
                    Some(&EARTH) => earthed[own as usize] += f64::from(conductance),
                    Some(&other) if other != own => edges.push((own, other, f64::from(conductance))),
                    _ => {}
                }
            }
        }
        Matrix::new(&earthed, edges)
    }
}
