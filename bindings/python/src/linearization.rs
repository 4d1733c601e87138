//! Linearized equations for Python.

use crate::attended::attended;
use crate::convert::{refuse, state, table, Row};
use crate::errors::{raise_plain, Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::options;
use kempe::analyses::dynamics::Reason;
use kempe::analyses::linearization as linear;
use kempe::analyses::options::Declared;
use kempe::model::Model;
use numpy::ToPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use std::sync::Arc;

/// The checked options of `modes`, as JSON.
#[pyfunction]
pub fn modes_options(py: Python<'_>, model: &PyModel, text: &str) -> PyResult<String> {
    guard("modes_options", || {
        let fields = options::fields(py, text)?;
        let linear::Options { n, inputs, outputs, .. } =
            linear::Options::checked(&model.model, &fields, &[])
                .map_err(|found| raise_plain(py, Kind::Model, &found))?;
        Ok(json!({ "n": n, "inputs": inputs, "outputs": outputs }).to_string())
    })
}

/// The linearized equations at a state, as a dict of arrays.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, inputs, outputs))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn linearize<'py>(
    py: Python<'py>,
    model: &Bound<'py, PyModel>,
    t: f64,
    q: Row<'py>,
    v: Row<'py>,
    z: Row<'py>,
    inputs: Vec<String>,
    outputs: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    guard("linearize", || {
        let core = Arc::clone(&model.get().model);
        let at = state(py, &core, t, [&q, &v, &z])?;
        let counts = [inputs.len(), outputs.len()];
        let (outcome, outputs) =
            attended(py, move |_| (linear::linearize(&core, &at, &inputs, &outputs), outputs))?;
        let found = outcome.map_err(|failure| because(py, &failure, &outputs))?;
        arrays(py, &model.get().model, &found, counts)
    })
}

fn arrays<'py>(
    py: Python<'py>,
    model: &Model,
    found: &linear::Linearization,
    [inputs, outputs]: [usize; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let (f, states) = (found.coordinates.len(), found.states.len());
    let n = 2 * f + states;
    let all = PyDict::new(py);
    let names = found.coordinates.iter().map(|column| linear::coordinate(model, *column));
    all.set_item("coordinates", names.collect::<Vec<_>>())?;
    all.set_item("columns", &found.coordinates)?;
    all.set_item("states", &found.states)?;
    let tables = [
        ("basis", found.basis.concat(), (f, model.layout.n_q)),
        ("mass", found.mass.clone(), (f, f)),
        ("damping", found.damping.clone(), (f, f)),
        ("stiffness", found.stiffness.clone(), (f, f)),
        ("A", found.a.clone(), (n, n)),
        ("B", found.b.clone(), (n, inputs)),
        ("C", found.c.clone(), (outputs, n)),
        ("D", found.d.clone(), (outputs, inputs)),
    ];
    for (name, values, shape) in tables {
        all.set_item(name, table(py, values, shape)?)?;
    }
    all.set_item("acceleration", found.acceleration.to_pyarray(py))?;
    all.set_item("values", found.values.to_pyarray(py))?;
    Ok(all)
}

fn because(py: Python<'_>, failure: &linear::Failure, outputs: &[String]) -> PyErr {
    let message = failure.to_string();
    let made = |kind| Failure::new(kind, message.as_str());
    let made = match failure {
        linear::Failure::Singular { t, name, .. } => {
            made(Kind::Singularity).name(name).at(*t).hint("give a state beside this position")
        }
        linear::Failure::Open { t, name, .. } => made(Kind::Assembly)
            .name(name)
            .at(*t)
            .hint("kp.assemble(model, from_state=state) assembles the mechanism anew"),
        linear::Failure::NoInertia { t, coordinate } => {
            made(Kind::Singularity).name(coordinate).at(*t)
        }
        linear::Failure::Motion(failure) => match &failure.reason {
            Reason::Singular { t, name, .. } => made(Kind::Singularity)
                .name(name)
                .at(*t)
                .hint("give a state beside this one, or change the mechanism"),
            Reason::Start { t, name, .. } => made(Kind::Assembly)
                .name(name)
                .at(*t)
                .hint("give it a stiffness in place of restitution"),
            _ => made(Kind::Singularity).hint("give a state beside this one"),
        },
        linear::Failure::Name(problem) => {
            let hint = problem.hint.clone().unwrap_or_default();
            match hint.is_empty() {
                true => made(Kind::Model),
                false => made(Kind::Model).hint(hint),
            }
        }
        linear::Failure::Geometry { .. } => made(Kind::Model),
        linear::Failure::NoDerivative(k) => {
            let message =
                "it has no derivative at this state, such as the magnitude of a force that is zero";
            return refuse(py, &outputs[*k], message.to_string());
        }
    };
    made.raise(py)
}
