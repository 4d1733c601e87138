//! The structure of a case: sections, names, types, fields.

use super::bodies::Bodies;
use super::names::{self, Namespace};
use super::report::ProblemList;
use super::tree::{Data, Node, Table};
use super::values::{as_table, number, pair, word, wrong};
use super::{columns, fields, problems, start, sweep, tables, tasks};
use super::{Case, Format, FORMAT_VERSION};
use crate::analyses;
use crate::elements::{catalogue, Group, Table as Declaration};
use crate::expression::suggest::{closest, did_you_mean};
use crate::math::Listed;
use crate::model::{table_fields, Entry, Problem, Value};

/// Words for the key `redundancy`.
pub(super) const REDUNDANCY: [&str; 2] = ["refuse", "allow"];

const SECTIONS: [&str; 19] = [
    "kempe",
    "title",
    "gravity",
    "redundancy",
    "parameters",
    "tables",
    "bodies",
    "joints",
    "drivers",
    "forces",
    "measures",
    "start",
    "analyses",
    "sweep",
    "gradient",
    "optimize",
    "fit",
    "synthesis",
    "exercise",
];

/// The case that a tree contains, with the problems of its structure and the number of further problems that are not
/// kept. The case is complete if there are no problems.
pub(super) fn case(root: &Table, format: Format) -> (Case, (Vec<Problem>, usize)) {
    if let Some(problem) = newer(root) {
        return (Case::default(), (vec![problem], 0));
    }
    let mut report = ProblemList::new(format);
    version(&mut report, root);
    for problem in refused(root, format).0 {
        report.add(problem);
    }
    let mut case = Case::default();
    let mut namespace = Namespace::default();
    report.entries(root, |report, key, node| {
        section(report, (key, node), root, &mut case, &mut namespace)
    });
    (case, report.finish())
}

fn section(
    report: &mut ProblemList,
    (key, node): (&str, &Node),
    root: &Table,
    case: &mut Case,
    namespace: &mut Namespace,
) {
    let model = &mut case.definition;
    match key {
        "kempe" => {}
        "title" => match &node.data {
            Data::Text(title) => model.title = Some(title.clone()),
            _ => wrong(report, node, "a text"),
        },
        "gravity" => {
            pair(report, node);
            model.gravity = Some(node.value());
        }
        "redundancy" => {
            word(report, node, &REDUNDANCY);
            if let Data::Text(word) = &node.data {
                model.redundancy = Some(word.clone());
            }
        }
        "parameters" => model.parameters = parameters(report, node),
        "tables" => {
            let declared = table_fields();
            model.tables = entries(report, node, |report, name, table| {
                tables::check(report, name, (table, &declared), root);
            });
        }
        "bodies" => {
            let bodies = Bodies::declared();
            model.bodies = entries(report, node, |report, name, table| {
                namespace.take(report, name, "body");
                bodies.check(report, name, table);
            });
        }
        "joints" => model.joints = elements(report, node, Group::Joints, namespace),
        "drivers" => model.drivers = elements(report, node, Group::Drivers, namespace),
        "forces" => model.forces = elements(report, node, Group::Forces, namespace),
        "measures" => model.measures = measures(report, node, namespace),
        "start" => case.start = start::read(report, node, root),
        "analyses" => case.analyses = analyses(report, node),
        "sweep" => case.sweep = sweep::read(report, node, root),
        "gradient" => case.gradient = columns::gradient(report, node, root),
        "optimize" => case.optimize = problems::optimize(report, node, root),
        "fit" => case.fit = problems::fit(report, node, root),
        "synthesis" => case.synthesis = tasks::synthesis(report, node, root),
        "exercise" => case.exercise = tasks::exercise(report, node, root),
        _ => unknown(report, key),
    }
}

/// Reports a key that is no section.
fn unknown(report: &mut ProblemList, key: &str) {
    let message = format!("unknown key '{}'", super::shown(key));
    // the key may be the singular of a section, or a part of its name
    let near = SECTIONS.iter().filter(|s| key.len() > 2 && s.get(..3) == key.get(..3)).list();
    match closest(key, &near).or_else(|| near.first().map(|s| (**s).to_string())) {
        Some(meant) => {
            let hint = format!("did you mean '{meant}'?");
            report.add(report.here(message).at_key().hint(hint));
        }
        None => report.unknown_key(message, key, &SECTIONS),
    }
}

fn newer(root: &Table) -> Option<Problem> {
    match root.get("kempe")?.data {
        Data::Number(x) if x > f64::from(FORMAT_VERSION) && x.fract() == 0.0 => {
            let message = format!("this file is format {x}; this kempe reads {FORMAT_VERSION}");
            Some(Problem::at(&["kempe"], message).hint("update kempe"))
        }
        _ => None,
    }
}

fn version(report: &mut ProblemList, root: &Table) {
    let first = [format!("kempe = {FORMAT_VERSION}"), format!("\"kempe\": {FORMAT_VERSION}")];
    let hint = format!("write `{}` as the first line", report.example(&first[0], &first[1]));
    report.within("kempe", |report| match root.get("kempe").map(|node| (&node.data, node)) {
        None if root.entries.iter().any(|(key, _)| closest(key, ["kempe"]).is_some()) => {}
        None => report
            .add(report.here("missing; a case begins with the version of its format").hint(hint)),
        Some((Data::Number(x), _)) if *x == f64::from(FORMAT_VERSION) => {}
        Some((Data::Number(x), _)) => {
            let message = format!("there is no format {x}; this kempe reads {FORMAT_VERSION}");
            report.add(report.here(message).hint(hint));
        }
        Some((_, node)) => wrong(report, node, &format!("the number {FORMAT_VERSION}")),
    });
}

/// The problems of all values that a case must not contain.
pub(super) fn refused(root: &Table, format: Format) -> (Vec<Problem>, usize) {
    let mut report = ProblemList::new(format);
    refused_in(&mut report, root);
    report.finish()
}

fn refused_in(report: &mut ProblemList, table: &Table) {
    report.entries(table, |report, _, node| refused_at(report, node));
}

fn refused_at(report: &mut ProblemList, node: &Node) {
    match &node.data {
        Data::Refused(reason) => report.say(reason.clone()),
        Data::Table(table) => refused_in(report, table),
        Data::List(items) => {
            report.items(items, refused_at);
        }
        _ => {}
    }
}

fn parameters(report: &mut ProblemList, node: &Node) -> Vec<(String, Value)> {
    let Some(table) = as_table(report, node, "a table of names and numbers") else {
        return Vec::new();
    };
    report.entries(table, |report, name, value| {
        names::unreserved_key(report, name);
        number(report, value);
    });
    table.values()
}

fn measures(
    report: &mut ProblemList,
    node: &Node,
    namespace: &mut Namespace,
) -> Vec<(String, Value)> {
    let Some(table) = as_table(report, node, "a table of names and expressions") else {
        return Vec::new();
    };
    report.entries(table, |report, name, value| {
        namespace.take(report, name, "measure");
        if !matches!(value.data, Data::Text(_)) {
            wrong(report, value, "an expression of quantities, such as \"C.force\"");
        }
    });
    table.values()
}

/// Reads the named tables of a section, each checked by `check`.
fn entries(
    report: &mut ProblemList,
    node: &Node,
    mut check: impl FnMut(&mut ProblemList, &str, &Table),
) -> Vec<Entry> {
    let Data::Table(section) = &node.data else {
        let problem = report.here(format!("{}; must be a table of named tables", node.noun()));
        if !matches!(node.data, Data::Refused(_)) {
            let key = report.key();
            let [toml, json] =
                [format!("[{key}.NAME]"), format!("\"{key}\": {{ \"NAME\": {{ }} }}")];
            let form = report.example(&toml, &json);
            report.add(problem.hint(format!("write {form} for each")));
        }
        return Vec::new();
    };
    let mut found = Vec::with_capacity(section.entries.len());
    report.entries(section, |report, name, node| match &node.data {
        Data::Table(table) => {
            check(report, name, table);
            found.push(Entry { name: name.to_string(), fields: table.values() });
        }
        _ => wrong(report, node, "a table with fields"),
    });
    found
}

fn elements(
    report: &mut ProblemList,
    node: &Node,
    group: Group,
    namespace: &mut Namespace,
) -> Vec<Entry> {
    let known: Vec<Declaration> =
        catalogue().into_iter().filter(|(g, _)| *g == group).map(|(_, table)| table).list();
    let known: Vec<&Declaration> = known.iter().list();
    entries(report, node, |report, name, table| {
        namespace.take(report, name, group.singular());
        if let Some(declared) = fields::declared(report, table, &known, group.singular(), None) {
            fields::check(report, table, declared, true);
        }
    })
}

fn analyses(report: &mut ProblemList, node: &Node) -> Vec<Entry> {
    let mut earlier: Vec<String> = vec!["start".to_string()];
    entries(report, node, |report, name, table| {
        match name {
            "start" => report.say_of_key("'start' is where a case starts and cannot be a name"),
            _ => names::folder(report, name, &earlier),
        }
        fields::options(report, table, analyses::declarations(), "analysis");
        from(report, table, &earlier);
        earlier.push(name.to_string());
    })
}

/// `from` must name the start or an earlier analysis.
fn from(report: &mut ProblemList, table: &Table, earlier: &[String]) {
    let Some(Node { data: Data::Text(name), .. }) = table.get("from") else { return };
    if !earlier.contains(name) {
        let hint = did_you_mean(name, earlier)
            .unwrap_or_else(|| "write \"start\" or the name of an earlier analysis".to_string());
        report.within("from", |report| {
            let message = format!("no earlier analysis '{}'", super::shown(name));
            report.add(report.here(message).hint(hint));
        });
    }
}
