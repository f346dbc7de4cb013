//! Finds units that fit the people who are there (U3 of the paper's steps: count and groups, then heading and places).

use serde::{Deserialize, Serialize};

use super::areas::{AreaSide, Areas};
use super::assignment::assign_allowed;
use super::error::UnitsError;
use super::track::TrackState;
use super::unit::Unit;
use crate::math::Vec2;

/// How candidates are ranked.
///
/// A person at `x` with velocity `v` and heading `h` who takes a member's part, which starts at `x'`, `v'`, `h'`, costs
///
/// ```text
/// c = place |x - x'|^2 + speed |v - v'|^2 + heading (1 - h.h') + end (1 - h.h'(T))
/// ```
///
/// and a unit the mean of its people's costs, people being given the parts with the least sum, plus `again` divided by how
/// many units ago it was last played, plus `left` for everybody behind the viewer who is left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MatchOptions {
    /// Cost of a place that is a metre off.
    pub place: f64,
    /// Cost of a velocity that is 1 m/s off.
    pub speed: f64,
    /// Cost of a heading that is a quarter turn off; half a turn costs double.
    pub heading: f64,
    /// The same for the heading at the unit's end: where the person wants to go on to.
    pub end: f64,
    /// Cost of a unit that was just played.
    pub again: f64,
    /// Cost of leaving out somebody behind who comes on, at 1 m/s; who goes away costs nothing. Only units that have nobody
    /// behind leave those out who are there.
    pub left: f64,
    /// Nobody takes a part that starts farther off, metres.
    pub most_place_m: f64,
    /// Nobody takes a part that starts turned by more, degrees.
    pub most_turn_deg: f64,
    /// No unit is played that costs more.
    pub most: f64,
}

impl Default for MatchOptions {
    fn default() -> MatchOptions {
        MatchOptions {
            place: 1.0,
            speed: 0.5,
            heading: 1.0,
            end: 0.15,
            again: 1.0,
            left: 0.4,
            most_place_m: 1.6,
            most_turn_deg: 60.0,
            most: 2.0,
        }
    }
}

impl MatchOptions {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not a number or out of its range.
    pub fn check(&self) -> Result<(), UnitsError> {
        let numbers = [
            ("place", self.place, 0.0, 1e3),
            ("speed", self.speed, 0.0, 1e3),
            ("heading", self.heading, 0.0, 1e3),
            ("end", self.end, 0.0, 1e3),
            ("again", self.again, 0.0, 1e3),
            ("left", self.left, 0.0, 1e6),
            ("most_place_m", self.most_place_m, 0.0, 10.0),
            ("most_turn_deg", self.most_turn_deg, 0.0, 180.0),
            ("most", self.most, 0.0, 1e6),
        ];
        match numbers.into_iter().find(|&(_, value, low, high)| !(value >= low && value <= high)) {
            Some((name, value, low, high)) => Err(UnitsError::Number { name, value, low, high }),
            None => Ok(()),
        }
    }
}

/// People who belong together and are judged, in the viewer's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Party {
    /// Where they are.
    pub side: AreaSide,
    /// Each of them: the id, and how the person moves.
    pub people: Vec<(u32, TrackState)>,
}

impl Party {
    /// A group whose side is where its middle is; `None` if that lies in neither area.
    pub fn of(areas: &Areas, people: Vec<(u32, TrackState)>) -> Option<Party> {
        let sum = people.iter().fold(Vec2::ZERO, |sum, (_, moment)| sum + moment.place_m);
        let side = areas.side_of(sum / people.len().max(1) as f64)?;
        Some(Party { side, people })
    }
}

/// A unit that fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Which unit, counted as it was given.
    pub unit: usize,
    /// Whether left and right are exchanged.
    pub mirrored: bool,
    /// What it costs, see [`MatchOptions`].
    pub cost: f64,
    /// Who takes which member's part: ids in the order of members.
    pub parts: Vec<u32>,
}

/// What came of a search.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranking {
    /// Those that fit, the best first.
    pub candidates: Vec<Candidate>,
    /// How many units have as many people in the same groups, mirrored ones not counted.
    pub alike: usize,
}

/// Sizes of the groups in front and behind, each ascending.
pub(super) fn composition(present: &[Party]) -> [Vec<usize>; 2] {
    let mut sizes = [Vec::new(), Vec::new()];
    for group in present {
        sizes[group.side as usize].push(group.people.len());
    }
    sizes.iter_mut().for_each(|sizes| sizes.sort_unstable());
    sizes
}

/// Finds the units whose count and groups are those of the people present, in front as behind, and ranks them.
///
/// Units are played in front. One that has nobody behind therefore also serves if its people are those in front, and goes
/// behind those that have everybody: whoever is behind the viewer walks on and stays out of its way.
///
/// `recent` says how many units ago one was played, 1 for the last. Units whose area is larger than the one that units
/// are played on are left out.
pub fn rank(
    units: &[Unit],
    present: &[Party],
    areas: &Areas,
    options: &MatchOptions,
    recent: impl Fn(usize) -> Option<usize>,
) -> Ranking {
    let mut ranked = Ranking::default();
    if present.is_empty() {
        return ranked;
    }
    let there = composition(present);
    let front: Vec<Party> = present.iter().filter(|party| party.side == AreaSide::Front).cloned().collect();
    let comes_on = |party: &Party| party.people.iter().map(|(_, moment)| moment.velocity_m_s.y.max(0.0)).sum::<f64>();
    let left = options.left * present.iter().filter(|party| party.side == AreaSide::Rear).map(comes_on).sum::<f64>();
    for (index, unit) in units.iter().enumerate() {
        let fits = unit.area_m.iter().zip(areas.played_m).all(|(has, room)| *has <= room + 1e-9);
        let [in_front, behind] = unit.composition();
        let all = behind == there[1];
        if !fits || in_front != there[0] || !(all || behind.is_empty() && !front.is_empty()) {
            continue;
        }
        let (cast_of, left) = if all { (present, 0.0) } else { (&front[..], left) };
        ranked.alike += 1;
        let again = recent(index).map_or(0.0, |ago| options.again / ago.max(1) as f64);
        for mirrored in [false, true] {
            let Some((sum, parts)) = cast(unit, mirrored, cast_of, options) else { continue };
            let cost = sum / parts.len() as f64 + again + left;
            if cost <= options.most {
                ranked.candidates.push(Candidate { unit: index, mirrored, cost, parts });
            }
        }
    }
    ranked
        .candidates
        .sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.unit.cmp(&b.unit)).then(a.mirrored.cmp(&b.mirrored)));
    ranked
}

/// Gives everybody a part: groups to groups of the same size on the same side, and within them people to members.
fn cast(unit: &Unit, mirrored: bool, present: &[Party], options: &MatchOptions) -> Option<(f64, Vec<u32>)> {
    let groups = unit.groups();
    let ends: Vec<[TrackState; 2]> = (0..unit.members.len())
        .map(|member| [0.0, unit.duration_s].map(|time_s| unit.moment(member, time_s, mirrored)))
        .collect();
    let inner = |row: usize, column: usize| {
        let (group, there) = (&groups[row], &present[column]);
        if group.len() != there.people.len() || unit.side_of(group) != there.side {
            return None;
        }
        assign_allowed(group.len(), |k, l| part_cost(&there.people[l].1, &ends[group[k]], options))
    };
    // Few groups: every pair is worked out once.
    let table: Vec<Vec<_>> =
        (0..groups.len()).map(|row| (0..present.len()).map(|column| inner(row, column)).collect()).collect();
    let (sum, columns) =
        assign_allowed(groups.len(), |row, column| table[row][column].as_ref().map(|(cost, _)| *cost))?;
    let mut parts = vec![0; unit.members.len()];
    for (row, &column) in columns.iter().enumerate() {
        let (_, people) = table[row][column].as_ref()?;
        for (k, &person) in people.iter().enumerate() {
            parts[groups[row][k]] = present[column].people[person].0;
        }
    }
    Some((sum, parts))
}

/// What it costs that somebody takes a part; `None` if it starts too far off.
fn part_cost(person: &TrackState, [start, end]: &[TrackState; 2], options: &MatchOptions) -> Option<f64> {
    let away = person.place_m.distance(start.place_m);
    let agree = person.heading.dot(start.heading);
    let least_agree = crate::math::sin_cos(options.most_turn_deg.to_radians()).1;
    if away > options.most_place_m || agree < least_agree {
        return None;
    }
    let speed = person.velocity_m_s.distance(start.velocity_m_s);
    let ends = 1.0 - person.heading.dot(end.heading);
    Some(
        options.place * away * away
            + options.speed * speed * speed
            + options.heading * (1.0 - agree)
            + options.end * ends,
    )
}

#[cfg(test)]
mod tests;
