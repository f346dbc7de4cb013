//! How much of an example's fluctuation is there in what was made of it.

use trodden::formation::KeyFormation;
use trodden::math::Vec2;
use trodden::motion::Ensemble;

/// How far apart the places are whose second difference tells steps from ways, seconds.
const STEP_S: f64 = 0.2;

/// Energy of the fluctuation over that of the example, and the same of steps alone. `bare` is made without fluctuation.
pub fn kept(example: &Ensemble, keys: &[KeyFormation], full: &Ensemble, bare: &Ensemble) -> [f64; 2] {
    let moments: Vec<usize> = keys.iter().map(|key| (key.time_s * example.fps).round() as usize).collect();
    let energy = between(full, bare) / between(example, &lines(example, &moments));
    [energy, (quick(full) - quick(bare)) / quick(example)]
}

/// Somebody's place relative to the middle.
fn relative(motion: &Ensemble, moment: usize) -> impl Iterator<Item = Vec2> + '_ {
    let middle = motion.centroid_m(moment);
    motion.places_at(moment).iter().map(move |&place| place - middle)
}

fn between(a: &Ensemble, b: &Ensemble) -> f64 {
    let at = |moment: usize| {
        relative(a, moment).zip(relative(b, moment)).map(|(a, b)| (a - b).length_squared()).sum::<f64>()
    };
    (0..a.moments().min(b.moments())).map(at).sum()
}

/// Everybody on the lines between their own places at the keys' moments, relative to the middle.
fn lines(example: &Ensemble, moments: &[usize]) -> Ensemble {
    let mut lines = example.clone();
    for pair in moments.windows(2) {
        let ends = [pair[0], pair[1]].map(|moment| relative(example, moment).collect::<Vec<Vec2>>());
        for moment in pair[0]..=pair[1] {
            let share = (moment - pair[0]) as f64 / (pair[1] - pair[0]).max(1) as f64;
            let line = ends[0].iter().zip(&ends[1]).map(|(a, b)| a.lerp(*b, share));
            lines.places_at_mut(moment).iter_mut().zip(line).for_each(|(place, line)| *place = line);
        }
    }
    lines
}

/// Energy of second differences over the time of a step.
fn quick(motion: &Ensemble) -> f64 {
    let reach = ((STEP_S * motion.fps).round() as usize).max(1);
    let at = |moment: usize| {
        let ends = relative(motion, moment - reach).zip(relative(motion, moment + reach));
        ends.zip(relative(motion, moment)).map(|((a, b), here)| (a + b - here * 2.0).length_squared()).sum::<f64>()
    };
    (reach..motion.moments().saturating_sub(reach)).map(at).sum()
}
