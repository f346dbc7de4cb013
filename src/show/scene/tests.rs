//! What a scene has to be, whatever the plan.

use std::collections::HashMap;

use proptest::prelude::*;

use super::*;
use crate::export::TileLayout;
use crate::math::Rect;
use crate::math::{Vec2, vec2};
use crate::plan::{FloorPlan, PlanClass};
use crate::stamps::TexelGrid;
use crate::walls::WallsOptions;
use crate::walls::{Doorway, Walls};

const HEIGHT_M: f64 = 2.5;

/// A plan drawn with characters: `.` floor, anything else wall.
fn walls_of(rows: &[&str], metres_per_pixel: f64) -> Walls {
    let floor = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'.')).collect();
    let plan = FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, metres_per_pixel, floor);
    Walls::trace(&plan, &WallsOptions::default())
}

/// A round room of 12 m with a round pillar in it, an oblique corridor, and a room beside it that nothing joins.
fn museum() -> Walls {
    let (side, scale) = (400, 0.05);
    let floor = (0..side * side)
        .map(|k| {
            let p = vec2(f64::from(k % side), f64::from(side - 1 - k / side)) * scale;
            let room = p.distance(vec2(8.0, 8.0)) < 6.0 && p.distance(vec2(9.0, 8.5)) > 0.8;
            let along = (p - vec2(8.0, 8.0)).dot(vec2(0.8, 0.6));
            let aside = (p - vec2(8.0, 8.0)).dot(vec2(-0.6, 0.8));
            let corridor = along > 0.0 && aside.abs() < 1.1;
            let beside = p.x > 15.0 && p.x < 18.0 && p.y > 2.0 && p.y < 6.0;
            u8::from(room || corridor && p.distance(vec2(8.0, 8.0)) > 5.9 || beside)
        })
        .collect();
    Walls::trace(&FloorPlan::from_mask(side, side, scale, floor), &WallsOptions::default())
}

/// Tiles of `tile` texels at 100 texels a metre over a plan.
fn tiles_over(walls: &Walls, tile: u32) -> Vec<Rect> {
    let bounds = walls.bounds_m();
    let grid = TexelGrid::covering(bounds.max.x, bounds.max.y, 100.0).unwrap();
    let layout = TileLayout::new(grid, tile).unwrap();
    layout.tiles().map(|t| layout.place_m(&t)).collect()
}

/// All faces in one row of one sheet, in pieces of at most 5 m.
fn strips_of(walls: &Walls) -> Vec<WallStrip> {
    let total: f64 = walls.faces.iter().map(|f| f.length_m()).sum();
    let (mut strips, mut u) = (Vec::new(), 0.0);
    for (face, length) in walls.faces.iter().map(|f| f.length_m()).enumerate() {
        let count = (length / 5.0).ceil();
        for k in 0..count as usize {
            let ends = [k as f64, (k + 1) as f64].map(|k| length * (k / count));
            let next = u + (ends[1] - ends[0]) / total;
            strips.push(WallStrip { face, sheet: 0, along_m: ends, uv: [[u, 0.9], [next, 0.9], [u, 0.1]] });
            u = next;
        }
    }
    strips
}

fn options() -> SceneOptions {
    SceneOptions { wall_height_m: HEIGHT_M, ..SceneOptions::default() }
}

fn scene_of(walls: &Walls, tile: u32) -> Scene {
    build(walls, &tiles_over(walls, tile), &strips_of(walls), &[], &options())
}

/// Area enclosed by the outlines, square metres.
fn floor_area_m2(walls: &Walls) -> f64 {
    let twice = |p: &[Vec2]| (0..p.len()).map(|k| p[(k + 1) % p.len()].cross(p[k])).sum::<f64>();
    walls.outlines().iter().map(|o| twice(&o.points_m) * 0.5).sum()
}

/// The corners of a part's triangles.
fn triangles(part: &Mesh) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
    part.indices.chunks(3).map(|t| [0, 1, 2].map(|k| part.positions_m[t[k] as usize].map(f64::from)))
}

/// Half the cross product of two sides: as long as the area, along the front's normal.
fn area_vector([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] - a[k]);
    let (u, v) = (side(b), side(c));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]].map(|v| v * 0.5)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn area_m2<'a>(parts: impl IntoIterator<Item = &'a Mesh>) -> f64 {
    parts.into_iter().flat_map(triangles).map(area_vector).map(|v| dot(v, v).sqrt()).sum()
}

fn floors(scene: &Scene) -> impl Iterator<Item = &Mesh> {
    scene.meshes.iter().filter(|p| matches!(p.surface, SceneSurface::FloorTile(_)))
}

fn part(scene: &Scene, surface: SceneSurface) -> &Mesh {
    scene.meshes.iter().find(|p| p.surface == surface).unwrap()
}

/// Area of the triangles of a part that look in a direction, square metres.
fn area_towards(part: &Mesh, direction: [f64; 3]) -> f64 {
    let towards = triangles(part).map(area_vector).map(|v| dot(v, direction));
    let whole = triangles(part).map(area_vector).map(|v| dot(v, v).sqrt());
    towards.zip(whole).filter(|(towards, whole)| towards > &(whole * 0.99)).map(|(_, whole)| whole).sum()
}

fn assert_close(value: f64, wanted: f64, relative: f64) {
    assert!((value - wanted).abs() <= relative * wanted.abs(), "{value} instead of {wanted}");
}

/// What holds for every scene.
fn check(scene: &Scene) {
    for part in &scene.meshes {
        let count = part.positions_m.len();
        assert_eq!(part.normals.len(), count);
        let textured = matches!(part.surface, SceneSurface::FloorTile(_) | SceneSurface::WallSheet(_));
        assert_eq!(part.uvs.len(), count);
        assert!(!part.indices.is_empty() && part.indices.len() % 3 == 0);
        assert!(part.indices.iter().all(|&i| (i as usize) < count));
        assert!(part.positions_m.iter().flatten().all(|v| v.is_finite()));
        assert!(!textured || part.uvs.iter().flatten().all(|v| (0.0..=1.0).contains(v)));
        let lengths = part.normals.iter().map(|n| n.iter().map(|v| v * v).sum::<f32>().sqrt());
        assert!(lengths.into_iter().all(|length| (length - 1.0).abs() < 1e-5));
        for (corners, indices) in triangles(part).zip(part.indices.chunks(3)) {
            let area = area_vector(corners);
            let size = dot(area, area).sqrt();
            assert!(size > 0.0, "a triangle without area: {corners:?}");
            // Slivers of a micrometre have hardly a direction in single precision.
            if size > 1e-5 {
                for &i in indices {
                    let normal = part.normals[i as usize].map(f64::from);
                    assert!(dot(area, normal) > 0.7 * size, "{:?} {corners:?} {normal:?}", part.surface);
                }
            }
        }
    }
    assert!(scene.meshes.windows(2).all(|w| w[0].surface < w[1].surface), "each surface once, in order");
}

/// Length of all edges of floor triangles that no two of them share, metres: the outline, and every crack wider than
/// 10 micrometres. Slivers without an area in single precision are left out of a scene: what lay on their two sides meets.
fn open_length_m(scene: &Scene) -> f64 {
    let mut edges: HashMap<[[u32; 2]; 2], i32> = HashMap::new();
    for part in floors(scene) {
        for triangle in part.indices.chunks(3) {
            let ends = [0, 1, 2].map(|k| {
                let [x, y, _] = part.positions_m[triangle[k] as usize];
                [x.to_bits(), y.to_bits()]
            });
            for k in 0..3 {
                let (a, b) = (ends[k], ends[(k + 1) % 3]);
                let (key, sign) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
                *edges.entry(key).or_default() += sign;
            }
        }
    }
    let point = |p: [u32; 2]| vec2(f64::from(f32::from_bits(p[0])), f64::from(f32::from_bits(p[1])));
    let open: Vec<(Vec2, Vec2, f64)> = edges
        .iter()
        .filter(|(_, count)| **count != 0)
        .map(|([a, b], count)| match *count > 0 {
            true => (point(*a), point(*b), f64::from(*count)),
            false => (point(*b), point(*a), f64::from(-count)),
        })
        .collect();
    let is_met = |a: Vec2, b: Vec2| {
        let middle = a.lerp(b, 0.5);
        open.iter().any(|&(c, d, _)| {
            let way = d - c;
            let share = (middle - c).dot(way) / way.dot(way);
            (0.0..=1.0).contains(&share) && (c + way * share).distance(middle) < 1e-5 && way.dot(b - a) < 0.0
        })
    };
    open.iter().filter(|(a, b, _)| !is_met(*a, *b)).map(|(a, b, count)| count * a.distance(*b)).sum()
}

#[test]
fn floor_triangles_fill_the_floor_exactly() {
    let walls = museum();
    for tile in [64, 300, 4096] {
        let scene = scene_of(&walls, tile);
        check(&scene);
        assert_close(area_m2(floors(&scene)), floor_area_m2(&walls), 1e-6);
    }
}

#[test]
fn neighbouring_tiles_leave_no_crack() {
    let walls = museum();
    let edges = |o: &crate::walls::Outline| (0..o.points_m.len()).map(|k| o.edge(k)).collect::<Vec<_>>();
    let outline_m: f64 = walls.outlines().iter().flat_map(edges).map(|[a, b]| a.distance(b)).sum();
    for tile in [64, 300, 4096] {
        assert_close(open_length_m(&scene_of(&walls, tile)), outline_m, 1e-5);
    }
}

#[test]
fn floor_coordinates_say_where_in_the_tile_a_corner_lies() {
    let walls = museum();
    let tiles = tiles_over(&walls, 512);
    for part in floors(&scene_of(&walls, 512)) {
        let SceneSurface::FloorTile(index) = part.surface else { continue };
        let tile = tiles[index];
        for (position, uv) in part.positions_m.iter().zip(&part.uvs) {
            let x = tile.min.x + f64::from(uv[0]) * tile.width();
            let y = tile.max.y - f64::from(uv[1]) * tile.height();
            assert!(vec2(x, y).distance(vec2(position[0].into(), position[1].into())) < 1e-5);
        }
    }
}

#[test]
fn floor_a_little_beyond_the_tiles_belongs_to_the_nearest() {
    // Fitted outlines may lie half a pixel outside of the plan.
    let walls = walls_of(&["####", "#..#", "#..#", "####"], 1.0);
    let tile = |x: f64| Rect { min: vec2(x, 1.1), max: vec2(x + 0.9, 2.9) };
    let scene = build(&walls, &[tile(1.1), tile(2.0)], &[], &[], &options());
    check(&scene);
    assert_eq!(floors(&scene).count(), 2);
    assert_close(area_m2(floors(&scene)), 4.0, 1e-6);
}

#[test]
fn walls_are_as_long_and_as_high_as_they_are_and_look_at_the_floor() {
    let walls = museum();
    let scene = scene_of(&walls, 512);
    let part = part(&scene, SceneSurface::WallSheet(0));
    let length: f64 = walls.faces.iter().map(|f| f.length_m()).sum();
    assert_close(area_m2([part]), length * HEIGHT_M, 1e-6);
    for corners in triangles(part) {
        let area = area_vector(corners);
        let size = dot(area, area).sqrt();
        let middle = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0 + area[k] / size * 1e-3);
        assert!(walls.is_inside(vec2(middle[0], middle[1])));
    }
    assert!(!scene.meshes.iter().any(|p| p.surface == SceneSurface::Lintel), "all wall is textured");
}

#[test]
fn wall_coordinates_follow_the_strips() {
    let walls = museum();
    let scene = scene_of(&walls, 512);
    let part = part(&scene, SceneSurface::WallSheet(0));
    let total: f64 = walls.faces.iter().map(|f| f.length_m()).sum();
    let corners = part.positions_m.iter().zip(&part.uvs);
    assert!(corners.clone().all(|(p, uv)| uv[1] == if p[2] == 0.0 { 0.9 } else { 0.1 }));
    // One row holds all walls in order: a panel's width is its share of u.
    for triangle in part.indices.chunks(3) {
        let at = |k: usize| {
            let i = triangle[k] as usize;
            let p = part.positions_m[i];
            (vec2(p[0].into(), p[1].into()), f64::from(part.uvs[i][0]))
        };
        for (a, b) in [(at(0), at(1)), (at(1), at(2))] {
            assert!((a.0.distance(b.0) / total - (a.1 - b.1).abs()).abs() < 1e-6);
        }
    }
}

#[test]
fn normals_are_smooth_round_a_pillar_and_hard_at_a_corner() {
    let walls = museum();
    let scene = scene_of(&walls, 4096);
    let part = part(&scene, SceneSurface::WallSheet(0));
    let centre = vec2(9.0, 8.5);
    let mut seen = 0;
    for (position, normal) in part.positions_m.iter().zip(&part.normals) {
        let out = vec2(position[0].into(), position[1].into()) - centre;
        if out.length() < 1.0 {
            let normal = vec2(normal[0].into(), normal[1].into());
            assert!(normal.dot(out.normalized().unwrap()) > 0.995, "{out:?} {normal:?}");
            seen += 1;
        }
    }
    assert!(seen >= 16);

    let room = walls_of(&["#####", "#...#", "#...#", "#####"], 1.0);
    let scene = scene_of(&room, 4096);
    let part = self::part(&scene, SceneSurface::WallSheet(0));
    assert!(part.normals.iter().all(|n| n.contains(&1.0) || n.contains(&-1.0)), "{:?}", part.normals);
}

#[test]
fn wall_that_is_on_no_sheet_is_clean_wall() {
    let walls = walls_of(&["#####", "#...#", "#...#", "#####"], 1.0);
    let mut strips = strips_of(&walls);
    let kept_m = strips[0].along_m[1] - strips[0].along_m[0];
    strips.truncate(1);
    let scene = build(&walls, &tiles_over(&walls, 512), &strips, &[], &options());
    check(&scene);
    assert_close(area_m2([part(&scene, SceneSurface::WallSheet(0))]), kept_m * HEIGHT_M, 1e-6);
    assert_close(area_m2([part(&scene, SceneSurface::Lintel)]), (10.0 - kept_m) * HEIGHT_M, 1e-6);
}

#[test]
fn a_turned_strip_runs_upward() {
    let walls = walls_of(&["####", "#..#", "#..#", "####"], 1.0);
    let strip = WallStrip { face: 0, sheet: 2, along_m: [0.0, 8.0], uv: [[0.5, 1.0], [0.5, 0.0], [0.25, 1.0]] };
    let scene = build(&walls, &[], &[strip], &[], &options());
    let part = part(&scene, SceneSurface::WallSheet(2));
    assert!(part.positions_m.iter().zip(&part.uvs).all(|(p, uv)| uv[0] == if p[2] == 0.0 { 0.5 } else { 0.25 }));
    assert!(part.uvs.iter().any(|uv| uv[1] == 0.75) && part.uvs.iter().all(|uv| (uv[1] * 4.0).fract() == 0.0));
    assert_eq!(floors(&scene).count(), 0);
}

#[test]
fn a_room_gets_a_rim_that_is_closed_outside() {
    let walls = walls_of(&["#####", "#...#", "#...#", "#####"], 1.0);
    let scene = scene_of(&walls, 512);
    let tops = part(&scene, SceneSurface::WallTop);
    assert_close(area_towards(tops, [0.0, 0.0, 1.0]), 3.4 * 2.4 - 6.0, 1e-5);
    for direction in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]] {
        assert_close(area_towards(tops, direction), 2.4 * HEIGHT_M, 1e-5);
    }
    for direction in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
        assert_close(area_towards(tops, direction), 3.4 * HEIGHT_M, 1e-5);
    }
}

#[test]
fn a_plan_is_open_where_people_come_in() {
    let walls = walls_of(&["######", "......", "......", "######"], 1.0);
    let scene = scene_of(&walls, 512);
    check(&scene);
    let tops = part(&scene, SceneSurface::WallTop);
    assert_close(area_towards(tops, [0.0, 0.0, 1.0]), 2.0 * 6.0 * 0.2, 1e-5);
    // Of the ends only the rim's is closed.
    assert_close(area_towards(tops, [1.0, 0.0, 0.0]), 2.0 * 0.2 * HEIGHT_M, 1e-5);
    assert_close(area_towards(tops, [0.0, 1.0, 0.0]), 6.0 * HEIGHT_M, 1e-5);
    let xs: Vec<f32> = tops.positions_m.iter().map(|p| p[0]).collect();
    assert!(xs.iter().all(|x| (0.0..=6.0).contains(x)), "nothing stands beyond the plan");
}

#[test]
fn what_is_solid_between_floors_is_closed_on_top() {
    // A pillar of 4 m2, and a wall 1 m thick between two rooms that reaches the outer wall.
    let walls = walls_of(
        &[
            "############",
            "#......#...#",
            "#......#...#",
            "#..##......#",
            "#..##..#...#",
            "#......#...#",
            "############",
        ],
        1.0,
    );
    let scene = scene_of(&walls, 512);
    check(&scene);
    let tops = part(&scene, SceneSurface::WallTop);
    let floor = floor_area_m2(&walls);
    assert_close(floor, 50.0 - 4.0 - 4.0, 1e-9);
    assert_close(area_towards(tops, [0.0, 0.0, 1.0]), 10.4 * 5.4 - floor, 1e-5);
    for corners in triangles(tops).filter(|c| c.iter().all(|p| p[2] > 0.0)) {
        let middle = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
        assert!(!walls.is_inside(vec2(middle[0], middle[1])), "no top over floor");
    }
}

/// Two rooms, joined by a door of 1 m in a wall of 0.5 m; the jambs are at y = 2 and y = 3.
fn two_rooms() -> (Walls, Doorway) {
    let mut rows = vec!["###################"; 12];
    rows[1..11].fill("#........#........#");
    rows[5..7].fill("#.................#");
    let walls = walls_of(&rows, 0.5);
    let face = walls.faces.iter().position(|f| f.closed).unwrap();
    let jambs_m = [vec2(4.75, 2.5), vec2(4.75, 3.5)];
    let on_faces = jambs_m.map(|p| (face, walls.nearest(p, 1.0).unwrap().along_m));
    (walls, Doorway { jambs_m, on_faces, depth_m: 0.5, through: vec2(1.0, 0.0), head_m: 2.1, leaf_m: None })
}

#[test]
fn a_lintel_closes_the_wall_above_a_door() {
    let (walls, doorway) = two_rooms();
    let scene = build(&walls, &tiles_over(&walls, 512), &strips_of(&walls), &[doorway], &options());
    check(&scene);
    let lintel = part(&scene, SceneSurface::Lintel);
    let height = HEIGHT_M - 2.1;
    assert_close(area_towards(lintel, [1.0, 0.0, 0.0]), height, 1e-5);
    assert_close(area_towards(lintel, [-1.0, 0.0, 0.0]), height, 1e-5);
    assert_close(area_towards(lintel, [0.0, 0.0, -1.0]), 0.5, 1e-5);
    assert_close(area_m2([lintel]), 2.0 * height + 0.5, 1e-5);
    assert!(lintel.positions_m.iter().all(|p| p[2] >= 2.1 - 1e-6 && p[2] <= HEIGHT_M as f32));
    let plain = scene_of(&walls, 512);
    let [tops, tops_without] = [&scene, &plain].map(|s| area_towards(part(s, SceneSurface::WallTop), [0.0, 0.0, 1.0]));
    assert_close(tops, tops_without + 0.5, 1e-5);
}

#[test]
fn a_wall_no_higher_than_a_door_has_no_lintel() {
    let (walls, doorway) = two_rooms();
    let options = SceneOptions { wall_height_m: 2.1, ..SceneOptions::default() };
    let scene = build(&walls, &tiles_over(&walls, 512), &strips_of(&walls), &[doorway], &options);
    assert!(!scene.meshes.iter().any(|p| p.surface == SceneSurface::Lintel));
}

#[test]
fn doorways_and_strips_that_cannot_be_do_no_harm() {
    let (walls, doorway) = two_rooms();
    let nan = Doorway { jambs_m: [vec2(f64::NAN, 0.0), vec2(1.0, 1.0)], ..doorway };
    let empty = Doorway { jambs_m: [vec2(1.0, 1.0); 2], depth_m: f64::INFINITY, ..doorway };
    let mut strips = strips_of(&walls);
    strips.push(WallStrip { face: 99, ..strips[0] });
    strips.push(WallStrip { along_m: [f64::NAN, 1.0], ..strips[0] });
    strips.push(WallStrip { along_m: [3.0, 1.0], ..strips[0] });
    let tiles = [Rect { min: vec2(f64::NAN, 0.0), max: vec2(1.0, f64::INFINITY) }];
    let scene = build(&walls, &tiles, &strips, &[nan, empty], &SceneOptions { rim_m: f64::NAN, ..options() });
    check(&scene);
}

#[test]
fn the_same_plan_gives_the_same_scene() {
    let walls = museum();
    assert_eq!(scene_of(&walls, 300), scene_of(&museum(), 300));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_plan_becomes_a_sound_scene(
        width in 3u32..14, height in 3u32..14, share in 0.2f64..0.95, seed in any::<u64>(),
        scale in 0.1f64..1.5, tile in prop::sample::select(vec![64u32, 128, 1000]),
    ) {
        let mut random = crate::math::SplitMix64::new(seed);
        let floor: Vec<u8> = (0..width * height)
            .map(|_| u8::from((random.next_u64() >> 11) as f64 / (1u64 << 53) as f64 <= share))
            .collect();
        prop_assume!(floor.contains(&1));
        let plan = FloorPlan::from_mask(width, height, scale, floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let doorways: Vec<Doorway> = (0..2).map(|k| {
            let at = |n: u64| vec2(plan.width_m() * (n % 97) as f64 / 97.0, plan.height_m() * (n % 89) as f64 / 89.0);
            let jambs_m = [at(seed >> (8 * k)), at(seed >> (8 * k + 5))];
            Doorway { jambs_m, on_faces: [(0, 0.0); 2], depth_m: 0.3, through: vec2(1.0, 0.0), head_m: 2.1, leaf_m: None }
        }).collect();
        let scene = build(&walls, &tiles_over(&walls, tile), &strips_of(&walls), &doorways, &options());
        check(&scene);
        // Outlines of noise may cross each other: what they enclose together is the floor.
        let floor = region::PolygonSet::inside_right(walls.outlines().iter().map(|o| o.points_m.iter().copied()));
        let wanted = floor.triangles().area_m2();
        let found = area_m2(floors(&scene));
        prop_assert!((found - wanted).abs() <= 1e-5 * wanted, "{found} m2 instead of {wanted}");
        let around = |points: Vec<Vec2>| (0..points.len()).map(|k| points[k].distance(points[(k + 1) % points.len()])).sum::<f64>();
        let wanted: f64 = floor.loops().map(|points| around(points.collect())).sum();
        let found = open_length_m(&scene);
        prop_assert!((found - wanted).abs() <= 1e-4 * wanted, "{found} m of outline instead of {wanted}");
    }
}

/// A room of 6 x 4 m with a table of 2 x 1 m.
fn room_with_table() -> Walls {
    let table = |x: u32, y: u32| (20..40).contains(&x) && (16..26).contains(&y);
    let inside = |x: u32, y: u32| (1..61).contains(&x) && (1..41).contains(&y);
    let plan = FloorPlan::with_furniture([62, 42], 0.1, inside, (PlanClass::Table, table));
    Walls::trace(&plan, &WallsOptions::default())
}

#[test]
fn a_table_stands_at_its_height() {
    let walls = room_with_table();
    let scene = scene_of(&walls, 128);
    check(&scene);
    let up = [0.0, 0.0, 1.0];
    let fittings = || scene.meshes.iter().filter(|part| matches!(part.surface, SceneSurface::Fitting(_)));
    // Its top, and hardly anything else that looks up.
    let tops_m2: f64 = fittings().map(|part| area_towards(part, up)).sum();
    let highest_m = fittings().flat_map(|part| &part.positions_m).map(|p| f64::from(p[2])).fold(0.0, f64::max);
    println!("{tops_m2} m2 at {highest_m} m, wall {}", area_m2([part(&scene, SceneSurface::WallSheet(0))]));
    assert!((2.0..2.2).contains(&tops_m2), "{tops_m2}");
    assert!((highest_m - 0.75).abs() < 1e-6, "{highest_m}");
    // The walls are 20 m around: the table is no wall.
    assert_close(area_m2([part(&scene, SceneSurface::WallSheet(0))]), 20.0 * HEIGHT_M, 1e-6);
    // The rim alone is closed on top.
    let rim_m2 = area_towards(part(&scene, SceneSurface::WallTop), up);
    assert_close(rim_m2, 6.4 * 4.4 - 24.0, 1e-3);
}

/// Light maps: no texel is shown twice, and the light of one piece does not bleed into another.
#[test]
fn every_place_has_texels_of_its_own_on_a_light_map() {
    const SIZE_PX: u32 = 512;
    let walls = museum();
    let options = SceneOptions { wall_height_m: HEIGHT_M, ..SceneOptions::default() };
    let scene = build(&walls, &tiles_over(&walls, 1024), &strips_of(&walls), &[], &options);
    for mesh in &scene.meshes {
        let mapped = mesh.light_mapped(SIZE_PX);
        assert_eq!(mapped.light_uvs.len(), mapped.positions_m.len());
        let corners = |mesh: &Mesh| triangles(mesh).collect::<Vec<_>>();
        assert_eq!(corners(mesh), corners(&mapped));
        // Pieces hang together by their vertices.
        let mut piece: Vec<usize> = (0..mapped.positions_m.len()).collect();
        for _ in 0..piece.len() {
            let before = piece.clone();
            for corners in mapped.indices.chunks(3).map(|c| c.iter().map(|&i| i as usize)) {
                let least = corners.clone().map(|i| piece[i]).min().unwrap();
                corners.for_each(|i| piece[i] = least);
            }
            if piece == before {
                break;
            }
        }
        // Four samples a texel: the piece that each shows.
        let (side, mut shown, mut covered, mut scales) = (2 * SIZE_PX as usize, HashMap::new(), 0.0, Vec::new());
        for (corners, places) in mapped.indices.chunks(3).zip(triangles(&mapped)) {
            let [a, b, c] = [0, 1, 2].map(|k| mapped.light_uvs[corners[k] as usize].map(f64::from)).map(|[u, v]| {
                assert!((0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v));
                vec2(u, v) * side as f64
            });
            let area = (b - a).cross(c - a);
            let in_space = area_vector(places);
            covered += area.abs() * 0.5;
            if dot(in_space, in_space) > 1e-4 {
                scales.push(area.abs() / dot(in_space, in_space).sqrt());
            }
            let range = |values: [f64; 3]| {
                let ends = [values.into_iter().fold(side as f64, f64::min), values.into_iter().fold(0.0, f64::max)];
                ends[0].floor() as usize..(ends[1].ceil() as usize).min(side)
            };
            for (x, y) in range([a.x, b.x, c.x]).flat_map(|x| range([a.y, b.y, c.y]).map(move |y| (x, y))) {
                let p = vec2(x as f64 + 0.5, y as f64 + 0.5);
                let inside = [(a, b), (b, c), (c, a)].map(|(a, b)| (b - a).cross(p - a) * area.signum());
                if inside.iter().all(|side| *side > 1e-6 * area.abs()) {
                    let other = shown.insert((x, y), piece[corners[0] as usize]);
                    assert_eq!(other, None, "{:?}: two triangles at {x}, {y}", mesh.surface);
                }
            }
        }
        for (&(x, y), own) in &shown {
            for (i, j) in (0..=3).flat_map(|i| (0..=3).map(move |j| (x + i, y + j))) {
                assert!(shown.get(&(i, j)).is_none_or(|other| other == own), "{:?} at {x}, {y}", mesh.surface);
            }
        }
        let share = covered / (side * side) as f64;
        let (least, most) =
            (scales.iter().copied().fold(f64::INFINITY, f64::min), scales.iter().copied().fold(0.0, f64::max));
        assert!(share > 0.15, "{:?} uses {share} of its light map", mesh.surface);
        assert!(most < 1.02 * least, "{:?} is stretched: {least} to {most}", mesh.surface);
    }
}

/// Every hull is convex; those of the walls cover the walls' tops and no floor.
#[test]
fn hulls_are_convex_and_fill_the_walls() {
    for (walls, doorways) in [(museum(), Vec::new()), (two_rooms().0, vec![two_rooms().1])] {
        let tiles = tiles_over(&walls, 512);
        let scene = build(&walls, &tiles, &strips_of(&walls), &doorways, &options());
        let hulls = hulls(&walls, &tiles, &doorways, &options(), &scene);
        let hulls: Vec<Mesh> = hulls.iter().filter_map(Prism::mesh).collect();
        for hull in &hulls {
            for [a, b, c] in triangles(hull) {
                let across = area_vector([a, b, c]);
                let size = dot(across, across).sqrt();
                let above = |p: &[f32; 3]| dot(across, [0, 1, 2].map(|k| f64::from(p[k]) - a[k])) / size;
                assert!(hull.positions_m.iter().all(|p| above(p) < 3e-3), "{hull:?}");
            }
        }
        let up = |surface: SceneSurface| {
            hulls.iter().filter(|h| h.surface == surface).map(|h| area_towards(h, [0.0, 0.0, 1.0])).sum::<f64>()
        };
        let lintels = doorways.len() as f64 * 0.5;
        let tops = area_towards(part(&scene, SceneSurface::WallTop), [0.0, 0.0, 1.0]) - lintels;
        assert_close(up(SceneSurface::WallTop), tops, 0.01);
        assert_close(up(SceneSurface::Lintel), lintels, 1e-5);
        for hull in hulls.iter().filter(|hull| hull.surface == SceneSurface::WallTop) {
            for [a, b, c] in triangles(hull).filter(|c| c.iter().all(|p| p[2] > 1.0)) {
                let middle = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
                assert!(!walls.is_inside(vec2(middle[0], middle[1])), "a wall's hull over floor");
            }
        }
    }
}
