use super::super::actor::{AWAY, Actor, LEFT, RIGHT, Scene, TOWARDS, WALK};

/// Scenes of one person in front.
pub fn scenes() -> Vec<Scene> {
    vec![late_notice(), phone(), shoe(), turns_back(), crosses(), looks_around(), runs(), lost()]
}

fn late_notice() -> Scene {
    let actor = Actor::new(0, [0.1, 2.8], TOWARDS)
        .to([0.08, 1.55], 1.3)
        // The eyes come up from the floor: a short step, a halt, and past.
        .glides([0.1, 1.2], 0.6)
        .glides([0.62, 1.0], 0.7)
        .to([0.82, 0.1], 0.9)
        .to([0.55, -3.0], WALK);
    Scene::new(
        "late_notice",
        "notices the viewer late",
        "somebody comes straight on, notices the viewer at the last moment, halts and steps aside",
        6.4,
        vec![actor],
    )
}

fn phone() -> Scene {
    let actor = Actor::new(0, [0.6, 2.8], TOWARDS)
        .to([0.8, 2.2], 1.2)
        .to([0.9, 1.7], 0.7)
        .stays(1.4)
        .faces(-115.0)
        .stays(2.6)
        .faces(-70.0)
        .stays(0.8)
        .to([0.85, 0.4], 0.9)
        .to([0.7, -3.0], 1.3);
    Scene::new(
        "phone",
        "stops at the phone",
        "somebody slows down, stops to read a message, and walks on",
        9.6,
        vec![actor],
    )
}

fn shoe() -> Scene {
    let actor = Actor::new(0, [0.5, 0.8], AWAY)
        .to([0.6, 2.2], 1.25)
        .to([0.95, 2.9], 0.8)
        .stays(0.6)
        .faces(65.0)
        .stays(4.2)
        .faces(AWAY)
        .stays(0.7)
        .to([0.8, 6.9], 1.35);
    Scene::new(
        "shoe",
        "ties a shoe",
        "somebody who walks away goes to the side, kneels down to tie a shoe, and walks on",
        10.4,
        vec![actor],
    )
}

fn turns_back() -> Scene {
    let actor = Actor::new(0, [-0.4, 0.9], AWAY)
        .to([-0.45, 3.0], 1.25)
        .to([-0.5, 3.5], 0.6)
        .stays(0.9)
        .faces(RIGHT)
        .stays(0.9)
        .faces(TOWARDS)
        .stays(0.5)
        .to([-0.75, 1.0], 1.3)
        .to([-0.8, -3.0], 1.5);
    Scene::new(
        "turns_back",
        "turns back",
        "somebody who walks away stops, remembers something, and hurries back past the viewer",
        9.4,
        vec![actor],
    )
}

fn crosses() -> Scene {
    let actor = Actor::new(0, [-1.3, 2.0], RIGHT)
        .to([-0.5, 1.9], 1.2)
        .to([0.0, 1.9], 0.6)
        .stays(0.5)
        .faces(-60.0)
        .stays(1.6)
        .faces(20.0)
        .stays(0.5)
        .to([1.4, 2.3], 1.1)
        .to([3.0, 2.6], WALK);
    Scene::new(
        "crosses",
        "crosses and looks",
        "somebody crosses in front, stops for a look at the viewer, and goes on",
        6.8,
        vec![actor],
    )
}

fn looks_around() -> Scene {
    let actor = Actor::new(0, [-0.5, 2.9], TOWARDS)
        .to([-0.7, 2.1], 1.0)
        .stays(0.5)
        .faces(-150.0)
        .stays(1.3)
        .faces(-40.0)
        .stays(1.4)
        .faces(TOWARDS)
        .stays(0.4)
        .to([-0.9, 0.5], 1.1)
        .to([-0.7, -3.0], 1.3);
    Scene::new(
        "looks_around",
        "looks around",
        "somebody stops, looks to one side and the other, and walks on past the viewer",
        8.4,
        vec![actor],
    )
}

fn runs() -> Scene {
    let actor = Actor::new(0, [0.7, 0.5], AWAY)
        .to([0.6, 1.5], 1.4)
        .to([0.1, 3.4], 2.2)
        .to([-0.4, 5.2], 2.4)
        .to([-0.3, 8.2], 2.4);
    Scene::new("runs", "runs for it", "somebody who walks away breaks into a run, swerving", 4.0, vec![actor])
}

fn lost() -> Scene {
    let actor = Actor::new(0, [1.3, 1.6], LEFT)
        .to([0.5, 1.7], 1.1)
        .to([0.1, 1.75], 0.5)
        .stays(0.8)
        .faces(110.0)
        .stays(1.2)
        .to([-0.1, 2.9], 0.8)
        .stays(0.9)
        .faces(LEFT)
        .stays(0.7)
        .to([-1.4, 3.1], 1.0)
        .to([-3.0, 3.1], WALK);
    Scene::new(
        "lost",
        "has lost the way",
        "somebody crosses, hesitates, tries another direction, and goes on as before",
        10.2,
        vec![actor],
    )
}
