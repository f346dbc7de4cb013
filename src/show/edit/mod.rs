//! The page on which a plan is put right by clicking: one file that opens from disk, without network.
//!
//! It shows the plan with what was understood of it. Its Save downloads the scenario, and a paint that holds only what
//! was changed.

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, GrayImage, ImageEncoder, RgbImage};
use serde_json::{Value, json};

use super::encode_picture;
use super::page::document::{base64, element, escaped, fill};
use crate::math::Vec2;
use crate::plan::{FloorPlan, Paint};
use crate::routes::{Place, Route};

const TEMPLATE: &str = include_str!("edit.html");
const STYLE: &str = include_str!("edit.css");
/// Parts of the one program, in the page's order.
const PROGRAM: [&str; 5] = [
    include_str!("client/plan.js"),
    include_str!("client/board.js"),
    include_str!("client/tools.js"),
    include_str!("client/save.js"),
    include_str!("client/start.js"),
];
/// The key of each paint, in their order.
const KEYS: &str = "ofwndastchxlmrpke";
/// Largest picture that is kept without loss, bytes; larger ones are photographs.
const LARGEST_PNG: usize = 3 << 20;
/// Quality of photographs, 1 to 100.
const QUALITY: u8 = 85;

/// What the page shows.
#[derive(Clone, Copy, Debug)]
pub struct EditPage<'a> {
    /// Heading.
    pub title: &'a str,
    /// The plan as the scenario names it.
    pub image: &'a str,
    /// Names of the files that Save downloads.
    pub scenario_file: &'a str,
    /// As `scenario_file`.
    pub paint_file: &'a str,
    /// The scenario's text, to be changed; empty: a new one is written.
    pub toml: &'a str,
    /// Whether a new scenario says the scale in metres per pixel.
    pub writes_scale: bool,
    /// Whether scenarios may name rooms.
    pub names_rooms: bool,
    /// The plan as it is now.
    pub plan: &'a FloorPlan,
    /// The plan as it was read without paint, if there is paint.
    pub unpainted: Option<&'a FloorPlan>,
    /// The plan's picture, of the plan's size.
    pub picture: &'a RgbImage,
    /// Ways that people take.
    pub routes: &'a [Route],
    /// Whether the scenario writes these routes.
    pub routes_are_written: bool,
    /// What keeps the plan from being baked as it is.
    pub lack: Option<&'a str>,
}

/// The page's text. The same input gives the same bytes.
pub fn edit_page_html(page: &EditPage<'_>) -> String {
    let plan = page.plan;
    let openings = plan.openings.iter();
    let data = json!({
        "width": plan.width_px,
        "height": plan.height_px,
        "metresPerPixel": plan.metres_per_pixel,
        "paints": paints(),
        "image": page.image,
        "scenarioFile": page.scenario_file,
        "paintFile": page.paint_file,
        "toml": page.toml,
        "writesScale": page.writes_scale,
        "rooms": page.names_rooms,
        "warnings": plan.warnings,
        "lack": page.lack,
        "written": page.routes_are_written,
        "doors": doors(plan),
        "openings": openings.map(|o| json!({ "name": o.name, "ends": [point(plan, o.from_m), point(plan, o.to_m)] })).collect::<Vec<_>>(),
        "ways": page.routes.iter().map(|route| way(plan, route)).collect::<Vec<_>>(),
    });
    let mut blocks = element("application/json", "data", &data.to_string().replace('<', "\\u003c"));
    blocks.push_str(&picture(page.picture));
    blocks.push_str(&image_block("now", "image/png", &encode_picture(&numbers(plan))));
    if let Some(unpainted) = page.unpainted {
        blocks.push_str(&image_block("read", "image/png", &encode_picture(&numbers(unpainted))));
    }
    fill(
        TEMPLATE,
        &[("title", &escaped(page.title)), ("style", STYLE), ("data", &blocks), ("program", &PROGRAM.concat())],
    )
}

fn image_block(id: &str, kind: &str, bytes: &[u8]) -> String {
    format!("<script type=\"application/base64\" id=\"{id}\" data-type=\"{kind}\">{}</script>\n", base64(bytes))
}

fn picture(picture: &RgbImage) -> String {
    let png = encode_picture(picture);
    if png.len() <= LARGEST_PNG {
        return image_block("picture", "image/png", &png);
    }
    let mut jpeg = Vec::new();
    let (width, height) = picture.dimensions();
    let written = JpegEncoder::new_with_quality(&mut jpeg, QUALITY).write_image(
        picture.as_raw(),
        width,
        height,
        ExtendedColorType::Rgb8,
    );
    match written {
        Ok(()) => image_block("picture", "image/jpeg", &jpeg),
        Err(_) => image_block("picture", "image/png", &png),
    }
}

fn paints() -> Vec<Value> {
    let paint = |(paint, key): (Paint, char)| {
        json!({
            "name": paint.name(),
            "meaning": paint.meaning(),
            "colour": paint.colour(),
            "key": key.to_string(),
            "solid": matches!(paint, Paint::Class(class) if class.is_solid()),
        })
    };
    Paint::all().zip(KEYS.chars()).map(paint).collect()
}

/// The number of each pixel's paint.
fn numbers(plan: &FloorPlan) -> GrayImage {
    let colours: Vec<[u8; 3]> = Paint::all().map(Paint::colour).collect();
    let number = |pixel: &image::Rgb<u8>| colours.iter().position(|colour| *colour == pixel.0).unwrap_or(0) as u8;
    let numbers = plan.painted_picture().pixels().map(number).collect();
    GrayImage::from_raw(plan.width_px, plan.height_px, numbers).unwrap_or_default()
}

/// The jambs of each door.
fn doors(plan: &FloorPlan) -> Vec<[[f64; 2]; 2]> {
    let drawn = plan.drawn.iter().flat_map(|drawn| drawn.doors.iter().copied());
    let jambs = plan.doors.iter().map(|door| [door.from_m, door.to_m]).chain(drawn);
    jambs.map(|ends| ends.map(|end| point(plan, end))).collect()
}

/// A point in pixels, to a tenth.
fn point(plan: &FloorPlan, p: Vec2) -> [f64; 2] {
    plan.m_to_px(p).map(|v| (v * 10.0).round() / 10.0)
}

/// A route's line: from its start through its gates to its goal.
fn way(plan: &FloorPlan, route: &Route) -> Value {
    let middle = |place: Place| match place {
        Place::Opening(index) => plan.openings.get(index).map(|opening| opening.centre_m()),
        Place::Area([from, to]) => Some(from.lerp(to, 0.5)),
    };
    let gates = route.gates.iter().map(|gate| gate.at(0.5));
    let points = middle(route.start).into_iter().chain(gates).chain(middle(route.goal));
    json!({ "name": route.name, "points": points.map(|p| point(plan, p)).collect::<Vec<_>>() })
}
