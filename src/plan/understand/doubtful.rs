//! Gaps that may be doors or not: beside furniture, in thick walls, and those that are the only way into a room.

use super::super::components::{Component, Components, Neighbours};
use super::gaps::Gap;

/// Greatest share of an outline as far apart as a wall's that is dark.
const OUTLINED_INK: f64 = 0.6;
/// Fewest doors with leaves, and at least half of all, of which it is said that doors have leaves.
const FEWEST_HUNG: usize = 3;
/// How many gaps with a single line a closed room has at most, if they are doors; a court has more windows.
const MOST_WAYS_IN: usize = 3;

/// Takes off doors without a leaf that are thicker than the walls in which windows and leaves are: baths and desks that are
/// drawn as outline walls are do not end walls. Outer walls are thicker than all others: what leads to the outside stays;
/// `enclosed` marks what is inside with some doors closed.
pub(super) fn drop_thicker_than_walls(
    doors: &mut Vec<Gap>,
    windows: &[Gap],
    has_leaf: impl Fn(&Gap) -> bool,
    enclosed: impl Fn(&[Gap]) -> Vec<u8>,
) {
    /// Fewest gaps of walls that say how thick walls are, and how much thicker a wall may be.
    const FEWEST: usize = 3;
    const THICKER: f64 = 1.25;
    let hung: Vec<bool> = doors.iter().map(has_leaf).collect();
    let of_leaves = doors.iter().zip(&hung).filter(|(_, hung)| **hung).map(|(gap, _)| gap);
    let thick: Vec<f64> = of_leaves.chain(windows).map(Gap::thickness).collect();
    let most = thick.iter().copied().fold(0.0, f64::max) * THICKER + 1.0;
    if thick.len() < FEWEST || doors.iter().all(|gap| gap.thickness() <= most) {
        return;
    }
    let inside = enclosed(doors);
    let mut hung = hung.into_iter();
    doors.retain(|gap| hung.next() == Some(true) || gap.thickness() <= most || gap.leads_out(&inside));
}

/// Takes off bare doors that end at a small piece of wall, up to `largest` pixels, without another gap straight on behind
/// it, as a pier between two doors has: columns, dark furniture and the outlines of beds are no jambs. Outlines are larger,
/// and have neither windows nor leaves beside them; where most doors have leaves, a line in the gap makes it no door.
pub(super) fn drop_beside_furniture(
    doors: &mut Vec<Gap>,
    windows: &[Gap],
    (wall, raw): (&[u8], &[u8]),
    width: usize,
    [largest, largest_outlined]: [usize; 2],
    has_leaf: impl Fn(&Gap) -> bool,
) {
    let hung: Vec<bool> = doors.iter().map(has_leaf).collect();
    let most_hung = hung.iter().filter(|&&hung| hung).count() * 2 >= doors.len().max(FEWEST_HUNG * 2);
    let is_bare = |k: usize| doors[k].strokes == 0 && !hung[k];
    let pieces = Components::of(wall, width, 1, Neighbours::Eight);
    let is_door = |k: &usize| if most_hung { hung[*k] } else { !is_bare(*k) };
    let built = (0..doors.len()).filter(is_door).map(|k| &doors[k]).chain(windows);
    let jambs: Vec<usize> = built.flat_map(|gap| gap.ends).collect();
    let is_small = |piece: &Component| {
        let side = piece.larger_side() as usize;
        let ranges = || pieces.ranges(piece, width);
        let dark = || ranges().flatten().filter(|&at| raw[at] != 0).count() as f64;
        side <= largest
            || side <= largest_outlined
                && dark() <= OUTLINED_INK * piece.area as f64
                && !ranges().any(|range| jambs.iter().any(|jamb| range.contains(jamb)))
    };
    let small: Vec<&Component> = pieces.all.iter().filter(|piece| is_small(piece)).collect();
    let piece_at = |at: usize| small.iter().position(|piece| pieces.ranges(piece, width).any(|r| r.contains(&at)));
    let at_pieces = |gap: &Gap| (gap.ends.map(piece_at), gap.along(), gap.middle().1, gap.thickness());
    let gaps: Vec<_> = doors.iter().chain(windows).map(at_pieces).collect();
    let mut kept = vec![true; gaps.len()];
    loop {
        let goes_on = |k: usize, end: usize| {
            let (pieces, along, across, thickness) = &gaps[k];
            pieces[end].is_none()
                || gaps.iter().zip(&kept).any(|((other, way, at, thick), &kept)| {
                    let is_straight_on = (at - across).abs() <= 0.5 * (thick + thickness);
                    kept && way == along && other[1 - end] == pieces[end] && is_straight_on
                })
        };
        let is_outlined = |piece: Option<usize>| {
            piece.is_some_and(|piece| most_hung && small[piece].larger_side() as usize > largest)
        };
        let is_none = |&k: &usize| {
            let ends_there = |end: usize| !goes_on(k, end) && (is_bare(k) || is_outlined(gaps[k].0[end]));
            kept[k] && !hung[k] && (ends_there(0) || ends_there(1))
        };
        let gone: Vec<usize> = (0..doors.len()).filter(is_none).collect();
        if gone.is_empty() {
            break;
        }
        gone.into_iter().for_each(|k| kept[k] = false);
    }
    let mut kept = kept.into_iter();
    doors.retain(|_| kept.next().unwrap_or(true));
}

/// Takes gaps with a single line for doors where they alone lead into a room: nobody builds rooms without a door. Rooms have
/// at least so many pixels; `may_open` tells which gaps may be doors.
pub(super) fn open_closed_rooms(
    doors: &mut Vec<Gap>,
    windows: &mut Vec<Gap>,
    inside: &[u8],
    width: usize,
    least_px: f64,
    may_open: impl Fn(&Gap) -> bool,
) {
    if !windows.iter().any(&may_open) {
        return;
    }
    let rooms = Components::of(inside, width, 1, Neighbours::Four);
    let room_at = rooms.index(width);
    let beside = |gap: &Gap| gap.sides().into_iter().flatten().filter_map(&room_at).collect::<Vec<usize>>();
    let has_door: Vec<usize> = doors.iter().flat_map(beside).collect();
    let ways: Vec<Vec<usize>> =
        windows.iter().map(|gap| if may_open(gap) { beside(gap) } else { Vec::new() }).collect();
    let is_closed = |room: usize| {
        let count = ways.iter().filter(|rooms| rooms.contains(&room)).count();
        !has_door.contains(&room) && count <= MOST_WAYS_IN && rooms.all[room].area as f64 >= least_px
    };
    let opens: Vec<bool> = ways.iter().map(|rooms| rooms.iter().any(|&room| is_closed(room))).collect();
    let mut opens = opens.into_iter();
    doors.extend(windows.extract_if(.., |_| opens.next() == Some(true)));
}
