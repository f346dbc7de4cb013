//! Bases: shapes from coarse to fine, matched to each other, and followed through time.

use nalgebra::DMatrix;
use trodden::Silent;
use trodden::formation::{
    Basis, Follower, FormationOptions, Rotation, default_sigma_m, example_coefficients, match_basis,
};
use trodden::math::{Vec2, vec2};

use super::crowds::{farthest_m, grid, ring, scattered, triangle, walking};

fn basis(places_m: &[Vec2]) -> Basis {
    Basis::of(places_m, default_sigma_m(places_m), &[]).unwrap()
}

fn off_orthonormal(vectors: &DMatrix<f64>) -> f64 {
    (vectors.transpose() * vectors - DMatrix::identity(vectors.ncols(), vectors.ncols())).amax()
}

#[test]
fn shapes_go_from_coarse_to_fine() {
    let apart: Vec<Vec2> = (0..6).map(|k| vec2(f64::from(k % 3), if k < 3 { 0.0 } else { 900.0 })).collect();
    for places_m in [grid(24, 6, 1.0), ring(15, 1.0, 0), triangle(10, 0.8), scattered(40, 2), apart] {
        let basis = basis(&places_m);
        let people = places_m.len();
        assert!(off_orthonormal(&basis.vectors) < 1e-12);
        assert!(basis.values.windows(2).all(|pair| pair[0] <= pair[1]) && basis.values[0] == 0.0);
        let constant = 1.0 / (people as f64).sqrt();
        assert!(basis.vectors.column(0).iter().all(|&entry| entry == constant));
        let middle = places_m.iter().fold(Vec2::ZERO, |sum, &p| sum + p) / people as f64;
        let relative: Vec<Vec2> = places_m.iter().map(|&p| p - middle).collect();
        let coefficients = basis.coefficients(&places_m);
        let errors: Vec<f64> = (0..=people)
            .map(|terms| {
                let rebuilt = basis.rebuild(&coefficients, terms);
                rebuilt.iter().zip(&relative).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>()
            })
            .collect();
        assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9), "the error falls with every term: {errors:?}");
        assert!(farthest_m(&basis.rebuild(&coefficients, people), &relative) < 1e-9);
        // A third of the terms already shows the formation.
        assert!(errors[people / 3 + 1] < 0.15 * errors[0], "{errors:?}");
    }
}

#[test]
fn the_first_shape_is_the_longest_way_through_a_row() {
    let row: Vec<Vec2> = (0..7).map(|k| vec2(f64::from(k), 0.0)).collect();
    let basis = basis(&row);
    let signs = |i: usize| {
        let column: Vec<f64> = basis.vectors.column(i).iter().copied().filter(|entry| entry.abs() > 1e-9).collect();
        column.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count()
    };
    assert_eq!((0..7).map(signs).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5, 6]);
}

#[test]
fn matching_undoes_what_is_arbitrary() {
    // A square grid has pairs of equal eigenvalues; the same people seen with their eigenvectors turned, mirrored and
    // signed otherwise have to come back.
    for places_m in [grid(16, 4, 1.0), grid(9, 3, 1.0), ring(12, 1.0, 0), triangle(6, 1.0)] {
        let basis = basis(&places_m);
        let mut other = basis.clone();
        let n = places_m.len();
        let mut start = 1;
        for end in 2..=n {
            if end < n && basis.values[end] - basis.values[end - 1] < 1e-9 {
                continue;
            }
            let (sine, cosine) = trodden::math::sin_cos(1.0 + start as f64);
            if end - start == 2 {
                let turn = DMatrix::from_row_slice(2, 2, &[cosine, sine, sine, -cosine]);
                let turned = other.vectors.columns(start, 2) * turn;
                other.vectors.columns_mut(start, 2).copy_from(&turned);
            } else {
                other.vectors.columns_mut(start, end - start).neg_mut();
            }
            start = end;
        }
        assert!((&other.vectors - &basis.vectors).amax() > 0.1);
        let matched = match_basis(&other, &basis.vectors, 1e-6, None).unwrap();
        assert!((&matched - &basis.vectors).amax() < 1e-9);
    }
}

#[test]
fn the_way_between_matched_bases_is_a_rotation() {
    for seed in 0..40 {
        let (a, b) = (scattered(3 + seed as usize % 20, seed), scattered(3 + seed as usize % 20, seed + 100));
        let (from, to) = (basis(&a), basis(&b));
        let matched = match_basis(&to, &from.vectors, 0.1, Some(&from.vectors)).unwrap();
        assert!(off_orthonormal(&matched) < 1e-12);
        let rotation = Rotation::of(&(&matched * from.vectors.transpose())).unwrap();
        assert!((rotation.apply(&from.vectors, 1.0) - &matched).amax() < 1e-10);
        let coefficients = Basis { vectors: matched, values: to.values }.coefficients(&b);
        assert_eq!(coefficients.len(), b.len());
    }
}

#[test]
fn a_follower_stays_orthonormal_and_moves_as_fast_as_it_may() {
    let example = walking(&grid(16, 4, 1.0), 12.5, 8.0, 9);
    let moved = |following_s: f64| {
        let first = basis(example.places_at(0));
        let mut follower = Follower::start(&first, None, 0.1, following_s).unwrap();
        let (mut most, mut agreement) = (0.0f64, 1.0f64);
        for moment in 1..example.moments() {
            let now = basis(example.places_at(moment));
            let before = follower.vectors().clone();
            follower.advance(&now, 1.0 / example.fps, 1e-12).unwrap();
            assert!(off_orthonormal(follower.vectors()) < 1e-9);
            most = most.max((follower.vectors() - before).norm());
            agreement = agreement.min(now.vectors.column(0).dot(&follower.vectors().column(0)));
        }
        assert!((agreement - 1.0).abs() < 1e-9, "the constant vector stays");
        most
    };
    let (slow, quick) = (moved(10.0), moved(0.0));
    assert!(slow < 0.05 && quick > 4.0 * slow, "{slow} slow, {quick} quick");
}

#[test]
fn a_small_step_along_the_tangent_is_the_step() {
    let places = [scattered(30, 1), scattered(30, 2)];
    let [first, then] = places.each_ref().map(|places_m| basis(places_m));
    let after = |step_s: f64| {
        let mut follower = Follower::start(&first, None, 0.1, 10.0).unwrap();
        follower.advance(&then, step_s, 1e-12).unwrap();
        follower.vectors().clone()
    };
    // Up to 0.5 s, a twentieth of the time of following, it is taken along the tangent.
    let (tangent, whole) = (after(0.4999), after(0.5001));
    let moved = (&whole - &first.vectors).norm();
    assert!((&tangent - &whole).norm() < 0.05 * moved, "{} of {moved}", (&tangent - &whole).norm());
}

#[test]
fn an_example_is_told_whole_by_its_coefficients() {
    let example = walking(&grid(9, 3, 1.0), 12.5, 6.0, 5);
    for (decompositions, following_s) in
        [(None, 10.0), (Some(10), 2.0), (Some(usize::MAX), 2.0), (Some(usize::MAX), 0.0)]
    {
        let options = FormationOptions { decompositions, following_s, ..FormationOptions::default() };
        let wanted = [0, 20, 75];
        let seen = example_coefficients(&example, &wanted, &options, &Silent).unwrap();
        assert_eq!(seen.bases.keys().copied().collect::<Vec<_>>(), wanted);
        for moment in 0..example.moments() {
            let middle = example.centroid_m(moment);
            let size = |values: &mut dyn Iterator<Item = Vec2>| values.map(Vec2::length_squared).sum::<f64>();
            let truth = size(&mut example.places_at(moment).iter().map(|&p| p - middle));
            let told = size(&mut seen.at(moment).iter().copied());
            assert!((told / truth - 1.0).abs() < 1e-5, "{options:?}, moment {moment}: {told} of {truth}");
        }
        for (&moment, vectors) in &seen.bases {
            let basis = Basis { vectors: vectors.clone(), values: vec![0.0; 9] };
            let rebuilt = basis.rebuild(seen.at(moment), 9);
            let middle = example.centroid_m(moment);
            let truth: Vec<Vec2> = example.places_at(moment).iter().map(|&p| p - middle).collect();
            assert!(farthest_m(&rebuilt, &truth) < 1e-6);
        }
    }
}
