use std::path::Path;

use super::generated::{GeneratedExample, MOST_WANDERERS};
use super::heading::{headings, turned_to};
use super::keys::{self, FormationLayout, PlacementInput};
use super::{example, path};
use crate::formation::FormationError;
use crate::formation::avoidance::{AvoidanceSettings, BodyMember, FormationBody, keep_clear};
use crate::formation::blend::{self, KeyPlaces};
use crate::formation::formed::FormedPerson;
use crate::formation::limits::{MOST_FORMED_PLACES, MOST_IN_ALL, MOST_KEY_PAIRS, MOST_PEOPLE};
use crate::formation::places::{centroid, grid_of};
use crate::formation::request::{
    Assign, AvoidRequest, CrowdRequest, CrowdSection, ExampleKind, ExampleRequest, FormationRequest, Members,
    RequestError,
};
use crate::math::{SplitMix64, Vec2, sin_cos, vec2};
use crate::motion::Ensemble;
use crate::options::OptionError;
use crate::progress::Progress;
use crate::recordings::Recording;

/// Refuses more key formations than memory holds.
fn check_keys(keys: usize, people: usize, crowd: &str) -> Result<(), FormationError> {
    let most = MOST_KEY_PAIRS / (people * people).max(1);
    if keys <= most {
        return Ok(());
    }
    let problem = format!("{keys} key formations of {people} people, allowed are {most} for so many people");
    Err(too_many(&format!("{crowd}.key"), problem))
}

fn too_many(key: &str, problem: String) -> FormationError {
    let error = OptionError::unfit(key, problem).with_hint("make crowds of crowds with [[formation.crowd]]");
    RequestError::Option(error).into()
}

/// Builder of a crowd and the small crowds within it, level by level.
pub(super) struct CrowdBuilder<'m> {
    folder: &'m Path,
    fps: f64,
    /// Number of frames.
    pub moments: usize,
    progress: &'m dyn Progress,
    /// Recordings read so far, for crowds of one kind.
    read: Vec<(ExampleRequest, Ensemble)>,
    /// Number of people so far.
    people: usize,
}

/// The position of a crowd in the hierarchy.
#[derive(Clone)]
struct CrowdContext {
    /// Its section, for errors: `formation.crowd.0`.
    key: String,
    /// Address of the individual that it replaces.
    address: Vec<u32>,
    /// Its number among the crowds of its kind, from 0.
    number: usize,
    /// Whether its centroid moves with the example's.
    free: bool,
    /// Its centroid in each frame, metres.
    base: Vec<Vec2>,
    /// Direction of its formations' up in each frame; empty if it stays up.
    up: Vec<Vec2>,
}

impl<'m> CrowdBuilder<'m> {
    pub fn new(folder: &'m Path, fps: f64, progress: &'m dyn Progress) -> CrowdBuilder<'m> {
        CrowdBuilder { folder, fps, moments: 0, progress, read: Vec::new(), people: 0 }
    }

    /// Duration of the whole crowd's example, seconds; `None` if neither a recording nor an end is given.
    pub fn example_duration_s(&mut self, request: &FormationRequest) -> Result<Option<f64>, FormationError> {
        let example = &request.example;
        if example.file.is_some() {
            let read = self.recorded(example)?;
            return Ok(Some(read.moments().saturating_sub(1) as f64 / self.fps));
        }
        Ok(example.to_s.map(|to_s| to_s - example.from_s))
    }

    /// Builds the whole crowd along its path, without overlaps.
    pub fn whole(&mut self, request: &FormationRequest) -> Result<Vec<FormationBody>, FormationError> {
        let base = path::places(request.way.as_ref(), self.fps, self.moments);
        let turns = request.way.as_ref().is_some_and(|way| way.follow_heading);
        let spot = CrowdContext {
            key: "formation".to_string(),
            address: Vec::new(),
            number: 0,
            free: request.way.is_none(),
            up: if turns { headings(&base) } else { Vec::new() },
            base,
        };
        let (mut bodies, keys) = self.section(request.section(), &spot, &request.avoid)?;
        keep_clear(&AvoidanceSettings::new(&request.avoid, self.fps, &keys), &mut bodies, self.progress)?;
        Ok(bodies)
    }

    /// Builds the bodies of a crowd, with small crowds in the places of individuals, and the frames of its keys.
    fn section(
        &mut self,
        section: CrowdSection<'_>,
        spot: &CrowdContext,
        avoid: &AvoidRequest,
    ) -> Result<(Vec<FormationBody>, Vec<usize>), FormationError> {
        self.progress.keep_on()?;
        let layouts: Vec<FormationLayout> =
            section.key.iter().map(|key| FormationLayout::of(key, self.folder)).collect::<Result<_, _>>()?;
        let example = self.example(section.example, spot, &layouts)?;
        check_keys(section.key.len(), example.people(), &spot.key)?;
        let keys = self.keys(section, &layouts, &example, spot)?;
        let moments: Vec<usize> = keys.iter().map(|key| key.moment).collect();
        let mut tracks = blend::between(&example, &keys, section, self.progress)?;
        if !spot.address.is_empty() {
            for moment in 0..tracks.moments() {
                let middle = tracks.centroid_m(moment);
                tracks.places_at_mut(moment).iter_mut().for_each(|place| *place -= middle);
            }
        }
        self.known(section.crowd, example.people(), spot)?;
        let mut bodies = Vec::new();
        let mut numbers = vec![0; section.crowd.len()];
        for individual in 0..example.people() {
            let place = |moment: usize| {
                let own = tracks.places_at(moment)[individual];
                spot.base[moment] + spot.up.get(moment).map_or(own, |&up| turned_to(own, up))
            };
            let track: Vec<Vec2> = (0..self.moments).map(place).collect();
            let address = [spot.address.as_slice(), &[individual as u32]].concat();
            match section.crowd.iter().position(|crowd| crowd.members.contains(individual)) {
                None => {
                    self.people += 1;
                    self.check_people(spot)?;
                    let stature_m = example.statures().of(example.ids[individual]);
                    let who = FormedPerson { address, rides: false, stature_m };
                    bodies.push(FormationBody::person(track, who, avoid));
                }
                Some(kind) => {
                    let key = format!("{}.crowd.{kind}", spot.key);
                    let follows = section.crowd[kind].follow_heading;
                    let up = if follows { headings(&track) } else { spot.up.clone() };
                    let inner = CrowdContext { key, address, number: numbers[kind], free: false, base: track, up };
                    numbers[kind] += 1;
                    bodies.extend(self.small_crowd(&section.crowd[kind], inner, avoid)?);
                }
            }
        }
        Ok((bodies, moments))
    }

    /// Builds a small crowd in the place of an individual.
    fn small_crowd(
        &mut self,
        request: &CrowdRequest,
        spot: CrowdContext,
        larger: &AvoidRequest,
    ) -> Result<Vec<FormationBody>, FormationError> {
        let avoid = request.avoid.over(larger);
        let (mut bodies, keys) = self.section(request.section(), &spot, &avoid)?;
        if !request.is_as_one() {
            return Ok(bodies);
        }
        let rider = request.rider.then(|| {
            let carriers = spot.address.iter().copied().chain([bodies.len() as u32]);
            let who = FormedPerson { address: carriers.collect(), rides: true, stature_m: None };
            BodyMember { offsets: Vec::new(), who }
        });
        self.people += usize::from(request.rider);
        for body in &mut bodies {
            body.places.iter_mut().zip(&spot.base).for_each(|(place, &middle)| *place -= middle);
        }
        keep_clear(&AvoidanceSettings::new(&avoid, self.fps, &keys), &mut bodies, self.progress)?;
        let mut whole = FormationBody::of_all(bodies, spot.base);
        whole.people.extend(rider);
        Ok(vec![whole])
    }

    fn check_people(&self, spot: &CrowdContext) -> Result<(), FormationError> {
        check_size(self.people, self.moments)?;
        if self.people > MOST_IN_ALL {
            return Err(RequestError::TooMany { key: spot.key.clone(), people: self.people }.into());
        }
        Ok(())
    }

    /// Checks that the members that a section names exist.
    fn known(&self, crowds: &[CrowdRequest], people: usize, spot: &CrowdContext) -> Result<(), FormationError> {
        for (kind, crowd) in crowds.iter().enumerate() {
            let Members::List(list) = &crowd.members else { continue };
            if let Some(&person) = list.iter().find(|&&person| person as usize >= people) {
                let key = format!("{}.crowd.{kind}.members", spot.key);
                return Err(RequestError::NoSuchPerson { key, person, people }.into());
            }
        }
        Ok(())
    }

    /// The example of a section, with the duration of the whole.
    fn example(
        &mut self,
        request: &ExampleRequest,
        spot: &CrowdContext,
        layouts: &[FormationLayout],
    ) -> Result<Ensemble, FormationError> {
        let key = format!("{}.example", spot.key);
        let whole = if request.file.is_some() {
            self.recorded(request)?
        } else {
            let (people, columns) =
                how_many(request, layouts, spot).ok_or_else(|| RequestError::HowMany { key: key.clone() })?;
            let long_s = request.to_s.map(|to_s| to_s - request.from_s);
            let own = long_s.map_or(self.moments, |long_s| ((long_s * self.fps) as usize).saturating_add(1));
            let moments = own.min(self.moments);
            self.check_example(&key, people, moments)?;
            let kind = request.kind.unwrap_or(ExampleKind::Still);
            if kind == ExampleKind::Wander && people > MOST_WANDERERS {
                let problem = format!("{people} people wander; allowed are {MOST_WANDERERS} at most");
                return Err(too_many(&key, problem));
            }
            let seed = spot.address.iter().fold(request.seed, |seed, &k| {
                SplitMix64::new(seed.wrapping_add(u64::from(k)).wrapping_add(1)).next_u64()
            });
            GeneratedExample { request, kind, people, columns, seed, fps: self.fps, moments }.make(self.progress)?
        };
        let chosen = match &request.choose {
            Some(choice) => chosen(&whole, choice.of_crowd(spot.number), &key)?,
            None => whole,
        };
        self.check_example(&key, chosen.people(), self.moments)?;
        Ok(example::lengthened(&chosen, self.moments, request.repeat))
    }

    fn check_example(&self, key: &str, people: usize, moments: usize) -> Result<(), FormationError> {
        if people == 0 || people > MOST_PEOPLE {
            return Err(RequestError::TooMany { key: key.to_string(), people }.into());
        }
        check_size(people, moments)
    }

    /// The ensemble of a recording, read once.
    fn recorded(&mut self, request: &ExampleRequest) -> Result<Ensemble, FormationError> {
        let same = |other: &ExampleRequest| {
            (&other.file, &other.recording, other.from_s, other.to_s)
                == (&request.file, &request.recording, request.from_s, request.to_s)
        };
        if let Some((_, ensemble)) = self.read.iter().find(|(other, _)| same(other)) {
            return Ok(ensemble.clone());
        }
        let path = self.folder.join(request.file.as_deref().unwrap_or(Path::new("")));
        let recording = Recording::open(&path, &request.recording)?;
        recording.survey().warnings.iter().for_each(|warning| self.progress.warn(warning));
        let span_s = [request.from_s, request.to_s.unwrap_or(f64::INFINITY)];
        let mut ensemble = recording.ensemble(Some(self.fps), span_s)?;
        ensemble.start_s = 0.0;
        self.read.push((request.clone(), ensemble.clone()));
        Ok(ensemble)
    }

    /// The positions of each key formation.
    fn keys(
        &self,
        section: CrowdSection<'_>,
        layouts: &[FormationLayout],
        example: &Ensemble,
        spot: &CrowdContext,
    ) -> Result<Vec<KeyPlaces>, FormationError> {
        let last = self.moments - 1;
        let at = |time_s: f64| ((time_s * self.fps).round().max(0.0) as usize).min(last);
        let mut keys: Vec<KeyPlaces> = Vec::new();
        let mut before = example.places_at(0).to_vec();
        let mut wheel_rad = 0.0;
        let still = has_no_formation(section.example);
        for (index, (request, layout)) in section.key.iter().zip(layouts).enumerate() {
            let moment = at(request.time_s);
            wheel_rad += request.wheel_deg.to_radians();
            let input = PlacementInput {
                people: example.people(),
                example: example.places_at(moment),
                before: &before,
                wheel_rad,
                free: spot.free,
                // Without positions before it, the first formation is taken in order.
                assign: if index == 0 && still { Assign::Order } else { section.assign.unwrap_or_default() },
            };
            let key = format!("{}.key.{index}", spot.key);
            let places_m = keys::places(request, layout, &input, &key)?;
            let middle = centroid(&places_m);
            let (sin, cos) = sin_cos(-wheel_rad);
            before = places_m.iter().map(|&place| (place - middle).rotated(vec2(cos, sin))).collect();
            let end = at(request.time_s + request.hold_s);
            keys.push(KeyPlaces { moment, places_m: places_m.clone(), wheel_rad });
            if end > moment {
                keys.push(KeyPlaces { moment: end, places_m, wheel_rad });
            }
        }
        // Two key formations may fall into one frame: the later one counts.
        keys.reverse();
        keys.dedup_by_key(|key| key.moment);
        keys.reverse();
        self.complete(&mut keys, section.example, example, spot.free);
        Ok(keys)
    }

    /// Adds formations at the start and the end if missing: the example's own, else the nearest key formation.
    fn complete(&self, keys: &mut Vec<KeyPlaces>, request: &ExampleRequest, example: &Ensemble, free: bool) {
        let last = self.moments - 1;
        let still = has_no_formation(request);
        let own = |moment: usize, wheel_rad: f64| {
            let places = example.places_at(moment);
            let middle = centroid(places);
            let (sin, cos) = sin_cos(wheel_rad);
            let turned = places.iter().map(|&place| (place - middle).rotated(vec2(cos, sin)));
            let at = if free { middle } else { Vec2::ZERO };
            KeyPlaces { moment, places_m: turned.map(|place| place + at).collect(), wheel_rad }
        };
        let Some((first, end)) = keys.first().cloned().zip(keys.last().cloned()) else { return };
        if first.moment > 0 {
            keys.insert(0, if still { KeyPlaces { moment: 0, ..first } } else { own(0, 0.0) });
        }
        if end.moment < last {
            keys.push(if still { KeyPlaces { moment: last, ..end } } else { own(last, end.wheel_rad) });
        }
    }
}

/// Whether an example has no formation of its own: its people stand or sway wherever they are.
fn has_no_formation(request: &ExampleRequest) -> bool {
    request.file.is_none() && matches!(request.kind, None | Some(ExampleKind::Still | ExampleKind::Sway))
}

/// The number of people to generate and the number in a row; `None` if not given.
fn how_many(request: &ExampleRequest, layouts: &[FormationLayout], spot: &CrowdContext) -> Option<(usize, usize)> {
    let [people, rows, columns] =
        [request.people, request.rows, request.columns].map(|count| count.map(|n| n as usize));
    let chosen = request.choose.as_ref().map(|choice| choice.of_crowd(spot.number));
    let of_keys = || match chosen {
        Some(chosen) => chosen.iter().max().map(|&last| last as usize + 1),
        None => layouts.iter().find_map(FormationLayout::people),
    };
    let people = people.or_else(|| Some(rows? * columns?)).or_else(of_keys)?;
    let columns = columns.or_else(|| Some(people.div_ceil(rows?))).unwrap_or_else(|| grid_of(people)[0]);
    Some((people, columns.max(1)))
}

/// Selects people of an example.
fn chosen(example: &Ensemble, people: &[u32], key: &str) -> Result<Ensemble, RequestError> {
    if let Some(&person) = people.iter().find(|&&person| person as usize >= example.people()) {
        let key = format!("{key}.choose");
        return Err(RequestError::NoSuchPerson { key, person, people: example.people() });
    }
    let moments = 0..example.moments();
    let places =
        moments.flat_map(|moment| people.iter().map(move |&person| example.places_at(moment)[person as usize]));
    let ids = 0..people.len() as u32;
    let stature_m = |person: u32| example.statures().of(example.ids[person as usize]);
    let statures = ids.clone().zip(people).filter_map(|(id, &person)| Some((id, stature_m(person)?))).collect();
    Ok(Ensemble::new(example.fps, example.start_s, ids.collect(), places.collect()).with_statures(statures))
}

/// Checks that all positions can be held.
pub(super) fn check_size(people: usize, moments: usize) -> Result<(), FormationError> {
    match people.checked_mul(moments) {
        Some(places) if places <= MOST_FORMED_PLACES => Ok(()),
        _ => Err(RequestError::TooLong { people, moments, most: MOST_FORMED_PLACES }.into()),
    }
}
