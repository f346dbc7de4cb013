//! Padding: extends the floor's colours beyond its edge, so that mip-maps have no clean rim.

/// Width of the padding, texels.
pub(super) const PADDING: usize = 16;

/// Returns, per texel of a mask's inner part, column and row of the floor texel to copy. Floor texels copy themselves;
/// `None` beyond the padding. `mask` is `width` wide and [`PADDING`] texels larger than the result on every side.
///
/// The nearest floor texel wins; of equally near ones the southernmost, then the westernmost.
pub(super) fn sources(mask: &[bool], width: usize) -> Vec<Option<[u32; 2]>> {
    let height = mask.len() / width;
    let up_down = nearest_in_columns(mask, width);
    let (inner_width, inner_height) = (width - 2 * PADDING, height - 2 * PADDING);
    let mut sources = Vec::with_capacity(inner_width * inner_height);
    for row in PADDING..PADDING + inner_height {
        let near = any_near(&up_down[row * width..(row + 1) * width]);
        for (column, near) in (PADDING..PADDING + inner_width).zip(near) {
            let place = row * width + column;
            sources.push(match (mask[place], near) {
                (true, _) => Some([column as u32, row as u32]),
                (false, true) => nearest_in_row(&up_down, place).map(|[columns, rows]| {
                    [(column as u32).wrapping_add_signed(columns), (row as u32).wrapping_add_signed(rows)]
                }),
                (false, false) => None,
            });
        }
    }
    sources
}

const FAR: i8 = i8::MAX;

/// Rows to the nearest floor texel in a column, at most [`PADDING`], or [`FAR`]; down wins.
fn nearest_in_columns(mask: &[bool], width: usize) -> Vec<i8> {
    let mut rows = vec![FAR; mask.len()];
    let mut since = vec![FAR; width];
    let limit = PADDING as i8;
    for (rows, mask) in rows.chunks_exact_mut(width).zip(mask.chunks_exact(width)) {
        for ((row, since), &floor) in rows.iter_mut().zip(&mut since).zip(mask) {
            *since = if floor { 0 } else { since.saturating_add(1) };
            *row = if *since <= limit { -*since } else { FAR };
        }
    }
    since.fill(FAR);
    for (rows, mask) in rows.chunks_exact_mut(width).zip(mask.chunks_exact(width)).rev() {
        for ((row, since), &floor) in rows.iter_mut().zip(&mut since).zip(mask) {
            *since = if floor { 0 } else { since.saturating_add(1) };
            let down = if *row == FAR { FAR } else { -*row };
            *row = if *since <= limit && *since < down { *since } else { *row };
        }
    }
    rows
}

/// Whether any column within [`PADDING`] of each inner one is near floor, for one row.
fn any_near(up_down: &[i8]) -> Vec<bool> {
    let mut last: Option<usize> = None;
    let mut near = Vec::with_capacity(up_down.len());
    for (column, &rows) in up_down.iter().enumerate() {
        if rows != FAR {
            last = Some(column);
        }
        // The window of the column PADDING to the left ends here.
        if column >= 2 * PADDING {
            near.push(last.is_some_and(|last| last + 2 * PADDING >= column));
        }
    }
    near
}

fn nearest_in_row(up_down: &[i8], place: usize) -> Option<[i32; 2]> {
    let mut best: Option<(i32, i32, i32)> = None;
    let limit = (PADDING * PADDING) as i32;
    for offset in 0..=PADDING as i32 {
        if offset * offset > best.map_or(limit, |best| best.0) {
            break;
        }
        for columns in [-offset, offset] {
            let rows = up_down[(place as i64 + i64::from(columns)) as usize];
            if rows == FAR {
                continue;
            }
            let rows = i32::from(rows);
            let candidate = (columns * columns + rows * rows, rows, columns);
            if candidate.0 <= limit && best.is_none_or(|best| candidate < best) {
                best = Some(candidate);
            }
        }
    }
    best.map(|(_, rows, columns)| [columns, rows])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_nearest_floor_texel() {
        // Scattered floor, compared with a naive search.
        let (width, height) = (70, 60);
        let mask: Vec<bool> =
            (0..width * height).map(|n| super::super::noise::hash(7, n as i32, 0).is_multiple_of(300)).collect();
        let found = sources(&mask, width);
        let inner = width - 2 * PADDING;
        for (n, source) in found.iter().enumerate() {
            let (i, j) = ((n % inner + PADDING) as i32, (n / inner + PADDING) as i32);
            let floor = (0..mask.len()).filter(|&m| mask[m]).map(|m| {
                let (di, dj) = ((m % width) as i32 - i, (m / width) as i32 - j);
                (di * di + dj * dj, dj, di)
            });
            let near = floor.min().filter(|&(squared, ..)| squared <= 256);
            let truth = near.map(|(_, dj, di)| [(i + di) as u32, (j + dj) as u32]);
            assert_eq!(*source, truth, "texel {i}, {j}");
        }
    }
}
