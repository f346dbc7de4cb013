//! One bake at several ages.

use std::path::{Path, PathBuf};

use super::{ResolveOptions, resolve};
use crate::Error;
use crate::export::{self, Manifest, Report};
use crate::look::{Look, LookError};
use crate::progress::Progress;
use crate::show;

/// Pictures of a bake that make no flip-book.
const STILL: [&str; 2] = [show::PATHS_FILE, "preview/eye_level_clean.png"];

/// Resolves a bake once for each history in `passes`, to the folders `passes_N` in `folder`, and puts their pictures together
/// as flip-books there: animated PNGs. Walls age with the floor. `options.folder` is not used.
///
/// # Errors
/// No history; as [`resolve`]; a flip-book that cannot be written. What was resolved before an error stays.
pub fn resolve_series(
    bake: &Path,
    options: &ResolveOptions,
    passes: &[u64],
    folder: &Path,
    progress: &dyn Progress,
) -> Result<Vec<Report>, Error> {
    let look = options.look_of(&export::settled(&[bake], || Manifest::read(bake))?, bake)?;
    let looks = passes.iter().map(|&total_passes| aged(&look, total_passes)).collect::<Result<Vec<_>, _>>()?;
    let folders: Vec<PathBuf> =
        passes.iter().map(|total_passes| folder.join(format!("passes_{total_passes}"))).collect();
    let mut reports = Vec::new();
    for (look, folder) in looks.into_iter().zip(&folders) {
        let options = ResolveOptions { look: Some(look), folder: Some(folder.clone()), ..options.clone() };
        reports.push(resolve(bake, &options, progress)?);
    }
    let Some(first) = folders.first() else { return Ok(reports) };
    let files = Manifest::read(first)?.files;
    for file in
        files.iter().filter(|file| file.starts_with("preview/") && !STILL.iter().any(|still| *still == &***file))
    {
        let pictures: Vec<PathBuf> = folders.iter().map(|folder| folder.join(file)).collect();
        show::write_flipbook(&pictures, &folder.join(file.trim_start_matches("preview/")), options.force)?;
    }
    Ok(reports)
}

/// The look after another number of people; walls age with the floor.
pub(super) fn aged(look: &Look, total_passes: u64) -> Result<Look, LookError> {
    let mut aged = look.clone();
    let older = total_passes as f64 / look.total_passes.max(1) as f64;
    aged.total_passes = total_passes;
    aged.wall.total_passes = ((look.wall.total_passes as f64 * older).round() as u64).max(1);
    aged.check().map(|()| aged)
}
