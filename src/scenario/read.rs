use std::path::{Path, PathBuf};

use super::document::Document;
use super::error::ScenarioError;
use super::model::{Overrides, Scenario};
use super::preset::Preset;
use crate::crowd::CrowdModel;
use crate::files::read_text;
use crate::look::Look;
use crate::routes::Timetable;

/// Texels per metre of floor and of walls of a first look.
const QUICK_TEXELS_PER_METRE: f64 = 25.0;
/// How many people walk on a first look, unless a scenario says how many.
const QUICK_PEOPLE: u32 = 400;

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
        scenario.override_by(overrides, false);
        scenario.check(None)?;
        Ok(scenario)
    }

    /// A scenario of a given motion alone, on open ground.
    ///
    /// # Errors
    /// Overrides that name no motion, or are beyond what is allowed.
    pub fn of_motion(overrides: &Overrides) -> Result<Scenario, ScenarioError> {
        let mut scenario = Scenario::of_preset(overrides.preset.unwrap_or_default());
        scenario.override_by(overrides, false);
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
        let preset = document.value("crowd.preset")?;
        let mut scenario = Scenario::of_preset(overrides.preset.or(preset).unwrap_or_default());
        scenario.folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        scenario.look = scenario.base_look(document, overrides.preset.is_some())?;
        let base = (scenario.preset, scenario.look.preset.clone());
        for (name, parts) in scenario.sections(&mut None) {
            document.read_section(name, parts)?;
        }
        for (name, value) in scenario.lists() {
            document.read_value(name, value)?;
        }
        (scenario.preset, scenario.look.preset) = base;
        let own = ["look.floor.image", "look.wall.image"].map(|key| document.text_of(key).is_some());
        let folder = scenario.folder.clone();
        let areas = std::iter::repeat(document.text_of("look.area").is_some());
        for (image, own) in scenario.look.images().into_iter().zip(own.into_iter().chain(areas)) {
            if let Some(image) = image.filter(|_| own) {
                *image = folder.join(&*image);
            }
        }
        if !scenario.units.is_empty() && document.text_of("crowd.model").is_none() {
            scenario.crowd.model = CrowdModel::SocialForce;
        }
        let listed = scenario.read_timetables(document)?;
        let says_people = document.text_of("crowd.people").is_some() || listed;
        scenario.override_by(overrides, says_people);
        scenario.check(Some(document))?;
        Ok(scenario)
    }

    /// Reads the files of timetables; where lists name everybody and nobody says how many walk, they do: whether so.
    fn read_timetables(&mut self, document: &Document<'_>) -> Result<bool, ScenarioError> {
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
        let listed = listed.filter(|_| document.text_of("crowd.people").is_none());
        self.crowd.people = listed.map_or(self.crowd.people, |listed| u32::try_from(listed).unwrap_or(u32::MAX));
        Ok(listed.is_some())
    }

    /// Applies the command line's values; `says_people`: whether the scenario itself says how many walk.
    fn override_by(&mut self, overrides: &Overrides, says_people: bool) {
        self.seed = overrides.seed.unwrap_or(self.seed);
        self.days = overrides.days.unwrap_or(self.days);
        if overrides.quick && !says_people {
            self.crowd.people = QUICK_PEOPLE;
        }
        self.crowd.people = overrides.people.unwrap_or(self.crowd.people);
        self.routes.life.people = self.crowd.people;
        self.routes.life.r#use = overrides.r#use.or(self.routes.life.r#use);
        if overrides.quick {
            (self.floor_texels_per_metre, self.wall_texels_per_metre) =
                (QUICK_TEXELS_PER_METRE, QUICK_TEXELS_PER_METRE);
            self.texture.layers = Some(false);
        }
        self.floor_texels_per_metre = overrides.texels_per_metre.unwrap_or(self.floor_texels_per_metre);
        self.texture.target = overrides.target.unwrap_or(self.texture.target);
        self.texture.walls = overrides.walls.unwrap_or(self.texture.walls);
        self.texture.embed = overrides.embed.unwrap_or(self.texture.embed);
        self.texture.lamps = overrides.lamps.unwrap_or(self.texture.lamps);
        self.texture.dirt = overrides.dirt.unwrap_or(self.texture.dirt);
        self.texture.ceiling = overrides.ceiling.unwrap_or(self.texture.ceiling);
        self.texture.usd = overrides.usd.unwrap_or(self.texture.usd);
        self.texture.sdf = overrides.sdf.unwrap_or(self.texture.sdf);
        self.texture.any_size |= overrides.any_size;
        self.texture.layers = overrides.layers.or(self.texture.layers);
        self.texture.bits = overrides.bits.unwrap_or(self.texture.bits);
        self.texture.small_png = overrides.small_png.unwrap_or(self.texture.small_png);
        if let Some(file) = &overrides.motion_file {
            // Paths of the command line start from the working directory, those of the scenario from its folder.
            let absolute = std::path::absolute(file).ok().filter(|_| !self.folder.as_os_str().is_empty());
            self.motion_file = Some(absolute.unwrap_or_else(|| file.clone()));
        }
        self.recording = self.recording.overridden_by(&overrides.recording);
        self.plan.page = overrides.page.or(self.plan.page);
        if overrides.metres_per_pixel.is_some() {
            self.plan.metres_per_pixel = overrides.metres_per_pixel;
            (self.plan.scale, self.plan.width_m) = (None, None);
        }
        if overrides.width_m.is_some() {
            self.plan.width_m = overrides.width_m;
            (self.plan.scale, self.plan.metres_per_pixel) = (None, None);
        }
        self.plan.threshold = overrides.threshold.or(self.plan.threshold);
        self.plan.invert = overrides.invert.or(self.plan.invert);
    }

    /// What the section of the look starts from: a preset or a file.
    fn base_look(&mut self, document: &Document<'_>, preset_overridden: bool) -> Result<Look, ScenarioError> {
        let preset: Option<Preset> = document.value("look.preset")?;
        let file: Option<PathBuf> = document.value("look.file")?;
        Ok(match (file, preset) {
            (Some(_), Some(_)) => {
                let message = "[look] has both a preset and a file".to_string();
                let hint = "a look file names its own preset: leave one of the two out".to_string();
                return Err(document.wrong_value("look.file", message, Some(hint)));
            }
            (Some(file), None) => {
                let file = self.folder.join(file);
                let look = Look::read(&file);
                self.read_from.push(file);
                look.map_err(|error| document.wrong_value("look.file", error.to_string(), error.hint()))?
            }
            (None, Some(preset)) if !preset_overridden => Look::preset(preset.name()).unwrap_or_default(),
            (None, _) => self.look.clone(),
        })
    }
}
