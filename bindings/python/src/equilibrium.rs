//! Statics for Python: without the interpreter's lock, interruptible, with progress.

use crate::attended::attended;
use crate::convert::{state, Row};
use crate::errors::{raise_plain, Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::options;
use crate::watch::{ToEnd, Watch};
use kempe::analyses::equilibrium as statics;
use kempe::analyses::options::Declared;
use kempe::analyses::State;
use kempe::model::Model;
use pyo3::prelude::*;
use serde_json::{json, Value};
use std::sync::Arc;

/// An equilibrium, or a path of equilibria, with the options of an entry of a case, as JSON.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, text, progress))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn equilibrium(
    py: Python<'_>,
    model: &PyModel,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
    text: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    guard("equilibrium", || {
        let core = Arc::clone(&model.model);
        let start = state(py, &core, t, [&q, &v, &z])?;
        let fields = options::fields(py, text)?;
        let chosen = statics::Options::checked(&core, &fields, &[])
            .map_err(|found| raise_plain(py, Kind::Model, &found))?;
        let outcome = attended(py, move |stop| {
            let mut watch = Watch::until(progress.as_ref(), stop);
            (solved(&core, &start, &chosen, &mut watch), watch.raised)
        })?;
        match outcome {
            (_, Some(error)) => Err(error),
            (Ok(found), None) => Ok(found.to_string()),
            (Err(reason), None) => Err(because(py, &reason)),
        }
    })
}

/// The compliance at a point of a body, m/N: xx, xy, yx, yy.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn compliance(
    py: Python<'_>,
    model: &PyModel,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
    point: &str,
    hold: Vec<String>,
) -> PyResult<[f64; 4]> {
    guard("compliance", || {
        let core = Arc::clone(&model.model);
        let start = state(py, &core, t, [&q, &v, &z])?;
        let place = point.rsplit_once('.').and_then(|(body, point)| {
            let body = core.body(body)?;
            Some((body, *core.bodies[body.0].point(point)?))
        });
        let Some((body, place)) = place else {
            let message = format!("'{point}' is not a point of a body");
            let hint = "give one such as crank.B";
            return Err(Failure::new(Kind::Model, message).name(point).hint(hint).raise(py));
        };
        let work = move |_: ToEnd<'_>| statics::compliance(&core, &start, &hold, body, place);
        attended(py, work)?.map_err(|reason| because(py, &reason))
    })
}

fn solved(
    model: &Model,
    start: &State,
    options: &statics::Options,
    watch: &mut Watch<'_>,
) -> Result<Value, statics::Reason> {
    if options.over.is_none() {
        let found = statics::equilibrium(model, start, options, |step| watch.look(step as f64))?;
        return Ok(json!({ "points": [point(&found)] }));
    }
    let found = statics::path(model, start, options, |value| watch.look(value))?;
    let points: Vec<Value> = found.points.iter().map(point).collect();
    let (end, why) = match &found.end {
        statics::PathEnd::Last => ("last", String::new()),
        statics::PathEnd::First => ("first", String::new()),
        statics::PathEnd::Lost(reason) => ("lost", reason.to_string()),
        statics::PathEnd::Long => ("long", String::new()),
        statics::PathEnd::Stopped => ("stopped", String::new()),
    };
    Ok(json!({
        "points": points, "values": found.values, "folds": found.folds, "branches": found.branches,
        "end": end, "why": why
    }))
}

fn point(found: &statics::Equilibrium) -> Value {
    json!({
        "q": found.state.q, "z": found.state.z, "lam": found.lam, "holders": found.holders,
        "efforts": found.efforts, "coordinates": found.coordinates,
        "stiffness": found.stiffness, "eigenvalues": found.eigenvalues, "stable": found.stable, "residual": found.residual,
        "steps": found.steps, "relaxed": found.relaxed
    })
}

fn because(py: Python<'_>, reason: &statics::Reason) -> PyErr {
    use statics::Reason;
    let failure = |kind, hint: &str| Failure::new(kind, reason.to_string()).hint(hint);
    match reason {
        Reason::Option(found) => return raise_plain(py, Kind::Model, found),
        Reason::Open => failure(
            Kind::Assembly,
            "kp.assemble(model, from_state=state) assembles the mechanism anew",
        ),
        Reason::Singular { name, .. } => {
            failure(Kind::Singularity, "start at another position").name(name)
        }
        Reason::NotFinite => failure(
            Kind::Integration,
            "check the laws of the forces at rest, such as a division by a rate",
        ),
        Reason::State { name } => {
            failure(Kind::Singularity, "its rate must depend on it").name(name)
        }
        Reason::Endless { coordinate, force, unit, .. } => {
            let unit = if *unit == "m" { "N" } else { "N m" };
            let name = coordinate.clone();
            let hint = format!(
                "{force:.4} {unit} still act along {coordinate}; add a spring or a stop, or hold = [\"{coordinate}\"]"
            );
            failure(Kind::Singularity, &hint).name(&name)
        }
        Reason::Lost { coordinate, .. } => failure(
            Kind::Singularity,
            "start nearer to the rest position; a force that jumps may have no equilibrium",
        )
        .name(coordinate),
        Reason::Moving { .. } => failure(
            Kind::Model,
            "kp.equilibrium(model, state).state is at rest; hold = [\"crank.angle\"] keeps a coordinate where it is",
        ),
        Reason::Loose { coordinate } => failure(
            Kind::Singularity,
            &format!("hold = [\"{coordinate}\"] keeps it where it is"),
        )
        .name(coordinate),
        Reason::Stopped => failure(Kind::Internal, "the search was stopped"),
    }
    .raise(py)
}
