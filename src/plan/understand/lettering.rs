//! Lettering, and tags of doors, windows and rooms: outlines of one size with letters in them. They lie on paper, not on the floor.

use super::super::components::{Component, Components, Neighbours};
use super::super::symbols::{FEWEST_STROKES, groups};
use super::pieces::{LARGEST_LETTER_M, are_in_line, encloses};

/// Greatest sides of a tag, metres, and its least length, in its height: seats with numbers are not so slender.
const TALLEST_M: f64 = 0.55;
const LONGEST_M: f64 = 1.5;
const SLENDER: f64 = 1.3;
/// Least share of a tag's length that its letters reach over, of its height that they are tall, and most of it: bowls reach over
/// more.
const LETTERS_ALONG: f64 = 0.3;
const LETTERS_TALL: [f64; 2] = [0.3, 0.8];
/// How far the letters' middle is off the tag's at most, as a share of its height.
const OFF_MIDDLE: f64 = 0.15;
/// The fewest tags of one height, and how much their heights differ at most, pixels.
const FEWEST: usize = 4;
const ALIKE_PX: u32 = 2;

/// Takes tags, with what is written in them, off the second ink as far as they are in the first.
pub(super) fn drop_tags(inks: [&mut [u8]; 2], width: usize, metres_per_pixel: f64) {
    let [ink, others] = inks;
    let pieces = Components::of(ink, width, 1, Neighbours::Eight);
    let metres = |px: u32| f64::from(px) * metres_per_pixel;
    let sides = |piece: &Component| {
        let [w, h] = piece.size();
        [w.min(h), w.max(h)]
    };
    let is_outline = |piece: &&Component| {
        let [height, length] = sides(piece);
        let is_size = metres(height) <= TALLEST_M && metres(length) <= LONGEST_M;
        is_size && f64::from(length) >= SLENDER * f64::from(height) && encloses(&pieces, piece)
    };
    let mut by_row: Vec<&Component> = pieces.all.iter().collect();
    by_row.sort_by_key(|piece| piece.min[1]);
    let within = |tag: &Component| -> Vec<&Component> {
        let first = by_row.partition_point(|piece| piece.min[1] <= tag.min[1]);
        let is_within = |piece: &&&Component| (0..2).all(|a| piece.min[a] > tag.min[a] && piece.end[a] < tag.end[a]);
        by_row[first..].iter().take_while(|piece| piece.min[1] < tag.end[1]).filter(is_within).copied().collect()
    };
    let outlines: Vec<(&Component, Vec<&Component>)> =
        pieces.all.iter().filter(is_outline).map(|outline| (outline, within(outline))).collect();
    let written: Vec<&Component> = outlines
        .iter()
        .filter(|(outline, letters)| are_written(&pieces, outline, letters))
        .map(|(outline, _)| *outline)
        .collect();
    let are_alike = |a: &Component, b: &Component, side: usize| sides(a)[side].abs_diff(sides(b)[side]) <= ALIKE_PX;
    let is_tag = |tag: &&&Component| written.iter().filter(|other| are_alike(tag, other, 0)).count() >= FEWEST;
    let tags: Vec<&Component> = written.iter().filter(is_tag).copied().collect();
    // Letters of some touch each other.
    let of_tag = |outline: &Component| tags.iter().any(|tag| are_alike(outline, tag, 0) && are_alike(outline, tag, 1));
    for (outline, letters) in outlines.iter().filter(|(outline, letters)| !letters.is_empty() && of_tag(outline)) {
        for piece in letters.iter().chain([outline]) {
            pieces.paint(piece, ink, width, 0);
            pieces.paint(piece, others, width, 0);
        }
    }
}

/// Whether pieces are letters in a row along the middle of a tag.
fn are_written(pieces: &Components, tag: &Component, letters: &[&Component]) -> bool {
    let axis = usize::from(tag.size()[1] > tag.size()[0]);
    let reach = |along: usize| {
        let from = letters.iter().map(|letter| letter.min[along]).min()?;
        let to = letters.iter().map(|letter| letter.end[along]).max()?;
        Some([f64::from(from), f64::from(to)])
    };
    let ([Some(along), Some(across)], [length, height]) =
        ([axis, 1 - axis].map(reach), [axis, 1 - axis].map(|axis| f64::from(tag.size()[axis])))
    else {
        return false;
    };
    let middle = 0.5 * f64::from(tag.min[1 - axis] + tag.end[1 - axis]);
    let tall = across[1] - across[0];
    along[1] - along[0] >= LETTERS_ALONG * length
        && (LETTERS_TALL[0] * height..=LETTERS_TALL[1] * height).contains(&tall)
        && (0.5 * (across[0] + across[1]) - middle).abs() <= OFF_MIDDLE * height
        && letters.len() > 1
        && letters.iter().any(|letter| !encloses(pieces, letter))
        && are_in_line(letters, tall)
}

/// Strokes without groups of letters.
pub(super) fn without(ink: &[u8], width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let pieces = Components::of(ink, width, 1, Neighbours::Eight);
    let small = |p: &&Component| {
        let [w, h] = p.size().map(f64::from);
        let is_block = p.area as f64 >= 0.8 * w * h && w.min(h) * metres_per_pixel >= 0.12;
        w.max(h) * metres_per_pixel <= LARGEST_LETTER_M && !is_block
    };
    let letters: Vec<&Component> = pieces.all.iter().filter(small).collect();
    let mut strokes = ink.to_vec();
    for letter in groups(&letters).into_iter().filter(|group| group.len() >= FEWEST_STROKES).flatten() {
        pieces.paint(letter, &mut strokes, width, 0);
    }
    strokes
}
