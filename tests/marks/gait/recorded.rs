//! Recorded heads in a crowd that is squeezed through: they stop and go, sway far, are lost for a moment, and stand in the
//! file in any order. Steps stay as long as people's at the speed of the moment.

use std::fmt::Write;

use trodden::math::{SplitMix64, Vec2, sin_cos, vec2};
use trodden::motion::{Frame, Walker};
use trodden::recordings::{Recording, RecordingOptions};

use super::TAU;
use super::measure::{Floor, Path};
use super::strides::{SHUFFLING_M_S, by_speed, strides};

const PEOPLE: u32 = 40;
const SECONDS: f64 = 40.0;
/// Somebody is lost about so often a second, and for so long, seconds.
const LOST_PER_S: f64 = 0.1;
const LOST_S: f64 = 0.6;

/// Somebody who goes along x at 0.5 m/s in the mean: half of the time not at all, then at up to 1.8 m/s, and sways 0.15
/// to 0.2 m to both sides every 2 to 4 seconds all the while, pushed rather than in a stride.
fn squeezed(id: u32) -> impl Fn(f64) -> Vec2 {
    let mut draws = SplitMix64::new(u64::from(id) + 500);
    let mut draw = move |from: f64, to: f64| from + (to - from) * f64::from(draws.unit());
    let (sway_m, sway_s, phase) = (draw(0.15, 0.2), draw(2.0, 4.0), draw(0.0, TAU));
    let (wave_s, wave_phase, mean_m_s) = (draw(6.0, 12.0), draw(0.0, 1.0), draw(0.45, 0.55));
    move |t: f64| {
        let waves = t / wave_s + wave_phase;
        let going = (2.0 * waves.fract() - 1.0).max(0.0);
        let surge = going - 0.8 / TAU * sin_cos(TAU * going).0;
        let (side, _) = sin_cos(TAU * t / sway_s + phase);
        vec2(20.0 + mean_m_s * wave_s * (waves.floor() + surge), 20.0 + 3.0 * f64::from(id) + sway_m * side)
    }
}

/// Everybody as a CSV at a rate, a line for each place, shuffled.
fn recording(fps: f64) -> String {
    let mut draws = SplitMix64::new(7);
    let mut rows: Vec<(u64, String)> = Vec::new();
    for id in 0..PEOPLE {
        let place = squeezed(id);
        let mut back = 0;
        for frame in 0..(SECONDS * fps) as u32 {
            // Never twice without being seen in between: that would be too long for somebody who did not leave.
            if frame > back && f64::from(draws.unit()) < LOST_PER_S / fps {
                back = frame + (LOST_S * fps) as u32;
            }
            if frame < back {
                continue;
            }
            let mut noise = || 0.004 * f64::from(draws.normal());
            let (time_s, at) = (f64::from(frame) / fps, place(f64::from(frame) / fps));
            let row = format!("{},{time_s:.4},{:.4},{:.4}", id + 1, at.x + noise(), at.y + noise());
            rows.push((draws.next_u64(), row));
        }
    }
    rows.sort();
    let mut text = "id,time_s,x_m,y_m\n".to_owned();
    rows.iter().for_each(|(_, row)| writeln!(text, "{row}").unwrap());
    text
}

/// Everybody's path as the recording shows it.
fn paths(text: &str) -> Vec<Path> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("heads.csv");
    std::fs::write(&file, text).unwrap();
    let recording = Recording::open(&file, &RecordingOptions::default()).unwrap();
    assert_eq!((recording.survey().people, recording.survey().returns), (PEOPLE as usize, 0));
    let mut paths: Vec<Path> = (0..PEOPLE).map(|id| Path { id, at: Vec::new() }).collect();
    let (mut motion, mut frame) = (recording.motion().unwrap(), Frame::default());
    while motion.next_frame(&mut frame).unwrap() {
        for &walker in &frame.walkers {
            let id = walker.id - 1;
            paths[id as usize].at.push((frame.time_s, Walker { id, ..walker }));
        }
    }
    paths
}

#[test]
fn heads_that_sway_stop_and_go_take_steps_as_long_as_peoples() {
    let floor = Floor::hall();
    for fps in [2.5, 5.0, 10.0, 25.0, 60.0] {
        let of_person = |seen: &Path| strides(&floor, seen, &Path::of(seen.id, SECONDS, 25.0, squeezed(seen.id)));
        let all: Vec<_> = paths(&recording(fps)).iter().flat_map(of_person).collect();
        let bins = by_speed(&all);
        for bin in bins.iter().filter(|bin| bin.speed_m_s >= SHUFFLING_M_S && bin.count >= 50) {
            println!(
                "{fps} Hz: {:.2} m/s, {} steps of {:.3} m: {:+.3}",
                bin.speed_m_s,
                bin.count,
                bin.step_m,
                bin.off()
            );
            assert!(bin.off().abs() < 0.15, "{fps} Hz: steps of {:.3} m at {:.2} m/s", bin.step_m, bin.speed_m_s);
        }
        assert!(bins[2].count >= 50 && bins[4].count >= 50, "{bins:?}");
    }
}
