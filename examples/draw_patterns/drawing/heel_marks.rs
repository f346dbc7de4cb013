//! Heel marks: rubber that a heel or a toe loses when it is dragged. Dense and blunt where the drag begins, then
//! streaky, broken, and feathered out. +x is the way of the drag.

use trodden::math::{Rect, Vec2, vec2};

use super::Drawing;
use super::noise;
use super::shape::smoothstep;

/// One stroke, centimetres.
#[derive(Clone, Copy)]
pub struct Stroke {
    /// Start and end on the axis of the image.
    pub from: f64,
    pub to: f64,
    /// y of the middle line at the start, in the middle, and at the end.
    pub bend: [f64; 3],
    /// Full width at the start, where it is widest, and at the end.
    pub widths: [f64; 3],
    /// Where it is widest, as a share of its length.
    pub widest: f64,
    /// Share of the length at which it begins to break up.
    pub holds: f64,
    pub seed: u64,
}

/// The heel marks, in the order of `patterns.toml`.
pub fn all() -> Vec<Drawing> {
    let stroke = |from, to, bend, widths, widest, holds, seed| Stroke { from, to, bend, widths, widest, holds, seed };
    vec![
        drawing("heel_arc", 8.0, 2.2, vec![stroke(0.2, 7.9, [-0.7, 0.7, -0.7], [0.35, 0.60, 0.12], 0.25, 0.35, 1)]),
        drawing("heel_hook", 5.6, 2.8, vec![stroke(0.2, 5.5, [1.0, -0.2, -1.1], [0.50, 0.62, 0.10], 0.12, 0.30, 2)]),
        drawing("heel_skid", 4.8, 1.2, vec![stroke(0.1, 4.7, [0.0, 0.06, -0.05], [0.70, 0.80, 0.45], 0.20, 0.15, 3)]),
        drawing("heel_streak", 12.0, 1.2, vec![stroke(0.1, 11.9, [-0.2, 0.2, 0.1], [0.15, 0.42, 0.08], 0.40, 0.45, 4)]),
        drawing("heel_dash", 2.6, 0.9, vec![stroke(0.1, 2.5, [-0.05, 0.05, -0.05], [0.40, 0.50, 0.16], 0.20, 0.40, 5)]),
        drawing(
            "heel_pair",
            6.8,
            1.6,
            vec![
                stroke(0.1, 6.4, [-0.15, 0.42, 0.35], [0.24, 0.32, 0.08], 0.20, 0.30, 6),
                stroke(0.9, 6.7, [-0.52, -0.12, -0.28], [0.14, 0.24, 0.06], 0.40, 0.20, 7),
            ],
        ),
        drawing("heel_sweep", 10.4, 3.4, vec![stroke(0.2, 10.2, [-1.3, 0.9, -0.8], [0.12, 0.72, 0.15], 0.45, 0.55, 8)]),
        drawing("heel_flick", 3.8, 1.4, vec![stroke(0.1, 3.7, [-0.45, 0.2, 0.45], [0.34, 0.36, 0.05], 0.10, 0.45, 9)]),
        drawing(
            "heel_smear",
            8.4,
            2.8,
            vec![
                stroke(0.3, 6.2, [0.95, 1.20, 1.05], [0.22, 0.34, 0.10], 0.25, 0.40, 10),
                stroke(0.1, 8.2, [0.45, 0.62, 0.40], [0.30, 0.38, 0.14], 0.20, 0.45, 11),
                stroke(0.6, 7.4, [-0.15, 0.05, -0.12], [0.20, 0.30, 0.08], 0.35, 0.30, 12),
                stroke(0.2, 5.1, [-0.62, -0.48, -0.60], [0.28, 0.34, 0.12], 0.15, 0.35, 13),
            ],
        ),
        drawing("heel_pivot", 8.6, 3.2, vec![stroke(0.2, 8.4, [-1.0, 0.75, -0.9], [0.50, 0.86, 0.30], 0.45, 0.60, 14)]),
        drawing(
            "toe_drag",
            11.4,
            1.8,
            vec![
                stroke(0.1, 11.2, [0.10, 0.22, 0.05], [0.80, 0.86, 0.30], 0.12, 0.30, 15),
                stroke(0.8, 9.0, [-0.58, -0.45, -0.62], [0.12, 0.20, 0.06], 0.30, 0.25, 16),
            ],
        ),
    ]
}

fn drawing(name: &'static str, length: f64, breadth: f64, strokes: Vec<Stroke>) -> Drawing {
    let frame = Rect { min: vec2(0.0, -breadth / 2.0), max: vec2(length, breadth / 2.0) };
    let coverage = move |p: Vec2| strokes.iter().map(|stroke| stroke.coverage(p)).fold(0.0, f64::max);
    Drawing { name, frame, samples: 4, fills: false, coverage: Box::new(coverage) }
}

impl Stroke {
    /// How fully it covers a place.
    pub fn coverage(&self, p: Vec2) -> f64 {
        let t = (p.x - self.from) / (self.to - self.from);
        if !(-0.1..=1.1).contains(&t) {
            return 0.0;
        }
        let (middle, slope) = self.middle(t);
        // Distance square to the stroke rather than along y; the hand of the drag trembles a little.
        let tremble = 0.035 * noise::value(vec2(p.x, 0.0), 0.8, self.seed + 40);
        let off = (p.y - middle - tremble) / (1.0 + slope * slope).sqrt();
        let half = self.half_width(t).max(0.01);
        let s = off / half;
        let ragged = 0.22 * noise::cloudy(p, 0.22, 2, self.seed + 50);
        let body = smoothstep(1.05, 0.70, s.abs() + ragged);
        // The drag leaves fine streaks along its way: noise that is long along the stroke and narrow across.
        let streaks = noise::value(vec2(p.x * 0.10, off), 0.085, self.seed + 60) * 0.6
            + noise::value(vec2(p.x * 0.05, off), 0.19, self.seed + 61) * 0.4;
        let grain = noise::cloudy(p, 0.15, 2, self.seed + 70);
        let skips = noise::cloudy(vec2(p.x * 0.8, off * 1.5), 0.9, 2, self.seed + 80);
        // Contact fades from `holds` to the end, and is not quite even before that.
        let contact = 0.66 - 0.85 * smoothstep(self.holds, 1.05, t) + 0.42 * skips;
        let ends = smoothstep(-0.02, 0.03, t + 0.02 * grain) * smoothstep(1.03, 0.93, t + 0.05 * streaks);
        body * ends * smoothstep(0.12, 0.75, contact + 0.75 * streaks + 0.35 * grain)
    }

    /// The middle line and its slope: the parabola through the three points of the bend.
    fn middle(&self, t: f64) -> (f64, f64) {
        let [a, b, c] = self.bend;
        let (linear, square) = (4.0 * b - 3.0 * a - c, 2.0 * (a + c) - 4.0 * b);
        (a + t * (linear + t * square), (linear + 2.0 * t * square) / (self.to - self.from))
    }

    fn half_width(&self, t: f64) -> f64 {
        let [start, widest, end] = self.widths;
        let width = if t < self.widest {
            start + (widest - start) * smoothstep(0.0, self.widest, t)
        } else {
            let fall = (t - self.widest) / (1.0 - self.widest);
            widest + (end - widest) * fall
        };
        width / 2.0
    }
}
