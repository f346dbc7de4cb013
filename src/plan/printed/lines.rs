//! Lengths of dimension lines and scale bars, by the numbers that stand at them.

use super::page::{Area, Page};
use super::words::Number;

/// Greatest distance of a number from its line, in heights of its digits.
const BESIDE: f64 = 1.3;
/// Reach above and below a line in which its ends show, in heights of the digits.
const REACH: f64 = 0.35;
/// Greatest thickness of a line and of those that cross its ends, in heights of the digits.
const THICK: f64 = 0.35;
/// Greatest length of an arrow head or a tick, in heights of the digits.
const LONGEST_END: f64 = 3.0;

/// A line that runs along x: its first row and its thickness.
#[derive(Clone, Copy)]
struct Line {
    y: i32,
    thick: i32,
}

/// Lengths in pixels of the dimension lines that a number may belong to: below, above and on both sides.
pub(super) fn dimensions(page: &Page, text: &Area) -> Vec<f64> {
    let height = text.height();
    let far = (f64::from(height) * BESIDE) as i32;
    let below = line(page, text.x, (text.y[1] + 1..text.y[1] + far).collect());
    let above = line(page, text.x, (text.y[0] - far..text.y[0] - 1).rev().collect());
    let mut found: Vec<f64> = Vec::new();
    for line in [below, above].into_iter().flatten() {
        found.extend(length(page, line, text.x, height));
    }
    // The number stands in a gap of the line.
    let run = (height / 2).max(4);
    let middle = text.middle()[1];
    let sides = [text.x[0] - far - run..text.x[0] - 1, text.x[1] + 1..text.x[1] + far + run];
    for y in middle - height / 5..=middle + height / 5 {
        let near = |range: &std::ops::Range<i32>| {
            let is_run = |x: &i32| (0..run).all(|k| page.is_ink(x + k, y));
            (range.start..range.end - run).find(is_run)
        };
        if found.is_empty()
            && let (Some(left), Some(right)) = (near(&sides[0]), near(&sides[1]))
        {
            found.extend(length(page, Line { y, thick: 1 }, [left + run / 2, right + run / 2], height));
            break;
        }
    }
    found
}

/// The first row that is a line below or above a text.
fn line(page: &Page, [from, to]: [i32; 2], rows: Vec<i32>) -> Option<Line> {
    let is_line = |y: i32| (from..to).filter(|&x| !page.is_ink(x, y)).count() * 20 <= (to - from) as usize;
    let first = *rows.iter().find(|&&y| is_line(y))?;
    let end = |way: i32| (0..).map(|k| first + way * k).take(rows.len()).take_while(|&y| is_line(y)).last();
    let (top, bottom) = (end(-1)?, end(1)?);
    let thick = bottom - top + 1;
    (thick <= ((f64::from(rows.len() as i32) / BESIDE * THICK) as i32).max(3)).then_some(Line { y: top, thick })
}

/// The length of a line between its ends on both sides of a stretch.
fn length(page: &Page, line: Line, [from, to]: [i32; 2], height: i32) -> Option<f64> {
    let (left, right) = (end(page, line, from, -1, height)?, end(page, line, to, 1, height)?);
    (right - left > f64::from(to - from)).then_some(right - left)
}

/// Where a line ends that is followed from a place: at a line across it, in the middle of a tick or a dot, at an arrow's tip
/// or at the face of a wall.
fn end(page: &Page, line: Line, from: i32, way: i32, height: i32) -> Option<f64> {
    let reach = ((f64::from(height) * REACH) as i32).max(3);
    let thickest = ((f64::from(height) * THICK) as i32).max(5);
    let mut y = line.y;
    // The columns of an end: where, the ink above and below.
    let mut columns: Vec<(i32, [i32; 2])> = Vec::new();
    let mut white = 0;
    let mut x = from;
    loop {
        x += way;
        let on_line = |y: i32| (0..line.thick).any(|k| page.is_ink(x, y + k));
        let goes_on = match [y, y - 1, y + 1].into_iter().find(|&y| on_line(y)) {
            Some(next) => {
                // A slanted tick leads off the line.
                y = if columns.is_empty() { next } else { y };
                true
            }
            None => false,
        };
        let count = |rows: [i32; 2]| (rows[0]..rows[1]).filter(|&y| page.is_ink(x, y)).count() as i32;
        let ink = [count([y - 1 - reach, y - 1]), count([y + line.thick + 1, y + line.thick + 1 + reach])];
        if ink != [0, 0] {
            columns.push((x, ink));
            white = 0;
        } else if !columns.is_empty() {
            white += 1;
        }
        let full = columns.iter().rev().take_while(|(_, ink)| ink[0] == reach || ink[1] == reach).count() as i32;
        if full > thickest {
            let face = columns[columns.len() - full as usize].0;
            return Some(f64::from(face) - 0.5 * f64::from(way));
        }
        if columns.len() as f64 > LONGEST_END * f64::from(height) {
            return None;
        }
        // The tip of an arrow is as thin as the line: the line that it points at comes later.
        let is_crossed = columns.iter().any(|(_, ink)| ink[0] == reach || ink[1] == reach);
        let patience = if is_crossed { 2 } else { height * 5 / 4 };
        if !goes_on || white >= patience {
            let all: i32 = columns.iter().map(|(_, ink)| ink[0] + ink[1]).sum();
            if all >= 3 {
                return match (is_arrow(&columns, reach, way), goes_on) {
                    (true, true) => None,
                    (true, false) => Some(f64::from(x - way)),
                    (false, _) => Some(place(&columns, reach)),
                };
            }
            if !goes_on {
                return None;
            }
            columns.clear();
            white = 0;
        }
    }
}

/// Whether the columns of a line's end are the head of an arrow, widest at its back, and no line across it.
fn is_arrow(columns: &[(i32, [i32; 2])], reach: i32, way: i32) -> bool {
    let (Some((first, _)), Some((last, _))) = (columns.first(), columns.last()) else { return false };
    let ink: i32 = columns.iter().map(|(_, ink)| ink[0] + ink[1]).sum();
    let centre = columns.iter().map(|(x, ink)| f64::from(x * (ink[0] + ink[1]))).sum::<f64>() / f64::from(ink);
    let behind = (f64::from(first + last) * 0.5 - centre) * f64::from(way);
    columns.iter().all(|(_, ink)| ink[0] < reach && ink[1] < reach) && behind > 0.12 * f64::from((last - first).abs())
}

/// The place that the columns of a line's end mean: the line across it, else their middle.
fn place(columns: &[(i32, [i32; 2])], reach: i32) -> f64 {
    let across = |is: fn([i32; 2], i32) -> bool| -> Vec<i32> {
        columns.iter().filter(|(_, ink)| is(*ink, reach)).map(|(x, _)| *x).collect()
    };
    let both = across(|ink, reach| ink == [reach; 2]);
    let one = across(|ink, reach| ink[0] == reach || ink[1] == reach);
    match [both, one].into_iter().find(|line| !line.is_empty()) {
        Some(line) => f64::from(line.iter().sum::<i32>()) / line.len() as f64,
        None => f64::from(columns[0].0 + columns[columns.len() - 1].0) * 0.5,
    }
}

/// Scale bars: the numbers at their far ends, and their lengths, pixels. A bar runs below or above its numbers, from the
/// one that is 0 to another.
pub(super) fn bars<'a>(page: &Page, numbers: &'a [Number]) -> Vec<(&'a Number, f64)> {
    let wide = page.wide();
    let mut found = Vec::new();
    for zero in numbers.iter().filter(|number| number.value == 0.0) {
        let height = zero.area.height();
        let [x, y] = zero.area.middle();
        let is_bar = |bar: &&Area| {
            let apart = (bar.y[0] - zero.area.y[1]).max(zero.area.y[0] - bar.y[1]);
            (bar.x[0] - x).abs() <= height && (0..=2 * height).contains(&apart) && bar.height() <= 2 * height
        };
        let at_end = |bar: &Area, end: &&Number| {
            end.value > 0.0
                && (end.area.middle()[1] - y).abs() <= height / 2
                && (end.area.middle()[0] - bar.x[1]).abs() <= height
        };
        let bar = wide.iter().filter(is_bar).find_map(|bar| Some((bar, numbers.iter().find(|end| at_end(bar, end))?)));
        // The ends of a ruled line are in the middle of its strokes: to a pixel that is the same.
        found.extend(bar.map(|(bar, end)| (end, f64::from(bar.width()))));
    }
    found
}
