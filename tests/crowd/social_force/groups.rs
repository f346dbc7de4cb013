//! Groups against Moussaid, Perozo, Garnier, Helbing, Theraulaz 2010.

use trodden::crowd::CrowdOptions;
use trodden::math::Vec2;

use super::scene::{Scene, across, deviation, mean, social, walk};

/// A hall that few people cross.
fn hall() -> Scene {
    Scene::corridor(40.0, 10.0, vec![across("west")])
}

/// Neighbours in groups of one size: distances, and angles from the way to the neighbour on the right, degrees; for three,
/// how far the middle one is behind the other two.
struct Shape {
    distances_m: Vec<f64>,
    angles_deg: Vec<f64>,
    behind_m: Vec<f64>,
    speeds_m_s: Vec<f64>,
}

fn shape(size: usize, seed: u64) -> Shape {
    let mut shape =
        Shape { distances_m: Vec::new(), angles_deg: Vec::new(), behind_m: Vec::new(), speeds_m_s: Vec::new() };
    let mut shares = [0.0; 4];
    shares[size - 1] = 1.0;
    let options = CrowdOptions { entry_seconds: Some(120.0), ..social(12 * size as u32, shares) };
    let tally = walk(&hall(), &options, seed, |frame, crowd| {
        for walker in &frame.walkers {
            let members = crowd.group_of(walker.id);
            if members.start != walker.id {
                continue;
            }
            let mut group: Vec<(Vec2, Vec2)> = frame
                .walkers
                .iter()
                .filter(|w| members.contains(&w.id))
                .map(|w| (w.position_m, w.velocity_m_s))
                .collect();
            // Once they have found together, and before they leave.
            if group.len() < size || group.iter().any(|(p, _)| p.x < 10.0 || p.x > 38.0) {
                continue;
            }
            // From left to right of the way, which is +x.
            group.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
            shape.speeds_m_s.extend(group.iter().map(|(_, v)| v.length()));
            for pair in group.windows(2) {
                let to_right = pair[1].0 - pair[0].0;
                shape.distances_m.push(to_right.length());
                shape.angles_deg.push(libm::atan2(-to_right.y, to_right.x).to_degrees());
            }
            if let [left, middle, right] = group[..] {
                shape.behind_m.push(0.5 * (left.0.x + right.0.x) - middle.0.x);
            }
        }
    });
    assert_eq!(tally.arrived, u64::from(options.people), "{:?}", tally.stuck);
    shape
}

#[test]
fn pairs_walk_side_by_side() {
    let shape = shape(2, 1);
    let (distance_m, angle_deg) = (mean(&shape.distances_m), mean(&shape.angles_deg));
    let spread = [deviation(&shape.distances_m), deviation(&shape.angles_deg)];
    println!("pairs: {distance_m:.2} +- {:.2} m apart at {angle_deg:.0} +- {:.0} degrees", spread[0], spread[1]);
    assert!((0.7..=0.9).contains(&distance_m), "{distance_m}");
    assert!((angle_deg - 90.0).abs() < 5.0 && spread[1] < 20.0, "{angle_deg} +- {}", spread[1]);
}

#[test]
fn of_three_the_middle_one_walks_behind() {
    let shape = shape(3, 1);
    let (distance_m, behind_m) = (mean(&shape.distances_m), mean(&shape.behind_m));
    let share = shape.behind_m.iter().filter(|&&b| b > 0.0).count() as f64 / shape.behind_m.len() as f64;
    println!(
        "threes: {distance_m:.2} m apart, the middle one {behind_m:.2} m behind, {:.0} % of the time",
        100.0 * share
    );
    assert!((0.7..=1.0).contains(&distance_m), "{distance_m}");
    assert!(behind_m > 0.03 && share > 0.65, "{behind_m} {share}");
}

#[test]
fn larger_groups_walk_more_slowly() {
    let speeds = [1, 2, 3, 4].map(|size| mean(&[1, 2, 3].map(|seed| mean(&shape(size, seed).speeds_m_s))));
    println!("speeds by group size: {speeds:.2?} m/s; observed 1.22, 1.18, 1.14, 1.10 at low density");
    assert!(speeds[1] > speeds[2] && speeds[2] > speeds[3] && speeds[0] > speeds[3], "{speeds:?}");
}
