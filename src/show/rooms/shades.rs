//! The light model's colours, factors and curves, each written once.
//!
//! The page's shader computes with the same constants ([`glsl`]) and repeats the functions of this file, and only those,
//! in `page/client/light.glsl`: a change here is a change there.

use super::panels::TILE_M;
use crate::math::srgb::luminance;
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
pub(crate) const CEILING_LIGHT: [f32; 2] = [0.31, 0.31];
/// Darkening of the joints between the ceiling's tiles.
pub(crate) const JOINT: f32 = 0.28;
/// Half the width of a joint, metres.
pub(crate) const JOINT_HALF_M: f32 = 0.005;
/// The block that rooms are cut into, as seen from above.
pub(crate) const TOP: LinearRgb = [0.20, 0.198, 0.195];
/// The table under the block, lit.
pub(crate) const TABLE: LinearRgb = [0.532, 0.527_25, 0.513];
/// Light on the underside of a lintel.
pub(crate) const SOFFIT: f32 = 0.42;
/// Light on furniture, by that over it: on its top, its sides, its underside.
pub(crate) const FITTING_LIGHT: [f32; 3] = [0.98, 0.80, 0.30];
/// How much of it depends on which way a side looks.
pub(crate) const FITTING_TURN: [f32; 2] = [0.10, 0.07];
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
/// Radiance of lamps as floors mirror them: film shows lamps darker than they are. And that of daylight, by its own.
pub(crate) const MIRRORED_LAMP: LinearRgb = [13.5, 13.2, 12.5];
pub(crate) const MIRRORED_DAY: f32 = 1.2;
/// Light on the mirrored ceiling.
pub(crate) const MIRRORED_CEILING_LIGHT: f32 = 0.42;
/// Distance up to which walls are searched for a reflection, metres.
pub(crate) const MIRROR_REACH_M: f32 = 90.0;
/// How far a lamp is blurred along the ray, at most, to either side on the ceiling: metres.
pub(crate) const LONGEST_STREAK_M: f32 = 5.0;
/// Factor on a floor's reflection by its roughness: where it is 1, least and greatest.
const GLOSS: [f32; 3] = [0.3, 0.5, 1.6];
/// Slope to either side within which a usual floor's reflection gathers half of its light.
pub(crate) const LOBE: f32 = 0.11;
/// Darkening of walls toward the floor and toward the ceiling: share, and the distance in which it fades, metres.
const FOOT: [f32; 2] = [0.34, 0.12];
const HEAD: [f32; 2] = [0.20, 0.30];
/// Sky at the horizon and overhead, where there is no ceiling.
const SKY: [LinearRgb; 2] = [[0.86, 0.97, 1.10], [0.17, 0.36, 0.78]];
/// Colour of light by its strength: dim and bright, under lamps and outdoors.
const TINT_INSIDE: [LinearRgb; 2] = [[0.975, 0.995, 1.03], [1.02, 1.0, 0.965]];
const TINT_OUTSIDE: [LinearRgb; 2] = [[0.84, 0.98, 1.20], [1.06, 1.0, 0.90]];
/// Share of the light on a wall at its foot, on one at the ceiling, and on the ceiling that the floor throws back in its colour.
const BOUNCED: [f32; 3] = [0.28, 0.12, 0.50];
/// Haze: way in which what lies beyond an opening fades to daylight, metres, in rooms and outdoors.
pub(crate) const HAZE_M: [f32; 2] = [3.0, 140.0];
/// How bright an irradiance of 1 is shown: in rooms, from above, outdoors.
pub(crate) const EXPOSURE_INSIDE: f32 = 0.88;
pub(crate) const EXPOSURE_ABOVE: f32 = 1.12;
pub(crate) const EXPOSURE_OUTSIDE: f32 = 0.94;
/// Contrast, as of film: light at the first number stays, all other light goes away from it by the second as a power.
const CONTRAST: [f32; 2] = [0.40, 1.25];
/// Up to here light is shown as it is; above, it comes ever closer to white.
const STRAIGHT: f32 = 0.50;

/// The constants as GLSL declarations.
pub(crate) fn glsl() -> String {
    let constants: [(&str, &[f32]); 39] = [
        ("LAMP", &LAMP),
        ("DAYLIGHT", &DAYLIGHT),
        ("CEILING", &CEILING),
        ("CEILING_LIGHT", &CEILING_LIGHT),
        ("JOINT", &[JOINT]),
        ("JOINT_HALF_M", &[JOINT_HALF_M]),
        ("TILE_M", &[TILE_M as f32]),
        ("TOP", &TOP),
        ("SOFFIT", &[SOFFIT]),
        ("FITTING_LIGHT", &FITTING_LIGHT),
        ("FITTING_TURN", &FITTING_TURN),
        ("F0", &[F0]),
        ("FLOOR_SHINE", &FLOOR_SHINE),
        ("WALL_SHINE", &[WALL_SHINE]),
        ("SKY_SHINE", &[SKY_SHINE]),
        ("MIRRORED_WALL", &MIRRORED_WALL),
        ("MIRRORED_WALL_LIGHT", &MIRRORED_WALL_LIGHT),
        ("MIRRORED_LAMP", &MIRRORED_LAMP),
        ("MIRRORED_DAY", &[MIRRORED_DAY]),
        ("MIRRORED_CEILING_LIGHT", &[MIRRORED_CEILING_LIGHT]),
        ("MIRROR_REACH_M", &[MIRROR_REACH_M]),
        ("LONGEST_STREAK_M", &[LONGEST_STREAK_M]),
        ("GLOSS", &GLOSS),
        ("LOBE", &[LOBE]),
        ("LOBE_WIDTH", &[LOBE_WIDTH]),
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
        ("BOUNCED", &BOUNCED),
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

/// Width of a floor's lobe by its roughness squared: coats of wax and lacquer are smoother than what lies under them.
const LOBE_WIDTH: f32 = 0.75;

/// Share of light that is thrown back (Schlick 1994, Computer Graphics Forum 13(3); rough surfaces as Lagarde 2011).
pub(crate) fn fresnel(cosine: f32, roughness: f32) -> f32 {
    let c = 1.0 - cosine.clamp(0.0, 1.0);
    let c2 = c * c;
    F0 + ((1.0 - roughness).max(F0) - F0) * c2 * c2 * c
}

/// Slopes, to either side and upward, within which half of the light lies that a rough floor mirrors along a ray of this
/// slope. Half of the facets lean by less than the roughness squared (GGX: Walter et al. 2007, Microfacet models for
/// refraction). One that leans to a side turns a flat ray less than one that leans along it: lamps are mirrored as streaks.
pub(crate) fn lobe(roughness: f32, slope: f64) -> [f64; 2] {
    let upward = f64::from(2.0 * LOBE_WIDTH * roughness * roughness).max(0.002);
    [upward * slope / (1.0 + slope * slope).sqrt(), upward]
}

/// Factor on a floor's reflection: smooth places show lamps brighter than dull ones, so that lanes, film and swirls of the
/// mop are seen in the gloss.
pub(crate) fn gloss(roughness: f32) -> f32 {
    let [usual, least, most] = GLOSS;
    (usual / roughness.max(1e-3)).clamp(least, most)
}

/// Light left on a wall near the floor and near the ceiling, 0 to 1.
pub(crate) fn wall_edges(z: f32, height_m: f32) -> f32 {
    let dark = |way: f32, [share, reach]: [f32; 2]| 1.0 - share * exp_f32(-way / reach);
    dark(z, FOOT) * dark(height_m - z, HEAD)
}

/// Share of the light over a fitting that a face of it gets, by its normal, at a height.
pub(crate) fn fitting_light([x, y, z]: [f32; 3], height_m: f32) -> f32 {
    let [top, side, under] = FITTING_LIGHT;
    if z > 0.5 {
        return top;
    }
    let foot = 1.0 - FOOT[0] * exp_f32(-height_m / FOOT[1]);
    if z < -0.5 { under } else { (side + FITTING_TURN[0] * x + FITTING_TURN[1] * y) * foot }
}

/// What a window shows in a direction: ground, trees far away, sky; brighter than the room.
pub(crate) fn day_behind([x, y, z]: [f32; 3]) -> LinearRgb {
    let across = (x * x + y * y).sqrt().max(1e-4);
    let up = z / across;
    let turn = f64::from(y / (x.abs() + y.abs()).max(1e-4)) * if x < 0.0 { -1.0 } else { 1.0 };
    let wave = |times: f64, from: f64| crate::math::sin_cos(turn * times + from).0 as f32;
    let trees = 0.07 + 0.03 * wave(7.0, 0.4) + 0.02 * wave(17.0, 1.3) + 0.012 * wave(41.0, 2.0);
    let soft = |edge: f32, width: f32| smoothstep(f64::from((up - edge) / width + 0.5)) as f32;
    // Film that is exposed for the room shows little of it.
    let ground = mix([1.30, 1.32, 1.24], [1.55, 1.58, 1.52], soft(-0.35, 0.6));
    let behind = mix(ground, [1.02, 1.12, 1.04], soft(-0.01, 0.05));
    mix(behind, mix([2.2, 2.25, 2.3], [1.7, 1.9, 2.3], up.clamp(0.0, 1.0)), soft(trees, 0.09))
}

/// Colour of an irradiance: lamps are warmer than what walls throw back, the sun is warmer than the sky.
pub(crate) fn tinted(full: f32, outside: bool) -> LinearRgb {
    let [dim, bright] = if outside { TINT_OUTSIDE } else { TINT_INSIDE };
    scaled(mix(dim, bright, smoothstep(f64::from(full)) as f32), full)
}

/// What a floor of a mean colour makes of white light, at the same luminance.
pub(crate) fn floor_tint(mean: LinearRgb) -> LinearRgb {
    scaled(mean, 1.0 / luminance(mean.map(f64::from)).max(0.01) as f32)
}

/// Tint of the light on a wall at a height, as a share of the ceiling's.
pub(crate) fn wall_tint(floor: LinearRgb, height: f32) -> LinearRgb {
    mix([1.0; 3], floor, BOUNCED[0] + (BOUNCED[1] - BOUNCED[0]) * height.clamp(0.0, 1.0))
}

/// Tint of the light on the ceiling.
pub(crate) fn ceiling_tint(floor: LinearRgb) -> LinearRgb {
    mix([1.0; 3], floor, BOUNCED[2])
}

/// The sky in a direction, by the sine of its height.
pub(crate) fn sky(up: f32) -> LinearRgb {
    mix(SKY[0], SKY[1], up.clamp(0.0, 1.0).sqrt())
}

/// The sky with thin clouds, in a direction.
pub(crate) fn clouded(toward: [f32; 3]) -> LinearRgb {
    let [x, y, z] = toward;
    let over = z.max(0.03) + 0.06;
    let (u, v) = (x / over, y / over);
    // Drawn out by the wind, and torn.
    let torn = 0.6 * noise(1.7 * u + 9.0, 1.7 * v);
    let octave = |times: f32, from: f32| {
        noise(times * (0.55 * u + 0.3 * v) + torn + from, times * (v - 0.35 * u) + from) / times.sqrt()
    };
    let thick = octave(0.8, 3.0) + octave(1.9, 7.0) + octave(4.1, 1.0) + octave(8.7, 5.0);
    let share = 0.62 * smoothstep(f64::from(0.8 * thick + 0.35)) as f32 * smoothstep(f64::from(z / 0.16)) as f32;
    mix(sky(z), [1.12, 1.12, 1.11], share)
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

/// Smooth noise of a plane, -1 to 1, one to a unit.
pub(crate) fn noise(u: f32, v: f32) -> f32 {
    let (i, j) = (u.floor(), v.floor());
    let (s, t) = (u - i, v - j);
    let at = |di: i32, dj: i32| unevenness(i as i32 + di, j as i32 + dj);
    let (s, t) = (s * s * (3.0 - 2.0 * s), t * t * (3.0 - 2.0 * t));
    let row = |dj: i32| at(0, dj) + (at(1, dj) - at(0, dj)) * s;
    row(0) + (row(1) - row(0)) * t
}

/// A number from -1 to 1 for a pair of numbers.
pub(crate) fn unevenness(i: i32, j: i32) -> f32 {
    let word = (i as u32).wrapping_mul(0x9e37_79b1) ^ (j as u32).wrapping_mul(0x85eb_ca77);
    let word = (word ^ word >> 15).wrapping_mul(0x2c1b_3c6d);
    let word = (word ^ word >> 12).wrapping_mul(0x297a_2d39);
    ((word ^ word >> 15) >> 8) as f32 / 8_388_608.0 - 1.0
}

pub(crate) fn scaled(colour: LinearRgb, by: f32) -> LinearRgb {
    colour.map(|c| c * by)
}

pub(crate) fn mix(a: LinearRgb, b: LinearRgb, share: f32) -> LinearRgb {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share)
}
