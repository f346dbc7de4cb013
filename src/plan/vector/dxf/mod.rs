//! DXF drawings: layers, blocks, lines and curves. Hatches, texts and dimensions are left out.

use rustc_hash::FxHashMap;

use super::piece::{Map, Piece, TOO_MANY, TooMany, Unit, VectorPlan, arc};
use crate::math::{Vec2, sin_cos, vec2};
use crate::plan::{PlanClass, PlanLayers};

mod pairs;

use pairs::Pair;

/// Deepest nesting of blocks.
const DEEPEST: usize = 24;
/// Most blocks that are put in, those inside others each time.
const MOST_INSERTS: usize = 300_000;
/// Places that a spline is drawn through.
const SPLINE_STEPS: usize = 96;
/// Most control points of a spline.
const MOST_CONTROLS: usize = 20_000;

/// Reads a drawing.
pub(super) fn read(bytes: &[u8], said: &PlanLayers) -> Result<VectorPlan, String> {
    let text = pairs::decode(bytes);
    let pairs = pairs::pairs(bytes, &text)?;
    let drawing = Drawing::of(&pairs);
    let mut plan = VectorPlan::of(drawing.unit, said);
    let mut reader = Reader { drawing: &drawing, plan: &mut plan, inserts: 0, blocks: Vec::new() };
    let top = Place { map: Map::IDENTITY, layer: "0", class: None, group: 0 };
    reader.entities(&drawing.entities, top).map_err(|TooMany| TOO_MANY.to_owned())?;
    if plan.pieces.is_empty() {
        return Err("it draws no shapes".to_owned());
    }
    Ok(plan)
}

/// An entity: its kind and its pairs.
struct Entity<'a> {
    kind: &'a str,
    pairs: &'a [Pair<'a>],
}

impl<'a> Entity<'a> {
    fn find(&self, code: i32) -> Option<&'a Pair<'a>> {
        self.pairs.iter().find(|pair| pair.code == code)
    }

    fn number(&self, code: i32, default: f64) -> f64 {
        self.find(code).map_or(default, Pair::number)
    }

    fn flags(&self, code: i32) -> i64 {
        self.number(code, 0.0) as i64
    }

    fn text(&self, code: i32) -> &'a str {
        self.find(code).map_or("", Pair::text)
    }

    /// A point; its y has the code of its x plus ten.
    fn point(&self, code: i32) -> Vec2 {
        vec2(self.number(code, 0.0), self.number(code + 10, 0.0))
    }

    /// All points of a code that is repeated.
    fn points(&self, code: i32) -> Vec<Vec2> {
        let mut points: Vec<Vec2> = Vec::new();
        for pair in self.pairs {
            if pair.code == code {
                points.push(vec2(pair.number(), 0.0));
            } else if pair.code == code + 10
                && let Some(last) = points.last_mut()
            {
                last.y = pair.number();
            }
        }
        points
    }
}

struct Block<'a> {
    base: Vec2,
    entities: Vec<Entity<'a>>,
}

/// The parts of a file.
struct Drawing<'a> {
    unit: Unit,
    blocks: FxHashMap<&'a str, Block<'a>>,
    /// Layers that are off or frozen.
    hidden: Vec<&'a str>,
    entities: Vec<Entity<'a>>,
}

impl<'a> Drawing<'a> {
    fn of(pairs: &'a [Pair<'a>]) -> Drawing<'a> {
        let mut drawing =
            Drawing { unit: Unit::Unknown, blocks: FxHashMap::default(), hidden: Vec::new(), entities: Vec::new() };
        let mut section = "";
        let mut block: Option<(&str, Block)> = None;
        let mut at = 0;
        while at < pairs.len() {
            let end = (at + 1..pairs.len()).find(|k| pairs[*k].code == 0).unwrap_or(pairs.len());
            let entity = Entity { kind: pairs[at].text(), pairs: &pairs[at + 1..end] };
            match (section, entity.kind) {
                (_, "SECTION") => {
                    section = entity.text(2);
                    if section == "HEADER" {
                        drawing.unit = unit(entity.pairs);
                    }
                }
                (_, "ENDSEC" | "EOF") => section = "",
                ("TABLES", "LAYER") if entity.number(62, 0.0) < 0.0 || entity.flags(70) & 1 != 0 => {
                    drawing.hidden.push(entity.text(2));
                }
                ("BLOCKS", "BLOCK") => {
                    block = Some((entity.text(2), Block { base: entity.point(10), entities: Vec::new() }));
                }
                ("BLOCKS", "ENDBLK") => {
                    if let Some((name, block)) = block.take() {
                        drawing.blocks.insert(name, block);
                    }
                }
                ("BLOCKS", _) => {
                    if let Some((_, block)) = &mut block {
                        block.entities.push(entity);
                    }
                }
                ("ENTITIES", _) => drawing.entities.push(entity),
                _ => {}
            }
            at = end;
        }
        drawing
    }
}

/// The unit that the header names.
fn unit(header: &[Pair]) -> Unit {
    let at = header.iter().position(|pair| pair.is(9, "$INSUNITS"));
    match at.and_then(|at| header.get(at + 1)).map_or(0, |pair| pair.number() as i64) {
        1 => Unit::Metres(0.0254),
        2 => Unit::Metres(0.3048),
        4 => Unit::Metres(0.001),
        5 => Unit::Metres(0.01),
        6 => Unit::Metres(1.0),
        10 => Unit::Metres(0.9144),
        14 => Unit::Metres(0.1),
        _ => Unit::Unknown,
    }
}

/// Where and as what a block's entities come.
#[derive(Clone, Copy)]
struct Place<'a> {
    map: Map,
    layer: &'a str,
    /// What the block is called after.
    class: Option<PlanClass>,
    group: u32,
}

struct Reader<'a, 'p> {
    drawing: &'a Drawing<'a>,
    plan: &'p mut VectorPlan,
    inserts: usize,
    /// Blocks that are being put in.
    blocks: Vec<&'a str>,
}

impl<'a> Reader<'a, '_> {
    fn entities(&mut self, entities: &'a [Entity<'a>], place: Place<'a>) -> Result<(), TooMany> {
        let mut at = 0;
        while let Some(entity) = entities.get(at) {
            at += 1;
            if entity.kind == "POLYLINE" {
                let vertices: Vec<&Entity> = entities[at..].iter().take_while(|e| e.kind == "VERTEX").collect();
                at += vertices.len();
                self.polyline(entity, &vertices, place)?;
            } else {
                self.entity(entity, place)?;
            }
        }
        Ok(())
    }

    /// Layer and meaning of an entity; `None` if it is not seen.
    fn class(&mut self, entity: &Entity<'a>, place: Place<'a>) -> Option<(&'a str, Option<PlanClass>)> {
        let layer = match entity.text(8) {
            // Entities of layer 0 in a block lie on the layer of the block.
            "" | "0" => place.layer,
            layer => layer,
        };
        // Paper space holds frames and views of the model.
        if entity.flags(67) != 0 || entity.flags(60) != 0 || self.drawing.hidden.contains(&layer) {
            self.plan.leave_out("hidden entity|hidden entities", 1);
            return None;
        }
        let by_layer = self.plan.class_of(layer);
        let class = match (by_layer, place.class) {
            (Some(layer), Some(block)) if layer.is_furniture() && block.is_furniture() => Some(block),
            (Some(layer), _) => Some(layer),
            (None, block) => block,
        };
        if class.is_none() {
            self.plan.add_unknown(layer);
        }
        Some((layer, class))
    }

    fn entity(&mut self, entity: &Entity<'a>, place: Place<'a>) -> Result<(), TooMany> {
        match entity.kind {
            "TEXT" | "MTEXT" | "ATTRIB" | "ATTDEF" | "RTEXT" => {
                self.plan.leave_out("text|texts", 1);
                return Ok(());
            }
            "DIMENSION"
            | "LARGE_RADIAL_DIMENSION"
            | "ARC_DIMENSION"
            | "LEADER"
            | "MULTILEADER"
            | "MLEADER"
            | "TOLERANCE" => {
                self.plan.leave_out("dimension or leader|dimensions and leaders", 1);
                return Ok(());
            }
            "HATCH" | "MPOLYGON" => {
                self.plan.leave_out("hatch|hatches", 1);
                return Ok(());
            }
            "IMAGE" | "WIPEOUT" | "OLE2FRAME" | "PDFUNDERLAY" | "DWFUNDERLAY" | "DGNUNDERLAY" => {
                self.plan.leave_out("picture|pictures", 1);
                return Ok(());
            }
            "SEQEND" | "VERTEX" | "POINT" | "VIEWPORT" => return Ok(()),
            _ => {}
        }
        let Some((layer, class)) = self.class(entity, place) else { return Ok(()) };
        if entity.kind == "INSERT" {
            return self.insert(entity, Place { layer, ..place }, class);
        }
        // Seen from below, x goes the other way.
        let flips = entity.number(230, 1.0) < 0.0;
        let own = if flips { Map { u: vec2(-1.0, 0.0), ..Map::IDENTITY } } else { Map::IDENTITY };
        let flat = place.map.then(own);
        let world = place.map;
        let piece = match entity.kind {
            "LINE" => Piece::line(vec![world.point(entity.point(10)), world.point(entity.point(11))], false),
            "LWPOLYLINE" => {
                let mut vertices: Vec<(Vec2, f64)> = Vec::new();
                for pair in entity.pairs {
                    match (pair.code, vertices.last_mut()) {
                        (10, _) => vertices.push((vec2(pair.number(), 0.0), 0.0)),
                        (20, Some(last)) => last.0.y = pair.number(),
                        (42, Some(last)) => last.1 = pair.number(),
                        _ => {}
                    }
                }
                return self.bulged(
                    &vertices,
                    entity.flags(70) & 1 != 0,
                    entity.number(43, 0.0),
                    flat,
                    class,
                    place.group,
                );
            }
            "ARC" | "CIRCLE" => {
                let radius = entity.number(40, 0.0);
                let full = entity.kind == "CIRCLE";
                let (from, to) = if full { (0.0, 360.0) } else { (entity.number(50, 0.0), entity.number(51, 360.0)) };
                let to = if to <= from { to + 360.0 } else { to };
                let (u, v) = (flat.u * radius, flat.v * radius);
                curve(arc(flat.point(entity.point(10)), u, v, from.to_radians(), to.to_radians()), full)
            }
            "ELLIPSE" => {
                let major = entity.point(11);
                let minor = major.left() * (entity.number(40, 1.0) * if flips { -1.0 } else { 1.0 });
                let (from, to) = (entity.number(41, 0.0), entity.number(42, std::f64::consts::TAU));
                let to = if to <= from { to + std::f64::consts::TAU } else { to };
                let full = to - from > 0.999 * std::f64::consts::TAU;
                let centre = world.point(entity.point(10));
                curve(arc(centre, world.vector(major), world.vector(minor), from, to), full)
            }
            "SPLINE" => {
                let through = spline(entity).into_iter().map(|p| world.point(p)).collect();
                curve(through, entity.flags(70) & 1 != 0)
            }
            "SOLID" | "TRACE" | "3DFACE" => {
                let map = if entity.kind == "3DFACE" { world } else { flat };
                // The third and the fourth corner cross over in solids.
                let order = if entity.kind == "3DFACE" { [10, 11, 12, 13] } else { [10, 11, 13, 12] };
                Piece::area(vec![order.iter().map(|code| map.point(entity.point(*code))).collect()])
            }
            "MLINE" => {
                let mut points: Vec<Vec2> = entity.points(11).into_iter().map(|p| world.point(p)).collect();
                let thick = entity.number(40, 1.0).abs();
                // Justified to the top or the bottom, the middle lies half a thickness beside.
                let beside = [-0.5, 0.0, 0.5][entity.flags(70).clamp(0, 2) as usize] * thick;
                if let [first, .., last] = points[..]
                    && let Some(along) = (last - first).normalized()
                {
                    points.iter_mut().for_each(|p| *p += along.left() * beside);
                }
                let mut piece = Piece::line(points, entity.flags(71) & 2 != 0);
                if let Some(stroke) = &mut piece.stroke {
                    stroke.width = thick * place.map.u.length();
                }
                piece
            }
            _ => {
                self.plan.leave_out("entity of another kind|entities of other kinds", 1);
                return Ok(());
            }
        };
        self.plan.add(Piece { class, group: place.group, ..piece })
    }

    fn polyline(&mut self, entity: &Entity<'a>, vertices: &[&Entity], place: Place<'a>) -> Result<(), TooMany> {
        let Some((_, class)) = self.class(entity, place) else { return Ok(()) };
        if entity.flags(70) & (16 | 64) != 0 {
            self.plan.leave_out("mesh|meshes", 1);
            return Ok(());
        }
        let flips = entity.number(230, 1.0) < 0.0;
        let own = if flips { Map { u: vec2(-1.0, 0.0), ..Map::IDENTITY } } else { Map::IDENTITY };
        // Control points of a spline are not on it.
        let on_it = vertices.iter().filter(|vertex| vertex.flags(70) & 16 == 0);
        let corners: Vec<(Vec2, f64)> = on_it.map(|vertex| (vertex.point(10), vertex.number(42, 0.0))).collect();
        let (closed, width) = (entity.flags(70) & 1 != 0, entity.number(40, 0.0));
        self.bulged(&corners, closed, width, place.map.then(own), class, place.group)
    }

    /// A polyline with arcs: a bulge is the tangent of a quarter of the arc's turn.
    fn bulged(
        &mut self,
        vertices: &[(Vec2, f64)],
        closed: bool,
        width: f64,
        map: Map,
        class: Option<PlanClass>,
        group: u32,
    ) -> Result<(), TooMany> {
        let mut points: Vec<Vec2> = Vec::new();
        let mut lines: Vec<(Vec<Vec2>, bool)> = Vec::new();
        let n = vertices.len();
        for (k, &(p, bulge)) in vertices.iter().enumerate() {
            points.push(p);
            let next = vertices[(k + 1) % n].0;
            if bulge == 0.0 || (k + 1 == n && !closed) {
                continue;
            }
            let quarter = crate::math::atan2(bulge, 1.0);
            let chord = next - p;
            let middle = p.lerp(next, 0.5) + chord.left() * ((1.0 - bulge * bulge) / (4.0 * bulge));
            let arm = p - middle;
            let around = arc(middle, arm, arm.left(), 0.0, 4.0 * quarter);
            lines.push((around.iter().map(|p| map.point(*p)).collect(), true));
            points.extend(&around[1..around.len() - 1]);
        }
        let width = width * map.u.length();
        let curved = !lines.is_empty();
        let with_width = |mut piece: Piece, curved: bool| {
            if let Some(stroke) = &mut piece.stroke {
                stroke.width = width;
            }
            Piece { class, group, curved, ..piece }
        };
        if closed || !curved {
            let points = points.into_iter().map(|p| map.point(p)).collect();
            return self.plan.add(with_width(Piece::line(points, closed && n > 2), curved && n <= 2));
        }
        for (points, curved) in lines {
            self.plan.add(with_width(Piece::line(points, false), curved))?;
        }
        for pair in vertices.windows(2).filter(|pair| pair[0].1 == 0.0) {
            let ends = pair.iter().map(|vertex| map.point(vertex.0)).collect();
            self.plan.add(with_width(Piece::line(ends, false), false))?;
        }
        Ok(())
    }

    fn insert(&mut self, entity: &Entity<'a>, place: Place<'a>, class: Option<PlanClass>) -> Result<(), TooMany> {
        let name = entity.text(2);
        let Some(block) = self.drawing.blocks.get(name) else {
            self.plan.leave_out("block without content|blocks without content", 1);
            return Ok(());
        };
        if self.blocks.contains(&name) || self.blocks.len() >= DEEPEST {
            self.plan.leave_out("block that holds itself|blocks that hold themselves", 1);
            return Ok(());
        }
        let (sin, cos) = sin_cos(entity.number(50, 0.0).to_radians());
        let (sx, sy) = (entity.number(41, 1.0), entity.number(42, 1.0));
        let turned = |p: Vec2| vec2(p.x * cos - p.y * sin, p.x * sin + p.y * cos);
        let flip = if entity.number(230, 1.0) < 0.0 { -1.0 } else { 1.0 };
        let own = |p: Vec2| vec2(p.x * flip, p.y);
        // Anonymous blocks have no name that says anything.
        let named = if name.starts_with('*') { None } else { self.plan.class_of(name) };
        let class = match (class, named) {
            (Some(layer), Some(block)) if layer.is_furniture() && block.is_furniture() => Some(block),
            (None, block) => block,
            (layer, _) => layer,
        };
        let [columns, rows] = [70, 71].map(|code| entity.number(code, 1.0).clamp(1.0, 10_000.0) as usize);
        self.blocks.push(name);
        for row in 0..rows {
            for column in 0..columns {
                self.inserts += 1;
                if self.inserts > MOST_INSERTS {
                    return Err(TooMany);
                }
                let step = vec2(column as f64 * entity.number(44, 0.0), row as f64 * entity.number(45, 0.0));
                let linear = Map {
                    u: own(turned(vec2(sx, 0.0))),
                    v: own(turned(vec2(0.0, sy))),
                    origin: own(entity.point(10) + turned(step)),
                };
                let origin = linear.point(-block.base);
                let map = place.map.then(Map { origin, ..linear });
                let group = if place.group == 0 { self.inserts as u32 } else { place.group };
                self.entities(&block.entities, Place { map, layer: place.layer, class, group })?;
            }
        }
        self.blocks.pop();
        Ok(())
    }
}

fn curve(points: Vec<Vec2>, full: bool) -> Piece {
    Piece { curved: true, ..Piece::line(points, full) }
}

/// Places along a spline, by de Boor's rule; through its fit points if it has no control points.
fn spline(entity: &Entity) -> Vec<Vec2> {
    let controls = entity.points(10);
    if controls.is_empty() {
        return entity.points(11);
    }
    let knots: Vec<f64> = entity.pairs.iter().filter(|pair| pair.code == 40).map(Pair::number).collect();
    let degree = entity.flags(71).clamp(1, 10) as usize;
    if controls.len() <= degree || controls.len() > MOST_CONTROLS || knots.len() < controls.len() + degree + 1 {
        return controls;
    }
    let (from, to) = (knots[degree], knots[controls.len()]);
    let at = |t: f64| {
        let span = (degree..controls.len()).rev().find(|k| knots[*k] <= t).unwrap_or(degree);
        let mut d: Vec<Vec2> = controls[span - degree..=span].to_vec();
        for r in 1..=degree {
            for j in (r..=degree).rev() {
                let k = j + span - degree;
                let width = knots[k + degree + 1 - r] - knots[k];
                let share = if width > 0.0 { (t - knots[k]) / width } else { 0.0 };
                d[j] = d[j - 1].lerp(d[j], share);
            }
        }
        d[degree]
    };
    (0..=SPLINE_STEPS).map(|k| at(from + (to - from) * k as f64 / SPLINE_STEPS as f64)).collect()
}
