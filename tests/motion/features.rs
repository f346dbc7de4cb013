//! `trodden motion features` on files: what a user gives it and gets back.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use trodden::math::{Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;
use trodden::recordings::{Recording, RecordingOptions};

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trodden"));
    command.args(["motion", "features"]).args(arguments).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> (String, String) {
    let output = run(folder, arguments);
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success(), "{arguments:?}: {err}");
    (out, err)
}

/// Exit code and what is said.
fn refused(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = run(folder, arguments);
    assert!(!output.status.success(), "{arguments:?}");
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Juelich text of people who are at a place, or nowhere, at each of some frames, 10 in a second.
fn recording(path: &Path, people: u32, frames: u32, place: impl Fn(u32, f64) -> Option<Vec2>) {
    let mut text = String::from("# framerate: 10\n# id frame x/m y/m\n");
    for frame in 0..frames {
        for id in 1..=people {
            if let Some(p) = place(id, f64::from(frame) / 10.0) {
                writeln!(text, "{id} {frame} {:.4} {:.4}", p.x, p.y).unwrap();
            }
        }
    }
    fs::write(path, text).unwrap();
}

/// People who come one after the other and walk through a corridor 12 m long, everybody at a speed of their own.
fn corridor(path: &Path) {
    recording(path, 30, 300, |id, t| {
        let speed = 1.0 + 0.02 * f64::from(id % 7);
        let x = (t - 0.8 * f64::from(id)) * speed;
        let (sway, _) = sin_cos(3.0 * t + f64::from(id));
        (0.0..12.0).contains(&x).then(|| vec2(x, 0.3 * f64::from(id % 5) + 0.05 * sway))
    });
}

/// Twelve people who are there throughout.
fn dance(path: &Path) {
    recording(path, 12, 80, |id, t| {
        let (sin, cos) = sin_cos(std::f64::consts::FRAC_PI_6 * f64::from(id));
        let (to, fro) = sin_cos(t * (0.5 + 0.04 * f64::from(id)));
        Some(vec2(3.0 * cos + to + 0.5 * t, 3.0 * sin + 0.5 * fro))
    });
}

fn read(path: &Path) -> Ensemble {
    Recording::open(path, &RecordingOptions::default()).unwrap().ensemble(None, [0.0, 1e9]).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    serde_json::from_str(&done(folder, &[arguments, &["--json", "-q"]].concat()).0).unwrap()
}

#[test]
fn a_recording_in_which_people_come_and_go_gives_something_useful() {
    let folder = tempfile::tempdir().unwrap();
    corridor(&folder.path().join("corridor.txt"));
    let (table, warnings) = done(folder.path(), &["corridor.txt"]);
    assert!(table.contains("principal components") && table.contains("share"), "{table}");
    assert!(warnings.contains("are there throughout") && warnings.contains("others are left out"), "{warnings}");

    let found = &json(folder.path(), &["corridor.txt", "-o", "part.txt"])["features"];
    let (people, moments) = (found["span"]["people"].as_u64().unwrap(), found["span"]["moments"].as_u64().unwrap());
    assert!(people >= 4 && moments >= 30, "{people} {moments}");
    let shares: Vec<f64> =
        found["components"].as_array().unwrap().iter().map(|c| c["share"].as_f64().unwrap()).collect();
    assert!(shares.windows(2).all(|pair| pair[0] >= pair[1]) && (shares.iter().sum::<f64>() - 1.0).abs() < 1e-6);

    // What is written is those people's motion, from 0 on.
    let part = read(&folder.path().join("part.txt"));
    assert_eq!((part.people() as u64, part.moments() as u64, part.start_s), (people, moments, 0.0));
    let from_s = found["span"]["from_s"].as_f64().unwrap();
    let recording = Recording::open(&folder.path().join("corridor.txt"), &RecordingOptions::default()).unwrap();
    let whole = recording.ensemble(None, [from_s - 0.01, from_s + (moments - 1) as f64 / 10.0 + 0.01]).unwrap();
    assert_eq!(whole.ids, part.ids);
    for moment in 0..moments as usize {
        let apart = whole.places_at(moment).iter().zip(part.places_at(moment)).map(|(a, b)| a.distance(*b));
        assert!(apart.fold(0.0, f64::max) < 2e-4);
    }
}

#[test]
fn coefficients_are_changed_and_pictures_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    dance(&folder.path().join("dance.txt"));
    done(folder.path(), &["dance.txt", "--scale", "all=2", "--no-avoid", "-o", "twice.txt", "--paths", "twice.png"]);
    assert!(image::open(folder.path().join("twice.png")).unwrap().width() > 200);
    let (once, twice) = (read(&folder.path().join("dance.txt")), read(&folder.path().join("twice.txt")));
    for moment in 0..once.moments() - 1 {
        let step = |of: &Ensemble, k: usize| {
            let relative = |moment: usize| of.places_at(moment)[k] - of.centroid_m(moment);
            relative(moment + 1) - relative(moment)
        };
        // Places are written to a tenth of a millimetre.
        assert!((0..12).all(|k| (step(&twice, k) - step(&once, k) * 2.0).length() < 1e-3));
    }
    let frozen = json(folder.path(), &["dance.txt", "--method", "laplacian", "-k", "3", "-o", "three.sqlite"]);
    assert_eq!(frozen["features"]["kept"], 3);
    assert_eq!(frozen["written"]["motion"]["format"], "jupedsim");
    assert!(frozen["features"]["error_m"].as_f64().unwrap() > 0.01);
    assert!(frozen["features"]["mean_neighbours"][0].as_f64().unwrap() > 0.5);
}

/// The nearest that two people come, metres.
fn nearest_m(of: &Ensemble) -> f64 {
    let at = |moment: usize| {
        let places = of.places_at(moment);
        let pairs = (0..places.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| places[a].distance(places[b])).fold(f64::INFINITY, f64::min)
    };
    (0..of.moments()).map(at).fold(f64::INFINITY, f64::min)
}

/// Six pairs, who walk towards each other and back again.
fn meetings(path: &Path, apart_m: f64) {
    recording(path, 12, 80, |id, t| {
        let (sway, _) = sin_cos(t * (0.9 + 0.05 * f64::from(id / 2)));
        let side = if id % 2 == 0 { 1.0 } else { -1.0 };
        Some(vec2(side * (0.5 * apart_m - 0.4 * sway.abs()), 2.0 * f64::from((id - 1) / 2) + 0.01 * f64::from(id)))
    });
}

#[test]
fn people_of_a_new_motion_step_aside() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    meetings(&path("meet.txt"), 1.22);
    let (_, said) = done(folder.path(), &["meet.txt", "--scale", "all=2", "--no-avoid", "-o", "through.txt"]);
    assert!(!said.contains("too dense"), "{said}");
    let (_, said) = done(folder.path(), &["meet.txt", "--scale", "all=2", "-o", "aside.txt"]);
    assert!(!said.contains("too dense"), "{said}");
    let [before, through, aside] = ["meet.txt", "through.txt", "aside.txt"].map(|name| read(&path(name)));
    let gaps = [&before, &through, &aside].map(nearest_m);
    assert!(gaps[0] > 0.4 && gaps[1] < 0.2 && gaps[2] > 0.359, "{gaps:?}");
    // They go the same ways but for stepping aside, without a jump.
    for moment in 1..aside.moments() {
        for k in 0..12 {
            let off = |moment: usize| aside.places_at(moment)[k] - through.places_at(moment)[k];
            assert!(off(moment).length() < 0.3 && off(moment).distance(off(moment - 1)) < 0.12, "{k} at {moment}");
        }
    }
    let (_, said) = done(folder.path(), &["meet.txt", "--scale", "all=2", "--distance", "0.2", "-o", "nearer.txt"]);
    let nearer_m = nearest_m(&read(&path("nearer.txt")));
    assert!((0.199..0.3).contains(&nearer_m), "{nearer_m} {said}");
    // The motion as it was is left alone.
    done(folder.path(), &["meet.txt", "--distance", "2", "-o", "same.txt"]);
    assert!((nearest_m(&read(&path("same.txt"))) - gaps[0]).abs() < 1e-3);
}

#[test]
fn where_it_is_too_crowded_a_warning_says_where_and_when() {
    let folder = tempfile::tempdir().unwrap();
    // A hundred people who wait far from each other, and half-way leap into one place for a tenth of a second.
    recording(&folder.path().join("leap.txt"), 60, 81, |id, t| {
        let home = vec2(3.0 * f64::from(id), 0.0);
        Some(if (t - 4.0).abs() < 0.01 { home.lerp(vec2(90.0, 1.0), 0.5) } else { home })
    });
    let (_, said) = done(folder.path(), &["leap.txt", "--scale", "all=2", "-o", "all.txt"]);
    assert!(said.contains("too dense: at 4.0 s near ["), "{said}");
    let (_, said) = done(folder.path(), &["leap.txt", "--scale", "all=2", "--no-avoid", "-o", "none.txt"]);
    assert!(!said.contains("too dense"), "{said}");
}

#[test]
fn two_recordings_are_mixed() {
    let folder = tempfile::tempdir().unwrap();
    dance(&folder.path().join("dance.txt"));
    corridor(&folder.path().join("corridor.txt"));
    let arguments = ["dance.txt", "--mix", "corridor.txt", "--middle", "both", "-k", "4", "-o", "both.txt"];
    let (table, warnings) = done(folder.path(), &arguments);
    assert!(table.contains("first") && table.contains("other"), "{table}");
    assert!(warnings.contains("of the first crowd have no counterpart"), "{warnings}");
    let both = read(&folder.path().join("both.txt"));
    assert!(both.people() < 12 && both.people() >= 4);
    // It walks along the corridor while it dances.
    let gone = both.centroid_m(both.moments() - 1) - both.centroid_m(0);
    assert!(gone.x > 1.4 * both.moments() as f64 / 10.0, "{gone:?}");
}

#[test]
fn the_other_recording_is_read_as_its_own_options_say() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    dance(&path("dance.txt"));
    // The same crowd in another guise: centimetres, other columns, no header, and turned by a quarter.
    let mut text = String::new();
    for line in fs::read_to_string(path("dance.txt")).unwrap().lines().filter(|line| !line.starts_with('#')) {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        let [id, frame, x, y] = numbers[..] else { panic!("{line}") };
        writeln!(text, "{:.2} {:.2} {frame} {id}", 100.0 * y, -100.0 * x).unwrap();
    }
    fs::write(path("guise.txt"), text).unwrap();
    let reading = [
        "--mix-unit",
        "cm",
        "--mix-fps",
        "10",
        "--mix-columns",
        "x,y,frame,id",
        "--mix-format",
        "juelich",
        "--mix-rotation",
        "90",
    ];
    let with = |other: &str, out: &str, reading: &[&str]| {
        let arguments = [&["dance.txt", "--fps", "10", "--unit", "m", "--mix", other, "-o", out], reading].concat();
        let (_, said) = done(folder.path(), &arguments);
        assert_eq!(said.matches("warning").count(), 0, "{said}");
        read(&path(out))
    };
    let (plain, guised) = (with("dance.txt", "plain.txt", &[]), with("guise.txt", "guised.txt", &reading));
    for moment in 0..plain.moments() {
        let both = plain.places_at(moment).iter().zip(guised.places_at(moment));
        assert!(both.fold(0.0, |most: f64, (a, b)| most.max(a.distance(*b))) < 1e-3);
    }
    // What is said of it names the options that are about it.
    let (_, said) =
        done(folder.path(), &["dance.txt", "--mix", "guise.txt", "--mix-columns", "x,y,frame,id", "--mix-fps", "10"]);
    assert!(said.contains("--mix-unit overrides it") && !said.contains("--unit"), "{said}");
    let (_, said) = refused(folder.path(), &["dance.txt", "--mix", "guise.txt", "--mix-columns", "who"]);
    assert!(said.contains("hint:") && said.contains("--mix-columns id,frame,x,y"), "{said}");
    let (_, said) = refused(folder.path(), &["dance.txt", "--mix", "dance.txt", "--mix-from", "90", "--mix-to", "95"]);
    assert!(said.contains("leave out its start and end"), "{said}");
    let (code, said) = refused(folder.path(), &["dance.txt", "--mix-unit", "cm"]);
    assert!(code == 2 && said.contains("--mix <OTHER>"), "{said}");
}

#[test]
fn a_table_alone_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    dance(&folder.path().join("dance.txt"));
    assert_eq!(done(folder.path(), &["dance.txt"]).1, "");
    let (_, warning) = done(folder.path(), &["dance.txt", "--components", "2"]);
    assert!(warning.contains("nothing is written"), "{warning}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn mistakes_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    dance(&path("dance.txt"));
    recording(&path("one.txt"), 1, 20, |_, t| Some(vec2(t, 0.0)));
    recording(&path("blink.txt"), 5, 1, |id, _| Some(vec2(f64::from(id), 0.0)));
    recording(&path("rigid.txt"), 5, 20, |id, t| Some(vec2(f64::from(id) + t, 0.0)));
    recording(&path("relay.txt"), 5, 50, |id, t| ((t as u32) + 1 == id).then(|| vec2(t, 0.0)));
    for (arguments, code, what) in [
        (&["dance.txt", "--scale", "1=sin(2*pi*t"] as &[&str], 2, "    ^ column 4"),
        (&["dance.txt", "--scale", "all=2*speed"], 2, "speed is not a known name"),
        (&["dance.txt", "--scale", "5..2=1"], 2, "ends before it starts"),
        (&["dance.txt", "--scale", "2.0"], 2, "no ="),
        (&["dance.txt", "--scale", "1=1/(t-2)", "-o", "x.txt"], 1, "at t = 2.000 s"),
        (&["dance.txt", "--scale", "99=1"], 1, "there are 1 to 22"),
        (&["dance.txt", "-k", "0"], 1, "0 components; there are 1 to 22"),
        (&["dance.txt", "-k", "23"], 1, "23 components"),
        (&["dance.txt", "--neighbour-distance", "0"], 2, "allowed is 0.05 to 10000"),
        (&["dance.txt", "--from", "90", "--to", "95"], 1, "leave out its start and end"),
        (&["one.txt"], 1, "at least 2 are needed"),
        (&["blink.txt"], 1, "2 frames"),
        (&["rigid.txt"], 1, "do not move relative to the centroid"),
        (&["relay.txt"], 1, "at least 2 are needed"),
        (&["dance.txt", "--mix", "one.txt"], 1, "at least 2 are needed"),
        (&["dance.txt", "--mix", "rigid.txt"], 1, "do not move relative"),
        (&["dance.txt", "--middle", "both"], 2, "--mix"),
        (&["dance.txt", "-o", "-", "--json"], 2, "standard output"),
    ] {
        let (exit, said) = refused(folder.path(), arguments);
        assert!(exit == code && said.contains(what), "{arguments:?}: {exit} {said}");
    }
    // The time that would do is named.
    corridor(&path("corridor.txt"));
    let (_, said) = refused(folder.path(), &["corridor.txt", "--from", "0", "--to", "29"]);
    assert!(said.contains("the most people are present for longest"), "{said}");
}
