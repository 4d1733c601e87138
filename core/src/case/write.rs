//! A [`Case`] as text.

use super::{write_json, write_toml, Case, Format, FORMAT_VERSION};
use crate::math::Listed;
use crate::model::{Entry, Value};

/// Writes a case so that [`read`](super::read) returns the same case: the same order, the same formulas, and numbers
/// with the fewest digits that yield the same bits.
///
/// A case that [`read`](super::read) cannot return, with two entries of one name or a number that is not finite,
/// is written unchanged; [`read`](super::read) then reports its faults.
pub fn write(case: &Case, format: Format) -> String {
    let tree = tree(case);
    match format {
        Format::Toml => write_toml::text(&tree),
        Format::Json => write_json::text(&tree),
    }
}

/// The case as one table in the written order, without empty sections.
fn tree(case: &Case) -> Vec<(String, Value)> {
    let model = &case.definition;
    let text = |text: &Option<String>| text.clone().map(Value::Text);
    let table = |fields: &[(String, Value)]| Some(Value::Table(fields.to_vec()));
    let entries = |entries: &[Entry]| {
        let entry = |e: &Entry| (e.name.clone(), Value::Table(e.fields.clone()));
        Some(Value::Table(entries.iter().map(entry).list()))
    };
    let start = [("set", &case.start.set), ("guess", &case.start.guess)];
    let start = start.into_iter().filter(|(_, coordinates)| !coordinates.is_empty());
    let start =
        start.map(|(key, coordinates)| (key.to_string(), Value::Table(coordinates.clone())));
    let sections = [
        ("kempe", Some(Value::Number(f64::from(FORMAT_VERSION)))),
        ("title", text(&model.title)),
        ("gravity", model.gravity.clone()),
        ("redundancy", text(&model.redundancy)),
        ("parameters", table(&model.parameters)),
        ("tables", entries(&model.tables)),
        ("bodies", entries(&model.bodies)),
        ("joints", entries(&model.joints)),
        ("drivers", entries(&model.drivers)),
        ("forces", entries(&model.forces)),
        ("measures", table(&model.measures)),
        ("start", Some(Value::Table(start.list()))),
        ("analyses", entries(&case.analyses)),
        ("sweep", table(&case.sweep)),
        ("gradient", table(&case.gradient)),
        ("optimize", table(&case.optimize)),
        ("fit", table(&case.fit)),
        ("synthesis", table(&case.synthesis)),
        ("exercise", table(&case.exercise)),
    ];
    let empty = |value: &Value| matches!(value, Value::Table(fields) if fields.is_empty());
    let sections = sections.into_iter().filter_map(|(key, value)| Some((key.to_string(), value?)));
    sections.filter(|(_, value)| !empty(value)).list()
}
