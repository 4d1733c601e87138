//! JSON: indented by two, short lists and tables on one line.

use std::fmt::Write;

use super::write::digits;
use crate::model::Value;

/// Longest list or table that stands on one line.
const ONE_LINE: usize = 80;

pub(super) fn text(value: &Value) -> String {
    let mut out = String::new();
    indented(&mut out, value, 0);
    out
}

fn indented(out: &mut String, value: &Value, depth: usize) {
    let (entries, brackets): (Vec<(Option<&String>, &Value)>, _) = match value {
        Value::List(items) => (items.iter().map(|v| (None, v)).collect(), ['[', ']']),
        Value::Table(fields) => (fields.iter().map(|(k, v)| (Some(k), v)).collect(), ['{', '}']),
        _ => return out.push_str(&on_one_line(value)),
    };
    // the top and its sections are always broken into lines, what is within only where it is long
    let one_line = match value {
        Value::List(_) => true,
        _ => depth > 1 || entries.is_empty(),
    };
    let line = on_one_line(value);
    if one_line && line.len() <= ONE_LINE {
        return out.push_str(&line);
    }
    out.push(brackets[0]);
    for (k, (key, value)) in entries.iter().enumerate() {
        out.push_str(if k == 0 { "\n" } else { ",\n" });
        out.push_str(&"  ".repeat(depth + 1));
        if let Some(key) = key {
            out.push_str(&quoted(key));
            out.push_str(": ");
        }
        indented(out, value, depth + 1);
    }
    let _ = write!(out, "\n{}{}", "  ".repeat(depth), brackets[1]); // a String takes all
}

fn on_one_line(value: &Value) -> String {
    match value {
        Value::Number(x) => digits(*x),
        Value::Text(text) => quoted(text),
        Value::Flag(flag) => flag.to_string(),
        Value::List(items) => {
            format!("[{}]", items.iter().map(on_one_line).collect::<Vec<_>>().join(", "))
        }
        Value::Table(entries) if entries.is_empty() => "{}".to_string(),
        Value::Table(entries) => {
            let entry = |(k, v): &(String, Value)| format!("{}: {}", quoted(k), on_one_line(v));
            format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}

fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04x}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
