//! A [`Case`] as text.

use super::{write_json, write_toml, Case, Format, FORMAT_VERSION};
use crate::model::{Entry, Value};

/// Writes a case so that [`read`](super::read) gives the same case again: same order, same formulas,
/// numbers with the fewest digits that give the same bits.
///
/// A case that [`read`](super::read) would not give, with two things of one name or a number that is
/// not finite, is written as it is, and then refused when read.
pub fn write(case: &Case, format: Format) -> String {
    match format {
        Format::Toml => write_toml::text(case),
        Format::Json => write_json::text(&Value::Table(tree(case))) + "\n",
    }
}

/// The case as one table, without its empty sections.
fn tree(case: &Case) -> Vec<(String, Value)> {
    let model = &case.definition;
    let mut tree = head(case);
    let mut add = |key: &str, entries: Vec<(String, Value)>| {
        if !entries.is_empty() {
            tree.push((key.to_string(), Value::Table(entries)));
        }
    };
    add("parameters", model.parameters.clone());
    for (section, entries) in sections(case) {
        add(
            section,
            entries.iter().map(|e| (e.name.clone(), Value::Table(e.fields.clone()))).collect(),
        );
        if section == "forces" {
            add("start", start(case));
        }
    }
    tree
}

/// What stands before the first section.
pub(super) fn head(case: &Case) -> Vec<(String, Value)> {
    let mut head = vec![("kempe".to_string(), Value::Number(f64::from(FORMAT_VERSION)))];
    if let Some(title) = &case.definition.title {
        head.push(("title".to_string(), Value::Text(title.clone())));
    }
    if let Some(gravity) = &case.definition.gravity {
        head.push(("gravity".to_string(), gravity.clone()));
    }
    if let Some(redundancy) = &case.definition.redundancy {
        head.push(("redundancy".to_string(), Value::Text(redundancy.clone())));
    }
    head
}

/// The sections of named entries, in the order in which they are written.
pub(super) fn sections(case: &Case) -> [(&'static str, &[Entry]); 5] {
    let model = &case.definition;
    [
        ("bodies", &model.bodies),
        ("joints", &model.joints),
        ("drivers", &model.drivers),
        ("forces", &model.forces),
        ("analyses", &case.analyses),
    ]
}

/// The section `start`, without its empty tables.
pub(super) fn start(case: &Case) -> Vec<(String, Value)> {
    [("set", &case.start.set), ("guess", &case.start.guess)]
        .into_iter()
        .filter(|(_, coordinates)| !coordinates.is_empty())
        .map(|(key, coordinates)| (key.to_string(), Value::Table(coordinates.clone())))
        .collect()
}

/// A number with the fewest digits that give the same bits, with an exponent if that is shorter for
/// a large or small number, or if the digits alone would read as an integer beyond 2^53.
pub(super) fn digits(x: f64) -> String {
    let plain = format!("{x}");
    let size = x.abs();
    if !x.is_finite() || size == 0.0 || (1e-3..1e4).contains(&size) {
        return plain;
    }
    let exponent = format!("{x:e}");
    if exponent.len() < plain.len() || size > 9.0e15 {
        exponent
    } else {
        plain
    }
}
