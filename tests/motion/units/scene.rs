use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

use trodden::crowd::{AgentSnapshot, CrowdError, CrowdOptions, Simulation, SpotReport, SpotRequest};
use trodden::math::Vec2;
use trodden::motion::{Frame, Motion, People};
use trodden::plan::{self, FloorPlan};
use trodden::routes::{Navigation, Route};
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::Walls;

/// The sample scenario on its plan.
pub struct Scene {
    pub scenario: Scenario,
    pub plan: FloorPlan,
    pub walls: Walls,
    routes: Vec<Route>,
    navigation: Navigation,
}

/// Somebody at one moment of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    pub id: u32,
    pub place_m: Vec2,
    pub velocity_m_s: Vec2,
    pub heading: Vec2,
    pub radius_m: f64,
    pub led: bool,
    /// The first of the person's group.
    pub group: u32,
}

/// Everybody at every moment, and the spot's report.
pub type Run = (Vec<Vec<Seen>>, SpotReport);

impl Scene {
    pub fn plaza() -> &'static Scene {
        static SCENE: OnceLock<Scene> = OnceLock::new();
        SCENE.get_or_init(Scene::open)
    }

    fn open() -> Scene {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/plaza.toml");
        let scenario = Scenario::open(&path, &Overrides::default()).unwrap();
        let plan = plan::read(&scenario.image_path().unwrap(), &scenario.plan_options()).unwrap();
        let walls = Walls::trace(&plan, &scenario.walls);
        let (routes, navigation) = Navigation::find(&plan, &walls, &scenario.routes).unwrap();
        Scene { scenario, plan, walls, routes, navigation }
    }

    /// The sample's only spot.
    pub fn spot(&self) -> SpotRequest {
        self.scenario.spots()[0].clone()
    }

    pub fn begin(&self, spot: SpotRequest) -> Result<Simulation<'_>, CrowdError> {
        self.begin_with(spot, self.scenario.seed, self.scenario.crowd.people)
    }

    fn begin_with(&self, spot: SpotRequest, seed: u64, people: u32) -> Result<Simulation<'_>, CrowdError> {
        let navigation = self.navigation.clone();
        let options = CrowdOptions { people, ..self.scenario.crowd.clone() };
        let people = People::new(seed, self.scenario.bodies.clone());
        Simulation::with_spots(&self.plan, &self.walls, &self.routes, navigation, &people, &options, &[spot])
    }

    /// Lets the crowd walk for so many seconds: everybody at every moment, and the report.
    pub fn run(&self, spot: SpotRequest, seconds: f64) -> Run {
        self.run_with(spot, seconds, self.scenario.seed)
    }

    /// The same with another crowd.
    pub fn run_with(&self, spot: SpotRequest, seconds: f64, seed: u64) -> Run {
        self.run_many(spot, seconds, seed, self.scenario.crowd.people)
    }

    /// The same with more or fewer people.
    pub fn run_many(&self, spot: SpotRequest, seconds: f64, seed: u64, people: u32) -> Run {
        let mut crowd = self.begin_with(spot, seed, people).unwrap();
        let (mut frame, mut moments) = (Frame::default(), Vec::new());
        while frame.time_s < seconds && crowd.next_frame(&mut frame).unwrap() {
            let known: BTreeMap<u32, AgentSnapshot> = crowd.agents().map(|agent| (agent.id, agent)).collect();
            let seen = frame.walkers.iter().map(|walker| Seen {
                id: walker.id,
                place_m: walker.position_m,
                velocity_m_s: walker.velocity_m_s,
                heading: walker.heading.unwrap(),
                radius_m: known[&walker.id].radius_m,
                led: known[&walker.id].led,
                group: crowd.group_of(walker.id).start,
            });
            moments.push(seen.collect());
        }
        let report = crowd.tally().spots.remove(0);
        (moments, report)
    }
}
