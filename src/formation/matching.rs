use std::ops::Range;

use nalgebra::DMatrix;

use super::polar::Polar;
use super::{Basis, FormationError};
use crate::math::assign;

/// Eigenvalues are compared relative to their size, and to this share of the largest one if they are smaller still.
const SMALLEST_SCALE: f64 = 1e-6;
/// Cost of moving in the order of eigenvalues, as a share of the overlap.
///
/// A shape with full overlap may move by a third of the spectrum; chance overlaps between unrelated formations hardly move
/// any shape.
const MOVING: f64 = 3.0;
/// Whole-number cost per unit of overlap.
const UNIT: f64 = 1e6;

/// Distance of two eigenvalues over the share `nearness` of their mean; they differ from 1 on.
pub(super) fn gap(values: &[f64], a: usize, b: usize, nearness: f64) -> f64 {
    let scale = (0.5 * (values[a] + values[b])).max(SMALLEST_SCALE * values[values.len() - 1]).max(f64::MIN_POSITIVE);
    (values[a] - values[b]).abs() / (nearness * scale)
}

/// Rotates a formation's eigenvectors within clusters of nearly equal eigenvalues to match `target`.
///
/// Returns the rotated vectors, which are orthonormal and as near as possible to the target's columns.
///
/// Eigenvectors are given by the formation up to their sign only, those of equal eigenvalues up to any rotation and mirroring
/// among themselves, and equal eigenvalues are the normal case: grids, rings and triangles have them. So there is a choice,
/// and it decides how far the crowd has to turn. For each cluster of eigenvalues, each less than `nearness` times their
/// mean from the next, this is the orthogonal Procrustes problem (Schönemann 1966, doi 10.1007/BF02289451): with the cluster's
/// vectors `V` and its columns of the target, the nearest ones are `V polar(V^T target)`. A cluster of one has its sign
/// chosen.
///
/// In general the coarse shape goes to the coarse shape and the fine to the fine, in the order of the eigenvalues. But if
/// a formation is only stretched, the same shapes come in another order (across a wide crowd is coarser than along it), and
/// then each shape goes to itself. Clusters are assigned to columns such that the overlap, the squared length of a
/// column's part within the cluster, less a cost for each place that it moves in the order, is greatest in sum (Kuhn and Munkres).
///
/// `target` need not be orthonormal; the sum of several bases makes the sum of the squared distances from them least.
///
/// With `oriented` as another orthonormal basis, the way from that one to the result is a rotation, which no mirroring is: if
/// need be, the direction that fits worst is mirrored (Kabsch 1976, doi 10.1107/S0567739476001873).
///
/// The formation is rebuilt from the turned vectors as exactly as from the eigenvectors.
///
/// # Errors
/// [`FormationError::NoConvergence`].
pub fn match_basis(
    basis: &Basis,
    target: &DMatrix<f64>,
    nearness: f64,
    oriented: Option<&DMatrix<f64>>,
) -> Result<DMatrix<f64>, FormationError> {
    match_clusters(basis, target, &columns_of(basis, target, nearness), oriented)
}

/// [`match_basis`] in the order of the eigenvalues.
pub(super) fn match_in_order(
    basis: &Basis,
    target: &DMatrix<f64>,
    nearness: f64,
) -> Result<DMatrix<f64>, FormationError> {
    let columns: Vec<_> =
        clusters(&basis.values, nearness).into_iter().map(|own| (own.clone(), own.collect())).collect();
    match_clusters(basis, target, &columns, None)
}

/// Clusters of vectors of nearly equal eigenvalue, without the constant vector.
fn clusters(values: &[f64], nearness: f64) -> Vec<Range<usize>> {
    let mut clusters = Vec::new();
    let mut start = 1;
    for end in 2..=values.len() {
        if end == values.len() || gap(values, end - 1, end, nearness) >= 1.0 {
            clusters.push(start..end);
            start = end;
        }
    }
    clusters
}

/// The columns of the target that each cluster is assigned to, ascending.
fn columns_of(basis: &Basis, target: &DMatrix<f64>, nearness: f64) -> Vec<(Range<usize>, Vec<usize>)> {
    let n = basis.people();
    let clusters = clusters(&basis.values, nearness);
    let overlap = basis.vectors.transpose() * target;
    let norms: Vec<f64> = (0..n).map(|j| target.column(j).norm_squared().max(f64::MIN_POSITIVE)).collect();
    let mut costs = vec![0i64; (n - 1) * (n - 1)];
    for own in &clusters {
        for j in 1..n {
            let inside = own.clone().map(|a| overlap[(a, j)] * overlap[(a, j)]).sum::<f64>() / norms[j];
            let moved = own.start.saturating_sub(j).max((j + 1).saturating_sub(own.end));
            let gain = inside - own.len() as f64 / n as f64 - MOVING * moved as f64 / n as f64;
            for a in own.clone() {
                costs[(a - 1) * (n - 1) + j - 1] = -((gain * UNIT).round() as i64);
            }
        }
    }
    let (_, assigned) = assign(n - 1, n - 1, |row, column| costs[row * (n - 1) + column]);
    let columns = |own: Range<usize>| {
        let mut columns: Vec<usize> = assigned[own.start - 1..own.end - 1].iter().map(|j| j + 1).collect();
        columns.sort_unstable();
        (own, columns)
    };
    clusters.into_iter().map(columns).collect()
}

/// Solves the Procrustes problem for each cluster and its columns.
fn match_clusters(
    basis: &Basis,
    target: &DMatrix<f64>,
    clusters: &[(Range<usize>, Vec<usize>)],
    oriented: Option<&DMatrix<f64>>,
) -> Result<DMatrix<f64>, FormationError> {
    let mut matched = basis.vectors.clone();
    let mut weakest: Option<(f64, &Range<usize>, &[usize], Polar)> = None;
    for (own, columns) in clusters {
        let vectors = basis.vectors.columns(own.start, own.len());
        let nearest = Polar::of(vectors.transpose() * target.select_columns(columns))?;
        put(&mut matched, columns, &(vectors * nearest.orthogonal()));
        if weakest.as_ref().is_none_or(|(least, ..)| nearest.least() < *least) {
            weakest = Some((nearest.least(), own, columns, nearest));
        }
    }
    if let (Some(other), Some((_, own, columns, nearest))) = (oriented, weakest)
        && mirrors(&matched, other)
    {
        let vectors = basis.vectors.columns(own.start, own.len());
        put(&mut matched, columns, &(vectors * nearest.mirrored()));
    }
    Ok(matched)
}

/// Writes the columns of one matrix to some columns of another.
fn put(matrix: &mut DMatrix<f64>, columns: &[usize], from: &DMatrix<f64>) {
    for (&column, from) in columns.iter().zip(from.column_iter()) {
        matrix.column_mut(column).copy_from(&from);
    }
}

/// Whether two orthonormal bases have different orientation.
pub(super) fn mirrors(a: &DMatrix<f64>, b: &DMatrix<f64>) -> bool {
    (a.transpose() * b).determinant() < 0.0
}
