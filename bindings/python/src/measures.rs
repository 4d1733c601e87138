//! Measures: expressions of quantities.

use crate::convert::{refuse, rows, Row, Rows};
use crate::errors::{raise_plain, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::measures::Measure;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

fn read(py: Python<'_>, model: &PyModel, text: &str) -> PyResult<Measure> {
    Measure::read(&model.model, text).map_err(|found| raise_plain(py, Kind::Model, &[found]))
}

/// The quantities that a measure uses, and its SI unit.
#[pyfunction]
#[pyo3(signature = (model, text))]
pub fn measure(py: Python<'_>, model: &PyModel, text: &str) -> PyResult<(Vec<String>, String)> {
    guard("measure", || read(py, model, text).map(|found| (found.quantities, found.unit)))
}

/// Values of a measure for the values of its quantities, (n_t, n).
#[pyfunction]
#[pyo3(signature = (model, text, t, quantities))]
pub fn measure_values<'py>(
    py: Python<'py>,
    model: &PyModel,
    text: &str,
    t: Row<'py>,
    quantities: Rows<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    guard("measure_values", || {
        let found = read(py, model, text)?;
        let (t, width) = (t.as_array().to_vec(), found.quantities.len());
        let given = rows(py, "quantities", &quantities, (t.len(), width))?;
        let row = |(k, t): (usize, &f64)| {
            found.value(&model.model, *t, &given[k * width..(k + 1) * width])
        };
        let values: Vec<f64> = t.iter().enumerate().map(row).collect();
        match values.iter().position(|x| !x.is_finite()) {
            None => Ok(values.into_pyarray(py)),
            Some(k) => {
                let message =
                    format!("{} at {} s; the measure has no value there", values[k], t[k]);
                Err(refuse(py, text, message))
            }
        }
    })
}
