//! Reads gait off footfalls alone: how long steps are, how wide, where toes point.

use trodden::marks::{Footfalls, Mark, MarksOptions, Origin};
use trodden::math::{Vec2, atan2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

/// Where somebody was when, and where the body faced.
#[derive(Clone, Default)]
pub struct Path {
    pub id: u32,
    pub at: Vec<(f64, Walker)>,
}

impl Path {
    /// Somebody who is at `place(seconds)`, `hertz` times a second.
    pub fn of(id: u32, seconds: f64, hertz: f64, place: impl Fn(f64) -> Vec2) -> Path {
        let walker = |time_s: f64| Walker { id, position_m: place(time_s), velocity_m_s: Vec2::ZERO, heading: None };
        let times = (0..=(seconds * hertz) as u32).map(|n| f64::from(n) / hertz);
        Path { id, at: times.map(|time_s| (time_s, walker(time_s))).collect() }
    }

    /// The same with a body that faces `heading(seconds)`.
    pub fn facing(mut self, heading: impl Fn(f64) -> Vec2) -> Path {
        self.at.iter_mut().for_each(|(time_s, walker)| walker.heading = Some(heading(*time_s)));
        self
    }

    /// Every so-manieth frame.
    pub fn thinned(&self, every: usize) -> Path {
        Path { id: self.id, at: self.at.iter().step_by(every).copied().collect() }
    }

    /// Place at a time, in a straight line between frames.
    pub fn place(&self, time_s: f64) -> Vec2 {
        let next = self.at.partition_point(|(at_s, _)| *at_s < time_s).clamp(1, self.at.len() - 1);
        let ((a_s, a), (b_s, b)) = (self.at[next - 1], self.at[next]);
        a.position_m.lerp(b.position_m, ((time_s - a_s) / (b_s - a_s)).clamp(0.0, 1.0))
    }

    /// Mean velocity over two seconds around a time, which holds no sway; `None` near the ends.
    pub fn velocity(&self, time_s: f64) -> Option<Vec2> {
        let (first_s, last_s) = (self.at[0].0, self.at[self.at.len() - 1].0);
        let around = |reach_s: f64| (self.place(time_s + reach_s) - self.place(time_s - reach_s)) / (2.0 * reach_s);
        (time_s - 1.2 >= first_s && time_s + 1.2 <= last_s).then(|| (around(0.8) + around(1.0) + around(1.2)) / 3.0)
    }

    /// When the body came closest to a place, looked for in the two seconds after a time.
    fn nearest_s(&self, place_m: Vec2, after_s: f64) -> f64 {
        let times = (0..200).map(|n| after_s + 0.01 * f64::from(n));
        let distance = |time_s: &f64| self.place(*time_s).distance(place_m);
        times.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    }
}

/// What marks are made with.
pub struct Floor {
    pub people: People,
    pub walls: Walls,
    pub library: PatternLibrary,
    pub options: MarksOptions,
    pub crowd: usize,
}

impl Floor {
    /// An empty hall of 200 x 200 m.
    pub fn hall() -> Floor {
        let plan = FloorPlan::from_mask(200, 200, 1.0, vec![1; 200 * 200]);
        Floor {
            people: People::new(7, BodyOptions::default()),
            walls: Walls::trace(&plan, &WallsOptions::default()),
            library: PatternLibrary::built_in(),
            options: MarksOptions::default(),
            crowd: 1000,
        }
    }

    /// Marks of one person.
    pub fn marks(&self, path: &Path) -> Vec<Mark> {
        let origins = vec![Origin::default(); self.crowd];
        let mut stage = Footfalls::new(&self.people, &self.walls, &self.library, &self.options, origins).unwrap();
        let mut marks = Vec::new();
        for &(time_s, walker) in &path.at {
            stage.push(&Frame { time_s, walkers: vec![walker] }, &mut marks);
        }
        stage.finish(&mut marks);
        marks
    }

    /// Footfalls of one person.
    pub fn feet(&self, path: &Path) -> Vec<Mark> {
        let mut marks = self.marks(path);
        marks.retain(|mark| mark.cause == Cause::Sole);
        marks
    }

    /// Heel marks of one person.
    pub fn heels(&self, path: &Path) -> usize {
        self.marks(path).iter().filter(|mark| mark.cause == Cause::Heel).count()
    }
}

/// A step, from one foot to the other.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Between the feet's middles.
    pub length_m: f64,
    /// Distance of the foot from the line between the ones before and after.
    pub width_m: f64,
    /// How far the toes point outward from the way of the body.
    pub toe_out_rad: f64,
    /// Speed of the body over the two seconds around.
    pub speed_m_s: f64,
}

/// The steps of footfalls along a path, where the body moves on at 0.05 m/s or more.
pub fn steps(path: &Path, feet: &[Mark]) -> Vec<Step> {
    let mut time_s = path.at[0].0;
    let mut found = Vec::new();
    for feet in feet.windows(3) {
        let middle_m = feet[0].place_m.lerp(feet[1].place_m, 0.5);
        time_s = path.nearest_s(middle_m, (time_s - 0.3).max(path.at[0].0));
        let Some(velocity) = path.velocity(time_s) else { continue };
        let Some(way) = velocity.normalized().filter(|_| velocity.length() > 0.05) else { continue };
        let Some(line) = (feet[2].place_m - feet[0].place_m).normalized() else { continue };
        let outward = if feet[1].mirrored { -1.0 } else { 1.0 };
        found.push(Step {
            length_m: feet[0].place_m.distance(feet[1].place_m),
            width_m: outward * line.cross(feet[1].place_m - feet[0].place_m),
            toe_out_rad: outward * atan2(way.cross(feet[1].heading), way.dot(feet[1].heading)),
            speed_m_s: velocity.length(),
        });
    }
    found
}

/// Mean and standard deviation.
pub fn spread(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let values: Vec<f64> = values.into_iter().collect();
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    [mean, (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count).sqrt()]
}

/// The measured law of `reference-numbers`: step length [m] at a speed from 0.4 m/s on.
pub fn measured_step_m(speed_m_s: f64) -> f64 {
    0.247 + 0.344 * speed_m_s
}

/// Prints a table of steps by bins of speed and returns `(speed, mean length, count)` of each.
pub fn by_speed(title: &str, steps: &[Step], bin_m_s: f64) -> Vec<(f64, f64, usize)> {
    println!("{title}: {} steps", steps.len());
    println!("  v m/s     n  length m   sd    law   ratio  width cm   sd  toe-out deg  sd");
    let mut rows = Vec::new();
    for bin in 0..(2.2 / bin_m_s) as usize {
        let low = bin as f64 * bin_m_s;
        let within: Vec<&Step> = steps.iter().filter(|s| (low..low + bin_m_s).contains(&s.speed_m_s)).collect();
        if within.is_empty() {
            continue;
        }
        let of = |value: fn(&Step) -> f64| spread(within.iter().map(|step| value(step)));
        let [speed, _] = of(|step| step.speed_m_s);
        let ([length, sd], [width, width_sd], [toe, toe_sd]) =
            (of(|step| step.length_m), of(|step| step.width_m), of(|step| step.toe_out_rad.to_degrees()));
        let law = measured_step_m(speed);
        println!(
            "  {speed:5.2} {:5}  {length:7.3} {sd:6.3} {law:6.3} {:6.2} {:8.1} {:6.1} {toe:8.1} {toe_sd:8.1}",
            within.len(),
            length / law,
            100.0 * width,
            100.0 * width_sd
        );
        rows.push((speed, length, within.len()));
    }
    rows
}
