use serde::Serialize;

use super::{LengthUnit, RecordingFormat};
use crate::math::Rect;

/// Survey of a recording: its size, span, units and warnings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Survey {
    /// File format.
    pub format: RecordingFormat,
    /// Length unit of the file.
    pub unit: LengthUnit,
    /// Frames per second of the motion; the usual rate if it varies.
    pub fps: f64,
    /// Number of people in the file.
    pub people: usize,
    /// Largest id in the file. A person who returns after a long gap gets a larger one.
    pub largest_id: u32,
    /// Number of returns after a gap; each counts as a new person.
    pub returns: u64,
    /// Number of moments at which at least one person is present.
    pub frames: usize,
    /// Number of positions, summed over all frames.
    pub places: usize,
    /// First and last time, seconds.
    pub span_s: [f64; 2],
    /// Total time present of all persons, seconds.
    pub person_seconds: f64,
    /// Mean walking speed, m/s. Body sway and noise are removed over five consecutive rows.
    pub mean_speed_m_s: f64,
    /// Bounding box of all positions after the alignment, metres.
    pub bounds_m: Rect,
    /// Whether rows are sorted by time; unsorted rows are sorted in memory.
    pub in_order: bool,
    /// Messages for the user, such as an assumed unit or rate.
    pub warnings: Vec<String>,
}
