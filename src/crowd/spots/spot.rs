use super::super::{CrowdError, Present, SocialCrowd};
use super::play::{Part, Play, find};
use super::report::SpotReport;
use super::request::SpotRequest;
use super::way::{LOOK_S, Way};
use crate::math::{Vec2, atan2};
use crate::motion::MotionError;
use crate::motion::units::{
    Areas, Candidate, Diversity, LEAST_APART_M, MatchOptions, Moment, Party, Side, SpotFrame, Unit, UnitLibrary, rank,
};
use crate::plan::FloorPlan;
use crate::routes::Ground;
use crate::walls::Walls;

/// People who play keep this far from walls at least, metres.
const WALL_M: f64 = 0.22;
/// They come no nearer to the viewer than the viewer's radius and this, metres.
const BODY_M: f64 = 0.2;
/// How far ahead others are foreseen, seconds, ...
const FORESEEN_S: f64 = 1.2;
/// ... and how far off they have to be then, metres.
const FORESEEN_M: f64 = 0.42;
/// Members of a group who are farther from its middle than this count on their own, metres.
const TOGETHER_M: f64 = 2.5;
/// Of so many units that were played last it is remembered when.
const REMEMBERED: usize = 6;

/// A spot with its viewer, and the unit that is being played there.
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
    playing: Option<Play>,
    /// When the people there are looked at again.
    next_s: f64,
    /// What was played last, the latest first.
    recent: Vec<usize>,
    report: SpotReport,
}

/// Why no unit was begun.
enum Missed {
    Nobody,
    NotFree,
    NoneAlike(String),
    TooFar,
    InTheWay,
}

impl Spot {
    pub(super) fn new(
        index: usize,
        request: &SpotRequest,
        (plan, walls, ground): (&FloorPlan, &Walls, &Ground),
    ) -> Result<Spot, CrowdError> {
        let frame = request.resolve(index, (plan, walls, ground))?;
        let wrong = |error| CrowdError::Motion(Box::new(MotionError::Units(error)));
        let library = match request.play {
            true => UnitLibrary::open(request.folder.as_deref()).map_err(wrong)?,
            false => UnitLibrary::default(),
        };
        let count = library.units.len();
        let areas = request.areas();
        let options = MatchOptions::default();
        let free = |unit: &Unit| [false, true].iter().any(|&mirrored| is_free(unit, mirrored, &frame, walls));
        let units: Vec<Unit> = library.units.into_iter().filter(free).collect();
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
            playing: None,
            next_s: 0.0,
            recent: Vec::new(),
            report,
        })
    }

    pub(super) fn report(&self) -> SpotReport {
        SpotReport { diversity: self.diversity.report(), ..self.report.clone() }
    }

    /// Goes on with the unit that is being played.
    pub(super) fn go_on(&mut self, time_s: f64, step_s: f64, crowd: &mut SocialCrowd<'_>, people: &[Present]) {
        let Some(play) = &mut self.playing else { return };
        let unit = &self.units[play.unit];
        if !play.go_on((time_s, step_s), unit, &self.frame, crowd, people, &mut self.report) {
            self.playing = None;
            self.next_s = time_s + self.pause_s.max(step_s);
        }
    }

    /// Looks whether a unit can be begun, and begins it.
    pub(super) fn look(
        &mut self,
        time_s: f64,
        step_s: f64,
        crowd: &mut SocialCrowd<'_>,
        people: &mut [Present],
        walls: &Walls,
    ) {
        if self.playing.is_some() || self.units.is_empty() || time_s < self.next_s - 1e-9 {
            return;
        }
        self.next_s = time_s + self.every_s;
        match self.choose(crowd, people, walls) {
            Ok((candidate, ways)) => {
                self.begin(time_s, &candidate, ways, people);
                self.go_on(time_s, step_s, crowd, people);
            }
            Err(missed) => self.count(missed),
        }
    }

    fn count(&mut self, missed: Missed) {
        let report = &mut self.report;
        report.moments += u64::from(!matches!(missed, Missed::Nobody));
        match missed {
            Missed::Nobody => {}
            Missed::NotFree => report.not_free += 1,
            Missed::TooFar => report.too_far += 1,
            Missed::InTheWay => report.in_the_way += 1,
            Missed::NoneAlike(who) => {
                report.unmatched += 1;
                *report.missing.entry(who).or_default() += 1;
            }
        }
    }

    /// The best unit for the people who are there, and everybody's way into it.
    fn choose(
        &self,
        crowd: &SocialCrowd<'_>,
        people: &[Present],
        walls: &Walls,
    ) -> Result<(Candidate, Vec<(u32, Way)>), Missed> {
        let present = self.present(crowd, people);
        if present.is_empty() {
            return Err(Missed::Nobody);
        }
        let judged = |id: u32| find(people, id).is_none_or(|person| person.at_stop || person.led);
        if present.iter().flat_map(|group| &group.people).any(|&(id, _)| judged(id)) {
            return Err(Missed::NotFree);
        }
        let recent = |unit: usize| self.recent.iter().position(|&played| played == unit).map(|ago| ago + 1);
        let ranked = rank(&self.units, &present, &self.areas, &self.options, recent);
        if ranked.alike == 0 {
            return Err(Missed::NoneAlike(in_words(&present)));
        }
        let mut missed = Missed::TooFar;
        for candidate in ranked.candidates {
            match self.ways(&candidate, people, walls) {
                Ok(ways) => return Ok((candidate, ways)),
                Err(reason) => missed = reason,
            }
        }
        Err(missed)
    }

    /// The groups in the front and rear areas, in the order of their first ids.
    fn present(&self, crowd: &SocialCrowd<'_>, people: &[Present]) -> Vec<Party> {
        let mut parties = Vec::new();
        let mut at = 0;
        while let Some(first) = people.get(at) {
            // The members of a group follow each other.
            let ids = crowd.group_of(first.id);
            let count = people[at..].iter().take_while(|p| p.id == first.id || ids.contains(&p.id)).count();
            let group = &people[at..at + count];
            at += count;
            let near = |p: &Present| self.frame.of_plan(p.position_m).length() < 20.0;
            if group.iter().any(near) {
                self.gather(group, &mut parties);
            }
        }
        parties
    }

    fn gather(&self, group: &[Present], parties: &mut Vec<Party>) {
        let middle = group.iter().fold(Vec2::ZERO, |sum, p| sum + p.position_m) / group.len().max(1) as f64;
        let moment = |person: &Present| {
            let place_m = self.frame.of_plan(person.position_m);
            let velocity_m_s = self.frame.turn_of_plan(person.velocity_m_s);
            (person.id, Moment { place_m, velocity_m_s, heading: self.frame.turn_of_plan(person.heading) })
        };
        if group.iter().all(|person| person.position_m.distance(middle) < TOGETHER_M) {
            parties.extend(Party::of(&self.areas, group.iter().map(moment).collect()));
        } else {
            parties.extend(group.iter().filter_map(|person| Party::of(&self.areas, vec![moment(person)])));
        }
    }

    /// Everybody's way into a unit, if all of them are free.
    fn ways(&self, candidate: &Candidate, people: &[Present], walls: &Walls) -> Result<Vec<(u32, Way)>, Missed> {
        let unit = &self.units[candidate.unit];
        let mut ways = Vec::with_capacity(candidate.parts.len());
        for (member, &id) in candidate.parts.iter().enumerate() {
            let person = find(people, id).ok_or(Missed::TooFar)?;
            let from = Moment {
                place_m: self.frame.of_plan(person.position_m),
                velocity_m_s: self.frame.turn_of_plan(person.velocity_m_s),
                heading: self.frame.turn_of_plan(person.heading),
            };
            let way = Way::find(unit, member, candidate.mirrored, &from).ok_or(Missed::TooFar)?;
            ways.push((id, way));
        }
        let free =
            self.are_apart(unit, &ways) && self.keep_off(unit, &ways, people) && self.cross_nothing(unit, &ways, walls);
        if free { Ok(ways) } else { Err(Missed::InTheWay) }
    }

    /// Whether nobody runs into another or the viewer while they move over.
    fn are_apart(&self, unit: &Unit, ways: &[(u32, Way)]) -> bool {
        let over_s = ways.iter().map(|(_, way)| way.over_s).fold(0.0, f64::max);
        let viewer_m = if self.radius_m > 0.0 { self.radius_m + BODY_M } else { 0.0 };
        (1..=(over_s / LOOK_S).ceil() as usize).all(|k| {
            let time_s = k as f64 * LOOK_S;
            let places: Vec<Vec2> = ways.iter().map(|(_, way)| way.at(unit, time_s).place_m).collect();
            places.iter().enumerate().all(|(k, place)| {
                place.length() >= viewer_m && places[..k].iter().all(|other| other.distance(*place) >= LEAST_APART_M)
            })
        })
    }

    /// Whether nobody else is about to come into their way.
    fn keep_off(&self, unit: &Unit, ways: &[(u32, Way)], people: &[Present]) -> bool {
        let plays = |id: u32| ways.iter().any(|(other, _)| *other == id);
        let near = |p: &&Present| p.position_m.distance(self.frame.at_m) < 20.0;
        let others: Vec<&Present> = people.iter().filter(near).filter(|person| !plays(person.id)).collect();
        (1..=(FORESEEN_S / LOOK_S) as usize).all(|k| {
            let time_s = k as f64 * LOOK_S;
            ways.iter().all(|(_, way)| {
                let (place_m, _) = way.on_plan(unit, time_s, &self.frame);
                let there = |other: &&Present| other.position_m + other.velocity_m_s * time_s;
                others.iter().all(|other| there(other).distance(place_m) >= FORESEEN_M)
            })
        })
    }

    /// Whether no way comes near a wall, to the unit's end.
    fn cross_nothing(&self, unit: &Unit, ways: &[(u32, Way)], walls: &Walls) -> bool {
        ways.iter().all(|(_, way)| is_clear(|time_s| way.on_plan(unit, time_s, &self.frame).0, unit.duration_s, walls))
    }

    fn begin(&mut self, time_s: f64, candidate: &Candidate, ways: Vec<(u32, Way)>, people: &[Present]) {
        let unit = &self.units[candidate.unit];
        let report = &mut self.report;
        report.splices += 1;
        *report.by_unit.entry(unit.name.clone()).or_default() += 1;
        let mut parts = Vec::with_capacity(ways.len());
        for (id, way) in ways {
            let Some(person) = find(people, id) else { continue };
            let start = unit.moment(way.member, 0.0, candidate.mirrored);
            let heading = self.frame.turn_of_plan(person.heading);
            let turned_rad = atan2(heading.cross(start.heading), heading.dot(start.heading)).abs();
            report.people += 1;
            report.position_error_m.push(person.position_m.distance(self.frame.to_plan(start.place_m)));
            report.heading_error_deg.push(turned_rad.to_degrees());
            report.move_over_s.push(way.over_s);
            parts.push(Part { id, group: unit.members[way.member].group, way, facing: person.heading });
        }
        self.recent.insert(0, candidate.unit);
        self.recent.truncate(REMEMBERED);
        self.playing = Some(Play { unit: candidate.unit, began_s: time_s, parts });
    }
}

/// Whether a unit's own ways keep off walls, placed at a spot.
fn is_free(unit: &Unit, mirrored: bool, frame: &SpotFrame, walls: &Walls) -> bool {
    (0..unit.members.len()).all(|member| {
        is_clear(|time_s| frame.to_plan(unit.moment(member, time_s, mirrored).place_m), unit.duration_s, walls)
    })
}

/// Whether a way keeps off walls and crosses none.
fn is_clear(at: impl Fn(f64) -> Vec2, duration_s: f64, walls: &Walls) -> bool {
    let mut before = at(0.0);
    (0..=(duration_s / LOOK_S) as usize).all(|k| {
        let place_m = at(k as f64 * LOOK_S);
        // Who stands close to a wall already may walk away from it.
        let near = k > 0 && walls.nearest(place_m, WALL_M).is_some();
        let free = !near && walls.is_inside(place_m) && walls.sight(before, place_m);
        before = place_m;
        free
    })
}

fn in_words(present: &[Party]) -> String {
    let side = |side: Side| {
        let mut sizes: Vec<usize> = present.iter().filter(|p| p.side == side).map(|p| p.people.len()).collect();
        sizes.sort_unstable();
        let words: Vec<String> = sizes.iter().map(usize::to_string).collect();
        if words.is_empty() { "-".to_string() } else { words.join("+") }
    };
    format!("{} | {}", side(Side::Front), side(Side::Rear))
}
