//! Traces wall faces of a plan as polylines; nearest wall, line of sight, floor coverage.

use rayon::prelude::*;

use boundary::Boundary;

use crate::math::{Rect, Vec2, vec2};
use crate::options::options;
use crate::plan::{FloorPlan, cracks};

mod boundary;
mod coverage;
mod curve;
mod error;
mod face;
mod fit;
mod grid;
mod index;
mod line;
mod outline;
mod piece;
mod places;
mod polygon;
mod runs;
mod stabbing;
mod subpixel;
mod untangle;

#[cfg(test)]
mod truth_tests;

pub use error::WallsError;
pub(crate) use face::{APRON_M, COUNTER_M, Segment, TABLES_M};
pub use face::{Face, Nearest};
pub(crate) use index::closest_on;
pub use outline::Outline;
pub(crate) use outline::check as check_outlines;
pub(crate) use places::DOOR_HEAD_M;
pub use places::{Corner, Doorway};

options! {
    /// Options of tracing walls.
    pub struct WallsOptions {
        /// How far traced walls may lie from the drawn ones.
        tolerance_px: f64 = 0.5, in 0.05..=10.0, unit "pixels of the plan";
    }
}

/// Wall faces of a plan, with a spatial index.
#[derive(Debug)]
pub struct Walls {
    /// Wall faces, longest first, then by start.
    pub faces: Vec<Face>,
    outlines: Vec<Outline>,
    bounds: Rect,
    index: index::Index,
    floor_edges: coverage::Edges,
    /// Edges of the floor as if no furniture stood on it; `None` without furniture.
    cleared_edges: Option<coverage::Edges>,
}

impl Walls {
    /// Traces the boundary of a plan's floor.
    ///
    /// # Example
    /// ```
    /// use trodden::{plan::FloorPlan, walls::Walls};
    ///
    /// // A room of 3 x 2 m, 10 cm to a pixel; 1 is floor.
    /// let floor = |k: u32| u8::from((1..31).contains(&(k % 32)) && (1..21).contains(&(k / 32)));
    /// let plan = FloorPlan::from_mask(32, 22, 0.1, (0..32 * 22).map(floor).collect());
    /// assert_eq!(Walls::trace(&plan, &Default::default()).faces.len(), 1);
    /// ```
    pub fn trace(plan: &FloorPlan, options: &WallsOptions) -> Walls {
        let loops = cracks::trace(&plan.floor, plan.width_px as usize);
        let fit = |l| Boundary::fit(plan, l, options.tolerance_px / 0.5);
        let mut boundaries: Vec<Boundary> = loops.par_iter().map(fit).collect();
        untangle::untangle(&mut boundaries, vec2(f64::from(plan.width_px), f64::from(plan.height_px)));
        Walls::of(boundaries.iter().map(|boundary| boundary.outline(plan)).collect())
    }

    /// Rebuilds walls from outlines, see [`Walls::outlines`].
    ///
    /// # Errors
    /// An outline has fewer than three points or an opening at an invalid edge; the outlines' extent or total length
    /// exceeds that of any plan.
    pub fn from_outlines(outlines: Vec<Outline>) -> Result<Walls, WallsError> {
        check_outlines(&outlines)?;
        Ok(Walls::of(outlines))
    }

    /// The walls with small islands beside these lines as low furniture: cabinets of gates, free-standing counters.
    pub(crate) fn lowered(self, beside: &[[Vec2; 2]], height_m: f64) -> Walls {
        let mut outlines = self.outlines.clone();
        let low = outlines.iter_mut().filter(|outline| outline.furniture_m.is_none() && outline.is_small_island());
        let mut any = false;
        for outline in low.filter(|outline| beside.iter().any(|&line| outline.stands_beside(line))) {
            outline.furniture_m = Some(height_m);
            any = true;
        }
        if any { Walls::of(outlines) } else { self }
    }

    fn of(outlines: Vec<Outline>) -> Walls {
        let faces = outline::faces(&outlines);
        let segments = outline::wall_segments(&faces, &outlines);
        let walked = outline::walked_loops(&outlines);
        let has_furniture = outlines.iter().any(|outline| outline.furniture_m.is_some());
        let cleared = || outlines.iter().filter(|outline| outline.furniture_m.is_none());
        Walls {
            bounds: outline::bounds(&outlines),
            index: index::Index::new(segments, &walked),
            floor_edges: coverage::Edges::new(outlines.iter()),
            cleared_edges: has_furniture.then(|| coverage::Edges::new(cleared())),
            faces,
            outlines,
        }
    }

    /// Closed loops around all floor, floor on the right, without aprons.
    pub fn outlines(&self) -> &[Outline] {
        &self.outlines
    }

    /// Bounding box of all floor, without aprons, metres.
    pub fn bounds_m(&self) -> Rect {
        self.bounds
    }

    /// Returns the wall nearest to `p` within `within_m` metres, apron walls included.
    pub fn nearest(&self, p: Vec2, within_m: f64) -> Option<Nearest> {
        self.index.nearest(p, within_m)
    }

    /// Whether `p` lies on floor or on an apron.
    pub fn is_inside(&self, p: Vec2) -> bool {
        self.index.is_inside(p)
    }

    /// Whether the straight line between two points crosses no wall.
    pub fn sight(&self, a: Vec2, b: Vec2) -> bool {
        self.index.sight(a, b)
    }

    /// Appends every wall segment (apron walls included) that comes near `area`, each once, in a fixed order.
    pub(crate) fn segments_near(&self, area: Rect, out: &mut Vec<Segment>) {
        self.index.segments_near(area, out);
    }

    /// As [`Walls::segments_near`], without furniture on legs, along which no dirt gathers.
    pub(crate) fn segments_to_floor(&self, area: Rect, out: &mut Vec<Segment>) {
        self.segments_near(area, out);
        out.retain(|segment| segment.face.is_none_or(|face| !self.faces[face].is_on_legs()));
    }

    /// Computes the exact share of floor in each texel, 0..=1; aprons do not count.
    ///
    /// Texel (i, j) covers `[i, i+1)/t x [j, j+1)/t` metres of the plan frame; `out` is row-major and its row 0 is
    /// `j0`, the southernmost. A texel's value does not depend on the requested rectangle.
    pub fn coverage(&self, texels_per_metre: f64, i0: i64, j0: i64, width: usize, height: usize, out: &mut [f32]) {
        self.floor_edges.coverage(texels_per_metre, i0, j0, width, height, out);
    }

    /// The same as if no furniture stood on the floor.
    pub(crate) fn cleared_coverage(
        &self,
        texels_per_metre: f64,
        [i0, j0]: [i64; 2],
        [width, height]: [usize; 2],
        out: &mut [f32],
    ) {
        let edges = self.cleared_edges.as_ref().unwrap_or(&self.floor_edges);
        edges.coverage(texels_per_metre, i0, j0, width, height, out);
    }

    /// Whether furniture stands on the floor.
    pub(crate) fn has_furniture(&self) -> bool {
        self.cleared_edges.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanClass;

    /// A plan drawn with characters: `.` is floor, others are wall; 1 m per pixel.
    fn plan(rows: &[&str]) -> FloorPlan {
        let floor = rows.iter().flat_map(|r| r.bytes()).map(|b| u8::from(b == b'.')).collect();
        FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, 1.0, floor)
    }

    fn walls(rows: &[&str]) -> Walls {
        Walls::trace(&plan(rows), &WallsOptions::default())
    }

    #[test]
    fn a_corridor_has_two_open_faces_with_the_floor_on_their_right() {
        let walls = walls(&["######", "......", "......", "######"]);
        let points: Vec<_> = walls.faces.iter().map(|f| (f.closed, f.points_m.clone())).collect();
        let south = vec![vec2(6.0, 1.0), vec2(0.0, 1.0)];
        let north = vec![vec2(0.0, 3.0), vec2(6.0, 3.0)];
        assert_eq!(points, [(false, south), (false, north)]);
    }

    #[test]
    fn a_pillar_in_a_room_is_a_closed_face_that_starts_at_its_lowest_corner() {
        let walls = walls(&["######", "#....#", "#.##.#", "#....#", "######"]);
        assert_eq!(walls.faces.len(), 2);
        assert!(walls.faces.iter().all(|f| f.closed));
        assert_eq!(walls.faces[1].points_m, [vec2(2.0, 2.0), vec2(4.0, 2.0), vec2(4.0, 3.0), vec2(2.0, 3.0)]);
        assert_eq!(walls.faces[0].points_m[..2], [vec2(1.0, 1.0), vec2(1.0, 4.0)]);
    }

    /// A room of 8 x 5 m with two tables, 1.2 m apart, that nearly reach the walls.
    fn two_tables() -> FloorPlan {
        let table = |x: u32, y: u32| (3..22).contains(&y) && ((12..18).contains(&x) || (24..30).contains(&x));
        let inside = |x: u32, y: u32| (1..41).contains(&x) && (1..26).contains(&y);
        FloorPlan::with_furniture([42, 27], 0.2, inside, (PlanClass::Table, table))
    }

    #[test]
    fn tables_have_their_height_and_no_doors_between_them() {
        let walls = Walls::trace(&two_tables(), &WallsOptions::default());
        assert_eq!(walls.faces.iter().map(|face| face.furniture_m).collect::<Vec<_>>(), [None, Some(0.75), Some(0.75)]);
        assert!(walls.doorways().is_empty());
        let again = Walls::from_outlines(walls.outlines().to_vec()).unwrap();
        assert_eq!(again.faces, walls.faces);
        let mut wrong = walls.outlines().to_vec();
        wrong[1].furniture_m = Some(f64::NAN);
        assert!(matches!(Walls::from_outlines(wrong), Err(WallsError::Furniture { outline: 1, .. })));
    }

    /// A room of 8 x 5 m whose bed stands at two walls, with a niche of 0.2 m behind its head, beside a closed room with a
    /// bed of its own.
    #[test]
    fn a_bed_at_a_wall_is_an_island_of_its_own_height() {
        let pixels = || (0..27u32).flat_map(|y| (0..62u32).map(move |x| (x, y)));
        let bed = |x: u32, y: u32| (1..11).contains(&x) && (2..11).contains(&y) || x > 50 && x < 61 && y > 10 && y < 20;
        let niche = |x: u32, y: u32| (1..11).contains(&x) && y == 1;
        let inside = |x: u32, y: u32| (1..41).contains(&x) && (1..26).contains(&y);
        let closed = |x: u32, y: u32| (42..61).contains(&x) && (1..26).contains(&y);
        let floor = pixels().map(|(x, y)| u8::from(inside(x, y) && !bed(x, y) && !niche(x, y))).collect();
        let mut plan = FloorPlan::from_mask(62, 27, 0.2, floor);
        for (k, (x, y)) in pixels().enumerate() {
            let class = if bed(x, y) { PlanClass::Seat } else { PlanClass::Outside };
            if bed(x, y) || niche(x, y) || closed(x, y) {
                plan.classes[k] = class;
                plan.lightness[k] = if bed(x, y) { 0 } else { 255 };
            }
        }
        plan.set_furniture_free();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let faces: Vec<_> =
            walls.faces.iter().map(|face| (face.furniture_m, (face.length_m() * 10.0).round())).collect();
        // The wall goes all round the room; a pixel is free between bed and wall.
        assert_eq!(faces, [(None, 260.0), (Some(0.45), 72.0)]);
        let area_m2 = |cleared: bool| {
            let mut share = vec![0.0; 62 * 27];
            match cleared {
                true => walls.cleared_coverage(5.0, [0, 0], [62, 27], &mut share),
                false => walls.coverage(5.0, 0, 0, 62, 27, &mut share),
            }
            share.iter().sum::<f32>() * 0.04
        };
        assert!((area_m2(true) - 40.0).abs() < 1e-4 && (area_m2(false) - 36.76).abs() < 1e-4, "{}", area_m2(false));
    }

    #[test]
    fn an_apron_is_inside_and_has_walls_but_no_coverage() {
        let walls = walls(&["###", "...", "###"]);
        assert!(walls.is_inside(vec2(-2.9, 1.5)) && walls.is_inside(vec2(5.9, 1.5)));
        assert!(!walls.is_inside(vec2(-3.1, 1.5)) && !walls.is_inside(vec2(-1.0, 0.9)));
        let nearest = walls.nearest(vec2(-1.0, 1.2), 1.0).unwrap();
        assert_eq!((nearest.face, nearest.point_m), (None, vec2(-1.0, 1.0)));
        assert!(walls.sight(vec2(-2.0, 1.5), vec2(5.0, 1.5)));
        assert!(!walls.sight(vec2(-2.0, 1.5), vec2(-2.0, 2.5)));
        let mut out = [9.0; 5];
        walls.coverage(1.0, -1, 1, 5, 1, &mut out);
        assert_eq!(out, [0.0, 1.0, 1.0, 1.0, 0.0]);
    }

    #[test]
    fn coverage_is_the_area_share() {
        let walls = walls(&["####", "#..#", "####"]);
        let mut out = [0.0; 2];
        walls.coverage(0.25, 0, 0, 2, 1, &mut out);
        assert_eq!(out, [2.0 / 16.0, 0.0]);
    }
}
