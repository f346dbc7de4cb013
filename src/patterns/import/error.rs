use std::path::PathBuf;

use super::super::{Cause, Form};
use crate::files::FileError;

/// Why no pattern can be taken from a photograph.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A number beyond what it may be.
    #[error("the {key} is {value}, allowed is {allowed}")]
    Value {
        /// Which.
        key: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A form that the cause does not have.
    #[error("cause \"{}\" has no form \"{}\", allowed is {}", .cause.name(), .form.name(), Form::of_cause_in_words(*.cause))]
    Form {
        /// What left the stain.
        cause: Cause,
        /// The form.
        form: Form,
    },
    /// No image.
    #[error("cannot read the photograph: {reason}")]
    Unreadable {
        /// What the decoder says.
        reason: String,
    },
    /// The photograph has far too many or too few pixels.
    #[error("the photograph has {width} x {height} px, allowed are {allowed}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// What it may have.
        allowed: &'static str,
    },
    /// The part to look at reaches beyond the photograph, or is too small.
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
    /// Nothing stands out from the wall.
    #[error(
        "there is no stain in the photograph: nothing differs from the wall by more than its unevenness, density {noise:.3}"
    )]
    NoStain {
        /// How uneven the wall is.
        noise: f64,
    },
    /// The wall around the stain cannot be seen.
    #[error(
        "the stain fills the photograph: clean wall is {wall_percent:.0} % of it, and the stain lies along {border_percent:.0} % of its border"
    )]
    FillsPhoto {
        /// Share of the photograph that is wall.
        wall_percent: f64,
        /// Share of its border that is stain.
        border_percent: f64,
    },
    /// The scale that follows from the stain's length is out of range.
    #[error("a stain of {length_px:.0} px and {length_cm} cm has {px_per_cm:.1} px/cm, allowed are 4 to 200")]
    Scale {
        /// Length of the stain in the photograph, pixels.
        length_px: f64,
        /// Its real length, centimetres.
        length_cm: f64,
        /// What follows.
        px_per_cm: f64,
    },
    /// No pattern of the cause may have this size.
    #[error(
        "the stain with its margin is {length_cm:.1} x {breadth_cm:.1} cm; a pattern with cause = \"{}\" is {} to {} cm long \
         and at most {most_aspect} times as high", .cause.name(), .lengths_cm[0], .lengths_cm[1]
    )]
    Extent {
        /// What left it.
        cause: Cause,
        /// Size along.
        length_cm: f64,
        /// Size across.
        breadth_cm: f64,
        /// Lengths that its patterns may have.
        lengths_cm: [f64; 2],
        /// Greatest breadth over length.
        most_aspect: f64,
    },
    /// A name that is not one of a file.
    #[error("\"{name}\" cannot be the name of a pattern: letters, digits, - and _ are allowed, at most 60")]
    Name {
        /// The name.
        name: String,
    },
    /// A share that is none.
    #[error("the share is {share}, allowed is above 0, to 1000000")]
    Share {
        /// The share.
        share: f64,
    },
    /// The list names the image already.
    #[error("{} lists {image} already", .file.display())]
    IsListed {
        /// The listing.
        file: PathBuf,
        /// The image.
        image: String,
    },
    /// The image or the list cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The folder cannot be made.
    #[error("cannot make the folder {}: {source}", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
}

impl ImportError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            ImportError::Unreadable { .. } => "PNG, JPEG, TIFF and BMP are read",
            ImportError::Size { .. } => "scale it down, or cut the stain out with some wall around it",
            ImportError::Crop { .. } => {
                "--crop is left,top,width,height in pixels from the upper left of the photograph"
            }
            ImportError::NoStain { .. } => {
                "photograph it in even light, closer; or cut out with --crop what is not wall: skirtings, switches, edges"
            }
            ImportError::FillsPhoto { .. } => {
                "the clean wall is seen around the stain only: photograph it from farther away, or choose a larger --crop"
            }
            ImportError::Scale { .. } => "--length-cm is the length of the stain itself, from left to right",
            ImportError::Extent { .. } => {
                "check --scale or --length-cm; --rotate turns the stain so that its drag, or the toes, point to the right"
            }
            ImportError::Name { .. } => "choose one with --name",
            ImportError::IsListed { .. } => "--force replaces it; or choose another --name",
            ImportError::Form { cause, .. } if Form::ALL.iter().all(|form| form.cause() != *cause) => {
                "leave --form out"
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
