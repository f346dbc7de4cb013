use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use nalgebra::DMatrix;

use super::displacement::columns_of;
use super::error::FeaturesError;
use super::progress_range::ProgressRange;
use crate::math::{NoConvergence, eigenvectors};

/// Largest number of rows of a matrix that is decomposed: about half a minute and 0.5 GB.
pub const MOST_ROWS: usize = 4000;

/// Number of rows up to which a matrix is decomposed without reporting progress.
const QUICK: usize = 300;
/// Interval at which progress is reported.
const REPORT_INTERVAL: Duration = Duration::from_millis(50);

/// Eigenvalues in descending order, and their unit eigenvectors as columns.
#[derive(Clone, Debug)]
pub(super) struct Eigenpairs {
    pub(super) values: Vec<f64>,
    pub(super) vectors: DMatrix<f64>,
}

/// Finds all eigenpairs of a symmetric matrix; only its lower triangle is read. Signs are those of [`is_turned`].
///
/// A large decomposition runs on a thread of its own, so that progress is reported and the user can interrupt it; after
/// an interruption the thread runs to its end and its result is dropped.
///
/// # Errors
/// A matrix of more than [`MOST_ROWS`] rows; eigenvectors that are not found; [`FeaturesError::Interrupted`].
pub(super) fn eigenpairs(matrix: DMatrix<f64>, progress: &ProgressRange<'_>) -> Result<Eigenpairs, FeaturesError> {
    let size = matrix.nrows();
    if size > MOST_ROWS {
        return Err(FeaturesError::TooLarge { size, most: MOST_ROWS });
    }
    let found = if size <= QUICK { decompose(matrix)? } else { decompose_on_thread(matrix, progress)? };
    progress.advance(1.0);
    Ok(found)
}

fn decompose(matrix: DMatrix<f64>) -> Result<Eigenpairs, NoConvergence> {
    let (ascending, mut values) = eigenvectors(matrix)?;
    values.reverse();
    let order: Vec<usize> = (0..values.len()).rev().collect();
    let mut vectors = columns_of(&ascending, &order);
    fix_signs(&mut vectors);
    Ok(Eigenpairs { values, vectors })
}

fn decompose_on_thread(matrix: DMatrix<f64>, progress: &ProgressRange<'_>) -> Result<Eigenpairs, FeaturesError> {
    let size = matrix.nrows();
    let rows = size as f64;
    let (sender, receiver) = mpsc::channel();
    // Measured: 0.4 s for 1000 rows, growing with the cube of the rows. Only the progress bar uses it.
    let expected_s = 0.4e-9 * rows * rows * rows;
    let start = Instant::now();
    std::thread::spawn(move || {
        // After an interruption there is no receiver any more.
        let _ = sender.send(decompose(matrix));
    });
    loop {
        match receiver.recv_timeout(REPORT_INTERVAL) {
            Ok(found) => return Ok(found?),
            Err(RecvTimeoutError::Disconnected) => return Err(NoConvergence { size, iterations: 0 }.into()),
            Err(RecvTimeoutError::Timeout) => {
                progress.keep_on()?;
                let passed = start.elapsed().as_secs_f64() / expected_s;
                progress.advance(passed / (0.3 + passed));
            }
        }
    }
}

/// Sets the sign of every column, see [`is_turned`].
pub(super) fn fix_signs(vectors: &mut DMatrix<f64>) {
    for mut column in vectors.column_iter_mut() {
        if is_turned(column.as_slice()) {
            column.neg_mut();
        }
    }
}

/// Whether an eigenvector has to be negated so that its largest entry is positive.
///
/// If several entries are equally large but for rounding, the first of them counts.
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
    fn eigenpairs_rebuild_the_matrix_and_descend() {
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
    fn a_large_matrix_is_decomposed_on_a_thread_and_can_be_interrupted() {
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
    fn signs_do_not_depend_on_rounding() {
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
