//! Leaves and arcs of doors whose gaps are known.

use super::gaps::Gap;
use crate::math::sin_cos;

/// Least share of an arc that is drawn.
const DRAWN: f64 = 0.7;
/// Radii of arcs, as shares of the gap's length: one leaf, or two.
const RADII: [f64; 9] = [1.0, 0.95, 1.05, 0.9, 1.1, 0.5, 0.47, 0.53, 0.85];
/// Places along an arc that are looked at.
const PLACES: usize = 24;

/// Lists the pixels of a door's leaves and arcs: quarter circles about an end of the gap, and the way to their far end.
pub(super) fn symbol(gap: &Gap, ink: &[u8], metres_per_pixel: f64) -> Vec<usize> {
    let ([from, to], middle) = gap.middle();
    let (length, thick) = (to - from, gap.thickness());
    let slack = (0.03 / metres_per_pixel).max(1.5);
    let at = |along: f64, across: f64| gap.pixel(along, across);
    let is_ink = |along: f64, across: f64| at(along, across).is_some_and(|at| ink[at] != 0);
    let mut found = Vec::new();
    for (hinge, way) in [(from, 1.0), (to, -1.0)] {
        for side in [-1.0, 1.0] {
            // The hinge may be at either face of the wall or between: what lies in the wall is not drawn.
            let tries = [0.5, 0.0, 0.25, -0.25, -0.5]
                .into_iter()
                .flat_map(|face| RADII.map(|share| (middle + side * thick * face, length * share)));
            let drawn = |&(across, radius): &(f64, f64)| {
                let (mut seen, mut inked) = (0usize, 0usize);
                for k in 0..PLACES {
                    let (sine, cosine) = sin_cos(std::f64::consts::FRAC_PI_2 * (k as f64 + 0.5) / PLACES as f64);
                    if side * (across - middle) + radius * sine < 0.5 * thick {
                        continue;
                    }
                    seen += 1;
                    inked += usize::from((-3..=3).any(|step| {
                        let r = radius + slack * f64::from(step) / 3.0;
                        is_ink(hinge + way * r * cosine, across + side * r * sine)
                    }));
                }
                if 2 * seen < PLACES { 0.0 } else { inked as f64 / seen as f64 }
            };
            let mut best = (0.0, (0.0, 0.0));
            for arc in tries {
                let share = drawn(&arc);
                if share > best.0 {
                    best = (share, arc);
                }
            }
            let (share, (across, radius)) = best;
            if share < DRAWN {
                continue;
            }
            // The ring, and the leaf that is swung open.
            let reach = radius + 2.0 * slack + 2.0;
            let (wide, leaf) = (slack + 1.5, (0.07 / metres_per_pixel).max(2.5));
            let steps = reach.ceil() as i32 + 3;
            // Half steps, so that slanted grids meet all pixels.
            for a in -6..=2 * steps {
                for b in -6..=2 * steps {
                    let (a, b) = (f64::from(a) * 0.5, f64::from(b) * 0.5);
                    let distance = (a * a + b * b).sqrt();
                    let on_ring = (distance - radius).abs() <= wide;
                    let on_leaf = a <= leaf && b <= reach;
                    if (on_ring || on_leaf)
                        && let Some(at) = at(hinge + way * a, across + side * b)
                        && ink[at] != 0
                    {
                        found.push(at);
                    }
                }
            }
        }
    }
    found
}
