//! Forward dynamics as Python sees it: without the interpreter's lock, interruptible, with progress.

use crate::convert::{frozen, state, table, Row};
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::options;
use kempe::analyses::dynamics as core;
use kempe::integrate::Flow;
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use serde_json::json;
use std::time::{Duration, Instant};

/// Time between looks at signals and calls of `progress`.
const GLANCE: Duration = Duration::from_millis(40);
/// Time between looks at the clock: so short that a step which takes hundreds of times as long as the states
/// reported before it is not late.
const PACE: Duration = Duration::from_micros(250);

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
    a: Py<PyArray2<f64>>,
    #[pyo3(get)]
    lam: Py<PyArray2<f64>>,
    #[pyo3(get)]
    energy: Py<PyArray2<f64>>,
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
    choice: Option<core::Choice>,
}

#[pymethods]
impl PyRun {
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
    fn new(py: Python<'_>, model: &PyModel, run: core::Run, message: &str) -> PyResult<Self> {
        let (n, m) = (model.model.layout.n_q, model.model.layout.n_rows);
        let core::Trajectory { t, q, v, a, lam, energy } = run.trajectory;
        let count = t.len();
        let rows = |values, width| table(py, values, (count, width)).map(|t| frozen(t).unbind());
        let (dense_t, dense_y, dense_c) = match run.dense {
            Some(dense) => dense_arrays(py, dense, 2 * n + 3)?,
            None => (None, None, None),
        };
        Ok(Self {
            t: frozen(t.into_pyarray(py)).unbind(),
            q: rows(q, n)?,
            v: rows(v, n)?,
            a: rows(a, n)?,
            lam: rows(lam, m)?,
            energy: rows(energy, core::ENERGIES)?,
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

fn dense_arrays(py: Python<'_>, dense: core::Dense, n_y: usize) -> PyResult<DenseArrays> {
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

/// Looks at signals and reports progress, rarely enough to cost nothing.
struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    /// The last look at signals.
    told: Instant,
    /// The last look at the clock.
    looked: Instant,
    /// Steps and reported states from one look at the clock to the next.
    every: u32,
    /// And still to come.
    left: u32,
    raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        let now = Instant::now();
        Self { progress, told: now, looked: now, every: 1, left: 1, raised: None }
    }

    fn look(&mut self, t: f64) -> Flow {
        self.left -= 1;
        if self.left > 0 {
            return Flow::Continue;
        }
        self.look_at_clock(t)
    }

    #[cold]
    fn look_at_clock(&mut self, t: f64) -> Flow {
        let now = Instant::now();
        // too early: twice as many until the next; too late: so many fewer
        let late = (now - self.looked).as_secs_f64() / PACE.as_secs_f64();
        self.every = (f64::from(self.every) / late.max(0.5)).max(1.0) as u32;
        (self.left, self.looked) = (self.every, now);
        if now - self.told < GLANCE {
            return Flow::Continue;
        }
        self.told = now;
        let outcome = Python::attach(|py| {
            py.check_signals()?;
            self.progress.map_or(Ok(()), |call| call.call1(py, (t,)).map(|_| ()))
        });
        match outcome {
            Ok(()) => Flow::Continue,
            Err(error) => {
                self.raised = Some(error);
                Flow::Stop
            }
        }
    }
}

/// Simulates the motion from a state.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, options, progress, t_end=None))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn dynamics(
    py: Python<'_>,
    model: &PyModel,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    options: &str,
    progress: Option<Py<PyAny>>,
    t_end: Option<f64>,
) -> PyResult<PyRun> {
    guard("dynamics", || {
        let start = state(py, &model.model, t, &q, &v)?;
        let options = options::read(py, model, options, t_end)?;
        let mut watch = Watch::new(progress.as_ref());
        let outcome = py.detach(|| model.prepared.dynamics(&start, &options, |t| watch.look(t)));
        match (outcome, watch.raised) {
            (Ok(run), None) => PyRun::new(py, model, run, "t_end was reached"),
            (Ok(run), Some(error)) => {
                let run = PyRun::new(py, model, run, "interrupted")?;
                error.value(py).setattr("run", run)?;
                Err(error)
            }
            (Err(failure), _) => Err(raise(py, model, *failure)?),
        }
    })
}

fn raise(py: Python<'_>, model: &PyModel, failure: core::Failure) -> PyResult<PyErr> {
    let message = failure.reason.to_string();
    let run = Py::new(py, PyRun::new(py, model, failure.run, &message)?)?;
    let error = match failure.reason {
        core::Reason::Option { .. } => Failure::new(Kind::Model, message),
        core::Reason::Singular { t, name, .. } => {
            Failure::new(Kind::Singularity, message).name(name).at(t).hint(
                "look at the solution so far; change the start, or add what decides the motion here",
            )
        }
        core::Reason::Integration { t, hint, .. } => {
            Failure::new(Kind::Integration, message).at(t).hint(hint)
        }
    };
    let error = error.raise(py);
    error.value(py).setattr("run", run)?;
    Ok(error)
}
