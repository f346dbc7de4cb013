//! The light model: irradiance of floor and walls from lamps or from sky and sun, with bounced light and occlusion.

use super::panels::{Panel, Panels};
use super::ray_grid::{QuadKind, RayGrid, WallQuad};
use super::shades::{EXPOSURE_ABOVE, EXPOSURE_INSIDE, smooth, wall_edges};
use crate::math::{Vec2, sin_cos, vec2};

/// Largest distance of walls that block light, metres.
const REACH_M: f64 = 6.0;
/// Light of an endless raster of panels, each the sum over its area, by which light is divided: under it lies 1.
const FULL_PANELS: f64 = 3.7 * 0.72;
/// Least distance of a ray's start from a wall, metres.
pub(crate) const OFF_WALL_M: f64 = 0.01;
/// Shares of the ceiling's height at which the page is told the light on a wall; it goes straight between and beyond.
pub(crate) const WALL_HEIGHTS: [f64; 2] = [0.2, 0.75];

/// The light sources of a picture.
#[derive(Debug)]
pub(crate) enum LightSources {
    /// Panels in the ceiling.
    Inside(Panels),
    /// A soft sky and a large lamp at one side: unit vector toward it.
    Above(Vec2),
}

/// Light that falls on a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Irradiance {
    /// Irradiance; 1 in a well-lit place.
    pub full: f32,
    /// Share of the surroundings that is open, 0 to 1.
    pub open: f32,
}

/// The light in the rooms of a plan.
#[derive(Debug)]
pub(crate) struct Light<'a> {
    pub space: &'a RayGrid,
    pub sources: LightSources,
}

impl<'a> Light<'a> {
    /// The light of the lamps.
    pub fn inside(space: &'a RayGrid) -> Light<'a> {
        Light { space, sources: LightSources::Inside(Panels::over(space)) }
    }

    /// The light on rooms without a ceiling, over the left shoulder of a viewer who looks in a direction, degrees.
    pub fn above(space: &'a RayGrid, heading_deg: f64) -> Light<'a> {
        let (sine, cosine) = sin_cos((heading_deg + 125.0) * std::f64::consts::PI / 180.0);
        Light { space, sources: LightSources::Above(vec2(cosine, sine)) }
    }

    /// The lamps, where there is a ceiling.
    pub fn panels(&self) -> Option<&Panels> {
        match &self.sources {
            LightSources::Inside(panels) => Some(panels),
            LightSources::Above(_) => None,
        }
    }

    /// How bright an irradiance of 1 is shown.
    pub fn exposure(&self) -> f32 {
        match self.sources {
            LightSources::Inside(_) => EXPOSURE_INSIDE,
            LightSources::Above(_) => EXPOSURE_ABOVE,
        }
    }

    /// Light on a place of the floor, or on the nearest one a little off the wall.
    pub fn on_floor(&self, p: Vec2) -> Irradiance {
        let Some(p) = self.onto_floor(p) else { return Irradiance { full: 0.6, open: 0.5 } };
        let height_m = self.space.height_m;
        match &self.sources {
            LightSources::Inside(panels) => {
                let open = self.open_around(p, height_m * 0.55);
                let h2 = height_m * height_m;
                let lit = self.panels_in_sight(panels, p).map(|(way, distance, panel)| {
                    let r2 = way.length_squared() + h2;
                    let fade = 1.0 - smooth(((distance - 4.0) / (REACH_M - 4.0)).clamp(0.0, 1.0));
                    panel.area() * fade * (h2 * h2 / (r2 * r2))
                });
                let direct = lit.sum::<f64>() / FULL_PANELS;
                Irradiance { full: (0.62 * direct + 0.55 * (0.25 + 0.75 * open)) as f32, open: open as f32 }
            }
            LightSources::Above(sun) => {
                let open = self.open_around(p, height_m);
                let lit = self.sunlit(p, *sun, height_m);
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

    /// The panels that a place sees: way to each in the plan, its length, and the panel.
    fn panels_in_sight<'p>(&'p self, panels: &'p Panels, p: Vec2) -> impl Iterator<Item = (Vec2, f64, Panel)> + 'p {
        panels.around(p, 2).filter_map(move |panel| {
            let way = panel.centre - p;
            let distance = way.length();
            let near = distance < REACH_M;
            let seen = near && (distance < 0.05 || self.way(p, way / distance, distance) >= distance);
            seen.then_some((way, distance, panel))
        })
    }

    /// Light on an upright line of a wall whose floor side is where `normal` points; `foot` lies [`OFF_WALL_M`] off it.
    pub fn on_wall(&self, foot: Vec2, normal: Vec2) -> WallLight<'_> {
        let along = normal.left();
        let ways = HALF_CIRCLE_8.map(|[cosine, sine]| (sine, self.way(foot, along * cosine + normal * sine, REACH_M)));
        let seen = match &self.sources {
            LightSources::Inside(panels) => {
                self.panels_in_sight(panels, foot).map(|(way, _, panel)| (way, panel.area())).collect()
            }
            LightSources::Above(_) => Vec::new(),
        };
        WallLight { light: self, foot, normal, ways, seen }
    }
}

/// Light on an upright line of a wall.
pub(crate) struct WallLight<'a> {
    light: &'a Light<'a>,
    foot: Vec2,
    normal: Vec2,
    /// Sine to the wall and way to the next wall, metres, by direction.
    ways: [(f64, f64); 8],
    /// Way to the panels in sight, and their area.
    seen: Vec<(Vec2, f64)>,
}

impl WallLight<'_> {
    /// Light at a height, metres.
    pub fn at(&self, z: f64) -> Irradiance {
        let even = self.even(z);
        match self.light.sources {
            LightSources::Inside(_) => {
                Irradiance { full: even.full * wall_edges(z as f32, self.light.space.height_m as f32), ..even }
            }
            LightSources::Above(_) => even,
        }
    }

    /// The same without the darkening along floor and ceiling.
    pub fn even(&self, z: f64) -> Irradiance {
        let height_m = self.light.space.height_m;
        let weight: f64 = self.ways.iter().map(|way| way.0).sum();
        let open = self.ways.iter().map(|(sine, way)| sine * way / (way + 0.35)).sum::<f64>()
            / (weight * REACH_M / (REACH_M + 0.35));
        let above = height_m - z;
        let full = match &self.light.sources {
            LightSources::Inside(_) => {
                let direct: f64 = self.seen.iter().map(|&(way, area)| area * self.of_panel(way, above)).sum();
                let from_floor = 0.40 + 0.08 * (1.0 - z / height_m);
                0.42 * (direct / FULL_PANELS).min(1.6) + 1.25 * from_floor * (0.3 + 0.7 * open)
            }
            LightSources::Above(sun) => {
                let sky = self.ways.iter().map(|(sine, way)| sine * way * way / (way * way + above * above));
                let facing = self.normal.dot(*sun).max(0.0);
                let lit = if facing > 0.0 { facing * self.light.sunlit(self.foot, *sun, above.max(0.05)) } else { 0.0 };
                0.20 + 0.30 * sky.sum::<f64>() / weight + 0.55 * lit
            }
        };
        Irradiance { full: full as f32, open: open as f32 }
    }

    /// Light of a panel by its area, `below` metres under the ceiling.
    fn of_panel(&self, way: Vec2, below: f64) -> f64 {
        let height_m = self.light.space.height_m;
        let facing = way.dot(self.normal).max(0.0);
        // A panel is no point: close to it light does not grow beyond measure.
        let squared = way.length_squared() + below * below + 1.6;
        height_m * height_m * facing * (below + 0.15) / (squared * squared)
    }
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
