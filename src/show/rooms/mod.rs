//! A plan as rooms to look at: where rays end, where lamps hang, how light falls, where cameras stand.
//!
//! Stills and the page take rays, lamps, light and cameras from here, and nowhere else.

mod cameras;
mod cells;
mod fittings;
mod footfalls;
mod lens;
mod light;
mod panels;
mod ray_grid;
mod shades;
mod trace;

pub(crate) use fittings::{Finish, Fittings, LeafUse};
pub(crate) use lens::Lens;
pub(crate) use light::{Irradiance, Light, LightSources, OFF_WALL_M};
pub(crate) use panels::{Panel, Panels, TILE_M};
pub(crate) use ray_grid::{QuadKind, RayGrid, WallQuad};
pub(crate) use shades::*;
pub(crate) use trace::{HitSurface, RayHit};

use serde::{Deserialize, Serialize};

use crate::export::Camera;
use crate::look::WallLook;
use crate::math::vec2;
use crate::options::names;
use crate::sums::FloorSums;
use crate::walls::{Doorway, Walls};
use footfalls::FootfallGrid;

names!(Ceiling);

/// What is over the rooms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Ceiling {
    /// Tiles with lamps between them.
    #[default]
    Lamps,
    /// Nothing: sky and sun, as in a yard.
    None,
}

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

    /// The rooms with something else over them.
    pub(crate) fn under(mut self, ceiling: Ceiling) -> Rooms {
        self.grid.roofed = ceiling == Ceiling::Lamps && !self.grid.is_open();
        self
    }

    /// The rooms with frames around their doors, as the look has them on jambs.
    pub(crate) fn framed(mut self, look: &WallLook) -> Rooms {
        self.grid.frame = (look.frame_m > 0.0).then_some((look.frame_m, look.frame_colour));
        self
    }

    /// The rooms with door leaves as dirty as people walk through their doors.
    pub(crate) fn walked(mut self, sums: &FloorSums) -> Rooms {
        let traffic = FootfallGrid::of(sums);
        for leaf in self.grid.fittings.all.iter_mut().filter_map(|fitting| fitting.leaf.as_mut()) {
            let around = (0..64).map(|k| vec2(f64::from(k % 8) - 3.5, f64::from(k / 8) - 3.5) * (0.25 * leaf.length_m));
            let near = around.filter(|away| away.length() < leaf.length_m);
            leaf.used = near.map(|away| traffic.at(leaf.hinge + away)).fold(0.0, f32::max);
        }
        self
    }

    /// The lamps, where there is a ceiling.
    pub(crate) fn panels(&self) -> Vec<Panel> {
        if self.grid.roofed { Panels::over(&self.grid).all().copied().collect() } else { Vec::new() }
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
