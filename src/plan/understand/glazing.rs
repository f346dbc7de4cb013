//! Glass as strokes show it: slanted windows, as those of bays, and glass fronts, chains of panes between two lines or three, with
//! mullions across them. Longer than windows are, these leave buildings open on one side.

use std::f64::consts::{FRAC_PI_2, PI};

use super::super::components::{Component, Components, Neighbours};
use super::directions;
use super::frame::Frame;
use super::gaps::Gap;
use crate::math::{DisjointSets, Vec2, atan2, sin_cos, vec2};

/// Thickness of a pane's field, metres and pixels, its length in metres and in thicknesses, and share of its rectangle that it fills.
const THICK_M: [f64; 2] = [0.02, 0.35];
const THINNEST_PX: f64 = 1.5;
const LENGTH_M: [f64; 2] = [0.4, 6.0];
const SLENDER: f64 = 2.5;
const FULL: f64 = 0.8;
/// Cosine of the greatest angle between panes of a front, greatest breadth of a mullion, and greatest breadth of the glass between two
/// fields, metres and pixels.
const STRAIGHT: f64 = 0.995;
const MULLION_M: f64 = 0.3;
const GLASS_M: f64 = 0.06;
const GLASS_PX: f64 = 3.0;
/// Least share of the shorter field that the one beside it covers.
const BESIDE: f64 = 0.8;
/// Fewest mullions of a front, its least length, and its greatest thickness, metres.
const MULLIONS: usize = 3;
const FRONT_M: f64 = 4.0;
const THICKEST_M: f64 = 0.6;
/// Beyond so many fields, a drawing shows paving.
const MOST_FIELDS: usize = 4000;

/// A field's rectangle, pixels.
struct Field {
    middle: Vec2,
    /// Along its longer sides, of length 1.
    way: Vec2,
    length: f64,
    thick: f64,
}

impl Field {
    /// The rectangle with the moments of a component, if it is about one.
    fn of(pieces: &Components, piece: &Component) -> Option<Field> {
        let (mut sum, mut squares, mut product) = (vec2(0.0, 0.0), vec2(0.0, 0.0), 0.0);
        for run in pieces.runs(piece) {
            let y = f64::from(run.y - piece.min[1]) + 0.5;
            for x in run.from - piece.min[0]..run.to - piece.min[0] {
                let x = f64::from(x) + 0.5;
                (sum, squares, product) = (sum + vec2(x, y), squares + vec2(x * x, y * y), product + x * y);
            }
        }
        let area = piece.area as f64;
        let mean = sum * (1.0 / area);
        let [xx, yy, xy] =
            [squares.x / area - mean.x * mean.x, squares.y / area - mean.y * mean.y, product / area - mean.x * mean.y];
        let spread = ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt();
        let [length, thick] = [1.0, -1.0].map(|sign| (6.0 * (xx + yy + sign * spread) + 1.0).max(1.0).sqrt());
        let angle = 0.5 * atan2(2.0 * xy, xx - yy);
        let (sine, cosine) = sin_cos(angle);
        let middle = mean + vec2(f64::from(piece.min[0]), f64::from(piece.min[1]));
        (area >= FULL * length * thick).then_some(Field { middle, way: vec2(cosine, sine), length, thick })
    }

    /// How far another field's middle is off this one's, along and across.
    fn off(&self, other: &Field) -> [f64; 2] {
        let off = other.middle - self.middle;
        [off.dot(self.way).abs(), off.cross(self.way).abs()]
    }
}

/// Panes of glass as strokes show them.
pub(super) struct Glazing {
    image: [usize; 2],
    metres_per_pixel: f64,
    fields: Vec<Field>,
    /// Two panes with a mullion between their ends.
    next: Vec<[usize; 2]>,
    /// Two fields with a line of glass between their sides.
    beside: Vec<[usize; 2]>,
}

impl Glazing {
    /// Finds panes among strokes.
    pub(super) fn of(ink: &[u8], width: usize, metres_per_pixel: f64) -> Glazing {
        let px = |metres: f64| metres / metres_per_pixel;
        let white: Vec<u8> = ink.iter().map(|&ink| 1 - ink).collect();
        let pieces = Components::of(&white, width, 1, Neighbours::Four);
        let is_size = |piece: &&Component| {
            let [w, h] = piece.size().map(f64::from);
            (px(LENGTH_M[0])..=px(2.0 * LENGTH_M[1])).contains(&(w + h))
                && piece.area as f64 <= px(LENGTH_M[1]) * px(THICK_M[1])
        };
        let is_pane = |field: &Field| {
            (px(THICK_M[0]).max(THINNEST_PX)..=px(THICK_M[1])).contains(&field.thick)
                && (px(LENGTH_M[0]).max(SLENDER * field.thick)..=px(LENGTH_M[1])).contains(&field.length)
        };
        let fields = pieces.all.iter().filter(is_size).filter_map(|piece| Field::of(&pieces, piece));
        let mut fields: Vec<Field> = fields.filter(is_pane).collect();
        if fields.len() > MOST_FIELDS {
            fields.clear();
        }
        fields.sort_by(|a, b| a.middle.x.total_cmp(&b.middle.x));
        let (mut next, mut beside) = (Vec::new(), Vec::new());
        for (k, a) in fields.iter().enumerate() {
            let reach = a.middle.x + px(LENGTH_M[1] + MULLION_M);
            for (n, b) in fields.iter().enumerate().skip(k + 1).take_while(|(_, b)| b.middle.x <= reach) {
                let ([along, across], [length, thick]) = (a.off(b), [a.length + b.length, a.thick + b.thick]);
                let is_level = a.way.dot(b.way).abs() >= STRAIGHT;
                let is_next = across <= 0.15 * thick + 1.5
                    && (a.thick - b.thick).abs() <= 0.1 * thick + 2.0
                    && (0.0..=px(MULLION_M)).contains(&(along - 0.5 * length + 1.0));
                let is_beside = across <= 0.5 * thick + px(GLASS_M).max(GLASS_PX)
                    && 0.5 * length - along >= BESIDE * a.length.min(b.length);
                next.extend((is_level && is_next).then_some([k, n]));
                beside.extend((is_level && is_beside).then_some([k, n]));
            }
        }
        Glazing { image: [width, ink.len() / width], metres_per_pixel, fields, next, beside }
    }

    /// The directions of slanted windows, as those of bays, radians between 0 and a right angle.
    pub(super) fn slanted(&self) -> Vec<f64> {
        /// Most directions, and how far a direction is off upright ones at least, radians.
        const MOST: usize = 2;
        const OFF: f64 = 0.12;
        let mut found: Vec<(f64, usize)> = Vec::new();
        for [k, n] in &self.beside {
            let [a, b] = [k, n].map(|&k| &self.fields[k]);
            let angle = atan2(a.way.y, a.way.x).rem_euclid(FRAC_PI_2);
            if !(OFF..=FRAC_PI_2 - OFF).contains(&angle) || (a.length - b.length).abs() > 0.1 * a.length {
                continue;
            }
            match found.iter_mut().find(|(other, _)| directions::is_same(angle, *other)) {
                Some((_, count)) => *count += 1,
                None => found.push((angle, 1)),
            }
        }
        found.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        found.into_iter().take(MOST).map(|(angle, _)| angle).collect()
    }

    /// The glass fronts, each as one window.
    pub(super) fn fronts(&self) -> Vec<Gap> {
        let px = |metres: f64| metres / self.metres_per_pixel;
        let fields = &self.fields;
        let mut sets = DisjointSets::new(fields.len());
        self.next.iter().chain(&self.beside).for_each(|&[k, n]| sets.join(k, n));
        let mut members = vec![Vec::new(); fields.len()];
        (0..fields.len()).for_each(|k| members[sets.least(k)].push(k));
        let mut mullions = vec![0; fields.len()];
        self.next.iter().for_each(|[k, _]| mullions[sets.least(*k)] += 1);
        let front = |(members, mullions): (Vec<usize>, usize)| {
            let longest = members.iter().map(|&k| &fields[k]).reduce(|a, b| if b.length > a.length { b } else { a })?;
            let frame = Frame::towards(self.image, atan2(longest.way.y, longest.way.x).rem_euclid(PI));
            let range = |of: fn([f64; 2], &Field) -> [f64; 2]| {
                let ends =
                    members.iter().map(|&k| of(frame.within([fields[k].middle.x, fields[k].middle.y]), &fields[k]));
                ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
            };
            let [from, to] = range(|[u, _], field| [u - 0.5 * field.length, u + 0.5 * field.length]);
            let [first, end] = range(|[_, v], field| [v - 0.5 * field.thick, v + 0.5 * field.thick]);
            let is_front = mullions >= MULLIONS && to - from >= px(FRONT_M) && end - first <= px(THICKEST_M);
            is_front.then(|| Gap::pane(frame, [from, to], [first, end]))
        };
        members.into_iter().zip(mullions).filter_map(front).collect()
    }
}
