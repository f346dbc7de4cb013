//! Footfalls stay plausible whatever the recording: heads sway, places jitter, people are missing for a moment, rates
//! change. Steps are as long as people's at their speed.

use std::collections::BTreeMap;
use std::fmt::Write;

use trodden::marks::{Footfalls, MarksOptions};
use trodden::math::{SplitMix64, sin_cos};
use trodden::motion::{BodyOptions, Frame, People};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

use super::{frames, options};

/// The straight line through what was measured on heads in a corridor of 1.8 m, metres at metres per second.
fn step_length_m(speed_m_s: f64) -> f64 {
    0.247 + 0.344 * speed_m_s
}

const SPEEDS_M_S: [f64; 5] = [0.4, 0.7, 1.0, 1.3, 1.6];

/// Somebody walks along x, bends and goes on, at a steady speed; the head sways to the side once in a stride and forward
/// and back once in a step, and the camera is off by some millimetres.
struct Head {
    id: u32,
    speed_m_s: f64,
    noise: SplitMix64,
}

impl Head {
    fn at(&mut self, time_s: f64) -> (f64, f64) {
        let v = self.speed_m_s;
        let steps = time_s * v / step_length_m(v) + 0.37 * f64::from(self.id);
        // 3 cm at free speed, 7 cm when slow.
        let sway_m = (0.07 - 0.04 * (v - 0.4) / 0.9).clamp(0.03, 0.07);
        let (side, _) = sin_cos(std::f64::consts::PI * steps);
        let (forward, _) = sin_cos(2.0 * std::f64::consts::PI * steps);
        let way_m = v * time_s + 0.015 * forward;
        let (half, turn_m) = (6.0, 1.5 * std::f64::consts::FRAC_PI_2);
        // Straight on, a bend of 1.5 m radius to the left, straight on.
        let (x, y, (sin, cos)) = if way_m < half {
            (way_m, 0.0, (0.0, 1.0))
        } else if way_m < half + turn_m {
            let (sin, cos) = sin_cos((way_m - half) / 1.5);
            (half + 1.5 * sin, 1.5 * (1.0 - cos), (sin, cos))
        } else {
            (half + 1.5, 1.5 + way_m - half - turn_m, (1.0, 0.0))
        };
        let mut jitter = || 0.004 * f64::from(self.noise.normal());
        (x - sway_m * side * sin + jitter(), 3.0 * f64::from(self.id) + y + sway_m * side * cos + jitter())
    }
}

/// Everybody walks for 12 m; `rate` gives the frames per second at a time. Every now and then somebody is missing.
fn recording(rate: impl Fn(f64) -> f64) -> String {
    let mut heads: Vec<Head> = (0..20)
        .map(|id| Head { id, speed_m_s: SPEEDS_M_S[id as usize % 5], noise: SplitMix64::new(u64::from(id)) })
        .collect();
    let mut text = "id,time_s,x,y\n".to_owned();
    let mut lost = SplitMix64::new(99);
    let mut back_s = [0.0; 20];
    let mut time_s = 0.0;
    while time_s < 30.0 {
        for (head, back_s) in heads.iter_mut().zip(&mut back_s) {
            let (x, y) = head.at(time_s);
            if time_s * head.speed_m_s > 12.0 || time_s < *back_s {
                continue;
            }
            if f64::from(lost.unit()) < 0.15 / rate(time_s) {
                *back_s = time_s + 0.5;
            }
            writeln!(text, "{},{time_s:.4},{x:.4},{y:.4}", head.id).unwrap();
        }
        time_s += 1.0 / rate(time_s);
    }
    text
}

/// Mean step length of everybody with a speed, half of the way between two prints of a foot.
fn step_lengths_m(frames: &[Frame]) -> Vec<f64> {
    let plan = FloorPlan::open_ground(trodden::math::Rect::around(
        trodden::math::vec2(-5.0, -5.0),
        trodden::math::vec2(20.0, 75.0),
    ))
    .unwrap();
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let people = People::new(1, BodyOptions::default());
    let library = PatternLibrary::built_in();
    let mut lengths: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
    for id in 0..20 {
        let mut footfalls = Footfalls::new(&people, &walls, &library, &MarksOptions::default(), Vec::new()).unwrap();
        let mut marks = Vec::new();
        for frame in frames {
            let walkers = frame.walkers.iter().copied().filter(|walker| walker.id == id).collect();
            footfalls.push(&Frame { time_s: frame.time_s, walkers }, &mut marks);
        }
        footfalls.finish(&mut marks);
        marks.retain(|mark| mark.cause == Cause::Sole);
        let strides = marks.windows(3).map(|m| 0.5 * m[0].place_m.distance(m[2].place_m));
        lengths.entry(id % 5).or_default().extend(strides);
    }
    lengths.values().map(|all| all.iter().sum::<f64>() / all.len() as f64).collect()
}

fn assert_plausible(what: &str, text: &str, people: usize) {
    let (recording, frames) = frames(text, &options());
    let survey = recording.survey();
    assert_eq!((survey.people, survey.returns), (people, 0), "{what}: {survey:?}");
    assert!((survey.mean_speed_m_s - 0.8).abs() < 0.15, "{what}: {}", survey.mean_speed_m_s);
    for (speed_m_s, length_m) in SPEEDS_M_S.into_iter().zip(step_lengths_m(&frames)) {
        let expected_m = step_length_m(speed_m_s);
        let off = length_m / expected_m - 1.0;
        assert!(off.abs() < 0.15, "{what}: steps of {length_m:.3} m at {speed_m_s} m/s, expected {expected_m:.3}");
    }
}

#[test]
fn steps_are_as_long_as_peoples_at_any_rate() {
    for fps in [2.5, 5.0, 10.0, 16.0, 25.0, 60.0] {
        assert_plausible(&format!("{fps} Hz"), &recording(|_| fps), 20);
    }
}

#[test]
fn steps_are_as_long_as_peoples_where_rates_change() {
    let rate = |time_s: f64| [2.5, 60.0, 10.0, 25.0][(time_s / 2.0) as usize % 4];
    assert_plausible("2.5 to 60 Hz", &recording(rate), 20);
}
