use super::{LengthUnit, RecordingFormat};
use crate::options::{names, options};

names!(LengthUnit, RecordingFormat);

options! {
    /// How a recording is read; what is left out is found in the file.
    pub struct RecordingOptions {
        /// How it is written; left out: found.
        format: Option<RecordingFormat> = None, eg "\"juelich\"";
        /// Of its lengths, "m", "cm", "mm" or "ft"; left out: found.
        unit: Option<LengthUnit> = None, eg "\"cm\"";
        /// Frames per second, where it counts frames; left out: found.
        fps: Option<f64> = None, in 0.01..=1000.0, eg "25";
        /// What its columns mean, in order; - for one of no use.
        columns: Option<String> = None, eg "\"id,frame,x,y,-\"";
        /// The point that stays where it is when the recording is turned.
        origin: [f64; 2] = [0.0; 2], unit "m";
        /// How far the recording is moved.
        shift: [f64; 2] = [0.0; 2], unit "m";
        /// How far it is turned, counter-clockwise.
        rotation_deg: f64 = 0.0, in -360.0..=360.0, unit "degrees";
    }
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
