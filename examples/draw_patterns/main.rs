//! Draws the patterns of soles, heels and wall stains in `patterns/`: `cargo run --release --example draw_patterns`.
//!
//! Everything is drawn from signed distances and hashed noise, so running it again gives the same files. Name
//! another folder as the only argument to have them there.
//!
//! To add one: draw it in `drawing/`, list it in `patterns/patterns.toml` and in the built-in files of
//! `src/patterns/library.rs`, and give it an empty file to begin with, since the library compiles the files in.

mod drawing;

use std::path::PathBuf;

use rayon::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let built_in = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("patterns");
    let folder = std::env::args_os().nth(1).map_or(built_in, PathBuf::from);
    let draw = |drawing: drawing::Drawing| {
        let path = folder.join(format!("{}.png", drawing.name));
        drawing.render().save(&path).map(|()| path)
    };
    for path in drawing::all().into_par_iter().map(draw).collect::<Result<Vec<_>, _>>()? {
        println!("{}", path.display());
    }
    Ok(())
}
