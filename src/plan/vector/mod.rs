//! Plans of vector formats: SVG, PDF, DXF, Open-RMF buildings and Universal VTT maps.
//!
//! Each format is read into shapes with a class by the name of their layer. Shapes become areas on a fine grid, areas
//! become a plan; a drawing without a layer of walls becomes a picture for the reader of pictures.

use std::path::Path;

use image::DynamicImage;

use super::{PlanError, PlanOptions, PlanScale, scale};
use crate::files::read_input;

mod area;
mod build;
mod doors;
mod dxf;
mod format;
mod json;
mod names;
mod pdf;
mod piece;
mod rmf;
mod solid;
mod svg;
mod unit;
mod vtt;

pub(super) use build::Layers;
pub use format::VectorFormat;

/// Largest drawing, bytes.
const LARGEST_BYTES: u64 = 256 << 20;

/// What a drawing gives.
pub(super) enum Vector {
    /// Walls, doors and furniture by the names of layers.
    Layers(Layers, Vec<String>),
    /// A picture, and the metres of its pixels if they are known, with where they come from.
    Picture(DynamicImage, Option<(f64, PlanScale)>, Vec<String>),
}

/// The vector format of a file, by its content and its name; `None` for pictures, and for what cannot be read.
pub(super) fn format_of(path: &Path) -> Option<VectorFormat> {
    let name = path.file_name()?.to_string_lossy().to_lowercase();
    let found = VectorFormat::of(&head(path)?, &name);
    // The levels of a building may stand anywhere.
    let is_yaml = name.ends_with(".yaml") || name.ends_with(".yml");
    found.or_else(|| VectorFormat::of(&read_input(path, LARGEST_BYTES).ok().filter(|_| is_yaml)?, &name))
}

fn head(path: &Path) -> Option<Vec<u8>> {
    use std::io::Read;
    let mut head = Vec::new();
    crate::files::open_input(path).ok()?.take(format::HEAD_BYTES as u64).read_to_end(&mut head).ok()?;
    Some(head)
}

/// Reads a drawing and builds a plan or a picture.
pub(super) fn read(path: &Path, format: VectorFormat, options: &PlanOptions) -> Result<Vector, PlanError> {
    let bytes = read_input(path, LARGEST_BYTES).map_err(|source| PlanError::Open { path: path.to_owned(), source })?;
    let refuse = |reason: String| PlanError::Drawing { path: path.to_owned(), format, reason };
    let text = |bytes: &[u8]| {
        let text = std::str::from_utf8(bytes).map_err(|_| refuse("it is not UTF-8 text".to_owned()))?;
        Ok::<_, PlanError>(text.trim_start_matches('\u{feff}').to_owned())
    };
    let said = options.layers.clone().unwrap_or_default();
    let plan = match format {
        VectorFormat::Svg => svg::read(&bytes, options.page, &said),
        VectorFormat::Pdf => pdf::read(bytes, options.page, &said),
        VectorFormat::Dxf => dxf::read(&bytes, &said),
        VectorFormat::OpenRmf => rmf::read(&text(&bytes)?, options.page),
        VectorFormat::Vtt => vtt::read(&text(&bytes)?),
        VectorFormat::Dwg | VectorFormat::Ifc => Err("its format is not read".to_owned()),
    };
    let plan = plan.map_err(refuse)?;
    let mut warnings = plan.warnings.clone();
    warnings.extend(plan.left_out());
    let per_unit = if plan.units_per_pixel > 0.0 { 1.0 / plan.units_per_pixel } else { 1.0 };
    let given = scale::given(options, None)?.map(|(metres, scale)| (metres * per_unit, scale.scaled(per_unit)));
    Ok(match build::build(plan, given, options.width_m, &mut warnings)? {
        build::Built::Layers(layers) => Vector::Layers(layers, warnings),
        build::Built::Picture(image, scale) => Vector::Picture(image, scale, warnings),
    })
}
