//! The sections `[synthesis]` and `[exercise]`: a task whose answer is a linkage, and questions about a mechanism.

use super::problems::{named, text, with_unit};
use super::report::ProblemList;
use super::sweep::{plain, whole};
use super::tree::{Data, Node, Table};
use super::values::{as_list, as_table, word, wrong};
use super::{columns, shown};
use crate::analyses::{is_motion, readings, sweep};
use crate::math::{Listed, ShortArray};
use crate::model::{Model, Problem, Value};

/// Words for `task` of a synthesis, and the list that each task needs.
pub(super) const TASKS: [(&str, &str); 3] =
    [("motion", "poses"), ("path", "points"), ("function", "pairs")];
/// Words for `family`, `defects`, `direction`, `scales` and `offsets`.
pub(super) const FAMILIES: [&str; 7] = [
    "four_bar",
    "slider_crank",
    "watt_1",
    "watt_2",
    "stephenson_1",
    "stephenson_2",
    "stephenson_3",
];
pub(super) const DEFECTS: [&str; 2] = ["exclude", "tell"];
pub(super) const DIRECTIONS: [&str; 2] = ["ccw", "cw"];
pub(super) const FREEDOMS: [&str; 2] = ["fixed", "free"];
/// Keys of all tasks, and those of some of them.
pub(super) const COMMON: [&str; 10] = [
    "task",
    "family",
    "defects",
    "transmission_angle",
    "grashof",
    "within",
    "direction",
    "masses",
    "seed",
    "choice",
];
const OWN: [&[&str]; 3] = [
    &["poses", "pivots", "samples"],
    &["points", "angles", "offsets", "pivots", "parts", "starts"],
    &["pairs", "scales", "offsets", "ground", "pivots", "parts", "samples"],
];
/// Keys of a question and of a range of a parameter.
const QUESTION: [&str; 8] =
    ["text", "measure", "quantity", "at", "unit", "tolerance", "hints", "points"];
const RANGE: [&str; 4] = ["from", "to", "step", "unit"];

/// Checks the structure of the section `[synthesis]`.
pub(super) fn synthesis(
    report: &mut ProblemList,
    node: &Node,
    root: &Table,
) -> Vec<(String, Value)> {
    let chosen = match &node.data {
        Data::Table(table) => match table.get("task").map(|node| &node.data) {
            Some(Data::Text(word)) => TASKS.iter().position(|(task, _)| task == word),
            _ => None,
        },
        _ => None,
    };
    let own = OWN[chosen.unwrap_or(0)];
    let keys: Vec<&str> = COMMON.iter().chain(own).copied().list();
    let needed = ["task", TASKS[chosen.unwrap_or(0)].1];
    let required = if chosen.is_some() { &needed[..] } else { &needed[..1] };
    let section = ("synthesis", &keys[..], required);
    columns::read(report, (node, root), section, |report, key, value| match key {
        "task" => word(report, value, &TASKS.each(|(task, _)| task)),
        "poses" => rows(report, value, (3, "[[0, 0, 0], [0.1, 0.2, \"30 deg\"]]")),
        "points" => rows(report, value, (2, "[[0, 0], [0.1, 0.2]]")),
        "pairs" => rows(report, value, (2, "[[\"10 deg\", \"35 deg\"], [\"40 deg\", \"60 deg\"]]")),
        "angles" => row(report, value, None, "[\"10 deg\", \"40 deg\"]"),
        "pivots" => named(report, value, "O = [0, 0]", |report, node| {
            row(report, node, Some(2), "[0, 0]");
        }),
        "parts" => named(report, value, "crank = 0.3", |report, node| match node.data {
            Data::Table(_) => named(report, node, "O = [0, 0]", |report, node| {
                row(report, node, Some(2), "[0, 0]");
            }),
            Data::List(_) => row(report, node, Some(2), "[0.1, 0.3]"),
            _ => with_unit(report, node),
        }),
        "family" => word(report, value, &FAMILIES),
        "defects" => word(report, value, &DEFECTS),
        "direction" => word(report, value, &DIRECTIONS),
        "scales" | "offsets" => word(report, value, &FREEDOMS),
        "grashof" => {
            if !matches!(value.data, Data::Flag(_) | Data::Text(_)) {
                wrong(report, value, "true, or a type such as \"crank-rocker\"");
            }
        }
        "transmission_angle" | "ground" => with_unit(report, value),
        "within" => rows(report, value, (2, "[[x_min, x_max], [y_min, y_max]]")),
        "masses" => named(report, value, "crank = 0.3", with_unit),
        "seed" => whole(report, value, 0.0),
        _ => whole(report, value, 1.0),
    })
}

/// Checks the structure of the section `[exercise]`.
pub(super) fn exercise(
    report: &mut ProblemList,
    node: &Node,
    root: &Table,
) -> Vec<(String, Value)> {
    let keys = ["text", "questions", "parameters", "seed", "analysis"];
    let section = ("exercise", &keys[..], &["questions"][..]);
    columns::read(report, (node, root), section, |report, key, value| match key {
        "text" => text(report, value, "a text"),
        "questions" => {
            named(report, value, "peak = { text = \"…\", measure = \"C.force.max\" }", question)
        }
        "parameters" => named(report, value, "L2 = { from = 0.2, to = 0.3, step = 0.01 }", range),
        _ => whole(report, value, 0.0),
    })
}

fn question(report: &mut ProblemList, node: &Node) {
    let Some(table) = as_table(report, node, "a table with text and measure or quantity") else {
        return;
    };
    report.entries(table, |report, key, value| match key {
        "text" => text(report, value, "a text, such as \"How large is the force in pin C?\""),
        "measure" => text(report, value, "a column such as \"C.force.max\""),
        "quantity" => text(report, value, "a quantity such as \"crank.angle\""),
        "unit" => text(report, value, "a unit such as \"kN\""),
        "at" => with_unit(report, value),
        "tolerance" => tolerance(report, value),
        "hints" => columns::texts(report, value, ("hint", "Draw the free body of the coupler.")),
        "points" => plain(report, value),
        _ => report.unknown("key", key, " of a question", &QUESTION),
    });
    if table.get("text").is_none() {
        report.say("text is missing");
    }
    match (table.get("measure"), table.get("quantity")) {
        (None, None) => report.say("measure or quantity is missing"),
        (Some(_), Some(_)) => report.say("both measure and quantity"),
        (Some(_), None) if table.get("at").is_some() => {
            report.say("at belongs to a quantity, not to a measure");
        }
        _ => {}
    }
}

/// A number, which is relative, or a text such as "2 %" or "0.5 N".
fn tolerance(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::Text(_) => {}
        Data::Number(x) if *x > 0.0 && *x < 1.0 => {}
        _ => wrong(report, node, "a share such as 0.02, or a text such as \"2 %\" or \"0.5 N\""),
    }
}

/// The range of a random parameter.
fn range(report: &mut ProblemList, node: &Node) {
    let Some(table) = as_table(report, node, "a table { from = 0.2, to = 0.3, step = 0.01 }")
    else {
        return;
    };
    report.entries(table, |report, key, value| match key {
        "from" | "to" | "step" => plain(report, value),
        "unit" => text(report, value, "a unit such as \"mm\""),
        _ => report.unknown("key", key, " of a range", &RANGE),
    });
    let number = |key: &str| match table.get(key).map(|node| &node.data) {
        Some(Data::Number(x)) => Some(*x),
        _ => None,
    };
    report.missing(table, &["from", "to"]);
    if let (Some(from), Some(to)) = (number("from"), number("to")) {
        if to <= from {
            report.say(format!("to = {to} must be larger than from = {from}"));
        }
    }
    if number("step").is_some_and(|step| step <= 0.0) {
        report.say("step must be larger than 0");
    }
}

/// Rows of numbers, or of texts with units, of one width.
fn rows(report: &mut ProblemList, node: &Node, (width, example): (usize, &str)) {
    let Some(items) = as_list(report, node, &format!("a list such as {example}")) else { return };
    report.items(items, |report, item| row(report, item, Some(width), example));
}

fn row(report: &mut ProblemList, node: &Node, width: Option<usize>, example: &str) {
    let Some(items) = as_list(report, node, &format!("a list of numbers, as in {example}")) else {
        return;
    };
    report.items(items, with_unit);
    if let Some(width) = width.filter(|width| *width != items.len()) {
        report
            .say(format!("a list of {}; must have {width} numbers, as in {example}", items.len()));
    }
}

/// The faults of an exercise that can be found with the model: parameters and quantities that it does not contain.
pub(super) fn faults(
    model: &Model,
    entries: &[(String, Value)],
    measures: &[(String, Value)],
    kinds: &[(String, String)],
) -> Vec<Problem> {
    let get = |key: &str| entries.iter().find(|(known, _)| known == key).map(|(_, value)| value);
    let within = |key: &str| match get(key) {
        Some(Value::Table(entries)) => &entries[..],
        _ => &[],
    };
    let under = |path: &[&str], problem: Problem| Problem {
        path: ["exercise"].iter().chain(path).map(|key| (*key).to_string()).list(),
        ..problem
    };
    let known = &model.blueprint.parameters;
    let mut found: Vec<Problem> = Vec::new();
    for (name, _) in within("parameters").iter().filter(|(name, _)| !known.contains(name)) {
        let problem = Problem::at(&[name], format!("no parameter '{}'", shown(name)));
        let hint = "random values are those of entries of [parameters]";
        found.push(under(&["parameters", name], problem.hint(hint)));
    }
    let chosen = match get("analysis") {
        Some(Value::Text(name)) => kinds.iter().find(|(known, _)| known == name),
        _ => kinds.last(),
    };
    let motion = chosen.is_some_and(|(_, kind)| is_motion(kind));
    for (name, question) in within("questions") {
        let Value::Table(question) = question else { continue };
        let text = |wanted: &str| {
            question.iter().find_map(|(key, value)| match value {
                Value::Text(text) if key == wanted => Some(text),
                _ => None,
            })
        };
        if let Some(column) = text("measure").filter(|_| motion) {
            let fault = sweep::measure_fault(model, measures, column);
            found.extend(fault.map(|one| under(&["questions", name, "measure"], one)));
        }
        if let Some(quantity) = text("quantity") {
            let fault = readings::find(model, quantity).err();
            found.extend(fault.map(|one| under(&["questions", name, "quantity"], one)));
        }
    }
    found
}
