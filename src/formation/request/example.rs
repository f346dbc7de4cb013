use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::recordings::RecordingOptions;

/// The motion whose way of moving a formation takes over: a recording, or one that is made here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ExampleRequest {
    /// What is made where no file is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<ExampleKind>,
    /// A recording, relative to the scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// How the recording is read.
    pub recording: RecordingOptions,
    /// Where in the example to begin, seconds.
    pub from_s: f64,
    /// Where to end; left out: at its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// How an example goes on that is too short.
    pub repeat: Repeat,
    /// Which of its people to take, by their order from 0 on; left out: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choose: Option<Choice>,
    /// How many people are made; left out: as many as rows and columns, or as the first key formation has places.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub people: Option<u32>,
    /// Rows one behind the other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<u32>,
    /// People side by side in a row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<u32>,
    /// From one to the next, metres.
    pub spacing_m: f64,
    /// How fast they walk, metres per second; left out: ranks 1.2, who wanders 0.9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Where ranks go, degrees counter-clockwise from +x.
    pub heading_deg: f64,
    /// How far everybody strays from their place in the ranks, metres.
    pub stray_m: f64,
    /// How far from their middle people wander, metres; left out: so that each has three spacings squared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Another number, another example.
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

/// A motion that is made here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ExampleKind {
    /// Nobody moves.
    Still,
    /// Everybody stays about their place and shifts around it, as people do who float or wait.
    Sway,
    /// Ranks that march, step by step.
    Ranks,
    /// A crowd that strolls about in all directions.
    Wander,
}

/// How an example goes on that is too short.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Repeat {
    /// Forwards, then backwards, and so on, slowing down where it turns.
    #[default]
    ToAndFro,
    /// From the start again, each passage faded into the next.
    Loop,
}

/// Which people of an example are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Choice {
    /// The same for every small crowd.
    Same(Vec<u32>),
    /// For the first small crowd, the second, and so on, from the start again where there are more.
    Each(Vec<Vec<u32>>),
}

impl Choice {
    /// The people of the small crowd of this number.
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
