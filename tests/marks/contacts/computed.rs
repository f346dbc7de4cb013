//! Height, length and strength of a contact follow from who touches, how fast, and how far off.

use trodden::marks::{Contact, ContactOptions, Footfalls, MarksOptions};
use trodden::math::vec2;
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::{Cause, Form};

use super::scene::{SOUTH_M, scene};

/// What a person touches who walks along the plain wall at a distance and a speed.
fn along_the_wall(people: &People, id: u32, off_m: f64, speed_m_s: f64) -> Vec<Contact> {
    let scene = scene();
    let contact = ContactOptions { hand_per_metre: 4.0, people: 1.0, ..ContactOptions::none() };
    let marks = MarksOptions { contact, ..MarksOptions::default() };
    let mut footfalls = Footfalls::new(people, &scene.walls, &scene.library, &marks, Vec::new()).unwrap();
    let (mut feet, mut contacts) = (Vec::new(), Vec::new());
    for k in 0..(5.0 / (0.1 * speed_m_s)) as u32 {
        let time_s = 0.1 * f64::from(k);
        let position_m = vec2(10.0 + speed_m_s * time_s, SOUTH_M + off_m);
        let walker = Walker { id, position_m, velocity_m_s: vec2(speed_m_s, 0.0), heading: Some(vec2(1.0, 0.0)) };
        footfalls.push(&Frame { time_s, walkers: vec![walker] }, &mut feet);
    }
    footfalls.finish(&mut feet);
    footfalls.take_contacts(&mut contacts);
    contacts.retain(|contact| (scene.place(contact).y - SOUTH_M).abs() < 0.01);
    contacts
}

fn median(mut values: Vec<f64>) -> f64 {
    assert!(values.len() > 20, "{} contacts", values.len());
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Median length of drags and median strength of all hands, of thirty people.
fn hands(seed: u64, off_m: f64, speed_m_s: f64) -> [f64; 2] {
    let people = People::new(seed, BodyOptions::default());
    let contacts: Vec<Contact> = (0..30).flat_map(|id| along_the_wall(&people, id, off_m, speed_m_s)).collect();
    let is_drag = |c: &&Contact| scene().library.patterns[usize::from(c.pattern)].form == Some(Form::Drag);
    let hands = || contacts.iter().filter(|contact| contact.cause == Cause::Hand);
    let lengths = hands().filter(is_drag).map(|contact| f64::from(contact.length_m));
    [median(lengths.collect()), median(hands().map(|contact| f64::from(contact.strength)).collect())]
}

#[test]
fn who_walks_twice_as_fast_draws_twice_as_far_and_who_is_near_presses_harder() {
    for seed in 1..=3 {
        let [slow_m, near] = hands(seed, 0.4, 0.8);
        let [fast_m, _] = hands(seed, 0.4, 1.6);
        let [_, far] = hands(seed, 0.65, 0.8);
        println!("seed {seed}: drags of {slow_m:.2} and {fast_m:.2} m, strengths {near:.3} near and {far:.3} farther");
        assert!((1.8..2.2).contains(&(fast_m / slow_m)), "seed {seed}: drags of {slow_m} and {fast_m} m");
        assert!(near > 1.2 * far, "seed {seed}: {near} near the wall, {far} farther off");
    }
}

#[test]
fn tall_people_touch_higher() {
    for seed in 1..=3 {
        let people = People::new(seed, BodyOptions::default());
        let of = |id: u32| {
            let hands = along_the_wall(&people, id, 0.4, 1.2).into_iter().filter(|c| c.cause == Cause::Hand);
            // A drag's middle lies below its beginning.
            let heights = hands.map(|c| {
                c.height_m + 0.5 * f64::from(c.length_m) * trodden::math::sin_cos(f64::from(c.direction_rad)).0.abs()
            });
            heights.map(|height_m| (people.person(id).stature_m, height_m)).collect::<Vec<_>>()
        };
        let pairs: Vec<(f64, f64)> = (0..60).flat_map(of).collect();
        let n = pairs.len() as f64;
        let [x, y] = [pairs.iter().map(|p| p.0).sum::<f64>() / n, pairs.iter().map(|p| p.1).sum::<f64>() / n];
        let sum = |f: fn(f64, f64) -> f64| pairs.iter().map(|p| f(p.0 - x, p.1 - y)).sum::<f64>();
        let r = sum(|a, b| a * b) / (sum(|a, _| a * a) * sum(|_, b| b * b)).sqrt();
        println!("seed {seed}: {n} hands at {y:.2} m, correlation with stature {r:.2}");
        assert!(r > 0.75, "seed {seed}: heights and statures correlate by {r}");
    }
}
