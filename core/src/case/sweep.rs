//! The section `[sweep]`: variables with their values, measures, and the design.

use super::columns;
use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{as_list, as_table, word, wrong};
use crate::model::Value;

/// The keys of the section.
const KEYS: [&str; 6] = ["variables", "measures", "design", "n", "seed", "analysis"];
/// Words for `design`.
pub(super) const DESIGNS: [&str; 5] = ["grid", "paired", "random", "latin", "sobol"];
/// Words for the scale of a range.
pub(super) const SCALES: [&str; 2] = ["linear", "log"];

/// Checks the structure of the section.
pub(super) fn read(report: &mut ProblemList, node: &Node, root: &Table) -> Vec<(String, Value)> {
    let section = ("sweep", &KEYS[..], &KEYS[..2]);
    columns::read(report, (node, root), section, |report, key, value| match key {
        "variables" => variables(report, value),
        "design" => word(report, value, &DESIGNS),
        "n" => whole(report, value, 1.0),
        _ => whole(report, value, 0.0),
    })
}

fn variables(report: &mut ProblemList, node: &Node) {
    let Some(table) = as_table(report, node, "a table of names and values") else { return };
    report.entries(table, |report, _, value| values(report, value));
}

/// A list of numbers, a range or a distribution.
fn values(report: &mut ProblemList, node: &Node) {
    let table = match &node.data {
        Data::List(_) => return numbers(report, node, None),
        Data::Table(table) => table,
        _ => {
            let form = report.example("{ from = 1, to = 2, n = 11 }", "{\"from\": 1, \"to\": 2}");
            return wrong(report, node, &format!("a list of numbers, or a range such as {form}"));
        }
    };
    let known: &[&str] = match table.entries.first().map(|(key, _)| key.as_str()) {
        Some("normal") => &["normal"],
        Some("uniform") => &["uniform"],
        _ => &["from", "to", "n", "scale"],
    };
    report.entries(table, |report, key, value| match key {
        _ if !known.contains(&key) => {
            let all = ["from", "to", "n", "scale", "normal", "uniform"];
            report.unknown("key", key, " of values", &all);
        }
        "normal" | "uniform" => numbers(report, value, Some(2)),
        "n" => whole(report, value, 2.0),
        "scale" => word(report, value, &SCALES),
        _ => plain(report, value),
    });
    let needed = known.iter().filter(|key| !["n", "scale"].contains(key));
    for key in needed.filter(|key| table.get(key).is_none()) {
        report.say(format!("{key} is missing"));
    }
}

/// A number, not a formula.
pub(super) fn plain(report: &mut ProblemList, node: &Node) {
    if !matches!(node.data, Data::Number(_)) {
        wrong(report, node, "a number, in SI units and rad");
    }
}

/// A list of numbers, of this count if there is one.
pub(super) fn numbers(report: &mut ProblemList, node: &Node, count: Option<usize>) {
    let Some(items) = as_list(report, node, "a list of numbers") else { return };
    report.items(items, plain);
    if items.is_empty() || count.is_some_and(|count| count != items.len()) {
        let needed = count.map_or("one number or more".to_string(), |n| format!("{n} numbers"));
        report.say(format!("a list of {}; must have {needed}", items.len()));
    }
}

/// A whole number from the least one.
pub(super) fn whole(report: &mut ProblemList, node: &Node, least: f64) {
    match &node.data {
        Data::Number(x) if x.fract() == 0.0 && *x >= least => {}
        Data::Number(x) => report.say(format!("{x}; must be a whole number from {least}")),
        _ => wrong(report, node, &format!("a whole number from {least}")),
    }
}
