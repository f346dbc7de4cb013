use super::builder::SceneBuilder;
use super::model::{Mesh, Scene, SceneSurface, WallStrip};
use super::region::PolygonSet;
use super::tiles::TileCuts;
use super::tops::{Solid, add_level, add_underside};
use super::{faces, fittings, floor, lintels};
use crate::math::Rect;
use crate::show::rooms::{Finish, Fittings};
use crate::walls::{Doorway, Walls};

/// Sizes that a plan does not contain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneOptions {
    /// Height of the walls, metres.
    pub wall_height_m: f64,
    /// Shown thickness of outer walls, metres, 0 to 10; plans do not contain it.
    pub rim_m: f64,
}

impl Default for SceneOptions {
    fn default() -> SceneOptions {
        SceneOptions { wall_height_m: 2.6, rim_m: 0.2 }
    }
}

/// Lintels are at least this high, metres.
const LOWEST_LINTEL_M: f64 = 0.05;

/// A plan as triangles.
///
/// `tiles` are the places of the floor's textures in the plan frame, in the manifest's order; floor outside all of
/// them is left out. `strips` tell which wall is found where on the wall sheets; wall that is on none is clean
/// ([`SceneSurface::Lintel`]).
///
/// The floor has the walls' real outline, with holes and islands, cut at the tiles' borders such that neighbours
/// share their corners. Wall faces are upright quads with smooth normals round curved walls (turns of less than 40
/// degrees) and hard ones at edges. What is solid between floors is closed on top at the walls' height, and the outer
/// walls are shown as a rim with its outer sides; above doors that are at least 5 cm lower than the walls are lintels; where the floor goes on beyond the plan it is open. All triangles
/// have an area and are counter-clockwise seen from their front.
///
/// The same triangles in the same order on every machine.
pub fn build(
    walls: &Walls,
    tiles: &[Rect],
    strips: &[WallStrip],
    doorways: &[Doorway],
    options: &SceneOptions,
) -> Scene {
    let height_m = options.wall_height_m;
    let mut scene = SceneBuilder::default();
    let cuts = TileCuts::new(tiles);
    let bodies = Bodies::of(walls, doorways, options);
    // The floor goes on under tables.
    floor::add(&bodies.covered, tiles, &cuts, &mut scene);
    faces::add(&walls.faces, &bodies.standing.replaced, strips, &cuts, height_m, &mut scene);
    fittings::add(&bodies.standing, &mut scene);
    for (top_m, tops) in &bodies.blocks {
        add_level(tops, top_m.min(height_m), scene.part(SceneSurface::Fitting(Finish::of_block(*top_m) as usize)));
    }
    bodies.solid.add_tops(height_m, scene.part(SceneSurface::WallTop));
    bodies.solid.add_sides(height_m, scene.part(SceneSurface::WallTop));
    for (head_m, gaps) in &bodies.lintels {
        lintels::add(gaps, walls, [*head_m, height_m], &mut scene);
    }
    scene.finish()
}

/// A ceiling at the walls' height: over floor and furniture, but for doors that have a lintel, whose tops are there.
pub fn ceiling(walls: &Walls, doorways: &[Doorway], options: &SceneOptions) -> Option<Mesh> {
    let bodies = Bodies::of(walls, doorways, options);
    let room = bodies.blocks.iter().fold(bodies.covered, |room, (_, tops)| room.union(tops));
    let below = bodies.lintels.iter().fold(room, |room, (_, gaps)| room.minus(gaps));
    let mut scene = SceneBuilder::default();
    add_underside(&below, options.wall_height_m, scene.part(SceneSurface::Ceiling));
    scene.finish().meshes.pop()
}

/// What stands on a plan, as seen from above.
pub(super) struct Bodies {
    /// Floor, also under what fittings stand for.
    pub covered: PolygonSet,
    pub standing: Fittings,
    /// Furniture by its height, metres: that for which fittings stand.
    pub fitted: Vec<(f64, PolygonSet)>,
    /// Furniture by its height, metres: that which stays a block.
    pub blocks: Vec<(f64, PolygonSet)>,
    pub solid: Solid,
    /// Gaps of doors by the height of their heads, metres.
    pub lintels: Vec<(f64, PolygonSet)>,
}

impl Bodies {
    pub fn of(walls: &Walls, doorways: &[Doorway], options: &SceneOptions) -> Bodies {
        let height_m = options.wall_height_m;
        let floor = PolygonSet::inside_right(walls.outlines().iter().map(|o| o.points_m.iter().copied()));
        let standing = Fittings::of(walls, doorways, height_m);
        let [fitted, blocks] = [true, false].map(|replaced| furniture(walls, &standing.replaced, replaced));
        let covered = fitted.iter().fold(floor.clone(), |room, (_, tops)| room.union(tops));
        let room = blocks.iter().fold(covered.clone(), |room, (_, tops)| room.union(tops));
        let solid = Solid::around(&room, walls.outlines(), options.rim_m.clamp(0.0, 10.0));
        let mut heads_m: Vec<f64> =
            doorways.iter().map(|door| door.head_m).filter(|head_m| height_m - head_m >= LOWEST_LINTEL_M).collect();
        heads_m.sort_by(f64::total_cmp);
        heads_m.dedup();
        let gaps = |head_m: f64| {
            let alike = doorways.iter().filter(|door| door.head_m == head_m);
            (head_m.max(0.0), lintels::gaps(&floor, alike))
        };
        let lintels = heads_m.into_iter().map(gaps).collect();
        Bodies { covered, standing, fitted, blocks, solid, lintels }
    }
}

/// What furniture covers, by its height in metres: that for which fittings stand, or that which stays a block.
fn furniture(walls: &Walls, fitted: &[bool], wanted: bool) -> Vec<(f64, PolygonSet)> {
    let wanted = || walls.faces.iter().zip(fitted).filter(move |(_, fitted)| **fitted == wanted).map(|(face, _)| face);
    let mut heights_m: Vec<f64> = wanted().filter_map(|face| face.furniture_m).collect();
    heights_m.sort_by(f64::total_cmp);
    heights_m.dedup();
    let tops = |height_m: f64| {
        let of_height = wanted().filter(move |face| face.furniture_m == Some(height_m));
        // Faces have the floor on their right.
        (height_m, PolygonSet::inside_right(of_height.map(|face| face.points_m.iter().rev().copied())))
    };
    heights_m.into_iter().map(tops).collect()
}
