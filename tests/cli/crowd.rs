//! `trodden crowd`: the motion, the animation and the picture of the paths.

use std::fs;
use std::process::Stdio;

use super::sandbox::{Ran, Sandbox};

/// A crowd that takes next to no time.
const QUICK: [&str; 6] = ["crowd", "plan.png", "--metres-per-pixel", "0.1", "--people", "5"];

fn quick<'a>(more: &[&'a str]) -> Vec<&'a str> {
    QUICK.iter().chain(more).copied().collect()
}

fn run(sandbox: &Sandbox, more: &[&str]) -> Ran {
    sandbox.run(&quick(more))
}

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox
}

#[test]
fn the_motion_is_written_and_summed_up() {
    let sandbox = sandbox();
    let ran = run(&sandbox, &["-o", "paths.txt"]).succeeds();
    assert_eq!((ran.err.as_str(), ran.made().len()), ("", 1));
    let lines: Vec<&str> = ran.out.lines().collect();
    assert!(
        lines[0].starts_with("5 people walked, 5 arrived; ") && lines[0].ends_with("m/s in the mean"),
        "{}",
        ran.out
    );
    assert!(lines[1].starts_with("  paths.txt ") && lines[1].contains(" frames, 10 in a second, "), "{}", ran.out);
    assert!(lines[2].starts_with("done in "), "{}", ran.out);

    let text = fs::read_to_string(sandbox.path("paths.txt")).unwrap();
    let places: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    assert!(places.len() > 200 && places.iter().all(|line| line.split(' ').count() == 5));
    let quiet = run(&sandbox, &["-q", "--threads", "2", "-o", "again.txt"]).succeeds();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
    assert_eq!(fs::read_to_string(sandbox.path("again.txt")).unwrap(), text);
}

#[test]
fn json_says_what_was_written() {
    let sandbox = sandbox();
    let all = ["-o", "a.sqlite", "--fps", "4", "--animation", "a.gif", "--paths", "a.png", "--json"];
    let ran = run(&sandbox, &all).succeeds();
    assert_eq!(ran.made().len(), 3, "{:?}", ran.made());
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((json["people"]["arrived"].as_u64(), json["walking"].as_u64()), (Some(5), Some(0)));
    assert_eq!((json["motion"]["format"].as_str(), json["motion"]["fps"].as_f64()), (Some("jupedsim"), Some(4.0)));
    assert_eq!(json["motion"]["bytes"].as_u64().unwrap(), fs::metadata(sandbox.path("a.sqlite")).unwrap().len());
    let speed = json["mean_speed_m_s"].as_f64().unwrap();
    assert!(speed > 0.8 && speed < 1.8, "{speed}");
    let size = image::open(sandbox.path("a.gif")).unwrap().to_rgb8().dimensions();
    assert_eq!(json["animation"]["size_px"], serde_json::json!([size.0, size.1]));
    assert!(image::open(sandbox.path("a.png")).unwrap().width() > 500);
}

#[test]
fn without_a_file_only_the_summary_is_printed() {
    let sandbox = sandbox();
    let ran = run(&sandbox, &[]).succeeds();
    assert!(ran.made().is_empty() && ran.out.starts_with("5 people walked, 5 arrived; "), "{}", ran.out);
}

#[test]
fn a_dash_prints_the_motion_and_the_summary_goes_elsewhere() {
    let sandbox = sandbox();
    let ran = run(&sandbox, &["-o", "-"]).succeeds();
    assert!(ran.made().is_empty());
    assert!(ran.out.starts_with("# trodden ") && ran.out.lines().count() > 200, "{}", ran.out);
    assert!(ran.err.starts_with("5 people walked"), "{}", ran.err);
    run(&sandbox, &["-o", "-", "--json"]).fails(2, &["--output"]);
    // `trodden crowd plan.png -o - | head` closes the pipe early.
    let mut command = sandbox.command(&quick(&["-o", "-", "--seed", "3"]));
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
fn unknown_endings_are_refused_before_anybody_walks() {
    let sandbox = sandbox();
    for name in ["paths", "paths.cvs", "paths.sqlite.gz", "paths.gz", ".txt"] {
        run(&sandbox, &["-o", name]).fails(2, &["--output", ".txt, .csv, .traj, .sqlite, .sqlite3 or .db"]);
    }
    for name in ["walk", "walk.mp4"] {
        run(&sandbox, &["--animation", name]).fails(2, &["--animation", ".gif, .png or .apng"]);
    }
    run(&sandbox, &["--animation", "a.png", "--paths", "./a.png"]).fails(2, &["the same file"]);
}

#[test]
fn files_are_replaced_with_force_only() {
    let sandbox = sandbox();
    for (option, name) in [("-o", "a.txt"), ("-o", "a.db"), ("--animation", "a.gif"), ("--paths", "a.png")] {
        sandbox.write(name, "three years of work");
        run(&sandbox, &[option, name]).fails(1, &[name, "exists already", "hint: --force"]);
    }
    let all = ["-o", "a.txt", "--animation", "a.gif", "--paths", "a.png"];
    let ran = run(&sandbox, &[&all[..], &["--force"]].concat()).succeeds();
    assert!(ran.made().is_empty(), "{:?}", ran.made());
    assert!(fs::read(sandbox.path("a.gif")).unwrap().starts_with(b"GIF89a"));
    // One that exists keeps all others from being written.
    run(&sandbox, &["-o", "b.txt", "--animation", "a.gif", "--paths", "b.png"]).fails(1, &["a.gif", "exists already"]);
    run(&sandbox, &["-o", "a.txt", "--animation", "b.gif", "--paths", "b.png"]).fails(1, &["a.txt", "exists already"]);
}

#[test]
fn places_that_cannot_be_written_are_refused() {
    let sandbox = sandbox();
    sandbox.write("folder.txt/x", "");
    for (option, ending) in [("-o", "txt"), ("-o", "sqlite"), ("--animation", "gif"), ("--paths", "png")] {
        let name = format!("no/where.{ending}");
        run(&sandbox, &[option, &name]).fails(1, &[&name, "hint: make its folder first"]);
        let name = format!("/proc/where.{ending}");
        run(&sandbox, &[option, &name]).fails(1, &[&name]);
    }
    run(&sandbox, &["-o", "folder.txt", "--force"]).fails(1, &["folder.txt", "is a folder"]);
}

/// A limit on the size of files stops a write halfway, as a full disk does.
#[cfg(unix)]
#[test]
fn a_write_that_fails_halfway_leaves_what_was_there() {
    let sandbox = sandbox();
    sandbox.write("a.txt", "three years of work");
    for output in [["-o", "a.txt"], ["-o", "a.sqlite"], ["--animation", "a.gif"], ["--paths", "a.png"]] {
        let script = "trap '' XFSZ; ulimit -f 2; exec \"$0\" \"$@\"";
        let mut command = std::process::Command::new("bash");
        command.args(["-c", script, env!("CARGO_BIN_EXE_trodden")]);
        command.args(quick(&["--force"])).args(output).current_dir(sandbox.path(""));
        sandbox.run_command(&mut command).fails(1, &["cannot write", output[1]]);
    }
}

/// A file system of 128 KiB, where the system lets us make one.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said_to_be_full() {
    let sandbox = sandbox();
    fs::create_dir(sandbox.path("disk")).unwrap();
    for name in ["disk/a.txt", "disk/a.sqlite"] {
        let script = "mount -t tmpfs -o size=64k none disk || exit 77; \"$0\" \"$@\"; code=$?; ls -A disk; exit $code";
        let mut command = std::process::Command::new("unshare");
        command.args(["--user", "--map-root-user", "--mount", "bash", "-c", script, env!("CARGO_BIN_EXE_trodden")]);
        command.args(&QUICK[..4]).args(["--people", "50", "-o", name]);
        command.current_dir(sandbox.path(""));
        let Ok(output) = command.output() else { return };
        if !String::from_utf8_lossy(&output.stderr).starts_with("error: cannot write") {
            // No right to make file systems here; the test above stands in.
            assert!(matches!(output.status.code(), Some(1 | 77)), "{output:?}");
            assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"), "{output:?}");
            return;
        }
        sandbox.ran(sandbox.contents(), output).fails(1, &[name, "hint: the disk is full"]);
    }
}

#[test]
fn absurd_numbers_are_refused() {
    let sandbox = sandbox();
    for (option, with) in [
        ("--fps", ["-o", "a.txt"]),
        ("--animation-speed", ["--animation", "a.gif"]),
        ("--animation-size", ["--animation", "a.gif"]),
        ("--people", ["-o", "b.txt"]),
    ] {
        for value in ["nan", "inf", "-1", "0", "1e300", "99999999999", "many", ""] {
            sandbox.run(&[&["crowd", "plan.png", option, value][..], &with].concat()).fails(2, &[option]);
        }
    }
    run(&sandbox, &["--fps", "10"]).fails(2, &["--output"]);
    for option in [["--animation-speed", "3"], ["--animation-size", "300"], ["--animation-colour", "route"]] {
        run(&sandbox, &option).fails(2, &["--animation <FILE>"]);
    }
    run(&sandbox, &["--animation", "a.gif", "--animation-colour", "mood"]).fails(2, &["speed, route"]);
}

/// A passage for one, in which people as wide as a table meet: nobody can get past.
#[test]
fn whoever_gets_stuck_is_named_and_marked() {
    let sandbox = sandbox();
    let image = image::GrayImage::from_fn(200, 60, |x, y| {
        let wall = !(5..55).contains(&y) || (50..150).contains(&x) && !(27..33).contains(&y);
        image::Luma([if wall { 0 } else { 255 }])
    });
    image.save(sandbox.path("gap.png")).unwrap();
    sandbox.write(
        "gap.toml",
        "[plan]\nimage = \"gap.png\"\nmetres_per_pixel = 0.1\n\
         [crowd]\npeople = 12\nexclusion = 1.5\nacceptable = 1.6\nentry_seconds = 10\npatience_seconds = 20\n\
         [[route]]\nfrom = \"west\"\nto = \"east\"\n[[route]]\nfrom = \"east\"\nto = \"west\"\n",
    );
    let ran = sandbox.run(&["crowd", "gap.toml", "--paths", "ways.png", "--animation", "a.gif", "--json"]).succeeds();
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    let stuck = json["people"]["stuck_people"].as_array().unwrap();
    assert_eq!(json["people"]["stuck"].as_u64(), Some(stuck.len() as u64));
    assert!(!stuck.is_empty(), "{}", ran.out);
    let west_to_east = |one: &serde_json::Value| one["route"] == "west to east";
    let x = |one: &serde_json::Value| one["place_m"][0].as_f64().unwrap();
    assert!(stuck.iter().any(|one| west_to_east(one) && x(one) < 16.0), "{}", ran.out);
    assert!(ran.err.contains("got stuck at [") && ran.err.contains("ways.png marks the places"), "{}", ran.err);
    let picture = image::open(sandbox.path("ways.png")).unwrap().to_rgb8();
    assert!(picture.pixels().filter(|pixel| pixel.0 == [224, 20, 30]).count() > 100);

    let ran = sandbox.run(&["bake", "gap.toml", "--quick", "-o", "out"]).succeeds();
    assert!(ran.err.contains("out/preview/paths.png marks the places"), "{}", ran.err);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(sandbox.path("out/report.json")).unwrap()).unwrap();
    assert_eq!(report["people"]["stuck_people"], json["people"]["stuck_people"]);
}

/// A door of 0.8 m to which three people come in a second, in a plan whose other places are wide.
#[test]
fn more_people_than_can_pass_are_told_before_and_who_waits_while_they_stand() {
    let sandbox = sandbox();
    let image = image::GrayImage::from_fn(160, 64, |x, y| {
        let wall = !(2..62).contains(&y) || (79..81).contains(&x) && !(28..36).contains(&y);
        image::Luma([if wall { 0 } else { 255 }])
    });
    image.save(sandbox.path("door.png")).unwrap();
    let scenario = |seconds: u32| {
        format!(
            "[plan]\nimage = \"door.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 300\nentry_seconds = {seconds}\n\
             [[route]]\nfrom = \"west\"\nto = \"east\"\n"
        )
    };
    sandbox.write("many.toml", scenario(60));
    sandbox.write("few.toml", scenario(600));
    let ran = sandbox.run(&["crowd", "many.toml", "--json"]).succeeds();
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["people"]["overloads"].as_array().map(Vec::len), Some(1), "{}", ran.out);
    assert_eq!(json["people"]["standstills"].as_array().map(Vec::len), Some(1), "{}", ran.out);
    let [before, waits] = [" a second pass: the last wait ", "wait around ["].map(|said| ran.err.find(said));
    assert!(before.is_some() && before < waits, "{}", ran.err);
    assert_eq!(ran.err.matches("wait around [").count(), 1, "{}", ran.err);
    assert_eq!(sandbox.run(&["crowd", "many.toml", "-q"]).succeeds().err, "");
    let calm = sandbox.run(&["crowd", "few.toml"]).succeeds().err;
    assert!(!calm.contains("a second pass") && !calm.contains("wait around"), "{calm}");

    let ran = sandbox.run(&["bake", "many.toml", "--quick", "--floor-only", "-o", "out"]).succeeds();
    assert!(ran.err.contains(" a second pass: ") && ran.err.contains("wait around ["), "{}", ran.err);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(sandbox.path("out/report.json")).unwrap()).unwrap();
    for key in ["overloads", "standstills"] {
        assert_eq!(report["people"][key], json["people"][key]);
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_walk_leaves_nothing() {
    let sandbox = sandbox();
    let before = sandbox.contents();
    let all = ["-o", "a.sqlite", "--animation", "a.gif", "--paths", "a.png", "--people", "200000"];
    let mut command = sandbox.command(&[&["crowd", "plan.png", "--metres-per-pixel", "0.1"][..], &all].concat());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let output = child.wait_with_output().unwrap();
    // It ends by the signal, as a shell expects.
    sandbox.ran(before, output).fails(130, &["interrupted"]);
}
