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
use crate::options::{Field, Kind, Leaf, Table, Value, names, options};

/// Largest coordinate of a position, metres.
pub const FARTHEST_M: f64 = 100_000.0;
/// Largest nesting depth of small crowds.
pub const DEEPEST: usize = 8;

options! {
    /// A crowd that changes from formation to formation: `[formation]` of a scenario.
    pub struct FormationRequest {
        /// How long it lasts; left out: to the last key formation.
        duration_s: Option<f64> = None, in 0.1..=36000.0, unit "s", eg "60.0";
        /// Frames per second; left out: 10.
        fps: Option<f64> = None, in 0.1..=1000.0, eg "10.0";
        /// The example whose motion the individuals take over.
        example: ExampleRequest = ExampleRequest::default();
        /// How strongly the example's own way of moving is kept; left out: 1.
        fluctuation: Option<f64> = None, in 0.0..=10.0, eg "1.0";
        /// What that stays with: "shapes" that the formation is made of, or "people".
        stays_with: Option<Stays> = None, eg "\"people\"";
        /// How far neighbours feel each other; left out: from how far apart they are.
        sigma_m: Option<f64> = None, in 1e-3..=1e4, unit "m", eg "1.2";
        /// Who keeps together wherever they are; people count from 0 in the order of the example.
        together: Vec<Vec<u32>> = Vec::new(), eg "[[0, 1, 3]]";
        /// Or how near they feel, from 0, strangers, to 1, as if in one place.
        adjacency: Vec<AdjacencyRequest> = Vec::new(), eg "[{ members = [0, 1], weight = 0.2 }]";
        /// Who goes where in a key formation: "shortest" ways for all together, or by "order" (always in the first of
        /// those who only stand).
        assign: Option<Assign> = None, eg "\"shortest\"";
        /// From key to key: "gentle" starts and stops, or "even".
        pace: Option<Pace> = None, eg "\"gentle\"";
        /// Path of the crowd's centroid.
        way: Option<PathRequest> = None;
        /// Collision avoidance.
        avoid: AvoidRequest = AvoidRequest::default();
        /// Key formations.
        key: Vec<KeyRequest> = Vec::new();
        /// Small crowds in the places of individuals.
        crowd: Vec<CrowdRequest> = Vec::new();
    }
}

options! {
    /// A small crowd in the place of one or several individuals: `[[formation.crowd]]`.
    ///
    /// Small crowds nest: `[[formation.crowd.crowd]]`, and so on.
    pub struct CrowdRequest {
        /// In whose places small crowds stand: "all", a list, or { every = 2, from = 0 }.
        members: Members = Members::default(), eg "[0, 2, 4]";
        /// Whether one more is carried in the middle of each.
        rider: bool = false;
        /// Whether each keeps clear of others as one body; left out: with a rider.
        as_one: Option<bool> = None, eg "true";
        /// Whether each turns to where it goes.
        follow_heading: bool = false;
        /// How its people move, as [formation.example].
        example: ExampleRequest = ExampleRequest::default(), eg "{ kind = \"sway\", people = 3 }";
        /// As in [formation].
        fluctuation: Option<f64> = None, in 0.0..=10.0, eg "1.0";
        /// As in [formation].
        stays_with: Option<Stays> = None, eg "\"people\"";
        /// As in [formation].
        sigma_m: Option<f64> = None, in 1e-3..=1e4, eg "0.8";
        /// As in [formation].
        together: Vec<Vec<u32>> = Vec::new(), eg "[[0, 1]]";
        /// As in [formation].
        adjacency: Vec<AdjacencyRequest> = Vec::new(), eg "[{ members = [0, 1], weight = 0.2 }]";
        /// As in [formation].
        assign: Option<Assign> = None, eg "\"order\"";
        /// As in [formation].
        pace: Option<Pace> = None, eg "\"even\"";
        /// As [formation.avoid]; what is left out is as in the larger crowd.
        avoid: AvoidRequest = AvoidRequest::default(), eg "{ distance_m = 0.3 }";
        /// Its formations, each in a [[formation.crowd.key]].
        key: Vec<KeyRequest> = Vec::new(), eg "[{ time_s = 0, shape = \"triangle\" }]";
        /// Smaller crowds within, each in a [[formation.crowd.crowd]].
        crowd: Vec<CrowdRequest> = Vec::new(), eg "[]";
    }
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

impl Members {
    const EVERY: Table = Table {
        name: "Every",
        parts: &[&[Field::plain("every", u32::kind, true), Field::plain("from", u32::kind, false)]],
    };
}

impl Leaf for Members {
    fn takes() -> Kind {
        let words = "\"all\", a list of individuals from 0 on, or { every = 2, from = 0 }";
        Kind::AnyOf(words, vec![Kind::OneOf(&["all"]), Vec::<u32>::kind(), Kind::Table(Members::EVERY)])
    }
}

names!(Assign, Pace, Stays);

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

options! {
    /// A weight of adjacency between individuals.
    pub struct AdjacencyRequest {
        /// The individuals; the weight applies to each pair.
        members: Vec<u32> = Vec::new(), required true;
        /// Weight: 0 as for people far apart, 1 as for people at one position.
        weight: f64 = 0.0, in 0.0..=1.0, required true;
    }
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

options! {
    /// Where the middle of the whole goes. Key formations are placed relative to it.
    pub struct PathRequest {
        /// Where the middle of all begins; key formations are placed relative to it.
        from: Option<Vec2> = None, unit "m", eg "[0.0, 0.0]";
        /// Where it ends.
        to: Option<Vec2> = None, unit "m", eg "[20.0, 0.0]";
        /// Points on the way, on a smooth curve.
        path: Vec<Vec2> = Vec::new(), unit "m", eg "[[5.0, 3.0], [12.0, -3.0]]";
        /// When it begins.
        from_s: f64 = 0.0, in 0.0..=36000.0, unit "s";
        /// When it ends; left out: at the end of all.
        to_s: Option<f64> = None, in 0.0..=36000.0, unit "s", eg "50.0";
        /// Whether all turn along it: what is up in a formation points forward.
        follow_heading: bool = false;
    }
}

options! {
    /// Settings of collision avoidance; a small crowd inherits what it leaves out.
    pub struct AvoidRequest {
        /// Whether people keep clear of each other.
        on: Option<bool> = None, eg "true";
        /// Bodies' middles never come nearer to each other; left out: 0.36.
        ///
        /// Least distance between the centres of two people (mean of both settings), metres; left out: 0.36.
        distance_m: Option<f64> = None, in 0.0..=10.0, unit "m", eg "0.36";
        /// How strongly neighbours push each other; left out: 0.02.
        ///
        /// Strength of the push between neighbours, in inverse proportion to their distance; left out: 0.02.
        ///
        /// 1 moves a person by 1 m whose neighbour is at 1 m.
        push: Option<f64> = None, in 0.0..=1.0, eg "0.02";
        /// How long before and after people step aside; left out: 0.8.
        seconds: Option<f64> = None, in 0.1..=10.0, unit "s", eg "0.8";
    }
}

impl AvoidRequest {
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
