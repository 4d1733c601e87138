//! Parts of a JSON Schema: tables with the keys that they may have, and descriptions.

use serde_json::{Map, Value};

use super::json_literal::json;
use crate::math::Listed;

pub(super) fn described(mut schema: Value, words: &str) -> Value {
    schema["description"] = json!(words);
    schema
}

pub(super) fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(entries) => entries,
        _ => Map::new(),
    }
}

/// An object with exactly these properties. The schema `besides` applies only if all keys are known. An unknown key,
/// which may be misspelt, is then the only error.
pub(super) fn closed(properties: Map<String, Value>, besides: Value) -> Value {
    let keys = properties.keys().map(String::as_str).list();
    let known = json!({ "propertyNames": { "enum": keys } });
    json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "if": known,
        "then": besides,
    })
}

/// A number, or a text with a unit.
pub(super) fn with_unit() -> Value {
    json!({ "anyOf": [{ "type": "number" }, { "type": "string" }] })
}

/// A table with any names that is not empty.
pub(super) fn by_any_name(of: Value) -> Value {
    json!({ "type": "object", "additionalProperties": of, "minProperties": 1 })
}

/// A list of texts that is not empty.
pub(super) fn texts() -> Value {
    json!({ "type": "array", "items": { "type": "string" }, "minItems": 1 })
}
