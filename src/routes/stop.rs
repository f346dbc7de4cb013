//! Stops on a route: as written in a scenario, and as found on the ground.

use serde::{Deserialize, Serialize};

use super::field::Field;
use super::ground::Ground;
use super::{Place, RoutesError};
use crate::math::{Distribution, Rect, Vec2, sin_cos, vec2};
use crate::options::{Kind, Leaf, OptionError, Options, Value, names, options};
use crate::plan::{FloorPlan, LARGEST_COORDINATE, PlanPoint};
use crate::rooms::Spot;
use crate::walls::Walls;

/// Largest distance of a standing place from the requested one, metres: counters are at walls.
const NEAREST_FLOOR_M: f64 = 0.6;
/// Distance between places at a counter given by its centre, metres.
const PLACES_APART_M: f64 = 0.9;
/// Radius of the search for counters, benches and pictures, metres.
const WALL_REACH_M: f64 = 4.0;
/// Distance in front of a stop at which routes to it alone pass, metres.
const BEFORE_M: f64 = 1.5;

/// Most places at one stop.
const MOST_PLACES: u32 = 1000;

/// Kind of a stop, by activity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StopKind {
    /// Stand, for example before a board, painting or shop window.
    #[default]
    Place,
    /// Queue in one line before a counter with one or more places.
    Queue,
    /// Like `queue`, before a machine, with a shorter dwell time.
    Machine,
    /// Sit down.
    Bench,
    /// Pass ticket gates one by one, with a line per gate.
    Gate,
}

options! {
    /// A stop as a scenario writes it. Lengths in metres.
    pub struct StopRequest {
        /// What routes call it in `via`.
        name: String = String::new(), eg "\"ticket office\"", required true;
        /// "place" to stand at, "queue" before a counter, "machine", "bench", or ticket "gate".
        kind: StopKind = StopKind::default(), eg "\"queue\"";
        /// Where people stand: a point, or a line [[x0, y0], [x1, y1]] of places; of a "place" two corners.
        at: StopAt = StopAt::Point(PlanPoint::Metres([0.0; 2])), eg "[12.0, 4.5]", required true;
        /// A point that they face; left out: the nearest wall, from a bench away from it.
        facing: Option<PlanPoint> = None, eg "[12.0, 3.0]";
        /// Or the direction that they face.
        heading_deg: Option<f64> = None, in -360.0..=360.0, unit "degrees from +x", eg "-90.0";
        /// How long one stays or is served; left out: by the kind.
        dwell: Option<Distribution> = None, in 0.0..=86400.0, unit "s", eg "{ mean = 30, sd = 15, min = 5, max = 120 }";
        /// Counters, seats or lanes side by side.
        places: Option<u32> = None, in 1.0..=1000.0, eg "2";
        /// From one to the next in the line, on the bench, or around a place.
        spacing: Option<f64> = None, in 0.4..=5.0, unit "m", eg "0.75";
        /// How far around the point of a "place" people stand.
        reach: Option<f64> = None, in 0.3..=50.0, unit "m", eg "1.5";
        /// The line in which people queue, from the counter on; left out: straight back, along walls.
        queue: Vec<PlanPoint> = Vec::new(), eg "[[12.0, 5.5], [12.0, 11.0]]";
    }
}

/// Position of a stop in a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a point [x, y], or two of them: [[x0, y0], [x1, y1]]")]
pub enum StopAt {
    /// A point.
    Point(PlanPoint),
    /// Both ends of a line, or two corners of an area.
    Line([PlanPoint; 2]),
}

/// Heading of people at a stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Facing {
    /// A random heading per person.
    Free,
    /// Towards this point, metres.
    Point(Vec2),
    /// This heading, as a unit vector.
    Direction(Vec2),
}

/// A stop on the ground, metres and seconds. Routes that share it hold equal values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// Name, unique in the plan.
    pub name: String,
    /// Kind of the stop.
    pub kind: StopKind,
    /// Ends of the line of places, or two corners of the area; twice the same point for a point.
    pub at_m: [Vec2; 2],
    /// Positions where people stand, sit or are served; for kind `place` only the centre.
    pub places_m: Vec<Vec2>,
    /// Heading of people.
    pub facing: Facing,
    /// Dwell time of a person, seconds.
    pub dwell_s: Distribution,
    /// Distance between people, metres.
    pub spacing_m: f64,
    /// Radius around a `place` given as a point, metres.
    pub reach_m: f64,
    /// Line of the queue, from the counter on; empty: found automatically.
    pub queue_m: Vec<Vec2>,
    /// Spots of a room in which people stay, by default life.
    #[serde(skip)]
    pub spots: Vec<Spot>,
}

/// A stop on a route.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteStop {
    /// The stop.
    pub stop: Stop,
    /// Share of the route's people who stop there, 0 to 1.
    pub share: f64,
    /// Number of via places that the route passes before.
    pub after_via: usize,
}

impl Leaf for StopAt {
    fn takes() -> Kind {
        let line = Kind::List(Box::new(PlanPoint::kind()), Some(2));
        Kind::AnyOf("a point [x, y], or two of them: [[x0, y0], [x1, y1]]", vec![PlanPoint::kind(), line])
    }
}

names!(StopKind);

impl StopKind {
    /// Default dwell time, seconds.
    fn dwell_s(self) -> Distribution {
        match self {
            StopKind::Place => Distribution::normal(20.0, 10.0, 5.0, 60.0),
            StopKind::Queue => Distribution::normal(40.0, 20.0, 8.0, 150.0),
            StopKind::Machine => Distribution::normal(25.0, 10.0, 8.0, 80.0),
            StopKind::Bench => Distribution::normal(180.0, 90.0, 30.0, 600.0),
            StopKind::Gate => Distribution::normal(1.8, 0.5, 1.0, 4.0),
        }
    }

    /// Default distance between people, metres.
    fn spacing_m(self) -> f64 {
        match self {
            StopKind::Place => 0.8,
            StopKind::Bench => 0.6,
            StopKind::Queue | StopKind::Machine | StopKind::Gate => 0.75,
        }
    }

    /// Whether people queue at this kind of stop.
    pub(crate) fn has_line(self) -> bool {
        matches!(self, StopKind::Queue | StopKind::Machine | StopKind::Gate)
    }
}

impl StopRequest {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not finite, out of its range, or does not go with the kind.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_ranges()?;
        let has_own_line = self.kind.has_line() && self.kind != StopKind::Gate;
        let problems = [
            (self.name.trim().is_empty(), "name", "the name is empty"),
            (
                self.facing.is_some() && self.heading_deg.is_some(),
                "heading_deg",
                "the stop has both `facing` and `heading_deg`",
            ),
            (
                !self.queue.is_empty() && !has_own_line,
                "queue",
                "only stops of the kinds \"queue\" and \"machine\" have a line of their own",
            ),
            (
                self.kind == StopKind::Place && self.places.is_some(),
                "places",
                "a stop of the kind \"place\" has room for as many as find it",
            ),
        ];
        match problems.into_iter().find(|(wrong, ..)| *wrong) {
            Some((_, key, problem)) => Err(OptionError::unfit(key, problem)),
            None => Ok(()),
        }
    }

    /// Finds the stop on the ground.
    pub(super) fn resolve(&self, plan: &FloorPlan, ground: &Ground, walls: &Walls) -> Result<Stop, RoutesError> {
        let wrong = |(key, problem): (&str, String)| {
            let key = key.to_string();
            RoutesError::StopValue { stop: self.name.clone(), key, problem }
        };
        self.check().map_err(|error| wrong((error.key(), error.problem())))?;
        let finite = |key, point: PlanPoint| {
            let p = point.to_m(plan);
            // NaN must be out of range.
            let beyond = [p.x, p.y].into_iter().find(|c| c.is_nan() || c.abs() > LARGEST_COORDINATE);
            match beyond {
                None => Ok(p),
                Some(c) => {
                    let most = LARGEST_COORDINATE;
                    Err(wrong((key, format!("`{key}`: a coordinate is {c} m, allowed is -{most} to {most}"))))
                }
            }
        };
        let at_m = match self.at {
            StopAt::Point(point) => [finite("at", point)?; 2],
            StopAt::Line([from, to]) => [finite("at", from)?, finite("at", to)?],
        };
        let facing = match (self.facing, self.heading_deg) {
            (Some(point), _) => Facing::Point(finite("facing", point)?),
            (None, Some(degrees)) => {
                let (sin, cos) = sin_cos(degrees.to_radians());
                Facing::Direction(vec2(cos, sin))
            }
            (None, None) => self.usual_facing(walls, at_m),
        };
        let queue_m =
            self.queue.iter().map(|&point| finite("queue", point)).collect::<Result<Vec<_>, RoutesError>>()?;
        for &p in &queue_m {
            ground.walkable_near(p, NEAREST_FLOOR_M).ok_or_else(|| self.not_on_floor(ground, "queue", p))?;
        }
        if let Some(pair) = queue_m.windows(2).find(|pair| !ground.sight(walls, pair[0], pair[1])) {
            let problem = format!(
                "`queue`: the line crosses a wall between [{:.2}, {:.2}] and [{:.2}, {:.2}]",
                pair[0].x, pair[0].y, pair[1].x, pair[1].y
            );
            return Err(wrong(("queue", problem)));
        }
        let mut stop = Stop {
            name: self.name.clone(),
            kind: self.kind,
            at_m,
            places_m: Vec::new(),
            facing,
            dwell_s: self.dwell.unwrap_or(self.kind.dwell_s()),
            spacing_m: self.spacing.unwrap_or(self.kind.spacing_m()),
            reach_m: self.reach.unwrap_or(1.5),
            queue_m,
            spots: Vec::new(),
        };
        stop.places_m = self.places_m(&stop);
        for &p in &stop.places_m {
            let area = Rect::around(at_m[0], at_m[1]);
            let near_m = if self.kind == StopKind::Place { 0.5 * area.width().max(area.height()) } else { 0.0 };
            let found = ground.walkable_near(p, near_m + NEAREST_FLOOR_M);
            found.ok_or_else(|| self.not_on_floor(ground, "at", p))?;
        }
        Ok(stop)
    }

    /// Default heading: towards the counter, or away from the wall behind a bench. Gates are turned later.
    fn usual_facing(&self, walls: &Walls, [from, to]: [Vec2; 2]) -> Facing {
        let middle = from.lerp(to, 0.5);
        let towards_wall =
            walls.nearest(middle, WALL_REACH_M).and_then(|nearest| (nearest.point_m - middle).normalized());
        // A line of places is parallel to its counter.
        let square = match (towards_wall, (to - from).normalized()) {
            (Some(wall), Some(along)) if along.left().dot(wall) < 0.0 => Some(-along.left()),
            (_, Some(along)) => Some(along.left()),
            (wall, None) => wall,
        };
        match (self.kind, square) {
            (StopKind::Place | StopKind::Gate, _) => Facing::Free,
            (StopKind::Bench, Some(wall)) => Facing::Direction(-wall),
            (_, Some(wall)) => Facing::Direction(wall),
            (_, None) => Facing::Direction(vec2(0.0, 1.0)),
        }
    }

    fn places_m(&self, stop: &Stop) -> Vec<Vec2> {
        let [from, to] = stop.at_m;
        let middle = from.lerp(to, 0.5);
        if self.kind == StopKind::Place {
            return vec![middle];
        }
        let length = from.distance(to);
        let fit = (length / stop.spacing_m + 1e-9) as u32 + 1;
        let count = self.places.unwrap_or(if self.kind == StopKind::Bench { fit.min(MOST_PLACES) } else { 1 });
        if count == 1 {
            return vec![middle];
        }
        let ends = if length > 0.0 {
            [from, to]
        } else {
            let apart = if self.kind == StopKind::Bench { stop.spacing_m } else { PLACES_APART_M };
            let reach = stop.facing_from(middle).left() * (0.5 * apart * f64::from(count - 1));
            [middle + reach, middle - reach]
        };
        (0..count).map(|k| ends[0].lerp(ends[1], f64::from(k) / f64::from(count - 1))).collect()
    }

    fn not_on_floor(&self, ground: &Ground, key: &'static str, p: Vec2) -> RoutesError {
        let nearest_m = (0..ground.lattice.len())
            .filter(|&c| ground.is_walkable(c))
            .map(|c| ground.lattice.centre(c))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)));
        RoutesError::StopNotOnFloor { stop: self.name.clone(), key, place_m: p, nearest_m }
    }
}

impl Stop {
    /// Unit vector of the heading of a person at `p`; +y if free.
    pub(crate) fn facing_from(&self, p: Vec2) -> Vec2 {
        let otherwise = vec2(0.0, 1.0);
        match self.facing {
            Facing::Free => otherwise,
            Facing::Point(point) => (point - p).normalized().unwrap_or(otherwise),
            Facing::Direction(direction) => direction,
        }
    }

    /// Walkable cells at the stop, for path finding.
    pub(crate) fn cells(&self, ground: &Ground) -> Vec<usize> {
        let area = Rect::around(self.at_m[0], self.at_m[1]);
        let reach_m =
            if self.kind == StopKind::Place { 0.5 * area.width().max(area.height()) } else { 0.0 } + NEAREST_FLOOR_M;
        let mut cells: Vec<usize> = self.places_m.iter().filter_map(|&p| ground.walkable_near(p, reach_m)).collect();
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    /// The area in front of the stop, which routes to it alone pass.
    pub(super) fn before(&self, ground: &Ground) -> Place {
        let middle = self.at_m[0].lerp(self.at_m[1], 0.5);
        let back = middle - self.facing_from(middle) * BEFORE_M;
        let has_room = ground.lattice.cell_at(back).is_some_and(|cell| ground.is_walkable(cell));
        let at = if has_room { back } else { middle };
        let reach = vec2(0.5, 0.5);
        Place::Area([at - reach, at + reach])
    }

    /// Turns ticket gates without a heading along the field.
    pub(super) fn turn_along(&mut self, ground: &Ground, onward: &Field) {
        if self.kind != StopKind::Gate || self.facing != Facing::Free {
            return;
        }
        let [from, to] = self.at_m;
        let middle = from.lerp(to, 0.5);
        let along = (to - from).normalized();
        let across = along.map(Vec2::left).or_else(|| onward.downhill(ground, middle)).unwrap_or(vec2(0.0, 1.0));
        let left_m = |sign: f64| {
            let beside = self.places_m.iter().map(|&p| onward.at(ground, p + across * (sign * 1.2)));
            beside.filter(|d| d.is_finite()).fold(f64::INFINITY, f64::min)
        };
        let back = along.is_some() && left_m(-1.0) < left_m(1.0);
        self.facing = Facing::Direction(if back { -across } else { across });
    }
}
