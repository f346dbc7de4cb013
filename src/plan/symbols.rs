//! Removes dark symbols that are not walls: specks, lettering, dashed lines, outlined dots.

use super::components::{Component, Components, Neighbours, apart};
use super::drawing::Drawing;

/// Greatest length of a letter or a dash, metres.
const LONGEST_STROKE_M: f64 = 0.7;
/// Greatest thickness of a stroke, metres, unless a pixel is larger than half of it.
const THICKEST_STROKE_M: f64 = 0.12;
/// Greatest gap between strokes of one group, as a share of the longer stroke.
const GAP_SHARE: f64 = 0.6;
/// Least number of strokes in lettering or a dashed line.
pub(super) const FEWEST_STROKES: usize = 3;
/// Greatest size of a coloured dot's outline, metres.
const LARGEST_DOT_M: f64 = 1.5;
/// Least share of an outline's pixels that touch colour.
const COLOURED_SHARE: f64 = 0.35;

/// Removes dark components whose larger side is below `speck_m`.
pub(super) fn drop_specks(drawing: &mut Drawing, metres_per_pixel: f64, speck_m: f64) {
    let pieces = Components::of(&drawing.dark, drawing.width, 1, Neighbours::Eight);
    let small = |c: &&Component| f64::from(c.larger_side()) * metres_per_pixel < speck_m - 1e-9;
    for piece in pieces.all.iter().filter(small) {
        erase(drawing, &pieces, piece);
    }
}

/// Removes lettering, dashed lines and the outlines of coloured dots.
///
/// Lettering and dashed lines are at least three thin short strokes close to each other. A pillar is thicker, a wall
/// longer.
pub(super) fn drop_annotation(drawing: &mut Drawing, metres_per_pixel: f64) {
    let pieces = Components::of(&drawing.dark, drawing.width, 1, Neighbours::Eight);
    let in_metres = |px: u32| f64::from(px) * metres_per_pixel;
    if !drawing.coloured.is_empty() {
        for piece in pieces.all.iter().filter(|p| in_metres(p.larger_side()) <= LARGEST_DOT_M) {
            if touches_colour(drawing, &pieces, piece) {
                erase(drawing, &pieces, piece);
            }
        }
    }
    let thickest = ((THICKEST_STROKE_M / metres_per_pixel) as u32).max(2);
    let is_stroke =
        |p: &&Component| in_metres(p.larger_side()) <= LONGEST_STROKE_M && thickness(&pieces, p) <= thickest;
    let strokes: Vec<&Component> = pieces.all.iter().filter(is_stroke).collect();
    for group in groups(&strokes) {
        if group.len() >= FEWEST_STROKES {
            for piece in group {
                erase(drawing, &pieces, piece);
            }
        }
    }
}

fn erase(drawing: &mut Drawing, pieces: &Components, piece: &Component) {
    pieces.paint(piece, &mut drawing.dark, drawing.width, 0);
    pieces.paint(piece, &mut drawing.lightness, drawing.width, 255);
    // The light rim of an anti-aliased stroke goes too: it would shift walls nearby.
    let (width, height) = (drawing.width, drawing.height);
    for run in pieces.runs(piece) {
        for y in (run.y as usize).saturating_sub(1)..=(run.y as usize + 1).min(height - 1) {
            for x in (run.from as usize).saturating_sub(1)..=(run.to as usize).min(width - 1) {
                if drawing.dark[y * width + x] == 0 {
                    drawing.lightness[y * width + x] = 255;
                }
            }
        }
    }
}

fn touches_colour(drawing: &Drawing, pieces: &Components, piece: &Component) -> bool {
    let (width, height) = (drawing.width, drawing.height);
    let mut touching = 0usize;
    for run in pieces.runs(piece) {
        let rows = (run.y as usize).saturating_sub(1)..=(run.y as usize + 1).min(height - 1);
        for x in run.from as usize..run.to as usize {
            let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
            let coloured =
                |y: usize| drawing.coloured[y * width + columns.start()..=y * width + columns.end()].contains(&1);
            touching += usize::from(rows.clone().any(coloured));
        }
    }
    touching as f64 >= COLOURED_SHARE * piece.area as f64
}

/// Side of the largest square that fits into a component, pixels.
fn thickness(pieces: &Components, piece: &Component) -> u32 {
    let width = piece.size()[0] as usize;
    let mut above = vec![0u32; width];
    let mut row = vec![0u32; width];
    let mut most = 0;
    let mut y = piece.min[1];
    for run in pieces.runs(piece) {
        if run.y != y {
            std::mem::swap(&mut above, &mut row);
            row.fill(0);
            y = run.y;
        }
        for x in (run.from - piece.min[0]) as usize..(run.to - piece.min[0]) as usize {
            let corner = if x == 0 { 0 } else { above[x - 1].min(row[x - 1]).min(above[x]) };
            row[x] = corner + 1;
            most = most.max(row[x]);
        }
    }
    most
}

/// Groups strokes over small gaps. Sorting by x limits the comparisons to near strokes.
pub(super) fn groups<'a>(strokes: &[&'a Component]) -> Vec<Vec<&'a Component>> {
    let mut order: Vec<&Component> = strokes.to_vec();
    order.sort_by_key(|p| (p.min, p.end));
    let widest = order.iter().map(|p| p.larger_side()).max().unwrap_or(0);
    let mut group_of: Vec<usize> = (0..order.len()).collect();
    fn top(group_of: &[usize], mut k: usize) -> usize {
        while group_of[k] != k {
            k = group_of[k];
        }
        k
    }
    for (k, a) in order.iter().enumerate() {
        let beyond = a.end[0] + (f64::from(widest) * GAP_SHARE) as u32;
        for (n, b) in order.iter().enumerate().skip(k + 1).take_while(|(_, b)| b.min[0] <= beyond) {
            if are_close(a, b) {
                let (i, j) = (top(&group_of, k), top(&group_of, n));
                group_of[i.max(j)] = i.min(j);
            }
        }
    }
    let mut groups: Vec<Vec<&Component>> = vec![Vec::new(); order.len()];
    for (k, piece) in order.into_iter().enumerate() {
        groups[top(&group_of, k)].push(piece);
    }
    groups
}

fn are_close(a: &Component, b: &Component) -> bool {
    let gap = |axis: usize| apart([a.min[axis], a.end[axis]], [b.min[axis], b.end[axis]]);
    let longer = a.larger_side().max(b.larger_side());
    f64::from(gap(0).max(gap(1))) <= GAP_SHARE * f64::from(longer)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(rows: &[&str]) -> Drawing {
        let pixels = || rows.iter().flat_map(|r| r.bytes());
        let lightness = pixels().map(|b| if b == b'#' { 0 } else { 255 }).collect();
        let dark = pixels().map(|b| u8::from(b == b'#')).collect();
        let coloured = pixels().map(|b| u8::from(b == b'o')).collect();
        Drawing { coloured, ..Drawing::of(rows[0].len(), lightness, dark) }
    }

    fn dark(drawing: &Drawing) -> usize {
        drawing.dark.iter().filter(|&&d| d == 1).count()
    }

    #[test]
    fn specks_below_the_size_go() {
        let mut d = drawing(&["#....##...###", "....#........"]);
        drop_specks(&mut d, 0.05, 0.15);
        assert_eq!(dark(&d), 6);
    }

    #[test]
    fn a_dashed_line_goes_and_two_dashes_stay() {
        let mut d =
            drawing(&["###.###.###.###", "...............", "...............", "...............", "###.###........"]);
        drop_annotation(&mut d, 0.05);
        assert_eq!(dark(&d), 6);
    }

    #[test]
    fn pillars_in_a_row_stay() {
        let mut d = drawing(&["######.######.######"; 6]);
        drop_annotation(&mut d, 0.05);
        assert_eq!(dark(&d), 108);
    }

    #[test]
    fn the_outline_of_a_coloured_dot_goes() {
        let mut d = drawing(&[".###..", "#ooo#.", "#ooo#.", "#ooo#.", ".###..", "......"]);
        drop_annotation(&mut d, 0.05);
        assert_eq!(dark(&d), 0);
    }
}
