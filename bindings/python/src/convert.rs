//! Conversion of arrays, with checks of shape and finiteness. Errors contain the name of the array.

use crate::errors::{raise, Failure, Kind};
use kempe::analyses::State;
use kempe::case::{self, Format};
use kempe::math::Wrench;
use kempe::model::{Model, Value};
use numpy::ndarray::{Array2, Dimension};
use numpy::{IntoPyArray, PyArray, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// One row of numbers from Python.
pub type Row<'py> = PyReadonlyArray1<'py, f64>;
/// Rows of numbers from Python, time first.
pub type Rows<'py> = PyReadonlyArray2<'py, f64>;

/// The error for an invalid argument.
pub fn refuse(py: Python<'_>, name: &str, message: String) -> PyErr {
    Failure::new(Kind::Model, format!("{name}: {message}")).name(name).raise(py)
}

/// A finite row of the expected length.
pub fn row(py: Python<'_>, name: &str, given: &Row<'_>, length: usize) -> PyResult<Vec<f64>> {
    let values = given.as_array().to_vec();
    if values.len() != length {
        return Err(refuse(py, name, format!("{} numbers; must be {length}", values.len())));
    }
    finite(py, name, values)
}

/// A finite number.
pub fn number(py: Python<'_>, name: &str, value: f64) -> PyResult<f64> {
    finite(py, name, vec![value]).map(|_| value)
}

fn finite(py: Python<'_>, name: &str, values: Vec<f64>) -> PyResult<Vec<f64>> {
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(values),
        Some(k) => Err(refuse(py, name, format!("number {k} is {}; must be finite", values[k]))),
    }
}

/// Finite rows of the expected width, one for each time.
pub fn rows(
    py: Python<'_>,
    name: &str,
    given: &Rows<'_>,
    (count, width): (usize, usize),
) -> PyResult<Vec<f64>> {
    let array = given.as_array();
    if array.dim() != (count, width) {
        let (rows, columns) = array.dim();
        let message = format!("shape ({rows}, {columns}); must be ({count}, {width})");
        return Err(refuse(py, name, message));
    }
    finite(py, name, array.iter().copied().collect())
}

/// A state of a model.
pub fn state(py: Python<'_>, model: &Model, t: f64, [q, v, z]: [&Row<'_>; 3]) -> PyResult<State> {
    let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
    let (q, v, z) = (row(py, "q", q, n_q)?, row(py, "v", v, n_q)?, row(py, "z", z, n_z)?);
    Ok(State { t: number(py, "t", t)?, q, v, z })
}

/// Reads the fields of a JSON text that the Python package wrote.
pub fn tree(py: Python<'_>, text: &str) -> PyResult<Vec<(String, Value)>> {
    match case::parse_tree(text, Format::Json) {
        Ok(Value::Table(fields)) => Ok(fields),
        Ok(_) => Ok(Vec::new()),
        Err(found) => Err(raise(py, Kind::Model, &found, None)),
    }
}

/// A table of `width` columns.
pub fn table<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    (count, width): (usize, usize),
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let array = Array2::from_shape_vec((count, width), values);
    let array = array.map_err(|e| {
        Failure::new(Kind::Internal, format!("table of {count} × {width}: {e}")).raise(py)
    })?;
    Ok(array.into_pyarray(py))
}

/// Makes an array read-only.
pub fn frozen<D: Dimension>(array: Bound<'_, PyArray<f64, D>>) -> Bound<'_, PyArray<f64, D>> {
    array.try_readwrite().map(|guard| guard.make_nonwriteable()).ok();
    array
}

/// Writes force and torque into a row.
pub fn write(of: Wrench, out: &mut [f64]) {
    out.copy_from_slice(&[of.force.x, of.force.y, of.torque]);
}
