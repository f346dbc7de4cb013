//! Heel marks of stops, starts, turns and standing: as many whatever the source's frame rate.

use trodden::marks::{HeelOptions, MarksOptions};
use trodden::math::{sin_cos, vec2};

use super::direction;
use super::measure::{Floor, Path};

/// Every cause of heel marks, so often that their number says something.
fn scuffing() -> Floor {
    let heel = HeelOptions {
        per_metre: 0.05,
        per_radian: 0.2,
        per_stop: 0.5,
        per_second_stood: 0.02,
        per_passage: 0.0,
        people: 1000.0,
        ..HeelOptions::default()
    };
    Floor { options: MarksOptions { heel, ..MarksOptions::default() }, ..Floor::hall() }
}

/// Walks in bends, stops for a while, turns, walks back.
fn errand(id: u32, hertz: f64) -> Path {
    let begin = f64::from(id % 17) * 0.3;
    let way = move |t: f64| 1.3 * (t.min(10.0) - (t - 24.0 - begin).clamp(0.0, 8.0));
    let facing = move |t: f64| direction((1.8 * (t - 20.0 - begin)).clamp(0.0, std::f64::consts::PI));
    Path::of(id, 40.0, hertz, move |t| vec2(50.0 + way(t), 50.0 + 0.8 * sin_cos(0.5 * way(t)).0)).facing(facing)
}

#[test]
fn the_number_of_scuffs_and_prints_does_not_depend_on_the_frame_rate() {
    let floor = scuffing();
    let count = |hertz: f64| {
        let paths = (0..400).map(|id| errand(id, hertz));
        paths.fold((0, 0), |(heels, feet), path| {
            let all = floor.marks(&path).len();
            let of_heels = floor.heels(&path);
            (heels + of_heels, feet + all - of_heels)
        })
    };
    let (heels, feet) = count(20.0);
    println!("20 Hz: {heels} heel marks, {feet} footfalls");
    for hertz in [5.0, 10.0, 16.0, 40.0, 60.0] {
        let (more_heels, more_feet) = count(hertz);
        let off = |a: usize, b: usize| (a as f64 / b as f64 - 1.0).abs();
        println!("{hertz} Hz: {more_heels} heel marks, {more_feet} footfalls");
        assert!(off(more_heels, heels) < 0.03, "{more_heels} heel marks at {hertz} Hz, {heels} at 20");
        assert!(off(more_feet, feet) < 0.03, "{more_feet} footfalls at {hertz} Hz, {feet} at 20");
    }
}

#[test]
fn dropping_every_other_frame_changes_nothing() {
    let floor = scuffing();
    let (mut whole, mut half) = (0, 0);
    for id in 0..300 {
        let path = errand(id, 25.0);
        whole += floor.marks(&path).len();
        half += floor.marks(&path.thinned(2)).len();
    }
    println!("{whole} marks, {half} of half the frames");
    assert!((half as f64 / whole as f64 - 1.0).abs() < 0.03, "{whole} marks, {half} of half the frames");
}

#[test]
fn every_cause_leaves_its_share() {
    let only = |change: fn(&mut HeelOptions)| {
        let mut floor = scuffing();
        floor.options.heel = HeelOptions { people: 1000.0, ..HeelOptions::none() };
        change(&mut floor.options.heel);
        (0..400).map(|id| floor.heels(&errand(id, 10.0)) as f64).sum::<f64>() / 400.0
    };
    // 23.5 m with the bends; a half turn on the spot, less the slack of a wiggle; two stops and a start; 14 s and 8 s, less what the
    // path's smoothing takes.
    let rows = [
        ("way", only(|heel| heel.per_metre = 0.05), 0.05 * 23.5),
        ("turns", only(|heel| heel.per_radian = 1.0), 0.15 * 2.84),
        ("stops", only(|heel| heel.per_stop = 0.5), 0.5 * 3.0),
        ("standing", only(|heel| heel.per_second_stood = 0.1), 0.1 * 20.0),
    ];
    for (cause, found, expected) in rows {
        println!("{cause}: {found:.2} a person, about {expected:.2} expected");
        assert!((found / expected - 1.0).abs() < 0.2, "{cause}: {found} instead of about {expected}");
    }
}
