use std::path::PathBuf;

use super::limits::{LARGEST_AREA_PX, LARGEST_M_PER_PX, LARGEST_SIDE_M, LARGEST_SIDE_PX, SMALLEST_M_PER_PX};
use super::vector::VectorFormat;
use crate::math::Vec2;

/// Error while reading a plan.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The file is missing or cannot be opened.
    #[error("cannot read the plan {path}: {source}", path = .path.display())]
    Open {
        /// The plan image or map YAML.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file has zero bytes.
    #[error("the plan {path} is empty (0 bytes)", path = .path.display())]
    Empty {
        /// The plan image or map YAML.
        path: PathBuf,
    },
    /// The file is not an image of a known format.
    #[error("the plan {path} is not an image of a known format", path = .path.display())]
    UnknownFormat {
        /// The plan image.
        path: PathBuf,
    },
    /// The image is truncated or corrupt.
    #[error("the plan {path} is damaged: {reason}", path = .path.display())]
    Damaged {
        /// The plan image.
        path: PathBuf,
        /// Message of the decoder.
        reason: String,
    },
    /// The kind of image is not supported.
    #[error("the plan {path} cannot be read: {what} is not supported", path = .path.display())]
    Unsupported {
        /// The plan image.
        path: PathBuf,
        /// The kind of image.
        what: String,
    },
    /// The decoded pixels exceed the limit on memory.
    #[error(
        "the plan {path} claims {width} x {height} pixels that take {bytes} bytes; at most {most} are read",
        path = .path.display()
    )]
    TooManyBytes {
        /// The plan image.
        path: PathBuf,
        /// Pixels across, from the header.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes of the decoded image.
        bytes: u64,
        /// Limit on the bytes of the decoded image.
        most: u64,
    },
    /// Not enough memory for an image.
    #[error("there is no memory for the {width} x {height} pixels of the plan {path}: they take up to {needed} bytes", path = .path.display())]
    NoMemory {
        /// The plan image.
        path: PathBuf,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes needed.
        needed: u64,
    },
    /// The image has too many pixels.
    #[error(
        "the plan {path} claims {width} x {height} pixels; at most {LARGEST_SIDE_PX} a side and \
         {LARGEST_AREA_PX} in all are read",
        path = .path.display()
    )]
    TooManyPixels {
        /// The plan image.
        path: PathBuf,
        /// Pixels across, from the header.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The image has too few pixels.
    #[error("the plan {path} has {width} x {height} pixels: too small for a room", path = .path.display())]
    TooFewPixels {
        /// The plan image.
        path: PathBuf,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The crop keeps nothing, or cannot be placed.
    #[error("plan.crop {problem} (the image has {width} x {height} pixels)")]
    Crop {
        /// The problem.
        problem: String,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The paint over the plan cannot be used.
    #[error("the paint {path} {problem}", path = .path.display())]
    Paint {
        /// The painted image.
        path: PathBuf,
        /// The problem, with the pixel and its colour.
        problem: String,
        /// A remedy.
        hint: Option<String>,
    },
    /// The map YAML is invalid.
    #[error("the map {path} cannot be used: {reason}", path = .path.display())]
    Map {
        /// The YAML.
        path: PathBuf,
        /// The problem, with line and column.
        reason: String,
    },
    /// The vector drawing cannot be used.
    #[error("the {kind} {path} cannot be used: {reason}", kind = .format.name(), path = .path.display())]
    Drawing {
        /// The drawing.
        path: PathBuf,
        /// Its format.
        format: VectorFormat,
        /// The problem.
        reason: String,
    },
    /// The shapes of a vector drawing lie over each other in too many layers.
    #[error("the shapes of the drawing lie over each other: they cover it more than {times} times")]
    PaintedOver {
        /// How often they cover the whole drawing before reading ends.
        times: u64,
    },
    /// The image of a map YAML is missing.
    #[error("the map {map} names the image {image}, which does not exist", map = .map.display(), image = .image.display())]
    MapImageMissing {
        /// The YAML.
        map: PathBuf,
        /// The image, resolved relative to the YAML.
        image: PathBuf,
        /// An image beside it with a similar name.
        similar: Option<PathBuf>,
    },
    /// The scale is out of range.
    #[error("{what} is {value}; metres per pixel must lie between {SMALLEST_M_PER_PX} and {LARGEST_M_PER_PX}")]
    Scale {
        /// Kind of scale and its source.
        what: String,
        /// Its value, metres per pixel.
        value: f64,
    },
    /// The scale is given more than once.
    #[error("the scale is given twice: give metres per pixel, two points or the building's width")]
    ScaleTwice,
    /// The two points do not define a scale.
    #[error("the two points do not define a scale: {reason}")]
    TwoPoints {
        /// The problem.
        reason: String,
    },
    /// The plan is too large.
    #[error(
        "at {metres_per_pixel} m per pixel the plan is {width_m:.0} x {height_m:.0} m; at most {LARGEST_SIDE_M} m a side are walked"
    )]
    TooLarge {
        /// Scale.
        metres_per_pixel: f64,
        /// Width, metres.
        width_m: f64,
        /// Height, metres.
        height_m: f64,
    },
    /// The paths of a recording span too large an area.
    #[error(
        "without a plan the floor around the paths would be {width_m:.0} x {height_m:.0} m; at most {LARGEST_SIDE_M} m a side are walked"
    )]
    PathsTooWide {
        /// Width, metres.
        width_m: f64,
        /// Height, metres.
        height_m: f64,
    },
    /// An option is not allowed.
    #[error(transparent)]
    Option(#[from] crate::options::OptionError),
    /// No pixel is floor.
    #[error("the plan has no floor: none of its {pixels} pixels is as light as the threshold, {threshold} of 255")]
    NoFloor {
        /// Pixels in the image.
        pixels: usize,
        /// Lightness at which floor begins.
        threshold: u8,
    },
    /// No pixel is wall.
    #[error("the plan has no walls: none of its {pixels} pixels is darker than the threshold, {threshold} of 255")]
    NoWalls {
        /// Pixels in the image.
        pixels: usize,
        /// Lightness at which floor begins.
        threshold: u8,
    },
    /// The floor is too narrow for a person.
    #[error(
        "no place in the plan is wide enough for a person of {narrowest_m} m at {metres_per_pixel} m per pixel \
         (the plan is {width_m:.2} x {height_m:.2} m)"
    )]
    NoRoom {
        /// Width of the narrowest person, metres.
        narrowest_m: f64,
        /// Scale.
        metres_per_pixel: f64,
        /// Width of the plan, metres.
        width_m: f64,
        /// Height of the plan, metres.
        height_m: f64,
    },
    /// A point given as floor is not on the floor.
    #[error("the point ({x:.2}, {y:.2}) m that should be floor {where_}", x = .point_m.x, y = .point_m.y)]
    SeedNotFloor {
        /// The point, metres.
        point_m: Vec2,
        /// Where the point lies instead.
        where_: String,
        /// The nearest place with room for a person, metres.
        nearest_m: Option<Vec2>,
    },
}

impl PlanError {
    /// Hint for the user.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            PlanError::UnknownFormat { .. } => {
                "use PNG, JPEG, BMP, PGM, TIFF, GIF, SVG, PDF, DXF, the YAML of a ROS map or an Open-RMF building, or a \
                 Universal VTT map"
                    .into()
            }
            PlanError::Drawing { format, .. } => format.hint().into(),
            PlanError::PaintedOver { .. } => "leave out what lies under other shapes, or save the drawing as a picture".into(),
            PlanError::Empty { .. } | PlanError::Damaged { .. } => "save or copy the file again".into(),
            PlanError::Open { path, .. } if path.to_string_lossy().contains(char::is_control) => {
                "in double quotes, \\t is a tab and \\n a line break: write the path with slashes, \"plans/office.png\", or in \
                 single quotes"
                    .into()
            }
            PlanError::Open { path, source } if source.kind() == std::io::ErrorKind::NotFound => {
                format!("did you mean {}?", super::similar::similar_file(path)?.display())
            }
            PlanError::Unsupported { .. } => "save it as PNG, or as TIFF with 8 bits of grey or colour".into(),
            PlanError::TooManyBytes { .. } => "save it with 8 bits of grey a pixel, or reduce it".into(),
            PlanError::NoMemory { .. } => "reduce the image; walls are traced more finely than pixels".into(),
            PlanError::TooManyPixels { .. } => "reduce the image; walls are traced more finely than pixels".into(),
            PlanError::MapImageMissing { similar: Some(similar), .. } => {
                format!("{} lies beside it: correct the name in the YAML", similar.display())
            }
            PlanError::MapImageMissing { similar: None, .. } => {
                "the name after `image:` is relative to the YAML's folder".into()
            }
            PlanError::Crop { .. } => "crop = [{ px = [40, 30] }, { px = [900, 640] }]".into(),
            PlanError::Paint { hint, .. } => hint.clone()?,
            PlanError::Scale { .. } => "0.05 means that a pixel is 5 cm wide".into(),
            PlanError::ScaleTwice => {
                "leave out all but one of plan.metres_per_pixel, plan.scale and plan.width_m".into()
            }
            PlanError::TwoPoints { .. } => {
                "scale = { from = { px = [120, 40] }, to = { px = [480, 40] }, metres = 36.0 }".into()
            }
            PlanError::TooLarge { .. } | PlanError::NoRoom { .. } => "check the scale in metres per pixel".into(),
            PlanError::PathsTooWide { .. } => "check the unit of the recording, such as metres or centimetres".into(),
            PlanError::NoFloor { .. } => {
                "white is floor, black is wall; lower plan.threshold if the floor is grey".into()
            }
            PlanError::NoWalls { .. } => {
                "raise plan.threshold if walls are light grey; name plan.wall_colours if they are coloured".into()
            }
            PlanError::SeedNotFloor { nearest_m: Some(p), .. } => {
                format!("the nearest floor is at [{:.2}, {:.2}]", p.x, p.y)
            }
            _ => return None,
        })
    }
}
