//! What of the example stays.

use trodden::Silent;
use trodden::formation::{AdjacencyEdit, Carry, Ease, FormationOptions, KeyFormation, interpolate};
use trodden::math::Vec2;
use trodden::motion::Ensemble;

use super::crowds::{grid, ring, scattered, strolling, triangle, walking, walking_between};

fn key(time_s: f64, places_m: &[Vec2]) -> KeyFormation {
    KeyFormation { time_s, places_m: places_m.to_vec() }
}

/// A grid that becomes a ring and then a triangle.
fn three_keys(people: usize) -> Vec<KeyFormation> {
    let columns = (people as f64).sqrt() as usize;
    vec![key(2.0, &grid(people, columns, 1.0)), key(8.0, &ring(people, 1.0, 0)), key(14.0, &triangle(people, 1.0))]
}

/// People who walk in a grid for 12 s, or from a grid to anywhere.
fn examples(people: usize) -> [Ensemble; 2] {
    let columns = (people as f64).sqrt() as usize;
    let (a, b) = (grid(people, columns, 1.0), scattered(people, 4));
    let between = |share: f64| a.iter().zip(&b).map(|(a, b)| a.lerp(*b, share)).collect();
    [walking(&a, 12.5, 12.0, 3), walking_between(between, 12.5, 12.0, 3)]
}

/// Somebody's place relative to the middle.
fn relative(motion: &Ensemble, moment: usize, person: usize) -> Vec2 {
    motion.places_at(moment)[person] - motion.centroid_m(moment)
}

/// Energy of the difference between two motions, relative to their middles.
fn energy_between(a: &Ensemble, b: &Ensemble) -> f64 {
    let squared = |moment: usize| {
        (0..a.people()).map(|k| (relative(a, moment, k) - relative(b, moment, k)).length_squared()).sum::<f64>()
    };
    (0..a.moments()).map(squared).sum()
}

/// The line on which everybody would go between the keys' moments, relative to the middle.
fn lines(example: &Ensemble, moments: &[usize]) -> Ensemble {
    let mut lines = example.clone();
    for pair in moments.windows(2) {
        for moment in pair[0]..=pair[1] {
            let share = (moment - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
            for k in 0..example.people() {
                lines.places_at_mut(moment)[k] =
                    relative(example, pair[0], k).lerp(relative(example, pair[1], k), share);
            }
        }
    }
    lines
}

/// Energy of what is quicker than formations change: second differences over a fifth of a second see steps, not ways.
fn quick_energy(motion: &Ensemble) -> f64 {
    let reach = (0.24 * motion.fps).round() as usize;
    let mut sum = 0.0;
    for moment in reach..motion.moments() - reach {
        for k in 0..motion.people() {
            let at = |m: usize| relative(motion, m, k);
            sum += (at(moment - reach) + at(moment + reach) - at(moment) * 2.0).length_squared();
        }
    }
    sum
}

fn with(change: impl Fn(&mut FormationOptions)) -> FormationOptions {
    let mut options = FormationOptions::default();
    change(&mut options);
    options
}

/// With the fluctuation and without.
fn both(example: &Ensemble, keys: &[KeyFormation], options: &FormationOptions) -> [Ensemble; 2] {
    let without = FormationOptions { fluctuation: 0.0, ..options.clone() };
    [options, &without].map(|options| interpolate(example, keys, options, &Silent).unwrap())
}

#[test]
fn the_fluctuation_keeps_its_energy() {
    for people in [9, 25] {
        let [example, _] = examples(people);
        let expected = energy_between(&example, &lines(&example, &[0, 75, 150]));
        let following = |o: &mut FormationOptions| {
            o.decompositions = Some(40);
            o.following_s = 30.0;
        };
        for options in [with(|_| ()), with(|o| o.carry = Carry::People), with(following)] {
            let [full, bare] = both(&example, &three_keys(people), &options);
            let energy = energy_between(&full, &bare) / expected;
            assert!((energy - 1.0).abs() < 0.05, "{people} people, {options:?}: {energy}");
            let quick = (quick_energy(&full) - quick_energy(&bare)) / quick_energy(&example);
            assert!((quick - 1.0).abs() < 0.08, "{people} people, {options:?}: {quick} of the steps");
        }
        // Eigenvectors as they come make a lurch of it.
        let raw = with(|o| {
            o.decompositions = Some(usize::MAX);
            o.following_s = 0.0;
        });
        let [full, bare] = both(&example, &three_keys(people), &raw);
        assert!(energy_between(&full, &bare) > 10.0 * expected);
    }
}

#[test]
fn however_often_the_example_is_decomposed_its_basis_follows_so_slowly_that_the_energy_stays() {
    let [first, middle, last] = [grid(25, 5, 1.0), ring(25, 1.0, 0), triangle(25, 1.0)];
    let keys = [key(2.0, &first), key(32.0, &middle), key(62.0, &last)];
    for (crowd, example) in [("on a grid", walking(&first, 10.0, 60.0, 3)), ("strolling", strolling(25, 10.0, 60.0, 5))]
    {
        let expected = energy_between(&example, &lines(&example, &[0, 300, 600]));
        let kept = |decompositions: usize, change: &dyn Fn(&mut FormationOptions)| {
            let options = with(|o| {
                o.decompositions = Some(decompositions);
                change(o);
            });
            let [full, bare] = both(&example, &keys, &options);
            let quick = (quick_energy(&full) - quick_energy(&bare)) / quick_energy(&example);
            [energy_between(&full, &bare) / expected, quick]
        };
        for decompositions in [10, 100, usize::MAX] {
            let [energy, quick] = kept(decompositions, &|_| ());
            assert!((energy - 1.0).abs() < 0.05, "{crowd}, {decompositions}: {energy}");
            assert!((quick - 1.0).abs() < 0.08, "{crowd}, {decompositions}: {quick} of the steps");
        }
        // That is what the default is for: faster is too much.
        let [energy, quick] = kept(usize::MAX, &|o| o.following_s = 2.0);
        assert!((energy - 1.0).abs().max((quick - 1.0).abs()) > 0.2, "{crowd}: {energy}, {quick}");
    }
}

#[test]
fn the_factor_scales_the_fluctuation() {
    let [example, _] = examples(9);
    let [once, none] = both(&example, &three_keys(9), &with(|_| ()));
    let [twice, _] = both(&example, &three_keys(9), &with(|o| o.fluctuation = 2.0));
    for moment in 0..once.moments() {
        for k in 0..9 {
            let [a, b, c] = [&none, &once, &twice].map(|motion| motion.places_at(moment)[k]);
            assert!((c - a).distance((b - a) * 2.0) < 1e-9);
        }
    }
}

#[test]
fn the_examples_own_formations_give_it_back() {
    for people in [4, 9, 25] {
        for example in examples(people) {
            let own = |moments: &[usize]| -> Vec<KeyFormation> {
                moments.iter().map(|&m| key(example.time_s(m), example.places_at(m))).collect()
            };
            for moments in [&[0, 150][..], &[0, 40, 150]] {
                let again = interpolate(&example, &own(moments), &FormationOptions::default(), &Silent).unwrap();
                let off_m = (energy_between(&again, &example) / (people * again.moments()) as f64).sqrt();
                assert!(off_m < 1e-9, "{people} people: off by {off_m} m");
            }
        }
    }
}

#[test]
fn the_middle_goes_along_the_keys_and_sways_as_in_the_example() {
    let [example, _] = examples(9);
    let mut keys = three_keys(9);
    keys[1].places_m.iter_mut().for_each(|place| place.y += 7.0);
    let [full, bare] = both(&example, &keys, &with(|_| ()));
    for moment in 0..=75 {
        let share = moment as f64 / 75.0;
        let own = |m: usize| example.centroid_m(m);
        let deviation = own(moment) - own(0).lerp(own(75), share);
        let line = bare.centroid_m(0).lerp(bare.centroid_m(75), share);
        assert!(bare.centroid_m(moment).distance(line) < 1e-9);
        assert!(full.centroid_m(moment).distance(line + deviation) < 1e-9);
    }
}

/// How far a triangle is from its shape: largest change of a side, metres.
fn worst_side_m(motion: &Ensemble, members: [usize; 3], keys: [usize; 2]) -> f64 {
    let sides = |moment: usize| {
        let places = motion.places_at(moment);
        [(0, 1), (1, 2), (2, 0)].map(|(a, b)| places[members[a]].distance(places[members[b]]))
    };
    let [first, last] = keys.map(sides);
    let mut worst = 0.0f64;
    for moment in keys[0]..=keys[1] {
        let share = (moment - keys[0]) as f64 / (keys[1] - keys[0]) as f64;
        for (side, now) in sides(moment).into_iter().enumerate() {
            worst = worst.max((now - first[side] * (1.0 - share) - last[side] * share).abs());
        }
    }
    worst
}

#[test]
fn three_who_are_adjacent_stay_a_triangle() {
    // Nine people; three of them go as a triangle from one side of the others to the other, who change places at random.
    let triangle_at = |x: f64, y: f64| [[x, y], [x + 0.6, y], [x + 0.3, y + 0.52]].map(Vec2::from);
    for seed in [1, 2, 3] {
        let mut first = scattered(9, seed);
        let mut last = scattered(9, seed + 10);
        first[..3].copy_from_slice(&triangle_at(-2.0, -1.0));
        last[..3].copy_from_slice(&triangle_at(2.0, 1.5));
        let example = walking(&first, 12.5, 6.0, seed);
        let keys = [key(2.0, &first), key(8.0, &last)];
        let deviation = |adjacency: Vec<AdjacencyEdit>| {
            let options = with(|o| {
                o.adjacency = adjacency.clone();
                o.fluctuation = 0.0;
            });
            worst_side_m(&interpolate(&example, &keys, &options, &Silent).unwrap(), [0, 1, 2], [0, 75])
        };
        let without = deviation(Vec::new());
        let adjacent = deviation(vec![AdjacencyEdit { members: vec![0, 1, 2], weight: 20.0 }]);
        assert!(adjacent < 0.1 && adjacent < 0.3 * without, "seed {seed}: {adjacent} m with, {without} m without");
    }
}

/// Largest change of velocity from one moment to the next within `from..to`, metres per second.
fn worst_jolt_m_s(motion: &Ensemble, from: usize, to: usize) -> f64 {
    let velocity = |m: usize, k: usize| (motion.places_at(m + 1)[k] - motion.places_at(m)[k]) * motion.fps;
    let jolt = |m: usize| {
        (0..motion.people()).map(move |k| (velocity(m, k) - velocity(m - 1, k)).length()).fold(0.0, f64::max)
    };
    (from..to).map(jolt).fold(0.0, f64::max)
}

#[test]
fn nothing_jumps_at_a_key_and_with_ease_nothing_jolts() {
    let [example, _] = examples(16);
    for ease in [Ease::Even, Ease::Rest] {
        let options = with(|o| {
            o.ease = ease;
            o.fluctuation = 0.0;
        });
        let motion = interpolate(&example, &three_keys(16), &options, &Silent).unwrap();
        let steps =
            |m: usize| (0..16).map(|k| motion.places_at(m)[k].distance(motion.places_at(m - 1)[k])).fold(0.0, f64::max);
        let most = (1..motion.moments()).map(steps).fold(0.0, f64::max);
        assert!(most < 0.4, "{ease:?}: {most} m within a moment");
        let at_key = worst_jolt_m_s(&motion, 75, 76);
        match ease {
            Ease::Even => assert!(at_key > 0.3, "{at_key}"),
            Ease::Rest => assert!(at_key < 0.1, "{at_key}"),
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same() {
    let [example, _] = examples(25);
    for decompositions in [None, Some(30), Some(usize::MAX)] {
        let options = with(|o| o.decompositions = decompositions);
        let motion = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| interpolate(&example, &three_keys(25), &options, &Silent).unwrap())
        };
        assert_eq!(motion(1), motion(3));
    }
}
