//! Limits of motion for Python: interruptible, with progress.

use crate::attended::attended;
use crate::convert::{state, table, Row};
use crate::guard::guard;
use crate::kinematics::because;
use crate::model::PyModel;
use crate::watch::Watch;
use kempe::analyses::limits::{limits as core, Bound as End};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::Arc;

/// Limits as JSON, the values along the motion, and the positions there.
type Found<'py> = (String, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>);

/// The limits of the value that replaces t.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, progress))]
pub fn limits<'py>(
    py: Python<'py>,
    model: &Bound<'_, PyModel>,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found<'py>> {
    guard("limits", || {
        let model = Arc::clone(&model.get().model);
        let n_q = model.layout.n_q;
        let start = state(py, &model, t, [&q, &v, &z])?;
        let (outcome, raised) = attended(py, move |stop| {
            let mut watch = Watch::until(progress.as_ref(), stop);
            (core(&model, &start, |t| watch.look(t)), watch.raised)
        })?;
        if let Some(error) = raised {
            return Err(error);
        }
        let found = outcome.map_err(|failure| because(&failure.reason).raise(py))?;
        let value = |bound: &Option<End>| bound.as_ref().map(|bound| bound.value);
        let text = json!({
            "lower": value(&found.lower),
            "upper": value(&found.upper),
            "unit": found.unit,
            "reasons": found.reasons,
            "turns": found.turns,
        });
        let values: Vec<f64> = found.path.iter().map(|(value, _)| *value).collect();
        let positions: Vec<f64> = found.path.iter().flat_map(|(_, q)| q.iter().copied()).collect();
        let positions = table(py, positions, (values.len(), n_q))?;
        Ok((text.to_string(), values.into_pyarray(py), positions))
    })
}
