//! The scale of a plan.

use super::{ASSUMED_M_PER_PX, LARGEST_M_PER_PX, LARGEST_SIDE_M, PlanError, PlanOptions, SMALLEST_M_PER_PX, TwoPoints};

/// Returns the metres per pixel and whether they are assumed. Options override the map.
pub(super) fn choose(options: &PlanOptions, from_map: Option<f64>) -> Result<(f64, bool), PlanError> {
    let (what, value) = match (options.metres_per_pixel, &options.scale, from_map) {
        (Some(_), Some(_), _) => return Err(PlanError::ScaleTwice),
        (Some(value), None, _) => ("the scale", value),
        (None, Some(points), _) => ("the scale that follows from two points", of_two_points(points)?),
        (None, None, Some(value)) => ("the map's resolution", value),
        (None, None, None) => return Ok((ASSUMED_M_PER_PX, true)),
    };
    // This form also refuses NaN.
    if !(SMALLEST_M_PER_PX..=LARGEST_M_PER_PX).contains(&value) {
        return Err(PlanError::Scale { what: what.to_owned(), value });
    }
    Ok((value, false))
}

fn of_two_points(points: &TwoPoints) -> Result<f64, PlanError> {
    let ([x0, y0], [x1, y1]) = (points.from.px, points.to.px);
    let refuse = |reason: String| Err(PlanError::TwoPoints { reason });
    if ![x0, y0, x1, y1].iter().all(|v| v.is_finite()) {
        return refuse("a coordinate is not a number".into());
    }
    if !(points.metres.is_finite() && points.metres > 0.0) {
        return refuse(format!("their distance is {} m", points.metres));
    }
    let pixels = ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)).sqrt();
    if pixels < 1.0 {
        return refuse(format!("they lie {pixels} pixels apart"));
    }
    Ok(points.metres / pixels)
}

/// Refuses a plan larger than [`LARGEST_SIDE_M`] on a side.
pub(super) fn check_size(width_px: u32, height_px: u32, metres_per_pixel: f64) -> Result<(), PlanError> {
    let [width_m, height_m] = [width_px, height_px].map(|px| f64::from(px) * metres_per_pixel);
    if width_m.max(height_m) > LARGEST_SIDE_M {
        return Err(PlanError::TooLarge { metres_per_pixel, width_m, height_m });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PixelPoint;

    fn with(metres_per_pixel: f64) -> PlanOptions {
        PlanOptions { metres_per_pixel: Some(metres_per_pixel), ..PlanOptions::default() }
    }

    fn two_points(from: [f64; 2], to: [f64; 2], metres: f64) -> PlanOptions {
        let [from, to] = [from, to].map(|px| PixelPoint { px });
        PlanOptions { scale: Some(TwoPoints { from, to, metres }), ..PlanOptions::default() }
    }

    #[test]
    fn a_setting_goes_before_the_map_and_both_before_the_assumption() {
        assert_eq!(choose(&with(0.1), Some(0.2)).unwrap(), (0.1, false));
        assert_eq!(choose(&PlanOptions::default(), Some(0.2)).unwrap(), (0.2, false));
        assert_eq!(choose(&PlanOptions::default(), None).unwrap(), (0.05, true));
        assert_eq!(choose(&two_points([120.0, 40.0], [480.0, 40.0], 36.0), Some(0.2)).unwrap(), (0.1, false));
    }

    #[test]
    fn scales_that_are_none_are_refused() {
        for value in [f64::NAN, 0.0, -0.1, f64::INFINITY, 1e9, 1e-9] {
            assert!(matches!(choose(&with(value), None), Err(PlanError::Scale { .. })), "{value}");
            assert!(matches!(choose(&PlanOptions::default(), Some(value)), Err(PlanError::Scale { .. })), "{value}");
            let points = two_points([0.0, 0.0], [100.0, 0.0], value);
            assert!(choose(&points, None).is_err(), "{value}");
        }
        let same = two_points([5.0, 5.0], [5.0, 5.0], 1.0);
        assert!(matches!(choose(&same, None), Err(PlanError::TwoPoints { .. })));
        let twice = PlanOptions { metres_per_pixel: Some(0.1), ..two_points([0.0, 0.0], [9.0, 0.0], 1.0) };
        assert!(matches!(choose(&twice, None), Err(PlanError::ScaleTwice)));
    }
}
