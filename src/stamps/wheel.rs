//! Lines of wheels: a piece of a line that bends a little, added to `wheels`, or as rubber to `scuff`.

use super::lanes::SumCell;
use super::noise::NOISE_ONE;
use super::print_coverage::PrintCoverage;
use super::shadow::{Shadow, StampExtent};
use super::stamper::{MarkBounds, PlacedMark, Stamper};
use super::window::{TexelBounds, TexelWindow, floor};
use super::{DENSITY_ONE, TexelGrid, WHEELS_ONE};
use crate::marks::Mark;
use crate::math::{SplitMix64, sin_cos};
use crate::patterns::Cause;
use crate::walls::Walls;

/// Limits of a piece: its length and breadth, metres; its turn, radians; what it adds.
const LONGEST_M: f32 = 5.0;
const BROADEST_M: f32 = 0.5;
const WIDEST_TURN: f32 = 2.0;
const MOST_AMOUNT: f32 = 15.0;
/// Share of half the breadth over which a line fades to either side: treads are round.
const SOFT: f64 = 0.5;

/// A piece of a line among the texels. Coordinates are along and left of the chord from the piece's middle, metres.
struct WheelPiece {
    /// The texel that holds the middle.
    origin: [i64; 2],
    /// Coordinates of that texel's centre, and their change along i.
    first: [f32; 2],
    per_i: [f32; 2],
    half_length: f32,
    half_breadth: f32,
    /// Half the ways over which it fades across and along.
    soft: f32,
    half_texel: f32,
    /// How far the middle lies to the right of the chord.
    bow: f32,
    /// Sine and cosine of half the turn.
    turn: [f32; 2],
    /// Half sides of the rectangle around it.
    reach: [f32; 2],
}

impl WheelPiece {
    /// The piece of a mark; `None` if it is out of range.
    fn of(mark: &Mark, grid: &TexelGrid) -> Option<WheelPiece> {
        let sound = mark.length_m > 0.0
            && mark.length_m < LONGEST_M
            && mark.wheel_m < BROADEST_M
            && mark.twist_rad.abs() < WIDEST_TURN
            && mark.effort.is_finite()
            && mark.strength > 0.0;
        if !sound {
            return None;
        }
        let (texel_m, h) = (grid.texel_m(), mark.heading);
        let origin = [mark.place_m.x, mark.place_m.y].map(|m| floor(m * grid.texels_per_metre));
        let from_middle = |k: i64, place_m: f64| (k as f64 + 0.5) * texel_m - place_m;
        let (dx, dy) = (from_middle(origin[0], mark.place_m.x), from_middle(origin[1], mark.place_m.y));
        let (half_length, half_breadth) = (0.5 * f64::from(mark.length_m), 0.5 * f64::from(mark.wheel_m));
        let twist = f64::from(mark.twist_rad);
        let (sin, cos) = sin_cos(0.5 * twist);
        let soft = (0.5 * texel_m).max(SOFT * half_breadth);
        let bow = 0.25 * twist * half_length;
        let across = half_breadth + soft + bow.abs();
        Some(WheelPiece {
            origin,
            first: [dx * h.x + dy * h.y, dy * h.x - dx * h.y].map(|v| v as f32),
            per_i: [h.x * texel_m, -h.y * texel_m].map(|v| v as f32),
            half_length: half_length as f32,
            half_breadth: half_breadth as f32,
            soft: soft as f32,
            half_texel: (0.5 * texel_m) as f32,
            bow: bow as f32,
            turn: [sin, cos].map(|v| v as f32),
            reach: [half_length + across * sin.abs() + texel_m, across].map(|v| v as f32),
        })
    }

    /// Coordinates of a texel's centre, counted from the origin.
    fn place(&self, di: i32, dj: i32) -> [f32; 2] {
        let (di, dj) = (di as f32, dj as f32);
        let [along, across] = self.per_i;
        [self.first[0] + di * along - dj * across, self.first[1] + di * across + dj * along]
    }

    /// Share of a texel that the piece covers.
    fn coverage(&self, [x, y]: [f32; 2]) -> f32 {
        let u = x / self.half_length;
        let aside = y + self.bow * (1.0 - u * u);
        let (low, high) = ((aside - self.soft).max(-self.half_breadth), (aside + self.soft).min(self.half_breadth));
        let across = (high - low).max(0.0) / (2.0 * self.soft);
        // Adjoining pieces share the line that ends them, so that both together cover each texel once.
        let [sin, cos] = self.turn;
        let begun = 0.5 + ((x + self.half_length) * cos - y * sin) / (2.0 * self.half_texel);
        let over = 0.5 + ((x - self.half_length) * cos + y * sin) / (2.0 * self.half_texel);
        across * (begun.clamp(0.0, 1.0) - over.clamp(0.0, 1.0)).max(0.0)
    }

    /// Texels of the rectangle around the piece, as far as it may touch them.
    fn bounds(&self) -> TexelBounds {
        let texel = 2.0 * self.half_texel;
        let [along, across] = self.per_i.map(|per| per.abs() / texel);
        let [x, y] = self.reach.map(|m| m / texel + 1.0);
        let (i, j) = ((x * along + y * across).ceil() as i64 + 1, (x * across + y * along).ceil() as i64 + 1);
        let [i0, j0] = self.origin;
        TexelBounds { i0: i0 - i, i1: i0 + i + 1, j0: j0 - j, j1: j0 + j + 1 }
    }

    /// Finds the range of texels of each row from `dj` on, within `limits`.
    fn spans(&self, dj: i32, limits: [i32; 2], spans: &mut [[i32; 2]]) {
        let margin = 2.0 * self.half_texel;
        for (row, span) in (dj..).zip(spans) {
            let at = self.place(0, row);
            let (mut low, mut high) = (limits[0] as f32, limits[1] as f32);
            for ((at, reach), per) in at.into_iter().zip(self.reach).zip(self.per_i) {
                let reach = reach + margin;
                if per.abs() > 1e-3 * margin {
                    let ends = [(-reach - at) / per, (reach - at) / per];
                    low = low.max(ends[0].min(ends[1]).floor());
                    high = high.min(ends[0].max(ends[1]).ceil() + 1.0);
                } else if at.abs() > reach + margin {
                    high = limits[0] as f32;
                }
            }
            *span = [low.min(limits[1] as f32) as i32, high.max(limits[0] as f32) as i32];
        }
    }

    fn extent(&self, mark: &Mark) -> StampExtent {
        let [half_along_m, half_across_m] = self.reach.map(f64::from);
        StampExtent { middle_m: mark.place_m, heading: mark.heading, half_along_m, half_across_m }
    }
}

impl Stamper {
    /// Places a stretch of a wheel; `None` if it is out of range.
    pub(super) fn place_wheel(&self, mark: &Mark, walls: &Walls) -> Option<(PlacedMark, MarkBounds)> {
        let piece = WheelPiece::of(mark, &self.grid)?;
        let reach_m = piece.extent(mark).reach_m(mark.place_m);
        Some(self.place_flat(mark, piece.bounds(), reach_m, walls))
    }

    /// Upper bound on a wheel's value in a texel.
    pub(crate) fn peak_of_wheel(&self, mark: &Mark) -> u32 {
        ((mark.strength + 0.6 * mark.effort.abs()).clamp(0.0, MOST_AMOUNT) * one(mark) * self.grain_peak) as u32 + 2
    }

    /// Adds a piece of a wheel's line to the texels of a window, in passes or as optical density.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_wheel<C: SumCell>(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
        cells: &mut [C],
    ) {
        let Some(piece) = WheelPiece::of(mark, &self.grid) else { return };
        let read = |di: i32, dj: i32, out: &mut [u8]| {
            for (di, c) in (di..).zip(out) {
                *c = (255.0 * piece.coverage(piece.place(di, dj)) + 0.5) as u8;
            }
        };
        sheet.fill(piece.origin, piece.bounds(), window, |dj, limits, spans| piece.spans(dj, limits, spans), read);
        if placed.is_cut()
            && let Some(shadow) = Shadow::new(walls, placed.stands(mark), &piece.extent(mark), self.grid.texel_m())
        {
            sheet.hide(&shadow, window);
        }
        let word = SplitMix64::new(mark.variation).next_u64();
        let noise_at = [word as u32, (word >> 32) as u32];
        let unit = one(mark) / (255.0 * NOISE_ONE);
        let per_m = mark.effort / mark.length_m;
        let amount = |di: i32, dj: i32| {
            let along = piece.place(di, dj)[0].clamp(-piece.half_length, piece.half_length);
            (mark.strength + per_m * along).clamp(0.0, MOST_AMOUNT)
        };
        self.add_along(sheet, piece.origin, window, noise_at, unit, amount, cells);
    }
}

/// Fixed-point unit of what a wheel leaves: rubber or passes.
fn one(mark: &Mark) -> f32 {
    if mark.cause == Cause::Heel { DENSITY_ONE } else { WHEELS_ONE }
}
