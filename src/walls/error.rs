/// Fewest points of an outline.
pub(super) const FEWEST_POINTS: usize = 3;
/// Largest extent of outlines along x or y, metres: the longest plan side with walls and aprons.
pub(super) const LARGEST_EXTENT_M: f64 = crate::plan::LARGEST_SIDE_M + 500.0;
/// Largest height of furniture, metres.
pub(super) const HIGHEST_FURNITURE_M: f64 = 100.0;
/// Largest total length of all outlines, metres.
pub(super) const LONGEST_M: f64 = 2e7;

/// Errors of the `walls` stage.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WallsError {
    /// An outline has too few points to enclose an area.
    #[error("outline {outline} has {points} points, allowed are {} or more", FEWEST_POINTS)]
    TooFewPoints {
        /// Index of the outline.
        outline: usize,
        /// Number of points.
        points: usize,
    },
    /// An opening's edge index is out of range or out of order.
    #[error("outline {outline} has an opening at edge {edge}, allowed are ascending edges below {points}")]
    Opening {
        /// Index of the outline.
        outline: usize,
        /// Index of the edge.
        edge: usize,
        /// Number of edges of the outline.
        points: usize,
    },
    /// Furniture without a height.
    #[error("outline {outline} is furniture of {height_m} m, allowed is more than 0, up to {HIGHEST_FURNITURE_M} m")]
    Furniture {
        /// Index of the outline.
        outline: usize,
        /// Height, metres.
        height_m: f64,
    },
    /// The outlines' extent exceeds that of any plan.
    #[error("the outlines reach over {extent_m} m, allowed are up to {} m", LARGEST_EXTENT_M)]
    TooFar {
        /// The largest distance along x or y, metres; NaN where a coordinate is.
        extent_m: f64,
    },
    /// The outlines' total length exceeds that of any plan.
    #[error("the outlines are {length_m:.0} m long together, allowed are up to {} m", LONGEST_M)]
    TooLong {
        /// Total length, metres.
        length_m: f64,
    },
}

impl WallsError {
    /// Returns the remedy, for the user.
    pub fn hint(&self) -> Option<String> {
        Some("bake again".to_string())
    }

    /// Index of the outline at fault, if the error is about one.
    pub(crate) fn outline(&self) -> Option<usize> {
        match self {
            WallsError::TooFewPoints { outline, .. }
            | WallsError::Opening { outline, .. }
            | WallsError::Furniture { outline, .. } => Some(*outline),
            WallsError::TooFar { .. } | WallsError::TooLong { .. } => None,
        }
    }

    /// The value that is out of range.
    pub(crate) fn value(&self) -> String {
        match self {
            WallsError::TooFewPoints { points, .. } => format!("a loop of {points} points"),
            WallsError::Opening { edge, .. } => format!("open at edge {edge}"),
            WallsError::Furniture { height_m, .. } => format!("furniture of {height_m} m"),
            WallsError::TooFar { extent_m } => format!("{extent_m} m large"),
            WallsError::TooLong { length_m } => format!("{length_m:.0} m long"),
        }
    }

    /// The allowed range.
    pub(crate) fn allowed(&self) -> String {
        match self {
            WallsError::TooFewPoints { .. } => format!("{} points or more", FEWEST_POINTS),
            WallsError::Opening { points, .. } => format!("ascending edges below {points}"),
            WallsError::Furniture { .. } => format!("more than 0, up to {HIGHEST_FURNITURE_M} m"),
            WallsError::TooFar { .. } => format!("up to {} m", LARGEST_EXTENT_M),
            WallsError::TooLong { .. } => format!("up to {} m", LONGEST_M),
        }
    }
}
