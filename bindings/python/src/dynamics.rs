//! A motion for Python.

use crate::convert::{frozen, table};
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use crate::model::{written, PyModel, Written};
use crate::respond::{energies, reported, responses, Table};
use kempe::analyses::dynamics as core;
use numpy::ndarray::{Array3, Dimension};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray};
use pyo3::prelude::*;
use serde_json::json;

/// The result of an integration.
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
    /// The model of each phase, with its first row.
    parts: Vec<(usize, Py<PyModel>)>,
    events: Vec<core::EventStates>,
    passing: bool,
    /// Accelerations and multipliers, if they are known.
    known: Option<core::Accelerations>,
    /// Tolerance of the projection of the states.
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
    /// Balances beyond the limits that belong to the chosen method.
    #[pyo3(get)]
    doubts: Vec<String>,
    notes: Vec<String>,
    statistics: core::Statistics,
    choice: Option<core::MethodChoice>,
    passed: Vec<core::Passed>,
}

#[pymethods]
impl PyRun {
    /// Accelerations and multipliers at all reported states, or at the first `rows` of them.
    #[pyo3(signature = (rows=None))]
    fn responses<'py>(
        &self,
        py: Python<'py>,
        rows: Option<usize>,
    ) -> PyResult<(Table<'py>, Table<'py>)> {
        guard("Run.responses", || {
            let (mut a, mut lam) = (Vec::new(), Vec::new());
            self.by_phase(py, rows, |model, _, states| {
                let [own_a, own_lam, _] = match (&self.known, rows) {
                    // of inverse dynamics, which has one phase
                    (Some(known), None) => reported(known.clone(), &model.active, states.t.len()),
                    _ => responses(py, &model.active, states, self.passing)?,
                };
                a.extend(own_a);
                lam.extend(own_lam);
                Ok(())
            })?;
            let layout = &self.parts[0].1.get().model.layout;
            let count = a.len() / layout.n_q.max(1);
            Ok((
                table(py, a, (count, layout.n_q))?,
                table(py, lam, (count, self.parts[0].1.get().active.n_multipliers()))?,
            ))
        })
    }

    /// Kinetic, potential and dissipated energy, work of drivers, and work of applied forces at these states.
    #[pyo3(signature = (rows=None))]
    fn energies<'py>(&self, py: Python<'py>, rows: Option<usize>) -> PyResult<Table<'py>> {
        guard("Run.energies", || {
            let mut found = Vec::new();
            self.by_phase(py, rows, |model, first, states| {
                let width = model.model.layout.n_works;
                let works = &self.works[width * first..width * (first + states.t.len())];
                found.extend(energies(py, &model.active, states, works)?);
                Ok(())
            })?;
            let count = found.len() / core::ENERGIES;
            table(py, found, (count, core::ENERGIES))
        })
    }

    /// The first row of each phase, with the parameters and released drivers in it.
    #[getter]
    fn settings(&self) -> Vec<(usize, Written)> {
        self.parts.iter().map(|(first, model)| (*first, written(model.get().setting()))).collect()
    }

    /// The events: name, times, rows of q, v and z there, and impulses of the multipliers.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Vec<EventRows<'py>>> {
        let first = self.parts[0].1.get();
        let (layout, width) = (&first.model.layout, first.active.n_multipliers());
        let rows =
            |values: &[f64], width: usize, count: usize| table(py, values.to_vec(), (count, width));
        let one = |event: &core::EventStates| {
            let core::Trajectory { t, q, v, z, .. } = &event.states;
            let (n_q, n_z) = (layout.n_q, layout.n_z);
            let count = t.len();
            let (q, v, z) = (rows(q, n_q, count)?, rows(v, n_q, count)?, rows(z, n_z, count)?);
            let mut impulses = event.impulses.clone();
            impulses.resize(count * width, 0.0);
            let impulses = table(py, impulses, (count, width))?;
            Ok((event.name.clone(), t.clone().into_pyarray(py), q, v, z, impulses))
        };
        self.events.iter().map(one).collect()
    }

    /// The statistics of the integration, as JSON.
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
        if !self.notes.is_empty() {
            statistics["notes"] = json!(self.notes);
        }
        if !self.passed.is_empty() {
            let one = |p: &core::Passed| json!({"t": p.t, "names": p.names, "slope": p.slope, "residual": p.residual});
            statistics["singular"] = self.passed.iter().map(one).collect();
        }
        statistics.to_string()
    }
}

impl PyRun {
    /// Calls a function for the reported states of each phase, or the first of them, with the model and the first
    /// row.
    fn by_phase(
        &self,
        py: Python<'_>,
        rows: Option<usize>,
        mut give: impl FnMut(&PyModel, usize, core::States<'_>) -> PyResult<()>,
    ) -> PyResult<()> {
        fn numbers<'a, D: Dimension>(rows: &'a PyReadonlyArray<'_, f64, D>) -> PyResult<&'a [f64]> {
            Ok(rows.as_slice()?)
        }
        let t = self.t.bind(py).try_readonly()?;
        let [q, v, z] = [&self.q, &self.v, &self.z].map(|table| table.bind(py).try_readonly());
        let (q, v, z) = (q?, v?, z?);
        let (t, q, v, z) = (numbers(&t)?, numbers(&q)?, numbers(&v)?, numbers(&z)?);
        let count = rows.map_or(t.len(), |rows| rows.min(t.len()));
        for (k, (first, model)) in self.parts.iter().enumerate() {
            let model = model.get();
            let end = self.parts.get(k + 1).map_or(count, |(next, _)| count.min(*next));
            let (first, layout) = (*first.min(&end), &model.model.layout);
            let (n_q, n_z) = (layout.n_q, layout.n_z);
            let (q, v) = (&q[n_q * first..n_q * end], &v[n_q * first..n_q * end]);
            let z = &z[n_z * first..n_z * end];
            give(model, first, core::States { t: &t[first..end], q, v, z })?;
        }
        Ok(())
    }

    pub fn new(
        py: Python<'_>,
        model: &Bound<'_, PyModel>,
        run: core::Run,
        known: Option<core::Accelerations>,
        message: &str,
    ) -> PyResult<Self> {
        let parts = phases(py, model, &run)?;
        let layout = &model.get().model.layout;
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
            parts,
            events: run.events,
            passing: run.passing,
            known,
            projection: run.projection.map(|projection| projection.tolerance),
            dense_t,
            dense_y,
            dense_c,
            status: match (run.reached, &run.stopped_by) {
                (true, _) => "reached",
                (_, Some(_)) => "event",
                _ => "stopped",
            },
            message: message.to_string(),
            doubts: run.doubts,
            notes: run.notes,
            statistics: run.statistics,
            choice: run.choice,
            passed: run.passed,
        })
    }
}

/// The model of each phase that differs from the previous phase, with its first row.
fn phases(
    py: Python<'_>,
    model: &Bound<'_, PyModel>,
    run: &core::Run,
) -> PyResult<Vec<(usize, Py<PyModel>)>> {
    let mut parts: Vec<(usize, Py<PyModel>)> = Vec::new();
    let mut before = None;
    for (first, setting) in run.phases.iter().zip(&run.settings) {
        if before == Some(setting) {
            continue;
        }
        before = Some(setting);
        let own = match setting.is_plain() {
            true => model.clone().unbind(),
            false => Py::new(py, model.get().in_phase(py, setting)?)?,
        };
        parts.push((*first, own));
    }
    if parts.is_empty() {
        parts.push((0, model.clone().unbind()));
    }
    Ok(parts)
}

/// The name of an event, its times, and rows of q, v, z and impulses.
type EventRows<'py> = (
    String,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

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
