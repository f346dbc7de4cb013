//! Bags, cases and trolleys: edges that scrape, corners that gouge, cloth that smears, wheels and bumpers that draw
//! lines at one height.

use trodden::math::vec2;

use super::super::heel_marks::Stroke;
use super::Stain;
use super::touch::{Dab, Rub, Wall};

/// The bags, in the order of `patterns.toml`.
pub fn all() -> Vec<Stain> {
    vec![edge(), edge_long(), corner(), corner_hit(), smear(), rucksack(), scrapes(), bumper(), wheel(), strap()]
}

const CLOTH: Wall = Wall { hard: 0.40, stipple: 0.9, seed: 500 };
const HARD: Wall = Wall { hard: 0.85, stipple: 1.0, seed: 510 };

/// A seam or an edge drawn over the wall.
const RUB: Rub = Rub {
    from: 0.0,
    to: 1.0,
    bend: [0.0; 3],
    half: [1.0; 3],
    strength: 0.4,
    attack: 0.10,
    hold: 0.35,
    soft: 0.8,
    streaks: 0.8,
    streak: 0.4,
    patches: 0.6,
    patch: 2.5,
    seed: 0,
};

fn rub(from: f64, to: f64, bend: [f64; 3], half: [f64; 3], strength: f64, seed: u64) -> Rub {
    Rub { from, to, bend, half, strength, seed, ..RUB }
}

fn line(from: f64, to: f64, bend: [f64; 3], width: f64, holds: f64, seed: u64) -> Stroke {
    Stroke { from, to, bend, widths: [0.7 * width, width, 0.4 * width], widest: 0.3, holds, seed }
}

fn edge() -> Stain {
    Stain::new("bag_edge", 26.0, 4.0, CLOTH)
        .rubs([
            rub(0.6, 25.0, [0.3, 0.1, -0.4], [0.9, 1.3, 0.8], 0.40, 501),
            Rub { streak: 0.2, ..rub(1.0, 22.0, [0.7, 0.5, 0.1], [0.25, 0.4, 0.2], 0.7, 502) },
        ])
        .strokes(0.7, [line(1.5, 19.0, [0.6, 0.5, 0.2], 0.22, 0.25, 503)])
}

fn edge_long() -> Stain {
    Stain::new("bag_edge_long", 48.0, 6.0, CLOTH)
        .rubs([
            Rub { patch: 4.0, ..rub(1.0, 46.0, [0.8, 0.1, -0.8], [1.3, 2.0, 1.2], 0.28, 511) },
            Rub { streak: 0.22, ..rub(1.5, 44.0, [1.5, 0.9, 0.0], [0.3, 0.45, 0.25], 0.55, 512) },
            Rub { streak: 0.22, ..rub(5.0, 38.0, [-0.3, -0.8, -1.6], [0.25, 0.4, 0.2], 0.45, 513) },
        ])
        .strokes(
            0.8,
            [line(2.0, 34.0, [1.5, 0.9, 0.3], 0.20, 0.2, 514), line(9.0, 40.0, [-0.5, -0.9, -1.6], 0.16, 0.3, 515)],
        )
}

/// A corner that catches: a dark spot, then scratches.
fn corner() -> Stain {
    let dab = |x, y, rx, ry, strength, seed| Dab {
        middle: vec2(x, y),
        radii: vec2(rx, ry),
        turned: -0.2,
        strength,
        soft: 0.7,
        ragged: 0.35,
        seed,
    };
    Stain::new("bag_corner", 10.0, 4.4, HARD)
        .dabs([dab(1.8, 0.3, 0.9, 0.8, 0.9, 521), dab(2.2, 0.2, 1.5, 1.5, 0.3, 522)])
        .rubs([rub(1.4, 9.4, [0.3, 0.2, -0.5], [0.8, 1.1, 0.5], 0.5, 523)])
        .strokes(
            0.9,
            [
                line(1.2, 9.0, [0.5, 0.45, -0.2], 0.20, 0.3, 524),
                line(1.6, 6.6, [0.0, -0.1, -0.6], 0.28, 0.2, 525),
                line(2.4, 8.0, [-0.5, -0.55, -1.0], 0.12, 0.2, 526),
            ],
        )
}

/// A hard case that knocked against the wall and turned.
fn corner_hit() -> Stain {
    Stain::new("bag_corner_hit", 6.0, 4.0, HARD)
        .rubs([rub(0.6, 5.4, [0.9, -0.4, -1.0], [0.5, 0.9, 0.4], 0.6, 531)])
        .strokes(
            1.0,
            [
                line(0.6, 5.2, [1.1, -0.3, -0.9], 0.34, 0.45, 532),
                line(0.9, 4.4, [0.6, -0.75, -1.3], 0.22, 0.3, 533),
                line(1.6, 5.5, [1.2, 0.4, 0.0], 0.12, 0.2, 534),
            ],
        )
}

fn smear() -> Stain {
    Stain::new("bag_smear", 34.0, 18.0, CLOTH).rubs([
        Rub {
            soft: 0.95,
            streaks: 0.6,
            streak: 1.8,
            patch: 5.0,
            ..rub(1.0, 32.0, [0.6, 0.0, -1.0], [5.4, 7.4, 5.0], 0.30, 541)
        },
        Rub { streak: 0.7, ..rub(2.5, 26.0, [4.0, 3.6, 2.8], [0.9, 1.5, 0.8], 0.42, 542) },
        Rub { streak: 0.5, ..rub(4.0, 30.0, [-4.4, -5.0, -5.4], [0.6, 1.0, 0.5], 0.34, 543) },
    ])
}

/// A rucksack: cloth, straps and buckles.
fn rucksack() -> Stain {
    Stain::new("bag_rucksack", 30.0, 22.0, CLOTH)
        .rubs([
            Rub {
                soft: 0.95,
                streaks: 0.55,
                streak: 2.2,
                patch: 6.0,
                ..rub(1.0, 28.0, [1.0, 0.4, -0.6], [6.5, 8.6, 6.0], 0.24, 551)
            },
            Rub { streak: 0.6, ..rub(3.0, 22.0, [5.2, 4.8, 4.0], [1.0, 1.4, 0.8], 0.40, 552) },
            Rub { streak: 0.6, ..rub(5.0, 26.0, [-4.6, -5.0, -5.6], [0.8, 1.2, 0.6], 0.32, 553) },
        ])
        .strokes(
            0.6,
            [line(6.0, 15.0, [1.4, 1.2, 0.8], 0.26, 0.2, 554), line(8.0, 19.0, [-1.6, -1.8, -2.2], 0.18, 0.2, 555)],
        )
}

/// A hard shell: many fine scratches side by side.
fn scrapes() -> Stain {
    let draw = |n: u64, k: i64| super::super::noise::hash(n as i64, k, 560);
    let lines = (0..11).map(|n| {
        let y = -3.0 + 0.6 * n as f64 + 0.5 * draw(n, 0);
        let from = 1.0 + 9.0 * draw(n, 1);
        let to = from + 6.0 + 15.0 * draw(n, 2);
        let tilt = 0.5 + 0.5 * draw(n, 3);
        line(from, to.min(29.0), [y + tilt, y, y - tilt], 0.10 + 0.16 * draw(n, 4), 0.3 * draw(n, 5), 560 + n)
    });
    Stain::new("bag_scrapes", 30.0, 9.0, HARD)
        .rubs([Rub { streak: 0.5, ..rub(1.0, 28.5, [0.6, 0.0, -0.7], [2.4, 3.6, 2.0], 0.24, 561) }])
        .strokes(0.85, lines.collect::<Vec<_>>())
}

/// The rubber bumper of a trolley: a long band with two edges.
fn bumper() -> Stain {
    let band = |from, to, y, half, strength, seed| Rub {
        soft: 0.45,
        streak: 0.45,
        streaks: 0.7,
        hold: 0.55,
        patch: 5.0,
        ..rub(from, to, [y, y + 0.04, y - 0.06], [half, half, 0.9 * half], strength, seed)
    };
    Stain::new("bag_bumper", 60.0, 5.0, HARD)
        .rubs([
            band(0.8, 58.5, 0.0, 1.5, 0.34, 571),
            band(1.0, 52.0, 1.05, 0.45, 0.6, 572),
            band(3.0, 57.0, -1.1, 0.35, 0.5, 573),
        ])
        .strokes(
            0.9,
            [line(1.5, 40.0, [1.2, 1.22, 1.15], 0.24, 0.4, 574), line(8.0, 54.0, [-1.2, -1.2, -1.3], 0.18, 0.4, 575)],
        )
}

/// The tyre of a trolley along the wall: one dark line that jumps.
fn wheel() -> Stain {
    Stain::new("bag_wheel", 40.0, 2.6, HARD)
        .rubs([Rub {
            soft: 0.6,
            streak: 0.3,
            hold: 0.5,
            ..rub(0.5, 39.0, [0.05, 0.1, -0.1], [0.5, 0.7, 0.4], 0.42, 581)
        }])
        .strokes(
            1.0,
            [
                line(0.6, 17.0, [0.1, 0.2, 0.1], 0.55, 0.5, 582),
                line(15.0, 30.0, [0.1, 0.0, 0.05], 0.42, 0.35, 583),
                line(28.0, 39.2, [0.0, -0.1, -0.2], 0.30, 0.2, 584),
            ],
        )
}

/// A strap or a handle: narrow, dark where it pressed.
fn strap() -> Stain {
    Stain::new("bag_strap", 20.0, 6.0, CLOTH).rubs([
        rub(0.8, 19.0, [1.2, -0.2, -1.2], [0.9, 1.3, 0.7], 0.40, 591),
        Rub { soft: 0.5, streak: 0.25, ..rub(1.4, 16.0, [1.9, 0.5, -0.5], [0.16, 0.26, 0.14], 0.8, 592) },
        Rub { soft: 0.5, streak: 0.25, ..rub(1.8, 18.0, [0.5, -0.9, -1.8], [0.14, 0.24, 0.12], 0.6, 593) },
    ])
}
