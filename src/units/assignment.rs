use crate::math::assign;

/// Costs are compared in whole millionths, so that no machine rounds them otherwise.
const PER_UNIT: f64 = 1e6;
/// Cost of a forbidden pair: more than any sum of real costs.
const FORBIDDEN: i64 = 1 << 50;

/// Assigns every row a column of its own so that the sum of `cost(row, column)` is least; a cost of `None` forbids a pair.
///
/// Returns the sum and each row's column; `None` if every assignment has a forbidden pair.
pub(super) fn assign_allowed(count: usize, cost: impl Fn(usize, usize) -> Option<f64>) -> Option<(f64, Vec<usize>)> {
    let whole = |row, column| match cost(row, column) {
        Some(cost) => ((cost * PER_UNIT).round() as i64).clamp(0, FORBIDDEN),
        None => FORBIDDEN,
    };
    let (sum, columns) = assign(count, count, whole);
    (sum < FORBIDDEN).then(|| (sum as f64 / PER_UNIT, columns))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_least_and_forbidden_pairs_are_left() {
        let costs = [[4.0, 1.0, 3.0], [2.0, 0.0, 5.0], [3.0, 2.0, 2.0]];
        assert_eq!(assign_allowed(3, |r, c| Some(costs[r][c])), Some((5.0, vec![1, 0, 2])));
        let (sum, columns) = assign_allowed(3, |r, c| (r != 0 || c == 2).then_some(costs[r][c])).unwrap();
        assert_eq!((sum, columns), (6.0, vec![2, 1, 0]));
        assert_eq!(assign_allowed(3, |r, c| (c == 0 || r == 2).then_some(costs[r][c])), None);
        assert_eq!(assign_allowed(0, |_, _| None), Some((0.0, vec![])));
    }
}
