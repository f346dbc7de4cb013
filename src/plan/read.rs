//! The steps of reading a plan, in order.

use std::path::{Path, PathBuf};

use image::DynamicImage;

use super::drawing::{self, Drawing};
use super::layer::{self, Layer};
use super::paint::Painted;
use super::scale::{PlanScale, ScaleSource};
use super::tones::USUAL_THRESHOLD;
use super::understand::Understood;
use super::vector::{self, Layers, Vector};
use super::{
    Drawn, FloorPlan, PlanClass, PlanError, PlanOptions, Pose, box_doors, corrections, crop, doors, doubts, guess,
    image_file, openings, printed, regions, ros_map, scale, symbols, understand,
};
use crate::math::vec2;

/// Least share of a drawing's white that is inside, if its doors close the building.
const LEAST_INSIDE: f64 = 0.1;

/// Reads a plan image, a vector drawing or the YAML of a ROS map, and finds the floor.
///
/// PNG, JPEG, BMP, PGM, TIFF and GIF, grey, colour, with alpha, 8 or 16 bit, up to 20 000 pixels a side. White is
/// floor, black is wall; saturated colour is annotation and counts as floor. [`FloorPlan::regions`] tells the role of
/// each white region.
///
/// SVG, PDF, DXF, Open-RMF buildings and Universal VTT maps are read by the names of their layers: walls, doors,
/// windows and furniture are taken as they are drawn, and the scale follows from the drawing's unit. A drawing without
/// a layer of walls is read as a picture. [`PlanOptions::metres_per_pixel`] is then the size of a drawing's unit.
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
    if let Some(format) = vector::format_of(path) {
        return match vector::read(path, format, options)? {
            Vector::Layers(layers, warnings) => of_layers(layers, options, warnings),
            Vector::Picture(image, scale, warnings) => of_picture(image, scale, path, options, warnings),
        };
    }
    let map = if ros_map::is_map(path) { Some(ros_map::read(path)?) } else { None };
    let given = scale::given(options, map.as_ref().map(|m| m.metres_per_pixel))?;
    let file = map.as_ref().map_or(path, |m| &m.image);
    let mut image = image_file::decode(file)?;
    let mut corner_px = [0.0; 2];
    if let Some(corners) = options.crop {
        let known = given.as_ref().map(|(metres_per_pixel, _)| *metres_per_pixel);
        let cut = crop::cut_of(corners, [image.width(), image.height()], known)?;
        let [left, top, _, down] = cut.map(f64::from);
        corner_px = [left, f64::from(image.height()) - top - down];
        image = crop::cropped(image, cut);
    }
    if let Some((metres_per_pixel, _)) = &given {
        scale::check_size(image.width(), image.height(), *metres_per_pixel)?;
    }
    let size = [image.width() as usize, image.height() as usize];
    let (drawing, mut warnings) = match &map {
        Some(map) if options.threshold.is_none() && options.invert.is_none() => {
            (drawing::of_map(image, &map.greys, options), Vec::new())
        }
        _ => drawing::of_image(image, options),
    };
    let (metres_per_pixel, scale) = match given {
        Some(given) => given,
        None => {
            // A sheet that was straightened has lost its print's resolution.
            let dots = image_file::dots_per_inch(file).filter(|_| size == [drawing.width, drawing.height]);
            found_scale(&drawing, options, (file, dots), &mut warnings)?
        }
    };
    if drawing.looks_like_map {
        warnings.push("the greys are those of a robot's map: grey 205 was taken for unknown, which is wall".to_owned());
    }
    let layer = layer_of(options, [drawing.width, drawing.height])?;
    let [x, y] = corner_px.map(|px| px * metres_per_pixel);
    let map_from_plan = map.as_ref().map_or(Pose::default(), |m| m.pose).moved(vec2(x, y));
    find_floor(drawing, (metres_per_pixel, scale), options, layer.as_ref(), map_from_plan, warnings)
}

/// Lists the files that [`read`] opens for a path: a ROS map's YAML and its image.
pub fn files(path: &Path) -> Vec<PathBuf> {
    let is_map = ros_map::is_map(path) && vector::format_of(path).is_none();
    let image = if is_map { ros_map::read(path).ok().map(|map| map.image) } else { None };
    [path.to_owned()].into_iter().chain(image).collect()
}

/// The plan of a drawing with layers.
fn of_layers(layers: Layers, options: &PlanOptions, warnings: Vec<String>) -> Result<FloorPlan, PlanError> {
    let mut plan = FloorPlan {
        width_px: layers.width as u32,
        height_px: layers.height as u32,
        metres_per_pixel: layers.metres_per_pixel,
        scale: layers.scale,
        floor: layers.lightness.iter().map(|light| u8::from(*light >= USUAL_THRESHOLD)).collect(),
        lightness: layers.lightness,
        classes: layers.classes,
        scanned: false,
        painted: Painted::default(),
        threshold: USUAL_THRESHOLD,
        map_from_plan: Pose { origin_m: layers.origin_m, yaw_rad: 0.0 },
        regions: Vec::new(),
        openings: Vec::new(),
        warnings,
        doors: Vec::new(),
        windows: Vec::new(),
        furniture: Vec::new(),
        drawn: Some(Drawn { doors: layers.doors, lanes: layers.lanes }),
    };
    let seeds: Vec<_> = options.floor.iter().map(|p| p.to_m(&plan)).collect();
    let layer = layer_of(options, [layers.width, layers.height])?;
    let white = plan.floor.clone();
    if seeds.is_empty() {
        close_doors(&mut plan);
    }
    regions::choose(&mut plan, options.narrowest_m, &seeds, None)?;
    // White that nobody reaches is beyond the building, whatever is drawn there.
    for (class, floor) in plan.classes.iter_mut().zip(&plan.floor) {
        if *floor == 0 && !class.is_solid() {
            *class = PlanClass::Outside;
        }
    }
    plan.set_furniture_free();
    if layer.is_some() || !options.doors.is_empty() {
        corrections::apply(&mut plan, white, layer.as_ref(), &options.doors, options.narrowest_m, &seeds);
    }
    plan.openings = openings::find(&plan);
    let doubts = doubts::doubts(&plan, options.narrowest_m, false);
    plan.warnings.extend(doubts);
    Ok(plan)
}

/// Takes away the paper around a building whose doors are known: what is reached from the image's sides without passing
/// one. Doors to the outside stay floor through the whole wall.
fn close_doors(plan: &mut FloorPlan) {
    let (width, height) = (plan.width_px as usize, plan.height_px as usize);
    let mut inside = plan.floor.clone();
    let border = (0..width).flat_map(|x| [x, (height - 1) * width + x]);
    let mut next: Vec<usize> = border.chain((0..height).flat_map(|y| [y * width, y * width + width - 1])).collect();
    while let Some(at) = next.pop() {
        if inside[at] == 0 || plan.classes[at] == PlanClass::Door {
            continue;
        }
        inside[at] = 0;
        let x = at % width;
        let beside = [(x > 0).then(|| at - 1), (x + 1 < width).then_some(at + 1)];
        let across = [at.checked_sub(width), Some(at + width).filter(|at| *at < inside.len())];
        next.extend(beside.into_iter().chain(across).flatten());
    }
    let count = |pixels: &[u8]| pixels.iter().filter(|pixel| **pixel != 0).count() as f64;
    let room = |at: &usize| inside[*at] != 0 && plan.classes[*at] != PlanClass::Door;
    // A building that is open to the paper is told from it by its shape.
    let rooms = (0..inside.len()).filter(room).count() as f64;
    if rooms >= LEAST_INSIDE * count(&plan.floor) {
        plan.floor = inside;
    }
}

/// The plan of a drawing that was drawn as a picture.
fn of_picture(
    image: DynamicImage,
    scale: Option<(f64, PlanScale)>,
    path: &Path,
    options: &PlanOptions,
    mut warnings: Vec<String>,
) -> Result<FloorPlan, PlanError> {
    let (drawing, found) = drawing::of_image(image, options);
    warnings.extend(found);
    let scale = match scale {
        Some(scale) => scale,
        None => found_scale(&drawing, options, (path, None), &mut warnings)?,
    };
    scale::check_size(drawing.width as u32, drawing.height as u32, scale.0)?;
    let layer = layer_of(options, [drawing.width, drawing.height])?;
    let plan = find_floor(drawing, scale, options, layer.as_ref(), Pose::default(), warnings)?;
    Ok(FloorPlan { drawn: Some(Drawn::default()), ..plan })
}

/// The painted layer of a plan, at its size in pixels.
fn layer_of(options: &PlanOptions, size: [usize; 2]) -> Result<Option<Layer>, PlanError> {
    options.paint.as_ref().map(|path| layer::read(path, size)).transpose()
}

fn find_floor(
    mut drawing: Drawing,
    (metres_per_pixel, scale): (f64, PlanScale),
    options: &PlanOptions,
    layer: Option<&Layer>,
    map_from_plan: Pose,
    warnings: Vec<String>,
) -> Result<FloorPlan, PlanError> {
    let (pixels, threshold) = (drawing.dark.len(), drawing.threshold);
    // What is wrong may be put right below.
    let is_corrected = layer.is_some() || !options.doors.is_empty();
    let may_lack = is_corrected || options.unfinished;
    if !drawing.dark.contains(&0) && !may_lack {
        return Err(PlanError::NoFloor { pixels, threshold });
    }
    let understood = options.drop_annotation.then(|| understand::understand(&mut drawing, metres_per_pixel)).flatten();
    if understood.is_none() {
        if options.drop_annotation && !drawing.scanned {
            // Dots and commas hold lettering together, so specks go later.
            symbols::drop_annotation(&mut drawing, metres_per_pixel);
        }
        symbols::drop_specks(&mut drawing, metres_per_pixel, options.speck_m);
        if options.drop_annotation && !drawing.scanned {
            drawing.coloured = Vec::new();
            box_doors::open(&mut drawing);
            doors::drop_doors(&mut drawing, metres_per_pixel);
        }
    }
    if !drawing.dark.contains(&1) && !may_lack {
        return Err(PlanError::NoWalls { pixels, threshold });
    }
    // In place, because the pixels of large plans take most of the memory.
    let mut floor = drawing.dark;
    floor.iter_mut().for_each(|pixel| *pixel = 1 - *pixel);
    let mut plan = FloorPlan {
        width_px: drawing.width as u32,
        height_px: drawing.height as u32,
        metres_per_pixel,
        scale,
        floor,
        lightness: drawing.lightness,
        classes: Vec::new(),
        scanned: drawing.scanned,
        painted: Painted::default(),
        threshold,
        map_from_plan,
        regions: Vec::new(),
        openings: Vec::new(),
        doors: Vec::new(),
        windows: Vec::new(),
        furniture: Vec::new(),
        warnings,
        drawn: None,
    };
    let seeds: Vec<_> = options.floor.iter().map(|p| p.to_m(&plan)).collect();
    let white = is_corrected.then(|| plan.floor.clone());
    let is_drawing = understood.is_some();
    let mut lack = None;
    if may_lack {
        lack = choose_if_possible(&mut plan, options.narrowest_m, &seeds, understood.as_ref());
    } else {
        regions::choose(&mut plan, options.narrowest_m, &seeds, understood.as_ref())?;
    }
    match understood {
        Some(understood) => {
            understood.complete(&mut plan);
            plan.set_furniture_free();
        }
        None => plan.classes = plan.plain_classes(),
    }
    if let Some(white) = white {
        corrections::apply(&mut plan, white, layer, &options.doors, options.narrowest_m, &seeds);
        let is_off = |&seed: &_| regions::pixel_of(&plan, seed).is_none_or(|at| plan.floor[at] == 0);
        lack = lack.filter(|lack| match lack {
            PlanError::SeedNotFloor { .. } => seeds.iter().any(is_off),
            _ => !plan.floor.contains(&1),
        });
    }
    if let Some(lack) = lack.filter(|_| !options.unfinished) {
        return Err(lack);
    }
    plan.openings = openings::find(&plan);
    // Robots' maps hold rooms that the robot looked into.
    if !plan.scanned {
        let doubts = doubts::doubts(&plan, options.narrowest_m, !is_drawing);
        plan.warnings.extend(doubts);
    }
    Ok(plan)
}

/// Finds the floor as far as the reading shows it. Returns what it lacks.
fn choose_if_possible(
    plan: &mut FloorPlan,
    narrowest_m: f64,
    seeds: &[crate::math::Vec2],
    understood: Option<&Understood>,
) -> Option<PlanError> {
    let white = plan.floor.clone();
    let mut lack = regions::choose(plan, narrowest_m, seeds, understood).err()?;
    if matches!(lack, PlanError::SeedNotFloor { .. }) {
        plan.floor.clone_from(&white);
        match regions::choose(plan, narrowest_m, &[], understood) {
            Ok(()) => return Some(lack),
            Err(other) => lack = other,
        }
    }
    plan.floor = vec![0; white.len()];
    plan.regions.clear();
    Some(lack)
}

/// Reads the picture of a plan as people see it, at the size of the plan that [`read`] gives; of a plan that is not read
/// pixel by pixel, its lightness.
///
/// # Errors
/// The image cannot be read.
pub fn picture(path: &Path, options: &PlanOptions, plan: &FloorPlan) -> Result<image::RgbImage, PlanError> {
    let size = (plan.width_px, plan.height_px);
    let as_read = || {
        let grey = image::GrayImage::from_raw(size.0, size.1, plan.lightness.clone()).unwrap_or_default();
        DynamicImage::ImageLuma8(grey).into_rgb8()
    };
    if vector::format_of(path).is_some() {
        return Ok(as_read());
    }
    let map = if ros_map::is_map(path) { Some(ros_map::read(path)?) } else { None };
    let mut image = image_file::decode(map.as_ref().map_or(path, |m| &m.image))?;
    if let Some(corners) = options.crop {
        let cut = crop::cut_of(corners, [image.width(), image.height()], Some(plan.metres_per_pixel))?;
        image = crop::cropped(image, cut);
    }
    if (image.width(), image.height()) != size {
        return Ok(as_read());
    }
    // Transparent paper is white.
    let mut paper = image::RgbaImage::from_pixel(size.0, size.1, image::Rgba([255; 4]));
    image::imageops::overlay(&mut paper, &image.into_rgba8(), 0, 0);
    Ok(image::DynamicImage::ImageRgba8(paper).into_rgb8())
}

/// The scale by the building's width or, without that, by a guess.
fn found_scale(
    drawing: &Drawing,
    options: &PlanOptions,
    (file, dots_per_inch): (&Path, Option<f64>),
    warnings: &mut Vec<String>,
) -> Result<(f64, PlanScale), PlanError> {
    let (guess, by_guess) = guess::guess(drawing, dots_per_inch);
    let printed = if drawing.scanned { None } else { printed::scale(drawing, guess, by_guess.range) };
    let (guess, by_guess) = printed.unwrap_or((guess, by_guess));
    let (value, scale) = match options.width_m {
        Some(width_m) => {
            let (pixels, threshold) = (drawing.dark.len(), drawing.threshold);
            let value = guess::of_width(drawing, width_m, guess).ok_or(PlanError::NoWalls { pixels, threshold })?;
            (value, PlanScale::known(ScaleSource::Width, value))
        }
        None => {
            warnings.push(told_guess(file, guess, &by_guess));
            (guess, by_guess)
        }
    };
    scale::check(scale.source, value)?;
    scale::check_size(drawing.width as u32, drawing.height as u32, value)?;
    Ok((value, scale))
}

fn told_guess(path: &Path, metres_per_pixel: f64, scale: &PlanScale) -> String {
    let map = path.with_extension("yaml");
    let advice = match map.file_name() {
        Some(name) if map.is_file() && map != path => {
            format!("give {} instead if it is this image's map", name.display())
        }
        _ => "give the scale in metres per pixel, or the building's width".to_owned(),
    };
    let evidence = match scale.evidence.as_str() {
        "" => String::new(),
        evidence => format!(", by {evidence}"),
    };
    let [low, high] = scale.range;
    format!(
        "no scale was given: a pixel was taken for {metres_per_pixel} m{evidence} ({low} to {high} m are possible); {advice}",
        low = Digits(low),
        high = Digits(high)
    )
}

/// A number with three significant digits.
struct Digits(f64);

impl std::fmt::Display for Digits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rounded: f64 = format!("{:.2e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}
