use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::options::{Kind, Leaf, Value, names, options};
use crate::recordings::RecordingOptions;

options! {
    /// The example of a formation: a recording or a generated motion.
    pub struct ExampleRequest {
        /// What the example does: "still", "sway", "ranks" that march, or "wander".
        kind: Option<ExampleKind> = None, eg "\"ranks\"";
        /// Or a recording, relative to this file.
        file: Option<PathBuf> = None, eg "\"march.txt\"";
        /// How the recording is read, as [motion].
        recording: RecordingOptions = RecordingOptions::default(), eg "{ unit = \"cm\", fps = 16 }";
        /// Where in it to begin.
        from_s: f64 = 0.0, in 0.0..=1e7, unit "s";
        /// Where to end; left out: at its end.
        to_s: Option<f64> = None, in 0.0..=1e7, unit "s", eg "20.0";
        /// How it goes on if it is too short: "to-and-fro" or "loop".
        repeat: Repeat = Repeat::default(), eg "\"loop\"";
        /// Which of its people; of small crowds a list for each.
        choose: Option<Choice> = None, eg "[[0, 1, 3], [4, 5, 7]]";
        /// How many are made; left out: by rows and columns, or as a key formation has points.
        people: Option<u32> = None, in 1.0..=2000.0, eg "9";
        /// Rows one behind the other.
        rows: Option<u32> = None, in 1.0..=2000.0, eg "3";
        /// People side by side.
        columns: Option<u32> = None, in 1.0..=2000.0, eg "3";
        /// From one to the next.
        spacing_m: f64 = 1.0, in 0.05..=1e3, unit "m";
        /// How fast they walk; left out: ranks 1.2, who wanders 0.9.
        speed_m_s: Option<f64> = None, in 0.0..=10.0, unit "m/s", eg "1.2";
        /// Where ranks go.
        heading_deg: f64 = 90.0, in -360.0..=360.0, unit "degrees from +x";
        /// How far everybody strays from their place in the ranks.
        stray_m: f64 = 0.12, in 0.0..=10.0, unit "m";
        /// How far from their middle people wander; left out: by the spacing.
        radius_m: Option<f64> = None, in 0.1..=1e4, unit "m", eg "6.0";
        /// Another number, another example.
        seed: u64 = 1;
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

impl Leaf for Choice {
    fn takes() -> Kind {
        let words = "a list of people from 0 on, or a list of such lists";
        Kind::AnyOf(words, vec![Vec::<u32>::kind(), Vec::<Vec<u32>>::kind()])
    }
}

names!(ExampleKind, Repeat);

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
