//! The section `[sweep]`: variables with their values, measures, and the design.

use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{word, wrong};
use crate::analyses::{is_motion, sweep};
use crate::expression::suggest::did_you_mean;
use crate::math::Listed;
use crate::model::{Model, Problem, Value};

/// The keys of the section.
const KEYS: [&str; 6] = ["variables", "measures", "design", "n", "seed", "analysis"];
/// Words for `design`.
pub(super) const DESIGNS: [&str; 5] = ["grid", "paired", "random", "latin", "sobol"];
/// Words for the scale of a range.
pub(super) const SCALES: [&str; 2] = ["linear", "log"];
/// Quantities of the driver of a motion over a driven value. The model of the case does not contain this driver.
const OVER: &str = "over.";

/// Checks the structure of the section.
pub(super) fn read(report: &mut ProblemList, node: &Node, root: &Table) -> Vec<(String, Value)> {
    let Data::Table(table) = &node.data else {
        wrong(report, node, "a table with variables and measures");
        return Vec::new();
    };
    for (key, value) in &table.entries {
        report.within(key, |report| match key.as_str() {
            "variables" => variables(report, value),
            "measures" => texts(report, value),
            "design" => word(report, value, &DESIGNS),
            "n" => whole(report, value, 1.0),
            "seed" => whole(report, value, 0.0),
            "analysis" => analysis(report, value, root),
            _ => {
                let message = format!("unknown key '{}' of a sweep", super::shown(key));
                report.unknown_key(message, key, &KEYS);
            }
        });
    }
    for key in ["variables", "measures"].into_iter().filter(|key| table.get(key).is_none()) {
        report.say(format!("{key} is missing"));
    }
    table.values()
}

fn variables(report: &mut ProblemList, node: &Node) {
    let Data::Table(table) = &node.data else {
        return wrong(report, node, "a table of names and values");
    };
    for (name, value) in &table.entries {
        report.within(name, |report| values(report, value));
    }
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
    for (key, value) in &table.entries {
        report.within(key, |report| match key.as_str() {
            _ if !known.contains(&key.as_str()) => {
                let message = format!("unknown key '{}' of values", super::shown(key));
                let all = ["from", "to", "n", "scale", "normal", "uniform"];
                report.unknown_key(message, key, &all);
            }
            "normal" | "uniform" => numbers(report, value, Some(2)),
            "n" => whole(report, value, 2.0),
            "scale" => word(report, value, &SCALES),
            _ => plain(report, value),
        });
    }
    let needed = known.iter().filter(|key| !["n", "scale"].contains(key));
    for key in needed.filter(|key| table.get(key).is_none()) {
        report.say(format!("{key} is missing"));
    }
}

/// A number, not a formula.
fn plain(report: &mut ProblemList, node: &Node) {
    if !matches!(node.data, Data::Number(_)) {
        wrong(report, node, "a number, in SI units and rad");
    }
}

fn numbers(report: &mut ProblemList, node: &Node, count: Option<usize>) {
    let Data::List(items) = &node.data else {
        return wrong(report, node, "a list of numbers");
    };
    for (k, item) in items.iter().enumerate() {
        report.within(&k.to_string(), |report| plain(report, item));
    }
    if items.is_empty() || count.is_some_and(|count| count != items.len()) {
        let needed = count.map_or("one number or more".to_string(), |n| format!("{n} numbers"));
        report.say(format!("a list of {}; must have {needed}", items.len()));
    }
}

fn texts(report: &mut ProblemList, node: &Node) {
    let Data::List(items) = &node.data else {
        return wrong(report, node, "a list of measures [\"C.force.max\"]");
    };
    for (k, item) in items.iter().enumerate() {
        report.within(&k.to_string(), |report| {
            if !matches!(item.data, Data::Text(_)) {
                wrong(report, item, "a measure such as \"C.force.max\"");
            }
        });
    }
    if items.is_empty() {
        report.say("an empty list; must have a measure such as \"C.force.max\"");
    }
}

fn whole(report: &mut ProblemList, node: &Node, least: f64) {
    match &node.data {
        Data::Number(x) if x.fract() == 0.0 && *x >= least => {}
        Data::Number(x) => report.say(format!("{x}; must be a whole number from {least}")),
        _ => wrong(report, node, &format!("a whole number from {least}")),
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

/// The faults that can be found with the model: names that it does not contain, and faulty measures. `kinds` contains
/// the names and types of the analyses.
pub(super) fn faults(
    model: &Model,
    section: &[(String, Value)],
    measures: &[(String, Value)],
    kinds: &[(String, String)],
) -> Vec<Problem> {
    let get = |key: &str| section.iter().find(|(known, _)| known == key).map(|(_, value)| value);
    let names: Vec<&str> = match get("variables") {
        Some(Value::Table(entries)) => entries.iter().map(|(name, _)| name.as_str()).list(),
        _ => Vec::new(),
    };
    let under = |key: &str, last: &str, problem: Problem| Problem {
        path: ["sweep", key, last].map(str::to_string).to_vec(),
        ..problem
    };
    let mut found: Vec<Problem> = names
        .iter()
        .filter_map(|name| Some(under("variables", name, sweep::variable_fault(model, name)?)))
        .list();
    let swept = match get("analysis") {
        Some(Value::Text(name)) => kinds.iter().find(|(known, _)| known == name),
        _ => kinds.last(),
    };
    let Some(Value::List(texts)) = get("measures") else { return found };
    let Some((_, kind)) = swept.filter(|(_, kind)| is_motion(kind)) else {
        return found;
    };
    for (k, text) in texts.iter().enumerate() {
        let Value::Text(text) = text else { continue };
        if kind != "dynamics" && text.starts_with(OVER) {
            continue;
        }
        let fault = sweep::measure_fault(model, measures, text);
        found.extend(fault.map(|problem| under("measures", &k.to_string(), problem)));
    }
    found
}
