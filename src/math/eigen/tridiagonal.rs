use nalgebra::{DMatrix, DMatrixView};

/// Columns that are taken together: within a block column by column, then the rest of the matrix at once.
const BLOCK: usize = 32;

/// A symmetric matrix as `Q T Q^T` with a tridiagonal `T`: `Q` is a product of Householder reflections, `1 - s v v^T` each.
///
/// Blocked as in Dongarra, Hammarling, Sorensen 1989 (doi 10.1016/0377-0427(89)90367-1): half of the work are products
/// of matrices.
pub(super) struct Tridiagonal {
    /// Of `T`.
    pub diagonal: Vec<f64>,
    /// Beside the diagonal of `T`.
    pub beside: Vec<f64>,
    /// `v`, a column each; the entries up to and with the diagonal are 0.
    reflections: DMatrix<f64>,
    /// `s` of each.
    scales: Vec<f64>,
}

impl Tridiagonal {
    /// Reduces a symmetric matrix of at least two rows; only what is on and below the diagonal counts at first.
    pub fn of(mut matrix: DMatrix<f64>) -> Tridiagonal {
        let n = matrix.nrows();
        let mut reduced = Tridiagonal {
            diagonal: vec![0.0; n],
            beside: vec![0.0; n - 1],
            reflections: DMatrix::zeros(n, n - 1),
            scales: vec![0.0; n - 1],
        };
        let mut start = 0;
        while start + 1 < n {
            let width = BLOCK.min(n - 1 - start);
            let weighed = reduced.block(&matrix, start, width);
            let rest = start + width;
            let size = n - rest;
            // The rest less V W^T + W V^T, in one product.
            let reflections = reduced.reflections.view((rest, start), (size, width));
            let mut left = DMatrix::zeros(size, 2 * width);
            left.columns_mut(0, width).copy_from(&reflections);
            left.columns_mut(width, width).copy_from(&weighed.rows(rest, size));
            let mut right = DMatrix::zeros(2 * width, size);
            right.rows_mut(0, width).copy_from(&weighed.rows(rest, size).transpose());
            right.rows_mut(width, width).copy_from(&reflections.transpose());
            matrix.view_mut((rest, rest), (size, size)).gemm(-1.0, &left, &right, 1.0);
            start = rest;
        }
        reduced.diagonal[n - 1] = matrix[(n - 1, n - 1)];
        reduced
    }

    /// Reduces `width` columns from `start` on, with the matrix as it was before them; gives what each reflection takes
    /// from the rest besides itself (W).
    fn block(&mut self, matrix: &DMatrix<f64>, start: usize, width: usize) -> DMatrix<f64> {
        let n = matrix.nrows();
        let mut weighed: DMatrix<f64> = DMatrix::zeros(n, width);
        for k in 0..width {
            let column = start + k;
            let mut now: Vec<f64> = matrix.column(column).as_slice()[column..].to_vec();
            for earlier in 0..k {
                let (v, w) = (self.reflections.column(start + earlier), weighed.column(earlier));
                let (v, w) = (&v.as_slice()[column..], &w.as_slice()[column..]);
                add(&mut now, v, -w[0]);
                add(&mut now, w, -v[0]);
            }
            self.diagonal[column] = now[0];
            let (scale, beside) = reflect(&mut now[1..]);
            (self.scales[column], self.beside[column]) = (scale, beside);
            let below = column + 1;
            let v = &now[1..];
            self.reflections.column_mut(column).as_mut_slice()[below..].copy_from_slice(v);
            let mut w = times(matrix, below, v);
            for earlier in 0..k {
                let (v0, w0) = (self.reflections.column(start + earlier), weighed.column(earlier));
                let (v0, w0) = (&v0.as_slice()[below..], &w0.as_slice()[below..]);
                let (along_w, along_v) = (dot(w0, v), dot(v0, v));
                add(&mut w, v0, -along_w);
                add(&mut w, w0, -along_v);
            }
            w.iter_mut().for_each(|entry| *entry *= scale);
            let along = -0.5 * scale * dot(&w, v);
            add(&mut w, v, along);
            weighed.column_mut(k).as_mut_slice()[below..].copy_from_slice(&w);
        }
        weighed
    }

    /// `Q M`: brings vectors of `T` back to those of the matrix. Reflections go by blocks, `1 - V S V^T` each (Schreiber,
    /// Van Loan 1989, doi 10.1137/0910005).
    pub fn carry_back(&self, mut vectors: DMatrix<f64>) -> DMatrix<f64> {
        let n = vectors.nrows();
        let starts: Vec<usize> = (0..n - 1).step_by(BLOCK).collect();
        for &start in starts.iter().rev() {
            let width = BLOCK.min(n - 1 - start);
            let below = start + 1;
            let v: DMatrixView<f64> = self.reflections.view((below, start), (n - below, width));
            let transposed = v.transpose();
            let inner = &transposed * v;
            let mut s = DMatrix::zeros(width, width);
            for k in 0..width {
                let scale = self.scales[start + k];
                s[(k, k)] = scale;
                if k > 0 {
                    let column = s.view((0, 0), (k, k)) * inner.view((0, k), (k, 1)) * -scale;
                    s.view_mut((0, k), (k, 1)).copy_from(&column);
                }
            }
            let taken = s * (transposed * vectors.rows(below, n - below));
            vectors.rows_mut(below, n - below).gemm(-1.0, &v, &taken, 1.0);
        }
        vectors
    }
}

/// Makes a vector the `v` of the reflection that leaves only its first entry; gives `s` and what becomes of that entry.
fn reflect(vector: &mut [f64]) -> (f64, f64) {
    let first = vector[0];
    let below = dot(&vector[1..], &vector[1..]);
    if below == 0.0 {
        vector[0] = 1.0;
        return (0.0, first);
    }
    let length = (first * first + below).sqrt();
    let becomes = if first > 0.0 { -length } else { length };
    let scale = 1.0 / (first - becomes);
    vector[1..].iter_mut().for_each(|entry| *entry *= scale);
    vector[0] = 1.0;
    ((becomes - first) / becomes, becomes)
}

/// The product of a vector and the part of a symmetric matrix from row and column `from` on; four columns at a time.
fn times(matrix: &DMatrix<f64>, from: usize, vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; vector.len()];
    let (rows, whole) = (matrix.nrows(), matrix.as_slice());
    let column = |k: usize| &whole[(from + k) * rows + from..(from + k + 1) * rows];
    let mut chunks = vector.chunks_exact(4);
    for (number, chunk) in chunks.by_ref().enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| column(4 * number + k));
        let entries = product.iter_mut().zip(a).zip(b).zip(c).zip(d);
        for ((((sum, a), b), c), d) in entries {
            *sum += (a * chunk[0] + b * chunk[1]) + (c * chunk[2] + d * chunk[3]);
        }
    }
    let done = vector.len() - chunks.remainder().len();
    for (k, &entry) in chunks.remainder().iter().enumerate() {
        add(&mut product, column(done + k), entry);
    }
    product
}

fn add(to: &mut [f64], from: &[f64], factor: f64) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += from * factor);
}

/// In four sums at a time, which compilers make one.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
