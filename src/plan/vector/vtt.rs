//! Universal VTT maps (`.uvtt`, `.dd2vtt`, `.df2vtt`): walls that block sight, portals, a grid of squares.

use serde_json::Value;

use super::json::{list, number, place};
use super::piece::{Piece, TOO_MANY, TooMany, Unit, VectorPlan};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::PlanClass;

/// Side of a square, metres: five feet, as tables of games round them.
const SQUARE_M: f64 = 1.5;

/// Reads a map. Its unit is a square of the grid; y is up.
pub(super) fn read(text: &str) -> Result<VectorPlan, String> {
    let map: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let resolution = map.get("resolution").ok_or("it has no `resolution`")?;
    let size = resolution.get("map_size").and_then(place).ok_or("it has no `resolution.map_size`")?;
    if !(size.x > 0.0 && size.y > 0.0) {
        return Err(format!("its map_size is {} x {}", size.x, size.y));
    }
    let origin = resolution.get("map_origin").and_then(place).unwrap_or(Vec2::ZERO);
    // Rows go down from the map's origin.
    let up = |p: Vec2| vec2(p.x - origin.x, size.y - (p.y - origin.y));
    let mut plan = VectorPlan::of(Unit::Sure(SQUARE_M), &Default::default());
    plan.units_per_pixel = number(resolution, "pixels_per_grid").filter(|n| *n > 0.0).map_or(1.0, |n| 1.0 / n);
    plan.bounds = Some(Rect { min: Vec2::ZERO, max: size });
    plan.warnings.push(format!("a square of the map was taken for {SQUARE_M} m"));
    let add = |plan: &mut VectorPlan, line: &Value, class: PlanClass| -> Result<(), TooMany> {
        let mut points: Vec<Vec2> = line.as_array().into_iter().flatten().filter_map(place).map(up).collect();
        let closed = points.len() > 3 && points[0].distance(points[points.len() - 1]) < 1e-3;
        if closed {
            points.pop();
        }
        plan.add(Piece::line(points, closed).of(Some(class)))
    };
    for line in list(&map, "line_of_sight") {
        add(&mut plan, line, PlanClass::Wall).map_err(|TooMany| TOO_MANY)?;
    }
    for line in list(&map, "objects_line_of_sight") {
        add(&mut plan, line, PlanClass::Shelf).map_err(|TooMany| TOO_MANY)?;
    }
    for portal in list(&map, "portals") {
        add(&mut plan, portal.get("bounds").unwrap_or(&Value::Null), PlanClass::Door).map_err(|TooMany| TOO_MANY)?;
    }
    plan.leave_out("light|lights", list(&map, "lights").len());
    plan.leave_out("picture|pictures", usize::from(map.get("image").is_some_and(|image| image.as_str() != Some(""))));
    if !plan.pieces.iter().any(|piece| piece.class == Some(PlanClass::Wall)) {
        return Err("it has no walls: its `line_of_sight` is empty".to_owned());
    }
    Ok(plan)
}
