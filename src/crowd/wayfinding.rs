//! Wayfinding: along the flow that spreads people over all sensible ways, see [`Flow`](crate::routes).

use std::f64::consts::TAU;

use super::environment::Environment;
use super::state::{AgentMut, Traits, WalkState};
use crate::math::{Vec2, sin_cos};
use crate::plan::Opening;
use crate::routes::{Field, Flow, Leg, Place, RouteLegs};

/// Walking distance at which a place between start and goal counts as passed, metres.
const PASSED_M: f64 = 0.3;
/// Distance over which agents follow the flow ahead, metres: it swerves into niches, people do not.
const AHEAD_M: f64 = 2.4;
/// Time over which runners follow the flow ahead, seconds: seen later, a bend would carry them to its outer wall.
const RUNNERS_AHEAD_S: f64 = 3.0;
/// Pieces of that distance on open floor, and near walls.
const PIECES: usize = 3;
const PIECES_AT_WALLS: usize = 6;
/// Clearance of open floor, metres.
const OPEN_M: f64 = 2.0;
/// Distance from corners, metres.
const CORNER_M: f64 = 0.4;
/// Distance in which agents drift to their lane, metres, and the largest slope of the drift.
const LANE_REACH_M: f64 = 6.0;
const MOST_SLOPE: f64 = 0.2;
/// Distance behind and ahead at which the width of the way is measured, metres.
const BESIDE_M: f64 = 2.5;
/// Distance of walls beyond which there are no lanes, metres.
const WIDEST_M: f64 = 6.0;
/// Share of the straight way in the direction that people take where it is free, with that much left to walk and less,
/// metres, and the distance from which on there is none: from far away people do not make for a door yet.
const STRAIGHT: f64 = 0.8;
/// Width up to which the end of a leg draws people straight there, metres; over wider ones they spread.
const NARROW_M: f64 = 2.0;
const STRAIGHT_M: [f64; 2] = [28.0, 44.0];
/// Distance that has to be free, metres and as a share of the whole, and the clearance that a straight way keeps, metres.
const FREE_M: f64 = 12.0;
const FREE_SHARE: f64 = 0.8;
const FREE_CLEAR_M: f64 = 0.3;
/// Clearance here or ahead from which on straight ways are looked for, metres: in corridors there is nothing to choose.
const HALL_M: f64 = 1.3;
/// Waves of the ways that people take through halls: length along the way, metres, and slope at its steepest.
const WAVES: [(f64, f64); 2] = [(26.0, 0.16), (11.0, 0.08)];
/// Walking distance to the end of the leg over which ways come together, metres.
const TOGETHER_M: f64 = 6.0;
/// Distance down the distance field at which agents aim, metres.
const FIELD_AIM_M: f64 = 1.2;
/// Time without progress after which anywhere in a goal area is good enough, seconds.
const AT_A_LOSS_S: f64 = 3.0;
/// Period, and its first part in which agents without progress follow the flow, seconds; then the shortest way.
const RETHINK_S: f64 = 15.0;
const RETHOUGHT_S: f64 = 10.0;
/// Largest slope by which blocked agents step to their right, and the time after which it is reached, seconds.
const MOST_ASIDE: f64 = 0.7;
const ASIDE_S: f64 = 2.0;
/// Walking distance to the goal at which agents go straight to their visible place in it, metres.
const HOMING_M: f64 = 2.5;
/// Distance over which agents slow down towards their place in a goal area, metres.
const EASING_M: f64 = 1.2;
/// Largest share of a way's width that is left to the wall on either side.
const MARGIN_SHARE: f64 = 0.15;

/// Finds the way along the routes of an environment.
pub(super) struct Wayfinder<'e> {
    environment: &'e Environment<'e>,
    /// How much ways through halls curve: 1, or 0 for agents that wander by themselves.
    curves: f64,
}

impl<'e> Wayfinder<'e> {
    pub(super) fn new(environment: &'e Environment<'e>) -> Wayfinder<'e> {
        Wayfinder { environment, curves: 1.0 }
    }

    /// The same for agents that wander by themselves.
    pub(super) fn of_wanderers(environment: &'e Environment<'e>) -> Wayfinder<'e> {
        Wayfinder { environment, curves: 0.0 }
    }

    fn way(&self, walk: &WalkState) -> &RouteLegs {
        &self.environment.navigation.ways[walk.route as usize]
    }

    fn leg(&self, walk: &WalkState) -> Leg {
        let legs = &self.way(walk).legs;
        legs[(walk.leg as usize).min(legs.len() - 1)]
    }

    fn field(&self, walk: &WalkState) -> &Field {
        &self.environment.navigation.fields[self.leg(walk).field]
    }

    fn flow(&self, walk: &WalkState) -> Option<&Flow> {
        self.leg(walk).flow.map(|flow| &*self.environment.navigation.flows[flow])
    }

    fn is_on_last_leg(&self, walk: &WalkState) -> bool {
        walk.leg as usize + 1 >= self.way(walk).legs.len()
    }

    /// Walking distance to the end of the leg, metres.
    fn left_m(&self, walk: &WalkState, p: Vec2) -> f64 {
        self.field(walk).at(self.environment.ground(), p)
    }

    /// Goes on to the next leg where one is done, notes the progress, and returns the walking distance to the end of the
    /// leg, metres.
    pub(super) fn advance(&self, walk: &mut WalkState, p: Vec2, time_s: f64) -> f64 {
        let mut left_m = self.left_m(walk, p);
        while left_m < PASSED_M && !self.is_on_last_leg(walk) {
            walk.leg += 1;
            left_m = self.left_m(walk, p);
        }
        let legs_left = self.way(walk).legs.len() - 1 - walk.leg as usize;
        // Legs ahead count for more than any plan is long, so that the sum falls at every turn.
        let total = (left_m + legs_left as f64 * 1e4) as f32;
        if total < walk.least_left_m - 0.3 {
            walk.least_left_m = total;
            walk.improved_s = time_s;
        }
        left_m
    }

    /// Sets the direction and the pace at which an agent wants to walk on.
    pub(super) fn look(&self, agent: &mut AgentMut<'_>, time_s: f64) {
        let p = agent.body.position();
        let left_m = self.advance(agent.walk, p, time_s);
        let aim = self.aim(agent.walk, agent.traits, (p, left_m), agent.body.aim(), time_s);
        agent.walk.wanted = [aim.x as f32, aim.y as f32];
        agent.walk.pace = self.pace(agent.walk, p);
    }

    /// The unit vector in which a person wants to walk, at a place with that much left to the end of the leg, metres.
    pub(super) fn aim(
        &self,
        walk: &WalkState,
        traits: &Traits,
        (p, left_m): (Vec2, f64),
        last: Vec2,
        time_s: f64,
    ) -> Vec2 {
        if let Some(end) = self.to_the_end(walk, traits, p, left_m) {
            return end;
        }
        // Agents that get no farther in the flow try the shortest way.
        let at_a_loss = (time_s - walk.improved_s) % RETHINK_S > RETHOUGHT_S;
        let ahead = match self.flow(walk) {
            _ if at_a_loss => None,
            Some(flow) => self.along_the_flow(flow, walk, traits, p, left_m),
            // Without a flow lanes spread people.
            None => self.down_the_field(walk, p),
        };
        let ahead = ahead.map(|aim| self.towards_lane(walk, traits, p, aim));
        let aim = ahead.or_else(|| self.down_the_field(walk, p)).unwrap_or(last);
        give_way(aim, walk.blocked_s)
    }

    /// Direction of a place some way along the flow, in sight; where the end of the leg is in sight, mostly straight there,
    /// and elsewhere in halls with a curve of the person's own.
    fn along_the_flow(&self, flow: &Flow, walk: &WalkState, traits: &Traits, p: Vec2, left_m: f64) -> Option<Vec2> {
        let ground = self.environment.ground();
        let open = ground.clearance_at_least_m(p) > OPEN_M;
        let pieces = if open { PIECES } else { PIECES_AT_WALLS };
        let ahead_m = if traits.runs() { RUNNERS_AHEAD_S * f64::from(traits.speed_m_s) } else { AHEAD_M };
        let step_m = ahead_m / pieces as f64;
        // Corners are cut no closer than that, but agents nearer to a wall may walk on.
        let margin_m = CORNER_M.min(0.9 * ground.clearance_at_least_m(p)).max(0.05);
        let first = flow.at(ground, p)?;
        let mut at = p + first * step_m;
        for _ in 1..pieces {
            let Some(ahead) = flow.at(ground, at) else { break };
            let next = at + ahead * step_m;
            if !open && !self.environment.is_free(p, next, margin_m) {
                break;
            }
            at = next;
        }
        let ahead = (at - p).normalized()?;
        let straight = match self.straight(walk, p, left_m) {
            Some(straight) => {
                let [near_m, far_m] = STRAIGHT_M;
                let share = STRAIGHT * ((far_m - left_m) / (far_m - near_m)).clamp(0.0, 1.0);
                ahead + (straight - ahead) * share
            }
            None if open => ahead + ahead.left() * (self.curves * own_curve(traits, left_m)),
            None => ahead,
        };
        straight.normalized()
    }

    /// Width of the end of the leg, metres.
    fn end_width_m(&self, walk: &WalkState) -> f64 {
        let route = &self.environment.routes[walk.route as usize];
        match route.via.get(walk.leg as usize).map_or(route.goal, |via| via.place) {
            Place::Opening(index) => self.environment.plan.openings.get(index).map_or(0.0, Opening::width_m),
            Place::Area([min, max]) => (max.x - min.x).max(max.y - min.y),
        }
    }

    /// Direction of the shortest way to the end of the leg, where it is straight and free.
    fn straight(&self, walk: &WalkState, p: Vec2, left_m: f64) -> Option<Vec2> {
        if left_m > STRAIGHT_M[1] || self.end_width_m(walk) > NARROW_M {
            return None;
        }
        let ground = self.environment.ground();
        let down = self.field(walk).downhill(ground, p)?;
        let is_hall = |p: Vec2| ground.clearance_at_least_m(p) > HALL_M;
        if !is_hall(p) && !is_hall(p + down * AHEAD_M) {
            return None;
        }
        self.environment.is_free(p, p + down * (FREE_SHARE * left_m).min(FREE_M), FREE_CLEAR_M).then_some(down)
    }

    /// Turns the direction towards the agent's lane in a corridor: after a bend people spread again.
    ///
    /// In halls, and at crossings, there is no width to share.
    fn towards_lane(&self, walk: &WalkState, traits: &Traits, p: Vec2, aim: Vec2) -> Vec2 {
        if walk.yields_s > 0.0 {
            return aim;
        }
        let across = aim.left();
        // As wide as the way is behind and ahead: a niche is no part of it.
        let [behind, ahead] = [p - aim * BESIDE_M, p + aim * BESIDE_M];
        let room = |side| Some(self.room_m(behind, side)?.min(self.room_m(ahead, side)?));
        let [Some(left_m), Some(right_m)] = [across, -across].map(room) else { return aim };
        let width_m = left_m + right_m;
        let margin_m = f64::from(traits.wall_acceptable_m).min(MARGIN_SHARE * width_m);
        let liked_m = margin_m + f64::from(traits.lane) * (width_m - 2.0 * margin_m);
        let slope = ((left_m - liked_m) / LANE_REACH_M).clamp(-MOST_SLOPE, MOST_SLOPE);
        (aim + across * slope).normalized().unwrap_or(aim)
    }

    /// Distance of the wall in a direction, metres, if it is no farther than corridors are wide.
    fn room_m(&self, p: Vec2, direction: Vec2) -> Option<f64> {
        let ground = self.environment.ground();
        let mut done_m = 0.0;
        while done_m < WIDEST_M {
            let free_m = ground.clearance_at_least_m(p + direction * done_m);
            if free_m < 0.1 {
                // As far as the lower bound falls short of the clearance.
                return Some(done_m + 0.2);
            }
            done_m += free_m;
        }
        None
    }

    /// Direction of a place some way down the distance field, in sight.
    fn down_the_field(&self, walk: &WalkState, p: Vec2) -> Option<Vec2> {
        let field = self.field(walk);
        let ground = self.environment.ground();
        let step = 0.15;
        let mut at = p;
        let mut aim = None;
        for _ in 0..(FIELD_AIM_M / step) as usize {
            let Some(down) = field.downhill(ground, at) else { break };
            at += down * step;
            if aim.is_some() && !self.environment.sight(p, at) {
                break;
            }
            aim = (at - p).normalized().or(aim);
        }
        aim
    }

    /// Direction out of the opening that has been reached, or to the visible place in the goal area nearby.
    fn to_the_end(&self, walk: &WalkState, traits: &Traits, p: Vec2, left_m: f64) -> Option<Vec2> {
        if !self.is_on_last_leg(walk) || f64::from(walk.least_left_m) > HOMING_M + 1.0 {
            return None;
        }
        match self.environment.routes[walk.route as usize].goal {
            Place::Opening(index) if left_m <= 0.0 => {
                self.environment.plan.openings.get(index).map(|o| o.side.outward())
            }
            Place::Area(_) if left_m <= HOMING_M => {
                let ground = self.environment.ground();
                let margin_m = f64::from(traits.wall_exclusion_m).min(ground.gap_limit_m(p));
                let margin_m = (0.9 * margin_m).min(ground.clearance_at_least_m(p)).max(0.08);
                let free = left_m <= 0.0 || self.environment.is_free(p, walk.end_m, margin_m);
                (walk.end_m - p).normalized().filter(|_| free)
            }
            _ => None,
        }
    }

    /// Wanted share of the speed: 1 on the way, less near the end.
    fn pace(&self, walk: &WalkState, p: Vec2) -> f32 {
        match self.environment.routes[walk.route as usize].goal {
            Place::Area(_) if self.is_on_last_leg(walk) => ((walk.end_m.distance(p) / EASING_M) as f32).clamp(0.3, 1.0),
            _ => 1.0,
        }
    }

    /// Whether the person has arrived.
    pub(super) fn has_arrived(&self, walk: &WalkState, p: Vec2, speed_m_s: f32, time_s: f64) -> bool {
        if !self.is_on_last_leg(walk) {
            return false;
        }
        match self.environment.routes[walk.route as usize].goal {
            Place::Opening(index) => {
                let Some(opening) = self.environment.plan.openings.get(index) else { return true };
                let along = (opening.to_m - opening.from_m) / opening.width_m().max(1e-9);
                let beside = !(0.0..=opening.width_m()).contains(&(p - opening.from_m).dot(along));
                !beside && (p - opening.from_m).dot(opening.side.outward()) > walk.end_m.x
            }
            Place::Area([min, max]) => {
                let inside = p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
                let at_place = p.distance(walk.end_m) < 0.4;
                // Where others or a chair stand in the way, being there is enough.
                let hindered = speed_m_s < 0.15 || time_s - walk.improved_s > AT_A_LOSS_S;
                at_place || inside && hindered && self.left_m(walk, p) < 0.3
            }
        }
    }
}

/// Slope of the person's own way against everybody's, at a walking distance from the end of the leg.
pub(super) fn own_curve(traits: &Traits, left_m: f64) -> f64 {
    if !left_m.is_finite() {
        return 0.0;
    }
    let wave = |(&(length_m, steepest), start): (&(f64, f64), f32)| {
        steepest * sin_cos(TAU * (left_m / length_m + f64::from(start))).0
    };
    let together = (left_m / TOGETHER_M).min(1.0);
    together * WAVES.iter().zip([traits.lane, traits.goal_draw]).map(wave).sum::<f64>()
}

/// Turns a blocked agent to its right, the more the longer it has been blocked.
fn give_way(aim: Vec2, blocked_s: f32) -> Vec2 {
    if blocked_s <= 0.0 {
        return aim;
    }
    let right = -aim.left() * (MOST_ASIDE * (f64::from(blocked_s) / ASIDE_S).min(1.0));
    (aim + right).normalized().unwrap_or(aim)
}

/// Place at an opening's edge where a person enters: in the own lane, at an acceptable distance from walls.
pub(super) fn entry_place(opening: &Opening, traits: &Traits) -> Vec2 {
    let width_m = opening.width_m();
    let margin = (f64::from(traits.wall_acceptable_m) / width_m.max(0.01)).min(MARGIN_SHARE);
    let share = margin + f64::from(traits.lane) * (1.0 - 2.0 * margin);
    // Lanes count from the left of those who come in.
    let left = (-opening.side.outward()).left();
    let from_left = (opening.to_m - opening.from_m).dot(left) < 0.0;
    opening.from_m.lerp(opening.to_m, if from_left { share } else { 1.0 - share })
}
