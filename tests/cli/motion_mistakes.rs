//! What goes wrong with motions: each time one clear error with the file, the place and a hint, and nothing written.

use std::io::Write;

use super::motion::walk;
use super::sandbox::Sandbox;

/// All that read a recording; each would write or replace a file.
const READERS: [&[&str]; 6] = [
    &["motion", "info", "FILE", "--paths", "earlier.png", "--force"],
    &["motion", "convert", "FILE", "-o", "earlier.txt", "--animation", "a.gif", "--force"],
    &["motion", "formation", "--example", "FILE", "--last", "points.txt", "-o", "new.csv"],
    &["motion", "features", "FILE", "-o", "earlier.txt", "--force"],
    &["motion", "units", "FILE", "--at", "1,1", "--heading-deg", "0", "-o", "units"],
    &["bake", "--motion", "FILE", "-o", "out", "--force"],
];

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("walk.txt", walk());
    sandbox.write("points.txt", "0 0\n1 0\n2 0\n3 0\n4 0\n");
    for name in ["earlier.txt", "earlier.png"] {
        sandbox.write(name, "three years of work");
    }
    sandbox
}

#[track_caller]
fn refused_by(readers: &[&[&str]], sandbox: &Sandbox, file: &str, parts: &[&str]) {
    for reader in readers {
        let arguments: Vec<&str> = reader.iter().map(|word| if *word == "FILE" { file } else { word }).collect();
        sandbox.run(&arguments).fails(1, &[&[file, "hint: "], parts].concat());
    }
}

/// Everybody refuses a file with this content.
#[track_caller]
fn refused(content: impl AsRef<[u8]>, parts: &[&str]) {
    let sandbox = sandbox();
    sandbox.write("bad.txt", content);
    refused_by(&READERS, &sandbox, "bad.txt", parts);
}

fn packed(text: &str) -> Vec<u8> {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(text.as_bytes()).unwrap();
    packed.finish().unwrap()
}

#[test]
fn files_without_anybody() {
    refused("", &["the recording is empty: the file has no content"]);
    refused("# framerate: 10\n# id frame x/m y/m\n", &["is empty: there is nothing but comments"]);
    refused("id,time,x,y\n", &["is empty: there is a header, but nothing behind it"]);
    refused("id,time,x,y\n1,0,nan,nan\n1,1,,\n", &["is empty: nobody has a place"]);
}

#[test]
fn files_that_are_cut_off_or_damaged() {
    let whole = packed(&walk());
    refused(&whole[..whole.len() / 2], &["the compressed file breaks off", "gzip -dc"]);
    refused(&whole[..3], &["the compressed file breaks off"]);
    let mut damaged = whole.clone();
    damaged[10..40].fill(0xff);
    refused(&damaged, &["the compressed file is damaged"]);

    let sandbox = sandbox();
    sandbox.run(&["motion", "convert", "walk.txt", "-o", "whole.sqlite", "-q"]).succeeds();
    let whole = std::fs::read(sandbox.path("whole.sqlite")).unwrap();
    for length in [50, 4096, whole.len() / 2] {
        sandbox.write("bad.sqlite", &whole[..length]);
        refused_by(&READERS[..2], &sandbox, "bad.sqlite", &["the database cannot be read: "]);
    }
}

/// A text that was cut off is read up to there, and said to be cut off.
#[test]
fn texts_that_are_cut_off() {
    let sandbox = sandbox();
    let whole = walk();
    for cut in 1..12 {
        // Into the height, which nobody needs, and beyond: what is left of that row cannot be trusted.
        sandbox.write("bad.txt", &whole[..whole.len() - cut]);
        let ran = sandbox.run(&["motion", "info", "bad.txt"]).succeeds();
        let lost = cut > 3;
        assert!(ran.out.contains(if lost { "5, 299 places" } else { "5, 300 places" }), "{cut}: {}", ran.out);
        assert_eq!(ran.err.contains("warning: the file breaks off in line 302"), lost, "{cut}: {}", ran.err);
    }
}

#[test]
fn rates_that_are_none_or_that_nothing_tells() {
    let rows = "1 0 0 0\n1 1 0.1 0\n1 2 0.2 0\n";
    for rate in ["0", "-25", "1e9", "nan", "fast"] {
        let text = format!("# framerate: {rate}\n{rows}");
        refused(&text, &["bad.txt, line 1: the frame rate is ", "allowed is above 0, up to 10000", "--fps"]);
        // As the hint says.
        let sandbox = sandbox();
        sandbox.write("bad.txt", &text);
        let ran = sandbox.run(&["motion", "info", "bad.txt", "--fps", "10"]).succeeds();
        assert!(ran.out.contains("0.20 s, 3 moments, 10 frames per second"), "{}", ran.out);
    }
    refused("1 0 5 5\n1 1 5 5\n2 0 3 3\n2 1 3 3\n", &["nothing tells how many frames make a second", "--fps"]);
}

/// Readable, but hardly true: said in a warning with the option that helps.
#[test]
fn headers_that_lie() {
    let warned = |text: String, parts: &[&str]| {
        let sandbox = sandbox();
        sandbox.write("odd.txt", text);
        let ran = sandbox.run(&["motion", "info", "odd.txt"]).succeeds();
        parts.iter().for_each(|part| assert!(ran.err.contains(part), "no {part:?} in {}", ran.err));
        assert!(ran.err.starts_with("warning: "), "{}", ran.err);
    };
    warned(
        walk().replace("framerate: 10", "framerate: 1000"),
        &["faster than 133", "--unit overrides metres, --fps 1000 frames per second"],
    );
    warned(walk().replace("x/m y/m", "x/furlong y/m"), &["the unit `furlong` is unknown", "--unit"]);
    warned(walk().replace("x/m y/m", "x/mm y/mm"), &["slower than 0.001 m/s", "--unit"]);
}

#[test]
fn places_that_are_none() {
    let row = |row: &str| format!("# framerate: 10\n# id frame x/m y/m\n1 0 0 0\n1 1 0.1 0\n{row}\n1 3 0.3 0\n");
    refused(row("1 2 inf 0"), &["bad.txt, line 5: x is `inf`; allowed is up to 1e15", "nan"]);
    refused(row("1 2 0 -1e300"), &["bad.txt, line 5: y is `-1e300`; allowed is up to 1e15"]);
    refused(row("1 2 here 0"), &["bad.txt, line 5: x is `here`, which is no number", "--columns"]);
    refused(row("1 2.5 0 0"), &["bad.txt, line 5: the frame is `2.5`: frames are whole numbers", "time"]);
    refused(row("1 2 0"), &["bad.txt, line 5: 3 columns instead of at least 4", "--columns"]);
    let twice = "person 1 is at (0.100, 0.000) and at (5.000, 5.000) at frame 1";
    refused(row("1 1 5 5"), &["bad.txt, line 5: ", twice, "ids must be different"]);
    let sandbox = sandbox();
    sandbox.write("gap.txt", row("1 2 nan nan"));
    let ran = sandbox.run(&["motion", "info", "gap.txt"]).succeeds();
    assert!(ran.err.contains("warning: the row in line 5 has no place"), "{}", ran.err);
}

#[test]
fn files_of_other_kinds() {
    let sandbox = sandbox();
    image::GrayImage::new(64, 64).save(sandbox.path("picture.png")).unwrap();
    refused_by(&READERS, &sandbox, "picture.png", &["this is no recording of people: it is no text"]);
    refused("{\"people\": []}", &["it is JSON", "CSV with columns id, time, x, y"]);
    refused("<people/>", &["it is XML"]);
    refused("dear diary,\ntoday I walked\n", &["bad.txt, line 1"]);
    refused_by(&READERS, &sandbox, "nowhere.txt", &["No such file", "paths start from"]);
    std::fs::create_dir(sandbox.path("folder")).unwrap();
    refused_by(&READERS, &sandbox, "folder", &["Is a directory", "name a file"]);
}

#[test]
fn lines_without_end() {
    refused("1 ".repeat(2 << 20), &["bad.txt, line 1: the line is longer than 1048576 bytes"]);
    refused(format!("id,time,x,y\n1,0,{},0\n", "1".repeat(3 << 20)), &["bad.txt, line 2: the line does not end"]);
    let late = format!("id,time,x,y\n{}1,9,{},0\n", "1,0,0,0\n".repeat(200_000), "1".repeat(3 << 20));
    let sandbox = sandbox();
    sandbox.write("late.csv", late);
    refused_by(&READERS[..1], &sandbox, "late.csv", &["late.csv, line 200002: the line is longer than 1048576 bytes"]);
}

/// Large ids are names, times may run backwards: both are read.
#[test]
fn what_looks_odd_but_is_fine() {
    let sandbox = sandbox();
    sandbox.write("ids.csv", "id,time,x,y\n4e15,0,0,0\n9999999999999999,0,3,3\n4e15,1,1,0\n9999999999999999,1,3,4\n");
    let ran = sandbox.run(&["motion", "info", "ids.csv"]).succeeds();
    assert!(ran.out.contains("people     2, 4 places"), "{}", ran.out);
    sandbox.write("back.csv", "id,time,x,y\n1,3,3,0\n1,2,2,0\n1,1,1,0\n");
    let ran = sandbox.run(&["motion", "convert", "back.csv", "-o", "-", "--as", "crowdit", "-q"]).succeeds();
    assert_eq!(ran.out, "time,pedID,posX,posY\n0.00,1,1.0000,0.0000\n1.00,1,2.0000,0.0000\n2.00,1,3.0000,0.0000\n");
}

#[test]
fn options_that_make_no_sense() {
    let sandbox = sandbox();
    for (option, values) in [
        ("--fps", &["0", "-3", "nan", "inf", "1e9", "x"][..]),
        ("--unit", &["furlong", ""]),
        ("--format", &["xml"]),
        ("--rotation", &["nan", "361", "x"]),
        ("--shift", &["1", "1,nan", "1,2,3", "inf,0"]),
        ("--origin", &["", "x,y"]),
    ] {
        for value in values {
            sandbox.run(&["motion", "info", "walk.txt", option, value]).fails(2, &[option]);
        }
    }
    for columns in ["id,frame,x", "id,frame,x,y,hat", "id,frame,x,x,y", ""] {
        let parts = ["columns = ", "hint: name the columns in order with --columns id,frame,x,y"];
        sandbox.run(&["motion", "info", "walk.txt", "--columns", columns]).fails(1, &parts);
    }
    sandbox.run(&["motion", "info", "walk.txt", "--format", "jupedsim"]).fails(1, &["no SQLite database", "hint: "]);
}

#[test]
fn formations_that_cannot_be() {
    let sandbox = sandbox();
    sandbox.write("three.txt", "0 0\n1 0\n2 0\n");
    sandbox.write("word.txt", "0 0\n1 zero\n");
    sandbox.write("far.txt", "0 nan\n");
    sandbox.write("none.txt", "# nobody\n");
    image::GrayImage::from_pixel(8, 8, image::Luma([255])).save(sandbox.path("white.png")).unwrap();
    let formation = |more: &[&str]| {
        let start = ["motion", "formation", "--example", "walk.txt", "-o", "earlier.txt", "--force"];
        sandbox.run(&[&start[..], more].concat())
    };
    for (file, parts) in [
        ("three.txt", &["there are 5 people, but 3 points in three.txt"][..]),
        ("none.txt", &["but 0 points in none.txt"]),
        ("word.txt", &["word.txt, line 2: it is not a point"]),
        ("far.txt", &["far.txt, line 1: the point (0, NaN) is out of range"]),
        ("missing.txt", &["missing.txt: No such file"]),
        ("white.png", &["white.png"]),
        (".", &["."]),
    ] {
        formation(&["--last", file]).fails(1, &[&["hint: "], parts].concat());
    }
    formation(&["--key", "99=points.txt"]).fails(1, &["99 s, after the whole formation, at 5.9 s", "hint: "]);
    formation(&["--key", "2=points.txt", "--key", "2=points.txt"]).fails(1, &["2 s is not after", "hint: "]);
    formation(&["--span", "100,200", "--last", "points.txt"]).fails(1, &["no person is present", "hint: "]);
    formation(&["--key", "x=points.txt"]).fails(2, &["--key"]);
    formation(&["--span", "5,1"]).fails(2, &["--span"]);
    // All on one point is a formation too, and half a turn of a line.
    sandbox.write("point.txt", "3 3\n".repeat(5));
    sandbox.write("turned.txt", "4 0\n3 0\n2 0\n1 0\n0 0\n");
    for last in ["point.txt", "turned.txt"] {
        formation(&["--first", "points.txt", "--last", last, "--in-order", "-q"]).succeeds();
        let info = sandbox.run(&["motion", "info", "earlier.txt", "--json"]).succeeds();
        let json: serde_json::Value = serde_json::from_str(&info.out).unwrap();
        assert_eq!(json["people"], 5, "{last}: {}", info.out);
    }
}

#[test]
fn one_person_alone() {
    let sandbox = sandbox();
    let text: String = (0..20).map(|k| format!("1,0.{k:02},0.{:03},0\n", 13 * k)).collect();
    sandbox.write("one.csv", format!("id,time_s,x,y\n{text}"));
    sandbox.run(&["motion", "features", "one.csv"]).fails(1, &["at least 2 are needed", "hint: "]);
    sandbox.run(&["motion", "formation", "keys", "one.csv"]).fails(1, &["at least 2 are needed", "hint: "]);
    sandbox.write("goal.txt", "5 5\n");
    sandbox.run(&["motion", "formation", "--example", "one.csv", "--last", "goal.txt", "-o", "led.txt"]).succeeds();
}

#[test]
fn key_formations_that_cannot_be_found() {
    let sandbox = sandbox();
    let keys = |more: &[&str]| sandbox.run(&[&["motion", "formation", "keys"][..], more].concat());
    keys(&["nowhere.txt"]).fails(1, &["nowhere.txt", "hint: "]);
    keys(&["walk.txt", "--span", "50,60"]).fails(1, &["from 50.00", "hint: "]);
    keys(&["walk.txt", "--span", "1,1.01"]).fails(1, &["one moment"]);
    keys(&["walk.txt", "--most", "1"]).fails(2, &["--most", "2..=100"]);
    keys(&["walk.txt", "--off", "-1"]).fails(2, &["--off"]);
    keys(&["walk.txt", "-o", "walk.txt", "--force"]).fails(1, &["walk.txt"]);
    keys(&["walk.txt", "--example", "walk.txt"]).fails(2, &["--example"]);
    sandbox.run(&["motion", "formation"]).fails(2, &["SCENARIO"]);
}

#[test]
fn expressions_and_units_that_do_not_work() {
    let sandbox = sandbox();
    for expression in ["all=sin(", "all=foo(t)", "all=1+", "0=1", "x=2", "all"] {
        let arguments = ["motion", "features", "walk.txt", "--scale", expression, "-o", "earlier.txt", "--force"];
        sandbox.run(&arguments).fails(2, &["--scale"]);
    }
    let units = |more: &[&str]| sandbox.run(&[&["motion", "units"][..], more].concat());
    units(&["walk.txt", "--at", "900,900", "--heading-deg", "0", "-o", "cut"])
        .fails(1, &["no unit found at [900.00, 900.00]", "hint: "]);
    units(&["walk.txt", "--at", "3,5", "--towards", "3,5"]).fails(1, &["--towards is the same point as --at"]);
    units(&["walk.txt", "--at", "nan,5", "--towards", "3,5"]).fails(2, &["--at"]);
    units(&["--list", "nowhere"]).fails(1, &["nowhere", "hint: "]);
}

#[test]
fn results_that_cannot_be_written() {
    let sandbox = sandbox();
    std::fs::create_dir(sandbox.path("folder.csv")).unwrap();
    for name in ["x.txt", "x.csv.gz", "x.traj", "x.db"] {
        let name = format!("no/{name}");
        sandbox.run(&["motion", "convert", "walk.txt", "-o", &name]).fails(1, &[&name, "hint: make its folder first"]);
    }
    sandbox.run(&["motion", "convert", "walk.txt", "-o", "folder.csv", "--force"]).fails(1, &["is a folder", "hint: "]);
    sandbox.run(&["motion", "convert", "walk.txt", "-o", "earlier.txt"]).fails(1, &["exists already", "hint: --force"]);
    let both = ["motion", "info", "walk.txt", "--paths", "earlier.png"];
    sandbox.run(&both).fails(1, &["earlier.png exists already", "hint: --force"]);
    sandbox.run(&["motion", "info", "walk.txt", "--paths", "/proc/a.png"]).fails(1, &["/proc/a.png", "hint: "]);
    let itself = ["motion", "convert", "walk.txt", "-o", "walk.txt", "--force", "-q"];
    sandbox.run(&itself).fails(1, &["walk.txt", "the same run reads it", "hint: "]);
    sandbox.run(&["motion", "info", "walk.txt"]).succeeds();
}

/// A limit on the size of files stops a write halfway, as a full disk does.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_what_was_there() {
    let sandbox = sandbox();
    let noise = |k: u32| f64::from(k.wrapping_mul(2_654_435_761) >> 16) / 1e4;
    let rows: String = (0..6000).map(|k| format!("1,{k},{},{}\n", noise(k), noise(k + 7))).collect();
    sandbox.write("long.csv", format!("id,time_s,x,y\n{rows}"));
    for name in ["a.txt", "a.csv", "a.csv.gz", "a.traj", "a.traj.gz", "a.sqlite"] {
        sandbox.write(name, "three years of work");
        let script = "trap '' XFSZ; ulimit -f 16; exec \"$0\" \"$@\"";
        let mut command = std::process::Command::new("bash");
        command.args(["-c", script, env!("CARGO_BIN_EXE_trodden"), "motion", "convert", "long.csv", "-q", "--force"]);
        command.args(["-o", name]).current_dir(sandbox.path(""));
        sandbox.run_command(&mut command).fails(1, &["cannot write", name]);
    }
}
