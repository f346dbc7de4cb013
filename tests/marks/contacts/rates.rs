//! How often, and where.

use trodden::marks::{Contact, ContactOptions};
use trodden::math::vec2;
use trodden::patterns::Cause;

use super::scene::{DOORS_M, NARROW_M, NORTH_M, SOUTH_M, Scene, TURN_M, rates_times, scene};

/// Rates are raised by this, so that a small crowd leaves enough to count.
const FACTOR: f64 = 40.0;
/// Where the corridor is plain: no door, corner or narrow stretch in reach.
const PLAIN_M: [[f64; 2]; 3] = [[1.6, 3.0], [9.6, 14.4], [26.2, 26.8]];
/// Half of the shoulders' width, about.
const HALF_BODY_M: f64 = 0.24;

fn is_plain(x: f64) -> bool {
    PLAIN_M.iter().any(|[from, to]| x > *from && x < *to)
}

/// Contacts on the plain pieces of the corridor's walls.
fn on_plain(scene: &Scene, contacts: &[Contact]) -> Vec<Contact> {
    let is_on = |contact: &&Contact| {
        let at = scene.place(contact);
        is_plain(at.x) && ((at.y - NORTH_M).abs() < 0.02 || (at.y - SOUTH_M).abs() < 0.02)
    };
    contacts.iter().filter(is_on).copied().collect()
}

fn near(scene: &Scene, contacts: &[Contact], x: f64, y: f64) -> Vec<Contact> {
    contacts.iter().filter(|contact| scene.place(contact).distance(vec2(x, y)) < 0.4).copied().collect()
}

fn count(contacts: &[Contact], cause: Cause) -> f64 {
    contacts.iter().filter(|contact| contact.cause == cause).count() as f64
}

/// Metres walked along the plain pieces within reach of a wall, and how often each door was passed and the corner turned.
fn walked(scene: &Scene) -> (f64, [f64; 2], f64) {
    let (mut in_reach_m, mut passages, mut turns) = (0.0, [0.0; 2], 0.0);
    scene.ways(|from, to| {
        let at = from.lerp(to, 0.5);
        let gap_m = (NORTH_M - at.y).min(at.y - SOUTH_M) - HALF_BODY_M;
        if is_plain(at.x) && gap_m < 0.7 {
            in_reach_m += from.distance(to);
        }
        for (passed, [x, _]) in passages.iter_mut().zip(DOORS_M) {
            *passed += f64::from(u8::from(from.x < x && to.x >= x));
        }
        turns += f64::from(u8::from(from.y < 8.0 && to.y >= 8.0));
    });
    (in_reach_m, passages, turns)
}

#[test]
fn hands_bags_and_shoes_touch_as_often_as_they_should() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let (in_reach_m, passages, turns) = walked(scene);
    let plain = on_plain(scene, &contacts);
    let per_10_m = |cause: Cause| 10.0 * count(&plain, cause) / in_reach_m / FACTOR;
    let [hand, bag, shoe] = [Cause::Hand, Cause::Bag, Cause::Shoe].map(per_10_m);
    println!("plain wall, per 10 m: hand {hand:.4}, bag {bag:.4}, shoe {shoe:.4}");
    assert!((0.007..0.014).contains(&hand), "{hand}");
    assert!((0.003..0.008).contains(&bag), "{bag}");
    assert!((0.001..0.0035).contains(&shoe), "{shoe}");
    for ([x, width], passages) in DOORS_M.into_iter().zip(passages) {
        let middle = 0.5 * (SOUTH_M + NORTH_M);
        let jambs: Vec<Contact> =
            [-0.5, 0.5].into_iter().flat_map(|side| near(scene, &contacts, x, middle + side * width)).collect();
        let hands = count(&jambs, Cause::Hand) / passages / FACTOR;
        println!("door of {width} m: {hands:.4} hands per passage");
        assert!((0.05..0.1).contains(&hands), "door of {width} m: {hands}");
    }
    let corner = near(scene, &contacts, TURN_M, NORTH_M);
    let hands = count(&corner, Cause::Hand) / turns / FACTOR;
    println!("corner: {hands:.4} hands per turn");
    assert!((0.015..0.05).contains(&hands), "{hands}");
}

#[test]
fn touches_gather_at_jambs_and_corners() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let plain_m: f64 = PLAIN_M.iter().map(|[from, to]| to - from).sum();
    // On both sides, less what opens into the unused room.
    let plain = on_plain(scene, &contacts).len() as f64 / (2.0 * plain_m);
    let middle = 0.5 * (SOUTH_M + NORTH_M);
    for [x, width] in DOORS_M {
        for side in [-0.5, 0.5] {
            // A jamb is 0.2 m thick; on its faces 0.3 m of wall count in.
            let jamb = near(scene, &contacts, x, middle + side * width).len() as f64 / 0.8;
            println!("jamb {jamb:.0} per metre, plain wall {plain:.1}");
            assert!(jamb > 10.0 * plain, "{jamb} per metre of jamb, {plain} of plain wall");
        }
    }
    let corner = near(scene, &contacts, TURN_M, NORTH_M).len() as f64 / 0.8;
    println!("corner {corner:.0} per metre");
    assert!(corner > 10.0 * plain, "{corner} per metre of corner, {plain} of plain wall");
}

#[test]
fn shoulders_brush_only_where_it_is_narrow() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let is_narrow = |x: f64| (x > NARROW_M[0] - 0.4 && x < NARROW_M[1] + 0.4) || (x - DOORS_M[0][0]).abs() < 0.4;
    let shoulders: Vec<&Contact> = contacts.iter().filter(|contact| contact.cause == Cause::Shoulder).collect();
    let elsewhere = shoulders.iter().filter(|contact| !is_narrow(scene.place(contact).x)).count();
    assert!(shoulders.len() > 300, "{}", shoulders.len());
    assert_eq!(elsewhere, 0, "of {} shoulders", shoulders.len());
}

#[test]
fn walls_that_nobody_passes_stay_clean() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let [mut corridor, mut behind] = [0, 0];
    for contact in &contacts {
        let at = scene.place(contact);
        assert!(at.y > 3.7, "{contact:?} lies in the room that nobody enters");
        assert!(at.x > -0.5 && at.x < TURN_M + 2.5, "{contact:?} lies outside the plan");
        // The wall north of the corridor is 0.1 m thick; a closed room lies behind.
        if at.x > 10.2 && at.x < 14.8 {
            corridor += u32::from((at.y - NORTH_M).abs() < 0.01);
            behind += u32::from(at.y > NORTH_M + 0.05);
        }
    }
    assert!(corridor > 10, "{corridor}");
    assert_eq!(behind, 0, "touches go through a thin wall");
}

#[test]
fn without_rates_or_patterns_nobody_touches_anything() {
    let scene = scene();
    assert!(scene.contacts(ContactOptions::none()).is_empty());
    let mut bare = scene.library.clone();
    bare.patterns.retain(|pattern| pattern.cause.on_wall().is_none_or(|cause| cause == 4));
    let marks = trodden::marks::MarksOptions { contact: rates_times(FACTOR), ..Default::default() };
    let mut footfalls = trodden::marks::Footfalls::new(&scene.people, &scene.walls, &bare, &marks, Vec::new()).unwrap();
    let (mut feet, mut contacts) = (Vec::new(), Vec::new());
    for frame in &scene.frames {
        footfalls.push(frame, &mut feet);
    }
    footfalls.finish(&mut feet);
    footfalls.take_contacts(&mut contacts);
    assert!(!contacts.is_empty() && contacts.iter().all(|contact| contact.cause == Cause::Shoe));
}

#[test]
fn the_papers_rule_knows_nothing_but_distance() {
    let scene = scene();
    let options =
        ContactOptions { distance_close_per_metre: 1.0, distance_far_per_metre: 0.2, ..ContactOptions::paper() };
    let contacts = scene.contacts(options);
    let in_narrow = |contact: &&Contact| {
        let x = scene.place(contact).x;
        x > NARROW_M[0] + 0.5 && x < NARROW_M[1] - 0.5
    };
    let narrow: Vec<Contact> = contacts.iter().filter(in_narrow).copied().collect();
    let plain = on_plain(scene, &contacts);
    println!(
        "paper: {} touches, {} where it is narrow, {} on the plain wall",
        contacts.len(),
        narrow.len(),
        plain.len()
    );
    // Where people walk close, all parts of the body touch; where they walk farther off, mostly hand and belongings.
    for cause in Cause::WALL {
        assert!(count(&narrow, cause) > 20.0, "{cause:?}: {}", count(&narrow, cause));
    }
    let far = (count(&plain, Cause::Hand) + count(&plain, Cause::Bag)) / plain.len() as f64;
    assert!(far > 0.6, "{far} of the touches on the plain wall");
    // A jamb takes no more than a wall that is as near.
    let per_m = |contacts: &[Contact], metres: f64| contacts.len() as f64 / metres;
    let jamb = per_m(&near(scene, &contacts, DOORS_M[0][0], 0.5 * (SOUTH_M + NORTH_M) - 0.5 * DOORS_M[0][1]), 0.8);
    assert!(jamb < 3.0 * per_m(&narrow, 2.0 * (NARROW_M[1] - NARROW_M[0] - 1.0)), "{jamb} per metre of jamb");
}
