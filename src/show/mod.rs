//! Shows a result to people: pictures from above, stills in perspective, animations, the 3D scene and the page.

mod animation;
pub mod edit;
pub mod page;
mod pictures;
mod rooms;
pub mod scene;
pub mod still;

pub(crate) use animation::Animation;
pub use animation::{AnimationColour, AnimationError, AnimationFormat, AnimationOptions, AnimationReport};
pub use pictures::{
    Crop, Path, PathSample, draw_keys, draw_paths, draw_plan, draw_unit, encode_picture, render_crop, render_floor,
    write_previews,
};
pub(crate) use pictures::{PATHS_FILE, PathSampler, choose_crops, write_flipbook, write_picture};
pub(crate) use rooms::Ceiling;
pub use rooms::Rooms;
