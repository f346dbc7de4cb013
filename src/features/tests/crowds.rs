use crate::math::{Vec2, sin_cos, vec2};
use crate::motion::Ensemble;

/// A number in -0.5 to 0.5 that looks drawn.
pub(super) fn drawn(a: usize, b: usize) -> f64 {
    let mut mixed = crate::math::SplitMix64::new((a as u64) << 32 | b as u64);
    f64::from(mixed.unit()) - 0.5
}

fn crowd(people: usize, moments: usize, place: impl Fn(usize, f64) -> Vec2) -> Ensemble {
    let places =
        (0..moments).flat_map(|m| (0..people).map(|p| place(p, m as f64 / 10.0)).collect::<Vec<_>>()).collect();
    Ensemble::new(10.0, 3.0, (10..10 + people as u32).collect(), places)
}

/// People who wander about, each at a pace of their own, while their middle goes somewhere.
pub(super) fn wild(people: usize, moments: usize) -> Ensemble {
    let side = (people as f64).sqrt();
    crowd(people, moments, |person, t| {
        let home = vec2(drawn(person, 1), drawn(person, 2)) * 2.0 * side;
        let wave = |which: usize| {
            let pace = 0.3 + (drawn(person, which) + 0.5) * 2.0;
            sin_cos(t * pace + 9.0 * drawn(person, which + 1)).0 * (0.5 + drawn(person, which + 2))
        };
        // A millimetre of noise, so that no two coordinates go together.
        let noise = |axis: usize| 0.002 * drawn(person * 100_000 + (t * 10.0).round() as usize, axis);
        home + vec2(wave(3) + 0.8 * t + noise(50), wave(7) + 0.3 * wave(11) - 0.2 * t + noise(51))
    })
}

/// Where people of a crowd of two rings and somebody in the middle stand.
fn place_in_rings(person: usize, people: usize) -> Vec2 {
    let inner = people / 3;
    let (k, of, radius_m) = if person < inner { (person, inner, 2.0) } else { (person - inner, people - inner, 4.0) };
    let (sin, cos) = sin_cos(std::f64::consts::TAU * k as f64 / of as f64 + 0.3);
    vec2(cos, sin) * radius_m
}

/// A little to and fro, of a pace of one's own, metres.
fn sway(person: usize, t: f64) -> Vec2 {
    let wave = |which: usize| sin_cos(t * (2.0 + drawn(person, which)) + 9.0 * drawn(person, which + 1)).0;
    vec2(wave(20), wave(30)) * 0.05
}

/// A crowd that moves sideways, along x, for 10 s: people of the upper half to the right, of the lower half to the left, at
/// about 0.5 m/s, and all together slowly to the right.
pub(super) fn sideways(people: usize) -> Ensemble {
    crowd(people, 101, |person, t| {
        let home = place_in_rings(person, people);
        let speed = (0.5 + 0.1 * drawn(person, 1)) * if home.y > 0.0 { 1.0 } else { -1.0 };
        home + vec2((speed + 0.1) * (t - 5.0), 0.0) + sway(person, t)
    })
}

/// A crowd that moves towards its centre for 10 s, until its rings are a third as wide.
pub(super) fn to_the_centre(people: usize) -> Ensemble {
    crowd(people, 101, |person, t| {
        let pace = (1.0 + 0.2 * drawn(person, 3)) * t / 10.0;
        place_in_rings(person, people) * (1.0 - pace * 2.0 / 3.0) + sway(person, t)
    })
}
