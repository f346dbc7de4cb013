use super::super::{Walls, WallsOptions};
use super::*;
use crate::math::{sin_cos, vec2};
use crate::plan::FloorPlan;

/// Side of a pixel of the drawings, metres.
const PX_M: f64 = 0.05;

/// A plan with floor where no wall is; sizes in metres.
fn drawn(size_m: [f64; 2], is_wall: impl Fn(Vec2) -> bool) -> Walls {
    let [width, height] = size_m.map(|m| (m / PX_M).round() as usize);
    let mut floor = Vec::with_capacity(width * height);
    for row in 0..height {
        for column in 0..width {
            let at = vec2((column as f64 + 0.5) * PX_M, (height as f64 - row as f64 - 0.5) * PX_M);
            floor.push(u8::from(!is_wall(at)));
        }
    }
    let plan = FloorPlan::from_mask(width as u32, height as u32, PX_M, floor);
    Walls::trace(&plan, &WallsOptions::default())
}

fn within(p: Vec2, min: [f64; 2], max: [f64; 2]) -> bool {
    p.x >= min[0] && p.x < max[0] && p.y >= min[1] && p.y < max[1]
}

/// Two rooms of 5 x 6 m in a wall of 0.2 m. The wall between them, at x = 5, is open from `from_m` to `to_m`.
fn two_rooms(thickness_m: f64, gaps: &'static [[f64; 2]]) -> Walls {
    drawn([10.0, 6.0], move |p| {
        let around = !within(p, [0.2, 0.2], [9.8, 5.8]);
        let between = (p.x - 5.0).abs() < 0.5 * thickness_m && !gaps.iter().any(|gap| p.y >= gap[0] && p.y < gap[1]);
        around || between
    })
}

fn assert_door(door: &Doorway, middle: [f64; 2], width_m: f64, depth_m: f64) {
    let found = door.jambs_m[0].lerp(door.jambs_m[1], 0.5);
    assert!(found.distance(vec2(middle[0], middle[1])) < 0.06, "middle at {found:?}");
    assert!((door.width_m() - width_m).abs() < 0.06, "width {}", door.width_m());
    assert!((door.depth_m - depth_m).abs() < 0.11, "depth {}", door.depth_m);
    let across = (door.jambs_m[1] - door.jambs_m[0]).normalized().unwrap();
    assert!(across.dot(door.through).abs() < 1e-9 && (door.through.length() - 1.0).abs() < 1e-9);
}

#[test]
fn a_door_in_a_thin_or_a_thick_wall_is_found_once() {
    for thickness_m in [0.1, 0.2, 0.4, 0.6] {
        let walls = two_rooms(thickness_m, &[[2.5, 3.4]]);
        let doors = walls.doorways();
        assert_eq!(doors.len(), 1, "{thickness_m}: {doors:?}");
        assert_door(&doors[0], [5.0, 2.95], 0.9, thickness_m);
        for (jamb, (face, along_m)) in doors[0].jambs_m.iter().zip(doors[0].on_faces) {
            let on = walls.nearest(*jamb, 0.01).unwrap();
            assert_eq!(on.face, Some(face));
            assert!((on.along_m - along_m).abs() < 0.01);
        }
    }
}

#[test]
fn doors_are_0_7_to_2_metres_wide() {
    let count = |gaps: &'static [[f64; 2]]| two_rooms(0.2, gaps).doorways().len();
    assert_eq!(count(&[[2.0, 2.5]]), 0);
    assert_eq!(count(&[[2.0, 2.7]]), 1);
    assert_eq!(count(&[[2.0, 4.0]]), 1);
    assert_eq!(count(&[[2.0, 4.3]]), 0);
    assert_eq!(count(&[[0.8, 1.7], [4.0, 4.9]]), 2);
}

#[test]
fn a_door_beside_the_corner_of_a_room_is_found() {
    let doors = two_rooms(0.2, &[[0.2, 1.1]]).doorways();
    assert_eq!(doors.len(), 1, "{doors:?}");
    assert_door(&doors[0], [5.0, 0.65], 0.9, 0.2);
}

#[test]
fn a_double_door_may_have_a_post() {
    let doors = two_rooms(0.1, &[[2.0, 3.0], [3.1, 4.1]]).doorways();
    assert_eq!(doors.len(), 2, "{doors:?}");
    // A post with a wider gap than a door on its other side is an obstacle.
    assert_eq!(two_rooms(0.1, &[[1.0, 2.0], [2.1, 5.0]]).doorways().len(), 0);
}

#[test]
fn oblique_doors_are_found() {
    for degrees in [10.0, 30.0, 45.0, 73.0_f64] {
        let (sin, cos) = sin_cos(degrees.to_radians());
        let walls = drawn([10.0, 10.0], |p| {
            let own = (p - vec2(5.0, 5.0)).rotated(vec2(cos, -sin));
            let between = own.y.abs() < 0.1 && !(-0.3..0.8).contains(&own.x);
            between || !within(p, [0.2, 0.2], [9.8, 9.8])
        });
        let doors = walls.doorways();
        assert_eq!(doors.len(), 1, "{degrees}: {doors:?}");
        let middle = vec2(5.0, 5.0) + vec2(0.25, 0.0).rotated(vec2(cos, sin));
        assert!(doors[0].jambs_m[0].lerp(doors[0].jambs_m[1], 0.5).distance(middle) < 0.08);
        assert!((doors[0].width_m() - 1.1).abs() < 0.1, "{degrees}: {}", doors[0].width_m());
        assert!(doors[0].through.dot(vec2(-sin, cos)).abs() > 0.98, "{degrees}");
    }
}

#[test]
fn corridors_niches_and_pillars_are_no_doors() {
    // A corridor of 1.5 m that opens into two rooms.
    let corridor = drawn([12.0, 6.0], |p| {
        (p.x > 4.0 && p.x < 8.0 && (p.y - 3.0).abs() > 0.75) || !within(p, [0.2, 0.2], [11.8, 5.8])
    });
    assert_eq!(corridor.doorways(), []);
    // A corridor across the plan.
    let open = drawn([12.0, 3.0], |p| (p.y - 1.5).abs() > 0.75);
    assert_eq!(open.doorways(), []);
    // A pillar a metre from the wall, and four of them.
    let pillars = drawn([8.0, 8.0], |p| {
        let pillar = |x: f64, y: f64| within(p, [x, y], [x + 0.4, y + 0.4]);
        pillar(1.2, 1.2) || pillar(2.6, 1.2) || pillar(4.5, 4.5) || !within(p, [0.2, 0.2], [7.8, 7.8])
    });
    assert_eq!(pillars.doorways(), []);
    // A niche of a metre, 0.4 m deep, and a pier that leaves 1.9 m of a hall's corridor.
    let niche = drawn([8.0, 4.0], |p| {
        let niche = within(p, [3.0, 3.5], [4.0, 3.9]);
        let pier = within(p, [6.0, 0.2], [6.3, 0.4]);
        pier || (!within(p, [0.2, 0.2], [7.8, 3.5]) && !niche)
    });
    assert_eq!(niche.doorways(), []);
}

#[test]
fn shelves_and_doors_on_both_sides_of_a_corridor_make_no_door() {
    let shelves = drawn([8.0, 6.0], |p| {
        let shelf = within(p, [2.0, 1.0], [6.9, 1.4]) || within(p, [2.0, 3.0], [6.9, 3.4]);
        shelf || !within(p, [0.2, 0.2], [7.8, 5.8])
    });
    assert_eq!(shelves.doorways(), []);
    // Two offset doors on either side of a corridor of 1.6 m: no third door between them.
    let corridor = drawn([12.0, 8.0], |p| {
        let wall = (p.y - 4.9).abs() < 0.1 || (p.y - 3.1).abs() < 0.1;
        let doors = within(p, [4.0, 4.7], [4.9, 5.1]) || within(p, [5.2, 2.9], [6.1, 3.3]);
        (wall && !doors) || !within(p, [0.2, 0.2], [11.8, 7.8])
    });
    let found: Vec<Vec2> = corridor.doorways().iter().map(|door| door.jambs_m[0].lerp(door.jambs_m[1], 0.5)).collect();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|at| (at.y - 4.0).abs() > 0.8), "{found:?}");
    // Doors that face each other, more or less, across corridors of 1.2 to 1.8 m.
    for width_m in [1.2, 1.4, 1.6, 1.8] {
        for aside_m in [0.0, 0.2, -0.4, 0.6, -0.8] {
            let corridor = drawn([12.0, 8.0], move |p| {
                let (above, below) = (4.08 + 0.5 * width_m, 3.92 - 0.5 * width_m);
                let wall = (p.y - above).abs() < 0.08 || (p.y - below).abs() < 0.08;
                let from = 5.0 + if p.y > 4.0 { 0.0 } else { aside_m };
                (wall && !(p.x >= from && p.x < from + 0.9)) || !within(p, [0.2, 0.2], [11.8, 7.8])
            });
            let found: Vec<Vec2> =
                corridor.doorways().iter().map(|door| door.jambs_m[0].lerp(door.jambs_m[1], 0.5)).collect();
            let beside = found.iter().filter(|at| (at.y - 4.0).abs() > 0.4 * width_m).count();
            assert_eq!((found.len(), beside), (2, 2), "{width_m} m wide, {aside_m} m aside: {found:?}");
        }
    }
}

#[test]
fn a_door_at_the_edge_of_the_plan_leads_outside() {
    // The outer wall is the edge of the drawing; its door opens on the side.
    let walls = drawn([6.0, 6.0], |p| !within(p, [0.3, 0.3], [5.7, 5.7]) && !within(p, [0.0, 2.0], [0.3, 3.2]));
    let doors = walls.doorways();
    assert_eq!(doors.len(), 1, "{doors:?}");
    assert_door(&doors[0], [0.15, 2.6], 1.2, 0.3);
}

#[test]
fn a_door_may_be_given_where_none_is_found() {
    // A corridor of 1.5 m is not a door.
    let walls = drawn([12.0, 3.0], |p| (p.y - 1.5).abs() > 0.75);
    let door = walls.doorway_at(vec2(6.0, 1.4), 1.5).unwrap();
    assert_door(&door, [6.0, 1.5], 1.5, 0.0);
    assert_eq!(walls.doorway_at(vec2(6.0, 1.5), 0.5), None);
    assert_eq!(walls.doorway_at(vec2(6.0, 0.2), 1.5), None);
    assert_eq!(walls.doorway_at(vec2(f64::NAN, 1.5), 1.5), None);
    assert_eq!(walls.doorway_at(vec2(6.0, 1.5), f64::NAN), None);
}

#[test]
fn corners_turn_inward_or_outward_and_curves_have_none() {
    let room = drawn([6.0, 6.0], |p| !within(p, [0.5, 0.5], [5.5, 5.5]) || within(p, [2.5, 2.5], [3.5, 3.5]));
    let turns = |walls: &Walls| -> Vec<f64> {
        walls.corners().iter().map(|corner| (corner.turn_rad.to_degrees() * 10.0).round() / 10.0).collect()
    };
    assert_eq!(turns(&room), [90.0, 90.0, 90.0, 90.0, -90.0, -90.0, -90.0, -90.0]);
    for corner in room.corners() {
        let near = room.nearest(corner.point_m, 0.01).unwrap();
        assert_eq!(near.face, Some(corner.face));
    }
    // The end of a thin wall is one corner of 180 degrees.
    let stub = drawn([6.0, 6.0], |p| !within(p, [0.5, 0.5], [5.5, 5.5]) || within(p, [0.5, 3.0], [3.0, 3.1]));
    let ends: Vec<Corner> = stub.corners().into_iter().filter(|corner| corner.turn_rad < 0.0).collect();
    assert_eq!(ends.len(), 1, "{ends:?}");
    assert!((ends[0].turn_rad.to_degrees() + 180.0).abs() < 1.0);
    assert!(ends[0].point_m.distance(vec2(3.0, 3.05)) < 0.02);
    // Round rooms and round pillars have no corners.
    for radius_m in [0.25, 0.6, 1.5, 2.7] {
        let round = drawn([6.0, 6.0], |p| p.distance(vec2(3.02, 2.97)) > radius_m);
        assert_eq!(turns(&round), [0.0; 0], "room of {radius_m}");
        let pillar = drawn([6.0, 6.0], |p| p.distance(vec2(3.02, 2.97)) < radius_m);
        assert_eq!(turns(&pillar), [0.0; 0], "pillar of {radius_m}");
    }
    // Steps of an oblique wall are not corners.
    let oblique = drawn([6.0, 6.0], |p| p.y < 2.0 + 0.31 * p.x && p.x > 1.0);
    assert!(turns(&oblique).len() <= 2, "{:?}", turns(&oblique));
}

#[test]
fn a_hundred_thousand_tiny_walls_take_no_time() {
    // Pillars of one pixel, three pixels apart.
    let side = 951usize;
    let mask = (0..side * side).map(|at| u8::from(!(at / side % 3 == 1 && at % side % 3 == 1))).collect();
    let plan = FloorPlan::from_mask(side as u32, side as u32, 0.35, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    assert!(walls.faces.len() > 99_000);
    let start = std::time::Instant::now();
    assert_eq!(walls.doorways().len(), 0);
    assert!(walls.corners().len() > 399_000);
    assert!(start.elapsed().as_secs() < 200, "{:?}", start.elapsed());
}
