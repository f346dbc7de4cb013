//! The pipeline in one function: a reader who has read only [`bake`] knows the program.

use std::path::{Path, PathBuf};

use crate::crowd::Crowd;
use crate::export::preview::{self, Crop, PathSampler};
use crate::export::{self, FloorTextures, Manifest, OutputFolder, PeopleReport, PreviewEntry, Report, TextureOptions};
use crate::look::{FloorResolver, Look};
use crate::marks::{Footfalls, Origin};
use crate::motion::People;
use crate::patterns::PatternLibrary;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::routes::Navigation;
use crate::scenario::Scenario;
use crate::stamps::{Stamper, TexelGrid};
use crate::sums::FloorSums;
use crate::walls::Walls;
use crate::{Error, plan};

mod tread;

use tread::tread;

/// Where a bake goes.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputOptions {
    /// The folder to make.
    pub folder: PathBuf,
    /// Whether an earlier bake there is replaced. Anything else is never replaced.
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
pub fn bake(scenario: &Scenario, output: &OutputOptions, progress: &dyn Progress) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    let folder = OutputFolder::begin(&output.folder, output.force)?;

    let plan = watch.busy(Stage::Plan, || plan::read(&scenario.image_path(), &scenario.plan_options()))?;
    plan.warnings.iter().for_each(|warning| progress.warn(warning));
    let walls = watch.busy(Stage::Walls, || Walls::trace(&plan, &scenario.walls))?;
    let (routes, ways) = watch.busy(Stage::Routes, || Navigation::find(&plan, &walls, &scenario.routes))?;
    let library = watch.busy(Stage::Patterns, || PatternLibrary::open(scenario.pattern_path().as_deref()))?;

    // A person is a pure function of the seed and a number; who arrives when is settled before anybody walks.
    let people = People::new(scenario.seed, scenario.bodies.clone());
    let mut crowd =
        watch.busy(Stage::Crowd, || Crowd::with_navigation(&plan, &walls, &routes, ways, &people, &scenario.crowd))?;
    let from_outside = crowd.arrivals().iter().map(|arrival| arrival.from_outside);
    let origins = Origin::of_arrivals(from_outside, scenario.marks.fresh_people);
    let mut footfalls = Footfalls::new(&people, &walls, &library, &scenario.marks, origins)?;

    // Frames become marks, marks become stamps, stamps are summed up: a stream of which only the sums are kept.
    let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), scenario.floor_texels_per_metre)?;
    let stamper = watch.busy(Stage::Stamps, || Stamper::new(&library, grid, &scenario.stamps));
    let mut sums = FloorSums::new(grid);
    let mut paths = PathSampler::new(scenario.crowd.people);
    let mut stamp = |marks: &[_]| sums.add(&stamper, &walls, marks);
    tread(&mut crowd, &mut footfalls, &mut paths, &mut stamp, &watch, progress)?;
    let tally = crowd.tally();
    let warnings = tally.describe(&routes, Some(&output.folder.join(preview::PATHS_FILE)));
    warnings.iter().for_each(|warning| progress.warn(warning));

    // Sums become what the floor looks like, block by block, as the files are written.
    let crops = preview::choose_crops(walls.bounds_m(), &plan.openings, &walls, paths.paths());
    let graded = Graded { sums: &sums, walls: &walls, look: &scenario.look, people: scenario.crowd.people };
    let (textures, pictures) = graded.write(&folder, &scenario.texture, &crops, &watch, progress)?;
    let sums_entry = watch.busy(Stage::Export, || export::write_sums(&folder, &sums, &textures, progress))?;
    let picture =
        watch.busy(Stage::Export, || preview::draw_paths(&plan, &walls, &routes, paths.paths(), &tally.stuck));
    preview::write_picture(&folder, preview::PATHS_FILE, &picture)?;

    let report = Report {
        people: PeopleReport::of(&tally, &routes),
        warnings,
        footfalls: footfalls.count(),
        seconds: watch.seconds(),
        peak_memory_mib: export::peak_memory_mib(),
    };
    report.write(&folder)?;
    folder.publish(&Manifest {
        seed: scenario.seed,
        people: scenario.crowd.people,
        floor: textures.entry(sums_entry),
        preview: pictures,
        look: look_entry(&scenario.look),
        settings: scenario.settings(),
        ..Manifest::of_plan(&plan, &walls, &routes)
    })?;
    Ok(report)
}

/// Grades a finished bake with another look: its exact sums are resolved to textures and previews once more, without
/// simulating. Sums and everything else stay as they were.
///
/// # Errors
/// A folder that is not a bake or is damaged; a look out of range; files that cannot be written;
/// [`Error::Interrupted`]. In all these cases the bake stays as it was.
pub fn resolve(bake: &Path, look: &Look, progress: &dyn Progress) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    export::restore(bake)?;
    let manifest = Manifest::read(bake)?;
    let earlier = Report::read(bake)?;
    let sums = watch.busy(Stage::Sums, || export::read_sums(bake, &manifest))?;
    let walls = watch.busy(Stage::Walls, || manifest.walls());

    let folder = OutputFolder::begin(bake, true)?;
    let graded = Graded { sums: &sums, walls: &walls, look, people: manifest.people };
    let crops = Crop::of_manifest(&manifest);
    let (textures, pictures) = graded.write(&folder, &manifest.floor.options(), &crops, &watch, progress)?;
    for file in manifest.files.iter().filter(|file| file.starts_with("sums/") || *file == preview::PATHS_FILE) {
        folder.keep(file)?;
    }

    let report = Report { seconds: watch.seconds(), peak_memory_mib: export::peak_memory_mib(), ..earlier };
    report.write(&folder)?;
    let floor = textures.entry(manifest.floor.sums.clone());
    folder.publish(&Manifest { floor, preview: pictures, look: look_entry(look), ..manifest })?;
    Ok(report)
}

/// A floor's sums with what turns them into a picture.
struct Graded<'a> {
    sums: &'a FloorSums,
    walls: &'a Walls,
    look: &'a Look,
    people: u32,
}

impl Graded<'_> {
    /// Writes the textures and the pictures of them.
    fn write(
        &self,
        folder: &OutputFolder,
        options: &TextureOptions,
        crops: &[Crop],
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<(FloorTextures, Vec<PreviewEntry>), Error> {
        let grid = self.sums.grid();
        let floor = FloorResolver::new(self.sums, self.walls, self.look, self.people)?;
        let textures = export::floor_textures(folder, grid, &floor, options, progress)?;
        watch.add(Stage::Look, textures.look_busy_s);
        watch.add(Stage::Export, textures.export_busy_s);
        let pictures =
            watch.busy(Stage::Export, || preview::write_previews(folder, &textures, &floor, self.walls, crops))?;
        Ok((textures, pictures))
    }
}

/// A look as the manifest keeps it: without the folder of its floor image, so that it says nothing of the machine.
fn look_entry(look: &Look) -> serde_json::Value {
    let mut look = look.clone();
    look.floor.image = look.floor.image.and_then(|image| image.file_name().map(PathBuf::from));
    serde_json::to_value(&look).expect("a look is plain values with keys that are strings")
}
