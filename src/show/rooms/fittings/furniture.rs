//! Furniture as boards on legs and upholstered blocks, by height and size.

use super::finish::{Finish, SEATS_M};
use super::prism::Fitting;
use super::shape::{Block, area_m2, bounds, hull, shrunk, smallest_block};
use crate::math::Vec2;
use crate::walls::{COUNTER_M, Face, TABLES_M, Walls};

/// Least share of its hull that furniture with a top of its own fills: others stay as they are drawn.
const CONVEX: f64 = 0.92;
/// Least share of its smallest rectangle that a rectangular piece fills.
const SQUARE: f64 = 0.93;
/// Length beyond which what is as low and broad as a bed is a platform, as shops and museums have them, metres.
const LONGEST_BED_M: f64 = 2.4;
/// Shares of a gate's half length between which each of its card readers lies.
const READER: [f64; 2] = [0.66, 0.86];

/// A piece of furniture: its outline, its rectangle if it has the form of one, and its height.
struct Piece {
    outline: Vec<Vec2>,
    block: Block,
    is_square: bool,
    top_m: f64,
}

/// Adds all furniture; `blocks` gets outline and height of what stays as it is drawn.
pub(super) fn add(
    walls: &Walls,
    height_m: f64,
    (all, replaced): (&mut Vec<Fitting>, &mut [bool]),
    blocks: &mut Vec<(Vec<Vec2>, f64)>,
) {
    let faces = || walls.faces.iter().enumerate().filter(|(_, face)| face.closed && face.furniture_m.is_some());
    let tables: Vec<Vec2> = faces()
        .filter(|(_, face)| face.furniture_m.is_some_and(|m| (SEATS_M..TABLES_M).contains(&m)))
        .map(|(_, face)| bounds(&face.points_m).centre())
        .collect();
    for (number, face) in faces() {
        let Some(piece) = Piece::of(face, height_m) else {
            blocks.push((hull(&face.points_m), face.furniture_m.unwrap_or(height_m)));
            continue;
        };
        let parts = match piece.top_m {
            top if top < SEATS_M => piece.seat(walls, &tables),
            top if top < TABLES_M => piece.table(),
            top if top < COUNTER_M => piece.fixture(),
            _ => {
                // Sides keep their texture: hands and bags have been there.
                blocks.push((piece.outline.clone(), piece.top_m));
                all.extend(if face.is_gate() { piece.gate_top() } else { vec![piece.board(Finish::Counter)] });
                continue;
            }
        };
        replaced[number] = true;
        all.extend(parts);
    }
}

impl Piece {
    fn of(face: &Face, height_m: f64) -> Option<Piece> {
        let top_m = face.furniture_m.filter(|top_m| *top_m < height_m)?;
        let (outline, area) = (hull(&face.points_m), area_m2(&face.points_m));
        let hull_area = area_m2(&outline);
        let block = smallest_block(&outline)?;
        let is_square = area > SQUARE * 4.0 * block.half[0] * block.half[1];
        (area > CONVEX * hull_area && outline.len() >= 3).then_some(Piece { outline, block, is_square, top_m })
    }

    fn prism(&self, share: f64, span_m: [f64; 2], finish: Finish) -> Fitting {
        let outline = if self.is_square { self.block.corners() } else { self.outline.clone() };
        Fitting { footprint: shrunk(&outline, self.block.centre, share), span_m, finish, leaf: None }
    }

    /// A board on four legs with rails between them, or on a pillar.
    fn table(&self) -> Vec<Fitting> {
        let under_m = self.top_m - 0.028;
        let mut parts = vec![self.prism(1.0, [under_m, self.top_m], Finish::Wood)];
        let [long, broad] = self.block.half;
        if !self.is_square {
            parts.push(self.prism((0.05 / broad).min(0.4), [0.02, under_m], Finish::Steel));
            parts.push(self.prism((0.26 / broad).min(0.6), [0.0, 0.02], Finish::Steel));
            return parts;
        }
        parts.extend(self.block.legs(0.04, 0.045, under_m, Finish::Steel));
        let (x, y) = (1.0 - 0.085 / long, 1.0 - 0.05 / broad);
        let thin = 0.02 / broad;
        for y in [-y, y - thin] {
            parts.push(self.block.part([-x, x], [y, y + thin], [under_m - 0.045, under_m], Finish::Steel));
        }
        parts
    }

    /// A chair, a bench, a sofa, a bed or a platform, by its size.
    fn seat(&self, walls: &Walls, tables: &[Vec2]) -> Vec<Fitting> {
        let [long, broad] = self.block.half.map(|half| 2.0 * half);
        let top_m = self.top_m;
        if !self.is_square && long < 0.8 {
            let stool = [
                self.prism(1.0, [top_m - 0.05, top_m], Finish::Seat),
                self.prism(0.2, [0.0, top_m - 0.05], Finish::Steel),
            ];
            return stool.to_vec();
        }
        if long <= 0.8 {
            return self.chair(tables);
        }
        if broad >= 0.75 && long >= 1.7 {
            let platform =
                || vec![self.prism(0.96, [0.0, 0.08], Finish::Steel), self.prism(1.0, [0.08, top_m], Finish::Wood)];
            return if long > LONGEST_BED_M { platform() } else { self.bed(walls) };
        }
        if broad < 0.6 {
            let mut parts = vec![self.prism(1.0, [top_m - 0.05, top_m], Finish::Wood)];
            parts.extend(self.block.legs(0.08, 0.06, top_m - 0.05, Finish::Steel));
            return parts;
        }
        let back = self.wall_side(walls, [[0.0, -1.0], [0.0, 1.0]])[1];
        let thick = 0.18 / self.block.half[1];
        let ([back_from, back_to], front) = if back > 0.0 {
            ([1.0 - thick, 1.0], [-1.0, 1.0 - thick])
        } else {
            ([-1.0, thick - 1.0], [thick - 1.0, 1.0])
        };
        let arm = 0.16 / self.block.half[0];
        let mut parts = vec![
            self.block.part([-1.0, 1.0], [-1.0, 1.0], [0.06, 0.26], Finish::Upholstery),
            self.block.part([-1.0, 1.0], [back_from, back_to], [0.26, 0.82], Finish::Upholstery),
            self.block.part([-1.0, arm - 1.0], front, [0.26, 0.6], Finish::Upholstery),
            self.block.part([1.0 - arm, 1.0], front, [0.26, 0.6], Finish::Upholstery),
        ];
        // Two cushions, with a gap between them.
        for [from, to] in [[arm - 1.0, -0.006], [0.006, 1.0 - arm]] {
            parts.push(self.block.part([from, to], front, [0.262, top_m], Finish::Upholstery));
        }
        parts.extend(self.block.legs(0.04, 0.05, 0.06, Finish::Steel));
        parts
    }

    fn chair(&self, tables: &[Vec2]) -> Vec<Fitting> {
        let (block, top_m) = (self.block, self.top_m);
        let table = tables.iter().min_by(|a, b| a.distance(block.centre).total_cmp(&b.distance(block.centre)));
        let away = table.map_or(block.along, |table| block.centre - *table);
        let sides = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        let toward = |[x, y]: [f64; 2]| (block.along * x + block.along.left() * y).dot(away);
        let [x, y] = sides.into_iter().max_by(|a, b| toward(*a).total_cmp(&toward(*b))).unwrap_or([1.0, 0.0]);
        // The back is a board at that side, on two posts.
        let strip = |sign: f64, half: f64, thick_m: f64| {
            let thick = thick_m / half;
            if sign > 0.0 {
                [1.0 - thick, 1.0]
            } else if sign < 0.0 {
                [-1.0, thick - 1.0]
            } else {
                [-0.92, 0.92]
            }
        };
        let [long, broad] = block.half;
        let mut parts = vec![
            self.prism(1.0, [top_m - 0.055, top_m], Finish::Seat),
            block.part(strip(x, long, 0.035), strip(y, broad, 0.035), [top_m + 0.14, top_m + 0.42], Finish::Seat),
        ];
        for aside in [-0.5, 0.5] {
            let post = |sign: f64, half: f64| {
                if sign == 0.0 { [aside - 0.015 / half, aside + 0.015 / half] } else { strip(sign, half, 0.02) }
            };
            parts.push(block.part(post(x, long), post(y, broad), [top_m, top_m + 0.16], Finish::Steel));
        }
        parts.extend(block.legs(0.025, 0.025, top_m - 0.055, Finish::Steel));
        parts
    }

    fn bed(&self, walls: &Walls) -> Vec<Fitting> {
        let head = self.wall_side(walls, [[-1.0, 0.0], [1.0, 0.0]])[0];
        let along = |from: f64, to: f64| if head > 0.0 { [-to, -from] } else { [from, to] };
        let block = &self.block;
        let [thick, pillow] = [0.05 / block.half[0], 0.42 / block.half[0]];
        let mut parts = vec![
            block.part([-1.0, 1.0], [-1.0, 1.0], [0.05, 0.28], Finish::Wood),
            block.part(along(-1.0, thick - 1.0), [-1.0, 1.0], [0.28, 0.95], Finish::Wood),
            block.part(along(thick - 1.0, 0.99), [-0.97, 0.97], [0.28, self.top_m], Finish::Linen),
            block.part(along(pillow - 0.75, 1.0), [-1.0, 1.0], [0.3, self.top_m + 0.05], Finish::Upholstery),
        ];
        let count = if block.half[1] > 0.6 { 2 } else { 1 };
        for k in 0..count {
            let from = -0.9 + 1.8 * f64::from(k) / f64::from(count) + 0.04;
            let side = [from, from + 1.8 / f64::from(count) - 0.08];
            parts.push(block.part(
                along(thick - 0.97, thick - 1.0 + pillow),
                side,
                [self.top_m, self.top_m + 0.1],
                Finish::Linen,
            ));
        }
        parts
    }

    /// A basin on its foot, or a white cupboard.
    fn fixture(&self) -> Vec<Fitting> {
        if self.is_square {
            let top_m = self.top_m;
            return vec![
                self.prism(0.94, [0.0, 0.08], Finish::Steel),
                self.prism(0.99, [0.08, top_m - 0.03], Finish::Ceramic),
                self.prism(1.0, [top_m - 0.03, top_m], Finish::Counter),
            ];
        }
        vec![
            self.prism(0.45, [0.0, self.top_m - 0.16], Finish::Ceramic),
            self.prism(1.0, [self.top_m - 0.16, self.top_m], Finish::Ceramic),
        ]
    }

    /// A metal board with a card reader for either direction.
    fn gate_top(&self) -> Vec<Fitting> {
        let [from, to] = READER;
        let [low_m, high_m] = [self.top_m + 0.028, self.top_m + 0.055];
        let reader = |along, across| self.block.part(along, across, [low_m, high_m], Finish::Steel);
        vec![self.board(Finish::Metal), reader([from, to], [-0.8, -0.1]), reader([-to, -from], [0.1, 0.8])]
    }

    fn board(&self, finish: Finish) -> Fitting {
        let grown = 1.0 + 0.012 / self.block.half[1];
        self.prism(grown, [self.top_m - 0.012, self.top_m + 0.028], finish)
    }

    /// The one of these sides, as shares of its half sizes, that is nearest to a wall.
    fn wall_side(&self, walls: &Walls, sides: [[f64; 2]; 2]) -> [f64; 2] {
        let off_m = |[x, y]: [f64; 2]| {
            let outward = self.block.along * x + self.block.along.left() * y;
            let from = self.block.at(x, y);
            let steps = (1..=20).map(|k| f64::from(k) * 0.1);
            steps.take_while(|m| walls.is_inside(from + outward * *m)).last().unwrap_or(0.0)
        };
        if off_m(sides[1]) < off_m(sides[0]) { sides[1] } else { sides[0] }
    }
}
