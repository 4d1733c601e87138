//! The fields of an element, body, analysis or set of options against its declaration.

use super::report::{among, Report};
use super::shapes::{shape, wrong};
use super::tree::{Data, Table};
use crate::analyses::analysis_tables;
use crate::elements::{catalogue, Field, Table as Declaration};
use crate::expression::suggest::{closest, did_you_mean};
use crate::model::body_tables;

/// The declaration that the `type` of the present table names.
pub(super) fn declared<'d>(
    report: &mut Report,
    table: &Table,
    known: &[&'d Declaration],
    noun: &str,
    absent: Option<&'d Declaration>,
) -> Option<&'d Declaration> {
    let names: Vec<&str> = known.iter().map(|d| d.name).collect();
    let Some(node) = table.get("type") else {
        if absent.is_none() {
            let problem = report.within("type", |report| report.here("missing"));
            let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            let quoted: Vec<&str> = quoted.iter().map(String::as_str).collect();
            report.add(problem.hint(among("write type =", &quoted)));
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
            let hint = belongs(name)
                .or_else(|| did_you_mean(name, &names))
                .unwrap_or_else(|| among("it may be", &names));
            let message = format!("unknown type of {noun} '{}'", super::shown(name));
            report.add(report.here(message).hint(hint));
        }
        found
    })
}

/// Where a type belongs that stands in the wrong section.
fn belongs(name: &str) -> Option<String> {
    let elements = catalogue().into_iter().map(|(group, table)| (group.section(), table.name));
    let bodies = body_tables().into_iter().map(|table| ("bodies", table.name));
    let analyses = analysis_tables().iter().map(|table| ("analyses", table.name));
    let (section, _) = elements.chain(bodies).chain(analyses).find(|(_, known)| *known == name)?;
    (name != "ground").then(|| format!("'{name}' belongs in [{section}]"))
}

/// Checks that the fields of the present table are known, of the right shape and complete.
pub(super) fn check(report: &mut Report, table: &Table, declared: &Declaration, typed: bool) {
    let mut known: Vec<&str> = declared.fields.iter().map(|f| f.name).collect();
    if typed {
        known.push("type");
    }
    let mut meant = Vec::new(); // by keys that are misspelt: these are not missing as well
    for (key, node) in &table.entries {
        report.within(key, |report| match declared.fields.iter().find(|f| f.name == key) {
            Some(field) => shape(report, node, field.shape),
            None if typed && key == "type" => {}
            None => {
                let message = format!("unknown field '{}' of {}", super::shown(key), declared.name);
                report.unknown_key(message, key, &known);
                meant.extend(closest(key, &known));
            }
        });
    }
    for field in declared.fields.iter().filter(|f| f.default.is_none()) {
        if table.get(field.name).is_none() && !meant.iter().any(|key| key == field.name) {
            report.within(field.name, |report| {
                let message = format!("missing; {} needs it", declared.name);
                report.add(report.here(message).hint(meaning(field)));
            });
        }
    }
}

/// What a field is, with its unit.
fn meaning(field: &Field) -> String {
    let words = field.doc.lines().next().unwrap_or_default().trim_end_matches('.');
    match field.unit.as_str() {
        "" => format!("{}: {words}", field.name),
        unit => format!("{}: {words} ({unit})", field.name),
    }
}
