use super::ground::Ground;
use crate::math::{Vec2, vec2};
use crate::progress::{Interrupted, Progress};

/// Walking distance from every cell to a place, metres; metres near walls cost more.
///
/// Solution of the eikonal equation `|grad d| = cost` with `d = 0` at the place: first-order upwind (Rouy and Tourin
/// 1992, doi 10.1137/0729053), solved in order of distance (Sethian 1996, doi 10.1073/pnas.93.4.1591) with buckets
/// instead of a heap. Every improvement is propagated, so the result does not depend on the order.
///
/// Distances are stored as `f32`. An improvement counts only if it remains after rounding: a cell's distance falls by
/// at least one step of `f32`, so the search ends at any distance.
#[derive(Debug)]
pub(crate) struct Field {
    distance_m: Vec<f32>,
}

/// Additional cost per metre along a wall.
const WALL_COST: f64 = 0.8;
/// Clearance above which walls add no cost, metres.
const EASE_M: f64 = 3.0;
/// Additional cost per metre in the narrowest gaps.
const SQUEEZE_COST: f64 = 4.0;
/// Clearance above which gaps add no cost, metres.
const SQUEEZE_M: f64 = 0.25;

/// Smallest improvement that is propagated, as a share of a cell.
const LEAST_GAIN: f64 = 1e-4;

/// Number of buckets in the ring.
const RING: usize = 16;

/// Cost of a metre at a given clearance. `1 + 0.8 (1 - c / 3 m)^3 + 4 (1 - c / 0.25 m)`, each term at least 0: paths
/// keep off walls where that costs little, prefer the wider of two paths of similar length, and avoid gaps between
/// chairs.
fn cost(clearance_m: f64) -> f64 {
    let near = (1.0 - clearance_m / EASE_M).max(0.0);
    let squeezed = (1.0 - clearance_m / SQUEEZE_M).max(0.0);
    1.0 + WALL_COST * near * near * near + SQUEEZE_COST * squeezed
}

impl Field {
    /// Computes distances to the nearest cell of `goal`, unless `progress` is interrupted.
    pub(super) fn to(ground: &Ground, goal: &[usize], progress: &dyn Progress) -> Result<Field, Interrupted> {
        let seeds = goal.iter().map(|&cell| (cell, 0.0)).collect();
        let field = Field::spread(ground, seeds, |_, _| !progress.interrupted());
        progress.keep_on().map(|()| field)
    }

    /// Computes the least `value + distance` over seeds, value >= 0, in cells that are `wanted`.
    pub(super) fn spread(ground: &Ground, mut seeds: Vec<(usize, f32)>, wanted: impl Fn(usize, f64) -> bool) -> Field {
        let lattice = &ground.lattice;
        let cell_m = lattice.cell_m();
        let mut distance = vec![f32::INFINITY; lattice.len()];
        // A step adds at most `cell_m * (1 + WALL_COST + SQUEEZE_COST)`, so a ring of buckets suffices.
        let width = 0.5 * cell_m;
        let bucket_of = |value: f32| (f64::from(value) / width) as usize;
        let mut buckets: [Vec<u32>; RING] = Default::default();
        let mut waiting = 0usize;
        seeds.retain(|&(cell, _)| ground.is_walkable(cell));
        seeds.sort_by(|a, b| b.1.total_cmp(&a.1).then(b.0.cmp(&a.0)));
        let mut now = seeds.last().map_or(0, |&(_, value)| bucket_of(value));
        while waiting > 0 || !seeds.is_empty() {
            while let Some((cell, value)) = seeds.pop_if(|&mut (_, value)| bucket_of(value) <= now) {
                if value < distance[cell] {
                    distance[cell] = value;
                    buckets[now % RING].push(cell as u32);
                    waiting += 1;
                }
            }
            let mut bucket = std::mem::take(&mut buckets[now % RING]);
            let mut next = 0;
            while let Some(&cell) = bucket.get(next) {
                next += 1;
                waiting -= 1;
                let cell = cell as usize;
                if bucket_of(distance[cell]) != now {
                    continue; // reached on a shorter way meanwhile
                }
                for beside in lattice.around(cell) {
                    // A cell that is no farther cannot improve from here.
                    if beside == usize::MAX || distance[beside] <= distance[cell] || !ground.is_walkable(beside) {
                        continue;
                    }
                    let step = cell_m * cost(ground.cell_clearance_m(beside));
                    let value = upwind(&distance, lattice.around(beside), step);
                    if is_nearer(value, distance[beside], LEAST_GAIN * cell_m) && wanted(beside, value) {
                        distance[beside] = value as f32;
                        let at = bucket_of(distance[beside]);
                        waiting += 1;
                        if at <= now { bucket.push(beside as u32) } else { buckets[at % RING].push(beside as u32) }
                    }
                }
            }
            bucket.clear();
            buckets[now % RING] = bucket;
            now += 1;
        }
        Field { distance_m: distance }
    }

    /// Distance from a cell's centre; infinite if the goal cannot be reached.
    pub(crate) fn of_cell(&self, cell: usize) -> f64 {
        f64::from(self.distance_m[cell])
    }

    /// Distance from `p`, interpolated between walkable cells; infinite without such cells.
    #[inline]
    pub(crate) fn at(&self, ground: &Ground, p: Vec2) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (cell, weight) in ground.lattice.stencil(p) {
            if let Some(cell) = cell
                && self.distance_m[cell].is_finite()
            {
                sum += f64::from(self.distance_m[cell]) * weight;
                weights += weight;
            }
        }
        if weights > 1e-3 {
            return sum / weights;
        }
        ground.walkable_near(p, 0.5).map_or(f64::INFINITY, |cell| self.of_cell(cell))
    }

    /// Unit vector of steepest descent at a cell's centre.
    pub(super) fn slope(&self, ground: &Ground, cell: usize) -> Option<Vec2> {
        let own = self.of_cell(cell);
        let [west, east, south, north] =
            ground.lattice.around(cell).map(|b| if b == usize::MAX { f64::INFINITY } else { self.of_cell(b) });
        // Upwind differences: the same stencil as the solution's.
        let axis = |low: f64, high: f64| {
            if low.min(high) >= own {
                0.0
            } else if low < high {
                low - own
            } else {
                own - high
            }
        };
        vec2(axis(west, east), axis(south, north)).normalized()
    }

    /// Unit vector of steepest descent at `p`; `None` at the goal and where it cannot be reached.
    pub(crate) fn downhill(&self, ground: &Ground, p: Vec2) -> Option<Vec2> {
        let lattice = &ground.lattice;
        let mut slope = Vec2::ZERO;
        for (cell, weight) in lattice.stencil(p) {
            if let Some(cell) = cell.filter(|&c| self.distance_m[c].is_finite())
                && let Some(unit) = self.slope(ground, cell)
            {
                slope += unit * weight;
            }
        }
        if let Some(unit) = slope.normalized().filter(|_| slope.length() > 0.05) {
            return Some(unit);
        }
        // Off the walkable cells, or on a ridge: head for the best cell within two steps.
        let here = ground.walkable_near(p, 0.5)?;
        let beside = |c: usize| lattice.around(c).into_iter().filter(|&b| b != usize::MAX && ground.is_walkable(b));
        let best = beside(here)
            .flat_map(|c| beside(c).chain([c]))
            .chain([here])
            .min_by(|&a, &b| self.of_cell(a).total_cmp(&self.of_cell(b)).then(a.cmp(&b)))?;
        (lattice.centre(best) - p).normalized()
    }
}

/// Whether a distance improves on the stored one by a least gain, also after rounding. At large distances the gain is
/// below a step of `f32`, and a distance that was rounded up would be improved forever.
#[inline]
fn is_nearer(value: f64, kept: f32, least_gain: f64) -> bool {
    value + least_gain < f64::from(kept) && (value as f32) < kept
}

/// Upwind solution in a cell from the distances of its neighbours (west, east, south, north).
#[inline]
fn upwind(distance: &[f32], around: [usize; 4], step: f64) -> f64 {
    let at = |cell: usize| if cell == usize::MAX { f64::INFINITY } else { f64::from(distance[cell]) };
    let a = at(around[0]).min(at(around[1]));
    let b = at(around[2]).min(at(around[3]));
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    if high - low >= step {
        return low + step;
    }
    let gap = high - low;
    0.5 * (low + high + (2.0 * step * step - gap * gap).sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::ground::Fineness;
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::{Walls, WallsOptions};

    fn ground(rows: &[&str], metres_per_pixel: f64) -> Ground {
        let floor = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'.')).collect();
        let plan = FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, metres_per_pixel, floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        Ground::new(&plan, &walls, Fineness::attempts(&plan)[0])
    }

    fn to(ground: &Ground, goal: &[usize]) -> Field {
        Field::to(ground, goal, &crate::Silent).expect("not interrupted")
    }

    #[test]
    fn distance_in_the_open_is_the_straight_one_in_every_direction() {
        let rows: Vec<String> =
            (0..30).map(|y| if y == 0 || y == 29 { "#".repeat(30) } else { format!("#{}#", ".".repeat(28)) }).collect();
        let ground = ground(&rows.iter().map(String::as_str).collect::<Vec<_>>(), 1.0);
        let centre = vec2(15.0, 15.0);
        // The goal is a disc: a point would add the first-order scheme's error at the source.
        let goal: Vec<usize> =
            (0..ground.lattice.len()).filter(|&c| ground.lattice.centre(c).distance(centre) < 2.0).collect();
        let field = to(&ground, &goal);
        for k in 0..36 {
            let (sin, cos) = crate::math::sin_cos(f64::from(k) * 10f64.to_radians());
            let p = centre + vec2(cos, sin) * 10.0;
            let d = field.at(&ground, p);
            assert!((d - 8.0).abs() < 0.25, "towards {} degrees: {d} instead of 8", k * 10);
            let down = field.downhill(&ground, p).expect("a way");
            assert!(down.dot(vec2(-cos, -sin)) > 0.995, "towards {} degrees", k * 10);
        }
    }

    #[test]
    fn the_way_leads_round_walls_and_through_a_door() {
        let ground = ground(&["#######", "#..#..#", "#..#..#", "#..#..#", "#.....#", "#######"], 1.0);
        let goal = ground.lattice.cell_at(vec2(5.0, 4.5)).expect("floor");
        let field = to(&ground, &[goal]);
        let start = vec2(2.0, 4.5);
        let d = field.at(&ground, start);
        assert!(d > 7.0 && d < 13.0, "{d}");
        let mut p = start;
        let mut walked = 0.0;
        while p.distance(ground.lattice.centre(goal)) > 0.15 {
            let down = field.downhill(&ground, p).expect("a way");
            p += down * 0.05;
            walked += 0.05;
            assert!(ground.clearance_m(p) > 0.1, "at {p:?}");
            assert!(walked < 14.0, "walks in circles at {p:?}");
        }
        let closed = self::tests::ground(&["#######", "#..#..#", "#..#..#", "#######"], 1.0);
        let goal = closed.lattice.cell_at(vec2(5.0, 2.0)).expect("floor");
        assert!(to(&closed, &[goal]).at(&closed, vec2(2.0, 2.0)).is_infinite());
    }
}
