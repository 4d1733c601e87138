//! Checks of the numbers of a model.

use super::beam_names::{beam_of, BEAM, NODE};
use super::items::Body;
use super::model::Model;
use super::outline::Outline;
use super::problem::Problem;
use super::shape_checks;
use super::size::size;
use crate::elements::{Curve, ForceElement};
use crate::expression::{FormulaValues as Values, Tape};
use crate::math::Listed;

/// Opening of joints that counts as closed, relative to the size of the mechanism.
const CLOSED: f64 = 1e-9;
/// Lengths above this limit, m, have powers that overflow in the solution for positions.
const LONGEST: f64 = 1e60;

/// Reports negative masses and inertias, bars without length, and everything that is not finite.
pub fn numbers(model: &Model, problems: &mut Vec<Problem>) {
    for body in &model.bodies {
        finite_points(body, problems);
        for (name, curve) in &body.curves {
            if let Some((key, message)) = curve.as_ref().and_then(Curve::fault) {
                let path = ["bodies", &body.name, "curves", name, key];
                let path = &path[..path.len() - usize::from(key.is_empty())];
                problems.push(Problem::at(path, message));
            }
        }
        if let Some((key, message)) = body.outline.as_ref().and_then(Outline::fault) {
            let path = ["bodies", &body.name, "outline"].into_iter();
            let path: Vec<&str> = path.chain((!key.is_empty()).then_some(key)).list();
            problems.push(Problem::at(&path, message));
        }
        if !body.shapes.is_empty() {
            shape_checks::shapes(body, problems);
        } else {
            possible(body, problems);
        }
    }
    for (k, g) in [model.gravity.x, model.gravity.y].into_iter().enumerate() {
        if !g.is_finite() {
            problems
                .push(Problem::at(&["gravity", &k.to_string()], format!("{g}; must be finite")));
        }
    }
    // the piece of a beam reports faults of its lock
    for item in model.constraints.iter().filter(|item| item.element.in_files()) {
        let section = item.group.section();
        let element = match &item.law {
            None => item.element.clone(),
            Some(law) => law.map(&mut |tape| constant(tape, &model.parameters)),
        };
        if item.law.is_none() {
            element.visit(&mut |x| check(&[section, &item.name], *x, problems));
        }
        if let Some((field, message)) = element.fault() {
            problems.push(Problem::at(&[section, &item.name, field], message));
        }
    }
    forces(model, problems);
}

fn forces(model: &Model, problems: &mut Vec<Problem>) {
    let least = CLOSED * size(model);
    for item in &model.forces {
        let section = item.element.group().section();
        let element = match &item.law {
            None => item.element.clone(),
            Some(law) => law.map(&mut |tape| constant(tape, &model.parameters)),
        };
        if !element.in_files() {
            piece(beam_of(&item.name), &element, problems);
            continue;
        }
        if item.law.is_none() {
            element.visit(&mut |x| check(&[section, &item.name], *x, problems));
        }
        let small = element.play().filter(|(_, play)| *play <= least).map(|(field, play)| {
            let message = format!(
                "{play} m; must be above {least:.3e} m, to which joints of a mechanism of this size are closed"
            );
            (field, message)
        });
        let fault = element.fault().or(small);
        let fault =
            fault.map(|(field, message)| Problem::at(&[section, &item.name, field], message));
        // the parts of a contact have the same fields
        problems.extend(fault.filter(|fault| !problems.contains(fault)));
    }
}

/// Reports a fault of a piece of a beam, once for each beam.
fn piece(beam: &str, element: &ForceElement, problems: &mut Vec<Problem>) {
    let path = ["bodies", beam];
    if problems.iter().any(|problem| problem.path == path) {
        return;
    }
    if let Some((_, message)) = element.fault() {
        problems.push(Problem::at(&path, message));
    }
}

/// The value of a formula of the parameters. NaN if it depends on time or state.
fn constant(tape: &Tape, parameters: &[f64]) -> f64 {
    if tape.uses_time() || tape.uses_state() {
        return f64::NAN;
    }
    tape.evaluate(&Values { parameters, time: f64::NAN, variables: &[] })
}

fn check(path: &[&str], x: f64, problems: &mut Vec<Problem>) {
    if !x.is_finite() {
        problems.push(Problem::at(path, format!("a value becomes {x}; must be finite")));
    }
}

fn possible(body: &Body, problems: &mut Vec<Problem>) {
    match body.kind {
        BEAM | NODE => return beam(body, problems),
        "ground" => return,
        _ => {}
    }
    let path = |key: &str| ["bodies".to_string(), body.name.clone(), key.to_string()];
    if !(body.mass.is_finite() && body.mass >= 0.0) {
        let must = if body.mass < 0.0 { "not be negative" } else { "be finite" };
        let message = format!("{} kg; must {must}", body.mass);
        problems.push(Problem::at(&path("mass"), message));
        return; // consequences of the mass are not reported
    }
    if body.kind == "bar" {
        let length = body.points.first().map_or(f64::NAN, |(_, s)| -2.0 * s.x);
        if !(length.is_finite() && length > 0.0) {
            let key = if body.drawn.is_some() { "through" } else { "length" };
            problems.push(Problem::at(&path(key), format!("{length} m; must be > 0")));
        }
    } else if !(body.inertia.is_finite() && body.inertia >= 0.0) {
        let message = format!("{} kg·m²; must not be negative", body.inertia);
        problems.push(Problem::at(&path("inertia"), message));
    }
    if !(body.center.x.is_finite() && body.center.y.is_finite()) {
        problems.push(Problem::at(&path("center"), "must be finite"));
    }
}

/// Reports an impossible mass of a node, once for each beam.
fn beam(body: &Body, problems: &mut Vec<Problem>) {
    let path = ["bodies", beam_of(&body.name)];
    if problems.iter().any(|problem| problem.path == path) {
        return;
    }
    for (what, x) in [("mass", body.mass), ("moment of inertia", body.inertia)] {
        if !(x.is_finite() && x >= 0.0) {
            let must = if x < 0.0 { "not be negative" } else { "be finite" };
            let message = format!("the {what} per length of the beam must {must}");
            problems.push(Problem::at(&path, message));
            return;
        }
    }
}

fn finite_points(body: &Body, problems: &mut Vec<Problem>) {
    for (name, s) in &body.points {
        let path = ["bodies", &body.name, "points", name];
        if !(s.x.is_finite() && s.y.is_finite()) {
            problems.push(Problem::at(&path, format!("({}, {}); must be finite", s.x, s.y)));
        } else if s.x.abs().max(s.y.abs()) > LONGEST {
            let message = format!("({:e}, {:e}); must be below {LONGEST:e} m", s.x, s.y);
            problems.push(Problem::at(&path, message));
        }
    }
}
