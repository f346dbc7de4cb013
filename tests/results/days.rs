//! Several days: other people at the same times, the same bytes on any number of threads, an evener floor.

use std::path::Path;

use tempfile::TempDir;
use trodden::Silent;
use trodden::bake::{OutputOptions, bake};
use trodden::export::{Manifest, Report, read_sums};
use trodden::scenario::{Overrides, Scenario};
use trodden::sums::Quantity;

/// Side of the squares that are compared, metres.
const SQUARE_M: f64 = 0.25;

/// The floor of the museum after some days of 40 people: report, and presence by square.
fn lived(days: u32, seed: u64, threads: usize) -> (Report, Vec<f64>, TempDir) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/museum.toml");
    let overrides = Overrides {
        days: Some(days),
        seed: Some(seed),
        people: Some(40),
        texels_per_metre: Some(12.0),
        walls: Some(false),
        layers: Some(false),
        ..Overrides::default()
    };
    let scenario = Scenario::open(&path, &overrides).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("bake");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let output = OutputOptions { folder: folder.clone(), force: false };
    let report = pool.install(|| bake(&scenario, &output, &Silent)).unwrap();
    let sums = read_sums(&folder, &Manifest::read(&folder).unwrap()).unwrap();
    let grid = sums.presence_grid();
    let cells = (SQUARE_M * grid.texels_per_metre).round() as u32;
    let mut squares = Vec::new();
    for j in (0..grid.height).step_by(cells as usize) {
        for i in (0..grid.width).step_by(cells as usize) {
            let mut values = vec![0; (cells * cells) as usize];
            sums.read(Quantity::Presence, i, j, cells as usize, cells as usize, &mut values);
            squares.push(values.iter().map(|&value| f64::from(value)).sum());
        }
    }
    (report, squares, dir)
}

/// Root mean square of the difference of two floors, as a share of their mean, where people walked.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    let walked: Vec<(f64, f64)> = one.iter().copied().zip(other.iter().copied()).filter(|(a, b)| a + b > 0.0).collect();
    let mean = walked.iter().map(|(a, b)| 0.5 * (a + b)).sum::<f64>() / walked.len() as f64;
    let square = walked.iter().map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / walked.len() as f64;
    square.sqrt() / mean
}

/// Independent days differ by 1 / sqrt(days) as much: 0.41 for six.
#[test]
fn six_days_are_six_crowds_and_differ_less_from_six_others() {
    let [(one, a, _), (_, b, _)] = [1, 2].map(|seed| lived(1, seed, 2));
    let [(six, c, _), (_, d, _)] = [1, 2].map(|seed| lived(6, seed, 2));
    assert_eq!([one.people.entered, six.people.entered], [40, 240]);
    let more = c.iter().sum::<f64>() / a.iter().sum::<f64>();
    assert!((5.6..6.4).contains(&more), "{more} times the presence of a day");
    let [of_one, of_six] = [difference(&a, &b), difference(&c, &d)];
    assert!(of_six < 0.55 * of_one, "days of another seed differ by {of_one}, six by {of_six}");
}

#[test]
fn days_give_the_same_bytes_on_any_number_of_threads() {
    let [(_, one, first), (_, four, second)] = [1, 4].map(|threads| lived(3, 3, threads));
    assert!(one == four);
    for file in ["floor/floor_basecolor.1001.png", "sums/floor_sums.1001.exr", "preview/paths.png", "manifest.json"] {
        let [one, other] = [&first, &second].map(|dir| std::fs::read(dir.path().join("bake").join(file)).unwrap());
        assert!(one == other, "{file}");
    }
}
