use serde::{Deserialize, Serialize};

/// File format of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RecordingFormat {
    /// Text of the Juelich data archive: `id frame x y z`.
    Juelich,
    /// A JuPedSim database, version 1 or 2 (SQLite).
    Jupedsim,
    /// Vadere's `.traj`: `pedestrianId simTime startX startY ...`.
    Vadere,
    /// crowd:it's CSV: `pedID,time,posX,posY`.
    Crowdit,
    /// Viswalk's protocol: `NO;SIMSEC;COORDCENTX;COORDCENTY`.
    Viswalk,
    /// Pathfinder's CSV: `id,t,x,y`.
    Pathfinder,
    /// Text of the ETH/UCY data sets: `frame id x z y vx vz vy`.
    Obsmat,
    /// CSV with named columns: id, time or frame, x, y.
    Csv,
}

impl RecordingFormat {
    /// All formats.
    pub const ALL: [RecordingFormat; 8] = [
        RecordingFormat::Juelich,
        RecordingFormat::Jupedsim,
        RecordingFormat::Vadere,
        RecordingFormat::Crowdit,
        RecordingFormat::Viswalk,
        RecordingFormat::Pathfinder,
        RecordingFormat::Obsmat,
        RecordingFormat::Csv,
    ];

    /// Name in scenarios and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            RecordingFormat::Juelich => "juelich",
            RecordingFormat::Jupedsim => "jupedsim",
            RecordingFormat::Vadere => "vadere",
            RecordingFormat::Crowdit => "crowdit",
            RecordingFormat::Viswalk => "viswalk",
            RecordingFormat::Pathfinder => "pathfinder",
            RecordingFormat::Obsmat => "obsmat",
            RecordingFormat::Csv => "csv",
        }
    }

    /// Name in a sentence.
    pub const fn title(self) -> &'static str {
        match self {
            RecordingFormat::Juelich => "Juelich text",
            RecordingFormat::Jupedsim => "JuPedSim database",
            RecordingFormat::Vadere => "Vadere trajectories",
            RecordingFormat::Crowdit => "crowd:it CSV",
            RecordingFormat::Viswalk => "Viswalk protocol",
            RecordingFormat::Pathfinder => "Pathfinder CSV",
            RecordingFormat::Obsmat => "ETH/UCY annotations",
            RecordingFormat::Csv => "CSV",
        }
    }

    /// Whether the format is text, with one record per line.
    pub const fn is_text(self) -> bool {
        !matches!(self, RecordingFormat::Jupedsim)
    }
}
