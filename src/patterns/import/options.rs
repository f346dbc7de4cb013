//! Options of an import.

use super::ImportError;
use crate::patterns::{Cause, Form};

/// Options of an import: scale, crop and rotation of a photograph, and the cause of its stain.
#[derive(Clone, Debug)]
pub struct ImportOptions {
    /// Cause of the stain.
    pub cause: Cause,
    /// Kind of stain, for causes with several.
    pub form: Option<Form>,
    /// Scale of the photograph.
    pub size: PhotoScale,
    /// Crop: left, top, width, height in pixels; `None` for the whole photograph.
    pub crop: Option<[u32; 4]>,
    /// Rotation of the photograph, degrees counter-clockwise, -360 to 360: afterwards the drag, or the toes, point to
    /// the right.
    pub rotate_deg: f64,
}

/// Scale of a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoScale {
    /// Pixels of the photograph per centimetre of the wall, 4 to 200.
    PxPerCm(f64),
    /// Length of the rotated stain along the drag, centimetres, 0.5 to 150.
    LengthCm(f64),
}

impl ImportOptions {
    /// Checks every value against its range.
    pub(super) fn check(&self) -> Result<(), ImportError> {
        let value = |key, value: f64, allowed: &'static str| Err(ImportError::Value { key, value, allowed });
        match self.size {
            PhotoScale::PxPerCm(scale) if !(4.0..=200.0).contains(&scale) => {
                return value("scale", scale, "4 to 200 px/cm");
            }
            PhotoScale::LengthCm(length) if !(0.5..=150.0).contains(&length) => {
                return value("length", length, "0.5 to 150 cm");
            }
            _ => {}
        }
        if !(-360.0..=360.0).contains(&self.rotate_deg) {
            return value("rotation", self.rotate_deg, "-360 to 360 degrees");
        }
        match self.form {
            Some(form) if form.cause() != self.cause => Err(ImportError::Form { cause: self.cause, form }),
            _ => Ok(()),
        }
    }
}
