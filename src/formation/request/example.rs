use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::recordings::RecordingOptions;

/// The example of a formation: a recording or a generated motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ExampleRequest {
    /// Kind of generated motion, if no file is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<ExampleKind>,
    /// File of the recording, relative to the scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Options for reading the recording.
    pub recording: RecordingOptions,
    /// Start within the recording, seconds.
    pub from_s: f64,
    /// End within the recording, seconds; left out: its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// Repetition of an example that is too short.
    pub repeat: Repeat,
    /// The people to take, by index from 0; left out: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choose: Option<Choice>,
    /// Number of people to generate; left out: rows times columns, or the positions of the first key formation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub people: Option<u32>,
    /// Number of rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<u32>,
    /// Number of people in a row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<u32>,
    /// Distance between neighbours, metres.
    pub spacing_m: f64,
    /// Walking speed, metres per second; left out: 1.2 for ranks, 0.9 for wanderers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Heading of ranks, degrees counter-clockwise from +x.
    pub heading_deg: f64,
    /// Amplitude of straying from the place in the ranks, metres.
    pub stray_m: f64,
    /// Radius within which people wander, metres; left out: three times the squared spacing for each person.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Seed of the generated motion.
    pub seed: u64,
}

impl Default for ExampleRequest {
    fn default() -> ExampleRequest {
        ExampleRequest {
            kind: None,
            file: None,
            recording: RecordingOptions::default(),
            from_s: 0.0,
            to_s: None,
            repeat: Repeat::default(),
            choose: None,
            people: None,
            rows: None,
            columns: None,
            spacing_m: 1.0,
            speed_m_s: None,
            heading_deg: 90.0,
            stray_m: 0.12,
            radius_m: None,
            seed: 1,
        }
    }
}

impl ExampleRequest {
    pub(super) fn is_default(&self) -> bool {
        *self == ExampleRequest::default()
    }
}

/// Kinds of generated motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ExampleKind {
    /// People stand still.
    Still,
    /// People shift around their place, as when floating or waiting.
    Sway,
    /// Ranks that march, step by step.
    Ranks,
    /// A crowd that wanders in all directions.
    Wander,
}

/// Repetition of an example that is too short.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Repeat {
    /// Forwards, then backwards, and so on, slowing down where it turns.
    #[default]
    ToAndFro,
    /// From the start again, with a cross-fade between passages.
    Loop,
}

/// The people of an example that are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Choice {
    /// The same people for every small crowd.
    Same(Vec<u32>),
    /// One list per small crowd, repeated from the start if there are more crowds.
    Each(Vec<Vec<u32>>),
}

impl Choice {
    /// The people for the small crowd of a number.
    pub(in super::super) fn of_crowd(&self, number: usize) -> &[u32] {
        match self {
            Choice::Same(people) => people,
            Choice::Each(lists) if lists.is_empty() => &[],
            Choice::Each(lists) => &lists[number % lists.len()],
        }
    }

    pub(super) fn lists(&self) -> Vec<&[u32]> {
        match self {
            Choice::Same(people) => vec![people],
            Choice::Each(lists) => lists.iter().map(Vec::as_slice).collect(),
        }
    }
}
