//! The rules for names.

use std::collections::HashMap;

use super::diagnostic::is_hidden;
use super::report::ProblemList;

/// Words that have another meaning in formulas and references.
pub const RESERVED: [&str; 4] = ["t", "pi", "deg", "ground"];
/// Largest number of characters of a name.
pub(super) const MOST_CHARACTERS: usize = 200;
/// Characters that names must not contain, as a set of a regular expression: control characters, bidirectional
/// controls, and blanks of zero width. The two joiners U+200C and U+200D are allowed because some scripts need them.
pub(super) const HIDDEN: &str =
    r"\u0000-\u001F\u007F-\u009F\u061C\u200B\u200E\u200F\u2028-\u202E\u2060-\u206F\uFEFF";

/// The reason why a text cannot be a name, if there is one.
fn fault(name: &str) -> Option<String> {
    if name.trim().is_empty() {
        return Some("a name must not be empty".to_string());
    }
    if name.contains('.') {
        return Some("a name must not contain '.', which separates body and point".to_string());
    }
    if name.chars().any(char::is_control) {
        return Some("a name must not contain control characters or line breaks".to_string());
    }
    // some scripts need the two joiners
    let hidden = |c: &char| is_hidden(*c) && !matches!(c, '\u{200C}' | '\u{200D}');
    if let Some(hidden) = name.chars().find(hidden) {
        let code = hidden as u32;
        return Some(format!("a name must not contain U+{code:04X}, which hides or reorders text"));
    }
    let length = name.chars().count();
    (length > MOST_CHARACTERS)
        .then(|| format!("a name of {length} characters; at most {MOST_CHARACTERS} are allowed"))
}

/// Checks the current key as a name.
pub(super) fn key(report: &mut ProblemList, name: &str) {
    if let Some(message) = fault(name) {
        report.say_of_key(message);
    }
}

/// Checks the current value as a name.
pub(super) fn value(report: &mut ProblemList, name: &str) {
    if let Some(message) = fault(name) {
        report.say(message);
    }
}

/// Characters that separate folders, or that some file systems do not allow.
const NOT_IN_FOLDERS: [char; 9] = ['/', '\\', ':', '*', '?', '"', '<', '>', '|'];

/// Checks the current key as the name of an analysis. It must be a valid name of the folder for the results.
pub(super) fn folder(report: &mut ProblemList, name: &str, earlier: &[String]) {
    key(report, name);
    let hint = "its results go to a folder of this name";
    let mut wrong = |message: String| report.add(report.here(message).at_key().hint(hint));
    if let Some(found) = name.chars().find(|c| NOT_IN_FOLDERS.contains(c)) {
        wrong(format!("the name of an analysis must not contain '{found}'"));
    } else if name.trim() != name {
        wrong("the name of an analysis must not begin or end with a blank".to_string());
    } else if name.len() > MOST_CHARACTERS {
        wrong(format!(
            "the name of an analysis takes {} bytes; at most {MOST_CHARACTERS} are allowed",
            name.len()
        ));
    } else if let Some(other) = earlier.iter().find(|other| alike(other, name)) {
        wrong(format!(
            "differs from '{}' only in upper and lower case, which some file systems do not distinguish",
            super::shown(other)
        ));
    }
}

fn alike(one: &str, other: &str) -> bool {
    one.to_lowercase() == other.to_lowercase()
}

/// Checks the current key as the name of a parameter or an element.
pub(super) fn unreserved_key(report: &mut ProblemList, name: &str) {
    if RESERVED.contains(&name) {
        let problem = report.here(format!("'{name}' is reserved and cannot be a name"));
        report.add(problem.at_key().hint("t pi deg ground mean something else; take another name"));
    } else {
        key(report, name);
    }
}

/// The namespace that bodies, joints, drivers, forces and measures share.
#[derive(Default)]
pub(super) struct Namespace(HashMap<String, &'static str>);

impl Namespace {
    /// Checks the current key and adds it to the namespace. `singular` is the kind of the named item.
    pub(super) fn take(&mut self, report: &mut ProblemList, name: &str, singular: &'static str) {
        if singular == "body" && name == "ground" {
            return;
        }
        unreserved_key(report, name);
        match self.0.get(name) {
            None => {
                self.0.insert(name.to_string(), singular);
            }
            Some(other) => {
                let message = format!("'{}' is already the name of a {other}", super::shown(name));
                let hint = "choose another name: bodies, joints, drivers, forces and measures share one namespace";
                report.add(report.here(message).at_key().hint(hint));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::RangeInclusive;

    /// The characters of a set of a regular expression, of escapes `\\u0000` and ranges of them.
    fn ranges(set: &str) -> Vec<RangeInclusive<u32>> {
        let code = |text: &str| u32::from_str_radix(&text[..4], 16).unwrap();
        let parts: Vec<&str> = set.split("\\u").skip(1).collect();
        let single = parts.iter().map(|part| code(part)..=code(part));
        let between = parts.windows(2).filter(|pair| pair[0].ends_with('-'));
        single.chain(between.map(|pair| code(pair[0])..=code(pair[1]))).collect()
    }

    #[test]
    fn the_set_of_hidden_characters_is_what_names_refuse() {
        let hidden = ranges(HIDDEN);
        for c in (0..0x11_0000).filter_map(char::from_u32).filter(|c| *c != '.') {
            let refused = hidden.iter().any(|range| range.contains(&(c as u32)));
            assert_eq!(fault(&format!("a{c}")).is_some(), refused, "{c:?}");
        }
    }
}
