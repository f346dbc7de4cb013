use crate::math::Vec2;
use crate::options::OptionError;
use crate::progress::Interrupted;

/// Errors of the routes stage.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RoutesError {
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// Unknown name of an opening.
    #[error("route \"{route}\": the plan has no opening called \"{name}\"{}", list(.openings))]
    UnknownOpening {
        /// The route that uses it.
        route: String,
        /// The unknown name.
        name: String,
        /// Most similar known name.
        nearest: Option<String>,
        /// All names.
        openings: Vec<String>,
    },
    /// A point or an area contains no walkable floor.
    #[error("route \"{route}\": {role} {place} (px [{:.0}, {:.0}]) is not on floor{}", at_px[0], at_px[1], nearest_floor(.nearest))]
    NotOnFloor {
        /// The route that uses it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// Place as requested.
        place: String,
        /// Point, or centre of the area, pixels from the top left of the image.
        at_px: [f64; 2],
        /// Nearest walkable position.
        nearest: Option<Box<FloorPoint>>,
    },
    /// A coordinate is outside the allowed range, or NaN.
    #[error(
        "route \"{route}\": {role} {place} holds the coordinate {value} m, allowed is -{most} to {most}",
        most = crate::plan::LARGEST_COORDINATE
    )]
    TooFar {
        /// The route that uses it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// Place as requested.
        place: String,
        /// The coordinate, metres.
        value: f64,
    },
    /// The scenario has no stop of this name.
    #[error("route \"{route}\": there is no stop called \"{name}\"")]
    UnknownStop {
        /// The route that uses it.
        route: String,
        /// The unknown name.
        name: String,
        /// Most similar known name.
        nearest: Option<String>,
    },
    /// Two stops have the same name.
    #[error("there are two stops called \"{name}\"")]
    SameStop {
        /// The name.
        name: String,
    },
    /// A value of a stop is out of range or does not fit the stop's kind.
    #[error("stop \"{stop}\": {problem}")]
    StopValue {
        /// The stop.
        stop: String,
        /// The key, as a scenario writes it.
        key: String,
        /// The problem.
        problem: String,
    },
    /// An invalid timetable.
    #[error("route \"{route}\": arrivals: {error}")]
    Timetable {
        /// The route.
        route: String,
        /// The key and the problem.
        error: OptionError,
    },
    /// A stop has no walkable floor.
    #[error(
        "stop \"{stop}\": {key}: there is no floor to stand on at [{:.2}, {:.2}]{}", .place_m.x, .place_m.y, nearest_place(.nearest_m)
    )]
    StopNotOnFloor {
        /// The stop.
        stop: String,
        /// `at` or `queue`.
        key: &'static str,
        /// Requested position, metres.
        place_m: Vec2,
        /// Nearest walkable position, metres.
        nearest_m: Option<Vec2>,
    },
    /// A stop is enclosed by walls.
    #[error("route \"{route}\": no way leads to the stop \"{stop}\" at [{:.2}, {:.2}]", .place_m.x, .place_m.y)]
    StopUnreachable {
        /// The route that uses it.
        route: String,
        /// The stop.
        stop: String,
        /// Position of the stop, metres.
        place_m: Vec2,
    },
    /// No path joins two places of a route.
    #[error("route \"{route}\": no way leads from {from} to {to}{}", narrow(.gap))]
    Unreachable {
        /// The route.
        route: String,
        /// Start of the missing path.
        from: Box<FloorPoint>,
        /// End of the missing path.
        to: Box<FloorPoint>,
        /// Narrowest point of the widest path between them, if it is merely too narrow.
        gap: Option<Gap>,
    },
    /// Start and goal coincide and there are no via places.
    #[error("route \"{route}\": it ends where it begins, at {place}")]
    NoLength {
        /// The route.
        route: String,
        /// Start and goal.
        place: String,
    },
    /// A share is negative or not finite.
    #[error("route \"{route}\": the share {share} is not a number of 0 or more")]
    Share {
        /// The route.
        route: String,
        /// The requested share.
        share: f64,
    },
    /// The shares of all routes are 0.
    #[error("the shares of all {routes} routes are 0")]
    NoShares {
        /// Number of routes.
        routes: usize,
    },
    /// There are too many routes.
    #[error("{routes} routes are requested, at most {most} are possible")]
    TooMany {
        /// Number of routes requested.
        routes: usize,
        /// Largest allowed number.
        most: usize,
    },
    /// A request names no room of the plan.
    #[error("[[room]]: {problem}{}", how_many(.rooms))]
    UnknownRoom {
        /// The problem.
        problem: String,
        /// Most similar known name.
        nearest: Option<String>,
        /// Number of rooms.
        rooms: usize,
    },
    /// The plan has no part of floor that is large enough.
    #[error("the plan has no floor that is large enough to walk on: the largest part has {largest_m2:.2} m2")]
    NoRoom {
        /// Area of the largest walkable part of the floor, square metres.
        largest_m2: f64,
    },
}

/// A position on the floor, for messages.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorPoint {
    /// Name of the place; may be empty.
    pub name: String,
    /// Position, metres.
    pub at_m: Vec2,
    /// Position in the image, pixels from the top left.
    pub at_px: [f64; 2],
    /// Area of the floor reachable from there, square metres.
    pub part_m2: f64,
}

impl std::fmt::Display for FloorPoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let FloorPoint { name, at_m, at_px, part_m2 } = self;
        if !name.is_empty() {
            write!(f, "{name}, ")?;
        }
        write!(f, "[{:.2}, {:.2}] (px [{:.0}, {:.0}]), ", at_m.x, at_m.y, at_px[0], at_px[1])?;
        write!(f, "in a part of the floor of {part_m2:.1} m2")
    }
}

/// A point of a path that is too narrow to pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Position, metres.
    pub at_m: Vec2,
    /// Position in the image, pixels from the top left.
    pub at_px: [f64; 2],
    /// Approximate width, metres.
    pub width_m: f64,
}

impl RoutesError {
    /// Returns the remedy, for the user; `None` if there is none.
    pub fn hint(&self) -> Option<String> {
        match self {
            RoutesError::UnknownOpening { nearest: Some(nearest), .. }
            | RoutesError::UnknownRoom { nearest: Some(nearest), .. }
            | RoutesError::UnknownStop { nearest: Some(nearest), .. } => Some(format!("did you mean \"{nearest}\"?")),
            RoutesError::UnknownOpening { .. } => {
                Some("`trodden inspect PLAN` lists and draws the openings; a point or an area works without one".into())
            }
            RoutesError::UnknownStop { .. } => Some("each [[stop]] has a `name`; routes name it in `via`".into()),
            RoutesError::UnknownRoom { .. } => Some("`trodden inspect PLAN` lists the rooms; `at` takes a point in one".into()),
            RoutesError::SameStop { .. } => Some("give each [[stop]] a name of its own".into()),
            RoutesError::StopNotOnFloor { nearest_m: Some(p), .. } => Some(format!("use [{:.2}, {:.2}]", p.x, p.y)),
            RoutesError::NotOnFloor { nearest: Some(spot), .. } => {
                Some(format!("use [{:.2}, {:.2}], or px = [{:.0}, {:.0}]", spot.at_m.x, spot.at_m.y, spot.at_px[0], spot.at_px[1]))
            }
            RoutesError::NotOnFloor { .. } | RoutesError::TooFar { .. } | RoutesError::StopNotOnFloor { .. } => {
                Some("points are metres from the plan's lower-left corner, or { px = [x, y] } from the top left".into())
            }
            RoutesError::StopUnreachable { .. } => {
                Some("`trodden inspect PLAN` draws what was taken for wall and floor; open a door to it".into())
            }
            RoutesError::Unreachable { gap: Some(_), .. } => Some(
                "widen it in the image to 0.5 m or more, or check the scale (metres per pixel): no person fits through less \
                  than 0.4 m"
                    .into(),
            ),
            RoutesError::Unreachable { .. } => {
                Some("`trodden inspect PLAN` draws what was taken for wall and floor; open a door between the two".into())
            }
            RoutesError::NoRoom { .. } => {
                Some("check the scale (metres per pixel) and the threshold between wall and floor".into())
            }
            RoutesError::NoLength { .. } => Some("give another goal, or a place to pass with `via`".into()),
            RoutesError::Share { .. } | RoutesError::NoShares { .. } | RoutesError::TooMany { .. } => None,
            RoutesError::StopValue { .. } | RoutesError::Timetable { .. } | RoutesError::Interrupted(_) => None,
        }
    }
}

fn list(openings: &[String]) -> String {
    match openings {
        [] => "; it has none at all".into(),
        names => format!("; it has {}", names.join(", ")),
    }
}

fn how_many(count: &usize) -> String {
    let plural = if *count == 1 { "" } else { "s" };
    format!("; the plan has {count} room{plural}")
}

/// Nearest walkable position, for messages.
fn nearest_place(nearest_m: &Option<Vec2>) -> String {
    nearest_m.map_or_else(String::new, |p| format!("; the nearest floor is at [{:.2}, {:.2}]", p.x, p.y))
}

fn nearest_floor(nearest: &Option<Box<FloorPoint>>) -> String {
    nearest.as_ref().map_or(String::new(), |spot| format!("; the nearest floor is at {spot}"))
}

fn narrow(gap: &Option<Gap>) -> String {
    gap.map_or(String::new(), |Gap { at_m, at_px, width_m }| {
        let (x, y, px) = (at_m.x, at_m.y, at_px);
        format!("; the way is only about {width_m:.1} m wide at [{x:.2}, {y:.2}] (px [{:.0}, {:.0}])", px[0], px[1])
    })
}
