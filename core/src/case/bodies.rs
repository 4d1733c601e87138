//! The structure of a body.

use super::fields;
use super::report::Report;
use super::tree::Table;
use crate::elements::Table as Declaration;
use crate::expression::suggest::closest;
use crate::model::body_tables;

/// The declarations of bodies.
pub(super) struct Bodies {
    ground: Option<Declaration>,
    /// All types of bodies.
    typed: Vec<Declaration>,
}

impl Bodies {
    pub(super) fn declared() -> Self {
        let (ground, typed): (Vec<_>, Vec<_>) =
            body_tables().into_iter().partition(|table| table.name == "ground");
        Self { ground: ground.into_iter().next(), typed }
    }

    /// Checks the present table as the body of this name.
    pub(super) fn check(&self, report: &mut Report, name: &str, table: &Table) {
        if let ("ground", Some(ground)) = (name, &self.ground) {
            return fields::check(report, table, ground, false);
        }
        let general = self.typed.iter().find(|d| d.name == "body");
        let typed: Vec<&Declaration> = self.typed.iter().collect();
        let declared = fields::declared(report, table, &typed, "body", general);
        let Some(declared) = declared else { return };
        fields::check(report, table, declared, true);
        if declared.name == "bar" {
            bar(report, table);
        }
    }
}

/// A bar has a length or two points.
fn bar(report: &mut Report, table: &Table) {
    let needed = ["length", "through"];
    let meant = |key: &str| needed.contains(&key) || closest(key, needed).is_some();
    if !table.entries.iter().any(|(key, _)| meant(key)) {
        report.within("length", |report| {
            let through = report.example(
                "through = { A = [0, 0], B = [1, 2] }",
                "\"through\": { \"A\": [0, 0], \"B\": [1, 2] }",
            );
            let hint = format!("give length and ends, or the places of two points: {through}");
            report.add(report.here("missing; bar needs its length or two points").hint(hint));
        });
    }
}
