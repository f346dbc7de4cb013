//! Puts the page together: one text that holds program, shaders, triangles and images.

use serde_json::{Value, json};

use super::content::{Page, PageOptions, PageSurface};
use super::field::{self, CellGrid, DistanceField};
use super::images::{self, ImageFiles, PageImages, PixelRect};
use super::{geometry, light_grid};
use crate::export::{Camera, ExportError, OutputFolder};
use crate::look::{Layer, absorption};
use crate::math::Vec2;
use crate::math::srgb::{encode, light_of};
use crate::show::encode_picture;
use crate::show::rooms::{
    EXPOSURE_ABOVE, EXPOSURE_INSIDE, EXPOSURE_OUTSIDE, Finish, Light, Panels, TABLE, floor_tint, glsl, scaled, sky,
    toned,
};
use crate::show::scene::{Mesh, SceneSurface};
use crate::show::still::STILL_SIZE_PX;

/// Name of the page in a bake's folder.
const PAGE_FILE: &str = "index.html";

/// The page's HTML with places for title, style, data and program.
const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// Parts of the one program, in the page's order.
const PROGRAM: [&str; 8] = [
    include_str!("client/start.js"),
    include_str!("client/vectors.js"),
    include_str!("client/data.js"),
    include_str!("client/textures.js"),
    include_str!("client/drawing.js"),
    include_str!("client/views.js"),
    include_str!("client/controls.js"),
    include_str!("client/page.js"),
];
const SHADERS: [(&str, &str); 4] = [
    ("surface-vertex", include_str!("client/surface.vert")),
    ("surface-fragment", include_str!("client/surface.frag")),
    ("plain-vertex", include_str!("client/plain.vert")),
    ("plain-fragment", include_str!("client/plain.frag")),
];
/// Functions of the light model, behind their constants.
const LIGHT: &str = include_str!("client/light.glsl");

/// Writes the page to a bake's folder.
///
/// # Errors
/// The file cannot be written.
pub fn write_page(folder: &OutputFolder, page: &Page<'_>) -> Result<(), ExportError> {
    folder.write(PAGE_FILE, page_html(page).as_bytes())
}

/// The page's text. The same page gives the same bytes.
pub fn page_html(page: &Page<'_>) -> String {
    let mut blocks = Vec::new();
    let mut data = json!({
        "title": page.title,
        "height": page.wall_height_m,
        "aspect": f64::from(STILL_SIZE_PX[0]) / f64::from(STILL_SIZE_PX[1]),
        "start": camera(&page.start),
        "above": camera(&page.above),
        // Background colours: inside (seen through hairline gaps between triangles) and from above.
        "around": [
            shown(scaled(light_of(page.wall.clean), 0.5 * EXPOSURE_INSIDE)),
            if is_outside(page) { shown(scaled(sky(0.1), EXPOSURE_OUTSIDE)) } else { shown(scaled(TABLE, EXPOSURE_ABOVE)) },
        ],
        "outlines": page.walls.outlines().iter().map(outline).collect::<Vec<_>>(),
        "surfaces": { "floor": covering(&page.floor), "wall": covering(&page.wall) },
        "parts": parts(page, &mut blocks),
    });
    surroundings(page, &mut data, &mut blocks);
    // Whether sky and sun are the light, and the tint of what the floor throws back.
    let [r, g, b] = floor_tint(light_of(page.floor.clean));
    let of_plan =
        format!("const bool OUTSIDE = {};\nconst vec3 FLOOR_TINT = vec3({r:?}, {g:?}, {b:?});\n", is_outside(page));
    let light = [&glsl(), &of_plan, LIGHT].concat();
    let shader = |(name, text)| element("x-shader/x-glsl", name, &fill(text, &[("light", &light)]));
    let shaders: String = SHADERS.map(shader).concat();
    let blocks: String =
        blocks.iter().map(|(name, bytes)| element("application/base64", name, &base64(bytes))).collect();
    let data = element("application/json", "data", &data.to_string().replace('<', "\\u003c"));
    fill(
        TEMPLATE,
        &[
            ("title", &escaped(page.title)),
            ("style", STYLE),
            ("data", &[data, shaders, blocks].concat()),
            ("program", &PROGRAM.concat()),
        ],
    )
}

/// Whether sky and sun are over the walls.
fn is_outside(page: &Page<'_>) -> bool {
    !page.rooms.grid.roofed && !page.rooms.grid.is_open()
}

pub(in crate::show) fn element(kind: &str, name: &str, text: &str) -> String {
    format!("<script type=\"{kind}\" id=\"{name}\">{text}</script>\n")
}

/// Puts texts in the places `{{name}}` of a template. Places within the texts stay as they are.
pub(in crate::show) fn fill(template: &str, texts: &[(&str, &str)]) -> String {
    let mut filled = String::with_capacity(template.len() + texts.iter().map(|(_, text)| text.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        filled.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        filled.push_str(texts.iter().find(|(known, _)| *known == name).map_or("", |(_, text)| text));
        rest = after;
    }
    filled.push_str(rest);
    filled
}

/// Text as HTML shows it.
pub(in crate::show) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Bytes as text (RFC 4648, with padding).
pub(in crate::show) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let word = three.iter().zip([16, 8, 0]).map(|(&byte, shift)| u32::from(byte) << shift).sum::<u32>();
        for (n, shift) in [18, 12, 6, 0].into_iter().enumerate() {
            let digit = DIGITS[(word >> shift) as usize & 63];
            text.push(if n <= three.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

/// Rounds to four decimals, a tenth of a millimetre, to keep the JSON short.
fn metres(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

fn point(p: Vec2) -> [f64; 2] {
    [metres(p.x), metres(p.y)]
}

/// A camera as the page has it: metres and radians.
fn camera(camera: &Camera) -> Value {
    let [heading, pitch, fov] = [camera.heading_deg, camera.pitch_deg, camera.fov_deg].map(f64::to_radians).map(metres);
    json!({ "at": camera.position_m.map(metres), "heading": heading, "pitch": pitch, "fov": fov })
}

/// Exposed light as a canvas shows it, 0 to 1.
fn shown(light: [f32; 3]) -> [f64; 3] {
    light.map(|light| metres(encode(toned(f64::from(light)))))
}

fn outline(outline: &crate::walls::Outline) -> Value {
    let points: Vec<[f64; 2]> = outline.points_m.iter().map(|&p| point(p)).collect();
    json!({ "points": points, "openings": outline.openings.iter().map(|(edge, _)| edge).collect::<Vec<_>>() })
}

fn covering(covering: &PageSurface<'_>) -> Value {
    let kinds = &covering.dirt[..covering.dirt.len().min(Layer::KINDS)];
    let kinds: Vec<Value> = kinds
        .iter()
        .map(|dirt| {
            let absorbs = absorption(light_of(dirt.colour));
            json!({ "name": dirt.name, "colour": light_of(dirt.colour), "srgb": dirt.colour, "absorbs": absorbs })
        })
        .collect();
    json!({ "clean": light_of(covering.clean), "roughness": covering.roughness, "kinds": kinds })
}

/// The image of a part, and which of it.
struct PartImage {
    area: PixelRect,
    /// Of the whole image.
    size: [u32; 2],
    images: PageImages,
}

fn part_image(page: &Page<'_>, part: &Mesh) -> Option<PartImage> {
    let images = match part.surface {
        SceneSurface::FloorTile(n) => page.floor.images.get(n),
        SceneSurface::WallSheet(n) => page.wall.images.get(n),
        SceneSurface::WallTop | SceneSurface::Lintel | SceneSurface::Fitting(_) | SceneSurface::Ceiling => None,
    }?;
    let (width, height) = images.clean.dimensions();
    let fits = images.dirt.dimensions() == (width, height) && images.orm.dimensions() == (width, height);
    if !fits || width == 0 || height == 0 {
        return None;
    }
    let area = geometry::shown(part, width, height);
    Some(PartImage { area, size: [width, height], images: PageImages::cropped(images, area) })
}

/// Describes the parts and appends their bytes.
fn parts(page: &Page<'_>, blocks: &mut Vec<(String, Vec<u8>)>) -> Vec<Value> {
    let parts: Vec<&Mesh> = page.scene.meshes.iter().filter(|part| geometry::usable(part)).collect();
    let images: Vec<Option<PartImage>> = parts.iter().map(|part| part_image(page, part)).collect();
    let files = within_bounds(page.options, &images);
    let mut described = Vec::new();
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for (n, ((part, image), files)) in parts.iter().zip(&images).zip(files).enumerate() {
        let starts = [vertices.len() / geometry::VERTEX_BYTES, indices.len() / 4];
        geometry::vertices(part, image.as_ref().map(|image| (image.area, image.size)), &mut vertices);
        geometry::indices(part, &mut indices);
        let image = files.map(|files| {
            let ImageFiles { width, height, dirt, clean, rough } = files;
            for (kind, bytes) in [("dirt", dirt), ("clean", clean), ("rough", rough)] {
                blocks.push((format!("{kind}-{n}"), bytes));
            }
            json!({ "id": n, "width": width, "height": height })
        });
        let kind = match part.surface {
            SceneSurface::FloorTile(_) => "floor",
            SceneSurface::WallSheet(_) => "wall",
            SceneSurface::WallTop => "top",
            SceneSurface::Lintel | SceneSurface::Ceiling => "lintel",
            SceneSurface::Fitting(finish) if finish == Finish::Pane as usize => "pane",
            SceneSurface::Fitting(_) => "fitting",
        };
        let finish = match part.surface {
            SceneSurface::Fitting(finish) => Finish::ALL.get(finish),
            _ => None,
        };
        described.push(json!({
            "surface": kind,
            "colour": finish.map(|finish| light_of(finish.colour())),
            "roughness": finish.map(|finish| finish.roughness()),
            "image": image,
            "vertices": [starts[0], part.positions_m.len()],
            "indices": [starts[1], part.indices.len()],
        }));
    }
    blocks.push(("vertices".to_string(), vertices));
    blocks.push(("indices".to_string(), indices));
    described
}

/// Compressed images, halved as often as it takes to keep to the options.
fn within_bounds(options: PageOptions, images: &[Option<PartImage>]) -> Vec<Option<ImageFiles>> {
    const LEAST_PX: u32 = 256;
    let largest_px = options.largest_px.max(LEAST_PX);
    let fitting = |image: &Option<PartImage>| {
        let mut image = image.as_ref()?.images.clone();
        while image.longest_px() > largest_px {
            image = image.halved();
        }
        Some(image)
    };
    let mut images: Vec<Option<PageImages>> = images.iter().map(fitting).collect();
    loop {
        let files: Vec<Option<ImageFiles>> = images.iter().map(|image| image.as_ref().map(images::encode)).collect();
        let bytes: usize = files.iter().flatten().map(ImageFiles::bytes).sum();
        if bytes <= options.image_bytes || images.iter().flatten().all(|image| image.longest_px() <= LEAST_PX) {
            return files;
        }
        for image in images.iter_mut().flatten().filter(|image| image.longest_px() > LEAST_PX) {
            *image = image.halved();
        }
    }
}

fn raster(raster: &CellGrid) -> Value {
    let origin = point(raster.origin_m);
    json!({ "origin": origin, "cell": raster.cell_m, "width": raster.width, "height": raster.height })
}

/// Distances, lamps and their light.
fn surroundings(page: &Page<'_>, data: &mut Value, blocks: &mut Vec<(String, Vec<u8>)>) {
    let grid = &page.rooms.grid;
    let field = DistanceField::of(page.walls, grid);
    blocks.push(("field".to_string(), encode_picture(&field.image())));
    data["field"] = raster(&field.raster);
    data["field"]["range"] = json!(field::RANGE_M);
    let above = if is_outside(page) { Light::inside(grid) } else { Light::above(grid, page.above.heading_deg) };
    // Open ground and yards lie under the sky.
    let lights =
        if !grid.roofed { vec![("above", above)] } else { vec![("inside", Light::inside(grid)), ("above", above)] };
    for (name, light) in &lights {
        let light = light_grid::LightGrid::of(page.walls, light);
        let (floor, walls) = light.images();
        blocks.push((format!("light-{name}"), encode_picture(&floor)));
        blocks.push((format!("light-walls-{name}"), encode_picture(&walls)));
        data["light"] = raster(&light.raster);
    }
    data["light"]["most"] = json!(light_grid::MOST);
    data["light"]["heights"] = json!(light_grid::WALL_HEIGHTS);
    data["roofed"] = json!(grid.roofed);
    let lamps = lights.iter().filter_map(|(_, light)| light.panels()).flat_map(Panels::all);
    data["lamps"] = lamps.map(|lamp| json!([point(lamp.centre - lamp.half), point(lamp.centre + lamp.half)])).collect();
}
