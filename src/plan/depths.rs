//! Finds the deepest pixel of each space, in memory for a few rows.

/// Number of rows in a band.
const BAND_ROWS: usize = 128;

/// Finds the deepest pixel of each of `count` spaces, labelled from 1; the first of several.
///
/// A space without a pixel gets 0. Depth is the distance to the nearest pixel that is not white, in fifths of a pixel
/// (5-7 chamfer, saturating). Its two sweeps, down and up, would need a number for each pixel. To save memory, the
/// sweep down keeps only the first row of each band, and is repeated within a band when the sweep up reaches it.
pub(super) fn deepest(white: &[u8], width: usize, label: &[u16], count: usize) -> Vec<usize> {
    let height = white.len() / width;
    let row_of = |y: usize| &white[y * width..(y + 1) * width];
    let mut starts: Vec<Vec<u16>> = Vec::new();
    let mut row = Vec::new();
    for y in 0..height {
        let mut next = start(row_of(y));
        if y > 0 {
            pull_down(&row, &mut next);
        }
        row = next;
        if y % BAND_ROWS == 0 {
            starts.push(row.clone());
        }
    }
    let mut deepest = vec![(0u16, 0usize); count];
    let mut below: Option<Vec<u16>> = None;
    for (band, first) in starts.into_iter().enumerate().rev() {
        let from = band * BAND_ROWS;
        let mut rows = vec![first];
        for y in from + 1..(from + BAND_ROWS).min(height) {
            let mut next = start(row_of(y));
            pull_down(&rows[rows.len() - 1], &mut next);
            rows.push(next);
        }
        for (k, mut row) in rows.into_iter().enumerate().rev() {
            if let Some(below) = &below {
                pull_up(below, &mut row);
            }
            let at = (from + k) * width;
            for (x, (&depth, &number)) in row.iter().zip(&label[at..at + width]).enumerate() {
                if let Some(best) = usize::from(number).checked_sub(1).map(|n| &mut deepest[n]) {
                    // The sweep goes up, so an equal depth in an earlier pixel wins.
                    if depth > best.0 || (depth == best.0 && depth > 0 && at + x < best.1) {
                        *best = (depth, at + x);
                    }
                }
            }
            below = Some(row);
        }
    }
    deepest.into_iter().map(|(_, at)| at).collect()
}

fn start(white: &[u8]) -> Vec<u16> {
    white.iter().map(|&w| if w != 0 { u16::MAX - 8 } else { 0 }).collect()
}

/// Propagates distances from the row above and from the left.
fn pull_down(above: &[u16], row: &mut [u16]) {
    let width = row.len();
    for x in 0..width {
        let mut depth = row[x].min(above[x] + 5);
        if x > 0 {
            depth = depth.min(row[x - 1] + 5).min(above[x - 1] + 7);
        }
        if x + 1 < width {
            depth = depth.min(above[x + 1] + 7);
        }
        row[x] = depth;
    }
}

/// Propagates distances from the row below and from the right.
fn pull_up(below: &[u16], row: &mut [u16]) {
    let width = row.len();
    for x in (0..width).rev() {
        let mut depth = row[x].min(below[x] + 5);
        if x + 1 < width {
            depth = depth.min(row[x + 1] + 5).min(below[x + 1] + 7);
        }
        if x > 0 {
            depth = depth.min(below[x - 1] + 7);
        }
        row[x] = depth;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference version with all distances in memory.
    fn at_once(white: &[u8], width: usize, label: &[u16], count: usize) -> Vec<usize> {
        let height = white.len() / width;
        let mut rows: Vec<Vec<u16>> = white.chunks_exact(width).map(start).collect();
        for y in 1..height {
            let (above, row) = rows.split_at_mut(y);
            pull_down(&above[y - 1], &mut row[0]);
        }
        for y in (1..height).rev() {
            let (above, row) = rows.split_at_mut(y);
            pull_up(&row[0], &mut above[y - 1]);
        }
        let mut deepest = vec![(0, 0); count];
        for (at, (&depth, &number)) in rows.concat().iter().zip(label).enumerate() {
            if number > 0 && depth > deepest[usize::from(number) - 1].0 {
                deepest[usize::from(number) - 1] = (depth, at);
            }
        }
        deepest.into_iter().map(|(_, at)| at).collect()
    }

    #[test]
    fn bands_give_what_all_rows_at_once_give() {
        for (width, height) in [(1, 1), (7, 2), (5, BAND_ROWS), (9, BAND_ROWS + 1), (13, 3 * BAND_ROWS + 40)] {
            let white: Vec<u8> = (0..width * height).map(|at| u8::from((at * 7919) % 61 != 0)).collect();
            let label: Vec<u16> = (0..width * height)
                .map(|at| if white[at] != 0 { (at / width / 50 % 3) as u16 + 1 } else { 0 })
                .collect();
            assert_eq!(deepest(&white, width, &label, 3), at_once(&white, width, &label, 3), "{width} x {height}");
        }
        // Without a pixel that is not white, all depths saturate.
        assert_eq!(deepest(&[1; 12], 4, &[1; 12], 1), at_once(&[1; 12], 4, &[1; 12], 1));
    }
}
