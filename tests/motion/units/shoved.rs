//! Near the viewer, people who play shove nobody: others see them come and step aside.

use trodden::crowd::SpotRequest;

use super::scene::Scene;

/// Change of velocity within a step of 0.1 s that no walker makes unless shoved, metres per second: the crowd allows 0.5.
const SHOVE_M_S: f64 = 0.55;
/// How far from the viewer shoves are counted, metres.
const NEAR_M: f64 = 6.0;

/// Number of shoves in so many crowds of two minutes.
fn shoves(play: bool, seeds: std::ops::RangeInclusive<u64>) -> usize {
    let scene = Scene::plaza();
    let at = scene.spot().at.to_m(&scene.plan);
    let of = |seed: u64| {
        let (moments, _) = scene.run_with(SpotRequest { play, ..scene.spot() }, 120.0, seed);
        let steps = moments.windows(2).flat_map(|pair| {
            let after = |id: u32| pair[1].iter().find(|seen| seen.id == id);
            pair[0].iter().filter_map(move |before| Some((before, after(before.id)?)))
        });
        let near = steps.filter(|(_, after)| after.place_m.distance(at) < NEAR_M);
        near.filter(|(before, after)| after.velocity_m_s.distance(before.velocity_m_s) > SHOVE_M_S).count()
    };
    seeds.map(of).sum()
}

#[test]
fn with_units_nobody_is_shoved() {
    let [with, without] = [true, false].map(|play| shoves(play, 1..=6));
    assert!(with <= without && with <= 1, "{with} with units, {without} without");
}
