//! Finds units that fit the people present (step U3 of the paper: number and groups, then headings and positions).

use serde::{Deserialize, Serialize};

use super::areas::{AreaSide, Areas};
use super::assignment::assign_allowed;
use super::track::TrackState;
use super::unit::Unit;
use crate::math::Vec2;

/// Weights and limits by which units are ranked.
///
/// A person at `x` with velocity `v` and heading `h`, cast for a member who starts at `x'`, `v'`, `h'`, costs
///
/// ```text
/// c = place |x - x'|^2 + speed |v - v'|^2 + heading (1 - h.h') + end (1 - h.h'(T))
/// ```
///
/// A unit costs the mean over its people, cast with the least sum, plus `again` divided by the number of units since it
/// was last played, plus `left` for each person behind the viewer who is left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MatchOptions {
    /// Cost of a position that is 1 m off.
    pub place: f64,
    /// Cost of a velocity that is 1 m/s off.
    pub speed: f64,
    /// Cost of a heading that is a quarter turn off; half a turn costs double.
    pub heading: f64,
    /// Cost of a heading at the unit's end that is a quarter turn off.
    pub end: f64,
    /// Cost of repeating the unit that was played last.
    pub again: f64,
    /// Cost of leaving out a person behind who approaches at 1 m/s; people who walk away cost nothing.
    ///
    /// Only units without people behind leave people out.
    pub left: f64,
    /// Largest distance from a person to the member's start, metres.
    pub most_place_m: f64,
    /// Largest angle between a person's heading and the member's, degrees.
    pub most_turn_deg: f64,
    /// Largest cost of a unit that is played.
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

/// A group of people present, in the viewer's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Party {
    /// The side on which the group's centroid is.
    pub side: AreaSide,
    /// Id and state of each person.
    pub people: Vec<(u32, TrackState)>,
}

impl Party {
    /// Makes a group; `None` if its centroid lies in neither area.
    pub fn of(areas: &Areas, people: Vec<(u32, TrackState)>) -> Option<Party> {
        let sum = people.iter().fold(Vec2::ZERO, |sum, (_, moment)| sum + moment.place_m);
        let side = areas.side_of(sum / people.len().max(1) as f64)?;
        Some(Party { side, people })
    }
}

/// A unit that fits the people present.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Index of the unit in the list given.
    pub unit: usize,
    /// Whether left and right are exchanged.
    pub mirrored: bool,
    /// Cost, see [`MatchOptions`].
    pub cost: f64,
    /// Ids of the people cast for the members, in the order of members.
    pub parts: Vec<u32>,
}

/// The units that fit, ranked by cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranking {
    /// The candidates, by ascending cost.
    pub candidates: Vec<Candidate>,
    /// Number of units with the same groups, not counting mirrored ones.
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

/// Finds the units whose groups are those of the people present, in front and behind, and ranks them.
///
/// Units are played in front. A unit without people behind also fits if its people are those in front; it ranks after
/// units that include everybody, because people behind the viewer walk on.
///
/// `recent` gives the number of units since a unit was played, 1 for the last one. Units whose area is larger than
/// [`Areas::played_m`] are skipped.
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

/// Casts people for members: groups for groups of the same size on the same side, and people for members within them.
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
        assign_allowed(group.len(), |k, l| member_cost(&there.people[l].1, &ends[group[k]], options))
    };
    // Each pair of groups is computed once.
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

/// Cost of casting a person for a member; `None` beyond the limits.
fn member_cost(person: &TrackState, [start, end]: &[TrackState; 2], options: &MatchOptions) -> Option<f64> {
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
