//! Paints the texels of a window of a strip: lays everything out over it, then works through it row by row.

use std::cell::RefCell;

use super::plaster::PlasterWindow;
use super::resolve::WallResolver;
use super::shade::{WallKnown, WallShaded};
use super::splash::SplashWindow;
use super::strip::Strip;
use super::touches::Touches;
use crate::look::block::ResolvedBlock;
use crate::look::bytes::Bytes;
use crate::look::lattice::Window;
use crate::look::noise::{Noise, NoiseField};
use crate::patterns::Cause;
use crate::stamps::DENSITY_ONE;

/// Buffers that a thread uses again from window to window.
#[derive(Default)]
struct Buffers {
    known: WallKnown,
    shaded: WallShaded,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

/// Everything that changes from row to row.
struct Layout<'a> {
    plaster: PlasterWindow<'a>,
    /// By cause.
    touches: [Option<Touches>; 5],
    splash: Option<SplashWindow>,
    noise: Vec<NoiseField>,
    /// Whether there may be dirt.
    dirty: bool,
}

/// Paints all texels of a window that lies within the strip, `block` has its size; `false` if all of them show the
/// background, of which nothing need be painted.
pub(super) fn paint(resolver: &WallResolver<'_>, strip: &Strip, window: &Window, block: &mut ResolvedBlock) -> bool {
    BUFFERS.with_borrow_mut(|buffers| {
        let mut layout = Layout::over(resolver, strip, window);
        let even = resolver.plaster.is_even();
        let all_wall = resolver.plaster.is_above_board(window.j0, window.texels_per_metre);
        if even && all_wall && !layout.dirty {
            let all = 0..window.texels();
            block.clear(all, resolver.background());
            return false;
        }
        let mut any = !(even && all_wall);
        for row in 0..window.height {
            layout.begin_row(row);
            layout.gather(resolver, window, row, buffers);
            any |= resolver.law.shade(&buffers.known, &mut buffers.shaded);
            write(resolver, strip, window, row, buffers, block);
        }
        any
    })
}

impl<'a> Layout<'a> {
    fn over(resolver: &'a WallResolver<'_>, strip: &Strip, window: &Window) -> Layout<'a> {
        let WallResolver { law, stains, sums, .. } = resolver;
        let touches = std::array::from_fn(|n| {
            let over =
                || Touches::over(window, strip, sums, Cause::WALL[n], law.evens_out().then_some(stains[n].spread_m));
            law.takes(n).then(over).flatten()
        });
        let splash = resolver.splash.over(window, strip);
        let low_m = (window.j0 as f64 + 0.5) / window.texels_per_metre;
        let dirty = splash.is_some() || touches.iter().any(Option::is_some) || law.dust_from(low_m as f32);
        let noise = |noise: &Noise| noise.over_strip(window, strip.salt, strip.width, strip.closed);
        Layout {
            plaster: resolver.plaster.over(window, strip),
            touches,
            splash,
            noise: if dirty { resolver.noise.iter().map(noise).collect() } else { Vec::new() },
            dirty,
        }
    }

    fn begin_row(&mut self, row: usize) {
        self.plaster.begin_row(row);
        for touches in self.touches.iter_mut().flatten() {
            touches.begin_row(row);
        }
        if let Some(splash) = &mut self.splash {
            splash.begin_row(row);
        }
        for field in &mut self.noise {
            field.begin_row(row);
        }
    }

    /// Everything that the law needs to know of the row last begun.
    fn gather(&self, resolver: &WallResolver<'_>, window: &Window, row: usize, buffers: &mut Buffers) {
        let Buffers { known, .. } = buffers;
        self.plaster.read(&mut known.plaster);
        known.height_m = ((window.j0 + row as i64) as f64 + 0.5) as f32 / window.texels_per_metre as f32;
        let unit = 1.0 / DENSITY_ONE;
        for ((touches, single), expected) in self.touches.iter().zip(&mut known.single).zip(&mut known.expected) {
            single.clear();
            expected.clear();
            if let Some(touches) = touches {
                let sums = &touches.single[row * window.width..][..window.width];
                expected.resize(window.width, 0.0);
                touches.expected(expected);
                if sums.iter().any(|&sum| sum > 0) || expected.iter().any(|&expected| expected > 0.0) {
                    single.extend(sums.iter().map(|&sum| sum as f32 * unit));
                }
            }
        }
        known.splash.clear();
        if let Some(splash) = &self.splash {
            known.splash.resize(window.width, 0.0);
            splash.read(resolver.law.splash, &mut known.splash);
            if known.splash.iter().all(|&density| density == 0.0) {
                known.splash.clear();
            }
        }
        known.uneven.clear();
        known.uneven.resize(if self.noise.is_empty() { 0 } else { window.width }, 0.0);
        for field in &self.noise {
            field.add_to(0, &mut known.uneven);
        }
    }
}

fn write(
    resolver: &WallResolver<'_>,
    strip: &Strip,
    window: &Window,
    row: usize,
    buffers: &mut Buffers,
    block: &mut ResolvedBlock,
) {
    let Buffers { known, shaded } = buffers;
    let texels = row * window.width..(row + 1) * window.width;
    let mut bytes = Bytes {
        base_color: &mut block.base_color[texels.clone()],
        mask: &mut block.mask[texels.clone()],
        orm: &mut block.orm[texels.clone()],
    };
    shaded.write(resolver.dither ^ strip.salt, window.i0, window.j0 + row as i64, &mut bytes);
    if resolver.plaster.is_even() {
        // Without dither, which no file packs.
        let (colour, orm) = known.even_bytes(&resolver.law);
        for ((total, base_color), out) in shaded.total.iter().zip(&mut *bytes.base_color).zip(&mut *bytes.orm) {
            if *total == 0.0 {
                (*base_color, *out) = (colour, orm);
            }
        }
    }
    for (layer, plane) in block.layers.iter_mut().zip(&shaded.density) {
        let values = &mut layer.values[texels.clone()];
        if plane.is_empty() { values.fill(0.0) } else { values.copy_from_slice(plane) }
    }
}
