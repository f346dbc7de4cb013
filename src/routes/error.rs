use crate::math::Vec2;
use crate::options::OptionError;

/// Errors of the routes stage.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RoutesError {
    /// The user stopped the work.
    #[error("interrupted")]
    Interrupted,
    /// Unknown name of an opening.
    #[error("route \"{route}\": the plan has no opening called \"{name}\"{}", list(.openings))]
    UnknownOpening {
        /// The route that uses it.
        route: String,
        /// The unknown name.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
        /// All names.
        openings: Vec<String>,
    },
    /// A point or an area without a place to stand.
    #[error("route \"{route}\": {role} {place} (px [{:.0}, {:.0}]) is not on floor{}", at_px[0], at_px[1], nearest_floor(.nearest))]
    NotOnFloor {
        /// The route that uses it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// The requested place.
        place: String,
        /// The place, or the middle of the area, in the image, pixels from the top left.
        at_px: [f64; 2],
        /// The nearest place to stand.
        nearest: Option<Box<FloorPoint>>,
    },
    /// A coordinate far beyond any plan, or not a number.
    #[error(
        "route \"{route}\": {role} {place} holds the coordinate {value} m, allowed is -{most} to {most}",
        most = crate::plan::LARGEST_COORDINATE
    )]
    TooFar {
        /// The route that uses it.
        route: String,
        /// `from`, `to` or `via`.
        role: &'static str,
        /// The requested place.
        place: String,
        /// The coordinate, metres.
        value: f64,
    },
    /// Unknown name of a stop.
    #[error("route \"{route}\": there is no stop called \"{name}\"")]
    UnknownStop {
        /// The route that uses it.
        route: String,
        /// The unknown name.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
    },
    /// Two stops of one name.
    #[error("there are two stops called \"{name}\"")]
    SameStop {
        /// The name.
        name: String,
    },
    /// A value of a stop that is out of range, or does not fit its plan.
    #[error("stop \"{stop}\": {key}: {problem}")]
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
    /// A stop without a place to stand.
    #[error(
        "stop \"{stop}\": {key}: there is no floor to stand on at [{:.2}, {:.2}]{}", .place_m.x, .place_m.y, nearest_place(.nearest_m)
    )]
    StopNotOnFloor {
        /// The stop.
        stop: String,
        /// `at` or `queue`.
        key: &'static str,
        /// Where, metres.
        place_m: Vec2,
        /// The nearest place to stand, metres.
        nearest_m: Option<Vec2>,
    },
    /// A stop that walls enclose.
    #[error("route \"{route}\": no way leads to the stop \"{stop}\" at [{:.2}, {:.2}]", .place_m.x, .place_m.y)]
    StopUnreachable {
        /// The route that uses it.
        route: String,
        /// The stop.
        stop: String,
        /// Where, metres.
        place_m: Vec2,
    },
    /// No way between two places of a route.
    #[error("route \"{route}\": no way leads from {from} to {to}{}", narrow(.gap))]
    Unreachable {
        /// The route.
        route: String,
        /// Where the way begins.
        from: Box<FloorPoint>,
        /// Where it should lead.
        to: Box<FloorPoint>,
        /// The narrowest place of the widest way between them, if only that is in the way.
        gap: Option<Gap>,
    },
    /// Start and goal coincide, and there is nothing between.
    #[error("route \"{route}\": it ends where it begins, at {place}")]
    NoLength {
        /// The route.
        route: String,
        /// Start and goal.
        place: String,
    },
    /// A share that is negative or not finite.
    #[error("route \"{route}\": the share {share} is not a number of 0 or more")]
    Share {
        /// The route.
        route: String,
        /// The requested share.
        share: f64,
    },
    /// All shares are 0.
    #[error("the shares of all {routes} routes are 0")]
    NoShares {
        /// Number of routes.
        routes: usize,
    },
    /// Too many routes.
    #[error("{routes} routes are requested, at most {most} are possible")]
    TooMany {
        /// Number of routes requested.
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

/// A place on the floor, for messages.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorPoint {
    /// Name of the place; may be empty.
    pub name: String,
    /// Where it is, metres.
    pub at_m: Vec2,
    /// Where it is in the image, pixels from the top left.
    pub at_px: [f64; 2],
    /// Area of the part of the floor that can be walked to from there, square metres.
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

/// A place that is too narrow to pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Where it is, metres.
    pub at_m: Vec2,
    /// Where it is in the image, pixels from the top left.
    pub at_px: [f64; 2],
    /// Approximate width, metres.
    pub width_m: f64,
}

impl RoutesError {
    /// A remedy in words, if there is one.
    pub fn hint(&self) -> Option<String> {
        match self {
            RoutesError::UnknownOpening { nearest: Some(nearest), .. }
            | RoutesError::UnknownStop { nearest: Some(nearest), .. } => Some(format!("did you mean \"{nearest}\"?")),
            RoutesError::UnknownOpening { .. } => {
                Some("`trodden inspect PLAN` lists and draws the openings; a point or an area works without one".into())
            }
            RoutesError::UnknownStop { .. } => Some("each [[stop]] has a `name`; routes name it in `via`".into()),
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
            RoutesError::StopValue { .. } | RoutesError::Timetable { .. } | RoutesError::Interrupted => None,
        }
    }
}

fn list(openings: &[String]) -> String {
    match openings {
        [] => "; it has none at all".into(),
        names => format!("; it has {}", names.join(", ")),
    }
}

/// The place to stand instead, for messages.
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
