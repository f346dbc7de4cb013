//! Splits white into spaces that people can walk in.
//!
//! A space is a connected region for the middle of the narrowest person, and the white around it. At a neck too narrow
//! to pass, the white is divided by its walking distance to both spaces. White farther than a few widths of a person
//! from any space belongs to none: hollow walls with an open end, a scanner's rays through a window.

use super::clearance::erode;
use super::components::{Component, Components, Neighbours};

/// Reach of a space beyond the positions of a person's middle, in half widths of the person.
///
/// It fills corners of down to about 30 degrees to their tip.
const REACH_HALF_WIDTHS: f64 = 4.0;

/// Limit on the number of spaces; beyond it the smallest are dropped.
const MOST_SPACES: usize = u16::MAX as usize;

/// The spaces of a plan.
pub(super) struct Spaces {
    /// The number of each pixel's space from 1 on, or 0.
    pub(super) label: Vec<u16>,
    /// Space by number less one.
    pub(super) all: Vec<Space>,
}

/// A piece of white that is connected for people.
#[derive(Clone, Debug, Default)]
pub(super) struct Space {
    /// Number of pixels.
    pub(super) area: usize,
    /// Number of the image's corners in it.
    pub(super) corners: usize,
    /// Number of its pixels on the image's sides.
    pub(super) side_pixels: usize,
    /// Number of openings on the image's sides, without those that reach an image corner.
    pub(super) openings: usize,
    /// Number of openings on the image's sides, with those.
    pub(super) openings_and_corners: usize,
}

/// Splits white (non-zero pixels) into spaces for people who are `person_px` wide.
///
/// Openings are at least `opening_px` wide.
pub(super) fn split(white: &[u8], width: usize, person_px: f64, opening_px: f64) -> Spaces {
    let radius = (person_px * 0.5).max(1.0);
    let mut pieces = Components::of(&erode(white, width, radius), width, 1, Neighbours::Four);
    keep_largest(&mut pieces.all, MOST_SPACES);
    let mut label = vec![0u16; white.len()];
    for (number, piece) in (1..).zip(&pieces.all) {
        pieces.paint(piece, &mut label, width, number);
    }
    if radius > 1.0 {
        share_out(white, width, &mut label, radius * REACH_HALF_WIDTHS);
    }
    let mut all = vec![Space::default(); pieces.all.len()];
    for &number in &label {
        if number > 0 {
            all[number as usize - 1].area += 1;
        }
    }
    let spaces = Spaces { label, all };
    count_sides(spaces, width, opening_px)
}

/// Keeps the `most` largest components, in their order.
fn keep_largest(pieces: &mut Vec<Component>, most: usize) {
    if pieces.len() <= most {
        return;
    }
    let mut areas: Vec<usize> = pieces.iter().map(|piece| piece.area).collect();
    areas.sort_unstable_by(|a, b| b.cmp(a));
    let least = areas[most - 1];
    let mut of_least = areas[..most].iter().filter(|&&area| area == least).count();
    pieces.retain(|piece| {
        let is_least = piece.area == least && of_least > 0;
        of_least -= usize::from(is_least);
        piece.area > least || is_least
    });
}

/// Assigns white to the nearest labelled pixel through white, up to `reach` pixels away.
///
/// Dijkstra over pixels in buckets of equal cost. A step costs 5 along a side and 7 along a diagonal (Borgefors 1986,
/// doi 10.1016/S0734-189X(86)80047-0), the latter only beside a white pixel, since floor is 4-connected.
fn share_out(white: &[u8], width: usize, label: &mut [u16], reach: f64) {
    let height = white.len() / width;
    let last = (reach * 5.0).ceil() as usize;
    let mut buckets: Vec<Vec<(u32, u16)>> = vec![Vec::new(); last + 8];
    let spread = |at: usize, number: u16, cost: usize, label: &[u16], buckets: &mut [Vec<(u32, u16)>]| {
        let (x, y) = (at % width, at / width);
        let (west, east, north, south) = (x > 0, x + 1 < width, y > 0, y + 1 < height);
        let free = |at: usize| white[at] != 0;
        let mut push = |to: usize, step: usize| {
            if free(to) && label[to] == 0 {
                buckets[cost + step].push((to as u32, number));
            }
        };
        for (within, to) in
            [(west, at.wrapping_sub(1)), (east, at + 1), (north, at.wrapping_sub(width)), (south, at + width)]
        {
            if within {
                push(to, 5);
            }
        }
        for (dx, dy, within) in
            [(-1, -1, west && north), (1, -1, east && north), (-1, 1, west && south), (1, 1, east && south)]
        {
            if within {
                let (side, vertical) = ((at as isize + dx) as usize, (at as isize + dy * width as isize) as usize);
                if free(side) || free(vertical) {
                    push((vertical as isize + dx) as usize, 7);
                }
            }
        }
    };
    // Most labelled pixels have only labelled neighbours and need not start.
    let mut open = vec![false; width];
    for y in 0..height {
        open.fill(false);
        for row in y.saturating_sub(1)..=(y + 1).min(height - 1) {
            let row = &label[row * width..(row + 1) * width];
            open.iter_mut().zip(row).for_each(|(open, &number)| *open |= number == 0);
        }
        for x in 0..width {
            let at = y * width + x;
            if label[at] != 0 && open[x.saturating_sub(1)..=(x + 1).min(width - 1)].contains(&true) {
                spread(at, label[at], 0, label, &mut buckets);
            }
        }
    }
    for cost in 0..=last {
        for (at, number) in std::mem::take(&mut buckets[cost]) {
            if label[at as usize] == 0 {
                label[at as usize] = number;
                spread(at as usize, number, cost, label, &mut buckets);
            }
        }
    }
}

fn count_sides(mut spaces: Spaces, width: usize, opening_px: f64) -> Spaces {
    let height = spaces.label.len() / width;
    let Spaces { label, all } = &mut spaces;
    for corner in [0, width - 1, (height - 1) * width, height * width - 1] {
        if label[corner] > 0 {
            all[label[corner] as usize - 1].corners += 1;
        }
    }
    let at = |side: usize, k: usize| match side {
        0 => label[k],
        1 => label[(height - 1) * width + k],
        2 => label[k * width],
        _ => label[k * width + width - 1],
    };
    for side in 0..4 {
        let length = if side < 2 { width } else { height };
        let mut from = 0;
        for k in 1..=length {
            if k < length && at(side, k) == at(side, from) {
                continue;
            }
            if let Some(space) = (at(side, from) as usize).checked_sub(1).map(|n| &mut all[n]) {
                space.side_pixels += k - from;
                if (k - from) as f64 >= opening_px - 1e-6 {
                    space.openings_and_corners += 1;
                    space.openings += usize::from(from > 0 && k < length);
                }
            }
            from = k;
        }
    }
    spaces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split_rows(rows: &[&str], person_px: f64) -> (Vec<usize>, Spaces) {
        let white: Vec<u8> = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'.')).collect();
        let spaces = split(&white, rows[0].len(), person_px, 3.0);
        (spaces.all.iter().map(|s| s.area).collect(), spaces)
    }

    const LEAK: [&str; 7] = [
        "#################",
        "#.......#.......#",
        "#.......#.......#",
        "#...............#",
        "#.......#.......#",
        "#.......#.......#",
        "#################",
    ];

    #[test]
    fn a_gap_too_narrow_for_a_person_divides() {
        assert_eq!(split_rows(&LEAK, 1.0).0, [71]);
        assert_eq!(split_rows(&LEAK, 4.0).0, [36, 35]);
    }

    #[test]
    fn rooms_are_filled_into_their_corners() {
        let (_, spaces) = split_rows(&LEAK, 4.0);
        assert!([18, 24, 86, 92].iter().all(|&corner| spaces.label[corner] == 1));
    }

    #[test]
    fn a_hollow_wall_belongs_to_nobody() {
        let mut rows = vec![".".repeat(30); 8];
        rows.extend(["#".repeat(30), ".".repeat(29) + "#", "#".repeat(30)]);
        rows.extend(vec![".".repeat(30); 8]);
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let (areas, spaces) = split_rows(&rows, 4.0);
        assert_eq!(areas, [240, 240]);
        assert_eq!(spaces.label[9 * 30 + 10], 0);
    }

    #[test]
    fn corners_and_openings_are_counted() {
        let (_, spaces) = split_rows(&["....", "####", "....", "....", "....", "####"], 1.0);
        let counted: Vec<_> = spaces.all.iter().map(|s| (s.corners, s.openings, s.openings_and_corners)).collect();
        assert_eq!(counted, [(2, 0, 1), (0, 2, 2)]);
    }
}
