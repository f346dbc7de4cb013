//! Doors and fixtures that a scenario gives, and what cannot be used of them.

use trodden::marks::{
    Contact, ContactOptions, ContactPlaces, DoorRequest, FixtureAt, FixtureKind, FixtureRequest, Footfalls,
    MarksOptions,
};
use trodden::math::{Distribution, vec2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::{DoorAt, FloorPlan, PlanPoint};
use trodden::routes::{Facing, Stop, StopKind};
use trodden::walls::{Walls, WallsOptions};

use super::scene::{NORTH_M, SOUTH_M, metres, rates_times, scene, spread};

const MIDDLE_M: f64 = 0.5 * (SOUTH_M + NORTH_M);

fn door(x: f64, y: f64) -> DoorRequest {
    DoorRequest {
        name: Some("front".into()),
        at: DoorAt::Point(metres(x, y)),
        width: 1.0,
        height: 2.0,
        hinge: None,
        handle: 1.0,
    }
}

fn fixture(kind: FixtureKind, at: FixtureAt) -> FixtureRequest {
    FixtureRequest { name: None, kind, at, facing: None, width: None }
}

fn places() -> ContactPlaces {
    ContactPlaces::of_walls(&scene().walls)
}

#[test]
fn a_door_of_the_scenario_says_more_of_one_that_was_found() {
    let scene = scene();
    let known = places().doors().len();
    let request = DoorRequest { hinge: Some(metres(8.0, MIDDLE_M + 0.5)), ..door(8.0, MIDDLE_M + 0.1) };
    let with = places().with_doors(&scene.plan, &scene.walls, &[request]).unwrap();
    assert_eq!(with.doors().len(), known);
    let named = with.doors().iter().find(|door| door.name.is_some()).unwrap();
    assert_eq!((named.doorway.head_m, named.handle_m), (2.0, Some(1.0)));
    let latch = named.doorway.jambs_m[named.latch.unwrap()];
    assert!(latch.distance(vec2(8.0, MIDDLE_M - 0.5)) < 0.05, "{latch:?}");
    // Touches of the handle gather at its height on that jamb.
    let contacts = scene.contacts_of(&scene.frames, rates_times(40.0), Some(with));
    let share_low = |y: f64| {
        let at_jamb =
            |contact: &&Contact| contact.cause == Cause::Hand && scene.place(contact).distance(vec2(8.0, y)) < 0.25;
        let heights: Vec<f64> = contacts.iter().filter(at_jamb).map(|contact| contact.height_m).collect();
        heights.iter().filter(|height| **height < 1.1).count() as f64 / heights.len() as f64
    };
    let (latch, hinge) = (share_low(MIDDLE_M - 0.5), share_low(MIDDLE_M + 0.5));
    assert!(latch > 0.35 && hinge < 0.2, "{latch} of the hands are low at the latch, {hinge} at the hinge");
}

#[test]
fn a_door_may_stand_where_none_was_found() {
    let scene = scene();
    let request = DoorRequest { width: 2.4, ..door(12.0, MIDDLE_M) };
    let with = places().with_doors(&scene.plan, &scene.walls, &[request]).unwrap();
    assert_eq!(with.doors().len(), places().doors().len() + 1);
    assert!((with.doors().last().unwrap().doorway.width_m() - 2.4).abs() < 0.02);
}

#[test]
fn a_door_without_jambs_is_an_error_with_a_hint() {
    let scene = scene();
    let message = |request: DoorRequest| {
        let error = places().with_doors(&scene.plan, &scene.walls, &[request]).unwrap_err();
        (error.to_string(), error.hint().unwrap_or_default())
    };
    let (shown, hint) = message(door(12.0, MIDDLE_M));
    assert_eq!(shown, "door \"front\": at: no two jambs stand within 1 m of [12.00, 5.20]");
    assert!(hint.contains("inspect"), "{hint}");
    let (shown, _) = message(door(500.0, 5.0));
    assert_eq!(shown, "door \"front\": at: [500.00, 5.00] is not on the floor");
    let (shown, _) = message(DoorRequest { name: None, ..door(f64::NAN, 5.0) });
    assert_eq!(shown, "door 1: at: `at` is NaN, allowed is -10000000 to 10000000");
    let (shown, _) = message(DoorRequest { width: f64::INFINITY, ..door(8.0, MIDDLE_M) });
    assert_eq!(shown, "door \"front\": width: `width` is inf, allowed is 0.5 to 6");
}

#[test]
fn a_fixture_is_touched_where_it_is_and_as_high() {
    let scene = scene();
    let at = |kind, x| FixtureRequest {
        facing: Some(metres(x, MIDDLE_M)),
        ..fixture(kind, FixtureAt::Point(metres(x, NORTH_M + 0.05)))
    };
    // The wall is thin: only the side that it faces counts.
    let requests = [at(FixtureKind::Switch, 11.5), at(FixtureKind::Handle, 13.5)];
    let with = places().with_fixtures(&scene.plan, &scene.walls, &requests).unwrap();
    assert!(with.fixtures().iter().all(|fixture| (fixture.point_m.y - NORTH_M).abs() < 0.01), "{:?}", with.fixtures());
    let options = ContactOptions { fixture_per_passage: 1.0, ..ContactOptions::none() };
    let contacts = scene.contacts_of(&scene.frames, options, Some(with));
    for (x, [low, high], most_off) in [(11.5, [1.05, 1.2], 0.3), (13.5, [0.95, 1.05], 0.4)] {
        let here: Vec<&Contact> = contacts.iter().filter(|c| (scene.place(c).x - x).abs() < most_off).collect();
        let [height, height_sd] = spread(&here.iter().map(|contact| contact.height_m).collect::<Vec<_>>());
        println!("{} touches at {x}: {height:.3} +- {height_sd:.3} m", here.len());
        assert!(here.len() > 20, "{}", here.len());
        assert!((low..high).contains(&height) && (0.07..0.13).contains(&height_sd), "{height} +- {height_sd}");
        assert!(here.iter().all(|contact| contact.cause == Cause::Hand));
    }
    let elsewhere =
        contacts.iter().filter(|c| (scene.place(c).x - 11.5).abs() > 0.5 && (scene.place(c).x - 13.5).abs() > 0.6);
    assert_eq!(elsewhere.count(), 0);
}

#[test]
fn a_fixture_without_a_wall_is_an_error_with_a_hint() {
    let scene = scene();
    let wrong = |request: FixtureRequest| places().with_fixtures(&scene.plan, &scene.walls, &[request]).unwrap_err();
    let far = wrong(fixture(FixtureKind::Bin, FixtureAt::Point(metres(-40.0, 5.0))));
    assert_eq!(far.to_string(), "fixture 1: at: no wall stands within 1.5 m of [-40.00, 5.00]");
    assert!(far.hint().unwrap().contains("wall"));
    let nan = wrong(fixture(FixtureKind::Bin, FixtureAt::Line([metres(1.0, 2.0), metres(f64::NAN, 2.0)])));
    assert_eq!(nan.to_string(), "fixture 1: at: `at` is NaN, allowed is -10000000 to 10000000");
    let pixels = fixture(FixtureKind::Bin, FixtureAt::Point(PlanPoint::Pixels { px: [f64::INFINITY, 0.0] }));
    assert!(wrong(pixels).to_string().contains("allowed is -10000000"));
    let wide = FixtureRequest { width: Some(-1.0), ..fixture(FixtureKind::Bin, FixtureAt::Point(metres(1.0, 4.0))) };
    assert_eq!(wrong(wide).to_string(), "fixture 1: width: `width` is -1, allowed is 0.02 to 20");
}

#[test]
fn stops_of_a_scenario_are_fixtures() {
    let scene = scene();
    let stop = |name: &str, kind, y, facing: [f64; 2]| Stop {
        name: name.into(),
        kind,
        at_m: [vec2(12.0, y); 2],
        places_m: vec![vec2(12.0, y), vec2(12.9, y)],
        facing: Facing::Direction(facing.into()),
        dwell_s: Distribution::Constant(10.0),
        spacing_m: 0.9,
        reach_m: 1.5,
        queue_m: Vec::new(),
        spots: Vec::new(),
    };
    let office = stop("office", StopKind::Queue, NORTH_M - 0.5, [0.0, 1.0]);
    let bench = stop("bench", StopKind::Bench, SOUTH_M + 0.3, [0.0, 1.0]);
    // In the middle of the corridor, facing along it, there is nothing to touch.
    let board = stop("board", StopKind::Machine, MIDDLE_M, [1.0, 0.0]);
    let with = places().with_stops(&scene.walls, [&office, &bench, &office, &board]);
    let found: Vec<(FixtureKind, f64)> = with.fixtures().iter().map(|f| (f.kind, f.point_m.y)).collect();
    let (counter, seat) = ((FixtureKind::Counter, NORTH_M), (FixtureKind::Bench, SOUTH_M));
    assert_eq!(found.iter().map(|f| f.0).collect::<Vec<_>>(), [counter.0, counter.0, seat.0, seat.0]);
    assert!(found.iter().all(|f| (f.1 - if f.0 == counter.0 { counter.1 } else { seat.1 }).abs() < 0.01), "{found:?}");
}

#[test]
fn rates_out_of_range_are_named() {
    let mut marks = MarksOptions::default();
    marks.contact.jamb_hand_per_passage = f64::NAN;
    let scene = scene();
    let error = Footfalls::new(&scene.people, &scene.walls, &scene.library, &marks, Vec::new()).err().unwrap();
    assert_eq!(error.to_string(), "marks.contact.jamb_hand_per_passage is NaN, allowed is 0 to 10");
}

#[test]
fn a_hundred_thousand_tiny_walls_are_walked_through() {
    let side = 951usize;
    let mask = (0..side * side).map(|at| u8::from(!(at / side % 3 == 1 && at % side % 3 == 1))).collect();
    let plan = FloorPlan::from_mask(side as u32, side as u32, 0.2, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    assert!(walls.faces.len() > 99_000);
    let (people, library) = (People::new(1, BodyOptions::default()), PatternLibrary::built_in());
    let marks = MarksOptions { contact: rates_times(40.0), ..MarksOptions::default() };
    let start = std::time::Instant::now();
    let mut footfalls = Footfalls::new(&people, &walls, &library, &marks, Vec::new()).unwrap();
    let (mut feet, mut contacts) = (Vec::new(), Vec::new());
    for n in 0..300 {
        let time_s = 0.1 * f64::from(n);
        let at = |id: u32| vec2(10.0 + 1.3 * time_s, 10.0 + 1.7 * f64::from(id));
        let walker = |id| Walker { id, position_m: at(id), velocity_m_s: vec2(1.3, 0.0), heading: None };
        footfalls.push(&Frame { time_s, walkers: (0..100).map(walker).collect() }, &mut feet);
    }
    footfalls.finish(&mut feet);
    footfalls.take_contacts(&mut contacts);
    assert!(contacts.len() > 1000, "{}", contacts.len());
    assert!(start.elapsed().as_secs() < 300, "{:?}", start.elapsed());
}
