//! Places where people stop, and timetables: what the scenario asks for is what people do.

use trodden::crowd::{CrowdOptions, Simulation, Tally, Visit};
use trodden::math::{Distribution, Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::plan::{FloorPlan, PlanPoint};
use trodden::routes::{
    self, PlaceRequest, Route, RouteRequest, RoutesError, RoutesOptions, SharedStop, StopAt, StopKind, StopRequest,
    Timetable, TimetableKind, ViaRequest,
};
use trodden::walls::{Walls, WallsOptions};

/// Side of a pixel, metres.
const PIXEL_M: f64 = 0.1;

/// A hall with a wall of 0.3 m around it, openings of 3 m in the west and the east, and whatever `blocked` says.
fn hall(width_m: f64, height_m: f64, blocked: impl Fn(Vec2) -> bool) -> FloorPlan {
    let (columns, rows) = ((width_m / PIXEL_M).round() as u32, (height_m / PIXEL_M).round() as u32);
    let mut floor = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let p = vec2(f64::from(column) + 0.5, f64::from(rows - row) - 0.5) * PIXEL_M;
            let inside = p.y > 0.3 && p.y < height_m - 0.3;
            let door = (p.y - height_m / 2.0).abs() < 1.5;
            let walled = p.x < 0.3 || p.x > width_m - 0.3;
            floor.push(u8::from(inside && (!walled || door) && !blocked(p)));
        }
    }
    FloorPlan::from_mask(columns, rows, PIXEL_M, floor)
}

fn stop(name: &str, kind: StopKind, at: [f64; 2]) -> StopRequest {
    StopRequest {
        name: name.into(),
        kind,
        at: StopAt::Point(PlanPoint::Metres(at)),
        facing: None,
        heading_deg: None,
        dwell: None,
        places: None,
        spacing: None,
        reach: None,
        queue: Vec::new(),
    }
}

fn to_stop(name: &str, share: f64) -> ViaRequest {
    ViaRequest::Stop(SharedStop { stop: name.into(), share })
}

fn route(from: &str, to: &str, via: Vec<ViaRequest>) -> RouteRequest {
    let opening = |name: &str| PlaceRequest::Opening(name.into());
    RouteRequest { name: None, from: opening(from), to: opening(to), via, share: 1.0, arrivals: None }
}

/// One walk through a hall.
struct Walk {
    plan: FloorPlan,
    walls: Walls,
    routes: Vec<Route>,
    options: CrowdOptions,
}

struct Walked {
    tally: Tally,
    visits: Vec<Visit>,
    end_s: f64,
}

impl Walk {
    fn new(plan: FloorPlan, stops: Vec<StopRequest>, routes: Vec<RouteRequest>, options: CrowdOptions) -> Walk {
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let routes = routes::find(&plan, &walls, &RoutesOptions { routes, stops, ..RoutesOptions::default() })
            .unwrap_or_else(|e| panic!("{e}"));
        Walk { plan, walls, routes, options }
    }

    fn crowd<'a>(&'a self, people: &People) -> Simulation<'a> {
        Simulation::new(&self.plan, &self.walls, &self.routes, people, &self.options).unwrap()
    }

    fn run(&self, mut each: impl FnMut(&Frame)) -> Walked {
        let people = People::new(1, BodyOptions::default());
        let mut crowd = self.crowd(&people);
        crowd.keep_visits();
        let mut frame = Frame::default();
        while crowd.next_frame(&mut frame).unwrap() {
            each(&frame);
            assert!(frame.time_s < 20_000.0, "never ends: {:?}", crowd.tally());
        }
        Walked { tally: crowd.tally(), visits: crowd.visits().to_vec(), end_s: frame.time_s }
    }
}

fn commuters(people: u32, entry_seconds: f64) -> CrowdOptions {
    CrowdOptions { people, entry_seconds: Some(entry_seconds), ..CrowdOptions::default() }
}

fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

fn counter(dwell: Distribution) -> StopRequest {
    StopRequest { dwell: Some(dwell), ..stop("counter", StopKind::Queue, [10.0, 11.2]) }
}

/// A hall with a counter at its north wall, which everybody goes to on the way from west to east.
fn at_the_counter(counter: StopRequest, people: u32, entry_seconds: f64) -> Walk {
    let routes = vec![route("west", "east", vec![to_stop("counter", 1.0)])];
    Walk::new(hall(20.0, 12.0, |_| false), vec![counter], routes, commuters(people, entry_seconds))
}

#[test]
fn people_stay_as_long_as_is_drawn() {
    let dwell = Distribution::normal(8.0, 2.0, 3.0, 13.0);
    let walked = at_the_counter(counter(dwell), 120, 960.0).run(|_| {});
    assert_eq!((walked.visits.len(), walked.tally.arrived), (120, 120));
    let stays = || walked.visits.iter().map(|visit| visit.left_s - visit.begun_s);
    let own = mean(stays());
    assert!((own - 8.0).abs() < 3.0 * 2.0 / 120f64.sqrt(), "{own}");
    let spread = mean(stays().map(|stay| (stay - own) * (stay - own))).sqrt();
    assert!((spread - 2.0).abs() < 0.4, "{spread}");
    assert!(stays().all(|stay| (2.9..13.5).contains(&stay)));
}

#[test]
fn a_line_serves_whoever_came_first_and_nobody_overlaps() {
    let mut gaps = Vec::new();
    let mut least_m = f64::INFINITY;
    let walked = at_the_counter(counter(Distribution::Constant(8.0)), 40, 120.0).run(|frame| {
        for (n, a) in frame.walkers.iter().enumerate() {
            for b in &frame.walkers[..n] {
                let distance_m = a.position_m.distance(b.position_m);
                least_m = least_m.min(distance_m);
            }
        }
        // Everybody stands: no step forward in the last seconds.
        let in_line = |p: Vec2| (p.x - 10.0).abs() < 0.3 && p.y > 3.0;
        let mut line: Vec<_> = frame.walkers.iter().filter(|walker| in_line(walker.position_m)).collect();
        if line.len() > 6 && line.iter().all(|walker| walker.velocity_m_s.length() < 0.02) {
            line.sort_by(|a, b| b.position_m.y.total_cmp(&a.position_m.y));
            gaps.extend(line.windows(2).map(|pair| pair[0].position_m.y - pair[1].position_m.y));
        }
    });
    let mut by_turn = walked.visits.clone();
    by_turn.sort_by(|a, b| a.begun_s.total_cmp(&b.begun_s));
    assert!(by_turn.windows(2).all(|pair| pair[0].came_s <= pair[1].came_s), "{by_turn:?}");
    assert!(gaps.len() > 100, "{}", gaps.len());
    let gap_m = mean(gaps.iter().copied());
    assert!((gap_m - 0.75).abs() < 0.08, "mean gap {gap_m}");
    let nearest_m = gaps.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(nearest_m > 0.45, "{nearest_m}");
    let holes = gaps.iter().filter(|gap| **gap > 1.1).count();
    assert!(holes * 50 < gaps.len(), "{holes} holes in {} gaps", gaps.len());
    assert!(least_m > 0.27, "{least_m}");
    assert_eq!(walked.tally.arrived, 40);
}

#[test]
fn a_busy_counter_serves_at_the_rate_of_its_places() {
    for (places, dwell_s) in [(1, 6.0), (2, 6.0), (3, 9.0)] {
        let counter = StopRequest { places: Some(places), ..counter(Distribution::Constant(dwell_s)) };
        let walked = at_the_counter(counter, 60, 60.0).run(|_| {});
        let mut ends: Vec<f64> = walked.visits.iter().map(|visit| visit.left_s).collect();
        ends.sort_by(f64::total_cmp);
        // From when the line is full until it runs empty.
        let (from, to) = (12, 54);
        let rate = (to - from) as f64 / (ends[to] - ends[from]);
        let wanted = f64::from(places) / dwell_s;
        assert!((rate / wanted - 1.0).abs() < 0.04, "{places} places: {rate} instead of {wanted} a second");
    }
}

#[test]
fn whoever_is_served_keeps_the_place_and_faces_the_counter() {
    let mut walk = at_the_counter(counter(Distribution::Constant(12.0)), 60, 240.0);
    // Others walk past.
    let more = vec![
        route("west", "east", vec![to_stop("counter", 0.4)]),
        route("east", "west", vec![to_stop("counter", 0.2)]),
    ];
    let stops = vec![counter(Distribution::Constant(12.0))];
    walk.routes =
        routes::find(&walk.plan, &walk.walls, &RoutesOptions { routes: more, stops, ..RoutesOptions::default() })
            .unwrap();
    let mut seen: Vec<(u32, f64, Vec2, Vec2)> = Vec::new();
    let walked = walk.run(|frame| {
        for walker in &frame.walkers {
            seen.push((walker.id, frame.time_s, walker.position_m, walker.heading.unwrap()));
        }
    });
    let mut stood = 0;
    for visit in &walked.visits {
        let while_served =
            || seen.iter().filter(|s| s.0 == visit.id && s.1 > visit.begun_s + 3.0 && s.1 < visit.left_s - 0.2);
        let middle = while_served().fold(Vec2::ZERO, |sum, s| sum + s.2) / while_served().count() as f64;
        for (id, time_s, place_m, heading) in while_served() {
            assert!(place_m.distance(middle) < 0.1, "person {id} strays at {time_s} s: {place_m:?} {middle:?}");
            assert!(place_m.distance(vec2(10.0, 11.2)) < 0.25, "person {id} stands at {place_m:?}");
            assert!(heading.y > 0.94, "person {id} faces {heading:?} at {time_s} s");
            stood += 1;
        }
    }
    assert!(walked.visits.len() > 10 && stood > 500, "{} {stood}", walked.visits.len());
    assert_eq!(walked.tally.arrived, 60, "{:?}", walked.tally);
}

#[test]
fn whoever_leaves_does_not_push_through_the_line() {
    let mut frames: Vec<Frame> = Vec::new();
    let walked = at_the_counter(counter(Distribution::Constant(6.0)), 30, 60.0).run(|frame| frames.push(frame.clone()));
    let mut looked_at = 0;
    for visit in &walked.visits {
        let after = frames.iter().filter(|f| f.time_s > visit.left_s && f.time_s < visit.left_s + 8.0);
        for frame in after {
            let Some(own) = frame.walkers.iter().find(|w| w.id == visit.id) else { continue };
            for other in frame.walkers.iter().filter(|w| w.id != visit.id && w.velocity_m_s.length() < 0.05) {
                let distance_m = own.position_m.distance(other.position_m);
                assert!(distance_m > 0.4, "{} comes within {distance_m} of {}", own.id, other.id);
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 1000, "{looked_at}");
}

#[test]
fn only_a_share_of_the_people_stops() {
    let board = StopRequest {
        dwell: Some(Distribution::Constant(3.0)),
        facing: Some(PlanPoint::Metres([10.0, 12.0])),
        reach: Some(2.5),
        ..stop("board", StopKind::Place, [10.0, 9.0])
    };
    let routes = vec![route("west", "east", vec![to_stop("board", 0.3)])];
    let walk = Walk::new(hall(20.0, 12.0, |_| false), vec![board], routes, commuters(300, 400.0));
    let walked = walk.run(|_| {});
    let share = walked.visits.len() as f64 / 300.0;
    assert!((share - 0.3).abs() < 3.0 * (0.3f64 * 0.7 / 300.0).sqrt(), "{share}");
    assert_eq!(walked.tally.arrived, 300);
}

#[test]
fn people_spread_over_a_place_and_face_what_is_there() {
    let board = StopRequest {
        dwell: Some(Distribution::Constant(20.0)),
        facing: Some(PlanPoint::Metres([10.0, 12.0])),
        reach: Some(2.5),
        ..stop("board", StopKind::Place, [10.0, 9.0])
    };
    let routes = vec![route("west", "east", vec![to_stop("board", 1.0)])];
    let walk = Walk::new(hall(20.0, 12.0, |_| false), vec![board], routes, commuters(60, 120.0));
    let mut frames: Vec<Frame> = Vec::new();
    let walked = walk.run(|frame| frames.push(frame.clone()));
    assert_eq!(walked.tally.arrived, 60, "{:?}", walked.tally);
    let (mut stood, mut least_m) = (Vec::new(), f64::INFINITY);
    for visit in &walked.visits {
        let middle_s = 0.5 * (visit.begun_s + visit.left_s);
        let frame = frames.iter().find(|f| f.time_s >= middle_s).unwrap();
        let own = frame.walkers.iter().find(|w| w.id == visit.id).unwrap();
        assert!(own.position_m.distance(vec2(10.0, 9.0)) < 2.8, "{:?}", own.position_m);
        let facing = (vec2(10.0, 12.0) - own.position_m).normalized().unwrap();
        // Whoever was pushed walks back, and faces that way meanwhile.
        if own.velocity_m_s.length() > 0.02 {
            continue;
        }
        assert!(own.heading.unwrap().dot(facing) > 0.9, "{own:?} {visit:?}");
        stood.push(own.position_m);
        for other in frame.walkers.iter().filter(|w| w.id != visit.id && w.velocity_m_s.length() < 0.02) {
            least_m = least_m.min(other.position_m.distance(own.position_m));
        }
    }
    assert!(least_m > 0.45, "{least_m}");
    assert!(stood.len() > 40, "only {} of 60 stood still", stood.len());
    let spread = mean(stood.iter().map(|p| p.distance(vec2(10.0, 9.0))));
    assert!(spread > 0.8, "people stand within {spread} m on average");
}

#[test]
fn benches_seat_as_many_as_they_have_seats_and_face_the_room() {
    let bench = StopRequest {
        at: StopAt::Line([PlanPoint::Metres([9.0, 11.3]), PlanPoint::Metres([11.4, 11.3])]),
        dwell: Some(Distribution::Constant(60.0)),
        ..stop("bench", StopKind::Bench, [0.0, 0.0])
    };
    let routes = vec![route("west", "east", vec![to_stop("bench", 1.0)])];
    let walk = Walk::new(hall(20.0, 12.0, |_| false), vec![bench], routes, commuters(8, 10.0));
    let mut seated = 0;
    let walked = walk.run(|frame| {
        if (frame.time_s - 55.0).abs() < 0.05 {
            let at_wall = frame.walkers.iter().filter(|w| w.position_m.y > 11.1 && w.velocity_m_s.length() < 0.02);
            for walker in at_wall {
                seated += 1;
                assert!(walker.heading.unwrap().y < -0.9, "{walker:?}");
                let seat = (walker.position_m.x - 9.0) / 0.6;
                assert!((seat - seat.round()).abs() < 0.2, "{walker:?}");
            }
        }
    });
    assert_eq!((seated, walked.tally.arrived), (5, 8));
    let warnings = walked.tally.describe(&walk.routes, None);
    assert_eq!(warnings, ["8 people were at \"bench\" at once, there is room for 5"]);
}

/// Three aisles of 0.9 m through a barrier.
fn station() -> FloorPlan {
    hall(24.0, 12.0, |p| {
        let cabinet = [[0.0, 4.5], [5.4, 5.7], [6.6, 6.9], [7.8, 12.0]].iter().any(|y| (y[0]..y[1]).contains(&p.y));
        (11.0..12.8).contains(&p.x) && cabinet
    })
}

#[test]
fn ticket_gates_let_people_through_one_by_one() {
    let gates = StopRequest {
        at: StopAt::Line([PlanPoint::Metres([10.6, 4.95]), PlanPoint::Metres([10.6, 7.35])]),
        places: Some(3),
        dwell: Some(Distribution::Constant(2.0)),
        ..stop("gates", StopKind::Gate, [0.0, 0.0])
    };
    let routes = vec![route("west", "east", vec![to_stop("gates", 1.0)])];
    let walk = Walk::new(station(), vec![gates], routes, commuters(110, 60.0));
    let walked = walk.run(|_| {});
    assert_eq!((walked.visits.len(), walked.tally.arrived), (110, 110), "{:?}", walked.tally);
    let mut ends: Vec<f64> = walked.visits.iter().map(|visit| visit.left_s).collect();
    ends.sort_by(f64::total_cmp);
    let rate = 55.0 / (ends[80] - ends[25]);
    assert!((rate / 1.5 - 1.0).abs() < 0.1, "{rate} a second instead of 1.5");
}

/// Everything of every frame, folded into one number.
fn fingerprint(walk: &Walk, threads: usize) -> u64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut hash = 0xcbf2_9ce4_8422_2325u64;
        let mut most = 0;
        walk.run(|frame| {
            most = most.max(frame.walkers.len());
            for walker in &frame.walkers {
                let heading = walker.heading.unwrap();
                for bits in [walker.position_m.x, walker.position_m.y, heading.x, heading.y].map(f64::to_bits) {
                    hash = (hash ^ bits ^ u64::from(walker.id)).wrapping_mul(0x0000_0100_0000_01b3);
                }
            }
        });
        assert!(most > 280, "only {most} at once: too few for more than one thread");
        hash
    })
}

#[test]
fn the_same_frames_on_any_number_of_threads() {
    let stops = vec![
        StopRequest { places: Some(4), ..counter(Distribution::normal(4.0, 1.0, 2.0, 6.0)) },
        StopRequest { reach: Some(3.0), ..stop("board", StopKind::Place, [22.0, 12.0]) },
    ];
    let routes = vec![
        route("west", "east", vec![to_stop("counter", 0.2), to_stop("board", 0.3)]),
        route("east", "west", vec![to_stop("board", 0.3), to_stop("counter", 0.1)]),
    ];
    let walk = Walk::new(hall(30.0, 20.0, |_| false), stops, routes, commuters(500, 40.0));
    let once = fingerprint(&walk, 1);
    assert_eq!(once, fingerprint(&walk, 1), "another run");
    assert_eq!(once, fingerprint(&walk, 3), "on three threads");
}

#[test]
fn half_the_time_step_leaves_the_waiting_as_it_is() {
    let waits = [0.1, 0.05].map(|time_step| {
        let mut walk = at_the_counter(counter(Distribution::normal(5.0, 2.0, 1.0, 10.0)), 80, 300.0);
        walk.options.time_step = time_step;
        let walked = walk.run(|_| {});
        mean(walked.visits.iter().map(|visit| visit.begun_s - visit.came_s))
    });
    assert!((waits[1] / waits[0] - 1.0).abs() < 0.03, "{waits:?}");
    assert!(waits[0] > 10.0, "{waits:?}: nobody had to wait");
}

#[test]
fn more_people_than_the_line_has_room_for_wait_in_a_loose_crowd() {
    // A corridor of 3 m with the counter at its end; the way out is beside it.
    let plan = hall(14.0, 3.6, |_| false);
    let counter = StopRequest {
        dwell: Some(Distribution::Constant(4.0)),
        queue: [[12.0, 1.2], [10.0, 1.2]].map(PlanPoint::Metres).to_vec(),
        heading_deg: Some(0.0),
        ..stop("ticket office", StopKind::Queue, [12.8, 1.2])
    };
    let routes = vec![route("west", "east", vec![to_stop("ticket office", 1.0)])];
    let walk = Walk::new(plan, vec![counter], routes, commuters(30, 20.0));
    let mut least_m = f64::INFINITY;
    let walked = walk.run(|frame| {
        for (n, a) in frame.walkers.iter().enumerate() {
            let standing = |w: &trodden::motion::Walker| w.velocity_m_s.length() < 0.02;
            for b in frame.walkers[..n].iter().filter(|b| standing(a) && standing(b)) {
                least_m = least_m.min(a.position_m.distance(b.position_m));
            }
        }
    });
    assert_eq!(walked.tally.arrived, 30, "{:?}", walked.tally);
    let warnings = walked.tally.describe(&walk.routes, None);
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert!(warning.starts_with("the line at \"ticket office\" reached "), "{warning}");
    assert!(warning.ends_with(" people, there is room for 3"), "{warning}");
    assert!(least_m > 0.25, "{least_m}");
}

#[test]
fn a_stop_that_nobody_can_reach_ends_by_itself_and_says_who_and_where() {
    let plan = hall(20.0, 12.0, |p| {
        let closet = (14.0..18.0).contains(&p.x) && (7.0..11.0).contains(&p.y);
        closet && !((14.3..17.7).contains(&p.x) && (7.3..10.7).contains(&p.y))
    });
    let mut walk = at_the_counter(counter(Distribution::Constant(5.0)), 10, 10.0);
    walk.plan = plan;
    walk.walls = Walls::trace(&walk.plan, &WallsOptions::default());
    let routes = vec![route("west", "east", Vec::new())];
    let mut found =
        routes::find(&walk.plan, &walk.walls, &RoutesOptions { routes, ..RoutesOptions::default() }).unwrap();
    found[0].stops = walk.routes[0].stops.clone();
    found[0].stops[0].stop.places_m = vec![vec2(16.0, 9.0)];
    walk.routes = found;
    walk.options.patience_seconds = 20.0;
    let walked = walk.run(|_| {});
    assert_eq!(walked.tally.stuck.len(), 10, "{:?}", walked.tally);
    assert!(walked.end_s < 200.0, "{}", walked.end_s);
    let said = walked.tally.describe(&walk.routes, None);
    assert!(
        said[..5].iter().all(|line| line.contains("for the stop \"counter\"") && line.contains("got stuck at [")),
        "{said:?}"
    );
}

fn refused(plan: &FloorPlan, stops: Vec<StopRequest>, via: Vec<ViaRequest>) -> (String, String) {
    let walls = Walls::trace(plan, &WallsOptions::default());
    let options = RoutesOptions { routes: vec![route("west", "east", via)], stops, ..RoutesOptions::default() };
    let error: RoutesError = routes::find(plan, &walls, &options).unwrap_err();
    (error.to_string(), error.hint().unwrap_or_default())
}

#[test]
fn stops_that_cannot_be_are_refused_with_their_name_and_place() {
    let closet = hall(20.0, 12.0, |p| {
        let wall = (14.0..18.0).contains(&p.x) && (7.0..11.0).contains(&p.y);
        wall && !((14.3..17.7).contains(&p.x) && (7.3..10.7).contains(&p.y))
    });
    let to = || vec![to_stop("counter", 1.0)];
    let at = |at: [f64; 2]| vec![stop("counter", StopKind::Queue, at)];
    let (message, hint) = refused(&closet, at([10.0, 13.5]), to());
    assert_eq!(
        message.split("; the nearest").next().unwrap(),
        "stop \"counter\": at: there is no floor to stand on at [10.00, 13.50]"
    );
    assert!(hint.starts_with("use [9.95, 11."), "{hint}");
    let (message, _) = refused(&closet, at([16.0, 9.0]), to());
    assert!(message.contains("no way leads to the stop \"counter\" at [16.00, 9.00]"), "{message}");
    let (message, hint) = refused(&closet, at([10.0, 11.0]), vec![to_stop("conter", 1.0)]);
    assert!(message.contains("there is no stop called \"conter\""), "{message}");
    assert_eq!(hint, "did you mean \"counter\"?");
    let (message, _) = refused(&closet, at([10.0, 11.0]), vec![to_stop("counter", 1.5)]);
    assert!(message.contains("share 1.5"), "{message}");
    let (message, _) = refused(&closet, [at([10.0, 11.0]), at([8.0, 11.0])].concat(), to());
    assert!(message.contains("two stops called \"counter\""), "{message}");
    let base = stop("counter", StopKind::Queue, [10.0, 11.0]);
    let dwell = |dwell| StopRequest { dwell: Some(dwell), ..base.clone() };
    let line = [[13.0, 9.0], [19.0, 9.0]].map(PlanPoint::Metres).to_vec();
    for (wrong, part) in [
        (dwell(Distribution::Constant(f64::NAN)), "`dwell`: it is NaN"),
        (dwell(Distribution::Constant(-3.0)), "`dwell`: it can be as small as -3"),
        (StopRequest { places: Some(0), ..base.clone() }, "`places` is 0"),
        (StopRequest { spacing: Some(f64::NAN), ..base.clone() }, "`spacing` is NaN"),
        (
            StopRequest { at: StopAt::Point(PlanPoint::Metres([f64::NAN, 1.0])), ..base.clone() },
            "a coordinate is NaN m",
        ),
        (
            StopRequest { queue: line, ..base.clone() },
            "the line crosses a wall between [13.00, 9.00] and [19.00, 9.00]",
        ),
        (StopRequest { heading_deg: Some(1e9), ..base.clone() }, "`heading_deg` is 1000000000"),
    ] {
        let (message, _) = refused(&closet, vec![wrong], to());
        assert!(message.contains("stop \"counter\"") && message.contains(part), "{message}");
    }
}

#[test]
fn starts_and_goals_in_rooms_work_with_stops() {
    let plan = hall(20.0, 12.0, |p| (9.8..10.2).contains(&p.x) && !(5.4..6.6).contains(&p.y));
    let area = |a: [f64; 2], b: [f64; 2]| PlaceRequest::Area([a, b]);
    let there = RouteRequest {
        from: area([1.0, 8.0], [4.0, 11.0]),
        to: area([15.0, 1.0], [19.0, 4.0]),
        ..route(
            "west",
            "east",
            vec![to_stop("counter", 1.0), area([7.0, 2.0], [8.5, 4.0]).into(), to_stop("bench", 1.0)],
        )
    };
    let stops = vec![
        StopRequest { dwell: Some(Distribution::Constant(3.0)), ..stop("counter", StopKind::Machine, [6.0, 11.2]) },
        StopRequest {
            dwell: Some(Distribution::Constant(5.0)),
            places: Some(6),
            ..stop("bench", StopKind::Bench, [14.0, 11.3])
        },
    ];
    let walk = Walk::new(plan, stops, vec![there], commuters(40, 200.0));
    let walked = walk.run(|_| {});
    assert_eq!((walked.tally.arrived, walked.visits.len()), (40, 80), "{:?}", walked.tally);
    for visit in walked.visits.iter().filter(|visit| visit.stop == 1) {
        let before = walked.visits.iter().find(|other| other.id == visit.id && other.stop == 0).unwrap();
        // The place to pass lies between.
        assert!(visit.came_s > before.left_s + 5.0, "{before:?} {visit:?}");
    }
}

#[test]
fn people_come_by_timetables() {
    let bursts = Timetable {
        kind: TimetableKind::Bursts,
        first_s: Some(20.0),
        every_s: Some(120.0),
        people: Some(30),
        spread_s: Some(10.0),
        ..Timetable::default()
    };
    let list = Timetable { kind: TimetableKind::List, times: vec![[60.0, 7.0], [200.0, 11.0]], ..Timetable::default() };
    let there = RouteRequest { arrivals: Some(list), share: 0.1, ..route("west", "east", Vec::new()) };
    let back = route("east", "west", Vec::new());
    let mut walk = Walk::new(hall(20.0, 12.0, |_| false), Vec::new(), vec![there, back], commuters(100, 1.0));
    walk.options.arrivals = bursts;
    let people = People::new(1, BodyOptions::default());
    let arrivals = walk.crowd(&people).arrivals().to_vec();
    assert!(arrivals.iter().enumerate().all(|(id, arrival)| arrival.id as usize == id));
    assert!(arrivals.windows(2).all(|pair| pair[0].time_s <= pair[1].time_s));
    let of = |route: usize| arrivals.iter().filter(move |arrival| arrival.route == route);
    assert_eq!(of(0).filter(|a| a.time_s == 60.0).count(), 7);
    assert_eq!((of(0).filter(|a| a.time_s == 200.0).count(), of(0).count()), (11, 18));
    for (burst, count) in [30, 30, 22].into_iter().enumerate() {
        let from = 20.0 + 120.0 * burst as f64;
        assert_eq!(of(1).filter(|a| (from..from + 10.0).contains(&a.time_s)).count(), count);
    }
    // And so they enter.
    let mut entered = Vec::new();
    let walked = walk.run(|frame| {
        for walker in &frame.walkers {
            if !entered.iter().any(|&(id, _)| id == walker.id) {
                entered.push((walker.id, frame.time_s));
            }
        }
    });
    assert_eq!(walked.tally.arrived, 100);
    for (id, time_s) in entered {
        let late_s = time_s - arrivals[id as usize].time_s;
        assert!((0.0..15.0).contains(&late_s), "person {id} is {late_s} s late");
    }
}

#[test]
fn people_come_in_for_a_stop_and_go_out_again() {
    let dwell = Some(Distribution::Constant(3.0));
    let machine = StopRequest { dwell, ..stop("machine", StopKind::Machine, [10.0, 11.2]) };
    let routes = vec![route("west", "west", vec![to_stop("machine", 1.0)])];
    let walk = Walk::new(hall(20.0, 12.0, |_| false), vec![machine], routes, commuters(30, 200.0));
    let walked = walk.run(|_| {});
    assert_eq!((walked.tally.arrived, walked.visits.len()), (30, 30), "{:?}", walked.tally);
}

#[test]
fn a_line_in_a_corridor_bends_and_leaves_a_passage() {
    let plan = hall(24.0, 3.6, |_| false);
    let window =
        StopRequest { dwell: Some(Distribution::Constant(10.0)), ..stop("window", StopKind::Queue, [12.0, 2.8]) };
    let routes = vec![
        RouteRequest { share: 0.5, ..route("west", "east", vec![to_stop("window", 1.0)]) },
        RouteRequest { share: 0.5, ..route("east", "west", Vec::new()) },
    ];
    let walk = Walk::new(plan, vec![window], routes, commuters(40, 60.0));
    let mut looked_at = 0;
    let walked = walk.run(|frame| {
        let standing: Vec<Vec2> =
            frame.walkers.iter().filter(|w| w.velocity_m_s.length() < 0.01).map(|w| w.position_m).collect();
        if standing.len() > 8 && frame.time_s > 70.0 {
            looked_at += 1;
            // The wall opposite is at 0.3 m.
            assert!(standing.iter().all(|p| p.y > 1.3), "{} s: {standing:?}", frame.time_s);
            let reach_m = standing.iter().map(|p| (p.x - 12.0).abs()).fold(0.0, f64::max);
            assert!(reach_m > 3.5, "{standing:?}");
        }
    });
    assert!(looked_at > 100, "{looked_at}");
    assert_eq!(walked.tally.arrived, 40, "{:?}", walked.tally);
}
