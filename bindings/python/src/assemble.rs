//! Assembly, for Python.

use crate::attended::attended;
use crate::convert::{number, state, tree, Row};
use crate::errors::{raise_plain, Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::assemble::{self as core, Request, Target};
use kempe::analyses::record::Outcome;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

/// A row of numbers for Python.
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Time, q, v, z, and the report as JSON.
type Assembled<'py> = (f64, Array<'py>, Array<'py>, Array<'py>, String);

/// Reads targets from a JSON text.
pub fn targets(
    py: Python<'_>,
    model: &PyModel,
    section: &str,
    text: &str,
) -> PyResult<Vec<Target>> {
    core::targets(&model.model, section, &tree(py, text)?).map_err(|mut found| {
        for problem in &mut found {
            problem.path.remove(0); // "start" is a section of files
        }
        raise_plain(py, Kind::Model, &found)
    })
}

/// Assembles a mechanism.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // the arguments of Python
#[pyo3(signature = (model, set, guess, t, q, v, z, from_guess=false))]
pub fn assemble<'py>(
    py: Python<'py>,
    model: &PyModel,
    set: &str,
    guess: &str,
    t: f64,
    q: Option<Row<'py>>,
    v: Option<Row<'py>>,
    z: Option<Row<'py>>,
    from_guess: bool,
) -> PyResult<Assembled<'py>> {
    guard("assemble", || {
        let given = match (q, v, z) {
            (Some(q), Some(v), Some(z)) => Some(state(py, &model.model, t, [&q, &v, &z])?),
            _ => None,
        };
        let mut doubts = core::doubts(&model.model, &tree(py, set)?);
        doubts.extend(core::doubts(&model.model, &tree(py, guess)?));
        let request = Request {
            set: targets(py, model, "set", set)?,
            guess: targets(py, model, "guess", guess)?,
            state: given,
            t: number(py, "t", t)?,
            from_guess,
            doubts,
        };
        let core_model = std::sync::Arc::clone(model.active.prepared.model());
        let outcome = attended(py, move |stop| core::assemble_until(&core_model, &request, stop))?;
        let (state, report) =
            outcome.map_err(|failure| Failure::from(Outcome::from(*failure)).raise(py))?;
        let [q, v, z] = [state.q, state.v, state.z].map(|row| row.into_pyarray(py));
        Ok((state.t, q, v, z, report.as_json().to_string()))
    })
}
