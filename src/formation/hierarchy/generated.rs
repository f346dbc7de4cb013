//! Generated examples: marching ranks, people who wander or sway.

use std::f64::consts::TAU;

use rand::RngExt;

use super::super::places::{disc, grid};
use super::super::request::{ExampleKind, ExampleRequest};
use super::heading::turned_to;
use crate::formation::FormationError;
use crate::math::{Purpose, Vec2, person_stream, sin_cos, vec2};
use crate::motion::Ensemble;
use crate::progress::{Interrupted, Progress};

/// Default speeds of ranks and of wanderers, metres per second.
const MARCH_M_S: f64 = 1.2;
const STROLL_M_S: f64 = 0.9;
/// Amplitudes of sway to the sides per stride and along the path per step, metres.
const SIDEWAYS_M: f64 = 0.03;
const ALONG_M: f64 = 0.015;
/// Range of step phases among people, radians.
const OUT_OF_STEP_RAD: f64 = 0.5;
/// Largest number of wanderers: each step compares all pairs.
pub(super) const MOST_WANDERERS: usize = 1_000;
/// Time step of wanderers, seconds.
const STEP_S: f64 = 0.05;

/// Description of an example to generate.
pub(super) struct GeneratedExample<'r> {
    pub request: &'r ExampleRequest,
    pub kind: ExampleKind,
    pub people: usize,
    pub columns: usize,
    /// Seed, different for each crowd of a kind.
    pub seed: u64,
    pub fps: f64,
    pub moments: usize,
}

impl GeneratedExample<'_> {
    /// Generates the example.
    pub fn make(&self, progress: &dyn Progress) -> Result<Ensemble, FormationError> {
        let places_m = match self.kind {
            ExampleKind::Still => self.still(),
            ExampleKind::Sway => self.around(|_| Vec2::ZERO, 0.0, self.request.stray_m),
            ExampleKind::Ranks => {
                let speed_m_s = self.request.speed_m_s.unwrap_or(MARCH_M_S);
                let (sin, cos) = sin_cos(self.request.heading_deg.to_radians());
                let heading = vec2(cos, sin);
                let march = |time_s: f64| heading * (speed_m_s * time_s);
                self.around(march, speed_m_s, self.request.stray_m)
            }
            ExampleKind::Wander => self.wander(progress)?,
        };
        Ok(Ensemble::new(self.fps, 0.0, (0..self.people as u32).collect(), places_m))
    }

    fn time_s(&self, moment: usize) -> f64 {
        self.request.from_s + moment as f64 / self.fps
    }

    /// The positions of the ranks, and their heading.
    fn ranks(&self) -> (Vec<Vec2>, Vec2) {
        let (sin, cos) = sin_cos(self.request.heading_deg.to_radians());
        let heading = vec2(cos, sin);
        let places = grid(self.people, self.columns, self.request.spacing_m);
        (places.into_iter().map(|place| turned_to(place, heading)).collect(), heading)
    }

    fn still(&self) -> Vec<Vec2> {
        let (places, _) = self.ranks();
        (0..self.moments).flat_map(|_| places.iter().copied()).collect()
    }

    /// Positions of people who stray around their place in ranks that move together.
    fn around(&self, common: impl Fn(f64) -> Vec2, speed_m_s: f64, stray_m: f64) -> Vec<Vec2> {
        let (places, heading) = self.ranks();
        let gaits: Vec<RankGait> = (0..self.people).map(|person| RankGait::of(self.seed, person as u32)).collect();
        let moments = (0..self.moments).map(|moment| self.time_s(moment));
        let place = |time_s: f64| {
            let middle = common(time_s);
            let step = |gait: &RankGait| turned_to(gait.step(time_s, speed_m_s), heading);
            let stray = |gait: &RankGait| gait.stray(time_s) * stray_m;
            let all = places.iter().zip(&gaits);
            all.map(|(&place, gait)| middle + place + stray(gait) + step(gait)).collect::<Vec<_>>()
        };
        moments.flat_map(place).collect()
    }

    /// Positions of wanderers, whose directions drift, turn back at the edge of a disc, and away from others.
    fn wander(&self, progress: &dyn Progress) -> Result<Vec<Vec2>, Interrupted> {
        let spacing_m = self.request.spacing_m;
        let radius_m = self.request.radius_m.unwrap_or_else(|| spacing_m * (6.0 * self.people as f64 / TAU).sqrt());
        let mut crowd: Vec<Wanderer> = disc(self.people, 0.0, Some(0.8 * radius_m))
            .into_iter()
            .enumerate()
            .map(|(person, place)| Wanderer::new(self.seed, person as u32, place, self.request.speed_m_s))
            .collect();
        let mut before: Vec<Vec2> = crowd.iter().map(|wanderer| wanderer.place).collect();
        let mut after = before.clone();
        let (mut steps, mut places_m) = (0u64, Vec::with_capacity(self.people * self.moments));
        for moment in 0..self.moments {
            let time_s = self.time_s(moment);
            while (steps as f64) * STEP_S < time_s {
                if steps.is_multiple_of(100) {
                    progress.keep_on()?;
                }
                before.clone_from(&after);
                crowd.iter_mut().enumerate().for_each(|(k, wanderer)| wanderer.walk(k, &before, radius_m, spacing_m));
                after.iter_mut().zip(&crowd).for_each(|(place, wanderer)| *place = wanderer.place);
                steps += 1;
            }
            let behind = (steps as f64 * STEP_S - time_s) / STEP_S;
            places_m
                .extend(after.iter().zip(&before).map(|(&after, &before)| after.lerp(before, behind.clamp(0.0, 1.0))));
        }
        Ok(places_m)
    }
}

/// A person's motion around a place in the ranks.
struct RankGait {
    /// Rates, rad/s, and phases of slow drifts in x and y.
    drifts: [[(f64, f64); 3]; 2],
    step_phase_rad: f64,
}

impl RankGait {
    /// Amplitudes and periods of the three drifts.
    const SHARES: [f64; 3] = [0.6, 0.45, 0.3];
    const PERIODS_S: [[f64; 2]; 3] = [[9.0, 16.0], [5.0, 8.0], [2.8, 4.5]];

    fn of(seed: u64, person: u32) -> RankGait {
        let rng = &mut person_stream(seed, person, Purpose::Gait);
        let mut drift = || {
            RankGait::PERIODS_S.map(|[short_s, long_s]| {
                let period_s = short_s + (long_s - short_s) * rng.random::<f64>();
                (TAU / period_s, TAU * rng.random::<f64>())
            })
        };
        let drifts = [drift(), drift()];
        RankGait { drifts, step_phase_rad: OUT_OF_STEP_RAD * (rng.random::<f64>() - 0.5) }
    }

    fn stray(&self, time_s: f64) -> Vec2 {
        let [x, y] = self.drifts.map(|drifts| {
            let waves = drifts.iter().zip(RankGait::SHARES);
            waves.map(|((rate, phase), share)| share * sin_cos(rate * time_s + phase).0).sum()
        });
        vec2(x, y)
    }

    /// Sway of marching steps: towards the standing foot, and faster at push-off.
    fn step(&self, time_s: f64, speed_m_s: f64) -> Vec2 {
        // Steps of slower people do not show.
        if speed_m_s < 0.2 {
            return Vec2::ZERO;
        }
        // Step length as measured, see `Person::step_length_m`.
        let steps = time_s * speed_m_s / (0.247 + 0.344 * speed_m_s.min(4.0));
        let phase = TAU * steps + self.step_phase_rad;
        vec2(SIDEWAYS_M * sin_cos(phase / 2.0).0, ALONG_M * sin_cos(phase).0)
    }
}

/// A person who wanders about.
struct Wanderer {
    place: Vec2,
    velocity: Vec2,
    direction: Vec2,
    /// Turning rate, rad/s.
    turn: f64,
    speed_m_s: f64,
    rng: rand::rngs::ChaCha8Rng,
}

impl Wanderer {
    /// Correlation time of the turning rate, seconds, and its deviation, rad/s.
    const TURN_S: f64 = 1.6;
    const TURN_RAD_S: f64 = 0.7;
    /// Reaction time for velocity changes, seconds.
    const REACTION_S: f64 = 0.6;

    fn new(seed: u64, person: u32, place: Vec2, speed_m_s: Option<f64>) -> Wanderer {
        let mut rng = person_stream(seed, person, Purpose::Walk);
        let (sin, cos) = sin_cos(TAU * rng.random::<f64>());
        let direction = vec2(cos, sin);
        let speed_m_s = speed_m_s.unwrap_or(STROLL_M_S) * (0.8 + 0.4 * rng.random::<f64>());
        Wanderer { place, velocity: direction * speed_m_s, direction, turn: 0.0, speed_m_s, rng }
    }

    fn walk(&mut self, own: usize, places: &[Vec2], radius_m: f64, spacing_m: f64) {
        // An Ornstein-Uhlenbeck process driven by even noise of unit deviation.
        let noise = (self.rng.random::<f64>() - 0.5) * 12.0_f64.sqrt();
        let keep = STEP_S / Wanderer::TURN_S;
        self.turn += -self.turn * keep + Wanderer::TURN_RAD_S * (2.0 * keep).sqrt() * noise;
        let out = self.place.length() / radius_m;
        if out > 0.8 {
            // The farther out, the more surely back.
            let inwards = self.direction.cross(-self.place);
            let side = if inwards >= 0.0 { 1.0 } else { -1.0 };
            let outwards = 1.0 + self.direction.dot(self.place) / self.place.length().max(1e-9);
            self.turn += side * outwards * (out - 0.8).min(0.5) * 8.0 * STEP_S;
        }
        let (sin, cos) = sin_cos(self.turn * STEP_S);
        self.direction = self.direction.rotated(vec2(cos, sin)).normalized().unwrap_or(self.direction);
        let reach_m = 1.5 * spacing_m;
        let mut away = Vec2::ZERO;
        for (other, &place) in places.iter().enumerate() {
            let from = self.place - place;
            let near = from.length_squared() < reach_m * reach_m && other != own;
            if let Some(unit) = from.normalized().filter(|_| near) {
                away += unit * (1.0 - from.length() / reach_m);
            }
        }
        let wanted = self.direction * self.speed_m_s + away.clamped(1.5) * 1.2;
        self.velocity += (wanted - self.velocity) * (STEP_S / Wanderer::REACTION_S);
        self.place += self.velocity * STEP_S;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    fn made(kind: ExampleKind, people: usize, moments: usize) -> Ensemble {
        let request = ExampleRequest::default();
        let wanted = GeneratedExample { request: &request, kind, people, columns: 3, seed: 1, fps: 10.0, moments };
        wanted.make(&Silent).unwrap()
    }

    #[test]
    fn ranks_march_in_step_and_stay_ranks() {
        let ranks = made(ExampleKind::Ranks, 9, 301);
        let way = ranks.centroid_m(300) - ranks.centroid_m(0);
        assert!((way.y - 36.0).abs() < 0.3 && way.x.abs() < 0.3, "{way:?}");
        for moment in 0..301 {
            let middle = ranks.centroid_m(moment);
            for (place, expected) in ranks.places_at(moment).iter().zip(grid(9, 3, 1.0)) {
                assert!((*place - middle).distance(expected) < 0.5, "{place:?} {expected:?}");
            }
        }
    }

    #[test]
    fn wanderers_cover_the_disc_and_keep_clear_of_each_other() {
        let crowd = made(ExampleKind::Wander, 9, 600);
        let radius_m = (6.0 * 9.0 / TAU).sqrt();
        let (mut way_m, mut nearest_m) = (0.0, f64::INFINITY);
        for moment in 1..600 {
            let (before, here) = (crowd.places_at(moment - 1), crowd.places_at(moment));
            for (k, &place) in here.iter().enumerate() {
                assert!(place.length() < 1.7 * radius_m, "{moment}: {place:?}");
                way_m += place.distance(before[k]);
                assert!(place.distance(before[k]) < 0.25);
                nearest_m = here[..k].iter().map(|other| other.distance(place)).fold(nearest_m, f64::min);
            }
        }
        assert!((0.6..1.3).contains(&(way_m / 9.0 / 59.9)), "{} m/s", way_m / 9.0 / 59.9);
        assert!(nearest_m > 0.2, "{nearest_m}");
    }

    #[test]
    fn different_seeds_give_different_examples() {
        for kind in [ExampleKind::Ranks, ExampleKind::Wander, ExampleKind::Sway] {
            let request = ExampleRequest::default();
            let of = |seed| GeneratedExample {
                request: &request,
                kind,
                people: 4,
                columns: 2,
                seed,
                fps: 10.0,
                moments: 20,
            };
            let make = |seed| of(seed).make(&Silent).unwrap();
            assert_eq!(make(1), make(1));
            assert_ne!(make(1), make(2));
        }
        let still = made(ExampleKind::Still, 4, 3);
        assert_eq!(still.places_at(0), still.places_at(2));
    }
}
