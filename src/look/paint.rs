//! Shades the texels of a window of the floor, row by row.

use std::cell::RefCell;
use std::sync::Arc;

use super::block::{Background, ResolvedBlock};
use super::bytes::Bytes;
use super::dust;
use super::error::LookError;
use super::lattice::{SplineLattice, TexelWindow};
use super::material::Properties;
use super::mopping::Mopping;
use super::noise::{self, Channel, Noise, NoiseField};
use super::octaves::{NoiseLook, Octave};
use super::passes::{self, PassesField};
use super::planes::each_mut;
use super::settings::Look;
use super::shade::{FloorShader, ShadeInput, ShadeOutput};
use super::skirting::Skirting;
use super::spots::Spots;
use super::surface::{Surface, SurfacePlanes};
use super::wet::{WetFloor, WetWindow};
use crate::math::{exp_f32, srgb};
use crate::sums::{FloorSums, Quantity};
use crate::walls::Walls;

/// Buffers that a thread reuses between windows: touching fresh memory costs as much as painting.
#[derive(Default)]
struct FloorBuffers {
    /// Share of each texel on which no furniture stands; empty without furniture.
    free: Vec<f32>,
    edge: Vec<f32>,
    passes: Vec<u32>,
    soil: Vec<u32>,
    scuff: Vec<u32>,
    wheels: Vec<u32>,
    surface: SurfacePlanes,
    spots: Spots,
    known: ShadeInput,
    shaded: ShadeOutput,
    row: Vec<f32>,
}

thread_local! {
    static BUFFERS: RefCell<FloorBuffers> = RefCell::default();
}

/// Fields that are evaluated row by row.
struct FloorLayout {
    /// Presence, standing time, effort beyond straight steps, and wheels; `None` where there is none.
    traffic: [Option<PassesField>; 4],
    noise: Vec<NoiseField>,
    mopping: Option<SplineLattice>,
    dust: Option<SplineLattice>,
    wet: Option<WetWindow>,
}

/// What the optical density of heel marks, gum and rubs tends to where many lie on each other.
const MOST_MARKS: f32 = 0.5;

/// What the optical density of dry prints tends to: a sole leaves what it carries, and even a muddy one no black hole.
const MOST_SOIL: f32 = 0.7;

/// Standard deviation of the Gaussian that evens out where people stood, metres: the simulated ones stand for many.
const STANDING_SPREAD_M: f64 = 0.1;

/// The same for wheels: those who were not simulated rolled beside.
const ROLLING_SPREAD_M: f64 = 0.25;

/// What a mop leaves under furniture, relative to the mean.
const UNCLEANED: f32 = 1.6;

/// Occlusion at the foot of a wall, and in a joint.
const CORNER_SHADE: f32 = 0.45;
const JOINT_SHADE: f32 = 0.35;
/// Levels of the height per millimetre.
const HEIGHT_PER_MM: f32 = 25.0;

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
    /// Wheels in coarse cells, see [`passes::coarse`].
    rolled: Arc<FloorSums>,
    pub walls: &'a Walls,
    pub background: Background,
    look: Look,
    properties: Properties,
    ground: Surface,
    mopping: Option<Mopping>,
    wet: Option<WetFloor>,
    skirting: Skirting<'a>,
    /// Noise of film and dust.
    noise: Vec<Noise>,
    spread_m: f64,
    law: FloorShader,
    dither: u32,
}

impl<'a> FloorPainter<'a> {
    pub fn new(
        (sums, rolled): (&'a FloorSums, &Arc<FloorSums>),
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<FloorPainter<'a>, LookError> {
        let texels_per_metre = sums.grid().texels_per_metre;
        let mut properties = look.floor.material.properties();
        let [clean, trodden] = &mut properties.roughness;
        *clean = look.floor.roughness.unwrap_or(*clean);
        *trodden = look.floor.roughness_trodden.unwrap_or(*trodden);
        let ground = Surface::new(&look.floor, look.seed, texels_per_metre)?;
        if let (Some(mean), None) = (ground.mean_roughness(), look.floor.roughness) {
            let change =
                look.floor.roughness_trodden.map_or(properties.roughness[1] - properties.roughness[0], |to| to - mean);
            properties.roughness = [mean, (mean + change).clamp(0.0, 1.0)];
        }
        let noise = film_noise(look, texels_per_metre);
        Ok(FloorPainter {
            sums,
            rolled: Arc::clone(rolled),
            walls,
            law: FloorShader::new(look, &properties, ground.mean(), simulated_people, &noise, texels_per_metre),
            noise,
            spread_m: look.film.spread_m.max(properties.least_spread_m),
            background: Background {
                base_color: ground.mean().map(|light| srgb::encode_f32(light).round() as u8),
                mask: [0; 4],
                orm: [255, (255.0 * properties.roughness[0]).round() as u8, 0],
            },
            dither: noise::key(look.seed, Channel::Dither),
            mopping: Mopping::new(walls, &look.mop, (look.seed, look.total_passes)),
            wet: WetFloor::new(look, &properties, sums),
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
            traffic: [
                (self.sums, Quantity::Presence, self.spread_m),
                (self.sums, Quantity::Dwell, self.spread_m.max(STANDING_SPREAD_M)),
                (self.sums, Quantity::Grind, self.spread_m),
                (&*self.rolled, passes::COARSE, self.spread_m.max(ROLLING_SPREAD_M)),
            ]
            .map(|(sums, quantity, spread_m)| PassesField::over(&window, (sums, quantity), self.walls, spread_m)),
            noise: self.noise.iter().map(|noise| noise.over(&window)).collect(),
            mopping: self.mopping.as_ref().map(|mopping| mopping.over(&window)),
            dust: dust::over(&window, self.walls, &self.look.dust),
            wet: self.wet.as_ref().and_then(|wet| wet.over(&window, self.sums, self.walls)),
        };
        buffers.free.clear();
        if self.walls.has_furniture() {
            let TexelWindow { texels_per_metre, i0, j0, width, height } = window;
            buffers.free.resize(window.texels(), 0.0);
            self.walls.coverage(texels_per_metre, i0, j0, width, height, &mut buffers.free);
        }
        self.skirting.lay_out(&window, wanted, &mut buffers.edge);
        passes::read(self.sums, Quantity::Passes, &window, &mut buffers.passes);
        passes::read(self.sums, Quantity::Soil, &window, &mut buffers.soil);
        passes::read(self.sums, Quantity::Scuff, &window, &mut buffers.scuff);
        passes::read(self.sums, Quantity::Wheels, &window, &mut buffers.wheels);
        self.ground.lay_out(&window.with_neighbours(), &mut buffers.surface);
        let near = |quantity: Quantity| move |place| self.law.weight * passes::near(self.sums, quantity, place);
        let traffic = (near(Quantity::Presence), near(Quantity::Dwell));
        buffers.spots.lay_out(&window, (&self.look.age, &self.look.dwell), self.look.seed, traffic);
        for row in 0..window.height {
            let Some((start, len)) = run_of(row, &window, wanted) else { continue };
            let run = RowRun { row, start, len };
            layout.begin_row(row);
            layout.gather(self, &window, run, buffers);
            self.law.shade(&mut buffers.known, self.ground.joint, &mut buffers.shaded);
            write(self.dither, &window, run, buffers, block);
        }
    }
}

/// Returns the noises of the look's three octaves. Coarse and middle octaves have detail: a third of their variance is
/// in spots 0.4 times as large. The grain has grain of its own, where texels show it.
fn film_noise(look: &Look, texels_per_metre: f64) -> Vec<Noise> {
    let noise = |channel, octave: Octave, size: f64, variance: f32| {
        Noise::new(look.seed, channel, [size * octave.size_m; 2], variance.sqrt() * octave.sd).turned()
    };
    let NoiseLook { fine, middle, coarse } = look.noise;
    let all = [
        noise(Channel::Fine, fine, 1.0, 1.0),
        noise(Channel::FineDetail, fine, 0.22, if 0.22 * fine.size_m * texels_per_metre < 1.0 { 0.0 } else { 1.0 }),
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

impl FloorLayout {
    fn begin_row(&mut self, row: usize) {
        for field in self.traffic.iter_mut().flatten() {
            field.begin_row(row);
        }
        for field in &mut self.noise {
            field.begin_row(row);
        }
        if let Some(dust) = &mut self.dust {
            dust.begin_row(row);
        }
        if let Some(mopping) = &mut self.mopping {
            mopping.begin_row(row);
        }
        if let Some(wet) = &mut self.wet {
            wet.begin_row(row);
        }
    }

    /// Collects the shader's inputs for a run of the current row.
    fn gather(&self, painter: &FloorPainter<'_>, window: &TexelWindow, run: RowRun, buffers: &mut FloorBuffers) {
        let FloorPainter { look, properties, .. } = painter;
        let FloorBuffers { free, edge, passes, soil, scuff, wheels, surface, spots, known, row, .. } = buffers;
        known.clear(run.len);
        let from = run.row * window.width + run.start;
        let scaled = |sums: &[u32], quantity: Quantity, factor: f32, out: &mut [f32]| {
            // Without any sums the buffer is empty, and the plane stays 0.
            let unit = factor / quantity.one() as f32;
            for (out, &sum) in out.iter_mut().zip(sums.get(from..).unwrap_or_default()) {
                *out = sum as f32 * unit;
            }
        };
        let planes = [&mut known.presence, &mut known.dwell, &mut known.grind, &mut known.rolled];
        for (field, out) in self.traffic.iter().zip(planes) {
            if let Some(field) = field {
                field.values(run.start, out, row);
            }
        }
        scaled(passes, Quantity::Passes, 1.0, &mut known.passes);
        scaled(wheels, Quantity::Wheels, 1.0, &mut known.wheels);
        scaled(soil, Quantity::Soil, look.prints.soil * properties.prints, &mut known.soil);
        each_mut(&mut known.soil, |density| MOST_SOIL * (1.0 - exp_f32(-density / MOST_SOIL)));
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
        for (out, spot) in known.soil.iter_mut().zip(spots.stains.get(from..).unwrap_or_default()) {
            *out += spot * properties.spots;
        }
        for (out, spot) in known.scuff.iter_mut().zip(spots.marks.get(from..).unwrap_or_default()) {
            *out += spot * properties.spots;
        }
        if let (Some(window), Some(wet)) = (&self.wet, &painter.wet) {
            wet.add_to(window, run.start, &mut known.soil, &mut known.water, row);
        }
        // Marks on marks go on darkening ever less.
        each_mut(&mut known.scuff, |density| MOST_MARKS * (1.0 - exp_f32(-density / MOST_MARKS)));
        match (&self.mopping, &painter.mopping) {
            (Some(pattern), Some(mopping)) => {
                pattern.add_to(run.start, &mut known.left);
                mopping.film_left(&mut known.left, &known.dust, look.dust.reach_m);
            }
            _ => known.left.fill(1.0),
        }
        for (k, _) in free.iter().skip(from).take(run.len).enumerate().filter(|(_, free)| **free == 0.0) {
            // Nobody cleans under furniture; dirt along its foot lies before it.
            (known.edge[k], known.dust[k], known.left[k]) = (0.0, 1.0, UNCLEANED);
        }
        let ShadeInput { ground, .. } = known;
        let above = in_surface(run, window);
        let [red, green, blue] = &mut ground.rgb;
        let [r, g, b] = &surface.rgb;
        let planes = [(red, r), (green, g), (blue, b), (&mut ground.joint, &surface.joint)];
        let more = [(&mut ground.height, &surface.height), (&mut ground.rough, &surface.rough)];
        for (out, plane) in planes.into_iter().chain(more) {
            out.clear();
            out.extend_from_slice(&plane[above..above + run.len]);
        }
    }
}

/// Place of a run in the planes of the surface, which have a column and a row more.
fn in_surface(run: RowRun, window: &TexelWindow) -> usize {
    (run.row + 1) * (window.width + 1) + run.start + 1
}

fn write(dither: u32, window: &TexelWindow, run: RowRun, buffers: &mut FloorBuffers, block: &mut ResolvedBlock) {
    let FloorBuffers { free, surface, known, shaded, .. } = buffers;
    let from = run.row * window.width + run.start;
    let texels = from..from + run.len;
    let (i, j) = (window.i0 + run.start as i64, window.j0 + run.row as i64);
    let mut bytes = Bytes {
        base_color: &mut block.base_color[texels.clone()],
        mask: &mut block.mask[texels.clone()],
        orm: &mut block.orm[texels.clone()],
    };
    shaded.write(dither, i, j, &mut bytes);
    // Corners at walls and joints see less of the room. Furniture may be taken away.
    for (k, (orm, joint)) in bytes.orm.iter_mut().zip(&known.ground.joint).enumerate() {
        let is_beneath = free.get(from + k) == Some(&0.0);
        let corner = if is_beneath { 0.0 } else { known.dust[k].max(0.0) };
        orm[0] = (255.0 * (1.0 - CORNER_SHADE * corner * corner) * (1.0 - JOINT_SHADE * joint) + 0.5) as u8;
    }
    let (above, stride) = (in_surface(run, window), window.width + 1);
    let per_m = 0.001 * window.texels_per_metre as f32;
    for k in 0..run.len {
        let height = |back: usize| surface.height[above + k - back];
        let slope = |back: usize| per_m * (height(0) - height(back));
        let lean = surface.lean.each_ref().map(|plane| plane.get(above + k).map(|lean| -lean));
        let (x, y) = (lean[0].unwrap_or_else(|| slope(1)), lean[1].unwrap_or_else(|| slope(stride)));
        let [worn, marks] = shaded.worn(k);
        let raised = (128.5 + HEIGHT_PER_MM * height(0)).clamp(0.0, 255.0) as u8;
        block.relief[from + k][..3].copy_from_slice(&[worn, marks, raised]);
        if let Some(fine) = block.fine.get_mut(from + k) {
            let raised = 0.5 + HEIGHT_PER_MM / 255.0 * height(0);
            let [passes, worn] = shaded.passes_and_wear(k);
            *fine = [passes, worn, raised].map(|share| (65_535.0 * share.clamp(0.0, 1.0) + 0.5) as u16);
        }
        block.set_normal(from + k, [x, y]);
    }
    block.set_clean(from, &shaded.bare);
    let ShadeInput { passes, presence, dwell, grind, wheels, scuff, edge, .. } = &*known;
    let planes = [passes, presence, dwell, grind, wheels, &shaded.film, &shaded.soil, scuff, edge, &shaded.dust];
    for (layer, plane) in block.layers.iter_mut().zip(planes) {
        layer.values[texels.clone()].copy_from_slice(plane);
    }
}
