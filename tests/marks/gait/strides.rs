//! How long steps are at the speed of the moment, of people who may stop and go.

use trodden::marks::Footfalls;
use trodden::math::Vec2;
use trodden::motion::{Frame, Walker};
use trodden::patterns::Cause;

use super::measure::{Floor, Path, measured_step_m};

/// Width of a bin of speeds, metres per second, and how many there are.
const BIN_M_S: f64 = 0.2;
const BINS: usize = 12;
/// Below this speed people shuffle, metres per second; nothing was measured there.
pub const SHUFFLING_M_S: f64 = 0.4;
/// Speeds are means over so many seconds to either side, which hold no sway; over less near the ends of a path, down to
/// the last.
const REACHES_S: [f64; 3] = [0.8, 1.0, 1.2];
const LEAST_REACH_S: f64 = 0.5;
/// Somebody who takes longer for two steps stood in between, seconds.
const STOOD_S: f64 = 4.0;
/// Footfalls know of so many ticks of a tenth of a second after the one that they work on.
const DELAY_TICKS: usize = 20;

/// Two steps: half their length, and how fast the body went meanwhile.
#[derive(Clone, Copy, Debug)]
pub struct Stride {
    pub speed_m_s: f64,
    pub step_m: f64,
}

/// Steps at about one speed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bin {
    pub speed_m_s: f64,
    pub step_m: f64,
    pub count: usize,
}

impl Bin {
    /// How much longer than measured on people, as a share.
    pub fn off(&self) -> f64 {
        self.step_m / measured_step_m(self.speed_m_s) - 1.0
    }
}

/// The strides of somebody who is seen on a path, with the speeds of the path that was really gone.
pub fn strides(floor: &Floor, seen: &Path, gone: &Path) -> Vec<Stride> {
    if seen.at.len() < 2 || gone.at.len() < 2 {
        return Vec::new();
    }
    let (first_s, last_s) = (gone.at[0].0, gone.at[gone.at.len() - 1].0);
    let stride = |feet: &[(f64, Vec2)]| {
        let time_s = 0.5 * (feet[0].0 + feet[2].0);
        let most_s = (time_s - first_s).min(last_s - time_s);
        if most_s < LEAST_REACH_S || feet[2].0 - feet[0].0 > STOOD_S {
            return None;
        }
        let speed = |reach_s: f64| (gone.place(time_s + reach_s) - gone.place(time_s - reach_s)) / (2.0 * reach_s);
        let velocity = REACHES_S.iter().fold(Vec2::ZERO, |sum, &reach_s| sum + speed(reach_s.min(most_s)));
        let speed_m_s = velocity.length() / REACHES_S.len() as f64;
        Some(Stride { speed_m_s, step_m: 0.5 * feet[0].1.distance(feet[2].1) })
    };
    timed_feet(floor, seen).windows(3).filter_map(stride).collect()
}

/// Places of footfalls and when they were: a tick of the footfalls' clock is given at a time, and they come out two
/// seconds later.
fn timed_feet(floor: &Floor, path: &Path) -> Vec<(f64, Vec2)> {
    let [first, last] = [path.at[0].0, path.at[path.at.len() - 1].0].map(|time_s| time_s * 10.0);
    let mut ticks: Vec<(f64, Vec2)> =
        (first.ceil() as u64..=last.floor() as u64).map(|k| k as f64 / 10.0).map(|t| (t, path.place(t))).collect();
    let Some(&(end_s, end_m)) = ticks.last() else { return Vec::new() };
    // Footfalls take what comes after the end for its reflection.
    let newest = ticks.len() - 1;
    for n in 1..=DELAY_TICKS {
        let before_m = ticks[newest.saturating_sub(n)].1;
        ticks.push((end_s + 0.1 * n as f64, end_m * 2.0 - before_m));
    }
    let mut stage = Footfalls::new(&floor.people, &floor.walls, &floor.library, &floor.options, Vec::new()).unwrap();
    let (mut marks, mut feet) = (Vec::new(), Vec::new());
    for (time_s, position_m) in ticks {
        let walker = Walker { id: path.id, position_m, velocity_m_s: Vec2::ZERO, heading: None };
        stage.push(&Frame { time_s, walkers: vec![walker] }, &mut marks);
        let soles = marks.drain(..).filter(|mark| mark.cause == Cause::Sole);
        feet.extend(soles.map(|mark| (time_s - 0.1 * DELAY_TICKS as f64, mark.place_m)));
    }
    feet
}

/// Mean steps by speed, slowest first.
pub fn by_speed(strides: &[Stride]) -> Vec<Bin> {
    let mut bins = vec![Bin::default(); BINS];
    for stride in strides {
        if let Some(bin) = bins.get_mut((stride.speed_m_s / BIN_M_S) as usize) {
            bin.speed_m_s += stride.speed_m_s;
            bin.step_m += stride.step_m;
            bin.count += 1;
        }
    }
    for bin in &mut bins {
        let count = bin.count.max(1) as f64;
        (bin.speed_m_s, bin.step_m) = (bin.speed_m_s / count, bin.step_m / count);
    }
    bins
}
