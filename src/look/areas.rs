//! Parts of the floor with a material of their own.

use std::cell::RefCell;
use std::sync::Arc;

use super::block::{FLAT_FINELY, LAYERS, ResolvedBlock};
use super::error::LookError;
use super::lattice::TexelWindow;
use super::paint::FloorPainter;
use super::settings::{AreaLook, Look};
use crate::math::{Rect, Vec2, vec2};
use crate::sums::FloorSums;
use crate::walls::Walls;

/// Cells in which a room is found, per metre, and how many at most along a side of the plan.
const CELLS_PER_M: f64 = 20.0;
const MOST_CELLS: f64 = 4096.0;

impl Look {
    /// Checks, before any long computation, that the rooms of its areas are on the floor.
    ///
    /// # Errors
    /// [`LookError::NotInRoom`].
    pub(crate) fn check_areas(&self, walls: &Walls) -> Result<(), LookError> {
        (1..).zip(&self.area).try_for_each(|area| shape(area, walls).map(drop))
    }
}

/// A part of the floor, and the painter of its material.
pub(super) struct FloorArea<'a> {
    shape: Shape,
    bounds: Rect,
    painter: FloorPainter<'a>,
}

/// Where a part of the floor lies.
enum Shape {
    /// Corners in a row.
    Outline(Vec<Vec2>),
    /// Cells of a raster of `columns` that belong to a room; the first is at the plan's origin.
    Room { cell_m: f64, columns: usize, cells: Vec<bool> },
}

impl<'a> FloorArea<'a> {
    /// Prepares area `number`, from 1.
    pub fn new(
        (number, area): (usize, &AreaLook),
        sums: (&'a FloorSums, &Arc<FloorSums>),
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<FloorArea<'a>, LookError> {
        let (shape, bounds) = shape((number, area), walls)?;
        let look = Look { floor: area.floor.clone(), area: Vec::new(), ..look.clone() };
        Ok(FloorArea { shape, bounds, painter: FloorPainter::new(sums, walls, &look, simulated_people)? })
    }

    /// Paints those of the `wanted` texels of a window that lie in it.
    pub fn paint(&self, window: TexelWindow, wanted: Option<&[bool]>, block: &mut ResolvedBlock) {
        let texel_m = 1.0 / window.texels_per_metre;
        let corner = vec2(window.i0 as f64, window.j0 as f64) * texel_m;
        let size = vec2(window.width as f64, window.height as f64) * texel_m;
        if !self.bounds.overlaps(Rect { min: corner, max: corner + size }) {
            return;
        }
        let inside: Vec<bool> = (0..window.texels())
            .map(|n| {
                let (column, row) = ((n % window.width) as f64 + 0.5, (n / window.width) as f64 + 0.5);
                wanted.is_none_or(|wanted| wanted[n]) && self.contains(corner + vec2(column, row) * texel_m)
            })
            .collect();
        if inside.iter().all(|inside| !inside) {
            return;
        }
        PAINTED.with_borrow_mut(|painted| {
            painted.resize(window.texels(), &LAYERS);
            painted.fine.resize(block.fine.len(), FLAT_FINELY);
            self.painter.paint(window, Some(&inside), painted);
            let mut n = 0;
            while n < inside.len() {
                let len = inside[n..].iter().take_while(|&&next| next == inside[n]).count();
                if inside[n] {
                    block.copy(n, painted, n, len);
                }
                n += len;
            }
        });
    }

    fn contains(&self, p: Vec2) -> bool {
        match &self.shape {
            Shape::Outline(corners) => {
                let edges = corners.iter().zip(corners.iter().cycle().skip(1));
                let crossed = |(a, b): &(&Vec2, &Vec2)| {
                    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
                };
                edges.filter(crossed).count() % 2 == 1
            }
            Shape::Room { cell_m, columns, cells } => {
                let [i, j] = [p.x, p.y].map(|metres| (metres / cell_m).floor());
                if i < 0.0 || j < 0.0 || i >= *columns as f64 {
                    return false;
                }
                cells.get(j as usize * columns + i as usize).is_some_and(|&inside| inside)
            }
        }
    }
}

thread_local! {
    /// Texels of a part before they are copied.
    static PAINTED: RefCell<ResolvedBlock> = RefCell::default();
}

/// Where area `number` lies, and its bounds.
fn shape((number, area): (usize, &AreaLook), walls: &Walls) -> Result<(Shape, Rect), LookError> {
    Ok(match (area.room, &area.outline[..]) {
        (Some([x, y]), _) => room(walls, vec2(x, y)).ok_or(LookError::NotInRoom { number, place_m: [x, y] })?,
        (None, &[a, b]) => outline(&[a, [b[0], a[1]], b, [a[0], b[1]]]),
        (None, corners) => outline(corners),
    })
}

fn outline(corners: &[[f64; 2]]) -> (Shape, Rect) {
    let corners: Vec<Vec2> = corners.iter().map(|&[x, y]| vec2(x, y)).collect();
    let first = corners.first().copied().unwrap_or(Vec2::ZERO);
    let bounds = corners.iter().fold(Rect { min: first, max: first }, |bounds, p| Rect {
        min: vec2(bounds.min.x.min(p.x), bounds.min.y.min(p.y)),
        max: vec2(bounds.max.x.max(p.x), bounds.max.y.max(p.y)),
    });
    (Shape::Outline(corners), bounds)
}

/// The room around a place: the floor that is reached from there without passing a doorway, and the floor within half a
/// wall's thickness of it.
fn room(walls: &Walls, place: Vec2) -> Option<(Shape, Rect)> {
    let bounds = walls.bounds_m();
    let cell_m = (1.0 / CELLS_PER_M).max(bounds.max.x.max(bounds.max.y) / MOST_CELLS);
    let [columns, rows] = [bounds.max.x, bounds.max.y].map(|metres| (metres / cell_m).ceil().max(1.0) as usize);
    let mut share = vec![0.0; columns * rows];
    walls.cleared_coverage(1.0 / cell_m, [0, 0], [columns, rows], &mut share);
    for doorway in walls.doorways() {
        // A bar across the threshold, longer than the opening and thick enough that no diagonal passes.
        let [a, b] = doorway.jambs_m;
        let steps = (2.0 * a.distance(b) / cell_m).ceil() as usize + 4;
        for k in 0..=steps {
            let p = a + (b - a) * (k as f64 / steps as f64 * 1.2 - 0.1);
            for q in [p, p + doorway.through * (0.5 * cell_m)] {
                let [i, j] = [q.x, q.y].map(|metres| (metres / cell_m).floor());
                if i >= 0.0 && j >= 0.0 && i < columns as f64 && j < rows as f64 {
                    share[j as usize * columns + i as usize] = 0.0;
                }
            }
        }
    }
    let [i, j] = [place.x, place.y].map(|metres| (metres / cell_m).floor());
    let is_in = i >= 0.0 && j >= 0.0 && i < columns as f64 && j < rows as f64;
    let first = is_in.then(|| j as usize * columns + i as usize).filter(|&cell| share[cell] > 0.5)?;
    let mut cells = vec![false; share.len()];
    let mut next = vec![first];
    cells[first] = true;
    let (mut low, mut high) = ([i, j], [i, j]);
    while let Some(cell) = next.pop() {
        let (column, row) = (cell % columns, cell / columns);
        for (k, at) in [column, row].into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(at as f64), high[k].max(at as f64));
        }
        let beside = [
            (column > 0).then(|| cell - 1),
            (column + 1 < columns).then(|| cell + 1),
            (row > 0).then(|| cell - columns),
            (row + 1 < rows).then(|| cell + columns),
        ];
        for cell in beside.into_iter().flatten() {
            if share[cell] > 0.5 && !cells[cell] {
                cells[cell] = true;
                next.push(cell);
            }
        }
    }
    // Cells that a wall cuts, and the near half of thresholds.
    let reached = cells.clone();
    for (cell, inside) in cells.iter_mut().enumerate() {
        let (column, row) = (cell % columns, cell / columns);
        let near = |di: i64, dj: i64| {
            let (i, j) = (column as i64 + di, row as i64 + dj);
            (0..columns as i64).contains(&i)
                && (0..rows as i64).contains(&j)
                && reached[(j * columns as i64 + i) as usize]
        };
        *inside |= (-1..=1).any(|dj| (-1..=1).any(|di| near(di, dj)));
    }
    let corner = |[i, j]: [f64; 2], by: f64| vec2(i + by, j + by) * cell_m;
    Some((Shape::Room { cell_m, columns, cells }, Rect { min: corner(low, -1.0), max: corner(high, 2.0) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::{FloorResolver, Material};
    use crate::plan::FloorPlan;
    use crate::stamps::TexelGrid;

    /// Two rooms of 3 x 3 m with a door of 0.9 m between them, 0.1 m per character.
    fn rooms() -> Walls {
        let floor = (0..32u32).flat_map(|row| {
            (0..63u32).map(move |column| {
                let (x, y) = (column % 31, row);
                let inside = (1..31).contains(&y) && x >= 1 && column < 62;
                u8::from(inside || (12..21).contains(&y) && column == 31)
            })
        });
        let plan = FloorPlan::from_mask(63, 32, 0.1, floor.collect());
        Walls::trace(&plan, &Default::default())
    }

    fn colours(walls: &Walls, look: &Look) -> Vec<[u8; 3]> {
        let grid = TexelGrid::covering(6.3, 3.2, 50.0).unwrap();
        let sums = FloorSums::new(grid);
        FloorResolver::new(&sums, walls, look, 1).unwrap().resolve(0, 0, 315, 160).base_color
    }

    fn tiled(area: AreaLook) -> AreaLook {
        let mut area = area;
        area.floor.material = Material::Tile;
        area
    }

    #[test]
    fn a_room_ends_at_its_door_and_an_outline_where_it_is_drawn() {
        let walls = rooms();
        let vinyl = Look::default();
        let mut tile = vinyl.clone();
        tile.floor.material = Material::Tile;
        let room = AreaLook { room: Some([1.0, 1.0]), ..AreaLook::default() };
        let outline = AreaLook { outline: vec![[0.0, 0.0], [2.0, 3.2]], ..AreaLook::default() };
        let corners = AreaLook { outline: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 3.2], [0.0, 3.2]], ..AreaLook::default() };
        let [all_vinyl, all_tile] = [&vinyl, &tile].map(|look| colours(&walls, look));
        for (area, end_m) in [(room, 3.15), (outline, 2.0), (corners, 2.0)] {
            let with = colours(&walls, &Look { area: vec![tiled(area)], ..vinyl.clone() });
            for (n, colour) in with.iter().enumerate() {
                let x = (n % 315) as f64 / 50.0;
                // Within a wall's thickness either may be seen: no floor is there.
                if x < end_m - 0.1 {
                    assert_eq!(*colour, all_tile[n], "texel {n}, {x} m");
                } else if x > end_m + 0.1 {
                    assert_eq!(*colour, all_vinyl[n], "texel {n}, {x} m");
                }
            }
        }
    }

    #[test]
    fn an_area_needs_a_place() {
        let walls = rooms();
        let look = Look { area: vec![AreaLook::default()], ..Look::default() };
        let error = look.check().unwrap_err();
        assert_eq!(error.to_string(), "look.area 1 has an outline of 0 corners and no room");
        let nowhere = AreaLook { room: Some([3.15, 0.5]), ..AreaLook::default() };
        let look = Look { area: vec![nowhere], ..Look::default() };
        assert_eq!(
            look.check_areas(&walls).unwrap_err().to_string(),
            "look.area 1: there is no floor at (3.15, 0.5) m"
        );
    }
}
