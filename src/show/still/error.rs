use crate::export::{CameraError, ExportError};

/// Errors of stills.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StillError {
    /// The camera cannot be used.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// A picture cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The camera is inside a wall, or beyond the plan, and below the walls' height.
    #[error("the camera at x = {:.2} m, y = {:.2} m is {}", place_m[0], place_m[1], if *beyond { "beyond the plan" } else { "inside a wall" })]
    NotOnFloor {
        /// The camera's place, metres.
        place_m: [f64; 2],
        /// True if it lies outside the rectangle around all floor.
        beyond: bool,
        /// The nearest free place on the floor, metres.
        nearest_m: [f64; 2],
        /// Height above which a camera may be anywhere, metres.
        wall_height_m: f64,
    },
    /// A picture too small or too large.
    #[error("the picture's size is {width} x {height} px; allowed are {low} to {high} px each way")]
    Size {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Least.
        low: u32,
        /// Greatest.
        high: u32,
    },
    /// A size that is not two numbers.
    #[error("the size `{text}` is not two whole numbers with an x between them")]
    NotASize {
        /// The text that was given.
        text: String,
    },
}

impl StillError {
    /// Suggests a remedy.
    pub fn hint(&self) -> Option<String> {
        match self {
            StillError::Camera(error) => error.hint(),
            StillError::Export(error) => error.hint(),
            StillError::NotOnFloor { nearest_m: [x, y], wall_height_m, .. } => Some(format!(
                "the nearest place on the floor is {x:.2},{y:.2}; above {wall_height_m} m a camera may be anywhere"
            )),
            StillError::NotASize { .. } | StillError::Size { .. } => {
                Some("give width and height in pixels, such as 1920x1080".to_string())
            }
        }
    }
}
