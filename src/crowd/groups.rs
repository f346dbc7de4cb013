//! Groups of people who walk together, drawn before the walk begins, like the arrivals.

use std::ops::Range;

use rand::RngExt;

use super::GroupOptions;
use super::arrivals::Arrival;
use crate::math::{Purpose, person_stream};
use crate::routes::{Route, Timetable, TimetableKind};

/// Interval within which people of a list of times may come together, seconds.
const LISTED_TOGETHER_S: f64 = 5.0;

/// Groups of all people. The members of a group have consecutive ids.
#[derive(Debug, Default)]
pub(super) struct Groups {
    /// For each id the first of its group; empty if everybody is alone.
    first: Vec<u32>,
}

impl Groups {
    /// Draws groups for a list of arrivals, and numbers the people in the order of arrival.
    ///
    /// Consecutive people of a route become a group and come together, when the first of them does. Their number, by route
    /// and by burst, stays as it was.
    pub(super) fn draw(
        arrivals: &mut Vec<Arrival>,
        routes: &[Route],
        timetable: &Timetable,
        options: &GroupOptions,
        seed: u64,
    ) -> Groups {
        let mut of_route: Vec<Vec<u32>> = vec![Vec::new(); routes.len()];
        for arrival in arrivals.iter() {
            of_route[arrival.route].push(arrival.id);
        }
        // Time, members by the ids so far, and route of each group.
        let mut groups: Vec<(f64, Range<usize>, usize)> = Vec::new();
        for (index, (route, ids)) in routes.iter().zip(&of_route).enumerate() {
            let apart_s = apart_s(route.arrivals.as_ref().unwrap_or(timetable));
            let mut from = 0;
            while let Some(&id) = ids.get(from) {
                let time_s = arrivals[id as usize].time_s;
                let most = size(&options.shares, person_stream(seed, id, Purpose::Groups).random());
                let together = |id: &&u32| arrivals[**id as usize].time_s - time_s <= apart_s;
                let size = ids[from..].iter().take(most).take_while(together).count();
                groups.push((time_s, from..from + size, index));
                from += size;
            }
        }
        groups.sort_by(|a, b| a.0.total_cmp(&b.0).then(of_route[a.2][a.1.start].cmp(&of_route[b.2][b.1.start])));
        let (mut first, mut list) = (Vec::with_capacity(arrivals.len()), Vec::with_capacity(arrivals.len()));
        for (time_s, members, route) in groups {
            let first_id = list.len() as u32;
            for &before in &of_route[route][members] {
                list.push(Arrival { id: list.len() as u32, time_s, ..arrivals[before as usize] });
                first.push(first_id);
            }
        }
        *arrivals = list;
        Groups { first }
    }

    /// Ids of all members of a person's group, the person included.
    pub(super) fn members(&self, id: u32) -> Range<u32> {
        let Some(&first) = self.first.get(id as usize) else { return id..id.saturating_add(1) };
        let size = self.first[first as usize..].iter().take_while(|&&other| other == first).count();
        first..first + size as u32
    }

    /// Id of the first member of a person's group.
    pub(super) fn first(&self, id: u32) -> u32 {
        self.first.get(id as usize).copied().unwrap_or(id)
    }
}

/// Longest time between the arrivals of the first and another member of a group, seconds.
fn apart_s(timetable: &Timetable) -> f64 {
    match timetable.kind {
        TimetableKind::Rate => f64::INFINITY,
        TimetableKind::Bursts => timetable.spread_s.unwrap_or(0.0),
        TimetableKind::List => LISTED_TOGETHER_S,
    }
}

/// Size of a group for a draw in `[0, 1)`.
fn size(shares: &[f64; 4], draw: f64) -> usize {
    let total: f64 = shares.iter().sum();
    let mut sum = 0.0;
    let found = shares.iter().position(|share| {
        sum += share;
        draw * total < sum
    });
    found.unwrap_or(shares.len() - 1) + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_falls_on_a_size_by_its_share() {
        let shares = [2.0, 1.0, 0.0, 1.0];
        assert_eq!([0.0, 0.49, 0.5, 0.74, 0.76, 0.999].map(|draw| size(&shares, draw)), [1, 1, 2, 2, 4, 4]);
        assert_eq!(size(&[0.0, 0.0, 1.0, 0.0], 0.5), 3);
    }

    #[test]
    fn without_groups_everybody_is_alone() {
        assert_eq!(Groups::default().members(7), 7..8);
        assert_eq!(Groups::default().members(u32::MAX), u32::MAX..u32::MAX);
        assert_eq!(Groups::default().first(7), 7);
    }

    #[test]
    fn members_follow_each_other() {
        let groups = Groups { first: vec![0, 1, 1, 3, 3, 3] };
        assert_eq!([0, 1, 2, 3, 5].map(|id| groups.members(id)), [0..1, 1..3, 1..3, 3..6, 3..6]);
        assert_eq!(groups.first(5), 3);
    }
}
