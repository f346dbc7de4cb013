use crate::motion::{Frame, Walker};

/// Times closer to each other than this are equal, seconds.
const SAME_S: f64 = 1e-6;
/// Speed above which a person was moved elsewhere, as in a periodic corridor, metres per second.
pub(crate) const FASTEST_M_S: f64 = 20.0;

/// Resamples a motion to evenly spaced frames from time 0.
///
/// Between two frames of the motion, people who are present in both move on a straight line.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    fps: f64,
    next: u64,
    before: Frame,
    now: Frame,
}

impl Resampler {
    pub(crate) fn new(fps: f64) -> Resampler {
        Resampler { fps, next: 0, before: Frame::default(), now: Frame::default() }
    }

    /// Takes the motion's next frame; call it when [`Resampler::next`] returns `None`. Returns the time since the frame
    /// before it, seconds.
    pub(crate) fn push(&mut self, frame: &Frame) -> f64 {
        std::mem::swap(&mut self.before, &mut self.now);
        self.now.time_s = frame.time_s;
        self.now.walkers.clone_from(&frame.walkers);
        self.now.time_s - self.before.time_s
    }

    /// The number and the walkers of the next resampled frame; `None` if it lies after the frames pushed so far.
    pub(crate) fn next(&mut self) -> Option<(u64, Vec<Walker>)> {
        let time_s = self.next as f64 / self.fps;
        if time_s > self.now.time_s + SAME_S {
            return None;
        }
        self.next += 1;
        let walkers = if time_s > self.now.time_s - SAME_S {
            self.now.walkers.clone()
        } else if time_s < self.before.time_s + SAME_S {
            self.before.walkers.clone()
        } else {
            self.between(time_s)
        };
        Some((self.next - 1, walkers))
    }

    /// Skips the empty frames before the next frame of the motion, except the last of them.
    ///
    /// A recording may pause for years.
    pub(crate) fn pass_over_absence(&mut self) {
        let mut after = self.now.walkers.iter().peekable();
        let stays = |walker: &Walker| {
            while after.next_if(|other| other.id < walker.id).is_some() {}
            after.peek().is_some_and(|other| other.id == walker.id)
        };
        if !self.before.walkers.iter().any(stays) && self.now.time_s > self.before.time_s {
            let last_before = (self.now.time_s * self.fps).floor() - 1.0;
            self.next = self.next.max(last_before as u64);
        }
    }

    /// Halves the frame rate; frames are renumbered.
    pub(crate) fn halve(&mut self) {
        self.fps *= 0.5;
        self.next = self.next.div_ceil(2);
    }

    fn between(&self, time_s: f64) -> Vec<Walker> {
        let step_s = self.now.time_s - self.before.time_s;
        let share = (time_s - self.before.time_s) / step_s;
        let mut after = self.now.walkers.iter().peekable();
        let mut present = Vec::with_capacity(self.before.walkers.len());
        for walker in &self.before.walkers {
            while after.next_if(|other| other.id < walker.id).is_some() {}
            let Some(later) = after.next_if(|other| other.id == walker.id) else { continue };
            present.push(between(walker, later, share, step_s));
        }
        present
    }
}

fn between(walker: &Walker, later: &Walker, share: f64, step_s: f64) -> Walker {
    if walker.position_m.distance(later.position_m) > FASTEST_M_S * step_s {
        return if share < 0.5 { *walker } else { *later };
    }
    let heading = match (walker.heading, later.heading) {
        // Opposite headings have no direction in between.
        (Some(a), Some(b)) => a.lerp(b, share).normalized().or(Some(b)),
        (a, b) => b.or(a),
    };
    Walker {
        id: walker.id,
        position_m: walker.position_m.lerp(later.position_m, share),
        velocity_m_s: walker.velocity_m_s.lerp(later.velocity_m_s, share),
        heading,
    }
}
