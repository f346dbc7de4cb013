//! Parsers of option values: numbers in a range, names from a list.

use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use trodden::scenario::allowed_range;

/// Parses a number in a range, both ends included.
pub fn number_within(text: &str, [low, high]: [f64; 2]) -> Result<f64, String> {
    // This form also rejects NaN.
    let allowed = |number: &f64| *number >= low && *number <= high;
    text.parse().ok().filter(allowed).ok_or_else(|| format!("allowed is {low} to {high}"))
}

/// Parses numbers with commas between them; `None` unless there are so many.
pub fn listed<T: FromStr, const N: usize>(text: &str) -> Option<[T; N]> {
    let numbers: Option<Vec<T>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}

/// Returns a parser of numbers in the range of a scenario's key.
pub fn within(key: &'static str) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let number: f64 = text.parse().map_err(|_| "not a number".to_string())?;
        allowed_range(key).map_or(Ok(number), |range| number_within(text, range))
    }
}

/// Returns a parser of the names of these values.
pub fn one_of<T, const N: usize>(all: [T; N], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    PossibleValuesParser::new(all.map(name)).try_map(move |chosen| {
        let found = all.into_iter().find(|&one| name(one) == chosen);
        found.ok_or_else(|| format!("{chosen} is none of the names"))
    })
}
