//! How speed falls with the number of people ahead.

use crate::crowd::SpeedLaw;

/// People per square metre at which the linear law comes to rest.
const LINEAR_JAM: f64 = 4.0;
/// People per square metre at which Weidmann's law comes to rest.
const WEIDMANN_JAM: f64 = 5.4;
/// Least speed in a dense crowd up to so many people per square metre ahead, and at Weidmann's jam, metres per second:
/// an arch before a door must dissolve, and a jam must pass a gap at the flow that is measured.
const LEAST_SPEED_M_S: [f32; 2] = [0.2, 0.13];
const LEAST_UP_TO: f32 = 4.0;

/// A speed law as a table over people per square metre.
#[derive(Clone, Debug)]
pub(super) struct SpeedTable {
    factors: Vec<f32>,
}

impl SpeedTable {
    const PER_UNIT: f32 = 32.0;

    pub(super) fn new(law: SpeedLaw) -> SpeedTable {
        let factor = |rho: f64| match law {
            SpeedLaw::Linear => (1.0 - rho / LINEAR_JAM).max(0.0),
            SpeedLaw::Weidmann if rho < 1e-3 => 1.0,
            SpeedLaw::Weidmann => (1.0 - crate::math::exp(-1.913 * (1.0 / rho - 1.0 / WEIDMANN_JAM))).max(0.0),
        };
        let count = (8.0 * f64::from(SpeedTable::PER_UNIT)) as usize;
        SpeedTable { factors: (0..=count).map(|k| factor(k as f64 / f64::from(SpeedTable::PER_UNIT)) as f32).collect() }
    }

    /// Share of the free speed that is left at so many people per square metre.
    #[inline]
    pub(super) fn factor(&self, people_per_m2: f32) -> f32 {
        let at = (people_per_m2 * SpeedTable::PER_UNIT).clamp(0.0, (self.factors.len() - 2) as f32);
        let k = at as usize;
        let (a, b) = (self.factors[k], self.factors[k + 1]);
        a + (b - a) * (at - k as f32)
    }

    /// Speed that a dense crowd leaves to everybody who wants to walk, metres per second.
    pub(super) fn least_m_s(people_per_m2: f32) -> f32 {
        let [most, least] = LEAST_SPEED_M_S;
        let share = ((people_per_m2 - LEAST_UP_TO) / (WEIDMANN_JAM as f32 - LEAST_UP_TO)).clamp(0.0, 1.0);
        most + (least - most) * share
    }
}
