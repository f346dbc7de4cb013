//! What cannot be worked on says so.

use super::*;
use crate::features::FeaturesError;

fn mistake(result: Result<Features, FeaturesError>) -> FeaturesError {
    result.expect_err("a mistake")
}

fn of(ensemble: &Ensemble, options: &FeaturesOptions) -> FeaturesError {
    mistake(Features::find(ensemble, options, &Silent))
}

fn still(people: usize, moments: usize, path: impl Fn(usize) -> Vec2) -> Ensemble {
    let places =
        (0..moments).flat_map(|m| (0..people).map(|p| path(m) + vec2(p as f64, 0.1)).collect::<Vec<_>>()).collect();
    Ensemble::new(10.0, 0.0, (0..people as u32).collect(), places)
}

#[test]
fn too_little_is_refused() {
    let options = FeaturesOptions::default();
    assert_eq!(of(&wild(1, 50), &options).to_string(), FeaturesError::TooFew { people: 1, least: 2 }.to_string());
    assert_eq!(
        of(&Ensemble::new(10.0, 0.0, vec![], vec![]), &options).to_string(),
        FeaturesError::TooFew { people: 0, least: 2 }.to_string()
    );
    assert_eq!(of(&wild(5, 1), &options).to_string(), FeaturesError::SingleMoment.to_string());
    assert!(of(&wild(5, 1), &options).hint().is_some());
}

#[test]
fn a_crowd_that_only_moves_as_a_whole_is_refused() {
    for method in Method::ALL {
        let options = FeaturesOptions { method, ..FeaturesOptions::default() };
        assert_eq!(of(&still(6, 40, |_| Vec2::ZERO), &options).to_string(), FeaturesError::Still.to_string());
        assert_eq!(
            of(&still(6, 40, |m| vec2(0.1337 * m as f64, 4.9e6)), &options).to_string(),
            FeaturesError::Still.to_string()
        );
        assert!(Features::find(&still(6, 40, |_| Vec2::ZERO), &options, &Silent).is_err());
    }
}

#[test]
fn places_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, -1e9] {
        let mut crowd = wild(6, 20);
        crowd.places_at_mut(7)[2].y = bad;
        for method in Method::ALL {
            match of(&crowd, &FeaturesOptions { method, ..FeaturesOptions::default() }) {
                FeaturesError::NoPlace { id: 12, time_s, .. } => assert!((time_s - 3.7).abs() < 1e-9),
                other => panic!("{other}"),
            }
        }
    }
}

#[test]
fn neighbours_need_a_distance() {
    for neighbour_distance_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = FeaturesOptions { method: Method::Laplacian, neighbour_distance_m };
        assert!(matches!(of(&wild(5, 9), &options), FeaturesError::NeighbourDistance { .. }));
    }
}

#[test]
fn components_out_of_range_are_refused() {
    for method in Method::ALL {
        let features = find(&wild(5, 40), method);
        let most = features.components().len();
        for asked in [0, most + 1, usize::MAX] {
            assert_eq!(
                features.rebuild(asked).unwrap_err().to_string(),
                FeaturesError::Components { asked, most }.to_string()
            );
        }
        let rule = Modulation::of(Rule::scale("4=2").unwrap());
        assert_eq!(
            features.modulated(3, &rule).unwrap_err().to_string(),
            FeaturesError::Components { asked: 4, most: 3 }.to_string()
        );
    }
}

#[test]
fn coefficients_out_of_range_are_refused() {
    let features = find(&wild(5, 40), Method::Laplacian);
    let made = |text: &str| features.modulated(2, &Modulation::of(Rule::scale(text).unwrap()));
    let error = made("2=1/(t-1)").unwrap_err();
    assert!(matches!(&error, FeaturesError::Coefficient { component: 2, t_s, .. } if *t_s == 1.0), "{error}");
    assert!(made("all=1e200").is_err());
    assert!(made("all=1/(t-1.05)").is_ok());
}

#[test]
fn too_much_is_refused() {
    let crowd = still(MOST_ROWS + 1, 2, |m| vec2(m as f64, 0.0));
    let mut moving = crowd.clone();
    moving.places_at_mut(1)[0].x += 1.0;
    // Many people at a few moments are no problem for principal components.
    assert_eq!(find(&moving, Method::Pca).components().len(), 1);
    let size = MOST_ROWS + 1;
    let found = mistake(
        super::super::eigen::eigenpairs(
            nalgebra::DMatrix::zeros(size, size),
            &super::super::progress_range::ProgressRange::whole(&Silent),
        )
        .map(|_| unreachable!()),
    );
    assert_eq!(found.to_string(), FeaturesError::TooLarge { size, most: MOST_ROWS }.to_string());
}
