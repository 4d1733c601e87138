//! TOML: a header for each entry, inline tables below.

use super::write_value::{one_line, quoted};
use crate::model::Value;

/// Sections that contain named entries. The other sections contain values.
const OF_ENTRIES: [&str; 6] = ["tables", "bodies", "joints", "drivers", "forces", "analyses"];

pub(super) fn text(tree: &[(String, Value)]) -> String {
    let mut out = String::new();
    for (name, value) in tree {
        match value {
            Value::Table(entries) if OF_ENTRIES.contains(&name.as_str()) => {
                for (entry, fields) in entries {
                    out += &format!("\n[{name}.{}]\n", key(entry));
                    out += &lines(fields);
                }
            }
            Value::Table(_) => out += &format!("\n[{name}]\n{}", lines(value)),
            _ => out += &line(name, value),
        }
    }
    out
}

/// The fields of a table, one per line.
fn lines(table: &Value) -> String {
    let Value::Table(fields) = table else { return String::new() };
    fields.iter().map(|(name, value)| line(name, value)).collect()
}

fn line(name: &str, value: &Value) -> String {
    format!("{}{}\n", assigned(name), one_line(value, assigned))
}

fn assigned(name: &str) -> String {
    key(name) + " = "
}

/// A key, in quotes if necessary.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(bare) {
        true => name.to_string(),
        false => quoted(name),
    }
}
