//! Whole inputs of every reader, damaged a little in ways that are the same in every run: none makes a reader panic.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::readers::{Bench, READERS};

/// Longest time for a small input, also on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);
/// Damaged inputs of a reader.
const INPUTS: usize = 24;
/// Of the reader of parts, each of which ends in a bake.
const COSTLY: usize = 6;

const NUMBERS: [&str; 8] = ["0", "-1", "1e308", "-1e-308", "nan", "4294967296", "18446744073709551615", "0.1"];

/// Damages bytes in one to four places.
fn damage(bytes: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    for _ in 0..random.random_range(1..=4) {
        if bytes.is_empty() {
            return;
        }
        let from = random.random_range(0..bytes.len());
        let to = (from + random.random_range(1..=40)).min(bytes.len());
        match random.random_range(0..6) {
            0 => bytes[from] = random.random(),
            1 => bytes[from] ^= 1 << random.random_range(0..8),
            2 => drop(bytes.drain(from..to)),
            3 => drop(bytes.splice(from..from, bytes[from..to].to_vec())),
            4 => bytes.truncate(from),
            _ => {
                // The next number becomes an unusual one.
                let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
                let from = bytes[from..].iter().position(is_digit).map_or(from, |offset| from + offset);
                let length = bytes[from..].iter().take_while(|byte| is_digit(byte)).count();
                let number = NUMBERS[random.random_range(0..NUMBERS.len())];
                bytes.splice(from..from + length, number.bytes());
            }
        }
    }
}

#[test]
fn no_damage_makes_a_reader_panic() {
    let bench = Bench::new();
    let mut wrong = Vec::new();
    for reader in READERS {
        let seeds = (reader.seeds)(&bench);
        let count = if reader.name == "part" { COSTLY } else { INPUTS };
        let mut random = ChaCha8Rng::seed_from_u64(20);
        // The whole inputs first.
        for number in 0..seeds.len() + count {
            let mut input = seeds[number % seeds.len()].clone();
            if number >= seeds.len() {
                damage(&mut input, &mut random);
            }
            let begun = Instant::now();
            let ended = catch_unwind(AssertUnwindSafe(|| (reader.read)(&bench, &input)));
            let problem = match ended {
                Err(_) => "panics",
                Ok(false) if number < seeds.len() => "whole, is not read",
                Ok(_) if begun.elapsed() > LONGEST => "takes too long",
                Ok(_) => continue,
            };
            wrong.push(format!("input {number} of {} {problem}", reader.name));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
