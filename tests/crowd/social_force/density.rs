//! Speed against density.

use trodden::crowd::CrowdOptions;
use trodden::math::Vec2;
use trodden::motion::Walker;

use super::scene::{ALONE, Scene, area, endless, opening, route, walk};

const LENGTH_M: f64 = 26.0;

fn one_way() -> Scene {
    Scene::corridor(LENGTH_M, 2.0, vec![route(area([0.0, LENGTH_M], [0.0, 2.4]), opening("east"))])
}

/// Mean speed along x after the first ten seconds.
pub fn mean_speed_m_s(scene: &Scene, options: &CrowdOptions, seed: u64) -> f64 {
    let mut last: Vec<Option<Vec2>> = vec![None; options.people as usize];
    let (mut moved_m, mut seconds) = (0.0, 0.0);
    let tally = walk(scene, options, seed, |frame, _| {
        for walker in &frame.walkers {
            let before = last[walker.id as usize].replace(walker.position_m);
            if let Some(before) = before.filter(|_| frame.time_s > 10.0) {
                let dx = walker.position_m.x - before.x;
                moved_m += if dx.abs() > 0.5 * LENGTH_M { dx - LENGTH_M * dx.signum() } else { dx };
                seconds += options.time_step;
            }
        }
    });
    assert_eq!(tally.entered, u64::from(options.people), "not everybody found room");
    moved_m / seconds
}

#[test]
fn speed_falls_with_density_about_as_weidmann_found() {
    let scene = one_way();
    let densities = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
    let weidmann = densities.map(|rho| 1.34 * (1.0 - libm::exp(-1.913 * (1.0 / rho - 1.0 / 5.4))));
    let speeds = densities.map(|rho| mean_speed_m_s(&scene, &endless((rho * 52.0) as u32, ALONE, LENGTH_M, 40.0), 1));
    let squares = speeds.iter().zip(weidmann).map(|(v, w)| (v - w) * (v - w)).sum::<f64>();
    let rmse = (squares / 6.0).sqrt();
    println!("speeds {speeds:.2?} m/s at {densities:?} persons/m2, Weidmann {weidmann:.2?}, error {rmse:.3} m/s");
    assert!(rmse < 0.09, "{rmse}");
    // RiMEA 4: the shape.
    assert!(speeds.is_sorted_by(|a, b| a > b), "speed falls with density: {speeds:?}");
    let flows: Vec<f64> = speeds.iter().zip(densities).map(|(v, rho)| v * rho).collect();
    let most = flows.iter().copied().fold(0.0, f64::max);
    assert!((0.9..=1.6).contains(&most) && most != flows[0] && most != flows[5] && flows[5] < 0.7 * most, "{flows:?}");
}

#[test]
fn counter_flow_forms_lanes_and_does_not_lock_up() {
    // Order of lanes as in the tests of the other model: 1 with perfect lanes, about 0.13 for people at random.
    let everywhere = area([0.0, LENGTH_M], [0.0, 4.4]);
    let scene = Scene::corridor(
        LENGTH_M,
        4.0,
        vec![route(everywhere.clone(), opening("east")), route(everywhere, opening("west"))],
    );
    let (mut order, mut count, mut speed, mut moments) = (0.0, 0.0, 0.0, 0.0);
    for seed in 1..=4 {
        walk(&scene, &endless(52, ALONE, LENGTH_M, 60.0), seed, |frame, _| {
            if frame.time_s < 20.0 || !((frame.time_s * 10.0).round() as u64).is_multiple_of(10) {
                return;
            }
            for a in &frame.walkers {
                speed += a.velocity_m_s.length();
                moments += 1.0;
                let near = |b: &&Walker| b.id != a.id && (a.position_m.y - b.position_m.y).abs() < 0.3;
                let (mut same, mut against) = (0.0, 0.0);
                for b in frame.walkers.iter().filter(near) {
                    *if a.heading.unwrap().x * b.heading.unwrap().x > 0.0 { &mut same } else { &mut against } += 1.0;
                }
                if same + against > 0.0 {
                    let share: f64 = (same - against) / (same + against);
                    order += share * share;
                    count += 1.0;
                }
            }
        });
    }
    let (order, speed) = (order / count, speed / moments);
    println!("counter flow at 0.5 persons/m2: order of lanes {order:.2}, {speed:.2} m/s");
    assert!(order > 0.35 && speed > 1.0, "{order} {speed}");
}
