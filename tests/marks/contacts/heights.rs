//! How high, how long, in what form.

use trodden::marks::Contact;
use trodden::math::vec2;
use trodden::motion::{BagKind, Frame, Walker};
use trodden::patterns::{Cause, Form};

use super::scene::{DOORS_M, NARROW_M, NORTH_M, SOUTH_M, TURN_M, rates_times, scene, spread};

const FACTOR: f64 = 40.0;

fn form_of(contact: &Contact) -> Option<Form> {
    scene().library.patterns[usize::from(contact.pattern)].form
}

fn heights<'c>(contacts: impl Iterator<Item = &'c Contact>) -> Vec<f64> {
    contacts.map(|contact| contact.height_m).collect()
}

#[test]
fn hands_touch_at_the_height_of_what_they_do() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let hands = || contacts.iter().filter(|contact| contact.cause == Cause::Hand);
    let middle = 0.5 * (SOUTH_M + NORTH_M);
    let at_jamb = |contact: &&Contact| {
        let at = scene.place(contact);
        let is_jamb =
            |[x, width]: [f64; 2]| (at.x - x).abs() < 0.2 && ((at.y - middle).abs() - 0.5 * width).abs() < 0.1;
        DOORS_M.into_iter().any(is_jamb) && form_of(contact) == Some(Form::Palm)
    };
    let [push, push_sd] = spread(&heights(hands().filter(at_jamb)));
    println!("push {push:.3} +- {push_sd:.3} m");
    assert!((1.1..1.4).contains(&push) && (0.08..0.12).contains(&push_sd), "{push} +- {push_sd}");
    let drags: Vec<&Contact> = hands().filter(|contact| form_of(contact) == Some(Form::Drag)).collect();
    let [trailing, trailing_sd] = spread(&heights(drags.iter().copied()));
    println!("trailing {trailing:.3} +- {trailing_sd:.3} m, {} drags", drags.len());
    assert!((0.9..1.2).contains(&trailing) && (0.07..0.12).contains(&trailing_sd), "{trailing} +- {trailing_sd}");
    for drag in drags {
        assert!((0.2..=0.8).contains(&drag.length_m), "{drag:?}");
        // 5 to 15 degrees down, to the right or to the left.
        let (sin, cos) = trodden::math::sin_cos(f64::from(drag.direction_rad));
        let down_deg = (-sin / cos.abs()).atan_deg();
        assert!((4.9..15.1).contains(&down_deg), "{down_deg} degrees: {drag:?}");
        assert_eq!(drag.mirrored, cos < 0.0, "upside down: {drag:?}");
    }
}

/// Arc tangent in degrees.
trait AtanDeg {
    fn atan_deg(self) -> f64;
}

impl AtanDeg for f64 {
    fn atan_deg(self) -> f64 {
        trodden::math::atan2(self, 1.0).to_degrees()
    }
}

#[test]
fn drags_go_the_way_that_people_walk() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let mut seen = [0, 0];
    for contact in contacts.iter().filter(|contact| form_of(contact) == Some(Form::Drag)) {
        let at = scene.place(contact);
        // Everybody walks to the right of the plan here: who looks at the north wall sees it go to the right.
        let rightward = contact.direction_rad.abs() < 1.0;
        if (at.y - NORTH_M).abs() < 0.01 && at.x < TURN_M - 1.0 {
            assert!(rightward, "{contact:?}");
            seen[0] += 1;
        } else if (at.y - SOUTH_M).abs() < 0.01 && at.x < TURN_M - 1.0 {
            assert!(!rightward, "{contact:?}");
            seen[1] += 1;
        }
    }
    assert!(seen[0] > 5 && seen[1] > 5, "{seen:?}");
}

#[test]
fn a_corner_is_touched_round_both_faces_and_scuffed_at_its_foot() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(2.0 * FACTOR));
    let corner = scene.walls.corners().into_iter().find(|c| c.point_m.distance(vec2(TURN_M, NORTH_M)) < 0.1).unwrap();
    let off_m = |contact: &Contact| contact.along_m - corner.along_m;
    let here = |contact: &&Contact| contact.face as usize == corner.face && off_m(contact).abs() < 0.15;
    let hands: Vec<&Contact> = contacts.iter().filter(|c| c.cause == Cause::Hand).filter(here).collect();
    let before = hands.iter().filter(|contact| off_m(contact) < 0.0).count() as f64 / hands.len() as f64;
    let [height, height_sd] = spread(&heights(hands.iter().copied()));
    println!("{} hands at the corner, {before:.2} before it, {height:.2} +- {height_sd:.2} m", hands.len());
    assert!(hands.len() > 50 && (0.25..0.75).contains(&before), "{before} of {}", hands.len());
    assert!((0.9..1.4).contains(&(height - height_sd)) && (0.9..1.4).contains(&(height + height_sd)));
    let scuffs = heights(contacts.iter().filter(|c| c.cause == Cause::Shoe).filter(here));
    assert!(scuffs.len() > 10 && scuffs.iter().all(|&height| height < 0.3), "{scuffs:?}");
}

#[test]
fn shoulders_leave_a_band_and_toes_stay_low() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let in_narrow = |contact: &&Contact| {
        let at = scene.place(contact);
        at.x > NARROW_M[0] + 0.3 && at.x < NARROW_M[1] - 0.3
    };
    let narrow: Vec<&Contact> = contacts.iter().filter(in_narrow).collect();
    let of = |cause: Cause| heights(narrow.iter().copied().filter(|contact| contact.cause == cause));
    let shoulders = of(Cause::Shoulder);
    let [height, _] = spread(&shoulders);
    let in_band = shoulders.iter().filter(|height| (1.25..1.55).contains(*height)).count();
    println!("shoulders at {height:.2} m, {in_band} of {} from 1.25 to 1.55", shoulders.len());
    assert!((1.3..1.5).contains(&height) && in_band as f64 > 0.8 * shoulders.len() as f64);
    assert!(of(Cause::Shoe).iter().all(|height| (0.0..=0.16).contains(height)), "toes");
}

#[test]
fn belongings_touch_as_low_as_they_are_carried() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let bags = heights(contacts.iter().filter(|contact| contact.cause == Cause::Bag));
    let low = bags.iter().filter(|height| (0.15..0.62).contains(*height)).count() as f64 / bags.len() as f64;
    assert!(bags.len() > 100 && low > 0.7, "{low} of {}", bags.len());
    let kinds =
        |kind: BagKind| (0..1000).filter(|&id| scene.people.person(id).bag.is_some_and(|bag| bag.kind == kind)).count();
    let counts = [BagKind::Bag, BagKind::Case, BagKind::Trolley, BagKind::Rucksack].map(kinds);
    println!("of 1000 people: {counts:?} bags, cases, trolleys, rucksacks");
    assert!(counts[0] > counts[1] && counts[1] > counts[2] && counts[2] > 30 && counts[3] > 100, "{counts:?}");
}

#[test]
fn whoever_stands_at_a_wall_leans_on_it() {
    let scene = scene();
    // 40 people who stand with their backs to the south wall for ten minutes.
    let walkers = |time_s: f64| {
        let at = |id: u32| vec2(10.5 + 0.1 * f64::from(id), SOUTH_M + 0.3 + 0.004 * f64::from(id % 3));
        let walker =
            |id| Walker { id, position_m: at(id), velocity_m_s: vec2(0.0, 0.0), heading: Some(vec2(0.0, 1.0)) };
        Frame { time_s, walkers: (0..40).map(walker).collect() }
    };
    let frames: Vec<Frame> = (0..1200).map(|n| walkers(0.5 * f64::from(n))).collect();
    let contacts = scene.contacts_of(&frames, rates_times(1.0), None);
    println!("{} touches of 40 people in 600 s", contacts.len());
    // 0.004 a second very close: less a little, as they stand a hand's breadth off.
    assert!((25..96).contains(&contacts.len()), "{}", contacts.len());
    let count = |cause: Cause| contacts.iter().filter(|contact| contact.cause == cause).count();
    assert!(count(Cause::Shoulder) + count(Cause::Bag) > 5 && count(Cause::Shoe) > 5);
    for contact in &contacts {
        let at = scene.place(contact);
        assert!((at.y - SOUTH_M).abs() < 0.01 && (10.0..15.0).contains(&at.x), "{at:?}");
        if contact.cause == Cause::Shoe {
            assert!((0.2..0.55).contains(&contact.height_m), "a sole against the wall: {contact:?}");
        }
    }
}

#[test]
fn most_touches_are_faint_and_few_hands_legible() {
    let scene = scene();
    let contacts = scene.contacts(rates_times(FACTOR));
    let mut strengths: Vec<f32> = contacts.iter().filter(|c| c.cause == Cause::Hand).map(|c| c.strength).collect();
    strengths.sort_by(f32::total_cmp);
    let median = strengths[strengths.len() / 2];
    assert!((0.03..0.07).contains(&median), "{median}");
    assert!(strengths[strengths.len() * 9 / 10] > 2.0 * median, "they differ too little");
    let is_legible = |contact: &&Contact| scene.library.patterns[usize::from(contact.pattern)].name == "hand_print";
    let legible = contacts.iter().filter(is_legible).count() as f64 / strengths.len() as f64;
    assert!(legible < 0.05, "{legible} of the hands");
}
