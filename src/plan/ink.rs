//! Tells drawings in coloured ink: walls of one colour, and ink of any colour on tinted paper.

use super::colour::Colour;
use super::tones::{self, USUAL_THRESHOLD};

/// Least chroma of tinted paper, of 255.
const LEAST_TINT: u8 = 24;
/// Bits of a channel by which colours are told apart when they are counted.
const BITS: u32 = 4;

/// Ink that is not black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ink {
    /// Paper with a tint, as of old prints: what is dark is ink, whatever its colour.
    OnTintedPaper,
    /// Walls of a colour; other colours are annotation.
    OfColour(Colour),
}

/// Finds coloured ink: `None` where walls are black or grey.
///
/// `luma` is of the pixels as they are, `coloured` is 1 for saturated ones, `pixel` gives their colours.
pub(super) fn of(width: usize, luma: &[u8], coloured: &[u8], pixel: impl Fn(usize) -> [u8; 3]) -> Option<Ink> {
    if !tones::walls_are_coloured(width, luma, coloured) {
        return None;
    }
    let paper = commonest(&pixel, (0..luma.len()).filter(|&at| luma[at] >= USUAL_THRESHOLD))?;
    if paper.iter().max()? - paper.iter().min()? >= LEAST_TINT {
        return Some(Ink::OnTintedPaper);
    }
    let dark = (0..luma.len()).filter(|&at| luma[at] < USUAL_THRESHOLD && coloured[at] != 0);
    commonest(&pixel, dark).map(|colour| Ink::OfColour(Colour(colour)))
}

/// The mean of the commonest kind of colour at some places.
fn commonest(pixel: &impl Fn(usize) -> [u8; 3], places: impl Iterator<Item = usize>) -> Option<[u8; 3]> {
    let mut kinds = vec![[0u64; 4]; 1 << (3 * BITS)];
    for at in places {
        let colour = pixel(at);
        let kind = colour.iter().fold(0usize, |kind, &v| (kind << BITS) | usize::from(v >> (8 - BITS)));
        kinds[kind][3] += 1;
        (0..3).for_each(|k| kinds[kind][k] += u64::from(colour[k]));
    }
    let [r, g, b, count] = kinds.into_iter().max_by_key(|kind| kind[3])?;
    (count > 0).then(|| [r, g, b].map(|sum| ((sum + count / 2) / count) as u8))
}
