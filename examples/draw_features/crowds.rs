//! Two crowds of the same rings of people, each with a motion of its own for 10 seconds.

use std::fmt::Write;

use trodden::math::{SplitMix64, Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;

const PEOPLE: usize = 30;
const MOMENTS: usize = 101;
const FPS: f64 = 10.0;

/// People of the upper half move to the right, those of the lower half to the left, at about 0.5 m/s.
pub fn sideways() -> Ensemble {
    crowd(|person, home, t| {
        let speed = (0.5 + 0.2 * drawn(person, 1)) * if home.y > 0.0 { 1.0 } else { -1.0 };
        home + vec2(speed * (t - 5.0), 0.0)
    })
}

/// Everybody moves towards the centre, until they are a third as far from it.
pub fn to_the_centre() -> Ensemble {
    crowd(|person, home, t| home * (1.0 - (1.0 + 0.2 * drawn(person, 2)) * t / 15.0))
}

fn crowd(place: impl Fn(usize, Vec2, f64) -> Vec2) -> Ensemble {
    let at = |moment: usize, person: usize| {
        let t = moment as f64 / FPS;
        place(person, home(person), t) + sway(person, t)
    };
    let places = (0..MOMENTS).flat_map(|moment| (0..PEOPLE).map(move |person| (moment, person)));
    let places = places.map(|(moment, person)| at(moment, person)).collect();
    Ensemble::new(FPS, 0.0, (1..=PEOPLE as u32).collect(), places)
}

/// Where somebody stands: on one of three rings.
fn home(person: usize) -> Vec2 {
    let (number, of, radius_m) = match person {
        0..5 => (person, 5, 1.2),
        5..15 => (person - 5, 10, 2.6),
        _ => (person - 15, 15, 4.0),
    };
    let (sin, cos) = sin_cos(std::f64::consts::TAU * (number as f64 + 0.25) / of as f64);
    vec2(cos, sin) * radius_m + vec2(drawn(person, 3), drawn(person, 4)) * 0.3
}

/// Nobody walks quite straight.
fn sway(person: usize, t: f64) -> Vec2 {
    let wave = |which| sin_cos(t * (2.0 + drawn(person, which)) + 9.0 * drawn(person, which + 1)).0;
    vec2(wave(5), wave(7)) * 0.05
}

/// A number from -0.5 to 0.5 that looks drawn.
fn drawn(person: usize, what: usize) -> f64 {
    f64::from(SplitMix64::new((person * 100 + what) as u64).unit()) - 0.5
}

/// The crowd as a recording.
pub fn text(crowd: &Ensemble) -> String {
    let mut text = format!("# framerate: {}\n# id frame x/m y/m\n", crowd.fps);
    for moment in 0..crowd.moments() {
        for (id, place) in crowd.ids.iter().zip(crowd.places_at(moment)) {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{id} {moment} {:.4} {:.4}", place.x, place.y);
        }
    }
    text
}
