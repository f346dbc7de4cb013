//! Maps without dark walls: rooms are areas of colour on light paper, or floors seen from above, and the light lines between
//! them are the walls.

use super::clearance::{dilate, erode, opened};
use super::colour::{chroma, luma};
use super::components::{Components, Neighbours, spaces};
use super::tones;

/// Tones that differ less from paper than this are paper.
const PAPER_SPREAD: u8 = 10;
/// Least lightness of paper and of areas; what is darker is lettering.
const LIGHTEST_INK: u8 = 128;
const DARKEST_PAPER: u8 = 200;
/// Least share of the image's rim that is paper.
const PAPER_AT_RIM: f64 = 0.8;
/// Least and greatest share of the image that areas cover, and least share of that which is light and in broad areas.
const COVERED: [f64; 2] = [0.12, 0.9];
const LIGHT: f64 = 0.9;
const BROAD: f64 = 0.75;
/// Radius of a circle that fits into broad areas, and greatest thickness of walls; shares of the image's longer side.
const BROAD_SHARE: f64 = 0.015;
const THICKEST: f64 = 0.03;
/// Least share of all areas that one has: others are keys of the map.
const LEAST_AREA: f64 = 0.01;
/// Least length of the light lines between areas, as a share of the image's longer side.
const LEAST_LINES: f64 = 0.3;
/// By how much grey walls are darker than paper at least, and the greatest share of them that is thicker than walls.
const GREY_CONTRAST: u8 = 60;
const MOST_THICK: f64 = 0.2;
/// Least share of pixels on floors seen from above that differ from the one before, and their darkest shade: what is darker
/// is ink.
const UNEVEN: f64 = 0.5;
const DARKEST_SHADE: u8 = 64;
/// Pixels that a first look takes.
const SAMPLES: usize = 10_007;

/// What lies between areas.
pub(super) struct Walls {
    /// 1 for wall.
    pub(super) mask: Vec<u8>,
    /// Whether the areas are floors as they look from above, with shadows and furniture, and not colours of a map.
    pub(super) rendered: bool,
}

/// The walls between areas of colour, and around them as thick. `None` for all other drawings.
///
/// `pixel` gives a colour on paper. Lettering is a part of the area around it.
pub(super) fn walls(width: usize, height: usize, pixel: impl Fn(usize) -> [u8; 3]) -> Option<Walls> {
    let paper = paper(width, height, &pixel)?;
    let is_area = |at: usize| !is_paper(pixel(at), paper);
    let is_dark = |at: usize| luma(pixel(at)) < LIGHTEST_INK;
    if let Some(Between { mask, .. }) = walls_between(width, height, is_area, is_dark) {
        return (!has_grey_walls(width, height, &pixel, paper)).then_some(Walls { mask, rendered: false });
    }
    let samples = || (1..width * height).step_by((width * height).div_ceil(SAMPLES)).filter(|&at| is_area(at));
    let uneven = samples().filter(|&at| pixel(at) != pixel(at - 1)).count();
    if (uneven as f64) < UNEVEN * samples().count() as f64 {
        return None;
    }
    let lightness: Vec<u8> = (0..width * height).map(|at| luma(pixel(at))).collect();
    let lightest = lightest_floor(&lightness);
    let is_shade = |at: usize| lightness[at] < DARKEST_SHADE;
    let Between { mut mask, areas, thickness } = walls_between(width, height, |at| lightness[at] < lightest, is_shade)?;
    // White furniture is thicker than walls, and stands alone.
    let light: Vec<u8> = areas.iter().map(|&area| 1 - area).collect();
    let thick = erode(&light, width, 0.75 * thickness as f64);
    let pieces = Components::of(&light, width, 1, Neighbours::Eight);
    for piece in pieces.all.iter().filter(|piece| !piece.is_at_side(width, height)) {
        if pieces.touches(piece, &thick, width) {
            pieces.paint(piece, &mut mask, width, 0);
        }
    }
    // Walls that are darker than paper have gaps where paper shows.
    let is_white = |at: usize| pixel(at).iter().zip(paper).all(|(&v, paper)| v.abs_diff(paper) <= PAPER_SPREAD / 2);
    let walls = mask.iter().filter(|&&wall| wall != 0).count();
    let white = (0..mask.len()).filter(|&at| mask[at] != 0 && is_white(at)).count();
    if white * 3 < walls {
        (0..mask.len()).filter(|&at| is_white(at)).for_each(|at| mask[at] = 0);
    }
    Some(Walls { mask, rendered: true })
}

/// Whether what is grey and darker than paper runs between the areas as walls do: thin, long and round places.
fn has_grey_walls(width: usize, height: usize, pixel: impl Fn(usize) -> [u8; 3], paper: [u8; 3]) -> bool {
    let darkest_area = luma(paper).saturating_sub(GREY_CONTRAST);
    let is_grey = |colour: [u8; 3]| chroma(colour) <= PAPER_SPREAD && luma(colour) <= darkest_area;
    let grey: Vec<u8> = (0..width * height).map(|at| u8::from(is_grey(pixel(at)))).collect();
    let radius = 0.5 * THICKEST * width.max(height) as f64;
    let thick = opened(&grey, width, radius);
    let count = |mask: &[u8]| mask.iter().filter(|&&m| m != 0).count() as f64;
    count(&thick) <= MOST_THICK * count(&grey) && tones::encloses(&grey, width)
}

/// The tone in the emptiest part of the histogram between floors and white walls.
fn lightest_floor(lightness: &[u8]) -> u8 {
    let mut counts = [0usize; 256];
    lightness.iter().for_each(|&l| counts[usize::from(l)] += 1);
    let around = |l: usize| counts[l - 4..=l + 4].iter().sum::<usize>();
    (160..240).min_by_key(|&l| (around(l), 255 - l)).unwrap_or(200) as u8
}

/// Walls between areas, the areas, and the walls' thickness in pixels.
struct Between {
    mask: Vec<u8>,
    areas: Vec<u8>,
    thickness: usize,
}

fn walls_between(
    width: usize,
    height: usize,
    is_area: impl Fn(usize) -> bool,
    is_dark: impl Fn(usize) -> bool,
) -> Option<Between> {
    let longer = width.max(height);
    // Most drawings are not of this kind: a look at some of the pixels tells.
    let may_be = |step: usize| {
        let some = || (0..width * height).step_by(step);
        let covered = some().filter(|&at| is_area(at)).count() as f64;
        let dark = some().filter(|&at| is_dark(at)).count() as f64;
        (COVERED[0]..=COVERED[1]).contains(&(covered / some().count() as f64)) && dark <= (1.0 - LIGHT) * covered
    };
    if !may_be((width * height).div_ceil(SAMPLES)) || !may_be(1) {
        return None;
    }
    let mask = |is_it: &dyn Fn(usize) -> bool| (0..width * height).map(|at| u8::from(is_it(at))).collect::<Vec<u8>>();
    if tones::has_lines(&mask(&is_dark), width) {
        return None;
    }
    let mut areas = mask(&is_area);
    let count = |mask: &[u8]| mask.iter().filter(|&&m| m != 0).count() as f64;
    let covered = count(&areas);
    let radius = (BROAD_SHARE * longer as f64).max(2.0);
    if count(&opened(&areas, width, radius)) < BROAD * covered {
        return None;
    }
    let pieces = Components::of(&areas, width, 1, Neighbours::Eight);
    for piece in pieces.all.iter().filter(|piece| (piece.area as f64) < LEAST_AREA * covered) {
        pieces.paint(piece, &mut areas, width, 0);
    }
    let thickness =
        between(&areas, width, (THICKEST * longer as f64) as usize, (LEAST_LINES * longer as f64) as usize)?;
    let near = dilate(&areas, width, thickness as f64);
    let mask = near.iter().zip(&areas).map(|(&near, &area)| near & (1 - area)).collect();
    Some(Between { mask, areas, thickness })
}

fn is_paper(colour: [u8; 3], paper: [u8; 3]) -> bool {
    colour.iter().zip(paper).all(|(&v, paper)| v.abs_diff(paper) <= PAPER_SPREAD)
}

/// The commonest colour at the image's rim, if it is light and nearly all is of it.
fn paper(width: usize, height: usize, pixel: impl Fn(usize) -> [u8; 3]) -> Option<[u8; 3]> {
    let mut rim: Vec<[u8; 3]> = tones::rim(width, height).map(pixel).collect();
    rim.sort_unstable();
    let paper = rim[rim.len() / 2];
    let share = rim.iter().filter(|&&colour| is_paper(colour, paper)).count() as f64 / rim.len() as f64;
    (luma(paper) >= DARKEST_PAPER && share >= PAPER_AT_RIM).then_some(paper)
}

/// Thickness of the light lines between areas, pixels: the median along rows and columns, if there are `fewest` such places.
fn between(areas: &[u8], width: usize, thickest: usize, fewest: usize) -> Option<usize> {
    let all = [0, 1].into_iter().flat_map(|along| spaces(areas, width, along));
    let mut found: Vec<usize> = all.map(|(.., count)| count).filter(|count| (1..=thickest).contains(count)).collect();
    found.sort_unstable();
    (found.len() >= fewest).then(|| found[found.len() / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rooms of colour with a light line of 4 pixels between them that has a gap of 10, and a key in the corner.
    fn map(line: [u8; 3]) -> impl Fn(usize) -> [u8; 3] {
        move |at| match (at % 200, at / 200) {
            (96..100, y) if (20..100).contains(&y) && !(50..60).contains(&y) => line,
            (x, y) if (20..180).contains(&x) && (20..100).contains(&y) => [250, 220 - u8::from(x < 98) * 30, 170],
            (2..6, 110..114) => [120, 200, 120],
            _ => [255; 3],
        }
    }

    #[test]
    fn light_lines_between_areas_are_walls() {
        let walls = walls(200, 120, map([255; 3])).unwrap().mask;
        let at = |x: usize, y: usize| walls[y * 200 + x] != 0;
        assert!(at(97, 30) && !at(97, 55) && !at(60, 55) && at(18, 60) && !at(14, 60) && !at(3, 112));
        let count = walls.iter().filter(|&&wall| wall != 0).count();
        // The corners are round.
        assert!((4 * 70 + 160 * 8 + 80 * 8..=4 * 70 + 168 * 88 - 160 * 80).contains(&count), "{count}");
    }

    #[test]
    fn drawings_with_dark_walls_are_none_of_these() {
        assert!(walls(200, 120, map([90; 3])).is_none());
        // Walls of mid grey around rooms of colour, as on maps of museums.
        let room = map([255; 3]);
        let grey = |at: usize| match (at % 200, at / 200) {
            (16..184, 16..104) if room(at) == [255; 3] => [140, 141, 144],
            _ => room(at),
        };
        assert!(walls(200, 120, grey).is_none());
        assert!(walls(200, 120, |_| [255; 3]).is_none());
    }
}
