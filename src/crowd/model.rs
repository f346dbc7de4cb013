use super::{Arrival, Crowd, CrowdError, CrowdModel, CrowdOptions, SocialCrowd, SpotRequest, Spots, Stuck, Tally};
use crate::motion::{Motion, People};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::Walls;

/// A crowd that is walked step by step, whatever model moves it.
pub trait Simulation: Motion + Send {
    /// Who comes when and on which route, in the order of ids.
    fn arrivals(&self) -> &[Arrival];

    /// What became of everybody so far.
    fn tally(&self) -> Tally;

    /// Who has got stuck so far.
    fn stuck(&self) -> &[Stuck];
}

impl Simulation for Crowd<'_> {
    fn arrivals(&self) -> &[Arrival] {
        Crowd::arrivals(self)
    }

    fn tally(&self) -> Tally {
        Crowd::tally(self)
    }

    fn stuck(&self) -> &[Stuck] {
        Crowd::stuck(self)
    }
}

/// A crowd under the model that its options name. With spots at which units are played, it is one under social forces.
///
/// # Errors
/// As [`Crowd::with_navigation`]; spots where nobody can stand, units that cannot be read.
pub fn simulate<'a>(
    plan: &'a FloorPlan,
    walls: &'a Walls,
    routes: &'a [Route],
    navigation: Navigation,
    people: &People,
    options: &CrowdOptions,
    spots: &[SpotRequest],
) -> Result<Box<dyn Simulation + 'a>, CrowdError> {
    if !spots.is_empty() {
        return Ok(Box::new(Spots::new(plan, walls, routes, navigation, people, options, spots)?));
    }
    Ok(match options.model {
        CrowdModel::Boids => Box::new(Crowd::with_navigation(plan, walls, routes, navigation, people, options)?),
        CrowdModel::SocialForce => {
            Box::new(SocialCrowd::with_navigation(plan, walls, routes, navigation, people, options)?)
        }
    })
}
