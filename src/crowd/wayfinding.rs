//! Where people want to go: along the flow that spreads them over all sensible ways, see [`Flow`](crate::routes).

use super::environment::Environment;
use super::state::{AgentMut, Traits, WalkState};
use crate::math::Vec2;
use crate::plan::Opening;
use crate::routes::{Field, Flow, Leg, Place, Way};

/// A place between start and goal counts as passed from this walking distance on, metres.
const PASSED_M: f64 = 0.3;
/// People look so far ahead along the flow, metres: it swerves into every niche, they do not ...
const AHEAD_M: f64 = 2.4;
/// ... in so many pieces, and in more of them where walls are near.
const PIECES: usize = 3;
const PIECES_AT_WALLS: usize = 6;
/// Clearance from which on no wall is near, metres.
const OPEN_M: f64 = 2.0;
/// Distance kept from corners, metres.
const CORNER_M: f64 = 0.4;
/// People drift towards their lane so that they would reach it in this distance, metres, by at most this slope.
const LANE_REACH_M: f64 = 6.0;
const MOST_SLOPE: f64 = 0.2;
/// The width of the way is measured so far behind and ahead of a person, metres.
const BESIDE_M: f64 = 2.5;
/// With walls farther off than this, metres, there are no lanes.
const WIDEST_M: f64 = 6.0;
/// Following the distance field, people aim at the place that is this far down it, metres.
const FIELD_AIM_M: f64 = 1.2;
/// Whoever has made no way for so long, seconds, has no business elsewhere in a goal area any more.
const AT_A_LOSS_S: f64 = 3.0;
/// Without way made people follow the shortest way instead of the flow for the last part of each such time, seconds.
const RETHINK_S: f64 = 15.0;
const RETHOUGHT_S: f64 = 10.0;
/// Those who block each other step to their right by up to this slope, reached after so many seconds.
const MOST_ASIDE: f64 = 0.7;
const ASIDE_S: f64 = 2.0;
/// From this walking distance to the goal's edge people in sight of their place in it go straight there, metres.
const HOMING_M: f64 = 2.5;
/// From this distance on people slow down towards the place where they stop, metres.
const EASING_M: f64 = 1.2;
/// At most this share of a way's width on either side is left to the walls.
const MARGIN_SHARE: f64 = 0.15;

/// Finds the way along the routes of an environment.
pub(super) struct Wayfinder<'e>(pub(super) &'e Environment<'e>);

impl Wayfinder<'_> {
    fn way(&self, walk: &WalkState) -> &Way {
        &self.0.navigation.ways[walk.route as usize]
    }

    fn leg(&self, walk: &WalkState) -> Leg {
        let legs = &self.way(walk).legs;
        legs[(walk.leg as usize).min(legs.len() - 1)]
    }

    fn field(&self, walk: &WalkState) -> &Field {
        &self.0.navigation.fields[self.leg(walk).field]
    }

    fn flow(&self, walk: &WalkState) -> &Flow {
        &self.0.navigation.flows[self.leg(walk).flow]
    }

    fn is_on_last_leg(&self, walk: &WalkState) -> bool {
        walk.leg as usize + 1 >= self.way(walk).legs.len()
    }

    /// Walking distance to the end of the leg, metres.
    fn left_m(&self, walk: &WalkState, p: Vec2) -> f64 {
        self.field(walk).at(self.0.ground(), p)
    }

    /// Goes on to the next leg where one is done, and notes how far the person has come.
    pub(super) fn advance(&self, walk: &mut WalkState, p: Vec2, time_s: f64) {
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
    }

    /// Sets the direction and the pace at which an agent wants to walk on.
    pub(super) fn look(&self, agent: &mut AgentMut<'_>, time_s: f64) {
        let p = agent.body.position();
        self.advance(agent.walk, p, time_s);
        let aim = self.aim(agent.walk, agent.traits, p, agent.body.aim(), time_s);
        agent.walk.wanted = [aim.x as f32, aim.y as f32];
        agent.walk.pace = self.pace(agent.walk, p);
    }

    /// The unit vector in which the person wants to walk.
    pub(super) fn aim(&self, walk: &WalkState, traits: &Traits, p: Vec2, last: Vec2, time_s: f64) -> Vec2 {
        if let Some(end) = self.to_the_end(walk, traits, p) {
            return end;
        }
        // Who gets no farther in the flow tries the shortest way.
        let at_a_loss = (time_s - walk.improved_s) % RETHINK_S > RETHOUGHT_S;
        let flow = if at_a_loss {
            None
        } else {
            self.along_the_flow(walk, p).map(|aim| self.towards_lane(walk, traits, p, aim))
        };
        let aim = flow.or_else(|| self.down_the_field(walk, p)).unwrap_or(last);
        give_way(aim, walk.blocked_s)
    }

    /// Direction of a place some way along the flow, in sight.
    fn along_the_flow(&self, walk: &WalkState, p: Vec2) -> Option<Vec2> {
        let ground = self.0.ground();
        let flow = self.flow(walk);
        let open = ground.clearance_at_least_m(p) > OPEN_M;
        let pieces = if open { PIECES } else { PIECES_AT_WALLS };
        let step_m = AHEAD_M / pieces as f64;
        // Nobody cuts a corner closer than that, but those who stand nearer to a wall may walk on.
        let margin_m = CORNER_M.min(0.9 * ground.clearance_at_least_m(p)).max(0.05);
        let first = flow.at(ground, p)?;
        let mut at = p + first * step_m;
        for _ in 1..pieces {
            let Some(ahead) = flow.at(ground, at) else { break };
            let next = at + ahead * step_m;
            if !open && !self.0.is_free(p, next, margin_m) {
                break;
            }
            at = next;
        }
        (at - p).normalized()
    }

    /// Lets the way lead towards the share of a corridor's width that the person likes best: after a bend people spread
    /// again. In halls, and at crossings, there is no width to share.
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
        let ground = self.0.ground();
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
        let ground = self.0.ground();
        let step = 0.15;
        let mut at = p;
        let mut aim = None;
        for _ in 0..(FIELD_AIM_M / step) as usize {
            let Some(down) = field.downhill(ground, at) else { break };
            at += down * step;
            if aim.is_some() && !self.0.sight(p, at) {
                break;
            }
            aim = (at - p).normalized().or(aim);
        }
        aim
    }

    /// Direction out of the plan for those who have reached their opening, or to the place where the person vanishes for
    /// those who are near and see it.
    fn to_the_end(&self, walk: &WalkState, traits: &Traits, p: Vec2) -> Option<Vec2> {
        if !self.is_on_last_leg(walk) || f64::from(walk.least_left_m) > HOMING_M + 1.0 {
            return None;
        }
        let left_m = self.left_m(walk, p);
        match self.0.routes[walk.route as usize].goal {
            Place::Opening(index) if left_m <= 0.0 => self.0.plan.openings.get(index).map(|o| o.side.outward()),
            Place::Area(_) if left_m <= HOMING_M => {
                let ground = self.0.ground();
                let margin_m = f64::from(traits.wall_exclusion_m).min(ground.gap_limit_m(p));
                let margin_m = (0.9 * margin_m).min(ground.clearance_at_least_m(p)).max(0.08);
                let free = left_m <= 0.0 || self.0.is_free(p, walk.end_m, margin_m);
                (walk.end_m - p).normalized().filter(|_| free)
            }
            _ => None,
        }
    }

    /// Share of the speed that the person wants: all of it on the way, less where the end is near.
    fn pace(&self, walk: &WalkState, p: Vec2) -> f32 {
        match self.0.routes[walk.route as usize].goal {
            Place::Area(_) if self.is_on_last_leg(walk) => ((walk.end_m.distance(p) / EASING_M) as f32).clamp(0.3, 1.0),
            _ => 1.0,
        }
    }

    /// Whether the person has arrived.
    pub(super) fn has_arrived(&self, walk: &WalkState, p: Vec2, speed_m_s: f32, time_s: f64) -> bool {
        if !self.is_on_last_leg(walk) {
            return false;
        }
        match self.0.routes[walk.route as usize].goal {
            Place::Opening(index) => {
                let Some(opening) = self.0.plan.openings.get(index) else { return true };
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

/// Whoever is in the way of somebody who comes the other way keeps to the right, the more the longer it takes.
fn give_way(aim: Vec2, blocked_s: f32) -> Vec2 {
    if blocked_s <= 0.0 {
        return aim;
    }
    let right = -aim.left() * (MOST_ASIDE * (f64::from(blocked_s) / ASIDE_S).min(1.0));
    (aim + right).normalized().unwrap_or(aim)
}

/// The place at an opening's edge where a person likes to enter: in the own lane, off the walls by as much as the person
/// likes.
pub(super) fn entry_place(opening: &Opening, traits: &Traits) -> Vec2 {
    let width_m = opening.width_m();
    let margin = (f64::from(traits.wall_acceptable_m) / width_m.max(0.01)).min(MARGIN_SHARE);
    let share = margin + f64::from(traits.lane) * (1.0 - 2.0 * margin);
    // Lanes count from the left of those who come in.
    let left = (-opening.side.outward()).left();
    let from_left = (opening.to_m - opening.from_m).dot(left) < 0.0;
    opening.from_m.lerp(opening.to_m, if from_left { share } else { 1.0 - share })
}
