//! What cannot be imported is refused with a reason and a remedy, and nothing panics.

use trodden::patterns::{Cause, Form, ImportError, ImportOptions, ImportedPattern, PhotoScale};

use super::photograph::{Scene, blot, drawn};

fn plain() -> ImportOptions {
    ImportOptions { cause: Cause::Hand, form: None, size: PhotoScale::PxPerCm(10.0), crop: None, rotate_deg: 0.0 }
}

fn refused(bytes: &[u8], options: &ImportOptions) -> ImportError {
    ImportedPattern::from_photo(bytes, options).map(|import| import.stain_cm).unwrap_err()
}

#[test]
fn a_photograph_without_a_stain() {
    for texture in [0.0, 0.02, 0.08] {
        for jpeg in [None, Some(80)] {
            let bare = drawn(200, 150, |_, _| 0.0);
            let scene = Scene { texture, jpeg, vignette: 0.3, slope: [0.4, 0.2], noise: 2.0, ..Scene::of(bare) };
            let error = refused(&scene.photograph(), &plain());
            assert!(matches!(error, ImportError::NoStain { .. }), "{texture} {jpeg:?}: {error}");
            assert!(error.to_string().contains("no stain") && error.hint().unwrap().contains("crop"));
        }
    }
    let grey = image::GrayImage::from_pixel(300, 200, image::Luma([128]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    grey.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    assert!(matches!(refused(bytes.get_ref(), &plain()), ImportError::NoStain { .. }));
}

#[test]
fn a_stain_that_fills_the_photograph() {
    let mut scene = Scene::of(drawn(200, 150, |x, y| if x.abs().max(y.abs()) < 0.97 { 1.0 } else { 0.0 }));
    scene.size = [196, 150];
    scene.middle = [98.0, 75.0];
    let error = refused(&scene.photograph(), &plain());
    // With hardly any wall to be seen, either all of it is stain or none.
    assert!(matches!(error, ImportError::FillsPhoto { .. } | ImportError::NoStain { .. }), "{error}");
    assert!(error.hint().unwrap().contains("crop"));
}

#[test]
fn a_stain_cut_by_most_of_the_photograph_s_border() {
    // Wall in the corners only.
    let mut scene = Scene::of(drawn(300, 300, |x, y| if x * x + y * y < 1.0 { 1.0 } else { 0.0 }));
    scene.size = [260, 260];
    scene.middle = [130.0, 130.0];
    let error = refused(&scene.photograph(), &plain());
    assert!(matches!(error, ImportError::FillsPhoto { .. }), "{error}");
    assert!(error.to_string().contains("of its border"), "{error}");
}

#[test]
fn what_is_no_photograph() {
    let error = refused(b"", &plain());
    assert!(error.to_string().contains("empty"), "{error}");
    let error = refused(b"these are words, not pixels", &plain());
    assert!(matches!(error, ImportError::Unreadable { .. }) && error.hint().unwrap().contains("JPEG"));
    let photo = Scene { jpeg: Some(85), ..Scene::of(blot()) }.photograph();
    for length in (0..photo.len()).step_by(photo.len() / 23 + 1) {
        // A JPEG that was cut off may still show enough; none may bring the program down.
        let _ = ImportedPattern::from_photo(&photo[..length], &plain());
    }
    let photo = Scene::of(blot()).photograph();
    for length in (0..photo.len()).step_by(photo.len() / 23 + 1) {
        assert!(ImportedPattern::from_photo(&photo[..length], &plain()).is_err());
    }
}

#[test]
fn too_large_and_too_small() {
    // A BMP's header alone: 30 000 x 30 000 px of 24 bits.
    let mut header = b"BM".to_vec();
    for word in [0u32, 0, 54, 40, 30_000, 30_000, 1 | (24 << 16), 0, 0, 0, 0, 0, 0] {
        header.extend(word.to_le_bytes());
    }
    let error = refused(&header, &plain());
    assert!(error.to_string().contains("30000 x 30000 px, allowed are 64 million"), "{error}");
    let mut scene = Scene::of(blot());
    scene.size = [20, 400];
    let error = refused(&scene.photograph(), &plain());
    assert!(error.to_string().contains("20 x 400 px, allowed are at least 32"), "{error}");
}

#[test]
fn numbers_out_of_range() {
    let photo = Scene::of(blot()).photograph();
    let at = |options: ImportOptions, expected: &str| {
        let error = refused(&photo, &options);
        assert!(error.to_string().contains(expected), "{error}\nshould hold\n{expected}");
        error
    };
    for scale in [0.0, -1.0, 3.9, 201.0, f64::NAN, f64::INFINITY] {
        at(ImportOptions { size: PhotoScale::PxPerCm(scale), ..plain() }, "the scale is");
        at(
            ImportOptions { size: PhotoScale::LengthCm(if scale > 3.0 { 1e9 } else { scale }), ..plain() },
            "the length is",
        );
    }
    at(ImportOptions { rotate_deg: f64::NAN, ..plain() }, "the rotation is NaN");
    at(ImportOptions { rotate_deg: 1e6, ..plain() }, "the rotation is 1000000, allowed is -360 to 360");
    at(ImportOptions { size: PhotoScale::LengthCm(130.0), ..plain() }, "px/cm, allowed are 4 to 200");
    for crop in [[300, 0, 200, 100], [0, 0, 31, 100], [u32::MAX, 0, u32::MAX, 100], [0, 0, 361, 320]] {
        let error = at(ImportOptions { crop: Some(crop), ..plain() }, "does not fit: the photograph has 360 x 320 px");
        assert!(error.hint().unwrap().contains("left,top,width,height"));
    }
    at(
        ImportOptions { form: Some(Form::Toe), ..plain() },
        "no form \"toe\", allowed is \"palm\", \"drag\" or \"fingertips\"",
    );
    let arm = ImportOptions { cause: Cause::Arm, form: Some(Form::Palm), ..plain() };
    assert!(at(arm, "allowed is none").hint().unwrap().contains("leave the form out"));
    // A drop of 12 cm is no heel mark when it is taller than long, and too short for a sole at 20 px/cm.
    let sole = ImportOptions { cause: Cause::Sole, size: PhotoScale::PxPerCm(20.0), ..plain() };
    assert!(at(sole, "is 8 to 45 cm long").hint().unwrap().contains("rotate"));
}
