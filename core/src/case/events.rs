//! Checks of the events of an analysis.

use super::names;
use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{as_table, word, wrong};
use crate::analyses::{is_count, DIRECTIONS, STOPS};
use crate::math::ShortArray;

/// The fields of an event.
pub(super) const FIELDS: [&str; 3] = ["condition", "direction", "stop"];

/// Checks events by name. Each is a condition, or a table that contains a condition.
pub(super) fn events(report: &mut ProblemList, node: &Node) {
    let form = report
        .example("{ hit = \"rocker.angle > 270*deg\" }", "{ \"hit\": \"rocker.angle > 270*deg\" }");
    let Some(table) = as_table(report, node, &format!("a table of events such as {form}")) else {
        return;
    };
    report.entries(table, |report, name, node| {
        names::key(report, name);
        match &node.data {
            Data::Text(_) => {}
            Data::Table(fields) => event(report, fields),
            _ => wrong(report, node, "a condition, or a table with one"),
        }
    });
}

fn event(report: &mut ProblemList, table: &Table) {
    if table.get("condition").is_none() {
        report.within("condition", |report| report.say("missing; an event needs a condition"));
    }
    report.entries(table, |report, key, node| match (key, &node.data) {
        ("condition", Data::Text(_)) | ("stop", Data::Flag(_)) => {}
        ("stop", Data::Number(count)) if is_count(*count) => {}
        ("condition", _) => wrong(report, node, "a condition \"crank.angle > 270*deg\""),
        ("stop", _) => wrong(report, node, STOPS.trim_start_matches("must be ")),
        ("direction", _) => word(report, node, &DIRECTIONS.each(|(word, _)| word)),
        _ => report.unknown("field", key, " of an event", &FIELDS),
    });
}
