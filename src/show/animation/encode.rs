use std::borrow::Cow;
use std::io::{self, Write};

use super::packed_frames::PackedFrames;
use super::palette::UNCHANGED;
use crate::math::srgb::Srgb8;

/// How long a picture is seen, and the last one, hundredths of a second.
const DELAY: u16 = 8;
const LAST_DELAY: u16 = 150;

/// The input of the encoders.
pub(super) struct EncoderInput<'a> {
    pub(super) frames: &'a PackedFrames,
    pub(super) palette: &'a [Srgb8],
    pub(super) size_px: [u32; 2],
    /// Covers its place in every picture.
    pub(super) patch: LabelPatch,
}

/// A small picture.
pub(super) struct LabelPatch {
    /// Its upper-left pixel.
    pub(super) at: [usize; 2],
    pub(super) width: usize,
    pub(super) indices: Vec<u8>,
}

/// The change from one picture to the next: a rectangle, in which unchanged pixels are [`UNCHANGED`].
struct FrameDelta {
    at: [u32; 2],
    size: [u32; 2],
    indices: Vec<u8>,
    delay: u16,
}

impl EncoderInput<'_> {
    fn changes(&self) -> impl Iterator<Item = FrameDelta> {
        let [width, height] = self.size_px.map(|side| side as usize);
        let last = self.frames.len() - 1;
        let mut before: Vec<u8> = Vec::new();
        self.frames.pictures().enumerate().map(move |(n, mut picture)| {
            self.patch.cover(&mut picture, width);
            let delay = if n == last { LAST_DELAY } else { DELAY };
            let change = match n {
                0 => FrameDelta { at: [0, 0], size: self.size_px, indices: picture.clone(), delay },
                _ => change(&before, &picture, [width, height], delay),
            };
            before = picture;
            change
        })
    }
}

impl LabelPatch {
    fn cover(&self, picture: &mut [u8], width: usize) {
        for (row, line) in self.indices.chunks(self.width).enumerate() {
            let at = (self.at[1] + row) * width + self.at[0];
            if let Some(place) = picture.get_mut(at..at + line.len()) {
                place.copy_from_slice(line);
            }
        }
    }
}

fn change(before: &[u8], now: &[u8], [width, height]: [usize; 2], delay: u16) -> FrameDelta {
    let differs = |x: usize, y: usize| before[y * width + x] != now[y * width + x];
    let row_differs = |&y: &usize| before[y * width..][..width] != now[y * width..][..width];
    let Some(top) = (0..height).find(row_differs) else {
        return FrameDelta { at: [0, 0], size: [1, 1], indices: vec![UNCHANGED], delay };
    };
    let bottom = (top..height).rev().find(row_differs).unwrap_or(top);
    let column_differs = |&x: &usize| (top..=bottom).any(|y| differs(x, y));
    let left = (0..width).find(column_differs).unwrap_or(0);
    let right = (left..width).rev().find(column_differs).unwrap_or(left);
    let mut indices = Vec::with_capacity((right - left + 1) * (bottom - top + 1));
    for y in top..=bottom {
        indices.extend((left..=right).map(|x| if differs(x, y) { now[y * width + x] } else { UNCHANGED }));
    }
    let size = [right - left + 1, bottom - top + 1].map(|side| side as u32);
    FrameDelta { at: [left as u32, top as u32], size, indices, delay }
}

pub(super) fn gif(input: &EncoderInput<'_>, out: impl Write) -> io::Result<()> {
    let failed = |error: gif::EncodingError| match error {
        gif::EncodingError::Io(error) => error,
        other => io::Error::other(other),
    };
    let short = |pixels: u32| u16::try_from(pixels).map_err(io::Error::other);
    let [width, height] = input.size_px;
    let mut encoder = gif::Encoder::new(out, short(width)?, short(height)?, &full(input.palette)).map_err(failed)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
    for change in input.changes() {
        let frame = gif::Frame {
            delay: change.delay,
            dispose: gif::DisposalMethod::Keep,
            transparent: Some(UNCHANGED),
            left: short(change.at[0])?,
            top: short(change.at[1])?,
            width: short(change.size[0])?,
            height: short(change.size[1])?,
            buffer: Cow::Owned(change.indices),
            ..gif::Frame::default()
        };
        encoder.write_frame(&frame).map_err(failed)?;
    }
    encoder.into_inner().map_err(failed)?.flush()
}

pub(super) fn png(input: &EncoderInput<'_>, out: impl Write) -> io::Result<()> {
    let failed = |error: png::EncodingError| match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    };
    let [width, height] = input.size_px;
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(full(input.palette));
    let mut alpha = vec![255; usize::from(UNCHANGED)];
    alpha.push(0);
    encoder.set_trns(alpha);
    encoder.set_animated(input.frames.len() as u32, 0).map_err(failed)?;
    encoder.set_blend_op(png::BlendOp::Over).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for (n, change) in input.changes().enumerate() {
        if n > 0 {
            writer.reset_frame_position().map_err(failed)?;
            writer.set_frame_dimension(change.size[0], change.size[1]).map_err(failed)?;
            writer.set_frame_position(change.at[0], change.at[1]).map_err(failed)?;
        }
        writer.set_frame_delay(change.delay, 100).map_err(failed)?;
        writer.write_image_data(&change.indices).map_err(failed)?;
    }
    writer.finish().map_err(failed)
}

/// The palette with as many colours as the files want.
fn full(palette: &[Srgb8]) -> Vec<u8> {
    let mut bytes = palette.concat();
    bytes.resize(3 * (usize::from(UNCHANGED) + 1), 0);
    bytes
}
