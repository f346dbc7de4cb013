//! The pattern library as it is committed.

#[path = "../../examples/draw_patterns/drawing/mod.rs"]
mod drawing;

use std::path::Path;

use rayon::prelude::*;
use trodden::patterns::{Cause, PatternLibrary, contact_sheet};

/// The images in `patterns/` are what the program in the repository draws.
#[test]
fn committed_images_are_what_the_example_draws() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("patterns");
    let library = PatternLibrary::built_in();
    let drawings = drawing::all();
    assert_eq!(drawings.len(), library.patterns.len());
    drawings.into_par_iter().for_each(|drawing| {
        let file = folder.join(format!("{}.png", drawing.name));
        let committed = image::open(&file).unwrap().into_luma8();
        let drawn = drawing.render();
        assert_eq!(committed.dimensions(), drawn.dimensions(), "{}", drawing.name);
        let differ = committed.as_raw().iter().zip(drawn.as_raw()).filter(|(a, b)| a != b).count();
        assert_eq!(differ, 0, "{}: pixels differ; run `cargo run --release --example draw_patterns`", drawing.name);
    });
}

/// The kinds of shoe that a public floor sees, at the size of real ones.
#[test]
fn soles_have_the_size_and_the_uneven_pressure_of_real_ones() {
    let library = PatternLibrary::built_in();
    for sole in library.patterns.iter().filter(|pattern| pattern.cause == Cause::Sole) {
        let aspect = sole.breadth_cm() / sole.length_cm;
        assert!((0.3..0.42).contains(&aspect), "{}: breadth over length {aspect:.2}", sole.name);
        let mean = |from: f64, to: f64, inner: bool| {
            let (width, height) = (sole.width_px as usize, sole.height_px as usize);
            let columns = (from * width as f64) as usize..(to * width as f64) as usize;
            let rows = if inner { height / 2..height } else { 0..height / 2 };
            let area = (columns.len() * rows.len()) as f64;
            let sum: f64 =
                rows.flat_map(|j| columns.clone().map(move |i| f64::from(sole.coverage[j * width + i]))).sum();
            sum / area / 255.0
        };
        let (ball, arch) = (mean(0.62, 0.76, true), mean(0.34, 0.50, true));
        assert!(ball > 0.2, "{}: the ball leaves {ball:.2}", sole.name);
        assert!(arch < 0.4 * ball, "{}: the arch leaves {arch:.2} of the ball's {ball:.2}", sole.name);
    }
}

#[test]
fn no_two_heel_marks_are_alike_and_all_are_thin() {
    let library = PatternLibrary::built_in();
    let marks: Vec<_> = library.patterns.iter().filter(|pattern| pattern.cause == Cause::Heel).collect();
    assert!(marks.len() >= 6);
    for (n, mark) in marks.iter().enumerate() {
        assert!((2.0..=12.0).contains(&mark.length_cm), "{}", mark.name);
        assert!(marks[..n].iter().all(|other| other.length_cm != mark.length_cm));
        let (width, height) = (mark.width_px as usize, mark.height_px as usize);
        let thickness = |i: usize| (0..height).map(|j| f64::from(mark.coverage[j * width + i]) / 255.0).sum::<f64>();
        let thickest = (0..width).map(thickness).fold(0.0, f64::max);
        assert!((1.5..=10.0).contains(&thickest), "{}: {thickest} mm", mark.name);
        // Feathered: the last tenth is much lighter than the rest.
        let mean = |from: usize, to: usize| (from..to).map(thickness).sum::<f64>() / (to - from) as f64;
        assert!(mean(width * 9 / 10, width) < 0.4 * mean(0, width * 9 / 10), "{}", mark.name);
    }
}

#[test]
fn the_contact_sheet_shows_every_pattern() {
    let library = PatternLibrary::built_in();
    let sheet = contact_sheet(&library);
    assert!(sheet.width() >= 1000 && sheet.height() >= 500, "{:?}", sheet.dimensions());
    let blank = *sheet.get_pixel(0, 0);
    let inked = sheet.pixels().filter(|&&pixel| pixel != blank).count();
    let covered: usize = library
        .patterns
        .iter()
        .map(|pattern| {
            let feet = if pattern.cause == Cause::Sole { 2 } else { 1 };
            feet * pattern.coverage.iter().filter(|&&coverage| coverage > 2).count()
        })
        .sum();
    assert!(inked > covered, "{inked} pixels of the sheet for {covered} of the patterns");
}
