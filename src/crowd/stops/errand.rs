use crate::math::{Vec2, vec2};

/// From this distance on somebody who walks up to a spot turns as they will stand, metres.
const TURNING_M: f32 = 0.6;

/// What somebody does who is at a stop or on the way to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::crowd) struct Errand {
    post: u32,
    mode: Mode,
    squeezes: bool,
    spot: [f32; 2],
    facing: [f32; 2],
}

/// How to walk an errand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// To the stop, however far it is.
    Come,
    /// To a place in sight, without stopping there.
    Pass,
    /// To a spot, to stand there.
    Stand,
}

impl Errand {
    /// Goes to a stop.
    pub(super) fn come(post: usize) -> Errand {
        Errand { post: post as u32, mode: Mode::Come, squeezes: true, spot: [0.0; 2], facing: [1.0, 0.0] }
    }

    /// Goes on to a place near a stop.
    pub(super) fn towards(post: usize, to_m: Vec2) -> Errand {
        Errand { mode: Mode::Pass, squeezes: false, spot: singles(to_m), ..Errand::come(post) }
    }

    /// Leaves a stop by way of a place beside it.
    pub(super) fn pass(post: usize, to_m: Vec2) -> Errand {
        Errand { squeezes: true, ..Errand::towards(post, to_m) }
    }

    /// Stands at a spot and faces along the unit vector `facing`. Whoever `squeezes` slips through between others who
    /// stand in the way.
    pub(super) fn stand(post: usize, spot_m: Vec2, facing: Vec2, squeezes: bool) -> Errand {
        Errand { post: post as u32, mode: Mode::Stand, squeezes, spot: singles(spot_m), facing: singles(facing) }
    }

    pub(super) fn post(&self) -> usize {
        self.post as usize
    }

    pub(super) fn mode(&self) -> Mode {
        self.mode
    }

    pub(super) fn squeezes(&self) -> bool {
        self.squeezes
    }

    /// Where to stand or to pass; nowhere for whoever only comes.
    pub(super) fn spot_m(&self) -> Vec2 {
        vec2(f64::from(self.spot[0]), f64::from(self.spot[1]))
    }

    pub(super) fn facing(&self) -> [f32; 2] {
        self.facing
    }

    /// Where somebody at `x`, `y` faces who stands or shuffles, if it is not where they go.
    pub(in crate::crowd) fn faces(&self, x: f32, y: f32) -> Option<[f32; 2]> {
        let (dx, dy) = (self.spot[0] - x, self.spot[1] - y);
        (self.mode == Mode::Stand && dx * dx + dy * dy < TURNING_M * TURNING_M).then_some(self.facing)
    }
}

fn singles(v: Vec2) -> [f32; 2] {
    [v.x as f32, v.y as f32]
}
