//! What a crowd must keep to, whatever the plan: walls, distances, determinism, the order of ids.

use proptest::prelude::*;
use trodden::crowd::{CrowdError, CrowdOptions, Simulation};
use trodden::math::{Distribution, Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People, Walker};
use trodden::plan::PlanPoint;
use trodden::routes::{PlaceRequest, RouteRequest, ViaRequest};

use super::scene::{Scene, across, commuters, opening, route};

#[test]
fn trajectories_are_the_same_for_any_number_of_threads() {
    // Enough people at once for the work to be split.
    let scene = Scene::corridor(40.0, 12.0, vec![across("west"), across("east")]);
    let options = CrowdOptions { entry_seconds: Some(20.0), end_seconds: Some(40.0), ..commuters(700) };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let (mut walkers, mut most): (Vec<Walker>, usize) = (Vec::new(), 0);
            scene.walk(&options, 5, |frame| {
                most = most.max(frame.walkers.len());
                walkers.extend(&frame.walkers);
            });
            (walkers, most)
        })
    };
    let (one, most) = run(1);
    assert!(most > 300, "only {most} at once");
    for threads in [2, 16] {
        assert!(run(threads).0 == one, "{threads} threads walk differently");
    }
}

#[test]
fn ids_follow_arrivals_and_frames_list_them_in_order() {
    let scene = Scene::corridor(20.0, 3.0, vec![across("west"), across("east")]);
    let people = People::new(3, BodyOptions::default());
    let mut crowd = scene.crowd(&people, &commuters(80));
    let arrivals = crowd.arrivals().to_vec();
    assert_eq!(arrivals.len(), 80);
    assert!(arrivals.is_sorted_by(|a, b| a.id < b.id && a.time_s <= b.time_s));
    assert!(arrivals.iter().all(|a| a.from_outside));
    let mut frame = Frame::default();
    let mut before = -1.0;
    while crowd.next_frame(&mut frame).expect("a step") {
        assert!(frame.time_s > before && frame.walkers.is_sorted_by(|a, b| a.id < b.id));
        assert!(frame.walkers.iter().all(|w| w.position_m.is_finite() && w.velocity_m_s.is_finite()));
        // Nobody is there before wanting to enter.
        assert!(frame.walkers.iter().all(|w| arrivals[w.id as usize].time_s <= frame.time_s));
        before = frame.time_s;
    }
    assert_eq!(crowd.share_done(), 1.0);
}

#[test]
fn who_goes_along_a_corridor_stays_out_of_its_niche() {
    // 4 m wide, with a niche 4 m wide and 3 m deep on one side, and a side way without end on the other.
    let floor = |p: Vec2| (8.0..12.0).contains(&p.y) || (18.0..22.0).contains(&p.x) && (0.0..15.0).contains(&p.y);
    let scene = Scene::new([40.0, 20.0], floor, vec![route(opening("west"), opening("east"))]);
    let (mut beside, mut inside) = (0, 0);
    scene.walk(&commuters(200), 1, |frame| {
        for walker in frame.walkers.iter().filter(|walker| (18.0..22.0).contains(&walker.position_m.x)) {
            beside += 1;
            inside += u32::from(!(8.0..12.0).contains(&walker.position_m.y));
        }
    });
    assert!(beside > 3000, "{beside}");
    assert!(inside * 200 < beside, "{inside} of {beside} are in the niche");
}

#[test]
fn bodies_overlap_by_less_than_a_tenth_after_each_step() {
    // 2 and 3.5 persons per square metre, all the same exclusion distance so that it can be checked.
    let everywhere = PlaceRequest::Area([[0.0, 0.0], [26.0, 2.4]]);
    let scene = Scene::corridor(26.0, 2.0, vec![route(everywhere, opening("east"))]);
    for people in [104, 182] {
        let options = CrowdOptions {
            exclusion: Distribution::Constant(0.32),
            entry_seconds: Some(0.0),
            end_seconds: Some(20.0),
            period_x: Some(26.0),
            ..commuters(people)
        };
        let (mut near, mut deep) = (0u32, 0u32);
        let tally = scene.walk(&options, 1, |frame| {
            for (k, a) in frame.walkers.iter().enumerate() {
                for b in &frame.walkers[k + 1..] {
                    let distance = a.position_m.distance(b.position_m);
                    near += u32::from(distance < 0.5);
                    deep += u32::from(distance < 0.9 * 0.32);
                }
            }
        });
        assert_eq!(tally.entered, u64::from(people));
        assert!(near > 1000 && f64::from(deep) < 1e-3 * f64::from(near), "{people} people: {deep} of {near}");
    }
}

#[test]
fn a_corridor_is_walked_over_its_width_but_not_along_its_walls() {
    let scene = Scene::corridor(30.0, 5.0, vec![across("west"), across("east")]);
    let mut across = [0u32; 50];
    scene.walk(&commuters(300), 1, |frame| {
        for w in frame.walkers.iter().filter(|w| w.position_m.x > 5.0 && w.position_m.x < 25.0) {
            across[((w.position_m.y - 0.2) * 10.0) as usize] += 1;
        }
    });
    let all: u32 = across.iter().sum();
    let mean = f64::from(all) / 50.0;
    let used = across.iter().filter(|&&n| f64::from(n) > 0.25 * mean).count();
    assert!(used >= 36, "{used} of 50 strips of 10 cm are walked: {across:?}");
    let at_walls: u32 = across[..2].iter().chain(&across[48..]).sum();
    assert!(f64::from(at_walls) < 2e-3 * f64::from(all), "{at_walls} of {all} within 20 cm of the walls");
    let most = across.iter().copied().max().unwrap_or(0);
    assert!(f64::from(most) < 2.5 * mean, "one line carries {most}, the mean is {mean}");
}

#[test]
fn openings_are_as_trodden_as_the_rest() {
    // Metres walked in the first and last metre of the plan against those four metres inside.
    let scene = Scene::corridor(20.0, 4.0, vec![across("west"), across("east")]);
    let mut last: std::collections::BTreeMap<u32, Vec2> = Default::default();
    let mut metres = [0.0; 20];
    scene.walk(&commuters(400), 2, |frame| {
        for w in &frame.walkers {
            if let Some(before) = last.insert(w.id, w.position_m)
                && (0.0..20.0).contains(&before.x)
            {
                metres[before.x as usize] += before.distance(w.position_m);
            }
        }
    });
    for (edge, inside) in [(0, 3), (19, 16)] {
        let ratio: f64 = metres[edge] / metres[inside];
        assert!((ratio - 1.0).abs() < 0.1, "{ratio} at {edge}: {metres:?}");
    }
}

#[test]
fn nobody_enters_where_there_is_no_room() {
    // Everybody at once through an opening of 1.2 m.
    let scene = Scene::corridor(12.0, 1.2, vec![across("west")]);
    let options = CrowdOptions { entry_seconds: Some(1.0), ..commuters(60) };
    let mut nearest: f64 = 1.0;
    let tally = scene.walk(&options, 1, |frame| {
        for (k, a) in frame.walkers.iter().enumerate() {
            for b in &frame.walkers[k + 1..] {
                nearest = nearest.min(a.position_m.distance(b.position_m));
            }
        }
    });
    assert_eq!((tally.entered, tally.arrived), (60, 60), "{:?}", tally.stuck);
    assert!(nearest > 0.25, "{nearest}");
}

#[test]
fn a_crowd_that_cannot_go_on_ends_by_itself_and_says_who_and_where() {
    // Far more people than a dead end holds, with the goal behind them all: the run must end.
    let floor = |p: Vec2| p.y > 0.2 && p.y < 1.2 && p.x > 0.2 && p.x < 3.8;
    let request = RouteRequest {
        name: Some("crush".into()),
        from: PlaceRequest::Area([[0.2, 0.2], [3.8, 1.2]]),
        to: PlaceRequest::Point(PlanPoint::Metres([3.4, 0.7])),
        via: vec![ViaRequest::Place(PlaceRequest::Point(PlanPoint::Metres([0.6, 0.7])))],
        arrivals: None,
        share: 1.0,
    };
    let scene = Scene::new([4.0, 1.4], floor, vec![request]);
    let options = CrowdOptions { patience_seconds: 10.0, entry_seconds: Some(0.0), ..commuters(300) };
    let mut last_s = 0.0;
    let tally = scene.walk(&options, 1, |frame| last_s = frame.time_s);
    assert_eq!(tally.arrived + tally.stuck.len() as u64, 300);
    assert!(last_s < 3600.0, "{last_s} s");
    assert!(tally.stuck.iter().all(|s| s.place_m.is_finite() && s.route == 0));
}

#[test]
fn options_out_of_range_are_refused() {
    let scene = Scene::corridor(10.0, 3.0, vec![across("west")]);
    let people = People::new(1, BodyOptions::default());
    let good = CrowdOptions::default();
    let bad = [
        CrowdOptions { people: 0, ..good.clone() },
        CrowdOptions { people: u32::MAX, ..good.clone() },
        CrowdOptions { speed: Distribution::Constant(f64::NAN), ..good.clone() },
        CrowdOptions { speed: Distribution::Constant(-1.0), ..good.clone() },
        CrowdOptions { exclusion: Distribution::Uniform([0.4, 0.3]), ..good.clone() },
        CrowdOptions { exclusion: Distribution::Constant(f64::INFINITY), ..good.clone() },
        CrowdOptions { entry_rate: 0.0, ..good.clone() },
        CrowdOptions { entry_seconds: Some(-1.0), ..good.clone() },
        CrowdOptions { time_step: f64::NAN, ..good.clone() },
        CrowdOptions { time_step: 3.0, ..good.clone() },
        CrowdOptions { patience_seconds: 0.0, ..good.clone() },
    ];
    for options in bad {
        let error = Simulation::new(&scene.plan, &scene.walls, &scene.routes, &people, &options).err();
        assert!(error.is_some(), "{options:?}");
    }
    let none = Simulation::new(&scene.plan, &scene.walls, &[], &people, &good).err();
    assert!(matches!(none, Some(CrowdError::NoRoutes)));
}

#[test]
fn everybody_enters_at_most_at_the_stated_rate() {
    let scene = Scene::corridor(20.0, 4.0, vec![across("west"), across("east")]);
    let people = People::new(1, BodyOptions::default());
    let crowd = scene.crowd(&people, &commuters(1000));
    let from_west = crowd.arrivals().iter().filter(|a| a.route == 0).count() as f64;
    let seconds = crowd.arrivals().last().expect("somebody").time_s;
    let rate = from_west / seconds / 4.0;
    assert!(rate < 0.33 && rate > 0.2, "{rate} persons per second and metre");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Pillars anywhere in a room: nobody walks into one, and everybody gets past.
    #[test]
    fn nobody_walks_into_pillars(
        pillars in prop::collection::vec((2.0f64..14.0, 0.5f64..7.5, 0.2f64..0.9), 0..9),
        seed in 0u64..1000,
    ) {
        let floor = |p: Vec2| {
            p.y > 0.2 && p.y < 7.8 && pillars.iter().all(|&(x, y, r)| p.distance(vec2(x, y)) > r)
        };
        // Pillars may close the way: then there is nothing to test.
        let open = {
            let mut reached = std::collections::BTreeSet::new();
            let mut border = vec![(0i32, 5i32), (0, 20), (0, 39), (0, 60), (0, 74)];
            let free = |(x, y): (i32, i32)| {
                let p = vec2(f64::from(x), f64::from(y)) * 0.1;
                p.y > 0.6 && p.y < 7.4 && pillars.iter().all(|&(px, py, r)| p.distance(vec2(px, py)) > r + 0.4)
            };
            while let Some((x, y)) = border.pop() {
                if (0..=160).contains(&x) && free((x, y)) && reached.insert((x, y)) {
                    border.extend([(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]);
                }
            }
            (0..80).any(|y| reached.contains(&(160, y)))
        };
        prop_assume!(open);
        let scene = Scene::new([16.0, 8.0], floor, vec![across("west"), across("east")]);
        let mut in_wall = 0;
        let tally = scene.walk(&CrowdOptions { entry_seconds: Some(30.0), ..commuters(60) }, seed, |frame| {
            in_wall += frame.walkers.iter().filter(|w| scene.is_in_wall(w.position_m)).count();
        });
        prop_assert_eq!((tally.entered, tally.arrived, in_wall), (60, 60, 0), "{:?}", tally.stuck);
    }
}
