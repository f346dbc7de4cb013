//! The `[formation]` section of a scenario.

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

/// Largest coordinate of a position, metres.
pub const FARTHEST_M: f64 = 100_000.0;
/// Largest nesting depth of small crowds.
pub const DEEPEST: usize = 8;

/// Declares a section of a scenario that describes a crowd: its own settings around those that all crowds have.
macro_rules! crowd_section {
    ($(#[$about:meta])* $Section:ident { $($own:tt)* } around { $($inner:tt)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct $Section {
            $($own)*
            /// The example whose motion the individuals take over.
            #[serde(skip_serializing_if = "ExampleRequest::is_default")]
            pub example: ExampleRequest,
            /// Factor on the example's fluctuation, 0 to 10; left out: 1.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub fluctuation: Option<f64>,
            /// How the fluctuation is carried over; left out: with the formation's shapes.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub stays_with: Option<Stays>,
            /// Range of adjacency, metres; left out: the median distance to the nearest person.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub sigma_m: Option<f64>,
            /// Groups of individuals who are adjacent at any distance, so that they keep together.
            #[serde(skip_serializing_if = "Vec::is_empty")]
            pub together: Vec<Vec<u32>>,
            /// Weights of adjacency between individuals.
            #[serde(skip_serializing_if = "Vec::is_empty")]
            pub adjacency: Vec<AdjacencyRequest>,
            /// Default assignment of people to the positions of key formations.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub assign: Option<Assign>,
            /// Easing from one key formation to the next.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub pace: Option<Pace>,
            $($inner)*
            /// Collision avoidance; a small crowd inherits what it leaves out from the larger one.
            #[serde(skip_serializing_if = "AvoidRequest::is_default")]
            pub avoid: AvoidRequest,
            /// Key formations; those of a small crowd are relative to the individual that it replaces.
            #[serde(skip_serializing_if = "Vec::is_empty")]
            pub key: Vec<KeyRequest>,
            /// Small crowds in the places of individuals.
            #[serde(skip_serializing_if = "Vec::is_empty")]
            pub crowd: Vec<CrowdRequest>,
        }

        impl $Section {
            /// What it has in common with other crowds.
            pub(super) fn section(&self) -> CrowdSection<'_> {
                CrowdSection {
                    example: &self.example,
                    fluctuation: self.fluctuation,
                    stays_with: self.stays_with,
                    sigma_m: self.sigma_m,
                    together: &self.together,
                    adjacency: &self.adjacency,
                    assign: self.assign,
                    pace: self.pace,
                    avoid: &self.avoid,
                    key: &self.key,
                    crowd: &self.crowd,
                }
            }
        }
    };
}

crowd_section! {
    /// A crowd that changes from formation to formation: `[formation]` of a scenario.
    FormationRequest {
        /// Duration, seconds; left out: to the last key formation, else as long as the example, else 60 s.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub duration_s: Option<f64>,
        /// Frames per second; left out: 10.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub fps: Option<f64>,
    } around {
        /// Path of the crowd's centroid.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub way: Option<PathRequest>,
    }
}

crowd_section! {
    /// A small crowd in the place of one or several individuals: `[[formation.crowd]]`.
    ///
    /// Small crowds nest: `[[formation.crowd.crowd]]`, and so on.
    CrowdRequest {
        /// The individuals that such crowds replace.
        pub members: Members,
        /// Whether each crowd carries a rider at its centre.
        pub rider: bool,
        /// Whether it avoids others as one body; left out: if it has a rider.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub as_one: Option<bool>,
        /// Whether it turns to its heading: the formations' up points forward.
        pub follow_heading: bool,
    } around {}
}

/// The settings that a crowd and the small crowds within it have in common.
#[derive(Clone, Copy, Debug)]
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

impl CrowdRequest {
    /// Whether it avoids others as one body.
    pub(super) fn is_as_one(&self) -> bool {
        self.as_one.unwrap_or(self.rider)
    }
}

/// The individuals that small crowds replace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Members {
    /// These individuals.
    List(Vec<u32>),
    /// Individuals at a regular interval.
    Every {
        /// The interval, 1 or more.
        every: u32,
        /// The first individual, from 0.
        #[serde(default)]
        from: u32,
    },
    /// A word.
    Word(MembersWord),
}

/// Words for members.
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
    /// Whether an individual is among the members.
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

/// A weight of adjacency between individuals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdjacencyRequest {
    /// The individuals; the weight applies to each pair.
    pub members: Vec<u32>,
    /// Weight, 0 to 1: 0 as for people far apart, 1 as for people at one position.
    pub weight: f64,
}

/// Assignment of people to the positions of a key formation.
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
    /// Points on the path, joined by a smooth curve.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Vec2>,
    /// Start of the motion along the path, seconds.
    pub from_s: f64,
    /// End of the motion along the path, seconds; left out: the end of the formation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// Whether the crowd turns to its heading: the formations' up points forward.
    pub follow_heading: bool,
}

/// Settings of collision avoidance; a small crowd inherits what it leaves out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AvoidRequest {
    /// Whether people keep clear of each other; left out: yes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Least distance between the centres of two people (mean of both settings), metres; left out: 0.36.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_m: Option<f64>,
    /// Strength of the push between neighbours, in inverse proportion to their distance; left out: 0.02.
    ///
    /// 1 moves a person by 1 m whose neighbour is at 1 m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub push: Option<f64>,
    /// Time for which people step aside before and after an encounter, seconds; left out: 0.8.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl AvoidRequest {
    fn is_default(&self) -> bool {
        *self == AvoidRequest::default()
    }

    /// These settings, completed by those of the larger crowd.
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
