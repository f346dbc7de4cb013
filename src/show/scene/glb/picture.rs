//! Images within a scene, and references to those beside it.

use std::io::{self, Cursor};

use image::codecs::jpeg::JpegEncoder;
use image::{ImageFormat, RgbImage};

use crate::export::reduction::{halved_colours, halved_numbers};

/// Greatest width and height of an image within the scene, texels. A larger one is halved until it fits.
const MOST_EMBEDDED_PX: u32 = 2048;
/// Quality of base colour within the scene, 1 to 100.
const JPEG_QUALITY: u8 = 92;

/// Content of a texture image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextureContent {
    /// sRGB colour: averaged as light, kept as JPEG.
    Colour,
    /// Numbers: averaged as they are, kept without loss.
    Data,
}

impl TextureContent {
    /// The image's media type and its file, halved until it fits.
    pub fn encode(self, image: &RgbImage) -> io::Result<(&'static str, Vec<u8>)> {
        let smaller = self.fitting(image);
        let image = smaller.as_ref().unwrap_or(image);
        let mut bytes = Vec::new();
        match self {
            TextureContent::Colour => {
                let mut encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
                encoder.encode_image(image).map_err(io::Error::other)?;
                Ok(("image/jpeg", bytes))
            }
            TextureContent::Data => {
                image.write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png).map_err(io::Error::other)?;
                Ok(("image/png", bytes))
            }
        }
    }

    /// A smaller image if this one is too large.
    fn fitting(self, image: &RgbImage) -> Option<RgbImage> {
        let (width, height) = image.dimensions();
        if width.max(height) <= MOST_EMBEDDED_PX {
            return None;
        }
        let half = self.halved(image);
        self.fitting(&half).or(Some(half))
    }

    fn halved(self, image: &RgbImage) -> RgbImage {
        match self {
            TextureContent::Colour => halved_colours(image),
            TextureContent::Data => halved_numbers(image),
        }
    }
}

/// A relative path as a URI reference: everything but letters, digits and `-._~/` escaped (RFC 3986).
pub(super) fn uri(path: &str) -> String {
    let mut out = String::with_capacity(path.len());
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => out.push(char::from(byte)),
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_escaped() {
        assert_eq!(uri("floor/floor_basecolor.1001.png"), "floor/floor_basecolor.1001.png");
        assert_eq!(uri("a b/ä%.png"), "a%20b/%C3%A4%25.png");
    }

    #[test]
    fn a_large_image_is_halved_as_light() {
        let stripes = RgbImage::from_fn(4096, 3, |x, _| image::Rgb(if x % 2 == 0 { [0; 3] } else { [255; 3] }));
        let colour = TextureContent::Colour.fitting(&stripes).unwrap();
        assert_eq!(colour.dimensions(), (2048, 2));
        assert!(colour.pixels().all(|p| p.0 == [188; 3]), "{:?}", colour.get_pixel(0, 0));
        let data = TextureContent::Data.fitting(&stripes).unwrap();
        assert!(data.pixels().all(|p| p.0[0] == 127 || p.0[0] == 128));
        assert_eq!(TextureContent::Data.fitting(&RgbImage::new(2048, 2048)), None);
    }

    #[test]
    fn halving_keeps_an_even_colour() {
        for value in 0..=255 {
            let even = RgbImage::from_pixel(2, 2, image::Rgb([value; 3]));
            assert_eq!(TextureContent::Colour.halved(&even).get_pixel(0, 0).0, [value; 3]);
        }
    }
}
