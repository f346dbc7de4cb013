use super::lattice::{BLOCK_CELLS, Lattice, SIDE};
use super::solve::Matrix;
use crate::math::{Vec2, vec2};

/// Largest number of tiles.
const MOST_TILES: usize = 8_000;
/// Cells along the side of the largest tiles.
const LARGEST_TILE: usize = 8;
/// Relaxation sweeps after each division of the tiles: enough for the detail of that size.
const SWEEPS: usize = 8;
/// Steps between adjacent tiles for a mean: a random walk reaches 1.5 tiles.
const STEPS_AROUND: usize = 6;
/// Marks a missing neighbour.
pub(super) const NONE: u32 = u32::MAX;
/// Tile of all earthed cells.
const EARTH: u32 = u32::MAX - 1;

/// A conductive sheet of cells: `div(s grad p) = source` in five points, partly earthed.
///
/// Large sheets are solved on tiles of up to 8 x 8 cells that share a potential. The tiles are divided repeatedly, each
/// time with a few sweeps of Gauss-Seidel relaxation. Errors of a tiling are local, which relaxation removes quickly.
#[derive(Debug)]
pub(super) struct ConductiveSheet {
    /// Indices of cells in the lattice, ascending.
    cells: Vec<usize>,
    /// Indices of the neighbours to the west, east, south and north, or [`NONE`].
    beside: Vec<[u32; 4]>,
    /// Conductance to each neighbour.
    conductance: Vec<[f32; 4]>,
    is_earthed: Vec<bool>,
    /// Tilings for the solution, largest tiles first, with their sides in cells.
    tilings: Vec<(usize, Tiles)>,
}

/// A tiling: cells joined within squares.
#[derive(Debug)]
struct Tiles {
    /// Tile of each cell, or [`EARTH`].
    of: Vec<u32>,
    count: usize,
}

impl Tiles {
    /// Mean value of the cells of each tile.
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

/// Tile sides for a number of cells, from the largest down to 2; only 1 for few cells.
fn sides(cells: usize) -> impl Iterator<Item = usize> {
    let mut largest = 1;
    while cells > MOST_TILES * largest * largest && largest < LARGEST_TILE {
        largest *= 2;
    }
    std::iter::successors(Some(largest), |side| Some(side / 2)).take_while(move |&side| side > 1 || side == largest)
}

impl ConductiveSheet {
    /// Builds a sheet from cells, ascending, and their conductivities.
    pub(super) fn new(
        lattice: &Lattice,
        cells: Vec<usize>,
        conducts: &[f64],
        is_earthed: impl Fn(usize) -> bool,
    ) -> ConductiveSheet {
        let mut place = vec![NONE; lattice.len()];
        cells.iter().enumerate().for_each(|(k, &cell)| place[cell] = k as u32);
        let beside_of = |&c: &usize| lattice.around(c).map(|b| if b == usize::MAX { NONE } else { place[b] });
        let beside: Vec<[u32; 4]> = cells.iter().map(beside_of).collect();
        let is_earthed = cells.iter().map(|&c| is_earthed(c)).collect();
        let mut sheet = ConductiveSheet { cells, beside, conductance: Vec::new(), is_earthed, tilings: Vec::new() };
        sheet.conduct(conducts);
        sheet.tilings = sides(sheet.cells.len()).map(|side| (side, sheet.joined(side))).collect();
        sheet
    }

    /// Sets the conductivities of the cells.
    pub(super) fn conduct(&mut self, conducts: &[f64]) {
        let to = |a: f64, b: u32| conducts.get(b as usize).map_or(0.0, |&b| 2.0 * a * b / (a + b)) as f32;
        self.conductance = self.beside.iter().zip(conducts).map(|(beside, &a)| beside.map(|b| to(a, b))).collect();
    }

    /// Indices of cells in the lattice, ascending.
    pub(super) fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// Computes the potential per cell for a unit current, divided evenly among `starts`.
    ///
    /// `guess` is roughly proportional to it.
    pub(super) fn potential(&self, starts: &[usize], guess: Vec<f64>) -> Vec<f64> {
        let mut source = vec![0.0; self.cells.len()];
        for start in starts {
            if let Ok(k) = self.cells.binary_search(start) {
                source[k] = 1.0 / starts.len() as f64;
            }
        }
        self.solve(&source, guess)
    }

    /// Current through each cell for a potential.
    pub(super) fn currents(&self, potential: &[f64]) -> Vec<Vec2> {
        let current = |cell: usize| {
            let out = |side: usize| match self.beside[cell][side] {
                NONE => 0.0,
                b => f64::from(self.conductance[cell][side]) * (potential[cell] - potential[b as usize]),
            };
            vec2(out(1) - out(0), out(3) - out(2)) * 0.5
        };
        (0..self.cells.len()).map(current).collect()
    }

    /// Slope of a potential at each cell, per cell side.
    pub(super) fn slopes(&self, potential: &[f64]) -> Vec<f64> {
        let slope = |cell: usize| {
            let along = |[back, ahead]: [usize; 2]| {
                let other = |side: usize| potential.get(self.beside[cell][side] as usize);
                match (other(back), other(ahead)) {
                    (Some(back), Some(ahead)) => (back - ahead) * 0.5,
                    (Some(one), None) | (None, Some(one)) => potential[cell] - one,
                    (None, None) => 0.0,
                }
            };
            vec2(along([0, 1]), along([2, 3])).length()
        };
        (0..self.cells.len()).map(slope).collect()
    }

    /// Computes the weighted mean of the values around each cell: a bell-shaped average over about 1.5 tiles within the
    /// sheet, with tiles of `side` cells.
    pub(super) fn means_around(&self, values: &[f64], weights: &[f64], side: usize) -> Vec<f64> {
        let own;
        let tiles = match self.tilings.iter().find(|tiling| tiling.0 == side) {
            Some((_, tiles)) => tiles,
            None => {
                own = self.joined(side);
                &own
            }
        };
        let mut sums = vec![[0.0; 2]; tiles.count];
        for (k, &tile) in tiles.of.iter().enumerate() {
            if let Some([sum, weight]) = sums.get_mut(tile as usize) {
                *sum += values[k] * weights[k];
                *weight += weights[k];
            }
        }
        let matrix = self.matrix(tiles, |_, _| 1.0 / side as f64);
        for _ in 0..STEPS_AROUND {
            sums = (0..tiles.count)
                .map(|tile| {
                    let add = |a: [f64; 2], (b, share): (usize, f64)| [0, 1].map(|k| a[k] + share * sums[b][k]);
                    matrix.around(tile).fold(sums[tile], add)
                })
                .collect();
        }
        let mean = |(k, &tile): (usize, &u32)| match sums.get(tile as usize) {
            Some([sum, weight]) if *weight > 0.0 => sum / weight,
            _ => values[k],
        };
        let mut means: Vec<f64> = tiles.of.iter().enumerate().map(mean).collect();
        // Smooths the edges of the tiles.
        for _ in 0..side {
            means = (0..means.len())
                .map(|k| {
                    let around = self.beside[k].iter().map(|&b| means.get(b as usize).copied().unwrap_or(means[k]));
                    (means[k] + around.sum::<f64>()) / 5.0
                })
                .collect();
        }
        means
    }

    /// Solves from large tiles to single cells.
    fn solve(&self, source: &[f64], mut potential: Vec<f64>) -> Vec<f64> {
        for (number, (side, tiles)) in self.tilings.iter().enumerate() {
            let matrix = self.matrix(tiles, |cell, side| f64::from(self.conductance[cell][side]));
            let mut sums = vec![0.0; tiles.count];
            for (value, &tile) in source.iter().zip(&tiles.of) {
                if let Some(sum) = sums.get_mut(tile as usize) {
                    *sum += value;
                }
            }
            let mut values = tiles.means(&potential);
            if number == 0 {
                values = matrix.solve(&sums, values);
            } else {
                matrix.relax(&sums, &mut values, SWEEPS);
            }
            // Doubling the side doubles the conductance between tiles, which should not change.
            let scale = if *side > 1 { 2.0 } else { 1.0 };
            for (value, &tile) in potential.iter_mut().zip(&tiles.of) {
                *value = values.get(tile as usize).map_or(0.0, |v| v * scale);
            }
            if *side == 1 {
                return potential;
            }
        }
        self.relax(source, &mut potential);
        potential
    }

    /// Gauss-Seidel relaxation of single cells.
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

    /// Builds tiles of `side` cells: connected cells of a square, in the order of their first cells.
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

    /// Matrix of the tiles, with conductances summed over the sides between their cells.
    fn matrix(&self, tiles: &Tiles, conductance: impl Fn(usize, usize) -> f64) -> Matrix {
        let mut edges: Vec<(u32, u32, f64)> = Vec::new();
        let mut earthed = vec![0.0; tiles.count];
        for (cell, &own) in tiles.of.iter().enumerate().filter(|t| *t.1 != EARTH) {
            for (side, &beside) in self.beside[cell].iter().enumerate() {
                match tiles.of.get(beside as usize) {
                    Some(&EARTH) => earthed[own as usize] += conductance(cell, side),
                    Some(&other) if other != own => edges.push((own, other, conductance(cell, side))),
                    _ => {}
                }
            }
        }
        Matrix::new(earthed, edges)
    }
}
