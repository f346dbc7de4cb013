use image::RgbImage;

use super::canvas::{PlanCanvas, text_width};
use super::style::{PAPER, PLAIN_FLOOR, ROUTES, TEXT, speed_colour};
use crate::math::srgb::Srgb8;
use crate::math::{Vec2, vec2};
use crate::units::{Areas, Unit};

/// Pixels per metre.
const PX_PER_M: f64 = 70.0;
/// Room beside the areas, metres.
const BESIDE_M: f64 = 1.5;
/// Marks along ways come this often, seconds.
const TICK_S: f64 = 1.0;
/// Ways are drawn in pieces of this length, seconds.
const PIECE_S: f64 = 0.1;
const AREA: Srgb8 = [150, 156, 164];
const VIEWER: Srgb8 = [20, 60, 140];

/// Draws a unit from above: the viewer, who looks up, the areas, and everybody's way, coloured by speed, with a mark at
/// every second that points where the body faces. Dots of one colour belong together; numbers are seconds.
pub fn draw_unit(unit: &Unit, areas: &Areas) -> RgbImage {
    let [front, behind] =
        unit.composition().map(|sizes| sizes.iter().map(usize::to_string).collect::<Vec<_>>().join(", "));
    let none = |sizes: String| if sizes.is_empty() { "none".to_string() } else { sizes };
    let facts = format!("{} s; groups in front: {}; behind: {}", unit.duration_s, none(front), none(behind));
    let written_m = text_width(&unit.name).max(text_width(&facts)) as f64 / PX_PER_M;
    let half_m = (0.5 * unit.area_m[0].max(areas.front_m[0]) + BESIDE_M).max(0.5 * written_m);
    let (behind_m, ahead_m) = (areas.rear_m[1] + 0.8, unit.area_m[1].max(areas.front_m[1]) + 0.8);
    let size = vec2(2.0 * half_m, behind_m + ahead_m);
    let mut canvas = PlanCanvas::new(size, PX_PER_M * size.x.max(size.y), [16, 76], PAPER);
    let on = |p: Vec2| p + vec2(half_m, behind_m);
    let [left, top] = canvas.corner.map(|c| c as i64);
    let [width, height] = canvas.plan_px.map(|c| c as i64);
    canvas.fill([left, top], [width, height], PLAIN_FLOOR);
    let mut frame = |[width_m, depth_m]: [f64; 2], sign: f64, strong: f64| {
        let x = 0.5 * width_m;
        let corners = [vec2(-x, 0.0), vec2(x, 0.0), vec2(x, sign * depth_m), vec2(-x, sign * depth_m)];
        for k in 0..4 {
            canvas.line_m(on(corners[k]), on(corners[(k + 1) % 4]), strong, AREA, 1.0);
        }
    };
    frame(unit.area_m, 1.0, 2.5);
    frame(areas.front_m, 1.0, 1.0);
    frame(areas.rear_m, -1.0, 1.0);
    draw_viewer(&mut canvas, unit, on);
    let inside = |p: Vec2| p.x >= 0.2 && p.y >= 0.2 && p.x <= size.x - 0.2 && p.y <= size.y - 0.2;
    for member in 0..unit.members.len() {
        draw_way(&mut canvas, unit, member, &|p| Some(on(p)).filter(|p| inside(*p)));
    }
    let bottom = top + height + 10;
    canvas.text([left, bottom], &unit.name, TEXT, None);
    canvas.text([left, bottom + 28], &facts, TEXT, None);
    canvas.picture
}

fn draw_viewer(canvas: &mut PlanCanvas, unit: &Unit, on: impl Fn(Vec2) -> Vec2) {
    let at = |time_s: f64| on(unit.viewer.at(time_s).place_m);
    let pieces = (unit.duration_s / PIECE_S) as usize;
    if unit.viewer.samples().len() > 1 {
        for k in 0..pieces {
            canvas.line_m(at(k as f64 * PIECE_S), at((k + 1) as f64 * PIECE_S), 3.0, VIEWER, 0.6);
        }
    }
    let here = canvas.px(at(0.0));
    canvas.ellipse(here, vec2(1.0, 0.0), [0.25 * PX_PER_M, 0.14 * PX_PER_M], VIEWER);
    canvas.arrow_m(at(0.0), at(0.0) + vec2(0.0, 0.5), VIEWER);
}

/// One member's way as far as it lies on the picture.
fn draw_way(canvas: &mut PlanCanvas, unit: &Unit, member: usize, on: &dyn Fn(Vec2) -> Option<Vec2>) {
    let colour = ROUTES[unit.members[member].group as usize % ROUTES.len()];
    let moment = |time_s: f64| unit.moment(member, time_s, false);
    for k in 0..(unit.duration_s / PIECE_S).round() as usize {
        let (a, b) = (moment(k as f64 * PIECE_S), moment((k + 1) as f64 * PIECE_S));
        if let (Some(from), Some(to)) = (on(a.place_m), on(b.place_m)) {
            canvas.line_m(from, to, 4.0, speed_colour(a.velocity_m_s.length()), 1.0);
        }
    }
    for second in 0..=(unit.duration_s / TICK_S) as usize {
        let now = moment(second as f64 * TICK_S);
        let Some(place) = on(now.place_m) else { continue };
        let px = canvas.px(place);
        let (size, facing) = (if second == 0 { 9.0 } else { 5.0 }, vec2(now.heading.x, -now.heading.y));
        canvas.line(px, px + facing * 18.0, 2.0, colour, 1.0);
        canvas.ellipse(px, facing, [size * 0.6, size], colour);
        if second > 0 && second % 2 == 0 {
            canvas.label(px + vec2(16.0, -10.0), &second.to_string(), colour, PAPER);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::UnitLibrary;

    #[test]
    fn a_unit_is_drawn_with_its_ways() {
        let library = UnitLibrary::built_in().unwrap();
        let unit = &library.units[0];
        let picture = draw_unit(unit, &Areas::default());
        let ink = |picture: &RgbImage| picture.pixels().filter(|p| p.0 != PAPER && p.0 != PLAIN_FLOOR).count();
        let mut still = unit.clone();
        still.members.truncate(1);
        still.duration_s = 1.0;
        assert!(ink(&picture) > ink(&draw_unit(&still, &Areas::default())));
        assert!(picture.width() > 400 && picture.height() > picture.width());
    }
}
