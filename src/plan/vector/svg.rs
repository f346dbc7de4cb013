//! SVG drawings: layers by the ids, classes and labels of groups and shapes.

use std::io::Read;
use std::ops::Range;

use rustc_hash::FxHashMap;
use usvg::roxmltree;
use usvg::tiny_skia_path::PathSegment;

use super::piece::{Path, Stroke, TOO_MANY, TooMany, Unit, VectorPlan};
use crate::math::{Vec2, vec2};
use crate::plan::{PlanClass, PlanLayers};

/// Largest text of a compressed SVG, bytes.
const LARGEST_TEXT: u64 = 256 << 20;
/// Most elements, attributes and texts.
const MOST_NODES: u32 = 4_000_000;
/// Deepest nesting of groups.
const DEEPEST: usize = 200;
/// Ids that elements without one get, so that their names are found again.
const OURS: &str = "trodden-";

/// Reads an SVG or SVGZ file. Of a building model's storeys it reads one, counted from 1.
pub(super) fn read(bytes: &[u8], storey: Option<u32>, said: &PlanLayers) -> Result<VectorPlan, String> {
    let unpacked;
    let bytes = if bytes.starts_with(&[0x1f, 0x8b]) {
        let mut text = Vec::new();
        let mut unzip = flate2::read::GzDecoder::new(bytes).take(LARGEST_TEXT + 1);
        unzip.read_to_end(&mut text).map_err(|error| format!("it cannot be unpacked: {error}"))?;
        if text.len() as u64 > LARGEST_TEXT {
            return Err(format!("it unpacks to more than {LARGEST_TEXT} bytes"));
        }
        unpacked = text;
        &unpacked
    } else {
        bytes
    };
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())?;
    let mut plan = VectorPlan::of(Unit::Unknown, said);
    let (text, names) = named(text, storey, &mut plan)?;
    let resolver =
        usvg::ImageHrefResolver { resolve_data: Box::new(|_, _, _| None), resolve_string: Box::new(|_, _| None) };
    // Doors of building models have neither fill nor line in the style that IfcConvert writes.
    let style_sheet = Some(".IfcDoor path { stroke: black }".to_owned());
    let options = usvg::Options { image_href_resolver: resolver, style_sheet, ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(&text, &options).map_err(|error| error.to_string())?;
    let mut reader = Reader { names: &names, plan, height: f64::from(tree.size().height()), groups: 0 };
    reader.group(tree.root(), None, 0, 0).map_err(|TooMany| TOO_MANY.to_owned())?;
    let mut plan = reader.plan;
    if plan.pieces.is_empty() {
        return Err("it draws no shapes".to_owned());
    }
    // usvg gives sizes in pixels of 1/96 inch.
    plan.unit = match plan.unit {
        Unit::Paper(scale) => Unit::Paper(scale * 0.0254 / 96.0),
        Unit::Metres(scale) => Unit::Metres(scale * 0.0254 / 96.0),
        Unit::Sure(scale) => Unit::Sure(scale * 0.0254 / 96.0),
        unknown => unknown,
    };
    Ok(plan)
}

/// Gives every shape and group with a name that says something an id, and collects by id what names say. Counts texts
/// and pictures, finds the unit, and cuts out the storeys of a building model that are not asked for.
fn named(text: &str, storey: Option<u32>, plan: &mut VectorPlan) -> Result<(String, Names), String> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(text, options).map_err(|error| error.to_string())?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(format!("its first element is <{}>, not <svg>", root.tag_name().name()));
    }
    let storeys: Vec<_> =
        root.descendants().filter(|node| node.attribute("class") == Some("IfcBuildingStorey")).collect();
    plan.unit = unit(root, storeys.first().copied());
    let mut cuts: Vec<Range<usize>> = Vec::new();
    if storeys.len() > 1 || storey.is_some() {
        let wanted = storey.unwrap_or(1) as usize;
        if wanted > storeys.len() {
            return Err(format!("storey {wanted} was asked for; it has {}", storeys.len()));
        }
        let other = |(k, _): &(usize, &roxmltree::Node)| k + 1 != wanted;
        cuts.extend(storeys.iter().enumerate().filter(other).map(|(_, node)| node.range()));
        plan.warnings.push(format!("storey {wanted} of {} was read", storeys.len()));
    }
    let mut names = Names::default();
    // Where ids are written into the text, ascending.
    let mut inserts: Vec<(usize, String)> = Vec::new();
    for node in root.descendants().filter(|node| node.is_element()) {
        let start = node.range().start;
        let tag = node.tag_name().name();
        if cuts.iter().any(|cut| cut.contains(&start)) {
            continue;
        }
        match tag {
            "text" => plan.leave_out("text|texts", 1),
            "image" => plan.leave_out("picture|pictures", 1),
            _ => {}
        }
        if !matches!(tag, "g" | "use" | "path" | "rect" | "line" | "polyline" | "polygon" | "circle" | "ellipse") {
            continue;
        }
        let label = node.attributes().find(|attribute| attribute.name() == "label" && attribute.namespace().is_some());
        let id = node.attribute("id").filter(|id| !id.is_empty());
        let said = [label.map(|label| label.value()), node.attribute("data-name"), node.attribute("class"), id];
        let class = said.into_iter().flatten().find_map(|name| plan.class_of(name));
        let holds_shapes =
            || tag == "g" && node.children().any(|child| child.is_element() && child.tag_name().name() != "g");
        if class.is_none()
            && holds_shapes()
            && let Some(layer) = said.into_iter().flatten().find(|name| !name.is_empty())
        {
            plan.add_unknown(layer);
        }
        let Some(id) = id else {
            // Elements of entities have no place of their own in the text.
            let name = text[start..].strip_prefix('<').and_then(|rest| rest.find([' ', '\t', '\r', '\n', '>', '/']));
            let at = name.map_or(start, |end| start + 1 + end);
            let is_new = node.attribute("id").is_none() && inserts.last().is_none_or(|last| last.0 < at);
            if class.is_some() && at > start && is_new {
                let id = format!("{OURS}{}", inserts.len());
                inserts.push((at, id.clone()));
                names.insert(id, class);
            }
            continue;
        };
        names.insert(id.to_owned(), class);
    }
    let mut edited = String::with_capacity(text.len() + 24 * inserts.len());
    let mut from = 0;
    let edits = inserts.into_iter().map(|(at, id)| (at..at, format!(" id=\"{id}\"")));
    let mut edits: Vec<(Range<usize>, String)> =
        edits.chain(cuts.into_iter().map(|cut| (cut, String::new()))).collect();
    edits.sort_by_key(|(range, _)| range.start);
    for (range, new) in edits {
        // Elements of entities may lie anywhere.
        if let Some(kept) = text.get(from..range.start) {
            edited.push_str(kept);
            edited.push_str(&new);
            from = range.end;
        }
    }
    edited.push_str(&text[from..]);
    Ok((edited, names))
}

/// What names say, by the ids of elements.
type Names = FxHashMap<String, Option<PlanClass>>;

/// The unit in which sizes are given, for a paper of metres: a physical size is one of paper, unless the drawing tells
/// its scale.
fn unit(root: roxmltree::Node, storey: Option<roxmltree::Node>) -> Unit {
    let is_physical = |name: &str| {
        let length = root.attribute(name).unwrap_or_default().trim();
        ["mm", "cm", "in", "pt", "pc", "Q"].iter().any(|unit| length.ends_with(unit))
    };
    if !(is_physical("width") || is_physical("height")) {
        return Unit::Unknown;
    }
    // IfcConvert writes how it turned metres into millimetres of paper.
    let matrix = storey.and_then(|node| node.attributes().find(|a| a.name().ends_with("matrix3"))).map(|a| a.value());
    let per_metre = matrix.and_then(|text| text.trim_start_matches('[').split(',').next()?.trim().parse::<f64>().ok());
    let of_model = per_metre.map(|mm| 1000.0 / mm).filter(|scale| (0.1..=1e5).contains(scale));
    match (of_model, root.attribute("data-scale").and_then(ratio)) {
        // Doors of models are drawn with their frames, piece by piece: they tell no better.
        (Some(scale), _) => Unit::Sure(scale),
        (None, Some(scale)) => Unit::Metres(scale),
        (None, None) => Unit::Paper(1.0),
    }
}

/// How many metres a metre of paper is, as in "1:100".
fn ratio(text: &str) -> Option<f64> {
    let (one, many) = text.split_once(':')?;
    let (one, many): (f64, f64) = (one.trim().parse().ok()?, many.trim().parse().ok()?);
    let ratio = many / one;
    (ratio.is_finite() && (0.1..=1e5).contains(&ratio)).then_some(ratio)
}

struct Reader<'a> {
    names: &'a Names,
    plan: VectorPlan,
    height: f64,
    groups: u32,
}

impl Reader<'_> {
    fn class(&self, id: &str) -> Option<PlanClass> {
        self.names.get(id).copied().flatten()
    }

    fn group(
        &mut self,
        group: &usvg::Group,
        class: Option<PlanClass>,
        thing: u32,
        depth: usize,
    ) -> Result<(), TooMany> {
        if depth > DEEPEST {
            return Err(TooMany);
        }
        let own = self.class(group.id());
        // A group inside a layer of furniture is a piece of furniture.
        let inside = class.is_some_and(PlanClass::is_furniture) && own.or(class).is_some_and(PlanClass::is_furniture);
        let thing = match thing {
            0 if inside => {
                self.groups += 1;
                self.groups
            }
            thing => thing,
        };
        for node in group.children() {
            match node {
                usvg::Node::Group(inner) => self.group(inner, own.or(class), thing, depth + 1)?,
                usvg::Node::Path(path) if path.is_visible() => {
                    self.path(path, self.class(path.id()).or(own).or(class), thing)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn path(&mut self, path: &usvg::Path, class: Option<PlanClass>, thing: u32) -> Result<(), TooMany> {
        let to_page = path.abs_transform();
        let [a, b, c, d, e, f] =
            [to_page.sx, to_page.ky, to_page.kx, to_page.sy, to_page.tx, to_page.ty].map(f64::from);
        let height = self.height;
        let place = |p: usvg::tiny_skia_path::Point| -> Vec2 {
            let (x, y) = (f64::from(p.x), f64::from(p.y));
            vec2(a * x + c * y + e, height - (b * x + d * y + f))
        };
        let mut out = Path::default();
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => out.move_to(place(p)),
                PathSegment::LineTo(p) => out.line_to(place(p)),
                PathSegment::QuadTo(c, p) => {
                    let (start, c, end) = (out.at().unwrap_or(Vec2::ZERO), place(c), place(p));
                    out.cubic_to(start.lerp(c, 2.0 / 3.0), end.lerp(c, 2.0 / 3.0), end);
                }
                PathSegment::CubicTo(c1, c2, p) => out.cubic_to(place(c1), place(c2), place(p)),
                PathSegment::Close => out.close(),
            }
        }
        let fill = path.fill().filter(|fill| fill.opacity().get() > 0.05).map(|fill| colour(fill.paint()));
        let grows = (a * d - b * c).abs().sqrt();
        let stroke = path
            .stroke()
            .filter(|stroke| stroke.opacity().get() > 0.05)
            .map(|stroke| Stroke { width: f64::from(stroke.width().get()) * grows, colour: colour(stroke.paint()) });
        out.add_to(&mut self.plan, class, fill, stroke, thing)
    }
}

/// A colour; gradients and patterns are as grey as hatches.
fn colour(paint: &usvg::Paint) -> [u8; 3] {
    match paint {
        usvg::Paint::Color(colour) => [colour.red, colour.green, colour.blue],
        _ => [128; 3],
    }
}
