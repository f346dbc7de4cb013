//! The ink of a drawing as text is read on it: upright, or turned by a quarter as along vertical dimension lines.

use super::super::components::{Component, Components, Neighbours};
use super::super::drawing::{Drawing, is_on};

/// Lightness below which a pixel belongs to a letter: strokes of small letters are grey.
const FAINT: u8 = 180;
/// Lightness below which a pixel may be a faint point or a part of a letter.
const FAINTEST: u8 = 215;
/// Least height of a glyph that can be read, and greatest side of one, pixels.
const LEAST_PX: i32 = 7;
const MOST_PX: i32 = 72;

/// A box on a page, pixels: least x and y, then one beyond the greatest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) x: [i32; 2],
    pub(super) y: [i32; 2],
}

impl Area {
    pub(super) fn width(&self) -> i32 {
        self.x[1] - self.x[0]
    }

    pub(super) fn height(&self) -> i32 {
        self.y[1] - self.y[0]
    }

    pub(super) fn middle(&self) -> [i32; 2] {
        [(self.x[0] + self.x[1]) / 2, (self.y[0] + self.y[1]) / 2]
    }

    /// The least box around both.
    pub(super) fn with(&self, other: &Area) -> Area {
        let both = |a: [i32; 2], b: [i32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Area { x: both(self.x, other.x), y: both(self.y, other.y) }
    }
}

/// A connected piece of ink, small enough for a letter.
pub(super) struct Mark {
    pub(super) area: Area,
    /// Its index among the components.
    piece: usize,
}

/// What is drawn, by connected pieces.
pub(super) struct Ink<'a> {
    drawing: &'a Drawing,
    pieces: Components,
}

impl<'a> Ink<'a> {
    pub(super) fn of(drawing: &'a Drawing) -> Ink<'a> {
        let is_ink = |at: usize| u8::from(drawing.lightness[at] < FAINT || is_on(&drawing.coloured, at));
        let mask: Vec<u8> = (0..drawing.lightness.len()).map(is_ink).collect();
        Ink { drawing, pieces: Components::of(&mask, drawing.width, 1, Neighbours::Eight) }
    }
}

/// A drawing as it is, or turned so that text that runs upwards runs to the right.
pub(super) struct Page<'a> {
    ink: &'a Ink<'a>,
    pub(super) is_turned: bool,
    /// From the least x on.
    pub(super) marks: Vec<Mark>,
}

impl<'a> Page<'a> {
    pub(super) fn of(ink: &'a Ink<'a>, is_turned: bool) -> Page<'a> {
        let mut page = Page { ink, is_turned, marks: Vec::new() };
        let is_small = |piece: &Component| piece.larger_side() <= MOST_PX as u32;
        let small = ink.pieces.all.iter().enumerate().filter(|(_, piece)| is_small(piece));
        page.marks = small.map(|(k, piece)| Mark { area: page.area(piece), piece: k }).collect();
        page.marks.sort_by_key(|mark| (mark.area.x, mark.area.y));
        page
    }

    /// Boxes of the pieces that are too wide for letters.
    pub(super) fn wide(&self) -> Vec<Area> {
        let all = self.ink.pieces.all.iter().map(|piece| self.area(piece));
        all.filter(|area| area.width() > LEAST_PX * 4 && area.height() * 4 <= area.width()).collect()
    }

    fn area(&self, piece: &Component) -> Area {
        let [[x0, y0], [x1, y1]] = [piece.min, piece.end].map(|corner| corner.map(|v| v as i32));
        let height = self.ink.drawing.height as i32;
        match self.is_turned {
            true => Area { x: [height - y1, height - y0], y: [x0, x1] },
            false => Area { x: [x0, x1], y: [y0, y1] },
        }
    }

    /// The pixel of the drawing at a place of the page.
    pub(super) fn pixel(&self, [x, y]: [i32; 2]) -> [i32; 2] {
        if self.is_turned { [y, self.ink.drawing.height as i32 - 1 - x] } else { [x, y] }
    }

    /// How dark a place is, 0 for paper to 255.
    fn darkness(&self, at: [i32; 2]) -> u8 {
        let drawing = self.ink.drawing;
        let [x, y] = self.pixel(at);
        if x < 0 || y < 0 || x >= drawing.width as i32 || y >= drawing.height as i32 {
            return 0;
        }
        let at = y as usize * drawing.width + x as usize;
        if is_on(&drawing.coloured, at) { 255 } else { 255 - drawing.lightness[at] }
    }

    pub(super) fn is_ink(&self, x: i32, y: i32) -> bool {
        self.darkness([x, y]) > 255 - FAINT
    }

    /// Whether a rectangle holds no ink.
    pub(super) fn is_empty(&self, x: [i32; 2], y: [i32; 2]) -> bool {
        self.is_lighter(x, y, FAINT)
    }

    /// Whether a rectangle beside a text holds no ink, not even a faint point, or the line alone in whose gap the text stands.
    pub(super) fn is_beside(&self, x: [i32; 2], y: [i32; 2]) -> bool {
        let [above, below] = [-1, 1].map(|way| (y[0] + y[1]) / 2 + way * (y[1] - y[0]) / 5);
        self.is_lighter(x, [y[0], above], FAINTEST) && self.is_lighter(x, [below, y[1]], FAINTEST)
    }

    fn is_lighter(&self, [x0, x1]: [i32; 2], [y0, y1]: [i32; 2], least: u8) -> bool {
        (y0..y1).all(|y| (x0..x1).all(|x| self.darkness([x, y]) <= 255 - least))
    }

    /// The darkness of a mark's own pixels, row by row in its box.
    pub(super) fn darkness_of(&self, mark: &Mark) -> Vec<u8> {
        let area = &mark.area;
        let mut own = vec![0u8; (area.width() * area.height()) as usize];
        let piece = &self.ink.pieces.all[mark.piece];
        for run in self.ink.pieces.runs(piece) {
            for x in run.from..run.to {
                let [px, py] = [x as i32, run.y as i32];
                let [x, y] = if self.is_turned { [self.ink.drawing.height as i32 - 1 - py, px] } else { [px, py] };
                own[((y - area.y[0]) * area.width() + x - area.x[0]) as usize] = self.darkness([x, y]);
            }
        }
        own
    }

    /// Whether a mark may be a digit or a capital letter by its size.
    pub(super) fn is_tall(mark: &Mark) -> bool {
        let [w, h] = [mark.area.width(), mark.area.height()];
        h >= LEAST_PX && w * 6 >= h && w * 5 <= h * 6
    }
}
