//! Places with contact rates of their own: doors, corners, fixtures.

use crate::marks::MarksError;
use crate::math::{Vec2, vec2};
use crate::plan::{FloorPlan, PlanDoor, PlanPoint};
use crate::routes::{Facing, Stop, StopKind};
use crate::walls::{Corner, Doorway, Nearest, Walls};

use super::requests::{DoorRequest, FixtureAt, FixtureKind, FixtureRequest};

/// Reach of contacts from the middle of the body, metres.
pub(super) const NEAR_M: f64 = 1.2;
/// Default height of a door handle, metres.
const HANDLE_M: f64 = 1.0;
/// Search radius for the wall of a fixture, metres.
const FIXTURE_REACH_M: f64 = 1.5;
/// Reach of a fixture from the middle of the body, metres.
const AT_FIXTURE_M: f64 = 1.05;
/// Distance before a fixture from which its wall is searched, metres.
const BEFORE_M: f64 = 0.2;
/// Search distance for the counter, machine or bench of a stop, metres.
const STOP_REACH_M: f64 = NEAR_M;
/// Step of that search, metres.
const AHEAD_STEP_M: f64 = 0.12;
/// Least turn of a convex corner, radians.
const LEAST_OUTER_RAD: f64 = 0.6;

/// A door: a doorway with its handle and name.
#[derive(Clone, Debug, PartialEq)]
pub struct Door {
    /// Name in the scenario.
    pub name: Option<String>,
    /// The doorway in the walls.
    pub doorway: Doorway,
    /// Index into [`Doorway::jambs_m`] of the jamb with the handle; `None` for either.
    pub latch: Option<usize>,
    /// Height of the handle, metres; `None` of an opening without a leaf.
    pub handle_m: Option<f64>,
    /// Per jamb: whether [`Doorway::through`] points along the face's growing arc length.
    pub(super) onward: [bool; 2],
}

/// A fixture on a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Name in the scenario.
    pub name: Option<String>,
    /// Kind of fixture.
    pub kind: FixtureKind,
    /// Index into [`Walls::faces`].
    pub face: usize,
    /// Arc length of its middle, metres.
    pub along_m: f64,
    /// Width along the wall, metres.
    pub width_m: f64,
    /// The middle on the wall, metres.
    pub point_m: Vec2,
    /// Reach from the wall to the middle of the body, metres.
    pub reach_m: f64,
}

/// The doors, corners and fixtures of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactPlaces {
    doors: Vec<Door>,
    corners: Vec<Corner>,
    fixtures: Vec<Fixture>,
}

impl ContactPlaces {
    /// Finds doorways and convex corners in the walls.
    pub fn of_walls(walls: &Walls) -> ContactPlaces {
        let doors = walls.doorways().into_iter().map(|doorway| door(walls, doorway)).collect();
        let corners = walls.corners().into_iter().filter(|corner| corner.turn_rad < -LEAST_OUTER_RAD).collect();
        ContactPlaces { doors, corners, fixtures: Vec::new() }
    }

    /// Adds the doors of a scenario; a request near a found doorway describes it.
    ///
    /// # Errors
    /// A value is out of range; a door is outside the floor or lacks two jambs.
    pub fn with_doors(
        mut self,
        plan: &FloorPlan,
        walls: &Walls,
        requests: &[DoorRequest],
    ) -> Result<ContactPlaces, MarksError> {
        for door in &mut self.doors {
            let middle = door.doorway.jambs_m[0].lerp(door.doorway.jambs_m[1], 0.5);
            let away_m = |drawn: &PlanDoor| drawn.from_m.lerp(drawn.to_m, 0.5).distance(middle);
            let drawn = plan.doors.iter().filter(|drawn| drawn.leaf_m.is_some());
            let nearest = drawn.min_by(|a, b| away_m(a).total_cmp(&away_m(b)));
            let same = nearest.filter(|drawn| away_m(drawn) < 0.4 * door.doorway.width_m());
            door.doorway.leaf_m = same.and_then(|drawn| drawn.leaf_m);
        }
        for (index, request) in requests.iter().enumerate() {
            let wrong = |key: &str, problem: String, hint: &str| MarksError::Place {
                list: "door",
                index,
                name: request.name.clone(),
                key: key.to_string(),
                problem,
                hint: Some(hint.to_owned()),
            };
            request.check().map_err(|error| wrong(error.key(), error.problem(), ""))?;
            let points_m: Vec<Vec2> = request.at.points().iter().map(|point| point.to_m(plan)).collect();
            let (first_m, last_m) = (points_m[0], points_m[points_m.len() - 1]);
            let at_m = first_m.lerp(last_m, 0.5);
            let width_m = if points_m.len() > 1 { first_m.distance(last_m) } else { request.width };
            let middle = |door: &Door| door.doorway.jambs_m[0].lerp(door.doorway.jambs_m[1], 0.5);
            let near_m = |door: &Door| middle(door).distance(at_m);
            let found =
                (0..self.doors.len()).min_by(|&a, &b| near_m(&self.doors[a]).total_cmp(&near_m(&self.doors[b])));
            let found = found.filter(|&k| near_m(&self.doors[k]) < (0.6 * width_m).max(0.5));
            let number = match found {
                Some(number) => number,
                None => {
                    let doorway = walls.doorway_at(at_m, width_m).ok_or_else(|| {
                        let (x, y) = (at_m.x, at_m.y);
                        let problem = if walls.is_inside(at_m) {
                            format!("no two jambs stand within {width_m} m of [{x:.2}, {y:.2}]")
                        } else {
                            format!("[{x:.2}, {y:.2}] is not on the floor")
                        };
                        let hint = "give the middle of a gap between two walls, in metres from the plan's lower-left corner \
                                    or as { px = [x, y] }; inspecting the plan draws its walls and floor";
                        wrong("at", problem, hint)
                    })?;
                    self.doors.push(door(walls, doorway));
                    self.doors.len() - 1
                }
            };
            let known = &mut self.doors[number];
            known.name.clone_from(&request.name);
            known.doorway.head_m = request.height;
            known.handle_m = Some(request.handle);
            known.latch = request.hinge.map(|hinge| {
                let hinge_m = hinge.to_m(plan);
                known.doorway.leaf_m = Some([hinge_m; 2]);
                let [a, b] = known.doorway.jambs_m.map(|jamb| jamb.distance(hinge_m));
                usize::from(a <= b)
            });
        }
        Ok(self)
    }

    /// Adds the fixtures of a scenario.
    ///
    /// # Errors
    /// A value is out of range; a fixture has no wall in reach.
    pub fn with_fixtures(
        mut self,
        plan: &FloorPlan,
        walls: &Walls,
        requests: &[FixtureRequest],
    ) -> Result<ContactPlaces, MarksError> {
        for (index, request) in requests.iter().enumerate() {
            let wrong = |key: &str, problem: String, hint: Option<&str>| MarksError::Place {
                list: "fixture",
                index,
                name: request.name.clone(),
                key: key.to_string(),
                problem,
                hint: hint.map(str::to_owned),
            };
            request.check().map_err(|error| wrong(error.key(), error.problem(), None))?;
            let ends_m = match request.at {
                FixtureAt::Point(point) => [point.to_m(plan); 2],
                FixtureAt::Line(points) => points.map(|point: PlanPoint| point.to_m(plan)),
            };
            let middle_m = ends_m[0].lerp(ends_m[1], 0.5);
            let facing_m = request.facing.map(|point| point.to_m(plan));
            let length_m = ends_m[0].distance(ends_m[1]);
            let width_m = if length_m > 0.0 { length_m } else { request.width.unwrap_or(request.kind.width_m()) };
            let found = fixture(walls, request.kind, middle_m, facing_m, width_m).ok_or_else(|| {
                let problem =
                    format!("no wall stands within {FIXTURE_REACH_M} m of [{:.2}, {:.2}]", middle_m.x, middle_m.y);
                let hint = "place a fixture at its wall; points are metres from the plan's lower-left corner, or \
                            { px = [x, y] } from the top left";
                wrong("at", problem, Some(hint))
            })?;
            self.fixtures.push(Fixture { name: request.name.clone(), ..found });
        }
        Ok(self)
    }

    /// Adds the counters, machines and benches at the stops of a scenario; a stop shared by routes counts once.
    pub fn with_stops<'s>(mut self, walls: &Walls, stops: impl IntoIterator<Item = &'s Stop>) -> ContactPlaces {
        let mut known: Vec<&str> = Vec::new();
        for stop in stops {
            if known.contains(&stop.name.as_str()) {
                continue;
            }
            known.push(&stop.name);
            let kind = match stop.kind {
                StopKind::Queue => FixtureKind::Counter,
                StopKind::Machine => FixtureKind::Machine,
                StopKind::Bench => FixtureKind::Bench,
                StopKind::Place | StopKind::Gate => continue,
            };
            for &place_m in &stop.places_m {
                // A counter stands before people, a bench's wall behind them.
                let ahead = match stop.facing {
                    Facing::Free => continue,
                    _ if kind == FixtureKind::Bench => -stop.facing_from(place_m),
                    _ => stop.facing_from(place_m),
                };
                let Some((near, face)) = wall_ahead(walls, place_m, ahead) else { continue };
                self.fixtures.push(Fixture {
                    name: Some(stop.name.clone()),
                    kind,
                    face,
                    along_m: near.along_m,
                    width_m: stop.spacing_m.min(kind.width_m()),
                    point_m: near.point_m,
                    reach_m: STOP_REACH_M,
                });
            }
        }
        self
    }

    /// Doors: those found in the walls, then those of the scenario only.
    pub fn doors(&self) -> &[Door] {
        &self.doors
    }

    /// Doorways of the doors.
    pub fn doorways(&self) -> Vec<Doorway> {
        self.doors.iter().map(|door| door.doorway).collect()
    }

    /// Convex corners.
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// Fixtures in the order of the scenario, then those of its stops.
    pub fn fixtures(&self) -> &[Fixture] {
        &self.fixtures
    }
}

/// Finds the wall ahead of a person who stands, and its face.
fn wall_ahead(walls: &Walls, from_m: Vec2, ahead: Vec2) -> Option<(Nearest, usize)> {
    let steps = (STOP_REACH_M / AHEAD_STEP_M) as u32;
    let spots = (0..=steps).map(|step| from_m + ahead * (AHEAD_STEP_M * f64::from(step)));
    let free = |spot: &Vec2| walls.is_inside(*spot) && walls.sight(from_m, *spot);
    let near = walls.nearest(spots.take_while(free).last()?, 2.0 * AHEAD_STEP_M)?;
    let is_seen = sees(walls, from_m, near.point_m);
    near.face.filter(|_| is_seen).map(|face| (near, face))
}

/// Whether a point on a wall is visible from another point.
pub(super) fn sees(walls: &Walls, from_m: Vec2, on_wall_m: Vec2) -> bool {
    // Ends short of the wall, which would hide the point.
    walls.sight(from_m, on_wall_m.lerp(from_m, 0.02))
}

fn door(walls: &Walls, doorway: Doorway) -> Door {
    let onward = doorway.on_faces.map(|(face, along_m)| direction_at(walls, face, along_m).dot(doorway.through) > 0.0);
    Door { name: None, doorway, latch: None, handle_m: None, onward }
}

/// Unit vector along a face at an arc length.
pub(super) fn direction_at(walls: &Walls, face: usize, along_m: f64) -> Vec2 {
    let Some(face) = walls.faces.get(face) else { return vec2(1.0, 0.0) };
    let n = face.points_m.len();
    let mut left_m = along_m;
    let mut direction = vec2(1.0, 0.0);
    for k in 0..if face.closed { n } else { n.max(1) - 1 } {
        let (a, b) = (face.points_m[k], face.points_m[(k + 1) % n]);
        direction = (b - a).normalized().unwrap_or(direction);
        left_m -= a.distance(b);
        if left_m < 0.0 {
            break;
        }
    }
    direction
}

fn fixture(walls: &Walls, kind: FixtureKind, middle_m: Vec2, facing_m: Option<Vec2>, width_m: f64) -> Option<Fixture> {
    let before = facing_m.and_then(|facing| (facing - middle_m).normalized());
    let from_m = before.map_or(middle_m, |before| middle_m + before * BEFORE_M);
    let near = walls.nearest(from_m, FIXTURE_REACH_M)?;
    Some(Fixture {
        name: None,
        kind,
        face: near.face?,
        along_m: near.along_m,
        width_m,
        point_m: near.point_m,
        reach_m: AT_FIXTURE_M,
    })
}

impl Door {
    /// Height of the handle, metres.
    pub(super) fn handle_height_m(&self) -> f64 {
        self.handle_m.unwrap_or(HANDLE_M)
    }
}
