//! What a vector drawing is read into, whatever its format.

use std::collections::BTreeMap;

use super::names;
use crate::math::{Rect, Vec2, sin_cos, vec2};
use crate::plan::{PlanClass, PlanLayers};

/// Most corners of all shapes of a drawing.
pub(super) const MOST_CORNERS: usize = 2_000_000;
/// Coordinates beyond this are no plan's, in units of the drawing.
const FARTHEST: f64 = 1e8;
/// Angle between two corners of a circle that becomes a polyline, radians: 2 degrees, at 10 m radius 1.5 mm off.
const STEP_RAD: f64 = std::f64::consts::PI / 90.0;

/// Layers that a warning lists.
const LISTED: usize = 6;

/// A vector drawing: shapes in the drawing's own unit, y up.
#[derive(Debug, Default)]
pub(super) struct VectorPlan {
    pub(super) unit: Unit,
    pub(super) pieces: Vec<Piece>,
    /// Ways that robots or people take, as polylines.
    pub(super) lanes: Vec<[Vec2; 2]>,
    /// The whole plan, if the format says where it ends.
    pub(super) bounds: Option<Rect>,
    /// What was left out, by its names `one|many`.
    left_out: BTreeMap<&'static str, usize>,
    /// Names of layers that say nothing known.
    unknown_layers: BTreeMap<String, usize>,
    /// Units of a pixel of the map that is drawn with it.
    pub(super) units_per_pixel: f64,
    pub(super) warnings: Vec<String>,
    /// What a scenario says of layers.
    said: PlanLayers,
    corners: usize,
}

/// What a unit of the drawing is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Unit {
    /// Metres of the building, measured or by a rule of the format.
    Sure(f64),
    /// Metres of the building, as a header says that is often wrong.
    Metres(f64),
    /// Metres of paper: the drawing has a scale of its own, such as 1:100.
    Paper(f64),
    /// The file does not say.
    #[default]
    Unknown,
}

/// A drawn shape.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    /// What its layer, class or block is called after.
    pub(super) class: Option<PlanClass>,
    /// Loops of an area, or one polyline.
    pub(super) loops: Vec<Vec<Vec2>>,
    /// Whether the last corner joins the first.
    pub(super) closed: bool,
    /// Whether it is a curve.
    pub(super) curved: bool,
    /// Colour of the area; loops inside others are holes.
    pub(super) fill: Option<[u8; 3]>,
    pub(super) stroke: Option<Stroke>,
    /// Pieces of the same thing, such as a block of furniture; 0 for none.
    pub(super) group: u32,
}

/// A drawn line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    /// In units of the drawing; 0 for a hairline.
    pub(super) width: f64,
    pub(super) colour: [u8; 3],
}

/// A transform of the plane: `u` and `v` are where the unit vectors go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Map {
    pub(super) u: Vec2,
    pub(super) v: Vec2,
    pub(super) origin: Vec2,
}

impl Map {
    pub(super) const IDENTITY: Map = Map { u: Vec2 { x: 1.0, y: 0.0 }, v: Vec2 { x: 0.0, y: 1.0 }, origin: Vec2::ZERO };

    pub(super) fn vector(&self, p: Vec2) -> Vec2 {
        self.u * p.x + self.v * p.y
    }

    pub(super) fn point(&self, p: Vec2) -> Vec2 {
        self.origin + self.vector(p)
    }

    pub(super) fn then(&self, inner: Map) -> Map {
        Map { u: self.vector(inner.u), v: self.vector(inner.v), origin: self.point(inner.origin) }
    }
}

/// More shapes than a plan has.
#[derive(Debug, PartialEq)]
pub(super) struct TooMany;

/// Reason of the error that follows from it.
pub(super) const TOO_MANY: &str = "it has more corners than any plan";

impl VectorPlan {
    /// A drawing without shapes.
    pub(super) fn of(unit: Unit, said: &PlanLayers) -> VectorPlan {
        VectorPlan { unit, said: said.clone(), ..VectorPlan::default() }
    }

    /// What a layer, class or block holds: as the scenario says, or by its name.
    pub(super) fn class_of(&self, name: &str) -> Option<PlanClass> {
        self.said.class_of(name).or_else(|| names::class_of(name))
    }

    /// Counts a layer whose name says nothing known.
    pub(super) fn add_unknown(&mut self, layer: &str) {
        *self.unknown_layers.entry(layer.to_owned()).or_default() += 1;
    }

    /// The first layers whose names say nothing known, after `lead`; empty without any.
    pub(super) fn unknown(&self, lead: &str) -> String {
        let names: Vec<String> = self.unknown_layers.keys().take(LISTED).map(|name| format!("\"{name}\"")).collect();
        let more = if self.unknown_layers.len() > LISTED { ", ..." } else { "" };
        if names.is_empty() { String::new() } else { format!("{lead}{}{more}", names.join(", ")) }
    }

    /// Adds a shape unless its coordinates are no plan's.
    pub(super) fn add(&mut self, mut piece: Piece) -> Result<(), TooMany> {
        if let [points] = &mut piece.loops[..]
            && points.len() > 3
            && !piece.curved
            && points[0].distance(points[points.len() - 1]) <= 1e-6 * points[0].distance(points[1])
        {
            points.pop();
            piece.closed = true;
        }
        let corners: usize = piece.loops.iter().map(Vec::len).sum();
        self.corners += corners + 1;
        if self.corners > MOST_CORNERS {
            return Err(TooMany);
        }
        // Comparisons are written so that NaN is refused.
        let sound = |p: &Vec2| p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST;
        if corners < 2 || !piece.loops.iter().flatten().all(sound) {
            if corners >= 2 {
                self.leave_out("shape far beyond any plan|shapes far beyond any plan", 1);
            }
            return Ok(());
        }
        match piece.class {
            Some(PlanClass::Lettering) => self.leave_out("outline of lettering|outlines of lettering", 1),
            Some(PlanClass::Dimension) => {
                self.leave_out("dimension line, axis or hatch|dimension lines, axes and hatches", 1)
            }
            Some(PlanClass::Frame) => self.leave_out("line of the sheet's frame|lines of the sheet's frame", 1),
            Some(PlanClass::Outside) => self.leave_out("line of the site|lines of the site", 1),
            _ => self.pieces.push(piece),
        }
        Ok(())
    }

    /// Counts what was left out, by its names `one|many`.
    pub(super) fn leave_out(&mut self, what: &'static str, count: usize) {
        if count > 0 {
            *self.left_out.entry(what).or_default() += count;
        }
    }

    /// Says what was left out, if anything was.
    pub(super) fn left_out(&self) -> Option<String> {
        let named = |(what, &count): (&&str, &usize)| {
            let (one, many) = what.split_once('|').unwrap_or((what, what));
            format!("{count} {}", if count == 1 { one } else { many })
        };
        let parts: Vec<String> = self.left_out.iter().map(named).collect();
        (!parts.is_empty()).then(|| format!("left out of the drawing: {}", parts.join(", ")))
    }
}

impl Piece {
    /// A polyline without fill.
    pub(super) fn line(points: Vec<Vec2>, closed: bool) -> Piece {
        Piece { loops: vec![points], closed, stroke: Some(Stroke { width: 0.0, colour: [0; 3] }), ..Piece::default() }
    }

    /// An area.
    pub(super) fn area(loops: Vec<Vec<Vec2>>) -> Piece {
        Piece { loops, closed: true, fill: Some([0; 3]), ..Piece::default() }
    }

    pub(super) fn of(self, class: Option<PlanClass>) -> Piece {
        Piece { class, ..self }
    }

    pub(super) fn points(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.loops.iter().flatten().copied()
    }

    /// Box around it.
    pub(super) fn bounds(&self) -> Rect {
        bounds_of(self.points()).unwrap_or(Rect::around(Vec2::ZERO, Vec2::ZERO))
    }

    /// All its straight segments; those that close it too.
    pub(super) fn segments(&self) -> impl Iterator<Item = [Vec2; 2]> + '_ {
        self.loops.iter().flat_map(|points| {
            let closing = (self.closed && points.len() > 2).then(|| [points[points.len() - 1], points[0]]);
            points.windows(2).map(|w| [w[0], w[1]]).chain(closing)
        })
    }

    /// Area that its loops enclose, holes taken away.
    pub(super) fn area_enclosed(&self) -> f64 {
        let areas: Vec<f64> = self.loops.iter().map(|points| signed_area(points)).collect();
        // Holes go the other way round, or lie inside where their own direction says nothing.
        areas.iter().sum::<f64>().abs()
    }

    /// Length of all its loops, closed.
    pub(super) fn perimeter(&self) -> f64 {
        self.loops.iter().map(|p| (0..p.len()).map(|k| p[k].distance(p[(k + 1) % p.len()])).sum::<f64>()).sum()
    }
}

/// Box around points; `None` around none.
pub(super) fn bounds_of(points: impl IntoIterator<Item = Vec2>) -> Option<Rect> {
    points.into_iter().fold(None, |bounds: Option<Rect>, p| {
        Some(bounds.map_or(Rect { min: p, max: p }, |r| Rect {
            min: vec2(r.min.x.min(p.x), r.min.y.min(p.y)),
            max: vec2(r.max.x.max(p.x), r.max.y.max(p.y)),
        }))
    })
}

/// Area of a loop, positive if it goes counter-clockwise.
pub(super) fn signed_area(points: &[Vec2]) -> f64 {
    let n = points.len();
    (0..n).map(|k| points[k].cross(points[(k + 1) % n])).sum::<f64>() * 0.5
}

/// Corners of an arc of an ellipse with the half axes `u` and `v`, from one angle to another.
pub(super) fn arc(centre: Vec2, u: Vec2, v: Vec2, from_rad: f64, to_rad: f64) -> Vec<Vec2> {
    let turn = to_rad - from_rad;
    let steps = (turn.abs() / STEP_RAD).ceil().clamp(1.0, 360.0) as usize;
    let at = |k: usize| {
        let (sin, cos) = sin_cos(from_rad + turn * k as f64 / steps as f64);
        centre + u * cos + v * sin
    };
    (0..=steps).map(at).collect()
}

/// Appends the corners of a cubic Bezier curve after its start.
pub(super) fn cubic(out: &mut Vec<Vec2>, start: Vec2, c1: Vec2, c2: Vec2, end: Vec2) {
    const STEPS: usize = 24;
    for k in 1..=STEPS {
        let t = k as f64 / STEPS as f64;
        let s = 1.0 - t;
        out.push(start * (s * s * s) + c1 * (3.0 * s * s * t) + c2 * (3.0 * s * t * t) + end * (t * t * t));
    }
}

/// The path of a drawing program: lines and curves, from which pieces are made.
#[derive(Debug, Default)]
pub(super) struct Path {
    loops: Vec<SubPath>,
}

#[derive(Debug, Default)]
struct SubPath {
    points: Vec<Vec2>,
    /// Where straight and curved stretches meet, as indices of points, and whether the stretch after it is curved.
    changes: Vec<(usize, bool)>,
    closed: bool,
}

impl Path {
    pub(super) fn move_to(&mut self, p: Vec2) {
        // Of moves in a row, the last counts.
        self.loops.pop_if(|last| last.points.len() < 2);
        self.loops.push(SubPath { points: vec![p], ..SubPath::default() });
    }

    pub(super) fn line_to(&mut self, p: Vec2) {
        if let Some(path) = self.current() {
            path.stretch(false);
            path.points.push(p);
        }
    }

    pub(super) fn cubic_to(&mut self, c1: Vec2, c2: Vec2, end: Vec2) {
        if let Some(path) = self.current() {
            path.stretch(true);
            let start = path.points[path.points.len() - 1];
            cubic(&mut path.points, start, c1, c2, end);
        }
    }

    pub(super) fn close(&mut self) {
        if let Some(path) = self.loops.last_mut() {
            path.closed = true;
        }
    }

    /// Where the path stands.
    pub(super) fn at(&self) -> Option<Vec2> {
        self.loops.last().and_then(|path| if path.closed { path.points.first() } else { path.points.last() }.copied())
    }

    fn current(&mut self) -> Option<&mut SubPath> {
        let last = self.loops.last()?;
        // Lines after a closed loop start where it started.
        if last.closed {
            let start = last.points[0];
            self.loops.push(SubPath { points: vec![start], ..SubPath::default() });
        }
        self.loops.last_mut()
    }

    /// Box around it; `None` if it is empty.
    pub(super) fn bounds(&self) -> Option<Rect> {
        bounds_of(self.loops.iter().flat_map(|path| path.points.iter().copied()))
    }

    pub(super) fn corners(&self) -> usize {
        self.loops.iter().map(|path| path.points.len()).sum()
    }

    /// Adds it to a plan: as one area if it is filled, else as lines that are either straight or curved.
    pub(super) fn add_to(
        &self,
        plan: &mut VectorPlan,
        class: Option<PlanClass>,
        fill: Option<[u8; 3]>,
        stroke: Option<Stroke>,
        group: u32,
    ) -> Result<(), TooMany> {
        let blank = Piece { class, group, ..Piece::default() };
        if fill.is_some() {
            let loops = self.loops.iter().filter(|p| p.points.len() > 2).map(|p| p.points.clone()).collect();
            let curved = self.loops.iter().all(|p| p.changes.iter().all(|change| change.1));
            plan.add(Piece { loops, closed: true, curved, fill, stroke, ..blank.clone() })?;
            // Lines enclose no area; with a fill, they still are lines.
            if self.loops.iter().any(|p| p.points.len() > 2) {
                return Ok(());
            }
        }
        if stroke.is_none() {
            return Ok(());
        }
        for path in self.loops.iter().filter(|path| path.points.len() > 1) {
            if path.changes.len() < 2 {
                let curved = path.changes.iter().any(|change| change.1);
                plan.add(Piece {
                    loops: vec![path.points.clone()],
                    closed: path.closed,
                    curved,
                    stroke,
                    ..blank.clone()
                })?;
                continue;
            }
            let ends = path.changes.iter().skip(1).map(|change| change.0).chain([path.points.len() - 1]);
            for (&(from, curved), to) in path.changes.iter().zip(ends) {
                let loops = vec![path.points[from..=to].to_vec()];
                plan.add(Piece { loops, curved, stroke, ..blank.clone() })?;
            }
            if path.closed {
                let loops = vec![vec![path.points[path.points.len() - 1], path.points[0]]];
                plan.add(Piece { loops, stroke, ..blank.clone() })?;
            }
        }
        Ok(())
    }
}

impl SubPath {
    fn stretch(&mut self, curved: bool) {
        if self.changes.last().is_none_or(|last| last.1 != curved) {
            self.changes.push((self.points.len() - 1, curved));
        }
    }
}
