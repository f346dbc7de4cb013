use std::path::PathBuf;

use crate::files::FileError;
use crate::patterns::{Cause, Form};

/// Error while importing a pattern from a photograph.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A value is out of range.
    #[error("the {key} is {value}, allowed is {allowed}")]
    Value {
        /// Name of the value.
        key: &'static str,
        /// The value.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// The form does not belong to the cause.
    #[error("cause \"{}\" has no form \"{}\", allowed is {}", .cause.name(), .form.name(), Form::of_cause_in_words(*.cause))]
    Form {
        /// Cause of the stain.
        cause: Cause,
        /// The form.
        form: Form,
    },
    /// The photograph cannot be decoded.
    #[error("cannot read the photograph: {reason}")]
    Unreadable {
        /// Message of the decoder.
        reason: String,
    },
    /// The photograph has too many or too few pixels.
    #[error("the photograph has {width} x {height} px, allowed are {allowed}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Allowed size.
        allowed: &'static str,
    },
    /// The crop exceeds the photograph, or is too small.
    #[error(
        "the crop {},{},{},{} does not fit: the photograph has {width} x {height} px, and a crop at least {least} px a side",
        .crop[0], .crop[1], .crop[2], .crop[3]
    )]
    Crop {
        /// Left, top, width, height.
        crop: [u32; 4],
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Least side of a crop.
        least: u32,
    },
    /// The photograph shows no stain.
    #[error(
        "there is no stain in the photograph: nothing differs from the wall by more than its unevenness, density {noise:.3}"
    )]
    NoStain {
        /// Standard deviation of the wall's density.
        noise: f64,
    },
    /// The photograph shows too little clean wall around the stain.
    #[error(
        "the stain fills the photograph: clean wall is {wall_percent:.0} % of it, and the stain lies along {border_percent:.0} % of its border"
    )]
    FillsPhoto {
        /// Share of the photograph that is clean wall, percent.
        wall_percent: f64,
        /// Share of its border that is stain, percent.
        border_percent: f64,
    },
    /// The scale that follows from the stain's length is out of range.
    #[error("a stain of {length_px:.0} px and {length_cm} cm has {px_per_cm:.1} px/cm, allowed are 4 to 200")]
    Scale {
        /// Length of the stain in the photograph, pixels.
        length_px: f64,
        /// Its real length, centimetres.
        length_cm: f64,
        /// The resulting scale, pixels per centimetre.
        px_per_cm: f64,
    },
    /// The stain is too small or too large for its cause.
    #[error(
        "the stain with its margin is {length_cm:.1} x {breadth_cm:.1} cm; a pattern with cause = \"{}\" is {} to {} cm long \
         and at most {most_aspect} times as high", .cause.name(), .lengths_cm[0], .lengths_cm[1]
    )]
    Extent {
        /// Cause of the stain.
        cause: Cause,
        /// Length with the margin, centimetres.
        length_cm: f64,
        /// Breadth with the margin, centimetres.
        breadth_cm: f64,
        /// Allowed lengths, centimetres.
        lengths_cm: [f64; 2],
        /// Largest allowed breadth over length.
        most_aspect: f64,
    },
    /// The pattern's name is not a valid file name.
    #[error("\"{name}\" cannot be the name of a pattern: letters, digits, - and _ are allowed, at most 60")]
    Name {
        /// The name.
        name: String,
    },
    /// The share is out of range.
    #[error("the share is {share}, allowed is above 0, to 1000000")]
    Share {
        /// The share.
        share: f64,
    },
    /// The listing already has the image.
    #[error("{} already lists {image}", .file.display())]
    IsListed {
        /// The listing.
        file: PathBuf,
        /// The image.
        image: String,
    },
    /// The image or the listing cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The folder cannot be created.
    #[error("cannot create the folder {}: {source}", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
}

impl ImportError {
    /// Hint for the user.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            ImportError::Unreadable { .. } => "PNG, JPEG, TIFF and BMP are read",
            ImportError::Size { .. } => "scale it down, or cut the stain out with some wall around it",
            ImportError::Crop { .. } => {
                "a crop is left,top,width,height in pixels from the upper left of the photograph"
            }
            ImportError::NoStain { .. } => {
                "photograph it closer and in even light; or crop skirtings, switches and edges away"
            }
            ImportError::FillsPhoto { .. } => {
                "clean wall must surround the stain: photograph it from farther away, or choose a larger crop"
            }
            ImportError::Scale { .. } => "the length is that of the stain itself, from left to right",
            ImportError::Extent { .. } => {
                "check the scale or the length of the stain, and rotate it so that its drag, or the toes, point to the right"
            }
            ImportError::Name { .. } => "choose another name with the option `name`",
            ImportError::IsListed { .. } | ImportError::File(FileError::Exists { .. }) => {
                "choose another name with the option `name`, or replace the pattern with the option `force`"
            }
            ImportError::Form { cause, .. } if Form::ALL.iter().all(|form| form.cause() != *cause) => {
                "leave the form out"
            }
            ImportError::File(error) => return error.hint(),
            ImportError::Value { .. }
            | ImportError::Form { .. }
            | ImportError::Share { .. }
            | ImportError::Folder { .. } => return None,
        };
        Some(hint.to_owned())
    }
}
