//! Furniture on floors that are rendered from above: what differs from most of a room's floor.

use super::clearance::{dilate, erode, opened};
use super::components::{Component, Components, Neighbours};

/// Pixels along the longer side of the reduced image in which pieces are sought: it has no grain and no joints of planks.
const REDUCED_PX: usize = 480;
/// Half of the widest door in buildings of several sizes, as a share of the longer side.
const HALF_A_DOOR: [f64; 4] = [0.02, 0.03, 0.04, 0.05];
/// How far a channel is from the middle of a room's floor at least, and for how far half of the floor is.
const LEAST_CONTRAST: f64 = 26.0;
const SPREADS: f64 = 3.5;
/// Radius of a disc that fits into pieces, as a share of the longer side: shadows and leaves are narrower.
const SLIMMEST: f64 = 0.008;
/// Least and greatest area of a piece as shares of the image's, and greatest share of its room.
const AREA: [f64; 2] = [0.0004, 0.03];
const OF_ROOM: f64 = 0.4;
/// Greatest area of a mat as a share of the image's.
const LARGEST_MAT: f64 = 0.006;
/// Half of a person's breadth for half of a door's width, and least share of a room that furniture may not part from the rest.
const SHOULDER: f64 = 0.5;
const LEAST_PART: f64 = 0.05;
/// Thickness of outlines.
const OUTLINE_PX: f64 = 2.0;

/// 1 for the outlines of furniture between `walls`.
pub(super) fn find(colours: &[[u8; 3]], walls: &[u8], width: usize) -> Vec<u8> {
    let height = walls.len() / width;
    let longer = width.max(height);
    let side = longer.div_ceil(REDUCED_PX);
    let (w, h) = (width / side, height / side);
    if w * h == 0 {
        return vec![0; walls.len()];
    }
    let block = |k: usize| {
        let (x, y) = (k % w * side, k / w * side);
        (y..y + side).flat_map(move |y| (x..x + side).map(move |x| y * width + x))
    };
    let mean = |k: usize| {
        let sum = block(k).fold([0u32; 3], |sum, at| [0, 1, 2].map(|c| sum[c] + u32::from(colours[at][c])));
        sum.map(|v| v as f64 / (side * side) as f64)
    };
    let tones: Vec<[f64; 3]> = (0..w * h).map(mean).collect();
    let solid: Vec<u8> = (0..w * h).map(|k| u8::from(block(k).any(|at| walls[at] != 0))).collect();
    let px = |share: f64| share * w.max(h) as f64;
    let mut pieces = vec![0; w * h];
    let (rooms, half_a_door) = rooms(&solid, w, HALF_A_DOOR.map(px));
    for room in rooms {
        let [middle, spread] = floor(room.iter().map(|&k| tones[k]).collect());
        let differs =
            |k: usize| (0..3).any(|c| (tones[k][c] - middle[c]).abs() > LEAST_CONTRAST.max(SPREADS * spread[c]));
        let mut mask = vec![0; w * h];
        room.iter().filter(|&&k| differs(k)).for_each(|&k| mask[k] = 1);
        let found = Components::of(&opened(&mask, w, px(SLIMMEST)), w, 1, Neighbours::Four);
        let area = AREA.map(|share| share * (w * h) as f64);
        let is_piece =
            |piece: &&Component| (area[0]..=area[1].min(OF_ROOM * room.len() as f64)).contains(&(piece.area as f64));
        let mut free = vec![0; w * h];
        room.iter().for_each(|&k| free[k] = 1);
        found.all.iter().filter(is_piece).for_each(|piece| found.paint(piece, &mut free, w, 0));
        // What is small and people cannot go round is a mat.
        let parts = |free: &[u8]| {
            let passable = Components::of(&erode(free, w, SHOULDER * half_a_door), w, 1, Neighbours::Four);
            passable.all.iter().filter(|part| part.area as f64 >= LEAST_PART * room.len() as f64).count()
        };
        let may_be_mat = |piece: &&Component| piece.area as f64 <= LARGEST_MAT * (w * h) as f64;
        let mut fewest = parts(&free);
        for piece in found.all.iter().filter(is_piece).filter(may_be_mat) {
            found.paint(piece, &mut free, w, 1);
            match parts(&free) {
                fewer if fewer < fewest => fewest = fewer,
                _ => found.paint(piece, &mut free, w, 0),
            }
        }
        room.iter().for_each(|&k| pieces[k] = 1 - free[k]);
    }
    let at = |at: usize| (at / width / side).min(h - 1) * w + (at % width / side).min(w - 1);
    let pieces: Vec<u8> = (0..walls.len()).map(|k| pieces[at(k)] & (1 - walls[k])).collect();
    let within = erode(&pieces, width, OUTLINE_PX);
    pieces.iter().zip(within).map(|(piece, within)| piece & (1 - within)).collect()
}

/// The middle of a floor's tones, and how far half of them are from it; per channel.
fn floor(tones: Vec<[f64; 3]>) -> [[f64; 3]; 2] {
    let median = |of: &dyn Fn(&[f64; 3]) -> f64| {
        let mut all: Vec<f64> = tones.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    };
    let middle = [0, 1, 2].map(|c| median(&|tone| tone[c]));
    [middle, [0, 1, 2].map(|c| median(&|tone| (tone[c] - middle[c]).abs()))]
}

/// The places of each room, parted at doors as wide as there are most rooms, and half of that width; what lies outside is none.
fn rooms(solid: &[u8], width: usize, half_a_door: [f64; 4]) -> (Vec<Vec<usize>>, f64) {
    let height = solid.len() / width;
    let cores = |half: f64| Components::of(&dilate(solid, width, half), width, 0, Neighbours::Four);
    let inside = |cores: &Components| cores.all.iter().filter(|core| !core.is_at_side(width, height)).count();
    let parted = half_a_door.map(|half| (cores(half), half));
    let Some((cores, half_a_door)) = parted.into_iter().rev().max_by_key(|(cores, _)| inside(cores)) else {
        return (Vec::new(), 0.0);
    };
    let mut room_at = vec![usize::MAX; solid.len()];
    let mut rooms: Vec<Vec<usize>> = Vec::new();
    for (k, core) in cores.all.iter().enumerate() {
        cores.paint(core, &mut room_at, width, k);
        rooms.push(cores.ranges(core, width).flatten().collect());
    }
    // Rooms grow back to their walls, all at once.
    let mut edge: Vec<usize> = rooms.iter().flatten().copied().collect();
    for _ in 0..half_a_door.ceil() as usize {
        let mut next = Vec::new();
        for at in edge {
            for near in [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width] {
                if solid.get(near) == Some(&0) && room_at[near] == usize::MAX {
                    room_at[near] = room_at[at];
                    rooms[room_at[at]].push(near);
                    next.push(near);
                }
            }
        }
        edge = next;
    }
    let is_inside = |room: &Vec<usize>| {
        room.iter().all(|&at| (1..width - 1).contains(&(at % width)) && (1..height - 1).contains(&(at / width)))
    };
    rooms.retain(is_inside);
    (rooms, half_a_door)
}
