//! Rates, not frames.

use trodden::math::Vec2;
use trodden::motion::{Frame, Walker};

use super::scene::{Scene, rates_times, scene};

/// The same motion at another frame rate: straight between the frames that there are.
fn resampled(scene: &Scene, hertz: f64) -> Vec<Frame> {
    let end_s = scene.frames.last().unwrap().time_s;
    let mut k = 0;
    let mut frames = Vec::new();
    for n in 0..=(end_s * hertz) as u32 {
        let time_s = f64::from(n) / hertz;
        while k + 2 < scene.frames.len() && scene.frames[k + 1].time_s < time_s {
            k += 1;
        }
        let (before, after) = (&scene.frames[k], &scene.frames[k + 1]);
        let share = ((time_s - before.time_s) / (after.time_s - before.time_s)).clamp(0.0, 1.0);
        let between = |a: Vec2, b: Vec2| a.lerp(b, share);
        let walker = |from: &Walker| {
            let to = after.walkers.iter().find(|to| to.id == from.id)?;
            let heading = from.heading.zip(to.heading).and_then(|(a, b)| between(a, b).normalized());
            let position_m = between(from.position_m, to.position_m);
            Some(Walker { position_m, velocity_m_s: between(from.velocity_m_s, to.velocity_m_s), heading, ..*from })
        };
        frames.push(Frame { time_s, walkers: before.walkers.iter().filter_map(walker).collect() });
    }
    frames
}

#[test]
fn counts_do_not_depend_on_the_time_step() {
    let scene = scene();
    let options = rates_times(100.0);
    let count = |frames: &[Frame]| scene.contacts_of(frames, options.clone(), None).len() as f64;
    let all = count(&scene.frames);
    for hertz in [2.5, 5.0, 20.0, 30.0] {
        let other = count(&resampled(scene, hertz));
        println!("{all} contacts at the simulation's step, {other} at {hertz} Hz");
        assert!((other / all - 1.0).abs() < 0.03, "{all} contacts, {other} at {hertz} Hz");
    }
}

#[test]
fn the_same_motion_gives_the_same_contacts() {
    let scene = scene();
    let once = scene.contacts(rates_times(5.0));
    assert!(!once.is_empty());
    assert_eq!(once, scene.contacts(rates_times(5.0)));
}
