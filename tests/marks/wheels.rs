//! Lines of wheels, measured on the marks and on the sums that they leave: how far apart, where they run in turns, how
//! dense, and that no frame rate changes them.

use trodden::marks::{Footfalls, Mark, MarksOptions};
use trodden::math::{Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{StampOptions, Stamper, TexelGrid};
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::{Walls, WallsOptions};

const SIDE_M: f64 = 40.0;
const CORNER: Vec2 = vec2(20.0, 20.0);
/// Radius of a person's way round the corner, metres.
const ROUND_M: f64 = 0.5;
const SPEED_M_S: f64 = 1.3;

/// A hall whose people all have bags, these shares of them on wheels.
struct Hall {
    walls: Walls,
    people: People,
    library: PatternLibrary,
}

impl Hall {
    fn new(pull: f64, push: f64) -> Hall {
        let plan = FloorPlan::from_mask(400, 400, 0.1, vec![1; 160_000]);
        let bodies = BodyOptions { bags: 1.0, children: 0.0, pull, push, ..BodyOptions::default() };
        let walls = Walls::trace(&plan, &WallsOptions::default());
        Hall { walls, people: People::new(3, bodies), library: PatternLibrary::built_in() }
    }

    /// The marks of wheels of a person on a way, seen `hertz` times a second.
    fn rolled(&self, id: u32, hertz: f64, seconds: f64, place: impl Fn(f64) -> Vec2) -> Vec<Mark> {
        let mut footfalls =
            Footfalls::new(&self.people, &self.walls, &self.library, &MarksOptions::default(), Vec::new()).unwrap();
        let (mut steps, mut marks) = (Vec::new(), Vec::new());
        for n in 0..=(seconds * hertz) as u32 {
            let time_s = f64::from(n) / hertz;
            let walker = Walker { id, position_m: place(time_s), velocity_m_s: Vec2::ZERO, heading: None };
            footfalls.push(&Frame { time_s, walkers: vec![walker] }, &mut steps);
        }
        footfalls.finish(&mut steps);
        footfalls.take_lasting(&mut marks);
        marks.retain(|mark| mark.wheel_m > 0.0);
        marks
    }

    fn sums(&self, marks: &[Mark]) -> FloorSums {
        let grid = TexelGrid::covering(SIDE_M, SIDE_M, 100.0).unwrap();
        let stamper = Stamper::new(&self.library, grid, &StampOptions::default()).unwrap();
        let mut sums = FloorSums::new(grid);
        sums.add(&stamper, &self.walls, marks);
        sums
    }
}

/// Straight on, from left to right.
fn straight(time_s: f64) -> Vec2 {
    vec2(8.0 + SPEED_M_S * time_s, 20.0)
}

/// To the corner from the left, round it to the left, and on upward.
fn corner(time_s: f64) -> Vec2 {
    let (s, straight_m) = (SPEED_M_S * time_s, 12.0 - ROUND_M);
    let turned = (s - straight_m) / ROUND_M;
    let quarter = std::f64::consts::FRAC_PI_2;
    match turned {
        t if t < 0.0 => vec2(8.0 + s, CORNER.y),
        t if t < quarter => CORNER + vec2(-ROUND_M + ROUND_M * libm::sin(t), ROUND_M - ROUND_M * libm::cos(t)),
        t => CORNER + vec2(0.0, ROUND_M + (t - quarter) * ROUND_M),
    }
}

/// Sum of a square around a place: wheels times square metres.
fn laid(sums: &FloorSums, middle: Vec2, half_m: f64) -> f64 {
    let side = (2.0 * half_m * 100.0) as usize;
    let [i, j] = [middle.x, middle.y].map(|m| ((m - half_m) * 100.0).round() as u32);
    let mut texels = vec![0; side * side];
    sums.read(Quantity::Wheels, i, j, side, side, &mut texels);
    texels.iter().map(|&sum| f64::from(sum)).sum::<f64>() / f64::from(Quantity::Wheels.one()) * 1e-4
}

/// Length and area of lines in a square, metres and square metres.
fn lines(marks: &[Mark], middle: Vec2, half_m: f64) -> [f64; 2] {
    let within = |p: Vec2| (p.x - middle.x).abs().max((p.y - middle.y).abs()) < half_m;
    marks.iter().filter(|mark| mark.cause == Cause::Sole).fold([0.0; 2], |[length, area], mark| {
        let at =
            |k: u32| mark.place_m + mark.heading * (f64::from(mark.length_m) * ((f64::from(k) + 0.5) / 20.0 - 0.5));
        let part = f64::from(mark.length_m) * (0..20).filter(|&k| within(at(k))).count() as f64 / 20.0;
        [length + part, area + part * f64::from(mark.wheel_m)]
    })
}

#[test]
fn two_lines_run_as_far_apart_as_wheels_of_cases_and_of_trolleys() {
    for (pull, push, gauge) in [(1.0, 0.0, 0.30..0.401), (0.0, 1.0, 0.40..0.551)] {
        let hall = Hall::new(pull, push);
        for id in 0..30 {
            let sums = hall.sums(&hall.rolled(id, 10.0, 12.0, straight));
            // A column of texels across both lines.
            let mut column = [0; 300];
            sums.read(Quantity::Wheels, 1600, 1850, 1, 300, &mut column);
            let runs: Vec<f64> = column
                .iter()
                .zip(0..)
                .collect::<Vec<(&u32, u32)>>()
                .chunk_by(|(a, _), (b, _)| (**a > 0) == (**b > 0))
                .filter(|run| *run[0].0 > 0)
                .map(|run| {
                    let weight: f64 = run.iter().map(|(sum, _)| f64::from(**sum)).sum();
                    run.iter().map(|(sum, j)| f64::from(**sum) * f64::from(*j)).sum::<f64>() / weight * 0.01
                })
                .collect();
            let [one, other] = runs[..] else { panic!("{} lines of person {id}", runs.len()) };
            assert!(gauge.contains(&(other - one)), "{:.3} m apart, person {id}", other - one);
        }
    }
}

#[test]
fn cases_cut_corners() {
    let hall = Hall::new(1.0, 0.0);
    let inward = vec2(-1.0, 1.0) * 0.5f64.sqrt();
    // Where a way crosses the diagonal through the corner.
    let crosses = |a: Vec2, b: Vec2| {
        let [u, v] = [a, b].map(|p| inward.left().dot(p - CORNER));
        (u * v <= 0.0 && u != v).then(|| inward.dot(a.lerp(b, u / (u - v)) - CORNER))
    };
    let walked = ROUND_M * (2.0f64.sqrt() - 1.0);
    let mut cuts = Vec::new();
    for id in 0..40 {
        let marks = hall.rolled(id, 10.0, 18.0, corner);
        let half = |mark: &Mark| mark.heading * (0.5 * f64::from(mark.length_m));
        let ends =
            marks.iter().filter(|mark| mark.cause == Cause::Sole).map(|m| (m.place_m - half(m), m.place_m + half(m)));
        let wheels: Vec<f64> = ends.filter_map(|(a, b)| crosses(a, b)).collect();
        let [one, other] = wheels[..] else { panic!("{wheels:?} of person {id}") };
        cuts.push(0.5 * (one + other) - walked);
    }
    let mean = cuts.iter().sum::<f64>() / cuts.len() as f64;
    println!(
        "axles run {mean:.2} m inside of bodies, {:.2} at least",
        cuts.iter().copied().fold(f64::INFINITY, f64::min)
    );
    assert!(mean >= 0.1, "{mean:.2} m: {cuts:.2?}");
}

#[test]
fn lines_are_heavier_in_curves_and_black_in_tight_turns() {
    for (pull, push) in [(1.0, 0.0), (0.0, 1.0)] {
        let hall = Hall::new(pull, push);
        // Dirt on treads differs along a way: the mean of many people counts.
        let marks: Vec<Mark> = (0..120).flat_map(|id| hall.rolled(id, 10.0, 18.0, corner)).collect();
        let sums = hall.sums(&marks);
        let [turn, ahead] = [CORNER, vec2(14.0, 20.0)].map(|middle| {
            let [length_m, area] = lines(&marks, middle, 0.8);
            assert!(length_m > 120.0, "{length_m} m");
            [laid(&sums, middle, 0.8) / length_m, area / length_m]
        });
        let ratio = turn[0] / ahead[0];
        println!(
            "per metre of line {ratio:.2} times as much as straight on, {:.2} times the breadth there",
            ahead[0] / ahead[1]
        );
        assert!((1.5..4.0).contains(&ratio), "{ratio:.2}");
    }
    // Somebody who comes and turns back, again and again.
    let hall = Hall::new(1.0, 0.0);
    let back = |time_s: f64| vec2(20.0 + 3.0 * libm::sin(0.4 * time_s), 20.0);
    let rubber = |place: fn(f64) -> Vec2| {
        (0..20)
            .map(|id| hall.rolled(id, 10.0, 30.0, place).iter().filter(|m| m.cause == Cause::Heel).count())
            .sum::<usize>()
    };
    let (turning, ahead) = (rubber(back), rubber(straight));
    println!("{turning} pieces of rubber of 20 people who turn back, {ahead} of 20 who go ahead");
    assert!(turning >= 40 && ahead == 0);
}

#[test]
fn only_who_has_wheels_leaves_lines() {
    let hall = Hall::new(0.0, 0.0);
    let marks: Vec<Mark> = (0..100).flat_map(|id| hall.rolled(id, 5.0, 6.0, straight)).collect();
    assert!(marks.is_empty());
    assert!(hall.sums(&marks).blocks(Quantity::Wheels).is_empty());
    let hall = Hall::new(0.2, 0.1);
    let with = (0..300).filter(|&id| !hall.rolled(id, 5.0, 6.0, straight).is_empty()).count();
    assert!((60..120).contains(&with), "{with} of 300 have wheels");
}

#[test]
fn lines_do_not_depend_on_the_frame_rate() {
    // Bends of 2.5 m to either side.
    let winding = |time_s: f64| {
        let s = SPEED_M_S * time_s;
        vec2(8.0 + s, 20.0 + libm::cos(0.8 * s))
    };
    for (pull, push) in [(1.0, 0.0), (0.0, 1.0)] {
        let hall = Hall::new(pull, push);
        let total = |hertz: f64| {
            let marks: Vec<Mark> = (0..12).flat_map(|id| hall.rolled(id, hertz, 17.6, winding)).collect();
            laid(&hall.sums(&marks), vec2(20.0, 20.0), 19.0)
        };
        let [coarse, usual, fine] = [2.5, 10.0, 30.0].map(total);
        println!("{coarse:.3} {usual:.3} {fine:.3} wheels m2 at 2.5, 10, 30 Hz");
        for other in [coarse, usual] {
            assert!((other / fine - 1.0).abs() < 0.02, "{other:.4}, {fine:.4} at 30 Hz");
        }
    }
}

/// Lines come and go: what a tread leaves at two places a few metres apart has little to do with each other, and is as much in
/// the mean as if it were even.
#[test]
fn treads_leave_more_here_and_less_there() {
    let hall = Hall::new(1.0, 0.0);
    let passes = |id: u32| -> Vec<f64> {
        let marks = hall.rolled(id, 10.0, 24.0, straight);
        let long = marks.iter().filter(|mark| mark.cause == Cause::Sole && mark.length_m > 0.3);
        long.map(|mark| f64::from(mark.strength)).collect()
    };
    let (mut spread, mut all) = (Vec::new(), Vec::new());
    for id in 0..60 {
        let passes = passes(id);
        let mean = passes.iter().sum::<f64>() / passes.len() as f64;
        let square = passes.iter().map(|p| (p / mean - 1.0) * (p / mean - 1.0)).sum::<f64>() / passes.len() as f64;
        spread.push(square.sqrt());
        all.extend(passes);
    }
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    println!("a line varies by {:.2} of its mean, all are {:.2} in the mean", mean(&spread), mean(&all));
    assert!((0.45..1.0).contains(&mean(&spread)), "{:.2}", mean(&spread));
    assert!((0.75..1.3).contains(&mean(&all)), "{:.2}", mean(&all));
}
