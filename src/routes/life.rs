//! Default life: tours of people who come into a building, use its rooms, and leave again.
//!
//! A tour leads from an entrance through a few rooms, with a stay in each, to an entrance; in a closed plan from a room
//! through others back to it. Tours are few and fixed. Rooms get their turn by weight, those that had none yet first, so
//! that together the tours visit every room; people take the tours in turn. So every room is used, even by few people.

use super::draft::RouteDraft;
use super::ground::Ground;
use super::legs::FieldStore;
use super::{Facing, Place, RouteLife, RouteStop, RoutesError, RoutesOptions, Stop, StopKind, ribbon, targets};
use crate::math::{Distribution, Rect, Vec2, vec2};
use crate::options::nearest;
use crate::plan::FloorPlan;
use crate::rooms::{Entrance, Habits, Life, LifeOptions, RoomKind, Spot, UnfitRoom, Zone};
use crate::walls::Walls;

/// Least and largest number of tours.
const TOURS: [usize; 2] = [24, 64];
/// Tours for each zone and visit.
const TOURS_PER_ZONE: f64 = 1.6;
/// Most rooms on a tour where there are few people.
const MOST_VISITS: usize = 16;
/// Width from which people come and go beyond an opening's edge; through narrower ones, and doors, within a square of
/// this half side, whose middle is so far inside the edge, metres.
const WIDE_M: f64 = 2.4;
const DOOR_REACH_M: f64 = 0.7;
const INSIDE_M: f64 = 0.5;
/// Range to which widths of entrances are clamped, metres.
const WIDTHS_M: [f64; 2] = [0.6, 8.0];
/// Entrances between which people pass: the widest.
const MOST_PASSED: usize = 4;
/// Weight of the way to a room, as a share of the plan's diagonal, against its turn.
const NEARNESS: f64 = 1.0;
/// Least share of zones with a path in a space that people cross.
const CROSSED: f64 = 0.5;
/// Largest distance of floor to walk on from the middle of a zone, metres.
const NEAR_MIDDLE_M: f64 = 0.5;
/// Half side of the square in the middle of a zone that leads people there, metres.
const MIDDLE_M: f64 = 0.6;
/// Most zones that people go to, on large ground and on small: each takes a field of so many cells, of which there is
/// memory for a number. The first zones of all rooms come first.
const MOST_TARGETS: [usize; 2] = [24, 128];
const MOST_CELLS: usize = 6_000_000;
/// Spread of stays: standard deviation, least and largest length, relative to the mean.
const STAYS: [f64; 3] = [0.5, 0.3, 2.5];

/// In scanned maps beams of the scanner look like ways. People come in where floor goes on as wide as this on both sides
/// of a way, and go to rooms where two can pass each other, metres.
const WIDE_ENTRY_M: f64 = 0.6;
const WIDE_WAY_M: f64 = 0.35;
/// How near to wide floor entrances and the middles of zones are, metres.
const NEAR_WIDE_M: f64 = 0.8;

/// Finds the rooms of a plan as the options say.
pub(super) fn of(plan: &FloorPlan, walls: &Walls, options: &RoutesOptions) -> Result<Life, RoutesError> {
    Life::of(plan, walls, &options.life, &options.rooms).map_err(|unfit| {
        // The plan's own names.
        let names: Vec<String> = match Life::of(plan, walls, &options.life, &[]) {
            Ok(life) => life.rooms.rooms.into_iter().map(|room| room.name).collect(),
            Err(_) => Vec::new(),
        };
        let (problem, like) = match unfit {
            UnfitRoom::Unknown(name) => {
                let like = nearest(&name, names.iter().map(String::as_str)).map(str::to_string);
                (format!("there is no room called \"{name}\""), like)
            }
            UnfitRoom::Nowhere([x, y]) => (format!("px [{x:.0}, {y:.0}] lies in no room"), None),
            UnfitRoom::Neither => ("it has neither `name` nor `at`".to_string(), None),
        };
        RoutesError::UnknownRoom { problem, nearest: like, rooms: names.len() }
    })
}

/// Whether people who cross a space on some routes come through most of it: then they need not live in it.
pub(super) fn is_crossed(
    plan: &FloorPlan,
    ground: &Ground,
    life: &Life,
    fields: &FieldStore<'_>,
    drafts: &[RouteDraft],
) -> bool {
    if life.rooms.rooms.iter().all(|room| room.kind == RoomKind::Corridor) {
        return true;
    }
    let path = |draft: &RouteDraft| {
        let start = targets::middle(ground, &targets::cells(plan, ground, draft.start))?;
        ribbon::trace(ground, fields.get(draft.legs().next()?), start)
    };
    let paths: Vec<Vec2> = drafts.iter().filter_map(path).flatten().collect();
    let (mut crossed_m2, mut all_m2) = (0.0, 0.0);
    for zone in life.rooms.zones() {
        let [min, max] = zone.area_m;
        let is_crossed = paths.iter().any(|&p| Rect { min, max }.contains(p));
        crossed_m2 += if is_crossed { zone.area_m2 } else { 0.0 };
        all_m2 += zone.area_m2;
    }
    crossed_m2 >= CROSSED * all_m2
}

/// An entrance on the ground.
pub(super) struct End {
    pub(super) place: Place,
    pub(super) name: String,
    at_m: Vec2,
    pub(super) width_m: f64,
    pub(super) part: u16,
}

/// A zone of a room on the ground.
struct Target {
    name: String,
    place: Place,
    at_m: Vec2,
    part: u16,
    weight: f64,
    /// All of it, where people begin and end in rooms.
    home: Place,
    is_home: bool,
    stop: Stop,
    /// Spots of one stay, one after the other.
    spots: usize,
}

/// The tours of a plan, and the ways of those who only pass through; empty where there is nowhere to go.
pub(super) fn drafts(plan: &FloorPlan, ground: &Ground, life: &Life, options: &LifeOptions) -> Vec<RouteDraft> {
    let habits = life.r#use.habits();
    let mut ends: Vec<End> = life.rooms.entrances.iter().filter_map(|entrance| end(plan, ground, entrance)).collect();
    let mut zones = life.rooms.zones();
    let mut rooms = std::collections::BTreeSet::new();
    let is_first: Vec<bool> = zones.iter().map(|zone| rooms.insert(zone.room)).collect();
    let mut order: Vec<usize> = (0..zones.len()).collect();
    order.sort_by(|&a, &b| is_first[b].cmp(&is_first[a]).then(zones[b].area_m2.total_cmp(&zones[a].area_m2)));
    order.truncate((MOST_CELLS / ground.lattice.len().max(1)).clamp(MOST_TARGETS[0], MOST_TARGETS[1]));
    let mut number = 0..zones.len();
    zones.retain(|_| number.next().is_some_and(|number| order.contains(&number)));
    let mut targets: Vec<Target> =
        zones.iter().filter_map(|zone| target(ground, life, &habits, zone, options.stay)).collect();
    if plan.scanned {
        let [entry, way] = [WIDE_ENTRY_M, WIDE_WAY_M].map(|clear_m| life.rooms.wide_part(clear_m));
        ends.retain(|end| life.rooms.comes_near(&entry, end.at_m, NEAR_WIDE_M));
        targets.retain(|target| life.rooms.comes_near(&way, target.at_m, NEAR_WIDE_M));
    }
    let mut parts: Vec<u16> = match ends.is_empty() {
        true => targets.iter().map(|target| target.part).collect(),
        false => ends.iter().map(|end| end.part).collect(),
    };
    parts.sort_unstable();
    parts.dedup();
    let within = |part: u16| targets.iter().filter(move |target| target.part == part).collect::<Vec<_>>();
    let all = parts.iter().map(|&part| within(part).len()).sum::<usize>().max(1);
    let mut drafts = Vec::new();
    for &part in &parts {
        let own = within(part);
        let ends: Vec<&End> = ends.iter().filter(|end| end.part == part).collect();
        if own.is_empty() || ends.is_empty() && own.len() < 2 {
            continue;
        }
        let share = own.len() as f64 / all as f64;
        let people = (f64::from(options.people) * share) as usize;
        let tours = Tours { targets: own, ends, habits, life };
        drafts.extend(tours.drafts(plan, people.max(1), share));
    }
    drafts
}

/// Where people come and go at an entrance, unless it is too narrow for anybody.
pub(super) fn end(plan: &FloorPlan, ground: &Ground, entrance: &Entrance) -> Option<End> {
    let area = |middle: Vec2| {
        let reach = vec2(DOOR_REACH_M, DOOR_REACH_M);
        Place::Area([middle - reach, middle + reach])
    };
    let place = match entrance.opening {
        Some(index) if entrance.width_m >= WIDE_M => Place::Opening(index),
        // Beyond a narrow opening those who come and those who go would meet in a passage without end.
        Some(index) => area(entrance.at_m - plan.openings[index].side.outward() * INSIDE_M),
        None => area(entrance.at_m),
    };
    let cell = *targets::cells(plan, ground, place).first()?;
    let width_m = entrance.width_m.clamp(WIDTHS_M[0], WIDTHS_M[1]);
    Some(End { place, name: entrance.name.clone(), at_m: entrance.at_m, width_m, part: ground.part(cell) })
}

fn target(ground: &Ground, life: &Life, habits: &Habits, zone: &Zone, factor: f64) -> Option<Target> {
    let room = &life.rooms.rooms[zone.room];
    let home = Place::Area(zone.area_m);
    let cell = ground.walkable_near(zone.at_m, NEAR_MIDDLE_M)?;
    let at_m = ground.lattice.centre(cell);
    let reach = vec2(MIDDLE_M, MIDDLE_M);
    let place = Place::Area([at_m - reach, at_m + reach]);
    let part = ground.part(cell);
    let of_kind = habits.of(room.kind);
    let weight = of_kind.draws * room.weight() * zone.area_m2.sqrt();
    if weight <= 0.0 {
        return None;
    }
    let reached = |spot: &&Spot| ground.lattice.cell_at(spot.at_m).is_some_and(|cell| ground.part(cell) == part);
    let mut spots: Vec<Spot> = zone.spots.iter().filter(reached).copied().collect();
    if spots.is_empty() {
        spots.push(Spot { at_m, facing: None });
    }
    let mean_s = factor * of_kind.stay_s;
    let [sd, min, max] = STAYS.map(|share| share * mean_s);
    let stop = Stop {
        name: zone.name.clone(),
        kind: StopKind::Place,
        at_m: zone.area_m,
        places_m: vec![at_m],
        facing: Facing::Free,
        dwell_s: room.stay_s().unwrap_or(Distribution::normal(mean_s, sd, min, max)),
        spacing_m: 0.75,
        reach_m: 1.5,
        queue_m: Vec::new(),
        spots,
    };
    let is_home = matches!(room.kind, RoomKind::Room | RoomKind::Hall);
    Some(Target { name: zone.name.clone(), place, at_m, part, weight, home, is_home, stop, spots: of_kind.spots })
}

/// Turns by weight: the next is the one that is farthest behind its share.
struct Turns {
    weights: Vec<f64>,
    taken: Vec<f64>,
}

impl Turns {
    fn new(weights: impl Iterator<Item = f64>) -> Turns {
        let mut weights: Vec<f64> = weights.collect();
        let mean = weights.iter().sum::<f64>() / weights.len().max(1) as f64;
        weights.iter_mut().for_each(|weight| *weight /= mean.max(1e-9));
        Turns { taken: vec![0.0; weights.len()], weights }
    }

    /// The next among those for which `cost` gives a number, which counts like turns taken.
    fn next(&mut self, cost: impl Fn(usize) -> Option<f64>) -> Option<usize> {
        let behind = |k: usize| (self.taken[k] + 0.5) / self.weights[k].max(1e-9);
        // Those without any turn come first.
        let key = |k: usize| Some((self.taken[k] > 0.0, behind(k) + cost(k)?));
        let keys = (0..self.weights.len()).filter_map(|k| Some((key(k)?, k)));
        let next = keys.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)))?.1;
        self.taken[next] += 1.0;
        Some(next)
    }
}

/// What tours are made of, in a connected part of the floor.
struct Tours<'l> {
    targets: Vec<&'l Target>,
    ends: Vec<&'l End>,
    habits: Habits,
    life: &'l Life,
}

impl Tours<'_> {
    /// Tours for so many people, and ways between entrances; their shares sum to `share`.
    fn drafts(&self, plan: &FloorPlan, people: usize, share: f64) -> Vec<RouteDraft> {
        let count = self.targets.len();
        let [least, most] = self.habits.visits;
        let mean = 0.5 * (least + most) as f64;
        let wanted = (TOURS_PER_ZONE * count as f64 / mean).ceil() as usize;
        let tours = wanted.clamp(TOURS[0], TOURS[1]).min(people);
        let passing = self.ends.len() > 1 && (1.0 - self.habits.pass) * people as f64 >= tours as f64;
        let pass = if passing { self.habits.pass } else { 0.0 };
        let extent_m = plan.width_m() + plan.height_m();
        let mut rooms = Turns::new(self.targets.iter().map(|target| target.weight));
        let mut homes = Turns::new(self.targets.iter().map(|t| if t.is_home { t.weight } else { 0.01 * t.weight }));
        let [mut entries, mut exits] = [(); 2].map(|()| Turns::new(self.ends.iter().map(|end| end.width_m)));
        let mut drafts = Vec::with_capacity(tours);
        let mut visited = 0;
        for tour in 0..tours {
            // As many as the habits say, and more where some room would be left out.
            let left = (count.saturating_sub(visited)).div_ceil(tours - tour);
            let visits = (least + tour % (most - least + 1)).max(left.min(MOST_VISITS)).min(count);
            let home = if self.ends.is_empty() { homes.next(|_| Some(0.0)) } else { None };
            let entry = entries.next(|_| Some(0.0));
            let mut at_m = match (home, entry) {
                (Some(home), _) => self.targets[home].at_m,
                (None, Some(entry)) => self.ends[entry].at_m,
                (None, None) => continue,
            };
            let mut tour_of: Vec<usize> = Vec::with_capacity(visits);
            for _ in 0..visits {
                let cost = |k: usize| {
                    let free = home != Some(k) && !tour_of.contains(&k);
                    free.then(|| NEARNESS * self.targets[k].at_m.distance(at_m) / extent_m)
                };
                let Some(next) = rooms.next(cost) else { break };
                at_m = self.targets[next].at_m;
                tour_of.push(next);
            }
            visited += tour_of.len();
            // Every second person leaves by another door.
            let exit = if tour % 2 == 0 { entry } else { exits.next(|_| Some(0.0)) };
            let [start, goal] = match (home, entry, exit) {
                (Some(home), ..) => [home; 2].map(|k| (self.targets[k].home, self.targets[k].name.clone())),
                (None, Some(entry), Some(exit)) => {
                    [entry, exit].map(|k| (self.ends[k].place, self.ends[k].name.clone()))
                }
                _ => continue,
            };
            drafts.push(self.tour(start, &tour_of, goal, share * (1.0 - pass) / tours as f64));
        }
        if pass > 0.0 {
            drafts.extend(self.passages(share * pass));
        }
        drafts
    }

    fn life(&self) -> Option<RouteLife> {
        Some(RouteLife { r#use: self.life.r#use, from_outside: !self.ends.is_empty() })
    }

    fn tour(&self, start: (Place, String), rooms: &[usize], goal: (Place, String), share: f64) -> RouteDraft {
        let names: Vec<String> = rooms.iter().map(|&k| self.targets[k].name.clone()).collect();
        let stops = rooms.iter().enumerate().flat_map(|(index, &k)| {
            let Target { stop, spots, .. } = self.targets[k];
            (0..*spots).map(move |_| RouteStop { stop: stop.clone(), share: 1.0, after_via: index + 1 })
        });
        RouteDraft {
            name: format!("{}: {}", start.1, names.join(", ")),
            place_names: [start.1.clone()].into_iter().chain(names.clone()).chain([goal.1.clone()]).collect(),
            start: start.0,
            via: rooms.iter().map(|&k| self.targets[k].place).collect(),
            stops: stops.collect(),
            arrivals: None,
            life: self.life(),
            goal: goal.0,
            share,
        }
    }

    /// Ways between the widest entrances, all pairs in both directions.
    fn passages(&self, share: f64) -> Vec<RouteDraft> {
        let mut widest = self.ends.clone();
        widest.sort_by(|a, b| b.width_m.total_cmp(&a.width_m));
        widest.truncate(MOST_PASSED);
        let pairs = widest.iter().flat_map(|&from| widest.iter().map(move |&to| (from, to)));
        let pairs: Vec<(&End, &End)> = pairs.filter(|(from, to)| from.place != to.place).collect();
        let total: f64 = pairs.iter().map(|(from, to)| from.width_m * to.width_m).sum();
        let passage = |(from, to): &(&End, &End)| RouteDraft {
            name: format!("{} to {}", from.name, to.name),
            place_names: vec![from.name.clone(), to.name.clone()],
            start: from.place,
            via: Vec::new(),
            stops: Vec::new(),
            arrivals: None,
            life: self.life(),
            goal: to.place,
            share: share * from.width_m * to.width_m / total,
        };
        pairs.iter().map(passage).collect()
    }
}
