use crate::export::band::{self, Band, BandBlock, Image, LayerEncoder, TextureFiles, TileWriter};
use crate::export::busy::BusyTime;
use crate::export::fine;
use crate::export::layout::BLOCK;
use crate::export::options::TextureOptions;
use crate::export::reduced::ReducedBlock;
use crate::export::targets::{Covered, Number, Target};
use crate::export::{ExportError, OutputFile, OutputFolder, Reduced, TextureSource};
use crate::look::{Background, ResolvedBlock};
use crate::progress::{Progress, Stage};

/// A texture to write: a rectangle of a source.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    /// Lower-left texel.
    pub(super) corner: [i64; 2],
    /// Width and height, texels.
    pub(super) size: [u32; 2],
    pub(super) files: TextureFiles,
    /// Whether to write the files even if all blocks are empty.
    pub(super) even_if_empty: bool,
    /// Its share of the progress over all textures, from 0 to 1.
    pub(super) part: [f64; 2],
}

/// Writes textures one after the other, band by band from above.
pub(super) struct TextureWriter<'a> {
    folder: &'a OutputFolder,
    progress: &'a dyn Progress,
    target: Target,
    layers: Option<LayerEncoder>,
    reduced_px: Option<u32>,
    is_fine: bool,
    is_small: bool,
    dirt: bool,
    pub(super) look_busy: BusyTime,
    pub(super) export_busy: BusyTime,
}

/// A texture that is being written. The first band that is not empty creates its files.
struct Open<'c> {
    canvas: &'c Canvas,
    writer: Option<TileWriter<OutputFile>>,
    background: Background,
    /// The empty bands before that one.
    blank: Vec<Band>,
    reduced: Option<Reduced>,
}

pub(super) struct Written {
    pub(super) reduced: Option<Reduced>,
}

impl<'a> TextureWriter<'a> {
    pub(super) fn new(
        folder: &'a OutputFolder,
        layers: &[&'static str],
        options: &TextureOptions,
        progress: &'a dyn Progress,
    ) -> TextureWriter<'a> {
        let files = options.target.layer_files(layers);
        TextureWriter {
            folder,
            progress,
            target: options.target,
            layers: (options.writes_layers() && !layers.is_empty()).then(|| LayerEncoder::new(files)),
            reduced_px: options.reduced_px,
            is_fine: options.is_fine(),
            is_small: options.small_png,
            dirt: options.dirt,
            look_busy: BusyTime::default(),
            export_busy: BusyTime::default(),
        }
    }

    pub(super) fn files(&self, covered: Covered, number: Number) -> TextureFiles {
        let folder = match covered {
            Covered::Floor => "floor",
            Covered::Wall => "walls",
        };
        let image = |image| (image, format!("{folder}/{}", self.target.image_name(covered, image, number)));
        let layers = |k| format!("{folder}/{}", self.target.layers_name(covered, k, number));
        let count = self.layers.as_ref().map_or(0, |layers| layers.files().len());
        TextureFiles {
            images: self.target.images(covered, self.dirt).map(image).collect(),
            layers: (0..count).map(layers).collect(),
        }
    }

    /// Writes a texture, or nothing if all its blocks are empty.
    ///
    /// Any thread may call `seen`, with each block, its lower-left texel and its size.
    pub(super) fn write<S: TextureSource>(
        &self,
        source: &S,
        canvas: &Canvas,
        seen: &(impl Fn([i64; 2], [usize; 2], &ResolvedBlock) + Sync),
    ) -> Result<Option<Written>, ExportError> {
        let mut open = self.open(source, canvas)?;
        let factor = open.reduced.as_ref().map(|reduced| reduced.factor as usize);
        let resolve = |index: usize, band: &mut Band| self.resolve(source, canvas, index, factor, band, seen);
        let (mut front, mut back) = (Band::default(), Band::default());
        let bands = canvas.bands();
        resolve(0, &mut front);
        for index in 0..bands {
            self.progress.keep_on()?;
            let next = || {
                if index + 1 < bands {
                    resolve(index + 1, &mut back);
                }
            };
            let (written, ()) = rayon::join(|| self.write_band(index, &front, &mut open), next);
            written?;
            std::mem::swap(&mut front, &mut back);
            let share = (index + 1) as f64 / bands as f64;
            let [begin, end] = canvas.part;
            self.progress.advance(Stage::Export, begin + share * (end - begin));
        }
        let Some(writer) = open.writer else { return Ok(None) };
        writer.finish().map_err(OutputFile::explain)?;
        Ok(Some(Written { reduced: open.reduced }))
    }

    fn open<'c>(&self, source: &impl TextureSource, canvas: &'c Canvas) -> Result<Open<'c>, ExportError> {
        let background = source.background();
        let blank = |largest| Reduced::blank(canvas.size, Reduced::factor(canvas.size, largest), background);
        Ok(Open {
            canvas,
            writer: if canvas.even_if_empty { Some(self.create(canvas, &background)?) } else { None },
            background,
            blank: Vec::new(),
            reduced: self.reduced_px.map(blank),
        })
    }

    fn create(&self, canvas: &Canvas, background: &Background) -> Result<TileWriter<OutputFile>, ExportError> {
        let size = canvas.size.map(|side| side as usize);
        let create = |name: &str| self.folder.create(name);
        let fine = |image| if self.is_fine { fine::form(image) } else { None };
        TileWriter::begin(size, &canvas.files, background, (self.layers.as_ref(), &fine, self.is_small), create)
    }

    fn resolve<S: TextureSource>(
        &self,
        source: &S,
        canvas: &Canvas,
        index: usize,
        factor: Option<usize>,
        band: &mut Band,
        seen: &(impl Fn([i64; 2], [usize; 2], &ResolvedBlock) + Sync),
    ) {
        let ([i0, j0], [width, height]) = canvas.band(index);
        band.fill([width, height], |left, width| {
            let i0 = i0 + left as i64;
            let mut texels = self.look_busy.measure(|| source.resolve(i0, j0, width, height));
            self.export_busy.measure(|| {
                seen([i0, j0], [width, height], &texels);
                let small = factor.filter(|_| !texels.empty);
                let reduced = small.map(|factor| ReducedBlock::of(&texels, [width, height], factor));
                // Compressing the floats now, in the cache, frees them before the images are done.
                let layers = self.layers.as_ref().map(|layers| layers.encode(&texels, width, height));
                let rub = if canvas.files.image(Image::Rub).is_some() { band::rub(&texels) } else { Vec::new() };
                let images = canvas.files.images.iter().filter(|(image, _)| fine::form(*image).is_some());
                let with_bytes = |&(image, _): &(Image, _)| (image, fine::bytes(image, &texels));
                let fine = if self.is_fine && !texels.empty { images.map(with_bytes).collect() } else { Vec::new() };
                (texels.layers, texels.fine) = (Vec::new(), Vec::new());
                BandBlock { texels, layers: layers.unwrap_or_default(), rub, fine, reduced }
            })
        });
    }

    fn write_band(&self, index: usize, band: &Band, open: &mut Open<'_>) -> Result<(), ExportError> {
        if let Some(reduced) = &mut open.reduced {
            for (k, block) in band.blocks.iter().enumerate() {
                block.reduced.iter().for_each(|block| reduced.put(k * BLOCK, index * BLOCK, block));
            }
        }
        if open.writer.is_none() {
            if band.is_empty() {
                open.blank.push(band.clone());
                return Ok(());
            }
            let mut writer = self.create(open.canvas, &open.background)?;
            for blank in std::mem::take(&mut open.blank) {
                self.push(&blank, &mut writer)?;
            }
            open.writer = Some(writer);
        }
        match &mut open.writer {
            Some(writer) => self.push(band, writer),
            None => Ok(()),
        }
    }

    fn push(&self, band: &Band, writer: &mut TileWriter<OutputFile>) -> Result<(), ExportError> {
        writer.push(band, &self.export_busy).map_err(OutputFile::explain)
    }
}

impl Canvas {
    fn bands(&self) -> usize {
        (self.size[1] as usize).div_ceil(BLOCK)
    }

    /// Returns the lower-left texel and the size of a band, counted from above.
    fn band(&self, index: usize) -> ([i64; 2], [usize; 2]) {
        let [width, whole] = self.size.map(|side| side as usize);
        let height = BLOCK.min(whole - index * BLOCK);
        let below = whole - index * BLOCK - height;
        ([self.corner[0], self.corner[1] + below as i64], [width, height])
    }
}
