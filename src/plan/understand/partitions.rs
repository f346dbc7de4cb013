//! Partitions that are drawn as single lines between thick walls.

use super::gaps::Gap;
use super::leaves;
use super::lines;
use super::net::Net;
use super::thick::grow;

/// Adds the partitions to a net of thick walls, if there are any: lines between which leaves of doors hang.
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
    let hung = |net: &Net| {
        let free: Vec<u8> = ink.iter().zip(&net.wall).map(|(&i, &w)| i & (1 - w)).collect();
        net.doors.iter().filter(|gap| !leaves::hung(gap, &free, metres_per_pixel).is_empty()).count()
    };
    let (lines, reach) = lines::thickened(strokes, ink, width, metres_per_pixel);
    let near = grow(&net.inside, width, 1);
    let both: Vec<u8> = (0..ink.len()).map(|at| net.wall[at] | (lines[at] & near[at])).collect();
    drop((lines, near));
    let Some(mut found) = search(&both, 3 * (2 * reach + 1)) else { return net };
    drop(both);
    if hung(&found) <= hung(&net) {
        return net;
    }
    // The lines themselves are the walls.
    let near = grow(&found.inside, width, reach);
    for at in 0..ink.len() {
        found.wall[at] &= net.wall[at] | ink[at];
        found.inside[at] = near[at] & (1 - found.wall[at]);
    }
    for at in found.doors.iter().chain(&found.windows).flat_map(Gap::pixels) {
        found.inside[at] = 0;
    }
    found
}
