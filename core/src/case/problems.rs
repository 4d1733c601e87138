//! The sections `[optimize]` and `[fit]`: problems of design, whose answer is a set of values.

use super::columns;
use super::report::ProblemList;
use super::sweep::{numbers, plain, whole, SCALES};
use super::tree::{Data, Node, Table};
use super::values::{as_list, as_table, word, wrong};
use crate::model::Value;

/// Words for `method` of an optimisation.
pub(super) const METHODS: [&str; 4] =
    ["slsqp", "trust-constr", "least-squares", "differential-evolution"];
/// Words for `robust` of a fit: the losses of SciPy.
pub(super) const LOSSES: [&str; 4] = ["soft_l1", "huber", "cauchy", "arctan"];
/// The word for a parameter without bounds, or for one end without a bound.
pub(super) const FREE: &str = "free";

/// Checks the structure of the section `[optimize]`.
pub(super) fn optimize(
    report: &mut ProblemList,
    node: &Node,
    root: &Table,
) -> Vec<(String, Value)> {
    let keys = [
        "variables",
        "minimize",
        "maximize",
        "target",
        "subject_to",
        "loads",
        "starts",
        "seed",
        "method",
        "analysis",
    ];
    let section = ("optimize", &keys[..], &["variables"][..]);
    let found = columns::read(report, (node, root), section, |report, key, value| match key {
        "variables" => named(report, value, "L2 = [20, 30]", bounds),
        "minimize" | "maximize" => objective(report, value),
        "target" => named(report, value, "\"slide.x.max\" = 0.3", plain),
        "subject_to" => columns::texts(report, value, ("limit", "C.force.max <= 2e4")),
        "loads" => loads(report, value),
        "method" => word(report, value, &METHODS),
        "starts" => whole(report, value, 1.0),
        _ => whole(report, value, 0.0),
    });
    let aims =
        found.iter().filter(|(key, _)| ["minimize", "maximize", "target"].contains(&&key[..]));
    match aims.count() {
        1 => {}
        0 if found.is_empty() => {}
        0 => report.say("minimize, maximize or target is missing"),
        _ => report.say("more than one of minimize, maximize and target"),
    }
    found
}

/// Checks the structure of the section `[fit]`.
pub(super) fn fit(report: &mut ProblemList, node: &Node, root: &Table) -> Vec<(String, Value)> {
    let keys = ["t", "shift", "columns", "sigma", "parameters", "robust", "analysis"];
    let section = ("fit", &keys[..], &["columns", "parameters"][..]);
    columns::read(report, (node, root), section, |report, key, value| match key {
        "t" => text(report, value, "the header of the column of times, such as \"time [s]\""),
        "shift" => text(report, value, "the name of a parameter of the fit, such as \"t0\""),
        "columns" => named(report, value, "\"rod.angle\" = \"phi [deg]\"", |report, node| {
            text(report, node, "the header of a column, such as \"phi [deg]\"");
        }),
        "sigma" => named(report, value, "\"rod.angle\" = \"0.5 deg\"", with_unit),
        "parameters" => named(report, value, "J = \"free\"", range),
        _ => word(report, value, &LOSSES),
    })
}

/// A table of names, each with a value.
pub(super) fn named(
    report: &mut ProblemList,
    node: &Node,
    example: &str,
    of: impl Fn(&mut ProblemList, &Node),
) {
    let Some(table) = as_table(report, node, &format!("a table such as {{ {example} }}")) else {
        return;
    };
    report.entries(table, |report, _, value| of(report, value));
    if table.entries.is_empty() {
        report.say(format!("an empty table; must have an entry such as {example}"));
    }
}

/// Load cases: a list of tables of parameters, each of which may be empty.
fn loads(report: &mut ProblemList, node: &Node) {
    let expected = "a list of settings [{ mass = 2 }, { mass = \"5 kg\" }]";
    let Some(items) = as_list(report, node, expected) else { return };
    report.items(items, |report, item| {
        let Some(table) = as_table(report, item, "a table such as { mass = 2 }") else { return };
        report.entries(table, |report, _, value| with_unit(report, value));
    });
    if items.is_empty() {
        report.say(format!("an empty list; must be {expected}"));
    }
}

pub(super) fn with_unit(report: &mut ProblemList, node: &Node) {
    if !matches!(node.data, Data::Number(_) | Data::Text(_)) {
        wrong(report, node, "a number, or a number with a unit such as \"0.5 deg\"");
    }
}

pub(super) fn text(report: &mut ProblemList, node: &Node, what: &str) {
    if !matches!(node.data, Data::Text(_)) {
        wrong(report, node, what);
    }
}

/// `[least, largest]` or `[least, largest, "log"]`.
fn bounds(report: &mut ProblemList, node: &Node) {
    let expected = "a list [least, largest] or [least, largest, \"log\"]";
    let Some(items) = as_list(report, node, expected) else { return };
    for (k, item) in items.iter().enumerate() {
        report.within(&k.to_string(), |report| match k {
            2 => word(report, item, &SCALES),
            _ => plain(report, item),
        });
    }
    if !(2..=3).contains(&items.len()) {
        report.say(format!("a list of {}; must be {expected}", items.len()));
    }
}

/// `"free"` or `[least, largest]`, each of which may be `"free"`.
fn range(report: &mut ProblemList, node: &Node) {
    let is_free = |node: &Node| matches!(&node.data, Data::Text(word) if word == FREE);
    let expected = "\"free\", or a list [least, largest] in which \"free\" means no bound";
    match &node.data {
        Data::List(items) if items.len() == 2 => {
            for (k, item) in items.iter().enumerate().filter(|(_, item)| !is_free(item)) {
                report.within(&k.to_string(), |report| plain(report, item));
            }
        }
        _ if is_free(node) => {}
        _ => wrong(report, node, expected),
    }
}

/// A column, a formula of columns, or a path; or a list of these.
fn objective(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) if !items.is_empty() => {
            report.items(items, one_objective);
        }
        _ => one_objective(report, node),
    }
}

fn one_objective(report: &mut ProblemList, node: &Node) {
    let table = match &node.data {
        Data::Text(_) => return,
        Data::Table(table) => table,
        _ => {
            let path = "a path { points = [[x, y]], of = \"coupler.P\" }";
            return wrong(report, node, &format!("a column such as \"C.force.max\", or {path}"));
        }
    };
    report.entries(table, |report, key, value| match key {
        "points" => points(report, value),
        "of" => text(report, value, "a point such as \"coupler.P\""),
        "angles" => numbers(report, value, None),
        _ => report.unknown("key", key, " of a path", &["points", "of", "angles"]),
    });
    report.missing(table, &["points", "of"]);
}

fn points(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of points [[x, y], [x, y]]") else { return };
    report.items(items, |report, item| numbers(report, item, Some(2)));
}
