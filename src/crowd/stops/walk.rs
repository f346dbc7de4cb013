//! How people walk to a stop, shuffle forward and stand.

use super::errand::Mode;
use super::{Errand, Stops};
use crate::crowd::avoidance::Sights;
use crate::crowd::state::{Body, Course, Traits};
use crate::math::Vec2;

/// How far ahead people look on the way to a stop, metres, and in which steps.
const AHEAD_M: f64 = 0.8;
const AHEAD_STEP_M: f64 = 0.2;
/// Whoever makes no way for so long on the way that people spread over takes the shortest, seconds.
const AT_A_LOSS_S: f64 = 5.0;
/// From this distance on people walk straight to their spot, metres ...
const STRAIGHT_M: f64 = 2.0;
/// ... without going round others: from here on, or in a line, where those before them are not in the way but wait.
const SHUFFLE_M: f64 = 0.5;
/// Somebody who walks up to a spot would be there in this time, seconds, all the way: so they slow down.
const EASING_S: f64 = 0.7;
/// Nobody walks to a spot more slowly than this, metres per second.
const SLOWEST_M_S: f64 = 0.1;
/// A spot is reached within the first, and left behind beyond the second, metres.
const STANDING_M: [f64; 2] = [0.05, 0.09];
/// Whoever makes less way than this although they want to, metres per second, is held up.
const HELD_UP_M_S: f32 = 0.1;

impl Stops {
    /// Turns somebody on an errand where it leads, and sets how fast they want to go.
    pub(in crate::crowd) fn steer(
        &self,
        errand: &Errand,
        (body, course, traits): (&mut Body, &mut Course, &Traits),
        sights: &Sights<'_>,
        time_s: f64,
        look_s: f32,
    ) {
        let p = body.position();
        let way = errand.spot_m() - p;
        let distance_m = way.length();
        if errand.mode() == Mode::Stand {
            let standing = course.pace == 0.0;
            if distance_m < STANDING_M[usize::from(standing)] {
                course.pace = 0.0;
                course.blocked_s = 0.0;
                [body.aim_x, body.aim_y] = errand.facing();
                body.half_exclusion_m = 0.5 * traits.exclusion_m;
                return;
            }
        }
        let post = self.posts.get(errand.post());
        let straight = errand.mode() != Mode::Come
            && (distance_m < STRAIGHT_M || sights.ground.sight(sights.walls, p, errand.spot_m()));
        let left_m = match post {
            Some(post) if !straight => post.field.at(sights.ground, p),
            _ => distance_m,
        };
        // Legs ahead count for more than any plan is long; see the walk along routes.
        if (left_m as f32) < course.least_left_m - 0.3 {
            course.least_left_m = left_m as f32;
            course.improved_s = time_s;
        }
        let last = [body.aim_x, body.aim_y];
        let wanted = match post {
            Some(post) if !straight => {
                let at_a_loss = time_s - course.improved_s > AT_A_LOSS_S;
                let spread = along(|at| post.flow.at(sights.ground, at), sights, p).filter(|_| !at_a_loss);
                spread.or_else(|| along(|at| post.field.downhill(sights.ground, at), sights, p))
            }
            _ => way.normalized(),
        };
        let wanted = wanted.map_or(last, |unit| [unit.x as f32, unit.y as f32]);
        let straight_m = if errand.squeezes() { SHUFFLE_M } else { STRAIGHT_M };
        let shuffles = errand.mode() == Mode::Stand && distance_m < straight_m;
        [body.aim_x, body.aim_y] =
            if shuffles { wanted } else { sights.detour(body, traits.speed_m_s, wanted).turn(wanted, last) };
        course.wanted = wanted;
        let speed_m_s = f64::from(traits.speed_m_s);
        course.pace = match errand.mode() {
            Mode::Stand => ((distance_m / EASING_S).max(SLOWEST_M_S) / speed_m_s).min(1.0) as f32,
            Mode::Come | Mode::Pass => 1.0,
        };
        let held_up = body.vx * wanted[0] + body.vy * wanted[1] < HELD_UP_M_S;
        let blocked = errand.squeezes() && held_up || sights.is_blocked(body, wanted);
        course.blocked_s = (course.blocked_s + if blocked { look_s } else { -4.0 * look_s }).max(0.0);
        body.half_exclusion_m = 0.5 * traits.exclusion_m * course.squeeze();
    }
}

/// Direction of a place some way along what leads to the stop, in sight.
fn along(leads: impl Fn(Vec2) -> Option<Vec2>, sights: &Sights<'_>, p: Vec2) -> Option<Vec2> {
    let mut at = p + leads(p)? * AHEAD_STEP_M;
    for _ in 1..(AHEAD_M / AHEAD_STEP_M) as usize {
        let Some(next) = leads(at).map(|direction| at + direction * AHEAD_STEP_M) else { break };
        if !sights.ground.sight(sights.walls, p, next) {
            break;
        }
        at = next;
    }
    (at - p).normalized()
}
