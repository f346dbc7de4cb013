//! The pipeline in one function, [`bake`]: from a scenario to textures, scene and report.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::export::{
    self, ExportError, LifeReport, Manifest, OutputFolder, PeopleReport, Report, SDF_FILE, Target, TargetEntry,
    TextureOptions, USD_FILE,
};
use crate::look::Look;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::scenario::Scenario;
use crate::show::{self, Crop};

mod batch;
mod graded;
mod part_file;
mod parts;
mod series;
mod site;
mod tread;
mod view;
mod why;

pub use batch::{Batch, batch};
pub use parts::{Part, bake_part, merge};
pub use series::resolve_series;
pub use view::{View, view};
pub use why::{Reason, RouteHere, WallHere, Why, why};

use graded::{Graded, Sums, keep_look, title};
use site::{Site, Trodden};

/// Files in every bake.
const ALWAYS_MADE: [&str; 5] =
    ["manifest.json", Report::FILE_NAME, "preview/floor.png", show::PATHS_FILE, "sums/floor_presence.exr"];
/// Additional files in a bake with walls.
const MADE_WITH_WALLS: [&str; 5] =
    ["scene.glb", "index.html", "preview/birds_eye.png", "preview/eye_level.png", "preview/eye_level_clean.png"];

/// Output folder of a bake.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputOptions {
    /// Path of the folder.
    pub folder: PathBuf,
    /// Whether to replace an earlier bake there. Other folders with files are never replaced.
    pub force: bool,
}

/// Bakes a scenario: reads its plan, walks its crowd, and writes textures to a new folder.
///
/// It also writes sums, previews and the manifest. Runs on the current rayon pool. The same scenario gives the same
/// bytes in every file but `report.json`, on any number of threads.
///
/// # Errors
/// Errors of the stages; an output folder that cannot be written or must not be replaced; [`Error::Interrupted`]. After
/// an error no new files remain and an earlier result is unchanged.
///
/// # Example
/// ```
/// use trodden::bake::{OutputOptions, bake};
/// use trodden::scenario::{Overrides, Scenario};
///
/// // Three people in the sample museum, at five texels per metre.
/// let coarse = Overrides {
///     metres_per_pixel: Some(0.05),
///     people: Some(3),
///     texels_per_metre: Some(5.0),
///     ..Overrides::default()
/// };
/// let scenario = Scenario::from_plan("floorplans/museum.png".as_ref(), &coarse)?;
/// let folder = tempfile::tempdir()?;
/// let output = OutputOptions { folder: folder.path().join("museum"), force: false };
/// let report = bake(&scenario, &output, &trodden::Silent)?;
/// assert!(report.footfalls > 10 && output.folder.join("manifest.json").is_file());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bake(scenario: &Scenario, output: &OutputOptions, progress: &dyn Progress) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    let folder = begin(scenario, output)?;
    // Plan, walls, routes, doors, patterns: what all days share.
    let site = Site::find(scenario, Some(&folder), &watch, progress)?;
    // Frames become marks, marks become stamps, and stamps are added to sums. Only the sums stay in memory.
    let trodden = site.walk(0..site.days, &watch, progress)?;
    finish(&site, &trodden, folder, output, &watch, progress)
}

/// Checks look, textures and output folder: errors in the input should appear before the crowd walks.
fn begin(scenario: &Scenario, output: &OutputOptions) -> Result<OutputFolder, Error> {
    check_look(scenario)?;
    let folder = OutputFolder::begin(&output.folder, output.force)?;
    check_free(&folder, scenario.texture.walls, &scenario.texture)?;
    folder.check_not_inputs(&scenario.input_files())?;
    Ok(folder)
}

fn check_look(scenario: &Scenario) -> Result<(), Error> {
    scenario.look.check_images()?;
    Ok(scenario.texture.check()?)
}

/// Makes the folder for the bakes of a batch, or for the parts of a bake.
fn make_folder(folder: &Path) -> Result<(), ExportError> {
    fs::create_dir_all(folder).map_err(|source| ExportError::Folder { path: folder.to_path_buf(), source })
}

/// Turns the sums of all days into a bake: the look turns sums into texels, block by block, while the files are written.
fn finish(
    site: &Site,
    trodden: &Trodden,
    folder: OutputFolder,
    output: &OutputOptions,
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<Report, Error> {
    let Trodden { sums, walked, life } = trodden;
    let Site { scenario, ground, routes, .. } = site;
    let (plan, walls) = (&ground.plan, &ground.walls);
    let mut warnings = walked.tally.describe(routes, Some(&output.folder.join(show::PATHS_FILE)));
    warnings.extend(walked.warning.clone());
    let walked_once = || "days are of simulated crowds: this motion was walked once".into();
    warnings.extend((site.days < scenario.days).then(walked_once));
    warnings.extend(life.as_ref().and_then(LifeReport::warning));
    warnings.iter().for_each(|warning| progress.warn(warning));

    let crops = show::choose_crops(walls.bounds_m(), &plan.openings, walls, &walked.paths);
    let (settings, doorways) = (scenario.settings(), site.places.doorways());
    let graded = Graded {
        sums,
        walls,
        doorways: &doorways,
        ceiling: scenario.ceiling,
        look: &scenario.look,
        people: walked.people,
        wall_people: walked.contact_people,
        title: title(&settings),
        seed: scenario.seed,
        atlas: site.atlas.clone(),
    };
    let written = graded.write(&folder, &scenario.texture, &crops, watch, progress)?;
    let sums_entry =
        watch.busy(Stage::Export, || export::write_sums(&folder, &sums.floor, &written.floor, progress))?;
    if let (Some(sums), Some(textures)) = (&sums.walls, &written.walls) {
        watch.busy(Stage::Export, || export::write_wall_sums(&folder, sums, textures, progress))?;
    }
    let picture =
        watch.busy(Stage::Export, || show::draw_paths(plan, walls, routes, &walked.paths, &walked.tally.stuck));
    show::write_picture(&folder, show::PATHS_FILE, &picture)?;

    let report = Report {
        people: PeopleReport::of(&walked.tally, routes),
        warnings,
        life: life.clone(),
        footfalls: walked.footfalls,
        contacts: walked.contacts,
        seconds: watch.seconds(),
        peak_memory_mib: export::peak_memory_mib(),
    };
    report.write(&folder)?;
    let look = keep_look(&scenario.look, &folder)?;
    let manifest = Manifest {
        seed: scenario.seed,
        people: walked.people,
        target: TargetEntry::of(scenario.texture.target),
        floor: written.floor.entry(sums_entry),
        walls: written.walls.map(|textures| textures.entry(walls, walked.contact_people)),
        preview: written.pictures,
        stills: written.stills,
        look,
        doors: Some(doorways),
        settings,
        ..Manifest::of_plan(plan, walls, routes)
    };
    export::write_target_files(&folder, &manifest)?;
    folder.publish(&manifest)?;
    Ok(report)
}

/// Whether `resolve` keeps a file of the bake unchanged.
fn is_kept(file: &str) -> bool {
    let sums = file.starts_with("sums/") && file.ends_with(".exr");
    sums || file == show::PATHS_FILE
}

/// Outputs of a finished bake that [`resolve`] changes; `None` keeps the bake's value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolveOptions {
    /// New look.
    pub look: Option<Look>,
    /// Without it, another preset for the bake's look, see [`Look::with_preset`].
    pub preset: Option<String>,
    /// New target program of the textures.
    pub target: Option<Target>,
    /// Whether `scene.glb` embeds its textures.
    pub embed: Option<bool>,
    /// Whether `scene.glb` has the lamps of the stills.
    pub lamps: Option<bool>,
    /// Whether the scene has a ceiling where the plan has one.
    pub ceiling: Option<bool>,
    /// Whether the scene is also written as `scene.usda`.
    pub usd: Option<bool>,
    /// Whether `scene.sdf`, a world for Gazebo, is written too.
    pub sdf: Option<bool>,
    /// Whether to write the layers as EXR too.
    pub layers: Option<bool>,
    /// Bits per channel of masks, wear and height: 8 or 16.
    pub bits: Option<u32>,
    /// Whether the clean surface and the dirt on it are images of their own too.
    pub dirt: Option<bool>,
    /// Whether PNG files are compressed harder.
    pub small_png: Option<bool>,
    /// Folder to write to, in place of the bake's own: the bake stays as it is.
    pub folder: Option<PathBuf>,
    /// Whether to replace an earlier bake in that folder.
    pub force: bool,
}

impl ResolveOptions {
    /// The look that the bake of a manifest gets.
    fn look_of(&self, manifest: &Manifest, bake: &Path) -> Result<Look, Error> {
        Ok(match (&self.look, &self.preset) {
            (Some(look), _) => look.clone(),
            (None, Some(preset)) => manifest.look(bake)?.with_preset(preset)?,
            (None, None) => manifest.look(bake)?,
        })
    }
}

/// Rewrites a finished bake with another look or for another target, without simulating; or writes it so elsewhere.
///
/// The exact sums are resolved to textures and previews again. Sums and all other files stay unchanged.
///
/// # Errors
/// The folder is not a bake or is damaged; a look out of range; textures beyond the target's limit; files that cannot
/// be written; [`Error::Interrupted`]. After an error the bake is unchanged.
pub fn resolve(bake: &Path, options: &ResolveOptions, progress: &dyn Progress) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    export::settled(&[bake], || Manifest::read(bake))?;
    // From here on the lock keeps other runs from replacing the bake.
    let folder = match &options.folder {
        Some(folder) => OutputFolder::begin(folder, options.force)?,
        None => OutputFolder::begin(bake, true)?,
    };
    let manifest = Manifest::read(bake)?;
    let look = &options.look_of(&manifest, bake)?;
    look.check()?;
    look.check_images()?;
    let mut textures = manifest.texture_options();
    textures.target = options.target.unwrap_or(textures.target);
    textures.embed = options.embed.unwrap_or(textures.embed);
    textures.lamps = options.lamps.unwrap_or(textures.lamps);
    textures.ceiling = options.ceiling.unwrap_or(textures.ceiling);
    textures.usd = options.usd.unwrap_or(textures.usd);
    textures.sdf = options.sdf.unwrap_or(textures.sdf);
    textures.layers = options.layers.or(textures.layers);
    textures.bits = options.bits.unwrap_or(textures.bits);
    textures.dirt = options.dirt.unwrap_or(textures.dirt);
    textures.small_png = options.small_png.unwrap_or(textures.small_png);
    textures.check()?;
    check_free(&folder, manifest.walls.is_some(), &textures)?;
    let atlas = manifest.walls.as_ref().map(|walls| walls.atlas());
    atlas.iter().try_for_each(|atlas| atlas.check(textures.target))?;
    let earlier = Report::read(bake)?;
    let floor = watch.busy(Stage::Sums, || export::read_sums(bake, &manifest))?;
    let walls = watch.busy(Stage::Walls, || manifest.walls())?;
    let sums = Sums { floor, walls: watch.busy(Stage::Sums, || export::read_wall_sums(bake, &manifest))? };

    let graded = Graded {
        sums: &sums,
        walls: &walls,
        doorways: &manifest.doorways(),
        ceiling: view::ceiling(&manifest),
        look,
        people: manifest.people,
        wall_people: manifest.wall_people(),
        title: title(&manifest.settings),
        seed: manifest.seed,
        atlas,
    };
    let crops = Crop::of_manifest(&manifest);
    let written = graded.write(&folder, &textures, &crops, &watch, progress)?;
    for file in manifest.files.iter().filter(|file| is_kept(file)) {
        folder.keep(bake, file)?;
    }

    let report = Report { seconds: watch.seconds(), peak_memory_mib: export::peak_memory_mib(), ..earlier };
    report.write(&folder)?;
    let look = keep_look(look, &folder)?;
    let manifest = Manifest {
        target: TargetEntry::of(textures.target),
        floor: written.floor.entry(manifest.floor.sums.clone()),
        walls: written.walls.map(|textures| textures.entry(&walls, graded.wall_people)),
        preview: written.pictures,
        stills: written.stills,
        look,
        ..manifest
    };
    export::write_target_files(&folder, &manifest)?;
    folder.publish(&manifest)?;
    Ok(report)
}

/// Checks, before any work, that no file of the user has the name of an output.
fn check_free(folder: &OutputFolder, with_walls: bool, options: &TextureOptions) -> Result<(), export::ExportError> {
    folder.check_free(&ALWAYS_MADE)?;
    if !with_walls {
        return Ok(());
    }
    folder.check_free(&MADE_WITH_WALLS)?;
    let asked = [(options.usd, USD_FILE), (options.sdf, SDF_FILE)];
    asked.iter().filter(|(asked, _)| *asked).try_for_each(|(_, file)| folder.check_free(&[file]))
}
