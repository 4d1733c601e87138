//! What may stand in a field: the shape of a value against its declaration.

use super::fields;
use super::names;
use super::report::{among, Report};
use super::tree::{Data, Node};
use crate::analyses::option_families;
use crate::elements::Shape;
use crate::expression::suggest::did_you_mean;

/// Checks the present value.
pub(super) fn shape(report: &mut Report, node: &Node, shape: Shape) {
    match (shape, &node.data) {
        (_, Data::Refused(_)) => {}
        (Shape::Number | Shape::Law, _) => number(report, node),
        (Shape::Pair, _) => pair(report, node),
        (Shape::Points, _) => points(report, node),
        (Shape::Names, _) => two_names(report, node),
        (Shape::Count, _) => count(report, node),
        (Shape::Word(words), _) => word(report, node, words),
        (Shape::Options(family), _) => options(report, node, family),
        (Shape::Flag, Data::Flag(_)) => {}
        (Shape::Flag, _) => wrong(report, node, "true or false"),
        (Shape::Body | Shape::Point | Shape::Coordinate | Shape::Name, Data::Text(_)) => {}
        (Shape::Body, _) => wrong(report, node, "the name of a body"),
        (Shape::Point, _) => wrong(report, node, "a point as \"body.point\""),
        (Shape::Coordinate, _) => wrong(report, node, "a coordinate as \"body.angle\""),
        (Shape::Name, _) => wrong(report, node, "a name"),
    }
}

/// Reports that something else must stand here.
pub(super) fn wrong(report: &mut Report, node: &Node, wanted: &str) {
    if !matches!(node.data, Data::Refused(_)) {
        report.say(format!("{}; must be {wanted}", node.noun()));
    }
}

/// A number or a formula.
pub(super) fn number(report: &mut Report, node: &Node) {
    if !matches!(node.data, Data::Number(_) | Data::Text(_)) {
        wrong(report, node, "a number or a formula");
    }
}

fn pair(report: &mut Report, node: &Node) {
    match &node.data {
        Data::List(items) if items.len() == 2 => {
            for (k, item) in items.iter().enumerate() {
                report.within(&k.to_string(), |report| number(report, item));
            }
        }
        Data::List(items) => {
            report.say(format!("a list of {}; must be a list of two numbers [x, y]", items.len()));
        }
        _ => wrong(report, node, "a list of two numbers [x, y]"),
    }
}

fn points(report: &mut Report, node: &Node) {
    let Data::Table(table) = &node.data else {
        return wrong(report, node, "a table of points { P = [x, y] }");
    };
    for (name, point) in &table.entries {
        report.within(name, |report| {
            names::key(report, name);
            pair(report, point);
        });
    }
}

fn two_names(report: &mut Report, node: &Node) {
    let Data::List(items) = &node.data else {
        return wrong(report, node, "a list of two names [\"A\", \"B\"]");
    };
    if items.len() != 2 {
        return report.say(format!("a list of {}; must be a list of two names", items.len()));
    }
    for (k, item) in items.iter().enumerate() {
        report.within(&k.to_string(), |report| match &item.data {
            Data::Text(name) => names::value(report, name),
            _ => wrong(report, item, "a name"),
        });
    }
    if let (Data::Text(a), Data::Text(b)) = (&items[0].data, &items[1].data) {
        if a == b {
            report.say(format!("both are '{}'; must be two different names", super::shown(a)));
        }
    }
}

fn count(report: &mut Report, node: &Node) {
    match &node.data {
        Data::Number(x) if x.fract() != 0.0 || *x < 1.0 => {
            report.say(format!("{x}; must be a whole number from 1"));
        }
        _ => number(report, node),
    }
}

fn word(report: &mut Report, node: &Node, words: &[&str]) {
    match &node.data {
        Data::Text(text) if words.contains(&text.as_str()) => {}
        Data::Text(text) => {
            let problem = report.here(format!("unknown word '{}'", super::shown(text)));
            let hint = did_you_mean(text, words).unwrap_or_else(|| among("it may be", words));
            report.add(problem.hint(hint));
        }
        _ => wrong(report, node, &among("the word", words)),
    }
}

fn options(report: &mut Report, node: &Node, family: &str) {
    let Some(family) = option_families().iter().find(|f| f.name == family) else { return };
    let tables: Vec<_> = family.options.iter().map(|o| &o.table).collect();
    let Data::Table(table) = &node.data else {
        let example = format!("a table such as {{ type = \"{}\" }}", tables[0].name);
        return wrong(report, node, &example);
    };
    if let Some(declared) = fields::declared(report, table, &tables, family.name, None) {
        fields::check(report, table, declared, true);
    }
}
