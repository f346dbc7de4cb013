use crate::math::Vec2;

/// Positions and radii of all bodies in a frame, metres.
#[derive(Clone, Copy)]
pub(super) struct BodiesAtMoment<'m> {
    pub places: &'m [Vec2],
    pub reaches_m: &'m [f64],
}

/// The numbers of two bodies, the lower one first.
pub(super) type BodyPair = [u32; 2];

/// Finds the pairs of bodies within `gap_m` of each other, edge to edge, in the order of their numbers.
pub(super) fn pairs_within(moment: BodiesAtMoment<'_>, gap_m: f64) -> Vec<BodyPair> {
    let BodiesAtMoment { places, reaches_m } = moment;
    let largest_m = reaches_m.iter().copied().fold(0.0, f64::max);
    let cell_m = (2.0 * largest_m + gap_m).max(1e-6);
    // Cell numbers are exact; bodies at positions that are not finite fall into some cell.
    let cell = |place: Vec2| [(place.x / cell_m).floor() as i64, (place.y / cell_m).floor() as i64];
    let mut sorted: Vec<([i64; 2], u32)> =
        places.iter().enumerate().map(|(body, &place)| (cell(place), body as u32)).collect();
    sorted.sort_unstable();
    let mut pairs = Vec::new();
    for (at, &([x, y], body)) in sorted.iter().enumerate() {
        let mut look = |other: u32| {
            let (a, b) = (body.min(other), body.max(other));
            let reach_m = reaches_m[a as usize] + reaches_m[b as usize] + gap_m;
            if (places[a as usize] - places[b as usize]).length_squared() < reach_m * reach_m {
                pairs.push([a, b]);
            }
        };
        // The rest of its own cell and the one above, then the column to the right.
        sorted[at + 1..].iter().take_while(|other| other.0 <= [x, y.saturating_add(1)]).for_each(|other| look(other.1));
        let right = [x.saturating_add(1), y.saturating_sub(1)];
        let from = sorted.partition_point(|other| other.0 < right);
        let column = sorted[from.max(at + 1)..].iter();
        column.take_while(|other| other.0 <= [right[0], y.saturating_add(1)]).for_each(|other| look(other.1));
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{SplitMix64, vec2};

    #[test]
    fn the_grid_finds_all_pairs() {
        for seed in 0..20 {
            let mut words = SplitMix64::new(seed);
            let places: Vec<Vec2> =
                (0..120).map(|_| vec2(f64::from(words.range(-6.0, 6.0)), f64::from(words.range(-6.0, 6.0)))).collect();
            let reaches_m: Vec<f64> = (0..120).map(|_| f64::from(words.range(0.0, 0.7))).collect();
            let mut slow = Vec::new();
            for a in 0..120 {
                for b in a + 1..120 {
                    if places[a].distance(places[b]) < reaches_m[a] + reaches_m[b] + 0.4 {
                        slow.push([a as u32, b as u32]);
                    }
                }
            }
            assert_eq!(pairs_within(BodiesAtMoment { places: &places, reaches_m: &reaches_m }, 0.4), slow);
        }
    }

    #[test]
    fn everybody_on_one_point_and_far_away_is_found() {
        let places = [vec2(1e9, -1e9), vec2(1e9, -1e9), vec2(f64::NAN, 0.0)];
        let pairs = pairs_within(BodiesAtMoment { places: &places, reaches_m: &[0.2; 3] }, 0.0);
        assert_eq!(pairs, [[0, 1]]);
    }
}
