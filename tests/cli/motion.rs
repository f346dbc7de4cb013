//! `trodden motion`: what goes in, what comes out, and that one tool's file is the next one's input.

use std::fs;
use std::process::Stdio;

use trodden::math::vec2;

use super::sandbox::Sandbox;

/// Five people who walk side by side along x at 1.3 m/s, 2 m apart, with some sway, for 6 s.
pub fn walk() -> String {
    let mut text = "# framerate: 10\n# id frame x/m y/m z/m\n".to_string();
    for frame in 0..60 {
        for id in 1..=5 {
            let (x, sway) = (0.13 * f64::from(frame), 0.05 * f64::from((frame * id) % 7));
            text += &format!("{id} {frame} {x:.3} {:.3} 1.7\n", 2.0 * f64::from(id) + sway);
        }
    }
    text
}

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("walk.txt", walk());
    sandbox
}

#[test]
fn a_motion_goes_from_format_to_format_and_back() {
    let sandbox = sandbox();
    let mut from = "walk.txt";
    for to in ["a.csv", "a.traj.gz", "a.sqlite", "a.csv.gz", "a.traj", "a.txt.gz", "back.txt"] {
        let ran = sandbox.run(&["motion", "convert", from, "-o", to]).succeeds();
        assert_eq!((ran.made().len(), ran.err.as_str()), (1, ""));
        let lines: Vec<&str> = ran.out.lines().collect();
        assert!(lines[0].starts_with("5 people walked, 5 arrived; 6 s in all, "), "{}", ran.out);
        assert!(
            lines[1].starts_with(&format!("  {to} ")) && lines[1].contains(" 60 frames, 10 in a second"),
            "{}",
            ran.out
        );
        let info = sandbox.run(&["motion", "info", to]).succeeds();
        // Vadere's lines are steps, one fewer than places.
        let places = if to.contains("traj") { "295" } else { "300" };
        assert!(info.out.contains(&format!("people     5, {places} places\n")), "{}", info.out);
        assert!(
            info.out.contains("time       5.90 s, ") && info.out.contains(", 10 frames per second\n"),
            "{}",
            info.out
        );
        from = to;
    }
    let [before, after] = ["walk.txt", "back.txt"].map(|name| rows(&fs::read_to_string(sandbox.path(name)).unwrap()));
    assert_eq!(before.len(), after.len());
    for (a, b) in before.iter().zip(&after) {
        assert_eq!(a[..2], b[..2]);
        assert!((a[2] - b[2]).abs() < 1e-4 && (a[3] - b[3]).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn the_format_can_be_named_and_printed() {
    let sandbox = sandbox();
    for (name, begins) in [
        ("juelich", "# trodden "),
        ("csv", "id,time_s,x_m,y_m,heading_deg,speed_m_s,height_m\n1,0.00,0.0000,2.0000,"),
        ("vadere", "pedestrianId simTime endTime-PID1 "),
        ("crowdit", "time,pedID,posX,posY\n0.00,1,"),
        ("pathfinder", "id,t,x,y\n,s,m,m\n1,0.00,"),
        ("viswalk", "$VISION\n"),
        ("obsmat", "# framerate: 10.00\n"),
    ] {
        let ran = sandbox.run(&["motion", "convert", "walk.txt", "-o", "-", "--as", name]).succeeds();
        assert!(ran.made().is_empty() && ran.out.starts_with(begins), "{name}: {}", &ran.out[..200]);
        assert!(ran.err.starts_with("5 people walked"), "{}", ran.err);
        let file = format!("{name}.file");
        sandbox.run(&["motion", "convert", "walk.txt", "-o", &file, "--as", name, "-q"]).succeeds();
        assert_eq!(fs::read_to_string(sandbox.path(&file)).unwrap(), ran.out);
        let info = sandbox.run(&["motion", "info", &file, "--json"]).succeeds();
        let json: serde_json::Value = serde_json::from_str(&info.out).unwrap();
        let places = if name == "vadere" { 295 } else { 300 };
        assert_eq!((json["format"].as_str(), json["places"].as_u64()), (Some(name), Some(places)));
    }
    for (more, problem) in [
        (&["-o", "a.gz", "--as", "jupedsim"][..], "can neither be packed by gzip nor printed"),
        (&["-o", "-", "--as", "jupedsim"], "cannot be printed"),
        (&["-o", "a.xml"], ".txt, .csv, .traj, .sqlite, .sqlite3 or .db, texts also in .gz; --as"),
        (&["-o", "a.txt", "--as", "xml"], "[possible values: juelich, "),
        (&["--as", "csv"], "--output <FILE>"),
    ] {
        let arguments = [&["motion", "convert", "walk.txt"][..], more].concat();
        sandbox.run(&arguments).fails(2, &[problem]);
    }
    let refused = sandbox.run(&["motion", "convert", "walk.txt", "-o", "a.xml"]).fails(2, &[]).err;
    assert!(refused.contains("Usage: trodden motion convert"), "{refused}");
    // `| head` closes the pipe early.
    let mut command = sandbox.command(&["motion", "convert", "walk.txt", "-o", "-", "--as", "csv"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{output:?}");
}

/// The result of one tool is the next one's input, down to the floor.
#[test]
fn tools_chain_by_files() {
    let sandbox = sandbox();
    sandbox.write("ring.txt", "0 0\n2 0\n2 2\n0 2\n1 3\n");
    let formation = ["motion", "formation", "--example", "walk.txt", "--last", "ring.txt", "-q"];
    sandbox.run(&[&formation[..], &["-o", "formed.csv.gz"]].concat()).succeeds();
    let features = ["motion", "features", "formed.csv.gz", "-k", "2", "-q", "-o", "plain.traj"];
    sandbox.run(&features).succeeds();
    let turned = ["motion", "convert", "plain.traj", "--rotation", "180", "--shift", "20,10", "-q", "-o", "turned.db"];
    sandbox.run(&turned).succeeds();
    let units = ["motion", "units", "turned.db", "--at", "16,4", "--heading-deg", "90", "--apart", "0", "-o", "cut"];
    let cut = sandbox.run(&units);
    assert!(matches!(cut.code, Some(0 | 1)), "{}", cut.err);
    let bake = ["bake", "--motion", "turned.db", "--texels-per-metre", "10", "-q", "-o", "baked"];
    sandbox.run(&bake).succeeds();
    assert!(sandbox.path("baked/floor").is_dir());
}

/// Rows `id frame x y z` of a text.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| row.split(' ').map(|field| field.parse().unwrap()).collect()).collect()
}

/// Who led people from formation to formation at 14 and 25 s is found out from their motion alone.
#[test]
fn key_formations_are_found_and_give_the_motion_back() {
    let sandbox = sandbox();
    for (pace, seed, most_m) in [("gentle", 1, 0.2), ("even", 2, 0.02)] {
        sandbox.write(
            "led.toml",
            format!(
                "[formation]\nduration_s = 40\nfps = 10\npace = \"{pace}\"\n\
                 example = {{ kind = \"sway\", people = 16, spacing_m = 1.2, seed = {seed} }}\n\
                 key = [\n{{ time_s = 0, shape = \"grid\" }},\n{{ time_s = 14, shape = \"star\", at = [8, 0] }},\n\
                 {{ time_s = 25, shape = \"line\", at = [8, 8] }},\n{{ time_s = 40, shape = \"ring\", at = [0, 8] }}]\n"
            ),
        );
        sandbox.run(&["motion", "formation", "led.toml", "-o", "led.txt", "--force", "-q"]).succeeds();
        let keys = ["motion", "formation", "keys", "led.txt", "-o", "found.toml", "--picture", "keys.png", "--json"];
        let found = sandbox.run(&[&keys[..], &["--force", "-q"]].concat()).succeeds();
        let json: serde_json::Value = serde_json::from_str(&found.out).unwrap();
        let times_s: Vec<f64> = json["times_s"].as_array().unwrap().iter().map(|time| time.as_f64().unwrap()).collect();
        println!("{pace}: {times_s:?} s, {}", json["off"]);
        for wanted_s in [0.0, 14.0, 25.0, 40.0] {
            assert!(times_s.iter().any(|time_s| (time_s - wanted_s).abs() <= 0.3), "{pace}: {times_s:?}");
        }
        assert!(times_s.len() <= 5, "{pace}: {times_s:?}");
        assert_eq!(json["pace"], pace);
        // Two keys miss it by metres.
        let off = json["off"].as_array().unwrap();
        assert!(off[0]["mean_m"].as_f64().unwrap() > 10.0 * off[off.len() - 1]["mean_m"].as_f64().unwrap());

        sandbox.run(&["motion", "formation", "found.toml", "-o", "again.txt", "--force", "-q"]).succeeds();
        let [before, after] =
            ["led.txt", "again.txt"].map(|name| rows(&fs::read_to_string(sandbox.path(name)).unwrap()));
        assert_eq!(before.len(), after.len());
        let pairs = before.iter().zip(&after);
        let apart = |(a, b): (&Vec<f64>, &Vec<f64>)| vec2(a[2], a[3]).distance(vec2(b[2], b[3]));
        let sum_m: f64 = pairs.map(apart).sum();
        let off_m = sum_m / before.len() as f64;
        println!("{pace}: {off_m:.3} m off");
        assert!(off_m < most_m, "{pace}: {off_m} m");
        assert!(image::open(sandbox.path("keys.png")).unwrap().width() > 900);
    }
}

/// Where nobody is there throughout, key formations are those of the people who are together for longest.
#[test]
fn key_formations_of_people_who_come_and_go() {
    let sandbox = Sandbox::new();
    let mut text = "# framerate: 10\n# id frame x/m y/m z/m\n".to_string();
    for frame in 0..100 {
        // Each stays for 5 s, and comes 1 s after the one before: two are together for 4 s, three for 3 s, four for 2 s.
        for id in (0..7).filter(|id| (10 * id..10 * id + 50).contains(&frame)) {
            text += &format!("{} {frame} {:.3} {id}.0 1.7\n", id + 1, 0.12 * f64::from(frame - 10 * id));
        }
    }
    sandbox.write("passers.txt", text);
    let found = sandbox.run(&["motion", "formation", "keys", "passers.txt"]).succeeds();
    assert!(found.err.contains("3 of 7 people are there from "), "{}", found.err);
    assert!(found.out.starts_with("2 key formations, at "), "{}", found.out);
}

#[test]
fn half_a_turn_is_exact() {
    let sandbox = sandbox();
    sandbox.run(&["motion", "convert", "walk.txt", "--rotation", "180", "-o", "once.csv", "-q"]).succeeds();
    sandbox.run(&["motion", "convert", "once.csv", "--rotation", "-180", "-o", "twice.csv", "-q"]).succeeds();
    sandbox.run(&["motion", "convert", "walk.txt", "-o", "never.csv", "-q"]).succeeds();
    let text = |name: &str| fs::read_to_string(sandbox.path(name)).unwrap();
    assert_eq!(text("twice.csv"), text("never.csv"));
    assert!(text("once.csv").contains("\n1,0.00,0.0000,-2.0000,"), "{}", &text("once.csv")[..200]);
}
