//! Maps of games and views of levels from above, which are no drawings on paper: coloured lines on black, floors of many
//! cells in a dark mass, light walls between a floor and a darker void.

use super::clearance::{closed, opened};
use super::components::{Components, Neighbours};
use super::tones::{self, rim};

/// Lightness up to which ground is black, and least share of the image's rim that it has.
const BLACK: u8 = 48;
const BLACK_RIM: f64 = 0.85;
/// Least share of the image that lines on black cover, and the greatest that grey or white ones do.
const LEAST_LINES: f64 = 0.004;
const MOST_PLAIN: f64 = 0.003;

/// Cells of a floor: how many at least, the longest as a share of the image's longer side, and their least share of the
/// floor.
const LEAST_CELLS: usize = 60;
const LARGEST_CELL: f64 = 0.06;
const CELLED: f64 = 0.6;
/// Greatest breadth of the lines between cells, pixels, and how many of the cells they leave apart at most.
const WIDEST_LINE: usize = 9;
const LEFT_APART: f64 = 0.1;

/// Least difference of tone between a floor and the void around it, and least share of the image that each has.
const APART: u8 = 28;
const LEAST_SHARE: f64 = 0.08;
/// Least share of the image that a piece of floor or void has: smaller ones are holes in walls.
const LEAST_PIECE: f64 = 0.001;

/// Whether a map has coloured lines on black and no others: as paper, black is white and the lines are dark then.
///
/// `lightness` is of pixels that are not coloured.
pub(super) fn is_coloured_on_black(width: usize, coloured: &[u8], lightness: impl Fn(usize) -> u8) -> bool {
    let height = coloured.len() / width;
    let count = |is_it: &dyn Fn(usize) -> bool| (0..coloured.len()).filter(|&at| is_it(at)).count() as f64;
    let is_black = |&at: &usize| coloured[at] == 0 && lightness(at) <= BLACK;
    let all = coloured.len() as f64;
    rim(width, height).filter(is_black).count() as f64 >= BLACK_RIM * rim(width, height).count() as f64
        && count(&|at| coloured[at] != 0) >= LEAST_LINES * all
        && count(&|at| coloured[at] == 0 && !is_black(&at)) <= MOST_PLAIN * all
        && tones::has_lines(coloured, width)
}

/// The negative of a colour that keeps its hue: black is white, white is black, and pure colours are dark.
pub(super) fn negative(colour: [u8; 3]) -> [u8; 3] {
    let (most, least) = (colour.into_iter().max().unwrap_or(0), colour.into_iter().min().unwrap_or(0));
    colour.map(|v| 255 - most + (v - least) / 2)
}

/// Takes the lines between the cells of a floor off: those of tiles, stones and grids on a map whose ground is dark.
/// What is left is black or white. Returns whether there were any.
pub(super) fn join_cells(width: usize, lightness: &mut [u8]) -> bool {
    let height = lightness.len() / width;
    let longest = LARGEST_CELL * width.max(height) as f64;
    let split = tones::split(lightness, &[]);
    let rim_dark = rim(width, height).filter(|&at| lightness[at] < split).count();
    if (rim_dark as f64) < 0.8 * rim(width, height).count() as f64 {
        return false;
    }
    let light_of = |lightness: &[u8], split: u8| lightness.iter().map(|&l| u8::from(l >= split)).collect::<Vec<u8>>();
    let cells_of = |light: &[u8]| {
        let pieces = Components::of(light, width, 1, Neighbours::Four).all;
        let is_cell = |area: usize, side: u32| area >= 12 && f64::from(side) <= longest;
        let cells: Vec<usize> = pieces.iter().filter(|p| is_cell(p.area, p.larger_side())).map(|p| p.area).collect();
        let floor: usize = pieces.iter().map(|p| p.area).sum();
        (cells.len(), cells.iter().sum::<usize>() as f64 / floor.max(1) as f64)
    };
    let (cells, share) = cells_of(&light_of(lightness, split));
    if cells < LEAST_CELLS || share < CELLED {
        return false;
    }
    for reach in 1..=WIDEST_LINE / 2 {
        let closed = closed(lightness, width, reach);
        let light = light_of(&closed, tones::split(&closed, &[]));
        let (left, _) = cells_of(&light);
        if left as f64 <= LEFT_APART * cells as f64 {
            // Grains of walls that are as light as floor are no part of it.
            let grain = (2 * reach + 1) as f64;
            let floor = opened(&light, width, grain);
            lightness.iter_mut().zip(floor).for_each(|(l, floor)| *l = 255 * floor);
            return true;
        }
    }
    false
}

/// Tells a floor from the void around a level, where light walls divide a ground of two tones: returns 1 for void, which
/// is solid. `None` for a ground of one tone.
///
/// What the walls enclose is of one kind, by the tone that most of it has: shadows of walls are floor.
pub(super) fn void(width: usize, lightness: &[u8], is_wall: impl Fn(usize) -> bool) -> Option<Vec<u8>> {
    let height = lightness.len() / width;
    let all = lightness.len() as f64;
    let ground: Vec<u8> = (0..lightness.len()).map(|at| u8::from(!is_wall(at))).collect();
    let walls: Vec<u8> = ground.iter().map(|&ground| 1 - ground).collect();
    let split = tones::split(lightness, &walls);
    let pieces = Components::of(&ground, width, 1, Neighbours::Four);
    let mut solid = vec![0; lightness.len()];
    // Area, and the sum of its pieces' tones.
    let (mut floors, mut voids) = ((0usize, 0usize), (0usize, 0usize));
    for piece in &pieces.all {
        let mut tones: Vec<u8> =
            pieces.ranges(piece, width).flat_map(|range| lightness[range].iter().copied()).collect();
        let middle = tones.len() / 2;
        let tone = *tones.select_nth_unstable(middle).1;
        let kind = if tone < split { &mut voids } else { &mut floors };
        kind.0 += piece.area;
        kind.1 += piece.area * usize::from(tone);
        if tone < split || (piece.area as f64) < LEAST_PIECE * all {
            pieces.paint(piece, &mut solid, width, 1);
        }
    }
    let mean = |(area, sum): (usize, usize)| sum as f64 / area.max(1) as f64;
    let void_at_rim = rim(width, height).filter(|&at| solid[at] != 0 && !is_wall(at)).count();
    let is_level = mean(floors) - mean(voids) >= f64::from(APART)
        && floors.0 as f64 >= LEAST_SHARE * all
        && voids.0 as f64 >= LEAST_SHARE * all
        && void_at_rim * 2 > rim(width, height).count();
    is_level.then_some(solid)
}
