//! The JSON Schema of a case, from the same declarations as the reader.

use serde_json::{Map, Value};

use super::check::REDUNDANCY;
use super::json_literal::json;
use super::names::{HIDDEN, MOST_CHARACTERS, RESERVED};
use super::schema_parts::{closed, described, object};
use super::schema_requests as requests;
use super::FORMAT_VERSION;
use crate::analyses::options::Declaration;
use crate::analyses::{declarations, option_families, DIRECTIONS};
use crate::elements::{
    catalogue, CurveForm, Default, Field, Group, Shape, Table, CURVE_FORMS, TOLERANCES,
    UNITS_OF_EQUATIONS,
};
use crate::expression::FUNCTIONS;
use crate::math::{Interpolation, Listed, ShortArray};
use crate::model::{body_tables, shape_tables, table_fields, INSTEAD_OF_SHAPES};

/// The JSON Schema (draft 2020-12) of a case, for editors: sections, types, fields, descriptions and
/// units.
pub fn schema() -> String {
    let mut schema = closed(sections(), json!({ "required": ["kempe"] }));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("kempe case");
    schema["description"] = json!("A planar multibody model, its start and its analyses.");
    schema["$defs"] = definitions();
    format!("{schema:#}\n")
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// Names, except those in `except`. `(?![\s\S])` matches the end of the text in every dialect of regular expressions.
fn names(except: &[&str]) -> Value {
    names_without("", except)
}

/// Names of analyses, which are also names of folders.
fn folders() -> Value {
    names_without(r#"/\\:*?"<>|"#, &["start"])
}

/// Names that do not contain the characters `more` either.
fn names_without(more: &str, except: &[&str]) -> Value {
    let reserved = match except {
        [] => String::new(),
        _ => format!("(?!(?:{})(?![\\s\\S]))", except.join("|")),
    };
    let pattern = format!("^{reserved}(?=[^.]*[^.\\s])[^.{HIDDEN}{more}]+(?![\\s\\S])");
    json!({ "pattern": pattern, "maxLength": MOST_CHARACTERS })
}

/// An object of values of one kind by name.
fn by_name(value: Value, except: &[&str]) -> Value {
    json!({ "type": "object", "propertyNames": names(except), "additionalProperties": value })
}

fn sections() -> Map<String, Value> {
    let start = json!({ "set": by_coordinate(), "guess": by_coordinate() });
    let (ground, typed): (Vec<_>, Vec<_>) =
        body_tables().into_iter().partition(|table| table.name == "ground");
    let mut bodies = by_name(one_of(&typed, Some("body")), &RESERVED[..3]);
    bodies["properties"] =
        json!({ "ground": described(fields(&ground[0], false), &ground[0].doc) });
    let mut sections = json!({
        "kempe": { "const": FORMAT_VERSION, "description": "Version of the format." },
        "title": { "type": "string" },
        "gravity": described(reference("pair"), "Acceleration of free fall (m/s^2); none means zero."),
        "redundancy": { "enum": REDUNDANCY },
        "parameters": by_name(reference("number"), &RESERVED),
        "tables": tables(),
        "bodies": bodies,
    });
    for group in [Group::Joints, Group::Drivers, Group::Forces] {
        let tables: Vec<Table> =
            catalogue().into_iter().filter(|(g, _)| *g == group).map(|(_, t)| t).list();
        sections[group.section()] = by_name(one_of(&tables, None), &RESERVED);
    }
    let measure = json!({ "type": "string", "description": "An expression of quantities." });
    sections["measures"] = by_name(measure, &RESERVED);
    sections["start"] = closed(object(start), json!({}));
    let mut analyses = by_name(options(declarations()), &[]);
    analyses["propertyNames"] = folders();
    sections["analyses"] = analyses;
    requests::add(&mut sections);
    object(sections)
}

/// Tables by name. Formulas call them, so that their names must be identifiers.
fn tables() -> Value {
    let table = table_fields();
    let properties = table.fields.iter().map(|f| (f.name.to_string(), property(f))).collect();
    let either = json!({
        "if": { "required": ["file"] },
        "then": { "properties": { "x": false, "y": false } },
        "else": { "required": ["x", "y"], "properties": { "columns": false } },
    });
    let reserved = FUNCTIONS.iter().map(|f| f.name).chain(RESERVED).list().join("|");
    let pattern = format!("^(?!(?:{reserved})(?![\\s\\S]))[A-Za-z_][A-Za-z0-9_]*(?![\\s\\S])");
    json!({
        "type": "object",
        "propertyNames": { "pattern": pattern, "maxLength": MOST_CHARACTERS },
        "additionalProperties": described(closed(properties, either), &table.doc),
    })
}

/// `body.coordinate`, or a table for each body.
fn by_coordinate() -> Value {
    json!({
        "type": "object",
        "patternProperties": { "[.]": reference("number") },
        "additionalProperties": { "type": "object", "additionalProperties": reference("number") },
        "description": "Coordinates and rates x y angle vx vy omega of bodies, and states of elements.",
    })
}

/// An object whose `type` selects its fields; `absent` is the type of an object without the key `type`.
///
/// With `if` and `then` for each type, a fault causes a single error, whereas `oneOf` would list all types. The
/// properties outside `if` are for editors that ignore `if` when they complete keys.
fn one_of<'t>(tables: impl IntoIterator<Item = &'t Table>, absent: Option<&str>) -> Value {
    let (mut properties, mut choices, mut kinds) = (Map::new(), Vec::new(), Vec::new());
    for table in tables {
        kinds.push(table.name);
        for f in &table.fields {
            let known =
                properties.entry(f.name).or_insert_with(|| described(json!({}), &meaning(f)));
            if known["description"] != json!(meaning(f)) {
                *known = json!({});
            }
        }
        let mut this = json!({ "properties": { "type": { "const": table.name } } });
        if absent != Some(table.name) {
            this["required"] = json!(["type"]);
        }
        choices.push(json!({ "if": this, "then": described(fields(table, true), &table.doc) }));
    }
    properties.insert("type".into(), json!({ "enum": kinds }));
    let mut choice = json!({ "allOf": choices });
    if absent.is_none() {
        choice["required"] = json!(["type"]);
    }
    closed(properties, choice)
}

/// One of the `known` sets of options.
fn options(known: &[Declaration]) -> Value {
    let mut found = one_of(known.iter().map(|declared| &declared.table), None);
    for (choice, declared) in found["then"]["allOf"].as_array_mut().into_iter().flatten().zip(known)
    {
        let excluded = declared.excludes.iter().map(|(one, others)| {
            let others = others.iter().map(|other| (other.to_string(), json!(false)));
            (one.to_string(), json!({ "properties": others.collect::<Map<_, _>>() }))
        });
        let excluded: Map<_, _> = excluded.collect();
        if !excluded.is_empty() {
            choice["then"]["dependentSchemas"] = Value::Object(excluded);
        }
    }
    found
}

/// The fields of one declaration.
fn fields(table: &Table, typed: bool) -> Value {
    let properties = table.fields.iter().map(|f| (f.name.to_string(), property(f)));
    let kind = typed.then(|| ("type".to_string(), json!({})));
    let properties: Map<_, _> = kind.into_iter().chain(properties).collect();
    let required = table.fields.iter().filter(|f| f.default.is_none()).map(|f| f.name);
    let mut complete = json!({ "required": required.list() });
    if table.name == "bar" {
        complete["if"] = json!({ "not": { "required": ["through"] } });
        complete["then"] = json!({ "required": ["length"] });
    }
    if table.name == "body" {
        let instead = INSTEAD_OF_SHAPES.each(|key| (key.to_string(), json!(false)));
        complete["if"] = json!({ "required": ["shapes"] });
        complete["then"] = json!({ "properties": Map::from_iter(instead) });
        complete["else"] = json!({ "required": ["mass", "inertia"] });
    }
    closed(properties, complete)
}

/// The description of a field, with its unit.
fn meaning(f: &Field) -> String {
    match f.unit.as_str() {
        "" => f.doc.clone(),
        unit => format!("{} ({unit})", f.doc),
    }
}

fn property(f: &Field) -> Value {
    let schema = match f.shape {
        Shape::Curve => json!({ "type": "string" }),
        Shape::Curves => reference("curves"),
        Shape::Shapes => reference("shapes"),
        Shape::Outline => reference("outline"),
        Shape::Section => reference("section"),
        Shape::Corners => reference("corners"),
        Shape::Body | Shape::Point | Shape::Coordinate | Shape::Joint | Shape::Name => {
            json!({ "type": "string" })
        }
        Shape::Condition => json!({ "type": "string" }),
        Shape::NameList | Shape::Quantities => {
            json!({ "type": "array", "items": { "type": "string" } })
        }
        Shape::Events => reference("events"),
        Shape::Values => reference("terms"),
        Shape::Flag => json!({ "type": "boolean" }),
        Shape::Word(words) => json!({ "enum": words }),
        Shape::Number | Shape::Law => reference("number"),
        Shape::Pair | Shape::LawPair => reference("pair"),
        Shape::Ranges => json!({ "type": "array", "items": { "$ref": "#/$defs/pair" } }),
        Shape::Triple => reference("triple"),
        Shape::Laws => reference("laws"),
        Shape::Terms => reference("terms"),
        Shape::Units => json!({ "type": "array", "items": { "enum": UNITS_OF_EQUATIONS } }),
        Shape::Points => reference("points"),
        Shape::Names => reference("names"),
        Shape::TwoTexts => json!({
            "type": "array",
            "items": { "type": "string" },
            "minItems": 2,
            "maxItems": 2,
        }),
        Shape::Numbers => json!({ "type": "array", "items": { "type": "number" } }),
        Shape::Columns => json!({
            "type": "array",
            "items": { "type": "string" },
            "minItems": 2,
            "maxItems": 2,
            "uniqueItems": true,
        }),
        Shape::Count => reference("count"),
        Shape::Tolerance => reference("tolerance"),
        Shape::Options(family) => reference(family),
    };
    let mut schema = described(schema, &meaning(f));
    match f.default {
        Some(Default::Number(x)) => schema["default"] = json!(x),
        Some(Default::Pair(pair)) => schema["default"] = json!(pair),
        Some(Default::Triple(triple)) => schema["default"] = json!(triple),
        Some(Default::Body(name)) => schema["default"] = json!(name),
        Some(Default::Flag(flag)) => schema["default"] = json!(flag),
        Some(Default::Type(name)) => schema["default"] = json!({ "type": name }),
        Some(Default::Absent) | None => {}
    }
    schema
}

/// A curve in one of its forms.
fn curve() -> Value {
    let word = |kind: Interpolation| kind.name();
    let points =
        |least: usize| json!({ "type": "array", "items": reference("pair"), "minItems": least });
    let mut line = points(2);
    line["maxItems"] = json!(2);
    let three =
        json!({ "type": "array", "items": reference("number"), "minItems": 3, "maxItems": 3 });
    let number = || reference("number");
    let properties = json!({
        "x": described(number(), "x(u) in the frame of the body (m): a formula in u and the parameters."),
        "y": described(number(), "y(u) in the frame of the body (m): a formula in u and the parameters."),
        "range": described(reference("pair"), "First and last u of x and y."),
        "polar": described(number(), "Distance r(u) from the origin (m) at the polar angle u; closed."),
        "points": described(points(2), "Points [x, y] (m); u is the accumulated chord length."),
        "periodic": described(json!({ "type": "boolean" }), "Whether the curve closes itself."),
        "interpolation": { "enum": Interpolation::ALL.each(word), "description": "Of points; quintic if absent." },
        "circle": described(three, "Centre x, y and radius (m); u is the angle, counter-clockwise."),
        "line": described(line, "Both ends [x, y] (m); u is the length from the first."),
        "polygon": described(points(3), "Corners [x, y] (m), counter-clockwise; for contacts; u is the length."),
    });
    let one = |form: &CurveForm| json!({ "required": form.keys });
    let forms: Vec<Value> = CURVE_FORMS.iter().map(one).list();
    closed(object(properties), json!({ "oneOf": forms }))
}

/// A polygon, a circle or a path.
fn outline() -> Value {
    let path = json!({ "type": "string", "description": "Path data of SVG, in m." });
    let circle = described(reference("triple"), "Centre x, y and radius (m).");
    let table = closed(
        object(json!({ "circle": circle, "path": path })),
        json!({ "minProperties": 1, "maxProperties": 1 }),
    );
    json!({ "if": { "type": "array" }, "then": reference("corners"), "else": table })
}

/// A cross section of a beam.
fn section() -> Value {
    let properties = json!({
        "rectangle": described(reference("pair"), "Height in the plane, and width (m)."),
        "circle": described(reference("number"), "Diameter (m)."),
        "tube": described(reference("pair"), "Outer and inner diameter (m)."),
    });
    closed(object(properties), json!({ "minProperties": 1, "maxProperties": 1 }))
}

/// An event: a condition, or a table that contains a condition.
fn event() -> Value {
    let properties = json!({
        "condition": { "type": "string", "description": "A comparison, or an expression that becomes zero." },
        "direction": { "enum": DIRECTIONS.each(|(word, _)| word), "description": "Zeros of an expression that count." },
        "stop": {
            "anyOf": [{ "type": "boolean" }, { "type": "integer", "minimum": 1, "maximum": 1_000_000_000 }],
            "description": "Whether the run ends there, or the number of the event that ends it."
        },
    });
    let table = closed(object(properties), json!({ "required": ["condition"] }));
    json!({ "anyOf": [{ "type": "string" }, table] })
}

fn definitions() -> Value {
    let two_of =
        |item: Value| json!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 });
    let two_different = |mut item: Value| {
        item["type"] = json!("string");
        let mut two = two_of(item);
        two["uniqueItems"] = json!(true);
        two
    };
    let number = json!({ "type": ["number", "string"] });
    let mut definitions = json!({
        "number": described(number, "A number or a formula."),
        "pair": two_of(reference("number")),
        "triple": { "type": "array", "items": reference("number"), "minItems": 3, "maxItems": 3 },
        "points": by_name(reference("pair"), &[]),
        "laws": { "type": "array", "items": reference("number"), "minItems": 1 },
        "terms": { "type": "object", "additionalProperties": reference("number"), "minProperties": 1 },
        "names": two_different(names(&[])),
        "count": { "anyOf": [{ "type": "integer", "minimum": 1 }, { "type": "string" }] },
    });
    definitions["corners"] = json!({ "type": "array", "items": reference("pair"), "minItems": 3 });
    definitions["outline"] = outline();
    definitions["section"] = section();
    let shapes = one_of(&shape_tables(), None);
    definitions["shapes"] = json!({ "type": "array", "items": shapes, "minItems": 1 });
    definitions["curves"] = by_name(curve(), &[]);
    definitions["events"] = by_name(event(), &[]);
    let kinds = TOLERANCES.iter().map(|kind| (kind.to_string(), reference("number")));
    let by_kind = closed(kinds.collect(), json!({}));
    definitions["tolerance"] = json!({ "anyOf": [reference("number"), by_kind] });
    for family in option_families() {
        definitions[family.name] = options(&family.options);
    }
    definitions
}
