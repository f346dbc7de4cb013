use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::math::Vec2;
use crate::units::DiversityReport;

/// So many sorts of people for whom there is no unit are named.
const NAMED: usize = 4;

/// How units were played at one spot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpotReport {
    /// What the spot is called.
    pub name: String,
    /// Where the viewer stands, metres.
    pub place_m: Vec2,
    /// How many units were played.
    pub splices: u64,
    /// The same by the unit's name.
    pub by_unit: BTreeMap<String, u64>,
    /// How many people took a part.
    pub people: u64,
    /// How far from the beginning of their part people were when it was taken over, metres.
    pub position_error_m: MeanAndMax,
    /// How far they were turned from it, degrees.
    pub heading_error_deg: MeanAndMax,
    /// How long they took to move over, seconds.
    pub move_over_s: MeanAndMax,
    /// Seconds that people played their performers, all together.
    pub led_s: f64,
    /// Metres that they walked meanwhile.
    pub led_m: f64,
    /// How many people left their part early, since somebody else came into their way.
    pub broken_off: u64,
    /// Seconds that anybody was in the front or rear area, whatever they did.
    #[serde(default)]
    pub there_s: f64,
    /// Of these: a unit, or several, was being played.
    #[serde(default)]
    pub played_s: f64,
    /// How often people were there who could have played, and no unit was begun.
    pub moments: u64,
    /// Of these: no unit has as many people in the same groups.
    pub unmatched: u64,
    /// Of these: units have, but people are too far from their beginnings.
    pub too_far: u64,
    /// Of these: walls or others are in the way.
    pub in_the_way: u64,
    /// Of these: somebody of them stood at a stop, or was just making way for somebody.
    pub not_free: u64,
    /// For which people there was no unit: sizes of groups in front and behind, with how often.
    pub missing: BTreeMap<String, u64>,
    /// How many units fit the floor before the spot, of how many.
    pub fitting: [usize; 2],
    /// How much speeds and headings differ in the area in front.
    pub diversity: DiversityReport,
}

/// Mean and largest of many values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanAndMax {
    /// The mean; 0 of none.
    pub mean: f64,
    /// The largest.
    pub largest: f64,
    /// How many there were.
    pub count: u64,
}

impl MeanAndMax {
    /// Takes one more value.
    pub fn push(&mut self, value: f64) {
        self.count += 1;
        self.mean += (value - self.mean) / self.count as f64;
        self.largest = self.largest.max(value);
    }
}

impl SpotReport {
    /// What a user should know: spots at which nothing was ever played, and why.
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
            return Some(format!("{begin}: nobody ever came by"));
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

    /// The report in words, one line.
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
