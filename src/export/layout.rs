use serde::{Deserialize, Serialize};

use super::ExportError;
use crate::math::{Rect, vec2};
use crate::stamps::TexelGrid;

/// Side of the blocks in which textures are resolved, compressed and stored, texels.
pub const BLOCK: usize = 256;

/// The division of a floor into texture tiles.
///
/// Tiles start at multiples of the tile size from the floor's lower left. Along an axis with several tiles all have
/// full size, so that one scale maps metres to UV over all of them (`u = x t / tile`); the empty rest costs almost no
/// disk space. Along an axis on which the floor is smaller than a tile, the tile's side is the next power of two, with
/// the floor at its lower left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileLayout {
    /// Texel grid of the whole floor.
    pub grid: TexelGrid,
    /// Width of each tile, texels.
    pub width: u32,
    /// Height of each tile, texels.
    pub height: u32,
}

/// One tile of a [`TileLayout`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column from the left.
    pub u: u32,
    /// Row from below.
    pub v: u32,
    /// Its first column of the whole floor.
    pub i0: u32,
    /// Its first row of the whole floor.
    pub j0: u32,
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
}

/// How the tiles of a floor are named.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Naming {
    #[default]
    /// `.1001.`, 1001 + u + 10 v: up to 10 x 10 tiles.
    Udim,
    /// `_u012_v003.`: any number.
    Uv,
}

impl TileLayout {
    /// Least tile size, texels.
    pub const MIN_TILE: u32 = 64;
    /// Greatest tile size, texels: the limit of engines and graphics cards.
    pub const MAX_TILE: u32 = 16_384;

    /// Divides a floor into tiles of at most `tile` texels.
    ///
    /// # Errors
    /// A tile size out of range.
    pub fn new(grid: TexelGrid, tile: u32) -> Result<TileLayout, ExportError> {
        let (min, max) = (Self::MIN_TILE, Self::MAX_TILE);
        if !(min..=max).contains(&tile) {
            return Err(ExportError::TileSize { tile, min, max });
        }
        let side = |extent: u32| if extent > tile { tile } else { extent.max(1).next_power_of_two().min(tile) };
        Ok(TileLayout { grid, width: side(grid.width), height: side(grid.height) })
    }

    /// Number of columns of tiles.
    pub fn columns(&self) -> u32 {
        self.grid.width.max(1).div_ceil(self.width)
    }

    /// Number of rows of tiles.
    pub fn rows(&self) -> u32 {
        self.grid.height.max(1).div_ceil(self.height)
    }

    /// Iterates over all tiles, row by row from the lower left.
    pub fn tiles(&self) -> impl Iterator<Item = Tile> + use<> {
        let TileLayout { width, height, .. } = *self;
        let columns = self.columns();
        (0..self.rows())
            .flat_map(move |v| (0..columns).map(move |u| Tile { u, v, i0: u * width, j0: v * height, width, height }))
    }

    /// Naming scheme of the tiles: UDIM for up to 10 x 10 tiles, else u and v.
    pub fn naming(&self) -> Naming {
        if self.columns() <= 10 && self.rows() <= 10 { Naming::Udim } else { Naming::Uv }
    }

    /// Returns the name of a tile's image, such as `floor_mask.1001.png`.
    pub fn file_name(&self, tile: &Tile, kind: &str, extension: &str) -> String {
        match self.naming() {
            Naming::Udim => format!("floor_{kind}.{}.{extension}", tile.udim()),
            Naming::Uv => format!("floor_{kind}_u{:03}_v{:03}.{extension}", tile.u, tile.v),
        }
    }

    /// Returns a tile's rectangle in the plan frame, metres.
    pub fn place_m(&self, tile: &Tile) -> Rect {
        let t = self.grid.texels_per_metre;
        let corner = |i: u32, j: u32| vec2(f64::from(i) / t, f64::from(j) / t);
        Rect { min: corner(tile.i0, tile.j0), max: corner(tile.i0 + tile.width, tile.j0 + tile.height) }
    }
}

impl Tile {
    /// UDIM number: 1001 + u + 10 v.
    pub fn udim(&self) -> u32 {
        1001 + self.u + 10 * self.v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(width: u32, height: u32, tile: u32) -> TileLayout {
        TileLayout::new(TexelGrid { texels_per_metre: 100.0, width, height }, tile).unwrap()
    }

    #[test]
    fn a_small_floor_gets_one_tile_of_powers_of_two() {
        let layout = layout(5000, 1000, 8192);
        assert_eq!((layout.width, layout.height), (8192, 1024));
        assert_eq!(layout.tiles().count(), 1);
    }

    #[test]
    fn a_floor_of_exactly_a_tile_is_one_tile() {
        assert_eq!(layout(8192, 8192, 8192).tiles().count(), 1);
        assert_eq!(layout(8193, 8192, 8192).tiles().count(), 2);
    }

    #[test]
    fn tiles_start_at_multiples_of_the_tile_size_and_rows_count_upward() {
        let layout = layout(300, 90, 128);
        let tiles: Vec<Tile> = layout.tiles().collect();
        assert_eq!(tiles.len(), 3);
        assert_eq!((tiles[2].i0, tiles[2].j0, tiles[2].width, tiles[2].height), (256, 0, 128, 128));
        assert_eq!(layout.file_name(&tiles[2], "mask", "png"), "floor_mask.1003.png");
        let tall = self::layout(64, 200, 64);
        let top = tall.tiles().last().unwrap();
        assert_eq!((top.v, top.j0, top.udim()), (3, 192, 1031));
        assert_eq!(tall.place_m(&top).min.y, 1.92);
    }

    #[test]
    fn beyond_ten_by_ten_tiles_names_carry_column_and_row() {
        let layout = layout(64 * 11, 64, 64);
        let last = layout.tiles().last().unwrap();
        assert_eq!(layout.file_name(&last, "basecolor", "png"), "floor_basecolor_u010_v000.png");
    }

    #[test]
    fn a_tile_size_that_is_no_power_of_two_is_never_exceeded() {
        assert_eq!(layout(900, 100, 1000).width, 1000);
    }

    #[test]
    fn a_tile_size_out_of_range_is_refused() {
        let grid = TexelGrid { texels_per_metre: 100.0, width: 10, height: 10 };
        for tile in [0, 1, 63, 16_385, u32::MAX] {
            assert!(TileLayout::new(grid, tile).is_err(), "{tile}");
        }
    }
}
