use trodden::Silent;
use trodden::math::vec2;
use trodden::units::{CutOptions, SpotFrame, Unit, cut};

use super::plaza::Plaza;

/// Pieces are cut out of so many crowds, ...
const SEEDS: u64 = 4;
/// ... from each so many, ...
const EACH: usize = 2;
/// ... of at most so many people: larger groups hardly ever come again.
const MOST_PEOPLE: usize = 4;

/// Pieces of what people do on the sample plaza around somebody who stands there, with the names of their files.
pub fn all() -> Result<Vec<(String, Unit)>, trodden::Error> {
    let mut units: Vec<(String, Unit)> = Vec::new();
    for seed in 101..=100 + SEEDS {
        let plaza = Plaza::open(seed)?;
        let spot = SpotFrame { at_m: plaza.spots(false)[0].at.to_m(&plaza.plan), ahead: vec2(0.0, 1.0) };
        let mut crowd = plaza.crowd(false)?;
        let options = CutOptions { most: 60, apart_m: 0.5, least_s: 4.0, ..CutOptions::default() };
        let found = cut(&mut crowd, "walked", spot, &options, &Silent)?;
        let fits = |unit: &Unit| {
            unit.members.len() <= MOST_PEOPLE && unit.starts_within(&options.areas) && super::problems(unit).is_empty()
        };
        let few = found.cuts.into_iter().filter(|cut| fits(&cut.unit));
        for cut in few.take(EACH) {
            let number = units.len() + 1;
            let mut unit = cut.unit;
            unit.name = format!("walked {number}");
            unit.description = format!("cut out of a simulated crowd, number {seed}, at {:.1} s", cut.start_s);
            units.push((format!("walked_{number}"), unit));
        }
    }
    Ok(units)
}
