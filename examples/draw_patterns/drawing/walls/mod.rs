//! What is left on walls, by cause: hands, arms, shoulders, bags and shoes. The image is upright on the wall (row 0 on
//! top), +x is the way of the drag, which fades along it.

mod bag;
mod cloth;
mod hand;
mod shoe;
mod touch;

use trodden::math::{Rect, Vec2, vec2};

use super::Drawing;
use super::heel_marks::Stroke;
use super::shape::smoothstep;
use touch::{Dab, Rub, Wall};

/// The wall patterns, in the order of `patterns.toml`.
pub fn all() -> Vec<Drawing> {
    let stains = [hand::all(), cloth::all(), bag::all(), shoe::all()];
    stains.into_iter().flatten().map(Stain::draw).collect()
}

/// One stain: what touched the wall, and how.
struct Stain {
    name: &'static str,
    /// Size of the image, centimetres; x from 0, y 0 in its middle.
    size: Vec2,
    wall: Wall,
    rubs: Vec<Rub>,
    dabs: Vec<Dab>,
    /// Lines with a hard core, as rubber draws them.
    strokes: Vec<Stroke>,
    /// How much of full coverage the lines have.
    ink: f64,
}

impl Stain {
    fn new(name: &'static str, length: f64, breadth: f64, wall: Wall) -> Stain {
        Stain {
            name,
            size: vec2(length, breadth),
            wall,
            rubs: Vec::new(),
            dabs: Vec::new(),
            strokes: Vec::new(),
            ink: 1.0,
        }
    }

    fn rubs(mut self, rubs: impl IntoIterator<Item = Rub>) -> Stain {
        self.rubs.extend(rubs);
        self
    }

    fn dabs(mut self, dabs: impl IntoIterator<Item = Dab>) -> Stain {
        self.dabs.extend(dabs);
        self
    }

    fn strokes(mut self, ink: f64, strokes: impl IntoIterator<Item = Stroke>) -> Stain {
        self.strokes.extend(strokes);
        self.ink = ink;
        self
    }

    fn draw(self) -> Drawing {
        let half = self.size.y / 2.0;
        let frame = Rect { min: vec2(0.0, -half), max: vec2(self.size.x, half) };
        let name = self.name;
        Drawing { name, frame, samples: 3, fills: true, coverage: Box::new(move |p| self.coverage(p)) }
    }

    fn coverage(&self, p: Vec2) -> f64 {
        let load =
            self.rubs.iter().map(|rub| rub.load(p)).sum::<f64>() + self.dabs.iter().map(|dab| dab.load(p)).sum::<f64>();
        let line = self.strokes.iter().map(|stroke| stroke.coverage(p)).fold(0.0, f64::max);
        let cover = self.wall.take(load, p).clamp(0.0, 1.2);
        let cover = cover + self.ink * line * (1.0 - cover).max(0.0);
        // Whatever is left at the border of the image would show as a straight edge.
        let inset = p.x.min(self.size.x - p.x).min(self.size.y / 2.0 - p.y.abs());
        cover * smoothstep(0.0, (0.08 * self.size.y).min(0.6), inset)
    }
}
