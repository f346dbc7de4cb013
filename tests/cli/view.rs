//! `trodden view`: pictures of a finished bake.

use super::sandbox::Sandbox;

fn baked() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let arguments = ["-q", "bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "20", "--quick", "-o", "out"];
    sandbox.run(&arguments).succeeds();
    sandbox
}

#[test]
fn view_draws_a_bake_from_anywhere_and_leaves_it_as_it_was() {
    let sandbox = baked();
    let ran = sandbox.run(&["view", "out", "--size", "160x90"]).succeeds();
    assert!(ran.out.contains("out-view.png: --camera ") && ran.err.is_empty(), "{} {}", ran.out, ran.err);
    assert_eq!(ran.made().len(), 1, "{:?}", ran.made());
    let automatic = image::open(sandbox.path("out-view.png")).unwrap().to_rgb8();
    assert_eq!(automatic.dimensions(), (160, 90));

    // What it prints leads to the same picture again, up to the rounding of what is printed.
    let said = ran.out.split_once(": ").unwrap().1.trim().to_string();
    let mut again = vec!["-q", "view", "out", "--size", "160x90", "-o", "again.png"];
    again.extend(said.split(' '));
    sandbox.run(&again).succeeds();
    let repeated = image::open(sandbox.path("again.png")).unwrap().to_rgb8();
    assert_eq!(repeated.dimensions(), (160, 90));

    for (name, more) in [
        ("above.png", &["--birds-eye"][..]),
        ("own.png", &["--camera", "4,2,1.7,10,-8", "--fov", "60"]),
        ("clean.png", &["--camera", "4,2,1.7,10,-8", "--fov", "60", "--clean"]),
    ] {
        let mut arguments = vec!["-q", "view", "out", "--size", "160x90", "-o", name];
        arguments.extend(more);
        let ran = sandbox.run(&arguments).succeeds();
        assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
    }
    let light = |name: &str| {
        let picture = image::open(sandbox.path(name)).unwrap().to_luma8();
        picture.pixels().map(|pixel| u64::from(pixel.0[0])).sum::<u64>()
    };
    assert!(light("clean.png") > light("own.png"), "a clean floor is lighter");
}

#[test]
fn cameras_that_see_nothing_are_refused() {
    let sandbox = baked();
    let refused = |camera: &str, says: &[&str]| {
        sandbox.run(&["view", "out", "--camera", camera, "-o", "x.png"]).fails(1, says);
        assert!(!sandbox.path("x.png").exists());
    };
    refused("4,0.2,1.7,0,0", &["x = 4.00 m, y = 0.20 m", "hint: the nearest place on the floor is "]);
    refused("4,20,1.7,0,0", &["beyond the plan", "hint: "]);
    refused("4,2,1.7", &["3 numbers, not 5", "x,y,z,heading,pitch"]);
    refused("4,2,1.7,north,0", &["heading is `north`", "hint: "]);
    refused("4,2,1.7,0,-90", &["pitch is -90", "-89 to 89"]);
    sandbox.run(&["view", "out", "--size", "0x90"]).fails(2, &["1920x1080"]);
    sandbox.run(&["view", "out", "--fov", "180"]).fails(2, &["5 to 140"]);
    sandbox.run(&["view", "nowhere"]).fails(1, &["nowhere"]);
}
