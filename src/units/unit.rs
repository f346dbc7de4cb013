use super::areas::{AreaSide, Areas};
use super::track::{TrackState, UnitTrack};
use crate::math::{Vec2, vec2};

/// Largest number of people in a unit.
pub const MOST_MEMBERS: usize = 12;
/// Longest duration of a unit, seconds.
pub const LONGEST_S: f64 = 120.0;
/// Least and largest width of a unit's area, metres.
pub const AREA_WIDTHS_M: [f64; 2] = [1.0, 20.0];
/// Least and largest depth of a unit's area, metres.
pub const AREA_DEPTHS_M: [f64; 2] = [1.0, 40.0];
/// Least distance between the centres of two members of a unit, metres: about the depth of two bodies.
pub const LEAST_APART_M: f64 = 0.36;
/// Largest speed of a member, metres per second: a sprint.
pub(super) const FASTEST_M_S: f64 = 7.0;
/// Largest acceleration of a member, metres per second squared.
pub(super) const HARDEST_M_S2: f64 = 6.0;

/// A person in a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Number of the member's group: members of one group walk together.
    pub group: u32,
    /// The member's path `c_j(t)`, in the unit's frame.
    pub track: UnitTrack,
}

/// A clip of crowd motion around a viewer: `u = { p(t), a, T, c_j(t), g_k }`.
///
/// In the unit's frame the viewer starts at the origin and looks along +y, +x is to the right. Metres, seconds.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// The unit's name.
    pub name: String,
    /// The scene, in words.
    pub description: String,
    /// The viewer's path `p(t)`; a single sample for a standing viewer.
    pub viewer: UnitTrack,
    /// Width and depth of the area `a` in front of the viewer, metres.
    pub area_m: [f64; 2],
    /// Duration `T`, seconds.
    pub duration_s: f64,
    /// The people besides the viewer.
    pub members: Vec<Member>,
}

impl Unit {
    /// Indices of each group's members; groups and members in the order of the file.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<(u32, Vec<usize>)> = Vec::new();
        for (index, member) in self.members.iter().enumerate() {
            match groups.iter_mut().find(|(group, _)| *group == member.group) {
                Some((_, members)) => members.push(index),
                None => groups.push((member.group, vec![index])),
            }
        }
        groups.into_iter().map(|(_, members)| members).collect()
    }

    /// A member's state at a time of the unit, with left and right exchanged if `mirrored`.
    pub fn moment(&self, member: usize, time_s: f64, mirrored: bool) -> TrackState {
        let moment = self.members[member].track.at(time_s);
        if !mirrored {
            return moment;
        }
        let flip = |v: Vec2| vec2(-v.x, v.y);
        TrackState {
            place_m: flip(moment.place_m),
            velocity_m_s: flip(moment.velocity_m_s),
            heading: flip(moment.heading),
        }
    }

    /// The side on which a group starts, by the sign of its mean y: a unit may begin beyond the areas.
    pub fn side_of(&self, group: &[usize]) -> AreaSide {
        let sum: f64 = group.iter().map(|&member| self.members[member].track.at(0.0).place_m.y).sum();
        if sum >= 0.0 { AreaSide::Front } else { AreaSide::Rear }
    }

    /// Sizes of the groups that start in front and behind, each ascending; they must agree with the people present.
    pub fn composition(&self) -> [Vec<usize>; 2] {
        let mut sizes = [Vec::new(), Vec::new()];
        for group in self.groups() {
            sizes[self.side_of(&group) as usize].push(group.len());
        }
        sizes.iter_mut().for_each(|sizes| sizes.sort_unstable());
        sizes
    }

    /// The composition in words: `1+2 | 1` are two groups in front and one behind.
    pub fn composition_in_words(&self) -> String {
        in_words(&self.composition())
    }

    /// Whether every member starts in the front or rear area.
    pub fn starts_within(&self, areas: &Areas) -> bool {
        self.members.iter().all(|member| areas.side_of(member.track.at(0.0).place_m).is_some())
    }
}

/// Sizes of groups in front and behind, in words.
fn in_words([front, rear]: &[Vec<usize>; 2]) -> String {
    let side = |sizes: &[usize]| match sizes {
        [] => "-".to_string(),
        sizes => sizes.iter().map(usize::to_string).collect::<Vec<_>>().join("+"),
    };
    format!("{} | {}", side(front), side(rear))
}

#[cfg(test)]
mod tests {
    use super::super::track::TrackSample;
    use super::*;

    #[test]
    fn composition_counts_groups_by_side() {
        let member = |group, y| Member {
            group,
            track: UnitTrack::new(vec![TrackSample { time_s: 0.0, place_m: vec2(0.3, y), heading: vec2(0.0, 1.0) }]),
        };
        let unit = Unit {
            name: "a".into(),
            description: String::new(),
            viewer: UnitTrack::default(),
            area_m: [3.0, 5.0],
            duration_s: 4.0,
            members: vec![member(4, 2.0), member(1, 1.0), member(4, 2.5), member(7, -1.0)],
        };
        assert_eq!(unit.groups(), [vec![0, 2], vec![1], vec![3]]);
        assert_eq!(unit.composition(), [vec![1, 2], vec![1]]);
        assert_eq!(unit.composition_in_words(), "1+2 | 1");
        assert!(unit.starts_within(&Areas::default()));
        assert_eq!(unit.moment(0, 0.0, true).place_m, vec2(-0.3, 2.0));
    }
}
