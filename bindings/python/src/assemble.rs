//! Assembly, for Python.

use crate::attended::attended;
use crate::convert::{number, state, tree, Row};
use crate::errors::{raise_plain, Failure, Kind, Problem};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::assemble::{
    self as core, Choice, Fault, Report, Request, Target, ValueSource,
};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use serde_json::{json, Value};

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
        let (state, report) = outcome.map_err(|failure| raise(py, &failure))?;
        let [q, v, z] = [state.q, state.v, state.z].map(|row| row.into_pyarray(py));
        Ok((state.t, q, v, z, describe(&report).to_string()))
    })
}

/// Converts the failure of an assembly to an exception.
pub fn raise(py: Python<'_>, failure: &core::Failure) -> PyErr {
    let kind = match failure.fault {
        Fault::Redundant => Kind::Redundancy,
        Fault::Open | Fault::Rates | Fault::Stopped => Kind::Assembly,
    };
    let contradicts = |place: &Vec<String>| Problem {
        message: "contradicts the others".to_string(),
        path: place.join("."),
        position: None,
    };
    let error = Failure::new(kind, failure.message.clone())
        .hint(failure.hint.clone())
        .problems(failure.places.iter().map(contradicts).collect());
    let named = if failure.name.is_empty() { error } else { error.name(failure.name.clone()) };
    named.raise(py)
}

/// The report of an assembly as JSON.
pub fn describe(report: &Report) -> Value {
    let iterations = report
        .iterations
        .iter()
        .map(|r| json!({ "residual": r.residual_norm, "step": r.step_norm, "damping": r.damping }));
    let modes = report.modes.iter().map(|m| {
        let side = match (m.slides, m.left) {
            (false, true) => "left",
            (false, false) => "right",
            (true, true) => "ahead",
            (true, false) => "behind",
        };
        json!({ "bodies": m.bodies, "joint": m.joint, "anchors": m.anchors, "side": side, "folded": m.folded })
    });
    json!({
        "iterations": iterations.collect::<Vec<_>>(),
        "degrees_of_freedom": report.degrees_of_freedom,
        "modes": modes.collect::<Vec<_>>(),
        "warnings": report.warnings,
        "unset": {
            "count": report.unset.count,
            "coordinates": report.unset.coordinates.iter().map(choice).collect::<Vec<_>>(),
            "rates": report.unset.rates.iter().map(choice).collect::<Vec<_>>(),
        },
    })
}

/// A coordinate or rate that was not set, as JSON.
fn choice(of: &Choice) -> Value {
    let (source, guess) = match of.source {
        ValueSource::Guess => ("guess", None),
        ValueSource::NearGuess(guess) => ("near guess", Some(guess)),
        ValueSource::Guesses => ("guesses", None),
        ValueSource::Drawing => ("drawing", None),
        ValueSource::Nothing => ("nothing", None),
        ValueSource::Rest => ("rest", None),
        ValueSource::LeastEnergy => ("least energy", None),
    };
    json!({ "name": of.name, "value": of.value, "unit": of.unit, "source": source, "guess": guess })
}
