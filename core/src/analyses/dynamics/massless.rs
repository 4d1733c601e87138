//! Bodies without mass or inertia whose motion the mechanism does not determine.
//!
//! A motion v that the joints admit, Φ_q v = 0, and that moves no mass, M v = 0, has no acceleration of its own: nothing
//! resists it. It moves massless bodies alone. So it exists if the columns of Φ_q of their coordinates are dependent, and
//! this is found before the run. Later, at a position in which such a freedom appears, the equations of motion find it.

use super::failure::{Failure, Reason};
use crate::elements::BodyId;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::model::{Model, Slots};
use crate::solve::{SparseRank, SparseRow, RANK_TOLERANCE};

/// Checks the massless bodies at a position.
///
/// A body with mass but without inertia is accepted: an angle on which no torque acts does not accelerate.
///
/// # Errors
/// [`Failure`] with [`Reason::Singular`], which names a massless body with a freedom of its own.
pub(super) fn check(model: &Model, t: f64, q: &[f64]) -> Result<(), Box<Failure>> {
    let massless = columns(model);
    if massless.is_empty() {
        return Ok(());
    }
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(&model.layout, q), t, &mut entries);
    let mut all: Vec<SparseRow> = vec![Vec::new(); model.layout.n_q];
    for (row, column, at) in model.layout.positions().filter(|(_, _, at)| entries[*at] != 0.0) {
        all[column].push((row, entries[at]));
    }
    let normal = |column: &usize| {
        let mut entries = std::mem::take(&mut all[*column]);
        entries.sort_unstable_by_key(|(row, _)| *row);
        let length = entries.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
        entries.iter_mut().for_each(|(_, x)| *x /= length);
        entries
    };
    let rows: Vec<SparseRow> = massless.iter().map(normal).collect();
    let found = SparseRank::new(&rows, model.layout.n_rows, RANK_TOLERANCE, &|| false);
    let free = found.and_then(|found| found.dependent.first().copied());
    free.map_or(Ok(()), |k| {
        let (name, message) = undetermined(model, t, massless[k]);
        Err(Reason::Singular { t, name, message }.into())
    })
}

/// The coordinates that move no mass; none if every body has mass.
fn columns(model: &Model) -> Vec<usize> {
    let bodies = model.bodies.iter().zip(&model.layout.bodies).skip(1);
    let massless = bodies.filter(|(body, _)| body.mass == 0.0).flat_map(|(body, columns)| {
        let turning = body.turns && body.inertia == 0.0;
        columns.first..columns.first + if turning { 3 } else { 2 }
    });
    let massless: Vec<usize> = massless.collect();
    let own = model.layout.constraints.iter().flat_map(|slots| slots.own.range());
    if massless.is_empty() {
        massless
    } else {
        own.chain(massless).collect()
    }
}

/// The name of a body, or of a joint with internal coordinates, and a message: nothing resists the motion of this
/// coordinate.
pub(super) fn undetermined(model: &Model, t: f64, column: usize) -> (String, String) {
    let owner = |slots: &Slots| slots.own.range().contains(&column);
    if let Some(k) = model.layout.constraints.iter().position(owner) {
        let name = model.constraints[k].name.clone();
        let message = format!(
            "the place of {name} on its curve is not determined at t = {t:.6} s: nothing resists its motion along the curve"
        );
        return (name, message);
    }
    let (id, place) = model.layout.body_of(column).unwrap_or((BodyId::GROUND, 0));
    let name = model.bodies[id.0].name.clone();
    let joints = joined(model, id).join(", ");
    let message = match model.bodies[id.0].mass > 0.0 {
        true => without_inertia(model, t, id, &joints),
        false => {
            let coordinate = ["x", "y", "angle"][place];
            let set = if place == 2 { "inertia" } else { "mass" };
            let leave = match joints.as_str() {
                "" => "no joint holds it".to_string(),
                joints => {
                    format!("its joints ({joints}) leave it a freedom of its own in this position")
                }
            };
            format!(
                "the motion of {name} is not determined at t = {t:.6} s: nothing resists {name}.{coordinate}, because \
                 {name} has no {set} and {leave}; set its {set}, or hold it with a joint or driver"
            )
        }
    };
    (name, message)
}

fn without_inertia(model: &Model, t: f64, id: BodyId, joints: &str) -> String {
    let body = &model.bodies[id.0];
    let (name, inertia) = (&body.name, body.inertia);
    let (has, set) = match inertia > 0.0 {
        true => (format!("hardly any moment of inertia ({inertia:.1e} kg·m²)"), "increase"),
        false => ("no moment of inertia".to_string(), "set"),
    };
    let advice = match joints {
        "" => format!("and no joint prevents its rotation; {set} its inertia"),
        joints => format!(
            "and its joints ({joints}) add hardly any in this position; {set} its inertia, or increase the \
             mass of the bodies that they join to it"
        ),
    };
    format!("a torque acts on {name} at t = {t:.6} s, but {name} has {has} {advice}")
}

/// The joints and drivers of a body.
fn joined(model: &Model, body: BodyId) -> Vec<&str> {
    let joints = model.constraints.iter().filter(|item| item.bodies.contains(&body));
    joints.map(|item| item.name.as_str()).collect()
}
