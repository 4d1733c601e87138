//! Python functions as laws of forces. They are called with the interpreter's lock during runs without the lock.
//!
//! The core receives a number. If a function raises, the exception is stored for this thread and the value is NaN,
//! which ends the run. The entry point then raises the exception.

use crate::errors::{Failure, Kind};
use crate::guard::raised;
use kempe::model::{Definition, FunctionLaw, Functions, Host, Sampling, Value};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::cell::RefCell;
use std::sync::{Arc, Mutex, PoisonError};

thread_local! {
    /// The laws that are being called on this thread.
    static CALLED: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
}

/// A law as described by the Python package: element, field, index of its entry in a list, function, function of its
/// derivatives by t, q, v, z and the parameters, period and start.
pub type Described =
    (String, String, Option<usize>, Py<PyAny>, Option<Py<PyAny>>, Option<(f64, f64)>);

/// The functions of a model.
#[derive(Debug)]
struct Laws {
    /// Creates a state from an array (t, q, v, z).
    state: Py<PyAny>,
    /// Path, function, and function of the derivatives of each law.
    laws: Vec<(String, Py<PyAny>, Option<Py<PyAny>>)>,
    last: Mutex<Option<Last>>,
}

/// The last state, and the values that were computed there.
#[derive(Debug)]
struct Last {
    x: Vec<f64>,
    state: Py<PyAny>,
    values: Vec<Option<f64>>,
    slopes: Vec<Option<Vec<f64>>>,
}

/// Replaces laws in the definition by the Python functions.
pub fn place(py: Python<'_>, definition: &mut Definition, state: Py<PyAny>, given: Vec<Described>) {
    let (mut laws, mut calls) = (Vec::new(), Vec::new());
    for (k, (element, field, entry, function, slopes, sampling)) in given.iter().enumerate() {
        let found = definition.forces.iter_mut().find(|force| force.name == *element);
        let fields = found.map(|force| &mut force.fields).into_iter().flatten();
        let value = fields.into_iter().find(|(name, _)| name == field).map(|(_, value)| value);
        match (value, entry) {
            (Some(Value::List(entries)), Some(at)) if *at < entries.len() => {
                entries[*at] = Value::Function(k);
            }
            (Some(value), None) => *value = Value::Function(k),
            _ => {}
        }
        let number = entry.map(|at| format!("_{}", at + 1)).unwrap_or_default();
        laws.push(FunctionLaw {
            element: element.clone(),
            field: format!("{field}{number}"),
            unit: String::new(),
            sampling: sampling.map(|(period, start)| Sampling { period, start }),
            slopes: slopes.is_some(),
        });
        let index = entry.map(|at| format!("[{at}]")).unwrap_or_default();
        let slopes = slopes.as_ref().map(|slopes| slopes.clone_ref(py));
        calls.push((format!("forces.{element}.{field}{index}"), function.clone_ref(py), slopes));
    }
    let host = Laws { state, laws: calls, last: Mutex::new(None) };
    definition.functions = Some(Functions { laws, host: Arc::new(host) });
}

impl Host for Laws {
    fn value(&self, law: usize, x: &[f64]) -> f64 {
        if raised::waits() || !x.iter().all(|x| x.is_finite()) {
            return f64::NAN;
        }
        let found = Python::attach(|py| self.call(py, law, x));
        found.unwrap_or_else(|error| {
            raised::keep(error);
            f64::NAN
        })
    }

    fn slopes(&self, law: usize, x: &[f64]) -> Vec<f64> {
        if raised::waits() || !x.iter().all(|x| x.is_finite()) {
            return Vec::new();
        }
        let found = Python::attach(|py| self.call_slopes(py, law, x));
        found.unwrap_or_else(|error| {
            raised::keep(error);
            Vec::new()
        })
    }
}

impl Laws {
    fn call(&self, py: Python<'_>, law: usize, x: &[f64]) -> PyResult<f64> {
        if let Some(value) = self.with_last(x, |last| last.values[law]).flatten() {
            return Ok(value);
        }
        let state = self.state(py, x)?;
        let called = Called::enter(self)
            .ok_or_else(|| self.fault(py, law, x, "needs its own value", RECURSION))?;
        let result = self.laws[law].1.bind(py).call1((x[0], state))?;
        drop(called);
        let value: f64 = result.extract().map_err(|_| {
            let text = result.repr().map(|text| text.to_string()).unwrap_or_default();
            self.fault(py, law, x, &format!("returned {text}"), NUMBER)
        })?;
        if !value.is_finite() {
            return Err(self.fault(
                py,
                law,
                x,
                &format!("returned {value}").to_lowercase(),
                NUMBER,
            ));
        }
        self.with_last(x, |last| last.values[law] = Some(value));
        Ok(value)
    }

    fn call_slopes(&self, py: Python<'_>, law: usize, x: &[f64]) -> PyResult<Vec<f64>> {
        let Some(slopes) = &self.laws[law].2 else { return Ok(Vec::new()) };
        if let Some(found) = self.with_last(x, |last| last.slopes[law].clone()).flatten() {
            return Ok(found);
        }
        let state = self.state(py, x)?;
        let called = Called::enter(self)
            .ok_or_else(|| self.fault(py, law, x, "needs its own value", RECURSION))?;
        let found: Vec<f64> = slopes.bind(py).call1((x[0], state))?.extract()?;
        drop(called);
        self.with_last(x, |last| last.slopes[law] = Some(found.clone()));
        Ok(found)
    }

    /// Calls `f` with what is known at the last state, if it equals x.
    fn with_last<R>(&self, x: &[f64], f: impl FnOnce(&mut Last) -> R) -> Option<R> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        last.as_mut().filter(|last| last.x == x).map(f)
    }

    /// The state of x.
    fn state(&self, py: Python<'_>, x: &[f64]) -> PyResult<Py<PyAny>> {
        if let Some(state) = self.with_last(x, |last| last.state.clone_ref(py)) {
            return Ok(state);
        }
        let state = self.state.call1(py, (PyArray1::from_slice(py, x),))?;
        let (values, slopes) = (vec![None; self.laws.len()], vec![None; self.laws.len()]);
        let new = Last { x: x.to_vec(), state: state.clone_ref(py), values, slopes };
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let old = last.replace(new);
        drop(last);
        drop(old); // may run code of Python, which must not find the lock taken
        Ok(state)
    }

    fn fault(&self, py: Python<'_>, law: usize, x: &[f64], what: &str, must: &str) -> PyErr {
        let (path, function, _) = &self.laws[law];
        let name = function.bind(py).getattr("__name__").and_then(|name| name.extract::<String>());
        let name = name.map(|name| format!(" '{name}'")).unwrap_or_default();
        let t = x[0];
        let message = format!("{path}: the function{name} {what} at t = {t:.9} s; {must}");
        let element = path.split('.').nth(1).unwrap_or_default();
        Failure::new(Kind::Model, message).name(element).at(t).raise(py)
    }
}

const NUMBER: &str = "it must return a finite number";
const RECURSION: &str =
    "accelerations and reactions depend on it, so it may use positions, rates and first-order states only";

/// Marks a host as being called on this thread.
struct Called;

impl Called {
    /// None if the host is already being called.
    fn enter(laws: &Laws) -> Option<Self> {
        let address = std::ptr::from_ref(laws) as usize;
        CALLED.with_borrow_mut(|called| {
            let inside = called.contains(&address);
            (!inside).then(|| called.push(address))
        })?;
        Some(Self)
    }
}

impl Drop for Called {
    fn drop(&mut self) {
        CALLED.with_borrow_mut(Vec::pop);
    }
}
