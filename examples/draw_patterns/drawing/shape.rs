//! Signed distances in centimetres, negative inside, and the few ways to combine them.

use trodden::math::{Vec2, sin_cos, vec2};

/// Distance to the segment `a b`.
pub fn segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let (ap, ab) = (p - a, b - a);
    let t = (ap.dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    (ap - ab * t).length()
}

/// Disc around the origin.
pub fn disc(p: Vec2, radius: f64) -> f64 {
    p.length() - radius
}

/// Box around the origin with these half sides.
pub fn block(p: Vec2, half: Vec2) -> f64 {
    let d = vec2(p.x.abs() - half.x, p.y.abs() - half.y);
    vec2(d.x.max(0.0), d.y.max(0.0)).length() + d.x.max(d.y).min(0.0)
}

/// Regular hexagon around the origin with flat sides at +-x, `apothem` from the middle to a side.
pub fn hexagon(p: Vec2, apothem: f64) -> f64 {
    let p = vec2(p.x.abs(), p.y.abs());
    p.x.max(0.5 * p.x + 0.866_025_4 * p.y) - apothem
}

/// Star with five points around the origin; the radius is that of the points.
pub fn star(p: Vec2, radius: f64) -> f64 {
    let tenth = std::f64::consts::PI / 5.0;
    let angle = trodden::math::atan2(p.y, p.x).abs();
    let folded = (angle - 2.0 * tenth * (angle / (2.0 * tenth)).round()).abs();
    let (s, c) = sin_cos(folded);
    let q = vec2(c, s) * p.length();
    let (s, c) = sin_cos(tenth);
    let (tip, notch) = (vec2(radius, 0.0), vec2(c, s) * (0.45 * radius));
    let side = notch - tip;
    let outside = side.cross(q - tip) < 0.0;
    if outside { segment(q, tip, notch) } else { -segment(q, tip, notch) }
}

/// Distance to bars of this width whose middles lie at the whole multiples of `pitch` of the coordinate `t`.
pub fn bars(t: f64, pitch: f64, width: f64) -> f64 {
    (t - pitch * (t / pitch).round()).abs() - width / 2.0
}

/// Triangle wave between -1 and 1 with this period.
pub fn zigzag(t: f64, period: f64) -> f64 {
    let s = t / period;
    4.0 * (s - (s + 0.5).floor()).abs() - 1.0
}

/// The middle of the cell of a hexagonal lattice (rows along y) in which a place lies.
pub fn hexagonal_cell(p: Vec2, pitch: f64) -> Vec2 {
    let rise = pitch * 0.866_025_4;
    let nearest = |shift: f64| {
        let row = 2.0 * ((p.x / rise - shift) / 2.0).round() + shift;
        let column = (p.y / pitch - shift / 2.0).round() + shift / 2.0;
        vec2(row * rise, column * pitch)
    };
    let (even, odd) = (nearest(0.0), nearest(1.0));
    if p.distance(even) <= p.distance(odd) { even } else { odd }
}

/// Turned clockwise by an angle, so that what is drawn along x points along the angle.
pub fn unturned(p: Vec2, angle_rad: f64) -> Vec2 {
    let (s, c) = sin_cos(angle_rad);
    p.rotated(vec2(c, -s))
}

/// What lies in either.
pub fn union(a: f64, b: f64) -> f64 {
    a.min(b)
}

/// What lies in both.
pub fn both(a: f64, b: f64) -> f64 {
    a.max(b)
}

/// What lies in the first but not in the second.
pub fn without(a: f64, b: f64) -> f64 {
    a.max(-b)
}

/// The line of this width along the border of a shape.
pub fn border(d: f64, width: f64) -> f64 {
    d.abs() - width / 2.0
}

/// 0 below `low`, 1 above `high`, smooth in between (`low` may be the larger).
pub fn smoothstep(low: f64, high: f64, t: f64) -> f64 {
    let t = ((t - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A soft round bump of height 1 with these radii.
pub fn bump(p: Vec2, middle: Vec2, radii: Vec2) -> f64 {
    let d = p - middle;
    trodden::math::exp(-(d.x * d.x / (radii.x * radii.x) + d.y * d.y / (radii.y * radii.y)))
}
