//! Keeps people clear of each other: whoever would come too near steps aside, early and smoothly, and comes back.

mod body;
mod encounters;
mod nearby;
mod relax;
mod settle;
mod smooth;

pub(super) use body::{Body, Person};

use super::request::AvoidRequest;
use crate::formation::FormationError;
use crate::progress::Progress;

/// Bodies' middles never come nearer to each other, where nothing else is said, metres: body depth, people turn.
pub const USUAL_DISTANCE_M: f64 = 0.36;
/// How strongly neighbours push each other where nothing else is said, see [`AvoidRequest::push`].
const USUAL_PUSH: f64 = 0.02;
/// How long before and after an encounter people step aside where nothing else is said, seconds.
const USUAL_SECONDS: f64 = 0.8;

/// How people keep clear of each other.
///
/// Everybody is held by a spring to where they would be without the others, the more firmly the nearer a key formation is
/// in time. Neighbours push each other with a force in inverse proportion to their distance (Kamphuis, Overmars 2004,
/// *Finding paths for coherent groups using clearance*), which ends at 2.5 times the distance at which bodies would
/// overlap. Offsets are weighed over the whole time together, so that accelerations are small:
///
/// ```text
/// minimise  sum over t of  s(t) |x|^2 / 2 - f(t) . x + a |x''|^2 / 2   where no two bodies overlap
/// ```
///
/// by the alternating direction method of multipliers (Boyd et al. 2011, doi 10.1561/2200000016): in turn everybody's best
/// way over time, and every moment's nearest places at which nobody overlaps. Where that finds no way, as in dense crowds
/// that go through each other, everybody is led on step by step without the spring, early and gently. Nobody is moved more
/// suddenly than people stagger: where there is no other way, they overlap, and a warning says where and when.
#[derive(Clone, Debug)]
pub(super) struct Avoidance {
    on: bool,
    push: f64,
    seconds: f64,
    fps: f64,
    /// Moments of key formations.
    keys: Vec<usize>,
}

impl Avoidance {
    /// With the settings of a crowd; `keys` are the moments of its key formations.
    pub fn new(request: &AvoidRequest, fps: f64, keys: &[usize]) -> Avoidance {
        Avoidance {
            on: request.on.unwrap_or(true),
            push: request.push.unwrap_or(USUAL_PUSH),
            seconds: request.seconds.unwrap_or(USUAL_SECONDS),
            fps,
            keys: keys.to_vec(),
        }
    }

    /// Moves bodies so that nobody overlaps at any moment.
    ///
    /// # Errors
    /// [`FormationError::Interrupted`].
    pub fn keep_clear(&self, bodies: &mut [Body], progress: &dyn Progress) -> Result<(), FormationError> {
        if !self.on || bodies.len() < 2 {
            return Ok(());
        }
        relax::relax(self, bodies, progress)
    }
}

#[cfg(test)]
mod tests;
