//! The RiMEA guideline's verification tests that a flat plan can run (RiMEA 3.0, 2016).

use trodden::crowd::CrowdOptions;
use trodden::math::{Distribution, Vec2};
use trodden::plan::PlanPoint;
use trodden::routes::{PlaceRequest, RouteRequest};

use super::measures::mean_speed_m_s;
use super::scene::{Scene, area, commuters, endless, opening, route};

/// Everybody at once, all with the same free speed.
fn at_once(people: u32) -> CrowdOptions {
    CrowdOptions { entry_seconds: Some(0.0), ..commuters(people) }
}

#[test]
fn test_1_one_person_keeps_the_speed_in_a_corridor() {
    let scene = Scene::corridor(44.0, 2.0, vec![route(area([0.5, 1.5], [0.6, 1.8]), opening("east"))]);
    let options = CrowdOptions { speed: Distribution::Constant(1.33), ..at_once(1) };
    let (mut from, mut seconds) = (None, 0.0);
    scene.walk(&options, 1, |frame| {
        let Some(walker) = frame.walkers.first() else { return };
        let x = walker.position_m.x;
        let (start_s, start_x) = *from.get_or_insert((frame.time_s, x));
        if x - start_x <= 40.0 {
            seconds = frame.time_s - start_s;
        }
    });
    println!("RiMEA 1: 40 m in {seconds:.1} s (26 to 34)");
    assert!((26.0..=34.0).contains(&seconds), "{seconds} s");
}

#[test]
fn test_4_the_fundamental_diagram_has_its_shape() {
    let scene = Scene::corridor(26.0, 2.0, vec![route(area([0.0, 26.0], [0.0, 2.4]), opening("east"))]);
    let densities = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0];
    let speeds = densities.map(|rho| mean_speed_m_s(&scene, &endless((rho * 52.0) as u32, 26.0, 70.0), 1));
    let flows: Vec<f64> = speeds.iter().zip(densities).map(|(v, rho)| v * rho).collect();
    println!("RiMEA 4: speeds {speeds:.2?} m/s, flows {flows:.2?} persons/(m s) at {densities:?} persons/m2");
    assert!(speeds.is_sorted_by(|a, b| a > b), "speed falls with density: {speeds:?}");
    let most = flows.iter().copied().fold(0.0, f64::max);
    let at = flows.iter().position(|&f| f == most).unwrap();
    assert!((1..=3).contains(&at) && (0.9..=1.6).contains(&most), "flow has its peak between 1 and 3: {flows:?}");
    assert!(flows[5] < 0.6 * most, "and falls behind it: {flows:?}");
}

#[test]
fn test_6_nobody_crosses_the_walls_of_a_corner() {
    // 2 m wide, 12 m before the left turn, 12 m behind it.
    let floor = |p: Vec2| (p.x > 10.0 || p.y < 2.2) && p.x < 12.0 && p.y > 0.2;
    let scene = Scene::new([12.2, 12.2], floor, vec![route(area([0.2, 6.0], [0.3, 2.1]), opening("north"))]);
    let mut in_wall = 0;
    let tally = scene.walk(&at_once(20), 1, |frame| {
        in_wall += frame.walkers.iter().filter(|w| scene.is_in_wall(w.position_m)).count();
    });
    assert_eq!((tally.arrived, in_wall), (20, 0));
}

#[test]
fn test_7_age_groups_walk_at_their_speeds() {
    let scene = Scene::corridor(40.0, 3.0, vec![route(opening("west"), opening("east"))]);
    for (group, [low, high]) in
        [("under 30", [0.58, 1.61]), ("30 to 50", [1.41, 1.54]), ("over 50", [0.68, 1.41]), ("impaired", [0.46, 0.76])]
    {
        // Far enough apart that nobody is in anybody's way.
        let options =
            CrowdOptions { speed: Distribution::Uniform([low, high]), entry_seconds: Some(500.0), ..commuters(50) };
        let mut first = vec![None; 50];
        let mut speeds = [0.0; 50];
        scene.walk(&options, 1, |frame| {
            for w in &frame.walkers {
                let id = w.id as usize;
                let (start_s, x) = *first[id].get_or_insert((frame.time_s, w.position_m.x));
                if frame.time_s - start_s > 5.0 {
                    speeds[id] = (w.position_m.x - x) / (frame.time_s - start_s);
                }
            }
        });
        let (least, most) = speeds.iter().fold((9.0f64, 0.0f64), |(a, b), &v| (a.min(v), b.max(v)));
        println!("RiMEA 7: {group}: {least:.2} to {most:.2} m/s ({low} to {high})");
        assert!(least > low - 0.03 && most < high + 0.01, "{group}: {least} to {most}");
        assert!(most - least > 0.6 * (high - low), "{group} differ: {least} to {most}");
    }
}

#[test]
fn test_9_four_exits_empty_a_hall_twice_as_fast_as_two() {
    let seconds = |exits: &[(f64, bool)]| {
        // A hall of 30 x 20 m with exits of 1 m to aprons on its long sides.
        let floor = |p: Vec2| {
            let hall = p.x > 0.4 && p.x < 30.4 && p.y > 2.0 && p.y < 22.0;
            let exit = |&(x, north): &(f64, bool)| (p.x - x).abs() < 0.5 && if north { p.y > 12.0 } else { p.y < 12.0 };
            hall || exits.iter().any(exit)
        };
        // Everybody takes the nearest exit: a route from each exit's part of the hall.
        let halves = exits.iter().filter(|e| e.1).count() as f64;
        let routes = exits
            .iter()
            .map(|&(x, north)| {
                let width = 30.0 / halves;
                let left = 0.4 + ((x - 0.4) / width).floor() * width;
                let y = if exits.len() == 2 {
                    [2.2, 21.8]
                } else if north {
                    [12.0, 21.8]
                } else {
                    [2.2, 12.0]
                };
                let names: Vec<&(f64, bool)> = exits.iter().filter(|e| e.1 == north).collect();
                let number = names.iter().position(|e| e.0 == x).unwrap();
                let side = if north { "north" } else { "south" };
                let name = if names.len() == 1 { side.into() } else { format!("{side} {}", number + 1) };
                route(area([left + 0.1, left + width - 0.1], y), opening(&name))
            })
            .collect();
        let scene = Scene::new([30.8, 24.0], floor, routes);
        let mut last_s = 0.0;
        let tally = scene.walk(&at_once(1000), 1, |frame| last_s = frame.time_s);
        assert_eq!(tally.arrived, 1000, "{:?}", tally.stuck);
        last_s
    };
    let four = seconds(&[(7.9, true), (22.9, true), (7.9, false), (22.9, false)]);
    let two = seconds(&[(7.9, true), (22.9, true)]);
    println!("RiMEA 9: {two:.0} s with two exits, {four:.0} s with four: ratio {:.2} (1.6 to 2.4)", two / four);
    assert!((1.6..=2.4).contains(&(two / four)), "{two} s and {four} s");
}

#[test]
fn test_10_everybody_takes_the_assigned_exit() {
    // Six rooms on either side of a corridor of 2 m, doors of 0.9 m; the left four leave in the east, the others west.
    let room = |x: f64| (x - 0.4).rem_euclid(4.0);
    let floor = |p: Vec2| {
        let corridor = p.y > 5.2 && p.y < 7.2;
        let inside = room(p.x) < 3.8 && p.x > 0.4 && p.x < 24.2;
        let rooms = inside && (p.y > 0.2 && p.y < 5.0 || p.y > 7.4 && p.y < 12.2);
        let doors = p.x > 0.4 && p.x < 24.2 && (room(p.x) - 1.9).abs() < 0.45 && p.y > 4.0 && p.y < 8.4;
        corridor || rooms || doors
    };
    let rooms: Vec<(f64, bool)> = (0..6).flat_map(|k| [(k as f64, false), (k as f64, true)]).collect();
    let routes: Vec<RouteRequest> = rooms
        .iter()
        .map(|&(k, upper)| {
            let x = 0.4 + 4.0 * k;
            let y = if upper { [7.8, 12.0] } else { [0.4, 4.6] };
            route(area([x + 0.4, x + 3.4], y), opening(if k < 3.0 { "east" } else { "west" }))
        })
        .collect();
    let scene = Scene::new([24.6, 12.4], floor, routes);
    let people = 96;
    let mut last = vec![(0.0, 0.0); people as usize];
    let mut first = vec![None; people as usize];
    let tally = scene.walk(&at_once(people), 1, |frame| {
        for w in &frame.walkers {
            first[w.id as usize].get_or_insert(w.position_m);
            last[w.id as usize] = (w.position_m.x, w.position_m.y);
        }
    });
    assert_eq!(tally.arrived, u64::from(people), "{:?}", tally.stuck);
    for (first, last) in first.into_iter().zip(last) {
        let from_left = first.unwrap().x < 12.4;
        assert_eq!(last.0 > 12.3, from_left, "from {first:?} to {last:?}");
    }
}

#[test]
fn test_12_no_jam_forms_at_the_second_of_two_equal_bottlenecks() {
    // Room, bottleneck of 1 m, room, bottleneck of 1 m, room.
    let floor = |p: Vec2| {
        let wall = |x: f64| p.x > x && p.x < x + 5.0 && (p.y - 5.2).abs() > 0.5;
        p.y > 0.2 && p.y < 10.2 && p.x > 0.2 && p.x < 39.8 && !wall(10.0) && !wall(25.0)
    };
    let scene = Scene::new(
        [40.0, 10.4],
        floor,
        vec![RouteRequest {
            name: None,
            from: area([0.5, 9.5], [0.5, 9.9]),
            to: PlaceRequest::Point(PlanPoint::Metres([38.0, 5.2])),
            via: Vec::new(),
            arrivals: None,
            share: 1.0,
        }],
    );
    let (mut before_first, mut before_second) = (0usize, 0usize);
    let tally = scene.walk(&at_once(150), 1, |frame| {
        let waiting = |x: f64| {
            let near = |w: &&trodden::motion::Walker| w.position_m.x > x - 3.0 && w.position_m.x < x;
            frame.walkers.iter().filter(near).filter(|w| w.velocity_m_s.length() < 0.4).count()
        };
        before_first = before_first.max(waiting(10.0));
        before_second = before_second.max(waiting(25.0));
    });
    println!("RiMEA 12: at most {before_first} wait before the first bottleneck, {before_second} before the second");
    assert_eq!(tally.arrived, 150, "{:?}", tally.stuck);
    // Next to nobody: a tenth of the jam at the first.
    assert!(before_first > 15 && 10 * before_second <= before_first, "{before_first} {before_second}");
}
