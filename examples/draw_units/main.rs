//! Makes the units in `floorplans/units/`, drawn scenes and pieces cut out of simulated motion:
//!
//! ```text
//! cargo run --release --example draw_units
//! ```
//!
//! The same files come out whenever and wherever it is run; a test compares the drawn ones with those in the repository.
//! Another crowd model, another sample plaza, and other pieces are cut: those that are kept need not be.

use std::path::Path;

use trodden::units::{TrackState, Unit};

mod actor;
mod cuts;
mod plaza;
mod scenes;

/// The drawn units: name of the file without ending, and its text.
pub fn drawn() -> Vec<(String, String)> {
    scenes::all().iter().map(|scene| (scene.file.clone(), scene.unit().to_toml())).collect()
}

/// What people would not do: come too near, hurry, leap; empty for a good unit.
pub fn problems(unit: &Unit) -> Vec<String> {
    let mut problems = Vec::new();
    let looks = (unit.duration_s / 0.1) as usize;
    let mut worst = [f64::INFINITY, f64::INFINITY, 0.0, 0.0, 0.0];
    let mut when = [(0.0, 0, 0); 5];
    for k in 0..=looks {
        let time_s = k as f64 * 0.1;
        let now: Vec<TrackState> = (0..unit.members.len()).map(|m| unit.moment(m, time_s, false)).collect();
        let mut note = |which: usize, value: f64, a: usize, b: usize| {
            let worse = if which < 2 { value < worst[which] } else { value > worst[which] };
            if worse {
                (worst[which], when[which]) = (value, (time_s, a + 1, b + 1));
            }
        };
        for (a, one) in now.iter().enumerate() {
            now[..a].iter().enumerate().for_each(|(b, other)| note(0, one.place_m.distance(other.place_m), a, b));
            note(1, one.place_m.length(), a, a);
            note(2, one.velocity_m_s.length(), a, a);
            let later = unit.moment(a, time_s + 0.1, false);
            note(3, later.velocity_m_s.distance(one.velocity_m_s) / 0.1, a, a);
            note(4, later.heading.distance(one.heading) / 0.1, a, a);
        }
    }
    let limits = [(0.48, "apart"), (0.5, "from the viewer"), (2.5, "m/s"), (3.0, "m/s2"), (3.2, "rad/s")];
    for (which, (limit, what)) in limits.into_iter().enumerate() {
        let wrong = if which < 2 { worst[which] < limit } else { worst[which] > limit };
        if wrong {
            let (time_s, a, b) = when[which];
            problems
                .push(format!("{}: {time_s:.1} s, {a} and {b}: {:.2} {what}, limit {limit}", unit.name, worst[which]));
        }
    }
    problems
}

#[allow(dead_code)] // the test that compares the files includes this one as a module
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/units");
    std::fs::create_dir_all(&folder)?;
    for scene in scenes::all() {
        problems(&scene.unit()).iter().for_each(|problem| println!("{}: {problem}", scene.file));
    }
    for (name, text) in drawn() {
        let path = folder.join(name).with_extension("toml");
        std::fs::write(&path, text)?;
    }
    for (name, unit) in cuts::all()? {
        problems(&unit).iter().for_each(|problem| println!("{name}: {problem}"));
        std::fs::write(folder.join(&name).with_extension("toml"), unit.to_toml())?;
    }
    Ok(())
}
