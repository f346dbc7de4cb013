use serde_json::{Map, Value, json};

use super::field::{Field, Kind, Limits, Table};

/// A JSON Schema (draft 7) of a table.
pub(crate) fn schema_of(table: Table) -> Value {
    let mut definitions = Map::new();
    let mut schema = of_table(table, &mut vec![], &mut definitions);
    schema["definitions"] = Value::Object(definitions);
    schema
}

/// A table; `around` are those that it stands in. One that holds itself becomes a definition.
fn of_table(table: Table, around: &mut Vec<&'static str>, definitions: &mut Map<String, Value>) -> Value {
    if around.contains(&table.name) {
        definitions.entry(table.name).or_insert(Value::Null);
        return json!({ "$ref": format!("#/definitions/{}", table.name) });
    }
    around.push(table.name);
    let properties: Map<String, Value> =
        table.fields().map(|field| (field.name.to_string(), of_field(field, around, definitions))).collect();
    around.pop();
    let required: Vec<&str> = table.fields().filter(|field| field.required).map(|field| field.name).collect();
    let mut schema = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    if definitions.get(table.name).is_some_and(Value::is_null) {
        definitions.insert(table.name.to_string(), schema.clone());
    }
    schema
}

fn of_field(field: &Field, around: &mut Vec<&'static str>, definitions: &mut Map<String, Value>) -> Value {
    let mut schema = of_kind(&(field.kind)(), field.limits, around, definitions);
    if schema.get("$ref").is_some() {
        return schema;
    }
    if !field.docs.is_empty() {
        schema["description"] = json!(field.about());
    }
    let default = (field.default)().filter(|value| !field.required && !value.is_table());
    if let Some(default) = default.and_then(|value| serde_json::to_value(value).ok()) {
        schema["default"] = default;
    }
    schema
}

fn of_kind(
    kind: &Kind,
    limits: Option<Limits>,
    around: &mut Vec<&'static str>,
    definitions: &mut Map<String, Value>,
) -> Value {
    match kind {
        Kind::Number => within(json!({ "type": "number" }), limits),
        Kind::Whole(low, high) => {
            let schema = json!({ "type": "integer", "minimum": low, "maximum": high });
            within(schema, limits)
        }
        Kind::Truth => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string" }),
        Kind::OneOf(names) => json!({ "enum": names }),
        Kind::List(kind, count) => {
            let mut schema = json!({ "type": "array", "items": of_kind(kind, limits, around, definitions) });
            if let Some(count) = count {
                schema["minItems"] = json!(count);
                schema["maxItems"] = json!(count);
            }
            schema
        }
        Kind::Table(table) => of_table(*table, around, definitions),
        Kind::AnyOf(_, kinds) => {
            let kinds: Vec<Value> = kinds.iter().map(|kind| of_kind(kind, limits, around, definitions)).collect();
            json!({ "anyOf": kinds })
        }
    }
}

fn within(mut schema: Value, limits: Option<Limits>) -> Value {
    if let Some(Limits { low, high, open }) = limits {
        schema["minimum"] = number(low);
        schema[if open { "exclusiveMaximum" } else { "maximum" }] = number(high);
    }
    schema
}

/// A number without a fraction where it has none.
fn number(number: f64) -> Value {
    if number.fract() == 0.0 && number.abs() < 1e15 { json!(number as i64) } else { json!(number) }
}
