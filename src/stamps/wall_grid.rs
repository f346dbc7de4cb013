//! Texel grid of all walls.

use super::StampsError;
use crate::walls::{Face, Walls};

/// Texel grid of all walls: each face unrolled into a strip.
///
/// Texel (i, j) of a face covers `[i, i+1)/t` metres of its arc length and `[j, j+1)/t` metres of height above the
/// floor; j grows upward.
#[derive(Clone, Debug, PartialEq)]
pub struct WallGrid {
    /// Texel density t, texels per metre, 1 to 1000.
    pub texels_per_metre: f64,
    /// Wall height, metres, above 0 to 100.
    pub height_m: f64,
    /// Number of rows: the height, rounded up to whole texels.
    pub height: u32,
    /// Strips of the faces, in the order of [`Walls::faces`].
    pub faces: Vec<FaceSpan>,
}

/// Extent of a face's strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceSpan {
    /// Number of columns: the length, rounded up to whole texels. The last may be covered in part.
    pub width: u32,
    /// Length of the face, metres.
    pub length_m: f64,
    /// Whether the face is closed: its end joins its start.
    pub closed: bool,
}

/// Largest number of columns of a face: 1000 km at 1000 texels per metre. A maze may be one face.
const MOST_COLUMNS: u32 = 1 << 30;

/// Largest wall height, metres.
const HIGHEST_M: f64 = 100.0;

impl WallGrid {
    /// Creates the grid of all wall faces of a plan; `height_m` is the wall height in metres.
    ///
    /// # Errors
    /// The texel density is outside 1 to 1000 texels per metre; the height is out of range; a face has more than
    /// 2^30 texels.
    pub fn covering(walls: &Walls, height_m: f64, texels_per_metre: f64) -> Result<WallGrid, StampsError> {
        if !(1.0..=1000.0).contains(&texels_per_metre) {
            return Err(StampsError::WallTexelDensity { texels_per_metre });
        }
        if !(height_m > 0.0 && height_m <= HIGHEST_M) {
            return Err(StampsError::WallHeight { height_m, most: HIGHEST_M });
        }
        // Rounding errors must not add a texel.
        let texels = |metres: f64| (metres * texels_per_metre - 1e-6).ceil().max(1.0);
        let span = |face: &Face| {
            let length_m = face.length_m();
            let width = texels(length_m);
            let fits = width <= f64::from(MOST_COLUMNS);
            fits.then_some(FaceSpan { width: width as u32, length_m, closed: face.closed })
                .ok_or(StampsError::FaceTooLong { length_m, texels_per_metre, most: MOST_COLUMNS })
        };
        let faces = walls.faces.iter().map(span).collect::<Result<_, _>>()?;
        Ok(WallGrid { texels_per_metre, height_m, height: texels(height_m) as u32, faces })
    }

    /// Side of a texel, metres.
    pub fn texel_m(&self) -> f64 {
        1.0 / self.texels_per_metre
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::stamps::fixtures::room;

    #[test]
    fn faces_are_rounded_up_to_whole_texels() {
        let walls = room(3.0, 2.0);
        let grid = WallGrid::covering(&walls, 2.6, 200.0).unwrap();
        assert_eq!(grid.height, 520);
        assert_eq!(grid.faces, [FaceSpan { width: 2000, length_m: walls.faces[0].length_m(), closed: true }]);
        assert_eq!(WallGrid::covering(&walls, 2.61, 3.1).unwrap().height, 9);
        assert_eq!(WallGrid::covering(&walls, 0.01, 1.0).unwrap().height, 1);
    }

    #[test]
    fn values_out_of_range_are_named() {
        let walls = room(3.0, 2.0);
        let message = |height_m, texels_per_metre| {
            let error = WallGrid::covering(&walls, height_m, texels_per_metre).unwrap_err();
            assert!(error.hint().is_some());
            error.to_string()
        };
        assert_eq!(message(2.6, 1001.0), "the walls' texel density is 1001 texels/m, allowed is 1 to 1000");
        assert!(message(2.6, f64::NAN).contains("NaN"));
        for height_m in [0.0, -2.0, 101.0, f64::NAN, f64::INFINITY] {
            assert!(message(height_m, 200.0).starts_with("walls are "), "{height_m}");
        }
        let of_length = |length_m: f64, texels_per_metre| {
            let mut walls = room(3.0, 2.0);
            walls.faces[0] =
                Face { closed: false, points_m: vec![vec2(0.0, 0.0), vec2(length_m, 0.0)], furniture_m: None };
            WallGrid::covering(&walls, 2.6, texels_per_metre)
        };
        let message = of_length(2e6, 1000.0).unwrap_err().to_string();
        assert!(message.starts_with("a wall of 2000000.0 m"), "{message}");
        assert_eq!(of_length(1e4, 1000.0).unwrap().faces[0].width, 10_000_000);
    }
}
