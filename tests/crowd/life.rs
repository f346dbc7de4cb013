//! Default life: people come in, use every room, and leave.

use std::collections::BTreeMap;
use std::path::Path;

use trodden::crowd::{CrowdOptions, Simulation, Tally};
use trodden::marks::{Footfalls, MarksOptions, Origin};
use trodden::math::{Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::{self, FloorPlan, FurniturePiece, PlanClass, PlanOptions};
use trodden::rooms::{LifeOptions, RoomKind, RoomRequest, Rooms, Use};
use trodden::routes::{Navigation, Place, PlaceRequest, Route, RouteRequest, RoutesOptions};
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::{Walls, WallsOptions};

/// Least share of a room's floor that people have trodden, by texels of 5 cm under at least one sole.
const LEAST_TRODDEN: f64 = 0.3;
/// Least share of people who arrive.
const LEAST_ARRIVED: f64 = 0.995;
/// Largest distance from where people vanish to the place where they were going, metres.
const NEAR_END_M: f64 = 1.0;

/// An office of 30 x 18 m: six rooms on either side of a corridor, doors of 0.9 m, one entrance in the west.
fn office() -> FloorPlan {
    let floor = |p: Vec2| {
        let inside = p.x > 0.2 && p.x < 29.8 && p.y > 0.2 && p.y < 17.8;
        let corridor = p.y > 8.0 && p.y < 10.0;
        let entrance = p.x <= 0.2 && (p.y - 9.0).abs() < 0.45;
        // Walls between rooms every 5 m, doors in their middle.
        let across = (p.x % 5.0 - 0.05).abs() < 0.1 && !corridor;
        let along = (p.y - 7.95).abs() < 0.05 || (p.y - 10.05).abs() < 0.05;
        let door = along && (p.x % 5.0 - 2.5).abs() < 0.45;
        inside && !across && !along || door || entrance
    };
    let (width, height) = (600, 360);
    let middle = |i: u32| vec2(f64::from(i % width) + 0.5, f64::from(height - 1 - i / width) + 0.5) * 0.05;
    FloorPlan::from_mask(width, height, 0.05, (0..width * height).map(|i| u8::from(floor(middle(i)))).collect())
}

fn sample(name: &str) -> FloorPlan {
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    plan::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name), &options).unwrap()
}

/// What people did in a building.
struct Lived {
    rooms: Rooms,
    routes: Vec<Route>,
    tally: Tally,
    people: usize,
    /// Share of each room's floor that soles have touched.
    trodden: Vec<f64>,
    /// Where each person was last seen, and the route.
    ends: Vec<(Vec2, usize)>,
    seconds: f64,
    plan: FloorPlan,
}

const TEXEL_M: f64 = 0.05;

fn live(plan: FloorPlan, people: u32, options: RoutesOptions) -> Lived {
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let life = LifeOptions { people, ..options.life.clone() };
    let (routes, ways) = Navigation::find(&plan, &walls, &RoutesOptions { life, ..options }).unwrap();
    let rooms = ways.life().expect("rooms to live in").rooms.clone();
    let bodies = People::new(1, BodyOptions::default());
    let crowd_options = CrowdOptions { people, ..CrowdOptions::default() };
    let mut crowd = Simulation::with_navigation(&plan, &walls, &routes, ways, &bodies, &crowd_options).unwrap();
    let library = PatternLibrary::built_in();
    let origins = Origin::of_arrivals(crowd.arrivals().iter().map(|arrival| arrival.from_outside), 0);
    let mut footfalls = Footfalls::new(&bodies, &walls, &library, &MarksOptions::default(), origins).unwrap();
    let (columns, rows) = ((plan.width_m() / TEXEL_M) as usize + 1, (plan.height_m() / TEXEL_M) as usize + 1);
    let mut texels = vec![false; columns * rows];
    let (mut frame, mut marks) = (Frame::default(), Vec::new());
    let mut last: BTreeMap<u32, Vec2> = BTreeMap::new();
    let mut tread = |marks: &mut Vec<trodden::marks::Mark>| {
        for mark in marks.drain(..).filter(|mark| mark.cause == Cause::Sole) {
            let (half_m, across) = (0.5 * f64::from(mark.length_m), mark.heading.left());
            for along in -4..=4 {
                for aside in -1..=1 {
                    let p = mark.place_m
                        + mark.heading * (half_m * f64::from(along) / 4.0)
                        + across * (0.035 * f64::from(aside));
                    let (x, y) = ((p.x / TEXEL_M) as usize, (p.y / TEXEL_M) as usize);
                    if p.x >= 0.0 && p.y >= 0.0 && x < columns && y < rows {
                        texels[y * columns + x] = true;
                    }
                }
            }
        }
    };
    while crowd.next_frame(&mut frame).unwrap() {
        footfalls.push(&frame, &mut marks);
        tread(&mut marks);
        last.extend(frame.walkers.iter().map(|walker| (walker.id, walker.position_m)));
    }
    footfalls.finish(&mut marks);
    tread(&mut marks);
    let mut counts = vec![[0usize; 2]; rooms.rooms.len()];
    for (at, trodden) in texels.iter().enumerate() {
        let p = vec2((at % columns) as f64 + 0.5, (at / columns) as f64 + 0.5) * TEXEL_M;
        if let Some(room) = rooms.at(p) {
            counts[room][0] += 1;
            counts[room][1] += usize::from(*trodden);
        }
    }
    let route_of = |id: u32| crowd.arrivals()[id as usize].route;
    let ends = last.iter().map(|(&id, &p)| (p, route_of(id))).collect();
    let (tally, seconds, count) = (crowd.tally(), crowd.time_s(), crowd.arrivals().len());
    let trodden = counts.iter().map(|[all, trodden]| *trodden as f64 / (*all).max(1) as f64).collect();
    drop(crowd);
    Lived { rooms, routes, tally, people: count, trodden, ends, seconds, plan }
}

impl Lived {
    /// Distance of a place from where a route ends, metres.
    fn off_the_end_m(&self, p: Vec2, route: usize) -> f64 {
        match self.routes[route].goal {
            Place::Opening(index) => {
                let opening = &self.plan.openings[index];
                // Beyond the edge people are out.
                (opening.from_m - p).dot(opening.side.outward()).max(0.0)
            }
            Place::Area([min, max]) => {
                let inside = vec2(p.x.clamp(min.x, max.x), p.y.clamp(min.y, max.y));
                inside.distance(p)
            }
        }
    }

    fn print(&self, name: &str) {
        println!("{name}: {} people in {:.0} s, {} stuck", self.people, self.seconds, self.tally.stuck.len());
        for (room, trodden) in self.rooms.rooms.iter().zip(&self.trodden) {
            let (name, kind, doors) = (&room.name, room.kind.name(), room.doors);
            println!("  {name:<9} {kind:<9} {:6.1} m2 {doors} doors, {:3.0} % trodden", room.area_m2, 100.0 * trodden);
        }
    }

    fn check_all_came_and_went(&self) {
        let arrived = self.tally.arrived as f64 / self.people as f64;
        let first = &self.tally.stuck[..self.tally.stuck.len().min(5)];
        assert!(arrived >= LEAST_ARRIVED, "{} of {} arrived: {first:?}", self.tally.arrived, self.people);
        let mut off: Vec<f64> = self.ends.iter().map(|&(p, route)| self.off_the_end_m(p, route)).collect();
        off.sort_by(f64::total_cmp);
        let most_m = off.last().copied().unwrap_or(0.0);
        let stuck = self.tally.stuck.len();
        let within = off.iter().filter(|m| **m <= NEAR_END_M).count();
        assert!(within + stuck >= off.len(), "somebody vanished {most_m:.2} m from the end of the route");
    }

    fn check_rooms(&self, least: f64) {
        for (room, &trodden) in self.rooms.rooms.iter().zip(&self.trodden) {
            assert!(trodden >= least, "{} of {:.1} m2: {:.1} % trodden", room.name, room.area_m2, 100.0 * trodden);
        }
    }
}

#[test]
fn an_office_has_its_rooms_and_one_entrance() {
    let plan = office();
    let rooms = Rooms::find(&plan, &Walls::trace(&plan, &WallsOptions::default()));
    let of = |kind: RoomKind| rooms.rooms.iter().filter(|room| room.kind == kind).count();
    assert_eq!((of(RoomKind::Room), of(RoomKind::Corridor), rooms.doors.len()), (12, 1, 12), "{:?}", rooms.rooms);
    assert_eq!(rooms.entrances.len(), 1);
    for room in rooms.rooms.iter().filter(|room| room.kind == RoomKind::Room) {
        assert!((room.area_m2 - 37.0).abs() < 3.0 && room.doors == 1, "{room:?}");
    }
}

#[test]
fn every_room_of_an_office_is_used() {
    for people in [1000, 10_000] {
        let lived = live(office(), people, RoutesOptions::default());
        lived.print("office");
        assert_eq!(lived.routes[0].life.map(|life| life.r#use), Some(Use::Office));
        lived.check_all_came_and_went();
        lived.check_rooms(LEAST_TRODDEN);
    }
}

#[test]
fn few_people_go_to_every_room_too() {
    let lived = live(office(), 4, RoutesOptions::default());
    lived.print("office");
    lived.check_all_came_and_went();
    lived.check_rooms(0.002);
}

#[test]
fn every_room_of_the_school_is_used() {
    let lived = live(sample("school.png"), 1000, RoutesOptions::default());
    lived.print("school");
    lived.check_all_came_and_went();
    lived.check_rooms(LEAST_TRODDEN);
}

/// The office without its entrance.
fn closed_office() -> FloorPlan {
    let FloorPlan { width_px, height_px, metres_per_pixel, floor, .. } = office();
    let closed = floor.iter().enumerate().map(|(at, &floor)| if at % 600 < 4 { 0 } else { floor });
    FloorPlan::from_mask(width_px, height_px, metres_per_pixel, closed.collect())
}

#[test]
fn in_a_closed_plan_people_begin_and_end_in_rooms() {
    for people in [300, 3000] {
        let lived = live(closed_office(), people, RoutesOptions::default());
        lived.print("closed office");
        assert!(lived.rooms.entrances.is_empty());
        lived.check_all_came_and_went();
        lived.check_rooms(LEAST_TRODDEN);
    }
}

/// A flat of 10 x 8 m: five rooms about a hall of 1.2 m, doors of 0.8 m, an entrance of 0.9 m.
fn flat() -> FloorPlan {
    let floor = |p: Vec2| {
        let inside = p.x > 0.2 && p.x < 9.8 && p.y > 0.2 && p.y < 7.8;
        let hall = p.y > 3.4 && p.y < 4.6;
        let walls = if p.y > 4.0 { [3.5, 6.5] } else { [5.0, 20.0] };
        let across = walls.iter().any(|x| (p.x - x).abs() < 0.05) && !hall;
        let along = (p.y - 3.35).abs() < 0.05 || (p.y - 4.65).abs() < 0.05;
        let doors = if p.y > 4.0 { [1.7, 5.0, 8.2] } else { [2.5, 7.5, 7.5] };
        let door = along && doors.iter().any(|x| (p.x - x).abs() < 0.4);
        let entrance = p.x <= 0.2 && (p.y - 4.0).abs() < 0.45;
        inside && !across && !along || door || entrance
    };
    let middle = |i: u32| vec2(f64::from(i % 200) + 0.5, f64::from(159 - i / 200) + 0.5) * 0.05;
    FloorPlan::from_mask(200, 160, 0.05, (0..200 * 160).map(|i| u8::from(floor(middle(i)))).collect())
}

#[test]
fn in_a_flat_people_let_each_other_pass() {
    let lived = live(flat(), 3000, RoutesOptions::default());
    lived.print("flat");
    assert_eq!(lived.rooms.rooms.len(), 6);
    lived.check_all_came_and_went();
    lived.check_rooms(LEAST_TRODDEN);
}

/// The closed office as a robot draws it: free floor, walls of two cells, unknown beyond.
#[test]
fn every_room_of_a_robots_map_is_used() {
    let plan = closed_office();
    let (width, height) = (plan.width_px as i64, plan.height_px as i64);
    let is_floor = |x: i64, y: i64| {
        (0..width).contains(&x) && (0..height).contains(&y) && plan.floor[(y * width + x) as usize] != 0
    };
    let shade = |x: u32, y: u32| {
        let (x, y) = (i64::from(x), i64::from(y));
        let is_seen = (-2..=2).any(|dy| (-2..=2).any(|dx| is_floor(x + dx, y + dy)));
        image::Luma([if is_floor(x, y) {
            254u8
        } else if is_seen {
            0
        } else {
            205
        }])
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.png");
    image::GrayImage::from_fn(plan.width_px, plan.height_px, shade).save(&path).unwrap();
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    let plan = plan::read(&path, &options).unwrap();
    assert!(plan.scanned);
    let lived = live(plan, 1000, RoutesOptions::default());
    lived.print("robot's map");
    assert_eq!(lived.rooms.rooms.len(), 13);
    lived.check_all_came_and_went();
    lived.check_rooms(LEAST_TRODDEN);
}

/// Buildings on a sheet of paper of so many metres: each with the place of its lower-left corner.
fn on_paper(size_m: [f64; 2], buildings: &[(FloorPlan, Vec2)]) -> FloorPlan {
    let size = size_m.map(|metres| (metres / 0.05) as u32);
    let mut sheet = image::GrayImage::from_pixel(size[0], size[1], image::Luma([255]));
    for (building, at) in buildings {
        let (left, top) = ((at.x / 0.05) as u32, size[1] - (at.y / 0.05) as u32 - building.height_px);
        for (k, _) in building.floor.iter().enumerate().filter(|(_, floor)| **floor == 0) {
            let (x, y) = (k as u32 % building.width_px, k as u32 / building.width_px);
            sheet.put_pixel(left + x, top + y, image::Luma([0]));
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sheet.png");
    sheet.save(&path).unwrap();
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    plan::read(&path, &options).unwrap()
}

/// A space of so many metres within walls of 0.3 m, with openings: squares around places, metres.
fn space(size_m: [f64; 2], openings: &[(Vec2, f64)]) -> FloorPlan {
    let [width, height] = size_m.map(|metres| (metres / 0.05) as u32);
    let floor = |p: Vec2| {
        let inside = p.x > 0.3 && p.x < size_m[0] - 0.3 && p.y > 0.3 && p.y < size_m[1] - 0.3;
        inside || openings.iter().any(|(at, wide)| (p.x - at.x).abs() < 0.5 * wide && (p.y - at.y).abs() < 0.5 * wide)
    };
    let middle = |i: u32| vec2(f64::from(i % width) + 0.5, f64::from(height - 1 - i / width) + 0.5) * 0.05;
    FloorPlan::from_mask(width, height, 0.05, (0..width * height).map(|i| u8::from(floor(middle(i)))).collect())
}

#[test]
fn buildings_beside_each_other_are_all_lived_in() {
    let lived =
        live(on_paper([28.0, 13.0], &[(flat(), vec2(2.5, 2.5)), (flat(), vec2(15.5, 2.5))]), 600, Default::default());
    lived.print("two flats");
    assert_eq!((lived.rooms.rooms.len(), lived.rooms.entrances.len()), (12, 2));
    lived.check_all_came_and_went();
    lived.check_rooms(0.15);
    assert!(lived.plan.warnings.is_empty(), "{:?}", lived.plan.warnings);
}

#[test]
fn a_building_without_a_door_is_told() {
    let shut = space([10.0, 8.0], &[]);
    let plan = on_paper([28.0, 13.0], &[(flat(), vec2(2.5, 2.5)), (shut, vec2(15.5, 2.5))]);
    assert!(plan.warnings.iter().any(|told| told.contains("nobody can reach closed rooms")), "{:?}", plan.warnings);
    assert!(plan.warnings.iter().any(|told| told.contains("are doors closed?")), "{:?}", plan.warnings);
}

#[test]
fn people_come_into_a_single_room_by_its_door_and_stay() {
    let room = space([12.0, 9.0], &[(vec2(0.15, 4.0), 0.9)]);
    let lived = live(on_paper([17.0, 14.0], &[(room, vec2(2.5, 2.5))]), 300, Default::default());
    lived.print("one room");
    assert!(lived.routes.iter().all(|route| route.life.is_some() && !route.stops.is_empty()), "{:?}", lived.routes[0]);
    lived.check_all_came_and_went();
    lived.check_rooms(LEAST_TRODDEN);
}

/// What furniture and the lack of a corridor tell: desks side by side, flats beside each other, rows of seats.
#[test]
fn buildings_are_told_by_what_stands_in_them() {
    let guessed = |plan: &FloorPlan| {
        let (_, ways) =
            Navigation::find(plan, &Walls::trace(plan, &WallsOptions::default()), &Default::default()).unwrap();
        ways.life().unwrap().r#use
    };
    // Pieces of 0.6 x 0.6 m in a grid, from the lower left.
    let furnish = |plan: &mut FloorPlan, class: PlanClass, from: Vec2, [columns, rows]: [u32; 2], every_m: f64| {
        plan.furniture.extend((0..columns * rows).map(|k| {
            let min_m = from + vec2(f64::from(k % columns), f64::from(k / columns)) * every_m;
            let max_m = min_m + vec2(0.6, 0.6);
            FurniturePiece { class, min_m, max_m, area_m2: 0.36, height_m: class.height_m(), at_wall: 0.0 }
        }));
    };
    let mut rooms = office();
    assert_eq!(guessed(&rooms), Use::Office);
    // Two desks in each of its rooms of 37 square metres, and then twelve more.
    let mut desks = |grid: [u32; 2], every_m: f64| {
        for k in 0..12 {
            let from = vec2(5.0 * f64::from(k % 6) + 1.0, 10.3 * f64::from(k / 6) + 1.0);
            furnish(&mut rooms, PlanClass::Table, from, grid, every_m);
        }
        guessed(&rooms)
    };
    assert_eq!(desks([2, 1], 1.5), Use::Office);
    assert_eq!(desks([3, 4], 1.2), Use::School);

    // Four flats of four rooms, 260 square metres.
    let flat = |p: Vec2| {
        let (x, y) = (p.x % 8.0, p.y % 8.0);
        let wall = x < 0.2 || y < 0.2 || p.x > 15.8 || p.y > 15.8 || (x - 4.0).abs() < 0.1 || (y - 4.0).abs() < 0.1;
        let door = |x: f64, y: f64| (x - 4.0).abs() < 0.15 && (y - 2.0).abs() < 0.45;
        let own = door(x, y) || door(x, y - 4.0) || door(y, x);
        // Their entrances.
        let entrance = (x - 2.0).abs() < 0.45 && (p.y < 0.25 || p.y > 15.75);
        !wall || own || entrance
    };
    let middle = |k: u32| vec2(f64::from(k % 320) + 0.5, 320.0 - f64::from(k / 320) - 0.5) * 0.05;
    assert_eq!(
        guessed(&FloorPlan::from_mask(320, 320, 0.05, (0..320 * 320).map(|k| u8::from(flat(middle(k)))).collect())),
        Use::Home
    );

    // A room with a counter sells; one with 150 seats is a theatre.
    let mut room = on_paper([22.0, 18.0], &[(space([20.0, 16.0], &[(vec2(10.0, 0.15), 1.0)]), vec2(1.0, 1.0))]);
    furnish(&mut room, PlanClass::Counter, vec2(8.0, 14.0), [1, 1], 1.0);
    assert_eq!(guessed(&room), Use::Shop);
    furnish(&mut room, PlanClass::Seat, vec2(2.0, 4.0), [15, 10], 1.0);
    assert_eq!(guessed(&room), Use::Hall);
}

/// A plan that looks like a station: its gates are no obstacle to those who stay in the hall or go to its rooms.
#[test]
fn people_wait_in_a_guessed_station_and_use_its_rooms() {
    let lived = live(sample("station.png"), 1000, Default::default());
    lived.print("station");
    let staying = lived.routes.iter().filter(|route| !route.stops.is_empty()).map(|route| route.share).sum::<f64>();
    assert!((0.25..0.5).contains(&staying), "{staying}");
    lived.check_all_came_and_went();
    lived.check_rooms(LEAST_TRODDEN);
}

/// Doors of 3 m are told from the paper, and people come and go by them.
#[test]
fn people_cross_a_hall_from_door_to_door() {
    let hall = space([40.0, 25.0], &[(vec2(0.15, 12.0), 3.0), (vec2(39.85, 8.0), 3.0), (vec2(20.0, 0.15), 3.0)]);
    let plan = on_paper([46.0, 31.0], &[(hall, vec2(3.0, 3.0))]);
    let floor_m2: f64 = plan.floor.iter().map(|&floor| f64::from(floor)).sum::<f64>() * 0.05 * 0.05;
    assert!((floor_m2 - 39.4 * 24.4).abs() < 15.0 && plan.openings.is_empty(), "{floor_m2} m2");
    let lived_from_doors = Navigation::find(&plan, &Walls::trace(&plan, &WallsOptions::default()), &Default::default());
    let names: Vec<String> = lived_from_doors.unwrap().0.into_iter().map(|route| route.name).collect();
    assert!(names.iter().all(|name| name.starts_with("door ")) && names.len() >= 6, "{names:?}");
    // Routes name them too.
    let route = |from: &str| {
        let [from, to] = [from, "Door 3"].map(|name| PlaceRequest::Opening(name.into()));
        let options = RoutesOptions {
            routes: vec![RouteRequest { from, to, ..RouteRequest::default() }],
            ..RoutesOptions::default()
        };
        Navigation::find(&plan, &Walls::trace(&plan, &WallsOptions::default()), &options).map(|found| found.0)
    };
    let written = route("door 1").unwrap();
    assert!(written.len() == 1 && written[0].length_m > 15.0, "{written:?}");
    assert!(route("dor 9").unwrap_err().to_string().contains("it has door 1, door 2, door 3"));
}

/// Bags, wheels, children, groups and cleaning of each use differ, and so do the ways that people go.
#[test]
fn each_use_has_people_and_cleaning_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plan.png");
    let office = office();
    let shade = |x: u32, y: u32| image::Luma([255 * office.floor[(y * office.width_px + x) as usize]]);
    image::GrayImage::from_fn(office.width_px, office.height_px, shade).save(&path).unwrap();
    let walls = Walls::trace(&office, &WallsOptions::default());
    let mut all: Vec<(Use, Vec<f64>)> = Vec::new();
    for r#use in Use::ALL {
        let overrides = Overrides { metres_per_pixel: Some(0.05), r#use: Some(r#use), ..Overrides::default() };
        let scenario = Scenario::from_plan(&path, &overrides).unwrap();
        let (routes, ways) = Navigation::find(&office, &walls, &scenario.routes).unwrap();
        let lived = scenario.lived_in(ways.life().map(|life| &**life));
        let stops = routes.iter().map(|route| route.share * route.stops.len() as f64).sum::<f64>();
        let length_m = routes.iter().map(|route| route.share * route.length_m).sum::<f64>();
        let groups = lived.crowd.groups.shares;
        let bodies = [lived.bodies.bags, lived.bodies.pull, lived.bodies.push, lived.bodies.children, groups[0]];
        let measures = bodies.into_iter().chain([f64::from(lived.look.mop.takes), stops / 10.0, length_m / 100.0]);
        all.push((r#use, measures.collect()));
    }
    for (k, (one, own)) in all.iter().enumerate() {
        for (other, others) in &all[k + 1..] {
            let apart = own.iter().zip(others).map(|(a, b)| (a - b).abs()).sum::<f64>();
            assert!(apart > 0.2, "{one:?} {own:?} and {other:?} {others:?} are alike");
        }
    }
    let mop = |r#use: Use| all.iter().find(|(own, _)| *own == r#use).map(|(_, measures)| measures[5]).unwrap();
    assert!(mop(Use::Hospital) > mop(Use::Home) + 0.25);
    // What a scenario says stays.
    let mut own =
        Scenario::from_plan(&path, &Overrides { metres_per_pixel: Some(0.05), ..Overrides::default() }).unwrap();
    own.look.mop.takes = 0.1;
    let (_, ways) = Navigation::find(&office, &walls, &own.routes).unwrap();
    assert_eq!(own.lived_in(ways.life().map(|life| &**life)).look.mop.takes, 0.1);
}

/// The office on a sheet of paper: its only way in is a door in the outer wall.
#[test]
fn people_come_in_by_the_door_of_a_building_on_paper() {
    let inner = office();
    let (margin, width, height) = (60, inner.width_px, inner.height_px);
    let shade = |x: u32, y: u32| {
        let (x, y) = (x.wrapping_sub(margin), y.wrapping_sub(margin));
        let is_wall = x < width && y < height && inner.floor[(y * width + x) as usize] == 0;
        image::Luma([if is_wall { 0u8 } else { 255 }])
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("office.png");
    image::GrayImage::from_fn(width + 2 * margin, height + 2 * margin, shade).save(&path).unwrap();
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    let lived = live(plan::read(&path, &options).unwrap(), 300, RoutesOptions::default());
    lived.print("office on paper");
    let [door] = lived.rooms.entrances.as_slice() else { panic!("{:?}", lived.rooms.entrances) };
    assert!(door.opening.is_none() && door.at_m.distance(vec2(3.2, 12.0)) < 0.5, "{door:?}");
    assert!((door.width_m - 0.9).abs() < 0.15, "{door:?}");
    lived.check_all_came_and_went();
    lived.check_rooms(0.15);
}

#[test]
fn written_routes_and_life_mix_by_share() {
    let walls_of = |plan: &FloorPlan| Walls::trace(plan, &WallsOptions::default());
    let plan = sample("school.png");
    let route = RouteRequest {
        from: PlaceRequest::Opening("south".into()),
        to: PlaceRequest::Opening("east".into()),
        ..RouteRequest::default()
    };
    let life = LifeOptions { share: 0.25, ..LifeOptions::default() };
    let options = RoutesOptions { routes: vec![route], life, ..RoutesOptions::default() };
    let (routes, _) = Navigation::find(&plan, &walls_of(&plan), &options).unwrap();
    let share = |lived: bool| {
        let own = routes.iter().filter(|route| route.life.is_some() == lived);
        own.map(|route| route.share).sum::<f64>()
    };
    assert!((share(true) - 0.25).abs() < 1e-9 && (share(false) - 0.75).abs() < 1e-9, "{}", share(true));
}

#[test]
fn what_the_scenario_says_of_a_room_counts() {
    let said = |weight: f64| RoutesOptions {
        rooms: vec![RoomRequest { name: Some("Room 3".into()), weight: Some(weight), ..RoomRequest::default() }],
        ..RoutesOptions::default()
    };
    let visits = |lived: &Lived| {
        let shares = lived.routes.iter().filter(|route| route.stops.iter().any(|stop| stop.stop.name == "room 3"));
        shares.map(|route| route.share).sum::<f64>()
    };
    let [never, often] = [0.0, 8.0].map(|weight| live(office(), 200, said(weight)));
    assert_eq!(visits(&never), 0.0);
    assert!(visits(&often) > 0.5, "{}", visits(&often));
}
