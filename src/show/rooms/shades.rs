//! The light model's colours, factors and curves, each written once.
//!
//! The page's shader computes with the same constants ([`glsl`]) and repeats the functions of this file, and only those,
//! in `page/client/light.glsl`: a change here is a change there.

use super::panels::TILE_M;
use crate::math::{exp, exp_f32, pow, smoothstep};

/// Linear light, red, green, blue.
pub(crate) type LinearRgb = [f32; 3];

/// Radiance of lamps.
pub(crate) const LAMP: LinearRgb = [3.4, 3.3, 3.05];
/// Daylight beyond openings.
pub(crate) const DAYLIGHT: LinearRgb = [1.75, 1.85, 2.0];
/// The ceiling's tiles.
pub(crate) const CEILING: LinearRgb = [0.74, 0.735, 0.72];
/// Light on the ceiling: `[0] * open + [1] * full` of the floor below.
pub(crate) const CEILING_LIGHT: [f32; 2] = [0.24, 0.25];
/// Darkening of the joints between the ceiling's tiles.
pub(crate) const JOINT: f32 = 0.28;
/// Half the width of a joint, metres.
pub(crate) const JOINT_HALF_M: f32 = 0.005;
/// The block that rooms are cut into, as seen from above.
pub(crate) const TOP: LinearRgb = [0.052, 0.052, 0.058];
/// The table under the block, lit.
pub(crate) const TABLE: LinearRgb = [0.532, 0.527_25, 0.513];
/// Light on the underside of a lintel.
pub(crate) const SOFFIT: f32 = 0.42;
/// Reflectance of smooth surfaces at a right angle (Fresnel).
const F0: f32 = 0.04;
/// Factor on a floor's reflection: `[0] + [1] * open`, less in corners.
pub(crate) const FLOOR_SHINE: [f32; 2] = [0.35, 0.65];
/// Radiance of a wall's surroundings as the wall reflects them, in the open.
pub(crate) const WALL_SHINE: f32 = 0.45;
/// Radiance of the sky as floors reflect it that are seen from above.
pub(crate) const SKY_SHINE: f32 = 0.75;
/// Colour of walls in the reflection of a floor.
pub(crate) const MIRRORED_WALL: LinearRgb = [0.66, 0.64, 0.60];
/// Light on mirrored walls: `[0] + [1] * height / ceiling`.
pub(crate) const MIRRORED_WALL_LIGHT: [f32; 2] = [0.62, 0.20];
/// Light on the mirrored ceiling.
pub(crate) const MIRRORED_CEILING_LIGHT: f32 = 0.42;
/// Distance up to which walls are searched for a reflection, metres.
pub(crate) const MIRROR_REACH_M: f32 = 90.0;
/// Slope to either side within which a usual floor's reflection gathers half of its light.
pub(crate) const LOBE: f32 = 0.11;
/// Darkening of walls toward the floor and toward the ceiling: share, and the distance in which it fades, metres.
const FOOT: [f32; 2] = [0.34, 0.12];
const HEAD: [f32; 2] = [0.20, 0.30];
/// Sky at the horizon and overhead, where there is no ceiling.
const SKY: [LinearRgb; 2] = [[0.93, 1.0, 1.08], [0.30, 0.47, 0.80]];
/// Colour of light by its strength: dim and bright, under lamps and outdoors.
const TINT_INSIDE: [LinearRgb; 2] = [[0.975, 0.995, 1.03], [1.02, 1.0, 0.965]];
const TINT_OUTSIDE: [LinearRgb; 2] = [[0.84, 0.98, 1.20], [1.06, 1.0, 0.90]];
/// Haze: way in which what lies beyond an opening fades to daylight, metres, in rooms and outdoors.
pub(crate) const HAZE_M: [f32; 2] = [3.0, 45.0];
/// How bright an irradiance of 1 is shown: in rooms, from above, outdoors.
pub(crate) const EXPOSURE_INSIDE: f32 = 1.0;
pub(crate) const EXPOSURE_ABOVE: f32 = 1.12;
pub(crate) const EXPOSURE_OUTSIDE: f32 = 0.86;
/// Contrast, as of film: light at the first number stays, all other light goes away from it by the second as a power.
const CONTRAST: [f32; 2] = [0.40, 1.20];
/// Up to here light is shown as it is; above, it comes ever closer to white.
const STRAIGHT: f32 = 0.50;

/// The constants as GLSL declarations.
pub(crate) fn glsl() -> String {
    let constants: [(&str, &[f32]); 31] = [
        ("LAMP", &LAMP),
        ("DAYLIGHT", &DAYLIGHT),
        ("CEILING", &CEILING),
        ("CEILING_LIGHT", &CEILING_LIGHT),
        ("JOINT", &[JOINT]),
        ("JOINT_HALF_M", &[JOINT_HALF_M]),
        ("TILE_M", &[TILE_M as f32]),
        ("TOP", &TOP),
        ("SOFFIT", &[SOFFIT]),
        ("F0", &[F0]),
        ("FLOOR_SHINE", &FLOOR_SHINE),
        ("WALL_SHINE", &[WALL_SHINE]),
        ("SKY_SHINE", &[SKY_SHINE]),
        ("MIRRORED_WALL", &MIRRORED_WALL),
        ("MIRRORED_WALL_LIGHT", &MIRRORED_WALL_LIGHT),
        ("MIRRORED_CEILING_LIGHT", &[MIRRORED_CEILING_LIGHT]),
        ("MIRROR_REACH_M", &[MIRROR_REACH_M]),
        ("LOBE", &[LOBE]),
        ("FOOT", &FOOT),
        ("HEAD", &HEAD),
        ("EXPOSURE_INSIDE", &[EXPOSURE_INSIDE]),
        ("EXPOSURE_ABOVE", &[EXPOSURE_ABOVE]),
        ("EXPOSURE_OUTSIDE", &[EXPOSURE_OUTSIDE]),
        ("SKY_LOW", &SKY[0]),
        ("SKY_HIGH", &SKY[1]),
        ("TINT_DIM", &TINT_INSIDE[0]),
        ("TINT_BRIGHT", &TINT_INSIDE[1]),
        ("TINT_SHADE", &TINT_OUTSIDE[0]),
        ("TINT_SUN", &TINT_OUTSIDE[1]),
        ("CONTRAST", &CONTRAST),
        ("STRAIGHT", &[STRAIGHT]),
    ];
    let declared = |(name, values): &(&str, &[f32])| {
        let kind = ["float", "vec2", "vec3"][values.len() - 1];
        let values: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
        format!("const {kind} {name} = {kind}({});\n", values.join(", "))
    };
    constants.iter().map(declared).collect()
}

/// Share of light that is thrown back (Schlick 1994, Computer Graphics Forum 13(3); rough surfaces as Lagarde 2011).
pub(crate) fn fresnel(cosine: f32, roughness: f32) -> f32 {
    let c = 1.0 - cosine.clamp(0.0, 1.0);
    let c2 = c * c;
    F0 + ((1.0 - roughness).max(F0) - F0) * c2 * c2 * c
}

/// Slope within which half of a rough surface's mirrored light lies (Walter et al. 2007, Microfacet models for refraction).
pub(crate) fn lobe_slope(roughness: f32) -> f64 {
    f64::from(roughness * roughness).max(0.002)
}

/// Light left on a wall near the floor and near the ceiling, 0 to 1.
pub(crate) fn wall_edges(z: f32, height_m: f32) -> f32 {
    let dark = |way: f32, [share, reach]: [f32; 2]| 1.0 - share * exp_f32(-way / reach);
    dark(z, FOOT) * dark(height_m - z, HEAD)
}

/// Colour of an irradiance: lamps are warmer than what walls throw back, the sun is warmer than the sky.
pub(crate) fn tinted(full: f32, outside: bool) -> LinearRgb {
    let [dim, bright] = if outside { TINT_OUTSIDE } else { TINT_INSIDE };
    scaled(mix(dim, bright, smoothstep(f64::from(full)) as f32), full)
}

/// The sky in a direction, by the sine of its height.
pub(crate) fn sky(up: f32) -> LinearRgb {
    mix(SKY[0], SKY[1], up.clamp(0.0, 1.0).sqrt())
}

/// From 0 to 1 between -1.5 and 1.5: close to the integral of a bell of width 0.6.
pub(crate) fn rise(t: f64) -> f64 {
    smoothstep(t / 3.0 + 0.5)
}

/// Share of a pixel of a `width` in metres that a joint between the ceiling's tiles takes.
pub(crate) fn joint(at: f32, width: f32) -> f32 {
    let tiles = at / TILE_M as f32;
    let away = (tiles - (tiles + 0.5).floor()).abs() * TILE_M as f32;
    let most = (2.0 * JOINT_HALF_M / width.max(1e-5)).min(1.0);
    ((JOINT_HALF_M + 0.5 * width - away) / width.max(1e-5)).clamp(0.0, most)
}

/// Exposed light as it is shown, 0 to 1.
pub(crate) fn toned(light: f64) -> f64 {
    let [pivot, power] = CONTRAST.map(f64::from);
    let light = pivot * pow((light / pivot).max(0.0), power);
    let straight = f64::from(STRAIGHT);
    let rest = 1.0 - straight;
    if light <= straight { light } else { straight + rest * (1.0 - exp(-(light - straight) / rest)) }
}

pub(crate) fn scaled(colour: LinearRgb, by: f32) -> LinearRgb {
    colour.map(|c| c * by)
}

pub(crate) fn mix(a: LinearRgb, b: LinearRgb, share: f32) -> LinearRgb {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share)
}
