use super::*;
use crate::Silent;
use crate::math::{Vec2, vec2};
use crate::motion::Ensemble;
use crate::units::SpotFrame;

/// People who walk past a spot at [10, 10] whose viewer looks to the east: two side by side towards the viewer, one who
/// comes later from the north and stops there, and one who walks by far off.
fn walked() -> Ensemble {
    let at = |k: usize| -> Vec<Vec2> {
        let t = k as f64 * 0.1;
        let stops = |t: f64| if t < 15.0 { 16.0 - t } else { (1.0 - 0.02 * (t - 15.0)).max(0.6) };
        vec![
            vec2(22.0 - 1.3 * t, 11.0 + 0.04 * crate::math::sin_cos(6.3 * t).0),
            vec2(22.0 - 1.3 * t, 10.55),
            vec2(12.0, 9.4 + stops(t)),
            vec2(30.0 - t, 40.0),
        ]
    };
    Ensemble::new(10.0, 0.0, vec![3, 5, 7, 9], (0..250).flat_map(at).collect())
}

fn spot() -> SpotFrame {
    SpotFrame { at_m: vec2(10.0, 10.0), ahead: vec2(1.0, 0.0) }
}

#[test]
fn those_who_pass_become_units_with_their_groups() {
    let cuts = cut(&mut walked().motion(), "street", spot(), &CutOptions::default(), &Silent).unwrap().cuts;
    let found: Vec<_> = cuts.iter().map(|cut| (&cut.ids, cut.start_s, cut.unit.composition())).collect();
    assert!(!found.is_empty() && found.iter().any(|cut| cut.0 == &[3, 5]), "{found:?}");
    let pair = cuts.iter().find(|cut| cut.ids == [3, 5]).expect("the pair is one unit");
    assert_eq!(pair.unit.composition(), [vec![2], vec![]]);
    assert!(pair.start_s > 6.5 && pair.start_s < 9.5, "{}", pair.start_s);
    let start = pair.unit.moment(0, 0.0, false);
    // To the east is ahead, north of the spot is the viewer's left.
    assert!((start.place_m.x + 1.0).abs() < 0.06 && start.place_m.y > 1.0, "{start:?}");
    assert!((start.velocity_m_s.y + 1.3).abs() < 0.02 && start.heading.y < -0.99, "{start:?}");
    // The head's sway is smoothed, the way is not.
    let sway = (0..30).map(|k| (pair.unit.moment(0, f64::from(k) * 0.1, false).place_m.x + 1.0).abs());
    assert!(sway.fold(0.0, f64::max) < 0.03);
    let alone = cuts.iter().find(|cut| cut.ids == [7]).expect("who stops is a unit");
    assert!(alone.unit.duration_s > 5.0 && alone.unit.name.starts_with("street "));
    assert!(cuts.windows(2).all(|pair| pair[0].interest_bits >= pair[1].interest_bits));
    assert!(cuts.iter().all(|cut| !cut.ids.contains(&9)));
    let diversity = cut(&mut walked().motion(), "street", spot(), &CutOptions::default(), &Silent).unwrap().diversity;
    assert!(diversity.speed_bits > 0.5 && diversity.heading_bits > 0.5 && diversity.samples > 100, "{diversity:?}");
}

#[test]
fn who_comes_near_ends_a_unit() {
    let near = CutOptions { apart_m: 6.0, ..CutOptions::default() };
    let cuts = cut(&mut walked().motion(), "street", spot(), &near, &Silent).unwrap().cuts;
    assert!(cuts.iter().all(|cut| cut.start_s + cut.unit.duration_s < 11.0 || cut.start_s > 10.0), "{cuts:?}");
}

#[test]
fn a_spot_where_nobody_comes_and_wrong_options_are_errors() {
    let far = SpotFrame { at_m: vec2(500.0, 10.0), ahead: vec2(1.0, 0.0) };
    let error = cut(&mut walked().motion(), "street", far, &CutOptions::default(), &Silent).unwrap_err();
    assert!(error.to_string().contains("[500.00, 10.00]") && error.hint().is_some(), "{error}");
    let wrong = CutOptions { least_s: f64::NAN, ..CutOptions::default() };
    let error = cut(&mut walked().motion(), "street", spot(), &wrong, &Silent).unwrap_err();
    assert!(error.to_string().starts_with("the shortest time is NaN"), "{error}");
}
