//! How bright what a ray meets looks from where it comes.

use super::light::{LightMap, Lighting};
use super::panels::{Panels, TILE_M};
use super::skin::{Paint, Skin, along_m};
use super::space::{Piece, Space, What};
use super::trace::{Hit, Surface};
use crate::math::{Vec2, exp_f32, vec2};

/// Linear light, red, green, blue.
pub(super) type Colour = [f32; 3];

/// How bright lamps are.
const LAMP: Colour = [3.3, 3.25, 3.1];
/// Daylight beyond openings.
const DAYLIGHT: Colour = [1.18, 1.22, 1.28];
/// The ceiling's tiles.
const CEILING: Colour = [0.78, 0.775, 0.76];
/// What rooms are cut into, as seen from above.
const TOP: Colour = [0.052, 0.052, 0.058];
/// What the model stands on.
const TABLE: Colour = [0.56, 0.555, 0.54];
/// Plain walls where nothing else is known: lintels, reflections.
const PLAIN: Colour = [0.66, 0.64, 0.60];
/// Share of light that smooth surfaces throw back at a right angle.
const F0: f32 = 0.04;
/// Farthest wall that is looked for in the floor, metres.
const MIRROR_REACH_M: f64 = 90.0;
/// Way to the mirrored ceiling up to which one ray will do, metres.
const NARROW_M: f64 = 4.0;
/// Cosine and sine of the angle to one side, and weight.
const SPREAD_1: [[f64; 3]; 1] = [[1.0, 0.0, 1.0]];
const SPREAD_5: [[f64; 3]; 5] = [
    [0.989_2, -0.146_6, 0.12],
    [0.997_6, -0.069_2, 0.23],
    [1.0, 0.0, 0.30],
    [0.997_6, 0.069_2, 0.23],
    [0.989_2, 0.146_6, 0.12],
];

/// All that a picture is made of.
pub(super) struct Shader<'a> {
    pub space: &'a Space,
    pub light: &'a LightMap<'a>,
    /// Side of a pixel at the distance 1.
    pub pixel: f32,
}

/// What a smooth floor shows.
struct Mirror {
    wall_m: f64,
    ceiling_m: f64,
    /// Height at which the mirrored ray meets the wall, metres.
    wall_z: f64,
    stretch: f64,
    slope: f64,
    /// Share of the rays around it that see daylight.
    daylight: f32,
    ceiling: Vec2,
    toward: Vec2,
}

impl Shader<'_> {
    /// The light of a hit in each skin.
    pub fn shade(&self, hit: &Hit, skins: &[Skin], out: &mut [Colour]) {
        match hit.surface {
            Surface::Floor => self.floor(hit, skins, out),
            Surface::Wall(piece) => self.wall(hit, piece, skins, out),
            other => out.fill(self.plain(hit, other)),
        }
        if hit.beyond_m > 0.0 {
            let clear = exp_f32(-hit.beyond_m / 4.5);
            out.iter_mut().for_each(|colour| *colour = mix(DAYLIGHT, *colour, clear));
        }
    }

    fn floor(&self, hit: &Hit, skins: &[Skin], out: &mut [Colour]) {
        let light = self.light.floor(hit.point[0], hit.point[1]);
        let cosine = hit.toward[2].abs();
        let mirror = match self.light.lighting() {
            Lighting::Inside(panels) => Some((self.mirror(hit), panels)),
            Lighting::Above(_) => None,
        };
        for (skin, out) in skins.iter().zip(out) {
            let paint = skin.floor(hit, self.pixel);
            let fresnel = fresnel(cosine, paint.roughness);
            let shine = match &mirror {
                Some((mirror, panels)) => self.shine(mirror, panels, paint.roughness),
                None => [0.75; 3],
            };
            let gain = fresnel * (0.35 + 0.65 * light.open);
            *out = std::array::from_fn(|c| paint.colour[c] * light.full * (1.0 - fresnel) + shine[c] * gain);
        }
    }

    fn wall(&self, hit: &Hit, number: u32, skins: &[Skin], out: &mut [Colour]) {
        let piece = &self.space.pieces[number as usize];
        let light = self.light.wall(number, along_m(piece, hit), hit.point[2]);
        let normal = piece.normal();
        let cosine = (f64::from(hit.toward[0]) * normal.x + f64::from(hit.toward[1]) * normal.y).abs() as f32;
        for (skin, out) in skins.iter().zip(out) {
            let Paint { colour, roughness } = skin.wall(piece, hit, self.pixel);
            let shine = fresnel(cosine, roughness) * 0.5 * light.open;
            *out = std::array::from_fn(|c| colour[c] * light.full + shine);
        }
    }

    fn plain(&self, hit: &Hit, surface: Surface) -> Colour {
        let [x, y, z] = hit.point;
        match surface {
            Surface::Ceiling => self.ceiling(hit),
            Surface::Lintel(_) => {
                let height = (z / self.space.height_m as f32).clamp(0.0, 1.0);
                scaled(PLAIN, 0.78 - 0.12 * height)
            }
            Surface::Soffit(_) => scaled(PLAIN, 0.5),
            Surface::Top => TOP,
            Surface::Side => scaled(TOP, 0.75),
            Surface::Table => self.table(x, y, hit.way_m),
            Surface::Outside => DAYLIGHT,
            _ => scaled(TABLE, 0.95),
        }
    }

    /// Tiles with fine joints, and the lamps between them.
    fn ceiling(&self, hit: &Hit) -> Colour {
        let Lighting::Inside(panels) = self.light.lighting() else { return CEILING };
        let [x, y, _] = hit.point;
        let p = vec2(f64::from(x), f64::from(y));
        let open = self.light.floor(x, y).open;
        let width = hit.way_m * self.pixel;
        let stretched = width / hit.toward[2].abs().max(0.02);
        let along = hit.toward[0].abs().max(hit.toward[1].abs());
        let joints = joint(x, width + stretched * hit.toward[0].abs() * along)
            + joint(y, width + stretched * hit.toward[1].abs() * along);
        let tile = scaled(CEILING, (0.36 + 0.28 * open) * (1.0 - 0.28 * joints.min(1.0)));
        let blur = [hit.toward[0], hit.toward[1]].map(|c| f64::from(width + stretched * c.abs()) * 0.5);
        let lamp = panels.near(p, [0, 0]).map_or(0.0, |panel| covered(panel.centre - p, panel.half, blur));
        mix(tile, LAMP, lamp as f32)
    }

    fn table(&self, x: f32, y: f32, way_m: f32) -> Colour {
        let p = vec2(f64::from(x), f64::from(y));
        let height = self.space.height_m;
        let near = exp_f32(-(self.beside_block(p) / (1.1 * height)) as f32);
        let shadow = match self.light.lighting() {
            Lighting::Above(sun) => {
                let beside = self.beside_block(p + *sun * (0.8 * height)) / (0.8 * height);
                1.0 - (beside as f32).clamp(0.0, 1.0)
            }
            Lighting::Inside(_) => 0.0,
        };
        let far = exp_f32(-way_m / (40.0 * height as f32));
        let lit = (1.0 - 0.42 * near) * (1.0 - 0.4 * shadow);
        scaled(TABLE, 0.95 + (lit - 0.95) * (0.25 + 0.75 * far).min(1.0))
    }

    /// Distance to the block, metres.
    fn beside_block(&self, p: Vec2) -> f64 {
        let block = self.space.block;
        let x = (block.min.x - p.x).max(p.x - block.max.x).max(0.0);
        let y = (block.min.y - p.y).max(p.y - block.max.y).max(0.0);
        (x * x + y * y).sqrt()
    }

    fn mirror(&self, hit: &Hit) -> Mirror {
        let [x, y, z] = hit.toward.map(f64::from);
        let across = (x * x + y * y).sqrt().max(1e-6);
        let toward = vec2(x, y).normalized().unwrap_or(vec2(1.0, 0.0));
        let slope = (z.abs() / across).max(1e-4);
        let from = vec2(f64::from(hit.point[0]), f64::from(hit.point[1]));
        let ceiling_m = self.space.height_m / slope;
        let reach = (1.6 * ceiling_m + 0.5).min(MIRROR_REACH_M);
        // A rough floor sees some way to both sides; right in front of one's feet that changes nothing.
        let spread: &[[f64; 3]] = if ceiling_m > NARROW_M { &SPREAD_5 } else { &SPREAD_1 };
        let solid = |piece: &Piece, _: f64| !matches!(piece.what, What::Lintel(_));
        let (mut wall_m, mut daylight) = (0.0, 0.0);
        for &[cosine, sine, weight] in spread {
            let met = self.space.cast(from, toward.rotated(vec2(cosine, sine)), reach, solid);
            wall_m += weight * met.map_or(reach, |met| met.way_m.max(0.0));
            let opening = met.is_some_and(|met| self.space.pieces[met.piece].what == What::Opening);
            daylight += if opening { weight as f32 } else { 0.0 };
        }
        Mirror {
            wall_m,
            ceiling_m,
            wall_z: wall_m * slope,
            stretch: (1.0 + slope * slope).sqrt(),
            slope,
            daylight,
            ceiling: from + toward * ceiling_m.min(wall_m),
            toward,
        }
    }

    /// The mirrored room, as blurred as the floor is rough.
    fn shine(&self, mirror: &Mirror, panels: &Panels, roughness: f32) -> Colour {
        // Walter et al. 2007, Microfacet models for refraction: half of the light lies within about this slope.
        let alpha = f64::from(roughness * roughness).max(0.002);
        let height = self.space.height_m;
        let blur_wall = alpha * mirror.wall_m * mirror.stretch + 0.02;
        let over = rise((mirror.wall_z - height) / blur_wall) as f32;
        let share = (mirror.wall_z / height).clamp(0.0, 1.0) as f32;
        let wall = mix(scaled(PLAIN, 0.60 + 0.16 * share), DAYLIGHT, mirror.daylight);
        let distance = mirror.ceiling_m.min(mirror.wall_m) * mirror.stretch;
        // The lobe is cut by the ceiling at a flat angle: long the way that one looks.
        let across = 0.7 * alpha * distance;
        let along = (across * mirror.stretch / mirror.slope).min(6.0);
        let spread = |along_axis: f64, across_axis: f64| {
            ((along * along_axis) * (along * along_axis) + (across * across_axis) * (across * across_axis))
                .sqrt()
                .clamp(0.02, 3.0)
        };
        let blur = [spread(mirror.toward.x, mirror.toward.y), spread(mirror.toward.y, mirror.toward.x)];
        let reach = if blur[0].max(blur[1]) > 0.5 { 2 } else { 1 };
        let mut lamps = 0.0;
        for dy in -reach..=reach {
            for dx in -reach..=reach {
                if let Some(panel) = panels.near(mirror.ceiling, [dx, dy]) {
                    lamps += covered(panel.centre - mirror.ceiling, panel.half, blur);
                }
            }
        }
        let ceiling = mix(scaled(CEILING, 0.6), LAMP, (lamps as f32).min(1.0));
        mix(wall, ceiling, over)
    }
}

/// Share of a rectangle in a blurred look at a place; `blur` are half widths in x and y, metres.
fn covered(away: Vec2, half: Vec2, [x, y]: [f64; 2]) -> f64 {
    let along = |away: f64, half: f64, blur: f64| rise((half - away) / blur) - rise((-half - away) / blur);
    along(away.x, half.x, x.max(1e-4)) * along(away.y, half.y, y.max(1e-4))
}

/// From 0 to 1 between -1.5 and 1.5: close to the integral of a bell of width 0.6.
fn rise(t: f64) -> f64 {
    let t = (t / 3.0 + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Share of a pixel that a joint between tiles takes.
fn joint(at: f32, width: f32) -> f32 {
    const HALF_M: f32 = 0.005;
    let tiles = at / TILE_M as f32;
    let away = (tiles - (tiles + 0.5).floor()).abs() * TILE_M as f32;
    ((HALF_M + 0.5 * width - away) / width.max(1e-5)).clamp(0.0, (2.0 * HALF_M / width.max(1e-5)).min(1.0))
}

/// Share of light that is thrown back (Schlick 1994, Computer Graphics Forum 13(3); rough surfaces as Lagarde 2011).
fn fresnel(cosine: f32, roughness: f32) -> f32 {
    let c = 1.0 - cosine.clamp(0.0, 1.0);
    let c2 = c * c;
    F0 + ((1.0 - roughness).max(F0) - F0) * c2 * c2 * c
}

fn scaled(colour: Colour, by: f32) -> Colour {
    colour.map(|c| c * by)
}

pub(super) fn mix(a: Colour, b: Colour, share: f32) -> Colour {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share)
}
