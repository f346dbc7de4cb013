//! Compares pictures with those in `tests/golden/`.
//!
//! A picture that differs leaves `target/golden/NAME.html`: expected, difference and actual side by side, in one file.
//! `BLESS=1 cargo test` rewrites what is expected; look at it before you commit it.

use std::path::PathBuf;

use image::{ImageFormat, Rgb, RgbImage};

/// Largest width and height of a golden picture, pixels: each is about one thing.
const LARGEST_PX: u32 = 256;
/// Largest golden file, bytes.
const LARGEST_FILE: u64 = 20 * 1024;

/// How far a picture may be from the expected one: three thresholds, as in `trodden diff`, in steps of 8 bit.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// A pixel differs if one of its channels differs by more than this.
    pub fail: u8,
    /// Share of the pixels that may differ.
    pub share: f64,
    /// No channel may differ by more than this.
    pub hard_fail: u8,
}

/// Everything that is promised to be the same on every machine: all of the program's own output.
pub const EXACT: Tolerance = Tolerance { fail: 0, share: 0.0, hard_fail: 0 };
/// What was reduced or enlarged in floating point for the test's own sake.
pub const RESAMPLED: Tolerance = Tolerance { fail: 1, share: 0.001, hard_fail: 8 };

/// Fails unless the picture is the one in `tests/golden/NAME.png`.
pub fn assert_golden(name: &str, actual: &RgbImage, tolerance: Tolerance) {
    assert!(actual.width().max(actual.height()) <= LARGEST_PX, "{name}: golden pictures are at most {LARGEST_PX} px");
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let golden = root.join("tests/golden").join(format!("{name}.png"));
    if std::env::var_os("BLESS").is_some_and(|bless| bless == "1") {
        std::fs::create_dir_all(golden.parent().unwrap()).unwrap();
        actual.save(&golden).unwrap();
        let size = std::fs::metadata(&golden).unwrap().len();
        assert!(size <= LARGEST_FILE, "{}: {size} bytes, at most {LARGEST_FILE}", golden.display());
        return;
    }
    let expected = match image::open(&golden) {
        Ok(image) => image.to_rgb8(),
        Err(error) => panic!("{}: {error}; BLESS=1 writes what is expected", golden.display()),
    };
    if let Some(problem) = problem(&expected, actual, tolerance) {
        let file = root.join("target/golden").join(format!("{name}.html"));
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, report(name, &problem, &expected, actual)).unwrap();
        panic!("{name}: {problem}\nexpected, difference, actual: {}\nBLESS=1 takes the actual one", file.display());
    }
}

/// What is wrong with the picture, if anything.
fn problem(expected: &RgbImage, actual: &RgbImage, tolerance: Tolerance) -> Option<String> {
    if expected.dimensions() != actual.dimensions() {
        return Some(format!("{:?} px instead of {:?}", actual.dimensions(), expected.dimensions()));
    }
    let differences: Vec<u8> = expected.pixels().zip(actual.pixels()).map(|(e, a)| largest_difference(e, a)).collect();
    let largest = differences.iter().copied().max().unwrap_or(0);
    let over = differences.iter().filter(|&&difference| difference > tolerance.fail).count();
    let share = over as f64 / differences.len().max(1) as f64;
    let wrong = share > tolerance.share || largest > tolerance.hard_fail;
    wrong.then(|| {
        format!("{over} pixels ({:.2} %) differ by more than {}, at most by {largest}", share * 100.0, tolerance.fail)
    })
}

fn largest_difference(a: &Rgb<u8>, b: &Rgb<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(&a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// A page of expected, difference and actual picture, each enlarged without smoothing.
fn report(name: &str, problem: &str, expected: &RgbImage, actual: &RgbImage) -> String {
    let figure = |(title, picture): (&str, &RgbImage)| {
        let mut png = std::io::Cursor::new(Vec::new());
        picture.write_to(&mut png, ImageFormat::Png).unwrap();
        let bytes: String = png.get_ref().iter().map(|byte| format!("%{byte:02x}")).collect();
        let [width, height] = [picture.width(), picture.height()];
        format!(
            "<figure><figcaption>{title}, {width} x {height} px</figcaption><img src=\"data:image/png,{bytes}\"></figure>\n"
        )
    };
    let difference = difference(expected, actual);
    let figures = [("expected", expected), ("difference", &difference), ("actual", actual)].map(figure).concat();
    format!(
        "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<title>{name}</title>\n<style>body {{ font: 16px sans-serif; }} \
         div {{ display: flex; gap: 1em; }} figure {{ flex: 1; margin: 0; }} \
         img {{ width: 100%; image-rendering: pixelated; }}</style>\n\
         <h1>{name}</h1>\n<p>{problem}. <code>BLESS=1</code> takes the actual picture.</p>\n<div>\n{figures}</div>\n"
    )
}

/// How much each pixel differs: black where it does not, from dark red up to yellow.
fn difference(expected: &RgbImage, actual: &RgbImage) -> RgbImage {
    let [width, height] = [expected.width().max(actual.width()), expected.height().max(actual.height())];
    RgbImage::from_fn(width, height, |x, y| {
        let difference = match (expected.get_pixel_checked(x, y), actual.get_pixel_checked(x, y)) {
            (Some(a), Some(b)) => largest_difference(a, b),
            _ => 255,
        };
        let heat = if difference == 0 { 0 } else { 64 + difference / 4 * 3 };
        Rgb([heat, if difference > 127 { heat } else { 0 }, 0])
    })
}

#[test]
fn each_of_the_three_thresholds_counts() {
    let expected = RgbImage::from_pixel(10, 10, Rgb([100; 3]));
    let mut actual = expected.clone();
    actual.get_pixel_mut(3, 4).0[1] = 105;
    let check = |fail, share, hard_fail| problem(&expected, &actual, Tolerance { fail, share, hard_fail }).is_none();
    assert!(!check(4, 0.0, 255));
    assert!(check(5, 0.0, 255));
    assert!(check(4, 0.01, 255));
    assert!(!check(4, 0.01, 4));
    assert!(problem(&expected, &RgbImage::new(10, 11), RESAMPLED).unwrap().contains("11"));
    assert!(problem(&expected, &expected, EXACT).is_none());
}

#[test]
fn the_report_shows_all_three() {
    let expected = RgbImage::from_pixel(4, 4, Rgb([10; 3]));
    let mut actual = expected.clone();
    actual.put_pixel(1, 2, Rgb([250; 3]));
    let html = report("spot", "1 pixel differs", &expected, &actual);
    let pictures: Vec<RgbImage> = html
        .split("data:image/png,%")
        .skip(1)
        .map(|rest| {
            let bytes = rest.split('"').next().unwrap().split('%').map(|byte| u8::from_str_radix(byte, 16).unwrap());
            image::load_from_memory(&bytes.collect::<Vec<u8>>()).unwrap().to_rgb8()
        })
        .collect();
    assert_eq!(pictures, [expected.clone(), difference(&expected, &actual), actual]);
    assert_eq!(pictures[1].get_pixel(1, 2).0[0], 64 + 240 / 4 * 3);
    assert_eq!(pictures[1].get_pixel(0, 0).0, [0; 3]);
    assert!(html.contains("1 pixel differs"));
}
