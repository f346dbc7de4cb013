//! Bakes in parts: `bake --part-of` and `merge`.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use image::{Rgb, RgbImage};

use super::sandbox::Sandbox;

/// Six days of a corridor, mopped between them, with an image of the floor that lies beside the scenario.
const SCENARIO: &str = "\
[plan]
image = \"plan.png\"
metres_per_pixel = 0.1

[texture]
floor_texels_per_metre = 20
wall_texels_per_metre = 30
tile = 256

[crowd]
people = 12
seed = 5
days = 6

[look.floor]
image = \"tile.png\"
";

fn corridor() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let tile = RgbImage::from_fn(16, 16, |x, y| Rgb([100 + 5 * x as u8, 90 + 4 * y as u8, 80]));
    tile.save(sandbox.path("tile.png")).unwrap();
    sandbox.write("plan.toml", SCENARIO);
    sandbox
}

/// Bakes these days to `parts`.
fn bake(sandbox: &Sandbox, days: &str) {
    sandbox.run(&["bake", "plan.toml", "--days", days, "--part-of", "parts"]).succeeds();
}

/// All files of a bake. Of its report, what does not differ from run to run.
fn files(sandbox: &Sandbox, bake: &str) -> BTreeMap<PathBuf, Vec<u8>> {
    let folder = sandbox.path(bake);
    let contents = sandbox.contents().into_iter();
    let within = contents.filter_map(|(path, bytes)| Some((path.strip_prefix(&folder).ok()?.to_path_buf(), bytes)));
    let mut files: BTreeMap<PathBuf, Vec<u8>> = within.collect();
    let report = files.get_mut(&PathBuf::from("report.json")).unwrap();
    let mut json: serde_json::Value = serde_json::from_slice(report).unwrap();
    (json["seconds"], json["peak_memory_mib"]) = (0.into(), 0.into());
    *report = json.to_string().into_bytes();
    files
}

#[track_caller]
fn assert_same_bakes(sandbox: &Sandbox, one: &str, other: &str) {
    let [one, other] = [one, other].map(|bake| files(sandbox, bake));
    assert!(one.len() > 40, "{:?}", one.keys());
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (file, bytes) in &one {
        assert!(other[file] == *bytes, "{} differs", file.display());
    }
}

#[test]
fn three_parts_give_the_bytes_of_one_bake() {
    let sandbox = corridor();
    sandbox.run(&["bake", "plan.toml", "-o", "whole", "--threads", "2"]).succeeds();
    // In another order and with other threads, and of a scheduler's form.
    for (days, threads) in [("6-6", "1"), ("1..2", "2"), ("3..5", "1")] {
        let run = ["bake", "plan.toml", "--days", days, "--part-of", "parts", "--threads", threads];
        sandbox.run(&run).succeeds();
    }
    sandbox.run(&["merge", "parts", "-o", "merged"]).succeeds();
    assert_same_bakes(&sandbox, "whole", "merged");
    // The merged bake is one like any other.
    sandbox.run(&["resolve", "merged", "-o", "resolved"]).succeeds();
    assert_same_bakes(&sandbox, "resolved", "whole");
}

/// What the command line says goes into the part, and a part is merged where its inputs have moved to.
#[test]
fn parts_remember_the_command_line_and_may_move() {
    let sandbox = corridor();
    let bake = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--quick", "--people", "9", "--seed", "3"];
    let with = |more: &[&'static str]| [&bake[..], &["--target", "unreal", "--floor-only"], more].concat();
    sandbox.run(&with(&["--days", "3", "-o", "whole"])).succeeds();
    for days in ["1..1/3", "2..3/3"] {
        sandbox.run(&with(&["--days", days, "--part-of", "parts"])).succeeds();
    }
    fs::create_dir(sandbox.path("moved")).unwrap();
    fs::rename(sandbox.path("plan.png"), sandbox.path("moved/plan.png")).unwrap();
    let files = ["parts/days_00002-00003.part", "parts/days_00001-00001.part"];
    let merge = |more: &[&'static str]| sandbox.run(&[&["merge"][..], &files, &["-o", "merged"], more].concat());
    merge(&[]).fails(2, &["parts/days_00001-00001.part", "plan.png", "--inputs"]);
    merge(&["--inputs", "moved"]).succeeds();
    let [whole, merged] = ["whole", "merged"].map(|bake| self::files(&sandbox, bake));
    assert!(whole == merged && whole.len() > 10);
}

#[test]
fn missing_days_may_still_come() {
    let sandbox = corridor();
    let merge = || sandbox.run(&["merge", "parts", "-o", "merged"]);
    merge().fails(1, &["parts: no part has any day", "hint: bake these days"]);
    bake(&sandbox, "2..3");
    merge().fails(1, &["parts: no part has the days 1..1, 4..6 of 6", "hint: bake these days"]);
    fs::create_dir(sandbox.path("empty")).unwrap();
    sandbox.run(&["merge", "empty", "-o", "merged"]).fails(1, &["empty: no part has any day"]);
    bake(&sandbox, "1..1");
    bake(&sandbox, "4..6");
    merge().succeeds();
}

#[test]
fn a_day_counts_once() {
    let sandbox = corridor();
    for days in ["1..3", "3..6"] {
        bake(&sandbox, days);
    }
    let merge = sandbox.run(&["merge", "parts", "-o", "merged"]);
    merge.fails(2, &["parts/days_00003-00006.part: day 3 is in parts/days_00001-00003.part too", "hint: remove one"]);
}

#[test]
fn parts_of_another_scenario_plan_or_version_are_refused() {
    let sandbox = corridor();
    bake(&sandbox, "1..3");
    let merge = || sandbox.run(&["merge", "parts", "-o", "merged"]);
    let run = ["bake", "plan.toml", "--days", "4..6", "--part-of", "parts", "--people", "13"];
    sandbox.run(&run).succeeds();
    let of = [
        "parts/days_00004-00006.part",
        "another scenario: `crowd.people` is 13, not 12",
        "parts/days_00001-00003.part",
    ];
    merge().fails(2, &of);
    // It is not taken for the part that is asked for, unless it shall be replaced.
    let again = &["bake", "plan.toml", "--days", "4..6", "--part-of", "parts"][..];
    sandbox.run(again).fails(2, &["`crowd.people` is 13, not 12", "--force"]);
    sandbox.run(&[again, &["--force"]].concat()).succeeds();

    // Of an older version.
    let path = sandbox.path("parts/days_00004-00006.part");
    let now = fs::read(&path).unwrap();
    let version = format!("\"version\":\"{}\"", env!("CARGO_PKG_VERSION"));
    let at = now.windows(version.len()).position(|bytes| bytes == version.as_bytes()).unwrap();
    let older = [&now[..at], b"\"version\":\"0.0.9\"", &now[at + version.len()..]].concat();
    fs::write(&path, older).unwrap();
    merge().fails(2, &["days_00004-00006.part", "it is of trodden 0.0.9", "hint: bake it again"]);
    fs::write(&path, now).unwrap();

    // Of another plan.
    let mut plan = image::open(sandbox.path("plan.png")).unwrap().to_luma8();
    plan.put_pixel(40, 20, image::Luma([0]));
    plan.save(sandbox.path("plan.png")).unwrap();
    merge().fails(2, &["it is of another plan.png", "hint: bake the parts again"]);
    sandbox.run(again).fails(2, &["it is of another plan.png"]);
}

#[test]
fn a_part_that_is_there_is_not_baked_again() {
    let sandbox = corridor();
    bake(&sandbox, "1..2");
    let path = sandbox.path("parts/days_00001-00002.part");
    let first = fs::read(&path).unwrap();
    let ran = sandbox.run(&["bake", "plan.toml", "--days", "1..2", "--part-of", "parts"]).succeeds();
    assert!(ran.out.contains("is there already"), "{}", ran.out);
    // A copy that was cut short, or that a disk has bent, is none.
    let mut bent = first.clone();
    bent[first.len() - 40] ^= 1;
    for damaged in [&first[..first.len() - 1], &first[..first.len() / 2], &bent] {
        fs::write(&path, damaged).unwrap();
        let merge = ["merge", "parts", "-o", "merged"];
        bake(&sandbox, "3..6");
        sandbox.run(&merge).fails(1, &["days_00001-00002.part"]);
        bake(&sandbox, "1..2");
        assert!(fs::read(&path).unwrap() == first);
    }
}

#[test]
fn two_attempts_at_one_part_do_no_harm() {
    let sandbox = corridor();
    let run = ["bake", "plan.toml", "--days", "1..6", "--part-of", "parts", "-q"];
    let mut attempts: Vec<_> = (0..3).map(|_| sandbox.command(&run).spawn().unwrap()).collect();
    assert!(attempts.iter_mut().all(|attempt| attempt.wait().unwrap().success()));
    let names: Vec<_> = fs::read_dir(sandbox.path("parts")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["days_00001-00006.part"]);
    sandbox.run(&["merge", "parts", "-o", "merged"]).succeeds();
}

#[test]
fn a_killed_part_leaves_nothing_that_is_merged() {
    let sandbox = corridor();
    bake(&sandbox, "1..3");
    let run = ["bake", "plan.toml", "--people", "200000", "--days", "4..6", "--part-of", "parts"];
    let mut child = sandbox.command(&run).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success());
    sandbox.run(&["merge", "parts", "-o", "merged"]).fails(1, &["no part has the days 4..6 of 6"]);
    bake(&sandbox, "4..6");
    sandbox.run(&["merge", "parts", "-o", "merged"]).succeeds();
}

#[test]
fn mistakes_are_told_with_an_exit_code_that_says_whether_to_try_again() {
    let sandbox = corridor();
    let part = |more: &[&'static str]| sandbox.run(&[&["bake", "plan.toml", "--part-of", "parts"][..], more].concat());
    part(&["--days", "5..9"]).fails(2, &["no days 5 to 9: it has 6", "hint: give days from 1 to 6"]);
    part(&["--days", "5..4"]).fails(2, &["no days 5 to 4"]);
    part(&["--days", "x..4"]).fails(2, &["--days", "17..32/160"]);
    part(&["-o", "out"]).fails(2, &["--output"]);
    sandbox.run(&["bake", "plan.toml", "--days", "1..2"]).fails(2, &["--part-of"]);
    sandbox.write("wrong.toml", "[crowd]\npeple = 3\n");
    sandbox.run(&["bake", "wrong.toml", "--part-of", "parts"]).fails(2, &["peple"]);
    sandbox.run(&["bake", "gone.toml", "--part-of", "parts"]).fails(1, &["gone.toml"]);
    sandbox.write("file", "");
    sandbox.run(&["bake", "plan.toml", "--part-of", "file/parts"]).fails(1, &["file/parts"]);
    sandbox.write("notes.part", "no part\n");
    sandbox.run(&["merge", "notes.part", "-o", "out"]).fails(2, &["notes.part: it is not a part of a bake"]);
    // An earlier bake stays.
    bake(&sandbox, "1..6");
    let merge = &["merge", "parts", "-o", "out"][..];
    sandbox.run(merge).succeeds();
    sandbox.run(merge).fails(2, &["out", "earlier bake", "--force"]);
    sandbox.run(&[merge, &["--force"]].concat()).succeeds();
}

#[cfg(unix)]
#[test]
fn an_interrupted_part_leaves_nothing() {
    let sandbox = corridor();
    let before = sandbox.contents();
    let run = ["bake", "plan.toml", "--people", "200000", "--part-of", "parts"];
    let piped = std::process::Stdio::piped;
    let child = sandbox.command(&run).stdout(piped()).stderr(piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let kill = ["-INT", &child.id().to_string()];
    assert!(std::process::Command::new("kill").args(kill).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    sandbox.ran(before, output).fails(130, &["interrupted"]);
}

/// `tests/openjd/run` and `tests/slurm/run` run what is written here.
#[test]
fn a_job_is_written_for_a_farm_and_a_cluster() {
    let sandbox = corridor();
    let job = |more: &[&'static str]| sandbox.run(&[&["job", "plan.toml"][..], more].concat());
    job(&["--parts", "4", "--openjd", "farm", "--slurm", "cluster", "--", "--seed", "3", "--use", "home"]).succeeds();
    let text = |name: &str| fs::read_to_string(sandbox.path(name)).unwrap();
    let template = text("farm/template.yaml");
    for part in
        ["range: \"1-6\"", "defaultTaskCount: 2", "{{Task.Param.Days}}/6", "default: \"plan.toml\"", "- \"home\""]
    {
        assert!(template.contains(part), "no {part} in {template}");
    }
    let script = text("cluster/bake.sbatch");
    for part in ["--array=0-3\n", "part * 6 / 4 + 1", "/plan.toml --days", "--seed 3 --use home\n"] {
        assert!(script.contains(part), "no {part} in {script}");
    }
    assert!(text("cluster/submit").contains("[ 4 -gt "));
    for name in ["farm/template.yaml", "cluster/bake.sbatch", "cluster/merge.sbatch", "cluster/submit"] {
        let is_open = |key| text(name).contains(&format!("@{key}@"));
        let keys = ["NAME", "SCENARIO", "DAYS", "PARTS", "LAST", "CHUNK", "OPTIONS"];
        assert!(!keys.into_iter().any(is_open), "{name} is not filled in");
    }

    job(&["--parts", "4", "--openjd", "farm"]).fails(1, &["farm/template.yaml", "--force"]);
    job(&["--parts", "4", "--openjd", "farm", "--force", "--days", "9"]).succeeds();
    assert!(text("farm/template.yaml").contains("range: \"1-9\""));
    job(&["--parts", "7", "--openjd", "more"]).fails(2, &["7 parts of 6 days; allowed are 1 to 6"]);
    job(&["--parts", "2"]).fails(2, &["--openjd", "--slurm"]);
    job(&["--parts", "2", "--openjd", "more", "--", "--output", "x"]).fails(2, &["--output"]);
    job(&["--parts", "2", "--openjd", "more", "--", "--motion", "x"]).fails(2, &["--motion"]);
}

/// Lines that Open Job Description reads from standard output.
#[test]
fn a_farm_is_told_of_progress_and_failures_in_its_form() {
    let sandbox = corridor();
    let run = ["bake", "plan.toml", "--days", "1..2", "--part-of", "parts", "--messages", "openjd"];
    let out = sandbox.run(&run).succeeds().out;
    assert!(out.starts_with("openjd_status: ") && out.contains("\nopenjd_progress: 100\n"), "{out}");
    let ran = sandbox.run(&["merge", "parts", "-o", "out", "--messages", "openjd"]);
    assert_eq!((ran.code, &*ran.out), (Some(1), "openjd_fail: parts: no part has the days 3..6 of 6\n"));
}
