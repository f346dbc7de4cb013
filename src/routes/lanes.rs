//! Ways along the lanes that a building's drawing has.

use super::Place;
use super::draft::RouteDraft;
use super::ground::Ground;
use crate::math::{Vec2, vec2};
use crate::plan::FloorPlan;

/// Ends of lanes within this are one crossing, metres.
const SAME_M: f64 = 0.05;
/// Largest distance of floor to walk on from a crossing, and half side of the square that leads people there, metres.
const NEAR_M: f64 = 0.5;
const REACH_M: f64 = 0.6;
/// Most ends of lanes between which people go, and most crossings that a way names.
const MOST_ENDS: usize = 12;
const MOST_VIA: usize = 8;

/// A crossing, or an end of a lane, on the ground.
struct Node {
    at_m: Vec2,
    place: Option<(Place, u16)>,
    beside: Vec<usize>,
}

/// Ways from each end of the lanes to another, along them, with equal shares; empty without lanes.
///
/// Lanes are taken in both directions: those that say one way are meant for robots.
pub(super) fn drafts(plan: &FloorPlan, ground: &Ground) -> Vec<RouteDraft> {
    let nodes = nodes(plan, ground);
    let ends: Vec<usize> =
        (0..nodes.len()).filter(|&k| nodes[k].beside.len() == 1 && nodes[k].place.is_some()).collect();
    let every = ends.len().div_ceil(MOST_ENDS).max(1);
    let ends: Vec<usize> = ends.into_iter().step_by(every).collect();
    let half = (ends.len() / 2).max(1);
    let pairs = (0..ends.len()).map(|k| (k, (k + half) % ends.len())).filter(|(from, to)| from != to);
    let draft = |(from, to): (usize, usize)| {
        let path = shortest(&nodes, ends[from], ends[to])?;
        let (start, part) = nodes[ends[from]].place?;
        let (goal, _) = nodes[ends[to]].place.filter(|place| place.1 == part)?;
        let inner = &path[1..path.len() - 1];
        let every = inner.len().div_ceil(MOST_VIA).max(1);
        let on_ground = |&node: &usize| nodes[node].place.filter(|place| place.1 == part).map(|place| place.0);
        let via: Vec<Place> = inner.iter().step_by(every).filter_map(on_ground).collect();
        let names = [from, to].map(|k| format!("lane {}", k + 1));
        let of_via = (0..via.len()).map(|k| format!("crossing {}", k + 1));
        Some(RouteDraft {
            name: names.join(" to "),
            place_names: [names[0].clone()].into_iter().chain(of_via).chain([names[1].clone()]).collect(),
            start,
            via,
            stops: Vec::new(),
            arrivals: None,
            life: None,
            goal,
            share: 1.0,
        })
    };
    pairs.filter_map(draft).collect()
}

fn nodes(plan: &FloorPlan, ground: &Ground) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut node_at = |p: Vec2| {
        if let Some(known) = nodes.iter().position(|node: &Node| node.at_m.distance(p) <= SAME_M) {
            return known;
        }
        let place = ground.walkable_near(p, NEAR_M).map(|cell| {
            let (middle, reach) = (ground.lattice.centre(cell), vec2(REACH_M, REACH_M));
            (Place::Area([middle - reach, middle + reach]), ground.part(cell))
        });
        nodes.push(Node { at_m: p, place, beside: Vec::new() });
        nodes.len() - 1
    };
    let lanes = plan.drawn.iter().flat_map(|drawn| &drawn.lanes);
    let ends: Vec<[usize; 2]> = lanes.map(|lane| lane.map(&mut node_at)).collect();
    for [a, b] in ends {
        if a != b && !nodes[a].beside.contains(&b) {
            nodes[a].beside.push(b);
            nodes[b].beside.push(a);
        }
    }
    nodes
}

/// The shortest way along lanes (Dijkstra); `None` if there is none.
fn shortest(nodes: &[Node], from: usize, to: usize) -> Option<Vec<usize>> {
    let mut far_m = vec![f64::INFINITY; nodes.len()];
    let mut before = vec![from; nodes.len()];
    let mut is_open = vec![true; nodes.len()];
    far_m[from] = 0.0;
    loop {
        let reached = (0..nodes.len()).filter(|&k| is_open[k] && far_m[k].is_finite());
        let next = reached.min_by(|&a, &b| far_m[a].total_cmp(&far_m[b]))?;
        if next == to {
            break;
        }
        is_open[next] = false;
        for &beside in &nodes[next].beside {
            let through_m = far_m[next] + nodes[next].at_m.distance(nodes[beside].at_m);
            if through_m < far_m[beside] {
                (far_m[beside], before[beside]) = (through_m, next);
            }
        }
    }
    let mut path = vec![to];
    while path[path.len() - 1] != from {
        path.push(before[path[path.len() - 1]]);
    }
    path.reverse();
    Some(path)
}
