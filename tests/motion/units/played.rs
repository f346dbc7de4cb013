use std::sync::OnceLock;

use trodden::crowd::SpotRequest;
use trodden::units::DiversityReport;

use super::scene::{Run, Scene, Seen};

/// Time step of the sample, seconds.
const STEP_S: f64 = 0.1;
/// The hardest that anybody speeds up, brakes or turns who plays: what units allow themselves and what moving over may
/// add, metres per second squared.
const HARDEST_M_S2: f64 = 3.4;

/// Both minutes with units.
fn with() -> &'static Run {
    static RUN: OnceLock<Run> = OnceLock::new();
    RUN.get_or_init(|| {
        let scene = Scene::plaza();
        scene.run(scene.spot(), 120.0)
    })
}

/// The same without.
fn without() -> &'static Run {
    static RUN: OnceLock<Run> = OnceLock::new();
    RUN.get_or_init(|| {
        let scene = Scene::plaza();
        scene.run(SpotRequest { play: false, ..scene.spot() }, 120.0)
    })
}

/// Two minutes of other crowds: with units and without. Whichever they are.
fn others() -> &'static [[Run; 2]] {
    static RUNS: OnceLock<Vec<[Run; 2]>> = OnceLock::new();
    RUNS.get_or_init(|| {
        let scene = Scene::plaza();
        let run = |seed, play| scene.run_with(SpotRequest { play, ..scene.spot() }, 120.0, seed);
        (2..=4).map(|seed| [run(seed, true), run(seed, false)]).collect()
    })
}

fn find(moment: &[Seen], id: u32) -> Option<&Seen> {
    moment.binary_search_by_key(&id, |seen| seen.id).ok().map(|at| &moment[at])
}

/// Everybody's successive moments of which in one they are led.
fn led_steps(moments: &[Vec<Seen>]) -> impl Iterator<Item = (usize, &Seen, &Seen)> {
    moments.windows(2).enumerate().flat_map(|(k, pair)| {
        let steps = pair[0].iter().filter_map(|before| Some((before, find(&pair[1], before.id)?)));
        steps.filter(|(before, after)| before.led || after.led).map(move |(before, after)| (k, before, after))
    })
}

#[test]
fn units_are_spliced_in_without_a_jump_and_left_without_one() {
    let (moments, _) = with();
    let mut steps = 0;
    for (k, before, after) in led_steps(moments) {
        steps += 1;
        let harder = after.velocity_m_s.distance(before.velocity_m_s) / STEP_S;
        assert!(harder < HARDEST_M_S2, "person {} at step {k}: {harder:.2} m/s2", before.id);
        let way = after.place_m - before.place_m;
        let off_m = way.distance((before.velocity_m_s + after.velocity_m_s) * (0.5 * STEP_S));
        assert!(off_m < 0.005, "person {} at step {k} leaps by {off_m:.3} m", before.id);
        let turn = after.heading.distance(before.heading) / STEP_S;
        assert!(turn < 2.5, "person {} at step {k} turns by {turn:.2} rad/s", before.id);
    }
    assert!(steps > 2000, "{steps}");
}

/// How much room there is between somebody and who is nearest, metres.
fn gap_m(moment: &[Seen], me: &Seen) -> f64 {
    let others = moment.iter().filter(|other| other.id != me.id);
    others.map(|other| me.place_m.distance(other.place_m) - me.radius_m - other.radius_m).fold(f64::INFINITY, f64::min)
}

/// In the first second by the model, after a part, nobody is moved harder than the model moves anybody, which is rarely as
/// hard, unless they bump into somebody; that too is rare.
#[test]
fn people_walk_on_from_the_place_and_the_velocity_that_they_have() {
    const HARDEST_M_S2: f64 = 5.1;
    let (mut ended, mut bumps, mut sum, mut count) = (0, 0, 0.0, 0.0);
    let others = others().iter().map(|runs| &runs[0].0);
    for moments in std::iter::once(&with().0).chain(others) {
        for (k, last, first) in led_steps(moments).filter(|(_, before, after)| before.led && !after.led) {
            ended += 1;
            let mut before = first;
            for moment in moments[k + 2..].iter().take(10) {
                let Some(now) = find(moment, last.id).filter(|seen| !seen.led) else { break };
                let harder = now.velocity_m_s.distance(before.velocity_m_s) / STEP_S;
                let way = now.place_m - before.place_m;
                let off_m = way.distance((before.velocity_m_s + now.velocity_m_s) * (0.5 * STEP_S));
                (sum, count) = (sum + harder, count + 1.0);
                if gap_m(moment, now) < 0.06 {
                    bumps += u32::from(harder > HARDEST_M_S2);
                } else {
                    assert!(harder < HARDEST_M_S2, "person {} after step {k}: {harder:.2} m/s2", now.id);
                    assert!(off_m < 0.03, "person {} leaps by {off_m:.3} m after step {k}", now.id);
                }
                before = now;
            }
        }
    }
    let mean = sum / count;
    println!("{ended} parts ended; {mean:.2} m/s2 in the mean in the second after, {bumps} bumps");
    assert!(ended > 100 && bumps * 20 < ended && mean < 1.0, "{ended} {bumps} {mean}");
}

/// Nobody goes farther in a step than people walk, runners among them; nor do those who have just played stand in others.
#[test]
fn nobody_leaps_and_nobody_is_let_go_into_others() {
    // Who plays may run, and is up to 0.6 m/s faster while moving over; the model's people walk at 1.7 m/s, or 1.3 times that.
    let fastest_m_s = |led: bool| if led { 3.0 } else { 2.3 };
    let scene = Scene::plaza();
    let moments = &with().0;
    let mut let_go = 0;
    for (k, pair) in moments.windows(2).enumerate() {
        for before in &pair[0] {
            let Some(after) = find(&pair[1], before.id) else { continue };
            let way_m = after.place_m.distance(before.place_m);
            assert!(way_m <= fastest_m_s(before.led) * STEP_S, "person {} goes {way_m:.2} m in step {k}", after.id);
            assert!(scene.walls.sight(before.place_m, after.place_m), "person {} crosses a wall", after.id);
            if !before.led || after.led {
                continue;
            }
            let_go += 1;
            for moment in moments[k + 1..].iter().take(10) {
                let Some(me) = find(moment, after.id) else { break };
                for other in moment.iter().filter(|seen| seen.id != me.id) {
                    let gap_m = me.place_m.distance(other.place_m) - me.radius_m - other.radius_m;
                    assert!(gap_m > -0.03, "{} and {} overlap by {gap_m:.3} m", me.id, other.id);
                }
            }
        }
    }
    assert!(let_go > 20, "{let_go}");
}

#[test]
fn nobody_who_plays_overlaps_anybody_or_enters_a_wall() {
    let scene = Scene::plaza();
    let viewer = scene.spot().at.to_m(&scene.plan);
    for moment in &with().0 {
        for one in moment.iter().filter(|seen| seen.led) {
            for other in moment.iter().filter(|seen| seen.id != one.id) {
                let gap_m = one.place_m.distance(other.place_m) - one.radius_m - other.radius_m;
                assert!(gap_m > -0.005, "{} and {} overlap by {gap_m:.3} m", one.id, other.id);
            }
            assert!(one.place_m.distance(viewer) > 0.25 + one.radius_m);
            let clearance_m = scene.walls.nearest(one.place_m, 1.0).map_or(1.0, |nearest| nearest.distance_m);
            assert!(scene.walls.is_inside(one.place_m) && clearance_m > 0.2, "{clearance_m}");
        }
    }
}

#[test]
fn whoever_has_played_walks_on_by_the_model() {
    let (moments, report) = with();
    let mut ended = 0;
    for (k, before, after) in led_steps(moments) {
        if !before.led || after.led {
            continue;
        }
        ended += 1;
        // They are on their way again, wherever it turns.
        let places = moments[k + 1..].iter().take(31).filter_map(|moment| find(moment, after.id));
        let places: Vec<&Seen> = places.take_while(|seen| !seen.led).collect();
        if places.len() < 31 {
            continue;
        }
        let way_m: f64 = places.windows(2).map(|pair| pair[0].place_m.distance(pair[1].place_m)).sum();
        assert!(way_m > 1.0, "person {} has walked {way_m:.2} m in 3 s", after.id);
    }
    // The others are still at it when the time is over.
    let playing = moments.last().map_or(0, |moment| moment.iter().filter(|seen| seen.led).count());
    assert_eq!((ended + playing) as u64, report.people, "{ended} have ended, {playing} still play");
    assert!(ended > 8, "{ended}");
}

#[test]
fn the_report_says_what_was_played_and_how_far_off_it_began() {
    let (moments, report) = with();
    assert!(report.splices >= 20 && report.by_unit.len() >= 12, "{report:?}");
    assert_eq!(report.by_unit.values().sum::<u64>(), report.splices);
    assert!(report.people > report.splices && report.position_error_m.count == report.people);
    assert!(report.position_error_m.mean > 0.05 && report.position_error_m.largest <= 1.6, "{report:?}");
    assert!(report.heading_error_deg.mean > 0.5 && report.heading_error_deg.largest <= 60.01, "{report:?}");
    assert!(report.move_over_s.mean > 0.8 && report.move_over_s.largest <= 4.4);
    // Those who lead the way in the frames are those of the report.
    let led = moments.iter().flatten().filter(|seen| seen.led).count() as f64 * STEP_S;
    assert!((led - report.led_s).abs() < 0.2 * report.led_s, "{led} {}", report.led_s);
    assert!(report.led_m > 0.3 * report.led_s && report.led_m < 1.5 * report.led_s);
    assert_eq!(report.unmatched + report.too_far + report.in_the_way + report.not_free, report.moments);
    assert!(report.fitting[0] >= 40 && report.warning().is_none());
    let (moments, without) = without();
    assert_eq!((without.splices, without.led_s, without.fitting), (0, 0.0, [0, 0]));
    assert!(moments.iter().flatten().all(|seen| !seen.led));
}

/// What the paper claims: with units, motion near the viewer is not uniform. Every crowd that is tried has to agree.
#[test]
fn speeds_and_headings_near_the_viewer_differ_more_with_units() {
    let first = [with().1.diversity, without().1.diversity];
    let others = others().iter().map(|runs| [runs[0].1.diversity, runs[1].1.diversity]);
    let all: Vec<[DiversityReport; 2]> = std::iter::once(first).chain(others).collect();
    let mut headings = 0.0;
    for [with, without] in &all {
        assert!(without.samples > 3000 && with.samples > 3000);
        assert!(with.speed_bits > without.speed_bits + 0.1, "{with:?} {without:?}");
        let sum = |diversity: &DiversityReport| diversity.speed_bits + diversity.heading_bits;
        assert!(sum(with) > sum(without) + 0.3, "{with:?} {without:?}");
        headings += (with.heading_bits - without.heading_bits) / all.len() as f64;
    }
    assert!(headings > 0.1, "{headings}");
}

/// Whoever looks on sees units most of the time that anybody is there.
#[test]
fn units_are_played_most_of_the_time() {
    let others = others().iter().map(|runs| &runs[0]);
    for (_, report) in std::iter::once(with()).chain(others) {
        let share = report.played_s / report.there_s;
        assert!(report.there_s > 90.0 && (0.75..=1.0).contains(&share), "{share:.2} of {:.0} s", report.there_s);
        assert!(report.splices >= 20 && report.broken_off * 10 <= report.people, "{report:?}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let scene = Scene::plaza();
            let crowded = scene.run_many(scene.spot(), 20.0, 1, 320);
            [scene.run(scene.spot(), 30.0), crowded]
        })
    };
    let (one, four) = (run(1), run(4));
    // So many are moved by several threads.
    assert!(one[1].0.last().unwrap().len() > 300);
    assert!(one[0].1.splices > 0 && one[1].1.there_s > 10.0);
    assert!(one == four);
}
