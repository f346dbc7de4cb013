use nalgebra::DMatrix;

use super::FormationError;
use crate::math::{Vec2, exp};

/// Largest weight of an [`AdjacencyEdit`].
const MOST_WEIGHT: f64 = 1e6;

/// A weight of adjacency that the user sets for each pair of some people, regardless of distance.
///
/// Three people who are adjacent with a weight well above 1 (say 10) stay a triangle while the others change places around
/// them. A weight of 0 parts people who stand close together.
#[derive(Clone, Debug, PartialEq)]
pub struct AdjacencyEdit {
    /// The people, by index in the example's order, from 0.
    pub members: Vec<usize>,
    /// Weight of each pair, 0 to 1e6; neighbours one `sigma` apart have 0.61 without an edit.
    pub weight: f64,
}

/// Checks the edits against a number of people.
///
/// # Errors
/// [`FormationError::Members`], [`FormationError::Option`].
pub(super) fn check_edits(edits: &[AdjacencyEdit], people: usize) -> Result<(), FormationError> {
    for (number, edit) in edits.iter().enumerate() {
        let wrong = |problem| Err(FormationError::Members { edit: number + 1, problem });
        if edit.members.len() < 2 {
            return wrong(format!("{} members are too few for a pair", edit.members.len()));
        }
        if let Some(&member) = edit.members.iter().find(|&&member| member >= people) {
            return wrong(format!("person {member} is named, but the last of the {people} people is {}", people - 1));
        }
        let mut sorted = edit.members.clone();
        sorted.sort_unstable();
        if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return wrong(format!("person {} is named twice", twice[0]));
        }
        if !(0.0..=MOST_WEIGHT).contains(&edit.weight) {
            return Err(FormationError::Option {
                option: "the weight of an adjacency",
                value: edit.weight,
                low: 0.0,
                high: MOST_WEIGHT,
            });
        }
    }
    Ok(())
}

/// The Kirchhoff matrix `K = B - A` of a formation.
///
/// `A` holds the adjacency of each pair, `w_kl = exp(-d_kl^2 / (2 sigma^2))` with their distance `d_kl`, 0 on the diagonal;
/// `B` is diagonal and holds the row sums of `A`. `K` is symmetric, positive semidefinite, and takes the constant vector
/// to 0. Edits are applied in order, the last one counts; members out of range are skipped.
/// Source: Niikura, Takahashi, Shin, equation (3).
pub fn kirchhoff(places_m: &[Vec2], sigma_m: f64, edits: &[AdjacencyEdit]) -> DMatrix<f64> {
    let people = places_m.len();
    let mut matrix = DMatrix::zeros(people, people);
    let scale = -0.5 / (sigma_m * sigma_m);
    for l in 0..people {
        for k in 0..l {
            let weight = exp(scale * (places_m[k] - places_m[l]).length_squared());
            matrix[(k, l)] = -weight;
            matrix[(l, k)] = -weight;
        }
    }
    for edit in edits {
        for (at, &k) in edit.members.iter().enumerate() {
            for &l in &edit.members[at + 1..] {
                if k != l && k < people && l < people {
                    matrix[(k, l)] = -edit.weight;
                    matrix[(l, k)] = -edit.weight;
                }
            }
        }
    }
    for l in 0..people {
        matrix[(l, l)] = -matrix.column(l).sum();
    }
    matrix
}

/// Default range of adjacency: the median distance of a person to the nearest other one, metres.
///
/// At this distance the Gaussian has its point of inflection, so that neighbours in ranks (weight 0.61), across the diagonal
/// (0.37) and two places apart (0.14) differ most. 1 m if the median is 0, as when all people are at one point.
pub fn default_sigma_m(places_m: &[Vec2]) -> f64 {
    let nearest = |k: usize| {
        let others = places_m.iter().enumerate().filter(|&(l, _)| l != k);
        others.map(|(_, other)| (*other - places_m[k]).length_squared()).fold(f64::INFINITY, f64::min)
    };
    let mut squared: Vec<f64> = (0..places_m.len()).map(nearest).collect();
    squared.sort_by(f64::total_cmp);
    let median = squared.get(squared.len() / 2).copied().unwrap_or(0.0).sqrt();
    if median > 1e-6 && median.is_finite() { median } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;

    #[test]
    fn three_in_a_row_by_hand() {
        let row = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(2.0, 0.0)];
        let k = kirchhoff(&row, 1.0, &[]);
        let (near, far) = (exp(-0.5), exp(-2.0));
        let by_hand = DMatrix::from_row_slice(
            3,
            3,
            &[near + far, -near, -far, -near, 2.0 * near, -near, -far, -near, near + far],
        );
        assert!((k - by_hand).amax() < 1e-15);
        assert_eq!(default_sigma_m(&row), 1.0);
    }

    #[test]
    fn edits_set_pairs_and_rows_still_sum_to_zero() {
        let row: Vec<Vec2> = (0..5).map(|k| vec2(f64::from(k), 0.0)).collect();
        let edit = |members: &[usize], weight| AdjacencyEdit { members: members.to_vec(), weight };
        let k = kirchhoff(&row, 1.0, &[edit(&[0, 2, 4], 3.0), edit(&[4, 0], 0.5)]);
        assert_eq!((k[(0, 2)], k[(2, 4)], k[(4, 0)], k[(0, 4)]), (-3.0, -3.0, -0.5, -0.5));
        assert!(k.row_sum().amax() < 1e-14);
        assert!(check_edits(&[edit(&[0, 1], 1.0)], 2).is_ok());
        for (members, weight) in [(&[0][..], 1.0), (&[0, 2], 1.0), (&[1, 1], 1.0), (&[0, 1], -1.0), (&[0, 1], f64::NAN)]
        {
            let error = check_edits(&[edit(members, weight)], 2).unwrap_err();
            assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn sigma_falls_back_where_there_is_no_distance() {
        assert_eq!(default_sigma_m(&[vec2(3.0, 4.0); 7]), 1.0);
        assert_eq!(default_sigma_m(&[vec2(3.0, 4.0)]), 1.0);
        assert_eq!(default_sigma_m(&[]), 1.0);
    }
}
