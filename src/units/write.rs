//! Writes a unit as a file.

use std::fmt::Write;

use super::track::TrackSample;
use super::unit::Unit;
use crate::math::atan2;

impl Unit {
    /// The unit as the text of a unit file, which [`Unit::parse`] reads.
    ///
    /// Positions are rounded to a millimetre, headings to a tenth of a degree.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        let quoted = |text: &str| toml::Value::String(text.to_string()).to_string();
        let _ = writeln!(text, "name = {}", quoted(&self.name));
        if !self.description.is_empty() {
            let _ = writeln!(text, "description = {}", quoted(&self.description));
        }
        let [width_m, depth_m] = self.area_m;
        let _ = writeln!(text, "area = [{}, {}]", float(width_m, 3), float(depth_m, 3));
        let _ = writeln!(text, "duration = {}", float(self.duration_s, 3));
        let _ = writeln!(text, "viewer = [{}]", self.viewer_rows());
        for member in &self.members {
            let alone = self.members.iter().filter(|other| other.group == member.group).count() == 1;
            let _ = writeln!(text, "\n[[member]]");
            if !alone {
                let _ = writeln!(text, "group = \"{}\"", letters(member.group));
            }
            let _ = writeln!(text, "path = [");
            member.track.samples().iter().for_each(|sample| {
                let _ = writeln!(text, "    [{}],", row(sample));
            });
            let _ = writeln!(text, "]");
        }
        text
    }

    fn viewer_rows(&self) -> String {
        let row =
            |s: &TrackSample| format!("[{}, {}, {}]", float(s.time_s, 3), float(s.place_m.x, 3), float(s.place_m.y, 3));
        self.viewer.samples().iter().map(row).collect::<Vec<_>>().join(", ")
    }
}

/// The group's name: a, b, ..., z, ba, ...
fn letters(group: u32) -> String {
    let (rest, letter) = (group / 26, char::from(b'a' + (group % 26) as u8));
    if rest == 0 { letter.to_string() } else { format!("{}{letter}", letters(rest)) }
}

fn row(sample: &TrackSample) -> String {
    let heading_deg = atan2(sample.heading.y, sample.heading.x).to_degrees();
    let values =
        [float(sample.time_s, 3), float(sample.place_m.x, 3), float(sample.place_m.y, 3), float(heading_deg, 1)];
    values.join(", ")
}

/// A number with at most so many decimals, and a point.
fn float(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0');
    let text = if text.ends_with('.') { format!("{text}0") } else { text.to_string() };
    // Zero is never written with a sign.
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') { "0.0".to_string() } else { text }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::UnitLibrary;
    use super::*;

    #[test]
    fn a_unit_written_and_read_is_the_same_and_so_is_its_text() {
        for unit in &UnitLibrary::built_in().unwrap().units {
            let text = unit.to_toml();
            let again = Unit::parse(&text, Path::new("again.toml")).unwrap();
            assert_eq!(again.to_toml(), text);
            assert_eq!((&again.name, &again.description), (&unit.name, &unit.description));
            assert_eq!((again.area_m, again.duration_s), (unit.area_m, unit.duration_s));
            assert_eq!(again.groups(), unit.groups());
            for (a, b) in again.members.iter().zip(&unit.members) {
                for k in 0..20 {
                    let time_s = unit.duration_s * f64::from(k) / 20.0;
                    let (a, b) = (a.track.at(time_s), b.track.at(time_s));
                    assert!(a.place_m.distance(b.place_m) < 2e-3 && a.heading.distance(b.heading) < 2e-3);
                }
            }
        }
    }

    #[test]
    fn names_with_quotes_and_groups_beyond_z_are_written() {
        assert_eq!([letters(0), letters(25), letters(26)], ["a", "z", "ba"]);
        assert_eq!([float(1.0, 3), float(-0.0001, 3), float(2.345_67, 3)], ["1.0", "0.0", "2.346"]);
        let mut unit = UnitLibrary::built_in().unwrap().units[0].clone();
        unit.name = "the \"late\" one \\ \u{fc}".to_string();
        assert_eq!(Unit::parse(&unit.to_toml(), Path::new("a.toml")).unwrap().name, unit.name);
    }
}
