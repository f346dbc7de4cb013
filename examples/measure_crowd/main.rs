//! Measures the crowd as pedestrian research does, and draws it beside what was published: speed against density,
//! distance from walls, step length against speed.
//!
//! ```sh
//! cargo run --release --example measure_crowd          # prints tables; writes docs/images/crowd_*.svg
//! ```
//!
//! The tables in `docs/crowd.md` are written anew. `cargo test --test crowd` holds the crowd to the same figures.

// What decides nothing may use the platform's functions; a measurement that cannot be made ends the program.
#![allow(clippy::disallowed_methods, clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

#[path = "../../tests/crowd/measures.rs"]
#[allow(dead_code, reason = "shared with the tests of the crowd")]
mod measures;
#[path = "../../tests/crowd/scene.rs"]
#[allow(dead_code, reason = "shared with the tests of the crowd")]
mod scene;
mod speed_density;
mod step_length;
mod svg;
mod wall_distance;

/// What one measurement gives.
pub struct Measured {
    /// What it is called in file names and in the page.
    pub name: &'static str,
    /// A table in Markdown.
    pub table: String,
    /// The same, drawn.
    pub plot: svg::Plot,
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for measure in [speed_density::measure, wall_distance::measure, step_length::measure] {
        let Measured { name, table, plot } = measure();
        let picture = root.join(format!("docs/images/crowd_{name}.svg"));
        println!("{table}\n{}\n", picture.display());
        fs::write(&picture, plot.to_string()).unwrap();
        replace_table(&root.join("docs/crowd.md"), name, &table);
    }
}

/// Puts a table between its two marks in the page.
fn replace_table(page: &PathBuf, name: &str, table: &str) {
    let text = fs::read_to_string(page).unwrap();
    let (begin, end) = (format!("<!-- measured: {name} -->\n"), "<!-- end -->");
    let (before, rest) = text.split_once(&begin).unwrap_or_else(|| panic!("{}: no {begin:?}", page.display()));
    let (_, after) = rest.split_once(end).unwrap_or_else(|| panic!("{}: no {end:?}", page.display()));
    fs::write(page, format!("{before}{begin}{table}{end}{after}")).unwrap();
}
