//! Forward dynamics as Python sees it: without the interpreter's lock, interruptible, with progress.

use crate::convert::{frozen, state, table, Row};
use crate::errors::{raise_plain, Failure, Kind};
use crate::guard::{guard, raised};
use crate::model::PyModel;
use crate::options;
use crate::respond::{because, energies, responses, Table};
use crate::watch::Watch;
use kempe::analyses::dynamics as core;
use kempe::analyses::dynamics::Prepared;
use kempe::model::Model;
use numpy::ndarray::{Array3, Dimension};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::Arc;

/// What an integration gave.
#[pyclass(name = "Run", module = "kempe._core", frozen)]
pub struct PyRun {
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    #[pyo3(get)]
    q: Py<PyArray2<f64>>,
    #[pyo3(get)]
    v: Py<PyArray2<f64>>,
    #[pyo3(get)]
    z: Py<PyArray2<f64>>,
    /// Dissipated energy and works, rows of n_works.
    works: Vec<f64>,
    model: Arc<Prepared<Arc<Model>>>,
    passing: bool,
    /// Tolerance of the projection of its states.
    #[pyo3(get)]
    projection: Option<f64>,
    #[pyo3(get)]
    dense_t: Option<Py<PyArray1<f64>>>,
    #[pyo3(get)]
    dense_y: Option<Py<PyArray2<f64>>>,
    #[pyo3(get)]
    dense_c: Option<Py<PyArray3<f64>>>,
    #[pyo3(get)]
    status: &'static str,
    #[pyo3(get)]
    message: String,
    statistics: core::Statistics,
    choice: Option<core::MethodChoice>,
}

#[pymethods]
impl PyRun {
    /// Accelerations and multipliers at the reported states, or at the first of them.
    #[pyo3(signature = (rows=None))]
    fn responses<'py>(
        &self,
        py: Python<'py>,
        rows: Option<usize>,
    ) -> PyResult<(Table<'py>, Table<'py>)> {
        guard("Run.responses", || {
            self.with_states(py, rows, |states| responses(py, &self.model, states, self.passing))
        })
    }

    /// Kinetic, potential, dissipated energy, work of drivers, work of applied forces, there.
    #[pyo3(signature = (rows=None))]
    fn energies<'py>(&self, py: Python<'py>, rows: Option<usize>) -> PyResult<Table<'py>> {
        guard("Run.energies", || {
            self.with_states(py, rows, |states| {
                let width = self.model.model().layout.n_works;
                let works = &self.works[..self.works.len().min(width * states.t.len())];
                energies(py, &self.model, states, works)
            })
        })
    }

    /// What it took, as JSON.
    #[getter]
    fn statistics(&self) -> String {
        let s = &self.statistics;
        let mut statistics = json!({
            "steps": s.steps,
            "rejected": s.rejected,
            "evaluations": s.evaluations,
            "jacobians": s.jacobians,
            "iterations": s.iterations,
            "factorisations": s.factorisations,
            "seconds": s.seconds,
        });
        if let Some(choice) = &self.choice {
            statistics["method"] = json!(choice.method);
            statistics["why"] = json!(choice.why);
        }
        statistics.to_string()
    }
}

impl PyRun {
    /// What the reported states give, or the first of them.
    fn with_states<T>(
        &self,
        py: Python<'_>,
        rows: Option<usize>,
        give: impl FnOnce(core::States<'_>) -> PyResult<T>,
    ) -> PyResult<T> {
        fn numbers<'a, D: Dimension>(rows: &'a PyReadonlyArray<'_, f64, D>) -> PyResult<&'a [f64]> {
            Ok(rows.as_slice()?)
        }
        let t = self.t.bind(py).try_readonly()?;
        let [q, v, z] = [&self.q, &self.v, &self.z].map(|table| table.bind(py).try_readonly());
        let (q, v, z) = (q?, v?, z?);
        let (t, layout) = (numbers(&t)?, &self.model.model().layout);
        let count = rows.map_or(t.len(), |rows| rows.min(t.len()));
        let (n_q, n_z) = (layout.n_q * count, layout.n_z * count);
        let (q, v, z) = (&numbers(&q)?[..n_q], &numbers(&v)?[..n_q], &numbers(&z)?[..n_z]);
        give(core::States { t: &t[..count], q, v, z })
    }

    fn new(py: Python<'_>, model: &PyModel, run: core::Run, message: &str) -> PyResult<Self> {
        let layout = &model.model.layout;
        let core::Trajectory { t, q, v, z, works } = run.trajectory;
        let count = t.len();
        let rows = |values, width| table(py, values, (count, width)).map(|t| frozen(t).unbind());
        let (dense_t, dense_y, dense_c) = match run.dense {
            Some(dense) => dense_arrays(py, dense, layout.n_y())?,
            None => (None, None, None),
        };
        Ok(Self {
            t: frozen(t.into_pyarray(py)).unbind(),
            q: rows(q, layout.n_q)?,
            v: rows(v, layout.n_q)?,
            z: rows(z, layout.n_z)?,
            works,
            model: Arc::clone(&model.prepared),
            passing: run.passing,
            projection: run.projection.map(|projection| projection.tolerance),
            dense_t,
            dense_y,
            dense_c,
            status: if run.reached { "reached" } else { "stopped" },
            message: message.to_string(),
            statistics: run.statistics,
            choice: run.choice,
        })
    }
}

type DenseArrays =
    (Option<Py<PyArray1<f64>>>, Option<Py<PyArray2<f64>>>, Option<Py<PyArray3<f64>>>);

fn dense_arrays(
    py: Python<'_>,
    dense: core::PiecewiseInterpolant,
    n_y: usize,
) -> PyResult<DenseArrays> {
    let steps = dense.t.len() - 1;
    let shape = (steps, n_y, dense.degree);
    let c = Array3::from_shape_vec(shape, dense.c).map_err(|e| {
        Failure::new(Kind::Internal, format!("coefficients of shape {shape:?}: {e}")).raise(py)
    })?;
    Ok((
        Some(frozen(dense.t.into_pyarray(py)).unbind()),
        Some(frozen(table(py, dense.y, (steps, n_y))?).unbind()),
        Some(frozen(c.into_pyarray(py)).unbind()),
    ))
}

/// Simulates the motion from a state.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, options, progress, t_end=None))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn dynamics(
    py: Python<'_>,
    model: &PyModel,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
    options: &str,
    progress: Option<Py<PyAny>>,
    t_end: Option<f64>,
) -> PyResult<PyRun> {
    guard("dynamics", || {
        let start = state(py, &model.model, t, [&q, &v, &z])?;
        let options = options::read(py, model, options, t_end)?;
        if let Some(problem) = options.backward(t, &["t_end"]) {
            return Err(raise_plain(py, Kind::Model, &[problem]));
        }
        let mut watch = Watch::new(progress.as_ref());
        let outcome = py.detach(|| model.prepared.dynamics(&start, &options, |t| watch.look(t)));
        match (outcome, watch.raised.or_else(raised::take)) {
            (Ok(run), None) => PyRun::new(py, model, run, "t_end was reached"),
            (Ok(run), Some(error)) => {
                let run = PyRun::new(py, model, run, "interrupted")?;
                error.value(py).setattr("run", run)?;
                Err(error)
            }
            (Err(failure), Some(error)) => {
                let run = Py::new(py, PyRun::new(py, model, failure.run, "interrupted")?)?;
                error.value(py).setattr("run", run)?;
                Err(error)
            }
            (Err(failure), None) => Err(raise(py, model, *failure)?),
        }
    })
}

fn raise(py: Python<'_>, model: &PyModel, failure: core::Failure) -> PyResult<PyErr> {
    let message = failure.reason.to_string();
    let run = Py::new(py, PyRun::new(py, model, failure.run, &message)?)?;
    let error = because(py, failure.reason);
    error.value(py).setattr("run", run)?;
    Ok(error)
}
