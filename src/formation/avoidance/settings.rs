use crate::formation::request::AvoidRequest;

/// Default strength of the push between neighbours, see [`AvoidRequest::push`].
const USUAL_PUSH: f64 = 0.02;
/// Default time for which people step aside before and after an encounter, seconds.
const USUAL_SECONDS: f64 = 0.8;

/// Settings of collision avoidance within a formation.
#[derive(Clone, Debug)]
pub(in super::super) struct AvoidanceSettings {
    /// Whether bodies keep clear of each other.
    pub on: bool,
    /// Strength of the push between neighbours, see [`AvoidRequest::push`].
    pub push: f64,
    /// Time for which people step aside before and after an encounter, seconds.
    pub seconds: f64,
    /// Frames per second.
    pub fps: f64,
    /// Frames of the key formations.
    pub keys: Vec<usize>,
    /// What to do about a crowd that is too dense, for the warning.
    pub hint: &'static str,
}

impl AvoidanceSettings {
    /// Takes the settings of a crowd; `keys` are the frames of its key formations.
    pub fn new(request: &AvoidRequest, fps: f64, keys: &[usize]) -> AvoidanceSettings {
        AvoidanceSettings {
            on: request.on.unwrap_or(true),
            push: request.push.unwrap_or(USUAL_PUSH),
            seconds: request.seconds.unwrap_or(USUAL_SECONDS),
            fps,
            keys: keys.to_vec(),
            hint: "spread the key formations, leave more time between them, or set a smaller `avoid.distance_m`",
        }
    }
}
