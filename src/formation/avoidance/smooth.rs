use crate::math::Vec2;

/// Solver for offsets that balance accuracy against accelerations, for all bodies at once.
///
/// It solves `(diag(hold) + bend D'D) x = b` with `D` the second difference over frames: symmetric, positive definite, five
/// diagonals.
pub(super) struct Smoother {
    /// `L D L'` of the matrix: the diagonal, and the two below it.
    diagonal: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
}

impl Smoother {
    /// Factorises the matrix for a weight per frame and a weight of second differences.
    pub fn new(hold: &[f64], bend: f64) -> Smoother {
        let n = hold.len();
        let mut bands = [hold.to_vec(), vec![0.0; n], vec![0.0; n]];
        for k in 0..n.saturating_sub(2) {
            // The row (1, -2, 1) of D at k, k + 1, k + 2.
            for (i, a) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                for (j, b) in [1.0, -2.0, 1.0].into_iter().enumerate().skip(i) {
                    bands[j - i][k + i] += bend * a * b;
                }
            }
        }
        let [mut diagonal, mut first, mut second] = bands;
        for k in 0..n {
            let pivot = diagonal[k];
            let (one, two) = (first[k] / pivot, second[k] / pivot);
            if k + 1 < n {
                diagonal[k + 1] -= one * first[k];
                first[k + 1] -= one * second[k];
            }
            if k + 2 < n {
                diagonal[k + 2] -= two * second[k];
            }
            (first[k], second[k]) = (one, two);
        }
        Smoother { diagonal, first, second }
    }

    /// Solves in place: `values` holds `width` right-hand sides, frame by frame.
    pub fn solve(&self, values: &mut [Vec2], width: usize) {
        let n = self.diagonal.len();
        for k in 0..n {
            let (done, rest) = values.split_at_mut((k + 1) * width);
            let here = &done[k * width..];
            for (ahead, factor) in [(0, self.first[k]), (1, self.second[k])] {
                if k + 1 + ahead < n {
                    let next = &mut rest[ahead * width..(ahead + 1) * width];
                    next.iter_mut().zip(here).for_each(|(next, &here)| *next -= here * factor);
                }
            }
        }
        for k in (0..n).rev() {
            let (head, behind) = values.split_at_mut((k + 1) * width);
            let here = &mut head[k * width..];
            let pivot = self.diagonal[k];
            here.iter_mut().for_each(|value| *value = *value / pivot);
            for (ahead, factor) in [(0, self.first[k]), (1, self.second[k])] {
                if k + 1 + ahead < n {
                    let next = &behind[ahead * width..(ahead + 1) * width];
                    here.iter_mut().zip(next).for_each(|(here, &next)| *here -= next * factor);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{SplitMix64, vec2};

    #[test]
    fn the_solution_solves_the_system() {
        for n in [1, 2, 3, 4, 9, 40] {
            let mut words = SplitMix64::new(n as u64);
            let hold: Vec<f64> = (0..n).map(|_| f64::from(words.range(0.5, 4.0))).collect();
            let right: Vec<Vec2> =
                (0..2 * n).map(|_| vec2(f64::from(words.normal()), f64::from(words.normal()))).collect();
            let mut x = right.clone();
            Smoother::new(&hold, 7.0).solve(&mut x, 2);
            for person in 0..2 {
                let at = |k: usize| x[2 * k + person];
                for k in 0..n {
                    let mut sum = at(k) * hold[k];
                    // D'D x, a second difference at a time.
                    for first in k.saturating_sub(2)..=k {
                        if first + 2 < n {
                            let bend = at(first) - at(first + 1) * 2.0 + at(first + 2);
                            sum += bend * (7.0 * if k == first + 1 { -2.0 } else { 1.0 });
                        }
                    }
                    assert!(sum.distance(right[2 * k + person]) < 1e-9, "{n}, {k}");
                }
            }
        }
    }
}
