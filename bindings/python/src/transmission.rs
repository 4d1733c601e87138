//! Lines of links at their pins, for transmission angles.

use crate::guard::guard;
use crate::model::PyModel;
use crate::names::{constraint, one_of};
use kempe::analyses::transmission::{line_at as line, others_at, transmitting as pins};
use pyo3::prelude::*;

/// The pins and slides of a body except one joint, and the direction of the line of the body from this joint, in its
/// frame, rad. The direction is None unless there is exactly one other pin or slide.
#[pyfunction]
#[pyo3(signature = (model, joint, body))]
pub fn line_at(
    py: Python<'_>,
    model: &PyModel,
    joint: &str,
    body: &str,
) -> PyResult<(Vec<String>, Option<f64>)> {
    guard("line_at", || {
        let model = &model.model;
        let k = constraint(py, model, joint)?;
        let on = one_of(py, model, &model.constraints[k].bodies, joint, body)?;
        let name = |k: usize| model.constraints[k].name.clone();
        Ok((others_at(model, k, on).into_iter().map(name).collect(), line(model, k, on)))
    })
}

/// The pins at which another link moves a link that ground guides and that has no driver.
#[pyfunction]
#[pyo3(signature = (model))]
pub fn transmitting(model: &PyModel) -> PyResult<Vec<String>> {
    guard("transmitting", || {
        let model = &model.model;
        let name = |k: usize| model.constraints[k].name.clone();
        Ok(pins(model).into_iter().map(name).collect())
    })
}
