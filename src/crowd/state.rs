//! State of an agent: body, traits, and progress along the route.

use rand::RngExt;

use crate::math::{Distribution, Purpose, Vec2, person_stream, vec2};

use super::CrowdOptions;
use super::stops::VisitTarget;

/// Position, velocity and size of an agent, as others perceive them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BodyState {
    /// Position, metres.
    pub(super) x: f32,
    pub(super) y: f32,
    /// Velocity, metres per second.
    pub(super) vx: f32,
    pub(super) vy: f32,
    /// Unit vector in which the agent wants to go.
    pub(super) aim_x: f32,
    pub(super) aim_y: f32,
    /// Half of the exclusion distance, metres.
    pub(super) half_exclusion_m: f32,
    /// Lower bound of the distance to the nearest wall, metres.
    pub(super) clearance_m: f32,
}

impl BodyState {
    pub(super) fn position(&self) -> Vec2 {
        vec2(f64::from(self.x), f64::from(self.y))
    }

    pub(super) fn velocity(&self) -> Vec2 {
        vec2(f64::from(self.vx), f64::from(self.vy))
    }

    pub(super) fn aim(&self) -> Vec2 {
        vec2(f64::from(self.aim_x), f64::from(self.aim_y))
    }
}

/// One agent: its state, which a step changes, and its traits.
pub(super) struct AgentMut<'s> {
    pub(super) body: &'s mut BodyState,
    pub(super) walk: &'s mut WalkState,
    pub(super) traits: &'s Traits,
}

impl AgentMut<'_> {
    pub(super) fn reborrow(&mut self) -> AgentMut<'_> {
        AgentMut { body: self.body, walk: self.walk, traits: self.traits }
    }
}

/// Speed, distances and preferences of a person: drawn once, a function of seed and id.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Traits {
    pub(super) speed_m_s: f32,
    pub(super) exclusion_m: f32,
    pub(super) acceptable_m: f32,
    pub(super) wall_exclusion_m: f32,
    pub(super) wall_acceptable_m: f32,
    /// Preferred lane: share of the way's width, from the left, 0 to 1.
    pub(super) lane: f32,
    /// Uniform draw in `[0, 1)`: where the person vanishes.
    pub(super) goal_draw: f32,
    /// Seed of the random acceleration under social forces.
    pub(super) wander: u64,
}

/// Speed from which on people run, metres per second (Alexander 1989, doi 10.1152/physrev.1989.69.4.1199).
const RUNNING_M_S: f32 = 2.1;

impl Traits {
    /// Whether the person runs: faster than people walk.
    pub(super) fn runs(&self) -> bool {
        self.speed_m_s > RUNNING_M_S
    }

    pub(super) fn draw(seed: u64, id: u32, options: &CrowdOptions) -> Traits {
        let rng = &mut person_stream(seed, id, Purpose::Walk);
        let mut draw = |d: &Distribution| d.draw(rng) as f32;
        let exclusion_m = draw(&options.exclusion);
        let wall_exclusion_m = draw(&options.wall_exclusion);
        let unit = Distribution::Uniform([0.0, 1.0]);
        Traits {
            speed_m_s: draw(&options.speed),
            exclusion_m,
            // An acceptable distance below the exclusion distance could never be kept.
            acceptable_m: draw(&options.acceptable).max(exclusion_m),
            wall_exclusion_m,
            wall_acceptable_m: draw(&options.wall_acceptable).max(wall_exclusion_m),
            lane: draw(&unit),
            goal_draw: draw(&unit),
            wander: rng.random(),
        }
    }
}

/// Progress of an agent along its route, and what it does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WalkState {
    pub(super) id: u32,
    pub(super) route: u32,
    /// Leg of the route, counted from 0.
    pub(super) leg: u32,
    /// Least walking distance left so far, metres; legs ahead count 10 km each.
    pub(super) least_left_m: f32,
    /// When that was last improved, seconds.
    pub(super) improved_s: f64,
    /// Where in a goal area the person vanishes, metres; for openings, x is the depth beyond the edge.
    pub(super) end_m: Vec2,
    /// Unit vector along the way, as last looked up.
    pub(super) wanted: [f32; 2],
    /// Number of looks for the way so far, modulo 256.
    pub(super) looks: u8,
    /// Wanted share of the free speed: less when about to stop.
    pub(super) pace: f32,
    /// Direction in which the body faces.
    pub(super) heading: Heading,
    /// Whether the person has arrived, and is about to be taken out.
    pub(super) arrived: bool,
    /// How many people of the route had arrived when this one last came nearer to its goal.
    pub(super) arrived_before: u64,
    /// Time left in which the agent does not return to its lane, since somebody comes the other way, seconds.
    pub(super) yields_s: f32,
    /// Time for which oncoming people have blocked the agent, seconds.
    pub(super) blocked_s: f32,
    /// Where an agent stands or walks that is at a stop, or on the way to one; `None` on the route.
    pub(super) visit: Option<VisitTarget>,
    /// Whether the caller leads the agent.
    pub(super) led: bool,
}

impl WalkState {
    /// The state of an agent at the beginning of the first route.
    pub(super) fn new(id: u32, heading: Heading) -> WalkState {
        WalkState {
            id,
            route: 0,
            leg: 0,
            least_left_m: f32::INFINITY,
            improved_s: 0.0,
            end_m: Vec2::ZERO,
            wanted: [1.0, 0.0],
            looks: 0,
            pace: 1.0,
            heading,
            arrived: false,
            arrived_before: 0,
            yields_s: 0.0,
            blocked_s: 0.0,
            visit: None,
            led: false,
        }
    }

    /// Turns the heading towards the velocity, or while standing towards what the agent faces.
    pub(super) fn turn(&mut self, body: &BodyState, dt: f32) {
        let faced = self.visit.and_then(|target| target.faces(body.x, body.y));
        self.heading.follow(body, faced.unwrap_or([body.aim_x, body.aim_y]), dt);
    }

    /// Share of the exclusion distance that the agent claims, 0.35 to 1.
    ///
    /// People who block each other turn sideways after a while and squeeze past.
    pub(super) fn squeeze(&self) -> f32 {
        (1.0 - (self.blocked_s - SQUEEZE_AFTER_S) / SQUEEZE_OVER_S).clamp(SQUEEZED, 1.0)
    }
}

/// Time for which blocked people wait before they squeeze past, seconds.
const SQUEEZE_AFTER_S: f32 = 4.0;
/// Time over which their exclusion distance shrinks, seconds.
const SQUEEZE_OVER_S: f32 = 8.0;
/// Least share of the exclusion distance.
const SQUEEZED: f32 = 0.35;

/// Speed above which a body faces along its velocity, metres per second.
const WALKING_M_S: f32 = 0.25;
/// Largest angular velocity of a body, radians per second: half a turn takes 1.3 s.
const FASTEST_TURN_RAD_S: f32 = 2.4;

/// Unit vector in which a body faces.
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

    /// Turns towards the velocity, or towards `faced` while the body stands, as far as `dt` seconds allow.
    pub(super) fn follow(&mut self, body: &BodyState, faced: [f32; 2], dt: f32) {
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
