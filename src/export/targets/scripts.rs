use super::Target;
use crate::export::manifest::{Manifest, SheetEntry, TileEntry};
use crate::export::{ExportError, OutputFolder};

/// A file in `shaders/`: name and content.
type Script = (&'static str, &'static str);

impl Target {
    /// Returns the shaders that lay masks over a floor, and scripts that set texture flags.
    fn scripts(self) -> &'static [Script] {
        match self {
            Target::Gltf => &[("trodden_masks.glsl", include_str!("files/trodden_masks.glsl"))],
            Target::Blender => &[("trodden_blender.py", include_str!("files/trodden_blender.py"))],
            Target::Unreal => &[
                ("trodden_dirt.hlsl", include_str!("files/trodden_dirt.hlsl")),
                ("trodden_mix.hlsl", include_str!("files/trodden_mix.hlsl")),
                ("trodden_wall.hlsl", include_str!("files/trodden_wall.hlsl")),
                ("trodden_unreal.py", include_str!("files/trodden_unreal.py")),
            ],
            Target::Unity => &[
                ("TroddenDirt.hlsl", include_str!("files/TroddenDirt.hlsl")),
                // Unity compiles files in a folder `Editor` for the editor only.
                ("Editor/TroddenImporter.cs", include_str!("files/TroddenImporter.cs")),
            ],
            Target::Godot => &[
                ("trodden_floor.gdshader", include_str!("files/trodden_floor.gdshader")),
                ("trodden_wall.gdshader", include_str!("files/trodden_wall.gdshader")),
                ("trodden_setup.gd", include_str!("files/trodden_setup.gd")),
            ],
        }
    }
}

/// Writes shaders and scripts for the manifest's target into `shaders/`.
///
/// Shaders lay the masks over an artist's own floor in world space; scripts set the textures' flags. Godot also gets
/// import settings beside each image. All read their numbers from the manifest.
///
/// # Errors
/// A file cannot be written.
pub fn write_target_files(folder: &OutputFolder, manifest: &Manifest) -> Result<(), ExportError> {
    let target = manifest.target.name;
    for (name, text) in target.scripts() {
        folder.write(&format!("shaders/{name}"), text.as_bytes())?;
    }
    if target == Target::Godot {
        for (file, settings) in godot_imports(manifest) {
            folder.write(&format!("{file}.import"), settings.as_bytes())?;
        }
        for name in GODOT_IGNORES {
            folder.write(&format!("{name}/.gdignore"), b"")?;
        }
    }
    Ok(())
}

/// Folders for a `.gdignore`: Godot would import every image in them, sums as HDR textures.
const GODOT_IGNORES: [&str; 2] = ["preview", "sums"];

/// Returns every image of a bake with its import settings for Godot 4.
fn godot_imports(manifest: &Manifest) -> Vec<(&str, String)> {
    let (tiles, sheets) = (&manifest.floor.tiles, manifest.walls.iter().flat_map(|walls| &walls.sheets));
    let images = tiles.iter().flat_map(TileEntry::images).chain(sheets.clone().flat_map(SheetEntry::images));
    let layers = tiles.iter().flat_map(|tile| &tile.layers).chain(sheets.flat_map(|sheet| &sheet.layers));
    let images = images.map(|file| (file.as_str(), godot_import(GodotCompression::Vram)));
    let layers = layers.map(|file| (file.as_str(), godot_import(GodotCompression::None)));
    images.chain(layers).collect()
}

#[derive(Clone, Copy)]
enum GodotCompression {
    /// BC7 or ASTC.
    Vram,
    /// No compression: block compression of half floats has no alpha.
    None,
}

/// Returns import settings: full size, mip-maps, alpha unchanged. The shader's sampler hint sets the colour space.
fn godot_import(compression: GodotCompression) -> String {
    let mode = match compression {
        GodotCompression::Vram => 2,
        GodotCompression::None => 3,
    };
    format!(
        "[remap]\n\nimporter=\"texture\"\ntype=\"CompressedTexture2D\"\n\n[params]\n\n\
         compress/mode={mode}\ncompress/high_quality=true\ncompress/normal_map=2\ncompress/channel_pack=0\n\
         mipmaps/generate=true\nmipmaps/limit=-1\nroughness/mode=1\nprocess/fix_alpha_border=false\n\
         process/premult_alpha=false\nprocess/hdr_as_srgb=false\nprocess/hdr_clamp_exposure=false\n\
         process/size_limit=0\ndetect_3d/compress_to=0\n"
    )
}
