//! Draws the sample plans in `floorplans/`:
//!
//! ```text
//! cargo run --example draw_floorplans
//! ```
//!
//! The same files come out whenever and wherever it is run; a test compares them with those in the repository.

use std::io;
use std::path::Path;

mod corridors;
mod museum;
mod plaza;
mod school;
mod sheet;
mod station;

/// Who draws a plan.
pub type Draw = fn() -> sheet::Sheet;

/// The sample plans: name of the file without ending, and who draws it.
pub const PLANS: [(&str, Draw); 5] = [
    ("corridors", corridors::draw),
    ("station", station::draw),
    ("school", school::draw),
    ("museum", museum::draw),
    ("plaza", plaza::draw),
];

/// One plan as the bytes of a PNG file.
pub fn png_bytes(sheet: &sheet::Sheet) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    sheet.write_png(&mut bytes)?;
    Ok(bytes)
}

#[allow(dead_code)] // the test that compares the files includes this one as a module
fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans");
    for (name, draw) in PLANS {
        let path = folder.join(name).with_extension("png");
        std::fs::write(&path, png_bytes(&draw())?)?;
        println!("{}", path.display());
    }
    Ok(())
}
