//! Finds the drawn edge within a pixel from the pixel's darkness.

use super::runs::{Direction, Sample};
use crate::plan::FloorPlan;
use crate::plan::cracks::CrackLoop;

/// Tolerance of a line from the middle of a pixel edge in a black and white image: an edge within half a pixel is drawn
/// the same. Slightly less, or steps of two pixels would count as oblique.
const HARD_TOLERANCE: f64 = 0.4999;
/// Tolerance where anti-aliasing gives the position.
const SOFT_TOLERANCE: f64 = 0.35;
/// Tolerance where the profile is nearly parallel to the edge and gives no position.
const BLIND_TOLERANCE: f64 = 1.0;
/// Smaller offsets are rounding of grey values, pixels.
const LEAST_OFFSET: f64 = 0.02;
/// Thickest wall that is measured as a whole, pixels.
const THIN: usize = 3;

/// Returns one sample per pixel edge of a boundary.
pub(super) fn samples(plan: &FloorPlan, cracks: &CrackLoop, tolerance_scale: f64) -> Vec<Sample> {
    let darkness = Darkness::new(plan);
    (0..cracks.len())
        .map(|k| {
            let mut sample = sample(&darkness, cracks, k);
            sample.tolerance *= tolerance_scale;
            sample
        })
        .collect()
}

fn sample(darkness: &Darkness, cracks: &CrackLoop, k: usize) -> Sample {
    let [from, to] = [cracks[k], cracks[(k + 1) % cracks.len()]];
    let middle = [f64::from(from[0] + to[0]) * 0.5, f64::from(from[1] + to[1]) * 0.5];
    let (floor, into_wall) = floor_and_normal(from, to);
    let profile = Profile { darkness, floor, into_wall };
    let offset = profile.offset();
    if offset.abs() < LEAST_OFFSET {
        Sample { at: middle, tolerance: HARD_TOLERANCE, weight: 1.0 }
    } else if profile_runs_along(cracks, k) {
        Sample { at: middle, tolerance: BLIND_TOLERANCE, weight: 0.0 }
    } else {
        let offset = offset.clamp(-1.0, 1.0);
        let at = [0, 1].map(|axis| middle[axis] + offset * f64::from(into_wall[axis]));
        Sample { at, tolerance: SOFT_TOLERANCE, weight: 1.0 }
    }
}

/// Whether the profile across a pixel edge is nearly parallel to the drawn edge. It then gives no position: a single
/// step of an oblique line.
fn profile_runs_along(cracks: &CrackLoop, k: usize) -> bool {
    const AROUND: usize = 5;
    let n = cracks.len();
    let axis = |k: usize| usize::from(cracks[k % n][0] == cracks[(k + 1) % n][0]);
    let same = (0..=2 * AROUND).filter(|step| axis(k + n * AROUND - AROUND + step) == axis(k)).count();
    same * 3 < 2 * AROUND + 1
}

/// Returns the floor pixel beside a pixel edge, and the step from it into the wall.
fn floor_and_normal([x, y]: [i32; 2], to: [i32; 2]) -> ([i32; 2], [i32; 2]) {
    match Direction::of([x, y], to) {
        Direction::East => ([x, y], [0, -1]),
        Direction::South => ([x - 1, y], [1, 0]),
        Direction::West => ([x - 1, y - 1], [0, 1]),
        Direction::North => ([x, y - 1], [-1, 0]),
    }
}

/// Darkness of pixels, 0..=1; clamped to the nearest pixel outside the image.
struct Darkness<'a> {
    plan: &'a FloorPlan,
}

impl<'a> Darkness<'a> {
    fn new(plan: &'a FloorPlan) -> Darkness<'a> {
        Darkness { plan }
    }

    fn at(&self, [x, y]: [i32; 2]) -> f64 {
        let x = x.clamp(0, self.plan.width_px as i32 - 1) as usize;
        let y = y.clamp(0, self.plan.height_px as i32 - 1) as usize;
        1.0 - f64::from(self.plan.lightness[y * self.plan.width_px as usize + x]) / 255.0
    }

    fn is_within(&self, [x, y]: [i32; 2]) -> bool {
        x >= 0 && y >= 0 && x < self.plan.width_px as i32 && y < self.plan.height_px as i32
    }
}

/// Darkness profile across a pixel edge.
struct Profile<'a> {
    darkness: &'a Darkness<'a>,
    floor: [i32; 2],
    into_wall: [i32; 2],
}

impl Profile<'_> {
    /// Darkness of the pixel `k` steps from the floor pixel into the wall.
    fn at(&self, k: i32) -> f64 {
        self.darkness.at([0, 1].map(|axis| self.floor[axis] + k * self.into_wall[axis]))
    }

    /// Offset of the drawn edge into the wall, pixels; negative into the floor.
    fn offset(&self) -> f64 {
        let beyond = [0, 1].map(|axis| self.floor[axis] + self.into_wall[axis]);
        let (floor, wall) = (self.at(0), self.at(1));
        // White beyond the edge is unreachable floor: this boundary was cut, not drawn.
        if !self.darkness.is_within(beyond) || wall < 0.25 || (floor == 0.0 && wall == 1.0) {
            return 0.0;
        }
        let thickness = (1..=THIN as i32 + 1).take_while(|&k| self.at(k) > 0.5 * wall).count();
        if thickness <= THIN { self.thin(thickness as i32) } else { self.thick() }
    }

    /// Offset for a thick wall: missing darkness on its side minus darkness spilt on the floor's.
    fn thick(&self) -> f64 {
        let (w1, w2, w3) = (self.at(1), self.at(2), self.at(3));
        let mut lacks = 1.0 - w1;
        if w2 > w1 && w3 >= w2 {
            lacks += 1.0 - w2;
        }
        lacks - self.spill(0, -1)
    }

    /// Offset for a thin wall: its total darkness is the width, its centre of darkness the middle.
    fn thin(&self, thickness: i32) -> f64 {
        let mut sum = 0.0;
        let mut moment = 0.0;
        let mut count = |k: i32, darkness: f64| {
            sum += darkness;
            moment += darkness * (f64::from(k) - 0.5);
        };
        (1..=thickness).for_each(|k| count(k, self.at(k)));
        for (first, step) in [(0, -1), (thickness + 1, 1)] {
            let (near, far) = (self.at(first), self.at(first + step));
            count(first, near);
            if far < near * 0.5 {
                count(first + step, far);
            }
        }
        moment / sum - sum * 0.5
    }

    /// Darkness spilt over the two pixels from `k` on, as long as it falls.
    fn spill(&self, k: i32, step: i32) -> f64 {
        let (near, far) = (self.at(k), self.at(k + step));
        if far < near * 0.5 { near + far } else { near }
    }
}
