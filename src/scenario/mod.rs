//! The scenario: everything that a bake needs to know, as a TOML file or as a plan image alone.
//!
//! One section per stage, each the options of that stage; a few keys belong to the scenario itself. Every key has a
//! default, so that a plan image alone is a scenario too. A preset changes the defaults; keys that a file writes
//! win over the preset, and [`Overrides`] (the command line) win over the file.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::crowd::{CrowdModel, CrowdOptions, SpotRequest};
use crate::export::{Target, TextureOptions};
use crate::files::read_text;
use crate::formation::FormationRequest;
use crate::look::Look;
use crate::marks::{DoorRequest, FixtureRequest, MarksOptions};
use crate::motion::BodyOptions;
use crate::plan::PlanOptions;
use crate::recordings::RecordingOptions;
use crate::routes::{PlaceRequest, RouteRequest, RoutesOptions, StopRequest, Timetable, ViaRequest};
use crate::stamps::StampOptions;
use crate::walls::WallsOptions;

mod check;
mod document;
mod error;
mod explain;
mod inputs;
mod keys;
mod preset;
mod snippet;
mod write;

pub use error::{ScenarioError, Wrong};
pub use keys::allowed_range;
pub use preset::Preset;
pub use snippet::Snippet;

use document::Document;

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
    /// Another seed.
    pub seed: Option<u64>,
    /// Another texel density of the floor.
    pub texels_per_metre: Option<f64>,
    /// Another scale of the plan.
    pub metres_per_pixel: Option<f64>,
    /// Another program that the textures are for.
    pub target: Option<Target>,
    /// Whether walls are made too.
    pub walls: Option<bool>,
    /// Whether the model carries its textures.
    pub embed: Option<bool>,
    /// Whether a bake of any size is made: see [`TextureOptions::any_size`].
    pub any_size: bool,
    /// Whether every layer is written on its own too.
    pub layers: Option<bool>,
    /// A recording that takes the crowd's place, relative to the working directory.
    pub motion_file: Option<PathBuf>,
    /// How it is read; keys that differ from the defaults win.
    pub recording: RecordingOptions,
}

impl Scenario {
    /// A scenario from a file: TOML is read as such, anything else is taken for a plan.
    ///
    /// # Errors
    /// As [`Scenario::read`].
    pub fn open(path: &Path, overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            Scenario::read(path, overrides)
        } else {
            Scenario::from_plan(path, overrides)
        }
    }

    /// A scenario of a plan alone, defaults for the rest. The plan is not opened.
    ///
    /// # Errors
    /// Overrides beyond what is allowed.
    pub fn from_plan(path: &Path, overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        let mut scenario = Scenario::of_preset(overrides.preset.unwrap_or_default());
        scenario.folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        scenario.image = path.file_name().map(PathBuf::from);
        scenario.apply(overrides);
        scenario.check(None)?;
        Ok(scenario)
    }

    /// A scenario of a given motion alone, on open ground.
    ///
    /// # Errors
    /// Overrides that name no motion, or are beyond what is allowed.
    pub fn of_motion(overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        let mut scenario = Scenario::of_preset(overrides.preset.unwrap_or_default());
        scenario.apply(overrides);
        scenario.check(None)?;
        Ok(scenario)
    }

    /// Reads a scenario file.
    ///
    /// # Errors
    /// Files that cannot be read; whatever is not TOML, not a key, not of the right type or beyond its range, with
    /// line and column.
    pub fn read(path: &Path, overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        let text = read_text(path).map_err(|source| ScenarioError::Unreadable { path: path.to_path_buf(), source })?;
        let mut scenario = Scenario::parse(&text, path, overrides)?;
        scenario.read_from.push(path.to_path_buf());
        Ok(scenario)
    }

    /// Reads a scenario from text; `path` is where it came from, for errors and for the paths in it.
    ///
    /// # Errors
    /// As [`Scenario::read`].
    pub fn parse(text: &str, path: &Path, overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        let document = &Document::parse(path, text)?;
        let mut crowd = document.section("crowd");
        let preset = crowd.take("preset")?;
        let mut scenario = Scenario::of_preset(overrides.preset.or(preset).unwrap_or_default());
        scenario.folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        scenario.seed = crowd.take("seed")?.unwrap_or(scenario.seed);

        let mut plan = document.section("plan");
        scenario.image = plan.take("image")?;
        scenario.wall_height_m = plan.take("wall_height")?.unwrap_or(scenario.wall_height_m);
        scenario.plan = plan.over(&scenario.plan)?;
        scenario.walls = document.section("walls").over(&scenario.walls)?;
        let mut texture = document.section("texture");
        let floor_density = texture.take("floor_texels_per_metre")?;
        scenario.floor_texels_per_metre = floor_density.unwrap_or(scenario.floor_texels_per_metre);
        let wall_density = texture.take("wall_texels_per_metre")?;
        scenario.wall_texels_per_metre = wall_density.unwrap_or(scenario.wall_texels_per_metre);
        scenario.texture = texture.over(&scenario.texture)?;
        scenario.crowd = crowd.over(&scenario.crowd)?;
        let mut motion = document.section("motion");
        scenario.motion_file = motion.take("file")?;
        scenario.recording = motion.over(&scenario.recording)?;
        if document.has(keys::FORMATION) {
            scenario.formation = Some(document.section(keys::FORMATION).into_options()?);
        }
        scenario.bodies = document.section("bodies").over(&scenario.bodies)?;
        scenario.marks = document.section("marks").over(&scenario.marks)?;
        scenario.stamps = document.section("stamps").over(&scenario.stamps)?;
        let mut patterns = document.section("patterns");
        scenario.pattern_folder = patterns.take("folder")?;
        patterns.into_table::<Nothing>()?;
        scenario.look = scenario.read_look(document, overrides.preset.is_some())?;
        scenario.routes.routes = document.list::<RouteRequest>(keys::ROUTE)?;
        scenario.routes.stops = document.list::<StopRequest>(keys::STOP)?;
        scenario.doors = document.list::<DoorRequest>(keys::DOOR)?;
        scenario.fixtures = document.list::<FixtureRequest>(keys::FIXTURE)?;
        scenario.units = document.list::<SpotRequest>(keys::UNIT)?;
        if !scenario.units.is_empty() && document.text_of("crowd.model").is_none() {
            scenario.crowd.model = CrowdModel::SocialForce;
        }
        scenario.read_timetables(document)?;
        scenario.apply(overrides);
        scenario.check(Some(document))?;
        Ok(scenario)
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

    /// What the scenario is about: the name of its plan, or of the motion that needs none.
    pub fn name(&self) -> PathBuf {
        self.image.clone().or_else(|| self.motion_file.clone()).unwrap_or_default()
    }

    /// The recording that takes the crowd's place, if there is one, and how it is read.
    pub fn given_recording(&self) -> Option<(PathBuf, &RecordingOptions)> {
        self.motion_file.as_ref().map(|file| (self.folder.join(file), &self.recording))
    }

    /// How the plan is read: `plan`, with the points that routes name as points of the floor.
    pub fn plan_options(&self) -> PlanOptions {
        let mut options = self.plan.clone();
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

    /// The defaults of a preset, without a plan.
    pub fn of_preset(preset: Preset) -> Scenario {
        let mut scenario = Scenario {
            folder: PathBuf::new(),
            read_from: Vec::new(),
            image: None,
            wall_height_m: 2.6,
            plan: PlanOptions::default(),
            walls: WallsOptions::default(),
            floor_texels_per_metre: 100.0,
            wall_texels_per_metre: 200.0,
            texture: TextureOptions::default(),
            preset,
            seed: 1,
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
        preset.apply(&mut scenario);
        scenario
    }

    /// Every timetable: the crowd's and the routes' own.
    fn timetables(&mut self) -> impl Iterator<Item = &mut Timetable> {
        let of_routes = self.routes.routes.iter_mut().filter_map(|route| route.arrivals.as_mut());
        [&mut self.crowd.arrivals].into_iter().chain(of_routes)
    }

    /// Reads the files of timetables; where lists name everybody and nobody says how many walk, they do.
    fn read_timetables(&mut self, document: &Document<'_>) -> Result<(), ScenarioError> {
        let folder = self.folder.clone();
        let places: Vec<String> = ["crowd.arrivals.file".to_string()]
            .into_iter()
            .chain(
                (0..self.routes.routes.len())
                    .filter(|&index| self.routes.routes[index].arrivals.is_some())
                    .map(|index| format!("route.{index}.arrivals.file")),
            )
            .collect();
        for (timetable, key) in self.timetables().zip(places) {
            let Some(file) = &timetable.file else { continue };
            let path = folder.join(file);
            let text = read_text(&path).map_err(|error| {
                document.wrong_value(&key, format!("cannot read the timetable {}: {error}", path.display()), None)
            })?;
            timetable.of_file = Timetable::rows_of_csv(&text).map_err(|(line, problem)| {
                let message = format!("the timetable {}, line {line}: {problem}", path.display());
                document.wrong_value(&key, message, Some("write a line as `60, 20`: 20 people at 60 s".to_string()))
            })?;
            if timetable.of_file.is_empty() {
                let problem = if text.trim().is_empty() { "is empty" } else { "has no line with a time" };
                let message = format!("the timetable {} {problem}", path.display());
                let hint = "write a line as `60, 20`: 20 people at 60 s".to_string();
                return Err(document.wrong_value(&key, message, Some(hint)));
            }
        }
        let own: Vec<Option<u64>> = self.routes.routes.iter().map(|route| route.arrivals.as_ref()?.listed()).collect();
        let listed = match self.crowd.arrivals.listed() {
            Some(listed) if own.iter().all(Option::is_none) => Some(listed),
            _ if !own.is_empty() => own.into_iter().sum::<Option<u64>>(),
            _ => None,
        };
        if let Some(listed) = listed.filter(|_| document.text_of("crowd.people").is_none()) {
            self.crowd.people = u32::try_from(listed).unwrap_or(u32::MAX);
        }
        Ok(())
    }

    fn apply(&mut self, overrides: &Overrides) {
        self.seed = overrides.seed.unwrap_or(self.seed);
        self.crowd.people = overrides.people.unwrap_or(self.crowd.people);
        self.floor_texels_per_metre = overrides.texels_per_metre.unwrap_or(self.floor_texels_per_metre);
        self.texture.target = overrides.target.unwrap_or(self.texture.target);
        self.texture.walls = overrides.walls.unwrap_or(self.texture.walls);
        self.texture.embed = overrides.embed.unwrap_or(self.texture.embed);
        self.texture.any_size |= overrides.any_size;
        self.texture.layers = overrides.layers.or(self.texture.layers);
        if let Some(file) = &overrides.motion_file {
            // Paths of the command line start from the working directory, those of the scenario from its folder.
            let absolute = std::path::absolute(file).ok().filter(|_| !self.folder.as_os_str().is_empty());
            self.motion_file = Some(absolute.unwrap_or_else(|| file.clone()));
        }
        self.recording = self.recording.overridden_by(&overrides.recording);
        if overrides.metres_per_pixel.is_some() {
            self.plan.metres_per_pixel = overrides.metres_per_pixel;
            self.plan.scale = None;
        }
    }

    /// The look: that of a preset or a file, with the section's own keys laid over it.
    fn read_look(&mut self, document: &Document<'_>, preset_overridden: bool) -> Result<Look, ScenarioError> {
        let mut section = document.section("look");
        let preset: Option<Preset> = section.take("preset")?;
        let file: Option<PathBuf> = section.take("file")?;
        let base = match (file, preset) {
            (Some(_), Some(_)) => {
                let hint = "a look file names its own preset: leave one of the two out".to_string();
                return Err(document.wrong_value(
                    "look.file",
                    "[look] has both a preset and a file".to_string(),
                    Some(hint),
                ));
            }
            (Some(file), None) => {
                let file = self.folder.join(file);
                let look = Look::read(&file);
                self.read_from.push(file);
                look.map_err(|error| document.wrong_value("look.file", error.to_string(), error.hint()))?
            }
            (None, Some(preset)) if !preset_overridden => Look::preset(preset.name()).unwrap_or_default(),
            (None, _) => self.look.clone(),
        };
        let own = ["look.floor.image", "look.wall.image"].map(|key| document.text_of(key).is_some());
        let mut look: Look = section.over(&base)?;
        for (image, own) in look.images().into_iter().zip(own) {
            if let Some(image) = image.filter(|_| own) {
                *image = self.folder.join(&*image);
            }
        }
        Ok(look)
    }
}

/// A section whose keys the scenario reads for itself: nothing may be left.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Nothing {}

#[cfg(test)]
mod tests;
