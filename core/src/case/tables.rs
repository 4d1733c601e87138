//! The structure of a table, and the points from its file.

use super::fields;
use super::report::ProblemList;
use super::tree;
use super::Case;
use crate::elements::Table as Declaration;
use crate::expression::{is_identifier, is_reserved, FUNCTIONS};
use crate::math::Listed;
use crate::model::Value;

/// Checks the current table as the table with this name in the case with this root.
pub(super) fn check(
    report: &mut ProblemList,
    name: &str,
    (table, declared): (&tree::Table, &Declaration),
    root: &tree::Table,
) {
    if let Some((message, hint)) = wrong_name(name, root) {
        report.add(report.here(message).at_key().hint(hint));
    }
    fields::check(report, table, declared, false);
    let mut add = |field: &str, message: &str, hint: &str| {
        report.within(field, |report| report.add(report.here(message).hint(hint)));
    };
    let has = |field: &str| table.get(field).is_some();
    if has("file") {
        for field in ["x", "y"].into_iter().filter(|field| has(field)) {
            add(field, "not together with file", "remove one of them");
        }
        return;
    }
    if has("columns") {
        add("columns", "there are columns only in a file", "give file, or remove columns");
    }
    for field in ["x", "y"].into_iter().filter(|field| !has(field)) {
        let hint = "give x and y, or file = \"NAME.csv\"";
        add(field, "missing; a table needs it", hint);
    }
}

/// The reason why a formula cannot call a table by this name, and a remedy.
fn wrong_name(name: &str, root: &tree::Table) -> Option<(String, &'static str)> {
    let taken = |section: &str| root.get(section).and_then(|node| node.child(name)).is_some();
    let shown = super::shown(name);
    if FUNCTIONS.iter().any(|function| function.name == name) {
        return Some((format!("'{shown}' is already a function of formulas"), "take another name"));
    }
    if is_reserved(name) {
        return Some((format!("'{shown}' is reserved and cannot be a name"), "take another name"));
    }
    if !is_identifier(name) || name.len() > super::names::MOST_CHARACTERS {
        let message = "formulas call a table by its name, which must be letters, digits and '_', and not begin \
                       with a digit";
        return Some((message.to_string(), "take another name, such as lift"));
    }
    if taken("parameters") {
        let message = format!("'{shown}' is already the name of a parameter");
        return Some((message, "rename the table or the parameter"));
    }
    None
}

impl Case {
    /// Sets the points of a table to those of its file. Returns false if there is no such table.
    ///
    /// The core does not read files. The caller reads the file, and the case keeps its name.
    pub fn supply(&mut self, table: &str, x: &[f64], y: &[f64]) -> bool {
        let tables = &mut self.definition.tables;
        let Some(entry) = tables.iter_mut().find(|entry| entry.name == table) else { return false };
        let list = |numbers: &[f64]| Value::List(numbers.iter().map(|x| Value::Number(*x)).list());
        entry.fields.retain(|(field, _)| field != "x" && field != "y");
        entry.fields.push(("x".to_string(), list(x)));
        entry.fields.push(("y".to_string(), list(y)));
        true
    }
}
