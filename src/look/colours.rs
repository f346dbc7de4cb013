//! Colours of dirt, sRGB.

use crate::math::ln;
use crate::math::srgb::Srgb8;

/// Dry street soil, walked to a film.
pub const SOIL_DRY: Srgb8 = [100, 89, 70];
/// Soil from wet shoes, and dirt that a mop pushes against the skirting.
pub const SOIL_WET: Srgb8 = [80, 69, 52];
/// Black rubber of heels.
pub const RUBBER: Srgb8 = [38, 39, 43];
/// What wheels leave: dust with the rubber of their treads.
pub const WHEELS: Srgb8 = [106, 99, 88];
/// Skin grease with dirt, yellow-grey, from hands.
pub const SKIN: Srgb8 = [121, 103, 74];
/// Dirt from sleeves and shoulders.
pub const CLOTH: Srgb8 = [112, 106, 99];
/// Dirt from bags and cases.
pub const BAG: Srgb8 = [92, 91, 90];
/// Light dust.
pub const DUST: Srgb8 = [150, 142, 128];

/// Optical density of red, green and blue of dirt of a colour, linear, per density: 1 in the mean that eyes see.
pub(crate) fn absorption(colour: [f32; 3]) -> [f32; 3] {
    let depths = colour.map(|light| -ln(f64::from(light.clamp(0.004, 0.98))));
    let seen = 0.2126 * depths[0] + 0.7152 * depths[1] + 0.0722 * depths[2];
    depths.map(|depth| (depth / seen) as f32)
}
