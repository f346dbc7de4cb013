//! Numbers in the lettering of a page, with their units.

use super::page::{Area, Mark, Page};
use super::shape::Alphabet;

/// Feet in metres.
const FOOT_M: f64 = 0.3048;
const DIGITS: &str = "0123456789";
/// Most letters of a unit: `sq. ft.`.
const UNIT_LETTERS: usize = 6;
/// Greatest gap between digits, around points and ones, and before a unit, in heights of the digits.
const GAP: f64 = 0.6;
const WIDE_GAP: f64 = 0.85;
const SPACE: f64 = 1.4;
/// Greatest gap between a bracket and a digit, and how much taller it is at least, in heights of the digit.
const BRACKET_GAP: f64 = 0.4;
const TALLER: f64 = 1.15;
/// After so many digits others change little: the likeliest ones will do.
const SURE_DIGITS: usize = 2;

/// The unit that follows a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    None,
    Length,
    Area,
}

/// A number that was read.
#[derive(Clone, Debug)]
pub(super) struct Number {
    /// In metres or square metres where a unit says so, else as printed.
    pub(super) value: f64,
    pub(super) unit: Unit,
    /// Whether it has a decimal point.
    pub(super) is_decimal: bool,
    /// Where it stands, without its unit.
    pub(super) area: Area,
    /// The number behind a following `x`.
    pub(super) times: Option<Box<Number>>,
}

/// A page whose marks are told by their shape.
struct Reader<'a> {
    page: &'a Page<'a>,
    alphabet: &'a Alphabet,
    wide: Vec<Area>,
}

/// All numbers of a page, from left to right.
pub(super) fn numbers(page: &Page, alphabet: &Alphabet) -> Vec<Number> {
    let reader = Reader { page, alphabet, wide: page.wide() };
    let mut found: Vec<Number> = Vec::new();
    let mut after = vec![false; page.marks.len()];
    for k in 0..page.marks.len() {
        if after[k] || !Page::is_tall(&page.marks[k]) || !reader.is_free(k) || reader.digit(k).is_none() {
            continue;
        }
        let (number, read) = reader.number(k);
        read.into_iter().for_each(|k| after[k] = true);
        found.extend(number);
    }
    found
}

impl Reader<'_> {
    fn letter(&self, k: usize, among: &str) -> Option<char> {
        let mark = &self.page.marks[k];
        self.alphabet.letter(&self.page.darkness_of(mark), mark.area.width() as usize, among)
    }

    fn digit(&self, k: usize) -> Option<char> {
        if Page::is_tall(&self.page.marks[k]) { self.letter(k, DIGITS) } else { None }
    }

    /// Whether nothing lies before a mark, where unread digits may be, and something behind it or a scale bar at it.
    fn is_free(&self, k: usize) -> bool {
        let area = self.page.marks[k].area;
        let height = area.height();
        let reach = (f64::from(height) * WIDE_GAP) as i32;
        let start = self.bracket_before(&area).unwrap_or(area.x[0]);
        self.page.is_beside([start - reach, start - 1], area.y)
            && (self.next(k, &area, SPACE).is_some() || self.is_at_bar(&area, 0, [area.middle()[0], height]))
    }

    /// Whether a digit stands at one end of a scale bar, 0 or 1: a place of it, along the line, is at most so far from there.
    fn is_at_bar(&self, digit: &Area, end: usize, [x, most]: [i32; 2]) -> bool {
        let apart = |bar: &Area| (bar.middle()[1] - digit.middle()[1]).abs();
        self.wide.iter().any(|bar| apart(bar) <= 3 * digit.height() && (bar.x[end] - x).abs() <= most)
    }

    /// Where a bracket begins that opens before a digit.
    fn bracket_before(&self, digit: &Area) -> Option<i32> {
        let height = f64::from(digit.height());
        let is_bracket = |area: &Area| {
            let [w, h] = [area.width(), area.height()].map(f64::from);
            let is_near = area.x[1] <= digit.x[0] && f64::from(digit.x[0] - area.x[1]) <= BRACKET_GAP * height;
            is_near && h >= TALLER * height && w <= 0.5 * height && area.y[0] <= digit.y[0] && area.y[1] >= digit.y[1]
        };
        self.page.marks.iter().find(|mark| is_bracket(&mark.area)).map(|mark| mark.area.x[0])
    }

    /// The mark that follows another on a line of digits.
    fn next(&self, k: usize, line: &Area, reach: f64) -> Option<usize> {
        let height = f64::from(line.height());
        let [slack, far] = [0.4, reach].map(|share| (height * share) as i32);
        let from = self.page.marks[k].area;
        let on_line = |area: &Area| {
            area.y[0] >= line.y[0] - slack
                && area.y[1] <= line.y[1] + slack
                && area.middle()[0] > from.middle()[0]
                && area.x[1] > from.x[1]
        };
        let later = self.page.marks.iter().enumerate().skip(k + 1);
        let mut near = later.take_while(|(_, mark)| mark.area.x[0] <= from.x[1] + far);
        let (next, mark) = near.find(|(_, mark)| on_line(&mark.area))?;
        // Lines of the drawing may pass between.
        let clear = self.page.is_empty([from.x[1], mark.area.x[0]], line.y);
        clear.then_some(next)
    }

    /// The number that begins at a mark; the marks that were read too.
    fn number(&self, first: usize) -> (Option<Number>, Vec<usize>) {
        let line = self.page.marks[first].area;
        let mut area = line;
        let (mut text, mut read, mut last) = (String::new(), vec![first], first);
        text.extend(self.digit(first));
        let mut gaps: Vec<i32> = Vec::new();
        // The numbers of scale bars are round.
        let round = if self.is_at_bar(&line, 1, [line.x[1], 2 * line.height()]) { "0" } else { "" };
        while let Some(next) = self.next(last, &line, WIDE_GAP) {
            let is_minor = text.chars().filter(char::is_ascii_digit).count() >= SURE_DIGITS;
            let likely = if is_minor { DIGITS } else { round };
            let Some(letter) = self.part(next, &line, likely) else { break };
            let gap = self.page.marks[next].area.x[0] - self.page.marks[last].area.x[1];
            let narrow = |letter: Option<char>| letter.is_some_and(|letter| !"023456789".contains(letter));
            if !narrow(text.chars().last()) && !narrow(Some(letter)) {
                if f64::from(gap) > GAP * f64::from(line.height()) {
                    break;
                }
                gaps.push(gap);
            }
            text.push(letter);
            read.push(next);
            area = area.with(&self.page.marks[next].area);
            last = next;
        }
        // Two numbers side by side.
        let uneven = match (gaps.iter().min(), gaps.iter().max()) {
            (Some(least), Some(most)) => f64::from(most - least) > 0.25 * f64::from(line.height()) + 1.0,
            _ => false,
        };
        let (unit, more) = self.unit(last, &line);
        read.extend(&more);
        let parsed = value(&text).filter(|_| !uneven);
        let (Some((value, is_feet)), Some(unit)) = (parsed, unit) else { return (None, read) };
        let is_decimal = text.contains('.');
        let (value, kind) = match unit.trim_end_matches('x') {
            "" if is_feet => (value, Unit::Length),
            "" => (value, Unit::None),
            "m" => (value, Unit::Length),
            "m2" => (value, Unit::Area),
            "ft" => (value * FOOT_M, Unit::Length),
            _ => (value * FOOT_M * FOOT_M, Unit::Area),
        };
        let mut number = Number { value, unit: kind, is_decimal, area, times: None };
        if unit.ends_with('x') {
            let end = more.last().copied().unwrap_or(last);
            let other = self.next(end, &line, SPACE).filter(|&next| self.digit(next).is_some());
            if let Some(other) = other {
                let (second, more) = self.number(other);
                read.extend(more);
                number.times = second.map(Box::new);
            }
        }
        (Some(number), read)
    }

    /// A digit, point, dash or sign for feet on a line of digits; the likeliest digit if that is one of `likely`.
    fn part(&self, k: usize, line: &Area, likely: &str) -> Option<char> {
        let area = self.page.marks[k].area;
        let height = f64::from(line.height());
        let [w, h] = [area.width(), area.height()].map(f64::from);
        let [above, below] = [area.y[0] - line.y[0], area.y[1] - line.y[1]].map(f64::from);
        let near = |a: f64, share: f64| a.abs() <= share * height + 1.0;
        match () {
            () if near(h - height, 0.12) && near(below, 0.1) => {
                let mark = &self.page.marks[k];
                let likeliest =
                    || self.alphabet.likeliest(&self.page.darkness_of(mark), mark.area.width() as usize, DIGITS);
                self.digit(k).or_else(|| likeliest().filter(|digit| likely.contains(*digit)))
            }
            () if w <= 0.3 * height + 1.0 && h <= 0.3 * height + 1.0 && near(below, 0.1) => Some('.'),
            () if w <= 0.4 * height && h <= 0.5 * height && below > 0.0 && above >= 0.65 * height => Some('.'),
            () if w <= 0.3 * height + 1.0 && h >= 0.2 * height && h <= 0.5 * height && near(above, 0.2) => Some('\''),
            () if h <= 0.2 * height + 1.0 && w >= 0.2 * height && w <= height && near(above + below, 0.4) => Some('-'),
            () => None,
        }
    }

    /// The unit behind a mark, `x` at its end for a factor that follows; `None` where the number itself goes on.
    fn unit(&self, mut last: usize, line: &Area) -> (Option<&'static str>, Vec<usize>) {
        let (mut text, mut read, mut reach) = (String::new(), Vec::new(), SPACE);
        let end = self.page.marks[last].area.x[1];
        let clear = (f64::from(line.height()) * SPACE) as i32;
        while let Some(next) = self.next(last, line, reach) {
            let letter = self.unit_letter(next, line);
            let Some(letter) = letter.filter(|_| text.len() < UNIT_LETTERS) else { break };
            if letter != '.' {
                text.push(letter);
            }
            read.push(next);
            (last, reach) = (next, WIDE_GAP);
            if letter == 'x' {
                break;
            }
        }
        const UNITS: [&str; 10] = ["m2", "sqft", "sf", "ft2", "sqftx", "mx", "ftx", "x", "m", "ft"];
        // A four may look like a capital M.
        let is_length = text.starts_with('M') && !text.starts_with("M2");
        let text = if is_length { String::new() } else { text.to_lowercase() };
        let unit = UNITS.into_iter().find(|unit| text.starts_with(unit));
        if unit.is_none() && !self.page.is_beside([end, end + clear], line.y) {
            return (None, read);
        }
        (Some(unit.unwrap_or("")), if unit.is_some() { read } else { Vec::new() })
    }

    fn unit_letter(&self, k: usize, line: &Area) -> Option<char> {
        let mark = &self.page.marks[k];
        let height = f64::from(line.height());
        let [w, h] = [mark.area.width(), mark.area.height()].map(f64::from);
        let [above, below] = [mark.area.y[0] - line.y[0], mark.area.y[1] - line.y[1]].map(f64::from);
        let near = |a: f64, share: f64| a.abs() <= share * height + 1.0;
        let is_low = (0.5..=0.88).contains(&(h / height)) && near(below, 0.1);
        match () {
            () if is_low && w >= 0.85 * h && legs(&self.page.darkness_of(mark), mark) == 3 => Some('m'),
            () if is_low => self.letter(k, "xs"),
            () if near(h - height, 0.15) && near(below, 0.1) => self.letter(k, "2MxftsFTQ"),
            () if h <= 0.3 * height + 1.0 && w <= 0.3 * height + 1.0 && near(below, 0.1) => Some('.'),
            () if (0.3..=0.88).contains(&(h / height)) && below <= -0.12 * height && above >= -0.4 * height => {
                Some('2')
            }
            () if below > 0.12 * height && h >= 0.6 * height => self.letter(k, "q"),
            () => None,
        }
    }
}

/// Number of the legs of a letter: peaks of its darkness by column below its middle.
fn legs(darkness: &[u8], mark: &Mark) -> usize {
    let (width, height) = (mark.area.width() as usize, mark.area.height() as usize);
    let rows = height / 2..(height * 5 / 6).max(height / 2 + 1);
    let column = |x: usize| rows.clone().map(|y| f64::from(darkness[y * width + x])).sum::<f64>();
    let columns: Vec<f64> = (0..width).map(column).collect();
    let most = columns.iter().copied().fold(0.0, f64::max);
    // A leg begins where it grows darker by a third than the gap before it, and ends as it grows lighter.
    let (mut count, mut is_leg, mut turn) = (0, false, 0.0);
    for value in columns {
        turn = if is_leg { value.max(turn) } else { value.min(turn) };
        if (value - turn).abs() > 0.3 * most {
            (is_leg, turn) = (!is_leg, value);
            count += usize::from(is_leg);
        }
    }
    count
}

/// The value of a number as printed, in metres if it is in feet, and whether it is.
fn value(text: &str) -> Option<(f64, bool)> {
    let text = text.trim_end_matches('.');
    let Some((feet, inches)) = text.split_once('\'') else {
        let is_number = text.matches('.').count() <= 1 && !text.contains('-') && text.len() <= 8;
        // No decimals without a whole number, and no whole number that begins with a zero.
        let is_plain = !text.starts_with('.') && (!text.starts_with('0') || text.starts_with("0.") || text == "0");
        return text.parse().ok().filter(|_| is_number && is_plain).map(|value| (value, false));
    };
    let inches = inches.trim_start_matches('-');
    // Both strokes of the sign for inches may run together.
    let inches = match inches.strip_suffix("''").or_else(|| inches.strip_suffix('\'')) {
        Some(inches) => inches.parse::<f64>().ok().filter(|inches| (0.0..12.0).contains(inches))?,
        None if inches.is_empty() => 0.0,
        None => return None,
    };
    Some(((feet.parse::<f64>().ok()? + inches / 12.0) * FOOT_M, true))
}
