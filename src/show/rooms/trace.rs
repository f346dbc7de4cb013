//! Which surface a ray from the camera meets.

use super::ray_grid::{Crossing, QuadKind, RayGrid, WallQuad};
use crate::math::{Vec2, vec2};

/// Distance beyond an opening at which daylight hides everything, metres: in rooms, and outdoors.
const OUTSIDE_M: [f64; 2] = [14.0, 150.0];
/// Widest fitting that a ray may come down onto from above, metres.
const WIDEST_FITTING_M: f64 = 6.0;

/// The surface that a ray hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HitSurface {
    Floor,
    Ceiling,
    /// Place in [`RayGrid::pieces`].
    Wall(u32),
    Lintel(u32),
    /// The top of furniture that is a block.
    Furniture,
    /// A prism: place in the list of fittings, and which face of it: 0 the top, 1 the underside, 2 + n the side n.
    Fitting(u32, u8),
    /// The underside of a lintel.
    Soffit(u32),
    /// The top of the block that the rooms are cut into, as seen from above.
    Top,
    /// The block's outer side.
    Side,
    /// The table under the block.
    Table,
    /// Light, far beyond an opening.
    Outside,
    Sky,
}

/// The hit of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayHit {
    pub surface: HitSurface,
    /// x, y in the plan frame and height, metres. Beyond openings the plan goes on as its mirror image.
    pub point: [f32; 3],
    /// Unit vector of the ray as it ends.
    pub toward: [f32; 3],
    /// Way from the camera, metres.
    pub way_m: f32,
    /// Part of it that lies beyond an opening, metres.
    pub beyond_m: f32,
}

/// A ray as its shadow on the floor and its height.
#[derive(Clone, Copy, Debug)]
struct Ray {
    from: Vec2,
    z: f64,
    /// Unit vector.
    toward: Vec2,
    /// Metres upward per metre of the shadow.
    slope: f64,
    /// Metres of the ray per metre of the shadow.
    stretch: f64,
    /// Metres of the shadow before `from`, and how many of them are beyond an opening.
    before: f64,
    beyond: f64,
}

impl Ray {
    fn new(position: [f64; 3], way: [f64; 3]) -> Ray {
        // A ray straight down has a shadow too, if a short one.
        let across = (way[0] * way[0] + way[1] * way[1]).sqrt().max(1e-9);
        let toward = vec2(way[0], way[1]).normalized().unwrap_or(vec2(1.0, 0.0));
        Ray {
            from: vec2(position[0], position[1]),
            z: position[2],
            toward,
            slope: way[2] / across,
            stretch: (1.0 + way[2] * way[2] / (across * across)).sqrt(),
            before: 0.0,
            beyond: 0.0,
        }
    }

    fn at(&self, way: f64) -> Vec2 {
        self.from + self.toward * way
    }

    fn height(&self, way: f64) -> f64 {
        self.z + self.slope * way
    }

    /// Which face of a prism is met at `way`, if its shadow entered through a side.
    fn face(&self, piece: &WallQuad, number: u32, side: u8, way: f64) -> HitSurface {
        let level = if self.slope < 0.0 { 0 } else { 1 };
        HitSurface::Fitting(number, if piece.is_on(self.at(way)) { side.saturating_add(2) } else { level })
    }

    fn hit(&self, surface: HitSurface, way: f64) -> RayHit {
        let p = self.at(way);
        let scale = 1.0 / self.stretch;
        let beyond = if self.beyond > 0.0 { self.beyond + way } else { 0.0 };
        RayHit {
            surface,
            point: [p.x as f32, p.y as f32, self.height(way) as f32],
            toward: [self.toward.x * scale, self.toward.y * scale, self.slope * scale].map(|c| c as f32),
            way_m: ((self.before + way) * self.stretch) as f32,
            beyond_m: (beyond * self.stretch) as f32,
        }
    }
}

impl RayGrid {
    /// The first hit of a ray from within the rooms, below the ceiling.
    pub fn trace_inside(&self, position: [f64; 3], way: [f64; 3]) -> RayHit {
        let mut ray = Ray::new(position, way);
        loop {
            let (level, end) = if ray.slope < 0.0 {
                (HitSurface::Floor, -ray.z / ray.slope)
            } else if ray.slope > 0.0 {
                (if self.roofed { HitSurface::Ceiling } else { HitSurface::Sky }, (self.height_m - ray.z) / ray.slope)
            } else {
                (HitSurface::Outside, 1e6)
            };
            let end = end.clamp(0.0, 1e6);
            let meets = |piece: &WallQuad, way: f64| match piece.what {
                QuadKind::Lintel(number) => self.under_lintel(&ray, number, way),
                QuadKind::Fitting(number, _) => self.on_fitting(&ray, number, way),
                _ => (ray.height(way) < piece.height_m).then_some(way),
            };
            let met = self.nearest(ray.from, ray.toward, end, meets);
            let limit_m = met.map_or(end, |met| met.way_m);
            if let Some(way) = self.top_on_the_way([ray.z, ray.slope], |way| ray.at(way), limit_m) {
                return ray.hit(HitSurface::Furniture, way);
            }
            let Some(met) = met else { return ray.hit(level, end) };
            let piece = &self.pieces[met.piece];
            match piece.what {
                QuadKind::Wall(_) => return ray.hit(HitSurface::Wall(met.piece as u32), met.way_m),
                QuadKind::Lintel(number) => {
                    let face = piece.is_on(ray.at(met.way_m));
                    let surface = if face { HitSurface::Lintel(met.piece as u32) } else { HitSurface::Soffit(number) };
                    return ray.hit(surface, met.way_m);
                }
                QuadKind::Fitting(number, side) => {
                    return ray.hit(ray.face(piece, number, side, met.way_m), met.way_m);
                }
                QuadKind::Opening => {
                    let walked = met.way_m.max(0.0);
                    let beyond = if ray.beyond > 0.0 { ray.beyond + walked } else { 1e-6 };
                    if beyond > OUTSIDE_M[usize::from(!self.roofed)] {
                        return ray.hit(HitSurface::Outside, walked);
                    }
                    let normal = piece.normal();
                    let toward = ray.toward - normal * (2.0 * ray.toward.dot(normal));
                    let (from, z, before) = (ray.at(walked), ray.height(walked), ray.before + walked);
                    ray = Ray { from, z, toward, before, beyond, ..ray };
                }
            }
        }
    }

    /// Where a ray that comes to a gap at `way` meets its lintel, if it does: at the face or at the underside.
    fn under_lintel(&self, ray: &Ray, number: u32, way: f64) -> Option<f64> {
        let lintel = &self.lintels[number as usize];
        if ray.height(way) >= lintel.low_m {
            return Some(way);
        }
        let leaves = way + lintel.leaves(ray.at(way), ray.toward);
        (ray.height(leaves) > lintel.low_m).then(|| (lintel.low_m - ray.z) / ray.slope)
    }

    /// Where a ray whose shadow enters a prism's footprint at `way` meets it, if it does.
    fn on_fitting(&self, ray: &Ray, number: u32, way: f64) -> Option<f64> {
        let fitting = &self.fittings.all[number as usize];
        let [low_m, high_m] = fitting.span_m;
        let height_m = ray.height(way);
        if (low_m..=high_m).contains(&height_m) {
            return Some(way);
        }
        let level_m = if height_m > high_m { high_m } else { low_m };
        let there = (level_m - ray.z) / ray.slope;
        if !(there > way && there.is_finite()) {
            return None;
        }
        let p = ray.at(there);
        let edges = fitting.footprint.iter().zip(fitting.footprint.iter().cycle().skip(1));
        let mut all = edges.map(|(&a, &b)| (b - a).cross(p - a) >= 0.0);
        all.all(|inside| inside).then_some(there)
    }

    /// The first hit of a ray from above the walls: rooms without a ceiling, cut into a block on a table.
    pub fn trace_above(&self, position: [f64; 3], way: [f64; 3]) -> RayHit {
        let ray = Ray::new(position, way);
        if ray.slope >= -1e-9 {
            return ray.hit(HitSurface::Sky, 1.0);
        }
        let ground = -ray.z / ray.slope;
        if self.is_open() {
            let surface = if self.is_floor(ray.at(ground)) { HitSurface::Floor } else { HitSurface::Table };
            return ray.hit(surface, ground);
        }
        let top = (self.height_m - ray.z) / ray.slope;
        let Some((enter, leave)) = self.block_span(&ray) else { return ray.hit(HitSurface::Table, ground) };
        let way = top.max(enter);
        if way >= leave || way >= ground {
            return ray.hit(HitSurface::Table, ground);
        }
        // A hair further, so that it lies within the block.
        let inside = ray.at(way + 1e-6);
        if !self.is_room(inside) {
            return ray.hit(if enter > top { HitSurface::Side } else { HitSurface::Top }, way);
        }
        // What the ray is above already when it comes below the walls' tops lies behind that place.
        let before = way - WIDEST_FITTING_M;
        let meets = |piece: &WallQuad, on: f64| match piece.what {
            QuadKind::Lintel(_) => None,
            QuadKind::Fitting(number, _) => self.on_fitting(&ray, number, before + on).map(|there| there - before),
            _ => (on >= WIDEST_FITTING_M && ray.height(before + on) < piece.height_m).then_some(on),
        };
        let from = inside - ray.toward * WIDEST_FITTING_M;
        let met = self.nearest(from, ray.toward, ground - before, meets);
        let met = met.map(|met| Crossing { way_m: met.way_m - WIDEST_FITTING_M, ..met });
        let limit_m = met.map_or(ground, |met| way + met.way_m);
        if let Some(way) = self.top_on_the_way([ray.z, ray.slope], |way| ray.at(way), limit_m) {
            return ray.hit(HitSurface::Furniture, way);
        }
        if let Some((met, piece)) = met.map(|met| (met, &self.pieces[met.piece]))
            && let QuadKind::Fitting(number, side) = piece.what
        {
            let there = way + met.way_m;
            return ray.hit(ray.face(piece, number, side, there), there);
        }
        match met {
            None => ray.hit(HitSurface::Floor, ground),
            Some(met) if self.pieces[met.piece].what == QuadKind::Opening => ray.hit(HitSurface::Table, ground),
            Some(met) => ray.hit(HitSurface::Wall(met.piece as u32), way + met.way_m.max(0.0)),
        }
    }

    /// Between which ways the shadow of a ray crosses the block.
    fn block_span(&self, ray: &Ray) -> Option<(f64, f64)> {
        let span = |from: f64, toward: f64, low: f64, high: f64| {
            if toward.abs() < 1e-12 {
                return if from >= low && from <= high { (0.0, f64::INFINITY) } else { (1.0, 0.0) };
            }
            let (a, b) = ((low - from) / toward, (high - from) / toward);
            (a.min(b), a.max(b))
        };
        let (x0, x1) = span(ray.from.x, ray.toward.x, self.block.min.x, self.block.max.x);
        let (y0, y1) = span(ray.from.y, ray.toward.y, self.block.min.y, self.block.max.y);
        let (enter, leave) = (x0.max(y0).max(0.0), x1.min(y1));
        (enter < leave).then_some((enter, leave))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{FloorPlan, PlanClass};
    use crate::walls::{Walls, WallsOptions};

    /// A room of 6 x 4 m with a table of 2 x 1 m in its middle.
    fn room() -> RayGrid {
        let table = |x: u32, y: u32| (21..41).contains(&x) && (16..26).contains(&y);
        let inside = |x: u32, y: u32| (1..61).contains(&x) && (1..41).contains(&y);
        let plan = FloorPlan::with_furniture([62, 42], 0.1, inside, (PlanClass::Table, table));
        RayGrid::new(&Walls::trace(&plan, &WallsOptions::default()), &[], 2.6)
    }

    #[test]
    fn one_looks_over_a_table_onto_its_top_and_under_it() {
        let space = room();
        let eye = [0.6, 2.1, 1.6];
        let seen = |way: [f64; 3]| space.trace_inside(eye, way);
        // Level: the wall behind the table.
        let behind = seen([1.0, 0.0, 0.0]);
        assert!(matches!(behind.surface, HitSurface::Wall(_)) && behind.point[0] > 6.0, "{behind:?}");
        // Downward: the top, its edge, the floor under it, the floor before it.
        let top = seen([2.0, 0.0, -0.85]);
        assert!(matches!(top.surface, HitSurface::Fitting(_, 0)), "{top:?}");
        assert!((top.point[0] - 2.6).abs() < 1e-6 && (top.point[2] - 0.75).abs() < 1e-6, "{top:?}");
        let edge = seen([1.5, 0.0, -0.86]);
        assert!(matches!(edge.surface, HitSurface::Fitting(_, 2..)) && (edge.point[0] - 2.1).abs() < 1e-6, "{edge:?}");
        let under = seen([1.5, 0.0, -1.2]);
        assert!(under.surface == HitSurface::Floor && (under.point[0] - 2.6).abs() < 1e-6, "{under:?}");
        assert_eq!(seen([1.0, 0.0, -1.6]).surface, HitSurface::Floor);
    }

    #[test]
    fn a_table_is_seen_from_above() {
        let space = room();
        let seen = |x: f64, y: f64| space.trace_above([x, y, 30.0], [0.0, 1e-6, -1.0]).surface;
        assert!(matches!(seen(3.1, 2.1), HitSurface::Fitting(_, 0)));
        assert_eq!(seen(1.0, 1.0), HitSurface::Floor);
        assert_eq!(seen(0.05, 2.1), HitSurface::Top);
    }

    /// Under a table is shade, at its legs there is a shadow, away from it there is neither.
    #[test]
    fn furniture_takes_light_from_the_floor() {
        let space = room();
        let light = crate::show::rooms::Light::inside(&space);
        let shade = |x: f64, y: f64| light.on_floor(vec2(x, y)).shade;
        assert!(shade(3.1, 2.1) < 0.6 && shade(3.1, 1.45) < 0.9, "{} {}", shade(3.1, 2.1), shade(3.1, 1.45));
        assert!(shade(1.0, 1.0) > 0.97);
        let feet = |x: f64, y: f64| space.fittings.beside_feet(space.shades_at(vec2(x, y)), vec2(x, y));
        assert!(feet(2.13, 1.66) < 0.75 && feet(2.13, 2.1) > 0.97, "{} {}", feet(2.13, 1.66), feet(2.13, 2.1));
    }
}
