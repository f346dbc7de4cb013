//! Colours of dirt, sRGB.

use crate::math::srgb::Srgb8;

/// Dry street soil, walked to a film.
pub const SOIL_DRY: Srgb8 = [116, 107, 94];
/// Soil from wet shoes, and dirt that a mop pushes against the skirting.
pub const SOIL_WET: Srgb8 = [88, 78, 66];
/// Black rubber of heels.
pub const RUBBER: Srgb8 = [42, 41, 40];
/// Skin grease with dirt, yellow-grey, from hands.
pub const SKIN: Srgb8 = [118, 104, 84];
/// Dirt from sleeves and shoulders.
pub const CLOTH: Srgb8 = [112, 106, 99];
/// Dirt from bags and cases.
pub const BAG: Srgb8 = [92, 91, 90];
