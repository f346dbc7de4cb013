//! The pipeline in one function: a reader who has read only [`bake`] knows the program.

use std::path::{Path, PathBuf};

use crate::Error;
use crate::crowd::Simulation;
use crate::export::{self, Atlas, Estimate, Manifest, OutputFolder, PADDING_PX, Report, Target, TargetEntry};
use crate::look::Look;
use crate::marks::{ContactPlaces, Footfalls};
use crate::motion::People;
use crate::patterns::PatternLibrary;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::routes::{Navigation, Route};
use crate::scenario::Scenario;
use crate::show::{self, Crop, PathSampler};
use crate::source::{Given, Ground, Source};
use crate::stamps::{Stamper, TexelGrid, WallGrid, WallStamper};
use crate::sums::{FloorSums, WallSums};

mod graded;
mod tread;
mod view;

pub use view::{View, view};

use graded::{Graded, Sums, look_entry, title};
use tread::{Marks, tread};

/// Files that every bake makes, whatever its plan.
const ALWAYS_MADE: [&str; 5] =
    ["manifest.json", Report::FILE_NAME, "preview/floor.png", show::PATHS_FILE, "sums/floor_presence.exr"];
/// Files that a bake makes besides where it makes walls.
const MADE_WITH_WALLS: [&str; 5] =
    ["scene.glb", "index.html", "preview/birds_eye.png", "preview/eye_level.png", "preview/eye_level_clean.png"];

/// Where a bake goes.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputOptions {
    /// The folder to make.
    pub folder: PathBuf,
    /// Whether the files of an earlier bake there are replaced. Anything else is never replaced.
    pub force: bool,
}

/// From a plan to its trodden floor: reads the scenario's plan, walks its crowd, and writes textures, sums,
/// previews and the manifest to a new folder, on the rayon pool that it is called in.
///
/// The same scenario gives the same bytes in every file but `report.json`, on any number of threads.
///
/// # Errors
/// Whatever a stage says of its input; an output folder that cannot be written or must not be replaced;
/// [`Error::Interrupted`]. In all these cases nothing is left behind and an earlier result stays as it was.
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
    // What is known to be wrong is told before anybody walks.
    scenario.look.check_images()?;
    scenario.texture.check()?;
    let folder = OutputFolder::begin(&output.folder, output.force)?;
    check_free(&folder, scenario.texture.walls)?;
    folder.check_not_inputs(&scenario.input_files())?;

    // A motion may be given: then nobody has to be walked, and without a plan the floor is open ground around it.
    let given = Given::of_scenario(scenario, &watch, progress)?.map(Given::on_foot);
    let ground = Ground::of_scenario(scenario, given.as_ref(), &watch, progress)?;
    let (plan, walls) = (&ground.plan, &ground.walls);
    let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), scenario.floor_texels_per_metre)?;
    let wall_grid = WallGrid::covering(walls, scenario.wall_height_m, scenario.wall_texels_per_metre)?;
    let with_walls = scenario.texture.walls;
    let estimate = Estimate::of(plan, grid, with_walls.then_some(&wall_grid), &scenario.texture)?;
    let told = estimate.check(folder.path(), folder.shown(), scenario.texture.any_size)?;
    told.iter().for_each(|told| progress.warn(told));
    let pack = || Atlas::pack(&wall_grid, &walls.corners(), scenario.texture.tile, PADDING_PX);
    let atlas = watch.busy(Stage::Export, || with_walls.then(pack).transpose())?;
    let library = watch.busy(Stage::Patterns, || PatternLibrary::open(scenario.pattern_path().as_deref()))?;

    // A person is a pure function of the seed and a number; who arrives when is settled before anybody walks.
    let people = People::new(scenario.seed, scenario.bodies.clone());
    let routes;
    let mut source = match &given {
        Some(given) => {
            routes = Vec::new();
            Source::of_given(given, &ground)?.numbered()
        }
        None => {
            let (found, ways) =
                watch.busy(Stage::Routes, || Navigation::find_watched(plan, walls, &scenario.routes, progress))?;
            routes = found;
            let simulated =
                || Simulation::with_spots(plan, walls, &routes, ways, &people, &scenario.crowd, &scenario.spots());
            Source::of_crowd(watch.busy(Stage::Crowd, simulated)?, &routes)
        }
    };
    let origins = source.origins(scenario.marks.fresh_people);
    let places = ContactPlaces::of_walls(walls)
        .with_doors(plan, walls, &scenario.doors)?
        .with_fixtures(plan, walls, &scenario.fixtures)?
        .with_stops(walls, Route::each_stop(&routes));
    let doorways = places.doorways();
    let mut footfalls = Footfalls::new(&people, walls, &library, &scenario.marks, origins)?.with_contacts(places);

    // Frames become marks, marks become stamps, stamps are summed up: a stream of which only the sums are kept.
    let stamper = watch.busy(Stage::Stamps, || Stamper::new(&library, grid, &scenario.stamps))?;
    let wall_stamper = watch.busy(Stage::Stamps, || WallStamper::new(&library, &wall_grid, &scenario.stamps))?;
    let mut sums = Sums { floor: FloorSums::new(grid), walls: with_walls.then(|| WallSums::new(wall_grid)) };
    let mut paths = PathSampler::new(source.people());
    let mut stamp = |marks: &Marks| {
        sums.floor.add(&stamper, walls, &marks.footfalls);
        if let Some(sums) = &mut sums.walls {
            sums.add(&wall_stamper, &marks.contacts);
        }
    };
    tread(&mut source, &mut footfalls, &mut paths, &mut stamp, &watch, progress)?;
    let tally = source.tally();
    let mut warnings = tally.describe(&routes, Some(&output.folder.join(show::PATHS_FILE)));
    warnings.extend(source.warning());
    warnings.iter().for_each(|warning| progress.warn(warning));

    // Sums become what floor and walls look like, block by block, as the files are written.
    let crops = show::choose_crops(walls.bounds_m(), &plan.openings, walls, paths.paths());
    let settings = scenario.settings();
    let graded = Graded {
        sums: &sums,
        walls,
        doorways: &doorways,
        look: &scenario.look,
        people: source.people(),
        wall_people: footfalls.contact_people(),
        title: title(&settings),
        seed: scenario.seed,
        atlas,
    };
    let written = graded.write(&folder, &scenario.texture, &crops, &watch, progress)?;
    let sums_entry =
        watch.busy(Stage::Export, || export::write_sums(&folder, &sums.floor, &written.floor, progress))?;
    if let (Some(sums), Some(textures)) = (&sums.walls, &written.walls) {
        watch.busy(Stage::Export, || export::write_wall_sums(&folder, sums, textures, progress))?;
    }
    let picture = watch.busy(Stage::Export, || show::draw_paths(plan, walls, &routes, paths.paths(), &tally.stuck));
    show::write_picture(&folder, show::PATHS_FILE, &picture)?;

    let report = Report {
        people: source.people_report(&routes),
        warnings,
        footfalls: footfalls.count(),
        contacts: footfalls.contact_count(),
        seconds: watch.seconds(),
        peak_memory_mib: export::peak_memory_mib(),
    };
    report.write(&folder)?;
    let manifest = Manifest {
        seed: scenario.seed,
        people: source.people(),
        target: TargetEntry::of(scenario.texture.target),
        floor: written.floor.entry(sums_entry),
        walls: written.walls.map(|textures| textures.entry(walls, footfalls.contact_people())),
        preview: written.pictures,
        stills: written.stills,
        look: look_entry(&scenario.look),
        doors: Some(doorways),
        settings,
        ..Manifest::of_plan(plan, walls, &routes)
    };
    export::write_target_files(&folder, &manifest)?;
    folder.publish(&manifest)?;
    Ok(report)
}

/// Whether `resolve` takes a file of the bake over as it is.
fn is_kept(file: &str) -> bool {
    let sums = file.starts_with("sums/") && file.ends_with(".exr");
    sums || file == show::PATHS_FILE
}

/// Which outputs `resolve` rewrites of a finished bake. What is left out stays as it was.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolveOptions {
    /// Another look.
    pub look: Option<Look>,
    /// Another program that the textures are for.
    pub target: Option<Target>,
    /// Whether the model carries its textures.
    pub embed: Option<bool>,
    /// Whether every layer is written on its own too.
    pub layers: Option<bool>,
}

/// Grades a finished bake with another look, or writes it for another target: its exact sums are resolved to textures
/// and previews once more, without simulating. Sums and everything else stay as they were.
///
/// # Errors
/// A folder that is not a bake or is damaged; a look out of range; textures larger than the target takes; files that
/// cannot be written; [`Error::Interrupted`]. In all these cases the bake stays as it was.
pub fn resolve(bake: &Path, options: &ResolveOptions, progress: &dyn Progress) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    export::settled(&[bake], || Manifest::read(bake))?;
    // From here on no other run replaces the bake.
    let folder = OutputFolder::begin(bake, true)?;
    let manifest = Manifest::read(bake)?;
    check_free(&folder, manifest.walls.is_some())?;
    let look = &options.look.clone().map_or_else(|| manifest.look(bake), Ok)?;
    look.check()?;
    look.check_images()?;
    let mut textures = manifest.texture_options();
    textures.target = options.target.unwrap_or(textures.target);
    textures.embed = options.embed.unwrap_or(textures.embed);
    textures.layers = options.layers.or(textures.layers);
    textures.check()?;
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
        folder.keep(file)?;
    }

    let report = Report { seconds: watch.seconds(), peak_memory_mib: export::peak_memory_mib(), ..earlier };
    report.write(&folder)?;
    let manifest = Manifest {
        target: TargetEntry::of(textures.target),
        floor: written.floor.entry(manifest.floor.sums.clone()),
        walls: written.walls.map(|textures| textures.entry(&walls, graded.wall_people)),
        preview: written.pictures,
        stills: written.stills,
        look: look_entry(look),
        ..manifest
    };
    export::write_target_files(&folder, &manifest)?;
    folder.publish(&manifest)?;
    Ok(report)
}

/// Refuses, before any work is done, names that files of the user have.
fn check_free(folder: &OutputFolder, with_walls: bool) -> Result<(), export::ExportError> {
    folder.check_free(&ALWAYS_MADE)?;
    if with_walls { folder.check_free(&MADE_WITH_WALLS) } else { Ok(()) }
}
