use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix;

/// Assigns every row a column of its own so that the sum of `cost(row, column)` is least; returns the sum and each row's
/// column.
///
/// There must be at least as many columns as rows. Costs are whole numbers, so that the result is the same on every
/// machine (Kuhn 1955, doi 10.1002/nav.3800020109; Munkres 1957, doi 10.1137/0105003).
pub(crate) fn assign(rows: usize, columns: usize, cost: impl Fn(usize, usize) -> i64) -> (i64, Vec<usize>) {
    if rows == 0 {
        return (0, Vec::new());
    }
    kuhn_munkres_min(&Matrix::from_fn(rows, columns, |(row, column)| cost(row, column)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_costs_is_least() {
        let costs = [[4, 1, 3, 9], [2, 0, 5, 9], [3, 2, 2, 9]];
        assert_eq!(assign(3, 4, |row, column| costs[row][column]), (5, vec![1, 0, 2]));
        assert_eq!(assign(0, 0, |_, _| 1), (0, vec![]));
    }
}
