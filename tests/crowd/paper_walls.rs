//! The crowd of the paper's experiment at walls: nobody is caught there, pressed against them or pushed out of the plan.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use trodden::crowd::Simulation;
use trodden::math::{Rect, Vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::plan;
use trodden::routes::Navigation;
use trodden::scenario::{Overrides, Preset, Scenario};
use trodden::walls::Walls;

/// Ten metres of corridor behind a turn, and the distance from the outer wall, metres.
type AfterTurn = (&'static str, Rect, fn(Vec2) -> f64);

fn after_turns() -> [AfterTurn; 4] {
    let area = |min: [f64; 2], max: [f64; 2]| Rect { min: min.into(), max: max.into() };
    [
        ("split", area([41.5, 25.0], [46.5, 35.0]), |p| 46.5 - p.x),
        ("merging", area([47.0, 55.5], [57.0, 60.5]), |p| 60.5 - p.y),
        ("north-west", area([21.0, 55.5], [31.0, 60.5]), |p| p.y - 55.5),
        ("north-east", area([63.5, 45.0], [68.5, 55.0]), |p| 68.5 - p.x),
    ]
}

/// What a crowd did at walls, at its worst.
#[derive(Debug)]
struct Worst {
    /// Longest time for which somebody was slower than 0.8 m/s within 0.8 m of a wall, seconds.
    slow_at_wall_s: f64,
    /// Least distance from a wall, and between two people, metres.
    off_wall_m: f64,
    apart_m: f64,
    /// People who left the plan and came back.
    came_back: usize,
    /// Shares of presence behind each turn that lie 0.5 to 0.7 m from the outer wall.
    at_outer_wall: [f64; 4],
}

fn watch(mut crowd: Simulation<'_>, walls: &Walls, image: Rect) -> Worst {
    let mut worst = Worst { slow_at_wall_s: 0.0, off_wall_m: 9.0, apart_m: 9.0, came_back: 0, at_outer_wall: [0.0; 4] };
    let (mut slow_s, mut inside) = (HashMap::<u32, f64>::new(), HashSet::new());
    let (mut left, mut back) = (HashSet::new(), HashSet::new());
    let mut present = [[0.0; 2]; 4];
    let (mut frame, mut before_s) = (Frame::default(), 0.0);
    while crowd.next_frame(&mut frame).unwrap() {
        let step_s = frame.time_s - std::mem::replace(&mut before_s, frame.time_s);
        for (k, walker) in frame.walkers.iter().enumerate() {
            let p = walker.position_m;
            for other in &frame.walkers[..k] {
                worst.apart_m = worst.apart_m.min(p.distance(other.position_m));
            }
            if !image.contains(p) {
                if inside.contains(&walker.id) {
                    left.insert(walker.id);
                }
                continue;
            }
            inside.insert(walker.id);
            if left.contains(&walker.id) {
                back.insert(walker.id);
            }
            let off_wall_m = walls.nearest(p, 5.0).map_or(5.0, |near| near.distance_m);
            worst.off_wall_m = worst.off_wall_m.min(off_wall_m);
            let slow_s = slow_s.entry(walker.id).or_default();
            *slow_s = if off_wall_m < 0.8 && walker.velocity_m_s.length() < 0.8 { *slow_s + step_s } else { 0.0 };
            worst.slow_at_wall_s = worst.slow_at_wall_s.max(*slow_s);
            for ((_, area, off_m), present) in after_turns().iter().zip(&mut present) {
                if area.contains(p) {
                    present[0] += f64::from(u8::from((0.5..0.7).contains(&off_m(p))));
                    present[1] += 1.0;
                }
            }
        }
    }
    assert_eq!(crowd.tally().arrived, 1000);
    worst.came_back = back.len();
    worst.at_outer_wall = present.map(|[near, all]| near / all);
    worst
}

#[test]
fn nobody_is_caught_at_a_wall() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/corridors.toml");
    let overrides = Overrides { preset: Some(Preset::Paper), ..Overrides::default() };
    let scenario = Scenario::open(&path, &overrides).unwrap();
    let plan = plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options()).unwrap();
    let walls = Walls::trace(&plan, &scenario.walls);
    let (routes, navigation) = Navigation::find(&plan, &walls, &scenario.routes).unwrap();
    let image = Rect { min: Vec2::ZERO, max: Vec2 { x: plan.width_m(), y: plan.height_m() } };
    for seed in 1..=8 {
        let people = People::new(seed, BodyOptions::default());
        let navigation = navigation.clone();
        let crowd = Simulation::with_navigation(&plan, &walls, &routes, navigation, &people, &scenario.crowd).unwrap();
        let worst = watch(crowd, &walls, image);
        println!("seed {seed}: {worst:.3?}");
        assert!(worst.slow_at_wall_s < 6.0, "seed {seed}: slow at a wall for {:.1} s", worst.slow_at_wall_s);
        assert!(worst.off_wall_m > 0.49, "seed {seed}: {:.3} m from a wall", worst.off_wall_m);
        assert!(worst.apart_m > 0.45, "seed {seed}: two people {:.3} m apart", worst.apart_m);
        assert_eq!(worst.came_back, 0, "seed {seed}: people left the plan and came back");
        // Spread evenly over the 4 m that people walk in, 5 % would be there.
        for ((name, ..), share) in after_turns().iter().zip(worst.at_outer_wall) {
            assert!(share < 0.09, "seed {seed}, {name}: {:.1} % at the outer wall", 100.0 * share);
        }
    }
}
