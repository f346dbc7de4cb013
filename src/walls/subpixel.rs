//! Where within a pixel the drawn edge lies, from how much of the pixel it darkens.

use super::runs::{Direction, Sample};
use crate::plan::FloorPlan;
use crate::plan::cracks::CrackLoop;

/// How far a line may pass from the middle of a pixel edge where the image is black and white: any straight edge
/// is drawn the same as long as it stays within half a pixel. A hair less, or steps of two pixels pass for oblique.
const HARD_TOLERANCE: f64 = 0.4999;
/// The same where anti-aliasing tells the place.
const SOFT_TOLERANCE: f64 = 0.35;
/// And where it tells nothing, since the edge runs nearly along the profile.
const BLIND_TOLERANCE: f64 = 1.0;
/// Offsets below this are rounding of grey values.
const LEAST_OFFSET: f64 = 0.02;
/// A wall up to this many pixels thick is measured as a whole.
const THIN: usize = 3;

/// One sample for each pixel edge of a boundary.
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

/// Whether the boundary around a pixel edge runs so steeply against it that the profile across it is nearly
/// parallel to the drawn edge and tells nothing: a single step of an oblique line.
fn profile_runs_along(cracks: &CrackLoop, k: usize) -> bool {
    const AROUND: usize = 5;
    let n = cracks.len();
    let axis = |k: usize| usize::from(cracks[k % n][0] == cracks[(k + 1) % n][0]);
    let same = (0..=2 * AROUND).filter(|step| axis(k + n * AROUND - AROUND + step) == axis(k)).count();
    same * 3 < 2 * AROUND + 1
}

/// The floor pixel beside a pixel edge, and the step from it into the wall.
fn floor_and_normal([x, y]: [i32; 2], to: [i32; 2]) -> ([i32; 2], [i32; 2]) {
    match Direction::of([x, y], to) {
        Direction::East => ([x, y], [0, -1]),
        Direction::South => ([x - 1, y], [1, 0]),
        Direction::West => ([x - 1, y - 1], [0, 1]),
        Direction::North => ([x, y - 1], [-1, 0]),
    }
}

/// How dark pixels are, 0 to 1; beyond the image as the nearest pixel in it.
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

/// The pixels on a line across a pixel edge.
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

    /// How far into the wall the edge lies, pixels; negative into the floor.
    fn offset(&self) -> f64 {
        let beyond = [0, 1].map(|axis| self.floor[axis] + self.into_wall[axis]);
        let (floor, wall) = (self.at(0), self.at(1));
        // White beyond the edge is floor that nobody reaches: the boundary was cut, not drawn.
        if !self.darkness.is_within(beyond) || wall < 0.25 || (floor == 0.0 && wall == 1.0) {
            return 0.0;
        }
        let thickness = (1..=THIN as i32 + 1).take_while(|&k| self.at(k) > 0.5 * wall).count();
        if thickness <= THIN { self.thin(thickness as i32) } else { self.thick() }
    }

    /// A thick wall: what it lacks of black on its own side, less what it darkens on the floor's.
    fn thick(&self) -> f64 {
        let (w1, w2, w3) = (self.at(1), self.at(2), self.at(3));
        let mut lacks = 1.0 - w1;
        if w2 > w1 && w3 >= w2 {
            lacks += 1.0 - w2;
        }
        lacks - self.spill(0, -1)
    }

    /// A thin wall as a whole: its darkness is its width, and its centre of darkness its middle.
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

    /// Darkness that an edge spills over the two pixels from `k` on, as long as it falls.
    fn spill(&self, k: i32, step: i32) -> f64 {
        let (near, far) = (self.at(k), self.at(k + step));
        if far < near * 0.5 { near + far } else { near }
    }
}
