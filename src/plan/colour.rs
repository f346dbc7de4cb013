use serde::{Deserialize, Serialize};

/// An sRGB colour, written `"#c03030"` or `"#c33"` in a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Colour(pub [u8; 3]);

/// A text that is not a colour.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is no colour; write it as \"#rrggbb\", such as \"#c03030\"")]
pub struct ColourError {
    /// The text.
    pub text: String,
}

/// Least chroma of a coloured pixel, of 255.
const LEAST_CHROMA: u8 = 48;
/// Least chroma of a coloured pixel, as a share of its lightest channel.
const LEAST_SATURATION: f32 = 0.35;
/// Largest distance of a pixel from the line between white and a wall colour, of 255.
const WALL_COLOUR_REACH: f32 = 40.0;

impl TryFrom<String> for Colour {
    type Error = ColourError;

    fn try_from(text: String) -> Result<Colour, ColourError> {
        let digits: Option<Vec<u8>> =
            text.strip_prefix('#').and_then(|hex| hex.chars().map(|c| c.to_digit(16).map(|d| d as u8)).collect());
        match digits.as_deref() {
            Some(&[r, g, b]) => Ok(Colour([r * 17, g * 17, b * 17])),
            Some(&[r1, r0, g1, g0, b1, b0]) => Ok(Colour([r1 * 16 + r0, g1 * 16 + g0, b1 * 16 + b0])),
            _ => Err(ColourError { text }),
        }
    }
}

impl From<Colour> for String {
    fn from(Colour([r, g, b]): Colour) -> String {
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Chroma of a colour: the largest minus the smallest channel.
pub(super) fn chroma([r, g, b]: [u8; 3]) -> u8 {
    r.max(g).max(b) - r.min(g).min(b)
}

/// Whether a colour is saturated enough for annotation: lanes, dots, highlights.
///
/// Chroma is at least 48 of 255, and at least 35 % of the largest channel.
pub(super) fn is_saturated(colour: [u8; 3]) -> bool {
    let [r, g, b] = colour;
    let (most, chroma) = (r.max(g).max(b), chroma(colour));
    chroma >= LEAST_CHROMA && f32::from(chroma) >= LEAST_SATURATION * f32::from(most)
}

/// Whether a pixel has the pale blue in which panes are filled.
pub(super) fn is_pane([r, g, b]: [u8; 3]) -> bool {
    b >= 190 && g >= r && b >= g && b - r >= 25
}

/// Computes luma (ITU-R BT.601), 0 to 255.
pub(super) fn luma([r, g, b]: [u8; 3]) -> u8 {
    ((299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b) + 500) / 1000) as u8
}

/// Returns the lightness of a pixel against a wall colour: 0 for that colour, 255 for white.
///
/// Anti-aliased edges lie in between. `None` for a pixel of another hue.
pub(super) fn lightness_against(wall: Colour, pixel: [u8; 3]) -> Option<u8> {
    let from_white = |c: [u8; 3]| c.map(|v| 255.0 - f32::from(v));
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (wall, pixel) = (from_white(wall.0), from_white(pixel));
    let squared = dot(wall, wall);
    if squared < 1.0 {
        return None;
    }
    let share = (dot(wall, pixel) / squared).clamp(0.0, 1.0);
    let apart = [0, 1, 2].map(|k| pixel[k] - share * wall[k]);
    (dot(apart, apart) <= WALL_COLOUR_REACH * WALL_COLOUR_REACH).then(|| (255.0 * (1.0 - share)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn colour(text: &str) -> Result<Colour, ColourError> {
        Colour::try_from(text.to_owned())
    }

    #[test]
    fn colours_are_read_and_written() {
        assert_eq!(colour("#C03030"), Ok(Colour([0xc0, 0x30, 0x30])));
        assert_eq!(colour("#c3f"), Ok(Colour([0xcc, 0x33, 0xff])));
        assert_eq!(String::from(Colour([1, 2, 255])), "#0102ff");
        for wrong in ["red", "#12", "#12345g", "", "#é12345"] {
            assert!(colour(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn greys_and_tinted_greys_are_not_saturated() {
        for grey in [[0, 0, 0], [255; 3], [128; 3], [109, 108, 95], [87, 88, 79], [20, 0, 0], [244, 238, 252]] {
            assert!(!is_saturated(grey), "{grey:?}");
        }
        for coloured in [[255, 0, 0], [0, 0, 128], [255, 80, 255], [120, 40, 40], [0, 90, 0]] {
            assert!(is_saturated(coloured), "{coloured:?}");
        }
    }

    #[test]
    fn a_wall_colour_is_dark_and_its_anti_aliased_edge_half_way() {
        let red = Colour([192, 48, 48]);
        assert_eq!(lightness_against(red, [192, 48, 48]), Some(0));
        assert_eq!(lightness_against(red, [255, 255, 255]), Some(255));
        assert!((120..136).contains(&lightness_against(red, [224, 152, 152]).unwrap()));
        assert_eq!(lightness_against(red, [48, 48, 192]), None);
    }
}
