//! Shades the texels of a window of the floor, row by row.

use std::cell::RefCell;

use super::block::{Background, ResolvedBlock};
use super::bytes::Bytes;
use super::clean_floor::{CleanFloor, CleanFloorWindow};
use super::dust;
use super::error::LookError;
use super::lattice::{SplineLattice, TexelWindow};
use super::material::Properties;
use super::noise::{self, Channel, Noise, NoiseField};
use super::octaves::{NoiseLook, Octave};
use super::passes::{self, PassesField};
use super::settings::Look;
use super::shade::{FloorShader, ShadeInput, ShadeOutput};
use super::skirting::Skirting;
use crate::math::srgb;
use crate::sums::{FloorSums, Quantity};
use crate::walls::Walls;

/// Buffers that a thread reuses between windows: touching fresh memory costs as much as painting.
#[derive(Default)]
struct FloorBuffers {
    edge: Vec<f32>,
    passes: Vec<u32>,
    soil: Vec<u32>,
    scuff: Vec<u32>,
    known: ShadeInput,
    shaded: ShadeOutput,
    row: Vec<f32>,
}

thread_local! {
    static BUFFERS: RefCell<FloorBuffers> = RefCell::default();
}

/// Fields that are evaluated row by row.
struct FloorLayout<'a> {
    traffic: PassesField,
    noise: Vec<NoiseField>,
    ground: CleanFloorWindow<'a>,
    dust: Option<SplineLattice>,
}

/// A run of texels in a row.
#[derive(Clone, Copy)]
struct RowRun {
    row: usize,
    start: usize,
    len: usize,
}

/// A floor's sums, and the look that turns them into texels.
pub(super) struct FloorPainter<'a> {
    pub sums: &'a FloorSums,
    pub walls: &'a Walls,
    pub background: Background,
    look: Look,
    properties: Properties,
    ground: CleanFloor,
    skirting: Skirting<'a>,
    /// Noise of film and dust.
    noise: Vec<Noise>,
    spread_m: f64,
    law: FloorShader,
    dither: u32,
}

impl<'a> FloorPainter<'a> {
    pub fn new(
        sums: &'a FloorSums,
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<FloorPainter<'a>, LookError> {
        let texels_per_metre = sums.grid().texels_per_metre;
        let mut properties = look.floor.material.properties();
        let [clean, trodden] = &mut properties.roughness;
        *clean = look.floor.roughness.unwrap_or(*clean);
        *trodden = look.floor.roughness_trodden.unwrap_or(*trodden);
        let ground = CleanFloor::new(&look.floor, look.seed, texels_per_metre)?;
        let noise = film_noise(look);
        Ok(FloorPainter {
            sums,
            walls,
            law: FloorShader::new(look, &properties, simulated_people, &noise, texels_per_metre),
            noise,
            spread_m: look.film.spread_m.max(properties.least_spread_m),
            background: Background {
                base_color: ground.mean().map(|light| srgb::encode_f32(light).round() as u8),
                mask: [0; 4],
                orm: [255, (255.0 * properties.roughness[0]).round() as u8, 0],
            },
            dither: noise::key(look.seed, Channel::Dither),
            skirting: Skirting::new(walls, look.edge.clone(), look.seed),
            look: look.clone(),
            properties,
            ground,
        })
    }

    /// Shades the texels of a window, or at least the `wanted` ones, into a block of its size.
    pub fn paint(&self, window: TexelWindow, wanted: Option<&[bool]>, block: &mut ResolvedBlock) {
        BUFFERS.with_borrow_mut(|buffers| self.paint_with(buffers, window, wanted, block));
    }

    fn paint_with(
        &self,
        buffers: &mut FloorBuffers,
        window: TexelWindow,
        wanted: Option<&[bool]>,
        block: &mut ResolvedBlock,
    ) {
        let mut layout = FloorLayout {
            traffic: PassesField::over(&window, self.sums, self.walls, self.spread_m),
            noise: self.noise.iter().map(|noise| noise.over(&window)).collect(),
            ground: self.ground.over(&window),
            dust: dust::over(&window, self.walls, &self.look.dust),
        };
        self.skirting.lay_out(&window, wanted, &mut buffers.edge);
        passes::read(self.sums, Quantity::Passes, &window, &mut buffers.passes);
        passes::read(self.sums, Quantity::Soil, &window, &mut buffers.soil);
        passes::read(self.sums, Quantity::Scuff, &window, &mut buffers.scuff);
        for row in 0..window.height {
            let Some((start, len)) = run_of(row, &window, wanted) else { continue };
            let run = RowRun { row, start, len };
            layout.begin_row(row);
            layout.gather(self, &window, run, buffers);
            self.law.shade(&buffers.known, self.ground.joint, &mut buffers.shaded);
            write(self.dither, &window, run, buffers, block);
        }
    }
}

/// Returns the noises of the look's three octaves. Coarse and middle octaves have detail: a third of their variance is
/// in spots 0.4 times as large.
fn film_noise(look: &Look) -> Vec<Noise> {
    let noise = |channel, octave: Octave, size: f64, variance: f32| {
        Noise::new(look.seed, channel, [size * octave.size_m; 2], variance.sqrt() * octave.sd)
    };
    let NoiseLook { fine, middle, coarse } = look.noise;
    let all = [
        noise(Channel::Fine, fine, 1.0, 1.0),
        noise(Channel::Middle, middle, 1.0, 2.0 / 3.0),
        noise(Channel::MiddleDetail, middle, 0.4, 1.0 / 3.0),
        noise(Channel::Coarse, coarse, 1.0, 2.0 / 3.0),
        noise(Channel::CoarseDetail, coarse, 0.4, 1.0 / 3.0),
    ];
    all.into_iter().filter(|noise| !noise.is_flat()).collect()
}

/// Range from the first to the last wanted texel of a row.
fn run_of(row: usize, window: &TexelWindow, wanted: Option<&[bool]>) -> Option<(usize, usize)> {
    let Some(wanted) = wanted else { return Some((0, window.width)) };
    let wanted = &wanted[row * window.width..(row + 1) * window.width];
    let first = wanted.iter().position(|&wanted| wanted)?;
    let last = wanted.iter().rposition(|&wanted| wanted)?;
    Some((first, last + 1 - first))
}

impl FloorLayout<'_> {
    fn begin_row(&mut self, row: usize) {
        self.traffic.begin_row(row);
        self.ground.begin_row(row);
        for field in &mut self.noise {
            field.begin_row(row);
        }
        if let Some(dust) = &mut self.dust {
            dust.begin_row(row);
        }
    }

    /// Collects the shader's inputs for a run of the current row.
    fn gather(&self, painter: &FloorPainter<'_>, window: &TexelWindow, run: RowRun, buffers: &mut FloorBuffers) {
        let FloorPainter { look, properties, .. } = painter;
        let FloorBuffers { edge, passes, soil, scuff, known, row, .. } = buffers;
        known.clear(run.len);
        let from = run.row * window.width + run.start;
        let scaled = |sums: &[u32], quantity: Quantity, factor: f32, out: &mut [f32]| {
            // Without any sums the buffer is empty, and the plane stays 0.
            let unit = factor / quantity.one() as f32;
            for (out, &sum) in out.iter_mut().zip(sums.get(from..).unwrap_or_default()) {
                *out = sum as f32 * unit;
            }
        };
        self.traffic.presence(run.start, &mut known.presence, row);
        scaled(passes, Quantity::Passes, 1.0, &mut known.passes);
        scaled(soil, Quantity::Soil, look.prints.soil * properties.prints, &mut known.soil);
        scaled(scuff, Quantity::Scuff, look.scuffs.strength * properties.scuffs, &mut known.scuff);
        for (out, edge) in known.edge.iter_mut().zip(edge.get(from..).unwrap_or_default()) {
            *out = edge * properties.edge;
        }
        for field in &self.noise {
            field.add_to(run.start, &mut known.uneven);
        }
        if let Some(dust) = &self.dust {
            dust.add_to(run.start, &mut known.dust);
        }
        self.ground.read(run.start, run.len, &mut known.ground);
    }
}

fn write(dither: u32, window: &TexelWindow, run: RowRun, buffers: &mut FloorBuffers, block: &mut ResolvedBlock) {
    let FloorBuffers { known, shaded, .. } = buffers;
    let from = run.row * window.width + run.start;
    let texels = from..from + run.len;
    let (i, j) = (window.i0 + run.start as i64, window.j0 + run.row as i64);
    let mut bytes = Bytes {
        base_color: &mut block.base_color[texels.clone()],
        mask: &mut block.mask[texels.clone()],
        orm: &mut block.orm[texels.clone()],
    };
    shaded.write(dither, i, j, &mut bytes);
    block.set_clean(from, &shaded.bare);
    let planes = [&known.passes, &known.presence, &shaded.film, &shaded.soil, &known.scuff, &known.edge, &shaded.dust];
    for (layer, plane) in block.layers.iter_mut().zip(planes) {
        layer.values[texels.clone()].copy_from_slice(plane);
    }
}
