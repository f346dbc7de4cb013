//! Outputs that are a single file.

use std::fs;
use std::process::Stdio;

use super::super::sandbox::Sandbox;
use super::baked;

/// Everybody walks through the plan in no time.
const CROWD: [&str; 7] = ["-q", "crowd", "plan.png", "--metres-per-pixel", "0.1", "--people", "3"];

fn crowd<'a>(more: &[&'a str]) -> Vec<&'a str> {
    CROWD.iter().chain(more).copied().collect()
}

/// `-o p.txt` deleted `.p.txt.lock` and `.p.txt.new`, and emptied the file that a link of that name led to.
#[test]
fn files_with_the_names_of_helpers_stay() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let mine = [".p.txt.lock", ".p.txt.new", "elsewhere.txt"];
    mine.iter().for_each(|name| drop(sandbox.write(name, name)));
    sandbox.run(&crowd(&["-o", "p.txt"])).succeeds();
    #[cfg(unix)]
    {
        fs::remove_file(sandbox.path(".p.txt.lock")).unwrap();
        std::os::unix::fs::symlink("elsewhere.txt", sandbox.path(".p.txt.lock")).unwrap();
        sandbox.run(&crowd(&["-o", "p.txt", "--force"])).succeeds();
        assert!(sandbox.path(".p.txt.lock").is_symlink());
    }
    for name in &mine[1..] {
        assert_eq!(fs::read_to_string(sandbox.path(name)).unwrap(), *name);
    }
    assert!(sandbox.path("p.txt").is_file());
}

/// Pictures replaced any file without being told to.
#[test]
fn no_option_replaces_a_file_without_force() {
    let sandbox = baked();
    let photo = image::GrayImage::from_fn(64, 64, |x, y| {
        image::Luma([if (24..40).contains(&x) && (24..40).contains(&y) { 90 } else { 220 }])
    });
    photo.save(sandbox.path("photo.png")).unwrap();
    let inspect = ["-q", "inspect", "plan.png", "--metres-per-pixel", "0.1", "--picture"];
    let import = ["-q", "patterns", "import", "photo.png", "--cause", "hand", "--scale", "10", "--picture"];
    let commands = [
        &inspect[..],
        &["-q", "patterns", "--picture"],
        &["-q", "view", "out", "--size", "64x64", "-o"],
        &["-q", "diff", "out", "out", "--picture"],
        &import,
        &["-q", "init", "plan.png", "--metres-per-pixel", "0.1", "-o"],
        &crowd(&["--paths"]),
        &crowd(&["--as", "juelich", "-o"]),
    ];
    for command in commands {
        sandbox.write("there.png", "mine");
        let with = |more: &[&'static str]| [command, more].concat();
        let code = if command[1] == "diff" { 2 } else { 1 };
        sandbox.run(&with(&["there.png"])).fails(code, &["there.png exists already", "hint: --force"]);
        sandbox.run(&with(&["there.png", "--force"])).succeeds();
        assert_ne!(fs::read(sandbox.path("there.png")).unwrap(), b"mine", "{command:?}");
        let left = sandbox.contents().into_keys().filter(|path| path.to_string_lossy().contains("there.png")).count();
        assert_eq!(left, 1, "{command:?}");
    }
}

/// A command replaced its own plan, scenario or recording.
#[test]
fn no_option_replaces_what_the_run_reads() {
    let sandbox = baked();
    let scenario = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 3\n[crowd.arrivals]\nkind = \"list\"\nfile = \"times.csv\"\n\
                    [look]\nfile = \"look.toml\"\n";
    sandbox.write("scene.toml", scenario);
    sandbox.write("times.csv", "1, 1\n2, 2\n");
    sandbox.write("look.toml", "preset = \"wet\"\n");
    sandbox.run(&crowd(&["-o", "walk.txt"])).succeeds();
    sandbox.run(&["-q", "motion", "convert", "walk.txt", "-o", "walk.csv"]).succeeds();
    let of_scene = |command: &'static str, option: &'static str, file: &'static str| {
        vec!["-q", command, "scene.toml", option, file, "--force"]
    };
    let mut commands = Vec::new();
    for file in ["scene.toml", "plan.png", "./plan.png", "times.csv", "look.toml"] {
        commands.push((of_scene("crowd", "--paths", file), file));
        commands.push((of_scene("inspect", "--picture", file), file));
    }
    commands.push((crowd(&["--paths", "plan.png", "--force"]), "plan.png"));
    commands.push((crowd(&["--animation", "plan.png", "--force"]), "plan.png"));
    commands.push((vec!["-q", "init", "scene.toml", "--force"], "scene.toml"));
    for option in ["-o", "--paths"] {
        commands.push((vec!["-q", "motion", "convert", "walk.txt", option, "walk.txt", "--force"], "walk.txt"));
    }
    let over_plan = ["-q", "motion", "convert", "walk.txt", "--plan", "scene.toml", "--paths", "plan.png", "--force"];
    commands.push((over_plan.to_vec(), "plan.png"));
    commands.push((vec!["-q", "motion", "info", "walk.txt", "--paths", "walk.txt", "--force"], "walk.txt"));
    commands.push((vec!["-q", "motion", "features", "walk.txt", "-o", "walk.txt", "--force"], "walk.txt"));
    let formation = ["-q", "motion", "formation", "--example", "walk.txt", "-o", "walk.txt", "--force"];
    commands.push((formation.to_vec(), "walk.txt"));
    commands.push((vec!["-q", "diff", "plan.png", "plan.png", "--picture", "plan.png", "--force"], "plan.png"));
    let floor = "out/preview/floor.png";
    commands.push((vec!["-q", "view", "out", "--size", "64x64", "-o", floor, "--force"], floor));
    let look = ["-q", "view", "out", "--size", "64x64", "--look", "look.toml", "-o", "look.toml", "--force"];
    commands.push((look.to_vec(), "look.toml"));
    for (command, file) in commands {
        let code = if command[1] == "diff" { 2 } else { 1 };
        sandbox.run(&command).fails(code, &[file, "the same run reads it", "hint: "]);
    }
}

/// Another name of an input is the input as well.
#[cfg(unix)]
#[test]
fn links_to_an_input_are_the_input() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    std::os::unix::fs::symlink("plan.png", sandbox.path("soft.png")).unwrap();
    fs::hard_link(sandbox.path("plan.png"), sandbox.path("hard.png")).unwrap();
    for name in ["soft.png", "hard.png"] {
        sandbox.run(&crowd(&["--paths", name, "--force"])).fails(1, &[name, "the same run reads it"]);
    }
}

/// Two outputs of one name replaced each other.
#[test]
fn two_outputs_are_two_files() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let same = [
        &["--as", "juelich", "-o", "p.png", "--paths", "./p.png"][..],
        &["--as", "juelich", "-o", "p.png", "--animation", "./p.png"],
        &["--animation", "p.png", "--paths", "./p.png"],
    ];
    for outputs in same {
        sandbox.run(&crowd(outputs)).fails(2, &["name the same file"]);
    }
}

/// With `--force`, `--paths /dev/null` put a picture in the place of the device.
#[cfg(unix)]
#[test]
fn devices_and_standard_output_are_written_to() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let inspect = ["-q", "inspect", "plan.png", "--metres-per-pixel", "0.1", "--picture"];
    for device in ["/dev/null", "/dev/stdout"] {
        for force in [&[][..], &["--force"]] {
            let file = sandbox.path("picture.png");
            let mut command = sandbox.command(&[&inspect[..], &[device], force].concat());
            assert!(command.stdout(fs::File::create(&file).unwrap()).status().unwrap().success(), "{device}");
            assert_eq!(image::open(&file).is_ok(), device == "/dev/stdout", "{device}");
            sandbox.run(&crowd(&["--as", "juelich", "-o", device])).succeeds();
            let mut drawn = sandbox.command(&[&crowd(&["--paths", device])[..], force].concat());
            assert!(drawn.stdout(Stdio::null()).status().unwrap().success(), "{device}");
        }
    }
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
    let printed = sandbox.run(&crowd(&["-o", "-"])).succeeds();
    assert_eq!(sandbox.run(&crowd(&["--as", "juelich", "-o", "/dev/stdout"])).succeeds().out, printed.out);
}
