use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use trodden::units::{Areas, Unit, UnitLibrary};

#[path = "../../../examples/draw_units/main.rs"]
mod draw_units;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/units")
}

#[test]
fn the_drawn_units_are_what_the_example_draws() {
    let drawn = draw_units::drawn();
    assert!(drawn.len() >= 16);
    for (name, text) in drawn {
        let kept = fs::read_to_string(folder().join(&name).with_extension("toml")).unwrap_or_default();
        assert!(kept == text, "floorplans/units/{name}.toml differs: run `cargo run --release --example draw_units`");
    }
}

#[test]
fn every_file_is_built_in_and_the_folder_is_the_library() {
    let mut files: Vec<String> =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    files.sort();
    let mut built_in: Vec<&str> = UnitLibrary::built_in_files().iter().map(|(name, _)| *name).collect();
    built_in.sort_unstable();
    assert_eq!(files, built_in);
    assert_eq!(UnitLibrary::open(Some(&folder())).unwrap(), UnitLibrary::built_in().unwrap());
}

#[test]
fn everybody_in_a_unit_moves_as_people_do_and_can_be_found() {
    let units = UnitLibrary::built_in().unwrap().units;
    let (mut counts, mut compositions) = (BTreeSet::new(), BTreeSet::new());
    for unit in &units {
        assert_eq!(draw_units::problems(unit), [""; 0]);
        // Units begin where people are judged, and fit where they are played.
        assert!(unit.starts_within(&Areas::default()), "{}", unit.name);
        assert!(unit.area_m[0] <= 3.0 && (3.5..=7.0).contains(&unit.area_m[1]), "{}: {:?}", unit.name, unit.area_m);
        assert!((3.0..=12.0).contains(&unit.duration_s), "{}", unit.name);
        counts.insert(unit.members.len());
        compositions.insert(unit.composition());
    }
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
    assert!(compositions.len() >= 16, "{compositions:?}");
    let cut = |unit: &&Unit| unit.description.starts_with("cut out");
    assert!(units.iter().filter(cut).count() >= 4 && units.iter().filter(|unit| !cut(unit)).count() >= 16);
}

#[test]
fn somebody_stands_and_somebody_turns_in_the_drawn_scenes() {
    let library = UnitLibrary::built_in().unwrap();
    let unit = |name: &str| library.units.iter().find(|unit| unit.name == name).unwrap();
    let stood_s = |unit: &Unit, member: usize| {
        let speeds = (0..(unit.duration_s * 10.0) as u32).map(|k| unit.moment(member, f64::from(k) * 0.1, false));
        speeds.filter(|moment| moment.velocity_m_s.length() < 0.05).count() as f64 * 0.1
    };
    let talks = unit("a pair stops to talk");
    assert!(stood_s(talks, 0) > 3.0 && stood_s(talks, 1) > 3.0);
    // They face each other meanwhile.
    let [one, other] = [0, 1].map(|member| talks.moment(member, 4.5, false));
    let between = (other.place_m - one.place_m).normalized().unwrap();
    assert!(one.heading.dot(between) > 0.9 && other.heading.dot(between) < -0.9);
    assert!(stood_s(unit("ties a shoe"), 0) > 3.0);
    let late = unit("notices the viewer late");
    let aside = (0..64).map(|k| late.moment(0, f64::from(k) * 0.1, false).place_m).filter(|p| p.y.abs() < 0.3);
    assert!(aside.map(|p| p.x).fold(f64::INFINITY, f64::min) > 0.5);
}
