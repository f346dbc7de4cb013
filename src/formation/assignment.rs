use crate::math::{Vec2, assign};

/// Weight of the squared distance relative to the distance, both as shares of the longest.
const SQUARES: f64 = 1.0 / (1u64 << 26) as f64;
/// Upper bound of the sum of costs.
const MOST: u64 = 1 << 60;

/// Assigns people to places with the least sum of distances, to a millionth: `result[person]` is a place.
///
/// `from` and `to` have the same length; metres. Of equal sums the one with the least squares is taken, so that people on
/// a line do not overtake each other.
pub(super) fn assign_places(from: &[Vec2], to: &[Vec2]) -> Vec<usize> {
    let people = from.len().min(to.len());
    let largest_m = from.iter().flat_map(|&a| to.iter().map(move |&b| a.distance(b))).fold(0.0, f64::max);
    if people == 0 || !largest_m.is_finite() || largest_m <= 0.0 {
        return (0..people).collect();
    }
    let units = (MOST / people.next_power_of_two() as u64) as f64;
    let cost = |person: usize, place: usize| {
        let share = from[person].distance(to[place]) / largest_m;
        ((share + SQUARES * share * share) * units).round() as i64
    };
    assign(people, people, cost).1
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::{SplitMix64, vec2};

    fn length(from: &[Vec2], to: &[Vec2], places: &[usize]) -> f64 {
        from.iter().zip(places).map(|(a, &place)| a.distance(to[place])).sum()
    }

    fn is_permutation(places: &[usize]) -> bool {
        let mut sorted = places.to_vec();
        sorted.sort_unstable();
        sorted.into_iter().eq(0..places.len())
    }

    /// The least length over all orders.
    fn brute_force(from: &[Vec2], to: &[Vec2]) -> f64 {
        fn search(from: &[Vec2], to: &[Vec2], used: &mut Vec<bool>, person: usize) -> f64 {
            if person == from.len() {
                return 0.0;
            }
            let mut least = f64::INFINITY;
            for place in 0..to.len() {
                if !std::mem::replace(&mut used[place], true) {
                    least = least.min(from[person].distance(to[place]) + search(from, to, used, person + 1));
                    used[place] = false;
                }
            }
            least
        }
        search(from, to, &mut vec![false; to.len()], 0)
    }

    fn scattered(n: usize, seed: u64) -> Vec<Vec2> {
        let mut words = SplitMix64::new(seed);
        (0..n).map(|_| vec2(f64::from(words.range(0.0, 30.0)), f64::from(words.range(0.0, 20.0)))).collect()
    }

    proptest! {
        #[test]
        fn no_order_is_shorter(n in 1usize..8, seed in any::<u64>(), coarse in any::<bool>()) {
            let round = |v: Vec2| if coarse { vec2((v.x / 10.0).round(), (v.y / 10.0).round()) } else { v };
            let from: Vec<Vec2> = scattered(n, seed).into_iter().map(round).collect();
            let to: Vec<Vec2> = scattered(n, !seed).into_iter().map(round).collect();
            let places = assign_places(&from, &to);
            prop_assert!(is_permutation(&places));
            let (found, least) = (length(&from, &to, &places), brute_force(&from, &to));
            prop_assert!((found - least).abs() < 1e-6, "{found} m, but {least} m will do");
        }
    }

    #[test]
    fn nobody_overtakes_on_a_line() {
        let from: Vec<Vec2> = (0..40).map(|k| vec2(f64::from(k), 0.0)).collect();
        let to: Vec<Vec2> = from.iter().rev().map(|&place| place + vec2(100.0, 0.0)).collect();
        assert_eq!(assign_places(&from, &to), (0..40).rev().collect::<Vec<_>>());
    }

    #[test]
    fn nobody_and_everybody_on_one_point_are_given_places() {
        assert!(assign_places(&[], &[]).is_empty());
        let one = vec![vec2(3.0, 3.0); 9];
        assert!(is_permutation(&assign_places(&one, &one)));
        assert!(is_permutation(&assign_places(&one, &scattered(9, 1))));
        assert!(is_permutation(&assign_places(&[vec2(f64::NAN, 0.0); 4], &scattered(4, 1))));
        assert!(is_permutation(&assign_places(&[vec2(1e300, 0.0); 4], &scattered(4, 1))));
    }

    #[test]
    fn a_thousand_are_given_places_quickly() {
        // A ring and ranks: many distances are equal, as the hardest cases have it.
        let ranks: Vec<Vec2> = (0..1000).map(|k| vec2(f64::from(k % 40), f64::from(k / 40))).collect();
        let ring = |k: i32| crate::math::sin_cos(f64::from(k) * std::f64::consts::TAU / 1000.0);
        let ring: Vec<Vec2> = (0..1000).map(|k| vec2(20.0 + 30.0 * ring(k).1, 12.0 + 30.0 * ring(k).0)).collect();
        let start = std::time::Instant::now();
        assert!(is_permutation(&assign_places(&ranks, &ring)));
        assert!(start.elapsed().as_secs_f64() < 20.0, "{:?}", start.elapsed());
    }
}
