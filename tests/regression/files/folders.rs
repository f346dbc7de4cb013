//! Folders of bakes.

use std::collections::BTreeSet;
use std::fs;
use std::process::Stdio;
use std::sync::atomic::{AtomicU32, Ordering};

use trodden::export::{ExportError, Manifest, OutputFolder};

use super::super::sandbox::Sandbox;
use super::{FLOOR, baked, edit, quick};

const RESOLVE: [&str; 5] = ["-q", "resolve", "out", "--preset", "wet"];

/// `resolve` emptied `victim.txt`: a link of the file to itself failed, and a copy to itself begins by emptying it.
#[test]
fn paths_in_a_manifest_stay_in_the_bake() {
    let sandbox = baked();
    sandbox.write("victim.txt", "three years of work");
    let manifest = sandbox.path("out/manifest.json");
    let clean = fs::read_to_string(&manifest).unwrap();
    let absolute = sandbox.path("victim.txt").display().to_string();
    for outside in ["sums/../../victim.txt", "../victim.txt", absolute.as_str(), "C:/victim.txt", "sums\\\\victim.txt"]
    {
        for listed in ["\"preview/paths.png\"", "\"sums/floor_presence.exr\""] {
            fs::write(&manifest, clean.replace(listed, &format!("\"{outside}\""))).unwrap();
            sandbox.run(&RESOLVE).fails(1, &["manifest.json", "inside the bake", "hint: "]);
        }
        sandbox.run(&["diff", "out", "out"]).fails(2, &["inside the bake"]);
        sandbox.run(&["view", "out", "--size", "64x64"]).fails(1, &["inside the bake"]);
        sandbox.run(&quick(&["out", "--floor-only", "--force"])).fails(1, &["inside the bake"]);
    }
}

/// Links in a bake led `resolve` to files outside.
#[cfg(unix)]
#[test]
fn links_in_a_bake_do_not_lead_out_of_it() {
    use std::os::unix::fs::symlink;
    let sandbox = baked();
    // A file that is a link.
    let presence = sandbox.path("out/sums/floor_presence.exr");
    fs::rename(&presence, sandbox.path("presence.exr")).unwrap();
    symlink("../../presence.exr", &presence).unwrap();
    sandbox.run(&RESOLVE).fails(1, &["floor_presence.exr", "leads out of the bake"]);
    sandbox.run(&["view", "out", "--size", "64x64"]).fails(1, &["leads out of the bake"]);
    sandbox.run(&["diff", "out", "out"]).fails(2, &["leads out of the bake"]);
    // A folder that is a link: it is the user's, and the files behind it as well.
    let sandbox = baked();
    fs::rename(sandbox.path("out/sums"), sandbox.path("sums")).unwrap();
    symlink("../sums", sandbox.path("out/sums")).unwrap();
    sandbox.run(&RESOLVE).fails(1, &["sums", "no bake has made", "hint: "]);
    sandbox.run(&quick(&["out", "--floor-only", "--force"])).fails(1, &["sums", "no bake has made", "hint: "]);
}

/// The first of two bakes took its lock off before the folder was in its place; both bakes and the earlier one were lost.
#[test]
fn bakes_at_once_leave_a_whole_bake() {
    let sandbox = baked();
    for round in 0..5 {
        let bakes: Vec<_> = (0..8)
            .map(|number| {
                let seed = (8 * round + number + 2).to_string();
                let mut command = sandbox.command(&quick(&["out", "--floor-only", "--force", "--seed", &seed]));
                command.args(["--threads", "1"]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
            })
            .collect();
        let mut done = 0;
        for bake in bakes {
            let output = bake.wait_with_output().unwrap();
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            match output.status.code() {
                Some(0) => done += 1,
                Some(1) => assert!(text.contains("another trodden is writing to out right now"), "{text}"),
                code => panic!("{code:?}: {text}"),
            }
        }
        assert!(done > 0, "every bake found the folder in use");
        whole(&sandbox);
    }
}

/// The same without the work of a bake: folders are put in their places all the time, so that it shows within a second.
#[test]
fn folders_published_at_once_are_whole() {
    const WRITERS: u32 = 6;
    let sandbox = baked();
    let (out, earlier) = (sandbox.path("out"), Manifest::read(&sandbox.path("out")).unwrap());
    let published = AtomicU32::new(0);
    std::thread::scope(|scope| {
        for writer in 0..WRITERS {
            let (out, earlier, published) = (&out, &earlier, &published);
            scope.spawn(move || {
                while published.load(Ordering::SeqCst) < 120 {
                    let folder = match OutputFolder::begin(out, true) {
                        Err(ExportError::OutputInUse { .. }) => {
                            std::thread::yield_now();
                            continue;
                        }
                        begun => begun.unwrap(),
                    };
                    let number = published.fetch_add(1, Ordering::SeqCst).to_string();
                    (0..40).for_each(|k| folder.write(&format!("files/{k}"), number.as_bytes()).unwrap());
                    folder.publish(&Manifest { people: writer, ..earlier.clone() }).unwrap();
                }
            });
        }
    });
    whole(&sandbox);
    let texts: BTreeSet<String> =
        (0..40).map(|k| fs::read_to_string(out.join(format!("files/{k}"))).unwrap()).collect();
    assert_eq!(texts.len(), 1, "files of several bakes: {texts:?}");
}

/// A bake in `out`, nothing else in it, and nothing else left beside it.
fn whole(sandbox: &Sandbox) {
    let manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(sandbox.path("out/manifest.json")).unwrap()).unwrap();
    let listed: BTreeSet<_> = manifest["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|file| sandbox.path("out").join(file.as_str().unwrap()))
        .collect();
    let (inside, beside): (BTreeSet<_>, BTreeSet<_>) = sandbox
        .contents()
        .into_keys()
        .filter(|path| path.is_file())
        .partition(|path| path.starts_with(sandbox.path("out")));
    assert_eq!(inside, listed);
    assert_eq!(beside, BTreeSet::from([sandbox.path("plan.png")]));
}

/// `view` failed on a finished bake that was replaced at that moment.
#[test]
fn readers_never_fail_while_a_bake_is_replaced() {
    let sandbox = baked();
    let mut bakes = sandbox.command(&[]);
    let script = "for seed in 2 3 4 5 6 7 8 9; do \"$0\" \"$@\" --seed $seed || exit 1; done";
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", script]).arg(bakes.get_program()).args(quick(&["out", "--floor-only", "--force"]));
    let mut writer = shell.current_dir(sandbox.path("")).stderr(Stdio::null()).spawn().unwrap();
    bakes.args(["-q", "view", "out", "--size", "64x64", "--threads", "1", "-o", "/dev/null"]);
    while writer.try_wait().unwrap().is_none() {
        let output = bakes.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(writer.wait().unwrap().success());
}

/// `--force` and `resolve` deleted whatever else lay in the folders of a bake.
#[test]
fn files_of_the_user_in_a_bake_stay() {
    let sandbox = baked();
    let mine = ["out/floor/floor_basecolor.1001.psd", "out/preview/notes/monday.txt", "out/thesis.tex"];
    mine.iter().for_each(|name| drop(sandbox.write(name, name)));
    for arguments in [&RESOLVE[..], &quick(&["out", "--floor-only", "--force", "--seed", "2"])] {
        sandbox.run(arguments).succeeds();
        for name in mine {
            assert_eq!(fs::read_to_string(sandbox.path(name)).unwrap(), name, "{arguments:?}");
        }
    }
    assert!(fs::read_to_string(sandbox.path("out/manifest.json")).unwrap().find("thesis").is_none());
    // Without --force nothing is replaced.
    sandbox.run(&quick(&FLOOR)).fails(1, &["out", "earlier bake", "--force"]);
}

/// What engines and systems put into a folder made `resolve` and `--force` refuse the bake.
#[test]
fn what_engines_and_systems_put_into_a_bake_does_no_harm() {
    let sandbox = baked();
    let litter = [
        ".DS_Store",
        "Thumbs.db",
        "desktop.ini",
        "floor/.DS_Store",
        "floor/floor_orm.1001.png.import",
        "manifest.json.meta",
    ];
    litter.iter().for_each(|name| drop(sandbox.write(&format!("out/{name}"), name)));
    for arguments in [&RESOLVE[..], &quick(&["out", "--floor-only", "--force"])] {
        sandbox.run(arguments).succeeds();
        assert!(litter.iter().all(|name| sandbox.path(&format!("out/{name}")).is_file()), "{arguments:?}");
    }
    // A folder that holds nothing else is empty.
    sandbox.write("empty/.DS_Store", "x");
    sandbox.run(&quick(&["empty", "--floor-only"])).succeeds();
    assert!(sandbox.path("empty/.DS_Store").is_file());
}

/// A bake never replaces a file that no bake has made, and says so before it begins.
#[test]
fn a_file_of_the_user_with_a_name_that_the_bake_needs_is_refused_at_once() {
    let sandbox = baked();
    sandbox.write("out/index.html", "my page");
    let all = "200000";
    let arguments = ["-q", "bake", "plan.png", "--metres-per-pixel", "0.1", "--people", all, "-o", "out", "--force"];
    sandbox.run(&arguments).fails(1, &["out/index.html", "no bake has made", "hint: move it away"]);
    // Names that depend on the plan are refused when they are written.
    fs::remove_file(sandbox.path("out/index.html")).unwrap();
    edit(&sandbox.path("out/manifest.json"), "    \"floor/floor_mask.1001.png\",\n", "");
    sandbox
        .run(&quick(&["out", "--floor-only", "--force"]))
        .fails(1, &["out/floor/floor_mask.1001.png", "no bake has made"]);
}

/// A bake of a plan that lies in the folder of an earlier one.
#[test]
fn a_bake_does_not_replace_its_own_plan() {
    let sandbox = baked();
    let into_out = |plan: &'static str| {
        let mut arguments = quick(&["out", "--floor-only", "--force"]);
        arguments[2] = plan;
        sandbox.run(&arguments)
    };
    into_out("out/preview/paths.png").fails(1, &["out/preview/paths.png", "the same run reads it"]);
    // A file of the user stays anyway.
    fs::copy(sandbox.path("plan.png"), sandbox.path("out/plan.png")).unwrap();
    into_out("out/plan.png").succeeds();
    assert!(sandbox.path("out/plan.png").is_file());
}

/// Files with the names of hidden helpers were emptied or deleted.
#[test]
fn hidden_files_beside_a_bake_stay() {
    let sandbox = baked();
    sandbox.write(".out.lock", "mine");
    sandbox.run(&quick(&["out", "--floor-only", "--force"])).succeeds();
    assert_eq!(fs::read_to_string(sandbox.path(".out.lock")).unwrap(), "mine");
    sandbox.write(".out.new/diary.txt", "mine");
    sandbox.run(&quick(&["out", "--floor-only", "--force"])).fails(1, &[".out.new", "in the way", "hint: "]);
}
