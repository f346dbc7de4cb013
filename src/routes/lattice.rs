use crate::math::{Rect, Vec2, vec2};

/// Cells along the side of a block.
pub(super) const SIDE: usize = 16;
/// Cells per block.
pub(crate) const BLOCK_CELLS: usize = SIDE * SIDE;
/// Marks a missing block.
const NONE: u32 = u32::MAX;

/// A sparse square grid of blocks of 16 x 16 cells, numbered by rows. Values are in separate vectors, indexed by cell.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    origin_m: Vec2,
    cell_m: f64,
    cells_per_m: f64,
    blocks_x: usize,
    blocks_y: usize,
    /// Number of each block, row by row from the least y, or [`NONE`].
    number: Vec<u32>,
    /// Column and row of each block.
    place: Vec<[u32; 2]>,
    /// First cell of the adjacent blocks to the west, east, south and north, or [`NONE`].
    beside: Vec<[u32; 4]>,
}

impl Lattice {
    /// Covers `area` with cells of side `cell_m`, with the blocks that `wanted` accepts.
    pub(crate) fn new(area: Rect, cell_m: f64, wanted: impl Fn(Rect) -> bool) -> Lattice {
        let block_m = cell_m * SIDE as f64;
        let blocks_x = (area.width() / block_m).ceil().max(1.0) as usize;
        let blocks_y = (area.height() / block_m).ceil().max(1.0) as usize;
        let mut number = vec![NONE; blocks_x * blocks_y];
        let mut place = Vec::new();
        for row in 0..blocks_y {
            for column in 0..blocks_x {
                let corner = area.min + vec2(column as f64, row as f64) * block_m;
                if wanted(Rect { min: corner, max: corner + vec2(block_m, block_m) }) {
                    number[row * blocks_x + column] = place.len() as u32;
                    place.push([column as u32, row as u32]);
                }
            }
        }
        let first_cell = |column: i64, row: i64| {
            let inside = (0..blocks_x as i64).contains(&column) && (0..blocks_y as i64).contains(&row);
            let block = if inside { number[row as usize * blocks_x + column as usize] } else { NONE };
            if block == NONE { NONE } else { block * BLOCK_CELLS as u32 }
        };
        let beside = place
            .iter()
            .map(|&[column, row]| {
                let (x, y) = (i64::from(column), i64::from(row));
                [first_cell(x - 1, y), first_cell(x + 1, y), first_cell(x, y - 1), first_cell(x, y + 1)]
            })
            .collect();
        Lattice { origin_m: area.min, cell_m, cells_per_m: 1.0 / cell_m, blocks_x, blocks_y, number, place, beside }
    }

    /// Returns a lattice of larger cells over the same area.
    pub(crate) fn coarser(&self, cell_m: f64) -> Lattice {
        let block_m = self.cell_m * SIDE as f64;
        let size = vec2(self.blocks_x as f64, self.blocks_y as f64) * block_m;
        let area = Rect { min: self.origin_m, max: self.origin_m + size };
        let first = |m: f64| ((m / block_m + 1e-9).max(0.0)) as usize;
        Lattice::new(area, cell_m, |block| {
            let (low, high) = (block.min - self.origin_m, block.max - self.origin_m);
            let columns = first(low.x)..=first(high.x).min(self.blocks_x - 1);
            (first(low.y)..=first(high.y).min(self.blocks_y - 1))
                .any(|row| columns.clone().any(|column| self.number[row * self.blocks_x + column] != NONE))
        })
    }

    /// Side of a cell, metres.
    pub(crate) fn cell_m(&self) -> f64 {
        self.cell_m
    }

    /// Number of cells; every vector of values has this length.
    pub(crate) fn len(&self) -> usize {
        self.place.len() * BLOCK_CELLS
    }

    /// The cell at a point, if it exists.
    #[inline]
    pub(crate) fn cell_at(&self, p: Vec2) -> Option<usize> {
        let x = (p.x - self.origin_m.x) * self.cells_per_m;
        let y = (p.y - self.origin_m.y) * self.cells_per_m;
        if !(x >= 0.0 && y >= 0.0) {
            return None;
        }
        self.cell_of(x as usize, y as usize)
    }

    /// The cell in a column and row, if it exists.
    #[inline]
    fn cell_of(&self, x: usize, y: usize) -> Option<usize> {
        let (column, row) = (x / SIDE, y / SIDE);
        if column >= self.blocks_x || row >= self.blocks_y {
            return None;
        }
        let block = self.number[row * self.blocks_x + column];
        (block != NONE).then(|| block as usize * BLOCK_CELLS + (y % SIDE) * SIDE + x % SIDE)
    }

    /// Column and row of a cell.
    pub(crate) fn column_row(&self, cell: usize) -> [usize; 2] {
        let [column, row] = self.place[cell / BLOCK_CELLS];
        let within = cell % BLOCK_CELLS;
        [column as usize * SIDE + within % SIDE, row as usize * SIDE + within / SIDE]
    }

    /// Cells with centres in a rectangle, block by block.
    pub(crate) fn cells_within(&self, area: Rect) -> Vec<usize> {
        let range = |low: f64, high: f64, origin: f64, count: usize| {
            let index = |m: f64| ((m - origin) * self.cells_per_m).clamp(0.0, count as f64) as usize;
            index(low)..(index(high) + 1).min(count)
        };
        let columns = range(area.min.x, area.max.x, self.origin_m.x, self.blocks_x * SIDE);
        let rows = range(area.min.y, area.max.y, self.origin_m.y, self.blocks_y * SIDE);
        let mut cells: Vec<usize> =
            rows.flat_map(|y| columns.clone().filter_map(move |x| self.cell_of(x, y))).collect();
        cells.retain(|&c| area.contains(self.centre(c)));
        cells.sort_unstable();
        cells
    }

    /// The cell at an offset of columns and rows, if it exists; the naive reference for tests.
    #[cfg(test)]
    fn shifted(&self, cell: usize, columns: i64, rows: i64) -> Option<usize> {
        let [x, y] = self.column_row(cell);
        let x = usize::try_from(x as i64 + columns).ok()?;
        let y = usize::try_from(y as i64 + rows).ok()?;
        self.cell_of(x, y)
    }

    /// Centre of a cell, metres.
    pub(crate) fn centre(&self, cell: usize) -> Vec2 {
        let [x, y] = self.column_row(cell);
        self.origin_m + vec2(x as f64 + 0.5, y as f64 + 0.5) * self.cell_m
    }

    /// Cells to the west, east, south and north; `usize::MAX` if missing.
    #[inline]
    pub(crate) fn around(&self, cell: usize) -> [usize; 4] {
        let within = cell % BLOCK_CELLS;
        let (x, y) = (within % SIDE, within / SIDE);
        let across = |side: usize, offset: usize| {
            let first = self.beside[cell / BLOCK_CELLS][side];
            if first == NONE { usize::MAX } else { first as usize + offset }
        };
        [
            if x > 0 { cell - 1 } else { across(0, within + SIDE - 1) },
            if x < SIDE - 1 { cell + 1 } else { across(1, within + 1 - SIDE) },
            if y > 0 { cell - SIDE } else { across(2, within + BLOCK_CELLS - SIDE) },
            if y < SIDE - 1 { cell + SIDE } else { across(3, within + SIDE - BLOCK_CELLS) },
        ]
    }

    /// Adjacent cells that exist.
    pub(crate) fn beside(&self, cell: usize) -> impl Iterator<Item = usize> {
        self.around(cell).into_iter().filter(|&beside| beside != usize::MAX)
    }

    /// Flood fill: returns `first` and all connected cells that `take` accepts; it must accept each cell only once.
    pub(crate) fn joined(&self, first: usize, mut take: impl FnMut(usize) -> bool) -> Vec<usize> {
        let mut joined = vec![first];
        let mut next = 0;
        while let Some(&cell) = joined.get(next) {
            next += 1;
            joined.extend(self.beside(cell).filter(|&beside| take(beside)));
        }
        joined
    }

    /// The four cells with centres around a point, and their bilinear weights.
    #[inline]
    pub(crate) fn stencil(&self, p: Vec2) -> [(Option<usize>, f64); 4] {
        let x = (p.x - self.origin_m.x) * self.cells_per_m - 0.5;
        let y = (p.y - self.origin_m.y) * self.cells_per_m - 0.5;
        let (x0, y0) = (x.floor(), y.floor());
        let (u, v) = (x - x0, y - y0);
        let cell = |dx: f64, dy: f64| {
            let (cx, cy) = (x0 + dx, y0 + dy);
            if cx >= 0.0 && cy >= 0.0 { self.cell_of(cx as usize, cy as usize) } else { None }
        };
        [
            (cell(0.0, 0.0), (1.0 - u) * (1.0 - v)),
            (cell(1.0, 0.0), u * (1.0 - v)),
            (cell(0.0, 1.0), (1.0 - u) * v),
            (cell(1.0, 1.0), u * v),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        // 40 x 40 cells of 0.5 m without the block in the upper right corner.
        let area = Rect { min: vec2(-2.0, 1.0), max: vec2(18.0, 21.0) };
        Lattice::new(area, 0.5, |block| block.min.x < 10.0 || block.min.y < 10.0)
    }

    #[test]
    fn a_cell_contains_its_middle() {
        let lattice = lattice();
        for cell in 0..lattice.len() {
            assert_eq!(lattice.cell_at(lattice.centre(cell)), Some(cell));
        }
        assert_eq!(lattice.cell_at(vec2(-2.1, 3.0)), None);
        assert_eq!(lattice.cell_at(vec2(1e9, 3.0)), None);
        assert_eq!(lattice.cell_at(vec2(f64::NAN, 3.0)), None);
    }

    #[test]
    fn cells_beside_each_other_are_one_cell_apart() {
        let lattice = lattice();
        for cell in 0..lattice.len() {
            for (side, (dx, dy)) in [(-1, 0), (1, 0), (0, -1), (0, 1)].into_iter().enumerate() {
                let beside = lattice.around(cell)[side];
                assert_eq!(lattice.shifted(cell, dx, dy).unwrap_or(usize::MAX), beside, "cell {cell} side {side}");
            }
        }
    }

    #[test]
    fn stencil_weights_reproduce_the_point() {
        let lattice = lattice();
        let p = vec2(3.31, 7.77);
        let mut sum = Vec2::ZERO;
        for (cell, weight) in lattice.stencil(p) {
            sum += lattice.centre(cell.expect("inside")) * weight;
        }
        assert!(sum.distance(p) < 1e-12, "{sum:?}");
    }
}
