use crate::math::{Vec2, vec2};

/// Distance from the spot at which an agent turns as it will stand, metres.
const TURNING_M: f32 = 0.6;

/// Where an agent stands or walks that is at a stop, or on the way to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::crowd) struct VisitTarget {
    stop: u32,
    pub(super) mode: ApproachMode,
    /// Whether the agent slips through between others who stand in the way.
    pub(super) squeezes: bool,
    spot: [f32; 2],
    /// Unit vector that the agent faces there.
    pub(super) facing: [f32; 2],
}

/// How an agent approaches its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ApproachMode {
    /// To the stop, along the walking distance.
    Come,
    /// To a place in sight, without standing there.
    Pass,
    /// To a spot, to stand there.
    Stand,
}

impl VisitTarget {
    /// A target at a stop that the agent does not see yet.
    pub(super) fn come(stop: usize) -> VisitTarget {
        VisitTarget { stop: stop as u32, mode: ApproachMode::Come, squeezes: true, spot: [0.0; 2], facing: [1.0, 0.0] }
    }

    /// A place near a stop on the way to it.
    pub(super) fn towards(stop: usize, to_m: Vec2) -> VisitTarget {
        VisitTarget { mode: ApproachMode::Pass, squeezes: false, spot: singles(to_m), ..VisitTarget::come(stop) }
    }

    /// A place beside a stop on the way out.
    pub(super) fn pass(stop: usize, to_m: Vec2) -> VisitTarget {
        VisitTarget { squeezes: true, ..VisitTarget::towards(stop, to_m) }
    }

    /// A spot to stand at, facing along the unit vector `facing`. An agent that `squeezes` slips through between others
    /// who stand in the way.
    pub(super) fn stand(stop: usize, spot_m: Vec2, facing: Vec2, squeezes: bool) -> VisitTarget {
        VisitTarget {
            stop: stop as u32,
            mode: ApproachMode::Stand,
            squeezes,
            spot: singles(spot_m),
            facing: singles(facing),
        }
    }

    pub(super) fn stop(&self) -> usize {
        self.stop as usize
    }

    /// Where to stand or to pass, metres; without meaning under [`ApproachMode::Come`].
    pub(super) fn spot_m(&self) -> Vec2 {
        vec2(f64::from(self.spot[0]), f64::from(self.spot[1]))
    }

    /// Direction that an agent at `x`, `y` faces as it stands or shuffles; `None` if it faces where it goes.
    pub(in crate::crowd) fn faces(&self, x: f32, y: f32) -> Option<[f32; 2]> {
        let (dx, dy) = (self.spot[0] - x, self.spot[1] - y);
        (self.mode == ApproachMode::Stand && dx * dx + dy * dy < TURNING_M * TURNING_M).then_some(self.facing)
    }
}

fn singles(v: Vec2) -> [f32; 2] {
    [v.x as f32, v.y as f32]
}
