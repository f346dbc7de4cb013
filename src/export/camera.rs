use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::math::{Vec2, vec2};

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

    /// Where it stands in the plan.
    pub fn place_m(&self) -> Vec2 {
        vec2(self.position_m[0], self.position_m[1])
    }

    /// The same camera with another angle of view, degrees.
    pub fn with_fov(self, fov_deg: f64) -> Camera {
        Camera { fov_deg, ..self }
    }
}

/// `x,y,z,heading,pitch`: metres and degrees; the angle of view is [`DEFAULT_FOV_DEG`].
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

/// As it is parsed.
impl std::fmt::Display for Camera {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position_m;
        write!(f, "{x:.2},{y:.2},{z:.2},{:.1},{:.1}", self.heading_deg, self.pitch_deg)
    }
}

/// Why a camera cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// Not five numbers.
    #[error("the camera `{text}` has {found} numbers, not 5")]
    Parts {
        /// The text that was given.
        text: String,
        /// How many numbers it has.
        found: usize,
    },
    /// A part of a camera is no number.
    #[error("the camera's {name} is `{text}`, which is not a number")]
    NotANumber {
        /// Which part.
        name: &'static str,
        /// The text that was given.
        text: String,
    },
    /// A number out of range.
    #[error("the camera's {name} is {value}; allowed is {low} to {high}")]
    Number {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
    },
}

impl CameraError {
    /// What the user can do about it.
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

/// A still of a bake's `preview/` and where it was taken from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StillEntry {
    /// The file.
    pub file: String,
    /// The camera.
    pub camera: Camera,
}
