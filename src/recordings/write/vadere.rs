use super::place::RecordedPlace;
use super::text::{FrameClock, LineBuffer, LineFormat};
use crate::motion::FASTEST_M_S;

/// Columns for Vadere's post-visualisation, with the numbers of the processors that write them.
const HEAD: &str = "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1\n";

/// Writer of Vadere steps: each line leads a person from one frame to the next.
///
/// A person present in a single frame gets a step of half a frame: Vadere needs steps with a duration.
pub(super) struct StepFormat {
    fps: f64,
    /// Clock that counts half frames.
    clock: FrameClock,
    number: u64,
    /// Persons in the last frame, and whether a step led to it.
    before: Vec<(RecordedPlace, bool)>,
}

impl StepFormat {
    pub fn new(fps: f64) -> StepFormat {
        StepFormat { fps, clock: FrameClock::new(2.0 * fps), number: 0, before: Vec::new() }
    }

    fn step(&self, from: &RecordedPlace, to: &RecordedPlace, half_frames: u64, lines: &mut LineBuffer) {
        lines.whole(from.id).text(" ").seconds(self.clock, 2 * self.number);
        lines.text(" ").seconds(self.clock, 2 * self.number + half_frames);
        for value in [from.at.x, from.at.y, to.at.x, to.at.y] {
            lines.text(" ").metres(value);
        }
        lines.text("\n");
    }
}

impl LineFormat for StepFormat {
    fn head(&self) -> String {
        HEAD.to_owned()
    }

    fn frame(&mut self, number: u64, places: &[RecordedPlace], lines: &mut LineBuffer) {
        // Both are in ascending order of ids.
        let mut after = places.iter().peekable();
        let mut arrived = Vec::new();
        let before = std::mem::take(&mut self.before);
        for (from, stepped) in &before {
            while after.next_if(|place| place.id < from.id).is_some() {}
            // A person farther away was teleported, as in a periodic corridor.
            let near = |to: &&RecordedPlace| from.at.distance(to.at) * self.fps <= FASTEST_M_S;
            match after.next_if(|place| place.id == from.id).filter(near) {
                Some(to) => {
                    self.step(from, to, 2, lines);
                    arrived.push(to.id);
                }
                None if !stepped => self.step(from, from, 1, lines),
                None => {}
            }
        }
        self.number = number;
        self.before.extend(places.iter().map(|place| (*place, arrived.binary_search(&place.id).is_ok())));
    }

    fn rest(&mut self, lines: &mut LineBuffer) {
        for (place, stepped) in &self.before {
            if !stepped {
                self.step(place, place, 1, lines);
            }
        }
    }
}
