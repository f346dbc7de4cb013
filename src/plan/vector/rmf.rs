//! Buildings of Open-RMF (`*.building.yaml`): walls, doors, lanes, and a scale from measurements.

use serde_json::Value;

use super::json::list;
use super::piece::{Piece, TOO_MANY, TooMany, Unit, VectorPlan};
use crate::math::{Vec2, vec2};
use crate::plan::PlanClass;

/// Reads a level of a building, counted from 1 in the order of their names.
pub(super) fn read(text: &str, level: Option<u32>) -> Result<VectorPlan, String> {
    let building: Value = serde_saphyr::from_str(text).map_err(|error| error.without_snippet().to_string())?;
    let levels = building.get("levels").and_then(Value::as_object).ok_or("it has no `levels`")?;
    let wanted = level.unwrap_or(1) as usize;
    let chosen = wanted.checked_sub(1).and_then(|at| levels.iter().nth(at));
    let (name, chosen) = chosen.ok_or_else(|| format!("level {wanted} was asked for; it has {}", levels.len()))?;
    let system = building.get("coordinate_system").and_then(Value::as_str).unwrap_or("reference_image");
    let mut plan = VectorPlan::default();
    let y_up = match system {
        "reference_image" => -1.0,
        "cartesian_meters" => 1.0,
        other => return Err(format!("its coordinate_system is {other}, not reference_image or cartesian_meters")),
    };
    let vertices = |level: &Value| -> Vec<Option<Vec2>> {
        let vertex = |v: &Value| Some(vec2(v.get(0)?.as_f64()?, y_up * v.get(1)?.as_f64()?));
        list(level, "vertices").iter().map(vertex).collect()
    };
    let here = vertices(chosen);
    let both = |vertices: &[Option<Vec2>], pair: &Value| -> Option<[Vec2; 2]> {
        let at = |k: usize| vertices.get(usize::try_from(pair.get(k)?.as_u64()?).ok()?).copied().flatten();
        Some([at(0)?, at(1)?])
    };
    let scale = |level: &Value, vertices: &[Option<Vec2>]| -> Option<f64> {
        let measured = list(level, "measurements").iter().filter_map(|pair| {
            let [a, b] = both(vertices, pair)?;
            let distance = pair.get(2)?.get("distance")?.get(1)?.as_f64()?;
            Some(distance / a.distance(b)).filter(|scale| scale.is_finite() && *scale > 0.0)
        });
        let all: Vec<f64> = measured.collect();
        (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    };
    plan.unit = match scale(chosen, &here) {
        _ if y_up > 0.0 => Unit::Sure(1.0),
        Some(scale) => Unit::Sure(scale),
        // Levels are drawn alike.
        None => levels.values().find_map(|l| scale(l, &vertices(l))).map_or(Unit::Unknown, Unit::Sure),
    };
    for (key, class) in [("walls", PlanClass::Wall), ("doors", PlanClass::Door)] {
        for pair in list(chosen, key) {
            if let Some(ends) = both(&here, pair) {
                plan.add(Piece::line(ends.to_vec(), false).of(Some(class))).map_err(|TooMany| TOO_MANY)?;
            }
        }
    }
    let lanes = ["lanes", "human_lanes"].into_iter().flat_map(|key| list(chosen, key));
    plan.lanes = lanes.filter_map(|pair| both(&here, pair)).collect();
    plan.leave_out("model|models", list(chosen, "models").len());
    plan.leave_out("lift|lifts", building.get("lifts").and_then(Value::as_object).map_or(0, |lifts| lifts.len()));
    if levels.len() > 1 {
        plan.warnings.push(format!("level {wanted} of {} was read: {name}", levels.len()));
    }
    if plan.pieces.is_empty() {
        return Err(format!("its level {name} has no walls"));
    }
    Ok(plan)
}
