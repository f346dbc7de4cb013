//! Colours of dirt, sRGB.

use crate::math::srgb::Srgb8;

/// Dry street soil, walked out to a film.
pub const SOIL_DRY: Srgb8 = [116, 107, 94];
/// Soil brought in on wet shoes, and what a mop pushes against the skirting.
pub const SOIL_WET: Srgb8 = [88, 78, 66];
/// Black rubber, worn off heels.
pub const RUBBER: Srgb8 = [42, 41, 40];
/// Skin grease with the dirt that it holds, yellow-grey: left by hands.
pub const SKIN: Srgb8 = [118, 104, 84];
/// Dirt rubbed off sleeves and shoulders.
pub const CLOTH: Srgb8 = [112, 106, 99];
/// Dirt rubbed off bags and cases.
pub const BAG: Srgb8 = [92, 91, 90];
