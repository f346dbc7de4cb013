use super::*;
use crate::math::{Vec2, sin_cos, vec2};
use crate::motion::Ensemble;
use crate::progress::Silent;

mod crowds;
mod mistakes;
mod mixing;
mod stability;

use crowds::{sideways, to_the_centre, wild};

fn find(ensemble: &Ensemble, method: Method) -> Features {
    Features::find(ensemble, &FeaturesOptions { method, ..FeaturesOptions::default() }, &Silent).unwrap()
}

/// The largest distance between somebody's places in two motions, metres.
fn apart(a: &Ensemble, b: &Ensemble) -> f64 {
    assert_eq!((a.people(), a.moments()), (b.people(), b.moments()));
    let at = |moment: usize| a.places_at(moment).iter().zip(b.places_at(moment));
    (0..a.moments()).flat_map(|moment| at(moment).map(|(a, b)| a.distance(*b))).fold(0.0, f64::max)
}

/// The root of the mean square distance between somebody's places in two motions, metres.
fn missed(a: &Ensemble, b: &Ensemble) -> f64 {
    let at = |moment: usize| a.places_at(moment).iter().zip(b.places_at(moment));
    let squares: f64 = (0..a.moments()).flat_map(|m| at(m).map(|(a, b)| (*a - *b).length_squared())).sum();
    (squares / (a.people() * a.moments()) as f64).sqrt()
}

/// Everybody's velocities relative to the middle, from a moment to the next.
fn velocities(ensemble: &Ensemble, moment: usize) -> Vec<Vec2> {
    let relative = |moment: usize| {
        let centroid = ensemble.centroid_m(moment);
        ensemble.places_at(moment).iter().map(move |&place| place - centroid)
    };
    relative(moment).zip(relative(moment + 1)).map(|(now, then)| (then - now) * ensemble.fps).collect()
}

/// Everybody's mean place relative to the middle.
fn formation(ensemble: &Ensemble) -> Vec<Vec2> {
    let moments = ensemble.moments();
    let mut mean = vec![Vec2::ZERO; ensemble.people()];
    for moment in 0..moments {
        let centroid = ensemble.centroid_m(moment);
        mean.iter_mut().zip(ensemble.places_at(moment)).for_each(|(sum, &place)| *sum += place - centroid);
    }
    mean.into_iter().map(|sum| sum / moments as f64).collect()
}

#[test]
fn the_error_falls_with_every_component_to_nothing() {
    for (people, moments) in [(12, 90), (30, 20), (2, 50), (3, 2)] {
        let crowd = wild(people, moments);
        for method in Method::ALL {
            let features = find(&crowd, method);
            let all = features.components().len();
            let mut before = f64::INFINITY;
            for components in 1..=all {
                let error_m = missed(&features.rebuild(components).unwrap(), &crowd);
                assert!(error_m <= before + 1e-12, "{method:?} {people} {moments} {components}");
                // What the variances promise is what comes out.
                assert!((error_m - features.rebuild_error_m(components)).abs() < 1e-9);
                before = error_m;
            }
            assert!(apart(&features.rebuild(all).unwrap(), &crowd) < 1e-9, "{method:?} {people} {moments}");
            let shares: f64 = features.components().iter().map(|component| component.share).sum();
            assert!((shares - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn far_from_the_origin_all_components_are_still_the_motion() {
    let mut crowd = wild(10, 60);
    for moment in 0..60 {
        crowd.places_at_mut(moment).iter_mut().for_each(|place| *place += vec2(5e5, 5e6));
    }
    for method in Method::ALL {
        let features = find(&crowd, method);
        assert!(apart(&features.rebuild(features.components().len()).unwrap(), &crowd) < 3e-9);
    }
}

#[test]
fn a_motion_of_three_components_has_three() {
    // Everybody's displacement is a fixed pattern times a course of time, thrice, with falling size.
    let pattern = |person: usize, which: usize| {
        vec2(((person * (which + 2) * 7) % 5) as f64 - 2.0, ((person + which) % 3) as f64)
    };
    let course =
        |moment: usize, which: usize| sin_cos(moment as f64 * 0.1 * (which + 1) as f64).0 / [1.0, 4.0, 20.0][which];
    let place = |moment: usize, person: usize| {
        (0..3).fold(vec2(person as f64, 0.3 * moment as f64), |sum, which| {
            sum + pattern(person, which) * course(moment, which)
        })
    };
    let places = (0..200).flat_map(|moment| (0..9).map(move |person| place(moment, person))).collect();
    let features = find(&Ensemble::new(10.0, 0.0, (0..9).collect(), places), Method::Pca);
    assert_eq!(features.components().len(), 3);
    assert!(features.components().windows(2).all(|pair| pair[0].share > pair[1].share));
    assert!(features.rebuild_error_m(3) == 0.0 && features.rebuild_error_m(2) > 0.01);
}

#[test]
fn the_path_of_the_middle_is_kept() {
    let crowd = wild(8, 40);
    for method in Method::ALL {
        let rebuilt = find(&crowd, method).rebuild(1).unwrap();
        for moment in 0..40 {
            assert!(rebuilt.centroid_m(moment).distance(crowd.centroid_m(moment)) < 1e-9);
        }
        assert_eq!((rebuilt.fps, rebuilt.start_s, &rebuilt.ids), (crowd.fps, crowd.start_s, &crowd.ids));
    }
}

#[test]
fn twice_the_coefficients_are_twice_the_velocities() {
    let twice = Modulation::of(Rule::scale("all=2.0").unwrap());
    for crowd in [wild(15, 60), sideways(20), to_the_centre(20)] {
        for method in Method::ALL {
            let features = find(&crowd, method);
            let made = features.modulated(features.components().len(), &twice).unwrap();
            for moment in 0..crowd.moments() - 1 {
                for (twice, once) in velocities(&made, moment).into_iter().zip(velocities(&crowd, moment)) {
                    assert!((twice - once * 2.0).length() < 1e-9, "{method:?}");
                }
            }
            let (mean, made_mean) = (formation(&crowd), formation(&made));
            assert!(mean.iter().zip(&made_mean).all(|(a, b)| a.distance(*b) < 1e-9), "the formation stays");
        }
    }
}

#[test]
fn a_sine_makes_the_motion_periodic() {
    // Times a sine, everybody is back at their mean place every half period, and in between goes to and fro.
    let crowd = sideways(20);
    let (period_s, fps) = (5.0, crowd.fps);
    let mean = formation(&crowd);
    for method in Method::ALL {
        let features = find(&crowd, method);
        let all = features.components().len();
        let made = features.modulated(all, &Modulation::of(Rule::scale("all=sin(2*pi*t/5)").unwrap())).unwrap();
        let displaced = |moment: usize, person: usize| {
            (made.places_at(moment)[person] - made.centroid_m(moment) - mean[person]).dot(vec2(1.0, 0.0))
        };
        let half = (period_s * fps / 2.0) as usize;
        for moment in (0..made.moments()).step_by(half) {
            assert!((0..20).all(|person| displaced(moment, person).abs() < 1e-9), "{method:?} {moment}");
        }
        for person in 0..20 {
            let side = |k: usize| displaced(k * half + half / 2, person).signum();
            assert!(side(0) != side(1) && side(2) != side(3), "{method:?}: to and fro");
        }
        // Put in the coefficients' place, a sine comes again exactly.
        let rule = Rule::set("1=sd*sqrt(2)*sin(2*pi*t/5)").unwrap();
        let made = features.modulated(1, &Modulation::of(rule)).unwrap();
        for moment in 0..made.moments() - 1 - 2 * half {
            for (now, then) in velocities(&made, moment).into_iter().zip(velocities(&made, moment + 2 * half)).take(5) {
                assert!((now - then).length() < 1e-9, "{method:?}");
            }
        }
        assert!(velocities(&made, 0)[0].length() > 0.01);
    }
}

#[test]
fn one_component_can_be_taken_out() {
    let crowd = wild(10, 50);
    let features = find(&crowd, Method::Pca);
    let all = features.components().len();
    let without = features.modulated(all, &Modulation::of(Rule::scale("1=0").unwrap())).unwrap();
    let expected = (features.components()[0].variance_m2 / 10.0).sqrt();
    assert!((missed(&without, &crowd) - expected).abs() < 1e-9);
    let left = find(&without, Method::Pca);
    assert_eq!(left.components().len(), all - 1);
    assert!((left.components()[0].variance_m2 - features.components()[1].variance_m2).abs() < 1e-9);
}

#[test]
fn the_same_crowd_has_the_same_features_on_any_number_of_threads() {
    let crowd = wild(40, 120);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        Method::ALL.map(|method| pool.install(|| find(&crowd, method).rebuild(5).unwrap()))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn who_never_changes_neighbours_is_ordered_by_motion() {
    // Two groups far apart; in one, neighbours change, in the other everybody moves, ever farther, without neighbours.
    let place = |moment: usize, person: usize| {
        let t = moment as f64 * 0.1;
        match person {
            0 => vec2(0.0, 0.0),
            1 => vec2(1.0 + t, 0.0),
            2 => vec2(0.5, 1.0),
            _ => vec2(100.0 + 30.0 * person as f64, t * (person - 2) as f64),
        }
    };
    let places = (0..40).flat_map(|moment| (0..7).map(move |person| place(moment, person))).collect();
    let features = find(&Ensemble::new(10.0, 0.0, (0..7).collect(), places), Method::Laplacian);
    let zeros = features.components().iter().position(|component| component.eigenvalue == 0.0).unwrap();
    assert!((1..=2).contains(&zeros), "{zeros}");
    let rest: Vec<f64> = features.components()[zeros..].iter().map(|component| component.variance_m2).collect();
    assert!(rest.windows(2).all(|pair| pair[0] >= pair[1] - 1e-12), "{rest:?}");
    assert_eq!(features.components().len(), 7);
    assert!(features.mean_neighbours().unwrap() < 1.0);
}

/// `cargo test --release --lib -- --ignored 500_people`; the bench `motion` tells how long it takes.
#[test]
#[ignore = "takes its time when unoptimised"]
fn features_of_500_people_at_2000_moments() {
    for (people, moments) in [(500, 2000), (500, 500)] {
        let crowd = wild(people, moments);
        for method in Method::ALL {
            let features = find(&crowd, method);
            let rebuilt = features.rebuild(features.components().len()).unwrap();
            assert!(apart(&rebuilt, &crowd) < 1e-9, "{people} x {moments} {method:?}");
        }
    }
}
