use std::path::PathBuf;

use super::{DEEPEST, MOST_PEOPLE};

/// Why a formation cannot be made as it is asked for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// A value that is out of range or does not fit the others.
    #[error("{key}: {problem}")]
    Value {
        /// Which, as `formation.key.2.time_s`, lists counted from 0.
        key: String,
        /// What is wrong with it.
        problem: String,
        /// What to do about it.
        hint: Option<String>,
    },
    /// A file of places cannot be used.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why not.
        problem: String,
    },
    /// A line of a file of points.
    #[error("{}, line {line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1 on.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// A formation has places for others than there are.
    #[error("{key}: there are {people} people, but {places} {what}")]
    Count {
        /// Which key formation.
        key: String,
        /// People of the example.
        people: usize,
        /// Places of the formation.
        places: usize,
        /// What they are: "points", "dots in dots.png".
        what: String,
    },
    /// Nothing says how many people there are.
    #[error("{key}: nothing says how many people there are")]
    HowMany {
        /// Which example.
        key: String,
    },
    /// An example has not those who are chosen.
    #[error("{key}: there is no person {person} in the example: it has {people}, from 0 to {last}", last = people.saturating_sub(1))]
    NoSuchPerson {
        /// What names the person.
        key: String,
        /// Who is not there.
        person: u32,
        /// How many there are.
        people: usize,
    },
    /// More than can be worked on.
    #[error(
        "{key}: {people} people, allowed are 1 to {MOST_PEOPLE} in one crowd; small crowds within may have as many each"
    )]
    TooMany {
        /// Which example.
        key: String,
        /// How many there are.
        people: usize,
    },
    /// More in all than can be worked on.
    #[error("{people} people in {moments} frames are more than {most} places")]
    TooLong {
        /// People of all crowds.
        people: usize,
        /// Frames.
        moments: usize,
        /// The most places allowed.
        most: usize,
    },
    /// Crowds within crowds without end.
    #[error("{key}: small crowds stand {DEEPEST} deep in each other at most")]
    TooDeep {
        /// The crowd.
        key: String,
    },
}

impl RequestError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            RequestError::Value { hint, .. } => hint.clone(),
            RequestError::File { .. } => {
                Some("a formation is a text of points, `x y` in metres, or a picture of dots".to_string())
            }
            RequestError::Line { .. } => Some("write a line for each person, as `2.5 -1`".to_string()),
            RequestError::Count { people, places, .. } => Some(if people > places {
                "draw as many as there are people, take fewer with `choose` or `people`, or fill a shape with `filled = true`"
                    .to_string()
            } else {
                "draw as many as there are people, or fill a shape with `filled = true`".to_string()
            }),
            RequestError::HowMany { .. } => Some("write `people`, or `rows` and `columns`".to_string()),
            RequestError::NoSuchPerson { .. } => Some("people are counted from 0 on".to_string()),
            RequestError::TooMany { .. } => Some("make crowds of crowds with [[formation.crowd]]".to_string()),
            RequestError::TooLong { .. } => Some("make it shorter, with fewer people or frames per second".to_string()),
            RequestError::TooDeep { .. } => None,
        }
    }
}
