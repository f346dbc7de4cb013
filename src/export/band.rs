//! A band of blocks across a tile: resolves, compresses and writes it.

use std::io::{self, Seek, Write};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::busy::BusyTime;
use super::error::ExportError;
use super::exr_tiles::{ExrWriter, Samples, TileEncoder};
use super::layout::BLOCK;
use super::output::OutputFile;
use super::png::{Pixels, PngWriter, Strip, StripEncoder};
use super::reduced::ReducedBlock;
use super::targets::Covered;
use crate::look::{Background, ResolvedBlock};

/// Rows compressed together: few enough for the cache and to keep eight threads busy.
const STRIP: usize = 32;

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
    /// Occlusion, roughness, metallic.
    Orm,
    /// Metallic, occlusion, detail, smoothness.
    MaskMap,
}

impl Image {
    pub(super) fn pixels(self) -> Pixels {
        match self {
            Image::BaseColor => Pixels::Srgb,
            Image::MaskMap => Pixels::Linear4,
            Image::Mask(_) | Image::Orm => Pixels::Linear3,
            Image::LoneMask(_) => Pixels::Linear1,
        }
    }

    /// Copies the pixels of texels `from..` of a block, as many as `out` holds.
    fn copy(self, block: &ResolvedBlock, from: usize, out: &mut [u8]) {
        let bytes = self.pixels().bytes();
        let copy = |all: &[u8], out: &mut [u8]| out.copy_from_slice(&all[from * bytes..from * bytes + out.len()]);
        match self {
            Image::BaseColor => copy(block.base_color.as_flattened(), out),
            Image::Mask(covered) => {
                for (pixel, masks) in out.as_chunks_mut().0.iter_mut().zip(&block.mask[from..]) {
                    *pixel = covered.packed_masks().map(|kind| masks[kind]);
                }
            }
            Image::LoneMask(covered) => {
                for (pixel, masks) in out.iter_mut().zip(&block.mask[from..]) {
                    *pixel = masks[covered.lone_mask()];
                }
            }
            Image::Orm => copy(block.orm.as_flattened(), out),
            Image::MaskMap => {
                for (pixel, &orm) in out.as_chunks_mut().0.iter_mut().zip(&block.orm[from..]) {
                    *pixel = mask_map(orm);
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
            Image::Orm => background.orm.repeat(BLOCK),
            Image::MaskMap => mask_map(background.orm).repeat(BLOCK),
        }
    }
}

/// Packs Unity's mask map: metallic, occlusion, detail (always 1), smoothness.
fn mask_map([occlusion, roughness, metallic]: [u8; 3]) -> [u8; 4] {
    [metallic, occlusion, u8::MAX, u8::MAX - roughness]
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
    fn row(&self, image: Image, background: &[u8], y: usize, out: &mut [u8]) {
        for (block, out) in self.blocks.iter().zip(out.chunks_mut(BLOCK * image.pixels().bytes())) {
            if block.texels.empty {
                out.copy_from_slice(&background[..out.len()]);
            } else {
                let width = out.len() / image.pixels().bytes();
                image.copy(&block.texels, (self.height - 1 - y) * width, out);
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

/// Compresses the images of a tile, band by band from above.
#[derive(Debug)]
pub(super) struct ImageEncoder {
    images: Vec<Image>,
    /// A row of an empty block, image by image.
    background: Vec<Vec<u8>>,
    /// The lowest row of the previous band, image by image; `None` at the top of the tile.
    above: Option<Vec<Vec<u8>>>,
    /// Whether that row belongs to an empty band.
    above_empty: bool,
    pools: Vec<Pool<StripEncoder>>,
}

impl ImageEncoder {
    pub(super) fn new(images: Vec<Image>, background: Background) -> ImageEncoder {
        ImageEncoder {
            background: images.iter().map(|image| image.background(&background)).collect(),
            pools: images.iter().map(|_| Pool::default()).collect(),
            images,
            above: None,
            above_empty: false,
        }
    }

    /// Compresses the next band and returns its strips from above, image by image.
    pub(super) fn encode(&mut self, band: &Band, busy: &BusyTime) -> Vec<Vec<Strip>> {
        let empty = band.is_empty();
        // Below an empty row all strips of an empty band are alike.
        let alike = empty && self.above_empty && band.height.is_multiple_of(STRIP);
        let height = if alike { STRIP } else { band.height };
        // Images with the widest pixels go first, so that the last tasks are small.
        let mut widest: Vec<usize> = (0..self.images.len()).collect();
        widest.sort_by_key(|&image| std::cmp::Reverse(self.images[image].pixels().bytes()));
        let tasks: Vec<(usize, usize)> =
            widest.into_iter().flat_map(|image| (0..height).step_by(STRIP).map(move |top| (image, top))).collect();
        let strips: Vec<Strip> = tasks
            .par_iter()
            .with_max_len(1)
            .map(|&(image, top)| busy.measure(|| self.strip(image, top, band)))
            .collect();
        let mut images: Vec<Vec<Strip>> = vec![Vec::new(); self.images.len()];
        for ((image, _), strip) in tasks.into_iter().zip(strips) {
            images[image].push(strip);
        }
        if alike {
            for strips in &mut images {
                *strips = strips.iter().cycle().take(band.height / STRIP).cloned().collect();
            }
        }
        self.keep_lowest_row(band);
        self.above_empty = empty;
        images
    }

    fn strip(&self, index: usize, top: usize, band: &Band) -> Strip {
        let image = self.images[index];
        let make = || StripEncoder::new(image.pixels(), band.width);
        let row = |y: usize, row: &mut [u8]| band.row(image, &self.background[index], y, row);
        self.pools[index].with(make, |encoder| {
            match (&self.above, top) {
                (None, 0) => encoder.begin_at_top(),
                (Some(above), 0) => encoder.begin_below(|row| row.copy_from_slice(&above[index])),
                _ => encoder.begin_below(|above| row(top - 1, above)),
            }
            for y in top..band.height.min(top + STRIP) {
                encoder.push(|out| row(y, out));
            }
            encoder.finish()
        })
    }

    fn keep_lowest_row(&mut self, band: &Band) {
        let row = |image: &Image| vec![0; band.width * image.pixels().bytes()];
        let above = self.above.get_or_insert_with(|| self.images.iter().map(row).collect());
        for ((image, row), background) in self.images.iter().zip(above).zip(&self.background) {
            band.row(*image, background, band.height - 1, row);
        }
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

/// Writes the files of one texture.
#[derive(Debug)]
pub(super) struct TileWriter<W: Write + Seek> {
    images: Vec<PngWriter<W>>,
    layers: Vec<ExrWriter<W>>,
}

impl<W: Write + Seek> TileWriter<W> {
    /// Creates the files of a texture and writes their headers.
    pub(super) fn begin(
        [width, height]: [usize; 2],
        files: &TextureFiles,
        layers: Option<&LayerEncoder>,
        create: impl Fn(&str) -> Result<W, ExportError>,
    ) -> Result<TileWriter<W>, ExportError> {
        let mut writer = TileWriter { images: Vec::new(), layers: Vec::new() };
        for (image, name) in &files.images {
            let begun = PngWriter::begin(create(name)?, image.pixels(), width as u32, height as u32);
            writer.images.push(begun.map_err(OutputFile::explain)?);
        }
        for (file, name) in layers.map_or(&[][..], LayerEncoder::files).iter().zip(&files.layers) {
            let begun = ExrWriter::begin(create(name)?, Samples::Half, width, height, &file.names());
            writer.layers.push(begun.map_err(OutputFile::explain)?);
        }
        Ok(writer)
    }

    /// Appends a band.
    pub(super) fn push(&mut self, band: &Band, strips: &[Vec<Strip>]) -> io::Result<()> {
        for (image, strips) in self.images.iter_mut().zip(strips) {
            for strip in strips {
                image.push(strip)?;
            }
        }
        for block in &band.blocks {
            for (file, tile) in self.layers.iter_mut().zip(&block.layers) {
                file.push(tile)?;
            }
        }
        Ok(())
    }

    /// Finishes the files and returns them; the caller has to close them.
    pub(super) fn finish(self) -> io::Result<Vec<W>> {
        let mut files = Vec::new();
        for image in self.images {
            files.push(image.finish()?);
        }
        for layers in self.layers {
            files.push(layers.finish()?);
        }
        Ok(files)
    }
}
