//! Marks the places where people got stuck.

use super::canvas::{LINE_PX, PlanCanvas};
use super::style::{PAPER, SPEED_SCALE_PX, STUCK, TEXT, legend};
use crate::crowd::Stuck;
use crate::math::{Vec2, vec2};
use crate::routes::Route;

/// How many stuck people have a number and a line in the legend.
const NUMBERED: usize = 3;

/// A red cross, big enough to be found.
pub(in crate::show) fn draw_cross(canvas: &mut PlanCanvas, place: Vec2, size_px: f64) {
    for (grow, colour) in [(2.0, PAPER), (0.0, STUCK)] {
        for arm in [vec2(size_px, size_px), vec2(size_px, -size_px)] {
            let reach = arm * (1.0 + grow * 0.7 / size_px);
            canvas.line(place - reach, place + reach, 4.0 + grow, colour, 1.0);
        }
    }
}

/// A cross for everybody who got stuck; a number for some, whom the legend names. Of people who got stuck beside each
/// other, one has the number.
pub(in crate::show) fn draw_stuck(canvas: &mut PlanCanvas, routes: &[Route], stuck: &[Stuck]) {
    const APART_PX: f64 = 40.0;
    let mut numbered: Vec<&Stuck> = Vec::new();
    for person in stuck {
        let at = canvas.px(person.place_m);
        draw_cross(canvas, at, 9.0);
        let alone = numbered.iter().all(|other| canvas.px(other.place_m).distance(at) > APART_PX);
        if alone && numbered.len() < NUMBERED {
            numbered.push(person);
        }
    }
    let ([_, top], left) = (legend(canvas), canvas.corner[0] as i64 + SPEED_SCALE_PX + 60);
    if !stuck.is_empty() {
        let text = format!("{} got stuck", stuck.len());
        draw_cross(canvas, vec2(left as f64 + 8.0, top as f64 + 3.0), 7.0);
        canvas.text([left + 26, top - 4], &text, STUCK, None);
    }
    for (n, person) in (1..).zip(&numbered) {
        let at = canvas.px(person.place_m);
        canvas.label(at + vec2(22.0, -14.0), &n.to_string(), STUCK, PAPER);
        let route = routes.get(person.route).map_or("", |route| &route.name);
        let Vec2 { x, y } = person.place_m;
        let text = format!("{n}  person {} at ({x:.1}, {y:.1})  {route}", person.id);
        canvas.text([left + 26, top - 4 + LINE_PX * n], &text, TEXT, None);
    }
}
