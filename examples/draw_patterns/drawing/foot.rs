//! What all soles share: an outline drawn around a last, and how a foot presses on it.

use trodden::math::{Rect, Vec2, vec2};

use super::noise;
use super::shape::{bump, segment, smoothstep};

/// The measures of an outline, centimetres; `out` is the outer side, `inner` that of the arch and the big toe.
#[derive(Clone, Copy)]
pub struct Last {
    pub length: f64,
    /// Half the width of the heel.
    pub heel: f64,
    pub waist_out: f64,
    pub waist_inner: f64,
    pub ball_out: f64,
    pub ball_inner: f64,
    pub toe_out: f64,
    pub toe_inner: f64,
    /// y of the foremost point.
    pub tip: f64,
}

/// A place on a sole.
#[derive(Clone, Copy)]
pub struct Site {
    /// Centimetres from the back of the heel, outward.
    pub p: Vec2,
    /// Share of the length, 0 at the back.
    pub along: f64,
    /// Share of the half width of the ball, 1 at the outer edge, -1 at the inner.
    pub across: f64,
    /// Distance to the outline, centimetres; positive on the sole.
    pub inset: f64,
}

/// A closed outline with its distance, tabulated once per millimetre.
pub struct Outline {
    last: Last,
    frame: Rect,
    columns: usize,
    distances: Vec<f64>,
}

/// Spacing of the tabulated distances, centimetres.
const STEP: f64 = 0.1;

impl Last {
    /// Corner points of a smooth closed curve, counter-clockwise from the middle of the back.
    fn knots(&self) -> Vec<Vec2> {
        let l = self.length;
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let outer = [
            (0.02, 0.56 * self.heel),
            (0.07, 0.88 * self.heel),
            (0.17, self.heel),
            (0.30, mix(self.heel, self.waist_out, 0.6)),
            (0.43, self.waist_out),
            (0.54, mix(self.waist_out, self.ball_out, 0.68)),
            (0.65, self.ball_out),
            (0.76, mix(self.ball_out, self.toe_out, 0.27)),
            (0.87, self.toe_out),
            (0.955, mix(self.toe_out, self.tip, 0.42)),
        ];
        let inner = [
            (0.97, mix(-self.toe_inner, self.tip, 0.40)),
            (0.91, -self.toe_inner),
            (0.825, mix(-self.ball_inner, -self.toe_inner, 0.36)),
            (0.73, -self.ball_inner),
            (0.61, mix(-self.waist_inner, -self.ball_inner, 0.70)),
            (0.45, -self.waist_inner),
            (0.30, mix(-self.heel, -self.waist_inner, 0.55)),
            (0.17, -self.heel),
            (0.07, -0.88 * self.heel),
            (0.02, -0.56 * self.heel),
        ];
        let tip = [(1.0, self.tip)];
        let back = [(0.0, 0.0)];
        back.iter().chain(&outer).chain(&tip).chain(&inner).map(|&(x, y)| vec2(x * l, y)).collect()
    }
}

impl Outline {
    pub fn new(last: Last) -> Outline {
        let mut curve = closed_curve(&last.knots());
        stretch_to(&mut curve, last.length);
        let (low, high) = curve.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.y), high.max(p.y)));
        let half = high.max(-low);
        // Whole millimetres on both sides of the axis: the middle of the image is on the sole's axis.
        let half = (half / STEP).ceil() * STEP;
        let frame = Rect { min: vec2(0.0, -half), max: vec2(last.length, half) };
        let columns = (frame.width() / STEP).round() as usize + 1;
        let rows = (frame.height() / STEP).round() as usize + 1;
        let corner = |n: usize| frame.min + vec2((n % columns) as f64, (n / columns) as f64) * STEP;
        let distances = (0..columns * rows).map(|n| inset(&curve, corner(n))).collect();
        Outline { last, frame, columns, distances }
    }

    /// What the image shows.
    pub fn frame(&self) -> Rect {
        self.frame
    }

    /// What a tread wants to know about a place.
    pub fn site(&self, p: Vec2) -> Site {
        let across = if p.y > 0.0 { p.y / self.last.ball_out } else { p.y / self.last.ball_inner };
        Site { p, along: p.x / self.last.length, across, inset: self.inset(p) }
    }

    fn inset(&self, p: Vec2) -> f64 {
        let at = (p - self.frame.min) / STEP;
        let rows = self.distances.len() / self.columns;
        let column = (at.x as usize).min(self.columns - 2);
        let row = (at.y as usize).min(rows - 2);
        let (s, t) = (at.x - column as f64, at.y - row as f64);
        let here = |c: usize, r: usize| self.distances[(row + r) * self.columns + column + c];
        let low = here(0, 0) + (here(1, 0) - here(0, 0)) * s;
        let high = here(0, 1) + (here(1, 1) - here(0, 1)) * s;
        low + (high - low) * t
    }
}

/// Catmull-Rom through the knots, twelve pieces between two.
fn closed_curve(knots: &[Vec2]) -> Vec<Vec2> {
    let n = knots.len();
    let mut curve = Vec::with_capacity(12 * n);
    for i in 0..n {
        let [a, b, c, d] = [knots[(i + n - 1) % n], knots[i], knots[(i + 1) % n], knots[(i + 2) % n]];
        for piece in 0..12 {
            let t = f64::from(piece) / 12.0;
            let (t2, t3) = (t * t, t * t * t);
            let p = b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2 + (b * 3.0 - a - c * 3.0 + d) * t3;
            curve.push(p * 0.5);
        }
    }
    curve
}

/// Scales the curve along x so that it reaches from 0 to the length.
fn stretch_to(curve: &mut [Vec2], length: f64) {
    let (low, high) = curve.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.x), high.max(p.x)));
    for p in curve {
        p.x = (p.x - low) / (high - low) * length;
    }
}

/// Distance from a place to a closed curve, positive inside.
fn inset(curve: &[Vec2], p: Vec2) -> f64 {
    let (mut nearest, mut inside) = (f64::MAX, false);
    for (i, &a) in curve.iter().enumerate() {
        let b = curve[(i + 1) % curve.len()];
        nearest = nearest.min(segment(p, a, b));
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    if inside { nearest } else { -nearest }
}

/// How hard a walking foot presses on a flat sole, about 1 under heel, ball and big toe: the heel strikes at its
/// outer edge, the weight rolls along the outer side to the ball and leaves over the big toe; the arch hardly
/// touches.
pub fn pressure(site: &Site) -> f64 {
    let at = vec2(site.along, site.across);
    let arch = bump(at, vec2(0.42, -0.55), vec2(0.15, 0.62));
    let load = 0.50
        + 0.55 * bump(at, vec2(0.09, 0.22), vec2(0.10, 0.55))
        + 0.25 * bump(at, vec2(0.15, 0.0), vec2(0.11, 0.60))
        + 0.50 * bump(at, vec2(0.71, -0.40), vec2(0.09, 0.45))
        + 0.35 * bump(at, vec2(0.66, 0.45), vec2(0.10, 0.40))
        + 0.45 * bump(at, vec2(0.90, -0.35), vec2(0.07, 0.34))
        + 0.15 * bump(at, vec2(0.85, 0.25), vec2(0.08, 0.35))
        + 0.10 * bump(at, vec2(0.45, 0.55), vec2(0.18, 0.30));
    let toe_spring = smoothstep(1.0, 0.95, site.along) * 0.5 + 0.5;
    (load - 0.62 * arch) * toe_spring
}

/// Where soles wear: the outer back of the heel, under the ball, at the toe. 0 to 1.
pub fn wear(site: &Site) -> f64 {
    let at = vec2(site.along, site.across);
    let spots = bump(at, vec2(0.03, 0.45), vec2(0.07, 0.40))
        + bump(at, vec2(0.69, -0.25), vec2(0.06, 0.33))
        + 0.8 * bump(at, vec2(0.97, -0.25), vec2(0.05, 0.35));
    spots.min(1.0)
}

/// What a tread leaves on the floor. `rubber` is the signed distance to the parts that touch (negative inside),
/// `pressed` how hard, `grain` how rough the material is (0 fine rubber, 1 leather).
///
/// Where the sole is worn the grooves close up. Edges of a tread print darker than its faces, light pressure
/// breaks up into grains, and small nicks of wear are left out.
pub fn print(site: &Site, rubber: f64, pressed: f64, worn: f64, grain: f64, seed: u64) -> f64 {
    let p = site.p;
    let grains = noise::cloudy(p, 0.16 + 0.10 * grain, 2, seed + 3);
    let dust = 0.05 * smoothstep(0.35, 0.9, grains) * smoothstep(-0.1, 0.1, site.inset) * pressed;
    let rough_edge = 0.022 * noise::value(p, 0.13, seed + 1);
    let rubber = (rubber - 0.07 * worn + rough_edge).max(-site.inset + rough_edge);
    let touches = smoothstep(0.03, -0.03, rubber);
    if touches == 0.0 {
        return dust;
    }
    // Soil and floor are never quite even: pressure varies in patches, and where it is light only grains print.
    let edge = trodden::math::exp(-(rubber / 0.07) * (rubber / 0.07));
    let patches = noise::cloudy(p, 1.6, 3, seed + 2);
    let load = pressed * (1.0 + 0.22 * patches) + 0.22 * edge - 0.18 * worn;
    let face = smoothstep(-0.05, 1.05, load + (0.28 + 0.22 * grain) * grains * (1.35 - load.clamp(0.0, 1.0)));
    (touches * face * (1.0 - 0.9 * nicks(p, seed + 4))).max(dust)
}

/// Cuts and holes that a sole picks up: 1 within one.
fn nicks(p: Vec2, seed: u64) -> f64 {
    const CELL: f64 = 1.7;
    let (i, j) = ((p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64);
    let mut deepest: f64 = 0.0;
    for (di, dj) in (-1..=1).flat_map(|di| (-1..=1).map(move |dj| (di, dj))) {
        let (i, j) = (i + di, j + dj);
        let draw = |n: u64| noise::hash(i, j, seed.wrapping_add(977 * n));
        if draw(0) > 0.42 {
            continue;
        }
        let middle = vec2(i as f64 + draw(1), j as f64 + draw(2)) * CELL;
        let (s, c) = trodden::math::sin_cos(draw(3) * std::f64::consts::TAU);
        let half = vec2(c, s) * (0.02 + 0.30 * draw(4) * draw(5));
        let d = segment(p, middle - half, middle + half) - (0.015 + 0.05 * draw(6) * draw(6));
        deepest = deepest.max(smoothstep(0.03, -0.02, d));
    }
    deepest
}
