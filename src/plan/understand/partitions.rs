//! Partitions that are drawn as single lines between thick walls.

use super::super::components::{Component, Components, Neighbours};
use super::super::thick::grow;
use super::gaps::{self, Gap};
use super::leaves;
use super::lines;
use super::net::{LEAST_ROOM_M2, Net};

/// Least length of the leaves of a door, as a share of the gap.
const LEAVES: f64 = 0.8;
/// Longest piece of a partition that is too short for a line, between a door and a wall, metres.
const JAMB_M: f64 = 0.4;

/// Fewest doors by which partitions are known.
const FEWEST_DOORS: usize = 2;

/// Adds the partitions to a net of thick walls, if there are any: lines that end at a gap in which the leaf of a door hangs,
/// and all that they join.
///
/// `search` finds a net in a mask of walls, with gaps up to so many pixels deep.
pub(super) fn added(
    net: Net,
    strokes: &[u8],
    ink: &[u8],
    width: usize,
    metres_per_pixel: f64,
    search: impl Fn(&[u8], usize) -> Option<Net>,
) -> Net {
    let free: Vec<u8> = ink.iter().zip(&net.wall).map(|(&i, &w)| i & (1 - w)).collect();
    // The panes of windows and the leaves of doors in thick walls are no partitions.
    let mut strokes = strokes.to_vec();
    let gaps = || net.doors.iter().chain(&net.windows);
    let in_gaps = gaps::mask(gaps(), ink.len());
    strokes.iter_mut().zip(grow(&in_gaps, width, 1)).for_each(|(stroke, near)| *stroke &= 1 - near);
    for at in net.doors.iter().flat_map(|gap| leaves::symbol(gap, &free, metres_per_pixel)) {
        strokes[at] = 0;
    }
    // What stands below a window is closed by it.
    let panes = grow(&gaps::mask(&net.windows, ink.len()), width, 1);
    let (lines, reach) = lines::thickened(&strokes, ink, &panes, width, metres_per_pixel);
    let mut lines: Vec<u8> = lines.iter().zip(&net.inside).map(|(&line, &inside)| line & inside).collect();
    let thickest = gaps().map(Gap::thickness).fold(0.0, f64::max) as usize + 2;
    // The gaps of thick walls are known: closed, they cannot be taken for others beside so thin walls.
    let with = |lines: &[u8]| -> Option<Net> {
        let closed = |at: usize| net.wall[at] | in_gaps[at] | lines[at];
        let both: Vec<u8> = (0..lines.len()).map(closed).collect();
        search(&both, thickest.max(3 * (2 * reach + 1)))
    };
    let Some(mut found) = with(&lines) else { return net };
    // Lines of a floor have leaves of all kinds.
    let is_hung = |gap: &&Gap| {
        let is_filled = |gap: &Gap| {
            let leaves: f64 = leaves::hung(gap, &free, metres_per_pixel).into_iter().sum();
            leaves >= LEAVES * gap.length() as f64
        };
        // A short jamb is no line: the gap reaches to the wall behind it.
        let most = ((JAMB_M / metres_per_pixel) as usize).min(gap.length() / 2);
        let jambs = || (1..=most).flat_map(|by| [[by, 0], [0, by]]);
        [0, reach, reach + 1].into_iter().any(|by| is_filled(&gap.widened(by)))
            || jambs().any(|by| is_filled(&gap.widened(reach).narrowed(by)))
    };
    let is_of_lines = |door: &&Gap| door.ends.iter().any(|&end| lines[end] != 0);
    let hung: Vec<&Gap> = found.doors.iter().filter(is_of_lines).filter(is_hung).collect();
    let rooms = |net: &Net| {
        let spaces = Components::of(&net.inside, width, 1, Neighbours::Four);
        let is_room = |space: &&Component| space.area as f64 * metres_per_pixel * metres_per_pixel >= LEAST_ROOM_M2;
        spaces.all.iter().filter(is_room).count()
    };
    // Doors lead to rooms: what looks like leaves among the lines of beds and stairs does not. Where nearly all doors are in
    // thick walls, partitions are thick.
    if hung.len() < FEWEST_DOORS.max(net.doors.len() / 2) || rooms(&found) < rooms(&net) + hung.len() / 2 {
        return net;
    }
    let ends: Vec<usize> = hung.into_iter().flat_map(|gap| gap.ends).filter(|&at| lines[at] != 0).collect();
    let pieces = Components::of(&lines, width, 1, Neighbours::Eight);
    let has_door =
        |piece: &&Component| pieces.ranges(piece, width).any(|range| ends.iter().any(|end| range.contains(end)));
    let others: Vec<&Component> = pieces.all.iter().filter(|piece| !has_door(piece)).collect();
    if !others.is_empty() {
        others.into_iter().for_each(|piece| pieces.paint(piece, &mut lines, width, 0));
        match with(&lines) {
            Some(fewer) => found = fewer,
            None => return net,
        }
    }
    // The lines themselves are the walls, and end where they are drawn to end.
    let near = grow(&found.inside, width, reach);
    for at in 0..ink.len() {
        found.wall[at] &= (net.wall[at] | ink[at]) & (1 - in_gaps[at]);
        found.inside[at] = near[at] & (1 - found.wall[at]);
    }
    for door in found.doors.iter_mut().filter(|door| door.ends.iter().all(|&end| lines[end] != 0)) {
        *door = door.widened(reach);
    }
    found.doors.splice(0..0, net.doors);
    found.windows.splice(0..0, net.windows);
    for at in found.doors.iter().chain(&found.windows).flat_map(Gap::pixels) {
        found.inside[at] = 0;
    }
    found
}
