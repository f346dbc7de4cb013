//! Convex outlines and oriented boxes.

use super::finish::Finish;
use super::prism::Fitting;
use crate::math::{Rect, Vec2, vec2};

/// A rectangle in any direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub centre: Vec2,
    /// Unit vector along its longer side.
    pub along: Vec2,
    /// Half its length and half its breadth, metres.
    pub half: [f64; 2],
}

impl Block {
    /// A place by its shares of half the length and half the breadth, -1 to 1.
    pub fn at(&self, x: f64, y: f64) -> Vec2 {
        self.centre + self.along * (x * self.half[0]) + self.along.left() * (y * self.half[1])
    }

    pub fn corners(&self) -> Vec<Vec2> {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| self.at(x, y)).to_vec()
    }

    /// The part of it between shares of length and of breadth, -1 to 1.
    pub fn part(&self, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2], span_m: [f64; 2], finish: Finish) -> Fitting {
        let footprint = vec![self.at(x0, y0), self.at(x1, y0), self.at(x1, y1), self.at(x0, y1)];
        Fitting { footprint, span_m, finish, leaf: None }
    }

    /// Square legs under its corners, `inset_m` from the sides and `thick_m` across.
    pub fn legs(&self, inset_m: f64, thick_m: f64, high_m: f64, finish: Finish) -> Vec<Fitting> {
        let share = |k: usize, m: f64| (m / self.half[k]).min(0.45);
        let range = |k: usize, sign: f64| {
            let (outer, inner) = (1.0 - share(k, inset_m), 1.0 - share(k, inset_m + thick_m));
            if sign > 0.0 { [inner, outer] } else { [-outer, -inner] }
        };
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        corners.map(|[x, y]| self.part(range(0, x), range(1, y), [0.0, high_m], finish)).to_vec()
    }
}

/// Area of a polygon, positive if counter-clockwise, square metres.
pub(super) fn area_m2(points: &[Vec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| a.cross(*b)).sum::<f64>()
}

/// The smallest convex outline around points, counter-clockwise (Andrew's monotone chain).
pub(super) fn hull(points: &[Vec2]) -> Vec<Vec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    let chain = |points: &mut dyn Iterator<Item = Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while chain.len() > 1
                && (chain[chain.len() - 1] - chain[chain.len() - 2]).cross(p - chain[chain.len() - 1]) <= 1e-9
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut sorted.iter().copied());
    lower.extend(chain(&mut sorted.iter().rev().copied()));
    lower
}

/// The smallest rectangle around a convex outline: one of its sides lies along it.
pub(super) fn smallest_block(hull: &[Vec2]) -> Option<Block> {
    let blocks = hull.iter().zip(hull.iter().cycle().skip(1)).filter_map(|(&a, &b)| {
        let along = (b - a).normalized()?;
        let aside = along.left();
        let span = |axis: Vec2| {
            let values = || hull.iter().map(move |p| p.dot(axis));
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([x0, x1], [y0, y1]) = (span(along), span(aside));
        let centre = along * (0.5 * (x0 + x1)) + aside * (0.5 * (y0 + y1));
        let half = [0.5 * (x1 - x0), 0.5 * (y1 - y0)];
        let block = if half[0] >= half[1] {
            Block { centre, along, half }
        } else {
            Block { centre, along: aside, half: [half[1], half[0]] }
        };
        (half[0] > 0.0 && half[1] > 0.0).then_some(block)
    });
    blocks.min_by(|a, b| (a.half[0] * a.half[1]).total_cmp(&(b.half[0] * b.half[1])))
}

/// The outline drawn toward its middle.
pub(super) fn shrunk(outline: &[Vec2], centre: Vec2, share: f64) -> Vec<Vec2> {
    outline.iter().map(|&p| centre + (p - centre) * share).collect()
}

pub(super) fn bounds(points: &[Vec2]) -> Rect {
    let first = points.first().copied().unwrap_or(Vec2::ZERO);
    points.iter().fold(Rect { min: first, max: first }, |area, p| Rect {
        min: vec2(area.min.x.min(p.x), area.min.y.min(p.y)),
        max: vec2(area.max.x.max(p.x), area.max.y.max(p.y)),
    })
}

/// Whether a convex outline, counter-clockwise, holds a place.
pub(super) fn contains(outline: &[Vec2], p: Vec2) -> bool {
    outline.iter().zip(outline.iter().cycle().skip(1)).all(|(&a, &b)| (b - a).cross(p - a) >= 0.0)
}

/// Distance of a place to an outline, metres.
pub(super) fn distance_m(outline: &[Vec2], p: Vec2) -> f64 {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let to_edge = |(&a, &b): (&Vec2, &Vec2)| {
        let along = b - a;
        let share = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
        p.distance(a + along * share)
    };
    edges.map(to_edge).fold(f64::INFINITY, f64::min)
}
