use image::RgbImage;

use crate::math::srgb::Srgb8;

/// Materials of a scene and metadata of the glTF file.
#[derive(Clone, Debug)]
pub struct GlbOptions<'a> {
    /// Name of the node that holds everything: the plan's.
    pub name: String,
    /// Seed of the bake.
    pub seed: u64,
    /// Textures of [`SceneSurface::FloorTile`](crate::show::scene::SceneSurface::FloorTile), in its order.
    pub floor: Vec<SurfaceImages<'a>>,
    /// Textures of [`SceneSurface::WallSheet`](crate::show::scene::SceneSurface::WallSheet), in its order.
    pub walls: Vec<SurfaceImages<'a>>,
    /// [`SceneSurface::WallTop`](crate::show::scene::SceneSurface::WallTop).
    pub wall_top: PlainMaterial,
    /// [`SceneSurface::Lintel`](crate::show::scene::SceneSurface::Lintel): the clean wall.
    pub clean_wall: PlainMaterial,
}

/// The textures of one tile or sheet.
#[derive(Clone, Debug)]
pub struct SurfaceImages<'a> {
    /// Name of node, mesh and material, such as `floor_1001`.
    pub name: String,
    /// Base colour, sRGB.
    pub base_color: GlbImage<'a>,
    /// Occlusion, roughness, metallic, linear.
    pub orm: GlbImage<'a>,
    /// Normals in tangent space, green up; linear.
    pub normal: Option<GlbImage<'a>>,
}

/// The source of a texture image: a file or an image in memory.
#[derive(Clone, Copy, Debug)]
pub enum GlbImage<'a> {
    /// A file beside the scene: its path relative to the scene's folder, with `/` between its parts.
    File(&'a str),
    /// An image embedded in the scene, reduced to [`MOST_EMBEDDED_PX`]. Row 0 is the upper one.
    Embedded(&'a RgbImage),
}

/// Greatest width and height of an image within the scene, texels. A larger one is halved until it fits.
pub const MOST_EMBEDDED_PX: u32 = 2048;

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
}

impl Default for GlbOptions<'_> {
    fn default() -> Self {
        GlbOptions {
            name: "plan".to_string(),
            seed: 0,
            floor: Vec::new(),
            walls: Vec::new(),
            wall_top: PlainMaterial::CUT,
            clean_wall: PlainMaterial::PAINT,
        }
    }
}
