//! Manifests that say anything.

use std::fs;
use std::path::Path;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use trodden::Silent;
use trodden::bake::{OutputOptions, ResolveOptions, View, bake, resolve, view};
use trodden::export::{Manifest, peak_memory_mib};
use trodden::math::vec2;
use trodden::plan::Side;
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::{Outline, Walls, WallsError};

use super::super::sandbox::Sandbox;

/// The most time for a manifest that is refused or used, and the most memory for all of them together.
const MOST_TIME: Duration = Duration::from_secs(10);
const MOST_MIB: f64 = 1500.0;
/// How long mutants are looked at and graded; the rest of them are only read.
const ENOUGH: Duration = Duration::from_secs(4);

/// A bake of a corridor of 8 x 4 m, with a person and few texels.
fn tiny_bake(sandbox: &Sandbox, name: &str, walls: bool, density: f64) {
    sandbox.plan();
    let overrides = Overrides {
        people: Some(1),
        metres_per_pixel: Some(0.1),
        texels_per_metre: Some(density),
        walls: Some(walls),
        ..Overrides::default()
    };
    let mut scenario = Scenario::from_plan(&sandbox.path("plan.png"), &overrides).unwrap();
    scenario.wall_texels_per_metre = density;
    // The smallest that takes strips of these walls.
    scenario.texture.tile = if walls { 128 } else { 64 };
    bake(&scenario, &OutputOptions { folder: sandbox.path(name), force: false }, &Silent).unwrap();
}

/// What may stand in the place of a value.
fn replacements(value: &Value) -> Vec<Value> {
    match value {
        Value::Number(_) => vec![
            json!(0),
            json!(-1),
            json!(0.5),
            json!(1e8),
            json!(1e308),
            json!(-1e308),
            json!(u32::MAX),
            json!(u64::MAX),
        ],
        Value::String(_) => vec![json!(""), json!("../../x"), json!("\u{1b}[31m"), json!(7)],
        Value::Bool(_) | Value::Null => vec![json!(3)],
        Value::Array(_) => vec![json!([]), json!(null)],
        Value::Object(_) => vec![json!({}), json!([])],
    }
}

/// A change of a manifest in one place: what it is, where, and how.
struct Mutation {
    name: String,
    place: String,
    change: Change,
}

type Change = Box<dyn Fn(&mut Value)>;

impl Mutation {
    fn of(&self, manifest: &Value) -> Vec<u8> {
        let mut mutant = manifest.clone();
        (self.change)(mutant.pointer_mut(&self.place).unwrap());
        serde_json::to_vec(&mutant).unwrap()
    }
}

/// All changes of a manifest in one place: a value replaced, a key or an element dropped, an element twice.
fn mutations(manifest: &Value) -> Vec<Mutation> {
    fn walk(at: &Value, path: &str, change: &mut dyn FnMut(String, Change)) {
        for new in replacements(at) {
            change(format!("{path} = {new}"), Box::new(move |value| *value = new.clone()));
        }
        match at {
            Value::Array(items) => {
                // Lists of many of a kind: their ends tell enough.
                let ends = [0, items.len().wrapping_sub(1)];
                for (k, item) in items.iter().enumerate().filter(|(k, _)| ends.contains(k)) {
                    let drop = move |value: &mut Value| drop(value.as_array_mut().unwrap().remove(k));
                    change(format!("{path} without {k}"), Box::new(drop));
                    let again = item.clone();
                    let twice = move |value: &mut Value| value.as_array_mut().unwrap().insert(k, again.clone());
                    change(format!("{path} with {k} twice"), Box::new(twice));
                    walk(item, &format!("{path}/{k}"), change);
                }
            }
            Value::Object(keys) => {
                for (key, item) in keys {
                    let name = key.clone();
                    let drop = move |value: &mut Value| drop(value.as_object_mut().unwrap().remove(&name));
                    change(format!("{path} without {key}"), Box::new(drop));
                    walk(item, &format!("{path}/{}", key.replace('~', "~0").replace('/', "~1")), change);
                }
            }
            _ => {}
        }
    }
    let mut all = Vec::new();
    walk(manifest, "", &mut |name, change| {
        let place = name.split(' ').next().unwrap_or("").to_string();
        all.push(Mutation { name, place, change });
    });
    all
}

/// Runs something in a thread of its own, for so long and no longer; gives what it panicked with.
fn in_time<T: Send + 'static>(what: &str, run: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let _ = sender.send(run());
    });
    match receiver.recv_timeout(MOST_TIME) {
        Ok(done) => done,
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("{what}: takes more than {MOST_TIME:?}"),
        Err(mpsc::RecvTimeoutError::Disconnected) => panic!("{what}: panicked"),
    }
}

fn look_at(bake: &Path) -> bool {
    let from = View { camera: None, birds_eye: true, fov_deg: None, size_px: [64, 64], clean: false, look: None };
    view(bake, &from, &Silent).is_ok()
}

#[test]
fn a_manifest_with_anything_in_it_is_used_or_refused_in_time_and_memory() {
    let sandbox = Sandbox::new();
    tiny_bake(&sandbox, "whole", true, 8.0);
    tiny_bake(&sandbox, "floor", false, 8.0);
    let begin = Instant::now();
    let (mut refused, mut used, mut resolved) = (0, 0, 0);
    for name in ["floor", "whole"] {
        let folder = sandbox.path(name);
        let json: Value = serde_json::from_slice(&fs::read(folder.join("manifest.json")).unwrap()).unwrap();
        // The look and the settings have most of the numbers, and checks of their own: some of them will do. What both
        // bakes have is changed in the one that is graded in no time.
        let of_walls = ["/walls", "/doors", "/stills", "/outlines"];
        let mut mutations: Vec<Mutation> = mutations(&json);
        let mut number = 0;
        mutations.retain(|mutation| {
            number += 1;
            let starts = |part: &str| mutation.place.starts_with(part);
            match name {
                "whole" => of_walls.into_iter().any(starts),
                _ => number % 29 == 0 || !starts("/look") && !starts("/settings"),
            }
        });
        assert!(mutations.len() > 300, "{name}: {}", mutations.len());
        for (k, mutation) in mutations.iter().enumerate() {
            let what = &mutation.name;
            fs::write(folder.join("manifest.json"), mutation.of(&json)).unwrap();
            let path = folder.clone();
            if in_time(what, move || Manifest::read(&path).is_err()) {
                refused += 1;
                continue;
            }
            used += 1;
            // A busy machine still resolves a few.
            if begin.elapsed() > ENOUGH && (resolved > 3 || name == "whole") {
                continue;
            }
            let path = folder.clone();
            in_time(what, move || look_at(&path));
            if name == "floor" && k % 5 == 0 {
                resolved += 1;
                let path = folder.clone();
                in_time(what, move || resolve(&path, &ResolveOptions::default(), &Silent).is_ok());
            }
        }
    }
    assert!(refused > 500 && used > 50 && resolved > 3, "{refused} refused, {used} used, {resolved} resolved");
    let peak_mib = peak_memory_mib().unwrap_or(0.0);
    assert!(peak_mib < MOST_MIB, "{peak_mib} MiB");
}

#[test]
fn what_is_wrong_in_a_manifest_is_named_with_its_value_and_range() {
    let sandbox = Sandbox::new();
    tiny_bake(&sandbox, "out", true, 8.0);
    let path = sandbox.path("out/manifest.json");
    let json: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    let says = |pointer: &str, new: Value| {
        let mut mutant = json.clone();
        *mutant.pointer_mut(pointer).unwrap() = new;
        fs::write(&path, serde_json::to_vec(&mutant).unwrap()).unwrap();
        Manifest::read(&sandbox.path("out")).unwrap_err().to_string()
    };
    for (pointer, new, part) in [
        ("/plan/width_m", json!(1e308), "`plan.width_m` is 1"),
        ("/floor/texels_per_metre", json!(1001), "`floor.texels_per_metre` is 1001, allowed is 1 to 1000"),
        ("/floor/texels_per_metre", json!(0), "`floor.texels_per_metre` is 0, allowed is 1 to 1000"),
        ("/floor/width_px", json!(u32::MAX), "`floor.width_px` is 4294967295, allowed is 64"),
        ("/floor/tile_px/0", json!(65), "`floor.tile_px"),
        ("/floor/tiles/0/u", json!(9), "`floor.tiles[0].u` is 9, allowed is 0 to 0"),
        ("/floor/tiles/0/max_m/0", json!(-1e308), "`floor.tiles[0].max_m`"),
        ("/preview/1/max_m/0", json!(1e8), "`preview[1].max_m (x)` is 100000000, allowed is"),
        ("/outlines/0/points", json!([[0.0, 0.0], [1.0, 1.0]]), "`outlines[0]` is a loop of 2 points, allowed is 3"),
        ("/outlines/0/points/0/1", json!(1e8), "`outlines[0].points[0] (y)` is 100000000, allowed is"),
        ("/outlines/0/openings/0/0", json!(77), "open at edge 77"),
        ("/walls/padding_px", json!(1_000_000), "`walls.padding_px` is 1000000, allowed is 0 to 256"),
        ("/walls/sheets/0/strips/0/to_m", json!(1e308), "`walls.sheets[0].strips[0].to_m`"),
    ] {
        let message = says(pointer, new);
        assert!(message.contains(part) && message.contains("manifest.json"), "{pointer}: {message}");
    }
}

#[test]
fn outlines_that_are_none_are_an_error() {
    let square = [[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]].map(|[x, y]| vec2(x, y));
    let of = |points: &[trodden::math::Vec2], openings: Vec<(usize, Side)>| {
        Walls::from_outlines(vec![Outline {
            points_m: points.to_vec(),
            openings,
            furniture_m: None,
            windows_m: Vec::new(),
        }])
        .map(|_| ())
    };
    of(&square, vec![(1, Side::East)]).unwrap();
    for points in [&square[..0], &square[..1], &square[..2]] {
        assert!(matches!(of(points, Vec::new()), Err(WallsError::TooFewPoints { .. })));
    }
    for openings in [vec![(4, Side::East)], vec![(usize::MAX, Side::East)], vec![(2, Side::East), (1, Side::West)]] {
        assert!(matches!(of(&square, openings), Err(WallsError::Opening { .. })));
    }
    for far in [1e8, -1e308, f64::NAN, f64::INFINITY] {
        let mut points = square;
        points[2].y = far;
        assert!(matches!(of(&points, Vec::new()), Err(WallsError::TooFar { .. })), "{far}");
    }
}

#[test]
fn sums_that_are_not_those_of_the_manifest_are_an_error() {
    let sandbox = Sandbox::new();
    tiny_bake(&sandbox, "out", true, 8.0);
    tiny_bake(&sandbox, "finer", true, 12.0);
    for file in ["floor_sums.1001.exr", "floor_presence.exr", "wall_sums.1001.exr"] {
        let path = sandbox.path("out/sums").join(file);
        let own = fs::read(&path).unwrap();
        let other = fs::read(sandbox.path("finer/sums").join(file)).unwrap();
        fs::write(&path, other).unwrap();
        assert!(!look_at(&sandbox.path("out")), "{file} of another bake");
        // Bytes of the header and of the table of places.
        for at in (0..own.len().min(700)).step_by(13) {
            for value in [0x00, 0xff] {
                let mut bent = own.clone();
                bent[at] = value;
                fs::write(&path, bent).unwrap();
                let folder = sandbox.path("out");
                in_time(&format!("{file}, byte {at}"), move || look_at(&folder));
            }
        }
        fs::write(&path, own).unwrap();
    }
    assert!(look_at(&sandbox.path("out")));
}

#[test]
fn a_floor_of_fewer_texels_than_a_tile_can_be_graded_again() {
    let sandbox = Sandbox::new();
    tiny_bake(&sandbox, "out", false, 3.0);
    resolve(&sandbox.path("out"), &ResolveOptions::default(), &Silent).unwrap();
}
