//! The rooms that walls, doors and windows enclose.

use super::super::components::{Components, Neighbours};

/// The rooms of a drawing.
pub(in super::super) struct Rooms {
    pieces: Components,
    /// How many pixels of the drawing along a side are one of the rooms'.
    factor: usize,
}

impl Rooms {
    /// The rooms of what is enclosed (1 in `inside`).
    pub(super) fn of(inside: &[u8], width: usize, factor: usize) -> Rooms {
        Rooms { pieces: Components::of(inside, width, 1, Neighbours::Four), factor }
    }

    /// The room at a pixel of the drawing.
    pub(in super::super) fn at(&self, place: [usize; 2]) -> Option<usize> {
        let [x, y] = place.map(|place| (place / self.factor) as u32);
        self.pieces.all.iter().position(|room| {
            let is_near = room.min[0] <= x && room.min[1] <= y && x < room.end[0] && y < room.end[1];
            is_near && self.pieces.runs(room).iter().any(|run| run.y == y && (run.from..run.to).contains(&x))
        })
    }

    /// Area of a room in square pixels, and the sides of its box in pixels.
    pub(in super::super) fn area_and_size(&self, room: usize) -> (f64, [f64; 2]) {
        let (room, factor) = (&self.pieces.all[room], self.factor as f64);
        (room.area as f64 * factor * factor, room.size().map(|side| f64::from(side) * factor))
    }
}
