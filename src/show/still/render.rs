//! A picture, band by band from below.

use std::collections::BTreeSet;

use image::RgbImage;
use rayon::prelude::*;

use super::glow::{Exposed, Glow};
use super::light_map::{LightKey, LightMap};
use super::sampler::{SamplerNeeds, SurfaceSampler, along_m};
use super::shade::{Lit, Shader, lit_at};
use super::tone::Tone;
use crate::export::{Camera, ExportError};
use crate::math::vec2;
use crate::progress::Progress;
use crate::show::rooms::{DAYLIGHT, HitSurface, Lens, Light, LinearRgb, OFF_WALL_M, RayGrid, RayHit, mix};

/// Rows that are worked on at a time.
const BAND: usize = 144;
/// Rays through pixels in which surfaces meet.
const RAYS: usize = 8;
/// Where they go through: no two in a row or a column.
const PLACES: [[f64; 2]; RAYS] = [
    [0.0625, 0.4375],
    [0.1875, 0.9375],
    [0.3125, 0.1875],
    [0.4375, 0.6875],
    [0.5625, 0.3125],
    [0.6875, 0.8125],
    [0.8125, 0.0625],
    [0.9375, 0.5625],
];

/// Neighbours in a row for which what a floor mirrors is looked up once: it is blurred to both sides over more.
const MIRRORED_TOGETHER: usize = 4;

/// Rays of the light meter across and down a picture.
const METERED: usize = 20;
/// Where three quarters of what is seen are lit less than this, the exposure is as always; brighter pictures get less.
const GLARE: f32 = 1.12;
/// The same outdoors: sunlit walls are meant to be bright.
const GLARE_OUTSIDE: f32 = 1.5;

/// A row of a picture before it is shaded.
#[derive(Default)]
struct TracedRow {
    hits: Vec<RayHit>,
    /// Columns in which surfaces meet, and the hits of their rays.
    edges: Vec<(u32, [RayHit; RAYS])>,
}

/// The texture and light blocks that a band needs.
#[derive(Default)]
struct Needs {
    skins: Vec<SamplerNeeds>,
    light: BTreeSet<LightKey>,
    last_light: Option<LightKey>,
}

impl Needs {
    fn of(skins: usize) -> Needs {
        Needs { skins: (0..skins).map(|_| SamplerNeeds::default()).collect(), ..Needs::default() }
    }

    fn and(mut self, mut other: Needs) -> Needs {
        self.light.append(&mut other.light);
        let skins = self.skins.into_iter().zip(other.skins).map(|(a, b)| a.and(b)).collect();
        Needs { skins, light: self.light, last_light: None }
    }

    fn add(&mut self, key: LightKey) {
        if self.last_light != Some(key) {
            self.last_light = Some(key);
            self.light.insert(key);
        }
    }
}

/// Renders the view of a camera, once with each sampler.
pub(super) struct Renderer<'a> {
    space: &'a RayGrid,
    lens: Lens,
    size: [u32; 2],
    above: bool,
    light: LightMap<'a>,
    tone: Tone,
}

impl<'a> Renderer<'a> {
    pub fn new(space: &'a RayGrid, camera: &Camera, size: [u32; 2]) -> Renderer<'a> {
        let above = camera.position_m[2] >= space.height_m;
        let light = if above { Light::above(space, camera.heading_deg) } else { Light::inside(space) };
        let lens = Lens::of(camera, size);
        let usual = if space.roofed { GLARE } else { GLARE_OUTSIDE };
        let glare = if above { 1.0 } else { brightness(space, &lens, &light, size) / usual };
        let tone = Tone::new(light.exposure() / glare.max(1.0));
        // From above all walls, nothing is nearer than their tops.
        let nearest_m = (camera.position_m[2] - space.height_m).max(0.0);
        Renderer { space, lens, size, above, light: LightMap::new(light, lens.pixel * nearest_m), tone }
    }

    /// The pictures, one per skin.
    ///
    /// # Errors
    /// [`ExportError::Interrupted`].
    pub fn draw(
        &mut self,
        skins: &mut [SurfaceSampler],
        progress: &dyn Progress,
        done: impl Fn(f64),
    ) -> Result<Vec<RgbImage>, ExportError> {
        let [width, height] = self.size;
        let mut lights: Vec<Exposed> = skins.iter().map(|_| Exposed::new(self.size)).collect();
        for top in (0..height as usize).step_by(BAND).rev() {
            progress.keep_on()?;
            let rows = self.trace_band(top, BAND.min(height as usize - top));
            self.hold(&rows, skins);
            for (k, row) in self.shade_band(&rows, skins).into_iter().enumerate() {
                lights.iter_mut().zip(row).for_each(|(light, row)| light.put(top + k, &row));
            }
            done(1.0 - top as f64 / f64::from(height));
        }
        let picture = |light: Exposed| {
            let glow = Glow::of(&light, self.tone.exposure);
            let mut picture = RgbImage::new(width, height);
            let rows = picture.as_flat_samples_mut().samples.par_chunks_exact_mut(width as usize * 3).enumerate();
            rows.for_each(|(y, bytes)| {
                let glowing = |(x, light): (usize, LinearRgb)| {
                    let glow = glow.at(x, y);
                    std::array::from_fn(|c| light[c] + glow[c])
                };
                let row: Vec<LinearRgb> = light.row(y).enumerate().map(glowing).collect();
                self.tone.row(&row, y as u32, self.size, bytes);
            });
            picture
        };
        Ok(lights.into_iter().map(picture).collect())
    }

    fn trace(&self, x: f64, y: f64) -> RayHit {
        let way = self.lens.ray(x, y);
        if self.above {
            self.space.trace_above(self.lens.position, way)
        } else {
            self.space.trace_inside(self.lens.position, way)
        }
    }

    fn trace_band(&self, top: usize, count: usize) -> Vec<TracedRow> {
        let width = self.size[0] as usize;
        let rows: Vec<Vec<RayHit>> = (0..count + 2)
            .into_par_iter()
            .map(|k| {
                // One row more on either side: edges are found by neighbours.
                let y = (top + k) as f64 - 0.5;
                (0..width).map(|x| self.trace(x as f64 + 0.5, y)).collect()
            })
            .collect();
        let edges: Vec<Vec<(u32, [RayHit; RAYS])>> = (1..=count)
            .into_par_iter()
            .map(|k| {
                let y = (top + k - 1) as f64;
                let meets = |x: &usize| {
                    let here = &rows[k][*x];
                    let beside = |other: &RayHit| meets(here, other);
                    beside(&rows[k - 1][*x])
                        || beside(&rows[k + 1][*x])
                        || (*x > 0 && beside(&rows[k][*x - 1]))
                        || (*x + 1 < width && beside(&rows[k][*x + 1]))
                };
                let rays = |x: usize| PLACES.map(|[dx, dy]| self.trace(x as f64 + dx, y + dy));
                (0..width).filter(meets).map(|x| (x as u32, rays(x))).collect()
            })
            .collect();
        let inner = rows.into_iter().skip(1).zip(edges);
        inner.map(|(hits, edges)| TracedRow { hits, edges }).collect()
    }

    fn hold(&mut self, rows: &[TracedRow], skins: &mut [SurfaceSampler]) {
        let pixel = self.lens.pixel as f32;
        let gather = |row: &TracedRow| {
            let mut needs = Needs::of(skins.len());
            for hit in row.hits.iter().chain(row.edges.iter().flat_map(|(_, hits)| hits)) {
                for (skin, needs) in skins.iter().zip(&mut needs.skins) {
                    skin.needs(self.space, hit, pixel, needs);
                }
                let [x, y, _] = hit.point;
                match hit.surface {
                    HitSurface::Floor | HitSurface::Ceiling | HitSurface::Furniture => {
                        needs.add(self.light.floor_key(x, y));
                    }
                    HitSurface::Fitting(number, face) => {
                        let [x, y] = lit_at(&self.space.fittings, hit, number, face);
                        needs.add(self.light.floor_key(x, y));
                    }
                    HitSurface::Wall(piece) | HitSurface::Lintel(piece) => {
                        let along = along_m(&self.space.pieces[piece as usize], hit);
                        needs.add(self.light.wall_key(piece, along));
                    }
                    _ => {}
                }
            }
            needs
        };
        let needs = rows.par_iter().map(gather).reduce(|| Needs::of(skins.len()), Needs::and);
        self.light.hold(&needs.light);
        for (skin, needs) in skins.iter_mut().zip(&needs.skins) {
            skin.hold(needs);
        }
    }

    /// Light by row and skin.
    fn shade_band(&self, rows: &[TracedRow], skins: &[SurfaceSampler]) -> Vec<Vec<Vec<LinearRgb>>> {
        let shader = Shader { space: self.space, light: &self.light, pixel: self.lens.pixel as f32 };
        let shade = |row: &TracedRow| {
            let width = row.hits.len();
            let mut lit = vec![vec![Lit::default(); width]; skins.len()];
            let mut seen = vec![Lit::default(); skins.len()];
            let mut edges = row.edges.iter().peekable();
            let mut neighbour = None;
            for (x, hit) in row.hits.iter().enumerate() {
                if x % MIRRORED_TOGETHER == 0 {
                    neighbour = None;
                }
                if let Some((_, hits)) = edges.next_if(|(column, _)| *column as usize == x) {
                    for hit in hits {
                        shader.shade(hit, skins, &mut neighbour, &mut seen);
                        for (lit, seen) in lit.iter_mut().zip(&seen) {
                            add_share(&mut lit[x], seen);
                        }
                    }
                } else {
                    shader.shade(hit, skins, &mut neighbour, &mut seen);
                    for (lit, seen) in lit.iter_mut().zip(&seen) {
                        lit[x] = *seen;
                    }
                }
            }
            lit.into_iter().map(|row| mirrored(&row)).collect()
        };
        rows.par_iter().map(shade).collect()
    }
}

/// Irradiance that most of the floor and walls in a picture stay below, as a camera's light meter sees it.
fn brightness(space: &RayGrid, lens: &Lens, light: &Light, [width, height]: [u32; 2]) -> f32 {
    let mut seen = Vec::with_capacity(METERED * METERED);
    for k in 0..METERED * METERED {
        let place = |k: usize, size: u32| (k as f64 + 0.5) / METERED as f64 * f64::from(size);
        let hit = space.trace_inside(lens.position, lens.ray(place(k % METERED, width), place(k / METERED, height)));
        let [x, y, z] = hit.point.map(f64::from);
        match hit.surface {
            HitSurface::Floor | HitSurface::Fitting(..) => seen.push(light.on_floor(vec2(x, y)).full),
            HitSurface::Wall(piece) => {
                let piece = &space.pieces[piece as usize];
                let normal = piece.round_normal(f64::from(along_m(piece, &hit)));
                seen.push(light.on_wall(vec2(x, y) + normal * OFF_WALL_M, normal).at(z).full);
            }
            _ => {}
        }
    }
    seen.sort_by(f32::total_cmp);
    seen.get(seen.len() * 3 / 4).copied().unwrap_or(0.0)
}

/// Adds one of [`RAYS`] to a pixel. Lamps count as daylight: their edges would be rough otherwise.
fn add_share(sum: &mut Lit, ray: &Lit) {
    const SHARE: f32 = 1.0 / RAYS as f32;
    for (sum, value) in sum.colour.iter_mut().zip(ray.colour) {
        *sum += value.min(DAYLIGHT[2]) * SHARE;
    }
    let gain = ray.gain * SHARE;
    if gain > 0.0 {
        // The mean by share of the mirrored light.
        let part = gain / (sum.gain + gain);
        sum.shine = mix(sum.shine, ray.shine, part);
        sum.blur_px += (ray.blur_px - sum.blur_px) * part;
        sum.gain += gain;
    }
}

/// A row's light: what floors mirror is blurred to both sides, as rough floors blur upright edges.
fn mirrored(row: &[Lit]) -> Vec<LinearRgb> {
    /// Samples to either side, and of how many times the half width.
    const ASIDE: i32 = 10;
    const REACH: f32 = 2.0;
    let blurred = |x: usize, lit: &Lit| {
        let step = (REACH * lit.blur_px / ASIDE as f32).max(0.25);
        let (mut sum, mut weights) = ([0.0; 3], 0.0);
        for k in -ASIDE..=ASIDE {
            let place = x as f32 + k as f32 * step;
            let other = row.get((place + 0.5).max(0.0) as usize).filter(|other| other.gain > 0.0);
            let Some(other) = other else { continue };
            let off = k as f32 / ASIDE as f32 * REACH;
            let weight = (1.0 - 0.25 * off * off).max(0.0);
            let weight = weight * weight;
            sum = std::array::from_fn(|c| sum[c] + weight * other.shine[c]);
            weights += weight;
        }
        if weights > 0.0 { sum.map(|sum| sum / weights) } else { lit.shine }
    };
    let shown = |(x, lit): (usize, &Lit)| {
        if lit.gain <= 0.0 {
            return lit.colour;
        }
        let shine = blurred(x, lit);
        std::array::from_fn(|c| lit.colour[c] + lit.gain * shine[c])
    };
    row.iter().enumerate().map(shown).collect()
}

/// Whether two neighbouring pixels see different things.
fn meets(a: &RayHit, b: &RayHit) -> bool {
    a.surface != b.surface || (a.beyond_m > 0.0) != (b.beyond_m > 0.0)
}
