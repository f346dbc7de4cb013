use super::error::MotionError;
use crate::math::Vec2;

/// A person in a frame: position, velocity and heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walker {
    /// The person's number in the arrival list.
    pub id: u32,
    /// Centre of the body, plan frame, metres; may lie beyond the plan's edge.
    pub position_m: Vec2,
    /// Velocity, metres per second.
    pub velocity_m_s: Vec2,
    /// Unit vector in which the body faces, if the source knows it; a standing person has no velocity to derive it from.
    pub heading: Option<Vec2>,
}

/// All people present at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Seconds since the start.
    pub time_s: f64,
    /// The people present, by ascending id.
    pub walkers: Vec<Walker>,
}

/// A stream of frames in ascending time.
pub trait Motion {
    /// Fills `frame` with the next frame; returns `false` at the end.
    ///
    /// A person who is missing from a frame has left for good.
    ///
    /// # Errors
    /// [`MotionError::Source`] from the source of the motion: a recording that cannot be read, a crowd that cannot walk.
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError>;

    /// Share of the motion that has been read, 0 to 1; an estimate if the source does not know its length.
    fn share_done(&self) -> f64;
}
