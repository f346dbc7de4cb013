//! People who are led from outside, and onlookers.

use trodden::crowd::CrowdOptions;
use trodden::math::{Vec2, vec2};
use trodden::motion::{Frame, Motion};

use super::scene::{ALONE, Scene, across, crowd, social};

#[test]
fn who_is_led_goes_where_they_are_told_and_then_walks_on() {
    let scene = Scene::corridor(30.0, 6.0, vec![across("west")]);
    let mut crowd = crowd(&scene, &CrowdOptions { entry_seconds: Some(10.0), ..social(12, ALONE) }, 1);
    let mut frame = Frame::default();
    while crowd.time_s() < 12.0 {
        assert!(crowd.next_frame(&mut frame).unwrap());
    }
    let person = crowd.agents().min_by_key(|person| person.id).unwrap();
    assert_eq!(crowd.agent(person.id), Some(person));
    let mut at = person.position_m;
    // Up and down across the corridor for 20 s, with the face to the east.
    for step in 0..200 {
        let velocity = vec2(0.0, if (step / 10) % 2 == 0 { 0.8 } else { -0.8 });
        at += velocity * 0.1;
        assert!(crowd.lead(person.id, at, velocity, Some(vec2(2.0, 0.0))));
        assert!(crowd.next_frame(&mut frame).unwrap());
        let walker = frame.walkers.iter().find(|w| w.id == person.id).unwrap();
        assert!(walker.position_m.distance(at) < 1e-5, "{:?} {at:?}", walker.position_m);
        assert!(
            walker.velocity_m_s.distance(velocity) < 1e-5 && walker.heading.unwrap().distance(vec2(1.0, 0.0)) < 1e-5
        );
        for other in frame.walkers.iter().filter(|w| w.id != person.id) {
            assert!(other.position_m.distance(at) > 0.25, "{other:?} walks into {at:?}");
        }
    }
    assert!(crowd.agent(person.id).unwrap().led && !crowd.agents().any(|p| p.led && p.id != person.id));
    assert!(crowd.release(person.id) && !crowd.release(person.id));
    let mut before = frame.walkers.iter().find(|w| w.id == person.id).copied().unwrap();
    while crowd.next_frame(&mut frame).unwrap() {
        let Some(walker) = frame.walkers.iter().find(|w| w.id == person.id) else { continue };
        assert!(walker.position_m.distance(before.position_m) < 0.35, "no jump");
        assert!(walker.velocity_m_s.distance(before.velocity_m_s) < 1.0, "no start");
        before = *walker;
    }
    assert_eq!(crowd.tally().arrived, 12, "{:?}", crowd.stuck());
}

#[test]
fn an_onlooker_is_walked_round_and_counts_for_nobody() {
    let scene = Scene::corridor(20.0, 4.0, vec![across("west")]);
    let options = CrowdOptions { entry_seconds: Some(60.0), ..social(60, [0.5, 0.5, 0.0, 0.0]) };
    let mut crowd = crowd(&scene, &options, 2);
    let viewer = vec2(10.0, 2.2);
    let id = crowd.stand(viewer, 0.3).unwrap();
    assert!(crowd.agent(id).is_some_and(|onlooker| onlooker.position_m.distance(viewer) < 1e-5));
    let mut frame = Frame::default();
    let (mut nearest_m, mut close): (f64, u32) = (9.0, 0);
    while crowd.next_frame(&mut frame).unwrap() {
        assert!(frame.walkers.iter().all(|w| w.id < 60));
        let distances = frame.walkers.iter().map(|w| w.position_m.distance(viewer));
        for distance_m in distances {
            nearest_m = nearest_m.min(distance_m);
            close += u32::from(distance_m < 1.5);
        }
        assert!(crowd.agent(id).is_some_and(|onlooker| onlooker.position_m.distance(viewer) < 1e-5));
    }
    println!("nearest to an onlooker of 0.3 m: {nearest_m:.2} m");
    // Bodies of 0.28 m at least against 0.3 m.
    assert!(close > 100 && nearest_m > 0.9 * 0.44, "{nearest_m}");
    let tally = crowd.tally();
    assert_eq!((tally.entered, tally.arrived, crowd.present()), (60, 60, 0), "{:?}", tally.stuck);
    assert!(!crowd.release(id), "onlookers stay");
}

#[test]
fn nobody_is_led_who_is_not_there_nor_to_no_place() {
    let scene = Scene::corridor(20.0, 3.0, vec![across("west")]);
    let mut crowd = crowd(&scene, &social(5, ALONE), 1);
    let mut frame = Frame::default();
    while frame.walkers.is_empty() {
        assert!(crowd.next_frame(&mut frame).unwrap());
    }
    let id = frame.walkers[0].id;
    assert!(!crowd.lead(4000, Vec2::ZERO, Vec2::ZERO, None) && !crowd.release(id) && !crowd.release(4000));
    assert!(!crowd.lead(id, vec2(f64::NAN, 0.0), Vec2::ZERO, None));
    assert!(!crowd.lead(id, Vec2::ZERO, vec2(f64::INFINITY, 0.0), None));
    assert_eq!((crowd.stand(vec2(f64::NAN, 0.0), 0.3), crowd.stand(Vec2::ZERO, f64::NAN)), (None, None));
    assert_eq!((crowd.stand(Vec2::ZERO, 0.0), crowd.agent(4000)), (None, None));
}
