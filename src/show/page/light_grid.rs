//! The light of the rooms on a coarse raster, as the page's shader reads it.

use image::{RgbImage, RgbaImage};

use super::field::CellGrid;
use crate::math::Vec2;
use crate::show::rooms::{Light, OFF_WALL_M};
use crate::walls::Walls;

/// Cells at least so large, metres, and how many at most along a side.
const LEAST_CELL_M: f64 = 0.2;
const MOST_CELLS: f64 = 512.0;
/// The irradiance that eight bits hold at most; kept as a square root, finer where it is dark.
pub(super) const MOST: f32 = 2.0;
/// Shares of the ceiling's height at which the page is told the light on a wall: enough for the pool under a lamp. It goes
/// straight between them, and stays beyond.
pub(super) const WALL_HEIGHTS: [f64; 4] = [0.08, 0.36, 0.64, 0.92];

/// Irradiance of the floor, the share of the surroundings that is open, irradiance of the nearest wall at [`WALL_HEIGHTS`],
/// and irradiance over the furniture.
#[derive(Clone, Debug)]
pub(super) struct LightGrid {
    pub raster: CellGrid,
    /// `None` away from floor.
    values: Vec<Option<[f32; 7]>>,
}

impl LightGrid {
    pub fn of(walls: &Walls, light: &Light) -> LightGrid {
        let raster = CellGrid::covering(walls.bounds_m().grown(1.0), LEAST_CELL_M, MOST_CELLS);
        let values = raster.map(|p| light.space.is_room(p).then(|| at(walls, light, p)));
        let mut grid = LightGrid { raster, values };
        // Cells under a wall take from their neighbours, so that filters find light there.
        for _ in 0..3 {
            grid.spread();
        }
        grid
    }

    fn spread(&mut self) {
        let (width, height) = (i64::from(self.raster.width), i64::from(self.raster.height));
        let before = self.values.clone();
        for j in 0..height {
            for i in 0..width {
                let here = (j * width + i) as usize;
                if before[here].is_some() {
                    continue;
                }
                let beside = (-1..=1).flat_map(|dj| (-1..=1).map(move |di| (i + di, j + dj)));
                let lit: Vec<[f32; 7]> = beside
                    .filter(|&(i, j)| (0..width).contains(&i) && (0..height).contains(&j))
                    .filter_map(|(i, j)| before[(j * width + i) as usize])
                    .collect();
                if !lit.is_empty() {
                    let mean = |n: usize| lit.iter().map(|value| value[n]).sum::<f32>() / lit.len() as f32;
                    self.values[here] = Some(std::array::from_fn(mean));
                }
            }
        }
    }

    /// Square roots of the values over [`MOST`]: floor, open share and light over the furniture in red, green and blue, and
    /// walls; row 0 is the southernmost.
    pub fn images(&self) -> (RgbImage, RgbaImage) {
        let byte = |value: f32| (255.0 * (value / MOST).clamp(0.0, 1.0).sqrt()).round() as u8;
        let bytes = || self.values.iter().map(|value| value.unwrap_or_default().map(byte));
        let floor = bytes().flat_map(|[floor, open, .., over]| [floor, open, over]).collect();
        let walls = bytes().flat_map(|[_, _, walls @ .., _]| walls).collect();
        let (width, height) = (self.raster.width, self.raster.height);
        (
            RgbImage::from_raw(width, height, floor).unwrap_or_default(),
            RgbaImage::from_raw(width, height, walls).unwrap_or_default(),
        )
    }
}

fn at(walls: &Walls, light: &Light, p: Vec2) -> [f32; 7] {
    let floor = light.on_floor(p);
    let wall = walls.nearest(p, 2.0).and_then(|wall| {
        let normal = (p - wall.point_m).normalized()?;
        let line = light.on_wall(wall.point_m + normal * OFF_WALL_M, normal);
        Some(WALL_HEIGHTS.map(|share| line.even(share * light.space.height_m).full))
    });
    // Filters reach no farther than a cell beyond those that walls are lit by.
    let [a, b, c, d] = wall.unwrap_or([floor.full; 4]);
    let space = light.space;
    let shade = floor.shade * space.fittings.beside_feet(space.shades_at(p), p) as f32;
    [floor.full * shade, floor.open, a, b, c, d, floor.full]
}
