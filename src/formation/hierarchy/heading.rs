use crate::math::{Vec2, vec2};

/// Length of the drawbar that gives a heading, metres: a body turns round within about this distance.
const DRAWBAR_M: f64 = 0.8;
/// Shortest displacement that defines a heading, metres.
const SHORTEST_M: f64 = 0.05;

/// The heading of a body in each frame: that of a drawbar with an axle that is dragged along its path.
///
/// It stays while the body stands, turns evenly around corners, and backs up before it turns round. A body that stands or
/// sways at the start faces the direction in which it will go.
pub(super) fn headings(places: &[Vec2]) -> Vec<Vec2> {
    let first = places.first().copied().unwrap_or_default();
    let ways = || places.iter().map(|&place| place - first);
    let farthest = || ways().max_by(|a, b| a.length().total_cmp(&b.length())).filter(|way| way.length() > SHORTEST_M);
    let start = ways().find(|way| way.length() > DRAWBAR_M).or_else(farthest);
    let mut heading = start.and_then(Vec2::normalized).unwrap_or(vec2(0.0, 1.0));
    let mut axle = first - heading * DRAWBAR_M;
    places
        .iter()
        .map(|&place| {
            heading = (place - axle).normalized().unwrap_or(heading);
            axle = place - heading * DRAWBAR_M;
            heading
        })
        .collect()
}

/// Rotates a position of a formation, whose up is forward, to a heading.
pub(super) fn turned_to(place: Vec2, heading: Vec2) -> Vec2 {
    // Up becomes the heading: turned by the heading's angle less a quarter.
    place.rotated(-heading.left())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_becomes_forward() {
        for (heading, tip) in [([0.0, 1.0], [0.0, 2.0]), ([1.0, 0.0], [2.0, 0.0]), ([-1.0, 0.0], [-2.0, 0.0])] {
            let turned = turned_to(vec2(0.0, 2.0), heading.into());
            assert!(turned.distance(tip.into()) < 1e-12, "{heading:?}: {turned:?}");
        }
        // And right stays right.
        assert!(turned_to(vec2(1.0, 0.0), vec2(1.0, 0.0)).distance(vec2(0.0, -1.0)) < 1e-12);
    }

    #[test]
    fn a_heading_follows_the_way_and_stays_where_nobody_moves() {
        let mut places: Vec<Vec2> = (0..50).map(|k| vec2(0.1 * f64::from(k), 0.0)).collect();
        places.extend((0..50).map(|k| vec2(4.9, 0.1 * f64::from(k))));
        places.extend([vec2(4.9, 4.9); 20]);
        let headings = headings(&places);
        assert_eq!(headings[0], vec2(1.0, 0.0));
        assert!(headings[99].distance(vec2(0.0, 1.0)) < 0.02);
        assert_eq!(headings[119], headings[100]);
        assert!(headings.windows(2).all(|pair| pair[0].distance(pair[1]) < 0.2));
        // Who sways to the left before setting out to the right faces to the right all the while.
        let sways: Vec<Vec2> = (0..20).map(|k| vec2(-0.01 * f64::from(k), 0.0)).chain(places.clone()).collect();
        assert_eq!(super::headings(&sways)[0], vec2(1.0, 0.0));
        assert_eq!(super::headings(&[vec2(1.0, 1.0); 3]), vec![vec2(0.0, 1.0); 3]);
        assert!(super::headings(&[]).is_empty());
    }
}
