//! Furniture that stands at a wall is told from the wall.

use super::components::{Components, Neighbours, around};
use super::{FloorPlan, PlanClass, thick};

/// Largest place beside furniture that nobody reaches and that is floor all the same, square metres: others are rooms.
const LARGEST_NICHE_M2: f64 = 1.5;
/// Smaller pieces are crumbs that a gap leaves, square metres.
const LEAST_PIECE_M2: f64 = 0.03;
/// Gap between furniture and the wall behind it, metres: the wall is seen above a table that stands at it.
const GAP_M: f64 = 0.03;
/// Widest gap, pixels.
const MOST_GAP_PX: usize = 8;

impl FloorPlan {
    /// Sets low furniture free of the walls and of taller pieces: a gap between them becomes floor, and so does what is too
    /// narrow for people beside it. So walls go on behind furniture, and each piece stands as a box of its own.
    pub(crate) fn set_furniture_free(&mut self) {
        let width = self.width_px as usize;
        let mask =
            |is: &dyn Fn(usize) -> bool| -> Vec<u8> { (0..self.floor.len()).map(|at| u8::from(is(at))).collect() };
        let furniture = mask(&|at| self.floor[at] == 0 && self.classes[at].height_m().is_some());
        if !furniture.contains(&1) {
            return;
        }
        let is_white = |at: usize| self.lightness[at] >= self.threshold && !self.classes[at].is_solid();
        let white = mask(&|at| self.floor[at] == 0 && is_white(at));
        let pixel_m2 = self.metres_per_pixel * self.metres_per_pixel;
        let largest = LARGEST_NICHE_M2 / pixel_m2;
        // Furniture that people reach, with the niches beside it.
        let mut standing = furniture.clone();
        let beside_furniture = thick::grow(&furniture, width, 1);
        let whites = Components::of(&white, width, 1, Neighbours::Four);
        for niche in whites.all.iter().filter(|niche| niche.area as f64 <= largest) {
            if whites.touches(niche, &beside_furniture, width) {
                whites.paint(niche, &mut standing, width, 1);
            }
        }
        let pieces = Components::of(&standing, width, 1, Neighbours::Four);
        let beside_floor = thick::grow(&self.floor, width, 1);
        let mut solid = mask(&|at| self.floor[at] == 0 && standing[at] == 0);
        for piece in pieces.all.iter().filter(|piece| !pieces.touches(piece, &beside_floor, width)) {
            pieces.paint(piece, &mut standing, width, 0);
            pieces.paint(piece, &mut solid, width, 1);
        }
        let gap_px = ((GAP_M / self.metres_per_pixel).round() as usize).clamp(1, MOST_GAP_PX);
        let by_wall = thick::grow(&solid, width, gap_px);
        let is_beside_taller = |at: usize| {
            let height_m = self.classes[at].height_m();
            let taller = |at: usize| furniture.get(at) == Some(&1) && self.classes[at].height_m() > height_m;
            around(at, width).any(taller)
        };
        let is_gap = |at: usize| furniture[at] == 0 || by_wall[at] != 0 || is_beside_taller(at);
        let freed: Vec<usize> = (0..standing.len()).filter(|&at| standing[at] != 0 && is_gap(at)).collect();
        let mut free = |at: usize| (self.classes[at], self.floor[at], self.lightness[at]) = (PlanClass::Floor, 1, 255);
        let mut left: Vec<u8> = furniture.iter().zip(&standing).map(|(piece, standing)| piece & standing).collect();
        for at in freed {
            left[at] = 0;
            free(at);
        }
        let least = LEAST_PIECE_M2 / pixel_m2;
        let pieces = Components::of(&left, width, 1, Neighbours::Four);
        let crumbs = pieces.all.iter().filter(|piece| (piece.area as f64) < least);
        crumbs.flat_map(|piece| pieces.ranges(piece, width)).flatten().for_each(free);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walls::{Walls, WallsOptions};

    #[test]
    fn a_table_at_a_wall_is_a_box_before_it() {
        // A room of 5 x 4 m with a table of 2 x 1 m at its northern wall, 5 cm to a pixel.
        let table = |x: u32, y: u32| (40..80).contains(&x) && (2..22).contains(&y);
        let inside = |x: u32, y: u32| (2..102).contains(&x) && (2..82).contains(&y);
        let mut plan = FloorPlan::with_furniture([104, 84], 0.05, inside, (PlanClass::Table, table));
        plan.set_furniture_free();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let found: Vec<_> = walls.faces.iter().map(|face| (face.furniture_m, face.length_m())).collect();
        assert_eq!(found.len(), 2);
        assert!(found[0].0.is_none() && (found[0].1 - 18.0).abs() < 1e-9, "{found:?}");
        assert!(found[1].0 == Some(0.75) && (found[1].1 - 5.9).abs() < 1e-9, "{found:?}");
    }
}
