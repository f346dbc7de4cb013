//! Nets of walls that are drawn as outlines or by hatches, beside massive ones or alone.

use super::super::thick::grow;
use super::hollow;
use super::net::Net;

/// Share of a building that is enclosed and joined by doors, from which no other walls are tried, and by which others have to
/// do better.
pub(super) const WELL_CLOSED: f64 = 0.85;
pub(super) const BETTER: f64 = 0.05;

/// Finds the net of walls that are drawn as outlines or by hatches, or as both.
///
/// `core` has the strokes that are surely dark. `search` finds a net in a mask of what is surely wall, and one with its edges;
/// up to so many pixels are strokes. Whether the paper is clean, `is_clean` says.
pub(super) fn net(
    [strokes, core]: [&[u8]; 2],
    width: usize,
    metres_per_pixel: f64,
    is_clean: bool,
    search: impl Fn(&[u8], &[u8], usize) -> Option<Net>,
) -> Option<Net> {
    // The soft edges of leaves and furniture are as thick as thin walls together with them.
    let sought = |filled: &[u8]| {
        let fills: Vec<u8> = strokes.iter().zip(filled).map(|(&stroke, &filled)| filled & (1 - stroke)).collect();
        let stroke_px = hollow::stroke_px(strokes, &fills, width, metres_per_pixel);
        if stroke_px == 0 {
            return search(filled, filled, 0);
        }
        let near = grow(&fills, width, stroke_px);
        let sure: Vec<u8> = (0..near.len()).map(|at| filled[at] & (near[at] | core[at])).collect();
        search(&sure, filled, stroke_px)
    };
    let share_closed = |net: &Option<Net>| net.as_ref().map_or(0.0, |net| net.enclosed * net.joined(width));
    let toothed = hollow::fill_teeth(strokes, width, metres_per_pixel);
    let outlined = hollow::fill_outlines(&toothed, width, metres_per_pixel);
    let best = sought(&outlined);
    let is_well_closed = |net: &Option<Net>| share_closed(net) >= WELL_CLOSED;
    if is_well_closed(&best) {
        return best;
    }
    // Where there is nothing more to fill, the search ends as before.
    let better = |best: Option<Net>, filled: &[u8], tried: &[&[u8]]| {
        let found = if tried.contains(&filled) { None } else { sought(filled) };
        if share_closed(&found) > share_closed(&best) + BETTER { found } else { best }
    };
    let hatched = hollow::fill_hatches(&toothed, width, metres_per_pixel);
    let best = better(best, &hatched, &[&outlined]);
    if is_well_closed(&best) {
        return best;
    }
    let both = hollow::fill_outlines(&hatched, width, metres_per_pixel);
    let best = better(best, &both, &[&outlined, &hatched]);
    // On clean paper strokes are drawn by a machine, and meet.
    if is_clean || is_well_closed(&best) {
        return best;
    }
    better(best, &hollow::fill_pairs(&toothed, width, metres_per_pixel), &[&outlined, &hatched])
}
