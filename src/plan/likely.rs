//! How likely each scale is: a prior, and what is measured in a drawing, with room for measures that are wrong.

use super::{LARGEST_M_PER_PX, SMALLEST_M_PER_PX};
use crate::math::{exp, ln};

/// Step between scales: the logarithm of their ratio.
const STEP: f64 = 0.01;
/// Scales that people choose, metres per pixel: whole numbers of pixels a metre, and those of robots' maps.
const CHOSEN: [f64; 8] = [0.1, 0.05, 0.04, 1.0 / 30.0, 0.025, 0.02, 0.01, 1.0 / 118.0];
/// Share of the plans whose scale is one of those.
const CHOSEN_SHARE: f64 = 0.15;
/// How far a guess may be from the truth to be right: the logarithm of their ratio.
const RIGHT: f64 = 0.1;
/// Share of the scales beyond the range that a guess tells on each side.
const BEYOND: f64 = 0.02;

/// A usual length: the mean of its logarithm, the deviation of that, and the share of measures that are of other things.
#[derive(Clone, Copy, Debug)]
pub(super) struct Usual {
    pub(super) metres: f64,
    pub(super) spread: f64,
    pub(super) wrong: f64,
}

/// The logarithm of how likely each scale is, in steps of one percent.
pub(super) struct Likelihood {
    logs: Vec<f64>,
}

/// What a likelihood says: the scale, the share of how sure it is to a tenth, and the least and greatest possible one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    pub(super) value: f64,
    pub(super) sureness: f64,
    pub(super) range: [f64; 2],
}

impl Likelihood {
    /// What is known before anything is measured.
    pub(super) fn prior() -> Likelihood {
        let count = (ln(LARGEST_M_PER_PX / SMALLEST_M_PER_PX) / STEP) as usize + 1;
        let mut likelihood = Likelihood { logs: vec![0.0; count] };
        let even = (1.0 - CHOSEN_SHARE) / count as f64;
        let mut shares = vec![even; count];
        for chosen in CHOSEN {
            let k = (ln(chosen / SMALLEST_M_PER_PX) / STEP).round() as usize;
            shares[k.min(count - 1)] += CHOSEN_SHARE / CHOSEN.len() as f64;
        }
        likelihood.logs.iter_mut().zip(shares).for_each(|(log, share)| *log = ln(share));
        likelihood
    }

    fn scale(k: usize) -> f64 {
        SMALLEST_M_PER_PX * exp(k as f64 * STEP)
    }

    /// Adds lengths in pixels, each with its weight, of things with one of the `usual` lengths. However many there are, they
    /// count as `most`: things of one building are alike.
    pub(super) fn add(&mut self, lengths_px: &[(f64, f64)], usual: &[Usual], most: f64) {
        let total: f64 = lengths_px.iter().map(|(_, weight)| weight).sum();
        let share = (most / total.max(1e-9)).min(1.0);
        let elsewhere = 1.0 / ln(LARGEST_M_PER_PX / SMALLEST_M_PER_PX);
        for (k, log) in self.logs.iter_mut().enumerate() {
            let scale = Likelihood::scale(k);
            for &(px, weight) in lengths_px {
                let density = |u: &Usual| {
                    let apart = ln(px * scale / u.metres) / u.spread;
                    (1.0 - u.wrong) * exp(-0.5 * apart * apart) / (u.spread * 2.5066) + u.wrong * elsewhere
                };
                let mean = usual.iter().map(density).sum::<f64>() / usual.len() as f64;
                *log += share * weight * ln(mean);
            }
        }
    }

    /// The scale that is right to a tenth most likely.
    pub(super) fn guess(&self) -> Guess {
        let most = self.logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut shares: Vec<f64> = self.logs.iter().map(|log| exp(log - most)).collect();
        let all: f64 = shares.iter().sum();
        shares.iter_mut().for_each(|share| *share /= all);
        let reach = (RIGHT / STEP) as usize;
        let around = |k: usize| k.saturating_sub(reach)..(k + reach + 1).min(shares.len());
        let near = |k: usize| {
            let weight = |j: usize| shares[j] * (1.0 - 0.5 * j.abs_diff(k) as f64 / reach as f64);
            around(k).map(weight).sum::<f64>()
        };
        let scores: Vec<f64> = (0..shares.len()).map(near).collect();
        let best = (0..shares.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b]).then(b.cmp(&a))).unwrap_or(0);
        let at = |share: f64| {
            let mut seen = 0.0;
            let k = shares.iter().position(|s| {
                seen += s;
                seen >= share
            });
            Likelihood::scale(k.unwrap_or(shares.len() - 1))
        };
        let value = Likelihood::scale(best);
        let chosen = CHOSEN.into_iter().find(|chosen| ln(value / chosen).abs() <= 1.5 * STEP);
        let value = chosen.unwrap_or(value);
        let range = [at(BEYOND).min(value * 0.9), at(1.0 - BEYOND).max(value * 1.1)];
        Guess { value, sureness: shares[around(best)].iter().sum(), range }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOOR: Usual = Usual { metres: 0.87, spread: 0.13, wrong: 0.4 };

    #[test]
    fn many_alike_doors_are_surer_than_few_and_wrong_ones_do_not_mislead() {
        let guess = |doors: &[(f64, f64)]| {
            let mut likelihood = Likelihood::prior();
            likelihood.add(doors, &[DOOR], 5.0);
            likelihood.guess()
        };
        let (one, many) = (guess(&[(43.0, 1.0)]), guess(&[(43.0, 1.0); 8]));
        assert!(many.sureness > 0.75 && one.sureness < 0.6, "{many:?} {one:?}");
        let mixed = guess(&[(43.0, 1.0), (45.0, 1.0), (41.0, 1.0), (12.0, 1.0), (9.0, 1.0), (44.0, 1.0)]);
        for guess in [one, many, mixed] {
            assert!((guess.value / 0.02 - 1.0).abs() < 0.06, "{guess:?}");
            assert!(guess.range[0] <= 0.91 * guess.value && guess.range[1] >= 1.09 * guess.value, "{guess:?}");
        }
    }

    #[test]
    fn nothing_measured_is_nothing_known() {
        let guess = Likelihood::prior().guess();
        assert!(guess.sureness < 0.1 && guess.range[1] > 20.0 * guess.range[0], "{guess:?}");
    }
}
