//! Compares two bakes or two images: images texel by texel, other files byte by byte.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{ExportError, Manifest, Report, settled};
use crate::files::{entries, have_same_bytes};

mod heat;
mod rows;

pub use heat::HeatMap;
use rows::ImageRows;

/// Thresholds above which two images count as different, after OpenImageIO's `idiff`.
///
/// PNG values are scaled to 0 to 1; EXR values are used as stored (sums: integers).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DiffOptions {
    /// The tolerance: a texel differs if one of its channels differs by more.
    pub fail: f64,
    /// Largest allowed share of differing texels, 0 to 1.
    pub fail_share: f64,
    /// Largest allowed difference of any texel.
    pub hard_fail: f64,
}

impl Default for DiffOptions {
    /// Requires bitwise equality.
    fn default() -> DiffOptions {
        DiffOptions { fail: 0.0, fail_share: 0.0, hard_fail: f64::INFINITY }
    }
}

/// Statistics of the difference of two images.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImageDiff {
    /// Path relative to the bake, or the second image's path if two images were compared.
    pub file: String,
    /// Size, texels.
    pub size_px: [usize; 2],
    /// Largest difference of a channel.
    pub largest: f64,
    /// Name of the channel with the largest difference.
    pub largest_channel: String,
    /// Texel with the largest difference, from the upper left.
    pub largest_px: [usize; 2],
    /// Mean difference over all texels and channels.
    pub mean: f64,
    /// Share of the texels that differ by more than the tolerance.
    pub share_over: f64,
    /// Whether the difference exceeds a threshold.
    pub failed: bool,
}

impl ImageDiff {
    /// Returns the statistics of two equal images.
    fn none(file: &str, size_px: [usize; 2]) -> ImageDiff {
        ImageDiff {
            file: file.to_string(),
            size_px,
            largest: 0.0,
            largest_channel: String::new(),
            largest_px: [0, 0],
            mean: 0.0,
            share_over: 0.0,
            failed: false,
        }
    }
}

/// The result of comparing two bakes or two images.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Statistics of each image that both have.
    pub images: Vec<ImageDiff>,
    /// Other files of both bakes with different bytes, and images of different size or channels.
    pub different: Vec<String>,
    /// Files that a manifest lists and both bakes lack.
    pub missing: Vec<String>,
    /// Files that only the first bake has.
    pub only_in_a: Vec<String>,
    /// Files that only the second bake has.
    pub only_in_b: Vec<String>,
    /// Heat map of the images; for bakes, of the whole floor with all its files.
    #[serde(skip)]
    pub heat_map: HeatMap,
}

impl Comparison {
    /// Whether the differences exceed the thresholds, or files differ or are missing.
    pub fn failed(&self) -> bool {
        let lists = [&self.different, &self.missing, &self.only_in_a, &self.only_in_b];
        lists.iter().any(|list| !list.is_empty()) || self.images.iter().any(|image| image.failed)
    }

    /// Returns the largest difference of a channel in any file.
    pub fn largest(&self) -> f64 {
        self.images.iter().map(|image| image.largest).fold(0.0, f64::max)
    }
}

/// Compares two bakes (folders) or two images (PNG of 8 or 16 bit, EXR).
///
/// Of bakes, it compares all existing and all listed files except `report.json`.
///
/// # Errors
/// Unreadable files, images of different size or channels, folders without a bake.
pub fn diff(a: &Path, b: &Path, options: &DiffOptions) -> Result<Comparison, ExportError> {
    match (a.is_dir(), b.is_dir()) {
        (false, false) => {
            let (image, heat_map) = diff_images(a, b, options)?;
            Ok(Comparison {
                images: vec![image],
                different: Vec::new(),
                missing: Vec::new(),
                only_in_a: Vec::new(),
                only_in_b: Vec::new(),
                heat_map,
            })
        }
        (true, true) => settled(&[a, b], || diff_bakes(a, b, options)),
        (true, false) => Err(not_alike(a, b)),
        (false, true) => Err(not_alike(b, a)),
    }
}

fn not_alike(bake: &Path, image: &Path) -> ExportError {
    ExportError::NotAlike { folder: bake.to_path_buf(), file: image.to_path_buf() }
}

fn diff_bakes(a: &Path, b: &Path, options: &DiffOptions) -> Result<Comparison, ExportError> {
    let manifests = [Manifest::read(a)?, Manifest::read(b)?];
    for (bake, manifest) in [a, b].into_iter().zip(&manifests) {
        let listed = manifest.files.iter().filter(|file| bake.join(file).exists());
        listed.map(|file| file.within(bake)).collect::<Result<Vec<_>, _>>()?;
    }
    let (files_a, files_b) = (files_in(a)?, files_in(b)?);
    let listed = manifests.iter().flat_map(|manifest| &manifest.files).map(ToString::to_string);
    let missing: BTreeSet<String> = listed.filter(|file| !files_a.contains(file) && !files_b.contains(file)).collect();
    let both: Vec<&String> = files_a.intersection(&files_b).filter(|file| *file != Report::FILE_NAME).collect();
    let found: Vec<Found> = both
        .par_iter()
        .with_max_len(1)
        .map(|&file| diff_files(a, b, file, options))
        .collect::<Result<_, ExportError>>()?;
    let (mut diffs, mut different) = (Vec::new(), Vec::new());
    for (found, file) in found.into_iter().zip(both) {
        match found {
            Found::Image(image, heat) => diffs.push((*image, heat)),
            Found::Same => {}
            Found::Different => different.push(file.clone()),
        }
    }
    let heat_map = floor_heat(&manifests[0], &diffs);
    Ok(Comparison {
        images: diffs.into_iter().map(|(image, _)| image).collect(),
        different,
        missing: missing.into_iter().collect(),
        only_in_a: files_a.difference(&files_b).cloned().collect(),
        only_in_b: files_b.difference(&files_a).cloned().collect(),
        heat_map,
    })
}

enum Found {
    Image(Box<ImageDiff>, Option<HeatMap>),
    Same,
    Different,
}

/// Compares a file that exists in both bakes.
fn diff_files(a: &Path, b: &Path, file: &str, options: &DiffOptions) -> Result<Found, ExportError> {
    let (path_a, path_b) = (a.join(file), b.join(file));
    let same = have_same_bytes(&path_a, &path_b)?;
    if !(file.ends_with(".png") || file.ends_with(".exr")) {
        return Ok(if same { Found::Same } else { Found::Different });
    }
    if same {
        let size_px = ImageRows::open(&path_a).map_or([0; 2], |image| [image.width, image.height]);
        return Ok(Found::Image(Box::new(ImageDiff::none(file, size_px)), None));
    }
    match diff_images(&path_a, &path_b, options) {
        Ok((image, heat)) => Ok(Found::Image(Box::new(ImageDiff { file: file.to_string(), ..image }), Some(heat))),
        Err(ExportError::SizesDiffer { .. } | ExportError::ChannelsDiffer { .. }) => Ok(Found::Different),
        Err(error) => Err(error),
    }
}

/// Lists all files below a folder, as relative paths with `/` between the parts.
fn files_in(folder: &Path) -> Result<BTreeSet<String>, ExportError> {
    let files = entries(folder)?.into_iter().filter(|entry| !entry.kind.is_dir());
    let parts = |path: &Path| Vec::from_iter(path.iter().map(|part| part.to_string_lossy())).join("/");
    Ok(files.map(|entry| parts(&entry.relative)).collect())
}

/// Merges the heat maps of all floor images into one of the whole floor.
fn floor_heat(manifest: &Manifest, diffs: &[(ImageDiff, Option<HeatMap>)]) -> HeatMap {
    let floor = &manifest.floor;
    let (columns, rows) =
        floor.tiles.iter().fold((1, 1), |(columns, rows), tile| (columns.max(tile.u + 1), rows.max(tile.v + 1)));
    let [tile_width, tile_height] = floor.tile_px.map(|px| px as usize);
    let size = [columns as usize * tile_width, rows as usize * tile_height];
    let mut heat = HeatMap::new(size[0].max(1), size[1].max(1));
    // Previews show the same floor from other views.
    let of_floor = diffs.iter().filter(|(image, _)| !image.file.starts_with("preview/"));
    for (image, part) in of_floor.filter_map(|(image, part)| Some((image, part.as_ref()?))) {
        let names = |tile: &&super::TileEntry| {
            *tile.sums == *image.file || tile.images().chain(&tile.layers).any(|file| *file == image.file)
        };
        if let Some(tile) = floor.tiles.iter().find(names) {
            let top = (rows - 1 - tile.v) as usize * tile_height;
            heat.lay(part, [tile.u as usize * tile_width, top], [tile_width, tile_height]);
        } else if *image.file == *floor.sums.presence.file {
            // The presence grid covers the floor, not the tiles' padding up to full size.
            let grid = [floor.width_px as usize, floor.height_px as usize];
            heat.lay(part, [0, size[1].saturating_sub(grid[1])], grid);
        } else {
            let [width, height] = part.texels();
            heat.lay(part, [0, 0], [width, height]);
        }
    }
    heat
}

/// Compares two images row by row.
fn diff_images(a: &Path, b: &Path, options: &DiffOptions) -> Result<(ImageDiff, HeatMap), ExportError> {
    let (mut a, mut b) = (ImageRows::open(a)?, ImageRows::open(b)?);
    check_alike(&a, &b)?;
    let channels = a.channels.len().max(1);
    let mut heat = HeatMap::new(a.width, a.height);
    let (mut sum, mut over) = (0.0, 0u64);
    let (mut largest, mut largest_at) = (0.0, (0, 0, 0));
    let (mut row_a, mut row_b) = (Vec::new(), Vec::new());
    for y in 0..a.height {
        a.next_row(&mut row_a)?;
        b.next_row(&mut row_b)?;
        if row_a == row_b {
            continue;
        }
        for (x, (texel_a, texel_b)) in row_a.chunks(channels).zip(row_b.chunks(channels)).enumerate() {
            let mut texel_largest = 0.0;
            for (channel, (&value_a, &value_b)) in texel_a.iter().zip(texel_b).enumerate() {
                let difference = difference(value_a, value_b);
                sum += difference;
                if difference > texel_largest {
                    texel_largest = difference;
                    if difference > largest {
                        (largest, largest_at) = (difference, (channel, x, y));
                    }
                }
            }
            if texel_largest > 0.0 {
                over += u64::from(texel_largest > options.fail);
                heat.note(x, y, texel_largest / options.fail.max(1e-6));
            }
        }
    }
    let texels = (a.width * a.height).max(1) as f64;
    let share_over = over as f64 / texels;
    let (channel, x, y) = largest_at;
    let diff = ImageDiff {
        file: b.path.to_string_lossy().into_owned(),
        size_px: [a.width, a.height],
        largest,
        largest_channel: a.channels.get(channel).cloned().unwrap_or_default(),
        largest_px: [x, y],
        mean: sum / (texels * channels as f64),
        share_over,
        failed: share_over > options.fail_share || largest > options.hard_fail,
    };
    Ok((diff, heat))
}

/// Returns |a - b|, infinite if exactly one of them is NaN.
fn difference(a: f64, b: f64) -> f64 {
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0.0,
        (false, false) if a == b => 0.0,
        (false, false) => (a - b).abs(),
        _ => f64::INFINITY,
    }
}

fn check_alike(a: &ImageRows, b: &ImageRows) -> Result<(), ExportError> {
    let paths = || -> (PathBuf, PathBuf) { (a.path.clone(), b.path.clone()) };
    if (a.width, a.height) != (b.width, b.height) {
        let (path_a, path_b) = paths();
        let size = |image: &ImageRows| [image.width as u32, image.height as u32];
        return Err(ExportError::SizesDiffer { a: path_a, a_size: size(a), b: path_b, b_size: size(b) });
    }
    if a.channels != b.channels {
        let (path_a, path_b) = paths();
        let names = |image: &ImageRows| image.channels.join(", ");
        return Err(ExportError::ChannelsDiffer { a: path_a, a_channels: names(a), b: path_b, b_channels: names(b) });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
