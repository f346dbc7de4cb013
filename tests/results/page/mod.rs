//! The free view's text: whole, self-contained, and true to the textures. `tests/page/run` opens it in a browser.

mod corridor;

use std::path::Path;
use std::sync::LazyLock;

use corridor::{Corridor, covered};
use trodden::Silent;
use trodden::export::{TextureSource, WallSource};
use trodden::look::{Background, ResolvedBlock};
use trodden::show::page::{PageOptions, page_html};
use trodden::show::scene::{Mesh, Scene};
use trodden::show::still::{FarWalls, Surfaces, WallSurfaces};

const LIGHT: [u8; 3] = [197, 192, 182];
const DARK: [u8; 3] = [60, 58, 56];

static LIGHT_CORRIDOR: LazyLock<Corridor> = LazyLock::new(|| corridor::corridor(LIGHT));
static DARK_CORRIDOR: LazyLock<Corridor> = LazyLock::new(|| corridor::corridor(DARK));
static LIGHT_PAGE: LazyLock<String> = LazyLock::new(|| page_html(&LIGHT_CORRIDOR.page("Corridor")));
static DARK_PAGE: LazyLock<String> = LazyLock::new(|| page_html(&DARK_CORRIDOR.page("Corridor")));

/// Both corridors with their pages.
fn both() -> [(&'static str, &'static Corridor, &'static str); 2] {
    [("light", &LIGHT_CORRIDOR, &LIGHT_PAGE), ("dark", &DARK_CORRIDOR, &DARK_PAGE)]
}

/// The content of the block with that name.
fn block<'a>(html: &'a str, id: &str) -> &'a str {
    let opening = format!("id=\"{id}\">");
    let from = html.find(&opening).unwrap_or_else(|| panic!("no block {id}")) + opening.len();
    &html[from..from + html[from..].find("</script>").unwrap()]
}

fn bytes(html: &str, id: &str) -> Vec<u8> {
    let text = block(html, id);
    assert!(text.len().is_multiple_of(4), "{id}: {} characters", text.len());
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => panic!("{id}: {:?} is no base64", char::from(c)),
    };
    let digits: Vec<u8> = text.trim_end_matches('=').bytes().map(digit).collect();
    let mut bytes = Vec::new();
    for four in digits.chunks(4) {
        let word = four.iter().fold(0u32, |word, &digit| word << 6 | u32::from(digit)) << (6 * (4 - four.len()));
        bytes.extend(&word.to_be_bytes()[1..four.len()]);
    }
    bytes
}

fn data(html: &str) -> serde_json::Value {
    serde_json::from_str(block(html, "data")).unwrap()
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let html = &*LIGHT_PAGE;
    for forbidden in ["http:", "https:", "src=\"", "@import", "fetch(", "XMLHttpRequest", "WebSocket", "importScripts"]
    {
        assert!(!html.contains(forbidden), "{forbidden}");
    }
    assert!(html.contains("default-src 'none'"));
    assert!(!html.contains("{{") && html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
}

#[test]
fn its_blocks_hold_what_the_description_says() {
    let html = &*LIGHT_PAGE;
    let data = data(html);
    let parts = data["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 4);
    let last =
        |key: &str| parts.last().unwrap()[key].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).sum::<u64>();
    assert_eq!(bytes(html, "vertices").len() as u64, 20 * last("vertices"));
    assert_eq!(bytes(html, "indices").len() as u64, 4 * last("indices"));
    for part in parts.iter().filter(|part| !part["image"].is_null()) {
        let id = &part["image"]["id"];
        for kind in ["dirt", "clean", "rough"] {
            let image = image::load_from_memory(&bytes(html, &format!("{kind}-{id}"))).unwrap();
            let size = ["width", "height"].map(|side| part["image"][side].as_u64().unwrap());
            assert_eq!([image.width(), image.height()].map(u64::from), size, "{kind}-{id}");
        }
    }
    let field = image::load_from_memory(&bytes(html, "field")).unwrap();
    assert_eq!(u64::from(field.width()), data["field"]["width"].as_u64().unwrap());
    assert!(data["lamps"].as_array().unwrap().len() >= 5);
}

#[test]
fn a_title_cannot_break_out() {
    let title = "</title></script><script>alert(1)</script> \"a\" & {{style}}";
    let html = page_html(&LIGHT_CORRIDOR.page(title));
    assert!(!html.contains("<script>alert"));
    assert!(html.contains("<title>&lt;/title&gt;"));
    assert_eq!(data(&html)["title"], title);
}

#[test]
fn the_same_page_whatever_the_threads() {
    let html = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| page_html(&LIGHT_CORRIDOR.page("Corridor")))
    };
    let one = html(1);
    assert!(one == html(3));
    assert!(one == html(2));
}

#[test]
fn images_are_halved_until_they_fit() {
    let html = |image_bytes: usize, largest_px: u32| {
        let options = PageOptions { image_bytes, largest_px };
        page_html(&trodden::show::page::Page { options, ..LIGHT_CORRIDOR.page("Corridor") })
    };
    let (whole, small) = (html(usize::MAX, 4096), html(30_000, 4096));
    assert!(small.len() < whole.len(), "{} of {} bytes", small.len(), whole.len());
    let sides = |html: &str| data(html)["parts"][2]["image"]["width"].as_u64().unwrap();
    assert!(sides(&small) < sides(&whole));
    assert!(sides(&html(usize::MAX, 512)) <= 512);
    assert!(sides(&html(0, 0)) <= 256);
}

/// What the page's law makes of its images is what was baked.
#[test]
fn with_all_dirt_the_page_shows_what_was_baked() {
    for (name, corridor, html) in both() {
        let page = corridor.page("Corridor");
        for (n, covering, baked) in [
            (0, &page.floor, &corridor.floor[0]),
            (1, &page.floor, &corridor.floor[1]),
            (2, &page.wall, &corridor.wall[0]),
        ] {
            let dirt = image::load_from_memory(&bytes(html, &format!("dirt-{n}"))).unwrap().to_rgba8();
            let under = image::load_from_memory(&bytes(html, &format!("clean-{n}"))).unwrap().to_rgb8();
            let kinds: Vec<[u8; 3]> = covering.dirt.iter().map(|kind| kind.colour).collect();
            let [x0, y0] = place(&corridor.scene.meshes[n], baked.base_color.dimensions());
            let mut off = [0u64; 2];
            for (x, y, masks) in dirt.enumerate_pixels() {
                let densities = masks.0.map(|mask| -trodden::math::ln(1.0 - f64::from(mask).min(254.5) / 255.0));
                let layers: Vec<_> = densities.into_iter().zip(kinds.iter().copied()).collect();
                let shown = covered(under.get_pixel(x, y).0, &layers);
                let baked = baked.base_color.get_pixel(x + x0, y + y0).0;
                off[0] += shown.iter().zip(baked).map(|(&a, b)| u64::from(a.abs_diff(b))).sum::<u64>();
                off[1] += 3;
            }
            let mean = off[0] as f64 / off[1] as f64;
            assert!(mean < 1.0, "{name}, image {n}: off by {mean:.2} of 255 on average");
        }
    }
}

/// Where the page's part of an image starts: its texture coordinates less 8 px.
fn place(part: &Mesh, (width, height): (u32, u32)) -> [u32; 2] {
    let low = |axis: usize, side: u32| {
        let low = part.uvs.iter().map(|uv| uv[axis]).fold(1.0, f32::min);
        (low * side as f32 - 8.0).floor().max(0.0) as u32
    };
    [low(0, width), low(1, height)]
}

/// Without dirt the floor is plain again: what was a heel mark is not left behind.
#[test]
fn under_the_dirt_the_floor_is_clean() {
    for (name, corridor, html) in both() {
        let clean = corridor.clean[0];
        let under = image::load_from_memory(&bytes(html, "clean-0")).unwrap().to_rgb8();
        let off: Vec<u8> =
            under.pixels().map(|p| p.0.iter().zip(clean).map(|(&a, b)| a.abs_diff(b)).max().unwrap()).collect();
        let mean = off.iter().map(|&off| f64::from(off)).sum::<f64>() / off.len() as f64;
        let far = off.iter().filter(|&&off| off > 16).count() as f64 / off.len() as f64;
        assert!(mean < 2.5 && far < 0.004, "{name}: {mean:.2} on average, {:.2} % far off", 100.0 * far);
    }
}

/// Scuffs and prints are kinds of their own.
#[test]
fn heel_marks_are_told_from_prints() {
    let html = &*LIGHT_PAGE;
    let dirt = image::load_from_memory(&bytes(html, "dirt-0")).unwrap().to_rgba8();
    let strong: Vec<[u8; 4]> = dirt.pixels().map(|p| p.0).filter(|p| p[1].max(p[2]) > 80).collect();
    // Prints reach a density of 0.25, a mask of 56: what is stronger was left by a heel.
    assert!(strong.len() > 100, "{}", strong.len());
    assert!(strong.iter().filter(|p| p[2] > p[1]).count() * 100 > strong.len() * 90);
}

#[test]
fn damaged_scenes_and_images_leave_a_page() {
    let mut corridor = corridor::corridor(LIGHT);
    corridor.scene.meshes[0].positions_m[1][0] = f32::NAN;
    corridor.scene.meshes[1].uvs.clear();
    corridor.scene.meshes[3].indices[0] = u32::MAX;
    corridor.wall[0].dirt = image::RgbaImage::new(3, 3);
    let html = page_html(&corridor.page("Corridor"));
    let parts = data(&html)["parts"].as_array().unwrap().clone();
    assert_eq!(parts.len(), 1);
    assert!(parts[0]["image"].is_null());

    let nothing = Corridor { scene: Scene::default(), floor: vec![], wall: vec![], ..corridor };
    assert_eq!(data(&page_html(&nothing.page("")))["parts"].as_array().unwrap().len(), 0);
}

/// A floor or wall without dirt.
struct Clean([u8; 3]);

impl WallSource for Clean {
    fn layers(&self) -> &[&'static str] {
        &[]
    }

    fn background(&self) -> Background {
        Background { base_color: self.0, mask: [0; 4], orm: [255, 153, 0] }
    }

    fn resolve_into(&self, _: usize, _: i64, _: i64, _: usize, _: usize, block: &mut ResolvedBlock) {
        *block = ResolvedBlock { empty: true, ..ResolvedBlock::default() };
    }
}

impl TextureSource for Clean {
    fn layers(&self) -> &[&'static str] {
        &[]
    }

    fn background(&self) -> Background {
        Background { base_color: self.0, mask: [0; 4], orm: [255, 89, 0] }
    }

    fn resolve(&self, _: i64, _: i64, _: usize, _: usize) -> ResolvedBlock {
        ResolvedBlock { empty: true, ..ResolvedBlock::default() }
    }
}

/// The clean corridor as a still, from the page's first camera or from its first one above.
fn still(corridor: &Corridor, camera: &trodden::export::Camera) -> image::RgbImage {
    let [floor, wall] = corridor.clean.map(Clean);
    let walls = Some(WallSurfaces { source: &wall, texels_per_metre: 32.0, far: FarWalls::Plain });
    let surfaces = Surfaces { floor: &floor, floor_texels_per_metre: 32.0, small: None, walls };
    corridor.rooms.draw(camera, [480, 320], &[surfaces], &Silent).unwrap().remove(0)
}

/// Leaves pages for the browser, with what they have to show.
#[test]
fn pages_for_the_browser() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("page");
    std::fs::create_dir_all(&folder).unwrap();
    for (name, corridor, html) in both() {
        assert!(html.len() < 1 << 20, "{name}: {} bytes", html.len());
        std::fs::write(folder.join(format!("{name}.html")), html).unwrap();
        let page = corridor.page("Corridor");
        for (view, camera) in [("start", page.start), ("above", page.above)] {
            still(corridor, &camera).save(folder.join(format!("{name}-{view}.png"))).unwrap();
        }
        let image = &corridor.floor[0].base_color;
        // Places on the floor, the colour baked there, and how many pixels a metre has.
        let places: Vec<_> = (0..60)
            .map(|n| (10 + n * 37 % 230, 136 + n * 29 % 70))
            .map(|(x, y)| {
                let at = [(f64::from(x) + 0.5) / 32.0, 8.0 - (f64::from(y) + 0.5) / 32.0];
                serde_json::json!({ "at": at, "colour": image.get_pixel(x, y).0 })
            })
            .collect();
        let expected = serde_json::json!({ "clean": corridor.clean[0], "places": places });
        std::fs::write(folder.join(format!("{name}.json")), expected.to_string()).unwrap();
    }
}
