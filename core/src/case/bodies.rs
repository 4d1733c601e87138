//! The structure of a body.

use super::fields;
use super::report::ProblemList;
use super::tree::Table;
use crate::elements::Table as Declaration;
use crate::expression::suggest::closest;
use crate::math::Listed;
use crate::model::{body_tables, INSTEAD_OF_SHAPES};

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

    /// Checks the current table as the body with this name.
    pub(super) fn check(&self, report: &mut ProblemList, name: &str, table: &Table) {
        if let ("ground", Some(ground)) = (name, &self.ground) {
            return fields::check(report, table, ground, false);
        }
        let general = self.typed.iter().find(|d| d.name == "body");
        let typed: Vec<&Declaration> = self.typed.iter().list();
        let declared = fields::declared(report, table, &typed, "body", general);
        let Some(declared) = declared else { return };
        if declared.name == "body" && !has_shapes(table) {
            return fields::check(report, table, &without_shapes(declared), true);
        }
        fields::check(report, table, declared, true);
        match declared.name {
            "bar" => bar(report, table),
            "body" => of_shapes(report, table),
            _ => {}
        }
    }
}

/// Whether a body has shapes; a misspelt key counts as well.
fn has_shapes(table: &Table) -> bool {
    let meant = |key: &str| key == "shapes" || closest(key, ["shapes"]).is_some();
    table.entries.iter().any(|(key, _)| meant(key))
}

/// A body without shapes needs its mass and its moment of inertia.
fn without_shapes(declared: &Declaration) -> Declaration {
    let mut declared = declared.clone();
    for field in &mut declared.fields {
        if ["mass", "inertia"].contains(&field.name) {
            field.default = None;
        }
    }
    declared
}

/// Rejects fields that the shapes of a body determine: mass, inertia and mass centre.
fn of_shapes(report: &mut ProblemList, table: &Table) {
    for key in INSTEAD_OF_SHAPES.into_iter().filter(|key| table.get(key).is_some()) {
        report.within(key, |report| {
            let hint = format!("shapes determine it; remove {key}, or remove shapes");
            report.add(report.here("not together with shapes").hint(hint));
        });
    }
}

/// A bar has a length or two points.
fn bar(report: &mut ProblemList, table: &Table) {
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
