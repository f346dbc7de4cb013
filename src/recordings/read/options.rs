use serde::{Deserialize, Serialize};

use super::{LengthUnit, RecordingFormat};

/// How a recording is read; what is left out is found in the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RecordingOptions {
    /// How it is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<RecordingFormat>,
    /// Unit of its lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// Frames per second, for files that count frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// What columns mean, in their order, as `id,frame,x,y`; `-` for one that is of no use.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<String>,
    /// The point of the recording that stays where it is when it is turned, metres.
    pub origin: [f64; 2],
    /// How far it is moved, metres.
    pub shift: [f64; 2],
    /// How far it is turned around `origin`, degrees counter-clockwise.
    pub rotation_deg: f64,
}

impl RecordingOptions {
    /// These options, with those of `others` that are not left out.
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
