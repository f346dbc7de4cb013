use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{ExportError, OutputFolder};

/// What happened in a run: `report.json`, the one file of a bake that differs from run to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Who walked.
    pub people: PeopleReport,
    /// Number of footfalls.
    pub footfalls: u64,
    /// Wall-clock seconds as `total`, and the busy seconds of each stage, summed over threads, by the stage's name.
    pub seconds: BTreeMap<String, f64>,
    /// The most memory held at once, MiB; `null` where the system does not tell.
    pub peak_memory_mib: Option<f64>,
}

/// What became of the people.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PeopleReport {
    /// How many entered.
    pub entered: u64,
    /// How many reached their goal.
    pub arrived: u64,
    /// How many were still under way when the crowd was given up.
    pub stuck: u64,
}

impl Report {
    /// The report's name in a bake.
    pub const FILE_NAME: &str = "report.json";

    /// Reads the report of a bake.
    ///
    /// # Errors
    /// There is none, or it is damaged.
    pub fn read(bake: &Path) -> Result<Report, ExportError> {
        let path = bake.join(Self::FILE_NAME);
        let json = std::fs::read(&path).map_err(ExportError::read(&path))?;
        serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))
    }

    /// Writes the report. Seconds are rounded to milliseconds, memory to a tenth.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, folder: &OutputFolder) -> Result<(), ExportError> {
        let mut rounded = self.clone();
        for seconds in rounded.seconds.values_mut() {
            *seconds = (*seconds * 1e3).round() / 1e3;
        }
        rounded.peak_memory_mib = rounded.peak_memory_mib.map(|mib| (mib * 10.0).round() / 10.0);
        let mut json = serde_json::to_vec_pretty(&rounded).expect("all keys are strings and memory does not fail");
        json.push(b'\n');
        folder.write(Self::FILE_NAME, &json)
    }
}
