//! Files of other tools.

use crate::attended::attended;
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use kempe_exchange::dxf::{self, Sheet};
use kempe_exchange::{Format, FORMATS};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

/// The formats that are read; their names are the endings of their files.
#[pyfunction]
pub fn exchange_formats() -> PyResult<Vec<&'static str>> {
    guard("exchange_formats", || Ok(FORMATS.iter().map(|(name, _)| *name).collect()))
}

/// The format whose files begin like a text.
#[pyfunction]
#[pyo3(signature = (text))]
pub fn exchange_format(text: &str) -> PyResult<Option<&'static str>> {
    guard("exchange_format", || {
        let found = Format::of(text);
        Ok(FORMATS.iter().find(|(_, format)| Some(*format) == found).map(|(name, _)| *name))
    })
}

/// Lines, texts, and whether the motion is the same without them.
type UnreadParts = Vec<(usize, String, bool)>;
/// Names and columns.
type Recorded = Vec<(String, Py<PyArray1<f64>>)>;

/// The case in a text as JSON, or None; what it lacks; and the results that the text carries.
#[pyfunction]
#[pyo3(signature = (text, format))]
pub fn exchange_read(
    py: Python<'_>,
    text: String,
    format: &str,
) -> PyResult<(Option<String>, UnreadParts, Recorded)> {
    guard("exchange_read", || {
        let Some(format) = Format::named(format) else {
            let known: Vec<&str> = FORMATS.iter().map(|(name, _)| *name).collect();
            let hint = format!("must be toml, json, {}", known.join(", "));
            let message = format!("format '{format}' is not known");
            return Err(Failure::new(Kind::File, message).hint(hint).raise(py));
        };
        let read = attended(py, move |_| kempe_exchange::read(&text, format))?;
        let unread = read.unread.into_iter().map(|part| (part.line, part.what, part.harmless));
        let column = |(name, row): (String, Vec<f64>)| (name, row.into_pyarray(py).unbind());
        Ok((read.case, unread.collect(), read.results.into_iter().map(column).collect()))
    })
}

/// A drawing as the text of a DXF file. Lengths are in metres, and `unit` is the size of a unit of the drawing.
#[pyfunction]
#[pyo3(signature = (unit, lines, circles, texts))]
pub fn exchange_dxf(
    py: Python<'_>,
    unit: f64,
    lines: Vec<dxf::Line>,
    circles: Vec<(String, [f64; 2], f64)>,
    texts: Vec<(String, [f64; 2], f64, String)>,
) -> PyResult<String> {
    guard("exchange_dxf", || {
        dxf::write(&Sheet { unit, lines, circles, texts }).ok_or_else(|| {
            let message = format!("a DXF file has no unit of {unit} m");
            Failure::new(Kind::Model, message).hint("mm, cm, m, in or ft").raise(py)
        })
    })
}
