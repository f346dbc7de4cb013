use rayon::prelude::*;

use super::body::FormationBody;
use super::encounters::first_offsets;
use super::nearby::{BodiesAtMoment, BodyPair};
use super::settings::AvoidanceSettings;
use super::settle::settle;
use super::smooth::Smoother;
use super::tracks::{BodyTracks, SWEEPS, any_direction};
use crate::formation::FormationError;
use crate::math::Vec2;
use crate::progress::Progress;

/// Range of the push, as a multiple of the distance at which bodies overlap.
const PUSH_REACH: f64 = 2.5;
/// Rounds of the search: the extra room, as a share of the kept distance, and the weight of accelerations.
///
/// The second round allows harder accelerations, which dense crowds need.
const ROUNDS: [[f64; 2]; 2] = [[0.04, 1.0], [0.08, 0.15]];
/// Steps of the search in each round.
const STEPS: usize = 40;
/// Least steps of a round.
const LEAST_STEPS: usize = 16;
/// Penalty weight that ties paths to clear positions, relative to the spring.
const TIE: f64 = 3.0;
/// Extra weight of the spring at a key formation, and the time around it for which it acts, seconds.
const KEY_HOLD: f64 = 8.0;
const KEY_HOLD_S: f64 = 0.6;
/// Distance that bodies may move until neighbours are searched again, metres.
const SKIN_M: f64 = 0.3;

/// Moves bodies so that they do not overlap at any moment.
///
/// A spring holds each body to its position without the others, the more firmly the nearer a key formation is in time. Neighbours push each other with a force in inverse proportion to their distance (Kamphuis, Overmars 2004,
/// *Finding paths for coherent groups using clearance*), which ends at 2.5 times the distance at which bodies would
/// overlap. Offsets are optimised over the whole time together, so that accelerations are small:
///
/// ```text
/// minimise  sum over t of  s(t) |x|^2 / 2 - f(t) . x + a |x''|^2 / 2   where no two bodies overlap
/// ```
///
/// by the alternating direction method of multipliers (Boyd et al. 2011, doi 10.1561/2200000016): in turn each body's best
/// path over time, and each frame's nearest positions without overlap. If that fails, as in dense crowds that pass through
/// each other, bodies are led apart step by step without the spring, early and gently. Bodies are never moved more suddenly
/// than people stagger: they overlap instead, and a warning says where and when.
///
/// # Errors
/// [`FormationError::Interrupted`].
pub(in super::super) fn keep_clear(
    avoidance: &AvoidanceSettings,
    bodies: &mut [FormationBody],
    progress: &dyn Progress,
) -> Result<(), FormationError> {
    if !avoidance.on || bodies.len() < 2 {
        return Ok(());
    }
    let crowd = BodyTracks::of(bodies);
    let none = vec![Vec2::ZERO; crowd.places.len()];
    let too_near = crowd.pairs(&none, 0.0);
    let nobody_is_near = too_near.iter().all(Vec::is_empty);
    if nobody_is_near && (avoidance.push <= 0.0 || crowd.pairs(&none, push_gap_m(&crowd)).iter().all(Vec::is_empty)) {
        return Ok(());
    }
    let start = first_offsets(&crowd, &too_near, avoidance.fps, avoidance.seconds);
    drop((none, too_near));
    let mut search = OffsetSearch::new(avoidance, &crowd, start);
    for [margin, stiffness] in ROUNDS {
        search.begin(stiffness);
        if search.run(margin, progress)? {
            break;
        }
    }
    let offsets = settle(&crowd, search.ways, avoidance, progress)?;
    let width = bodies.len();
    for (k, body) in bodies.iter_mut().enumerate() {
        body.places.iter_mut().enumerate().for_each(|(moment, place)| *place += offsets[moment * width + k]);
    }
    Ok(())
}

/// Largest gap, edge to edge, over which bodies push each other, metres.
fn push_gap_m(crowd: &BodyTracks<'_>) -> f64 {
    // Bodies of several people keep a person's distance around themselves, so the smallest one counts.
    let smallest_m = crowd.reaches_m.iter().copied().fold(f64::INFINITY, f64::min);
    (PUSH_REACH - 1.0) * 2.0 * smallest_m
}

/// The state of the search for offsets.
struct OffsetSearch<'c> {
    crowd: &'c BodyTracks<'c>,
    push: f64,
    /// Gap over which neighbours push each other, and the distance that it stands for, metres.
    push_gap_m: f64,
    /// Weight of the spring in each frame, and of accelerations.
    hold: Vec<f64>,
    bend: f64,
    smoother: Smoother,
    /// Best offsets over time.
    ways: Vec<Vec2>,
    /// Offsets without overlap, frame by frame.
    clear: Vec<Vec2>,
    /// Accumulated difference of the two (scaled dual variable).
    strain: Vec<Vec2>,
    /// Pairs that may come near, frame by frame, and the offsets for which they were searched.
    near: Vec<Vec<BodyPair>>,
    looked_at: Vec<Vec2>,
}

impl<'c> OffsetSearch<'c> {
    fn new(avoidance: &AvoidanceSettings, crowd: &'c BodyTracks<'c>, start: Vec<Vec2>) -> OffsetSearch<'c> {
        let hold: Vec<f64> = (0..crowd.moments())
            .map(|moment| {
                let from_key = |&key: &usize| (moment as f64 - key as f64).abs() / avoidance.fps / KEY_HOLD_S;
                let nearest = avoidance.keys.iter().map(from_key).fold(f64::INFINITY, f64::min);
                let near = (1.0 - nearest * nearest).max(0.0);
                1.0 + KEY_HOLD * near * near + TIE
            })
            .collect();
        // The response to a single push falls to a third within half the time of stepping aside.
        let moments = avoidance.seconds / 2.0 * avoidance.fps;
        let bend = (1.0 + TIE) * moments * moments * moments * moments;
        let smoother = Smoother::new(&hold, bend);
        let near = crowd.pairs(&start, push_gap_m(crowd) + SKIN_M);
        OffsetSearch {
            crowd,
            push: avoidance.push,
            push_gap_m: push_gap_m(crowd),
            hold,
            bend,
            smoother,
            clear: start.clone(),
            strain: vec![Vec2::ZERO; start.len()],
            looked_at: start.clone(),
            ways: start,
            near,
        }
    }

    /// Starts a round with a share of the weight of accelerations, from the offsets found so far.
    fn begin(&mut self, stiffness: f64) {
        self.smoother = Smoother::new(&self.hold, self.bend * stiffness);
        self.strain.fill(Vec2::ZERO);
    }

    /// Searches until bodies do not overlap; returns whether that was reached.
    fn run(&mut self, margin: f64, progress: &dyn Progress) -> Result<bool, FormationError> {
        for step in 0..STEPS {
            progress.keep_on()?;
            self.find_clear_places(margin);
            self.find_ways();
            self.look_around();
            // Before that, pushes and springs are hardly in balance.
            if step >= LEAST_STEPS && self.is_clear() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Finds the offsets without overlap nearest to the best offsets and the dual variable, in each frame.
    fn find_clear_places(&mut self, margin: f64) {
        let OffsetSearch { crowd, ways, clear, strain, near, .. } = self;
        let width = crowd.bodies;
        let each = clear.par_chunks_mut(width).zip(strain.par_chunks_mut(width)).zip(&*near).enumerate();
        each.for_each(|(moment, ((clear, strain), near))| {
            let here = crowd.moment(moment);
            let ways = &ways[moment * width..(moment + 1) * width];
            for k in 0..width {
                clear[k] = ways[k] + strain[k];
            }
            let sides = sides(here, ways, near, margin);
            for _ in 0..SWEEPS {
                let moved = sides.iter().filter(|side| side.part(clear)).count();
                if moved == 0 {
                    break;
                }
            }
            for k in 0..width {
                strain[k] += ways[k] - clear[k];
            }
        });
    }

    /// Finds the best offsets near the clear ones, held by the spring and pushed by neighbours.
    fn find_ways(&mut self) {
        let OffsetSearch { crowd, ways, clear, strain, near, push, push_gap_m, smoother, .. } = self;
        let width = crowd.bodies;
        let each = ways.par_chunks_mut(width).zip(&*near).enumerate();
        each.for_each(|(moment, (ways, near))| {
            let here = crowd.moment(moment);
            let range = moment * width..(moment + 1) * width;
            let (clear, strain) = (&clear[range.clone()], &strain[range]);
            let mut forces = vec![Vec2::ZERO; width];
            for &[a, b] in near {
                let [a, b] = [a as usize, b as usize];
                let apart = here.places[a] + ways[a] - here.places[b] - ways[b];
                let length_m = apart.length();
                let gap_m = length_m - here.reaches_m[a] - here.reaches_m[b];
                if gap_m < *push_gap_m && length_m > 1e-9 {
                    // The force between two people with this gap between their bodies.
                    let own_m = *push_gap_m / (PUSH_REACH - 1.0);
                    let distance_m = (own_m + gap_m).max(own_m / 2.0);
                    let force = *push * (1.0 / distance_m - 1.0 / (own_m * PUSH_REACH));
                    forces[a] += apart * (force / length_m);
                    forces[b] -= apart * (force / length_m);
                }
            }
            for k in 0..width {
                ways[k] = (clear[k] - strain[k]) * TIE + forces[k];
            }
        });
        smoother.solve(ways, width);
    }

    /// Searches neighbours again if a body has moved far.
    fn look_around(&mut self) {
        let moved = self.ways.iter().zip(&self.looked_at);
        let farthest = moved.map(|(way, before)| (*way - *before).length_squared()).fold(0.0, f64::max);
        if farthest > SKIN_M * SKIN_M / 4.0 {
            self.near = self.crowd.pairs(&self.ways, self.push_gap_m + SKIN_M);
            self.looked_at.clone_from(&self.ways);
        }
    }

    fn is_clear(&self) -> bool {
        let crowd = self.crowd;
        self.near.par_iter().enumerate().all(|(moment, near)| {
            let here = crowd.moment(moment);
            let ways = &self.ways[moment * crowd.bodies..(moment + 1) * crowd.bodies];
            near.iter().all(|&[a, b]| {
                let apart = here.places[a as usize] + ways[a as usize] - here.places[b as usize] - ways[b as usize];
                let keep_m = here.reaches_m[a as usize] + here.reaches_m[b as usize];
                apart.length_squared() >= keep_m * keep_m
            })
        })
    }
}

/// The half plane in which a pair of bodies does not overlap.
struct SeparatingLine {
    pair: [usize; 2],
    direction: Vec2,
    /// Least difference of the offsets in that direction, metres.
    least_m: f64,
}

/// The half planes of pairs with these offsets.
///
/// Pairs stay on their side: moved the shortest way, two bodies that are led past each other would keep changing sides.
fn sides(here: BodiesAtMoment<'_>, ways: &[Vec2], near: &[BodyPair], margin: f64) -> Vec<SeparatingLine> {
    let side = |&[a, b]: &BodyPair| {
        let pair = [a as usize, b as usize];
        let own = here.places[pair[0]] - here.places[pair[1]];
        let apart = own + ways[pair[0]] - ways[pair[1]];
        let keep_m = (here.reaches_m[pair[0]] + here.reaches_m[pair[1]]) * (1.0 + margin);
        let direction = if apart.length() > 1e-9 { apart / apart.length() } else { any_direction(a, b) };
        SeparatingLine { pair, direction, least_m: keep_m - own.dot(direction) }
    };
    near.iter().map(side).collect()
}

impl SeparatingLine {
    /// Moves the offsets of both bodies apart by the same amount; returns whether that was needed.
    fn part(&self, offsets: &mut [Vec2]) -> bool {
        let [a, b] = self.pair;
        let missing_m = self.least_m - (offsets[a] - offsets[b]).dot(self.direction);
        if missing_m <= 0.0 {
            return false;
        }
        offsets[a] += self.direction * (missing_m / 2.0);
        offsets[b] -= self.direction * (missing_m / 2.0);
        true
    }
}
