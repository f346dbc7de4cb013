use super::clearance::{self, Clearance};
use super::path::{BlendedPath, MOST_M_S2};
use super::playback::{Performer, Playback, StepTime, find};
use super::report::SpotReport;
use super::request::SpotRequest;
use crate::crowd::CrowdError;
use crate::crowd::agents::{AgentSnapshot, Agents};
use crate::crowd::environment::Environment;
use crate::math::{Vec2, atan2};
use crate::units::{
    AreaSide, Areas, Candidate, Diversity, MatchOptions, Party, SpotFrame, TrackState, Unit, UnitLibrary, rank,
};
use crate::walls::Walls;

/// Distance from the middle of their group beyond which members count on their own, metres.
const TOGETHER_M: f64 = 2.5;
/// Distance from the viewer beyond which people are left out, metres: a unit's area is at most 40 m deep.
const NEAR_M: f64 = 50.0;
/// Distance from where its velocity leads at which an agent was pushed in a step, metres.
const PUSHED_M: f64 = 0.004;
/// Number of units played last that are remembered.
const REMEMBERED: usize = 12;

/// The people around a spot, now and a step ago.
#[derive(Clone, Copy)]
pub(super) struct SpotInput<'a> {
    /// Everybody present, by ascending id.
    pub(super) people: &'a [AgentSnapshot],
    /// The same a step ago.
    pub(super) before: &'a [AgentSnapshot],
    /// Time since then, seconds.
    pub(super) step_s: f64,
    pub(super) walls: &'a Walls,
}

impl SpotInput<'_> {
    /// Whether an agent makes way for somebody: it accelerates harder than people who move over to a part, or is pushed.
    fn dodges(&self, person: &AgentSnapshot) -> bool {
        let Some(before) = find(self.before, person.id) else { return false };
        let [was, is] = [before.velocity_m_s, person.velocity_m_s];
        let expected_m = before.position_m + (was + is) * (0.5 * self.step_s);
        was.distance(is) > MOST_M_S2 * self.step_s || expected_m.distance(person.position_m) > PUSHED_M
    }
}

/// A spot with its viewer, and the units played there.
pub(super) struct Spot {
    pub(super) frame: SpotFrame,
    pub(super) radius_m: f64,
    pub(super) diversity: Diversity,
    areas: Areas,
    every_s: f64,
    pause_s: f64,
    /// The units that fit the floor, unmirrored or mirrored.
    units: Vec<Unit>,
    options: MatchOptions,
    playing: Vec<Playback>,
    /// Ids of people who have just played, and the time until which they are left alone, seconds.
    resting: Vec<(u32, f64)>,
    /// Time at which units are looked for again, seconds.
    next_s: f64,
    /// Indices of the units played last, the latest first.
    recent: Vec<usize>,
    report: SpotReport,
}

/// Why no unit was begun.
enum NoUnit {
    Nobody,
    NotFree,
    NoneAlike(String),
    TooFar,
    InTheWay,
}

impl Spot {
    pub(super) fn new(index: usize, request: &SpotRequest, environment: &Environment<'_>) -> Result<Spot, CrowdError> {
        let frame = request.resolve(index, environment)?;
        let library = match request.play {
            true => UnitLibrary::open(request.folder.as_deref())?,
            false => UnitLibrary::default(),
        };
        let count = library.units.len();
        let areas = request.areas();
        let options = MatchOptions::default();
        let fits = |unit: &Unit| clearance::fits(unit, &frame, request.radius, environment.walls);
        let units: Vec<Unit> = library.units.into_iter().filter(fits).collect();
        let report = SpotReport {
            name: request.title(index),
            place_m: frame.at_m,
            fitting: [units.len(), count],
            ..SpotReport::default()
        };
        Ok(Spot {
            diversity: Diversity::new(frame, areas),
            frame,
            radius_m: request.radius,
            areas,
            every_s: request.every,
            pause_s: request.pause,
            units,
            options,
            playing: Vec::new(),
            resting: Vec::new(),
            next_s: 0.0,
            recent: Vec::new(),
            report,
        })
    }

    pub(super) fn report(&self) -> SpotReport {
        SpotReport { diversity: self.diversity.report(), ..self.report.clone() }
    }

    /// Leads those who play through the next step.
    pub(super) fn go_on(&mut self, now: StepTime, agents: &mut Agents, people: &[AgentSnapshot]) {
        let judged = |person: &AgentSnapshot| self.areas.side_of(self.frame.of_plan(person.position_m)).is_some();
        if people.iter().any(judged) {
            self.report.there_s += now.step_s;
            self.report.played_s += if self.playing.is_empty() { 0.0 } else { now.step_s };
        }
        self.resting.retain(|&(_, until_s)| until_s > now.time_s + 1e-9);
        let Spot { playing, units, frame, report, resting, pause_s, .. } = self;
        playing.retain_mut(|play| {
            let gone = play.go_on(now, &units[play.unit], frame, agents, people, report);
            resting.extend(gone.into_iter().map(|id| (id, now.time_s + *pause_s)));
            !play.performers.is_empty()
        });
    }

    /// Begins the best unit for the people who are there, if there is one and it is due.
    pub(super) fn look(&mut self, now: StepTime, agents: &mut Agents, there: &SpotInput<'_>) {
        if self.units.is_empty() || now.time_s < self.next_s - 1e-9 {
            return;
        }
        self.next_s = now.time_s + self.every_s;
        match self.choose(now, agents, there) {
            Ok((candidate, ways)) => {
                let mut play = self.begin(now, &candidate, ways, there.people);
                play.go_on(now, &self.units[play.unit], &self.frame, agents, there.people, &mut self.report);
                self.playing.push(play);
            }
            Err(missed) => self.count(missed),
        }
    }

    fn count(&mut self, missed: NoUnit) {
        let report = &mut self.report;
        report.moments += u64::from(!matches!(missed, NoUnit::Nobody));
        match missed {
            NoUnit::Nobody => {}
            NoUnit::NotFree => report.not_free += 1,
            NoUnit::TooFar => report.too_far += 1,
            NoUnit::InTheWay => report.in_the_way += 1,
            NoUnit::NoneAlike(who) => {
                report.unmatched += 1;
                *report.missing.entry(who).or_default() += 1;
            }
        }
    }

    /// Finds the best unit for the people who are there, and the path of each person into it.
    fn choose(
        &self,
        now: StepTime,
        agents: &Agents,
        there: &SpotInput<'_>,
    ) -> Result<(Candidate, Vec<(u32, BlendedPath)>), NoUnit> {
        let present = self.present(agents, there.people);
        if present.is_empty() {
            return Err(NoUnit::Nobody);
        }
        let waits = |id: u32| find(there.people, id).is_none_or(|person| person.at_stop);
        if present.iter().flat_map(|group| &group.people).any(|&(id, _)| waits(id)) {
            return Err(NoUnit::NotFree);
        }
        let recent = |unit: usize| self.recent.iter().position(|&played| played == unit).map(|ago| ago + 1);
        let ranked = rank(&self.units, &present, &self.areas, &self.options, recent);
        if ranked.alike == 0 {
            return Err(NoUnit::NoneAlike(in_words(&present)));
        }
        let clearance = Clearance {
            frame: &self.frame,
            radius_m: self.radius_m,
            walls: there.walls,
            playing: self.playing.iter().map(|play| (play, &self.units[play.unit])).collect(),
            time_s: now.time_s,
        };
        let mut missed = NoUnit::TooFar;
        for candidate in ranked.candidates {
            match self.ways(&candidate, there, &clearance) {
                Ok(ways) => return Ok((candidate, ways)),
                Err(reason) => missed = reason,
            }
        }
        Err(missed)
    }

    /// Groups in the front and rear areas that could play, in the order of their first ids.
    ///
    /// People who play, or have just played, are left out.
    fn present(&self, agents: &Agents, people: &[AgentSnapshot]) -> Vec<Party> {
        let mut parties = Vec::new();
        let mut at = 0;
        while let Some(first) = people.get(at) {
            // The members of a group follow each other.
            let ids = agents.group_of(first.id);
            let count = people[at..].iter().take_while(|p| p.id == first.id || ids.contains(&p.id)).count();
            let group = &people[at..at + count];
            at += count;
            let near = |p: &AgentSnapshot| p.position_m.distance(self.frame.at_m) < NEAR_M;
            if group.iter().any(near) {
                let rests = |p: &AgentSnapshot| self.resting.iter().any(|&(id, _)| id == p.id);
                let free: Vec<AgentSnapshot> = group.iter().filter(|p| !p.led && !rests(p)).copied().collect();
                self.gather(&free, &mut parties);
            }
        }
        parties
    }

    fn gather(&self, group: &[AgentSnapshot], parties: &mut Vec<Party>) {
        let middle = group.iter().fold(Vec2::ZERO, |sum, p| sum + p.position_m) / group.len().max(1) as f64;
        let together = group.iter().all(|person| person.position_m.distance(middle) < TOGETHER_M);
        for people in group.chunks(if together { group.len().max(1) } else { 1 }) {
            let moments = people.iter().map(|person| (person.id, self.moment(person))).collect();
            parties.extend(Party::of(&self.areas, moments));
        }
    }

    /// State of an agent in the viewer's frame.
    fn moment(&self, person: &AgentSnapshot) -> TrackState {
        TrackState {
            place_m: self.frame.of_plan(person.position_m),
            velocity_m_s: self.frame.turn_of_plan(person.velocity_m_s),
            heading: self.frame.turn_of_plan(person.heading),
        }
    }

    /// Paths of all people into a unit, if they are free to take them and there is room.
    fn ways(
        &self,
        candidate: &Candidate,
        there: &SpotInput<'_>,
        clearance: &Clearance<'_>,
    ) -> Result<Vec<(u32, BlendedPath)>, NoUnit> {
        let unit = &self.units[candidate.unit];
        let mut ways = Vec::with_capacity(candidate.parts.len());
        for (member, &id) in candidate.parts.iter().enumerate() {
            let person = find(there.people, id).ok_or(NoUnit::TooFar)?;
            if there.dodges(person) {
                return Err(NoUnit::NotFree);
            }
            let way =
                BlendedPath::find(unit, member, candidate.mirrored, &self.moment(person)).ok_or(NoUnit::TooFar)?;
            ways.push((id, way));
        }
        if clearance.has(unit, &ways, there.people) { Ok(ways) } else { Err(NoUnit::InTheWay) }
    }

    fn begin(
        &mut self,
        now: StepTime,
        candidate: &Candidate,
        ways: Vec<(u32, BlendedPath)>,
        people: &[AgentSnapshot],
    ) -> Playback {
        let unit = &self.units[candidate.unit];
        let report = &mut self.report;
        report.splices += 1;
        *report.by_unit.entry(unit.name.clone()).or_default() += 1;
        let mut performers = Vec::with_capacity(ways.len());
        for (id, way) in ways {
            let Some(person) = find(people, id) else { continue };
            let start = unit.moment(way.member, 0.0, candidate.mirrored);
            let heading = self.frame.turn_of_plan(person.heading);
            let turned_rad = atan2(heading.cross(start.heading), heading.dot(start.heading)).abs();
            report.people += 1;
            report.position_error_m.push(person.position_m.distance(self.frame.to_plan(start.place_m)));
            report.heading_error_deg.push(turned_rad.to_degrees());
            report.move_over_s.push(way.over_s);
            performers.push(Performer { id, group: unit.members[way.member].group, way, facing: person.heading });
        }
        self.recent.insert(0, candidate.unit);
        self.recent.truncate(REMEMBERED);
        Playback { unit: candidate.unit, began_s: now.time_s, performers }
    }
}

fn in_words(present: &[Party]) -> String {
    let side = |side: AreaSide| {
        let mut sizes: Vec<usize> = present.iter().filter(|p| p.side == side).map(|p| p.people.len()).collect();
        sizes.sort_unstable();
        let words: Vec<String> = sizes.iter().map(usize::to_string).collect();
        if words.is_empty() { "-".to_string() } else { words.join("+") }
    };
    format!("{} | {}", side(AreaSide::Front), side(AreaSide::Rear))
}
