//! The fitted look as a file, as a table and as a picture.

use image::{RgbImage, imageops};
use serde::Serialize;

use super::measure::{GRAIN_TEXELS_PER_M, Measured, Uneven};
use super::options::FitOptions;
use super::photo::FloorPicture;
use super::search::Search;
use crate::look::error::LookError;
use crate::look::settings::{AgeLook, Look};
use crate::math::srgb::{self, lightness, luminance};
use crate::patterns::side_by_side;

/// Longest side of each picture, pixels.
const SIDE: u32 = 1600;

/// A measure of a photographed floor and of ours.
#[derive(Clone, Debug, Serialize)]
pub struct FitMeasure {
    /// What it is.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Of the photograph.
    pub photo: f64,
    /// Of our floor with the fitted look.
    pub ours: f64,
}

/// A look that reproduces a photographed floor.
#[derive(Clone, Debug)]
pub struct FittedLook {
    /// The look.
    pub look: Look,
    /// The look as a file that [`Look::read`] reads: what was measured, and in comments what was not.
    pub toml: String,
    /// What was measured, of the photograph and of our floor.
    pub measures: Vec<FitMeasure>,
    /// Keys that one photograph does not tell, which stay as they were, and why.
    pub kept: Vec<[&'static str; 2]>,
    /// The straightened photograph and our floor beside each other.
    pub picture: RgbImage,
    /// Texels per metre of both.
    pub texels_per_metre: f64,
}

/// What one photograph does not tell.
const KEPT: [[&str; 2]; 10] = [
    ["floor.material", "given, not measured: it decides how the floor takes film, marks and wear"],
    ["floor.roughness", "gloss needs light from several sides"],
    ["total_passes", "nor film.per_pass: how fast the film grows needs photographs of several ages"],
    [
        "film.colour",
        "its hue and strength are measured, its lightness is not: thin dark film looks like thick light film",
    ],
    ["noise.coarse", "clouds of 1.2 m are too few on a photograph, and look like lanes and light"],
    ["prints", "which marks are readable prints of soles cannot be told from scuffs and stains"],
    ["scuffs.strength", "marks count for age.rubs_per_m2, grit and gum together; those of heels come from the bake"],
    ["dust", "its slow fall from the wall looks like the margin of the lane"],
    ["dwell", "nor wheels, wet, age.stains_per_m2: they come from where people stand, roll and come in"],
    ["wall", "the photograph shows a floor"],
];

pub(super) fn report(search: Search<'_>, options: &FitOptions, photo: &FloorPicture) -> Result<FittedLook, LookError> {
    let (target, target_marks) = (search.target, search.target_marks);
    let shown = search.shown()?;
    let (ours, our_marks) = search.measured_with_marks()?;
    let marks = [target_marks, our_marks];
    let texels_per_metre = photo.texels_per_metre;
    let shows_grain = texels_per_metre >= GRAIN_TEXELS_PER_M;
    let mut kept = KEPT.to_vec();
    if search.clean.is_none() {
        kept.push(["age.density", "without a part that is clean, the margin has the age that the look has"]);
    }
    if !search.tells_grain {
        let why = "grain of 2 cm needs a closer photograph, of a lane that differs more from the margin";
        kept.push(["noise.fine", why]);
    }
    let blotches = "blotches and streaks of the mop look alike: both are changed by one factor, mop.takes stays";
    let hidden = "nor mop.unevenness: the floor's own texture is stronger than the blotches of the film";
    kept.push(["noise.middle", if search.tells_blotches { blotches } else { hidden }]);
    if !search.tells_marks {
        kept.push([
            "age.rubs_per_m2",
            "nor grit, nor gum: there are too few black marks, or the floor's own lines look like them",
        ]);
    }
    if !search.has_walls() {
        kept.push(["edge", "no side of the rectangle is said to stand at a wall"]);
    }
    let picture_of = |floor: &FloorPicture| {
        let picture = floor.picture();
        let longest = picture.width().max(picture.height());
        if longest <= SIDE {
            return picture;
        }
        let side = |px: u32| (px * SIDE / longest).max(1);
        imageops::thumbnail(&picture, side(picture.width()), side(picture.height()))
    };
    Ok(FittedLook {
        toml: toml(&search, options, &kept),
        measures: measures([&target, &ours], marks, shows_grain, search.has_walls()),
        kept,
        picture: side_by_side(&[("photograph", picture_of(photo)), ("our floor", picture_of(&shown))]),
        texels_per_metre,
        look: search.look,
    })
}

fn measures([photo, ours]: [&Measured; 2], marks: [f64; 2], shows_grain: bool, has_walls: bool) -> Vec<FitMeasure> {
    let mut rows = Vec::new();
    let mut row = |name, unit, photo, ours| rows.push(FitMeasure { name, unit, photo, ours });
    let byte = |light: f64| 255.0 * srgb::encode(light);
    for (k, names) in [["margin red", "lane red"], ["margin green", "lane green"], ["margin blue", "lane blue"]]
        .into_iter()
        .enumerate()
    {
        row(names[0], "sRGB", byte(photo.margin[k]), byte(ours.margin[k]));
        row(names[1], "sRGB", byte(photo.lane[k]), byte(ours.lane[k]));
    }
    let of = |m: &Measured| lightness(luminance(m.margin));
    row("margin lightness", "L*", of(photo), of(ours));
    row("lane contrast", "L*", photo.contrast(), ours.contrast());
    let sd = |uneven: Uneven| uneven.lane.sqrt();
    if shows_grain {
        row("grain of the lane, 2 cm", "sRGB", sd(photo.grain), sd(ours.grain));
    }
    row("blotches of the lane, 3 to 12 cm", "sRGB", sd(photo.blotches), sd(ours.blotches));
    row("black marks", "1/m2", marks[0], marks[1]);
    if has_walls {
        row("line at the wall, 0 to 4 cm", "sRGB", photo.edge[0], ours.edge[0]);
        row("beside the line, 4 to 10 cm", "sRGB", photo.edge[1], ours.edge[1]);
    }
    rows
}

fn toml(search: &Search<'_>, options: &FitOptions, kept: &[[&str; 2]]) -> String {
    let look = &search.look;
    let colour = |[r, g, b]: [u8; 3]| format!("[{r}, {g}, {b}]");
    let mut text = format!(
        "# A look measured in a photograph of {} x {} m of floor, over whose lane {} people had walked.\npreset = \"{}\"\n",
        options.metres[0], options.metres[1], options.passes, look.preset
    );
    let material = serde_json::to_value(look.floor.material).unwrap_or_default();
    let floor = look.floor.colour.map(colour).unwrap_or_default();
    text.push_str(&format!("\n[floor]\nmaterial = {material}\ncolour = {floor}\n"));
    text.push_str(&format!("\n[film]\ndensity = {:.3}\ncolour = {}\n", look.film.density, colour(look.film.colour)));
    let age = &look.age;
    if search.clean.is_some() || search.tells_marks {
        text.push_str("\n[age]\n");
    }
    if search.clean.is_some() {
        text.push_str(&format!("density = {:.3}\n", age.density));
    }
    if search.tells_marks {
        let AgeLook { rubs_per_m2, grit_per_m2, gum_per_m2, .. } = age;
        text.push_str(&format!(
            "rubs_per_m2 = {rubs_per_m2:.2}\ngrit_per_m2 = {grit_per_m2:.2}\ngum_per_m2 = {gum_per_m2:.3}\n"
        ));
    }
    if search.tells_blotches {
        text.push_str(&format!("\n[mop]\nunevenness = {:.3}\n", look.mop.unevenness));
    }
    if search.tells_grain || search.tells_blotches {
        text.push_str("\n[noise]\n");
    }
    let octaves = [("fine", look.noise.fine, search.tells_grain), ("middle", look.noise.middle, search.tells_blotches)];
    for (name, octave, _) in octaves.into_iter().filter(|(_, _, is_told)| *is_told) {
        text.push_str(&format!("{name} = {{ size_m = {}, sd = {:.3} }}\n", octave.size_m, octave.sd));
    }
    if search.has_walls() {
        let edge = &look.edge;
        text.push_str(&format!("\n[edge]\ndensity = {:.3}\nreach_m = {:.4}\n", edge.density, edge.reach_m));
    }
    text.push_str("\n# Not told by one photograph, so that the preset's values stay:\n");
    for [key, why] in kept {
        text.push_str(&format!("# {key}: {why}\n"));
    }
    text
}
