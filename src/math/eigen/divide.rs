use nalgebra::DMatrix;

use super::error::NoConvergence;
use super::qr::eigenvectors_by_qr;
use super::secular::rank_one;

/// Up to so many rows it is not divided any more.
const SMALL: usize = 32;

/// Eigenvectors (columns) and eigenvalues, ascending, of a tridiagonal matrix: it is torn in two halves, and what the halves
/// have is put together (Cuppen 1981, doi 10.1007/BF01396757).
pub(super) fn conquer(diagonal: &[f64], beside: &[f64]) -> Result<(DMatrix<f64>, Vec<f64>), NoConvergence> {
    let n = diagonal.len();
    if n <= SMALL {
        let mut matrix = DMatrix::zeros(n, n);
        for k in 0..n {
            matrix[(k, k)] = diagonal[k];
            if k + 1 < n {
                matrix[(k + 1, k)] = beside[k];
                matrix[(k, k + 1)] = beside[k];
            }
        }
        return eigenvectors_by_qr(matrix);
    }
    let half = n / 2;
    let torn = beside[half - 1];
    let [mut first, mut second] = [diagonal[..half].to_vec(), diagonal[half..].to_vec()];
    first[half - 1] -= torn.abs();
    second[0] -= torn.abs();
    let halves = [conquer(&first, &beside[..half - 1])?, conquer(&second, &beside[half..])?];
    Ok(Merge::of(halves, torn).merged())
}

/// Where a column has entries that are not zero: in the upper half, in both, in the lower.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Half {
    Upper,
    Both,
    Lower,
}

/// Two halves with what was torn: `D + rho z z^T` in the vectors of the halves.
struct Merge {
    half: usize,
    vectors: DMatrix<f64>,
    parts: Vec<Half>,
    d: Vec<f64>,
    z: Vec<f64>,
    rho: f64,
}

impl Merge {
    fn of([(first, first_d), (second, second_d)]: [(DMatrix<f64>, Vec<f64>); 2], torn: f64) -> Merge {
        let (half, n) = (first_d.len(), first_d.len() + second_d.len());
        let mut order: Vec<usize> = (0..n).collect();
        let both: Vec<f64> = first_d.into_iter().chain(second_d).collect();
        order.sort_by(|&a, &b| both[a].total_cmp(&both[b]));
        let mut merge = Merge {
            half,
            vectors: DMatrix::zeros(n, n),
            parts: Vec::with_capacity(n),
            d: order.iter().map(|&from| both[from]).collect(),
            z: Vec::with_capacity(n),
            rho: 2.0 * torn.abs(),
        };
        for (to, from) in order.into_iter().enumerate() {
            let mut column = merge.vectors.column_mut(to);
            if from < half {
                column.rows_mut(0, half).copy_from(&first.column(from));
                merge.parts.push(Half::Upper);
                merge.z.push(first[(half - 1, from)] * std::f64::consts::FRAC_1_SQRT_2);
            } else {
                column.rows_mut(half, n - half).copy_from(&second.column(from - half));
                merge.parts.push(Half::Lower);
                let sign = if torn < 0.0 { -1.0 } else { 1.0 };
                merge.z.push(sign * second[(0, from - half)] * std::f64::consts::FRAC_1_SQRT_2);
            }
        }
        merge
    }

    /// Columns that the torn entry still works on, ascending. The others are eigenvectors already: those that have no part in
    /// it, and of two with nearly the same eigenvalue one, once they have been turned so that it has none (Dongarra,
    /// Sorensen 1987, doi 10.1137/0908018).
    fn concerned(&mut self) -> Vec<usize> {
        let most = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let within = 8.0 * f64::EPSILON * most(&self.d).max(most(&self.z));
        let mut concerned: Vec<usize> = Vec::new();
        for now in 0..self.d.len() {
            if self.rho * self.z[now].abs() <= within {
                continue;
            }
            if let Some(&before) = concerned.last() {
                let length = (self.z[before] * self.z[before] + self.z[now] * self.z[now]).sqrt();
                let (cosine, sine) = (self.z[now] / length, -self.z[before] / length);
                let apart = self.d[now] - self.d[before];
                if (apart * cosine * sine).abs() <= within {
                    self.turn(before, now, [cosine, sine]);
                    (self.z[before], self.z[now]) = (0.0, length);
                    concerned.pop();
                }
            }
            concerned.push(now);
        }
        concerned
    }

    fn turn(&mut self, before: usize, now: usize, [cosine, sine]: [f64; 2]) {
        let [a, b] = [self.d[before], self.d[now]];
        self.d[before] = a * cosine * cosine + b * sine * sine;
        self.d[now] = a * sine * sine + b * cosine * cosine;
        let (mut x, mut y) = self.vectors.columns_range_pair_mut(before..=before, now..=now);
        for (x, y) in x.iter_mut().zip(y.iter_mut()) {
            (*x, *y) = (cosine * *x + sine * *y, cosine * *y - sine * *x);
        }
        if self.parts[before] != self.parts[now] {
            (self.parts[before], self.parts[now]) = (Half::Both, Half::Both);
        }
    }

    fn merged(mut self) -> (DMatrix<f64>, Vec<f64>) {
        let n = self.d.len();
        let concerned = self.concerned();
        let mut values = self.d.clone();
        if !concerned.is_empty() {
            let of = |values: &[f64]| -> Vec<f64> { concerned.iter().map(|&k| values[k]).collect() };
            let (inner, found) = rank_one(&of(&self.d), &of(&self.z), self.rho);
            let products = [(Half::Upper, 0..self.half), (Half::Lower, self.half..n)].map(|(part, rows)| {
                let own = |&k: &usize| self.parts[concerned[k]] == part || self.parts[concerned[k]] == Half::Both;
                let inner_rows: Vec<usize> = (0..concerned.len()).filter(own).collect();
                let columns: Vec<usize> = inner_rows.iter().map(|&k| concerned[k]).collect();
                let vectors = self.vectors.rows(rows.start, rows.len()).select_columns(&columns);
                vectors * inner.select_rows(&inner_rows)
            });
            for (k, &to) in concerned.iter().enumerate() {
                values[to] = found[k];
                self.vectors.column_mut(to).rows_mut(0, self.half).copy_from(&products[0].column(k));
                self.vectors.column_mut(to).rows_mut(self.half, n - self.half).copy_from(&products[1].column(k));
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        (self.vectors.select_columns(&order), order.into_iter().map(|k| values[k]).collect())
    }
}
