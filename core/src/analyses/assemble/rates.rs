//! Velocities at the start: the guess, made consistent, with drivers that hold the rates of `set`.

use super::contradiction::{self, AGREE};
use super::failure::{self, Failure};
use super::holding::held;
use super::request::Request;
use super::target::{of_rates, Target};
use super::velocities;
use crate::analyses::closing::Halt;
use crate::elements::Followed;
use crate::equations::position;
use crate::expression::Tape;
use crate::math::Listed;
use crate::model::Model;
use std::sync::Arc;

/// Consistent velocities at `q`.
pub(super) fn consistent(
    model: &Model,
    request: &Request,
    q: &[f64],
    stop: Halt<'_>,
) -> Result<Vec<f64>, Box<Failure>> {
    let (mut v, _) = wanted(model, request, q);
    let extended = holding_rates(model, request, q);
    let left = velocities::project(&extended, request.t, q, &mut v);
    if left <= AGREE && v.iter().all(|v| v.is_finite()) {
        return Ok(v);
    }
    let named = contradiction(model, request, q, stop);
    Err(Box::new(named.unwrap_or_else(|| failure::rates(model, request))))
}

/// The drivers and rates that contradict each other.
pub(super) fn contradiction(
    model: &Model,
    request: &Request,
    q: &[f64],
    stop: Halt<'_>,
) -> Option<Failure> {
    let extended = holding_rates(model, request, q);
    contradiction::of_rates(&extended, request, q, &wanted(model, request, q).0, stop)
}

/// The model with a driver for each rate that is set.
pub(super) fn holding_rates(model: &Model, request: &Request, q: &[f64]) -> Model {
    holding(model, request.t, q, of_rates(&request.set))
}

/// The model with a driver for each target. The targets are rates.
fn holding<'a>(
    model: &Model,
    t: f64,
    q: &[f64],
    targets: impl Iterator<Item = &'a Target>,
) -> Model {
    let line = |of: &Followed<Tape>, rate: f64| Tape::line(position(model, of, t, q), rate, t);
    let held: Vec<_> = targets.filter_map(|target| held(model, target, line)).list();
    Model::new(&Arc::new(model.blueprint.holding(&held)), &model.parameters)
}

/// The velocities that are given, set or guessed, before they become consistent, and the guessed rates of points and
/// elements that they meet.
pub(super) fn wanted<'a>(
    model: &Model,
    request: &'a Request,
    q: &[f64],
) -> (Vec<f64>, Vec<&'a Target>) {
    let mut v = match &request.state {
        Some(state) => state.v.clone(),
        None => vec![0.0; q.len()],
    };
    for target in of_rates(&request.guess).chain(of_rates(&request.set)) {
        if let Target::Coordinate(target) = target {
            v[target.place(model)] = target.value;
        }
    }
    // rates of points and elements are met if they agree with earlier ones
    let mut met: Vec<&Target> = Vec::new();
    for target in of_rates(&request.guess).filter(|target| matches!(target, Target::Quantity(_))) {
        met.push(target);
        let leading =
            holding(model, request.t, q, of_rates(&request.set).chain(met.iter().copied()));
        let mut tried = v.clone();
        let left = velocities::project(&leading, request.t, q, &mut tried);
        if left <= AGREE && tried.iter().all(|v| v.is_finite()) {
            v = tried;
        } else {
            met.pop();
        }
    }
    (v, met)
}
