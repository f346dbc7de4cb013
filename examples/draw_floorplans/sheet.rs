use std::io::{self, BufWriter, Write};

use trodden::math::{Rect, Vec2, atan2, sin_cos, vec2};

/// Ink of a wall.
pub const WALL: u8 = 0;
/// Ink of what an architect draws thin on top of the floor: door leaves, treads, furniture. Light enough to be
/// read as floor.
pub const NOTE: u8 = 221;
/// Paper.
pub const FLOOR: u8 = 255;

/// Samples per pixel and axis: edges that lie off the pixel grid come out in 17 shades.
const SAMPLES: usize = 4;

/// A sheet of paper to draw a plan on: metres, origin at the lower left, y up, later strokes over earlier ones.
pub struct Sheet {
    width_px: usize,
    height_px: usize,
    samples_per_metre: f64,
    samples: Vec<u8>,
}

impl Sheet {
    /// A sheet of this size, covered with one ink.
    pub fn new(width_m: f64, height_m: f64, metres_per_pixel: f64, ink: u8) -> Sheet {
        let width_px = (width_m / metres_per_pixel).round() as usize;
        let height_px = (height_m / metres_per_pixel).round() as usize;
        Sheet {
            width_px,
            height_px,
            samples_per_metre: SAMPLES as f64 / metres_per_pixel,
            samples: vec![ink; width_px * height_px * SAMPLES * SAMPLES],
        }
    }

    /// Inks every sample within `bounds` whose place `inside` accepts.
    pub fn fill(&mut self, ink: u8, bounds: Rect, inside: impl Fn(Vec2) -> bool) {
        let (columns, rows) = (self.width_px * SAMPLES, self.height_px * SAMPLES);
        let clamp = |metres: f64, limit: usize| (metres * self.samples_per_metre).round().clamp(0.0, limit as f64);
        let (i0, i1) = (clamp(bounds.min.x, columns) as usize, clamp(bounds.max.x, columns) as usize);
        let (j0, j1) = (clamp(bounds.min.y, rows) as usize, clamp(bounds.max.y, rows) as usize);
        for j in j0..j1 {
            let row = &mut self.samples[(rows - 1 - j) * columns..][..columns];
            let y = (j as f64 + 0.5) / self.samples_per_metre;
            for (i, sample) in row.iter_mut().enumerate().take(i1).skip(i0) {
                if inside(vec2((i as f64 + 0.5) / self.samples_per_metre, y)) {
                    *sample = ink;
                }
            }
        }
    }

    /// An axis-aligned rectangle between two corners.
    pub fn rect(&mut self, ink: u8, from: [f64; 2], to: [f64; 2]) {
        self.fill(ink, Rect::around(from.into(), to.into()), |_| true);
    }

    /// A convex polygon, corners in either sense.
    pub fn convex(&mut self, ink: u8, corners: &[Vec2]) {
        let bounds = bounds_of(corners);
        self.fill(ink, bounds, |p| {
            let sides = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| (b - a).cross(p - a));
            let (mut left, mut right) = (false, false);
            for side in sides {
                left |= side > 0.0;
                right |= side < 0.0;
            }
            !(left && right)
        });
    }

    /// A rectangle around `centre`, `size` = [along, across], turned counter-clockwise.
    pub fn turned_rect(&mut self, ink: u8, centre: Vec2, size: [f64; 2], angle_deg: f64) {
        let ahead = direction(angle_deg);
        let (along, across) = (ahead * (size[0] / 2.0), ahead.left() * (size[1] / 2.0));
        let corners =
            [centre - along - across, centre + along - across, centre + along + across, centre - along + across];
        self.convex(ink, &corners);
    }

    /// A straight stroke of a given width with square ends that stop at the points.
    pub fn stroke(&mut self, ink: u8, from: Vec2, to: Vec2, width_m: f64) {
        let Some(ahead) = (to - from).normalized() else { return };
        let across = ahead.left() * (width_m / 2.0);
        self.convex(ink, &[from - across, to - across, to + across, from + across]);
    }

    /// A disc.
    pub fn disc(&mut self, ink: u8, centre: Vec2, radius_m: f64) {
        let bounds = Rect { min: centre, max: centre }.grown(radius_m);
        self.fill(ink, bounds, |p| (p - centre).length_squared() < radius_m * radius_m);
    }

    /// The part of a ring between two radii and, counter-clockwise, two angles.
    pub fn ring(&mut self, ink: u8, centre: Vec2, radii: [f64; 2], degrees: [f64; 2]) {
        let bounds = Rect { min: centre, max: centre }.grown(radii[1]);
        let sweep = degrees[1] - degrees[0];
        self.fill(ink, bounds, |p| {
            let away = p - centre;
            let squared = away.length_squared();
            if squared < radii[0] * radii[0] || squared >= radii[1] * radii[1] {
                return false;
            }
            (atan2(away.y, away.x).to_degrees() - degrees[0]).rem_euclid(360.0) < sweep
        });
    }

    /// The leaf of an open door and the quarter circle that it sweeps, as thin notes: hinge and free jamb of the
    /// doorway, opening to the left of the way from one to the other.
    pub fn door(&mut self, hinge: Vec2, jamb: Vec2) {
        let (width, line) = (hinge.distance(jamb), 0.05);
        let open = (jamb - hinge).left();
        let start = atan2(jamb.y - hinge.y, jamb.x - hinge.x).to_degrees();
        self.ring(NOTE, hinge, [width - line, width], [start, start + 90.0]);
        self.stroke(NOTE, hinge, hinge + open, line);
    }

    /// Treads of a flight of stairs across a rectangle: lines along y (`up_x`) or x, every 30 cm.
    pub fn treads(&mut self, from: [f64; 2], to: [f64; 2], up_x: bool) {
        let area = Rect::around(from.into(), to.into());
        let length = if up_x { area.width() } else { area.height() };
        for step in 0..=(length / 0.3 + 1e-6) as usize {
            let at = step as f64 * 0.3;
            let (a, b) = if up_x {
                (vec2(area.min.x + at, area.min.y), vec2(area.min.x + at + 0.05, area.max.y))
            } else {
                (vec2(area.min.x, area.min.y + at), vec2(area.max.x, area.min.y + at + 0.05))
            };
            self.fill(NOTE, Rect::around(a, b), |_| true);
        }
    }

    /// The drawing as a grey PNG of 4 bits per pixel.
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(BufWriter::new(out), self.width_px as u32, self.height_px as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Four);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::NoFilter);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.packed_rows())?;
        writer.finish().map_err(io::Error::from)
    }

    /// Mean of each pixel's samples, as 16 shades, two pixels a byte; rows start on whole bytes.
    fn packed_rows(&self) -> Vec<u8> {
        let columns = self.width_px * SAMPLES;
        let row_bytes = self.width_px.div_ceil(2);
        let mut rows = vec![0; row_bytes * self.height_px];
        for (j, row) in rows.chunks_exact_mut(row_bytes).enumerate() {
            for i in 0..self.width_px {
                let sum: u32 = (0..SAMPLES)
                    .flat_map(|dj| &self.samples[(j * SAMPLES + dj) * columns + i * SAMPLES..][..SAMPLES])
                    .map(|&sample| u32::from(sample))
                    .sum();
                let mean = sum / (SAMPLES * SAMPLES) as u32;
                let shade = ((mean + 8) / 17) as u8;
                row[i / 2] |= if i % 2 == 0 { shade << 4 } else { shade };
            }
        }
        rows
    }
}

/// The unit vector at an angle counter-clockwise from +x.
pub fn direction(angle_deg: f64) -> Vec2 {
    let (sin, cos) = sin_cos(angle_deg.to_radians());
    vec2(cos, sin)
}

fn bounds_of(points: &[Vec2]) -> Rect {
    points.iter().fold(Rect { min: points[0], max: points[0] }, |bounds, &p| Rect {
        min: vec2(bounds.min.x.min(p.x), bounds.min.y.min(p.y)),
        max: vec2(bounds.max.x.max(p.x), bounds.max.y.max(p.y)),
    })
}
