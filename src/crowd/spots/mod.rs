//! Spots at which units are played: near them, people of the crowd play [units](crate::units), as the paper of
//! Matsumoto, Mori and Toyama describes (*Example-based Composition of Crowd Movement in VR*).
//!
//! While the crowd walks, the people in the areas before and behind the viewer are counted. A unit of as many people in the
//! same groups is placed so that its viewer stands where the viewer does; people move over to its beginning, play it, and
//! walk on by the crowd's model. The crowd's other people see them and make way. People who play are not counted: those who
//! come meanwhile may begin another unit, if all keep clear of each other.

mod clearance;
mod path;
mod playback;
mod report;
mod request;
mod spot;

pub use report::{MeanAndMax, SpotReport};
pub use request::SpotRequest;

use super::agents::{AgentSnapshot, Agents};
use super::environment::Environment;
use super::{CrowdError, CrowdOptions};
use crate::motion::Frame;
use crate::walls::Walls;
use playback::StepTime;
use spot::{Spot, SpotInput};

/// All spots, and the people around them.
#[derive(Default)]
pub(super) struct Spots {
    spots: Vec<Spot>,
    /// Everybody present, by ascending id.
    people: Vec<AgentSnapshot>,
    /// The same a step ago.
    before: Vec<AgentSnapshot>,
}

impl Spots {
    /// Finds the spots on the floor.
    ///
    /// # Errors
    /// A spot in a wall or off the floor; units that cannot be read.
    pub(super) fn new(environment: &Environment<'_>, requests: &[SpotRequest]) -> Result<Spots, CrowdError> {
        let spot = |(index, request)| Spot::new(index, request, environment);
        let spots = requests.iter().enumerate().map(spot).collect::<Result<Vec<_>, _>>()?;
        Ok(Spots { spots, ..Spots::default() })
    }

    pub(super) fn is_empty(&self) -> bool {
        self.spots.is_empty()
    }

    /// Puts a viewer on each spot whose viewer has a body.
    pub(super) fn stand_viewers(&self, agents: &mut Agents, seed: u64, options: &CrowdOptions) {
        for spot in self.spots.iter().filter(|spot| spot.radius_m > 0.0) {
            agents.stand(spot.frame.at_m, spot.radius_m.max(0.05), seed, options);
        }
    }

    /// Reports of the units played so far, spot by spot.
    pub(super) fn reports(&self) -> Vec<SpotReport> {
        self.spots.iter().map(Spot::report).collect()
    }

    fn note_people(&mut self, agents: &Agents) {
        self.people.clear();
        self.people.extend(agents.snapshots());
        self.people.sort_unstable_by_key(|agent| agent.id);
    }

    /// Leads those who play through the next step, and begins units for which there are people.
    pub(super) fn play(&mut self, frame: &Frame, step_s: f64, agents: &mut Agents, walls: &Walls) {
        if self.is_empty() {
            return;
        }
        std::mem::swap(&mut self.people, &mut self.before);
        self.note_people(agents);
        let now = StepTime { time_s: frame.time_s, step_s };
        for spot in &mut self.spots {
            spot.diversity.push(frame);
            spot.go_on(now, agents, &self.people);
        }
        for index in 0..self.spots.len() {
            // People who began a unit at one spot are not free for the next.
            if index > 0 {
                self.note_people(agents);
            }
            let input = SpotInput { people: &self.people, before: &self.before, step_s, walls };
            self.spots[index].look(now, agents, &input);
        }
    }
}
