//! Radiance of a ray's hit toward the camera.

use super::leaf_dirt::LeafPlace;
use super::light_map::LightMap;
use super::sampler::{SampledMaterial, SurfaceSampler, along_m};
use crate::math::srgb::light_of;
use crate::math::{Vec2, exp_f32, vec2};
use crate::show::rooms::{
    CEILING, CEILING_LIGHT, DAYLIGHT, FLOOR_SHINE, Finish, Fittings, HAZE_M, HitSurface, Irradiance, JOINT, LAMP, LOBE,
    LONGEST_STREAK_M, LightSources, LinearRgb, MIRROR_REACH_M, MIRRORED_CEILING_LIGHT, MIRRORED_DAY, MIRRORED_LAMP,
    MIRRORED_WALL, MIRRORED_WALL_LIGHT, Panels, QuadKind, RayGrid, RayHit, SKY_SHINE, SOFFIT, TABLE, TILE_M, TOP,
    WALL_SHINE, ceiling_tint, clouded, day_behind, fitting_light, fresnel, gloss, joint, lobe, mix, noise, rise,
    scaled, sky, tinted, unevenness, wall_tint,
};
use crate::walls::COUNTER_M;

/// Shades the hits of rays.
pub(super) struct Shader<'a> {
    pub space: &'a RayGrid,
    pub light: &'a LightMap<'a>,
    /// Side of a pixel at the distance 1.
    pub pixel: f32,
}

/// Light of a hit toward the camera.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lit {
    /// What it throws back to all sides, and small gloss.
    pub colour: LinearRgb,
    /// What a smooth floor mirrors, and its share.
    pub shine: LinearRgb,
    pub gain: f32,
    /// How far the mirrored room is blurred to either side, pixels.
    pub blur_px: f32,
}

impl Lit {
    fn of(colour: LinearRgb) -> Lit {
        Lit { colour, ..Lit::default() }
    }
}

/// What a smooth floor mirrors at a place.
pub(super) struct Reflection {
    /// Way of the ray to that place, metres.
    way_m: f32,
    mirror: Mirror,
    things: Things,
}

/// Geometry of the reflection in a smooth floor.
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

/// Things in a reflection: their mean colour and way, and which share of it they take.
#[derive(Clone, Copy, Debug, Default)]
struct Things {
    colour: LinearRgb,
    share: f32,
    way_m: f64,
}

/// Up to this height a lintel is mirrored as a door's frame, metres.
const MIRRORED_FRAME_M: f32 = 2.2;
/// Floors that are looked at more steeply mirror too little for things to be seen: sine.
const STEEP: f32 = 0.5;
/// Relative difference of two ways up to which floor mirrors the same.
const SAME_WAY: f32 = 0.02;

/// Where the light of a face of a fitting is found on the floor: a little before its sides.
pub(super) fn lit_at(fittings: &Fittings, hit: &RayHit, number: u32, face: u8) -> [f32; 2] {
    /// Way before a side, metres.
    const BEFORE_M: f64 = 0.3;
    let [x, y, _] = hit.point;
    let corners = &fittings.all[number as usize].footprint;
    let Some(side) = face.checked_sub(2).map(usize::from) else { return [x, y] };
    let along = (corners[(side + 1) % corners.len()] - corners[side % corners.len()]).normalized();
    along.map_or([x, y], |along| [x + (along.y * BEFORE_M) as f32, y - (along.x * BEFORE_M) as f32])
}

impl Shader<'_> {
    /// The light of a hit in each skin. Floor as far away as a neighbour's mirrors what that one did.
    pub fn shade(&self, hit: &RayHit, skins: &[SurfaceSampler], neighbour: &mut Option<Reflection>, out: &mut [Lit]) {
        match hit.surface {
            HitSurface::Floor => self.floor(hit, skins, neighbour, out),
            HitSurface::Wall(piece) => self.wall(hit, piece, skins, out),
            HitSurface::Lintel(piece) => self.lintel(hit, piece, skins, out),
            HitSurface::Furniture => {
                let light = self.light.floor(hit.point[0], hit.point[1]).full * fitting_light([0.0, 0.0, 1.0], 1.0);
                let finish = Finish::of_block(f64::from(hit.point[2]) - 0.01);
                self.even(light, Some(light_of(finish.colour())), skins, out);
            }
            HitSurface::Fitting(number, face) => self.fitting(hit, (number, face), skins, out),
            HitSurface::Soffit(number) => {
                self.even(SOFFIT, self.space.frame_of(number).map(|(_, colour)| colour), skins, out)
            }
            HitSurface::Ceiling => {
                let [tile, lamp] = self.ceiling(hit);
                for (skin, out) in skins.iter().zip(out.iter_mut()) {
                    let tint = ceiling_tint(skin.floor_tint);
                    *out = Lit::of(std::array::from_fn(|c| tile[c] * tint[c] + lamp[c]));
                }
            }
            other => out.fill(Lit::of(self.plain(hit, other))),
        }
        if hit.beyond_m > 0.0 {
            let (haze, to) = match self.light.light.sources {
                LightSources::Outside(_) => (HAZE_M[1], sky(0.0)),
                _ => (HAZE_M[0], DAYLIGHT),
            };
            let clear = exp_f32(-hit.beyond_m / haze);
            for lit in out {
                lit.colour = mix(to, lit.colour, clear);
                lit.gain *= clear;
            }
        }
    }

    fn tinted(&self, full: f32) -> LinearRgb {
        match self.light.light.sources {
            LightSources::Above(_) => [full; 3],
            LightSources::Inside(_) => tinted(full, false),
            LightSources::Outside(_) => tinted(full, true),
        }
    }

    /// A plain surface in a colour, or in that of walls.
    fn even(&self, full: f32, own: Option<LinearRgb>, skins: &[SurfaceSampler], out: &mut [Lit]) {
        let light = self.tinted(full);
        for (skin, out) in skins.iter().zip(out) {
            let colour = own.unwrap_or(skin.plain);
            *out = Lit::of(std::array::from_fn(|c| colour[c] * light[c]));
        }
    }

    fn floor(&self, hit: &RayHit, skins: &[SurfaceSampler], neighbour: &mut Option<Reflection>, out: &mut [Lit]) {
        let light = self.light.floor(hit.point[0], hit.point[1]);
        let p = vec2(f64::from(hit.point[0]), f64::from(hit.point[1]));
        let shade = light.shade * self.space.fittings.beside_feet(self.space.shades_at(p), p) as f32;
        let tinted = self.tinted(light.full * shade);
        let cosine = hit.toward[2].abs();
        let sources = &self.light.light.sources;
        let is_same = |near: &Reflection| (near.way_m - hit.way_m).abs() < SAME_WAY * hit.way_m;
        if !neighbour.as_ref().is_some_and(is_same) {
            *neighbour = (!matches!(sources, LightSources::Above(_))).then(|| self.reflection(hit));
        }
        for (skin, out) in skins.iter().zip(out) {
            let paint = skin.floor(hit, self.pixel);
            let fresnel = fresnel(cosine, paint.roughness);
            let gain =
                fresnel * gloss(paint.roughness) * (FLOOR_SHINE[0] + FLOOR_SHINE[1] * light.open) * (0.4 + 0.6 * shade);
            let colour = std::array::from_fn(|c| paint.colour[c] * tinted[c] * (1.0 - fresnel));
            *out = match neighbour {
                None => Lit::of(colour.map(|value| value + SKY_SHINE * gain)),
                Some(Reflection { mirror, things, .. }) => {
                    let wall_m = mirror.wall_m + (things.way_m - mirror.wall_m) * f64::from(things.share);
                    let away = wall_m * mirror.stretch;
                    let blur = lobe(paint.roughness, mirror.slope);
                    let slope = blur[0] * away / (f64::from(hit.way_m) + away).max(0.1);
                    let room = self.shine(mirror, self.light.light.panels(), blur);
                    let shine = mix(room, things.colour, things.share);
                    Lit { colour, shine, gain, blur_px: slope as f32 / self.pixel }
                }
            };
        }
    }

    /// Wall over a door, with the frame at its foot.
    fn lintel(&self, hit: &RayHit, piece: u32, skins: &[SurfaceSampler], out: &mut [Lit]) {
        let full = self.wall_light(hit, piece).full;
        self.even(full, None, skins, out);
        for (skin, out) in skins.iter().zip(out.iter_mut()) {
            let bounced = self.wall_tint(hit, skin);
            out.colour = std::array::from_fn(|c| out.colour[c] * bounced[c]);
        }
        let QuadKind::Lintel(number) = self.space.pieces[piece as usize].what else { return };
        let Some((top_m, frame)) = self.space.frame_of(number) else { return };
        // Its upper edge is as soft as a pixel is high.
        let share = ((top_m - hit.point[2]) / (hit.way_m * self.pixel).max(1e-5) + 0.5).clamp(0.0, 1.0);
        let light = self.tinted(full);
        let frame: LinearRgb = std::array::from_fn(|c| frame[c] * light[c]);
        out.iter_mut().for_each(|lit| lit.colour = mix(lit.colour, frame, share));
    }

    /// Furniture, a door leaf, a part of a window.
    fn fitting(&self, hit: &RayHit, (number, face): (u32, u8), skins: &[SurfaceSampler], out: &mut [Lit]) {
        let fitting = &self.space.fittings.all[number as usize];
        if fitting.finish == Finish::Pane {
            return out.fill(Lit::of(day_behind(hit.toward)));
        }
        let ([x, y, z], [beside_x, beside_y]) = (hit.point, lit_at(&self.space.fittings, hit, number, face));
        let light = self.light.floor(beside_x, beside_y);
        let corners = &fitting.footprint;
        let edge = |k: usize| (corners[(k + 1) % corners.len()] - corners[k % corners.len()]).normalized();
        let (normal, lengthwise) = match face.checked_sub(2) {
            None => ([0.0, 0.0, if face == 0 { 1.0 } else { -1.0 }], edge(0)),
            Some(side) => {
                let along = edge(usize::from(side)).unwrap_or(vec2(1.0, 0.0));
                ([along.y as f32, -along.x as f32, 0.0], Some(along))
            }
        };
        // What is low stands in the shade of boards over it.
        let shade = light.shade + (1.0 - light.shade) * (z / 0.7).clamp(0.0, 1.0);
        let full = light.full * shade * fitting_light(normal, z);
        let along = lengthwise.unwrap_or(vec2(1.0, 0.0));
        let p = vec2(f64::from(x), f64::from(y)) - corners[0];
        let (u, v) = (p.dot(along) as f32, if face < 2 { along.cross(p) as f32 } else { z });
        // Grain runs along boards, and upward on doors and sides.
        let (fine, coarse) = if fitting.finish == Finish::Door {
            ([u * 90.0, v * 2.2], [u * 14.0, v * 0.7])
        } else {
            ([v * 110.0, u * 3.0], [v * 16.0, u * 0.8])
        };
        let fades = (1.0 - hit.way_m * self.pixel * 60.0).clamp(0.0, 1.0);
        let seed = number as f32 * 7.31;
        let grain = 0.5 * fades * noise(fine[0] + seed, fine[1]) + 0.5 * noise(coarse[0] + seed, coarse[1] + seed);
        let tone = 1.0 + fitting.finish.grain() * grain;
        let colour = scaled(light_of(fitting.finish.colour()), tone);
        let [a, b, c] = hit.toward;
        let cosine = (a * normal[0] + b * normal[1] + c * normal[2]).abs();
        let shine = fresnel(cosine, fitting.finish.roughness()) * WALL_SHINE * light.open * light.full * shade;
        let tinted = self.tinted(full);
        // Only the two faces of a leaf are soiled: the one with the hinge is pushed.
        let soiled = fitting.leaf.as_ref().filter(|_| matches!(face, 2 | 4)).map(|leaf| {
            let from_hinge = vec2(f64::from(x), f64::from(y)) - leaf.hinge;
            let along_m = from_hinge.dot(along).abs() as f32;
            LeafPlace { leaf, pushed: from_hinge.cross(along).abs() < 0.01, along_m, height_m: z, seed: number as f32 }
        });
        for (skin, out) in skins.iter().zip(out) {
            let stains = skin.leaf_stains.as_ref().zip(soiled.as_ref());
            let colour = stains.map_or(colour, |(stains, place)| place.soiled(colour, stains));
            *out = Lit::of(std::array::from_fn(|c| colour[c] * tinted[c] + shine));
        }
    }

    fn wall(&self, hit: &RayHit, number: u32, skins: &[SurfaceSampler], out: &mut [Lit]) {
        let piece = &self.space.pieces[number as usize];
        let light = self.wall_light(hit, number);
        let tinted = self.tinted(light.full);
        let normal = piece.normal();
        let cosine = (f64::from(hit.toward[0]) * normal.x + f64::from(hit.toward[1]) * normal.y).abs() as f32;
        // The sides of furniture that is drawn as a block have its colour, under the dirt of walls.
        let block =
            Some(piece.height_m).filter(|top_m| *top_m < COUNTER_M).map(|m| light_of(Finish::of_block(m).colour()));
        for (skin, out) in skins.iter().zip(out) {
            let SampledMaterial { mut colour, roughness } = skin.wall(piece, hit, self.pixel);
            if let Some(block) = block {
                colour = std::array::from_fn(|c| block[c] * (colour[c] / skin.plain[c].max(0.01)).min(1.0));
            }
            let shine = fresnel(cosine, roughness) * WALL_SHINE * light.open * light.full;
            let bounced = self.wall_tint(hit, skin);
            *out = Lit::of(std::array::from_fn(|c| colour[c] * tinted[c] * bounced[c] + shine));
        }
    }

    /// Tint of the light on a wall: of what the floor throws back.
    fn wall_tint(&self, hit: &RayHit, skin: &SurfaceSampler) -> LinearRgb {
        match self.light.light.sources {
            LightSources::Above(_) => [1.0; 3],
            _ => wall_tint(skin.floor_tint, hit.point[2] / self.space.height_m as f32),
        }
    }

    fn wall_light(&self, hit: &RayHit, piece: u32) -> Irradiance {
        self.light.wall(piece, along_m(&self.space.pieces[piece as usize], hit), hit.point[2])
    }

    fn plain(&self, hit: &RayHit, surface: HitSurface) -> LinearRgb {
        let [x, y, _] = hit.point;
        match surface {
            HitSurface::Top => TOP,
            HitSurface::Side => scaled(TOP, 0.75),
            HitSurface::Table => self.table(x, y, hit.way_m),
            HitSurface::Outside if self.space.roofed => DAYLIGHT,
            HitSurface::Outside => sky(0.0),
            HitSurface::Sky if !matches!(self.light.light.sources, LightSources::Above(_)) => clouded(hit.toward),
            _ => TABLE,
        }
    }

    /// Tiles with fine joints, under white light from the floor, and the lamps between them.
    fn ceiling(&self, hit: &RayHit) -> [LinearRgb; 2] {
        let LightSources::Inside(panels) = &self.light.light.sources else { return [CEILING, [0.0; 3]] };
        let [x, y, _] = hit.point;
        let p = vec2(f64::from(x), f64::from(y));
        let Irradiance { full, open, .. } = self.light.floor(x, y);
        let width = hit.way_m * self.pixel;
        let stretched = width / hit.toward[2].abs().max(0.02);
        let along = hit.toward[0].abs().max(hit.toward[1].abs());
        let joints = joint(x, width + stretched * hit.toward[0].abs() * along)
            + joint(y, width + stretched * hit.toward[1].abs() * along);
        // No two tiles are quite alike, and their fibres cast small shadows.
        let number = [x, y].map(|m| (m / TILE_M as f32).floor() as i32);
        let fibres = (1.0 - width * 90.0).clamp(0.0, 1.0) * 0.05 * noise(x * 130.0, y * 130.0).min(0.2);
        let tone = (1.0 + 0.022 * unevenness(number[0], number[1]) + fibres) * (1.0 - JOINT * joints.min(1.0));
        let tile = scaled(CEILING, (CEILING_LIGHT[0] * open + CEILING_LIGHT[1] * full) * tone);
        let blur = [hit.toward[0], hit.toward[1]].map(|c| f64::from(width + stretched * c.abs()) * 0.5);
        let Some(panel) = panels.near(p, [0, 0]) else { return [tile, [0.0; 3]] };
        let away = panel.centre - p;
        let rim = vec2(0.03, 0.03);
        let seen = |half: Vec2| (covered(away.x, half.x, blur[0]) * covered(away.y, half.y, blur[1])) as f32;
        let (frame, lamp) = (seen(panel.half + rim), seen(panel.half));
        // Two tubes behind the pane.
        let across = if panel.half.x < panel.half.y { away.x / panel.half.x } else { away.y / panel.half.y };
        let tubes = 1.0 - 0.45 * ((across.abs() - 0.45).abs() as f32 / 0.55).min(1.0);
        [scaled(tile, (1.0 - 0.38 * frame) * (1.0 - lamp)), scaled(LAMP, tubes * lamp)]
    }

    fn table(&self, x: f32, y: f32, way_m: f32) -> LinearRgb {
        let p = vec2(f64::from(x), f64::from(y));
        // A floor without walls lies flat, and the table under it goes on to the horizon.
        if self.space.is_open() {
            return TABLE;
        }
        let height = self.space.height_m;
        let near = exp_f32(-(self.beside_block(p) / (1.1 * height)) as f32);
        let shadow = match &self.light.light.sources {
            LightSources::Above(sun) => {
                let beside = self.beside_block(p + *sun * (0.8 * height)) / (0.8 * height);
                1.0 - (beside as f32).clamp(0.0, 1.0)
            }
            LightSources::Inside(_) | LightSources::Outside(_) => 0.0,
        };
        let far = exp_f32(-way_m / (40.0 * height as f32));
        let lit = (1.0 - 0.42 * near) * (1.0 - 0.4 * shadow) / 0.95;
        scaled(TABLE, 1.0 + (lit - 1.0) * (0.25 + 0.75 * far).min(1.0))
    }

    /// Distance to the block, metres.
    fn beside_block(&self, p: Vec2) -> f64 {
        let block = self.space.block;
        let x = (block.min.x - p.x).max(p.x - block.max.x).max(0.0);
        let y = (block.min.y - p.y).max(p.y - block.max.y).max(0.0);
        (x * x + y * y).sqrt()
    }

    fn reflection(&self, hit: &RayHit) -> Reflection {
        let mirror = self.mirror(hit);
        Reflection { way_m: hit.way_m, things: self.mirrored_things(hit, &mirror), mirror }
    }

    fn mirror(&self, hit: &RayHit) -> Mirror {
        let [x, y, z] = hit.toward.map(f64::from);
        let across = (x * x + y * y).sqrt().max(1e-6);
        let toward = vec2(x, y).normalized().unwrap_or(vec2(1.0, 0.0));
        let slope = (z.abs() / across).max(1e-4);
        let from = vec2(f64::from(hit.point[0]), f64::from(hit.point[1]));
        let ceiling_m = self.space.height_m / slope;
        let reach = (1.6 * ceiling_m + 0.5).min(f64::from(MIRROR_REACH_M));
        let wall_m = self
            .space
            .cast(from, toward, reach, |piece, _| piece.bounds_room())
            .map_or(reach, |met| met.way_m.max(0.0));
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

    /// What stands in the reflection of a floor, but for walls: doors, furniture, windows.
    fn mirrored_things(&self, hit: &RayHit, mirror: &Mirror) -> Things {
        /// Looks at different heights of the lobe, as shares of a usual floor's.
        const LOOKS: [f64; 3] = [-0.75, 0.0, 0.75];
        let mut things = Things::default();
        if hit.toward[2].abs() > STEEP {
            return things;
        }
        let [x, y, _] = hit.point.map(f64::from);
        for look in LOOKS {
            let slope = (mirror.slope + look * f64::from(LOBE) * mirror.slope.max(0.12)).max(0.004);
            let met = self.space.trace_inside([x, y, 0.001], [mirror.toward.x, mirror.toward.y, slope]);
            let Some(colour) = self.mirrored_thing(&met).filter(|_| met.way_m < MIRROR_REACH_M) else { continue };
            things.colour = std::array::from_fn(|c| things.colour[c] + colour[c]);
            things.share += 1.0;
            things.way_m += f64::from(met.way_m) / mirror.stretch;
        }
        if things.share > 0.0 {
            things.colour = scaled(things.colour, 1.0 / things.share);
            things.way_m /= f64::from(things.share);
            things.share /= LOOKS.len() as f32;
        }
        things
    }

    fn mirrored_thing(&self, met: &RayHit) -> Option<LinearRgb> {
        let [x, y, z] = met.toward;
        match met.surface {
            HitSurface::Fitting(number, _) => Some(match self.space.fittings.all[number as usize].finish {
                Finish::Pane => scaled(day_behind([x, y, z]), MIRRORED_DAY),
                finish => scaled(light_of(finish.colour()), MIRRORED_WALL_LIGHT[0]),
            }),
            HitSurface::Lintel(_) | HitSurface::Soffit(_) => {
                let frame = self.space.frame.map(|(_, colour)| light_of(colour));
                frame.filter(|_| met.point[2] < MIRRORED_FRAME_M).map(|frame| scaled(frame, MIRRORED_WALL_LIGHT[0]))
            }
            HitSurface::Wall(piece) if self.space.pieces[piece as usize].height_m.is_finite() => {
                Some(scaled(MIRRORED_WALL, MIRRORED_WALL_LIGHT[0]))
            }
            _ => None,
        }
    }

    /// Share of daylight in a rough floor's reflection around a direction: each opening as a bright rectangle
    /// that is blurred to both sides and upward.
    fn daylight(&self, from: Vec2, toward: Vec2, slope: f64) -> f32 {
        let mut sum = 0.0;
        for &[a, b] in &self.space.openings {
            let [a, b] = [a - from, b - from].map(|way| vec2(way.dot(toward), toward.cross(way)));
            // Openings beside or behind are outside the lobe.
            if a.x < 0.3 || b.x < 0.3 {
                continue;
            }
            let (left, right) = if a.y * b.x < b.y * a.x { (a, b) } else { (b, a) };
            let lobe = f64::from(LOBE);
            let across = rise(right.y / right.x / lobe) - rise(left.y / left.x / lobe);
            if across < 0.01 {
                continue;
            }
            // Only the part within the lobe matters.
            let at = |t: f64| left + (right - left) * t;
            let share_at = |side: f64| {
                let wanted = side * lobe;
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
            let blur = 0.5 * self.space.height_m + lobe * distance;
            let below = 1.0 - rise((distance * slope - self.space.height_m) / blur);
            sum += across * below * seen.count() as f64 / 4.0;
        }
        sum.min(1.0) as f32
    }

    /// True if no wall stands between a place and the end of a way from it.
    fn sees(&self, from: Vec2, way: Vec2) -> bool {
        let distance = way.length();
        self.space.cast(from, way / distance.max(1e-9), distance - 0.02, |piece, _| piece.is_wall()).is_none()
    }

    /// The mirrored room, blurred by the slopes of a floor's [`lobe`].
    fn shine(&self, mirror: &Mirror, panels: Option<&Panels>, [aside, upward]: [f64; 2]) -> LinearRgb {
        let height = self.space.height_m;
        let blur_wall = upward * mirror.wall_m * mirror.stretch + 0.02;
        let over = rise((mirror.wall_z - height) / blur_wall) as f32;
        let share = (mirror.wall_z / height).clamp(0.0, 1.0) as f32;
        let wall = scaled(MIRRORED_WALL, MIRRORED_WALL_LIGHT[0] + MIRRORED_WALL_LIGHT[1] * share);
        let Some(panels) = panels else {
            return mix(wall, sky((mirror.slope / mirror.stretch) as f32), over);
        };
        let distance = mirror.ceiling_m.min(mirror.wall_m) * mirror.stretch;
        // The lobe is cut by the ceiling at a flat angle: long the way that one looks.
        let across = (aside * distance).max(0.02);
        let along = (upward * distance * mirror.stretch / mirror.slope).min(f64::from(LONGEST_STREAK_M));
        let lamps = panels.around(mirror.ceiling, 1.5 * along + TILE_M).map(|panel| {
            let (away, half) = (panel.centre - mirror.ceiling, panel.half);
            // The panel's box along the ray and across it, of the same area.
            let [x, y] = [mirror.toward.x.abs(), mirror.toward.y.abs()];
            let [long, wide] = [half.x * x + half.y * y, half.x * y + half.y * x];
            let share = half.x * half.y / (long * wide);
            let away = [mirror.toward.dot(away), mirror.toward.cross(away)];
            share * covered(away[0], long, along) * covered(away[1], wide, across)
        });
        let ceiling = mix(scaled(CEILING, MIRRORED_CEILING_LIGHT), MIRRORED_LAMP, (lamps.sum::<f64>() as f32).min(1.0));
        mix(mix(wall, ceiling, over), scaled(DAYLIGHT, MIRRORED_DAY), mirror.daylight)
    }
}

/// Share of a stretch, `half` to either side of a place `away`, in a look that is blurred over `blur`, metres.
fn covered(away: f64, half: f64, blur: f64) -> f64 {
    let blur = blur.max(1e-4);
    rise((half - away) / blur) - rise((-half - away) / blur)
}
