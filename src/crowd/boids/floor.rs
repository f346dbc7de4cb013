//! Floor area around a place: a count of people divided by it gives people per square metre.

use rayon::prelude::*;

use crate::crowd::perception::{OPEN_M, SENSE_M};
use crate::math::{Vec2, vec2};
use crate::routes::{Ground, Lattice};
use crate::walls::Walls;

/// Side of this table's cells, metres.
const CELL_M: f64 = 0.4;
/// Samples across a cell for its share of floor.
const SAMPLES: usize = 4;

/// Moments of the floor around each cell: `m0 = sum k dA`, `m = sum k d/|d| dA`, with the weight [`kernel`].
///
/// A person who looks in direction `h` counts another at distance `r` in direction `u` with the weight
/// `k(r) (1 + u.h) / 2`, so that the floor counts `(m0 + m.h) / 2`: walls and what lies behind them do not.
#[derive(Debug)]
pub(super) struct FloorMoments {
    lattice: Lattice,
    moments: Vec<[f32; 3]>,
}

/// Weight of a place at a squared distance: `(1 - r2 / R2)^2`, 0 from [`SENSE_M`] on.
#[inline]
fn kernel(squared_m2: f32) -> f32 {
    let inside = (1.0 - squared_m2 * (1.0 / (SENSE_M * SENSE_M)) as f32).max(0.0);
    inside * inside
}

/// The kernel's integral over open floor.
const OPEN_M2: f32 = (std::f64::consts::PI * SENSE_M * SENSE_M / 3.0) as f32;

impl FloorMoments {
    pub(super) fn new(ground: &Ground, walls: &Walls) -> FloorMoments {
        let lattice = ground.lattice.coarser(CELL_M);
        let cells: Vec<FloorCell> =
            (0..lattice.len()).into_par_iter().map(|c| FloorCell::new(&lattice, ground, c)).collect();
        let joined: Vec<[bool; 4]> = (0..lattice.len())
            .into_par_iter()
            .map(|c| lattice.around(c).map(|b| b != usize::MAX && cells[c].sees(&cells[b], ground, walls)))
            .collect();
        let moments = (0..lattice.len())
            .into_par_iter()
            .map_init(Vec::new, |seen, cell| moments(&lattice, &cells, &joined, cell, seen))
            .collect();
        FloorMoments { lattice, moments }
    }

    /// Weighted floor area ahead of a person at `p` who looks along the unit vector `heading`, square metres.
    ///
    /// `clearance_m` is a lower bound of the distance to walls.
    #[inline]
    pub(super) fn ahead_m2(&self, p: Vec2, clearance_m: f32, heading: [f32; 2]) -> f32 {
        if clearance_m > OPEN_M {
            return 0.5 * OPEN_M2;
        }
        let [m0, mx, my] = self.lattice.cell_at(p).map_or([OPEN_M2, 0.0, 0.0], |c| self.moments[c]);
        // In a dead end there is no floor ahead, but always room for a person.
        (0.5 * (m0 + mx * heading[0] + my * heading[1])).max(0.15)
    }
}

/// Floor of a coarse cell.
struct FloorCell {
    /// Share of the cell that is floor.
    share: f32,
    /// Place with the largest clearance in it, metres.
    place_m: Vec2,
    clearance_m: f64,
}

impl FloorCell {
    fn new(lattice: &Lattice, ground: &Ground, cell: usize) -> FloorCell {
        let corner = lattice.centre(cell) - vec2(0.5, 0.5) * CELL_M;
        let mut best = FloorCell { share: 0.0, place_m: lattice.centre(cell), clearance_m: 0.0 };
        for k in 0..SAMPLES * SAMPLES {
            let at = vec2((k % SAMPLES) as f64 + 0.5, (k / SAMPLES) as f64 + 0.5) * (CELL_M / SAMPLES as f64);
            let Some(fine) = ground.lattice.cell_at(corner + at) else { continue };
            let clearance_m = ground.cell_clearance_m(fine);
            if clearance_m > 0.0 {
                best.share += 1.0 / (SAMPLES * SAMPLES) as f32;
            }
            if clearance_m > best.clearance_m {
                best.clearance_m = clearance_m;
                best.place_m = ground.lattice.centre(fine);
            }
        }
        best
    }

    fn sees(&self, other: &FloorCell, ground: &Ground, walls: &Walls) -> bool {
        self.share > 0.0 && other.share > 0.0 && ground.sight(walls, self.place_m, other.place_m)
    }
}

/// Cells that the kernel reaches to either side of the one in the middle.
const REACH: i32 = (SENSE_M / CELL_M) as i32;
/// Cells along the side of the square around a cell that the kernel reaches.
const SQUARE: i32 = 2 * REACH + 1;
/// One bit for each cell of the square.
const _: () = assert!(SQUARE * SQUARE <= u128::BITS as i32);

/// A cell by its number, and how many columns and rows it lies from the one in the middle.
type CellOffset = (usize, [i32; 2]);

/// Sums the moments of the floor that can be reached from a cell within the kernel's radius.
fn moments(
    lattice: &Lattice,
    cells: &[FloorCell],
    joined: &[[bool; 4]],
    from: usize,
    seen: &mut Vec<CellOffset>,
) -> [f32; 3] {
    let reach_m = SENSE_M + 0.5 * CELL_M;
    if cells[from].clearance_m > reach_m {
        return [OPEN_M2, 0.0, 0.0];
    }
    if cells[from].share == 0.0 {
        return [OPEN_M2, 0.0, 0.0];
    }
    let bit = |[x, y]: [i32; 2]| 1u128 << ((y + REACH) * SQUARE + x + REACH);
    let mut sums = [0.0f32; 3];
    let mut is_seen = bit([0, 0]);
    seen.clear();
    seen.push((from, [0, 0]));
    let mut next = 0;
    while let Some(&(cell, [x, y])) = seen.get(next) {
        next += 1;
        let d = vec2(f64::from(x), f64::from(y)) * CELL_M;
        let weight = kernel(d.length_squared() as f32) * cells[cell].share * (CELL_M * CELL_M) as f32;
        sums[0] += weight;
        if let Some(unit) = d.normalized() {
            sums[1] += weight * unit.x as f32;
            sums[2] += weight * unit.y as f32;
        }
        let around = [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]];
        for ((side, beside), offset) in lattice.around(cell).into_iter().enumerate().zip(around) {
            let is_near = || vec2(f64::from(offset[0]), f64::from(offset[1])).length() * CELL_M < SENSE_M;
            if joined[cell][side] && is_near() && is_seen & bit(offset) == 0 {
                is_seen |= bit(offset);
                seen.push((beside, offset));
            }
        }
    }
    sums
}
