//! Steering at stops: agents walk up, shuffle forward and stand.

use super::service::Stops;
use super::target::{ApproachMode, VisitTarget};
use crate::crowd::perception::Perception;
use crate::crowd::state::AgentMut;
use crate::crowd::wayfinding::own_curve;
use crate::math::Vec2;

/// Distance over which agents follow flow or field ahead, metres, and its steps.
const AHEAD_M: f64 = 0.8;
const AHEAD_STEP_M: f64 = 0.2;
/// Clearance of open floor, metres.
const OPEN_M: f64 = 1.2;
/// Time without progress after which an agent follows the shortest way instead of the flow, seconds.
const AT_A_LOSS_S: f64 = 5.0;
/// Distance at which agents walk straight to their spot, metres.
const STRAIGHT_M: f64 = 2.0;
/// Distance at which they stop going round others, metres; in a queue [`STRAIGHT_M`], since those ahead wait too.
const SHUFFLE_M: f64 = 0.5;
/// Time in which an agent would reach its spot at the current pace, seconds: it slows down on the way.
const EASING_S: f64 = 0.7;
/// Least speed of walking up to a spot, metres per second.
const SLOWEST_M_S: f64 = 0.1;
/// Distances within which a spot is reached, and beyond which it is left, metres.
const STANDING_M: [f64; 2] = [0.05, 0.09];
/// Speed below which a walking agent is held up, metres per second.
const HELD_UP_M_S: f32 = 0.1;

impl Stops {
    /// Turns an agent towards its target, and sets its pace.
    pub(in crate::crowd) fn steer(
        &self,
        target: &VisitTarget,
        AgentMut { body, walk, traits }: AgentMut<'_>,
        perception: &Perception<'_>,
        look_s: f32,
    ) {
        let time_s = perception.time_s;
        let p = body.position();
        let way = target.spot_m() - p;
        let distance_m = way.length();
        if target.mode == ApproachMode::Stand {
            let standing = walk.pace == 0.0;
            if distance_m < STANDING_M[usize::from(standing)] {
                walk.pace = 0.0;
                walk.blocked_s = 0.0;
                [body.aim_x, body.aim_y] = target.facing;
                body.half_exclusion_m = 0.5 * traits.exclusion_m;
                return;
            }
        }
        let stop = self.get(target.stop());
        let straight = target.mode != ApproachMode::Come
            && (distance_m < STRAIGHT_M || perception.environment.sight(p, target.spot_m()));
        let left_m = match stop {
            Some(stop) if !straight => stop.way.field.at(perception.environment.ground(), p),
            _ => distance_m,
        };
        // Legs ahead count for more than any plan is long; see the walk along routes.
        if (left_m as f32) < walk.least_left_m - 0.3 {
            walk.least_left_m = left_m as f32;
            walk.improved_s = time_s;
        }
        let last = [body.aim_x, body.aim_y];
        let wanted = match stop {
            Some(stop) if !straight => {
                let ground = perception.environment.ground();
                let at_a_loss = time_s - walk.improved_s > AT_A_LOSS_S;
                let flow = stop.way.flow.as_ref().filter(|_| !at_a_loss);
                let spread = flow.and_then(|flow| along(|at| flow.at(ground, at), perception, p));
                let ahead = spread.or_else(|| along(|at| stop.way.field.downhill(ground, at), perception, p));
                let open = f64::from(body.clearance_m) > OPEN_M;
                let slope = if open { own_curve(traits, left_m) } else { 0.0 };
                ahead.and_then(|ahead| (ahead + ahead.left() * slope).normalized())
            }
            _ => way.normalized(),
        };
        let wanted = wanted.map_or(last, |unit| [unit.x as f32, unit.y as f32]);
        let straight_m = if target.squeezes { SHUFFLE_M } else { STRAIGHT_M };
        let shuffles = target.mode == ApproachMode::Stand && distance_m < straight_m;
        [body.aim_x, body.aim_y] =
            if shuffles { wanted } else { perception.detour(body, traits, wanted).turn(wanted, last) };
        walk.wanted = wanted;
        let speed_m_s = f64::from(traits.speed_m_s);
        walk.pace = match target.mode {
            ApproachMode::Stand => ((distance_m / EASING_S).max(SLOWEST_M_S) / speed_m_s).min(1.0) as f32,
            ApproachMode::Come | ApproachMode::Pass => 1.0,
        };
        let held_up = body.vx * wanted[0] + body.vy * wanted[1] < HELD_UP_M_S;
        let blocked = target.squeezes && held_up || perception.is_blocked(body, wanted);
        walk.blocked_s = (walk.blocked_s + if blocked { look_s } else { -4.0 * look_s }).max(0.0);
        body.half_exclusion_m = 0.5 * traits.exclusion_m * walk.squeeze();
    }
}

/// Direction of the farthest place in sight along a field of directions.
fn along(leads: impl Fn(Vec2) -> Option<Vec2>, perception: &Perception<'_>, p: Vec2) -> Option<Vec2> {
    let mut at = p + leads(p)? * AHEAD_STEP_M;
    for _ in 1..(AHEAD_M / AHEAD_STEP_M) as usize {
        let Some(next) = leads(at).map(|direction| at + direction * AHEAD_STEP_M) else { break };
        if !perception.environment.sight(p, next) {
            break;
        }
        at = next;
    }
    (at - p).normalized()
}
