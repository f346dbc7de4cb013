//! Arms and shoulders: cloth that rubs. Broad and soft, with the run of the cloth in fine lines along the rub.

use trodden::math::vec2;

use super::Stain;
use super::touch::{Dab, Rub, Wall};

/// The arms, then the shoulders, in the order of `patterns.toml`.
pub fn all() -> Vec<Stain> {
    vec![
        forearm_rub(),
        forearm_long(),
        forearm_lean(),
        elbow_dab(),
        elbow_rub(),
        elbow_slide(),
        sleeve(),
        shoulder_rub(),
        shoulder_pass(),
        shoulder_lean(),
        shoulder_seams(),
        upper_arm(),
        back_lean(),
        shoulder_brush(),
    ]
}

const CLOTH: Wall = Wall { hard: 0.30, stipple: 0.9, seed: 200 };

/// Cloth drawn over the wall.
const RUB: Rub = Rub {
    from: 0.0,
    to: 1.0,
    bend: [0.0; 3],
    half: [1.0; 3],
    strength: 0.4,
    attack: 0.25,
    hold: 0.35,
    soft: 0.95,
    streaks: 0.55,
    streak: 1.2,
    patches: 0.6,
    patch: 4.0,
    seed: 0,
};

/// Something round and clothed, leant against the wall.
const DAB: Dab =
    Dab { middle: vec2(0.0, 0.0), radii: vec2(1.0, 1.0), turned: 0.0, strength: 0.4, soft: 0.95, ragged: 0.3, seed: 0 };

fn rub(from: f64, to: f64, bend: [f64; 3], half: [f64; 3], strength: f64, seed: u64) -> Rub {
    Rub { from, to, bend, half, strength, seed, ..RUB }
}

fn dab(x: f64, y: f64, rx: f64, ry: f64, strength: f64, seed: u64) -> Dab {
    Dab { middle: vec2(x, y), radii: vec2(rx, ry), strength, seed, ..DAB }
}

fn forearm_rub() -> Stain {
    Stain::new("arm_forearm", 30.0, 11.0, CLOTH).rubs([
        rub(1.0, 28.0, [0.5, 0.2, -0.6], [3.2, 4.0, 2.6], 0.34, 301),
        Rub { streak: 0.5, streaks: 0.8, ..rub(2.0, 22.0, [-1.0, -1.2, -1.9], [1.0, 1.6, 0.9], 0.40, 302) },
    ])
}

fn forearm_long() -> Stain {
    Stain::new("arm_forearm_long", 52.0, 12.0, CLOTH).rubs([
        rub(1.0, 50.0, [1.2, 0.0, -1.2], [3.0, 4.4, 3.2], 0.30, 311),
        Rub { hold: 0.2, streaks: 0.8, streak: 0.6, ..rub(2.0, 34.0, [1.8, 1.0, -0.2], [1.2, 1.5, 0.8], 0.32, 312) },
        Rub { hold: 0.2, streaks: 0.9, streak: 0.4, ..rub(3.0, 43.0, [-1.2, -1.8, -2.6], [0.8, 1.2, 0.7], 0.36, 313) },
    ])
}

/// A forearm laid on the wall while its owner waits.
fn forearm_lean() -> Stain {
    Stain::new("arm_forearm_lean", 29.0, 11.0, CLOTH).dabs([
        Dab { turned: 0.08, ..dab(9.0, -0.6, 7.5, 3.0, 0.30, 321) },
        Dab { turned: 0.04, ..dab(17.5, 0.2, 8.0, 2.6, 0.26, 322) },
        dab(5.2, -1.0, 3.2, 3.0, 0.42, 323),
        Dab { turned: 0.06, ..dab(14.0, 0.0, 12.5, 4.4, 0.14, 324) },
    ])
}

fn elbow_dab() -> Stain {
    Stain::new("arm_elbow", 8.5, 7.5, CLOTH).dabs([
        dab(3.8, 0.2, 2.1, 1.9, 0.55, 331),
        dab(4.3, -0.1, 3.3, 2.9, 0.28, 332),
        dab(5.6, 0.5, 1.5, 1.2, 0.25, 333),
    ])
}

fn elbow_rub() -> Stain {
    Stain::new("arm_elbow_rub", 19.0, 8.0, CLOTH).dabs([dab(4.2, 0.3, 2.5, 2.3, 0.40, 341)]).rubs([
        Rub { attack: 0.12, ..rub(1.5, 18.0, [0.4, 0.0, -0.7], [2.2, 2.7, 1.2], 0.36, 342) },
        Rub { streaks: 0.85, streak: 0.35, ..rub(2.5, 15.0, [0.9, 0.6, -0.2], [0.7, 0.9, 0.4], 0.45, 343) },
    ])
}

fn elbow_slide() -> Stain {
    let line = |from, to, y: f64, half: f64, strength, seed| Rub {
        attack: 0.08,
        hold: 0.25,
        streaks: 0.9,
        streak: 0.4,
        ..rub(from, to, [y + 0.3, y, y - 0.6], [0.7 * half, half, 0.5 * half], strength, seed)
    };
    Stain::new("arm_elbow_slide", 36.0, 7.5, CLOTH).rubs([
        rub(1.0, 33.0, [0.2, 0.0, -0.5], [2.0, 2.9, 1.7], 0.20, 351),
        line(1.5, 34.5, 0.8, 0.9, 0.42, 352),
        line(3.0, 24.0, -0.6, 0.7, 0.46, 353),
        line(6.0, 19.0, 1.8, 0.5, 0.26, 354),
    ])
}

/// A coat's sleeve: hardly more than its folds.
fn sleeve() -> Stain {
    let fold = |from, to, y: f64, half, strength, seed| Rub {
        streaks: 0.8,
        streak: 0.5,
        hold: 0.3,
        ..rub(from, to, [y + 0.6, y, y - 0.8], [0.6 * half, half, 0.6 * half], strength, seed)
    };
    Stain::new("arm_sleeve", 40.0, 15.0, CLOTH).rubs([
        rub(1.0, 38.0, [0.6, 0.0, -0.8], [4.4, 6.0, 4.4], 0.18, 361),
        fold(2.0, 31.0, 3.2, 1.1, 0.34, 362),
        fold(5.0, 37.0, 0.4, 0.8, 0.22, 363),
        fold(1.5, 26.0, -2.4, 1.3, 0.38, 364),
    ])
}

fn shoulder_rub() -> Stain {
    Stain::new("shoulder_rub", 32.0, 22.0, CLOTH).rubs([
        Rub { patch: 6.0, streak: 2.2, ..rub(1.0, 30.0, [0.6, 0.0, -1.0], [6.5, 9.0, 6.5], 0.30, 401) },
        Rub { streak: 1.4, ..rub(3.0, 24.0, [2.6, 2.2, 1.2], [2.4, 3.4, 2.0], 0.32, 402) },
        Rub { streaks: 0.8, streak: 0.6, ..rub(4.0, 27.0, [-3.0, -3.6, -4.2], [1.2, 1.8, 1.0], 0.22, 403) },
    ])
}

fn shoulder_pass() -> Stain {
    Stain::new("shoulder_pass", 56.0, 17.0, CLOTH).rubs([
        Rub { patch: 7.0, streak: 1.8, attack: 0.2, ..rub(1.0, 54.0, [1.0, 0.0, -1.2], [5.0, 7.0, 4.8], 0.26, 411) },
        Rub { streaks: 0.75, streak: 0.8, hold: 0.2, ..rub(3.0, 42.0, [2.4, 1.6, 0.2], [1.8, 2.6, 1.4], 0.34, 412) },
        Rub { streaks: 0.9, streak: 0.5, hold: 0.25, ..rub(9.0, 50.0, [-2.4, -2.8, -3.6], [0.9, 1.3, 0.7], 0.26, 413) },
    ])
}

/// Somebody who leans and waits: no way of its own, many small shifts over each other.
fn shoulder_lean() -> Stain {
    Stain::new("shoulder_lean", 24.0, 27.0, CLOTH).dabs([
        Dab { turned: 0.15, ..dab(12.0, 3.4, 6.6, 6.6, 0.30, 421) },
        Dab { turned: -0.10, ..dab(11.2, -4.4, 5.0, 7.4, 0.20, 422) },
        dab(13.2, 4.8, 3.6, 3.2, 0.34, 423),
        dab(9.6, 1.0, 4.4, 5.2, 0.16, 424),
        dab(12.0, 0.0, 9.8, 11.8, 0.10, 425),
    ])
}

/// A jacket whose seams press harder than its cloth.
fn shoulder_seams() -> Stain {
    let seam = |from, to, y: f64, strength, seed| Rub {
        streaks: 0.85,
        streak: 0.30,
        soft: 0.7,
        hold: 0.3,
        attack: 0.08,
        ..rub(from, to, [y + 0.4, y, y - 0.7], [0.35, 0.55, 0.3], strength, seed)
    };
    Stain::new("shoulder_seams", 38.0, 19.0, CLOTH).rubs([
        Rub { patch: 5.0, streak: 1.6, ..rub(1.0, 36.0, [0.8, 0.0, -0.8], [6.0, 8.0, 5.4], 0.24, 431) },
        seam(2.5, 33.0, 3.8, 0.55, 432),
        seam(4.0, 25.0, 2.6, 0.35, 433),
        seam(3.0, 35.0, -2.2, 0.42, 434),
    ])
}

fn upper_arm() -> Stain {
    Stain::new("shoulder_upper_arm", 26.0, 25.0, CLOTH).rubs([
        Rub { patch: 5.0, streak: 2.0, ..rub(1.5, 23.0, [3.6, 3.2, 2.4], [4.6, 6.2, 4.4], 0.30, 441) },
        Rub { patch: 5.0, streak: 2.4, ..rub(2.5, 24.5, [-3.6, -4.2, -4.8], [4.2, 5.6, 3.8], 0.22, 442) },
        Rub { streaks: 0.8, streak: 0.7, ..rub(3.5, 20.0, [5.4, 5.0, 4.2], [1.4, 2.0, 1.2], 0.26, 443) },
    ])
}

/// A back against the wall, one shoulder harder than the other.
fn back_lean() -> Stain {
    Stain::new("shoulder_back", 40.0, 28.0, CLOTH).dabs([
        Dab { turned: 0.2, ..dab(10.5, 3.6, 7.4, 6.4, 0.32, 451) },
        Dab { turned: -0.2, ..dab(29.5, 3.0, 7.0, 6.0, 0.20, 452) },
        dab(20.0, -3.6, 14.0, 7.6, 0.13, 453),
        dab(9.4, 5.0, 3.8, 3.2, 0.28, 454),
        dab(20.0, 0.4, 17.5, 11.8, 0.09, 455),
    ])
}

/// No more than a touch in passing.
fn shoulder_brush() -> Stain {
    Stain::new("shoulder_brush", 30.0, 13.0, Wall { hard: 0.55, ..CLOTH }).rubs([
        Rub {
            patches: 0.9,
            patch: 3.4,
            streaks: 0.8,
            streak: 0.9,
            ..rub(1.0, 28.5, [0.6, 0.0, -0.7], [3.4, 5.4, 3.0], 0.26, 461)
        },
        Rub { streaks: 0.9, streak: 0.4, ..rub(6.0, 23.0, [1.0, 0.8, 0.2], [0.9, 1.5, 0.8], 0.34, 462) },
    ])
}
