//! The sample plans: walls are touched as often as people pass.

use std::path::Path;

use trodden::crowd::Simulation;
use trodden::marks::{ContactOptions, Footfalls, MarksOptions};
use trodden::motion::{Frame, Motion, People};
use trodden::patterns::PatternLibrary;
use trodden::plan;
use trodden::routes::Navigation;
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::Walls;

use super::scene::rates_times;

/// Pieces of wall at least so long count, without so much at either end: there are doors and corners.
const LEAST_M: f64 = 1.5;
const END_M: f64 = 0.35;
/// Who passes so close by the middle of the body is in reach.
const NEAR_M: f64 = 0.95;

/// A piece of wall between two corners.
struct Piece {
    face: usize,
    from_m: f64,
    to_m: f64,
    /// People who passed, and stains, per metre.
    passed: f64,
    stains: f64,
}

fn pieces(walls: &Walls) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (face, outline) in walls.faces.iter().enumerate() {
        let mut from_m = 0.0;
        for pair in outline.points_m.windows(2) {
            let to_m = from_m + pair[0].distance(pair[1]);
            if to_m - from_m > LEAST_M {
                pieces.push(Piece { face, from_m: from_m + END_M, to_m: to_m - END_M, passed: 0.0, stains: 0.0 });
            }
            from_m = to_m;
        }
    }
    pieces
}

fn correlation(pairs: &[[f64; 2]]) -> f64 {
    let count = pairs.len() as f64;
    let mean = |k: usize| pairs.iter().map(|pair| pair[k]).sum::<f64>() / count;
    let (a, b) = (mean(0), mean(1));
    let sum = |f: fn(f64, f64) -> f64| pairs.iter().map(|pair| f(pair[0] - a, pair[1] - b)).sum::<f64>();
    sum(|x, y| x * y) / (sum(|x, _| x * x) * sum(|_, y| y * y)).sqrt()
}

/// Correlation of stains with people over the walls of a sample plan.
fn of_plan(name: &str, people: u32) -> f64 {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name);
    let overrides = Overrides { people: Some(people), ..Overrides::default() };
    let scenario = Scenario::open(&file, &overrides).unwrap_or_else(|error| panic!("{error}"));
    let plan = plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options()).unwrap();
    let walls = Walls::trace(&plan, &scenario.walls);
    let (routes, ways) = Navigation::find(&plan, &walls, &scenario.routes).unwrap();
    let people = People::new(scenario.seed, scenario.bodies.clone());
    let mut crowd = Simulation::with_navigation(&plan, &walls, &routes, ways, &people, &scenario.crowd).unwrap();
    let library = PatternLibrary::built_in();
    // Of those who pass by: whoever stands at a painting leans on its wall, and whoever squeezes through a gap brushes both
    // of its sides.
    let contact =
        ContactOptions { lean_per_second: 0.0, shoulder_per_metre: 0.0, arm_per_metre: 0.0, ..rates_times(130.0) };
    let marks = MarksOptions { contact, ..MarksOptions::default() };
    let mut footfalls = Footfalls::new(&people, &walls, &library, &marks, Vec::new()).unwrap();
    let mut pieces = pieces(&walls);
    let (mut feet, mut contacts, mut frame) = (Vec::new(), Vec::new(), Frame::default());
    while crowd.next_frame(&mut frame).unwrap() {
        footfalls.push(&frame, &mut feet);
        feet.clear();
        for walker in &frame.walkers {
            let near = walls.nearest(walker.position_m, NEAR_M).and_then(|near| Some((near.face?, near.along_m)));
            let Some((face, along_m)) = near else { continue };
            let way_m = walker.velocity_m_s.length() * scenario.crowd.time_step;
            for piece in pieces.iter_mut().filter(|p| p.face == face && (p.from_m..p.to_m).contains(&along_m)) {
                piece.passed += way_m / (piece.to_m - piece.from_m);
            }
        }
    }
    footfalls.finish(&mut feet);
    footfalls.take_contacts(&mut contacts);
    for contact in &contacts {
        let on = |p: &&mut Piece| p.face == contact.face as usize && (p.from_m..p.to_m).contains(&contact.along_m);
        for piece in pieces.iter_mut().filter(on) {
            piece.stains += 1.0 / (piece.to_m - piece.from_m);
        }
    }
    let clean = pieces.iter().filter(|piece| piece.passed == 0.0).collect::<Vec<_>>();
    let touched = clean.iter().filter(|piece| piece.stains > 0.0).count();
    let pairs: Vec<[f64; 2]> = pieces.iter().map(|piece| [piece.passed, piece.stains]).collect();
    let found = correlation(&pairs);
    println!(
        "{name}: {found:.3} over {} walls, {} stains; {touched} of {} that nobody passed are touched",
        pairs.len(),
        contacts.len(),
        clean.len()
    );
    // Broad people reach a little farther than `NEAR_M`, and a drag that began on the wall before may end there.
    assert!(touched * 5 <= clean.len(), "{name}: {touched} of {} clean walls are touched", clean.len());
    found
}

#[test]
fn stains_grow_with_the_number_that_passed() {
    for (name, people) in [("museum.toml", 160), ("corridors.toml", 150), ("school.toml", 150)] {
        let found = of_plan(name, people);
        assert!(found >= 0.9, "{name}: {found}");
    }
}
