//! The scale that is printed on a plan: areas and sizes of rooms, dimensions, scale bars.
//!
//! Each number that is read, together with what it measures, says a scale. Only a scale on which several agree counts.

mod lines;
mod page;
mod shape;
mod words;

use self::page::{Area, Ink, Page};
use self::shape::Alphabet;
use self::words::{Number, Unit};
use super::drawing::Drawing;
use super::scale::{PlanScale, ScaleSource};
use super::understand;
use crate::math::ln;

/// How far scales that agree may lie apart: their ratio.
const AGREE: f64 = 1.04;
/// Least number of measures that agree, and their least share of all measures.
const FEWEST: usize = 3;
const LEAST_SHARE: f64 = 0.4;
/// Votes of a scale bar, both ends of which have numbers; of one that says its unit too, which is enough by itself.
const BAR_VOTES: usize = 2;
const BAR_WITH_UNIT_VOTES: usize = FEWEST;
/// Lengths that stand alone at a line are those of scale bars, metres.
const BARS_M: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Votes of a room's size: both numbers fit.
const SIZE_VOTES: usize = 2;
/// How far a printed scale may lie from the one that doors say; where so many measures agree, and at least this share of
/// all, doors were misread. Millimetres and centimetres are never both so near.
const FAR: f64 = 1.5;
const VERY_FAR: f64 = 3.0;
const MANY_AGREE: usize = 6;
const MOST_SHARE: f64 = 0.6;
/// So near to the scale that doors say, a few measures are enough that lie so near to each other.
const NEAR: f64 = 1.08;
const FEW_AGREE: usize = 2;
const AGREE_WELL: f64 = 1.006;
/// How sure a printed scale is where few and where many measures agree, and how far it may be off.
const SURENESS: [f64; 2] = [0.9, 0.99];
const MANY: f64 = 10.0;
const OFF: f64 = 0.02;
/// Lengths and areas that plans are labelled with, metres and square metres.
const LENGTHS_M: [f64; 2] = [0.3, 200.0];
const AREAS_M2: [f64; 2] = [0.5, 5000.0];

/// What a printed number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Dimension,
    Bar,
    Size,
    Area,
}

/// A scale that a printed number says.
#[derive(Clone, Copy, Debug)]
struct Measure {
    /// Which number: one may be in millimetres or in centimetres.
    number: usize,
    kind: Kind,
    metres: f64,
    pixels: f64,
    votes: usize,
}

impl Measure {
    fn scale(&self) -> f64 {
        self.metres / self.pixels
    }
}

/// A printed number about the room in which it stands.
struct RoomNumber {
    number: Number,
    at: [usize; 2],
}

/// Returns the metres per pixel that several printed numbers agree on, near to a guess or within what is possible.
pub(super) fn scale(drawing: &Drawing, guess: f64, possible: [f64; 2]) -> Option<(f64, PlanScale)> {
    let sane = [possible[0].min(guess / FAR), possible[1].max(guess * FAR)];
    let (mut measures, in_rooms) = read(drawing);
    if let Some(found) = found_in(&measures, guess, sane) {
        return Some(found);
    }
    // Rooms take longer to find.
    let votes: usize = measures.iter().map(|m| m.votes).sum();
    if in_rooms.is_empty() || SIZE_VOTES * in_rooms.len() + votes < FEWEST {
        return None;
    }
    measures.extend(measured_rooms(drawing, guess, &in_rooms));
    found_in(&measures, guess, sane)
}

/// What measures agree on within a range, or many of them or a scale bar beyond it.
fn found_in(measures: &[Measure], guess: f64, sane: [f64; 2]) -> Option<(f64, PlanScale)> {
    let misread = [guess / VERY_FAR, guess * VERY_FAR];
    let surely = || vote(measures, guess, misread, (MANY_AGREE, MOST_SHARE, AGREE));
    let nearly = || vote(measures, guess, [guess / NEAR, guess * NEAR], (FEW_AGREE, MOST_SHARE, AGREE_WELL));
    let by_bar = || {
        let bars: Vec<Measure> = measures.iter().copied().filter(|measure| measure.kind == Kind::Bar).collect();
        vote(&bars, guess, misread, (BAR_WITH_UNIT_VOTES, MOST_SHARE, AGREE))
    };
    vote(measures, guess, sane, (FEWEST, LEAST_SHARE, AGREE)).or_else(surely).or_else(nearly).or_else(by_bar)
}

/// Reads both pages of a drawing, upright and turned: lengths, and numbers about rooms.
fn read(drawing: &Drawing) -> (Vec<Measure>, Vec<RoomNumber>) {
    let ink = Ink::of(drawing);
    let alphabet = Alphabet::new();
    let (mut measures, mut in_rooms) = (Vec::new(), Vec::new());
    let mut count = 0;
    for is_turned in [false, true] {
        let page = Page::of(&ink, is_turned);
        let numbers = words::numbers(&page, &alphabet);
        let bars = lines::bars(&page, &numbers);
        for (end, pixels) in &bars {
            count += 1;
            let votes = if end.unit == Unit::Length { BAR_WITH_UNIT_VOTES } else { BAR_VOTES };
            measures.push(Measure { number: count, kind: Kind::Bar, metres: end.value, pixels: *pixels, votes });
        }
        let ends: Vec<Area> = bars.iter().map(|(end, _)| end.area).collect();
        for number in numbers.into_iter().filter(|number| !ends.contains(&number.area)) {
            count += 1;
            let [x, y] = page.pixel(number.area.middle()).map(|place| place.max(0) as usize);
            if number.unit == Unit::Area || number.times.is_some() {
                in_rooms.push(RoomNumber { number, at: [x, y] });
                continue;
            }
            let pixels = lines::dimensions(&page, &number.area);
            let each = metres(&number).into_iter().flat_map(|metres| pixels.iter().map(move |&px| (metres, px)));
            let is_length = number.unit == Unit::Length && !number.is_decimal;
            let is_bar = is_length && BARS_M.contains(&number.value) && pixels.len() == 1;
            let (kind, votes) = if is_bar { (Kind::Bar, BAR_WITH_UNIT_VOTES) } else { (Kind::Dimension, 1) };
            measures.extend(each.map(|(metres, pixels)| Measure { number: count, kind, metres, pixels, votes }));
        }
    }
    (measures, in_rooms)
}

/// The lengths that a number may mean, metres.
fn metres(number: &Number) -> Vec<f64> {
    let values = match number.unit {
        Unit::Length => vec![number.value],
        Unit::None if number.is_decimal => vec![number.value],
        Unit::None if number.value >= 100.0 => vec![number.value / 1000.0, number.value / 100.0],
        _ => Vec::new(),
    };
    values.into_iter().filter(|metres| (LENGTHS_M[0]..=LENGTHS_M[1]).contains(metres)).collect()
}

/// What the numbers in rooms say, by the rooms that a guessed scale shows.
fn measured_rooms(drawing: &Drawing, guess: f64, numbers: &[RoomNumber]) -> Vec<Measure> {
    let Some(rooms) = understand::rooms(drawing, guess) else { return Vec::new() };
    let room_of: Vec<Option<usize>> = numbers.iter().map(|number| rooms.at(number.at)).collect();
    let mut found = Vec::new();
    for (k, (RoomNumber { number, .. }, room)) in numbers.iter().zip(&room_of).enumerate() {
        let Some(room) = *room else { continue };
        let is_alone = room_of.iter().filter(|other| **other == Some(room)).count() == 1;
        let (area, [w, h]) = rooms.area_and_size(room);
        // The numbers of pages begin at 1.
        let mut add = |kind: Kind, metres: f64, pixels: f64| {
            let votes = if kind == Kind::Size { SIZE_VOTES } else { 1 };
            found.push(Measure { number: usize::MAX - k, kind, metres, pixels, votes });
        };
        match &number.times {
            None if is_alone && (AREAS_M2[0]..=AREAS_M2[1]).contains(&number.value) => {
                add(Kind::Area, number.value.sqrt(), area.sqrt());
            }
            Some(other) => {
                for first in metres(number) {
                    for second in metres(other) {
                        let pairs = [(first / w, second / h, w + h), (second / w, first / h, w + h)];
                        for (a, b, pixels) in pairs {
                            if (a / b).max(b / a) <= AGREE {
                                add(Kind::Size, first + second, pixels);
                            }
                        }
                    }
                }
            }
            None => {}
        }
    }
    found
}

/// The scale that most measures agree on, if those are `enough`: their number, their share of all, and the ratio within which
/// they agree. Of two, as of millimetres and centimetres, the nearer to the guess.
fn vote(measures: &[Measure], guess: f64, sane: [f64; 2], enough: (usize, f64, f64)) -> Option<(f64, PlanScale)> {
    let (fewest, least_share, agree) = enough;
    let mut all: Vec<Measure> = measures.iter().copied().filter(|m| (sane[0]..=sane[1]).contains(&m.scale())).collect();
    all.sort_by(|a, b| a.scale().total_cmp(&b.scale()));
    let votes = |some: &[Measure]| {
        let mut numbers: Vec<(usize, usize)> = some.iter().map(|m| (m.number, m.votes)).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.iter().map(|(_, votes)| votes).sum::<usize>()
    };
    let window = |first: usize| {
        let end = all.partition_point(|m| m.scale() <= all[first].scale() * agree);
        &all[first..end]
    };
    let nearness = |some: &[Measure]| some.first().map_or(0.0, |m| -ln(m.scale() / guess).abs());
    let windows = (0..all.len()).map(window);
    let best = windows.max_by(|a, b| votes(a).cmp(&votes(b)).then(nearness(a).total_cmp(&nearness(b))))?;
    let count = votes(best);
    if count < fewest || (count as f64) < least_share * votes(&all) as f64 {
        return None;
    }
    // Long measures are surer.
    let half = best.iter().map(|m| m.pixels).sum::<f64>() * 0.5;
    let mut seen = 0.0;
    let middle = best.iter().find(|m| {
        seen += m.pixels;
        seen >= half
    })?;
    // Four significant digits: text and lines are measured to a pixel.
    let value = format!("{:.3e}", middle.scale()).parse().unwrap_or(middle.scale());
    let range = [value * (1.0 - OFF), value * (1.0 + OFF)];
    let share = (count.saturating_sub(FEWEST) as f64 / (MANY - FEWEST as f64)).min(1.0);
    let sureness = SURENESS[0] + (SURENESS[1] - SURENESS[0]) * share;
    Some((value, PlanScale { source: ScaleSource::Printed, sureness, range, evidence: told(best) }))
}

/// What measures are of: "7 printed room areas, 1 printed scale bar".
fn told(measures: &[Measure]) -> String {
    let names = [
        (Kind::Area, "room area"),
        (Kind::Size, "room size"),
        (Kind::Dimension, "dimension"),
        (Kind::Bar, "scale bar"),
    ];
    let named = names.into_iter().filter_map(|(kind, name)| {
        let mut numbers: Vec<usize> = measures.iter().filter(|m| m.kind == kind).map(|m| m.number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let plural = if numbers.len() == 1 { "" } else { "s" };
        (!numbers.is_empty()).then(|| format!("{} printed {name}{plural}", numbers.len()))
    });
    named.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(scales: &[f64]) -> Option<f64> {
        let measure =
            |(number, scale)| Measure { number, kind: Kind::Dimension, metres: 100.0 * scale, pixels: 100.0, votes: 1 };
        let measures: Vec<Measure> = scales.iter().copied().enumerate().map(measure).collect();
        vote(&measures, 0.02, [0.015, 0.03], (FEWEST, LEAST_SHARE, AGREE)).map(|(value, _)| value)
    }

    #[test]
    fn three_that_agree_outvote_a_few_and_contradictions_say_nothing() {
        assert_eq!(found(&[0.02, 0.0201, 0.0199, 0.027, 0.016]), Some(0.02));
        assert_eq!(found(&[0.02, 0.0201, 0.027, 0.016]), None);
        assert_eq!(found(&[0.02, 0.0201, 0.0199, 0.027, 0.016, 0.0235, 0.0175, 0.0285]), None);
        // As far from the doors as no door is.
        assert_eq!(found(&[0.05; 9]), None);
    }

    #[test]
    fn where_many_agree_doors_were_misread() {
        let found = |count: usize, scale: f64| {
            let measure =
                |number| Measure { number, kind: Kind::Dimension, metres: 100.0 * scale, pixels: 100.0, votes: 1 };
            let measures: Vec<Measure> = (0..count).map(measure).collect();
            found_in(&measures, 0.02, [0.015, 0.03]).map(|(value, _)| value)
        };
        assert_eq!((found(9, 0.05), found(3, 0.05), found(9, 0.2)), (Some(0.05), None, None));
    }

    #[test]
    fn numbers_without_a_unit_take_the_one_nearer_to_the_guess() {
        let measure = |number| {
            [6.0, 60.0].map(|metres| Measure { number, kind: Kind::Dimension, metres, pixels: 300.0, votes: 1 })
        };
        let measures: Vec<Measure> = (0..3).flat_map(measure).collect();
        let found = |guess| vote(&measures, guess, [0.005, 0.5], (FEWEST, LEAST_SHARE, AGREE)).map(|(value, _)| value);
        assert_eq!((found(0.05), found(0.15)), (Some(0.02), Some(0.2)));
    }

    #[test]
    fn one_number_is_one_vote() {
        let twice = Measure { number: 1, kind: Kind::Dimension, metres: 2.0, pixels: 100.0, votes: 1 };
        assert!(vote(&[twice; 5], 0.02, [0.01, 0.03], (FEWEST, LEAST_SHARE, AGREE)).is_none());
    }
}
