//! One crowd with the features of two.

use super::*;

fn mix(first: &Ensemble, other: &Ensemble, method: Method) -> Mix {
    let options = FeaturesOptions { method, ..FeaturesOptions::default() };
    Mix::find(first, other, &options, MixOptions::default(), &Silent).unwrap()
}

/// How far people of the upper half go to the right and those of the lower half to the left, in the mean, metres.
fn sideways_m(crowd: &Ensemble) -> f64 {
    let relative = |moment: usize, person: usize| crowd.places_at(moment)[person] - crowd.centroid_m(moment);
    let last = crowd.moments() - 1;
    let gone = |person: usize| {
        let (from, to) = (relative(0, person), relative(last, person));
        (to - from).x * (from.y + to.y).signum()
    };
    (0..crowd.people()).map(gone).sum::<f64>() / crowd.people() as f64
}

/// How far people come towards the middle across that, in the mean, metres.
fn inwards_m(crowd: &Ensemble) -> f64 {
    let aside = |moment: usize| {
        let centroid = crowd.centroid_m(moment);
        let sum: f64 = crowd.places_at(moment).iter().map(|place| (place.y - centroid.y).abs()).sum();
        sum / crowd.people() as f64
    };
    aside(0) - aside(crowd.moments() - 1)
}

#[test]
fn sideways_and_towards_the_centre_is_both() {
    let (across, inward) = (sideways(24), to_the_centre(24));
    let (far_m, near_m) = (sideways_m(&across), inwards_m(&inward));
    assert!(far_m > 4.0 && inwards_m(&across).abs() < 0.2, "{far_m} {}", inwards_m(&across));
    assert!(near_m > 1.2 && sideways_m(&inward).abs() < 0.2, "{near_m} {}", sideways_m(&inward));
    // How many of the interleaved components it takes until the crowd does nine tenths of both.
    let needed = |method: Method| {
        let options = FeaturesOptions { method, neighbour_distance_m: 5.0 };
        let mixed = Mix::find(&across, &inward, &options, MixOptions::default(), &Silent).unwrap();
        let all = mixed.components().len();
        let found = (1..=all).find(|&components| {
            let made = mixed.rebuild(components).unwrap();
            let shares = [sideways_m(&made) / far_m, inwards_m(&made) / near_m];
            shares.iter().all(|share| (0.9..1.1).contains(share))
        });
        println!("{method:?}: {found:?} of {all}");
        found.unwrap() as f64 / all as f64
    };
    let [pca, laplacian] = Method::ALL.map(needed);
    assert!(pca < 0.1 && pca < laplacian && laplacian < 1.0, "{pca} {laplacian}");
}

#[test]
fn all_components_are_both_motions_on_top_of_each_other() {
    let (a, b) = (wild(12, 40), wild(12, 40));
    for method in Method::ALL {
        let mixed = mix(&a, &b, method);
        let all = mixed.components().len();
        // A crowd mixed with itself moves twice as far around its mean places.
        let twice = find(&a, method).modulated(all / 2, &Modulation::of(Rule::scale("all=2").unwrap())).unwrap();
        assert!(apart(&mixed.rebuild(all).unwrap(), &twice) < 1e-9);
        assert_eq!(mixed.left_out(), [0, 0]);
    }
}

#[test]
fn components_take_turns_by_eigenvalue() {
    let (small, mut large) = (sideways(12), to_the_centre(12));
    for moment in 0..large.moments() {
        large.places_at_mut(moment).iter_mut().for_each(|place| *place = *place * 10.0);
    }
    for (method, other) in [(Method::Pca, &large), (Method::Laplacian, &to_the_centre(12))] {
        let mixed = mix(&small, other, method);
        let order: Vec<_> = mixed.components().collect();
        let sums = [MixSource::First, MixSource::Other]
            .map(|whose| order.iter().filter(|of| of.0 == whose).map(|of| of.1.eigenvalue).sum::<f64>());
        for whose in [MixSource::First, MixSource::Other] {
            let own: Vec<f64> = order.iter().filter(|of| of.0 == whose).map(|of| of.1.eigenvalue).collect();
            assert_eq!(own.len(), mixed.features(whose).components().len());
            assert!(own.windows(2).all(|pair| pair[0] >= pair[1]));
        }
        // Ten times the size does not put one crowd before the other: each has its share.
        let shares: Vec<f64> = order.iter().map(|of| of.1.eigenvalue / sums[of.0 as usize]).collect();
        assert!(shares.windows(2).all(|pair| pair[0] >= pair[1] - 1e-12), "{shares:?}");
        if method == Method::Pca {
            assert_ne!(order[0].0, order[1].0);
        }
    }
}

#[test]
fn people_are_matched_and_moments_are_shared() {
    // Twice the rate and in another order, more people, longer: the same people at the same places are found again.
    let first = sideways(10);
    let place = |moment: usize, person: usize| match person.checked_sub(3) {
        Some(at) if at < 10 => {
            let at = (at + 4) % 10;
            let (now, then) = (moment / 2, (moment / 2 + 1).min(100));
            first.places_at(now)[at].lerp(first.places_at(then)[at], 0.5 * (moment % 2) as f64)
        }
        _ => vec2(100.0 * (person as f64 - 6.0), 0.0),
    };
    let places = (0..201).flat_map(|moment| (0..14).map(move |person| place(moment, person))).collect();
    let other = Ensemble::new(20.0, 77.0, (0..14).collect(), places);
    let mixed = mix(&first, &other, Method::Pca);
    assert_eq!(mixed.left_out(), [0, 4]);
    assert_eq!(mixed.features(MixSource::Other).moments(), 101);
    let all = mixed.components().len();
    let features = find(&first, Method::Pca);
    let twice =
        features.modulated(features.components().len(), &Modulation::of(Rule::scale("all=2").unwrap())).unwrap();
    assert!(apart(&mixed.rebuild(all).unwrap(), &twice) < 1e-9);
    // The other way round, those without a partner are left out, and it ends with the shorter.
    let turned = mix(&other, &sideways(10), Method::Pca);
    assert_eq!((turned.left_out(), turned.features(MixSource::First).moments()), ([4, 0], 201));
    assert_eq!(turned.rebuild(1).unwrap().ids, (3..13).collect::<Vec<_>>());
}

#[test]
fn the_middle_goes_where_it_is_asked_to() {
    let (a, b) = (sideways(10), wild(10, 101));
    let path = |middle: CentroidPath| {
        let options = FeaturesOptions::default();
        let mixed = Mix::find(&a, &b, &options, MixOptions { centroid: middle }, &Silent).unwrap().rebuild(3).unwrap();
        mixed.centroid_m(100) - mixed.centroid_m(0)
    };
    let [of_a, of_b] = [&a, &b].map(|crowd| crowd.centroid_m(100) - crowd.centroid_m(0));
    for (middle, expected) in
        [(CentroidPath::First, of_a), (CentroidPath::Other, of_b), (CentroidPath::Both, of_a + of_b)]
    {
        assert!(path(middle).distance(expected) < 1e-9, "{middle:?}");
    }
}

#[test]
fn crowds_with_nothing_in_common_are_refused() {
    let options = FeaturesOptions::default();
    let refused =
        |a: &Ensemble, b: &Ensemble| Mix::find(a, b, &options, MixOptions::default(), &Silent).unwrap_err().to_string();
    let short = Ensemble::new(100.0, 0.0, vec![1, 2], vec![Vec2::ZERO, vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(2.0, 2.0)]);
    assert!(refused(&sideways(5), &short).contains("shorter than two frames"));
    assert!(refused(&sideways(5), &wild(1, 50)).contains("too few"));
    assert!(refused(&wild(1001, 2), &wild(5, 9)).contains("1000 people"));
    let still = Ensemble::new(10.0, 0.0, vec![1, 2], [vec2(0.0, 0.0), vec2(1.0, 0.0)].repeat(50));
    assert!(refused(&sideways(5), &still).contains("do not move"));
}
