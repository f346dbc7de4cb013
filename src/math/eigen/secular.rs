use nalgebra::DMatrix;

/// Steps in which a root is found; five or six do.
const STEPS: usize = 100;

/// The eigenvectors and eigenvalues of `D + rho z z^T` with ascending, different entries of the diagonal `D`, no entry of `z`
/// zero, and `rho` above 0; eigenvectors as columns.
///
/// Each eigenvalue is a root of `1 + rho sum of z_j^2 / (d_j - x)` between two neighbours in `D`. Vectors are taken of the `z` to
/// which the roots as found belong exactly (Gu, Eisenstat 1994, doi 10.1137/S089547989223924X): they are orthogonal however near
/// roots are.
pub(super) fn rank_one(d: &[f64], z: &[f64], rho: f64) -> (DMatrix<f64>, Vec<f64>) {
    let n = d.len();
    // d_j - x_i, exact where the difference is small; a column for each root.
    let mut apart = DMatrix::zeros(n, n);
    let mut values = Vec::with_capacity(n);
    for i in 0..n {
        let (origin, offset) = root(d, z, rho, i);
        values.push(d[origin] + offset);
        for (apart, &pole) in apart.column_mut(i).iter_mut().zip(d) {
            *apart = (pole - d[origin]) - offset;
        }
    }
    let mut exact: Vec<f64> = (0..n).map(|j| apart[(j, j)]).collect();
    for i in 0..n {
        let column = apart.column(i);
        for (j, exact) in exact.iter_mut().enumerate() {
            if j != i {
                *exact *= column[j] / (d[j] - d[i]);
            }
        }
    }
    for (exact, &z) in exact.iter_mut().zip(z) {
        *exact = exact.abs().sqrt().copysign(z);
    }
    for mut column in apart.column_iter_mut() {
        column.iter_mut().zip(&exact).for_each(|(entry, &z)| *entry = z / *entry);
        let length = column.norm();
        column /= length;
    }
    (apart, values)
}

/// A function's value and slope, those of poles up to one and those beyond apart.
struct SecularValue {
    value: f64,
    size: f64,
    slope_below: f64,
    slope_above: f64,
}

/// The root after pole `i`: the pole that it is measured from, and how far from it.
fn root(d: &[f64], z: &[f64], rho: f64, i: usize) -> (usize, f64) {
    let n = d.len();
    if n == 1 {
        return (0, rho * z[0] * z[0]);
    }
    let last = i + 1 == n;
    let all = rho * z.iter().map(|z| z * z).sum::<f64>();
    // Poles that the function is told by: those on both sides, for the last root the last two.
    let (left, right) = if last { (n - 2, n - 1) } else { (i, i + 1) };
    let look = |origin: usize, at: f64| -> SecularValue {
        let mut seen = SecularValue { value: 1.0, size: 1.0, slope_below: 0.0, slope_above: 0.0 };
        for (j, (&pole, &z)) in d.iter().zip(z).enumerate() {
            let share = z / ((pole - d[origin]) - at);
            let term = rho * z * share;
            seen.value += term;
            seen.size += term.abs();
            if j <= left {
                seen.slope_below += rho * share * share;
            } else {
                seen.slope_above += rho * share * share;
            }
        }
        seen
    };
    let (origin, mut low, mut high) = if last {
        (i, 0.0, all)
    } else {
        let half = (d[i + 1] - d[i]) / 2.0;
        if look(i, half).value >= 0.0 { (i, 0.0, half) } else { (i + 1, half - (d[i + 1] - d[i]), 0.0) }
    };
    let mut at = low / 2.0 + high / 2.0;
    let mut width_before = f64::INFINITY;
    for step in 0..STEPS {
        let seen = look(origin, at);
        if seen.value.abs() <= f64::EPSILON * seen.size || !(low < at && at < high) {
            break;
        }
        if seen.value > 0.0 {
            high = at
        } else {
            low = at
        }
        // Both sides as one pole with the same value and slope each: a quadratic equation.
        let (a, b) = ((d[left] - d[origin]) - at, (d[right] - d[origin]) - at);
        let (q, s) = (seen.slope_below * a * a, seen.slope_above * b * b);
        let c = seen.value - seen.slope_below * a - seen.slope_above * b;
        let (linear, constant) = (c * (a + b) + q + s, a * b * seen.value);
        let root = (linear * linear - 4.0 * c * constant).max(0.0).sqrt();
        let by = match (last, linear <= 0.0) {
            (false, true) => (linear - root) / (2.0 * c),
            (false, false) => 2.0 * constant / (linear + root),
            (true, false) => (linear + root) / (2.0 * c),
            (true, true) => 2.0 * constant / (linear - root),
        };
        let next = at + by;
        // Halved where that leads outside, or has not narrowed it down for a while.
        let slow = step % 8 == 7 && high - low > width_before / 2.0;
        if step % 8 == 7 {
            width_before = high - low;
        }
        let next = if next > low && next < high && !slow { next } else { low / 2.0 + high / 2.0 };
        if next == at {
            break;
        }
        at = next;
    }
    (origin, at)
}
