//! What is measured of a motion.

use trodden::crowd::CrowdOptions;
use trodden::math::Vec2;

use super::scene::Scene;

/// Weidmann 1993: speed at a density in persons per square metre, metres per second.
pub fn weidmann_m_s(density: f64) -> f64 {
    1.34 * (1.0 - trodden::math::exp(-1.913 * (1.0 / density - 1.0 / 5.4)))
}

/// Mean displacement along x per second after ten seconds in an endless corridor, metres per second, without regard to
/// its sign.
pub fn mean_speed_m_s(scene: &Scene, options: &CrowdOptions, seed: u64) -> f64 {
    let mut last: Vec<Option<Vec2>> = vec![None; options.people as usize];
    let (mut moved_m, mut seconds) = (0.0, 0.0);
    let period_m = options.period_x.expect("an endless corridor");
    let mut sign = vec![0.0; options.people as usize];
    let tally = scene.walk(options, seed, |frame| {
        for walker in &frame.walkers {
            let id = walker.id as usize;
            let before = last[id].replace(walker.position_m);
            if let Some(before) = before {
                let dx = walker.position_m.x - before.x;
                let dx = if dx.abs() > 0.5 * period_m { dx - period_m * dx.signum() } else { dx };
                // The way that somebody has gone over the first ten seconds is forward.
                if frame.time_s <= 10.0 {
                    sign[id] += dx;
                } else {
                    moved_m += dx * f64::signum(sign[id]);
                    seconds += options.time_step;
                }
            }
        }
    });
    assert_eq!(tally.entered, u64::from(options.people), "not everybody found room");
    moved_m / seconds
}

/// The value below which this share of all values lies.
pub fn percentile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share).round() as usize]
}
