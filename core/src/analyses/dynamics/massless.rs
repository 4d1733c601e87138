//! Massless bodies whose motion the mechanism does not determine.
//!
//! A motion v that the joints allow, Φ_q v = 0, and that moves no mass, M v = 0, has no determined acceleration,
//! because nothing resists it. Only massless bodies move in it. It exists if the columns of Φ_q for their coordinates
//! are dependent. This check is made before the run. If such a freedom appears at a later position, the equations of
//! motion detect it.

use super::failure::{Failure, Reason};
use super::no_mass;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Ordered};
use crate::model::Model;
use crate::solve::{SparseRank, SparseRow, RANK_TOLERANCE};

/// Tolerance of the rank near a position at which a freedom appears.
const NEAR: f64 = 1e-5;

/// Checks the massless bodies at a position.
///
/// A body with mass but without inertia is accepted: an angle on which no torque acts does not accelerate.
///
/// # Errors
/// [`Failure`] with [`Reason::Singular`], which names a massless body whose motion is not determined.
pub(super) fn check(model: &Model, t: f64, q: &[f64]) -> Result<(), Box<Failure>> {
    match undetermined(model, t, q).into_iter().next() {
        Some((name, message)) => Err(Reason::Singular { t, name, message }.into()),
        None => Ok(()),
    }
}

/// The massless bodies, or joints with internal coordinates, whose motion is not determined at a position, each with
/// a message about one of its coordinates.
pub(in crate::analyses) fn undetermined(model: &Model, t: f64, q: &[f64]) -> Vec<(String, String)> {
    within(RANK_TOLERANCE, columns(model), model, t, q)
}

/// The failure of a body without mass or inertia whose motion becomes undetermined near a position at which the steps
/// end.
pub(super) fn near(model: &Model, t: f64, q: &[f64]) -> Option<Box<Failure>> {
    let bodies = model.bodies.iter().zip(&model.layout.bodies).skip(1);
    let turning = bodies.filter(|(body, _)| body.turns && body.mass > 0.0 && body.inertia == 0.0);
    let angles = turning.map(|(_, columns)| columns.first + 2);
    let massless = angles.chain(columns(model)).list();
    let (name, message) = within(NEAR, massless, model, t, q).into_iter().next()?;
    Some(Reason::Singular { t, name, message }.into())
}

/// The undetermined items among these coordinates, for this tolerance of the rank.
fn within(
    tolerance: f64,
    massless: Vec<usize>,
    model: &Model,
    t: f64,
    q: &[f64],
) -> Vec<(String, String)> {
    if massless.is_empty() {
        return Vec::new();
    }
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(&model.layout, q), t, &mut entries);
    let mut all: Vec<SparseRow> = vec![Vec::new(); model.layout.n_q];
    for (row, column, at) in model.layout.positions().filter(|(_, _, at)| entries[*at] != 0.0) {
        all[column].push((row, entries[at]));
    }
    let normal = |column: &usize| {
        let mut entries = std::mem::take(&mut all[*column]);
        entries.order_by_key(|(row, _)| *row);
        let length = entries.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
        entries.iter_mut().for_each(|(_, x)| *x /= length);
        entries
    };
    let rows: Vec<SparseRow> = massless.iter().map(normal).list();
    let found = SparseRank::new(&rows, model.layout.n_rows, tolerance, &|| false);
    let dependent = found.map(|found| found.dependent).unwrap_or_default();
    let mut messages: Vec<(String, String)> = Vec::new();
    for k in dependent {
        let (name, message) = no_mass::undetermined(model, t, massless[k]);
        if messages.iter().all(|(known, _)| *known != name) {
            messages.push((name, message));
        }
    }
    messages
}

/// The coordinates that move no mass. Empty if every body has mass.
fn columns(model: &Model) -> Vec<usize> {
    let bodies = model.bodies.iter().zip(&model.layout.bodies).skip(1);
    let massless = bodies.filter(|(body, _)| body.mass == 0.0).flat_map(|(body, columns)| {
        let turning = body.turns && body.inertia == 0.0;
        columns.first..columns.first + if turning { 3 } else { 2 }
    });
    let massless: Vec<usize> = massless.list();
    let own = model.layout.constraints.iter().flat_map(|slots| slots.own.range());
    if massless.is_empty() {
        massless
    } else {
        own.chain(massless).list()
    }
}
