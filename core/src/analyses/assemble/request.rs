//! The request for an assembly.

use crate::analyses::State;
use crate::elements::{BodyId, Coordinate};
use crate::equations::at;
use crate::model::{
    did_you_mean, Functions, Model, Problem, Reach, Scope, Value, ANY_UNIT, MOST_REPORTED,
};
use std::collections::HashMap;

/// A value given for a coordinate or a rate of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct CoordinateTarget {
    /// The moving body.
    pub body: BodyId,
    /// Coordinate or rate.
    pub coordinate: Coordinate,
    /// m, rad, m/s or rad/s.
    pub value: f64,
}

/// A value given for the start.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// Of a body.
    Coordinate(CoordinateTarget),
    /// Of an internal coordinate of a joint; a guess.
    Internal {
        /// Its column.
        column: usize,
        /// m or rad.
        value: f64,
    },
    /// Of a first-order state of an element.
    State {
        /// Its place in z.
        place: usize,
        /// In its unit.
        value: f64,
    },
}

/// The targets of coordinates.
pub(super) fn of_positions(targets: &[Target]) -> impl Iterator<Item = &CoordinateTarget> + Clone {
    of_bodies(targets).filter(|target| !target.coordinate.is_rate())
}

/// The targets of rates.
pub(super) fn of_rates(targets: &[Target]) -> impl Iterator<Item = &CoordinateTarget> + Clone {
    of_bodies(targets).filter(|target| target.coordinate.is_rate())
}

/// The targets of coordinates and rates.
pub(super) fn of_bodies(targets: &[Target]) -> impl Iterator<Item = &CoordinateTarget> + Clone {
    targets.iter().filter_map(|target| match target {
        Target::Coordinate(target) => Some(target),
        Target::State { .. } | Target::Internal { .. } => None,
    })
}

/// The request for an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// Targets held exactly.
    pub set: Vec<Target>,
    /// Targets approached.
    pub guess: Vec<Target>,
    /// A whole state as guess.
    pub state: Option<State>,
    /// Time, s.
    pub t: f64,
    /// Whether Newton's method starts from the guess with open loops, and not from a placement that closes them: the
    /// classical iteration, for teaching.
    pub from_guess: bool,
}

/// Reads targets such as ("crank.angle", "70*deg"); `section` is `set` or `guess`.
///
/// # Errors
/// Every faulty target, with its path in a file.
pub fn targets(
    model: &Model,
    section: &str,
    written: &[(String, Value)],
) -> Result<Vec<Target>, Vec<Problem>> {
    let mut problems = Vec::new();
    let mut found = Vec::new();
    let names = Names::of(model);
    let b = &model.blueprint;
    let scope = Scope::of_parameters(&b.parameters, &b.inferred, &b.tables);
    for (key, value) in written {
        let path = ["start".to_string(), section.to_string(), key.clone()];
        let Some(named) = named(&names, key, &path, &mut problems) else { continue };
        if section == "set" && matches!(named.of, Quantity::Internal(_)) {
            let message = format!("{key} follows the bodies and cannot be set");
            problems.push(Problem::at(&path, message).hint("give it as a guess").at_key());
            continue;
        }
        let unit = named.unit;
        let tape = scope.formula(value, &path, unit, Reach::Parameters, &mut problems);
        let Some(tape) = tape else { continue };
        let value = tape.evaluate(&at(&model.parameters, &[], &[], 0.0));
        if value.is_finite() {
            found.push(named.with(value));
        } else {
            problems.push(Problem::at(&path, format!("becomes {value}; must be finite")));
        }
    }
    if problems.is_empty() {
        Ok(found)
    } else {
        Err(problems)
    }
}

/// A quantity that a target may have.
struct Named {
    of: Quantity,
    unit: &'static str,
}

enum Quantity {
    Coordinate(BodyId, Coordinate),
    Internal(usize),
    State(usize),
}

impl Named {
    fn with(self, value: f64) -> Target {
        match self.of {
            Quantity::Coordinate(body, coordinate) => {
                Target::Coordinate(CoordinateTarget { body, coordinate, value })
            }
            Quantity::State(place) => Target::State { place, value },
            Quantity::Internal(column) => Target::Internal { column, value },
        }
    }
}

/// The moving bodies and the forces of a model by name.
struct Names<'a> {
    model: &'a Model,
    bodies: HashMap<&'a str, usize>,
    forces: HashMap<&'a str, usize>,
}

impl<'a> Names<'a> {
    fn of(model: &'a Model) -> Self {
        let bodies = model.bodies.iter().enumerate().skip(1);
        Self {
            model,
            bodies: bodies.map(|(k, body)| (body.name.as_str(), k)).collect(),
            forces: model.forces.iter().enumerate().map(|(k, f)| (f.name.as_str(), k)).collect(),
        }
    }
}

/// A first-order state such as `motor.current`.
fn state(names: &Names<'_>, key: &str) -> Option<Named> {
    let (element, name) = key.rsplit_once('.')?;
    let (model, k) = (names.model, *names.forces.get(element)?);
    let sampled = model.blueprint.functions.iter().flat_map(Functions::sampled);
    if let Some(place) = sampled.into_iter().position(|(_, law, _)| law.held() == key) {
        return Some(Named { of: Quantity::State(model.layout.held[place]), unit: ANY_UNIT });
    }
    let at = model.forces[k].states.iter().position(|state| state.name == name)?;
    let place = model.layout.states[k].start + at;
    Some(Named { of: Quantity::State(place), unit: model.forces[k].states[at].unit })
}

/// An internal coordinate such as `cam.u`.
fn internal(model: &Model, key: &str) -> Option<Named> {
    let (joint, name) = key.rsplit_once('.')?;
    let k = model.constraint(joint)?;
    let own = model.layout.constraints[k].own;
    let place = match own.count {
        1 => (name == "u").then_some(0)?,
        count => (0..count).find(|place| name == format!("u{}", place + 1))?,
    };
    Some(Named { of: Quantity::Internal(own.first + place), unit: ANY_UNIT })
}

fn named(
    names: &Names<'_>,
    key: &str,
    path: &[String],
    problems: &mut Vec<Problem>,
) -> Option<Named> {
    let model = names.model;
    if let Some(found) = state(names, key).or_else(|| internal(model, key)) {
        return Some(found);
    }
    let fault = |message: String, hint: Option<String>| {
        Problem::at(path, message).maybe_hint(hint).at_key()
    };
    let Some((body, coordinate)) = key.rsplit_once('.') else {
        let message = format!("'{key}' must have the form body.coordinate, such as crank.angle");
        problems.push(fault(message, None));
        return None;
    };
    if let Some(owner) = body.split_once('.').map(|(owner, _)| owner) {
        if model.body(owner).is_some() {
            let message =
                format!("'{body}' is a point; only the coordinates of a body can be given");
            let hint = format!("write '{owner}.{coordinate}', of its frame");
            problems.push(fault(message, Some(hint)));
            return None;
        }
    }
    let id = names.bodies.get(body).map(|k| BodyId(*k));
    if id.is_none() {
        let message = match body {
            "ground" => "ground does not move".to_string(),
            _ => format!("unknown body '{body}'"),
        };
        let hint = (problems.len() < MOST_REPORTED).then(|| {
            let known: Vec<&str> = model.bodies[1..].iter().map(|b| b.name.as_str()).collect();
            did_you_mean(body, &known, "bodies")
        });
        problems.push(fault(message, hint.flatten()));
    }
    let found = Coordinate::named(coordinate);
    if found.is_none() {
        let known = Coordinate::ALL.map(Coordinate::name);
        let hint = did_you_mean(coordinate, &known, "coordinates and rates");
        problems.push(fault(format!("'{coordinate}' is not a coordinate of a body"), hint));
    }
    let (id, coordinate) = (id?, found?);
    if coordinate.column() >= model.layout.bodies[id.0].count {
        let message = format!("'{body}' is a point mass and has no {}", coordinate.name());
        problems.push(fault(message, Some("give its x, y, vx or vy".to_string())));
        return None;
    }
    Some(Named { of: Quantity::Coordinate(id, coordinate), unit: coordinate.unit() })
}
