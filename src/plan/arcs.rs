//! Finds quarter circles in a boundary, the arcs of drawn doors.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};

use super::cracks::{CrackLoop, trace};
use crate::math::{atan2, sin_cos};

/// Range of the angle of a door's arc that can be followed, radians: 60 to 112 degrees.
const SHORTEST_ARC: f64 = 1.05;
const LONGEST_ARC: f64 = 1.95;
/// Largest deviation of an arc from a circle: share of its radius, or pixels if that is more.
const ROUNDNESS: f64 = 0.06;
const ROUNDNESS_PX: f64 = 0.7;
/// Least radius, pixels; smaller arcs look like rounded corners.
const LEAST_RADIUS_PX: f64 = 10.0;
/// Angle by which an arc may continue beyond each of its blurred ends, radians.
const END_MARGIN: f64 = 0.1;

/// Most pixels a side of the picture in which door leaves are looked for.
const MOST_PX: usize = 1800;

/// An arc of a circle in the image, pixels and radians (y down).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: [f64; 2],
    pub(super) radius: f64,
    pub(super) from: f64,
    /// Always more than `from`.
    pub(super) to: f64,
}

impl Arc {
    /// Angle by which the quarter circle may continue beyond either end, radians.
    pub(super) fn missing(&self) -> f64 {
        (FRAC_PI_2 - (self.to - self.from)).max(0.0) * 0.5 + END_MARGIN
    }

    /// Whether a direction lies in the quarter circle, extended by [`Arc::missing`] at both ends.
    pub(super) fn spans(&self, angle: f64) -> bool {
        let margin = self.missing();
        let from = self.from - margin;
        let beyond = (angle - from) - ((angle - from) / TAU).floor() * TAU;
        beyond <= self.to - self.from + 2.0 * margin
    }

    pub(super) fn place(&self, radius: f64, angle: f64) -> [f64; 2] {
        let (sine, cosine) = sin_cos(angle);
        [self.centre[0] + radius * cosine, self.centre[1] + radius * sine]
    }
}

/// Parameters of the search for arcs.
pub(super) struct Search {
    /// Least and greatest radius, pixels.
    pub(super) radii: [f64; 2],
    /// Distance between sampled points of a boundary, pixel edges.
    pub(super) step: usize,
}

impl Search {
    /// Appends the arcs of a boundary that may be quarter circles.
    pub(super) fn find(&self, boundary: &CrackLoop, arcs: &mut Vec<Arc>) {
        let [least, most] = [self.radii[0].max(LEAST_RADIUS_PX), self.radii[1]];
        let points = smoothed(boundary, self.step);
        let n = points.len();
        if least > most || ((n * self.step) as f64) < least {
            return;
        }
        let mut start = 0;
        while start < n {
            let radii = std::iter::successors(Some(least * 1.05), |r| Some(r * 1.12)).take_while(|&r| r < most);
            match radii.filter_map(|radius| arc_at(&points, start, radius, self.step)).next() {
                Some((arc, length)) => {
                    let is_quarter = (SHORTEST_ARC..LONGEST_ARC).contains(&(arc.to - arc.from));
                    if is_quarter && (least..=most).contains(&arc.radius) {
                        arcs.push(arc);
                    }
                    start += length.max(1);
                }
                None => start += 1,
            }
        }
    }
}

/// Samples every `step`-th pixel edge of a boundary, each averaged over its neighbours.
fn smoothed(boundary: &CrackLoop, step: usize) -> Vec<[f64; 2]> {
    let n = boundary.len();
    let window = 2 * step + 1;
    if n < window {
        return Vec::new();
    }
    (0..n / step)
        .map(|k| {
            let around = (0..window).map(|w| boundary[(k * step + n + w - step) % n]);
            let sum = around.fold([0i64; 2], |s, p| [s[0] + i64::from(p[0]), s[1] + i64::from(p[1])]);
            sum.map(|s| s as f64 / window as f64)
        })
        .collect()
}

/// Follows the arc of about `radius` from a point. Returns it with its number of points.
fn arc_at(points: &[[f64; 2]], start: usize, radius: f64, step: usize) -> Option<(Arc, usize)> {
    let n = points.len();
    let at = |k: usize| points[(start + k) % n];
    let distance = |a: [f64; 2], b: [f64; 2]| ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt();
    // Chord of the shortest arc. Measured along pixel edges, the arc is up to a factor sqrt(2) longer.
    let chord = 2.0 * radius * sin_cos(SHORTEST_ARC * 0.5).0;
    let longest = ((radius * LONGEST_ARC * 1.5) as usize / step).min(n - 1);
    let end = (2..=longest).find(|&k| distance(at(0), at(k)) >= chord)?;
    let (centre, r) = circle_through(at(0), at(end / 2), at(end))?;
    if (r - radius).abs() > 0.1 * radius {
        return None;
    }
    let is_on = |k: usize| (distance(at(k), centre) - r).abs() <= (ROUNDNESS * r).max(ROUNDNESS_PX);
    if !(0..=end).all(is_on) {
        return None;
    }
    let length = (end..n).take_while(|&k| is_on(k)).last().unwrap_or(end);
    let angle = |k: usize| atan2(at(k)[1] - centre[1], at(k)[0] - centre[0]);
    let first = angle(0);
    let total = turn(first, angle(length / 2)) + turn(angle(length / 2), angle(length));
    let (from, to) = if total >= 0.0 { (first, first + total) } else { (first + total, first) };
    Some((Arc { centre, radius: r, from, to }, length))
}

/// Returns the angle from one direction to another, in `[-pi, pi)`.
fn turn(from: f64, to: f64) -> f64 {
    let turns = (to - from + PI) / TAU;
    (turns - turns.floor()) * TAU - PI
}

/// Returns centre and radius of the circle through three points; `None` for collinear points.
fn circle_through(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Option<([f64; 2], f64)> {
    let ([bx, by], [cx, cy]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let d = 2.0 * (bx * cy - by * cx);
    if d.abs() < 1e-6 {
        return None;
    }
    let (b2, c2) = (bx * bx + by * by, cx * cx + cy * cy);
    let [x, y] = [(cy * b2 - by * c2) / d, (bx * c2 - cx * b2) / d];
    Some(([a[0] + x, a[1] + y], (x * x + y * y).sqrt()))
}

/// The pixel of a mask at a place, if that lies in the image.
pub(super) fn pixel(mask: &[u8], width: usize, [x, y]: [f64; 2]) -> Option<u8> {
    let inside = x >= 0.0 && y >= 0.0 && x < width as f64 && y < (mask.len() / width) as f64;
    inside.then(|| mask[y as usize * width + x as usize])
}

/// Radius of the circle through the middle of an arc's stroke, pixels: an arc that was followed begins in its leaf.
pub(super) fn fitted_radius(white: &[u8], width: usize, arc: &Arc) -> f64 {
    const PLACES: usize = 32;
    let is_dark = |place| pixel(white, width, place) == Some(0);
    let reach = (arc.radius * 0.2 * 2.0) as i32;
    let mut points: Vec<[f64; 2]> = Vec::new();
    for k in 0..PLACES {
        let angle = arc.from + (arc.to - arc.from) * (0.05 + 0.9 * (k as f64 + 0.5) / PLACES as f64);
        let ways = (-reach..=reach).map(|d| arc.radius + f64::from(d) * 0.5);
        let dark: Vec<f64> = ways.filter(|&way| is_dark(arc.place(way, angle))).collect();
        // Where the leaf is met too, the stroke is not told from it.
        if let (Some(first), Some(last)) = (dark.first(), dark.last())
            && last - first <= 4.0 + 0.05 * arc.radius
        {
            points.push(arc.place((first + last) * 0.5, angle));
        }
    }
    circle(&points, arc.centre, arc.radius).filter(|r| (0.6..1.4).contains(&(r / arc.radius))).unwrap_or(arc.radius)
}

/// Radius of the circle that fits points best, by least squares of the distances (Gauss and Newton): of short arcs, fits of
/// squared distances are too small.
fn circle(points: &[[f64; 2]], near: [f64; 2], radius: f64) -> Option<f64> {
    if points.len() < 8 {
        return None;
    }
    let (mut centre, mut r) = (near, radius);
    for _ in 0..12 {
        let (mut normal, mut off) = (Matrix3::zeros(), Vector3::zeros());
        for p in points {
            let [x, y] = [p[0] - centre[0], p[1] - centre[1]];
            let way = (x * x + y * y).sqrt().max(1e-9);
            let row = Vector3::new(x / way, y / way, 1.0);
            normal += row * row.transpose();
            off += row * (way - r);
        }
        let step = normal.cholesky()?.solve(&off);
        centre = [centre[0] + step[0], centre[1] + step[1]];
        r += step[2];
    }
    Some(r)
}

/// Radii of the quarter circles of door leaves, with their weights.
pub(super) fn leaves(dark: &[u8], full: usize) -> Vec<(f64, f64)> {
    let height = dark.len() / full;
    let factor = full.max(height).div_ceil(MOST_PX).max(1);
    let width = full.div_ceil(factor);
    // A pixel of the small picture is white unless one of its pixels is dark.
    let mut white = vec![1u8; width * height.div_ceil(factor)];
    for (y, row) in dark.chunks_exact(full).enumerate() {
        for (x, _) in row.iter().enumerate().filter(|(_, d)| **d != 0) {
            white[y / factor * width + x / factor] = 0;
        }
    }
    let most = width.max(white.len() / width) as f64 / 8.0;
    let mut arcs: Vec<Arc> = Vec::new();
    for boundary in trace(&white, width).iter().filter(|boundary| boundary.len() >= 20) {
        let mut least = 10.0;
        while least < most {
            let search = Search { radii: [least, (least * 3.0).min(most)], step: ((least * 0.1) as usize).max(2) };
            search.find(boundary, &mut arcs);
            least *= 3.0;
        }
    }
    // Both edges of a stroke are found: an arc counts once.
    let mut found: Vec<Arc> = Vec::new();
    for arc in arcs {
        let is_same = |other: &Arc| {
            let [dx, dy] = [0, 1].map(|k| arc.centre[k] - other.centre[k]);
            let near = 0.15 * arc.radius + 2.0;
            dx * dx + dy * dy < near * near && (arc.radius - other.radius).abs() < near
        };
        if is_stroke(&white, width, &arc) && has_leaf(&white, width, &arc) && !found.iter().any(is_same) {
            found.push(arc);
        }
    }
    found.iter().map(|arc| (fitted_radius(&white, width, arc) * factor as f64, 1.0)).collect()
}

/// Whether a straight stroke goes from the arc's centre to about one of its ends.
fn has_leaf(white: &[u8], width: usize, arc: &Arc) -> bool {
    const TURNS: i32 = 8;
    const PLACES: usize = 16;
    let is_dark = |place| pixel(white, width, place) == Some(0);
    let beside = (0.08 * arc.radius).max(1.5);
    let is_leaf = |angle: f64, aside: f64| {
        let dark = (0..PLACES).filter(|&k| {
            let [x, y] = arc.place(arc.radius * (0.2 + 0.7 * (k as f64 + 0.5) / PLACES as f64), angle);
            let (sine, cosine) = sin_cos(angle);
            [-0.7, 0.0, 0.7].iter().any(|&d| is_dark([x - (aside + d) * sine, y + (aside + d) * cosine]))
        });
        dark.count() * 10 >= PLACES * 8
    };
    [arc.from, arc.to].iter().any(|&end| {
        let turns = (-TURNS..=TURNS).map(|turn| end + arc.missing() * f64::from(turn) / f64::from(TURNS));
        turns.into_iter().any(|angle| [-1.0, -0.5, 0.0, 0.5, 1.0].iter().any(|&aside| is_leaf(angle, aside * beside)))
    })
}

/// Whether an arc is a thin stroke with white on both sides.
fn is_stroke(white: &[u8], width: usize, arc: &Arc) -> bool {
    const PLACES: usize = 12;
    let is_white = |place| pixel(white, width, place).is_some_and(|white| white != 0);
    let away = (0.12 * arc.radius).max(3.0);
    let on = (0..PLACES).filter(|&k| {
        let angle = arc.from + (arc.to - arc.from) * (k as f64 + 0.5) / PLACES as f64;
        let near = [-1.5, -0.5, 0.5, 1.5].iter().any(|&d| !is_white(arc.place(arc.radius + d, angle)));
        near && is_white(arc.place(arc.radius - away, angle)) && is_white(arc.place(arc.radius + away, angle))
    });
    on.count() * 10 >= PLACES * 7
}
