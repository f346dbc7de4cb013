//! The steps of reading a plan, in order.

use std::path::{Path, PathBuf};

use super::drawing::{self, Drawing};
use super::{FloorPlan, PlanError, PlanOptions, Pose, doors, image_file, openings, regions, ros_map, scale, symbols};

/// Reads a plan image, or the YAML of a ROS map, and finds the floor.
///
/// PNG, JPEG, BMP, PGM, TIFF and GIF, grey, colour, with alpha, 8 or 16 bit, up to 20 000 pixels a side. White is
/// floor, black is wall; saturated colour is annotation and counts as floor. [`FloorPlan::regions`] tells the role of
/// each white region.
///
/// # Errors
/// The file cannot be read or decoded; the scale is out of range; the plan has no walls or no room for a person.
///
/// # Example
/// ```
/// use trodden::plan::{PlanOptions, read};
///
/// let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
/// let plan = read("floorplans/museum.png".as_ref(), &options)?;
/// assert!(plan.width_m() > 10.0 && plan.floor.contains(&1));
/// # Ok::<(), trodden::Error>(())
/// ```
pub fn read(path: &Path, options: &PlanOptions) -> Result<FloorPlan, PlanError> {
    options.check()?;
    let map = if ros_map::is_map(path) { Some(ros_map::read(path)?) } else { None };
    let (metres_per_pixel, assumed) = scale::choose(options, map.as_ref().map(|m| m.metres_per_pixel))?;
    let image = image_file::decode(map.as_ref().map_or(path, |m| &m.image))?;
    scale::check_size(image.width(), image.height(), metres_per_pixel)?;
    let drawing = match &map {
        Some(map) if options.threshold.is_none() => drawing::of_map(image, &map.greys, options),
        _ => drawing::of_image(image, options),
    };
    let mut warnings = Vec::new();
    if assumed {
        warnings.push(assumed_scale(path, metres_per_pixel));
    }
    if drawing.looks_like_map {
        warnings.push("the greys are those of a robot's map: grey 205 was taken for unknown, which is wall".to_owned());
    }
    let map_from_plan = map.map_or(Pose::default(), |m| m.pose);
    understand(drawing, metres_per_pixel, options, map_from_plan, warnings)
}

/// Lists the files that [`read`] opens for a path: a ROS map's YAML and its image.
pub fn files(path: &Path) -> Vec<PathBuf> {
    let image = if ros_map::is_map(path) { ros_map::read(path).ok().map(|map| map.image) } else { None };
    [path.to_owned()].into_iter().chain(image).collect()
}

fn understand(
    mut drawing: Drawing,
    metres_per_pixel: f64,
    options: &PlanOptions,
    map_from_plan: Pose,
    warnings: Vec<String>,
) -> Result<FloorPlan, PlanError> {
    let (pixels, threshold) = (drawing.dark.len(), drawing.threshold);
    if !drawing.dark.contains(&0) {
        return Err(PlanError::NoFloor { pixels, threshold });
    }
    symbols::drop_specks(&mut drawing, metres_per_pixel, options.speck_m);
    if options.drop_annotation && !drawing.scanned {
        symbols::drop_annotation(&mut drawing, metres_per_pixel);
        drawing.coloured = Vec::new();
        doors::drop_doors(&mut drawing, metres_per_pixel);
    }
    if !drawing.dark.contains(&1) {
        return Err(PlanError::NoWalls { pixels, threshold });
    }
    // In place, because the pixels of large plans take most of the memory.
    let mut floor = drawing.dark;
    floor.iter_mut().for_each(|pixel| *pixel = 1 - *pixel);
    let mut plan = FloorPlan {
        width_px: drawing.width as u32,
        height_px: drawing.height as u32,
        metres_per_pixel,
        floor,
        lightness: drawing.lightness,
        threshold,
        map_from_plan,
        regions: Vec::new(),
        openings: Vec::new(),
        warnings,
    };
    let seeds: Vec<_> = options.floor.iter().map(|p| p.to_m(&plan)).collect();
    regions::choose(&mut plan, options.narrowest_m, &seeds)?;
    plan.openings = openings::find(&plan);
    Ok(plan)
}

fn assumed_scale(path: &Path, metres_per_pixel: f64) -> String {
    let map = path.with_extension("yaml");
    let advice = match map.file_name() {
        Some(name) if map.is_file() => format!("give {} instead if it is this image's map", name.display()),
        _ => "give the scale in metres per pixel if it is another".to_owned(),
    };
    format!("no scale was given: a pixel was taken for {metres_per_pixel} m; {advice}")
}
