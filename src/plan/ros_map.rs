//! The YAML of a ROS map (`map_server`): its image, scale, pose, and the meaning of its greys.
//!
//! Format: <http://wiki.ros.org/map_server>, section 3.1, equal to that of Nav2's map server.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::similar::similar_file;
use super::{LARGEST_ORIGIN_M, PlanError, Pose};
use crate::files::read_text;
use crate::math::vec2;

/// The content of a map's YAML.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RosMap {
    pub(super) image: PathBuf,
    pub(super) metres_per_pixel: f64,
    pub(super) pose: Pose,
    pub(super) greys: Greys,
}

/// How a map's greys map to free, occupied or unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Greys {
    pub(super) mode: Mode,
    pub(super) negate: bool,
    pub(super) occupied_at: f64,
    pub(super) free_at: f64,
}

/// `mode:` of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Mode {
    /// Two thresholds separate free, unknown and occupied.
    #[default]
    Trinary,
    /// Between the thresholds, the grey is the probability of occupied.
    Scale,
    /// The grey is the occupancy in percent; above 100 it is unknown.
    Raw,
}

/// State of a cell of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    Free,
    Occupied,
    Unknown,
}

impl Greys {
    /// Returns the state of a pixel; `grey` is the mean of its channels.
    ///
    /// With p = (255 - grey)/255, or grey/255 if `negate` is set: occupied from `occupied_thresh` on, free up to
    /// `free_thresh`, unknown in between and for pixels that are not opaque. In `scale` maps, values in between are
    /// probabilities and free below one half. In `raw` maps the grey is a percentage.
    pub(super) fn cell(&self, grey: f64, opaque: bool) -> Cell {
        if !opaque {
            return Cell::Unknown;
        }
        let p = match (self.mode, self.negate) {
            (Mode::Raw, false) => grey / 100.0,
            (Mode::Raw, true) => (255.0 - grey) / 100.0,
            (_, false) => (255.0 - grey) / 255.0,
            (_, true) => grey / 255.0,
        };
        if self.mode == Mode::Raw && p > 1.0 {
            Cell::Unknown
        } else if p >= self.occupied_at {
            Cell::Occupied
        } else if p <= self.free_at {
            Cell::Free
        } else if self.mode == Mode::Scale {
            let share = (p - self.free_at) / (self.occupied_at - self.free_at);
            if share < 0.5 { Cell::Free } else { Cell::Occupied }
        } else {
            Cell::Unknown
        }
    }
}

/// Whether a path is a map's YAML rather than an image.
pub(super) fn is_map(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("yaml") || e.eq_ignore_ascii_case("yml"))
}

#[derive(Deserialize)]
struct File {
    image: String,
    resolution: f64,
    origin: Vec<f64>,
    #[serde(default)]
    negate: Negate,
    #[serde(default = "usual_occupied")]
    occupied_thresh: f64,
    #[serde(default = "usual_free")]
    free_thresh: f64,
    #[serde(default)]
    mode: Mode,
}

/// `negate: 0` or `negate: 1`, and the booleans that YAML writers make of them.
#[derive(Deserialize)]
#[serde(untagged)]
enum Negate {
    Number(i64),
    Flag(bool),
}

impl Default for Negate {
    fn default() -> Negate {
        Negate::Flag(false)
    }
}

fn usual_occupied() -> f64 {
    0.65
}

fn usual_free() -> f64 {
    0.196
}

/// Reads a map's YAML. Its scale is checked with the other scales; its image is not opened.
pub(super) fn read(path: &Path) -> Result<RosMap, PlanError> {
    let text = read_text(path).map_err(|source| PlanError::Open { path: path.to_owned(), source })?;
    if text.trim().is_empty() {
        return Err(PlanError::Empty { path: path.to_owned() });
    }
    let refuse = |reason: String| PlanError::Map { path: path.to_owned(), reason };
    let file: File = serde_saphyr::from_str(&text).map_err(|e| refuse(e.without_snippet().to_string()))?;
    let (x, y, yaw_rad) = match file.origin[..] {
        [x, y] => (x, y, 0.0),
        [x, y, yaw] => (x, y, yaw),
        _ => return Err(refuse(format!("origin has {} numbers instead of x, y, yaw", file.origin.len()))),
    };
    // This form also refuses NaN.
    if ![x, y, yaw_rad].iter().all(|number| number.abs() <= LARGEST_ORIGIN_M) {
        let most = LARGEST_ORIGIN_M;
        return Err(refuse(format!("origin is [{x}, {y}, {yaw_rad}], allowed is -{most} to {most}")));
    }
    for (key, value) in [("occupied_thresh", file.occupied_thresh), ("free_thresh", file.free_thresh)] {
        if !(0.0..=1.0).contains(&value) {
            return Err(refuse(format!("{key} is {value}; it must lie between 0 and 1")));
        }
    }
    if file.free_thresh >= file.occupied_thresh {
        let (free, occupied) = (file.free_thresh, file.occupied_thresh);
        return Err(refuse(format!("free_thresh {free} is not below occupied_thresh {occupied}")));
    }
    let image = path.parent().unwrap_or(Path::new("")).join(&file.image);
    if !image.is_file() {
        let similar = similar_file(&image);
        return Err(PlanError::MapImageMissing { map: path.to_owned(), image, similar });
    }
    let negate = match file.negate {
        Negate::Number(number) => number != 0,
        Negate::Flag(flag) => flag,
    };
    Ok(RosMap {
        image,
        metres_per_pixel: file.resolution,
        pose: Pose { origin_m: vec2(x, y), yaw_rad },
        greys: Greys { mode: file.mode, negate, occupied_at: file.occupied_thresh, free_at: file.free_thresh },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const USUAL: Greys = Greys { mode: Mode::Trinary, negate: false, occupied_at: 0.65, free_at: 0.196 };

    #[test]
    fn grey_205_is_unknown_or_free_by_the_free_threshold() {
        assert_eq!(USUAL.cell(205.0, true), Cell::Unknown);
        assert_eq!(Greys { free_at: 0.25, ..USUAL }.cell(205.0, true), Cell::Free);
    }

    #[test]
    fn thresholds_belong_to_occupied_and_free() {
        let greys = Greys { occupied_at: 0.6, free_at: 0.2, ..USUAL };
        assert_eq!(greys.cell(102.0, true), Cell::Occupied);
        assert_eq!(greys.cell(103.0, true), Cell::Unknown);
        assert_eq!(greys.cell(203.0, true), Cell::Unknown);
        assert_eq!(greys.cell(204.0, true), Cell::Free);
    }

    #[test]
    fn negate_turns_black_into_floor_and_transparent_is_unknown() {
        let negated = Greys { negate: true, ..USUAL };
        assert_eq!(negated.cell(0.0, true), Cell::Free);
        assert_eq!(negated.cell(255.0, true), Cell::Occupied);
        assert_eq!(negated.cell(0.0, false), Cell::Unknown);
    }

    #[test]
    fn scale_splits_in_the_middle_and_raw_holds_percent() {
        let scale = Greys { mode: Mode::Scale, ..USUAL };
        assert_eq!(scale.cell(255.0 * (1.0 - 0.40), true), Cell::Free);
        assert_eq!(scale.cell(255.0 * (1.0 - 0.45), true), Cell::Occupied);
        let raw = Greys { mode: Mode::Raw, ..USUAL };
        let cells = [0.0, 19.0, 40.0, 65.0, 100.0, 101.0, 255.0].map(|grey| raw.cell(grey, true));
        use Cell::{Free, Occupied, Unknown};
        assert_eq!(cells, [Free, Free, Unknown, Occupied, Occupied, Unknown, Unknown]);
    }

    fn read_text(text: &str) -> Result<RosMap, PlanError> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("empty_room.pgm"), "P5 1 1 255 x").unwrap();
        let path = folder.path().join("map.yaml");
        std::fs::write(&path, text).unwrap();
        read(&path)
    }

    #[test]
    fn a_map_is_read_with_all_its_keys() {
        let text = "image: \"empty_room.pgm\"\nresolution: 0.1\norigin: [-2.0, -3, -1.]\nnegate: 1\n\
                    occupied_thresh: 0.5\nfree_thresh: 0.2\nmode: scale\n";
        let map = read_text(text).unwrap();
        assert_eq!(map.metres_per_pixel, 0.1);
        assert_eq!(map.pose, Pose { origin_m: vec2(-2.0, -3.0), yaw_rad: -1.0 });
        assert_eq!(map.greys, Greys { mode: Mode::Scale, negate: true, occupied_at: 0.5, free_at: 0.2 });
    }

    #[test]
    fn a_missing_image_is_named_with_the_one_that_may_be_meant() {
        let error = read_text("image: empty.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n").unwrap_err();
        assert!(error.to_string().contains("empty.pgm"), "{error}");
        assert!(error.hint().unwrap().contains("empty_room.pgm"));
    }

    #[test]
    fn what_is_wrong_in_a_map_is_said_with_its_line() {
        let error = read_text("image: empty_room.pgm\nresolution: coarse\norigin: [0, 0, 0]\n").unwrap_err();
        assert!(error.to_string().contains("line 2"), "{error}");
        let error = read_text("image: empty_room.pgm\norigin: [0, 0, 0]\n").unwrap_err();
        assert!(error.to_string().contains("resolution"), "{error}");
        for wrong in ["origin: [0]", "origin: [.nan, 0, 0]", "origin: [0, 0, 0]\nfree_thresh: 0.7", "origin: 3"] {
            let text = format!("image: empty_room.pgm\nresolution: 0.1\n{wrong}\n");
            assert!(matches!(read_text(&text), Err(PlanError::Map { .. })), "{wrong}");
        }
    }
}
