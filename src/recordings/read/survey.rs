use serde::Serialize;

use super::{LengthUnit, RecordingFormat};
use crate::math::Rect;

/// What a recording holds, found in one pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Survey {
    /// How it is written.
    pub format: RecordingFormat,
    /// Unit of its lengths.
    pub unit: LengthUnit,
    /// Frames per second of the motion; the usual rate where it changes.
    pub fps: f64,
    /// Number of people in the file.
    pub people: usize,
    /// The largest id in the file. Who comes back after a long gap gets one above it.
    pub largest_id: u32,
    /// How often somebody was missing for longer than a gap, and came back: as another person.
    pub returns: u64,
    /// Number of moments at which anybody is there.
    pub frames: usize,
    /// Number of places: people times the moments in which they are there.
    pub places: usize,
    /// First and last moment, seconds.
    pub span_s: [f64; 2],
    /// Seconds that all are present together.
    pub person_seconds: f64,
    /// Metres walked in a second of somebody's presence, sway and noise taken out as far as five rows in a row tell.
    pub mean_speed_m_s: f64,
    /// The rectangle around all places, after the alignment, metres.
    pub bounds_m: Rect,
    /// Whether rows come in the order of time: if not, they are held in memory and sorted.
    pub in_order: bool,
    /// What a user should be told, such as a unit or a rate that was assumed.
    pub warnings: Vec<String>,
}
