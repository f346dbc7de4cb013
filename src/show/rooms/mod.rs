//! A plan as rooms to look at: where rays end, where lamps hang, how light falls, where cameras stand.
//!
//! Stills and the page take rays, lamps, light and cameras from here, and nowhere else.

mod cameras;
mod footfalls;
mod lens;
mod light;
mod panels;
mod ray_grid;
mod shades;
mod trace;

pub(crate) use lens::Lens;
pub(crate) use light::{Irradiance, Light, LightSources, OFF_WALL_M, WALL_HEIGHTS};
pub(crate) use panels::Panels;
pub(crate) use ray_grid::{QuadKind, RayGrid, WallQuad};
pub(crate) use shades::*;
pub(crate) use trace::{HitSurface, RayHit};

use crate::export::Camera;
use crate::sums::FloorSums;
use crate::walls::{Doorway, Walls};
use footfalls::FootfallGrid;

/// The rooms of a plan, ready to be looked at.
#[derive(Debug)]
pub struct Rooms {
    pub(crate) grid: RayGrid,
}

impl Rooms {
    /// Makes rooms of a plan's walls, `wall_height_m` high, with lintels over its doorways. Without any walls it is a floor
    /// under the sky.
    pub fn new(walls: &Walls, doorways: &[Doorway], wall_height_m: f64) -> Rooms {
        let height_m = if walls.faces.is_empty() { 0.0 } else { wall_height_m };
        Rooms { grid: RayGrid::new(walls, doorways, height_m) }
    }

    /// The camera from above that has the whole plan in a picture of a size in pixels.
    pub fn birds_eye(&self, size_px: [u32; 2]) -> Camera {
        self.grid.birds_eye(size_px)
    }

    /// The camera 1.7 m above the floor where there is most to see.
    pub fn eye_level(&self, sums: &FloorSums) -> Camera {
        self.grid.eye_level(&FootfallGrid::of(sums))
    }
}
