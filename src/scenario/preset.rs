use serde::{Deserialize, Serialize};

/// What every key of a scenario starts from. Keys that a file writes win over it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Grown-ups on their way through an office or a station, in dry weather.
    #[default]
    Commuters,
    /// The same people on a floor far beyond its next deep clean.
    Heavy,
    /// The same people on a rainy day.
    Wet,
    /// The experiment of Takenaka, Tanaka and Sagawa, *Expression of indoor grime by human walk*: fast people with
    /// a stride of their own, one kind of print, painted over each other.
    Paper,
}

impl Preset {
    /// All presets, in the order in which help texts list them.
    pub const ALL: [Preset; 4] = [Preset::Commuters, Preset::Heavy, Preset::Wet, Preset::Paper];

    /// The name, as a scenario and the command line write it.
    pub const fn name(self) -> &'static str {
        match self {
            Preset::Commuters => "commuters",
            Preset::Heavy => "heavy",
            Preset::Wet => "wet",
            Preset::Paper => "paper",
        }
    }
}
