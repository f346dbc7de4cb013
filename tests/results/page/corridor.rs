//! A corridor with a room, drawn by rule: what a page shows without a bake.

use image::{Rgb, RgbImage, Rgba, RgbaImage};
use trodden::export::{Camera, Reduced};
use trodden::look::Srgb8;
use trodden::math::{self, SplitMix64, Vec2, vec2};
use trodden::plan::FloorPlan;
use trodden::show::Rooms;
use trodden::show::page::{DirtKind, Page, PageOptions, PageSurface};
use trodden::show::scene::{Mesh, Scene, SceneSurface};
use trodden::show::still::STILL_SIZE_PX;
use trodden::walls::{Walls, WallsOptions};

/// Half a metre per character, `.` floor.
const PLAN: [&str; 16] = [
    "##########################",
    "########.........#########",
    "########.........#########",
    "########.........#########",
    "########.....#...#########",
    "########.........#########",
    "########.........#########",
    "#########..###############",
    "..........................",
    "..........................",
    "..........................",
    "..........................",
    "..........................",
    "##################.....###",
    "##################.....###",
    "##################.....###",
];
const PX_M: f64 = 0.5;
pub const HEIGHT_M: f64 = 2.6;
/// Side of a floor tile, metres, and of a texel of floor and wall images.
const TILE_M: f64 = 8.0;
const PX_PER_M: u32 = 32;
const SHEET_PX: [u32; 2] = [1024, 512];

pub const DRY: Srgb8 = [116, 107, 94];
pub const RUBBER: Srgb8 = [42, 41, 40];
pub const EDGE: Srgb8 = [96, 87, 75];
const SKIN: Srgb8 = [118, 104, 84];
const GREY: Srgb8 = [110, 110, 112];

pub struct Corridor {
    pub walls: Walls,
    pub rooms: Rooms,
    pub scene: Scene,
    pub floor: Vec<Reduced>,
    pub wall: Vec<Reduced>,
    pub clean: [Srgb8; 2],
}

/// Along the corridor from its west end.
const START: Camera = Camera { position_m: [1.0, 2.6, 1.7], heading_deg: 3.0, pitch_deg: -7.0, fov_deg: 64.0 };

/// The corridor with a clean floor of that colour.
pub fn corridor(clean: Srgb8) -> Corridor {
    let clean = [clean, [232, 230, 224]];
    let floor = PLAN.iter().flat_map(|row| row.bytes()).map(|c| u8::from(c == b'.')).collect();
    let plan = FloorPlan::from_mask(PLAN[0].len() as u32, PLAN.len() as u32, PX_M, floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let mut scene = Scene::default();
    let tiles = 2;
    scene.meshes.extend((0..tiles).map(|n| floor_part(&plan, n)));
    let (part, strips) = wall_part(&walls);
    scene.meshes.push(part);
    scene.meshes.push(top_part(&plan));
    let marks = FloorMarks::new(&walls);
    let floor = (0..tiles).map(|n| floor_image(&marks, n, clean[0])).collect();
    let wall = vec![wall_image(&strips, clean[1])];
    let rooms = Rooms::new(&walls, &[], HEIGHT_M);
    Corridor { walls, rooms, scene, floor, wall, clean }
}

impl Corridor {
    /// The page of it.
    pub fn page<'a>(&'a self, title: &'a str) -> Page<'a> {
        let dirt = |name, colour| DirtKind { name, colour };
        Page {
            title,
            scene: &self.scene,
            walls: &self.walls,
            rooms: &self.rooms,
            wall_height_m: HEIGHT_M,
            floor: PageSurface {
                images: &self.floor,
                clean: self.clean[0],
                roughness: 0.35,
                dirt: vec![
                    dirt("Trodden film", DRY),
                    dirt("Shoe prints", DRY),
                    dirt("Heel marks", RUBBER),
                    dirt("Edges and dust", EDGE),
                ],
            },
            wall: PageSurface {
                images: &self.wall,
                clean: self.clean[1],
                roughness: 0.6,
                dirt: vec![dirt("Hands", SKIN), dirt("Bags", GREY), dirt("Shoes", RUBBER), dirt("Splashes", EDGE)],
            },
            start: START,
            above: self.rooms.birds_eye(STILL_SIZE_PX),
            options: PageOptions::default(),
        }
    }
}

/// Corners of all pixels that are floor (or not), as runs of a row.
fn runs(plan: &FloorPlan, of: impl Fn(u32, u32) -> bool) -> Vec<[Vec2; 2]> {
    let mut runs = Vec::new();
    for row in 0..plan.height_px {
        let y = f64::from(plan.height_px - row) * PX_M;
        let mut from = None;
        for column in 0..=plan.width_px {
            let is = column < plan.width_px && of(column, row);
            match (is, from) {
                (true, None) => from = Some(column),
                (false, Some(start)) => {
                    runs.push([vec2(f64::from(start) * PX_M, y - PX_M), vec2(f64::from(column) * PX_M, y)]);
                    from = None;
                }
                _ => {}
            }
        }
    }
    runs
}

fn part(surface: SceneSurface) -> Mesh {
    Mesh {
        surface,
        positions_m: vec![],
        normals: vec![],
        uvs: vec![],
        indices: vec![],
        faces: vec![],
        light_uvs: vec![],
    }
}

fn quad(part: &mut Mesh, corners: [[f64; 3]; 4], normal: [f64; 3], uvs: Option<[[f64; 2]; 4]>) {
    let first = part.positions_m.len() as u32;
    part.positions_m.extend(corners.map(|p| p.map(|value| value as f32)));
    part.normals.extend([normal.map(|value| value as f32); 4]);
    part.uvs.extend(uvs.into_iter().flatten().map(|uv| uv.map(|value| value as f32)));
    part.indices.extend([0, 1, 2, 0, 2, 3].map(|n| first + n));
}

fn floor_part(plan: &FloorPlan, tile: usize) -> Mesh {
    let mut part = part(SceneSurface::FloorTile(tile));
    let left = tile as f64 * TILE_M;
    for [low, high] in runs(plan, |i, j| plan.floor[(j * plan.width_px + i) as usize] == 1) {
        let (x0, x1) = (low.x.max(left), high.x.min(left + TILE_M));
        if x0 < x1 {
            let corners = [[x0, low.y], [x1, low.y], [x1, high.y], [x0, high.y]];
            let uvs = corners.map(|[x, y]| [(x - left) / TILE_M, 1.0 - y / TILE_M]);
            quad(&mut part, corners.map(|[x, y]| [x, y, 0.0]), [0.0, 0.0, 1.0], Some(uvs));
        }
    }
    part
}

fn top_part(plan: &FloorPlan) -> Mesh {
    let mut part = part(SceneSurface::WallTop);
    let floor = |i: i64, j: i64| {
        (0..i64::from(plan.width_px)).contains(&i)
            && (0..i64::from(plan.height_px)).contains(&j)
            && plan.floor[(j * i64::from(plan.width_px) + i) as usize] == 1
    };
    let near = |i: u32, j: u32| {
        let (i, j) = (i64::from(i), i64::from(j));
        !floor(i, j) && (-1..=1).any(|dj| (-1..=1).any(|di| floor(i + di, j + dj)))
    };
    for [low, high] in runs(plan, near) {
        let corners = [[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]];
        quad(&mut part, corners.map(|[x, y]| [x, y, HEIGHT_M]), [0.0, 0.0, 1.0], None);
    }
    part
}

/// Where a straight piece of wall lies on the sheet: its lower-left pixel and its length.
struct Strip {
    left_px: u32,
    low_px: u32,
    length_m: f64,
    seed: u64,
}

fn wall_part(walls: &Walls) -> (Mesh, Vec<Strip>) {
    let mut part = part(SceneSurface::WallSheet(0));
    let mut strips = Vec::new();
    let strip_px = (HEIGHT_M * f64::from(PX_PER_M)).ceil() as u32;
    let (mut left_px, mut low_px) = (4, SHEET_PX[1] - 4);
    for face in &walls.faces {
        let n = face.points_m.len();
        for k in 0..if face.closed { n } else { n - 1 } {
            let (a, b) = (face.points_m[k], face.points_m[(k + 1) % n]);
            let length_m = a.distance(b);
            let width_px = (length_m * f64::from(PX_PER_M)).ceil() as u32;
            if left_px + width_px + 4 > SHEET_PX[0] {
                (left_px, low_px) = (4, low_px - strip_px - 8);
            }
            let along = (b - a) / length_m;
            let normal = vec2(along.y, -along.x);
            let u = |px: f64| px / f64::from(SHEET_PX[0]);
            let v = |m: f64| (f64::from(low_px) - m * f64::from(PX_PER_M)) / f64::from(SHEET_PX[1]);
            let (u0, u1) = (u(f64::from(left_px)), u(f64::from(left_px) + length_m * f64::from(PX_PER_M)));
            let corners = [[a.x, a.y, 0.0], [b.x, b.y, 0.0], [b.x, b.y, HEIGHT_M], [a.x, a.y, HEIGHT_M]];
            let uvs = [[u0, v(0.0)], [u1, v(0.0)], [u1, v(HEIGHT_M)], [u0, v(HEIGHT_M)]];
            // The floor lies on the right: seen from there, a is left and b is right.
            quad(&mut part, corners, [normal.x, normal.y, 0.0], Some(uvs));
            strips.push(Strip { left_px, low_px, length_m, seed: strips.len() as u64 });
            left_px += width_px + 8;
        }
    }
    (part, strips)
}

fn linear(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { math::pow((value + 0.055) / 1.055, 2.4) }
}

fn srgb(light: f64) -> u8 {
    let value = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * math::pow(light, 1.0 / 2.4) - 0.055 };
    (255.0 * value.clamp(0.0, 1.0)).round() as u8
}

/// The look's law, of docs/look.md.
pub fn covered(clean: Srgb8, dirt: &[(f64, Srgb8)]) -> Srgb8 {
    let seen = |light: [f64; 3]| 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
    let (mut total, mut shines) = ([0.0; 3], [0.0; 3]);
    for (density, colour) in dirt {
        let colour = colour.map(linear);
        let depths = colour.map(|light| -math::ln(light));
        for n in 0..3 {
            let absorbed = density * depths[n] / seen(depths);
            total[n] += absorbed;
            shines[n] += absorbed * colour[n];
        }
    }
    let clean = clean.map(linear);
    let dark = 3.0 * (0.8 - seen(clean) * seen(total) / seen(shines).max(1e-9));
    let dark = dark.clamp(0.0, 1.0);
    let dust = [150, 142, 128].map(linear);
    std::array::from_fn(|n| {
        let through = math::exp(-(total[n] + dark * (seen(total) - total[n])));
        let colour = shines[n] / total[n].max(1e-9);
        let colour = colour + 0.3 * dark * (dust[n] - colour);
        srgb(clean[n] * through + colour * (1.0 - through))
    })
}

fn mask(density: f64) -> u8 {
    (255.0 * (1.0 - math::exp(-density))).round() as u8
}

/// A smooth random field: 0 to 1, spots of that size.
fn cloud(seed: u64, p: Vec2, size_m: f64) -> f64 {
    let (x, y) = (p.x / size_m, p.y / size_m);
    let corner = |i: f64, j: f64| {
        let word = (i as i64 as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
            ^ (j as i64 as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
        f64::from(SplitMix64::new(word ^ seed).unit())
    };
    let (i, j) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (s, t) = (smooth(x - i), smooth(y - j));
    let low = corner(i, j) * (1.0 - s) + corner(i + 1.0, j) * s;
    let high = corner(i, j + 1.0) * (1.0 - s) + corner(i + 1.0, j + 1.0) * s;
    low * (1.0 - t) + high * t
}

/// A stain: an ellipse with a soft edge.
struct Spot {
    at: Vec2,
    along: Vec2,
    half: [f64; 2],
    density: f64,
}

impl Spot {
    fn at(&self, p: Vec2) -> f64 {
        let to = p - self.at;
        if to.length_squared() > 0.36 {
            return 0.0;
        }
        let (a, b) = (to.dot(self.along) / self.half[0], to.cross(self.along) / self.half[1]);
        self.density * math::exp(-(a * a + b * b) * (a * a + b * b))
    }
}

fn spots(seed: u64, count: usize, area: [f64; 2], half: [f64; 2], density: [f32; 2]) -> Vec<Spot> {
    let mut random = SplitMix64::new(seed);
    let mut unit = || f64::from(random.unit());
    (0..count)
        .map(|_| {
            let at = vec2(unit() * area[0], unit() * area[1]);
            let (sine, cosine) = math::sin_cos(unit() * 6.3);
            let size = 0.7 + 0.6 * unit();
            let range = f64::from(density[1] - density[0]);
            Spot {
                at,
                along: vec2(cosine, sine),
                half: [half[0] * size, half[1] * size],
                density: f64::from(density[0]) + unit() * range,
            }
        })
        .collect()
}

struct FloorMarks<'a> {
    walls: &'a Walls,
    prints: Vec<Spot>,
    scuffs: Vec<Spot>,
}

impl FloorMarks<'_> {
    fn new(walls: &Walls) -> FloorMarks<'_> {
        let area = [13.0, 8.0];
        FloorMarks {
            walls,
            prints: spots(1, 90, area, [0.13, 0.05], [0.05, 0.25]),
            scuffs: spots(2, 80, area, [0.09, 0.03], [0.3, 1.2]),
        }
    }

    /// Densities of film, prints, scuffs, edge.
    fn at(&self, p: Vec2) -> [f64; 4] {
        let distance = self.walls.nearest(p, 3.0).map_or(3.0, |nearest| nearest.distance_m);
        let uneven = 0.75 + 0.3 * cloud(5, p, 1.1) + 0.25 * cloud(6, p, 0.15);
        let lane = 1.0 - math::exp(-(distance / 0.55) * (distance / 0.55));
        let near = |spots: &[Spot]| spots.iter().map(|spot| spot.at(p)).sum::<f64>();
        let broken = 0.5 + cloud(7, p, 0.2);
        [
            0.42 * lane * uneven,
            near(&self.prints),
            near(&self.scuffs),
            0.34 * broken * math::exp(-distance / 0.05) + 0.08 * math::exp(-distance / 0.3),
        ]
    }
}

/// What a pixel shows.
struct Shown {
    clean: Srgb8,
    dirt: [(f64, Srgb8); 4],
    roughness: f64,
}

fn reduced(width: u32, height: u32, of: impl Fn(u32, u32) -> Shown) -> Reduced {
    let mut image = Reduced {
        factor: 4,
        base_color: RgbImage::new(width, height),
        clean: RgbImage::new(width, height),
        dirt: RgbaImage::new(width, height),
        orm: RgbImage::new(width, height),
    };
    for y in 0..height {
        for x in 0..width {
            let Shown { clean, dirt, roughness } = of(x, y);
            image.base_color.put_pixel(x, y, Rgb(covered(clean, &dirt)));
            image.clean.put_pixel(x, y, Rgb(clean));
            image.dirt.put_pixel(x, y, Rgba(dirt.map(|(density, _)| mask(density))));
            image.orm.put_pixel(x, y, Rgb([255, (255.0 * roughness) as u8, 0]));
        }
    }
    image
}

fn floor_image(marks: &FloorMarks<'_>, tile: usize, clean: Srgb8) -> Reduced {
    let side = (TILE_M * f64::from(PX_PER_M)) as u32;
    reduced(side, side, |x, y| {
        let px = f64::from(PX_PER_M);
        let p = vec2((f64::from(x) + 0.5) / px + tile as f64 * TILE_M, TILE_M - (f64::from(y) + 0.5) / px);
        let [film, prints, scuffs, edge] = marks.at(p);
        // The clean floor has a faint texture of its own.
        let grain = 0.98 + 0.04 * cloud(8, p, 0.06);
        let clean = clean.map(|channel| srgb(linear(channel) * grain));
        let dirt = [(film, DRY), (prints, DRY), (scuffs, RUBBER), (edge, EDGE)];
        Shown { clean, dirt, roughness: 0.35 + 0.3 * film + 0.2 * edge }
    })
}

fn wall_image(strips: &[Strip], clean: Srgb8) -> Reduced {
    let marks: Vec<[Vec<Spot>; 3]> = strips
        .iter()
        .map(|strip| {
            let count = |per_m: f64| (strip.length_m * per_m).ceil() as usize;
            let mut hands = spots(10 + strip.seed, count(0.8), [strip.length_m, 0.6], [0.09, 0.05], [0.03, 0.3]);
            hands.iter_mut().for_each(|hand| hand.at.y += 0.8);
            let mut bags = spots(40 + strip.seed, count(0.3), [strip.length_m, 0.5], [0.2, 0.02], [0.03, 0.2]);
            bags.iter_mut().for_each(|bag| (bag.at.y, bag.along) = (bag.at.y + 0.3, vec2(1.0, 0.02)));
            let shoes = spots(70 + strip.seed, count(0.6), [strip.length_m, 0.15], [0.05, 0.015], [0.3, 1.0]);
            [hands, bags, shoes]
        })
        .collect();
    reduced(SHEET_PX[0], SHEET_PX[1], |x, y| {
        let px = f64::from(PX_PER_M);
        let place = |strip: &Strip| {
            let along = (f64::from(x) + 0.5 - f64::from(strip.left_px)) / px;
            let up = (f64::from(strip.low_px) - f64::from(y) - 0.5) / px;
            ((-0.1..=strip.length_m + 0.1).contains(&along) && (-0.1..=HEIGHT_M + 0.1).contains(&up))
                .then_some(vec2(along, up))
        };
        let Some((n, p)) = strips.iter().enumerate().find_map(|(n, strip)| Some((n, place(strip)?))) else {
            return Shown { clean, dirt: [(0.0, EDGE); 4], roughness: 0.6 };
        };
        let [skin, bag, shoe] = [0, 1, 2].map(|kind| marks[n][kind].iter().map(|spot| spot.at(p)).sum::<f64>());
        let splash = 0.25 * math::exp(-(p.y / 0.06).max(0.0)) * (0.5 + cloud(9, p, 0.1));
        Shown { clean, dirt: [(skin, SKIN), (bag, GREY), (shoe, RUBBER), (splash, EDGE)], roughness: 0.6 }
    })
}
