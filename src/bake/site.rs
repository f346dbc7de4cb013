use std::ops::Range;
use std::sync::Arc;

use super::graded::Sums;
use super::tread::{Day, Marks, Walked, tread};
use crate::Error;
use crate::crowd::{CrowdError, Simulation};
use crate::export::{Atlas, Estimate, LifeReport, OutputFolder, PADDING_PX};
use crate::marks::{ContactPlaces, Footfalls};
use crate::motion::People;
use crate::patterns::PatternLibrary;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::rooms::Life;
use crate::routes::{Navigation, Route};
use crate::scenario::Scenario;
use crate::show::PathSampler;
use crate::source::{Given, Ground, Source};
use crate::stamps::{Stamper, TexelGrid, WallGrid, WallStamper};
use crate::sums::{FloorSums, WallSums};

/// What all days of a scenario share: plan, walls, routes, doors, patterns.
pub(super) struct Site {
    /// The scenario with the habits of the building's use.
    pub scenario: Scenario,
    /// A motion that replaces the simulation.
    given: Option<Given>,
    pub ground: Ground,
    grid: TexelGrid,
    wall_grid: WallGrid,
    /// `None` for a bake of the floor only.
    pub atlas: Option<Atlas>,
    library: PatternLibrary,
    pub routes: Vec<Route>,
    ways: Option<Navigation>,
    life: Option<Arc<Life>>,
    pub places: ContactPlaces,
    /// Number of days that the scenario walks.
    pub days: u32,
}

/// What some days have left on a site.
pub(super) struct Trodden {
    pub sums: Sums,
    pub walked: Walked,
    /// How people used the rooms, where they lived in the building.
    pub life: Option<LifeReport>,
}

impl Site {
    /// Reads plan and patterns, traces walls, finds routes. `folder` is checked for room for the textures.
    pub fn find(
        scenario: &Scenario,
        folder: Option<&OutputFolder>,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<Site, Error> {
        // A given motion replaces the simulation; without a plan, its floor is open ground.
        let given = Given::of_scenario(scenario, watch, progress)?.map(Given::on_foot);
        let ground = Ground::of_scenario(scenario, given.as_ref(), watch, progress)?;
        let (plan, walls) = (&ground.plan, &ground.walls);
        scenario.look.check_areas(walls)?;
        let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), scenario.floor_texels_per_metre)?;
        let wall_grid = WallGrid::covering(walls, scenario.wall_height_m, scenario.wall_texels_per_metre)?;
        let with_walls = scenario.texture.walls;
        let estimate = |folder: &OutputFolder| {
            let estimate = Estimate::of(plan, grid, with_walls.then_some(&wall_grid), &scenario.texture)?;
            if !scenario.texture.any_size {
                estimate.check(folder.path(), folder.shown())?;
            }
            Ok::<_, Error>(estimate)
        };
        let estimate = folder.map(estimate).transpose()?;
        let pack = || Atlas::pack(&wall_grid, &walls.corners(), scenario.texture.tile, PADDING_PX);
        let atlas = watch.busy(Stage::Export, || with_walls.then(pack).transpose())?;
        let library = watch.busy(Stage::Patterns, || PatternLibrary::open(scenario.pattern_path().as_deref()))?;

        let found = match &given {
            Some(_) => None,
            None => {
                Some(watch.busy(Stage::Routes, || Navigation::find_watched(plan, walls, &scenario.routes, progress))?)
            }
        };
        let (routes, ways) = found.map_or((Vec::new(), None), |(routes, ways)| (routes, Some(ways)));
        let life = ways.as_ref().and_then(Navigation::life).cloned();
        let scenario = scenario.lived_in(life.as_deref()).with_floors(life.as_deref(), walls);
        let places = ContactPlaces::of_walls(walls)
            .with_doors(plan, walls, &scenario.doors)?
            .with_fixtures(plan, walls, &scenario.fixtures)?
            .with_stops(walls, Route::each_stop(&routes));
        let days = if given.is_some() { 1 } else { scenario.days };
        if let (Some(folder), Some(estimate)) = (folder, estimate) {
            let walked_s = f64::from(scenario.crowd.people) * f64::from(days) * Route::mean_seconds(&routes);
            let told = estimate.tell(folder.path(), walked_s, rayon::current_num_threads());
            told.iter().for_each(|told| progress.warn(told));
        }
        Ok(Site { scenario, given, ground, grid, wall_grid, atlas, library, routes, ways, life, places, days })
    }

    /// Takes the look of another scenario, which differs from this one in nothing else.
    pub fn look_as(&mut self, scenario: &Scenario) -> Result<(), Error> {
        scenario.look.check_areas(&self.ground.walls)?;
        let life = self.life.as_deref();
        self.scenario = scenario.lived_in(life).with_floors(life, &self.ground.walls);
        Ok(())
    }

    /// Sums and counts before anybody has walked.
    pub fn untrodden(&self) -> Trodden {
        let walls = self.atlas.is_some().then(|| WallSums::new(self.wall_grid.clone()));
        let life = self.life.as_deref().map(LifeReport::of);
        Trodden { sums: Sums { floor: FloorSums::new(self.grid), walls }, walked: Walked::default(), life }
    }

    /// Walks these days, counted from 0. Frames become marks, marks become stamps, and stamps are added to sums; only the
    /// sums stay in memory.
    pub fn walk(&self, days: Range<u32>, watch: &Stopwatch, progress: &dyn Progress) -> Result<Trodden, Error> {
        let Site { scenario, library, routes, .. } = self;
        let (plan, walls) = (&self.ground.plan, &self.ground.walls);
        // Bodies depend on seed and person id only; all arrival times of a day are known before its crowd walks.
        let crowds: Vec<People> = days.clone().map(|day| scenario.people_of_day(day)).collect();
        let first = days.start;
        let begin = |day: u32| -> Result<Day<'_>, Error> {
            let people = &crowds[(day - first) as usize];
            let source = match (&self.given, &self.ways) {
                (Some(given), _) => Source::of_given(given, &self.ground)?.numbered(),
                (None, Some(ways)) => {
                    let (ways, spots) = (ways.clone(), scenario.spots());
                    let simulated =
                        || Simulation::with_spots(plan, walls, routes, ways, people, &scenario.crowd, &spots);
                    let mut crowd = watch.busy(Stage::Crowd, simulated)?;
                    if day == first {
                        let overloads = watch.busy(Stage::Crowd, || crowd.foresee());
                        overloads.iter().for_each(|overload| progress.warn(&overload.to_string()));
                    }
                    Source::of_crowd(crowd, routes)
                }
                (None, None) => return Err(CrowdError::NoRoutes.into()),
            };
            // The last people of the last day leave fresh prints.
            let origins = source.origins(if day + 1 == self.days { scenario.marks.fresh_people } else { 0 });
            let crowd = origins.len() * self.days as usize;
            let footfalls = Footfalls::new(people, walls, library, &scenario.marks, origins)?;
            let paths = PathSampler::new(source.people());
            Ok(Day { source, footfalls: footfalls.among(crowd).with_contacts(self.places.clone()), paths })
        };

        let stamper = watch.busy(Stage::Stamps, || Stamper::new(library, self.grid, &scenario.stamps))?;
        let wall_stamper =
            watch.busy(Stage::Stamps, || WallStamper::new(library, &self.wall_grid, &scenario.stamps))?;
        let Trodden { mut sums, life: mut lived, .. } = self.untrodden();
        let mut stamp = |marks: &Marks| {
            sums.floor.add(&stamper, walls, &marks.footfalls);
            if let (Some(lived), Some(life)) = (&mut lived, &self.life) {
                let steps = marks.footfalls.iter().filter(|mark| mark.is_of_step());
                lived.count(life, steps.map(|mark| mark.place_m));
            }
            if let Some(sums) = &mut sums.walls {
                sums.add(&wall_stamper, &marks.contacts);
            }
        };
        let stage = if self.given.is_some() { Stage::Motion } else { Stage::Crowd };
        let walked = tread(days, stage, begin, plan, &mut stamp, watch, progress)?;
        Ok(Trodden { sums, walked, life: lived })
    }
}
