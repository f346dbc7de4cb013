use rayon::prelude::*;

use super::body::FormationBody;
use super::nearby::{BodiesAtMoment, BodyPair, pairs_within};
use crate::math::{Vec2, sin_cos, vec2};

/// Sweeps over overlapping pairs in a step.
pub(super) const SWEEPS: usize = 4;

/// Positions and radii of all bodies over time, frame by frame.
pub(super) struct BodyTracks<'b> {
    pub bodies: usize,
    pub places: Vec<Vec2>,
    pub reaches_m: Vec<f64>,
    all: &'b [FormationBody],
}

impl<'b> BodyTracks<'b> {
    pub fn of(all: &'b [FormationBody]) -> BodyTracks<'b> {
        let moments = all.first().map_or(0, |body| body.places.len());
        let each = || (0..moments).flat_map(|moment| all.iter().map(move |body| (moment, body)));
        let places = each().map(|(moment, body)| body.places[moment]).collect();
        let reaches_m = each().map(|(moment, body)| body.reach_m(moment)).collect();
        BodyTracks { bodies: all.len(), places, reaches_m, all }
    }

    pub fn moments(&self) -> usize {
        self.all.first().map_or(0, |body| body.places.len())
    }

    pub fn at(&self, moment: usize, body: u32) -> Vec2 {
        self.places[moment * self.bodies + body as usize]
    }

    /// Distance at which the centres of two bodies are kept, metres.
    pub fn keep_m(&self, moment: usize, [a, b]: BodyPair) -> f64 {
        let at = |body: u32| self.reaches_m[moment * self.bodies + body as usize];
        at(a) + at(b)
    }

    pub fn moment(&self, moment: usize) -> BodiesAtMoment<'_> {
        let range = moment * self.bodies..(moment + 1) * self.bodies;
        BodiesAtMoment { places: &self.places[range.clone()], reaches_m: &self.reaches_m[range] }
    }

    /// Positions in a frame moved by offsets, which are given for all frames.
    pub fn moved(&self, moment: usize, offsets: &[Vec2]) -> Vec<Vec2> {
        let offsets = &offsets[moment * self.bodies..(moment + 1) * self.bodies];
        self.moment(moment).places.iter().zip(offsets).map(|(&place, &offset)| place + offset).collect()
    }

    /// Pairs of moved bodies within a gap, edge to edge, frame by frame.
    pub fn pairs(&self, offsets: &[Vec2], gap_m: f64) -> Vec<Vec<BodyPair>> {
        let of = |moment: usize| {
            let places = self.moved(moment, offsets);
            pairs_within(BodiesAtMoment { places: &places, reaches_m: self.moment(moment).reaches_m }, gap_m)
        };
        (0..self.moments()).into_par_iter().map(of).collect()
    }
}

/// Direction in which two bodies at one position part: a fixed one for each pair.
pub(super) fn any_direction(a: u32, b: u32) -> Vec2 {
    const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;
    let (sin, cos) = sin_cos(GOLDEN_ANGLE_RAD * (f64::from(a) * 7.0 + f64::from(b)));
    vec2(cos, sin)
}
