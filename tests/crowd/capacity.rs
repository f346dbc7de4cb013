//! More people than can pass: said before anybody walks, and while they stand.

use trodden::crowd::{CrowdOptions, Tally};
use trodden::math::vec2;
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::routes::RouteRequest;

use super::scene::{Scene, across, commuters};

/// A crowd that comes at this rate: what was foreseen and seen of it, and the mean time from arrival to leaving, seconds.
fn walk(scene: &Scene, people_per_s: f64, people: u32) -> (Tally, f64) {
    let options = CrowdOptions { entry_seconds: Some(f64::from(people) / people_per_s), ..commuters(people) };
    let everybody = People::new(1, BodyOptions::default());
    let mut crowd = scene.crowd(&everybody, &options);
    crowd.foresee();
    let mut last_seen_s = vec![0.0; people as usize];
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame).unwrap() {
        frame.walkers.iter().for_each(|walker| last_seen_s[walker.id as usize] = frame.time_s);
    }
    let on_the_way_s = crowd.arrivals().iter().map(|arrival| last_seen_s[arrival.id as usize] - arrival.time_s);
    let mean_s = on_the_way_s.sum::<f64>() / f64::from(people);
    (crowd.tally(), mean_s)
}

fn one_way() -> Vec<RouteRequest> {
    vec![across("west")]
}

#[test]
fn a_gap_that_too_many_come_to_is_named_and_delays_them() {
    let scene = Scene::rooms(0.8, one_way());
    let (crowded, crowded_s) = walk(&scene, 3.0, 240);
    let (calm, calm_s) = walk(&scene, 0.5, 240);
    assert_eq!((calm.overloads.as_slice(), calm.arrived), (&[][..], 240));
    let [overload] = &crowded.overloads[..] else { panic!("one place: {:?}", crowded.overloads) };
    let delay_s = crowded_s - calm_s;
    println!("3 people/s: {overload}; delayed by {delay_s:.0} s on average");
    assert!(overload.at_m.distance(vec2(8.0, 3.2)) < 0.5, "{overload}");
    assert!((0.8..1.3).contains(&overload.pass_per_s) && overload.people > 200, "{overload}");
    assert!((60.0..90.0).contains(&overload.within_s), "{overload}");
    // The last wait, those before them less.
    assert!(delay_s > 20.0 && delay_s < overload.wait_s, "{delay_s} s on average: {overload}");
}

#[test]
fn people_who_come_from_both_sides_share_a_gap_and_two_gaps_share_the_people() {
    let foreseen = |scene: &Scene, people_per_s, people| walk(scene, people_per_s, people).0.overloads;
    let both = ["west", "east"].map(across).to_vec();
    assert_eq!(foreseen(&Scene::rooms(0.8, both.clone()), 0.8, 100), []);
    let crowded = foreseen(&Scene::rooms(0.8, both), 1.8, 200);
    assert_eq!(crowded.len(), 1, "{crowded:?}");
    // Two doors side by side pass what is too much for one.
    let two_doors = |p: trodden::math::Vec2| {
        let door = [2.0, 4.4].iter().any(|y| (p.y - y).abs() < 0.5);
        p.y > 0.2 && p.y < 6.2 && ((p.x - 8.0).abs() > 0.1 || door)
    };
    let two_doors = Scene::new([16.0, 6.4], two_doors, one_way());
    assert_eq!(foreseen(&two_doors, 2.0, 200), []);
    let [both] = &foreseen(&two_doors, 5.0, 400)[..] else { panic!("both doors are one place") };
    assert!((2.3..3.0).contains(&both.pass_per_s), "{both}");
    assert_eq!(foreseen(&Scene::rooms(1.0, one_way()), 2.0, 200).len(), 1);
}

#[test]
fn who_stands_where_is_said_once_and_not_of_people_who_get_on() {
    let scene = Scene::rooms(0.8, one_way());
    let jammed = walk(&scene, 8.0, 400).0.standstills;
    let [jam] = &jammed[..] else { panic!("one place: {jammed:?}") };
    println!("{jam}");
    assert!(jam.at_m.x < 8.0 && jam.people > 20 && jam.mean_speed_m_s < 0.3, "{jam}");
    assert_eq!(jam.who[0], ("west to east".to_string(), jam.people));
    assert_eq!(walk(&scene, 0.5, 120).0.standstills, []);
}
