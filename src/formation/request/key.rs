use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Assign;
use crate::math::Vec2;
use crate::options::{names, options};

options! {
    /// A key formation: `[[formation.key]]`.
    pub struct KeyRequest {
        /// When people stand so.
        time_s: f64 = 0.0, in 0.0..=36000.0, unit "s", eg "20.0", required true;
        /// How long they stay in it.
        hold_s: f64 = 0.0, in 0.0..=36000.0, unit "s";
        /// "example" (as there), "grid", "line", "ring", "disc", "triangle", "polygon", "star" or "wedge"; up is
        /// forward.
        shape: Option<FormationShape> = None, eg "\"star\"";
        /// Or letters that people stand along.
        text: Option<String> = None, eg "\"HELLO\"";
        /// Or a place for each.
        points: Option<Vec<Vec2>> = None, unit "m", eg "[[0.0, 0.0], [1.0, 0.0], [0.5, 0.9]]";
        /// Or a picture of dots, or a text of points; relative to this file.
        file: Option<PathBuf> = None, eg "\"dots.png\"";
        /// Of the picture; left out: 0.1.
        metres_per_pixel: Option<f64> = None, in 0.0005..=10.0, unit "m", eg "0.1";
        /// Whether people fill what is drawn, a polygon or a star evenly.
        filled: Option<bool> = None, eg "true";
        /// People side by side in a grid.
        columns: Option<u32> = None, in 1.0..=2000.0, eg "6";
        /// Rings one in the other.
        rings: Option<u32> = None, in 1.0..=100.0, eg "2";
        /// Of a polygon; points of a star.
        corners: Option<u32> = None, in 3.0..=100.0, eg "5";
        /// Inner radius of a star over its outer.
        inner: Option<f64> = None, in 0.05..=1.0, eg "0.45";
        /// Between the two lines of a wedge.
        angle_deg: Option<f64> = None, in 0.0..=360.0, unit "degrees", eg "80.0";
        /// From one to the next.
        spacing_m: Option<f64> = None, in 0.05..=1e3, unit "m", eg "1.0";
        /// Of rings, discs, polygons, stars; left out: by the spacing.
        radius_m: Option<f64> = None, in 0.01..=1e4, unit "m", eg "4.0";
        /// Of letters; left out: by the spacing.
        height_m: Option<f64> = None, in 0.1..=1e4, unit "m", eg "5.0";
        /// Where its middle is.
        at: Option<Vec2> = None, unit "m", eg "[10.0, 0.0]";
        /// How far it is turned, counter-clockwise.
        turn_deg: f64 = 0.0, in -3600.0..=3600.0, unit "degrees";
        /// How far all wheel as one body on the way to it.
        wheel_deg: f64 = 0.0, in -3600.0..=3600.0, unit "degrees";
        /// How many times as large.
        scale: Option<f64> = None, in 1e-3..=1e3, eg "1.5";
        /// Who goes where in this one, as above.
        assign: Option<Assign> = None, eg "\"order\"";
    }
}

names!(FormationShape);

/// A named formation. Up is forward.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FormationShape {
    /// The example's own positions at that time.
    Example,
    /// Rows one behind the other.
    Grid,
    /// A line, side by side.
    Line,
    /// A ring, or concentric rings.
    Ring,
    /// Evenly in a disc.
    Disc,
    /// Rows of one, two, three and so on, the tip in front; or, with `filled = false`, its sides.
    Triangle,
    /// Along the sides of a polygon, or in it.
    Polygon,
    /// Along the outline of a star, or in it.
    Star,
    /// A wedge: one person in front, the others behind to the left and the right.
    Wedge,
}
