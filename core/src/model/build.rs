//! From a definition to a model: links names, evaluates parameters, and checks numbers.

use super::blueprint::Blueprint;
use super::definition::{Definition, Value};
use super::items::Body;
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
    let mut rigid = (!linked.is_empty()).then(|| blueprint.clone());
    let further = blueprint.link_all(definition, &scope, &quantities, &mut problems);
    if let Some(rigid) = rigid.as_mut().filter(|_| problems.is_empty()) {
        link_rigid(rigid, (definition, &scope), (&bodies, &linked), &mut problems);
    }
    blueprint.rigid = rigid.map(Arc::new);
    beams::connect(&mut blueprint, linked);
    blueprint.add_further(further);
    blueprint.add_companions();
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

/// Links the form of the mechanism in which beams are rigid.
fn link_rigid(
    rigid: &mut Blueprint,
    (definition, scope): (&Definition, &Scope),
    (bodies, beams): (&[Body<Tape>], &[beams::Linked]),
    problems: &mut Vec<Problem>,
) {
    let bodies = beams::rigid_bodies(bodies, beams);
    let quantities = Elements::new(definition, scope, &bodies);
    rigid.bodies = bodies.clone().into();
    rigid.allow_redundancy = true;
    rigid.link_all(definition, scope, &quantities, problems);
    beams::weld(rigid, beams);
}

fn gravity(definition: &Definition, scope: &Scope, problems: &mut Vec<Problem>) -> [Tape; 2] {
    let path = ["gravity".to_string()];
    let none = || [Tape::from(0.0), Tape::from(0.0)];
    match &definition.gravity {
        None => none(),
        Some(value) => scope.pair(value, &path, "m/s^2", problems).unwrap_or_else(none),
    }
}
