//! Hands: skin grease with the dust that it holds. Mostly clouds, since nobody touches the same place the same way twice.

use trodden::math::{Vec2, sin_cos, vec2};

use super::super::noise::hash;
use super::Stain;
use super::touch::{Dab, Rub, Wall};

/// The hands, in the order of `patterns.toml`.
pub fn all() -> Vec<Stain> {
    vec![
        cloud("hand_cloud", vec2(16.0, 17.0), 1, 7, 3.4),
        cloud("hand_push", vec2(13.0, 13.5), 2, 3, 1.8),
        cloud("hand_lean", vec2(15.0, 20.0), 3, 4, 2.4),
        smudge(),
        heel_of_hand(),
        print(),
        fingers("hand_drag_four", 42.0, 4, 11),
        fingers("hand_drag_three", 30.0, 3, 12),
        fingers("hand_drag_two", 34.0, 2, 13),
        drag_palm(),
        drag_back(),
        tips("hand_tips_four", 4, 0.3, 21),
        tips("hand_tips_two", 2, 0.2, 22),
        tips("hand_tips_slip", 3, 2.6, 23),
    ]
}

const SKIN: Wall = Wall { hard: 0.15, stipple: 0.8, seed: 100 };

/// A hand laid on the wall with its fingers up.
struct Hand {
    /// Middle of the palm.
    at: Vec2,
    turned: f64,
    /// How much palm and fingers leave.
    palm: f64,
    fingers: f64,
    /// How soft it is, and how much larger its parts are for that.
    soft: f64,
    swell: f64,
    seed: u64,
}

impl Hand {
    fn dabs(&self) -> Vec<Dab> {
        let mut dabs = Vec::new();
        let (s, c) = sin_cos(self.turned);
        let mut add = |at: Vec2, radii: Vec2, turned: f64, strength: f64| {
            dabs.push(Dab {
                middle: self.at + at.rotated(vec2(c, s)),
                radii: radii * self.swell,
                turned: self.turned + turned,
                strength,
                soft: self.soft,
                ragged: 0.14,
                seed: self.seed.wrapping_mul(131).wrapping_add(7 * dabs.len() as u64),
            });
        };
        // The ball of the thumb, the other edge of the hand, the pads below the fingers.
        add(vec2(-2.2, -1.7), vec2(1.9, 3.0), -0.35, self.palm);
        add(vec2(2.2, -1.4), vec2(1.7, 3.4), 0.12, 0.9 * self.palm);
        add(vec2(-1.9, 3.0), vec2(1.9, 1.25), 0.12, 0.8 * self.palm);
        add(vec2(1.6, 2.8), vec2(2.0, 1.25), -0.18, 0.85 * self.palm);
        // The hollow of the hand touches least.
        add(vec2(0.0, -0.2), vec2(3.9, 4.6), 0.0, 0.32 * self.palm);
        if self.fingers > 0.0 {
            for (x, length, lean) in [(-3.0, 6.8, 0.13), (-1.0, 7.6, 0.02), (1.1, 7.0, -0.08), (3.0, 5.5, -0.24)] {
                let (s, c) = sin_cos(lean);
                for (share, strength) in [(0.22, 0.5), (0.54, 0.62), (0.87, 0.9)] {
                    let at = vec2(x - s * length * share, 4.0 + c * length * share);
                    add(at, vec2(0.86, 0.205 * length), lean, strength * self.fingers);
                }
            }
            add(vec2(-4.3, 0.4), vec2(0.95, 1.7), 0.65, 0.55 * self.fingers);
            add(vec2(-5.8, 2.3), vec2(0.95, 1.6), 0.65, 0.9 * self.fingers);
        }
        dabs
    }
}

/// Several hands in nearly the same place, none of them like the other: what is left is a soft cloud.
fn cloud(name: &'static str, size: Vec2, seed: u64, hands: u64, stray: f64) -> Stain {
    let draw = |n: u64, k: i64| hash(n as i64, k, 900 + seed);
    // About normal: the sum of three.
    let normal = |n: u64, k: i64| (draw(n, k) + draw(n, k + 1) + draw(n, k + 2) - 1.5) * 2.0;
    let middle = vec2(0.5 * size.x, if size.y > 18.0 { -0.05 * size.y } else { 0.0 });
    let palms = (0..hands).flat_map(|n| {
        let hand = Hand {
            at: middle + vec2(0.45 * stray * normal(n, 0), 0.45 * stray * normal(n, 3)),
            turned: 0.25 * normal(n, 6),
            palm: 0.75 / hands as f64 * (0.3 + 1.4 * draw(n, 9)),
            fingers: 0.0,
            soft: 1.0,
            swell: 1.1,
            seed: 10 * seed + n,
        };
        hand.dabs()
    });
    // Fingers, tips and edges of hands, too many to tell apart.
    let touches = (0..6 * hands).map(|n| {
        let n = n + 100;
        let upward = if size.y > 18.0 { 0.20 * size.y * draw(n, 10) } else { 0.0 };
        Dab {
            middle: middle + vec2(0.12 * size.x * normal(n, 0), 0.12 * size.y * normal(n, 3) + upward),
            radii: vec2(0.9 + 1.6 * draw(n, 6), 1.1 + 2.2 * draw(n, 7)),
            turned: 0.4 * normal(n, 8),
            strength: 0.8 / hands as f64 * draw(n, 11) * draw(n, 12),
            soft: 1.0,
            ragged: 0.3,
            seed: 1000 * seed + n,
        }
    });
    let haze = Dab {
        middle: vec2(0.5 * size.x, 0.0),
        radii: vec2(0.40 * size.x, 0.40 * size.y),
        turned: 0.0,
        strength: 0.10,
        soft: 1.0,
        ragged: 0.3,
        seed: 50 + seed,
    };
    Stain::new(name, size.x, size.y, SKIN).dabs(palms).dabs(touches).dabs([haze])
}

/// A palm that slid a little as it was set down.
fn smudge() -> Stain {
    let rub = |from: f64, to: f64, y: f64, half: f64, strength: f64, seed: u64| Rub {
        from,
        to,
        bend: [y, y - 0.1, y - 0.5],
        half: [0.8 * half, half, 0.7 * half],
        strength,
        attack: 0.30,
        hold: 0.42,
        soft: 0.95,
        streaks: 0.45,
        streak: 0.7,
        patches: 0.5,
        patch: 2.2,
        seed,
    };
    Stain::new("hand_smudge", 17.0, 12.0, SKIN).rubs([
        rub(1.2, 15.5, -1.8, 3.4, 0.5, 31),
        rub(2.0, 16.0, 2.4, 2.4, 0.42, 32),
        rub(3.0, 13.0, 0.5, 4.6, 0.22, 33),
    ])
}

/// The heel of the hand, as one pushes oneself off.
fn heel_of_hand() -> Stain {
    let dab = |x, y, rx, ry, turned, strength, seed| Dab {
        middle: vec2(x, y),
        radii: vec2(rx, ry),
        turned,
        strength,
        soft: 0.85,
        ragged: 0.25,
        seed,
    };
    Stain::new("hand_heel", 9.0, 7.0, SKIN).dabs([
        dab(3.2, -0.4, 2.1, 2.5, -0.4, 0.55, 41),
        dab(6.0, -0.3, 1.8, 2.6, 0.3, 0.42, 42),
        dab(4.6, -0.9, 3.5, 1.9, 0.0, 0.25, 43),
        dab(4.4, 0.2, 3.9, 2.9, 0.2, 0.12, 44),
    ])
}

/// The rare one in which a hand can be seen.
fn print() -> Stain {
    let hand = Hand { at: vec2(7.0, -4.6), turned: -0.12, palm: 0.55, fingers: 0.75, soft: 0.7, swell: 1.0, seed: 9 };
    let haze = Dab {
        middle: vec2(6.6, -3.0),
        radii: vec2(4.2, 5.6),
        turned: 0.0,
        strength: 0.14,
        soft: 1.0,
        ragged: 0.3,
        seed: 61,
    };
    Stain::new("hand_print", 13.5, 20.0, SKIN).dabs(hand.dabs()).dabs([haze])
}

/// Finger tips that run along the wall: streaks of unequal strength, one of them often hardly there.
fn fingers(name: &'static str, length: f64, count: u64, seed: u64) -> Stain {
    let breadth = 2.1 * count as f64 + 2.4;
    let draw = |n: u64, k: i64| hash(n as i64, k, 700 + seed);
    let drop = 0.05 * length;
    let rubs = (0..count).flat_map(|n| {
        let y = 2.0 * (n as f64 - (count - 1) as f64 / 2.0) + 0.5 * (draw(n, 0) - 0.5);
        let from = 1.0 + 2.4 * draw(n, 1) + 0.9 * (n as f64 - 1.4).abs();
        let to = length - 0.5 - 0.35 * length * draw(n, 2);
        let strength = 0.25 + 0.65 * draw(n, 3) * draw(n, 3);
        let half = 0.50 + 0.22 * draw(n, 4);
        let bow = 0.5 * (draw(0, 5) - 0.5);
        let rub = Rub {
            from,
            to,
            bend: [y + 0.3 * drop, y + bow, y - 0.5 * drop * (0.8 + 0.4 * draw(n, 6))],
            half: [0.85 * half, half, 0.75 * half],
            strength,
            attack: 0.03,
            hold: 0.10,
            soft: 0.8,
            streaks: 0.75,
            streak: 0.28,
            patches: 0.6,
            patch: 2.4,
            seed: seed * 40 + n,
        };
        // Beside the ridge that presses, the rest of the finger leaves a haze.
        let haze = Rub {
            half: [1.1, 1.35, 0.9],
            strength: 0.22 * strength,
            soft: 1.0,
            streaks: 0.5,
            streak: 0.7,
            seed: rub.seed + 20,
            ..rub
        };
        [rub, haze]
    });
    Stain::new(name, length, breadth, Wall { hard: 0.3, ..SKIN }).rubs(rubs)
}

/// The flat hand, drawn along the wall.
fn drag_palm() -> Stain {
    let rub = |y: f64, half: f64, from: f64, to: f64, strength: f64, seed: u64| Rub {
        from,
        to,
        bend: [y + 0.6, y + 0.1, y - 1.0],
        half: [0.8 * half, half, 0.75 * half],
        strength,
        attack: 0.10,
        hold: 0.15,
        soft: 0.95,
        streaks: 0.7,
        streak: 0.8,
        patches: 0.85,
        patch: 4.5,
        seed,
    };
    Stain::new("hand_drag_palm", 48.0, 13.0, Wall { hard: 0.25, ..SKIN }).rubs([
        rub(0.0, 4.6, 1.0, 46.0, 0.24, 51),
        rub(2.6, 1.4, 2.0, 35.0, 0.34, 52),
        rub(-2.2, 1.9, 1.5, 43.0, 0.46, 53),
        rub(0.4, 1.0, 4.0, 28.0, 0.22, 54),
    ])
}

/// Knuckles and the back of the hand, light and broken.
fn drag_back() -> Stain {
    let rub = |y: f64, half: f64, from: f64, to: f64, strength: f64, seed: u64| Rub {
        from,
        to,
        bend: [y + 0.4, y - 0.1, y - 0.4],
        half: [0.7 * half, half, 0.5 * half],
        strength,
        attack: 0.12,
        hold: 0.30,
        soft: 0.85,
        streaks: 0.9,
        streak: 0.35,
        patches: 0.9,
        patch: 2.6,
        seed,
    };
    Stain::new("hand_drag_back", 28.0, 9.0, Wall { hard: 0.55, ..SKIN }).rubs([
        rub(0.0, 3.2, 1.0, 27.0, 0.14, 61),
        rub(1.9, 0.8, 1.4, 20.0, 0.40, 62),
        rub(0.1, 0.7, 2.4, 26.0, 0.50, 63),
        rub(-1.7, 0.9, 1.8, 16.0, 0.34, 64),
    ])
}

/// Finger tips set down, with `slip` centimetres of drag.
fn tips(name: &'static str, count: u64, slip: f64, seed: u64) -> Stain {
    let length = 2.1 * count as f64 + 1.6 + slip;
    let draw = |n: u64, k: i64| hash(n as i64, k, 500 + seed);
    let at = |n: u64| {
        let lift = [-0.5, 0.5, 0.3, -0.8][(n % 4) as usize];
        vec2(1.6 + 2.05 * n as f64 + 0.3 * draw(n, 0), lift + 0.3 * draw(n, 1))
    };
    let dabs = (0..count).flat_map(|n| {
        let strength = 0.30 + 0.6 * draw(n, 2);
        let dab = Dab {
            middle: at(n),
            radii: vec2(0.72, 0.95),
            turned: 0.5 * (draw(n, 3) - 0.5),
            strength,
            soft: 0.75,
            ragged: 0.2,
            seed: seed * 30 + n,
        };
        [dab, Dab { radii: vec2(1.3, 1.5), strength: 0.25 * strength, soft: 1.0, seed: dab.seed + 15, ..dab }]
    });
    let rubs = (0..if slip > 1.0 { count } else { 0 }).map(|n| Rub {
        from: at(n).x - 0.3,
        to: at(n).x + slip * (0.7 + 0.5 * draw(n, 4)),
        bend: [at(n).y, at(n).y - 0.1, at(n).y - 0.3],
        half: [0.7, 0.6, 0.4],
        strength: 0.25 + 0.3 * draw(n, 2),
        attack: 0.1,
        hold: 0.2,
        soft: 0.8,
        streaks: 0.8,
        streak: 0.25,
        patches: 0.5,
        patch: 1.0,
        seed: seed * 30 + 20 + n,
    });
    Stain::new(name, length, 5.0, SKIN).dabs(dabs).rubs(rubs)
}
