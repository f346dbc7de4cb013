//! Splits a boundary into the fewest straight pieces, with the best fit. (Selinger 2003, "Potrace: a polygon-based
//! tracing algorithm", section 2.2).

use super::line::PieceMoments;
use super::runs::Runs;
use super::stabbing::reaches;

/// Tolerated distance of a piece's end from its line, pixels: slightly more than half a pixel's diagonal.
const END_TOLERANCE: f64 = 0.8;
/// Cost per pixel of an end beyond the tolerance.
const END_COST: f64 = 100.0;

/// Returns the runs at which pieces start, ascending. On an open boundary, the first is 0 and the last piece ends with
/// the boundary. On a closed one, the last piece wraps around to the first.
pub(super) fn breaks(runs: &Runs) -> Vec<usize> {
    let reach = reaches(runs);
    let moments = PieceMoments::new(runs);
    let found = best_from(runs, &reach, &moments, 0);
    if !runs.closed || found.len() < 3 {
        return found;
    }
    // The first pass had to break at run 0. Repeat from a break that it chose freely.
    let again = best_from(runs, &reach, &moments, found[found.len() / 2]);
    if again.len() <= found.len() { again } else { found }
}

/// Returns the best breaks of one round from run `start`.
fn best_from(runs: &Runs, reach: &[usize], moments: &PieceMoments, start: usize) -> Vec<usize> {
    let count = runs.len();
    // Runs are counted from `start`; `far(k)` is the end of the longest straight piece from the k-th.
    let far = |k: usize| {
        let run = (start + k) % count;
        (k + reach[run] - run).min(count)
    };
    let (from_start, to_end) = (pieces_from_start(count, far), pieces_to_end(count, far));
    let fewest = from_start[count];
    let is_useful = |k: usize| from_start[k] + to_end[k] == fewest;
    let mut cost = vec![f64::INFINITY; count + 1];
    let mut previous = vec![0usize; count + 1];
    cost[0] = 0.0;
    for k in 0..count {
        if !is_useful(k) || cost[k].is_infinite() {
            continue;
        }
        for next in k + 1..=far(k) {
            if is_useful(next) && from_start[next] == from_start[k] + 1 {
                let total = cost[k] + piece_cost(runs, moments, (start + k) % count, next - k);
                if total < cost[next] {
                    (cost[next], previous[next]) = (total, k);
                }
            }
        }
    }
    let mut breaks = Vec::with_capacity(fewest);
    let mut k = count;
    while k > 0 {
        k = previous[k];
        breaks.push((start + k) % count);
    }
    breaks.sort_unstable();
    breaks
}

/// Fewest pieces from the start to each run.
fn pieces_from_start(count: usize, far: impl Fn(usize) -> usize) -> Vec<usize> {
    let mut pieces = vec![0; count + 1];
    let (mut layer, mut layer_end, mut farthest) = (0, 0, 0);
    for (k, fewest) in pieces.iter_mut().enumerate() {
        if k > layer_end {
            layer += 1;
            layer_end = farthest;
        }
        *fewest = layer;
        if k < count {
            farthest = farthest.max(far(k));
        }
    }
    pieces
}

/// Fewest pieces from each run to the end.
fn pieces_to_end(count: usize, far: impl Fn(usize) -> usize) -> Vec<usize> {
    // Part of a straight piece is straight, so the longest step is always among the best.
    let mut pieces = vec![0; count + 1];
    for k in (0..count).rev() {
        pieces[k] = 1 + pieces[far(k)];
    }
    pieces
}

/// Cost of a piece: squared distances of its samples, and the excess distance of its ends.
fn piece_cost(runs: &Runs, moments: &PieceMoments, from: usize, count: usize) -> f64 {
    let fit = moments.fit(from, from + count);
    let excess = |k: usize| (fit.line.distance(runs.corner(k)).abs() - END_TOLERANCE).max(0.0);
    fit.squares + END_COST * (excess(from) + excess(from + count))
}
