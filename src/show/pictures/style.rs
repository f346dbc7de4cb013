//! Colours, scales and the legend's place: the same in all drawings of a plan.

use super::canvas::{PlanCanvas, text_width};
use crate::math::srgb::Srgb8;

pub(in crate::show) const PAPER: Srgb8 = [250, 250, 248];
pub(in crate::show) const PLAIN_FLOOR: Srgb8 = [238, 238, 236];
pub(in crate::show) const SOLID: Srgb8 = [70, 70, 74];
pub(in crate::show) const STUCK: Srgb8 = [224, 20, 30];
pub(in crate::show) const TEXT: Srgb8 = [30, 30, 34];
pub(in crate::show) const ROUTES: [Srgb8; 6] =
    [[196, 40, 40], [40, 90, 200], [20, 130, 60], [150, 90, 0], [120, 40, 150], [0, 120, 140]];

/// Speed of the upper end of the colour scale, metres per second.
pub(in crate::show) const FASTEST_M_S: f64 = 2.0;
/// Colours from standing to [`FASTEST_M_S`], alike to people who see no red or no green (Smith and van der Walt 2015,
/// *viridis*).
const SPEEDS: [Srgb8; 6] = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81], [222, 205, 30]];

/// Upper-left pixel of the legend.
pub(in crate::show) fn legend(canvas: &PlanCanvas) -> [i64; 2] {
    [canvas.corner[0] as i64, (canvas.corner[1] + canvas.plan_px[1]) as i64 + 40]
}

pub(in crate::show) fn speed_colour(speed_m_s: f64) -> Srgb8 {
    let steps = (SPEEDS.len() - 1) as f64;
    let at = (speed_m_s / FASTEST_M_S * steps).max(0.0).min(steps);
    let low = (at as usize).min(SPEEDS.len() - 2);
    let (a, b) = (SPEEDS[low], SPEEDS[low + 1]);
    std::array::from_fn(|k| (f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * (at - low as f64)).round() as u8)
}

/// Width of the scale of speeds, pixels.
pub(in crate::show) const SPEED_SCALE_PX: i64 = 320;

/// A bar of a round number of metres, at most `longest_px` long, whose right end is at a pixel.
pub(in crate::show) fn scale_bar(canvas: &mut PlanCanvas, [right, top]: [i64; 2], longest_px: f64) {
    let per_metre = canvas.pixels_per_metre;
    let lengths = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
    let length_m = lengths.into_iter().rev().find(|m| m * per_metre <= longest_px).unwrap_or(lengths[0]);
    let width = (length_m * per_metre).round() as i64;
    let left = right - width;
    for (x, size) in [(left, [width, 2]), (left, [2, 10]), (left + width - 2, [2, 10])] {
        canvas.fill([x, top], size, TEXT);
    }
    let label = format!("{length_m} m");
    canvas.text([left + width - text_width(&label), top + 18], &label, TEXT, None);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colour_scale_has_its_ends() {
        assert_eq!(speed_colour(0.0), SPEEDS[0]);
        assert_eq!(speed_colour(FASTEST_M_S), SPEEDS[SPEEDS.len() - 1]);
        assert_eq!(speed_colour(99.0), SPEEDS[SPEEDS.len() - 1]);
        assert_eq!(speed_colour(f64::NAN), SPEEDS[0]);
    }
}
