use super::centroid;
use crate::math::{Rect, Vec2, vec2};

/// Most rounds of Lloyd's algorithm.
const ROUNDS: usize = 40;
/// Samples per person above which samples are thinned out.
const MOST_SAMPLES_PER_PERSON: usize = 400;

/// Spreads people evenly over a shape that is given as samples, metres.
///
/// Farthest points first (Gonzalez 1985, doi 10.1016/0304-3975(85)90224-5), then Lloyd's algorithm (Lloyd 1982,
/// doi 10.1109/TIT.1982.1056489). Every position is one of the samples; if there are fewer than people, they repeat.
pub(in super::super) fn spread(samples: &[Vec2], people: usize) -> Vec<Vec2> {
    if samples.is_empty() || people == 0 {
        return Vec::new();
    }
    let samples = &thinned(samples, people * MOST_SAMPLES_PER_PERSON);
    if samples.len() <= people {
        return (0..people).map(|k| samples[k % samples.len()]).collect();
    }
    let mut places = farthest_points(samples, people);
    for _ in 0..ROUNDS {
        let index = CellIndex::new(&places);
        let mut sums = vec![(Vec2::ZERO, 0usize); people];
        for &sample in samples {
            let (sum, count) = &mut sums[index.nearest(&places, sample)];
            *sum += sample;
            *count += 1;
        }
        let moved: Vec<Vec2> = places
            .iter()
            .zip(sums)
            .map(|(&old, (sum, count))| if count == 0 { old } else { sum / count as f64 })
            .collect();
        let way_m = places.iter().zip(&moved).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        places = moved;
        if way_m < 1e-6 {
            break;
        }
    }
    // The centroid of a cell may lie beside a bent line, or in a hole.
    let index = CellIndex::new(samples);
    let mut taken = vec![false; samples.len()];
    places
        .iter()
        .map(|&place| {
            let nearest = index.nearest(samples, place);
            let free = if taken[nearest] { nearest_free(samples, &taken, place) } else { nearest };
            taken[free] = true;
            samples[free]
        })
        .collect()
}

/// Thins samples evenly to at most about `most`.
fn thinned(samples: &[Vec2], most: usize) -> Vec<Vec2> {
    let every = samples.len().div_ceil(most.max(1)).max(1);
    samples.iter().copied().step_by(every).collect()
}

fn nearest_free(samples: &[Vec2], taken: &[bool], place: Vec2) -> usize {
    let free = (0..samples.len()).filter(|&k| !taken[k]);
    free.min_by(|&a, &b| samples[a].distance(place).total_cmp(&samples[b].distance(place))).unwrap_or(0)
}

/// Farthest-point sampling, starting with the sample farthest from the centroid.
fn farthest_points(samples: &[Vec2], people: usize) -> Vec<Vec2> {
    let middle = centroid(samples);
    let farthest = |distances: &[f64]| {
        (0..distances.len()).max_by(|&a, &b| distances[a].total_cmp(&distances[b]).then(b.cmp(&a))).unwrap_or(0)
    };
    let mut distances: Vec<f64> = samples.iter().map(|sample| (*sample - middle).length_squared()).collect();
    let mut next = farthest(&distances);
    distances.fill(f64::INFINITY);
    let mut places = Vec::with_capacity(people);
    for _ in 0..people {
        let place = samples[next];
        places.push(place);
        for (distance, sample) in distances.iter_mut().zip(samples) {
            *distance = distance.min((*sample - place).length_squared());
        }
        next = farthest(&distances);
    }
    places
}

/// A grid index of points for nearest-neighbour queries.
struct CellIndex {
    area: Rect,
    cell_m: f64,
    columns: usize,
    rows: usize,
    starts: Vec<usize>,
    members: Vec<usize>,
}

impl CellIndex {
    fn new(points: &[Vec2]) -> CellIndex {
        let first = points.first().copied().unwrap_or_default();
        let area = points.iter().fold(Rect::around(first, first), |r, p| Rect {
            min: vec2(r.min.x.min(p.x), r.min.y.min(p.y)),
            max: vec2(r.max.x.max(p.x), r.max.y.max(p.y)),
        });
        // About two points to a cell of what may be a line as well as an area.
        let side_m = area.width().max(area.height()).max(1e-9);
        let cell_m = (side_m / (points.len() as f64).sqrt()).max(1e-9);
        let count = |length_m: f64| (length_m / cell_m) as usize + 1;
        let (columns, rows) = (count(area.width()), count(area.height()));
        let mut index = CellIndex {
            area,
            cell_m,
            columns,
            rows,
            starts: vec![0; columns * rows + 1],
            members: vec![0; points.len()],
        };
        let cells: Vec<usize> = points.iter().map(|&point| index.cell(point)).collect();
        for &cell in &cells {
            index.starts[cell + 1] += 1;
        }
        for cell in 0..columns * rows {
            index.starts[cell + 1] += index.starts[cell];
        }
        let mut ends = index.starts.clone();
        for (point, &cell) in cells.iter().enumerate() {
            index.members[ends[cell]] = point;
            ends[cell] += 1;
        }
        index
    }

    fn column_row(&self, point: Vec2) -> [usize; 2] {
        let along = |at_m: f64, count: usize| ((at_m / self.cell_m).max(0.0) as usize).min(count - 1);
        [along(point.x - self.area.min.x, self.columns), along(point.y - self.area.min.y, self.rows)]
    }

    fn cell(&self, point: Vec2) -> usize {
        let [column, row] = self.column_row(point);
        row * self.columns + column
    }

    /// Index of the nearest point; of equally near ones the first.
    fn nearest(&self, points: &[Vec2], to: Vec2) -> usize {
        let [column, row] = self.column_row(to);
        let mut best = (f64::INFINITY, 0);
        for ring in 0..self.columns.max(self.rows) {
            // Least distance of points in this ring of cells or beyond.
            let least_m = (ring as f64 - 1.0).max(0.0) * self.cell_m;
            if best.0 <= least_m * least_m {
                break;
            }
            let rows = row.saturating_sub(ring)..=(row + ring).min(self.rows - 1);
            for y in rows {
                let edge = y + ring == row || y == row + ring;
                let columns = column.saturating_sub(ring)..=(column + ring).min(self.columns - 1);
                for x in columns.filter(|&x| edge || x + ring == column || x == column + ring) {
                    let cell = y * self.columns + x;
                    for &member in &self.members[self.starts[cell]..self.starts[cell + 1]] {
                        let distance = (points[member] - to).length_squared();
                        if (distance, member) < best {
                            best = (distance, member);
                        }
                    }
                }
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::super::nearest_m;
    use super::*;
    use crate::math::SplitMix64;

    #[test]
    fn the_nearest_is_the_nearest() {
        let mut words = SplitMix64::new(5);
        let mut point = || vec2(f64::from(words.range(0.0, 9.0)), f64::from(words.range(0.0, 2.0)));
        let points: Vec<Vec2> = (0..200).map(|_| point()).collect();
        let index = CellIndex::new(&points);
        for _ in 0..300 {
            let to = (point() - vec2(2.0, 1.0)) * 1.7;
            let slow = (0..200).min_by(|&a, &b| points[a].distance(to).total_cmp(&points[b].distance(to))).unwrap();
            assert_eq!(index.nearest(&points, to), slow, "{to:?}");
        }
    }

    #[test]
    fn people_fill_a_square_evenly() {
        let samples: Vec<Vec2> = (0..10_000).map(|k| vec2(f64::from(k % 100), f64::from(k / 100)) / 10.0).collect();
        let places = spread(&samples, 100);
        assert_eq!(places.len(), 100);
        // A square metre for everybody: the densest packing has 1.07 m.
        assert!(nearest_m(&places) > 0.7, "{}", nearest_m(&places));
    }

    #[test]
    fn people_stand_evenly_along_a_line_and_on_it() {
        let bent = |k: i32| if k < 500 { vec2(0.0, f64::from(k)) } else { vec2(f64::from(k - 500), 500.0) } / 100.0;
        let samples: Vec<Vec2> = (0..1000).map(bent).collect();
        let places = spread(&samples, 10);
        assert!(places.iter().all(|place| samples.contains(place)));
        assert!(nearest_m(&places) > 0.75, "{}", nearest_m(&places));
    }

    #[test]
    fn more_people_than_samples_share_them() {
        assert_eq!(spread(&[vec2(1.0, 2.0)], 3), vec![vec2(1.0, 2.0); 3]);
        assert!(spread(&[], 3).is_empty() && spread(&[vec2(1.0, 2.0)], 0).is_empty());
        assert_eq!(spread(&[vec2(1.0, 2.0); 50], 3), vec![vec2(1.0, 2.0); 3]);
    }
}
