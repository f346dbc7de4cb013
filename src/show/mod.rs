//! Shows a result to people: pictures from above, stills in perspective, animations, the 3D scene and the page.

pub mod animation;
pub mod page;
pub mod pictures;
pub mod scene;
pub mod still;

pub use animation::{
    ANIMATION_SIZES_PX, ANIMATION_SPEEDS, Animation, AnimationColour, AnimationError, AnimationFormat,
    AnimationOptions, AnimationReport,
};
pub use pictures::{
    Crop, PATHS_FILE, Path, PathSample, PathSampler, choose_crops, draw_paths, draw_plan, draw_unit, encode_picture,
    render_crop, render_floor, write_picture, write_previews,
};
