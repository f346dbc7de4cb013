use super::super::areas::Areas;
use super::super::matching::Party;
use super::super::track::{TrackSample, TrackState, UnitTrack};
use super::super::unit::{AREA_DEPTHS_M, LEAST_APART_M, MOST_MEMBERS, Member, Unit};
use super::options::CutOptions;
use super::walks::{FPS, SpotTracks};
use crate::math::{Vec2, vec2};

/// Distance beyond the areas at which a person has left them, metres.
const BEYOND_M: f64 = 0.5;
/// Least distance from the viewer to a member, metres.
const VIEWER_M: f64 = 0.5;

/// An interval of a motion that may become a unit.
#[derive(Clone, Debug)]
pub(super) struct UnitInterval {
    pub(super) from: u64,
    pub(super) to: u64,
    /// Indices in the list of tracks, ascending.
    pub(super) members: Vec<usize>,
}

/// The interval that starts at a frame, with the groups in the areas; `None` if too short.
pub(super) fn stretch_from(
    walks: &SpotTracks,
    groups: &[u32],
    from: u64,
    options: &CutOptions,
) -> Option<UnitInterval> {
    let members = members_at(walks, groups, from, &options.areas);
    if members.is_empty() || members.len() > MOST_MEMBERS {
        return None;
    }
    let longest = from + (options.most_s * FPS) as u64;
    let mut to = from;
    while to < longest && goes_on(walks, &members, to, options) {
        to += 1;
    }
    // The frame before the one that ended it, in whole samples.
    let every = every(options);
    let to = from + (to - from).saturating_sub(u64::from(to < longest)) / every * every;
    ((to - from) as f64 >= options.least_s * FPS).then_some(UnitInterval { from, to, members })
}

/// Frames from one sample to the next.
fn every(options: &CutOptions) -> u64 {
    ((FPS / options.fps).round() as u64).max(1)
}

/// The members of the groups whose centroid is in the front or rear area.
fn members_at(walks: &SpotTracks, groups: &[u32], frame: u64, areas: &Areas) -> Vec<usize> {
    let mut there: Vec<(u32, usize, TrackState)> = walks.present(frame).map(|(k, m)| (groups[k], k, *m)).collect();
    there.sort_by_key(|&(group, walk, _)| (group, walk));
    let mut members: Vec<usize> = Vec::new();
    for group in there.chunk_by(|a, b| a.0 == b.0) {
        let people = group.iter().map(|&(_, walk, moment)| (walk as u32, moment)).collect();
        if Party::of(areas, people).is_some() {
            members.extend(group.iter().map(|&(_, walk, _)| walk));
        }
    }
    members.sort_unstable();
    members
}

/// Whether an interval continues at a frame.
///
/// All members are seen, at least one is in the areas, no other person is near, and the viewer is not touched.
fn goes_on(walks: &SpotTracks, members: &[usize], frame: u64, options: &CutOptions) -> bool {
    let mut moments: Vec<TrackState> = Vec::with_capacity(members.len());
    for &walk in members {
        let Some(moment) = walks.all[walk].at(frame) else { return false };
        moments.push(*moment);
    }
    let apart = |least_m: f64, a: Vec2, b: Vec2| a.distance(b) >= least_m;
    let of_each_other = (moments.iter().enumerate())
        .all(|(k, m)| moments[..k].iter().all(|other| apart(LEAST_APART_M + 0.01, m.place_m, other.place_m)));
    let of_the_viewer = moments.iter().all(|m| apart(VIEWER_M, m.place_m, Vec2::ZERO));
    let others = || walks.present(frame).filter(|(walk, _)| !members.contains(walk));
    let of_others = others().all(|(_, other)| moments.iter().all(|m| apart(options.apart_m, m.place_m, other.place_m)));
    let inside = moments.iter().any(|m| is_within(&options.areas, m.place_m));
    of_each_other && of_the_viewer && of_others && inside
}

fn is_within(areas: &Areas, place_m: Vec2) -> bool {
    let [width, depth] = areas.played_m;
    let [rear_width, rear_depth] = areas.rear_m;
    let half = 0.5 * if place_m.y >= 0.0 { width } else { rear_width } + BEYOND_M;
    place_m.x.abs() <= half && place_m.y <= depth + BEYOND_M && place_m.y >= -rear_depth - BEYOND_M
}

impl UnitInterval {
    /// Overlap as a share of the shorter of two intervals; 0 without a member in both.
    pub(super) fn shares(&self, other: &UnitInterval) -> f64 {
        if !self.members.iter().any(|walk| other.members.contains(walk)) {
            return 0.0;
        }
        let common = self.to.min(other.to).saturating_sub(self.from.max(other.from));
        common as f64 / (self.to - self.from).min(other.to - other.from).max(1) as f64
    }

    /// Makes a unit of the interval.
    pub(super) fn unit(&self, walks: &SpotTracks, groups: &[u32], name: String, options: &CutOptions) -> Unit {
        let every = every(options);
        let mut deepest_m = 0.0f64;
        let mut members = Vec::new();
        for &walk in &self.members {
            let frames = (self.from..=self.to).step_by(every as usize);
            let samples: Vec<TrackSample> = frames
                .filter_map(|frame| {
                    let moment = walks.all[walk].at(frame)?;
                    let time_s = (frame - self.from) as f64 / FPS;
                    Some(TrackSample { time_s, place_m: moment.place_m, heading: moment.heading })
                })
                .collect();
            deepest_m = samples.iter().map(|sample| sample.place_m.y).fold(deepest_m, f64::max);
            members.push(Member { group: groups[walk], track: UnitTrack::new(samples) });
        }
        let [width_m, most_m] = options.areas.played_m;
        let depth_m = ((deepest_m * 2.0).ceil() * 0.5).clamp(AREA_DEPTHS_M[0].max(3.5).min(most_m), most_m);
        let start_s = self.from as f64 / FPS;
        Unit {
            name,
            description: format!("cut out of a motion at {start_s:.1} s"),
            viewer: UnitTrack::new(vec![TrackSample { time_s: 0.0, place_m: Vec2::ZERO, heading: vec2(0.0, 1.0) }]),
            area_m: [width_m, depth_m],
            duration_s: (self.to - self.from) as f64 / FPS,
            members,
        }
    }
}
