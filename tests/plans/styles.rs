//! The ways in which people draw a plan, and what is truly on each drawing.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, ImageFormat, RgbImage, Rgba, RgbaImage};

use super::buildings::{Building, Hole, HoleKind, Kind, Piece, Wall, flat, inn, office, school};
use super::canvas::{Canvas, Point, Polygon, ellipse, line, outline, rectangle, text};
use super::notes::{joints, sheet};
use super::openings::{door, sliding, window};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walls {
    Solid,
    Outline,
    Hatched,
    /// Outlines around a fill of light grey.
    Poche,
    /// Outlines; thick walls hold the zigzag of an insulation.
    Insulated,
    OnePixel,
    /// Solid outer walls; lines of two pixels between rooms.
    LinesWithin,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doors {
    Open,
    LeafAndArc,
    ClosedLine,
    /// Leaf, arc, and lines along both faces of the wall.
    LeafAndSill,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tones {
    Black,
    Layers,
    /// The same as on a screen: white walls on black.
    LayersOnBlack,
    Brochure,
    Grey,
    Dark,
    Map,
    NegatedMap,
    /// Walls, words and lines in one dark blue.
    Navy,
    /// All in one mid grey.
    Pencil,
}

/// What ends dimension lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    Slanted,
    Arrows,
    Dots,
    /// No dimensions at all, only axes.
    None,
}

/// What is drawn on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cover {
    None,
    /// Square tiles.
    Tiles,
    /// Planks that end anywhere.
    Planks,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum File {
    Png,
    Transparent,
    Jpeg,
}

/// A way to draw a plan.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    pub name: &'static str,
    pub walls: Walls,
    pub doors: Doors,
    pub tones: Tones,
    pub file: File,
    /// Room names and areas, dimensions, axes, north arrow, title block, sheet frame.
    pub sheet: bool,
    pub ends: Ends,
    /// Room names and areas.
    pub names: bool,
    /// Whether the printed areas are wrong, each in its own way.
    pub wrong_areas: bool,
    pub furniture: bool,
    pub cover: Cover,
    /// Turn of the drawing, degrees.
    pub turn_deg: f64,
    /// Share of the wall that a scanner missed.
    pub noise: f64,
    pub px_per_m: f64,
    /// Whether the drawing is sharp, so that nothing of it may be misread.
    pub clean: bool,
}

const CAD: Style = Style {
    name: "CAD export",
    walls: Walls::Solid,
    doors: Doors::LeafAndArc,
    tones: Tones::Black,
    file: File::Png,
    sheet: true,
    ends: Ends::Slanted,
    names: true,
    wrong_areas: false,
    furniture: true,
    cover: Cover::None,
    turn_deg: 0.0,
    noise: 0.0,
    px_per_m: 50.0,
    clean: true,
};

/// Walls, windows and doors alone.
const PLAIN: Style = Style { name: "plain", doors: Doors::Open, sheet: false, names: false, furniture: false, ..CAD };

/// Outline walls in the colours of a screen.
pub const LAYERED_OUTLINES: &str = "outlines in colours on black";

/// All styles.
pub const STYLES: [Style; 33] = [
    PLAIN,
    CAD,
    Style { name: "outline walls", walls: Walls::Outline, ..CAD },
    Style { name: "hatched walls", walls: Walls::Hatched, ..CAD },
    Style { name: "walls of one pixel", walls: Walls::OnePixel, ..CAD },
    Style { name: "walls of one pixel, arrows", walls: Walls::OnePixel, ends: Ends::Arrows, ..CAD },
    Style { name: "walls of one pixel, dots", walls: Walls::OnePixel, ends: Ends::Dots, ..CAD },
    Style { name: "walls of one pixel, axes alone", walls: Walls::OnePixel, ends: Ends::None, ..CAD },
    Style { name: "30 px/m", px_per_m: 30.0, ..CAD },
    Style { name: "118 px/m", px_per_m: 118.0, ..CAD },
    Style { name: "transparent", file: File::Transparent, ..CAD },
    Style { name: "layer colours", tones: Tones::Layers, ..CAD },
    Style { name: LAYERED_OUTLINES, walls: Walls::Outline, tones: Tones::LayersOnBlack, px_per_m: 42.0, ..CAD },
    Style { name: "JPEG", file: File::Jpeg, px_per_m: 0.0, clean: false, ..CAD },
    Style { name: "doors closed by a line", doors: Doors::ClosedLine, sheet: false, ..CAD },
    Style { name: "doors with leaf and arc", doors: Doors::LeafAndArc, ..PLAIN },
    Style { name: "doors with leaf and sill", doors: Doors::LeafAndSill, sheet: false, ..CAD },
    Style { name: "brochure", tones: Tones::Brochure, sheet: false, ..CAD },
    Style { name: "grey walls", tones: Tones::Grey, sheet: false, ..CAD },
    Style { name: "dark background", tones: Tones::Dark, sheet: false, ..CAD },
    Style { name: "robot's map", tones: Tones::Map, px_per_m: 20.0, clean: false, ..PLAIN },
    Style { name: "negated map", tones: Tones::NegatedMap, px_per_m: 20.0, clean: false, ..PLAIN },
    Style {
        name: "noisy map turned 7 degrees",
        tones: Tones::Map,
        px_per_m: 20.0,
        turn_deg: 7.0,
        noise: 0.04,
        clean: false,
        ..PLAIN
    },
    Style { name: "CAD without furniture", furniture: false, ..CAD },
    Style { name: "tiles", cover: Cover::Tiles, ..CAD },
    Style { name: "planks", cover: Cover::Planks, sheet: false, tones: Tones::Brochure, ..CAD },
    Style { name: "tiles, 30 px/m", cover: Cover::Tiles, px_per_m: 30.0, ..CAD },
    Style { name: "partitions as lines", walls: Walls::LinesWithin, sheet: false, ..CAD },
    Style { name: "dark blue walls", tones: Tones::Navy, ..CAD },
    Style { name: "light poche", walls: Walls::Poche, ..CAD },
    Style { name: "insulation", walls: Walls::Insulated, ..CAD },
    Style { name: "grey outlines", walls: Walls::Outline, tones: Tones::Pencil, ..CAD },
    Style { name: "turned 24 degrees", turn_deg: 24.0, sheet: false, px_per_m: 43.0, ..CAD },
];

pub fn named(name: &str) -> Style {
    STYLES.into_iter().find(|style| style.name == name).unwrap()
}

/// A plan to be read: a style, a building and a seed of noise.
#[derive(Clone, Copy)]
pub struct Case {
    pub style: Style,
    pub building: fn() -> Building,
    pub seed: u64,
}

/// All styles of each building; robots' maps with two seeds.
pub fn cases() -> Vec<Case> {
    let buildings: [fn() -> Building; 4] = [office, flat, school, inn];
    let mut all = Vec::new();
    for building in buildings {
        for style in STYLES {
            for seed in 0..if style.noise > 0.0 { 2 } else { 1 } {
                all.push(Case { style, building, seed });
            }
        }
    }
    all
}

/// A door as drawn: the ends of its jambs, pixels from the top left.
#[derive(Clone, Copy, Debug)]
pub struct TrueDoor {
    pub from: Point,
    pub to: Point,
}

/// What is on a drawing, one byte per pixel.
pub struct Truth {
    pub metres_per_pixel: f64,
    pub wall: Vec<u8>,
    pub window: Vec<u8>,
    /// Floor inside the building, below furniture and in doors too.
    pub floor: Vec<u8>,
    /// Number of the room from 1 on.
    pub rooms: Vec<u8>,
    pub room_names: Vec<&'static str>,
    pub doors: Vec<TrueDoor>,
    pub furniture: Vec<u8>,
    /// Letters, dimensions, frames.
    pub notes: Vec<u8>,
}

pub struct Drawn {
    pub image: DynamicImage,
    /// The YAML of a robot's map.
    pub yaml: Option<String>,
    pub truth: Truth,
    file: File,
}

impl Drawn {
    /// Writes the plan into a folder. Returns the path to read.
    pub fn save(&self, folder: &Path) -> PathBuf {
        let path = folder.join(if self.file == File::Jpeg { "plan.jpg" } else { "plan.png" });
        if self.file == File::Jpeg {
            let mut bytes = Cursor::new(Vec::new());
            JpegEncoder::new_with_quality(&mut bytes, 75).encode_image(&self.image).unwrap();
            std::fs::write(&path, bytes.into_inner()).unwrap();
        } else {
            self.image.save_with_format(&path, ImageFormat::Png).unwrap();
        }
        match &self.yaml {
            Some(yaml) => {
                std::fs::write(folder.join("plan.yaml"), yaml).unwrap();
                folder.join("plan.yaml")
            }
            None => path,
        }
    }
}

/// The drawing that a photograph or a scan starts from: thick lines, room names, without a sheet.
pub fn hand_drawing(building: fn() -> Building) -> Drawn {
    draw(&Case { style: Style { names: true, ..PLAIN }, building, seed: 0 })
}

/// Colours of the parts of a drawing.
struct Palette {
    paper: [u8; 3],
    wall: [u8; 3],
    window: [u8; 3],
    door: [u8; 3],
    furniture: [u8; 3],
    words: [u8; 3],
    notes: [u8; 3],
}

fn palette(tones: Tones) -> Palette {
    let all = |paper, ink| Palette { paper, wall: ink, window: ink, door: ink, furniture: ink, words: ink, notes: ink };
    match tones {
        Tones::Black => all([255; 3], [0; 3]),
        Tones::Grey => Palette { words: [0x70; 3], ..all([255; 3], [0xa0; 3]) },
        Tones::Dark => all([0x1e, 0x21, 0x28], [235; 3]),
        Tones::Navy => Palette { furniture: [60, 84, 150], ..all([255; 3], [16, 32, 96]) },
        Tones::Pencil => all([255; 3], [0x88; 3]),
        Tones::Map => all([205; 3], [0; 3]),
        Tones::NegatedMap => all([50; 3], [255; 3]),
        Tones::Layers => Palette {
            window: [0, 255, 255],
            door: [0, 170, 0],
            furniture: [200, 0, 200],
            words: [220, 0, 0],
            notes: [0, 90, 220],
            ..all([255; 3], [0; 3])
        },
        Tones::LayersOnBlack => Palette {
            window: [0, 255, 255],
            door: [255, 255, 0],
            furniture: [0, 160, 0],
            words: [255, 0, 255],
            notes: [255, 40, 40],
            ..all([0; 3], [255; 3])
        },
        Tones::Brochure => Palette {
            wall: [0x38; 3],
            window: [0x60; 3],
            door: [0x50; 3],
            furniture: [0x40; 3],
            words: [0x30; 3],
            ..all([255; 3], [0x38; 3])
        },
    }
}

/// Draws a case.
pub fn draw(case: &Case) -> Drawn {
    let (style, mut building) = (case.style, (case.building)());
    if style.walls == Walls::LinesWithin {
        building.walls.iter_mut().filter(|wall| !wall.outer).for_each(|wall| wall.thick = 2.0 / style.px_per_m);
    }
    let [w, h] = building.size;
    let turn = style.turn_deg.to_radians();
    // A turned drawing needs more paper; scanned maps end where the scanner saw no more.
    let turned = if style.noise > 0.0 { 0.0 } else { turn.sin() * w.max(h) * 0.5 };
    let margin = if style.sheet { [4.5, 4.5, 4.5, 5.5] } else { [1.2 + turned; 4] };
    let size = [w + margin[0] + margin[2], h + margin[1] + margin[3]];
    let px_per_m = if style.px_per_m > 0.0 { style.px_per_m } else { 800.0 / size[0] };
    let tones = palette(style.tones);
    let mut canvas = Canvas::new(size, [-margin[0], -margin[1]], px_per_m, turn, tones.paper);
    let thin = (0.02f64).max(1.0 / px_per_m);
    let mut truth = truth(&canvas, &building, &style);
    let interior: Vec<Polygon> = parts(&building);
    match style.tones {
        Tones::Map => canvas.fill(&[interior, building.hole_polygons(true)].concat(), [254; 3]),
        Tones::NegatedMap => canvas.fill(&[interior, building.hole_polygons(true)].concat(), [1; 3]),
        Tones::Brochure => {
            let colours = [[247, 233, 206], [222, 236, 246], [230, 242, 218], [250, 224, 220], [238, 228, 246]];
            canvas.fill(&building.hole_polygons(true), [235, 232, 226]);
            for (k, room) in building.rooms.iter().enumerate() {
                let parts: Vec<Polygon> =
                    room.parts.iter().map(|&[x0, y0, x1, y1]| rectangle([x0, y0], [x1, y1])).collect();
                canvas.fill(&parts, colours[k % colours.len()]);
            }
        }
        _ => {}
    }
    for room in building.rooms.iter().filter(|_| style.cover != Cover::None) {
        let corner = [0, 1].map(|k| room.parts.iter().map(|part| part[k]).fold(f64::INFINITY, f64::min));
        let joints: Vec<Polygon> =
            room.parts.iter().flat_map(|&part| joints(corner, part, style.cover, thin)).collect();
        canvas.fill(&joints, tones.words);
    }
    if style.furniture {
        for piece in &building.furniture {
            let (shape, strokes) = symbol(piece, thin);
            if style.tones == Tones::Brochure {
                canvas.fill(&[shape], [232, 214, 184]);
            } else if style.cover != Cover::None {
                canvas.fill(&[shape], tones.paper);
            }
            canvas.fill(&strokes, tones.furniture);
        }
    }
    if style.sheet || style.names {
        let words = words(&building, &truth, style.wrong_areas, thin);
        add(&mut truth.notes, &canvas.mask(&words));
        canvas.fill(&words, tones.words);
    }
    if style.sheet {
        let notes =
            sheet(&building, style.ends, size, [-margin[0], -margin[1]], thin, style.tones == Tones::LayersOnBlack);
        add(&mut truth.notes, &canvas.mask(&notes));
        canvas.fill(&notes, tones.notes);
    }
    draw_walls(&mut canvas, &building, &style, tones.wall, tones.paper, thin);
    for (wall, hole) in building.holes() {
        match hole.kind {
            HoleKind::Window if style.walls == Walls::OnePixel => {
                canvas.fill(&window(wall, hole, 0.12, thin), tones.window)
            }
            HoleKind::Window => canvas.fill(&window(wall, hole, wall.thick, thin), tones.window),
            HoleKind::Entrance(leaves) => {
                let (bars, lines) = sliding(wall, hole, leaves, thin);
                canvas.fill(&lines, tones.door);
                canvas.fill(&bars, tones.wall);
            }
            HoleKind::Door { hinge_first, left } => {
                canvas.fill(&door(wall, hole, hinge_first, left, style.doors, thin), tones.door);
            }
        }
    }
    if style.noise > 0.0 {
        scan(&mut canvas, style.noise, case.seed);
    }
    let rgb: Vec<u8> = canvas.pixels.iter().flatten().map(|v| v.round() as u8).collect();
    let rgb = RgbImage::from_vec(canvas.width as u32, canvas.height as u32, rgb).unwrap();
    let image = match style.file {
        File::Transparent => {
            let alpha = |x: u32, y: u32| Rgba([0, 0, 0, 255 - rgb.get_pixel(x, y)[0]]);
            DynamicImage::ImageRgba8(RgbaImage::from_fn(rgb.width(), rgb.height(), alpha))
        }
        _ if matches!(style.tones, Tones::Map | Tones::NegatedMap) => DynamicImage::ImageRgb8(rgb).into_luma8().into(),
        _ => DynamicImage::ImageRgb8(rgb),
    };
    let yaml = matches!(style.tones, Tones::Map | Tones::NegatedMap).then(|| {
        format!(
            "image: plan.png\nresolution: {}\norigin: [0, 0, 0]\nnegate: {}\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
            1.0 / px_per_m,
            u8::from(style.tones == Tones::NegatedMap)
        )
    });
    Drawn { image, yaml, truth, file: style.file }
}

fn add(mask: &mut [u8], other: &[u8]) {
    mask.iter_mut().zip(other).for_each(|(m, &o)| *m |= o);
}

fn parts(building: &Building) -> Vec<Polygon> {
    let part = |&[x0, y0, x1, y1]: &[f64; 4]| rectangle([x0, y0], [x1, y1]);
    building.rooms.iter().flat_map(|room| room.parts.iter().map(part)).collect()
}

fn centre_lines(building: &Building, thick: f64) -> Vec<Polygon> {
    let stretches = |wall: &Wall| -> Vec<Polygon> {
        let within = |[from, to]: [f64; 2]| [from.max(0.0), to.min(wall.length())];
        let ends = |[from, to]: [f64; 2]| line(wall.place(from, 0.0), wall.place(to, 0.0), thick);
        wall.solid().into_iter().map(within).map(ends).collect()
    };
    building.walls.iter().flat_map(stretches).collect()
}

fn truth(canvas: &Canvas, building: &Building, style: &Style) -> Truth {
    let wall = match style.walls {
        Walls::OnePixel => canvas.mask(&centre_lines(building, 1.0 / canvas.px_per_m)),
        _ => canvas.mask(&building.solid(0.0)),
    };
    let window = canvas.mask(&building.hole_polygons(false));
    let doors = canvas.mask(&building.hole_polygons(true));
    let mut rooms = vec![0u8; wall.len()];
    for (k, room) in (1..).zip(&building.rooms) {
        let parts: Vec<Polygon> = room.parts.iter().map(|&[x0, y0, x1, y1]| rectangle([x0, y0], [x1, y1])).collect();
        let mask = canvas.mask(&parts);
        for (at, number) in rooms.iter_mut().enumerate() {
            if mask[at] != 0 && wall[at] == 0 && window[at] == 0 && (doors[at] == 0 || style.walls == Walls::OnePixel) {
                *number = k;
            }
        }
    }
    let is_floor = |at: usize| u8::from(rooms[at] != 0 || doors[at] != 0);
    let floor = (0..wall.len()).map(is_floor).collect();
    let shapes: Vec<Polygon> = building.furniture.iter().map(|piece| symbol(piece, 0.02).0).collect();
    let furniture = if style.furniture { canvas.mask(&shapes) } else { vec![0; wall.len()] };
    let ends = |(wall, hole): (&Wall, &Hole)| TrueDoor {
        from: canvas.px(wall.place(hole.at, 0.0)),
        to: canvas.px(wall.place(hole.at + hole.width, 0.0)),
    };
    Truth {
        metres_per_pixel: 1.0 / canvas.px_per_m,
        notes: vec![0; wall.len()],
        wall,
        window,
        floor,
        rooms,
        room_names: building.rooms.iter().map(|room| room.name).collect(),
        doors: building.holes().filter(|(_, hole)| hole.kind != HoleKind::Window).map(ends).collect(),
        furniture,
    }
}

fn draw_walls(canvas: &mut Canvas, building: &Building, style: &Style, ink: [u8; 3], paper: [u8; 3], thin: f64) {
    match style.walls {
        Walls::Solid | Walls::LinesWithin => canvas.fill(&building.solid(0.0), ink),
        Walls::OnePixel => canvas.fill(&centre_lines(building, 1.0 / canvas.px_per_m), ink),
        Walls::Outline | Walls::Hatched | Walls::Poche | Walls::Insulated => {
            canvas.fill(&building.solid(0.0), ink);
            let within = canvas.samples(&building.solid(-thin));
            canvas.paint(&within, if style.walls == Walls::Poche { [0xd2; 3] } else { paper });
            if style.walls == Walls::Insulated {
                let waves = |wall: &Wall| -> Vec<Polygon> {
                    let zig = |[from, to]: [f64; 2]| -> Vec<Polygon> {
                        let step = wall.thick * 0.5;
                        let count = ((to - from) / step) as i32;
                        let place = |k: i32| {
                            let left = (wall.thick * 0.5 - thin) * if k % 2 == 0 { 1.0 } else { -1.0 };
                            wall.place(from + f64::from(k) * step, left)
                        };
                        (0..count).map(|k| line(place(k), place(k + 1), thin * 0.7)).collect()
                    };
                    wall.solid().into_iter().flat_map(zig).collect()
                };
                let thick = building.walls.iter().filter(|wall| wall.thick >= 0.2);
                let all: Vec<Polygon> = thick.flat_map(waves).collect();
                let waves = canvas.samples(&all);
                let both = within.iter().zip(&waves).map(|(a, b)| a & b).collect();
                canvas.paint(&both, ink);
            }
            if style.walls == Walls::Hatched {
                let [w, h] = building.size;
                let every = 0.12;
                let count = ((w + h + 2.0) / every) as i32;
                let hatch: Vec<Polygon> = (0..count)
                    .map(|k| {
                        let x = f64::from(k) * every - 1.0;
                        line([x, -1.0], [x - h - 2.0, h + 1.0], thin * 0.7)
                    })
                    .collect();
                let hatch = canvas.samples(&hatch);
                let both = within.iter().zip(&hatch).map(|(a, b)| a & b).collect();
                canvas.paint(&both, ink);
            }
        }
    }
}

/// The shape of a piece of furniture, and its strokes.
fn symbol(piece: &Piece, thin: f64) -> (Polygon, Vec<Polygon>) {
    let [x0, y0] = piece.min;
    let [x1, y1] = piece.max;
    let (middle, half) = ([(x0 + x1) * 0.5, (y0 + y1) * 0.5], [(x1 - x0) * 0.5, (y1 - y0) * 0.5]);
    let shape = if piece.round { ellipse(middle, half) } else { rectangle(piece.min, piece.max) };
    let mut strokes = outline(&shape, thin);
    match piece.kind {
        Kind::Seat => strokes.push(line([x0, y0 + 0.08], [x1, y0 + 0.08], thin)),
        Kind::Shelf => strokes.push(line(piece.min, piece.max, thin)),
        Kind::Bed => {
            strokes.extend(outline(&rectangle([x0 + 0.1, y0 + 0.1], [x0 + 0.45, y1 - 0.1]), thin));
            strokes.push(line([x0 + 0.7, y0], [x0 + 0.7, y1], thin));
        }
        Kind::Wc | Kind::Basin => strokes.extend(outline(&ellipse(middle, half.map(|v| v * 0.6)), thin)),
        Kind::Table | Kind::Counter => {}
    }
    (shape, strokes)
}

/// Room names, and areas from wall to wall.
fn words(building: &Building, truth: &Truth, wrong: bool, thin: f64) -> Vec<Polygon> {
    let mut all = Vec::new();
    for (k, room) in building.rooms.iter().enumerate() {
        let pixels = truth.rooms.iter().filter(|&&number| usize::from(number) == k + 1).count() as f64;
        let share = if wrong { 0.45 + 0.35 * (k * 5 % 7) as f64 } else { 1.0 };
        let area = share * pixels * truth.metres_per_pixel * truth.metres_per_pixel;
        let [x, y] = room.label;
        let small = room.parts[0][3] - room.parts[0][1] < 2.1;
        let size = if small { 0.22 } else { 0.3 };
        all.extend(text(room.name, [x, y - size * 0.8], size, thin));
        all.extend(text(&format!("{area:.1} m2"), [x, y + size * 0.8], size * 0.85, thin));
    }
    all
}

/// Noise of a scanner: walls with holes and fringes, specks on the floor.
fn scan(canvas: &mut Canvas, share: f64, seed: u64) {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x1234_5678_9abc_def1);
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (width, height) = (canvas.width, canvas.height);
    let before = canvas.pixels.clone();
    let value = |tone: f32| {
        if tone < 128.0 {
            0.0
        } else if tone < 230.0 {
            205.0
        } else {
            254.0
        }
    };
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let at = y * width + x;
            let near = [at - 1, at + 1, at - width, at + width];
            let wall = value(before[at][0]) == 0.0;
            let beside = near.iter().any(|&n| value(before[n][0]) == 0.0);
            let draw = random();
            let tone = match value(before[at][0]) {
                _ if wall && draw < share => 205.0,
                tone if !wall && beside && draw < share * 2.0 => {
                    if draw < share {
                        0.0
                    } else {
                        tone
                    }
                }
                254.0 if draw < share * 0.02 => 0.0,
                tone => tone,
            };
            canvas.pixels[at] = [tone; 3];
        }
    }
}
