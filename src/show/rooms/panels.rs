//! The lamps in the ceiling: bright panels on a raster of tiles, wherever there is room for one.

use rayon::prelude::*;

use super::ray_grid::{RayGrid, WallQuad};
use crate::math::{Vec2, vec2};

/// Side of a ceiling tile, metres.
pub(crate) const TILE_M: f64 = 0.6;
/// Each square of so many tiles has a panel, if it fits.
const SQUARE_TILES: i64 = 5;
/// Side of such a square, metres.
const SQUARE_M: f64 = TILE_M * SQUARE_TILES as f64;
/// A frame around the light, metres.
const FRAME_M: f64 = 0.03;
/// Distance from walls that is enough, metres.
const CLEAR_M: f64 = 0.9;

/// A lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Panel {
    pub centre: Vec2,
    /// Half its size in x and y, metres.
    pub half: Vec2,
}

impl Panel {
    /// Area, square metres.
    pub fn area(&self) -> f64 {
        4.0 * self.half.x * self.half.y
    }
}

/// All lamps, by square.
#[derive(Debug)]
pub(crate) struct Panels {
    origin: [i64; 2],
    columns: i64,
    rows: i64,
    squares: Vec<Option<Panel>>,
}

impl Panels {
    /// Mean over the floor, under an endless raster of panels in a room of usual height, of the sum of their areas times
    /// the sixth powers of their cosines: light is divided by it.
    pub const FULL: f64 = 0.75;

    pub fn over(space: &RayGrid) -> Panels {
        let square = |m: f64| (m / SQUARE_M).floor() as i64;
        let origin = [square(space.block.min.x), square(space.block.min.y)];
        let columns = square(space.block.max.x) - origin[0] + 1;
        let rows = square(space.block.max.y) - origin[1] + 1;
        let squares = (0..columns * rows)
            .into_par_iter()
            .map(|k| best_panel(space, [origin[0] + k % columns, origin[1] + k / columns]))
            .collect();
        Panels { origin, columns, rows, squares }
    }

    /// All panels, row by row.
    pub fn all(&self) -> impl Iterator<Item = &Panel> {
        self.squares.iter().flatten()
    }

    /// All panels whose centres are nearer to a place than `reach_m`, and some beyond.
    pub fn around(&self, p: Vec2, reach_m: f64) -> impl Iterator<Item = Panel> {
        let reach = (reach_m / SQUARE_M).ceil() as i64;
        (-reach..=reach).flat_map(move |dy| (-reach..=reach).filter_map(move |dx| self.near(p, [dx, dy])))
    }

    /// The panel of the square that holds a place, or of one `dx`, `dy` squares beside it.
    pub fn near(&self, p: Vec2, [dx, dy]: [i64; 2]) -> Option<Panel> {
        let x = (p.x / SQUARE_M).floor() as i64 + dx - self.origin[0];
        let y = (p.y / SQUARE_M).floor() as i64 + dy - self.origin[1];
        let inside = x >= 0 && y >= 0 && x < self.columns && y < self.rows;
        inside.then(|| self.squares[(y * self.columns + x) as usize]).flatten()
    }
}

/// The panel in a square that is farthest from walls, the most central of those that are far enough.
fn best_panel(space: &RayGrid, [x, y]: [i64; 2]) -> Option<Panel> {
    let mut best: Option<(f64, Panel)> = None;
    for [i, j, across, up] in places() {
        let corner = vec2((x * SQUARE_TILES + i) as f64, (y * SQUARE_TILES + j) as f64) * TILE_M;
        let half = vec2(across as f64, up as f64) * (0.5 * TILE_M);
        let centre = corner + half;
        let Some(clear) = clearance(space, centre, half) else { continue };
        let clear = clear.min(CLEAR_M);
        if clear > 0.04 && best.is_none_or(|(most, _)| clear > most + 1e-6) {
            best = Some((clear, Panel { centre, half: half - vec2(FRAME_M, FRAME_M) }));
        }
    }
    best.map(|(_, panel)| panel)
}

/// Places of a panel in a square: column, row, width and height in tiles, the most central first.
fn places() -> impl Iterator<Item = [i64; 4]> {
    let corners = (0..SQUARE_TILES).flat_map(|j| (0..SQUARE_TILES).map(move |i| [i, j]));
    let mut places: Vec<[i64; 4]> = corners
        .flat_map(|[i, j]| [[i, j, 1, 2], [i, j, 2, 1]])
        .filter(|[i, j, across, up]| i + across <= SQUARE_TILES && j + up <= SQUARE_TILES)
        .collect();
    let off = |at: i64, size: i64| (2 * at + size - SQUARE_TILES) * (2 * at + size - SQUARE_TILES);
    places.sort_by_key(|[i, j, across, up]| off(*i, *across) + off(*j, *up));
    places.into_iter()
}

/// Distance from a rectangle to the nearest wall, approximate; `None` if its centre is not over floor.
fn clearance(space: &RayGrid, centre: Vec2, half: Vec2) -> Option<f64> {
    if !space.is_floor(centre) {
        return None;
    }
    let solid = |piece: &WallQuad, _: f64| piece.height_m.is_infinite();
    let mut clear = CLEAR_M;
    for (toward, reach) in [
        (vec2(1.0, 0.0), half.x),
        (vec2(-1.0, 0.0), half.x),
        (vec2(0.0, 1.0), half.y),
        (vec2(0.0, -1.0), half.y),
        (vec2(0.6, 0.8), half.length()),
        (vec2(-0.8, 0.6), half.length()),
        (vec2(-0.6, -0.8), half.length()),
        (vec2(0.8, -0.6), half.length()),
    ] {
        if let Some(met) = space.cast(centre, toward, reach + CLEAR_M, solid) {
            clear = clear.min(met.way_m - reach);
        }
    }
    Some(clear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::{Walls, WallsOptions};

    fn over(width: u32, height: u32, px_m: f64, floor: Vec<u8>) -> Vec<Panel> {
        let walls = Walls::trace(&FloorPlan::from_mask(width, height, px_m, floor), &WallsOptions::default());
        Panels::over(&RayGrid::new(&walls, &[], 2.6)).all().copied().collect()
    }

    #[test]
    fn panels_hang_in_the_middle_of_a_corridor_and_along_it() {
        let rows = ["##################", "..................", "..................", "##################"];
        let floor = rows.iter().flat_map(|row| row.bytes()).map(|c| u8::from(c == b'.')).collect();
        let panels = over(18, 4, 1.0, floor);
        assert_eq!(panels.len(), 6);
        for panel in &panels {
            assert!((panel.centre.y - 2.0).abs() < 0.35 && panel.half.x > panel.half.y, "{panel:?}");
        }
    }

    #[test]
    fn nothing_hangs_in_a_gap() {
        assert_eq!(over(3, 3, 0.5, vec![0, 0, 0, 1, 1, 1, 0, 0, 0]), []);
    }
}
