//! The JSON Schema of a case, from the same declarations as the reader.

use serde_json::{json, Map, Value};

use super::check::REDUNDANCY;
use super::FORMAT_VERSION;
use crate::analyses::{declarations, option_families};
use crate::elements::{catalogue, Default, Field, Group, Shape, Table, TOLERANCES};
use crate::model::body_tables;

/// The JSON Schema (draft 2020-12) of a case, for editors: sections, types, fields, descriptions and
/// units.
pub fn schema() -> String {
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "kempe case",
        "description": "A planar multibody model, its start and its analyses.",
        "type": "object",
        "properties": sections(),
        "additionalProperties": false,
        "required": ["kempe"],
        "$defs": definitions(),
    });
    format!("{schema:#}\n")
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// An object with just these properties.
fn object(properties: Value, required: &[&str]) -> Value {
    let mut object =
        json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        object["required"] = json!(required);
    }
    object
}

/// An object of values of one kind by name.
fn by_name(value: Value) -> Value {
    let names = json!({ "pattern": "^[^.\\p{Cc}]+$", "maxLength": 200 });
    json!({ "type": "object", "propertyNames": names, "additionalProperties": value })
}

fn described(mut schema: Value, words: &str) -> Value {
    schema["description"] = json!(words);
    schema
}

fn sections() -> Value {
    let start = object(json!({ "set": by_coordinate(), "guess": by_coordinate() }), &[]);
    let (ground, typed): (Vec<_>, Vec<_>) =
        body_tables().into_iter().partition(|table| table.name == "ground");
    let ground = declared(&ground[0], None);
    let body = |table: &Table| declared(table, Some(table.name != "body"));
    let body = json!({ "anyOf": typed.iter().map(body).collect::<Value>() });
    let bodies = json!({
        "type": "object", "properties": { "ground": ground }, "additionalProperties": body
    });
    let mut sections = json!({
        "kempe": { "const": FORMAT_VERSION, "description": "Version of the format." },
        "title": { "type": "string" },
        "gravity": described(reference("pair"), "Acceleration of free fall (m/s^2); none means zero."),
        "redundancy": { "enum": REDUNDANCY },
        "parameters": by_name(reference("number")),
        "bodies": bodies,
    });
    for group in [Group::Joints, Group::Drivers, Group::Forces] {
        let tables: Vec<Table> =
            catalogue().into_iter().filter(|(g, _)| *g == group).map(|(_, t)| t).collect();
        sections[group.section()] = by_name(one_of(&tables));
    }
    sections["start"] = start;
    sections["analyses"] = by_name(one_of(declarations().iter().map(|declared| &declared.table)));
    sections
}

/// `body.coordinate`, or a table for each body.
fn by_coordinate() -> Value {
    let nested = json!({ "type": "object", "additionalProperties": reference("number") });
    json!({
        "type": "object",
        "additionalProperties": { "anyOf": [reference("number"), nested] },
        "description": "Coordinates and rates x y angle vx vy omega of bodies, and states of elements.",
    })
}

fn one_of<'t>(tables: impl IntoIterator<Item = &'t Table>) -> Value {
    let choice = |table| declared(table, Some(true));
    json!({ "oneOf": tables.into_iter().map(choice).collect::<Value>() })
}

/// The schema of one declaration; with a `type`, which may be required.
fn declared(table: &Table, kind: Option<bool>) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    if let Some(needed) = kind {
        properties.insert("type".into(), json!({ "const": table.name }));
        required.extend(needed.then_some("type"));
    }
    for f in &table.fields {
        properties.insert(f.name.into(), property(f));
        required.extend(f.default.is_none().then_some(f.name));
    }
    described(object(Value::Object(properties), &required), &table.doc)
}

fn property(f: &Field) -> Value {
    let schema = match f.shape {
        Shape::Body | Shape::Point | Shape::Coordinate | Shape::Name => json!({ "type": "string" }),
        Shape::Flag => json!({ "type": "boolean" }),
        Shape::Word(words) => json!({ "enum": words }),
        Shape::Number | Shape::Law => reference("number"),
        Shape::Pair => reference("pair"),
        Shape::Points => reference("points"),
        Shape::Names => reference("names"),
        Shape::Count => reference("count"),
        Shape::Tolerance => reference("tolerance"),
        Shape::Options(family) => reference(family),
    };
    let unit = if f.unit.is_empty() { String::new() } else { format!(" ({})", f.unit) };
    let mut schema = described(schema, &format!("{}{unit}", f.doc));
    match f.default {
        Some(Default::Number(x)) => schema["default"] = json!(x),
        Some(Default::Pair(pair)) => schema["default"] = json!(pair),
        Some(Default::Body(name)) => schema["default"] = json!(name),
        Some(Default::Flag(flag)) => schema["default"] = json!(flag),
        Some(Default::Type(name)) => schema["default"] = json!({ "type": name }),
        Some(Default::Absent) | None => {}
    }
    schema
}

fn definitions() -> Value {
    let two_of =
        |item: Value| json!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 });
    let number = json!({ "type": ["number", "string"] });
    let mut definitions = json!({
        "number": described(number, "A number or a formula."),
        "pair": two_of(reference("number")),
        "points": by_name(reference("pair")),
        "names": two_of(json!({ "type": "string" })),
        "count": { "anyOf": [{ "type": "integer", "minimum": 1 }, { "type": "string" }] },
    });
    let kinds = TOLERANCES.iter().map(|kind| (kind.to_string(), reference("number")));
    let by_kind = object(Value::Object(kinds.collect()), &[]);
    definitions["tolerance"] = json!({ "anyOf": [reference("number"), by_kind] });
    for family in option_families() {
        definitions[family.name] = one_of(family.options.iter().map(|options| &options.table));
    }
    definitions
}
