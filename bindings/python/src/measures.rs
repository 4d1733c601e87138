//! Measures: expressions of quantities.

use crate::convert::{refuse, rows, table, Row, Rows};
use crate::errors::{raise_plain, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::respond::Table;
use kempe::analyses::dynamics::States;
use kempe::analyses::measures::Measure;
use kempe::analyses::slopes::by_state;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

fn read(py: Python<'_>, model: &PyModel, text: &str) -> PyResult<Measure> {
    Measure::read(&model.model, text).map_err(|found| raise_plain(py, Kind::Model, &[found]))
}

/// The quantities that a measure uses, its SI unit, whether it uses quantities of a whole run, and whether it needs
/// accelerations or multipliers.
#[pyfunction]
#[pyo3(signature = (model, text))]
pub fn measure(
    py: Python<'_>,
    model: &PyModel,
    text: &str,
) -> PyResult<(Vec<String>, String, bool, bool)> {
    guard("measure", || {
        let found = read(py, model, text)?;
        let (of_run, solves) = (found.is_of_run(), found.needs_solution(&model.model));
        Ok((found.quantities, found.unit, of_run, solves))
    })
}

/// The values of a measure for given values of its quantities, (n_t, n).
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
        finite(py, text, &t, t.iter().enumerate().map(row).collect())
    })
}

/// The derivatives of quantities at x = (t, q, v, z) by these and by the parameters, (n, n_x + n_parameters). Quantities
/// that need accelerations or multipliers are refused.
#[pyfunction]
#[pyo3(signature = (model, names, x))]
pub fn measure_slopes<'py>(
    py: Python<'py>,
    model: &PyModel,
    names: Vec<String>,
    x: Row<'py>,
) -> PyResult<Table<'py>> {
    guard("measure_slopes", || {
        let read = |name: &String| {
            let found = read(py, model, name)?;
            match found.is_of_run() || found.needs_solution(&model.model) {
                false => Ok(found),
                true => Err(refuse(py, name, "does not follow from t, q, v and z".to_string())),
            }
        };
        let measures = names.iter().map(read).collect::<PyResult<Vec<Measure>>>()?;
        let found = by_state(&model.model, &measures, &x.as_array().to_vec());
        let width = found.len() / names.len().max(1);
        table(py, found, (names.len(), width))
    })
}

/// The values of a measure at states, with accelerations and multipliers if it needs them.
pub fn measure_at<'py>(
    py: Python<'py>,
    model: &PyModel,
    text: &str,
    states: States<'_>,
    solved: Option<[&[f64]; 2]>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let found = read(py, model, text)?;
    if found.needs_solution(&model.model) && solved.is_none() {
        return Err(refuse(py, text, "needs accelerations and multipliers".to_string()));
    }
    let (active, count) = (&model.active, states.t.len());
    let lam = solved.map_or_else(Vec::new, |[_, lam]| active.own(lam, count));
    let solved = solved.map(|[a, _]| [a, &lam[..]]);
    let own = active.prepared.model();
    finite(py, text, states.t, found.in_phase(own).values(own, states, solved))
}

/// The values of a measure at times, which must be finite.
fn finite<'py>(
    py: Python<'py>,
    text: &str,
    t: &[f64],
    values: Vec<f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(values.into_pyarray(py)),
        Some(k) => {
            let message = format!("{} at {} s; the measure has no value there", values[k], t[k]);
            Err(refuse(py, text, message))
        }
    }
}
