//! From a definition to a model: links names, evaluates parameters, and checks numbers.

use super::blueprint::Blueprint;
use super::definition::{Definition, Value};
use super::model::Model;
use super::parameters::{self, Evaluated};
use super::problem::Problem;
use super::quantity::Elements;
use super::scope::Scope;
use super::{beams, bodies, checks, play, tables};
use crate::expression::Tape;
use std::sync::Arc;

/// Links a definition and inserts numbers. `overrides` replace parameters by name.
///
/// All faults are reported at once.
pub fn build(
    definition: &Definition,
    overrides: &[(String, Value)],
) -> Result<Model, Vec<Problem>> {
    let definition = &play::moved(definition);
    let mut problems = Vec::new();
    let tables = tables::read(definition, &mut problems);
    let Evaluated { values, inferred, formulas } =
        parameters::values(definition, overrides, &tables, &mut problems);
    let mut scope = Scope::new(definition, inferred);
    scope.tables = tables;
    let gravity = gravity(definition, &scope, &mut problems);
    let (bodies, linked) = bodies::read(definition, &scope, &values, &mut problems);
    let quantities = Elements::new(definition, &scope, &bodies);
    let mut blueprint = Blueprint {
        title: definition.title.clone().unwrap_or_default(),
        parameters: scope.parameters.clone(),
        formulas,
        inferred: scope.inferred.clone(),
        tables: scope.tables.clone(),
        allow_redundancy: definition.redundancy.as_deref() == Some("allow"),
        gravity,
        bodies: bodies.clone().into(),
        constraints: Arc::default(),
        forces: Arc::default(),
        further: Arc::default(),
        companions: Arc::default(),
        functions: definition.functions.clone(),
        doubts: Vec::new(),
        modes: Vec::new(),
        implied: 0,
        phases: Vec::new(),
        rigid: None,
    };
    let further = blueprint.link_all(definition, &scope, &quantities, &mut problems);
    if !linked.is_empty() && problems.is_empty() {
        let mut rigid = Blueprint { allow_redundancy: true, ..blueprint.clone() };
        beams::weld(&mut rigid, &linked);
        rigid.lift_limits();
        blueprint.rigid = Some(Arc::new(rigid));
    }
    beams::connect(&mut blueprint, linked);
    blueprint.add_further(further);
    blueprint.add_companions(&quantities, &mut problems);
    for (k, unit) in scope.units.take() {
        let functions = blueprint.functions.iter_mut();
        functions.for_each(|functions| functions.laws[k].unit.clone_from(&unit));
    }
    blueprint.doubts = scope.doubts.take();
    let model = Model::new(&Arc::new(blueprint), &values);
    // consequences of a faulty parameter are not reported; all other faults are reported at once
    if values.iter().all(|x| x.is_finite()) {
        checks::numbers(&model, &mut problems);
    }
    if problems.is_empty() {
        Ok(model)
    } else {
        Err(problems)
    }
}

fn gravity(definition: &Definition, scope: &Scope, problems: &mut Vec<Problem>) -> [Tape; 2] {
    let path = ["gravity".to_string()];
    let none = || [Tape::from(0.0), Tape::from(0.0)];
    match &definition.gravity {
        None => none(),
        Some(value) => scope.pair(value, &path, "m/s^2", problems).unwrap_or_else(none),
    }
}
