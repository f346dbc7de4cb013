use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::lattice::Lattice;
use crate::math::{Rect, Vec2, vec2};
use crate::plan::{FloorPlan, Opening, Side};
use crate::walls::{APRON_M, Walls};

/// Upper bound of stored clearances, metres.
pub(crate) const CLEARANCE_LIMIT_M: f64 = 3.0;
/// Resolution of the ground: cell size, and least clearance of the narrowest person.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fineness {
    /// Side of a cell, metres.
    cell_m: f64,
    /// Least distance of a person's centre from walls, metres.
    least_clearance_m: f64,
}

/// Wanted number of cells; the cell size follows, from [`FINEST_M`] to [`COARSEST_M`].
const CELLS_WANTED: f64 = 400_000.0;
const FINEST_M: f64 = 0.1;
const COARSEST_M: f64 = 0.25;
/// Least clearance, metres: a passage of 0.44 m contains a row of cells.
const LEAST_CLEARANCE_M: f64 = 0.16;
/// A person turned sideways passes 0.4 m, but not 0.3 m: least clearance and cell size for that, metres.
const SIDEWAYS_CLEARANCE_M: f64 = 0.165;
const SIDEWAYS_CELL_M: f64 = 0.06;
/// Largest floor on which this resolution is tried, square metres.
const SIDEWAYS_FLOOR_M2: f64 = 15_000.0;

impl Fineness {
    /// Resolutions to try in order until every route reaches its goal.
    ///
    /// First cells fit the floor's size, then cells resolve every narrow passage, last people turn sideways.
    pub(crate) fn attempts(plan: &FloorPlan) -> Vec<Fineness> {
        let pixel_m2 = plan.metres_per_pixel * plan.metres_per_pixel;
        let floor_m2 = plan.floor.iter().filter(|&&f| f != 0).count() as f64 * pixel_m2;
        let cell_m = (floor_m2 / CELLS_WANTED).sqrt().clamp(FINEST_M, COARSEST_M);
        let mut attempts = vec![Fineness { cell_m, least_clearance_m: LEAST_CLEARANCE_M }];
        if cell_m > FINEST_M {
            attempts.push(Fineness { cell_m: FINEST_M, least_clearance_m: LEAST_CLEARANCE_M });
        }
        if floor_m2 <= SIDEWAYS_FLOOR_M2 {
            attempts.push(Fineness { cell_m: SIDEWAYS_CELL_M, least_clearance_m: SIDEWAYS_CLEARANCE_M });
        }
        attempts
    }
}

/// Walkable floor and aprons in cells, with the distance to the nearest wall.
#[derive(Debug)]
pub(crate) struct Ground {
    pub(crate) lattice: Lattice,
    /// Clearance of the cell's centre, metres, at most [`CLEARANCE_LIMIT_M`]; 0 off the floor.
    clearance_m: Vec<f32>,
    /// Connected part of a walkable cell, from 1; 0 for other cells.
    part: Vec<u16>,
    /// Distance from walls that people can keep in each cell, metres, see [`Ground::gap_limit_m`].
    gap_limit_m: Vec<f32>,
    /// Plan and aprons, minus a margin.
    extent: Rect,
}

/// Distance from a narrow place within which people make themselves narrow, metres.
const GAP_REACH_M: f64 = 0.7;
/// Clearance above which there is plenty of room, metres.
const PLENTY_M: f32 = 0.9;
/// Distance from walls that people can keep there, metres: more than the 0.5 m of the Grime paper.
const KEPT_M: f32 = 0.55;

impl Ground {
    /// Measures the ground of a plan.
    pub(crate) fn new(plan: &FloorPlan, walls: &Walls, fineness: Fineness) -> Ground {
        let Fineness { cell_m, least_clearance_m } = fineness;
        let aprons: Vec<Rect> = plan.openings.iter().map(apron).collect();
        let area = Rect { min: Vec2::ZERO, max: vec2(plan.width_m(), plan.height_m()) }.grown(APRON_M + cell_m);
        let lattice =
            Lattice::new(area, cell_m, |block| aprons.iter().any(|a| a.overlaps(block)) || holds_floor(plan, block));
        let is_inside = |p: Vec2| plan.is_floor(p) || aprons.iter().any(|a| a.contains(p));
        let inside: Vec<bool> = (0..lattice.len()).into_par_iter().map(|c| is_inside(lattice.centre(c))).collect();
        let clearance_m = clearances(&lattice, &inside, walls);
        let part = parts(&lattice, &clearance_m, least_clearance_m);
        let gap_limit_m = gap_limits(&lattice, &clearance_m, &part);
        let extent = Rect { min: Vec2::ZERO, max: vec2(plan.width_m(), plan.height_m()) }.grown(APRON_M - 0.1);
        Ground { lattice, clearance_m, part, gap_limit_m, extent }
    }

    /// Whether the centre of a narrow person can be in this cell's centre.
    #[inline]
    pub(crate) fn is_walkable(&self, cell: usize) -> bool {
        self.part[cell] != 0
    }

    /// Connected part of a cell, from 1; 0 if it is not walkable.
    pub(crate) fn part(&self, cell: usize) -> u16 {
        self.part[cell]
    }

    /// Distance from a cell's centre to the nearest wall, metres.
    #[inline]
    pub(crate) fn cell_clearance_m(&self, cell: usize) -> f64 {
        f64::from(self.clearance_m[cell])
    }

    /// Lower bound on the distance from `p` to the nearest wall, metres; 0 off the floor.
    #[inline]
    pub(crate) fn clearance_at_least_m(&self, p: Vec2) -> f64 {
        match self.lattice.cell_at(p) {
            // Half a diagonal, and the small error of propagated nearest points.
            Some(cell) => (self.cell_clearance_m(cell) - 0.75 * self.lattice.cell_m()).max(0.0),
            None => 0.0,
        }
    }

    /// Clearance at `p`, interpolated, metres.
    pub(crate) fn clearance_m(&self, p: Vec2) -> f64 {
        self.lattice
            .stencil(p)
            .iter()
            .map(|(cell, weight)| cell.map_or(0.0, |c| self.cell_clearance_m(c)) * weight)
            .sum()
    }

    /// The point nearest to `p` within the reach of the aprons.
    #[inline]
    pub(crate) fn within_aprons(&self, p: Vec2) -> Vec2 {
        vec2(p.x.clamp(self.extent.min.x, self.extent.max.x), p.y.clamp(self.extent.min.y, self.extent.max.y))
    }

    /// Distance from walls that people can keep even where walls are close on both sides, metres. Large in the
    /// open, 0.15 m in a door of 0.8 m, and always less than the clearance of the nearest walkable cell.
    #[inline]
    pub(crate) fn gap_limit_m(&self, p: Vec2) -> f64 {
        self.lattice.cell_at(p).map_or(0.0, |cell| f64::from(self.gap_limit_m[cell]))
    }

    /// The walkable cell nearest to `p` within `within_m` metres.
    pub(crate) fn walkable_near(&self, p: Vec2, within_m: f64) -> Option<usize> {
        if let Some(cell) = self.lattice.cell_at(p)
            && self.is_walkable(cell)
        {
            return Some(cell);
        }
        let cell_m = self.lattice.cell_m();
        let reach = (within_m / cell_m).ceil() as i64;
        let mut best: Option<(f64, usize)> = None;
        for row in -reach..=reach {
            for column in -reach..=reach {
                let q = p + vec2(column as f64, row as f64) * cell_m;
                if let Some(cell) = self.lattice.cell_at(q)
                    && self.is_walkable(cell)
                {
                    let d = self.lattice.centre(cell).distance(p);
                    if d <= within_m + 0.5 * cell_m && best.is_none_or(|(least, _)| d < least) {
                        best = Some((d, cell));
                    }
                }
            }
        }
        best.map(|b| b.1)
    }

    /// Whether no wall crosses the line from `a` to `b`; exact, but mostly decided by clearances.
    #[inline]
    pub(crate) fn sight(&self, walls: &Walls, a: Vec2, b: Vec2) -> bool {
        let distance = a.distance(b);
        if distance < 1e-9 {
            return true;
        }
        let direction = (b - a) / distance;
        let mut done = 0.0;
        for _ in 0..24 {
            let free = self.clearance_at_least_m(a + direction * done);
            if done + free >= distance {
                return true;
            }
            if free < 0.05 {
                break;
            }
            done += free;
        }
        walls.sight(a + direction * done, b)
    }
}

impl Ground {
    /// Whether a person can walk straight from `a` to `b` at least `margin_m` from walls. Clearance is as exact as the
    /// cells; crossing of walls is exact.
    pub(crate) fn is_free(&self, walls: &Walls, a: Vec2, b: Vec2, margin_m: f64) -> bool {
        let distance = a.distance(b);
        let direction = (b - a) / distance.max(1e-9);
        let mut done = 0.0;
        let mut narrow = false;
        while done < distance {
            let at = a + direction * done;
            let free = self.lattice.cell_at(at).map_or(0.0, |c| self.cell_clearance_m(c)) - margin_m;
            if free < 0.0 {
                return false;
            }
            narrow |= free < 2.0 * self.lattice.cell_m();
            done += free.max(self.lattice.cell_m());
        }
        !narrow || walls.sight(a, b)
    }
}

impl Ground {
    /// Area of a connected part, square metres.
    pub(super) fn part_area_m2(&self, part: u16) -> f64 {
        let cells = self.part.iter().filter(|&&p| part != 0 && p == part).count();
        cells as f64 * self.lattice.cell_m() * self.lattice.cell_m()
    }

    /// The narrowest point of the widest path between two cells, and its approximate width, metres. The path is too
    /// narrow for a person, but not closed.
    pub(super) fn narrowest_between(&self, from: usize, to: usize) -> Option<(Vec2, f64)> {
        let clearance = |cell: usize| (self.clearance_m[cell] * 1e4) as u32;
        let least = (0.51e4 * self.lattice.cell_m()).min(500.0) as u32;
        // Cell of least clearance on the widest path to each cell.
        let mut narrowest: Vec<Option<usize>> = vec![None; self.lattice.len()];
        let mut open = BinaryHeap::from([(clearance(from), from, from)]);
        while let Some((width, cell, at)) = open.pop() {
            if narrowest[cell].is_some() {
                continue;
            }
            narrowest[cell] = Some(at);
            if cell == to {
                return Some((self.lattice.centre(at), 2.0 * self.cell_clearance_m(at)));
            }
            for beside in self.lattice.beside(cell) {
                let own = clearance(beside);
                if own > least && narrowest[beside].is_none() {
                    open.push(if own < width { (own, beside, beside) } else { (width, beside, at) });
                }
            }
        }
        None
    }
}

/// The rectangle of the apron beyond an opening.
pub(crate) fn apron(opening: &Opening) -> Rect {
    let out = opening.side.outward() * APRON_M;
    let edge = Rect::around(opening.from_m, opening.to_m);
    match opening.side {
        Side::West | Side::South => Rect { min: edge.min + out, max: edge.max },
        Side::East | Side::North => Rect { min: edge.min, max: edge.max + out },
    }
}

/// Whether any pixel in a rectangle is floor.
fn holds_floor(plan: &FloorPlan, area: Rect) -> bool {
    let [x0, y1] = plan.m_to_px(area.min);
    let [x1, y0] = plan.m_to_px(area.max);
    let columns = x0.floor().max(0.0) as usize..(x1.ceil().max(0.0) as usize).min(plan.width_px as usize);
    let rows = y0.floor().max(0.0) as usize..(y1.ceil().max(0.0) as usize).min(plan.height_px as usize);
    !columns.is_empty()
        && rows.into_iter().any(|row| {
            let start = row * plan.width_px as usize;
            plan.floor[start + columns.start..start + columns.end].iter().any(|&f| f != 0)
        })
}

/// Distance to the nearest wall per cell: exact beside walls, elsewhere from nearest points propagated to adjacent
/// cells in order of distance.
fn clearances(lattice: &Lattice, inside: &[bool], walls: &Walls) -> Vec<f32> {
    let near = near_walls(lattice, walls);
    let cell_m = lattice.cell_m();
    let mut nearest: Vec<[f32; 2]> = vec![[f32::NAN; 2]; lattice.len()];
    nearest.par_iter_mut().enumerate().filter(|(cell, _)| inside[*cell] && near[*cell]).for_each(|(cell, nearest)| {
        if let Some(n) = walls.nearest(lattice.centre(cell), 3.0 * cell_m) {
            *nearest = [n.point_m.x as f32, n.point_m.y as f32];
        }
    });
    let distance = |cell: usize, [x, y]: [f32; 2]| lattice.centre(cell).distance(vec2(f64::from(x), f64::from(y)));
    let mut clearance: Vec<f32> = inside.iter().map(|&i| if i { CLEARANCE_LIMIT_M as f32 } else { 0.0 }).collect();
    let width = cell_m * 0.5;
    let mut buckets: Vec<Vec<u32>> = vec![Vec::new(); (CLEARANCE_LIMIT_M / width) as usize + 2];
    for cell in 0..lattice.len() {
        if !nearest[cell][0].is_nan() {
            clearance[cell] = distance(cell, nearest[cell]) as f32;
            buckets[(f64::from(clearance[cell]) / width) as usize].push(cell as u32);
        }
    }
    for bucket in 0..buckets.len() {
        let mut next = 0;
        while let Some(&cell) = buckets[bucket].get(next) {
            next += 1;
            let cell = cell as usize;
            if (f64::from(clearance[cell]) / width) as usize != bucket {
                continue; // found a nearer wall meanwhile
            }
            for beside in lattice.beside(cell).filter(|&b| inside[b]) {
                let d = distance(beside, nearest[cell]) as f32;
                if d + 1e-6 < clearance[beside] {
                    clearance[beside] = d;
                    nearest[beside] = nearest[cell];
                    buckets[(f64::from(d) / width) as usize].push(beside as u32);
                }
            }
        }
        buckets[bucket] = Vec::new();
    }
    clearance
}

/// Marks the cells on a wall and the cells around them.
fn near_walls(lattice: &Lattice, walls: &Walls) -> Vec<bool> {
    let mut near = vec![false; lattice.len()];
    let mut segments = Vec::new();
    walls.segments_near(walls.bounds_m().grown(2.0 * APRON_M), &mut segments);
    for s in segments {
        let steps = (s.a.distance(s.b) / (0.5 * lattice.cell_m())).ceil().max(1.0);
        for k in 0..=steps as usize {
            let p = s.a.lerp(s.b, k as f64 / steps);
            for row in -1..=1 {
                for column in -1..=1 {
                    let q = p + vec2(f64::from(column), f64::from(row)) * lattice.cell_m();
                    if let Some(cell) = lattice.cell_at(q) {
                        near[cell] = true;
                    }
                }
            }
        }
    }
    near
}

/// Numbers the connected walkable parts from 1, in the order of their first cells.
fn parts(lattice: &Lattice, clearance_m: &[f32], least_clearance_m: f64) -> Vec<u16> {
    // Cells on both sides of a wall must not be adjacent, so least clearance is half a cell.
    let least = least_clearance_m.max(0.51 * lattice.cell_m()) as f32;
    let mut part = vec![0u16; lattice.len()];
    let mut count = 0u16;
    for first in 0..lattice.len() {
        if part[first] != 0 || clearance_m[first] < least {
            continue;
        }
        // Parts beyond the 65 535th share the last number; so many parts are always slivers.
        count = count.saturating_add(1);
        part[first] = count;
        lattice.joined(first, |cell| {
            let joins = part[cell] == 0 && clearance_m[cell] >= least;
            if joins {
                part[cell] = count;
            }
            joins
        });
    }
    part
}

/// Distance from walls that people can keep in each cell, metres: [`KEPT_M`] in the open.
///
/// Midway between two walls at a distance of `2 c`, as in a door, it is `0.71 c - 0.13`, at least 0.1 m: 0.15 m in a
/// door of 0.8 m, so that two people pass each other. The same limit holds on all paths from [`GAP_REACH_M`] on, so
/// that people who keep 0.5 m off walls still reach and pass the door. It is at most 0.9 of the clearance in the cells
/// around, so that all walkable cells can be reached.
fn gap_limits(lattice: &Lattice, clearance_m: &[f32], part: &[u16]) -> Vec<f32> {
    let cell_m = lattice.cell_m();
    let at = |p: Vec2| lattice.cell_at(p).map_or(0.0, |other| clearance_m[other]);
    let is_between_walls = |cell: usize| {
        let centre = lattice.centre(cell);
        let reach_m = (2.0 * cell_m).max(0.2);
        // Midway may be between two cells.
        let less = (0.3 * reach_m) as f32;
        let lower = |x: f64, y: f64| clearance_m[cell] - at(centre + vec2(x, y) * reach_m) >= less;
        [(1.0, 0.0), (0.0, 1.0), (0.7, 0.7), (0.7, -0.7)].iter().any(|&(x, y)| lower(x, y) && lower(-x, -y))
    };
    let own = |cell: usize| {
        let own = clearance_m[cell];
        if part[cell] != 0 && own < PLENTY_M && is_between_walls(cell) { (0.71 * own - 0.13).max(0.1) } else { KEPT_M }
    };
    let mut limits: Vec<f32> = (0..clearance_m.len()).into_par_iter().map(own).collect();
    for _ in 0..(GAP_REACH_M / cell_m).round() as usize {
        let before = &limits;
        let least = |cell: usize| {
            let beside = lattice.beside(cell).filter(|&b| part[b] != 0);
            let least = beside.map(|b| before[b]).fold(before[cell], f32::min);
            if part[cell] == 0 { before[cell] } else { least }
        };
        limits = (0..clearance_m.len()).into_par_iter().map(least).collect();
    }
    let allowed = |(cell, limit): (usize, &f32)| {
        let near = lattice.beside(cell).map(|b| clearance_m[b]);
        let near = near.fold(clearance_m[cell], f32::max);
        // A cell that is not walkable follows the nearest walkable one.
        if near < PLENTY_M { limit.min(0.9 * near).max(0.0) } else { *limit }
    };
    limits.par_iter().enumerate().map(allowed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walls::WallsOptions;

    fn ground(rows: &[&str], metres_per_pixel: f64) -> (Ground, Walls) {
        let floor = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'.')).collect();
        let plan = FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, metres_per_pixel, floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        (Ground::new(&plan, &walls, Fineness::attempts(&plan)[0]), walls)
    }

    #[test]
    fn clearances_are_distances_to_the_nearest_wall() {
        let (ground, walls) = ground(&["########", "........", "...##...", "........", "########"], 1.0);
        let mut checked = 0;
        for cell in 0..ground.lattice.len() {
            let p = ground.lattice.centre(cell);
            let measured = ground.cell_clearance_m(cell);
            if measured > 0.0 && p.x > -2.0 && p.x < 10.0 {
                let exact = walls.nearest(p, 5.0).map_or(CLEARANCE_LIMIT_M, |n| n.distance_m);
                assert!((measured - exact).abs() < 0.02, "at {p:?}: {measured} instead of {exact}");
                checked += 1;
            }
        }
        assert!(checked > 2000);
    }

    #[test]
    fn a_thin_wall_separates_parts_and_a_narrow_gap_joins_them() {
        let closed = ["#####", "..#..", "..#..", "..#..", "#####"];
        let (ground, _) = ground_of(&closed);
        let part = |x: f64| ground.part(ground.lattice.cell_at(vec2(x, 1.0)).expect("a cell"));
        assert!(part(0.4) != 0 && part(1.8) != 0 && part(0.4) != part(1.8));
        let open = ["#####", "..#..", ".....", "..#..", "#####"];
        let (ground, _) = ground_of(&open);
        let part = |x: f64| ground.part(ground.lattice.cell_at(vec2(x, 1.0)).expect("a cell"));
        assert_eq!(part(0.4), part(1.8));
    }

    fn ground_of(rows: &[&str]) -> (Ground, Walls) {
        ground(rows, 0.44)
    }

    #[test]
    fn sight_agrees_with_the_walls() {
        let (ground, walls) = ground(&["########", "........", "...##...", "........", "########"], 1.0);
        for k in 0..400 {
            let t = f64::from(k);
            let a = vec2(0.3 + (t * 0.37) % 7.4, 1.2 + (t * 0.71) % 2.6);
            let b = vec2(0.3 + (t * 1.93) % 7.4, 1.2 + (t * 0.29) % 2.6);
            if walls.is_inside(a) && walls.is_inside(b) {
                assert_eq!(ground.sight(&walls, a, b), walls.sight(a, b), "from {a:?} to {b:?}");
            }
        }
    }
}
