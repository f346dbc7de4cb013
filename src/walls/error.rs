/// Fewest points of an outline.
pub(super) const FEWEST_POINTS: usize = 3;
/// Largest distance that outlines reach over along x or y, metres: a plan's longest side with its walls and aprons.
pub(super) const LARGEST_EXTENT_M: f64 = crate::plan::LARGEST_SIDE_M + 500.0;
/// Longest length of all outlines together, metres.
pub(super) const LONGEST_M: f64 = 2e7;

/// Why the `walls` stage cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WallsError {
    /// An outline without an area.
    #[error("outline {outline} has {points} points, allowed are {} or more", FEWEST_POINTS)]
    TooFewPoints {
        /// Index of the outline.
        outline: usize,
        /// How many points it has.
        points: usize,
    },
    /// An opening at an edge that the outline does not have, or out of order.
    #[error("outline {outline} has an opening at edge {edge}, allowed are ascending edges below {points}")]
    Opening {
        /// Index of the outline.
        outline: usize,
        /// The edge.
        edge: usize,
        /// How many edges the outline has.
        points: usize,
    },
    /// Outlines that reach farther than a plan.
    #[error("the outlines reach over {extent_m} m, allowed are up to {} m", LARGEST_EXTENT_M)]
    TooFar {
        /// The largest distance along x or y, metres; NaN where a coordinate is.
        extent_m: f64,
    },
    /// More wall than a plan can have.
    #[error("the outlines are {length_m:.0} m long together, allowed are up to {} m", LONGEST_M)]
    TooLong {
        /// Their length, metres.
        length_m: f64,
    },
}

impl WallsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        Some("bake again".to_string())
    }

    /// The outline that it is about, where it is one.
    pub(crate) fn outline(&self) -> Option<usize> {
        match self {
            WallsError::TooFewPoints { outline, .. } | WallsError::Opening { outline, .. } => Some(*outline),
            WallsError::TooFar { .. } | WallsError::TooLong { .. } => None,
        }
    }

    /// The value that is wrong.
    pub(crate) fn value(&self) -> String {
        match self {
            WallsError::TooFewPoints { points, .. } => format!("a loop of {points} points"),
            WallsError::Opening { edge, .. } => format!("open at edge {edge}"),
            WallsError::TooFar { extent_m } => format!("{extent_m} m large"),
            WallsError::TooLong { length_m } => format!("{length_m:.0} m long"),
        }
    }

    /// What is allowed in its place.
    pub(crate) fn allowed(&self) -> String {
        match self {
            WallsError::TooFewPoints { .. } => format!("{} points or more", FEWEST_POINTS),
            WallsError::Opening { points, .. } => format!("ascending edges below {points}"),
            WallsError::TooFar { .. } => format!("up to {} m", LARGEST_EXTENT_M),
            WallsError::TooLong { .. } => format!("up to {} m", LONGEST_M),
        }
    }
}
