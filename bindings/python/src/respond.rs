//! Accelerations and multipliers at states for Python: without the interpreter's lock, interruptible.

use crate::active::Active;
use crate::errors::Failure;
use crate::watch::Watch;
use kempe::analyses::dynamics as core;
use kempe::analyses::record;
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
    Ok(reported(found, model, states.t.len()))
}

/// Accelerations, the multipliers of the whole model, and regularity.
pub fn reported(found: core::Accelerations, model: &Active, count: usize) -> [Vec<f64>; 3] {
    let core::Accelerations { a, lam, regularity } = found;
    [a, model.expand(lam, count), regularity]
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

/// The exception for a state at which a result cannot be computed.
pub fn missing(py: Python<'_>, reason: core::Reason) -> PyErr {
    Failure::from(record::missing(reason)).raise(py)
}
