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
        slows_down(),
        hurries_past(),
        drifts_across(),
        three_come(),
        three_leave(),
        four_come(),
        pair_and_one_come(),
        pair_leaves_and_one_comes(),
        pairs_meet_behind(),
    ];
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

fn slows_down() -> Scene {
    let actor = Actor::new(0, [0.8, -1.9], AWAY)
        .to([0.95, 0.3], 1.2)
        .to([1.0, 1.5], 0.6)
        .faces(60.0)
        .to([0.7, 2.9], 0.45)
        .stays(0.3)
        .to([0.3, 7.5], 1.4);
    Scene::new(
        "slows_down",
        "slows down in front",
        "somebody comes from behind, slows down over a message, and hurries on",
        9.0,
        vec![actor],
    )
}

fn hurries_past() -> Scene {
    let actor = Actor::new(0, [-0.5, -2.2], AWAY)
        .to([-0.9, -0.6], 1.4)
        .to([-0.85, 1.0], 1.9)
        .to([0.5, 3.6], 2.2)
        .to([0.8, 9.0], 2.2);
    Scene::new("hurries_past", "hurries past", "somebody from behind breaks into a run", 5.2, vec![actor])
}

fn drifts_across() -> Scene {
    let actor = Actor::new(0, [-0.8, -1.7], AWAY)
        .to([-0.95, 0.4], 1.15)
        .to([-0.7, 1.3], 0.8)
        .to([0.9, 2.2], 0.9)
        .to([1.4, 3.0], 0.7)
        .stays(0.8)
        .faces(160.0)
        .stays(1.0)
        .faces(AWAY)
        .stays(0.2)
        .to([1.0, 7.0], 1.2);
    Scene::new(
        "drifts_across",
        "drifts across",
        "somebody from behind drifts across in front of the viewer, stops and looks back",
        10.4,
        vec![actor],
    )
}

fn three_come() -> Scene {
    let at = |x: f64, side: f64, late: f64| {
        Actor::new(0, [x, -1.7 - late], AWAY)
            .to([side, -0.5 - late * 0.5], 1.15)
            .to([side * 0.98, 0.7], 1.0)
            .to([x, 3.2], 1.2)
            .to([x, 8.6], WALK)
    };
    Scene::new(
        "three_come",
        "three come round the viewer",
        "three from behind pass the viewer, one on the left, two on the right",
        7.4,
        vec![at(-0.7, -0.85, 0.0), at(0.05, 0.7, 0.3), at(0.8, 1.3, 0.05)],
    )
}

fn three_leave() -> Scene {
    let at = |x: f64, speed: f64, out: f64| {
        Actor::new(0, [x, -1.2], TOWARDS).to([x, -2.4], 1.1).to([out, -4.2], speed).to([out, -9.0], 1.15)
    };
    let looks = Actor::new(0, [0.0, -1.5], TOWARDS)
        .to([0.0, -2.5], 1.1)
        .faces(0.0)
        .stays(0.8)
        .faces(60.0)
        .stays(1.0)
        .faces(0.0)
        .stays(0.7)
        .faces(TOWARDS)
        .to([0.0, -8.0], 1.5);
    Scene::new(
        "three_leave",
        "one of three looks back",
        "three who have passed slow down, the one in the middle looks back",
        5.4,
        vec![at(-0.75, 0.75, -0.6), looks, at(0.75, 0.8, 0.65)],
    )
}

fn four_come() -> Scene {
    let at = |x: f64, y: f64, side: f64| {
        Actor::new(0, [x, y], AWAY)
            .to([side, -0.45 + 0.4 * (y + 1.5)], 1.15)
            .to([side * 0.98, 0.9], 1.0)
            .to([x, 3.4], 1.2)
            .to([x, 9.0], WALK)
    };
    Scene::new(
        "four_come",
        "four come round the viewer",
        "four from behind part around the viewer, two to each side",
        7.6,
        vec![at(-0.8, -1.4, -1.25), at(-0.25, -2.2, -0.7), at(0.35, -2.1, 0.7), at(0.9, -1.3, 1.25)],
    )
}

fn pair_and_one_come() -> Scene {
    let pair = |x: f64, side: f64| {
        Actor::new(0, [x, -1.4], AWAY).to([side, -0.3], 1.05).to([side, 1.2], 0.9).to([x, 7.5], 1.15)
    };
    let quick = Actor::new(1, [-0.3, -2.4], AWAY)
        .to([-0.85, -0.7], 1.35)
        .to([-0.85, 0.9], 1.5)
        .to([0.1, 3.4], 1.6)
        .to([0.2, 10.0], 1.5);
    Scene::new(
        "pair_and_one",
        "overtakes a pair from behind",
        "two from behind stroll past the viewer, a third hurries by on the other side",
        6.6,
        vec![pair(0.3, 0.65), pair(1.05, 1.4), quick],
    )
}

fn pair_leaves_and_one_comes() -> Scene {
    let pair =
        |x: f64| Actor::new(0, [x, -1.3], TOWARDS).to([x, -2.6], 1.0).to([x * 0.9, -4.2], 0.8).to([x, -9.0], 1.1);
    Scene::new(
        "pair_met",
        "a pair strolls off, and one comes",
        "two who have passed stroll off, another comes the other way",
        6.0,
        vec![pair(0.35), pair(1.1), comes_left(1, -0.85)],
    )
}

fn pairs_meet_behind() -> Scene {
    let comes = |x: f64, y: f64, side: f64| {
        Actor::new(0, [x, y], AWAY).to([side, -0.4], 1.1).to([side, 0.9], 0.95).to([x, 8.0], 1.2)
    };
    let leaves = |x: f64, out: f64| {
        Actor::new(1, [x, -1.1], TOWARDS).to([x, -1.9], 1.05).to([out, -3.4], 0.8).to([out, -9.0], 1.15)
    };
    Scene::new(
        "pairs_pass",
        "two pairs pass behind",
        "behind the viewer one pair comes and another leaves",
        6.0,
        vec![comes(-1.35, -2.0, -1.4), comes(-0.6, -2.1, -0.7), leaves(0.4, 0.45), leaves(1.1, 1.2)],
    )
}
