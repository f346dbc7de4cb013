//! `trodden patterns` with a folder of one's own, and patterns from photographs.

use std::fs;
use std::io::Cursor;

use image::{ImageFormat, Rgb, RgbImage};

use super::sandbox::Sandbox;

/// A wall in light from the left, with a drop of 6 cm at 20 px/cm on it, or without.
fn photograph(stained: bool) -> Vec<u8> {
    let picture = RgbImage::from_fn(320, 240, |x, y| {
        let (u, v) = ((f64::from(x) - 160.0) / 60.0, (f64::from(y) - 120.0) / 45.0);
        let soil = if stained { 0.6 * (1.0 - (u * u + v * v).min(1.0)) } else { 0.0 };
        let light = 200.0 - 0.1 * f64::from(x) + f64::from((x * 7 + y * 13) % 5);
        Rgb([1.0, 0.97, 0.9].map(|tint| (light * tint * (1.0 - 0.4 * soil)) as u8))
    });
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

#[test]
fn a_stain_is_imported_listed_and_walked_over() {
    let sandbox = Sandbox::new();
    sandbox.write("Wall 1.png", photograph(true));
    let import = ["patterns", "import", "Wall 1.png", "--cause", "hand", "--form", "palm", "--scale", "20"];
    let ran = sandbox.run(&[&import[..], &["--into", "mine", "--picture", "seen.png"]].concat()).succeeds();
    for part in ["found a stain of 5.", "density up to", "even to 0.0", "mine/wall_1.png, share 1", "only hand"] {
        assert!(ran.out.contains(part), "no {part:?} in:\n{}", ran.out);
    }
    assert!(image::open(sandbox.path("seen.png")).unwrap().width() > 600);

    // Again: the name is taken, and everything stays as it is.
    let again = [&import[..], &["--into", "mine"]].concat();
    sandbox
        .run(&again)
        .fails(1, &["mine/patterns.toml already lists wall_1.png", "--name, or replace the pattern with --force"]);
    sandbox.run(&[&again[..], &["--name", "other", "--share", "0.5", "-q"]].concat()).succeeds();

    fs::write(sandbox.path("mine/forgotten.png"), "").unwrap();
    let ran = sandbox.run(&["patterns", "mine", "--picture", "sheet.png"]).succeeds();
    assert!(ran.out.contains("the built-in ones are used: sole, heel, arm, shoulder, bag, shoe"), "{}", ran.out);
    assert!(ran.out.contains("hand     palm         67 %"), "{}", ran.out);
    assert!(ran.err.starts_with("warning: mine/forgotten.png is not listed in patterns.toml"), "{}", ran.err);
    assert!(image::open(sandbox.path("sheet.png")).unwrap().height() > 100);

    sandbox.plan();
    let scenario = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[patterns]\nfolder = \"mine\"\n";
    sandbox.write("plan.toml", scenario);
    sandbox.run(&["-q", "bake", "plan.toml", "--quick", "--people", "5", "-o", "out"]).succeeds();
}

#[test]
fn what_cannot_be_imported_is_explained() {
    let sandbox = Sandbox::new();
    sandbox.write("wall.png", photograph(true));
    sandbox.write("bare.png", photograph(false));
    sandbox.write("words.png", "words");
    let run = |arguments: &[&str]| sandbox.run(&[&["patterns", "import"], arguments].concat());
    run(&["bare.png", "--cause", "arm", "--scale", "20"]).fails(1, &["there is no stain in the photograph", "hint: "]);
    run(&["words.png", "--cause", "arm", "--scale", "20"]).fails(1, &["cannot read the photograph", "hint: PNG, JPEG"]);
    run(&["nowhere.png", "--cause", "arm", "--scale", "20"]).fails(1, &["nowhere.png"]);
    run(&["wall.png", "--cause", "arm", "--scale", "0.2"]).fails(1, &["the scale is 0.2, allowed is 4 to 200 px/cm"]);
    run(&["wall.png", "--cause", "arm", "--length-cm", "nan"]).fails(1, &["the length is NaN"]);
    run(&["wall.png", "--cause", "arm", "--scale", "20", "--crop", "300,0,90,90"])
        .fails(1, &["does not fit", "hint: "]);
    run(&["wall.png", "--cause", "arm", "--form", "palm", "--scale", "20"])
        .fails(1, &["no form \"palm\"", "leave the form out"]);
    run(&["wall.png", "--cause", "sole", "--scale", "20"]).fails(1, &["is 8 to 45 cm long", "hint: "]);
    run(&["wall.png", "--cause", "arm", "--scale", "20", "--name", "a/b"])
        .fails(1, &["cannot be the name", "hint: choose another name with --name"]);
    run(&["wall.png", "--cause", "arm"]).fails(2, &["--scale <PX_PER_CM>|--length-cm <L>"]);
    run(&["wall.png", "--cause", "arm", "--scale", "20", "--length-cm", "3"]).fails(2, &["cannot be used with"]);
    run(&["wall.png", "--cause", "knee", "--scale", "20"]).fails(2, &["known are sole, heel, hand"]);
    run(&["wall.png", "--cause", "arm", "--scale", "20", "--crop", "1,2,3"]).fails(2, &["four whole numbers"]);
    run(&["--cause", "arm", "--scale", "20"]).fails(2, &["<PHOTO>"]);
}

#[test]
fn a_folder_that_is_wrong_is_explained() {
    let sandbox = Sandbox::new();
    let entry = "[[pattern]]\nfile = \"a.png\"\ncause = \"hand\"\nlength_cm = 10.0\nshare = 1.0\n";
    sandbox.write("mine/patterns.toml", entry);
    let run = || sandbox.run(&["patterns", "mine"]);
    run().fails(1, &["mine/patterns.toml:2:8: cannot read the image mine/a.png", "hint: "]);
    sandbox.write("mine/a.png", "");
    run().fails(1, &["the file is empty"]);
    let mut black = Cursor::new(Vec::new());
    RgbImage::new(100, 90).write_to(&mut black, ImageFormat::Png).unwrap();
    sandbox.write("mine/a.png", black.get_ref());
    run().fails(1, &["it leaves nothing", "hint: "]);
    let mut large = Cursor::new(Vec::new());
    image::GrayImage::new(8200, 10).write_to(&mut large, ImageFormat::Png).unwrap();
    sandbox.write("mine/a.png", large.get_ref());
    run().fails(1, &["is 8200 x 10 px, allowed are 8192 px a side"]);
    sandbox.write("mine/patterns.toml", format!("{entry}form = \"heel_line\"\n"));
    run().fails(1, &["patterns.toml:6:8: form is \"heel_line\", allowed is \"palm\", \"drag\" or \"fingertips\""]);
    sandbox.write("mine/patterns.toml", "# nothing yet\n");
    run().fails(1, &["lists no pattern", "hint: "]);
}
