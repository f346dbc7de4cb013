use proptest::prelude::*;

use super::*;
use crate::marks::{HeelOptions, SoilOptions};
use crate::math::{Distribution, Vec2, sin_cos, vec2};
use crate::motion::BodyOptions;
use crate::plan::FloorPlan;
use crate::walls::WallsOptions;

/// A hall of 100 x 100 m from the origin; its walls are far from the paths.
fn hall() -> Walls {
    walls_of(200, 200, 0.5, |_, _| true)
}

fn walls_of(width: u32, height: u32, metres_per_pixel: f64, floor: impl Fn(f64, f64) -> bool) -> Walls {
    let middle = |n: u32| (f64::from(n) + 0.5) * metres_per_pixel;
    let pixels = (0..height).rev().flat_map(|row| (0..width).map(move |column| (middle(column), middle(row))));
    let mask = pixels.map(|(x, y)| u8::from(floor(x, y))).collect();
    let plan = FloorPlan::from_mask(width, height, metres_per_pixel, mask);
    Walls::trace(&plan, &WallsOptions::default())
}

/// Bodies without spread in the measured properties.
fn even_bodies() -> BodyOptions {
    BodyOptions {
        children: 0.0,
        step_width: Distribution::Constant(0.08),
        toe_out_deg: Distribution::Constant(6.5),
        ..BodyOptions::default()
    }
}

struct Case {
    people: People,
    walls: Walls,
    library: PatternLibrary,
    options: MarksOptions,
}

impl Case {
    fn new(walls: Walls) -> Case {
        let options = MarksOptions { heel: HeelOptions::none(), ..MarksOptions::default() };
        Case { people: People::new(5, even_bodies()), walls, library: PatternLibrary::built_in(), options }
    }

    fn stage(&self, origins: Vec<Origin>) -> Footfalls<'_> {
        Footfalls::new(&self.people, &self.walls, &self.library, &self.options, origins).unwrap()
    }

    /// Returns the marks of people who walk `path(id, seconds)` from 0 to `seconds`.
    fn marks(&self, people: u32, seconds: f64, dt: f64, path: impl Fn(u32, f64) -> Vec2) -> Vec<Mark> {
        let origins = vec![Origin { fresh: true, from_outside: true }; people as usize];
        let mut stage = self.stage(origins);
        let mut out = Vec::new();
        for n in 0..=(seconds / dt).round() as u32 {
            let time_s = f64::from(n) * dt;
            let walker = |id| Walker { id, position_m: path(id, time_s), velocity_m_s: Vec2::ZERO, heading: None };
            stage.push(&Frame { time_s, walkers: (0..people).map(walker).collect() }, &mut out);
        }
        stage.finish(&mut out);
        out
    }
}

/// A straight path along y = 50 at a constant speed.
fn straight(speed: f64) -> impl Fn(u32, f64) -> Vec2 {
    move |_, t| vec2(2.0 + speed * t, 50.0)
}

#[test]
fn step_length_follows_speed_as_measured() {
    let case = Case::new(hall());
    for (speed, expected) in [(0.45, 0.39), (0.75, 0.51), (1.05, 0.62), (1.35, 0.72), (1.7, 0.82)] {
        let people = 40;
        let count = case.marks(people, 40.0, 0.1, straight(speed)).len() as f64;
        let step = f64::from(people) * 40.0 * speed / count;
        assert!((step / expected - 1.0).abs() < 0.1, "{step:.3} m at {speed} m/s instead of {expected}");
    }
}

#[test]
fn feet_alternate_beside_the_path_and_point_outward() {
    let case = Case::new(hall());
    let marks = case.marks(1, 50.0, 0.1, straight(1.34));
    assert!(marks.windows(2).all(|pair| pair[0].mirrored != pair[1].mirrored));
    let mean = |of: fn(&Mark) -> f64, right: bool| {
        let of_foot: Vec<f64> = marks.iter().filter(|mark| mark.mirrored == right).map(of).collect();
        of_foot.iter().sum::<f64>() / of_foot.len() as f64
    };
    for right in [false, true] {
        let side = if right { -1.0 } else { 1.0 };
        let across = mean(|mark| mark.place_m.y - 50.0, right);
        let toe_out = mean(|mark| mark.heading.y, right).to_degrees();
        assert!((across - side * 0.04).abs() < 0.006, "{across}");
        assert!((toe_out * side - 6.5).abs() < 4.0, "{toe_out}");
    }
    assert!(marks.iter().all(|mark| mark.twist_rad == 0.0), "nobody turned");
}

#[test]
fn first_foot_and_first_phase_are_random() {
    let case = Case::new(hall());
    let marks = case.marks(200, 2.5, 0.1, straight(1.34));
    let left = marks.iter().filter(|mark| !mark.mirrored).count() as f64 / marks.len() as f64;
    assert!((left - 0.5).abs() < 0.06, "{left}");
    // Steps do not align across people: their places along the path are even over a step.
    let mut bins = [0.0; 6];
    for mark in &marks {
        let along = (mark.place_m.x - 3.0) / 0.1;
        if (0.0..6.0).contains(&along) {
            bins[along as usize] += 1.0;
        }
    }
    let mean = bins.iter().sum::<f64>() / 6.0;
    assert!(bins.iter().all(|&bin| (bin / mean - 1.0_f64).abs() < 0.5), "{bins:?}");
}

#[test]
fn who_stands_prints_both_feet_and_no_more_for_swaying() {
    let mut case = Case::new(hall());
    case.options.shifts_per_minute = 0.0;
    let sway = |_, t: f64| vec2(50.0 + 0.03 * sin_cos(3.0 * t).0, 50.0 + 0.02 * sin_cos(1.3 * t).1);
    assert_eq!(case.marks(20, 60.0, 0.1, |_, _| vec2(50.0, 50.0)).len(), 40);
    let swaying = case.marks(20, 60.0, 0.1, sway).len();
    assert!((40..=50).contains(&swaying), "{swaying} prints of 20 people who sway for a minute");
    // Standing people only shift their weight now and then.
    case.options.shifts_per_minute = 2.5;
    let shifting = case.marks(20, 60.0, 0.1, sway).len();
    assert!((70..=140).contains(&shifting), "{shifting} prints of 20 people who stand for a minute");
}

#[test]
fn the_number_of_prints_does_not_depend_on_the_time_step() {
    let mut case = Case::new(hall());
    case.options.heel = HeelOptions { per_metre: 0.05, people: 20.0, ..HeelOptions::default() };
    let walk = |id: u32, t: f64| {
        let turn = 0.25 * t + f64::from(id);
        vec2(50.0, 50.0) + vec2(sin_cos(turn).1, sin_cos(turn).0) * (4.0 + 0.1 * f64::from(id))
    };
    let by_variation = |dt| {
        let mut marks = case.marks(20, 48.0, dt, walk);
        marks.sort_by_key(|mark| mark.variation);
        marks
    };
    let reference = by_variation(0.1);
    for dt in [0.05, 0.02, 0.2, 0.0625, 0.24] {
        let marks = by_variation(dt);
        // Dropped frames shorten a bent way a little: one step of one person may be missing.
        let spare = if dt > 0.1 { 1 } else { 0 };
        assert!(marks.len().abs_diff(reference.len()) <= spare, "dt {dt}: {} {}", marks.len(), reference.len());
        let worst = marks.iter().zip(&reference).map(|(a, b)| (a.place_m - b.place_m).length()).fold(0.0, f64::max);
        assert!(dt > 0.1 || worst < 0.01, "dt {dt}: {worst} m");
    }
}

#[test]
fn sway_and_jitter_do_not_become_zig_zag_feet() {
    let case = Case::new(hall());
    // (speed, amplitude, frequency): steps at 2 Hz, strides as recorded, slow strides.
    for (speed, amplitude, hertz) in
        [(1.34, 0.03, 2.0), (1.34, 0.07, 2.0), (1.34, 0.03, 0.94), (0.75, 0.06, 0.73), (0.45, 0.07, 0.58)]
    {
        let sway = |id: u32, t: f64| {
            let phase = std::f64::consts::TAU * (hertz * t + 0.37 * f64::from(id));
            // Jitter of collisions on top: a centimetre, another way every tick.
            let jitter = 0.01 * sin_cos(f64::from(id) + 97.0 * (t / 0.1).round()).0;
            vec2(2.0 + speed * t, 50.0 + amplitude * sin_cos(phase).0 + jitter)
        };
        let marks = case.marks(20, 40.0, 0.1, sway);
        let inner = marks.iter().filter(|mark| mark.place_m.x > 4.0 && mark.place_m.x < speed * 40.0);
        let (mut count, mut heading, mut across) = (0.0, 0.0, 0.0);
        for mark in inner {
            let side = if mark.mirrored { -1.0 } else { 1.0 };
            let body_heading = mark.heading.y - side * 0.113;
            heading += body_heading * body_heading;
            let off = mark.place_m.y - 50.0 - side * 0.04;
            across += off * off;
            count += 1.0;
        }
        let (heading_deg, across_m) = ((heading / count).sqrt().to_degrees(), (across / count).sqrt());
        // The spread of a person's own steps is 3 degrees and 12 mm.
        assert!(heading_deg < 5.5, "{heading_deg:.1} degrees at {speed} m/s, {amplitude} m, {hertz} Hz");
        assert!(across_m < 0.02, "{across_m:.3} m at {speed} m/s, {amplitude} m, {hertz} Hz");
        let step = speed * 40.0 * 20.0 / marks.len() as f64;
        let expected = 0.247 + 0.344 * speed;
        assert!((step / expected - 1.0).abs() < 0.1, "steps of {step:.2} m instead of {expected:.2}");
    }
}

#[test]
fn a_corner_is_not_cut() {
    let case = Case::new(hall());
    let radius = 0.7;
    let quarter = radius * std::f64::consts::FRAC_PI_2;
    let bend = |_, t: f64| {
        let s = 1.34 * t - 8.0;
        let (sin, cos) = sin_cos((s / radius).clamp(0.0, std::f64::consts::FRAC_PI_2));
        vec2(50.0 + s.min(0.0) + radius * sin, 50.0 + radius * (1.0 - cos) + (s - quarter).max(0.0))
    };
    let centre = vec2(50.0, 50.0 + radius);
    for mark in case.marks(60, 12.0, 0.1, bend) {
        if mark.place_m.x > 50.0 && mark.place_m.y < 50.0 + radius {
            let off = (mark.place_m - centre).length() - radius;
            assert!(off.abs() < 0.15, "a foot {off:.2} m off the path");
        }
    }
}

#[test]
fn turning_round_on_the_spot_gives_turned_prints() {
    let case = Case::new(hall());
    let there_and_back = |_, t: f64| vec2(50.0 + 6.0 - (t - 6.0_f64).abs(), 50.0);
    let marks = case.marks(1, 12.0, 0.1, there_and_back);
    let turned = marks.iter().filter(|mark| mark.heading.x.abs() < 0.8).count();
    assert!((1..=5).contains(&turned), "{turned} prints across the way");
    assert!(marks.iter().any(|mark| mark.twist_rad != 0.0));
    assert!(marks.last().unwrap().heading.x < -0.9);
}

#[test]
fn slow_feet_slip_less_and_none_more_than_3_cm() {
    let case = Case::new(hall());
    let slips = |speed: f64| {
        let marks = case.marks(40, 20.0, 0.1, straight(speed));
        assert!(marks.iter().all(|mark| (0.0..=0.03).contains(&mark.smear_m)));
        marks.iter().map(|mark| f64::from(mark.smear_m)).sum::<f64>() / marks.len() as f64
    };
    let (slow, normal) = (slips(0.5), slips(1.34));
    assert!((normal - 0.0134).abs() < 0.001, "{normal}");
    assert!(slow < 0.5 * normal, "{slow}");
}

#[test]
fn everybody_wears_one_sole_that_fits() {
    let case = Case { people: People::new(5, BodyOptions::default()), ..Case::new(hall()) };
    let mut worn = std::collections::BTreeMap::new();
    for mark in case.marks(300, 4.0, 0.1, |id, t| vec2(5.0 + 1.3 * t, 5.0 + 0.2 * f64::from(id))) {
        let row = ((mark.place_m.y - 5.0) / 0.2).round() as u32;
        worn.entry((mark.pattern, (mark.length_m * 1e4) as u32)).or_insert(row);
        let range = case.library.patterns[usize::from(mark.pattern)].lengths_cm.unwrap();
        let length = f64::from(mark.length_m) * 100.0;
        assert!(length > range[0] - 0.01 && length < range[1] + 0.01);
    }
    let patterns: std::collections::BTreeSet<u16> = worn.keys().map(|key| key.0).collect();
    assert!(patterns.len() >= 9, "{patterns:?}");
    let mut one = Case::new(hall());
    one.options.shoe = Some("boot".to_owned());
    assert!(one.marks(30, 4.0, 0.1, straight(1.3)).iter().all(|mark| mark.pattern == 3));
    one.options.shoe = Some("boat".to_owned());
    let error = Footfalls::new(&one.people, &one.walls, &one.library, &one.options, Vec::new()).err().unwrap();
    assert!(error.hint().unwrap().contains("did you mean \"boot\""), "{error}");
}

#[test]
fn only_the_fresh_leave_soil() {
    let case = Case::new(hall());
    let mut stage = case.stage(Origin::of_arrivals([true; 10].into_iter(), 4));
    let mut out = Vec::new();
    for n in 0..80 {
        let time_s = f64::from(n) * 0.1;
        let walker = |id| Walker {
            id,
            position_m: vec2(5.0 + 1.3 * time_s, 5.0 + 2.0 * f64::from(id)),
            velocity_m_s: Vec2::ZERO,
            heading: None,
        };
        stage.push(&Frame { time_s, walkers: (0..10).map(walker).collect() }, &mut out);
    }
    stage.finish(&mut out);
    assert_eq!(stage.count(), out.len() as u64);
    assert!(out.iter().all(|mark| (mark.soil > 0.0) == (mark.place_m.y > 16.0)));
}

/// Heel marks per square metre, straight on and in turns.
#[test]
fn heel_marks_are_as_many_as_stated_and_gather_at_turns() {
    let mut case = Case::new(walls_of(40, 400, 0.5, |_, _| true));
    case.options.heel = HeelOptions::default();
    // 1000 people through a corridor of 5 m, once straight.
    let lane = |id: u32| 7.5 + 5.0 * (f64::from(id) * 0.618_033_988_75).fract();
    let marks = case.marks(1000, 30.0, 0.2, |id, t| vec2(lane(id), 2.0 + 1.34 * t));
    let per_m2 = marks.iter().filter(|mark| mark.cause == Cause::Heel).count() as f64 / (5.0 * 40.2);
    assert!((0.2..0.5).contains(&per_m2), "{per_m2} per m2");
    // The same people on bends of 2 m radius: many more on the same way.
    let turning = case.marks(1000, 30.0, 0.2, |id, t| {
        let (sin, cos) = sin_cos(0.67 * t + f64::from(id));
        vec2(10.0 + 2.0 * cos, 100.0 + 2.0 * sin)
    });
    let ratio = turning.iter().filter(|mark| mark.cause == Cause::Heel).count() as f64 / (per_m2 * 5.0 * 40.2);
    assert!((2.5..6.0).contains(&ratio), "{ratio}");
}

#[test]
fn doors_gather_heel_marks() {
    // A wall across at x = 10 with a door of 1 m.
    let walls = walls_of(200, 100, 0.1, |x, y| !(10.0..10.2).contains(&x) || (4.5..5.5).contains(&y));
    let mut case = Case::new(walls);
    case.options.heel = HeelOptions { per_metre: 0.0, per_passage: 0.5, people: 400.0, ..HeelOptions::none() };
    let through = case.marks(400, 12.0, 0.1, |_, t| vec2(2.0 + 1.3 * t, 5.0));
    let heels: Vec<&Mark> = through.iter().filter(|mark| mark.cause == Cause::Heel).collect();
    assert!((150..250).contains(&heels.len()), "{} marks of 400 passages at 0.5 each", heels.len());
    assert!(heels.iter().all(|mark| (mark.place_m.x - 10.1).abs() < 1.2), "marks away from the door");
    let past = case.marks(400, 6.0, 0.1, |_, t| vec2(2.0 + 1.0 * t, 5.0));
    assert!(past.iter().all(|mark| mark.cause == Cause::Sole), "nobody went through");
}

#[test]
fn stops_and_starts_leave_heel_marks() {
    let mut case = Case::new(hall());
    case.options.heel = HeelOptions { per_stop: 0.25, people: 400.0, ..HeelOptions::none() };
    let stop = |_, t: f64| vec2(40.0 + 1.2 * t.min(5.0) + 1.2 * (t - 10.0).max(0.0), 50.0);
    let marks = case.marks(400, 15.0, 0.1, stop);
    let heels: Vec<&Mark> = marks.iter().filter(|mark| mark.cause == Cause::Heel).collect();
    assert!((150..250).contains(&heels.len()), "{} marks of 800 stops and starts at 0.25 each", heels.len());
    assert!(heels.iter().all(|mark| (mark.place_m.x - 46.0).abs() < 1.2), "marks away from the stop");
}

#[test]
fn marks_of_a_person_do_not_depend_on_who_else_is_there() {
    let mut case = Case::new(hall());
    case.options.heel = HeelOptions { per_metre: 0.1, people: 1.0, ..HeelOptions::default() };
    let path = |id: u32, t: f64| vec2(2.0 + 1.3 * t, 10.0 + 5.0 * f64::from(id));
    let alone = case.marks(1, 10.0, 0.1, path);
    let mut crowd = case.stage(vec![Origin { fresh: true, from_outside: true }; 1]);
    let mut out = Vec::new();
    for n in 0..=100 {
        let time_s = f64::from(n) * 0.1;
        let walker = |id| Walker { id, position_m: path(id, time_s), velocity_m_s: Vec2::ZERO, heading: None };
        // Others come and go between and around.
        let ids = [0, 3, 5, 7].into_iter().filter(|&id| id == 0 || (n + id * 11) % 60 < 40);
        crowd.push(&Frame { time_s, walkers: ids.map(walker).collect() }, &mut out);
    }
    crowd.finish(&mut out);
    out.retain(|mark| mark.place_m.y < 12.0);
    assert_eq!(out, alone);
}

#[test]
fn readable_prints_are_as_rare_as_on_a_real_floor() {
    // 1000 people, the last 300 fresh, through an entrance of 5 m and down a corridor.
    let case = Case { people: People::new(9, BodyOptions::default()), ..Case::new(walls_of(90, 14, 0.5, |_, _| true)) };
    let mut stage = case.stage(Origin::of_arrivals([true; 1000].into_iter(), 300));
    let mut out = Vec::new();
    let lane = |id: u32| 1.0 + 5.0 * (f64::from(id) * 0.618_033_988_75).fract();
    for n in 0..230 {
        let time_s = f64::from(n) * 0.2;
        let walker =
            |id| Walker { id, position_m: vec2(1.1 * time_s - 2.5, lane(id)), velocity_m_s: Vec2::ZERO, heading: None };
        stage.push(&Frame { time_s, walkers: (0..1000).map(walker).collect() }, &mut out);
    }
    stage.finish(&mut out);
    let readable = |from: f64, to: f64| {
        out.iter().filter(|mark| mark.soil >= 0.04 && (from..to).contains(&mark.place_m.x)).count() as f64
    };
    let (entrance, inside) = (readable(0.0, 5.0) / 25.0, readable(5.0, 25.0) / 100.0);
    let share = readable(0.0, 45.0) / out.iter().filter(|mark| (0.0..45.0).contains(&mark.place_m.x)).count() as f64;
    assert!((1.0..=3.0).contains(&entrance), "{entrance} per m2 at the entrance");
    assert!((0.1..=0.5).contains(&inside), "{inside} per m2 inside");
    assert!(share < 0.01, "{share} of the footfalls");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn marks_are_finite_and_headings_unit(
        steps in prop::collection::vec((0.0f64..3.0, -3.0f64..3.0, -3.0f64..3.0, 0u32..4), 1..200),
        scale in prop::sample::select(vec![1e-3, 0.1, 1.0, 30.0]),
    ) {
        let mut case = Case::new(hall());
        case.options.heel = HeelOptions { per_metre: 0.5, people: 4.0, ..HeelOptions::default() };
        let mut stage = case.stage(vec![Origin { fresh: true, from_outside: true }; 4]);
        let mut out = Vec::new();
        let (mut time_s, mut places) = (0.0, [vec2(50.0, 50.0); 4]);
        for (dt, dx, dy, absent) in steps {
            time_s += dt;
            let walkers = (0..4).filter(|&id| id != absent).map(|id| {
                places[id as usize] += vec2(dx, dy) * scale;
                Walker { id, position_m: places[id as usize], velocity_m_s: Vec2::ZERO, heading: None }
            });
            let walkers = walkers.collect();
            stage.push(&Frame { time_s, walkers }, &mut out);
        }
        stage.finish(&mut out);
        for mark in &out {
            prop_assert!(mark.place_m.is_finite());
            prop_assert!((mark.heading.length() - 1.0).abs() < 1e-9);
            prop_assert!((0.0..=0.03).contains(&mark.smear_m));
            prop_assert!(mark.strength.is_finite() && mark.strength > 0.0);
            prop_assert!(mark.soil.is_finite() && mark.soil >= 0.0);
            prop_assert!(mark.length_m > 0.0 && mark.length_m < 0.5);
            prop_assert!(usize::from(mark.pattern) < case.library.patterns.len());
            prop_assert_eq!(case.library.patterns[usize::from(mark.pattern)].cause, mark.cause);
        }
    }
}

#[test]
fn frames_that_make_no_sense_are_passed_over() {
    let case = Case::new(hall());
    let mut stage = case.stage(Vec::new());
    let mut out = Vec::new();
    for (time_s, x) in
        [(0.0, 1.0), (f64::NAN, 2.0), (0.1, f64::NAN), (1e300, 3.0), (-1.0, 2.0), (0.1, 1.1), (900.0, 5.0)]
    {
        let walkers = vec![Walker { id: 0, position_m: vec2(x, 1.0), velocity_m_s: Vec2::ZERO, heading: None }];
        stage.push(&Frame { time_s, walkers }, &mut out);
    }
    stage.finish(&mut out);
    assert!(out.len() < 5 && out.iter().all(|mark| mark.place_m.is_finite()), "{out:?}");
}

#[test]
fn soil_options_reach_the_prints() {
    let mut case = Case::new(hall());
    let mean = |case: &Case| {
        let marks = case.marks(100, 10.0, 0.1, |id, t| vec2(5.0 + 1.3 * t, 5.0 + 0.2 * f64::from(id)));
        marks.iter().map(|mark| f64::from(mark.soil)).sum::<f64>() / marks.len() as f64
    };
    let plain = mean(&case);
    case.options.soil = SoilOptions { median_density: 0.02, ..SoilOptions::default() };
    assert!((mean(&case) / plain - 2.0).abs() < 0.05);
    case.options.soil = SoilOptions { mat_length_m: 6.0, ..SoilOptions::default() };
    assert!(mean(&case) < 0.7 * plain);
}
