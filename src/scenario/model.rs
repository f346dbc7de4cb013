use std::path::PathBuf;

use super::error::ScenarioError;
use super::keys;
use super::preset::Preset;
use crate::crowd::{CrowdOptions, SpotRequest};
use crate::export::{Target, TextureOptions};
use crate::formation::FormationRequest;
use crate::look::{Look, MopLook};
use crate::marks::{ContactOptions, DoorRequest, FixtureRequest, HeelOptions, MarksOptions, Weather};
use crate::math::SplitMix64;
use crate::motion::{BodyOptions, People};
use crate::options::{Field, Options, Value};
use crate::plan::PlanOptions;
use crate::recordings::RecordingOptions;
use crate::rooms::{Life, Use};
use crate::routes::{PlaceRequest, RoutesOptions, Timetable, ViaRequest};
use crate::show::Ceiling;
use crate::stamps::StampOptions;
use crate::walls::WallsOptions;

/// Everything that a bake needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The folder that the scenario's paths start from: that of its file.
    pub folder: PathBuf,
    /// The files that it was read from: its own and that of its look, where it has them.
    pub read_from: Vec<PathBuf>,
    /// The plan, relative to `folder`: an image or the YAML of a ROS map. Only a motion that is given needs none: the
    /// floor is open ground then.
    pub image: Option<PathBuf>,
    /// Height of the walls in metres: at least 2.1, less than 3.5.
    pub wall_height_m: f64,
    /// What stills and the page show over the rooms.
    pub(crate) ceiling: Ceiling,
    /// How the plan is read.
    pub plan: PlanOptions,
    /// How walls are traced.
    pub walls: WallsOptions,
    /// Texel density of the floor, texels per metre, 1 to 1000.
    pub floor_texels_per_metre: f64,
    /// Texel density of the walls, texels per metre, 1 to 1000.
    pub wall_texels_per_metre: f64,
    /// How textures are cut and written.
    pub texture: TextureOptions,
    /// What the other values started from.
    pub preset: Preset,
    /// The number that everything random is drawn from.
    pub seed: u64,
    /// Days that are walked: each has its own people, [`Scenario::people_of_day`].
    pub days: u32,
    /// How many people walk, and how.
    pub crowd: CrowdOptions,
    /// What people's bodies are like.
    pub bodies: BodyOptions,
    /// A recording that takes the crowd's place, relative to `folder`.
    pub motion_file: Option<PathBuf>,
    /// How the recording is read.
    pub recording: RecordingOptions,
    /// Formations that take the crowd's place.
    pub formation: Option<FormationRequest>,
    /// What they leave behind on floors and walls.
    pub marks: MarksOptions,
    /// How prints differ from each other.
    pub stamps: StampOptions,
    /// How sums become a floor.
    pub look: Look,
    /// A folder with own patterns, relative to `folder`; without one the built-in library is used.
    pub pattern_folder: Option<PathBuf>,
    /// The ways that people take; none: found.
    pub routes: RoutesOptions,
    /// Doors, beyond what the plan shows of them.
    pub doors: Vec<DoorRequest>,
    /// What people reach for, lean on and wait at.
    pub fixtures: Vec<FixtureRequest>,
    /// Spots that are looked at closely: people near them play units.
    pub units: Vec<SpotRequest>,
}

/// What the command line says; wins over what the scenario file says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Another preset for the crowd and the look.
    pub preset: Option<Preset>,
    /// Another number of people.
    pub people: Option<u32>,
    /// What the building is for.
    pub r#use: Option<Use>,
    /// Another seed.
    pub seed: Option<u64>,
    /// Another number of days.
    pub days: Option<u32>,
    /// Another texel density of the floor.
    pub texels_per_metre: Option<f64>,
    /// Whether to bake a first look: 25 texels per metre of floor, 50 of walls, and no layers, where nothing else is asked.
    pub quick: bool,
    /// Another scale of the plan.
    pub metres_per_pixel: Option<f64>,
    /// Page, level or storey of the plan.
    pub page: Option<u32>,
    /// Another width of the building, from which the scale follows.
    pub width_m: Option<f64>,
    /// Another lightness at which walls end.
    pub threshold: Option<u8>,
    /// Whether walls are light on a dark ground.
    pub invert: Option<bool>,
    /// Another program that the textures are for.
    pub target: Option<Target>,
    /// Whether walls are made too.
    pub walls: Option<bool>,
    /// Whether the clean surface and the dirt on it are images of their own too.
    pub dirt: Option<bool>,
    /// Whether the model carries its textures.
    pub embed: Option<bool>,
    /// Whether `scene.glb` has the lamps of the stills.
    pub lamps: Option<bool>,
    /// Whether the scene has a ceiling where the plan has one.
    pub ceiling: Option<bool>,
    /// Whether the scene is also written as `scene.usda`.
    pub usd: Option<bool>,
    /// Whether `scene.sdf`, a world for Gazebo, is written too.
    pub sdf: Option<bool>,
    /// Whether a bake of any size is made: see [`TextureOptions::any_size`].
    pub any_size: bool,
    /// Other bits per channel of masks.
    pub bits: Option<u32>,
    /// Whether PNG files are compressed harder.
    pub small_png: Option<bool>,
    /// Whether every layer is written on its own too.
    pub layers: Option<bool>,
    /// A recording that takes the crowd's place, relative to the working directory.
    pub motion_file: Option<PathBuf>,
    /// How it is read; keys that differ from the defaults win.
    pub recording: RecordingOptions,
}

/// The values of a section, with their keys.
pub(super) type Parts<'s> = Vec<(&'static Field, &'s mut dyn Value)>;

/// The values of a section that only has keys of the scenario's own, or these before those of a stage.
fn parts<'s>(name: &str, own: Vec<&'s mut dyn Value>, stage: Vec<&'s mut dyn Value>) -> Parts<'s> {
    let fields =
        keys::section(name).and_then(|(field, _)| field.section()).map(|(table, _)| table.fields().collect::<Vec<_>>());
    fields.into_iter().flatten().zip(own.into_iter().chain(stage)).collect()
}

impl Scenario {
    /// The defaults of a preset, without a plan.
    pub fn of_preset(preset: Preset) -> Scenario {
        let texture = keys::TextureKeys::default();
        let mut scenario = Scenario {
            folder: PathBuf::new(),
            read_from: Vec::new(),
            image: None,
            wall_height_m: keys::PlanKeys::default().wall_height,
            ceiling: keys::PlanKeys::default().ceiling,
            plan: PlanOptions::default(),
            walls: WallsOptions::default(),
            floor_texels_per_metre: texture.floor_texels_per_metre,
            wall_texels_per_metre: texture.wall_texels_per_metre,
            texture: TextureOptions::default(),
            preset,
            seed: keys::CrowdKeys::default().seed,
            days: keys::CrowdKeys::default().days,
            crowd: CrowdOptions::default(),
            bodies: BodyOptions::default(),
            motion_file: None,
            recording: RecordingOptions::default(),
            formation: None,
            marks: MarksOptions::default(),
            stamps: StampOptions::default(),
            look: Look::default(),
            pattern_folder: None,
            routes: RoutesOptions::default(),
            doors: Vec::new(),
            fixtures: Vec::new(),
            units: Vec::new(),
        };
        scenario.apply(preset);
        scenario
    }

    /// Sets what a preset changes in a default scenario.
    fn apply(&mut self, preset: Preset) {
        self.preset = preset;
        self.look = Look::preset(preset.name()).unwrap_or_default();
        match preset {
            Preset::Commuters | Preset::Heavy => {}
            Preset::Wet => self.marks.soil.weather = Weather::Wet,
            Preset::Paper => {
                self.crowd = CrowdOptions::paper();
                self.bodies = CrowdOptions::preset_bodies("paper").unwrap_or_default();
                self.marks.shoe = Some("leather_shoe".to_string());
                self.marks.heel = HeelOptions::none();
                self.marks.contact = ContactOptions::paper();
            }
        }
    }

    /// The plan's path, if there is one.
    pub fn image_path(&self) -> Option<PathBuf> {
        self.image.as_ref().map(|image| self.folder.join(image))
    }

    /// The plan's path where the work is about the plan.
    ///
    /// # Errors
    /// A scenario without a plan.
    pub fn plan_path(&self) -> Result<PathBuf, ScenarioError> {
        self.image_path().ok_or_else(|| ScenarioError::Value {
            message: "the scenario names no plan".to_string(),
            hint: Some("write [plan] image = \"plan.png\"".to_string()),
        })
    }

    /// The path of the paint over the plan, if there is one.
    pub fn paint_path(&self) -> Option<PathBuf> {
        self.plan.paint.as_ref().map(|paint| self.folder.join(paint))
    }

    /// What the scenario is about: the name of its plan, or of the motion that needs none.
    pub fn name(&self) -> PathBuf {
        self.image.clone().or_else(|| self.motion_file.clone()).unwrap_or_default()
    }

    /// The recording that takes the crowd's place, if there is one, and how it is read.
    pub fn given_recording(&self) -> Option<(PathBuf, &RecordingOptions)> {
        self.motion_file.as_ref().map(|file| (self.folder.join(file), &self.recording))
    }

    /// How the plan is read: `plan`, with the points that routes name as points of the floor, and doors to open.
    pub fn plan_options(&self) -> PlanOptions {
        let mut options = self.plan.clone();
        options.paint = self.paint_path();
        options.doors = self.doors.iter().map(DoorRequest::to_open).collect();
        let places = self.routes.routes.iter().flat_map(|route| {
            let via = route.via.iter().filter_map(|via| match via {
                ViaRequest::Place(place) => Some(place),
                ViaRequest::Stop(_) => None,
            });
            [&route.from, &route.to].into_iter().chain(via)
        });
        options.floor.extend(places.filter_map(|place| match place {
            PlaceRequest::Point(point) => Some(*point),
            // The middle of an area may well lie in a pillar, and an opening is found once the floor is known.
            PlaceRequest::Area(_) | PlaceRequest::Opening(_) => None,
        }));
        options
    }

    /// The scenario with the people of the building's use: where it has the defaults of bags, wheels, children, groups and
    /// cleaning, such a building has others. Between several days the floor is mopped.
    pub fn lived_in(&self, life: Option<&Life>) -> Scenario {
        let mut scenario = self.clone();
        if self.days > 1 && self.motion_file.is_none() && self.look.mop.every == MopLook::default().every {
            scenario.look.mop.every = self.crowd.people as f32;
        }
        let Some(habits) = life.filter(|_| self.preset != Preset::Paper).map(|life| life.r#use.habits()) else {
            return scenario;
        };
        let (bodies, groups) = (BodyOptions::default(), CrowdOptions::default().groups);
        if self.bodies.bags == bodies.bags {
            scenario.bodies.bags = habits.bags;
        }
        if (self.bodies.pull, self.bodies.push) == (bodies.pull, bodies.push) {
            [scenario.bodies.pull, scenario.bodies.push] = habits.wheels;
        }
        if self.bodies.children == bodies.children {
            scenario.bodies.children = habits.children;
        }
        if self.crowd.groups.shares == groups.shares {
            scenario.crowd.groups.shares = habits.groups;
        }
        if self.look.mop.takes == MopLook::default().takes {
            scenario.look.mop.takes = habits.mop;
        }
        scenario
    }

    /// The people of a day, counted from 0. Those of the first are drawn from the seed itself.
    pub fn people_of_day(&self, day: u32) -> People {
        let word = SplitMix64::new(self.seed ^ u64::from(day).rotate_left(32)).next_u64();
        let people = People::new(if day == 0 { self.seed } else { word }, self.bodies.clone());
        // Of recorded people it is not known how fast they would have walked.
        if self.motion_file.is_some() { people } else { people.with_free_speed(self.crowd.speed) }
    }

    /// The path of the folder with own patterns, if there is one.
    pub fn pattern_path(&self) -> Option<PathBuf> {
        self.pattern_folder.as_ref().map(|folder| self.folder.join(folder))
    }

    /// The spots at which units are played, with their folders as they lie on the disk.
    pub fn spots(&self) -> Vec<SpotRequest> {
        let joined = |spot: &SpotRequest| SpotRequest {
            folder: spot.folder.as_ref().map(|folder| self.folder.join(folder)),
            ..spot.clone()
        };
        self.units.iter().map(joined).collect()
    }

    /// Every timetable: the crowd's and the routes' own.
    pub(super) fn timetables(&mut self) -> impl Iterator<Item = &mut Timetable> {
        let of_routes = self.routes.routes.iter_mut().filter_map(|route| route.arrivals.as_mut());
        [&mut self.crowd.arrivals].into_iter().chain(of_routes)
    }

    /// The values of all sections that come once, in order. `look_file` is no part of a scenario: what the file says is.
    pub(super) fn sections<'s>(&'s mut self, look_file: &'s mut Option<PathBuf>) -> Vec<(&'static str, Parts<'s>)> {
        let densities: Vec<&mut dyn Value> = vec![&mut self.floor_texels_per_metre, &mut self.wall_texels_per_metre];
        let of = |(name, own, stage)| (name, parts(name, own, stage));
        [
            (
                "plan",
                vec![&mut self.image as &mut dyn Value, &mut self.wall_height_m, &mut self.ceiling],
                self.plan.values_mut(),
            ),
            ("walls", Vec::new(), self.walls.values_mut()),
            ("texture", densities, self.texture.values_mut()),
            (
                "crowd",
                vec![&mut self.preset as &mut dyn Value, &mut self.seed, &mut self.days],
                self.crowd.values_mut(),
            ),
            ("life", Vec::new(), self.routes.life.values_mut()),
            ("motion", vec![&mut self.motion_file], self.recording.values_mut()),
            ("bodies", Vec::new(), self.bodies.values_mut()),
            ("marks", Vec::new(), self.marks.values_mut()),
            ("stamps", Vec::new(), self.stamps.values_mut()),
            ("look", vec![look_file], self.look.values_mut()),
            ("patterns", vec![&mut self.pattern_folder], Vec::new()),
        ]
        .into_iter()
        .map(of)
        .collect()
    }

    /// The sections that may be missing or come several times.
    pub(super) fn lists(&mut self) -> [(&'static str, &mut dyn Value); 7] {
        [
            (keys::FORMATION, &mut self.formation),
            (keys::ROUTE, &mut self.routes.routes),
            (keys::STOP, &mut self.routes.stops),
            (keys::ROOM, &mut self.routes.rooms),
            (keys::DOOR, &mut self.doors),
            (keys::FIXTURE, &mut self.fixtures),
            (keys::UNIT, &mut self.units),
        ]
    }
}
