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
/// Small digits run into each other: pieces at least so many heights wide are cut into parts of such widths, where the
/// columns between hold at most this share of the ink of a mean column.
const RUN_TOGETHER: f64 = 1.3;
const PART_WIDTHS: [f64; 2] = [0.5, 0.95];
const BETWEEN: f64 = 0.62;
/// How much taller a digit is than a small letter behind it.
const TALLER: f64 = 1.12;

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
        let all = small.map(|(k, piece)| Mark { area: page.area(piece), piece: k });
        let (wide, mut marks): (Vec<Mark>, Vec<Mark>) = all.partition(Page::may_run_together);
        marks.sort_by_key(|mark| mark.area.x[1]);
        let parts: Vec<Mark> = wide.into_iter().flat_map(|mark| page.parts(mark, &marks)).collect();
        marks.extend(parts);
        marks.sort_by_key(|mark| (mark.area.x, mark.area.y));
        page.marks = marks;
        page
    }

    fn may_run_together(mark: &Mark) -> bool {
        let [width, height] = [mark.area.width(), mark.area.height()];
        height >= LEAST_PX && f64::from(width) >= RUN_TOGETHER * f64::from(height)
    }

    /// A mark, or the digits that run together in it. What is lower than the digit before it is an m; the others come in the
    /// order of their right sides.
    fn parts(&self, mark: Mark, others: &[Mark]) -> Vec<Mark> {
        let [width, height] = [mark.area.width(), mark.area.height()].map(f64::from);
        let from = others.partition_point(|other| other.area.x[1] < mark.area.x[0] - 2 * mark.area.height());
        let mut before = others[from..].iter().take_while(|other| other.area.x[1] <= mark.area.x[0]);
        let is_digit = |other: &Mark| {
            other.area.y[1].abs_diff(mark.area.y[1]) <= 1 && f64::from(other.area.height()) >= TALLER * height
        };
        if before.any(is_digit) {
            return vec![mark];
        }
        let (own, across) = (self.darkness_of(&mark), mark.area.width() as usize);
        let column = |x: usize| own.iter().skip(x).step_by(across).map(|&dark| f64::from(dark)).sum::<f64>();
        let columns: Vec<f64> = (0..across).map(column).collect();
        let mean = columns.iter().sum::<f64>() / width;
        // Digits are all as wide as each other: the cuts lie evenly, to a pixel.
        let cuts = |count: usize| -> Vec<usize> {
            let near = |k: usize| {
                let middle = k * across / count;
                (middle - 1..=middle + 1).min_by(|a, b| columns[*a].total_cmp(&columns[*b])).unwrap_or(middle)
            };
            (1..count).map(near).collect()
        };
        let ink = |cuts: &[usize]| cuts.iter().map(|&x| columns[x]).fold(0.0, f64::max);
        let [most, least] = PART_WIDTHS.map(|share| (width / (share * height)).floor() as usize);
        let tried = (least.max(1) + 1..=most).map(cuts);
        let Some(cuts) = tried.min_by(|a, b| ink(a).total_cmp(&ink(b))).filter(|cuts| ink(cuts) <= BETWEEN * mean)
        else {
            return vec![mark];
        };
        let ends: Vec<usize> = [0].into_iter().chain(cuts).chain([across]).collect();
        let part = |pair: &[usize]| {
            let is_inked = |y: &i32| (pair[0]..pair[1]).any(|x| own[*y as usize * across + x] > 0);
            let rows: Vec<i32> = (0..mark.area.height()).filter(is_inked).collect();
            let y = [*rows.first()?, rows.last()? + 1].map(|y| mark.area.y[0] + y);
            let x = [pair[0], pair[1]].map(|x| mark.area.x[0] + x as i32);
            Some(Mark { area: Area { x, y }, piece: mark.piece })
        };
        ends.windows(2).filter_map(part).collect()
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

    /// The darkness of a mark's own pixels in its box, row by row.
    pub(super) fn darkness_of(&self, mark: &Mark) -> Vec<u8> {
        let area = &mark.area;
        let mut own = vec![0u8; (area.width() * area.height()) as usize];
        let piece = &self.ink.pieces.all[mark.piece];
        for run in self.ink.pieces.runs(piece) {
            for x in run.from..run.to {
                let [px, py] = [x as i32, run.y as i32];
                let [x, y] = if self.is_turned { [self.ink.drawing.height as i32 - 1 - py, px] } else { [px, py] };
                if (area.x[0]..area.x[1]).contains(&x) && (area.y[0]..area.y[1]).contains(&y) {
                    own[((y - area.y[0]) * area.width() + x - area.x[0]) as usize] = self.darkness([x, y]);
                }
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
