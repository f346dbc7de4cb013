//! A scene as glTF 2.0 in one binary file (Khronos Group, "glTF 2.0 Specification", section 4.4).

use std::io::{self, Write};

use image::RgbImage;

use super::{Part, Scene, Surface};
use crate::look::Srgb8;

mod document;
mod picture;
#[cfg(test)]
mod tests;

use document::Document;

/// What the parts of a scene look like and what the file says of itself.
#[derive(Clone, Debug)]
pub struct GlbOptions<'a> {
    /// Name of the node that holds everything: the plan's.
    pub name: String,
    /// Seed of the bake.
    pub seed: u64,
    /// Textures of [`Surface::FloorTile`], in its order.
    pub floor: Vec<SurfaceImages<'a>>,
    /// Textures of [`Surface::WallSheet`], in its order.
    pub walls: Vec<SurfaceImages<'a>>,
    /// [`Surface::WallTop`].
    pub wall_top: PlainMaterial,
    /// [`Surface::Lintel`]: the clean wall.
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
}

/// Where an image is.
#[derive(Clone, Copy, Debug)]
pub enum GlbImage<'a> {
    /// In a file beside the scene: its path relative to the scene's folder, with `/` between its parts.
    File(&'a str),
    /// In the scene itself, made smaller if need be, see [`MOST_EMBEDDED_PX`]. Row 0 is the upper one.
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
    /// What is solid, as drawings show it: darker than any wall, so that a plan can be read from above.
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

/// Writes a scene as one glTF 2.0 binary: +Y up, metres, plan (x, y) and height h at `(x, h, -y)`.
///
/// A node for the plan, with generator, version and seed in its `extras`, has a node with a mesh for each part.
/// Materials have base colour and occlusion, roughness and metallic; textures are clamped to their edge and want
/// mip-maps. The same input gives the same bytes.
///
/// # Errors
/// What the writer says; a scene of more than 4 GiB, which the format cannot hold.
pub fn write_glb(out: &mut impl Write, scene: &Scene, options: &GlbOptions) -> io::Result<()> {
    let document = Document::new(scene, options)?;
    let mut json = document.json();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary_length = document.binary_length();
    let total = 12 + 8 + json.len() + 8 + binary_length;
    let length = |bytes: usize| {
        let too_large = |_| io::Error::new(io::ErrorKind::FileTooLarge, "a scene.glb cannot hold more than 4 GiB");
        u32::try_from(bytes).map(u32::to_le_bytes).map_err(too_large)
    };
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&length(total)?)?;
    out.write_all(&length(json.len())?)?;
    out.write_all(b"JSON")?;
    out.write_all(&json)?;
    out.write_all(&length(binary_length)?)?;
    out.write_all(b"BIN\0")?;
    document.write_binary(out)
}

/// Plan frame to glTF's.
fn y_up([x, y, height]: [f32; 3]) -> [f32; 3] {
    // Adding zero turns -0 into 0.
    [x, height, -y + 0.0]
}

/// Whether 16 bits are enough for a part's indices; 65535 has a meaning of its own.
fn has_short_indices(part: &Part) -> bool {
    part.positions_m.len() <= usize::from(u16::MAX)
}

/// What stands for a surface in the file.
enum Cover<'a> {
    Textured(&'a SurfaceImages<'a>),
    Plain(&'static str, PlainMaterial),
}

impl<'a> Cover<'a> {
    fn of(surface: Surface, options: &'a GlbOptions<'a>) -> Cover<'a> {
        let textured = match surface {
            Surface::FloorTile(tile) => options.floor.get(tile),
            Surface::WallSheet(sheet) => options.walls.get(sheet),
            Surface::WallTop | Surface::Lintel => None,
        };
        let name = match surface {
            Surface::FloorTile(_) => "floor",
            Surface::WallSheet(_) => "wall",
            Surface::WallTop => "wall_tops",
            Surface::Lintel => "clean_wall",
        };
        let plain = if surface == Surface::WallTop { options.wall_top } else { options.clean_wall };
        textured.map_or(Cover::Plain(name, plain), Cover::Textured)
    }

    fn name(&self) -> &str {
        match self {
            Cover::Textured(images) => &images.name,
            Cover::Plain(name, _) => name,
        }
    }
}
