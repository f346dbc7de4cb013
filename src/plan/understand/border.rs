//! The border of a sheet, which is no wall.

use super::super::components::{Component, Components, Neighbours};
use super::super::thick::{THINNEST_M, open};

/// Greatest thickness of a sheet's frame that has little within, metres.
const FINE_FRAME_M: f64 = 0.12;

/// Takes off the frame of a sheet: strokes around all others that have less area than those within.
pub(super) fn drop(core: &mut [u8], ink: &[u8], width: usize, metres_per_pixel: f64) {
    let thick = open(core, width, ((THINNEST_M / metres_per_pixel).ceil() as usize).max(2));
    let pieces = Components::of(&thick, width, 1, Neighbours::Eight);
    let mut largest: Vec<&Component> = pieces.all.iter().collect();
    largest.sort_by_key(|p| std::cmp::Reverse(u64::from(p.size()[0]) * u64::from(p.size()[1])));
    for piece in largest.into_iter().take(3) {
        let within = |p: &&Component| (0..2).all(|axis| p.min[axis] > piece.min[axis] && p.end[axis] < piece.end[axis]);
        let inner: usize = pieces.all.iter().filter(within).map(|p| p.area).sum();
        let [w, h] = piece.size().map(f64::from);
        let stroke = piece.area as f64 / (2.0 * (w + h));
        let is_fine = stroke <= (FINE_FRAME_M / metres_per_pixel).max(3.6);
        let strokes = || {
            let rows = piece.min[1] as usize + 4..(piece.end[1] as usize).saturating_sub(4);
            let columns =
                piece.min[0] as usize + 4..(piece.end[0] as usize).saturating_sub(4).max(piece.min[0] as usize + 4);
            rows.map(|y| ink[y * width..][columns.clone()].iter().filter(|&&i| i != 0).count()).sum::<usize>()
        };
        if inner <= piece.area && !(is_fine && strokes() * 10 >= piece.area * 3) {
            continue;
        }
        let mut mask = vec![0u8; core.len()];
        pieces.paint(piece, &mut mask, width, 1);
        if has_four_sides(&mask, width, piece.around()) {
            pieces.paint(piece, core, width, 0);
        }
    }
}

/// Whether a piece covers all four sides of its box without a gap.
fn has_four_sides(mask: &[u8], width: usize, [x0, y0, x1, y1]: [u32; 4]) -> bool {
    let dark = |x: u32, y: u32| mask[y as usize * width + x as usize] != 0;
    let side = |length: u32, at: &dyn Fn(u32) -> bool| {
        (0..length).filter(|&k| at(k)).count() as f64 >= 0.97 * f64::from(length)
    };
    side(x1 - x0, &|k| dark(x0 + k, y0 + 1) || dark(x0 + k, y0))
        && side(x1 - x0, &|k| dark(x0 + k, y1 - 1) || dark(x0 + k, y1.max(2) - 2))
        && side(y1 - y0, &|k| dark(x0, y0 + k) || dark(x0 + 1, y0 + k))
        && side(y1 - y0, &|k| dark(x1 - 1, y0 + k) || dark(x1.max(2) - 2, y0 + k))
}
