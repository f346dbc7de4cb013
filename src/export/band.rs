//! A band of blocks across a tile: resolved, compressed, written.

use std::io::{self, Seek, Write};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::busy::BusyTime;
use super::error::ExportError;
use super::exr_tiles::{ExrWriter, Samples, TileEncoder};
use super::layout::BLOCK;
use super::output::OutputFile;
use super::png::{Pixels, PngWriter, Strip, StripEncoder};
use crate::look::{Background, ResolvedBlock};

/// Rows that are compressed together: few enough to stay in the cache, and for eight threads to have work.
const STRIP: usize = 32;

/// The three images that every tile has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Image {
    BaseColor,
    Mask,
    Orm,
}

impl Image {
    pub(super) const ALL: [Image; 3] = [Image::BaseColor, Image::Mask, Image::Orm];

    /// What file names and the manifest call it.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Image::BaseColor => "basecolor",
            Image::Mask => "mask",
            Image::Orm => "orm",
        }
    }

    pub(super) fn pixels(self) -> Pixels {
        match self {
            Image::BaseColor => Pixels::Srgb,
            Image::Mask => Pixels::Linear4,
            Image::Orm => Pixels::Linear3,
        }
    }

    fn bytes(self, block: &ResolvedBlock) -> &[u8] {
        match self {
            Image::BaseColor => block.base_color.as_flattened(),
            Image::Mask => block.mask.as_flattened(),
            Image::Orm => block.orm.as_flattened(),
        }
    }

    /// A row of an empty block.
    fn background(self, background: &Background) -> Vec<u8> {
        match self {
            Image::BaseColor => background.base_color.repeat(BLOCK),
            Image::Mask => background.mask.repeat(BLOCK),
            Image::Orm => background.orm.repeat(BLOCK),
        }
    }
}

/// Up to [`BLOCK`] rows across a tile, in blocks from the left.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) blocks: Vec<BandBlock>,
}

/// A block whose layers are compressed already.
#[derive(Clone, Debug, Default)]
pub(super) struct BandBlock {
    /// The images; the layers were taken out.
    pub(super) texels: ResolvedBlock,
    /// The layers as a tile of the EXR file.
    pub(super) layers: Vec<u8>,
}

impl Band {
    /// Fills in all blocks of a band of `width` x `height` texels; `resolve` is told the column at which a block
    /// starts and its width.
    pub(super) fn fill(&mut self, [width, height]: [usize; 2], resolve: impl Fn(usize, usize) -> BandBlock + Sync) {
        (self.width, self.height) = (width, height);
        self.blocks.resize_with(width.div_ceil(BLOCK), BandBlock::default);
        self.blocks.par_iter_mut().enumerate().with_max_len(1).for_each(|(k, block)| {
            *block = resolve(k * BLOCK, BLOCK.min(width - k * BLOCK));
        });
    }

    /// Whether no block of it holds floor.
    pub(super) fn is_empty(&self) -> bool {
        self.blocks.iter().all(|block| block.texels.empty)
    }

    /// The pixels of one row, counted from above. `background` is a row of an empty block.
    fn row(&self, image: Image, background: &[u8], y: usize, out: &mut [u8]) {
        for (block, out) in self.blocks.iter().zip(out.chunks_mut(BLOCK * image.pixels().bytes())) {
            if block.texels.empty {
                out.copy_from_slice(&background[..out.len()]);
            } else {
                let row = self.height - 1 - y;
                out.copy_from_slice(&image.bytes(&block.texels)[row * out.len()..(row + 1) * out.len()]);
            }
        }
    }
}

/// Buffers that threads take and give back.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Pool<T> {
        Pool(Mutex::default())
    }
}

impl<T> Pool<T> {
    /// Works with a buffer that nobody else has, made if there is none.
    pub(super) fn with<R>(&self, make: impl FnOnce() -> T, work: impl FnOnce(&mut T) -> R) -> R {
        let taken = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut buffer = taken.unwrap_or_else(make);
        let result = work(&mut buffer);
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(buffer);
        result
    }
}

/// Compresses the layers of blocks.
#[derive(Debug)]
pub(super) struct LayerEncoder {
    /// Where each of the file's channels, which are sorted by name, lies among the blocks' layers.
    order: Vec<usize>,
    names: Vec<String>,
    pool: Pool<TileEncoder>,
    /// The tile of an empty block of full size.
    blank: Vec<u8>,
}

impl LayerEncoder {
    /// An encoder for blocks with these layers.
    pub(super) fn new(layers: &[&'static str]) -> LayerEncoder {
        let mut order: Vec<usize> = (0..layers.len()).collect();
        order.sort_by_key(|&k| layers[k]);
        let names = order.iter().map(|&k| layers[k].to_string()).collect();
        let mut encoder = LayerEncoder { order, names, pool: Pool::default(), blank: Vec::new() };
        encoder.blank = encoder.zeros(BLOCK, BLOCK);
        encoder
    }

    /// Names of the file's channels.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// A block as a tile of the file.
    pub(super) fn encode(&self, block: &ResolvedBlock, width: usize, height: usize) -> Vec<u8> {
        if block.empty {
            return if (width, height) == (BLOCK, BLOCK) { self.blank.clone() } else { self.zeros(width, height) };
        }
        let layers: Vec<&[f32]> = self.order.iter().map(|&k| block.layers[k].values.as_slice()).collect();
        self.pool.with(TileEncoder::default, |encoder| encoder.half(&layers, width))
    }

    fn zeros(&self, width: usize, height: usize) -> Vec<u8> {
        let zeros = vec![0.0; width * height];
        TileEncoder::default().half(&vec![zeros.as_slice(); self.order.len()], width)
    }
}

/// Compresses the images of a tile's bands, from above.
#[derive(Debug)]
pub(super) struct ImageEncoder {
    /// A row of an empty block, image by image.
    background: [Vec<u8>; 3],
    /// The lowest row of the band before, image by image; none at the top of the tile.
    above: Option<[Vec<u8>; 3]>,
    /// Whether that row belongs to an empty band.
    above_empty: bool,
    pools: [Pool<StripEncoder>; 3],
}

impl ImageEncoder {
    pub(super) fn new(background: Background) -> ImageEncoder {
        ImageEncoder {
            background: Image::ALL.map(|image| image.background(&background)),
            above: None,
            above_empty: false,
            pools: Default::default(),
        }
    }

    /// Compresses the next band: its strips from above, for each of [`Image::ALL`].
    pub(super) fn encode(&mut self, band: &Band, busy: &BusyTime) -> [Vec<Strip>; 3] {
        let empty = band.is_empty();
        // Below an empty row all strips of an empty band are alike.
        let alike = empty && self.above_empty && band.height.is_multiple_of(STRIP);
        let height = if alike { STRIP } else { band.height };
        // Those of the widest pixels first: the last tasks should be small ones.
        let tasks: Vec<(usize, usize)> =
            [1, 0, 2].into_iter().flat_map(|image| (0..height).step_by(STRIP).map(move |top| (image, top))).collect();
        let strips: Vec<Strip> = tasks
            .par_iter()
            .with_max_len(1)
            .map(|&(image, top)| busy.measure(|| self.strip(image, top, band)))
            .collect();
        let mut images: [Vec<Strip>; 3] = Default::default();
        for ((image, _), strip) in tasks.into_iter().zip(strips) {
            images[image].push(strip);
        }
        if alike {
            images = images.map(|strips| strips.iter().cycle().take(band.height / STRIP).cloned().collect());
        }
        self.keep_lowest_row(band);
        self.above_empty = empty;
        images
    }

    fn strip(&self, index: usize, top: usize, band: &Band) -> Strip {
        let image = Image::ALL[index];
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
        let rows = || Image::ALL.map(|image| vec![0; band.width * image.pixels().bytes()]);
        let above = self.above.get_or_insert_with(rows);
        for ((image, row), background) in Image::ALL.into_iter().zip(above).zip(&self.background) {
            band.row(image, background, band.height - 1, row);
        }
    }
}

/// The files of a tile.
#[derive(Debug)]
pub(super) struct TileWriter<W: Write + Seek> {
    images: [PngWriter<W>; 3],
    layers: Option<ExrWriter<W>>,
}

impl<W: Write + Seek> TileWriter<W> {
    /// Begins the files of a tile; `create` makes the one for an image, or for the layers if it is given `None`.
    pub(super) fn begin(
        [width, height]: [usize; 2],
        layers: Option<&LayerEncoder>,
        mut create: impl FnMut(Option<Image>) -> Result<W, ExportError>,
    ) -> Result<TileWriter<W>, ExportError> {
        let mut image = |image: Image| {
            let file = create(Some(image))?;
            PngWriter::begin(file, image.pixels(), width as u32, height as u32).map_err(OutputFile::explain)
        };
        let images = [image(Image::BaseColor)?, image(Image::Mask)?, image(Image::Orm)?];
        let mut exr = |layers: &LayerEncoder| {
            let file = create(None)?;
            ExrWriter::begin(file, Samples::Half, width, height, layers.names()).map_err(OutputFile::explain)
        };
        Ok(TileWriter { images, layers: layers.map(&mut exr).transpose()? })
    }

    /// Appends a band.
    pub(super) fn push(&mut self, band: &Band, strips: &[Vec<Strip>; 3]) -> io::Result<()> {
        for (image, strips) in self.images.iter_mut().zip(strips) {
            for strip in strips {
                image.push(strip)?;
            }
        }
        if let Some(layers) = &mut self.layers {
            for block in &band.blocks {
                layers.push(&block.layers)?;
            }
        }
        Ok(())
    }

    /// Ends the files and gives them, still to be closed.
    pub(super) fn finish(self) -> io::Result<Vec<W>> {
        let mut files = Vec::new();
        for image in self.images {
            files.push(image.finish()?);
        }
        if let Some(layers) = self.layers {
            files.push(layers.finish()?);
        }
        Ok(files)
    }
}
