//! The JSON Schema of a case, from the same declarations as the reader.

use super::check::REDUNDANCY;
use super::{write_json, FORMAT_VERSION};
use crate::analyses::{analysis_tables, option_families};
use crate::elements::{catalogue, Default, Field, Group, Shape, Table};
use crate::model::{body_tables, Value};

type Fields = Vec<(String, Value)>;

/// The JSON Schema (draft 2020-12) of a case, for editors: sections, types, fields, descriptions and
/// units.
pub fn schema() -> String {
    let mut schema = vec![
        field("$schema", text("https://json-schema.org/draft/2020-12/schema")),
        field("title", text("kempe case")),
        field("description", text("A planar multibody model, its start and its analyses.")),
    ];
    schema.extend(object(sections(), &["kempe"]));
    schema.push(field("$defs", Value::Table(definitions())));
    write_json::text(&Value::Table(schema)) + "\n"
}

fn text(words: &str) -> Value {
    Value::Text(words.to_string())
}
fn texts(words: &[&str]) -> Value {
    Value::List(words.iter().map(|word| text(word)).collect())
}
fn field(key: &str, value: Value) -> (String, Value) {
    (key.to_string(), value)
}
fn reference(name: &str) -> Value {
    Value::Table(vec![field("$ref", text(&format!("#/$defs/{name}")))])
}
fn typed(kind: &str) -> Fields {
    vec![field("type", text(kind))]
}

/// An object with just these properties.
fn object(properties: Fields, required: &[&str]) -> Fields {
    let mut object = typed("object");
    object.push(field("properties", Value::Table(properties)));
    object.push(field("additionalProperties", Value::Flag(false)));
    if !required.is_empty() {
        object.push(field("required", texts(required)));
    }
    object
}

/// An object of values of one kind by name.
fn by_name(value: Value) -> Value {
    let names =
        vec![field("pattern", text("^[^.\\p{Cc}]+$")), field("maxLength", Value::Number(200.0))];
    let mut object = typed("object");
    object.push(field("propertyNames", Value::Table(names)));
    object.push(field("additionalProperties", value));
    Value::Table(object)
}

fn sections() -> Fields {
    let version = vec![
        field("const", Value::Number(f64::from(FORMAT_VERSION))),
        field("description", text("Version of the format.")),
    ];
    let mut gravity = vec![field("$ref", text("#/$defs/pair"))];
    gravity.push(field("description", text("Acceleration of free fall (m/s^2); none means zero.")));
    let coordinates = by_coordinate();
    let start = object(vec![field("set", coordinates.clone()), field("guess", coordinates)], &[]);
    let bodies = body_tables();
    let mut body_section = typed("object");
    body_section.push(field("properties", Value::Table(vec![field("ground", ground(&bodies))])));
    body_section.push(field("additionalProperties", any_body(&bodies)));
    let mut sections = vec![
        field("kempe", Value::Table(version)),
        field("title", Value::Table(typed("string"))),
        field("gravity", Value::Table(gravity)),
        field("redundancy", Value::Table(vec![field("enum", texts(&REDUNDANCY))])),
        field("parameters", by_name(reference("number"))),
        field("bodies", Value::Table(body_section)),
    ];
    for group in [Group::Joints, Group::Drivers, Group::Forces] {
        let tables: Vec<Table> =
            catalogue().into_iter().filter(|(g, _)| *g == group).map(|(_, t)| t).collect();
        sections.push(field(group.section(), by_name(one_of(&tables))));
    }
    sections.push(field("start", Value::Table(start)));
    sections.push(field("analyses", by_name(one_of(analysis_tables()))));
    sections
}

/// `body.coordinate`, or a table for each body.
fn by_coordinate() -> Value {
    let mut object = typed("object");
    let nested =
        vec![field("type", text("object")), field("additionalProperties", reference("number"))];
    let choice = vec![reference("number"), Value::Table(nested)];
    let value = Value::Table(vec![field("anyOf", Value::List(choice))]);
    object.push(field("additionalProperties", value));
    object
        .push(field("description", text("Coordinates and rates x y angle vx vy omega of bodies.")));
    Value::Table(object)
}

fn ground(bodies: &[Table]) -> Value {
    let ground = bodies.iter().find(|table| table.name == "ground");
    ground.map_or(Value::Flag(true), |table| declared(table, None))
}

fn any_body(bodies: &[Table]) -> Value {
    let choices = bodies.iter().filter(|table| table.name != "ground");
    let choices = choices.map(|table| declared(table, Some(table.name != "body"))).collect();
    Value::Table(vec![field("anyOf", Value::List(choices))])
}

fn one_of(tables: &[Table]) -> Value {
    let choices = tables.iter().map(|table| declared(table, Some(true))).collect();
    Value::Table(vec![field("oneOf", Value::List(choices))])
}

/// The schema of one declaration; with a `type`, which may be required.
fn declared(table: &Table, kind: Option<bool>) -> Value {
    let mut properties = Vec::new();
    let mut required = Vec::new();
    if let Some(needed) = kind {
        properties.push(field("type", Value::Table(vec![field("const", text(table.name))])));
        required.extend(needed.then_some("type"));
    }
    for f in &table.fields {
        properties.push(field(f.name, property(f)));
        required.extend(f.default.is_none().then_some(f.name));
    }
    let mut schema = vec![field("description", text(&table.doc))];
    schema.extend(object(properties, &required));
    Value::Table(schema)
}

fn property(f: &Field) -> Value {
    let mut schema = match f.shape {
        Shape::Body | Shape::Point | Shape::Coordinate | Shape::Name => typed("string"),
        Shape::Flag => typed("boolean"),
        Shape::Word(words) => vec![field("enum", texts(words))],
        Shape::Number | Shape::Law => vec![field("$ref", text("#/$defs/number"))],
        Shape::Pair => vec![field("$ref", text("#/$defs/pair"))],
        Shape::Points => vec![field("$ref", text("#/$defs/points"))],
        Shape::Names => vec![field("$ref", text("#/$defs/names"))],
        Shape::Count => vec![field("$ref", text("#/$defs/count"))],
        Shape::Options(family) => vec![field("$ref", text(&format!("#/$defs/{family}")))],
    };
    let unit = if f.unit.is_empty() { String::new() } else { format!(" ({})", f.unit) };
    schema.push(field("description", text(&format!("{}{unit}", f.doc))));
    let default = match f.default {
        Some(Default::Number(x)) => Some(Value::Number(x)),
        Some(Default::Pair(pair)) => Some(Value::List(pair.map(Value::Number).to_vec())),
        Some(Default::Body(name)) => Some(text(name)),
        Some(Default::Flag(flag)) => Some(Value::Flag(flag)),
        Some(Default::Type(name)) => Some(Value::Table(vec![field("type", text(name))])),
        Some(Default::Absent) | None => None,
    };
    schema.extend(default.map(|value| field("default", value)));
    Value::Table(schema)
}

fn definitions() -> Fields {
    let two_of = |item: Value| {
        let mut list = typed("array");
        list.push(field("items", item));
        list.push(field("minItems", Value::Number(2.0)));
        list.push(field("maxItems", Value::Number(2.0)));
        Value::Table(list)
    };
    let whole = |kind: &str| {
        let mut schema = typed(kind);
        if kind == "integer" {
            schema.push(field("minimum", Value::Number(1.0)));
        }
        Value::Table(schema)
    };
    let formula = vec![
        field("type", texts(&["number", "string"])),
        field("description", text("A number or a formula.")),
    ];
    let count = vec![field("anyOf", Value::List(vec![whole("integer"), whole("string")]))];
    let mut definitions = vec![
        field("number", Value::Table(formula)),
        field("pair", two_of(reference("number"))),
        field("points", by_name(reference("pair"))),
        field("names", two_of(Value::Table(typed("string")))),
        field("count", Value::Table(count)),
    ];
    for family in option_families() {
        let tables: Vec<Table> = family.options.iter().map(|o| o.table.clone()).collect();
        definitions.push(field(family.name, one_of(&tables)));
    }
    definitions
}
