//! The diagnosis of a mechanism for Python.

use crate::attended::attended;
use crate::convert::{state, Row};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::diagnosis::{as_json, diagnose};
use pyo3::prelude::*;

/// The degrees of freedom, redundancies and singular positions of a mechanism at a position, as JSON.
#[pyfunction]
pub fn mobility(
    py: Python<'_>,
    model: &PyModel,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
) -> PyResult<String> {
    guard("mobility", || {
        let core = std::sync::Arc::clone(model.active.prepared.model());
        let state = state(py, &core, t, [&q, &v, &z])?;
        let found = attended(py, move |_| diagnose(&core, &state))?;
        Ok(as_json(&found).to_string())
    })
}
