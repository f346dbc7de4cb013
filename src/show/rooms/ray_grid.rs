//! The plan as rays see it: upright faces over a plane, found through a grid of cells.

use super::cells::by_cell;
use super::fittings::{Fitting, Fittings};
use crate::look::WIDEST_FRAMED_M;
use crate::math::srgb::{Srgb8, light_of};
use crate::math::{Rect, Vec2, vec2};
use crate::walls::{Doorway, Face, Walls};

/// Side of a cell, metres, where the plan is not so large that coarser ones must do.
const CELL_M: f64 = 0.5;
/// Most cells.
const MOST_CELLS: f64 = 4e6;
/// Rays step over cell borders by this much, metres.
const NUDGE_M: f64 = 1e-7;

/// Kind of an upright quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum QuadKind {
    /// A wall: place in [`Walls::faces`].
    Wall(u32),
    /// A gap where the floor meets the image's side.
    Opening,
    /// Above a door: place in the list of doorways.
    Lintel(u32),
    /// A side of a prism: place in the list of [`Fittings`], and which side.
    Fitting(u32, u8),
}

impl QuadKind {
    /// Whether it parts floor from what is no floor.
    fn bounds_floor(self) -> bool {
        matches!(self, QuadKind::Wall(_) | QuadKind::Opening)
    }
}

/// One upright rectangle, seen from its right side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallQuad {
    pub a: Vec2,
    /// Unit vector from start to end.
    pub along: Vec2,
    pub length: f64,
    pub what: QuadKind,
    /// Arc length of the start along the wall's face, metres.
    pub along_m: f64,
    /// Height of furniture, metres; infinite for all others.
    pub height_m: f64,
    /// Normals at both ends, as light sees them: shared with the next piece where a wall is round.
    pub round: [Vec2; 2],
}

impl WallQuad {
    fn new(a: Vec2, b: Vec2, what: QuadKind, along_m: f64) -> Option<WallQuad> {
        let along = (b - a).normalized()?;
        let round = [-along.left(); 2];
        Some(WallQuad { a, along, length: a.distance(b), what, along_m, height_m: f64::INFINITY, round })
    }

    /// True for walls up to the ceiling.
    pub fn is_wall(&self) -> bool {
        matches!(self.what, QuadKind::Wall(_)) && self.height_m.is_infinite()
    }

    /// True for walls and openings, up to the ceiling.
    pub fn bounds_room(&self) -> bool {
        self.what.bounds_floor() && self.height_m.is_infinite()
    }

    /// Unit vector that points to where the floor is: to the right.
    pub fn normal(&self) -> Vec2 {
        -self.along.left()
    }

    /// Unit vector to where the floor is, for light: turns evenly along a round wall.
    pub fn round_normal(&self, along_m: f64) -> Vec2 {
        let [from, to] = self.round;
        from.lerp(to, (along_m / self.length).clamp(0.0, 1.0)).normalized().unwrap_or(self.normal())
    }

    /// Whether a place lies on its line, but for rounding.
    pub fn is_on(&self, p: Vec2) -> bool {
        (p - self.a).cross(self.along).abs() < 1e-5
    }

    /// Distance of a place to it in the plan, metres.
    pub fn distance_m(&self, p: Vec2) -> f64 {
        let along = (p - self.a).dot(self.along).clamp(0.0, self.length);
        p.distance(self.a + self.along * along)
    }

    /// True if a place lies straight behind it, away from the floor.
    pub fn hides(&self, p: Vec2) -> bool {
        let way = p - self.a;
        way.dot(self.normal()) <= 0.0 && (0.0..=self.length).contains(&way.dot(self.along))
    }

    fn b(&self) -> Vec2 {
        self.a + self.along * self.length
    }
}

/// The crossing of a ray and a quad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Way from the ray's start to what it meets, metres.
    pub way_m: f64,
    /// Place in [`RayGrid::pieces`].
    pub piece: usize,
    /// From the piece's start, metres.
    pub along_m: f64,
}

/// A gap with a lintel over it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lintel {
    pub low_m: f64,
    centre: Vec2,
    through: Vec2,
    half: Vec2,
}

impl Lintel {
    fn new(door: &Doorway, height_m: f64) -> Lintel {
        Lintel {
            low_m: door.head_m.min(height_m),
            centre: (door.jambs_m[0] + door.jambs_m[1]) * 0.5,
            through: door.through,
            half: vec2(door.depth_m.max(0.02) * 0.5, door.width_m() * 0.5),
        }
    }

    /// Way to where a ray that is inside leaves the gap, metres.
    pub fn leaves(&self, from: Vec2, toward: Vec2) -> f64 {
        let (p, side) = (from - self.centre, self.through.left());
        let slab = |p: f64, d: f64, half: f64| {
            if d.abs() < 1e-9 { f64::INFINITY } else { (half.copysign(d) - p) / d }
        };
        let across = slab(p.dot(self.through), toward.dot(self.through), self.half.x);
        across.min(slab(p.dot(side), toward.dot(side), self.half.y)).max(0.0)
    }

    fn pieces(&self, number: u32) -> impl Iterator<Item = WallQuad> {
        let (way, side) = (self.through * self.half.x, self.through.left() * self.half.y);
        let ends = [
            [self.centre + way + side, self.centre + way - side],
            [self.centre - way - side, self.centre - way + side],
        ];
        // Their fronts look away from the gap: to the right of the way from the first end to the second.
        ends.into_iter().filter_map(move |[a, b]| WallQuad::new(b, a, QuadKind::Lintel(number), 0.0))
    }
}

/// The level top of a piece of furniture.
#[derive(Clone, Debug)]
struct FurnitureTop {
    bounds: Rect,
    outline: Vec<Vec2>,
    height_m: f64,
    /// Whether prisms stand for it, and its top is none.
    replaced: bool,
}

impl FurnitureTop {
    fn of((outline, &replaced): (&Face, &bool)) -> Option<FurnitureTop> {
        let first = outline.points_m.first()?;
        let around = |bounds: Rect, &p: &Vec2| Rect {
            min: vec2(bounds.min.x.min(p.x), bounds.min.y.min(p.y)),
            max: vec2(bounds.max.x.max(p.x), bounds.max.y.max(p.y)),
        };
        let bounds = outline.points_m.iter().fold(Rect { min: *first, max: *first }, around);
        Some(FurnitureTop { bounds, outline: outline.points_m.clone(), height_m: outline.furniture_m?, replaced })
    }

    fn contains(&self, p: Vec2) -> bool {
        let edges = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let crossed =
            edges.filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && (p.y - a.y) / (b.y - a.y) * (b.x - a.x) + a.x > p.x);
        self.bounds.contains(p) && !crossed.count().is_multiple_of(2)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CellGround {
    Solid,
    Floor,
}

/// All upright quads of a plan in a grid of cells.
#[derive(Debug)]
pub(crate) struct RayGrid {
    pub pieces: Vec<WallQuad>,
    pub lintels: Vec<Lintel>,
    /// Both ends of each opening.
    pub openings: Vec<[Vec2; 2]>,
    /// Height of walls and ceiling, metres; 0 without them.
    pub height_m: f64,
    /// Whether there is a ceiling.
    pub roofed: bool,
    /// Width, metres, and colour of the frames of doors; `None` without any.
    pub frame: Option<(f32, Srgb8)>,
    /// The block that the rooms are cut into.
    pub block: Rect,
    /// What stands in the rooms.
    pub fittings: Fittings,
    /// What darkens the floor of cell `c`: `shades[shade_starts[c]..shade_starts[c + 1]]`.
    shade_starts: Vec<u32>,
    shades: Vec<u32>,
    furniture: Vec<FurnitureTop>,
    /// Heights of the furniture, metres, each once.
    furniture_heights_m: Vec<f64>,
    origin: Vec2,
    cell_m: f64,
    cells_per_metre: f64,
    columns: usize,
    rows: usize,
    /// Pieces of cell `c` are `entries[starts[c]..starts[c + 1]]`.
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// The ground at each cell's middle.
    middles: Vec<CellGround>,
    /// Cells all around that hold no piece, in rings; 0 where there is one in the cell itself.
    empty_rings: Vec<u8>,
}

impl RayGrid {
    pub fn new(walls: &Walls, doorways: &[Doorway], height_m: f64) -> RayGrid {
        let lintels: Vec<Lintel> = doorways.iter().map(|door| Lintel::new(door, height_m)).collect();
        let fittings = Fittings::of(walls, doorways, height_m);
        let mut pieces = wall_pieces(walls, &fittings.replaced);
        pieces.extend(opening_pieces(walls));
        pieces.extend((0..).zip(&lintels).flat_map(|(n, lintel)| lintel.pieces(n)));
        pieces.extend((0..).zip(&fittings.all).flat_map(|(n, fitting)| fitting_pieces(n, fitting)));
        let bounds = walls.bounds_m();
        let area = bounds.grown(2.0 * CELL_M);
        let cell_m = CELL_M.max((area.width() * area.height() / MOST_CELLS).sqrt());
        let count = |metres: f64| (metres / cell_m) as usize + 1;
        let (columns, rows) = (count(area.width()), count(area.height()));
        let furniture: Vec<FurnitureTop> =
            walls.faces.iter().zip(&fittings.replaced).filter_map(FurnitureTop::of).collect();
        let mut furniture_heights_m: Vec<f64> =
            furniture.iter().filter(|top| !top.replaced).map(|top| top.height_m).collect();
        furniture_heights_m.sort_by(f64::total_cmp);
        furniture_heights_m.dedup();
        let mut space = RayGrid {
            openings: opening_pieces(walls).map(|piece| [piece.a, piece.b()]).collect(),
            pieces,
            lintels,
            height_m,
            roofed: height_m > 0.0,
            frame: None,
            block: block(walls),
            fittings,
            shade_starts: Vec::new(),
            shades: Vec::new(),
            furniture,
            furniture_heights_m,
            origin: area.min,
            cell_m,
            cells_per_metre: 1.0 / cell_m,
            columns,
            rows,
            starts: Vec::new(),
            entries: Vec::new(),
            middles: Vec::new(),
            empty_rings: Vec::new(),
        };
        space.sort_into_cells();
        space.sort_shades();
        space.middles = (0..columns * rows)
            .map(|cell| {
                let middle = space.middle(cell);
                if bounds.contains(middle) && walls.is_inside(middle) { CellGround::Floor } else { CellGround::Solid }
            })
            .collect();
        space.empty_rings = rings(&space.starts, columns, rows);
        space
    }

    /// Height of a door's frame, metres, and its linear colour; `None` without one.
    pub fn frame_of(&self, lintel: u32) -> Option<(f32, [f32; 3])> {
        let ((width_m, colour), lintel) = (self.frame?, self.lintels.get(lintel as usize)?);
        let framed = 2.0 * lintel.half.y <= WIDEST_FRAMED_M;
        framed.then(|| (lintel.low_m as f32 + width_m, light_of(colour)))
    }

    /// True for a floor under the sky, without rooms.
    pub fn is_open(&self) -> bool {
        self.height_m <= 0.0
    }

    /// True on the floor, false beyond the openings.
    pub fn is_floor(&self, p: Vec2) -> bool {
        let Some(cell) = self.cell_of(p) else { return false };
        let middle = self.middle(cell);
        let crossed = self.cell(cell).iter().filter(|&&n| {
            let piece = &self.pieces[n as usize];
            piece.what.bounds_floor() && crosses(middle, p, piece.a, piece.b())
        });
        (self.middles[cell] == CellGround::Floor) == crossed.count().is_multiple_of(2)
    }

    /// True on the floor and under furniture.
    pub fn is_room(&self, p: Vec2) -> bool {
        self.is_floor(p) || self.furniture.iter().any(|top| top.contains(p))
    }

    /// Way to the first top of furniture that a falling ray meets before `limit_m`: `at` and `height` tell the place and
    /// the height above the floor at a way, `slope` the metres upward per metre of way.
    pub(super) fn top_on_the_way(&self, [z, slope]: [f64; 2], at: impl Fn(f64) -> Vec2, limit_m: f64) -> Option<f64> {
        if slope >= 0.0 {
            return None;
        }
        // The highest comes first.
        self.furniture_heights_m.iter().rev().find_map(|&height_m| {
            let way = (height_m - z) / slope;
            if !(0.0..limit_m).contains(&way) {
                return None;
            }
            let p = at(way);
            let is_top = |top: &FurnitureTop| !top.replaced && top.height_m == height_m && top.contains(p);
            (!self.is_floor(p) && self.furniture.iter().any(is_top)).then_some(way)
        })
    }

    /// The first face that a ray meets from its front, at most `limit_m` away; `toward` is a unit vector. Faces for
    /// which `solid` says no at the way to them let it through.
    pub fn cast(
        &self,
        from: Vec2,
        toward: Vec2,
        limit_m: f64,
        solid: impl Fn(&WallQuad, f64) -> bool,
    ) -> Option<Crossing> {
        self.nearest(from, toward, limit_m, |piece, way| solid(piece, way).then_some(way))
    }

    /// The nearest of what a ray meets behind faces: `meets` tells the way to it by the way to the face, if there is any.
    pub fn nearest(
        &self,
        from: Vec2,
        toward: Vec2,
        limit_m: f64,
        meets: impl Fn(&WallQuad, f64) -> Option<f64>,
    ) -> Option<Crossing> {
        let inverse = vec2(1.0 / toward.x, 1.0 / toward.y);
        let mut way = self.enters(from, inverse)?;
        let mut first: Option<Crossing> = None;
        while way <= first.map_or(limit_m, |first| first.way_m) {
            let p = from + toward * (way + NUDGE_M);
            let [column, row] = [p.x - self.origin.x, p.y - self.origin.y].map(|m| m * self.cells_per_metre);
            if !(column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64) {
                return first;
            }
            // Within the grid both are positive: whole numbers by truncation, which is faster than rounding down.
            let cell = row as usize * self.columns + column as usize;
            let (column, row) = (column as usize as f64, row as usize as f64);
            let rings = f64::from(self.empty_rings[cell]);
            let wide = (rings - 1.0).max(0.0);
            let x = self.origin.x + (if toward.x > 0.0 { column + 1.0 + wide } else { column - wide }) * self.cell_m;
            let y = self.origin.y + (if toward.y > 0.0 { row + 1.0 + wide } else { row - wide }) * self.cell_m;
            // A ray that runs along a border, but for rounding, does not leave there.
            let leaves = |way_there: f64| if way_there > way + 0.5 * NUDGE_M { way_there } else { f64::INFINITY };
            let leave_x = if toward.x == 0.0 { f64::INFINITY } else { leaves((x - from.x) * inverse.x) };
            let leave_y = if toward.y == 0.0 { f64::INFINITY } else { leaves((y - from.y) * inverse.y) };
            let leave = leave_x.min(leave_y).max(way + NUDGE_M);
            if rings == 0.0 {
                self.first_in(cell, [from, toward], limit_m, &meets, &mut first);
                if first.is_some_and(|first| first.way_m <= leave + 2.0 * NUDGE_M) {
                    return first;
                }
            }
            way = leave;
        }
        first
    }

    fn first_in(
        &self,
        cell: usize,
        [from, toward]: [Vec2; 2],
        limit_m: f64,
        meets: &impl Fn(&WallQuad, f64) -> Option<f64>,
        first: &mut Option<Crossing>,
    ) {
        for &number in self.cell(cell) {
            let piece = &self.pieces[number as usize];
            let against = toward.x * piece.along.y - toward.y * piece.along.x;
            // The floor side's normal is (along.y, -along.x): seen from the front, the ray goes against it.
            if against >= 0.0 {
                continue;
            }
            let apart = piece.a - from;
            let way_m = (apart.x * piece.along.y - apart.y * piece.along.x) / against;
            if way_m < -NUDGE_M || way_m > limit_m || first.is_some_and(|first| first.way_m <= way_m) {
                continue;
            }
            let along_m = (from + toward * way_m - piece.a).dot(piece.along);
            if along_m < -NUDGE_M || along_m > piece.length + NUDGE_M {
                continue;
            }
            let met = meets(piece, way_m).filter(|way_m| *way_m <= limit_m);
            if let Some(way_m) = met.filter(|way_m| first.is_none_or(|first| *way_m < first.way_m)) {
                *first = Some(Crossing { way_m, piece: number as usize, along_m });
            }
        }
    }

    /// Way to the grid, metres; `None` if the ray misses it.
    fn enters(&self, from: Vec2, inverse: Vec2) -> Option<f64> {
        let size = vec2(self.columns as f64, self.rows as f64) * self.cell_m;
        let span = |from: f64, inverse: f64, low: f64, high: f64| {
            if inverse.is_infinite() {
                let inside = from >= low && from <= high;
                return if inside { (f64::NEG_INFINITY, f64::INFINITY) } else { (f64::INFINITY, f64::NEG_INFINITY) };
            }
            let (a, b) = ((low - from) * inverse, (high - from) * inverse);
            (a.min(b), a.max(b))
        };
        let (x0, x1) = span(from.x, inverse.x, self.origin.x, self.origin.x + size.x);
        let (y0, y1) = span(from.y, inverse.y, self.origin.y, self.origin.y + size.y);
        let (enter, leave) = (x0.max(y0).max(0.0), x1.min(y1));
        (enter <= leave).then_some(enter)
    }

    /// Middles of all cells that are floor.
    pub fn floor_places(&self) -> impl Iterator<Item = Vec2> {
        let floor = |&(_, ground): &(usize, &CellGround)| *ground == CellGround::Floor;
        self.middles.iter().enumerate().filter(floor).map(|(cell, _)| self.middle(cell))
    }

    /// Numbers of what darkens the floor around a place.
    pub fn shades_at(&self, p: Vec2) -> &[u32] {
        self.cell_of(p)
            .map_or(&[], |cell| &self.shades[self.shade_starts[cell] as usize..self.shade_starts[cell + 1] as usize])
    }

    fn cell(&self, cell: usize) -> &[u32] {
        &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    fn cell_of(&self, p: Vec2) -> Option<usize> {
        let at = (p - self.origin) / self.cell_m;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.columns as f64 && at.y < self.rows as f64;
        inside.then(|| at.y as usize * self.columns + at.x as usize)
    }

    fn middle(&self, cell: usize) -> Vec2 {
        // Not quite the middle: plans like to have their walls on round numbers.
        let [column, row] = [cell % self.columns, cell / self.columns].map(|k| k as f64);
        self.origin + vec2(column + 0.5137, row + 0.4871) * self.cell_m
    }

    fn sort_into_cells(&mut self) {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (number, piece) in (0..).zip(&self.pieces) {
            self.cells_along(piece.a, piece.b(), |cell| pairs.push((cell as u32, number)));
        }
        (self.starts, self.entries) = by_cell(pairs, self.columns * self.rows);
    }

    fn sort_shades(&mut self) {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (number, area) in (0..).zip(self.fittings.shaded()) {
            let limit = |at: f64, most: usize| ((at / self.cell_m).floor().max(0.0) as usize).min(most - 1);
            let [low, high] = [area.min - self.origin, area.max - self.origin];
            for row in limit(low.y, self.rows)..=limit(high.y, self.rows) {
                let columns = limit(low.x, self.columns)..=limit(high.x, self.columns);
                pairs.extend(columns.map(|column| ((row * self.columns + column) as u32, number)));
            }
        }
        (self.shade_starts, self.shades) = by_cell(pairs, self.columns * self.rows);
    }

    /// Every cell that comes within a hair of a segment.
    fn cells_along(&self, a: Vec2, b: Vec2, mut visit: impl FnMut(usize)) {
        const HAIR_M: f64 = 4.0 * NUDGE_M;
        let limit = |at: f64, most: usize| ((at / self.cell_m).floor().max(0.0) as usize).min(most - 1);
        let row_of = |y: f64| limit(y - self.origin.y, self.rows);
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        for row in row_of(low.y - HAIR_M)..=row_of(high.y + HAIR_M) {
            let x_at = |y: f64| low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y)).clamp(0.0, 1.0);
            let bottom = self.origin.y + row as f64 * self.cell_m;
            let (x0, x1) = if high.y - low.y < 1e-9 {
                (low.x, high.x)
            } else {
                (x_at(bottom - HAIR_M), x_at(bottom + self.cell_m + HAIR_M))
            };
            let column_of = |x: f64| limit(x - self.origin.x, self.columns);
            for column in column_of(x0.min(x1) - HAIR_M)..=column_of(x0.max(x1) + HAIR_M) {
                visit(row * self.columns + column);
            }
        }
    }
}

/// The sides of a prism, seen from outside.
fn fitting_pieces(number: u32, fitting: &Fitting) -> impl Iterator<Item = WallQuad> + '_ {
    let edges = fitting.footprint.iter().zip(fitting.footprint.iter().cycle().skip(1));
    (0..).zip(edges).filter_map(move |(side, (&a, &b))| {
        let piece = WallQuad::new(a, b, QuadKind::Fitting(number, side), 0.0)?;
        Some(WallQuad { height_m: fitting.span_m[1], ..piece })
    })
}

fn wall_pieces(walls: &Walls, replaced: &[bool]) -> Vec<WallQuad> {
    let mut pieces = Vec::new();
    for ((number, face), &replaced) in (0..).zip(&walls.faces).zip(replaced) {
        let count = face.points_m.len();
        let first = pieces.len();
        let mut along_m = 0.0;
        for k in 0..if face.closed { count } else { count.saturating_sub(1) } {
            let (a, b) = (face.points_m[k], face.points_m[(k + 1) % count]);
            let piece = WallQuad::new(a, b, QuadKind::Wall(number), along_m);
            // Rays pass where prisms stand for it.
            let height_m = if replaced { 0.0 } else { face.furniture_m.unwrap_or(f64::INFINITY) };
            pieces.extend(piece.map(|piece| WallQuad { height_m, ..piece }));
            along_m += a.distance(b);
        }
        smooth(&mut pieces[first..], face.closed);
    }
    pieces
}

/// Gives neighbouring pieces of a round wall the same normal where they meet.
fn smooth(pieces: &mut [WallQuad], closed: bool) {
    /// Cosine of the largest turn within a round wall, and its longest piece, metres.
    const ROUND_COSINE: f64 = 0.8;
    const LONGEST_M: f64 = 1.2;
    let count = pieces.len();
    for k in 0..if closed { count } else { count.saturating_sub(1) } {
        let next = (k + 1) % count;
        let [a, b] = [pieces[k], pieces[next]];
        let is_round = a.normal().dot(b.normal()) > ROUND_COSINE && a.length.max(b.length) < LONGEST_M;
        if let Some(normal) = (a.normal() + b.normal()).normalized().filter(|_| is_round && next != k) {
            pieces[k].round[1] = normal;
            pieces[next].round[0] = normal;
        }
    }
}

fn opening_pieces(walls: &Walls) -> impl Iterator<Item = WallQuad> {
    let edges = walls.outlines().iter().flat_map(|outline| outline.openings.iter().map(|&(k, _)| outline.edge(k)));
    edges.filter_map(|[a, b]| WallQuad::new(a, b, QuadKind::Opening, 0.0))
}

/// The floor's bounds with a rim, but none on sides that are open.
fn block(walls: &Walls) -> Rect {
    use crate::plan::Side;
    const RIM_M: f64 = 0.3;
    let open = |side: Side| {
        let mut sides = walls.outlines().iter().flat_map(|outline| outline.openings.iter().map(|&(_, side)| side));
        if sides.any(|other| other == side) { 0.0 } else { RIM_M }
    };
    let bounds = walls.bounds_m();
    Rect {
        min: bounds.min - vec2(open(Side::West), open(Side::South)),
        max: bounds.max + vec2(open(Side::East), open(Side::North)),
    }
}

/// Chessboard distance to the nearest cell with a piece, at most 255.
fn rings(starts: &[u32], columns: usize, rows: usize) -> Vec<u8> {
    let mut rings: Vec<u8> = starts.windows(2).map(|pair| if pair[1] > pair[0] { 0 } else { 255 }).collect();
    let near = |rings: &[u8], x: i64, y: i64| {
        let inside = x >= 0 && y >= 0 && x < columns as i64 && y < rows as i64;
        // Rays end at the grid's border, so cells beyond it do not matter.
        if inside { rings[y as usize * columns + x as usize].saturating_add(1) } else { 1 }
    };
    let mut pass = |cell: usize, neighbours: [[i64; 2]; 4]| {
        let (x, y) = ((cell % columns) as i64, (cell / columns) as i64);
        let least = neighbours.iter().map(|[dx, dy]| near(&rings, x + dx, y + dy)).min();
        rings[cell] = rings[cell].min(least.unwrap_or(255));
    };
    (0..columns * rows).for_each(|cell| pass(cell, [[-1, 0], [-1, -1], [0, -1], [1, -1]]));
    (0..columns * rows).rev().for_each(|cell| pass(cell, [[1, 0], [1, 1], [0, 1], [-1, 1]]));
    rings
}

fn crosses(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    let (ab, cd) = (b - a, d - c);
    (ab.cross(c - a) > 0.0) != (ab.cross(d - a) > 0.0) && (cd.cross(a - c) > 0.0) != (cd.cross(b - c) > 0.0)
}
