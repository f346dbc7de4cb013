use super::*;
use crate::math::{SplitMix64, Vec2, vec2};

fn random(n: usize, seed: u64) -> DMatrix<f64> {
    let mut words = SplitMix64::new(seed);
    let matrix = DMatrix::from_fn(n, n, |_, _| f64::from(words.normal()));
    &matrix + matrix.transpose()
}

fn grid(people: usize, columns: usize) -> Vec<Vec2> {
    (0..people).map(|k| vec2((k % columns) as f64, (k / columns) as f64)).collect()
}

/// Whether vectors and values are those of the matrix, to rounding.
fn check(matrix: &DMatrix<f64>, what: &str) {
    let n = matrix.nrows();
    let (vectors, values) = eigenvectors(matrix.clone()).unwrap();
    let scale = matrix.amax().max(f64::MIN_POSITIVE) * n as f64;
    assert!(values.windows(2).all(|pair| pair[0] <= pair[1]), "{what}");
    let off = (vectors.transpose() * &vectors - DMatrix::identity(n, n)).amax();
    assert!(off < 1e-13, "{what}: {off:e} from orthonormal");
    let mut scaled = vectors.clone();
    scaled.column_iter_mut().zip(&values).for_each(|(mut column, &value)| column *= value);
    let off = (matrix * &vectors - scaled).amax() / scale;
    assert!(off < 1e-14, "{what}: {off:e} from eigenvectors");
    let (_, slow) = eigenvectors_by_qr(matrix.clone()).unwrap();
    let off = values.iter().zip(&slow).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale;
    assert!(off < 1e-14, "{what}: {off:e} from the values by rotations");
}

#[test]
fn large_matrices_come_apart_as_small_ones_do() {
    for n in [47, 48, 49, 64, 65, 97, 130, 200] {
        check(&random(n, n as u64), "random");
        check(&(random(n, 7) * 1e-200), "tiny");
        check(&(random(n, 8) * 1e200), "huge");
    }
}

/// Graph Laplacian of places with weights of a Gaussian of 1 m.
fn kirchhoff(places_m: &[Vec2]) -> DMatrix<f64> {
    let weight = |a: Vec2, b: Vec2| crate::math::exp(-0.5 * (a - b).length_squared());
    let n = places_m.len();
    let mut matrix = DMatrix::from_fn(n, n, |i, j| if i == j { 0.0 } else { -weight(places_m[i], places_m[j]) });
    for row in 0..n {
        matrix[(row, row)] = -matrix.row(row).sum();
    }
    matrix
}

#[test]
fn repeated_eigenvalues_are_no_trouble() {
    for (people, columns) in [(64, 8), (100, 10), (150, 30)] {
        check(&kirchhoff(&grid(people, columns)), "grid");
        // Columns far apart: each eigenvalue many times.
        let apart: Vec<Vec2> = grid(people, columns).iter().map(|p| vec2(p.x * 1e3, p.y)).collect();
        check(&kirchhoff(&apart), "groups");
    }
    let n = 90;
    check(&DMatrix::identity(n, n), "identity");
    check(&DMatrix::from_element(n, n, 1.0), "ones");
    check(&DMatrix::zeros(n, n), "zeros");
    check(&DMatrix::from_fn(n, n, |i, j| if i.abs_diff(j) == 1 { 1.0 } else { 0.0 }), "path");
    check(&DMatrix::from_fn(n, n, |i, j| if i == j { i as f64 } else { 0.0 }), "diagonal");
    // Wilkinson's matrix: pairs of eigenvalues that are equal to the last digit, and are not.
    let wilkinson = |i: usize, j: usize| match i.abs_diff(j) {
        0 => (i as f64 - 50.0).abs(),
        1 => 1.0,
        _ => 0.0,
    };
    check(&DMatrix::from_fn(101, 101, wilkinson), "Wilkinson");
    let halved: Vec<f64> = std::iter::successors(Some(1.0), |scale| Some(scale / 2.0)).take(2 * n).collect();
    let graded = random(n, 3).map_with_location(|i, j, entry| entry * halved[i + j]);
    check(&graded, "graded");
}

#[test]
fn numbers_that_are_none_are_refused() {
    for n in [5, 60] {
        let mut matrix = random(n, 1);
        matrix[(2, 3)] = f64::NAN;
        assert!(matches!(eigenvectors(matrix), Err(NoConvergence { .. })));
    }
}
