//! What the crowd knows of everybody present.

use rand::RngExt;

use crate::math::{Distribution, Purpose, Vec2, person_stream, vec2};

use super::CrowdOptions;
use super::stops::Errand;

/// What others see of a person.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Body {
    /// Position, metres.
    pub(super) x: f32,
    pub(super) y: f32,
    /// Velocity, metres per second.
    pub(super) vx: f32,
    pub(super) vy: f32,
    /// Unit vector towards where the person wants to go.
    pub(super) aim_x: f32,
    pub(super) aim_y: f32,
    /// Half of the exclusion distance, metres.
    pub(super) half_exclusion_m: f32,
    /// A distance that no wall comes nearer than, metres.
    pub(super) clearance_m: f32,
}

impl Body {
    pub(super) fn position(&self) -> Vec2 {
        vec2(f64::from(self.x), f64::from(self.y))
    }
}

/// What a person is like: drawn once, a function of (seed, id).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Traits {
    pub(super) speed_m_s: f32,
    pub(super) exclusion_m: f32,
    pub(super) acceptable_m: f32,
    pub(super) wall_exclusion_m: f32,
    pub(super) wall_acceptable_m: f32,
    /// Which share of the way's width, from the left, the person likes to walk at.
    pub(super) lane: f32,
    /// Uniform in `[0, 1)`: where the person vanishes.
    pub(super) goal_draw: f32,
    /// What the unevenness of the person's walk is drawn from, under social forces.
    pub(super) wander: u64,
}

impl Traits {
    pub(super) fn draw(seed: u64, id: u32, options: &CrowdOptions) -> Traits {
        let rng = &mut person_stream(seed, id, Purpose::Walk);
        let mut draw = |d: &Distribution| d.draw(rng) as f32;
        let exclusion_m = draw(&options.exclusion);
        let wall_exclusion_m = draw(&options.wall_exclusion);
        let unit = Distribution::Uniform([0.0, 1.0]);
        Traits {
            speed_m_s: draw(&options.speed),
            exclusion_m,
            // Nobody accepts less than what is possible at all.
            acceptable_m: draw(&options.acceptable).max(exclusion_m),
            wall_exclusion_m,
            wall_acceptable_m: draw(&options.wall_acceptable).max(wall_exclusion_m),
            lane: draw(&unit),
            goal_draw: draw(&unit),
            wander: rng.random(),
        }
    }
}

/// Where a person is on the route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    pub(super) id: u32,
    pub(super) route: u32,
    /// Which leg of the route, counted from 0.
    pub(super) leg: u32,
    /// The least distance left so far, metres, legs behind included.
    pub(super) least_left_m: f32,
    /// When that was last improved, seconds.
    pub(super) improved_s: f64,
    /// Where in a goal area the person vanishes, metres; for openings, x is the depth beyond the edge.
    pub(super) end_m: Vec2,
    /// Unit vector along the way, as last looked up.
    pub(super) wanted: [f32; 2],
    /// How often the person has looked around.
    pub(super) looks: u8,
    /// Share of the speed that the person wants now: less when about to stop.
    pub(super) pace: f32,
    /// Where the body faces.
    pub(super) heading: Heading,
    /// Whether the person has arrived, and is about to be taken out.
    pub(super) arrived: bool,
    /// How many of the route had arrived when this person last made way.
    pub(super) arrived_before: u64,
    /// For how long yet the person walks wherever those who come the other way leave room, seconds.
    pub(super) yields_s: f32,
    /// For how long somebody who comes the other way has been in the way, seconds.
    pub(super) blocked_s: f32,
    /// What the person does who is at a stop or on the way to one; nobody else has one.
    pub(super) errand: Option<Errand>,
    /// Whether somebody outside of the crowd says where the person goes.
    pub(super) led: bool,
}

impl Course {
    /// Somebody who walks no route.
    pub(super) fn onlooker(id: u32, heading: Heading) -> Course {
        Course {
            id,
            route: 0,
            leg: 0,
            least_left_m: f32::INFINITY,
            improved_s: 0.0,
            end_m: Vec2::ZERO,
            wanted: [1.0, 0.0],
            looks: 0,
            pace: 0.0,
            heading,
            arrived: false,
            arrived_before: 0,
            yields_s: 0.0,
            blocked_s: 0.0,
            errand: None,
            led: true,
        }
    }

    /// Turns the body where it goes, or where it faces while it stands or shuffles.
    pub(super) fn turn(&mut self, body: &Body, dt: f32) {
        let faced = self.errand.and_then(|errand| errand.faces(body.x, body.y));
        self.heading.follow(body, faced.unwrap_or([body.aim_x, body.aim_y]), dt);
    }

    /// Share of the exclusion distance that the person claims: those who block each other turn sideways after a while
    /// and squeeze past, as in a passage for one.
    pub(super) fn squeeze(&self) -> f32 {
        (1.0 - (self.blocked_s - SQUEEZE_AFTER_S) / SQUEEZE_OVER_S).clamp(SQUEEZED, 1.0)
    }
}

/// People who block each other wait so long, seconds, ...
const SQUEEZE_AFTER_S: f32 = 4.0;
/// ... then get thinner over so long, seconds ...
const SQUEEZE_OVER_S: f32 = 8.0;
/// ... down to this share of their exclusion distance.
const SQUEEZED: f32 = 0.35;

/// Whoever is faster than this faces the way that they go, metres per second; whoever stands, where they want to go.
const WALKING_M_S: f32 = 0.25;
/// A body turns at most this fast, radians per second: half a turn takes 1.3 s.
const FASTEST_TURN_RAD_S: f32 = 2.4;

/// Where a body faces: a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading {
    x: f32,
    y: f32,
}

impl Heading {
    pub(super) fn new(x: f32, y: f32) -> Heading {
        Heading { x, y }
    }

    pub(super) fn into_vec(self) -> Vec2 {
        vec2(f64::from(self.x), f64::from(self.y))
    }

    /// Turns where the body goes, or to `faced` while it stands, as far as it gets in `dt` seconds.
    pub(super) fn follow(&mut self, body: &Body, faced: [f32; 2], dt: f32) {
        let speed = (body.vx * body.vx + body.vy * body.vy).sqrt();
        let wanted = if speed > WALKING_M_S { [body.vx / speed, body.vy / speed] } else { faced };
        let cos = self.x * wanted[0] + self.y * wanted[1];
        let most = FASTEST_TURN_RAD_S * dt;
        // The cosine's series: exact enough for the angle of one step.
        let square = most * most;
        let most_cos = 1.0 - square * (0.5 - square / 24.0);
        if cos >= most_cos {
            *self = Heading::new(wanted[0], wanted[1]);
            return;
        }
        let side = if self.x * wanted[1] - self.y * wanted[0] < 0.0 { -1.0 } else { 1.0 };
        let sin = side * (1.0 - most_cos * most_cos).max(0.0).sqrt();
        let (x, y) = (self.x * most_cos - self.y * sin, self.x * sin + self.y * most_cos);
        let length = (x * x + y * y).sqrt().max(1e-6);
        *self = Heading::new(x / length, y / length);
    }
}
