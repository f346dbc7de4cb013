//! Plans from ready floor masks.

use super::{FloorPlan, Painted, PlanScale, Pose, ScaleSource, openings, regions};

impl FloorPlan {
    /// Builds a plan from a floor mask in image order (row 0 at the top); non-zero bytes are floor.
    ///
    /// Unreachable floor counts too. A mask of the wrong length is cut, or filled up with wall.
    pub fn from_mask(width_px: u32, height_px: u32, metres_per_pixel: f64, mut floor: Vec<u8>) -> FloorPlan {
        floor.resize(width_px as usize * height_px as usize, 0);
        for pixel in &mut floor {
            *pixel = u8::from(*pixel != 0);
        }
        let lightness = floor.iter().map(|&f| f * 255).collect();
        let mut plan = FloorPlan {
            width_px,
            height_px,
            metres_per_pixel,
            scale: PlanScale::known(ScaleSource::Given, metres_per_pixel),
            floor,
            lightness,
            classes: Vec::new(),
            scanned: false,
            painted: Painted::default(),
            threshold: 128,
            map_from_plan: Pose::default(),
            regions: Vec::new(),
            openings: Vec::new(),
            doors: Vec::new(),
            windows: Vec::new(),
            furniture: Vec::new(),
            warnings: Vec::new(),
            drawn: None,
        };
        plan.classes = plan.plain_classes();
        plan.regions = regions::of_mask(&plan);
        plan.openings = openings::find(&plan);
        plan
    }

    /// A plan of what is `inside`, by column and row, with furniture of a class where `is_piece` says so.
    #[cfg(test)]
    pub(crate) fn with_furniture(
        [width_px, height_px]: [u32; 2],
        metres_per_pixel: f64,
        inside: impl Fn(u32, u32) -> bool,
        (class, is_piece): (super::PlanClass, impl Fn(u32, u32) -> bool),
    ) -> FloorPlan {
        let pixels = || (0..height_px).flat_map(|y| (0..width_px).map(move |x| (x, y)));
        let floor = pixels().map(|(x, y)| u8::from(inside(x, y) && !is_piece(x, y))).collect();
        let mut plan = FloorPlan::from_mask(width_px, height_px, metres_per_pixel, floor);
        plan.classes.iter_mut().zip(pixels()).filter(|(_, (x, y))| is_piece(*x, *y)).for_each(|(of, _)| *of = class);
        plan
    }
}
