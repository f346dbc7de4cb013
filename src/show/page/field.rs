//! How far the nearest wall is and where the day stands in an opening, on a coarse raster: for reflections in the floor.

use image::RgbImage;
use rayon::prelude::*;

use crate::math::{Rect, Vec2, vec2};
use crate::show::rooms::{QuadKind, RayGrid};
use crate::walls::Walls;

/// The range of distances that eight bits hold, metres; negative within walls.
pub(super) const RANGE_M: [f64; 2] = [-0.4, 3.6];
/// Cells at least so large, metres.
const LEAST_CELL_M: f64 = 0.1;
/// Most cells along a side.
const MOST_CELLS: f64 = 1024.0;
/// How far the raster goes beyond the floor, metres.
const MARGIN_M: f64 = 1.0;

/// A raster over the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CellGrid {
    /// Its lower-left corner.
    pub origin_m: Vec2,
    pub cell_m: f64,
    pub width: u32,
    pub height: u32,
}

impl CellGrid {
    /// Cells of at least `least_m` that cover an area, at most `most` along a side.
    pub fn covering(area: Rect, least_m: f64, most: f64) -> CellGrid {
        let longest = area.width().max(area.height()).max(least_m);
        let cell_m = least_m.max(longest / most);
        let cells = |extent: f64| ((extent / cell_m).ceil().max(1.0)).min(most) as u32;
        CellGrid { origin_m: area.min, cell_m, width: cells(area.width()), height: cells(area.height()) }
    }

    /// The middle of a cell, counted from the lower left.
    pub fn centre(&self, i: u32, j: u32) -> Vec2 {
        self.origin_m + vec2(f64::from(i) + 0.5, f64::from(j) + 0.5) * self.cell_m
    }

    /// A value per cell, row by row from the lower left.
    pub fn map<T: Send>(&self, of: impl Fn(Vec2) -> T + Sync) -> Vec<T> {
        let rows: Vec<Vec<T>> = (0..self.height)
            .into_par_iter()
            .map(|j| (0..self.width).map(|i| of(self.centre(i, j))).collect())
            .collect();
        rows.into_iter().flatten().collect()
    }
}

/// Signed distances, negative in walls and beyond openings.
#[derive(Clone, Debug)]
pub(super) struct DistanceField {
    pub raster: CellGrid,
    /// Metres, within [`RANGE_M`]; and whether the plan is open there.
    cells: Vec<(f64, bool)>,
}

impl DistanceField {
    pub fn of(walls: &Walls, grid: &RayGrid) -> DistanceField {
        let openings: Vec<_> = grid.pieces.iter().filter(|piece| piece.what == QuadKind::Opening).collect();
        let raster = CellGrid::covering(walls.bounds_m().grown(MARGIN_M), LEAST_CELL_M, MOST_CELLS);
        let [low, high] = RANGE_M;
        let cells = raster.map(|p| {
            let distance = walls.nearest(p, high).map_or(high, |nearest| nearest.distance_m);
            // Aprons beyond openings are no room.
            if grid.is_room(p) {
                return (distance.min(high), false);
            }
            ((-distance).max(low), openings.iter().any(|opening| opening.hides(p)))
        });
        DistanceField { raster, cells }
    }

    /// Distance as red, day as green. Row 0 is the southernmost, as textures have it.
    pub fn image(&self) -> RgbImage {
        let [low, high] = RANGE_M;
        let byte = |distance: f64| (255.0 * (distance - low) / (high - low)).round() as u8;
        let bytes = self.cells.iter().flat_map(|&(distance, day)| [byte(distance), u8::from(day) * 255, 0]).collect();
        RgbImage::from_raw(self.raster.width, self.raster.height, bytes).unwrap_or_default()
    }
}
