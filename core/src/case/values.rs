//! Checks of the values of a file against the allowed shapes.

use super::names;
use super::report::{among, ProblemList};
use super::tree::{Data, Node, Table};
use crate::elements::{CURVE_FORMS, TOLERANCES, UNITS_OF_EQUATIONS};
use crate::expression::suggest::{did_you_mean, frame_meant};
use crate::math::Listed;

/// Reports a value of the wrong shape.
pub(super) fn wrong(report: &mut ProblemList, node: &Node, expected: &str) {
    if !matches!(node.data, Data::Refused(_)) {
        report.say(format!("{}; must be {expected}", node.noun()));
    }
}

/// The items of a list. Reports a value that is no list.
pub(super) fn as_list<'n>(
    report: &mut ProblemList,
    node: &'n Node,
    expected: &str,
) -> Option<&'n [Node]> {
    match &node.data {
        Data::List(items) => Some(items),
        _ => {
            wrong(report, node, expected);
            None
        }
    }
}

/// A table. Reports a value that is no table.
pub(super) fn as_table<'n>(
    report: &mut ProblemList,
    node: &'n Node,
    expected: &str,
) -> Option<&'n Table> {
    match &node.data {
        Data::Table(table) => Some(table),
        _ => {
            wrong(report, node, expected);
            None
        }
    }
}

/// A number or a formula.
pub(super) fn number(report: &mut ProblemList, node: &Node) {
    if !matches!(node.data, Data::Number(_) | Data::Text(_)) {
        wrong(report, node, "a number or a formula");
    }
}

/// Two numbers.
pub(super) fn pair(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) if items.len() == 2 => {
            report.items(items, number);
        }
        Data::List(items) => {
            let n = items.len();
            // [0,5, 0] is a slip for [0.5, 0]
            let point = if n > 2 { "; the decimal mark is a point" } else { "" };
            report.say(format!("a list of {n}; must be a list of two numbers [x, y]{point}"));
        }
        _ => wrong(report, node, "a list of two numbers [x, y]"),
    }
}

/// A list of pairs.
pub(super) fn ranges(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of ranges [[first, last], [first, last]]")
    else {
        return;
    };
    report.items(items, pair);
}

/// Three numbers or formulas.
pub(super) fn triple(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) if items.len() == 3 => numbers(report, node),
        Data::List(items) => {
            report.say(format!("a list of {}; must be a list of three numbers", items.len()));
        }
        _ => wrong(report, node, "a list of three numbers"),
    }
}

/// At least one number or formula.
pub(super) fn numbers(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) if !items.is_empty() => {
            report.items(items, number);
        }
        Data::List(_) => report.say("an empty list; must be a list of formulas".to_string()),
        _ => wrong(report, node, "a list of formulas [\"…\"]"),
    }
}

/// A table of position quantities in TOML and in JSON.
pub(super) const TERMS: [&str; 2] =
    ["{ \"A.angle\" = 2, \"B.angle\" = -1 }", "{ \"A.angle\": 2, \"B.angle\": -1 }"];

/// At least one name with a number or formula. `toml` and `json` are examples of the table.
pub(super) fn terms(report: &mut ProblemList, node: &Node, [toml, json]: [&str; 2]) {
    let form = report.example(toml, json);
    match &node.data {
        Data::Table(table) if !table.entries.is_empty() => {
            report.entries(table, |report, _, node| number(report, node));
        }
        Data::Table(_) => report.say(format!("an empty table; must be a table such as {form}")),
        _ => wrong(report, node, &format!("a table such as {form}")),
    }
}

/// Units of equations.
pub(super) fn units(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) => {
            report.items(items, |report, item| word(report, item, UNITS_OF_EQUATIONS));
        }
        _ => wrong(report, node, "a list of units [\"m\"]"),
    }
}

/// Named points.
pub(super) fn points(report: &mut ProblemList, node: &Node) {
    let Data::Table(table) = &node.data else {
        let form = report.example("{ P = [x, y] }", "{ \"P\": [x, y] }");
        return wrong(report, node, &format!("a table of points {form}"));
    };
    report.entries(table, |report, name, point| {
        names::key(report, name);
        pair(report, point);
    });
}

/// Named curves; the model checks the values of each.
pub(super) fn curves(report: &mut ProblemList, node: &Node) {
    let form = report.example("{ circle = [x, y, radius] }", "{ \"circle\": [x, y, radius] }");
    let Some(table) = as_table(report, node, &format!("a table of curves such as rim = {form}"))
    else {
        return;
    };
    let known: Vec<&str> =
        CURVE_FORMS.iter().flat_map(|form| form.keys.iter().chain(form.more)).copied().list();
    report.entries(table, |report, name, curve| {
        names::key(report, name);
        let Some(fields) = as_table(report, curve, &format!("a curve such as {form}")) else {
            return;
        };
        for (key, _) in fields.entries.iter().filter(|(key, _)| !known.contains(&key.as_str())) {
            report.within(key, |report| report.unknown("field", key, " of a curve", &known));
        }
    });
}

/// Points without names, at least three.
pub(super) fn corners(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::List(items) if items.len() >= 3 => {
            report.items(items, pair);
        }
        Data::List(items) => {
            report.say(format!(
                "a list of {}; must be at least three points [[x, y], …]",
                items.len()
            ));
        }
        _ => wrong(report, node, "a list of points [[x, y], …]"),
    }
}

/// Points, a circle or a path; the model checks the text of a path.
pub(super) fn outline(report: &mut ProblemList, node: &Node) {
    let Data::Table(table) = &node.data else {
        if let Data::List(_) = node.data {
            return corners(report, node);
        }
        let circle = report.example("{ circle = [x, y, r] }", "{ \"circle\": [x, y, r] }");
        let path = report.example("{ path = \"M 0 0 L …\" }", "{ \"path\": \"M 0 0 L …\" }");
        return wrong(report, node, &format!("points [[x, y], …], {circle} or {path}"));
    };
    report.entries(table, |report, key, value| match (key, &value.data) {
        ("circle", _) => triple(report, value),
        ("path", Data::Text(_)) => {}
        ("path", _) => wrong(report, value, "the path data of SVG as a text"),
        _ => report.unknown("field", key, " of an outline", &["circle", "path"]),
    });
    if table.entries.len() != 1 {
        report.say(format!("a table of {}; must have either circle or path", table.entries.len()));
    }
}

/// Two different names.
pub(super) fn two_names(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of two names [\"A\", \"B\"]") else { return };
    if items.len() != 2 {
        return report.say(format!("a list of {}; must be a list of two names", items.len()));
    }
    report.items(items, |report, item| match &item.data {
        Data::Text(name) => names::value(report, name),
        _ => wrong(report, item, "a name"),
    });
    if let (Data::Text(a), Data::Text(b)) = (&items[0].data, &items[1].data) {
        if a == b {
            report.say(format!("both are '{}'; must be two different names", super::shown(a)));
        }
    }
}

/// Two texts, such as the names of curves.
pub(super) fn two_texts(report: &mut ProblemList, node: &Node) {
    let two = |items: &[Node]| {
        items.len() == 2 && items.iter().all(|item| matches!(item.data, Data::Text(_)))
    };
    match &node.data {
        Data::List(items) if two(items) => {}
        _ => wrong(report, node, "a list of two texts [\"cam.rim\", \"pawl.tip\"]"),
    }
}

/// A cross section of a beam.
pub(super) fn section(report: &mut ProblemList, node: &Node) {
    let known = ["rectangle", "circle", "tube"];
    let form = report.example("{ rectangle = [0.01, 0.02] }", "{ \"rectangle\": [0.01, 0.02] }");
    let Some(table) = as_table(report, node, &format!("a section such as {form}")) else { return };
    report.entries(table, |report, key, value| match key {
        "rectangle" | "tube" => pair(report, value),
        "circle" => number(report, value),
        _ => report.unknown("section", key, "", &known),
    });
    if table.entries.len() != 1 {
        report.say(format!("must have exactly one of rectangle, circle and tube, such as {form}"));
    }
}

/// Any number of names.
pub(super) fn names(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of names [\"crank_drive\"]") else { return };
    report.items(items, |report, item| match &item.data {
        Data::Text(name) => names::value(report, name),
        _ => wrong(report, item, "a name"),
    });
}

/// Any number of quantities.
pub(super) fn quantities(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of quantities [\"crank.angle\"]") else {
        return;
    };
    report.items(items, |report, item| match &item.data {
        Data::Text(_) => {}
        _ => wrong(report, item, "a quantity as \"crank.angle\""),
    });
}

/// Numbers, not formulas.
pub(super) fn plain_numbers(report: &mut ProblemList, node: &Node) {
    let Some(items) = as_list(report, node, "a list of numbers") else { return };
    report.items(items, |report, item| match &item.data {
            Data::Number(_) => {}
            Data::Text(_) => {
                let hint = "units are given by x_unit and y_unit; a parameter multiplies the function, as in h*lift(x)";
                report.add(report.here("a text; must be a number").hint(hint));
            }
            _ => wrong(report, item, "a number"),
        });
}

/// Two different names of columns, of any characters.
pub(super) fn two_columns(report: &mut ProblemList, node: &Node) {
    let texts = match &node.data {
        Data::List(items) => items.iter().map(|item| match &item.data {
            Data::Text(text) => Some(text),
            _ => None,
        }),
        _ => return wrong(report, node, "a list of two columns [\"angle\", \"lift\"]"),
    };
    match texts.list()[..] {
        [Some(x), Some(y)] if x != y => {}
        _ => report.say("must be a list of two different names of columns [\"angle\", \"lift\"]"),
    }
}

/// A whole number from 1, or a formula.
pub(super) fn count(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::Number(x) if x.fract() != 0.0 || *x < 1.0 => {
            report.say(format!("{x}; must be a whole number from 1"));
        }
        _ => number(report, node),
    }
}

/// A number, or a table with a number for each kind of quantity.
pub(super) fn tolerance(report: &mut ProblemList, node: &Node) {
    let Data::Table(table) = &node.data else {
        if !matches!(node.data, Data::Number(_) | Data::Text(_)) {
            wrong(report, node, "a number, or a table such as { length = 1e-9, angle = 1e-9 }");
        }
        return;
    };
    report.entries(table, |report, key, value| match TOLERANCES.contains(&key) {
        true => number(report, value),
        false => report.unknown("kind", key, " of tolerance", &TOLERANCES),
    });
}

/// One of the `words`.
pub(super) fn word(report: &mut ProblemList, node: &Node, words: &[&str]) {
    match &node.data {
        Data::Text(text) if words.contains(&text.as_str()) => {}
        Data::Text(text) => {
            let problem = report.here(format!("unknown word '{}'", super::shown(text)));
            let hint = frame_meant(text, words).or_else(|| did_you_mean(text, words));
            let hint = hint.unwrap_or_else(|| among("it may be", words));
            report.add(problem.hint(hint));
        }
        _ => wrong(report, node, &among("the word", words)),
    }
}
