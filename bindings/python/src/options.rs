//! Options of forward dynamics from Python, as text in the format of a file.

use crate::convert::number;
use crate::errors::{raise, raise_plain, Kind};
use crate::model::PyModel;
use kempe::analyses::dynamics::{self, Options};
use kempe::case::{self, Format};
use kempe::model::Value;
use pyo3::prelude::*;

/// Reads options from `{"type": "dynamics", "t_end": 15, "method": {"type": "rk45", …}, …}`. `t_end`, if given,
/// replaces the value in the text.
pub fn read(py: Python<'_>, model: &PyModel, text: &str, t_end: Option<f64>) -> PyResult<Options> {
    let known = model.options.of(text);
    let mut options = known.map_or_else(|| read_anew(py, model, text), Ok)?;
    if let Some(t_end) = t_end {
        options.t_end = number(py, "t_end", t_end)?;
    }
    Ok(options)
}

fn read_anew(py: Python<'_>, model: &PyModel, text: &str) -> PyResult<Options> {
    let fields = fields(py, text)?;
    let options = dynamics::read(&model.model, &fields, &[])
        .map_err(|found| raise_plain(py, Kind::Model, &found))?;
    model.options.keep(text, &options);
    Ok(options)
}

/// The fields of an entry of `analyses` that is given as JSON.
pub fn fields(py: Python<'_>, text: &str) -> PyResult<Vec<(String, Value)>> {
    let written = format!("{{\"kempe\": 1, \"analyses\": {{\"dynamics\": {text}}}}}");
    let (case, _) = case::read(&written, Format::Json).map_err(|mut found| {
        found.iter_mut().for_each(|d| drop(d.path.drain(..d.path.len().min(2))));
        raise(py, Kind::Model, &found, None)
    })?;
    Ok(case.analyses.into_iter().next().map(|entry| entry.fields).unwrap_or_default())
}
