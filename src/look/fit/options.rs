use std::path::Path;

use crate::look::error::LookError;
use crate::look::material::Material;
use crate::look::settings::Look;
use crate::math::vec2;

/// Longest and shortest side of the floor in a photograph, metres.
const SIDES_M: [f64; 2] = [0.3, 50.0];
/// Least area of the floor in a photograph, as a share of it.
const LEAST_SHARE: f64 = 0.005;

/// What a photograph of a floor shows, and what cannot be seen in it.
#[derive(Clone, Debug)]
pub struct FitOptions {
    /// Width and height of the rectangle of floor between the corners, metres.
    pub metres: [f64; 2],
    /// Its corners in the photograph, in pixels from the upper left: upper left, upper right, lower right, lower left.
    /// `None`: the photograph's own.
    pub corners: Option<[[f64; 2]; 4]>,
    /// Two opposite corners of a part without any dirt, in pixels of the photograph.
    pub clean: Option<[f64; 4]>,
    /// Which sides of the rectangle stand at a wall: upper, right, lower, left.
    pub walls: [bool; 4],
    /// What the floor is made of.
    pub material: Material,
    /// How many people have walked over the lane.
    pub passes: f64,
    /// What is not measured stays as it is here.
    pub start: Look,
}

impl FitOptions {
    /// A rectangle of floor of this size, as the whole photograph, 1000 people after the last deep clean.
    pub fn new(metres: [f64; 2]) -> FitOptions {
        FitOptions {
            metres,
            corners: None,
            clean: None,
            walls: [false; 4],
            material: Material::Vinyl,
            passes: 1000.0,
            start: Look::default(),
        }
    }

    /// Corners of the floor in a photograph of a size in pixels.
    pub(super) fn checked_corners(&self, path: &Path, size: [u32; 2]) -> Result<[[f64; 2]; 4], LookError> {
        let refused = |message: String, hint: &'static str| LookError::Fit { path: path.to_path_buf(), message, hint };
        let [least, most] = SIDES_M;
        if self.metres.iter().any(|side| !(least..=most).contains(side)) {
            let [w, h] = self.metres;
            let message = format!("the floor is {w} x {h} m, allowed are {least} to {most} m a side");
            return Err(refused(message, "give width and height of the rectangle between the four corners, in metres"));
        }
        if !(1.0..=1e9).contains(&self.passes) {
            let message = format!("{} people have walked over the lane, allowed are 1 to 1e9", self.passes);
            return Err(refused(message, "a guess is enough: it is the density after 1000 that the look holds"));
        }
        let [width, height] = size.map(f64::from);
        let corners = self.corners.unwrap_or([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]);
        let outside = |[x, y]: &[f64; 2]| !(0.0..=width).contains(x) || !(0.0..=height).contains(y);
        if let Some([x, y]) = corners.iter().find(|corner| outside(corner)) {
            let message = format!("the corner {x},{y} is outside the photograph of {width} x {height} px");
            return Err(refused(message, "corners are pixels from the photograph's upper left"));
        }
        let p = corners.map(|[x, y]| vec2(x, y));
        let turn = |k: usize| (p[(k + 1) % 4] - p[k]).cross(p[(k + 2) % 4] - p[(k + 1) % 4]);
        let area = 0.5 * ((p[1] - p[0]).cross(p[2] - p[0]) + (p[2] - p[0]).cross(p[3] - p[0]));
        let least_turn = 1e-3 * width * height * LEAST_SHARE;
        if area < LEAST_SHARE * width * height || (0..4).any(|k| turn(k) < least_turn) {
            let listed: Vec<String> = corners.iter().map(|[x, y]| format!("{x},{y}")).collect();
            let message = format!("the corners {} are not those of a rectangle of floor", listed.join(" "));
            return Err(refused(
                message,
                "give the floor's upper left, upper right, lower right and lower left corner, no three on one line",
            ));
        }
        Ok(corners)
    }
}
