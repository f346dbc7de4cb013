//! Decodes one pattern image and brings it to 10 px/cm.

use std::io::Cursor;

use image::{ImageReader, Limits};

use super::{Cause, PATTERN_PX_PER_CM};

/// Limit on the side of an image, pixels.
const MOST_PX: u32 = 8192;
/// Range of resolutions, pixels per centimetre: coarser images show no tread, finer ones have a wrong length.
const RESOLUTIONS: [f64; 2] = [4.0, 200.0];
/// Coverage of a pattern at 10 px/cm, 0 to 255, in image order.
pub(super) struct Coverage {
    pub width_px: u32,
    pub height_px: u32,
    pub values: Vec<u8>,
}

/// Reason why a pattern image is refused.
pub(super) enum PatternImageError {
    /// The image cannot be decoded: the decoder's message.
    Unreadable(String),
    /// The image is decoded but is not a pattern: the problem.
    Unfit(String),
}

/// Decodes an image whose width is `length_cm` and resamples it to 10 px/cm by area.
pub(super) fn read(bytes: &[u8], cause: Cause, length_cm: f64) -> Result<Coverage, PatternImageError> {
    let (width, height, values) = decode(bytes)?;
    check(width, height, &values, cause, length_cm)?;
    let width_px = (length_cm * PATTERN_PX_PER_CM).round().max(1.0) as u32;
    let scale = f64::from(width_px) / f64::from(width);
    let height_px = (f64::from(height) * scale).round().max(1.0) as u32;
    let values = if (width_px, height_px) == (width, height) {
        values
    } else {
        let reduced = resample_rows(&values, width as usize, width_px as usize);
        let turned = transpose(&reduced, width_px as usize);
        transpose(&resample_rows(&turned, height as usize, height_px as usize), height_px as usize)
    };
    let values = values.into_iter().map(|value| (value * 255.0).round() as u8).collect();
    Ok(Coverage { width_px, height_px, values })
}

/// Decodes an image to width, height and coverage (0 to 1): brightness times opacity.
fn decode(bytes: &[u8]) -> Result<(u32, u32, Vec<f32>), PatternImageError> {
    let unreadable = |reason: String| PatternImageError::Unreadable(reason);
    if bytes.is_empty() {
        return Err(unreadable("the file is empty".to_owned()));
    }
    let reader = || ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let (width, height) =
        reader().map_err(|e| unreadable(e.to_string()))?.into_dimensions().map_err(|e| unreadable(e.to_string()))?;
    if width > MOST_PX || height > MOST_PX {
        return Err(PatternImageError::Unfit(format!("is {width} x {height} px, allowed are {MOST_PX} px a side")));
    }
    let mut reader = reader().map_err(|e| unreadable(e.to_string()))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST_PX);
    limits.max_image_height = Some(MOST_PX);
    reader.limits(limits);
    let image = reader.decode().map_err(|e| unreadable(e.to_string()))?.into_luma_alpha16();
    let values = image.pixels().map(|pixel| f32::from(pixel.0[0]) / 65_535.0 * (f32::from(pixel.0[1]) / 65_535.0));
    let values = values.collect();
    Ok((width, height, values))
}

fn check(width: u32, height: u32, values: &[f32], cause: Cause, length_cm: f64) -> Result<(), PatternImageError> {
    let unfit = |problem: String| Err(PatternImageError::Unfit(problem));
    let resolution = f64::from(width) / length_cm;
    if !(RESOLUTIONS[0]..=RESOLUTIONS[1]).contains(&resolution) {
        return unfit(format!(
            "is {width} px wide, {resolution:.1} px/cm for length_cm = {length_cm}; allowed are {} to {} px/cm",
            RESOLUTIONS[0], RESOLUTIONS[1]
        ));
    }
    let aspect = f64::from(height) / f64::from(width);
    let [least, most] = cause.aspects();
    if !(least..=most).contains(&aspect) {
        return unfit(format!(
            "is {width} x {height} px; the length runs along the width, and height / width is {aspect:.2}, allowed \
             is {least} to {most} for cause = \"{}\"",
            cause.name()
        ));
    }
    let brightest = values.iter().copied().fold(0.0, f32::max);
    if brightest < 0.05 {
        return unfit("is empty: no pixel is brighter than 5 %, so it leaves nothing".to_owned());
    }
    let (width, height) = (width as usize, height as usize);
    let border = (0..width).flat_map(|i| [i, (height - 1) * width + i]);
    let border = border.chain((0..height).flat_map(|j| [j * width, j * width + width - 1]));
    let mean = border.map(|at| values[at]).sum::<f32>() / (2 * (width + height)) as f32;
    if mean > 0.7 {
        return unfit(format!(
            "has a bright border ({:.0} % on average, at most 70 % is allowed): a light background would leave soil",
            mean * 100.0
        ));
    }
    Ok(())
}

/// Resamples rows of `from` values to `to` values, each the mean over the length that it covers.
fn resample_rows(values: &[f32], from: usize, to: usize) -> Vec<f32> {
    let scale = from as f64 / to as f64;
    let mut out = Vec::with_capacity(values.len() / from * to);
    for row in values.chunks_exact(from) {
        for k in 0..to {
            let (start, end) = (k as f64 * scale, ((k + 1) as f64 * scale).min(from as f64));
            let last = (end.ceil() as usize).min(from);
            let sum: f64 = (start as usize..last)
                .map(|i| f64::from(row[i]) * (end.min((i + 1) as f64) - start.max(i as f64)))
                .sum();
            out.push((sum / (end - start)) as f32);
        }
    }
    out
}

fn transpose(values: &[f32], width: usize) -> Vec<f32> {
    let height = values.len() / width;
    (0..width).flat_map(|i| (0..height).map(move |j| values[j * width + i])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, ImageFormat, Luma};

    fn png(image: &GrayImage) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    fn disc(width: u32, height: u32) -> GrayImage {
        GrayImage::from_fn(width, height, |x, y| {
            let u = (f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0;
            let v = (f64::from(y) + 0.5) / f64::from(height) * 2.0 - 1.0;
            Luma([if u * u + v * v < 1.0 { 255 } else { 0 }])
        })
    }

    fn problem(bytes: &[u8], length_cm: f64) -> String {
        match read(bytes, Cause::Sole, length_cm) {
            Ok(_) => panic!("read"),
            Err(PatternImageError::Unreadable(reason)) => reason,
            Err(PatternImageError::Unfit(problem)) => problem,
        }
    }

    #[test]
    fn a_finer_image_is_reduced_and_keeps_its_mean() {
        let read_at = |factor: u32| read(&png(&disc(290 * factor, 105 * factor)), Cause::Sole, 29.0).ok().unwrap();
        let (fine, plain) = (read_at(3), read_at(1));
        assert_eq!((fine.width_px, fine.height_px), (290, 105));
        let mean = |c: &Coverage| c.values.iter().map(|&v| f64::from(v)).sum::<f64>() / c.values.len() as f64;
        assert!((mean(&fine) - mean(&plain)).abs() < 0.3, "{} {}", mean(&fine), mean(&plain));
    }

    #[test]
    fn an_image_at_10_px_per_cm_is_taken_as_it_is() {
        let image = disc(200, 80);
        let coverage = read(&png(&image), Cause::Sole, 20.0).ok().unwrap();
        assert_eq!(coverage.values, image.into_raw());
    }

    #[test]
    fn an_unfit_image_is_refused_with_its_reason() {
        assert!(problem(&[], 29.0).contains("empty"));
        assert!(problem(b"no image", 29.0).contains("format"));
        assert!(problem(&png(&disc(290, 105))[..200], 29.0).len() > 5);
        assert!(problem(&png(&GrayImage::new(290, 105)), 29.0).contains("leaves nothing"));
        assert!(problem(&png(&GrayImage::from_pixel(290, 105, Luma([255]))), 29.0).contains("border"));
        assert!(problem(&png(&disc(105, 290)), 10.5).contains("height / width is 2.76"));
        assert!(problem(&png(&disc(40, 20)), 29.0).contains("1.4 px/cm"));
    }

    #[test]
    fn wall_patterns_may_be_higher_than_long() {
        let hand = read(&png(&disc(100, 190)), Cause::Hand, 10.0).ok().unwrap();
        assert_eq!((hand.width_px, hand.height_px), (100, 190));
        assert!(read(&png(&disc(40, 190)), Cause::Hand, 4.0).is_err());
    }
}
