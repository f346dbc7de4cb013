//! PDF drawings: the paths of a page, with its layers (optional content). Texts and pictures are left out.

use hayro_syntax::Pdf;
use hayro_syntax::content::UntypedIter;
use hayro_syntax::object::dict::keys;
use hayro_syntax::object::{Array, Dict, Name, Number, Object, ObjectIdentifier, Stream, String as Text};
use hayro_syntax::page::Resources;
use rustc_hash::FxHashSet;

use super::piece::{Map, Path, Stroke, TOO_MANY, TooMany, Unit, VectorPlan};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::{PlanClass, PlanLayers};

/// Metres of a point of paper.
const POINT_M: f64 = 0.0254 / 72.0;
/// Deepest nesting of forms, and of saved states.
const DEEPEST_FORM: usize = 16;
const DEEPEST_STATE: usize = 1000;
/// Most instructions of a page, those of forms each time.
const MOST_INSTRUCTIONS: usize = 20_000_000;
/// Longest text of a page in which its scale is looked for, bytes.
const LONGEST_TEXT: usize = 1 << 20;

/// Reads a page, counted from 1.
pub(super) fn read(bytes: Vec<u8>, page: Option<u32>, said: &PlanLayers) -> Result<VectorPlan, String> {
    let pdf = Pdf::new(bytes).map_err(|error| match error {
        hayro_syntax::LoadPdfError::Decryption(_) => "it is locked by a password".to_owned(),
        hayro_syntax::LoadPdfError::Invalid => "it is damaged".to_owned(),
    })?;
    let pages = pdf.pages();
    let wanted = page.unwrap_or(1) as usize;
    let chosen = wanted.checked_sub(1).and_then(|at| pages.get(at));
    let page = chosen.ok_or_else(|| format!("page {wanted} was asked for; it has {}", pages.iter().count()))?;
    let mut plan = VectorPlan::of(Unit::Paper(POINT_M), said);
    if pages.iter().count() > 1 {
        plan.warnings.push(format!("page {wanted} of {} was read", pages.iter().count()));
    }
    let [a, b, c, d, e, f] = page.initial_transform(false).as_coeffs();
    let to_page = Map { u: vec2(a, b), v: vec2(c, d), origin: vec2(e, f) };
    let catalog = pdf.xref().get::<Dict>(pdf.xref().root_id()).unwrap_or_default();
    let mut reader =
        Reader { plan, off: switched_off(&catalog), layers: Vec::new(), text: Vec::new(), instructions: 0 };
    let state = State { map: to_page, width: 1.0, fill: [0; 3], stroke: [0; 3], clip: None };
    let size = page.render_dimensions();
    reader.content(page.operations(), page.resources(), state, 0).map_err(|TooMany| TOO_MANY.to_owned())?;
    let Reader { mut plan, text, .. } = reader;
    if plan.pieces.is_empty() {
        return Err("the page draws no lines: it may be a scan".to_owned());
    }
    // What is beyond the page is not seen.
    let page = Rect { min: Vec2::ZERO, max: vec2(f64::from(size.0), f64::from(size.1)) };
    let before = plan.pieces.len();
    plan.pieces.retain(|piece| piece.bounds().overlaps(page));
    plan.leave_out("shape beyond the page|shapes beyond the page", before - plan.pieces.len());
    if let Some(ratio) = printed_scale(&String::from_utf8_lossy(&text)) {
        plan.warnings.push(format!("the scale was taken for 1:{ratio}, as it is printed"));
        plan.unit = Unit::Metres(POINT_M * ratio);
    }
    Ok(plan)
}

/// The layers that are off.
fn switched_off(catalog: &Dict) -> FxHashSet<ObjectIdentifier> {
    let mut off = FxHashSet::default();
    let Some(properties) = catalog.get::<Dict>(keys::OCPROPERTIES) else { return off };
    let Some(usual) = properties.get::<Dict>(keys::D) else { return off };
    let ids = |array: Option<Array>| -> Vec<ObjectIdentifier> {
        array
            .iter()
            .flat_map(|a| a.raw_iter())
            .filter_map(|item| item.as_obj_ref())
            .map(ObjectIdentifier::from)
            .collect()
    };
    if usual.get::<Name>(keys::BASE_STATE).is_some_and(|state| state.as_ref() == b"OFF") {
        off.extend(ids(properties.get(keys::OCGS)));
        ids(usual.get(keys::ON)).iter().for_each(|id| {
            off.remove(id);
        });
    }
    off.extend(ids(usual.get(keys::OFF)));
    off
}

/// The only scale that a text names, such as "1:100", from 1:10 to 1:1000.
fn printed_scale(text: &str) -> Option<f64> {
    let mut found: Vec<u32> = Vec::new();
    for (at, _) in text.match_indices("1:") {
        let follows_digit = text[..at].ends_with(|c: char| c.is_ascii_digit() || c == ':' || c == '.');
        let rest = text[at + 2..].trim_start();
        let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
        if let Ok(ratio) = digits.parse()
            && !follows_digit
            && (10..=1000).contains(&ratio)
            && ratio % 5 == 0
            && !found.contains(&ratio)
        {
            found.push(ratio);
        }
    }
    match found[..] {
        [one] => Some(f64::from(one)),
        _ => None,
    }
}

#[derive(Clone, Copy)]
struct State {
    map: Map,
    width: f64,
    fill: [u8; 3],
    stroke: [u8; 3],
    /// Box beyond which nothing is seen, on the page.
    clip: Option<Rect>,
}

struct Reader {
    plan: VectorPlan,
    off: FxHashSet<ObjectIdentifier>,
    /// Marked content that is open: whether it is seen, and what it is named after.
    layers: Vec<(bool, Option<PlanClass>)>,
    text: Vec<u8>,
    instructions: usize,
}

impl Reader {
    fn content(
        &mut self,
        mut content: UntypedIter,
        resources: &Resources,
        first: State,
        depth: usize,
    ) -> Result<(), TooMany> {
        let open_before = self.layers.len();
        let mut state = first;
        let mut saved: Vec<State> = Vec::new();
        let mut path = Path::default();
        let mut clips = false;
        while let Some(instruction) = content.next() {
            self.instructions += 1;
            if self.instructions > MOST_INSTRUCTIONS || path.corners() > super::piece::MOST_CORNERS {
                return Err(TooMany);
            }
            let numbers: Vec<f64> = instruction.operands().filter_map(number).collect();
            let operator: &[u8] = instruction.operator;
            let point = |at: usize| match numbers.get(at..at + 2) {
                Some(&[x, y]) => state.map.point(vec2(x, y)),
                _ => vec2(f64::NAN, f64::NAN),
            };
            match operator {
                b"q" if saved.len() < DEEPEST_STATE => saved.push(state),
                b"Q" => state = saved.pop().unwrap_or(state),
                b"cm" => {
                    if let &[a, b, c, d, e, f] = &numbers[..] {
                        state.map = state.map.then(Map { u: vec2(a, b), v: vec2(c, d), origin: vec2(e, f) });
                    }
                }
                b"w" => state.width = numbers.first().copied().unwrap_or(1.0),
                b"g" | b"rg" | b"k" | b"sc" | b"scn" => state.fill = colour(&numbers, state.fill),
                b"G" | b"RG" | b"K" | b"SC" | b"SCN" => state.stroke = colour(&numbers, state.stroke),
                b"m" => path.move_to(point(0)),
                b"l" => path.line_to(point(0)),
                b"c" => path.cubic_to(point(0), point(2), point(4)),
                b"v" => {
                    let at = path.at().unwrap_or(point(0));
                    path.cubic_to(at, point(0), point(2));
                }
                b"y" => path.cubic_to(point(0), point(2), point(2)),
                b"h" => path.close(),
                b"re" => {
                    if let &[x, y, w, h] = &numbers[..] {
                        path.move_to(state.map.point(vec2(x, y)));
                        for (x, y) in [(x + w, y), (x + w, y + h), (x, y + h)] {
                            path.line_to(state.map.point(vec2(x, y)));
                        }
                        path.close();
                    }
                }
                b"W" | b"W*" => clips = true,
                b"S" | b"s" | b"f" | b"F" | b"f*" | b"B" | b"B*" | b"b" | b"b*" | b"n" => {
                    if matches!(operator, b"s" | b"b" | b"b*") {
                        path.close();
                    }
                    let fills = matches!(operator, b"f" | b"F" | b"f*" | b"B" | b"B*" | b"b" | b"b*");
                    let strokes = !fills && operator != b"n" || matches!(operator, b"B" | b"B*" | b"b" | b"b*");
                    self.paint(&path, &state, fills, strokes)?;
                    if std::mem::take(&mut clips) {
                        state.clip = narrowed(state.clip, path.bounds());
                    }
                    path = Path::default();
                }
                b"BDC" | b"BMC" => {
                    let tag = instruction.operands().next();
                    let is_layer = matches!(tag, Some(Object::Name(tag)) if tag.as_ref() == b"OC");
                    let properties = match instruction.operands().nth(1) {
                        Some(Object::Name(name)) if is_layer => resources
                            .properties
                            .get::<Dict>(name)
                            .map(|dict| (dict, resources.properties.get_ref(name))),
                        _ => None,
                    };
                    let layer = match properties {
                        Some((dict, id)) => self.layer(&dict, id.map(ObjectIdentifier::from)),
                        None => (true, None),
                    };
                    let around = self.layers.last().copied().unwrap_or((true, None));
                    self.layers.push((around.0 && layer.0, layer.1.or(around.1)));
                }
                b"EMC" if self.layers.len() > open_before => {
                    self.layers.pop();
                }
                b"Do" => {
                    if let Some(Object::Name(name)) = instruction.operands().next()
                        && let Some(object) = resources.get_x_object(name)
                    {
                        self.object(&object, resources, state, depth)?;
                    }
                }
                b"BI" | b"ID" | b"EI" => self.plan.leave_out("picture|pictures", usize::from(operator == b"BI")),
                b"Tj" | b"TJ" | b"'" | b"\"" => {
                    self.plan.leave_out("text|texts", 1);
                    for operand in instruction.operands() {
                        match operand {
                            Object::String(text) => self.read_text(text),
                            Object::Array(texts) => texts.iter::<Text>().for_each(|text| self.read_text(&text)),
                            _ => {}
                        }
                    }
                    if self.text.len() < LONGEST_TEXT {
                        self.text.push(b'\n');
                    }
                }
                _ => {}
            }
        }
        self.layers.truncate(open_before);
        Ok(())
    }

    fn read_text(&mut self, text: &Text) {
        if self.text.len() < LONGEST_TEXT {
            self.text.extend(text.as_bytes());
        }
    }

    /// Whether a layer is seen, and what it is named after.
    fn layer(&mut self, dict: &Dict, id: Option<ObjectIdentifier>) -> (bool, Option<PlanClass>) {
        let name = |dict: &Dict| Some(text_of(dict.get::<Text>(keys::NAME)?.as_bytes()));
        // A membership stands for one group or several.
        let groups: Vec<Dict> = match dict.get::<Array>(keys::OCGS) {
            Some(groups) => groups.iter::<Dict>().collect(),
            None => dict.get::<Dict>(keys::OCGS).into_iter().collect(),
        };
        let ids: Vec<ObjectIdentifier> = match dict.get_raw::<Array>(keys::OCGS) {
            _ if !dict.contains_key(keys::OCGS) => id.into_iter().collect(),
            _ => match (dict.get::<Array>(keys::OCGS), dict.get_ref(keys::OCGS)) {
                (Some(array), _) => {
                    array.raw_iter().filter_map(|item| item.as_obj_ref()).map(ObjectIdentifier::from).collect()
                }
                (None, one) => one.map(ObjectIdentifier::from).into_iter().collect(),
            },
        };
        let seen = ids.is_empty() || ids.iter().any(|id| !self.off.contains(id));
        let names: Vec<String> = [dict].into_iter().chain(&groups).filter_map(name).collect();
        let class = names.iter().find_map(|name| self.plan.class_of(name));
        if let (None, Some(name)) = (class, names.first()) {
            self.plan.add_unknown(name);
        }
        (seen, class)
    }

    fn object(&mut self, object: &Stream, resources: &Resources, state: State, depth: usize) -> Result<(), TooMany> {
        let dict = object.dict();
        let kind = dict.get::<Name>(keys::SUBTYPE);
        if kind.as_ref().is_some_and(|kind| kind.as_ref() == b"Image") {
            self.plan.leave_out("picture|pictures", 1);
            return Ok(());
        }
        if kind.is_none_or(|kind| kind.as_ref() != b"Form") || depth >= DEEPEST_FORM {
            return Ok(());
        }
        let Ok(content) = object.decoded_data() else { return Ok(()) };
        let own: Vec<f64> =
            dict.get::<Array>(keys::MATRIX).iter().flat_map(|a| a.iter::<Number>()).map(|n| n.as_f64()).collect();
        let map = match own[..] {
            [a, b, c, d, e, f] => state.map.then(Map { u: vec2(a, b), v: vec2(c, d), origin: vec2(e, f) }),
            _ => state.map,
        };
        let layer = dict
            .get::<Dict>(keys::OC)
            .map(|layer| self.layer(&layer, dict.get_ref(keys::OC).map(ObjectIdentifier::from)));
        let around = self.layers.last().copied().unwrap_or((true, None));
        let layer = layer.unwrap_or((true, None));
        self.layers.push((around.0 && layer.0, layer.1.or(around.1)));
        let resources = dict.get::<Dict>(keys::RESOURCES).map_or_else(|| resources.clone(), Resources::new);
        let done = self.content(UntypedIter::new(&content), &resources, State { map, ..state }, depth + 1);
        self.layers.pop();
        done
    }

    fn paint(&mut self, path: &Path, state: &State, fills: bool, strokes: bool) -> Result<(), TooMany> {
        let (seen, class) = self.layers.last().copied().unwrap_or((true, None));
        if !(fills || strokes) {
            return Ok(());
        }
        let inside = match (state.clip, path.bounds()) {
            (Some(clip), Some(bounds)) => clip.overlaps(bounds),
            _ => true,
        };
        if !seen || !inside {
            self.plan.leave_out("hidden shape|hidden shapes", 1);
            return Ok(());
        }
        let grows = state.map.u.cross(state.map.v).abs().sqrt();
        let stroke = strokes.then(|| Stroke { width: state.width.abs() * grows, colour: state.stroke });
        path.add_to(&mut self.plan, class, fills.then_some(state.fill), stroke, 0)
    }
}

fn narrowed(clip: Option<Rect>, by: Option<Rect>) -> Option<Rect> {
    match (clip, by) {
        (Some(a), Some(b)) => Some(Rect {
            min: vec2(a.min.x.max(b.min.x), a.min.y.max(b.min.y)),
            max: vec2(a.max.x.min(b.max.x), a.max.y.min(b.max.y)),
        }),
        (clip, by) => by.or(clip),
    }
}

fn number(object: &Object) -> Option<f64> {
    match object {
        Object::Number(number) => Some(number.as_f64()),
        _ => None,
    }
}

/// A colour of one (grey), three (red, green, blue) or four (inks) numbers; of other spaces the one before.
fn colour(numbers: &[f64], before: [u8; 3]) -> [u8; 3] {
    let byte = |v: f64| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    match *numbers {
        [grey] => [byte(grey); 3],
        [r, g, b] => [r, g, b].map(byte),
        [c, m, y, k] => [c, m, y].map(|ink| byte((1.0 - ink) * (1.0 - k))),
        _ => before,
    }
}

/// A text of a PDF, UTF-16 or single bytes.
fn text_of(bytes: &[u8]) -> String {
    match bytes.strip_prefix(&[0xfe, 0xff]) {
        Some(wide) => {
            let units: Vec<u16> = wide.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            String::from_utf16_lossy(&units)
        }
        None => match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_scale_is_found_unless_several_are() {
        assert_eq!(printed_scale("Grundriss EG M 1:100 A3"), Some(100.0));
        assert_eq!(printed_scale("1: 50"), Some(50.0));
        assert_eq!(printed_scale("1:100 and 1:20"), None);
        assert_eq!(printed_scale("11:15 h, 1:3, ratio 1:1"), None);
    }
}
