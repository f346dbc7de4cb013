//! Masks with 16 bits per channel. They come from the layers, as 1 - exp(-D) of what lies there, without dither.

use super::band::{FineForm, Image};
use super::layout::BLOCK;
use super::png::Pixels;
use super::targets::Covered;
use crate::look::{FLAT_FINELY, ResolvedBlock};
use crate::math::exp_f32;

/// How an image is stored with 16 bits; `None` for images that have 8 always.
pub(super) fn form(image: Image) -> Option<FineForm> {
    let (pixels, texel): (_, &[u16]) = match image {
        Image::Mask(_) | Image::Rub => (Pixels::Fine3, &[0; 3]),
        Image::Wear => (Pixels::Fine3, &FLAT_FINELY),
        Image::LoneMask(_) => (Pixels::Fine1, &[0]),
        _ => return None,
    };
    Some((pixels, texel.iter().flat_map(|value| value.to_be_bytes()).collect::<Vec<u8>>().repeat(BLOCK)))
}

/// Bytes of all texels of a block that is not empty.
pub(super) fn bytes(image: Image, block: &ResolvedBlock) -> Vec<u8> {
    match image {
        Image::Mask(Covered::Floor) => packed(block, [&["film"], &["soil"], &["edge", "dust"]]),
        Image::Mask(Covered::Wall) => packed(block, [&["hand"], &["arm", "shoulder", "bag"], &["shoe"]]),
        Image::Rub => packed(block, [&["arm"], &["shoulder"], &["bag"]]),
        Image::LoneMask(Covered::Wall) => packed(block, [&["splash", "dust"]]),
        Image::LoneMask(Covered::Floor) => flattened(kept(block).map(|[passes, ..]| [passes])),
        _ => {
            let marks = opacity(block, &["scuff"]);
            flattened(kept(block).zip(marks).map(|([_, wear, height], marks)| [wear, marks, height]))
        }
    }
}

fn kept(block: &ResolvedBlock) -> impl Iterator<Item = [u16; 3]> + '_ {
    (0..block.orm.len()).map(|k| block.fine.get(k).copied().unwrap_or(FLAT_FINELY))
}

fn packed<const N: usize>(block: &ResolvedBlock, layers: [&[&str]; N]) -> Vec<u8> {
    let planes = layers.map(|names| opacity(block, names));
    flattened((0..block.orm.len()).map(|k| planes.each_ref().map(|plane| plane[k])))
}

fn flattened<const N: usize>(texels: impl Iterator<Item = [u16; N]>) -> Vec<u8> {
    texels.flatten().flat_map(u16::to_be_bytes).collect()
}

/// 1 - exp(-D) of some layers together.
fn opacity(block: &ResolvedBlock, names: &[&str]) -> Vec<u16> {
    let mut density = vec![0.0; block.orm.len()];
    for layer in block.layers.iter().filter(|layer| names.contains(&layer.name)) {
        density.iter_mut().zip(&layer.values).for_each(|(density, value)| *density += value);
    }
    density.into_iter().map(|density| (65_535.0 * (1.0 - exp_f32(-density)) + 0.5) as u16).collect()
}
