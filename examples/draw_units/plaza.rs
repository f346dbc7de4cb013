use std::path::Path;

use trodden::crowd::{Simulation, SpotRequest};
use trodden::motion::People;
use trodden::plan::{self, FloorPlan};
use trodden::routes::{Navigation, Route};
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::Walls;

/// The sample plaza.
pub struct Plaza {
    pub plan: FloorPlan,
    scenario: Scenario,
    walls: Walls,
    routes: Vec<Route>,
    navigation: Navigation,
}

impl Plaza {
    /// The plaza with the crowd of a seed.
    pub fn open(seed: u64) -> Result<Plaza, trodden::Error> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/plaza.toml");
        let scenario = Scenario::open(&path, &Overrides { seed: Some(seed), ..Overrides::default() })?;
        let plan = plan::read(&scenario.image_path().unwrap_or_default(), &scenario.plan_options())?;
        let walls = Walls::trace(&plan, &scenario.walls);
        let (routes, navigation) = Navigation::find(&plan, &walls, &scenario.routes)?;
        Ok(Plaza { plan, scenario, walls, routes, navigation })
    }

    /// Its spots, at which units are played or not.
    pub fn spots(&self, play: bool) -> Vec<SpotRequest> {
        self.scenario.spots().into_iter().map(|spot| SpotRequest { play, ..spot }).collect()
    }

    /// Its crowd, at the start.
    pub fn crowd(&self, play: bool) -> Result<Simulation<'_>, trodden::Error> {
        let people = People::new(self.scenario.seed, self.scenario.bodies.clone());
        let (navigation, options) = (self.navigation.clone(), &self.scenario.crowd);
        let spots = self.spots(play);
        Ok(Simulation::with_spots(&self.plan, &self.walls, &self.routes, navigation, &people, options, &spots)?)
    }
}
