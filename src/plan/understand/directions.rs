//! The directions in which walls run.

use std::f64::consts::FRAC_PI_2;

use super::super::cracks::CrackLoop;
use crate::math::atan2;

const BINS: usize = 45;
/// Directions nearer than this to upright ones or to each other are the same, bins.
const SAME: usize = 2;
const STEP: usize = 4;
/// Greatest thickness of the shadow of a scanner's lid, as a share of the image's longer side.
pub(super) const SHADOW_SHARE: f64 = 0.03;

/// Chords of the straight parts of outlines: their middle, angle to the next grid line clockwise, radians below a right
/// angle, and length, pixels. One starts every few pixels; `chord` is how many pixels of the outline it spans.
fn chords(outlines: &[CrackLoop], chord: usize) -> impl Iterator<Item = ([f64; 2], f64, f64)> {
    outlines.iter().filter(move |outline| outline.len() >= 2 * chord).flat_map(move |outline| {
        let n = outline.len();
        let at = move |k: usize| {
            // The mean of some edges is smoother than their ends.
            let sum = (0..4).map(|j| outline[(k + j) % n]).fold([0, 0], |s, p| [s[0] + p[0], s[1] + p[1]]);
            sum.map(|v| f64::from(v) * 0.25)
        };
        (0..n).step_by(STEP).filter_map(move |k| {
            let [a, m, b] = [k, k + chord / 2, k + chord].map(at);
            let ([dx, dy], [mx, my]) = ([b[0] - a[0], b[1] - a[1]], [m[0] - a[0], m[1] - a[1]]);
            let length = (dx * dx + dy * dy).sqrt();
            if length < chord as f64 * 0.5 || (dx * my - dy * mx).abs() > 0.7 * length {
                return None;
            }
            let angle = atan2(dy, dx);
            Some((m, angle - (angle / FRAC_PI_2).floor() * FRAC_PI_2, length))
        })
    })
}

/// The directions of slanted walls, radians between 0 and a right angle: those of the long straight parts of the wall's
/// outline. Walls at right angles to them are of the same direction. `shortest` gap and `thinnest` wall are in pixels.
pub(super) fn slanted(outlines: &[CrackLoop], shortest: usize, thinnest: usize) -> Vec<f64> {
    const MOST: usize = 5;
    const LEAST_SHARE: f64 = 0.01;
    let chord = (2 * thinnest).max(12) & !1;
    let (mut lengths, mut sums) = ([0.0f64; BINS], [0.0f64; BINS]);
    for (_, angle, length) in chords(outlines, chord) {
        let bin = ((angle / FRAC_PI_2 * BINS as f64) as usize).min(BINS - 1);
        let passed = STEP as f64 * length / chord as f64;
        lengths[bin] += passed;
        sums[bin] += passed * angle;
    }
    let least = (3 * shortest) as f64;
    let least = least.max(LEAST_SHARE * lengths.iter().sum::<f64>());
    let around = |k: usize| lengths[k - 1] + lengths[k] + lengths[k + 1];
    let mut bins: Vec<usize> = (SAME..BINS - SAME).filter(|&k| around(k) > 0.0 && around(k) >= least).collect();
    bins.sort_by(|&a, &b| around(b).total_cmp(&around(a)).then(a.cmp(&b)));
    let mut found: Vec<usize> = Vec::new();
    for bin in bins {
        if found.len() < MOST && found.iter().all(|&other| bin.abs_diff(other) > SAME) {
            found.push(bin);
        }
    }
    found.into_iter().map(|k| (sums[k - 1] + sums[k] + sums[k + 1]) / around(k)).collect()
}

/// Whether two directions are nearer to each other than [`slanted`] tells apart.
pub(super) fn is_same(a: f64, b: f64) -> bool {
    let apart = (a - b).abs() % FRAC_PI_2;
    apart.min(FRAC_PI_2 - apart) <= (SAME as f64 + 0.5) / BINS as f64 * FRAC_PI_2
}

/// By how much a scan lies askew, radians, if nearly all walls that run about along the image's sides are off them by the
/// same angle. What lies at the sides of the `image` is the shadow of a scanner's lid.
pub(super) fn skew(outlines: &[CrackLoop], image: [usize; 2]) -> Option<f64> {
    /// Pixels of an outline that a chord spans: the shortest over which the least angle shows.
    const CHORD: usize = 64;
    /// Least and greatest skew, and how far from it most walls are at most, radians.
    const LEAST: f64 = 0.01;
    const MOST: f64 = 0.06;
    const SPREAD: f64 = 0.012;
    /// Share of the chords that may be farther off on each side, and fewest chords.
    const OFF: f64 = 0.2;
    const FEWEST: usize = 40;
    let rim = SHADOW_SHARE * image[0].max(image[1]) as f64;
    let is_at_side = |at: [f64; 2]| (0..2).any(|axis| at[axis] < rim || at[axis] > image[axis] as f64 - rim);
    let inner = chords(outlines, CHORD).filter(|(middle, ..)| !is_at_side(*middle));
    let angles = inner.map(|(_, angle, _)| if angle > 0.5 * FRAC_PI_2 { angle - FRAC_PI_2 } else { angle });
    let mut near: Vec<f64> = angles.filter(|angle| angle.abs() <= MOST).collect();
    if near.len() < FEWEST {
        return None;
    }
    near.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| near[((near.len() - 1) as f64 * share) as usize];
    let skew = at(0.5);
    let is_of_all = at(1.0 - OFF) - skew <= SPREAD && skew - at(OFF) <= SPREAD;
    (skew.abs() >= LEAST && is_of_all).then_some(skew)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sin_cos;

    /// The outline of a square that is turned.
    fn square(angle: f64) -> CrackLoop {
        let (sine, cosine) = sin_cos(angle);
        let side = |k: usize| match k / 300 {
            0 => [k as f64, 0.0],
            1 => [300.0, (k - 300) as f64],
            2 => [(900 - k) as f64, 300.0],
            _ => [0.0, (1200 - k) as f64],
        };
        let turned = |[x, y]: [f64; 2]| [400.0 + x * cosine - y * sine, 400.0 + x * sine + y * cosine];
        (0..1200).map(|k| turned(side(k)).map(|v| v as i32)).collect()
    }

    #[test]
    fn nothing_has_no_direction() {
        assert_eq!(slanted(&[], 0, 2), Vec::<f64>::new());
    }

    #[test]
    fn a_scan_that_lies_askew_is_told_from_an_upright_plan() {
        for degrees in [-2.5, -0.9, 0.9, 1.7] {
            let angle = f64::to_radians(degrees);
            let found = skew(&[square(angle)], [900, 900]).unwrap();
            assert!((found - angle).abs() < 0.004, "{degrees} degrees were read as {}", found.to_degrees());
        }
        assert_eq!(skew(&[square(0.0)], [900, 900]), None);
        // Half of the walls are upright.
        assert_eq!(skew(&[square(0.03), square(0.0)], [900, 900]), None);
    }
}
