//! Whole bakes: the same bytes on any number of threads, and crowds that arrive without walking through walls.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use trodden::Silent;
use trodden::bake::{OutputOptions, ResolveOptions, bake, resolve};
use trodden::crowd::Simulation;
use trodden::export::Report;
use trodden::look::Look;
use trodden::math::{Rect, vec2};
use trodden::motion::{Frame, Motion, People};
use trodden::plan;
use trodden::routes;
use trodden::scenario::{Overrides, Scenario};
use trodden::stamps::TexelGrid;
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::Walls;

const PLANS: [&str; 4] = ["corridors", "station", "school", "museum"];

fn plan_path(name: &str, ending: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name).with_extension(ending)
}

fn scenario(path: &Path, people: u32, texels_per_metre: f64) -> Scenario {
    let overrides =
        Overrides { people: Some(people), texels_per_metre: Some(texels_per_metre), ..Overrides::default() };
    let mut scenario = Scenario::open(path, &overrides).unwrap();
    scenario.wall_texels_per_metre = 30.0;
    scenario
}

fn bake_on(threads: usize, scenario: &Scenario, folder: PathBuf) -> Report {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| bake(scenario, &OutputOptions { folder, force: false }, &Silent)).unwrap()
}

/// Every file of a bake but the report, by its name.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.file_name().unwrap() != Report::FILE_NAME {
                found.insert(path.strip_prefix(folder).unwrap().to_path_buf(), fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn assert_same(one: &BTreeMap<PathBuf, Vec<u8>>, other: &BTreeMap<PathBuf, Vec<u8>>) {
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (name, bytes) in one {
        assert!(bytes == &other[name], "{} differs", name.display());
    }
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let scenario = scenario(&plan_path("school", "toml"), 120, 20.0);
    let report = bake_on(1, &scenario, dir.path().join("1"));
    assert!(report.footfalls > 1000, "{report:?}");
    let one = files(&dir.path().join("1"));
    assert!(one.len() >= 11, "{:?}", one.keys());
    for threads in [2, 16] {
        let folder = dir.path().join(threads.to_string());
        bake_on(threads, &scenario, folder.clone());
        assert_same(&one, &files(&folder));
    }
}

#[test]
fn resolving_with_the_same_look_changes_nothing_and_with_another_only_the_look() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("out");
    let scenario = scenario(&plan_path("museum", "toml"), 60, 20.0);
    bake_on(2, &scenario, folder.clone());
    let before = files(&folder);
    let with = |look: Look| ResolveOptions { look: Some(look), ..ResolveOptions::default() };
    resolve(&folder, &with(scenario.look.clone()), &Silent).unwrap();
    assert_same(&before, &files(&folder));
    resolve(&folder, &ResolveOptions::default(), &Silent).unwrap();
    assert_same(&before, &files(&folder));

    resolve(&folder, &with(Look::preset("heavy").unwrap()), &Silent).unwrap();
    let after = files(&folder);
    let changed = |name: &str| before[Path::new(name)] != after[Path::new(name)];
    assert!(changed("floor/floor_basecolor.1001.png") && changed("preview/floor.png"));
    assert!(!changed("sums/floor_sums.1001.exr") && !changed("preview/paths.png"));
}

/// On every sample plan, with its scenario and alone. People may overlap by a tenth of the least exclusion distance,
/// but for one pair in a thousand.
#[test]
fn people_arrive_and_nobody_is_ever_inside_a_wall() {
    for name in PLANS {
        for ending in ["toml", "png"] {
            let scenario = scenario(&plan_path(name, ending), 300, 25.0);
            let plan = plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options()).unwrap();
            let walls = Walls::trace(&plan, &scenario.walls);
            let routes = routes::find(&plan, &walls, &scenario.routes).unwrap();
            let people = People::new(scenario.seed, scenario.bodies.clone());
            let mut crowd = Simulation::new(&plan, &walls, &routes, &people, &scenario.crowd).unwrap();
            let [least_exclusion_m, _] = scenario.crowd.exclusion.bounds();
            let image = Rect { min: vec2(0.0, 0.0), max: vec2(plan.width_m(), plan.height_m()) };
            let mut frame = Frame::default();
            let (mut pairs, mut overlaps) = (0, 0);
            while crowd.next_frame(&mut frame).unwrap() {
                for (n, walker) in frame.walkers.iter().enumerate() {
                    let place_m = walker.position_m;
                    let distances = frame.walkers[..n].iter().map(|other| other.position_m.distance(place_m));
                    for distance_m in distances.filter(|&distance_m| distance_m < 1.0) {
                        pairs += 1;
                        overlaps += u32::from(distance_m < 0.9 * least_exclusion_m);
                    }
                    assert!(walls.is_inside(place_m), "{name}.{ending}: {} at {place_m:?}", walker.id);
                    assert!(
                        !image.contains(place_m) || plan.is_floor(place_m),
                        "{name}.{ending}: {} on a wall's pixel at {place_m:?}",
                        walker.id
                    );
                }
            }
            assert!(
                overlaps * 1000 <= pairs,
                "{name}.{ending}: {overlaps} of {pairs} pairs overlap by more than a tenth"
            );
            let tally = crowd.tally();
            assert_eq!(tally.entered, 300, "{name}.{ending}");
            assert!(tally.arrived * 1000 >= 995 * tally.entered, "{name}.{ending}: {tally:?}");
        }
    }
}

/// People enter and leave beyond the floor's edge, so that it is as trodden as the floor inside.
#[test]
fn openings_are_as_trodden_as_the_floor_inside() {
    let dir = tempfile::tempdir().unwrap();
    let mut corridor = image::GrayImage::from_pixel(200, 60, image::Luma([0]));
    for (_, _, pixel) in corridor.enumerate_pixels_mut().filter(|(_, y, _)| (10..50).contains(y)) {
        pixel.0 = [255];
    }
    let path = dir.path().join("corridor.png");
    corridor.save(&path).unwrap();
    let mut scenario = scenario(&path, 1500, 20.0);
    scenario.plan.metres_per_pixel = Some(0.1);
    let folder = dir.path().join("out");
    bake_on(2, &scenario, folder.clone());
    let manifest = trodden::export::Manifest::read(&folder).unwrap();
    let sums = trodden::export::read_sums(&folder, &manifest).unwrap();
    let (west, east) = (passes(&sums, 0.0..1.0), passes(&sums, 19.0..20.0));
    let inside = [passes(&sums, 3.0..4.0), passes(&sums, 16.0..17.0)];
    for (end, inside) in [(west, inside[0]), (east, inside[1])] {
        assert!((end / inside - 1.0).abs() < 0.1, "{west} {inside:?} {east}");
    }
}

/// Mean of `passes` over a stretch of x.
fn passes(sums: &FloorSums, metres: std::ops::Range<f64>) -> f64 {
    let TexelGrid { texels_per_metre, height, .. } = sums.grid();
    let texel = |metres: f64| (metres * texels_per_metre).round() as u32;
    let width = (texel(metres.end) - texel(metres.start)) as usize;
    let mut values = vec![0; width * height as usize];
    sums.read(Quantity::Passes, texel(metres.start), 0, width, height as usize, &mut values);
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64
}
