//! Letters as strokes that people stand along.

use super::Strokes;
use crate::math::{Vec2, vec2};

/// Width and height of a letter in grid units, and the gap to the next letter.
const WIDTH: f64 = 4.0;
const HEIGHT: f64 = 6.0;
const GAP: f64 = 2.0;

/// The strokes of a letter on a grid of 5 x 7 points: lines of points "xy", y up, one after another.
#[rustfmt::skip]
fn drawn(letter: char) -> Option<&'static str> {
    Some(match letter {
        'A' => "00 26 40;12 32",
        'B' => "00 06 36 45 44 33 03;33 42 41 30 00",
        'C' => "45 36 16 05 01 10 30 41",
        'D' => "00 06 26 44 42 20 00",
        'E' => "46 06 00 40;03 33",
        'F' => "46 06 00;03 33",
        'G' => "45 36 16 05 01 10 30 41 43 23",
        'H' => "00 06;40 46;03 43",
        'I' => "20 26;10 30;16 36",
        'J' => "46 41 30 10 01",
        'K' => "00 06;46 03 40",
        'L' => "06 00 40",
        'M' => "00 06 23 46 40",
        'N' => "00 06 40 46",
        'O' | '0' => "10 01 05 16 36 45 41 30 10",
        'P' => "00 06 36 45 44 33 03",
        'Q' => "10 01 05 16 36 45 41 30 10;22 40",
        'R' => "00 06 36 45 44 33 03;23 40",
        'S' => "45 36 16 05 04 13 33 42 41 30 10 01",
        'T' => "06 46;20 26",
        'U' => "06 01 10 30 41 46",
        'V' => "06 20 46",
        'W' => "06 10 24 30 46",
        'X' => "00 46;06 40",
        'Y' => "06 23 46;23 20",
        'Z' => "06 46 00 40",
        '1' => "14 26 20;10 30",
        '2' => "05 16 36 45 44 00 40",
        '3' => "05 16 36 45 44 33 42 41 30 10 01;23 33",
        '4' => "30 36 02 42",
        '5' => "46 06 03 33 42 41 30 10 01",
        '6' => "45 36 16 05 01 10 30 41 42 33 03",
        '7' => "06 46 10",
        '8' => "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
        '9' => "43 13 04 05 16 36 45 41 30 10 01",
        '-' => "13 33",
        '+' => "13 33;22 24",
        '.' => "20 20",
        ':' => "21 21;24 24",
        '!' => "26 22;20 20",
        '?' => "05 16 36 45 44 23 22;20 20",
        '/' => "00 46",
        '\'' => "26 25",
        ' ' => "",
        _ => return None,
    })
}

/// The letters of a text that have no strokes.
pub(in super::super) fn unknown_letters(text: &str) -> String {
    text.chars().filter(|letter| drawn(letter.to_ascii_uppercase()).is_none()).collect()
}

/// The strokes of a text `height_m` high, relative to its centre; unknown letters are left out.
pub(in super::super) fn strokes(text: &str, height_m: f64) -> Strokes {
    let scale = height_m / HEIGHT;
    let mut lines: Strokes = Vec::new();
    for (k, letter) in text.chars().enumerate() {
        let left = k as f64 * (WIDTH + GAP);
        let point = |pair: &str| -> Option<Vec2> {
            let mut digits = pair.chars().filter_map(|digit| digit.to_digit(10)).map(f64::from);
            Some(vec2(left + digits.next()?, digits.next()?) * scale)
        };
        let line = |line: &str| -> Vec<Vec2> { line.split(' ').filter_map(point).collect() };
        let of_letter = drawn(letter.to_ascii_uppercase()).unwrap_or("").split(';').map(line);
        lines.extend(of_letter.filter(|line| !line.is_empty()));
    }
    let points = || lines.iter().flatten();
    let low = points().fold(vec2(f64::MAX, f64::MAX), |low, p| vec2(low.x.min(p.x), low.y.min(p.y)));
    let high = points().fold(vec2(f64::MIN, f64::MIN), |high, p| vec2(high.x.max(p.x), high.y.max(p.y)));
    let middle = (low + high) / 2.0;
    lines.iter().map(|line| line.iter().map(|&point| point - middle).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_lies_in_its_grid() {
        for letter in (' '..='~').filter(|&letter| drawn(letter).is_some()) {
            for line in drawn(letter).unwrap().split(';').filter(|line| !line.is_empty()) {
                for pair in line.split(' ') {
                    let digits: Vec<u32> = pair.chars().map(|digit| digit.to_digit(10).unwrap()).collect();
                    assert!(digits.len() == 2 && digits[0] <= 4 && digits[1] <= 6, "{letter}: {pair}");
                }
                assert!(line.contains(' '), "{letter}: a line has two ends");
            }
        }
        assert!(('A'..='Z').chain('0'..='9').all(|letter| drawn(letter).is_some()));
        assert_eq!(unknown_letters("Aé#b"), "é#");
    }

    #[test]
    fn a_text_is_as_high_as_asked_for_and_in_the_middle() {
        let lines = strokes("Hi 2", 3.0);
        let points: Vec<Vec2> = lines.concat();
        let ys = points.iter().map(|p| p.y);
        assert!((ys.clone().fold(f64::MIN, f64::max) - 1.5).abs() < 1e-12);
        assert!((ys.fold(f64::MAX, f64::min) + 1.5).abs() < 1e-12);
        let xs = points.iter().map(|p| p.x);
        assert!((xs.clone().fold(f64::MIN, f64::max) + xs.fold(f64::MAX, f64::min)).abs() < 1e-12);
        assert!(strokes("", 1.0).is_empty() && strokes("  ", 1.0).is_empty());
    }
}
