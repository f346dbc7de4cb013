//! Parts of the floor with a material of their own.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use image::{GrayImage, ImageBuffer, Luma};
use imageproc::region_labelling::{Connectivity, connected_components};

use super::block::{FLAT_FINELY, LAYERS, ResolvedBlock};
use super::error::LookError;
use super::lattice::TexelWindow;
use super::paint::FloorPainter;
use super::settings::{AreaLook, FloorLook, Look};
use crate::math::srgb::Srgb8;
use crate::math::{Rect, Vec2, vec2};
use crate::sums::FloorSums;
use crate::walls::Walls;

/// Cells in which a room is found, per metre, and how many at most along a side of the plan.
const CELLS_PER_M: f64 = 20.0;
const MOST_CELLS: f64 = 4096.0;
/// How much larger than a room its floor may be: where more is reached without a doorway, nobody can tell where it ends.
const MOST_LARGER: f64 = 1.25;
/// Width of the metal strip in a doorway in which two floors meet, metres, and its colour.
const STRIP_M: f64 = 0.04;
const STRIP_COLOUR: Srgb8 = [146, 143, 137];

/// A room, and what floor lies there.
pub(crate) struct RoomFloor {
    /// A place in it, metres.
    pub inside_m: Vec2,
    /// With furniture.
    pub area_m2: f64,
    pub floor: FloorLook,
}

impl Look {
    /// Checks, before any long computation, that the rooms of its areas are on the floor.
    ///
    /// # Errors
    /// [`LookError::NotInRoom`].
    pub(crate) fn check_areas(&self, walls: &Walls) -> Result<(), LookError> {
        shapes(self, walls).map(drop)
    }

    /// The floors at places, metres in the plan frame: of areas that overlap, the last one's.
    ///
    /// # Errors
    /// [`LookError::NotInRoom`] for an area of this look whose room is not on the floor.
    pub fn floors_at(&self, places_m: &[Vec2], walls: &Walls) -> Result<Vec<&FloorLook>, LookError> {
        let shapes = shapes(self, walls)?;
        let at = |&place: &Vec2| {
            let last = shapes.iter().zip(&self.area).rfind(|(shape, _)| shape.contains(place));
            last.map_or(&self.floor, |(_, area)| &area.floor)
        };
        Ok(places_m.iter().map(at).collect())
    }

    /// Lays the floors of rooms. What covers most becomes the look's floor, others become areas below those that the look has,
    /// with strips of metal where two meet in a doorway. Rooms that no door parts from the next keep the look's floor.
    pub(crate) fn lay_floors(&mut self, rooms: &[RoomFloor], walls: &Walls) {
        let mut covered: Vec<(&FloorLook, f64)> = Vec::new();
        for RoomFloor { area_m2, floor, .. } in rooms {
            match covered.iter_mut().find(|(known, _)| *known == floor) {
                Some((_, sum)) => *sum += area_m2,
                None => covered.push((floor, *area_m2)),
            }
        }
        // Of equals, the first.
        let Some((most, _)) = covered.iter().copied().rev().max_by(|(_, a), (_, b)| a.total_cmp(b)) else { return };
        self.floor = most.clone();
        if covered.len() == 1 {
            return;
        }
        let strip = FloorLook { colour: Some(STRIP_COLOUR), texture: 0.0, ..FloorLook::default() };
        let raster = RoomRaster::of(walls);
        let own = std::mem::take(&mut self.area);
        let mut laid = BTreeMap::new();
        for (floor, _) in covered.into_iter().filter(|(floor, _)| *floor != most) {
            for RoomFloor { inside_m, area_m2, .. } in rooms.iter().filter(|room| room.floor == *floor) {
                let closed = raster.at(*inside_m).filter(|&room| raster.area_m2(room) <= MOST_LARGER * area_m2);
                let Some(room) = closed else { continue };
                laid.insert(room, floor);
                let place = Some([inside_m.x, inside_m.y]);
                self.area.push(AreaLook { room: place, floor: floor.clone(), ..AreaLook::default() });
            }
        }
        let strips = walls.doorways().into_iter().filter(|doorway| {
            let middle = doorway.jambs_m[0].lerp(doorway.jambs_m[1], 0.5);
            let beyond = doorway.through * (0.5 * doorway.depth_m + 0.2);
            let [a, b] = [middle - beyond, middle + beyond].map(|p| raster.at(p));
            a.zip(b).is_some_and(|(a, b)| laid.get(&a) != laid.get(&b))
        });
        self.area.extend(strips.map(|doorway| {
            let ([a, b], half) = (doorway.jambs_m, doorway.through * (0.5 * STRIP_M));
            let outline = [a - half, b - half, b + half, a + half].map(|p| [p.x, p.y]).to_vec();
            AreaLook { outline, floor: strip.clone(), ..AreaLook::default() }
        }));
        self.area.extend(own);
    }
}

/// Parts of the floor of one material, and its painter.
pub(super) struct FloorArea<'a> {
    shapes: Vec<Shape>,
    painter: FloorPainter<'a>,
}

/// Where a part of the floor lies.
struct Shape {
    bounds: Rect,
    form: Form,
}

enum Form {
    /// Corners in a row.
    Outline(Vec<Vec2>),
    /// Cells of a raster that belong to a room, row by row.
    Room { cell_m: f64, first: [usize; 2], columns: usize, cells: Vec<bool> },
}

impl<'a> FloorArea<'a> {
    /// Prepares the areas of a look, in their order. Those of the same floor that follow each other have one painter.
    pub fn all(
        sums: (&'a FloorSums, &Arc<FloorSums>),
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<Vec<FloorArea<'a>>, LookError> {
        let mut shapes = shapes(look, walls)?.into_iter();
        let of_floor = |areas: &[AreaLook]| {
            let own = Look { floor: areas[0].floor.clone(), area: Vec::new(), ..look.clone() };
            let shapes = shapes.by_ref().take(areas.len()).collect();
            Ok(FloorArea { shapes, painter: FloorPainter::new(sums, walls, &own, simulated_people)? })
        };
        look.area.chunk_by(|a, b| a.floor == b.floor).map(of_floor).collect()
    }

    /// Paints those of the `wanted` texels of a window that lie in it.
    pub fn paint(&self, window: TexelWindow, wanted: Option<&[bool]>, block: &mut ResolvedBlock) {
        let texel_m = 1.0 / window.texels_per_metre;
        let corner = vec2(window.i0 as f64, window.j0 as f64) * texel_m;
        let size = vec2(window.width as f64, window.height as f64) * texel_m;
        let seen = Rect { min: corner, max: corner + size };
        let shapes: Vec<&Shape> = self.shapes.iter().filter(|shape| shape.bounds.overlaps(seen)).collect();
        if shapes.is_empty() {
            return;
        }
        let inside: Vec<bool> = (0..window.texels())
            .map(|n| {
                let (column, row) = ((n % window.width) as f64 + 0.5, (n / window.width) as f64 + 0.5);
                let place = corner + vec2(column, row) * texel_m;
                wanted.is_none_or(|wanted| wanted[n]) && shapes.iter().any(|shape| shape.contains(place))
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
}

thread_local! {
    /// Texels of a part before they are copied.
    static PAINTED: RefCell<ResolvedBlock> = RefCell::default();
}

/// Where the areas of a look lie.
fn shapes(look: &Look, walls: &Walls) -> Result<Vec<Shape>, LookError> {
    let raster = OnceCell::new();
    let shape = |(number, area): (usize, &AreaLook)| {
        Ok(match (area.room, &area.outline[..]) {
            (Some(place_m), _) => {
                let raster = raster.get_or_init(|| RoomRaster::of(walls));
                let room = raster.at(Vec2::from(place_m)).ok_or(LookError::NotInRoom { number, place_m })?;
                raster.shape(room)
            }
            (None, &[a, b]) => Shape::of_outline(&[a, [b[0], a[1]], b, [a[0], b[1]]]),
            (None, corners) => Shape::of_outline(corners),
        })
    };
    (1..).zip(&look.area).map(shape).collect()
}

impl Shape {
    fn of_outline(corners: &[[f64; 2]]) -> Shape {
        let corners: Vec<Vec2> = corners.iter().map(|&[x, y]| vec2(x, y)).collect();
        let first = corners.first().copied().unwrap_or(Vec2::ZERO);
        let bounds = corners.iter().fold(Rect { min: first, max: first }, |bounds, p| Rect {
            min: vec2(bounds.min.x.min(p.x), bounds.min.y.min(p.y)),
            max: vec2(bounds.max.x.max(p.x), bounds.max.y.max(p.y)),
        });
        Shape { bounds, form: Form::Outline(corners) }
    }

    fn contains(&self, p: Vec2) -> bool {
        match &self.form {
            Form::Outline(corners) => {
                let edges = corners.iter().zip(corners.iter().cycle().skip(1));
                let crossed = |(a, b): &(&Vec2, &Vec2)| {
                    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
                };
                edges.filter(crossed).count() % 2 == 1
            }
            Form::Room { cell_m, first, columns, cells } => {
                let i = (p.x / cell_m).floor() - first[0] as f64;
                let j = (p.y / cell_m).floor() - first[1] as f64;
                if i < 0.0 || j < 0.0 || i >= *columns as f64 {
                    return false;
                }
                cells.get(j as usize * columns + i as usize).is_some_and(|&inside| inside)
            }
        }
    }
}

/// The floor in cells, in rooms that the thresholds of doors divide.
struct RoomRaster {
    cell_m: f64,
    /// Number of the room of each cell; 0: none.
    room: ImageBuffer<Luma<u32>, Vec<u32>>,
    /// By number: columns and rows from the first up to, without, the last; cells.
    found: Vec<([Range<u32>; 2], usize)>,
}

impl RoomRaster {
    fn of(walls: &Walls) -> RoomRaster {
        let bounds = walls.bounds_m();
        let cell_m = (1.0 / CELLS_PER_M).max(bounds.max.x.max(bounds.max.y) / MOST_CELLS);
        let [columns, rows] = [bounds.max.x, bounds.max.y].map(|metres| (metres / cell_m).ceil().max(1.0) as u32);
        let mut share = vec![0.0; columns as usize * rows as usize];
        walls.cleared_coverage(1.0 / cell_m, [0, 0], [columns as usize, rows as usize], &mut share);
        let mut floor =
            GrayImage::from_fn(columns, rows, |i, j| Luma([u8::from(share[(j * columns + i) as usize] > 0.5)]));
        for doorway in walls.doorways() {
            // A bar across the threshold, longer than the opening and thick enough that no diagonal passes.
            let [a, b] = doorway.jambs_m;
            let steps = (2.0 * a.distance(b) / cell_m).ceil() as usize + 4;
            for k in 0..=steps {
                let p = a + (b - a) * (k as f64 / steps as f64 * 1.2 - 0.1);
                for q in [p, p + doorway.through * (0.5 * cell_m)] {
                    if let Some(cell) = cell_at(q, cell_m).and_then(|[i, j]| floor.get_pixel_mut_checked(i, j)) {
                        cell.0 = [0];
                    }
                }
            }
        }
        let room = connected_components(&floor, Connectivity::Four, Luma([0]));
        let mut found = Vec::new();
        for (i, j, Luma([number])) in room.enumerate_pixels() {
            let number = *number as usize;
            if found.len() <= number {
                found.resize(number + 1, ([i..i + 1, j..j + 1], 0));
            }
            let (bounds, count) = &mut found[number];
            for (range, at) in bounds.iter_mut().zip([i, j]) {
                *range = range.start.min(at)..range.end.max(at + 1);
            }
            *count += 1;
        }
        RoomRaster { cell_m, room, found }
    }

    /// Number of the room around a place: the floor that is reached from there without passing a doorway.
    fn at(&self, place: Vec2) -> Option<u32> {
        let [i, j] = cell_at(place, self.cell_m)?;
        self.room.get_pixel_checked(i, j).map(|number| number.0[0]).filter(|&number| number != 0)
    }

    fn area_m2(&self, number: u32) -> f64 {
        self.found[number as usize].1 as f64 * self.cell_m * self.cell_m
    }

    /// A room, and the floor within half a wall's thickness of it.
    fn shape(&self, number: u32) -> Shape {
        let cell_m = self.cell_m;
        // With cells that a wall cuts, and the near half of thresholds.
        let around = |range: &Range<u32>, count: u32| range.start.saturating_sub(1)..(range.end + 1).min(count);
        let (columns, rows) = self.room.dimensions();
        let [across, down] = &self.found[number as usize].0;
        let is_near = |i: u32, j: u32| {
            let mut beside = around(&(j..j + 1), rows).flat_map(|j| around(&(i..i + 1), columns).map(move |i| (i, j)));
            beside.any(|(i, j)| self.room.get_pixel(i, j).0 == [number])
        };
        let corner = |i: u32, j: u32, by: f64| vec2(f64::from(i) + by, f64::from(j) + by) * cell_m;
        let bounds = Rect { min: corner(across.start, down.start, -1.0), max: corner(across.end, down.end, 1.0) };
        let (across, down) = (around(across, columns), around(down, rows));
        let form = Form::Room {
            cell_m,
            first: [across.start as usize, down.start as usize],
            columns: across.len(),
            cells: down.flat_map(|j| across.clone().map(move |i| (i, j))).map(|(i, j)| is_near(i, j)).collect(),
        };
        Shape { bounds, form }
    }
}

/// Column and row of the cell at a place.
fn cell_at(place: Vec2, cell_m: f64) -> Option<[u32; 2]> {
    let [i, j] = [place.x, place.y].map(|metres| (metres / cell_m).floor());
    (i >= 0.0 && j >= 0.0).then_some([i as u32, j as u32])
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
    fn rooms_have_floors_with_a_strip_between_and_one_without_a_door_that_of_most() {
        let walls = rooms();
        let room = |x: f64, area_m2: f64, material: Material| RoomFloor {
            inside_m: vec2(x, 1.0),
            area_m2,
            floor: FloorLook { material, ..FloorLook::default() },
        };
        let laid = |left_m2: f64| {
            let mut look = Look::default();
            look.lay_floors(&[room(1.0, left_m2, Material::Tile), room(5.0, 9.3, Material::Wood)], &walls);
            let places = [1.0, 3.145, 3.155, 5.0].map(|x| vec2(x, 1.5));
            let at: Vec<FloorLook> = look.floors_at(&places, &walls).unwrap().into_iter().cloned().collect();
            let materials = at.iter().map(|floor| floor.material).collect::<Vec<_>>();
            (materials, at.iter().map(|floor| floor.colour == Some(STRIP_COLOUR)).collect::<Vec<_>>())
        };
        // The middle of the doorway is at 3.15 m.
        let (materials, is_strip) = laid(9.0);
        assert_eq!([materials[0], materials[3]], [Material::Tile, Material::Wood]);
        assert_eq!(is_strip, [false, true, true, false]);
        // Half of the left room: what parts it from the other half is no door.
        assert_eq!(laid(4.5), (vec![Material::Wood; 4], vec![false; 4]));
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
