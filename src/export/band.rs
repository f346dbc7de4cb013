//! A band of blocks across a tile: resolves, compresses and writes it.

use std::io::{self, Seek, Write};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::busy::BusyTime;
use super::error::ExportError;
use super::exr_tiles::{ExrWriter, Samples, TileEncoder};
use super::layout::BLOCK;
use super::output::OutputFile;
use super::png::{Pixels, PngWriter};
use super::reduced::ReducedBlock;
use super::targets::Covered;
use crate::look::{Background, FLAT, ResolvedBlock};
use crate::math::exp_f32;
use crate::math::srgb::{from_linear, to_linear};

/// A kind of image that a texture consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Image {
    /// Base colour, sRGB.
    BaseColor,
    /// Three masks of dirt, packed as red, green and blue.
    ///
    /// Alpha stays unused: many programs multiply colours by alpha when they load an image.
    Mask(Covered),
    /// The fourth mask, in its own image.
    LoneMask(Covered),
    /// What rubs on walls, one by one: arms, shoulders, bags as red, green and blue.
    Rub,
    /// Wear, heel marks, height of a floor as red, green and blue.
    Wear,
    /// The floor's normal; whether green points down, as DirectX has it.
    Normal(GreenPoints),
    /// Occlusion, roughness, metallic.
    Orm,
    /// Metallic, occlusion, detail, smoothness.
    MaskMap,
    /// Colour of the surface without dirt, sRGB.
    Clean,
    /// Colour of the dirt on it, sRGB, and its opacity.
    Dirt,
}

impl Image {
    pub(super) fn pixels(self) -> Pixels {
        match self {
            Image::BaseColor | Image::Clean => Pixels::Srgb,
            Image::Dirt => Pixels::Srgb4,
            Image::MaskMap => Pixels::Linear4,
            Image::Mask(_) | Image::Orm | Image::Rub | Image::Wear | Image::Normal(_) => Pixels::Linear3,
            Image::LoneMask(_) => Pixels::Linear1,
        }
    }

    /// Copies the pixels of texels `from..` of a block, as many as `out` holds.
    fn copy(self, BandBlock { texels: block, rub, .. }: &BandBlock, from: usize, out: &mut [u8]) {
        let bytes = self.pixels().bytes();
        let copy = |all: &[u8], out: &mut [u8]| out.copy_from_slice(&all[from * bytes..from * bytes + out.len()]);
        match self {
            Image::BaseColor => copy(block.base_color.as_flattened(), out),
            Image::Mask(covered) => {
                let [red, green, blue] = covered.packed_masks();
                for (pixel, masks) in out.as_chunks_mut().0.iter_mut().zip(&block.mask[from..]) {
                    *pixel = [masks[red], masks[green], masks[blue]];
                }
            }
            Image::LoneMask(covered) => {
                let kind = covered.lone_mask();
                for (pixel, masks) in out.iter_mut().zip(&block.mask[from..]) {
                    *pixel = masks[kind];
                }
            }
            Image::Wear => copy_relief(&block.relief, from, out, wear),
            Image::Normal(green) => copy_relief(&block.relief, from, out, |relief| normal(relief, green)),
            Image::Rub if rub.is_empty() => out.fill(0),
            Image::Rub => copy(rub.as_flattened(), out),
            Image::Orm => copy(block.orm.as_flattened(), out),
            Image::MaskMap => {
                for (pixel, &orm) in out.as_chunks_mut().0.iter_mut().zip(&block.orm[from..]) {
                    *pixel = mask_map(orm);
                }
            }
            Image::Clean => {
                for (k, pixel) in (from..).zip(out.as_chunks_mut().0) {
                    *pixel = clean(block, k);
                }
            }
            Image::Dirt => {
                for (k, pixel) in (from..).zip(out.as_chunks_mut().0) {
                    *pixel = dirt(block.base_color[k], clean(block, k));
                }
            }
        }
    }

    /// Returns a row of an empty block.
    fn background(self, background: &Background) -> Vec<u8> {
        match self {
            Image::BaseColor => background.base_color.repeat(BLOCK),
            Image::Mask(covered) => covered.packed_masks().map(|kind| background.mask[kind]).repeat(BLOCK),
            Image::LoneMask(covered) => vec![background.mask[covered.lone_mask()]; BLOCK],
            Image::Rub => vec![0; 3 * BLOCK],
            Image::Wear => wear(FLAT).repeat(BLOCK),
            Image::Normal(green) => normal(FLAT, green).repeat(BLOCK),
            Image::Orm => background.orm.repeat(BLOCK),
            Image::MaskMap => mask_map(background.orm).repeat(BLOCK),
            Image::Clean => background.base_color.repeat(BLOCK),
            Image::Dirt => dirt(background.base_color, background.base_color).repeat(BLOCK),
        }
    }
}

/// Where the green of a normal map points in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GreenPoints {
    /// As OpenGL has it.
    Up,
    /// As DirectX has it.
    Down,
}

/// Sets pixels from the relief of texels from `from` on; without any the surface is flat.
fn copy_relief(relief: &[[u8; 6]], from: usize, out: &mut [u8], pixel: impl Fn([u8; 6]) -> [u8; 3]) {
    let pixels = out.as_chunks_mut().0;
    if relief.is_empty() {
        pixels.fill(pixel(FLAT));
    } else {
        pixels.iter_mut().zip(&relief[from..]).for_each(|(out, relief)| *out = pixel(*relief));
    }
}

fn wear([wear, marks, height, ..]: [u8; 6]) -> [u8; 3] {
    [wear, marks, height]
}

fn normal([_, _, _, x, y, z]: [u8; 6], green: GreenPoints) -> [u8; 3] {
    [x, if green == GreenPoints::Up { y } else { u8::MAX - y }, z]
}

/// Colour of the surface without dirt, as far as the block tells it.
fn clean(block: &ResolvedBlock, k: usize) -> [u8; 3] {
    block.clean.get(k).map_or(block.base_color[k], |light| light.map(from_linear))
}

/// How dark, and how light, thick dirt is beside the surface under it: of that, and of what that lacks to white.
const THICK: [f32; 2] = [0.3, 0.3];

/// Colour and opacity of dirt that make `clean` the colour that is `shown`, laid over in linear light.
///
/// Many pairs do. This is the least opacity for which no channel of the dirt is farther from the clean one than thick dirt
/// is, so that it is dirt on other surfaces too.
fn dirt(shown: [u8; 3], clean: [u8; 3]) -> [u8; 4] {
    const MOST: f32 = 65_535.0;
    // What is lighter by two levels is dither.
    let is_dither =
        |k: usize| shown[k].abs_diff(clean[k]) <= 1 || (clean[k]..=clean[k].saturating_add(2)).contains(&shown[k]);
    let [light, ground] = [shown, clean].map(|colour| colour.map(|byte| f32::from(to_linear(byte)) / MOST));
    let thick = |k: usize, is_lighter: bool| match is_lighter {
        true => ground[k] + THICK[1] * (1.0 - ground[k]),
        false => THICK[0] * ground[k],
    };
    let needed = |k: usize| match light[k] - ground[k] {
        _ if is_dither(k) => 0.0,
        change => change / (thick(k, change > 0.0) - ground[k]),
    };
    let opacity = (0..3).map(needed).fold(0.0, f32::max).min(1.0);
    let alpha = (255.0 * opacity).ceil();
    let share = alpha / 255.0;
    let colour = |k: usize| match alpha {
        0.0 => thick(k, false),
        _ => (ground[k] + (light[k] - ground[k]) / share).clamp(0.0, 1.0),
    };
    let [red, green, blue] = [0, 1, 2].map(|k| from_linear((MOST * colour(k) + 0.5) as u16));
    [red, green, blue, alpha as u8]
}

/// Packs Unity's mask map: metallic, occlusion, detail (always 1), smoothness.
fn mask_map([occlusion, roughness, metallic]: [u8; 3]) -> [u8; 4] {
    [metallic, occlusion, u8::MAX, u8::MAX - roughness]
}

/// Opacity 1 - exp(-D) of the layers of arms, shoulders and bags; empty where they are clean.
pub(super) fn rub(block: &ResolvedBlock) -> Vec<[u8; 3]> {
    let of = |name: &str| block.layers.iter().find(|layer| layer.name == name).map(|layer| layer.values.as_slice());
    let layers = ["arm", "shoulder", "bag"].map(|name| of(name).unwrap_or_default());
    if layers.iter().all(|values| values.iter().all(|&density| density == 0.0)) {
        return Vec::new();
    }
    let byte = |values: &[f32], k: usize| {
        let density = values.get(k).copied().unwrap_or(0.0);
        if density > 0.0 { (255.0 * (1.0 - exp_f32(-density)) + 0.5) as u8 } else { 0 }
    };
    (0..block.orm.len()).map(|k| layers.map(|values| byte(values, k))).collect()
}

/// Up to [`BLOCK`] rows across a tile, in blocks from the left.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) blocks: Vec<BandBlock>,
}

/// A resolved block with its layers already compressed.
#[derive(Clone, Debug, Default)]
pub(super) struct BandBlock {
    /// Its images; `layers` is empty.
    pub(super) texels: ResolvedBlock,
    /// The layers as a tile of each EXR file.
    pub(super) layers: Vec<Vec<u8>>,
    /// Opacity of what arms, shoulders and bags left; empty where that is nothing.
    pub(super) rub: Vec<[u8; 3]>,
    /// Its masks with 16 bits, if requested.
    pub(super) fine: Vec<(Image, Vec<u8>)>,
    /// Its images, reduced, if requested.
    pub(super) reduced: Option<ReducedBlock>,
}

impl Band {
    /// Resolves all blocks of a band of `width` x `height` texels in parallel.
    ///
    /// `resolve` takes the first column of a block and its width.
    pub(super) fn fill(&mut self, [width, height]: [usize; 2], resolve: impl Fn(usize, usize) -> BandBlock + Sync) {
        (self.width, self.height) = (width, height);
        self.blocks.resize_with(width.div_ceil(BLOCK), BandBlock::default);
        self.blocks.par_iter_mut().enumerate().with_max_len(1).for_each(|(k, block)| {
            *block = resolve(k * BLOCK, BLOCK.min(width - k * BLOCK));
        });
    }

    pub(super) fn is_empty(&self) -> bool {
        self.blocks.iter().all(|block| block.texels.empty)
    }

    /// Writes the pixels of one row, counted from above. `background` is a row of an empty block.
    fn row(&self, image: Image, pixels: Pixels, background: &[u8], y: usize, out: &mut [u8]) {
        for (block, out) in self.blocks.iter().zip(out.chunks_mut(BLOCK * pixels.bytes())) {
            if block.texels.empty {
                out.copy_from_slice(&background[..out.len()]);
            } else if let Some((_, fine)) = block.fine.iter().find(|(fine, _)| *fine == image) {
                let from = (self.height - 1 - y) * out.len();
                out.copy_from_slice(&fine[from..from + out.len()]);
            } else {
                let width = out.len() / image.pixels().bytes();
                image.copy(block, (self.height - 1 - y) * width, out);
            }
        }
    }
}

/// A pool of buffers that threads borrow and return.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Pool<T> {
        Pool(Mutex::default())
    }
}

impl<T> Pool<T> {
    /// Runs `work` on a free buffer, or on a new one from `make`.
    pub(super) fn with<R>(&self, make: impl FnOnce() -> T, work: impl FnOnce(&mut T) -> R) -> R {
        let taken = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut buffer = taken.unwrap_or_else(make);
        let result = work(&mut buffer);
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(buffer);
        result
    }
}

/// The channels of an EXR file and the layers that they hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LayerFile {
    /// Channel names, sorted as EXR requires, each with the index of its layer.
    ///
    /// `None` marks a channel without a layer, which only exists because readers expect it.
    channels: Vec<(String, Option<usize>)>,
}

impl LayerFile {
    /// Puts all layers into one file, each as the channel `V` (value) of an EXR layer of its name.
    ///
    /// Blender shows a channel without a dot in its name as a black image; Nuke and others list it among the rest.
    pub(super) fn by_name(layers: &[&'static str]) -> Vec<LayerFile> {
        let mut channels: Vec<_> = layers.iter().enumerate().map(|(k, name)| (format!("{name}.V"), Some(k))).collect();
        channels.sort();
        vec![LayerFile { channels }]
    }

    /// Puts four layers into each file, as R, G, B, A. R, G and B always exist, because some readers require them.
    pub(super) fn by_colour(layers: &[&'static str]) -> Vec<LayerFile> {
        let indices: Vec<usize> = (0..layers.len()).collect();
        let file = |layers: &[usize]| {
            let named = |(k, name): (usize, &str)| (name.to_string(), layers.get(k).copied());
            let mut channels: Vec<_> =
                ["R", "G", "B", "A"].into_iter().enumerate().take(layers.len().max(3)).map(named).collect();
            channels.sort();
            LayerFile { channels }
        };
        indices.chunks(4).map(file).collect()
    }

    /// Channel names, each with the index of its layer.
    pub(super) fn channels(&self) -> &[(String, Option<usize>)] {
        &self.channels
    }

    fn names(&self) -> Vec<String> {
        self.channels.iter().map(|(name, _)| name.clone()).collect()
    }
}

/// Compresses the layers of blocks.
#[derive(Debug)]
pub(super) struct LayerEncoder {
    files: Vec<LayerFile>,
    pool: Pool<TileEncoder>,
    /// The tile of an empty block of full size, file by file.
    blank: Vec<Vec<u8>>,
}

impl LayerEncoder {
    pub(super) fn new(files: Vec<LayerFile>) -> LayerEncoder {
        let mut encoder = LayerEncoder { files, pool: Pool::default(), blank: Vec::new() };
        encoder.blank = encoder.zeros(BLOCK, BLOCK);
        encoder
    }

    pub(super) fn files(&self) -> &[LayerFile] {
        &self.files
    }

    /// Compresses a block to one tile per file.
    pub(super) fn encode(&self, block: &ResolvedBlock, width: usize, height: usize) -> Vec<Vec<u8>> {
        if block.empty {
            return if (width, height) == (BLOCK, BLOCK) { self.blank.clone() } else { self.zeros(width, height) };
        }
        let zeros = vec![0.0; width * height];
        let values =
            |(_, layer): &(String, Option<usize>)| layer.map_or(&zeros, |k| &block.layers[k].values).as_slice();
        let encode = |file: &LayerFile| {
            let layers: Vec<&[f32]> = file.channels.iter().map(values).collect();
            self.pool.with(TileEncoder::default, |encoder| encoder.half(&layers, width))
        };
        self.files.iter().map(encode).collect()
    }

    fn zeros(&self, width: usize, height: usize) -> Vec<Vec<u8>> {
        let zeros = vec![0.0; width * height];
        let tile = |file: &LayerFile| TileEncoder::default().half(&vec![zeros.as_slice(); file.channels.len()], width);
        self.files.iter().map(tile).collect()
    }
}

/// Paths of a texture's files, relative to the bake.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct TextureFiles {
    /// One for each image.
    pub(super) images: Vec<(Image, String)>,
    /// One for each of the encoder's files.
    pub(super) layers: Vec<String>,
}

impl TextureFiles {
    pub(super) fn image(&self, wanted: Image) -> Option<String> {
        self.images.iter().find(|(image, _)| *image == wanted).map(|(_, name)| name.clone())
    }
}

/// An image of a texture that is being written.
#[derive(Debug)]
struct ImageFile<W: Write + Send + 'static> {
    image: Image,
    pixels: Pixels,
    /// A row of an empty block.
    background: Vec<u8>,
    /// A row across the texture.
    row: Vec<u8>,
    png: PngWriter<W>,
}

impl<W: Write + Send> ImageFile<W> {
    /// Appends the rows of a band from above.
    fn push(&mut self, band: &Band) -> io::Result<()> {
        (0..band.height).try_for_each(|y| {
            band.row(self.image, self.pixels, &self.background, y, &mut self.row);
            self.png.push(&self.row)
        })
    }
}

/// Pixels of an image with 16 bits, and a row of an empty block.
pub(super) type FineForm = (Pixels, Vec<u8>);

/// Writes the files of one texture, band by band from above.
#[derive(Debug)]
pub(super) struct TileWriter<W: Write + Seek + Send + 'static> {
    images: Vec<ImageFile<W>>,
    layers: Vec<ExrWriter<W>>,
}

impl<W: Write + Seek + Send> TileWriter<W> {
    /// Creates the files of a texture and writes their headers. `is_small` is whether its PNG files are to be small.
    pub(super) fn begin(
        [width, height]: [usize; 2],
        files: &TextureFiles,
        background: &Background,
        (layers, fine, is_small): (Option<&LayerEncoder>, &dyn Fn(Image) -> Option<FineForm>, bool),
        create: impl Fn(&str) -> Result<W, ExportError>,
    ) -> Result<TileWriter<W>, ExportError> {
        let mut writer = TileWriter { images: Vec::new(), layers: Vec::new() };
        for &(image, ref name) in &files.images {
            let (pixels, background) = fine(image).unwrap_or_else(|| (image.pixels(), image.background(background)));
            let png = PngWriter::begin(create(name)?, pixels, [width as u32, height as u32], is_small);
            let row = vec![0; width * pixels.bytes()];
            writer.images.push(ImageFile { image, pixels, background, row, png: png.map_err(OutputFile::explain)? });
        }
        for (file, name) in layers.map_or(&[][..], LayerEncoder::files).iter().zip(&files.layers) {
            let begun = ExrWriter::begin(create(name)?, Samples::Half, width, height, &file.names());
            writer.layers.push(begun.map_err(OutputFile::explain)?);
        }
        Ok(writer)
    }

    /// Appends a band; each image is compressed on a thread of its own.
    pub(super) fn push(&mut self, band: &Band, busy: &BusyTime) -> io::Result<()> {
        let compress = |image: &mut ImageFile<W>| busy.measure(|| image.push(band));
        let pushed: Vec<_> = self.images.par_iter_mut().with_max_len(1).map(compress).collect();
        pushed.into_iter().collect::<io::Result<()>>()?;
        busy.measure(|| {
            for block in &band.blocks {
                self.layers.iter_mut().zip(&block.layers).try_for_each(|(file, tile)| file.push(tile))?;
            }
            Ok(())
        })
    }

    /// Finishes the files.
    pub(super) fn finish(self) -> io::Result<()> {
        for image in self.images {
            image.png.finish()?;
        }
        for layers in self.layers {
            layers.finish()?.flush()?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::SplitMix64;

    #[test]
    fn dirt_over_the_clean_colour_is_the_shown_one() {
        let mut random = SplitMix64::new(5);
        let mut byte = move || (random.unit() * 256.0) as u8;
        for _ in 0..20_000 {
            let [shown, clean]: [[u8; 3]; 2] = std::array::from_fn(|_| std::array::from_fn(|_| byte()));
            let [colour @ .., alpha] = dirt(shown, clean);
            for k in 0..3 {
                let [ground, over] = [clean[k], colour[k]].map(|byte| f64::from(to_linear(byte)));
                let laid = from_linear((ground + (over - ground) * f64::from(alpha) / 255.0 + 0.5) as u16);
                assert!(laid.abs_diff(shown[k]) <= 2, "{laid} for {shown:?} on {clean:?}: {colour:?} {alpha}");
            }
        }
        // What is dither is no dirt; black rubber hides the floor.
        assert_eq!(dirt([200, 199, 201], [199, 199, 199])[3], 0);
        assert_eq!(dirt([20, 20, 20], [200, 200, 200])[3], 255);
        // Soil on vinyl takes no more than it needs, and has a colour that shows on a dark floor.
        let [red, _, _, alpha] = dirt([170, 165, 155], [197, 192, 181]);
        assert!((80..130).contains(&alpha) && (100..130).contains(&red), "{red} {alpha}");
    }
}
