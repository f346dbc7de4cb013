//! Grids on an image, turned so that walls of one direction run along their rows.

use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use rayon::prelude::*;

use crate::math::sin_cos;

/// A grid on the image, of any direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Size of the image and of the grid, pixels.
    image: [usize; 2],
    pub(super) size: [usize; 2],
    /// Where the grid's corner is in the image, and how one goes along and across its rows.
    corner: [f64; 2],
    pub(super) along: [f64; 2],
    across: [f64; 2],
}

impl Frame {
    pub(super) fn upright(image: [usize; 2]) -> Frame {
        Frame { image, size: image, corner: [0.0; 2], along: [1.0, 0.0], across: [0.0, 1.0] }
    }

    /// A grid around the image whose rows run at an angle, radians.
    pub(super) fn turned(image: [usize; 2], angle: f64) -> Frame {
        let (sine, cosine) = sin_cos(angle);
        let (along, across) = ([cosine, sine], [-sine, cosine]);
        let [w, h] = image.map(|side| side as f64);
        let range = |way: [f64; 2]| {
            let at = [[0.0, 0.0], [w, 0.0], [0.0, h], [w, h]].map(|[x, y]| x * way[0] + y * way[1]);
            (at.iter().copied().fold(f64::INFINITY, f64::min), at.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((u, u1), (v, v1)) = (range(along), range(across));
        let corner = [u * along[0] + v * across[0], u * along[1] + v * across[1]];
        Frame { image, size: [(u1 - u).ceil() as usize, (v1 - v).ceil() as usize], corner, along, across }
    }

    /// A grid on the image whose rows run at an angle, radians from 0 to half a turn; upright if that is about upright.
    pub(super) fn towards(image: [usize; 2], angle: f64) -> Frame {
        const UPRIGHT: f64 = 0.01;
        let quarters = angle / FRAC_PI_2;
        match quarters.round() {
            nearest if (quarters - nearest).abs() * FRAC_PI_2 > UPRIGHT => Frame::turned(image, angle),
            1.0 => Frame::upright(image).transposed(),
            _ => Frame::upright(image),
        }
    }

    /// The same with rows and columns exchanged.
    pub(super) fn transposed(self) -> Frame {
        Frame { size: [self.size[1], self.size[0]], along: self.across, across: self.along, ..self }
    }

    pub(super) fn is_upright(&self) -> bool {
        self.along[0] == 0.0 || self.along[1] == 0.0
    }

    pub(super) fn place(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.corner[k] + u * self.along[k] + v * self.across[k])
    }

    /// The place in the grid of one in the image.
    pub(super) fn within(&self, at: [f64; 2]) -> [f64; 2] {
        let off = [0, 1].map(|k| at[k] - self.corner[k]);
        [self.along, self.across].map(|way| off[0] * way[0] + off[1] * way[1])
    }

    pub(super) fn pixel(&self, at: [f64; 2]) -> Option<usize> {
        let [x, y] = self.place(at);
        let inside = x >= 0.0 && y >= 0.0 && x < self.image[0] as f64 && y < self.image[1] as f64;
        inside.then(|| y as usize * self.image[0] + x as usize)
    }

    /// What the grid shows of a mask: the pixel at each place, moved by a part of a pixel.
    pub(super) fn view(&self, mask: &[u8], moved: f64) -> Vec<u8> {
        const ONE: f64 = 65536.0;
        let [width, height] = self.image;
        let [right, down] = [self.along[0] * ONE, self.along[1] * ONE].map(|step| step.round() as i64);
        let mut seen = vec![0; self.size[0] * self.size[1]];
        seen.par_chunks_mut(self.size[0].max(1)).enumerate().for_each(|(v, row)| {
            let start = self.place([0.5, v as f64 + 0.5]).map(|at| ((at - 0.5 + moved) * ONE) as i64);
            let [in_columns, in_lines] = [
                steps_inside(start[0], right, (width as i64 - 1) << 16),
                steps_inside(start[1], down, (height as i64 - 1) << 16),
            ];
            let first = in_columns.start.max(in_lines.start).min(row.len() as i64);
            let end = in_columns.end.min(in_lines.end).clamp(first, row.len() as i64);
            let (mut x, mut y) = (start[0] + first * right, start[1] + first * down);
            for seen in &mut row[first as usize..end as usize] {
                *seen = mask[(y >> 16) as usize * width + (x >> 16) as usize];
                x += right;
                y += down;
            }
        });
        seen
    }
}

/// After how many steps a place lies in `0..end`.
fn steps_inside(start: i64, step: i64, end: i64) -> Range<i64> {
    let first = |at: i64| (at - start + step - 1).div_euclid(step).max(0);
    match step {
        // Going down is going up from the other end.
        ..0 => steps_inside(end - 1 - start, -step, end),
        0 if (0..end).contains(&start) => 0..i64::MAX,
        0 => 0..0,
        _ => first(0)..first(end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_counted_both_ways() {
        for (start, step, end) in
            [(-7, 3, 20), (25, -4, 20), (5, 2, 11), (19, -1, 20), (-5, 1, 0), (3, 0, 4), (4, 0, 4)]
        {
            let inside = |k: &i64| (0..end).contains(&(start + k * step));
            let found = steps_inside(start, step, end);
            assert!(
                (0..100).filter(inside).eq((0..100).filter(|k| found.contains(k))),
                "{start} {step} {end}: {found:?}"
            );
        }
    }
}
