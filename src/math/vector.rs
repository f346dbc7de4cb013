//! Points, vectors and rectangles in the plan frame.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use serde::{Deserialize, Serialize};

use crate::options::{Kind, Leaf, Value};

/// A point or a displacement in the plan frame: metres, x right, y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub struct Vec2 {
    /// Metres to the right.
    pub x: f64,
    /// Metres up.
    pub y: f64,
}

/// Makes a [`Vec2`] of its components.
pub const fn vec2(x: f64, y: f64) -> Vec2 {
    Vec2 { x, y }
}

impl Leaf for Vec2 {
    fn takes() -> Kind {
        <[f64; 2]>::kind()
    }
}

impl Vec2 {
    /// The null vector.
    pub const ZERO: Vec2 = vec2(0.0, 0.0);

    /// Scalar product.
    pub fn dot(self, other: Vec2) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// z component of the cross product: positive where `other` lies to the left of `self`.
    pub fn cross(self, other: Vec2) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Squared length.
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// Distance between two points.
    pub fn distance(self, other: Vec2) -> f64 {
        (self - other).length()
    }

    /// Unit vector in the same direction; `None` for a length below 1e-12.
    pub fn normalized(self) -> Option<Vec2> {
        let length = self.length();
        (length > 1e-12).then(|| self / length)
    }

    /// The vector rotated by a quarter turn counter-clockwise: to the left of `self`.
    pub fn left(self) -> Vec2 {
        vec2(-self.y, self.x)
    }

    /// The vector rotated counter-clockwise by the direction of the unit vector `by`.
    pub fn rotated(self, by: Vec2) -> Vec2 {
        vec2(self.x * by.x - self.y * by.y, self.x * by.y + self.y * by.x)
    }

    /// Linear interpolation: the point at the share `t` from `self` to `other`.
    pub fn lerp(self, other: Vec2, t: f64) -> Vec2 {
        self + (other - self) * t
    }

    /// The vector shortened to at most `limit`.
    pub fn clamped(self, limit: f64) -> Vec2 {
        let squared = self.length_squared();
        if squared > limit * limit { self * (limit / squared.sqrt()) } else { self }
    }

    /// Whether both components are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl From<[f64; 2]> for Vec2 {
    fn from([x, y]: [f64; 2]) -> Vec2 {
        vec2(x, y)
    }
}

impl From<Vec2> for [f64; 2] {
    fn from(v: Vec2) -> [f64; 2] {
        [v.x, v.y]
    }
}

impl Add for Vec2 {
    type Output = Vec2;
    fn add(self, other: Vec2) -> Vec2 {
        vec2(self.x + other.x, self.y + other.y)
    }
}

impl AddAssign for Vec2 {
    fn add_assign(&mut self, other: Vec2) {
        *self = *self + other;
    }
}

impl Sub for Vec2 {
    type Output = Vec2;
    fn sub(self, other: Vec2) -> Vec2 {
        vec2(self.x - other.x, self.y - other.y)
    }
}

impl SubAssign for Vec2 {
    fn sub_assign(&mut self, other: Vec2) {
        *self = *self - other;
    }
}

impl Neg for Vec2 {
    type Output = Vec2;
    fn neg(self) -> Vec2 {
        vec2(-self.x, -self.y)
    }
}

impl Mul<f64> for Vec2 {
    type Output = Vec2;
    fn mul(self, factor: f64) -> Vec2 {
        vec2(self.x * factor, self.y * factor)
    }
}

impl Div<f64> for Vec2 {
    type Output = Vec2;
    fn div(self, divisor: f64) -> Vec2 {
        vec2(self.x / divisor, self.y / divisor)
    }
}

/// An axis-aligned rectangle in the plan frame, metres; `min` is the lower-left corner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rect {
    /// Lower-left corner.
    pub min: Vec2,
    /// Upper-right corner.
    pub max: Vec2,
}

impl Rect {
    /// Bounding rectangle of two points.
    pub fn around(a: Vec2, b: Vec2) -> Rect {
        Rect { min: vec2(a.x.min(b.x), a.y.min(b.y)), max: vec2(a.x.max(b.x), a.y.max(b.y)) }
    }

    /// The rectangle grown on every side.
    pub fn grown(self, by_m: f64) -> Rect {
        Rect { min: self.min - vec2(by_m, by_m), max: self.max + vec2(by_m, by_m) }
    }

    /// Whether the point lies inside or on the border.
    pub fn contains(self, p: Vec2) -> bool {
        p.x >= self.min.x && p.x <= self.max.x && p.y >= self.min.y && p.y <= self.max.y
    }

    /// Whether two rectangles share a point.
    pub fn overlaps(self, other: Rect) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }

    /// Width in metres.
    pub fn width(self) -> f64 {
        self.max.x - self.min.x
    }

    /// Height in metres.
    pub fn height(self) -> f64 {
        self.max.y - self.min.y
    }

    /// Middle.
    pub fn centre(self) -> Vec2 {
        (self.min + self.max) * 0.5
    }
}
