//! A crowd that others play with: whom they lead, whom they put there to look on, and what they may know of everybody.

use super::SocialCrowd;
use crate::crowd::state::{Body, Course, Heading, Traits};
use crate::crowd::walking::Move;
use crate::math::{Vec2, vec2};

/// Nobody can be farther from the origin than this, metres, or faster than as many metres per second: places are kept
/// in single precision.
const FARTHEST_M: f64 = 1e6;

/// Whether this is a place or a velocity that somebody can have; written so that NaN is none.
fn is_possible(v: Vec2) -> bool {
    v.length() <= FARTHEST_M
}

/// Somebody who is present, as others may know them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Present {
    /// Who.
    pub id: u32,
    /// Middle of the body, metres.
    pub position_m: Vec2,
    /// Velocity, metres per second.
    pub velocity_m_s: Vec2,
    /// Unit vector in which the body faces.
    pub heading: Vec2,
    /// Unit vector in which the person wants to walk.
    pub aim: Vec2,
    /// The speed at which the person likes to walk, metres per second.
    pub free_speed_m_s: f64,
    /// Half of the distance that others keep, metres: the body's radius.
    pub radius_m: f64,
    /// Index of the person's route.
    pub route: usize,
    /// Whether the person is at a stop, or on the way to one.
    pub at_stop: bool,
    /// Whether somebody outside of the crowd leads the person.
    pub led: bool,
}

/// Where somebody is told to be.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lead {
    from_m: Vec2,
    to_m: Vec2,
    velocity_m_s: Vec2,
    heading: Option<Vec2>,
}

impl Lead {
    /// The move to the place that is this share of the way.
    pub(super) fn part_way(&self, share: f64) -> Move {
        let to_m = self.from_m.lerp(self.to_m, share);
        Move { x: to_m.x as f32, y: to_m.y as f32, fixed: true, ..Move::default() }
    }
}

impl SocialCrowd<'_> {
    /// Everybody who is present, onlookers left out, in no order that means anything.
    pub fn everybody(&self) -> impl Iterator<Item = Present> + '_ {
        (0..self.base.courses.len()).map(|slot| self.at(slot)).filter(|present| !self.is_onlooker(present.id))
    }

    /// Somebody who is present; `None` for who has not come yet, or has left. Onlookers are found too.
    pub fn person(&self, id: u32) -> Option<Present> {
        let found = |slot: usize| (self.base.courses[slot].id == id).then_some(slot);
        let slot = self.slot(id).or_else(|| (0..self.base.courses.len()).find_map(found))?;
        Some(self.at(slot))
    }

    fn at(&self, slot: usize) -> Present {
        let (body, course, traits) = (&self.base.bodies[slot], &self.base.courses[slot], &self.base.traits[slot]);
        let vector = |x: f32, y: f32| vec2(f64::from(x), f64::from(y));
        Present {
            id: course.id,
            position_m: body.position(),
            velocity_m_s: vector(body.vx, body.vy),
            heading: course.heading.into_vec(),
            aim: vector(body.aim_x, body.aim_y),
            free_speed_m_s: f64::from(traits.speed_m_s),
            radius_m: f64::from(body.half_exclusion_m),
            route: course.route as usize,
            at_stop: course.errand.is_some(),
            led: course.led,
        }
    }

    /// Leads somebody who is present: in the next step they go to `position_m` and have this velocity there, facing along
    /// the unit vector `heading` or else where they go, and they stay there until they are told again or
    /// [released](SocialCrowd::release). Others see them and make way; walls and the bodies of others are the caller's
    /// business. Somebody who is led does not arrive, does not get stuck, and is not served at stops.
    ///
    /// Says whether the person is present, and every number one that somebody can have: within 1000 km of the origin.
    pub fn lead(&mut self, id: u32, position_m: Vec2, velocity_m_s: Vec2, heading: Option<Vec2>) -> bool {
        let possible = is_possible(position_m) && is_possible(velocity_m_s) && heading.is_none_or(is_possible);
        let found = (0..self.base.courses.len()).find(|&slot| self.base.courses[slot].id == id);
        let Some(slot) = found.filter(|_| possible) else { return false };
        self.base.courses[slot].led = true;
        let heading = heading.and_then(Vec2::normalized);
        let from_m = self.base.bodies[slot].position();
        self.led.insert(id, Lead { from_m, to_m: position_m, velocity_m_s, heading });
        true
    }

    /// Lets somebody walk on by the model, from place and velocity as they are. Says whether they were led; onlookers
    /// cannot be released.
    pub fn release(&mut self, id: u32) -> bool {
        if self.is_onlooker(id) || self.led.remove(&id).is_none() {
            return false;
        }
        let time_s = self.time_s();
        let found = self.base.courses.iter_mut().zip(&mut self.base.bodies).find(|(course, _)| course.id == id);
        let Some((course, body)) = found else { return false };
        course.led = false;
        course.least_left_m = f32::INFINITY;
        course.improved_s = time_s;
        course.blocked_s = 0.0;
        course.looks = 1;
        body.clearance_m = 0.0;
        true
    }

    /// Puts somebody there who is part of the scene but walks no route, such as the viewer: others make way for a body of
    /// this radius in metres. They are in no frame and no tally. Gives an id by which they can be
    /// [led](SocialCrowd::lead); `None` for what is no place or no radius from 0.05 to 5 m.
    pub fn stand(&mut self, position_m: Vec2, radius_m: f64) -> Option<u32> {
        if !is_possible(position_m) || !(0.05..=5.0).contains(&radius_m) {
            return None;
        }
        let id = self.base.arrivals.len() as u32 + self.onlookers;
        self.onlookers += 1;
        self.base.bodies.push(Body {
            x: position_m.x as f32,
            y: position_m.y as f32,
            aim_x: 1.0,
            half_exclusion_m: radius_m as f32,
            ..Body::default()
        });
        let mut traits = Traits::draw(self.base.seed, id, &self.base.options);
        traits.exclusion_m = 2.0 * radius_m as f32;
        self.base.traits.push(traits);
        self.base.courses.push(Course::onlooker(id, Heading::new(1.0, 0.0)));
        self.lead(id, position_m, Vec2::ZERO, Some(vec2(1.0, 0.0)));
        Some(id)
    }

    pub(super) fn is_onlooker(&self, id: u32) -> bool {
        id as usize >= self.base.arrivals.len()
    }

    /// Before a step: from where who is led sets out.
    pub(super) fn begin_leading(&mut self) {
        if self.led.is_empty() {
            return;
        }
        let mut present = Vec::with_capacity(self.led.len());
        for (body, course) in self.base.bodies.iter().zip(&self.base.courses) {
            if let Some(lead) = self.led.get_mut(&course.id) {
                lead.from_m = body.position();
                present.push(course.id);
            }
        }
        present.sort_unstable();
        self.led.retain(|id, _| present.binary_search(id).is_ok());
    }

    /// After a part of a step: who is led has the velocity and faces as they were told.
    pub(super) fn finish_leading(&mut self) {
        if self.led.is_empty() {
            return;
        }
        let time_s = self.time_s();
        for (body, course) in self.base.bodies.iter_mut().zip(&mut self.base.courses) {
            let Some(lead) = self.led.get(&course.id) else { continue };
            let (vx, vy) = (lead.velocity_m_s.x as f32, lead.velocity_m_s.y as f32);
            (body.vx, body.vy) = (vx, vy);
            if let Some(heading) = lead.heading {
                course.heading = Heading::new(heading.x as f32, heading.y as f32);
            }
            if let Some(aim) = lead.velocity_m_s.normalized().or(lead.heading) {
                [body.aim_x, body.aim_y] = [aim.x as f32, aim.y as f32];
            }
            course.improved_s = time_s;
        }
    }
}
