//! Social forces with groups: the direction is the way itself, the velocity follows the sum of the forces.

use super::forces::Forces;
use crate::crowd::CrowdOptions;
use crate::crowd::agents::Agents;
use crate::crowd::model::{CALMS_DOWN_M_S2, MOST_ACCELERATION, ModelSettings, SteeringModel};
use crate::crowd::moves::{MOST_MOVED_M, Move};
use crate::crowd::perception::Perception;
use crate::crowd::state::{AgentMut, BodyState, Traits};
use crate::crowd::wayfinding::Wayfinder;

/// Radius within which others exert a force, metres.
const REACH_M: f32 = 4.0;
/// Radius within which those who walk away do so too, metres.
const NEAR_M: f32 = 2.0;
/// Gap below which two bodies may touch in a step, metres.
const CONTACT_M: f32 = 0.3;
/// Speed forward that the presence of others leaves in any case, metres per second: only bodies stop an agent.
const LEAST_SPEED_M_S: f32 = 0.1;
/// Distance up to which those who come the other way are noticed, metres.
const AHEAD_M: f32 = 4.0;
/// Distance up to which people see somebody come who is led, and the gap at which they pass them, metres.
const LED_REACH_M: f32 = 9.0;
const PASSING_M: f32 = 0.25;
/// Gap below which they brake for anybody, metres.
const BRAKING_M: f32 = 0.8;
/// Distance beyond which members of a group have lost each other, metres.
const LOST_M: f32 = 8.0;

/// Social forces (Moussaid et al. 2009) with groups of two to four (Moussaid et al. 2010).
pub(in crate::crowd) struct SocialForce {
    forces: Forces,
    most_speed: f32,
}

impl SocialForce {
    pub(in crate::crowd) fn new(options: &CrowdOptions) -> SocialForce {
        SocialForce {
            forces: Forces::new(&options.social_force, &options.groups),
            most_speed: options.social_force.most_speed as f32,
        }
    }
}

/// Others whom an agent heeds in ways of their own, as indices of the neighbours' grid.
#[derive(Clone, Copy)]
struct Others<'a> {
    led: &'a [u32],
    own_group: &'a [u32],
}

impl SteeringModel for SocialForce {
    fn settings(&self) -> ModelSettings {
        ModelSettings {
            // Forces grow steep where people meet.
            longest_step_s: 0.05,
            look_s: 0.3,
            looks_at_stops: 1,
            most_speed: self.most_speed,
            end_tolerance_s: 1e-9,
        }
    }

    fn turn(&self, mut agent: AgentMut<'_>, perception: &Perception<'_>) -> bool {
        Wayfinder::of_wanderers(perception.environment).look(&mut agent, perception.time_s);
        [agent.body.aim_x, agent.body.aim_y] = agent.walk.wanted;
        meets(perception, agent.body)
    }

    fn next_moves(&self, agents: &Agents, perception: &Perception<'_>, first: usize, moves: &mut [Move]) {
        let led: Vec<u32> = agents.led_slots().map(|slot| perception.neighbours.index_of_slot[slot]).collect();
        for (index, next) in (first..).zip(moves) {
            let slot = perception.neighbours.slots[index] as usize;
            let (mates, count) = mates(agents, perception, slot);
            let others = Others { led: &led, own_group: &mates[..count] };
            *next = self.next(perception, index, &agents.traits[slot], agents.walks[slot].pace, others);
        }
    }
}

impl SocialForce {
    /// The next move of the body at this index of the neighbours' grid.
    fn next(&self, perception: &Perception<'_>, index: usize, traits: &Traits, pace: f32, others: Others<'_>) -> Move {
        let me = &perception.neighbours.bodies[index];
        let aim = [me.aim_x, me.aim_y];
        let wanted_speed = traits.speed_m_s * pace;
        let mut next = Move { wall_limit_m: traits.wall_exclusion_m, ..Move::default() };
        let [px, py] = self.by_others(perception, index, others.own_group, &mut next);
        let [gx, gy] = self.by_group(perception, me, others.own_group);
        let [lx, ly] = by_led(perception, index, others);
        // Agents that stand, or walk up to a spot, heed the spot more than others.
        let heed = pace.min(1.0);
        let [rx, ry] = self.forces.by_chance(traits.wander, perception.time_s);
        let mut ax = (aim[0] * wanted_speed - me.vx) / self.forces.relaxation_s() + heed * (px + gx + rx) + lx;
        let mut ay = (aim[1] * wanted_speed - me.vy) / self.forces.relaxation_s() + heed * (py + gy + ry) + ly;
        if let Some([wx, wy]) = self.by_wall(perception, me, &mut next) {
            ax += heed * wx;
            ay += heed * wy;
        }
        let a = (ax * ax + ay * ay).sqrt();
        let ease = if a > MOST_ACCELERATION { MOST_ACCELERATION / a } else { 1.0 };
        let [mut vx, mut vy] = [me.vx + ax * ease * perception.dt, me.vy + ay * ease * perception.dt];
        let short = wanted_speed.min(LEAST_SPEED_M_S) - (vx * aim[0] + vy * aim[1]);
        let own = me.vx * aim[0] + me.vy * aim[1];
        // Not into those whom it makes way for.
        if short > 0.0 && own > -LEAST_SPEED_M_S && lx * aim[0] + ly * aim[1] >= 0.0 {
            vx += short * aim[0];
            vy += short * aim[1];
        }
        let speed = (vx * vx + vy * vy).sqrt();
        let own_speed = (me.vx * me.vx + me.vy * me.vy).sqrt();
        let most = (self.most_speed * traits.speed_m_s).max(own_speed - CALMS_DOWN_M_S2 * perception.dt);
        if speed > most {
            vx *= most / speed;
            vy *= most / speed;
        }
        next.x = me.x + vx * perception.dt;
        next.y = me.y + vy * perception.dt;
        next
    }

    /// Sum of the forces of all others but the own group; notes the bodies that may touch.
    fn by_others(&self, perception: &Perception<'_>, index: usize, own_group: &[u32], next: &mut Move) -> [f32; 2] {
        let me = &perception.neighbours.bodies[index];
        let aim = [me.aim_x, me.aim_y];
        let mut sum = [0.0f32; 2];
        perception.neighbours.within(me.x, me.y, REACH_M, |range, shift| {
            let x = me.x - shift;
            let start = range.start;
            for (k, body) in perception.neighbours.bodies[range].iter().enumerate() {
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
                if d2 > clear_m * clear_m && !perception.sees(me, d[0], d[1]) {
                    continue;
                }
                if touches {
                    next.touch(other as u32);
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

    /// Force of the own group, as far as it is in sight.
    fn by_group(&self, perception: &Perception<'_>, me: &BodyState, own_group: &[u32]) -> [f32; 2] {
        let mut mates = [[0.0f32; 2]; 3];
        let mut count = 0;
        for &other in own_group {
            let body = &perception.neighbours.bodies[other as usize];
            let d = [perception.neighbours.dx(me.x, body.x), body.y - me.y];
            if let Some(mate) = mates.get_mut(count)
                && perception.sees(me, d[0], d[1])
            {
                *mate = d;
                count += 1;
            }
        }
        if count == 0 { [0.0; 2] } else { self.forces.by_group(&mates[..count], [me.vx, me.vy]) }
    }

    /// Acceleration away from the nearest wall; notes the least distance from walls.
    fn by_wall(&self, perception: &Perception<'_>, me: &BodyState, next: &mut Move) -> Option<[f32; 2]> {
        let limit_m = next.wall_limit_m;
        let reach_m = limit_m + self.forces.wall_reach_m().max(MOST_MOVED_M);
        if me.clearance_m >= reach_m {
            return None;
        }
        let at = me.position();
        next.wall_limit_m = limit_m.min(perception.environment.ground().gap_limit_m(at) as f32);
        let nearest = perception.environment.walls.nearest(at, f64::from(reach_m))?;
        let away = (at - nearest.point_m).normalized()?;
        let push = self.forces.by_wall(nearest.distance_m as f32 - next.wall_limit_m);
        Some([push * away.x as f32, push * away.y as f32])
    }
}

/// Acceleration out of the way of those who are led: they give way to nobody.
///
/// Whoever sees somebody led steps aside for them, and runs into nobody else meanwhile.
fn by_led(perception: &Perception<'_>, index: usize, others: Others<'_>) -> [f32; 2] {
    let neighbours = perception.neighbours;
    let me = &neighbours.bodies[index];
    let (mut sum, mut some_led) = ([0.0f32; 2], false);
    for &other in others.led.iter().filter(|&&other| other as usize != index) {
        let body = &neighbours.bodies[other as usize];
        let d = [neighbours.dx(me.x, body.x), body.y - me.y];
        if d[0] * d[0] + d[1] * d[1] < LED_REACH_M * LED_REACH_M && perception.sees(me, d[0], d[1]) {
            some_led = true;
            let apart_m = me.half_exclusion_m + body.half_exclusion_m + PASSING_M;
            let [ax, ay] = Forces::out_of_the_way(d, [body.vx - me.vx, body.vy - me.vy], apart_m);
            sum = [sum[0] + ax, sum[1] + ay];
        }
    }
    if some_led {
        neighbours.within(me.x, me.y, NEAR_M, |range, shift| {
            let start = range.start;
            for (k, body) in neighbours.bodies[range].iter().enumerate().filter(|(k, _)| start + k != index) {
                let d = [body.x + shift - me.x, body.y - me.y];
                let gap_m = (d[0] * d[0] + d[1] * d[1]).sqrt() - me.half_exclusion_m - body.half_exclusion_m;
                if gap_m < BRAKING_M && perception.sees(me, d[0], d[1]) {
                    // Others who are not led do half of it.
                    let share = if others.led.contains(&((start + k) as u32)) { 1.0 } else { 0.5 };
                    let [ax, ay] = Forces::brake(d, [body.vx - me.vx, body.vy - me.vy], gap_m);
                    sum = [sum[0] + share * ax, sum[1] + share * ay];
                }
            }
        });
    }
    sum
}

/// The others of an agent's group who walk along, as indices of the neighbours' grid, and their number.
///
/// Members at a stop, or on the way to one, walk on their own.
fn mates(agents: &Agents, perception: &Perception<'_>, slot: usize) -> ([u32; 3], usize) {
    let (mut mates, mut count) = ([0; 3], 0);
    let (walk, body) = (&agents.walks[slot], &agents.bodies[slot]);
    let members = agents.group_of(walk.id);
    if members.len() < 2 || walk.visit.is_some() {
        return (mates, count);
    }
    for id in members.filter(|&id| id != walk.id) {
        let Some(slot) = agents.slot(id) else { continue };
        let (other, there) = (&agents.walks[slot], &agents.bodies[slot]);
        let (dx, dy) = (perception.neighbours.dx(body.x, there.x), there.y - body.y);
        let lost = dx * dx + dy * dy > LOST_M * LOST_M;
        if let Some(mate) = mates.get_mut(count)
            && other.visit.is_none()
            && !lost
        {
            *mate = perception.neighbours.index_of_slot[slot];
            count += 1;
        }
    }
    (mates, count)
}

/// Whether somebody ahead comes the other way.
fn meets(perception: &Perception<'_>, me: &BodyState) -> bool {
    let mut found = false;
    let (cx, cy) = (me.x + 0.5 * AHEAD_M * me.aim_x, me.y + 0.5 * AHEAD_M * me.aim_y);
    perception.neighbours.around(cx, cy, |range, shift| {
        found |= perception.neighbours.bodies[range].iter().any(|body| {
            let (dx, dy) = (body.x + shift - me.x, body.y - me.y);
            let ahead = dx * me.aim_x + dy * me.aim_y > 0.05 && dx * dx + dy * dy < AHEAD_M * AHEAD_M;
            ahead && body.aim_x * me.aim_x + body.aim_y * me.aim_y < -0.7
        });
    });
    found
}
