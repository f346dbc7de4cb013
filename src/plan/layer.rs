//! The painted plan: a picture in which every class has a colour, to be edited in any paint program.
//!
//! Paint wins over what was read of the plan, pixel by pixel. Brushes blend colours at their edges: such pixels belong
//! to the nearer of the two classes beside them.

use std::path::Path;

use image::{RgbImage, RgbaImage};
use rayon::prelude::*;

use super::paint::{IN_ENTRANCE, KEPT_CLEAN, Paint};
use super::{FloorPlan, PlanClass, PlanError, image_file};

/// Greatest difference of a channel from a class's colour for a pixel of that class.
const EXACT: i32 = 3;
/// Greatest distance from a class's colour where no blend explains the pixel: colours that a program converted.
const NEAR: f64 = 26.0;
/// Greatest distance of a blended pixel from the line between two classes' colours.
const BLEND: f64 = 40.0;
/// The same where only one of the two classes is nearby.
const FAINT: f64 = 14.0;
/// Codes of paints.
const OUTSIDE: u8 = PlanClass::Outside as u8 + 1;
const WALL: u8 = PlanClass::Wall as u8 + 1;
/// Distances at which a blended pixel looks for its classes, pixels: a soft brush's edge at the most.
const REACHES: [usize; 4] = [1, 2, 5, 12];
/// Pixels of a class within two pixels from which on a colour between two others is no blend.
const FIRM: usize = 10;

/// Paint over a plan, a byte per pixel in image order: 0 where it is bare, else one more than the paint's number.
#[derive(Debug)]
pub(super) struct Layer {
    /// Paints, of blended pixels the nearer one.
    codes: Vec<u8>,
    /// Paints by the pixel's own colour; 0 where it is none.
    own: Vec<u8>,
}

impl Layer {
    /// The paint at a pixel.
    pub(super) fn at(&self, at: usize) -> Option<Paint> {
        paint_of(self.codes[at])
    }

    /// Whether a pixel has a class's own colour, by chance or not.
    pub(super) fn shows(&self, at: usize, class: PlanClass) -> bool {
        self.own[at] == class as u8 + 1
    }
}

fn paint_of(code: u8) -> Option<Paint> {
    let number = usize::from(code).checked_sub(1)?;
    match PlanClass::ALL.get(number) {
        Some(&class) => Some(Paint::Class(class)),
        None => [Paint::Entrance, Paint::KeepClean, Paint::Erase].get(number - PlanClass::ALL.len()).copied(),
    }
}

/// Reads a paint file for a plan of `size` pixels.
pub(super) fn read(path: &Path, size: [usize; 2]) -> Result<Layer, PlanError> {
    let wrong = |problem: String, hint: Option<String>| PlanError::Paint { path: path.to_owned(), problem, hint };
    let image = image_file::decode(path).map_err(|error| wrong(format!("cannot be read: {error}"), error.hint()))?;
    let image = image.into_rgba8();
    let [width, height] = [image.width() as usize, image.height() as usize];
    let times = width / size[0];
    if times == 0 || [width, height] != size.map(|side| side * times) {
        let problem =
            format!("has {width} x {height} pixels, the plan has {} x {}: each pixel needs its own", size[0], size[1]);
        let hint = "paint over a picture of the plan that inspecting it with paint writes, and keep its size";
        return Err(wrong(problem, Some(hint.to_string())));
    }
    let image = if times > 1 { thinned(&image, times) } else { image };
    layer_of(&image).map_err(|(at, colour)| unknown_colour([at % size[0], at / size[0]], colour, wrong))
}

/// One pixel of each `times` x `times`, from its middle.
fn thinned(image: &RgbaImage, times: usize) -> RgbaImage {
    let times = times as u32;
    RgbaImage::from_fn(image.width() / times, image.height() / times, |x, y| {
        *image.get_pixel(x * times + times / 2, y * times + times / 2)
    })
}

fn unknown_colour(
    [x, y]: [usize; 2],
    [r, g, b]: [u8; 3],
    wrong: impl Fn(String, Option<String>) -> PlanError,
) -> PlanError {
    let nearest = Paint::all()
        .map(|paint| (distance(paint.colour().map(f64::from), [r, g, b].map(f64::from)), paint))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let hint = nearest.map(|(_, paint)| {
        let [pr, pg, pb] = paint.colour();
        format!(
            "the nearest is {}, #{pr:02x}{pg:02x}{pb:02x}; paint with a hard brush, or leave the pixel transparent",
            paint.name()
        )
    });
    wrong(format!("has the colour #{r:02x}{g:02x}{b:02x} at pixel [{x}, {y}], which stands for nothing"), hint)
}

/// The paint of every pixel, or the first pixel whose colour is no paint, with that colour.
fn layer_of(image: &RgbaImage) -> Result<Layer, (usize, [u8; 3])> {
    let width = image.width() as usize;
    let pixels: &[[u8; 4]] = image.as_raw().as_chunks().0;
    let colours: Vec<[u8; 3]> = Paint::all().map(Paint::colour).collect();
    let is_bare = |pixel: [u8; 4]| pixel[3] < 128;
    // The colour of a half transparent pixel is that of its paint: PNG does not multiply it.
    let sure = |[r, g, b, _]: [u8; 4]| {
        let fits =
            |colour: &[u8; 3]| colour.iter().zip([r, g, b]).all(|(&a, b)| (i32::from(a) - i32::from(b)).abs() <= EXACT);
        colours.iter().position(fits).map_or(0, |number| number as u8 + 1)
    };
    let code = |&pixel: &[u8; 4]| if is_bare(pixel) { 0 } else { sure(pixel) };
    let codes: Vec<u8> = pixels.par_iter().map(code).collect();
    let blends: Vec<u8> = (0..pixels.len())
        .into_par_iter()
        .map(|at| {
            let (pixel, code) = (pixels[at], codes[at]);
            if is_bare(pixel) || (code != 0 && !is_between(&codes, width, at, &colours)) {
                return Ok(code);
            }
            let colour = [pixel[0], pixel[1], pixel[2]];
            blended(&codes, width, at, colour, &colours).or(Some(code).filter(|&code| code != 0)).ok_or((at, colour))
        })
        .collect::<Vec<Result<u8, (usize, [u8; 3])>>>()
        .into_iter()
        .collect::<Result<_, _>>()?;
    Ok(Layer { codes: blends, own: codes })
}

/// The paints within `reach` pixels, a bit per code, and how many pixels have the code of the middle.
fn around(codes: &[u8], width: usize, at: usize, reach: usize) -> (u32, usize) {
    let (x, y, height) = (at % width, at / width, codes.len() / width);
    let (mut found, mut same) = (0u32, 0);
    for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
        for &code in &codes[row * width + x.saturating_sub(reach)..=row * width + (x + reach).min(width - 1)] {
            found |= 1 << code;
            same += usize::from(code == codes[at]);
        }
    }
    (found & !1, same)
}

/// Whether a pixel has a paint's colour by chance: few pixels beside it share it, and it lies between two others'.
fn is_between(codes: &[u8], width: usize, at: usize, colours: &[[u8; 3]]) -> bool {
    let own = codes[at];
    let beside = |step: isize| at.checked_add_signed(step).and_then(|near| codes.get(near));
    // Most pixels lie amid their own paint.
    if [-1, 1, -(width as isize), width as isize].into_iter().all(|step| beside(step).is_none_or(|&code| code == own)) {
        return false;
    }
    let (found, same) = around(codes, width, at, 2);
    let colour = colours[usize::from(own) - 1];
    let mut others = found & !(1 << own);
    if own == OUTSIDE {
        // Thin black lines on white fade through this grey without being black anywhere.
        others |= 1 << WALL;
    }
    same < FIRM && others.count_ones() >= 2 && blend_of(others, colour, colours).is_some_and(|(off, _)| off <= NEAR)
}

/// The paint of a pixel that no paint has the colour of: of those nearby, the one that it shows most of.
fn blended(codes: &[u8], width: usize, at: usize, colour: [u8; 3], colours: &[[u8; 3]]) -> Option<u8> {
    let own = codes[at];
    for reach in REACHES {
        let mut found = around(codes, width, at, reach).0;
        if own != 0 {
            found &= !(1 << own);
        }
        let single = numbers(found)
            .map(|number| (distance(colours[number].map(f64::from), colour.map(f64::from)), number))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(off, _)| *off <= NEAR);
        let pair = blend_of(found, colour, colours).filter(|(off, _)| *off <= BLEND);
        if let Some((_, number)) = single.or(pair) {
            return Some(number as u8 + 1);
        }
    }
    // A thin line may be blended all along.
    let found = around(codes, width, at, REACHES[REACHES.len() - 1]).0;
    let all = (1 << (colours.len() + 1)) - 2;
    if let Some((_, number)) = blend_between(found, all, colour, colours).filter(|(off, _)| *off <= FAINT) {
        return Some(number as u8 + 1);
    }
    let nearest = (0..colours.len())
        .map(|number| (distance(colours[number].map(f64::from), colour.map(f64::from)), number))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= NEAR).then_some(nearest.1 as u8 + 1)
}

/// Numbers of the paints of a set of codes.
fn numbers(found: u32) -> impl Iterator<Item = usize> + Clone {
    (1..32).filter(move |code| found & (1 << code) != 0).map(|code| code - 1)
}

/// The pair of paints whose blend is nearest to a colour: the distance, and the nearer of the two.
fn blend_of(found: u32, colour: [u8; 3], colours: &[[u8; 3]]) -> Option<(f64, usize)> {
    blend_between(found, found, colour, colours)
}

/// The same for pairs of one paint of each set.
fn blend_between(one: u32, other: u32, colour: [u8; 3], colours: &[[u8; 3]]) -> Option<(f64, usize)> {
    let p = colour.map(f64::from);
    let mut best: Option<(f64, usize)> = None;
    for a in numbers(one) {
        for b in numbers(other).filter(|&b| b != a) {
            let [from, to] = [a, b].map(|number| colours[number].map(f64::from));
            let along = [0, 1, 2].map(|k| to[k] - from[k]);
            let length = along.iter().map(|v| v * v).sum::<f64>();
            let way = ((0..3).map(|k| (p[k] - from[k]) * along[k]).sum::<f64>() / length).clamp(0.0, 1.0);
            let off = distance([0, 1, 2].map(|k| from[k] + way * along[k]), p);
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, if way < 0.5 { a } else { b }));
            }
        }
    }
    best
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

impl FloorPlan {
    /// The plan at its own size in the colours of its classes, to be painted over.
    ///
    /// Read back as paint, it changes nothing.
    pub fn painted_picture(&self) -> RgbImage {
        let colour = |at: usize| match self.painted.marks.get(at) {
            Some(&IN_ENTRANCE) => Paint::Entrance.colour(),
            Some(&KEPT_CLEAN) => Paint::KeepClean.colour(),
            _ => self.classes[at].colour(),
        };
        let bytes: Vec<u8> = (0..self.classes.len()).into_par_iter().flat_map_iter(colour).collect();
        RgbImage::from_raw(self.width_px, self.height_px, bytes).unwrap_or_default()
    }

    /// Whether feet leave no dirt at a point of the plan frame.
    pub(crate) fn is_kept_clean(&self, p: crate::math::Vec2) -> bool {
        let [x, y] = self.m_to_px(p);
        let within = x >= 0.0 && y >= 0.0 && x < f64::from(self.width_px) && y < f64::from(self.height_px);
        let at = || y as usize * self.width_px as usize + x as usize;
        within && self.painted.marks.get(at()) == Some(&KEPT_CLEAN)
    }
}

#[cfg(test)]
mod tests {
    use image::{Rgba, imageops};

    use super::*;
    use crate::plan::{PlanOptions, read as read_plan};

    /// Two rooms of 4 x 4 m with a door between them, a column of 0.4 m in one, openings to both sides; walls are drawn
    /// a quarter of a pixel off the pixels.
    fn drawn() -> image::GrayImage {
        const PART: f64 = 0.25;
        // Rectangles of wall, pixels: left, top, right, bottom.
        let walls = [
            [-9.0, -9.0, 220.0, 10.0 + PART],
            [-9.0, 90.0 - PART, 220.0, 109.0],
            [90.0 + PART, 0.0, 94.0, 40.0],
            [90.0 + PART, 60.0, 94.0, 109.0],
            [30.0 + PART, 30.0 + PART, 38.0 + PART, 38.0 + PART],
        ];
        image::GrayImage::from_fn(180, 100, |x, y| {
            let share = |from: f64, to: f64, at: u32| (to.min(f64::from(at) + 1.0) - from.max(f64::from(at))).max(0.0);
            let dark = walls.iter().map(|[l, t, r, b]| share(*l, *r, x) * share(*t, *b, y)).fold(0.0, f64::max);
            image::Luma([(255.0 * (1.0 - dark)).round() as u8])
        })
    }

    struct Case {
        folder: std::path::PathBuf,
        options: PlanOptions,
    }

    impl Case {
        fn new(name: &str) -> Case {
            let folder = std::env::temp_dir().join(format!("trodden-paint-{}-{name}", std::process::id()));
            std::fs::create_dir_all(&folder).unwrap();
            drawn().save(folder.join("plan.png")).unwrap();
            Case { folder, options: PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() } }
        }

        fn plan(&self) -> FloorPlan {
            read_plan(&self.folder.join("plan.png"), &self.options).unwrap()
        }

        fn painted(&self, paint: &RgbaImage) -> Result<FloorPlan, PlanError> {
            let file = self.folder.join("over.png");
            paint.save(&file).unwrap();
            let options = PlanOptions { paint: Some(file), ..self.options.clone() };
            read_plan(&self.folder.join("plan.png"), &options)
        }
    }

    impl Drop for Case {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.folder);
        }
    }

    fn whole(plan: &FloorPlan) -> RgbaImage {
        image::DynamicImage::ImageRgb8(plan.painted_picture()).into_rgba8()
    }

    fn bare() -> RgbaImage {
        RgbaImage::new(180, 100)
    }

    fn fill(image: &mut RgbaImage, [left, top, right, bottom]: [u32; 4], paint: Paint) {
        let [r, g, b] = paint.colour();
        for y in top..bottom {
            for x in left..right {
                image.put_pixel(x, y, Rgba([r, g, b, 255]));
            }
        }
    }

    fn assert_same(a: &FloorPlan, b: &FloorPlan) {
        assert!(a.floor == b.floor && a.classes == b.classes && a.lightness == b.lightness);
        assert_eq!((&a.regions, &a.openings, &a.painted), (&b.regions, &b.openings, &b.painted));
    }

    #[test]
    fn a_plan_painted_back_changes_nothing() {
        let case = Case::new("round");
        let plan = case.plan();
        assert_same(&case.painted(&whole(&plan)).unwrap(), &plan);
        assert_same(&case.painted(&bare()).unwrap(), &plan);
        // Three pixels of paint for each of the plan.
        let large = imageops::resize(&whole(&plan), 540, 300, imageops::FilterType::Nearest);
        assert_same(&case.painted(&large).unwrap(), &plan);
    }

    #[test]
    fn every_sample_plan_painted_back_changes_nothing() {
        for (name, metres_per_pixel) in [("museum", 0.05), ("school", 0.05), ("station", 0.1)] {
            let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("floorplans/{name}.png"));
            let options = PlanOptions { metres_per_pixel: Some(metres_per_pixel), ..PlanOptions::default() };
            let plan = read_plan(&file, &options).unwrap();
            let folder = Case::new(name);
            let paint = folder.folder.join("over.png");
            plan.painted_picture().save(&paint).unwrap();
            assert_same(&read_plan(&file, &PlanOptions { paint: Some(paint), ..options }).unwrap(), &plan);
        }
    }

    #[test]
    fn the_docs_list_every_paint() {
        let docs = include_str!("../../docs/plans_editing.md");
        for paint in Paint::all() {
            let [r, g, b] = paint.colour();
            let row = format!("| {} | `#{r:02x}{g:02x}{b:02x}` | {} |", paint.name(), paint.meaning());
            assert!(docs.contains(&row), "{row}");
        }
    }

    #[test]
    fn a_column_painted_away_changes_exactly_its_pixels() {
        let case = Case::new("column");
        let plan = case.plan();
        for paint in [Paint::Class(PlanClass::Floor), Paint::Erase] {
            let mut layer = bare();
            fill(&mut layer, [29, 29, 40, 40], paint);
            let painted = case.painted(&layer).unwrap();
            let is_column = |at: usize| (30..39).contains(&(at % 180)) && (30..39).contains(&(at / 180));
            let changed: Vec<usize> = (0..plan.floor.len()).filter(|&at| plan.floor[at] != painted.floor[at]).collect();
            assert!(changed.len() >= 64 && changed.iter().all(|&at| is_column(at) && painted.floor[at] == 1));
            let off = (0..plan.floor.len()).find(|&at| !is_column(at) && plan.lightness[at] != painted.lightness[at]);
            assert_eq!(off, None, "walls elsewhere keep their positions");
            assert!(painted.classes.iter().zip(&painted.floor).all(|(c, &f)| (*c == PlanClass::Floor) == (f == 1)));
        }
    }

    #[test]
    fn painted_furniture_stands_on_the_floor_with_its_class() {
        let case = Case::new("table");
        let plan = case.plan();
        let mut layer = bare();
        fill(&mut layer, [120, 40, 150, 56], Paint::Class(PlanClass::Table));
        let painted = case.painted(&layer).unwrap();
        let tables = painted.classes.iter().filter(|&&class| class == PlanClass::Table).count();
        let floors = |plan: &FloorPlan| plan.floor.iter().filter(|&&floor| floor != 0).count();
        assert_eq!((tables, floors(&plan) - floors(&painted)), (30 * 16, 30 * 16));
        assert_same(&case.painted(&whole(&painted)).unwrap(), &painted);
    }

    #[test]
    fn a_door_painted_shut_and_another_open() {
        let case = Case::new("doors");
        let plan = case.plan();
        let mut layer = bare();
        fill(&mut layer, [90, 38, 94, 62], Paint::Class(PlanClass::Wall));
        let shut = case.painted(&layer).unwrap();
        assert!((38..62).all(|y| shut.floor[y * 180 + 92] == 0));
        fill(&mut layer, [88, 70, 96, 84], Paint::Class(PlanClass::Door));
        let moved = case.painted(&layer).unwrap();
        assert!((70..84).all(|y| (88..96).all(|x| moved.floor[y * 180 + x] == 1)));
        assert_eq!(plan.openings, moved.openings);
    }

    #[test]
    fn a_soft_brush_paints_the_nearer_class() {
        let case = Case::new("soft");
        let mut layer = whole(&case.plan());
        fill(&mut layer, [120, 40, 150, 56], Paint::Class(PlanClass::Counter));
        // The brush is soft; the walls are as they were written.
        let soft = imageops::crop_imm(&imageops::blur(&layer, 1.2), 110, 30, 50, 36).to_image();
        imageops::replace(&mut layer, &soft, 110, 30);
        let painted = case.painted(&layer).unwrap();
        let count = painted.classes.iter().filter(|&&class| class == PlanClass::Counter).count();
        assert!((440..=520).contains(&count), "{count} of 480 pixels");
        // Grey between black and white is not the grey of what lies outside.
        let outside = |plan: &FloorPlan| plan.classes.iter().filter(|&&class| class == PlanClass::Outside).count();
        assert_eq!(outside(&painted), outside(&case.plan()));
    }

    #[test]
    fn entrances_and_clean_floor_are_told() {
        let case = Case::new("entrance");
        let mut layer = bare();
        fill(&mut layer, [50, 82, 60, 90], Paint::Entrance);
        fill(&mut layer, [100, 60, 120, 80], Paint::KeepClean);
        let painted = case.painted(&layer).unwrap();
        let [entrance] = &painted.painted.entrances[..] else { panic!("{:?}", painted.painted.entrances) };
        assert_eq!((entrance.name.as_str(), entrance.area_m[0].x, entrance.area_m[1].y), ("entrance", 2.5, 0.9));
        assert!(painted.is_kept_clean(crate::math::vec2(5.5, 1.5)));
        assert!(!painted.is_kept_clean(crate::math::vec2(4.5, 1.5)));
        assert_eq!(painted.floor, case.plan().floor);
        assert_same(&case.painted(&whole(&painted)).unwrap(), &painted);
    }

    #[test]
    fn wrong_paint_says_where() {
        let case = Case::new("wrong");
        let mut layer = whole(&case.plan());
        layer.put_pixel(120, 50, Rgba([10, 250, 140, 255]));
        let error = case.painted(&layer).unwrap_err();
        assert!(error.to_string().contains("the colour #0afa8c at pixel [120, 50]"), "{error}");
        assert!(error.hint().unwrap().contains("the nearest is keep clean, #00ffff"), "{:?}", error.hint());
        let error = case.painted(&RgbaImage::new(181, 100)).unwrap_err();
        assert!(error.to_string().contains("has 181 x 100 pixels, the plan has 180 x 100"), "{error}");
        let options = PlanOptions { paint: Some(case.folder.join("none.png")), ..case.options.clone() };
        let error = read_plan(&case.folder.join("plan.png"), &options).unwrap_err();
        assert!(error.to_string().contains("none.png cannot be read"), "{error}");
    }
}
