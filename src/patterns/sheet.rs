//! The contact sheet: a library on one page, to scale.

use image::{Rgb, RgbImage};

use super::{Cause, Pattern, PatternLibrary, font};

/// A light floor, the soil on it, and the ink of labels.
const FLOOR: [u8; 3] = [222, 219, 212];
const SOIL: [u8; 3] = [70, 62, 52];
const RUBBER: [u8; 3] = [30, 29, 28];
const INK: [u8; 3] = [90, 90, 90];
/// Width of the page and space around things, pixels (10 px are a centimetre).
const PAGE: u32 = 1500;
const GAP: u32 = 30;
/// Dots of a label are squares of this side.
const DOT: u32 = 2;
/// Height of a line of a label.
const LINE: u32 = (font::HEIGHT + 3) * DOT;

/// Draws the library at 10 px/cm: soles as pairs that walk up the page, heel marks along their drag, each with name,
/// size and share, and a bar of 10 cm.
pub fn contact_sheet(library: &PatternLibrary) -> RgbImage {
    let mut rows: Vec<Row> = Vec::new();
    for cause in Cause::ALL {
        let cells = library.patterns.iter().filter(|pattern| pattern.cause == cause).map(Cell::new);
        rows.extend(arrange(cells.collect()));
    }
    let height = rows.iter().map(|row| row.height + GAP).sum::<u32>() + 2 * GAP + LINE;
    let width = rows.iter().map(|row| row.width).fold(PAGE, u32::max);
    let mut page = RgbImage::from_pixel(width, height, Rgb(FLOOR));
    let mut top = GAP;
    for row in rows {
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
struct Cell<'a> {
    pattern: &'a Pattern,
    labels: [String; 2],
    width: u32,
    height: u32,
}

struct Row<'a> {
    cells: Vec<Cell<'a>>,
    width: u32,
    height: u32,
}

fn arrange(cells: Vec<Cell>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for cell in cells {
        match rows.last_mut() {
            Some(row) if row.width + cell.width + GAP <= PAGE => {
                row.width += cell.width + GAP;
                row.height = row.height.max(cell.height);
                row.cells.push(cell);
            }
            _ => rows.push(Row { width: 2 * GAP + cell.width, height: cell.height, cells: vec![cell] }),
        }
    }
    rows
}

impl<'a> Cell<'a> {
    fn new(pattern: &'a Pattern) -> Cell<'a> {
        let size = format!("{:.1} x {:.1} cm  {:.0} %", pattern.length_cm, pattern.breadth_cm(), pattern.share * 100.0);
        let labels = [pattern.name.replace('_', " "), size];
        let text = labels.iter().map(|label| text_width(label)).fold(0, u32::max);
        let (across, along) = match pattern.cause {
            Cause::Sole => (2 * pattern.height_px + GAP, pattern.width_px),
            Cause::Heel => (pattern.width_px, pattern.height_px),
        };
        Cell { pattern, labels, width: across.max(text), height: along + GAP / 2 + 2 * LINE }
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
                    lay(page, pattern, SOIL, at);
                }
                top + pattern.width_px
            }
            Cause::Heel => {
                lay(page, pattern, RUBBER, |i, j| (left + i, top + j));
                top + pattern.height_px
            }
        };
        for (line, label) in self.labels.iter().enumerate() {
            write(page, label, left, label_top + GAP / 2 + line as u32 * LINE);
        }
    }
}

/// Lays a pattern on the page; `at` says where its pixel (column, row) goes.
fn lay(page: &mut RgbImage, pattern: &Pattern, colour: [u8; 3], at: impl Fn(u32, u32) -> (u32, u32)) {
    for (place, &coverage) in pattern.coverage.iter().enumerate() {
        let (i, j) = (place as u32 % pattern.width_px, place as u32 / pattern.width_px);
        let (x, y) = at(i, j);
        if let Some(pixel) = page.get_pixel_mut_checked(x, y) {
            for (channel, soil) in pixel.0.iter_mut().zip(colour) {
                let (floor, cover) = (u32::from(*channel), u32::from(coverage));
                *channel = ((floor * (255 - cover) + u32::from(soil) * cover) / 255) as u8;
            }
        }
    }
}

fn text_width(text: &str) -> u32 {
    text.chars().count() as u32 * (font::WIDTH + 1) * DOT
}

fn write(page: &mut RgbImage, text: &str, left: u32, top: u32) {
    for (n, character) in text.chars().enumerate() {
        let left = left + n as u32 * (font::WIDTH + 1) * DOT;
        for (row, bits) in (0..).zip(font::rows(character)) {
            for column in (0..font::WIDTH).filter(|column| bits >> (font::WIDTH - 1 - column) & 1 == 1) {
                fill(page, left + column * DOT, top + row * DOT, DOT, DOT);
            }
        }
    }
}

/// A bar of 10 cm with a tick at each half.
fn scale_bar(page: &mut RgbImage, left: u32, top: u32) {
    fill(page, left, top + 6, 100, 3);
    for tick in [0, 50, 98] {
        fill(page, left + tick, top, 2, 15);
    }
    write(page, "10 cm", left + 112, top);
}

fn fill(page: &mut RgbImage, left: u32, top: u32, width: u32, height: u32) {
    for (x, y) in (left..left + width).flat_map(|x| (top..top + height).map(move |y| (x, y))) {
        if let Some(pixel) = page.get_pixel_mut_checked(x, y) {
            *pixel = Rgb(INK);
        }
    }
}
