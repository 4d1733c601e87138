//! The structure of a body.

use super::fields;
use super::report::Report;
use super::tree::Table;
use crate::elements::Table as Declaration;

/// Checks the present table as the body of this name.
pub(super) fn check(report: &mut Report, name: &str, table: &Table, known: &[Declaration]) {
    let find = |name: &str| known.iter().find(|d| d.name == name);
    if name == "ground" {
        if let Some(ground) = find("ground") {
            fields::check(report, table, ground, false);
        }
        return;
    }
    let typed: Vec<Declaration> = known.iter().filter(|d| d.name != "ground").cloned().collect();
    let general = typed.iter().find(|d| d.name == "body");
    let Some(declared) = fields::declared(report, table, &typed, "body", general) else { return };
    fields::check(report, table, declared, true);
    if declared.name == "bar" && table.get("length").is_none() && table.get("through").is_none() {
        report.within("length", |report| {
            let hint = "give length and ends, or where two points stand: through = { A = [0, 0], B = [1, 2] }";
            report.add(report.here("missing; bar needs its length or two points").hint(hint));
        });
    }
}
