//! Coarse map of the floor, for skipping blocks without floor.

use super::lattice::TexelWindow;
use super::padding::PADDING;
use crate::walls::Walls;

/// Side of the map's squares, texels.
const SIDE: i64 = 32;

/// Share of floor in each square of texels.
pub(super) struct CoarseFloor {
    width: i64,
    height: i64,
    shares: Vec<CoarseShare>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CoarseShare {
    Nothing,
    Some,
    All,
}

impl CoarseFloor {
    pub fn of(walls: &Walls, texels_per_metre: f64, width: u32, height: u32) -> CoarseFloor {
        let [width, height] = [width, height].map(|texels| i64::from(texels).div_euclid(SIDE) + 1);
        let mut share = vec![0.0; (width * height) as usize];
        walls.cleared_coverage(texels_per_metre / SIDE as f64, [0, 0], [width as usize, height as usize], &mut share);
        let shares = share.into_iter().map(|share| match share {
            0.0 => CoarseShare::Nothing,
            1.0 => CoarseShare::All,
            _ => CoarseShare::Some,
        });
        CoarseFloor { width, height, shares: shares.collect() }
    }

    /// Share of floor in a window and its padding.
    pub fn of_window(&self, window: &TexelWindow) -> CoarseShare {
        let squares = |from: i64, count: usize, grown: i64| {
            (from - grown).div_euclid(SIDE)..=(from + count as i64 - 1 + grown).div_euclid(SIDE)
        };
        let at = |i: i64, j: i64| {
            let inside = (0..self.width).contains(&i) && (0..self.height).contains(&j);
            if inside { self.shares[(j * self.width + i) as usize] } else { CoarseShare::Nothing }
        };
        let all = |grown: i64, wanted: CoarseShare| {
            squares(window.j0, window.height, grown)
                .all(|j| squares(window.i0, window.width, grown).all(|i| at(i, j) == wanted))
        };
        if all(0, CoarseShare::All) {
            CoarseShare::All
        } else if all(PADDING as i64 + 1, CoarseShare::Nothing) {
            CoarseShare::Nothing
        } else {
            CoarseShare::Some
        }
    }
}
