//! The request for an assembly.

use crate::analyses::State;
use crate::elements::{BodyId, Coordinate};
use crate::equations::at;
use crate::model::{did_you_mean, Model, Problem, Reach, Scope, Value};

/// A requested value of a coordinate or a rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The moving body.
    pub body: BodyId,
    /// Coordinate or rate.
    pub coordinate: Coordinate,
    /// m, rad, m/s or rad/s.
    pub value: f64,
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
    for (key, value) in written {
        let path = ["start".to_string(), section.to_string(), key.clone()];
        let Some((body, coordinate)) = named(model, key, &path, &mut problems) else { continue };
        let scope = Scope::of_parameters(&model.blueprint.parameters);
        let unit = coordinate.unit();
        let tape = scope.formula(value, &path, unit, Reach::Parameters, &mut problems);
        let Some(tape) = tape else { continue };
        let value = tape.evaluate(&at(&model.parameters, &[], &[], 0.0));
        if value.is_finite() {
            found.push(Target { body, coordinate, value });
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

fn named(
    model: &Model,
    key: &str,
    path: &[String],
    problems: &mut Vec<Problem>,
) -> Option<(BodyId, Coordinate)> {
    let fault = |message: String, hint: Option<String>| {
        Problem::at(path, message).maybe_hint(hint).at_key()
    };
    let Some((body, coordinate)) = key.rsplit_once('.') else {
        let message = format!("'{key}' must have the form body.coordinate, such as crank.angle");
        problems.push(fault(message, None));
        return None;
    };
    let names: Vec<&str> = model.bodies[1..].iter().map(|b| b.name.as_str()).collect();
    let id = model.body(body).filter(|id| !id.is_ground());
    if id.is_none() {
        let message = match body {
            "ground" => "ground does not move".to_string(),
            _ => format!("unknown body '{body}'"),
        };
        problems.push(fault(message, did_you_mean(body, &names, "bodies")));
    }
    let found = Coordinate::named(coordinate);
    if found.is_none() {
        let known = Coordinate::ALL.map(Coordinate::name);
        let hint = did_you_mean(coordinate, &known, "coordinates and rates");
        problems.push(fault(format!("'{coordinate}' is not a coordinate of a body"), hint));
    }
    Some((id?, found?))
}
