//! Cleaning: what a mop leaves of the film.
//!
//! Whoever cleans goes back and forth along the longer way of a place, a pass beside the other, and swings the mop or
//! drives a machine. Passes differ; between them, where dirty water dries, a line stays; swings leave arcs. Along walls
//! and in corners nothing is taken. The pattern of the last two cleanings shows; those before have evened out.

use super::cells::{rise, smooth, smooth_along, unit};
use super::lattice::{SplineAxis, SplineLattice, TexelWindow};
use super::noise::{self, Channel};
use super::settings::MopLook;
use crate::math::exp_f32;
use crate::walls::Walls;

/// Cells in which the longer way is found, per metre, and how far it is looked for.
const CELLS_PER_M: f64 = 2.0;
const LOOK_M: f64 = 8.0;
/// Distances from walls at which the mop takes nothing, and all it can, metres.
const MISSED_M: [f32; 2] = [0.05, 0.18];
/// Length of a swing along the pass, metres.
const SWING_M: f64 = 0.27;
/// Share of a pass's width, on either side of its border, in which it blends into the next.
const OVERLAP: f32 = 0.22;
/// Spacing of the lattice on which the pattern is laid out, metres.
const SPACING_M: f64 = 0.025;
/// Weights of the last cleaning and of the one before.
const CLEANINGS: [f32; 2] = [0.85, 0.4];

/// Cleaning of which the look's film is, people from one to the next.
const USUALLY_EVERY: f32 = 1000.0;
/// Share of the film that is trodden in, and that no mop takes.
const TRODDEN_IN: f32 = 0.3;

impl MopLook {
    /// How many passes' film lies on the floor, relative to the usual cleaning. What can be taken tends to that of
    /// `every / takes` people; it is never more than that of all.
    pub(super) fn passes_left(&self, total_passes: u64) -> f32 {
        let lying = |every: f32| (every / self.takes.max(0.05)).min(total_passes as f32);
        let loose = lying(self.every) / lying(USUALLY_EVERY).max(1.0);
        if self.every == USUALLY_EVERY { 1.0 } else { TRODDEN_IN + (1.0 - TRODDEN_IN) * loose }
    }
}

/// Ways of cleaning over a whole floor.
pub(super) struct Mopping {
    takes: f32,
    width_m: f64,
    unevenness: f32,
    key: u32,
    columns: i64,
    rows: i64,
    /// Share of passes along x, per cell.
    along_x: Vec<f32>,
}

impl Mopping {
    /// Returns nothing if the mop takes nothing.
    pub fn new(walls: &Walls, look: &MopLook, (seed, total_passes): (u64, u64)) -> Option<Mopping> {
        if look.takes == 0.0 {
            return None;
        }
        let bounds = walls.bounds_m();
        let cells = |metres: f64| (metres * CELLS_PER_M).ceil().max(0.0) as i64 + 1;
        let (columns, rows) = (cells(bounds.max.x), cells(bounds.max.y));
        let mut share = vec![0.0; (columns * rows) as usize];
        walls.coverage(CELLS_PER_M, 0, 0, columns as usize, rows as usize, &mut share);
        let runs = |first: usize, step: usize, count: usize, out: &mut [f32]| {
            // Length of the run of floor that each cell is in, up to where anybody would turn.
            let mut from = 0;
            for k in 0..=count {
                if k == count || share[first + k * step] < 0.5 {
                    let length = ((k - from) as f32).min((LOOK_M * CELLS_PER_M) as f32);
                    (from..k).for_each(|n| out[first + n * step] = length);
                    from = k + 1;
                }
            }
        };
        let (mut x, mut y) = (vec![0.0; share.len()], vec![0.0; share.len()]);
        (0..rows as usize).for_each(|row| runs(row * columns as usize, 1, columns as usize, &mut x));
        (0..columns as usize).for_each(|column| runs(column, columns as usize, rows as usize, &mut y));
        let along_x = x.iter().zip(&y).map(|(x, y)| rise(x / (x + y).max(1.0), 0.4, 0.6)).collect();
        let MopLook { width_m, unevenness, .. } = *look;
        // Before the first cleaning nothing is taken.
        let takes = look.takes * (total_passes as f32 / look.every).min(1.0);
        Some(Mopping { takes, width_m, unevenness, key: noise::key(seed, Channel::Mop), columns, rows, along_x })
    }

    /// Unevenness of cleaning over a window: 0 where the mop took its mean share, 1 where it took nothing.
    pub fn over(&self, window: &TexelWindow) -> SplineLattice {
        // Coarse texels even the pattern out.
        let spacing_m = SPACING_M.max(1.0 / window.texels_per_metre);
        let shown = (0.5 * self.width_m * window.texels_per_metre).min(1.0) as f32;
        let axis = |texel0, count| SplineAxis::new(texel0, count, spacing_m * window.texels_per_metre, 0.0);
        let (x, y) = (axis(window.i0, window.width), axis(window.j0, window.height));
        let mut values = Vec::with_capacity(x.len * y.len);
        for j in 0..y.len as i64 {
            for i in 0..x.len as i64 {
                let place = [x.first + i, y.first + j].map(|k| k as f64 * spacing_m);
                values.push(shown * self.unevenness * self.uneven(place, self.along_x(place)));
            }
        }
        SplineLattice::new(x, y, values)
    }

    /// Share of passes along x at a place, between cells.
    fn along_x(&self, place: [f64; 2]) -> f32 {
        let [x, y] = place.map(|metres| metres * CELLS_PER_M - 0.5);
        let (i, j) = (x.floor(), y.floor());
        let (f, g) = ((x - i) as f32, (y - j) as f32);
        let at = |i: i64, j: i64| {
            let (i, j) = (i.clamp(0, self.columns - 1), j.clamp(0, self.rows - 1));
            self.along_x[(j * self.columns + i) as usize]
        };
        let row = |j: i64| at(i as i64, j) * (1.0 - f) + at(i as i64 + 1, j) * f;
        row(j as i64) * (1.0 - g) + row(j as i64 + 1) * g
    }

    fn uneven(&self, [x, y]: [f64; 2], along_x: f32) -> f32 {
        let mut uneven = 0.0;
        for (n, weight) in CLEANINGS.into_iter().enumerate() {
            let key = self.key ^ noise::mix(n as u32);
            let (x, y) = (x + 0.37 * n as f64, y + 0.63 * n as f64);
            if along_x > 0.01 {
                uneven += weight * along_x * self.left(x, y, key);
            }
            if along_x < 0.99 {
                uneven += weight * (1.0 - along_x) * self.left(y, x, key ^ 0xa5);
            }
        }
        uneven
    }

    /// Turns unevenness into the film that is left, relative to the mean where the mop gets to. `near_wall` is
    /// exp(-distance / reach_m) to the nearest wall.
    pub fn film_left(&self, uneven: &mut [f32], near_wall: &[f32], reach_m: f32) {
        let [near, far] = MISSED_M.map(|metres| exp_f32(-metres / reach_m));
        for (uneven, &wall) in uneven.iter_mut().zip(near_wall) {
            let reached = 1.0 - rise(wall, far, near);
            let taken = self.takes * reached * (1.0 - *uneven).max(0.0);
            *uneven = (1.0 - taken).max(0.05) / (1.0 - self.takes);
        }
    }

    /// How much more or less than the mean is left at a place along and across a pass, relative to what the mop takes.
    fn left(&self, u: f64, v: f64, key: u32) -> f32 {
        let wobble = 0.10 * f64::from(smooth(key, 0.35 * u, 0.5 * v));
        let across = v / self.width_m + wobble;
        let pass = across.floor();
        let (f, pass) = ((across - pass) as f32, pass as i64 as i32);
        // Passes overlap: none ends at an edge, but for the line where dirty water dries, now and then.
        let from_border = f.min(1.0 - f);
        let beside = if f < 0.5 { -1 } else { 1 };
        let shared = 0.5 * (1.0 - rise(from_border, 0.0, OVERLAP));
        let mut left = (1.0 - shared) * pass_leaves(u, f, pass, key);
        if shared > 0.0 {
            left += shared * pass_leaves(u, f - beside as f32, pass.wrapping_add(beside), key);
        }
        let border = 1.0 - rise(from_border * self.width_m as f32, 0.0, 0.025);
        let wet = || rise(smooth(key ^ 3, 0.5 * u, f64::from(pass) + 0.5), 0.0, 0.6);
        let line = if border > 0.0 { border * wet() } else { 0.0 };
        left + 0.9 * line
    }
}

/// What one pass leaves at a place along it, and across it from 0 to 1.
fn pass_leaves(u: f64, f: f32, pass: i32, key: u32) -> f32 {
    let own = 2.0 * unit(key ^ 1, pass, 0) - 1.0;
    let pressed = smooth_along(key ^ 2, 0.6 * u, pass);
    // Swings: arcs that open towards where the cleaner came from.
    let bow = 4.0 * (f - 0.5) * (f - 0.5);
    // Nobody swings to a beat, nor presses alike in every swing.
    let turn = 1.9 * f64::from(smooth_along(key ^ 4, 0.9 * u, pass));
    let swing = u / SWING_M + f64::from(bow) * 0.9 + turn + f64::from(unit(key ^ 5, pass, 1));
    let number = swing.floor();
    let swing = (swing - number) as f32;
    let arc = rise(swing, 0.0, 0.8) * (1.0 - rise(swing, 0.86, 1.0)) * unit(key ^ 7, pass, number as i64 as i32) - 0.14;
    let shows = rise(smooth_along(key ^ 6, 0.45 * u, pass), -0.5, 0.5);
    0.4 * own + 0.55 * pressed + 0.7 * shows * arc
}
