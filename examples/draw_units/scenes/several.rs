use super::super::actor::{AWAY, Actor, RIGHT, Scene, TOWARDS, WALK};

/// Scenes of people in front who do not all belong together.
pub fn scenes() -> Vec<Scene> {
    let mut scenes = vec![
        greet(),
        lets_pass(),
        overtakes_towards(),
        overtakes_away(),
        yields_to_who_crosses(),
        pair_opens(),
        passes_a_pair(),
        pair_talks_in_the_way(),
        away_past_a_pair(),
    ];
    let extra = [
        greet().with(
            "passed",
            "and somebody passes",
            "a third walks round the two",
            vec![passer(2, [-1.3, 1.2], AWAY)],
        ),
        lets_pass().with(
            "met",
            "and somebody comes",
            "a third comes on the other side",
            vec![passer(2, [1.3, 2.9], TOWARDS)],
        ),
        overtakes_towards().with(
            "met",
            "and somebody goes",
            "a third goes the other way",
            vec![passer(2, [1.3, 0.7], AWAY)],
        ),
        overtakes_away().with(
            "third",
            "and somebody follows",
            "a third goes the same way",
            vec![passer(2, [1.35, 0.4], AWAY)],
        ),
    ];
    scenes.extend(extra);
    scenes.extend([two_pairs(), pair_and_two(), three_and_one(), three_meet_one(), all_towards()]);
    scenes.extend([two_pairs_and_one(), family_and_one(), crowd_of_six()]);
    scenes
}

/// Somebody who walks by at the side, slower for a moment.
pub fn passer(group: u32, [x, y]: [f64; 2], facing: f64) -> Actor {
    let along = if facing == AWAY { 1.0 } else { -1.0 };
    Actor::new(group, [x, y], facing)
        .to([x, y + 1.2 * along], 1.2)
        .to([x * 1.02, y + 2.4 * along], 0.85)
        .to([x, y + 14.0 * along], WALK)
}

fn greet() -> Scene {
    let comes = Actor::new(0, [-0.35, 2.9], TOWARDS)
        .to([-0.2, 2.5], 1.1)
        .to([-0.1, 2.2], 0.6)
        .stays(0.3)
        .faces(-75.0)
        .stays(3.0)
        .faces(-120.0)
        .to([-0.85, 1.0], 1.1)
        .to([-0.8, -3.0], 1.3);
    let goes = Actor::new(1, [0.45, 0.5], AWAY)
        .to([0.25, 1.1], 1.1)
        .to([0.1, 1.35], 0.6)
        .stays(0.3)
        .faces(100.0)
        .stays(3.3)
        .faces(50.0)
        .to([0.7, 2.5], 1.1)
        .to([0.5, 7.0], 1.3);
    Scene::new(
        "greet",
        "two greet each other",
        "two who come towards each other stop, shake hands, talk, and part",
        8.6,
        vec![comes, goes],
    )
}

fn lets_pass() -> Scene {
    let comes = Actor::new(0, [0.1, 2.9], TOWARDS)
        .to([0.1, 2.4], 1.1)
        .glides([-0.2, 2.15], 0.5)
        .stays(0.5)
        .glides([0.5, 2.1], 0.55)
        .stays(0.4)
        .to([0.75, 0.5], 1.0)
        .to([0.7, -3.0], WALK);
    let goes = Actor::new(1, [-0.3, 0.6], AWAY)
        .to([-0.1, 1.2], 1.1)
        .glides([-0.25, 1.35], 0.4)
        .stays(1.0)
        .glides([-0.55, 1.6], 0.5)
        .to([-0.7, 2.6], 1.0)
        .to([-0.4, 6.9], WALK);
    Scene::new(
        "lets_pass",
        "two step to the same side",
        "two meet head on, step to the same side, and laugh it off",
        7.0,
        vec![comes, goes],
    )
}

fn overtakes_towards() -> Scene {
    let slow = Actor::new(0, [0.6, 2.0], TOWARDS).to([0.75, 0.9], 0.95).to([0.8, -0.4], 0.8).to([0.7, -4.0], 0.95);
    let quick = Actor::new(1, [0.2, 2.95], TOWARDS)
        .to([-0.3, 2.0], 1.35)
        .to([-0.75, 0.7], 1.5)
        .to([-0.7, -0.6], 1.6)
        .to([0.1, -2.5], 1.6)
        .to([0.1, -5.0], 1.5);
    Scene::new(
        "overtakes_towards",
        "overtakes before the viewer",
        "somebody in a hurry passes a slow one, and the viewer on the other side",
        5.0,
        vec![slow, quick],
    )
}

fn overtakes_away() -> Scene {
    let slow = Actor::new(0, [0.2, 1.7], AWAY).to([0.2, 2.8], 1.0).to([0.5, 4.4], 0.7).to([0.5, 7.0], 0.95);
    let quick = Actor::new(1, [0.3, 0.6], AWAY)
        .to([0.2, 1.3], 1.4)
        .to([-0.6, 2.8], 1.55)
        .to([-0.65, 4.4], 1.7)
        .to([0.0, 6.0], 1.6)
        .to([0.1, 9.0], 1.5);
    Scene::new(
        "overtakes_away",
        "overtakes in front",
        "somebody in a hurry swerves round a slow one",
        5.4,
        vec![slow, quick],
    )
}

fn yields_to_who_crosses() -> Scene {
    let comes = Actor::new(0, [0.5, 2.9], TOWARDS)
        .to([0.5, 2.5], 1.1)
        .to([0.5, 2.3], 0.4)
        .stays(1.2)
        .to([0.75, 0.4], 1.1)
        .to([0.6, -3.0], WALK);
    let crosses = Actor::new(1, [-1.3, 1.2], RIGHT).to([0.2, 1.35], 1.15).to([0.9, 1.4], 1.4).to([4.0, 1.6], 1.3);
    Scene::new(
        "yields",
        "lets somebody cross",
        "somebody waits for another who crosses in front",
        5.2,
        vec![comes, crosses],
    )
}

/// A pair that comes, and one who goes: they open up for the other.
fn pair_opens() -> Scene {
    let left = Actor::new(0, [-0.45, 2.8], TOWARDS)
        .to([-0.5, 2.4], 1.1)
        .to([-1.0, 1.5], 0.9)
        .to([-0.9, 0.4], 1.1)
        .to([-0.8, -3.0], WALK);
    let right = Actor::new(0, [0.35, 2.8], TOWARDS)
        .to([0.45, 2.4], 1.1)
        .to([0.8, 1.6], 0.85)
        .to([0.85, 0.4], 1.1)
        .to([0.7, -3.0], WALK);
    let goes = Actor::new(1, [-0.3, 0.7], AWAY).to([-0.15, 1.3], 0.9).to([-0.1, 2.3], 1.0).to([0.1, 7.0], 1.3);
    Scene::new(
        "pair_opens",
        "a pair opens for somebody",
        "two who come make room for one who goes between them",
        5.4,
        vec![left, right, goes],
    )
}

fn passes_a_pair() -> Scene {
    let one = Actor::new(0, [0.3, 1.9], TOWARDS).to([0.5, 1.1], 1.0).to([0.65, 0.0], 0.9).to([0.5, -4.0], 1.0);
    let other = Actor::new(0, [1.05, 1.9], TOWARDS).to([1.2, 1.0], 1.0).to([1.35, 0.0], 0.9).to([1.2, -4.0], 1.0);
    let quick = Actor::new(1, [0.2, 2.95], TOWARDS)
        .to([-0.4, 1.9], 1.35)
        .to([-0.75, 0.5], 1.5)
        .to([-0.7, -0.6], 1.55)
        .to([-0.2, -5.0], 1.5);
    Scene::new(
        "passes_pair",
        "overtakes a pair",
        "two stroll towards the viewer, a third overtakes them on the other side",
        5.0,
        vec![one, other, quick],
    )
}

fn pair_talks_in_the_way() -> Scene {
    let one = Actor::new(0, [-0.2, 0.9], AWAY)
        .to([-0.2, 1.6], 1.1)
        .to([-0.35, 2.1], 0.6)
        .stays(0.3)
        .looks_at([0.4, 2.3])
        .stays(3.2)
        .faces(AWAY)
        .to([-0.2, 7.0], 1.2);
    let other = Actor::new(0, [0.6, 1.0], AWAY)
        .to([0.55, 1.7], 1.1)
        .to([0.45, 2.3], 0.7)
        .faces(140.0)
        .stays(0.5)
        .looks_at([-0.35, 2.1])
        .stays(3.3)
        .faces(AWAY)
        .to([0.5, 7.2], 1.2);
    let comes = Actor::new(1, [-0.8, 2.9], TOWARDS)
        .to([-1.0, 2.3], 1.0)
        .to([-1.2, 1.5], 0.7)
        .to([-0.9, 0.3], 1.1)
        .to([-0.7, -3.0], 1.3);
    Scene::new(
        "pair_in_the_way",
        "a pair talks in the way",
        "two stop in the middle to talk, somebody who comes squeezes past",
        9.0,
        vec![one, other, comes],
    )
}

fn away_past_a_pair() -> Scene {
    let one = Actor::new(0, [-0.1, 1.6], AWAY).to([-0.1, 2.6], 1.05).to([-0.2, 4.4], 0.8).to([-0.2, 7.5], 1.0);
    let other = Actor::new(0, [0.65, 1.6], AWAY)
        .to([0.65, 2.5], 1.05)
        .to([0.6, 3.4], 0.75)
        .faces(150.0)
        .glides([0.55, 4.3], 0.75)
        .faces(AWAY)
        .glides([0.55, 7.5], 1.0);
    let quick = Actor::new(1, [-0.15, 0.6], AWAY)
        .to([-0.4, 1.3], 1.4)
        .to([-0.95, 2.8], 1.5)
        .to([-0.9, 4.6], 1.6)
        .to([-0.3, 9.0], 1.5);
    Scene::new(
        "past_a_pair",
        "goes past a pair",
        "two chat while they walk away, somebody in a hurry goes past",
        5.6,
        vec![one, other, quick],
    )
}

fn two_pairs() -> Scene {
    let comes = |x: f64, to: f64, out: f64| {
        Actor::new(0, [x, 2.8], TOWARDS).to([to, 2.3], 0.9).stays(3.2).to([out, 1.2], 1.0).to([out, -3.0], 1.2)
    };
    let goes = |x: f64, to: f64, out: f64| {
        Actor::new(1, [x, 0.6], AWAY).to([to, 1.3], 0.9).stays(3.4).to([out, 2.6], 1.0).to([out * 0.8, 7.5], 1.2)
    };
    let actors = vec![comes(-0.75, -0.7, -1.25), comes(0.0, -0.05, -0.65), goes(0.1, 0.2, 0.6), goes(0.8, 0.9, 1.25)];
    Scene::new(
        "two_pairs",
        "two pairs meet",
        "two pairs meet, greet each other, and go on past each other",
        9.0,
        actors,
    )
}

fn pair_and_two() -> Scene {
    pair_opens().with(
        "and_one",
        "and one comes behind",
        "a third comes behind them",
        vec![Actor::new(2, [1.35, 2.95], TOWARDS).to([1.4, 2.3], 1.0).to([1.42, 1.4], 0.8).to([1.35, -4.0], 1.2)],
    )
}

fn three_and_one() -> Scene {
    let at = |x: f64, out: f64, start: f64| {
        Actor::new(0, [x, start], TOWARDS)
            .to([x, start - 0.5], 1.1)
            .to([out, 0.9], 0.95)
            .to([out, -0.6], 1.1)
            .to([x, -3.6], 1.2)
    };
    let goes = Actor::new(1, [-0.7, 0.5], AWAY).to([-1.1, 1.6], 0.9).to([-1.15, 2.6], 1.0).to([-0.5, 7.0], 1.3);
    Scene::new(
        "three_and_one",
        "three meet one",
        "three come abreast and close up on one side for one who goes",
        5.6,
        vec![at(-0.2, 0.55, 2.9), at(0.5, 1.0, 2.5), at(1.15, 1.5, 2.8), goes],
    )
}

fn three_meet_one() -> Scene {
    let at = |x: f64, out: f64, start: f64| {
        Actor::new(0, [x, start], AWAY).to([x, start + 0.6], 1.1).to([out, start + 2.0], 0.95).to([out * 0.9, 8.0], 1.2)
    };
    let comes = Actor::new(1, [-0.6, 2.95], TOWARDS)
        .to([-0.85, 2.3], 1.0)
        .to([-1.1, 1.3], 0.9)
        .to([-0.8, 0.2], 1.1)
        .to([-0.7, -3.0], 1.3);
    Scene::new(
        "three_go",
        "one meets three",
        "three who walk away draw aside for one who comes",
        5.6,
        vec![at(-0.3, 0.05, 0.9), at(0.4, 0.65, 0.7), at(1.05, 1.25, 1.0), comes],
    )
}

/// Three strangers, all towards the viewer.
fn all_towards() -> Scene {
    let first = Actor::new(0, [0.4, 1.6], TOWARDS).to([0.7, 0.8], 1.1).to([0.8, -0.3], 1.0).to([0.5, -4.0], 1.2);
    let second = Actor::new(1, [-0.7, 2.2], TOWARDS)
        .to([-0.8, 1.6], 1.0)
        .stays(0.4)
        .faces(-60.0)
        .stays(1.5)
        .to([-0.85, 0.3], 1.1)
        .to([-0.6, -3.0], 1.3);
    let third = Actor::new(2, [0.2, 2.95], TOWARDS)
        .to([0.25, 1.8], 1.2)
        .to([0.62, 0.6], 1.0)
        .to([0.75, -0.5], 1.2)
        .to([0.2, -4.0], 1.35);
    Scene::new(
        "three_strangers",
        "three strangers come",
        "three come one after the other, one stops for a look",
        6.4,
        vec![first, second, third],
    )
}

/// Five people: two pairs, and somebody who walks by.
fn two_pairs_and_one() -> Scene {
    let comes = Actor::new(3, [1.4, 2.9], TOWARDS).to([1.45, 2.0], 1.0).to([1.5, 0.8], 0.8).to([1.1, -4.0], 1.25);
    two_pairs().with("and_one", "and one comes by", "one comes by on the right", vec![comes])
}

/// Five people: a family, and somebody who goes the other way.
fn family_and_one() -> Scene {
    let goes = Actor::new(9, [-1.3, 0.5], AWAY).to([-1.42, 1.4], 1.0).to([-1.45, 2.4], 0.85).to([-0.9, 7.5], 1.25);
    super::groups::family().with("met", "and one goes by", "one who goes keeps to the side", vec![goes])
}

fn crowd_of_six() -> Scene {
    let goes = Actor::new(3, [-1.25, 0.4], AWAY).to([-1.3, 1.8], 1.1).to([-1.35, 3.4], 0.9).to([-1.1, 8.0], 1.25);
    two_pairs().with(
        "passed",
        "and two pass",
        "one goes by on the left and one comes by on the right",
        vec![goes, Actor::new(4, [1.4, 2.9], TOWARDS).to([1.45, 2.0], 1.0).to([1.5, 0.8], 0.8).to([1.1, -4.0], 1.25)],
    )
}
