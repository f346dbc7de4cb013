//! The contact sheet: all patterns of a library on one page, to scale.

use image::{GrayImage, Rgb, RgbImage, imageops};
use imageproc::drawing::draw_filled_rect_mut;
use imageproc::rect::Rect;

use super::{Cause, Pattern, PatternLibrary, font};
use crate::math;

/// Colours of a light floor and a light wall, sRGB.
const FLOOR: [u8; 3] = [222, 219, 212];
const WALL: [u8; 3] = [231, 228, 219];
const INK: [u8; 3] = [90, 90, 90];
/// Width of the page and gap between patterns, pixels (10 px are 1 cm).
const PAGE: u32 = 1500;
const GAP: u32 = 30;
/// Side of a dot of a label, pixels.
const DOT: u32 = 2;
/// Height of a line of a label, pixels.
const LINE: u32 = (font::HEIGHT + 3) * DOT;

/// Draws the contact sheet of a library at 10 px/cm: every pattern with name, size and share.
///
/// Soles stand as pairs that walk up the page, heel marks lie along their drag, and wall patterns follow on a wall
/// colour. Causes have titles; a bar shows 10 cm.
pub fn contact_sheet(library: &PatternLibrary) -> RgbImage {
    let mut rows: Vec<PatternRow> = Vec::new();
    for cause in Cause::ALL {
        let cells = library.patterns.iter().filter(|pattern| pattern.cause == cause).map(LabelledPattern::new);
        rows.extend(arrange(cause, cells.collect()));
    }
    let height = rows.iter().map(PatternRow::total_height).sum::<u32>() + 2 * GAP + LINE;
    let width = rows.iter().map(|row| row.width).fold(PAGE, u32::max);
    let mut page = RgbImage::from_pixel(width, height, Rgb(FLOOR));
    let mut top = GAP;
    let is_on_wall = |row: &&PatternRow| row.cells.iter().any(|cell| cell.pattern.cause.on_wall().is_some());
    let wall_top =
        top + rows.iter().take_while(|row| !is_on_wall(row)).map(PatternRow::total_height).sum::<u32>() - GAP / 2;
    if rows.iter().any(|row| is_on_wall(&row)) {
        fill(&mut page, [0, wall_top], [width, height - wall_top], WALL);
    }
    for row in rows {
        if let Some(title) = row.title {
            write(&mut page, title, GAP, top);
            top += LINE + GAP / 2;
        }
        let mut left = GAP;
        for cell in row.cells {
            let base = top + row.height - cell.height;
            cell.draw(&mut page, left, base);
            left += cell.width + GAP;
        }
        top += row.height + GAP;
    }
    scale_bar(&mut page, GAP, top);
    page
}

/// One pattern with its label below.
struct LabelledPattern<'a> {
    pattern: &'a Pattern,
    labels: [String; 2],
    width: u32,
    height: u32,
}

struct PatternRow<'a> {
    /// Name of the cause that begins with this row.
    title: Option<&'static str>,
    cells: Vec<LabelledPattern<'a>>,
    width: u32,
    height: u32,
}

impl PatternRow<'_> {
    fn total_height(&self) -> u32 {
        self.height + GAP + if self.title.is_some() { LINE + GAP / 2 } else { 0 }
    }
}

fn arrange(cause: Cause, cells: Vec<LabelledPattern>) -> Vec<PatternRow> {
    let mut rows: Vec<PatternRow> = Vec::new();
    for cell in cells {
        match rows.last_mut() {
            Some(row) if row.width + cell.width + GAP <= PAGE => {
                row.width += cell.width + GAP;
                row.height = row.height.max(cell.height);
                row.cells.push(cell);
            }
            last => {
                let title = last.is_none().then(|| cause.name());
                rows.push(PatternRow { title, width: 2 * GAP + cell.width, height: cell.height, cells: vec![cell] });
            }
        }
    }
    rows
}

impl<'a> LabelledPattern<'a> {
    fn new(pattern: &'a Pattern) -> LabelledPattern<'a> {
        let share = pattern.share * 100.0;
        let size = format!("{:.1} x {:.1} cm  {share:.0} %", pattern.length_cm, pattern.breadth_cm());
        let name = pattern.name.replace('_', " ");
        let labels = [name, size];
        let text = labels.iter().map(|label| text_width(label)).fold(0, u32::max);
        let (across, along) = match pattern.cause {
            Cause::Sole => (2 * pattern.height_px + GAP, pattern.width_px),
            _ => (pattern.width_px, pattern.height_px),
        };
        LabelledPattern { pattern, labels, width: across.max(text), height: along + GAP / 2 + 2 * LINE }
    }

    fn draw(&self, page: &mut RgbImage, left: u32, top: u32) {
        let pattern = self.pattern;
        let label_top = match pattern.cause {
            Cause::Sole => {
                for right_foot in [false, true] {
                    let shift = if right_foot { pattern.height_px + GAP } else { 0 };
                    let at = |i: u32, j: u32| {
                        let across = if right_foot { pattern.height_px - 1 - j } else { j };
                        (left + shift + across, top + pattern.width_px - 1 - i)
                    };
                    blend(page, pattern.width_px, &pattern.coverage, grime(pattern.cause), at);
                }
                top + pattern.width_px
            }
            _ => {
                let at = |i: u32, j: u32| (left + i, top + j);
                blend(page, pattern.width_px, &pattern.coverage, grime(pattern.cause), at);
                top + pattern.height_px
            }
        };
        for (line, label) in self.labels.iter().enumerate() {
            write(page, label, left, label_top + GAP / 2 + line as u32 * LINE);
        }
    }
}

/// Colour (sRGB) and optical density at full coverage of the grime of a cause, a little denser than in a bake.
fn grime(cause: Cause) -> ([u8; 3], f64) {
    match cause {
        Cause::Sole => ([70, 62, 52], 2.5),
        Cause::Heel => ([30, 29, 28], 3.0),
        Cause::Hand | Cause::Arm | Cause::Shoulder => ([104, 91, 71], 1.4),
        Cause::Bag => ([72, 72, 73], 1.5),
        Cause::Shoe => ([42, 41, 40], 2.5),
    }
}

/// Draws a pattern alone on the floor or the wall that its cause marks.
pub(super) fn on_ground(coverage: &GrayImage, cause: Cause) -> RgbImage {
    let ground = if cause.on_wall().is_some() { WALL } else { FLOOR };
    let mut picture = RgbImage::from_pixel(coverage.width(), coverage.height(), Rgb(ground));
    blend(&mut picture, coverage.width(), coverage.as_raw(), grime(cause), |i, j| (i, j));
    picture
}

/// Blends a pattern into the page; `at` maps its pixel (column, row) to the page.
fn blend(
    page: &mut RgbImage,
    width_px: u32,
    coverage: &[u8],
    (colour, density): ([u8; 3], f64),
    at: impl Fn(u32, u32) -> (u32, u32),
) {
    // Share exp(-D) of the ground shows; the rest is grime.
    let shows: Vec<f64> = (0..256).map(|cover| math::exp(-density * f64::from(cover) / 255.0)).collect();
    for (place, &coverage) in coverage.iter().enumerate() {
        let (x, y) = at(place as u32 % width_px, place as u32 / width_px);
        if let Some(pixel) = page.get_pixel_mut_checked(x, y) {
            let shows = shows[usize::from(coverage)];
            for (channel, soil) in pixel.0.iter_mut().zip(colour) {
                *channel = (f64::from(*channel) * shows + f64::from(soil) * (1.0 - shows)).round() as u8;
            }
        }
    }
}

/// Draws pictures in a row on a wall's colour, each below its label.
pub(crate) fn side_by_side(parts: &[(&str, RgbImage)]) -> RgbImage {
    let column = |(label, part): &(&str, RgbImage)| part.width().max(text_width(label)) + GAP;
    let width = parts.iter().map(column).sum::<u32>() + GAP;
    let height = parts.iter().map(|(_, part)| part.height()).fold(0, u32::max) + 3 * GAP + LINE;
    let mut page = RgbImage::from_pixel(width, height, Rgb(WALL));
    let mut left = GAP;
    for labelled in parts {
        write(&mut page, labelled.0, left, GAP);
        imageops::replace(&mut page, &labelled.1, i64::from(left), i64::from(GAP + LINE + GAP / 2));
        left += column(labelled);
    }
    page
}

fn text_width(text: &str) -> u32 {
    text.chars().count() as u32 * (font::WIDTH + 1) * DOT
}

fn write(page: &mut RgbImage, text: &str, left: u32, top: u32) {
    for (n, character) in text.chars().enumerate() {
        let left = left + n as u32 * (font::WIDTH + 1) * DOT;
        for (row, bits) in (0..).zip(font::rows(character)) {
            for column in (0..font::WIDTH).filter(|column| bits >> (font::WIDTH - 1 - column) & 1 == 1) {
                fill(page, [left + column * DOT, top + row * DOT], [DOT, DOT], INK);
            }
        }
    }
}

/// A bar of 10 cm with a tick at each half.
fn scale_bar(page: &mut RgbImage, left: u32, top: u32) {
    fill(page, [left, top + 6], [100, 3], INK);
    for tick in [0, 50, 98] {
        fill(page, [left + tick, top], [2, 15], INK);
    }
    write(page, "10 cm", left + 112, top);
}

fn fill(page: &mut RgbImage, [left, top]: [u32; 2], [width, height]: [u32; 2], colour: [u8; 3]) {
    draw_filled_rect_mut(page, Rect::at(left as i32, top as i32).of_size(width, height), Rgb(colour));
}
