use std::io::{self, Write};

use super::document::GltfDocument;
use crate::show::scene::file::SceneFile;
use crate::show::scene::model::Scene;

/// Writes a scene as one glTF 2.0 binary: +Y up, metres, plan (x, y) and height h at `(x, h, -y)`.
///
/// A node for the plan, with generator, version and seed in its `extras`, has a node with a mesh for each part.
/// Materials have base colour and occlusion, roughness and metallic; textures are clamped to their edge and want
/// mip-maps. The same input gives the same bytes.
///
/// # Errors
/// The writer's error; a scene of more than 4 GiB, which the format cannot hold.
pub fn write_glb(out: &mut impl Write, scene: &Scene, file: &SceneFile) -> io::Result<()> {
    let document = GltfDocument::new(scene, file)?;
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
