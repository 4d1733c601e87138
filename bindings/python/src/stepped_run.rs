//! A run that Python advances part by part.

use crate::convert::{refuse, state};
use crate::dynamics::PyRun;
use crate::errors::Failure;
use crate::guard::{guard, raised};
use crate::model::{written, PyModel, Written};
use crate::run_analysis::{called, read, At};
use crate::watch::Watch;
use kempe::analyses::dynamics::{Change, Failure as Failed, SavedRun, Setting, SteppedRun};
use kempe::analyses::record::{with_start, Outcome};
use kempe::analyses::{AnyAnalysis, State};
use kempe::integrate::Flow;
use kempe::model::Model;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

/// A run that advances part by part.
#[pyclass(name = "SteppedRun", module = "kempe._core", frozen)]
pub struct PySteppedRun {
    /// A part works on a copy, so that a panic leaves it as it was.
    run: Mutex<SteppedRun<Arc<Model>>>,
    model: Py<PyModel>,
    /// The names of the events that act, and the function that is called at them.
    actions: Option<(Vec<String>, Py<PyAny>)>,
}

/// A state of a stepped run from which it continues.
#[pyclass(name = "SavedRun", module = "kempe._core", frozen)]
pub struct PySavedRun(SavedRun);

/// Time, and arrays of q, v and z.
type StateArrays<'py> =
    (f64, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

impl PySteppedRun {
    fn locked(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, SteppedRun<Arc<Model>>>> {
        match self.run.try_lock() {
            Ok(run) => Ok(run),
            Err(TryLockError::Poisoned(left)) => Ok(left.into_inner()),
            Err(TryLockError::WouldBlock) => {
                let message = "a step is under way; an action or a law changes the run by the value that it returns";
                Err(refuse(py, "stepper", message.to_string()))
            }
        }
    }
}

fn failed(py: Python<'_>, failure: Box<Failed>) -> PyErr {
    Failure::from(Outcome::from(failure.reason)).raise(py)
}

#[pymethods]
impl PySteppedRun {
    /// Begins a run with the options of an analysis.
    #[new]
    #[pyo3(signature = (model, options, at, released, actions=None))]
    fn new(
        py: Python<'_>,
        model: &Bound<'_, PyModel>,
        options: &str,
        at: At<'_>,
        released: Vec<String>,
        actions: Option<(Vec<String>, Py<PyAny>)>,
    ) -> PyResult<Self> {
        guard("SteppedRun", || {
            let (core, (t, q, v, z)) = (model.get(), at);
            let AnyAnalysis::Dynamics(options) = read(py, core, options, Some(t))? else {
                return Err(refuse(py, "analysis", "must be of type dynamics".to_string()));
            };
            let start = state(py, &core.model, t, [&q, &v, &z])?;
            let acts = actions.as_ref().map_or(&[][..], |(names, _)| names);
            let options = with_start(&options, &released, acts).unwrap_or(options);
            let run = SteppedRun::new(Arc::clone(&core.prepared), &start, &options);
            let run = Mutex::new(run.map_err(|failure| failed(py, failure))?);
            Ok(Self { run, model: model.clone().unbind(), actions })
        })
    }

    /// Advances by a duration, s; returns new doubts.
    fn step(&self, py: Python<'_>, duration: f64) -> PyResult<Vec<String>> {
        guard("SteppedRun.step", || {
            let mut locked = self.locked(py)?;
            let run = &mut *locked;
            let (mut watch, mut stopped) = (Watch::new(None), None);
            let model = &self.model.get().model;
            let mut act = |name: &str, state: &State, setting: &Setting| {
                let (_, call) = self.actions.as_ref()?;
                let changed = Python::attach(|py| called(py, call, model, name, (state, setting)));
                changed.map_err(|error| stopped = Some(error)).ok()
            };
            let look = |t| if raised::waits() { Flow::Stop } else { watch.look(t) };
            let outcome = py.detach(|| run.advance(duration, look, Some(&mut act)));
            if let Some(error) = watch.raised.or(stopped).or_else(raised::take) {
                return Err(error);
            }
            outcome.map_err(|failure| failed(py, failure))?;
            Ok(run.last_part().doubts.clone())
        })
    }

    /// Gives parameters other values.
    fn set(&self, py: Python<'_>, parameters: Vec<(String, f64)>) -> PyResult<()> {
        guard("SteppedRun.set", || {
            let change = Change { parameters, state: None };
            let outcome = self.locked(py)?.change(change);
            outcome.map_err(|failure| failed(py, failure))
        })
    }

    fn save(&self, py: Python<'_>) -> PyResult<PySavedRun> {
        guard("SteppedRun.save", || Ok(PySavedRun(self.locked(py)?.save())))
    }

    fn restore(&self, py: Python<'_>, saved: &PySavedRun) -> PyResult<()> {
        guard("SteppedRun.restore", || {
            self.locked(py)?.restore(&saved.0);
            Ok(())
        })
    }

    /// The time reached, s.
    #[getter]
    fn t(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.locked(py)?.t())
    }

    /// The present state.
    #[getter]
    fn state<'py>(&self, py: Python<'py>) -> PyResult<StateArrays<'py>> {
        let State { t, q, v, z } = self.locked(py)?.state();
        Ok((t, q.into_pyarray(py), v.into_pyarray(py), z.into_pyarray(py)))
    }

    /// Dissipated energy and works since the start, J.
    #[getter]
    fn works<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(self.locked(py)?.works().to_vec().into_pyarray(py))
    }

    /// Parameters, released drivers and modes of forces that differ from the model.
    #[getter]
    fn setting(&self, py: Python<'_>) -> PyResult<Written> {
        Ok(written(self.locked(py)?.setting()))
    }

    /// The event that has stopped the run.
    #[getter]
    fn stopped_by(&self, py: Python<'_>) -> PyResult<Option<String>> {
        Ok(self.locked(py)?.stopped_by().map(str::to_string))
    }

    /// The last part.
    fn last_part(&self, py: Python<'_>) -> PyResult<PyRun> {
        guard("SteppedRun.last_part", || {
            let part = self.locked(py)?.last_part().clone();
            PyRun::new(py, self.model.bind(py), part, None, "")
        })
    }
}
