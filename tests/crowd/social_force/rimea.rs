//! The RiMEA guideline's verification tests 1 and 6 (RiMEA 3.0, 2016); test 4 is in `density`.

use trodden::crowd::CrowdOptions;
use trodden::math::{Distribution, Vec2};

use super::scene::{ALONE, Scene, area, opening, route, social, walk};

#[test]
fn test_1_one_person_keeps_the_speed_in_a_corridor() {
    let scene = Scene::corridor(44.0, 2.0, vec![route(area([0.5, 1.5], [0.6, 1.8]), opening("east"))]);
    let options = CrowdOptions { speed: Distribution::Constant(1.33), entry_seconds: Some(0.0), ..social(1, ALONE) };
    let (mut from, mut seconds) = (None, 0.0);
    walk(&scene, &options, 1, |frame, _| {
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
fn test_6_nobody_crosses_the_walls_of_a_corner() {
    // 2 m wide, 12 m before the left turn, 12 m behind it; alone, in pairs and in fours.
    let floor = |p: Vec2| (p.x > 10.0 || p.y < 2.2) && p.x < 12.0 && p.y > 0.2;
    let scene = Scene::new([12.2, 12.2], floor, vec![route(area([0.2, 6.0], [0.3, 2.1]), opening("north"))]);
    for shares in [ALONE, [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]] {
        let mut in_wall = 0;
        let options = CrowdOptions { entry_seconds: Some(0.0), ..social(20, shares) };
        let tally = walk(&scene, &options, 1, |frame, _| {
            in_wall += frame.walkers.iter().filter(|w| scene.is_in_wall(w.position_m)).count();
        });
        assert_eq!((tally.arrived, in_wall), (20, 0), "{shares:?}: {:?}", tally.stuck);
    }
}
