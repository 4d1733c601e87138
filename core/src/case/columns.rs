//! Common parts of the sections that ask for many runs or for slopes: measures, the names of variables, and the analysis.

use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{as_list, as_table, wrong};
use crate::analyses::{is_motion, sweep};
use crate::expression::suggest::did_you_mean;
use crate::math::{Listed, ShortArray};
use crate::model::{Model, Problem, Value};

/// Quantities of the driver of a motion over a driven value. The model of the case does not contain this driver.
const OVER: &str = "over.";

/// Checks the structure of the section `[gradient]`.
pub(super) fn gradient(
    report: &mut ProblemList,
    node: &Node,
    root: &Table,
) -> Vec<(String, Value)> {
    let keys = ["measures", "variables", "analysis"];
    let section = ("gradient", &keys[..], &keys[..2]);
    read(report, (node, root), section, |report, _, value| {
        texts(report, value, ("variable", "L2"));
    })
}

/// Checks the structure of a section with a name, its keys and those that it must have. `own` checks the keys that the
/// sections do not share.
pub(super) fn read(
    report: &mut ProblemList,
    (node, root): (&Node, &Table),
    (name, keys, required): (&str, &[&str], &[&str]),
    mut own: impl FnMut(&mut ProblemList, &str, &Node),
) -> Vec<(String, Value)> {
    let Some(table) = as_table(report, node, &format!("a table with {}", required.join(" and ")))
    else {
        return Vec::new();
    };
    report.entries(table, |report, key, value| match key {
        "measures" if keys.contains(&"measures") => {
            texts(report, value, ("measure", "C.force.max"))
        }
        "analysis" => analysis(report, value, root),
        key if keys.contains(&key) => own(report, key, value),
        _ => report.unknown("key", key, &format!(" of {name}"), keys),
    });
    report.missing(table, required);
    table.values()
}

/// A list of texts such as `example`, which has the noun `what`.
pub(super) fn texts(report: &mut ProblemList, node: &Node, (what, example): (&str, &str)) {
    let Some(items) = as_list(report, node, &format!("a list of {what}s [\"{example}\"]")) else {
        return;
    };
    report.items(items, |report, item| {
        if !matches!(item.data, Data::Text(_)) {
            wrong(report, item, &format!("a {what} such as \"{example}\""));
        }
    });
    if items.is_empty() {
        report.say(format!("an empty list; must have a {what} such as \"{example}\""));
    }
}

fn analysis(report: &mut ProblemList, node: &Node, root: &Table) {
    let Data::Text(name) = &node.data else { return wrong(report, node, "a name") };
    let known: Vec<&str> = match root.get("analyses").map(|node| &node.data) {
        Some(Data::Table(table)) => table.entries.iter().map(|(known, _)| known.as_str()).list(),
        _ => Vec::new(),
    };
    if !known.contains(&name.as_str()) {
        let message = format!("no analysis '{}'", super::shown(name));
        let hint = did_you_mean(name, &known);
        let hint = hint.unwrap_or_else(|| "write the name of an analysis of this case".to_string());
        report.add(report.here(message).hint(hint));
    }
}

/// The faults of a section with a name that can be found with the model: names that it does not contain, and faulty
/// measures. `kinds` contains the names and types of the analyses.
pub(super) fn faults(
    model: &Model,
    (section, entries): (&str, &[(String, Value)]),
    measures: &[(String, Value)],
    kinds: &[(String, String)],
) -> Vec<Problem> {
    let get = |key: &str| entries.iter().find(|(known, _)| known == key).map(|(_, value)| value);
    let under = |key: &str, last: &str, problem: Problem| Problem {
        path: [section, key, last].each(str::to_string).to_vec(),
        ..problem
    };
    let fault = |name: &str| sweep::variable_fault(model, name);
    let key = if section == "fit" { "parameters" } else { "variables" };
    let mut found: Vec<Problem> = match get(key) {
        Some(Value::Table(entries)) => {
            entries.iter().filter_map(|(name, _)| Some(under(key, name, fault(name)?))).list()
        }
        Some(Value::List(names)) => texts_of(names)
            .filter_map(|(k, name)| Some(under("variables", &k.to_string(), fault(name)?)))
            .list(),
        _ => Vec::new(),
    };
    let chosen = match get("analysis") {
        Some(Value::Text(name)) => kinds.iter().find(|(known, _)| known == name),
        _ => kinds.last(),
    };
    let Some(Value::List(texts)) = get("measures") else { return found };
    let Some((_, kind)) = chosen.filter(|(_, kind)| is_motion(kind)) else {
        return found;
    };
    for (k, text) in texts_of(texts) {
        if kind != "dynamics" && text.starts_with(OVER) {
            continue;
        }
        let fault = sweep::measure_fault(model, measures, text);
        found.extend(fault.map(|problem| under("measures", &k.to_string(), problem)));
    }
    found
}

/// The texts of a list with their places.
fn texts_of(list: &[Value]) -> impl Iterator<Item = (usize, &str)> {
    list.iter().enumerate().filter_map(|(k, value)| match value {
        Value::Text(text) => Some((k, text.as_str())),
        _ => None,
    })
}
