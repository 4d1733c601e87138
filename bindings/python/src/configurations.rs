//! All configurations of a mechanism, for Python.

use crate::assemble::{describe, raise, targets};
use crate::attended::attended;
use crate::convert::{number, table};
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::assemble::Request;
use kempe::analyses::configurations::{configurations as core, Failure as Reason};
use numpy::PyArray2;
use pyo3::prelude::*;
use serde_json::json;

/// q and v, one row for each configuration.
type Rows<'py> = Bound<'py, PyArray2<f64>>;
/// q, v, z, and JSON: the reports, whether the list is complete, and the number of positions left out.
type Found<'py> = (Rows<'py>, Rows<'py>, Rows<'py>, String);

/// The configurations for the values in `held`, a JSON text.
#[pyfunction]
pub fn configurations<'py>(
    py: Python<'py>,
    model: &PyModel,
    held: &str,
    limit: usize,
    t: f64,
) -> PyResult<Found<'py>> {
    guard("configurations", || {
        let request = Request {
            set: targets(py, model, "set", held)?,
            t: number(py, "t", t)?,
            ..Request::default()
        };
        let model = std::sync::Arc::clone(model.active.prepared.model());
        let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
        let outcome = attended(py, move |stop| core(&model, &request, limit, stop))?;
        let found = outcome.map_err(|reason| match reason {
            Reason::Assembly(failure) => raise(py, &failure),
            Reason::Free { degrees_of_freedom: n } => {
                let plural = if n == 1 { "" } else { "s" };
                let message = format!(
                    "{n} degree{plural} of freedom {} left, so that there are infinitely many configurations",
                    if n == 1 { "is" } else { "are" }
                );
                Failure::new(Kind::Model, message)
                    .hint("set a coordinate for each, as set = { \"crank.angle\": 1 }, or add drivers")
                    .raise(py)
            }
        })?;
        let count = found.states.len();
        let rows = |part: fn(&kempe::State) -> &Vec<f64>, width: usize| {
            let all = found.states.iter().flat_map(|(state, _)| part(state).iter().copied());
            table(py, all.collect(), (count, width))
        };
        let reports: Vec<_> =
            found.states.iter().map(|(_, report)| describe(report).to_string()).collect();
        let text = json!({
            "complete": found.complete,
            "left_out": found.left_out,
            "reports": reports,
        });
        Ok((rows(|s| &s.q, n_q)?, rows(|s| &s.v, n_q)?, rows(|s| &s.z, n_z)?, text.to_string()))
    })
}
