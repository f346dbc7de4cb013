//! Values of options: numbers within a range, names out of a list.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use trodden::scenario::allowed_range;

/// Reads a number within a range, both ends included.
pub fn number_within(text: &str, [low, high]: [f64; 2]) -> Result<f64, String> {
    // Written so that NaN is out of range.
    let allowed = |number: &f64| *number >= low && *number <= high;
    text.parse().ok().filter(allowed).ok_or_else(|| format!("allowed is {low} to {high}"))
}

/// Takes a number within the range of a scenario's key.
pub fn within(key: &'static str) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let number: f64 = text.parse().map_err(|_| "not a number".to_string())?;
        allowed_range(key).map_or(Ok(number), |range| number_within(text, range))
    }
}

/// Takes the name of one of these.
pub fn one_of<T, const N: usize>(all: [T; N], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    PossibleValuesParser::new(all.map(name)).try_map(move |chosen| {
        let found = all.into_iter().find(|&one| name(one) == chosen);
        found.ok_or_else(|| format!("{chosen} is none of the names"))
    })
}
