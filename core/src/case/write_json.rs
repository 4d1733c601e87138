//! JSON: indented by two, short lists and tables on one line.

use super::write_value::{one_line, quoted};
use crate::model::Value;

/// Longest list or table that is written on one line.
const ONE_LINE: usize = 80;

pub(super) fn text(tree: &[(String, Value)]) -> String {
    let mut out = String::new();
    table(&mut out, tree, 0);
    out + "\n"
}

fn key(name: &str) -> String {
    quoted(name) + ": "
}

/// Writes a value. The root and its sections always have several lines, values within them only if they are long.
fn value(out: &mut String, value: &Value, depth: usize) {
    let line = one_line(value, key);
    match value {
        Value::List(items) if line.len() > ONE_LINE => {
            broken(out, ["[", "]"], depth, items, |_| String::new(), |item| item);
        }
        Value::Table(entries) if !entries.is_empty() && (depth < 2 || line.len() > ONE_LINE) => {
            table(out, entries, depth);
        }
        _ => out.push_str(&line),
    }
}

fn table(out: &mut String, entries: &[(String, Value)], depth: usize) {
    broken(out, ["{", "}"], depth, entries, |(name, _)| key(name), |(_, value)| value);
}

/// Writes a list or a table with one item per line.
fn broken<T>(
    out: &mut String,
    [open, close]: [&str; 2],
    depth: usize,
    items: &[T],
    key: impl Fn(&T) -> String,
    of: impl Fn(&T) -> &Value,
) {
    out.push_str(open);
    for (k, item) in items.iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        *out += &format!("{comma}\n{}{}", "  ".repeat(depth + 1), key(item));
        value(out, of(item), depth + 1);
    }
    *out += &format!("\n{}{close}", "  ".repeat(depth));
}
