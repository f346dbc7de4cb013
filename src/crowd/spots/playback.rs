use super::path::BlendedPath;
use super::report::SpotReport;
use crate::crowd::agents::{AgentSnapshot, Agents};
use crate::math::Vec2;
use crate::units::{SpotFrame, Unit};

/// Overlap with others beyond which a part is broken off, metres.
const WEDGED_M: f64 = 0.03;

/// Time of the step after which spots are updated.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepTime {
    /// Time since the start, seconds.
    pub(super) time_s: f64,
    /// Time to the next step, seconds.
    pub(super) step_s: f64,
}

/// Playback of a unit by people of the crowd.
#[derive(Clone, Debug)]
pub(super) struct Playback {
    pub(super) unit: usize,
    pub(super) began_s: f64,
    pub(super) performers: Vec<Performer>,
}

/// A person who plays the part of a member.
#[derive(Clone, Debug)]
pub(super) struct Performer {
    pub(super) id: u32,
    pub(super) group: u32,
    pub(super) way: BlendedPath,
    /// Unit vector in which the body faces, plan frame.
    pub(super) facing: Vec2,
}

impl Playback {
    /// Leads all performers through the next step, and returns the ids of those who no longer play.
    ///
    /// Performers are released at the unit's end, and with their group as soon as one of them overlaps with others.
    pub(super) fn go_on(
        &mut self,
        now: StepTime,
        unit: &Unit,
        spot: &SpotFrame,
        agents: &mut Agents,
        people: &[AgentSnapshot],
        report: &mut SpotReport,
    ) -> Vec<u32> {
        let gone = self.let_go(now, unit, agents, people, report);
        let next_s = self.next_s(now);
        self.performers.retain_mut(|part| {
            let (to_m, velocity_m_s) = part.way.on_plan(unit, next_s, spot);
            let facing = part.way.heading(unit, next_s, spot.turn_of_plan(part.facing), now.step_s);
            part.facing = spot.turn_to_plan(facing);
            let from_m = find(people, part.id).map_or(to_m, |person| person.position_m);
            let is_there = agents.lead(part.id, to_m, velocity_m_s, Some(part.facing));
            if is_there {
                report.led_s += now.step_s;
                report.led_m += from_m.distance(to_m);
            }
            is_there
        });
        gone
    }

    /// Time of the unit after the next step, seconds.
    fn next_s(&self, now: StepTime) -> f64 {
        now.time_s + now.step_s - self.began_s
    }

    fn let_go(
        &mut self,
        now: StepTime,
        unit: &Unit,
        agents: &mut Agents,
        people: &[AgentSnapshot],
        report: &mut SpotReport,
    ) -> Vec<u32> {
        let over = self.next_s(now) > unit.duration_s + 1e-9;
        let groups: Vec<u32> = match over {
            true => self.performers.iter().map(|part| part.group).collect(),
            false => self.wedged(people),
        };
        let gone: Vec<u32> =
            self.performers.extract_if(.., |part| groups.contains(&part.group)).map(|part| part.id).collect();
        for &id in &gone {
            agents.release(id, now.time_s);
            report.broken_off += u64::from(!over);
        }
        gone
    }

    /// Groups with a member who overlaps with people who play no part here.
    fn wedged(&self, people: &[AgentSnapshot]) -> Vec<u32> {
        let mut groups = Vec::new();
        for part in &self.performers {
            let Some(me) = find(people, part.id) else { continue };
            let meets = people.iter().any(|other| {
                let least_m = me.radius_m + other.radius_m - WEDGED_M;
                let near = other.position_m.distance(me.position_m) < least_m;
                near && self.performers.iter().all(|part| part.id != other.id)
            });
            if meets && !groups.contains(&part.group) {
                groups.push(part.group);
            }
        }
        groups
    }
}

/// Finds an agent in a list that is sorted by id.
pub(super) fn find(people: &[AgentSnapshot], id: u32) -> Option<&AgentSnapshot> {
    people.binary_search_by_key(&id, |present| present.id).ok().map(|at| &people[at])
}
