use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use nalgebra::{DMatrix, SymmetricEigen};

use super::FeaturesError;
use super::displacement::columns_of;
use super::progress_range::ProgressRange;

/// Largest matrix whose eigenvectors are sought: about half a minute, and 0.5 GB with what goes with it.
pub const MOST_ROWS: usize = 4000;

/// Smaller ones are decomposed at once, without anybody who looks on.
const QUICK: usize = 300;
/// How often the one who waits looks up.
const LOOK: Duration = Duration::from_millis(50);

/// Eigenvalues in descending order, and their unit eigenvectors as columns.
#[derive(Clone, Debug)]
pub(super) struct Eigenpairs {
    pub(super) values: Vec<f64>,
    pub(super) vectors: DMatrix<f64>,
}

/// All eigenpairs of a symmetric matrix; only its lower triangle is read. Signs are those of [`is_turned`].
///
/// A large decomposition runs on a thread of its own, so that progress is shown and an interruption heard; one that was
/// interrupted is left to itself and comes to its end unheard.
///
/// # Errors
/// A matrix of more than [`MOST_ROWS`] rows; eigenvectors that are not found; [`FeaturesError::Interrupted`].
pub(super) fn eigenpairs(matrix: DMatrix<f64>, part: &ProgressRange<'_>) -> Result<Eigenpairs, FeaturesError> {
    let size = matrix.nrows();
    if size > MOST_ROWS {
        return Err(FeaturesError::TooLarge { size, most: MOST_ROWS }.into());
    }
    let found = if size <= QUICK { decompose(matrix) } else { decompose_aside(matrix, part)? };
    part.advance(1.0);
    found.ok_or_else(|| FeaturesError::NotConverged { size }.into())
}

fn decompose(matrix: DMatrix<f64>) -> Option<Eigenpairs> {
    let size = matrix.nrows();
    // A few iterations a row are usual; the limit is there so that nothing goes on for ever.
    let SymmetricEigen { eigenvalues, eigenvectors } =
        SymmetricEigen::try_new(matrix, f64::EPSILON, 100 * size + 1000)?;
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
    let mut vectors = columns_of(&eigenvectors, &order);
    fix_signs(&mut vectors);
    Some(Eigenpairs { values: order.iter().map(|&at| eigenvalues[at]).collect(), vectors })
}

fn decompose_aside(matrix: DMatrix<f64>, part: &ProgressRange<'_>) -> Result<Option<Eigenpairs>, FeaturesError> {
    let size = matrix.nrows() as f64;
    let (sender, receiver) = mpsc::channel();
    // Measured: 0.6 s for 1000 rows, and with the cube of the rows. It serves the bar alone.
    let expected_s = 0.6e-9 * size * size * size;
    let start = Instant::now();
    std::thread::spawn(move || {
        // Nobody listens any more after an interruption.
        let _ = sender.send(decompose(matrix));
    });
    loop {
        match receiver.recv_timeout(LOOK) {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => {
                part.keep_on()?;
                let passed = start.elapsed().as_secs_f64() / expected_s;
                part.advance(passed / (0.3 + passed));
            }
        }
    }
}

/// Gives every column its sign, see [`is_turned`].
pub(super) fn fix_signs(vectors: &mut DMatrix<f64>) {
    for mut column in vectors.column_iter_mut() {
        if is_turned(column.as_slice()) {
            column.neg_mut();
        }
    }
}

/// An eigenvector's sign is free; ours is such that its largest entry is positive. Where several are as large but for
/// rounding, the first of them counts. Says whether the vector has to be turned round.
fn is_turned(vector: &[f64]) -> bool {
    let largest = vector.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    vector.iter().find(|v| v.abs() >= largest * (1.0 - 1e-6)).is_some_and(|&v| v < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::{Progress, Silent};

    fn found(matrix: &DMatrix<f64>) -> Eigenpairs {
        eigenpairs(matrix.clone(), &ProgressRange::whole(&Silent)).unwrap()
    }

    fn check(matrix: &DMatrix<f64>, found: &Eigenpairs) {
        let size = matrix.nrows();
        let scale = matrix.amax().max(1e-300);
        assert!(found.values.windows(2).all(|pair| pair[0] >= pair[1]));
        let unit = found.vectors.transpose() * &found.vectors;
        assert!((unit - DMatrix::identity(size, size)).amax() < 1e-12);
        let values = DMatrix::from_diagonal(&found.values.clone().into());
        let again = &found.vectors * values * found.vectors.transpose();
        assert!((again - matrix).amax() < 1e-12 * scale * size as f64);
    }

    #[test]
    fn eigenpairs_make_the_matrix_again_and_descend() {
        let wild = DMatrix::from_fn(40, 40, |r, c| ((r * 7 + c * 13) % 11) as f64 - 5.0);
        for matrix in [
            &wild * wild.transpose(),
            DMatrix::zeros(3, 3),
            DMatrix::identity(5, 5) * 1e-200,
            DMatrix::from_element(30, 30, 1e12),
            DMatrix::from_element(1, 1, -2.0),
        ] {
            check(&matrix, &found(&matrix));
        }
    }

    #[test]
    fn a_large_one_is_found_aside_and_can_be_interrupted() {
        struct Stop;
        impl Progress for Stop {
            fn advance(&self, _: crate::Stage, _: f64) {}
            fn warn(&self, _: &str) {}
            fn interrupted(&self) -> bool {
                true
            }
        }
        let size = QUICK + 10;
        let matrix = DMatrix::from_fn(size, size, |r, c| 1.0 / (r + c + 1) as f64);
        check(&matrix, &found(&matrix));
        let large = DMatrix::from_fn(700, 700, |r, c| if r == c { r as f64 } else { 0.1 });
        let error = eigenpairs(large, &ProgressRange::whole(&Stop)).unwrap_err();
        assert!(matches!(error, FeaturesError::Interrupted(_)));
    }

    #[test]
    fn signs_do_not_hang_on_rounding() {
        assert!(is_turned(&[-0.5, 0.5]));
        assert!(is_turned(&[-0.5, 0.5 + 1e-12]));
        assert!(!is_turned(&[0.1, 0.9, -0.2]));
        assert!(!is_turned(&[0.0; 3]));
    }

    #[test]
    fn too_large_a_matrix_is_refused() {
        let matrix = DMatrix::zeros(MOST_ROWS + 1, MOST_ROWS + 1);
        assert!(eigenpairs(matrix, &ProgressRange::whole(&Silent)).is_err());
    }
}
