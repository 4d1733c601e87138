//! The quantities that `set` and `guess` may name.

use super::target::{CoordinateTarget, QuantityTarget, Target};
use crate::elements::{BodyId, Coordinate, Followed, Measured, QuantityKind};
use crate::expression::Tape;
use crate::math::{Listed, ShortArray};
use crate::model::{
    did_you_mean, quantity_of, Functions, Model, Offered, Problem, ANY_UNIT, MOST_REPORTED,
};
use std::collections::HashMap;

/// Results of elements that follow from the motion.
const RESULTS: [&str; 12] = [
    "fx",
    "fy",
    "force",
    "torque",
    "tension",
    "tangential",
    "normal",
    "effort",
    "power",
    "energy",
    "dissipated",
    "load",
];

/// A quantity that may have a target.
pub(super) struct Named {
    of: Quantity,
    /// SI unit.
    pub unit: String,
}

enum Quantity {
    Coordinate(BodyId, Coordinate),
    Element { name: String, of: Followed<Tape>, rate: bool },
    Internal(usize),
    State(usize),
}

impl Named {
    /// Whether the quantity follows from the bodies, so that it cannot be set.
    pub fn follows(&self) -> bool {
        matches!(self.of, Quantity::Internal(_))
    }

    /// Whether the quantity is an angle.
    pub fn is_angle(&self) -> bool {
        match &self.of {
            Quantity::Coordinate(_, of) => *of == Coordinate::Angle,
            Quantity::Element { of, rate, .. } => !rate && of.kind() == QuantityKind::Angle,
            Quantity::Internal(_) | Quantity::State(_) => false,
        }
    }

    /// The target for the quantity with this value.
    pub fn with(self, value: f64) -> Target {
        match self.of {
            Quantity::Element { name, of, rate } => {
                Target::Quantity(QuantityTarget { name, of, rate, unit: self.unit, value })
            }
            Quantity::Coordinate(body, coordinate) => {
                Target::Coordinate(CoordinateTarget { body, coordinate, value })
            }
            Quantity::State(place) => Target::State { place, value },
            Quantity::Internal(column) => Target::Internal { column, value },
        }
    }
}

/// The moving bodies and the forces of a model by name.
pub(super) struct NamedTargets<'a> {
    model: &'a Model,
    bodies: HashMap<&'a str, usize>,
    forces: HashMap<&'a str, usize>,
}

impl<'a> NamedTargets<'a> {
    pub fn of(model: &'a Model) -> Self {
        let bodies = model.bodies.iter().enumerate().skip(1);
        Self {
            model,
            bodies: bodies.map(|(k, body)| (body.name.as_str(), k)).collect(),
            forces: model.forces.iter().enumerate().map(|(k, f)| (f.name.as_str(), k)).collect(),
        }
    }
}

/// A first-order state such as `motor.current`.
fn state(names: &NamedTargets<'_>, key: &str) -> Option<Named> {
    let (element, name) = key.rsplit_once('.')?;
    let (model, k) = (names.model, *names.forces.get(element)?);
    let sampled = model.blueprint.functions.iter().flat_map(Functions::sampled);
    if let Some(place) = sampled.into_iter().position(|(_, law, _)| law.held() == key) {
        let of = Quantity::State(model.layout.held[place]);
        return Some(Named { of, unit: ANY_UNIT.to_string() });
    }
    let at = model.forces[k].states.iter().position(|state| state.name == name)?;
    let place = model.layout.states[k].start + at;
    Some(Named { of: Quantity::State(place), unit: model.forces[k].states[at].unit.to_string() })
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
    Some(Named { of: Quantity::Internal(own.first + place), unit: ANY_UNIT.to_string() })
}

/// A quantity of a point or an element, such as `crank.B.x` or `A.omega`. None if the owner does not exist.
fn of_element(model: &Model, owner: &str, word: &str) -> Option<Result<Named, (String, String)>> {
    let name = format!("{owner}.{word}");
    Some(match quantity_of(&model.blueprint, owner, word)? {
        Offered::Position(of, ..) if of.bodies().iter().all(|body| body.is_ground()) => {
            Err((format!("'{name}' does not move"), "give a quantity of a moving body".to_string()))
        }
        Offered::Position(Followed::Coordinate(of), rate, unit) => {
            let coordinate = Coordinate::ALL[of.coordinate.column() + if rate { 3 } else { 0 }];
            Ok(Named { of: Quantity::Coordinate(of.body, coordinate), unit })
        }
        Offered::Position(of, rate, unit) => {
            Ok(Named { of: Quantity::Element { name, of, rate }, unit })
        }
        Offered::Other(measured) => Err(refused(owner, word, measured)),
    })
}

/// The fault and the remedy for a quantity that is neither a position nor a rate.
fn refused(owner: &str, word: &str, measured: &[Measured]) -> (String, String) {
    let known: Vec<&str> =
        measured.iter().flat_map(|of| &of.names[..2]).copied().filter(|n| !n.is_empty()).list();
    let message = if measured.iter().any(|of| of.names[2] == word) {
        format!("'{owner}.{word}' is an acceleration, which follows from the forces")
    } else if RESULTS.contains(&word) {
        format!("'{owner}.{word}' is a result, which follows from the motion")
    } else {
        format!("'{word}' is not a position quantity or rate of '{owner}'")
    };
    let hint = match known.is_empty() {
        true => format!("'{owner}' has none; give a coordinate or rate of a body"),
        false => did_you_mean(word, &known, &format!("quantities of {owner}"))
            .filter(|hint| !message.contains("which follows") || hint.starts_with("the "))
            .unwrap_or_else(|| format!("the quantities of {owner} are: {}", known.join(", "))),
    };
    (message, hint)
}

/// The quantity with this name. A fault is reported at `path`.
pub(super) fn named(
    names: &NamedTargets<'_>,
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
    let Some((owner, word)) = key.rsplit_once('.') else {
        let message = format!(
            "'{key}' must have the form body.coordinate or joint.quantity, such as crank.angle"
        );
        problems.push(fault(message, None));
        return None;
    };
    if !names.bodies.contains_key(owner) {
        if let Some(found) = of_element(model, owner, word) {
            return found.map_err(|(message, hint)| problems.push(fault(message, Some(hint)))).ok();
        }
    }
    of_body(names, (owner, word), fault, problems)
}

/// The position quantity with this name, such as `crank.angle` or `slide.displacement`.
///
/// # Errors
/// There is no quantity with this name, or it is not a position of a moving body.
pub fn position(model: &Model, name: &str) -> Result<Followed<Tape>, Problem> {
    let (owner, word) = name.rsplit_once('.').unwrap_or_default();
    if let Some(Offered::Position(of, false, _)) = quantity_of(&model.blueprint, owner, word) {
        if of.is_place() {
            return Ok(of);
        }
    }
    let mut problems = Vec::new();
    let found = named(&NamedTargets::of(model), name, &[name.to_string()], &mut problems);
    let target = found.map(|found| found.with(0.0)).filter(|target| !target.is_rate());
    match (target.and_then(|target| target.followed()), problems.pop()) {
        (Some((of, _)), _) => Ok(of),
        (None, Some(problem)) => Err(problem),
        (None, None) => {
            let message = format!("'{name}' is not a position quantity that a driver could hold");
            Err(Problem::at(&[name], message)
                .hint("give one such as crank.angle or slide.displacement"))
        }
    }
}

fn of_body(
    names: &NamedTargets<'_>,
    (body, coordinate): (&str, &str),
    fault: impl Fn(String, Option<String>) -> Problem,
    problems: &mut Vec<Problem>,
) -> Option<Named> {
    let model = names.model;
    let id = names.bodies.get(body).map(|k| BodyId(*k));
    if id.is_none() {
        let message = match body {
            "ground" => "ground does not move".to_string(),
            _ => format!("unknown body '{body}'"),
        };
        let hint = (problems.len() < MOST_REPORTED).then(|| {
            let known: Vec<&str> = model.bodies[1..].iter().map(|b| b.name.as_str()).list();
            did_you_mean(body, &known, "bodies")
        });
        problems.push(fault(message, hint.flatten()));
    }
    let found = Coordinate::named(coordinate);
    if found.is_none() {
        let known = Coordinate::ALL.each(Coordinate::name);
        let hint = did_you_mean(coordinate, &known, "coordinates and rates");
        problems.push(fault(format!("'{coordinate}' is not a coordinate of a body"), hint));
    }
    let (id, coordinate) = (id?, found?);
    if coordinate.column() >= model.layout.bodies[id.0].count {
        let message = format!("'{body}' is a point mass and has no {}", coordinate.name());
        problems.push(fault(message, Some("give its x, y, vx or vy".to_string())));
        return None;
    }
    Some(Named { of: Quantity::Coordinate(id, coordinate), unit: coordinate.unit().to_string() })
}
