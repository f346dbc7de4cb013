//! Buildings, known exactly: metres, origin at the upper left of the outer walls' centre lines, y down.

use super::canvas::{Point, Polygon, rectangle};

/// A hole in a wall.
#[derive(Clone, Copy, Debug)]
pub struct Hole {
    /// Distance from the wall's first end, metres.
    pub at: f64,
    pub width: f64,
    pub kind: HoleKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HoleKind {
    Window,
    /// The hinge is at the first end or not; the leaf swings to the left of the wall's direction or not.
    Door {
        hinge_first: bool,
        left: bool,
    },
    /// A sliding door that people come in by.
    Entrance(Leaves),
}

/// How the leaves of a sliding door are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leaves {
    /// Two black bars that meet, thinner than the wall, between two boxes.
    Bars,
    /// Panes of two lines: one before the other.
    Panes,
}

/// A straight wall along x or y.
#[derive(Clone, Debug)]
pub struct Wall {
    pub a: Point,
    pub b: Point,
    pub thick: f64,
    /// Whether it reaches half its thickness beyond its ends.
    pub outer: bool,
    pub holes: Vec<Hole>,
}

impl Wall {
    fn door(mut self, at: f64, width: f64, hinge_first: bool, left: bool) -> Wall {
        self.holes.push(Hole { at, width, kind: HoleKind::Door { hinge_first, left } });
        self
    }

    fn entrance(mut self, at: f64, width: f64, leaves: Leaves) -> Wall {
        self.holes.push(Hole { at, width, kind: HoleKind::Entrance(leaves) });
        self
    }

    fn windows(mut self, places: &[(f64, f64)]) -> Wall {
        self.holes.extend(places.iter().map(|&(at, width)| Hole { at, width, kind: HoleKind::Window }));
        self
    }

    pub fn along(&self) -> Point {
        let length = self.length();
        [(self.b[0] - self.a[0]) / length, (self.b[1] - self.a[1]) / length]
    }

    pub fn length(&self) -> f64 {
        (self.b[0] - self.a[0]).abs() + (self.b[1] - self.a[1]).abs()
    }

    /// A point at a way along the wall and a distance to its left.
    pub fn place(&self, way: f64, left: f64) -> Point {
        let [x, y] = self.along();
        [self.a[0] + x * way + y * left, self.a[1] + y * way - x * left]
    }

    /// The solid stretches between holes, from where to where.
    pub fn solid(&self) -> Vec<[f64; 2]> {
        let beyond = if self.outer { self.thick * 0.5 } else { 0.0 };
        let mut holes = self.holes.clone();
        holes.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut from = -beyond;
        let mut all = Vec::new();
        for hole in holes {
            all.push([from, hole.at]);
            from = hole.at + hole.width;
        }
        all.push([from, self.length() + beyond]);
        all
    }

    /// A stretch as a rectangle, grown on all sides.
    pub fn stretch(&self, [from, to]: [f64; 2], grown: f64) -> Polygon {
        let half = self.thick * 0.5 + grown;
        let (p, q) = (self.place(from - grown, half), self.place(to + grown, -half));
        rectangle([p[0].min(q[0]), p[1].min(q[1])], [p[0].max(q[0]), p[1].max(q[1])])
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Seat,
    Table,
    Counter,
    Shelf,
    Wc,
    Basin,
    Bed,
}

/// A piece of furniture.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub kind: Kind,
    pub min: Point,
    pub max: Point,
    pub round: bool,
}

#[derive(Clone, Debug)]
pub struct Room {
    pub name: &'static str,
    /// Its floor between the walls' centre lines.
    pub parts: Vec<[f64; 4]>,
    pub label: Point,
}

#[derive(Clone, Debug)]
pub struct Building {
    pub name: &'static str,
    pub size: Point,
    pub walls: Vec<Wall>,
    pub rooms: Vec<Room>,
    pub furniture: Vec<Piece>,
    /// Distances that are dimensioned along x.
    pub stations: Vec<f64>,
}

fn outer(a: Point, b: Point, thick: f64) -> Wall {
    Wall { a, b, thick, outer: true, holes: Vec::new() }
}

fn inner(a: Point, b: Point, thick: f64) -> Wall {
    Wall { a, b, thick, outer: false, holes: Vec::new() }
}

fn room(name: &'static str, [x0, y0, x1, y1]: [f64; 4]) -> Room {
    Room { name, parts: vec![[x0, y0, x1, y1]], label: [(x0 + x1) * 0.5, (y0 + y1) * 0.5] }
}

fn piece(kind: Kind, x: f64, y: f64, width: f64, height: f64) -> Piece {
    let round = matches!(kind, Kind::Wc | Kind::Basin);
    Piece { kind, min: [x, y], max: [x + width, y + height], round }
}

/// A desk with a chair below it.
fn workplace(x: f64, y: f64) -> [Piece; 2] {
    [piece(Kind::Table, x, y, 1.6, 0.8), piece(Kind::Seat, x + 0.55, y + 0.95, 0.5, 0.5)]
}

/// An office of 30 x 18 m with 12 rooms.
pub fn office() -> Building {
    let top = [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0];
    let bottom = [0.0, 6.0, 12.0, 17.0, 23.0, 30.0];
    let windows = |stations: &[f64]| -> Vec<(f64, f64)> {
        stations.windows(2).map(|pair| ((pair[0] + pair[1]) * 0.5 - 0.9, 1.8)).collect()
    };
    let mut walls = vec![
        outer([0.0, 0.0], [30.0, 0.0], 0.3).windows(&windows(&top)),
        outer([30.0, 0.0], [30.0, 18.0], 0.3).door(8.4, 1.2, true, false),
        outer([0.0, 18.0], [30.0, 18.0], 0.3).windows(&windows(&bottom)),
        outer([0.0, 0.0], [0.0, 18.0], 0.3).door(8.4, 1.2, false, true),
    ];
    let (mut north, mut south) = (inner([0.0, 8.0], [30.0, 8.0], 0.15), inner([0.0, 10.0], [30.0, 10.0], 0.15));
    for (k, pair) in top.windows(2).enumerate() {
        north = north.door(pair[0] + if k % 2 == 0 { 0.8 } else { 3.3 }, 0.9, k % 2 == 0, true);
    }
    for (k, pair) in bottom.windows(2).enumerate() {
        south = south.door(pair[0] + 1.0, 0.9, k % 2 == 1, false);
    }
    walls.extend([north, south]);
    walls.extend(top[1..6].iter().map(|&x| inner([x, 0.0], [x, 8.0], 0.15)));
    walls.extend(bottom[1..5].iter().map(|&x| inner([x, 10.0], [x, 18.0], 0.15)));
    let names = ["OFFICE 1", "OFFICE 2", "OFFICE 3", "MEETING", "OFFICE 4", "OFFICE 5"];
    let mut rooms: Vec<Room> =
        top.windows(2).zip(names).map(|(pair, name)| room(name, [pair[0], 0.0, pair[1], 8.0])).collect();
    let names = ["ARCHIVE", "LOUNGE", "WC", "LAB", "KITCHEN"];
    rooms.extend(bottom.windows(2).zip(names).map(|(pair, name)| room(name, [pair[0], 10.0, pair[1], 18.0])));
    rooms.push(room("CORRIDOR", [0.0, 8.0, 30.0, 10.0]));
    let mut furniture = Vec::new();
    for x in [0.0, 5.0, 10.0, 20.0, 25.0] {
        furniture.extend(workplace(x + 0.6, 0.8));
        furniture.extend(workplace(x + 2.8, 0.8));
        furniture.push(piece(Kind::Shelf, x + 0.075, 5.6, 0.4, 1.6));
    }
    furniture.push(piece(Kind::Table, 16.3, 1.6, 2.4, 1.2));
    for k in 0..3 {
        let x = 16.35 + 0.85 * f64::from(k);
        furniture.extend([piece(Kind::Seat, x, 0.95, 0.5, 0.5), piece(Kind::Seat, x, 2.95, 0.5, 0.5)]);
    }
    for k in 0..4 {
        furniture.push(piece(Kind::Shelf, 0.6 + 1.3 * f64::from(k), 16.4, 1.2, 0.4));
    }
    furniture.push(Piece { round: true, ..piece(Kind::Table, 8.2, 15.2, 1.2, 1.2) });
    furniture.extend([piece(Kind::Seat, 7.5, 15.5, 0.5, 0.5), piece(Kind::Seat, 9.6, 15.5, 0.5, 0.5)]);
    furniture.push(piece(Kind::Seat, 6.3, 11.6, 0.8, 2.0));
    for k in 0..3 {
        furniture.push(piece(Kind::Wc, 12.7 + 1.2 * f64::from(k), 17.15, 0.4, 0.65));
        furniture.push(piece(Kind::Basin, 16.4, 11.4 + 0.9 * f64::from(k), 0.45, 0.55));
    }
    furniture.extend(workplace(18.0, 15.6));
    furniture.extend(workplace(20.4, 15.6));
    furniture.push(piece(Kind::Counter, 29.25, 11.5, 0.6, 4.0));
    furniture.push(piece(Kind::Table, 24.6, 15.4, 1.6, 0.9));
    furniture.push(piece(Kind::Counter, 23.075, 17.25, 1.2, 0.6));
    Building { name: "office", size: [30.0, 18.0], walls, rooms, furniture, stations: top.to_vec() }
}

/// An L-shaped flat of 8 rooms with a bath.
pub fn flat() -> Building {
    let thin = 0.11;
    let walls = vec![
        outer([0.0, 0.0], [12.0, 0.0], 0.36).windows(&[(1.5, 1.6), (5.8, 1.2), (9.4, 1.4)]),
        outer([12.0, 0.0], [12.0, 6.0], 0.36).windows(&[(2.0, 1.6)]),
        outer([7.0, 6.0], [12.0, 6.0], 0.36),
        outer([7.0, 6.0], [7.0, 11.0], 0.36).windows(&[(1.8, 1.4)]),
        outer([0.0, 11.0], [7.0, 11.0], 0.36).windows(&[(4.8, 1.2)]),
        outer([0.0, 0.0], [0.0, 11.0], 0.36).door(4.5, 1.0, true, false).windows(&[(1.2, 1.6), (6.6, 0.8)]),
        inner([0.0, 4.0], [8.2, 4.0], thin).door(1.4, 0.85, true, true).door(6.2, 0.85, false, true),
        inner([5.0, 0.0], [5.0, 4.0], thin),
        inner([8.2, 0.0], [8.2, 6.0], thin).door(4.6, 0.85, true, false),
        inner([0.0, 6.0], [2.6, 6.0], thin),
        inner([3.8, 6.0], [7.0, 6.0], thin).door(1.2, 0.85, true, false),
        inner([2.6, 6.0], [2.6, 11.0], thin)
            .door(0.6, 0.8, true, false)
            .door(2.4, 0.75, true, false)
            .door(3.9, 0.75, true, false),
        inner([3.8, 6.0], [3.8, 11.0], thin),
        inner([0.0, 8.2], [2.6, 8.2], thin),
        inner([0.0, 9.6], [2.6, 9.6], thin),
    ];
    let mut hall = room("HALL", [0.0, 4.0, 8.2, 6.0]);
    hall.parts.push([2.6, 6.0, 3.8, 11.0]);
    let rooms = vec![
        room("LIVING", [0.0, 0.0, 5.0, 4.0]),
        room("KITCHEN", [5.0, 0.0, 8.2, 4.0]),
        room("BEDROOM", [8.2, 0.0, 12.0, 6.0]),
        hall,
        room("BATH", [0.0, 6.0, 2.6, 8.2]),
        room("WC", [0.0, 8.2, 2.6, 9.6]),
        room("STORE", [0.0, 9.6, 2.6, 11.0]),
        room("CHILD", [3.8, 6.0, 7.0, 11.0]),
    ];
    let furniture = vec![
        piece(Kind::Seat, 0.3, 0.6, 0.9, 2.2),
        piece(Kind::Table, 1.7, 1.0, 0.7, 1.2),
        piece(Kind::Shelf, 4.545, 0.8, 0.4, 2.0),
        piece(Kind::Counter, 5.055, 0.18, 2.6, 0.6),
        Piece { round: true, ..piece(Kind::Table, 6.6, 1.9, 0.9, 0.9) },
        piece(Kind::Seat, 6.05, 2.1, 0.45, 0.45),
        piece(Kind::Bed, 9.8, 1.9, 2.0, 1.8),
        piece(Kind::Shelf, 8.9, 5.22, 2.0, 0.6),
        piece(Kind::Counter, 0.18, 7.3, 1.7, 0.75),
        piece(Kind::Basin, 1.4, 6.12, 0.55, 0.42),
        piece(Kind::Wc, 0.3, 8.75, 0.62, 0.4),
        piece(Kind::Bed, 4.0, 9.7, 2.0, 0.9),
        piece(Kind::Table, 5.4, 8.1, 1.2, 0.6),
    ];
    Building { name: "flat", size: [12.0, 11.0], walls, rooms, furniture, stations: vec![0.0, 5.0, 8.2, 12.0] }
}

/// A lobby with a sliding entrance of 5 m and one of 2.4 m, and two rooms behind it. No axis lies in an entrance.
fn lobby(leaves: Leaves) -> Building {
    let walls = vec![
        outer([0.0, 0.0], [14.0, 0.0], 0.36).windows(&[(2.0, 1.8), (9.0, 1.8)]),
        outer([14.0, 0.0], [14.0, 11.0], 0.36).entrance(6.6, 2.4, leaves),
        outer([0.0, 11.0], [14.0, 11.0], 0.36).entrance(4.5, 5.0, leaves),
        outer([0.0, 0.0], [0.0, 11.0], 0.36).windows(&[(1.6, 1.6), (7.0, 1.6)]),
        inner([0.0, 5.0], [14.0, 5.0], 0.12).door(1.0, 0.9, true, true).door(11.0, 0.9, false, true),
        inner([6.0, 0.0], [6.0, 5.0], 0.12),
    ];
    let rooms = vec![
        room("SHOP", [0.0, 0.0, 6.0, 5.0]),
        room("OFFICE", [6.0, 0.0, 14.0, 5.0]),
        room("LOBBY", [0.0, 5.0, 14.0, 11.0]),
    ];
    let furniture = vec![piece(Kind::Shelf, 3.0, 4.5, 2.0, 0.4), piece(Kind::Table, 9.0, 2.0, 1.6, 0.8)];
    Building { name: "lobby", size: [14.0, 11.0], walls, rooms, furniture, stations: vec![0.0, 6.0] }
}

pub fn lobby_with_bars() -> Building {
    lobby(Leaves::Bars)
}

pub fn lobby_with_panes() -> Building {
    lobby(Leaves::Panes)
}

/// A cafe of 14 x 10 m: the end of an open door's leaf is 9 cm from the bar.
pub fn cafe() -> Building {
    let walls = vec![
        outer([0.0, 0.0], [14.0, 0.0], 0.3).windows(&[(1.0, 3.0), (5.0, 3.0)]),
        outer([14.0, 0.0], [14.0, 10.0], 0.3),
        outer([0.0, 10.0], [14.0, 10.0], 0.3).door(3.0, 1.0, true, true),
        outer([0.0, 0.0], [0.0, 10.0], 0.3),
        inner([10.0, 0.0], [10.0, 10.0], 0.12).door(1.5, 1.0, true, false).door(8.0, 0.9, true, true),
    ];
    let mut furniture = vec![piece(Kind::Table, 8.15, 0.9, 0.7, 5.0), piece(Kind::Counter, 13.2, 3.0, 0.6, 4.0)];
    for k in 0..6 {
        let (x, y) = (1.5 + 2.2 * f64::from(k % 3), 2.0 + 3.0 * f64::from(k / 3));
        furniture.push(piece(Kind::Table, x, y, 0.9, 0.9));
        furniture.extend([-0.65, 1.05].map(|aside| piece(Kind::Seat, x + 0.2, y + aside, 0.5, 0.5)));
    }
    let rooms = vec![room("GUESTS", [0.0, 0.0, 10.0, 10.0]), room("KITCHEN", [10.0, 0.0, 14.0, 10.0])];
    Building { name: "cafe", size: [14.0, 10.0], walls, rooms, furniture, stations: vec![0.0, 10.0, 14.0] }
}

/// An inn of 16 x 9 m: doors face each other across a corridor of 1.4 m, its entrance has a single leaf of 1.6 m.
pub fn inn() -> Building {
    let stations = [0.0, 4.0, 8.0, 12.0, 16.0];
    let middles = |aside: f64| -> Vec<(f64, f64)> { stations[..4].iter().map(|x| (x + aside, 1.4)).collect() };
    let (mut north, mut south) = (inner([0.0, 3.8], [16.0, 3.8], 0.12), inner([0.0, 5.2], [16.0, 5.2], 0.12));
    for (x, aside) in stations[..4].iter().zip([0.0, 0.3, -0.4, 0.8]) {
        north = north.door(x + 1.6, 0.9, true, true);
        south = south.door(x + 1.6 + aside, 0.9, true, false);
    }
    let mut walls = vec![
        outer([0.0, 0.0], [16.0, 0.0], 0.3).windows(&middles(1.3)),
        outer([16.0, 0.0], [16.0, 9.0], 0.3).door(3.95, 1.1, true, false),
        outer([0.0, 9.0], [16.0, 9.0], 0.3).windows(&middles(1.3)[1..]).door(1.2, 1.6, true, true),
        outer([0.0, 0.0], [0.0, 9.0], 0.3),
        north,
        south,
    ];
    walls.extend(
        stations[1..4].iter().flat_map(|&x| [[0.0, 3.8], [5.2, 9.0]].map(|[y, to]| inner([x, y], [x, to], 0.12))),
    );
    let names = [["ROOM 1", "ROOM 2", "ROOM 3", "ROOM 4"], ["DINING", "ROOM 5", "ROOM 6", "ROOM 7"]];
    let mut rooms = vec![room("HALL", [0.0, 3.8, 16.0, 5.2])];
    for (row, [y, to]) in names.into_iter().zip([[0.0, 3.8], [5.2, 9.0]]) {
        rooms.extend(row.into_iter().zip(stations).map(|(name, x)| room(name, [x, y, x + 4.0, to])));
    }
    let furniture = stations[..4].iter().map(|x| piece(Kind::Bed, x + 0.4, 0.4, 0.9, 2.0)).collect();
    Building { name: "inn", size: [16.0, 9.0], walls, rooms, furniture, stations: stations.to_vec() }
}

/// A school's floor whose partitions end at every other window.
pub fn school_with_ribbons() -> Building {
    let mut building = school();
    let ribbons: Vec<(f64, f64)> = (0..5).map(|k| (9.6 * f64::from(k) + 0.7, 8.2)).collect();
    building.walls[0] = outer([0.0, 0.0], [48.0, 0.0], 0.4).windows(&ribbons);
    building
}

/// A school's floor of 48 x 20 m with 20 rooms.
pub fn school() -> Building {
    let top: Vec<f64> = (0..=10).map(|k| 4.8 * f64::from(k)).collect();
    let bottom = [0.0, 6.0, 12.0, 18.0, 22.0, 26.0, 30.0, 36.0, 42.0, 48.0];
    let windows = |stations: &[f64]| -> Vec<(f64, f64)> {
        stations.windows(2).map(|pair| (pair[0] + 0.7, pair[1] - pair[0] - 1.4)).collect()
    };
    let mut walls = vec![
        outer([0.0, 0.0], [48.0, 0.0], 0.4).windows(&windows(&top)),
        outer([48.0, 0.0], [48.0, 20.0], 0.4).door(9.1, 1.4, true, false),
        outer([0.0, 20.0], [48.0, 20.0], 0.4).windows(&windows(&bottom)),
        outer([0.0, 0.0], [0.0, 20.0], 0.4).door(9.1, 1.4, false, true),
    ];
    let (mut north, mut south) = (inner([0.0, 8.3], [48.0, 8.3], 0.2), inner([0.0, 11.3], [48.0, 11.3], 0.2));
    for (k, pair) in top.windows(2).enumerate() {
        north = north.door(pair[0] + 0.8, 0.95, k % 2 == 0, true);
    }
    for (k, pair) in bottom.windows(2).enumerate() {
        south = south.door(pair[1] - 1.8, 0.95, k % 2 == 1, false);
    }
    walls.extend([north, south]);
    walls.extend(top[1..10].iter().map(|&x| inner([x, 0.0], [x, 8.3], 0.2)));
    walls.extend(bottom[1..9].iter().map(|&x| inner([x, 11.3], [x, 20.0], 0.2)));
    let names = ["1.01", "1.02", "1.03", "1.04", "1.05", "1.06", "1.07", "1.08", "1.09", "1.10"];
    let mut rooms: Vec<Room> =
        top.windows(2).zip(names).map(|(pair, name)| room(name, [pair[0], 0.0, pair[1], 8.3])).collect();
    let names = ["1.11", "1.12", "1.13", "GIRLS", "STAFF", "BOYS", "1.17", "1.18", "1.19"];
    rooms.extend(bottom.windows(2).zip(names).map(|(pair, name)| room(name, [pair[0], 11.3, pair[1], 20.0])));
    rooms.push(room("CORRIDOR", [0.0, 8.3, 48.0, 11.3]));
    let mut furniture = Vec::new();
    for &x in &top[..10] {
        for row in 0..2 {
            for column in 0..2 {
                let (x, y) = (x + 0.7 + 2.0 * f64::from(column), 1.0 + 1.6 * f64::from(row));
                furniture.push(piece(Kind::Table, x, y, 1.3, 0.55));
                furniture.push(piece(Kind::Seat, x + 0.1, y + 0.65, 0.42, 0.42));
                furniture.push(piece(Kind::Seat, x + 0.75, y + 0.65, 0.42, 0.42));
            }
        }
    }
    for x in [18.0, 26.0] {
        for k in 0..3 {
            furniture.push(piece(Kind::Wc, x + 0.5 + 1.1 * f64::from(k), 19.1, 0.4, 0.65));
        }
    }
    for x in [0.0, 6.0, 12.0, 30.0, 36.0, 42.0] {
        furniture.push(piece(Kind::Shelf, x + 0.1, 14.0, 0.45, 2.4));
        furniture.push(piece(Kind::Table, x + 2.2, 17.2, 1.8, 0.8));
    }
    Building { name: "school", size: [48.0, 20.0], walls, rooms, furniture, stations: top }
}

impl Building {
    /// The solid walls, each stretch grown on all sides.
    pub fn solid(&self, grown: f64) -> Vec<Polygon> {
        self.walls.iter().flat_map(|wall| wall.solid().into_iter().map(|s| wall.stretch(s, grown))).collect()
    }

    pub fn holes(&self) -> impl Iterator<Item = (&Wall, &Hole)> {
        self.walls.iter().flat_map(|wall| wall.holes.iter().map(move |hole| (wall, hole)))
    }

    pub fn hole_polygons(&self, is_door: bool) -> Vec<Polygon> {
        self.holes()
            .filter(|(_, hole)| (hole.kind != HoleKind::Window) == is_door)
            .map(|(wall, hole)| wall.stretch([hole.at, hole.at + hole.width], 0.0))
            .collect()
    }
}
