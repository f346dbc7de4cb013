//! Rotations taken apart: all that a Schur iteration stumbles over.

use super::crowds::Dice;
use nalgebra::DMatrix;
use trodden::formation::Rotation;

/// How far the parts are from making up the whole.
fn residual(matrix: &DMatrix<f64>) -> f64 {
    let rotation = Rotation::of(matrix).unwrap();
    let n = matrix.nrows();
    let one = DMatrix::<f64>::identity(n, n);
    let mut off = (rotation.power(1.0) - matrix).amax().max((rotation.power(0.0) - &one).amax());
    let third = rotation.power(1.0 / 3.0);
    off = off.max((&third * &third * &third - matrix).amax());
    off = off.max((third.transpose() * &third - &one).amax());
    assert!(rotation.angles_rad().iter().all(|&angle| angle > 0.0 && angle <= std::f64::consts::PI));
    off
}

fn permutation(of: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(of.len(), of.len(), |row, column| if of[column] == row { 1.0 } else { 0.0 })
}

/// A random orthogonal matrix of determinant 1.
fn random_basis(n: usize, dice: &mut Dice) -> DMatrix<f64> {
    let mut q = DMatrix::from_fn(n, n, |_, _| dice.next()).qr().q();
    if q.determinant() < 0.0 {
        q.column_mut(0).neg_mut();
    }
    q
}

/// Turns by given angles in planes that lie anywhere.
fn turning_by(angles_rad: &[f64], still: usize, dice: &mut Dice) -> DMatrix<f64> {
    let n = 2 * angles_rad.len() + still;
    let mut turns = DMatrix::identity(n, n);
    for (p, &angle) in angles_rad.iter().enumerate() {
        let (sine, cosine) = trodden::math::sin_cos(angle);
        turns[(2 * p, 2 * p)] = cosine;
        turns[(2 * p + 1, 2 * p + 1)] = cosine;
        turns[(2 * p, 2 * p + 1)] = -sine;
        turns[(2 * p + 1, 2 * p)] = sine;
    }
    let q = random_basis(n, dice);
    &q * turns * q.transpose()
}

#[test]
fn a_ring_moves_on() {
    for n in 2..=40 {
        for step in [1, 2, n / 2] {
            let mut ring = permutation(&(0..n).map(|k| (k + step) % n).collect::<Vec<_>>());
            if ring.determinant() < 0.0 {
                // One more who is mirrored makes it a rotation.
                ring = ring.insert_row(n, 0.0).insert_column(n, 0.0);
                ring[(n, n)] = -1.0;
            }
            let off = residual(&ring);
            assert!(off < 1e-8, "ring of {n} on by {step}: {off:e}");
        }
    }
}

#[test]
fn random_and_structured_rotations() {
    let mut dice = Dice::new(11);
    let mut worst = 0.0f64;
    for case in 0..800 {
        let n = 2 + case % 29;
        let matrix = match case % 8 {
            0 => random_basis(n, &mut dice),
            // Half a circle in some planes, nothing or anything in others.
            1 => turning_by(&[std::f64::consts::PI, std::f64::consts::PI, 0.3][..1 + case % 3], n % 5, &mut dice),
            // The same angle many times.
            2 => turning_by(&vec![0.1 + 0.01 * case as f64 % 3.0; 1 + n / 3], n % 3, &mut dice),
            // Angles hardly above nothing, hardly below half a circle, hardly different.
            3 => {
                let tiny = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11][case / 8 % 5];
                let angles = [tiny, 2.0 * tiny, std::f64::consts::PI - tiny, std::f64::consts::PI - 2.5 * tiny];
                turning_by(&angles, n % 4, &mut dice)
            }
            4 => {
                let tiny = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11][case / 8 % 5];
                let angles: Vec<f64> = (0..2 + n / 4).map(|k| 1.0 + tiny * k as f64).collect();
                turning_by(&angles, 0, &mut dice)
            }
            // Any permutation.
            5 => {
                let mut of: Vec<usize> = (0..n).collect();
                for k in (1..n).rev() {
                    of.swap(k, ((dice.next() + 1.0) * 0.5 * (k + 1) as f64) as usize);
                }
                let mut matrix = permutation(&of);
                if matrix.determinant() < 0.0 {
                    matrix.column_mut(0).neg_mut();
                }
                matrix
            }
            // Blocks that change places.
            6 => {
                let n = 4 * (1 + case % 6);
                permutation(&(0..n).map(|k| k ^ 2).collect::<Vec<_>>())
            }
            _ => DMatrix::identity(n, n),
        };
        let off = residual(&matrix);
        assert!(off < 1e-8, "case {case}, kind {}: {off:e}", case % 8);
        worst = worst.max(off);
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn half_a_circle_everywhere() {
    for n in [2, 4, 40] {
        let matrix = -DMatrix::<f64>::identity(n, n);
        assert!(residual(&matrix) < 1e-12);
        assert_eq!(Rotation::of(&matrix).unwrap().angles_rad(), vec![std::f64::consts::PI; n / 2]);
    }
}

#[test]
fn what_is_no_rotation_is_refused() {
    let mut mirror = DMatrix::<f64>::identity(4, 4);
    mirror[(2, 2)] = -1.0;
    let mut not_a_number = DMatrix::<f64>::identity(3, 3);
    not_a_number[(1, 0)] = f64::NAN;
    let swap = permutation(&[1, 0]);
    let long = DMatrix::<f64>::identity(3, 3) * 1.1;
    for matrix in [mirror, not_a_number, swap, long, DMatrix::zeros(2, 3), DMatrix::zeros(0, 2)] {
        let error = Rotation::of(&matrix).unwrap_err();
        assert!(error.to_string().contains("not a rotation"), "{error}");
        assert!(error.hint().is_some());
    }
    assert_eq!(Rotation::of(&DMatrix::zeros(0, 0)).unwrap().angles_rad().len(), 0);
}
