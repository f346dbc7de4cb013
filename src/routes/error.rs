use crate::math::Vec2;

/// Why the `routes` stage cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RoutesError {
    /// A name that no opening bears.
    #[error("route \"{route}\": the plan has no opening called \"{name}\"{}", list(.openings))]
    UnknownOpening {
        /// The route that asks for it.
        route: String,
        /// What was asked for.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
        /// All names.
        openings: Vec<String>,
    },
    /// A point or an area without a place to stand.
    #[error("route \"{route}\": {role} {place} is not on floor{}", nearest_floor(.nearest_m))]
    NotOnFloor {
        /// The route that asks for it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// The place as asked for.
        place: String,
        /// The nearest place to stand, metres.
        nearest_m: Option<Vec2>,
    },
    /// A coordinate that is no number.
    #[error("route \"{route}\": {role} {place} holds a coordinate that is not a finite number")]
    NotFinite {
        /// The route that asks for it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// The place as asked for.
        place: String,
    },
    /// No way between two places of a route.
    #[error(
        "route \"{route}\": no way leads from {from} (in a part of the floor of {from_area_m2:.1} m2) to {to} (in a part \
         of {to_area_m2:.1} m2)"
    )]
    Unreachable {
        /// The route.
        route: String,
        /// Where the way begins.
        from: String,
        /// Area that can be reached from there, square metres.
        from_area_m2: f64,
        /// Where it should lead.
        to: String,
        /// Area that can be reached from there, square metres.
        to_area_m2: f64,
    },
    /// Start and goal coincide, and there is nothing between.
    #[error("route \"{route}\": it ends where it begins, at {place}")]
    NoLength {
        /// The route.
        route: String,
        /// Start and goal.
        place: String,
    },
    /// A share that is negative or no number.
    #[error("route \"{route}\": the share {share} is not a number of 0 or more")]
    Share {
        /// The route.
        route: String,
        /// What was asked for.
        share: f64,
    },
    /// Nobody takes any route.
    #[error("the shares of all {routes} routes are 0")]
    NoShares {
        /// How many routes there are.
        routes: usize,
    },
    /// More routes than can be kept.
    #[error("{routes} routes are asked for, at most {most} are possible")]
    TooMany {
        /// How many routes are asked for.
        routes: usize,
        /// The limit.
        most: usize,
    },
    /// No floor to walk on.
    #[error("the plan has no floor that is large enough to walk on: the largest part has {largest_m2:.2} m2")]
    NoRoom {
        /// Area of the largest part of the floor where a body has room, square metres.
        largest_m2: f64,
    },
}

impl RoutesError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            RoutesError::UnknownOpening { nearest: Some(nearest), .. } => Some(format!("did you mean \"{nearest}\"?")),
            RoutesError::UnknownOpening { .. } => {
                Some("`trodden inspect PLAN` lists and draws the openings; a point or an area works without one".into())
            }
            RoutesError::NotOnFloor { nearest_m: Some(p), .. } => Some(format!("use [{:.2}, {:.2}]", p.x, p.y)),
            RoutesError::NotOnFloor { .. } | RoutesError::NotFinite { .. } => {
                Some("points are metres from the plan's lower-left corner, or { px = [x, y] } from the top left".into())
            }
            RoutesError::Unreachable { .. } => Some(
                "passages narrower than 0.4 m are closed; `trodden inspect PLAN` draws what was taken for wall and floor"
                    .into(),
            ),
            RoutesError::NoRoom { .. } => {
                Some("check the scale (metres per pixel) and the threshold between wall and floor".into())
            }
            RoutesError::NoLength { .. } => Some("give another goal, or a place to pass with `via`".into()),
            RoutesError::Share { .. } | RoutesError::NoShares { .. } | RoutesError::TooMany { .. } => None,
        }
    }
}

fn list(openings: &[String]) -> String {
    match openings {
        [] => "; it has none at all".into(),
        names => format!("; it has {}", names.join(", ")),
    }
}

fn nearest_floor(nearest: &Option<Vec2>) -> String {
    nearest.map_or(String::new(), |p| format!("; the nearest floor is at [{:.2}, {:.2}]", p.x, p.y))
}
