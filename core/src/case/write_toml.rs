//! TOML: a header for each entry, inline tables below.

use std::fmt::Write;

use super::write::{digits, head, sections, start};
use super::Case;
use crate::model::Value;

pub(super) fn text(case: &Case) -> String {
    let mut out = String::new();
    fields(&mut out, &head(case));
    let parameters = &case.definition.parameters;
    if !parameters.is_empty() {
        out.push_str("\n[parameters]\n");
        fields(&mut out, parameters);
    }
    for (section, entries) in sections(case) {
        for entry in entries {
            let _ = writeln!(out, "\n[{section}.{}]", key(&entry.name)); // a String takes all
            fields(&mut out, &entry.fields);
        }
        let start = start(case);
        if section == "forces" && !start.is_empty() {
            out.push_str("\n[start]\n");
            fields(&mut out, &start);
        }
    }
    out
}

fn fields(out: &mut String, fields: &[(String, Value)]) {
    for (name, value) in fields {
        let _ = writeln!(out, "{} = {}", key(name), inline(value));
    }
}

/// A key, in quotes where it needs them.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(bare) {
        name.to_string()
    } else {
        quoted(name)
    }
}

fn inline(value: &Value) -> String {
    match value {
        Value::Number(x) => digits(*x),
        Value::Text(text) => quoted(text),
        Value::Flag(flag) => flag.to_string(),
        Value::List(items) => {
            format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", "))
        }
        Value::Table(entries) if entries.is_empty() => "{}".to_string(),
        Value::Table(entries) => {
            let entry =
                |(name, value): &(String, Value)| format!("{} = {}", key(name), inline(value));
            format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A basic string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
