//! Checks the fields of an element, body, analysis or set of options against its declaration.

use super::events::events;
use super::report::{among, ProblemList};
use super::tree::{Data, Node, Table};
use super::values::{
    as_table, corners, count, curves, names, number, numbers, outline, pair, plain_numbers, points,
    quantities, ranges, section, terms, tolerance, triple, two_columns, two_names, two_texts,
    units, word, wrong, TERMS,
};
use crate::analyses::options::Declaration as Options;
use crate::analyses::{declarations, option_families};
use crate::elements::{catalogue, Field, Shape, Table as Declaration};
use crate::expression::suggest::{closest, did_you_mean};
use crate::math::Listed;
use crate::model::{body_tables, shape_tables};

/// The declaration with the `type` of the current table.
pub(super) fn declared<'d>(
    report: &mut ProblemList,
    table: &Table,
    known: &[&'d Declaration],
    noun: &str,
    absent: Option<&'d Declaration>,
) -> Option<&'d Declaration> {
    let names: Vec<&str> = known.iter().map(|d| d.name).list();
    let Some(node) = table.get("type") else {
        let mut keys = table.entries.iter().map(|(key, _)| key.as_str());
        if let Some(key) = keys.find(|key| closest(key, ["type"]).is_some()) {
            let of = format!(" of {noun}");
            report.within(key, |report| report.unknown("field", key, &of, &["type"]));
            return None;
        }
        if absent.is_none() {
            let problem = report.within("type", |report| report.here("missing"));
            let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).list();
            let quoted: Vec<&str> = quoted.iter().map(String::as_str).list();
            let key = report.example("write type =", "write \"type\":");
            report.add(problem.hint(among(&key, &quoted)));
        }
        return absent;
    };
    report.within("type", |report| {
        let Data::Text(name) = &node.data else {
            wrong(report, node, "a text");
            return None;
        };
        let found = known.iter().copied().find(|d| d.name == name);
        if found.is_none() {
            let hint = belongs(report, name)
                .or_else(|| did_you_mean(name, &names))
                .unwrap_or_else(|| among("it may be", &names));
            let message = format!("unknown type of {noun} '{}'", super::shown(name));
            report.add(report.here(message).hint(hint));
        }
        found
    })
}

/// A hint with the correct section for a type in the wrong section.
fn belongs(report: &ProblemList, name: &str) -> Option<String> {
    let elements = catalogue().into_iter().map(|(group, table)| (group.section(), table.name));
    let bodies = body_tables().into_iter().map(|table| ("bodies", table.name));
    let analyses = declarations().iter().map(|declared| ("analyses", declared.table.name));
    let (section, _) = elements.chain(bodies).chain(analyses).find(|(_, known)| *known == name)?;
    let place = report.example(&format!("[{section}]"), &format!("\"{section}\""));
    (name != "ground").then(|| format!("'{name}' belongs in {place}"))
}

/// Checks that the fields of the current table are known, have the declared shape and are complete.
pub(super) fn check(report: &mut ProblemList, table: &Table, declared: &Declaration, typed: bool) {
    let mut known: Vec<&str> = declared.fields.iter().map(|f| f.name).list();
    if typed {
        known.push("type");
    }
    let mut meant = Vec::new(); // fields with misspelt keys; they are not reported as missing
    report.entries(table, |report, key, node| {
        match declared.fields.iter().find(|f| f.name == key) {
            Some(field) => shape(report, node, field.shape),
            None if typed && key == "type" => {}
            None => {
                report.unknown("field", key, &format!(" of {}", declared.name), &known);
                meant.extend(closest(key, &known));
            }
        }
    });
    for field in declared.fields.iter().filter(|f| f.default.is_none()) {
        if table.get(field.name).is_none() && !meant.iter().any(|key| key == field.name) {
            report.within(field.name, |report| {
                let message = format!("missing; {} needs it", declared.name);
                report.add(report.here(message).hint(meaning(field)));
            });
        }
    }
}

/// Checks the current value.
pub(super) fn shape(report: &mut ProblemList, node: &Node, shape: Shape) {
    match (shape, &node.data) {
        (_, Data::Refused(_)) => {}
        (Shape::Number | Shape::Law, _) => number(report, node),
        (Shape::Pair | Shape::LawPair, _) => pair(report, node),
        (Shape::Ranges, _) => ranges(report, node),
        (Shape::Triple, _) => triple(report, node),
        (Shape::Laws, _) => numbers(report, node),
        (Shape::Terms, _) => terms(report, node, TERMS),
        (Shape::Units, _) => units(report, node),
        (Shape::Points, _) => points(report, node),
        (Shape::Curves, _) => curves(report, node),
        (Shape::Shapes, _) => shapes(report, node),
        (Shape::Outline, _) => outline(report, node),
        (Shape::Section, _) => section(report, node),
        (Shape::Corners, _) => corners(report, node),
        (Shape::Names, _) => two_names(report, node),
        (Shape::TwoTexts, _) => two_texts(report, node),
        (Shape::Numbers, _) => plain_numbers(report, node),
        (Shape::Columns, _) => two_columns(report, node),
        (Shape::Count, _) => count(report, node),
        (Shape::Tolerance, _) => tolerance(report, node),
        (Shape::Word(words), _) => word(report, node, words),
        (Shape::Options(family), _) => chosen(report, node, family),
        (Shape::Flag, Data::Flag(_)) => {}
        (Shape::Flag, _) => wrong(report, node, "true or false"),
        (Shape::Curve, Data::Text(_)) => {}
        (Shape::Curve, _) => wrong(report, node, "a curve as \"body.curve\""),
        (
            Shape::Body | Shape::Point | Shape::Coordinate | Shape::Joint | Shape::Name,
            Data::Text(_),
        ) => {}
        (Shape::Body, _) => wrong(report, node, "the name of a body"),
        (Shape::Point, _) => wrong(report, node, "a point as \"body.point\""),
        (Shape::Coordinate, _) => wrong(report, node, "a coordinate as \"body.angle\""),
        (Shape::Joint, _) => wrong(report, node, "the name of a joint"),
        (Shape::Name, _) => wrong(report, node, "a name"),
        (Shape::NameList, _) => names(report, node),
        (Shape::Quantities, _) => quantities(report, node),
        (Shape::Condition, Data::Text(_)) => {}
        (Shape::Condition, _) => wrong(report, node, "a condition \"crank.angle > 270*deg\""),
        (Shape::Events, _) => events(report, node),
        (Shape::Values, _) => terms(report, node, ["{ k = 2e6 }", "{ \"k\": 2e6 }"]),
    }
}

/// Checks the shapes of a body. The model checks which fields of a shape may be combined.
fn shapes(report: &mut ProblemList, node: &Node) {
    let form = report.example(
        "{ type = \"disc\", radius = 0.1, mass = 1 }",
        "{ \"type\": \"disc\", \"radius\": 0.1, \"mass\": 1 }",
    );
    let items = match &node.data {
        Data::List(items) if !items.is_empty() => items,
        Data::List(_) => {
            return report.say(format!("an empty list; must hold shapes such as {form}"))
        }
        _ => return wrong(report, node, &format!("a list of shapes such as [{form}]")),
    };
    let known = shape_tables();
    let known: Vec<&Declaration> = known.iter().list();
    for (k, item) in items.iter().enumerate() {
        report.within(&k.to_string(), |report| {
            let Some(table) = as_table(report, item, &format!("a shape such as {form}")) else {
                return;
            };
            let noun = format!("shape {}", k + 1);
            if let Some(declared) = declared(report, table, &known, &noun, None) {
                check(report, table, declared, true);
            }
        });
    }
}

/// Checks the current value as a set of options of a family.
fn chosen(report: &mut ProblemList, node: &Node, family: &str) {
    let Some(family) = option_families().iter().find(|f| f.name == family) else { return };
    match &node.data {
        Data::Table(table) => options(report, table, &family.options, family.name),
        _ => {
            let example = family.options[0].table.name;
            let toml = format!("{{ type = \"{example}\" }}");
            let form = report.example(&toml, &format!("{{ \"type\": \"{example}\" }}"));
            wrong(report, node, &format!("a table such as {form}"));
        }
    }
}

/// Checks the current table as one of the `known` sets of options.
pub(super) fn options(report: &mut ProblemList, table: &Table, known: &[Options], noun: &str) {
    let tables: Vec<&Declaration> = known.iter().map(|options| &options.table).list();
    let Some(declared) = declared(report, table, &tables, noun, None) else { return };
    check(report, table, declared, true);
    let own = known.iter().filter(|options| options.table.name == declared.name);
    for (one, others) in own.flat_map(|options| options.excludes) {
        for other in others.iter().filter(|_| table.get(one).is_some()) {
            if table.get(other).is_some() {
                report.within(other, |report| {
                    report.say(format!("not together with {one}; remove one of them"));
                });
            }
        }
    }
}

/// The description of a field, with its unit.
fn meaning(field: &Field) -> String {
    let words = field.doc.lines().next().unwrap_or_default().trim_end_matches('.');
    match field.unit.as_str() {
        "" => format!("{}: {words}", field.name),
        unit => format!("{}: {words} ({unit})", field.name),
    }
}
