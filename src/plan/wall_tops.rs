//! Floors rendered from above, with textures, shadows and furniture: walls are what is even, slender and of one tone there.

use rayon::prelude::*;

use super::clearance::{dilate, erode};
use super::colour::{chroma, is_pane, luma};
use super::components::{Component, Components, Neighbours, spaces};
use super::{thick, tones};

/// Pixels of the largest image that is looked at: others cost much memory, and are scans.
const MOST_PIXELS: usize = 32_000_000;
/// Pixels that a first look takes, and the least share of them that differ from the one before.
const SAMPLES: usize = 10_007;
const UNEVEN: f64 = 0.3;
/// Greatest difference of lightness to a neighbour on the tops of walls.
const EVEN: u8 = 12;
/// How far a channel is from that of the walls' tone at most: the light on a model is never the same all over.
const SPREAD: u8 = 13;
/// Bits of a channel by which tones are counted, most tones that are tried, and least share of the image that one has.
const BITS: u32 = 4;
const MOST_TONES: usize = 16;
const LEAST_TONE: f64 = 0.003;
/// Least share of the image that walls cover.
const LEAST_WALLS: f64 = 0.01;
/// Least length and greatest thickness of walls, as shares of the image's longer side, and least length for a thickness.
const SHORTEST: f64 = 0.02;
const THICKEST: f64 = 0.03;
const SLENDER: f64 = 2.0;
/// Half of the widest door or window in buildings of several sizes, as a share of the image's longer side.
const HALF_A_GAP: [f64; 3] = [0.035, 0.05, 0.08];
/// Least share of the image in a room, and fewest rooms: the last also as a share of those that another tone parts.
const LEAST_ROOM: f64 = 0.002;
const FEWEST_ROOMS: usize = 3;
const AS_MANY_ROOMS: f64 = 0.5;
/// Least share of the floor with another hue than most of it, and the same of the image: paper has less. By how much a hue differs, as a share of the
/// lightness, and the darkest floor that has one.
const OTHER_FLOORS: f64 = 0.15;
const OTHER_COLOURS: f64 = 0.05;
const OTHER_HUE: f32 = 0.15;
const DARKEST_FLOOR: u8 = 40;
/// Shares of the walls' length of which the greatest thickness is that of thin and of thick walls, and the least thickness
/// of walls for that of each: leaves of doors and frames of windows are thinner.
const THIN_SHARE: f64 = 0.4;
const THICK_SHARE: f64 = 0.8;
const LEAST_OF_THIN: f64 = 0.5;
const LEAST_OF_THICK: f64 = 0.75;
/// Greatest length of a window as a share of the image's longer side, greatest depth for the thickness of thick walls, and
/// the share of its length with frames or panes.
const LONGEST_WINDOW: f64 = 0.2;
const WIDEST_OF_THICK: f64 = 1.5;
const FRAMED: f64 = 0.8;
/// Least lightness and greatest chroma of white panes, and their share of a window: lines cross it.
const WHITE: u8 = 245;
const MOST_CHROMA: u8 = 8;
const WHITE_SHARE: [f64; 2] = [0.6, 0.97];
/// Pixels at the edges of tops that are not even.
const EDGE_PX: f64 = 2.0;

/// The colours of a floor from above; 1 for its walls, and for glass in the middle of these.
pub(super) struct Tops {
    pub(super) colours: Vec<[u8; 3]>,
    pub(super) walls: Vec<u8>,
    pub(super) glass: Vec<u8>,
}

/// The tops of walls, if they part rooms.
///
/// Of several tones, such as those of tops and of their shaded sides, the one farthest from mid grey is that of the tops.
pub(super) fn find(width: usize, height: usize, pixel: impl Fn(usize) -> [u8; 3]) -> Option<Tops> {
    if width * height > MOST_PIXELS {
        return None;
    }
    let places = || (1..width * height).step_by((width * height).div_ceil(SAMPLES));
    let uneven = places().filter(|&at| pixel(at) != pixel(at - 1)).count();
    let some: Vec<[u8; 3]> = places().map(&pixel).collect();
    if (uneven as f64) < UNEVEN * some.len() as f64 || has_one_hue(&some, OTHER_COLOURS) {
        return None;
    }
    let colours: Vec<[u8; 3]> = (0..width * height).map(pixel).collect();
    let is_near = |colour: [u8; 3], tone: [u8; 3]| colour.iter().zip(tone).all(|(&v, tone)| v.abs_diff(tone) <= SPREAD);
    let lightness: Vec<u8> = colours.iter().map(|&colour| luma(colour)).collect();
    let is_even = |at: usize| {
        let beside = [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width];
        beside.iter().all(|&near| lightness.get(near).is_none_or(|&l| l.abs_diff(lightness[at]) <= EVEN))
    };
    let even: Vec<u8> = (0..colours.len()).map(|at| u8::from(is_even(at))).collect();
    let walls_of = |&tone: &[u8; 3]| {
        let of_tone: Vec<u8> =
            colours.iter().zip(&even).map(|(&colour, even)| even & u8::from(is_near(colour, tone))).collect();
        let slender = slender(&of_tone, width);
        let count = slender.iter().filter(|&&slender| slender != 0).count();
        if (count as f64) < LEAST_WALLS * slender.len() as f64 || !tones::encloses(&slender, width) {
            return None;
        }
        let mask = dilate(&slender, width, EDGE_PX);
        let leaf_px = LEAST_OF_THIN * thickness(&mask, width, THIN_SHARE);
        let mask = thick::open(&mask, width, leaf_px as usize);
        let rooms = rooms(&mask, width);
        let floor: Vec<[u8; 3]> = rooms.iter().flatten().map(|&at| colours[at]).collect();
        let is_it = rooms.len() >= FEWEST_ROOMS && !has_one_hue(&floor, OTHER_FLOORS);
        is_it.then(|| (rooms.len(), luma(tone).abs_diff(128), mask))
    };
    let mut found: Vec<(usize, u8, Vec<u8>)> = tones_of(&colours, &even).par_iter().filter_map(walls_of).collect();
    let most = found.iter().map(|(rooms, ..)| *rooms).max()?;
    found.retain(|(rooms, ..)| *rooms as f64 >= AS_MANY_ROOMS * most as f64);
    let (.., walls) = found.into_iter().max_by_key(|&(_, contrast, _)| contrast)?;
    Some(with_windows(walls, colours, width))
}

/// The commonest tones of even pixels, commonest first.
fn tones_of(colours: &[[u8; 3]], even: &[u8]) -> Vec<[u8; 3]> {
    let mut bins = vec![(0usize, [0usize; 3]); 1 << (3 * BITS)];
    for (colour, _) in colours.iter().zip(even).filter(|&(_, &even)| even != 0) {
        let bin = colour.iter().fold(0, |bin, &v| bin << BITS | usize::from(v >> (8 - BITS)));
        bins[bin].0 += 1;
        bins[bin].1.iter_mut().zip(colour).for_each(|(sum, &v)| *sum += usize::from(v));
    }
    bins.retain(|&(count, _)| count as f64 >= LEAST_TONE * colours.len() as f64);
    bins.sort_by_key(|&(count, _)| std::cmp::Reverse(count));
    let mut tones: Vec<[u8; 3]> = Vec::new();
    for (count, sums) in bins {
        let tone = sums.map(|sum| (sum / count) as u8);
        if tones.iter().all(|other| other.iter().zip(tone).any(|(&v, tone)| v.abs_diff(tone) > SPREAD / 2)) {
            tones.push(tone);
        }
    }
    tones.truncate(MOST_TONES);
    tones
}

/// What is long for its thickness, and not at a side of the image.
fn slender(mask: &[u8], width: usize) -> Vec<u8> {
    let height = mask.len() / width;
    let longer = width.max(height) as f64;
    let thick = erode(mask, width, 0.5 * THICKEST * longer);
    let pieces = Components::of(mask, width, 1, Neighbours::Four);
    let is_slender = |piece: &&Component| {
        let [w, h] = piece.size().map(f64::from);
        let thickness = (2.0 * piece.area as f64 / (w + h)).min(w).min(h);
        !piece.is_at_side(width, height)
            && w.max(h) >= (SHORTEST * longer).max(SLENDER * thickness)
            && !pieces.touches(piece, &thick, width)
    };
    let mut kept = vec![0; mask.len()];
    pieces.all.iter().filter(is_slender).for_each(|piece| pieces.paint(piece, &mut kept, width, 1));
    kept
}

/// The thickness of walls that a share of their length has at most, pixels.
fn thickness(walls: &[u8], width: usize, share: f64) -> f64 {
    let runs = tones::runs(width, walls, |at| walls[at] != 0, |wall| wall != 0);
    let length = |&[short, _]: &[usize; 2]| 1.0 / short as f64;
    let mut left = share * runs.iter().map(length).sum::<f64>();
    let at_share = runs.iter().find(|run| {
        left -= length(run);
        left <= 0.0
    });
    at_share.map_or(0.0, |[short, _]| *short as f64)
}

/// Makes a strip of glass of each window: what frames or panes bridge between ends of thick walls beside what lies outside.
fn with_windows(mut walls: Vec<u8>, colours: Vec<[u8; 3]>, width: usize) -> Tops {
    let is_white = |colour: [u8; 3]| luma(colour) >= WHITE && chroma(colour) <= MOST_CHROMA;
    let height = walls.len() / width;
    let thick_px = thickness(&walls, width, THICK_SHARE);
    let thick = thick::open(&walls, width, (LEAST_OF_THICK * thick_px) as usize);
    let longest = (LONGEST_WINDOW * width.max(height) as f64) as usize;
    let mut closed = walls.clone();
    let mut gaps: Vec<(usize, Component, Vec<usize>)> = Vec::new();
    for along in [0, 1] {
        let mut bridges = vec![0; walls.len()];
        for (first, step, count) in spaces(&thick, width, along).into_iter().filter(|&(.., count)| count < longest) {
            (0..count).for_each(|k| bridges[first + k * step] = 1);
        }
        let pieces = Components::of(&bridges, width, 1, Neighbours::Four);
        let is_gap = |piece: &&Component| f64::from(piece.size()[1 - along]) <= WIDEST_OF_THICK * thick_px;
        for piece in pieces.all.iter().filter(is_gap) {
            pieces.paint(piece, &mut closed, width, 1);
            gaps.push((along, piece.clone(), pieces.ranges(piece, width).flatten().collect()));
        }
    }
    let free = Components::of(&closed, width, 0, Neighbours::Four);
    let mut outside = vec![0; walls.len()];
    let is_outside = |piece: &&Component| piece.is_at_side(width, height);
    free.all.iter().filter(is_outside).for_each(|piece| free.paint(piece, &mut outside, width, 1));
    let in_walls = thick::grow(&outside, width, (WIDEST_OF_THICK * thick_px) as usize);
    let mut glass: Vec<u8> =
        in_walls.iter().zip(&colours).map(|(near, &colour)| near & u8::from(is_pane(colour))).collect();
    let outside = thick::grow(&outside, width, 2);
    for (along, piece, pixels) in gaps {
        let place = |at: usize, axis: usize| [at % width, at / width][axis] - piece.min[axis] as usize;
        let size = piece.size().map(|px| px as usize);
        let mut framed = vec![0; size[along]];
        let white = pixels.iter().filter(|&&at| is_white(colours[at])).count() as f64 / pixels.len() as f64;
        let may_be_white = (WHITE_SHARE[0]..=WHITE_SHARE[1]).contains(&white);
        let is_glass = |at: usize| walls[at] != 0 || is_pane(colours[at]) || may_be_white && is_white(colours[at]);
        pixels.iter().filter(|&&at| is_glass(at)).for_each(|&at| framed[place(at, along)] = 1);
        let is_framed = framed.iter().sum::<usize>() as f64 >= FRAMED * size[along] as f64;
        if is_framed && pixels.iter().any(|&at| outside[at] != 0) {
            for at in pixels {
                walls[at] = 0;
                glass[at] = u8::from(3 * place(at, 1 - along) / size[1 - along] == 1);
            }
        }
    }
    Tops { colours, walls, glass }
}

/// The pixels of each place that walls part from others but for doors and windows, as wide as there are most places.
fn rooms(walls: &[u8], width: usize) -> Vec<Vec<usize>> {
    let height = walls.len() / width;
    let is_room =
        |piece: &&Component| !piece.is_at_side(width, height) && piece.area as f64 >= LEAST_ROOM * walls.len() as f64;
    let within = |half: f64| -> Vec<Vec<usize>> {
        let near = dilate(walls, width, half * width.max(height) as f64);
        let pieces = Components::of(&near, width, 0, Neighbours::Four);
        pieces.all.iter().filter(is_room).map(|piece| pieces.ranges(piece, width).flatten().collect()).collect()
    };
    HALF_A_GAP.map(within).into_iter().max_by_key(Vec::len).unwrap_or_default()
}

/// Whether less than a share of some colours has another hue than their median, however light they are: so it is with paper,
/// under any light.
fn has_one_hue(colours: &[[u8; 3]], least: f64) -> bool {
    let hues: Vec<[f32; 2]> = colours
        .iter()
        .filter(|&&colour| luma(colour) >= DARKEST_FLOOR)
        .map(|&colour| {
            let [r, g, b] = colour.map(f32::from);
            [r - g, g - b].map(|difference| difference / f32::from(luma(colour)))
        })
        .collect();
    let middle = [0, 1].map(|k| {
        let mut all: Vec<f32> = hues.iter().map(|hue| hue[k]).collect();
        all.sort_unstable_by(f32::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    });
    let is_other = |hue: &&[f32; 2]| hue.iter().zip(middle).any(|(hue, middle)| (hue - middle).abs() > OTHER_HUE);
    (hues.iter().filter(is_other).count() as f64) < least * hues.len() as f64
}
