//! Tests of requested and default routes.

use super::*;
use crate::math::vec2;
use crate::plan::{FloorPlan, PlanPoint};
use crate::walls::{Walls, WallsOptions};

/// A plan drawn with characters: `.` is floor, others are wall; 1 m per character.
fn plan(rows: &[&str]) -> FloorPlan {
    // Four pixels per metre, so that walls are thinner than paths.
    let (width, height) = (rows[0].len() * 4, rows.len() * 4);
    let floor = (0..width * height).map(|i| u8::from(rows[i / width / 4].as_bytes()[i % width / 4] == b'.')).collect();
    FloorPlan::from_mask(width as u32, height as u32, 0.25, floor)
}

fn found(rows: &[&str], routes: Vec<RouteRequest>) -> Result<Vec<Route>, RoutesError> {
    let plan = plan(rows);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    find(&plan, &walls, &RoutesOptions { routes, ..RoutesOptions::default() })
}

fn opening(name: &str) -> PlaceRequest {
    PlaceRequest::Opening(name.into())
}

fn point(x: f64, y: f64) -> PlaceRequest {
    PlaceRequest::Point(PlanPoint::Metres([x, y]))
}

fn route(from: PlaceRequest, to: PlaceRequest) -> RouteRequest {
    RouteRequest { name: None, from, to, via: Vec::new(), arrivals: None, share: 1.0 }
}

const CORRIDOR: [&str; 5] = ["############", "............", "............", "............", "############"];

#[test]
fn gates_of_a_corridor_lie_across_it_and_span_its_usable_width() {
    let routes = found(&CORRIDOR, vec![route(opening("west"), opening("east"))]).expect("a way");
    assert_eq!((routes.len(), routes[0].name.as_str(), routes[0].share), (1, "west to east", 1.0));
    assert!(routes[0].gates.len() >= 4);
    for gate in &routes[0].gates {
        assert!(gate.left_m.y > gate.right_m.y, "left of those who walk east is north: {gate:?}");
        assert!((gate.left_m.x - gate.right_m.x).abs() < 0.1, "{gate:?}");
        assert!((gate.width_m() - 2.68).abs() < 0.1, "3 m less 0.16 m on either side: {gate:?}");
    }
    // Aprons included, without their parts beyond start and goal.
    assert!((routes[0].length_m - 17.5).abs() < 0.6, "{}", routes[0].length_m);
}

#[test]
fn openings_are_joined_in_all_pairs_but_never_by_more_than_twelve_routes() {
    assert_eq!(found(&CORRIDOR, Vec::new()).expect("routes").len(), 2);
    let star = ["#.#.#.#.###", "...........", "...........", "#.#.#######"];
    let routes = found(&star, Vec::new()).expect("routes");
    assert_eq!(routes.len(), 12);
    let shares: f64 = routes.iter().map(|r| r.share).sum();
    assert!((shares - 1.0).abs() < 1e-9, "{shares}");
}

#[test]
fn in_a_closed_floor_places_far_apart_stand_in() {
    let rooms =
        ["##############", "#....#.......#", "#....#.......#", "#............#", "#....#.......#", "##############"];
    let routes = found(&rooms, Vec::new()).expect("routes");
    assert!(routes.len() >= 2 && routes.len() <= 12);
    let longest = routes.iter().map(|r| r.length_m).fold(0.0, f64::max);
    assert!(longest > 6.0, "{longest}");
}

#[test]
fn a_way_through_a_place_between_has_a_gate_there() {
    let mut request = route(opening("west"), opening("east"));
    request.via = vec![ViaRequest::Place(point(6.0, 2.0))];
    let routes = found(&CORRIDOR, vec![request]).expect("a way");
    let via = routes[0].via[0];
    // A point stands for a square of 2 m; entering it counts as reaching it.
    let gate = routes[0].gates[via.gate].at(0.5);
    assert!((gate.x - 5.0).abs() < 0.3 && (gate.y - 2.5).abs() < 0.3, "{gate:?}");
}

#[test]
fn shares_are_relative() {
    let mut there = route(opening("west"), opening("east"));
    there.share = 3.0;
    let back = route(opening("east"), opening("west"));
    let routes = found(&CORRIDOR, vec![there, back]).expect("ways");
    assert_eq!([routes[0].share, routes[1].share], [0.75, 0.25]);
}

#[test]
fn an_unknown_opening_suggests_the_nearest_name() {
    let error = found(&CORRIDOR, vec![route(opening("wets"), opening("east"))]).expect_err("no such opening");
    assert!(error.to_string().contains("\"wets\""), "{error}");
    assert_eq!(error.hint().as_deref(), Some("did you mean \"west\"?"));
}

#[test]
fn a_point_inside_a_wall_names_the_nearest_floor_in_metres_and_pixels() {
    let error = found(&CORRIDOR, vec![route(point(6.0, 4.6), opening("east"))]).expect_err("inside a wall");
    let message = error.to_string();
    assert!(message.contains("from [6, 4.6] (px [24, 2]) is not on floor"), "{message}");
    assert!(error.hint().unwrap_or_default().contains("px"), "{:?}", error.hint());
    let RoutesError::NotOnFloor { nearest: Some(nearest), role: "from", .. } = error else { panic!("{message}") };
    assert!(nearest.at_m.distance(vec2(6.0, 3.8)) < 0.2, "{nearest:?}");
    assert!((nearest.at_px[0] - nearest.at_m.x * 4.0).abs() < 1e-9 && nearest.part_m2 > 40.0, "{nearest:?}");
}

#[test]
fn an_area_partly_off_the_floor_counts_where_it_is_floor() {
    let request = |y: [f64; 2]| route(PlaceRequest::Area([[2.0, y[0]], [4.0, y[1]]]), opening("east"));
    let routes = found(&CORRIDOR, vec![request([3.0, 9.0])]).expect("a third of a metre of floor");
    assert!(routes[0].gates[0].at(0.5).y < 4.0);
    let error = found(&CORRIDOR, vec![request([4.3, 9.0])]).expect_err("nothing but wall");
    assert!(matches!(error, RoutesError::NotOnFloor { .. }), "{error}");
}

#[test]
fn a_goal_that_walls_enclose_names_the_route_and_both_places() {
    let split = ["#############", "......#......", "......#......", "#############"];
    let error = found(&split, vec![route(opening("west"), opening("east"))]).expect_err("a wall between");
    let message = error.to_string();
    assert!(message.contains("\"west to east\": no way leads from west, [-"), "{message}");
    let RoutesError::Unreachable { from, to, gap: None, .. } = error else { panic!("{message}") };
    // 6 x 2 m and an apron of 3 x 2 m, minus a strip along the walls.
    assert!(from.part_m2 > 13.0 && from.part_m2 < 18.0 && to.part_m2 > 13.0 && to.part_m2 < 18.0, "{message}");
    assert!((from.at_px[0] - from.at_m.x * 4.0).abs() < 1e-9, "{message}");

    let enclosed =
        ["#########", ".........", ".........", "..#####..", "..#...#..", "..#...#..", "..#####..", "........."];
    let plan = plan(&enclosed);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let routes = vec![route(opening("west"), point(4.5, 3.0))];
    let error =
        find(&plan, &walls, &RoutesOptions { routes, ..RoutesOptions::default() }).expect_err("walls all around");
    let RoutesError::Unreachable { to, gap: None, .. } = error else { panic!("{error}") };
    assert!(to.part_m2 > 2.0 && to.part_m2 < 6.0, "{to}");
}

#[test]
fn a_door_of_30_cm_is_named_as_what_is_too_narrow() {
    let (width, height) = (120usize, 40usize);
    // 0.1 m per pixel; a wall at x = 6 m with a door of 0.3 m around y = 2.05 m.
    let is_floor = |x: usize, y: usize| {
        let border = !(2..38).contains(&y);
        let wall = (60..62).contains(&x) && !(18..21).contains(&y);
        !border && !wall
    };
    let mask = (0..width * height).map(|i| u8::from(is_floor(i % width, i / width))).collect();
    let plan = FloorPlan::from_mask(width as u32, height as u32, 0.1, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let routes = vec![route(opening("west"), opening("east"))];
    let error =
        find(&plan, &walls, &RoutesOptions { routes, ..RoutesOptions::default() }).expect_err("nobody fits through");
    let message = error.to_string();
    let RoutesError::Unreachable { gap: Some(gap), .. } = &error else { panic!("{message}") };
    assert!(gap.at_m.distance(vec2(6.1, 2.05)) < 0.3 && (gap.width_m - 0.3).abs() < 0.11, "{gap:?}");
    assert!(message.contains("m wide at [") && message.contains("(px ["), "{message}");
    assert!(error.hint().unwrap_or_default().contains("widen it"), "{:?}", error.hint());
}

#[test]
fn coordinates_that_are_no_numbers_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let error = found(&CORRIDOR, vec![route(point(bad, 2.0), opening("east"))]).expect_err("not a number");
        assert!(matches!(error, RoutesError::TooFar { .. }), "{error}");
        let area = PlaceRequest::Area([[0.0, 0.0], [bad, 1.0]]);
        assert!(found(&CORRIDOR, vec![route(area, opening("east"))]).is_err());
    }
    let mut request = route(opening("west"), opening("east"));
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        request.share = bad;
        assert!(matches!(found(&CORRIDOR, vec![request.clone()]), Err(RoutesError::Share { .. })));
    }
    request.share = 0.0;
    assert!(matches!(found(&CORRIDOR, vec![request]), Err(RoutesError::NoShares { .. })));
}

#[test]
fn start_and_goal_in_one_place_are_refused() {
    let error = found(&CORRIDOR, vec![route(opening("west"), opening("West"))]).expect_err("no way to go");
    assert!(matches!(error, RoutesError::NoLength { .. }), "{error}");
}

#[test]
fn a_large_floor_with_a_narrow_door_is_measured_more_finely() {
    // 130 x 130 m give cells of 0.2 m; a door of 0.5 m needs finer ones.
    let (pixels, metres_per_pixel) = (1040usize, 0.125);
    let wall = |x: usize, y: usize| {
        let border = y < 4 || y >= pixels - 4;
        let between = (520..522).contains(&x) && !(501..505).contains(&y);
        border || between
    };
    let floor = (0..pixels * pixels).map(|i| u8::from(!wall(i % pixels, i / pixels))).collect();
    let plan = FloorPlan::from_mask(pixels as u32, pixels as u32, metres_per_pixel, floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let options = RoutesOptions { routes: vec![route(opening("west"), opening("east"))], ..RoutesOptions::default() };
    let routes = find(&plan, &walls, &options).expect("a way through the door");
    assert!(Navigation::new(&plan, &walls, &routes).is_ok());
}

#[test]
fn requests_are_read_from_toml() {
    let text = r#"
        [[routes]]
        name = "in"
        from = "west"
        to = [3.0, 2.5]
        via = [{ px = [4, 9] }, [[1.0, 1.0], [2.0, 2.0]]]
    "#;
    let options: RoutesOptions = crate::options::parse(text).ok().expect("valid");
    let request = &options.routes[0];
    assert_eq!(request.share, 1.0);
    assert_eq!(request.to, point(3.0, 2.5));
    assert_eq!(request.via[0], ViaRequest::Place(PlaceRequest::Point(PlanPoint::Pixels { px: [4.0, 9.0] })));
    assert_eq!(request.via[1], ViaRequest::Place(PlaceRequest::Area([[1.0, 1.0], [2.0, 2.0]])));
    let wrong = "[[routes]]\nfrom = 3\nto = \"west\"";
    let error = crate::options::parse::<RoutesOptions>(wrong).expect_err("a number is no place").explain(wrong).0;
    assert!(error.contains("an opening's name, a point"), "{error}");
}
