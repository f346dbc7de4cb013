//! Our floor of the same place: as many people over each spot as the photograph shows, resolved with a look.

use super::photo::FloorPicture;
use crate::look::error::LookError;
use crate::look::resolve::FloorResolver;
use crate::look::settings::Look;
use crate::math::srgb;
use crate::patterns::PixelRaster;
use crate::plan::FloorPlan;
use crate::stamps::TexelGrid;
use crate::sums::{FloorSums, Quantity};
use crate::walls::{Walls, WallsOptions};

/// How far the floor goes on beyond the photograph where there is no wall, metres.
const BEYOND_M: f64 = 1.0;
/// Standard deviation of what a pixel shows, of a pixel: its own size, that of the lens, and sampling between pixels.
const BLUR_PX: f64 = 0.65;
/// Most people over a spot that sums hold.
const MOST_PASSES: f64 = 4e6;

/// Walls and sums of the photographed floor.
pub(super) struct OurFloor {
    walls: Walls,
    sums: FloorSums,
    beyond: usize,
    size: [usize; 2],
    /// Share of each neighbour in a texel, as the camera blurs it.
    blur: f32,
}

impl OurFloor {
    /// A floor of `passes` per texel, the upper row first, seen through a camera of so many pixels per texel.
    pub fn new(passes: &PixelRaster, texels_per_metre: f64, walls: [bool; 4], pixels_per_texel: f64) -> OurFloor {
        let beyond = (BEYOND_M * texels_per_metre).ceil() as usize;
        let (width, height) = (passes.width, passes.height);
        let (columns, rows) = (width + 2 * beyond, height + 2 * beyond);
        let [upper, right, lower, left] = walls;
        let is_floor = |x: usize, y: usize| {
            !(upper && y < beyond
                || lower && y >= beyond + height
                || left && x < beyond
                || right && x >= beyond + width)
        };
        let mask = (0..columns * rows).map(|at| u8::from(is_floor(at % columns, at / columns))).collect();
        let plan = FloorPlan::from_mask(columns as u32, rows as u32, 1.0 / texels_per_metre, mask);
        let grid = TexelGrid { texels_per_metre, width: columns as u32, height: rows as u32 };
        let mut sums = FloorSums::new(grid);
        let cell = grid.texels_per_presence_cell() as usize;
        for (quantity, side) in [(Quantity::Passes, 1), (Quantity::Presence, cell)] {
            let grid = sums.grid_of(quantity);
            let at = |k: u32, count: usize| (k as usize * side + side / 2).saturating_sub(beyond).min(count - 1);
            let one = f64::from(quantity.one());
            let values: Vec<u32> = (0..grid.height)
                .flat_map(|j| (0..grid.width).map(move |i| (i, j)))
                .map(|(i, j)| {
                    let passes = passes.values[(height - 1 - at(j, height)) * width + at(i, width)];
                    (f64::from(passes).clamp(0.0, MOST_PASSES) * one).min(4e9) as u32
                })
                .collect();
            sums.add_block(quantity, 0, 0, grid.width as usize, grid.height as usize, &values);
        }
        OurFloor {
            walls: Walls::trace(&plan, &WallsOptions::default()),
            sums,
            beyond,
            size: [width, height],
            blur: blur(pixels_per_texel),
        }
    }

    pub fn texels_per_metre(&self) -> f64 {
        self.sums.grid().texels_per_metre
    }

    /// The floor with a look, and without its dirt if that is asked for.
    pub fn resolved(&self, look: &Look, with_bare: bool) -> Result<(FloorPicture, Option<FloorPicture>), LookError> {
        let texels_per_metre = self.texels_per_metre();
        let simulated = look.total_passes.min(u64::from(u32::MAX)) as u32;
        let resolver = FloorResolver::new(&self.sums, &self.walls, look, simulated)?;
        let [width, height] = self.size;
        let block = resolver.resolve(self.beyond as i64, self.beyond as i64, width, height);
        let picture = |light: &dyn Fn(usize, usize) -> f32| FloorPicture {
            texels_per_metre,
            rgb: [0, 1, 2].map(|c| PixelRaster::from_fn(width, height, |x, y| light((height - 1 - y) * width + x, c))),
        };
        let mut shown = picture(&|at, c| srgb::light(block.base_color[at][c]));
        shown.rgb.iter_mut().for_each(|plane| blurred(plane, self.blur));
        Ok((shown, with_bare.then(|| picture(&|at, c| f32::from(block.clean[at][c]) / 65_535.0))))
    }
}

/// Share of each neighbour that gives the variance of the camera's blur.
fn blur(pixels_per_texel: f64) -> f32 {
    let sd = BLUR_PX / pixels_per_texel;
    (0.5 * sd * sd).min(0.25) as f32
}

/// Mixes texels with their four neighbours.
fn blurred(plane: &mut PixelRaster, share: f32) {
    let (width, height) = (plane.width, plane.height);
    for [from, to, step] in [[1, 0, 1], [0, 1, width]] {
        let before = plane.values.clone();
        for y in to..height - to {
            for x in from..width - from {
                let at = y * width + x;
                plane.values[at] += share * (before[at - step] + before[at + step] - 2.0 * before[at]);
            }
        }
    }
}
