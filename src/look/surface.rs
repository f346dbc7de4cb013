//! The clean floor: colour, relief and joints of each material, or of an artist's image.

use super::cells::{self, again, rise};
use super::error::LookError;
use super::image::RepeatedImage;
use super::image_set::SurfaceImages;
use super::lattice::TexelWindow;
use super::noise;
use super::planes::each1;
use super::settings::FloorLook;
use crate::math::{exp_f32, srgb};

mod textures;

use textures::{Chips, Cracks, Grain, Pieces, Texture, joint_colour};

/// The clean floor of one look.
pub(super) struct Surface {
    base: [f32; 3],
    images: Option<Box<SurfaceImages>>,
    texture: Texture,
    /// Colour of joints, linear; `None` without joints.
    pub joint: Option<[f32; 3]>,
}

/// The clean floor over a window of texels, a plane per quantity.
#[derive(Default)]
pub(super) struct SurfacePlanes {
    /// Linear colour. While it is made: tone, nothing, tint, as relative deviations.
    pub rgb: [Vec<f32>; 3],
    /// Share of joints in each texel.
    pub joint: Vec<f32>,
    /// Height over the mean surface, millimetres.
    pub height: Vec<f32>,
    /// Added to the roughness.
    pub rough: Vec<f32>,
    /// Normals of an image, x and y over z; empty where the height gives them.
    pub lean: [Vec<f32>; 2],
}

impl Surface {
    pub fn new(floor: &FloorLook, seed: u64, texels_per_metre: f64) -> Result<Surface, LookError> {
        let colour = floor.colour.unwrap_or(floor.material.properties().colour);
        let mut texture = Texture::of(floor, seed);
        let open = |path| SurfaceImages::open(path, floor.image_size_m, floor.image_height_mm, texels_per_metre);
        let images = floor.image.as_deref().map(open).transpose()?.map(Box::new);
        if images.is_some() {
            texture.pieces = None;
        }
        let joint = texture.pieces.as_ref().map(|_| srgb::light_of(joint_colour(floor.material)));
        let base = images.as_ref().map_or(srgb::light_of(colour), |images| images.colour.mean());
        Ok(Surface { base, images, texture, joint })
    }

    /// Mean colour of the clean floor, linear.
    pub fn mean(&self) -> [f32; 3] {
        self.base
    }

    /// Mean roughness that its images show.
    pub fn mean_roughness(&self) -> Option<f32> {
        Some(self.images.as_ref()?.roughness.as_ref()?.mean()[0])
    }

    /// Lays the floor out over a window.
    pub fn lay_out(&self, window: &TexelWindow, out: &mut SurfacePlanes) {
        out.clear(window.texels());
        let texture = &self.texture;
        let noises = texture.tone.iter().chain([&texture.tint]);
        let mut fields: Vec<_> = noises.map(|noise| noise.over(window)).collect();
        for row in 0..window.height {
            let texels = row * window.width..(row + 1) * window.width;
            let j = window.j0 + row as i64;
            if let Some(images) = &self.images {
                out.read_images(images, window, row);
                continue;
            }
            fields.iter_mut().for_each(|field| field.begin_row(row));
            let SurfacePlanes { rgb: [tone, _, tint], joint, height, rough, .. } = out;
            let mut line = SurfaceLine {
                window,
                j,
                tone: &mut tone[texels.clone()],
                tint: &mut tint[texels.clone()],
                joint: &mut joint[texels.clone()],
                height: &mut height[texels.clone()],
                rough: &mut rough[texels.clone()],
            };
            let (of_tint, of_tone) = fields.split_last().expect("the tint is the last field");
            for (n, field) in of_tone.iter().enumerate() {
                field.add_to(0, line.tone);
                if n == 0 && texture.relief_mm != 0.0 {
                    line.height.copy_from_slice(line.tone);
                    line.height.iter_mut().for_each(|height| *height *= texture.relief_mm);
                }
            }
            of_tint.add_to(0, line.tint);
            texture.chips.iter().for_each(|chips| chips.add_to(&mut line));
            if let Some(pieces) = &texture.pieces {
                pieces.add_to(texture.grain.as_ref(), &mut line);
            }
            if let Some(cracks) = &texture.cracks {
                cracks.add_to(&mut line);
            }
            self.colour(texels, &mut out.rgb);
        }
    }

    /// Converts tone (first plane) and tint (third plane) to colour.
    fn colour(&self, texels: std::ops::Range<usize>, rgb: &mut [Vec<f32>; 3]) {
        let [r0, g0, b0] = self.base;
        let [red, green, blue] = rgb.each_mut().map(|plane| &mut plane[texels.clone()]);
        for ((r, g), b) in red.iter_mut().zip(green).zip(blue) {
            let (tone, tint) = ((1.0 + *r).max(0.2), *b);
            *r = r0 * tone * (1.0 + tint);
            *g = g0 * tone;
            *b = b0 * tone * (1.0 - tint);
        }
    }
}

impl SurfacePlanes {
    fn clear(&mut self, texels: usize) {
        let SurfacePlanes { rgb, joint, height, rough, lean } = self;
        for plane in rgb.iter_mut().chain([joint, height, rough]) {
            plane.clear();
            plane.resize(texels, 0.0);
        }
        lean.iter_mut().for_each(Vec::clear);
    }

    /// Reads a row of texels from an artist's images.
    fn read_images(&mut self, images: &SurfaceImages, window: &TexelWindow, row: usize) {
        let texels = row * window.width..(row + 1) * window.width;
        let mut values: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; window.width]);
        let mut read = |image: &RepeatedImage| {
            image.read_row(window.i0, window.j0 + row as i64, &mut values);
            values.clone()
        };
        for (plane, row) in self.rgb.iter_mut().zip(read(&images.colour)) {
            plane[texels.clone()].copy_from_slice(&row);
        }
        if let Some(image) = &images.roughness {
            let mean = image.mean()[0];
            each1(&mut self.rough[texels.clone()], &read(image)[0], |value| value - mean);
        }
        if let Some((image, height_mm)) = &images.height {
            let mean = image.mean()[0];
            each1(&mut self.height[texels.clone()], &read(image)[0], |value| height_mm * (value - mean));
        }
        if let Some((image, up)) = &images.normal {
            let [x, y, z] = read(image).map(|plane| plane.into_iter().map(|value| 2.0 * value - 1.0));
            let [right, above] = &mut self.lean;
            for ((x, y), z) in x.zip(y).zip(z) {
                let z = z.max(0.05);
                right.push(x / z);
                above.push(up * y / z);
            }
        }
    }
}

/// A row of texels of a surface that is being made.
struct SurfaceLine<'a> {
    window: &'a TexelWindow,
    j: i64,
    tone: &'a mut [f32],
    tint: &'a mut [f32],
    joint: &'a mut [f32],
    height: &'a mut [f32],
    rough: &'a mut [f32],
}

impl SurfaceLine<'_> {
    fn texel_m(&self) -> f64 {
        1.0 / self.window.texels_per_metre
    }

    /// Middle of texel `k`, metres.
    fn place(&self, k: usize) -> [f64; 2] {
        let texel_m = self.texel_m();
        [((self.window.i0 + k as i64) as f64 + 0.5) * texel_m, (self.j as f64 + 0.5) * texel_m]
    }
}

impl Pieces {
    fn add_to(&self, grain: Option<&Grain>, line: &mut SurfaceLine<'_>) {
        let texel_m = line.texel_m();
        let [length, width] = self.size_m;
        let y = (line.j as f64 + 0.5) * texel_m;
        let row = (y / width).floor();
        let shift = match self.shift {
            None => f64::from(noise::signed(self.key, row as i32, -1)) * 0.5 * length,
            Some(share) => (row * share).rem_euclid(1.0) * length,
        };
        let across = gap_share(line.j as f64 * texel_m, texel_m, width, self.gap_m);
        let nearly = gap_share(line.j as f64 * texel_m, texel_m, width, self.gap_m + 2.0 * self.bevel_m);
        let (mut last, mut piece) = (i32::MAX, Piece::default());
        for k in 0..line.tone.len() {
            let x = (line.window.i0 + k as i64) as f64 * texel_m + shift;
            let column = ((x + 0.5 * texel_m) / length).floor() as i32;
            if column != last {
                (last, piece) = (column, self.piece(column, row as i32));
            }
            line.tone[k] += piece.tone;
            line.tint[k] += piece.tint;
            line.rough[k] += piece.rough;
            let mut joint = 1.0 - (1.0 - across) * (1.0 - gap_share(x, texel_m, length, self.gap_m));
            if self.bevel_m > 0.0 {
                let wide = self.gap_m + 2.0 * self.bevel_m;
                let near = 1.0 - (1.0 - nearly) * (1.0 - gap_share(x, texel_m, length, wide));
                if near > 0.0 {
                    // Edges are worn unevenly, and lower than the middle.
                    let worn = cells::smooth(self.key ^ 11, 90.0 * x, 90.0 * y)
                        + cells::smooth(self.key ^ 12, 25.0 * x, 25.0 * y);
                    joint += (near - joint) * (0.5 * worn).max(0.0);
                    line.height[k] -= 0.35 * self.gap_mm * (near - joint);
                }
            }
            line.joint[k] = joint;
            line.height[k] -= self.gap_mm * joint;
            if let Some(grain) = grain {
                // A piece of its own trunk.
                let knot = piece.knot_m.map(|[u, v]| [x - f64::from(column) * length - u, y - row * width - v]);
                let (tone, height) =
                    grain.at([x + piece.origin_m, y + 0.37 * piece.origin_m], piece.word, knot, texel_m);
                line.tone[k] += tone;
                line.height[k] += height;
            }
            if self.loops > 0.0 {
                let [along, aside] = if piece.word & 1 == 0 { [x, y] } else { [y, x] };
                let (tone, height) = self.loop_at(along, aside, texel_m);
                line.tone[k] += tone;
                line.height[k] += height;
            }
        }
    }

    fn piece(&self, column: i32, row: i32) -> Piece {
        let word = noise::hash(self.key, column, row);
        let signed = |n: u32| 2.0 * again(word, n) - 1.0;
        let [share, by] = self.dark;
        Piece {
            word,
            tone: 1.73 * self.sd * signed(1) - if again(word, 2) < share { by } else { 0.0 },
            tint: 1.73 * self.tint_sd * signed(3),
            rough: 1.73 * self.rough_sd * signed(4),
            origin_m: 50.0 * f64::from(again(word, 5)),
            knot_m: (again(word, 7) < KNOTTY)
                .then(|| [0.1 + 0.8 * f64::from(again(word, 8)), 0.2 + 0.6 * f64::from(again(word, 9))])
                .map(|[u, v]| [u * self.size_m[0], v * self.size_m[1]]),
        }
    }

    /// Tone and height, millimetres, of the loops of a pile, at a place along and across their rows.
    fn loop_at(&self, along: f64, aside: f64, texel_m: f64) -> (f32, f32) {
        let shown = self.loops * (1.0 - rise((texel_m / LOOP_M[1]) as f32, 0.3, 0.9));
        if shown <= 0.0 {
            return (0.0, 0.0);
        }
        let aside = aside / LOOP_M[1];
        let row = aside.floor();
        let along = along / LOOP_M[0] + 0.5 * row + 0.2 * f64::from(noise::signed(self.key ^ 13, row as i32, 7));
        let [u, v] = [along - along.floor(), aside - row].map(|share| 2.0 * share as f32 - 1.0);
        let yarn = cells::unit(self.key ^ 14, along.floor() as i32, row as i32) - 0.5;
        let bulge = (1.0 - u * u) * (1.0 - v * v) - 0.44;
        (shown * (0.34 * bulge + 0.16 * yarn), 1.2 * shown * bulge)
    }
}

/// Length of a loop of carpet and width of its row, metres.
const LOOP_M: [f64; 2] = [0.009, 0.006];
/// Share of boards with a knot, and its radius, metres.
const KNOTTY: f32 = 0.12;
const KNOT_M: f64 = 0.009;

#[derive(Clone, Copy, Default)]
struct Piece {
    word: u32,
    tone: f32,
    tint: f32,
    rough: f32,
    origin_m: f64,
    /// A knot of a board, from the piece's corner.
    knot_m: Option<[f64; 2]>,
}

impl Grain {
    /// Tone and height, millimetres, at a place on a board.
    fn at(&self, [x, y]: [f64; 2], word: u32, knot: Option<[f64; 2]>, texel_m: f64) -> (f32, f32) {
        // Where the saw ran through the middle of the trunk, rings lie close and straight; elsewhere they arch.
        let flat = f64::from(again(word, 10));
        let arch = f64::from(cells::smooth(self.key, 0.55 * x, 4.0 * y));
        let sway = f64::from(cells::smooth(self.key ^ 4, 1.7 * x, 11.0 * y));
        let late = 130.0 - 90.0 * flat;
        // Rings fade where texels are too coarse for them.
        let shown = (1.0 - rise((late * texel_m) as f32, 0.35, 1.1)) * self.gain;
        let mut rings = y * late + (3.0 + 9.0 * flat) * arch + 0.8 * sway;
        let mut dark = 0.0;
        if let Some([u, v]) = knot {
            let [u, v] = [u / (2.4 * KNOT_M), v / KNOT_M];
            let squared = u * u + v * v;
            if squared < 30.0 {
                let bent = f64::from(exp_f32(-0.25 * squared as f32));
                rings += 3.0 * bent * v.signum();
                dark = 0.22 * (1.0 - rise(squared as f32, 0.35, 1.2)) + 0.10 * bent as f32;
            }
        }
        let own = cells::unit(word ^ 3, rings.floor() as i64 as i32, 0);
        let ring = (rings - rings.floor()) as f32;
        let ring = (rise(ring, 0.0, 0.75) * (1.0 - rise(ring, 0.85, 1.0)) - 0.45) * (0.35 + 1.3 * own);
        let streak = cells::smooth(self.key ^ 1, 2.2 * x, 260.0 * y);
        // Pores are short, and lie close in some places.
        let pores = rise(cells::smooth(self.key ^ 5, 14.0 * x, 420.0 * y), 0.35, 0.9);
        let soft = cells::smooth(self.key ^ 2, 0.8 * x, 30.0 * y);
        let fine = (1.0 - rise(260.0 * texel_m as f32, 1.2, 4.0)) * self.gain;
        let tone =
            -0.09 * shown * ring - fine * (0.04 * streak + 0.12 * pores) + self.gain * (0.045 * soft + 0.015 - dark);
        (tone, 0.12 * shown * ring + fine * (0.05 * streak - 0.12 * pores))
    }
}

impl Chips {
    fn add_to(&self, line: &mut SurfaceLine<'_>) {
        // Chips smaller than texels even out to a noise, with what is left of their contrast.
        let texels = (self.spacing_m * line.window.texels_per_metre) as f32;
        let shown = self.gain / (1.0 + 1.0 / (texels * texels)).sqrt();
        let [y, per_m] = [line.place(0)[1] / self.spacing_m, 1.0 / self.spacing_m];
        // Rows of squares are shifted, so that no columns show.
        let shift = if self.radius[0] == 0.0 { 0.0 } else { cells::unit(self.key ^ 9, y.floor() as i64 as i32, 0) };
        let soft = 0.6 / texels;
        for k in 0..line.tone.len() {
            let x = line.place(k)[0] * per_m + f64::from(shift);
            let (cover, word) = if texels < 1.5 {
                let word = noise::hash(self.key, (line.window.i0 + k as i64) as i32, line.j as i32);
                (0.7, word)
            } else if self.radius[0] == 0.0 {
                let near = cells::nearest(self.key, x, y);
                (rise(near.second - near.first, self.radius[1] - soft, self.radius[1] + soft + 0.05), near.word)
            } else {
                self.strewn(x, y, soft)
            };
            if cover > 0.0 && again(word, 1) < self.share {
                let [tone, tint] = self.kinds[(again(word, 2) * self.kinds.len() as f32) as usize];
                let deviation = 0.7 + 0.6 * again(word, 3);
                line.tone[k] += shown * cover * tone * deviation;
                line.tint[k] += shown * cover * tint;
                line.height[k] += shown * cover * self.height_mm * deviation;
            }
        }
    }

    /// Share of a texel under a chip that is alone in its square, and the chip's hash.
    fn strewn(&self, x: f64, y: f64, soft: f32) -> (f32, u32) {
        let (i, j) = (x.floor(), y.floor());
        let word = noise::hash(self.key, i as i64 as i32, j as i64 as i32);
        let [least, most] = self.radius;
        let radius = least + (most - least) * again(word, 4) * again(word, 5);
        let room = 0.5 - radius;
        let centre = |n: u32| 0.5 + room * (2.0 * again(word, n) - 1.0);
        let (dx, dy) = ((x - i) as f32 - centre(6), (y - j) as f32 - centre(7));
        let distance = (dx * dx + dy * dy).sqrt();
        if distance > 1.3 * radius + soft {
            return (0.0, word);
        }
        // An oblong, at any angle.
        let (a, b) = (dx / distance.max(1e-6), dy / distance.max(1e-6));
        let lobes =
            0.28 * ((2.0 * again(word, 8) - 1.0) * 2.0 * a * b + (2.0 * again(word, 9) - 1.0) * (a * a - b * b));
        let outline = radius * (0.95 + lobes);
        // A chip thinner than a texel takes its share of it.
        let share = (radius / soft.min(0.5)).min(1.0);
        (share * share * (1.0 - rise(distance, outline - soft, outline + soft)), word)
    }
}

impl Cracks {
    fn add_to(&self, line: &mut SurfaceLine<'_>) {
        let texel_m = line.texel_m();
        for k in 0..line.tone.len() {
            let [x, y] = line.place(k);
            // Only some stretches are cracked.
            let open = rise(cells::smooth(self.key ^ 7, 0.21 * x, 0.21 * y), 0.15, 0.5);
            if open == 0.0 {
                continue;
            }
            let bend = |n: u32, scale: f64| f64::from(cells::cloudy(self.key ^ n, scale * x, scale * y, 4));
            let (u, v) = (x + 0.22 * bend(1, 1.7), y + 0.22 * bend(2, 1.7));
            let near = cells::nearest(self.key, u / self.spacing_m, v / self.spacing_m);
            let distance = 0.5 * (near.second - near.first) * self.spacing_m as f32;
            // A crack thinner than a texel takes its share of it.
            let half = (0.5 * self.width_m).max(0.5 * texel_m as f32);
            let share = (self.width_m / (2.0 * half)).sqrt();
            let crack = open * share * (1.0 - rise(distance, 0.5 * half, 1.5 * half));
            line.tone[k] -= 0.5 * crack;
            line.height[k] -= 2.0 * crack;
        }
    }
}

/// Share of gaps in `from..from + size`; gaps are centred at multiples of `period`.
fn gap_share(from: f64, size: f64, period: f64, gap: f64) -> f32 {
    let before = |x: f64| {
        let x = x + 0.5 * gap;
        let whole = (x / period).floor();
        whole * gap + (x - whole * period).min(gap)
    };
    ((before(from + size) - before(from)) / size).clamp(0.0, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::Material;

    #[test]
    fn gaps_take_up_their_area_wherever_texels_lie() {
        for texel in [0.001, 0.01, 0.013, 0.04, 0.2] {
            let count = (6.0 / texel) as usize;
            let total: f64 = (0..count).map(|k| f64::from(gap_share(k as f64 * texel - 3.0, texel, 0.3, 0.004))).sum();
            let share = total / count as f64;
            assert!((share - 0.004 / 0.3).abs() < 8e-4, "{texel}: {share}");
        }
        assert_eq!(gap_share(0.0, 0.001, 0.3, 0.004), 1.0);
        assert_eq!(gap_share(0.1, 0.01, 0.3, 0.004), 0.0);
    }

    fn laid_out(material: Material, texels_per_metre: f64, at: [i64; 2], side: usize) -> SurfacePlanes {
        let floor = FloorLook { material, ..FloorLook::default() };
        let window = TexelWindow { texels_per_metre, i0: at[0], j0: at[1], width: side, height: side };
        let mut planes = SurfacePlanes::default();
        Surface::new(&floor, 1, texels_per_metre).unwrap().lay_out(&window, &mut planes);
        planes
    }

    #[test]
    fn the_clean_floor_keeps_its_mean_colour() {
        for material in Material::ALL {
            let base = srgb::light_of(material.properties().colour)[1];
            for texels_per_metre in [100.0, 400.0] {
                let planes = laid_out(material, texels_per_metre, [0, 0], 600);
                let mean = planes.rgb[1].iter().sum::<f32>() / 360_000.0;
                assert!((mean / base - 1.0).abs() < 0.08, "{material:?} {texels_per_metre}: {mean}, not {base}");
            }
        }
    }

    #[test]
    fn a_texel_is_the_same_in_every_window() {
        for material in Material::ALL {
            let (whole, part) = (laid_out(material, 150.0, [-40, 70], 90), laid_out(material, 150.0, [-10, 90], 20));
            for (j, row) in part.rgb[2].chunks_exact(20).enumerate() {
                assert_eq!(row, &whole.rgb[2][(j + 20) * 90 + 30..][..20], "{material:?}");
            }
        }
    }

    /// Pores are small and alone, wherever their squares end.
    #[test]
    fn pores_take_up_little_of_the_concrete() {
        let planes = laid_out(Material::Concrete, 400.0, [0, 0], 800);
        let deep = planes.height.iter().zip(&planes.joint).filter(|(height, joint)| **height < -0.3 && **joint == 0.0);
        let share = deep.count() as f32 / planes.height.len() as f32;
        assert!((0.0005..0.015).contains(&share), "{share}");
    }
}
