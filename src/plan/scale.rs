//! The scale of a plan, where it comes from and how sure it is.

use serde::{Deserialize, Serialize};

use super::{LARGEST_M_PER_PX, LARGEST_SIDE_M, PlanError, PlanOptions, SMALLEST_M_PER_PX, TwoPoints};

/// Where a plan's scale comes from, and how sure it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanScale {
    /// Where it comes from.
    pub source: ScaleSource,
    /// Share of how sure it is: 1 for a given scale, 0 for one that nothing in the plan supports.
    pub sureness: f64,
    /// Least and greatest metres per pixel that the plan allows.
    pub range: [f64; 2],
    /// What a guess rests on, such as "14 doors, 0.91 m wide"; empty for a given scale.
    pub evidence: String,
}

/// Where the scale of a plan comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ScaleSource {
    /// A scenario or the caller gave it.
    #[default]
    Given,
    /// The YAML of a ROS map names it.
    Map,
    /// Two points whose distance is known.
    Points,
    /// The width of the building.
    Width,
    /// The unit of a vector drawing.
    Drawing,
    /// Numbers on the plan: areas and sizes of rooms, dimensions, scale bars.
    Printed,
    /// Doors, walls or the sheet say it.
    Guessed,
    /// Nothing says it: the usual scale of indoor maps.
    Assumed,
}

impl ScaleSource {
    /// What it is called in a sentence.
    pub fn name(self) -> &'static str {
        match self {
            ScaleSource::Given => "given",
            ScaleSource::Map => "from the map",
            ScaleSource::Points => "from two points",
            ScaleSource::Drawing => "from the drawing's unit",
            ScaleSource::Width => "from the building's width",
            ScaleSource::Printed => "read from the plan",
            ScaleSource::Guessed => "guessed",
            ScaleSource::Assumed => "assumed",
        }
    }
}

impl PlanScale {
    /// A scale that somebody knows.
    pub(super) fn known(source: ScaleSource, metres_per_pixel: f64) -> PlanScale {
        PlanScale { source, sureness: 1.0, range: [metres_per_pixel; 2], evidence: String::new() }
    }

    /// The same of pixels that are larger by a factor.
    pub(super) fn scaled(self, factor: f64) -> PlanScale {
        PlanScale { range: self.range.map(|metres| metres * factor), ..self }
    }
}

/// A scale that was found, metres per pixel, and how.
pub(super) fn found(
    value: f64,
    source: ScaleSource,
    sureness: f64,
    range: [f64; 2],
    evidence: String,
) -> (f64, PlanScale) {
    (value, PlanScale { source, sureness, range, evidence })
}

/// Three significant digits: a guess knows no more.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// The scale of a game's map that has a pixel a cell: a small picture of two tones.
pub(super) fn of_cells(width: usize, lightness: &[u8]) -> Option<(f64, PlanScale)> {
    const MOST_CELLS: usize = 160;
    const CELL_M: f64 = 1.0;
    let is_small = width.max(lightness.len() / width.max(1)) <= MOST_CELLS;
    if !is_small || lightness.iter().any(|&l| l != 0 && l != 255) {
        return None;
    }
    let evidence = "so small a picture of two tones, in which a pixel is a cell of a game's map".to_owned();
    Some(found(CELL_M, ScaleSource::Assumed, 0.2, [0.5 * CELL_M, 2.0 * CELL_M], evidence))
}

/// The scale of a map for games at the table, whose floor is of squares of five feet.
pub(super) fn of_squares(square_px: Option<f64>) -> Option<(f64, PlanScale)> {
    const SQUARE_M: f64 = 1.524;
    let px = square_px?;
    let value = rounded(SQUARE_M / px);
    let evidence = format!("squares of {px:.0} pixels on the floor, taken for 5 feet as on maps of games");
    Some(found(value, ScaleSource::Guessed, 0.6, [0.6 * value, 1.05 * value], evidence))
}

/// Returns the metres per pixel that options or the map give. Options override the map.
pub(super) fn given(options: &PlanOptions, from_map: Option<f64>) -> Result<Option<(f64, PlanScale)>, PlanError> {
    let asked = [options.metres_per_pixel.is_some(), options.scale.is_some(), options.width_m.is_some()];
    if asked.into_iter().filter(|&asked| asked).count() > 1 {
        return Err(PlanError::ScaleTwice);
    }
    let (source, value) = match (options.metres_per_pixel, &options.scale, from_map) {
        _ if options.width_m.is_some() => return Ok(None),
        (Some(value), ..) => (ScaleSource::Given, value),
        (None, Some(points), _) => (ScaleSource::Points, of_two_points(points)?),
        (None, None, Some(value)) => (ScaleSource::Map, value),
        (None, None, None) => return Ok(None),
    };
    check(source, value)?;
    Ok(Some((value, PlanScale::known(source, value))))
}

/// Refuses a scale that is out of range.
pub(super) fn check(source: ScaleSource, value: f64) -> Result<(), PlanError> {
    // This form also refuses NaN.
    if (SMALLEST_M_PER_PX..=LARGEST_M_PER_PX).contains(&value) {
        return Ok(());
    }
    let what = match source {
        ScaleSource::Map => "the map's resolution",
        ScaleSource::Drawing => "the drawing's unit",
        ScaleSource::Points => "the scale that follows from two points",
        ScaleSource::Width => "the scale that follows from the building's width",
        ScaleSource::Given | ScaleSource::Printed | ScaleSource::Guessed | ScaleSource::Assumed => "the scale",
    };
    Err(PlanError::Scale { what: what.to_owned(), value })
}

fn of_two_points(points: &TwoPoints) -> Result<f64, PlanError> {
    let ([x0, y0], [x1, y1]) = (points.from.px, points.to.px);
    let refuse = |reason: String| Err(PlanError::TwoPoints { reason });
    if ![x0, y0, x1, y1].iter().all(|v| v.is_finite()) {
        return refuse("a coordinate is not a number".into());
    }
    if !(points.metres.is_finite() && points.metres > 0.0) {
        return refuse(format!("their distance is {} m", points.metres));
    }
    let pixels = ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)).sqrt();
    if pixels < 1.0 {
        return refuse(format!("they lie {pixels} pixels apart"));
    }
    Ok(points.metres / pixels)
}

/// Refuses a plan larger than [`LARGEST_SIDE_M`] on a side.
pub(super) fn check_size(width_px: u32, height_px: u32, metres_per_pixel: f64) -> Result<(), PlanError> {
    let [width_m, height_m] = [width_px, height_px].map(|px| f64::from(px) * metres_per_pixel);
    if width_m.max(height_m) > LARGEST_SIDE_M {
        return Err(PlanError::TooLarge { metres_per_pixel, width_m, height_m });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PixelPoint;

    fn with(metres_per_pixel: f64) -> PlanOptions {
        PlanOptions { metres_per_pixel: Some(metres_per_pixel), ..PlanOptions::default() }
    }

    fn two_points(from: [f64; 2], to: [f64; 2], metres: f64) -> PlanOptions {
        let [from, to] = [from, to].map(|px| PixelPoint { px });
        PlanOptions { scale: Some(TwoPoints { from, to, metres }), ..PlanOptions::default() }
    }

    #[test]
    fn a_setting_goes_before_the_map() {
        let chosen =
            |options: &PlanOptions, map| given(options, map).unwrap().map(|(value, scale)| (value, scale.source));
        let default = PlanOptions::default();
        assert_eq!(chosen(&with(0.1), Some(0.2)), Some((0.1, ScaleSource::Given)));
        assert_eq!(chosen(&default, Some(0.2)), Some((0.2, ScaleSource::Map)));
        assert_eq!(chosen(&default, None), None);
        let points = two_points([120.0, 40.0], [480.0, 40.0], 36.0);
        assert_eq!(chosen(&points, Some(0.2)), Some((0.1, ScaleSource::Points)));
        let width = PlanOptions { width_m: Some(30.0), ..default };
        assert_eq!(chosen(&width, Some(0.2)), None);
    }

    #[test]
    fn scales_that_are_none_are_refused() {
        for value in [f64::NAN, 0.0, -0.1, f64::INFINITY, 1e9, 1e-9] {
            assert!(matches!(given(&with(value), None), Err(PlanError::Scale { .. })), "{value}");
            assert!(matches!(given(&PlanOptions::default(), Some(value)), Err(PlanError::Scale { .. })), "{value}");
            let points = two_points([0.0, 0.0], [100.0, 0.0], value);
            assert!(given(&points, None).is_err(), "{value}");
        }
        let same = two_points([5.0, 5.0], [5.0, 5.0], 1.0);
        assert!(matches!(given(&same, None), Err(PlanError::TwoPoints { .. })));
        let points = two_points([0.0, 0.0], [9.0, 0.0], 1.0);
        for twice in [
            PlanOptions { metres_per_pixel: Some(0.1), ..points.clone() },
            PlanOptions { width_m: Some(30.0), ..points },
            PlanOptions { width_m: Some(30.0), ..with(0.1) },
        ] {
            assert!(matches!(given(&twice, None), Err(PlanError::ScaleTwice)));
        }
    }
}
