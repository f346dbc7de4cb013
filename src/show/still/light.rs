//! Irradiance of floor and walls on coarse rasters, computed where the camera looks.

use std::collections::BTreeSet;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::panels::Panels;
use super::ray_grid::{QuadKind, RayGrid, WallQuad};
use crate::math::{Vec2, exp_f32, sin_cos, vec2};

/// Places per metre at which light is computed.
const PER_METRE: f64 = 8.0;
/// Side of a block of such places.
const SIDE: usize = 16;
/// Largest distance of walls that block light, metres.
const REACH_M: f64 = 6.0;
/// Sum over an endless raster of panels, by which light is divided: under it lies 1.
const FULL_PANELS: f64 = 3.7;
/// Least distance of a ray's start from a wall, metres.
const OFF_WALL_M: f64 = 0.01;

/// The light sources of a still.
#[derive(Debug)]
pub(super) enum Lighting {
    /// By panels in the ceiling, and by what floor and walls throw back.
    Inside(Panels),
    /// From a soft sky and from one side: unit vector toward it.
    Above(Vec2),
}

/// Light that falls on a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Irradiance {
    /// Irradiance; 1 in a well-lit place.
    pub full: f32,
    /// Share of the surroundings that is open, 0 to 1.
    pub open: f32,
}

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
    space: &'a RayGrid,
    lighting: Lighting,
    /// Rows of a wall's raster.
    rows: usize,
    blocks: FxHashMap<LightKey, Box<[Irradiance]>>,
}

impl<'a> LightMap<'a> {
    pub fn new(space: &'a RayGrid, lighting: Lighting) -> LightMap<'a> {
        let rows = (space.height_m * PER_METRE).ceil() as usize + 1;
        LightMap { space, lighting, rows, blocks: FxHashMap::default() }
    }

    pub fn lighting(&self) -> &Lighting {
        &self.lighting
    }

    /// The block that a place on the floor needs.
    pub fn floor_key(&self, x: f32, y: f32) -> LightKey {
        let block = |m: f32| (m * PER_METRE as f32 / SIDE as f32).floor() as i32;
        LightKey { layer: 0, x: block(x), y: block(y) }
    }

    /// The block that a place on a piece of wall needs.
    pub fn wall_key(&self, piece: u32, along_m: f32) -> LightKey {
        let columns = Columns::of(&self.space.pieces[piece as usize]);
        LightKey { layer: piece + 1, x: (columns.at(along_m).0 / SIDE) as i32, y: 0 }
    }

    /// Computes what is needed and is not there yet.
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
                (corner + vec2(i, j)) / PER_METRE
            };
            return (0..(SIDE + 1) * (SIDE + 1)).map(|k| self.on_floor(place(k))).collect();
        }
        let piece = &self.space.pieces[key.layer as usize - 1];
        let columns = Columns::of(piece);
        let mut block = vec![Irradiance::default(); (SIDE + 1) * self.rows];
        let mut column = Vec::new();
        for k in 0..=SIDE {
            let number = key.x as usize * SIDE + k;
            // Beyond the piece's end the last column goes on.
            if k == 0 || number <= columns.count {
                column = self.on_wall(piece, columns.place(number));
            }
            for (row, &light) in column.iter().enumerate() {
                block[row * (SIDE + 1) + k] = light;
            }
        }
        block.into()
    }

    /// Light on a place of the floor.
    pub fn floor(&self, x: f32, y: f32) -> Irradiance {
        let Some(block) = self.blocks.get(&self.floor_key(x, y)) else { return Irradiance { full: 0.8, open: 0.8 } };
        let [x, y] = [x, y].map(|m| m * PER_METRE as f32);
        let within = |m: f32| m - (m / SIDE as f32).floor() * SIDE as f32;
        between(block, within(x), within(y), SIDE)
    }

    /// Light on a place of a piece of wall.
    pub fn wall(&self, piece: u32, along_m: f32, z: f32) -> Irradiance {
        let Some(block) = self.blocks.get(&self.wall_key(piece, along_m)) else {
            return Irradiance { full: 0.7, open: 0.7 };
        };
        let columns = Columns::of(&self.space.pieces[piece as usize]);
        let (column, share) = columns.at(along_m);
        let row = (z / self.space.height_m as f32).clamp(0.0, 1.0) * (self.rows - 1) as f32;
        between(block, (column % SIDE) as f32 + share, row, self.rows - 1)
    }

    fn on_floor(&self, p: Vec2) -> Irradiance {
        let Some(p) = self.onto_floor(p) else { return Irradiance { full: 0.6, open: 0.5 } };
        match &self.lighting {
            Lighting::Inside(panels) => {
                let open = self.open_around(p, self.space.height_m * 0.55);
                let direct = self.over_panels(panels, p, |_, r2, _| {
                    let h2 = self.space.height_m * self.space.height_m;
                    h2 * h2 / (r2 * r2)
                });
                Irradiance { full: (0.62 * direct + 0.55 * (0.25 + 0.75 * open)) as f32, open: open as f32 }
            }
            Lighting::Above(sun) => {
                let open = self.open_around(p, self.space.height_m);
                let lit = self.sunlit(p, *sun, self.space.height_m);
                Irradiance { full: (0.12 + 0.48 * open + 0.5 * lit) as f32, open: open as f32 }
            }
        }
    }

    /// The place itself, or the nearest one on the floor that lies a little off the wall.
    fn onto_floor(&self, p: Vec2) -> Option<Vec2> {
        if self.space.is_floor(p) {
            return Some(p);
        }
        // The raster's neighbours are 0.125 m apart: no farther is floor that asks for this place.
        const AROUND: [[f64; 2]; 8] =
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7], [0.7, -0.7]];
        let near = [0.03, 0.07, 0.12, 0.18].into_iter().flat_map(|m| AROUND.map(|[x, y]| p + vec2(x, y) * m));
        near.into_iter().find(|&q| self.space.is_floor(q))
    }

    /// Share of the sky over walls of a height that is seen from the floor: by directions, cosine-weighted.
    fn open_around(&self, p: Vec2, height_m: f64) -> f64 {
        const COUNT: usize = 12;
        let seen = DIRECTIONS_12.iter().map(|&[x, y]| {
            let way = self.way(p, vec2(x, y), REACH_M);
            way * way / (way * way + height_m * height_m)
        });
        // In the open all of it is seen, though rays end.
        let most = REACH_M * REACH_M / (REACH_M * REACH_M + height_m * height_m);
        seen.sum::<f64>() / (COUNT as f64 * most)
    }

    /// Way to the nearest wall in a direction, at most `reach_m`.
    fn way(&self, from: Vec2, toward: Vec2, reach_m: f64) -> f64 {
        let walls = |piece: &WallQuad, _: f64| matches!(piece.what, QuadKind::Wall(_));
        self.space.cast(from, toward, reach_m, walls).map_or(reach_m, |met| met.way_m.max(0.0))
    }

    /// Share of a large lamp at one side that is seen over walls that are `height_m` higher than the place.
    fn sunlit(&self, p: Vec2, sun: Vec2, height_m: f64) -> f64 {
        /// Metres upward per metre toward the light's middle.
        const SLOPE: f64 = 1.25;
        if self.space.is_open() {
            return 1.0;
        }
        let reach = height_m / SLOPE * 2.0;
        let share = SPREAD_7.iter().map(|&[x, y]| {
            let way = self.way(p, sun.rotated(vec2(x, y)), reach);
            let over = (way * SLOPE / height_m.max(0.05) - 0.65) / 0.7;
            smooth(over.clamp(0.0, 1.0))
        });
        share.sum::<f64>() / SPREAD_7.len() as f64
    }

    /// Sum over the visible panels of `weight(way, squared distance, area)`.
    fn over_panels(&self, panels: &Panels, p: Vec2, weight: impl Fn(Vec2, f64, f64) -> f64) -> f64 {
        let height2 = self.space.height_m * self.space.height_m;
        let mut sum = 0.0;
        for dy in -2..=2 {
            for dx in -2..=2 {
                let Some(panel) = panels.near(p, [dx, dy]) else { continue };
                let way = panel.centre - p;
                let distance = way.length();
                if distance >= REACH_M {
                    continue;
                }
                let seen = distance < 0.05 || self.way(p, way / distance, distance) >= distance;
                if seen {
                    let fade = 1.0 - smooth(((distance - 4.0) / (REACH_M - 4.0)).clamp(0.0, 1.0));
                    sum += panel.area() * fade * weight(way, distance * distance + height2, panel.area());
                }
            }
        }
        sum / FULL_PANELS / 0.72
    }

    /// Light on a column of a wall, from below.
    fn on_wall(&self, piece: &WallQuad, along_m: f64) -> Vec<Irradiance> {
        let normal = piece.normal();
        let p = piece.a
            + piece.along
                * along_m.clamp(0.02_f64.min(piece.length * 0.5), piece.length - 0.02_f64.min(piece.length * 0.5))
            + normal * OFF_WALL_M;
        let ways: Vec<(f64, f64)> = HALF_CIRCLE_8
            .iter()
            .map(|&[cosine, sine]| (sine, self.way(p, piece.along * cosine + normal * sine, REACH_M)))
            .collect();
        let weight: f64 = ways.iter().map(|way| way.0).sum();
        let open = ways.iter().map(|(sine, way)| sine * way / (way + 0.35)).sum::<f64>()
            / (weight * REACH_M / (REACH_M + 0.35));
        let seen = match &self.lighting {
            Lighting::Inside(panels) => self.panels_of_column(panels, p),
            Lighting::Above(_) => Vec::new(),
        };
        let height_m = self.space.height_m;
        let height = |row: usize| row as f64 / (self.rows - 1) as f64 * height_m;
        let at = |z: f64| match &self.lighting {
            Lighting::Inside(_) => {
                let direct: f64 = seen.iter().map(|panel| panel.on_wall(normal, height_m - z, height_m)).sum();
                let from_floor = 0.40 + 0.08 * (1.0 - z / height_m);
                let dark = |way: f64, share: f32, reach: f32| 1.0 - share * exp_f32(-(way as f32) / reach);
                let edges = dark(z, 0.30, 0.10) * dark(height_m - z, 0.22, 0.16);
                let full = (0.42 * direct.min(1.6) + 1.25 * from_floor * (0.3 + 0.7 * open)) as f32 * edges;
                Irradiance { full, open: open as f32 }
            }
            Lighting::Above(sun) => {
                let above = height_m - z;
                let sky =
                    ways.iter().map(|(sine, way)| sine * way * way / (way * way + above * above)).sum::<f64>() / weight;
                let facing = normal.dot(*sun).max(0.0);
                let lit = if facing > 0.0 { facing * self.sunlit(p, *sun, above.max(0.05)) } else { 0.0 };
                Irradiance { full: (0.20 + 0.30 * sky + 0.55 * lit) as f32, open: open as f32 }
            }
        };
        (0..self.rows).map(|row| at(height(row))).collect()
    }

    fn panels_of_column(&self, panels: &Panels, p: Vec2) -> Vec<SeenPanel> {
        let mut seen = Vec::new();
        for dy in -2..=2 {
            for dx in -2..=2 {
                let Some(panel) = panels.near(p, [dx, dy]) else { continue };
                let way = panel.centre - p;
                let distance = way.length();
                if distance < REACH_M && (distance < 0.05 || self.way(p, way / distance, distance) >= distance) {
                    seen.push(SeenPanel { way, area: panel.area() });
                }
            }
        }
        seen
    }
}

/// A panel that a wall sees.
struct SeenPanel {
    way: Vec2,
    area: f64,
}

impl SeenPanel {
    /// Its light on a wall, `below` metres under the ceiling.
    fn on_wall(&self, normal: Vec2, below: f64, height_m: f64) -> f64 {
        let facing = self.way.dot(normal).max(0.0);
        // A panel is no point: close to it light does not grow beyond measure.
        let squared = self.way.length_squared() + below * below + 1.6;
        self.area * height_m * height_m * facing * (below + 0.15) / (squared * squared) / FULL_PANELS / 0.72
    }
}

/// Columns of a wall piece at which light is computed: evenly from end to end.
struct Columns {
    count: usize,
    length: f64,
}

impl Columns {
    fn of(piece: &WallQuad) -> Columns {
        Columns { count: (piece.length * PER_METRE).ceil().max(1.0) as usize, length: piece.length }
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
    };
    let above = (at + SIDE + 1).min(block.len() - 2);
    mix(mix(block[at], block[at + 1], u), mix(block[above], block[above + 1], u), v)
}

fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// Unit vectors toward twelve sides, turned a little so that none runs along the walls of most plans.
const DIRECTIONS_12: [[f64; 2]; 12] = [
    [0.991_444_861_373_810_4, 0.130_526_192_220_051_6],
    [0.793_353_340_291_235_2, 0.608_761_429_008_720_6],
    [0.382_683_432_365_089_8, 0.923_879_532_511_286_7],
    [-0.130_526_192_220_051_6, 0.991_444_861_373_810_4],
    [-0.608_761_429_008_720_6, 0.793_353_340_291_235_2],
    [-0.923_879_532_511_286_7, 0.382_683_432_365_089_8],
    [-0.991_444_861_373_810_4, -0.130_526_192_220_051_6],
    [-0.793_353_340_291_235_2, -0.608_761_429_008_720_6],
    [-0.382_683_432_365_089_8, -0.923_879_532_511_286_7],
    [0.130_526_192_220_051_6, -0.991_444_861_373_810_4],
    [0.608_761_429_008_720_6, -0.793_353_340_291_235_2],
    [0.923_879_532_511_286_7, -0.382_683_432_365_089_8],
];

/// Cosine and sine of -24 to 24 degrees.
const SPREAD_7: [[f64; 2]; 7] = [
    [0.913_545_457_642_600_9, -0.406_736_643_075_800_2],
    [0.961_261_695_938_318_9, -0.275_637_355_816_999_2],
    [0.990_268_068_741_570_3, -0.139_173_100_960_065_4],
    [1.0, 0.0],
    [0.990_268_068_741_570_3, 0.139_173_100_960_065_4],
    [0.961_261_695_938_318_9, 0.275_637_355_816_999_2],
    [0.913_545_457_642_600_9, 0.406_736_643_075_800_2],
];

/// Cosine and sine of 11.25 to 168.75 degrees.
const HALF_CIRCLE_8: [[f64; 2]; 8] = [
    [0.980_785_280_403_230_4, 0.195_090_322_016_128_3],
    [0.831_469_612_302_545_2, 0.555_570_233_019_602_2],
    [0.555_570_233_019_602_2, 0.831_469_612_302_545_2],
    [0.195_090_322_016_128_3, 0.980_785_280_403_230_4],
    [-0.195_090_322_016_128_3, 0.980_785_280_403_230_4],
    [-0.555_570_233_019_602_2, 0.831_469_612_302_545_2],
    [-0.831_469_612_302_545_2, 0.555_570_233_019_602_2],
    [-0.980_785_280_403_230_4, 0.195_090_322_016_128_3],
];

/// Unit vector toward the light that falls over a viewer's left shoulder.
pub(super) fn over_the_shoulder(heading_deg: f64) -> Vec2 {
    let (sine, cosine) = sin_cos((heading_deg + 125.0) * std::f64::consts::PI / 180.0);
    vec2(cosine, sine)
}
