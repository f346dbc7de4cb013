//! What is left where people queue up and stand at a counter.

use trodden::marks::{HeelOptions, Mark, MarksOptions};
use trodden::math::{sin_cos, vec2};
use trodden::patterns::Cause;

use super::measure::{Floor, Path, spread};
use super::{between_deg, direction};

/// Seconds that everybody is served.
const SERVED_S: f64 = 20.0;
/// Places in the queue, from its end to the counter.
const PLACES: u32 = 6;
/// Metres from one place to the next.
const SPACING_M: f64 = 0.55;

/// Somebody who walks up from the west, moves up from place to place with those ahead, stands at the counter at
/// (60, 50), facing north, and walks off to the south.
pub fn customer(id: u32) -> Path {
    let own = |k: f64| 0.2 * (sin_cos(12.9898 * f64::from(id) + 78.233 * k).0);
    let end_x = 60.0 - SPACING_M * f64::from(PLACES - 1);
    let joins_s = 10.0;
    let way = move |t: f64| {
        let mut place = vec2(end_x - 1.2 * (joins_s - t).max(0.0), 50.0 + 0.3 * own(0.0));
        for k in 1..PLACES {
            // Everybody moves up a little late, and stops a little short or far.
            let begins_s = joins_s + SERVED_S * f64::from(k) + 2.0 * own(f64::from(k));
            let share = ((t - begins_s) / 1.4).clamp(0.0, 1.0);
            let up_m = SPACING_M + 0.4 * (own(f64::from(k) + 9.0) - own(f64::from(k) + 8.0));
            place.x += up_m * share * share * (3.0 - 2.0 * share);
        }
        place.y -= 1.2 * (t - joins_s - SERVED_S * f64::from(PLACES)).max(0.0);
        place
    };
    let facing = move |t: f64| {
        let at_counter = (t - joins_s - SERVED_S * f64::from(PLACES - 1) - 1.0).clamp(0.0, 1.0);
        let leaves = (t - joins_s - SERVED_S * f64::from(PLACES) + 1.5).clamp(0.0, 1.5);
        direction(std::f64::consts::FRAC_PI_2 * at_counter - 2.1 * leaves)
    };
    Path::of(id, joins_s + SERVED_S * f64::from(PLACES) + 8.0, 10.0, way).facing(facing)
}

fn queue(people: u32) -> Vec<Mark> {
    let heel = HeelOptions { people: 1000.0, ..HeelOptions::default() };
    let floor = Floor { options: MarksOptions { heel, ..MarksOptions::default() }, crowd: 1000, ..Floor::hall() };
    (0..people).flat_map(|id| floor.marks(&customer(id))).collect()
}

/// Marks in a stretch of the hall.
fn within(marks: &[Mark], cause: Cause, x: [f64; 2], y: [f64; 2]) -> Vec<Mark> {
    let inside = |mark: &&Mark| {
        let p = mark.place_m;
        mark.cause == cause && (x[0]..x[1]).contains(&p.x) && (y[0]..y[1]).contains(&p.y)
    };
    marks.iter().filter(inside).copied().collect()
}

#[test]
fn a_counter_gathers_prints_that_face_it_every_way_a_little() {
    let people = 200;
    let marks = queue(people);
    let count = |x, y| within(&marks, Cause::Sole, x, y).len() as f64 / f64::from(people);
    let (walk, wait, counter) = (
        count([50.0, 53.0], [49.0, 51.0]) / 3.0,
        count([57.0, 59.0], [49.0, 51.0]) / 2.0,
        count([59.4, 60.6], [49.3, 50.7]),
    );
    println!(
        "prints a person: {walk:.1} per metre walked up, {wait:.1} per metre of queue, {counter:.1} at the counter"
    );
    // A queue is trodden more than the way to it, but standing is no treading.
    assert!(wait > 2.0 * walk && wait < 10.0 * walk, "{wait} per metre of queue, {walk} of way");
    assert!((4.0..12.0).contains(&counter), "{counter} prints of somebody who stands 20 s at the counter");
    let feet = within(&marks, Cause::Sole, [59.5, 60.5], [49.4, 50.6]);
    let angles: Vec<f64> = feet.iter().map(|foot| between_deg(vec2(0.0, 1.0), foot.heading)).collect();
    let facing: Vec<f64> = angles.iter().copied().filter(|angle| angle.abs() < 40.0).collect();
    let share = facing.len() as f64 / angles.len() as f64;
    let [_, sd] = spread(facing);
    println!("{:.0} % of them face the counter, +- {sd:.0} degrees", 100.0 * share);
    assert!(share > 0.3 && (7.0..20.0).contains(&sd), "{share} face the counter, +- {sd} degrees");
}

#[test]
fn a_queue_and_its_counter_are_scuffed_about_five_times_as_much() {
    let people = 1000;
    let marks = queue(people);
    // The lane up to the queue is as broad as the queue, so that a square metre of each has seen everybody.
    let per_m2 =
        |x: [f64; 2], y: [f64; 2]| within(&marks, Cause::Heel, x, y).len() as f64 / ((x[1] - x[0]) * (y[1] - y[0]));
    let (lane, waiting, counter) =
        (per_m2([44.0, 55.0], [49.5, 50.5]), per_m2([57.5, 59.4], [49.5, 50.5]), per_m2([59.4, 60.6], [49.4, 50.6]));
    println!("heel marks per m2: {lane:.1} on the way, {waiting:.1} in the queue, {counter:.1} at the counter");
    assert!((3.0..9.0).contains(&(counter / lane)), "{counter} at the counter, {lane} on the way");
    assert!((2.0..9.0).contains(&(waiting / lane)), "{waiting} in the queue, {lane} on the way");
}
