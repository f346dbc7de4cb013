use super::{FloorPlan, LARGEST_SIDE_M, PlanError};
use crate::math::{Rect, vec2};

/// Margin of open ground around the paths, metres.
const MARGIN_M: f64 = 2.0;
/// Side of its pixels, metres, ...
const FINEST_M: f64 = 0.05;
/// ... unless one of its sides would have more pixels than this.
const MOST_PX: f64 = 4096.0;

impl FloorPlan {
    /// Builds open floor: a rectangle of the map frame grown by 2 m, its sides on whole metres.
    ///
    /// # Errors
    /// The ground exceeds `LARGEST_SIDE_M` on a side.
    pub fn open_ground(around_m: Rect) -> Result<FloorPlan, PlanError> {
        let Rect { min, max } = around_m.grown(MARGIN_M);
        let (min, max) = (vec2(min.x.floor(), min.y.floor()), vec2(max.x.ceil(), max.y.ceil()));
        let [width_m, height_m] = [max.x - min.x, max.y - min.y];
        let longest_m = width_m.max(height_m);
        // This form also refuses NaN.
        let fits = width_m <= LARGEST_SIDE_M && height_m <= LARGEST_SIDE_M;
        if !fits {
            return Err(PlanError::PathsTooWide { width_m, height_m });
        }
        let metres_per_pixel = FINEST_M * (longest_m / MOST_PX / FINEST_M).ceil().max(1.0);
        let [width_px, height_px] = [width_m, height_m].map(|side_m| (side_m / metres_per_pixel).round() as u32);
        let floor = vec![1; width_px as usize * height_px as usize];
        let mut plan = FloorPlan::from_mask(width_px, height_px, metres_per_pixel, floor);
        plan.map_from_plan.origin_m = min;
        Ok(plan)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_reaches_around_the_paths() {
        let around_m = Rect { min: vec2(-3.2, 10.0), max: vec2(4.0, 12.5) };
        let plan = FloorPlan::open_ground(around_m).unwrap();
        assert_eq!((plan.width_m(), plan.height_m()), (12.0, 7.0));
        assert_eq!(plan.map_from_plan.origin_m, vec2(-6.0, 8.0));
        assert!(plan.floor.iter().all(|&pixel| pixel == 1));
        assert_eq!(plan.openings.len(), 4);
    }

    #[test]
    fn large_ground_has_larger_pixels_and_too_large_ground_is_refused() {
        let square = |side_m| FloorPlan::open_ground(Rect { min: vec2(0.0, 0.0), max: vec2(side_m, side_m) });
        let plan = square(996.0).unwrap();
        assert_eq!((plan.width_px, plan.metres_per_pixel), (4000, 0.25));
        for side_m in [5000.0, f64::INFINITY, f64::NAN] {
            assert!(matches!(square(side_m), Err(PlanError::PathsTooWide { .. })));
        }
    }
}
