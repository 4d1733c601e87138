//! The declarations of elements, bodies, options, functions and units as JSON: for the generated files, palettes and
//! docs.

use crate::analyses::options::Declaration;
use crate::analyses::{declarations, option_families};
use crate::elements::{catalogue as elements, Default, Field, Group, Shape, Table};
use crate::expression::unit::{Unit, UNITS};
use crate::expression::{Function, FUNCTIONS};
use crate::math::Listed;
use crate::model::{body_tables, shape_tables, table_fields};
use serde_json::{json, Map, Value};

fn default(field: &Field) -> Value {
    match field.default {
        None => Value::Null,
        Some(Default::Absent) => json!({ "absent": true }),
        Some(Default::Number(x)) => json!(x),
        Some(Default::Pair(p)) => json!(p),
        Some(Default::Triple(x)) => json!(x),
        Some(Default::Flag(flag)) => json!(flag),
        Some(Default::Type(name) | Default::Body(name)) => json!(name),
    }
}

fn shape(shape: Shape) -> Value {
    match shape {
        Shape::Word(words) => json!({ "words": words }),
        Shape::Options(family) => json!({ "options": family }),
        Shape::LawPair => json!("law_pair"),
        Shape::Ranges => json!("ranges"),
        Shape::NameList => json!("name_list"),
        Shape::TwoTexts => json!("two_texts"),
        plain => json!(format!("{plain:?}").to_lowercase()),
    }
}

fn field(field: &Field) -> Value {
    json!({
        "name": field.name,
        "shape": shape(field.shape),
        "unit": field.unit,
        "required": field.default.is_none(),
        "default": default(field),
        "doc": field.doc,
    })
}

fn table(table: &Table) -> Value {
    let fields: Vec<Value> = table.fields.iter().map(field).list();
    json!({ "name": table.name, "doc": table.doc, "fields": fields })
}

/// An analysis or a set of options, with its class in Python.
fn options(declared: &Declaration) -> Value {
    let mut value = table(&declared.table);
    value["class"] = json!(declared.class);
    if declared.motion {
        value["motion"] = json!(true);
    }
    if !declared.numbers.is_empty() {
        let numbers = declared.numbers.iter().map(|(name, unit)| json!([name, unit]));
        value["numbers"] = numbers.collect();
    }
    value
}

fn function(function: &Function) -> Value {
    json!({ "name": function.name, "arguments": function.arguments, "doc": function.doc })
}

fn unit((name, unit): &(&str, Unit)) -> Value {
    json!({ "name": name, "si": unit.scale(1.0), "dimension": unit.dimension.to_string() })
}

/// The allowed content of a case by section, then the functions and units of formulas.
pub fn catalogue() -> Value {
    let mut sections = Map::new();
    sections.insert("bodies".into(), body_tables().iter().map(table).collect());
    sections.insert("shapes".into(), shape_tables().iter().map(table).collect());
    sections.insert("tables".into(), json!([table(&table_fields())]));
    for group in [Group::Joints, Group::Drivers, Group::Forces] {
        let tables = elements();
        let own = tables.iter().filter(|(g, _)| *g == group).map(|(_, own)| table(own));
        sections.insert(group.section().into(), own.collect());
    }
    for family in option_families() {
        let plural = format!("{}s", family.name);
        sections.insert(plural, family.options.iter().map(options).collect());
    }
    sections.insert("analyses".into(), declarations().iter().map(options).collect());
    sections.insert("functions".into(), FUNCTIONS.iter().map(function).collect());
    sections.insert("units".into(), UNITS.iter().map(unit).collect());
    Value::Object(sections)
}
