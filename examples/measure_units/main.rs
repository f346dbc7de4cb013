//! Measures the sample plaza with crowd units and without, and prints the table of `docs/units.md`:
//!
//! ```text
//! cargo run --release --example measure_units
//! ```

use trodden::crowd::SpotReport;
use trodden::motion::{Frame, Motion};

#[path = "../draw_units/plaza.rs"]
mod plaza;

/// The crowds that are measured.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=4;

/// What came of the sample's spot with one seed.
fn measured(seed: u64, play: bool) -> Result<SpotReport, Box<dyn std::error::Error>> {
    let plaza = plaza::Plaza::open(seed)?;
    let mut crowd = plaza.crowd(play)?;
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame)? {}
    crowd.tally().spots.into_iter().next().ok_or_else(|| "the sample has no spot".into())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "| seed | units | people | played | place off [m] | turned off [degrees] | speeds [bits] | headings [bits] |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for seed in SEEDS {
        let with = measured(seed, true)?;
        let without = measured(seed, false)?.diversity;
        let share = 100.0 * with.played_s / with.there_s.max(1e-9);
        let SpotReport { splices, people, position_error_m: place, heading_error_deg: heading, .. } = with;
        println!(
            "| {seed} | {splices} | {people} | {share:.0} % | {:.2}, {:.2} | {:.0}, {:.0} | {:.2}, {:.2} | {:.2}, {:.2} |",
            place.mean,
            place.largest,
            heading.mean,
            heading.largest,
            with.diversity.speed_bits,
            without.speed_bits,
            with.diversity.heading_bits,
            without.heading_bits
        );
    }
    Ok(())
}
