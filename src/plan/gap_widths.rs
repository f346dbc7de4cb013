//! Widths of what may be doors, before the scale is known: gaps in thick walls, bars of colour in thin ones.

use super::components::{Component, Components, Neighbours};
use super::drawing::Drawing;

/// A stretch of white between two walls in rows that follow each other.
struct Gap {
    from: usize,
    to: usize,
    first: usize,
    last: usize,
}

/// Widths of the gaps in walls that run along the rows, with their weights. `is_ink` is of the drawing with its strokes.
pub(super) fn doorways(walls: &[u8], width: usize, is_ink: impl Fn(usize, usize) -> bool) -> Vec<(f64, f64)> {
    const LEAST_PX: usize = 6;
    /// Width of a gap for each pixel by which its ends may wobble from row to row.
    const WOBBLE: usize = 25;
    let height = walls.len() / width;
    let widest = width / 4;
    let mut doors = Vec::new();
    let mut open: Vec<Gap> = Vec::new();
    let mut close = |gap: Gap| {
        let weight = doorway(walls, width, &gap, &is_ink);
        if weight > 0.0 {
            doors.push(((gap.to - gap.from) as f64, weight));
        }
    };
    for y in 0..height {
        let row = &walls[y * width..(y + 1) * width];
        let mut next: Vec<Gap> = Vec::new();
        let mut x = row.iter().position(|&m| m != 0).unwrap_or(width);
        while x < width {
            let Some(from) = row[x..].iter().position(|&m| m == 0).map(|k| x + k) else { break };
            let Some(to) = row[from..].iter().position(|&m| m != 0).map(|k| from + k) else { break };
            if (LEAST_PX..=widest).contains(&(to - from)) {
                // Ends that are inked by hand wobble.
                let most = 1 + (to - from) / WOBBLE;
                let same = |gap: &Gap| gap.from.abs_diff(from) <= most && gap.to.abs_diff(to) <= most;
                match open.iter().position(same) {
                    Some(k) => {
                        let gap = open.swap_remove(k);
                        next.push(Gap { from: gap.from.max(from), to: gap.to.min(to), last: y, ..gap });
                    }
                    None => next.push(Gap { from, to, first: y, last: y }),
                }
            }
            x = to;
        }
        open.drain(..).for_each(&mut close);
        open = next;
        open.sort_by_key(|gap| gap.from);
    }
    open.into_iter().for_each(close);
    doors
}

/// The weight of a gap as a door: 1 between two ends of walls, 1/2 between an end and a wall, 0 for what is no door.
fn doorway(walls: &[u8], width: usize, gap: &Gap, is_ink: impl Fn(usize, usize) -> bool) -> f64 {
    const BEYOND: usize = 3;
    let height = walls.len() / width;
    let (across, deep) = (gap.to - gap.from, gap.last - gap.first + 1);
    if deep * 5 > across * 4 || gap.first < BEYOND || gap.last + BEYOND >= height {
        return 0.0;
    }
    let free = |x: usize, y: usize| walls[y * width + x] == 0;
    let reach = (deep / 2).max(2);
    let (above, below) = (gap.first - BEYOND, gap.last + BEYOND);
    let is_end = |columns: std::ops::Range<usize>| columns.into_iter().all(|x| free(x, above) && free(x, below));
    let left = gap.from > reach && is_end(gap.from - reach - 1..gap.from - 1);
    let right = gap.to + reach < width && is_end(gap.to + 1..gap.to + reach + 1);
    // Walls run on from the gap: what has only corners there are slanting lines and the grain of scans.
    let runs_on = |right: bool| {
        (gap.first.saturating_sub(1)..=gap.last + 1).any(|y| {
            let row = &walls[y * width..(y + 1) * width];
            let run = match right {
                true => row[gap.to..].iter().take_while(|&&m| m != 0).count(),
                false => row[..gap.from].iter().rev().take_while(|&&m| m != 0).count(),
            };
            run * 10 >= across * 3 && run >= deep
        })
    };
    let (left, right) = (left && runs_on(false), right && runs_on(true));
    // It must lead somewhere on both sides.
    let middle = (gap.from + gap.to) / 2;
    if !free(middle, above) || !free(middle, below) {
        return 0.0;
    }
    // Lines along the wall from end to end are a window; a single one is a threshold.
    let is_line = |y: usize| {
        let dark = (gap.from + 1..gap.to - 1).filter(|&x| is_ink(x, y)).count();
        dark * 10 >= (across - 2) * 9
    };
    let rows = (gap.first.saturating_sub(1)..=gap.last + 1).map(is_line).collect::<Vec<_>>();
    let lines = rows.iter().enumerate().filter(|&(k, &line)| line && (k == 0 || !rows[k - 1])).count();
    let filled = rows.iter().filter(|&&line| line).count() * 2 > rows.len();
    match (lines >= 2 || filled, left, right) {
        (false, true, true) => 1.0,
        (false, true, false) | (false, false, true) => 0.5,
        _ => 0.0,
    }
}

/// Lengths of the bars of colour over the gaps of thin lines, with their weights. Those in the blue of panes are windows.
pub(super) fn coloured_doors(drawing: &Drawing) -> Vec<(f64, f64)> {
    const THICKEST_PX: u32 = 12;
    const SLENDER: u32 = 3;
    const FILLED: f64 = 0.8;
    /// How far beyond its ends the wall goes on, pixels: edges are soft.
    const BEYOND_PX: usize = 3;
    let width = drawing.width;
    let pieces = Components::of(&drawing.without_panes(&drawing.coloured), width, 1, Neighbours::Eight);
    let length = |bar: &Component| {
        let [w, h] = bar.size();
        let (length, thick) = (w.max(h), w.min(h));
        let is_bar = thick <= THICKEST_PX && length >= SLENDER * thick && bar.area as f64 >= FILLED * f64::from(w * h);
        let along = usize::from(h > w);
        let step = [1, width][along];
        let middle = [0, 1].map(|axis| (bar.min[axis] + bar.end[axis]) as usize / 2);
        let place =
            |at: u32| if along == 0 { middle[1] * width + at as usize } else { at as usize * width + middle[0] };
        let is_wall = |at: Option<usize>| at.is_some_and(|at| drawing.dark.get(at) == Some(&1));
        let run = |at: &dyn Fn(usize) -> Option<usize>| {
            let first = (0..BEYOND_PX).find(|&k| is_wall(at(k)))?;
            Some((first..).take_while(|&k| is_wall(at(k))).count())
        };
        let before = run(&|k| place(bar.min[along]).checked_sub((k + 1) * step));
        let after = run(&|k| Some(place(bar.end[along]) + k * step));
        // One end may lie in a corner.
        let goes_on = before.zip(after).is_some_and(|(a, b)| a.max(b) >= (SLENDER * thick) as usize);
        (is_bar && goes_on).then_some((f64::from(length), 1.0))
    };
    pieces.all.iter().filter_map(length).collect()
}
