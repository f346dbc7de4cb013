//! Plans drawn in code, and crowds on them.

use trodden::crowd::{CrowdOptions, Simulation, Tally};
use trodden::math::{Rect, Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::plan::FloorPlan;
use trodden::routes::{Navigation, PlaceRequest, Route, RouteRequest, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

/// A plan, its walls and its routes.
pub struct Scene {
    pub plan: FloorPlan,
    pub walls: Walls,
    pub routes: Vec<Route>,
    pub navigation: Navigation,
}

impl Scene {
    /// Floor where `floor` says so, at 0.1 m a pixel.
    pub fn new(size_m: [f64; 2], floor: impl Fn(Vec2) -> bool, routes: Vec<RouteRequest>) -> Scene {
        let (width, height) = ((size_m[0] * 10.0).round() as u32, (size_m[1] * 10.0).round() as u32);
        let middle = |i: u32| vec2(f64::from(i % width) + 0.5, f64::from(height - 1 - i / width) + 0.5) * 0.1;
        let mask = (0..width * height).map(|i| u8::from(floor(middle(i)))).collect();
        let plan = FloorPlan::from_mask(width, height, 0.1, mask);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let (routes, navigation) =
            Navigation::find(&plan, &walls, &RoutesOptions { routes, ..RoutesOptions::default() }).expect("routes");
        Scene { plan, walls, routes, navigation }
    }

    /// A straight corridor from west to east; floor lies between y = 0.2 m and y = 0.2 m + its width.
    pub fn corridor(length_m: f64, width_m: f64, routes: Vec<RouteRequest>) -> Scene {
        Scene::new([length_m, width_m + 0.4], |p| p.y > 0.2 && p.y < width_m + 0.2, routes)
    }

    /// Two rooms of 8 x 6 m with a door between them.
    pub fn rooms(door_m: f64, routes: Vec<RouteRequest>) -> Scene {
        let floor = |p: Vec2| {
            let room = p.y > 0.2 && p.y < 6.2;
            let wall = (p.x - 8.0).abs() < 0.1;
            room && (!wall || (p.y - 3.2).abs() < 0.5 * door_m)
        };
        Scene::new([16.0, 6.4], floor, routes)
    }

    pub fn crowd<'a>(&'a self, people: &People, options: &CrowdOptions) -> Simulation<'a> {
        Simulation::with_navigation(&self.plan, &self.walls, &self.routes, self.navigation.clone(), people, options)
            .expect("a crowd")
    }

    /// Walks to the end.
    pub fn walk(&self, options: &CrowdOptions, seed: u64, mut see: impl FnMut(&Frame)) -> Tally {
        let people = People::new(seed, BodyOptions::default());
        let mut crowd = self.crowd(&people, options);
        let mut frame = Frame::default();
        while crowd.next_frame(&mut frame).expect("a step") {
            see(&frame);
        }
        crowd.tally()
    }

    pub fn is_in_wall(&self, p: Vec2) -> bool {
        let image = Rect { min: Vec2::ZERO, max: vec2(self.plan.width_m(), self.plan.height_m()) };
        !self.walls.is_inside(p) || image.contains(p) && !self.plan.is_floor(p)
    }
}

pub fn opening(name: &str) -> PlaceRequest {
    PlaceRequest::Opening(name.into())
}

pub fn area(x: [f64; 2], y: [f64; 2]) -> PlaceRequest {
    PlaceRequest::Area([[x[0], y[0]], [x[1], y[1]]])
}

pub fn route(from: PlaceRequest, to: PlaceRequest) -> RouteRequest {
    RouteRequest { name: None, from, to, via: Vec::new(), arrivals: None, share: 1.0 }
}

/// From one side to the other.
pub fn across(from: &str) -> RouteRequest {
    let to = match from {
        "west" => "east",
        "east" => "west",
        "south" => "north",
        _ => "south",
    };
    route(opening(from), opening(to))
}

pub fn commuters(people: u32) -> CrowdOptions {
    CrowdOptions { people, ..CrowdOptions::default() }
}

/// Everybody is there at once, walks round and round a corridor of this length, for so many seconds.
pub fn endless(people: u32, length_m: f64, seconds: f64) -> CrowdOptions {
    CrowdOptions { entry_seconds: Some(0.0), end_seconds: Some(seconds), period_x: Some(length_m), ..commuters(people) }
}
