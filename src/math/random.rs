//! Random streams per person and purpose, and the expansion of random words.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

/// Purpose of a random stream.
///
/// Each person has one stream per purpose, so that a new draw for one purpose never shifts the draws of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub enum Purpose {
    /// Body, shoes, speed, distances: drawn once.
    Traits = 1,
    /// Route, time and place of arrival.
    Arrival = 2,
    /// Decisions on the way.
    Walk = 3,
    /// First foot, phase, step-to-step variation.
    Gait = 4,
    /// Heel marks and the variation word of each mark.
    Marks = 5,
    /// Soil on the shoes.
    Load = 6,
    /// Choice of stops and dwell times.
    Stops = 7,
    /// Wall contacts and the variation word of each.
    Contacts = 8,
    /// Group sizes.
    Groups = 9,
    /// What is pulled or pushed on wheels, and its rubber marks.
    Wheels = 10,
}

/// The random stream of one person for one purpose: a pure function of its arguments.
///
/// The seed keys the ChaCha8 generator, person and purpose choose the stream.
pub fn person_stream(seed: u64, person: u32, purpose: Purpose) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((u64::from(person) << 8) | purpose as u64);
    rng
}

/// Rounds a drawn value to a grid of 1e-4 of its unit.
///
/// The last bit of a platform's libm (inside `rand_distr`) then has no effect.
pub fn round_to_grid(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// SplitMix64 generator: expands the random word of a mark for its stamp.
///
/// Source: Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195.
#[derive(Clone, Copy, Debug)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// Seeds the generator with a word.
    pub fn new(word: u64) -> SplitMix64 {
        SplitMix64(word)
    }

    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)` with 24 bits, exact in `f32`.
    pub fn unit(&mut self) -> f32 {
        (self.next_u64() >> 40) as f32 / 16_777_216.0
    }

    /// Uniform in `[low, high)`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Normal with mean 0 and deviation 1, as the sum of twelve uniforms (Irwin-Hall): no libm, |z| <= 6.
    pub fn normal(&mut self) -> f32 {
        let mut sum = 0u64;
        for _ in 0..3 {
            let word = self.next_u64();
            sum += (word & 0xffff) + ((word >> 16) & 0xffff) + ((word >> 32) & 0xffff) + (word >> 48);
        }
        sum as f32 / 65_536.0 - 6.0
    }
}
