//! The planes that a rotation turns within: pairs of vectors that span the invariant planes of an orthogonal matrix.

use nalgebra::{DMatrix, DMatrixView, DVector};

use super::FormationError;
use crate::math::eigenvectors;

/// Cosines nearer to each other than this are worked on together. Farther apart, the eigenvectors of the symmetric part
/// are good to about 1e-16 / 1e-5 by themselves.
const NEAR_COSINES: f64 = 1e-5;
/// In a space of near-equal cosines, pairs are taken whose sine is at least this share of the largest; smaller ones
/// have a turn of their own, with the rest of the space scaled up.
const SINE_SHARE: f64 = 0.03;
/// Squares of sines nearer to each other than this share of the largest are paired together.
const NEAR_SQUARES: f64 = 1e-6;
/// The sum of `2 (1 - cos)` over all directions below which every turn is so small that sines alone tell them apart.
const SMALL_TURNS: f64 = 0.5;
/// Largest entry of the antisymmetric part that is only rounding.
const NO_SINE: f64 = 1e-13;

/// The turn of each pair of columns.
pub(super) struct PlaneTurns {
    /// Cosine and sine of the turn of each pair.
    pub turns: Vec<(f64, f64)>,
    /// Whether one direction is mirrored and has no partner.
    pub unpaired_mirrored: bool,
}

/// Finds an orthonormal basis: two vectors for each invariant plane, then the fixed directions.
pub(super) fn invariant_planes(matrix: &DMatrix<f64>) -> Result<(DMatrix<f64>, PlaneTurns), FormationError> {
    let n = matrix.nrows();
    let transposed = matrix.transpose();
    let sines = (matrix - &transposed) * 0.5;
    let mut found = PlaneCollector::default();
    if 2.0 * (n as f64 - matrix.trace()) < SMALL_TURNS {
        found.add_space(matrix, &sines, DMatrix::identity(n, n).columns(0, n), 1.0)?;
        return Ok(found.finish(n));
    }
    let (vectors, cosines) = eigenvectors((matrix + &transposed) * 0.5)?;
    let mut start = 0;
    for end in 1..=n {
        if end == n || cosines[end] - cosines[end - 1] > NEAR_COSINES {
            let space = vectors.columns(start, end - start);
            let mean = cosines[start..end].iter().sum::<f64>() / (end - start) as f64;
            found.add_space(matrix, &sines, space, mean)?;
            start = end;
        }
    }
    Ok(found.finish(n))
}

#[derive(Default)]
struct PlaneCollector {
    /// Two vectors for each plane, with cosine and sine.
    planes: Vec<([DVector<f64>; 2], f64, f64)>,
    /// Fixed directions.
    still: Vec<DVector<f64>>,
    /// Mirrored directions.
    mirrored: Vec<DVector<f64>>,
}

impl PlaneCollector {
    /// Splits a space of near-equal cosines into planes and single directions.
    fn add_space(
        &mut self,
        matrix: &DMatrix<f64>,
        sines: &DMatrix<f64>,
        space: DMatrixView<f64>,
        cosine: f64,
    ) -> Result<(), FormationError> {
        let mut basis = space.clone_owned();
        while basis.ncols() > 1 {
            // How the space is turned within itself: antisymmetric to the bit.
            let product = basis.transpose() * (sines * &basis);
            let within = (&product - product.transpose()) * 0.5;
            let most = within.amax();
            if most < NO_SINE {
                break;
            }
            let (pairs, rest) = split(&(within / most))?;
            if pairs.is_empty() {
                break;
            }
            for pair in pairs {
                let [a, b] = pair.map(|local| &basis * local);
                let (turned_a, turned_b) = (matrix * &a, matrix * &b);
                let cosine = (a.dot(&turned_a) + b.dot(&turned_b)) * 0.5;
                let sine = (b.dot(&turned_a) - a.dot(&turned_b)) * 0.5;
                self.planes.push(([a, b], cosine, sine));
            }
            basis = &basis * rest;
        }
        let singles = basis.column_iter().map(|column| column.into_owned());
        if cosine < 0.0 {
            self.mirrored.extend(singles)
        } else {
            self.still.extend(singles)
        }
        Ok(())
    }

    /// Pairs mirrored directions into half turns, and orders the columns.
    fn finish(mut self, n: usize) -> (DMatrix<f64>, PlaneTurns) {
        let mut mirrored = self.mirrored.into_iter();
        let mut unpaired = None;
        while let Some(a) = mirrored.next() {
            match mirrored.next() {
                Some(b) => self.planes.push(([a, b], -1.0, 0.0)),
                None => unpaired = Some(a),
            }
        }
        let turns = self.planes.iter().map(|&(_, cosine, sine)| (cosine, sine)).collect();
        let pairs = PlaneTurns { turns, unpaired_mirrored: unpaired.is_some() };
        let columns = self.planes.into_iter().flat_map(|(pair, ..)| pair).chain(self.still).chain(unpaired);
        let mut vectors = DMatrix::zeros(n, n);
        for (mut to, from) in vectors.column_iter_mut().zip(columns) {
            to.copy_from(&from);
        }
        (orthonormalised(vectors), pairs)
    }
}

/// One Newton step towards the nearest orthogonal matrix: an error of 1e-9 becomes 1e-18.
fn orthonormalised(vectors: DMatrix<f64>) -> DMatrix<f64> {
    let mut gram = vectors.transpose() * &vectors * -0.5;
    for k in 0..gram.nrows() {
        gram[(k, k)] += 1.5;
    }
    vectors * gram
}

/// Pairs of vectors that span planes, and a basis of the rest.
type Split = (Vec<[DVector<f64>; 2]>, DMatrix<f64>);

/// Splits an antisymmetric matrix whose largest entry is 1: pairs of vectors `a, b` of length one with `S a = s b`,
/// `S b = -s a` for the large `s`, and an orthonormal basis of the rest.
fn split(sines: &DMatrix<f64>) -> Result<Split, FormationError> {
    let n = sines.nrows();
    // -S^2 is symmetric with the squares of the sines as eigenvalues, each twice.
    let squares = sines.transpose() * sines;
    let (candidates, values) = eigenvectors((&squares + squares.transpose()) * 0.5)?;
    let most = values[n - 1];
    let mut pairs = Vec::new();
    let mut end = n;
    // From the largest on, by sets of near-equal squares; each has an even number.
    for start in (0..n).rev() {
        let apart = start == 0 || values[start] - values[start - 1] > NEAR_SQUARES * most;
        if !apart || !(end - start).is_multiple_of(2) {
            continue;
        }
        if values[start] < most * SINE_SHARE * SINE_SHARE {
            break;
        }
        let Some(found) = pair_up(sines, (start..end).map(|k| candidates.column(k).into_owned()).collect()) else {
            break;
        };
        pairs.extend(found);
        end = start;
    }
    Ok((pairs, candidates.columns(0, end).into_owned()))
}

/// Pairs the vectors of a space of equal sines, each with its image under the matrix.
fn pair_up(sines: &DMatrix<f64>, mut left: Vec<DVector<f64>>) -> Option<Vec<[DVector<f64>; 2]>> {
    let mut pairs: Vec<[DVector<f64>; 2]> = Vec::new();
    for _ in 0..left.len() / 2 {
        // That of which the most lies outside the pairs taken so far.
        let longest = (0..left.len()).max_by(|&a, &b| left[a].norm_squared().total_cmp(&left[b].norm_squared()))?;
        let mut a = left.swap_remove(longest);
        // Twice is enough to be orthogonal to the last digit.
        for _ in 0..2 {
            pairs.iter().for_each(|pair| take_away(&mut a, pair));
            if a.normalize_mut() == 0.0 {
                return None;
            }
        }
        let mut b = sines * &a;
        for _ in 0..2 {
            let along = a.dot(&b);
            b.axpy(-along, &a, 1.0);
            pairs.iter().for_each(|pair| take_away(&mut b, pair));
            if b.normalize_mut() == 0.0 {
                return None;
            }
        }
        let pair = [a, b];
        left.iter_mut().for_each(|vector| take_away(vector, &pair));
        pairs.push(pair);
    }
    Some(pairs)
}

/// Removes the component of a vector within a plane.
fn take_away(vector: &mut DVector<f64>, plane: &[DVector<f64>; 2]) {
    for direction in plane {
        let along = direction.dot(vector);
        vector.axpy(-along, direction, 1.0);
    }
}
