//! Least-squares lines.

use super::runs::{Runs, Sample};

/// Sums over samples that give a least-squares line and its error in constant time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Moments {
    /// Adds a sample relative to `origin`.
    pub(super) fn add(&mut self, sample: &Sample, origin: [f64; 2]) {
        let (x, y, weight) = (sample.at[0] - origin[0], sample.at[1] - origin[1], sample.weight);
        self.n += weight;
        self.x += weight * x;
        self.y += weight * y;
        self.xx += weight * x * x;
        self.xy += weight * x * y;
        self.yy += weight * y * y;
    }

    fn combined(self, other: Moments, sign: f64) -> Moments {
        Moments {
            n: self.n + sign * other.n,
            x: self.x + sign * other.x,
            y: self.y + sign * other.y,
            xx: self.xx + sign * other.xx,
            xy: self.xy + sign * other.xy,
            yy: self.yy + sign * other.yy,
        }
    }

    /// Computes the total least-squares line: the principal axis of the scatter matrix.
    pub(super) fn line(&self) -> Fit {
        let n = self.n.max(1.0);
        let through = [self.x / n, self.y / n];
        let (xx, xy, yy) =
            (self.xx - self.x * self.x / n, self.xy - self.x * self.y / n, self.yy - self.y * self.y / n);
        let (half, mean) = ((xx - yy) * 0.5, (xx + yy) * 0.5);
        let root = (half * half + xy * xy).sqrt();
        // The eigenvector of the larger eigenvalue, from the row that loses no digits.
        let along = if half >= 0.0 { [half + root, xy] } else { [xy, root - half] };
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let along = if length > 0.0 { along.map(|c| c / length) } else { [1.0, 0.0] };
        Fit { line: Line { through, along }, squares: (mean - root).max(0.0) }
    }
}

/// A fitted line and the sum of squared distances of its samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) line: Line,
    pub(super) squares: f64,
}

/// A line in the image, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) through: [f64; 2],
    /// Unit vector.
    pub(super) along: [f64; 2],
}

impl Line {
    /// Signed distance of a point.
    pub(super) fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        (y - self.through[1]) * self.along[0] - (x - self.through[0]) * self.along[1]
    }

    /// Returns the nearest point on the line.
    pub(super) fn project(&self, p: [f64; 2]) -> [f64; 2] {
        let d = self.distance(p);
        [p[0] + d * self.along[1], p[1] - d * self.along[0]]
    }

    /// Intersection of two lines; `None` if parallel.
    pub(super) fn crossing(&self, other: &Line) -> Option<[f64; 2]> {
        let ([ax, ay], [bx, by]) = (self.along, other.along);
        let sine = ax * by - ay * bx;
        if sine.abs() < 1e-9 {
            return None;
        }
        let apart = [other.through[0] - self.through[0], other.through[1] - self.through[1]];
        let t = (apart[0] * by - apart[1] * bx) / sine;
        Some([self.through[0] + t * ax, self.through[1] + t * ay])
    }
}

/// Moments of any piece of a boundary, by prefix sums over its runs.
pub(super) struct PieceMoments {
    origin: [f64; 2],
    /// Prefix sums by run; on a closed boundary over two rounds.
    before: Vec<Moments>,
}

impl PieceMoments {
    pub(super) fn new(runs: &Runs) -> PieceMoments {
        // The origin is on the boundary, so that differences of sums keep their digits.
        let origin = runs.corner(runs.len() / 2);
        let mut sum = Moments::default();
        let rounds = if runs.closed { 2 } else { 1 };
        let mut before = vec![sum];
        for k in 0..rounds * runs.len() {
            for s in runs.samples(k) {
                sum.add(s, origin);
            }
            before.push(sum);
        }
        PieceMoments { origin, before }
    }

    /// Fits a line to the runs `from..to`.
    pub(super) fn fit(&self, from: usize, to: usize) -> Fit {
        let mut fit = self.before[to].combined(self.before[from], -1.0).line();
        fit.line.through = [fit.line.through[0] + self.origin[0], fit.line.through[1] + self.origin[1]];
        fit
    }
}
