//! The textures of floor and walls, as files.

use super::bake_path::BakePath;
use super::band::Image;
use super::birdseye::Birdseye;
use super::layout::{Naming, TileLayout};
use super::manifest::{FloorEntry, SumsEntry, TileEntry};
use super::options::TextureOptions;
use super::source::TextureSource;
use super::targets::{Covered, Number, Target, WorldEntry};
use super::{ExportError, OutputFolder, Reduced};
use crate::progress::Progress;
use crate::stamps::TexelGrid;

mod walls;
mod writer;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod wall_tests;

pub use walls::{WallTextures, wall_textures};
use writer::{Canvas, TextureWriter};

/// How far the look continues beyond the floor's edge and around strips of wall, texels.
pub const PADDING_PX: u32 = 16;

/// What was written of a floor.
#[derive(Debug)]
pub struct FloorTextures {
    /// Layout of the tiles.
    pub layout: TileLayout,
    /// The tiles that hold floor; other tiles have no files.
    pub tiles: Vec<TileEntry>,
    /// The target program.
    pub target: Target,
    /// Bits per channel of masks, wear and height.
    pub bits: u32,
    /// Whether the clean surface and the dirt on it are images of their own.
    pub dirt: bool,
    /// Names of the layers that were written.
    pub layers: Vec<&'static str>,
    /// Reduced images of each of `tiles`, if requested.
    pub reduced: Vec<Reduced>,
    /// Overview of the floor.
    pub birdseye: Birdseye,
    /// Time that threads spent on resolving, seconds.
    pub look_busy_s: f64,
    /// Time that threads spent on compressing and writing, seconds.
    pub export_busy_s: f64,
}

impl FloorTextures {
    /// Returns the floor's entry for the manifest.
    pub fn entry(&self, sums: SumsEntry) -> FloorEntry {
        let grid = self.layout.grid;
        let masks = [
            "film: dirt of everybody who ever walked",
            "passes n of everybody who ever walked",
            "fresh prints, stains and drips",
            "edge and dust: dirt where nobody walks",
        ];
        let of_layer = |layer: &str| match layer {
            "passes" | "presence" => "footfalls of the simulated people",
            "dwell" => "seconds that the simulated people stood",
            "grind" => "passes of wear that turns and stops of the simulated people add",
            "wheels" => "wheels of the simulated people that rolled over, more where they turn",
            _ => "optical density D",
        };
        FloorEntry {
            texels_per_metre: grid.texels_per_metre,
            width_px: grid.width,
            height_px: grid.height,
            tile_px: [self.layout.width, self.layout.height],
            naming: self.layout.naming(),
            padding_px: PADDING_PX,
            channels: self.target.channels(
                (Covered::Floor, self.bits, self.dirt),
                "colour of the trodden floor",
                masks,
                &self.layers,
                of_layer,
            ),
            tiles: self.tiles.clone(),
            sums,
        }
    }
}

/// Resolves a floor and writes its textures into `floor/`, band by band from above.
///
/// Runs on the current rayon pool: it resolves the next band while it compresses and writes one. Memory holds the
/// images of two bands of 256 rows, whatever the floor's size, and the reduced images.
///
/// # Errors
/// A tile size out of range or beyond the target's limit; a file that cannot be written; an interruption.
pub fn floor_textures(
    folder: &OutputFolder,
    grid: TexelGrid,
    source: &impl TextureSource,
    options: &TextureOptions,
    progress: &dyn Progress,
) -> Result<FloorTextures, ExportError> {
    options.check()?;
    let layout = TileLayout::new(grid, options.tile)?;
    let writer = TextureWriter::new(folder, source.layers(), options, progress);
    let birdseye = Birdseye::new(grid);
    let (mut tiles, mut reduced) = (Vec::new(), Vec::new());
    let count = f64::from(layout.columns() * layout.rows());
    for (index, tile) in layout.tiles().enumerate() {
        let number = match layout.naming() {
            Naming::Udim => Number::Udim(tile.udim()),
            Naming::Uv => Number::Uv(tile.u, tile.v),
        };
        let canvas = Canvas {
            corner: [i64::from(tile.i0), i64::from(tile.j0)],
            size: [tile.width, tile.height],
            files: writer.files(Covered::Floor, number),
            even_if_empty: false,
            part: [index as f64 / count, (index + 1) as f64 / count],
        };
        let seen = |corner, size, block: &_| birdseye.add(corner, size, block);
        let Some(written) = writer.write(source, &canvas, &seen)? else { continue };
        reduced.extend(written.reduced);
        let place = layout.place_m(&tile);
        let file = |image| canvas.files.image(image).unwrap_or_default();
        tiles.push(TileEntry {
            u: tile.u,
            v: tile.v,
            udim: (layout.naming() == Naming::Udim).then(|| tile.udim()),
            min_m: place.min,
            max_m: place.max,
            world: Some(WorldEntry::of(options.target, place)),
            basecolor: file(Image::BaseColor),
            mask: file(Image::Mask(Covered::Floor)),
            passes: file(Image::LoneMask(Covered::Floor)),
            wear: file(Image::Wear),
            normal: file(options.target.normal()),
            orm: file(Image::Orm),
            mask_map: canvas.files.image(Image::MaskMap),
            clean: canvas.files.image(Image::Clean),
            dirt: canvas.files.image(Image::Dirt),
            layers: canvas.files.layers,
            sums: BakePath::new(format!("sums/{}", layout.file_name(&tile, "sums", "exr")))?,
        });
    }
    Ok(FloorTextures {
        layout,
        tiles,
        target: options.target,
        bits: options.bits,
        dirt: options.dirt,
        layers: if options.writes_layers() { source.layers().to_vec() } else { Vec::new() },
        reduced,
        look_busy_s: writer.look_busy.seconds(),
        export_busy_s: writer.export_busy.seconds(),
        birdseye,
    })
}
