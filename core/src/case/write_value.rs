//! Values on one line. TOML and JSON differ only in the keys of tables.

use crate::math::Listed;
use crate::model::Value;

/// A value on one line. `key` writes a key of a table with the character after it.
pub(super) fn one_line(value: &Value, key: fn(&str) -> String) -> String {
    let join = |parts: Vec<String>| parts.join(", ");
    match value {
        Value::Number(x) => digits(*x),
        Value::Text(text) => quoted(text),
        Value::Flag(flag) => flag.to_string(),
        Value::Function(_) => quoted("a function"),
        Value::List(items) => {
            format!("[{}]", join(items.iter().map(|item| one_line(item, key)).list()))
        }
        Value::Table(entries) if entries.is_empty() => "{}".to_string(),
        Value::Table(entries) => {
            let entry = |(name, value): &(String, Value)| key(name) + &one_line(value, key);
            format!("{{ {} }}", join(entries.iter().map(entry).list()))
        }
    }
}

/// A text in double quotes. All escapes of `serde_json` are escapes of TOML too; TOML escapes DEL as well.
pub(super) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}

/// A number with the fewest digits that yield the same bits. It has an exponent if this is shorter for a large or
/// small number, or if the digits alone would be read as an integer beyond 2^53.
pub fn digits(x: f64) -> String {
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
