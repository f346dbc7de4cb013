//! A canvas in metres: polygons, lines and letters, smoothed by 4 x 4 samples a pixel.

use std::ops::Range;

use image::{Rgb, RgbImage};
use trodden::plan::{FloorPlan, PlanOptions, read};

/// A point in metres, x right, y down.
pub type Point = [f64; 2];

/// A closed polygon.
pub type Polygon = Vec<Point>;

pub struct Canvas {
    pub width: usize,
    pub height: usize,
    pub px_per_m: f64,
    /// Place of the image's upper left corner.
    pub origin: Point,
    /// Turn of the drawing about its middle, radians.
    pub turn: f64,
    pub pixels: Vec<[f32; 3]>,
}

/// Samples of each pixel that shapes cover, one bit each.
pub type Samples = Vec<u16>;

impl Canvas {
    pub fn new(size_m: Point, origin: Point, px_per_m: f64, turn: f64, paper: [u8; 3]) -> Canvas {
        let [width, height] = size_m.map(|m| (m * px_per_m).round() as usize);
        Canvas { width, height, px_per_m, origin, turn, pixels: vec![paper.map(f32::from); width * height] }
    }

    /// From metres to pixels.
    pub fn px(&self, p: Point) -> Point {
        let [cx, cy] = [self.width as f64 * 0.5, self.height as f64 * 0.5];
        let [x, y] = [(p[0] - self.origin[0]) * self.px_per_m - cx, (p[1] - self.origin[1]) * self.px_per_m - cy];
        let (sine, cosine) = self.turn.sin_cos();
        [cx + x * cosine - y * sine, cy + x * sine + y * cosine]
    }

    /// The samples that at least one polygon covers.
    pub fn samples(&self, polygons: &[Polygon]) -> Samples {
        self.samples_of_rows(polygons, 0..self.height)
    }

    fn samples_of_rows(&self, polygons: &[Polygon], within: Range<usize>) -> Samples {
        let mut samples = vec![0u16; self.width * within.len()];
        for polygon in polygons {
            let points: Vec<Point> = polygon.iter().map(|&p| self.px(p).map(|v| v * 4.0)).collect();
            let low = points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
            let high = points.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
            let reach = [within.start, within.end].map(|row| row as f64 * 4.0);
            let rows = [low, high].map(|y| (y - 0.5).ceil().clamp(reach[0], reach[1]) as usize);
            for row in rows[0]..rows[1] {
                let y = row as f64 + 0.5;
                let mut crossings: Vec<f64> = (0..points.len())
                    .filter_map(|k| {
                        let (a, b) = (points[k], points[(k + 1) % points.len()]);
                        ((a[1] <= y) != (b[1] <= y)).then(|| a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
                    })
                    .collect();
                crossings.sort_by(f64::total_cmp);
                for pair in crossings.chunks_exact(2) {
                    let [from, to] = [pair[0], pair[1]].map(|x| (x - 0.5).ceil().clamp(0.0, self.width as f64 * 4.0));
                    for x in from as usize..to as usize {
                        samples[(row / 4 - within.start) * self.width + x / 4] |= 1 << (row % 4 * 4 + x % 4);
                    }
                }
            }
        }
        samples
    }

    /// Lays a colour on samples.
    pub fn paint(&mut self, samples: &Samples, colour: [u8; 3]) {
        for (pixel, &bits) in self.pixels.iter_mut().zip(samples).filter(|(_, bits)| **bits != 0) {
            lay(pixel, bits, colour);
        }
    }

    /// Reads the picture as a plan. `None` guesses the scale.
    pub fn read(&self, metres_per_pixel: Option<f64>) -> FloorPlan {
        let pixel =
            |x: u32, y: u32| Rgb(self.pixels[y as usize * self.width + x as usize].map(|value| value.round() as u8));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.png");
        RgbImage::from_fn(self.width as u32, self.height as u32, pixel).save(&path).unwrap();
        read(&path, &PlanOptions { metres_per_pixel, ..PlanOptions::default() }).unwrap()
    }

    /// Share of a rectangle that is floor in the plan that was read, as far as it lies in the drawing; metres.
    pub fn floor_in(&self, plan: &FloorPlan, [min, max]: [Point; 2]) -> f64 {
        let ([x0, y0], [x1, y1]) = (self.px(min).map(|v| v.max(0.0)), self.px(max));
        let (mut all, mut floor) = (0usize, 0usize);
        for y in y0.ceil() as usize..y1 as usize {
            for x in x0.ceil() as usize..x1 as usize {
                all += 1;
                floor += usize::from(plan.floor[y * plan.width_px as usize + x]);
            }
        }
        floor as f64 / all as f64
    }

    /// Lays a colour on polygons; looks only at the rows that they reach.
    pub fn fill(&mut self, polygons: &[Polygon], colour: [u8; 3]) {
        let rows = polygons.iter().flatten().map(|&p| self.px(p)[1]);
        let [low, high] = rows.fold([f64::INFINITY, 0.0], |[low, high], y| [low.min(y), high.max(y)]);
        let (top, bottom) = (low.max(0.0) as usize, (high.ceil() as usize).min(self.height));
        let samples = self.samples_of_rows(polygons, top..bottom.max(top));
        for (pixel, bits) in self.pixels[top.min(self.height) * self.width..].iter_mut().zip(samples) {
            lay(pixel, bits, colour);
        }
    }

    /// A window in a wall along the rows or columns: its frame and a pane in its middle, in strokes of a thickness, black on white.
    pub fn window(&mut self, min: Point, max: Point, thick: f64) {
        let (frame, across) = (rectangle(min, max), usize::from(max[0] - min[0] >= max[1] - min[1]));
        let middle = (min[across] + max[across]) * 0.5;
        let pane = [min, max].map(|mut end| {
            end[across] = middle;
            end
        });
        self.fill(std::slice::from_ref(&frame), [255; 3]);
        self.fill(&outline(&frame, thick), [0; 3]);
        self.fill(&[line(pane[0], pane[1], thick)], [0; 3]);
    }

    /// 1 where more than half of a pixel is covered.
    pub fn mask(&self, polygons: &[Polygon]) -> Vec<u8> {
        self.samples(polygons).iter().map(|bits| u8::from(bits.count_ones() > 8)).collect()
    }
}

/// Lays a colour on the covered share of a pixel.
fn lay(pixel: &mut [f32; 3], bits: u16, colour: [u8; 3]) {
    let share = bits.count_ones() as f32 / 16.0;
    for (value, to) in pixel.iter_mut().zip(colour) {
        *value += (f32::from(to) - *value) * share;
    }
}

pub fn rectangle(min: Point, max: Point) -> Polygon {
    vec![min, [max[0], min[1]], max, [min[0], max[1]]]
}

pub fn line(a: Point, b: Point, thick: f64) -> Polygon {
    let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt().max(1e-9);
    let along = [(b[0] - a[0]) / length * thick * 0.5, (b[1] - a[1]) / length * thick * 0.5];
    let (a, b) = ([a[0] - along[0], a[1] - along[1]], [b[0] + along[0], b[1] + along[1]]);
    let side = [-along[1], along[0]];
    vec![
        [a[0] + side[0], a[1] + side[1]],
        [b[0] + side[0], b[1] + side[1]],
        [b[0] - side[0], b[1] - side[1]],
        [a[0] - side[0], a[1] - side[1]],
    ]
}

/// The lines between points that follow each other.
pub fn lines(points: &[Point], thick: f64) -> Vec<Polygon> {
    points.windows(2).map(|pair| line(pair[0], pair[1], thick)).collect()
}

pub fn outline(polygon: &Polygon, thick: f64) -> Vec<Polygon> {
    let mut points = polygon.clone();
    points.push(polygon[0]);
    lines(&points, thick)
}

pub fn arc(centre: Point, radius: f64, from: f64, to: f64) -> Vec<Point> {
    let steps = 24;
    (0..=steps)
        .map(|k| {
            let angle = from + (to - from) * f64::from(k) / f64::from(steps);
            [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
        })
        .collect()
}

pub fn ellipse(centre: Point, half: Point) -> Polygon {
    arc([0.0, 0.0], 1.0, 0.0, std::f64::consts::TAU)
        .iter()
        .skip(1)
        .map(|p| [centre[0] + p[0] * half[0], centre[1] + p[1] * half[1]])
        .collect()
}

/// Strokes of letters on a grid 4 wide and 6 high: points as pairs of digits, strokes apart by a space.
fn strokes(letter: char) -> &'static str {
    match letter {
        '0' => "103041453616050110",
        '1' => "112026 1636",
        '2' => "01103041420646",
        '3' => "0110304142334445361605 3313",
        '4' => "36300444",
        '5' => "40000213334445361605",
        '6' => "401002051636454433130204",
        '7' => "004016",
        '8' => "103041423313020110 1304051636454433",
        '9' => "06364541301001021343",
        'A' => "062046 1434",
        'B' => "00063645443303 3342413000",
        'C' => "4130100105163645",
        'D' => "0006264442200000",
        'E' => "40000646 0333",
        'F' => "400006 0333",
        'G' => "413010010516364543 4323",
        'H' => "0006 4046 0343",
        'I' => "2026",
        'J' => "4045361605",
        'K' => "0006 400346",
        'L' => "000646",
        'M' => "0600234046",
        'N' => "06004640",
        'O' => "103041453616050110",
        'P' => "0600304142330303",
        'Q' => "103041453616050110 2446",
        'R' => "0600304142330303 2346",
        'S' => "41301001021333444536160500",
        'T' => "0040 2026",
        'U' => "000516364540",
        'V' => "002640",
        'W' => "0016233640",
        'X' => "0046 4006",
        'Y' => "002340 2326",
        'Z' => "00400646",
        'm' => "0602 03122326 23324346",
        '.' => "16161525261616",
        ',' => "2507",
        '-' => "0343",
        ':' => "2223 2526",
        '/' => "4006",
        _ => "",
    }
}

/// Lettering of a height in metres, with its middle at a place.
pub fn text(words: &str, middle: Point, height: f64, thick: f64) -> Vec<Polygon> {
    let unit = height / 6.0;
    let advance = unit * 5.8;
    let left = middle[0] - words.chars().count() as f64 * advance * 0.5;
    let mut all = Vec::new();
    for (k, letter) in words.chars().enumerate() {
        let corner = [left + k as f64 * advance + unit * 0.9, middle[1] - height * 0.5];
        for stroke in strokes(letter).split(' ') {
            let digits: Vec<f64> = stroke.chars().filter_map(|c| c.to_digit(10)).map(f64::from).collect();
            let points: Vec<Point> =
                digits.chunks_exact(2).map(|p| [corner[0] + p[0] * unit, corner[1] + p[1] * unit]).collect();
            all.extend(lines(&points, thick));
        }
    }
    all
}
