//! One attempt to close a mechanism: Newton's method from a position.

use super::angle_winding::wind;
use super::request::Request;
use super::target::Target;
use super::targets::Targets;
use crate::analyses::closing::Closing;
use crate::equations::kinematics;
use crate::math::{Listed, Pose};
use crate::model::Model;
use crate::solve::newton::Record;

/// Largest number of placements from which Newton's method is tried.
pub(super) const MOST_TRIES: usize = 16;
/// Largest difference between a given pose and `set` for which the bodies are not placed again, rad.
const NEAR: f64 = 0.35;

/// A position in which the mechanism closes.
pub(super) struct Closed {
    pub q: Vec<f64>,
    pub iterations: Vec<Record>,
    pub warnings: Vec<String>,
}

/// The internal coordinates given by the state or the guess, with their columns. All others follow from the nearest
/// contact.
pub(super) fn internal(model: &Model, request: &Request) -> Vec<(usize, f64)> {
    let state = request.state.iter().flat_map(|state| {
        let columns = model.layout.constraints.iter().flat_map(|slots| slots.own.range());
        columns.filter_map(|column| Some((column, *state.q.get(column)?)))
    });
    let guess = request.guess.iter().filter_map(|target| match target {
        Target::Internal { column, value } => Some((*column, *value)),
        _ => None,
    });
    state.chain(guess).list()
}

/// Applies Newton's method from a position. The error is the position that it reached.
pub(super) fn close_from(
    closing: &mut Closing<'_>,
    internal: &[(usize, f64)],
    mut q: Vec<f64>,
    warnings: Vec<String>,
) -> Result<Closed, Vec<f64>> {
    for (column, value) in internal {
        q[*column] = *value;
    }
    wind(closing.model(), closing.time(), &mut q);
    match closing.close(&mut q) {
        (iterations, true) => Ok(Closed { q, iterations, warnings }),
        (_, false) => Err(q),
    }
}

/// The whole position, if every coordinate has a target and hard targets are near soft targets.
pub(super) fn given(model: &Model, asked: &Targets) -> Option<Vec<f64>> {
    let near = |b: usize| match (asked.hard[b][2], asked.soft[b][2]) {
        (Some(hard), Some(soft)) => (hard - soft).abs() < NEAR,
        _ => true,
    };
    let pose =
        |b: usize| asked.pose(b).filter(|_| near(b)).map(|[x, y, angle]| Pose::new(x, y, angle));
    let moving: Option<Vec<Pose>> = (1..asked.soft.len()).map(pose).collect();
    let poses: Vec<Pose> = std::iter::once(Pose::identity()).chain(moving?).list();
    Some(kinematics::coordinates(model, &poses))
}
