use super::*;
use crate::Silent;
use crate::formation::formed::FormedPerson;
use crate::formation::request::AvoidRequest;
use crate::math::{SplitMix64, Vec2, sin_cos, vec2};
use crate::progress::Progress;

fn person(track: Vec<Vec2>) -> FormationBody {
    FormationBody::person(
        track,
        FormedPerson { address: vec![0], rides: false, stature_m: None },
        &AvoidRequest::default(),
    )
}

fn cleared(tracks: Vec<Vec<Vec2>>, fps: f64) -> Vec<Vec<Vec2>> {
    let mut bodies: Vec<FormationBody> = tracks.into_iter().map(person).collect();
    let last = bodies[0].places.len() - 1;
    keep_clear(&AvoidanceSettings::new(&AvoidRequest::default(), fps, &[0, last]), &mut bodies, &Silent).unwrap();
    bodies.into_iter().map(|body| body.places).collect()
}

fn nearest_m(tracks: &[Vec<Vec2>]) -> f64 {
    let mut nearest_m = f64::INFINITY;
    for moment in 0..tracks[0].len() {
        for a in 0..tracks.len() {
            for b in 0..a {
                nearest_m = nearest_m.min(tracks[a][moment].distance(tracks[b][moment]));
            }
        }
    }
    nearest_m
}

/// The largest change of velocity between moments, as an acceleration, m/s2.
fn hardest_m_s2(tracks: &[Vec<Vec2>], fps: f64) -> f64 {
    let change = |track: &[Vec2]| (track[0] - track[1] * 2.0 + track[2]).length() * fps * fps;
    tracks.iter().flat_map(|track| track.windows(3).map(change)).fold(0.0, f64::max)
}

fn line(from: [f64; 2], to: [f64; 2], moments: usize) -> Vec<Vec2> {
    let (from, to) = (Vec2::from(from), Vec2::from(to));
    (0..moments).map(|k| from.lerp(to, k as f64 / (moments - 1) as f64)).collect()
}

#[test]
fn two_who_meet_head_on_pass_each_other_on_the_right_without_a_jump() {
    for fps in [10.0, 25.0] {
        let moments = (8.0 * fps) as usize + 1;
        let tracks = vec![line([-5.0, 0.0], [5.0, 0.0], moments), line([5.0, 0.0], [-5.0, 0.0], moments)];
        let clear = cleared(tracks.clone(), fps);
        assert!(nearest_m(&clear) >= 0.36, "{}", nearest_m(&clear));
        assert!(hardest_m_s2(&clear, fps) < 1.5, "{}", hardest_m_s2(&clear, fps));
        // To their right: the first, who goes to the right of the picture, below.
        assert!(clear[0][moments / 2].y < -0.1 && clear[1][moments / 2].y > 0.1);
        // They come back.
        for (clear, track) in clear.iter().zip(&tracks) {
            assert!(clear[0].distance(track[0]) < 0.01 && clear[moments - 1].distance(track[moments - 1]) < 0.01);
        }
    }
}

#[test]
fn a_crowd_that_crosses_itself_keeps_clear() {
    let mut words = SplitMix64::new(3);
    let mut point = || [f64::from(words.range(-4.0, 4.0)), f64::from(words.range(-4.0, 4.0))];
    let tracks: Vec<Vec<Vec2>> = (0..40).map(|_| line(point(), point(), 101)).collect();
    let before = nearest_m(&tracks);
    assert!(before < 0.1);
    let clear = cleared(tracks.clone(), 10.0);
    assert!(nearest_m(&clear) >= 0.36 - 1e-9, "{}", nearest_m(&clear));
    assert!(hardest_m_s2(&clear, 10.0) < 5.0, "{}", hardest_m_s2(&clear, 10.0));
}

#[test]
fn all_on_one_point_are_parted() {
    let tracks = vec![vec![vec2(2.0, 3.0); 20]; 30];
    let clear = cleared(tracks, 10.0);
    assert!(nearest_m(&clear) >= 0.36 - 1e-9, "{}", nearest_m(&clear));
}

/// From one place to another and there at rest, as formations go.
fn gently(from: [f64; 2], to: [f64; 2], moments: usize) -> Vec<Vec2> {
    let (from, to) = (Vec2::from(from), Vec2::from(to));
    let share = |k: usize| k as f64 / (moments - 1) as f64;
    (0..moments).map(|k| from.lerp(to, share(k) * share(k) * (3.0 - 2.0 * share(k)))).collect()
}

#[test]
fn however_crowded_it_is_nobody_overlaps_or_jumps() {
    for fps in [10.0, 25.0] {
        let moments = |seconds: f64| (seconds * fps) as usize + 1;
        let through_a_point = (0..60).map(|k| {
            let (sin, cos) = sin_cos(k as f64 * std::f64::consts::TAU / 60.0);
            gently([5.0 * cos, 5.0 * sin], [-5.0 * cos, -5.0 * sin], moments(8.0))
        });
        let grids = (0..72).map(|k| {
            let (x, y, side) = ((k % 6) as f64 * 0.4, (k / 6 % 6) as f64 * 0.4, if k < 36 { 5.0 } else { -5.0 });
            gently([x - side, y], [x + side, y + 0.02 * side], moments(8.0))
        });
        let squeezed = (0..30).map(|k| {
            let mut track = gently([k as f64 * 0.6, 0.0], [k as f64 * 0.2, 0.0], moments(5.0));
            track.extend([vec2(k as f64 * 0.2, 0.0); 30]);
            track
        });
        for (crowd, tracks) in [
            ("through a point", through_a_point.collect::<Vec<_>>()),
            ("grids through each other", grids.collect()),
            ("a line squeezed", squeezed.collect()),
        ] {
            let clear = cleared(tracks, fps);
            assert!(nearest_m(&clear) >= 0.36 - 1e-9, "{crowd}, {fps}: {}", nearest_m(&clear));
            let hardest = hardest_m_s2(&clear, fps);
            assert!(hardest < 21.0, "{crowd}, {fps}: {hardest} m/s2");
        }
    }
}

/// Keeps what it is warned of.
#[derive(Default)]
struct Warned(std::sync::Mutex<Vec<String>>);

impl Progress for Warned {
    fn advance(&self, _stage: crate::Stage, _share: f64) {}
    fn warn(&self, message: &str) {
        self.0.lock().unwrap().push(message.to_string());
    }
}

#[test]
fn where_there_is_no_time_to_make_room_it_says_where_and_when_instead_of_jumping() {
    // People who wait far from each other are all in one place for a tenth of a second.
    let tracks: Vec<Vec<Vec2>> = (0..100)
        .map(|k| {
            let mut track = vec![vec2(3.0 * f64::from(k), 0.0); 81];
            track[40] = vec2(150.0, 1.0);
            track
        })
        .collect();
    let mut bodies: Vec<FormationBody> = tracks.iter().cloned().map(person).collect();
    let warned = Warned::default();
    keep_clear(&AvoidanceSettings::new(&AvoidRequest::default(), 10.0, &[]), &mut bodies, &warned).unwrap();
    let offsets: Vec<Vec<Vec2>> = bodies
        .iter()
        .zip(&tracks)
        .map(|(body, track)| body.places.iter().zip(track).map(|(&place, &asked)| place - asked).collect())
        .collect();
    assert!(hardest_m_s2(&offsets, 10.0) < 25.0, "{}", hardest_m_s2(&offsets, 10.0));
    let warned = warned.0.into_inner().unwrap();
    let says = |part: &str| warned.iter().any(|warning| warning.contains(part));
    assert!(warned.len() == 1 && says("at 4.0 s near [150"), "{warned:?}");
    // Nobody is warned of a crowd that has room.
    let mut bodies: Vec<FormationBody> = tracks.iter().map(|track| person(track[..40].to_vec())).collect();
    let silent = Warned::default();
    keep_clear(&AvoidanceSettings::new(&AvoidRequest::default(), 10.0, &[]), &mut bodies, &silent).unwrap();
    assert!(silent.0.into_inner().unwrap().is_empty());
}

#[test]
fn nobody_moves_who_has_room_and_nobody_at_all_where_it_is_off() {
    let tracks = vec![line([0.0, 0.0], [5.0, 0.0], 31), line([0.0, 3.0], [5.0, 3.0], 31)];
    assert_eq!(cleared(tracks.clone(), 10.0), tracks);
    let through = vec![line([0.0, 0.0], [5.0, 0.0], 31), line([5.0, 0.0], [0.0, 0.0], 31)];
    let mut bodies: Vec<FormationBody> = through.iter().cloned().map(person).collect();
    let off = AvoidRequest { on: Some(false), ..AvoidRequest::default() };
    keep_clear(&AvoidanceSettings::new(&off, 10.0, &[]), &mut bodies, &Silent).unwrap();
    assert!(bodies.iter().zip(&through).all(|(body, track)| body.places == *track));
}

#[test]
fn neighbours_push_in_inverse_proportion_and_less_at_a_key_formation() {
    // Two who stand a little apart all the time: spring and push are in balance.
    let tracks = vec![vec![vec2(0.0, 0.0); 201], vec![vec2(0.5, 0.0); 201]];
    let clear = cleared(tracks, 10.0);
    let moved_m = |moment: usize| -clear[0][moment].x;
    let apart_m = clear[1][100].x - clear[0][100].x;
    let force = 0.02 * (1.0 / apart_m - 1.0 / (2.5 * 0.36));
    assert!((moved_m(100) - force).abs() < 1e-3, "{} m for {force}", moved_m(100));
    assert!(moved_m(0) < 0.8 * moved_m(100), "{} m", moved_m(0));
}

#[test]
fn those_who_keep_together_are_led_past_others_as_one() {
    let avoid = AvoidRequest::default();
    let who = || FormedPerson { address: vec![0], rides: false, stature_m: None };
    let still = |x: f64, y: f64| FormationBody::person(vec![vec2(x, y); 101], who(), &avoid);
    let trio = vec![still(0.0, 0.4), still(-0.35, -0.2), still(0.35, -0.2)];
    let walk = line([-6.0, 0.1], [6.0, 0.1], 101);
    let mut bodies = vec![FormationBody::of_all(trio, walk), still(0.0, 0.0)];
    keep_clear(&AvoidanceSettings::new(&avoid, 10.0, &[]), &mut bodies, &Silent).unwrap();
    assert!(bodies[0].people.len() == 3 && bodies[0].people[0].offsets == vec![vec2(0.0, 0.4); 101]);
    for moment in 0..101 {
        let apart_m = bodies[0].places[moment].distance(bodies[1].places[moment]);
        assert!(apart_m >= bodies[0].reach_m(moment) + 0.18 - 1e-9, "{moment}: {apart_m} m");
    }
}

#[test]
fn the_same_whatever_the_number_of_threads() {
    let mut words = SplitMix64::new(8);
    let mut point = || [f64::from(words.range(-3.0, 3.0)), f64::from(words.range(-3.0, 3.0))];
    let tracks: Vec<Vec<Vec2>> = (0..20).map(|_| line(point(), point(), 61)).collect();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| cleared(tracks.clone(), 10.0))
    };
    assert_eq!(with(1), with(3));
}
