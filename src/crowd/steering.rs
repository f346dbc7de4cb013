//! Where people want to go: the straightest way through the gates ahead.

use super::state::{Course, Traits};
use crate::math::{Vec2, vec2};
use crate::plan::FloorPlan;
use crate::routes::{Gate, Navigation, Place, Route, Way};
use crate::walls::Walls;

/// How far people look ahead along their way, metres and gates.
const LOOK_AHEAD_M: f64 = 10.0;
const GATES_AHEAD: usize = 8;
/// How far they check that the straight way is free, metres.
const SIGHT_M: f64 = 3.0;
/// From its favourite place across the way a person strays by up to this share of the room on either side, to cut
/// a corner or to walk straight. Nobody's favourite place then ends up at a wall, and lanes keep their order.
const STRAYING: f64 = 0.45;
/// Of a way's width at most this share on either side is left to the walls.
const MARGIN_SHARE: f64 = 0.2;
/// Gates are laid this far off the walls already, metres.
const GATE_MARGIN_M: f64 = 0.16;
/// A gate counts as passed by those who are this much nearer to the goal than it is, metres.
const PASSED_M: f64 = 1.0;
/// People who find themselves this much farther than the gate behind them look for their gate anew, metres.
const LOST_M: f64 = 2.5;
/// Following the distance field, people aim at the place that is this far down it, metres.
const FIELD_AIM_M: f64 = 1.2;

/// Without way made for so long, seconds, people follow the distance field.
const AT_A_LOSS_S: f64 = 3.0;
/// From this distance on people slow down towards the place where they stop, metres.
const EASING_M: f64 = 1.2;

/// A plan's routes with all that leads along them.
pub(super) struct Steering<'a> {
    pub(super) plan: &'a FloorPlan,
    pub(super) walls: &'a Walls,
    pub(super) routes: &'a [Route],
    pub(super) navigation: &'a Navigation,
}

impl Steering<'_> {
    fn way(&self, course: &Course) -> &Way {
        &self.navigation.ways[course.route as usize]
    }

    fn gates(&self, course: &Course) -> &[Gate] {
        &self.routes[course.route as usize].gates
    }

    /// Distance left on the leg that leads to a gate (the last leg behind the last gate), metres.
    fn left_on_leg(&self, course: &Course, gate: usize, p: Vec2) -> f64 {
        let way = self.way(course);
        let leg = way.gate_leg.get(gate).map_or(way.legs.len() - 1, |&l| l as usize);
        self.navigation.fields[way.legs[leg]].at(&self.navigation.ground, p)
    }

    /// Notes the gates that were passed, and how far the person has come.
    pub(super) fn advance(&self, course: &mut Course, p: Vec2, time_s: f64) {
        let gates = self.gates(course);
        let way = self.way(course);
        let mut gate = course.gate as usize;
        let mut left = self.left_on_leg(course, gate, p);
        while let Some(next) = gates.get(gate) {
            let (ahead, across) = place_at(next, p);
            let beside_m = (across - across.clamp(0.0, 1.0)).abs() * next.width_m();
            let of_gate = gate_distance(&way.gate_distance_m[gate], across);
            let near_goal = left < of_gate - PASSED_M;
            if !(ahead >= 0.0 && beside_m < 1.0 && (left - of_gate).abs() < 4.0 || near_goal) {
                break;
            }
            gate += 1;
            if way.gate_leg.get(gate) != way.gate_leg.get(gate - 1) {
                left = self.left_on_leg(course, gate, p);
            }
        }
        // Pushed or carried back behind earlier gates of this leg.
        let leg = way.gate_leg.get(gate).or(way.gate_leg.last());
        let behind_m = |g: usize| left - gate_distance(&way.gate_distance_m[g], place_at(&gates[g], p).1);
        let can_go_back = |g: usize| left.is_finite() && g > 0 && way.gate_leg.get(g - 1) == leg;
        if can_go_back(gate) && behind_m(gate - 1) > LOST_M {
            while can_go_back(gate) && behind_m(gate - 1) > 0.3 {
                gate -= 1;
            }
        }
        if left <= 0.0 && way.gate_leg.get(gate).is_none_or(|&l| l as usize + 1 == way.legs.len()) {
            gate = gates.len(); // there
        }
        course.gate = gate as u32;
        let legs_left = way.legs.len() - 1 - way.gate_leg.get(gate).map_or(way.legs.len() - 1, |&l| l as usize);
        // Legs ahead count for more than any plan is long, so that the sum falls at every turn.
        let total = (left + legs_left as f64 * 1e4) as f32;
        if total < course.least_left_m - 0.3 {
            course.least_left_m = total;
            course.improved_s = time_s;
        }
    }

    /// The unit vector in which the person wants to walk.
    pub(super) fn aim(&self, course: &Course, traits: &Traits, p: Vec2, last: Vec2, time_s: f64) -> Vec2 {
        let gates = self.gates(course);
        let next = (course.gate as usize).min(gates.len());
        let straight = match gates.get(next) {
            Some(_) => straightest(&gates[next..], traits, p),
            None => self.to_the_end(course, p, last),
        };
        let (direction, distance_m) = straight;
        // Who gets no farther on the straight way tries the sure one.
        let at_a_loss = time_s - course.improved_s > AT_A_LOSS_S && next < gates.len();
        let checked = p + direction * distance_m.min(SIGHT_M);
        let ground = &self.navigation.ground;
        // As near to walls as the person may come, but those who stand nearer already may walk on.
        let keep_m = f64::from(traits.wall_exclusion_m).min(ground.gap_limit_m(p));
        let margin_m = (0.9 * keep_m).min(ground.clearance_at_least_m(p)).max(0.08);
        if !at_a_loss && ground.is_free(self.walls, p, checked, margin_m) {
            return direction;
        }
        self.down_the_field(course, next, p).unwrap_or(last)
    }

    /// Direction of a place some way down the distance field, in sight.
    fn down_the_field(&self, course: &Course, gate: usize, p: Vec2) -> Option<Vec2> {
        let way = self.way(course);
        let leg = way.gate_leg.get(gate).map_or(way.legs.len() - 1, |&l| l as usize);
        let field = &self.navigation.fields[way.legs[leg]];
        let ground = &self.navigation.ground;
        let step = 0.15;
        let mut at = p;
        let mut aim = None;
        for _ in 0..(FIELD_AIM_M / step) as usize {
            let Some(down) = field.downhill(ground, at) else { break };
            at += down * step;
            if aim.is_some() && !ground.sight(self.walls, p, at) {
                break;
            }
            aim = (at - p).normalized().or(aim);
        }
        aim
    }

    /// Behind the last gate: out of the plan, or to the place where the person vanishes. Direction and distance.
    fn to_the_end(&self, course: &Course, p: Vec2, last: Vec2) -> (Vec2, f64) {
        match self.routes[course.route as usize].goal {
            Place::Opening(index) => (self.plan.openings.get(index).map_or(last, |o| o.side.outward()), 0.5),
            Place::Area(_) => ((course.end_m - p).normalized().unwrap_or(last), course.end_m.distance(p)),
        }
    }

    /// Share of the speed that the person wants: all of it on the way, less where the end is near.
    pub(super) fn pace(&self, course: &Course, p: Vec2) -> f32 {
        let at_the_end = course.gate as usize >= self.gates(course).len();
        match self.routes[course.route as usize].goal {
            Place::Area(_) if at_the_end => ((course.end_m.distance(p) / EASING_M) as f32).clamp(0.3, 1.0),
            _ => 1.0,
        }
    }

    /// Whether the person has arrived.
    pub(super) fn has_arrived(&self, course: &Course, p: Vec2, speed_m_s: f32, time_s: f64) -> bool {
        match self.routes[course.route as usize].goal {
            Place::Opening(index) => {
                let Some(opening) = self.plan.openings.get(index) else { return true };
                let way = self.way(course);
                let on_last_leg =
                    way.gate_leg.get(course.gate as usize).is_none_or(|&l| l as usize + 1 == way.legs.len());
                let along = (opening.to_m - opening.from_m) / opening.width_m().max(1e-9);
                let beside = !(0.0..=opening.width_m()).contains(&(p - opening.from_m).dot(along));
                on_last_leg && !beside && (p - opening.from_m).dot(opening.side.outward()) > course.end_m.x
            }
            Place::Area([min, max]) => {
                if course.gate as usize + 1 < self.gates(course).len() {
                    return false;
                }
                let inside = p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
                let at_place = p.distance(course.end_m) < 0.4;
                // Where others or a chair stand in the way, being there is enough.
                let hindered = speed_m_s < 0.15 || time_s - course.improved_s > AT_A_LOSS_S;
                at_place || inside && hindered
            }
        }
    }
}

/// Where a point lies relative to a gate: metres behind it (ahead of those who come), and the share across, 0 at the
/// left end.
fn place_at(gate: &Gate, p: Vec2) -> (f64, f64) {
    let across = gate.right_m - gate.left_m;
    let squared = across.length_squared();
    if squared < 1e-9 {
        return (0.0, 0.5);
    }
    let ahead = across.left();
    ((p - gate.left_m).dot(ahead) / squared.sqrt(), (p - gate.left_m).dot(across) / squared)
}

/// A gate's distance from the goal at a share of its width.
fn gate_distance([left, middle, right]: &[f32; 3], across: f64) -> f64 {
    let across = across.clamp(0.0, 1.0) as f32;
    f64::from(if across < 0.5 {
        left + (middle - left) * 2.0 * across
    } else {
        middle + (right - middle) * (2.0 * across - 1.0)
    })
}

/// The part of a gate that a person uses: both ends, and the favourite place.
pub(super) fn used(gate: &Gate, traits: &Traits) -> (Vec2, Vec2, Vec2) {
    let keep_m = (f64::from(traits.wall_acceptable_m) - GATE_MARGIN_M).max(0.0);
    let margin = (keep_m / gate.width_m().max(0.01)).min(MARGIN_SHARE);
    let share = margin + f64::from(traits.lane) * (1.0 - 2.0 * margin);
    let left = share - STRAYING * (share - margin);
    let right = share + STRAYING * (1.0 - margin - share);
    (gate.at(left), gate.at(right), gate.at(share))
}

/// Direction of the straightest way through the parts of gates that the person uses, and the distance for which it
/// is straight.
///
/// The visible cone is narrowed gate by gate, as in the funnel algorithm (Lee and Preparata 1984, doi
/// 10.1002/net.3230140304). Where the next gate lies beside the cone, the way bends at the cone's border; where
/// none does, it leads to the favourite place at the farthest gate, as far as the cone allows.
fn straightest(gates: &[Gate], traits: &Traits, p: Vec2) -> (Vec2, f64) {
    let (left, right, middle) = used(&gates[0], traits);
    let mut cone = (left - p, right - p);
    let mut target = middle - p;
    for gate in gates.iter().take(GATES_AHEAD).skip(1) {
        let (left, right, middle) = used(gate, traits);
        let (left, right) = (left - p, right - p);
        if cone.0.cross(right) > 0.0 && cone.0.dot(right) > 0.0 {
            return direction_to(cone.0, target);
        }
        if cone.1.cross(left) < 0.0 && cone.1.dot(left) > 0.0 {
            return direction_to(cone.1, target);
        }
        if middle.distance(p) > LOOK_AHEAD_M || target.dot(middle - p) < 0.0 {
            break;
        }
        if cone.0.cross(left) < 0.0 {
            cone.0 = left;
        }
        if cone.1.cross(right) > 0.0 {
            cone.1 = right;
        }
        target = middle - p;
    }
    if cone.0.cross(target) > 0.0 && cone.0.dot(target) > 0.0 {
        return direction_to(cone.0, target);
    }
    if cone.1.cross(target) < 0.0 && cone.1.dot(target) > 0.0 {
        return direction_to(cone.1, target);
    }
    direction_to(target, target)
}

fn direction_to(way: Vec2, otherwise: Vec2) -> (Vec2, f64) {
    match way.normalized() {
        Some(unit) if way.length() > 0.1 => (unit, way.length()),
        _ => (otherwise.normalized().unwrap_or(vec2(1.0, 0.0)), 0.1),
    }
}
