use trodden::math::{Vec2, atan2, sin_cos, vec2};
use trodden::units::{Member, TrackSample, Unit, UnitTrack};

/// Samples per second of a drawn unit.
const FPS: f64 = 5.0;
/// Half width of the triangle that rounds a way's corners off, seconds: starting and stopping take twice as long.
const WAY_S: f64 = 0.55;
/// The same for turning the body.
const TURN_S: f64 = 0.6;
/// Steps in which those triangles are summed up, seconds.
const STEP_S: f64 = 0.05;
/// An easy walk, metres per second.
pub const WALK: f64 = 1.25;

/// Somebody who does one thing after the other: walks straight to a place, stays, turns.
#[derive(Clone, Debug)]
pub struct Actor {
    group: u32,
    /// Corners of the way: time and place.
    corners: Vec<(f64, Vec2)>,
    /// When the body turns, and where to: radians, counted on beyond half a turn.
    turns: Vec<(f64, f64)>,
}

/// Directions, degrees: away from the viewer, towards, to the viewer's right and left.
pub const AWAY: f64 = 90.0;
pub const TOWARDS: f64 = -90.0;
pub const RIGHT: f64 = 0.0;
pub const LEFT: f64 = 180.0;

impl Actor {
    /// Somebody of a group who is at a place and has been walking in a direction.
    pub fn new(group: u32, [x, y]: [f64; 2], facing_deg: f64) -> Actor {
        Actor { group, corners: vec![(0.0, vec2(x, y))], turns: vec![(0.0, facing_deg.to_radians())] }
    }

    fn now_s(&self) -> f64 {
        self.corners.last().map_or(0.0, |corner| corner.0)
    }

    fn here(&self) -> Vec2 {
        self.corners.last().map_or(Vec2::ZERO, |corner| corner.1)
    }

    /// Walks straight to a place, and faces it.
    pub fn to(self, place: [f64; 2], speed_m_s: f64) -> Actor {
        let way = Vec2::from(place) - self.here();
        self.turn(atan2(way.y, way.x)).glides(place, speed_m_s)
    }

    /// The same without turning: a step aside or back.
    pub fn glides(mut self, place: [f64; 2], speed_m_s: f64) -> Actor {
        let (now_s, here, place) = (self.now_s(), self.here(), Vec2::from(place));
        self.corners.push((now_s + here.distance(place) / speed_m_s, place));
        self
    }

    /// Stays for so many seconds.
    pub fn stays(mut self, seconds: f64) -> Actor {
        let (now_s, here) = (self.now_s(), self.here());
        self.corners.push((now_s + seconds, here));
        self
    }

    /// Turns to a direction, degrees.
    pub fn faces(self, degrees: f64) -> Actor {
        self.turn(degrees.to_radians())
    }

    /// Turns to a place.
    pub fn looks_at(self, place: [f64; 2]) -> Actor {
        let way = Vec2::from(place) - self.here();
        self.turn(atan2(way.y, way.x))
    }

    fn turn(mut self, to_rad: f64) -> Actor {
        let before = self.turns.last().map_or(to_rad, |turn| turn.1);
        let turn = std::f64::consts::TAU;
        // By the shorter way around.
        let to_rad = to_rad + ((before - to_rad) / turn).round() * turn;
        let now_s = self.now_s();
        self.turns.push((now_s, to_rad));
        self
    }

    /// When the way drawn so far ends, seconds.
    pub fn ends_s(&self) -> f64 {
        self.now_s()
    }

    fn corner_at(&self, time_s: f64) -> Vec2 {
        let last = self.corners.len() - 1;
        let k = self.corners.partition_point(|corner| corner.0 <= time_s).clamp(1, last) - 1;
        let ((t0, a), (t1, b)) = (self.corners[k], self.corners[k + 1]);
        // Before the start and after the end the way goes on.
        if t1 - t0 < 1e-9 { b } else { a.lerp(b, (time_s - t0) / (t1 - t0)) }
    }

    fn turn_at(&self, time_s: f64) -> f64 {
        let k = self.turns.partition_point(|turn| turn.0 <= time_s + 1e-9).max(1);
        self.turns[k - 1].1
    }

    fn member(&self, duration_s: f64) -> Member {
        let sample = |k: u32| {
            let time_s = f64::from(k) / FPS;
            let (mut place, mut angle, mut weights) = (Vec2::ZERO, 0.0, [0.0; 2]);
            let steps = (WAY_S.max(TURN_S) / STEP_S) as i32;
            for step in -steps..=steps {
                let away_s = f64::from(step) * STEP_S;
                let [way, turn] = [WAY_S, TURN_S].map(|half_s| (1.0 - away_s.abs() / half_s).max(0.0));
                place += self.corner_at(time_s + away_s) * way;
                angle += self.turn_at(time_s + away_s) * turn;
                weights = [weights[0] + way, weights[1] + turn];
            }
            let (sin, cos) = sin_cos(angle / weights[1]);
            TrackSample { time_s, place_m: place / weights[0], heading: vec2(cos, sin) }
        };
        let count = (duration_s * FPS).round() as u32;
        Member { group: self.group, track: UnitTrack::new((0..=count).map(sample).collect()) }
    }
}

/// A scene: what it is called, what happens, and who does it.
#[derive(Clone, Debug)]
pub struct Scene {
    pub file: String,
    pub name: String,
    pub description: String,
    pub duration_s: f64,
    pub actors: Vec<Actor>,
}

impl Scene {
    pub fn new(file: &str, name: &str, description: &str, duration_s: f64, actors: Vec<Actor>) -> Scene {
        Scene { file: file.into(), name: name.into(), description: description.into(), duration_s, actors }
    }

    /// The scene with more people, under another name.
    pub fn with(&self, file: &str, name: &str, description: &str, more: Vec<Actor>) -> Scene {
        let mut actors = self.actors.clone();
        actors.extend(more);
        Scene {
            file: format!("{}_{file}", self.file),
            name: format!("{}, {name}", self.name),
            description: format!("{}; {description}", self.description),
            duration_s: self.duration_s,
            actors,
        }
    }

    pub fn unit(&self) -> Unit {
        let members: Vec<Member> = self.actors.iter().map(|actor| actor.member(self.duration_s)).collect();
        let places = members.iter().flat_map(|member| member.track.samples()).map(|sample| sample.place_m.y);
        let depth_m = (places.fold(0.0, f64::max) * 2.0).ceil() * 0.5;
        Unit {
            name: self.name.clone(),
            description: self.description.clone(),
            viewer: UnitTrack::new(vec![TrackSample { time_s: 0.0, place_m: Vec2::ZERO, heading: vec2(0.0, 1.0) }]),
            area_m: [3.0, depth_m.clamp(3.5, 7.0)],
            duration_s: self.duration_s,
            members,
        }
    }
}
