//! Exact area coverage of texels by floor.
//!
//! Scan conversion by signed areas with integer cells, as in the rasterisers of FreeType and libart. In each texel that
//! it crosses, an edge adds the signed area between itself and the texel's right side; to all texels further right it
//! adds its height. Coordinates are rounded to 1/4096 texel first and all later steps are integer, so a texel's value
//! does not depend on the requested rectangle.

use super::outline::Outline;
use crate::math::Vec2;

/// Fixed-point bits of a texel.
const BITS: u32 = 12;
const ONE: i64 = 1 << BITS;

/// Height of a band, metres.
const BAND_M: f64 = 0.5;

/// Edges of the floor, in horizontal bands.
#[derive(Debug)]
pub(super) struct Edges {
    bottom_m: f64,
    /// Edges that touch band `k` are `edges[starts[k]..starts[k + 1]]`, by ascending least x.
    starts: Vec<u32>,
    edges: Vec<BandEdge>,
}

#[derive(Clone, Copy, Debug)]
struct BandEdge {
    a: Vec2,
    b: Vec2,
    /// Lowest band that holds this edge; the edge is counted there if several bands are read.
    first_band: u32,
}

impl Edges {
    pub(super) fn new<'a>(outlines: impl Iterator<Item = &'a Outline> + Clone) -> Edges {
        let points = || outlines.clone().flat_map(|o| &o.points_m);
        let bottom_m = points().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let top_m = points().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
        if bottom_m > top_m {
            return Edges { bottom_m: 0.0, starts: vec![0], edges: Vec::new() };
        }
        let bands = ((top_m - bottom_m) / BAND_M) as usize + 1;
        let band_of = |y: f64| (((y - bottom_m) / BAND_M) as usize).min(bands - 1);
        let mut by_band: Vec<(usize, BandEdge)> = Vec::new();
        for outline in outlines {
            for k in 0..outline.points_m.len() {
                let [a, b] = outline.edge(k);
                if a.y != b.y {
                    let (low, high) = (band_of(a.y.min(b.y)), band_of(a.y.max(b.y)));
                    let edge = BandEdge { a, b, first_band: low as u32 };
                    by_band.extend((low..=high).map(|band| (band, edge)));
                }
            }
        }
        by_band.sort_by(|(i, e), (j, f)| i.cmp(j).then(e.least_x().total_cmp(&f.least_x())));
        let mut starts = vec![0u32; bands + 1];
        for (band, _) in &by_band {
            starts[band + 1] += 1;
        }
        for k in 0..bands {
            starts[k + 1] += starts[k];
        }
        Edges { bottom_m, starts, edges: by_band.into_iter().map(|e| e.1).collect() }
    }

    pub(super) fn coverage(
        &self,
        texels_per_metre: f64,
        i0: i64,
        j0: i64,
        width: usize,
        height: usize,
        out: &mut [f32],
    ) {
        let mut sums = Accumulator::new(i0, j0, width, height);
        let bands = self.starts.len() - 1;
        let band_of = |j: i64| (j as f64 / texels_per_metre - self.bottom_m) / BAND_M;
        // One band more on either side: rounding to 1/4096 texel may move an edge across a band's border.
        let (low, high) = (band_of(j0) - 1.0, band_of(j0 + height as i64) + 1.0);
        if bands > 0 && high >= 0.0 && low < bands as f64 {
            let (low, high) = (low.max(0.0) as usize, (high as usize).min(bands - 1));
            let right_m = (i0 + width as i64 + 1) as f64 / texels_per_metre;
            for band in low..=high {
                let range = self.starts[band] as usize..self.starts[band + 1] as usize;
                for edge in self.edges[range].iter().take_while(|e| e.least_x() < right_m) {
                    if edge.first_band as usize == band || band == low {
                        sums.add(fixed(edge.a, texels_per_metre), fixed(edge.b, texels_per_metre));
                    }
                }
            }
        }
        sums.resolve(out);
    }
}

impl BandEdge {
    fn least_x(&self) -> f64 {
        self.a.x.min(self.b.x)
    }
}

/// Converts metres to fixed-point texels.
fn fixed(p: Vec2, texels_per_metre: f64) -> [i64; 2] {
    [p.x, p.y].map(|m| (m * texels_per_metre * ONE as f64).round() as i64)
}

/// Signed heights and areas of one rectangle of texels.
struct Accumulator {
    left: i64,
    bottom: i64,
    width: usize,
    height: usize,
    /// Per texel: twice the signed area right of its edges, minus the full height counted in `cover`.
    area: Vec<i64>,
    /// Per texel, and one column before: signed height of its edges.
    cover: Vec<i64>,
    /// Differences along y of the signed height of edges left of the rectangle.
    before: Vec<i64>,
}

impl Accumulator {
    fn new(i0: i64, j0: i64, width: usize, height: usize) -> Accumulator {
        Accumulator {
            left: i0,
            bottom: j0,
            width,
            height,
            area: vec![0; width * height],
            cover: vec![0; width * height],
            before: vec![0; height + 1],
        }
    }

    /// Adds an edge; upward edges count positive.
    fn add(&mut self, a: [i64; 2], b: [i64; 2]) {
        let (sign, low, high) = if a[1] < b[1] { (1, a, b) } else { (-1, b, a) };
        if low[1] == high[1] {
            return;
        }
        let left = self.left * ONE;
        let bottom = self.bottom * ONE;
        let top = bottom + self.height as i64 * ONE;
        if high[1] <= bottom || low[1] >= top {
            return;
        }
        let y_at = |x: i64| crossing([low[0], low[1]], [high[0], high[1]], x);
        // The edge in order of x, clipped to the rectangle's left and right side.
        let (start, end) = if low[0] <= high[0] { (low, high) } else { (high, low) };
        let right = left + self.width as i64 * ONE;
        if end[0] <= left {
            self.add_before(sign, low[1], high[1]);
            return;
        }
        if start[0] >= right {
            return;
        }
        let mut from = start;
        if start[0] < left {
            let y = y_at(left);
            self.add_before(sign, start[1].min(y), start[1].max(y));
            from = [left, y];
        }
        let to = if end[0] > right { [right, y_at(right)] } else { end };
        if from[0] == to[0] {
            self.add_in_column(sign, from, to);
            return;
        }
        // Split the edge by columns.
        while from[0] < to[0] {
            let next = (from[0].div_euclid(ONE) + 1) * ONE;
            let cut = if next < to[0] { [next, y_at(next)] } else { to };
            self.add_in_column(sign, from, cut);
            from = cut;
        }
    }

    /// Adds the height `low..high` of an edge left of the rectangle.
    fn add_before(&mut self, sign: i64, low: i64, high: i64) {
        let bottom = self.bottom * ONE;
        let top = bottom + self.height as i64 * ONE;
        let (low, high) = (low.max(bottom) - bottom, high.min(top) - bottom);
        if low >= high {
            return;
        }
        // Differences along y: a row's own height, and the carry to all rows above.
        let (first, last) = (low / ONE, (high - 1) / ONE);
        if first == last {
            self.before[first as usize] += sign * (high - low);
            self.before[first as usize + 1] -= sign * (high - low);
        } else {
            let bottom_part = (first + 1) * ONE - low;
            self.before[first as usize] += sign * bottom_part;
            self.before[first as usize + 1] += sign * (ONE - bottom_part);
            let top_part = high - last * ONE;
            self.before[last as usize] -= sign * (ONE - top_part);
            self.before[last as usize + 1] -= sign * top_part;
        }
    }

    /// Adds a piece of an edge within one column of texels.
    fn add_in_column(&mut self, sign: i64, from: [i64; 2], to: [i64; 2]) {
        let (low, high) = if from[1] <= to[1] { (from, to) } else { (to, from) };
        let bottom = self.bottom * ONE;
        let top = bottom + self.height as i64 * ONE;
        if low[1] >= high[1] || high[1] <= bottom || low[1] >= top {
            return;
        }
        let column = from[0].min(to[0]).div_euclid(ONE) - self.left;
        // A vertical edge on the rectangle's right side covers no texel.
        if column >= self.width as i64 {
            return;
        }
        let texel_left = (self.left + column) * ONE;
        let x_at = |y: i64| {
            if y <= low[1] {
                low[0]
            } else if y >= high[1] {
                high[0]
            } else {
                crossing([low[1], low[0]], [high[1], high[0]], y)
            }
        };
        let mut y = low[1].max(bottom);
        let end = high[1].min(top);
        while y < end {
            let row = y.div_euclid(ONE);
            let next = ((row + 1) * ONE).min(end);
            let height = next - y;
            let cell = (row - self.bottom) as usize * self.width + column as usize;
            // Twice the mean distance of both ends to the texel's left side.
            let twice_x = x_at(y) + x_at(next) - 2 * texel_left;
            self.cover[cell] += sign * height;
            self.area[cell] += sign * height * twice_x;
            y = next;
        }
    }

    fn resolve(&self, out: &mut [f32]) {
        let mut before = 0;
        for row in 0..self.height {
            before += self.before[row];
            let mut cover = before;
            for column in 0..self.width {
                let cell = row * self.width + column;
                cover += self.cover[cell];
                let doubled = 2 * ONE * cover - self.area[cell];
                let share = doubled as f32 / (2 * ONE * ONE) as f32;
                if let Some(texel) = out.get_mut(cell) {
                    *texel = share.clamp(0.0, 1.0);
                }
            }
        }
    }
}

/// Second coordinate of the line `pq` at the first coordinate `at`, which lies between.
fn crossing(p: [i64; 2], q: [i64; 2], at: i64) -> i64 {
    let rise = (q[1] - p[1]) as f64;
    let run = (q[0] - p[0]) as f64;
    let share = (at - p[0]) as f64 / run;
    let value = p[1] + (rise * share).round() as i64;
    value.clamp(p[1].min(q[1]), p[1].max(q[1]))
}
