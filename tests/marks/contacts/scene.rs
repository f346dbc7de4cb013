//! A building that a crowd walks through, and what it touches there.

use std::sync::OnceLock;

use trodden::crowd::{CrowdOptions, Simulation};
use trodden::marks::{Contact, ContactOptions, ContactPlaces, Footfalls, MarksOptions};
use trodden::math::{Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::patterns::PatternLibrary;
use trodden::plan::{FloorPlan, PlanPoint};
use trodden::routes::{self, PlaceRequest, RouteRequest, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

/// Side of a pixel, metres.
const PX_M: f64 = 0.05;
/// People in the crowd.
pub const CROWD: u32 = 300;
/// The corridor, metres: its walls, and where it turns north.
pub const SOUTH_M: f64 = 4.0;
pub const NORTH_M: f64 = 6.4;
pub const TURN_M: f64 = 28.0;
/// Middles and widths of the two doors across it, metres.
pub const DOORS_M: [[f64; 2]; 2] = [[8.0, 1.0], [16.0, 1.4]];
/// From where to where it is narrow, metres, and how wide there.
pub const NARROW_M: [f64; 2] = [19.0, 25.0];
const NARROW_WIDTH_M: f64 = 1.1;

/// A corridor of 2.4 m with two doors across it and a narrow stretch, which turns north at its end. Beside it a room whose
/// door nobody takes, and, behind a thin wall, one without a door.
pub struct Scene {
    pub plan: FloorPlan,
    pub walls: Walls,
    pub people: People,
    pub library: PatternLibrary,
    pub frames: Vec<Frame>,
}

fn within(p: Vec2, min: [f64; 2], max: [f64; 2]) -> bool {
    p.x > min[0] && p.x < max[0] && p.y > min[1] && p.y < max[1]
}

fn is_floor(p: Vec2) -> bool {
    let middle = 0.5 * (SOUTH_M + NORTH_M);
    let along = within(p, [0.0, SOUTH_M], [TURN_M + 2.4, NORTH_M]);
    let across = DOORS_M.iter().any(|[x, width]| (p.x - x).abs() < 0.1 && (p.y - middle).abs() > 0.5 * width);
    let beside = p.x > NARROW_M[0] && p.x < NARROW_M[1] && (p.y - middle).abs() > 0.5 * NARROW_WIDTH_M;
    let onward = within(p, [TURN_M, SOUTH_M], [TURN_M + 2.4, 14.0]);
    let unused = within(p, [2.0, 0.5], [7.0, 3.8]) || within(p, [4.0, 3.7], [4.9, 4.1]);
    let closed = within(p, [10.0, NORTH_M + 0.1], [15.0, 9.0]);
    (along && !across && !beside) || onward || unused || closed
}

fn plan_of(size_m: [f64; 2], is_floor: impl Fn(Vec2) -> bool) -> FloorPlan {
    let [columns, rows] = size_m.map(|m| (m / PX_M).round() as u32);
    let at = |row: u32, column: u32| vec2(f64::from(column) + 0.5, f64::from(rows - row) - 0.5) * PX_M;
    let mask = (0..rows * columns).map(|k| u8::from(is_floor(at(k / columns, k % columns)))).collect();
    FloorPlan::from_mask(columns, rows, PX_M, mask)
}

/// The scene with its crowd, made once for all tests.
pub fn scene() -> &'static Scene {
    static SCENE: OnceLock<Scene> = OnceLock::new();
    SCENE.get_or_init(|| {
        let plan = plan_of([TURN_M + 4.0, 14.0], is_floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let people = People::new(4, BodyOptions::default());
        let frames = walked(&plan, &walls, &people, CROWD, [[0.5, 5.2], [TURN_M + 1.2, 13.5]]);
        Scene { plan, walls, people, library: PatternLibrary::built_in(), frames }
    })
}

/// Frames of a crowd on its way from one place to another.
pub fn walked(plan: &FloorPlan, walls: &Walls, people: &People, crowd: u32, ends_m: [[f64; 2]; 2]) -> Vec<Frame> {
    let [from, to] = ends_m.map(|at| {
        let reach = 0.4;
        PlaceRequest::Area([[at[0] - reach, at[1] - reach], [at[0] + reach, at[1] + reach]])
    });
    let route = RouteRequest { name: None, from, to, via: Vec::new(), share: 1.0, arrivals: None };
    let request = RoutesOptions { routes: vec![route], ..RoutesOptions::default() };
    let routes = routes::find(plan, walls, &request).unwrap_or_else(|error| panic!("{error}"));
    let options =
        CrowdOptions { people: crowd, entry_seconds: Some(f64::from(crowd) * 0.9), ..CrowdOptions::default() };
    let mut crowd = Simulation::new(plan, walls, &routes, people, &options).unwrap();
    let mut frames = Vec::new();
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame).unwrap() {
        frames.push(frame.clone());
    }
    frames
}

/// Options with every rate times a factor: enough touches to measure by.
pub fn rates_times(factor: f64) -> ContactOptions {
    let options = ContactOptions::default();
    ContactOptions {
        hand_per_metre: options.hand_per_metre * factor,
        arm_per_metre: options.arm_per_metre * factor,
        shoulder_per_metre: options.shoulder_per_metre * factor,
        bag_per_metre: options.bag_per_metre * factor,
        shoe_per_metre: options.shoe_per_metre * factor,
        jamb_hand_per_passage: options.jamb_hand_per_passage * factor,
        jamb_shoulder_per_passage: options.jamb_shoulder_per_passage * factor,
        jamb_bag_per_passage: options.jamb_bag_per_passage * factor,
        jamb_shoe_per_passage: options.jamb_shoe_per_passage * factor,
        corner_per_turn: options.corner_per_turn * factor,
        corner_bag_per_turn: options.corner_bag_per_turn * factor,
        corner_shoe_per_turn: options.corner_shoe_per_turn * factor,
        lean_per_second: options.lean_per_second * factor,
        fixture_per_passage: options.fixture_per_passage * factor,
        fixture_per_second: options.fixture_per_second * factor,
        people: 1.0,
        ..options
    }
}

impl Scene {
    /// What the crowd touches.
    pub fn contacts(&self, options: ContactOptions) -> Vec<Contact> {
        self.contacts_of(&self.frames, options, None)
    }

    /// What people of these frames touch, at these places or those that the walls tell of.
    pub fn contacts_of(
        &self,
        frames: &[Frame],
        options: ContactOptions,
        places: Option<ContactPlaces>,
    ) -> Vec<Contact> {
        let marks = MarksOptions { contact: options, ..MarksOptions::default() };
        let mut footfalls = Footfalls::new(&self.people, &self.walls, &self.library, &marks, Vec::new()).unwrap();
        if let Some(places) = places {
            footfalls = footfalls.with_contacts(places);
        }
        let (mut feet, mut contacts) = (Vec::new(), Vec::new());
        for frame in frames {
            footfalls.push(frame, &mut feet);
            footfalls.take_contacts(&mut contacts);
        }
        footfalls.finish(&mut feet);
        footfalls.take_contacts(&mut contacts);
        assert_eq!(footfalls.contact_count(), contacts.len() as u64);
        contacts
    }

    /// Where a contact lies in the plan.
    pub fn place(&self, contact: &Contact) -> Vec2 {
        let face = &self.walls.faces[contact.face as usize];
        let n = face.points_m.len();
        let mut left_m = contact.along_m;
        for k in 0..if face.closed { n } else { n - 1 } {
            let (a, b) = (face.points_m[k], face.points_m[(k + 1) % n]);
            let length_m = a.distance(b);
            if left_m <= length_m || (!face.closed && k + 2 == n) {
                return a.lerp(b, left_m / length_m);
            }
            left_m -= length_m;
        }
        panic!("{contact:?} lies beyond its face");
    }

    /// Every straight piece of way that somebody walked between two frames.
    pub fn ways(&self, mut each: impl FnMut(Vec2, Vec2)) {
        let mut last: Vec<Option<Vec2>> =
            vec![None; self.frames.iter().flat_map(|f| &f.walkers).map(|w| w.id as usize + 1).max().unwrap_or(0)];
        for frame in &self.frames {
            for walker in &frame.walkers {
                if let Some(from) = last[walker.id as usize].replace(walker.position_m) {
                    each(from, walker.position_m);
                }
            }
        }
    }
}

/// Mean and standard deviation.
pub fn spread(values: &[f64]) -> [f64; 2] {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    [mean, (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count).sqrt()]
}

/// A point as a scenario writes it.
pub fn metres(x: f64, y: f64) -> PlanPoint {
    PlanPoint::Metres([x, y])
}
