//! Finds a sheet of paper in a photograph, and straightens it.
//!
//! The sheet is the largest bright quadrilateral on a darker desk. Its aspect ratio follows from the perspective after
//! Zhang and He, "Whiteboard scanning and image enhancement" (2007).

use image::{DynamicImage, RgbImage};
use rayon::prelude::*;

use super::components::{Component, Components, Neighbours};

/// Longer side of the small picture in which the sheet is looked for, pixels.
const SMALL_PX: usize = 400;
/// Least side of a photograph, pixels: maps of games have a pixel a cell.
const LEAST_PHOTO_PX: usize = 200;
/// How far from the desk's colour to the paper's the sheet begins: several are tried, because of shadows.
const LEVELS: [f64; 5] = [0.2, 0.3, 0.4, 0.5, 0.62];
/// Least difference between desk and paper, of 255.
const LEAST_CONTRAST: f64 = 30.0;
/// Greatest step between neighbours on the desk, of 255.
const DESK_STEP: f64 = 9.0;
/// Least and greatest share of the photograph that a sheet takes.
const AREA_SHARE: [f64; 2] = [0.2, 0.98];
/// Least share of the sheet that is paper.
const PAPER_SHARE: f64 = 0.6;
/// Least share of its quadrilateral that the sheet fills.
const FILL_SHARE: f64 = 0.95;
/// Least share of a side along which the tone changes from desk to paper; and of all sides.
const SIDE_SUPPORT: f64 = 0.6;
const SUPPORT: f64 = 0.8;
/// Greatest slope of a side that counts as level or upright: drawn plans have such rooms.
const LEVEL_SLOPE: f64 = 0.01;
/// Least length of ink on a sheet, as a share of its longer side.
const INK_LENGTH: f64 = 0.15;
/// Rim that is cut off, as a share of the sheet's side.
const RIM: f64 = 0.006;
/// Usual aspect ratios of sheets, A and letter, and how near one must be.
const USUAL_ASPECTS: [f64; 2] = [std::f64::consts::SQRT_2, 11.0 / 8.5];
const ASPECT_REACH: f64 = 0.045;

type Point = [f64; 2];

/// A sheet that was found: its corners in pixels of the photograph, clockwise from the upper left, and its aspect ratio.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheet {
    pub(super) corners: [Point; 4],
    pub(super) aspect: f64,
}

/// Finds the sheet in a photograph. `None` for what is no photograph of a sheet.
pub(super) fn find(image: &DynamicImage) -> Option<Sheet> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let cell = width.max(height).div_ceil(SMALL_PX).max(1);
    if width.min(height) < LEAST_PHOTO_PX.max(16 * cell) {
        return None;
    }
    let small = Small::of(image, cell);
    let by_level = LEVELS.iter().map(|&level| small.paperness.iter().map(|&p| u8::from(p >= level)).collect());
    let masks: Vec<Vec<u8>> = by_level.chain([small.beyond_desk()]).collect();
    let found = masks.iter().filter_map(|mask| small.quadrilateral(mask));
    let best = found.reduce(|a, b| if b.score > a.score { b } else { a })?;
    let corners = best.corners.map(|[x, y]| [x * cell as f64, y * cell as f64]);
    let corners = refined(image, &small, corners, cell as f64);
    let aspect = aspect(corners, [width as f64, height as f64]);
    Some(Sheet { corners, aspect })
}

/// The photograph, averaged over cells, and how far each cell is from the desk's colour towards the paper's.
struct Small {
    width: usize,
    height: usize,
    colours: Vec<[f64; 3]>,
    paperness: Vec<f64>,
    desk: [f64; 3],
    towards_paper: [f64; 3],
    /// Whether most pixels have the colour of the one before, as in drawings.
    is_flat: bool,
}

struct Candidate {
    corners: [Point; 4],
    score: f64,
}

/// The colour of a pixel on white paper.
pub(super) fn colour_at(image: &DynamicImage, x: usize, y: usize) -> [u8; 3] {
    use image::GenericImageView;
    let at = |width: u32, x: usize, y: usize| (y * width as usize + x) * 3;
    match image {
        DynamicImage::ImageLuma8(grey) => [grey.as_raw()[y * grey.width() as usize + x]; 3],
        DynamicImage::ImageRgb8(rgb) => {
            let at = at(rgb.width(), x, y);
            [rgb.as_raw()[at], rgb.as_raw()[at + 1], rgb.as_raw()[at + 2]]
        }
        other => {
            let [r, g, b, a] = other.get_pixel(x as u32, y as u32).0;
            let alpha = u32::from(a);
            [r, g, b].map(|v| ((u32::from(v) * alpha + 255 * (255 - alpha)) / 255) as u8)
        }
    }
}

impl Small {
    fn of(image: &DynamicImage, cell: usize) -> Small {
        let (width, height) = (image.width() as usize / cell, image.height() as usize / cell);
        // Few pixels of a cell are enough.
        let step = cell.div_ceil(4).max(1);
        let colours: Vec<[f64; 3]> = (0..width * height)
            .into_par_iter()
            .map(|at| {
                let (left, top) = (at % width * cell, at / width * cell);
                let (mut sum, mut count) = ([0u32; 3], 0u32);
                for y in (top..top + cell).step_by(step) {
                    for x in (left..left + cell).step_by(step) {
                        let colour = colour_at(image, x, y);
                        (0..3).for_each(|k| sum[k] += u32::from(colour[k]));
                        count += 1;
                    }
                }
                sum.map(|s| f64::from(s) / f64::from(count.max(1)))
            })
            .collect();
        let rim: Vec<[f64; 3]> = (0..width * height)
            .filter(|at| {
                let (x, y) = (at % width, at / width);
                x < 2 || y < 2 || x + 2 >= width || y + 2 >= height
            })
            .map(|at| colours[at])
            .collect();
        let luma = |c: &[f64; 3]| 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
        let median = |colours: &[[f64; 3]]| {
            [0, 1, 2].map(|k| {
                let mut values: Vec<f64> = colours.iter().map(|c| c[k]).collect();
                values.sort_by(f64::total_cmp);
                values.get(values.len() / 2).copied().unwrap_or(0.0)
            })
        };
        let mut sorted = colours.clone();
        sorted.sort_by(|a, b| luma(a).total_cmp(&luma(b)));
        let paper = median(&sorted[sorted.len() * 3 / 4..]);
        // A sheet may reach the picture's sides: the darker half of the rim is desk.
        let mut dark_rim = rim.clone();
        dark_rim.sort_by(|a, b| luma(a).total_cmp(&luma(b)));
        let desk = median(&dark_rim[..dark_rim.len() * 3 / 4]);
        let apart = [0, 1, 2].map(|k| paper[k] - desk[k]);
        let squared = apart.iter().map(|v| v * v).sum::<f64>();
        let (towards_paper, contrast) = (apart.map(|v| v / squared.max(1.0)), squared.sqrt());
        let brighter = luma(&paper) - luma(&desk) >= LEAST_CONTRAST && contrast >= LEAST_CONTRAST;
        let paperness = match brighter {
            true => colours.iter().map(|c| (0..3).map(|k| (c[k] - desk[k]) * towards_paper[k]).sum()).collect(),
            false => vec![0.0; width * height],
        };
        let is_same = |y: usize, x: usize| colour_at(image, x, y) == colour_at(image, x + 1, y);
        let rows = (0..height * cell).step_by(cell);
        let same: usize = rows.map(|y| (0..width * cell - 1).filter(|&x| is_same(y, x)).count()).sum();
        let is_flat = same * 10 >= height * width * cell * 7;
        Small { width, height, colours, paperness, desk, towards_paper, is_flat }
    }

    /// What the desk does not reach without a step of its tone: under a shadow, paper is darker than a lit desk.
    fn beyond_desk(&self) -> Vec<u8> {
        let (width, height) = (self.width, self.height);
        let mut mask = vec![1u8; width * height];
        let is_rim = |at: &usize| {
            let (x, y) = (at % width, at / width);
            (x == 0 || y == 0 || x + 1 == width || y + 1 == height) && self.paperness[*at] < 0.5
        };
        let mut reached: Vec<usize> = (0..width * height).filter(is_rim).collect();
        reached.iter().for_each(|&at| mask[at] = 0);
        while let Some(at) = reached.pop() {
            let (x, y) = (at % width, at / width);
            let near = [
                (x > 0, at.wrapping_sub(1)),
                (x + 1 < width, at + 1),
                (y > 0, at.wrapping_sub(width)),
                (y + 1 < height, at + width),
            ];
            for (_, next) in near.into_iter().filter(|&(inside, _)| inside) {
                let step = (0..3).map(|k| (self.colours[at][k] - self.colours[next][k]).abs()).fold(0.0, f64::max);
                if mask[next] != 0 && step <= DESK_STEP {
                    mask[next] = 0;
                    reached.push(next);
                }
            }
        }
        mask
    }

    fn quadrilateral(&self, mask: &[u8]) -> Option<Candidate> {
        let pieces = Components::of(mask, self.width, 1, Neighbours::Four);
        let sheet = pieces.all.iter().max_by_key(|p| (p.area, std::cmp::Reverse(p.min)))?;
        let hull = hull(&pieces, sheet);
        let corners = largest_quadrilateral(&hull)?;
        let (inside, quad) = (area(&hull), area(&corners));
        let total = (self.width * self.height) as f64;
        if !(AREA_SHARE[0]..=AREA_SHARE[1]).contains(&(quad / total))
            || quad < FILL_SHARE * inside
            || (sheet.area as f64) < PAPER_SHARE * inside
            || self.is_drawn(&corners)
        {
            return None;
        }
        let support: Vec<f64> = (0..4).map(|k| self.support(corners[k], corners[(k + 1) % 4])).collect();
        let mean = support.iter().sum::<f64>() / 4.0;
        let is_border = |&k: &usize| {
            let [inwards, _] = normal(corners[k], corners[(k + 1) % 4]);
            let middle = [0, 1].map(|axis| (corners[k][axis] + corners[(k + 1) % 4][axis]) * 0.5 - 2.5 * inwards[axis]);
            self.at(middle).is_none()
        };
        // The desk shows on three sides at least.
        if (0..4).filter(is_border).count() > 1
            || support.iter().any(|&s| s < SIDE_SUPPORT)
            || mean < SUPPORT
            || !self.has_ink(&corners)
        {
            return None;
        }
        Some(Candidate { corners, score: mean * (quad / total).sqrt().sqrt() })
    }

    /// Whether the quadrilateral may be a room or the paper of a drawing: flat colours, level and upright sides.
    fn is_drawn(&self, corners: &[Point; 4]) -> bool {
        let is_level = |k: usize| {
            let [a, b] = [corners[k], corners[(k + 1) % 4]];
            let [dx, dy] = [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()];
            dx.min(dy) <= LEVEL_SLOPE * dx.max(dy) + 1.0
        };
        self.is_flat && (0..4).all(is_level)
    }

    fn at(&self, [x, y]: Point) -> Option<f64> {
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        inside.then(|| self.paperness[y as usize * self.width + x as usize])
    }

    /// Share of a side along which it is lighter within than beyond, or the picture ends.
    fn support(&self, from: Point, to: Point) -> f64 {
        const PLACES: usize = 60;
        let [inwards, _] = normal(from, to);
        let is_edge = |k: &usize| {
            let t = (*k as f64 + 0.5) / PLACES as f64;
            let place = |d: f64| [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]) + d * inwards[axis]);
            match (self.at(place(2.5)), self.at(place(-2.5))) {
                (Some(within), Some(beyond)) => within - beyond >= 0.1,
                (within, None) => within.is_some(),
                _ => false,
            }
        };
        (0..PLACES).filter(is_edge).count() as f64 / PLACES as f64
    }

    /// Whether there is a drawing on the sheet: ink that does not touch the desk.
    fn has_ink(&self, corners: &[Point; 4]) -> bool {
        let side = |k: usize| distance(corners[k], corners[(k + 1) % 4]);
        let longer = (0..4).map(side).fold(0.0, f64::max);
        // Thin ink is grey in the small picture: it is darker than the paper around it.
        let around = |x: usize, y: usize| {
            let (left, right) = (x.saturating_sub(4), (x + 5).min(self.width));
            (y.saturating_sub(4)..(y + 5).min(self.height))
                .flat_map(|y| &self.paperness[y * self.width + left..y * self.width + right])
                .fold(0.0f64, |most, &p| most.max(p))
        };
        let ink: Vec<u8> = (0..self.width * self.height)
            .map(|at| {
                let (x, y) = (at % self.width, at / self.width);
                let margin = (0..4).map(|k| side_distance(corners[k], corners[(k + 1) % 4], [x as f64, y as f64]));
                let is_within = margin.fold(f64::INFINITY, f64::min) > 3.0;
                u8::from(is_within && self.paperness[at] < around(x, y) * 0.88 && around(x, y) >= LEVELS[1])
            })
            .collect();
        let pieces = Components::of(&ink, self.width, 1, Neighbours::Eight);
        pieces.all.iter().any(|p| f64::from(p.larger_side()) >= INK_LENGTH * longer)
    }
}

/// Unit vectors across a side of a clockwise quadrilateral, to the inside, and along it.
fn normal(from: Point, to: Point) -> [Point; 2] {
    let length = distance(from, to).max(1e-9);
    let along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    [[-along[1], along[0]], along]
}

fn distance(a: Point, b: Point) -> f64 {
    ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
}

/// Distance of a point from a side of a clockwise quadrilateral, positive inside.
fn side_distance(from: Point, to: Point, p: Point) -> f64 {
    let [inwards, _] = normal(from, to);
    (p[0] - from[0]) * inwards[0] + (p[1] - from[1]) * inwards[1]
}

fn cross(o: Point, a: Point, b: Point) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

fn area(polygon: &[Point]) -> f64 {
    let n = polygon.len();
    (0..n).map(|k| cross([0.0; 2], polygon[k], polygon[(k + 1) % n])).sum::<f64>().abs() * 0.5
}

/// Convex hull of a component, clockwise as seen in the image (y down), of at most 48 vertices.
fn hull(pieces: &Components, piece: &Component) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for run in pieces.runs(piece) {
        for y in [run.y, run.y + 1] {
            points.push([f64::from(run.from), f64::from(y)]);
            points.push([f64::from(run.to), f64::from(y)]);
        }
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while chain.len() >= 2 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    while hull.len() > 48 {
        let n = hull.len();
        let loss = |k: usize| cross(hull[(k + n - 1) % n], hull[k], hull[(k + 1) % n]).abs();
        let least = (0..n).min_by(|&a, &b| loss(a).total_cmp(&loss(b))).unwrap_or(0);
        hull.remove(least);
    }
    hull
}

/// The largest quadrilateral of a hull's vertices, clockwise from the upper left corner.
fn largest_quadrilateral(hull: &[Point]) -> Option<[Point; 4]> {
    let n = hull.len();
    let mut best: Option<(f64, [usize; 4])> = None;
    for a in 0..n {
        for c in a + 2..n {
            // The two triangles on either side of a diagonal are independent.
            let beyond = |k: usize| cross(hull[a], hull[c], hull[k]).abs();
            let farthest =
                |range: &mut dyn Iterator<Item = usize>| range.max_by(|&i, &k| beyond(i).total_cmp(&beyond(k)));
            let (Some(b), Some(d)) = (farthest(&mut (a + 1..c)), farthest(&mut (c + 1..n).chain(0..a))) else {
                continue;
            };
            let total = beyond(b) + beyond(d);
            if best.is_none_or(|(most, _)| total > most) {
                best = Some((total, [a, b, c, d]));
            }
        }
    }
    let mut corners = best?.1.map(|k| hull[k]);
    let first = (0..4).min_by(|&i, &k| (corners[i][0] + corners[i][1]).total_cmp(&(corners[k][0] + corners[k][1])))?;
    corners.rotate_left(first);
    Some(corners)
}

/// Fits lines to the sheet's sides in the full photograph and crosses them.
fn refined(image: &DynamicImage, small: &Small, corners: [Point; 4], cell: f64) -> [Point; 4] {
    let sides = [0, 1, 2, 3].map(|k| fitted_side(image, small, corners[k], corners[(k + 1) % 4], cell));
    [0, 1, 2, 3].map(|k| {
        let crossing = crossing(sides[(k + 3) % 4], sides[k]);
        // A side that could not be fitted keeps its corners.
        crossing.filter(|&p| distance(p, corners[k]) <= 6.0 * cell + 4.0).unwrap_or(corners[k])
    })
}

fn fitted_side(image: &DynamicImage, small: &Small, from: Point, to: Point, cell: f64) -> [Point; 2] {
    const PLACES: usize = 240;
    let [inwards, along] = normal(from, to);
    let length = distance(from, to);
    let reach = (3.0 * cell).max(4.0) as i32;
    let (width, height) = (image.width() as f64, image.height() as f64);
    let value = |p: Point| {
        let inside = p[0] >= 0.0 && p[1] >= 0.0 && p[0] < width && p[1] < height;
        inside.then(|| {
            let colour = colour_at(image, p[0] as usize, p[1] as usize);
            (0..3).map(|k| (f64::from(colour[k]) - small.desk[k]) * small.towards_paper[k]).sum::<f64>()
        })
    };
    let mut edge: Vec<Point> = Vec::new();
    for k in 0..PLACES {
        let t = length * (0.04 + 0.92 * (k as f64 + 0.5) / PLACES as f64);
        let place = |d: f64| [0, 1].map(|axis| from[axis] + t * along[axis] + d * inwards[axis]);
        let tones: Option<Vec<f64>> = (-reach - 3..=reach + 3).map(|d| value(place(f64::from(d)))).collect();
        let Some(tones) = tones else { continue };
        // The step between three pixels beyond and three within, greatest at the edge.
        let step = |at: usize| tones[at..at + 3].iter().sum::<f64>() - tones[at - 3..at].iter().sum::<f64>();
        let best = (3..tones.len() - 2).map(|at| (at, step(at))).max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        if let Some((at, strength)) = best.filter(|&(_, strength)| strength > 0.3) {
            // Between two pixels, weighed by the steps on either side.
            let near = |at: usize| if (3..tones.len() - 2).contains(&at) { step(at).max(0.0) } else { 0.0 };
            let (before, after) = (near(at - 1), near(at + 1));
            let shift = (after - before) / (before + after + strength) * 0.75;
            edge.push(place(at as f64 - 0.5 - f64::from(reach + 3) + shift));
        }
    }
    let mut line = [from, to];
    for _ in 0..4 {
        if edge.len() < PLACES / 5 {
            return [from, to];
        }
        line = fitted_line(&edge, along);
        let off = |p: &Point| side_distance(line[0], line[1], *p).abs();
        let mut offs: Vec<f64> = edge.iter().map(off).collect();
        offs.sort_by(f64::total_cmp);
        let most = (2.5 * offs[offs.len() / 2]).max(0.6);
        edge.retain(|p| off(p) <= most);
    }
    line
}

/// Least squares through points, across a direction that the line nearly has.
fn fitted_line(points: &[Point], along: Point) -> [Point; 2] {
    let across = [-along[1], along[0]];
    let n = points.len() as f64;
    let dot = |p: &Point, d: Point| p[0] * d[0] + p[1] * d[1];
    let [mut t, mut d, mut tt, mut td] = [0.0; 4];
    let origin = points[0];
    for p in points {
        let p = [p[0] - origin[0], p[1] - origin[1]];
        let (a, b) = (dot(&p, along), dot(&p, across));
        t += a;
        d += b;
        tt += a * a;
        td += a * b;
    }
    let slope = (td - t * d / n) / (tt - t * t / n).max(1e-9);
    let at = d / n - slope * t / n;
    [0.0, 1000.0].map(|t| [0, 1].map(|k| origin[k] + t * along[k] + (at + slope * t) * across[k]))
}

fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<Point> {
    let [r, s] = [[b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]];
    let turn = r[0] * s[1] - r[1] * s[0];
    if turn.abs() < 1e-9 {
        return None;
    }
    let t = ((c[0] - a[0]) * s[1] - (c[1] - a[1]) * s[0]) / turn;
    Some([a[0] + t * r[0], a[1] + t * r[1]])
}

/// Width over height of a sheet, from its corners in a photograph.
fn aspect(corners: [Point; 4], [width, height]: [f64; 2]) -> f64 {
    let diagonal = (width * width + height * height).sqrt();
    let m = corners.map(|[x, y]| [x - width * 0.5, y - height * 0.5, 1.0]);
    let [m1, m2, m4, m3] = m;
    let product =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let k2 = dot(product(m1, m4), m3) / dot(product(m2, m4), m3);
    let k3 = dot(product(m1, m4), m2) / dot(product(m3, m4), m2);
    let n2 = [0, 1, 2].map(|k| k2 * m2[k] - m1[k]);
    let n3 = [0, 1, 2].map(|k| k3 * m3[k] - m1[k]);
    let squared = -(n2[0] * n3[0] + n2[1] * n3[1]) / (n2[2] * n3[2]);
    // Without much perspective the camera's focal length cannot be told: that of a phone.
    let is_likely = (0.45 * diagonal..3.0 * diagonal).contains(&squared.max(0.0).sqrt());
    let squared = if is_likely { squared } else { 0.64 * diagonal * diagonal };
    let length = |n: [f64; 3]| ((n[0] * n[0] + n[1] * n[1]) / squared + n[2] * n[2]).sqrt();
    let found = length(n2) / length(n3);
    let sides = (distance(corners[0], corners[1]) + distance(corners[3], corners[2]))
        / (distance(corners[1], corners[2]) + distance(corners[0], corners[3]));
    let found = if (0.6..1.7).contains(&(found / sides)) { found } else { sides };
    let usual = USUAL_ASPECTS.into_iter().flat_map(|a| [a, 1.0 / a]);
    let nearest = usual.min_by(|a, b| (a / found - 1.0).abs().total_cmp(&(b / found - 1.0).abs()));
    nearest.filter(|a| (a / found - 1.0).abs() <= ASPECT_REACH).unwrap_or(found)
}

/// Maps the unit square to a quadrilateral (Heckbert 1989): `[x, y] = [a u + b v + c, d u + e v + f] / (g u + h v + 1)`.
pub(crate) fn homography([p0, p1, p2, p3]: [Point; 4]) -> [f64; 8] {
    let sum = [0, 1].map(|k| p0[k] - p1[k] + p2[k] - p3[k]);
    let (d1, d2) = ([p1[0] - p2[0], p1[1] - p2[1]], [p3[0] - p2[0], p3[1] - p2[1]]);
    let turn = d1[0] * d2[1] - d1[1] * d2[0];
    let g = (sum[0] * d2[1] - sum[1] * d2[0]) / turn;
    let h = (d1[0] * sum[1] - d1[1] * sum[0]) / turn;
    [
        p1[0] - p0[0] + g * p1[0],
        p3[0] - p0[0] + h * p3[0],
        p0[0],
        p1[1] - p0[1] + g * p1[1],
        p3[1] - p0[1] + h * p3[1],
        p0[1],
        g,
        h,
    ]
}

pub(crate) fn mapped([a, b, c, d, e, f, g, h]: [f64; 8], [u, v]: Point) -> Point {
    let w = g * u + h * v + 1.0;
    [(a * u + b * v + c) / w, (d * u + e * v + f) / w]
}

/// The sheet as if seen from straight above, at about the photograph's resolution, without its rim.
pub(super) fn straightened(image: &DynamicImage, sheet: &Sheet) -> RgbImage {
    let [a, b, c, d] = sheet.corners;
    let across = distance(a, b).max(distance(d, c));
    let down = distance(b, c).max(distance(a, d));
    let most = f64::from(super::LARGEST_SIDE_PX);
    let (width, height) =
        if across >= down * sheet.aspect { (across, across / sheet.aspect) } else { (down * sheet.aspect, down) };
    let reduce = (most / width.max(height)).min(1.0);
    let size = [width, height].map(|side| ((side * reduce * (1.0 - 2.0 * RIM)).round() as usize).max(2));
    let map = homography(sheet.corners);
    let mut pixels = vec![0u8; size[0] * size[1] * 3];
    pixels.par_chunks_mut(size[0] * 3).enumerate().for_each(|(y, row)| {
        let v = RIM + (1.0 - 2.0 * RIM) * (y as f64 + 0.5) / size[1] as f64;
        for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
            let u = RIM + (1.0 - 2.0 * RIM) * (x as f64 + 0.5) / size[0] as f64;
            pixel.copy_from_slice(&sampled(image, mapped(map, [u, v])));
        }
    });
    RgbImage::from_raw(size[0] as u32, size[1] as u32, pixels).unwrap_or_default()
}

/// The colour between pixels, by cubic interpolation (Catmull and Rom).
fn sampled(image: &DynamicImage, [x, y]: Point) -> [u8; 3] {
    let weights = |t: f64| {
        let (t2, t3) = (t * t, t * t * t);
        [-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2]
    };
    let (x, y) = (x - 0.5, y - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let (across, down) = (weights(x - left), weights(y - top));
    let within = |k: f64, end: u32| k.clamp(0.0, f64::from(end - 1)) as usize;
    let mut sum = [0.0; 3];
    for (j, &wy) in down.iter().enumerate() {
        let y = within(top + j as f64 - 1.0, image.height());
        for (i, &wx) in across.iter().enumerate() {
            let colour = colour_at(image, within(left + i as f64 - 1.0, image.width()), y);
            (0..3).for_each(|k| sum[k] += wx * wy * f64::from(colour[k]));
        }
    }
    sum.map(|s| (s + 0.5).clamp(0.0, 255.0) as u8)
}

#[cfg(test)]
mod tests;
