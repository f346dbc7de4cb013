use pathfinding::kuhn_munkres::{Weights, kuhn_munkres_min};

use crate::math::Vec2;

/// Distances are compared in millimetres.
const PER_METRE: f64 = 1e3;
/// How often the smaller crowd's middle is looked for anew in the larger one.
const TRIES: usize = 5;

/// Pairs the people of two crowds so that the squares of the distances between their places add up to the least: each of
/// the smaller crowd with one of the other. Gives the pairs by ascending number in the first crowd.
///
/// Squares are used because the pairs of two crowds of one size then do not depend on where their middles are put. Where
/// one is larger, the middle of those who have a partner is put on that of the others, and pairs are sought again, until
/// they stay.
pub(super) fn nearest_pairs(first_m: &[Vec2], other_m: &[Vec2]) -> Vec<[usize; 2]> {
    let swapped = first_m.len() > other_m.len();
    let (few, many) = if swapped { (other_m, first_m) } else { (first_m, other_m) };
    if few.is_empty() {
        return Vec::new();
    }
    let mut shift_m = Vec2::ZERO;
    let mut chosen = Vec::new();
    for _ in 0..TRIES {
        let (_, found) = kuhn_munkres_min(&Distances { few, many, shift_m, sign: 1 });
        if found == chosen {
            break;
        }
        chosen = found;
        let apart = few.iter().zip(&chosen).fold(Vec2::ZERO, |sum, (&place, &other)| sum + (many[other] - place));
        shift_m = apart / few.len() as f64;
        if few.len() == many.len() {
            break;
        }
    }
    let pair = |(few, many)| if swapped { [many, few] } else { [few, many] };
    let mut pairs: Vec<[usize; 2]> = chosen.into_iter().enumerate().map(pair).collect();
    pairs.sort_unstable();
    pairs
}

/// Squares of distances between the people of two crowds, the smaller moved a little: computed when asked for.
struct Distances<'a> {
    few: &'a [Vec2],
    many: &'a [Vec2],
    shift_m: Vec2,
    sign: i128,
}

impl Weights<i128> for Distances<'_> {
    fn rows(&self) -> usize {
        self.few.len()
    }

    fn columns(&self) -> usize {
        self.many.len()
    }

    fn at(&self, row: usize, column: usize) -> i128 {
        let apart = self.many[column] - self.few[row] - self.shift_m;
        self.sign * (apart.length_squared() * (PER_METRE * PER_METRE)).round() as i128
    }

    fn neg(&self) -> Self {
        Distances { sign: -self.sign, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;

    fn line(xs: &[f64]) -> Vec<Vec2> {
        xs.iter().map(|&x| vec2(x, 0.0)).collect()
    }

    #[test]
    fn pairs_lie_as_near_as_can_be() {
        let (a, b) = (line(&[0.0, 10.0, 20.0]), line(&[21.0, 1.0, 9.0, 500.0]));
        assert_eq!(nearest_pairs(&a, &b), [[0, 1], [1, 2], [2, 0]]);
        assert_eq!(nearest_pairs(&b, &a), [[0, 2], [1, 0], [2, 1]]);
        assert!(nearest_pairs(&a, &[]).is_empty());
        // The nearest for one would cost another more.
        assert_eq!(nearest_pairs(&line(&[0.0, 1.0]), &line(&[1.1, 5.0])), [[0, 0], [1, 1]]);
    }

    #[test]
    fn people_are_found_in_a_larger_crowd_with_another_middle() {
        let ring = [(3.0, 1.0), (-2.0, 4.0), (-3.0, -3.0), (1.0, -5.0), (0.0, 0.5)].map(|(x, y)| vec2(x, y));
        let mut crowd = vec![vec2(-300.0, 0.0), vec2(250.0, 10.0)];
        crowd.extend(ring.iter().rev().map(|&place| place + vec2(40.0, -30.0)));
        assert_eq!(nearest_pairs(&ring, &crowd), [[0, 6], [1, 5], [2, 4], [3, 3], [4, 2]]);
    }
}
