use super::Surface;
use super::line::Line;
use super::spots::{self, Spread};
use super::visit::StopTally;
use crate::math::Vec2;
use crate::routes::{Field, Flow, Stop, StopKind};

/// How far to the side, and back, people leave a counter before they turn to go on, metres.
const ASIDE_M: f64 = 0.95;
const BACK_M: f64 = 0.3;
/// How far beyond a ticket gate, and before a bench, people are on their way again, metres.
const BEYOND_GATE_M: [f64; 3] = [2.2, 1.4, 0.7];
const FROM_BENCH_M: f64 = 0.8;
/// Somebody who stands within this of the way out is worth a detour of so much, metres.
const IN_THE_WAY_M: f64 = 0.7;
const DETOUR_M: f64 = 2.0;

/// A stop with who is there.
#[derive(Debug)]
pub(super) struct Post {
    pub(super) stop: Stop,
    /// Walking distance to it.
    pub(super) field: Field,
    /// How people spread over the ways there.
    pub(super) flow: Flow,
    pub(super) kind: Kind,
    pub(super) tally: StopTally,
}

/// How people are served at a stop.
#[derive(Debug)]
pub(super) enum Kind {
    /// Everybody finds a spot.
    Spread(Spread),
    /// One after the other.
    Lines(Vec<Line>),
}

impl Post {
    /// A stop that people come to from these cells.
    pub(super) fn new(surface: Surface<'_>, stop: &Stop, starts: &[usize], keep_m: f64) -> Post {
        let place = |&p: &Vec2| {
            let place_m = spots::off_walls(surface, p, keep_m);
            (place_m, stop.facing_from(place_m))
        };
        let kind = match stop.kind {
            StopKind::Place | StopKind::Bench => Kind::Spread(Spread::new(surface, stop, keep_m)),
            StopKind::Queue | StopKind::Machine => {
                Kind::Lines(vec![Line::new(stop.places_m.iter().map(place), stop.spacing_m)])
            }
            StopKind::Gate => {
                let lane = |p: &Vec2| Line::new([place(p)].into_iter(), stop.spacing_m);
                Kind::Lines(stop.places_m.iter().map(lane).collect())
            }
        };
        let field = Field::to(surface.ground, &stop.cells(surface.ground));
        Post {
            stop: stop.clone(),
            flow: Flow::new(surface.ground, starts, &field),
            field,
            kind,
            tally: StopTally { name: stop.name.clone(), in_line: stop.kind.has_line(), ..StopTally::default() },
        }
    }

    /// How far from the stop itself people may be at it, metres.
    pub(super) fn reach_m(&self) -> f64 {
        match &self.kind {
            Kind::Spread(spread) => spread.reach_m(),
            Kind::Lines(lines) => lines.iter().map(Line::reach_m).fold(0.0, f64::max),
        }
    }

    /// Somebody is not there any more.
    pub(super) fn forget(&mut self, id: u32) {
        match &mut self.kind {
            Kind::Spread(spread) => spread.leave(id),
            Kind::Lines(lines) => lines.iter_mut().for_each(|line| line.forget(id)),
        }
    }

    /// Where somebody at `p` goes first who leaves the stop and then goes down the field `onward`: aside of the line,
    /// through the gate, up from the bench. `None` if they just go.
    pub(super) fn way_out(&self, surface: Surface<'_>, p: Vec2, onward: &Field, others: &[Vec2]) -> Option<Vec2> {
        let facing = self.stop.facing_from(p);
        let free = |to: &Vec2| surface.ground.is_free(surface.walls, p, *to, 0.17);
        match self.stop.kind {
            StopKind::Place => None,
            StopKind::Bench => Some(p + facing * FROM_BENCH_M).filter(free),
            StopKind::Gate => BEYOND_GATE_M.map(|beyond_m| p + facing * beyond_m).into_iter().find(free),
            StopKind::Queue | StopKind::Machine => {
                let cost = |to: &Vec2| {
                    let crowded = others.iter().filter(|other| other.distance(*to) < IN_THE_WAY_M).count();
                    let way_m = onward.at(surface.ground, *to);
                    if way_m.is_finite() { way_m + DETOUR_M * crowded as f64 } else { 1e9 }
                };
                let sides = [-1.0, 1.0].map(|side| p + facing.left() * (side * ASIDE_M) - facing * BACK_M);
                sides.into_iter().filter(free).min_by(|a, b| cost(a).total_cmp(&cost(b)))
            }
        }
    }
}

/// Lays the lines of all stops, each clear of all counters and of the lines before it.
pub(super) fn lay_lines(surface: Surface<'_>, posts: &mut [Post]) {
    for index in 0..posts.len() {
        let Kind::Lines(lines) = &posts[index].kind else { continue };
        for number in 0..lines.len() {
            let taken: Vec<Vec2> = posts
                .iter()
                .enumerate()
                .flat_map(|(other, post)| match &post.kind {
                    Kind::Lines(lines) => lines.iter().enumerate().map(|line| (other, line)).collect(),
                    Kind::Spread(_) => Vec::new(),
                })
                .filter(|&(other, (line, _))| (other, line) != (index, number))
                .flat_map(|(_, (_, line))| line.footprint())
                .collect();
            let Post { stop, kind, .. } = &mut posts[index];
            if let Kind::Lines(lines) = kind {
                lines[number].lay(surface, stop, &taken);
            }
        }
    }
}
