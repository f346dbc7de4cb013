use std::path::PathBuf;

use super::MOST_PEOPLE;

/// An invalid formation request.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// An option is not allowed.
    #[error(transparent)]
    Option(#[from] crate::options::OptionError),
    /// An unusable file of positions.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The problem.
        problem: String,
    },
    /// An invalid line of a file of points.
    #[error("{}, line {line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// The problem.
        problem: String,
    },
    /// A formation whose number of positions differs from the number of people.
    #[error("{key}: there are {people} people, but {places} {what}")]
    Count {
        /// Key of the key formation.
        key: String,
        /// Number of people in the example.
        people: usize,
        /// Number of positions in the formation.
        places: usize,
        /// Description of the positions: "points", "dots in dots.png".
        what: String,
    },
    /// An example without a number of people.
    #[error("{key}: the number of people is missing")]
    HowMany {
        /// Key of the example.
        key: String,
    },
    /// A chosen person who is not in the example.
    #[error("{key}: there is no person {person} in the example: it has {people}, from 0 to {last}", last = people.saturating_sub(1))]
    NoSuchPerson {
        /// Key that names the person.
        key: String,
        /// Index of the person.
        person: u32,
        /// Number of people.
        people: usize,
    },
    /// Too many people, or none, in one crowd.
    #[error(
        "{key}: {people} people, allowed are 1 to {MOST_PEOPLE} in one crowd; small crowds within may have as many each"
    )]
    TooMany {
        /// Key of the example.
        key: String,
        /// Number of people.
        people: usize,
    },
    /// More positions than can be held.
    #[error("{people} people in {moments} frames are more than {most} positions")]
    TooLong {
        /// Number of people of all crowds.
        people: usize,
        /// Number of frames.
        moments: usize,
        /// Largest number of positions.
        most: usize,
    },
}

impl RequestError {
    /// A remedy that the user can try.
    pub fn hint(&self) -> Option<String> {
        match self {
            RequestError::Option(error) => error.hint(),
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
        }
    }
}
