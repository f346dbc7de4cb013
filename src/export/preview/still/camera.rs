use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::StillError;
use crate::math::{Vec2, sin_cos, vec2};

/// Where a picture is taken from, and in which direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// x and y in the plan frame and height above the floor, metres.
    pub position_m: [f64; 3],
    /// Direction in the plan, degrees counter-clockwise from +x.
    pub heading_deg: f64,
    /// Upward from level, degrees; negative looks down.
    pub pitch_deg: f64,
    /// Horizontal angle of view, degrees.
    pub fov_deg: f64,
}

/// Angle of view of cameras that say nothing of it, degrees: a 29 mm lens on 35 mm film.
pub const DEFAULT_FOV_DEG: f64 = 64.0;

/// Names of the numbers that [`Camera`] is parsed from, and their ranges.
const NUMBERS: [(&str, [f64; 2]); 5] = [
    ("x", [-100_000.0, 100_000.0]),
    ("y", [-100_000.0, 100_000.0]),
    ("z", [0.05, 10_000.0]),
    ("heading", [-360.0, 360.0]),
    ("pitch", [-89.0, 89.0]),
];
/// Allowed angles of view, degrees.
pub const FOV_DEG: [f64; 2] = [5.0, 140.0];

impl Camera {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`StillError::Number`].
    pub fn check(&self) -> Result<(), StillError> {
        let [x, y, z] = self.position_m;
        let values = [x, y, z, self.heading_deg, self.pitch_deg];
        let checks = values.into_iter().zip(NUMBERS).map(|(value, (name, range))| (value, name, range));
        for (value, name, [low, high]) in checks.chain([(self.fov_deg, "fov", FOV_DEG)]) {
            // Written so that NaN is out of range.
            if !(value >= low && value <= high) {
                return Err(StillError::Number { name, value, low, high });
            }
        }
        Ok(())
    }

    /// Where it stands in the plan.
    pub fn place_m(&self) -> Vec2 {
        vec2(self.position_m[0], self.position_m[1])
    }

    /// The same camera with another angle of view, degrees.
    pub fn with_fov(self, fov_deg: f64) -> Camera {
        Camera { fov_deg, ..self }
    }

    /// The lens for a picture of a size in pixels.
    pub(super) fn lens(&self, [width, height]: [u32; 2]) -> Lens {
        let radians = std::f64::consts::PI / 180.0;
        let (sin_h, cos_h) = sin_cos(self.heading_deg * radians);
        let (sin_p, cos_p) = sin_cos(self.pitch_deg * radians);
        let (sin_f, cos_f) = sin_cos(self.fov_deg * 0.5 * radians);
        let pixel = 2.0 * (sin_f / cos_f) / f64::from(width);
        Lens {
            position: self.position_m,
            forward: [cos_p * cos_h, cos_p * sin_h, sin_p],
            right: [sin_h * pixel, -cos_h * pixel, 0.0],
            down: [sin_p * cos_h * pixel, sin_p * sin_h * pixel, -cos_p * pixel],
            middle: [f64::from(width) * 0.5, f64::from(height) * 0.5],
            pixel,
        }
    }
}

/// `x,y,z,heading,pitch`: metres and degrees; the angle of view is [`DEFAULT_FOV_DEG`].
impl FromStr for Camera {
    type Err = StillError;

    fn from_str(text: &str) -> Result<Camera, StillError> {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        if parts.len() != NUMBERS.len() {
            return Err(StillError::CameraParts { text: text.to_string(), found: parts.len() });
        }
        let mut values = [0.0; 5];
        for ((value, part), (name, _)) in values.iter_mut().zip(parts).zip(NUMBERS) {
            *value = part.parse().map_err(|_| StillError::NotANumber { name, text: part.to_string() })?;
        }
        let [x, y, z, heading_deg, pitch_deg] = values;
        let camera = Camera { position_m: [x, y, z], heading_deg, pitch_deg, fov_deg: DEFAULT_FOV_DEG };
        camera.check().map(|()| camera)
    }
}

/// As it is parsed.
impl std::fmt::Display for Camera {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position_m;
        write!(f, "{x:.2},{y:.2},{z:.2},{:.1},{:.1}", self.heading_deg, self.pitch_deg)
    }
}

/// A camera that makes rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    pub position: [f64; 3],
    pub forward: [f64; 3],
    /// To the next pixel on the right, at the distance 1.
    pub right: [f64; 3],
    /// To the next pixel below.
    pub down: [f64; 3],
    middle: [f64; 2],
    /// Side of a pixel at the distance 1.
    pub pixel: f64,
}

impl Lens {
    /// Unit vector from the camera through a place of the picture: pixels from its upper left corner.
    pub fn ray(&self, x: f64, y: f64) -> [f64; 3] {
        let (x, y) = (x - self.middle[0], y - self.middle[1]);
        let way: [f64; 3] = std::array::from_fn(|k| self.forward[k] + self.right[k] * x + self.down[k] * y);
        let length = (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt();
        way.map(|c| c / length)
    }

    /// Where the picture shows a point: pixels from its upper left corner; `None` behind the camera.
    #[cfg(test)]
    pub fn project(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let from: [f64; 3] = std::array::from_fn(|k| point[k] - self.position[k]);
        let depth = dot(from, self.forward);
        let square = self.pixel * self.pixel;
        (depth > 0.0)
            .then(|| [self.right, self.down].map(|axis| dot(from, axis) / (depth * square)))
            .map(|[x, y]| [x + self.middle[0], y + self.middle[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight ahead is the middle; what lies to the left of the heading is left of it, what lies below is below.
    #[test]
    fn points_are_seen_where_a_pinhole_shows_them() {
        let camera: Camera = "2,3,1.7,90,0".parse().unwrap();
        let lens = camera.with_fov(90.0).lens([400, 200]);
        let close = |point: [f64; 3], expected: [f64; 2]| {
            let [x, y] = lens.project(point).unwrap();
            assert!((x - expected[0]).abs() < 1e-9 && (y - expected[1]).abs() < 1e-9, "{point:?} at {x}, {y}");
        };
        close([2.0, 13.0, 1.7], [200.0, 100.0]);
        close([1.0, 13.0, 1.7], [180.0, 100.0]);
        close([2.0, 13.0, 0.7], [200.0, 120.0]);
        assert_eq!(lens.project([2.0, 1.0, 1.7]), None);
    }

    #[test]
    fn a_ray_through_a_pixel_leads_to_what_is_seen_there() {
        let camera: Camera = "2,3,1.7,37,-21".parse().unwrap();
        let lens = camera.lens([320, 180]);
        for place in [[0.0, 0.0], [160.0, 90.0], [319.5, 3.25], [12.0, 180.0]] {
            let way = lens.ray(place[0], place[1]);
            let seen = lens.project(std::array::from_fn(|k| camera.position_m[k] + 7.0 * way[k])).unwrap();
            assert!((seen[0] - place[0]).abs() < 1e-8 && (seen[1] - place[1]).abs() < 1e-8, "{place:?}: {seen:?}");
        }
    }
}
