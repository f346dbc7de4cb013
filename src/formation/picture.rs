//! Formations from files: pictures of dots or filled shapes, and points as text.

use std::io::Cursor;
use std::path::Path;

use image::{ImageDecoder, ImageReader, Limits};

use super::request::RequestError;
use crate::files::{read_input, read_text};
use crate::math::{Vec2, vec2};

/// Longest side of a picture of a formation, pixels.
const MOST_PX: u32 = 4096;
/// Largest picture file, bytes.
const LARGEST_PICTURE: u64 = 256 << 20;

/// The positions in a picture, relative to its centre; up is forward.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FormationPicture {
    /// Centre of each dot, from the top left, pixels.
    pub dots_px: Vec<Vec2>,
    /// Centre of each drawn pixel, pixels.
    pub area_px: Vec<Vec2>,
}

/// Whether a file name is that of a picture; other files hold points as text.
pub fn is_picture(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let endings = ["png", "jpg", "jpeg", "bmp", "gif", "tif", "tiff", "pgm", "pbm", "ppm", "pnm"];
    ending.is_some_and(|ending| endings.contains(&ending.as_str()))
}

/// Reads a picture of dots or of a shape: dark on light or light on dark, whichever is more; transparent pixels are
/// background.
pub(super) fn read_picture(path: &Path) -> Result<FormationPicture, RequestError> {
    let failed = |problem: String| RequestError::File { path: path.to_path_buf(), problem };
    let bytes = read_input(path, LARGEST_PICTURE).map_err(|error| failed(error.to_string()))?;
    let mut reader = ImageReader::new(Cursor::new(bytes.as_slice()))
        .with_guessed_format()
        .map_err(|error| failed(error.to_string()))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(512 << 20);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| failed(format!("this is not a picture: {error}")))?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 || width > MOST_PX || height > MOST_PX {
        return Err(failed(format!("it has {width} x {height} pixels; allowed are 1 to {MOST_PX} a side")));
    }
    let picture = image::DynamicImage::from_decoder(decoder).map_err(|error| failed(error.to_string()))?;
    let pixels = picture.to_luma_alpha8();
    let values: Vec<(u8, bool)> = pixels.pixels().map(|pixel| (pixel.0[0], pixel.0[1] >= 128)).collect();
    let ink = ink(&values);
    if !ink.contains(&true) {
        return Err(failed("nothing is drawn in it".to_string()));
    }
    Ok(of_ink(&ink, width as usize, height as usize))
}

/// The drawn pixels: the rarer of dark and light, or the opaque ones if some are transparent.
fn ink(values: &[(u8, bool)]) -> Vec<bool> {
    let clear = values.iter().filter(|(_, opaque)| !opaque).count();
    if clear > 0 {
        return values.iter().map(|(_, opaque)| *opaque).collect();
    }
    let low = values.iter().map(|value| value.0).min().unwrap_or(0);
    let high = values.iter().map(|value| value.0).max().unwrap_or(0);
    if high - low < 32 {
        return vec![false; values.len()];
    }
    let threshold = low + (high - low) / 2;
    let dark = values.iter().filter(|value| value.0 <= threshold).count();
    let dark_is_ink = 2 * dark <= values.len();
    values.iter().map(|value| (value.0 <= threshold) == dark_is_ink).collect()
}

/// Finds dots as 8-connected components of drawn pixels.
fn of_ink(ink: &[bool], width: usize, height: usize) -> FormationPicture {
    let middle = vec2(width as f64, height as f64) / 2.0;
    let place = |k: usize| vec2((k % width) as f64 + 0.5 - middle.x, middle.y - (k / width) as f64 - 0.5);
    let mut seen = vec![false; ink.len()];
    let mut drawn = FormationPicture { dots_px: Vec::new(), area_px: Vec::new() };
    let mut open = Vec::new();
    for start in 0..ink.len() {
        if !ink[start] || seen[start] {
            continue;
        }
        seen[start] = true;
        open.push(start);
        let (mut sum, mut count) = (Vec2::ZERO, 0.0);
        while let Some(at) = open.pop() {
            sum += place(at);
            count += 1.0;
            let (x, y) = (at % width, at / width);
            for y in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                for x in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    let next = y * width + x;
                    if ink[next] && !seen[next] {
                        seen[next] = true;
                        open.push(next);
                    }
                }
            }
        }
        drawn.dots_px.push(sum / count);
    }
    drawn.area_px.extend((0..ink.len()).filter(|&k| ink[k]).map(place));
    drawn
}

/// Reads points as text: one per line, `x y` in metres, separated by blanks, commas or semicolons; `#` starts a comment.
pub(super) fn read_points(path: &Path) -> Result<Vec<Vec2>, RequestError> {
    let failed = |problem: String| RequestError::File { path: path.to_path_buf(), problem };
    let text = read_text(path).map_err(|error| failed(error.to_string()))?;
    points_of(&text).map_err(|(line, problem)| RequestError::Line { path: path.to_path_buf(), line, problem })
}

fn points_of(text: &str) -> Result<Vec<Vec2>, (usize, String)> {
    let mut points = Vec::new();
    for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let number = number + 1;
        let words = line.split('#').next().unwrap_or("");
        let words: Vec<&str> =
            words.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|word| !word.is_empty()).collect();
        if words.is_empty() {
            continue;
        }
        let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
        let Some([x, y]) = numbers.as_deref() else {
            return Err((number, "it is not a point: write two numbers, x and y in metres".to_string()));
        };
        let point = vec2(*x, *y);
        if !(x.abs() <= super::request::FARTHEST_M && y.abs() <= super::request::FARTHEST_M) {
            let most = super::request::FARTHEST_M;
            return Err((number, format!("the point ({x}, {y}) is out of range, allowed is -{most} to {most} m")));
        }
        points.push(point);
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayAlphaImage, GrayImage, Luma, LumaA};

    fn round_dots(dots: &[[f64; 2]], background: u8, dot: u8) -> GrayImage {
        GrayImage::from_fn(120, 80, |x, y| {
            let at = vec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let near = dots.iter().map(|&d| at.distance(Vec2::from(d))).fold(f64::MAX, f64::min);
            let share = (3.5 - near).clamp(0.0, 1.0);
            Luma([(f64::from(background) + (f64::from(dot) - f64::from(background)) * share) as u8])
        })
    }

    #[test]
    fn the_middles_of_dots_are_found_dark_or_light() {
        let folder = tempfile::tempdir().unwrap();
        let dots = [[20.0, 10.5], [100.0, 12.0], [60.0, 40.0], [33.3, 70.0]];
        for (background, dot) in [(255, 0), (0, 255), (200, 90)] {
            let path = folder.path().join("dots.png");
            round_dots(&dots, background, dot).save(&path).unwrap();
            let drawn = read_picture(&path).unwrap();
            assert_eq!(drawn.dots_px.len(), 4);
            for dot in dots {
                // The picture's middle is the origin, y points up.
                let expected = vec2(dot[0] - 60.0, 40.0 - dot[1]);
                assert!(drawn.dots_px.iter().any(|found| found.distance(expected) < 0.2), "{dot:?}: {drawn:?}");
            }
        }
    }

    #[test]
    fn transparent_pixels_are_background() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dots.png");
        let dot = |x: u32, y: u32| x < 4 && y < 4;
        let picture = GrayAlphaImage::from_fn(10, 10, |x, y| LumaA([0, if dot(x, y) { 255 } else { 0 }]));
        picture.save(&path).unwrap();
        let drawn = read_picture(&path).unwrap();
        assert_eq!((drawn.dots_px, drawn.area_px.len()), (vec![vec2(-3.0, 3.0)], 16));
    }

    #[test]
    fn what_is_no_picture_says_so() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dots.png");
        assert!(read_picture(&path).is_err());
        std::fs::write(&path, "text").unwrap();
        assert!(read_picture(&path).unwrap_err().to_string().contains("not a picture"));
        GrayImage::from_pixel(9, 9, Luma([7])).save(&path).unwrap();
        assert!(read_picture(&path).unwrap_err().to_string().contains("nothing is drawn"));
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        assert!(read_picture(&path).is_err());
    }

    #[test]
    fn points_are_read_whatever_stands_between_them() {
        assert_eq!(
            points_of("# x y\n1 2\n\n 3.5;-4 # here\n5,6e0\n").unwrap(),
            [[1.0, 2.0], [3.5, -4.0], [5.0, 6.0]].map(Vec2::from)
        );
        for (text, line, says) in [
            ("1 2\n3\n", 2, "two numbers"),
            ("1 2\nx y\n", 2, "two numbers"),
            ("1 nan\n", 1, "out of range"),
            ("1 inf\n", 1, "out of range"),
        ] {
            let (at, problem) = points_of(text).unwrap_err();
            assert!(at == line && problem.contains(says), "{text}: line {at}: {problem}");
        }
    }
}
