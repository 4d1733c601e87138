//! A model over formulas: the definition with all names linked, before numbers are put in.

use super::bodies;
use super::definition::{Definition, Entry, Value};
use super::link::{self, Linker, Scope};
use super::model::{Body, Model};
use super::problem::Problem;
use super::variable::Variable;
use super::{checks, parameters};
use crate::elements::{
    holding, BodyId, Constraint, CoordinateOf, Fixes, ForceElement, Group, OwnState,
};
use crate::expression::{Symbol, Tape};
use std::sync::Arc;

/// The linked content of a file: elements over [`Tape`].
#[derive(Clone, Debug)]
pub struct Blueprint {
    /// Title.
    pub title: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Whether redundant constraints are accepted.
    pub allow_redundancy: bool,
    /// Acceleration of free fall.
    pub gravity: [Tape; 2],
    /// Bodies; index 0 is ground.
    pub bodies: Vec<Body<Tape>>,
    /// Joints, then drivers.
    pub constraints: Vec<(String, Group, Constraint<Tape>)>,
    /// Forces, with their first-order states.
    pub forces: Vec<(String, &'static [OwnState], ForceElement<Tape>)>,
}

/// Links a definition and puts numbers in. `overrides` replace parameters by name.
///
/// All faults are reported at once.
pub fn build(
    definition: &Definition,
    overrides: &[(String, Value)],
) -> Result<Model, Vec<Problem>> {
    let mut problems = Vec::new();
    let values = parameters::values(definition, overrides, &mut problems);
    let scope = Scope::new(definition);
    let gravity = gravity(definition, &scope, &mut problems);
    let bodies = bodies::read(definition, &scope, &mut problems);
    let mut blueprint = Blueprint {
        title: definition.title.clone().unwrap_or_default(),
        parameters: scope.parameters.clone(),
        allow_redundancy: definition.redundancy.as_deref() == Some("allow"),
        gravity,
        bodies,
        constraints: Vec::new(),
        forces: Vec::new(),
    };
    for (group, entries) in [
        (Group::Joints, &definition.joints),
        (Group::Drivers, &definition.drivers),
        (Group::Forces, &definition.forces),
    ] {
        for entry in entries {
            blueprint.link(group, entry, &scope, &mut problems);
        }
    }
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

impl Blueprint {
    fn link(&mut self, group: Group, entry: &Entry, scope: &Scope, problems: &mut Vec<Problem>) {
        let Some(Value::Text(kind)) = entry.get("type") else {
            let message = format!("this {} has no type", group.singular());
            problems.push(Problem::at(&[group.section(), &entry.name], message));
            return;
        };
        let joints: Vec<&str> = self.constraints.iter().map(|(name, ..)| name.as_str()).collect();
        let mut linker = Linker::new(group, entry, scope, (&self.bodies, &joints), problems);
        let known = if group == Group::Forces {
            ForceElement::read(kind, &mut linker).map(|e| {
                let e = e.filter(|e| self.two_bodies(group, entry, &e.bodies(), problems));
                let states = link::states(entry);
                self.forces.extend(e.map(|e| (entry.name.clone(), states, e)));
            })
        } else {
            Constraint::read(group, kind, &mut linker).map(|e| {
                let e = e.filter(|e| {
                    self.two_bodies(group, entry, &e.bodies(), problems)
                        && self.not_circular(entry, e, problems)
                });
                self.constraints.extend(e.map(|e| (entry.name.clone(), group, e)));
            })
        };
        if known.is_none() {
            let path = [group.section(), &entry.name, "type"];
            let message = format!("there is no {} of type '{kind}'", group.singular());
            problems.push(Problem::at(&path, message));
        }
    }

    /// Reports an element between a body and itself: it would be empty or impossible.
    fn two_bodies(
        &self,
        group: Group,
        entry: &Entry,
        bodies: &[BodyId],
        problems: &mut Vec<Problem>,
    ) -> bool {
        let [i, j, ..] = bodies else { return true };
        if i != j {
            return true;
        }
        let body = &self.bodies[i.0].name;
        let message = format!("both ends of this {} are on '{body}'", group.singular());
        let hint = "it must connect two different bodies";
        problems.push(Problem::at(&[group.section(), &entry.name], message).hint(hint));
        false
    }

    /// Reports a driver whose law uses the coordinate that it drives.
    fn not_circular(
        &self,
        entry: &Entry,
        constraint: &Constraint<Tape>,
        problems: &mut Vec<Problem>,
    ) -> bool {
        for fixed in constraint.fixes() {
            let Fixes::Coordinate(CoordinateOf { body, coordinate }, value) = fixed else {
                continue;
            };
            let own = Symbol::Variable(Variable::Coordinate(body, coordinate).index());
            if value.symbols().contains(&own) {
                let name = format!("{}.{}", self.bodies[body.0].name, coordinate.name());
                let message = format!("the law uses {name}, the coordinate that it drives");
                problems.push(Problem::at(&["drivers", &entry.name, "value"], message));
                return false;
            }
        }
        true
    }

    /// The same mechanism with further drivers that make coordinates follow given laws: what
    /// assembly solves.
    pub fn holding(&self, held: &[(String, CoordinateOf, Tape)]) -> Self {
        let mut extended = self.clone();
        for (name, coordinate, value) in held {
            let driver = holding(*coordinate, value.clone());
            extended.constraints.push((name.clone(), Group::Drivers, driver));
        }
        extended
    }

    /// A body by name.
    pub fn body(&self, name: &str) -> Option<BodyId> {
        self.bodies.iter().position(|b| b.name == name).map(BodyId)
    }
}
