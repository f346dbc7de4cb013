use super::super::actor::{AWAY, Actor, Scene, TOWARDS, WALK};

/// Scenes with people behind the viewer: on their own, and added to scenes in front.
pub fn scenes(front: &[Scene]) -> Vec<Scene> {
    let mut scenes = vec![
        startles(),
        stops_beside(),
        leaves_and_looks_back(),
        pair_comes(),
        pair_leaves(),
        two_come(),
        comes_and_leaves(),
    ];
    let comes = |group: u32| vec![comes(group, 0.9)];
    let leaves = |group: u32| vec![leaves(group, 0.3)];
    let both = |group: u32| vec![comes_left(group, -1.15), leaves_at(group + 1, 0.4)];
    for scene in front {
        let group = 10;
        let (a, b) = (
            ("comes", "one from behind", "another comes from behind"),
            ("leaves", "one behind", "another leaves behind"),
        );
        match scene.file.as_str() {
            // Whoever comes from behind needs room in front, whoever leaves does so ahead of those who come.
            "phone" | "turns_back" | "lost" | "crosses" => {
                scenes.push(scene.with(
                    a.0,
                    a.1,
                    a.2,
                    vec![comes_left(group, if scene.file == "turns_back" { 0.95 } else { -1.1 })],
                ));
            }
            "shoe" => scenes.push(scene.with(a.0, a.1, a.2, vec![comes_left(group, -0.8)])),
            _ => {}
        }
        match scene.file.as_str() {
            "late_notice" | "phone" | "shoe" | "looks_around" | "pair_talks" | "pair_shoe" | "pair_parts" | "greet"
            | "lets_pass" | "overtakes_away" | "pair_opens" => {
                scenes.push(scene.with(b.0, b.1, b.2, leaves(group)));
            }
            _ => {}
        }
        match scene.file.as_str() {
            "pair_talks" | "overtakes_away" | "greet" => {
                scenes.push(scene.with(a.0, a.1, a.2, vec![comes_left(group, -1.3)]));
            }
            "phone" => scenes.push(scene.with(
                "both",
                "two behind",
                "one comes from behind, another leaves there",
                both(group),
            )),
            _ => {}
        }
    }
    let _ = comes;
    scenes
}

/// From behind past the viewer, by the right.
fn comes(group: u32, x: f64) -> Actor {
    Actor::new(group, [x * 0.6, -2.0], AWAY).to([x, -0.3], 1.2).to([x, 0.9], 1.0).to([x * 0.8, 9.0], WALK)
}

/// The same, straight on at a distance.
fn comes_left(group: u32, x: f64) -> Actor {
    Actor::new(group, [x * 0.8, -1.6], AWAY).to([x, 0.0], 1.2).to([x, 1.4], 0.9).to([x, 12.0], 1.3)
}

fn leaves(group: u32, x: f64) -> Actor {
    leaves_at(group, x)
}

fn leaves_at(group: u32, x: f64) -> Actor {
    Actor::new(group, [x, -1.7], TOWARDS).to([x * 0.9, -3.0], 1.25).to([x * 0.5, -18.0], 1.4)
}

fn startles() -> Scene {
    let actor = Actor::new(0, [0.1, -2.4], AWAY)
        .to([0.15, -1.2], 1.25)
        .glides([0.3, -0.9], 0.5)
        .glides([0.75, -0.7], 0.7)
        .to([0.85, 0.4], 0.9)
        .faces(130.0)
        .glides([0.8, 1.3], 0.9)
        .faces(AWAY)
        .to([0.4, 7.5], 1.35);
    Scene::new(
        "startles",
        "comes up behind the viewer",
        "somebody comes from behind, nearly runs into the viewer, steps round and looks back",
        8.4,
        vec![actor],
    )
}

fn stops_beside() -> Scene {
    let actor = Actor::new(0, [-0.9, -1.8], AWAY)
        .to([-0.95, 0.4], 1.2)
        .to([-0.9, 1.4], 0.8)
        .stays(0.6)
        .faces(45.0)
        .stays(1.4)
        .faces(130.0)
        .stays(1.6)
        .faces(AWAY)
        .stays(0.3)
        .to([-0.5, 7.0], WALK);
    Scene::new(
        "stops_in_front",
        "stops in front",
        "somebody comes from behind, stops in front of the viewer, looks about and goes on",
        11.0,
        vec![actor],
    )
}

fn leaves_and_looks_back() -> Scene {
    let actor = Actor::new(0, [0.5, -1.0], TOWARDS)
        .to([0.5, -2.2], 1.2)
        .stays(0.8)
        .faces(20.0)
        .stays(1.2)
        .faces(TOWARDS)
        .stays(0.3)
        .to([0.3, -7.0], 1.35);
    Scene::new("looks_back", "looks back", "somebody who has passed stops and looks back", 5.6, vec![actor])
}

fn pair_comes() -> Scene {
    let left = Actor::new(0, [-0.4, -1.9], AWAY)
        .to([-0.75, -0.6], 1.1)
        .to([-0.8, 0.6], 1.05)
        .to([-0.2, 3.0], 1.2)
        .to([-0.2, 8.5], WALK);
    let right = Actor::new(0, [0.4, -2.0], AWAY)
        .to([0.75, -0.7], 1.1)
        .to([0.85, 0.5], 1.0)
        .to([0.55, 2.6], 1.3)
        .to([0.6, 8.5], WALK);
    Scene::new(
        "pair_comes",
        "a pair comes round the viewer",
        "two from behind part around the viewer and find together again",
        7.2,
        vec![left, right],
    )
}

fn pair_leaves() -> Scene {
    let left = Actor::new(0, [-0.5, -1.3], TOWARDS).to([-0.45, -2.6], 1.1).to([-0.4, -4.4], 0.8).to([-0.4, -9.0], 1.15);
    let right = Actor::new(0, [0.35, -1.4], TOWARDS)
        .to([0.35, -2.5], 1.1)
        .faces(-150.0)
        .glides([0.35, -4.3], 0.8)
        .faces(TOWARDS)
        .glides([0.4, -9.0], 1.15);
    Scene::new(
        "pair_leaves",
        "a pair strolls off",
        "two who have passed slow down and chat while they walk off",
        5.0,
        vec![left, right],
    )
}

fn two_come() -> Scene {
    let first = Actor::new(0, [-0.8, -1.0], AWAY).to([-0.85, 0.5], 1.1).to([-0.8, 2.0], 0.9).to([-0.6, 8.0], 1.2);
    let second = Actor::new(1, [0.5, -2.3], AWAY)
        .to([0.8, -0.4], 1.3)
        .to([0.85, 0.8], 1.3)
        .to([0.4, 3.0], 1.5)
        .to([0.3, 9.0], 1.5);
    Scene::new(
        "two_come",
        "two come from behind",
        "two strangers from behind pass the viewer on both sides, the second in a hurry",
        6.6,
        vec![first, second],
    )
}

fn comes_and_leaves() -> Scene {
    Scene::new(
        "comes_and_leaves",
        "one comes and one leaves behind",
        "behind the viewer somebody comes and another leaves",
        6.0,
        vec![comes(0, 0.9), leaves_at(1, -0.6)],
    )
}
