//! Exact erosion and dilation of masks by discs, in time independent of the radius, and closing of tones.
//!
//! imageproc's distance transform needs 8 bytes a pixel for squared distances, this needs 2.

use rayon::prelude::*;

/// Keeps the non-zero pixels at least `radius` pixels from every zero pixel, centre to centre.
///
/// The border of the image is no obstacle.
pub(super) fn erode(mask: &[u8], width: usize, radius: f64) -> Vec<u8> {
    let mut near = within(mask, width, radius, |pixel| pixel == 0, true);
    near.iter_mut().zip(mask).for_each(|(near, &m)| *near = u8::from(*near == 0 && m != 0));
    near
}

/// Marks pixels at most `radius` pixels from a non-zero pixel of `mask`, centre to centre.
pub(super) fn dilate(mask: &[u8], width: usize, radius: f64) -> Vec<u8> {
    within(mask, width, radius, |pixel| pixel != 0, false)
}

/// Keeps what discs of a radius cover that lie within a mask.
pub(super) fn opened(mask: &[u8], width: usize, radius: f64) -> Vec<u8> {
    dilate(&erode(mask, width, radius), width, radius)
}

/// Closes what is dark and narrower than a square that reaches so far to each side: the greatest tone in a square, then the
/// least of those. imageproc's takes time by the square's area, this by its side.
pub(super) fn closed(tones: &[u8], width: usize, reach: usize) -> Vec<u8> {
    let height = tones.len() / width;
    let along = |from: &[u8], stride: usize, of: fn(u8, u8) -> u8| -> Vec<u8> {
        let size = if stride == 1 { width } else { height };
        let best = |at: usize| {
            let place = if stride == 1 { at % width } else { at / width };
            let (before, after) = (reach.min(place), reach.min(size - 1 - place));
            (at - before * stride..=at + after * stride).step_by(stride).map(|near| from[near]).reduce(of).unwrap_or(0)
        };
        (0..from.len()).map(best).collect()
    };
    let light = along(&along(tones, 1, u8::max), width, u8::max);
    along(&along(&light, 1, u8::min), width, u8::min)
}

/// Least number of rows in a band.
const BAND_ROWS: usize = 256;
/// Most memory for the column distances of all bands in progress, bytes.
const MOST_BAND_BYTES: usize = 256 << 20;

/// Returns 1 where a source pixel lies within `radius`, or strictly within.
///
/// Sweeps along each column find the distance g to the nearest source above or below. Along each row a source
/// reaches sqrt(radius^2 - g^2) to both sides, found by two more sweeps.
///
/// Bands are independent: sources farther than the radius above or below a band do not affect it.
fn within(mask: &[u8], width: usize, radius: f64, is_source: impl Fn(u8) -> bool + Sync, strictly: bool) -> Vec<u8> {
    // Greater distances do not matter; u16 holds this one.
    let far = (radius.ceil() as u16).saturating_add(1);
    let reach = reaches(radius, far, strictly);
    let (height, halo) = (mask.len() / width, usize::from(far));
    let rows = halo.max(BAND_ROWS);
    let band_bytes = 2 * width * (rows + 2 * halo).min(height);
    let at_once = (MOST_BAND_BYTES / band_bytes.max(1)).max(1);
    let mut near = vec![0u8; mask.len()];
    for (group, near) in near.chunks_mut(rows * width * at_once).enumerate() {
        near.par_chunks_mut(rows * width).enumerate().for_each(|(band, near)| {
            let first = (group * at_once + band) * rows;
            let last = first + near.len() / width;
            let (from, to) = (first.saturating_sub(halo), (last + halo).min(height));
            let columns = column_distances(&mask[from * width..to * width], width, far, &is_source);
            let columns = columns[(first - from) * width..].chunks_exact(width);
            near.chunks_exact_mut(width).zip(columns).for_each(|(near, columns)| sweep_row(near, columns, &reach));
        });
    }
    near
}

/// Marks the pixels of a row that sources in its columns reach.
fn sweep_row(near: &mut [u8], columns: &[u16], reach: &[i32]) {
    let mut left = -1i32;
    for (near, &g) in near.iter_mut().zip(columns) {
        left = (left - 1).max(reach[usize::from(g)]);
        *near = u8::from(left >= 0);
    }
    left = -1;
    for (near, &g) in near.iter_mut().zip(columns).rev() {
        left = (left - 1).max(reach[usize::from(g)]);
        *near |= u8::from(left >= 0);
    }
}

/// Returns the sideways reach for each column distance, pixels.
///
/// It is -1 where a source does not reach its own column.
fn reaches(radius: f64, far: u16, strictly: bool) -> Vec<i32> {
    let squared = radius * radius;
    let covers = |g: u16, k: i32| {
        let d = f64::from(g) * f64::from(g) + f64::from(k) * f64::from(k);
        // Tolerance for rounding: 0.2 m are 4 pixels of 0.05 m.
        if strictly { d < squared - 1e-6 } else { d <= squared + 1e-6 }
    };
    let mut k = far as i32;
    let mut all: Vec<i32> = Vec::with_capacity(usize::from(far) + 1);
    for g in 0..=far {
        while k >= 0 && !covers(g, k) {
            k -= 1;
        }
        all.push(k);
    }
    all
}

fn column_distances(mask: &[u8], width: usize, far: u16, is_source: &impl Fn(u8) -> bool) -> Vec<u16> {
    let mut distances: Vec<u16> = mask.iter().map(|&m| if is_source(m) { 0 } else { far }).collect();
    let height = mask.len() / width;
    for y in 1..height {
        let (above, row) = distances[(y - 1) * width..].split_at_mut(width);
        for (d, &a) in row.iter_mut().zip(above.iter()) {
            *d = (*d).min(a + 1);
        }
    }
    for y in (1..height).rev() {
        let (row, below) = distances[(y - 1) * width..].split_at_mut(width);
        for (d, &b) in row.iter_mut().zip(below.iter()) {
            *d = (*d).min(b + 1);
        }
    }
    distances
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn discs_agree_with_brute_force(mask in proptest::collection::vec(0u8..2, 77), radius in 0.3f64..6.0) {
            let width = 11;
            let squared = |a: usize, b: usize| {
                let (dx, dy) = ((a % width) as f64 - (b % width) as f64, (a / width) as f64 - (b / width) as f64);
                dx * dx + dy * dy
            };
            let eroded: Vec<u8> = (0..mask.len())
                .map(|a| u8::from(mask[a] != 0 && (0..mask.len()).all(|b| mask[b] != 0 || squared(a, b) >= radius * radius)))
                .collect();
            prop_assert_eq!(erode(&mask, width, radius), eroded);
            let dilated: Vec<u8> = (0..mask.len())
                .map(|a| u8::from((0..mask.len()).any(|b| mask[b] != 0 && squared(a, b) <= radius * radius)))
                .collect();
            prop_assert_eq!(dilate(&mask, width, radius), dilated);
        }
    }

    #[test]
    fn bands_are_seamless() {
        // Scattered pixels over several bands.
        let (width, height) = (3, 3 * BAND_ROWS + 17);
        let mask: Vec<u8> = (0..width * height).map(|at| u8::from((at * 7919) % 613 == 0)).collect();
        let radius = 40.0;
        let near = |at: usize| {
            (0..mask.len()).any(|b| {
                let (dx, dy) = ((at % width).abs_diff(b % width) as f64, (at / width).abs_diff(b / width) as f64);
                mask[b] != 0 && dx * dx + dy * dy <= radius * radius
            })
        };
        let expected: Vec<u8> = (0..mask.len()).map(|at| u8::from(near(at))).collect();
        assert_eq!(dilate(&mask, width, radius), expected);
    }
}
