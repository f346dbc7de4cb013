//! Cameras and lamps as glTF has them.

use serde_json::{Value, json};

use crate::export::Camera;
use crate::math::{atan2, sin_cos};
use crate::show::scene::file::SceneLamp;

/// The extension that has lamps.
pub(super) const LIGHTS: &str = "KHR_lights_punctual";
/// Luminance of an office's lamp, candela per square metre.
const LUMINANCE: f64 = 2000.0;
/// Angles from straight down at which a lamp's light begins to fade and ends: together about that of a matt panel.
const CONE_RAD: [f64; 2] = [0.3, 1.45];
/// How far its light is worth following, metres.
const RANGE_M: f64 = 12.0;
/// Nearest place that a camera shows, metres.
const NEAR_M: f64 = 0.05;

/// A camera for pictures of a size in pixels.
pub(super) fn camera(camera: &Camera, [width, height]: [u32; 2]) -> Value {
    let aspect = f64::from(width) / f64::from(height);
    let (sine, cosine) = sin_cos(camera.fov_deg.to_radians() * 0.5);
    let perspective = json!({ "aspectRatio": aspect, "yfov": 2.0 * atan2(sine, cosine * aspect), "znear": NEAR_M });
    json!({ "type": "perspective", "perspective": perspective })
}

/// A light that all lamps of an area share.
pub(super) fn light(lamp: &SceneLamp) -> Value {
    let [inner, outer] = CONE_RAD;
    json!({
        "type": "spot",
        "name": "lamp",
        "intensity": LUMINANCE * lamp.area_m2,
        "range": RANGE_M,
        "spot": { "innerConeAngle": inner, "outerConeAngle": outer },
    })
}

/// A node at a place that looks in a direction: heading in the plan and pitch, degrees.
pub(super) fn node(name: &str, place_m: [f64; 3], [heading_deg, pitch_deg]: [f64; 2]) -> Value {
    let [x, y, height] = place_m;
    // Without a turn, it looks north.
    let (sin_h, cos_h) = sin_cos((heading_deg - 90.0).to_radians() * 0.5);
    let (sin_p, cos_p) = sin_cos(pitch_deg.to_radians() * 0.5);
    let rotation = [cos_h * sin_p, sin_h * cos_p, -sin_h * sin_p, cos_h * cos_p];
    json!({ "name": name, "translation": [x, height, -y], "rotation": rotation })
}
