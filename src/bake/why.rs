//! What made a place of a finished bake as it is.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::Error;
use crate::export::{self, ExportError, Manifest};
use crate::look::{FloorResolver, Layer, Look, ResolvedBlock, WallResolver};
use crate::math::{Vec2, vec2};
use crate::patterns::Cause;
use crate::routes::{Gate, Place, Route};
use crate::stamps::DENSITY_ONE;
use crate::sums::{FloorSums, Quantity, WallSums};
use crate::walls::{Walls, closest_on};

/// How far around a place may be looked, metres: least and most.
const WITHIN_M: [f64; 2] = [0.01, 2.0];
/// A wall, stop, door or opening is near within this distance, metres, or the given one if that is more.
const NEAR_M: f64 = 0.5;
const NEAR_STOP_M: f64 = 1.5;
/// Less of the density is not told.
const LEAST_DENSITY: f64 = 5e-4;

/// What made a place as it is, from the sums and the routes of a bake.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Why {
    /// The place, metres.
    pub at_m: Vec2,
    /// Means are over the floor and the wall within this distance, metres.
    pub within_m: f64,
    /// Number of people whose footfalls the sums hold.
    pub people: u32,
    /// Number of people whom they stand for.
    pub total_passes: u64,
    /// Mean number of passes of those over the floor here.
    pub passes: f64,
    /// Mean of each sum of the simulated people, by quantity, in its unit; without those that are 0.
    pub sums: BTreeMap<&'static str, f64>,
    /// Dirt of the floor by cause, the most first.
    pub floor: Vec<Reason>,
    /// Routes whose way leads over the place, by the people whom they bring here, the most first.
    pub routes: Vec<RouteHere>,
    /// Stops, doors and openings nearby with their distance, metres, the nearest first.
    pub near: Vec<(String, f64)>,
    /// The nearest wall, if one is near.
    pub wall: Option<WallHere>,
}

/// A cause of dirt at a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reason {
    /// The cause.
    pub cause: &'static str,
    /// Mean optical density that the place would lack without it.
    pub density: f64,
    /// Its share of all causes, 0 to 1.
    pub share: f64,
}

/// A route at a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RouteHere {
    /// Name of the route.
    pub name: String,
    /// Number of people on the route, of all that the bake stands for.
    pub people: f64,
    /// Share of those who come by the place that are of this route, 0 to 1: people per metre of the way's width.
    pub share: f64,
}

/// A wall near a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WallHere {
    /// Index of the face, as in the manifest's strips.
    pub face: usize,
    /// Arc length along the face, metres.
    pub along_m: f64,
    /// The nearest point of the wall, metres.
    pub point_m: Vec2,
    /// Its distance, metres.
    pub distance_m: f64,
    /// Mean optical density of the touches of the simulated people, by cause; without those that are 0.
    pub sums: BTreeMap<&'static str, f64>,
    /// Dirt of the wall by cause, the most first: the mean over its height.
    pub wall: Vec<Reason>,
}

/// Explains a place of a finished bake: which passes, causes and routes made it as it is. Writes no files.
///
/// The floor is resolved once with the bake's look and once without each cause: what is then missing is that cause's. What
/// people of each route did is not kept; routes are told by their ways. `within_m` is clamped to 0.01 to 2 m.
///
/// # Errors
/// The folder is not a bake or is damaged; a place beyond the plan, or neither on the floor nor near a wall.
pub fn why(bake: &Path, at_m: Vec2, within_m: f64) -> Result<Why, Error> {
    let within_m = within_m.clamp(WITHIN_M[0], WITHIN_M[1]);
    let read = || -> Result<_, Error> {
        let manifest = Manifest::read(bake)?;
        let look = manifest.look(bake)?;
        Ok((
            export::read_sums(bake, &manifest)?,
            export::read_wall_sums(bake, &manifest)?,
            manifest.walls()?,
            look,
            manifest,
        ))
    };
    let (sums, wall_sums, walls, look, manifest) = export::settled(&[bake], read)?;
    let place = FloorHere::of(&sums, &walls, at_m, within_m);
    let wall = wall_sums.as_ref().map(|sums| wall_here(sums, &walls, &look, &manifest, at_m, within_m)).transpose()?;
    let wall = wall.flatten();
    let (width_m, height_m) = (manifest.plan.width_m, manifest.plan.height_m);
    let beyond = !(0.0..=width_m).contains(&at_m.x) || !(0.0..=height_m).contains(&at_m.y);
    if beyond || place.texels.is_empty() && wall.is_none() {
        let nearest_m = nearest_floor(&walls, at_m).into();
        return Err(
            ExportError::NoSuchPlace { place_m: at_m.into(), beyond, size_m: [width_m, height_m], nearest_m }.into()
        );
    }
    let older = look.total_passes as f64 / f64::from(manifest.people.max(1));
    let here = place.sums(&sums);
    Ok(Why {
        at_m,
        within_m,
        people: manifest.people,
        total_passes: look.total_passes,
        passes: here.get(Quantity::Presence.name()).map_or(0.0, |passes| passes * older),
        sums: here,
        floor: place.reasons(&sums, &walls, &look, manifest.people)?,
        routes: routes_here(&manifest.routes, at_m, look.total_passes as f64),
        near: near(&manifest, at_m, within_m),
        wall,
    })
}

/// The texels of floor within a distance of a place.
struct FloorHere {
    i0: i64,
    j0: i64,
    side: usize,
    /// Indices in the window.
    texels: Vec<usize>,
    centre_m: Vec2,
    within_m: f64,
}

impl FloorHere {
    fn of(sums: &FloorSums, walls: &Walls, centre_m: Vec2, within_m: f64) -> FloorHere {
        let texels_per_metre = sums.grid().texels_per_metre;
        // A texel at least, on a coarse floor.
        let within_m = within_m.max(0.75 / texels_per_metre);
        let first = |metres: f64| ((metres - within_m) * texels_per_metre).floor().clamp(-1e9, 1e9) as i64;
        let (i0, j0) = (first(centre_m.x), first(centre_m.y));
        let side = (2.0 * within_m * texels_per_metre).ceil() as usize + 1;
        let mut share = vec![0.0; side * side];
        walls.coverage(texels_per_metre, i0, j0, side, side, &mut share);
        let middle = |first: i64, k: usize| (first as f64 + k as f64 + 0.5) / texels_per_metre;
        let is_here = |&k: &usize| {
            let texel_m = vec2(middle(i0, k % side), middle(j0, k / side));
            share[k] >= 0.5 && texel_m.distance(centre_m) <= within_m
        };
        FloorHere { i0, j0, side, texels: (0..side * side).filter(is_here).collect(), centre_m, within_m }
    }

    /// The mean of each sum; without those that are 0.
    fn sums(&self, sums: &FloorSums) -> BTreeMap<&'static str, f64> {
        let mean = |quantity: Quantity| {
            let grid = sums.grid_of(quantity);
            let low = self.centre_m - vec2(self.within_m, self.within_m);
            let cell = |metres: f64| (metres * grid.texels_per_metre).floor().max(0.0) as u32;
            let count = (2.0 * self.within_m * grid.texels_per_metre).ceil() as u32 + 1;
            let cells = (cell(low.y)..)
                .take(count as usize)
                .flat_map(|j| (cell(low.x)..).take(count as usize).map(move |i| [i, j]));
            let middle = |k: u32| (f64::from(k) + 0.5) / grid.texels_per_metre;
            let mut values = [0];
            let (mut sum, mut touched) = (0.0, 0u32);
            for [i, j] in cells.filter(|&[i, j]| i < grid.width && j < grid.height) {
                if vec2(middle(i), middle(j)).distance(self.centre_m) <= self.within_m {
                    sums.read(quantity, i, j, 1, 1, &mut values);
                    sum += f64::from(values[0]) / f64::from(quantity.one());
                    touched += 1;
                }
            }
            sum / f64::from(touched.max(1))
        };
        Quantity::ALL.iter().map(|&q| (q.name(), mean(q))).filter(|(_, mean)| *mean > 0.0).collect()
    }

    /// Mean optical density of all dirt.
    fn density(&self, block: &ResolvedBlock) -> f64 {
        let dirt = block.layers.iter().filter(|layer| layer.kind().is_some() && !layer.values.is_empty());
        let of = |layer: &Layer| self.texels.iter().map(|&k| f64::from(layer.values[k])).sum::<f64>();
        dirt.map(of).sum::<f64>() / self.texels.len().max(1) as f64
    }

    fn reasons(&self, sums: &FloorSums, walls: &Walls, look: &Look, people: u32) -> Result<Vec<Reason>, Error> {
        let density = |look: &Look| -> Result<f64, Error> {
            let resolver = FloorResolver::new(sums, walls, look, people)?;
            Ok(self.density(&resolver.resolve(self.i0, self.j0, self.side, self.side)))
        };
        if self.texels.is_empty() {
            return Ok(Vec::new());
        }
        let all = density(look)?;
        let mut reasons = Vec::new();
        for (cause, take) in CAUSES {
            let mut without = look.clone();
            take(&mut without);
            if without != *look {
                reasons.push((cause, all - density(&without)?));
            }
        }
        Ok(sorted(reasons))
    }
}

/// Takes a cause from a look.
type Take = fn(&mut Look);

/// The causes of a floor's dirt, and how a look loses each.
const CAUSES: [(&str, Take); 11] = [
    ("film of all passes", |look| look.film.density = 0.0),
    ("standing", |look| look.dwell.density = 0.0),
    ("wheels", |look| look.wheels.density = 0.0),
    ("age", |look| look.age.density = 0.0),
    ("stains and spills", |look| look.age.stains_per_m2 = 0.0),
    ("gum, grit and rubs", |look| {
        look.age.gum_per_m2 = 0.0;
        look.age.grit_per_m2 = 0.0;
        look.age.rubs_per_m2 = 0.0;
    }),
    ("prints", |look| {
        look.prints.soil = 0.0;
        look.prints.every_pass = 0.0;
    }),
    ("wet shoes", |look| look.wet = Default::default()),
    ("scuffs of heels", |look| look.scuffs.strength = 0.0),
    ("edge at the skirting", |look| look.edge.density = 0.0),
    ("dust off the lanes", |look| look.dust.density = 0.0),
];

/// Causes with their shares, the most first.
fn sorted(densities: Vec<(&'static str, f64)>) -> Vec<Reason> {
    let mut told: Vec<_> = densities.into_iter().filter(|(_, density)| *density >= LEAST_DENSITY).collect();
    told.sort_by(|a, b| b.1.total_cmp(&a.1));
    let all: f64 = told.iter().map(|(_, density)| density).sum();
    told.into_iter().map(|(cause, density)| Reason { cause, density, share: density / all }).collect()
}

fn wall_here(
    sums: &WallSums,
    walls: &Walls,
    look: &Look,
    manifest: &Manifest,
    at_m: Vec2,
    within_m: f64,
) -> Result<Option<WallHere>, Error> {
    let Some(nearest) = walls.nearest(at_m, within_m.max(NEAR_M)) else { return Ok(None) };
    let Some(face) = nearest.face else { return Ok(None) };
    let grid = sums.grid();
    let span = &grid.faces[face];
    let column = |along_m: f64| ((along_m * grid.texels_per_metre).floor().max(0.0) as u32).min(span.width - 1);
    let first = column(nearest.along_m - within_m);
    let width = (column(nearest.along_m + within_m) - first + 1) as usize;
    let height = grid.height as usize;
    let mut values = vec![0; width * height];
    let mut touched = BTreeMap::new();
    for cause in Cause::WALL {
        sums.read(cause, face, first, 0, width, height, &mut values);
        let mean =
            values.iter().map(|&sum| f64::from(sum)).sum::<f64>() / (f64::from(DENSITY_ONE) * values.len() as f64);
        if mean > 0.0 {
            touched.insert(cause.name(), mean);
        }
    }
    let resolver = WallResolver::new(sums, walls, look, manifest.wall_people())?;
    let resolver = resolver.with_doors(walls, &manifest.doorways(), look);
    let block = resolver.resolve(face, i64::from(first), 0, width, height);
    let of = |layer: &Layer| {
        let all: f64 = layer.values.iter().map(|&density| f64::from(density)).sum();
        (wall_cause(layer.name), all / layer.values.len().max(1) as f64)
    };
    let reasons = sorted(block.layers.iter().filter(|layer| layer.kind().is_some()).map(of).collect());
    Ok(Some(WallHere {
        face,
        along_m: nearest.along_m,
        point_m: nearest.point_m,
        distance_m: nearest.distance_m,
        sums: touched,
        wall: reasons,
    }))
}

fn wall_cause(layer: &'static str) -> &'static str {
    match layer {
        "hand" => "hands",
        "arm" => "arms",
        "shoulder" => "shoulders",
        "bag" => "bags",
        "shoe" => "shoes",
        "splash" => "splashes of the mop",
        "chip" => "chips in the paint",
        other => other,
    }
}

/// The routes whose way leads over a place: people per metre of its width there.
fn routes_here(routes: &[Route], at_m: Vec2, people: f64) -> Vec<RouteHere> {
    let width_m = |route: &Route| {
        let pieces = route.gates.windows(2).filter(|gates| holds(gates, at_m));
        pieces.map(|gates| 0.5 * (gates[0].width_m() + gates[1].width_m())).reduce(f64::min)
    };
    let here: Vec<(&Route, f64)> =
        routes.iter().filter_map(|route| Some((route, route.share / width_m(route)?.max(0.1)))).collect();
    let all: f64 = here.iter().map(|(_, density)| density).sum();
    let mut here: Vec<RouteHere> = here
        .into_iter()
        .filter(|(_, density)| *density > 0.0)
        .map(|(route, density)| RouteHere {
            name: route.name.clone(),
            people: route.share * people,
            share: density / all,
        })
        .collect();
    here.sort_by(|a, b| b.share.total_cmp(&a.share));
    here
}

/// Whether the piece of way between two gates holds a place: on the same side of its four borders.
fn holds(gates: &[Gate], at_m: Vec2) -> bool {
    let corners = [gates[0].left_m, gates[1].left_m, gates[1].right_m, gates[0].right_m];
    let mut inside = false;
    for (k, &a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        if (a.y > at_m.y) != (b.y > at_m.y) && at_m.x < a.x + (at_m.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside
}

/// Stops, doors and openings near a place, the nearest first.
fn near(manifest: &Manifest, at_m: Vec2, within_m: f64) -> Vec<(String, f64)> {
    let to = |a: Vec2, b: Vec2| closest_on(a, b, at_m).distance(at_m);
    let mut near: Vec<(String, f64)> = Vec::new();
    for stop in Route::each_stop(&manifest.routes) {
        let places = stop.places_m.iter().map(|place| place.distance(at_m));
        let line = stop.queue_m.windows(2).map(|pair| to(pair[0], pair[1]));
        let distance_m = places.chain(line).fold(to(stop.at_m[0], stop.at_m[1]), f64::min);
        near.push((format!("stop {}", stop.name), distance_m));
    }
    for door in manifest.doorways() {
        let [a, b] = door.jambs_m;
        let middle = a.lerp(b, 0.5);
        near.push((format!("door at [{:.2}, {:.2}]", middle.x, middle.y), to(a, b)));
    }
    for opening in &manifest.openings {
        near.push((format!("opening {}", opening.name), to(opening.from_m, opening.to_m)));
    }
    let areas = manifest.routes.iter().flat_map(|route| [("start", &route.start, route), ("goal", &route.goal, route)]);
    for (what, place, route) in areas {
        if let Place::Area([low, high]) = place {
            let inside = vec2(at_m.x.clamp(low.x, high.x), at_m.y.clamp(low.y, high.y));
            near.push((format!("{what} of {}", route.name), inside.distance(at_m)));
        }
    }
    near.retain(|(_, distance_m)| *distance_m <= within_m.max(NEAR_STOP_M));
    near.sort_by(|a, b| a.1.total_cmp(&b.1).then_with(|| a.0.cmp(&b.0)));
    near.dedup();
    near
}

/// The nearest place on the floor beside a wall, rounded to centimetres.
fn nearest_floor(walls: &Walls, at_m: Vec2) -> Vec2 {
    let bounds = walls.bounds_m();
    let inside = vec2(at_m.x.clamp(bounds.min.x, bounds.max.x), at_m.y.clamp(bounds.min.y, bounds.max.y));
    let found = walls.nearest(inside, bounds.width() + bounds.height());
    let place = match found {
        Some(nearest) if !walls.is_inside(inside) => nearest.point_m,
        _ => inside,
    };
    vec2((place.x * 100.0).round() / 100.0, (place.y * 100.0).round() / 100.0)
}
