use serde::{Deserialize, Serialize};

use super::{LengthUnit, RecordingFormat};

/// Options for reading a recording; omitted ones are detected from the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RecordingOptions {
    /// File format.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<RecordingFormat>,
    /// Length unit of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// Frames per second of the file, for files that count frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Roles of the columns in order, such as `id,frame,x,y`; `-` for an ignored one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<String>,
    /// Centre of the rotation, metres, in the recording.
    pub origin: [f64; 2],
    /// Translation after the rotation, metres.
    pub shift: [f64; 2],
    /// Rotation around `origin`, degrees counter-clockwise.
    pub rotation_deg: f64,
}

impl RecordingOptions {
    /// Returns these options, replaced by those that are set in `others`.
    pub fn overridden_by(&self, others: &RecordingOptions) -> RecordingOptions {
        let default = RecordingOptions::default();
        let pick = |own: [f64; 2], other: [f64; 2], none: [f64; 2]| if other == none { own } else { other };
        RecordingOptions {
            format: others.format.or(self.format),
            unit: others.unit.or(self.unit),
            fps: others.fps.or(self.fps),
            columns: others.columns.clone().or_else(|| self.columns.clone()),
            origin: pick(self.origin, others.origin, default.origin),
            shift: pick(self.shift, others.shift, default.shift),
            rotation_deg: if others.rotation_deg == 0.0 { self.rotation_deg } else { others.rotation_deg },
        }
    }
}
