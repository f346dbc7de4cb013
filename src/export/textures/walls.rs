use super::writer::{Canvas, TextureWriter};
use crate::export::atlas::{Atlas, Strip};
use crate::export::bake_path::BakePath;
use crate::export::band::Image;
use crate::export::busy::BusyTime;
use crate::export::layout::Naming;
use crate::export::manifest::{SheetEntry, StripEntry, WallsEntry};
use crate::export::options::TextureOptions;
use crate::export::source::SheetSource;
use crate::export::targets::{Covered, Number, Target};
use crate::export::{ExportError, OutputFolder, Reduced, WallSource};
use crate::math::Vec2;
use crate::progress::Progress;
use crate::stamps::DENSITY_ONE;
use crate::walls::{Face, Walls};

/// Largest number of sheets with UDIM numbers.
const UDIM_SHEETS: usize = 100;

/// The written textures of walls.
#[derive(Clone, Debug)]
pub struct WallTextures {
    /// Places of the walls in the sheets.
    pub atlas: Atlas,
    /// Manifest entries of the sheets, in the order of `atlas`. [`WallTextures::entry`] adds their strips.
    pub sheets: Vec<SheetEntry>,
    /// The target program.
    pub target: Target,
    /// Bits per channel of masks, wear and height.
    pub bits: u32,
    /// Whether the clean surface and the dirt on it are images of their own.
    pub dirt: bool,
    /// Names of the layers that were written.
    pub layers: Vec<&'static str>,
    /// Reduced images of each sheet, if requested.
    pub reduced: Vec<Reduced>,
    /// Time that threads spent on resolving, seconds.
    pub look_busy_s: f64,
    /// Time that threads spent on compressing and writing, seconds.
    pub export_busy_s: f64,
}

/// Resolves walls and writes a texture per sheet into `walls/`. See [`super::floor_textures`].
///
/// # Errors
/// A sheet beyond the target's limit; a file that cannot be written; an interruption.
pub fn wall_textures(
    folder: &OutputFolder,
    atlas: &Atlas,
    source: &impl WallSource,
    options: &TextureOptions,
    progress: &dyn Progress,
) -> Result<WallTextures, ExportError> {
    options.check()?;
    atlas.check(options.target)?;
    let writer = TextureWriter::new(folder, source.layers(), options, progress);
    let (mut sheets, mut reduced) = (Vec::new(), Vec::new());
    let count = atlas.sheets.len();
    for (index, sheet) in atlas.sheets.iter().enumerate() {
        let number = number(index, count);
        let canvas = Canvas {
            corner: [0, 0],
            size: [sheet.width, sheet.height],
            files: writer.files(Covered::Wall, number),
            even_if_empty: true,
            part: [index as f64 / count as f64, (index + 1) as f64 / count as f64],
        };
        let texels = SheetSource::new(source, sheet, atlas.padding_px);
        reduced.extend(writer.write(&texels, &canvas, &|_, _, _: &_| ())?.and_then(|written| written.reduced));
        sheets.push(entry(index, count, &canvas, options.target)?);
    }
    let seconds = BusyTime::seconds;
    Ok(WallTextures {
        atlas: atlas.clone(),
        sheets,
        target: options.target,
        bits: options.bits,
        dirt: options.dirt,
        layers: if options.writes_layers() { source.layers().to_vec() } else { Vec::new() },
        reduced,
        look_busy_s: seconds(&writer.look_busy),
        export_busy_s: seconds(&writer.export_busy),
    })
}

fn number(index: usize, count: usize) -> Number {
    match naming(count) {
        Naming::Udim => Number::Udim(1001 + index as u32),
        Naming::Uv => Number::Uv(index as u32, 0),
    }
}

fn naming(count: usize) -> Naming {
    if count <= UDIM_SHEETS { Naming::Udim } else { Naming::Uv }
}

/// Returns a sheet's manifest entry without its strips.
fn entry(index: usize, count: usize, canvas: &Canvas, target: Target) -> Result<SheetEntry, ExportError> {
    let file = |image| canvas.files.image(image).unwrap_or_default();
    let (udim, name) = match number(index, count) {
        Number::Udim(udim) => (Some(udim), format!(".{udim}")),
        Number::Uv(u, v) => (None, format!("_u{u:03}_v{v:03}")),
    };
    Ok(SheetEntry {
        udim,
        width_px: canvas.size[0],
        height_px: canvas.size[1],
        basecolor: file(Image::BaseColor),
        mask: file(Image::Mask(Covered::Wall)),
        splash: file(Image::LoneMask(Covered::Wall)),
        rub: file(Image::Rub),
        normal: file(target.normal()),
        orm: file(Image::Orm),
        mask_map: canvas.files.image(Image::MaskMap),
        clean: canvas.files.image(Image::Clean),
        dirt: canvas.files.image(Image::Dirt),
        layers: canvas.files.layers.clone(),
        sums: BakePath::new(format!("sums/wall_sums{name}.exr"))?,
        strips: Vec::new(),
    })
}

impl WallTextures {
    /// Returns the walls' manifest entry. `people` is the number of people whose touches the sums hold.
    pub fn entry(&self, walls: &Walls, people: u32) -> WallsEntry {
        let masks =
            ["skin: touches of hands", "rub: arms, shoulders and bags", "scuff: shoes", "edge: splashes and dust"];
        let atlas = &self.atlas;
        let with_strips = |(index, entry): (usize, &SheetEntry)| {
            let strips = atlas.sheets[index].strips.iter();
            SheetEntry {
                strips: strips.map(|strip| strip_entry(atlas, index, strip, walls)).collect(),
                ..entry.clone()
            }
        };
        WallsEntry {
            people,
            texels_per_metre: atlas.texels_per_metre,
            height_m: atlas.height_m,
            height_px: atlas.strips().next().map_or(0, |(_, strip)| strip.height),
            padding_px: atlas.padding_px,
            naming: naming(atlas.sheets.len()),
            sums_one: DENSITY_ONE as u32,
            channels: self.target.channels(
                (Covered::Wall, self.bits, self.dirt),
                "colour of the touched wall",
                masks,
                &self.layers,
                |_| "optical density D",
            ),
            sheets: self.sheets.iter().enumerate().map(with_strips).collect(),
        }
    }
}

fn strip_entry(atlas: &Atlas, index: usize, strip: &Strip, walls: &Walls) -> StripEntry {
    let [width, height] = strip.size();
    let top = atlas.sheets[index].height - strip.y - height;
    StripEntry {
        face: strip.face,
        from_m: strip.from_m,
        to_m: strip.to_m,
        points_m: walls.faces.get(strip.face).map_or(Vec::new(), |face| stretch(face, strip.from_m, strip.to_m)),
        first_column: strip.i0,
        rect_px: [strip.x, top, width, height],
        uv: [atlas.uv(index, strip, strip.from_m, 0.0), atlas.uv(index, strip, strip.to_m, atlas.height_m)],
        turned: strip.turned,
    }
}

/// Returns the polyline of a face between two arc lengths, metres.
fn stretch(face: &Face, from_m: f64, to_m: f64) -> Vec<Vec2> {
    /// Vertices closer to an end than this merge with it, metres.
    const NEAR_M: f64 = 1e-6;
    let joined = face.closed.then(|| face.points_m.first().copied()).flatten();
    let points: Vec<Vec2> = face.points_m.iter().copied().chain(joined).collect();
    let mut stretch = Vec::new();
    let mut at_m = 0.0;
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length_m = a.distance(b);
        let end_m = at_m + length_m;
        let point = |along_m: f64| a + (b - a) * ((along_m - at_m) / length_m).clamp(0.0, 1.0);
        if stretch.is_empty() && from_m < end_m - NEAR_M {
            stretch.push(point(from_m));
        }
        if !stretch.is_empty() {
            let last = to_m <= end_m + NEAR_M;
            stretch.push(if last { point(to_m) } else { b });
            if last {
                break;
            }
        }
        at_m = end_m;
    }
    stretch
}
