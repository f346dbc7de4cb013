use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::math::Vec2;
use crate::units::DiversityReport;

/// Number of combinations of groups without a unit that a warning names.
const NAMED: usize = 4;

/// Report of the units played at one spot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpotReport {
    /// Name of the spot.
    pub name: String,
    /// Place of the viewer, metres.
    pub place_m: Vec2,
    /// Number of units played.
    pub splices: u64,
    /// Number of times that each unit was played, by name.
    pub by_unit: BTreeMap<String, u64>,
    /// Number of parts that people took.
    pub people: u64,
    /// Distance of people from the beginning of their part when they took it over, metres.
    pub position_error_m: MeanAndMax,
    /// Angle between their heading and that of the part, degrees.
    pub heading_error_deg: MeanAndMax,
    /// Time in which they moved over, seconds.
    pub move_over_s: MeanAndMax,
    /// Time in which people played their parts, all together, seconds.
    pub led_s: f64,
    /// Distance that they walked meanwhile, metres.
    pub led_m: f64,
    /// Number of parts broken off because others were in the way.
    pub broken_off: u64,
    /// Time in which people were in the front or rear area, seconds.
    #[serde(default)]
    pub there_s: f64,
    /// Part of that time in which at least one unit was played, seconds.
    #[serde(default)]
    pub played_s: f64,
    /// Number of looks at people who could have played, but began no unit.
    pub moments: u64,
    /// Of these: no unit has as many people in the same groups.
    pub unmatched: u64,
    /// Of these: a unit has, but people are too far from its beginning.
    pub too_far: u64,
    /// Of these: walls or others are in the way.
    pub in_the_way: u64,
    /// Of these: people stand at a stop, or make way for others.
    pub not_free: u64,
    /// Sizes of groups in front and behind for which there was no unit, and how often.
    pub missing: BTreeMap<String, u64>,
    /// Number of units that fit the floor around the spot, and number of all units.
    pub fitting: [usize; 2],
    /// Diversity of speeds and headings in the area in front.
    pub diversity: DiversityReport,
}

/// Mean and largest of many values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanAndMax {
    /// Mean; 0 without values.
    pub mean: f64,
    /// Largest value; at least 0.
    pub largest: f64,
    /// Number of values.
    pub count: u64,
}

impl MeanAndMax {
    /// Adds a value.
    pub(super) fn push(&mut self, value: f64) {
        self.count += 1;
        self.mean += (value - self.mean) / self.count as f64;
        self.largest = self.largest.max(value);
    }
}

impl SpotReport {
    /// Warns of a spot at which no unit was played, and says why.
    pub fn warning(&self) -> Option<String> {
        let SpotReport { name, place_m: Vec2 { x, y }, .. } = self;
        let [fitting, units] = self.fitting;
        if self.splices > 0 || units == 0 {
            return None;
        }
        let begin = format!("{name} at [{x:.2}, {y:.2}]: no unit was played");
        if fitting == 0 {
            return Some(format!(
                "{begin}: walls or the viewer are in the way of each of the {units} units; turn the viewer or move the spot"
            ));
        }
        if self.moments == 0 {
            return Some(format!("{begin}: no people came by"));
        }
        let mut missing: Vec<(&String, &u64)> = self.missing.iter().collect();
        missing.sort_by(|a, b| b.1.cmp(a.1).then(a.0.cmp(b.0)));
        let named: Vec<String> =
            missing.iter().take(NAMED).map(|(who, times)| format!("{who} ({times} times)")).collect();
        let people = if named.is_empty() {
            String::new()
        } else {
            format!("; groups in front | behind without a unit: {}", named.join(", "))
        };
        Some(format!(
            "{begin} in {} moments: in {} no unit had the same groups, in {} they were too far off, in {} walls or others \
             were in the way{people}",
            self.moments, self.unmatched, self.too_far, self.in_the_way
        ))
    }

    /// Summary in one line.
    pub fn describe(&self) -> String {
        let DiversityReport { speed_bits, heading_bits, .. } = self.diversity;
        format!(
            "{}: {} units played by {} people, {:.0} % of the time that anybody was there, {} left early; taken over {:.2} m and {:.0} degrees off (at most {:.2} m, \
             {:.0} degrees), moved over in {:.1} s; speeds differ by {speed_bits:.2} bits, headings by {heading_bits:.2}",
            self.name,
            self.splices,
            self.people,
            100.0 * self.played_s / self.there_s.max(1e-9),
            self.broken_off,
            self.position_error_m.mean,
            self.heading_error_deg.mean,
            self.position_error_m.largest,
            self.heading_error_deg.largest,
            self.move_over_s.mean
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_is_mean_and_largest() {
        let mut spread = MeanAndMax::default();
        [1.0, 4.0, 1.0].into_iter().for_each(|value| spread.push(value));
        assert_eq!(spread, MeanAndMax { mean: 2.0, largest: 4.0, count: 3 });
    }

    #[test]
    fn only_a_spot_without_any_unit_is_warned_of() {
        let mut report =
            SpotReport { name: "kiosk".into(), fitting: [3, 5], moments: 7, unmatched: 7, ..Default::default() };
        report.missing.insert("2+2 | 1".into(), 7);
        let warning = report.warning().unwrap();
        assert!(warning.contains("kiosk") && warning.contains("2+2 | 1 (7 times)"), "{warning}");
        assert!(SpotReport { fitting: [0, 5], ..report.clone() }.warning().unwrap().contains("walls"));
        assert_eq!(SpotReport { splices: 1, ..report }.warning(), None);
    }
}
