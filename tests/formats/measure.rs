//! How well a plan that was read shows the building that was drawn.

use std::path::Path;

use trodden::math::Vec2;
use trodden::plan::{FloorPlan, PlanClass, PlanOptions, read};
use trodden::walls::{Walls, WallsOptions};

use super::building::{Building, DEPTH_M, Rect, WIDTH_M};

pub fn read_with(
    name: &str,
    bytes: impl AsRef<[u8]>,
    options: &PlanOptions,
) -> Result<FloorPlan, trodden::plan::PlanError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read(Path::new(&path), options)
}

/// A plan and where the building's south-west corner lies in it.
pub struct Seen {
    pub plan: FloorPlan,
    corner_m: Vec2,
}

impl Seen {
    /// Reads a drawing whose building begins at a place of the drawing's frame, metres.
    pub fn of(name: &str, bytes: impl AsRef<[u8]>, begins_m: [f64; 2]) -> Seen {
        Seen::with(name, bytes, begins_m, &PlanOptions::default())
    }

    /// Reads such a drawing with options.
    pub fn with(name: &str, bytes: impl AsRef<[u8]>, begins_m: [f64; 2], options: &PlanOptions) -> Seen {
        let plan = read_with(name, bytes, options).unwrap();
        let origin = plan.map_from_plan.origin_m;
        Seen { corner_m: Vec2 { x: begins_m[0] - origin.x, y: begins_m[1] - origin.y }, plan }
    }

    fn building_m(&self, at: usize) -> [f64; 2] {
        let (x, y) = (at % self.plan.width_px as usize, at / self.plan.width_px as usize);
        let p = self.plan.px_to_m([x as f64 + 0.5, y as f64 + 0.5]) - self.corner_m;
        [p.x, p.y]
    }

    fn index(&self, [x, y]: [f64; 2]) -> usize {
        let [x, y] = self.plan.m_to_px(Vec2 { x, y } + self.corner_m);
        y as usize * self.plan.width_px as usize + x as usize
    }

    fn middle(rect: &Rect) -> [f64; 2] {
        [(rect[0] + rect[2]) * 0.5, (rect[1] + rect[3]) * 0.5]
    }

    fn is_wall(class: PlanClass) -> bool {
        matches!(class, PlanClass::Wall | PlanClass::Window)
    }

    /// Area of walls that both show, over that of walls that either shows; of pixels at their sides, the share.
    pub fn iou(&self, truth: &Building) -> f64 {
        const STEPS: usize = 4;
        let pixel = self.plan.metres_per_pixel;
        let off = |k: usize| ((k as f64 + 0.5) / STEPS as f64 - 0.5) * pixel;
        let (mut both, mut either) = (0.0, 0.0);
        for (at, class) in self.plan.classes.iter().enumerate() {
            let [x, y] = self.building_m(at);
            let places = (0..STEPS * STEPS).map(|k| [x + off(k % STEPS), y + off(k / STEPS)]);
            let is = places.filter(|p| truth.is_solid(*p)).count() as f64 / (STEPS * STEPS) as f64;
            let dark = 1.0 - f64::from(self.plan.lightness[at]) / 255.0;
            let seen = if class.is_furniture() { 0.0 } else { dark };
            both += seen.min(is);
            either += seen.max(is);
        }
        both / either
    }

    /// Width and depth between the outermost wall pixels over the true ones; 1 at the right scale.
    pub fn scale(&self) -> [f64; 2] {
        let walls = (0..self.plan.classes.len()).filter(|at| Seen::is_wall(self.plan.classes[*at]));
        let mut bounds = [f64::MAX, f64::MAX, f64::MIN, f64::MIN];
        for at in walls {
            let [x, y] = self.building_m(at);
            bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
        }
        let pixel = self.plan.metres_per_pixel;
        [(bounds[2] - bounds[0] + pixel) / WIDTH_M, (bounds[3] - bounds[1] + pixel) / DEPTH_M]
    }

    pub fn class_at(&self, p: [f64; 2]) -> PlanClass {
        self.plan.classes[self.index(p)]
    }

    /// Doors that are open floor, and of those the ones known as doors.
    pub fn open_doors(&self, truth: &Building) -> [usize; 2] {
        let open: Vec<&Rect> =
            truth.doors.iter().filter(|d| self.plan.floor[self.index(Seen::middle(d))] == 1).collect();
        let known = open.iter().filter(|d| self.class_at(Seen::middle(d)) == PlanClass::Door).count();
        [open.len(), known]
    }

    pub fn closed_windows(&self, truth: &Building) -> usize {
        truth.windows.iter().filter(|w| self.class_at(Seen::middle(w)) == PlanClass::Window).count()
    }

    pub fn desks(&self, truth: &Building) -> usize {
        let is_desk = |d: &&Rect| {
            let at = self.index(Seen::middle(d));
            self.plan.classes[at] == PlanClass::Table && self.plan.floor[at] == 0
        };
        truth.desks.iter().filter(is_desk).count()
    }

    /// Rooms that can be walked to from the corridor.
    pub fn rooms_reached(&self, truth: &Building) -> usize {
        let width = self.plan.width_px as usize;
        let mut reached = vec![false; self.plan.floor.len()];
        let mut next = vec![self.index([15.0, 9.0])];
        while let Some(at) = next.pop() {
            if self.plan.floor[at] == 1 && !std::mem::replace(&mut reached[at], true) {
                next.extend(
                    [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width]
                        .into_iter()
                        .filter(|n| *n < reached.len()),
                );
            }
        }
        truth.rooms.iter().filter(|room| reached[self.index(**room)]).count()
    }

    /// Distance of the corners of rooms from the nearest corner of a traced wall, metres: the mean and the greatest.
    pub fn corner_error_m(&self, truth: &Building) -> [f64; 2] {
        let walls = Walls::trace(&self.plan, &WallsOptions::default());
        let corners: Vec<Vec2> = walls.faces.iter().flat_map(|face| face.points_m.iter().copied()).collect();
        let errors: Vec<f64> = truth
            .inner_corners()
            .into_iter()
            .map(|[x, y]| {
                let corner = Vec2 { x, y } + self.corner_m;
                corners.iter().map(|c| c.distance(corner)).fold(f64::MAX, f64::min)
            })
            .collect();
        [errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max)]
    }

    /// Checks what every format must give.
    pub fn check(&self, truth: &Building, what: &str) {
        let (iou, scale, corners) = (self.iou(truth), self.scale(), self.corner_error_m(truth));
        let [open, known] = self.open_doors(truth);
        println!(
            "{what}: IoU {iou:.4}, scale {scale:?}, doors {open} open {known} known, rooms {}, corners {:.2} mm mean {:.2} mm most",
            self.rooms_reached(truth),
            corners[0] * 1e3,
            corners[1] * 1e3
        );
        println!("{:#?}", self.plan.warnings);
        assert!(iou >= 0.98, "{what}: wall IoU {iou}");
        assert!(scale.iter().all(|s| (s - 1.0).abs() < 1e-3), "{what}: scale {scale:?}");
        assert_eq!([open, known], [truth.doors.len(); 2], "{what}: doors open and known");
        // As thick as their walls, give or take a pixel on either side.
        let pixel = self.plan.metres_per_pixel;
        let count = self.plan.classes.iter().filter(|class| **class == PlanClass::Door).count();
        let sides = truth.doors.iter().map(|d| [d[2] - d[0], d[3] - d[1]]);
        let (area, strips) = sides.fold((0.0, 0.0), |(a, s), [w, h]| (a + w * h, s + 2.0 * pixel * w.max(h)));
        let off = (count as f64 * pixel * pixel - area).abs();
        assert!(off <= strips, "{what}: the area of doors is {off:.2} m2 off, at most {strips:.2}");
        assert_eq!(self.rooms_reached(truth), truth.rooms.len(), "{what}: rooms reached");
        assert!(corners[1] < 0.005, "{what}: a corner is {:.1} mm off", corners[1] * 1e3);
    }
}
