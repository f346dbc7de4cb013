//! One step of somebody under social forces: a pure function of everybody's current state.

use super::forces::Forces;
use crate::crowd::neighbours::Neighbours;
use crate::crowd::state::{Body, Traits};
use crate::crowd::walking::{CALMS_DOWN_M_S2, MOST_ACCELERATION, Move};
use crate::math::vec2;
use crate::routes::Ground;
use crate::walls::Walls;

/// Others matter within this distance at most, metres ...
pub(super) const REACH_M: f32 = 4.0;
/// ... and all of them within this; farther away only those who come nearer.
const NEAR_M: f32 = 2.0;
/// Whoever is nearer than this to touching may be bumped into in a step, metres.
const CONTACT_M: f32 = 0.3;
/// A body is moved by no more than this in a step, metres: what lies farther off a wall need not be looked up.
const MOST_MOVED_M: f32 = 0.6;
/// The mere presence of others keeps nobody from going forward this slowly, metres per second: bodies do.
const LEAST_SPEED_M_S: f32 = 0.1;

/// What one step looks at.
pub(super) struct Scene<'a> {
    pub(super) neighbours: &'a Neighbours,
    pub(super) ground: &'a Ground,
    pub(super) walls: &'a Walls,
    pub(super) forces: Forces,
    pub(super) most_speed: f32,
    pub(super) time_s: f64,
    pub(super) dt: f32,
}

impl Scene<'_> {
    /// The next move of the body at this index of the sorted list. Its group stands at `mates`, as seen from it, and has
    /// the indices `own_group`.
    pub(super) fn next(&self, index: usize, traits: &Traits, pace: f32, own_group: &[u32]) -> Move {
        let me = &self.neighbours.bodies[index];
        let aim = [me.aim_x, me.aim_y];
        let wanted_speed = traits.speed_m_s * pace;
        let mut next = Move { wall_limit_m: traits.wall_exclusion_m, ..Move::default() };
        let [px, py] = self.by_others(index, own_group, &mut next);
        let [gx, gy] = self.by_group(me, own_group);
        // Whoever walks up to a spot to stand there, or stands, heeds the spot more than others.
        let heed = pace.min(1.0);
        let [rx, ry] = self.forces.by_chance(traits.wander, self.time_s);
        let mut ax = (aim[0] * wanted_speed - me.vx) / self.forces.relaxation_s + heed * (px + gx + rx);
        let mut ay = (aim[1] * wanted_speed - me.vy) / self.forces.relaxation_s + heed * (py + gy + ry);
        if let Some([wx, wy]) = self.by_wall(me, &mut next) {
            ax += heed * wx;
            ay += heed * wy;
        }
        let a = (ax * ax + ay * ay).sqrt();
        let ease = if a > MOST_ACCELERATION { MOST_ACCELERATION / a } else { 1.0 };
        let [mut vx, mut vy] = [me.vx + ax * ease * self.dt, me.vy + ay * ease * self.dt];
        let short = wanted_speed.min(LEAST_SPEED_M_S) - (vx * aim[0] + vy * aim[1]);
        let own = me.vx * aim[0] + me.vy * aim[1];
        if short > 0.0 && own > -LEAST_SPEED_M_S {
            vx += short * aim[0];
            vy += short * aim[1];
        }
        let speed = (vx * vx + vy * vy).sqrt();
        let own_speed = (me.vx * me.vx + me.vy * me.vy).sqrt();
        let most = (self.most_speed * traits.speed_m_s).max(own_speed - CALMS_DOWN_M_S2 * self.dt);
        if speed > most {
            vx *= most / speed;
            vy *= most / speed;
        }
        next.x = me.x + vx * self.dt;
        next.y = me.y + vy * self.dt;
        next
    }

    /// The sum of what everybody else does but the own group; notes who may be touched.
    fn by_others(&self, index: usize, own_group: &[u32], next: &mut Move) -> [f32; 2] {
        let me = &self.neighbours.bodies[index];
        let aim = [me.aim_x, me.aim_y];
        let mut sum = [0.0f32; 2];
        self.neighbours.within(me.x, me.y, REACH_M, |range, shift| {
            let x = me.x - shift;
            let start = range.start;
            for (k, body) in self.neighbours.bodies[range].iter().enumerate() {
                let other = start + k;
                let d = [body.x - x, body.y - me.y];
                let d2 = d[0] * d[0] + d[1] * d[1];
                if d2 >= REACH_M * REACH_M || other == index {
                    continue;
                }
                let w = [body.vx - me.vx, body.vy - me.vy];
                if d2 > NEAR_M * NEAR_M && d[0] * w[0] + d[1] * w[1] > 0.0 {
                    continue;
                }
                let touching_m = me.half_exclusion_m + body.half_exclusion_m + CONTACT_M;
                let touches = d2 < touching_m * touching_m;
                let clear_m = me.clearance_m + body.clearance_m;
                if d2 > clear_m * clear_m && !self.sees(me, d) {
                    continue;
                }
                if touches && let Some(contact) = next.contacts.get_mut(next.contact_count as usize) {
                    *contact = other as u32;
                    next.contact_count += 1;
                }
                if !own_group.contains(&(other as u32)) {
                    let [ax, ay] = self.forces.by_person(d, w, aim);
                    sum[0] += ax;
                    sum[1] += ay;
                }
            }
        });
        sum
    }

    /// What the own group does, as far as it is in sight.
    fn by_group(&self, me: &Body, own_group: &[u32]) -> [f32; 2] {
        let mut mates = [[0.0f32; 2]; 3];
        let mut count = 0;
        for &other in own_group {
            let body = &self.neighbours.bodies[other as usize];
            let d = [self.neighbours.dx(me.x, body.x), body.y - me.y];
            if let Some(mate) = mates.get_mut(count)
                && self.sees(me, d)
            {
                *mate = d;
                count += 1;
            }
        }
        if count == 0 { [0.0; 2] } else { self.forces.by_group(&mates[..count], [me.vx, me.vy]) }
    }

    /// Acceleration away from the nearest wall; notes how near to it the body may come.
    fn by_wall(&self, me: &Body, next: &mut Move) -> Option<[f32; 2]> {
        let limit_m = next.wall_limit_m;
        let reach_m = limit_m + self.forces.wall_reach_m().max(MOST_MOVED_M);
        if me.clearance_m >= reach_m {
            return None;
        }
        let at = me.position();
        next.wall_limit_m = limit_m.min(self.ground.gap_limit_m(at) as f32);
        let nearest = self.walls.nearest(at, f64::from(reach_m))?;
        let away = (at - nearest.point_m).normalized()?;
        let push = self.forces.by_wall(nearest.distance_m as f32 - next.wall_limit_m);
        Some([push * away.x as f32, push * away.y as f32])
    }

    fn sees(&self, me: &Body, d: [f32; 2]) -> bool {
        let at = me.position();
        self.ground.sight(self.walls, at, at + vec2(f64::from(d[0]), f64::from(d[1])))
    }
}
