//! Accelerations and multipliers at states for Python: without the interpreter's lock, interruptible.

use crate::active::Active;
use crate::errors::{Failure, Kind};
use crate::watch::Watch;
use kempe::analyses::dynamics as core;
use numpy::PyArray2;
use pyo3::prelude::*;

/// Rows of numbers, time first.
pub type Table<'py> = Bound<'py, PyArray2<f64>>;

/// Accelerations, multipliers and regularity at states in rows, without stabilization. With `passing`, also near
/// singular positions.
pub fn responses(
    py: Python<'_>,
    model: &Active,
    states: core::States<'_>,
    passing: bool,
) -> PyResult<[Vec<f64>; 3]> {
    let mut watch = Watch::new(None);
    let found = py.detach(|| model.prepared.accelerations(states, passing, |t| watch.look(t)));
    if let Some(error) = watch.raised {
        return Err(error);
    }
    let found = found.map_err(|failure| missing(py, failure.reason))?;
    let core::Accelerations { a, lam, regularity } = found;
    Ok([a, model.expand(lam, states.t.len()), regularity])
}

/// Energies at states in rows, with the works up to them.
pub fn energies(
    py: Python<'_>,
    model: &Active,
    states: core::States<'_>,
    works: &[f64],
) -> PyResult<Vec<f64>> {
    let found = py.detach(|| model.prepared.energies(states, works));
    found.map_err(|failure| missing(py, failure.reason))
}

/// The exception for a run that stopped.
pub fn because(py: Python<'_>, reason: core::Reason) -> PyErr {
    let hint = match reason {
        core::Reason::Integration { hint, .. }
        | core::Reason::Start { hint, .. }
        | core::Reason::Redundant { hint, .. }
        | core::Reason::Law { hint, .. } => hint,
        _ => "look at the solution so far; change the start, or add what decides the motion here",
    };
    failure(reason, hint).raise(py)
}

/// The exception for a state at which a result cannot be computed.
pub fn missing(py: Python<'_>, reason: core::Reason) -> PyErr {
    let hint = match reason {
        core::Reason::Redundant { hint, .. } | core::Reason::Start { hint, .. } => hint,
        core::Reason::Integration { .. } => "check forces and laws at this state",
        _ => "positions and velocities are there; look at times beside it, or change the mechanism",
    };
    failure(reason, hint).raise(py)
}

fn failure(reason: core::Reason, hint: &'static str) -> Failure {
    let message = reason.to_string();
    match reason {
        core::Reason::Option { .. } => Failure::new(Kind::Model, message),
        core::Reason::Start { t, name, .. } => {
            Failure::new(Kind::Assembly, message).name(name).at(t).hint(hint)
        }
        core::Reason::Redundant { t, name, .. } => {
            Failure::new(Kind::Redundancy, message).name(name).at(t).hint(hint)
        }
        core::Reason::Law { t, name, .. } => {
            Failure::new(Kind::Model, message).name(name).at(t).hint(hint)
        }
        core::Reason::Singular { t, name, .. } => {
            Failure::new(Kind::Singularity, message).name(name).at(t).hint(hint)
        }
        core::Reason::Integration { t, .. } => {
            Failure::new(Kind::Integration, message).at(t).hint(hint)
        }
    }
}
