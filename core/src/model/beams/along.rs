//! Formulas of the arc length `s`, for sections that vary along a beam.

use super::super::body_reader::Reader;
use super::super::definition::Value;
use crate::math::Listed;

/// Name of the arc length in formulas.
const ARC_LENGTH: &str = "s";

/// The places of a name in a formula, without units such as that of `2 s` and calls.
fn places(text: &str) -> Vec<usize> {
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let is_own = |at: &usize| {
        let (before, after) = (&text[..*at], &text[at + ARC_LENGTH.len()..]);
        let unit = before.trim_end().ends_with(|c: char| c.is_ascii_digit() || c == '.')
            || before.trim_end().ends_with(char::is_alphabetic);
        !unit && !before.ends_with(word) && !after.starts_with(word) && !after.starts_with('(')
    };
    text.match_indices(ARC_LENGTH).map(|(at, _)| at).filter(is_own).list()
}

/// Whether a formula uses the arc length.
pub fn varies(text: &str) -> bool {
    !places(text).is_empty()
}

/// A formula with the arc length `s` inserted as text.
pub fn at(text: &str, s: &str) -> String {
    let (mut found, mut from) = (String::new(), 0);
    for place in places(text) {
        found.push_str(&text[from..place]);
        found.push_str(&format!("({s})"));
        from = place + ARC_LENGTH.len();
    }
    found + &text[from..]
}

/// A value with the arc length inserted, in lists too.
pub fn inserted(value: &Value, s: &str) -> Value {
    match value {
        Value::Text(text) => Value::Text(at(text, s)),
        Value::List(items) => Value::List(items.iter().map(|item| inserted(item, s)).list()),
        _ => value.clone(),
    }
}

/// Whether a value uses the arc length. A parameter of the same name is reported.
pub fn uses(reader: &mut Reader<'_>, key: &str, value: &Value) -> bool {
    let found = match value {
        Value::Text(text) => varies(text),
        Value::List(items) => {
            items.iter().any(|item| matches!(item, Value::Text(text) if varies(text)))
        }
        _ => false,
    };
    if found && reader.scope.parameters.iter().any(|name| name == ARC_LENGTH) {
        let message = "s is the arc length of a beam here, and a parameter; rename the parameter";
        reader.report(key, message);
    }
    found
}
