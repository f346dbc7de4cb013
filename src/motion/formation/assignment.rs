use crate::math::Vec2;

/// What a distance is counted in: the largest distance of a problem is so many units.
const UNITS: f64 = (1u64 << 32) as f64;
/// Below that, what decides between ways of the same length: the largest square of a distance is so many.
const TIE_UNITS: f64 = (1u64 << 18) as f64;
const NOBODY: usize = usize::MAX;

/// Who goes to which place so that all together have the shortest way: `result[person]` is a place.
///
/// `from` and `to` are as many, in metres. Of several equal ways that one is taken whose squares are least, so that
/// nobody overtakes anybody on a line. Distances count in units of 2^-32 of the largest, so that the result is exact
/// and the same on every machine.
///
/// Jonker, Volgenant 1987, *A shortest augmenting path algorithm for dense and sparse linear assignment problems*
/// (doi 10.1007/BF02278710): prices by column reduction, then one shortest path for everybody who is still free; the
/// time grows with the cube of the number at worst.
pub(super) fn assign(from: &[Vec2], to: &[Vec2]) -> Vec<usize> {
    let people = from.len().min(to.len());
    let largest_m = from.iter().flat_map(|&a| to.iter().map(move |&b| a.distance(b))).fold(0.0, f64::max);
    if people == 0 || !largest_m.is_finite() || largest_m <= 0.0 {
        return (0..people).collect();
    }
    let cost = |person: usize, place: usize| {
        let share = from[person].distance(to[place]) / largest_m;
        ((share * UNITS).round() as i64) * TIE_UNITS as i64 + (share * share * TIE_UNITS / people as f64).round() as i64
    };
    let costs: Vec<i64> = (0..people).flat_map(|a| (0..people).map(move |b| (a, b))).map(|(a, b)| cost(a, b)).collect();
    Assignment::new(&costs, people).solve()
}

/// A half-finished assignment of `n` people to `n` places.
struct Assignment<'c> {
    costs: &'c [i64],
    n: usize,
    /// What a place costs beyond the way to it.
    prices: Vec<i64>,
    place_of: Vec<usize>,
    person_at: Vec<usize>,
}

impl<'c> Assignment<'c> {
    fn new(costs: &'c [i64], n: usize) -> Assignment<'c> {
        Assignment { costs, n, prices: vec![0; n], place_of: vec![NOBODY; n], person_at: vec![NOBODY; n] }
    }

    fn solve(mut self) -> Vec<usize> {
        self.give_places_to_the_nearest();
        self.transfer_prices();
        // Twice is what the authors found worth its while.
        for _ in 0..2 {
            self.bid();
        }
        for person in 0..self.n {
            if self.place_of[person] == NOBODY {
                self.find_way(person);
            }
        }
        self.place_of
    }

    fn row(&self, person: usize) -> &'c [i64] {
        &self.costs[person * self.n..(person + 1) * self.n]
    }

    /// Column reduction: every place goes to the nearest, if nobody else has got that person.
    fn give_places_to_the_nearest(&mut self) {
        for place in (0..self.n).rev() {
            let nearest = (0..self.n).min_by_key(|&person| self.costs[person * self.n + place]).unwrap_or(0);
            self.prices[place] = self.costs[nearest * self.n + place];
            if self.place_of[nearest] == NOBODY {
                self.place_of[nearest] = place;
                self.person_at[place] = nearest;
            }
        }
    }

    /// Reduction transfer: a place becomes dearer by as much as its person would lose elsewhere.
    fn transfer_prices(&mut self) {
        for person in 0..self.n {
            let own = self.place_of[person];
            if own == NOBODY {
                continue;
            }
            let others = self.row(person).iter().zip(&self.prices).enumerate().filter(|(place, _)| *place != own);
            if let Some(loss) = others.map(|(_, (cost, price))| cost - price).min() {
                self.prices[own] -= loss;
            }
        }
    }

    /// Augmenting row reduction: whoever is free takes the best place from whoever has it, and bids up its price.
    fn bid(&mut self) {
        let mut free: Vec<usize> = (0..self.n).filter(|&person| self.place_of[person] == NOBODY).rev().collect();
        // Prices might rise in tiny steps for a long time; whoever is left over then is given a place later.
        let mut bids = 8 * self.n;
        while let Some(person) = free.pop() {
            bids -= 1;
            if bids == 0 {
                break;
            }
            let [(first, best), (second, next)] = self.two_best(person);
            let taken = if best < next {
                self.prices[first] -= next - best;
                first
            } else if self.person_at[first] == NOBODY {
                first
            } else {
                second
            };
            let before = std::mem::replace(&mut self.person_at[taken], person);
            self.place_of[person] = taken;
            if before != NOBODY {
                self.place_of[before] = NOBODY;
                // Without a better price nobody gains by bidding on.
                if best < next {
                    free.push(before);
                }
            }
        }
    }

    fn two_best(&self, person: usize) -> [(usize, i64); 2] {
        let mut best = [(0, i64::MAX); 2];
        for (place, (cost, price)) in self.row(person).iter().zip(&self.prices).enumerate() {
            let reduced = cost - price;
            if reduced < best[0].1 {
                best = [(place, reduced), best[0]];
            } else if reduced < best[1].1 {
                best[1] = (place, reduced);
            }
        }
        best
    }

    /// Augmentation: the cheapest chain of moves that ends at a free place (Dijkstra over places).
    fn find_way(&mut self, start: usize) {
        let mut cheapest: Vec<i64> = self.row(start).iter().zip(&self.prices).map(|(c, p)| c - p).collect();
        let mut reached_by = vec![start; self.n];
        let mut settled: Vec<usize> = Vec::new();
        let mut is_settled = vec![false; self.n];
        let (end, length) = loop {
            let open = (0..self.n).filter(|&place| !is_settled[place]);
            let Some(place) = open.min_by_key(|&place| (cheapest[place], self.person_at[place] != NOBODY)) else {
                return;
            };
            let length = cheapest[place];
            let person = self.person_at[place];
            if person == NOBODY {
                break (place, length);
            }
            is_settled[place] = true;
            settled.push(place);
            let row = self.row(person);
            let own = row[place] - self.prices[place];
            for next in 0..self.n {
                let through = length + row[next] - self.prices[next] - own;
                if !is_settled[next] && through < cheapest[next] {
                    cheapest[next] = through;
                    reached_by[next] = person;
                }
            }
        };
        for &place in &settled {
            self.prices[place] += cheapest[place] - length;
        }
        let mut place = end;
        loop {
            let person = reached_by[place];
            self.person_at[place] = person;
            std::mem::swap(&mut self.place_of[person], &mut place);
            if person == start {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use pathfinding::matrix::Matrix;
    use pathfinding::prelude::kuhn_munkres_min;
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
            let places = assign(&from, &to);
            prop_assert!(is_permutation(&places));
            let (found, least) = (length(&from, &to, &places), brute_force(&from, &to));
            prop_assert!((found - least).abs() < 1e-6, "{found} m, but {least} m will do");
        }
    }

    #[test]
    fn larger_cases_agree_with_another_solver() {
        for seed in 0..6 {
            let (from, to) = (scattered(60, seed), scattered(60, seed + 100));
            let weight = |(a, b): (usize, usize)| (from[a].distance(to[b]) * 1e6) as i64;
            let theirs = kuhn_munkres_min(&Matrix::from_fn(60, 60, weight)).1;
            let places = assign(&from, &to);
            assert!(is_permutation(&places));
            assert!((length(&from, &to, &places) - length(&from, &to, &theirs)).abs() < 1e-3);
        }
    }

    #[test]
    fn nobody_overtakes_on_a_line() {
        let from: Vec<Vec2> = (0..40).map(|k| vec2(f64::from(k), 0.0)).collect();
        let to: Vec<Vec2> = from.iter().rev().map(|&place| place + vec2(100.0, 0.0)).collect();
        assert_eq!(assign(&from, &to), (0..40).rev().collect::<Vec<_>>());
    }

    #[test]
    fn nobody_and_everybody_on_one_point_are_given_places() {
        assert!(assign(&[], &[]).is_empty());
        let one = vec![vec2(3.0, 3.0); 9];
        assert!(is_permutation(&assign(&one, &one)));
        assert!(is_permutation(&assign(&one, &scattered(9, 1))));
        assert!(is_permutation(&assign(&[vec2(f64::NAN, 0.0); 4], &scattered(4, 1))));
        assert!(is_permutation(&assign(&[vec2(1e300, 0.0); 4], &scattered(4, 1))));
    }

    #[test]
    fn a_thousand_are_given_places_quickly() {
        // A ring and ranks: many distances are equal, as the hardest cases have it.
        let ranks: Vec<Vec2> = (0..1000).map(|k| vec2(f64::from(k % 40), f64::from(k / 40))).collect();
        let ring = |k: i32| crate::math::sin_cos(f64::from(k) * std::f64::consts::TAU / 1000.0);
        let ring: Vec<Vec2> = (0..1000).map(|k| vec2(20.0 + 30.0 * ring(k).1, 12.0 + 30.0 * ring(k).0)).collect();
        let start = std::time::Instant::now();
        assert!(is_permutation(&assign(&ranks, &ring)));
        assert!(start.elapsed().as_secs_f64() < 20.0, "{:?}", start.elapsed());
    }
}
