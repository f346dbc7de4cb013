//! Windows in walls: a pane, its frame and its sill.

use super::finish::Finish;
use super::prism::Fitting;
use super::shape::Block;
use crate::math::Vec2;
use crate::walls::Walls;

/// Heights of sill and head above the floor, metres.
const SILL_M: f64 = 0.9;
const HEAD_M: f64 = 2.2;
/// Least wall over a window, metres.
const OVER_M: f64 = 0.2;
/// Frame: width and depth, metres; and the widest pane.
const FRAME_M: f64 = 0.065;
const FRAME_DEPTH_M: f64 = 0.03;
const PANE_M: f64 = 1.1;

/// A window: its ends on the wall, the room on their right, and the heights of sill and head, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    pub ends: [Vec2; 2],
    pub span_m: [f64; 2],
}

/// The windows of a plan's walls.
pub(super) fn of(walls: &Walls, height_m: f64) -> Vec<Window> {
    let head_m = HEAD_M.min(height_m - OVER_M);
    let windows = walls.outlines().iter().flat_map(|outline| outline.windows_m.iter().copied());
    let span_m = [SILL_M, head_m];
    windows.filter(|_| head_m > SILL_M + 0.4).map(|ends| Window { ends, span_m }).collect()
}

impl Window {
    /// Pane, frame, bars and sill.
    pub fn parts(&self) -> Vec<Fitting> {
        let [a, b] = self.ends;
        let Some(along) = (b - a).normalized() else { return Vec::new() };
        let (width_m, inward, [low, high]) = (a.distance(b), -along.left(), self.span_m);
        let part = |[from, to]: [f64; 2], depth_m: f64, span_m: [f64; 2], finish| {
            let centre = a + along * (0.5 * (from + to)) + inward * (0.5 * depth_m);
            Fitting {
                footprint: Block { centre, along, half: [0.5 * (to - from), 0.5 * depth_m] }.corners(),
                span_m,
                finish,
                leaf: None,
            }
        };
        let mut parts = vec![
            part([0.0, width_m], 0.01, [low, high], Finish::Pane),
            part([0.0, width_m], FRAME_DEPTH_M, [high - FRAME_M, high], Finish::WindowFrame),
            part([0.0, width_m], FRAME_DEPTH_M, [low, low + FRAME_M], Finish::WindowFrame),
            part([-0.06, width_m + 0.06], 0.17, [low - 0.03, low], Finish::WindowFrame),
        ];
        let panes = (width_m / PANE_M).ceil().max(1.0) as u32;
        for k in 0..=panes {
            let middle = (width_m * f64::from(k) / f64::from(panes)).clamp(0.5 * FRAME_M, width_m - 0.5 * FRAME_M);
            let sides = [middle - 0.5 * FRAME_M, middle + 0.5 * FRAME_M];
            parts.push(part(sides, FRAME_DEPTH_M, [low + FRAME_M, high - FRAME_M], Finish::WindowFrame));
        }
        parts
    }
}
