use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::math::{Vec2, vec2};

/// The pose and the angle of view of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// x and y in the plan frame and height above the floor, metres.
    pub position_m: [f64; 3],
    /// Heading in the plan, degrees counter-clockwise from +x.
    pub heading_deg: f64,
    /// Pitch, degrees upward from level; negative looks down.
    pub pitch_deg: f64,
    /// Horizontal angle of view, degrees.
    pub fov_deg: f64,
}

/// Horizontal angle of view where no other is given, degrees: a 29 mm lens on 35 mm film.
pub const DEFAULT_FOV_DEG: f64 = 64.0;

/// Names and ranges of the numbers that a [`Camera`] is parsed from.
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
    /// [`CameraError::Number`].
    pub fn check(&self) -> Result<(), CameraError> {
        let [x, y, z] = self.position_m;
        let values = [x, y, z, self.heading_deg, self.pitch_deg];
        let checks = values.into_iter().zip(NUMBERS).map(|(value, (name, range))| (value, name, range));
        for (value, name, [low, high]) in checks.chain([(self.fov_deg, "fov", FOV_DEG)]) {
            // Written so that NaN is out of range.
            if !(value >= low && value <= high) {
                return Err(CameraError::Number { name, value, low, high });
            }
        }
        Ok(())
    }

    /// Its position in the plan, metres.
    pub fn place_m(&self) -> Vec2 {
        vec2(self.position_m[0], self.position_m[1])
    }

    /// Returns the camera with another horizontal angle of view, degrees.
    pub fn with_fov(self, fov_deg: f64) -> Camera {
        Camera { fov_deg, ..self }
    }
}

/// Parses `x,y,z,heading,pitch`, metres and degrees, with `DEFAULT_FOV_DEG`.
impl FromStr for Camera {
    type Err = CameraError;

    fn from_str(text: &str) -> Result<Camera, CameraError> {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        if parts.len() != NUMBERS.len() {
            return Err(CameraError::Parts { text: text.to_string(), found: parts.len() });
        }
        let mut values = [0.0; 5];
        for ((value, part), (name, _)) in values.iter_mut().zip(parts).zip(NUMBERS) {
            *value = part.parse().map_err(|_| CameraError::NotANumber { name, text: part.to_string() })?;
        }
        let [x, y, z, heading_deg, pitch_deg] = values;
        let camera = Camera { position_m: [x, y, z], heading_deg, pitch_deg, fov_deg: DEFAULT_FOV_DEG };
        camera.check().map(|()| camera)
    }
}

/// Writes `x,y,z,heading,pitch`, without the angle of view.
impl std::fmt::Display for Camera {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position_m;
        write!(f, "{x:.2},{y:.2},{z:.2},{:.1},{:.1}", self.heading_deg, self.pitch_deg)
    }
}

/// Why a camera is invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// The text does not hold five numbers.
    #[error("the camera `{text}` has {found} numbers, not 5")]
    Parts {
        /// The input.
        text: String,
        /// How many numbers it has.
        found: usize,
    },
    /// A part of the text is not a number.
    #[error("the camera's {name} is `{text}`, which is not a number")]
    NotANumber {
        /// Name of the number, such as `heading`.
        name: &'static str,
        /// The part.
        text: String,
    },
    /// A number is out of range.
    #[error("the camera's {name} is {value}; allowed is {low} to {high}")]
    Number {
        /// Name of the number, such as `heading`.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Least allowed value.
        low: f64,
        /// Greatest allowed value.
        high: f64,
    },
}

impl CameraError {
    /// Suggests a remedy to the user.
    pub fn hint(&self) -> Option<String> {
        match self {
            CameraError::Parts { .. } | CameraError::NotANumber { .. } => Some(
                "a camera is x,y,z,heading,pitch: metres from the plan's lower left corner, height, and degrees, \
                 such as 12.5,3,1.7,90,-5"
                    .to_string(),
            ),
            CameraError::Number { name: "heading" | "pitch" | "fov", .. } => {
                Some("angles are degrees: heading counter-clockwise from the plan's +x, pitch upward".to_string())
            }
            CameraError::Number { .. } => None,
        }
    }
}

/// A still in a bake's `preview/` and its camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StillEntry {
    /// Path of the image, relative to the bake.
    pub file: String,
    /// The camera that it was rendered with.
    pub camera: Camera,
}
