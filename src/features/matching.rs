use super::error::FeaturesError;
use super::progress_range::ProgressRange;
use crate::math::{Vec2, assign};

/// Cost of the largest squared distance; the sum of a million of them still fits.
const UNITS: f64 = (1u64 << 40) as f64;
/// Most rounds of aligning the smaller crowd's centroid with its partners'.
const TRIES: usize = 5;

/// Pairs the people of two crowds with the least sum of squared distances, ascending in the first crowd.
///
/// Each person of the smaller crowd gets a partner. With squares, the pairs of crowds of one size do not depend on where
/// the crowds are. If one is larger, the smaller crowd is moved onto the centroid of its partners and paired again, until
/// the pairs stay the same. Squares are rounded to 2^-40 of the largest, so that the order of sums does not matter.
///
/// # Errors
/// [`FeaturesError::Interrupted`].
pub(super) fn nearest_pairs(
    first_m: &[Vec2],
    other_m: &[Vec2],
    progress: &ProgressRange<'_>,
) -> Result<Vec<[usize; 2]>, FeaturesError> {
    let swapped = first_m.len() > other_m.len();
    let (few, many) = if swapped { (other_m, first_m) } else { (first_m, other_m) };
    if few.is_empty() {
        return Ok(Vec::new());
    }
    let mut shift_m = Vec2::ZERO;
    let mut chosen = Vec::new();
    let tries = if few.len() == many.len() { 1 } else { TRIES };
    for number in 0..tries {
        progress.keep_on()?;
        progress.advance(number as f64 / tries as f64);
        let found = nearest_columns(few, many, shift_m);
        if found == chosen {
            break;
        }
        chosen = found;
        let apart = few.iter().zip(&chosen).fold(Vec2::ZERO, |sum, (&place, &other)| sum + (many[other] - place));
        shift_m = apart / few.len() as f64;
    }
    progress.advance(1.0);
    let pair = |(few, many)| if swapped { [many, few] } else { [few, many] };
    let mut pairs: Vec<[usize; 2]> = chosen.into_iter().enumerate().map(pair).collect();
    pairs.sort_unstable();
    Ok(pairs)
}

/// Assigns each place of the smaller crowd, shifted, one of the larger crowd with the least sum of squared distances.
fn nearest_columns(few: &[Vec2], many: &[Vec2], shift_m: Vec2) -> Vec<usize> {
    let square_m2 = |row: usize, column: usize| (many[column] - few[row] - shift_m).length_squared();
    let rows = (0..few.len()).flat_map(|row| (0..many.len()).map(move |column| (row, column)));
    let largest_m2 = rows.map(|(row, column)| square_m2(row, column)).fold(f64::MIN_POSITIVE, f64::max);
    assign(few.len(), many.len(), |row, column| (square_m2(row, column) / largest_m2 * UNITS).round() as i64).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::progress::{Progress, Silent};

    fn nearest_pairs(first_m: &[Vec2], other_m: &[Vec2]) -> Vec<[usize; 2]> {
        super::nearest_pairs(first_m, other_m, &ProgressRange::whole(&Silent)).unwrap()
    }

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

    #[test]
    fn crowds_on_one_point_or_far_away_are_paired_too() {
        assert_eq!(nearest_pairs(&[Vec2::ZERO; 3], &[Vec2::ZERO; 3]).len(), 3);
        assert_eq!(nearest_pairs(&line(&[1e8, -1e8]), &line(&[-1e8, 0.0, 1e8])), [[0, 2], [1, 0]]);
    }

    #[test]
    fn matching_shows_progress_and_can_be_interrupted() {
        /// Stops at the second look.
        #[derive(Default)]
        struct Stop(std::sync::Mutex<Vec<f64>>);
        impl Progress for Stop {
            fn advance(&self, _: crate::Stage, share: f64) {
                self.0.lock().unwrap().push(share);
            }
            fn warn(&self, _: &str) {}
            fn interrupted(&self) -> bool {
                !self.0.lock().unwrap().is_empty()
            }
        }
        // A smaller crowd is sought more than once.
        let (few, many, stop) = (line(&[0.0, 1.0]), line(&[-8.0, 5.0, 6.0, 7.0]), Stop::default());
        let error = super::nearest_pairs(&few, &many, &ProgressRange::whole(&stop)).unwrap_err();
        assert!(matches!(error, FeaturesError::Interrupted(_)));
        assert_eq!(*stop.0.lock().unwrap(), [0.0]);
    }
}
