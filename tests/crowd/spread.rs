//! How ways of people spread over a hall: neither a ribbon behind a gate, nor a bulge between two doors.

use trodden::math::Vec2;

use super::scene::{Scene, across, commuters, opening, route};

/// Where people cross the line at `x` on their way east, metres: mean and standard deviation of y.
fn crossing(scene: &Scene, people: u32, x: f64) -> (f64, f64) {
    let mut last = std::collections::BTreeMap::new();
    let mut ys: Vec<f64> = Vec::new();
    scene.walk(&commuters(people), 1, |frame| {
        for w in &frame.walkers {
            if let Some(before) = last.insert(w.id, w.position_m)
                && before.x < x
                && w.position_m.x >= x
            {
                ys.push(w.position_m.y);
            }
        }
    });
    let count = ys.len() as f64;
    assert!(count > 0.9 * f64::from(people), "{count} cross");
    let mean = ys.iter().sum::<f64>() / count;
    (mean, (ys.iter().map(|y| (y - mean) * (y - mean)).sum::<f64>() / count).sqrt())
}

/// A hall of 24 x 20 m with doors of 1.2 m in the middle of its western and eastern walls.
fn hall() -> Scene {
    let floor = |p: Vec2| {
        let hall = p.x > 1.0 && p.x < 25.0 && p.y > 0.5 && p.y < 20.5;
        hall || (p.y - 10.5).abs() < 0.6
    };
    Scene::new([26.0, 21.0], floor, vec![across("west")])
}

#[test]
fn from_door_to_door_across_a_hall_people_go_nearly_straight() {
    let (mean, sd) = crossing(&hall(), 200, 13.0);
    println!("half way between two doors 24 m apart: sd {sd:.2} m");
    assert!((mean - 10.5).abs() < 0.3, "{mean}");
    assert!((0.3..0.5).contains(&sd), "{sd} m");
}

#[test]
fn behind_a_gate_ways_part() {
    // From an aisle of 0.9 m in the south-west to a passage of 5 m in the north-east, round its corner.
    let floor = |p: Vec2| {
        let aisle = p.x < 3.0 && (p.y - 3.0).abs() < 0.45;
        let hall = p.x >= 3.0 && p.x < 33.0 && p.y > 0.5 && p.y < 16.0;
        let passage = p.x > 27.0 && p.x < 32.0 && p.y >= 16.0;
        aisle || hall || passage
    };
    let scene = Scene::new([34.0, 24.0], floor, vec![route(opening("west"), opening("north"))]);
    let sds = [8.0, 13.0, 18.0].map(|x| crossing(&scene, 200, x).1);
    println!("5, 10 and 15 m behind an aisle of 0.9 m: sd {sds:.2?} m");
    assert!(sds[0] > 0.25 && sds[1] > 0.5 && sds[2] > 0.55, "{sds:?}");
    assert!(sds[1] < 1.5 && sds[2] < 2.0, "{sds:?}");
}
