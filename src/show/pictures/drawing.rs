use std::collections::BTreeSet;

use image::RgbImage;

use super::canvas::{LINE_PX, PlanCanvas, text_width};
use super::paths::Path;
use super::stuck::draw_stuck;
use super::style::{
    FASTEST_M_S, PAPER, PLAIN_FLOOR, ROUTES, SOLID, SPEED_SCALE_PX, TEXT, legend, scale_bar, speed_colour,
};
use crate::crowd::Stuck;
use crate::math::srgb::Srgb8;
use crate::math::{Vec2, vec2};
use crate::plan::{FloorPlan, PlanClass, RegionRole};
use crate::routes::{Place, Route};
use crate::walls::Walls;

/// Longer side of the drawn plan, pixels.
const LONGEST_PX: f64 = 1800.0;
/// Room for the names of openings beside the plan.
const MARGIN: usize = 110;
/// Room below the plan for the legend.
const LEGEND: usize = 120;

const FLOOR: Srgb8 = [226, 234, 240];
const OPEN_FACE: Srgb8 = [20, 60, 140];
const CLOSED_FACE: Srgb8 = [150, 60, 20];
const OPENING: Srgb8 = [0, 140, 70];
const GATE: Srgb8 = [140, 60, 160];
const UNREACHED: Srgb8 = [214, 130, 0];

/// Draws a plan as it was read: floor, walls, openings and routes.
///
/// Doors, windows, furniture and notes have the colours of their classes, which the legend names. Unreached regions are hatched; walls are blue from side to side of the image, brown if closed; openings have their
/// names, routes their gates.
pub fn draw_plan(plan: &FloorPlan, walls: &Walls, routes: &[Route]) -> RgbImage {
    let mut canvas = sheet(plan);
    draw_ground(&mut canvas, plan, walls, FLOOR);
    let classes = draw_classes(&mut canvas, plan);
    hatch_unreached(&mut canvas, plan);
    draw_walls(&mut canvas, walls, true);
    for (n, route) in routes.iter().enumerate() {
        draw_route(&mut canvas, plan, route, ROUTES[n % ROUTES.len()]);
    }
    draw_openings(&mut canvas, plan);
    let [left, top] = legend(&canvas);
    let size = format!("{:.1} x {:.1} m, {} walls", plan.width_m(), plan.height_m(), walls.faces.len());
    canvas.text([left, top], &size, TEXT, None);
    let mut at = left + text_width(&size) + 40;
    for class in classes {
        let name = format!("{class:?}").to_lowercase();
        canvas.fill([at, top], [LINE_PX - 10, LINE_PX - 10], class.colour());
        canvas.text([at + LINE_PX, top], &name, TEXT, None);
        at += LINE_PX + text_width(&name) + 30;
    }
    for (n, route) in routes.iter().enumerate().take(4) {
        let at = [left + (n as i64 % 2) * 620, top + LINE_PX * (1 + n as i64 / 2)];
        canvas.text(at, &route.name, ROUTES[n % ROUTES.len()], None);
    }
    draw_scale_bar(&mut canvas);
    canvas.picture
}

/// Draws plan, walls, openings, gates and the paths of people, coloured by speed. People who got stuck are marked with a
/// red cross and a number; the legend says who they are.
pub fn draw_paths(plan: &FloorPlan, walls: &Walls, routes: &[Route], paths: &[Path], stuck: &[Stuck]) -> RgbImage {
    let mut canvas = sheet(plan);
    draw_ground(&mut canvas, plan, walls, PLAIN_FLOOR);
    for pair in paths.iter().flat_map(|path| path.samples.windows(2)) {
        let speed = 0.5 * (pair[0].speed_m_s + pair[1].speed_m_s);
        canvas.line_m(pair[0].position_m, pair[1].position_m, 1.3, speed_colour(speed), 0.7);
    }
    draw_walls(&mut canvas, walls, false);
    routes.iter().for_each(|route| draw_gates(&mut canvas, route));
    draw_openings(&mut canvas, plan);
    draw_stuck(&mut canvas, routes, stuck);
    draw_speed_scale(&mut canvas);
    draw_scale_bar(&mut canvas);
    canvas.picture
}

/// Paper for a plan with its legend.
fn sheet(plan: &FloorPlan) -> PlanCanvas {
    PlanCanvas::new(vec2(plan.width_m(), plan.height_m()), LONGEST_PX, [MARGIN, LEGEND], PAPER)
}

/// The plan's image in greys, its floor in a colour.
pub(in crate::show) fn draw_ground(canvas: &mut PlanCanvas, plan: &FloorPlan, walls: &Walls, floor: Srgb8) {
    let ([left, top], [width, height]) = (canvas.corner, canvas.plan_px);
    let mut share = vec![0.0f32; width];
    for y in 0..height {
        let row = (height - 1 - y) as i64;
        walls.coverage(canvas.pixels_per_metre, 0, row, width, 1, &mut share);
        for (x, &share) in share.iter().enumerate() {
            let middle = vec2(x as f64 + 0.5, row as f64 + 0.5) / canvas.pixels_per_metre;
            let (x, y) = ((left + x) as i64, (top + y) as i64);
            if let Some(lightness) = lightness(plan, middle) {
                canvas.blend(x, y, SOLID, 1.0 - f64::from(lightness) / 255.0);
            }
            canvas.blend(x, y, floor, f64::from(share));
        }
    }
}

/// Paints what is neither floor nor wall in the colours of its class. Returns the classes that there are.
fn draw_classes(canvas: &mut PlanCanvas, plan: &FloorPlan) -> BTreeSet<PlanClass> {
    let ([left, top], [width, height]) = (canvas.corner, canvas.plan_px);
    let mut found = BTreeSet::new();
    for at in 0..width * height {
        let (x, y) = (at % width, at / width);
        let middle = vec2(x as f64 + 0.5, (height - 1 - y) as f64 + 0.5) / canvas.pixels_per_metre;
        let class = pixel(plan, middle).and_then(|at| plan.classes.get(at)).copied().unwrap_or_default();
        if !matches!(class, PlanClass::Floor | PlanClass::Wall | PlanClass::Outside) {
            canvas.blend((left + x) as i64, (top + y) as i64, class.colour(), 0.85);
            found.insert(class);
        }
    }
    found
}

/// Index of the plan's pixel under a point.
fn pixel(plan: &FloorPlan, p: Vec2) -> Option<usize> {
    let [x, y] = plan.m_to_px(p);
    let inside = x >= 0.0 && y >= 0.0 && x < f64::from(plan.width_px) && y < f64::from(plan.height_px);
    inside.then(|| y as usize * plan.width_px as usize + x as usize)
}

fn lightness(plan: &FloorPlan, p: Vec2) -> Option<u8> {
    plan.lightness.get(pixel(plan, p)?).copied()
}

/// Oblique lines over the white regions that were taken for unreachable.
fn hatch_unreached(canvas: &mut PlanCanvas, plan: &FloorPlan) {
    let hatched = unreached(plan);
    let ([left, top], [width, height]) = (canvas.corner, canvas.plan_px);
    for y in 0..height {
        for x in 0..width {
            let middle = vec2(x as f64 + 0.5, (height - 1 - y) as f64 + 0.5) / canvas.pixels_per_metre;
            if pixel(plan, middle).is_some_and(|index| hatched[index]) {
                let share = if (x + y) % 12 < 2 { 0.45 } else { 0.06 };
                canvas.blend((left + x) as i64, (top + y) as i64, UNREACHED, share);
            }
        }
    }
}

/// Pixels of the white regions that were taken for unreachable.
fn unreached(plan: &FloorPlan) -> Vec<bool> {
    let (width, height) = (plan.width_px as usize, plan.height_px as usize);
    let white = |index: usize| plan.lightness[index] >= plan.threshold && plan.floor[index] == 0;
    let mut found = vec![false; width * height];
    let seeds = plan.regions.iter().filter(|region| region.role == RegionRole::Unreached);
    for seed in seeds.filter_map(|region| pixel(plan, region.inside_m)) {
        let mut open = vec![seed];
        while let Some(index) = open.pop() {
            if found[index] || !white(index) {
                continue;
            }
            found[index] = true;
            let (x, y) = (index % width, index / width);
            open.extend((x > 0).then(|| index - 1));
            open.extend((x + 1 < width).then(|| index + 1));
            open.extend((y > 0).then(|| index - width));
            open.extend((y + 1 < height).then(|| index + width));
        }
    }
    found
}

pub(in crate::show) fn draw_walls(canvas: &mut PlanCanvas, walls: &Walls, coloured: bool) {
    for face in &walls.faces {
        let colour = match (coloured, face.closed) {
            (false, _) => SOLID,
            (true, false) => OPEN_FACE,
            (true, true) => CLOSED_FACE,
        };
        for pair in face.points_m.windows(2) {
            canvas.line_m(pair[0], pair[1], 2.0, colour, 1.0);
        }
        if let (true, Some(&first), Some(&last)) = (face.closed, face.points_m.first(), face.points_m.last()) {
            canvas.line_m(last, first, 2.0, colour, 1.0);
        }
    }
}

fn draw_openings(canvas: &mut PlanCanvas, plan: &FloorPlan) {
    for opening in &plan.openings {
        canvas.line_m(opening.from_m, opening.to_m, 6.0, OPENING, 1.0);
        let outward = opening.side.outward();
        let beside = text_width(&opening.name) as f64 * 0.5 + 12.0;
        let at = canvas.px(opening.centre_m()) + vec2(outward.x * beside, -outward.y * 22.0);
        canvas.label(at, &opening.name, OPENING, PAPER);
    }
}

/// A dashed line through the middles of the gates, with an arrow at its end, and the gates themselves.
fn draw_route(canvas: &mut PlanCanvas, plan: &FloorPlan, route: &Route, colour: Srgb8) {
    let place = |place: &Place| match *place {
        Place::Opening(index) => plan.openings.get(index).map(|opening| opening.centre_m()),
        Place::Area([min, max]) => Some((min + max) * 0.5),
    };
    let mut way: Vec<Vec2> = place(&route.start).into_iter().collect();
    way.extend(route.gates.iter().map(|gate| gate.left_m.lerp(gate.right_m, 0.5)));
    way.extend(place(&route.goal));
    let mut phase = 0.0;
    for pair in way.windows(2) {
        phase = canvas.dashed_m([pair[0], pair[1]], 2.0, colour, phase);
    }
    if let [.., before, end] = way[..] {
        canvas.arrow_m(before, end, colour);
    }
    draw_gates(canvas, route);
}

fn draw_gates(canvas: &mut PlanCanvas, route: &Route) {
    for gate in &route.gates {
        canvas.line_m(gate.left_m, gate.right_m, 1.2, GATE, 0.55);
    }
}

fn draw_speed_scale(canvas: &mut PlanCanvas) {
    let [left, top] = legend(canvas);
    for x in 0..SPEED_SCALE_PX {
        let speed = FASTEST_M_S * x as f64 / SPEED_SCALE_PX as f64;
        canvas.fill([left + x, top], [1, 16], speed_colour(speed));
    }
    for (tick, label) in [(0.0, "0"), (0.5, "0.5"), (1.0, "1"), (1.5, "1.5"), (2.0, "2 m/s")] {
        let x = left + (tick / FASTEST_M_S * SPEED_SCALE_PX as f64) as i64;
        canvas.fill([x, top], [2, 22], TEXT);
        canvas.text([x - 5, top + 28], label, TEXT, None);
    }
}

/// A bar of a round number of metres, about 200 px long, at the legend's right end.
fn draw_scale_bar(canvas: &mut PlanCanvas) {
    let [_, top] = legend(canvas);
    let right = (canvas.corner[0] + canvas.plan_px[0]) as i64;
    scale_bar(canvas, [right, top], 260.0);
}

#[cfg(test)]
mod tests {
    use super::super::paths::PathSample;
    use super::super::style::STUCK;
    use super::*;
    use crate::plan::{PlanOptions, read};
    use crate::routes::Gate;
    use crate::walls::WallsOptions;

    /// A plan of 12 x 6 m: a corridor from west to east, a closed room above it.
    fn plan() -> FloorPlan {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("plan.png");
        let image = image::GrayImage::from_fn(120, 60, |x, y| {
            let corridor = (20..50).contains(&y);
            let room = (5..15).contains(&y) && (5..60).contains(&x);
            image::Luma([if corridor || room { 255 } else { 0 }])
        });
        image.save(&path).unwrap();
        read(&path, &PlanOptions { metres_per_pixel: Some(0.1), ..PlanOptions::default() }).unwrap()
    }

    fn at(picture: &RgbImage, p: Vec2) -> Srgb8 {
        let scale = f64::from(picture.width() - 2 * MARGIN as u32) / 12.0;
        let y = MARGIN as f64 + (6.0 - p.y) * scale;
        picture.get_pixel((MARGIN as f64 + p.x * scale) as u32, y as u32).0
    }

    #[test]
    fn floor_walls_and_what_nobody_reaches_are_told_apart() {
        let plan = plan();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let picture = draw_plan(&plan, &walls, &[]);
        assert_eq!(at(&picture, vec2(6.0, 2.0)), FLOOR);
        assert_eq!(at(&picture, vec2(6.0, 0.5)), SOLID);
        assert_eq!(at(&picture, vec2(6.0, 4.0)), OPEN_FACE);
        assert_eq!(at(&picture, vec2(0.0, 2.0)), OPENING);
        let room = at(&picture, vec2(3.0, 5.0));
        assert!(room != FLOOR && room != SOLID && room != PAPER, "{room:?}");
    }

    #[test]
    fn ways_are_coloured_by_speed() {
        let plan = plan();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let way = |y: f64, speed_m_s: f64| Path {
            id: 0,
            samples: [1.0, 5.0, 11.0].map(|x| PathSample { position_m: vec2(x, y), speed_m_s }).to_vec(),
        };
        let picture = draw_paths(&plan, &walls, &[], &[way(1.5, 0.0), way(2.5, 9.0)], &[]);
        let (slow, fast) = (at(&picture, vec2(3.0, 1.5)), at(&picture, vec2(8.0, 2.5)));
        assert!(slow[2] > slow[1] && fast[1] > fast[2], "{slow:?} {fast:?}");
    }

    #[test]
    fn whoever_got_stuck_is_crossed_and_named() {
        let plan = plan();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let stuck = |id, x| Stuck { id, place_m: vec2(x, 2.0), route: 0, stop: None };
        let clean = draw_paths(&plan, &walls, &[], &[], &[]);
        let picture = draw_paths(&plan, &walls, &[], &[], &[stuck(17, 3.0), stuck(18, 3.1), stuck(19, 9.0)]);
        for x in [3.0, 3.1, 9.0] {
            assert_eq!(at(&picture, vec2(x, 2.0)), STUCK);
        }
        let legend = |picture: &RgbImage| {
            let below = picture.height() - LEGEND as u32 + 20;
            picture.enumerate_pixels().filter(|(_, y, p)| *y > below && p.0 != PAPER).count()
        };
        assert!(legend(&picture) > legend(&clean) + 500);
        // Very many, and places that are none.
        let many: Vec<Stuck> = (0..500).map(|id| stuck(id, f64::from(id) * 0.5 - 3.0)).collect();
        draw_paths(&plan, &walls, &[], &[], &many);
        draw_paths(&plan, &walls, &[], &[], &[stuck(1, f64::NAN)]);
    }

    #[test]
    fn routes_beyond_the_plan_and_without_gates_are_drawn() {
        let plan = plan();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let gate = Gate { left_m: vec2(-1e6, 2.0), right_m: vec2(f64::NAN, 2.0) };
        let route = |gates: Vec<Gate>| Route {
            name: "to \u{1f980}".to_string(),
            start: Place::Opening(99),
            via: Vec::new(),
            stops: Vec::new(),
            arrivals: None,
            life: None,
            goal: Place::Opening(0),
            share: 1.0,
            gates,
            length_m: 1.0,
        };
        draw_plan(&plan, &walls, &[route(Vec::new()), route(vec![gate])]);
    }
}
