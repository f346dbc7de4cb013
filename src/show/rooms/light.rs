//! The light model: irradiance of floor and walls from lamps and windows, or from sky and sun, with bounced light and
//! occlusion.

use super::panels::{Panel, Panels};
use super::ray_grid::RayGrid;
use super::shades::{EXPOSURE_ABOVE, EXPOSURE_INSIDE, EXPOSURE_OUTSIDE, wall_edges};
use crate::math::{Vec2, atan2, exp, sin_cos, smoothstep, vec2};

/// Largest distance of walls that block light, metres.
const REACH_M: f64 = 6.0;
/// Places of the floor by whose mean light all light is divided, so that every building is well lit.
const MEASURED: usize = 240;
/// Limits of that factor: a dark hall stays darker than an office.
const GAIN: [f64; 2] = [0.5, 3.0];
/// Light that walls, floor and ceiling throw onto a floor and onto a wall, where nothing is near.
const BOUNCE: [f64; 2] = [0.34, 0.36];
/// Light of lamps on the floor under an endless raster of them.
const LAMPS: f64 = 0.66;
/// Light of a panel on a wall, so that walls are as bright as floors in the mean.
const PANEL_ON_WALL: f64 = 1.11;
/// Square of a panel's size as a wall sees it, with what the ceiling around it throws back, square metres.
const PANEL_WIDE_M2: f64 = 1.5;
/// Darkening of the floor along walls: share, and the distance in which it fades, metres.
const CONTACT: [f64; 2] = [0.34, 0.16];
/// Daylight that comes in through an opening: factor on the part of the sky that it shows, and how far it is followed,
/// metres.
const DAY: f64 = 2.2;
const DAY_REACH_M: f64 = 14.0;
/// How far beyond an opening its light is the same, metres.
const DAY_BEYOND_M: f64 = 3.0;
/// Places in an opening, as shares of its width, from which daylight comes.
const DAY_FROM: [f64; 3] = [0.17, 0.5, 0.83];
/// Light outdoors: thrown back from all around, of the sky, of the sun.
const OUTDOORS: [f64; 3] = [0.07, 0.27, 0.92];
/// Direction of the sun in the plan, degrees, and how many metres it falls per metre, outdoors.
const SUN_DEG: f64 = 218.0;
const SUN_SLOPE: f64 = 0.80;
/// The same of the large lamp beside a plan that is seen from above.
const LAMP_SLOPE: f64 = 1.25;
/// Least distance of a ray's start from a wall, metres.
pub(crate) const OFF_WALL_M: f64 = 0.01;
/// Shares of the ceiling's height at which daylight on a wall is computed; it goes straight between them.
const WALL_HEIGHTS: [f64; 2] = [0.2, 0.75];

/// The light sources of a picture.
#[derive(Debug)]
pub(crate) enum LightSources {
    /// Panels in the ceiling, and daylight in openings.
    Inside(Panels),
    /// A soft sky and a large lamp at one side: unit vector toward it.
    Above(Vec2),
    /// Sky and sun over walls without a ceiling: unit vector toward the sun.
    Outside(Vec2),
}

/// Light that falls on a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Irradiance {
    /// Irradiance; 1 in a well-lit place.
    pub full: f32,
    /// Share of the surroundings that is open, 0 to 1.
    pub open: f32,
    /// Share of it that furniture leaves on the floor.
    pub shade: f32,
}

impl Irradiance {
    /// Of a surface that no furniture darkens.
    pub fn new(full: f32, open: f32) -> Irradiance {
        Irradiance { full, open, shade: 1.0 }
    }
}

/// The light in the rooms of a plan.
#[derive(Debug)]
pub(crate) struct Light<'a> {
    pub space: &'a RayGrid,
    pub sources: LightSources,
    /// Factor on light from lamps and openings.
    gain: f64,
}

impl<'a> Light<'a> {
    /// The light at eye level: of lamps, or of the sky where there is no ceiling.
    pub fn inside(space: &'a RayGrid) -> Light<'a> {
        if !space.roofed {
            let (sine, cosine) = sin_cos(SUN_DEG * std::f64::consts::PI / 180.0);
            return Light { space, sources: LightSources::Outside(vec2(cosine, sine)), gain: 1.0 };
        }
        let light = Light { space, sources: LightSources::Inside(Panels::over(space)), gain: 1.0 };
        let places: Vec<Vec2> = space.floor_places().collect();
        let stride = places.len().div_ceil(MEASURED).max(1);
        let seen: Vec<f64> = places.iter().step_by(stride).map(|&p| f64::from(light.on_floor(p).full)).collect();
        let mean = seen.iter().sum::<f64>() / seen.len().max(1) as f64;
        Light { gain: (1.0 / mean.max(0.1)).clamp(GAIN[0], GAIN[1]), ..light }
    }

    /// The light on rooms without a ceiling, over the left shoulder of a viewer who looks in a direction, degrees.
    pub fn above(space: &'a RayGrid, heading_deg: f64) -> Light<'a> {
        let (sine, cosine) = sin_cos((heading_deg + 125.0) * std::f64::consts::PI / 180.0);
        Light { space, sources: LightSources::Above(vec2(cosine, sine)), gain: 1.0 }
    }

    /// The lamps, where there is a ceiling.
    pub fn panels(&self) -> Option<&Panels> {
        match &self.sources {
            LightSources::Inside(panels) => Some(panels),
            LightSources::Above(_) | LightSources::Outside(_) => None,
        }
    }

    /// How bright an irradiance of 1 is shown.
    pub fn exposure(&self) -> f32 {
        match self.sources {
            LightSources::Inside(_) => EXPOSURE_INSIDE,
            LightSources::Above(_) => EXPOSURE_ABOVE,
            LightSources::Outside(_) => EXPOSURE_OUTSIDE,
        }
    }

    /// Light on a place of the floor, or on the nearest one a little off the wall.
    pub fn on_floor(&self, p: Vec2) -> Irradiance {
        let shade = self.space.fittings.under_boards(self.space.shades_at(p), p) as f32;
        Irradiance { shade, ..self.over_floor(p) }
    }

    /// The same without furniture.
    fn over_floor(&self, p: Vec2) -> Irradiance {
        let height_m = self.space.height_m;
        let Some(p) = self.onto_floor(p) else {
            let day = if self.panels().is_some() { self.gain * self.daylight_on_floor(p) } else { 0.0 };
            return Irradiance::new(day.max(0.6) as f32, 0.5);
        };
        match &self.sources {
            LightSources::Inside(panels) => {
                let (open, near_m) = self.open_around(p, height_m * 0.55);
                let h2 = height_m * height_m;
                let lit = self.panels_in_sight(panels, p).map(|(way, distance, panel)| {
                    // Louvres keep the light below the lamp: pools on the floor.
                    let cosine2 = h2 / (way.length_squared() + h2);
                    let fade = 1.0 - smoothstep((distance - 4.0) / (REACH_M - 4.0));
                    panel.area() * fade * cosine2 * cosine2 * cosine2
                });
                let direct = LAMPS * lit.sum::<f64>() / Panels::FULL;
                let day = self.daylight_on_floor(p);
                let bounced = BOUNCE[0] * (0.25 + 0.75 * open);
                let contact = 1.0 - CONTACT[0] * exp(-near_m / CONTACT[1]);
                Irradiance::new((self.gain * (direct + bounced + day) * contact) as f32, open as f32)
            }
            LightSources::Above(sun) => {
                let (open, _) = self.open_around(p, height_m);
                let lit = self.sunlit(p, *sun, height_m, LAMP_SLOPE, &SPREAD_7);
                Irradiance::new((0.12 + 0.48 * open + 0.5 * lit) as f32, open as f32)
            }
            LightSources::Outside(sun) => {
                let (open, near_m) = self.open_around(p, height_m);
                let lit = self.sunlit(p, *sun, height_m, SUN_SLOPE, &SUN_DISC);
                let contact = 1.0 - 0.6 * CONTACT[0] * exp(-near_m / CONTACT[1]);
                Irradiance::new(((OUTDOORS[0] + OUTDOORS[1] * open + OUTDOORS[2] * lit) * contact) as f32, open as f32)
            }
        }
    }

    /// Daylight from the openings on a place of the floor: each is an upright bright rectangle, seen from a level place
    /// before its foot (Howell, A catalog of radiation heat transfer configuration factors, B-3). Beyond an opening it is
    /// as bright as in it.
    fn daylight_on_floor(&self, p: Vec2) -> f64 {
        let of_opening = |([a, b], [low_m, high_m]): ([Vec2; 2], [f64; 2])| {
            let Some(along) = (b - a).normalized() else { return 0.0 };
            let (width_m, x) = (a.distance(b), (p - a).dot(along));
            // The floor is on the right of an opening.
            let off_m = along.cross(a - p);
            let beyond_m = if low_m > 0.0 { 0.0 } else { DAY_BEYOND_M };
            if !(-beyond_m..=DAY_REACH_M).contains(&off_m) {
                return 0.0;
            }
            let seen = DAY_FROM.map(|share| {
                let way = a + (b - a) * share - p;
                let distance = way.length();
                let is_seen = off_m <= 0.0 || self.way(p, way / distance.max(1e-6), distance - 0.02) >= distance - 0.02;
                if is_seen { 1.0 - smoothstep((distance - 7.0) / (DAY_REACH_M - 7.0)) } else { 0.0 }
            });
            let off_m = off_m.max(0.0);
            let up_to = |top_m: f64| {
                let edge_m = (off_m * off_m + top_m * top_m).sqrt();
                let half = |side_m: f64| atan2(side_m, off_m) - off_m / edge_m * atan2(side_m, edge_m);
                half(x) + half(width_m - x)
            };
            let below = if low_m > 0.0 { up_to(low_m) } else { 0.0 };
            seen.iter().sum::<f64>() / seen.len() as f64 * (up_to(high_m) - below)
        };
        DAY * self.daylight_from().map(of_opening).sum::<f64>() / std::f64::consts::PI
    }

    /// Where daylight comes in: both ends of openings and windows, and their lower and upper sides.
    fn daylight_from(&self) -> impl Iterator<Item = ([Vec2; 2], [f64; 2])> + '_ {
        let openings = self.space.openings.iter().map(|&ends| (ends, [0.0, self.space.height_m]));
        openings.chain(self.space.fittings.windows.iter().map(|window| (window.ends, window.span_m)))
    }

    /// Daylight from the openings on a wall with this normal, at both [`WALL_HEIGHTS`].
    fn daylight_on_wall(&self, p: Vec2, normal: Vec2) -> [f64; 2] {
        let height_m = self.space.height_m;
        let mut sums = [0.0; 2];
        for ([a, b], [low_m, high_m]) in self.daylight_from() {
            let Some(along) = (b - a).normalized() else { continue };
            let (width_m, share_up) = (a.distance(b), (high_m - low_m) / height_m);
            for share in DAY_FROM {
                let way = a + (b - a) * share - p;
                let distance = way.length();
                let toward = way / distance.max(1e-6);
                let leaves = along.cross(toward).max(0.0);
                let facing = normal.dot(toward);
                let is_seen = || self.way(p, toward, distance - 0.02) >= distance - 0.02;
                if distance > DAY_REACH_M || leaves <= 0.0 || facing <= 0.0 || !is_seen() {
                    continue;
                }
                let d2 = distance * distance + 0.3;
                let fade = 1.0 - smoothstep((distance - 7.0) / (DAY_REACH_M - 7.0));
                let from = share_up * leaves * fade * width_m / (DAY_FROM.len() as f64 * d2.sqrt());
                for (sum, at) in sums.iter_mut().zip(WALL_HEIGHTS) {
                    // A wall sees all of an opening, more of it at half its height.
                    let off = (at - 0.5) * height_m;
                    *sum += from * facing * height_m * distance / (d2 + off * off + 0.1 * height_m * height_m);
                }
            }
        }
        sums.map(|sum| DAY * sum / std::f64::consts::PI)
    }

    /// The place itself, or the nearest one on the floor that lies a little off the wall.
    fn onto_floor(&self, p: Vec2) -> Option<Vec2> {
        if self.space.is_room(p) {
            return Some(p);
        }
        // The raster's neighbours are 0.125 m apart: no farther is floor that asks for this place.
        const AROUND: [[f64; 2]; 8] =
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7], [0.7, -0.7]];
        let near = [0.03, 0.07, 0.12, 0.18].into_iter().flat_map(|m| AROUND.map(|[x, y]| p + vec2(x, y) * m));
        near.into_iter().find(|&q| self.space.is_floor(q))
    }

    /// Share of the sky over walls of a height that is seen from the floor: by directions, cosine-weighted. And the
    /// distance of the nearest wall, metres.
    fn open_around(&self, p: Vec2, height_m: f64) -> (f64, f64) {
        const COUNT: usize = 12;
        let ways = DIRECTIONS_12.map(|[x, y]| self.way(p, vec2(x, y), REACH_M));
        let seen = ways.iter().map(|way| way * way / (way * way + height_m * height_m));
        // In the open all of it is seen, though rays end.
        let most = REACH_M * REACH_M / (REACH_M * REACH_M + height_m * height_m);
        (seen.sum::<f64>() / (COUNT as f64 * most), ways.into_iter().fold(REACH_M, f64::min))
    }

    /// Way to the nearest wall in a direction, at most `reach_m`.
    fn way(&self, from: Vec2, toward: Vec2, reach_m: f64) -> f64 {
        // Light passes over furniture.
        self.space.cast(from, toward, reach_m, |piece, _| piece.is_wall()).map_or(reach_m, |met| met.way_m.max(0.0))
    }

    /// Share of a large lamp at one side that is seen over walls that are `height_m` higher than the place; it falls
    /// `slope` metres per metre.
    fn sunlit(&self, p: Vec2, sun: Vec2, height_m: f64, slope: f64, spread: &[[f64; 2]]) -> f64 {
        if self.space.is_open() {
            return 1.0;
        }
        let reach = height_m / slope * 2.0;
        let share = spread.iter().map(|&[x, y]| {
            let way = self.way(p, sun.rotated(vec2(x, y)), reach);
            // The sun's upper and lower rim differ as much as its left and right one.
            let rim = 0.7 * spread[0][1].abs() / SPREAD_7[0][1].abs();
            let over = (way * slope / height_m.max(0.05) - (1.0 - 0.5 * rim)) / rim;
            smoothstep(over)
        });
        share.sum::<f64>() / spread.len() as f64
    }

    /// The panels that a place sees: way to each in the plan, its length, and the panel.
    fn panels_in_sight<'p>(&'p self, panels: &'p Panels, p: Vec2) -> impl Iterator<Item = (Vec2, f64, Panel)> + 'p {
        panels.around(p, REACH_M).filter_map(move |panel| {
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
            LightSources::Above(_) | LightSources::Outside(_) => Vec::new(),
        };
        let day = match &self.sources {
            LightSources::Inside(_) => self.daylight_on_wall(foot, normal),
            LightSources::Above(_) | LightSources::Outside(_) => [0.0; 2],
        };
        WallLight { light: self, foot, normal, ways, seen, day }
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
    /// Daylight at both [`WALL_HEIGHTS`].
    day: [f64; 2],
}

impl WallLight<'_> {
    /// Light at a height, metres.
    pub fn at(&self, z: f64) -> Irradiance {
        let even = self.even(z);
        match self.light.sources {
            LightSources::Inside(_) => {
                Irradiance { full: even.full * wall_edges(z as f32, self.light.space.height_m as f32), ..even }
            }
            LightSources::Above(_) | LightSources::Outside(_) => even,
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
                let day = self.day[0]
                    + (self.day[1] - self.day[0])
                        * ((z / height_m - WALL_HEIGHTS[0]) / (WALL_HEIGHTS[1] - WALL_HEIGHTS[0])).clamp(0.0, 1.0);
                let bounced = BOUNCE[1] * (1.15 - 0.25 * z / height_m) * (0.25 + 0.75 * open);
                self.light.gain * (LAMPS * direct / Panels::FULL + bounced + day)
            }
            LightSources::Above(sun) => {
                let sky = self.ways.iter().map(|(sine, way)| sine * way * way / (way * way + above * above));
                let facing = self.normal.dot(*sun).max(0.0);
                let above = above.max(0.05);
                let lit = if facing > 0.0 {
                    facing * self.light.sunlit(self.foot, *sun, above, LAMP_SLOPE, &SPREAD_7)
                } else {
                    0.0
                };
                0.20 + 0.30 * sky.sum::<f64>() / weight + 0.55 * lit
            }
            LightSources::Outside(sun) => {
                let sky = self.ways.iter().map(|(sine, way)| sine * way * way / (way * way + above * above));
                let facing = self.normal.dot(*sun).max(0.0);
                let above = above.max(0.05);
                let lit = if facing > 0.0 {
                    facing * self.light.sunlit(self.foot, *sun, above, SUN_SLOPE, &SUN_DISC)
                } else {
                    0.0
                };
                // A sunlit floor throws light onto walls, most onto their feet.
                let thrown = OUTDOORS[0] + 0.07 * (1.0 - z / height_m.max(0.1));
                thrown + OUTDOORS[1] * sky.sum::<f64>() / weight + 1.1 * OUTDOORS[2] * lit
            }
        };
        Irradiance::new(full as f32, open as f32)
    }

    /// Light of a panel by its area, `below` metres under the ceiling.
    fn of_panel(&self, way: Vec2, below: f64) -> f64 {
        let height_m = self.light.space.height_m;
        let facing = way.dot(self.normal).max(0.0);
        // A panel is no point: close to it light does not grow beyond measure.
        let squared = way.length_squared() + below * below + PANEL_WIDE_M2;
        let fade = 1.0 - smoothstep((way.length() - 4.0) / (REACH_M - 4.0));
        // Louvres keep some of the light below the lamp, so that it falls more steeply than from a bare pane.
        let fall = squared * squared * squared.sqrt().sqrt() / (height_m * height_m.sqrt());
        PANEL_ON_WALL * fade * facing * below * (below + 0.4) / fall
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

/// Cosine and sine of -3 to 3 degrees: the sun through thin haze.
const SUN_DISC: [[f64; 2]; 3] = [
    [0.998_629_534_754_573_8, -0.052_335_956_242_943_8],
    [1.0, 0.0],
    [0.998_629_534_754_573_8, 0.052_335_956_242_943_8],
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
