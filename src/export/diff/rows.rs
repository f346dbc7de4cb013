//! Reads PNG and EXR row by row, so that `diff` compares images larger than memory.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use exr::block::reader::{AllChunksReader, ChunksReader};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::prelude::{SampleType, f16};

use crate::export::ExportError;
use crate::files::open_input;

/// Greatest width and height of an image to compare, pixels.
const LARGEST_SIDE_PX: usize = 1 << 18;
/// Greatest number of channels of an image to compare.
const MOST_CHANNELS: usize = 1024;

/// An image that is read row by row from above.
pub(super) struct ImageRows {
    pub(super) path: PathBuf,
    pub(super) width: usize,
    pub(super) height: usize,
    /// Channel names, in the order of the values.
    pub(super) channels: Vec<String>,
    source: Source,
}

enum Source {
    Png(Box<png::Reader<BufReader<File>>>),
    Exr(Box<ExrRows>),
}

impl ImageRows {
    /// Opens an image, in the format of its file extension.
    pub(super) fn open(path: &Path) -> Result<ImageRows, ExportError> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        match extension.as_str() {
            "png" => open_png(path),
            "exr" => open_exr(path),
            _ => Err(ExportError::damaged(path, "only PNG and EXR images can be compared")),
        }
    }

    /// Checks the size in an image's header before allocating memory for it.
    fn check_size(path: &Path, width: usize, height: usize, channels: usize) -> Result<(), ExportError> {
        if width <= LARGEST_SIDE_PX && height <= LARGEST_SIDE_PX && channels <= MOST_CHANNELS {
            return Ok(());
        }
        let problem = format!(
            "it claims {width} x {height} px with {channels} channels; at most {LARGEST_SIDE_PX} px a side and \
             {MOST_CHANNELS} channels are compared"
        );
        Err(ExportError::damaged(path, problem))
    }

    /// Reads the next row into `row`, channels interleaved: 0 to 1 for PNG, as stored for EXR.
    pub(super) fn next_row(&mut self, row: &mut Vec<f64>) -> Result<(), ExportError> {
        row.clear();
        match &mut self.source {
            Source::Png(reader) => png_row(reader, &self.path, row),
            Source::Exr(rows) => rows.next_row(&self.path, row),
        }
    }
}

fn buffered(path: &Path) -> Result<BufReader<File>, ExportError> {
    Ok(BufReader::with_capacity(1 << 16, open_input(path).map_err(ExportError::read(path))?))
}

fn open_png(path: &Path) -> Result<ImageRows, ExportError> {
    let mut decoder = png::Decoder::new(buffered(path)?);
    // Expands palettes, and grey of fewer than 8 bits, to 8 bits.
    decoder.set_transformations(png::Transformations::EXPAND);
    let reader = decoder.read_info().map_err(|e| ExportError::damaged(path, e))?;
    if reader.info().interlaced {
        return Err(ExportError::damaged(path, "it is interlaced, which is not supported"));
    }
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    ImageRows::check_size(path, width, height, 4)?;
    let channels = match reader.output_color_type().0 {
        png::ColorType::Grayscale => "Y",
        png::ColorType::GrayscaleAlpha => "YA",
        png::ColorType::Rgb => "RGB",
        png::ColorType::Rgba | png::ColorType::Indexed => "RGBA",
    };
    Ok(ImageRows {
        path: path.to_path_buf(),
        width,
        height,
        channels: channels.chars().map(String::from).collect(),
        source: Source::Png(Box::new(reader)),
    })
}

fn png_row(reader: &mut png::Reader<BufReader<File>>, path: &Path, row: &mut Vec<f64>) -> Result<(), ExportError> {
    let depth = reader.output_color_type().1;
    let bytes = reader.next_row().map_err(|e| ExportError::damaged(path, e))?;
    let Some(bytes) = bytes else { return Err(ExportError::damaged(path, "rows are missing")) };
    if depth == png::BitDepth::Sixteen {
        row.extend(bytes.data().chunks_exact(2).map(|b| f64::from(u16::from_be_bytes([b[0], b[1]])) / 65_535.0));
    } else {
        row.extend(bytes.data().iter().map(|&b| f64::from(b) / 255.0));
    }
    Ok(())
}

/// Assembles the blocks of an EXR into rows.
struct ExrRows {
    chunks: AllChunksReader<BufReader<File>>,
    samples: Vec<SampleType>,
    width: usize,
    height: usize,
    /// Rows of the current blocks, channels interleaved.
    band: Vec<f64>,
    band_top: usize,
    band_height: usize,
    next: usize,
}

fn open_exr(path: &Path) -> Result<ImageRows, ExportError> {
    let reader = exr::block::read(buffered(path)?, false).map_err(damaged(path))?;
    let [header] = reader.headers() else {
        return Err(ExportError::damaged(path, "it has more than one part, which is not supported"));
    };
    if header.deep || header.channels.list.iter().any(|channel| channel.sampling.0 * channel.sampling.1 != 1) {
        return Err(ExportError::damaged(path, "it is deep or subsampled, which is not supported"));
    }
    let (width, height) = (header.layer_size.0, header.layer_size.1);
    ImageRows::check_size(path, width, height, header.channels.list.len())?;
    let samples = header.channels.list.iter().map(|channel| channel.sample_type).collect();
    let channels = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let chunks = reader.all_chunks(false).map_err(damaged(path))?;
    let rows = ExrRows { chunks, samples, width, height, band: Vec::new(), band_top: 0, band_height: 0, next: 0 };
    Ok(ImageRows { path: path.to_path_buf(), width, height, channels, source: Source::Exr(Box::new(rows)) })
}

fn damaged(path: &Path) -> impl Fn(exr::error::Error) -> ExportError + '_ {
    |error| match error {
        exr::error::Error::Io(source) => ExportError::Read { path: path.to_path_buf(), source },
        other => ExportError::damaged(path, other),
    }
}

impl ExrRows {
    fn next_row(&mut self, path: &Path, row: &mut Vec<f64>) -> Result<(), ExportError> {
        if self.next == self.band_top + self.band_height {
            self.read_band(path)?;
        }
        let values = self.width * self.samples.len();
        let at = (self.next - self.band_top) * values;
        row.extend_from_slice(&self.band[at..at + values]);
        self.next += 1;
        Ok(())
    }

    /// Reads the next row of blocks.
    fn read_band(&mut self, path: &Path) -> Result<(), ExportError> {
        let mut right = 0;
        self.band_top += self.band_height;
        while right < self.width {
            let Some(chunk) = self.chunks.next() else {
                return Err(ExportError::damaged(path, "tiles are missing"));
            };
            let chunk = chunk.map_err(damaged(path))?;
            let block =
                UncompressedBlock::decompress_chunk(chunk, self.chunks.meta_data(), false).map_err(damaged(path))?;
            let BlockIndex { pixel_position, pixel_size, level, .. } = block.index;
            if (level.0, level.1) != (0, 0) || (pixel_position.0, pixel_position.1) != (right, self.band_top) {
                return Err(ExportError::damaged(path, "its blocks do not come from above, which is not supported"));
            }
            if right == 0 {
                self.band_height = pixel_size.1.min(self.height - self.band_top);
                self.band.resize(self.band_height * self.width * self.samples.len(), 0.0);
            }
            if right + pixel_size.0 > self.width {
                return Err(ExportError::damaged(path, "its blocks reach beyond its width"));
            }
            if pixel_size.1 != self.band_height {
                return Err(ExportError::damaged(path, "its blocks are not of one height"));
            }
            self.unpack(&block.data, right, pixel_size.0);
            right += pixel_size.0;
        }
        Ok(())
    }

    fn unpack(&mut self, data: &[u8], left: usize, width: usize) {
        let count = self.samples.len();
        let mut rest = data;
        for y in 0..self.band_height {
            for (channel, &samples) in self.samples.iter().enumerate() {
                let bytes = samples.bytes_per_sample();
                let Some((line, after)) = rest.split_at_checked(width * bytes) else { return };
                rest = after;
                for (x, sample) in line.chunks_exact(bytes).enumerate() {
                    self.band[(y * self.width + left + x) * count + channel] = value(samples, sample);
                }
            }
        }
    }
}

fn value(samples: SampleType, bytes: &[u8]) -> f64 {
    match (samples, bytes) {
        (SampleType::F16, &[a, b]) => f16::from_ne_bytes([a, b]).to_f64(),
        (SampleType::F32, &[a, b, c, d]) => f64::from(f32::from_ne_bytes([a, b, c, d])),
        (SampleType::U32, &[a, b, c, d]) => f64::from(u32::from_ne_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}
