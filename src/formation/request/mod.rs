//! What a user asks for: the `[formation]` section of a scenario.

use serde::{Deserialize, Serialize};

mod check;
mod error;
mod example;
mod key;

pub use error::RequestError;
pub use example::{Choice, ExampleKind, ExampleRequest, Repeat};
pub use key::{FormationShape, KeyRequest};

use super::MOST_PEOPLE;
use crate::math::Vec2;

/// Farthest from the origin that anything may be, metres.
pub const FARTHEST_M: f64 = 100_000.0;
/// How deep small crowds may stand within each other.
pub const DEEPEST: usize = 8;

/// A crowd that changes from formation to formation: `[formation]` of a scenario.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FormationRequest {
    /// How long it lasts, seconds; left out: to the last key formation, else as long as the example, else a minute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Frames per second; left out: 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// How the individuals move.
    #[serde(skip_serializing_if = "ExampleRequest::is_default")]
    pub example: ExampleRequest,
    /// How strongly it is kept: 0 not at all, 1 as in the example; left out: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluctuation: Option<f64>,
    /// What the example's way of moving stays with; left out: with the formation's shapes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stays_with: Option<Stays>,
    /// How far neighbours feel each other, metres; left out: from how far apart they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma_m: Option<f64>,
    /// Individuals who are each other's neighbours wherever they are: they keep together.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<Vec<u32>>,
    /// Individuals whose weight of adjacency is set.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub adjacency: Vec<AdjacencyRequest>,
    /// Who goes to which place of a key formation, unless it says so itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assign: Option<Assign>,
    /// How people go from one key formation to the next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pace: Option<Pace>,
    /// Where the whole goes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub way: Option<PathRequest>,
    /// How people keep clear of each other.
    #[serde(skip_serializing_if = "AvoidRequest::is_default")]
    pub avoid: AvoidRequest,
    /// Formations at chosen times.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub key: Vec<KeyRequest>,
    /// Small crowds that stand where individuals would.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub crowd: Vec<CrowdRequest>,
}

/// A small crowd that takes the place of one individual or of several: `[[formation.crowd]]`, and within it
/// `[[formation.crowd.crowd]]`, and so on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CrowdRequest {
    /// In whose places such crowds stand.
    pub members: Members,
    /// Whether one more is carried in the middle of each.
    pub rider: bool,
    /// Whether it keeps clear of others as one body; left out: where there is a rider.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub as_one: Option<bool>,
    /// Whether it turns to where it goes: what is up in its formations points forward.
    pub follow_heading: bool,
    /// As in [`FormationRequest::example`].
    #[serde(skip_serializing_if = "ExampleRequest::is_default")]
    pub example: ExampleRequest,
    /// As in [`FormationRequest::fluctuation`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluctuation: Option<f64>,
    /// As in [`FormationRequest::stays_with`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stays_with: Option<Stays>,
    /// As in [`FormationRequest::sigma_m`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma_m: Option<f64>,
    /// As in [`FormationRequest::together`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<Vec<u32>>,
    /// As in [`FormationRequest::adjacency`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub adjacency: Vec<AdjacencyRequest>,
    /// As in [`FormationRequest::assign`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assign: Option<Assign>,
    /// As in [`FormationRequest::pace`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pace: Option<Pace>,
    /// What differs from the larger crowd's way of keeping clear.
    #[serde(skip_serializing_if = "AvoidRequest::is_default")]
    pub avoid: AvoidRequest,
    /// Formations at chosen times, around the individual whose place it takes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub key: Vec<KeyRequest>,
    /// Smaller crowds within.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub crowd: Vec<CrowdRequest>,
}

/// What a crowd and the small crowds within it have in common.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)] // as in FormationRequest
pub(super) struct CrowdSection<'r> {
    pub example: &'r ExampleRequest,
    pub fluctuation: Option<f64>,
    pub stays_with: Option<Stays>,
    pub sigma_m: Option<f64>,
    pub together: &'r [Vec<u32>],
    pub adjacency: &'r [AdjacencyRequest],
    pub assign: Option<Assign>,
    pub pace: Option<Pace>,
    pub avoid: &'r AvoidRequest,
    pub key: &'r [KeyRequest],
    pub crowd: &'r [CrowdRequest],
}

macro_rules! section {
    ($request:expr) => {
        CrowdSection {
            example: &$request.example,
            fluctuation: $request.fluctuation,
            stays_with: $request.stays_with,
            sigma_m: $request.sigma_m,
            together: &$request.together,
            adjacency: &$request.adjacency,
            assign: $request.assign,
            pace: $request.pace,
            avoid: &$request.avoid,
            key: &$request.key,
            crowd: &$request.crowd,
        }
    };
}

impl FormationRequest {
    pub(super) fn section(&self) -> CrowdSection<'_> {
        section!(self)
    }
}

impl CrowdRequest {
    pub(super) fn section(&self) -> CrowdSection<'_> {
        section!(self)
    }

    /// Whether it keeps clear of others as one body.
    pub(super) fn is_as_one(&self) -> bool {
        self.as_one.unwrap_or(self.rider)
    }
}

/// In whose places small crowds stand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Members {
    /// In those of these individuals.
    List(Vec<u32>),
    /// In that of every so many.
    Every {
        /// From one to the next.
        every: u32,
        /// The first.
        #[serde(default)]
        from: u32,
    },
    /// In everybody's.
    Word(MembersWord),
}

/// What members may be as a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MembersWord {
    /// Everybody.
    All,
}

impl Default for Members {
    fn default() -> Members {
        Members::Word(MembersWord::All)
    }
}

impl Members {
    /// Whether this individual is one of them.
    pub(super) fn contains(&self, individual: usize) -> bool {
        match self {
            Members::Word(MembersWord::All) => true,
            Members::List(list) => list.iter().any(|&member| member as usize == individual),
            Members::Every { every, from } => {
                let behind = individual.checked_sub(*from as usize);
                behind.is_some_and(|behind| behind.is_multiple_of((*every).max(1) as usize))
            }
        }
    }
}

/// A weight of adjacency that is set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdjacencyRequest {
    /// Between all of these.
    pub members: Vec<u32>,
    /// 0: they are strangers however near; 1: neighbours as if they stood in one place.
    pub weight: f64,
}

/// Who goes to which place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Assign {
    /// Each to one so that all together have the shortest way, seen from the middle of the crowd.
    #[default]
    Shortest,
    /// The first to the first place, and so on.
    Order,
}

/// What an example's way of moving stays with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stays {
    /// With the shapes that a formation is made of, as in the paper: swinging of the example's outline becomes swinging
    /// of the new outline.
    #[default]
    Shapes,
    /// With the people: everybody moves as their own example does.
    People,
}

/// How people go from one key formation to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pace {
    /// They set out gently and arrive gently.
    #[default]
    Gentle,
    /// Evenly all the way.
    Even,
}

/// Where the middle of the whole goes. Key formations are placed relative to it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PathRequest {
    /// Where it begins, metres; left out: the first point of the path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<Vec2>,
    /// Where it ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<Vec2>,
    /// Points on the way, passed on a smooth curve.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Vec2>,
    /// When the way begins, seconds; before, the whole stays.
    pub from_s: f64,
    /// When it ends; left out: at the end of all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// Whether the whole turns along the way: what is up in its formations points forward.
    pub follow_heading: bool,
}

/// How people keep clear of each other. What a small crowd leaves out is as in the larger one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AvoidRequest {
    /// Whether they do; left out: yes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Bodies' middles never come nearer to each other (mean of the two), metres; left out: 0.36.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_m: Option<f64>,
    /// How strongly neighbours push each other, in inverse proportion to their distance, where 1 moves somebody by 1 m
    /// whose neighbour is at 1 m; left out: 0.02.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub push: Option<f64>,
    /// How long before and after an encounter people step aside, seconds; left out: 0.8.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl AvoidRequest {
    fn is_default(&self) -> bool {
        *self == AvoidRequest::default()
    }

    /// These settings, over those of the larger crowd.
    pub(super) fn over(&self, larger: &AvoidRequest) -> AvoidRequest {
        AvoidRequest {
            on: self.on.or(larger.on),
            distance_m: self.distance_m.or(larger.distance_m),
            push: self.push.or(larger.push),
            seconds: self.seconds.or(larger.seconds),
        }
    }
}

#[cfg(test)]
mod tests;
