//! Soil on a pair of shoes and its fading with every step.

use rand::RngExt;

use crate::math::{Purpose, exp, person_stream, round_to_grid};

use super::feet::normal;
use super::options::{SoilOptions, Weather};

/// Steps of a shoe after which a dry trail has halved.
const DRY_HALF_STEPS: f64 = 2.68;
/// Range of the decay constant of a wet shoe, per step.
const WET_DECAY: [f64; 2] = [0.7, 1.4];
/// Factor on the first print of a wet shoe.
const WET_FACTOR: f64 = 3.0;
/// Factor on the first print of a shoe in `wet`: four to six prints of a shoe can be seen.
const MUD_FACTOR: f64 = 40.0;
/// Everybody comes from the same wet pavement: how widely loads differ in rain, relative to dry days.
const WET_SPREAD: f64 = 0.5;
/// Steps after which a wet shoe leaves nothing.
const DRY_AFTER_STEPS: f64 = 10.0;
/// Metres of mat that take all but 1/e of a load.
const MAT_M: f64 = 2.0;
/// Standard deviation of the natural logarithm of a print about its trail.
const PRINT_SIGMA: f64 = 0.2;
/// Limit on the optical density of a first print.
const MOST_DENSITY: f64 = 3.0;

/// A pair of shoes with soil.
pub(super) struct Shoes {
    feet: [Shoe; 2],
    weather: Weather,
    from_outside: bool,
    /// Length of mat ahead, metres.
    mat_left_m: f64,
    mat_walked_m: f64,
}

#[derive(Clone, Copy)]
struct Shoe {
    /// Optical density of the first print, and in rain.
    load: f64,
    wet_load: f64,
    /// Steps since then, and since the door.
    steps: f64,
    indoors: f64,
    /// Decay constant when wet, per step.
    decay: f64,
}

impl Shoes {
    /// Draws the soil of a pair: lognormal per person, with a smaller spread between the feet.
    pub fn new(seed: u64, person: u32, options: &SoilOptions, from_outside: bool) -> Shoes {
        let rng = &mut person_stream(seed, person, Purpose::Load);
        let deviation = options.sigma * normal(rng);
        let [person_load, person_wet_load] =
            [1.0, WET_SPREAD].map(|spread| options.median_density * exp(spread * deviation));
        // Both kinds of start are drawn, so that the origin of a person shifts no other draw.
        let entering = options.steps_before_entering.draw(rng);
        let indoors = options.steps_before_indoors.draw(rng);
        let weather_factor = if options.weather == Weather::Wet { WET_FACTOR } else { 1.0 };
        let feet = [0, 1].map(|_| {
            let shoe = exp(options.shoe_sigma * normal(rng));
            Shoe {
                load: (weather_factor * person_load * shoe).min(MOST_DENSITY),
                wet_load: (MUD_FACTOR * person_wet_load * shoe).min(MOST_DENSITY),
                steps: if from_outside { entering } else { indoors },
                indoors: 0.0,
                decay: round_to_grid(WET_DECAY[0] + (WET_DECAY[1] - WET_DECAY[0]) * rng.random::<f64>()),
            }
        });
        let mat_left_m = if from_outside { options.mat_length_m } else { 0.0 };
        Shoes { feet, weather: options.weather, from_outside, mat_left_m, mat_walked_m: 0.0 }
    }

    /// Walks a distance within the plan, first over the mat.
    pub fn walk(&mut self, walked_m: f64) {
        let on_mat_m = walked_m.min(self.mat_left_m);
        self.mat_left_m -= on_mat_m;
        self.mat_walked_m += on_mat_m;
    }

    /// Optical density of the next print of a foot, and if it rains outside; `deviation` is a standard normal value.
    pub fn step(&mut self, left: bool, deviation: f64) -> [f64; 2] {
        let shoe = &mut self.feet[usize::from(left)];
        let faded = shoe.load * fade(self.weather, shoe.steps, shoe.decay);
        let is_wet = self.from_outside && shoe.indoors < DRY_AFTER_STEPS;
        let wet = if is_wet { shoe.wet_load * fade(Weather::Wet, shoe.indoors, shoe.decay) } else { 0.0 };
        shoe.steps += 1.0;
        shoe.indoors += 1.0;
        [faded, wet].map(|density| density * exp(PRINT_SIGMA * deviation - self.mat_walked_m / MAT_M))
    }
}

/// Share of a shoe's first print that is left after some steps of that shoe, 1 to 0.
fn fade(weather: Weather, steps: f64, decay: f64) -> f64 {
    match weather {
        Weather::Dry => DRY_HALF_STEPS / (steps + DRY_HALF_STEPS),
        Weather::Wet => exp(-decay * steps),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Distribution, ln};

    /// First prints after no steps at all, without the spread between feet.
    fn bare() -> SoilOptions {
        SoilOptions { shoe_sigma: 0.0, steps_before_entering: Distribution::Constant(0.0), ..SoilOptions::default() }
    }

    #[test]
    fn loads_are_lognormal_with_the_stated_median_and_sigma() {
        let mut logs: Vec<f64> = (0..4000).map(|id| ln(Shoes::new(7, id, &bare(), true).step(false, 0.0)[0])).collect();
        logs.sort_by(f64::total_cmp);
        let mean = logs.iter().sum::<f64>() / 4000.0;
        let sigma = (logs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 4000.0).sqrt();
        assert!((exp(logs[2000]) - 0.01).abs() < 0.001, "median {}", exp(logs[2000]));
        assert!((sigma - 1.4).abs() < 0.06, "sigma {sigma}");
    }

    #[test]
    fn the_feet_of_a_pair_differ() {
        let mut shoes = Shoes::new(7, 3, &SoilOptions::default(), true);
        assert_ne!(shoes.step(true, 0.0)[0], shoes.step(false, 0.0)[0]);
    }

    #[test]
    fn a_dry_trail_is_half_at_3_steps_and_a_tenth_at_24() {
        let mut shoes = Shoes::new(7, 3, &bare(), true);
        let trail: Vec<f64> = (0..30).map(|_| shoes.step(true, 0.0)[0]).collect();
        assert!((trail[3] / trail[0] - 0.5).abs() < 0.05);
        assert!((trail[24] / trail[0] - 0.1).abs() < 0.005);
    }

    #[test]
    fn a_wet_trail_is_gone_in_four_to_six_prints() {
        let options = SoilOptions { weather: Weather::Wet, ..bare() };
        for id in 0..200 {
            let mut shoes = Shoes::new(7, id, &options, true);
            let trail: Vec<f64> = (0..8).map(|_| shoes.step(true, 0.0)[0]).collect();
            assert!(trail[6] / trail[0] < 0.02, "person {id}: {}", trail[6] / trail[0]);
            assert!(trail[2] / trail[0] > 0.06, "person {id}: {}", trail[2] / trail[0]);
        }
    }

    #[test]
    fn a_mat_takes_its_share_and_no_more_behind_it() {
        let after = |mat_length_m: f64, walked_m: f64| {
            let mut shoes = Shoes::new(7, 3, &SoilOptions { mat_length_m, ..bare() }, true);
            shoes.walk(walked_m);
            shoes.step(true, 0.0)[0]
        };
        for (mat, taken) in [(3.0, 0.78), (4.6, 0.90), (6.0, 0.95)] {
            assert!((1.0 - after(mat, 20.0) / after(0.0, 20.0) - taken).abs() < 0.005, "{mat} m");
        }
        assert!(after(6.0, 1.0) > after(6.0, 2.0));
    }

    #[test]
    fn who_starts_indoors_brings_little() {
        let first = |outside| (0..200).map(|id| Shoes::new(7, id, &bare(), outside).step(true, 0.0)[0]).sum::<f64>();
        assert!(first(false) < 0.15 * first(true));
    }
}
