//! What cannot be interpolated is refused, with what is wrong and what to do.

use trodden::formation::{
    AdjacencyEdit, Basis, FormationError, FormationOptions, KeyFormation, MOST_PEOPLE, interpolate, sphere_tracks,
};
use trodden::math::{Vec2, vec2};
use trodden::motion::Ensemble;
use trodden::{Progress, Silent, Stage};

use super::crowds::{grid, walking};

fn keys() -> Vec<KeyFormation> {
    [2.0, 4.0].map(|time_s| KeyFormation { time_s, places_m: grid(4, 2, 1.0) }).to_vec()
}

/// What is said of an example of four people in 2 to 4 s if something is wrong.
fn refused(example: &Ensemble, keys: &[KeyFormation], options: &FormationOptions) -> FormationError {
    let error = interpolate(example, keys, options, &Silent).unwrap_err();
    assert!(error.to_string().len() > 20);
    error
}

#[test]
fn keys_that_do_not_fit() {
    let example = walking(&grid(4, 2, 1.0), 5.0, 2.0, 1);
    let case = |change: &dyn Fn(&mut Vec<KeyFormation>)| {
        let mut keys = keys();
        change(&mut keys);
        refused(&example, &keys, &FormationOptions::default()).to_string()
    };
    let says = |message: String, part: &str| assert!(message.contains(part), "{message}");
    says(case(&|keys| keys.truncate(1)), "1 key formations are too few");
    says(case(&|keys| keys.clear()), "0 key formations are too few");
    says(case(&|keys| keys[1].places_m.push(Vec2::ZERO)), "key formation 2 at 4 s has 5 positions for the 4 people");
    says(case(&|keys| keys[0].places_m.clear()), "key formation 1 at 2 s has 0 positions");
    says(case(&|keys| keys[1].places_m[3].y = f64::NAN), "key formation 2: y of place 3 is NaN");
    says(case(&|keys| keys[0].places_m[0].x = 1e300), "key formation 1: x of place 0 is 1");
    says(case(&|keys| keys[1].time_s = f64::INFINITY), "key formation 2: its time is inf");
    says(case(&|keys| keys.swap(0, 1)), "key formation 2 at 2 s does not come after the one before it, at 4 s");
    says(case(&|keys| keys[1].time_s = 2.0), "key formation 2 at 2 s does not come after");
    says(case(&|keys| keys[1].time_s = 2.05), "fall into one frame of the example, which has 5 frames per second");
    says(
        case(&|keys| keys[1].time_s = 4.2),
        "key formation 2 is at 4.2 s, but the example lasts from 2.000 to 4.000 s",
    );
    says(case(&|keys| keys[0].time_s = -1e6), "key formation 1 is at -1000000 s, but");
}

#[test]
fn examples_that_do_not_do() {
    let example = |people: usize, fps: f64, change: &dyn Fn(&mut Vec<Vec2>)| {
        let mut places_m = vec![vec2(1.0, 2.0); people * 11];
        change(&mut places_m);
        Ensemble::new(fps, 2.0, (0..people as u32).collect(), places_m)
    };
    let said = |example: &Ensemble| refused(example, &keys(), &FormationOptions::default());
    assert_eq!(said(&example(1, 5.0, &|_| ())).to_string(), FormationError::TooFew { people: 1, least: 2 }.to_string());
    assert_eq!(
        said(&Ensemble::new(5.0, 0.0, vec![], vec![])).to_string(),
        FormationError::TooFew { people: 0, least: 2 }.to_string()
    );
    let huge = Ensemble::new(5.0, 0.0, (0..5000).collect(), vec![Vec2::ZERO; 5000]);
    assert_eq!(said(&huge).to_string(), FormationError::TooMany { people: 5000, most: MOST_PEOPLE }.to_string());
    let nowhere = said(&example(4, 5.0, &|places| places[9].x = f64::NAN));
    assert!(nowhere.to_string().contains("person 1 at (NaN, 2) m at 2.4 s"), "{nowhere}");
    for fps in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(said(&example(4, fps, &|_| ())), FormationError::ExampleTime { .. }));
    }
    let empty = Ensemble::new(5.0, 0.0, vec![1, 2, 3, 4], vec![]);
    assert!(matches!(said(&empty), FormationError::ExampleTime { .. }));
    assert!(sphere_tracks(&example(4, 5.0, &|_| ()), None).is_err());
    assert!(sphere_tracks(&example(2, 5.0, &|_| ()), None).is_err());
    assert!(sphere_tracks(&example(3, 5.0, &|_| ()), Some(0.0)).is_err());
    assert!(Basis::of(&[], 1.0, &[]).is_err());
    assert!(Basis::of(&[Vec2::ZERO, vec2(f64::NAN, 0.0)], 1.0, &[]).is_err());
}

#[test]
fn options_out_of_range() {
    let example = walking(&grid(4, 2, 1.0), 5.0, 2.0, 1);
    let said = |change: &dyn Fn(&mut FormationOptions)| {
        let mut options = FormationOptions::default();
        change(&mut options);
        refused(&example, &keys(), &options).to_string()
    };
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(said(&|o| o.sigma_m = Some(value)).contains("sigma is"));
    }
    assert!(said(&|o| o.decompositions = Some(1)).contains("the number of decompositions is 1"));
    assert!(said(&|o| o.fluctuation = f64::NAN).contains("the factor on the fluctuation is NaN"));
    assert!(said(&|o| o.nearness = 0.0).contains("nearness is 0"));
    assert!(said(&|o| o.following_s = -1.0).contains("the time of following is -1"));
    let edit = AdjacencyEdit { members: vec![0, 4], weight: 1.0 };
    let named = said(&|o| o.adjacency = vec![edit.clone()]);
    assert!(named.contains("adjacency 1: person 4 is named, but the last of the 4 people is 3"), "{named}");
}

#[test]
fn all_on_one_point_all_the_time() {
    let point = vec![vec2(5.0, 5.0); 6];
    let example = Ensemble::new(5.0, 2.0, (0..6).collect(), vec![vec2(1.0, 1.0); 6 * 11]);
    let keys = [2.0, 4.0].map(|time_s| KeyFormation { time_s, places_m: point.clone() });
    for decompositions in [None, Some(5), Some(usize::MAX)] {
        let options = FormationOptions { decompositions, ..FormationOptions::default() };
        let motion = interpolate(&example, &keys, &options, &Silent).unwrap();
        for moment in 0..motion.moments() {
            assert!(motion.places_at(moment).iter().all(|place| place.distance(point[0]) < 1e-9));
        }
    }
}

#[test]
fn it_can_be_interrupted() {
    struct Impatient;
    impl Progress for Impatient {
        fn advance(&self, _: Stage, _: f64) {}
        fn warn(&self, _: &str) {}
        fn interrupted(&self) -> bool {
            true
        }
    }
    let example = walking(&grid(4, 2, 1.0), 5.0, 2.0, 1);
    for decompositions in [None, Some(5)] {
        let options = FormationOptions { decompositions, ..FormationOptions::default() };
        let error = interpolate(&example, &keys(), &options, &Impatient).unwrap_err();
        assert!(matches!(error, FormationError::Interrupted(_)));
    }
}
