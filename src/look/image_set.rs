//! The images of a floor or wall: one picture, or a folder as libraries of materials hand them out.

use std::path::{Path, PathBuf};

use super::error::LookError;
use super::image::RepeatedImage;
use crate::files::files_in;
use crate::math::srgb;

/// Words by which file names tell what an image shows.
const COLOUR: &[&str] = &["color", "colour", "col", "albedo", "basecolor", "diffuse", "diff"];
const ROUGHNESS: &[&str] = &["roughness", "rough"];
const HEIGHT: &[&str] = &["height", "displacement", "disp", "bump"];
const NORMAL: &[&str] = &["normal", "nor", "nrm", "normalgl", "normaldx"];
const DIRECTX: &[&str] = &["dx", "directx", "normaldx"];
/// Other images that come with sets, which are not read: they decide that a file is none of the above.
const OTHER: &[&str] = &["ao", "ambient", "occlusion", "arm", "orm", "metalness", "metallic", "gloss", "spec", "mask"];
/// Endings of pictures.
const ENDINGS: &[&str] = &["png", "jpg", "jpeg", "bmp", "tif", "tiff", "gif", "pgm"];

/// Paths of the images of a surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ImageSet {
    pub colour: PathBuf,
    pub roughness: Option<PathBuf>,
    pub height: Option<PathBuf>,
    /// And whether green points down the image (DirectX).
    pub normal: Option<(PathBuf, bool)>,
}

/// What an image shows, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shows {
    Colour,
    Roughness,
    Height,
    Normal { directx: bool },
}

impl ImageSet {
    /// The picture at a path; of a folder, the images that its file names tell, as `wood_diff_1k.jpg`,
    /// `Wood051_NormalGL.png` or `T_Wood_BaseColor.png`. Where there are several of a kind, the first by name.
    pub fn find(path: &Path) -> Result<ImageSet, LookError> {
        let mut set = ImageSet { colour: path.to_path_buf(), roughness: None, height: None, normal: None };
        if !path.is_dir() {
            return Ok(set);
        }
        let mut files = files_in(path);
        files.sort();
        let mut colour = None;
        for file in files {
            match shows(&file) {
                Some(Shows::Colour) => _ = colour.get_or_insert(file),
                Some(Shows::Roughness) => _ = set.roughness.get_or_insert(file),
                Some(Shows::Height) => _ = set.height.get_or_insert(file),
                Some(Shows::Normal { directx }) => match &set.normal {
                    Some((_, false)) => {}
                    _ if directx && set.normal.is_some() => {}
                    _ => set.normal = Some((file, directx)),
                },
                None => {}
            }
        }
        let none = || LookError::Image {
            path: path.to_path_buf(),
            message: format!("no picture in the folder has one of {} in its name", COLOUR.join(", ")),
        };
        Ok(ImageSet { colour: colour.ok_or_else(none)?, ..set })
    }
}

/// The files that a look's image is read from: itself, or those of its folder.
///
/// # Errors
/// A folder without an image of the colour.
pub(crate) fn look_files(image: &Path) -> Result<Vec<PathBuf>, LookError> {
    let ImageSet { colour, roughness, height, normal } = ImageSet::find(image)?;
    Ok([Some(colour), roughness, height, normal.map(|(path, _)| path)].into_iter().flatten().collect())
}

/// What a file shows: the last word of its name that tells it counts, as `rough_wood_diff.jpg` is a colour.
fn shows(file: &Path) -> Option<Shows> {
    let ending = file.extension()?.to_str()?.to_lowercase();
    if !ENDINGS.contains(&ending.as_str()) {
        return None;
    }
    let words = words(file.file_stem()?.to_str()?);
    let has = |list: &[&str], word: &String| list.contains(&word.as_str());
    let word =
        words.iter().rfind(|word| [COLOUR, ROUGHNESS, HEIGHT, NORMAL, OTHER].iter().any(|list| has(list, word)))?;
    let kinds = [(COLOUR, Shows::Colour), (ROUGHNESS, Shows::Roughness), (HEIGHT, Shows::Height)];
    if has(NORMAL, word) {
        return Some(Shows::Normal { directx: words.iter().any(|word| has(DIRECTX, word)) });
    }
    kinds.into_iter().find(|(list, _)| has(list, word)).map(|(_, shows)| shows)
}

/// Words of a file name in lower case, cut at signs, at digits and before capitals.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for c in name.chars() {
        let starts = c.is_uppercase() && before.is_lowercase();
        if !c.is_alphabetic() || starts {
            words.push(String::new());
        }
        if let (true, Some(word)) = (c.is_alphabetic(), words.last_mut()) {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words
}

/// The images of a surface, repeated over it.
pub(super) struct SurfaceImages {
    pub colour: RepeatedImage,
    pub roughness: Option<RepeatedImage>,
    /// And how far it goes from black to white, millimetres.
    pub height: Option<(RepeatedImage, f32)>,
    /// And 1 where green points up the image, -1 where down.
    pub normal: Option<(RepeatedImage, f32)>,
}

impl SurfaceImages {
    /// Opens the images at a path, which show `size_m`.
    pub fn open(
        path: &Path,
        size_m: [f64; 2],
        height_mm: f32,
        texels_per_metre: f64,
    ) -> Result<SurfaceImages, LookError> {
        let ImageSet { colour, roughness, height, normal } = ImageSet::find(path)?;
        let share = |rgb: [u8; 3]| rgb.map(|level| f32::from(level) / 255.0);
        let data = |path: &PathBuf| RepeatedImage::open(path, size_m, texels_per_metre, share);
        Ok(SurfaceImages {
            colour: RepeatedImage::open(&colour, size_m, texels_per_metre, srgb::light_of)?,
            roughness: roughness.as_ref().map(data).transpose()?,
            height: match &height {
                Some(path) => Some((data(path)?, height_mm)),
                None => None,
            },
            normal: match &normal {
                Some((path, directx)) => Some((data(path)?, if *directx { -1.0 } else { 1.0 })),
                None => None,
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_of_free_libraries_are_known() {
        let of = |name: &str| shows(Path::new(name));
        for name in ["Wood051_1K-JPG_Color.jpg", "rough_wood_diff_1k.jpg", "T_Floor_BaseColor.PNG", "xyz_4K_Albedo.jpg"]
        {
            assert_eq!(of(name), Some(Shows::Colour), "{name}");
        }
        for name in ["Wood051_1K-JPG_Roughness.jpg", "rough_wood_rough_1k.jpg", "tiles_Roughness.tif"] {
            assert_eq!(of(name), Some(Shows::Roughness), "{name}");
        }
        for name in ["Wood051_1K-JPG_Displacement.jpg", "rough_wood_disp_1k.png", "tiles_height.png"] {
            assert_eq!(of(name), Some(Shows::Height), "{name}");
        }
        for (name, directx) in [
            ("a_NormalGL.jpg", false),
            ("a_NormalDX.jpg", true),
            ("a_nor_gl_1k.png", false),
            ("a_nor_dx.png", true),
            ("b_Normal.png", false),
        ] {
            assert_eq!(of(name), Some(Shows::Normal { directx }), "{name}");
        }
        for name in
            ["Wood051_AmbientOcclusion.jpg", "rough_wood_arm_1k.jpg", "rough_wood.blend", "preview.png", "normal.txt"]
        {
            assert_eq!(of(name), None, "{name}");
        }
    }

    #[test]
    fn opengl_normals_come_before_those_of_directx() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a_NormalDX.png", "a_NormalGL.png", "a_Color.png", "notes.txt"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let set = ImageSet::find(folder.path()).unwrap();
        assert_eq!(set.normal, Some((folder.path().join("a_NormalGL.png"), false)));
        assert_eq!((set.colour, set.height), (folder.path().join("a_Color.png"), None));
        let empty = tempfile::tempdir().unwrap();
        let error = ImageSet::find(empty.path()).unwrap_err().to_string();
        assert!(error.contains("no picture in the folder has one of color"), "{error}");
    }
}
