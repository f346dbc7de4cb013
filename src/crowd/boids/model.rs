//! Boids without cohesion: direction by the least detour, velocity by separation, alignment and the room ahead.

use super::floor::FloorMoments;
use super::neighbourhood::Neighbourhood;
use super::speed::SpeedTable;
use crate::crowd::CrowdOptions;
use crate::crowd::agents::Agents;
use crate::crowd::environment::Environment;
use crate::crowd::model::{MOST_ACCELERATION, ModelSettings, SteeringModel};
use crate::crowd::moves::{MOST_MOVED_M, Move};
use crate::crowd::perception::Perception;
use crate::crowd::state::{AgentMut, BodyState, Traits};
use crate::crowd::wayfinding::Wayfinder;

/// Time in which the desired velocity is taken up, seconds.
const RELAXATION_S: f32 = 0.5;
/// Acceleration of making way for others, metres per second squared.
const SEPARATION: f32 = 3.2;
/// Acceleration away from a wall, metres per second squared.
const WALL_PUSH: f32 = 1.6;
/// Gap below which two bodies may touch in a step, metres.
const CONTACT_M: f32 = 0.25;
/// Share of the speed that is lost in a turn by a right angle.
const BEND: f32 = 0.4;
/// Speed above which turns cost speed, metres per second: an agent that starts may turn as it likes.
const TURNING_M_S: f32 = 0.4;
/// Clearance below which agents look for their way at every look, metres; farther off walls, less often.
const OPEN_GROUND_M: f32 = 1.2;
/// Looks at others for each look for the way on open ground.
const OPEN_GROUND_LOOKS: u8 = 2;

/// Boids without cohesion (Reynolds 1987), extended as the Grime paper describes.
pub(in crate::crowd) struct Boids {
    speeds: SpeedTable,
    floor: FloorMoments,
}

impl Boids {
    pub(in crate::crowd) fn new(environment: &Environment<'_>, options: &CrowdOptions) -> Boids {
        Boids {
            speeds: SpeedTable::new(options.speed_law),
            floor: FloorMoments::new(environment.ground(), environment.walls),
        }
    }
}

impl SteeringModel for Boids {
    fn settings(&self) -> ModelSettings {
        ModelSettings {
            longest_step_s: f64::INFINITY,
            look_s: 0.5,
            looks_at_stops: 2,
            most_speed: 1.1,
            end_tolerance_s: 0.0,
        }
    }

    fn turn(&self, mut agent: AgentMut<'_>, perception: &Perception<'_>) -> bool {
        agent.walk.looks = agent.walk.looks.wrapping_add(1);
        if agent.body.clearance_m < OPEN_GROUND_M || agent.walk.looks.is_multiple_of(OPEN_GROUND_LOOKS) {
            Wayfinder::new(perception.environment).look(&mut agent, perception.time_s);
        }
        let wanted = agent.walk.wanted;
        let detour = perception.detour(agent.body, agent.traits, wanted);
        [agent.body.aim_x, agent.body.aim_y] = detour.turn(wanted, [agent.body.aim_x, agent.body.aim_y]);
        detour.against
    }

    fn next_moves(&self, agents: &Agents, perception: &Perception<'_>, first: usize, moves: &mut [Move]) {
        let mut neighbourhood = Neighbourhood::default();
        for (index, next) in (first..).zip(moves) {
            let slot = perception.neighbours.slots[index] as usize;
            *next = self.next(perception, index, &agents.traits[slot], agents.walks[slot].pace, &mut neighbourhood);
        }
    }
}

impl Boids {
    /// The next move of the body at this index of the neighbours' grid.
    fn next(
        &self,
        perception: &Perception<'_>,
        index: usize,
        traits: &Traits,
        pace: f32,
        neighbourhood: &mut Neighbourhood,
    ) -> Move {
        let me = &perception.neighbours.bodies[index];
        let at = me.position();
        neighbourhood.find(perception.neighbours, index, |dx, dy| perception.sees(me, dx, dy));
        let around = neighbourhood.weigh(me);
        let people_per_m2 = around.count / self.floor.ahead_m2(at, me.clearance_m, [me.aim_x, me.aim_y]);
        let wanted_speed = traits.speed_m_s * pace * bend(me);
        // A dense crowd alone brings no agent to rest, but agents that want to stand do.
        let least_speed = wanted_speed.min(SpeedTable::least_m_s(people_per_m2));
        let most_speed = (wanted_speed * self.speeds.factor(people_per_m2)).max(least_speed);

        let mut ax = (me.aim_x * most_speed - me.vx) / RELAXATION_S;
        let mut ay = (me.aim_y * most_speed - me.vy) / RELAXATION_S;
        let separation = neighbourhood.separate(me, traits, people_per_m2);
        // Making way is stepping aside, not backwards. Slowing down is left to the speed law and to bumping.
        let back = (separation[0] * me.aim_x + separation[1] * me.aim_y).min(0.0);
        // Agents that walk up to a spot head for the spot, not for room.
        let heed = pace.min(1.0);
        ax += SEPARATION * heed * (separation[0] - back * me.aim_x);
        ay += SEPARATION * heed * (separation[1] - back * me.aim_y);
        if around.alike > 0.0 {
            // Only across the own way: overtaking stays possible.
            let across = (-me.aim_y, me.aim_x);
            let theirs = (around.alike_vx * across.0 + around.alike_vy * across.1) / around.alike;
            let own = me.vx * across.0 + me.vy * across.1;
            let pull = perception.alignment * (theirs - own) * around.alike.min(1.0);
            ax += pull * across.0;
            ay += pull * across.1;
        }
        let mut wall_limit_m = traits.wall_exclusion_m;
        if me.clearance_m < traits.wall_acceptable_m.max(wall_limit_m + MOST_MOVED_M) {
            let gap_limit_m = perception.environment.ground().gap_limit_m(at) as f32;
            wall_limit_m = wall_limit_m.min(gap_limit_m);
            if let Some((nx, ny, push)) = keep_off_wall(perception, me, traits, wall_limit_m, gap_limit_m) {
                ax += push * heed * nx;
                ay += push * heed * ny;
            }
        }
        let a = (ax * ax + ay * ay).sqrt();
        let ease = if a > MOST_ACCELERATION { MOST_ACCELERATION / a } else { 1.0 };
        let mut vx = me.vx + ax * ease * perception.dt;
        let mut vy = me.vy + ay * ease * perception.dt;
        let speed = (vx * vx + vy * vy).sqrt();
        if speed > most_speed {
            // Slowing down takes its time too, but no longer than speeding up.
            let own = (me.vx * me.vx + me.vy * me.vy).sqrt();
            let allowed = most_speed.max(own - MOST_ACCELERATION * perception.dt);
            if speed > allowed {
                vx *= allowed / speed;
                vy *= allowed / speed;
            }
        }
        let mut velocity = [vx, vy];
        neighbourhood.keep_from_bumping(me, &mut velocity);
        let mut next = Move {
            x: me.x + velocity[0] * perception.dt,
            y: me.y + velocity[1] * perception.dt,
            wall_limit_m,
            ..Move::default()
        };
        neighbourhood.within(me, velocity, perception.dt, CONTACT_M, |other| next.touch(other));
        next
    }
}

/// Share of the speed that is kept in a bend, by the angle between aim and velocity (Hicheur et al. 2005, Exp. Brain
/// Res. 162).
fn bend(me: &BodyState) -> f32 {
    let speed = (me.vx * me.vx + me.vy * me.vy).sqrt();
    if speed < TURNING_M_S {
        return 1.0;
    }
    let cos = (me.vx * me.aim_x + me.vy * me.aim_y) / speed;
    1.0 - BEND * (1.0 - cos.max(0.0))
}

/// Direction away from a near wall, and the acceleration, metres per second squared.
fn keep_off_wall(
    perception: &Perception<'_>,
    me: &BodyState,
    traits: &Traits,
    limit_m: f32,
    gap_limit_m: f32,
) -> Option<(f32, f32, f32)> {
    // In a gap, the other wall limits the distance from this one.
    let acceptable_m = traits.wall_acceptable_m.min(gap_limit_m + 0.15).max(limit_m + 0.02);
    if me.clearance_m >= acceptable_m {
        return None;
    }
    let at = me.position();
    let nearest = perception.environment.walls.nearest(at, f64::from(acceptable_m))?;
    let away = (at - nearest.point_m).normalized()?;
    let share = (nearest.distance_m as f32 - limit_m) / (acceptable_m - limit_m);
    // Little at first: people give up their acceptable distance easily.
    let near = 1.0 - share.clamp(0.0, 1.0);
    let push = WALL_PUSH * near * near;
    Some((away.x as f32, away.y as f32, push))
}
