//! Irradiance of floor and walls on coarse rasters, computed where the camera looks.

use std::collections::BTreeSet;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use crate::math::{Vec2, vec2};
use crate::show::rooms::{Irradiance, Light, OFF_WALL_M, WallQuad};

/// Places per metre at which light is computed, for cameras that see single metres.
const PER_METRE: f64 = 8.0;
/// Places per metre for cameras far away.
const LEAST_PER_METRE: f64 = 1.0;
/// Side of a block of such places.
const SIDE: usize = 16;

/// A block's place: 0 is the floor, 1 + n the piece n.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct LightKey {
    layer: u32,
    x: i32,
    y: i32,
}

/// Irradiance in blocks of places, by block.
#[derive(Debug)]
pub(super) struct LightMap<'a> {
    pub light: Light<'a>,
    /// Places per metre at which light is computed.
    per_metre: f64,
    /// Rows of a wall's raster.
    rows: usize,
    blocks: FxHashMap<LightKey, Box<[Irradiance]>>,
}

impl<'a> LightMap<'a> {
    /// A map for a camera whose pixels are at least `pixel_m` wide, metres, on every surface.
    pub fn new(light: Light<'a>, pixel_m: f64) -> LightMap<'a> {
        let per_metre = places_per_metre(pixel_m);
        let rows = (light.space.height_m * per_metre).ceil() as usize + 1;
        LightMap { light, per_metre, rows, blocks: FxHashMap::default() }
    }

    /// The block that a place on the floor needs.
    pub fn floor_key(&self, x: f32, y: f32) -> LightKey {
        let block = |m: f32| (m * self.per_metre as f32 / SIDE as f32).floor() as i32;
        LightKey { layer: 0, x: block(x), y: block(y) }
    }

    /// The block that a place on a piece of wall needs.
    pub fn wall_key(&self, piece: u32, along_m: f32) -> LightKey {
        let columns = Columns::of(&self.light.space.pieces[piece as usize], self.per_metre);
        LightKey { layer: piece + 1, x: (columns.at(along_m).0 / SIDE) as i32, y: 0 }
    }

    /// Computes the needed blocks that are not there yet.
    pub fn hold(&mut self, needed: &BTreeSet<LightKey>) {
        let fresh: Vec<&LightKey> = needed.iter().filter(|key| !self.blocks.contains_key(key)).collect();
        let made: Vec<(LightKey, Box<[Irradiance]>)> =
            fresh.into_par_iter().map(|&key| (key, self.make(key))).collect();
        self.blocks.extend(made);
    }

    fn make(&self, key: LightKey) -> Box<[Irradiance]> {
        if key.layer == 0 {
            let place = |k: usize| {
                let [i, j] = [k % (SIDE + 1), k / (SIDE + 1)].map(|k| k as f64);
                let corner = vec2(f64::from(key.x), f64::from(key.y)) * SIDE as f64;
                (corner + vec2(i, j)) / self.per_metre
            };
            return (0..(SIDE + 1) * (SIDE + 1)).map(|k| self.light.on_floor(place(k))).collect();
        }
        let piece = &self.light.space.pieces[key.layer as usize - 1];
        let columns = Columns::of(piece, self.per_metre);
        let mut block = vec![Irradiance::default(); (SIDE + 1) * self.rows];
        let mut column = Vec::new();
        for k in 0..=SIDE {
            let number = key.x as usize * SIDE + k;
            // Beyond the piece's end the last column goes on.
            if k == 0 || number <= columns.count {
                column = self.column(piece, columns.place(number));
            }
            for (row, &light) in column.iter().enumerate() {
                block[row * (SIDE + 1) + k] = light;
            }
        }
        block.into()
    }

    /// Light on a column of a wall, from below.
    fn column(&self, piece: &WallQuad, along_m: f64) -> Vec<Irradiance> {
        let off_end = 0.02_f64.min(piece.length * 0.5);
        let along_m = along_m.clamp(off_end, piece.length - off_end);
        let foot: Vec2 = piece.a + piece.along * along_m + piece.normal() * OFF_WALL_M;
        let column = self.light.on_wall(foot, piece.round_normal(along_m));
        let height = |row: usize| row as f64 / (self.rows - 1) as f64 * self.light.space.height_m;
        (0..self.rows).map(|row| column.at(height(row))).collect()
    }

    /// Light on a place of the floor.
    pub fn floor(&self, x: f32, y: f32) -> Irradiance {
        let Some(block) = self.blocks.get(&self.floor_key(x, y)) else { return Irradiance::new(0.8, 0.8) };
        let [x, y] = [x, y].map(|m| m * self.per_metre as f32);
        let within = |m: f32| m - (m / SIDE as f32).floor() * SIDE as f32;
        between(block, within(x), within(y), SIDE)
    }

    /// Light on a place of a piece of wall.
    pub fn wall(&self, piece: u32, along_m: f32, z: f32) -> Irradiance {
        let Some(block) = self.blocks.get(&self.wall_key(piece, along_m)) else {
            return Irradiance::new(0.7, 0.7);
        };
        let columns = Columns::of(&self.light.space.pieces[piece as usize], self.per_metre);
        let (column, share) = columns.at(along_m);
        let row = (z / self.light.space.height_m as f32).clamp(0.0, 1.0) * (self.rows - 1) as f32;
        between(block, (column % SIDE) as f32 + share, row, self.rows - 1)
    }
}

/// Places per metre at which light is computed: up to two pixels apart, so that work grows with the picture and not with
/// the site.
fn places_per_metre(pixel_m: f64) -> f64 {
    let mut per_metre = PER_METRE;
    while per_metre > LEAST_PER_METRE && per_metre * pixel_m >= 1.0 {
        per_metre *= 0.5;
    }
    per_metre
}

/// Columns of a wall piece at which light is computed: evenly from end to end.
struct Columns {
    count: usize,
    length: f64,
}

impl Columns {
    fn of(piece: &WallQuad, per_metre: f64) -> Columns {
        Columns { count: (piece.length * per_metre).ceil().max(1.0) as usize, length: piece.length }
    }

    /// Column left of a place, and how far it is to the next, 0 to 1.
    fn at(&self, along_m: f32) -> (usize, f32) {
        let at = (along_m / self.length as f32).clamp(0.0, 1.0) * self.count as f32;
        let column = (at as usize).min(self.count - 1);
        (column, at - column as f32)
    }

    fn place(&self, column: usize) -> f64 {
        (column as f64 / self.count as f64).min(1.0) * self.length
    }
}

/// Straight between four values of a block that is `SIDE + 1` wide.
fn between(block: &[Irradiance], x: f32, y: f32, last_row: usize) -> Irradiance {
    let (i, j) = ((x as usize).min(SIDE - 1), (y as usize).min(last_row.saturating_sub(1)));
    let (u, v) = (x - i as f32, (y - j as f32).min(1.0));
    let at = j * (SIDE + 1) + i;
    let mix = |a: Irradiance, b: Irradiance, t: f32| Irradiance {
        full: a.full + (b.full - a.full) * t,
        open: a.open + (b.open - a.open) * t,
        shade: a.shade + (b.shade - a.shade) * t,
    };
    let above = (at + SIDE + 1).min(block.len() - 2);
    mix(mix(block[at], block[at + 1], u), mix(block[above], block[above + 1], u), v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_up_to_two_pixels_apart() {
        assert_eq!([0.0, 0.06, 0.125, 0.3, 0.5, 1.0, 1e6].map(places_per_metre), [8.0, 8.0, 4.0, 2.0, 1.0, 1.0, 1.0]);
        for site_m in [200.0, 500.0, 1000.0] {
            let pixel_m = site_m / 1280.0;
            let along = places_per_metre(pixel_m) * pixel_m;
            let places_per_pixel = along * along;
            assert!((0.25..=1.0).contains(&places_per_pixel), "{site_m} m: {places_per_pixel}");
        }
    }
}
