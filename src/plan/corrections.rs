//! Puts a plan right that was read: by paint, and by doors that are opened.
//!
//! Only what differs from the reading counts. All other pixels keep their class and their lightness, and with it the
//! positions of walls within pixels.

use super::clearance::{dilate, erode};
use super::components::{Components, Neighbours};
use super::layer::Layer;
use super::paint::{IN_ENTRANCE, KEPT_CLEAN, Paint, PaintedEntrance};
use super::spaces::split;
use super::{DoorAt, DoorToOpen, FloorPlan, NARROWEST_OPENING_M, PlanClass, RegionRole, regions};
use crate::math::{Vec2, sin_cos, vec2};

/// Greatest reach from the middle of a closed door to its wall's faces, metres.
const DOOR_REACH_M: f64 = 0.5;
/// Greatest distance of a door's middle from the line that closes it, pixels.
const DOOR_OFF_PX: i32 = 2;
/// Reach of a disc into the right-angled corner beside it, in its radii.
const CORNER: f64 = 1.45;
/// Thickness of the jamb that closes a hollow wall beside a door, metres.
const JAMB_M: f64 = 0.05;
/// How far a door reaches beyond the faces of its wall, pixels.
const OVER_PX: f64 = 0.75;
/// Directions in which a door may run.
const DIRECTIONS: usize = 72;

/// How a pixel was put right.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Change {
    None,
    /// Solid or outside now.
    Closed,
    /// What stood here is gone; around it shows whether it is floor.
    Opened,
    /// Floor, whatever lies around.
    Floor,
}

/// Applies paint, then opens doors, then finds the floor again.
///
/// `white` is all that is not solid, as floor was found in it.
pub(super) fn apply(
    plan: &mut FloorPlan,
    mut white: Vec<u8>,
    layer: Option<&Layer>,
    doors: &[DoorToOpen],
    narrowest_m: f64,
    seeds: &[Vec2],
) {
    let mut changes = vec![Change::None; white.len()];
    if let Some(layer) = layer {
        paint(plan, &mut white, layer, &mut changes);
    }
    for door in doors {
        open(plan, &mut white, door, &mut changes);
    }
    if changes.iter().any(|&change| change != Change::None) {
        clear_rims(plan, &changes);
        find_floor(plan, white, &changes, narrowest_m, seeds);
    }
    name_entrances(plan);
}

/// Applies paint.
fn paint(plan: &mut FloorPlan, white: &mut [u8], layer: &Layer, changes: &mut [Change]) {
    for (at, changed) in changes.iter_mut().enumerate() {
        let Some(paint) = layer.at(at) else { continue };
        let read = plan.classes[at];
        let (class, change) = match paint {
            Paint::Class(class) if class == read || layer.shows(at, read) => continue,
            Paint::Class(class) => (class, change_to(class)),
            Paint::Entrance if read.is_solid() => (PlanClass::Door, Change::Floor),
            Paint::Erase if read != PlanClass::Floor && read != PlanClass::Outside => (read, Change::Opened),
            _ => (read, Change::None),
        };
        let mark = match paint {
            Paint::Entrance => IN_ENTRANCE,
            Paint::KeepClean => KEPT_CLEAN,
            Paint::Class(_) | Paint::Erase => 0,
        };
        if mark != 0 {
            plan.painted.marks.resize(white.len(), 0);
            plan.painted.marks[at] = mark;
        }
        set(plan, white, at, class, change);
        *changed = change;
    }
}

fn change_to(class: PlanClass) -> Change {
    match class {
        PlanClass::Floor | PlanClass::Door | PlanClass::Stairs => Change::Floor,
        PlanClass::Lettering | PlanClass::Dimension => Change::Opened,
        _ => Change::Closed,
    }
}

/// Sets a changed pixel; of erased ones the class follows once the floor is known.
fn set(plan: &mut FloorPlan, white: &mut [u8], at: usize, class: PlanClass, change: Change) {
    if change == Change::None {
        return;
    }
    let is_open = change != Change::Closed;
    white[at] = u8::from(is_open);
    plan.floor[at] &= white[at];
    plan.lightness[at] = if class.is_solid() && !is_open { 0 } else { 255 };
    let is_note = matches!(class, PlanClass::Lettering | PlanClass::Dimension);
    plan.classes[at] = if change == Change::Opened && !is_note { PlanClass::Outside } else { class };
}

/// Takes the light rim of anti-aliased strokes away that are gone: it would shift walls nearby.
fn clear_rims(plan: &mut FloorPlan, changes: &[Change]) {
    let (width, height) = (plan.width_px as usize, plan.height_px as usize);
    let around = |at: usize| {
        let (x, y) = (at % width, at / width);
        (y.saturating_sub(1)..=(y + 1).min(height - 1))
            .flat_map(move |y| (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |x| y * width + x))
    };
    let is_gone = |at: usize| matches!(changes[at], Change::Opened | Change::Floor);
    let is_rim = |plan: &FloorPlan, at: usize| {
        changes[at] == Change::None
            && plan.lightness[at] < 255
            && !plan.classes[at].is_solid()
            && around(at).any(is_gone)
            && !around(at).any(|near| plan.classes[near].is_solid())
    };
    let rims: Vec<usize> = (0..changes.len()).filter(|&at| is_rim(plan, at)).collect();
    for at in rims {
        plan.lightness[at] = 255;
    }
}

/// Finds the floor again: what was floor, what became floor, and the spaces that both open into.
fn find_floor(plan: &mut FloorPlan, mut white: Vec<u8>, changes: &[Change], narrowest_m: f64, seeds: &[Vec2]) {
    let width = plan.width_px as usize;
    let in_px = |metres: f64| metres / plan.metres_per_pixel;
    let paper = paper(plan, &white);
    for ((white, &paper), &change) in white.iter_mut().zip(&paper).zip(changes) {
        *white &= u8::from(paper == 0 || change == Change::Floor);
    }
    let spaces = split(&white, width, in_px(narrowest_m), in_px(NARROWEST_OPENING_M));
    let mut roles = vec![RegionRole::Unreached; spaces.all.len()];
    let seeds = seeds.iter().filter_map(|&seed| regions::pixel_of(plan, seed));
    let was_floor = |at: usize| white[at] != 0 && (plan.floor[at] != 0 || changes[at] == Change::Floor);
    for at in (0..white.len()).filter(|&at| was_floor(at)).chain(seeds) {
        if let Some(number) = usize::from(spaces.label[at]).checked_sub(1) {
            roles[number] = RegionRole::Floor;
        }
    }
    let changed: Vec<u8> = changes.iter().map(|&change| u8::from(change != Change::None)).collect();
    let person_px = in_px(narrowest_m).max(2.0);
    let near = dilate(&changed, width, 2.0 * person_px);
    // Near a change, hollow walls are open at their ends: too narrow for a person, they stay walls.
    let roomy = dilate(&erode(&white, width, 0.5 * person_px), width, CORNER * 0.5 * person_px);
    let is_floor = |at: usize| {
        let reached = usize::from(spaces.label[at]).checked_sub(1).is_some_and(|n| roles[n] == RegionRole::Floor);
        let was_floor = plan.floor[at] != 0 || changes[at] == Change::Floor;
        let fits = near[at] == 0 || was_floor || roomy[at] != 0;
        white[at] != 0 && ((reached && fits) || (plan.floor[at] != 0 && near[at] == 0))
    };
    let floor: Vec<u8> = (0..white.len()).map(|at| u8::from(is_floor(at))).collect();
    for (at, class) in plan.classes.iter_mut().enumerate() {
        *class = match (*class, floor[at]) {
            (PlanClass::Outside, 1) => PlanClass::Floor,
            (PlanClass::Floor | PlanClass::Door | PlanClass::Stairs, 0) => PlanClass::Outside,
            (class, _) => class,
        };
    }
    plan.floor = floor;
    plan.regions = regions::list(plan, &spaces, &roles, &mut white, Some(&paper));
}

/// The paper around the building as it was read: 1 for its pixels.
fn paper(plan: &FloorPlan, white: &[u8]) -> Vec<u8> {
    let width = plan.width_px as usize;
    let outside: Vec<u8> = white.iter().zip(&plan.floor).map(|(&white, &floor)| white & (1 - floor)).collect();
    let mut places: Vec<usize> = plan
        .regions
        .iter()
        .filter(|region| region.role == RegionRole::Outside)
        .filter_map(|region| regions::pixel_of(plan, region.inside_m))
        .collect();
    places.sort_unstable();
    let pieces = Components::of(&outside, width, 1, Neighbours::Four);
    let mut paper = vec![0; white.len()];
    for piece in &pieces.all {
        let holds = pieces.runs(piece).iter().any(|run| {
            let row = run.y as usize * width;
            let first = places.partition_point(|&at| at < row + run.from as usize);
            places.get(first).is_some_and(|&at| at < row + run.to as usize)
        });
        if holds {
            pieces.paint(piece, &mut paper, width, 1);
        }
    }
    paper
}

/// Opens a door where it is drawn closed; a gap stays as it is.
fn open(plan: &mut FloorPlan, white: &mut [u8], door: &DoorToOpen, changes: &mut [Change]) {
    let size = [plan.width_px as usize, plan.height_px as usize];
    let scale = plan.metres_per_pixel;
    let found = {
        let wall = Wall { plan, white, size, reach_px: (DOOR_REACH_M / scale).max(2.0) };
        match door.at {
            DoorAt::Point(at) => wall.at(plan.m_to_px(at.to_m(plan)).into(), 0.5 * door.width_m / scale),
            DoorAt::Line(ends) => {
                let [from, to] = ends.map(|end| Vec2::from(plan.m_to_px(end.to_m(plan))));
                wall.between(from, to)
            }
        }
    };
    let Some(Gap { middle, along, half_width, half_depth }) = found else { return };
    let across = along.left();
    let jamb = (JAMB_M / scale).max(1.5);
    let reach = half_width + half_depth + jamb + 1.0;
    let span = |middle: f64, most: usize| {
        let [low, high] = [middle - reach, middle + reach + 1.0].map(|v| v.clamp(0.0, most as f64) as usize);
        low..high
    };
    for y in span(middle.y, size[1]) {
        for x in span(middle.x, size[0]) {
            let off = vec2(x as f64 + 0.5, y as f64 + 0.5) - middle;
            let (sideways, through, at) = (off.dot(along).abs(), off.dot(across).abs(), y * size[0] + x);
            if plan.floor[at] != 0 || sideways > half_width + jamb || through > half_depth {
                continue;
            }
            let is_hollow = white[at] != 0 && through < half_depth - OVER_PX;
            if sideways <= half_width {
                set(plan, white, at, PlanClass::Door, Change::Floor);
                changes[at] = Change::Floor;
            } else if is_hollow {
                set(plan, white, at, PlanClass::Wall, Change::Closed);
                changes[at] = Change::Closed;
            }
        }
    }
}

/// A stretch of wall that becomes a door, pixels from the top left.
struct Gap {
    middle: Vec2,
    along: Vec2,
    half_width: f64,
    half_depth: f64,
}

/// What closes a door.
struct Wall<'a> {
    plan: &'a FloorPlan,
    white: &'a [u8],
    size: [usize; 2],
    reach_px: f64,
}

impl Wall<'_> {
    fn pixel(&self, p: Vec2) -> Option<usize> {
        let within = p.x >= 0.0 && p.y >= 0.0 && p.x < self.size[0] as f64 && p.y < self.size[1] as f64;
        within.then(|| p.y as usize * self.size[0] + p.x as usize)
    }

    fn is_solid(&self, p: Vec2) -> bool {
        self.pixel(p).is_some_and(|at| self.white[at] == 0 && self.plan.classes[at].is_solid())
    }

    /// The closed door around a point, or nothing where the point lies in a gap.
    fn at(&self, point: Vec2, half_width: f64) -> Option<Gap> {
        let start = self.nearest_solid(point)?;
        let steps = half_width.ceil().max(1.0) as i32;
        // Along the wall most is solid; across it, of equals, least.
        let (.., along) = (0..DIRECTIONS)
            .map(|k| {
                let (sine, cosine) = sin_cos(std::f64::consts::PI * k as f64 / DIRECTIONS as f64);
                let along = vec2(cosine, sine);
                let solid = (-steps..=steps).filter(|&step| self.is_solid(start + along * f64::from(step))).count();
                let [one, other] = [along.left(), -along.left()].map(|across| self.depth(start, across));
                (solid, (one + other) as i64, along)
            })
            .min_by_key(|&(solid, depth, _)| (std::cmp::Reverse(solid), depth))?;
        self.between(start - along * half_width, start + along * half_width)
    }

    /// The closed door between two jambs, or nothing where no wall stands between them.
    fn between(&self, from: Vec2, to: Vec2) -> Option<Gap> {
        let along = (to - from).normalized()?;
        let half_width = 0.5 * from.distance(to);
        let places = (1..10).map(|k| from.lerp(to, f64::from(k) * 0.1));
        let across = along.left();
        let mut depths = [0.0f64; 2];
        for place in places {
            depths[0] = depths[0].max(self.depth(place, across));
            depths[1] = depths[1].max(self.depth(place, -across));
        }
        let depth = depths[0] + depths[1];
        let middle = from.lerp(to, 0.5) + across * (0.5 * (depths[0] - depths[1]));
        (depth > 0.0).then_some(Gap { middle, along, half_width, half_depth: 0.5 * depth + OVER_PX })
    }

    /// How far solid reaches from a place in a direction, up to floor: a hollow wall has two faces.
    fn depth(&self, place: Vec2, direction: Vec2) -> f64 {
        let mut deepest = 0.0;
        for step in 0..=(2.0 * self.reach_px) as usize {
            let way = 0.5 * step as f64;
            let here = place + direction * way;
            if self.is_solid(here) {
                deepest = way.max(0.5);
            } else if self.pixel(here).is_none_or(|at| self.plan.floor[at] != 0) && way > f64::from(DOOR_OFF_PX) {
                break;
            }
        }
        deepest
    }

    fn nearest_solid(&self, point: Vec2) -> Option<Vec2> {
        let mut steps: Vec<[i32; 2]> =
            (-DOOR_OFF_PX..=DOOR_OFF_PX).flat_map(|y| (-DOOR_OFF_PX..=DOOR_OFF_PX).map(move |x| [x, y])).collect();
        steps.sort_by_key(|[x, y]| x * x + y * y);
        steps.into_iter().map(|[x, y]| point + vec2(f64::from(x), f64::from(y))).find(|&p| self.is_solid(p))
    }
}

/// Lists the entrances.
fn name_entrances(plan: &mut FloorPlan) {
    let pieces = Components::of(&plan.painted.marks, plan.width_px as usize, IN_ENTRANCE, Neighbours::Eight);
    let has_floor = |runs: &[super::components::Run]| {
        runs.iter().any(|run| {
            let row = run.y as usize * plan.width_px as usize;
            plan.floor[row + run.from as usize..row + run.to as usize].contains(&1)
        })
    };
    let (good, bad): (Vec<_>, Vec<_>) = pieces.all.iter().partition(|piece| has_floor(pieces.runs(piece)));
    let area_m = |[left, top]: [u32; 2], [right, bottom]: [u32; 2]| {
        [[left, bottom], [right, top]].map(|corner| plan.px_to_m(corner.map(f64::from)))
    };
    let many = good.len() > 1;
    let named = good.iter().enumerate().map(|(number, piece)| PaintedEntrance {
        name: if many { format!("entrance {}", number + 1) } else { "entrance".to_string() },
        area_m: area_m(piece.min, piece.end),
    });
    let named = named.collect();
    let off = bad.iter().map(|piece| {
        let [x, y] = piece.min;
        format!("the entrance painted at pixel [{x}, {y}] touches no floor: nobody comes or goes there")
    });
    let off: Vec<String> = off.collect();
    plan.painted.entrances = named;
    plan.warnings.extend(off);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{PlanOptions, PlanPoint, read};

    /// Two rooms that a wall of 0.2 m (or two lines of a pixel) parts, with openings at both ends.
    fn plan(name: &str, hollow: bool, at: DoorAt) -> (FloorPlan, FloorPlan) {
        let image = image::GrayImage::from_fn(160, 80, |x, y| {
            let wall = (78..82).contains(&x) && (!hollow || x == 78 || x == 81);
            image::Luma([if wall || !(4..76).contains(&y) { 0 } else { 255 }])
        });
        let file = std::env::temp_dir().join(format!("trodden-door-{}-{name}.png", std::process::id()));
        image.save(&file).unwrap();
        let closed = PlanOptions {
            metres_per_pixel: Some(0.05),
            floor: vec![PlanPoint::Metres([1.0, 2.0]), PlanPoint::Metres([7.0, 2.0])],
            ..PlanOptions::default()
        };
        let open = PlanOptions { doors: vec![DoorToOpen { at, width_m: 1.0 }], ..closed.clone() };
        let plans = (read(&file, &closed).unwrap(), read(&file, &open).unwrap());
        std::fs::remove_file(&file).unwrap();
        plans
    }

    #[test]
    fn a_closed_door_opens_through_its_wall_and_nothing_else_changes() {
        let middle = DoorAt::Point(PlanPoint::Metres([4.0, 2.0]));
        let jambs = DoorAt::Line([PlanPoint::Pixels { px: [80.0, 30.0] }, PlanPoint::Pixels { px: [80.0, 50.0] }]);
        for (name, hollow, at) in [("middle", false, middle), ("jambs", false, jambs), ("hollow", true, jambs)] {
            let (closed, open) = plan(name, hollow, at);
            let is_door = |at: usize| (78..82).contains(&(at % 160)) && (30..50).contains(&(at / 160));
            for at in 0..closed.floor.len() {
                let expected = if is_door(at) { 1 } else { closed.floor[at] };
                assert_eq!(open.floor[at], expected, "{name}: pixel [{}, {}]", at % 160, at / 160);
                assert_eq!(open.classes[at] == PlanClass::Door, is_door(at), "{name}");
            }
        }
    }

    #[test]
    fn a_door_in_a_gap_changes_nothing() {
        let (closed, open) = plan("gap", false, DoorAt::Point(PlanPoint::Metres([2.0, 2.0])));
        assert!(closed.floor == open.floor && closed.classes == open.classes);
    }
}
