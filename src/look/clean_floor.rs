//! Clean floor: colour, texture and joints.

use super::error::LookError;
use super::image::RepeatedImage;
use super::lattice::TexelWindow;
use super::material::Material;
use super::noise::{self, Channel, Noise, NoiseField};
use super::settings::FloorLook;
use crate::math::srgb::{self, Srgb8};

/// The clean floor of one look.
pub(super) struct CleanFloor {
    base: [f32; 3],
    surface: BaseTexture,
    /// Colour of joints, linear; `None` without joints.
    pub joint: Option<[f32; 3]>,
}

enum BaseTexture {
    Image(Box<RepeatedImage>),
    Procedural(ProceduralTexture),
}

/// Texture of a material, as relative deviations of its albedo.
struct ProceduralTexture {
    /// Deviations in lightness.
    tone: Vec<Noise>,
    /// Deviations in colour temperature.
    tint: Noise,
    pieces: Option<Paving>,
}

/// Planks or tiles.
struct Paving {
    size_m: [f64; 2],
    gap_m: f64,
    /// Standard deviation of the tone between pieces.
    sd: f32,
    /// Whether rows are shifted relative to each other, as planks are.
    shifted: bool,
    key: u32,
}

impl CleanFloor {
    pub fn new(floor: &FloorLook, seed: u64, texels_per_metre: f64) -> Result<CleanFloor, LookError> {
        let properties = floor.material.properties();
        let colour = floor.colour.unwrap_or(properties.colour);
        if let Some(path) = &floor.image {
            let image = RepeatedImage::open(path, floor.image_size_m, texels_per_metre)?;
            let base = image.mean();
            return Ok(CleanFloor { base, surface: BaseTexture::Image(Box::new(image)), joint: None });
        }
        let texture = ProceduralTexture::of(floor, seed);
        let joint = texture.pieces.as_ref().map(|_| srgb::light_of(joint_colour(floor.material)));
        Ok(CleanFloor { base: srgb::light_of(colour), surface: BaseTexture::Procedural(texture), joint })
    }

    /// Mean colour of the clean floor, linear.
    pub fn mean(&self) -> [f32; 3] {
        self.base
    }

    pub fn over(&self, window: &TexelWindow) -> CleanFloorWindow<'_> {
        let BaseTexture::Procedural(texture) = &self.surface else {
            return CleanFloorWindow { ground: self, window: *window, row: 0, tone: Vec::new(), tint: None };
        };
        let field = |noise: &Noise| (!noise.is_flat()).then(|| noise.over(window));
        let tone = texture.tone.iter().filter_map(field).collect();
        CleanFloorWindow { ground: self, window: *window, row: 0, tone, tint: field(&texture.tint) }
    }
}

fn joint_colour(material: Material) -> Srgb8 {
    if material == Material::Wood { [70, 52, 38] } else { [160, 156, 148] }
}

impl ProceduralTexture {
    fn of(floor: &FloorLook, seed: u64) -> ProceduralTexture {
        // Noise: length and width of spots, metres, and deviation; for the tint too; pieces.
        type NoiseSpec = (f64, f64, f32);
        let (tone, tint, pieces): ([NoiseSpec; 3], NoiseSpec, Option<Paving>) = match floor.material {
            Material::Vinyl => {
                ([(0.006, 0.006, 0.03), (0.05, 0.05, 0.006), (0.9, 0.9, 0.008)], (0.008, 0.008, 0.006), None)
            }
            Material::Dark => {
                ([(0.006, 0.006, 0.07), (0.05, 0.05, 0.012), (0.9, 0.9, 0.015)], (0.008, 0.008, 0.01), None)
            }
            Material::Terrazzo => {
                ([(0.011, 0.011, 0.14), (0.03, 0.03, 0.05), (0.8, 0.8, 0.012)], (0.013, 0.013, 0.035), None)
            }
            Material::Concrete => {
                ([(0.015, 0.015, 0.025), (0.14, 0.14, 0.02), (1.3, 1.3, 0.035)], (0.8, 0.8, 0.006), None)
            }
            Material::Wood => (
                [(0.50, 0.008, 0.05), (0.9, 0.03, 0.03), (0.4, 0.4, 0.012)],
                (0.9, 0.05, 0.02),
                Some(Paving {
                    size_m: [1.35, 0.13],
                    gap_m: 0.0012,
                    sd: 0.055,
                    shifted: true,
                    key: noise::key(seed, Channel::Piece),
                }),
            ),
            Material::Carpet => {
                ([(0.009, 0.009, 0.16), (0.04, 0.04, 0.03), (0.7, 0.7, 0.02)], (0.012, 0.012, 0.02), None)
            }
            Material::Tile => (
                [(0.012, 0.012, 0.012), (0.08, 0.08, 0.01), (0.9, 0.9, 0.006)],
                (0.1, 0.1, 0.004),
                Some(Paving {
                    size_m: [floor.tile_m, floor.tile_m],
                    gap_m: floor.joint_m,
                    sd: 0.010,
                    shifted: false,
                    key: noise::key(seed, Channel::Piece),
                }),
            ),
        };
        let gain = floor.texture;
        let noise = |channel, (x, y, sd): NoiseSpec| Noise::new(seed, channel, [x, y], sd * gain);
        let channels = [Channel::Ground, Channel::GroundMiddle, Channel::GroundCoarse];
        ProceduralTexture {
            tone: channels.into_iter().zip(tone).map(|(channel, spots)| noise(channel, spots)).collect(),
            tint: noise(Channel::GroundTint, tint),
            pieces: pieces.map(|pieces| Paving { sd: pieces.sd * gain, ..pieces }),
        }
    }
}

/// The clean floor over one window.
pub(super) struct CleanFloorWindow<'a> {
    ground: &'a CleanFloor,
    window: TexelWindow,
    row: usize,
    tone: Vec<NoiseField>,
    tint: Option<NoiseField>,
}

/// A run of texels of the clean floor.
#[derive(Default)]
pub(super) struct CleanFloorRow {
    /// Linear colour, a plane per channel.
    pub rgb: [Vec<f32>; 3],
    /// Share of joints in each texel.
    pub joint: Vec<f32>,
}

impl CleanFloorWindow<'_> {
    pub fn begin_row(&mut self, row: usize) {
        self.row = row;
        for field in self.tone.iter_mut().chain(&mut self.tint) {
            field.begin_row(row);
        }
    }

    /// Reads the texels `start..start + len` of the current row.
    pub fn read(&self, start: usize, len: usize, out: &mut CleanFloorRow) {
        for plane in out.rgb.iter_mut().chain([&mut out.joint]) {
            plane.clear();
            plane.resize(len, 0.0);
        }
        let (i, j) = (self.window.i0 + start as i64, self.window.j0 + self.row as i64);
        match &self.ground.surface {
            BaseTexture::Image(image) => image.read_row(i, j, &mut out.rgb),
            BaseTexture::Procedural(texture) => {
                let CleanFloorRow { rgb: [tone, _, tint], joint } = out;
                for field in &self.tone {
                    field.add_to(start, tone);
                }
                if let Some(field) = &self.tint {
                    field.add_to(start, tint);
                }
                if let Some(pieces) = &texture.pieces {
                    pieces.read_row(i, j, self.window.texels_per_metre, tone, joint);
                }
                self.colour(out);
            }
        }
    }

    /// Converts tone (first plane) and tint (third plane) to colour.
    fn colour(&self, out: &mut CleanFloorRow) {
        let [r0, g0, b0] = self.ground.base;
        let [red, green, blue] = &mut out.rgb;
        for ((r, g), b) in red.iter_mut().zip(green).zip(blue) {
            let (tone, tint) = ((1.0 + *r).max(0.2), *b);
            *r = r0 * tone * (1.0 + tint);
            *g = g0 * tone;
            *b = b0 * tone * (1.0 - tint);
        }
    }
}

impl Paving {
    /// Adds the tone of each piece, and sets the share of joints.
    fn read_row(&self, i: i64, j: i64, texels_per_metre: f64, tone: &mut [f32], joint: &mut [f32]) {
        let texel_m = 1.0 / texels_per_metre;
        let [length, width] = self.size_m;
        let row = ((j as f64 + 0.5) * texel_m / width).floor();
        let shift = if self.shifted { f64::from(noise::signed(self.key, row as i32, -1)) * 0.5 * length } else { 0.0 };
        let across = gap_share(j as f64 * texel_m, texel_m, width, self.gap_m);
        for (k, (tone, joint)) in tone.iter_mut().zip(joint).enumerate() {
            let x = (i + k as i64) as f64 * texel_m + shift;
            let column = ((x + 0.5 * texel_m) / length).floor();
            *tone += self.sd * 1.73 * noise::signed(self.key, column as i32, row as i32);
            *joint = 1.0 - (1.0 - across) * (1.0 - gap_share(x, texel_m, length, self.gap_m));
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

    #[test]
    fn the_clean_floor_keeps_its_mean_colour() {
        for material in [Material::Vinyl, Material::Dark, Material::Concrete, Material::Carpet, Material::Terrazzo] {
            let floor = FloorLook { material, ..FloorLook::default() };
            let ground = CleanFloor::new(&floor, 1, 100.0).unwrap();
            let window = TexelWindow { texels_per_metre: 100.0, i0: 0, j0: 0, width: 400, height: 400 };
            let mut over = ground.over(&window);
            let mut row = CleanFloorRow::default();
            let mut sum = 0.0;
            for j in 0..400 {
                over.begin_row(j);
                over.read(0, 400, &mut row);
                sum += row.rgb[1].iter().sum::<f32>() / 400.0;
            }
            let mean = sum / 400.0;
            assert!((mean / ground.mean()[1] - 1.0).abs() < 0.06, "{material:?} {mean}");
        }
    }
}
