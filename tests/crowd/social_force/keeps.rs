//! What the crowd keeps to whatever the plan: walls, bodies, determinism, who comes when; and what it refuses.

use std::path::Path;

use trodden::crowd::{CrowdModel, CrowdOptions, GroupOptions, Simulation, SocialForceOptions};
use trodden::math::{Distribution, Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People, Walker};
use trodden::plan::PlanPoint;
use trodden::routes::{
    Navigation, RouteRequest, RoutesOptions, SharedStop, StopAt, StopKind, StopRequest, Timetable, TimetableKind,
    ViaRequest,
};
use trodden::scenario::{Overrides, Scenario};

use super::density::mean_speed_m_s;
use super::scene::{ALONE, MIXED, Scene, across, area, crowd, endless, mean, opening, route, social, walk};

#[test]
fn trajectories_are_the_same_for_any_number_of_threads() {
    let scene = Scene::corridor(40.0, 12.0, vec![across("west"), across("east")]);
    let options = CrowdOptions { entry_seconds: Some(20.0), end_seconds: Some(30.0), ..social(600, MIXED) };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut walkers: Vec<Walker> = Vec::new();
            walk(&scene, &options, 5, |frame, _| walkers.extend(&frame.walkers));
            walkers
        })
    };
    let one = run(1);
    assert!(one.len() > 30_000, "{}", one.len());
    assert!([2, 16].into_iter().all(|threads| run(threads) == one));
}

#[test]
fn a_scenario_gets_the_model_that_it_names() {
    let scene = Scene::corridor(20.0, 3.0, vec![across("west")]);
    let people = People::new(3, BodyOptions::default());
    let options = social(40, MIXED);
    let walkers = |options: &CrowdOptions| {
        let navigation = scene.navigation.clone();
        let mut crowd =
            Simulation::with_navigation(&scene.plan, &scene.walls, &scene.routes, navigation, &people, options)
                .unwrap();
        let (mut frame, mut all) = (Frame::default(), Vec::new());
        while crowd.next_frame(&mut frame).unwrap() {
            all.extend(frame.walkers.clone());
        }
        assert_eq!((crowd.tally().arrived, crowd.share_done()), (40, 1.0));
        all
    };
    let mut own = Vec::new();
    walk(&scene, &options, 3, |frame, _| own.extend(frame.walkers.clone()));
    assert!(walkers(&options) == own);
    assert!(walkers(&CrowdOptions { model: CrowdModel::Boids, ..options }) != own);
}

#[test]
fn groups_come_together_on_one_route_in_the_shares_asked_for() {
    let scene = Scene::corridor(20.0, 4.0, vec![across("west"), across("east")]);
    let crowd = crowd(&scene, &social(2000, [4.0, 3.0, 2.0, 1.0]), 1);
    let arrivals = crowd.arrivals();
    assert!(arrivals.len() == 2000 && arrivals.is_sorted_by(|a, b| a.id < b.id && a.time_s <= b.time_s));
    let mut sizes = [0.0; 4];
    for arrival in arrivals {
        let members = crowd.group_of(arrival.id);
        let first = &arrivals[members.start as usize];
        assert!(members.contains(&arrival.id) && crowd.group_of(members.start) == members);
        assert!(first.time_s == arrival.time_s && first.route == arrival.route);
        if members.start == arrival.id {
            sizes[members.len() - 1] += 1.0;
        }
    }
    let groups: f64 = sizes.iter().sum();
    let shares = sizes.map(|count| count / groups);
    assert!(shares.iter().zip([0.4, 0.3, 0.2, 0.1]).all(|(a, b)| (a - b).abs() < 0.04), "{shares:?}");
}

#[test]
fn groups_keep_to_timetables() {
    let mut scene = Scene::corridor(20.0, 4.0, vec![across("west"), across("east")]);
    let bursts = Timetable {
        kind: TimetableKind::Bursts,
        every_s: Some(60.0),
        people: Some(30),
        spread_s: Some(10.0),
        ..Timetable::default()
    };
    let list = Timetable { kind: TimetableKind::List, times: vec![[5.0, 7.0], [100.0, 13.0]], ..Timetable::default() };
    scene.routes[0].arrivals = Some(list);
    let options = CrowdOptions { arrivals: bursts, ..social(140, MIXED) };
    let crowd = crowd(&scene, &options, 2);
    let within = |route: usize, from_s: f64, to_s: f64| {
        let here = |a: &&trodden::crowd::Arrival| a.route == route && (from_s..=to_s).contains(&a.time_s);
        crowd.arrivals().iter().filter(here).count()
    };
    assert_eq!([within(0, 5.0, 5.0), within(0, 100.0, 100.0)], [7, 13]);
    assert_eq!([0.0, 60.0, 120.0, 180.0].map(|start_s| within(1, start_s, start_s + 10.0)), [30; 4]);
    assert!((0..140).any(|id| crowd.group_of(id).len() == 4));
}

#[test]
fn bodies_hardly_overlap_and_nobody_stands_in_a_pillar() {
    let pillars = [(5.0, 2.0, 0.5), (8.0, 5.5, 0.8), (11.0, 3.0, 0.3), (11.5, 6.5, 0.4)];
    let floor = |p: Vec2| p.y > 0.2 && p.y < 7.8 && pillars.iter().all(|&(x, y, r)| p.distance(vec2(x, y)) > r);
    let scene = Scene::new([16.0, 8.0], floor, vec![across("west"), across("east")]);
    let options =
        CrowdOptions { exclusion: Distribution::Constant(0.32), entry_seconds: Some(40.0), ..social(160, MIXED) };
    for seed in 1..=2 {
        let (mut in_wall, mut near, mut deep) = (0, 0, 0);
        let tally = walk(&scene, &options, seed, |frame, _| {
            in_wall += frame.walkers.iter().filter(|w| scene.is_in_wall(w.position_m)).count();
            for (k, a) in frame.walkers.iter().enumerate() {
                for b in &frame.walkers[k + 1..] {
                    let distance_m = a.position_m.distance(b.position_m);
                    near += u32::from(distance_m < 0.6);
                    deep += u32::from(distance_m < 0.9 * 0.32);
                }
            }
        });
        println!("seed {seed}: {deep} of {near} near pairs overlap by a tenth or more");
        assert_eq!((tally.entered, tally.arrived, in_wall), (160, 160, 0), "{:?}", tally.stuck);
        // Who is blocked for long turns sideways and takes less room.
        assert!(f64::from(deep) < 3e-3 * f64::from(near), "{deep} of {near}");
    }
}

#[test]
fn halving_the_time_step_changes_speeds_only_by_chance() {
    let scene = Scene::corridor(26.0, 2.0, vec![route(area([0.0, 26.0], [0.0, 2.4]), opening("east"))]);
    let speed = |time_step: f64| {
        let options = CrowdOptions { time_step, ..endless(78, [0.6, 0.3, 0.1, 0.0], 26.0, 40.0) };
        mean(&[1, 2].map(|seed| mean_speed_m_s(&scene, &options, seed)))
    };
    let (tenth, twentieth, fortieth) = (speed(0.1), speed(0.05), speed(0.025));
    println!("1.5 persons/m2: {tenth:.3} m/s at 0.1 s, {twentieth:.3} at 0.05 s, {fortieth:.3} at 0.025 s");
    // Steps of 0.1 s are two of 0.05 s.
    assert!((tenth - twentieth).abs() < 0.01 && (twentieth - fortieth).abs() < 0.06);
}

#[test]
fn people_stop_at_stops_and_groups_stop_together() {
    let mut scene = Scene::corridor(24.0, 8.0, vec![across("west")]);
    let stop = |name: &str, kind: StopKind, at: [f64; 2], dwell_s: f64| StopRequest {
        name: name.into(),
        kind,
        at: StopAt::Point(PlanPoint::Metres(at)),
        facing: None,
        heading_deg: Some(90.0),
        dwell: Some(Distribution::Constant(dwell_s)),
        places: None,
        spacing: None,
        reach: None,
        queue: Vec::new(),
    };
    let to = |name: &str| ViaRequest::Stop(SharedStop { stop: name.into(), share: 0.5 });
    let options = RoutesOptions {
        routes: vec![RouteRequest { via: vec![to("board"), to("desk")], ..across("west") }],
        stops: vec![stop("board", StopKind::Place, [8.0, 6.0], 10.0), stop("desk", StopKind::Queue, [16.0, 7.8], 3.0)],
        ..RoutesOptions::default()
    };
    (scene.routes, scene.navigation) = Navigation::find(&scene.plan, &scene.walls, &options).unwrap();
    let options = CrowdOptions { entry_seconds: Some(240.0), ..social(60, MIXED) };
    let mut crowd = crowd(&scene, &options, 4);
    crowd.keep_visits();
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame).unwrap() {}
    let tally = crowd.tally();
    assert_eq!(tally.arrived, 60, "{:?}", tally.stuck);
    for stop in 0..2 {
        let stopped = |id: u32| crowd.visits().iter().any(|visit| visit.id == id && visit.stop == stop);
        let count = (0..60).filter(|&id| stopped(id)).count();
        assert!((15..=45).contains(&count), "{count} of 60");
        assert!((0..60).all(|id| stopped(id) == stopped(crowd.group_of(id).start)));
    }
    assert!(crowd.visits().iter().all(|visit| visit.left_s - visit.begun_s > 2.5));
}

#[test]
fn what_is_out_of_range_is_refused() {
    let scene = Scene::corridor(10.0, 3.0, vec![across("west")]);
    let people = People::new(1, BodyOptions::default());
    let good = social(10, ALONE);
    let groups = |groups: GroupOptions| CrowdOptions { groups, ..good.clone() };
    let forces = |social_force: SocialForceOptions| CrowdOptions { social_force, ..good.clone() };
    let bad = [
        groups(GroupOptions { shares: [0.0; 4], ..GroupOptions::default() }),
        groups(GroupOptions { shares: [1.0, -0.5, 0.0, 0.0], ..GroupOptions::default() }),
        groups(GroupOptions { shares: [f64::NAN, 1.0, 0.0, 0.0], ..GroupOptions::default() }),
        groups(GroupOptions { view_deg: 400.0, ..GroupOptions::default() }),
        forces(SocialForceOptions { relaxation: 0.0, ..SocialForceOptions::default() }),
        forces(SocialForceOptions { range: f64::INFINITY, ..SocialForceOptions::default() }),
    ];
    for options in bad {
        let error = Simulation::new(&scene.plan, &scene.walls, &scene.routes, &people, &options).err();
        let told = if options.groups.shares == [0.0; 4] { "above 0" } else { "allowed is" };
        assert!(error.is_some_and(|error| error.to_string().contains(told)), "{options:?}");
    }
    let none = Simulation::new(&scene.plan, &scene.walls, &[], &people, &good).err();
    assert!(none.is_some());
}

#[test]
fn a_scenario_names_the_model_and_its_numbers() {
    let read = |crowd: &str| {
        let text = format!("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n\n{crowd}");
        Scenario::parse(&text, Path::new("plan.toml"), &Overrides::default())
    };
    let scenario = read(
        "[crowd]\nmodel = \"social-force\"\n[crowd.groups]\nshares = [0.5, 0.33, 0.12, 0.05]\n\
         [crowd.social_force]\nstrength = 3.0\n",
    )
    .unwrap();
    assert_eq!(scenario.crowd.model, CrowdModel::SocialForce);
    assert_eq!(scenario.crowd.groups, GroupOptions { shares: [0.5, 0.33, 0.12, 0.05], ..GroupOptions::default() });
    assert_eq!((scenario.crowd.social_force.strength, scenario.crowd.social_force.range), (3.0, 0.35));
    for (crowd, told) in [
        ("[crowd]\nmodel = \"social\"\n", "boids, social-force"),
        ("[crowd.groups]\nshares = [0.5, 0.5]\n", "shares"),
        ("[crowd.groups]\nshares = [0.0, 0.0, 0.0, 0.0]\n", "shares together"),
        ("[crowd.social_force]\nstrength = -1.0\n", "allowed is 0 to 50"),
        ("[crowd.social_force]\nstrenght = 1.0\n", "strength"),
    ] {
        let error = read(crowd).unwrap_err();
        let text = format!("{error} {:?}", error.hint());
        assert!(text.contains(told), "{crowd} gives {text}");
    }
}

#[test]
fn a_group_comes_in_through_one_opening_not_through_a_gap_beside_it() {
    // A way in of 0.8 m, and 0.2 m beside it a gap of 0.2 m that nobody can walk.
    let floor = |p: Vec2| {
        let inside = p.x > 6.0 && p.y > 0.3 && p.y < 3.7;
        inside || p.y > 1.0 && p.y < 1.8 || p.x < 6.0 && p.y > 2.0 && p.y < 2.2
    };
    let scene = Scene::new([12.0, 4.0], floor, vec![across("west")]);
    let mut in_gap = 0;
    let tally = walk(&scene, &social(40, [0.0, 0.0, 0.0, 1.0]), 1, |frame, _| {
        in_gap += frame.walkers.iter().filter(|w| w.position_m.x < 5.5 && w.position_m.y > 1.9).count();
    });
    assert_eq!((tally.arrived, in_gap), (40, 0), "{:?}", tally.stuck);
}
