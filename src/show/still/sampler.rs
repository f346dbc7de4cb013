//! Samples the textures of floor and walls under a pixel.

use std::collections::BTreeSet;

use super::pyramid::{Footprint, NeededBlocks, Pyramid, TexelBlockKey};
use super::texels::{Texel, TexelSource};
use crate::look::StainLook;
use crate::show::rooms::{HitSurface, QuadKind, RayGrid, RayHit, WallQuad};

/// Pixels see a little less than their own width: pictures look soft otherwise.
const SHARPER: f32 = 0.85;
/// Ways along surfaces that are seen from the side are no longer than this many times across.
const MOST_STRETCH: f32 = 24.0;

/// Floor and walls in one state: trodden, or clean.
pub(super) struct SurfaceSampler<'a> {
    fine: Pyramid<'a>,
    small: Option<Pyramid<'a>>,
    walls: Pyramid<'a>,
    small_walls: Option<Pyramid<'a>>,
    /// Colour of the clean wall, linear light.
    pub plain: [f32; 3],
    /// Tint of the light that the clean floor throws back.
    pub floor_tint: [f32; 3],
    /// Stains of hands and of shoes on door leaves.
    pub leaf_stains: Option<[StainLook; 2]>,
}

/// Blocks of a skin.
#[derive(Default)]
pub(super) struct SamplerNeeds {
    fine: NeededBlocks,
    small: NeededBlocks,
    walls: NeededBlocks,
    small_walls: NeededBlocks,
}

impl SamplerNeeds {
    pub fn and(self, other: SamplerNeeds) -> SamplerNeeds {
        SamplerNeeds {
            fine: self.fine.and(other.fine),
            small: self.small.and(other.small),
            walls: self.walls.and(other.walls),
            small_walls: self.small_walls.and(other.small_walls),
        }
    }

    fn keys(&self) -> [&BTreeSet<TexelBlockKey>; 4] {
        [self.fine.keys(), self.small.keys(), self.walls.keys(), self.small_walls.keys()]
    }
}

/// Colour as linear light, and roughness, 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampledMaterial {
    pub colour: [f32; 3],
    pub roughness: f32,
}

impl<'a> SurfaceSampler<'a> {
    /// Floor and walls at their own texel density, and both made small, where they are.
    pub fn new(
        [floor, walls]: [&'a dyn TexelSource; 2],
        [small, small_walls]: [Option<&'a dyn TexelSource>; 2],
        plain: Texel,
    ) -> SurfaceSampler<'a> {
        SurfaceSampler {
            fine: Pyramid::new(floor),
            small: small.map(Pyramid::new),
            walls: Pyramid::new(walls),
            small_walls: small_walls.map(Pyramid::new),
            plain: [plain[0], plain[1], plain[2]].map(|value| f32::from(value) / 65_535.0),
            floor_tint: [1.0; 3],
            leaf_stains: None,
        }
    }

    /// Adds the blocks that shading a hit will read.
    pub fn needs(&self, space: &RayGrid, hit: &RayHit, pixel: f32, needs: &mut SamplerNeeds) {
        match hit.surface {
            HitSurface::Floor => {
                let footprint = on_floor(hit, pixel);
                match enough(&self.small, &footprint) {
                    Some(small) => small.needs(&footprint, 1.0, &mut needs.small),
                    None => self.fine.needs(&footprint, 1.0, &mut needs.fine),
                }
            }
            HitSurface::Wall(piece) => {
                let footprint = on_wall(&space.pieces[piece as usize], hit, pixel);
                match enough(&self.small_walls, &footprint) {
                    Some(small) => small.needs(&footprint, 1.0, &mut needs.small_walls),
                    None => self.walls.needs(&footprint, 1.0, &mut needs.walls),
                }
            }
            _ => {}
        }
    }

    pub fn hold(&mut self, needs: &SamplerNeeds) {
        let [fine, small, walls, small_walls] = needs.keys();
        self.fine.hold(fine);
        if let Some(pyramid) = &mut self.small {
            pyramid.hold(small);
        }
        self.walls.hold(walls);
        if let Some(pyramid) = &mut self.small_walls {
            pyramid.hold(small_walls);
        }
    }

    pub fn floor(&self, hit: &RayHit, pixel: f32) -> SampledMaterial {
        let footprint = on_floor(hit, pixel);
        paint(enough(&self.small, &footprint).unwrap_or(&self.fine).sample(&footprint, 1.0))
    }

    pub fn wall(&self, piece: &WallQuad, hit: &RayHit, pixel: f32) -> SampledMaterial {
        let footprint = on_wall(piece, hit, pixel);
        paint(enough(&self.small_walls, &footprint).unwrap_or(&self.walls).sample(&footprint, 1.0))
    }
}

/// The reduced texture, where its texels are fine enough for a footprint.
fn enough<'p, 'a>(small: &'p Option<Pyramid<'a>>, footprint: &Footprint) -> Option<&'p Pyramid<'a>> {
    small.as_ref().filter(|small| footprint.width * small.density() as f32 > 0.75)
}

fn paint([red, green, blue, roughness]: [f32; 4]) -> SampledMaterial {
    SampledMaterial { colour: [red, green, blue], roughness }
}

fn on_floor(hit: &RayHit, pixel: f32) -> Footprint {
    let [x, y, z] = hit.toward;
    let width = hit.way_m * pixel * SHARPER;
    let across = (x * x + y * y).sqrt().max(1e-6);
    let half = 0.5 * width / z.abs().max(1.0 / MOST_STRETCH);
    Footprint { layer: 0, middle: [hit.point[0], hit.point[1]], axis: [x / across * half, y / across * half], width }
}

fn on_wall(piece: &WallQuad, hit: &RayHit, pixel: f32) -> Footprint {
    let (along, face) = (along_m(piece, hit), if let QuadKind::Wall(face) = piece.what { face } else { 0 });
    let [x, y, z] = hit.toward;
    let u = x * piece.along.x as f32 + y * piece.along.y as f32;
    let facing = (x * piece.along.y as f32 - y * piece.along.x as f32).abs();
    let width = hit.way_m * pixel * SHARPER;
    let flat = (u * u + z * z).sqrt().max(1e-6);
    let half = 0.5 * width / facing.max(1.0 / MOST_STRETCH);
    Footprint {
        layer: face,
        middle: [piece.along_m as f32 + along, hit.point[2]],
        axis: [u / flat * half, z / flat * half],
        width,
    }
}

/// From a piece's start to where a hit is on it, metres.
pub(super) fn along_m(piece: &WallQuad, hit: &RayHit) -> f32 {
    let (x, y) = (f64::from(hit.point[0]) - piece.a.x, f64::from(hit.point[1]) - piece.a.y);
    (x * piece.along.x + y * piece.along.y) as f32
}
