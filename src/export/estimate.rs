//! Estimates the size of a bake before the simulation starts.

use std::path::Path;

use super::ExportError;
use super::layout::TileLayout;
use super::options::TextureOptions;
use crate::plan::FloorPlan;
use crate::stamps::{TexelGrid, WallGrid};

/// Size above which a bake has to be confirmed, bytes.
pub const LARGE_BYTES: u64 = 20_000_000_000;

/// Bytes on disk per texel of floor, and of wall below: the mean over bakes of
/// hundreds to thousands of people. With few people it is a third; with all floor trodden, three times as much.
const FLOOR_BYTES: f64 = 2.0;
const WALL_BYTES: f64 = 0.8;
/// Factor for bakes that also write the layers as EXR.
const WITH_LAYERS: f64 = 2.0;
/// What is added to that factor where masks have 16 bits.
const FINE_MASKS: f64 = 1.2;

/// From which size on a bake is told before it starts, bytes, and from which time on, seconds.
const MUCH_BYTES: u64 = 2_000_000_000;
const MUCH_S: f64 = 120.0;
/// Processor seconds for a byte that is written, and for a second that a person walks, on a machine of 2024.
const SECONDS_PER_BYTE: f64 = 1.3e-7;
const SECONDS_PER_PERSON_S: f64 = 1.2e-5;

/// How much a bake will write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// Floor tiles.
    pub tiles: u64,
    /// Wall sheets, about.
    pub sheets: u64,
    /// Largest side of a texture, texels.
    pub tile_px: u32,
    /// Bytes of all files, about.
    pub bytes: u64,
}

impl Estimate {
    /// Estimates the textures of a plan from the areas of its floor and walls.
    ///
    /// # Errors
    /// A tile size out of range.
    pub fn of(
        plan: &FloorPlan,
        floor: TexelGrid,
        walls: Option<&WallGrid>,
        options: &TextureOptions,
    ) -> Result<Estimate, ExportError> {
        let layout = TileLayout::new(floor, options.tile)?;
        let floor_px = plan.floor.iter().filter(|&&pixel| pixel != 0).count() as f64;
        let texels_per_px = plan.metres_per_pixel * floor.texels_per_metre;
        let floor_texels = floor_px * texels_per_px * texels_per_px;
        let wall_texels = walls.map_or(0.0, |grid| {
            grid.faces.iter().map(|face| f64::from(face.width)).sum::<f64>() * f64::from(grid.height)
        });
        let layers = if options.writes_layers() { WITH_LAYERS } else { 1.0 };
        let factor = layers + if options.is_fine() { FINE_MASKS } else { 0.0 };
        Ok(Estimate {
            tiles: u64::from(layout.columns()) * u64::from(layout.rows()),
            sheets: (wall_texels / (f64::from(options.tile) * f64::from(options.tile))).ceil() as u64,
            tile_px: options.tile,
            bytes: (factor * (FLOOR_BYTES * floor_texels + WALL_BYTES * wall_texels)) as u64,
        })
    }

    /// Refuses a bake that is large or exceeds the free space on the disk of `folder`.
    ///
    /// # Errors
    /// [`ExportError::TooMuch`].
    pub fn check(&self, folder: &Path, shown: &Path) -> Result<(), ExportError> {
        let free = free_bytes(folder);
        let fits = self.bytes <= LARGE_BYTES && free.is_none_or(|free| self.bytes <= free);
        let too_much = || ExportError::TooMuch { path: shown.to_path_buf(), amount: self.describe(free) };
        if fits { Ok(()) } else { Err(too_much()) }
    }

    /// What to expect of a bake in which people walk for so many seconds in all, on so many threads; `None` if that is
    /// not much.
    pub fn tell(&self, folder: &Path, person_seconds: f64, threads: usize) -> Option<String> {
        let work_s = SECONDS_PER_BYTE * self.bytes as f64 + SECONDS_PER_PERSON_S * person_seconds;
        let seconds = work_s / threads.max(1) as f64;
        let time = if seconds < 120.0 { format!("{seconds:.0} s") } else { format!("{:.0} min", seconds / 60.0) };
        let is_much = self.bytes >= MUCH_BYTES || seconds >= MUCH_S;
        is_much.then(|| format!("this bake is large: {}, in about {time}", self.describe(free_bytes(folder))))
    }

    /// The numbers in words.
    fn describe(&self, free: Option<u64>) -> String {
        let Estimate { tiles, sheets, tile_px, bytes } = *self;
        let free = free.map_or(String::new(), |free| format!("; {} are free", size(free)));
        format!("{tiles} floor tiles and {sheets} wall sheets of up to {tile_px} px, about {}{free}", size(bytes))
    }
}

/// A number of bytes with a unit.
fn size(bytes: u64) -> String {
    match bytes {
        0..10_000_000_000 => format!("{:.1} GB", bytes as f64 / 1e9),
        _ => format!("{:.0} GB", bytes as f64 / 1e9),
    }
}

/// Returns the free disk space for this user at a folder, bytes, if the system reports it.
#[cfg(unix)]
fn free_bytes(folder: &Path) -> Option<u64> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    disk.f_bavail.checked_mul(disk.f_frsize)
}

#[cfg(not(unix))]
fn free_bytes(_folder: &Path) -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_bakes_are_refused_with_their_numbers_unless_asked_for() {
        let mut plan = FloorPlan::from_mask(500, 500, 1.0, vec![1; 250_000]);
        plan.floor[..500].fill(0);
        let options = TextureOptions::default();
        let estimate = |density: f64| {
            let grid = TexelGrid::covering(500.0, 500.0, density).unwrap();
            Estimate::of(&plan, grid, None, &options).unwrap()
        };
        let large = estimate(1000.0);
        assert_eq!((large.tiles, large.sheets), (62 * 62, 0));
        let folder = tempfile::tempdir().unwrap();
        let error = large.check(folder.path(), Path::new("out")).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("3844 floor tiles") && message.contains("998 GB"), "{message}");
        let told = large.tell(folder.path(), 0.0, 2).unwrap();
        assert!(told.contains("3844 floor tiles") && told.contains("are free, in about"), "{told}");
        let small = estimate(1.0);
        small.check(folder.path(), Path::new("out")).unwrap();
        assert_eq!(small.tell(folder.path(), 1e5, 2), None);
        // A small floor on which people walk for a year.
        assert!(small.tell(folder.path(), 3e9, 2).unwrap().contains(" min"));
    }
}
