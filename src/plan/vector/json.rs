//! Values of JSON and YAML files whose entries are lists of mixed kinds.

use serde_json::Value;

use crate::math::{Vec2, vec2};

/// A number under a key.
pub(super) fn number(value: &Value, key: &str) -> Option<f64> {
    value.get(key)?.as_f64()
}

/// A place as `{ x: .., y: .. }`.
pub(super) fn place(value: &Value) -> Option<Vec2> {
    Some(vec2(number(value, "x")?, number(value, "y")?))
}

/// The entries of a list under a key; none if there is no list.
pub(super) fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}
