//! `scene.sdf`: what a robot in Gazebo runs into is what the plan draws.

use std::fs;
use std::path::Path;

use trodden::Silent;
use trodden::bake::{OutputOptions, bake};
use trodden::math::{Rect, Vec2, vec2};
use trodden::scenario::{Overrides, Scenario};
use usvg::roxmltree::{Document, Node};

/// Height at which walls and collisions are compared, metres: above tables, below lintels.
const AT_M: f64 = 1.5;
/// Pixels of outer walls that are compared: 0.2 m from the floor on, as thick as they are in the scene.
const WALL_PX: i32 = 4;
const METRES_PER_PIXEL: f64 = 0.05;

/// An upright prism: its outline, and where it begins and ends, metres.
struct Solid {
    name: String,
    outline: Vec<Vec2>,
    around: Rect,
    span_m: [f64; 2],
}

impl Solid {
    fn of(collision: Node) -> Option<Solid> {
        let numbers = |name: &str| -> Vec<Vec<f64>> {
            let found = collision.descendants().filter(|node| node.has_tag_name(name));
            found.map(|node| node.text().unwrap().split(' ').map(|n| n.parse().unwrap()).collect()).collect()
        };
        let name = collision.attribute("name")?.to_string();
        let place = |local: Vec2, pose: &[f64]| {
            let (sin, cos) = (libm::sin(pose[5]), libm::cos(pose[5]));
            vec2(pose[0] + cos * local.x - sin * local.y, pose[1] + sin * local.x + cos * local.y)
        };
        if let [size] = &numbers("size")[..]
            && let [pose] = &numbers("pose")[..]
        {
            let half = [size[0] * 0.5, size[1] * 0.5];
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let outline = corners.map(|[x, y]| place(vec2(x * half[0], y * half[1]), pose)).to_vec();
            return Some(Solid::new(name, outline, [pose[2] - size[2] * 0.5, pose[2] + size[2] * 0.5]));
        }
        let [pose] = &numbers("pose")[..] else { return None };
        let outline = numbers("point").iter().map(|p| place(vec2(p[0], p[1]), pose)).collect();
        Some(Solid::new(name, outline, [pose[2], pose[2] + numbers("height")[0][0]]))
    }

    fn new(name: String, outline: Vec<Vec2>, span_m: [f64; 2]) -> Solid {
        let of = |axis: fn(&Vec2) -> f64, pick: fn(f64, f64) -> f64| outline.iter().map(axis).reduce(pick).unwrap();
        let corner = |pick| vec2(of(|p| p.x, pick), of(|p| p.y, pick));
        Solid { around: Rect { min: corner(f64::min), max: corner(f64::max) }, name, outline, span_m }
    }

    /// Whether a place lies within the outline, which is convex and goes counter-clockwise.
    fn covers(&self, p: Vec2) -> bool {
        let edges = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        self.around.contains(p) && edges.into_iter().all(|(&a, &b)| (b - a).cross(p - a) >= 0.0)
    }
}

/// The plan as it is drawn: which pixels are dark, and which are floor.
struct Drawn {
    width: i32,
    height: i32,
    floor: Vec<bool>,
}

impl Drawn {
    fn open(file: &Path, [x, y]: [i32; 2]) -> Drawn {
        let picture = image::open(file).unwrap().to_luma8();
        let (width, height) = (picture.width() as i32, picture.height() as i32);
        let mut drawn = Drawn { width, height, floor: vec![false; (width * height) as usize] };
        let mut open = vec![[x, y]];
        while let Some([x, y]) = open.pop() {
            let Some(at) = drawn.at(x, y) else { continue };
            if !drawn.floor[at] && picture.get_pixel(x as u32, y as u32).0[0] > 128 {
                drawn.floor[at] = true;
                open.extend([[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]]);
            }
        }
        drawn
    }

    fn at(&self, x: i32, y: i32) -> Option<usize> {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        inside.then_some((y * self.width + x) as usize)
    }

    fn is_floor(&self, x: i32, y: i32) -> bool {
        self.at(x, y).is_some_and(|at| self.floor[at])
    }

    fn is_wall(&self, x: i32, y: i32) -> bool {
        let near = -WALL_PX..=WALL_PX;
        let round = |i: i32, j: i32| i * i + j * j <= WALL_PX * WALL_PX;
        let floor_near = || near.clone().any(|i| near.clone().any(|j| round(i, j) && self.is_floor(x + i, y + j)));
        !self.is_floor(x, y) && floor_near()
    }

    /// All pixels with the places of their centres, metres.
    fn pixels(&self) -> impl Iterator<Item = (i32, i32, Vec2)> {
        let middle = |x, y| vec2(f64::from(x) + 0.5, f64::from(self.height - y) - 0.5) * METRES_PER_PIXEL;
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| (x, y, middle(x, y))))
    }

    /// How many of the pixels that a solid covers are floor, and of how many.
    fn on_floor(&self, solid: &Solid) -> [u32; 2] {
        let covered = self.pixels().filter(|&(_, _, p)| solid.covers(p));
        covered.fold([0, 0], |[floor, all], (x, y, _)| [floor + u32::from(self.is_floor(x, y)), all + 1])
    }

    /// How well solids agree with the walls: what both cover as a share of what either covers.
    fn agreement(&self, solids: &[Solid]) -> f64 {
        let [mut both, mut either] = [0, 0];
        for (x, y, p) in self.pixels() {
            let wall = self.is_wall(x, y);
            if !wall && !self.is_floor(x, y) {
                continue;
            }
            let solid = solids.iter().any(|solid| solid.covers(p));
            both += u32::from(wall && solid);
            either += u32::from(wall || solid);
        }
        f64::from(both) / f64::from(either)
    }
}

/// Measured: 0.97 (a counter of 1 m counts as wall in the drawing) and 0.99.
#[test]
fn collisions_are_the_walls_of_the_plan() {
    // A pixel of floor in each.
    for (name, floor) in [("museum", [600, 640]), ("school", [640, 280])] {
        let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans");
        let overrides = Overrides { texels_per_metre: Some(8.0), sdf: Some(true), ..Overrides::default() };
        let mut scenario = Scenario::open(&plans.join(name).with_extension("toml"), &overrides).unwrap();
        scenario.wall_texels_per_metre = 20.0;
        scenario.crowd.people = 4;
        let dir = tempfile::tempdir().unwrap();
        let folder = dir.path().join("out");
        bake(&scenario, &OutputOptions { folder: folder.clone(), force: false }, &Silent).unwrap();

        let text = fs::read_to_string(folder.join("scene.sdf")).unwrap();
        let world = Document::parse(&text).unwrap();
        let named = |name: &'static str| world.descendants().filter(move |node| node.has_tag_name(name));
        let shown: Vec<_> = named("uri").filter_map(|node| node.text()).collect();
        assert_eq!(shown, ["scene.glb"]);
        assert!(folder.join("scene.glb").is_file());
        let solids: Vec<Solid> = named("collision").filter_map(Solid::of).collect();
        assert_eq!(solids.len() + 1, named("collision").count(), "all but the ground have a place");
        let across: Vec<Solid> =
            solids.into_iter().filter(|solid| solid.span_m[0] < AT_M && AT_M < solid.span_m[1]).collect();
        let drawn = Drawn::open(&plans.join(name).with_extension("png"), floor);
        let agreement = drawn.agreement(&across);
        assert!(agreement >= 0.95, "{name}: {agreement}");
        // Door leaves do stand on the floor.
        for solid in across.iter().filter(|solid| !solid.name.starts_with("door")) {
            let [floor, all] = drawn.on_floor(solid);
            assert!(all < 20 || 10 * floor <= all, "{name}: {floor} of {all} pixels of {} are floor", solid.name);
        }
    }
}
