//! Shoes against the foot of a wall: rubber, black where it pressed, feathered where it left.

use trodden::math::{Vec2, vec2};

use super::super::heel_marks::Stroke;
use super::Stain;
use super::touch::{Dab, Rub, Wall};

/// The shoes, in the order of `patterns.toml`.
pub fn all() -> Vec<Stain> {
    vec![
        toe_kick(),
        toe_scuff(),
        toe_swipe(),
        toe_double(),
        heel_line("shoe_line_long", 19.0, [0.25, 0.0, -0.3], 0.55, 0.40, 721),
        heel_line("shoe_line_short", 8.0, [0.1, 0.15, -0.1], 0.42, 0.35, 722),
        heel_line("shoe_line_bow", 13.0, [-0.6, 0.55, -0.35], 0.62, 0.30, 723),
        sole_edge(),
        sole_ball(),
        sole_tread(),
    ]
}

const RUBBER: Wall = Wall { hard: 0.9, stipple: 1.0, seed: 700 };

const RUB: Rub = Rub {
    from: 0.0,
    to: 1.0,
    bend: [0.0; 3],
    half: [1.0; 3],
    strength: 0.5,
    attack: 0.10,
    hold: 0.20,
    soft: 0.75,
    streaks: 0.9,
    streak: 0.30,
    patches: 0.6,
    patch: 1.2,
    seed: 0,
};

fn rub(from: f64, to: f64, bend: [f64; 3], half: [f64; 3], strength: f64, seed: u64) -> Rub {
    Rub { from, to, bend, half, strength, seed, ..RUB }
}

fn core(from: f64, to: f64, bend: [f64; 3], width: f64, holds: f64, seed: u64) -> Stroke {
    Stroke { from, to, bend, widths: [0.6 * width, width, 0.15 * width], widest: 0.25, holds, seed }
}

fn dab(middle: Vec2, radii: Vec2, strength: f64, seed: u64) -> Dab {
    Dab { middle, radii, turned: 0.0, strength, soft: 0.6, ragged: 0.35, seed }
}

/// A toe that bumped the wall.
fn toe_kick() -> Stain {
    Stain::new("shoe_toe_kick", 3.6, 2.6, RUBBER)
        .dabs([dab(vec2(1.4, 0.1), vec2(0.75, 0.55), 0.7, 701), dab(vec2(1.6, 0.0), vec2(1.2, 0.95), 0.25, 702)])
        .rubs([rub(0.5, 3.2, [0.2, 0.1, -0.2], [0.5, 0.7, 0.4], 0.45, 703)])
        .strokes(1.0, [core(0.4, 3.1, [-0.15, 0.25, 0.1], 0.42, 0.35, 704)])
}

fn toe_scuff() -> Stain {
    Stain::new("shoe_toe_scuff", 6.0, 3.2, RUBBER)
        .rubs([
            rub(0.4, 5.6, [0.2, 0.1, -0.3], [0.8, 1.2, 0.7], 0.38, 711),
            Rub { streak: 0.16, ..rub(0.6, 4.6, [-0.4, -0.4, -0.7], [0.3, 0.5, 0.3], 0.5, 712) },
        ])
        .strokes(
            1.0,
            [
                core(0.5, 5.3, [0.1, 0.45, 0.05], 0.62, 0.30, 713),
                core(0.8, 4.4, [-0.25, -0.15, -0.5], 0.30, 0.20, 714),
                core(1.4, 5.6, [0.8, 0.85, 0.5], 0.16, 0.25, 715),
            ],
        )
}

/// A toe that went along the wall for most of a step.
fn toe_swipe() -> Stain {
    Stain::new("shoe_toe_swipe", 9.0, 3.6, RUBBER)
        .rubs([
            Rub { hold: 0.3, ..rub(0.5, 8.6, [-0.5, 0.1, 0.5], [0.7, 1.2, 0.7], 0.40, 741) },
            Rub { streak: 0.2, ..rub(1.0, 7.0, [-0.9, -0.4, 0.0], [0.4, 0.6, 0.3], 0.5, 742) },
        ])
        .strokes(
            1.0,
            [
                core(0.6, 7.8, [-0.7, 0.35, 0.6], 0.50, 0.35, 743),
                core(1.2, 6.0, [-1.0, -0.35, -0.1], 0.32, 0.25, 744),
                core(2.4, 8.4, [0.1, 0.75, 0.95], 0.14, 0.30, 745),
            ],
        )
}

/// Both sides of a toe cap.
fn toe_double() -> Stain {
    Stain::new("shoe_toe_double", 5.0, 3.4, RUBBER)
        .rubs([
            rub(0.4, 4.4, [0.8, 0.8, 0.5], [0.4, 0.6, 0.3], 0.45, 751),
            rub(0.8, 4.7, [-0.7, -0.8, -1.0], [0.3, 0.5, 0.3], 0.35, 752),
        ])
        .strokes(
            1.0,
            [core(0.4, 4.0, [0.7, 1.0, 0.7], 0.44, 0.35, 753), core(0.9, 4.5, [-0.6, -0.8, -1.0], 0.30, 0.25, 754)],
        )
}

fn heel_line(name: &'static str, length: f64, bend: [f64; 3], width: f64, holds: f64, seed: u64) -> Stain {
    let breadth = 1.0 + 2.6 * bend.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    let haze = [width, 1.2 * width, 0.6 * width];
    let beside = bend.map(|y| y - 0.55 * width);
    Stain::new(name, length, (breadth * 10.0).round() / 10.0, RUBBER)
        .rubs([Rub { streak: 0.2, ..rub(0.2, length - 0.2, bend, haze, 0.22, seed + 40) }])
        .strokes(
            1.0,
            [
                core(0.2, length - 0.3, bend, width, holds, seed),
                core(0.2 * length, 0.75 * length, beside, 0.35 * width, 0.3, seed + 10),
            ],
        )
}

/// The side of a sole, set against the wall: two dark edges and the welt between them.
fn sole_edge() -> Stain {
    Stain::new("shoe_sole_edge", 15.0, 4.2, RUBBER)
        .rubs([
            Rub { hold: 0.5, patch: 2.5, ..rub(0.5, 14.4, [-0.4, 0.2, -0.2], [0.9, 1.4, 0.8], 0.34, 761) },
            Rub { hold: 0.5, streak: 0.2, ..rub(0.8, 13.6, [-0.9, -0.5, -0.9], [0.2, 0.35, 0.2], 0.7, 762) },
        ])
        .strokes(
            1.0,
            [core(0.6, 12.5, [-1.0, -0.6, -0.9], 0.34, 0.5, 763), core(2.0, 14.2, [0.5, 0.9, 0.6], 0.24, 0.4, 764)],
        )
}

/// The ball of a foot that somebody leant on the wall: the pad of the sole and how it slipped down.
fn sole_ball() -> Stain {
    Stain::new("shoe_sole_ball", 10.5, 9.6, Wall { hard: 0.75, ..RUBBER })
        .dabs([
            dab(vec2(5.0, 0.9), vec2(3.6, 2.9), 0.36, 771),
            dab(vec2(4.2, 2.0), vec2(2.0, 1.5), 0.36, 772),
            dab(vec2(6.6, 0.4), vec2(1.8, 2.0), 0.30, 773),
            dab(vec2(5.0, -1.6), vec2(3.4, 2.2), 0.20, 774),
        ])
        .strokes(
            0.9,
            [core(1.6, 8.8, [1.0, 3.6, 1.2], 0.30, 0.6, 775), core(2.2, 7.4, [0.2, 2.6, 0.6], 0.20, 0.4, 776)],
        )
}

/// A treaded toe against the wall, seen in bars.
fn sole_tread() -> Stain {
    let draw = |n: u64, k: i64| super::super::noise::hash(n as i64, k, 780);
    let bars = (0..7).map(|n| {
        let y = 2.9 - 0.95 * n as f64;
        let half = 3.6 * (1.0 - (y - 0.2) * (y - 0.2) / (4.2 * 4.2)).max(0.05).sqrt();
        let skew = 0.5 * (draw(n, 0) - 0.5);
        Rub {
            soft: 0.35,
            attack: 0.12,
            hold: 0.75,
            streak: 0.35,
            streaks: 0.6,
            patches: 0.8,
            ..rub(
                4.6 - half + skew,
                4.6 + half + skew,
                [y - 0.35, y + 0.25, y - 0.35],
                [0.26; 3],
                0.25 + 0.7 * draw(n, 1),
                780 + n,
            )
        }
    });
    Stain::new("shoe_sole_tread", 9.2, 8.8, RUBBER).rubs(bars.collect::<Vec<_>>()).dabs([dab(
        vec2(4.6, 0.6),
        vec2(3.8, 3.2),
        0.12,
        788,
    )])
}
