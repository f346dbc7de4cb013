//! Stills of a bake in perspective: the whole plan from above, its rooms from the height of eyes, any other view.
//!
//! The plan is upright walls on a level floor. Each ray from the camera is followed through a grid of wall pieces to its
//! first hit. Lamps in the ceiling light the hit (from above: a soft sky and a large lamp at one side), corners are darker,
//! and smooth floors reflect lamps and daylight, the rougher the more blurred. The picture has no random part and does not
//! depend on threads: the same bytes on every machine.

use image::RgbImage;

use crate::export::{Birdseye, Camera, ExportError, OutputFolder, StillEntry, TextureSource, WallSource, WallTextures};
use crate::look::{Background, StainLook};
use crate::math::Vec2;
use crate::math::srgb::light_of;
use crate::progress::{Progress, Stage};
use crate::show::rooms::floor_tint;
use crate::show::{Rooms, write_picture};

mod error;
mod glow;
mod leaf_dirt;
mod light_map;
mod pyramid;
mod render;
mod sampler;
mod shade;
mod texels;
mod tone;

pub use error::StillError;

use render::Renderer;
use sampler::SurfaceSampler;
use texels::{FloorTexels, PlainWalls, SmallFloor, SmallWalls, Texel, TexelSource, WallTexels};

/// Width and height of a bake's stills, pixels.
pub const STILL_SIZE_PX: [u32; 2] = [1280, 720];
/// The same of a first look: a floor coarser than this many texels per metre has little for larger ones to show.
const COARSE_STILL_SIZE_PX: [u32; 2] = [480, 270];
const COARSE_TEXELS_PER_METRE: f64 = 50.0;
/// Least and greatest width or height of a still, pixels.
pub const STILL_SIZES_PX: [u32; 2] = [16, 8192];

/// Texel sources of floor and walls.
#[derive(Clone, Copy)]
pub struct Surfaces<'a, S> {
    /// The floor at its own texel density.
    pub floor: &'a S,
    /// Texels per metre of the floor.
    pub floor_texels_per_metre: f64,
    /// The reduced floor, for distant places; without it, every visible texel is resolved.
    pub small: Option<&'a Birdseye>,
    /// The walls; without them, all are plain.
    pub walls: Option<WallSurfaces<'a>>,
}

/// Texel sources of walls.
#[derive(Clone, Copy)]
pub struct WallSurfaces<'a> {
    /// The walls at their own texel density.
    pub source: &'a dyn WallSource,
    /// Texels per metre of the walls.
    pub texels_per_metre: f64,
    /// Texel source of walls that are far away.
    pub far: FarWalls<'a>,
}

/// Texel source of walls that are far away.
#[derive(Clone, Copy)]
pub enum FarWalls<'a> {
    /// The walls themselves, resolved as far as one sees.
    Resolved,
    /// Their textures, made small.
    Textures(&'a WallTextures),
    /// The clean wall's mean colour.
    Plain,
}

impl Rooms {
    /// Checks that a camera below the walls' height stands on the floor.
    ///
    /// # Errors
    /// A number out of range; a camera inside a wall or beyond the plan.
    pub fn check(&self, camera: &Camera) -> Result<(), StillError> {
        camera.check()?;
        let place = camera.place_m();
        if camera.position_m[2] >= self.grid.height_m || self.grid.is_floor(place) {
            return Ok(());
        }
        let nearest = self.grid.nearest_floor(place);
        Err(StillError::NotOnFloor {
            place_m: place.into(),
            beyond: !self.grid.block.contains(place),
            nearest_m: hundredths(nearest).into(),
            wall_height_m: self.grid.height_m,
        })
    }

    /// Draws the view of a camera, once for each of `coats`, in the current rayon pool.
    ///
    /// # Errors
    /// As [`Rooms::check`]; a size out of [`STILL_SIZES_PX`]; an interruption.
    pub fn draw<S: TextureSource>(
        &self,
        camera: &Camera,
        size_px: [u32; 2],
        coats: &[Surfaces<S>],
        progress: &dyn Progress,
    ) -> Result<Vec<RgbImage>, StillError> {
        self.check(camera)?;
        check_size(size_px)?;
        let sheets: Vec<SurfaceTexels<S>> =
            coats.iter().map(|coat| SurfaceTexels::of(coat, self.grid.height_m)).collect();
        let mut skins: Vec<SurfaceSampler> = sheets.iter().map(SurfaceTexels::skin).collect();
        let done = |share: f64| progress.advance(Stage::Stills, share);
        Ok(Renderer::new(&self.grid, camera, size_px).draw(&mut skins, progress, done)?)
    }
}

/// A coat's sources.
struct SurfaceTexels<'a, S> {
    floor: FloorTexels<'a, S>,
    small: Option<SmallFloor>,
    walls: Box<dyn TexelSource + 'a>,
    plain_wall: Texel,
    far_walls: Option<Box<dyn TexelSource + 'a>>,
    leaf_stains: Option<[StainLook; 2]>,
}

impl<'a, S: TextureSource> SurfaceTexels<'a, S> {
    fn of(coat: &Surfaces<'a, S>, height_m: f64) -> SurfaceTexels<'a, S> {
        let background = coat.floor.background();
        let plain = |background: Background, density: f64| Box::new(PlainWalls::of(background, density));
        let unknown = Background { base_color: [226, 222, 212], mask: [0; 4], orm: [255, 160, 0] };
        SurfaceTexels {
            floor: FloorTexels { source: coat.floor, texels_per_metre: coat.floor_texels_per_metre },
            small: coat.small.map(|small| SmallFloor {
                picture: small.picture(background.base_color),
                pixels_per_metre: small.pixels_per_metre(),
                roughness: small.roughness(background.orm[1]),
            }),
            walls: match coat.walls {
                Some(WallSurfaces { source, texels_per_metre, .. }) => {
                    Box::new(WallTexels { source, texels_per_metre, height_m })
                }
                None => plain(unknown, 100.0),
            },
            leaf_stains: coat.walls.and_then(|walls| walls.source.leaf_stains()),
            plain_wall: PlainWalls::of(coat.walls.map_or(unknown, |walls| walls.source.background()), 1.0).texel,
            far_walls: coat.walls.and_then(|walls| {
                let background = walls.source.background();
                match walls.far {
                    FarWalls::Resolved => None,
                    FarWalls::Textures(textures) => {
                        SmallWalls::of(textures, background).map(|small| Box::new(small) as Box<dyn TexelSource>)
                    }
                    FarWalls::Plain => Some(plain(background, walls.texels_per_metre * 0.25) as Box<dyn TexelSource>),
                }
            }),
        }
    }

    fn skin(&self) -> SurfaceSampler<'_> {
        let small = self.small.as_ref().map(|small| small as &dyn TexelSource);
        let mut skin =
            SurfaceSampler::new([&self.floor, &*self.walls], [small, self.far_walls.as_deref()], self.plain_wall);
        skin.leaf_stains = self.leaf_stains;
        skin.floor_tint = floor_tint(light_of(self.floor.source.background().base_color));
        skin
    }
}

/// Checks a picture's size.
///
/// # Errors
/// [`StillError::Size`].
pub(crate) fn check_size([width, height]: [u32; 2]) -> Result<(), StillError> {
    let [low, high] = STILL_SIZES_PX;
    let fits = [width, height].iter().all(|side| (low..=high).contains(side));
    fits.then_some(()).ok_or(StillError::Size { width, height, low, high })
}

/// Writes the stills of a bake into `preview/`: `birds_eye.png` from the first camera, `eye_level.png` and
/// `eye_level_clean.png` from the second.
///
/// # Errors
/// A file cannot be written; an interruption.
pub(crate) fn write_stills<S: TextureSource>(
    folder: &OutputFolder,
    rooms: &Rooms,
    [above, inside]: [Camera; 2],
    [trodden, clean]: [Surfaces<S>; 2],
    progress: &dyn Progress,
) -> Result<Vec<StillEntry>, StillError> {
    let is_coarse = trodden.floor_texels_per_metre < COARSE_TEXELS_PER_METRE;
    let size = if is_coarse { COARSE_STILL_SIZE_PX } else { STILL_SIZE_PX };
    let from_above = rooms.draw(&above, size, &[Surfaces { ..trodden }], progress)?;
    let from_inside = rooms.draw(&inside, size, &[trodden, clean], progress)?;
    let names = ["birds_eye", "eye_level", "eye_level_clean"];
    let cameras = [above, inside, inside];
    let entries: Vec<StillEntry> = names
        .iter()
        .zip(cameras)
        .map(|(name, camera)| StillEntry { file: format!("preview/{name}.png"), camera })
        .collect();
    let pictures: Vec<RgbImage> = from_above.into_iter().chain(from_inside).collect();
    let write = |(entry, picture): (&StillEntry, &RgbImage)| write_picture(folder, &entry.file, picture);
    use rayon::prelude::*;
    entries.par_iter().zip(&pictures).map(write).collect::<Result<(), ExportError>>()?;
    Ok(entries)
}

/// Rounds to centimetres, for messages.
fn hundredths(p: Vec2) -> Vec2 {
    Vec2 { x: (p.x * 100.0).round() / 100.0, y: (p.y * 100.0).round() / 100.0 }
}
