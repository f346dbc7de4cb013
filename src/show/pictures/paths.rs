use serde::{Deserialize, Serialize};

use crate::math::Vec2;
use crate::motion::Frame;

/// Seconds between two samples of a path.
const INTERVAL_S: f64 = 0.5;
/// Most people that are followed.
const FOLLOWED: u32 = 300;

/// The path of one person.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Id of the person.
    pub id: u32,
    /// Places in the order of time.
    pub samples: Vec<PathSample>,
}

/// A person's place and speed at a moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathSample {
    /// Plan frame, metres.
    pub position_m: Vec2,
    /// Speed, metres per second.
    pub speed_m_s: f64,
}

/// Follows some of the people of a motion, for pictures.
#[derive(Clone, Debug)]
pub struct PathSampler {
    /// People whose id is a multiple of this are followed.
    every: u32,
    next_s: f64,
    paths: Vec<Path>,
}

impl PathSampler {
    /// Follows up to 300 of so many people, evenly chosen by number.
    pub fn new(people: u32) -> PathSampler {
        PathSampler { every: people.div_ceil(FOLLOWED).max(1), next_s: 0.0, paths: Vec::new() }
    }

    /// Records the places of a frame, twice a second.
    pub fn push(&mut self, frame: &Frame) {
        if frame.time_s < self.next_s {
            return;
        }
        self.next_s = frame.time_s + INTERVAL_S * (1.0 - 1e-9);
        for walker in frame.walkers.iter().filter(|walker| walker.id.is_multiple_of(self.every)) {
            let sample = PathSample { position_m: walker.position_m, speed_m_s: walker.velocity_m_s.length() };
            match self.paths.binary_search_by_key(&walker.id, |path| path.id) {
                Ok(at) => self.paths[at].samples.push(sample),
                Err(at) => self.paths.insert(at, Path { id: walker.id, samples: vec![sample] }),
            }
        }
    }

    /// The ways, by ascending id.
    pub fn into_paths(self) -> Vec<Path> {
        self.paths
    }

    /// The ways so far, by ascending id.
    pub fn paths(&self) -> &[Path] {
        &self.paths
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::motion::Walker;

    fn frame(time_s: f64, ids: std::ops::Range<u32>) -> Frame {
        let walker =
            |id| Walker { id, position_m: vec2(time_s, f64::from(id)), velocity_m_s: vec2(3.0, 4.0), heading: None };
        Frame { time_s, walkers: ids.map(walker).collect() }
    }

    #[test]
    fn some_people_are_followed_twice_a_second() {
        let mut sampler = PathSampler::new(601);
        for step in 0..=40 {
            sampler.push(&frame(f64::from(step) * 0.05, 0..601));
        }
        assert_eq!(sampler.paths().len(), 201);
        assert_eq!(sampler.paths()[1].id, 3);
        let times: Vec<f64> = sampler.paths()[1].samples.iter().map(|s| (s.position_m.x * 100.0).round()).collect();
        assert_eq!(times, [0.0, 50.0, 100.0, 150.0, 200.0]);
        assert_eq!(sampler.paths()[0].samples[0].speed_m_s, 5.0);
    }

    #[test]
    fn everybody_is_followed_where_there_are_few() {
        let mut sampler = PathSampler::new(2);
        sampler.push(&frame(0.0, 1..2));
        sampler.push(&frame(0.5, 0..2));
        assert_eq!(sampler.paths().iter().map(|p| p.samples.len()).collect::<Vec<_>>(), [1, 2]);
    }
}
