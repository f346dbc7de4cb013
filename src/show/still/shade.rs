//! Radiance of a ray's hit toward the camera.

use super::light::{LightMap, Lighting};
use super::panels::{Panels, TILE_M};
use super::ray_grid::{QuadKind, RayGrid, WallQuad};
use super::sampler::{SampledMaterial, SurfaceSampler, along_m};
use super::trace::{HitSurface, RayHit};
use crate::math::{Vec2, exp_f32, vec2};

/// Linear light, red, green, blue.
pub(super) type LinearRgb = [f32; 3];

/// Radiance of lamps.
const LAMP: LinearRgb = [3.3, 3.25, 3.1];
/// Daylight beyond openings.
const DAYLIGHT: LinearRgb = [1.18, 1.22, 1.28];
/// The ceiling's tiles.
const CEILING: LinearRgb = [0.78, 0.775, 0.76];
/// What rooms are cut into, as seen from above.
const TOP: LinearRgb = [0.052, 0.052, 0.058];
/// What the model stands on.
const TABLE: LinearRgb = [0.56, 0.555, 0.54];
/// Walls as floors mirror them.
const PLAIN: LinearRgb = [0.66, 0.64, 0.60];
/// Share of light that smooth surfaces throw back at a right angle.
const F0: f32 = 0.04;
/// Farthest wall that is looked for in the floor, metres.
const MIRROR_REACH_M: f64 = 90.0;
/// Half of what a usual floor mirrors comes from within this slope to either side.
const LOBE: f64 = 0.11;

/// Shades the hits of rays.
pub(super) struct Shader<'a> {
    pub space: &'a RayGrid,
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
    /// Share of daylight in it, 0 to 1.
    daylight: f32,
    ceiling: Vec2,
    toward: Vec2,
}

impl Shader<'_> {
    /// The light of a hit in each skin.
    pub fn shade(&self, hit: &RayHit, skins: &[SurfaceSampler], out: &mut [LinearRgb]) {
        match hit.surface {
            HitSurface::Floor => self.floor(hit, skins, out),
            HitSurface::Wall(piece) => self.wall(hit, piece, skins, out),
            HitSurface::Lintel(_) | HitSurface::Soffit(_) => self.lintel(hit, skins, out),
            other => out.fill(self.plain(hit, other)),
        }
        if hit.beyond_m > 0.0 {
            let clear = exp_f32(-hit.beyond_m / 4.5);
            out.iter_mut().for_each(|colour| *colour = mix(DAYLIGHT, *colour, clear));
        }
    }

    fn floor(&self, hit: &RayHit, skins: &[SurfaceSampler], out: &mut [LinearRgb]) {
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

    fn wall(&self, hit: &RayHit, number: u32, skins: &[SurfaceSampler], out: &mut [LinearRgb]) {
        let piece = &self.space.pieces[number as usize];
        let light = self.light.wall(number, along_m(piece, hit), hit.point[2]);
        let normal = piece.normal();
        let cosine = (f64::from(hit.toward[0]) * normal.x + f64::from(hit.toward[1]) * normal.y).abs() as f32;
        for (skin, out) in skins.iter().zip(out) {
            let SampledMaterial { colour, roughness } = skin.wall(piece, hit, self.pixel);
            let shine = fresnel(cosine, roughness) * 0.5 * light.open;
            *out = std::array::from_fn(|c| colour[c] * light.full + shine);
        }
    }

    /// The clean wall over a door.
    fn lintel(&self, hit: &RayHit, skins: &[SurfaceSampler], out: &mut [LinearRgb]) {
        let height = (hit.point[2] / self.space.height_m as f32).clamp(0.0, 1.0);
        let light = if matches!(hit.surface, HitSurface::Soffit(_)) { 0.5 } else { 0.84 - 0.14 * height };
        for (skin, out) in skins.iter().zip(out) {
            *out = scaled(skin.plain, light);
        }
    }

    fn plain(&self, hit: &RayHit, surface: HitSurface) -> LinearRgb {
        let [x, y, _] = hit.point;
        match surface {
            HitSurface::Ceiling => self.ceiling(hit),
            HitSurface::Top => TOP,
            HitSurface::Side => scaled(TOP, 0.75),
            HitSurface::Table => self.table(x, y, hit.way_m),
            HitSurface::Outside => DAYLIGHT,
            _ => scaled(TABLE, 0.95),
        }
    }

    /// Tiles with fine joints, and the lamps between them.
    fn ceiling(&self, hit: &RayHit) -> LinearRgb {
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

    fn table(&self, x: f32, y: f32, way_m: f32) -> LinearRgb {
        let p = vec2(f64::from(x), f64::from(y));
        // A floor without walls lies flat, and the table under it goes on to the horizon.
        if self.space.is_open() {
            return scaled(TABLE, 0.95);
        }
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

    fn mirror(&self, hit: &RayHit) -> Mirror {
        let [x, y, z] = hit.toward.map(f64::from);
        let across = (x * x + y * y).sqrt().max(1e-6);
        let toward = vec2(x, y).normalized().unwrap_or(vec2(1.0, 0.0));
        let slope = (z.abs() / across).max(1e-4);
        let from = vec2(f64::from(hit.point[0]), f64::from(hit.point[1]));
        let ceiling_m = self.space.height_m / slope;
        let reach = (1.6 * ceiling_m + 0.5).min(MIRROR_REACH_M);
        let solid = |piece: &WallQuad, _: f64| !matches!(piece.what, QuadKind::Lintel(_));
        let wall_m = self.space.cast(from, toward, reach, solid).map_or(reach, |met| met.way_m.max(0.0));
        Mirror {
            wall_m,
            ceiling_m,
            wall_z: wall_m * slope,
            stretch: (1.0 + slope * slope).sqrt(),
            slope,
            daylight: self.daylight(from, toward, slope),
            ceiling: from + toward * ceiling_m.min(wall_m),
            toward,
        }
    }

    /// Share of what a rough floor mirrors from around a direction that is daylight: each opening as a bright rectangle
    /// that is blurred to both sides and upward.
    fn daylight(&self, from: Vec2, toward: Vec2, slope: f64) -> f32 {
        let mut sum = 0.0;
        for &[a, b] in &self.space.openings {
            let [a, b] = [a - from, b - from].map(|way| vec2(way.dot(toward), toward.cross(way)));
            // What lies beside or behind is not in the lobe.
            if a.x < 0.3 || b.x < 0.3 {
                continue;
            }
            let (left, right) = if a.y * b.x < b.y * a.x { (a, b) } else { (b, a) };
            let across = rise(right.y / right.x / LOBE) - rise(left.y / left.x / LOBE);
            if across < 0.01 {
                continue;
            }
            // The part that matters: what of it is within the lobe.
            let at = |t: f64| left + (right - left) * t;
            let share_at = |side: f64| {
                let wanted = side * LOBE;
                let along = right - left;
                let t = (wanted * left.x - left.y) / (along.y - wanted * along.x);
                if t.is_finite() { t.clamp(0.02, 0.98) } else { 0.5 }
            };
            let ends = [share_at(-1.0), share_at(1.0)];
            let seen = [0.05, 0.35, 0.65, 0.95].into_iter().filter(|k| {
                let place = at(ends[0] + (ends[1] - ends[0]) * k);
                let way = toward * place.x + toward.left() * place.y;
                self.sees(from, way)
            });
            let distance = at(0.5 * (ends[0] + ends[1])).length();
            let blur = 0.5 * self.space.height_m + LOBE * distance;
            let below = 1.0 - rise((distance * slope - self.space.height_m) / blur);
            sum += across * below * seen.count() as f64 / 4.0;
        }
        sum.min(1.0) as f32
    }

    /// Whether nothing stands between a place and where a way from it leads.
    fn sees(&self, from: Vec2, way: Vec2) -> bool {
        let distance = way.length();
        let walls = |piece: &WallQuad, _: f64| matches!(piece.what, QuadKind::Wall(_));
        self.space.cast(from, way / distance.max(1e-9), distance - 0.02, walls).is_none()
    }

    /// The mirrored room, as blurred as the floor is rough.
    fn shine(&self, mirror: &Mirror, panels: &Panels, roughness: f32) -> LinearRgb {
        // Walter et al. 2007, Microfacet models for refraction: half of the light lies within about this slope.
        let alpha = f64::from(roughness * roughness).max(0.002);
        let height = self.space.height_m;
        let blur_wall = alpha * mirror.wall_m * mirror.stretch + 0.02;
        let over = rise((mirror.wall_z - height) / blur_wall) as f32;
        let share = (mirror.wall_z / height).clamp(0.0, 1.0) as f32;
        let wall = scaled(PLAIN, 0.60 + 0.16 * share);
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
        mix(mix(wall, ceiling, over), DAYLIGHT, mirror.daylight)
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

fn scaled(colour: LinearRgb, by: f32) -> LinearRgb {
    colour.map(|c| c * by)
}

pub(super) fn mix(a: LinearRgb, b: LinearRgb, share: f32) -> LinearRgb {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share)
}
