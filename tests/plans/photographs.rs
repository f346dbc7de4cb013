//! Scans with shadows and photographs of sheets: how much of the walls is read as wall.

use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, RgbImage};
use trodden::plan::{FloorPlan, PlanClass, PlanOptions, read};

use super::buildings::{Building, flat, office, school};
use super::canvas::{Canvas, Point, arc, lines, rectangle};
use super::styles::{Drawn, hand_drawing};

type Light = fn(f64, f64) -> f64;

/// Ways in which light falls on paper: share of the full light at a place, both coordinates from 0 to 1.
const LIGHTS: [(&str, Light); 4] = [
    ("even", |_, _| 1.0),
    ("slope", |x, y| 1.0 - 0.45 * (0.7 * x + 0.3 * y)),
    ("dark corner", |x, y| 1.0 - 0.6 * (x * x * y).min(1.0)),
    ("shadow of a hand", |x, y| {
        let depth = ((0.3 - x).max(0.0) + (y - 0.6).max(0.0)) * 4.0;
        1.0 - 0.5 * depth.clamp(0.0, 1.0)
    }),
];

/// Where a photograph shows the sheet's corners, clockwise from the upper left, as shares of its sides.
const VIEWS: [[[f64; 2]; 4]; 3] = [
    [[0.10, 0.14], [0.91, 0.08], [0.95, 0.90], [0.06, 0.86]],
    [[0.16, 0.12], [0.86, 0.16], [0.96, 0.93], [0.05, 0.88]],
    [[0.05, 0.20], [0.90, 0.05], [0.96, 0.80], [0.09, 0.95]],
];

struct Noise(u64);

impl Noise {
    /// About normal, with a standard deviation of 1.
    fn draw(&mut self) -> f64 {
        (0..4)
            .map(|_| {
                self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (self.0 >> 40) as f64 / (1u64 << 24) as f64 - 0.5
            })
            .sum::<f64>()
            * 1.73
    }
}

/// The drawing on paper under a light: pencil rather than ink.
fn paper(drawn: &Drawn, light: Light, [u, v]: [f64; 2]) -> [f64; 3] {
    let image = drawn.image.as_rgb8().unwrap();
    let place = |t: f64, end: u32| (t * f64::from(end) - 0.5).clamp(0.0, f64::from(end - 1));
    let (x, y) = (place(u, image.width()), place(v, image.height()));
    let (left, top) = (x.floor(), y.floor());
    let tone = |dx: u32, dy: u32| {
        let at = |k: f64, d: u32, end: u32| (k as u32 + d).min(end - 1);
        f64::from(image.get_pixel(at(left, dx, image.width()), at(top, dy, image.height()))[0]) / 255.0
    };
    let (s, t) = (x - left, y - top);
    let ink = (tone(0, 0) * (1.0 - s) + tone(1, 0) * s) * (1.0 - t) + (tone(0, 1) * (1.0 - s) + tone(1, 1) * s) * t;
    [238.0, 234.0, 224.0].map(|paper| paper * light(u, v) * (0.28 + 0.72 * ink))
}

/// A photograph of the office, as a JPEG file: askew, under the shadow of a hand.
pub fn sketch() -> Vec<u8> {
    let drawn = hand_drawing(office);
    jpeg(1800, 1300, |u, v| photographed(&drawn, LIGHTS[3].1, VIEWS[1], [u, v]))
}

fn jpeg(width: u32, height: u32, colour: impl Fn(f64, f64) -> [f64; 3]) -> Vec<u8> {
    let mut noise = Noise(7);
    let image = RgbImage::from_fn(width, height, |x, y| {
        let colour = colour((f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height));
        image::Rgb(colour.map(|v| (v + 3.0 * noise.draw()).round().clamp(0.0, 255.0) as u8))
    });
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 82).encode_image(&DynamicImage::ImageRgb8(image)).unwrap();
    bytes
}

fn saved(name: &str, width: u32, height: u32, colour: impl Fn(f64, f64) -> [f64; 3]) -> (tempfile::TempDir, FloorPlan) {
    let bytes = jpeg(width, height, colour);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plan.jpg");
    std::fs::write(&path, &bytes).unwrap();
    if let Ok(out) = std::env::var("PLANS_OUT") {
        std::fs::write(format!("{out}/{name}.jpg"), &bytes).unwrap();
    }
    let plan = read(&path, &PlanOptions::default()).unwrap();
    (folder, plan)
}

/// Share of the walls and of what was read as wall that both agree on; `rim` of the sheet was cut off.
fn agreement(plan: &FloorPlan, drawn: &Drawn, rim: f64) -> f64 {
    let (width, height) = (drawn.image.width() as usize, drawn.image.height() as usize);
    let (mut both, mut either) = (0usize, 0usize);
    for y in 0..plan.height_px {
        for x in 0..plan.width_px {
            let place = |k: u32, end: u32| rim + (1.0 - 2.0 * rim) * (f64::from(k) + 0.5) / f64::from(end);
            let (u, v) = (place(x, plan.width_px), place(y, plan.height_px));
            let at = (v * height as f64) as usize * width + (u * width as f64) as usize;
            let read = plan.classes[y as usize * plan.width_px as usize + x as usize] == PlanClass::Wall;
            let (wall, other) = (drawn.truth.wall[at] != 0, drawn.truth.window[at] != 0 || drawn.truth.notes[at] != 0);
            both += usize::from(read && wall);
            either += usize::from((read && !other) || wall);
        }
    }
    both as f64 / either as f64
}

const BUILDINGS: [fn() -> Building; 3] = [office, flat, school];

#[test]
fn walls_of_scans_with_shadows_are_read() {
    for building in BUILDINGS {
        let drawn = hand_drawing(building);
        let name = building().name;
        for (kind, light) in LIGHTS {
            let (width, height) = (drawn.image.width(), drawn.image.height());
            let (_folder, plan) =
                saved(&format!("scan-{name}-{kind}"), width, height, |u, v| paper(&drawn, light, [u, v]));
            let agreed = agreement(&plan, &drawn, 0.0);
            println!("scan {name} {kind}: {agreed:.3}");
            assert!(agreed >= 0.85, "{name}, {kind}: {agreed:.3}");
            assert_eq!(plan.warnings.iter().any(|w| w.contains("uneven")), kind != "even", "{name}, {kind}");
        }
    }
}

/// The inverse of a map of the unit square to a quadrilateral.
fn within(corners: [[f64; 2]; 4], p: [f64; 2]) -> Option<[f64; 2]> {
    // Newton's method on the projective map is exact enough for drawing.
    let [a, b, c, d] = corners;
    let sum = [0, 1].map(|k| a[k] - b[k] + c[k] - d[k]);
    let (d1, d2) = ([b[0] - c[0], b[1] - c[1]], [d[0] - c[0], d[1] - c[1]]);
    let turn = d1[0] * d2[1] - d1[1] * d2[0];
    let g = (sum[0] * d2[1] - sum[1] * d2[0]) / turn;
    let h = (d1[0] * sum[1] - d1[1] * sum[0]) / turn;
    let row = |k: usize| [b[k] - a[k] + g * b[k], d[k] - a[k] + h * d[k], a[k]];
    let (x, y) = (row(0), row(1));
    // x (g u + h v + 1) = x0 u + x1 v + x2, and the same for y: two equations in u and v.
    let (m, n) = ([x[0] - p[0] * g, x[1] - p[0] * h], [y[0] - p[1] * g, y[1] - p[1] * h]);
    let (r, s) = (p[0] - x[2], p[1] - y[2]);
    let det = m[0] * n[1] - m[1] * n[0];
    let uv = [(r * n[1] - m[1] * s) / det, (m[0] * s - r * n[0]) / det];
    uv.iter().all(|t| (0.0..=1.0).contains(t)).then_some(uv)
}

/// A sheet on a wooden desk. The view is that of a camera only in part, so that the aspect ratio is not the true one.
fn photographed(drawn: &Drawn, light: Light, view: [[f64; 2]; 4], [u, v]: [f64; 2]) -> [f64; 3] {
    match within(view, [u, v]) {
        Some(place) => paper(drawn, light, place).map(|tone| tone * (0.8 + 0.2 * light(u, v))),
        None => {
            let grain = (v * 90.0 + (u * 7.0).sin() * 2.0).sin() * 9.0;
            [112.0 + grain, 82.0 + grain * 0.8, 58.0 + grain * 0.6].map(|tone| tone * light(u, v))
        }
    }
}

#[test]
fn sheets_in_photographs_are_straightened() {
    // As in `plan/sheet.rs`.
    const RIM: f64 = 0.006;
    for building in BUILDINGS {
        let drawn = hand_drawing(building);
        let name = building().name;
        for (number, view) in VIEWS.into_iter().enumerate() {
            // The hand's shadow with one view of each building is enough.
            let lights = if number == 2 { vec![LIGHTS[2], LIGHTS[3]] } else { vec![LIGHTS[number]] };
            for (kind, light) in lights {
                let case = format!("photograph-{name}-{number}-{kind}");
                let (_folder, plan) = saved(&case, 1800, 1300, |u, v| photographed(&drawn, light, view, [u, v]));
                assert!(plan.warnings.iter().any(|w| w.contains("sheet of paper")), "{case}: {:?}", plan.warnings);
                let agreed = agreement(&plan, &drawn, RIM);
                println!("{case}: {agreed:.3}");
                assert!(agreed >= 0.85, "{case}: {agreed:.3}");
            }
        }
    }
}

/// Blue lines of an exercise book, forty squares across, and the red one at its margin.
fn squared(drawn: &Drawn, light: Light, [u, v]: [f64; 2]) -> [f64; 3] {
    const SQUARES: f64 = 40.0;
    let image = drawn.image.as_rgb8().unwrap();
    let [width, height] = [image.width(), image.height()].map(f64::from);
    let side = width / SQUARES;
    let is_line = |px: f64| (px / side + 0.5).fract() * side < 3.0;
    let blue = if is_line(u * width) || is_line(v * height) { [0.58, 0.68, 0.80] } else { [1.0; 3] };
    let red = if (u - 0.955).abs() * width < 1.5 { [0.9, 0.6, 0.6] } else { [1.0; 3] };
    let paper = paper(drawn, light, [u, v]);
    std::array::from_fn(|c| paper[c] * blue[c] * red[c])
}

#[test]
fn squares_of_an_exercise_book_are_no_strokes() {
    for building in BUILDINGS {
        let drawn = hand_drawing(building);
        let name = building().name;
        let (width, height) = (drawn.image.width(), drawn.image.height());
        let (_folder, plan) =
            saved(&format!("squared-{name}"), width, height, |u, v| squared(&drawn, LIGHTS[1].1, [u, v]));
        let agreed = agreement(&plan, &drawn, 0.0);
        println!("squared {name}: {agreed:.3}");
        assert!(agreed >= 0.85, "{name}: {agreed:.3}");
    }
}

/// Three rooms and a corridor in a pencil's double lines, which sway and miss each other at corners and jambs.
#[test]
fn outlines_that_miss_each_other_are_walls() {
    const PX_PER_M: f64 = 80.0;
    let mut canvas = Canvas::new([13.0, 10.0], [-1.5, -1.5], PX_PER_M, 0.0, [236, 233, 224]);
    let mut noise = Noise(3);
    let mut stroke = |canvas: &mut Canvas, a: Point, b: Point| {
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = way[0].hypot(way[1]);
        // It ends some centimetres early or late, and sways by one.
        let ends = [noise.draw(), noise.draw()].map(|by| (0.05 * by).clamp(-0.07, 0.07));
        let sways = [noise.draw(), noise.draw()].map(|by| 0.012 * by);
        let point = |t: f64| {
            let along = ends[0] + t * (length - ends[0] + ends[1]);
            let aside = sways[0] * (t * 6.0).sin() + sways[1] * (t * 11.0).sin();
            [a[0] + (way[0] * along - way[1] * aside) / length, a[1] + (way[1] * along + way[0] * aside) / length]
        };
        let points: Vec<Point> = (0..=40).map(|k| point(f64::from(k) / 40.0)).collect();
        canvas.fill(&lines(&points, 0.03), [96; 3]);
    };
    // Walls as boxes between doors: four strokes each.
    let walls = [
        [[0.0, 0.0], [10.0, 0.25]],
        [[0.0, 6.75], [4.0, 7.0]],
        [[4.9, 6.75], [10.0, 7.0]],
        [[0.0, 0.25], [0.25, 6.75]],
        [[9.75, 0.25], [10.0, 6.75]],
        [[0.25, 4.5], [1.5, 4.62]],
        [[2.4, 4.5], [5.6, 4.62]],
        [[6.5, 4.5], [9.75, 4.62]],
        [[4.4, 0.25], [4.52, 4.5]],
    ];
    for [min, max] in walls {
        let corners = rectangle(min, max);
        (0..4).for_each(|k| stroke(&mut canvas, corners[k], corners[(k + 1) % 4]));
    }
    for (hinge, closed, open) in [([4.0, 6.75], 0.0, -0.5), ([1.5, 4.5], 0.0, -0.5), ([6.5, 4.5], 1.0, 1.5)] {
        let [closed, open] = [closed, open].map(|turn: f64| turn * std::f64::consts::PI);
        let tip = [hinge[0] + 0.9 * open.cos(), hinge[1] + 0.9 * open.sin()];
        stroke(&mut canvas, hinge, tip);
        canvas.fill(&lines(&arc(hinge, 0.9, closed, open), 0.025), [110; 3]);
    }
    let colour = |u: f64, v: f64| {
        let at = (v * canvas.height as f64) as usize * canvas.width + (u * canvas.width as f64) as usize;
        canvas.pixels[at].map(f64::from)
    };
    let (_folder, plan) = saved("missed", canvas.width as u32, canvas.height as u32, colour);
    let scale = plan.metres_per_pixel * PX_PER_M;
    assert!((0.85..1.15).contains(&scale), "the scale is {scale} times the true one");
    assert_eq!(plan.doors.len(), 3, "doors");
    for room in [[[0.6, 0.6], [4.0, 3.4]], [[4.9, 0.6], [9.4, 3.4]], [[0.6, 5.0], [9.4, 5.8]]] {
        let floor = canvas.floor_in(&plan, room);
        assert!(floor > 0.95, "{floor} of the room at {room:?} is floor");
    }
    let wall = canvas.floor_in(&plan, [[0.3, 0.05], [9.7, 0.2]]);
    assert!(wall < 0.1, "{wall} of the northern wall is floor");
}
