//! The section `[start]`: coordinates that are set and guessed.

use super::report::Report;
use super::tree::{Data, Node};
use super::values::{number, wrong};
use super::Start;
use crate::elements::Coordinate;
use crate::model::Value;

/// Reads the present value as the section.
pub(super) fn read(report: &mut Report, node: &Node) -> Start {
    let mut start = Start::default();
    let Data::Table(table) = &node.data else {
        wrong(report, node, "a table with set and guess");
        return start;
    };
    for (key, node) in &table.entries {
        report.within(key, |report| match key.as_str() {
            "set" => start.set = coordinates(report, node),
            "guess" => start.guess = coordinates(report, node),
            _ => {
                let message = format!("unknown key '{}' of start", super::shown(key));
                report.unknown_key(message, key, &["set", "guess"]);
            }
        });
    }
    start
}

/// `{ "crank.angle" = 1 }` or `{ crank = { angle = 1 } }`, which a dotted key means.
fn coordinates(report: &mut Report, node: &Node) -> Vec<(String, Value)> {
    let mut found: Vec<(String, Value)> = Vec::new();
    let Data::Table(table) = &node.data else {
        wrong(report, node, "a table such as { \"crank.angle\" = 0 }");
        return found;
    };
    let mut seen = std::collections::HashSet::new();
    let mut take = |report: &mut Report, key: String, node: &Node| {
        number(report, node);
        match seen.insert(key.clone()) {
            true => found.push((key, node.value())),
            false => report.say_of_key(format!("{} is given twice", super::shown(&key))),
        }
    };
    for (key, node) in &table.entries {
        report.within(key, |report| match &node.data {
            Data::Table(of_body) => {
                for (name, node) in &of_body.entries {
                    report.within(name, |report| {
                        coordinate(report, name);
                        take(report, format!("{key}.{name}"), node);
                    });
                }
            }
            _ => {
                match key.split_once('.') {
                    Some((_, name)) => coordinate(report, name),
                    None => report.say_of_key(format!(
                        "'{}' is no coordinate; must be \"body.coordinate\", such as \"crank.angle\"",
                        super::shown(key)
                    )),
                }
                take(report, key.clone(), node);
            }
        });
    }
    found
}

fn coordinate(report: &mut Report, name: &str) {
    if Coordinate::named(name).is_none() {
        let known = Coordinate::ALL.map(Coordinate::name);
        report.unknown_key(format!("unknown coordinate '{}'", super::shown(name)), name, &known);
    }
}
