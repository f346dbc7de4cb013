use std::path::Path;

use super::file::{SumsImage, read_image, write_image};
use crate::export::atlas::{Sheet, Strip};
use crate::export::bake_path::MANIFEST_NAME;
use crate::export::manifest::{Manifest, WallsEntry};
use crate::export::{ExportError, OutputFolder, WallTextures};
use crate::patterns::Cause;
use crate::progress::Progress;
use crate::stamps::{DENSITY_ONE, WallGrid};
use crate::sums::WallSums;

/// Causes in a sheet's file, sorted by name.
const SHEET_CAUSES: [Cause; 5] = [Cause::Arm, Cause::Bag, Cause::Hand, Cause::Shoe, Cause::Shoulder];

/// Writes the exact sums of walls into `sums/`: a file per sheet, strips as in its textures.
///
/// Integers, one channel per cause, no padding. Untouched blocks take almost no space.
///
/// # Errors
/// A file cannot be written; an interruption.
pub fn write_wall_sums(
    folder: &OutputFolder,
    sums: &WallSums,
    textures: &WallTextures,
    progress: &dyn Progress,
) -> Result<(), ExportError> {
    for (sheet, entry) in textures.atlas.sheets.iter().zip(&textures.sheets) {
        write_image(folder.create(&entry.sums)?, &SheetImage { sums, sheet }, progress)?;
    }
    Ok(())
}

/// Reads the wall sums that `write_wall_sums` wrote; `None` if the bake has no walls.
///
/// # Errors
/// A file is missing, invalid or contradicts the manifest; strips do not match the walls.
pub fn read_wall_sums(bake: &Path, manifest: &Manifest) -> Result<Option<WallSums>, ExportError> {
    let Some(entry) = &manifest.walls else { return Ok(None) };
    let in_manifest = |problem: String| ExportError::damaged(&bake.join(MANIFEST_NAME), problem);
    let walls = manifest.walls().map_err(|error| in_manifest(error.to_string()))?;
    let grid = WallGrid::covering(&walls, entry.height_m, entry.texels_per_metre)
        .map_err(|error| in_manifest(format!("`walls`: {error}")))?;
    check(entry, &grid).map_err(in_manifest)?;
    let mut sums = WallSums::new(grid);
    for (sheet, entry) in entry.atlas().sheets.iter().zip(&entry.sheets) {
        read_sheet(&entry.sums.within(bake)?, sheet, &mut sums)?;
    }
    Ok(Some(sums))
}

/// Checks that strips lie within their sheet, and every column of a face in one strip.
fn check(entry: &WallsEntry, grid: &WallGrid) -> Result<(), String> {
    if entry.sums_one != DENSITY_ONE as u32 {
        return Err(format!("`walls.sums_one` is {}, not {DENSITY_ONE}", entry.sums_one));
    }
    let mut stretches = Vec::new();
    for (number, sheet) in entry.sheets.iter().enumerate() {
        if sheet.width_px == 0 || sheet.height_px == 0 {
            return Err(format!("`walls.sheets[{number}]` has no texels"));
        }
        for (k, strip) in sheet.strips.iter().enumerate() {
            let [left, top, across, up] = strip.rect_px;
            let end = |from: u32, extent: u32| u64::from(from) + u64::from(extent);
            let [width, height] = if strip.turned { [up, across] } else { [across, up] };
            let fits = end(left, across) <= sheet.width_px.into()
                && end(top, up) <= sheet.height_px.into()
                && height == grid.height
                && width > 0
                && grid.faces.get(strip.face).is_some_and(|f| end(strip.first_column, width) <= f.width.into());
            if !fits {
                return Err(format!("`walls.sheets[{number}].strips[{k}]` does not fit its wall or its sheet"));
            }
            stretches.push((strip.face, strip.first_column, width));
        }
    }
    stretches.sort_unstable();
    let mut next = (0, 0);
    for (face, first, width) in stretches {
        if (face, first) != next {
            return Err(format!("the strips of wall face {} do not hold all of it once", next.0.min(face)));
        }
        let end = first + width;
        next = if end == grid.faces[face].width { (face + 1, 0) } else { (face, end) };
    }
    if next != (grid.faces.len(), 0) {
        return Err(format!("the strips of wall face {} do not hold all of it once", next.0));
    }
    Ok(())
}

fn read_sheet(path: &Path, sheet: &Sheet, sums: &mut WallSums) -> Result<(), ExportError> {
    let channels = SHEET_CAUSES.map(Cause::name);
    read_image(path, [sheet.width, sheet.height], &channels, |channel, at, size, values| {
        let filled = |values: &[u32]| values.iter().filter(|&&value| value > 0).count();
        let mut placed = 0;
        for part in sheet.strips.iter().filter_map(|strip| Part::of(strip, at, size)) {
            let values = part.cut(values, size[0]);
            placed += filled(&values);
            let [i0, j0] = part.from;
            sums.add_block(SHEET_CAUSES[channel], part.face, i0, j0, part.size, &values);
        }
        if placed == filled(values) {
            return Ok(());
        }
        Err(ExportError::damaged(path, "it holds something beside its strips"))
    })
}

struct SheetImage<'a> {
    sums: &'a WallSums,
    sheet: &'a Sheet,
}

impl SumsImage for SheetImage<'_> {
    fn size(&self) -> [u32; 2] {
        [self.sheet.width, self.sheet.height]
    }

    fn channels(&self) -> Vec<&'static str> {
        SHEET_CAUSES.map(Cause::name).to_vec()
    }

    fn touched(&self, at: [u32; 2], size: [usize; 2]) -> bool {
        let touched = |part: Part| {
            let ([i0, j0], [width, height]) = (part.from, part.size);
            SHEET_CAUSES.iter().any(|&cause| self.sums.touched(cause, part.face, i0, j0, width, height))
        };
        self.sheet.strips.iter().filter_map(|strip| Part::of(strip, at, size)).any(touched)
    }

    fn read(&self, channel: usize, at: [u32; 2], size: [usize; 2], out: &mut [u32]) {
        out.fill(0);
        let mut values = Vec::new();
        for part in self.sheet.strips.iter().filter_map(|strip| Part::of(strip, at, size)) {
            let ([i0, j0], [width, height]) = (part.from, part.size);
            values.resize(width * height, 0);
            self.sums.read(SHEET_CAUSES[channel], part.face, i0, j0, width, height, &mut values);
            part.paste(&values, size[0], out);
        }
    }
}

/// The part of a strip inside a rectangle of its sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    face: usize,
    /// Its first column and row of the face.
    from: [u32; 2],
    /// Number of columns and rows of the face.
    size: [usize; 2],
    /// Its lower-left column and row (upward) in the rectangle.
    at: [usize; 2],
    turned: bool,
}

impl Part {
    /// Intersects a strip with a rectangle; `None` if they are disjoint.
    fn of(strip: &Strip, at: [u32; 2], size: [usize; 2]) -> Option<Part> {
        let (corner, extent) = ([strip.x, strip.y], strip.size());
        let low: [u32; 2] = std::array::from_fn(|k| corner[k].max(at[k]));
        let high: [u32; 2] = std::array::from_fn(|k| (corner[k] + extent[k]).min(at[k] + size[k] as u32));
        if low[0] >= high[0] || low[1] >= high[1] {
            return None;
        }
        let shown: [usize; 2] = std::array::from_fn(|k| (high[k] - low[k]) as usize);
        let (from, size) = if strip.turned {
            ([strip.i0 + low[1] - strip.y, strip.x + strip.height - high[0]], [shown[1], shown[0]])
        } else {
            ([strip.i0 + low[0] - strip.x, low[1] - strip.y], shown)
        };
        let at = std::array::from_fn(|k| (low[k] - at[k]) as usize);
        Some(Part { face: strip.face, from, size, at, turned: strip.turned })
    }

    /// Returns the index of the part's cell (i, j) in a rectangle with rows of `pitch` cells.
    fn place(&self, i: usize, j: usize, pitch: usize) -> usize {
        let [x, y] = if self.turned { [self.size[1] - 1 - j, i] } else { [i, j] };
        (self.at[1] + y) * pitch + self.at[0] + x
    }

    fn paste(&self, values: &[u32], pitch: usize, rectangle: &mut [u32]) {
        for (j, row) in values.chunks_exact(self.size[0]).enumerate() {
            for (i, &value) in row.iter().enumerate() {
                rectangle[self.place(i, j, pitch)] = value;
            }
        }
    }

    /// Returns the part's values, read from the rectangle.
    fn cut(&self, rectangle: &[u32], pitch: usize) -> Vec<u32> {
        let rows = 0..self.size[1];
        rows.flat_map(|j| (0..self.size[0]).map(move |i| rectangle[self.place(i, j, pitch)])).collect()
    }
}

#[cfg(test)]
mod tests;
