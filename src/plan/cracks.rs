//! Traces the boundary between floor and wall along pixel edges ("cracks").
//!
//! imageproc's contours run through pixel centres instead.

/// A closed boundary: a lattice point per crack, pixels from the top left, floor on the right.
pub(crate) type CrackLoop = Vec<[i32; 2]>;

/// Directions in image coordinates (y down), each a quarter turn clockwise from the last.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// Traces all boundaries of the non-zero pixels of a mask.
///
/// Floor is 4-connected: boundaries that touch at a corner stay separate.
pub(crate) fn trace(mask: &[u8], width: usize) -> Vec<CrackLoop> {
    let (width, height) = (width as i32, (mask.len() / width) as i32);
    let floor = |x: i32, y: i32| {
        x >= 0 && y >= 0 && x < width && y < height && mask[y as usize * width as usize + x as usize] != 0
    };
    let mut loops = Vec::new();
    // Marks the top cracks of floor pixels that were followed; every loop has one.
    let mut followed = vec![false; mask.len()];
    for y in 0..height {
        for x in 0..width {
            if floor(x, y) && !floor(x, y - 1) && !followed[y as usize * width as usize + x as usize] {
                loops.push(follow([x, y], &floor, width as usize, &mut followed));
            }
        }
    }
    loops
}

/// Follows one boundary eastwards, from the upper-left corner of a floor pixel below wall.
fn follow(start: [i32; 2], floor: &impl Fn(i32, i32) -> bool, width: usize, followed: &mut [bool]) -> CrackLoop {
    let mut points = Vec::new();
    let [mut x, mut y] = start;
    let mut direction = 0;
    loop {
        if direction == 0 {
            followed[y as usize * width + x as usize] = true;
        }
        points.push([x, y]);
        x += STEPS[direction][0];
        y += STEPS[direction][1];
        // The two pixels ahead, on the right and on the left.
        let (right, left) = match direction {
            0 => ([x, y], [x, y - 1]),
            1 => ([x - 1, y], [x, y]),
            2 => ([x - 1, y - 1], [x - 1, y]),
            _ => ([x, y - 1], [x - 1, y - 1]),
        };
        direction = if !floor(right[0], right[1]) {
            (direction + 1) % 4
        } else if floor(left[0], left[1]) {
            (direction + 3) % 4
        } else {
            direction
        };
        if [x, y] == start && direction == 0 {
            return points;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_followed_clockwise_and_a_hole_the_other_way() {
        assert_eq!(trace(&[1], 1), [[[0, 0], [1, 0], [1, 1], [0, 1]]]);
        let loops = trace(&[1, 1, 1, 1, 0, 1, 1, 1, 1], 3);
        assert_eq!(loops.len(), 2);
        assert_eq!(loops[1], [[1, 2], [2, 2], [2, 1], [1, 1]].map(|p: [i32; 2]| p));
    }

    #[test]
    fn pixels_that_touch_at_a_corner_stay_apart() {
        assert_eq!(trace(&[1, 0, 0, 1], 2).len(), 2);
        // Two holes that touch at a corner have one boundary: wall is 8-connected.
        assert_eq!(trace(&[1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1], 4).len(), 2);
    }
}
