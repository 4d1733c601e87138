//! The compliance at a point for Python.

use crate::attended::attended;
use crate::convert::{state, Row};
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::watch::ToEnd;
use kempe::analyses::equilibrium as statics;
use kempe::analyses::record::Outcome;
use pyo3::prelude::*;
use std::sync::Arc;

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
        attended(py, work)?.map_err(|reason| Failure::from(Outcome::from(reason)).raise(py))
    })
}
