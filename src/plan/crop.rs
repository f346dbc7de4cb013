//! Cuts a plan image before it is read.

use image::DynamicImage;

use super::{PlanError, PlanPoint};

/// The pixels that a crop keeps: left, top, width, height.
pub(super) type Cut = [u32; 4];

/// Finds the pixels between two corners of an image. Corners in metres need the scale.
pub(super) fn cut_of(
    corners: [PlanPoint; 2],
    [width, height]: [u32; 2],
    metres_per_pixel: Option<f64>,
) -> Result<Cut, PlanError> {
    let refuse = |problem: &str| Err(PlanError::Crop { problem: problem.to_string(), width, height });
    let mut ends = [[0.0; 2]; 2];
    for (end, corner) in ends.iter_mut().zip(corners) {
        *end = match (corner, metres_per_pixel) {
            (PlanPoint::Pixels { px }, _) => px,
            (PlanPoint::Metres([x, y]), Some(scale)) => [x / scale, f64::from(height) - y / scale],
            (PlanPoint::Metres(_), None) => return refuse("is in metres, but the scale is not given"),
        };
    }
    if !ends.iter().flatten().all(|v| v.is_finite()) {
        return refuse("has a coordinate that is not a number");
    }
    let side = |axis: usize, most: u32| {
        let (a, b) = (ends[0][axis].min(ends[1][axis]), ends[0][axis].max(ends[1][axis]));
        let [low, high] = [a, b].map(|v| v.round().clamp(0.0, f64::from(most)) as u32);
        (low, high - low)
    };
    let ((left, across), (top, down)) = (side(0, width), side(1, height));
    if across < 2 || down < 2 {
        return refuse("keeps less than 2 x 2 pixels");
    }
    Ok([left, top, across, down])
}

/// Cuts an image.
pub(super) fn cropped(image: DynamicImage, [left, top, across, down]: Cut) -> DynamicImage {
    image.crop_imm(left, top, across, down)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_in_any_order_pixels_or_metres() {
        let px = |x: f64, y: f64| PlanPoint::Pixels { px: [x, y] };
        assert_eq!(cut_of([px(30.0, 5.0), px(10.0, 25.0)], [100, 50], None).unwrap(), [10, 5, 20, 20]);
        let metres = [PlanPoint::Metres([1.0, 2.5]), PlanPoint::Metres([3.0, 4.5])];
        assert_eq!(cut_of(metres, [100, 50], Some(0.1)).unwrap(), [10, 5, 20, 20]);
        assert_eq!(cut_of([px(-9.0, -9.0), px(1e9, 20.0)], [100, 50], None).unwrap(), [0, 0, 100, 20]);
        assert!(cut_of(metres, [100, 50], None).is_err());
        assert!(cut_of([px(10.0, 10.0), px(10.4, 40.0)], [100, 50], None).is_err());
        assert!(cut_of([px(f64::NAN, 10.0), px(20.0, 40.0)], [100, 50], None).is_err());
    }
}
