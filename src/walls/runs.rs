//! A boundary as short runs of pixel edges, with a sample of the true edge at each.

/// Direction of a pixel edge in the image, y down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    East,
    South,
    West,
    North,
}

impl Direction {
    /// The step, pixels.
    pub(super) fn step(self) -> [i32; 2] {
        match self {
            Direction::East => [1, 0],
            Direction::South => [0, 1],
            Direction::West => [-1, 0],
            Direction::North => [0, -1],
        }
    }

    /// The perpendicular axis: 1 (y) for east and west, 0 for north and south.
    pub(super) fn across(self) -> usize {
        usize::from(matches!(self, Direction::East | Direction::West))
    }

    /// Direction from one lattice point to the next.
    pub(super) fn of(from: [i32; 2], to: [i32; 2]) -> Direction {
        match [to[0] - from[0], to[1] - from[1]] {
            [1, 0] => Direction::East,
            [0, 1] => Direction::South,
            [-1, 0] => Direction::West,
            _ => Direction::North,
        }
    }
}

/// Position of the true edge beside a pixel edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    /// Pixels from the top left, y down.
    pub(super) at: [f64; 2],
    /// Largest distance of a line that still fits the sample, pixels.
    pub(super) tolerance: f64,
    /// Weight in line fits, 0 or 1.
    pub(super) weight: f64,
}

/// Part of a boundary: closed, or from one image side to another.
///
/// A run is one pixel edge, or many in the middle of a long straight stretch, where no piece may start or end.
#[derive(Clone, Debug)]
pub(super) struct Runs {
    pub(super) closed: bool,
    /// Lattice points where runs start; on an open boundary also the end of the last.
    corners: Vec<[i32; 2]>,
    directions: Vec<Direction>,
    /// Samples of run `k` are `samples[starts[k]..starts[k + 1]]`.
    starts: Vec<usize>,
    samples: Vec<Sample>,
}

impl Runs {
    /// Builds runs from lattice points (first not repeated if closed) and a sample per pixel edge.
    pub(super) fn new(closed: bool, points: &[[i32; 2]], samples: &[Sample]) -> Runs {
        let n = samples.len();
        let point = |k: usize| points[k % points.len()];
        let direction = |k: usize| Direction::of(point(k % n), point(k % n + 1));
        // A closed boundary starts at a turn.
        let first = if closed { (0..n).find(|&k| direction(k) != direction((k + n - 1) % n)).unwrap_or(0) } else { 0 };
        let mut runs =
            Runs { closed, corners: Vec::new(), directions: Vec::new(), starts: Vec::new(), samples: Vec::new() };
        let mut step = 0;
        while step < n {
            let this = direction(first + step);
            let length = (step..n).take_while(|&s| direction(first + s) == this).count();
            for part in parts(length) {
                runs.corners.push(point(first + step));
                runs.directions.push(this);
                runs.starts.push(step);
                runs.samples.extend((step..step + part).map(|s| samples[(first + s) % n]));
                step += part;
            }
        }
        runs.starts.push(n);
        if !closed {
            runs.corners.push(point(n));
        }
        runs
    }

    /// Number of runs.
    pub(super) fn len(&self) -> usize {
        self.directions.len()
    }

    /// Lattice point at which run `k` starts; wraps around on a closed boundary.
    pub(super) fn corner(&self, k: usize) -> [f64; 2] {
        self.corners[k % self.corners.len()].map(f64::from)
    }

    pub(super) fn direction(&self, k: usize) -> Direction {
        self.directions[k % self.len()]
    }

    /// Samples of run `k`, in order; wraps around on a closed boundary.
    pub(super) fn samples(&self, k: usize) -> &[Sample] {
        let k = k % self.len();
        &self.samples[self.starts[k]..self.starts[k + 1]]
    }

    /// Axis perpendicular to most pixel edges of the runs `from..to`: 1 (y) for a rather horizontal piece.
    pub(super) fn main_across(&self, from: usize, to: usize) -> usize {
        let horizontal: usize =
            (from..to).filter(|&k| self.direction(k).across() == 1).map(|k| self.samples(k).len()).sum();
        usize::from(horizontal * 2 >= self.edges(from, to))
    }

    /// Samples of the runs `from..to`.
    pub(super) fn samples_of(&self, from: usize, to: usize) -> impl Iterator<Item = &Sample> + Clone {
        (from..to).flat_map(|k| self.samples(k))
    }

    /// Number of pixel edges in the runs `from..to`.
    pub(super) fn edges(&self, from: usize, to: usize) -> usize {
        let before = |k: usize| self.starts[k % self.len()] + k / self.len() * self.samples.len();
        before(to) - before(from)
    }
}

/// Run lengths of a straight stretch: single pixel edges, and one long run amid a long stretch.
fn parts(length: usize) -> impl Iterator<Item = usize> {
    const SINGLE_AT_EACH_END: usize = 8;
    let amid = if length > 2 * SINGLE_AT_EACH_END + 1 { length - 2 * SINGLE_AT_EACH_END } else { 1 };
    let count = length - amid + 1;
    (0..count).map(move |k| if k == SINGLE_AT_EACH_END.min(count - 1) { amid } else { 1 })
}
