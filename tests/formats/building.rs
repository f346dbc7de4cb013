//! An office of 30 x 18 m: a corridor from the west to the east entrance, six rooms on either side.

/// A rectangle in metres: least x and y, greatest x and y. The building's south-west corner is the origin.
pub type Rect = [f64; 4];

pub const WIDTH_M: f64 = 30.0;
pub const DEPTH_M: f64 = 18.0;

/// The office, known exactly.
pub struct Building {
    /// Thickness of outer and of inner walls.
    pub outer_m: f64,
    pub inner_m: f64,
    /// Whole walls, before doors and windows are cut.
    pub walls: Vec<Rect>,
    pub doors: Vec<Rect>,
    pub windows: Vec<Rect>,
    pub desks: Vec<Rect>,
    /// The middles of the rooms, clear of desks.
    pub rooms: Vec<[f64; 2]>,
}

impl Building {
    pub fn new(outer_m: f64, inner_m: f64) -> Building {
        let (o, h) = (outer_m, inner_m * 0.5);
        let mut walls = vec![
            [0.0, 0.0, WIDTH_M, o],
            [0.0, DEPTH_M - o, WIDTH_M, DEPTH_M],
            [0.0, 0.0, o, DEPTH_M],
            [WIDTH_M - o, 0.0, WIDTH_M, DEPTH_M],
            [o, 8.0 - h, WIDTH_M - o, 8.0 + h],
            [o, 10.0 - h, WIDTH_M - o, 10.0 + h],
        ];
        for k in 1..6 {
            let x = 5.0 * f64::from(k);
            walls.push([x - h, o, x + h, 8.0 - h]);
            walls.push([x - h, 10.0 + h, x + h, DEPTH_M - o]);
        }
        let mut doors = vec![[0.0, 8.2, o, 9.8], [WIDTH_M - o, 8.2, WIDTH_M, 9.8]];
        let (mut windows, mut desks, mut rooms) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..6 {
            let x = 5.0 * f64::from(k);
            doors.push([x + 2.0, 8.0 - h, x + 2.9, 8.0 + h]);
            doors.push([x + 2.0, 10.0 - h, x + 2.9, 10.0 + h]);
            windows.push([x + 1.75, 0.0, x + 3.25, o]);
            windows.push([x + 1.75, DEPTH_M - o, x + 3.25, DEPTH_M]);
            desks.push([x + 1.5, 2.0, x + 3.1, 2.8]);
            desks.push([x + 1.5, 14.0, x + 3.1, 14.8]);
            rooms.extend([[x + 2.5, 5.0], [x + 2.5, 13.0]]);
        }
        Building { outer_m, inner_m, walls, doors, windows, desks, rooms }
    }

    /// Without its two entrances: the outer wall is a ring.
    pub fn closed(mut self) -> Building {
        self.doors.drain(..2);
        self
    }

    /// Walls between doors and windows.
    pub fn solid_walls(&self) -> Vec<Rect> {
        let mut pieces = Vec::new();
        for wall in &self.walls {
            let across = wall[2] - wall[0] > wall[3] - wall[1];
            let (from, to) = if across { (0, 2) } else { (1, 3) };
            let cuts = self.doors.iter().chain(&self.windows).filter(|cut| {
                // Of the same wall: as thick, and inside its length.
                let (a, b) = if across { (1, 3) } else { (0, 2) };
                (cut[a] - wall[a]).abs() < 1e-9 && (cut[b] - wall[b]).abs() < 1e-9
            });
            let mut cuts: Vec<(f64, f64)> = cuts.map(|cut| (cut[from], cut[to])).collect();
            cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut start = wall[from];
            for (low, high) in cuts.into_iter().chain([(wall[to], wall[to])]) {
                let mut piece = *wall;
                (piece[from], piece[to]) = (start, low);
                pieces.push(piece);
                start = high;
            }
        }
        pieces
    }

    /// Whether a place is wall or window.
    pub fn is_solid(&self, [x, y]: [f64; 2]) -> bool {
        let inside = |r: &Rect| x >= r[0] && x <= r[2] && y >= r[1] && y <= r[3];
        self.walls.iter().any(inside) && !self.doors.iter().any(inside)
    }

    /// Corners of rooms, which a tracer must meet.
    pub fn inner_corners(&self) -> Vec<[f64; 2]> {
        let h = self.inner_m * 0.5;
        let mut corners = Vec::new();
        for k in 0..6 {
            let west = if k == 0 { self.outer_m } else { 5.0 * f64::from(k) + h };
            let east = if k == 5 { WIDTH_M - self.outer_m } else { 5.0 * f64::from(k + 1) - h };
            for x in [west, east] {
                corners.extend([self.outer_m, 8.0 - h, 10.0 + h, DEPTH_M - self.outer_m].map(|y| [x, y]));
            }
        }
        corners
    }
}
