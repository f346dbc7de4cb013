use super::walks::{FPS, SpotTrack, SpotTracks};
use crate::math::DisjointSets;

/// Members of a group are mostly this near, metres, ...
const NEAR_M: f64 = 1.6;
/// ... at velocities that differ by less, metres per second, ...
const ALIKE_M_S: f64 = 0.45;
/// ... for this share of the time that both are seen, ...
const LEAST_SHARE: f64 = 0.8;
/// ... which is at least so long, seconds, ...
const LEAST_S: f64 = 3.0;
/// ... and never farther apart, metres.
const FARTHEST_M: f64 = 4.0;

/// The group number of each track: people who are linked, directly or through others, share one.
///
/// Two people are linked if they are mostly near each other at the same velocity while both are seen, as Moussaid et al. 2010
/// (doi 10.1371/journal.pone.0010047) describe groups: side by side, about 0.8 m apart, at one speed.
pub(super) fn groups(walks: &SpotTracks) -> Vec<u32> {
    let count = walks.all.len();
    let mut linked = DisjointSets::new(count);
    // Sorted by the first frame: a person who comes after the last one left meets no one.
    for a in 0..count {
        for b in a + 1..count {
            if walks.all[b].first > walks.all[a].last() {
                break;
            }
            if walks.all[a].id != walks.all[b].id && together(&walks.all[a], &walks.all[b]) {
                linked.join(a, b);
            }
        }
    }
    (0..count).map(|walk| linked.least(walk) as u32).collect()
}

fn together(a: &SpotTrack, b: &SpotTrack) -> bool {
    let (from, to) = (a.first.max(b.first), a.last().min(b.last()));
    let (mut seen, mut near) = (0u32, 0u32);
    for frame in from..=to {
        let (Some(one), Some(other)) = (a.at(frame), b.at(frame)) else { continue };
        let apart_m = one.place_m.distance(other.place_m);
        if apart_m > FARTHEST_M {
            return false;
        }
        seen += 1;
        near += u32::from(apart_m < NEAR_M && one.velocity_m_s.distance(other.velocity_m_s) < ALIKE_M_S);
    }
    f64::from(seen) >= LEAST_S * FPS && f64::from(near) >= LEAST_SHARE * f64::from(seen)
}
