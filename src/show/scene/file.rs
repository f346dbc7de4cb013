use image::RgbImage;

use super::model::{Mesh, SceneSurface};
use crate::export::Camera;
use crate::math::srgb::Srgb8;
use crate::show::rooms::{Finish, Panel, Rooms};

/// What a file of a scene holds beside its triangles: names, and a material for each surface.
#[derive(Clone, Debug)]
pub struct SceneFile<'a> {
    /// Name of the node that holds everything: the plan's.
    pub name: String,
    /// Seed of the bake.
    pub seed: u64,
    /// Textures of [`SceneSurface::FloorTile`], in its order.
    pub floor: Vec<SurfaceImages<'a>>,
    /// Textures of [`SceneSurface::WallSheet`], in its order.
    pub walls: Vec<SurfaceImages<'a>>,
    /// [`SceneSurface::WallTop`].
    pub wall_top: PlainMaterial,
    /// [`SceneSurface::Lintel`]: the clean wall.
    pub clean_wall: PlainMaterial,
    /// What the name of each mesh's node ends with: a sign to the program that reads it.
    pub node_suffix: &'a str,
    /// Convex collision shapes, each with the surface of the mesh that it belongs to, where the format can.
    pub hulls: Vec<Mesh>,
    /// Cameras with their names.
    pub cameras: Vec<(&'a str, Camera)>,
    /// Width and height of their pictures, pixels.
    pub picture_px: [u32; 2],
    /// Lamps in the ceiling, shining down.
    pub lamps: Vec<SceneLamp>,
}

/// A lamp in the ceiling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneLamp {
    /// x and y in the plan frame and height above the floor, metres.
    pub place_m: [f64; 3],
    /// Area of its light, square metres.
    pub area_m2: f64,
}

/// Lamps hang so far below the ceiling, metres: clear of it, and of one that somebody adds.
const BELOW_CEILING_M: f64 = 0.02;

impl SceneLamp {
    /// The lamps in the ceiling of rooms.
    pub fn all(rooms: &Rooms) -> Vec<SceneLamp> {
        let height_m = rooms.grid.height_m - BELOW_CEILING_M;
        let lamp =
            |panel: Panel| SceneLamp { place_m: [panel.centre.x, panel.centre.y, height_m], area_m2: panel.area() };
        rooms.panels().into_iter().map(lamp).collect()
    }
}

/// The textures of one tile or sheet: paths relative to the scene's folder, with `/` between their parts.
#[derive(Clone, Debug)]
pub struct SurfaceImages<'a> {
    /// Name of node, mesh and material, such as `floor_0_0`.
    pub name: String,
    /// Base colour, sRGB.
    pub base_color: &'a str,
    /// Occlusion, roughness, metallic, linear.
    pub orm: &'a str,
    /// Normals in tangent space, green up; linear.
    pub normal: Option<&'a str>,
    /// Base colour and ORM to be embedded in place of the files, where the format can.
    pub embedded: Option<[&'a RgbImage; 2]>,
}

/// A surface without a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlainMaterial {
    /// sRGB.
    pub colour: Srgb8,
    /// 0 (mirror) to 1 (matt).
    pub roughness: f32,
}

impl PlainMaterial {
    /// Cut surfaces: darker than any wall, so that the plan can be read from above.
    pub const CUT: PlainMaterial = PlainMaterial { colour: [104, 102, 98], roughness: 0.9 };
    /// White paint.
    pub const PAINT: PlainMaterial = PlainMaterial { colour: [224, 222, 216], roughness: 0.7 };

    /// The roughness within its range; matt if it is no number.
    pub(super) fn sound_roughness(self) -> f32 {
        if self.roughness.is_finite() { self.roughness.clamp(0.0, 1.0) } else { 1.0 }
    }
}

impl Default for SceneFile<'_> {
    fn default() -> Self {
        SceneFile {
            name: "plan".to_string(),
            seed: 0,
            floor: Vec::new(),
            walls: Vec::new(),
            wall_top: PlainMaterial::CUT,
            clean_wall: PlainMaterial::PAINT,
            node_suffix: "",
            hulls: Vec::new(),
            cameras: Vec::new(),
            picture_px: [1, 1],
            lamps: Vec::new(),
        }
    }
}

/// The material of a surface in a file.
pub(super) enum Cover<'a> {
    Textured(&'a SurfaceImages<'a>),
    Plain(&'static str, PlainMaterial),
}

impl<'a> Cover<'a> {
    pub fn of(surface: SceneSurface, file: &'a SceneFile<'a>) -> Cover<'a> {
        let textured = match surface {
            SceneSurface::FloorTile(tile) => file.floor.get(tile),
            SceneSurface::WallSheet(sheet) => file.walls.get(sheet),
            SceneSurface::WallTop | SceneSurface::Lintel | SceneSurface::Fitting(_) | SceneSurface::Ceiling => None,
        };
        let name = match surface {
            SceneSurface::FloorTile(_) => "floor",
            SceneSurface::WallSheet(_) => "wall",
            SceneSurface::WallTop => "wall_tops",
            SceneSurface::Lintel => "clean_wall",
            SceneSurface::Ceiling => "ceiling",
            SceneSurface::Fitting(finish) => Finish::ALL.get(finish).map_or("fitting", |finish| finish.name()),
        };
        let plain = match surface {
            SceneSurface::WallTop => file.wall_top,
            SceneSurface::Ceiling => PlainMaterial::PAINT,
            SceneSurface::Fitting(finish) => Finish::ALL.get(finish).map_or(PlainMaterial::PAINT, |finish| {
                PlainMaterial { colour: finish.colour(), roughness: finish.roughness() }
            }),
            _ => file.clean_wall,
        };
        textured.map_or(Cover::Plain(name, plain), Cover::Textured)
    }

    pub fn name(&self) -> &str {
        match self {
            Cover::Textured(images) => &images.name,
            Cover::Plain(name, _) => name,
        }
    }
}

/// A name for programs: letters, digits and `_`, no digit first.
pub(super) fn identifier(name: &str) -> String {
    let plain = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let digit_first = name.chars().next().is_none_or(|c| c.is_ascii_digit());
    digit_first.then_some('_').into_iter().chain(plain).collect()
}
