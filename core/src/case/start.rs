//! The section `[start]`: set and guessed coordinates, and states of elements.

use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{as_table, number, wrong};
use super::Start;
use crate::elements::{Coordinate, Group};
use crate::math::ShortArray;
use crate::model::Value;

/// Reads the current value as the section `[start]` of the case with this root.
pub(super) fn read(report: &mut ProblemList, node: &Node, root: &Table) -> Start {
    let mut start = Start::default();
    let Some(table) = as_table(report, node, "a table with set and guess") else { return start };
    report.entries(table, |report, key, node| match key {
        "set" => start.set = coordinates(report, node, root),
        "guess" => start.guess = coordinates(report, node, root),
        _ => report.unknown("key", key, " of start", &["set", "guess"]),
    });
    start
}

/// Reads `{ "crank.angle" = 1 }` or the equivalent nested table `{ crank = { angle = 1 } }`, which a dotted key
/// yields; for a point, `{ crank = { B = { x = 1 } } }`.
fn coordinates(report: &mut ProblemList, node: &Node, root: &Table) -> Vec<(String, Value)> {
    let mut found: Vec<(String, Value)> = Vec::new();
    let Data::Table(table) = &node.data else {
        let form = report.example("{ \"crank.angle\" = 0 }", "{ \"crank.angle\": 0 }");
        wrong(report, node, &format!("a table such as {form}"));
        return found;
    };
    let mut seen = std::collections::HashSet::new();
    let mut take = |report: &mut ProblemList, key: String, node: &Node| {
        number(report, node);
        match seen.insert(key.clone()) {
            true => found.push((key, node.value())),
            false => report.say_of_key(format!("{} is given twice", super::shown(&key))),
        }
    };
    each(report, &table.entries, root, "", &mut take);
    found
}

/// Calls `take` for the coordinates of a table whose keys continue the name `owner`.
fn each(
    report: &mut ProblemList,
    entries: &[(String, Node)],
    root: &Table,
    owner: &str,
    take: &mut dyn FnMut(&mut ProblemList, String, &Node),
) {
    for (key, node) in entries {
        report.within(key, |report| {
            let name = if owner.is_empty() { key.clone() } else { format!("{owner}.{key}") };
            match (&node.data, name.rsplit_once('.')) {
                (Data::Table(inner), _) if goes_on(owner, key) => {
                    each(report, &inner.entries, root, &name, take);
                    return;
                }
                (_, Some(of)) => coordinate(report, root, of),
                (_, None) => report.say_of_key(format!(
                    "'{}' is not a coordinate; must be \"body.coordinate\", such as \"crank.angle\"",
                    super::shown(key)
                )),
            }
            take(report, name, node);
        });
    }
}

/// Whether a nested table may follow: that of a body or of a point of a body.
fn goes_on(owner: &str, key: &str) -> bool {
    let of_point = !owner.contains('.') && Coordinate::named(key).is_none();
    !key.contains('.') && (owner.is_empty() || of_point)
}

/// Checks the name of a coordinate. States of elements are known only to the model and are not checked here.
fn coordinate(report: &mut ProblemList, root: &Table, (owner, name): (&str, &str)) {
    if Coordinate::named(name).is_none() && !is_element(root, owner) {
        let known = Coordinate::ALL.each(Coordinate::name);
        report.unknown("coordinate", name, "", &known);
    }
}

fn is_element(root: &Table, name: &str) -> bool {
    let sections = [Group::Joints, Group::Drivers, Group::Forces].each(|g| root.get(g.section()));
    let mut sections = sections.into_iter().flatten();
    sections.any(|section| section.child(name).is_some())
}
