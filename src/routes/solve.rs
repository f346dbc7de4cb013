/// Residual relative to the right-hand side at which a solution is accurate enough.
const RESIDUAL: f64 = 2e-3;
/// Largest number of iterations.
const MOST_ROUNDS: usize = 500;
/// Share of the dropped fill-in that is added to the diagonal.
const MODIFIED: f64 = 0.97;

/// A symmetric system `diagonal x_i - sum values x_j = b_i`, summed over the neighbours j.
#[derive(Debug, Default)]
pub(super) struct Matrix {
    diagonal: Vec<f64>,
    /// Per row: start of the neighbours before it, start of those after it, and their end.
    bounds: Vec<[u32; 3]>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Matrix {
    /// Builds the matrix from conductances to earth and between rows (both directions).
    pub(super) fn new(earthed: Vec<f64>, edges: Vec<(u32, u32, f64)>) -> Matrix {
        let rows = earthed.len();
        let mut matrix = Matrix { diagonal: earthed, ..Matrix::default() };
        // Each row's edges in their original order, so that sums do not depend on sorting.
        let mut starts = vec![0; rows + 1];
        edges.iter().for_each(|edge| starts[edge.0 as usize + 1] += 1);
        (0..rows).for_each(|row| starts[row + 1] += starts[row]);
        let mut next = starts.clone();
        let mut sorted = vec![(0, 0.0); edges.len()];
        for &(row, column, value) in &edges {
            sorted[next[row as usize]] = (column, value);
            next[row as usize] += 1;
        }
        drop((next, edges));
        for row in 0..rows {
            let own = &mut sorted[starts[row]..starts[row + 1]];
            own.sort_by_key(|edge| edge.0);
            let first = matrix.columns.len();
            for &(column, value) in &*own {
                matrix.diagonal[row] += value;
                if matrix.columns.len() > first && matrix.columns.last() == Some(&column) {
                    let last = matrix.values.len() - 1;
                    matrix.values[last] += value;
                } else {
                    matrix.columns.push(column);
                    matrix.values.push(value);
                }
            }
            let behind = first + matrix.columns[first..].partition_point(|&c| (c as usize) < row);
            matrix.bounds.push([first as u32, behind as u32, matrix.columns.len() as u32]);
        }
        matrix
    }

    /// Neighbours of a row: before it (part 0) or after it (part 1).
    #[inline]
    fn neighbours(&self, row: usize, part: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.bounds[row][part] as usize..self.bounds[row][part + 1] as usize;
        self.columns[range.clone()].iter().zip(&self.values[range]).map(|(&c, &v)| (c as usize, v))
    }

    /// All neighbours of a row.
    pub(super) fn around(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.neighbours(row, 0).chain(self.neighbours(row, 1))
    }

    /// Solves by conjugate gradients with a modified incomplete Cholesky factor. (Gustafsson 1978,
    /// doi 10.1007/BF01931691.)
    pub(super) fn solve(&self, b: &[f64], guess: Vec<f64>) -> Vec<f64> {
        let n = b.len();
        let mut x = guess;
        let mut ax = vec![0.0; n];
        self.times(&x, &mut ax);
        let (energy, work) = (dot(&x, &ax), dot(&x, b));
        if energy > 0.0 {
            let scale = work / energy;
            x.iter_mut().for_each(|v| *v *= scale);
            ax.iter_mut().for_each(|v| *v *= scale);
        }
        let mut r: Vec<f64> = b.iter().zip(&ax).map(|(b, ax)| b - ax).collect();
        let inverse = self.pivots();
        let mut z = vec![0.0; n];
        self.precondition(&inverse, &r, &mut z);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        let enough = RESIDUAL * RESIDUAL * dot(b, b);
        for _ in 0..MOST_ROUNDS {
            if dot(&r, &r) <= enough || rz <= 0.0 {
                break;
            }
            self.times(&p, &mut ax);
            let step = rz / dot(&p, &ax);
            for k in 0..n {
                x[k] += step * p[k];
                r[k] -= step * ax[k];
            }
            self.precondition(&inverse, &r, &mut z);
            let next = dot(&r, &z);
            let turn = next / rz;
            rz = next;
            for k in 0..n {
                p[k] = z[k] + turn * p[k];
            }
        }
        x
    }

    /// Gauss-Seidel relaxation.
    pub(super) fn relax(&self, b: &[f64], x: &mut [f64], rounds: usize) {
        for _ in 0..rounds {
            for row in 0..x.len() {
                x[row] =
                    self.around(row).fold(b[row], |sum, (column, value)| sum + value * x[column]) / self.diagonal[row];
            }
        }
    }

    fn times(&self, x: &[f64], out: &mut [f64]) {
        for (row, out) in out.iter_mut().enumerate() {
            *out = self.around(row).fold(self.diagonal[row] * x[row], |sum, (column, value)| sum - value * x[column]);
        }
    }

    /// Inverse pivots of the incomplete factor. `d_i = a_ii - sum_j<i a_ij (a_ij + dropped_j) / d_j`, where `dropped_j`
    /// is the coupling of row i through row j without an entry in the factor.
    fn pivots(&self) -> Vec<f64> {
        let behind: Vec<f64> =
            (0..self.bounds.len()).map(|row| self.neighbours(row, 1).map(|(_, value)| value).sum()).collect();
        let mut inverse: Vec<f64> = Vec::with_capacity(behind.len());
        for (row, &diagonal) in self.diagonal.iter().enumerate() {
            let mut pivot = diagonal;
            for (j, value) in self.neighbours(row, 0) {
                pivot -= value * (value + MODIFIED * (behind[j] - value)) * inverse[j];
            }
            inverse.push(1.0 / if pivot > 0.05 * diagonal { pivot } else { diagonal.max(1e-12) });
        }
        inverse
    }

    fn precondition(&self, inverse: &[f64], r: &[f64], z: &mut [f64]) {
        for row in 0..r.len() {
            z[row] = self.neighbours(row, 0).fold(r[row], |sum, (j, value)| sum + value * z[j]) * inverse[row];
        }
        for row in (0..r.len()).rev() {
            z[row] += self.neighbours(row, 1).fold(0.0, |sum, (j, value)| sum + value * z[j]) * inverse[row];
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of resistors, earthed along one side.
    fn grid(side: usize) -> Matrix {
        let mut edges = Vec::new();
        for row in 0..side {
            for column in 0..side {
                let own = (row * side + column) as u32;
                let conductance = |k: u32| 1.0 + f64::from(k % 7);
                if column + 1 < side {
                    edges.push((own, own + 1, conductance(own)));
                    edges.push((own + 1, own, conductance(own)));
                }
                if row + 1 < side {
                    edges.push((own, own + side as u32, 2.0));
                    edges.push((own + side as u32, own, 2.0));
                }
            }
        }
        let earthed: Vec<f64> = (0..side * side).map(|k| f64::from(u8::from(k % side == 0))).collect();
        Matrix::new(earthed, edges)
    }

    #[test]
    fn a_solution_solves_the_system() {
        let matrix = grid(60);
        let b: Vec<f64> = (0..3600).map(|k| f64::from(u8::from(k % 60 == 59)) / 60.0).collect();
        let x = matrix.solve(&b, vec![0.0; 3600]);
        let mut ax = vec![0.0; 3600];
        matrix.times(&x, &mut ax);
        let off: f64 = ax.iter().zip(&b).map(|(ax, b)| (ax - b) * (ax - b)).sum();
        assert!(off.sqrt() <= 2.0 * RESIDUAL * dot(&b, &b).sqrt(), "{}", off.sqrt());
    }
}
