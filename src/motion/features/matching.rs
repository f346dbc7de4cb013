use super::part::Part;
use crate::Error;
use crate::math::Vec2;

/// What squares of distances are counted in: the largest is so many units, and a thousand of them still fit.
const UNITS: f64 = (1u64 << 48) as f64;
/// How often the smaller crowd's middle is looked for anew in the larger one.
const TRIES: usize = 5;
const NOBODY: usize = usize::MAX;

/// Pairs the people of two crowds so that the squares of the distances between their places add up to the least: each of
/// the smaller crowd with one of the other. Gives the pairs by ascending number in the first crowd.
///
/// Squares are used because the pairs of two crowds of one size then do not depend on where their middles are put. Where
/// one is larger, the middle of those who have a partner is put on that of the others, and pairs are sought again, until
/// they stay. Squares are rounded to 2^-48 of the largest, so that nothing hangs on the order of sums.
///
/// # Errors
/// [`Error::Interrupted`].
pub(super) fn nearest_pairs(first_m: &[Vec2], other_m: &[Vec2], part: &Part<'_>) -> Result<Vec<[usize; 2]>, Error> {
    let swapped = first_m.len() > other_m.len();
    let (few, many) = if swapped { (other_m, first_m) } else { (first_m, other_m) };
    if few.is_empty() {
        return Ok(Vec::new());
    }
    let mut shift_m = Vec2::ZERO;
    let mut chosen = Vec::new();
    let tries = if few.len() == many.len() { 1 } else { TRIES };
    for number in 0..tries {
        let within = part.part(number as f64 / tries as f64, (number + 1) as f64 / tries as f64);
        let found = assign(&squares(few, many, shift_m), [few.len(), many.len()], &within)?;
        if found == chosen {
            break;
        }
        chosen = found;
        let apart = few.iter().zip(&chosen).fold(Vec2::ZERO, |sum, (&place, &other)| sum + (many[other] - place));
        shift_m = apart / few.len() as f64;
    }
    part.advance(1.0);
    let pair = |(few, many)| if swapped { [many, few] } else { [few, many] };
    let mut pairs: Vec<[usize; 2]> = chosen.into_iter().enumerate().map(pair).collect();
    pairs.sort_unstable();
    Ok(pairs)
}

/// Squares of the distances between the people of two crowds, the smaller moved a little, row by row.
fn squares(few: &[Vec2], many: &[Vec2], shift_m: Vec2) -> Vec<i64> {
    let apart = |&place: &Vec2| many.iter().map(move |&other| (other - place - shift_m).length_squared());
    let squares_m2: Vec<f64> = few.iter().flat_map(apart).collect();
    let largest_m2 = squares_m2.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    squares_m2.iter().map(|square_m2| (square_m2 / largest_m2 * UNITS).round() as i64).collect()
}

/// Gives every row a column of its own such that the costs add up to the least; there are at least as many columns as rows.
///
/// Kuhn 1955, Munkres 1957, with one shortest path after the other (Edmonds, Karp 1972): each row in turn gets a column
/// by the cheapest chain of rows that move on to another one. Time grows with the square of the rows times the columns.
fn assign(costs: &[i64], [rows, columns]: [usize; 2], part: &Part<'_>) -> Result<Vec<usize>, Error> {
    let mut prices = Prices { of_row: vec![0; rows], of_column: vec![0; columns], row_at: vec![NOBODY; columns] };
    for row in 0..rows {
        if part.interrupted() {
            return Err(Error::Interrupted);
        }
        part.advance(row as f64 / rows as f64);
        prices.find_way(costs, row);
    }
    let mut column_of = vec![NOBODY; rows];
    for (column, &row) in prices.row_at.iter().enumerate().filter(|(_, row)| **row != NOBODY) {
        column_of[row] = column;
    }
    Ok(column_of)
}

/// A half-finished assignment: nobody could do better at these prices.
struct Prices {
    of_row: Vec<i64>,
    of_column: Vec<i64>,
    /// The row that has a column.
    row_at: Vec<usize>,
}

impl Prices {
    /// Gives a row a column by the cheapest chain of rows that move on.
    fn find_way(&mut self, costs: &[i64], first: usize) {
        let columns = self.row_at.len();
        let mut dearer = vec![i64::MAX; columns];
        // The column from which one came to each; its own for the first row's.
        let mut came_from = vec![NOBODY; columns];
        let mut reached: Vec<usize> = Vec::new();
        let mut open: Vec<usize> = (0..columns).collect();
        let (mut row, mut from) = (first, NOBODY);
        let end = loop {
            let mut nearest = (i64::MAX, 0);
            for (at, &column) in open.iter().enumerate() {
                let more = costs[row * columns + column] - self.of_row[row] - self.of_column[column];
                if more < dearer[column] {
                    (dearer[column], came_from[column]) = (more, from);
                }
                if dearer[column] < nearest.0 {
                    nearest = (dearer[column], at);
                }
            }
            let (step, column) = (nearest.0, open.swap_remove(nearest.1));
            // Prices move so that the next column costs nothing more.
            self.of_row[first] += step;
            for &column in &reached {
                self.of_column[column] -= step;
                self.of_row[self.row_at[column]] += step;
            }
            open.iter().for_each(|&column| dearer[column] -= step);
            reached.push(column);
            (row, from) = (self.row_at[column], column);
            if row == NOBODY {
                break column;
            }
        };
        let mut column = end;
        while came_from[column] != NOBODY {
            self.row_at[column] = self.row_at[came_from[column]];
            column = came_from[column];
        }
        self.row_at[column] = first;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::progress::{Progress, Silent};
    use proptest::prelude::*;

    fn nearest_pairs(first_m: &[Vec2], other_m: &[Vec2]) -> Vec<[usize; 2]> {
        super::nearest_pairs(first_m, other_m, &Part::whole(&Silent)).unwrap()
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
        /// Stops at the third look.
        #[derive(Default)]
        struct Stop(std::sync::Mutex<Vec<f64>>);
        impl Progress for Stop {
            fn advance(&self, _: crate::Stage, share: f64) {
                self.0.lock().unwrap().push(share);
            }
            fn warn(&self, _: &str) {}
            fn interrupted(&self) -> bool {
                self.0.lock().unwrap().len() >= 3
            }
        }
        let (many, stop) = (line(&[3.0; 50]), Stop::default());
        let error = super::nearest_pairs(&many, &many, &Part::whole(&stop)).unwrap_err();
        assert!(matches!(error, Error::Interrupted));
        assert_eq!(*stop.0.lock().unwrap(), [0.0, 0.02, 0.04]);
    }

    proptest! {
        #[test]
        fn no_pairs_are_nearer(costs in prop::collection::vec(0i64..20, 12), columns in prop::sample::select(vec![3usize, 4])) {
            let rows = if columns == 3 { 3 } else { 2 };
            let sum = |of: &[usize]| of.iter().enumerate().map(|(row, &column)| costs[row * columns + column]).sum::<i64>();
            let found = assign(&costs[..rows * columns], [rows, columns], &Part::whole(&Silent)).unwrap();
            let mut least = i64::MAX;
            for code in 0..columns.pow(rows as u32) {
                let of: Vec<usize> = (0..rows).map(|row| code / columns.pow(row as u32) % columns).collect();
                if (0..rows).all(|row| !of[..row].contains(&of[row])) {
                    least = least.min(sum(&of));
                }
            }
            prop_assert_eq!(sum(&found), least);
        }
    }
}
