//! Spots that are looked at closely: near them, people of the crowd play [units](crate::units), as the paper of
//! Matsumoto, Mori and Toyama describes (*Example-based Composition of Crowd Movement in VR*).
//!
//! While the crowd walks, the people in the areas before and behind the viewer are counted. A unit of as many people in the
//! same groups is placed so that its viewer stands where the viewer does; people move over to its beginning, play it, and
//! walk on by the crowd's model. The crowd's other people see them and make way. Whoever plays is not counted: those who
//! come meanwhile may begin another unit, if all keep clear of each other.

mod play;
mod report;
mod request;
mod room;
mod spot;
mod way;

pub use report::{SpotReport, Spread};
pub use request::SpotRequest;

use super::{Arrival, CrowdError, CrowdOptions, Present, Simulation, SocialCrowd, Stuck, Tally};
use crate::motion::{Frame, Motion, MotionError, People};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::Walls;
use spot::{Now, Spot, There};

/// A crowd under social forces with spots at which units are played.
pub struct Spots<'a> {
    crowd: SocialCrowd<'a>,
    walls: &'a Walls,
    spots: Vec<Spot>,
    /// The crowd's time step, seconds.
    step_s: f64,
    /// Everybody present, by ascending id.
    people: Vec<Present>,
    /// The same a step ago.
    before: Vec<Present>,
}

impl<'a> Spots<'a> {
    /// A crowd that has not entered yet, with a viewer on each spot.
    ///
    /// # Errors
    /// As [`SocialCrowd::with_navigation`]; a spot in a wall or off the floor; units that cannot be read.
    pub fn new(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        navigation: Navigation,
        people: &People,
        options: &CrowdOptions,
        requests: &[SpotRequest],
    ) -> Result<Spots<'a>, CrowdError> {
        let mut spots = Vec::with_capacity(requests.len());
        for (index, request) in requests.iter().enumerate() {
            spots.push(Spot::new(index, request, (plan, walls, &navigation.ground))?);
        }
        let mut crowd = SocialCrowd::with_navigation(plan, walls, routes, navigation, people, options)?;
        for spot in spots.iter().filter(|spot| spot.radius_m > 0.0) {
            crowd.stand(spot.frame.at_m, spot.radius_m.max(0.05));
        }
        Ok(Spots { crowd, walls, spots, step_s: options.time_step, people: Vec::new(), before: Vec::new() })
    }

    /// How units were played so far, spot by spot.
    pub fn reports(&self) -> Vec<SpotReport> {
        self.spots.iter().map(Spot::report).collect()
    }

    /// The crowd that walks around the spots.
    pub fn crowd(&self) -> &SocialCrowd<'a> {
        &self.crowd
    }

    fn note_people(&mut self) {
        self.people.clear();
        self.people.extend(self.crowd.everybody());
        self.people.sort_unstable_by_key(|present| present.id);
    }

    /// Says for the next step where everybody goes who plays, and looks for units that can be begun.
    fn play(&mut self, frame: &Frame) {
        std::mem::swap(&mut self.people, &mut self.before);
        self.note_people();
        let now = Now { time_s: frame.time_s, step_s: self.step_s };
        for spot in &mut self.spots {
            spot.diversity.push(frame);
            spot.go_on(now, &mut self.crowd, &self.people);
        }
        for index in 0..self.spots.len() {
            // Whoever began a unit at one spot is not free for the next.
            if index > 0 {
                self.note_people();
            }
            let there = There { people: &self.people, before: &self.before, step_s: self.step_s, walls: self.walls };
            self.spots[index].look(now, &mut self.crowd, &there);
        }
    }
}

impl Motion for Spots<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        if !self.crowd.next_frame(frame)? {
            return Ok(false);
        }
        self.play(frame);
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        self.crowd.share_done()
    }
}

impl Simulation for Spots<'_> {
    fn arrivals(&self) -> &[Arrival] {
        self.crowd.arrivals()
    }

    fn tally(&self) -> Tally {
        Tally { spots: self.reports(), ..self.crowd.tally() }
    }

    fn stuck(&self) -> &[Stuck] {
        self.crowd.stuck()
    }
}
