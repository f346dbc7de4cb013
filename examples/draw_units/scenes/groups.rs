use super::super::actor::{AWAY, Actor, RIGHT, Scene, TOWARDS, WALK};

/// Scenes of one group in front: two, three, four.
pub fn scenes() -> Vec<Scene> {
    vec![
        parts(),
        talks(),
        waits_for_the_shoe(),
        points(),
        child_runs_ahead(),
        walks_and_lingers(),
        three_part(),
        three_look_at_a_map(),
        family(),
        four_stroll(),
    ]
}

fn parts() -> Scene {
    let left = Actor::new(0, [-0.4, 2.7], TOWARDS)
        .to([-0.42, 1.6], 1.2)
        .to([-0.8, 0.5], 1.1)
        .to([-0.75, -0.6], 1.1)
        .to([-0.35, -3.4], WALK);
    let right = Actor::new(0, [0.4, 2.7], TOWARDS)
        .to([0.42, 1.5], 1.2)
        .to([0.85, 0.4], 1.05)
        .to([0.75, -0.7], 1.1)
        .to([0.4, -3.4], WALK);
    Scene::new(
        "pair_parts",
        "a pair parts around the viewer",
        "two who come side by side let the viewer pass between them",
        5.2,
        vec![left, right],
    )
}

fn talks() -> Scene {
    let one = Actor::new(0, [0.3, 2.9], TOWARDS)
        .to([0.45, 2.2], 1.1)
        .stays(0.6)
        .looks_at([1.2, 2.0])
        .stays(4.6)
        .faces(TOWARDS)
        .stays(0.5)
        .to([0.75, 0.5], 1.0)
        .to([0.6, -3.0], WALK);
    let other = Actor::new(0, [1.1, 2.9], TOWARDS)
        .to([1.25, 2.1], 1.15)
        .faces(-140.0)
        .stays(0.5)
        .looks_at([0.45, 2.2])
        .stays(5.2)
        .faces(TOWARDS)
        .to([1.35, 0.5], 1.05)
        .to([1.3, -3.0], WALK);
    Scene::new(
        "pair_talks",
        "a pair stops to talk",
        "two stop before the viewer, turn to each other, talk, and walk on",
        10.8,
        vec![one, other],
    )
}

fn waits_for_the_shoe() -> Scene {
    let kneels =
        Actor::new(0, [0.4, 0.9], AWAY).to([0.5, 2.1], 1.2).to([0.7, 2.6], 0.7).stays(5.0).to([0.6, 7.2], 1.35);
    let waits = Actor::new(0, [-0.4, 0.9], AWAY)
        .to([-0.4, 2.9], 1.2)
        .to([-0.3, 3.4], 0.6)
        .stays(0.4)
        .faces(20.0)
        .stays(0.5)
        .looks_at([0.7, 2.6])
        .stays(3.4)
        .faces(40.0)
        .stays(0.7)
        .faces(AWAY)
        .to([-0.2, 7.2], 1.2);
    Scene::new(
        "pair_shoe",
        "a friend waits for the shoe",
        "of two who walk away one kneels down to tie a shoe, the other notices, turns round and waits",
        10.6,
        vec![kneels, waits],
    )
}

fn points() -> Scene {
    let one = Actor::new(0, [-1.3, 2.2], RIGHT)
        .to([-0.3, 2.2], 1.1)
        .stays(0.5)
        .faces(70.0)
        .stays(2.6)
        .faces(RIGHT)
        .stays(0.3)
        .to([3.2, 2.1], WALK);
    let other = Actor::new(0, [-1.2, 1.4], RIGHT)
        .to([0.2, 1.5], 1.1)
        .stays(0.4)
        .faces(80.0)
        .stays(2.5)
        .faces(10.0)
        .to([3.6, 1.4], 1.2);
    Scene::new(
        "pair_points",
        "a pair stops to look at something",
        "two who cross stop, and look and point into the distance",
        7.2,
        vec![one, other],
    )
}

fn child_runs_ahead() -> Scene {
    let child = Actor::new(0, [0.7, 1.0], AWAY)
        .to([0.7, 1.7], 1.2)
        .to([0.3, 4.2], 2.1)
        .to([-0.2, 4.9], 1.0)
        .stays(0.4)
        .faces(35.0)
        .stays(0.6)
        .faces(-50.0)
        .stays(1.6)
        .faces(20.0)
        .stays(0.6)
        .to([0.1, 8.0], 1.3);
    let grown_up = Actor::new(0, [0.0, 0.9], AWAY).to([0.0, 2.2], 1.15).to([0.35, 4.6], 0.75).to([0.7, 8.0], 1.15);
    Scene::new(
        "child_runs_ahead",
        "a child runs ahead",
        "a child runs ahead, turns round and waits for the grown-up, who follows slowly",
        8.2,
        vec![child, grown_up],
    )
}

fn walks_and_lingers() -> Scene {
    let one = Actor::new(0, [-0.9, 2.8], TOWARDS)
        .to([-0.95, 1.7], 1.1)
        .stays(0.5)
        .faces(-60.0)
        .stays(1.8)
        .faces(TOWARDS)
        .to([-0.8, 0.4], 1.2)
        .to([-0.55, -1.2], 1.4)
        .to([-0.6, -4.6], 1.5);
    let other = Actor::new(0, [-0.1, 2.8], TOWARDS)
        .to([-0.25, 1.9], 1.1)
        .to([-0.75, 0.9], 0.9)
        .to([-1.2, -0.8], 0.75)
        .faces(180.0)
        .stays(0.6)
        .faces(120.0)
        .stays(0.9)
        .faces(180.0)
        .stays(0.5)
        .to([-1.3, -3.6], 1.0);
    Scene::new(
        "pair_lingers",
        "one of two lingers",
        "one of two stops to look at the viewer, the other goes on slowly, looks back and is caught up",
        7.4,
        vec![one, other],
    )
}

fn three_part() -> Scene {
    let at = |x: f64, side: f64, late: f64| {
        Actor::new(0, [x, 2.5 + late], TOWARDS)
            .to([x, 1.5], 1.2)
            .to([side, 0.4], 1.1)
            .to([side * 0.95, -0.7], 1.1)
            .to([x, -3.4], WALK)
    };
    let actors = vec![at(-0.75, -0.9, 0.1), at(0.0, 0.62, 0.4), at(0.75, 1.25, 0.05)];
    Scene::new(
        "three_part",
        "three part around the viewer",
        "three who come abreast give way to the viewer, one to the left, two to the right",
        5.4,
        actors,
    )
}

fn three_look_at_a_map() -> Scene {
    let middle = [0.1, 3.1];
    let at = |from: [f64; 2], to: [f64; 2], leaves_s: f64| {
        let beyond = [to[0] * 0.8, 8.6];
        let actor = Actor::new(0, from, AWAY).to([from[0], from[1] + 0.8], 1.2).to(to, 0.8).stays(0.3).looks_at(middle);
        let stays = leaves_s - actor.ends_s();
        actor.stays(stays).faces(AWAY).stays(0.3).to(beyond, 1.25)
    };
    let actors =
        vec![at([-0.8, 1.0], [-0.55, 2.9], 6.4), at([0.0, 0.8], [0.15, 2.4], 7.2), at([0.8, 1.1], [0.75, 3.2], 6.7)];
    Scene::new(
        "three_map",
        "three look at a map",
        "three who walk away stop, gather around a map, and go on",
        11.0,
        actors,
    )
}

pub fn family() -> Scene {
    let mother = Actor::new(0, [-0.6, 2.4], TOWARDS).to([-0.8, 1.2], 1.0).to([-0.95, 0.0], 0.9).to([-0.6, -3.4], 1.1);
    let child = Actor::new(0, [-0.1, 2.0], TOWARDS)
        .to([-0.1, 1.6], 1.0)
        .to([0.1, 1.1], 0.5)
        .stays(1.3)
        .to([0.55, 0.5], 1.0)
        .to([0.6, -0.8], 1.6)
        .to([0.2, -3.2], 1.5);
    let father = Actor::new(0, [0.5, 2.5], TOWARDS)
        .to([0.75, 1.7], 1.0)
        .to([0.95, 1.2], 0.5)
        .faces(-120.0)
        .stays(1.2)
        .to([1.15, 0.2], 0.9)
        .to([0.7, -3.4], 1.2);
    let second = Actor::new(0, [0.3, 2.95], TOWARDS)
        .to([0.3, 2.3], 1.0)
        .stays(2.9)
        .to([1.1, 0.6], 1.2)
        .to([1.2, -0.6], 1.3)
        .to([0.5, -2.2], 1.4)
        .to([0.4, -4.2], 1.2);
    Scene::new(
        "family",
        "a family of four",
        "a child stops to stare at the viewer, the family waits and goes round on both sides",
        6.6,
        vec![mother, child, father, second],
    )
}

/// Four who walk away, two and two; those behind fall back and catch up.
fn four_stroll() -> Scene {
    let ahead = |x: f64| Actor::new(0, [x, 1.7], AWAY).to([x, 2.6], 1.1).to([x * 1.2, 4.6], 1.0).to([x, 8.4], 1.2);
    let left = Actor::new(0, [-0.4, 0.7], AWAY)
        .to([-0.45, 1.5], 1.1)
        .stays(0.4)
        .faces(45.0)
        .stays(1.3)
        .faces(AWAY)
        .to([-0.5, 3.2], 1.2)
        .to([-0.4, 7.4], 1.5);
    let right = Actor::new(0, [0.4, 0.7], AWAY)
        .to([0.45, 1.3], 1.0)
        .faces(150.0)
        .stays(0.3)
        .stays(1.8)
        .faces(AWAY)
        .to([0.5, 3.0], 1.2)
        .to([0.45, 7.2], 1.5);
    Scene::new(
        "four_stroll",
        "two of four fall back",
        "four walk away two and two, the second pair stops to talk and hurries after the first",
        6.4,
        vec![ahead(-0.4), ahead(0.4), left, right],
    )
}
