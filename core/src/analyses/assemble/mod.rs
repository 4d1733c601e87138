//! Assembly: a consistent state from set coordinates, guesses, drawn positions and drivers.
//!
//! 1. The bodies are placed along the joints ([`place`]).
//! 2. Newton–Raphson solves Φ = 0 with the rows of drivers and of `set` ([`Closing`]).
//! 3. Angles are changed by whole turns to relax springs.
//! 4. The velocities become the consistent velocities nearest to the requested ones.
//!
//! A consistent position is not changed.

mod angle_winding;
mod by_equation;
mod dyad;
mod dyad_placement;
mod equation_placement;
mod failure;
mod legs;
mod open_placement;
mod placement;
mod placements;
mod placer;
mod report;
mod request;
mod slider_placement;
mod targets;
mod velocities;
mod worklist;

pub use super::closing::Closing;
pub use failure::{Failure, Fault};
pub use open_placement::open_placement;
pub use placement::{Dyad, Gap, Placement};
pub use placer::place;
pub use report::{Mode, Report};
pub use request::{targets, CoordinateTarget, Request, Target};
pub use targets::Targets;

use super::closing::Stop;
use super::mobility::mobility_until;
use super::required;
use super::State;
use crate::elements::CoordinateOf;
use crate::equations::kinematics;
use crate::math::Pose;
use crate::model::Model;
use crate::solve::newton::Record;
use placements::Placements;
use request::{of_positions, of_rates};
use std::sync::Arc;

/// Largest number of placements from which Newton's method is tried.
const MOST_TRIES: usize = 16;
/// Largest difference of a given pose from `set` with which bodies are not placed anew, rad.
const NEAR: f64 = 0.35;

/// Assembles a mechanism.
///
/// # Errors
/// [`Failure`] if the mechanism cannot close, if rates contradict the constraints, or if constraints are redundant
/// and redundancy is not allowed.
pub fn assemble(model: &Model, request: &Request) -> Result<(State, Report), Box<Failure>> {
    assemble_until(model, request, &|| false)
}

/// [`assemble`], which ends soon after `stop` has become true.
///
/// # Errors
/// As [`assemble`], and [`Fault::Stopped`].
pub fn assemble_until(
    model: &Model,
    request: &Request,
    stop: Stop<'_>,
) -> Result<(State, Report), Box<Failure>> {
    let outcome = complete(model, request, stop);
    match stop() {
        true => Err(Box::new(failure::stopped())),
        false => outcome,
    }
}

fn complete(
    model: &Model,
    request: &Request,
    stop: Stop<'_>,
) -> Result<(State, Report), Box<Failure>> {
    let asked = asked(model, request);
    let extended = holding(model, request);
    let mut closing = Closing::new(&extended, request.t, stop);
    let Closed { mut q, iterations, mut warnings } = close(model, request, &asked, &mut closing)?;
    if request.state.is_none() {
        warnings.extend(angle_winding::relax(model, &asked, &mut q));
    }
    let mut report = Report { iterations, warnings, ..Report::default() };
    if let Some(unmet) = required::missed(model, request.t, &q) {
        return Err(Box::new(failure::unmet(unmet)));
    }
    if let Some(failure) = failure::undefined(model, request.t, &q) {
        return Err(Box::new(failure));
    }
    let mobility = mobility_until(model, request.t, &q, stop);
    if !mobility.redundant.is_empty() && !model.allow_redundancy {
        return Err(Box::new(failure::redundant(model, &mobility)));
    }
    if let Some(unmet) = required::loose(model, request.t, &q) {
        return Err(Box::new(failure::unmet(unmet)));
    }
    report.degrees_of_freedom = mobility.degrees_of_freedom;
    report.warnings.extend(report::singular(model, &mobility.singular));
    let v = velocities(model, request, &q)?;
    describe(model, &asked, &q, &mut report);
    Ok((State { t: request.t, q, v, z: states(model, request) }, report))
}

/// First-order states: those that are set, else guessed, else given, else zero.
fn states(model: &Model, request: &Request) -> Vec<f64> {
    let n_z = model.layout.n_z;
    let given = request.state.as_ref().map(|state| state.z.clone()).filter(|z| z.len() == n_z);
    let mut z = given.unwrap_or_else(|| vec![0.0; n_z]);
    for target in request.guess.iter().chain(&request.set) {
        if let Target::State { place, value } = target {
            z[*place] = *value;
        }
    }
    z
}

/// Drivers and `set` are hard; drawn poses, `guess` and a given state are soft.
fn asked(model: &Model, request: &Request) -> Targets {
    let mut asked = Targets::of(model, request.t);
    if let Some(state) = &request.state {
        asked.approach(model, &state.q);
        asked.turn[1..].fill(true);
    }
    for target in of_positions(&request.guess) {
        asked.soft[target.body.0][target.coordinate.column()] = Some(target.value);
        asked.turn[target.body.0] |= target.coordinate.column() == 2;
    }
    for target in of_positions(&request.set) {
        asked.hard[target.body.0][target.coordinate.column()] = Some(target.value);
        asked.turn[target.body.0] |= target.coordinate.column() == 2;
    }
    for (hard, turn) in asked.hard.iter().zip(&mut asked.turn) {
        *turn |= hard[2].is_some();
    }
    asked
}

/// The model with a driver for each coordinate that is set.
pub fn holding(model: &Model, request: &Request) -> Model {
    let held: Vec<_> = of_positions(&request.set).map(|w| held(model, w, w.value.into())).collect();
    let blueprint = model.blueprint.holding(&held);
    Model::new(&Arc::new(blueprint), &model.parameters)
}

fn held(
    model: &Model,
    target: &CoordinateTarget,
    value: crate::expression::Tape,
) -> (String, CoordinateOf, crate::expression::Tape) {
    let position = crate::elements::Coordinate::ALL[target.coordinate.column()];
    let name = format!("set {}", model.bodies[target.body.0].name);
    (name, CoordinateOf { body: target.body, coordinate: position }, value)
}

/// The column of a coordinate or of its rate.
fn column(model: &Model, target: &CoordinateTarget) -> usize {
    model.layout.bodies[target.body.0].first + target.coordinate.column()
}

/// A position in which the mechanism closes.
struct Closed {
    q: Vec<f64>,
    iterations: Vec<Record>,
    warnings: Vec<String>,
}

/// The first position, in the order of preference, from which the mechanism closes.
fn close(
    model: &Model,
    request: &Request,
    asked: &Targets,
    closing: &mut Closing<'_>,
) -> Result<Closed, Box<Failure>> {
    if request.from_guess {
        let q = given(model, asked).unwrap_or_else(|| open_placement(model, asked));
        let outcome = close_from(closing, q, Vec::new());
        return outcome
            .map_err(|q| Box::new(failure::open(closing.model(), request, closing, &q, None)));
    }
    if let Some(found) = given(model, asked).and_then(|q| close_from(closing, q, Vec::new()).ok()) {
        return Ok(found);
    }
    // the first placement, and the position that Newton's method reached from it
    let mut first: Option<(Placement, Vec<f64>)> = None;
    for placement in Placements::new(model, asked).take(MOST_TRIES) {
        let warnings = report::folded(model, &placement.dyads);
        match close_from(closing, placement.q.clone(), warnings) {
            Ok(found) => return Ok(found),
            Err(q) => _ = first.get_or_insert((placement, q)),
        }
        if closing.stopped() {
            break;
        }
    }
    let (gap, q) = first.map_or((None, Vec::new()), |(p, q)| (p.gaps.into_iter().next(), q));
    Err(Box::new(failure::open(closing.model(), request, closing, &q, gap.as_ref())))
}

/// Newton's method from a position; the error is the position that it reached.
fn close_from(
    closing: &mut Closing<'_>,
    mut q: Vec<f64>,
    warnings: Vec<String>,
) -> Result<Closed, Vec<f64>> {
    match closing.close(&mut q) {
        (iterations, true) => Ok(Closed { q, iterations, warnings }),
        (_, false) => Err(q),
    }
}

/// The whole position, if every coordinate has a target and hard targets lie near soft ones.
fn given(model: &Model, asked: &Targets) -> Option<Vec<f64>> {
    let near = |b: usize| match (asked.hard[b][2], asked.soft[b][2]) {
        (Some(hard), Some(soft)) => (hard - soft).abs() < NEAR,
        _ => true,
    };
    let pose =
        |b: usize| asked.pose(b).filter(|_| near(b)).map(|[x, y, angle]| Pose::new(x, y, angle));
    let moving: Option<Vec<Pose>> = (1..asked.soft.len()).map(pose).collect();
    let poses: Vec<Pose> = std::iter::once(Pose::identity()).chain(moving?).collect();
    Some(kinematics::coordinates(model, &poses))
}

/// Velocities from the guess, made consistent; drivers hold the rates of `set`.
fn velocities(model: &Model, request: &Request, q: &[f64]) -> Result<Vec<f64>, Box<Failure>> {
    let mut v = match &request.state {
        Some(state) => state.v.clone(),
        None => vec![0.0; q.len()],
    };
    let mut drivers = Vec::new();
    for target in of_rates(&request.guess).chain(of_rates(&request.set)) {
        v[column(model, target)] = target.value;
    }
    for target in of_rates(&request.set) {
        let position = q[column(model, target)];
        let law = crate::expression::Tape::line(position, target.value, request.t);
        drivers.push(held(model, target, law));
    }
    let extended = Model::new(&Arc::new(model.blueprint.holding(&drivers)), &model.parameters);
    let left = velocities::project(&extended, request.t, q, &mut v);
    if !(left <= 1e-8 && v.iter().all(|v| v.is_finite())) {
        return Err(Box::new(failure::rates(model, request)));
    }
    Ok(v)
}

/// Writes the assembly mode into the report.
fn describe(model: &Model, asked: &Targets, q: &[f64], report: &mut Report) {
    let mut taken = asked.clone();
    taken.approach(model, q);
    let placement = place(model, &taken, &[]);
    report.modes = report::modes(model, &placement.dyads, q);
    let combinations = u32::try_from(report.modes.len()).ok().and_then(|n| 2_usize.checked_pow(n));
    report.alternatives = combinations.map(|all| all - 1);
}
