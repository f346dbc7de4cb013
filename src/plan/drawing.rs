//! Converts pixels of any format to lightness, and finds wall pixels.

use image::{DynamicImage, GenericImageView};
use rayon::prelude::*;

use super::colour::{Colour, is_pane, is_saturated, luma};
use super::components::around;
use super::ink::{self, Ink};
use super::lightness::{is_annotation, lightness_of, map_pixels, on_paper};
use super::ros_map::{Cell, Greys};
use super::tones::{SURELY_DARK, USUAL_THRESHOLD};
use super::wall_tops::Tops;
use super::{
    PlanOptions, TransparentPolicy, UnknownPolicy, colour_areas, floor_pieces, hatching, level_map, paving, shadow,
    sheet, skew, squared, thin_lines, tones, wall_tops,
};

/// Greys of unknown and of free cells as mappers write them.
const MAP_UNKNOWN: u8 = 205;
const MAP_FREE: u8 = 254;
/// Lightness below which a pixel may be of a fine line, and on clean paper.
const FAINT: u8 = 180;
const FAINTEST: u8 = 225;

/// The pixels of a plan image by lightness, wall and colour.
#[derive(Clone)]
pub(super) struct Drawing {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Lightness: 0 for the plan's wall tone, 255 for its floor tone.
    pub(super) lightness: Vec<u8>,
    /// 1 for wall pixels.
    pub(super) dark: Vec<u8>,
    /// 1 for pixels of saturated colour; empty if there are none.
    pub(super) coloured: Vec<u8>,
    /// 1 for pixels of dark saturated colour; empty if there are none.
    pub(super) dark_colour: Vec<u8>,
    /// 1 for pixels of the pale blue of panes; empty if there are none.
    pub(super) pane: Vec<u8>,
    /// 1 for outlines of furniture on a floor as it looks from above; empty for other drawings.
    pub(super) pieces: Vec<u8>,
    /// Whether paper and floors are even, without grain or texture: faint strokes show.
    pub(super) clean: bool,
    /// Threshold between wall and floor, in the image's own lightness.
    pub(super) threshold: u8,
    /// Lightness below which a pixel is surely of a wall or a stroke.
    pub(super) surely_dark: u8,
    /// Whether it is a robot's map, measured rather than drawn: without text, doors or dashes.
    pub(super) scanned: bool,
    /// Whether it is a plain image with the greys of a robot's map.
    pub(super) looks_like_map: bool,
    /// Side of the squares of a grid over all floors, pixels.
    pub(super) square_px: Option<f64>,
}

/// Whether a mask has a pixel; an empty one has none.
pub(super) fn is_on(mask: &[u8], at: usize) -> bool {
    mask.get(at).is_some_and(|&on| on != 0)
}

/// Reads an image by the greys of a ROS map.
pub(super) fn of_map(image: DynamicImage, greys: &Greys, options: &PlanOptions) -> Drawing {
    let width = image.width() as usize;
    let policy = match options.transparent {
        TransparentPolicy::Auto => None,
        TransparentPolicy::Paper | TransparentPolicy::Floor => Some(Cell::Free),
        TransparentPolicy::Wall => Some(Cell::Occupied),
    };
    let is_dark = |[r, g, b, a]: [u8; 4]| {
        let grey = (f64::from(r) + f64::from(g) + f64::from(b)) / 3.0;
        let cell = match policy {
            Some(cell) if a < 255 => cell,
            _ => greys.cell(grey, a == 255),
        };
        match cell {
            Cell::Free => false,
            Cell::Occupied => true,
            Cell::Unknown => options.unknown == UnknownPolicy::Wall,
        }
    };
    let dark: Vec<u8> = map_pixels(&image, |pixel| u8::from(is_dark(pixel)));
    drop(image);
    let lightness = dark.iter().map(|&d| (1 - d) * 255).collect();
    Drawing { scanned: true, ..Drawing::of(width, lightness, dark) }
}

/// Least share of coloured pixels with which colour is the paper's own, not annotation.
const COLOURED_PAPER: usize = 3;

/// Reads a plain image: white is floor, black is wall, saturated colour is annotation. Returns warnings about what was
/// put right too.
///
/// Sheets in photographs are straightened, scans that lie askew are turned, uneven light is evened out, light walls on a
/// dark ground are inverted.
pub(super) fn of_image(image: DynamicImage, options: &PlanOptions) -> (Drawing, Vec<String>) {
    let mut warnings = Vec::new();
    let (mut coloured, mut share, mut lightness) = masks(&image, options);
    let is_unasked = options.threshold.is_none() && options.invert.is_none();
    let looks_like_map = is_unasked && coloured.is_empty() && has_map_greys(&lightness);
    let may_be_rendered = is_unasked && !looks_like_map && options.wall_colours.is_empty();
    if let Some(drawing) = may_be_rendered.then(|| of_tops(&image)).flatten() {
        warnings.push(TOPS.to_owned());
        return (drawing, warnings);
    }
    let sheet = if looks_like_map { None } else { sheet::find(&image) };
    let askew = if looks_like_map || sheet.is_some() { None } else { skew::find(&image) };
    let image = match (&sheet, &askew) {
        (Some(found), _) => {
            let straight = sheet::straightened(&image, found);
            warnings.push(told_sheet(found, straight.dimensions()));
            DynamicImage::ImageRgb8(straight)
        }
        (None, Some((turned, angle_deg))) => {
            let straight = sheet::straightened(&image, turned);
            warnings.push(skew::told(*angle_deg, straight.dimensions()));
            let straight = DynamicImage::ImageRgb8(straight);
            (coloured, share, lightness) = masks(&straight, options);
            straight
        }
        (None, None) => image,
    };
    let (width, height) = (image.width() as usize, image.height() as usize);
    if is_unasked && sheet.is_none() && !looks_like_map && options.wall_colours.is_empty() {
        let pixel = |at: usize| on_paper(image.get_pixel((at % width) as u32, (at / width) as u32).0);
        if let Some(walls) = colour_areas::walls(width, height, pixel) {
            warnings.push(AREAS.to_owned());
            // Shadows and furniture on floors are no lettering.
            let lightness = match walls.rendered {
                true => vec![255; walls.mask.len()],
                false => map_pixels(&image, |pixel| luma(on_paper(pixel))),
            };
            return (of_areas(width, &walls.mask, lightness), warnings);
        }
    }
    let may_be_inked = is_unasked && share > 0 && sheet.is_none() && options.wall_colours.is_empty();
    let (image, inverted) = match may_be_inked {
        true => of_lines_on_black(image, &mut coloured, options, &mut warnings),
        false => (image, false),
    };
    let inked = may_be_inked.then(|| ink_of(&image, &coloured)).flatten();
    // Coloured pens are ink on a photograph, as are the lines of a blueprint.
    if sheet.is_some() || share * COLOURED_PAPER > coloured.len() || inked == Some(Ink::OnTintedPaper) {
        coloured = Vec::new();
        lightness = map_pixels(&image, |pixel| luma(on_paper(pixel)));
    } else if let Some(Ink::OfColour(colour)) = inked {
        warnings.push(told_colour(colour));
        let options = PlanOptions { wall_colours: vec![colour], ..options.clone() };
        coloured = map_pixels(&image, |pixel| u8::from(is_annotation(pixel, &options)));
        lightness = map_pixels(&image, |pixel| lightness_of(pixel, &options));
    } else if share > 0 {
        lightness = map_pixels(&image, |pixel| lightness_of(pixel, options));
    }
    let of_colour = |is_it: fn([u8; 3]) -> bool| {
        let has_colour = image.color().has_color() && sheet.is_none();
        let found = if has_colour { map_pixels(&image, |pixel| u8::from(is_it(on_paper(pixel)))) } else { Vec::new() };
        if found.contains(&1) { found } else { Vec::new() }
    };
    let pane = of_colour(is_pane);
    let is_dark_colour = |pixel| is_saturated(pixel) && luma(pixel) < USUAL_THRESHOLD;
    let dark_colour = if coloured.is_empty() { Vec::new() } else { of_colour(is_dark_colour) };
    // Of large plans it is the most memory.
    drop(image);
    let threshold = match options.threshold {
        Some(threshold) => threshold,
        // Unless unknown is floor, a robot's map is wall up to the grey of unknown cells.
        None if looks_like_map && options.unknown == UnknownPolicy::Wall => MAP_UNKNOWN + 1,
        None => USUAL_THRESHOLD,
    };
    let mut drawing = Drawing {
        height,
        coloured,
        dark_colour,
        pane,
        threshold,
        scanned: looks_like_map,
        looks_like_map,
        ..Drawing::of(width, Vec::new(), Vec::new())
    };
    if looks_like_map {
        drawing.dark = lightness.iter().map(|&l| u8::from(l < threshold)).collect();
        drawing.lightness = drawing.dark.iter().map(|&d| (1 - d) * 255).collect();
        return (drawing, warnings);
    }
    if is_unasked && sheet.is_none() && level_map::join_cells(width, &mut lightness) {
        warnings.push(CELLS.to_owned());
    } else if !inverted {
        settle_tones(&mut drawing, &mut lightness, options, &mut warnings);
    }
    let mut dark: Vec<u8> = lightness.iter().map(|&l| u8::from(l < drawing.threshold)).collect();
    drawing.clean = is_clean(&lightness);
    drawing.surely_dark = stretch(width, &mut lightness, &dark);
    thin_lines::close(width, &lightness, &mut dark);
    shadow::even_floors(width, &mut lightness, &dark);
    thin_lines::even(width, &mut lightness, &mut dark);
    (drawing.lightness, drawing.dark) = (lightness, dark);
    drop_paving(&mut drawing);
    (drawing, warnings)
}

const CELLS: &str = "the lines between tiles or cells of a map on dark ground were left out: light was taken for floor; \
                     `[plan] threshold` takes them for walls";

/// A map of coloured lines on black becomes a drawing on paper: black is white, and the lines are dark.
fn of_lines_on_black(
    image: DynamicImage,
    coloured: &mut Vec<u8>,
    options: &PlanOptions,
    warnings: &mut Vec<String>,
) -> (DynamicImage, bool) {
    let width = image.width();
    let lightness = |at: usize| lightness_of(image.get_pixel(at as u32 % width, at as u32 / width).0, options);
    if !level_map::is_coloured_on_black(width as usize, coloured, lightness) {
        return (image, false);
    }
    let mut negative = image.to_rgba8();
    negative.pixels_mut().for_each(|pixel| {
        let [r, g, b] = level_map::negative(on_paper(pixel.0));
        pixel.0 = [r, g, b, 255];
    });
    let negative = DynamicImage::ImageRgba8(negative);
    *coloured = map_pixels(&negative, |pixel| u8::from(is_annotation(pixel, options)));
    warnings.push("walls are coloured lines on black: black was taken for floor".to_owned());
    (negative, true)
}

const AREAS: &str = "no walls are drawn: the light lines between areas of colour were taken for walls; \
                     `[plan] threshold` takes what is dark instead";

const TOPS: &str = "floors are drawn as they look from above: even tones between them were taken for walls; \
                    `[plan] threshold` takes what is dark instead";

/// Greatest breadth of shadows around a building, as a share of the image's longer side.
const SHADOW_SHARE: f64 = 0.015;

/// A floor as it looks from above: the tops of walls are dark, and furniture on floors has outlines. Around the
/// building, ink is as it is.
fn of_tops(image: &DynamicImage) -> Option<Drawing> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let pixel = |at: usize| on_paper(image.get_pixel((at % width) as u32, (at / width) as u32).0);
    let Tops { colours, walls, glass } = wall_tops::find(width, height, pixel)?;
    let rim: Vec<usize> = tones::rim(width, height).collect();
    let is_paper = rim.iter().filter(|&&at| luma(colours[at]) >= USUAL_THRESHOLD).count() * 2 > rim.len();
    // Sides and shadows of walls lie beside them.
    let beside = (SHADOW_SHARE * width.max(height) as f64) as usize;
    let mut building = [width, height, 0, 0];
    for at in (0..walls.len()).filter(|&at| walls[at] != 0) {
        let [x, y] = [at % width, at / width];
        building = [building[0].min(x), building[1].min(y), building[2].max(x), building[3].max(y)];
    }
    let is_around = |at: usize| {
        let [x, y] = [at % width, at / width];
        x + beside < building[0] || y + beside < building[1] || x > building[2] + beside || y > building[3] + beside
    };
    let solid: Vec<u8> = walls.iter().zip(&glass).map(|(wall, glass)| wall | glass).collect();
    let pieces = floor_pieces::find(&colours, &solid, width);
    let lightness = |at: usize| match () {
        () if walls[at] != 0 => 0,
        () if is_paper && is_around(at) => luma(colours[at]),
        () => 255,
    };
    let lightness: Vec<u8> = (0..walls.len()).map(lightness).collect();
    let dark = lightness.iter().map(|&l| u8::from(l < USUAL_THRESHOLD)).collect();
    Some(Drawing { pane: glass, pieces, ..Drawing::of(width, lightness, dark) })
}

/// Walls between areas of colour, and the lettering in these.
fn of_areas(width: usize, walls: &[u8], mut lightness: Vec<u8>) -> Drawing {
    for (lightness, &wall) in lightness.iter_mut().zip(walls) {
        *lightness = match *lightness {
            _ if wall != 0 => 0,
            ink if ink < USUAL_THRESHOLD => ink,
            _ => 255,
        };
    }
    let dark = lightness.iter().map(|&l| u8::from(l < USUAL_THRESHOLD)).collect();
    Drawing::of(width, lightness, dark)
}

/// Whether nearly all light pixels are as light as the one before.
fn is_clean(lightness: &[u8]) -> bool {
    const CLEAN: f64 = 0.86;
    let light = lightness.array_windows().filter(|[_, l]| *l >= FAINT);
    let (all, even) =
        light.fold((0usize, 0usize), |(all, even), [before, l]| (all + 1, even + usize::from(before == l)));
    even as f64 >= CLEAN * all as f64
}

/// Takes the lines of floor coverings off. Among what is left of them, faint strokes are no strokes.
fn drop_paving(drawing: &mut Drawing) {
    /// One pixel of so many is one of a covering in faint lines at least.
    const FEWEST: usize = 1000;
    let all = drawing.faint_strokes();
    let has_faint = all.iter().filter(|&&faint| faint != 0).count() * FEWEST >= drawing.dark.len();
    let passes: &[&[u8]] = if has_faint { &[&[], &all] } else { &[&[]] };
    for faint in passes {
        let is_stroke =
            |at: usize, lightness: u8| lightness < FAINT || drawing.dark[at] != 0 || is_on(&drawing.coloured, at);
        let dark = drawing.lightness.iter().enumerate().map(|(at, &lightness)| match () {
            () if is_stroke(at, lightness) => (255 - lightness).max(255 - FAINT),
            () if is_on(faint, at) => 255 - lightness,
            () => 0,
        });
        let mut ink = paving::Ink { dark: dark.collect(), width: drawing.width };
        let paving = paving::find(&ink);
        drawing.square_px = drawing.square_px.or(paving.square_px);
        let mut lines = paving.lines;
        // Of planks and tiles there is nothing left then.
        lines.iter().for_each(|&at| ink.dark[at] = 0);
        lines.extend(hatching::lines(&ink));
        drawing.clean &= lines.is_empty();
        for at in lines {
            drawing.dark[at] = 0;
            drawing.lightness[at] = 255;
            if let Some(coloured) = drawing.coloured.get_mut(at) {
                *coloured = 0;
            }
        }
        if !drawing.clean {
            break;
        }
    }
}

impl Drawing {
    /// A drawing without colours, at the usual threshold.
    pub(super) fn of(width: usize, lightness: Vec<u8>, dark: Vec<u8>) -> Drawing {
        Drawing {
            width,
            height: dark.len() / width,
            lightness,
            dark,
            coloured: Vec::new(),
            dark_colour: Vec::new(),
            pane: Vec::new(),
            pieces: Vec::new(),
            clean: false,
            threshold: USUAL_THRESHOLD,
            surely_dark: SURELY_DARK,
            scanned: false,
            looks_like_map: false,
            square_px: None,
        }
    }

    /// What of a mask has not the pale blue of panes.
    pub(super) fn without_panes(&self, mask: &[u8]) -> Vec<u8> {
        mask.iter().enumerate().map(|(at, &on)| on & u8::from(!is_on(&self.pane, at))).collect()
    }

    /// 1 for strokes on clean paper that are lighter than others, as grey lines of a pixel or less are; empty if paper is not
    /// clean. Anti-aliased flanks of darker strokes are none, but where a faint one ends there or joins two.
    pub(super) fn faint_strokes(&self) -> Vec<u8> {
        if !self.clean {
            return Vec::new();
        }
        let width = self.width;
        let is_faint = |at: usize| (FAINT..FAINTEST).contains(&self.lightness[at]);
        let is_ink = |at: usize| self.lightness.get(at).is_some_and(|&l| l < FAINT);
        let apart = |at: usize| u8::from(is_faint(at) && !around(at, width).any(is_ink));
        let apart: Vec<u8> = (0..self.lightness.len()).into_par_iter().map(apart).collect();
        let ends = |at: usize| around(at, width).any(|near| apart.get(near).is_some_and(|&apart| apart != 0));
        // Where a stroke is just a little lighter for a pixel, it goes on.
        let joins = |at: usize| [1, width].into_iter().any(|by| is_ink(at.wrapping_sub(by)) && is_ink(at + by));
        (0..apart.len()).into_par_iter().map(|at| u8::from(is_faint(at) && (ends(at) || joins(at)))).collect()
    }
}

/// Brings light walls on a dark ground and uneven light into the usual form, and finds the threshold.
fn settle_tones(drawing: &mut Drawing, lightness: &mut [u8], options: &PlanOptions, warnings: &mut Vec<String>) {
    let (width, coloured) = (drawing.width, &drawing.coloured);
    let inverted =
        options.invert.unwrap_or_else(|| options.threshold.is_none() && tones::is_inverted(width, lightness, coloured));
    if inverted {
        let plain = lightness.iter_mut().enumerate().filter(|(at, _)| coloured.is_empty() || coloured[*at] == 0);
        plain.for_each(|(_, l)| *l = 255 - *l);
        if options.invert.is_none() {
            warnings.push("walls are light on a dark ground: light was taken for wall; `[plan] invert = false` keeps dark as wall".to_owned());
            fill_void(width, lightness, coloured);
        }
    }
    if options.threshold.is_some() {
        return;
    }
    if let Some([low, high]) = shadow::even_out(width, lightness) {
        squared::lighten(width, lightness);
        drawing.threshold = tones::ink_threshold(lightness);
        warnings
            .push(format!("the light is uneven: the paper's tone goes from {low} to {high} of 255 and was evened out"));
        return;
    }
    squared::lighten(width, lightness);
    drawing.threshold = tones::wall_threshold(width, lightness, coloured);
    if drawing.threshold != USUAL_THRESHOLD {
        warnings.push(format!(
            "walls are grey or faint: tones below {} of 255 were taken for wall; `[plan] threshold` sets another",
            drawing.threshold
        ));
        tones::lighten_rims(width, lightness, drawing.threshold);
    }
}

/// Around a level seen from above lies nothing: of a ground of two tones the darker one becomes wall. Lightness is that of
/// the negative, on which the ground is light.
fn fill_void(width: usize, lightness: &mut [u8], coloured: &[u8]) {
    let positive: Vec<u8> = lightness.iter().map(|&l| 255 - l).collect();
    let split = tones::light_from(&positive, coloured);
    let Some(void) = level_map::void(width, &positive, |at| positive[at] >= split) else { return };
    for ((l, positive), void) in lightness.iter_mut().zip(positive).zip(void) {
        *l = if void != 0 || positive >= split { 0 } else { 255 };
    }
}

/// The coloured ink of a drawing, if its walls are of such.
fn ink_of(image: &DynamicImage, coloured: &[u8]) -> Option<Ink> {
    let luma = map_pixels(image, |pixel| luma(on_paper(pixel)));
    let width = image.width();
    let pixel = |at: usize| on_paper(image.get_pixel(at as u32 % width, at as u32 / width).0);
    ink::of(width as usize, &luma, coloured, pixel)
}

fn told_colour(colour: Colour) -> String {
    let name = String::from(colour);
    format!("walls are coloured: {name} was taken for wall; `[plan] wall_colours` names other colours")
}

/// Where annotation is, and its number of pixels; where there is none, the lightness of all instead.
fn masks(image: &DynamicImage, options: &PlanOptions) -> (Vec<u8>, usize, Vec<u8>) {
    let has_colour = image.color().has_color();
    let is_coloured = || map_pixels(image, |pixel| u8::from(is_annotation(pixel, options)));
    let coloured = if has_colour { is_coloured() } else { Vec::new() };
    match coloured.iter().filter(|&&c| c != 0).count() {
        0 => (Vec::new(), 0, map_pixels(image, |pixel| lightness_of(pixel, options))),
        share => (coloured, share, Vec::new()),
    }
}

fn told_sheet(sheet: &sheet::Sheet, (width, height): (u32, u32)) -> String {
    let corner = |[x, y]: [f64; 2]| format!("[{x:.0}, {y:.0}]");
    let corners = sheet.corners.map(corner).join(", ");
    format!(
        "a sheet of paper was found in a photograph, with corners at {corners}: it was straightened to {width} x {height} \
         pixels, in which places in pixels count from now on; what lies around it was left out"
    )
}

/// Whether a grey image has a robot's greys: 254 for free and 205 for unknown.
fn has_map_greys(lightness: &[u8]) -> bool {
    let counts = tones::histogram(lightness, &[]);
    let light: usize = counts[128..].iter().sum();
    let (unknown, free) = (counts[usize::from(MAP_UNKNOWN)], counts[usize::from(MAP_FREE)]);
    let lightest_but_free = counts[206..].iter().sum::<usize>() - free;
    unknown * 100 >= light && free * 20 >= light && free > lightest_but_free && (unknown + free) * 10 >= light * 6
}

/// Stretches lightness so that the plan's wall tone becomes 0 and its floor tone 255.
///
/// Values in between then give the share of a pixel that an anti-aliased edge covers. The floor's tone is the most
/// frequent one. The walls' tone is the most frequent one inside walls or, where all lines are thin, the 5 % quantile
/// of wall pixels.
///
/// Returns the lightness below which a pixel is surely dark: beside grey walls, black strokes would be thicker otherwise.
fn stretch(width: usize, lightness: &mut [u8], dark: &[u8]) -> u8 {
    /// One in so many pixels of ink is darker than the walls, by so much; and how much lighter than the walls their soft edges
    /// may be.
    const DARKER: usize = 50;
    const DARKER_BY: usize = 24;
    const SOFT: usize = 32;
    let (mut wall, mut amid, mut floor) = ([0usize; 256], [0usize; 256], [0usize; 256]);
    for (at, (&value, &is_dark)) in lightness.iter().zip(dark).enumerate() {
        let tone = usize::from(value);
        if is_dark == 0 {
            floor[tone] += 1;
            continue;
        }
        wall[tone] += 1;
        let is_amid = around(at, width).all(|near| dark.get(near).is_some_and(|&near| near != 0));
        amid[tone] += usize::from(is_amid);
    }
    let total: usize = wall.iter().sum();
    let commonest = |counts: &[usize; 256]| (0..256).max_by_key(|&l| (counts[l], l)).unwrap_or(0);
    let wall_tone = if amid.iter().sum::<usize>() * 20 >= total {
        // Of equally frequent tones, the darkest.
        (0..256).max_by_key(|&l| (amid[l], std::cmp::Reverse(l))).unwrap_or(0)
    } else {
        let mut seen = 0;
        wall.iter()
            .position(|&count| {
                seen += count;
                seen * 20 >= total && seen > 0
            })
            .unwrap_or(0)
    };
    let floor_tone = commonest(&floor);
    if floor_tone < wall_tone + 32 {
        return SURELY_DARK;
    }
    let span = floor_tone - wall_tone;
    let table: Vec<u8> = (0..256usize)
        .map(|l| ((l.clamp(wall_tone, floor_tone) - wall_tone) * 510 / span).div_ceil(2).min(255) as u8)
        .collect();
    for value in lightness {
        *value = table[usize::from(*value)];
    }
    let darker: usize = wall[..wall_tone.saturating_sub(DARKER_BY)].iter().sum();
    let limit = (wall_tone + SOFT).max(usize::from(SURELY_DARK));
    if darker * DARKER >= total { table[limit].min(SURELY_DARK) } else { SURELY_DARK }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, RgbImage, RgbaImage};

    fn rgb(pixels: &[[u8; 3]], options: &PlanOptions) -> Vec<u8> {
        let image = RgbImage::from_vec(pixels.len() as u32, 1, pixels.concat()).unwrap();
        of_image(DynamicImage::ImageRgb8(image), options).0.dark
    }

    #[test]
    fn white_is_floor_black_is_wall_colour_is_annotation() {
        let pixels = [[255, 255, 255], [0, 0, 0], [255, 0, 0], [0, 0, 140], [200, 200, 200], [109, 108, 95]];
        assert_eq!(rgb(&pixels, &PlanOptions::default()), [0, 1, 0, 0, 0, 1]);
    }

    #[test]
    fn a_named_colour_is_wall() {
        let options = PlanOptions { wall_colours: vec![Colour([255, 0, 0])], ..PlanOptions::default() };
        let pixels = [[255, 255, 255], [0, 0, 0], [250, 5, 0], [0, 0, 140], [200, 200, 200]];
        assert_eq!(rgb(&pixels, &options), [0, 1, 1, 0, 0]);
    }

    #[test]
    fn the_threshold_is_the_darkest_floor() {
        let image = GrayImage::from_vec(256, 1, (0..=255).collect()).unwrap();
        for threshold in [1, 100, 128, 255] {
            let options = PlanOptions { threshold: Some(threshold), ..PlanOptions::default() };
            let walls = of_image(DynamicImage::ImageLuma8(image.clone()), &options).0.dark;
            assert_eq!(walls.iter().filter(|&&d| d == 1).count(), usize::from(threshold));
        }
    }

    #[test]
    fn transparent_is_paper_or_what_the_setting_says() {
        let image = RgbaImage::from_vec(3, 1, vec![0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255]).unwrap();
        let image = DynamicImage::ImageRgba8(image);
        let dark = |transparent| of_image(image.clone(), &PlanOptions { transparent, ..PlanOptions::default() }).0.dark;
        assert_eq!(dark(TransparentPolicy::Auto), [0, 1, 0]);
        assert_eq!(dark(TransparentPolicy::Wall), [1, 1, 0]);
        assert_eq!(dark(TransparentPolicy::Floor), [0, 1, 0]);
        let greys = Greys { mode: Default::default(), negate: false, occupied_at: 0.65, free_at: 0.196 };
        assert_eq!(of_map(image, &greys, &PlanOptions::default()).dark, [1, 1, 0]);
    }

    #[test]
    fn sixteen_bits_are_read_as_eight() {
        let image = image::ImageBuffer::from_vec(2, 1, vec![0x7fffu16, 0x80ff]).unwrap();
        assert_eq!(of_image(DynamicImage::ImageLuma16(image), &PlanOptions::default()).0.dark, [1, 0]);
    }

    #[test]
    fn strips_of_a_few_pixels_are_read() {
        for (width, height) in [(3, 5000), (5000, 3), (1, 700)] {
            let noise = |x: u32, y: u32| image::Rgb([7919, 5003, 3001].map(|k| ((x * k + y * 104_729) % 251) as u8));
            let image = DynamicImage::ImageRgb8(RgbImage::from_fn(width, height, noise));
            let drawing = of_image(image, &PlanOptions::default()).0;
            assert_eq!([drawing.width, drawing.height], [width, height].map(|px| px as usize));
        }
    }

    #[test]
    fn tones_are_stretched_to_black_and_white() {
        // A thick wall of 110 with an anti-aliased edge of 182 on paper of 254.
        let mut lightness = [[110, 110, 110, 182, 254, 254, 255]; 4].concat();
        lightness[21] = 90;
        let dark: Vec<u8> = lightness.iter().map(|&l| u8::from(l < 128)).collect();
        stretch(7, &mut lightness, &dark);
        assert_eq!(lightness[..7], [0, 0, 0, 128, 255, 255, 255]);
        assert_eq!(lightness[21..], [0, 0, 0, 128, 255, 255, 255]);
    }

    #[test]
    fn a_robots_map_without_its_yaml_is_recognised() {
        let pixels = [vec![254; 60], vec![205; 30], vec![0; 10]].concat();
        let image = DynamicImage::ImageLuma8(GrayImage::from_vec(100, 1, pixels).unwrap());
        let drawing = of_image(image.clone(), &PlanOptions::default()).0;
        assert!(drawing.looks_like_map);
        assert_eq!(drawing.dark.iter().filter(|&&d| d == 1).count(), 40);
    }
}
