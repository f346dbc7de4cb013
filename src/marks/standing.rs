//! Whiles of standing: where people stand, and for how long.

use crate::math::Vec2;
use crate::patterns::Cause;

use super::Mark;

/// Longest while of one mark, seconds: a body sways and shifts.
const LONGEST_S: f64 = 5.0;
/// Distance from which standing goes on at another place, metres.
const AWAY_M: f64 = 0.12;
/// Breadth of a standing body's feet, metres.
const BREADTH_M: f32 = 0.3;

/// The while for which a person has stood so far.
#[derive(Debug, Default)]
pub(super) struct Standing {
    place_m: Vec2,
    /// Unit vector: where the body faced.
    facing: Vec2,
    stood_s: f64,
}

impl Standing {
    /// Adds the time stood in a tick; appends the while so far once it ends.
    pub fn pass(&mut self, place_m: Vec2, facing: Vec2, stood_s: f64, out: &mut Vec<Mark>) {
        let goes_on = stood_s > 0.0 && self.stood_s < LONGEST_S && self.place_m.distance(place_m) < AWAY_M;
        if !goes_on {
            self.end(out);
        }
        if stood_s > 0.0 {
            if self.stood_s == 0.0 {
                (self.place_m, self.facing) = (place_m, facing);
            }
            self.stood_s += stood_s;
        }
    }

    /// Appends the while so far, if the person stood.
    pub fn end(&mut self, out: &mut Vec<Mark>) {
        let stood_s = std::mem::take(&mut self.stood_s);
        if stood_s > 0.0 {
            out.push(Mark {
                cause: Cause::Sole,
                place_m: self.place_m,
                heading: self.facing.left(),
                mirrored: false,
                pattern: 0,
                length_m: BREADTH_M,
                smear_m: 0.0,
                twist_rad: 0.0,
                forefoot: 0.0,
                effort: 0.0,
                stood_s: stood_s as f32,
                wheel_m: 0.0,
                strength: 0.0,
                soil: 0.0,
                wet: 0.0,
                wear: 0,
                variation: 0,
            });
        }
    }
}
