//! Motions that are given: what a recording leaves on the floor is what its people walked, wherever the plan lies.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use trodden::bake::{OutputOptions, ResolveOptions, bake, resolve};
use trodden::export::{self, Manifest, Report};
use trodden::math::{Rect, Vec2, vec2};
use trodden::patterns::Cause;
use trodden::recordings::{Recording, RecordingOptions};
use trodden::scenario::{Overrides, Scenario};
use trodden::sums::{FloorSums, Quantity};
use trodden::walk::{MotionOutput, WalkOutputs, walk};
use trodden::{Progress, Silent, Stage};

fn floorplan(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name)
}

/// Remembers what it was warned of.
#[derive(Default)]
struct Warned(Mutex<Vec<String>>);

impl Progress for Warned {
    fn advance(&self, _stage: Stage, _share: f64) {}
    fn warn(&self, message: &str) {
        self.0.lock().unwrap().push(message.to_string());
    }
}

fn baked(scenario: &Scenario, folder: &Path, progress: &dyn Progress) -> (Report, FloorSums) {
    let report = bake(scenario, &OutputOptions { folder: folder.to_path_buf(), force: false }, progress).unwrap();
    (report, export::read_sums(folder, &Manifest::read(folder).unwrap()).unwrap())
}

fn given(motion: &Path, recording: RecordingOptions) -> Overrides {
    Overrides {
        motion_file: Some(motion.to_path_buf()),
        recording,
        texels_per_metre: Some(20.0),
        walls: Some(false),
        ..Overrides::default()
    }
}

/// Juelich text of one person per way, walking from its start to its end at 1.25 m/s.
fn recording(folder: &Path, ways: &[[Vec2; 2]]) -> PathBuf {
    let mut text = String::from("# framerate: 10\n# id frame x/m y/m\n");
    for (id, [from, to]) in ways.iter().enumerate() {
        let frames = (from.distance(*to) / 0.125) as usize;
        for frame in 0..=frames {
            let p = from.lerp(*to, frame as f64 / frames as f64);
            text += &format!("{id} {frame} {:.4} {:.4}\n", p.x, p.y);
        }
    }
    let path = folder.join("paths.txt");
    fs::write(&path, text).unwrap();
    path
}

/// All values of a quantity, in units of it, row by row.
fn values(sums: &FloorSums, quantity: Quantity) -> Vec<f64> {
    let grid = sums.grid_of(quantity);
    let mut raw = vec![0; grid.width as usize * grid.height as usize];
    sums.read(quantity, 0, 0, grid.width as usize, grid.height as usize, &mut raw);
    raw.into_iter().map(|value| f64::from(value) / f64::from(quantity.one())).collect()
}

/// Share of all passes that lies in a rectangle of the plan frame.
fn share_within(sums: &FloorSums, area: Rect) -> f64 {
    let (grid, values) = (sums.grid(), values(sums, Quantity::Passes));
    let middle = |k: usize| {
        let (i, j) = (k % grid.width as usize, k / grid.width as usize);
        vec2(i as f64 + 0.5, j as f64 + 0.5) / grid.texels_per_metre
    };
    let within: f64 = (0..values.len()).filter(|&k| area.contains(middle(k))).map(|k| values[k]).sum();
    within / values.iter().sum::<f64>()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let product =
        |a: &[f64], b: &[f64], ma: f64, mb: f64| -> f64 { a.iter().zip(b).map(|(x, y)| (x - ma) * (y - mb)).sum() };
    product(a, b, mean_a, mean_b) / (product(a, a, mean_a, mean_a) * product(b, b, mean_b, mean_b)).sqrt()
}

#[test]
fn a_recorded_crowd_leaves_the_floor_that_the_crowd_itself_leaves() {
    let dir = tempfile::tempdir().unwrap();
    let overrides =
        Overrides { people: Some(80), texels_per_metre: Some(20.0), walls: Some(false), ..Overrides::default() };
    let scenario = Scenario::open(&floorplan("corridors.toml"), &overrides).unwrap();
    let (walked, crowd) = baked(&scenario, &dir.path().join("crowd"), &Silent);

    for name in ["paths.txt", "paths.sqlite"] {
        let paths = dir.path().join(name);
        let outputs = WalkOutputs { motion: Some(MotionOutput::File(paths.clone())), ..WalkOutputs::default() };
        walk(&scenario, &outputs, &Silent).unwrap();
        let recorded =
            Scenario::open(&floorplan("corridors.toml"), &given(&paths, RecordingOptions::default())).unwrap();
        let (report, sums) = baked(&recorded, &dir.path().join(format!("of {name}")), &Silent);
        assert_eq!((report.people.entered, report.people.arrived), (80, 80), "{name}");
        let steps = report.footfalls as f64 / walked.footfalls as f64;
        assert!((steps - 1.0).abs() < 0.02, "{name}: {steps} times the footfalls");
        let same = correlation(&values(&crowd, Quantity::Presence), &values(&sums, Quantity::Presence));
        assert!(same > 0.98, "{name}: correlation {same}");
    }
}

#[test]
fn without_a_plan_the_floor_lies_around_the_paths() {
    let dir = tempfile::tempdir().unwrap();
    let ways = [[vec2(-100.0, 50.0), vec2(-90.0, 50.0)], [vec2(-90.0, 53.0), vec2(-100.0, 53.0)]];
    let paths = recording(dir.path(), &ways);
    let scenario = Scenario::of_motion(&given(&paths, RecordingOptions::default())).unwrap();
    let (report, sums) = baked(&scenario, &dir.path().join("out"), &Silent);
    assert!(report.footfalls >= 20, "{report:?}");
    let manifest = Manifest::read(&dir.path().join("out")).unwrap();
    assert_eq!((manifest.plan.width_m, manifest.plan.height_m), (14.0, 7.0));
    assert_eq!(manifest.plan.map_from_plan.origin_m, vec2(-102.0, 48.0));
    let strip = |y: f64| Rect { min: vec2(1.0, y - 0.35), max: vec2(13.0, y + 0.35) };
    let shares = [2.0, 5.0].map(|y| share_within(&sums, strip(y)));
    assert!(shares.iter().sum::<f64>() > 0.99 && shares[0] > 0.4 && shares[1] > 0.4, "{shares:?}");
    assert!(!dir.path().join("out/walls").exists(), "there are no walls");
}

#[test]
fn recordings_lie_in_the_map_s_frame_and_can_be_moved() {
    let dir = tempfile::tempdir().unwrap();
    let mut image = image::GrayImage::from_pixel(120, 80, image::Luma([254]));
    for (x, y, pixel) in image.enumerate_pixels_mut() {
        if x < 2 || y < 2 || x >= 118 || y >= 78 {
            pixel.0 = [0];
        }
    }
    image.save(dir.path().join("map.pgm")).unwrap();
    let yaml = "image: map.pgm\nresolution: 0.1\norigin: [5.0, 7.0, 0.5]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    fs::write(dir.path().join("map.yaml"), yaml).unwrap();
    // Along y = 3 of the plan, as the map says it.
    let (sin, cos) = trodden::math::sin_cos(0.5);
    let in_map = |p: Vec2| vec2(5.0 + cos * p.x - sin * p.y, 7.0 + sin * p.x + cos * p.y);
    let paths = recording(dir.path(), &[[in_map(vec2(1.0, 3.0)), in_map(vec2(11.0, 3.0))]]);
    let strip = Rect { min: vec2(0.5, 2.6), max: vec2(11.5, 3.4) };
    let map = dir.path().join("map.yaml");
    let straight = Scenario::open(&map, &given(&paths, RecordingOptions::default())).unwrap();
    let (_, sums) = baked(&straight, &dir.path().join("straight"), &Silent);
    assert!(share_within(&sums, strip) > 0.99);

    // A quarter turn around the middle of the room, and a metre to the right.
    let middle = in_map(vec2(6.0, 4.0));
    let step = in_map(vec2(7.0, 4.0)) - middle;
    let turned = RecordingOptions {
        origin: [middle.x, middle.y],
        shift: [step.x, step.y],
        rotation_deg: 90.0,
        ..RecordingOptions::default()
    };
    let (_, sums) = baked(&Scenario::open(&map, &given(&paths, turned)).unwrap(), &dir.path().join("turned"), &Silent);
    // (x, 3) is a metre below the middle, and so a metre right of it once turned: x = 6 + 1 + 1.
    let column = share_within(&sums, Rect { min: vec2(7.6, 0.0), max: vec2(8.4, 8.0) });
    assert!(column > 0.98, "{column}");
}

#[test]
fn a_recording_beside_the_plan_is_told_of() {
    let dir = tempfile::tempdir().unwrap();
    let paths = recording(dir.path(), &[[vec2(500.0, 500.0), vec2(510.0, 500.0)]]);
    let scenario = Scenario::open(&floorplan("corridors.toml"), &given(&paths, RecordingOptions::default())).unwrap();
    let warned = Warned::default();
    let (report, _) = baked(&scenario, &dir.path().join("out"), &warned);
    let warnings = warned.0.into_inner().unwrap();
    assert!(warnings.iter().any(|text| text.contains("100 % of the motion's places lie beyond")), "{warnings:?}");
    assert!(report.warnings.iter().any(|text| text.contains("align it")), "{:?}", report.warnings);
}

#[test]
fn a_given_motion_bakes_to_the_same_bytes_on_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let ways: Vec<[Vec2; 2]> =
        (0..40).map(|k| [vec2(0.0, 0.4 * f64::from(k)), vec2(16.0, 0.4 * f64::from(39 - k))]).collect();
    let paths = recording(dir.path(), &ways);
    let scenario = Scenario::of_motion(&given(&paths, RecordingOptions::default())).unwrap();
    let floor = |threads: usize| {
        let folder = dir.path().join(threads.to_string());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| baked(&scenario, &folder, &Silent));
        fs::read(folder.join("floor/floor_basecolor.1001.png")).unwrap()
    };
    assert!(floor(1) == floor(3));
}

#[test]
fn a_bake_of_given_people_resolves_to_the_same_textures_again() {
    let dir = tempfile::tempdir().unwrap();
    let paths = recording(dir.path(), &[[vec2(0.0, 0.0), vec2(8.0, 0.0)], [vec2(8.0, 1.5), vec2(0.0, 1.5)]]);
    let scenario = Scenario::of_motion(&given(&paths, RecordingOptions::default())).unwrap();
    let folder = dir.path().join("out");
    baked(&scenario, &folder, &Silent);
    assert_eq!(Manifest::read(&folder).unwrap().people, 2);
    let textures = || {
        let files = fs::read_dir(folder.join("floor")).unwrap().map(|entry| entry.unwrap().path());
        let mut textures: Vec<_> = files.map(|path| (fs::read(&path).unwrap(), path)).collect();
        textures.sort_by(|a, b| a.1.cmp(&b.1));
        textures
    };
    let before = textures();
    resolve(&folder, &ResolveOptions::default(), &Silent).unwrap();
    for ((a, path), (b, _)) in before.iter().zip(&textures()) {
        assert!(a == b, "{} differs", path.display());
    }
}

#[test]
fn open_ground_is_seen_in_three_dimensions_under_the_sky() {
    let dir = tempfile::tempdir().unwrap();
    let paths = recording(dir.path(), &[[vec2(0.0, 0.0), vec2(8.0, 0.0)], [vec2(8.0, 1.0), vec2(0.0, 1.0)]]);
    let overrides = Overrides { walls: Some(true), ..given(&paths, RecordingOptions::default()) };
    let folder = dir.path().join("out");
    baked(&Scenario::of_motion(&overrides).unwrap(), &folder, &Silent);
    assert!(folder.join("scene.glb").exists() && folder.join("index.html").exists());
    assert!(!folder.join("walls").exists(), "there are no walls");
    let picture = |name: &str| image::open(folder.join("preview").join(name)).unwrap().to_rgb8();
    let (trodden, clean) = (picture("eye_level.png"), picture("eye_level_clean.png"));
    // Sky above, floor in front of the feet, in its own colour.
    // Of a seventh of the rows, from these sevenths of the height on.
    let mean = |picture: &image::RgbImage, from: f64| {
        let (width, count) = (picture.width(), picture.height() / 7);
        let first = (from / 7.0 * f64::from(picture.height())) as u32;
        let rows = first..first + count;
        let values = rows.flat_map(|y| (0..width).map(move |x| f64::from(picture.get_pixel(x, y)[1])));
        values.sum::<f64>() / f64::from(width * count)
    };
    let (sky, floor) = (mean(&clean, 0.0), mean(&clean, 6.0));
    assert!((60.0..250.0).contains(&floor) && (sky - floor).abs() > 5.0, "sky {sky}, floor {floor}");
    assert_eq!(mean(&trodden, 0.0), sky);
    assert!(mean(&trodden, 6.0) < floor - 1.0 || mean(&trodden, 4.0) < mean(&clean, 4.0) - 1.0);
    let above = picture("birds_eye.png");
    let [middle, corner] = [[above.width() / 2, above.height() / 2], [2, 2]].map(|[x, y]| above.get_pixel(x, y).0);
    assert_ne!(middle, corner, "the floor is not the table");
}

/// Small people walk to and fro along the south wall, tall ones along the north wall: hands touch each wall as high as
/// those who walk there, and the heights outlast the tools that make motions of a recording.
#[test]
fn recorded_heights_decide_how_high_hands_touch() {
    const STATURES_M: [f64; 2] = [1.2, 1.9];
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    let corridor = |_, y| image::Luma([if (5..35).contains(&y) { 255 } else { 0 }]);
    image::GrayImage::from_fn(80, 40, corridor).save(at("plan.png")).unwrap();
    let mut text = String::from("# framerate: 10\n# id frame x/m y/m z/m\n");
    for frame in 0..1200 {
        for id in 1..=24 {
            let tall = usize::from(id % 2 == 0);
            let (sin, _) = trodden::math::sin_cos(0.03 * f64::from(frame) + 0.5 * f64::from(id));
            let (x, y) = (4.0 + 3.5 * sin, [0.8, 3.2][tall]);
            text += &format!("{id} {frame} {x:.4} {y} {}\n", STATURES_M[tall]);
        }
    }
    fs::write(at("paths.txt"), text).unwrap();
    let run = |arguments: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_trodden"));
        let output = command.arg("-q").args(arguments).current_dir(dir.path()).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    };
    run(&["motion", "features", "paths.txt", "-o", "features.txt"]);
    run(&["motion", "formation", "--example", "paths.txt", "--rate", "2", "-o", "formed.sqlite"]);
    for name in ["features.txt", "formed.sqlite"] {
        let statures = Recording::open(&at(name), &RecordingOptions::default()).unwrap().statures();
        // A formation counts its people from 0.
        let first = u32::from(name == "features.txt");
        for number in 0..24 {
            let wanted_m = STATURES_M[usize::from(number % 2 == 1)];
            let found_m = statures.of(first + number);
            assert!(found_m.is_some_and(|m| (m - wanted_m).abs() < 1e-4), "{name}, person {number}: {found_m:?}");
        }
    }
    let overrides =
        Overrides { metres_per_pixel: Some(0.1), walls: None, ..given(&at("paths.txt"), RecordingOptions::default()) };
    let scenario = Scenario::open(&at("plan.png"), &overrides).unwrap();
    bake(&scenario, &OutputOptions { folder: at("out"), force: false }, &Silent).unwrap();
    let manifest = Manifest::read(&at("out")).unwrap();
    let (walls, sums) = (manifest.walls().unwrap(), export::read_wall_sums(&at("out"), &manifest).unwrap().unwrap());
    let height = sums.grid().height as usize;
    let mut weighed = [[0.0; 2]; 2];
    for (face, wall) in walls.faces.iter().enumerate() {
        let width = sums.grid().faces[face].width as usize;
        let mut densities = vec![0; width * height];
        sums.read(Cause::Hand, face, 0, 0, width, height, &mut densities);
        let [sum, moment] = &mut weighed[usize::from(wall.points_m[0].y > 2.0)];
        for (k, density) in densities.into_iter().enumerate() {
            *sum += f64::from(density);
            *moment += f64::from(density) * ((k / width) as f64 + 0.5) / sums.grid().texels_per_metre;
        }
    }
    let [low_m, high_m] = weighed.map(|[sum, moment]| moment / sum);
    println!("hands at {low_m:.2} m and {high_m:.2} m");
    assert!(high_m - low_m >= 0.25, "hands of small people at {low_m} m, of tall ones at {high_m} m");
}
