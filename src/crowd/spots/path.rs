use crate::math::Vec2;
use crate::units::{SpotFrame, TrackState, Unit};

/// Least and largest time to move over to a part, seconds, and the steps in between.
const MOVE_OVER_S: [f64; 3] = [0.8, 4.4, 0.3];
/// Largest acceleration while moving over, metres per second squared.
pub(super) const MOST_M_S2: f64 = 2.8;
/// Largest speed while moving over, metres per second, unless the part is faster.
const MOST_M_S: f64 = 1.9;
/// Largest excess over the speed of the part, metres per second.
const MOST_FASTER_M_S: f64 = 0.6;
/// Largest speed of stepping back, metres per second.
const MOST_BACK_M_S: f64 = 0.3;
/// Interval at which paths are checked, seconds.
pub(super) const LOOK_S: f64 = 0.1;
/// Largest angular velocity of a body, radians per second, as in the crowd.
const FASTEST_TURN_RAD_S: f64 = 2.4;
/// Speed from which on a body turns along with its path, metres per second; below half of it, the part alone counts.
const FACING_M_S: f64 = 0.6;

/// Path of a person into the part of a member: the part plus an offset that vanishes over time.
///
/// `x(t) = u(t) + e(t)`, where `e` is the polynomial of degree 5 that begins with the offset of place and velocity, and ends
/// after `T` with neither, without acceleration at either end:
/// `e = e0 (1 - 10 s^3 + 15 s^4 - 6 s^5) + e0' T (s - 6 s^3 + 8 s^4 - 3 s^5)`, `s = t / T`. So place and velocity are
/// continuous.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlendedPath {
    pub(super) member: usize,
    pub(super) mirrored: bool,
    off_m: Vec2,
    off_m_s: Vec2,
    /// Time of moving over, seconds.
    pub(super) over_s: f64,
}

impl BlendedPath {
    /// Finds the quickest path into a part within the limits of a human body; `None` if no path keeps them.
    ///
    /// `from` is the person's state in the viewer's frame.
    pub(super) fn find(unit: &Unit, member: usize, mirrored: bool, from: &TrackState) -> Option<BlendedPath> {
        let start = unit.moment(member, 0.0, mirrored);
        let (off_m, off_m_s) = (from.place_m - start.place_m, from.velocity_m_s - start.velocity_m_s);
        let [least, most, step] = MOVE_OVER_S;
        let times = (0..).map(|k| least + step * f64::from(k)).take_while(|&t| t <= most.min(unit.duration_s - 0.4));
        let mut ways = times.map(|over_s| BlendedPath { member, mirrored, off_m, off_m_s, over_s });
        ways.find(|way| way.is_human(unit, from))
    }

    /// State at a time of the unit, viewer's frame.
    pub(super) fn at(&self, unit: &Unit, time_s: f64) -> TrackState {
        let mut moment = unit.moment(self.member, time_s, self.mirrored);
        let s = time_s / self.over_s;
        if s < 1.0 {
            let (s2, s3, s4, s5) = (s * s, s * s * s, s * s * s * s, s * s * s * s * s);
            moment.place_m += self.off_m * (1.0 - 10.0 * s3 + 15.0 * s4 - 6.0 * s5)
                + self.off_m_s * (self.over_s * (s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5));
            moment.velocity_m_s += self.off_m * ((-30.0 * s2 + 60.0 * s3 - 30.0 * s4) / self.over_s)
                + self.off_m_s * (1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4);
        }
        moment
    }

    /// Unit vector in which the body faces at a time, from `before` a step of `dt` seconds earlier.
    ///
    /// It follows the part, turned along with the path while moving over, no faster than bodies turn.
    pub(super) fn heading(&self, unit: &Unit, time_s: f64, before: Vec2, dt: f64) -> Vec2 {
        let part = unit.moment(self.member, time_s, self.mirrored);
        let mut wanted = part.heading;
        if time_s < self.over_s {
            let going = self.at(unit, time_s).velocity_m_s;
            let speed = going.length().min(part.velocity_m_s.length());
            let share = ((speed - 0.5 * FACING_M_S) / (0.5 * FACING_M_S)).clamp(0.0, 1.0);
            if let (Some(to), Some(from)) = (going.normalized(), part.velocity_m_s.normalized()) {
                let turn = Vec2 { x: from.dot(to), y: from.cross(to) };
                wanted = wanted.lerp(wanted.rotated(turn), share).normalized().unwrap_or(wanted);
            }
        }
        turn_towards(before, wanted, FASTEST_TURN_RAD_S * dt)
    }

    /// Whether moving over stays within the limits of a human body.
    fn is_human(&self, unit: &Unit, from: &TrackState) -> bool {
        let (mut before, mut facing) = (*from, from.heading);
        let steps = (self.over_s / LOOK_S).ceil() as usize + 1;
        (1..=steps).all(|k| {
            let time_s = k as f64 * LOOK_S;
            let now = self.at(unit, time_s);
            let part = unit.moment(self.member, time_s, self.mirrored).velocity_m_s.length();
            facing = self.heading(unit, time_s, facing, LOOK_S);
            let harder = now.velocity_m_s.distance(before.velocity_m_s) / LOOK_S;
            before = now;
            let most_m_s = MOST_M_S.max(part + MOST_FASTER_M_S).max(from.velocity_m_s.length());
            harder <= MOST_M_S2
                && now.velocity_m_s.length() <= most_m_s
                && now.velocity_m_s.dot(facing) >= -MOST_BACK_M_S
        })
    }

    /// Place and velocity at a time of the unit, plan frame.
    pub(super) fn on_plan(&self, unit: &Unit, time_s: f64, spot: &SpotFrame) -> (Vec2, Vec2) {
        let moment = self.at(unit, time_s);
        (spot.to_plan(moment.place_m), spot.turn_to_plan(moment.velocity_m_s))
    }
}

/// Turns a unit vector towards another by at most a small angle.
fn turn_towards(from: Vec2, to: Vec2, most_rad: f64) -> Vec2 {
    let (sin, cos) = crate::math::sin_cos(most_rad.min(std::f64::consts::PI));
    if from.dot(to) >= cos {
        return to;
    }
    let side = if from.cross(to) < 0.0 { -1.0 } else { 1.0 };
    from.rotated(Vec2 { x: cos, y: side * sin }).normalized().unwrap_or(to)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::units::UnitLibrary;

    #[test]
    fn a_way_begins_where_somebody_is_and_ends_on_the_part() {
        let library = UnitLibrary::built_in().unwrap();
        let mut found = 0;
        for unit in &library.units {
            for member in 0..unit.members.len() {
                let start = unit.moment(member, 0.0, true);
                let off = TrackState {
                    place_m: start.place_m + vec2(0.3, -0.2),
                    velocity_m_s: start.velocity_m_s + vec2(0.2, 0.1),
                    heading: start.heading.rotated(vec2(0.8, 0.6)),
                };
                let Some(way) = BlendedPath::find(unit, member, true, &off) else { continue };
                found += 1;
                let at = way.at(unit, 0.0);
                assert!(at.place_m.distance(off.place_m) < 1e-9 && at.velocity_m_s.distance(off.velocity_m_s) < 1e-9);
                let over = way.at(unit, way.over_s + 1e-6);
                let part = unit.moment(member, way.over_s + 1e-6, true);
                assert!(over.place_m.distance(part.place_m) < 1e-4, "{}", unit.name);
                let (mut before, mut facing) = (off, off.heading);
                for k in 1..=((unit.duration_s / 0.02) as usize) {
                    let now = way.at(unit, k as f64 * 0.02);
                    let hardest = if (k as f64) * 0.02 < way.over_s { MOST_M_S2 + 0.6 } else { 6.0 };
                    assert!(now.velocity_m_s.distance(before.velocity_m_s) < hardest * 0.02, "{} {k}", unit.name);
                    let mean = (now.velocity_m_s + before.velocity_m_s) * 0.5;
                    assert!((now.place_m - before.place_m).distance(mean * 0.02) < 1e-4, "{} {k}", unit.name);
                    let turned = way.heading(unit, k as f64 * 0.02, facing, 0.02);
                    assert!(turned.distance(facing) < FASTEST_TURN_RAD_S * 0.02 + 1e-6);
                    (before, facing) = (now, turned);
                }
            }
        }
        assert!(found > 60, "{found}");
    }

    #[test]
    fn nobody_leaps_or_walks_backwards() {
        let library = UnitLibrary::built_in().unwrap();
        let unit = &library.units[0];
        let start = unit.moment(0, 0.0, false);
        let far = TrackState { place_m: start.place_m + vec2(9.0, 0.0), ..start };
        assert_eq!(BlendedPath::find(unit, 0, false, &far), None);
        let ahead = start.heading * 2.5;
        let beyond = TrackState { place_m: start.place_m + ahead, velocity_m_s: Vec2::ZERO, ..start };
        assert!(BlendedPath::find(unit, 0, false, &beyond).is_none_or(|way| way.over_s > 1.5));
    }
}
