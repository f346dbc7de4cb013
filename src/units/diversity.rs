use serde::{Deserialize, Serialize};

use super::areas::{Areas, SpotFrame};
use super::track::TrackState;
use crate::math::{Vec2, ln};
use crate::motion::Frame;

/// Width of a speed class, metres per second.
const SPEED_CLASS_M_S: f64 = 0.2;
/// Number of speed classes; the last holds all higher speeds.
const SPEED_CLASSES: usize = 11;
/// Number of heading classes, 30 degrees each.
const HEADING_CLASSES: usize = 12;

/// Diversity of speeds and headings in the area in front of a spot: entropies of their histograms.
///
/// `H = - sum p log2 p` over classes of 0.2 m/s and of 30 degrees, each person counted once per frame: 0 bits if all are
/// in one class, log2 11 = 3.46 and log2 12 = 3.58 bits if all classes are equally frequent.
#[derive(Clone, Debug, PartialEq)]
pub struct Diversity {
    frame: SpotFrame,
    areas: Areas,
    speeds: [u64; SPEED_CLASSES],
    headings: [u64; HEADING_CLASSES],
    /// Sines and cosines of the classes' middles.
    middles: Vec<Vec2>,
}

/// Measured diversity of speeds and headings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DiversityReport {
    /// Entropy of speeds, bits.
    pub speed_bits: f64,
    /// Entropy of headings, bits.
    pub heading_bits: f64,
    /// Number of samples, people times frames.
    pub samples: u64,
}

impl Diversity {
    /// Starts measuring at a spot.
    pub fn new(frame: SpotFrame, areas: Areas) -> Diversity {
        let middle = |k: usize| {
            let (sin, cos) = crate::math::sin_cos((k as f64 + 0.5) * std::f64::consts::TAU / HEADING_CLASSES as f64);
            Vec2 { x: cos, y: sin }
        };
        Diversity {
            frame,
            areas,
            speeds: [0; SPEED_CLASSES],
            headings: [0; HEADING_CLASSES],
            middles: (0..HEADING_CLASSES).map(middle).collect(),
        }
    }

    /// Counts the people of a frame in the area in front of the viewer.
    pub fn push(&mut self, frame: &Frame) {
        for walker in &frame.walkers {
            if !self.areas.is_played(self.frame.of_plan(walker.position_m)) {
                continue;
            }
            let heading = walker.heading.or_else(|| walker.velocity_m_s.normalized());
            self.count(walker.velocity_m_s.length(), heading.map(|heading| self.frame.turn_of_plan(heading)));
        }
    }

    /// Counts a person, viewer's frame, if in the area in front of the viewer.
    pub(super) fn count_within(&mut self, moment: &TrackState) {
        if self.areas.is_played(moment.place_m) {
            self.count(moment.velocity_m_s.length(), Some(moment.heading));
        }
    }

    /// Counts a speed and a heading, viewer's frame.
    pub fn count(&mut self, speed_m_s: f64, heading: Option<Vec2>) {
        let class = ((speed_m_s / SPEED_CLASS_M_S) as usize).min(SPEED_CLASSES - 1);
        self.speeds[class] += 1;
        let Some(heading) = heading else { return };
        // The nearest middle: no angle needs to be worked out.
        let nearest = (0..HEADING_CLASSES)
            .max_by(|&a, &b| self.middles[a].dot(heading).total_cmp(&self.middles[b].dot(heading)))
            .unwrap_or(0);
        self.headings[nearest] += 1;
    }

    /// The diversity measured so far.
    pub fn report(&self) -> DiversityReport {
        DiversityReport {
            speed_bits: entropy_bits(&self.speeds),
            heading_bits: entropy_bits(&self.headings),
            samples: self.speeds.iter().sum(),
        }
    }
}

fn entropy_bits(counts: &[u64]) -> f64 {
    let total = counts.iter().sum::<u64>() as f64;
    let share = |&count: &u64| count as f64 / total;
    let bits = counts.iter().filter(|&&count| count > 0).map(share).map(|p| -p * ln(p)).sum::<f64>();
    // An empty sum is a negative zero.
    bits / std::f64::consts::LN_2 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::motion::Walker;

    fn measured(walkers: &[(Vec2, Vec2)]) -> DiversityReport {
        let mut diversity = Diversity::new(SpotFrame { at_m: vec2(0.0, 0.0), ahead: vec2(0.0, 1.0) }, Areas::default());
        let walker =
            |&(position_m, velocity_m_s): &(Vec2, Vec2)| Walker { id: 0, position_m, velocity_m_s, heading: None };
        diversity.push(&Frame { time_s: 0.0, walkers: walkers.iter().map(walker).collect() });
        diversity.report()
    }

    #[test]
    fn all_alike_is_nothing_and_four_kinds_are_two_bits() {
        let at = vec2(0.5, 3.0);
        let alike = measured(&[(at, vec2(1.3, 0.1)); 8]);
        assert_eq!((alike.speed_bits, alike.heading_bits, alike.samples), (0.0, 0.0, 8));
        let four =
            measured(&[(at, vec2(1.3, 0.1)), (at, vec2(0.1, 0.5)), (at, vec2(-0.9, -0.1)), (at, vec2(0.01, -0.05))]);
        assert!((four.speed_bits - 2.0).abs() < 1e-12 && (four.heading_bits - 2.0).abs() < 1e-12, "{four:?}");
    }

    #[test]
    fn only_the_area_in_front_counts() {
        let walks = vec2(1.0, 0.0);
        let two = [(vec2(0.0, 1.0), walks), (vec2(0.0, -1.0), walks), (vec2(2.0, 1.0), walks), (vec2(0.0, 8.0), walks)];
        assert_eq!(measured(&two).samples, 1);
        assert_eq!(measured(&[]), DiversityReport::default());
    }
}
