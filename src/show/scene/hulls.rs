//! Convex collision shapes: prisms that fill walls, lintels, furniture, door leaves and the ground.

use super::build::{Bodies, SceneOptions};
use super::builder::SceneBuilder;
use super::fittings::add_prism;
use super::model::{Mesh, Scene, SceneSurface};
use super::region::PolygonSet;
use crate::math::{Rect, Vec2};
use crate::show::rooms::Finish;
use crate::walls::{Doorway, Walls};

/// How far the ground goes down, metres: what falls fast must not fall through.
const GROUND_M: f64 = 0.5;

/// Greatest distance of a corner from the line between those beside it that goes, metres.
const STRAIGHT_M: f64 = 0.002;

/// An upright convex prism.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// The surface of the mesh that it belongs to.
    pub surface: SceneSurface,
    /// Its outline in the plan frame, counter-clockwise, metres.
    pub corners: Vec<Vec2>,
    /// Where it begins and ends above the floor, metres.
    pub span_m: [f64; 2],
}

/// Convex shapes that fill what is solid in the scene of a plan, each with the surface of the mesh of `scene` that it
/// belongs to. Floor goes on under walls and ends at the tiles' borders.
///
/// The same shapes in the same order on every machine.
pub fn hulls(walls: &Walls, tiles: &[Rect], doorways: &[Doorway], options: &SceneOptions, scene: &Scene) -> Vec<Prism> {
    let height_m = options.wall_height_m;
    let bodies = Bodies::of(walls, doorways, options);
    let mut hulls = Vec::new();
    let has = |surface| scene.meshes.iter().any(|mesh| mesh.surface == surface);
    let mut add = |surface: SceneSurface, pieces: Vec<Vec<Vec2>>, span_m: [f64; 2]| {
        // A shape without its mesh would be drawn.
        let Some(surface) = [surface, SceneSurface::WallTop].into_iter().find(|&surface| has(surface)) else { return };
        hulls.extend(pieces.iter().filter_map(|piece| Prism::over(surface, piece, span_m)));
    };
    let whole = bodies.covered.union(&bodies.solid.whole);
    for (k, tile) in tiles.iter().enumerate() {
        let ground = whole.intersection(&PolygonSet::rectangles([*tile]));
        add(SceneSurface::FloorTile(k), ground.convex_pieces(), [-GROUND_M, 0.0]);
    }
    add(SceneSurface::WallTop, bodies.solid.tops.convex_pieces(), [0.0, height_m]);
    for (head_m, gaps) in &bodies.lintels {
        add(SceneSurface::Lintel, gaps.convex_pieces(), [*head_m, height_m]);
    }
    for (top_m, area) in bodies.fitted.iter().chain(&bodies.blocks) {
        let surface = SceneSurface::Fitting(Finish::of_block(*top_m) as usize);
        add(surface, area.convex_pieces(), [0.0, top_m.min(height_m)]);
    }
    for leaf in bodies.standing.all.iter().filter(|fitting| fitting.leaf.is_some()) {
        add(SceneSurface::Fitting(leaf.finish as usize), vec![leaf.footprint.clone()], leaf.span_m);
    }
    hulls
}

impl Prism {
    /// The prism over a convex polygon; nothing if it has no volume.
    fn over(surface: SceneSurface, corners: &[Vec2], span_m: [f64; 2]) -> Option<Prism> {
        let corners = without_straight(corners);
        (span_m[1] > span_m[0] && corners.len() > 2).then_some(Prism { surface, corners, span_m })
    }

    /// The prism as a closed mesh, without texture coordinates.
    pub fn mesh(&self) -> Option<Mesh> {
        let mut scene = SceneBuilder::default();
        add_prism(&self.corners, self.span_m, true, scene.part(self.surface));
        let mut mesh = scene.finish().meshes.pop()?;
        mesh.uvs.clear();
        Some(mesh)
    }
}

/// A polygon without the corners that are hardly any: faces a millimetre wide point anywhere once rounded.
fn without_straight(corners: &[Vec2]) -> Vec<Vec2> {
    let mut kept = corners.to_vec();
    let is_straight = |kept: &[Vec2], k: usize| {
        let (before, after) = (kept[(k + kept.len() - 1) % kept.len()], kept[(k + 1) % kept.len()]);
        let along = (after - before).normalized();
        along.is_none_or(|along| along.cross(kept[k] - before).abs() < STRAIGHT_M)
    };
    while let Some(k) = (0..kept.len()).find(|&k| kept.len() > 2 && is_straight(&kept, k)) {
        kept.remove(k);
    }
    kept
}
