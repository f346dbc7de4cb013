//! Paints the texels of a window: lays everything out over it, then works through it row by row.

use std::cell::RefCell;

use super::block::ResolvedBlock;
use super::bytes::Bytes;
use super::dust;
use super::ground::GroundWindow;
use super::lattice::{Lattice, Window};
use super::noise::NoiseField;
use super::resolve::FloorResolver;
use super::shade::{Known, Shaded};
use super::traffic::{self, Traffic};
use crate::sums::Quantity;

/// Buffers that a thread uses again from window to window: touching fresh memory costs as much as painting.
#[derive(Default)]
struct Buffers {
    edge: Vec<f32>,
    passes: Vec<u32>,
    soil: Vec<u32>,
    scuff: Vec<u32>,
    known: Known,
    shaded: Shaded,
    row: Vec<f32>,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

/// Everything that changes from row to row.
struct Layout<'a> {
    traffic: Traffic,
    noise: Vec<NoiseField>,
    ground: GroundWindow<'a>,
    dust: Option<Lattice>,
}

/// Texels of a row.
#[derive(Clone, Copy)]
struct Run {
    row: usize,
    start: usize,
    len: usize,
}

/// Paints the texels of a window, all of them or at least those that are `wanted`. `block` has the window's size.
pub(super) fn paint(resolver: &FloorResolver<'_>, window: Window, wanted: Option<&[bool]>, block: &mut ResolvedBlock) {
    BUFFERS.with_borrow_mut(|buffers| {
        let FloorResolver { sums, walls, look, .. } = resolver;
        let mut layout = Layout {
            traffic: Traffic::over(&window, sums, walls, resolver.spread_m),
            noise: resolver.noise.iter().map(|noise| noise.over(&window)).collect(),
            ground: resolver.ground.over(&window),
            dust: dust::over(&window, walls, &look.dust),
        };
        resolver.skirting.lay_out(&window, wanted, &mut buffers.edge);
        traffic::read(sums, Quantity::Passes, &window, &mut buffers.passes);
        traffic::read(sums, Quantity::Soil, &window, &mut buffers.soil);
        traffic::read(sums, Quantity::Scuff, &window, &mut buffers.scuff);
        for row in 0..window.height {
            let Some((start, len)) = run_of(row, &window, wanted) else { continue };
            let run = Run { row, start, len };
            layout.begin_row(row);
            layout.gather(resolver, &window, run, buffers);
            resolver.law.shade(&buffers.known, resolver.ground.joint, &mut buffers.shaded);
            write(resolver, &window, run, buffers, block);
        }
    });
}

/// From the first to the last texel of a row that is wanted.
fn run_of(row: usize, window: &Window, wanted: Option<&[bool]>) -> Option<(usize, usize)> {
    let Some(wanted) = wanted else { return Some((0, window.width)) };
    let wanted = &wanted[row * window.width..(row + 1) * window.width];
    let first = wanted.iter().position(|&wanted| wanted)?;
    let last = wanted.iter().rposition(|&wanted| wanted)?;
    Some((first, last + 1 - first))
}

impl Layout<'_> {
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

    /// Everything that the law needs to know of a run of the row last begun.
    fn gather(&self, resolver: &FloorResolver<'_>, window: &Window, run: Run, buffers: &mut Buffers) {
        let FloorResolver { look, properties, .. } = resolver;
        let Buffers { edge, passes, soil, scuff, known, row, .. } = buffers;
        known.clear(run.len);
        let from = run.row * window.width + run.start;
        let scaled = |sums: &[u32], quantity: Quantity, factor: f32, out: &mut [f32]| {
            // Where there are no sums at all the buffer is empty, and the plane stays 0.
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

fn write(resolver: &FloorResolver<'_>, window: &Window, run: Run, buffers: &mut Buffers, block: &mut ResolvedBlock) {
    let Buffers { known, shaded, .. } = buffers;
    let from = run.row * window.width + run.start;
    let texels = from..from + run.len;
    let (i, j) = (window.i0 + run.start as i64, window.j0 + run.row as i64);
    let mut bytes = Bytes {
        base_color: &mut block.base_color[texels.clone()],
        mask: &mut block.mask[texels.clone()],
        orm: &mut block.orm[texels.clone()],
    };
    shaded.write(resolver.dither, i, j, &mut bytes);
    let planes = [&known.passes, &known.presence, &shaded.film, &shaded.soil, &known.scuff, &known.edge, &shaded.dust];
    for (layer, plane) in block.layers.iter_mut().zip(planes) {
        layer.values[texels.clone()].copy_from_slice(plane);
    }
}
